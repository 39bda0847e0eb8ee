//! **Claim**: the eigenvalues in `results/tension` are those of the local matrices, and the moduli fall as
//! `1 > |lambda_1| = |lambda_2| > |lambda_3|` over the whole sweep but for the exceptions that are listed.
//! **Oracles**: closed forms of order 3, Catmull-Clark (Ball and Storry 1988), regular nets; the limit u = 1
//! that the levels approach; matrices computed here.

use eigenring_scheme::families::tension;
use eigenring_spectral::LocalSystem;
use eigenring_tests::Comparison;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;
use std::path::Path;

type Record = BTreeMap<String, String>;

/// The rows of a file of results/tension, by column.
fn stored(name: &str) -> Vec<Record> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../results/tension")
        .join(name);
    let text = std::fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let record = |line: &str| {
        header
            .iter()
            .map(|h| (*h).to_owned())
            .zip(line.split(',').map(str::to_owned))
            .collect()
    };
    lines.map(record).collect()
}

fn number(record: &Record, column: &str) -> f64 {
    match record[column].as_str() {
        // the corners of a triangle alone have no third eigenvalue
        "" => 0.0,
        text => text.parse().unwrap(),
    }
}

fn count(record: &Record, column: &str) -> usize {
    record[column].parse().unwrap()
}

fn sweep() -> Vec<Record> {
    [stored("sweep_even.csv"), stored("sweep_odd.csv")].concat()
}

#[test]
fn the_sweep_is_complete_and_order_three_at_valence_three_is_its_only_exception() {
    let rows = sweep();
    let key = |r: &Record| ["order", "valence", "u0", "level"].map(|column| r[column].clone());
    let keys: BTreeSet<_> = rows.iter().map(key).collect();
    assert_eq!((rows.len(), keys.len()), (18_000, 18_000));
    for r in &rows {
        assert!((3..=22).contains(&count(r, "order")) && (3..=20).contains(&count(r, "valence")));
        assert!((1..=10).contains(&count(r, "level")));
        let [one, two, three] = ["lambda1", "lambda2", "lambda3"].map(|column| number(r, column));
        let next = three.max(number(r, "outer"));
        let holds = one < 1.0 && one - two < 1e-10 && two - next > 1e-10 && r["index1"] == "1" && r["index2"] == "1";
        assert_eq!(holds, r["ok"] == "1", "{r:?}");
        // lambda_1 = (u/(1+u))^2 against 1/(2(1+u)) outside
        let exception = r["order"] == "3" && r["valence"] == "3" && number(r, "u0") <= 1.0;
        assert_eq!(holds, !exception, "{r:?}");
    }
    let exceptions = stored("exceptions.csv");
    let expected: Vec<&Record> = rows.iter().filter(|r| r["ok"] == "0").collect();
    assert_eq!(exceptions.iter().collect::<Vec<_>>(), expected);
}

#[test]
fn the_smallest_gaps_are_those_of_the_sweep() {
    let rows = sweep();
    let gaps = stored("smallest_gaps.csv");
    assert_eq!(gaps.len(), 20);
    for record in gaps {
        let of_order = rows.iter().filter(|r| r["order"] == record["order"] && r["ok"] == "1");
        let smallest = of_order.map(|r| number(r, "gap")).fold(f64::INFINITY, f64::min);
        assert_eq!(smallest, number(&record, "gap"));
    }
}

#[test]
fn stored_eigenvalues_are_those_of_the_matrices() {
    let mut comparison = Comparison::new("stored moduli", 1e-11);
    let chosen = |r: &&Record| {
        let (order, valence, level) = (count(r, "order"), count(r, "valence"), count(r, "level"));
        (order <= 12 || valence == 3) && [3, 4, 7, 20].contains(&valence) && [1, 5].contains(&level)
    };
    for r in sweep().iter().filter(chosen) {
        let (order, valence) = (count(r, "order"), count(r, "valence"));
        let (u0, level) = (number(r, "u0"), count(r, "level"));
        let scheme = tension::<f64>(valence, order, u0).unwrap();
        let rings = scheme.closed_rings().unwrap();
        let spectrum = LocalSystem::new(scheme.level(level), rings)
            .unwrap()
            .eigenvalues()
            .unwrap();
        let listed = spectrum.eigenvalues.iter();
        let moduli: Vec<f64> = listed
            .flat_map(|e| std::iter::repeat_n(e.modulus(), e.multiplicity))
            .collect();
        for (rank, column) in ["lambda1", "lambda2", "lambda3"].into_iter().enumerate() {
            let expected = moduli.get(rank + 1).copied().unwrap_or(0.0);
            comparison.check(
                format!("k = {order}, N = {valence}, u0 = {u0}, l = {level}"),
                number(r, column),
                expected,
            );
        }
    }
    assert!(comparison.count() > 1000);
    comparison.finish();
}

#[test]
fn stored_eigenvalues_have_the_known_closed_forms() {
    let mut comparison = Comparison::new("closed forms", 1e-12);
    for r in sweep() {
        let (order, n, u) = (count(&r, "order"), count(&r, "valence"), number(&r, "u"));
        let c = (TAU / n as f64).cos();
        let label = format!("k = {order}, N = {n}, u = {u}");
        let mut check = |expected| comparison.check(&label, number(&r, "lambda1"), expected);
        if order == 3 {
            let n = n as f64;
            check(u * (n * u + 2.0 * n - 4.0 + 4.0 * c) / (n * (1.0 + u) * (1.0 + u)));
        } else if u == 1.0 && n == 4 {
            check(0.5);
        } else if u == 1.0 && order == 4 {
            check((c + 5.0 + ((c + 9.0) * (c + 1.0)).sqrt()) / 16.0);
        }
    }
    comparison.finish();
}

/// Eigenvalues move by at most 0.26 times the change of the tension (measured: 0.2500009, at order 3), so
/// that the ninth level agrees with the limit to as many digits as `u_9` agrees with 1.
#[test]
fn the_ninth_level_is_as_near_to_the_limit_as_its_tension() {
    let rows = sweep();
    let limit: BTreeMap<_, &Record> = rows
        .iter()
        .filter(|r| r["u0"] == "1")
        .map(|r| ((&r["order"], &r["valence"]), r))
        .collect();
    for r in rows.iter().filter(|r| r["level"] == "9") {
        let distance = (number(r, "u") - 1.0).abs();
        assert!(distance <= 2e-4, "{r:?}");
        for column in ["lambda1", "lambda2", "lambda3"] {
            let moved = (number(r, column) - number(limit[&(&r["order"], &r["valence"])], column)).abs();
            assert!(moved <= 0.26 * distance + 1e-12, "{column}: {r:?}");
        }
    }
}

#[test]
fn table_two_ends_at_stams_scheme() {
    let rows = stored("table2.csv");
    assert_eq!(rows.len(), 7 * 4 * 3);
    for r in &rows {
        let (lambda, mu) = (number(r, "lambda"), number(r, "mu"));
        assert!((number(r, "delta") - mu.ln() / lambda.ln()).abs() < 1e-12);
    }
    // Catmull-Clark: known to four digits (Ball and Storry 1988)
    let mut printed = Comparison::new("order 4 at u = 1, four digits", 5e-5);
    for (valence, lambda, mu) in [
        ("3", 0.4101, 0.1667),
        ("5", 0.5500, 0.3401),
        ("6", 0.5797, 0.4101),
        ("7", 0.5985, 0.4619),
    ] {
        let chosen = |r: &&Record| r["order"] == "4" && r["valence"] == valence && r["level"] != "1";
        for r in rows.iter().filter(chosen) {
            printed.check(format!("lambda, N = {valence}"), number(r, "lambda"), lambda);
            printed.check(format!("mu, N = {valence}"), number(r, "mu"), mu);
        }
    }
    assert_eq!(printed.count(), 16);
    printed.finish();
    // level 9 and the limit print the same four digits
    for pair in rows.chunks(3) {
        for column in ["lambda", "mu", "delta"] {
            assert!(
                (number(&pair[1], column) - number(&pair[2], column)).abs() < 1e-5,
                "{pair:?}"
            );
        }
    }
}

/// Eigenvectors: each stored mesh is reproduced by refinement, scaled by its eigenvalue, and its first point
/// is (1, 0).
#[test]
fn characteristic_meshes_are_eigenvectors() {
    for (name, orders) in [("meshes_even.csv", [4, 8]), ("meshes_odd.csv", [3, 7])] {
        let rows = stored(name);
        for order in orders {
            for valence in [3, 6, 13] {
                let of = |r: &&Record| count(r, "order") == order && count(r, "valence") == valence;
                let mesh: Vec<&Record> = rows.iter().filter(of).collect();
                let level = count(mesh[0], "level");
                let scheme = tension::<f64>(valence, order, number(mesh[0], "u0")).unwrap();
                let numbering = scheme.numbering(scheme.closed_rings().unwrap());
                assert_eq!(mesh.len(), numbering.count());
                let points: Vec<[f64; 2]> = mesh.iter().map(|r| [number(r, "x"), number(r, "y")]).collect();
                let first = 1 - order % 2;
                assert!((points[first][0] - 1.0).abs() < 1e-12 && points[first][1].abs() < 1e-12);
                let net = eigenring_scheme::PointNet { numbering, points };
                let refined = eigenring_scheme::refine(scheme.level(level), &net, &numbering.sites()).unwrap();
                let lambda = refined[first][0];
                for (a, b) in refined.iter().zip(&net.points) {
                    assert!((a[0] - lambda * b[0]).abs() < 1e-10 && (a[1] - lambda * b[1]).abs() < 1e-10);
                }
            }
        }
    }
}
