//! Minima on active conditions.
//!
//! A simplex that compares feasible points only is cut off at a condition, and along a curved one it shrinks
//! before it is at the minimum. The augmented Lagrangian of slacks `s_i >= 0` (Hestenes 1969, Powell 1969;
//! for inequalities Rockafellar 1973),
//!
//! ```text
//! f(x) + sum_i (max(0, m_i - r s_i(x))^2 - m_i^2) / (2 r),     then  m_i <- max(0, m_i - r s_i(x)),
//! ```
//!
//! is as smooth as f and the slacks are once, and has its minimum at that of the problem once the multipliers
//! `m_i` are right, for every weight r that is large enough.

use super::descent::{Asked, nelder_mead, simplex_at};
use super::{LARGE, inside};
use argmin::core::{CostFunction, Error};

/// How often multipliers are corrected: their error falls at least by two each time.
const CORRECTIONS: usize = 25;

/// The first weight of slacks, relative to the value, and how it grows while they do not fall to half.
const WEIGHT: f64 = 10.0;
const GROWTH: f64 = 4.0;

/// Corrections of all slacks below this end the search: half of the digits of the value.
const SATISFIED: f64 = 1e-10;

/// The flatness of a simplex, relative to the value, below which its corners differ by rounding.
const FLAT: f64 = 1e-15;

/// Halvings of the way back to a feasible point.
const HALVINGS: usize = 50;

struct Lagrangian<'a, 'b> {
    asked: &'a Asked<'b>,
    multipliers: &'a [f64],
    weight: f64,
}

impl CostFunction for Lagrangian<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, point: &Vec<f64>) -> Result<f64, Error> {
        let worth = self.asked.worth(point);
        let terms = worth.slacks.iter().zip(self.multipliers).map(|(slack, m)| {
            let pull = (m - self.weight * slack).max(0.0);
            (pull * pull - m * m) / (2.0 * self.weight)
        });
        let cost = worth.value + terms.sum::<f64>();
        // beyond the border values are those at the border: a slope leads back
        let away: f64 = point.iter().zip(inside(point)).map(|(x, y)| (x - y).abs()).sum();
        Ok(if cost.abs() < LARGE {
            cost + worth.value.abs().max(1.0) * away
        } else {
            LARGE
        })
    }
}

impl Asked<'_> {
    /// Moves along the conditions that are active at the best point.
    pub fn along_conditions(&self) {
        let (mut point, worth) = self.best.borrow().clone();
        if !worth.is_feasible() {
            return;
        }
        let scale = worth.value.abs().max(1.0);
        let mut multipliers = vec![0.0; worth.slacks.len()];
        let (mut weight, mut missing) = (WEIGHT * scale, f64::INFINITY);
        let mut size = 1e-2;
        for round in 0..CORRECTIONS {
            let lagrangian = Lagrangian {
                asked: self,
                multipliers: &multipliers,
                weight,
            };
            let Some(next) = nelder_mead(lagrangian, simplex_at(&point, size, round), FLAT * scale) else {
                break;
            };
            point = inside(&next);
            let slacks = self.worth(&point).slacks;
            let before = missing;
            missing = 0.0;
            for (m, slack) in multipliers.iter_mut().zip(&slacks) {
                if slack.is_nan() {
                    return;
                }
                let corrected = (*m - weight * slack).max(0.0);
                missing += (corrected - *m).abs() / weight;
                *m = corrected;
            }
            self.back_to_feasible(&point);
            if missing < SATISFIED {
                break;
            }
            if missing > before / 2.0 {
                weight *= GROWTH;
            }
            size = (size / 2.0).max(1e-5);
        }
    }

    /// The last feasible point on the way from the best one to a point that is better and not quite feasible.
    fn back_to_feasible(&self, point: &[f64]) {
        let (from, _) = self.best.borrow().clone();
        let (mut feasible, mut beyond) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = (feasible + beyond) / 2.0;
            let at: Vec<f64> = from.iter().zip(point).map(|(a, b)| a + middle * (b - a)).collect();
            if self.worth(&at).is_feasible() {
                feasible = middle;
            } else {
                beyond = middle;
            }
        }
    }
}
