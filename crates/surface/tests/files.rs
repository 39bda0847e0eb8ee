//! Mesh files: same bits after writing and reading, one line for each kind of bad file, and no panic on
//! mutilated ones.

use crate::common::{load, own};
use eigenring_surface::io::{Encoding, Format, MeshFile, read, write, write_ply};
use eigenring_surface::{Boundary, Error, Mesh, Point3, shapes};
use proptest::prelude::*;

fn obj(text: &str) -> Result<Mesh, Error> {
    read(text.as_bytes(), Format::Obj).and_then(MeshFile::surface)
}

fn awkward() -> Mesh {
    let mut mesh = shapes::gear(3);
    for (index, point) in mesh.points_mut().iter_mut().enumerate() {
        // neither short decimals nor numbers of one size
        *point = Point3::from(point.coords * (0.1 + index as f64).sqrt() * 10_f64.powi(index as i32 % 7 * 40 - 120));
    }
    mesh.points_mut()[0] = Point3::new(-0.0, f64::MIN_POSITIVE / 4.0, f64::MAX);
    let face = mesh.face(0).to_vec();
    let features = &mut mesh.features;
    let pair = eigenring_surface::features::edge(face[0], face[1]);
    features.creases.insert(pair, 0.1 + 0.2);
    features.corners.insert(face[2], 1.4);
    features.edge_steps.insert(pair, 2);
    features.vertex_steps.insert(face[2], 1);
    features.knots.insert(pair, 1.0 / 3.0);
    features.extraordinary.insert(face[3]);
    features.boundary = Some(Boundary::Corner);
    mesh
}

#[test]
fn what_is_written_is_read_back_to_the_last_bit() {
    let mesh = awkward();
    let bits = |mesh: &Mesh| -> Vec<u64> {
        mesh.points()
            .iter()
            .flat_map(|p| p.iter().map(|x| x.to_bits()).collect::<Vec<_>>())
            .collect()
    };
    let check = |bytes: &[u8], format: Format| -> Mesh {
        let found = read(bytes, format).unwrap().mesh;
        assert_eq!(bits(&found), bits(&mesh), "{format:?}");
        assert!(found.faces().eq(mesh.faces()));
        found
    };
    for format in [Format::Obj, Format::Off, Format::Ply] {
        let mut bytes = Vec::new();
        write(&mesh, &mut bytes, format).unwrap();
        let found = check(&bytes, format);
        if format == Format::Obj {
            assert_eq!(found.features, mesh.features);
        }
    }
    for encoding in [Encoding::Text, Encoding::LittleEndian, Encoding::BigEndian] {
        let mut bytes = Vec::new();
        write_ply(&mesh, &mut bytes, encoding).unwrap();
        check(&bytes, Format::Ply);
    }
}

#[test]
fn formats_for_viewers_are_complete() {
    let mesh = shapes::tetrahedron();
    let mut vtk = Vec::new();
    write(&mesh, &mut vtk, Format::Vtk).unwrap();
    let text = String::from_utf8(vtk).unwrap();
    assert!(text.contains("POINTS 4 double") && text.contains("POLYGONS 4 16"));
    let mut glb = Vec::new();
    write(&mesh, &mut glb, Format::Glb).unwrap();
    let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&glb[..4], word(4), word(8)), (&b"glTF"[..], 2, glb.len()));
    let json: serde_json::Value = serde_json::from_slice(&glb[20..20 + word(12)]).unwrap();
    assert_eq!(json["accessors"][1]["count"], 12);
    assert_eq!(20 + word(12) + 8 + word(20 + word(12)), glb.len());
}

#[test]
fn indices_may_be_relative_and_vertices_weighted() {
    let mesh = obj("v 0 0 0\nv 1 0 0 2\nv 0 1 0\nf -3/1/1 -2//4 -1\n").unwrap();
    assert_eq!(mesh.face(0), [0, 1, 2]);
    assert_eq!(mesh.weights(), Some(&[1.0, 2.0, 1.0][..]));
    assert_eq!(
        obj("v 0 0 0\nv 1 0 0\nv 0 1 \\\n0\nf 1 2 3\n").unwrap().points().len(),
        3
    );
}

const THREE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

#[test]
fn bad_files_are_refused_in_one_line_that_says_what_is_accepted() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n";
    let cases = [
        (format!("{THREE}f 0 1 2\n"), "line 4"),
        (format!("{THREE}f 1 2 4\n"), "line 4"),
        (format!("{THREE}f 1 2 -4\n"), "line 4"),
        (format!("{THREE}f 1 2 2\n"), "(line 4) names a point twice"),
        (format!("{THREE}f 1 2\n"), "2 corners"),
        (format!("{THREE}f 1 2 x\n"), "no index"),
        ("v 0 0 nan\n".to_owned(), "line 1"),
        ("v 0 0 1e400\n".to_owned(), "no finite number"),
        ("v 0 0\n".to_owned(), "2 coordinates"),
        (String::new(), "no faces"),
        (THREE.to_owned(), "no faces"),
        (format!("{THREE}f 1 2 3\nt crease 2/1/0 0 7 1\n"), "no vertex 7"),
        (
            format!("{square}f 1 2 3 4\nt crease 2/1/0 0 2 1\n"),
            "edge 0-2 (line 8)",
        ),
        (format!("{THREE}f 1 2 3\nt crease 2/1/0 0 1 -1\n"), "negative"),
        (format!("{THREE}f 1 2 3\nt crease 2/1/0 0 1 nan\n"), "finite"),
        (
            format!("{THREE}f 1 2 3\nt crease 99999999999999999999/1/0 0 1\n"),
            "counts",
        ),
        (
            format!("{THREE}f 1 2 3\nt crease 18446744073709551615/9/0 0 1\n"),
            "announces",
        ),
        (format!("{THREE}f 1 2 3\nt corner 1/1/0 x 1\n"), "no vertex number"),
        // the second face runs along the shared edge in the same direction
        (format!("{square}f 1 2 3 4\nf 2 3 6 5\n"), "turned over"),
        (
            format!("{square}f 1 2 3 4\nf 3 2 5 6\nf 3 2 1\n"),
            "edge 1-2 (line 9) has three faces",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 4 5\n".to_owned(),
            "vertex 0 (line 1) joins several fans",
        ),
    ];
    for (text, needle) in cases {
        let error = obj(&text).map(|_| ()).unwrap_err().to_string();
        assert!(error.contains(needle), "{text}\n{error}, expected {needle}");
        assert!(error.contains("accepted") && !error.contains('\n'), "{error}");
    }
    // up to ten of a kind are named
    let mut many = String::new();
    for i in 0..12 {
        many.push_str(&format!("v {i} 0 0\nv {i} 1 0\nv {i} 0 1\n"));
    }
    for i in 0..12 {
        many.push_str(&format!("f {} {} {}\n", 3 * i + 1, 3 * i + 2, 3 * i + 2));
    }
    let error = obj(&many).unwrap_err().to_string();
    assert!(error.contains("face 9 (line 46) and 2 more"), "{error}");
}

#[test]
fn headers_that_announce_too_much_cost_nothing() {
    let ply = "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty double z\nelement face 1000000000000\nproperty list uchar uint vertex_indices\nend_header\n";
    let mut bytes = ply.as_bytes().to_vec();
    bytes.extend([0; 24]);
    let error = read(&bytes[..], Format::Ply).unwrap_err().to_string();
    assert!(
        error.contains("face 0 of 1000000000000") && error.contains("ends"),
        "{error}"
    );
    let error = read(&bytes[..bytes.len() - 10], Format::Ply).unwrap_err().to_string();
    assert!(error.contains("vertex 0 of 1"), "{error}");
    let off = "OFF\n3 99999999999 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let error = read(off.as_bytes(), Format::Off).unwrap_err().to_string();
    assert!(
        error.contains("1 of 99999999999 faces") && error.contains("line 6"),
        "{error}"
    );
}

#[test]
fn repairs_make_surfaces() {
    let mut flipped = String::from("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n");
    flipped.push_str("f 1 2 3 4\nf 2 3 6 5\n");
    let mesh = read(flipped.as_bytes(), Format::Obj).unwrap().mesh;
    assert!(!mesh.defects().is_empty());
    assert!(mesh.oriented().unwrap().defects().is_empty());
    // two cubes that share an edge, and a vertex
    let bow = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 2 1 4\nf 1 2 5\n";
    let mesh = read(bow.as_bytes(), Format::Obj).unwrap().mesh;
    let split = mesh.split_non_manifold();
    assert!(!mesh.defects().is_empty() && split.defects().is_empty());
    assert_eq!(split.face_count(), 3);
    // a strip with half a turn has one side
    let strip: String = (0..5).map(|i| format!("v {i} 0 0\nv {i} 1 0\n")).collect();
    let strip = strip + "f 1 3 4 2\nf 3 5 6 4\nf 5 7 8 6\nf 7 9 10 8\nf 9 2 1 10\n";
    let mesh = read(strip.as_bytes(), Format::Obj).unwrap().mesh;
    assert!(matches!(mesh.oriented(), Err(Error::NotOrientable { .. })));
}

/// How many mutilated files are read: `scripts/fuzz-meshes.sh` asks for a million.
fn cases() -> u32 {
    let asked = std::env::var("EIGENRING_FUZZ_CASES").ok();
    asked.and_then(|count| count.parse().ok()).unwrap_or(256)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases()))]

    /// Bytes of good files, some changed, cut off or repeated: an answer or an error, and no panic.
    #[test]
    fn mutilated_files_do_not_panic(
        which in 0_usize..5,
        changes in prop::collection::vec((0_usize..4000, any::<u8>()), 0..6),
        cut in 0_usize..4000,
    ) {
        let mesh = shapes::star(5, 1, shapes::StarKind::Convex);
        let mut bytes = Vec::new();
        let format = match which {
            0 => {
                bytes = std::fs::read(own("opensubdiv/catmark_cube_creases0.obj")).unwrap();
                Format::Obj
            }
            1 => { write(&mesh, &mut bytes, Format::Off).unwrap(); Format::Off }
            2 => { write_ply(&mesh, &mut bytes, Encoding::Text).unwrap(); Format::Ply }
            3 => { write_ply(&mesh, &mut bytes, Encoding::BigEndian).unwrap(); Format::Ply }
            _ => { write_ply(&mesh, &mut bytes, Encoding::LittleEndian).unwrap(); Format::Ply }
        };
        for (at, byte) in changes {
            let length = bytes.len();
            bytes[at % length] = byte;
        }
        if cut % 3 == 0 {
            bytes.truncate(cut % bytes.len());
        }
        if let Ok(file) = read(&bytes[..], format) {
            let defects = file.defects();
            let _ = file.mesh.split_non_manifold();
            let _ = file.mesh.oriented();
            prop_assert!(defects.is_empty() == eigenring_surface::Topology::new(&file.mesh).is_ok());
        }
    }
}

/// Reading does not depend on how a mesh came about.
#[test]
fn golden_files_are_surfaces() {
    for name in ["cube", "pyramid", "tent", "nonquads"] {
        assert!(
            load(&own(&format!("opensubdiv/catmark_{name}.obj")))
                .defects()
                .is_empty()
        );
    }
}
