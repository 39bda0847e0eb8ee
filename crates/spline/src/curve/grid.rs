//! Tensor-product surfaces.

use super::Axis;
use super::polygon::{finite, flatten};
use crate::Error;

/// A grid of control points with an order and a tension in each direction, or one that was refined from it:
/// Fang, Ma and Wang, Algorithm 1.
///
/// Point `(i, j)` stands at `i * v().count() + j`; i runs along the first direction, u, and j along the
/// second, v.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    u: Axis,
    v: Axis,
    dimension: usize,
    values: Vec<f64>,
}

impl Grid {
    /// The surface of `u.count() * v.count()` control points.
    ///
    /// # Errors
    /// [`Error::GridPoints`] for another number of points; [`Error::Dimension`] if points differ in dimension
    /// or have none; [`Error::NotFinite`].
    pub fn new<P: AsRef<[f64]>>(u: Axis, v: Axis, points: &[P]) -> Result<Self, Error> {
        let (rows, columns) = (u.count(), v.count());
        if rows.checked_mul(columns) != Some(points.len()) {
            return Err(Error::GridPoints {
                count: points.len(),
                rows,
                columns,
            });
        }
        let (dimension, values) = flatten(points)?;
        Grid::from_parts(u, v, dimension, values)
    }

    fn from_parts(u: Axis, v: Axis, dimension: usize, values: Vec<f64>) -> Result<Self, Error> {
        finite(dimension, &values)?;
        Ok(Grid {
            u,
            v,
            dimension,
            values,
        })
    }

    /// The first direction.
    pub fn u(&self) -> &Axis {
        &self.u
    }

    /// The second direction.
    pub fn v(&self) -> &Axis {
        &self.v
    }

    /// The number of coordinates of a point.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The points of this level, `(0, 0), (0, 1), ..`.
    pub fn points(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.values.chunks_exact(self.dimension)
    }

    /// The points after one more level in both directions.
    ///
    /// # Errors
    /// [`Error::NotFinite`] if coordinates overflow, [`Error::ControlPoints`] if there would be too many
    /// points.
    pub fn refine(&self) -> Result<Self, Error> {
        // a grid is a polygon of rows, and its transpose one of columns
        let (u, values) = self.u.refine(self.v.count() * self.dimension, self.values.clone())?;
        let columns = transposed(&values, u.count(), self.v.count(), self.dimension);
        let (v, columns) = self.v.refine(u.count() * self.dimension, columns)?;
        let values = transposed(&columns, v.count(), u.count(), self.dimension);
        Grid::from_parts(u, v, self.dimension, values)
    }

    /// The points after several levels.
    ///
    /// # Errors
    /// Those of [`Grid::refine`].
    pub fn refine_levels(&self, levels: u32) -> Result<Self, Error> {
        (0..levels).try_fold(self.clone(), |grid, _| grid.refine())
    }

    /// The limit point at parameters `(s, t)` of the first and second direction.
    ///
    /// # Errors
    /// [`Error::OutsideSpline`] if a parameter is outside of its domain, [`Error::NotFinite`] if coordinates
    /// overflow.
    pub fn limit(&self, s: f64, t: f64) -> Result<Vec<f64>, Error> {
        self.combine(&self.u.weights(s)?, &self.v.weights(t)?)
    }

    /// Limit points at `per_interval` parameters between knots of either direction, and at the ends of the
    /// domains: for each parameter of the first direction a row of points along the second.
    ///
    /// # Errors
    /// [`Error::NotFinite`] if coordinates overflow, [`Error::ControlPoints`] if there would be too many.
    pub fn sample(&self, per_interval: usize) -> Result<Vec<Vec<Vec<f64>>>, Error> {
        let (rows, columns) = (self.u.samples(per_interval)?, self.v.samples(per_interval)?);
        let row = |weights: &[(usize, f64)]| columns.iter().map(|(_, v)| self.combine(weights, v)).collect();
        rows.iter().map(|(_, weights)| row(weights)).collect()
    }

    fn combine(&self, u: &[(usize, f64)], v: &[(usize, f64)]) -> Result<Vec<f64>, Error> {
        let mut point = vec![0.0; self.dimension];
        for &(i, a) in u {
            for &(j, b) in v {
                let start = (i * self.v.count() + j) * self.dimension;
                for (sum, value) in point.iter_mut().zip(&self.values[start..]) {
                    *sum += a * b * value;
                }
            }
        }
        finite(self.dimension, &point)?;
        Ok(point)
    }
}

/// Rows of points become columns.
fn transposed(values: &[f64], rows: usize, columns: usize, dimension: usize) -> Vec<f64> {
    let mut result = Vec::with_capacity(values.len());
    for j in 0..columns {
        for i in 0..rows {
            let start = (i * columns + j) * dimension;
            result.extend_from_slice(&values[start..start + dimension]);
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{Curve, Ends};

    #[test]
    fn a_product_of_curves_stays_one() {
        // points (x_i, y_i z_j): both factors are curves of their own
        let u = Curve::new(
            4,
            0.3,
            Ends::Open,
            &[[1.0, 2.0], [2.0, -1.0], [4.0, 0.5], [5.0, 3.0], [7.0, 1.0]],
        )
        .unwrap();
        let v = Curve::new(5, 2.0, Ends::Closed, &[[1.0], [3.0], [-2.0], [0.5]]).unwrap();
        let product = |u: &[f64], v: &[f64]| vec![u[0], u[1] * v[0]];
        let of = |u: &Curve, v: &Curve| -> Vec<Vec<f64>> {
            u.points()
                .flat_map(|p| v.points().map(move |q| product(p, q)))
                .collect()
        };
        let grid = Grid::new(u.axis().clone(), v.axis().clone(), &of(&u, &v)).unwrap();
        let (fine_u, fine_v, fine) = (u.refine().unwrap(), v.refine().unwrap(), grid.refine().unwrap());
        assert_eq!((fine.u(), fine.v()), (fine_u.axis(), fine_v.axis()));
        for (p, q) in fine.points().zip(of(&fine_u, &fine_v)) {
            assert!((p[0] - q[0]).abs() < 1e-14 && (p[1] - q[1]).abs() < 1e-14);
        }
        let expected = product(&u.limit(2.3).unwrap(), &v.limit(0.9).unwrap());
        for grid in [grid.clone(), fine] {
            let point = grid.limit(2.3, 0.9).unwrap();
            assert!((point[0] - expected[0]).abs() < 1e-14 && (point[1] - expected[1]).abs() < 1e-14);
        }
        assert_eq!(grid.sample(3).unwrap().len(), 3 * 2 + 1);
        assert_eq!(grid.sample(3).unwrap()[0].len(), 3 * 4 + 1);
    }

    #[test]
    fn the_number_of_points_is_checked() {
        let axis = |count| Axis::new(3, 1.0, Ends::Open, count).unwrap();
        let points = [[0.0]; 11];
        let refused = Grid::new(axis(3), axis(4), &points);
        assert_eq!(
            refused,
            Err(Error::GridPoints {
                count: 11,
                rows: 3,
                columns: 4
            })
        );
    }
}
