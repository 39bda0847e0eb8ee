//! Proofs for every value of a parameter of a scheme file.
//!
//! The range is cut into [`Tile`]s. On a tile the formulas are evaluated in intervals
//! ([`Input::TomlRange`]), and the checks of single schemes run on these enclosures: what they prove holds
//! at each value in the tile, what they refute fails at each. That rows sum to 1, which no enclosure shows,
//! is an identity of the formulas
//! ([`UserScheme::is_affine_in`](eigenring_scheme::user::UserScheme::is_affine_in)). Enclosures widen with
//! the tile, so tiles are halved until what is required is decided.
//!
//! Equalities of eigenvalues (`mu = lambda^2`) are open on a range; at a single value they may be proven.

use crate::document::{Document, tool};
use crate::{Check, Error, Evidence, Input, Requirement, Status, Witness, certify, check};
use eigenring_scheme::Number;
use serde::{Deserialize, Serialize};

/// The format that this version reads and writes.
pub const PARAMETER_VERSION: u32 = 1;

/// A part of the range and what is known of the schemes in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tile {
    /// Its ends, numbers as text.
    pub ends: [String; 2],
    /// What was found.
    pub evidence: Evidence,
    /// What is claimed.
    pub checks: Vec<Check>,
}

/// What is known of a scheme file over a range of a parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ParameterCertificate {
    /// Version of the format, [`PARAMETER_VERSION`].
    pub version: u32,
    /// Version of the tool.
    pub tool: String,
    /// The file, over the whole range.
    pub input: Input,
    /// The valence.
    pub valence: usize,
    /// The tiles, which cover the range, in order.
    pub tiles: Vec<Tile>,
    /// FNV-1a hash of everything else.
    pub digest: String,
}

/// A maximal range with one status.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stretch {
    /// Its ends, numbers as text.
    pub ends: [String; 2],
    /// The status of all of it.
    pub status: Status,
    /// Refuted: why, on the first tile of it.
    pub witness: Option<Witness>,
}

/// When to give up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// How often tiles are halved.
    pub halvings: u32,
    /// The most tiles.
    pub tiles: usize,
}

impl Default for Limits {
    /// Empirical: tiles of a hundredth of the range decide margins of a percent; where a status changes
    /// inside, the place is known to 1/4096 of the range.
    fn default() -> Self {
        Limits {
            halvings: 12,
            tiles: 1000,
        }
    }
}

/// Document and input of a range have a parameter.
fn range(input: &Input) -> Result<(&String, [Number; 2]), Error> {
    match input {
        Input::TomlRange { parameter, ends, .. } => {
            let [first, last] = [ends[0].parse::<Number>()?, ends[1].parse::<Number>()?];
            if first.rational() < last.rational() {
                return Ok((parameter, [first, last]));
            }
            Err(Error::ParameterRange { ends: ends.clone() })
        }
        _ => Err(Error::ParameterRange {
            ends: [String::new(), String::new()],
        }),
    }
}

/// The input of a part of the range.
fn part(input: &Input, [first, last]: [&Number; 2]) -> Input {
    let mut part = input.clone();
    if let Input::TomlRange { ends, .. } = &mut part {
        *ends = [first.to_string(), last.to_string()];
    }
    part
}

/// Proves or refutes what is required of a scheme file, as far as it can, on a range of a parameter: an
/// [`Input::TomlRange`].
///
/// # Errors
/// Those of the file; [`Error::ParameterRange`] for another input, or an empty range.
pub fn prove(
    input: Input,
    valence: usize,
    required: Requirement,
    limits: Limits,
) -> Result<ParameterCertificate, Error> {
    let (_, [first, last]) = range(&input)?;
    // mistakes are those of the whole
    input.subject(valence)?;
    let mut waiting = vec![(first, last, limits.halvings)];
    let mut tiles = Vec::new();
    while let Some((first, last, halvings)) = waiting.pop() {
        let found = certify(part(&input, [&first, &last]), valence)?;
        let (_, status) = required.verdict(&found.checks);
        let decided = matches!(status, Status::Proven | Status::Refuted);
        if !decided && halvings > 0 && tiles.len() + waiting.len() < limits.tiles {
            let [_, middle, _]: [Number; 3] = first.steps_to(&last, 2).try_into().unwrap_or_else(|_| {
                // two steps have three ends
                [first.clone(), first.clone(), last.clone()]
            });
            waiting.push((middle.clone(), last, halvings - 1));
            waiting.push((first, middle, halvings - 1));
            continue;
        }
        tiles.push(Tile {
            ends: [first.to_string(), last.to_string()],
            evidence: found.evidence,
            checks: found.checks,
        });
    }
    let certificate = ParameterCertificate {
        version: PARAMETER_VERSION,
        tool: tool(),
        input,
        valence,
        tiles,
        digest: String::new(),
    };
    Ok(certificate.signed())
}

impl Document for ParameterCertificate {
    const VERSION: u32 = PARAMETER_VERSION;

    fn digest(&mut self) -> &mut String {
        &mut self.digest
    }
}

impl ParameterCertificate {
    /// The certificate as JSON on one line.
    ///
    /// # Errors
    /// [`Error::Syntax`] if a number is not finite, which no certificate of this crate has.
    pub fn to_line(&self) -> Result<String, Error> {
        self.on_one_line()
    }

    /// Reads a certificate; its digest is looked at by [`recheck_parameter_text`].
    ///
    /// # Errors
    /// [`Error::Version`] or [`Error::Syntax`].
    pub fn from_json(text: &str) -> Result<Self, Error> {
        Self::read(text)
    }

    /// The parameter and the ends of its range; `None` for an input that has none.
    pub fn parameter(&self) -> Option<(&str, &[String; 2])> {
        match &self.input {
            Input::TomlRange { parameter, ends, .. } => Some((parameter, ends)),
            _ => None,
        }
    }

    /// The maximal ranges on which a requirement has one status.
    pub fn required(&self, required: Requirement) -> Vec<Stretch> {
        let mut found: Vec<Stretch> = Vec::new();
        for tile in &self.tiles {
            let (_, status) = required.verdict(&tile.checks);
            match found.last_mut() {
                Some(last) if last.status == status => last.ends[1].clone_from(&tile.ends[1]),
                _ => {
                    let mut checks = tile.checks.iter();
                    let refuted = checks
                        .find(|check| check.status == Status::Refuted && required.statements().contains(&check.name));
                    found.push(Stretch {
                        ends: tile.ends.clone(),
                        status,
                        witness: refuted
                            .filter(|_| status == Status::Refuted)
                            .and_then(|check| check.witness.clone()),
                    });
                }
            }
        }
        found
    }
}

/// What checking a stored certificate again has shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Recheck {
    /// Whether text and digest are what is written for the certificate.
    pub intact: bool,
    /// Whether the tiles cover the range.
    pub covered: bool,
    /// The tiles whose checks say something else.
    pub different: Vec<[String; 2]>,
}

/// Runs the checks of a stored certificate again, with its evidence alone.
///
/// # Errors
/// Those of reading it, and of its file.
pub fn recheck_parameter_text(text: &str) -> Result<(ParameterCertificate, Recheck), Error> {
    let certificate = ParameterCertificate::from_json(text)?;
    let (_, ends) = range(&certificate.input)?;
    let mut at = ends[0].clone();
    let (mut covered, mut different) = (true, Vec::new());
    for tile in &certificate.tiles {
        let [first, last] = [tile.ends[0].parse::<Number>()?, tile.ends[1].parse::<Number>()?];
        covered &= first == at && first.rational() < last.rational();
        let found = check(
            &part(&certificate.input, [&first, &last]),
            certificate.valence,
            &tile.evidence,
        )?;
        if found != tile.checks {
            different.push(tile.ends.clone());
        }
        at = last;
    }
    covered &= at == ends[1];
    let intact = certificate.is_text(text)? && certificate.digest == certificate.computed_digest();
    let found = Recheck {
        intact,
        covered,
        different,
    };
    Ok((certificate, found))
}
