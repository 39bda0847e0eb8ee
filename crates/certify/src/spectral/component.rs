//! The eigenvalues of one component.

use crate::Interval;
use crate::linear::{Eigenpair, Eigenvalue, eigenpair, lift, norm, pair, quotient, radius_below};
use eigenring_spectral::Matrix;
use serde::{Deserialize, Serialize};

/// How a component comes apart: approximations of simple real eigenpairs to divide out, each a pair of the matrix that the
/// ones before have left, and a bound for what remains. Anything may be wrong here; it is not believed.
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

/// An enclosed eigenvalue, with its vector if it is simple and real.
#[derive(Clone, Debug)]
pub struct Located {
    /// The value.
    pub value: Eigenvalue,
    /// The vector; some entry is exactly 1.
    pub vector: Option<Vec<Interval>>,
}

/// All eigenvalues of an interval matrix: enclosed ones, and possibly a number of further ones below a radius.
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
            let radius = proven.map_or(norm(&current), |proven| proven.radius);
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

/// Both eigenvalues of a 2 x 2 matrix with their vectors, each scaled to 1 at its larger entry.
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
