//! What the stored tables of schemes with knot intervals say, against the numbers of an independent prototype
//! (highest values, maxima, thresholds, gaps) and the statement of Lemma 1.

use std::collections::HashMap;
use std::path::Path;

fn rows(file: &str) -> Vec<HashMap<String, String>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../results/nonuniform")
        .join(file);
    let text = std::fs::read_to_string(path).unwrap();
    let mut lines = text
        .lines()
        .map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let head = lines.next().unwrap();
    lines.map(|line| head.iter().cloned().zip(line).collect()).collect()
}

fn number(row: &HashMap<String, String>, key: &str) -> f64 {
    row[key].parse().unwrap()
}

/// Highest value; depth of a second maximum, if there is one; value at the vertex.
#[test]
fn maxima_are_those_of_the_prototype() {
    let none = f64::NAN;
    let expected = [
        [
            (0.2925, none, 0.2385),
            (0.3464, none, 0.3451),
            (0.2212, 0.0364, 0.1917),
            (0.3805, none, 0.3451),
            (0.3490, none, 0.3451),
        ],
        [
            (0.2681, 0.1022, 0.1658),
            (0.3329, 0.0041, 0.3288),
            (0.2639, 0.1843, 0.0796),
            (0.3288, none, 0.3288),
            (0.3288, none, 0.3288),
        ],
        [
            (0.3912, 0.1206, 0.2015),
            (0.3969, none, 0.3888),
            (0.2605, 0.0894, 0.1028),
            (0.3906, none, 0.3888),
            (0.3889, none, 0.3888),
        ],
    ];
    let found = rows("blending.csv");
    assert_eq!(found.len(), 15);
    for (row, (highest, depth, centre)) in found.iter().zip(expected.into_iter().flatten()) {
        assert!((number(row, "highest") - highest).abs() < 1e-3, "{row:?}");
        assert!((number(row, "centre") - centre).abs() < 1e-3, "{row:?}");
        match depth.is_nan() {
            true => assert!(row["others"] == "0" && row["depth"].is_empty(), "{row:?}"),
            false => assert!(
                row["others"] == "1" && (number(row, "depth") - depth).abs() < 1e-3,
                "{row:?}"
            ),
        }
    }
    // over all patterns: no more than exist, HNUSS nowhere several up to n = 6 and ratio 3
    let counts = rows("maxima.csv");
    assert_eq!(counts.len(), 5 * 2 * 5);
    for row in &counts {
        let [all, exist, several] = ["patterns", "exists", "several_maxima"].map(|key| number(row, key));
        assert!(several <= exist && exist <= all && all > 0.0, "{row:?}");
        let unbounded = row["scheme"] == "nurss" || row["scheme"] == "hnuss:simple";
        assert!(!unbounded || exist == all, "{row:?}");
        if row["scheme"] == "hnuss" && (number(row, "valence") <= 6.0 || number(row, "ratio") == 3.0) {
            assert_eq!(several, 0.0, "{row:?}");
        }
    }
}

#[test]
fn eigen_polyhedra_exist_up_to_the_thresholds() {
    let expected = [
        9.6237,
        f64::INFINITY,
        3.7301,
        4.6374,
        3.2069,
        3.0378,
        2.8434,
        2.7079,
        2.6400,
        2.6046,
    ];
    let found = rows("thresholds.csv");
    assert_eq!(found.len(), expected.len());
    for (row, threshold) in found.iter().zip(expected) {
        if threshold.is_infinite() {
            assert!(row["threshold"].is_empty(), "{row:?}");
            continue;
        }
        assert!((number(row, "threshold") - threshold).abs() < 1e-3, "{row:?}");
        assert!(number(row, "documented") <= number(row, "threshold"), "{row:?}");
    }
}

#[test]
fn lemma_1_holds_on_all_sets() {
    let found = rows("lemma-1.csv");
    assert_eq!(found.iter().map(|row| number(row, "sets")).sum::<f64>(), 1e5);
    // of the order that the prototype saw on other sets
    for (row, order) in found.iter().zip([0.13, 0.026, 3e-3, 2e-5, 1e-7]) {
        assert_eq!(row["violations"], "0");
        let gap = number(row, "smallest_gap");
        assert!(
            gap > 0.0 && gap >= number(row, "least_bound") && gap < 30.0 * order && gap > order / 300.0,
            "{row:?}"
        );
    }
}
