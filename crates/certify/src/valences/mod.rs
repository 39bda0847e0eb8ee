//! Proofs for all valences at once.
//!
//! A scheme with one rule for every valence ([`Family`]) is a curve of schemes over `tau = tan(pi/N)`, from
//! tau of the first valence down to 0. The curve is covered by intervals of tau ([`Tile`]s), and every
//! statement is checked on a whole interval at once, as in [`range`](crate::range): what holds for all real
//! tau in `(0, tan(pi/n)]` holds at every valence from n on.
//!
//! * **Eigenvalues.** Blocks of the points next to the centre have at most two unknowns, and trace and
//!   determinant are linear in the cosine of the block's angle, so that the blocks 2 to N-2 are compared with
//!   block 1 for all angles at once. Block 0 tends to block 1 as N grows: `p_0(lambda) - p_1(lambda)` is of
//!   order 1/N for their characteristic polynomials, is divided by that, and stays positive. Rings further
//!   out are bounded by the sums of the moduli of their rows (`tile.rs`, `rules.rs`).
//! * **The map** is drawn in coordinates in which thin sectors have a limit: see `tile.rs`. It is regular if
//!   the Jacobian is positive on sector 0.
//! * **Injective**: where the first coordinate is positive on sector 0, its outer boundary stays in a
//!   half-plane; it leads from a point to that point turned by theta, so that its argument grows by exactly
//!   theta = 2 pi/N < pi, and the boundaries of all sectors together wind once round the centre. For a
//!   regular map that decides, as for single valences.
//! * **Curvature** is unbounded at every valence from 5 on at which block 2, which is none of the blocks 1
//!   and N-1 there, has an eigenvalue above lambda^2. Its vector is not zero on the points next to the
//!   centre, which patches depend on.
//!
//! Smaller valences have fewer blocks, and have certificates of their own.
//!
//! ```
//! use eigenring_certify::valences::{Family, prove};
//! use eigenring_certify::{Requirement, Status};
//!
//! let certificate = prove(Family::DooSabin, 5)?;
//! assert_eq!(Requirement::C1.verdict(&certificate.checks).1, Status::Proven);
//! # Ok::<(), eigenring_certify::Error>(())
//! ```

mod rules;
mod tile;

pub use rules::Family;
pub use tile::Tile;

use crate::document::{Document, tool};
use crate::{Check, Error, Interval, Statement, Witness};
use eigenring_scheme::Scalar;
use rules::{Inner, Rules};
use serde::{Deserialize, Serialize};
use tile::Found;

/// The format that this version reads and writes.
pub const VALENCES_VERSION: u32 = 1;

/// The smallest first valence: from here on the blocks 2 and N-2 are two, and others than 1 and N-1.
pub const LEAST: usize = 5;

/// The largest first valence, that of single certificates.
pub const MOST: usize = 1000;

/// Tiles are not cut below this width, nor are there more than so many. Empirical: eigenvalues and map of
/// both families are decided on tiles of a hundredth; a statement that is not decided on these fails at some
/// tau, or nearly so.
const NARROWEST: f64 = 1e-4;
const MOST_TILES: usize = 2000;

/// What is known of a scheme at every valence from one on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ValencesCertificate {
    /// Version of the format, [`VALENCES_VERSION`].
    pub version: u32,
    /// Version of the tool.
    pub tool: String,
    /// The scheme.
    pub scheme: Family,
    /// The first valence.
    pub from: usize,
    /// The tiles, which cover `0..tan(pi/from)`, in order.
    pub tiles: Vec<Tile>,
    /// What is claimed of every valence from the first on.
    pub checks: Vec<Check>,
    /// FNV-1a hash of everything else.
    pub digest: String,
}

/// What checking a certificate of all valences again has shown.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ValencesRecheck {
    /// Whether the digest is that of the content, and the text what is written for it.
    pub intact: bool,
    /// Statements of which something else is found than claimed.
    pub differences: Vec<Statement>,
}

impl ValencesRecheck {
    /// Whether the certificate is unchanged and everything it claims was confirmed.
    pub fn confirmed(&self) -> bool {
        self.intact && self.differences.is_empty()
    }
}

/// An upper bound of `tan(pi/n)`.
fn last(from: usize) -> Result<f64, Error> {
    if !(LEAST..=MOST).contains(&from) {
        return Err(Error::Valences {
            from,
            least: LEAST,
            most: MOST,
        });
    }
    let [sine, cosine] = [Interval::sin_turn, Interval::cos_turn].map(|f| f(1, 2 * from as i64));
    Ok((sine / cosine).hi())
}

/// Proves what it can of a scheme at every valence from `from` on.
///
/// # Errors
/// [`Error::Valences`].
pub fn prove(scheme: Family, from: usize) -> Result<ValencesCertificate, Error> {
    let end = last(from)?;
    let rules = Rules::new(scheme)?;
    let tiles = rules.as_ref().map_or(Vec::new(), |rules| cover(rules, end));
    let certificate = ValencesCertificate {
        version: VALENCES_VERSION,
        tool: tool(),
        scheme,
        from,
        checks: rules.map_or(Vec::new(), |rules| checks(&rules, from, end, &tiles)),
        tiles,
        digest: String::new(),
    };
    Ok(certificate.signed())
}

/// Bisects until every tile is decided, or as small as the limits say.
fn cover(rules: &Rules, end: f64) -> Vec<Tile> {
    let mut waiting = vec![[0.0, end]];
    let mut tiles = Vec::new();
    while let Some([start, end]) = waiting.pop() {
        let tile = Tile::find(rules, [start, end]);
        let decided = tile.check(rules).is_some_and(|found| {
            let second = found.second.is_none_or(|ratio| !ratio.contains(1.0));
            found.leads && found.jacobian.is_some() && found.inside && second
        });
        let middle = start + (end - start) / 2.0;
        let room = tiles.len() + waiting.len() < MOST_TILES && end - start > NARROWEST;
        if !decided && room {
            waiting.push([middle, end]);
            waiting.push([start, middle]);
        } else {
            tiles.push(tile);
        }
    }
    tiles
}

/// What the tiles show.
fn checks(rules: &Rules, from: usize, end: f64, tiles: &[Tile]) -> Vec<Check> {
    let mut reached = 0.0;
    let covered = tiles.iter().all(|tile| {
        let [start, stop] = tile.tau;
        let follows = start == reached && start < stop;
        reached = stop;
        follows
    }) && reached == end;
    let found: Option<Vec<Found>> = tiles.iter().map(|tile| tile.check(rules)).collect();
    let found = found.filter(|_| covered).unwrap_or_default();
    let all = |holds: &dyn Fn(&Found) -> bool| !found.is_empty() && found.iter().all(holds);
    let hull = |of: &dyn Fn(&Found) -> Option<Interval>| {
        let values: Option<Vec<Interval>> = found.iter().map(of).collect();
        values.and_then(|values| values.into_iter().reduce(Interval::hull))
    };
    let open = |statement| Check::undecided(statement, "not decided by the tiles");

    let mut list = Vec::new();
    list.push(match rules.affine {
        true => Check::proven(Statement::RowSums)
            .enclosing(Interval::point(0.0))
            .remark("in exact arithmetic, as identities in N"),
        false => Check::undecided(Statement::RowSums, "the rows do not sum to 1 for every N"),
    });
    let positive = rules.positive && rules.inner.is_positive(from);
    list.push(match positive {
        true => Check::proven(Statement::Hull).remark("in exact arithmetic, for every N"),
        false => Check::undecided(Statement::Hull, "a weight may be negative"),
    });
    let leads = rules.affine && all(&|found| found.leads);
    let lambda = hull(&|found| Some(found.lambda)).unwrap_or(Interval::ENTIRE);
    list.push(match leads {
        true => Check::proven(Statement::Dominant)
            .margin((Interval::point(1.0) - lambda).lo())
            .enclosing(lambda),
        false => open(Statement::Dominant),
    });
    list.push(match leads {
        true => Check::proven(Statement::Subdominant).enclosing(lambda).remark(format!(
            "lambda lies between {:.6} and {:.6}; its lead over block 0 may vanish as N grows",
            lambda.lo(),
            lambda.hi()
        )),
        false => open(Statement::Subdominant),
    });
    let least = found
        .iter()
        .map(|found| found.jacobian.unwrap_or(0.0))
        .fold(f64::INFINITY, f64::min);
    let regular = leads && all(&|found| found.jacobian.is_some());
    list.push(match regular {
        true => Check::proven(Statement::Regular)
            .margin(least)
            .remark("the Jacobian divided by tan(pi/N)"),
        false => open(Statement::Regular),
    });
    list.push(match regular && all(&|found| found.inside) {
        true => Check::proven(Statement::Injective)
            .remark("each sector lies in a half-plane, so that all together wind once round the centre"),
        false => open(Statement::Injective),
    });
    list.push(match hull(&|found| found.second) {
        Some(ratio) if leads && ratio.lo() > 1.0 => {
            let text = format!(
                "an eigenvalue of block 2 is at least {} lambda^2 at every valence",
                ratio.lo()
            );
            Check::refuted(Statement::BoundedCurvature, Witness::new(text).with("ratio", ratio)).enclosing(ratio)
        }
        _ if matches!(rules.inner, Inner::Face { .. }) => {
            let reason = "lambda^2 = 1/4 is an eigenvalue of outer rings too, where Jordan blocks are not excluded";
            Check::undecided(Statement::BoundedCurvature, reason)
        }
        _ => open(Statement::BoundedCurvature),
    });
    list
}

impl Document for ValencesCertificate {
    const VERSION: u32 = VALENCES_VERSION;

    fn digest(&mut self) -> &mut String {
        &mut self.digest
    }
}

impl ValencesCertificate {
    /// The certificate as indented JSON.
    ///
    /// # Errors
    /// [`Error::Syntax`] if a number is not finite, which no certificate of this crate has.
    pub fn to_json(&self) -> Result<String, Error> {
        self.written()
    }

    /// The certificate as JSON on one line.
    ///
    /// # Errors
    /// As [`ValencesCertificate::to_json`].
    pub fn to_line(&self) -> Result<String, Error> {
        self.on_one_line()
    }

    /// Reads a certificate; its digest is looked at by [`recheck_valences_text`].
    ///
    /// # Errors
    /// [`Error::Version`] or [`Error::Syntax`].
    pub fn from_json(text: &str) -> Result<Self, Error> {
        ValencesCertificate::read(text)
    }
}

/// Checks the text of a stored certificate again with the checks alone; it must be exactly what is written
/// for the certificate that it holds.
///
/// # Errors
/// Those of reading it; [`Error::Valences`].
pub fn recheck_valences_text(text: &str) -> Result<(ValencesCertificate, ValencesRecheck), Error> {
    let certificate = ValencesCertificate::from_json(text)?;
    let end = last(certificate.from)?;
    let found = Rules::new(certificate.scheme)?.map_or(Vec::new(), |rules| {
        checks(&rules, certificate.from, end, &certificate.tiles)
    });
    let differs = |statement: &Statement| {
        let of = |list: &[Check]| {
            list.iter()
                .filter(|check| check.name == *statement)
                .cloned()
                .collect::<Vec<_>>()
        };
        of(&found) != of(&certificate.checks)
    };
    let in_order = certificate.checks.len() == found.len()
        && certificate
            .checks
            .iter()
            .zip(&found)
            .all(|(claimed, found)| claimed.name == found.name);
    let recheck = ValencesRecheck {
        intact: certificate.digest == certificate.computed_digest() && certificate.is_text(text)? && in_order,
        differences: Statement::ALL.into_iter().filter(differs).collect(),
    };
    Ok((certificate, recheck))
}

#[cfg(test)]
mod tests;
