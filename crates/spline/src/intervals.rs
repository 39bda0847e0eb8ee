//! The rules of cubic B-splines by knot intervals.
//!
//! Points `P_j` of a line have intervals `d_j >= 0` between `P_j` and `P_(j+1)`: with knots t_j, `d_j =
//! t_(j+1) - t_j`, and `P_j = f(t_(j-1), t_j, t_(j+1))` for the polar form f. Halving all intervals makes a
//! point on each edge and one beside each old point (Boehm's insertion of a knot in the middle of each
//! interval; Sederberg, Zheng, Sewell and Sabin 1998):
//!
//! ```text
//! E_j = ((d_j + 2 d_(j+1)) P_j + (d_j + 2 d_(j-1)) P_(j+1)) / (2 (d_(j-1) + d_j + d_(j+1)))
//! V_j = P_j / 2 + (d_j E_(j-1) + d_(j-1) E_j) / (2 (d_(j-1) + d_j))
//!
//! all three intervals of E_j zero: the mean;   both of V_j zero: P_j
//! ```
//!
//! and values of the polar form at double and triple knots, the Bezier points and the limit, are
//!
//! ```text
//! f(t_j, t_j, t_(j+1)) = ((d_j + d_(j+1)) P_j + d_(j-1) P_(j+1)) / (d_(j-1) + d_j + d_(j+1))
//! f(t_j, t_j, t_j)     = (d_j f(t_(j-1), t_j, t_j) + d_(j-1) f(t_j, t_j, t_(j+1))) / (d_(j-1) + d_j)
//! ```
//!
//! Zero intervals, which are multiple knots, need nothing else. Intervals are doubles, by which branches are
//! decided; weights are in any [`Scalar`].

use crate::Scalar;

/// The weights of `P_j` and `P_(j+1)` in `E_j`, from the intervals `d_(j-1), d_j, d_(j+1)`.
pub fn edge<S: Scalar>(intervals: [f64; 3]) -> [S; 2] {
    if intervals.iter().all(|&d| d == 0.0) {
        return [S::ratio(1, 2), S::ratio(1, 2)];
    }
    let two = || S::ratio(2, 1);
    let [a, b, c] = intervals.map(S::exact);
    let sum = two() * (a.clone() + b.clone() + c.clone());
    [(b.clone() + two() * c) / sum.clone(), (b + two() * a) / sum]
}

/// The weights of `P_(j-1), P_j, P_(j+1)` in `V_j`, from the intervals `d_(j-2), .., d_(j+1)`.
pub fn vertex<S: Scalar>([far, before, after, beyond]: [f64; 4]) -> [S; 3] {
    if before + after == 0.0 {
        return [S::zero(), S::one(), S::zero()];
    }
    let sum = S::ratio(2, 1) * (S::exact(before) + S::exact(after));
    let [towards, back] = [after, before].map(|d| S::exact(d) / sum.clone());
    let [p, q] = edge::<S>([far, before, after]);
    let [r, s] = edge::<S>([before, after, beyond]);
    [
        towards.clone() * p,
        S::ratio(1, 2) + (towards * q + back.clone() * r),
        back * s,
    ]
}

/// The weights of `P_j` and `P_(j+1)` in `f(t_j, t_j, t_(j+1))`, from the intervals `d_(j-1), d_j, d_(j+1)`,
/// not all of them zero. Those of `f(t_j, t_(j+1), t_(j+1))` are the same from the other end.
pub fn doubled<S: Scalar>(intervals: [f64; 3]) -> [S; 2] {
    let [a, b, c] = intervals.map(S::exact);
    let sum = a.clone() + b.clone() + c.clone();
    [(b + c) / sum.clone(), a / sum]
}

/// The weights of `P_(j-1), P_j, P_(j+1)` in the limit `f(t_j, t_j, t_j)`, from the intervals `d_(j-2), ..,
/// d_(j+1)`; those of `P_j` alone where both intervals beside it are zero.
pub fn limit<S: Scalar>([far, before, after, beyond]: [f64; 4]) -> [S; 3] {
    if before + after == 0.0 {
        return [S::zero(), S::one(), S::zero()];
    }
    let sum = S::exact(before) + S::exact(after);
    let [towards, back] = [after, before].map(|d| S::exact(d) / sum.clone());
    let [q, p] = doubled::<S>([after, before, far]);
    let [r, s] = doubled::<S>([before, after, beyond]);
    [towards.clone() * p, towards * q + back.clone() * r, back * s]
}

/// The weights of `P_(j-1) .. P_(j+2)` at the parameter u of the span from `t_j = 0` to `t_(j+1) = d_j`, and
/// those of the first and second derivative, from the intervals `d_(j-2), .., d_(j+2)`, of which `d_j` is
/// positive (Piegl and Tiller, *The NURBS Book*, 1997, algorithms A2.2 and A2.3).
pub fn basis<S: Scalar>([before, left, own, right, after]: [f64; 5], u: S) -> [[S; 4]; 3] {
    let s = S::exact;
    let ahead = [s(own), s(own) + s(right), s(own) + s(right) + s(after)].map(|t| t - u.clone());
    let behind = [u.clone(), u.clone() + s(left), u + s(left) + s(before)];
    let mut weights: [S; 4] = [S::one(), S::zero(), S::zero(), S::zero()];
    let (mut linear, mut quadratic) = (weights.clone(), weights.clone());
    for degree in 1..4 {
        if degree == 2 {
            linear = weights.clone();
        }
        if degree == 3 {
            quadratic = weights.clone();
        }
        let mut saved = S::zero();
        for r in 0..degree {
            let (near, far) = (ahead[r].clone(), behind[degree - 1 - r].clone());
            let part = weights[r].clone() / (near.clone() + far.clone());
            weights[r] = saved + near * part.clone();
            saved = far * part;
        }
        weights[degree] = saved;
    }
    // a derivative is differences of the basis of one degree less, scaled
    let sizes = [
        s(before) + s(left) + s(own),
        s(left) + s(own) + s(right),
        s(own) + s(right) + s(after),
    ];
    let differences = |of: [S; 3]| {
        let [a, b, c]: [S; 3] = std::array::from_fn(|k| S::ratio(3, 1) * of[k].clone() / sizes[k].clone());
        [-a.clone(), a - b.clone(), b - c.clone(), c]
    };
    let [p, q, ..] = linear;
    let p = S::ratio(2, 1) * p / (s(left) + s(own));
    let q = S::ratio(2, 1) * q / (s(own) + s(right));
    let second = differences([-p.clone(), p - q.clone(), q]);
    let [a, b, c, _] = quadratic;
    [weights, differences([a, b, c]), second]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The polar form of a cubic polynomial with coefficients c (lowest first).
    fn polar(c: [f64; 4], [a, b, d]: [f64; 3]) -> f64 {
        c[0] + c[1] * (a + b + d) / 3.0 + c[2] * (a * b + a * d + b * d) / 3.0 + c[3] * a * b * d
    }

    proptest! {
        /// Points of a cubic polynomial are values of its polar form at three knots, refined ones at three
        /// refined knots, limits at a triple knot; intervals may vanish.
        #[test]
        fn rules_are_values_of_the_polar_form(
            d in proptest::array::uniform4(prop_oneof![Just(0.0), 0.1..3.0_f64]),
            c in proptest::array::uniform4(-1.0..1.0_f64),
        ) {
            // t_(j-2) .. t_(j+2) with t_j = 0
            let t = [-d[0] - d[1], -d[1], 0.0, d[2], d[2] + d[3]];
            let points = [1, 2, 3].map(|j| polar(c, [t[j - 1], t[j], t[j + 1]]));
            let sum = |weights: &[f64], points: &[f64]| -> f64 {
                weights.iter().zip(points).map(|(w, p)| w * p).sum()
            };
            let half = |j: usize| (t[j] + t[j + 1]) / 2.0;
            if d[1] + d[2] + d[3] > 0.0 {
                let found = sum(&edge::<f64>([d[1], d[2], d[3]]), &points[1..]);
                prop_assert!((found - polar(c, [t[2], half(2), t[3]])).abs() < 1e-12);
                let found = sum(&doubled::<f64>([d[1], d[2], d[3]]), &points[1..]);
                prop_assert!((found - polar(c, [t[2], t[2], t[3]])).abs() < 1e-12);
            }
            let (own, u) = (d[2] + 0.1, 0.3 * (d[2] + 0.1));
            let knots = [-d[0] - d[1], -d[1], 0.0, own, own + d[3], own + d[3] + d[0]];
            let four = [1, 2, 3, 4].map(|j| polar(c, [knots[j - 1], knots[j], knots[j + 1]]));
            let [values, slopes, bends] = basis::<f64>([d[0], d[1], own, d[3], d[0]], u);
            prop_assert!((sum(&values, &four) - polar(c, [u; 3])).abs() < 1e-12);
            let slope = c[1] + 2.0 * c[2] * u + 3.0 * c[3] * u * u;
            prop_assert!((sum(&slopes, &four) - slope).abs() < 1e-11);
            prop_assert!((sum(&bends, &four) - 2.0 * c[2] - 6.0 * c[3] * u).abs() < 1e-9);
            if d[1] + d[2] > 0.0 {
                let found = sum(&vertex::<f64>(d), &points);
                prop_assert!((found - polar(c, [half(1), t[2], half(2)])).abs() < 1e-12);
                let found = sum(&limit::<f64>(d), &points);
                prop_assert!((found - polar(c, [t[2]; 3])).abs() < 1e-12);
            }
        }
    }
}
