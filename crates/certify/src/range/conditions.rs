//! Statements about eigenvalues in closed form.
//!
//! In block k the two one-ring eigenvalues are the roots of `x^2 - T_k x + p`, `p = f3 g3`. By the criterion of Jury both lie inside
//! a disc of radius m exactly if `|p| < m^2` and `m^2 -+ T_k m + p > 0`, that is
//!
//! ```text
//! (m - f3)(m - g3) - h m (1 + c_k) > 0         (m + f3)(m + g3) + h m (1 + c_k) > 0
//! ```
//!
//! The first is `h m (c_j - c_k) + ...` with equality at `m = lambda, j = 1` and `m = mu, j = 2` (see
//! [`Identities`](crate::Identities)), so that for k >= 3 it says `h > 0`; the second is linear in `c_k` and then decided by the last
//! block, K = floor(N/2), alone. Besides there are p/lambda in block 1, p/mu in block 2 and z0 in block 0. At N = 3 there are only
//! blocks 0 and 1, with mu in block 1; at N = 4 block 2 has g3 = f3 = mu. Outer rings have the eigenvalues
//! 1/8, 1/16, 1/32, 1/64 in every block, and zero.

use super::point::Point;
use crate::{Centred, Enclose, Interval, Status, Witness};
use eigenring_scheme::Scalar;

/// Whether a number is positive.
fn positive(value: Centred<1>) -> Status {
    let range = value.enclosure();
    if range.certainly_positive() {
        Status::Proven
    } else if range.hi() <= 0.0 {
        Status::Refuted
    } else {
        Status::Undecided
    }
}

/// A conjunction.
fn all(statuses: impl IntoIterator<Item = Status>) -> Status {
    statuses
        .into_iter()
        .fold(Status::Proven, |all, status| match (all, status) {
            (Status::Refuted, _) | (_, Status::Refuted) => Status::Refuted,
            (Status::Proven, status) => status,
            (all, _) => all,
        })
}

/// Numbers that are positive exactly if all eigenvalues other than 1, lambda and mu have a modulus below m, where m is lambda or mu.
fn gaps(point: &Point, m: Centred<1>) -> Vec<(&'static str, Centred<1>)> {
    let (n, plane) = (point.plane.valence, &point.plane);
    let (mu, f3, g3, h) = (plane.mu(), point.f3, point.stencil.g3, point.h);
    let z0 = point.z0();
    let mut gaps = vec![
        ("m - 1/8", m - Centred::ratio(1, 8)),
        ("m - z0", m - z0),
        ("m + z0", m + z0),
    ];
    if n >= 5 {
        let p = f3 * g3;
        // p/lambda and p/mu below m; mu is the smaller
        gaps.extend([("m mu - p", m * mu - p), ("m mu + p", m * mu + p)]);
    }
    if n >= 6 {
        let last = Centred::one() + plane.cosine((n / 2) as i64);
        gaps.push(("h", h));
        let product = if n.is_multiple_of(2) {
            // both factors of (m + f3)(m + g3): positive, or their product is not with the sum below zero
            gaps.push(("m + f3", m + f3));
            m + g3
        } else {
            (m + f3) * (m + g3) + h * m * last
        };
        gaps.push(("last block", product));
    }
    gaps
}

/// `dominant` and `subdominant`.
pub fn subdominant(point: &Point) -> Vec<Status> {
    let (lambda, mu) = (point.plane.lambda, point.plane.mu());
    let inside = [
        positive(lambda),
        positive(mu),
        positive(Centred::one() - lambda),
        positive(lambda - mu),
    ];
    let below = gaps(point, lambda).into_iter().map(|(_, gap)| positive(gap));
    let subdominant = all(inside.into_iter().chain(below));
    // lambda < 1, so if it leads, everything else but 1 lies inside the unit disc
    let dominant = if subdominant == Status::Proven {
        Status::Proven
    } else {
        Status::Undecided
    };
    vec![dominant, subdominant]
}

/// `bounded_curvature` and `strict`.
pub fn second_order(point: &Point) -> Vec<Status> {
    let (mu, lambda) = (point.plane.mu(), point.plane.lambda);
    let mut gaps = gaps(point, mu);
    gaps.push(("lambda - mu", lambda - mu));
    let strict = all(gaps.iter().map(|(_, gap)| positive(*gap)));
    let bounded = if point.is_bounded() {
        // mu = lambda^2 by the formula, and others may equal it: only a larger one refutes
        let larger = gaps.iter().any(|(_, gap)| gap.enclosure().certainly_negative());
        match strict {
            Status::Refuted if !larger => Status::Undecided,
            status => status,
        }
    } else {
        match positive(point.plane.s - Centred::one()) {
            Status::Proven => Status::Refuted,
            _ => Status::Undecided,
        }
    };
    vec![bounded, strict]
}

/// The numbers at a point, for a witness.
pub fn describe(point: &Point, witness: Witness) -> Witness {
    let number = |x: Centred<1>| -> Interval { x.enclosure() };
    witness
        .with("s", number(point.plane.s))
        .with("mu", number(point.plane.mu()))
        .with("f2", number(point.f2))
        .with("f3", number(point.f3))
        .with("g3", number(point.stencil.g3))
        .with("z0", number(point.z0()))
}
