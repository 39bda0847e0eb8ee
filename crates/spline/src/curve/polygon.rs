//! Curves.

use super::{Axis, Ends};
use crate::Error;

/// A control polygon with its order and tension, or one that was refined from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    axis: Axis,
    dimension: usize,
    values: Vec<f64>,
}

impl Curve {
    /// The curve of order `order` with initial tension `u0` and the given control points, all of one
    /// dimension.
    ///
    /// # Errors
    /// Those of [`Axis::new`]; [`Error::Dimension`] if points differ in dimension or have none;
    /// [`Error::NotFinite`].
    pub fn new<P: AsRef<[f64]>>(order: usize, u0: f64, ends: Ends, points: &[P]) -> Result<Self, Error> {
        let axis = Axis::new(order, u0, ends, points.len())?;
        let (dimension, values) = flatten(points)?;
        Curve::from_parts(axis, dimension, values)
    }

    pub(super) fn from_parts(axis: Axis, dimension: usize, values: Vec<f64>) -> Result<Self, Error> {
        finite(dimension, &values)?;
        Ok(Curve {
            axis,
            dimension,
            values,
        })
    }

    /// Order, tension, ends, level, domain.
    pub fn axis(&self) -> &Axis {
        &self.axis
    }

    /// The number of coordinates of a point.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The points of this level; point i belongs to the parameter `axis().parameter(i)`.
    pub fn points(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.values.chunks_exact(self.dimension)
    }

    /// The points after one more level. An open polygon of n points has `2n - k + 1` then, a closed one 2n.
    ///
    /// # Errors
    /// [`Error::NotFinite`] if coordinates overflow, [`Error::ControlPoints`] if there would be too many
    /// points.
    pub fn refine(&self) -> Result<Self, Error> {
        let (axis, values) = self.axis.refine(self.dimension, self.values.clone())?;
        Curve::from_parts(axis, self.dimension, values)
    }

    /// The points after several levels.
    ///
    /// # Errors
    /// Those of [`Curve::refine`].
    pub fn refine_levels(&self, levels: u32) -> Result<Self, Error> {
        (0..levels).try_fold(self.clone(), |curve, _| curve.refine())
    }

    /// The limit point at parameter t; see [`Axis::domain`].
    ///
    /// # Errors
    /// [`Error::OutsideSpline`] if t is outside of the domain, [`Error::NotFinite`] if coordinates overflow.
    pub fn limit(&self, t: f64) -> Result<Vec<f64>, Error> {
        self.combine(&self.axis.weights(t)?)
    }

    /// Limit points at `per_interval` equally spaced parameters between any two knots, and at the end of the
    /// domain; each with its parameter. The last point of a closed curve is its first.
    ///
    /// # Errors
    /// [`Error::NotFinite`] if coordinates overflow, [`Error::ControlPoints`] if there would be too many.
    pub fn sample(&self, per_interval: usize) -> Result<Vec<(f64, Vec<f64>)>, Error> {
        let samples = self.axis.samples(per_interval)?.into_iter();
        samples.map(|(t, weights)| Ok((t, self.combine(&weights)?))).collect()
    }

    fn combine(&self, weights: &[(usize, f64)]) -> Result<Vec<f64>, Error> {
        let mut point = vec![0.0; self.dimension];
        for &(i, weight) in weights {
            for (sum, value) in point.iter_mut().zip(&self.values[i * self.dimension..]) {
                *sum += weight * value;
            }
        }
        finite(self.dimension, &point)?;
        Ok(point)
    }
}

/// The points' coordinates one after the other, and how many a point has.
pub(super) fn flatten<P: AsRef<[f64]>>(points: &[P]) -> Result<(usize, Vec<f64>), Error> {
    let dimension = points.first().map_or(0, |point| point.as_ref().len());
    for (index, point) in points.iter().enumerate() {
        let found = point.as_ref().len();
        if found != dimension || found == 0 {
            return Err(Error::Dimension {
                index,
                found,
                expected: dimension.max(1),
            });
        }
    }
    Ok((
        dimension,
        points.iter().flat_map(|point| point.as_ref()).copied().collect(),
    ))
}

/// Refuses the first point that is not finite.
pub(super) fn finite(dimension: usize, values: &[f64]) -> Result<(), Error> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(position) => Err(Error::NotFinite {
            index: position / dimension,
            value: values[position],
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_becomes_the_unit_circle() {
        // circumradius sqrt 2, tension cos(pi/4)
        let square = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
        let curve = Curve::new(3, std::f64::consts::FRAC_1_SQRT_2, Ends::Closed, &square).unwrap();
        for (t, point) in curve.sample(16).unwrap() {
            assert!((point[0].hypot(point[1]) - 1.0).abs() < 1e-15, "{t}");
        }
        for point in curve.refine_levels(12).unwrap().points() {
            assert!((point[0].hypot(point[1]) - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn bad_input_is_refused() {
        let line = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
        let curve = |order, u0, ends| Curve::new(order, u0, ends, &line);
        assert!(curve(3, 0.5, Ends::Open).is_ok());
        assert!(matches!(curve(1, 1.0, Ends::Open), Err(Error::Order { order: 1, .. })));
        assert!(matches!(curve(2, 0.5, Ends::Open), Err(Error::Polynomial { .. })));
        assert!(matches!(curve(3, 0.5, Ends::Clamped), Err(Error::Polynomial { .. })));
        assert!(matches!(
            curve(99, 0.5, Ends::Open),
            Err(Error::Order { order: 99, .. })
        ));
        assert!(matches!(curve(3, -1.0, Ends::Open), Err(Error::Tension { .. })));
        assert!(matches!(
            curve(4, 0.5, Ends::Open),
            Err(Error::ControlPoints {
                count: 3,
                minimum: 4,
                ..
            })
        ));
        let short = Curve::new(3, 0.5, Ends::Closed, &line[..2]);
        assert!(matches!(
            short,
            Err(Error::ControlPoints {
                count: 2,
                minimum: 3,
                ..
            })
        ));
        let infinite = Curve::new(3, 0.5, Ends::Open, &[[0.0], [f64::NAN], [1.0]]);
        assert!(matches!(infinite, Err(Error::NotFinite { index: 1, .. })));
        let ragged = Curve::new(3, 0.5, Ends::Open, &[vec![0.0], vec![1.0, 2.0], vec![1.0]]);
        assert_eq!(
            ragged,
            Err(Error::Dimension {
                index: 1,
                found: 2,
                expected: 1
            })
        );
        assert!(matches!(
            Curve::new::<[f64; 0]>(3, 0.5, Ends::Open, &[[]; 4]),
            Err(Error::Dimension { .. })
        ));
        // what overflows is refused and not returned
        let huge = Curve::new(3, -0.999_999, Ends::Closed, &[[1e308], [-1e308], [1e308], [-1e308]]).unwrap();
        assert!(matches!(huge.refine(), Err(Error::NotFinite { .. })));
        assert!(matches!(huge.limit(0.3), Err(Error::NotFinite { .. })));
    }
}
