//! Checking a stored certificate again.

use crate::certificate::check_subject;
use crate::document::Document;
use crate::{Certificate, Check, Error, Evidence, Statement, Status};
use serde::Serialize;

/// What checking a stored certificate again has shown.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Recheck {
    /// Whether the digest is that of the content.
    pub intact: bool,
    /// What the checks say now.
    pub checks: Vec<Check>,
    /// Claims that the checks do not confirm, and other things in which the certificate is not what they
    /// would make.
    pub differences: Vec<Difference>,
}

/// Something that was not confirmed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// What it is about: a statement, or `degree`, `balanced`, `checks`, `text`.
    pub name: String,
    /// What the certificate says, if it is about a statement.
    pub claimed: Option<Status>,
    /// What the checks say.
    pub found: Option<Status>,
    /// What differs: the status, or a number or sentence beside it.
    pub what: String,
}

impl Difference {
    fn about(name: &str, what: impl Into<String>) -> Self {
        Difference {
            name: name.to_owned(),
            claimed: None,
            found: None,
            what: what.into(),
        }
    }
}

impl Recheck {
    /// Whether the certificate is unchanged and everything it claims was confirmed.
    pub fn confirmed(&self) -> bool {
        self.intact && self.differences.is_empty()
    }
}

/// Checks the text of a stored certificate again: its scheme and its evidence, with the checks alone. The
/// text must be exactly what is written for the certificate that it holds, so that nothing is in it that was
/// not looked at.
///
/// # Errors
/// Those of reading it, and of the input.
pub fn recheck_text(text: &str) -> Result<(Certificate, Recheck), Error> {
    let certificate = Certificate::from_json(text)?;
    let mut found = recheck(&certificate)?;
    if !certificate.is_text(text)? {
        let what = "the text is not what is written for the certificate that it holds";
        found.differences.push(Difference::about("text", what));
    }
    Ok((certificate, found))
}

/// Checks a certificate again: its scheme and its evidence, with the checks alone.
///
/// # Errors
/// Those of the input.
pub fn recheck(certificate: &Certificate) -> Result<Recheck, Error> {
    let subject = certificate.input.subject(certificate.valence)?;
    let checks = check_subject(&subject, &certificate.evidence)?;
    let named = |list: &[Check], statement: Statement| list.iter().find(|check| check.name == statement).cloned();
    let mut differences = Vec::new();
    for statement in Statement::ALL {
        let (claimed, found) = (named(&certificate.checks, statement), named(&checks, statement));
        if claimed == found {
            continue;
        }
        let status = |check: &Option<Check>| check.as_ref().map(|check| check.status);
        let what = if status(&claimed) == status(&found) {
            "details"
        } else {
            "status"
        };
        differences.push(Difference {
            name: statement.name().to_owned(),
            claimed: status(&claimed),
            found: status(&found),
            what: what.to_owned(),
        });
    }
    if differences.is_empty() && certificate.checks != checks {
        let what = "a statement occurs twice, or they are in another order";
        differences.push(Difference::about("checks", what));
    }
    let made = Certificate::new(certificate.input.clone(), &subject, Evidence::default(), Vec::new());
    if certificate.degree != made.degree {
        differences.push(Difference::about("degree", "not that of the rules"));
    }
    if certificate.balanced != made.balanced {
        differences.push(Difference::about("balanced", "not what is balanced"));
    }
    Ok(Recheck {
        intact: certificate.digest == certificate.content_digest(),
        checks,
        differences,
    })
}
