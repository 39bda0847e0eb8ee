//! Stored certificates: what is claimed is proven again, and what was altered is not; input that is refused.

use crate::common::of_spec;
use eigenring_certify::range::{Limits, StencilCurve, prove_range};
use eigenring_certify::{Certificate, Input, Requirement, Status, certify, recheck, recheck_text};
use eigenring_scheme::user::Reading;

#[test]
fn what_is_claimed_is_proven_again() {
    let certificate = of_spec("lambda:optimal", 5);
    let text = certificate.to_json().unwrap();
    let read = Certificate::from_json(&text).unwrap();
    assert_eq!(read, certificate);
    assert!(recheck(&read).unwrap().confirmed());

    // changed after it was written: noticed
    let tampered = text.replacen("\"status\": \"proven\"", "\"status\": \"refuted\"", 1);
    let found = recheck(&Certificate::from_json(&tampered).unwrap()).unwrap();
    assert!(!found.intact && !found.confirmed());

    // with a digest that fits: the claim itself is not confirmed
    let mut forged = certificate.clone();
    forged.input = Input::Family {
        spec: "catmull-clark".into(),
    };
    forged.digest = forged.content_digest();
    let found = recheck(&forged).unwrap();
    assert!(found.intact && !found.confirmed());
    assert!(
        found
            .differences
            .iter()
            .any(|d| d.name == "bounded_curvature" && d.found == Some(Status::Refuted))
    );

    // without evidence nothing is believed
    let mut empty = certificate.clone();
    empty.evidence = Default::default();
    empty.digest = empty.content_digest();
    let found = recheck(&empty).unwrap();
    assert!(
        found
            .differences
            .iter()
            .any(|d| d.name == "regular" && d.found == Some(Status::Undecided))
    );

    // a statement that nobody knows, a field, a key or a statement that occurs twice
    assert!(Certificate::from_json(&text.replacen("\"row_sums\"", "\"c2\"", 1)).is_err());
    assert!(Certificate::from_json(&text.replacen("\"holds\": true", "\"holds\": true, \"sure\": true", 1)).is_err());
    assert!(Certificate::from_json(&text.replacen("\"valence\": 5", "\"valence\": 5, \"valence\": 5", 1)).is_err());
    let mut twice = certificate.clone();
    let mut second = twice.checks[1].clone();
    second.status = Status::Refuted;
    twice.checks.push(second);
    twice.digest = twice.content_digest();
    assert!(!recheck(&twice).unwrap().confirmed());
    // the text is that of the certificate, to the byte
    assert!(recheck_text(&text).unwrap().1.confirmed());
    assert!(
        recheck_text(&(serde_json::to_string(&certificate).unwrap() + "\n"))
            .unwrap()
            .1
            .confirmed()
    );
    assert!(
        !recheck_text(&text.replacen("  \"valence\"", "   \"valence\"", 1))
            .unwrap()
            .1
            .confirmed()
    );
    // another degree
    let mut other = certificate.clone();
    other.degree = Some(2);
    other.digest = other.content_digest();
    assert!(!recheck(&other).unwrap().confirmed());

    for bad in ["", "{}", "{\"version\": 99}", "[1]"] {
        assert!(Certificate::from_json(bad).is_err());
    }
}

#[test]
fn refused_input_is_an_error_and_no_panic() {
    assert!(
        certify(
            Input::Family {
                spec: "catmull-clark".into()
            },
            2
        )
        .is_err()
    );
    assert!(certify(Input::Family { spec: "loop".into() }, 5).is_err());
    assert!(
        certify(
            Input::Toml {
                text: "x".into(),
                name: "x".into(),
                reading: Reading::Balanced,
                parameters: Default::default(),
            },
            5
        )
        .is_err()
    );
    for lambda in [f64::NAN, 0.1, 1.0] {
        assert!(
            certify(
                Input::Lambda {
                    lambda,
                    s: 1.0,
                    f2: 0.25,
                    f3: None
                },
                5
            )
            .is_err()
        );
    }
    assert!(
        certify(
            Input::Lambda {
                lambda: 0.5,
                s: 1.0,
                f2: f64::INFINITY,
                f3: None
            },
            5
        )
        .is_err()
    );
    // f2 = 0 has no scheme; nothing is proven of it
    let certificate = certify(
        Input::Lambda {
            lambda: 0.5,
            s: 1.0,
            f2: 0.0,
            f3: Some(0.1),
        },
        5,
    )
    .unwrap();
    assert!(!Requirement::C1.verdict(&certificate.checks).0);
    assert!("c2".parse::<Requirement>().is_err());
    let curve = || StencilCurve::embedded(5).unwrap();
    for range in [[0.3, 0.2], [0.1, 0.5], [0.5, 0.95], [f64::NAN, 0.5], [0.4, 0.4]] {
        assert!(prove_range(5, curve(), range, Limits::default()).is_err());
    }
    assert!(
        prove_range(
            5,
            StencilCurve::Constant { f2: f64::NAN, f3: 0.1 },
            [0.3, 0.4],
            Limits::default()
        )
        .is_err()
    );
    // the closed forms divide by f2
    assert!(
        prove_range(
            6,
            StencilCurve::Constant { f2: 0.0, f3: 0.0 },
            [0.2, 0.9],
            Limits::default()
        )
        .is_err()
    );
}
