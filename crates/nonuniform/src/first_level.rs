//! The corners `P_i^(0,0)` of the n-gon of HNUSS from the points around its vertex (Li, Wei and Zhang 2019,
//! sections 3 and 4.2).
//!
//! **Simple**: knots are doubled as if the vertex were regular, seen from each sector alone,
//!
//! ```text
//! P_i = p_i q_i F_i + (1-p_i) q_i E_i + p_i (1-q_i) E_(i+1) + (1-p_i)(1-q_i) V
//! p_i = d_(i-1)/(d_(i-1) + d_(i+1) + a_(i+1)),   q_i = d_(i+2)/(d_(i+2) + d_i + a_i)
//! ```
//!
//! **Improved** and **printed** take limit and tangent plane from the
//! [eigen-polyhedron](crate::eigen_polyhedron). With M of the first level, N of the others, M^0 and N^ their
//! rows and columns of E and F, minus the row of V, the projector Q on the eigenspace lambda of N^, and L0
//! the limit weights of N,
//!
//! ```text
//! C = L0 M P,     P_i = C + V-_i - sum_j v_j V-_j,      v the limit weights of Q_n
//! printed    V-_i = [diag(c) M^0 Q P^]_(n+i),  c_i = 2 d-_i/(2 d-_i + d_i),  c_(n+i) = (c_i + c_(i+1))/2
//! improved   V-_i = gamma (c_i e_i + c_(i+1) e_(i+1)),   c_i = 2 d_i/(2 d_i + d-_i),
//!            e the first n entries of Q M^0 P^
//! ```
//!
//! The step M comes first, so that the surface's tangents are those of Q M and not of M Q, and `(2 d_i +
//! d-_i)/6` must become `d_i/3`: what is printed has both the other way round (`docs/deviations.md`).

use crate::eigen_polyhedron::{EigenPolyhedron, left_eigenvectors};
use crate::ngon::NGon;
use crate::nurss::{Order, Row, bilinear};
use crate::{Error, Spokes, nurss};
use eigenring_spectral::Matrix;
use nalgebra::DMatrix;

/// How the corners of the n-gon are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FirstLevel {
    /// Knots are doubled in each sector alone.
    Simple,
    /// As printed in section 4.2: the limit of the eigen-polyhedron surface, and another plane.
    Printed,
    /// Limit and tangent plane of the eigen-polyhedron surface.
    #[default]
    Improved,
}

impl FirstLevel {
    /// Whether it asks for an eigen-polyhedron.
    pub fn needs_polyhedron(self) -> bool {
        self != FirstLevel::Simple
    }
}

/// The weights p_i and q_i of the simple rule.
///
/// # Errors
/// [`Error::ZeroSum`].
pub fn doubling(spokes: &Spokes, i: isize) -> Result<[f64; 2], Error> {
    let weight = |behind: isize, own: isize| {
        let (b, h, a) = (spokes.d(behind), spokes.d(own), spokes.a(own));
        if b + h + a == 0.0 {
            return Err(Error::ZeroSum {
                what: format!(
                    "spokes {} and {} and the edge beyond the latter",
                    spokes.index(behind),
                    spokes.index(own)
                ),
                rule: "doubling a knot",
            });
        }
        Ok(b / (b + h + a))
    };
    Ok([weight(i - 1, i + 1)?, weight(i + 2, i)?])
}

/// The n rows of the corners over V, E_0.., F_0.. .
///
/// # Errors
/// [`Error::ZeroSum`]; for printed and improved also those of [`EigenPolyhedron::new`] and [`NGon::new`].
pub fn rows(spokes: &Spokes, rule: FirstLevel) -> Result<Matrix<f64>, Error> {
    let n = spokes.valence();
    let order = Order { n };
    if rule == FirstLevel::Simple {
        let row = |i: isize| -> Result<Row<f64>, Error> {
            let [p, q] = doubling(spokes, i)?;
            Ok(bilinear(order, i, &q, &p))
        };
        let rows = (0..n as isize).map(row).collect::<Result<Vec<_>, _>>()?;
        return Ok(Matrix::from_rows(rows, order.size()));
    }
    let d = spokes.intervals();
    let polyhedron = EigenPolyhedron::new(d)?;
    let limit = polyhedron.limit_of_first_step(spokes)?;
    let first = relative(&nurss::matrix(spokes)?);
    let projector = projector(&polyhedron)?;
    let vectors = match rule {
        FirstLevel::Printed => {
            let c = |i: usize| 2.0 * polyhedron.d_minus[i % n] / (2.0 * polyhedron.d_minus[i % n] + d[i % n]);
            let all = &first * &projector;
            DMatrix::from_fn(n, 2 * n, |i, j| (c(i) + c(i + 1)) / 2.0 * all[(n + i, j)])
        }
        _ => {
            let c = |i: usize| 2.0 * d[i % n] / (2.0 * d[i % n] + polyhedron.d_minus[i % n]);
            let e = &projector * &first;
            DMatrix::from_fn(n, 2 * n, |i, j| {
                polyhedron.gamma * (c(i) * e[(i, j)] + c(i + 1) * e[((i + 1) % n, j)])
            })
        }
    };
    let v = NGon::new(d)?.limit_weights();
    let mean = nalgebra::RowDVector::from_row_slice(&v) * &vectors;
    Ok(Matrix::from_rows(
        (0..n)
            .map(|i| {
                let relative: Vec<f64> = (0..2 * n).map(|j| vectors[(i, j)] - mean[j]).collect();
                let mut row = limit.clone();
                row[0] -= relative.iter().sum::<f64>();
                row[1..]
                    .iter_mut()
                    .zip(relative)
                    .for_each(|(entry, weight)| *entry += weight);
                row
            })
            .collect(),
        order.size(),
    ))
}

/// Rows and columns of E and F, minus the row of V.
fn relative(matrix: &Matrix<f64>) -> DMatrix<f64> {
    let size = matrix.rows() - 1;
    DMatrix::from_fn(size, size, |i, j| matrix[(i + 1, j + 1)] - matrix[(0, j + 1)])
}

/// The projector `R (L R)^-1 L` on the eigenspace lambda of N^: R is the polyhedron, L the left null space.
fn projector(polyhedron: &EigenPolyhedron) -> Result<DMatrix<f64>, Error> {
    let reduced = relative(&polyhedron.matrix()?);
    let size = reduced.nrows();
    let plain = Matrix::from_fn(size, size, |i, j| reduced[(i, j)]);
    let left = left_eigenvectors(&plain, polyhedron.lambda)?;
    let left = DMatrix::from_fn(left.len(), size, |i, j| left[i][j]);
    let points = polyhedron.points();
    let right = DMatrix::from_fn(size, 2, |i, j| points[i + 1][j]);
    let product = &left * &right;
    let inverse = Some(product).filter(|m| m.is_square()).and_then(|m| m.try_inverse());
    match inverse {
        Some(inverse) => Ok(right * inverse * left),
        // within the domain lambda has been double wherever it was looked at
        None => Err(polyhedron.refusal("lambda is no double eigenvalue".to_owned())),
    }
}
