//! The feasible part of a plane.
//!
//! Ma, Wang and Ma (2023, section 3.2) admit a stencil if all its weights are non-negative, if every
//! eigenvalue of the one-ring matrix other than 1, lambda (blocks 1, N-1) and mu (blocks 0, 2, N-2) has a
//! modulus below mu, and if the angle `theta` of the natural configuration at F, between V and E, is at most
//! `pi/2 - pi/(2N)`. Their bounds are Eqs. 49-52; here each constraint is solved for f2 or for f3, in the
//! notation of [`Plane`]:
//!
//! **f3 alone** (N >= 5). `g3 < mu` and `h > 0` hold for `0 <= f3 < C/D`, beyond which nothing is feasible;
//! up to there
//!
//! * `f3 >= 0`, and `f1 >= 0` against theta: `f3 >= (lambda - cos(pi/N)) / (1 - cos(pi/N))`;
//! * `d2 >= 0`: f3 is at most the smaller root of
//!   `(1-sg) f3^2 - lambda (1 + B sg - sg^2) f3 + sg lambda^2 (c1 sg - c2)`;
//! * the last block, `(m+f3)(m+g3) + h m (1+c_K) >= 0` with `K = floor(N/2)` and `m = (1-kappa) mu`: f3 is at
//!   most the positive root of a quadratic, for even N (`c_K = -1`) of its linear factor: `f3 <= (m C + mu
//!   A)/(m D + mu B)`. The paper uses the even formula at every N: [`Bounds::Paper`].
//!
//! **f2 at one f3.** `f1 >= 0` bounds f2 above, theta and `d1 >= 0` bound it below; `z0 <= m` keeps it
//! between the roots of a quadratic, `z0 >= -m` and `1 - alpha - beta >= 0` outside the roots of two others.
//! So f2 lies in one interval, or in two with a gap between (at phi = 6 this happens only at N = 3 and lambda
//! below about 0.52). `beta > 0` is implied.
//!
//! **N = 3**: `g3 = lambda mu/f3`, and `h >= 0` demands `mu <= f3 <= lambda`. The curve `z0 = m` meets that
//! of theta at the lowest feasible f3. Towards `f3 = lambda` the intervals shrink to points that are not
//! feasible themselves. **N = 4**: `f3 = g3 = mu`; the domain is an interval of f2.
//!
//! The inequalities with mu are strict in the paper. At many lambda the optimum lies on the boundary, where
//! they hold with equality; the relative margin `kappa` keeps stencils strictly inside. `kappa = 0` is the
//! closure.

mod check;
mod constraint;
mod curves;
mod starts;
mod strips;
#[cfg(test)]
mod tests;

pub use check::InfeasiblePoint;
pub use constraint::{Constraint, ConstraintCurve, Root};
pub use strips::Strip;

use super::Plane;
use crate::Error;
use curves::Row;

/// Which bound on the last block's eigenvalues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bounds {
    /// `g3 >= -m` at every valence, as in the paper. Exact for even N, stricter than needed for odd N.
    Paper,
    /// The exact bound at every valence.
    Sharp,
}

/// The admissible (f2, f3) of a plane; see the module page.
#[derive(Clone, Copy, Debug)]
pub struct Domain {
    plane: Plane<f64>,
    bounds: Bounds,
    margin: f64,
    f3: [F3End; 2],
}

/// An end of the range of f3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct F3End {
    /// Where it is.
    pub f3: f64,
    /// The constraint that is active on the whole segment at this f3, or `None` if the domain ends there in a
    /// point, where a lower and an upper curve of f2 meet.
    pub edge: Option<Constraint>,
}

/// An end of an interval of f2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct F2End {
    /// Where it is.
    pub f2: f64,
    /// The curve it lies on.
    pub curve: ConstraintCurve,
}

/// The feasible f2 at one f3, or one of two parts of them: `lower.f2 <= upper.f2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct F2Interval {
    /// The lower end.
    pub lower: F2End,
    /// The upper end.
    pub upper: F2End,
}

impl Domain {
    /// Rows of f3 on which a domain that is not feasible up to its f3 bounds is searched. Empirical: at phi =
    /// 6 only N = 3 needs the search, and there every row above the lowest feasible one is feasible.
    const ROWS: u32 = 256;

    /// The domain with a relative margin `kappa` to the eigenvalue bounds.
    ///
    /// # Errors
    /// [`Error::Margin`] unless 0 <= kappa < 1, [`Error::Phi`] unless phi is finite and non-negative,
    /// [`Error::Infeasible`] if no stencil is admissible (s below the rule of
    /// [`Relaxation`](super::Relaxation)).
    pub fn new(plane: Plane<f64>, bounds: Bounds, margin: f64) -> Result<Self, Error> {
        if !(0.0..1.0).contains(&margin) {
            return Err(Error::Margin { margin });
        }
        if !(plane.phi >= 0.0 && plane.phi.is_finite()) {
            return Err(Error::Phi { phi: plane.phi });
        }
        // the fields of a plane are public
        Plane::new(plane.valence, plane.lambda, plane.s)?;
        let mut domain = Domain {
            plane,
            bounds,
            margin,
            f3: [F3End { f3: 0.0, edge: None }; 2],
        };
        domain.f3 = domain.f3_bounds();
        domain.trim()?;
        Ok(domain)
    }

    /// The plane.
    pub fn plane(&self) -> &Plane<f64> {
        &self.plane
    }

    /// Which bound on the last block.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// The relative margin kappa.
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// The range of f3, lower end first. Every f3 between has feasible f2 at phi = 6; at other phi rows may
    /// be empty.
    pub fn f3_range(&self) -> [F3End; 2] {
        self.f3
    }

    /// The feasible f2 at one f3, ascending: none outside the range of f3, else one or two intervals.
    pub fn f2_intervals(&self, f3: f64) -> Vec<F2Interval> {
        let in_range = self.f3[0].f3 <= f3 && f3 <= self.f3[1].f3;
        if in_range { self.row_intervals(f3) } else { Vec::new() }
    }

    /// `m = (1 - kappa) mu`.
    fn modulus_bound(&self) -> f64 {
        (1.0 - self.margin) * self.plane.mu()
    }

    /// The bounds on f3 alone.
    fn f3_bounds(&self) -> [F3End; 2] {
        let (plane, mu, m) = (&self.plane, self.plane.mu(), self.modulus_bound());
        let (lambda, sg) = (plane.lambda, plane.s * plane.lambda);
        let end = |f3, edge| F3End { f3, edge };
        match plane.valence {
            3 => return [mu, lambda].map(|f3| end(f3, None)),
            4 => return [end(mu, Some(Constraint::F3EqualsMu)); 2],
            _ => {}
        }
        let (c1, c2) = (plane.cosine(1), plane.cosine(2));
        let (a, b) = ((1.0 + c1) * mu - (1.0 + c2) * lambda, c1 - c2);
        let (c, d) = (b * mu, 1.0 + c1 - (1.0 + c2) * sg);

        let cos_half = plane.cos_half_sector();
        let wedge = (lambda - cos_half) / (1.0 - cos_half);
        let lower = if wedge > 0.0 {
            end(wedge, None)
        } else {
            end(0.0, Some(Constraint::F3))
        };

        let last = plane.valence / 2;
        let last_block = if plane.valence % 2 == 0 || self.bounds == Bounds::Paper {
            (m * c + mu * a) / (m * d + mu * b)
        } else {
            let q = m * (1.0 + plane.cosine(last as i64)) * (1.0 - sg);
            smallest_positive_root(
                q - (m * d + mu * b),
                (m * c + mu * a) - m * (m * d + mu * b) - q * (mu + lambda),
                m * (m * c + mu * a) + q * mu * lambda,
            )
        };
        let d2 = smallest_positive_root(
            1.0 - sg,
            -lambda * (1.0 + b * sg - sg * sg),
            sg * lambda * lambda * (c1 * sg - c2),
        );
        let upper = if d2 < last_block {
            end(d2, Some(Constraint::D2))
        } else {
            end(last_block, Some(Constraint::LastBlock))
        };
        [lower, upper]
    }

    /// Moves each end of the f3 range to the outermost row with feasible f2.
    fn trim(&mut self) -> Result<(), Error> {
        let [lower, upper] = self.f3.map(|end| end.f3);
        let at = |row: u32| lower + (upper - lower) * (f64::from(row) / f64::from(Self::ROWS));
        let feasible = |f3: f64| !self.row_intervals(f3).is_empty();
        let rows: Vec<u32> = (0..=Self::ROWS).filter(|&row| feasible(at(row))).collect();
        let (Some(&first), Some(&last), true) = (rows.first(), rows.last(), lower <= upper) else {
            return Err(Error::Infeasible {
                valence: self.plane.valence,
                lambda: self.plane.lambda,
                s: self.plane.s,
                phi: self.plane.phi,
            });
        };
        let edge_outside = |f3: f64| {
            let row = Row::new(&self.plane, f3);
            (!self.inner_blocks_hold(&row, f3)).then_some(Constraint::InnerBlocks)
        };
        let moved = |from, to| {
            let (f3, outside) = bisect(at(from), at(to), feasible);
            F3End {
                f3,
                edge: edge_outside(outside),
            }
        };
        let ends = [
            (first > 0).then(|| moved(first, first - 1)),
            (last < Self::ROWS).then(|| moved(last, last + 1)),
        ];
        for (end, moved) in self.f3.iter_mut().zip(ends) {
            *end = moved.unwrap_or(*end);
        }
        Ok(())
    }

    /// The bounds on f3 from the blocks before the last, `p = g3 f3` being every block's determinant. They
    /// are implied by the others at kappa = 0, and at any kappa that is small against `1 - s lambda`.
    fn inner_blocks_hold(&self, row: &Row<f64>, f3: f64) -> bool {
        let (mu, m, p) = (self.plane.mu(), self.modulus_bound(), row.g3 * f3);
        match self.plane.valence {
            3 => true,
            4 => p <= m * self.plane.lambda,
            5 => p <= m * mu,
            // block 3 has the largest trace; with the last block's bound this is |eigenvalues| <= m for all
            // between
            _ => p <= m * m && m * m - (row.g3 + f3 + row.h * (1.0 + self.plane.cosine(3))) * m + p >= 0.0,
        }
    }

    /// The feasible f2 at an f3 that fulfils the constraints on f3 alone.
    fn row_intervals(&self, f3: f64) -> Vec<F2Interval> {
        let (plane, mu) = (&self.plane, self.plane.mu());
        let row = Row::new(plane, f3);
        let end = |f2, curve| F2End { f2, curve };
        let (below_one, room) = (1.0 - row.g3 - 2.0 * row.h, row.t - self.margin * mu);
        // no f2 makes d1 >= 0, or z0 >= -m with a positive beta; h = 0 only on limits of the domain at N = 3
        if !(below_one >= 0.0 && room > 0.0 && row.h > 0.0 && self.inner_blocks_hold(&row, f3)) {
            return Vec::new();
        }
        let theta = (plane.lambda - f3) / (2.0 * plane.cos_half_sector());
        let mut lower = end(theta, ConstraintCurve::Theta);
        if row.h * f3 > theta * below_one {
            lower = end(row.h * f3 / below_one, ConstraintCurve::D1);
        }
        let mut upper = end((1.0 - f3) / 2.0, ConstraintCurve::F1);
        let excess = row.t - (2.0 - self.margin) * mu;
        if excess > 0.0 {
            let Some([smaller, larger]) = row.roots(row.linear(excess)) else {
                return Vec::new();
            };
            if smaller > lower.f2 {
                lower = end(smaller, ConstraintCurve::Z0Upper(Root::Smaller));
            }
            if larger < upper.f2 {
                upper = end(larger, ConstraintCurve::Z0Upper(Root::Larger));
            }
        }
        let (value, curve): (f64, fn(Root) -> ConstraintCurve) = if room < 1.0 {
            (room, ConstraintCurve::Z0Lower)
        } else {
            (1.0, ConstraintCurve::Centre)
        };
        let parts = match row.roots(row.linear(value)) {
            None => [Some((lower, upper)), None],
            Some([smaller, larger]) => {
                let below = end(smaller, curve(Root::Smaller));
                let above = end(larger, curve(Root::Larger));
                [
                    Some((lower, if below.f2 < upper.f2 { below } else { upper })),
                    Some((if above.f2 > lower.f2 { above } else { lower }, upper)),
                ]
            }
        };
        let parts = parts.into_iter().flatten();
        let parts = parts.filter(|(lower, upper)| lower.f2 <= upper.f2);
        parts.map(|(lower, upper)| F2Interval { lower, upper }).collect()
    }
}

/// The smallest positive root of `a x^2 + b x + c`; negative or not a number if there is none, as for `c <
/// 0`.
fn smallest_positive_root(a: f64, b: f64, c: f64) -> f64 {
    let radical = (b * b - 4.0 * a * c).sqrt();
    // of the two equal forms the one without cancellation
    if b <= 0.0 {
        2.0 * c / (radical - b)
    } else {
        (-b - radical) / (2.0 * a)
    }
}

/// Neighbouring numbers, the first of them `feasible` and the second not, between two numbers with these
/// properties.
fn bisect(mut inside: f64, mut outside: f64, feasible: impl Fn(f64) -> bool) -> (f64, f64) {
    loop {
        let middle = 0.5 * (inside + outside);
        if middle == inside || middle == outside {
            return (inside, outside);
        }
        if feasible(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
}
