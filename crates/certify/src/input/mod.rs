//! What is certified: an exact scheme.
//!
//! A certificate speaks of a scheme in real numbers. What those are must be said without rounding, so an
//! [`Input`] consists of names, of doubles (each the rational number it represents) and of the text of a
//! scheme file, whose decimals and fractions are taken as written. A stencil that somebody computed in
//! doubles is another matter: it approximates a scheme that is not given, and everything said of it is
//! [numerical](crate::Status::Numerical).
//!
//! [`Subject`] is an input at one valence, made ready for proofs: the rules with interval weights, the same
//! with exact ones where these exist, and for the lambda-scheme the equalities that its closed forms give
//! ([`Identities`]).

mod identities;
mod subject;

pub use identities::Identities;
pub use subject::Subject;
pub(crate) use subject::passes_are_affine;

use crate::levels::Beyond;
use crate::{Error, Interval};
use eigenring_scheme::lambda::{Member, Source, Splines, Untabulated};
use eigenring_scheme::user::{Balance, Reading, UserScheme};
use eigenring_scheme::{Definition, Number, OneRing, Shape, Spec};
use identities::lambda_subject;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use subject::{family_subject, ranged_subject};

/// A scheme, exactly; see the module page.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Input {
    /// A family with rational or cyclotomic constants, by its spec: Catmull-Clark, Doo-Sabin, tension.
    Family {
        /// The spec.
        spec: String,
    },
    /// A family beside a boundary, a crease, a fixed vertex or knot intervals, which are the numbers that
    /// their doubles are.
    Corner {
        /// The spec.
        spec: String,
        /// What the scheme sees.
        shape: Shape,
        /// In how many smoothing steps creases act; all if absent.
        steps: Option<usize>,
    },
    /// The lambda-scheme at the numbers that these doubles are.
    Lambda {
        /// The subdominant eigenvalue.
        lambda: f64,
        /// The relaxation `mu / lambda^2`.
        s: f64,
        /// Weight of the edge neighbours in the face rule.
        f2: f64,
        /// Weight of the face point in the face rule; `None` means `mu` itself, as valence 4 demands.
        f3: Option<f64>,
    },
    /// A scheme file.
    Toml {
        /// Its text.
        text: String,
        /// The name used if the text gives none.
        name: String,
        /// How its weights are read.
        reading: Reading,
        /// The parameters that have another value than their default, as numbers in text.
        #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
        parameters: BTreeMap<String, String>,
    },
    /// A scheme file for every value of one of its parameters from one number to another: what is proven
    /// holds for each of them, what is refuted for none.
    TomlRange {
        /// Its text.
        text: String,
        /// The name used if the text gives none.
        name: String,
        /// How its weights are read.
        reading: Reading,
        /// The parameters that have another value than their default.
        #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
        parameters: BTreeMap<String, String>,
        /// The parameter.
        parameter: String,
        /// The ends of its range.
        ends: [String; 2],
    },
    /// One-ring weights that were computed in doubles.
    Floating {
        /// f1, f2, f3, d1, d2, e1, e2, alpha, beta.
        weights: [f64; 9],
    },
}

impl Input {
    /// The input of a spec. For the lambda-scheme the weights are looked up here, so that the input does not
    /// depend on the table.
    ///
    /// # Errors
    /// Those of the spec: parameters out of range, a member of the lambda-scheme that is not tabulated.
    pub fn from_spec(spec: &Spec, valence: usize) -> Result<Self, Error> {
        Ok(match spec.member(valence, Untabulated::refuse)? {
            Some(member) => Input::member(&member),
            None => Input::Family { spec: spec.to_string() },
        })
    }

    /// The input of a member of the lambda-scheme.
    pub fn member(member: &Member) -> Self {
        // at valence 4 f3 is mu; a tabulated or tuned double can only come near
        let is_mu = member.plane.valence == 4 && member.source != Source::Given;
        Input::Lambda {
            lambda: member.plane.lambda,
            s: member.plane.s,
            f2: member.f2,
            f3: (!is_mu).then_some(member.f3),
        }
    }

    /// The input of one-ring weights in doubles.
    pub fn floating(weights: OneRing<f64>) -> Self {
        Input::Floating {
            weights: weights.named().map(|(_, weight)| weight),
        }
    }

    /// The scheme's name.
    pub fn name(&self) -> String {
        match self {
            Input::Family { spec } | Input::Corner { spec, .. } => spec.clone(),
            Input::Lambda { lambda, s, f2, f3 } => match f3 {
                Some(f3) => Spec::Lambda {
                    lambda: *lambda,
                    s: Some(*s),
                    weights: Some((*f2, *f3)),
                    splines: Splines::Paper,
                }
                .to_string(),
                None => format!("lambda:lambda={lambda},f2={f2},f3=mu,s={s}"),
            },
            Input::Toml {
                text,
                name,
                reading,
                parameters,
            } => file(text, name, *reading, parameters).map_or_else(|_| name.clone(), |scheme| scheme.name()),
            Input::TomlRange {
                text,
                name,
                reading,
                parameters,
                parameter,
                ends: [first, last],
            } => {
                let file = file(text, name, *reading, parameters);
                let name = file.map_or_else(|_| name.clone(), |scheme| scheme.name());
                format!("{name},{parameter}={first}..{last}")
            }
            Input::Floating { .. } => "one-ring weights in doubles".to_owned(),
        }
    }

    /// What the scheme sees, in the words of [`Corner`](eigenring_scheme::Corner); `None` for a corner that
    /// does not exist.
    pub fn corner(&self) -> Option<String> {
        match self {
            Input::Corner { spec, shape, steps } => {
                let definition = Definition::Family(spec.parse().ok()?);
                Some(shape.corner(definition.centre(), *steps).ok()?.to_string())
            }
            _ => Some("closed".to_owned()),
        }
    }

    /// The scheme's name with where it came from: `file:` before the name of a file's scheme, which is no
    /// name of ours.
    pub fn origin(&self) -> String {
        match self {
            Input::Toml { .. } | Input::TomlRange { .. } => format!("file:{}", self.name()),
            _ => self.name(),
        }
    }

    /// The scheme at a valence.
    ///
    /// # Errors
    /// Those of the rules; [`Error::NotFinite`].
    pub fn subject(&self, valence: usize) -> Result<Subject, Error> {
        match self {
            Input::Family { spec } => {
                let spec: Spec = spec.parse()?;
                let corner = Definition::Family(spec.clone()).closed(valence)?;
                family_subject(&spec, corner)
            }
            Input::Corner { spec, shape, steps } => {
                let spec: Spec = spec.parse()?;
                let corner = shape.corner(Definition::Family(spec.clone()).centre(), *steps)?;
                let found = corner.sectors().sectors();
                if found != valence {
                    return Err(Error::Sectors { found, valence });
                }
                family_subject(&spec, corner)
            }
            &Input::Lambda { lambda, s, f2, f3 } => lambda_subject(valence, lambda, s, f2, f3),
            Input::Toml {
                text,
                name,
                reading,
                parameters,
            } => {
                let file = file(text, name, *reading, parameters)?;
                Ok(Subject {
                    scheme: file.scheme(valence)?,
                    exact: Some(file.exact(valence)?),
                    identities: None,
                    corner: None,
                    beyond: Beyond::Unknown,
                    // of formulas whose values are no exact numbers only enclosures are known, and equalities
                    // hold as far as these tell
                    floating: !file.is_exact(valence)?,
                    affine_levels: false,
                    balance: file.balance(valence)?,
                })
            }
            Input::TomlRange {
                text,
                name,
                reading,
                parameters,
                parameter,
                ends,
            } => {
                let file = file(text, name, *reading, parameters)?;
                ranged_subject(&file, &self.name(), valence, parameter, ends)
            }
            Input::Floating { weights } => {
                let [f1, f2, f3, d1, d2, e1, e2, alpha, beta] = *weights;
                let weights = OneRing {
                    f1,
                    f2,
                    f3,
                    d1,
                    d2,
                    e1,
                    e2,
                    alpha,
                    beta,
                };
                for (what, value) in weights.named() {
                    if !value.is_finite() {
                        return Err(Error::NotFinite { what, value });
                    }
                }
                let scheme = weights.map(Interval::point).scheme(self.name(), valence)?;
                Ok(Subject {
                    scheme,
                    exact: None,
                    identities: None,
                    floating: true,
                    corner: None,
                    beyond: Beyond::Unknown,
                    affine_levels: false,
                    balance: Balance::default(),
                })
            }
        }
    }
}

/// A scheme file with values of its parameters.
fn file(
    text: &str,
    name: &str,
    reading: Reading,
    parameters: &BTreeMap<String, String>,
) -> Result<UserScheme, eigenring_scheme::Error> {
    let values = parameters.iter().map(|(name, value)| Ok((name, value.parse()?)));
    let values: Vec<(&String, Number)> = values.collect::<Result<_, eigenring_scheme::Error>>()?;
    UserScheme::parse(text, name, reading)?.with(&values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn specs_become_exact_inputs() {
        let input = |spec: &str, valence| Input::from_spec(&spec.parse().unwrap(), valence).unwrap();
        assert_eq!(
            input("catmull-clark", 5),
            Input::Family {
                spec: "catmull-clark".into()
            }
        );
        assert!(matches!(input("lambda:optimal", 4), Input::Lambda { f3: None, s, .. } if s == 1.0));
        let regular = input("lambda:lambda=0.5,f2=0.25,f3=0.25", 4);
        assert_eq!(
            regular,
            Input::Lambda {
                lambda: 0.5,
                s: 1.0,
                f2: 0.25,
                f3: Some(0.25)
            }
        );
        assert!(
            regular
                .subject(4)
                .unwrap()
                .identities
                .is_some_and(|identities| identities.square)
        );
        // beside mu the closed forms do not hold at valence 4
        let beside = Input::Lambda {
            lambda: 0.5,
            s: 1.0,
            f2: 0.25,
            f3: Some(0.2500001),
        };
        assert!(beside.subject(4).unwrap().identities.is_none());
        for input in [
            regular,
            input("doo-sabin", 4),
            Input::floating(eigenring_scheme::families::catmull_clark_weights(4)),
        ] {
            let text = serde_json::to_string(&input).unwrap();
            assert_eq!(serde_json::from_str::<Input>(&text).unwrap(), input);
        }
    }
}
