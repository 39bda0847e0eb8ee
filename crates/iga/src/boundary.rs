//! Data on the boundary: traces by projection, Nitsche's terms, fluxes.

use crate::Error;
use crate::assembly::add;
use crate::patch::{bicubic, with_intervals};
use crate::solution::Solution;
use crate::space::{Edge, Space};
use crate::sparse::{Numbering, Sparse};
use crate::tables::line_rule;
use std::collections::BTreeMap;

/// The factor of Nitsche's penalty: above the constant of the inverse inequality of cubics, and the errors do
/// not depend on it to three digits.
const PENALTY: f64 = 20.0;
/// Points of an edge.
const POINTS: usize = 6;

/// A point of the boundary.
struct Sample {
    at: [f64; 2],
    /// The weight times the length of the tangent.
    measure: f64,
    /// The size of the face across the boundary: the Jacobian by the length of the tangent.
    size: f64,
    normal: [f64; 2],
    ids: Vec<u32>,
    /// Of the functions of `ids`, value and derivative along the outward normal.
    rows: [Vec<f64>; 2],
}

/// The points of all boundary edges. The face is above the edge, so the outward normal is the tangent turned
/// clockwise.
fn samples(space: &Space) -> impl Iterator<Item = Sample> + '_ {
    let rule = line_rule(POINTS);
    space.edges.iter().flat_map(move |edge| {
        let of = |&(s, weight): &(f64, f64)| sample(space, edge, s, weight);
        rule.iter().map(of).collect::<Vec<_>>()
    })
}

fn sample(space: &Space, edge: &Edge, s: f64, weight: f64) -> Sample {
    let jets = match edge.intervals {
        None => bicubic(s, 0.0),
        Some(intervals) => with_intervals(intervals, s, 0.0),
    };
    let mut x = [[0.0; 3]; 2];
    let mut rows: BTreeMap<u32, [f64; 3]> = BTreeMap::new();
    for (jet, &v) in jets.iter().zip(&edge.points) {
        for (sums, coordinate) in x.iter_mut().zip(space.positions[v as usize]) {
            sums.iter_mut().zip(jet).for_each(|(sum, j)| *sum += coordinate * j);
        }
        for (id, w) in space.transform.row(v as usize) {
            let row = rows.entry(id as u32).or_default();
            row.iter_mut().zip(jet).for_each(|(sum, j)| *sum += w * j);
        }
    }
    let [[px, xs, xt], [py, ys, yt]] = x;
    let (length, det) = (xs.hypot(ys), xs * yt - xt * ys);
    let normal = [ys / length, -xs / length];
    // the gradient is J^-T (v_s, v_t)
    let along = |[_, vs, vt]: &[f64; 3]| {
        let gradient = [(vs * yt - vt * ys) / det, (vt * xs - vs * xt) / det];
        gradient[0] * normal[0] + gradient[1] * normal[1]
    };
    Sample {
        at: [px, py],
        measure: weight * length,
        size: det / length,
        normal,
        ids: rows.keys().copied().collect(),
        rows: [
            rows.values().map(|row| row[0]).collect(),
            rows.values().map(along).collect(),
        ],
    }
}

/// Value and normal derivative of u.
fn data(sample: &Sample, u: &Solution) -> [f64; 2] {
    let at = u(sample.at[0], sample.at[1]);
    [
        at.value,
        at.gradient[0] * sample.normal[0] + at.gradient[1] * sample.normal[1],
    ]
}

/// The values of the fixed unknowns with which `(u_h - u)^2` over the boundary is least, or, `clamped`,
/// `(u_h - u)^2 + h^2 (d/dn (u_h - u))^2` with the size h of the face. The others do not contribute.
pub(crate) fn projected(space: &Space, fixed: &[bool], clamped: bool, u: &Solution) -> Result<Vec<f64>, Error> {
    let mut entries: BTreeMap<(u32, u32), f64> = BTreeMap::new();
    let mut right = vec![0.0; fixed.len()];
    for sample in samples(space) {
        let data = data(&sample, u);
        let factors = [1.0, if clamped { sample.size * sample.size } else { 0.0 }];
        let used: Vec<usize> = (0..sample.ids.len())
            .filter(|&k| fixed[sample.ids[k] as usize])
            .collect();
        for ((row, value), factor) in sample.rows.iter().zip(data).zip(factors) {
            let factor = factor * sample.measure;
            for &i in used.iter().filter(|_| factor > 0.0) {
                right[sample.ids[i] as usize] += factor * row[i] * value;
                for &j in &used {
                    *entries.entry((sample.ids[i], sample.ids[j])).or_default() += factor * row[i] * row[j];
                }
            }
        }
    }
    let mut rows = vec![Vec::new(); fixed.len()];
    entries
        .into_iter()
        .for_each(|((i, j), value)| rows[i as usize].push((j, value)));
    let unknowns = Numbering::new(fixed);
    let mut values = vec![0.0; fixed.len()];
    if !unknowns.list.is_empty() {
        let matrix = Sparse::from_rows(&rows, fixed.len()).part(&unknowns, &unknowns);
        let solution = matrix.factor(None)?.solve(&unknowns.gather(&right));
        unknowns
            .list
            .iter()
            .zip(solution)
            .for_each(|(&i, value)| values[i] = value);
    }
    Ok(values)
}

/// Adds Nitsche's terms, `- (u_n, v) - (u, v_n) + gamma/h (u, v)` on the left and
/// `- (g, v_n) + gamma/h (g, v)` on the right, over the boundary, n outward (Nitsche 1971).
pub(crate) fn nitsche(space: &Space, matrix: &mut Sparse, right: &mut [f64], u: &Solution) {
    for sample in samples(space) {
        let [value, _] = data(&sample, u);
        let [v, vn] = &sample.rows;
        let (measure, penalty) = (sample.measure, PENALTY / sample.size);
        add(matrix, &sample.ids, |i, j| {
            measure * (penalty * v[i] * v[j] - vn[i] * v[j] - v[i] * vn[j])
        });
        for (k, &id) in sample.ids.iter().enumerate() {
            right[id as usize] += measure * value * (penalty * v[k] - vn[k]);
        }
    }
}

/// Adds the flux `(du/dn, v)` over the boundary to the load.
pub(crate) fn flux(space: &Space, right: &mut [f64], u: &Solution) {
    for sample in samples(space) {
        let [_, flux] = data(&sample, u);
        for (&id, v) in sample.ids.iter().zip(&sample.rows[0]) {
            right[id as usize] += sample.measure * flux * v;
        }
    }
}
