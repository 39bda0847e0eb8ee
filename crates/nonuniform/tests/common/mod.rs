//! The reference cases, and pseudo-random numbers.
//!
//! `tests/data/nonuniform_cases.json` comes from an independent prototype in another language; it holds a
//! part of the cases of `reference/nonuniform_cases.json` in the folder that `EIGENRING_SHARED` names, which
//! are taken where that is set.
#![allow(dead_code)]

use serde::Deserialize;
use std::collections::BTreeMap;

#[derive(Deserialize)]
pub struct Cases {
    pub local: Vec<Local>,
    pub regular: Vec<Regular>,
    pub meshes: Vec<MeshCase>,
    pub evaluation: Evaluation,
}

#[derive(Deserialize)]
pub struct Local {
    pub d: Vec<f64>,
    pub a: Vec<f64>,
    pub nurss: Nurss,
    pub eigen_polyhedron: Polyhedron,
    pub hnuss: Hnuss,
    pub first_level: BTreeMap<String, Option<Rows>>,
}

pub type Rows = Vec<Vec<f64>>;

#[derive(Deserialize)]
pub struct Nurss {
    #[serde(rename = "M")]
    pub matrix: Rows,
    pub stationary_spectrum: Vec<[f64; 2]>,
}

#[derive(Deserialize)]
pub struct Polyhedron {
    pub in_domain: bool,
    pub gamma: f64,
    pub lambda: f64,
    pub d_minus: Option<Vec<f64>>,
    pub l: Option<Vec<f64>>,
    #[serde(rename = "V_bar")]
    pub centre: Option<[f64; 2]>,
    pub alpha: Option<Vec<[f64; 2]>>,
    pub beta: Option<Vec<[f64; 2]>>,
    #[serde(rename = "N")]
    pub matrix: Option<Rows>,
    pub spectrum: Option<Vec<[f64; 2]>>,
    pub limit_weights: Option<Vec<f64>>,
    pub limit_of_first_step: Option<Vec<f64>>,
}

#[derive(Deserialize)]
pub struct Hnuss {
    pub alpha: Vec<f64>,
    pub beta: Vec<f64>,
    #[serde(rename = "Q")]
    pub matrix: Rows,
    pub spectrum: Vec<f64>,
    pub limit_weights: Vec<f64>,
    pub tangent_weights: [Vec<f64>; 2],
}

#[derive(Deserialize)]
pub struct Regular {
    pub du: Vec<f64>,
    pub dv: Vec<f64>,
    pub doubled_columns: Vec<usize>,
    pub doubled_rows: Vec<usize>,
    #[serde(default)]
    pub homogeneous: bool,
    pub points: Vec<Vec<f64>>,
    pub levels: Vec<Grid>,
}

#[derive(Deserialize)]
pub struct Grid {
    pub points: Vec<Vec<f64>>,
}

#[derive(Deserialize)]
pub struct MeshCase {
    pub name: String,
    pub control: Net,
    pub refined: BTreeMap<String, Vec<Net>>,
}

#[derive(Deserialize)]
pub struct Net {
    pub points: Vec<Vec<f64>>,
    pub faces: Option<Vec<Vec<u32>>>,
    pub intervals: Option<Vec<(u32, u32, f64)>>,
    pub extraordinary_faces: Option<Vec<usize>>,
    pub face_count: Option<usize>,
    pub edge_count: Option<usize>,
}

#[derive(Deserialize)]
pub struct Evaluation {
    pub control: Net,
    pub centre_vertex: u32,
    pub spokes: Vec<u32>,
    pub limit: [f64; 3],
    pub normal: [f64; 3],
    pub samples: Vec<Sample>,
}

#[derive(Deserialize)]
pub struct Sample {
    pub sector: usize,
    pub u: f64,
    pub v: f64,
    pub point: [f64; 3],
    pub du: [f64; 3],
    pub dv: [f64; 3],
}

pub fn cases() -> Cases {
    let shared = std::env::var_os("EIGENRING_SHARED")
        .map(|folder| std::path::Path::new(&folder).join("reference/nonuniform_cases.json"))
        .filter(|path| path.exists());
    let own = include_str!("../../../../tests/data/nonuniform_cases.json");
    let text = match &shared {
        Some(path) => std::fs::read_to_string(path).expect("the shared cases can be read"),
        None => own.to_owned(),
    };
    serde_json::from_str(&text).expect("the cases have the layout of their page")
}

/// A fixed sequence of numbers in [0, 1) (splitmix64).
pub struct Sequence(pub u64);

impl Sequence {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / u64::MAX as f64
    }

    /// A number from 1 to `ratio`, its logarithm being even.
    pub fn interval(&mut self, ratio: f64) -> f64 {
        ratio.powf(self.next())
    }

    pub fn intervals(&mut self, count: usize, ratio: f64) -> Vec<f64> {
        (0..count).map(|_| self.interval(ratio)).collect()
    }
}

/// The largest difference of two lists, which must have one length.
pub fn difference<'a>(found: impl IntoIterator<Item = &'a f64>, expected: impl IntoIterator<Item = &'a f64>) -> f64 {
    let (found, expected): (Vec<_>, Vec<_>) = (found.into_iter().collect(), expected.into_iter().collect());
    assert_eq!(found.len(), expected.len(), "lists of different lengths");
    let differences = found.into_iter().zip(expected).map(|(a, b)| (a - b).abs());
    // a NaN is larger than everything
    differences.fold(0.0, |largest, x| if x > largest || x.is_nan() { x } else { largest })
}
