//! Valences and lambdas beyond the tables are tuned when they are asked for, and remembered.

#![allow(missing_docs)]

use crate::common::{Place, files, number};

#[test]
fn a_stencil_is_tuned_once() {
    let place = Place::new();
    for n in ["25", "64"] {
        let spec = ["spectrum", "--scheme", "lambda:lambda=0.6", "-N", n];
        let first = place.run(&spec);
        assert_eq!(first.code, Some(0));
        assert!(
            first.stderr.starts_with("note: ") && first.stderr.contains("tuned now"),
            "{}",
            first.stderr
        );
        assert_eq!(first.stderr.lines().count(), 1);
        let second = place.run(&spec);
        assert!(
            second.stderr.contains("remembered from an earlier run"),
            "{}",
            second.stderr
        );
        assert_eq!(second.stdout, first.stdout);
        // the same stencil by another command, from the same memory
        let stencil = place.run(&["stencil", "-N", n, "--lambda", "0.6", "--format", "json"]);
        assert!(stencil.stderr.contains("remembered"), "{}", stencil.stderr);
        let stencil: serde_json::Value = serde_json::from_str(&stencil.stdout).unwrap();
        assert_eq!(stencil["source"], "tuned");

        // it is what tune finds; given by hand it is accepted, and has that objective
        let tuned = place.json(&format!("tune -N {n} --lambda 0.6"));
        assert_eq!(
            (&tuned["f2"], &tuned["f3"], &tuned["branch"]),
            (&stencil["f2"], &stencil["f3"], &"lowest".into())
        );
        let weights = format!("--f2 {} --f3 {}", tuned["f2"], tuned["f3"]);
        let given = place.json(&format!("stencil -N {n} --lambda 0.6 {weights}"));
        for field in [
            "mu", "s", "f1", "d1", "d2", "e1", "e2", "alpha", "beta", "g1", "g2", "g3",
        ] {
            assert_eq!(given[field], stencil[field], "{field}");
        }
        let objective = place.json(&format!("objective -N {n} --lambda 0.6 {weights}"));
        let (a, b) = (number(&objective, "total"), number(&tuned, "total"));
        assert!((a - b).abs() <= 1e-9 * b, "{a} {b}");

        // its subdominant eigenvalue is the one that was asked for
        let spectrum = place.json(&format!("spectrum --scheme lambda:lambda=0.6 -N {n}"));
        assert!((number(&spectrum, "subdominant") - 0.6).abs() < 1e-12);
        assert!((number(&spectrum, "subsubdominant") - number(&stencil, "mu")).abs() < 1e-12);
    }
    // a memory that was damaged is no memory
    for (name, _) in files(place.cache.path()) {
        assert!(name.ends_with(".json"), "{name}");
        std::fs::write(place.cache.path().join(name), "{\"lambda\":").unwrap();
    }
    let again = place.run(&["stencil", "-N", "25", "--lambda", "0.6"]);
    assert!(again.stderr.contains("tuned now"), "{}", again.stderr);
}

#[test]
fn the_optimum_is_tuned_once() {
    let place = Place::new();
    let spec = ["spectrum", "--scheme", "lambda:optimal", "-N", "21", "--format", "json"];
    let first = place.run(&spec);
    assert_eq!(first.code, Some(0), "{}", first.stderr);
    assert!(
        first.stderr.contains("N = 21") && first.stderr.contains("tuned now"),
        "{}",
        first.stderr
    );
    let second = place.run(&spec);
    assert!(second.stderr.contains("remembered"), "{}", second.stderr);
    assert_eq!(second.stdout, first.stdout);
    let spectrum: serde_json::Value = serde_json::from_str(&first.stdout).unwrap();
    let tuned = place.json("tune -N 21 --global");
    assert!((number(&spectrum, "subdominant") - number(&tuned, "lambda")).abs() < 1e-12);
    // tabulated valences need no tuning
    let run = place.run(&["spectrum", "--scheme", "lambda:optimal", "-N", "20"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
}

#[test]
fn another_s_and_lambdas_beyond_the_table_are_tuned() {
    let place = Place::new();
    for arguments in [
        &["stencil", "-N", "6", "--lambda", "0.55", "--s", "1.2"][..],
        &["stencil", "-N", "6", "--lambda", "0.92"],
        &["stencil", "-N", "3", "--lambda", "0.14"],
    ] {
        let run = place.run(arguments);
        assert_eq!(run.code, Some(0), "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains("tuned now"), "{arguments:?}: {}", run.stderr);
        assert_eq!(place.run(arguments).stdout, run.stdout);
    }
    assert_eq!(place.run(&["stencil", "-N", "6", "--lambda", "0.9"]).stderr, "");
}
