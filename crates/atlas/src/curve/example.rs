//! Curves that their control points give exactly, as input for everybody who has no file of points.
//!
//! With `w = 2 arccos u0` (`2 arcosh u0`) a curve of order k contains `1, t, .., t^(k-3)` and cosine and sine
//! (hyperbolic ones) of `w t`, and its control points follow in closed form (Fang, Ma and Wang, *A
//! generalized surface subdivision scheme of arbitrary order with a tension parameter*; `Curve::reproduce`).
//! With x as the parameter from the middle of the domain, T as that of the published figure:
//!
//! ```text
//! circle     (cos wt, sin wt)            closed, n points and u0 = cos(pi/n)
//! ellipse    (2 cos wt, sin wt)          closed, n points and u0 = cos(pi/n)
//! line       (x, x/2)                    any u0, k >= 4; u0 = 1 also at k = 3
//! parabola   (x, x^2)                    any u0, k >= 5; u0 = 1 also at k = 3, 4
//! hyperbola  (cosh wx, sinh wx)          u0 > 1
//! helix      (cos wx, sin wx, wx/4)      |u0| < 1, k >= 4
//! fang-fig1  (T + cos 2T + sin 2T, T + cos 2T, T^2 + 2T + 2 sin 2T),  T from 3 pi/2    |u0| < 1, k >= 5
//! ```
//!
//! The last one is the curve to which the control points printed with Fig. 1 of the paper belong (order 5,
//! `u0 = cos(pi/4)`, 8 points, T up to 5 pi/2); see docs/deviations.md.

use crate::error::Error;
use eigenring_spline::curve::{Axis, Curve, Ends, Function, Space};
use std::f64::consts::{FRAC_PI_4, PI};

/// A built-in curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Example {
    /// The unit circle.
    Circle,
    /// With half axes 2 and 1.
    Ellipse,
    /// Straight, at even speed.
    Line,
    /// y = x^2.
    Parabola,
    /// One branch of x^2 - y^2 = 1.
    Hyperbola,
    /// Around the third axis.
    Helix,
    /// A space curve: polynomial and trigonometric.
    FangFig1,
}

/// A curve by its functions.
#[derive(Clone, Debug)]
pub struct Exact {
    space: Space,
    functions: Vec<Function>,
}

impl Exact {
    /// The functions of its coordinates.
    pub fn functions(&self) -> &[Function] {
        &self.functions
    }

    /// The point at a parameter.
    pub fn at(&self, t: f64) -> Vec<f64> {
        self.functions.iter().map(|f| self.space.value(f, t)).collect()
    }
}

/// The most control points of an example, and the most around the axis of a surface of revolution. A circle
/// of n points must close to 1e-12 of its radius, and its angle as an arc cosine has an error that n
/// roundings times n grow to.
pub const MOST: usize = 64;

/// Control points of closed examples by default.
const AROUND: usize = 6;
/// Intervals of open examples by default, and of the helix: two turns of eight.
const INTERVALS: usize = 5;
const HELIX_INTERVALS: usize = 16;
/// The default tension of the hyperbola, cosh(1/4): w = 1/2.
const QUARTER: f64 = 0.25;

impl Example {
    /// All of them.
    pub const ALL: [Example; 7] = [
        Example::Circle,
        Example::Ellipse,
        Example::Line,
        Example::Parabola,
        Example::Hyperbola,
        Example::Helix,
        Example::FangFig1,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Example::Circle => "circle",
            Example::Ellipse => "ellipse",
            Example::Line => "line",
            Example::Parabola => "parabola",
            Example::Hyperbola => "hyperbola",
            Example::Helix => "helix",
            Example::FangFig1 => "fang-fig1",
        }
    }

    /// What it is, in a few words.
    pub fn summary(self) -> &'static str {
        match self {
            Example::Circle => "The unit circle",
            Example::Ellipse => "With half axes 2 and 1",
            Example::Line => "Straight, at even speed",
            Example::Parabola => "y = x^2",
            Example::Hyperbola => "One branch of x^2 - y^2 = 1",
            Example::Helix => "Around the third axis",
            Example::FangFig1 => "A space curve: polynomial and trigonometric",
        }
    }

    fn is_closed(self) -> bool {
        matches!(self, Example::Circle | Example::Ellipse)
    }

    /// The order of the curve unless another one is asked for.
    pub fn order(self) -> usize {
        match self {
            Example::Parabola | Example::FangFig1 => 5,
            _ => 4,
        }
    }

    /// The curve with its control points; what is not given is the example's own.
    ///
    /// # Errors
    /// [`Error::Range`] for a number of points or a tension that the example does not have; those of the
    /// curve.
    pub fn curve(self, order: Option<usize>, u0: Option<f64>, count: Option<usize>) -> Result<(Curve, Exact), Error> {
        let order = order.unwrap_or(self.order());
        // refuses orders before they are counted with
        Space::new(order, 1.0)?;
        let (ends, least, usual) = match self {
            _ if self.is_closed() => (Ends::Closed, 3, AROUND),
            Example::Helix => (Ends::Open, order, order - 1 + HELIX_INTERVALS),
            Example::FangFig1 => (Ends::Open, order, order - 1 + 4),
            _ => (Ends::Open, order, order - 1 + INTERVALS),
        };
        let count = count.unwrap_or(usual);
        if !(least..=MOST).contains(&count) {
            return Err(Error::Range {
                what: "number of control points",
                given: count.to_string(),
                accepted: format!("{least} to {MOST} for this example"),
            });
        }
        let u0 = self.tension(u0, count)?;
        let space = Space::new(order, u0)?;
        let domain = Axis::new(order, u0, ends, count)?.domain();
        let functions = self.functions(domain, space.frequency());
        let curve = Curve::reproduce(order, u0, ends, count, &functions)?;
        Ok((curve, Exact { space, functions }))
    }

    /// The initial tension: given, determined by the number of points, or the default; checked against what
    /// the functions need.
    fn tension(self, given: Option<f64>, count: usize) -> Result<f64, Error> {
        let refuse = |u0: f64, accepted: String| {
            Err(Error::Range {
                what: "tension u0 =",
                given: u0.to_string(),
                accepted,
            })
        };
        match self {
            Example::Circle | Example::Ellipse => {
                let u0 = (PI / count as f64).cos();
                match given {
                    // to the digits with which people write cosines
                    Some(other) if !((other - u0).abs() <= 1e-6) => refuse(
                        other,
                        format!("{u0} = cos(pi/{count}), which {count} control points determine"),
                    ),
                    _ => Ok(u0),
                }
            }
            Example::Line | Example::Parabola => Ok(given.unwrap_or(1.0)),
            Example::Hyperbola => match given.unwrap_or(QUARTER.cosh()) {
                u0 if u0 > 1.0 && u0.is_finite() => Ok(u0),
                u0 => refuse(u0, "u0 > 1 for hyperbolic functions".to_owned()),
            },
            Example::Helix | Example::FangFig1 => {
                let usual = if self == Example::Helix {
                    FRAC_PI_4 / 2.0
                } else {
                    FRAC_PI_4
                };
                match given.unwrap_or(usual.cos()) {
                    u0 if -1.0 < u0 && u0 < 1.0 && u0 != 0.0 => Ok(u0),
                    u0 => refuse(u0, "-1 < u0 < 1 other than 0 for trigonometric functions".to_owned()),
                }
            }
        }
    }

    fn functions(self, domain: (f64, f64), w: f64) -> Vec<Function> {
        let middle = (domain.0 + domain.1) / 2.0;
        let function = |origin: f64, polynomial: &[f64], cosine: f64, sine: f64| Function {
            origin,
            polynomial: polynomial.to_vec(),
            cosine,
            sine,
        };
        let circular = |origin: f64, a: f64| vec![function(origin, &[], a, 0.0), function(origin, &[], 0.0, 1.0)];
        match self {
            Example::Circle => circular(0.0, 1.0),
            Example::Ellipse => circular(0.0, 2.0),
            Example::Hyperbola => circular(middle, 1.0),
            Example::Line => [1.0, 0.5].map(|a| function(middle, &[0.0, a], 0.0, 0.0)).into(),
            Example::Parabola => [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
                .map(|a| function(middle, &a, 0.0, 0.0))
                .into(),
            Example::Helix => {
                let mut functions = circular(middle, 1.0);
                functions.push(function(middle, &[0.0, w / 4.0], 0.0, 0.0));
                functions
            }
            Example::FangFig1 => {
                // T = h (t - origin) is 3 pi/2 where the domain starts, and 2T = w (t - origin)
                let h = w / 2.0;
                let origin = domain.0 - 1.5 * PI / h;
                vec![
                    function(origin, &[0.0, h], 1.0, 1.0),
                    function(origin, &[0.0, h], 1.0, 0.0),
                    function(origin, &[0.0, 2.0 * h, h * h], 0.0, 2.0),
                ]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn deviation(curve: &Curve, exact: &Exact) -> f64 {
        let distance = |(t, point): (f64, Vec<f64>)| {
            let differences = point.iter().zip(exact.at(t)).map(|(a, b)| (a - b).powi(2));
            differences.sum::<f64>().sqrt()
        };
        curve.sample(7).unwrap().into_iter().map(distance).fold(0.0, f64::max)
    }

    #[test]
    fn every_example_is_exact_at_every_order() {
        for example in Example::ALL {
            for order in [None, Some(5), Some(6), Some(9), Some(22), Some(32)] {
                let (curve, exact) = example.curve(order, None, None).unwrap();
                let deviation = deviation(&curve, &exact);
                // the published space curve is a hundred units long
                assert!(deviation < 2e-12, "{example:?} {order:?}: {deviation}");
            }
        }
    }

    #[test]
    fn circles_close_with_as_many_points_as_are_accepted() {
        for order in [3, 4, 32] {
            for count in 3..=MOST {
                let (curve, exact) = Example::Circle.curve(Some(order), None, Some(count)).unwrap();
                assert!(deviation(&curve, &exact) < 1e-12, "{order} {count}");
            }
        }
    }

    #[test]
    fn the_figure_has_the_printed_control_points() {
        // Fang, Ma and Wang, Fig. 1, first and last
        let (curve, _) = Example::FangFig1.curve(None, None, None).unwrap();
        let points: Vec<&[f64]> = curve.points().collect();
        assert_eq!(points.len(), 8);
        for (point, printed) in [
            (points[0], [6.002, 4.768, 21.756]),
            (points[7], [9.032, 10.266, 96.904]),
        ] {
            assert!(
                point.iter().zip(printed).all(|(a, b)| (a - b).abs() < 6e-4),
                "{point:?}"
            );
        }
    }

    #[test]
    fn tensions_that_a_curve_does_not_have_are_refused() {
        use Example::*;
        for (example, u0) in [
            (Circle, 0.5),
            (Circle, f64::NAN),
            (Line, -1.0),
            (Hyperbola, 1.0),
            (Hyperbola, f64::INFINITY),
            (Helix, 0.0),
            (FangFig1, 1.0),
            (Helix, f64::NAN),
        ] {
            let error = example.curve(None, Some(u0), None).unwrap_err();
            assert!(error.accepted().is_some(), "{example:?} {u0}: {error}");
        }
        assert!(Circle.curve(None, Some(0.866_025_4), None).is_ok());
        assert!(Line.curve(Some(3), Some(2.0), None).is_err());
        for count in [0, 2, MOST + 1, usize::MAX] {
            assert!(Circle.curve(None, None, Some(count)).is_err());
        }
    }
}
