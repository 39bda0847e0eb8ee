//! Surfaces that their control meshes give exactly, by name.
//!
//! Each coordinate is a sum of products of a function of s (along the profile) and one of t (around, or along
//! the spine) that curves of the order and tension contain; their control points are the same sums of
//! products of those of the functions ([`Curve::reproduce`]). With w the frequency of the profile, x its
//! parameter from the middle of the domain, and a = 2 pi t / segments:
//!
//! ```text
//! sphere                  r = cos wx, z = sin wx, from pole to pole   r^2 + z^2 = 1
//! torus-exact             r = 2 + cos ws, z = sin ws, closed   (r-2)^2 + z^2 = 1
//! cone                    r = 1/2 + x/n, z = 1 - 2x/n, n intervals from the apex  r = 1 - z/2
//! cylinder                r = 1, z = x   r = 1
//! hyperboloid             r = cosh wx, z = sinh wx   r^2 - z^2 = 1
//! catenoid                r = cosh wx, z = wx   r = cosh z
//! ellipsoid-of-revolution r = 2 cos wx, z = sin wx   r^2/4 + z^2 = 1
//! lissajous               r = 3 + cos ws, z = sin(ws + pi/4), closed   (r-3)^2 + z^2 - sqrt2 (r-3) z = 1/2
//! cycloid                 r = 1 + cos wx, z = wx + sin wx, an arch   z = arccos(r-1) + sqrt(r (2-r))
//! fang-fig1                 the space curve of the paper's Fig. 1, turned
//! helicoid                (s cos b, s sin b, b/2), b = w' t, two turns   y cos 2z = x sin 2z
//! ellipsoid               (3 cos wx cos a, 2 cos wx sin a, sin wx)   x^2/9 + y^2/4 + z^2 = 1
//! ```

use crate::curve::Example;
use crate::error::Error;
use eigenring_spline::curve::{Axis, Curve, Ends, Function, Grid, Space};
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// How a surface is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A profile turned around the z axis.
    Revolution,
    /// A profile along a spine.
    Sweep,
    /// Any products.
    Tensor,
}

/// A surface with a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Named {
    /// Of radius 1.
    Sphere,
    /// With the radii 2 and 1.
    TorusExact,
    /// From its apex to radius 1.
    Cone,
    /// Of radius 1.
    Cylinder,
    /// Of one sheet.
    Hyperboloid,
    /// The minimal surface.
    Catenoid,
    /// With half axes 2, 2 and 1.
    EllipsoidOfRevolution,
    /// An inclined ellipse, turned: a Lissajous curve of equal frequencies.
    Lissajous,
    /// An arch, turned around its base.
    Cycloid,
    /// The published example.
    FangFig1,
    /// A straight line on a screw.
    Helicoid,
    /// With half axes 3, 2 and 1.
    Ellipsoid,
}

/// A grid with the exact functions of its surface.
#[derive(Clone, Debug)]
pub struct Product {
    /// The control points.
    pub grid: Grid,
    spaces: [Space; 2],
    functions: [Vec<Function>; 2],
    terms: [Vec<(usize, usize, f64)>; 3],
}

impl Product {
    /// The exact point.
    pub fn at(&self, s: f64, t: f64) -> [f64; 3] {
        let value = |k: usize, which: usize, x: f64| self.spaces[k].value(&self.functions[k][which], x);
        let coordinate = |terms: &Vec<(usize, usize, f64)>| -> f64 {
            terms.iter().map(|&(a, b, c)| c * value(0, a, s) * value(1, b, t)).sum()
        };
        [0, 1, 2].map(|k| coordinate(&self.terms[k]))
    }
}

/// One direction: its axis and functions.
struct Direction {
    order: usize,
    u0: f64,
    ends: Ends,
    count: usize,
    functions: Vec<Function>,
}

fn function(origin: f64, polynomial: &[f64], cosine: f64, sine: f64) -> Function {
    Function {
        origin,
        polynomial: polynomial.to_vec(),
        cosine,
        sine,
    }
}

/// Segments by default: the fewest with which shapes look like themselves.
const SEGMENTS: usize = 6;
/// Intervals of open profiles by default.
const INTERVALS: usize = 4;
/// The tension of hyperbolic profiles, cosh(1/4): w = 1/2.
const QUARTER: f64 = 0.25;
/// Intervals of a turn of the helicoid's spine.
const A_TURN: usize = 8;

impl Named {
    /// All of them.
    pub const ALL: [Named; 12] = [
        Named::Sphere,
        Named::TorusExact,
        Named::Cone,
        Named::Cylinder,
        Named::Hyperboloid,
        Named::Catenoid,
        Named::EllipsoidOfRevolution,
        Named::Lissajous,
        Named::Cycloid,
        Named::FangFig1,
        Named::Helicoid,
        Named::Ellipsoid,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Named::Sphere => "sphere",
            Named::TorusExact => "torus-exact",
            Named::Cone => "cone",
            Named::Cylinder => "cylinder",
            Named::Hyperboloid => "hyperboloid",
            Named::Catenoid => "catenoid",
            Named::EllipsoidOfRevolution => "ellipsoid-of-revolution",
            Named::Lissajous => "lissajous",
            Named::Cycloid => "cycloid",
            Named::FangFig1 => "fang-fig1",
            Named::Helicoid => "helicoid",
            Named::Ellipsoid => "ellipsoid",
        }
    }

    /// How it is made.
    pub fn kind(self) -> Kind {
        match self {
            Named::Helicoid => Kind::Sweep,
            Named::Ellipsoid => Kind::Tensor,
            _ => Kind::Revolution,
        }
    }

    /// The least order of the profile, in which its functions are.
    fn least_order(self) -> usize {
        match self {
            Named::Catenoid | Named::Cycloid => 4,
            Named::FangFig1 => 5,
            _ => 3,
        }
    }

    /// What is 0 on the surface; `None` for the curve that has no equation here.
    pub fn equation(self, [x, y, z]: [f64; 3]) -> Option<f64> {
        let r = x.hypot(y);
        Some(match self {
            Named::Sphere => r * r + z * z - 1.0,
            Named::TorusExact => (r - 2.0) * (r - 2.0) + z * z - 1.0,
            Named::Cone => r - (1.0 - z / 2.0),
            Named::Cylinder => r - 1.0,
            Named::Hyperboloid => r * r - z * z - 1.0,
            Named::Catenoid => r - z.cosh(),
            Named::EllipsoidOfRevolution => r * r / 4.0 + z * z - 1.0,
            Named::Lissajous => (r - 3.0) * (r - 3.0) + z * z - 2.0 * FRAC_1_SQRT_2 * (r - 3.0) * z - 0.5,
            // of the radius near the top of the arch, of the height near its ends: the others lose digits
            // there
            Named::Cycloid if r < 1.0 => {
                let length = PI - 2.0 * (r / 2.0).sqrt().asin() + (r * (2.0 - r)).sqrt();
                z.abs() - length
            }
            Named::Cycloid => {
                let mut angle = z.abs() / 2.0;
                for _ in 0..60 {
                    angle -= (angle + angle.sin() - z.abs()) / (1.0 + angle.cos()).max(1e-3);
                }
                r - 1.0 - angle.cos()
            }
            Named::FangFig1 => return None,
            Named::Helicoid => y * (2.0 * z).cos() - x * (2.0 * z).sin(),
            Named::Ellipsoid => x * x / 9.0 + y * y / 4.0 + z * z - 1.0,
        })
    }

    /// The grid: orders along the profile and around it (or along the spine), segments around, intervals
    /// along an open profile or control points of a closed one; what is not given is the surface's own.
    ///
    /// # Errors
    /// [`Error::Range`] for an order without the functions of the surface; those of curves and grids.
    pub fn grid(
        self,
        orders: [Option<usize>; 2],
        segments: Option<usize>,
        intervals: Option<usize>,
    ) -> Result<Product, Error> {
        let order = orders[0].unwrap_or(self.least_order().max(4));
        let around = orders[1].unwrap_or(if self == Named::Helicoid { 4 } else { 3 });
        for (what, order, least) in [
            ("order", order, self.least_order()),
            ("order around", around, if self == Named::Helicoid { 4 } else { 3 }),
        ] {
            if order < least {
                return Err(Error::Range {
                    what,
                    given: order.to_string(),
                    accepted: format!("{least} to 32 for {}", self.name()),
                });
            }
        }
        let profile = self.profile(order, intervals)?;
        let (second, terms) = if self == Named::Helicoid {
            let turns = 2 * segments.unwrap_or(A_TURN);
            let u0 = (PI / segments.unwrap_or(A_TURN).max(1) as f64).cos();
            let spine = open(around, u0, turns, |middle, w| {
                let mut functions = circular(middle);
                functions.push(function(middle, &[0.0, w / 2.0], 0.0, 0.0));
                functions
            })?;
            (spine, [vec![(0, 0, 1.0)], vec![(0, 1, 1.0)], vec![(1, 2, 1.0)]])
        } else {
            let count = segments.unwrap_or(SEGMENTS);
            let mut functions = circular(0.0);
            functions.push(function(0.0, &[1.0], 0.0, 0.0));
            let circle = Direction {
                order: around,
                // too few segments are refused as too few points, before their tension is looked at
                u0: (PI / count.max(1) as f64).cos().max(0.0),
                ends: Ends::Closed,
                count,
                functions,
            };
            let terms = match self {
                Named::FangFig1 => [
                    vec![(0, 0, 1.0), (1, 1, -1.0)],
                    vec![(0, 1, 1.0), (1, 0, 1.0)],
                    vec![(2, 2, 1.0)],
                ],
                Named::Ellipsoid => [vec![(0, 0, 3.0)], vec![(0, 1, 2.0)], vec![(1, 2, 1.0)]],
                _ => [vec![(0, 0, 1.0)], vec![(0, 1, 1.0)], vec![(1, 2, 1.0)]],
            };
            (circle, terms)
        };
        product(profile, second, terms)
    }

    fn profile(self, order: usize, intervals: Option<usize>) -> Result<Direction, Error> {
        let count = intervals.unwrap_or(match self {
            Named::TorusExact | Named::Lissajous => SEGMENTS,
            _ => INTERVALS,
        });
        // half a turn or a whole one over the intervals
        let half = (PI / (2 * count.max(1)) as f64).cos();
        let whole = (PI / count.max(1) as f64).cos();
        let scaled = |a: f64, b: f64| {
            move |middle: f64, _: f64| vec![function(middle, &[], a, 0.0), function(middle, &[], 0.0, b)]
        };
        match self {
            Named::Sphere | Named::Ellipsoid => open(order, half, count, scaled(1.0, 1.0)),
            Named::EllipsoidOfRevolution => open(order, half, count, scaled(2.0, 1.0)),
            Named::TorusExact => Ok(closed(
                order,
                count,
                vec![function(0.0, &[2.0], 1.0, 0.0), function(0.0, &[], 0.0, 1.0)],
            )),
            Named::Lissajous => Ok(closed(
                order,
                count,
                vec![
                    function(0.0, &[3.0], 1.0, 0.0),
                    function(0.0, &[], FRAC_1_SQRT_2, FRAC_1_SQRT_2),
                ],
            )),
            Named::Cone => open(order, 1.0, count, |middle, _| {
                let length = count as f64;
                vec![
                    function(middle, &[0.5, 1.0 / length], 0.0, 0.0),
                    function(middle, &[1.0, -2.0 / length], 0.0, 0.0),
                ]
            }),
            Named::Cylinder => open(order, 1.0, count, |middle, _| {
                vec![
                    function(middle, &[1.0], 0.0, 0.0),
                    function(middle, &[0.0, 1.0], 0.0, 0.0),
                ]
            }),
            Named::Hyperboloid => open(order, QUARTER.cosh(), count, scaled(1.0, 1.0)),
            Named::Catenoid => open(order, QUARTER.cosh(), count, |middle, w| {
                vec![function(middle, &[], 1.0, 0.0), function(middle, &[0.0, w], 0.0, 0.0)]
            }),
            Named::Cycloid => open(order, whole, count, |middle, w| {
                vec![
                    function(middle, &[1.0], 1.0, 0.0),
                    function(middle, &[0.0, w], 0.0, 1.0),
                ]
            }),
            Named::FangFig1 => {
                let (curve, exact) = Example::FangFig1.curve(Some(order), None, intervals.map(|n| n + order - 1))?;
                let axis = curve.axis();
                Ok(Direction {
                    order,
                    u0: axis.tension().value(),
                    ends: axis.ends(),
                    count: axis.count(),
                    functions: exact.functions().to_vec(),
                })
            }
            Named::Helicoid => open(order, 1.0, count, |middle, _| {
                vec![
                    function(middle, &[0.0, 2.0 / count as f64], 0.0, 0.0),
                    function(middle, &[1.0], 0.0, 0.0),
                ]
            }),
        }
    }
}

fn circular(origin: f64) -> Vec<Function> {
    vec![function(origin, &[], 1.0, 0.0), function(origin, &[], 0.0, 1.0)]
}

/// An open direction of so many intervals, with functions of the middle of the domain and the frequency.
fn open(
    order: usize,
    u0: f64,
    intervals: usize,
    functions: impl Fn(f64, f64) -> Vec<Function>,
) -> Result<Direction, Error> {
    let count = intervals.saturating_add(order - 1);
    let axis = Axis::new(order, u0, Ends::Open, count)?;
    let (from, to) = axis.domain();
    let w = Space::new(order, u0)?.frequency();
    Ok(Direction {
        order,
        u0,
        ends: Ends::Open,
        count,
        functions: functions((from + to) / 2.0, w),
    })
}

fn closed(order: usize, count: usize, functions: Vec<Function>) -> Direction {
    Direction {
        order,
        u0: (PI / count.max(1) as f64).cos().max(0.0),
        ends: Ends::Closed,
        count,
        functions,
    }
}

fn product(u: Direction, v: Direction, terms: [Vec<(usize, usize, f64)>; 3]) -> Result<Product, Error> {
    let curve = |d: &Direction| Curve::reproduce(d.order, d.u0, d.ends, d.count, &d.functions);
    let (first, second) = (curve(&u)?, curve(&v)?);
    let across: Vec<&[f64]> = second.points().collect();
    let mut points = Vec::with_capacity(u.count * v.count);
    for p in first.points() {
        for q in &across {
            let coordinate = |k: usize| terms[k].iter().map(|&(a, b, c)| c * p[a] * q[b]).sum::<f64>();
            points.push([0, 1, 2].map(coordinate));
        }
    }
    Ok(Product {
        grid: Grid::new(first.axis().clone(), second.axis().clone(), &points)?,
        spaces: [Space::new(u.order, u.u0)?, Space::new(v.order, v.u0)?],
        functions: [u.functions, v.functions],
        terms,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_surface_is_exact() {
        for named in Named::ALL {
            for (order, around) in [(None, None), (Some(5), Some(4)), (Some(6), Some(6)), (Some(9), Some(5))] {
                let product = named.grid([order, around], None, None).unwrap();
                let grid = &product.grid;
                let (s, t) = (grid.u().samples(3).unwrap(), grid.v().samples(3).unwrap());
                let rows = grid.sample(3).unwrap();
                let size = grid.points().flatten().fold(1.0_f64, |most, x| most.max(x.abs()));
                for (row, (s, _)) in rows.iter().zip(&s) {
                    for (point, (t, _)) in row.iter().zip(&t) {
                        let exact = product.at(*s, *t);
                        let off = (0..3).map(|k| (point[k] - exact[k]).abs()).fold(0.0, f64::max);
                        assert!(off < 1e-13 * size, "{named:?} {order:?} {around:?}: {off:e}");
                        // the equation holds for what the grid gives, not for the functions only
                        if let Some(residual) = named.equation([point[0], point[1], point[2]]) {
                            assert!(residual.abs() < 1e-11, "{named:?} {order:?} {around:?}: {residual:e}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn orders_and_counts_are_checked() {
        for (named, orders, segments) in [
            (Named::Catenoid, [Some(3), None], None),
            (Named::Helicoid, [None, Some(3)], None),
            (Named::Sphere, [Some(2), None], None),
            (Named::Sphere, [Some(33), None], None),
            (Named::Sphere, [None, None], Some(2)),
            (Named::TorusExact, [None, None], Some(0)),
        ] {
            let error = named.grid(orders, segments, None).unwrap_err();
            assert!(error.accepted().is_some(), "{named:?}: {error}");
        }
    }
}
