//! The exact end of a quadratic programme: a dual active-set method.
//!
//! An interior-point solution touches its bounds to about 1e-8 and does not say which of many nearly active
//! bounds carry the optimum. This method, Goldfarb and Idnani's (*Math. Programming* 27, 1983), ends with a
//! set of independent bounds that hold with equality, non-negative multipliers, and all other bounds
//! satisfied.
//!
//! In the coordinates of the `reduce` page the problem is `min 1/2 |v - d|^2` subject to `c_i . v >= h_i`.
//! For a *working set* W of independent bounds with non-negative multipliers u at the projection v of d onto
//! `c_i . v = h_i, i in W`:
//!
//! 1. Take the most violated bound p; if there is none, v is optimal.
//! 2. With `z` the part of `c_p` orthogonal to the working normals and `c_p - z = sum_j r_j c_j`, the move `v
//!    += t z, u_j -= t r_j, u_p += t` keeps `v - d = sum_j u_j c_j` and the working equalities. Take the
//!    shorter of the full step `t = (h_p - c_p . v)/|z|^2`, after which p is met, and the longest step with
//!    `u >= 0`.
//! 3. After a full step add p to W and go to 1; otherwise drop the bound whose multiplier vanished and repeat
//!    2. If there is neither (`z = 0`, all `r_j <= 0`), bound p contradicts the bounds with `r_j < 0`: the
//!    problem is infeasible.
//!
//! The distance from d grows in every full step, so no working set comes twice. Any W with non-negative
//! multipliers may be the start; it is taken from the interior-point solution. After each change v and u are
//! computed afresh from d, and violations are measured on x after it was moved exactly onto the working set,
//! so errors do not add up.

use super::dense::{Frame, add_scaled, dot};
use super::reduce::{Factored, Reduced, Row};

/// `row . x >= bound`.
#[derive(Clone, Debug)]
pub(super) struct Inequality {
    pub(super) row: Row,
    pub(super) bound: f64,
}

impl Inequality {
    pub(super) fn slack(&self, x: &[f64]) -> f64 {
        self.row.dot(x) - self.bound
    }
}

#[derive(Debug)]
pub(super) struct Optimum {
    pub(super) x: Vec<f64>,
    /// Indices of the bounds that carry the optimum, ascending.
    pub(super) working: Vec<usize>,
    pub(super) steps: usize,
}

#[derive(Debug)]
pub(super) enum Stuck {
    /// Bound `bound`, which has the given value at present, contradicts the others.
    Infeasible {
        bound: usize,
        value: f64,
        conflicts: Vec<usize>,
    },
    /// Rounding keeps the method from ending.
    Steps { steps: usize, violation: f64 },
}

/// Violations up to this much (relative to the bound if that is above 1) are rounding: a value is a sum of
/// four products.
const SATISFIED: f64 = 4e-15;
/// A normal of which less than this part is left depends on the working normals.
const DEPENDENT: f64 = 1e-10;
/// Steps after which rounding must be at fault; fits take 10 to 100.
const STEPS: usize = 2000;

struct State {
    frame: Frame,
    v: Vec<f64>,
    u: Vec<f64>,
    x: Vec<f64>,
}

/// The optimum, from a guess of the active bounds (in any order, dependent ones allowed). `e` are the
/// equalities' values.
pub(super) fn optimum(
    factored: &Factored,
    reduced: &Reduced,
    e: &[f64],
    bounds: &[Inequality],
    guess: &[usize],
) -> Result<Optimum, Stuck> {
    let height = |i: usize| bounds[i].bound - bounds[i].row.dot(&reduced.origin);
    let state = |working: &[usize]| -> State {
        let d = &reduced.target;
        let normals = normals(factored, bounds, working);
        let frame = Frame::new(d.len(), &normals);
        let defects: Vec<f64> = (working.iter().zip(&normals))
            .map(|(&i, c)| height(i) - dot(c, d))
            .collect();
        let y = frame.solve_transposed(&defects);
        let mut v = frame.combine(&y);
        add_scaled(&mut v, 1.0, d);
        let mut x = factored.point(&reduced.origin, &v);
        let active: Vec<(&Row, f64)> = working.iter().map(|&i| (&bounds[i].row, bounds[i].bound)).collect();
        factored.settle(&mut x, e, &active);
        let u = frame.solve(&y);
        State { frame, v, u, x }
    };

    let mut working = start(factored, bounds, guess);
    loop {
        let u = state(&working).u;
        match smallest(u.iter().copied()) {
            Some((k, u)) if u < 0.0 => working.remove(k),
            _ => break,
        };
    }
    let mut steps = 0;
    loop {
        let State {
            mut frame,
            mut v,
            mut u,
            x,
        } = state(&working);
        let violations = bounds.iter().map(|b| b.slack(&x) / b.bound.abs().max(1.0));
        let Some((p, slack)) = smallest(violations).filter(|&(_, slack)| slack < -SATISFIED) else {
            working.sort_unstable();
            return Ok(Optimum { x, working, steps });
        };
        if steps == STEPS {
            return Err(Stuck::Steps {
                steps: STEPS,
                violation: -slack,
            });
        }
        let c = factored.normal(&bounds[p].row);
        loop {
            let (components, z) = frame.project(&c);
            let r = frame.solve(&components);
            let left = dot(&z, &z);
            let dependent = left <= DEPENDENT * DEPENDENT * dot(&c, &c);
            let ratios = (u.iter().zip(&r)).map(|(&u, &r)| if r > 0.0 { u.max(0.0) / r } else { f64::INFINITY });
            let partial = smallest(ratios).filter(|&(_, t)| t.is_finite());
            let full = if dependent {
                f64::INFINITY
            } else {
                ((height(p) - dot(&c, &v)) / left).max(0.0)
            };
            match partial {
                Some((k, t)) if t < full => {
                    if !dependent {
                        add_scaled(&mut v, t, &z);
                    }
                    add_scaled(&mut u, -t, &r);
                    u.remove(k);
                    working.remove(k);
                    frame = Frame::new(c.len(), &normals(factored, bounds, &working));
                }
                None if dependent => {
                    let conflicts = (working.iter().zip(&r)).filter(|&(_, &r)| r < 0.0).map(|(&i, _)| i);
                    return Err(Stuck::Infeasible {
                        bound: p,
                        value: bounds[p].row.dot(&x),
                        conflicts: conflicts.collect(),
                    });
                }
                _ => break,
            }
        }
        working.push(p);
        steps += 1;
    }
}

fn normals(factored: &Factored, bounds: &[Inequality], working: &[usize]) -> Vec<Vec<f64>> {
    working.iter().map(|&i| factored.normal(&bounds[i].row)).collect()
}

/// An independent part of the guess.
fn start(factored: &Factored, bounds: &[Inequality], guess: &[usize]) -> Vec<usize> {
    let (length, _) = factored.rank();
    let (_, order) = Frame::pivoted(length, &normals(factored, bounds, guess), 1e-3);
    order.into_iter().map(|k| guess[k]).collect()
}

/// The first smallest item.
fn smallest(items: impl Iterator<Item = f64>) -> Option<(usize, f64)> {
    items
        .enumerate()
        .fold(None, |best: Option<(usize, f64)>, item| match best {
            Some(best) if best.1 <= item.1 => Some(best),
            _ => Some(item),
        })
}
