//! **Claim**: `spectrum --matrix` reads a matrix in whatever form it is written, finds its rotation in
//! whatever order its points are, and gives its eigenvalues and limit stencils. **Oracle**: closed forms, or
//! NumPy's dense eigenvalues, of matrices that separate code has written (`tests/data/matrices`).

#![allow(missing_docs)]

use crate::common::{Place, csv_rows, number};
use serde_json::Value;
use std::io::Write;
use std::process::Stdio;

/// The path of a stored matrix.
fn stored(name: &str) -> String {
    format!("{}/../../tests/data/matrices/{name}", env!("CARGO_MANIFEST_DIR"))
}

fn spectrum(place: &Place, rest: &str) -> Value {
    place.json(&format!("spectrum {rest}"))
}

/// Asserts the eigenvalues (re, im, how often), in any order, and their number.
fn has(found: &Value, expected: &[(f64, f64, u64)]) {
    let list = found["eigenvalues"].as_array().unwrap();
    let points = found["points"].as_u64().unwrap();
    assert_eq!(
        list.iter().map(|e| e["multiplicity"].as_u64().unwrap()).sum::<u64>(),
        points
    );
    assert_eq!(expected.iter().map(|e| e.2).sum::<u64>(), points);
    for &(re, im, times) in expected {
        let near = |e: &&Value| (number(e, "re") - re).hypot(number(e, "im") - im) < 2e-6;
        let count: u64 = list
            .iter()
            .filter(near)
            .map(|e| e["multiplicity"].as_u64().unwrap())
            .sum();
        assert_eq!(count, times, "{re} + {im} i: {list:?}");
    }
}

fn position(found: &Value) -> Vec<f64> {
    serde_json::from_value(found["limit_stencils"]["position"].clone()).unwrap()
}

fn close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() < 1e-6, "{found:?} is not {expected:?}");
    }
}

fn note(found: &Value, part: &str) {
    let notes = found["notes"].to_string();
    assert!(notes.contains(part), "{notes}");
}

#[test]
fn the_vertex_then_edges_then_faces() {
    let place = Place::new();
    let own = spectrum(&place, "--scheme catmull-clark -N 5");
    for valence in ["", "-N 5"] {
        let found = spectrum(&place, &format!("--matrix {} {valence}", stored("cc5_VEF.csv")));
        note(
            &found,
            "a rotation of order 5: 1 fixed point and 2 orbits, numbered by orbit, fixed points first",
        );
        let expected: Vec<(f64, f64, u64)> = own["eigenvalues"]
            .as_array()
            .unwrap()
            .iter()
            .map(|e| (number(e, "re"), number(e, "im"), e["multiplicity"].as_u64().unwrap()))
            .collect();
        for &(re, im, _) in &expected {
            let times = |list: &[(f64, f64, u64)]| -> u64 {
                list.iter()
                    .filter(|e| (e.0 - re).hypot(e.1 - im) < 1e-9)
                    .map(|e| e.2)
                    .sum()
            };
            let all: Vec<(f64, f64, u64)> = found["eigenvalues"]
                .as_array()
                .unwrap()
                .iter()
                .map(|e| (number(e, "re"), number(e, "im"), e["multiplicity"].as_u64().unwrap()))
                .collect();
            assert_eq!(times(&all), times(&expected), "{re}");
        }
        // Halstead, Kass and DeRose 1993: N^2 : 4 : 1
        let position = position(&found);
        close(&position[..2], &[0.5, 4.0 / 50.0]);
        close(&position[6..7], &[1.0 / 50.0]);
        // tangents are those of the scheme, point by point
        let tangent = |value: &Value, index: usize| value["limit_stencils"]["tangent_x"][index].as_f64().unwrap();
        for sector in 0..5 {
            assert!((tangent(&found, 1 + sector) - tangent(&own, 1 + 2 * sector)).abs() < 1e-9);
            assert!((tangent(&found, 6 + sector) - tangent(&own, 2 + 2 * sector)).abs() < 1e-9);
        }
    }
}

#[test]
fn loop_sqrt_three_mid_edge_and_valence_two() {
    let place = Place::new();
    // libigl 322, trimesh 1750: Loop's one ring; 3/8 + cos(2 pi/5)/4
    let lambda = 0.375 + 0.25 * (std::f64::consts::TAU / 5.0).cos();
    let last = 0.375 + 0.25 * (2.0 * std::f64::consts::TAU / 5.0).cos();
    let found = spectrum(&place, &format!("--matrix {} -N 5", stored("loop5.csv")));
    has(
        &found,
        &[(1.0, 0.0, 1), (lambda, 0.0, 2), (0.25, 0.0, 1), (last, 0.0, 2)],
    );
    close(&position(&found), &[0.5, 0.1, 0.1, 0.1, 0.1, 0.1]);
    let found = spectrum(&place, &format!("--matrix {}", stored("loop6.csv")));
    assert_eq!(found["valence"], 6);
    has(&found, &[(1.0, 0.0, 1), (0.5, 0.0, 2), (0.25, 0.0, 3), (0.125, 0.0, 1)]);

    // Kobbelt 2000, one step: each complex value once, with its conjugate in the block opposite
    let found = spectrum(&place, &format!("--matrix {} -N 6", stored("sqrt3_6.csv")));
    let (a, b) = (3f64.sqrt() / 6.0, 1.0 / 6.0);
    has(
        &found,
        &[
            (1.0, 0.0, 1),
            (0.5, a, 1),
            (0.5, -a, 1),
            (b, a, 1),
            (b, -a, 1),
            (1.0 / 3.0, 0.0, 1),
            (0.0, 0.0, 1),
        ],
    );
    // Peters and Reif 1997, one step
    let found = spectrum(&place, &format!("--matrix {} -N 5", stored("midedge1_5.csv")));
    let (re, im) = (0.6545084971874737, 0.4755282581475768);
    let list = found["eigenvalues"].as_array().unwrap();
    let blocks: Vec<&Value> = list
        .iter()
        .filter(|e| (number(e, "re") - re).abs() < 1e-12)
        .map(|e| &e["fourier"])
        .collect();
    assert_eq!(blocks, [1, 4]);
    assert!(
        list.iter().any(|e| (number(e, "im") - im).abs() < 1e-12)
            && (number(&found, "subdominant") - 0.8090).abs() < 1e-4
    );
    note(&found, "the subdominant eigenvalues are complex");
    // the tangent plane comes from the complex left vector: here discrete Fourier modes
    let x: Vec<f64> = serde_json::from_value(found["limit_stencils"]["tangent_x"].clone()).unwrap();
    let cosines: Vec<f64> = (0..5)
        .map(|s| 0.4 * (std::f64::consts::TAU * f64::from(s) / 5.0).cos())
        .collect();
    close(&x, &cosines);

    // OpenSubdiv 315: two quadrilaterals that share two edges
    for valence in ["", "-N 2"] {
        let found = spectrum(&place, &format!("--matrix {} {valence}", stored("cc2.csv")));
        assert_eq!(found["valence"], 2);
        has(
            &found,
            &[(1.0, 0.0, 1), (0.25, 0.0, 2), (-0.25, 0.0, 1), (0.125, 0.0, 1)],
        );
        close(
            &position(&found),
            &[2.0 / 7.0, 2.0 / 7.0, 1.0 / 14.0, 2.0 / 7.0, 1.0 / 14.0],
        );
        assert!(found["limit_stencils"]["tangent_x"].is_array(), "{found}");
    }
}

#[test]
fn without_a_rotation() {
    let place = Place::new();
    // Huang and others 2010: four corners with weights of their own
    let found = spectrum(&place, &format!("--matrix {}", stored("eds4.csv")));
    note(&found, "no rotation was found");
    has(&found, &[(1.0, 0.0, 1), (0.5, 0.0, 2), (0.25, 0.0, 1)]);
    close(&position(&found), &[4.0 / 15.0, 1.0 / 3.0, 1.0 / 6.0, 7.0 / 30.0]);
    assert!(found["valence"].is_null() && found["eigenvalues"][0]["fourier"].is_null());
    // eigenvectors of the list's eigenvalues, by what they are
    let text = std::fs::read_to_string(stored("eds4.csv")).unwrap();
    let matrix: Vec<Vec<f64>> = text
        .lines()
        .map(|line| line.split(',').map(|entry| entry.parse().unwrap()).collect())
        .collect();
    for (e, vectors) in found["eigenvalues"]
        .as_array()
        .unwrap()
        .iter()
        .zip(found["right"].as_array().unwrap())
    {
        assert_eq!(
            vectors.as_array().unwrap().len() as u64,
            e["geometric"].as_u64().unwrap()
        );
        for vector in vectors.as_array().unwrap() {
            let v: Vec<f64> = vector
                .as_array()
                .unwrap()
                .iter()
                .map(|entry| entry[0].as_f64().unwrap())
                .collect();
            for (row, value) in matrix.iter().zip(&v) {
                let image: f64 = row.iter().zip(&v).map(|(s, v)| s * v).sum();
                assert!((image - number(e, "re") * value).abs() < 1e-9);
            }
        }
    }
    // a Jordan block: 1/4 twice with one eigenvector
    place.write("j.txt", "[1 0 0; 1/2 1/4 1/4; 1/2 0 1/2]\n");
    place.write("k.txt", "1/4 1 0\n0 1/4 0\n3/8 -3/8 1\n");
    let found = spectrum(&place, "--matrix k.txt");
    let defective = &found["eigenvalues"][1];
    assert_eq!(
        (defective["multiplicity"].as_u64(), defective["geometric"].as_u64()),
        (Some(2), Some(1))
    );
    assert_eq!(defective["jordan"], "2");
    // a curve's matrix, in text
    let text = place.ok(&["spectrum", "--matrix", "j.txt"]);
    assert!(text.contains("note: no rotation was found"), "{text}");
    // limit stencils as CSV, all corners
    let file = stored("eds4.csv");
    let csv = place.ok(&[
        "spectrum",
        "--matrix",
        &file,
        "--table",
        "limit-stencils",
        "--format",
        "csv",
    ]);
    let weights: Vec<f64> = csv_rows(&csv)
        .iter()
        .map(|row| row["position"].parse().unwrap())
        .collect();
    close(&weights, &[4.0 / 15.0, 1.0 / 3.0, 1.0 / 6.0, 7.0 / 30.0]);
    let csv = place.ok(&[
        "spectrum",
        "--scheme",
        "catmull-clark",
        "-N",
        "5",
        "--table",
        "limit-stencils",
        "--format",
        "csv",
    ]);
    let weights: Vec<f64> = csv_rows(&csv)
        .iter()
        .map(|row| row["position"].parse().unwrap())
        .collect();
    assert!(weights.len() == 11 && (weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    // a valence that is given must be one of the matrix
    let run = place.run(&["spectrum", "--matrix", &stored("eds4.csv"), "-N", "4"]);
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr.contains("no rotation of order 4") && run.stderr.contains("accepted is no -N"),
        "{}",
        run.stderr
    );
}

#[test]
fn every_form_of_the_same_matrix() {
    let place = Place::new();
    let own = spectrum(&place, "--scheme catmull-clark -N 5");
    for format in ["mtx", "npy", "csv", "json"] {
        let file = format!("S.{format}");
        place.ok(&["matrix", "--scheme", "catmull-clark", "-N", "5", "-o", &file]);
    }
    // known by their content, and not by their names
    std::fs::rename(place.path().join("S.npy"), place.path().join("S.dat")).unwrap();
    let files = ["S.mtx", "S.dat", "S.csv", "S.json"].map(str::to_owned).into_iter();
    let stored = ["cc5_comment.csv", "cc5_dexp.csv", "cc5_semicolon.csv", "cc5_space.txt"].map(stored);
    for file in files.chain(stored) {
        let found = spectrum(&place, &format!("--matrix {file}"));
        assert_eq!(
            (found["valence"].as_u64(), found["rings"].as_u64()),
            (Some(5), Some(1)),
            "{file}"
        );
        assert!(
            (number(&found, "subdominant") - number(&own, "subdominant")).abs() < 1e-12,
            "{file}"
        );
    }
    // from standard input
    let mut child = place
        .command(&["spectrum", "--matrix", "-", "--format", "json"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child
        .stdin
        .take()
        .unwrap()
        .write_all(place.read("S.mtx").as_bytes())
        .unwrap();
    let output = child.wait_with_output().unwrap();
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!((number(&found, "subdominant") - number(&own, "subdominant")).abs() < 1e-12);
}

#[test]
fn numberings_and_single_precision() {
    let place = Place::new();
    let own = spectrum(&place, "--scheme doo-sabin:uniform -N 6");
    place.ok(&[
        "matrix",
        "--scheme",
        "catmull-clark",
        "-N",
        "6",
        "-o",
        "S.csv",
        "--numbering",
        "points.csv",
    ]);
    // shuffled: what no usual order explains, the numbering does
    let matrix: Vec<Vec<String>> = place
        .read("S.csv")
        .lines()
        .map(|line| line.split(',').map(str::to_owned).collect())
        .collect();
    let order = [5, 0, 12, 3, 7, 1, 9, 2, 11, 4, 8, 6, 10];
    let rows: Vec<String> = order
        .iter()
        .map(|&i| {
            order
                .iter()
                .map(|&j| matrix[i][j].as_str())
                .collect::<Vec<_>>()
                .join(" ")
        })
        .collect();
    place.write("shuffled.txt", rows.join("\n"));
    let points: Vec<String> = place.read("points.csv").lines().map(str::to_owned).collect();
    let shuffled: Vec<&str> = std::iter::once(points[0].as_str())
        .chain(order.iter().map(|&i| points[i + 1].as_str()))
        .collect();
    place.write("shuffled.csv", shuffled.join("\n"));
    note(&spectrum(&place, "--matrix shuffled.txt"), "no rotation was found");
    let found = spectrum(&place, "--matrix shuffled.txt --numbering shuffled.csv");
    assert_eq!(found["valence"], 6);
    let lambda = number(&spectrum(&place, "--scheme catmull-clark -N 6"), "subdominant");
    assert!((number(&found, "subdominant") - lambda).abs() < 1e-12);
    // N x N in single precision: the mean is taken, and how far it is off is said
    place.ok(&["matrix", "--scheme", "doo-sabin:uniform", "-N", "6", "-o", "D.csv"]);
    let noisy = |entry: &str| format!("{}", entry.parse::<f64>().unwrap() as f32);
    let rows: Vec<String> = place
        .read("D.csv")
        .lines()
        .enumerate()
        .map(|(i, line)| {
            let shift = if i == 2 { 1.000001 } else { 1.0 };
            let scaled = |entry: &str| noisy(&format!("{}", entry.parse::<f64>().unwrap() * shift));
            line.split(',').map(scaled).collect::<Vec<_>>().join(",")
        })
        .collect();
    place.write("D32.csv", rows.join("\n"));
    let run = place.run(&["spectrum", "--matrix", "D32.csv", "--format", "json"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stderr.contains("their means were taken"), "{}", run.stderr);
    let found: Value = serde_json::from_str(&run.stdout).unwrap();
    assert!((number(&found, "subdominant") - number(&own, "subdominant")).abs() < 1e-6);
    // curves: a point list in each form
    for (name, text) in [
        ("a.txt", "0 0\n1 0\n1 1\n0 1\n"),
        ("b.csv", "x;y\n0;0\n1;0\n1;1\n0;1\n"),
        ("c.json", "[[0,0],[1,0],[1,1],[0,1]]"),
    ] {
        place.write(name, text);
        let csv = place.ok(&["curve", name, "--closed", "--format", "csv"]);
        assert_eq!(
            csv,
            place.ok(&["curve", "a.txt", "--closed", "--format", "csv"]),
            "{name}"
        );
    }
}
