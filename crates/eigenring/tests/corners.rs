//! **Claim**: `spectrum`, `matrix` and `verify` take any corner that a scheme has rules for, and refuse
//! others by name. **Oracle**: eigenvalues in closed form; the libraries are tested in
//! `tests/tests/corners.rs`.

use crate::common::Place;
use serde_json::Value;

fn eigenvalues(found: &Value) -> Vec<f64> {
    let list = found["eigenvalues"].as_array().unwrap();
    let values = list.iter().flat_map(|e| {
        let count = e["multiplicity"].as_u64().unwrap() as usize;
        vec![e["re"].as_f64().unwrap(); count]
    });
    values.collect()
}

#[test]
fn spectra_of_corners() {
    let place = Place::new();
    let golden = (3.0 + 5.0_f64.sqrt()) / 8.0;
    for (options, corner, expected) in [
        ("--fan 1", "fan", vec![1.0, 0.5, 0.25, 0.25]),
        ("--fan 2", "fan", vec![1.0, 0.5, 0.5, 0.25]),
        ("--fan 1 --corner", "fan, corner", vec![1.0, 0.5, 0.5, 0.25]),
        ("--dart -N 4", "dart", vec![1.0, 0.5, 0.5]),
        ("--cusp -N 7", "cusp", vec![1.0, golden]),
        (
            "--knots 1,2,1,3 --next 1,1,1,1",
            "closed, knots 1,2,1,3 next 1,1,1,1",
            vec![1.0, 0.5, 0.5, 0.25],
        ),
    ] {
        let found = place.json(&format!("spectrum --scheme catmull-clark {options}"));
        assert_eq!(found["corner"], corner, "{options}");
        for (a, b) in eigenvalues(&found).iter().zip(&expected) {
            assert!((a - b).abs() < 1e-7, "{options}: {a} {b}");
        }
        let count: u64 = found["eigenvalues"]
            .as_array()
            .unwrap()
            .iter()
            .map(|e| e["multiplicity"].as_u64().unwrap())
            .sum();
        assert_eq!(Some(count), found["points"].as_u64(), "{options}");
    }
    let one_face = place.json("spectrum --scheme catmull-clark --fan 1");
    let quarter = one_face["eigenvalues"]
        .as_array()
        .unwrap()
        .iter()
        .find(|e| e["multiplicity"] == 2)
        .unwrap();
    assert_eq!(
        (&quarter["geometric"], &quarter["jordan"]),
        (&Value::from(1), &Value::from("2"))
    );
    let position = one_face["limit_stencils"]["position"].as_array().unwrap();
    assert!((position[0].as_f64().unwrap() - 2.0 / 3.0).abs() < 1e-12);
}

#[test]
fn matrices_and_certificates_of_corners() {
    let place = Place::new();
    let matrix = place.json("matrix --scheme stam:order=6 --dart -N 5 --cs 1");
    assert!(matrix["points"].as_array().is_some());
    for (faces, code, word) in [("1", 1, "undecided"), ("5", 1, "refuted"), ("3", 0, "proven")] {
        let run = place.run(&["verify", "--scheme", "catmull-clark", "--fan", faces, "-o", "c.json"]);
        assert_eq!(run.code, Some(code), "{faces}: {}", run.stderr);
        let verdict = format!("c1 is {word}");
        assert!(
            run.stdout.contains(&verdict) && run.stdout.contains("fan"),
            "{}",
            run.stdout
        );
    }
    let again = place.run(&["verify", "--recheck", "c.json"]);
    assert_eq!(again.code, Some(0), "{}{}", again.stdout, again.stderr);
    let hull = place.run(&["verify", "--scheme", "catmull-clark", "--fan", "3", "--require", "hull"]);
    assert_eq!(hull.code, Some(0));
}

#[test]
fn corners_that_make_no_sense_are_refused() {
    let place = Place::new();
    for (line, says) in [
        (
            "spectrum --scheme doo-sabin --dart -N 5",
            "doo-sabin has no rules for this corner",
        ),
        ("spectrum --scheme catmull-clark --fan 2 -N 5", "-N is 5"),
        ("spectrum --scheme catmull-clark", "no valence"),
        ("spectrum --scheme catmull-clark --fan 0", "0 sectors"),
        ("spectrum --scheme catmull-clark --knots 1,-1,1,1", "-1"),
        (
            "spectrum --scheme catmull-clark --knots 1,2,1,3 --next 1,1",
            "2 knot intervals",
        ),
        ("matrix --scheme stam:order=6 --dart -N 5 --cs 3", "0 to 2"),
        ("verify --lambda-range 0.4..0.5 --fan 3", "-N alone"),
    ] {
        let words: Vec<&str> = line.split_whitespace().collect();
        let run = place.run(&words);
        assert_eq!(run.code, Some(2), "{line}: {}{}", run.stdout, run.stderr);
        assert!(
            run.stderr.contains(says) && run.stderr.contains("accepted"),
            "{line}: {}",
            run.stderr
        );
    }
}
