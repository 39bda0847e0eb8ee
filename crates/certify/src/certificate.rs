//! Certificates: making, checking, storing and checking again.
//!
//! A [`Certificate`] says of one exact scheme at one valence what was proven, refuted or left open, and keeps
//! the evidence: the approximate eigenvectors and the subdivisions with which the proofs go through.
//! [`certify`] makes one in two steps that share nothing but the problem: a search ([`find`](crate::find),
//! [`map::find`](crate::map::find)), in doubles, and the checks, in intervals and exact arithmetic.
//! [`recheck`](crate::recheck()) runs the checks alone, on a stored certificate, and compares what they say
//! with what is claimed.
//!
//! The digest in a file shows that it was changed after it was written. It is no protection, and none is
//! needed: every claim is proven anew from the scheme. Someone who changes claim and digest is told that the
//! claim does not hold; someone who changes the scheme has the certificate of another scheme, which says so.

use crate::document::{Document, tool};
use crate::map::{self, CurvatureEvidence, JacobianEvidence, WindingEvidence};
use crate::proof::{Proof, problem};
use crate::{Check, Error, Input, Statement, Subject, find, spectral};
use serde::{Deserialize, Serialize};

/// The format that this version reads and writes.
pub const CERTIFICATE_VERSION: u32 = 2;

/// What is known of a scheme at a valence, and why.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// Version of the format, [`CERTIFICATE_VERSION`].
    pub version: u32,
    /// Version of the tool.
    pub tool: String,
    /// The exact scheme.
    pub input: Input,
    /// The valence.
    pub valence: usize,
    /// The degree of the B-splines that the regular rules were found to refine.
    pub degree: Option<usize>,
    /// How the weights of a file were balanced; absent where nothing was to be balanced.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub balanced: Option<Balanced>,
    /// What was found.
    pub evidence: Evidence,
    /// What is claimed.
    pub checks: Vec<Check>,
    /// FNV-1a hash of everything else.
    pub digest: String,
}

/// Rounded weights that were [balanced](eigenring_scheme::user::Reading).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Balanced {
    /// How many stencils were changed.
    pub rows: usize,
    /// The largest change of a weight.
    pub largest: f64,
}

/// What a search found. None of it is believed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evidence {
    /// For the eigenvalues.
    pub spectrum: spectral::Evidence,
    /// For the Jacobian of the characteristic map.
    pub jacobian: Option<JacobianEvidence>,
    /// For its winding number.
    pub winding: Option<WindingEvidence>,
    /// For the Gauss curvatures of the second-order maps: cup, then saddles.
    pub curvature: Vec<CurvatureEvidence>,
}

/// Makes a certificate.
///
/// # Errors
/// Those of the input; an open question is no error.
pub fn certify(input: Input, valence: usize) -> Result<Certificate, Error> {
    let subject = input.subject(valence)?;
    let mut evidence = Evidence::default();
    let checks = match problem(&subject)? {
        Err(checks) => checks,
        Ok(problem) => {
            evidence.spectrum = find::evidence(&problem.blocks);
            let proof = Proof::new(&subject, problem, &evidence.spectrum)?;
            if let Some(net) = &proof.net {
                let limits = map::find::Limits::default();
                evidence.jacobian = Some(map::find::jacobian(net, limits));
                evidence.winding = Some(map::find::boundary(net, limits));
                for (heights, sign) in &proof.heights {
                    let found = map::find::curvature(net, heights, *sign, limits);
                    evidence.curvature.push(found);
                }
            }
            proof.finish(&evidence)
        }
    };
    Ok(Certificate::new(input, &subject, evidence, checks))
}

/// Runs the checks alone.
///
/// # Errors
/// Those of the input.
pub fn check(input: &Input, valence: usize, evidence: &Evidence) -> Result<Vec<Check>, Error> {
    check_subject(&input.subject(valence)?, evidence)
}

pub(crate) fn check_subject(subject: &Subject, evidence: &Evidence) -> Result<Vec<Check>, Error> {
    match problem(subject)? {
        Err(checks) => Ok(checks),
        Ok(problem) => Ok(Proof::new(subject, problem, &evidence.spectrum)?.finish(evidence)),
    }
}

impl Document for Certificate {
    const VERSION: u32 = CERTIFICATE_VERSION;

    fn digest(&mut self) -> &mut String {
        &mut self.digest
    }
}

impl Certificate {
    pub(crate) fn new(input: Input, subject: &Subject, evidence: Evidence, checks: Vec<Check>) -> Self {
        let balance = subject.balance;
        let certificate = Certificate {
            version: CERTIFICATE_VERSION,
            tool: tool(),
            input,
            valence: subject.scheme.valence(),
            degree: subject.scheme.degree(),
            balanced: (balance.rows > 0).then_some(Balanced {
                rows: balance.rows,
                largest: balance.largest,
            }),
            evidence,
            checks,
            digest: String::new(),
        };
        certificate.signed()
    }

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
    /// As [`Certificate::to_json`].
    pub fn to_line(&self) -> Result<String, Error> {
        self.on_one_line()
    }

    /// Reads a certificate. Its digest is not looked at here: [`recheck`](crate::recheck()) reports it.
    ///
    /// # Errors
    /// [`Error::Version`] or [`Error::Syntax`].
    pub fn from_json(text: &str) -> Result<Self, Error> {
        Certificate::read(text)
    }

    /// What is claimed of a statement.
    pub fn check(&self, statement: Statement) -> Option<&Check> {
        self.checks.iter().find(|check| check.name == statement)
    }
}
