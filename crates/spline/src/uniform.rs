//! Uniform B-splines on one knot interval, and their Bernstein form.
//!
//! On the interval `[0, 1]` between two knots a uniform spline of degree d is a combination of d+1
//! consecutive control values `c_0 .. c_d`. The basis follows from `N_0 = 1` by
//! `d N_j^d(t) = (t + d - j) N_{j-1}^{d-1} + (j + 1 - t) N_j^{d-1}` with j = 0 for the basis function that
//! ends first; derivatives are differences of lower degree. The Bernstein coefficient `b_i` is the blossom at
//! `0^(d-i) 1^i` (Ramshaw 1989), an affine combination with rational weights.

use crate::Scalar;

/// The values, first and second derivatives of the d+1 basis functions at `t` in `[0, 1]`:
/// `[values, first, second]`, each in the order of the control values.
pub fn basis<S: Scalar + Copy>(degree: usize, t: S) -> [Vec<S>; 3] {
    let first = match degree {
        0 => vec![S::zero(); 1],
        _ => differences(&values(degree - 1, t)),
    };
    let second = match degree {
        0 | 1 => vec![S::zero(); degree + 1],
        _ => differences(&differences(&values(degree - 2, t))),
    };
    [values(degree, t), first, second]
}

/// The values of the d+1 basis functions at `t`, without derivatives.
pub fn values<S: Scalar + Copy>(degree: usize, t: S) -> Vec<S> {
    let whole = |i: usize| S::ratio(i as i64, 1);
    let mut values = Vec::with_capacity(degree + 1);
    values.push(S::one());
    for d in 1..=degree {
        values.push(S::zero());
        // from the last function to the first, so that those of the lower degree are still there
        for j in (0..=d).rev() {
            let mut sum = S::zero();
            if j > 0 {
                sum += (t + whole(d - j)) * values[j - 1];
            }
            if j < d {
                sum += (whole(j + 1) - t) * values[j];
            }
            values[j] = sum / whole(d);
        }
    }
    values
}

/// The derivative of a basis from the basis of one degree less: `N_j' = N_{j-1} - N_j`.
fn differences<S: Scalar + Copy>(lower: &[S]) -> Vec<S> {
    (0..=lower.len())
        .map(|j| {
            let before = if j > 0 { lower[j - 1] } else { S::zero() };
            let at = lower.get(j).copied().unwrap_or(S::zero());
            before - at
        })
        .collect()
}

/// The matrix from control values to Bernstein coefficients: row i holds the weights of `b_i`.
pub fn to_bernstein<S: Scalar + Copy>(degree: usize) -> Vec<Vec<S>> {
    (0..=degree)
        .map(|i| {
            (0..=degree)
                .map(|j| {
                    let mut control = vec![S::zero(); degree + 1];
                    control[j] = S::one();
                    blossom(control, degree - i)
                })
                .collect()
        })
        .collect()
}

/// The blossom of the spline segment at `zeros` zeros and ones for the rest, by de Boor's recursion. Knots
/// are the integers `1-d .. d`.
fn blossom<S: Scalar + Copy>(mut values: Vec<S>, zeros: usize) -> S {
    let degree = values.len() - 1;
    for round in 1..=degree {
        let argument = if round <= zeros { 0 } else { 1 };
        for j in 0..=degree - round {
            // between the knots j + round - degree and j + 1
            let (low, high) = ((j + round) as i64 - degree as i64, j as i64 + 1);
            let upper = S::ratio(argument - low, high - low);
            values[j] = values[j] * (S::one() - upper) + values[j + 1] * upper;
        }
    }
    values[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Dual;

    #[test]
    fn bases_are_partitions_of_unity_with_exact_derivatives() {
        for degree in 0..9 {
            for i in 0..=4 {
                let t = f64::from(i) / 4.0;
                let [values, first, second] = basis(degree, t);
                assert_eq!(values.len(), degree + 1);
                assert!((values.iter().sum::<f64>() - 1.0).abs() < 1e-14);
                assert!(values.iter().all(|&v| v >= 0.0));
                let dual = basis(degree, Dual::<Dual<f64>>::variable(Dual::variable(t, 0), 0));
                for j in 0..=degree {
                    assert!((dual[0][j].parts[0].value - first[j]).abs() < 1e-13);
                    assert!((dual[0][j].parts[0].parts[0] - second[j]).abs() < 1e-12);
                }
            }
        }
        let [cubic, ..] = basis(3, 0.0);
        for (value, expected) in cubic.iter().zip([1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0]) {
            assert!((value - expected).abs() < 1e-16);
        }
    }

    #[test]
    fn bernstein_form_is_the_same_polynomial() {
        for degree in 0..8 {
            let matrix = to_bernstein::<f64>(degree);
            for i in 0..=5 {
                let t = f64::from(i) / 5.0;
                let [values, ..] = basis(degree, t);
                let mut binomial = 1.0;
                let mut sum = vec![0.0; degree + 1];
                for (i, row) in matrix.iter().enumerate() {
                    let bernstein = binomial * t.powi(i as i32) * (1.0 - t).powi((degree - i) as i32);
                    binomial *= (degree - i) as f64 / (i + 1) as f64;
                    for (sum, weight) in sum.iter_mut().zip(row) {
                        *sum += bernstein * weight;
                    }
                }
                for (sum, value) in sum.iter().zip(&values) {
                    assert!((sum - value).abs() < 1e-13, "degree {degree}");
                }
            }
        }
    }
}
