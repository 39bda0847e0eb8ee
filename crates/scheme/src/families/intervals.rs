//! Bicubic rules with knot intervals: around a vertex of valence 4, and around a face that is never split.
//!
//! Where four sectors meet, intervals are those of two knot vectors, and the rules are tensor products of the
//! univariate ones (Sederberg, Zheng, Sewell and Sabin 1998, Eqs. 1 to 3). After a level the first two edges
//! of a spoke have the same interval, so that the rules change for two levels and are the same from then on.
//! Around the n-gon of HNUSS (Li, Wei and Zhang 2019, section 4.3) points are doubled along the spokes, and
//! the corners of the n-gon have the rule
//!
//! ```text
//! P_i'    = (P_i + C)/2 + alpha_i (-n P_i + sum_j (1 + 2 cos(2 pi (j-i)/n)) P_j),     C = sum_i beta_i P_i
//! alpha_i = (1/n) d_i/(d_i + d_(i+2)) d_(i+1)/(d_(i+1) + d_(i-1))
//! beta_i  = [(d_(i-1) + d_(i+3)) d_(i+2) + (d_(i-2) + d_(i+2)) d_(i-1)]
//!           / sum_j (d_j + d_(j+2)) (d_(j-1) + d_(j+3))
//! ```

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
    let mut intervals: Vec<Vec<f64>> = corner
        .spokes()
        .iter()
        .map(|spoke| vec![spoke.interval, spoke.next])
        .collect();
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

fn four_sectors<S: Scalar>(intervals: &[Vec<f64>]) -> Result<Level<S>, Error> {
    let pass = Pass::by_sector(Lattice::Vertex, Lattice::Vertex, lines(intervals, false));
    Level::new(Fan::Closed(4), vec![pass])
}

fn split_face<S: Scalar>(intervals: &[Vec<f64>]) -> Result<Level<S>, Error> {
    let n = intervals.len();
    let fan = Fan::Closed(n);
    let d = |i: usize| intervals[i % n][0];
    let s = |value: f64| S::exact(value);
    // products and quotients of doubles in the scalar, so that enclosures enclose
    let ratio = |own: f64, other: f64, spokes: [usize; 2]| {
        if own + other == 0.0 {
            return Err(Error::ZeroIntervals { spokes });
        }
        Ok(s(own) / (s(own) + s(other)))
    };
    let total = (0..n).fold(S::zero(), |sum, j| {
        sum + (s(d(j)) + s(d(j + 2))) * (s(d(j + n - 1)) + s(d(j + 3)))
    });
    if (0..n).all(|j| (d(j) + d(j + 2)) * (d(j + n - 1) + d(j + 3)) == 0.0) {
        return Err(Error::ZeroIntervals { spokes: [0, 2] });
    }
    let beta = |i: usize| {
        let ahead = (s(d(i + n - 1)) + s(d(i + 3))) * s(d(i + 2));
        let behind = (s(d(i + n - 2)) + s(d(i + 2))) * s(d(i + n - 1));
        (ahead + behind) / total.clone()
    };
    let mut pass = Pass::by_sector(Lattice::Face, Lattice::Face, lines(intervals, true));
    let turns = n as i64;
    for i in 0..n {
        let along = ratio(d(i), d(i + 2), [i, (i + 2) % n])?;
        let next = ratio(d(i + 1), d(i + n - 1), [(i + 1) % n, (i + n - 1) % n])?;
        // n alpha_i
        let alpha = along * next;
        let terms = (0..n).map(|j| {
            let cosine = S::cos_turn(j as i64 - i as i64, turns);
            let mode = (S::one() + S::ratio(2, 1) * cosine) / S::ratio(turns, 1);
            let own = if i == j { S::one() } else { S::zero() };
            let half = S::ratio(1, 2) * (own.clone() + beta(j));
            (CORNER.rotated(fan, j as i64), half + alpha.clone() * (mode - own))
        });
        let stencil = terms.fold(Stencil::new(), |stencil, (site, weight)| stencil.with(site, weight));
        pass = pass.with(CORNER.rotated(fan, i as i64), stencil);
    }
    Level::new(fan, vec![pass])
}
