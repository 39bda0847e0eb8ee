//! The eigenvalues of one component.

use crate::Interval;
use crate::linear::{Eigenpair, Eigenvalue, eigenpair, lift, norm, pair, quotient, radius_below};
use eigenring_spectral::Matrix;
use serde::{Deserialize, Serialize};

/// How a component comes apart: approximations of simple real eigenpairs to divide out, each a pair of the
/// matrix that the ones before have left, and a bound for what remains. Anything may be wrong here; it is not
/// believed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Peel {
    /// Eigenvalues and vectors, in the order of division.
    pub pairs: Vec<(f64, Vec<f64>)>,
    /// A bound of the moduli of the remaining eigenvalues.
    pub rest: Option<Rest>,
}

/// A claim that all eigenvalues lie below a radius, with the factor that shows it: see [`radius_below`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rest {
    /// The radius.
    pub radius: f64,
    /// The upper triangle of the factor, by rows.
    pub factor: Vec<f64>,
}

/// An enclosed eigenvalue, with its vector on the component if it is simple there and real.
#[derive(Clone, Debug)]
pub struct Located {
    /// The enclosed eigenvalue.
    pub value: Eigenvalue,
    /// The vector, which is not zero. It is exactly 1 at some entry if its pair was the first to be divided
    /// out, or none was. Others are so in the quotient where they were found, and not once they are lifted.
    /// No claim is made of the largest entry, least of all beyond the component: where outer rings follow the
    /// vector it may be there. Checks of the map do not depend on the scale.
    pub vector: Option<Vec<Interval>>,
}

/// All eigenvalues of an interval matrix: enclosed ones, and possibly a number of further ones whose moduli
/// are strictly below a radius.
pub fn enclose(matrix: &Matrix<Interval>, peel: &Peel) -> (Vec<Located>, Option<(usize, f64)>) {
    let mut stack: Vec<(Matrix<Interval>, Eigenpair)> = Vec::new();
    let mut current = matrix.clone();
    for (value, vector) in &peel.pairs {
        if current.rows() <= 2 || vector.len() != current.rows() {
            break;
        }
        let Some(found) = eigenpair(&current, *value, vector) else {
            break;
        };
        let next = quotient(&current, &found.vector, found.pivot);
        stack.push((current, found));
        current = next;
    }
    let mut rest = None;
    let mut located = match current.rows() {
        0 => Vec::new(),
        1 => vec![Located {
            value: Eigenvalue::real(current[(0, 0)]),
            vector: Some(vec![Interval::point(1.0)]),
        }],
        2 => pair_with_vectors(&current),
        size => {
            let proven = peel.rest.as_ref().filter(|rest| {
                let factor = rest.matrix(size);
                factor.is_some_and(|factor| radius_below(&current, &factor, rest.radius))
            });
            // a modulus may be as large as the norm, and the claim is that all are smaller
            let radius = proven.map_or(norm(&current).next_up(), |proven| proven.radius);
            rest = Some((size, radius));
            Vec::new()
        }
    };
    // back up: vectors of the quotients become vectors of the matrices above
    for (above, divided) in stack.iter().rev() {
        for entry in &mut located {
            let vector = entry.vector.take();
            entry.vector = vector.and_then(|vector| lift(above, divided, entry.value.re, &vector));
        }
        located.insert(
            0,
            Located {
                value: Eigenvalue::real(divided.value),
                vector: Some(divided.vector.clone()),
            },
        );
    }
    (located, rest)
}

impl Rest {
    /// The factor as a matrix; `None` if there are too few or too many numbers.
    fn matrix(&self, size: usize) -> Option<Matrix<f64>> {
        (self.factor.len() == size * (size + 1) / 2).then(|| {
            Matrix::from_fn(size, size, |i, j| {
                if j < i {
                    0.0
                } else {
                    self.factor[i * size - i * (i + 1) / 2 + j]
                }
            })
        })
    }
}

/// Both eigenvalues of a 2 x 2 matrix with their vectors, each scaled to exactly 1 at the entry with the
/// larger middle.
fn pair_with_vectors(matrix: &Matrix<Interval>) -> Vec<Located> {
    let values = pair(matrix);
    let simple = values[0].is_real() && values[1].is_real() && values[0].re.disjoint(values[1].re);
    let (a, b, c, d) = (matrix[(0, 0)], matrix[(0, 1)], matrix[(1, 0)], matrix[(1, 1)]);
    let one = Interval::point(1.0);
    let vector = |value: Interval| {
        // (b, value - a) and (value - d, c), of which the larger is not zero
        let candidates = [(b, value - a), (value - d, c)];
        let size = |(x, y): (Interval, Interval)| x.mid().abs().max(y.mid().abs());
        let (x, y) = if size(candidates[0]) >= size(candidates[1]) {
            candidates[0]
        } else {
            candidates[1]
        };
        if x.mid().abs() >= y.mid().abs() {
            x.certainly_nonzero().then(|| vec![one, y / x])
        } else {
            y.certainly_nonzero().then(|| vec![x / y, one])
        }
    };
    values
        .map(|value| Located {
            value,
            vector: if simple { vector(value.re) } else { None },
        })
        .into()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A norm bounds the moduli, and may be one: what is returned as a strict bound must be larger, or an
    /// eigenvalue that equals a threshold would be ruled out.
    #[test]
    fn a_bound_by_the_norm_is_not_reached() {
        // rows sum to 1/4, the eigenvalue of the constant vector, and the sums are exact in doubles
        let matrix = Matrix::from_fn(3, 3, |i, j| {
            Interval::point([[0.125, 0.125, 0.0], [0.0, 0.125, 0.125], [0.125, 0.0, 0.125]][i][j])
        });
        let (located, rest) = enclose(&matrix, &Peel::default());
        assert!(located.is_empty());
        assert!(matches!(rest, Some((3, radius)) if radius > 0.25), "{rest:?}");
        // a false claim of a radius is not believed
        let mut factor = vec![0.0; 6];
        for at in [0, 3, 5] {
            factor[at] = 1.0;
        }
        for radius in [0.25, 0.2, f64::NAN, -1.0, f64::INFINITY] {
            let peel = Peel {
                pairs: Vec::new(),
                rest: Some(Rest {
                    radius,
                    factor: factor.clone(),
                }),
            };
            assert_eq!(enclose(&matrix, &peel).1, rest);
        }
    }

    /// An enclosed vector holds the exact one, in the scaling that its documentation claims and no other.
    #[test]
    fn lifted_vectors_are_eigenvectors_of_another_scale() {
        // eigenvalues 1, 2, 4 with the vectors (1, 0, 0), (3, 1, 0), (7, 6, 2)/2 up to scale
        let matrix = Matrix::from_fn(3, 3, |i, j| {
            Interval::point([[1.0, 3.0, 1.5], [0.0, 2.0, 6.0], [0.0, 0.0, 4.0]][i][j])
        });
        let peel = Peel {
            pairs: vec![(1.0, vec![1.0, 0.0, 0.0])],
            rest: None,
        };
        let (located, rest) = enclose(&matrix, &peel);
        assert!(rest.is_none());
        let values: Vec<f64> = located.iter().map(|entry| entry.value.re.mid()).collect();
        assert_eq!(values, [1.0, 4.0, 2.0]);
        for entry in &located {
            let vector = entry.vector.as_ref().expect("simple");
            for i in 0..3 {
                let image: Interval = (0..3).map(|j| matrix[(i, j)] * vector[j]).sum();
                assert!(!image.disjoint(entry.value.re * vector[i]));
            }
            assert!(vector.iter().any(|x| x.certainly_nonzero()));
        }
        // (3, 1, 0) is 1 where it was found, and not largest there
        let second = located[2].vector.as_ref().expect("simple");
        assert!(second[0].contains(3.0) && second[1].contains(1.0) && second[2].contains(0.0));
    }
}
