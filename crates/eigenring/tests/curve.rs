//! Curves: refinement and limits against closed forms and hand-made masks; files, pictures, and what is
//! refused.

#![allow(missing_docs)]

use crate::common::{Place, csv_rows, files, has_fields, number};
use serde_json::Value;

const SQUARE: &str = "x,y\n1,1\n-1,1\n-1,-1\n1,-1\n";
const POLYGON: &str = "0,0\n1,2\n3,3\n5,1\n6,-1\n8,0\n9,2\n";

fn run(place: &Place, line: &str) -> String {
    place.ok(&line.split_whitespace().collect::<Vec<_>>())
}

/// Exit code 2, one line, nothing on standard output; the text after "accepted".
fn refused(place: &Place, line: &str) -> (String, String) {
    let arguments: Vec<&str> = line.split_whitespace().collect();
    let run = place.run(&arguments);
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{line}: {}", run.stderr);
    assert_eq!(run.stderr.lines().count(), 1, "{line}: {}", run.stderr);
    let json = place.run(&[&arguments[..], &["--format", "json"]].concat());
    let object: Value = serde_json::from_str(&json.stderr).unwrap();
    let accepted = object["accepted"].as_str().unwrap_or_default().to_owned();
    (run.stderr, accepted)
}

fn coordinates(row: &std::collections::BTreeMap<String, String>, names: &[&str]) -> Vec<f64> {
    names.iter().map(|name| row[*name].parse().unwrap()).collect()
}

#[test]
fn a_square_becomes_the_unit_circle() {
    let place = Place::new();
    place.write("square.csv", SQUARE);
    let u0 = 0.5_f64.sqrt();
    let line = format!("curve square.csv --order 3 --u0 {u0} --closed --levels 9 -o points.csv --limit limit.csv");
    let summary = place.json(&line);
    has_fields(&summary, "order u0 ends control_points coordinates from to levels");
    assert_eq!(
        (summary["ends"].as_str(), number(&summary, "to")),
        (Some("closed"), 4.0)
    );
    let limit = csv_rows(&place.read("limit.csv"));
    assert_eq!(limit.len(), 4 * 16 + 1);
    for row in &limit {
        let p = coordinates(row, &["x", "y"]);
        assert!((p[0].hypot(p[1]) - 1.0).abs() < 1e-15, "{row:?}");
    }
    // the tangents of refined points are within their angle squared
    let points = csv_rows(&place.read("points.csv"));
    assert_eq!(points.len(), 4 << 9);
    for row in &points {
        let p = coordinates(row, &["x", "y"]);
        let angle = std::f64::consts::TAU / points.len() as f64;
        assert!((p[0].hypot(p[1]) - 1.0).abs() < angle * angle, "{row:?}");
        assert_eq!(row["level"], "9");
    }
}

#[test]
fn one_level_of_the_cubic_is_its_masks() {
    let place = Place::new();
    place.write("points.csv", POLYGON);
    let found = place.json("curve points.csv --levels 1 --all-levels");
    let rows = found["points"].as_array().unwrap();
    let level = |level: u64| -> Vec<(f64, [f64; 2])> {
        let of = rows.iter().filter(|row| row["level"] == level);
        of.map(|row| (number(row, "parameter"), [number(row, "x"), number(row, "y")]))
            .collect()
    };
    let (control, refined) = (level(0), level(1));
    assert_eq!((control.len(), refined.len()), (7, 2 * 7 - 3));
    // uniform cubic B-splines: (1, 6, 1)/8 at a point, the middle between points
    for (t, point) in refined {
        let i = t.floor() as usize;
        for axis in 0..2 {
            let p = |i: usize| control[i].1[axis];
            let expected = match t.fract() {
                0.0 => (p(i - 1) + 6.0 * p(i) + p(i + 1)) / 8.0,
                0.5 => (p(i) + p(i + 1)) / 2.0,
                other => panic!("parameter {other}"),
            };
            assert!((point[axis] - expected).abs() < 1e-15, "{t}: {point:?}");
        }
    }
}

#[test]
fn refined_points_tend_to_the_limit_at_their_parameters() {
    let place = Place::new();
    place.write("points.csv", POLYGON);
    for (order, u0) in [(3, 0.1), (4, 10.0), (5, -0.5), (7, 1.0)] {
        run(
            &place,
            &format!("curve points.csv --order {order} --u0 {u0} --levels 12 -o points.out --limit limit.csv"),
        );
        let points: Vec<Vec<f64>> = csv_rows(&place.read("points.out"))
            .iter()
            .map(|row| coordinates(row, &["parameter", "x", "y"]))
            .collect();
        let limit = csv_rows(&place.read("limit.csv"));
        assert!(limit.len() > 16);
        for row in limit {
            let at = coordinates(&row, &["parameter", "x", "y"]);
            let nearest = points
                .iter()
                .min_by(|a, b| (a[0] - at[0]).abs().total_cmp(&(b[0] - at[0]).abs()));
            let nearest = nearest.unwrap();
            // half a step of 2^-12 along a curve whose speed is below 100
            let distance = (nearest[1] - at[1]).hypot(nearest[2] - at[2]);
            assert!(
                distance < 100.0 * 2.0_f64.powi(-13),
                "{order} {u0}: {at:?}, {nearest:?}"
            );
        }
    }
}

#[test]
fn examples_are_exact() {
    let place = Place::new();
    for (example, bound) in [
        ("circle", 1e-14),
        ("ellipse", 1e-14),
        ("line", 1e-14),
        ("parabola", 1e-13),
        ("hyperbola", 1e-13),
        ("helix", 1e-13),
        ("fang-fig1", 1e-12),
    ] {
        let found = place.json(&format!("curve --example {example}"));
        let deviation = number(&found, "deviation");
        assert!((0.0..bound).contains(&deviation), "{example}: {deviation}");
        assert!(found["points"].as_array().unwrap().len() > 20);
    }
    // a curve of the same space: another number of points has another tension, the same circle
    let found = place.json("curve --example circle --count 40 --order 9 --samples 3");
    assert!((number(&found, "u0") - (std::f64::consts::PI / 40.0).cos()).abs() < 1e-15);
    assert!(number(&found, "deviation") < 1e-12);
    // tables say it on standard error
    let run = place.run(&["curve", "--example", "circle", "--format", "csv"]);
    assert!(run.stderr.starts_with("note: the limit is within"), "{}", run.stderr);
    assert!(run.stdout.starts_with("level,parameter,x,y\n3,"), "{}", run.stdout);
}

#[test]
fn surfaces_of_revolution() {
    let place = Place::new();
    let found = place.json("curve --example hyperbola --revolve --segments 5 --levels 2 --samples 8");
    assert!(number(&found, "deviation") < 1e-13, "{}", number(&found, "deviation"));
    let rows = found["points"].as_array().unwrap();
    has_fields(&rows[0], "level u v x y z");
    let line = "curve --example line --order 4 --revolve --levels 1 --obj cone.obj -o cone.csv --plot cone.svg";
    run(&place, line);
    let obj = place.read("cone.obj");
    let (points, faces): (Vec<&str>, Vec<&str>) = obj.lines().partition(|line| line.starts_with("v "));
    // 8 points in an open direction give 2 * 8 - 3, 4 around the axis 8
    assert_eq!((points.len(), faces.len()), (13 * 8, 12 * 8));
    assert_eq!(csv_rows(&place.read("cone.csv")).len(), points.len());
    for face in faces {
        let corners: Vec<usize> = face.split(' ').skip(1).map(|i| i.parse().unwrap()).collect();
        assert!(
            corners.len() == 4 && corners.iter().all(|&i| (1..=points.len()).contains(&i)),
            "{face}"
        );
    }
    assert!(place.read("cone.svg").starts_with("<svg"));
}

#[test]
fn pictures_of_one_to_three_coordinates() {
    let place = Place::new();
    place.write("graph.csv", "height\n1\n4\n2\n5\n3\n");
    place.write("plane.csv", POLYGON);
    place.write("space.csv", "0,0,0\n1,2,1\n2,0,3\n4,1,2\n5,3,0\n");
    place.write("many.csv", "0,0,0,1\n1,2,1,2\n2,0,3,3\n4,1,2,4\n");
    for name in ["graph", "plane", "space"] {
        for size in ["one", "two"] {
            run(&place, &format!("curve {name}.csv --plot {name}.svg --size {size}"));
            assert!(place.read(&format!("{name}.svg")).contains("order 4"), "{name}");
        }
    }
    run(&place, "curve plane.csv --plot plane.PNG --dpi 50");
    let png = std::fs::read(place.path().join("plane.PNG")).unwrap();
    assert!(png.starts_with(b"\x89PNG"));
    let header = run(&place, "curve many.csv --format csv");
    assert!(header.starts_with("level,parameter,x1,x2,x3,x4\n"));
    assert_eq!(refused(&place, "curve many.csv --plot many.svg").1, "1 to 3");
    for bad in ["curve.tif", "curve", "svg"] {
        let (_, accepted) = refused(&place, &format!("curve plane.csv --plot {bad}"));
        assert!(accepted.contains(".svg"), "{accepted}");
    }
}

#[test]
fn bad_input_is_refused() {
    let place = Place::new();
    place.write("points.csv", POLYGON);
    for (option, accepted) in [
        ("--order 2 --u0 0.5", "u0 = 1"),
        ("--ends clamped --u0 2", "u0 = 1"),
        ("--order 33", "2 to 32"),
        ("--order -4", "2 to 32"),
        ("--order x", "2 to 32"),
        ("--u0 -1", "u0 > -1"),
        ("--u0 -1.5", "u0 > -1"),
        ("--u0 NaN", "u0 > -1"),
        ("--u0 inf", "u0 > -1"),
        ("--levels 99", "0 to 17 for 7 control points"),
        ("--levels 99999999999999999999999", "a whole number"),
        (
            "--limit limit.csv --samples 0",
            "1 to 262144 per interval for 4 intervals",
        ),
        ("--revolve --segments 2", "3 to 64"),
        ("--revolve --levels 30", "0 to 7 for 28 control points"),
    ] {
        let (message, found) = refused(&place, &format!("curve points.csv {option}"));
        assert_eq!(found, accepted, "{option}: {message}");
    }
    for (text, part) in [
        ("", "0 control points"),
        ("x,y\n", "0 control points"),
        ("1,2\n3,4\n5,6\n", "3 control points"),
        ("1,2\n3,4\n5,six\n", "line 3, column 2: 'six'"),
        ("1,2\n3,inf\n", "line 2, column 2: 'inf'"),
        ("1,2\n3\n", "line 2 has 1 columns"),
    ] {
        place.write("bad.csv", text);
        let (message, _) = refused(&place, "curve bad.csv");
        assert!(
            message.starts_with("error: bad.csv: ") && message.contains(part) && message.contains("accepted"),
            "{text:?}: {message}"
        );
    }
    place.write("bad.csv", [0xff, 0xfe, 0x00]);
    for line in [
        "curve bad.csv",
        "curve missing.csv",
        "curve .",
        "curve",
        "curve points.csv --closed --open",
        "curve points.csv --example circle",
        "curve --example circle --closed",
        "curve --example square",
        "curve points.csv --count 7",
        "curve points.csv --obj surface.obj",
        "curve points.csv --limit same.csv -o same.csv",
        "curve --example circle --u0 0.5",
        "curve --example circle --count 65",
        "curve --example hyperbola --u0 0.5",
        "curve --example line --order 3 --u0 2",
        "curve points.csv --plot curve.png --dpi 1",
    ] {
        refused(&place, line);
    }
    assert_eq!(files(place.path()).len(), 2);
    // a file in the place of a folder
    for option in [
        "-o points.csv/x.csv",
        "--limit points.csv/x.csv",
        "--plot points.csv/x.svg",
        "-o .",
    ] {
        let (message, _) = refused(&place, &format!("curve points.csv {option}"));
        assert!(message.contains("cannot write"), "{option}: {message}");
    }
    assert_eq!(place.read("points.csv"), POLYGON);
}

#[test]
fn polygons_that_overflow_are_refused() {
    let place = Place::new();
    place.write("huge.csv", "1e308\n-1e308\n1e308\n-1e308\n");
    let (message, accepted) = refused(&place, "curve huge.csv --order 3 --u0 -0.999999 --closed");
    assert_eq!(accepted, "finite numbers", "{message}");
}
