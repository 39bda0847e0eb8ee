//! Pieces that the tests of this crate share.
#![allow(dead_code)]

use eigenring_scheme::{Definition, Spec};
use eigenring_surface::io::{Format, read};
use eigenring_surface::{Mesh, Point3, Rules};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Small cases of the repository.
pub fn own(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../tests/data/surfaces")
        .join(name)
}

/// The large collection, in a folder `shared` beside the repository or where `EIGENRING_SHARED` says, if it
/// is there.
pub fn shared(name: &str) -> Option<PathBuf> {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    let path = std::env::var_os("EIGENRING_SHARED")
        .map_or_else(beside, PathBuf::from)
        .join(name);
    if path.exists() {
        return Some(path);
    }
    eprintln!(
        "SKIPPED: {} is not there; the selection in tests/data/surfaces was checked",
        path.display()
    );
    None
}

pub fn load(path: &Path) -> Mesh {
    let format = Format::of_extension(&path.extension().unwrap().to_string_lossy()).unwrap();
    let file = std::fs::File::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    read(file, format)
        .unwrap()
        .surface()
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

pub fn json(path: &Path) -> serde_json::Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

pub fn rules(spec: &str) -> Rules {
    Rules::new(Definition::Family(spec.parse::<Spec>().unwrap()))
}

pub fn points(value: &serde_json::Value) -> Vec<Point3<f64>> {
    let list = value.as_array().unwrap().iter();
    list.map(|p| Point3::new(p[0].as_f64().unwrap(), p[1].as_f64().unwrap(), p[2].as_f64().unwrap()))
        .collect()
}

/// The mesh of a reference file.
pub fn mesh(value: &serde_json::Value) -> Mesh {
    let faces = value["faces"].as_array().unwrap().iter();
    let face = |f: &serde_json::Value| -> Vec<u32> {
        f.as_array()
            .unwrap()
            .iter()
            .map(|i| i.as_u64().unwrap() as u32)
            .collect()
    };
    Mesh::new(points(&value["vertices"]), faces.map(face)).unwrap()
}

/// The largest distance of a point of `a` from the nearest of `b`; infinite beyond `reach`.
fn one_way(a: &[Point3<f64>], b: &[Point3<f64>], reach: f64) -> f64 {
    let cell = |p: &Point3<f64>| [p.x, p.y, p.z].map(|x| (x / reach).floor() as i64);
    let mut grid: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    for (index, point) in b.iter().enumerate() {
        grid.entry(cell(point)).or_default().push(index);
    }
    let mut worst = 0.0_f64;
    for point in a {
        let [x, y, z] = cell(point);
        let mut nearest = f64::INFINITY;
        for (i, j, k) in (-1..2).flat_map(|i| (-1..2).flat_map(move |j| (-1..2).map(move |k| (i, j, k)))) {
            for &other in grid.get(&[x + i, y + j, z + k]).into_iter().flatten() {
                nearest = nearest.min((point - b[other]).norm());
            }
        }
        worst = worst.max(nearest);
    }
    worst
}

/// The distance of two sets of points: the largest from a point of one to the nearest of the other.
pub fn distance(a: &[Point3<f64>], b: &[Point3<f64>]) -> f64 {
    one_way(a, b, 1e-3).max(one_way(b, a, 1e-3))
}

/// Sums over faces that notice wrong faces of right points.
pub fn centroid_sums(mesh: &Mesh) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for face in mesh.faces() {
        let sum: eigenring_surface::Vector3<f64> = face.iter().map(|&v| mesh.points()[v as usize].coords).sum();
        let c = sum / face.len() as f64;
        sums[0] += c.norm_squared();
        sums[1] += c.x * c.z + c.y * c.x + c.z * c.y;
    }
    sums
}
