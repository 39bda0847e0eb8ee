//! Stored certificates on the command line: they are checked again, and what was changed is found.

#![allow(missing_docs)]

use crate::common::Place;
use crate::verify::refused;
use eigenring_certify::range::RangeCertificate;
use eigenring_certify::{Certificate, Statement, Status};

#[test]
fn certificates_are_stored_and_checked_again() {
    let place = Place::new();
    for (line, file) in [
        ("--scheme catmull-clark -N 7", "stored/catmull-clark.json"),
        ("--scheme lambda:lambda=0.5 -N 5", "stored/lambda.json"),
        ("--scheme tension:order=3 -N 3", "stored/tension.json"),
        ("--lambda-range 0.5..0.52 -N 6", "stored/range.json"),
    ] {
        place.run(
            &["verify", "-o", file]
                .into_iter()
                .chain(line.split(' '))
                .collect::<Vec<_>>(),
        );
        let text = place.ok(&["verify", "--recheck", file]);
        assert!(text.contains("  confirmed"), "{text}");
    }
    let text = place.ok(&["verify", "--recheck", "stored"]);
    assert_eq!(text.matches("  confirmed").count(), 4, "{text}");
    let json = place.json("verify --recheck stored");
    assert_eq!(json.as_array().unwrap().len(), 4);
}

/// Stores a certificate, changes it, and gives what checking it again says.
fn tampered(place: &Place, with_digest: bool, change: impl Fn(&mut Certificate)) -> String {
    place.run(&["verify", "--scheme", "catmull-clark", "-N", "5", "-o", "c.json"]);
    let mut certificate = Certificate::from_json(&place.read("c.json")).unwrap();
    change(&mut certificate);
    if with_digest {
        certificate.digest = certificate.content_digest();
    }
    place.write("c.json", certificate.to_json().unwrap());
    let run = place.run(&["verify", "--recheck", "c.json"]);
    assert_eq!(run.code, Some(1), "{}{}", run.stdout, run.stderr);
    assert!(run.stdout.contains("NOT CONFIRMED"), "{}", run.stdout);
    run.stdout
}

#[test]
fn tampering_is_found_with_and_without_the_digest() {
    let place = Place::new();
    let claim = |certificate: &mut Certificate| {
        let check = certificate
            .checks
            .iter_mut()
            .find(|check| check.name == Statement::BoundedCurvature)
            .unwrap();
        (check.status, check.holds, check.witness) = (Status::Proven, true, None);
    };
    let text = tampered(&place, false, claim);
    assert!(text.contains("digest"), "{text}");
    let text = tampered(&place, true, claim);
    assert!(!text.contains("digest"), "{text}");
    assert!(
        text.contains("bounded_curvature (status): claimed proven, found refuted"),
        "{text}"
    );

    // no evidence, no proof
    let text = tampered(&place, true, |certificate| certificate.evidence.jacobian = None);
    assert!(
        text.contains("regular (status): claimed proven, found undecided"),
        "{text}"
    );
    let text = tampered(&place, false, |certificate| certificate.evidence.winding = None);
    assert!(text.contains("digest") && text.contains("injective (status)"), "{text}");
    // the scheme of another certificate
    let text = tampered(&place, true, |certificate| certificate.valence = 6);
    assert!(text.contains("subdominant (details)"), "{text}");
    // a margin that is too good
    let margin = |certificate: &mut Certificate| certificate.checks[3].margin = Some(0.9);
    assert!(tampered(&place, true, margin).contains("subdominant (details)"));
    // a claim left out, and one that nobody knows
    let fewer = |certificate: &mut Certificate| drop(certificate.checks.remove(0));
    assert!(tampered(&place, true, fewer).contains("row_sums (status): claimed absent"));
    let more = |certificate: &mut Certificate| certificate.checks.push(certificate.checks[0].clone());
    assert!(tampered(&place, true, more).contains("twice"));
}

#[test]
fn tampered_ranges() {
    let place = Place::new();
    let make = |change: &dyn Fn(&mut RangeCertificate)| {
        place.run(&["verify", "--lambda-range", "0.3..0.32", "-N", "6", "-o", "r.json"]);
        let mut certificate = RangeCertificate::from_json(&place.read("r.json")).unwrap();
        change(&mut certificate);
        certificate.digest = certificate.content_digest();
        place.write("r.json", certificate.to_json().unwrap());
        let run = place.run(&["verify", "--recheck", "r.json"]);
        (run.code, run.stdout)
    };
    assert_eq!(make(&|_| ()).0, Some(0));
    let (code, text) = make(&|certificate| {
        let tiles = certificate.tiles.values_mut().flatten();
        tiles.for_each(|tile| tile.statuses.fill(Status::Proven));
    });
    assert_eq!(code, Some(1));
    assert!(text.contains("not as claimed") && !text.contains("digest"), "{text}");
    let (code, text) = make(&|certificate| {
        certificate.tiles.values_mut().for_each(|tiles| drop(tiles.pop()));
    });
    assert_eq!(code, Some(1));
    assert!(text.contains("do not cover"), "{text}");
}

#[test]
fn files_that_are_no_certificates_are_refused() {
    let place = Place::new();
    place.run(&["verify", "--scheme", "catmull-clark", "-N", "5", "-o", "c.json"]);
    let good = place.read("c.json");
    for (text, says) in [
        ("", "certificate"),
        ("not json", "certificate"),
        ("{}", "version"),
        ("[1, 2]", "certificate"),
        ("{\"tiles\": {}, \"version\": 1}", "certificate"),
        (&good[..good.len() / 2], "certificate"),
        (&good.replacen("\"version\": 2", "\"version\": 1", 1), "version 1"),
        (&good.replacen("\"valence\": 5", "\"valence\": 2", 1), "3"),
        (
            &good.replacen("\"valence\": 5", "\"valence\": 4000000000", 1),
            "valence",
        ),
        (&good.replacen("catmull-clark", "nothing", 1), "nothing"),
    ] {
        place.write("bad.json", text);
        let message = refused(&place, "--recheck bad.json");
        assert!(
            message.contains("bad.json") && message.contains(says) && message.contains("accepted"),
            "{message}"
        );
    }
    place.write("bytes.json", [0xff, 0xfe, 0x00]);
    assert!(refused(&place, "--recheck bytes.json").contains("bytes.json"));
    assert!(refused(&place, "--recheck missing.json").contains("missing.json"));
    std::fs::create_dir(place.path().join("empty")).unwrap();
    assert!(refused(&place, "--recheck empty").contains("no certificate"));
}
