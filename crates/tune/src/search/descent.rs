//! A descent to a local minimum: trust regions with exact gradients and a quasi-Newton Hessian.
//!
//! At each point the [`Model`] is minimised over the domain within a box; the function is evaluated there,
//! and the box grows or shrinks with the agreement between predicted and true change (Conn, Gould and Toint,
//! *Trust-Region Methods*, 2000, algorithm 6.1.1 and its customary constants). The Hessian starts with
//! differences of gradients, which cost two evaluations, and is updated by the symmetric rank-one formula,
//! whether a step was accepted or not; unlike BFGS it may become indefinite, which the model's enumeration
//! welcomes.

use super::frame::Frame;
use super::kkt::{self, dot, norm};
use super::model::{Hessian, Model};
use super::{Function, Optimum};

/// How to descend.
pub(super) struct Descent {
    /// First half size of the box, in units of the domain.
    radius: f64,
    /// Its largest value.
    radius_max: f64,
}

/// Where a descent ended.
pub(super) struct End {
    pub optimum: Optimum,
    /// Evaluations of value and gradient.
    pub evaluations: usize,
}

/// Evaluations after which a descent ends at the best point so far. About ten is usual; the KKT residual
/// tells.
const EVALUATIONS: usize = 120;

/// Steps shorter than this, in units of the domain, end a descent: convergence is superlinear, so the point
/// is better than that.
const STEP: f64 = 1e-10;

/// Below this relative change of the value rounding may decide which of two values is the lower: near mu =
/// 1/8, where the outer rings' eigenvectors nearly belong to mu, the objective has lost seven of its digits
/// (observed at N = 4, lambda = 0.15).
const NOISE: f64 = 1e-9;

/// Distance of the differences that start the Hessian, in units of the domain: truncation and rounding are
/// both small against the model's other errors.
const DIFFERENCE: f64 = 1e-4;

impl Descent {
    /// From a point of the starting grid, whose cells are 0.1 wide.
    pub const GRID: Descent = Descent {
        radius: 0.2,
        radius_max: 1.0,
    };

    /// From a point near a minimum, staying near.
    pub const NEAR: Descent = Descent {
        radius: 0.02,
        radius_max: 0.1,
    };

    /// Descends; `None` if the function is not finite at the start or the start has no nearest point of the
    /// domain.
    pub fn run(&self, function: &impl Function, frame: &Frame, start: [f64; 2]) -> Option<End> {
        let mut walk = Walk {
            function,
            frame,
            evaluations: 0,
        };
        let mut point = frame.project(start)?;
        let (mut value, mut gradient) = walk.evaluate(point)?;
        let mut hessian = walk.difference_hessian(point, value, gradient);
        let mut radius = self.radius;
        while walk.evaluations < EVALUATIONS {
            let model = Model { gradient, hessian };
            let minimum = model.minimum(frame, point, radius);
            let Some((place, step, predicted)) = minimum.filter(|(_, step, _)| size(*step) > STEP) else {
                // nowhere to go, or the enumeration has left out what a strongly curved domain offers within
                // the box: look nearer
                radius *= 0.1;
                if radius > STEP {
                    continue;
                }
                break;
            };
            let size = size(step);
            let Some((new_value, new_gradient)) = walk.evaluate(place) else {
                radius = 0.25 * size;
                continue;
            };
            hessian = rank_one(hessian, step, gradient, new_gradient);
            let agreement = (value - new_value) / -predicted;
            if agreement < 0.25 {
                radius = 0.25 * size;
            } else if agreement > 0.75 && size > 0.8 * radius {
                radius = (2.0 * radius).min(self.radius_max);
            }
            // where values cannot tell, gradients can
            let noisy = (value - new_value).abs().max(-predicted) <= NOISE * value.abs();
            let rest = |point, gradient| kkt::conditions(frame, point, gradient).rest;
            let accept = agreement > 1e-4 || (noisy && rest(place, new_gradient) < 0.5 * rest(point, gradient));
            if accept {
                (point, value, gradient) = (place, new_value, new_gradient);
            }
        }
        let model = Model { gradient, hessian };
        let conditions = kkt::conditions(frame, point, gradient);
        let scale = norm(gradient) + model.stiffness();
        Some(End {
            optimum: Optimum {
                f2: point[0],
                f3: point[1],
                total: value,
                active: conditions.active,
                // a constant function has neither gradient nor Hessian, and nothing remains of them
                kkt_residual: if scale > 0.0 { conditions.rest / scale } else { 0.0 },
            },
            evaluations: walk.evaluations,
        })
    }
}

/// The larger component of a step.
fn size(step: [f64; 2]) -> f64 {
    step[0].abs().max(step[1].abs())
}

/// Evaluations in units of the domain, counted.
struct Walk<'a, F> {
    function: &'a F,
    frame: &'a Frame<'a>,
    evaluations: usize,
}

impl<F: Function> Walk<'_, F> {
    /// Value and gradient, if both are finite.
    fn evaluate(&mut self, [f2, f3]: [f64; 2]) -> Option<(f64, [f64; 2])> {
        self.evaluations += 1;
        let (value, [by_f2, by_f3]) = self.function.value_and_gradient(f2, f3);
        // where f3 is fixed its derivative has no meaning
        let by_y = if self.frame.is_flat() {
            0.0
        } else {
            by_f3 * self.frame.unit[1]
        };
        let gradient = [by_f2 * self.frame.unit[0], by_y];
        (value.is_finite() && gradient.iter().all(|g| g.is_finite())).then_some((value, gradient))
    }

    /// Second derivatives from gradients at two neighbouring points of the domain, or a multiple of the unit
    /// matrix if there are no usable ones.
    fn difference_hessian(&mut self, point: [f64; 2], value: f64, gradient: [f64; 2]) -> Hessian {
        let size = norm(gradient).max(value.abs());
        let (fallback, flat) = ([size, 0.0, size], self.frame.is_flat());
        let mut along = |direction: [f64; 2]| {
            let (place, step) = self.neighbour(point, direction)?;
            let (_, there) = self.evaluate(place)?;
            Some((step, [there[0] - gradient[0], there[1] - gradient[1]]))
        };
        // the first neighbour differs in f2 only
        let Some(([x, _], change)) = along([DIFFERENCE, 0.0]) else {
            return fallback;
        };
        let column_x = change.map(|c| c / x);
        if flat {
            return [column_x[0], 0.0, 0.0];
        }
        let Some(([x, y], change)) = along([0.0, DIFFERENCE]) else {
            return fallback;
        };
        let column_y = [(change[0] - column_x[0] * x) / y, (change[1] - column_x[1] * x) / y];
        [column_x[0], 0.5 * (column_x[1] + column_y[0]), column_y[1]]
    }

    /// A point of the domain near the given distance in a direction or against it, with the step to it.
    fn neighbour(&self, point: [f64; 2], direction: [f64; 2]) -> Option<([f64; 2], [f64; 2])> {
        let mut best = None;
        let mut most = 0.25 * dot(direction, direction);
        for sign in [1.0, -1.0] {
            let wanted = direction.map(|d| sign * d);
            let Some(place) = self.frame.project(self.frame.moved(point, wanted)) else {
                continue;
            };
            let step = self.frame.step(point, place);
            let along = dot(step, wanted);
            if along > most && norm(step) < 100.0 * DIFFERENCE {
                most = along;
                best = Some((place, step));
            }
        }
        best
    }
}

/// The symmetric rank-one update: the smallest change in rank that makes `H step` the change of the gradient.
/// It is left out where it would divide by almost nothing (Nocedal and Wright 2006, Eq. 6.26).
fn rank_one(hessian: Hessian, step: [f64; 2], old: [f64; 2], new: [f64; 2]) -> Hessian {
    let [hxx, hxy, hyy] = hessian;
    let miss = [
        new[0] - old[0] - (hxx * step[0] + hxy * step[1]),
        new[1] - old[1] - (hxy * step[0] + hyy * step[1]),
    ];
    let divisor = dot(miss, step);
    let usable = divisor.abs() > 1e-8 * norm(miss) * norm(step);
    if !usable {
        return hessian;
    }
    [
        hxx + miss[0] * miss[0] / divisor,
        hxy + miss[0] * miss[1] / divisor,
        hyy + miss[1] * miss[1] / divisor,
    ]
}
