//! The patches of the annulus, also where a boundary, a crease or knot intervals meet the centre.
//!
//! Where all lines are uniform the patches are those of uniform B-splines ([`Annulus`]). Beside a spoke that
//! is sharp, or where knot intervals change, they are polynomial all the same if the rules there are the
//! refinement of the splines of a [`Side`]. That is claimed by the corner and **proven** here in exact
//! numbers: with `R_own` and `R_next` the refinements of the two directions of a sector, the row of every
//! refined point `(x, y)` of the sector that patches read must be the tensor product `R_own(x) R_next(y)`.
//! Then, with B for the Bernstein forms of patches, `B(refined net) = halves of B(net)` for all patches from
//! the annulus on inwards, and the function that B makes is the limit of refinement: B of the net of level m
//! is an affine combination, of bounded weights, of control points near the place, which tend to the limit
//! together.
//!
//! Rules are the same from some step on, counted from both spokes: further rows are shifted copies.

mod coordinates;
mod side;

pub use coordinates::coordinates;
pub use side::{Segment, Side};

use crate::{Error, Subject};
use eigenring_scheme::{BigRational, Corner, Exact, Fan, Level, Numbering, Scalar, Site};
use eigenring_spectral::{Annulus, PatchIndex};
use eigenring_spline::bernstein::Polynomial;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The patches around a centre.
#[derive(Clone, Debug)]
pub struct Patches {
    /// Where they are, and the numbering of the control points.
    pub annulus: Annulus,
    /// The splines of each direction, where they are not all uniform.
    sides: Option<Arc<Sides>>,
}

/// The Bernstein forms of the directions of every sector: along its own spoke, and along the next.
#[derive(Debug)]
struct Sides {
    segments: Vec<[Vec<Segment>; 2]>,
}

impl From<Annulus> for Patches {
    fn from(annulus: Annulus) -> Self {
        Patches { annulus, sides: None }
    }
}

/// Why the surface is not known to consist of polynomial patches.
#[derive(Clone, Debug, PartialEq)]
pub struct Unknown(pub String);

impl Patches {
    /// The patches of a subject on its innermost regular annulus, with all control points that determine
    /// them.
    ///
    /// # Errors
    /// Those of running the rules. The inner result says why patches are not known.
    pub fn new(subject: &Subject) -> Result<Result<Self, Unknown>, Error> {
        let scheme = &subject.scheme;
        let patches = match scheme.degree() {
            Some(2..) => Patches::from(Annulus::new(scheme)?),
            Some(_) => {
                let reason = "patches of degree 1 have kinks between them: the regular surface is not C1";
                return Ok(Err(Unknown(reason.to_owned())));
            }
            None => match Patches::beside_features(subject)? {
                Some(patches) => patches,
                None => return Ok(Err(Unknown(without_degree(subject)))),
            },
        };
        let rings = patches.annulus.numbering.rings.max(scheme.closed_rings()?);
        let annulus = Annulus {
            numbering: scheme.numbering(rings),
            ..patches.annulus
        };
        Ok(Ok(Patches { annulus, ..patches }))
    }

    fn beside_features(subject: &Subject) -> Result<Option<Self>, Error> {
        let (Some(corner), Some(exact)) = (&subject.corner, &subject.exact) else {
            return Ok(None);
        };
        let level = exact.limit();
        let Some(sides) = claimed(corner) else {
            return Ok(None);
        };
        let Some(degree) = degree(level)? else {
            return Ok(None);
        };
        let special = level.special_rings()?.unwrap_or(0);
        let inner = 1.max((special + degree / 2) / 2 + 1);
        let annulus = Annulus {
            degree,
            inner,
            numbering: exact.numbering(2 * inner - 1 - degree / 2 + degree),
        };
        if !are_refined(level, &sides, degree, inner)? {
            return Ok(None);
        }
        let of_side = |side: &Side| (0..2 * inner).map(|j| side.segment(degree, j)).collect();
        let sides = Sides {
            segments: sides.iter().map(|pair| pair.each_ref().map(of_side)).collect(),
        };
        Ok(Some(Patches {
            annulus,
            sides: Some(Arc::new(sides)),
        }))
    }

    /// The Bernstein forms of the two directions of a patch; `None` for uniform splines.
    fn segments(&self, patch: PatchIndex) -> Option<[&Segment; 2]> {
        let [own, next] = &self.sides.as_ref()?.segments[patch.sector];
        Some([&own[patch.p], &next[patch.q]])
    }

    /// Whether the curve of the first spoke reads points of that spoke only.
    pub(crate) fn first_edge_is_spoke(&self) -> bool {
        let patch = PatchIndex {
            sector: 0,
            p: self.annulus.inner,
            q: 0,
        };
        self.segments(patch).is_some_and(|[_, next]| {
            let mut weights = next.steps.iter().zip(&next.weights[0]);
            weights.all(|(&step, weight)| step == 0 || *weight == BigRational::from_integer(0.into()))
        })
    }

    /// The control points of a patch in the numbering, those of a line along the own spoke for each along the
    /// next.
    pub fn control(&self, patch: PatchIndex) -> Vec<usize> {
        let Some([own, next]) = self.segments(patch) else {
            return self.annulus.control(patch);
        };
        let numbering = self.annulus.numbering;
        let places = next.steps.iter().flat_map(|&y| own.steps.iter().map(move |&x| (x, y)));
        let index = |(x, y)| place(numbering.fan, patch.sector, x, y).and_then(|site| numbering.index(site));
        places
            .map(|at| index(at).expect("the proof of the patches has met these points, and the numbering holds them"))
            .collect()
    }

    /// A coordinate of a patch in Bernstein form, from its values at the points of the numbering.
    /// `conversion` is that of uniform splines of the degree.
    pub fn polynomial<S: Scalar + Copy>(
        &self,
        values: &[S],
        patch: PatchIndex,
        conversion: &[Vec<S>],
    ) -> Polynomial<S> {
        let control: Vec<S> = self.control(patch).into_iter().map(|index| values[index]).collect();
        let Some([own, next]) = self.segments(patch) else {
            return Polynomial::from_control(&control, conversion);
        };
        let [along, across] = [own, next].map(|segment| {
            let row = |row: &Vec<BigRational>| row.iter().map(S::rational).collect::<Vec<S>>();
            segment.weights.iter().map(row).collect::<Vec<_>>()
        });
        let dot = |weights: &[S], values: &mut dyn Iterator<Item = S>| {
            let terms = weights.iter().zip(values);
            terms.fold(S::zero(), |sum, (&weight, value)| sum + weight * value)
        };
        let lines: Vec<Vec<S>> = control
            .chunks(own.steps.len())
            .map(|line| along.iter().map(|w| dot(w, &mut line.iter().copied())).collect())
            .collect();
        let degree = self.annulus.degree;
        Polynomial::from_fn([degree; 2], |i, j| {
            dot(&across[j], &mut lines.iter().map(|line| line[i]))
        })
    }
}

/// What the rules beside a corner's spokes are claimed to refine: for each sector the side of the direction
/// along its own spoke, which begins at the next one, and of that along the next, which begins at the own.
/// `None` for intervals of no width.
fn claimed(corner: &Corner) -> Option<Vec<[Side; 2]>> {
    let (fan, spokes) = (corner.sectors(), corner.spokes());
    let at = |spoke: usize| &spokes[spoke % spokes.len()];
    let interval = |spoke: usize| BigRational::from_float(at(spoke).interval).filter(|_| at(spoke).interval > 0.0);
    let n = fan.sectors();
    let side = |begins: usize, before: usize, along: usize| {
        if at(begins).sharp {
            return Some(Side::Reflected);
        }
        if corner.is_uniform() {
            return Some(Side::Uniform);
        }
        Some(Side::Knots {
            before: interval(before)?,
            after: interval(along)?,
        })
    };
    (0..n)
        .map(|s| Some([side(s + 1, s + 2, s)?, side(s, s + n - 1, s + 1)?]))
        .collect()
}

/// The degree that the rules far from all spokes suggest: its mask has `d + 2` weights, of which those of
/// even and of odd refined points are read apart.
fn degree(level: &Level<Exact>) -> Result<Option<usize>, Error> {
    let far = 2 * level.last_irregular_step() as i32 + 4;
    let site = |x: i32| Site { sector: 0, x, y: x };
    let rows = level.rows(&[site(2 * far), site(2 * far + 2)])?;
    let columns = |row: &BTreeMap<Site, Exact>| row.keys().map(|source| source.x).collect::<BTreeSet<i32>>().len();
    let weights: usize = rows.iter().map(columns).sum();
    Ok(weights.checked_sub(2).filter(|&degree| degree >= 3 && degree % 2 == 1))
}

/// Whether the rows of all refined points that patches from the annulus on read are those of the sides.
fn are_refined(level: &Level<Exact>, sides: &[[Side; 2]], degree: usize, inner: usize) -> Result<bool, Error> {
    let fan = level.fan();
    let reach = (degree as i64 - 1) / 2;
    let first = 2 * inner as i64 - reach;
    // beyond the last irregular step two more show both kinds of points; patches read so many on
    let last = (level.last_irregular_step() as i64 + 2 + degree as i64).max(4 * inner as i64 + degree as i64);
    for (sector, [own, next]) in sides.iter().enumerate() {
        let steps = |side: &Side| if *side == Side::Reflected { 0 } else { -reach }..=last;
        let mut points = Vec::new();
        for y in steps(next) {
            points.extend(steps(own).filter(|&x| x.max(y) >= first).map(|x| (x, y)));
        }
        let sites: Option<Vec<Site>> = points.iter().map(|&(x, y)| place(fan, sector, x, y)).collect();
        let Some(sites) = sites else { return Ok(false) };
        let refined = |side: &Side| -> BTreeMap<i64, side::Combination> {
            steps(side).map(|step| (step, side.refined(degree, step))).collect()
        };
        let (along, across) = (refined(own), refined(next));
        for (&(x, y), row) in points.iter().zip(level.rows(&sites)?) {
            let mut expected: BTreeMap<Site, BigRational> = BTreeMap::new();
            for (&v, by) in &across[&y] {
                for (&u, bx) in &along[&x] {
                    let Some(site) = place(fan, sector, u, v) else {
                        return Ok(false);
                    };
                    *expected
                        .entry(site)
                        .or_insert_with(|| BigRational::from_integer(0.into())) += bx * by;
                }
            }
            let zero = BigRational::from_integer(0.into());
            let mut found: BTreeMap<Site, BigRational> = BTreeMap::new();
            for (site, weight) in row {
                match weight.as_rational() {
                    Some(weight) if weight == zero => {}
                    Some(weight) => drop(found.insert(site, weight)),
                    None => return Ok(false),
                }
            }
            expected.retain(|_, weight| *weight != zero);
            if found != expected {
                return Ok(false);
            }
        }
    }
    Ok(true)
}

/// The point so many steps along a sector's own spoke and along the next; negative ones lie across a spoke.
fn place(fan: Fan, sector: usize, x: i64, y: i64) -> Option<Site> {
    let (sector, x, y) = if x < 0 {
        (sector as i64 + 1, y, -x)
    } else {
        (sector as i64, x, y)
    };
    Site::new(fan, sector, 2 * x as i32, 2 * y as i32)
}

fn without_degree(subject: &Subject) -> String {
    if let Some(corner) = &subject.corner
        && !corner.is_plain()
    {
        return match corner.is_uniform() {
            true => "the rules beside a crease are no reflection, so that the surface there is not known".to_owned(),
            false => "knot intervals of no width, or around a face: the surface there is not known".to_owned(),
        };
    }
    let mask = subject.scheme.regular_mask().map(|mask| {
        let weights: Vec<String> = mask.values().map(|weight| format!("{}", weight.mid())).collect();
        format!(" ({})", weights.join(", "))
    });
    match mask {
        Some(mask) => format!(
            "the lines of all passes together{mask} are no uniform B-spline's mask, so that the regular surface is not known"
        ),
        None => "rules change across a spoke or from sector to sector also far from the centre".to_owned(),
    }
}

/// The numbering of a set of patches.
impl Patches {
    /// The points of the matrix that determines the patches.
    pub fn numbering(&self) -> Numbering {
        self.annulus.numbering
    }
}
