//! Proofs for a continuous range of lambda.
//!
//! The lambda-scheme with f2 and f3 as splines of lambda is a curve of schemes. To prove a statement for
//! every lambda of a range, the range is covered by intervals ([`Tile`]s), and each statement is checked for
//! a whole interval at once, with [`Centred`] numbers in place of doubles: closed forms, second-order slopes,
//! Bernstein coefficients. Overestimation falls with the square of the width, so that a relative margin of
//! 1e-6 needs intervals of about its root, some hundred in all.
//!
//! * **Knots** of the splines are ends of tiles: on a tile the splines are polynomials.
//! * **The relaxation** s(lambda) has kinks at irrational places. On a tile that cannot exclude one, every
//!   branch of the formula that may hold there is checked on the whole tile ([`stencil_box::branches`]).
//! * **A zero is an exact zero**: where all coefficients of f3 on a span are zero, f3 is, and so is what it
//!   multiplies.
//!
//! Three groups of statements have coverings of their own: eigenvalues for C1 (`subdominant`, with `dominant`
//! in it), eigenvalues for curvature (`bounded_curvature`, `strict`), and the characteristic map (`regular`,
//! `injective`). The search ([`prove_range`]) bisects until a tile is decided; the check ([`recheck_range`])
//! verifies that the tiles cover the range and decides each again.

mod conditions;
mod net;
pub mod stencil_box;

use crate::document::{Document, tool};
use crate::map::{self, JacobianEvidence, WindingEvidence};
use crate::{Centred, Error, Interval, Requirement, Statement, Status, Witness};
use eigenring_scheme::lambda::{LambdaEntry, LambdaKnots, LambdaTable, Relaxation};
use eigenring_spline::{Knots, Scalar, Spline};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use stencil_box::StencilBox;

/// The format that this version reads and writes.
pub const RANGE_VERSION: u32 = 1;

/// f2 and f3 as functions of lambda.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum StencilCurve {
    /// Cubic splines with the given knots; f3 is ignored at valence 4, where it is mu.
    Splines {
        /// The knots.
        knots: LambdaKnots,
        /// Coefficients of f2.
        f2: Vec<f64>,
        /// Coefficients of f3.
        f3: Vec<f64>,
    },
    /// Constants; f3 is ignored at valence 4, where it is mu.
    Constant {
        /// f2.
        f2: f64,
        /// f3.
        f3: f64,
    },
}

impl StencilCurve {
    /// The embedded splines of a valence.
    ///
    /// # Errors
    /// A valence that is not tabulated.
    pub fn embedded(valence: usize) -> Result<Self, Error> {
        Ok(StencilCurve::of(LambdaTable::embedded()?.entry(valence)?))
    }

    /// The splines of an entry.
    pub fn of(entry: &LambdaEntry) -> Self {
        StencilCurve::Splines {
            knots: entry.knots,
            f2: entry.f2.clone(),
            f3: entry.f3.clone(),
        }
    }
}

/// A group of statements with one covering.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Group {
    /// `dominant` and `subdominant`.
    Subdominant,
    /// `bounded_curvature` and `strict`.
    SecondOrder,
    /// `regular` and `injective`.
    Map,
}

impl Group {
    /// All of them.
    pub const ALL: [Group; 3] = [Group::Subdominant, Group::SecondOrder, Group::Map];

    /// The statements.
    pub fn statements(self) -> &'static [Statement] {
        match self {
            Group::Subdominant => &[Statement::Dominant, Statement::Subdominant],
            Group::SecondOrder => &[Statement::BoundedCurvature, Statement::Strict],
            Group::Map => &[Statement::Regular, Statement::Injective],
        }
    }
}

/// An interval of lambda and what is said of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tile {
    /// Its ends.
    pub lambda: [f64; 2],
    /// The status of each statement of the group.
    pub statuses: Vec<Status>,
    /// Evidence for the map, one for each branch of s that may hold.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub evidence: Vec<(JacobianEvidence, WindingEvidence)>,
}

/// What is known of a curve of schemes over a range of lambda.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RangeCertificate {
    /// Version of the format, [`RANGE_VERSION`].
    pub version: u32,
    /// Version of the tool.
    pub tool: String,
    /// The valence.
    pub valence: usize,
    /// The curve of schemes; s follows the relaxation rule.
    pub curve: StencilCurve,
    /// The range.
    pub lambda: [f64; 2],
    /// For each group the tiles that cover the range, in order.
    pub tiles: BTreeMap<Group, Vec<Tile>>,
    /// FNV-1a hash of everything else.
    pub digest: String,
}

/// A maximal interval of lambda with one status.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Segment {
    /// Its ends.
    pub lambda: [f64; 2],
    /// The status on all of it.
    pub status: Status,
    /// Refuted: a lambda at which it fails, and why.
    pub witness: Option<Witness>,
}

/// When to give up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Tiles are not cut below this width.
    pub width: f64,
    /// The most tiles of a group.
    pub tiles: usize,
}

impl Default for Limits {
    /// Empirical: a margin of 1e-6 is decided on tiles of 1e-3 or wider, and the ends of a decided range are
    /// then known to six digits. Groups that need more tiles have a quantity that vanishes on an interval.
    fn default() -> Self {
        Limits {
            width: 1e-7,
            tiles: 4000,
        }
    }
}

/// The curve made ready: spline spaces and relaxation.
pub(crate) struct Problem {
    valence: usize,
    relaxation: Relaxation,
    curve: StencilCurve,
    knots: Option<Knots>,
}

impl Problem {
    fn new(valence: usize, curve: &StencilCurve, [start, end]: [f64; 2]) -> Result<Self, Error> {
        let relaxation = Relaxation::new(valence)?;
        let knots = match curve {
            StencilCurve::Splines { knots, f2, f3 } => {
                let space = knots.knots()?;
                // the right number of finite coefficients
                Spline::new(space.clone(), f2.clone())?;
                Spline::new(space.clone(), f3.clone())?;
                Some(space)
            }
            StencilCurve::Constant { f2, f3 } => {
                for (what, value) in [("f2", *f2), ("f3", *f3)] {
                    if !value.is_finite() {
                        return Err(Error::NotFinite { what, value });
                    }
                }
                if *f2 == 0.0 {
                    return Err(Error::EdgeWeight);
                }
                None
            }
        };
        let (lower, upper) = knots
            .as_ref()
            .map_or((0.125_f64.next_up(), 1.0_f64.next_down()), Knots::domain);
        if !(lower <= start && start < end && end <= upper) {
            return Err(Error::Range {
                start,
                end,
                lower,
                upper,
            });
        }
        Ok(Problem {
            valence,
            relaxation,
            curve: curve.clone(),
            knots,
        })
    }

    /// f2 and f3 on a tile; `None` if a knot lies inside it. f3 is `None` at valence 4.
    fn weights<S: Scalar + Copy>(&self, [start, end]: [f64; 2], lambda: S) -> Option<(S, Option<S>)> {
        let (f2, f3) = match (&self.curve, &self.knots) {
            (StencilCurve::Splines { f2, f3, .. }, Some(knots)) => {
                let span = knots.span(start)?;
                if knots.values()[span + 1] < end {
                    return None;
                }
                let basis = knots.basis(span, lambda);
                (basis.combine(&basis.values, f2), basis.combine(&basis.values, f3))
            }
            (StencilCurve::Constant { f2, f3 }, _) => (S::exact(*f2), S::exact(*f3)),
            _ => return None,
        };
        Some((f2, (self.valence != 4).then_some(f3)))
    }

    /// The statuses of a group on a tile. With `evidence` for the map, which is not looked at otherwise.
    fn decide(&self, group: Group, lambda: [f64; 2], evidence: &[(JacobianEvidence, WindingEvidence)]) -> Vec<Status> {
        let undecided = vec![Status::Undecided; group.statements().len()];
        let Some(points) = stencil_box::points(self, lambda) else {
            return undecided;
        };
        let mut found: Option<Vec<Status>> = None;
        for (position, point) in points.iter().enumerate() {
            let next = match group {
                // a closed form that may divide by zero gives no scheme to speak of
                _ if !point.is_bounded() => undecided.clone(),
                Group::Subdominant => conditions::subdominant(point),
                Group::SecondOrder => conditions::second_order(point),
                Group::Map => match (net::characteristic(point), evidence.get(position)) {
                    (Some(net), Some((jacobian, winding))) => map_statuses(&net, jacobian, winding),
                    _ => undecided.clone(),
                },
            };
            // a statement must have one status on every branch that may hold
            found = Some(match found {
                None => next,
                Some(found) => found
                    .into_iter()
                    .zip(next)
                    .map(|(a, b)| if a == b { a } else { Status::Undecided })
                    .collect(),
            });
        }
        found.unwrap_or(undecided)
    }

    /// Evidence for the map on a tile.
    fn search(&self, lambda: [f64; 2]) -> Vec<(JacobianEvidence, WindingEvidence)> {
        let limits = map::find::Limits {
            depth: 2,
            ..map::find::Limits::default()
        };
        let points = stencil_box::points(self, lambda).unwrap_or_default();
        let nets: Option<Vec<_>> = points.iter().map(net::characteristic).collect();
        let found = nets.unwrap_or_default();
        let evidence = found
            .iter()
            .map(|net| (map::find::jacobian(net, limits), map::find::boundary(net, limits)));
        evidence.collect()
    }
}

fn map_statuses(
    net: &map::PlaneNet<Centred<1>>,
    jacobian: &JacobianEvidence,
    winding: &WindingEvidence,
) -> Vec<Status> {
    let regular = map::regular(net, jacobian).status;
    let injective = match map::winding(net, winding).status {
        // the winding number decides for regular maps
        Status::Proven if regular != Status::Proven => Status::Undecided,
        status => status,
    };
    vec![regular, injective]
}

/// Proves what it can of a curve of schemes over a range.
///
/// # Errors
/// Those of the curve; [`Error::Range`].
pub fn prove_range(
    valence: usize,
    curve: StencilCurve,
    lambda: [f64; 2],
    limits: Limits,
) -> Result<RangeCertificate, Error> {
    let problem = Problem::new(valence, &curve, lambda)?;
    let tiles = Group::ALL.map(|group| (group, cover(&problem, group, lambda, limits)));
    let certificate = RangeCertificate {
        version: RANGE_VERSION,
        tool: tool(),
        valence,
        curve,
        lambda,
        tiles: tiles.into(),
        digest: String::new(),
    };
    Ok(certificate.signed())
}

/// Bisects until every tile is decided, or as small as the limits say.
fn cover(problem: &Problem, group: Group, [start, end]: [f64; 2], limits: Limits) -> Vec<Tile> {
    let inside = |x: &f64| start < *x && *x < end;
    let mut cuts: Vec<f64> = problem
        .knots
        .as_ref()
        .map_or(Vec::new(), |knots| knots.values().to_vec());
    cuts.extend(problem.relaxation.kinks());
    cuts.retain(inside);
    cuts.extend([start, end]);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    let mut waiting: Vec<[f64; 2]> = cuts.windows(2).map(|pair| [pair[0], pair[1]]).rev().collect();
    let mut tiles = Vec::new();
    while let Some(lambda) = waiting.pop() {
        let evidence = if group == Group::Map {
            problem.search(lambda)
        } else {
            Vec::new()
        };
        let statuses = problem.decide(group, lambda, &evidence);
        let middle = lambda[0] + (lambda[1] - lambda[0]) / 2.0;
        let room = tiles.len() + waiting.len() < limits.tiles && lambda[1] - lambda[0] > limits.width;
        if statuses.contains(&Status::Undecided) && room && lambda[0] < middle && middle < lambda[1] {
            waiting.push([middle, lambda[1]]);
            waiting.push([lambda[0], middle]);
        } else {
            tiles.push(Tile {
                lambda,
                statuses,
                evidence,
            });
        }
    }
    tiles
}

impl Document for RangeCertificate {
    const VERSION: u32 = RANGE_VERSION;

    fn digest(&mut self) -> &mut String {
        &mut self.digest
    }
}

impl RangeCertificate {
    /// The digest of everything but the digest.
    pub fn content_digest(&self) -> String {
        self.computed_digest()
    }

    /// The certificate as indented JSON.
    ///
    /// # Errors
    /// [`Error::Syntax`] if a number is not finite, which no certificate of this crate has.
    pub fn to_json(&self) -> Result<String, Error> {
        self.written()
    }

    /// The certificate as JSON on one line, a third as long.
    ///
    /// # Errors
    /// As [`RangeCertificate::to_json`].
    pub fn to_line(&self) -> Result<String, Error> {
        self.on_one_line()
    }

    /// Reads a certificate; its digest is looked at by [`recheck_range`].
    ///
    /// # Errors
    /// [`Error::Version`] or [`Error::Syntax`].
    pub fn from_json(text: &str) -> Result<Self, Error> {
        RangeCertificate::read(text)
    }

    /// The maximal intervals on which a statement has one status; empty for a statement without tiles.
    pub fn segments(&self, statement: Statement) -> Vec<Segment> {
        if statement == Statement::RowSums {
            return self.row_sums();
        }
        for (group, tiles) in &self.tiles {
            if let Some(position) = group.statements().iter().position(|name| *name == statement) {
                let pieces = tiles
                    .iter()
                    .filter_map(|tile| Some((tile.lambda, *tile.statuses.get(position)?)));
                return self.merged(pieces, &[statement]);
            }
        }
        Vec::new()
    }

    /// Rows sum to 1 by construction, wherever the closed forms have a value.
    fn row_sums(&self) -> Vec<Segment> {
        let problem = Problem::new(self.valence, &self.curve, self.lambda).ok();
        let tiles = self.tiles.get(&Group::Subdominant).map_or(&[][..], Vec::as_slice);
        let pieces = tiles.iter().map(|tile| {
            let points = problem
                .as_ref()
                .and_then(|problem| stencil_box::points(problem, tile.lambda));
            let bounded = points.is_some_and(|points| points.iter().all(StencilBox::is_bounded));
            let status = if bounded { Status::Proven } else { Status::Undecided };
            (tile.lambda, status)
        });
        self.merged(pieces, &[Statement::RowSums])
    }

    /// The maximal intervals on which all statements of a requirement have one status together. What refutes
    /// a statement about the pair of lambda refutes the requirement only where that pair is proven to be
    /// subdominant.
    pub fn required(&self, requirement: Requirement) -> Vec<Segment> {
        // the levels of the lambda-scheme are all alike
        let statements = requirement
            .statements()
            .iter()
            .filter(|statement| **statement != Statement::Levels);
        let statements: Vec<Statement> = statements.copied().collect();
        let lists: Vec<Vec<Segment>> = statements.iter().map(|&statement| self.segments(statement)).collect();
        let subdominant = self.segments(Statement::Subdominant);
        let mut ends: Vec<f64> = lists.iter().flatten().flat_map(|segment| segment.lambda).collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let at = |list: &[Segment], lambda: [f64; 2]| {
            let covering = list
                .iter()
                .find(|s| s.lambda[0] <= lambda[0] && lambda[1] <= s.lambda[1]);
            covering.map_or(Status::Undecided, |s| s.status)
        };
        let status = |lambda: [f64; 2]| {
            let pair = at(&subdominant, lambda) == Status::Proven;
            let statuses = lists.iter().map(|list| match at(list, lambda) {
                Status::Refuted if !pair => Status::Undecided,
                status => status,
            });
            statuses.fold(Status::Proven, Status::and)
        };
        let pieces = ends
            .windows(2)
            .map(|pair| ([pair[0], pair[1]], status([pair[0], pair[1]])));
        self.merged(pieces, &statements)
    }

    fn merged(&self, pieces: impl Iterator<Item = ([f64; 2], Status)>, statements: &[Statement]) -> Vec<Segment> {
        let mut segments: Vec<Segment> = Vec::new();
        for (lambda, status) in pieces {
            match segments.last_mut() {
                Some(last) if last.status == status => last.lambda[1] = lambda[1],
                _ => segments.push(Segment {
                    lambda,
                    status,
                    witness: None,
                }),
            }
        }
        for segment in segments.iter_mut().filter(|segment| segment.status == Status::Refuted) {
            segment.witness = self.witness(segment.lambda, statements);
        }
        segments
    }

    /// A lambda inside, with the statement that is refuted there.
    fn witness(&self, [start, end]: [f64; 2], statements: &[Statement]) -> Option<Witness> {
        let lambda = start + (end - start) / 2.0;
        let problem = Problem::new(self.valence, &self.curve, self.lambda).ok()?;
        let points = stencil_box::points(&problem, [lambda, lambda])?;
        let point = points.first()?;
        let refuted = statements.iter().find(|&&statement| {
            Group::ALL.iter().any(|group| {
                let position = group.statements().iter().position(|name| *name == statement);
                let tiles = self.tiles.get(group).map_or(&[][..], Vec::as_slice);
                let tile = tiles
                    .iter()
                    .find(|tile| tile.lambda[0] <= lambda && lambda <= tile.lambda[1]);
                let status = tile
                    .zip(position)
                    .and_then(|(tile, position)| tile.statuses.get(position));
                status == Some(&Status::Refuted)
            })
        });
        let what = refuted.map_or("a statement", |statement| statement.name());
        let text = format!("{what} fails at lambda = {lambda}");
        let witness = Witness::new(text).with("lambda", Interval::point(lambda));
        Some(conditions::describe(point, witness))
    }
}

/// What checking a range certificate again has shown.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RangeRecheck {
    /// Whether the digest is that of the content, and the text what is written for it.
    pub intact: bool,
    /// Whether the tiles of every group cover the range without gaps.
    pub covered: bool,
    /// Tiles of which something else is true than claimed.
    pub differences: Vec<(Group, [f64; 2])>,
}

impl RangeRecheck {
    /// Whether the certificate is unchanged and everything it claims was confirmed.
    pub fn confirmed(&self) -> bool {
        self.intact && self.covered && self.differences.is_empty()
    }
}

/// Checks the text of a stored certificate again; it must be exactly what is written for the certificate that
/// it holds.
///
/// # Errors
/// Those of reading it; of the curve; [`Error::Range`].
pub fn recheck_range_text(text: &str) -> Result<(RangeCertificate, RangeRecheck), Error> {
    let certificate = RangeCertificate::from_json(text)?;
    let mut found = recheck_range(&certificate)?;
    found.intact &= certificate.is_text(text)?;
    Ok((certificate, found))
}

/// Checks a certificate again, tile by tile, with the checks alone.
///
/// # Errors
/// Those of the curve; [`Error::Range`].
pub fn recheck_range(certificate: &RangeCertificate) -> Result<RangeRecheck, Error> {
    let problem = Problem::new(certificate.valence, &certificate.curve, certificate.lambda)?;
    let [start, end] = certificate.lambda;
    let (mut covered, mut differences) = (true, Vec::new());
    for group in Group::ALL {
        let tiles = certificate.tiles.get(&group).map_or(&[][..], Vec::as_slice);
        let mut reached = start;
        for tile in tiles {
            covered &= tile.lambda[0] == reached && tile.lambda[0] < tile.lambda[1];
            reached = tile.lambda[1];
            if problem.decide(group, tile.lambda, &tile.evidence) != tile.statuses {
                differences.push((group, tile.lambda));
            }
        }
        covered &= reached == end;
    }
    Ok(RangeRecheck {
        intact: certificate.digest == certificate.content_digest(),
        covered,
        differences,
    })
}
