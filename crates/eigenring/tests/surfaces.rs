//! The commands about meshes as users run them.

use crate::common::{Place, csv_rows, has_fields, number};

fn place() -> Place {
    let place = Place::new();
    place.ok(&["make", "cube", "-o", "cube.obj"]);
    place
}

#[test]
fn a_mesh_is_made_described_refined_and_evaluated() {
    let place = place();
    let facts = place.json("mesh cube.obj");
    has_fields(
        &facts,
        "vertices faces edges faces_by_size euler genus components boundary_loops valences features isolation defects",
    );
    assert_eq!(
        (
            number(&facts, "edges"),
            number(&facts, "euler"),
            number(&facts, "isolation")
        ),
        (12.0, 2.0, 1.0)
    );
    assert_eq!(facts["valences"]["3"], 8);
    let summary = place.json("subdivide cube.obj --scheme catmull-clark --levels 3");
    has_fields(&summary, "vertices faces faces_by_size levels bounds position_sum");
    assert_eq!(
        (number(&summary, "faces"), number(&summary, "vertices")),
        (384.0, 386.0)
    );
    for format in ["obj", "ply", "off", "vtk", "glb"] {
        let name = format!("fine.{format}");
        place.ok(&["subdivide", "cube.obj", "--scheme", "doo-sabin", "-o", &name]);
    }
    assert_eq!(place.json("mesh fine.ply"), {
        let mut same = place.json("mesh fine.obj");
        same["defects"] = serde_json::json!([]);
        same
    });
    let rows = csv_rows(&place.ok(&[
        "limit",
        "cube.obj",
        "--scheme",
        "catmull-clark",
        "--vertices",
        "--format",
        "csv",
    ]));
    assert!(rows.len() == 8 && rows[0]["kind"] == "flat" && rows[0]["faces"].split(' ').count() == 3);
    place.write("p.csv", "face,sub,s,t,corner\n0,0,0.25,0.5,0\n0,0,1e-18,1e-18,2\n");
    let arguments = [
        "limit",
        "cube.obj",
        "--scheme",
        "lambda:optimal",
        "--points",
        "p.csv",
        "--derivatives",
        "2",
    ];
    place.ok(&[&arguments[..], &["-o", "points.csv"]].concat());
    let rows = csv_rows(&place.read("points.csv"));
    assert_eq!(rows.len(), 2);
    for column in
        "face sub s t x y z xs ys zs xt yt zt xss yss zss xst yst zst xtt ytt ztt nx ny nz gauss mean k1 k2".split(' ')
    {
        assert!(rows[1][column].parse::<f64>().unwrap().is_finite(), "{column}");
    }
    // Gauss and Bonnet: the Gauss curvature of a sphere-like surface adds up to 4 pi
    let found = place.json("curvature cube.obj --scheme catmull-clark --radii 1e-1..1e-6");
    assert!(
        (number(&found, "total_gauss") - number(&found, "two_pi_chi")).abs() < 1e-6,
        "{found}"
    );
    assert_eq!(found["centres"].as_array().unwrap().len(), 8);
}

#[test]
fn bad_input_ends_with_one_line_and_leaves_nothing() {
    let place = place();
    place.write(
        "flipped.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 2 3 6 5\n",
    );
    place.write("zero.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 0 1 2\n");
    place.write("empty.obj", "");
    place.write(
        "soft.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 2 5 6 3\nt crease 2/1/0 1 2 10\nt steps 2/1/0 1 2 5\n",
    );
    std::fs::create_dir(place.path().join("folder.obj")).unwrap();
    for (line, needle) in [
        ("mesh zero.obj", "zero.obj: line 4"),
        ("mesh flipped.obj", "flipped.obj: edge 1-2 (line 8)"),
        ("subdivide flipped.obj --scheme catmull-clark -o out.obj", "turned over"),
        ("subdivide empty.obj --scheme catmull-clark -o out.obj", "no faces"),
        ("subdivide folder.obj --scheme catmull-clark", "folder"),
        ("subdivide missing.obj --scheme catmull-clark", "missing.obj"),
        (
            "subdivide cube.obj --scheme catmull-clark -o /proc/none/out.obj",
            "cannot write",
        ),
        ("subdivide cube.obj --scheme catmull-clark -o out.stl", ".stl"),
        (
            "subdivide cube.obj --scheme catmull-clark --levels 40 -o out.obj",
            "of memory",
        ),
        ("subdivide cube.obj --scheme catmull-clark --threads 0", "threads"),
        ("subdivide cube.obj --scheme doo-sabin --lambda-map x.csv", "x.csv"),
        ("limit soft.obj --scheme tension:order=6 --vertices", "0 to 2"),
        ("limit cube.obj --scheme catmull-clark", "--points"),
        ("make cube -n 4 -o out.obj", "no -n"),
    ] {
        let arguments: Vec<&str> = line.split_whitespace().collect();
        let run = place.run(&arguments);
        assert_eq!(run.code, Some(2), "{line}: {}", run.stderr);
        let message = run.stderr.trim_end();
        assert!(
            message.contains(needle) && message.lines().count() == 1,
            "{line}: {message}"
        );
        assert!(!place.path().join("out.obj").exists(), "{line}");
    }
    let run = place.run(&["mesh", "flipped.obj", "--format", "json"]);
    let facts: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(facts["defects"][0]["kind"], "flipped-face");
    assert_eq!(facts["defects"][0]["line"], 8);
    place.ok(&["mesh", "flipped.obj", "--orient", "-o", "turned.obj"]);
    assert_eq!(place.json("mesh turned.obj")["defects"].as_array().unwrap().len(), 0);
}

#[test]
fn a_map_gives_single_vertices_a_lambda() {
    let place = place();
    place.write("map.csv", "v,lambda\n0,0.35\n");
    let plain = place.json("subdivide cube.obj --scheme lambda:optimal --levels 3");
    let mapped = place.json("subdivide cube.obj --scheme lambda:optimal --levels 3 --lambda-map map.csv");
    assert_ne!(plain["position_sum"], mapped["position_sum"]);
    assert_eq!(plain["faces"], mapped["faces"]);
}

#[test]
fn grids_become_meshes() {
    let place = place();
    // the control mesh of an exact torus is one of the tension scheme, whose limit lies on it too
    place.ok(&[
        "make",
        "revolve",
        "torus-exact",
        "--order",
        "4",
        "--around-order",
        "4",
        "-o",
        "torus.obj",
    ]);
    let text = std::fs::read_to_string(place.path().join("torus.obj")).unwrap();
    let scheme = text
        .lines()
        .find_map(|line| line.split_once("--scheme ")?.1.split_whitespace().next())
        .expect("the file says how it is refined");
    place.ok(&[
        "limit",
        "torus.obj",
        "--scheme",
        scheme,
        "--per-face",
        "2",
        "-o",
        "limit.csv",
    ]);
    let limit = std::fs::read_to_string(place.path().join("limit.csv")).unwrap();
    let mut count = 0;
    for line in limit.lines().skip(1) {
        let cells: Vec<f64> = line.split(',').take(7).map(|cell| cell.parse().unwrap()).collect();
        let off = (cells[4].hypot(cells[5]) - 2.0).hypot(cells[6]) - 1.0;
        assert!(off.abs() < 1e-12, "{line}: {off:e}");
        count += 1;
    }
    assert_eq!(count, 4 * 36);
    for name in ["sphere", "cone", "catenoid", "lissajous", "fang-fig1"] {
        place.ok(&["make", "revolve", name, "--levels", "2", "-o", "out.ply"]);
        assert_eq!(place.json("mesh out.ply")["components"], 1, "{name}");
    }
    place.ok(&["make", "sweep", "helicoid", "--limit", "3", "-o", "out.obj"]);
    place.ok(&["make", "tensor", "ellipsoid", "--levels", "1", "-o", "out.obj"]);
    place.write("vase.csv", "1,0\n2,1\n1,2\n1.5,3\n2,4\n");
    place.ok(&["make", "revolve", "vase.csv", "--segments", "8", "-o", "out.obj"]);
    assert_eq!(place.json("mesh out.obj")["vertices"], 40);
    place.write("spine.csv", "0,0,0\n0,0,1\n0,1,2\n1,1,3\n");
    place.ok(&[
        "make",
        "sweep",
        "vase.csv",
        "spine.csv",
        "--levels",
        "1",
        "-o",
        "out.obj",
    ]);
    let rows: String = (0..16)
        .map(|k| format!("{},{},{},{},0\n", k / 4, k % 4, k / 4, k % 4))
        .collect();
    place.write("grid.csv", format!("i,j,x,y,z\n{rows}"));
    place.ok(&["make", "tensor", "grid.csv", "-o", "out.obj"]);
    std::fs::remove_file(place.path().join("out.obj")).unwrap();
    for (line, needle) in [
        ("make revolve sphre -o out.obj", "sphere, torus-exact"),
        ("make revolve sphere --segments 2 -o out.obj", "accepted"),
        ("make revolve catenoid --order 3 -o out.obj", "4 to 32"),
        ("make revolve sphere --u0 2 -o out.obj", "profile of your own"),
        ("make revolve vase.csv --order 6 -o out.obj", "control points"),
        ("make revolve sphere --levels 40 -o out.obj", "points in all"),
        ("make sweep vase.csv -o out.obj", "spine"),
        ("make tensor vase.csv -o out.obj", "i, j, x, y, z"),
        ("make star --noise nan -o out.obj", "noise"),
        ("make cube --rings 3 -o out.obj", "--rings"),
        ("make cube --warp 0.1 -o out.obj", "fan and square3355"),
        ("make fan --split 0 -o out.obj", "1 to 447"),
        ("make fan -n 10000 --split 11 -o out.obj", "1 to 10"),
        ("make square3355 --split 1000 -o out.obj", "1 to 288"),
        ("make fan --warp inf -o out.obj", "warp"),
        ("make cube", "--out"),
    ] {
        let arguments: Vec<&str> = line.split_whitespace().collect();
        let run = place.run(&arguments);
        assert_eq!(run.code, Some(2), "{line}: {}", run.stderr);
        assert!(run.stderr.contains(needle), "{line}: {}", run.stderr);
        assert!(!place.path().join("out.obj").exists(), "{line}");
    }
    // nine quads of a face, and curved lines
    place.ok(&[
        "make", "fan", "-N", "6", "--split", "3", "--warp", "0.08", "-o", "fan.obj",
    ]);
    let text = std::fs::read_to_string(place.path().join("fan.obj")).unwrap();
    let vertices: Vec<&str> = text.lines().filter(|line| line.starts_with("v ")).collect();
    assert_eq!(
        (
            vertices.len(),
            text.lines().filter(|line| line.starts_with("f ")).count()
        ),
        (73, 54)
    );
    let middle: Vec<f64> = vertices[0]
        .split_whitespace()
        .skip(1)
        .map(|x| x.parse().unwrap())
        .collect();
    let expected = [0.3 + 0.08 * 1.8_f64.sin(), 0.4 + 0.08 * 0.4_f64.sin(), 0.0];
    assert!(
        middle.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15),
        "{middle:?}"
    );
    // noise is the same for the same seed, and other for another
    let made = |seed: &str| {
        place.ok(&[
            "make", "star", "-n", "7", "--kind", "saddle", "--noise", "0.1", "--seed", seed, "-o", "s.obj",
        ]);
        std::fs::read_to_string(place.path().join("s.obj")).unwrap()
    };
    assert!(made("3") == made("3") && made("3") != made("4"));
}
