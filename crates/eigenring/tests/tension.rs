//! The tension scheme on the command line: its tables, the rings that are taken, what is refused.

#![allow(missing_docs)]

use crate::common::{Place, files, number};

#[test]
fn tables_do_not_depend_on_the_number_of_threads() {
    let place = Place::new();
    for (out, threads) in [("one", "1"), ("two", "2")] {
        let line = format!("tables --scheme tension --valences 3 --out {out} --threads {threads}");
        let arguments: Vec<&str> = line.split(' ').collect();
        let printed = place.ok(&arguments);
        assert_eq!(printed.lines().count(), 1 + 20, "{printed}");
    }
    let [one, two] = ["one", "two"].map(|out| files(&place.path().join(out).join("tension")));
    assert_eq!(one.len(), 8);
    assert!(one == two);
    // what is recorded makes them again
    let report = place.ok(&["reproduce", "--check", "--out", "one"]);
    assert!(report.lines().count() == 8 && !report.contains("DIFFERENT"), "{report}");
}

#[test]
fn options_of_the_other_scheme_are_refused() {
    let place = Place::new();
    for rest in ["--knots paper", "--starts full", "--margin 0", "--embed x.json"] {
        let line = format!("tables --scheme tension --valences 3 {rest}");
        let run = place.run(&line.split(' ').collect::<Vec<_>>());
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{rest}");
        assert!(run.stderr.contains("accepted"), "{}", run.stderr);
    }
    assert_eq!(files(place.path()).len(), 0);
}

#[test]
fn one_ring_more_where_the_smallest_set_hides_an_eigenvalue() {
    let place = Place::new();
    let found = place.json("spectrum --scheme tension:order=3 -N 3");
    assert_eq!(
        (found["rings"].as_u64(), found["closed_rings"].as_u64()),
        (Some(1), Some(0))
    );
    assert!((number(&found, "outer") - 0.25).abs() < 1e-12);
    let notes = found["notes"].as_array().unwrap();
    assert_eq!(notes.len(), 2, "{notes:?}");
    assert!(notes[1].as_str().unwrap().contains("defective"), "{notes:?}");
    // the local matrix is that of the same rings
    let rows = place.json("matrix --scheme tension:order=3 -N 3")["rows"]
        .as_array()
        .unwrap()
        .len();
    assert_eq!(rows, 12);
    // asked for explicitly, the smallest set is given
    let smallest = place.json("spectrum --scheme tension:order=3 -N 3 --rings 0");
    assert_eq!(smallest["rings"], 0);
    assert!(smallest["notes"].as_array().unwrap().is_empty());
    for scheme in [
        "catmull-clark",
        "tension:order=6,u0=2",
        "tension:order=7",
        "stam:order=9",
    ] {
        let found = place.json(&format!("spectrum --scheme {scheme} -N 7"));
        assert_eq!(found["rings"], found["closed_rings"], "{scheme}");
    }
}

#[test]
fn parameters_out_of_range() {
    let place = Place::new();
    for (scheme, accepted) in [
        ("tension:order=4,u0=-1", "u0 > -1"),
        ("tension:order=4,u0=-3", "u0 > -1"),
        ("tension:order=4,u0=nan", "u0 > -1"),
        ("tension:order=4,u0=inf", "u0 > -1"),
        ("morin:u0=-1", "u0 > -1"),
        ("tension:order=2", "3 to 32"),
        ("tension:order=33", "3 to 32"),
        ("stam:order=2", "3 to 32"),
        ("stam", "stam:order=K"),
        ("tension:order=x", "tension:order=K[,u0=U]"),
        ("doo-sabin:original", "doo-sabin[:uniform]"),
    ] {
        for command in ["spectrum", "matrix"] {
            let run = place.run(&[command, "--scheme", scheme, "-N", "5"]);
            assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{scheme}");
            assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
            assert!(run.stderr.contains(accepted), "{}", run.stderr);
        }
    }
    for valence in ["2", "0", "-1"] {
        let run = place.run(&["spectrum", "--scheme", "tension:order=5", "-N", valence]);
        assert_eq!(run.code, Some(2));
        assert!(run.stderr.contains("3 to"), "{}", run.stderr);
    }
    let run = place.run(&["spectrum", "--scheme", "tension:order=8", "-N", "5", "--rings", "2"]);
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr.contains("3 (the smallest closed set) to 64"),
        "{}",
        run.stderr
    );
}
