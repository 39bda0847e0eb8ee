//! What is minimised, and under which conditions.

use crate::error::{Accepted, Error};
use eigenring_scheme::{Number, Scheme, did_you_mean};
use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

/// A number that says how good a scheme is at a valence; smaller is better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure {
    /// E with the weight for Gauss curvatures of the wrong sign, as `objective` prints it.
    Weighted,
    /// E without, as `compare` prints it.
    Unweighted,
    /// `|mu / lambda^2 - 1|`.
    Ratio,
    /// `|lambda - target|`.
    Lambda(f64),
    /// `K_m`.
    SignChange,
    /// The modulus of the sixth eigenvalue beside mu: 1 less what `compare` prints as `strict`.
    Strictness,
    /// The smallest weight that is not zero, negated: the margin becomes as large as possible.
    Hull,
    /// The variance of the lengths of edges of the natural configuration, of mean 1.
    Polar,
}

/// The measures as they are written.
const MEASURES: [&str; 8] = [
    "E",
    "E-unweighted",
    "ratio",
    "lambda:TARGET",
    "K_m",
    "strictness",
    "hull",
    "polar",
];

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Measure::Weighted => f.write_str("E"),
            Measure::Unweighted => f.write_str("E-unweighted"),
            Measure::Ratio => f.write_str("ratio"),
            Measure::Lambda(target) => write!(f, "lambda:{target}"),
            Measure::SignChange => f.write_str("K_m"),
            Measure::Strictness => f.write_str("strictness"),
            Measure::Hull => f.write_str("hull"),
            Measure::Polar => f.write_str("polar"),
        }
    }
}

/// A number of a scheme that a caller computes.
pub type OwnFunction = dyn Fn(&Scheme<f64>) -> f64 + Send + Sync;

/// A function of schemes that a program minimises. It must give the same number for the same scheme, and may
/// be called from several threads; a NaN says that it is not defined.
#[derive(Clone)]
pub struct Own {
    /// What it is called in what is written.
    pub name: String,
    /// The function.
    pub value: Arc<OwnFunction>,
}

impl fmt::Debug for Own {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Own").field("name", &self.name).finish_non_exhaustive()
    }
}

impl PartialEq for Own {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name && Arc::ptr_eq(&self.value, &other.value)
    }
}

/// A sum of measures with positive factors, such as `1*E+10*ratio`, and a program's own function.
#[derive(Clone, Debug, PartialEq)]
pub struct Goal {
    /// The factors and what they are of.
    pub terms: Vec<(f64, Measure)>,
    /// What is added.
    pub own: Option<Own>,
}

impl From<Own> for Goal {
    fn from(own: Own) -> Self {
        Goal {
            terms: Vec::new(),
            own: Some(own),
        }
    }
}

impl fmt::Display for Goal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let term = |(factor, measure): &(f64, Measure)| match factor {
            1.0 => measure.to_string(),
            factor => format!("{factor}*{measure}"),
        };
        let own = self.own.iter().map(|own| own.name.clone());
        let terms: Vec<String> = self.terms.iter().map(term).chain(own).collect();
        f.write_str(&terms.join("+"))
    }
}

impl FromStr for Goal {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let refuse = |reason: String| {
            let accepted = format!("{}, or a sum such as 1*E+10*ratio", MEASURES.join(", "));
            Error::refused(reason, Accepted::Are(accepted))
        };
        let term = |text: &str| {
            let (factor, name) = match text.split_once('*') {
                Some((factor, name)) => (factor.trim(), name.trim()),
                None => ("1", text.trim()),
            };
            let factor = factor.parse::<Number>().ok().map(|factor| factor.value());
            let factor = factor.filter(|factor| *factor > 0.0);
            let factor = factor.ok_or_else(|| refuse(format!("'{text}' has no positive factor")))?;
            let measure = match name.split_once(':') {
                Some(("lambda", target)) => {
                    let target = target.parse::<Number>().ok().map(|target| target.value());
                    let target = target.filter(|target| (0.0..1.0).contains(target));
                    Measure::Lambda(target.ok_or_else(|| refuse(format!("'{name}' has no target from 0 to below 1")))?)
                }
                _ => match name {
                    "E" => Measure::Weighted,
                    "E-unweighted" => Measure::Unweighted,
                    "ratio" => Measure::Ratio,
                    "K_m" => Measure::SignChange,
                    "strictness" => Measure::Strictness,
                    "hull" => Measure::Hull,
                    "polar" => Measure::Polar,
                    _ => {
                        let similar = did_you_mean(name, MEASURES);
                        return Err(refuse(format!("unknown objective '{name}'{similar}")));
                    }
                },
            };
            Ok((factor, measure))
        };
        let terms = text.split('+').map(term);
        Ok(Goal {
            terms: terms.collect::<Result<_, _>>()?,
            own: None,
        })
    }
}

/// What a scheme must satisfy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// No weight is negative.
    Hull,
    /// No further eigenvalue exceeds lambda^2 in modulus.
    Bounded,
    /// The eigenvalues of the linear and quadratic terms lead all others.
    Order,
    /// C1: proven by the certificate; during the search its eigenvalues and the sign of the Jacobian.
    C1,
}

impl Condition {
    /// All of them.
    pub const ALL: [Condition; 4] = [Condition::Hull, Condition::Bounded, Condition::Order, Condition::C1];

    /// The name that users give.
    pub fn name(self) -> &'static str {
        match self {
            Condition::Hull => "hull",
            Condition::Bounded => "bounded",
            Condition::Order => "order",
            Condition::C1 => "c1",
        }
    }
}

impl FromStr for Condition {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let names = Condition::ALL.map(Condition::name);
        let found = Condition::ALL.into_iter().find(|known| known.name() == text.trim());
        found.ok_or_else(|| {
            let similar = did_you_mean(text, names);
            Error::refused(
                format!("unknown condition '{text}'{similar}"),
                Accepted::Are(names.join(", ")),
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goals_are_sums_of_known_measures() {
        for (text, shown) in [
            ("E", "E"),
            ("1*E+10*ratio", "E+10*ratio"),
            ("2*lambda:1/2 + K_m", "2*lambda:0.5+K_m"),
        ] {
            assert_eq!(text.parse::<Goal>().unwrap().to_string(), shown);
        }
        for (text, needle) in [
            ("", "unknown objective ''"),
            ("ratoi", "did you mean 'ratio'?"),
            ("-1*E", "positive factor"),
            ("x*E", "positive factor"),
            ("lambda:2", "target"),
            ("E++ratio", "unknown objective ''"),
        ] {
            let error = text.parse::<Goal>().unwrap_err().to_string();
            assert!(
                error.contains(needle) && error.contains("accepted are E, E-unweighted"),
                "{text}: {error}"
            );
        }
        let error = "bound".parse::<Condition>().unwrap_err().to_string();
        assert!(
            error.ends_with("(did you mean 'bounded'?): accepted are hull, bounded, order, c1"),
            "{error}"
        );
    }
}
