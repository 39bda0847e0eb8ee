//! Surfaces of revolution: Fang, Ma and Wang, Algorithm 2.

use super::{Curve, Ends, Function, Grid, MAX_ORDER, MIN_ORDER};
use crate::Error;

impl Grid {
    /// The surface that a spatial curve sweeps around the third axis. The first direction is that of the
    /// curve; around the axis there are `segments` control points, with the tension `cos(pi / segments)` of
    /// an exact circle. Points at radius 1 go out to `1 / (cos(a) (sin(a)/a)^(order-3))`,
    /// `a = pi / segments`: for order 3 and 4 segments, which is the published algorithm, `sqrt 2`.
    ///
    /// # Errors
    /// [`Error::Revolution`] unless the curve has three coordinates; [`Error::Order`];
    /// [`Error::ControlPoints`] for fewer than 3 segments; [`Error::NotFinite`] if coordinates overflow.
    pub fn revolution(generatrix: &Curve, order: usize, segments: usize) -> Result<Grid, Error> {
        if generatrix.dimension() != 3 {
            return Err(Error::Revolution {
                dimension: generatrix.dimension(),
            });
        }
        if !(MIN_ORDER..=MAX_ORDER).contains(&order) {
            return Err(Error::Order {
                order,
                minimum: MIN_ORDER,
                maximum: MAX_ORDER,
            });
        }
        let u0 = (std::f64::consts::PI / segments.max(1) as f64).cos();
        let cosine = Function {
            cosine: 1.0,
            ..Function::default()
        };
        let sine = Function {
            sine: 1.0,
            ..Function::default()
        };
        // too few segments are refused as too few points, before their tension is looked at
        let circle = Curve::reproduce(order, u0.max(0.0), Ends::Closed, segments, &[cosine, sine])?;
        let mut points = Vec::with_capacity(generatrix.axis().count() * segments);
        for p in generatrix.points() {
            for turn in circle.points() {
                let (c, s) = (turn[0], turn[1]);
                points.push([c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]]);
            }
        }
        Grid::new(generatrix.axis().clone(), circle.axis().clone(), &points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_control_mesh() {
        let line = [[1.0, 0.0, 0.0], [2.0, 0.0, 1.0], [3.0, 0.5, 2.0]];
        let generatrix = Curve::new(3, 1.0, Ends::Open, &line).unwrap();
        let grid = Grid::revolution(&generatrix, 3, 4).unwrap();
        assert!((grid.v().tension().value() - std::f64::consts::FRAC_1_SQRT_2).abs() < 1e-15);
        for (i, p) in line.iter().enumerate() {
            for j in 0..4 {
                let angle = std::f64::consts::FRAC_PI_2 * (j as f64 + 0.5);
                let (c, s) = (2.0_f64.sqrt() * angle.cos(), 2.0_f64.sqrt() * angle.sin());
                let point = grid.points().nth(4 * i + j).unwrap();
                let expected = [c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]];
                assert!(
                    point.iter().zip(expected).all(|(a, b)| (a - b).abs() < 2e-15),
                    "{i} {j}: {point:?}"
                );
            }
        }
    }

    #[test]
    fn bad_input_is_refused() {
        let flat = Curve::new(3, 1.0, Ends::Open, &[[1.0, 0.0]; 3]).unwrap();
        assert_eq!(Grid::revolution(&flat, 3, 4), Err(Error::Revolution { dimension: 2 }));
        let spatial = Curve::new(3, 1.0, Ends::Open, &[[1.0, 0.0, 0.0]; 3]).unwrap();
        for segments in 0..3 {
            let refused = Grid::revolution(&spatial, 3, segments);
            assert!(
                matches!(refused, Err(Error::ControlPoints { minimum: 3, .. })),
                "{segments}"
            );
        }
        assert!(matches!(Grid::revolution(&spatial, 2, 4), Err(Error::Order { .. })));
    }
}
