//! Stored certificates of schemes with knot intervals.
//!
//! Of HNUSS at given intervals, or at every valence for all positive intervals. The evidence are the
//! Bernstein coefficients of Lemma 3, which anyone can compare with their own; none of it is believed: a
//! certificate is checked again by computing all of it anew from the rules, in the same exact arithmetic.

use super::verify::{Check, Report, Required};
use crate::error::{Accepted, Error};
use crate::results::tool;
use eigenring_certify::{Document, Status};
use eigenring_nonuniform::{Scheme, Spokes, lemmas};
use serde::{Deserialize, Serialize};

/// A certificate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// Version of the format.
    pub version: u32,
    /// Version of the tool.
    pub tool: String,
    /// The scheme, by its name.
    pub scheme: String,
    /// The intervals; none for every valence and all positive intervals.
    pub knots: Option<Knots>,
    /// Of Lemma 3 on three patches, if the scheme is HNUSS.
    pub bernstein: Vec<Coefficients>,
    /// What is claimed.
    pub checks: Vec<Claim>,
    /// FNV-1a hash of everything else.
    pub digest: String,
}

/// Knot intervals around a vertex.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Knots {
    /// Of the first edge of each spoke.
    pub intervals: Vec<f64>,
    /// Of all further ones.
    pub next: Vec<f64>,
}

/// The Bernstein coefficients of the Jacobians J_vw, J_pw and J_vp of a patch, as fractions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coefficients {
    /// The cell of the patch, steps along both spokes.
    pub cell: [usize; 2],
    /// 36 of each.
    pub jacobians: [Vec<String>; 3],
}

/// A statement and what is known of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// Which statement.
    pub name: String,
    /// How much is known.
    pub status: Status,
    /// As in [`Check`].
    pub margin: Option<f64>,
    /// As in [`Check`].
    pub enclosure: Option<[f64; 2]>,
}

impl From<&Check> for Claim {
    fn from(check: &Check) -> Self {
        Claim {
            name: check.name.to_owned(),
            status: check.status,
            margin: check.margin,
            enclosure: check.enclosure,
        }
    }
}

impl Document for Certificate {
    const VERSION: u32 = 1;

    fn digest(&mut self) -> &mut String {
        &mut self.digest
    }
}

/// The evidence for a scheme.
fn bernstein(scheme: Scheme) -> Vec<Coefficients> {
    if !matches!(scheme, Scheme::Hnuss(_)) {
        return Vec::new();
    }
    let patches = lemmas::patches().into_iter();
    let coefficients = |patch: lemmas::Patch| Coefficients {
        cell: patch.cell,
        jacobians: patch
            .jacobians
            .map(|list| list.iter().map(ToString::to_string).collect()),
    };
    patches.map(coefficients).collect()
}

impl Certificate {
    /// The certificate of a report.
    pub fn of(report: &Report) -> Self {
        let certificate = Certificate {
            version: Certificate::VERSION,
            tool: tool(),
            scheme: report.scheme().to_string(),
            knots: report.spokes().map(|spokes| Knots {
                intervals: spokes.intervals().to_vec(),
                next: spokes.next().to_vec(),
            }),
            bernstein: bernstein(report.scheme()),
            checks: report.checks().iter().map(Claim::from).collect(),
            digest: String::new(),
        };
        certificate.signed()
    }

    /// Whether a text is one of these.
    pub fn is_of_this_kind(value: &serde_json::Value) -> bool {
        value.get("bernstein").is_some()
    }

    /// Reads a certificate, whatever its digest says.
    ///
    /// # Errors
    /// Those of its form.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        Ok(Certificate::read(text)?)
    }

    /// As JSON, indented.
    ///
    /// # Errors
    /// None for what was read or made.
    pub fn to_json(&self) -> Result<String, Error> {
        Ok(self.written()?)
    }

    /// The valence, if it is about one.
    pub fn valence(&self) -> Option<usize> {
        self.knots.as_ref().map(|knots| knots.intervals.len())
    }

    /// What it is about.
    pub fn what(&self) -> String {
        let list = |list: &[f64]| list.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        match &self.knots {
            Some(knots) => format!("{}, knots {}", self.scheme, list(&knots.intervals)),
            None => format!("{}, all valences and positive knots", self.scheme),
        }
    }

    /// What is known of what it is about, computed anew; at most at a valence.
    ///
    /// # Errors
    /// A scheme that is none of these, intervals for which there is none, larger valences.
    pub fn report(&self, most: usize, required: Required) -> Result<Report, Error> {
        let scheme: Scheme = self.scheme.parse()?;
        match &self.knots {
            None => Report::for_all(scheme, required),
            Some(knots) if knots.intervals.len() > most => Err(Error::refused(
                format!("valence {} is out of range", knots.intervals.len()),
                Accepted::Is(format!("3 to {most}")),
            )),
            Some(knots) => {
                let spokes = Spokes::new(knots.intervals.clone(), knots.next.clone())?;
                Report::new(scheme, spokes, required)
            }
        }
    }

    /// Whether it is unchanged since it was written, and what is not confirmed of it: everything is computed
    /// anew.
    ///
    /// # Errors
    /// A scheme that is none of these, intervals for which there is none.
    pub fn recheck(&self, text: &str) -> Result<(bool, Vec<String>), Error> {
        // what is required selects among the statements and alters none
        let report = self.report(usize::MAX, Required::C1)?;
        let scheme = report.scheme();
        let found: Vec<Claim> = report.checks().iter().map(Claim::from).collect();
        let mut remarks = Vec::new();
        let names = |list: &[Claim]| list.iter().map(|claim| claim.name.clone()).collect::<Vec<_>>();
        if names(&found) != names(&self.checks) {
            remarks.push("other statements than those that are made".to_owned());
        }
        for (claimed, found) in self.checks.iter().zip(&found) {
            if claimed.status != found.status {
                let (claimed, name, found) = (claimed.status, &claimed.name, found.status);
                remarks.push(format!("{name}: claimed {claimed}, found {found}"));
            } else if claimed != found {
                remarks.push(format!("{}: other numbers", claimed.name));
            }
        }
        if self.bernstein != bernstein(scheme) {
            remarks.push("regular: other Bernstein coefficients".to_owned());
        }
        if !self.is_text(text)? {
            remarks.push("the text is not what is written for the certificate that it holds".to_owned());
        }
        Ok((self.digest == self.computed_digest(), remarks))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn confirmed(text: &str) -> Result<bool, Error> {
        let (intact, remarks) = Certificate::from_json(text)?.recheck(text)?;
        Ok(intact && remarks.is_empty())
    }

    /// What is claimed beyond what holds is found, with the digest of the changed text too.
    #[test]
    fn a_changed_certificate_is_not_confirmed() {
        let spokes = Spokes::stationary(vec![1.0, 3.0, 2.0, 0.5, 1.0]).unwrap();
        let hnuss: Scheme = "hnuss:simple".parse().unwrap();
        let of_one = Certificate::of(&Report::new(hnuss, spokes.clone(), Required::C1).unwrap());
        let of_all = Certificate::of(&Report::for_all(hnuss, Required::C1).unwrap());
        let nurss = Certificate::of(&Report::new("nurss".parse().unwrap(), spokes, Required::C1).unwrap());
        for certificate in [&of_one, &of_all, &nurss] {
            assert!(confirmed(&certificate.to_json().unwrap()).unwrap(), "{certificate:?}");
        }
        type Fault<'a> = (&'a Certificate, &'a dyn Fn(&mut Certificate));
        let undecided = |claim: &mut Claim| claim.status = Status::Proven;
        let faults: [Fault; 6] = [
            (&nurss, &|c| c.checks.iter_mut().for_each(undecided)),
            (&of_one, &|c| c.checks.truncate(2)),
            (&of_one, &|c| c.checks[1].margin = Some(0.4)),
            (&of_all, &|c| c.bernstein[1].jacobians[0][3] = "1/2".to_owned()),
            (&of_all, &|c| c.bernstein.clear()),
            (&of_one, &|c| c.knots.as_mut().unwrap().intervals[1] = 0.0),
        ];
        for (index, (certificate, fault)) in faults.into_iter().enumerate() {
            let mut wrong = certificate.clone();
            fault(&mut wrong);
            assert!(!confirmed(&wrong.to_json().unwrap()).unwrap(), "fault {index}");
            assert!(
                !confirmed(&wrong.signed().to_json().unwrap()).unwrap(),
                "signed fault {index}"
            );
        }
        let text = of_all.to_json().unwrap();
        assert!(!confirmed(&text.replacen("  ", "   ", 1)).unwrap());
        assert!(confirmed(&text.replace("hnuss:simple", "hnuss:other")).is_err());
        assert!(Certificate::from_json(&text.replacen("\"tool\"", "\"more\": 1, \"tool\"", 1)).is_err());
    }
}
