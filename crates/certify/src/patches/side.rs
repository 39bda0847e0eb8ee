//! Splines on one side of a spoke: their Bernstein form and their refinement, by blossoms.
//!
//! Along a direction that leaves a spoke at its knot 0, knots are `i after` for i >= 0 and `i before` for i <
//! 0. Control point k of a spline of odd degree d is its blossom at the d knots `k - (d-1)/2 .. k + (d-1)/2`
//! (Ramshaw 1989, *Blossoms are polar forms*). From this follow, by affine combinations with exact weights,
//!
//! * the Bernstein coefficients on the interval from knot j to knot j+1: the blossom at so many times the one
//!   and the other;
//! * the control points over halved intervals: the blossom at the finer knots. The functions are the same, by
//!   the uniqueness of blossoms.
//!
//! Beside a **boundary or crease** the net is continued by `P_(-k) = 2 P_0 - P_k`, and the knots are uniform.
//! The uniform rule is its own mirror image, so that the refined net is continued in the same way.

use eigenring_scheme::BigRational;
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// A combination of control points, by their steps from the spoke; negative ones lie beyond it.
pub type Combination = BTreeMap<i64, BigRational>;

/// What is beyond a spoke.
#[derive(Clone, Debug, PartialEq)]
pub enum Side {
    /// The same as on this side.
    Uniform,
    /// Nothing: a boundary or crease.
    Reflected,
    /// Other knot intervals, both positive.
    Knots {
        /// The interval beyond the spoke.
        before: BigRational,
        /// That on this side.
        after: BigRational,
    },
}

/// The Bernstein form on one knot interval.
#[derive(Clone, Debug)]
pub struct Segment {
    /// The control points that take part, in steps.
    pub steps: Vec<i64>,
    /// For each Bernstein coefficient their weights.
    pub weights: Vec<Vec<BigRational>>,
}

fn integer(value: i64) -> BigRational {
    BigRational::from_integer(value.into())
}

impl Side {
    fn knot(&self, i: i64) -> BigRational {
        match self {
            Side::Knots { before, after } => integer(i) * if i < 0 { before } else { after },
            _ => integer(i),
        }
    }

    /// The blossom of the segment on interval j, at the given arguments.
    fn blossom(&self, j: i64, arguments: &[BigRational]) -> Combination {
        let degree = arguments.len();
        let knots: Vec<BigRational> = (0..2 * degree as i64)
            .map(|i| self.knot(j - degree as i64 + 1 + i))
            .collect();
        let unit = |at: usize| (0..=degree).map(|k| integer(i64::from(k == at))).collect::<Vec<_>>();
        let mut values: Vec<Vec<BigRational>> = (0..=degree).map(unit).collect();
        for (round, argument) in arguments.iter().enumerate() {
            for m in 0..degree - round {
                let (low, high) = (&knots[m + round], &knots[m + degree]);
                let upper = (argument - low) / (high - low);
                let lower = BigRational::one() - &upper;
                let next = values[m].iter().zip(&values[m + 1]);
                values[m] = next.map(|(a, b)| a * &lower + b * &upper).collect();
            }
        }
        let first = j - (degree as i64 - 1) / 2;
        let mut sum = Combination::new();
        for (m, weight) in values.swap_remove(0).into_iter().enumerate() {
            let mut add = |step: i64, weight: BigRational| *sum.entry(step).or_insert_with(BigRational::zero) += weight;
            match first + m as i64 {
                step if step < 0 && *self == Side::Reflected => {
                    add(0, integer(2) * &weight);
                    add(-step, -weight);
                }
                step => add(step, weight),
            }
        }
        sum.retain(|_, weight| !weight.is_zero());
        sum
    }

    /// The Bernstein form on the interval from knot j >= 0 to the next.
    pub fn segment(&self, degree: usize, j: usize) -> Segment {
        let ends = [j as i64, j as i64 + 1].map(|i| self.knot(i));
        let rows: Vec<Combination> = (0..=degree)
            .map(|i| {
                let arguments: Vec<BigRational> = (0..degree).map(|a| ends[usize::from(a < i)].clone()).collect();
                self.blossom(j as i64, &arguments)
            })
            .collect();
        let mut steps: Vec<i64> = rows.iter().flat_map(|row| row.keys().copied()).collect();
        steps.sort_unstable();
        steps.dedup();
        let weight = |row: &Combination, step: &i64| row.get(step).cloned().unwrap_or_else(BigRational::zero);
        let weights = rows
            .iter()
            .map(|row| steps.iter().map(|step| weight(row, step)).collect());
        Segment {
            weights: weights.collect(),
            steps,
        }
    }

    /// The refined control point `step` over halved intervals. Points beyond a crease have none.
    pub fn refined(&self, degree: usize, step: i64) -> Combination {
        let reach = (degree as i64 - 1) / 2;
        let half = BigRational::new(1.into(), 2.into());
        let arguments: Vec<BigRational> = (step - reach..=step + reach).map(|i| self.knot(i) * &half).collect();
        self.blossom(step.div_euclid(2), &arguments)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn q(p: i64, r: i64) -> BigRational {
        BigRational::new(p.into(), r.into())
    }

    fn sides() -> [Side; 4] {
        let knots = |before, after| Side::Knots { before, after };
        [
            Side::Uniform,
            Side::Reflected,
            knots(q(3, 1), q(1, 2)),
            knots(q(1, 7), q(2, 1)),
        ]
    }

    /// One half of a Bernstein form, by de Casteljau's construction.
    fn half(mut row: Vec<BigRational>, second: bool) -> Vec<BigRational> {
        let mut out = Vec::new();
        while !row.is_empty() {
            out.push(if second {
                row[row.len() - 1].clone()
            } else {
                row[0].clone()
            });
            row = row.windows(2).map(|pair| (&pair[0] + &pair[1]) * q(1, 2)).collect();
        }
        if second {
            out.reverse();
        }
        out
    }

    /// The spline over refined control points is the spline: on each half of each interval, exactly.
    #[test]
    fn refinement_keeps_the_function() {
        for degree in [3, 5] {
            for side in sides() {
                let value = |step: i64| q(step * step * step - 5 * step + 3, 1 + step.rem_euclid(4));
                let sum = |combination: &Combination, value: &dyn Fn(i64) -> BigRational| {
                    combination
                        .iter()
                        .map(|(&step, w)| w * value(step))
                        .sum::<BigRational>()
                };
                let fine = |step: i64| sum(&side.refined(degree, step), &value);
                let form = |j: usize, value: &dyn Fn(i64) -> BigRational| {
                    let Segment { steps, weights } = side.segment(degree, j);
                    let row = |row: &Vec<BigRational>| row.iter().zip(&steps).map(|(w, &step)| w * value(step)).sum();
                    weights.iter().map(row).collect::<Vec<BigRational>>()
                };
                for j in 0..5 {
                    let coarse = form(j, &value);
                    assert_eq!(form(2 * j, &fine), half(coarse.clone(), false), "{side:?} {j}");
                    assert_eq!(form(2 * j + 1, &fine), half(coarse, true), "{side:?} {j}");
                }
            }
        }
    }

    #[test]
    fn uniform_sides_are_uniform_splines() {
        for degree in [3, 5, 7] {
            let expected = eigenring_spline::uniform::to_bernstein::<f64>(degree);
            for j in 0..4 {
                let found = Side::Uniform.segment(degree, j);
                assert_eq!(found.steps[0], j as i64 - (degree as i64 - 1) / 2);
                for (found, expected) in found.weights.iter().flatten().zip(expected.iter().flatten()) {
                    assert!((<f64 as eigenring_scheme::Scalar>::rational(found) - expected).abs() < 1e-15);
                }
            }
        }
    }
}
