//! Bicubic rules with knot intervals: around a vertex of valence 4, and around a face that is never split.
//!
//! Where four sectors meet, intervals are those of two knot vectors, and the rules are tensor products of the
//! univariate ones (Sederberg, Zheng, Sewell and Sabin 1998, Eqs. 1 to 3). After a level the first two edges
//! of a spoke have the same interval, so that the rules change for two levels and are the same from then on.
//! Around the n-gon of HNUSS (Li, Wei and Zhang 2019, section 4.3) points are doubled along the spokes, and
//! the corners of the n-gon have the rule of [`SplitFace`].

use super::SplitFace;
use super::doo_sabin::CORNER;
use crate::knots::Intervals;
use crate::{Centre, Corner, Error, Fan, Lattice, Level, Pass, Scalar, Scheme, Stencil};

/// The scheme around a corner with knot intervals.
///
/// # Errors
/// [`Error::Unsupported`] unless it is a closed fan without creases, and around a vertex one of four sectors;
/// [`Error::ZeroIntervals`] where a rule divides by a sum of intervals that are all zero.
pub fn with_intervals<S: Scalar>(name: &str, corner: &Corner) -> Result<Scheme<S>, Error> {
    let fan = corner.sectors();
    let refuse = |accepted: &str| Error::Unsupported {
        scheme: name.to_owned(),
        corner: corner.to_string(),
        accepted: accepted.to_owned(),
    };
    let accepted = "knot intervals around a vertex of valence 4 without creases, and around a face that is never split";
    if !fan.is_closed() || corner.has_creases() || corner.is_fixed() {
        return Err(refuse(accepted));
    }
    let level: Rules<S> = match (corner.centre(), fan.sectors()) {
        (Centre::Vertex, 4) => four_sectors,
        (Centre::SplitFace, _) => split_face,
        _ => return Err(refuse(accepted)),
    };
    let splits_zeros = corner.centre() == Centre::Vertex;
    let mut intervals = corner.intervals();
    let mut leading = Vec::new();
    while leading.len() < LEADING && intervals.iter().any(|list| halved(list, splits_zeros) != *list) {
        leading.push(level(&intervals)?);
        intervals = intervals.iter().map(|list| halved(list, splits_zeros)).collect();
    }
    // by now the intervals of all edges that the rings around the centre read are those of the first
    let first = |list: &Vec<f64>| match list[0] {
        0.0 if !splits_zeros => list[..2.min(list.len())].to_vec(),
        first => vec![first],
    };
    let limit: Vec<Vec<f64>> = intervals.iter().map(first).collect();
    Ok(Scheme::new(name, leading, level(&limit)?))
}

/// The level of the intervals of each spoke.
type Rules<S> = fn(&[Vec<f64>]) -> Result<Level<S>, Error>;

/// Levels until the first eight edges of every spoke have one interval: more than any analysis around the
/// centre reads.
const LEADING: usize = 3;

/// The intervals of a spoke after a level, in units twice as small: each edge twice, except that one without
/// width may stay whole.
fn halved(list: &[f64], splits_zeros: bool) -> Vec<f64> {
    let twice = |&interval: &f64| {
        if interval == 0.0 && !splits_zeros {
            vec![0.0]
        } else {
            vec![interval; 2]
        }
    };
    let mut fine: Vec<f64> = list.iter().flat_map(twice).collect();
    // the last one holds for all further edges
    while fine.len() > 1 && fine[fine.len() - 1] == fine[fine.len() - 2] {
        fine.pop();
    }
    fine
}

/// The two rules of each sector: along its own spoke i, from spoke i+2 beyond, and along the next.
fn lines<S: Scalar>(intervals: &[Vec<f64>], doubled: bool) -> Vec<[crate::Line<S>; 2]> {
    let n = intervals.len();
    let rule = |before: usize, after: usize| {
        let intervals = Intervals {
            before: intervals[before % n].clone(),
            after: intervals[after % n].clone(),
            doubled,
        };
        intervals.line()
    };
    (0..n).map(|i| [rule(i + 2, i), rule(i + n - 1, i + 1)]).collect()
}

/// The two rules of each sector around a vertex with these intervals of its spokes, of which the last holds
/// for all further edges: along its own spoke and along the next.
pub fn sector_lines<S: Scalar>(intervals: &[Vec<f64>]) -> Vec<[crate::Line<S>; 2]> {
    lines(intervals, false)
}

fn four_sectors<S: Scalar>(intervals: &[Vec<f64>]) -> Result<Level<S>, Error> {
    let pass = Pass::by_sector(Lattice::Vertex, Lattice::Vertex, lines(intervals, false));
    Level::new(Fan::Closed(4), vec![pass])
}

fn split_face<S: Scalar>(intervals: &[Vec<f64>]) -> Result<Level<S>, Error> {
    let n = intervals.len();
    let fan = Fan::Closed(n);
    let first: Vec<f64> = intervals.iter().map(|list| list[0]).collect();
    let face = SplitFace::new(&first)?;
    let mut pass = Pass::by_sector(Lattice::Face, Lattice::Face, lines(intervals, true));
    for i in 0..n {
        let terms = (0..n).map(|j| (CORNER.rotated(fan, j as i64), face.weight(i, j)));
        let stencil = terms.fold(Stencil::new(), |stencil, (site, weight)| stencil.with(site, weight));
        pass = pass.with(CORNER.rotated(fan, i as i64), stencil);
    }
    Level::new(fan, vec![pass])
}
