//! The rule far from the centre: all passes composed on a line, compared with the masks of uniform B-splines.

use super::model::{Model, Pass};
use super::number::{Q, double, ratio};
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// What is known of the regular part.
#[derive(Clone, Debug, PartialEq)]
pub enum Regular {
    /// It is the uniform B-spline of this degree, in exact arithmetic, on both sides of every spoke.
    Spline(usize),
    /// It is not; why.
    Other(String),
}

/// The composed rule: for the target points of even and of odd index, the sources by their offset `2 source -
/// target`.
pub type Composed = [BTreeMap<i64, Q>; 2];

/// Composes the lines of all passes.
pub fn compose(model: &Model) -> Composed {
    [0, 1].map(|class| {
        let target = 2 * class + model.parity;
        let mut row = BTreeMap::from([(target, Q::one())]);
        for pass in model.passes.iter().rev() {
            let mut next: BTreeMap<i64, Q> = BTreeMap::new();
            for (x, weight) in row {
                for (source, inner) in sources(pass, x) {
                    *next.entry(source).or_insert_with(Q::zero) += &weight * inner;
                }
            }
            row = next;
        }
        row.retain(|_, weight| !weight.is_zero());
        row.into_iter()
            .map(|(source, weight)| (2 * source - target, weight))
            .collect()
    })
}

fn sources(pass: &Pass, x: i64) -> impl Iterator<Item = (i64, &Q)> {
    let scale = pass.line.len() as i64;
    let class = &pass.line[x.div_euclid(2).rem_euclid(scale) as usize];
    class
        .iter()
        .map(move |(offset, weight)| ((x + offset).div_euclid(scale), weight))
}

/// The same as a line of two classes.
pub fn as_line(composed: &Composed) -> Vec<Vec<(i64, Q)>> {
    let taps = |class: &BTreeMap<i64, Q>| class.iter().map(|(&offset, weight)| (offset, weight.clone())).collect();
    composed.iter().map(taps).collect()
}

/// The degree of the B-spline of which this is the centred mask: `C(d+1, k)/2^d` at the offsets `-(d+1), ..,
/// d+1`.
pub fn degree(composed: &Composed) -> Option<usize> {
    let all: BTreeMap<i64, &Q> = composed
        .iter()
        .flatten()
        .map(|(&offset, weight)| (offset, weight))
        .collect();
    let order = *all.keys().next_back()?;
    if order < 1 || all.len() != composed[0].len() + composed[1].len() {
        return None;
    }
    let mut binomial = ratio(2, 1) / num_traits::pow(ratio(2, 1), order as usize);
    for k in 0..=order {
        if all.get(&(2 * k - order)) != Some(&&binomial) {
            return None;
        }
        binomial *= ratio(order - k, k + 1);
    }
    (all.len() as i64 == order + 1).then_some(order as usize - 1)
}

/// The growth of the largest second divided difference in the last of eight refinements of fixed irregular
/// data. It tends to 1 or less where second derivatives exist.
pub fn growth(composed: &Composed) -> f64 {
    let line: Vec<Vec<(i64, f64)>> = composed
        .iter()
        .map(|class| class.iter().map(|(&offset, weight)| (offset, double(weight))).collect())
        .collect();
    let parity = composed[0].keys().next().map_or(0, |offset| offset.rem_euclid(2));
    let mut data: Vec<f64> = (0..48).map(|i| (f64::from(i * i) * 1.7).sin()).collect();
    let second = |data: &[f64]| {
        let n = data.len();
        let difference = |i: usize| data[i] - 2.0 * data[(i + 1) % n] + data[(i + 2) % n];
        (0..n).map(difference).fold(0.0, |largest: f64, d| largest.max(d.abs()))
    };
    let mut before = second(&data);
    let mut grown = 1.0;
    for _ in 0..8 {
        let n = data.len() as i64;
        let made = (0..2 * n).map(|index| {
            let x = 2 * index + parity;
            let taps = line[(index % 2) as usize].iter();
            taps.map(|&(offset, weight)| weight * data[((x + offset) / 2).div_euclid(2).rem_euclid(n) as usize])
                .sum()
        });
        data = made.collect();
        let after = second(&data);
        (grown, before) = (4.0 * after / before, after);
    }
    grown
}

/// Looks at the composed rule and at the rows beyond the special stencils.
pub fn regular(model: &Model, composed: &Composed) -> Regular {
    let Some(degree) = degree(composed) else {
        let growth = growth(composed);
        return Regular::Other(format!(
            "no B-spline's mask; second differences grow by {growth:.4} a level"
        ));
    };
    // passes that only together are a spline's may read other points across a spoke
    let (line, bound) = (as_line(composed), model.bound());
    for r in bound + 1..=bound + 4 {
        for point in model.ring(r).into_iter().filter(|point| point.0 == 0) {
            if model.row(point).ok() != model.regular_row(&line, point) {
                return Regular::Other(format!("{point:?} is not made by the rule of degree {degree}"));
            }
        }
    }
    Regular::Spline(degree)
}
