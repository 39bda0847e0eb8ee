//! The search for evidence, in floating point.
//!
//! Nothing here is trusted: what is found is a claim, which the checks of the parent module prove or not. The
//! Jacobian is searched on the bounds of its enclosed coefficients, so that the subdivision found suits wide
//! enclosures too; boundary and curvatures on the middles.

use super::gauss::{self, CurvatureEvidence, Heights, Sign};
use super::regular::JacobianEvidence;
use super::winding::{self, WindingEvidence};
use super::{Place, PlaneNet, Subdivision};
use crate::{Enclose, Interval};
use eigenring_spectral::PatchIndex;
use eigenring_spline::bernstein::Polynomial;

/// When to give up, and how sharp a curvature bound should be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The deepest subdivision.
    pub depth: usize,
    /// The most parts of one patch, or of one boundary curve, to examine.
    pub cells: usize,
    /// Curvature bounds are refined until they are this close, relative to the extreme value.
    pub tolerance: f64,
}

impl Default for Limits {
    /// Depth and number of parts are empirical: known schemes need none or one halving, and a map that needs
    /// ten is within `4^-10` of a fold. A tenth decides every sign and is quick.
    fn default() -> Self {
        Limits {
            depth: 10,
            cells: 1000,
            tolerance: 0.1,
        }
    }
}

/// A Jacobian's coefficients bounded from below and above, on a part of the unit square.
#[derive(Clone)]
struct Part {
    bounds: [Polynomial<f64>; 2],
    square: Square,
}

/// A part of the unit square.
#[derive(Clone, Copy)]
struct Square {
    corner: [f64; 2],
    size: f64,
}

impl Square {
    const WHOLE: Square = Square {
        corner: [0.0; 2],
        size: 1.0,
    };

    /// In the order of [`Polynomial::quarters`].
    fn quarters(self) -> [Square; 4] {
        let size = self.size / 2.0;
        [[0.0, 0.0], [size, 0.0], [0.0, size], [size, size]].map(|[u, v]| Square {
            corner: [self.corner[0] + u, self.corner[1] + v],
            size,
        })
    }

    /// In the order of [`Polynomial::corners`].
    fn corners(self) -> [[f64; 2]; 4] {
        let s = self.size;
        [[0.0, 0.0], [s, 0.0], [0.0, s], [s, s]].map(|[u, v]| [self.corner[0] + u, self.corner[1] + v])
    }
}

fn place(patch: PatchIndex, sector: usize, [u, v]: [f64; 2]) -> Place {
    Place {
        sector,
        p: patch.p,
        q: patch.q,
        u,
        v,
    }
}

/// Evidence that the Jacobian has one sign, or two places where it has not.
pub fn jacobian<S: Enclose>(net: &PlaneNet<S>, limits: Limits) -> JacobianEvidence {
    let patches = net.patches();
    let enclosures: Vec<Polynomial<Interval>> = net.jacobians().iter().map(|j| j.map(Enclose::enclosure)).collect();
    // the sign of the largest certain value at a corner of a patch
    let mut reference = (0.0, true, place(patches[0], patches[0].sector, [0.0; 2]));
    for (patch, jacobian) in patches.iter().zip(&enclosures) {
        for (value, at) in jacobian.corners().iter().zip(Square::WHOLE.corners()) {
            if value.mig() > reference.0 {
                reference = (value.mig(), value.certainly_positive(), place(*patch, patch.sector, at));
            }
        }
    }
    let (_, positive, reference_place) = reference;
    let mut wrong: Option<(f64, Place)> = None;
    let mut trees = Vec::with_capacity(patches.len());
    for (patch, jacobian) in patches.iter().zip(&enclosures) {
        let lower = jacobian.map(|c| if positive { c.lo() } else { -c.hi() });
        let upper = jacobian.map(|c| if positive { c.hi() } else { -c.lo() });
        // what is not bounded cannot be improved
        let bounded = lower
            .coefficients()
            .iter()
            .chain(upper.coefficients())
            .all(|c| c.is_finite());
        let scale = upper.coefficients().iter().fold(0.0, |max: f64, c| max.max(c.abs()));
        let mut examined = 0;
        let tree = Subdivision::grow(
            Part {
                bounds: [lower, upper],
                square: Square::WHOLE,
            },
            &cut,
            &mut |part, depth| {
                examined += 1;
                let [lower, upper] = &part.bounds;
                for (value, at) in upper.corners().into_iter().zip(part.square.corners()) {
                    // ties in favour of a clear case: what is nearly zero is left for the rounding of the
                    // check
                    if value <= 0.0 && wrong.is_none_or(|(worst, _)| value < worst) {
                        wrong = Some((value, place(*patch, patch.sector, at)));
                    }
                }
                // a thousand roundings of slack, so that the check finds the same sign
                let decided = lower.coefficients().iter().all(|&c| c > 1e-13 * scale);
                let found = wrong.is_some_and(|(worst, _)| worst < -1e-10 * scale);
                bounded && !decided && !found && depth < limits.depth && examined < limits.cells
            },
        );
        trees.push(tree);
    }
    match wrong {
        Some((_, at)) => {
            let places = if positive {
                [at, reference_place]
            } else {
                [reference_place, at]
            };
            JacobianEvidence::Fold { places }
        }
        None => JacobianEvidence::Sign {
            positive,
            patches: trees,
        },
    }
}

fn cut(part: &Part) -> Vec<Part> {
    let [lower, upper] = [&part.bounds[0], &part.bounds[1]].map(Polynomial::quarters);
    let bounds = lower.into_iter().zip(upper).map(<[_; 2]>::from);
    bounds
        .zip(part.square.quarters())
        .map(|(bounds, square)| Part { bounds, square })
        .collect()
}

/// Evidence for the winding number of the outer boundary.
pub fn boundary<S: Enclose>(net: &PlaneNet<S>, limits: Limits) -> WindingEvidence {
    let curves = winding::boundary(net);
    curves
        .into_iter()
        .map(|curve| {
            let mut examined = 0;
            Subdivision::grow(curve, &winding::cut, &mut |part, depth| {
                examined += 1;
                let one_sided = part.iter().any(|values| {
                    let mut signs = values.iter().map(|c| c.enclosure().sign());
                    let first = signs.next().flatten();
                    first.is_some_and(|sign| sign != 0) && signs.all(|sign| sign == first)
                });
                !one_sided && depth < limits.depth && examined < limits.cells
            })
        })
        .collect()
}

/// Evidence for the extreme Gauss curvatures of the maps of some heights.
pub fn curvature<S: Enclose>(net: &PlaneNet<S>, heights: &Heights<S>, sign: Sign, limits: Limits) -> CurvatureEvidence {
    let (net, heights) = (net.middle(), heights.middle());
    let (sectors, patches) = (net.sectors(), net.patches());
    let phases: Vec<(usize, f64, f64)> = heights
        .phases(sectors)
        .into_iter()
        .map(|phase| {
            let sector = (0..sectors)
                .find(|&sector| heights.phase(sector, sectors) == phase)
                .unwrap_or(0);
            let angle = std::f64::consts::TAU * phase as f64 / sectors as f64;
            (sector, angle.cos(), angle.sin())
        })
        .collect();
    // sign K of each map, with the sector, smallest over the sectors
    let worst = |values: &[f64]| -> Vec<(f64, usize)> {
        match *values {
            [single] => vec![(sign.times(single), 0)],
            [p0, p1, p2] => [1.0, -1.0]
                .map(|part| {
                    let all = phases
                        .iter()
                        .map(|&(sector, cos, sin)| (sign.times(p0 + part * (p1 * cos - p2 * sin)), sector));
                    all.fold((f64::INFINITY, 0), |low, next| if next.0 < low.0 { next } else { low })
                })
                .to_vec(),
            _ => Vec::new(),
        }
    };
    let mut best = vec![(f64::INFINITY, place(patches[0], 0, [0.0; 2])); heights.maps()];
    let look = |best: &mut Vec<(f64, Place)>, patch: PatchIndex, values: &[f64], at: [f64; 2]| {
        for (best, (value, sector)) in best.iter_mut().zip(worst(&values[1..])) {
            let value = value / values[0];
            if value < best.0 {
                *best = (value, place(patch, sector, at));
            }
        }
    };
    let forms: Vec<Vec<Polynomial<f64>>> = patches
        .iter()
        .map(|&patch| gauss::forms(&net, &heights, patch))
        .collect();
    for (&patch, forms) in patches.iter().zip(&forms) {
        for at in (0..25).map(|i| [f64::from(i % 5) / 4.0, f64::from(i / 5) / 4.0]) {
            let values: Vec<f64> = forms.iter().map(|f| f.value(at[0], at[1])).collect();
            look(&mut best, patch, &values, at);
        }
    }
    let cut = |(forms, square): &(Vec<Polynomial<f64>>, Square)| {
        gauss::cut(forms).into_iter().zip(square.quarters()).collect::<Vec<_>>()
    };
    let mut trees = Vec::with_capacity(patches.len());
    for (&patch, forms) in patches.iter().zip(forms) {
        let mut examined = 0;
        let tree = Subdivision::grow((forms, Square::WHOLE), &cut, &mut |(forms, square), depth| {
            examined += 1;
            let corners: Vec<[f64; 4]> = forms.iter().map(Polynomial::corners).collect();
            for (corner, at) in square.corners().into_iter().enumerate() {
                let values: Vec<f64> = corners.iter().map(|c| c[corner]).collect();
                look(&mut best, patch, &values, at);
            }
            let mut values = vec![0.0; forms.len()];
            let sharp = (0..forms[0].coefficients().len()).all(|index| {
                for (value, form) in values.iter_mut().zip(forms) {
                    *value = form.coefficients()[index];
                }
                let near = |value: f64, &(best, _): &(f64, Place)| {
                    values[0] > 0.0 && value / values[0] >= best - limits.tolerance * best.abs()
                };
                // a bound for all phases is enough for most coefficients
                let any = sign.times(values[1]) - values[2..].iter().fold(0.0, |sum: f64, p| sum.hypot(*p));
                best.iter().all(|best| near(any, best))
                    || worst(&values[1..])
                        .iter()
                        .zip(&best)
                        .all(|(&(value, _), best)| near(value, best))
            });
            !sharp && depth < limits.depth && examined < limits.cells
        });
        trees.push(tree);
    }
    CurvatureEvidence {
        patches: trees,
        places: best.into_iter().map(|(_, place)| place).collect(),
    }
}
