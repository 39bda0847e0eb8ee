//! Statements about eigenvalues in closed form.
//!
//! In block k the two one-ring eigenvalues are the roots of `x^2 - T_k x + p`, `p = f3 g3`. By the criterion
//! of Jury both lie inside a disc of radius m exactly if `|p| < m^2` and `m^2 -+ T_k m + p > 0`, that is
//!
//! ```text
//! (m - f3)(m - g3) - h m (1 + c_k) > 0         (m + f3)(m + g3) + h m (1 + c_k) > 0
//! ```
//!
//! The first is `h m (c_j - c_k) + ...` with equality at `m = lambda, j = 1` and `m = mu, j = 2` (see
//! [`Identities`](crate::Identities)), so that for k >= 3 it says `h > 0`; the second is linear in `c_k` and
//! then decided by the last block, K = floor(N/2), alone. Besides there are p/lambda in block 1, p/mu in
//! block 2 and z0 in block 0. At N = 3 there are only blocks 0 and 1, with mu in block 1; at N = 4 block 2
//! has g3 = f3 = mu. Outer rings have the eigenvalues 1/8, 1/16, 1/32, 1/64 in every block, and zero.

use super::stencil_box::StencilBox;
use crate::{Centred, Enclose, Interval, Status, Witness};
use eigenring_spline::Scalar;

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

/// Numbers that are positive exactly if all eigenvalues other than 1, lambda and mu have a modulus below m,
/// where m is lambda or mu.
fn gaps(point: &StencilBox, m: Centred<1>) -> Vec<(&'static str, Centred<1>)> {
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
pub fn subdominant(point: &StencilBox) -> Vec<Status> {
    let (lambda, mu) = (point.plane.lambda, point.plane.mu());
    let inside = [
        positive(lambda),
        positive(mu),
        positive(Centred::one() - lambda),
        positive(lambda - mu),
    ];
    let below = gaps(point, lambda).into_iter().map(|(_, gap)| positive(gap));
    // the statement is sufficient for C1: that it fails proves nothing of the surface
    let subdominant = match inside.into_iter().chain(below).fold(Status::Proven, Status::and) {
        Status::Refuted => Status::Undecided,
        status => status,
    };
    // lambda < 1, so if it leads, everything else but 1 lies inside the unit disc
    let dominant = if subdominant == Status::Proven {
        Status::Proven
    } else {
        Status::Undecided
    };
    vec![dominant, subdominant]
}

/// `bounded_curvature` and `strict`.
pub fn second_order(point: &StencilBox) -> Vec<Status> {
    let (mu, lambda) = (point.plane.mu(), point.plane.lambda);
    let mut gaps = gaps(point, mu);
    gaps.push(("lambda - mu", lambda - mu));
    let strict = gaps
        .iter()
        .map(|(_, gap)| positive(*gap))
        .fold(Status::Proven, Status::and);
    let bounded = if point.has_square() {
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
pub fn describe(point: &StencilBox, witness: Witness) -> Witness {
    let number = |x: Centred<1>| -> Interval { x.enclosure() };
    witness
        .with("s", number(point.plane.s))
        .with("mu", number(point.plane.mu()))
        .with("f2", number(point.f2))
        .with("f3", number(point.f3))
        .with("g3", number(point.stencil.g3))
        .with("z0", number(point.z0()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Input;
    use crate::exact::{Field, block_polynomial};
    use crate::find;
    use crate::range::{Problem, StencilCurve, stencil_box};
    use crate::spectral::{EnclosedSpectrum, problem_of};
    use eigenring_scheme::Exact;
    use eigenring_scheme::families::catmull_clark_weights;
    use eigenring_spectral::SecondOrder;
    use num_bigint::BigInt;
    use num_rational::BigRational;

    /// The second ring adds 1/8, 1/16, 1/32 and 1/64 to every block. Its part of the block has entries of
    /// degree at most 2 in w, so that the coefficients of its characteristic polynomial are determined by
    /// their values at the 17 roots of unity of order 17 (of which conjugate ones need no second look).
    #[test]
    fn the_second_ring_has_its_four_eigenvalues_in_every_block() {
        for valence in [3, 4, 5, 6, 7, 8, 17] {
            let field = Field::new(valence);
            let scheme = catmull_clark_weights::<Exact>(valence).scheme("", valence).unwrap();
            for index in 0..=valence / 2 {
                let [inner, both] = [1, 2].map(|rings| block_polynomial(&field, scheme.limit(), rings, index).unwrap());
                let (quotient, remainder) = both.divide(&inner, &field).unwrap();
                assert!(remainder.is_zero(), "{valence} {index}");
                assert_eq!(quotient.degree(), 4);
                for power in [8, 16, 32, 64] {
                    let value = field.rational(BigRational::new(BigInt::from(1), BigInt::from(power)));
                    assert!(quotient.at(&value, &field).is_empty(), "{valence} {index} 1/{power}");
                }
            }
        }
    }

    /// The closed forms say the same of a single lambda as the enclosed eigenvalues of the whole matrix.
    #[test]
    fn closed_forms_agree_with_the_matrix() {
        for valence in [3, 4, 5, 6, 7, 8, 11, 16, 20] {
            let problem = Problem::new(valence, &StencilCurve::embedded(valence).unwrap(), [0.15, 0.9]).unwrap();
            for lambda in [0.2, 0.45, 0.6, 0.85, 0.89] {
                let points = stencil_box::points(&problem, [lambda, lambda]).unwrap();
                assert_eq!(points.len(), 1);
                let point = &points[0];
                let number = |x: Centred<1>| x.enclosure();
                let (s, f2, f3) = (number(point.plane.s), number(point.f2), number(point.f3));
                let input = Input::Lambda {
                    lambda,
                    s: s.mid(),
                    f2: f2.mid(),
                    f3: (valence != 4).then_some(f3.mid()),
                };
                let whole = problem_of(&input, valence).unwrap().unwrap();
                let evidence = find::evidence(&whole.blocks);
                let spectrum = EnclosedSpectrum::new(whole, &evidence);
                let mu = number(point.plane.mu()).mid();
                let mut moduli: Vec<f64> = spectrum.entries.iter().map(|e| e.value.modulus().mid()).collect();
                moduli.sort_by(|a, b| b.total_cmp(a));
                // without lambda and the second-order ones
                let skip = 1 + SecondOrder::of(valence).iter().map(|of| of.copies).sum::<usize>();
                let largest = moduli[skip];
                assert_eq!(
                    largest < mu,
                    second_order(point)[1] == Status::Proven,
                    "{valence} {lambda}: {largest} {mu}"
                );
                assert!((moduli[0] - lambda).abs() < 1e-12);
            }
        }
    }
}
