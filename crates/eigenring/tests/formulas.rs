//! **Claim**: a stranger starts from a written file, sets its parameters in three ways that mean the same,
//! and stores proofs that hold their values; what is wrong in a formula is named with its place.
//! **Oracle**: the built-in schemes, and the files' own text.

#![allow(missing_docs)]

use crate::common::Place;
use serde_json::Value;

const MINE: &str = "my.toml";

fn place() -> Place {
    let place = Place::new();
    place.ok(&["new-scheme", "--like", "catmull-clark", "-o", MINE]);
    place
}

/// The eigenvalues that `spectrum` prints.
fn spectrum(place: &Place, arguments: &[&str]) -> Value {
    let text = place.ok(&[&["spectrum", "-N", "7", "--format", "json"], arguments].concat());
    let object: Value = serde_json::from_str(&text).unwrap();
    object["eigenvalues"].clone()
}

#[test]
fn written_files_are_the_schemes_that_they_are_like() {
    let place = place();
    for (like, file, spec) in [
        ("doo-sabin", "ds.toml", "doo-sabin"),
        ("stam:order=6", "two.toml", "stam:order=6"),
    ] {
        place.ok(&["new-scheme", "--like", like, "-o", file]);
        let [ours, theirs] =
            [format!("file:{file}"), spec.to_owned()].map(|name| spectrum(&place, &["--scheme", &name]));
        assert_eq!(ours, theirs, "{like}");
    }
    assert_eq!(
        spectrum(&place, &["--scheme", "file:my.toml"]),
        spectrum(&place, &["--scheme", "catmull-clark"])
    );
    // an existing file is left alone
    let again = place.run(&["new-scheme", "--like", "doo-sabin", "-o", MINE]);
    assert!(
        again.code == Some(2) && again.stderr.contains("my.toml exists"),
        "{}",
        again.stderr
    );
    let unknown = place.run(&["new-scheme", "--like", "loop"]);
    assert!(unknown.code == Some(2) && unknown.stderr.contains("accepted are catmull-clark, doo-sabin"));
}

#[test]
fn parameters_are_set_in_names_and_by_option() {
    let place = place();
    let named = spectrum(&place, &["--scheme", "file:my.toml,a=7/5"]);
    assert_eq!(named, spectrum(&place, &["--scheme", "file:my.toml", "--set", "a=1.4"]));
    assert_eq!(named, spectrum(&place, &["--scheme", "file:\"my.toml\",a=1.40"]));
    assert_ne!(named, spectrum(&place, &["--scheme", "file:my.toml"]));
    let text = std::fs::read_to_string(place.path().join(MINE)).unwrap();
    std::fs::write(
        place.path().join("changed.toml"),
        text.replace("default = \"3/2\"", "default = \"7/5\""),
    )
    .unwrap();
    assert_eq!(named, spectrum(&place, &["--scheme", "file:changed.toml"]));
    let rows = place.ok(&[
        "compare",
        "--schemes",
        "file:my.toml,file:my.toml,a=1.4",
        "-N",
        "5",
        "--format",
        "csv",
    ]);
    assert!(
        rows.contains("5,catmull-clark,0.") && rows.contains("catmull-clark,a=7/5"),
        "{rows}"
    );
    for (arguments, needle) in [
        (
            vec!["--scheme", "file:my.toml,a=4"],
            "a = 4 is out of range: accepted is 0 <= a <= 3",
        ),
        (
            vec!["--scheme", "file:my.toml", "--set", "a=-1"],
            "accepted is 0 <= a <= 3",
        ),
        (
            vec!["--scheme", "file:my.toml,c=1"],
            "unknown parameter 'c': accepted are a, b",
        ),
        (vec!["--scheme", "file:my.toml,a=1", "--set", "a=1"], "set twice"),
        (vec!["--scheme", "file:my.toml", "--set", "a"], "accepted is NAME=VALUE"),
        (vec!["--scheme", "doo-sabin", "--set", "a=1"], "file:SCHEME.toml"),
        (
            vec!["--scheme", "file:my.toml", "--sweep", "a=0..1"],
            "NAME=FIRST..LAST:STEPS",
        ),
        (vec!["--scheme", "file:my.toml", "--sweep", "a=0..4:2"], "out of range"),
        (vec!["--scheme", "doo-sabin", "--sweep", "a=0..1:2"], "file:SCHEME.toml"),
    ] {
        let run = place.run(&[&["spectrum", "-N", "5"], arguments.as_slice()].concat());
        assert_eq!(run.code, Some(2), "{arguments:?}");
        assert!(
            run.stderr.contains(needle) && run.stderr.lines().count() == 1,
            "{arguments:?}: {}",
            run.stderr
        );
    }
}

#[test]
fn a_sweep_is_its_single_spectra() {
    let place = place();
    let text = place.ok(&[
        "spectrum",
        "--scheme",
        "file:my.toml",
        "--sweep",
        "a=1..2:4",
        "-N",
        "7",
        "--format",
        "json",
    ]);
    let sweep: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(sweep["parameter"], "a");
    let rows = sweep["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 5);
    for row in rows {
        let name = format!("file:my.toml,a={}", row["value"]);
        assert_eq!(row["eigenvalues"], spectrum(&place, &["--scheme", &name]));
    }
    // the figure's data are the same eigenvalues
    place.ok(&[
        "plot",
        "spectrum",
        "--schemes",
        "file:my.toml",
        "--sweep",
        "a=1..2:4",
        "-N",
        "7",
        "--out",
        "figures",
    ]);
    let drawn = std::fs::read_to_string(place.path().join("figures/spectrum.csv")).unwrap();
    let mut drawn = drawn.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    for row in rows {
        for eigenvalue in row["eigenvalues"].as_array().unwrap() {
            let line = drawn.next().unwrap();
            assert_eq!((line[1], line[2].parse().ok()), ("7", row["value"].as_f64()));
            assert_eq!(line[4].parse().ok(), eigenvalue["re"].as_f64());
            assert_eq!(line[3].parse().ok(), eigenvalue["fourier"].as_u64());
        }
    }
    assert!(drawn.next().is_none());
    let table = place.ok(&[
        "spectrum",
        "--scheme",
        "file:my.toml",
        "--sweep",
        "a=1..2:4",
        "-N",
        "7",
        "--format",
        "csv",
    ]);
    assert!(
        table.starts_with("a,subdominant,subsubdominant,s\n1,") && table.lines().count() == 6,
        "{table}"
    );
}

#[test]
fn certificates_hold_the_file_and_its_parameters() {
    let place = place();
    place.ok(&[
        "verify",
        "--scheme",
        "file:my.toml,a=1.4",
        "-N",
        "5",
        "-o",
        "proof.json",
    ]);
    let stored = std::fs::read_to_string(place.path().join("proof.json")).unwrap();
    assert!(
        stored.contains("alpha = \\\"a/n\\\"") && stored.contains("\"a\": \"7/5\""),
        "{stored}"
    );
    // the file itself is not needed
    std::fs::remove_file(place.path().join(MINE)).unwrap();
    place.ok(&["verify", "--recheck", "proof.json"]);
    std::fs::write(place.path().join("proof.json"), stored.replace("\"7/5\"", "\"3/5\"")).unwrap();
    let tampered = place.run(&["verify", "--recheck", "proof.json"]);
    assert_eq!(tampered.code, Some(1), "{}", tampered.stdout);
}

/// A root that is no cyclotomic number is enclosed, and what rests on it is not called proven.
#[test]
fn what_is_not_exact_is_numerical() {
    let place = place();
    let text = std::fs::read_to_string(place.path().join(MINE)).unwrap();
    let text = text.replace("f2 = \"1/4\"", "f2 = \"sqrt(3 + cos(2*pi/n))/8\"");
    std::fs::write(place.path().join(MINE), text).unwrap();
    let run = place.run(&["verify", "--scheme", "file:my.toml", "-N", "5", "--format", "json"]);
    let object: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(
        (run.code, object["status"].as_str()),
        (Some(1), Some("numerical")),
        "{}",
        run.stdout
    );
    assert!(run.stderr.contains("results of rounding"), "{}", run.stderr);
    // at n = 4 the root is that of 3
    let run = place.run(&["verify", "--scheme", "file:my.toml", "-N", "4", "--format", "json"]);
    let object: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(
        (run.code, object["status"].as_str()),
        (Some(0), Some("proven")),
        "{}",
        run.stdout
    );
}

#[test]
fn bad_formulas_are_named_with_their_place() {
    let place = place();
    let text = std::fs::read_to_string(place.path().join(MINE)).unwrap();
    let line = 1 + text.lines().position(|line| line.starts_with("f2")).unwrap();
    let nested = "(".repeat(1_000_000) + "1" + &")".repeat(1_000_000);
    for (formula, needle) in [
        (
            "1/(n - 4)",
            format!("line {line}, column 10: f2: division by zero at n = 4"),
        ),
        ("1/4 + x", format!("line {line}, column 13: rule, f2: unknown name 'x'")),
        ("1/4 + 0*d1*f2", "f2 depends on itself: f2 -> f2".to_owned()),
        ("1/4 + 0*f1", "depends on itself: f1 -> f2 -> f1".to_owned()),
        (&nested, "a formula of 2000001 characters".to_owned()),
        ("sum(k, 1, 1000000000, k)", "a sum from 1 to 1000000000".to_owned()),
        ("1/4 +", format!("line {line}, column 12: rule, f2: the formula ends")),
    ] {
        std::fs::write(
            place.path().join("bad.toml"),
            text.replace("f2 = \"1/4\"", &format!("f2 = \"{formula}\"")),
        )
        .unwrap();
        let run = place.run(&["spectrum", "--scheme", "file:bad.toml", "-N", "4"]);
        let shown = &formula[..formula.len().min(40)];
        assert_eq!(run.code, Some(2), "{shown}: {}", run.stderr);
        assert!(
            run.stderr.contains(&needle) && run.stderr.contains("accepted"),
            "{shown}: {}",
            run.stderr
        );
        assert!(
            run.stderr.lines().count() == 1 && run.stderr.len() < 500,
            "{shown}: {}",
            run.stderr
        );
    }
    // elsewhere the first of them is as good as any
    std::fs::write(
        place.path().join("bad.toml"),
        text.replace("f2 = \"1/4\"", "f2 = \"1/(n - 4)\""),
    )
    .unwrap();
    place.ok(&["matrix", "--scheme", "file:bad.toml", "-N", "5"]);
}

/// The guide's file is a file.
#[test]
fn the_example_of_the_guide_is_read() {
    let place = Place::new();
    let guide = include_str!("../../../ADDING_A_SCHEME.md");
    let block = guide
        .split("```toml\n")
        .nth(1)
        .and_then(|rest| rest.split("```").next())
        .unwrap();
    std::fs::write(place.path().join("guide.toml"), block).unwrap();
    assert_eq!(
        spectrum(&place, &["--scheme", "file:guide.toml"]),
        spectrum(&place, &["--scheme", "catmull-clark"])
    );
    place.ok(&["verify", "--scheme", "file:guide.toml", "-N", "3"]);
}
