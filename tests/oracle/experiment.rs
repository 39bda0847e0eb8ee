//! Refinement of irregular data by the rules themselves: do normals converge, and does the ring wind once?
//!
//! The data's size is taken out after every step, and so is a common shift, which refinement keeps; neither
//! changes a normal.

use super::local::Local;
use super::spline::{At, control, evaluate, patches, winding};

/// What was seen after many refinements.
#[derive(Clone, Debug, Default)]
pub struct Seen {
    /// The largest angle between a normal and their mean, in radians, after each of [`LEVELS`] refinements.
    pub spread: Vec<f64>,
    /// The winding number of the outer boundary, projected along the mean normal, round the limit point after
    /// the last.
    pub winding: Option<i64>,
}

/// After how many refinements the rings are looked at.
pub const LEVELS: [usize; 4] = [20, 40, 80, 160];

/// The experiment with three sets of data in space; one entry each.
pub fn experiment(local: &Local, degree: usize) -> Vec<Seen> {
    (1..=3).map(|seed| once(local, degree, f64::from(seed))).collect()
}

fn once(local: &Local, degree: usize, seed: f64) -> Seen {
    let number = |i: usize, axis: usize| (seed * 12.9898 + (3 * i + axis) as f64 * 78.233).sin() * 43758.5453 % 1.0;
    let mut data: Vec<[f64; 3]> = (0..local.points.len())
        .map(|i| [0, 1, 2].map(|axis| number(i, axis)))
        .collect();
    let all: Vec<Vec<usize>> = patches(local, local.model.n)
        .into_iter()
        .map(|patch| control(local, degree, patch))
        .collect();
    let mut seen = Seen::default();
    let mut done = 0;
    for level in LEVELS {
        while done < level {
            data = normalised(local.refine(&data));
            done += 1;
        }
        let Some((mean, spread)) = normals(degree, &all, &data) else {
            return seen;
        };
        seen.spread.push(spread);
        if level == LEVELS[LEVELS.len() - 1] {
            seen.winding = projected(local, degree, &data, mean);
        }
    }
    seen
}

fn normalised(mut data: Vec<[f64; 3]>) -> Vec<[f64; 3]> {
    let count = data.len() as f64;
    for axis in 0..3 {
        let mean = data.iter().map(|point| point[axis]).sum::<f64>() / count;
        data.iter_mut().for_each(|point| point[axis] -= mean);
    }
    let size = data.iter().flatten().fold(0.0_f64, |size, x| size.max(x.abs()));
    data.iter_mut().flatten().for_each(|x| *x /= size.max(1e-300));
    data
}

fn normals(degree: usize, all: &[Vec<usize>], data: &[[f64; 3]]) -> Option<([f64; 3], f64)> {
    let at = At::samples(degree, 3);
    let mut normals = Vec::new();
    for places in all {
        for u in &at {
            for v in &at {
                let jet = evaluate(places, data, u, v);
                let (a, b) = (jet.u, jet.v);
                let cross = [
                    a[1] * b[2] - a[2] * b[1],
                    a[2] * b[0] - a[0] * b[2],
                    a[0] * b[1] - a[1] * b[0],
                ];
                // a ring that has shrunk to a curve has no normals that mean anything
                let size = dot(cross, cross).sqrt();
                if !(size > 1e-9 * (dot(a, a) * dot(b, b)).sqrt()) {
                    return None;
                }
                normals.push(cross.map(|x| x / size));
            }
        }
    }
    let sum = normals
        .iter()
        .fold([0.0; 3], |sum: [f64; 3], n| [0, 1, 2].map(|axis| sum[axis] + n[axis]));
    let size = dot(sum, sum).sqrt();
    let mean = sum.map(|x| x / size.max(1e-300));
    // the chord is accurate where the cosine is not
    let chord = |n: &[f64; 3]| {
        let d = [0, 1, 2].map(|axis| n[axis] - mean[axis]);
        2.0 * (0.5 * dot(d, d).sqrt()).min(1.0).asin()
    };
    Some((mean, normals.iter().map(chord).fold(0.0, f64::max)))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn projected(local: &Local, degree: usize, data: &[[f64; 3]], normal: [f64; 3]) -> Option<i64> {
    let axis = if normal[0].abs() < 0.6 {
        [1.0, 0.0, 0.0]
    } else {
        [0.0, 1.0, 0.0]
    };
    let along = dot(axis, normal);
    let first = [0, 1, 2].map(|i| axis[i] - along * normal[i]);
    let size = dot(first, first).sqrt();
    let first = first.map(|x| x / size);
    let second = [
        normal[1] * first[2] - normal[2] * first[1],
        normal[2] * first[0] - normal[0] * first[2],
        normal[0] * first[1] - normal[1] * first[0],
    ];
    let flat: Vec<[f64; 2]> = data
        .iter()
        .map(|&point| [dot(point, first), dot(point, second)])
        .collect();
    let mut limit = flat.clone();
    for _ in 0..200 {
        limit = local.refine(&limit);
    }
    let apart = limit
        .iter()
        .fold(0.0_f64, |apart, p| apart.max((p[0] - limit[0][0]).abs()));
    // points that have not come together show no limit
    if !(apart < 1e-6) {
        return None;
    }
    winding(local, degree, &flat, limit[0])
}
