//! Is a point feasible, and if not, what does it miss by how much?

use super::{Bounds, Constraint, Domain};
use crate::Error;
use crate::lambda::Plane;
use std::fmt;

/// A point that was refused: which bound it misses, by how much, and what would have been accepted.
#[derive(Clone, Debug, PartialEq)]
pub struct InfeasiblePoint {
    /// The face stencil's weight of each edge neighbour.
    pub f2: f64,
    /// The face stencil's weight of the opposite corner.
    pub f3: f64,
    /// The valence of the domain.
    pub valence: usize,
    /// The lambda of the domain.
    pub lambda: f64,
    /// The missed bound.
    pub constraint: Constraint,
    /// The coordinate in which it is missed, "f2" or "f3".
    pub coordinate: &'static str,
    /// The distance from the bound in that coordinate.
    pub distance: f64,
    /// The accepted intervals of f2 at this f3 (at the nearest accepted f3, if this one is not).
    pub f2_accepted: Vec<[f64; 2]>,
    /// The accepted range of f3.
    pub f3_accepted: [f64; 2],
}

impl fmt::Display for InfeasiblePoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [low, high] = self.f3_accepted;
        write!(
            f,
            "f2 = {}, f3 = {} is not feasible at N = {}, lambda = {}: {} is missed by {:.6e} in {}; accepted is ",
            self.f2,
            self.f3,
            self.valence,
            self.lambda,
            self.constraint.inequality(),
            self.distance,
            self.coordinate
        )?;
        if self.coordinate == "f2" {
            for (i, [low, high]) in self.f2_accepted.iter().enumerate() {
                let or = if i > 0 { " or " } else { "" };
                write!(f, "{or}{low} <= f2 <= {high}")?;
            }
            write!(f, " at this f3 and ")?;
        }
        write!(f, "{low} <= f3 <= {high}")
    }
}

impl std::error::Error for InfeasiblePoint {}

impl Plane<f64> {
    /// Every constraint of this valence with its slack at (f2, f3): negative where violated, and minus
    /// infinity where the stencil is not defined. Units are those of the weight, of the eigenvalue, or for
    /// theta of f2: `2 f2 cos(pi/N) - (lambda-f3)`. Computed from the stencil and the spectrum, not from the
    /// curves of [`Domain`].
    pub fn slack(&self, bounds: Bounds, margin: f64, f2: f64, f3: f64) -> Vec<(Constraint, f64)> {
        let (plane, n, m) = (self, self.valence, (1.0 - margin) * self.mu());
        let w = plane.stencil(f2, f3).weights;
        let (g3, h) = plane.g3_and_h(f3);
        let z0 = self.z0(f2, f3);
        let theta = if f3 < plane.lambda {
            2.0 * f2 * plane.cos_half_sector() - (plane.lambda - f3)
        } else {
            plane.lambda - f3
        };
        let mut slack = vec![
            (Constraint::F1, w.f1),
            (Constraint::F2, f2),
            (Constraint::F3, f3),
            (Constraint::D1, w.d1),
            (Constraint::D2, w.d2),
            (Constraint::E1, w.e1),
            (Constraint::E2, w.e2),
            (Constraint::Beta, w.beta),
            (Constraint::Centre, 1.0 - w.alpha - w.beta),
            (Constraint::Theta, theta),
            (Constraint::Z0Lower, z0 + m),
            (Constraint::Z0Upper, m - z0),
        ];
        if n == 4 {
            slack.push((Constraint::F3EqualsMu, -(f3 - plane.mu()).abs()));
            slack.push((Constraint::InnerBlocks, m - f3 * g3 / plane.lambda));
        } else if n > 4 {
            let second = |ev: f64| (f3 * g3 / ev).abs();
            let radius = |k: usize| spectral_radius(g3 + f3 + h * (1.0 + plane.cosine(k as i64)), f3 * g3);
            let exact = m - if n == 5 { second(plane.mu()) } else { radius(n / 2) };
            let last = match bounds {
                Bounds::Sharp => exact,
                Bounds::Paper => exact.min(m + g3),
            };
            let inner = (3..n / 2).map(radius).fold(second(plane.lambda), f64::max);
            let inner = if n > 5 { inner.max(second(plane.mu())) } else { inner };
            slack.push((Constraint::LastBlock, last));
            slack.push((Constraint::InnerBlocks, m - inner));
        }
        for (_, value) in &mut slack {
            if value.is_nan() {
                *value = f64::NEG_INFINITY;
            }
        }
        slack
    }

    /// The last eigenvalue of block 0, beside 1 and mu; like the stencil not a number where beta's
    /// denominator and `h` vanish.
    pub fn z0(&self, f2: f64, f3: f64) -> f64 {
        let (g3, h) = self.g3_and_h(f3);
        let beta = self.stencil(f2, f3).weights.beta;
        g3 + 2.0 * h + f3 - (1.0 + self.phi) * beta - self.mu()
    }
}

impl Domain {
    /// Every constraint of this valence with its slack at (f2, f3): [`Plane::slack`] with this domain's
    /// bounds and margin.
    pub fn slack(&self, f2: f64, f3: f64) -> Vec<(Constraint, f64)> {
        self.plane.slack(self.bounds, self.margin, f2, f3)
    }

    /// Whether no constraint is violated.
    pub fn contains(&self, f2: f64, f3: f64) -> bool {
        self.slack(f2, f3).iter().all(|&(_, slack)| slack >= 0.0)
    }

    /// Accepts points of the domain and those within `tolerance` of it: f3 within `tolerance` of its range,
    /// and f2 within `tolerance` of an interval at the nearest f3 of the range.
    ///
    /// # Errors
    /// [`Error::Point`] with the missed bound, its distance, and what is accepted.
    pub fn check(&self, f2: f64, f3: f64, tolerance: f64) -> Result<(), Error> {
        let [lower, upper] = self.f3;
        let nearest = f3.clamp(lower.f3, upper.f3);
        let intervals = self.f2_intervals(nearest);
        let refuse = |constraint, coordinate, distance| {
            Err(Error::Point(Box::new(InfeasiblePoint {
                f2,
                f3,
                valence: self.plane.valence,
                lambda: self.plane.lambda,
                constraint,
                coordinate,
                distance,
                f2_accepted: intervals.iter().map(|i| [i.lower.f2, i.upper.f2]).collect(),
                f3_accepted: [lower.f3, upper.f3],
            })))
        };
        let f3_distance = (f3 - nearest).abs();
        if f3_distance.is_nan() || f3_distance > tolerance {
            let end = if f3 > upper.f3 { upper } else { lower };
            // where the domain ends in a point, the bound of f2 that is nearer to the given one names the end
            let edge = end.edge.or_else(|| self.nearest_end(f2, end.f3).map(|(c, _)| c));
            return refuse(edge.unwrap_or(Constraint::Theta), "f3", f3_distance);
        }
        match self.nearest_end(f2, nearest) {
            Some((_, distance)) if distance <= tolerance => Ok(()),
            Some((constraint, distance)) => refuse(constraint, "f2", distance),
            None => {
                // an empty row, at a phi other than 6: name what is violated most
                let worst = self.slack(f2, nearest).into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
                refuse(
                    worst.map_or(Constraint::Theta, |(constraint, _)| constraint),
                    "f2",
                    f64::INFINITY,
                )
            }
        }
    }

    /// The point with f3 moved into its range and then f2 to the nearest feasible one: the identity on the
    /// domain. `None` for a NaN, or where the row is empty.
    pub fn clamp(&self, f2: f64, f3: f64) -> Option<[f64; 2]> {
        let f3 = f3.clamp(self.f3[0].f3, self.f3[1].f3);
        let candidates = self.f2_intervals(f3).into_iter();
        let candidates = candidates.map(|i| f2.clamp(i.lower.f2, i.upper.f2));
        let nearest = candidates.min_by(|a, b| (a - f2).abs().total_cmp(&(b - f2).abs()))?;
        (!nearest.is_nan()).then_some([nearest, f3])
    }

    /// The last eigenvalue of block 0: [`Plane::z0`].
    pub fn z0(&self, f2: f64, f3: f64) -> f64 {
        self.plane.z0(f2, f3)
    }

    /// The angle of the natural configuration at F, in the triangle V E F.
    pub fn theta(&self, f2: f64, f3: f64) -> f64 {
        let angle = std::f64::consts::PI / self.plane.valence as f64;
        // F is at the radius r/d and at half a sector from E, which is at 1; both sides times d^2
        let (r, d) = (2.0 * f2 * angle.cos(), self.plane.lambda - f3);
        ((r * d).abs() * angle.sin()).atan2(r * (r - d * angle.cos()))
    }

    /// The largest admitted theta, `pi/2 - pi/(2N)`.
    pub fn theta_max(&self) -> f64 {
        std::f64::consts::FRAC_PI_2 * (1.0 - 1.0 / self.plane.valence as f64)
    }

    /// The end nearest to f2 of an interval at f3, with its distance; distance 0 inside an interval.
    fn nearest_end(&self, f2: f64, f3: f64) -> Option<(Constraint, f64)> {
        let intervals = self.f2_intervals(f3);
        let mut nearest: Option<(Constraint, f64)> = None;
        for interval in &intervals {
            let candidate = if f2 > interval.upper.f2 {
                (interval.upper.curve.constraint(), f2 - interval.upper.f2)
            } else {
                // a NaN stays one and is refused by every comparison with a tolerance
                (
                    interval.lower.curve.constraint(),
                    (interval.lower.f2 - f2).clamp(0.0, f64::INFINITY),
                )
            };
            if nearest.is_none_or(|(_, distance)| candidate.1 < distance) {
                nearest = Some(candidate);
            }
        }
        nearest
    }
}

/// The largest modulus of the roots of `x^2 - trace x + det`.
fn spectral_radius(trace: f64, det: f64) -> f64 {
    let discriminant = 0.25 * trace * trace - det;
    if discriminant < 0.0 {
        det.sqrt()
    } else {
        0.5 * trace.abs() + discriminant.sqrt()
    }
}
