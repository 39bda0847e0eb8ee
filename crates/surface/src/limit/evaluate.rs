//! Evaluation of one face: its refined parts, kept while points are asked for.

use super::centre::Centre;
use super::ladder::Ladder;
use super::numbers::ByNumber;
pub use super::pair::Undefined;
use super::patch::{Jet3, Lanes, OnCrease, Patch, vector};
use super::quarter::{Context, applied, quartered};
use super::structure::{Part, Structure, What};
use super::{Place, Surface};
use crate::Error;
use nalgebra::{Point3, Vector3};
use std::collections::hash_map::Entry;
use std::sync::Arc;

/// What the surface is like at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Away from irregular centres, or at a regular one: all derivatives exist.
    Regular,
    /// At an irregular centre with curvature zero.
    Flat,
    /// At an irregular centre with bounded curvature that depends on the direction: the range of the Gauss
    /// and the mean curvature.
    Bounded {
        /// Least and largest Gauss curvature.
        gauss: [f64; 2],
        /// Least and largest mean curvature.
        mean: [f64; 2],
    },
    /// At an irregular centre with curvature that grows without bound, like the distance to this power.
    Unbounded {
        /// The power of the distance.
        exponent: f64,
        /// The signs of Gauss curvatures around it, least and largest.
        signs: [f64; 2],
    },
    /// At a centre without a normal.
    Undefined(Undefined),
}

impl Kind {
    /// The word for it.
    pub fn name(&self) -> &'static str {
        match self {
            Kind::Regular => "regular",
            Kind::Flat => "flat",
            Kind::Bounded { .. } => "bounded",
            Kind::Unbounded { .. } => "unbounded",
            Kind::Undefined(_) => "not defined",
        }
    }
}

/// A point of the surface. What does not exist is `None`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The point.
    pub position: Point3<f64>,
    /// Derivatives by s and t; at irregular centres none.
    pub first: Option<[Vector3<f64>; 2]>,
    /// Derivatives by ss, st, tt.
    pub second: Option<[Vector3<f64>; 3]>,
    /// The unit normal, on the side from which faces run counter-clockwise.
    pub normal: Option<Vector3<f64>>,
    /// Gauss curvature.
    pub gauss: Option<f64>,
    /// Mean curvature, negative on a sphere with outward normal.
    pub mean: Option<f64>,
    /// Principal curvatures, the smaller first.
    pub principal: Option<[f64; 2]>,
    /// What the surface is like here.
    pub kind: Kind,
}

impl Sample {
    /// A sample that is yet to be filled in.
    pub const ORIGIN: Sample = Sample {
        position: Point3::new(0.0, 0.0, 0.0),
        first: None,
        second: None,
        normal: None,
        gauss: None,
        mean: None,
        principal: None,
        kind: Kind::Regular,
    };
}

/// Curvatures of a jet.
pub(crate) struct Curvature {
    pub normal: Vector3<f64>,
    pub gauss: f64,
    pub mean: f64,
    pub principal: [f64; 2],
}

#[inline]
pub(crate) fn curvature(first: &[Vector3<f64>; 2], second: &[Vector3<f64>; 3]) -> Option<Curvature> {
    let [xs, xt] = first;
    let cross = xs.cross(xt);
    let area = cross.norm();
    if !(area > 0.0 && area.is_finite()) {
        return None;
    }
    // two quotients for all: division is what takes time here
    let per_area = 1.0 / area;
    let normal = cross * per_area;
    let [l, m, n] = [0, 1, 2].map(|i| normal.dot(&second[i]));
    let (e, f, g) = (xs.dot(xs), xs.dot(xt), xt.dot(xt));
    let per_square = per_area * per_area;
    let gauss = (l * n - m * m) * per_square;
    let mean = (e * n - 2.0 * f * m + g * l) * (0.5 * per_square);
    // the second form in the orthonormal basis of the first tangent and its normal in the plane
    let long = e.sqrt();
    let per_long = 1.0 / long;
    let along = f * per_long;
    let a = l * per_long * per_long;
    let mixed = m * per_long;
    let per_beside = long * per_area;
    let b = (mixed - along * a) * per_beside;
    let c = (n - 2.0 * along * mixed + along * along * a) * (per_beside * per_beside);
    let spread = length((a - c) / 2.0, b);
    Some(Curvature {
        normal,
        gauss,
        mean,
        principal: [(a + c) / 2.0 - spread, (a + c) / 2.0 + spread],
    })
}

/// The length of a vector. The root of the sum of squares is as good as `hypot` where squares are no
/// extremes.
#[inline]
fn length(x: f64, y: f64) -> f64 {
    let square = x * x + y * y;
    if (1e-280..1e280).contains(&square) {
        square.sqrt()
    } else {
        x.hypot(y)
    }
}

/// A part of the face with its points.
enum Node {
    Regular(Patch),
    /// A centre at a corner.
    Centre(u32, Arc<Centre>, Box<Ladder>),
    /// Quarters, and the points from which they pick theirs.
    Inner(Arc<Structure>, Vec<[f64; 3]>, [Option<Box<Node>>; 4]),
}

impl Node {
    fn new(surface: &Surface<'_>, part: &Part, point: impl Fn(u32) -> [f64; 3]) -> Result<Self, Error> {
        let structure = &part.structure;
        let points: Vec<[f64; 3]> = part.ids.iter().map(|&id| point(id)).collect();
        Ok(match &structure.what {
            What::Regular(control) => Node::Regular(Patch::new(control, &points, &surface.kernel, structure.level)?),
            What::Centre { corner, centre, ids } => {
                let points: Vec<Point3<f64>> = ids.iter().map(|&id| points[id as usize].into()).collect();
                Node::Centre(*corner, Arc::clone(centre), Box::new(Ladder::new(centre, &points)))
            }
            What::Inner(inner) => Node::Inner(
                Arc::clone(structure),
                applied(&inner.refined.tables, &points)?,
                [None, None, None, None],
            ),
        })
    }

    /// The part of the base counted from a half-edge.
    #[cold]
    fn root(surface: &Surface<'_>, half: u32) -> Result<Self, Error> {
        let part = Part::root(surface, half)?;
        let points = surface.net.as_ref().map_or(surface.base.points(), |net| &net.points);
        Node::new(surface, &part, |id| points[id as usize].into())
    }
}

/// Evaluates places of one face.
pub struct Evaluator<'s, 'r> {
    surface: &'s Surface<'r>,
    face: u32,
    /// The half-edges of the face: the first, and how many.
    first: u32,
    size: u32,
    /// By the half-edge of the base from whose corner the part is counted, from the first one of the face.
    roots: ByNumber<Node>,
}

impl<'s, 'r> Evaluator<'s, 'r> {
    pub(super) fn new(surface: &'s Surface<'r>, face: u32) -> Self {
        let starts = surface.control.starts();
        let first = starts[face as usize];
        Evaluator {
            surface,
            face,
            first,
            size: starts[face as usize + 1] - first,
            roots: ByNumber::default(),
        }
    }

    /// The point at a place of this face.
    ///
    /// # Errors
    /// [`Error::Range`] for parameters outside.
    pub fn at(&mut self, place: Place) -> Result<Sample, Error> {
        let mut sample = Sample::ORIGIN;
        self.fill(place, &mut sample)?;
        Ok(sample)
    }

    /// Writes the point at a place of this face.
    #[inline]
    pub(super) fn fill(&mut self, place: Place, sample: &mut Sample) -> Result<(), Error> {
        debug_assert_eq!(place.face, self.face);
        let (half, mut s, mut t, mut scale) = self.located(place)?;
        let surface = self.surface;
        let mut at = match self.roots.entry(u64::from(half)) {
            Entry::Occupied(entry) => entry.into_mut(),
            Entry::Vacant(entry) => entry.insert(Node::root(surface, half)?),
        };
        loop {
            match at {
                Node::Regular(patch) => {
                    regular(&patch.jet(s, t), scale, patch.on_crease(s, t), sample);
                    return Ok(());
                }
                Node::Centre(corner, centre, ladder) => {
                    return beside(surface.context(), *corner, centre, ladder, [s, t, scale], sample);
                }
                Node::Inner(structure, points, quarters) => {
                    let (quarter, fine_s, fine_t) = quartered(s, t);
                    (s, t) = (fine_s, fine_t);
                    scale *= 2.0;
                    at = match &mut quarters[quarter] {
                        Some(node) => node,
                        empty => {
                            let part = structure.quarter(surface, quarter)?;
                            let node = Node::new(surface, part, |id| points[id as usize])?;
                            empty.insert(Box::new(node))
                        }
                    };
                }
            }
        }
    }

    /// Whether a place of this face is there.
    pub(super) fn check(&self, place: Place) -> Result<(), Error> {
        self.located(place).map(|_| ())
    }

    /// The half-edge of the base that a place counts from, the parameters there, and how much finer they are.
    fn located(&self, place: Place) -> Result<(u32, f64, f64, f64), Error> {
        let (first, size) = (self.first, self.size);
        let range = |what, given: String, accepted: String| Err(Error::Range { what, given, accepted });
        for (what, value) in [("s", place.s), ("t", place.t)] {
            if !(0.0..=1.0).contains(&value) {
                return range(what, value.to_string(), "0 to 1".to_owned());
            }
        }
        if size == 4 && place.sub != 0 {
            return range("sub", place.sub.to_string(), "0 on a face with four corners".to_owned());
        }
        if size != 4 && place.sub >= size {
            return range("sub", place.sub.to_string(), format!("0 to {} on this face", size - 1));
        }
        if place.corner > 3 {
            return range("corner", place.corner.to_string(), "0 to 3".to_owned());
        }
        let (mut s, mut t, mut scale) = (place.s, place.t, 1.0);
        // a half-edge of the control mesh is a face after a level
        let (mut half, mut levels) = if size == 4 {
            (first + place.corner, self.surface.lift)
        } else {
            (4 * (first + place.sub) + place.corner, self.surface.lift - 1)
        };
        while levels > 0 {
            let (quarter, fine_s, fine_t) = quartered(s, t);
            (s, t) = (fine_s, fine_t);
            scale *= 2.0;
            levels -= 1;
            // the corner of the quarter, counted from the corner of the place
            let quarter = quarter as u32;
            let corner = half / 4 * 4 + (half + quarter) % 4;
            let corner = if levels + 1 == self.surface.lift {
                // a quad of the control mesh
                first + (half - first + quarter) % 4
            } else {
                corner
            };
            half = 4 * corner + (4 - quarter) % 4;
        }
        Ok((half, s, t, scale))
    }
}

#[inline]
fn regular(jet: &Jet3, scale: f64, on_crease: Option<OnCrease>, sample: &mut Sample) {
    let [position, xs, xt, xss, xst, xtt] = jet;
    let first = [vector(xs), vector(xt)].map(|d| d * scale);
    let second = [vector(xss), vector(xst), vector(xtt)].map(|d| d * (scale * scale));
    let curved = curvature(&first, &second);
    smooth(Point3::from(vector(position)), first, second, curved, sample);
    if let Some(crease) = on_crease {
        without_second(sample, crease);
    }
}

/// A place with derivatives, whose curvature is not defined where they are degenerate.
#[inline]
fn smooth(
    position: Point3<f64>,
    first: [Vector3<f64>; 2],
    second: [Vector3<f64>; 3],
    curved: Option<Curvature>,
    sample: &mut Sample,
) {
    sample.position = position;
    sample.first = Some(first);
    sample.second = Some(second);
    sample.normal = curved.as_ref().map(|c| c.normal);
    sample.gauss = curved.as_ref().map(|c| c.gauss);
    sample.mean = curved.as_ref().map(|c| c.mean);
    sample.principal = curved.as_ref().map(|c| c.principal);
    sample.kind = if curved.is_some() {
        Kind::Regular
    } else {
        Kind::Undefined(Undefined::Degenerate)
    };
}

/// A place on a crease that acts in some smoothing steps only, from second derivatives beside it.
fn without_second(sample: &mut Sample, crease: OnCrease) {
    sample.second = None;
    if let Some(gauss) = sample.gauss.filter(|_| crease.grows) {
        sample.gauss = None;
        sample.mean = None;
        sample.principal = None;
        sample.kind = Kind::Unbounded {
            exponent: crease.power,
            signs: [gauss.signum(); 2],
        };
    }
}

/// Parameters counted from another corner of the unit square.
fn turned(corner: u32, s: f64, t: f64) -> (f64, f64) {
    match corner {
        0 => (s, t),
        1 => (t, 1.0 - s),
        2 => (1.0 - s, 1.0 - t),
        _ => (1.0 - t, s),
    }
}

fn beside(
    context: Context<'_>,
    corner: u32,
    centre: &Centre,
    ladder: &mut Ladder,
    [s, t, scale]: [f64; 3],
    sample: &mut Sample,
) -> Result<(), Error> {
    let (mut s, mut t) = turned(corner, s, t);
    if s == 0.0 && t == 0.0 {
        *sample = at_centre(context, centre, ladder)?;
        return Ok(());
    }
    let mut m = 0;
    while s < 0.5 && t < 0.5 {
        (s, t) = (2.0 * s, 2.0 * t);
        m += 1;
    }
    let (quarter, s, t) = quartered(s, t);
    let (jet, finer, on_crease) = ladder.jet(context, centre, m, quarter, s, t)?;
    let curved = scaled_curvature(&jet, ladder, m);
    let shrunk = ladder.lambda.powi(m as i32);
    let real = |x: &Lanes| -> Vector3<f64> {
        let [e1, e2, e3] = &ladder.frame;
        (e1 * x[0] + e2 * x[1] + e3 * (x[2] * shrunk)) * shrunk
    };
    let scale = scale * finer * 2_f64.powi(m as i32);
    let [xs, xt] = [1, 2].map(|i| real(&jet[i]) * scale);
    let [xss, xst, xtt] = [3, 4, 5].map(|i| real(&jet[i]) * scale * scale);
    // back to the parameters of the face
    let (first, second) = match corner {
        0 => ([xs, xt], [xss, xst, xtt]),
        1 => ([-xt, xs], [xtt, -xst, xss]),
        2 => ([-xs, -xt], [xss, xst, xtt]),
        _ => ([xt, -xs], [xtt, -xst, xss]),
    };
    smooth(ladder.position + real(&jet[0]), first, second, curved, sample);
    if let Some(crease) = on_crease {
        without_second(sample, crease);
    }
    Ok(())
}

/// The curvature of a jet in the frame of a ladder: of the surface `(x, y, lambda^m z)`, scaled back.
pub(super) fn scaled_curvature(jet: &Jet3, ladder: &Ladder, m: usize) -> Option<Curvature> {
    let shrunk = ladder.lambda.powi(m as i32);
    let flat = |x: &Lanes| Vector3::new(x[0], x[1], x[2] * shrunk);
    let first = [flat(&jet[1]), flat(&jet[2])];
    let second = [flat(&jet[3]), flat(&jet[4]), flat(&jet[5])];
    let curved = curvature(&first, &second)?;
    let [e1, e2, e3] = &ladder.frame;
    let n = curved.normal;
    Some(Curvature {
        normal: (e1 * n.x + e2 * n.y + e3 * n.z).normalize(),
        gauss: curved.gauss / shrunk / shrunk,
        mean: curved.mean / shrunk,
        principal: curved.principal.map(|k| k / shrunk),
    })
}

/// The level at which curvature around a centre is looked at: all eigenvalues but the largest have died out
/// there, and nothing has underflown.
const DEEP: usize = 40;

fn at_centre(context: Context<'_>, centre: &Centre, ladder: &mut Ladder) -> Result<Sample, Error> {
    let kind = kind_at_centre(context, centre, ladder)?;
    let flat = kind == Kind::Flat;
    Ok(Sample {
        position: ladder.position,
        first: None,
        second: None,
        normal: ladder.tangents.is_ok().then_some(ladder.frame[2]),
        gauss: flat.then_some(0.0),
        mean: flat.then_some(0.0),
        principal: flat.then_some([0.0; 2]),
        kind,
    })
}

/// What curvature does around a centre; beside creases that act in some smoothing steps only it is unbounded
/// whatever the centre is like.
fn kind_at_centre(context: Context<'_>, centre: &Centre, ladder: &mut Ladder) -> Result<Kind, Error> {
    let kind = kind_of_centre(context, centre, ladder)?;
    let Some(power) = centre.power_of_creases(context)? else {
        return Ok(kind);
    };
    Ok(match kind {
        Kind::Flat => Kind::Unbounded {
            exponent: power,
            signs: [0.0; 2],
        },
        Kind::Bounded { gauss, .. } => Kind::Unbounded {
            exponent: power,
            signs: gauss.map(f64::signum),
        },
        kind => kind,
    })
}

fn kind_of_centre(context: Context<'_>, centre: &Centre, ladder: &mut Ladder) -> Result<Kind, Error> {
    if let Err(why) = ladder.tangents {
        return Ok(Kind::Undefined(why));
    }
    let heights: Vec<f64> = ladder.points(centre, centre.leading())?.iter().map(|p| p[2]).collect();
    let Some(mu) = centre.second_modulus(&heights) else {
        return Ok(Kind::Flat);
    };
    let square = ladder.lambda * ladder.lambda;
    if mu < square * (1.0 - 1e-7) {
        return Ok(Kind::Flat);
    }
    let deep = DEEP + centre.leading();
    let (mut gauss, mut mean) = ([f64::INFINITY, f64::NEG_INFINITY], [f64::INFINITY, f64::NEG_INFINITY]);
    for quarter in 1..4 {
        for (i, j) in (0..5).flat_map(|i| (0..5).map(move |j| (i, j))) {
            let (s, t) = (f64::from(i) / 4.0, f64::from(j) / 4.0);
            let (jet, ..) = ladder.jet(context, centre, deep, quarter, s, t)?;
            if let Some(curved) = scaled_curvature(&jet, ladder, deep) {
                gauss = [gauss[0].min(curved.gauss), gauss[1].max(curved.gauss)];
                mean = [mean[0].min(curved.mean), mean[1].max(curved.mean)];
            }
        }
    }
    if mu > square * (1.0 + 1e-7) {
        return Ok(Kind::Unbounded {
            exponent: 2.0 * mu.ln() / ladder.lambda.ln() - 4.0,
            signs: gauss.map(f64::signum),
        });
    }
    Ok(Kind::Bounded { gauss, mean })
}
