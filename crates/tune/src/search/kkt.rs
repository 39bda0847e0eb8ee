//! The first-order conditions at a point of the domain.
//!
//! With the bounds written as `c_j >= 0`, a minimum fulfils `grad E = sum_j m_j grad c_j` over the bounds
//! with c_j = 0, all `m_j >= 0`. In the plane two bounds are enough to represent any such sum, so that the
//! nearest one to grad E is found among all subsets of at most two bounds.

use super::ActiveBound;
use super::frame::{Arc, Frame, Side};
use eigenring_scheme::lambda::Constraint;

/// Bounds nearer than this, in units of the domain, are active. Descents put optima on bounds up to rounding.
const ACTIVE: f64 = 1e-9;

/// The conditions at one point.
pub(super) struct Kkt {
    pub active: Vec<ActiveBound>,
    /// Length of the rest of the gradient.
    pub rest: f64,
}

/// An active bound with the gradient of c_j in units of the domain; `unit` is the unit of the coordinate in
/// which c_j is measured.
struct Normal {
    constraint: Constraint,
    normal: [f64; 2],
    unit: f64,
}

/// The conditions at a point with the given gradient in units of the domain.
pub(super) fn conditions(frame: &Frame, point: [f64; 2], gradient: [f64; 2]) -> Kkt {
    let normals = normals(frame, point);
    let mut best = (norm(gradient), Vec::new());
    let mut offer = |multipliers: Vec<(usize, f64)>| {
        let mut rest = gradient;
        for &(j, m) in &multipliers {
            rest[0] -= m * normals[j].normal[0];
            rest[1] -= m * normals[j].normal[1];
        }
        // a larger set must be better beyond rounding
        if multipliers.iter().all(|&(_, m)| m >= 0.0) && norm(rest) < best.0 * (1.0 - 1e-12) {
            best = (norm(rest), multipliers);
        }
    };
    for (i, a) in normals.iter().enumerate() {
        offer(vec![(i, dot(gradient, a.normal) / dot(a.normal, a.normal))]);
    }
    for (i, a) in normals.iter().enumerate() {
        for (j, b) in normals.iter().enumerate().skip(i + 1) {
            let det = cross(a.normal, b.normal);
            if det != 0.0 {
                offer(vec![
                    (i, cross(gradient, b.normal) / det),
                    (j, cross(a.normal, gradient) / det),
                ]);
            }
        }
    }
    let (rest, multipliers) = best;
    let of = |j| multipliers.iter().find(|m| m.0 == j).map_or(0.0, |m| m.1);
    let active = normals.iter().enumerate().map(|(j, bound)| ActiveBound {
        constraint: bound.constraint,
        multiplier: of(j) / bound.unit,
    });
    Kkt {
        active: active.collect(),
        rest,
    }
}

fn normals(frame: &Frame, point: [f64; 2]) -> Vec<Normal> {
    let mut normals = Vec::new();
    if !frame.is_flat() {
        let ends = frame.domain.f3_range().into_iter().zip([1.0, -1.0]);
        for ((end, inward), room) in ends.zip(frame.room(point[1])) {
            if let (Some(constraint), true) = (end.edge, room.abs() <= ACTIVE) {
                normals.push(Normal {
                    constraint,
                    normal: [0.0, inward],
                    unit: frame.unit[1],
                });
            }
        }
    }
    let arcs = frame.arcs(point, 2.0 * ACTIVE);
    for Arc { curve, side, slope, .. } in arcs
        .into_iter()
        .filter(|arc| arc.offset.abs() <= ACTIVE * arc.slope.abs().max(1.0))
    {
        let inward = match side {
            Side::Lower => 1.0,
            Side::Upper => -1.0,
        };
        normals.push(Normal {
            constraint: curve.constraint(),
            normal: [inward, -inward * slope],
            unit: frame.unit[0],
        });
    }
    normals.sort_by_key(|normal| normal.constraint);
    normals
}

pub(super) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn norm(a: [f64; 2]) -> f64 {
    a[0].hypot(a[1])
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
