//! Schemes with knot intervals as users run them: files in and out, and what is refused.

use crate::common::{Place, number};

/// Two by two quads, and a cube.
fn place() -> Place {
    let place = Place::new();
    let points = (0..9).map(|k| format!("v {} {} {}\n", k % 3, k / 3, k % 2));
    let faces = "f 1 2 5 4\nf 2 3 6 5\nf 4 5 8 7\nf 5 6 9 8\n";
    place.write("grid.obj", points.collect::<String>() + faces);
    place.ok(&["make", "cube", "-o", "cube.obj"]);
    place.write(
        "hexagon.obj",
        "v 2 0 0\nv 1 2 0\nv -1 2 0\nv -2 0 0\nv -1 -2 0\nv 1 -2 0\nf 1 2 3 4 5 6\n",
    );
    place
}

fn with(place: &Place, name: &str, to: &str, lines: &str) {
    let text = place.read(name) + lines;
    place.write(to, text);
}

/// Two OBJ files are of one mesh, whatever the numbers of its points: as many lines of each kind, and edges
/// with the same intervals and middles.
fn agree(a: &str, b: &str) {
    let kind = |text: &str, kind: &str| text.lines().filter(|line| line.starts_with(kind)).count();
    for line in ["v ", "f ", "t knot "] {
        assert_eq!(kind(a, line), kind(b, line), "lines {line}");
    }
    let edges = |text: &str| -> Vec<[f64; 4]> {
        let numbers = |line: &str, first: usize| -> Vec<f64> {
            let words = line.split_whitespace().skip(first);
            words.map(|word| word.parse().unwrap()).collect()
        };
        let lines = |kind: &'static str| text.lines().filter(move |line| line.starts_with(kind));
        let points: Vec<Vec<f64>> = lines("v ").map(|line| numbers(line, 1)).collect();
        let edge = |line: &str| {
            let knot = numbers(line, 3);
            let [from, to] = [0, 1].map(|end| &points[knot[end] as usize]);
            let middle = |k: usize| (from[k] + to[k]) / 2.0;
            [middle(0), middle(1), middle(2), knot[2]]
        };
        lines("t knot ").map(edge).collect()
    };
    let (a, b) = (edges(a), edges(b));
    for (these, those) in [(&a, &b), (&b, &a)] {
        for edge in these {
            let gap = |other: &[f64; 4]| edge.iter().zip(other).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
            assert!(those.iter().any(|other| gap(other) < 1e-14), "{edge:?}");
        }
    }
}

#[test]
fn intervals_are_read_and_written_again() {
    let place = place();
    with(
        &place,
        "grid.obj",
        "tags.obj",
        "t knot 2/1/0 0 1 2\nt knot 2/1/0 4 7 0.5\n",
    );
    place.write("knots.csv", "v0,v1,d\n0,1,2\n4,7,0.5\n");
    for scheme in ["nurss", "eigen-polyhedron", "hnuss"] {
        place.ok(&[
            "subdivide",
            "tags.obj",
            "--scheme",
            scheme,
            "--levels",
            "2",
            "-o",
            "a.obj",
        ]);
        let from_csv = ["subdivide", "grid.obj", "--knots", "knots.csv", "--scheme", scheme];
        place.ok(&[&from_csv[..], &["--levels", "1", "-o", "b.obj"]].concat());
        // what is written is what goes on
        place.ok(&["subdivide", "b.obj", "--scheme", scheme, "--levels", "1", "-o", "c.obj"]);
        let (at_once, again) = (place.read("a.obj"), place.read("c.obj"));
        match scheme {
            "hnuss" => agree(&at_once, &again),
            _ => assert_eq!(at_once, again, "{scheme}"),
        }
        assert!(
            place.read("b.obj").contains("t knot 2/1/0 0 9 1.0\n"),
            "{}",
            place.read("b.obj")
        );
    }
    // hybrid nets with n-gons go on from any level, and are evaluated as they are
    with(
        &place,
        "cube.obj",
        "uneven.obj",
        "t knot 2/1/0 0 1 2\nt knot 2/1/0 0 3 0.7\n",
    );
    let subdivide = |from: &str, levels: &str, to: &str| {
        place.ok(&["subdivide", from, "--scheme", "hnuss", "--levels", levels, "-o", to]);
    };
    // the first level of eigen-polyhedra is that of NURSS, and others are not
    for (first, rest) in [("1", "2"), ("2", "1")] {
        let subdivide = |from: &str, levels: &str, to: &str| {
            place.ok(&[
                "subdivide",
                from,
                "--scheme",
                "eigen-polyhedron",
                "--levels",
                levels,
                "-o",
                to,
            ]);
        };
        subdivide("uneven.obj", "3", "at-once.obj");
        subdivide("uneven.obj", first, "first.obj");
        assert!(place.read("first.obj").contains(&format!("t levels 1/0/0 {first}\n")));
        subdivide("first.obj", rest, "again.obj");
        assert_eq!(place.read("at-once.obj"), place.read("again.obj"));
    }
    with(&place, "hexagon.obj", "later.obj", "t levels 1/0/0 1\n");
    let run = place.run(&["subdivide", "later.obj", "--scheme", "eigen-polyhedron"]);
    assert!(
        run.code == Some(2) && run.stderr.contains("face of 6 corners"),
        "{}",
        run.stderr
    );
    subdivide("uneven.obj", "3", "at-once.obj");
    for (first, rest) in [("0", "3"), ("1", "2"), ("2", "1")] {
        subdivide("uneven.obj", first, "first.obj");
        subdivide("first.obj", rest, "again.obj");
        agree(&place.read("at-once.obj"), &place.read("again.obj"));
    }
    place.write("p.csv", "face,sub,s,t\n0,0,0.25,0.5\n");
    let at = |file: &str| {
        place.ok(&[
            "limit", file, "--scheme", "hnuss", "--points", "p.csv", "--format", "csv",
        ])
    };
    subdivide("uneven.obj", "0", "first.obj");
    assert_eq!(at("uneven.obj"), at("first.obj"));
    // level 0 of HNUSS is the hybrid net
    let net = place.json("subdivide cube.obj --scheme hnuss --levels 0");
    assert_eq!((number(&net, "vertices"), number(&net, "faces")), (24.0, 26.0));
    // weights are homogeneous, and written again
    let weighted = place.read("grid.obj").replacen("v 1 1 0", "v 1 1 0 5", 1);
    assert!(weighted.contains("v 1 1 0 5"));
    place.write("weights.obj", weighted);
    place.ok(&["subdivide", "weights.obj", "--scheme", "hnuss", "-o", "w.obj"]);
    let first = place.read("w.obj").lines().nth(4).unwrap().to_owned();
    // the middle vertex: (5 * 36 + 6 * 4 + 1 * 4)/64
    let weight: f64 = first.split(' ').nth(4).unwrap().parse().unwrap();
    assert!((weight - 208.0 / 64.0).abs() < 1e-15, "{first}");
}

#[test]
fn what_has_no_rule_is_refused_with_the_element() {
    let place = place();
    let refused = |file: &str, scheme: &str, words: &[&str]| {
        let run = place.run(&["subdivide", file, "--scheme", scheme, "--levels", "2"]);
        assert_eq!(run.code, Some(2), "{file} {scheme}: {}", run.stdout);
        assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
        for word in words {
            assert!(run.stderr.contains(word), "{word}: {}", run.stderr);
        }
    };
    let knot = |a: u32, b: u32, d: &str| format!("t knot 2/1/0 {a} {b} {d}\n");
    let cases: [(&str, String, &str, &[&str]); 11] = [
        ("grid.obj", knot(0, 1, "-1"), "nurss", &["line 14", "-1"]),
        ("grid.obj", knot(0, 1, "nan"), "nurss", &["line 14"]),
        ("grid.obj", knot(0, 1, "inf"), "hnuss", &["line 14"]),
        (
            "grid.obj",
            knot(0, 1, "1") + &knot(6, 7, "2"),
            "hnuss",
            &["0-1 (1)", "6-7 (2)"],
        ),
        (
            "grid.obj",
            knot(0, 1, "1") + &knot(0, 1, "2"),
            "hnuss",
            &["line 15", "0-1"],
        ),
        ("grid.obj", knot(0, 8, "1"), "eigen-polyhedron", &["0-8"]),
        (
            "grid.obj",
            "t extraordinary 1/0/0 1\n".to_owned(),
            "hnuss",
            &["vertex 1", "boundary"],
        ),
        (
            "grid.obj",
            "t crease 2/1/0 3 4 1\n".to_owned(),
            "hnuss",
            &["vertex 3", "crease"],
        ),
        (
            "grid.obj",
            "v 5 5 5\nv 5 6 5\nf 3 2 10 11\n".to_owned(),
            "hnuss",
            &["vertex 1", "boundary"],
        ),
        (
            "cube.obj",
            knot(0, 1, "0") + &knot(0, 3, "0") + &knot(0, 4, "0"),
            "hnuss",
            &["vertex"],
        ),
        ("cube.obj", knot(0, 1, "1e5"), "eigen-polyhedron", &["vertex 0", "9.62"]),
    ];
    for (from, lines, scheme, words) in cases {
        with(&place, from, "bad.obj", &lines);
        refused("bad.obj", scheme, words);
    }
    // an odd face with unequal intervals, and one with equal ones
    place.ok(&["make", "tetrahedron", "-o", "t.obj"]);
    with(&place, "t.obj", "bad.obj", &knot(0, 1, "2"));
    refused("bad.obj", "nurss", &["face 0", "0-1 (2)"]);
    place.ok(&["subdivide", "t.obj", "--scheme", "hnuss"]);
    // weights
    place.write("bad.obj", place.read("grid.obj").replacen("v 1 1 0", "v 1 1 0 -5", 1));
    refused("bad.obj", "hnuss", &["vertex 4", "-5"]);
    // where the eigen-polyhedron does not exist, the simple rule may be asked for
    with(&place, "cube.obj", "far.obj", &knot(0, 1, "1e5"));
    refused("far.obj", "hnuss", &["eigen-polyhedron"]);
    let run = place.run(&["subdivide", "far.obj", "--scheme", "hnuss", "--outside", "simple"]);
    assert!(
        run.code == Some(0) && run.stderr.contains("simple rule"),
        "{}",
        run.stderr
    );
    // options without effect
    for bad in [
        "subdivide cube.obj --scheme hnuss --boundary corner",
        "subdivide cube.obj --scheme nurss --outside simple",
        "subdivide cube.obj --scheme catmull-clark --knots knots.csv",
        "spectrum --scheme hnuss --knots 1,2,3 -N 4",
        "spectrum --scheme hnuss --knots 1,2,-3",
        "spectrum --scheme hnuss --knots 0,1,0,1,1",
        "spectrum --scheme eigen-polyhedron --knots 10,1,10,1,10,1",
        "render cube.obj --schemes hnuss --show gauss -o a.png",
        "render cube.obj --schemes catmull-clark --knots knots.csv -o a.png",
        "spectrum --scheme hnuss --knots 1,1e308,1e308,1,1",
        "verify --scheme hnuss:simple --knots 1,1e-70,1",
        "plot characteristic-map --knots 1,2,-3 -o a.png",
        "plot spectrum --knots 1,2,3 -o a.png",
        "plot characteristic-map --knots 1,2,3 -N 4 -o a.png",
        "plot blending-functions --schemes catmull-clark -o a.png",
    ] {
        let arguments: Vec<&str> = bad.split(' ').collect();
        let run = place.run(&arguments);
        assert_eq!(
            (run.code, run.stderr.lines().count()),
            (Some(2), 1),
            "{bad}: {}",
            run.stderr
        );
    }
}

/// Messages are in the numbers of the file: intervals that levels have halved, vertices that faces have
/// become, and vertices after unused ones.
#[test]
fn messages_name_what_was_given() {
    let place = place();
    // the middle of a hexagon becomes an extraordinary vertex with its intervals
    let knots = "t knot 2/1/0 0 1 10\nt knot 2/1/0 2 3 10\nt knot 2/1/0 4 5 10\n";
    with(&place, "hexagon.obj", "hexagon.obj", knots);
    // the same cube after an unused vertex
    let cube = place.read("cube.obj");
    let moved = cube.lines().map(|line| match line.strip_prefix("f ") {
        Some(corners) => {
            let corners = corners.split(' ').map(|corner| corner.parse::<u32>().unwrap() + 1);
            format!(
                "f {}\n",
                corners.map(|corner| corner.to_string()).collect::<Vec<_>>().join(" ")
            )
        }
        None => format!("{line}\n"),
    });
    let moved = "v 9 9 9\n".to_owned() + &moved.collect::<String>();
    place.write("far.obj", moved.clone() + "t knot 2/1/0 1 2 1e5\n");
    place.write("none.obj", moved.clone() + "t knot 2/1/0 0 2 1\n");
    place.write("two.obj", moved + "t knot 2/1/0 1 2 3\nt knot 2/1/0 5 6 4\n");
    let cases = [
        (
            "blending --knots 10,1,1,10,1",
            "for the intervals [10.0, 1.0, 1.0, 10.0, 1.0]",
        ),
        ("blending --knots 0,1,0,1,1 --schemes nurss", "spokes 0 and 2"),
        (
            "subdivide hexagon.obj --scheme eigen-polyhedron --levels 3",
            "at the middle of face 0 for the intervals [10.0, 1.0, 10.0, 1.0, 10.0, 1.0]",
        ),
        (
            "subdivide hexagon.obj --scheme hnuss",
            "at the middle of face 0 for the intervals [10.0,",
        ),
        (
            "subdivide far.obj --scheme eigen-polyhedron --levels 3",
            "at vertex 1 for the intervals",
        ),
        ("subdivide none.obj --scheme nurss", "edge 0-2"),
        ("subdivide two.obj --scheme hnuss", "edges 1-2 (3) and 5-6 (4)"),
    ];
    for (line, words) in cases {
        let run = place.run(&line.split(' ').collect::<Vec<_>>());
        let last = run.stderr.lines().last().unwrap_or_default();
        assert!(
            run.code == Some(2) && last.starts_with("error: "),
            "{line}: {}",
            run.stderr
        );
        assert!(last.contains(words), "{line}: {}", run.stderr);
    }
    let run = place.run(&["subdivide", "hexagon.obj", "--scheme", "hnuss", "--outside", "simple"]);
    assert!(
        run.code == Some(0) && run.stderr.contains("at the middle of face 0"),
        "{}",
        run.stderr
    );
}

#[test]
fn natural_configurations_are_drawn_with_intervals() {
    let place = place();
    place.ok(&["plot", "natural-configurations", "--knots", "1,3,1,2,1", "-o", "a.svg"]);
    let rows = crate::common::csv_rows(&place.read("a.csv"));
    // of an eigenvector of lambda all points shrink to the origin: none is the origin but the vertex at most
    for scheme in ["nurss", "eigen-polyhedron", "hnuss"] {
        let of: Vec<_> = rows.iter().filter(|row| row["scheme"] == scheme).collect();
        let expected = if scheme == "hnuss" { 5 * 16 } else { 1 + 5 * 12 };
        assert_eq!(of.len(), expected, "{scheme}");
    }
}

#[test]
fn results_do_not_depend_on_threads_and_are_drawn() {
    let place = place();
    place.ok(&["make", "ring", "-o", "ring.obj"]);
    for line in [
        "blending --knots 7,7,1,1,7 --next 1,1,1,1,1 --levels 3 --format csv",
        "limit ring.obj --scheme hnuss --vertices --format csv",
        "render ring.obj --schemes nurss,hnuss,catmull-clark --show reflection --size 64 -o a.png",
    ] {
        let with = |threads: &str| {
            let arguments: Vec<&str> = line.split(' ').chain(["--threads", threads]).collect();
            let printed = place.ok(&arguments);
            let picture = if line.contains("a.png") {
                std::fs::read(place.path().join("a.png")).unwrap()
            } else {
                Vec::new()
            };
            (printed, picture)
        };
        let one = with("1");
        assert!(one == with("2") && one == with("8"), "{line}");
    }
}

#[test]
fn limits_are_points_of_the_surface() {
    use crate::common::csv_rows;
    let place = place();
    with(
        &place,
        "cube.obj",
        "knots.obj",
        "t knot 2/1/0 0 1 2\nt knot 2/1/0 0 3 0.7\n",
    );
    place.ok(&["make", "tetrahedron", "-o", "t.obj"]);
    let number = |row: &std::collections::BTreeMap<String, String>, name: &str| row[name].parse::<f64>().unwrap();
    for file in ["knots.obj", "t.obj"] {
        // the same place from two corners; derivatives turn with it
        let sub = if file == "t.obj" { "1" } else { "0" };
        place.write(
            "p.csv",
            format!("face,sub,s,t,corner\n1,{sub},0.2,0.9,0\n1,{sub},0.3,0.6,0\n1,{sub},0.3000001,0.6,0\n"),
        );
        let arguments = [
            "limit",
            file,
            "--scheme",
            "hnuss",
            "--points",
            "p.csv",
            "--derivatives",
            "1",
            "--format",
            "csv",
        ];
        let rows = csv_rows(&place.ok(&arguments));
        assert_eq!(rows.len(), 3);
        for axis in ["x", "y", "z"] {
            let slope = (number(&rows[2], axis) - number(&rows[1], axis)) / 1e-7;
            assert!(
                (slope - number(&rows[1], &format!("{axis}s"))).abs() < 1e-5,
                "{file} {axis}"
            );
        }
        let vertices = csv_rows(&place.ok(&["limit", file, "--scheme", "hnuss", "--vertices", "--format", "csv"]));
        assert!(
            vertices
                .iter()
                .all(|row| row["rule"] == "extraordinary" && !row["x"].is_empty())
        );
    }
    place.write(
        "p.csv",
        "face,sub,s,t,corner\n0,0,0.2,0.9,0\n0,0,0.9,0.8,1\n0,0,0.8,0.1,2\n0,0,0.1,0.2,3\n",
    );
    let arguments = [
        "limit",
        "knots.obj",
        "--scheme",
        "hnuss",
        "--points",
        "p.csv",
        "--derivatives",
        "1",
        "--format",
        "csv",
    ];
    let rows = csv_rows(&place.ok(&arguments));
    for (row, [s, t]) in rows.iter().zip([
        [("xs", 1.0), ("xt", 1.0)],
        [("xt", -1.0), ("xs", 1.0)],
        [("xs", -1.0), ("xt", -1.0)],
        [("xt", 1.0), ("xs", -1.0)],
    ]) {
        assert!((number(row, "x") - number(&rows[0], "x")).abs() < 1e-13);
        assert!(
            (number(row, s.0) * s.1 - number(&rows[0], "xs")).abs() < 1e-12,
            "{row:?}"
        );
        assert!(
            (number(row, t.0) * t.1 - number(&rows[0], "xt")).abs() < 1e-12,
            "{row:?}"
        );
    }
    // NURSS is evaluated nowhere, and faces that are none are named
    let run = place.run(&["limit", "cube.obj", "--scheme", "nurss", "--vertices"]);
    assert_eq!(run.code, Some(2));
    place.write("p.csv", "9,0,0.2,0.9\n");
    let run = place.run(&["limit", "cube.obj", "--scheme", "hnuss", "--points", "p.csv"]);
    assert!(run.code == Some(2) && run.stderr.contains("0 to 5"), "{}", run.stderr);
}

#[test]
fn the_lemmas_on_hnuss_are_checked_exactly() {
    let place = Place::new();
    let proven = place.json("verify --scheme hnuss:simple --knots 1,1e6,2,1,7,0.3,1e-3");
    assert_eq!((&proven["status"], &proven["holds"]), (&"proven".into(), &true.into()));
    let check = |report: &serde_json::Value, name: &str| {
        let checks = report["checks"].as_array().unwrap().clone();
        checks.into_iter().find(|check| check["name"] == name).unwrap()
    };
    let margin = check(&proven, "subdominant")["margin"].as_f64().unwrap();
    assert!(margin > 0.0 && margin < 1e-3, "{margin}");
    // the improved rule needs the eigen-polyhedron, of which nothing is known for such intervals
    for bad in ["1,1e6,2,1,7,0.3,1e-3", "10,1,10,1,1"] {
        let run = place.run(&["verify", "--scheme", "hnuss", "--knots", bad]);
        assert!(
            run.code == Some(2) && run.stderr.contains("the eigen-polyhedron does not exist"),
            "{}",
            run.stderr
        );
    }
    // the matrix and the surface are judged apart
    let bounded = place.json("verify --scheme hnuss --knots 4,4,1,1,4,4,1,1");
    assert_eq!(check(&bounded, "bounded_curvature_matrix")["status"], "undecided");
    assert_eq!(check(&bounded, "bounded_curvature")["status"], "numerical");
    // a zero spoke has a further eigenvalue 1/2 outside of the n-gon, and tiny margins are no negative ones
    let line = "verify --scheme hnuss:simple --knots 0,1,1,2,1 --format json";
    let run = place.run(&line.split(' ').collect::<Vec<_>>());
    let zero = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(check(&zero, "subdominant")["status"], "undecided");
    let spectrum = place.json("spectrum --scheme hnuss --knots 0,1,1,2,1");
    let halves = spectrum["eigenvalues"].as_array().unwrap().iter();
    let halves = halves.filter(|e| (number(e, "re") - 0.5).abs() < 1e-12);
    assert_eq!(halves.map(|e| e["multiplicity"].as_u64().unwrap()).sum::<u64>(), 3);
    let far = place.json("verify --scheme hnuss:simple --knots 1e60,1,1,1e-60,1");
    assert_eq!(far["status"], "proven");
    let margin = check(&far, "subdominant")["margin"].as_f64().unwrap();
    assert!((0.0..1e-100).contains(&margin), "{margin:e}");
    // certificates are stored and checked again: of one set, of several valences, and of all at once
    place.ok(&[
        "verify",
        "--scheme",
        "hnuss",
        "--knots",
        "1,2,1.5,.8,1.2",
        "-o",
        "one.json",
    ]);
    place.ok(&["verify", "--scheme", "hnuss:simple", "-N", "3,7", "-o", "several"]);
    let all = place.json("verify --scheme hnuss:simple -N 3.. -o all.json");
    assert_eq!(
        (&all["status"], &all["valence"]),
        (&"proven".into(), &serde_json::Value::Null)
    );
    for path in ["one.json", "several", "all.json"] {
        let rows = place.ok(&["verify", "--recheck", path]);
        assert!(rows.contains("confirmed") && !rows.contains("NOT"), "{rows}");
    }
    let changed = place.read("all.json").replacen("\"proven\"", "\"refuted\"", 1);
    place.write("all.json", changed);
    assert_eq!(place.run(&["verify", "--recheck", "all.json"]).code, Some(1));
    for bad in [
        "verify --scheme nurss -N 3..",
        "verify --scheme hnuss -N 5..",
        "verify --scheme hnuss -N 3.. --knots 1,2,3",
        "verify --scheme hnuss --knots 1,2,3 --exact",
    ] {
        let run = place.run(&bad.split(' ').collect::<Vec<_>>());
        assert_eq!(
            (run.code, run.stderr.lines().count()),
            (Some(2), 1),
            "{bad}: {}",
            run.stderr
        );
    }
    // what is not proven is not said to be
    for line in [
        "verify --scheme hnuss --knots 0,1,1,2,1",
        "verify --scheme nurss --knots 1,2,1.5,.8,1.2",
        "verify --scheme eigen-polyhedron --knots 1,2,1.5,.8,1.2",
        "verify --scheme hnuss:simple --knots 4,4,1,1,4,4,1,1 --require bounded",
    ] {
        let run = place.run(&line.split(' ').collect::<Vec<_>>());
        assert!(
            run.code == Some(1) && run.stdout.contains("is undecided"),
            "{line}: {}",
            run.stdout
        );
    }
}

#[test]
fn maxima_of_blending_functions_are_counted() {
    let place = Place::new();
    let table = place.json("blending --knots 10,1,1,10,1,1 --next 1,1,1,1,1,1 --schemes nurss,hnuss --levels 4");
    let text = table.to_string();
    assert!(text.contains("nurss") && text.contains("hnuss"), "{text}");
    for bad in [
        "blending --knots 1,2",
        "blending --knots 1,2,3 --next 1",
        "blending --knots 1,1,1 --schemes catmull-clark",
        "blending --knots 1,1,1 --levels 40",
    ] {
        let run = place.run(&bad.split(' ').collect::<Vec<_>>());
        assert_eq!(
            (run.code, run.stderr.lines().count()),
            (Some(2), 1),
            "{bad}: {}",
            run.stderr
        );
    }
}

#[test]
fn spectra_have_the_numbers_of_the_papers() {
    let place = Place::new();
    let leading = |scheme: &str, knots: &str| {
        let answer = place.json(&format!("spectrum --scheme {scheme} --knots {knots}"));
        let list = answer["eigenvalues"].as_array().unwrap().clone();
        let repeated = list.iter().flat_map(|e| {
            let count = e["multiplicity"].as_u64().unwrap() as usize;
            std::iter::repeat_n(number(e, "re"), count)
        });
        repeated.take(4).collect::<Vec<f64>>()
    };
    // unequal eigenvalues of NURSS, double ones of the others
    let nurss = leading("nurss", "10,1,1,10,1,1");
    assert!(
        (nurss[1] - 0.9166).abs() < 5e-5 && (nurss[2] - 0.5368).abs() < 5e-5,
        "{nurss:?}"
    );
    let polyhedron = leading("eigen-polyhedron", "10,1,1,10,1,1");
    assert!(
        (polyhedron[1] - polyhedron[2]).abs() < 1e-12 && polyhedron[3] < polyhedron[2],
        "{polyhedron:?}"
    );
    let hnuss = leading("hnuss", "1,10,1,10,1");
    assert!(
        (hnuss[1] - 0.5).abs() < 1e-12 && (hnuss[2] - 0.5).abs() < 1e-12 && hnuss[3] < 0.5,
        "{hnuss:?}"
    );
}
