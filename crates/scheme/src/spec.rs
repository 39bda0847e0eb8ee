//! Schemes by name.
//!
//! A spec is a family's name, then parameters: `catmull-clark`, `lambda:lambda=0.5`, `lambda:optimal`,
//! `tension:order=6,u0=2`. [`registry`] lists the families; every scheme of it is tested, by a test that
//! walks the registry.

use crate::families::{catmull_clark, doo_sabin, tension};
use crate::lambda::{Member, Splines, Untabulated};
use crate::{Error, Exact, Scalar, Scheme, did_you_mean};
use std::fmt;
use std::str::FromStr;

/// A registered family.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// The name that a spec starts with.
    pub name: &'static str,
    /// The parameters it takes, as shown to users.
    pub usage: &'static str,
    /// What it is and where it comes from.
    pub summary: &'static str,
    /// Specs that stand for the family in tests and comparisons.
    pub examples: &'static [&'static str],
    /// Reads the parameters; those that it leaves are unknown ones.
    parse: fn(&mut Parameters<'_>) -> Result<Spec, Error>,
}

/// All families, in the order in which they are listed to users.
pub fn registry() -> &'static [Family] {
    &[
        Family {
            name: "catmull-clark",
            usage: "catmull-clark",
            summary: "bicubic, around a vertex (Catmull and Clark 1978)",
            examples: &["catmull-clark"],
            parse: |_| Ok(Spec::CatmullClark),
        },
        Family {
            name: "doo-sabin",
            usage: "doo-sabin[:uniform]",
            summary: "biquadratic, around a face: original weights (Doo and Sabin 1978), or all far corners of a face alike, which is order 3 of the tension scheme at u = 1",
            examples: &["doo-sabin", "doo-sabin:uniform"],
            parse: |parameters| {
                Ok(if parameters.flag("uniform") {
                    Spec::DooSabinUniform
                } else {
                    Spec::DooSabin
                })
            },
        },
        Family {
            name: "lambda",
            usage: "lambda:optimal | lambda:lambda=L[,f2=X,f3=Y][,s=S] | lambda:fine,lambda=L",
            summary: "bicubic, tuned for a subdominant eigenvalue (Ma, Wang and Ma 2023); weights from the embedded spline table, or from the one with more coefficients (fine), unless f2 and f3 are given",
            examples: &["lambda:optimal", "lambda:lambda=0.5", "lambda:lambda=0.39"],
            parse: parse_lambda,
        },
        Family {
            name: "tension",
            usage: "tension:order=K[,u0=U]",
            summary: "any order K >= 3 with initial tension U (Fang, Ma and Wang); even orders around a vertex, odd around a face",
            examples: &[
                "tension:order=3",
                "tension:order=4,u0=0.5",
                "tension:order=5",
                "tension:order=6,u0=2",
            ],
            parse: |parameters| {
                Ok(Spec::Tension {
                    order: parameters.demand("order", "no order")?,
                    u0: parameters.take("u0")?.unwrap_or(1.0),
                })
            },
        },
        Family {
            name: "stam",
            usage: "stam:order=K",
            summary: "B-spline subdivision of any order K >= 3 (Stam 2001), in the form of the tension scheme at u = 1",
            examples: &["stam:order=6", "stam:order=7"],
            parse: |parameters| {
                Ok(Spec::Stam {
                    order: parameters.demand("order", "no order")?,
                })
            },
        },
        Family {
            name: "morin",
            usage: "morin:u0=U",
            summary: "bicubic with initial tension U > -1, for surfaces of revolution (Morin et al. 2001): order 4 of the tension scheme",
            examples: &["morin:u0=0.5", "morin:u0=2"],
            parse: |parameters| {
                Ok(Spec::Morin {
                    u0: parameters.demand("u0", "no tension")?,
                })
            },
        },
    ]
}

/// Which scheme; the valence comes later.
#[derive(Clone, Debug, PartialEq)]
pub enum Spec {
    /// Catmull-Clark.
    CatmullClark,
    /// Doo-Sabin, original weights.
    DooSabin,
    /// The biquadratic scheme whose face weights are (3N-3, 3, 1)/(4N).
    DooSabinUniform,
    /// The lambda-scheme at its tabulated optimum.
    LambdaOptimal,
    /// The lambda-scheme at a given lambda.
    Lambda {
        /// The subdominant eigenvalue.
        lambda: f64,
        /// The relaxation, by the rule of [`Relaxation`](crate::lambda::Relaxation) if not given.
        s: Option<f64>,
        /// (f2, f3); if not given, those of the embedded table, which belong to the s of the rule.
        weights: Option<(f64, f64)>,
        /// Whose weights, if they are not given.
        splines: Splines,
    },
    /// The generalised tension scheme.
    Tension {
        /// The order k; the degree is k-1.
        order: usize,
        /// The tension of the first refinement.
        u0: f64,
    },
    /// The tension scheme at u = 1.
    Stam {
        /// The order.
        order: usize,
    },
    /// The tension scheme of order 4.
    Morin {
        /// The tension of the first refinement.
        u0: f64,
    },
}

impl Spec {
    /// The scheme around a centre of the given valence.
    ///
    /// # Errors
    /// Those of the family: valence or parameters out of range; those of [`Untabulated::refuse`] for weights
    /// that would have to be tuned.
    pub fn scheme<S: Scalar + Copy>(&self, valence: usize) -> Result<Scheme<S>, Error> {
        match self.member(valence, Untabulated::refuse)? {
            Some(member) => member.scheme(self.to_string()),
            None => self
                .closed_form(valence)
                .expect("every family but the lambda-scheme has a closed form"),
        }
    }

    /// The member of the lambda-scheme that is named; `None` for another family. `beyond` is asked for what
    /// the embedded table does not hold: a tuner, or [`Untabulated::refuse`].
    ///
    /// # Errors
    /// Those of [`Member::given`], [`Member::at`] and [`Member::optimal`], and those of `beyond`.
    pub fn member<E: From<Error>>(
        &self,
        valence: usize,
        beyond: impl FnOnce(Untabulated) -> Result<Member, E>,
    ) -> Result<Option<Member>, E> {
        match *self {
            Spec::LambdaOptimal => Member::optimal(valence, beyond).map(Some),
            Spec::Lambda {
                lambda,
                s,
                weights,
                splines,
            } => match weights {
                Some((f2, f3)) => Ok(Some(Member::given(valence, lambda, s, [f2, f3])?)),
                None => Member::at(valence, lambda, s, splines, beyond).map(Some),
            },
            _ => Ok(None),
        }
    }

    /// The scheme in exact numbers; `None` for the lambda-scheme, whose weights are no [`Exact`] numbers.
    ///
    /// # Errors
    /// As [`Spec::scheme`].
    pub fn exact(&self, valence: usize) -> Result<Option<Scheme<Exact>>, Error> {
        self.closed_form(valence).transpose()
    }

    /// The families whose constructors run in every scalar.
    fn closed_form<S: Scalar>(&self, valence: usize) -> Option<Result<Scheme<S>, Error>> {
        match *self {
            Spec::CatmullClark => Some(catmull_clark(valence)),
            Spec::DooSabin => Some(doo_sabin(valence)),
            Spec::Tension { .. } | Spec::DooSabinUniform | Spec::Stam { .. } | Spec::Morin { .. } => {
                let (order, u0) = self.order_and_tension()?;
                Some(tension(valence, order, u0).map(|scheme: Scheme<S>| scheme.named(self.to_string())))
            }
            Spec::LambdaOptimal | Spec::Lambda { .. } => None,
        }
    }

    /// Order and initial tension, if the scheme is a case of the tension scheme.
    pub fn order_and_tension(&self) -> Option<(usize, f64)> {
        match *self {
            Spec::Tension { order, u0 } => Some((order, u0)),
            Spec::DooSabinUniform => Some((3, 1.0)),
            Spec::Stam { order } => Some((order, 1.0)),
            Spec::Morin { u0 } => Some((4, u0)),
            _ => None,
        }
    }
}

/// A number that reads back as it is, with an exponent where that is shorter by far.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.abs() {
            size if size == 0.0 || (1e-9..1e16).contains(&size) => write!(f, "{}", self.0),
            _ => write!(f, "{:e}", self.0),
        }
    }
}

impl fmt::Display for Spec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Spec::CatmullClark => write!(f, "catmull-clark"),
            Spec::DooSabin => write!(f, "doo-sabin"),
            Spec::DooSabinUniform => write!(f, "doo-sabin:uniform"),
            Spec::LambdaOptimal => write!(f, "lambda:optimal"),
            Spec::Lambda {
                lambda,
                s,
                weights,
                splines,
            } => {
                let fine = if *splines == Splines::Fine { "fine," } else { "" };
                write!(f, "lambda:{fine}lambda={}", Short(*lambda))?;
                if let Some((f2, f3)) = weights {
                    write!(f, ",f2={},f3={}", Short(*f2), Short(*f3))?;
                }
                s.map_or(Ok(()), |s| write!(f, ",s={}", Short(s)))
            }
            Spec::Tension { order, u0 } => write!(f, "tension:order={order},u0={}", Short(*u0)),
            Spec::Stam { order } => write!(f, "stam:order={order}"),
            Spec::Morin { u0 } => write!(f, "morin:u0={}", Short(*u0)),
        }
    }
}

/// The parameters of a spec, taken out one by one so that what remains is unknown.
struct Parameters<'a> {
    spec: &'a str,
    usage: &'static str,
    pairs: Vec<(&'a str, &'a str)>,
}

impl<'a> Parameters<'a> {
    fn new(spec: &'a str, usage: &'static str, text: Option<&'a str>) -> Result<Self, Error> {
        let mut parameters = Parameters {
            spec,
            usage,
            pairs: Vec::new(),
        };
        for part in text.into_iter().flat_map(|text| text.split(',')) {
            let (name, value) = part.split_once('=').unwrap_or((part, ""));
            if parameters.pairs.iter().any(|&(known, _)| known == name.trim()) {
                return Err(parameters.refuse(format!("'{}' is given twice", name.trim())));
            }
            parameters.pairs.push((name.trim(), value.trim()));
        }
        Ok(parameters)
    }

    fn refuse(&self, reason: impl Into<String>) -> Error {
        Error::Spec {
            spec: self.spec.to_owned(),
            reason: reason.into(),
            accepted: self.usage.to_owned(),
        }
    }

    fn take<T: FromStr>(&mut self, name: &str) -> Result<Option<T>, Error> {
        let Some(index) = self.pairs.iter().position(|&(known, _)| known == name) else {
            return Ok(None);
        };
        let (_, value) = self.pairs.remove(index);
        match value.parse() {
            Ok(value) => Ok(Some(value)),
            Err(_) => Err(self.refuse(format!("'{value}' is not a value for {name}"))),
        }
    }

    fn demand<T: FromStr>(&mut self, name: &str, without: &str) -> Result<T, Error> {
        let value = self.take(name)?;
        value.ok_or_else(|| self.refuse(format!("{without} is given")))
    }

    fn flag(&mut self, name: &str) -> bool {
        let index = self.pairs.iter().position(|&pair| pair == (name, ""));
        index.map(|index| self.pairs.remove(index)).is_some()
    }

    fn unknown(&self, name: &str) -> Error {
        let similar = did_you_mean(name, names(self.usage));
        self.refuse(format!("unknown parameter '{name}'{similar}"))
    }

    fn finish(&self) -> Result<(), Error> {
        match self.pairs.first() {
            None => Ok(()),
            Some((name, _)) => Err(self.unknown(name)),
        }
    }
}

/// The names of parameters in the usage of a family, `name:key=VALUE[,key=VALUE]`: runs of letters and digits
/// before a `=`, and words that stand alone.
fn names(usage: &str) -> impl Iterator<Item = &str> {
    let parts = usage.split(|letter: char| !letter.is_ascii_alphanumeric() && letter != '-');
    // values are written in capital letters
    parts.filter(|part| part.starts_with(|letter: char| letter.is_ascii_lowercase()))
}

fn parse_lambda(parameters: &mut Parameters<'_>) -> Result<Spec, Error> {
    if parameters.flag("optimal") {
        return Ok(Spec::LambdaOptimal);
    }
    let fine = parameters.flag("fine");
    let Some(lambda) = parameters.take("lambda")? else {
        return Err(parameters.refuse("neither 'optimal' nor a lambda is given"));
    };
    let s = parameters.take("s")?;
    let weights = match (parameters.take("f2")?, parameters.take("f3")?) {
        (Some(f2), Some(f3)) => Some((f2, f3)),
        (None, None) => None,
        _ => return Err(parameters.refuse("f2 and f3 must be given together")),
    };
    let numbers = [Some(lambda), s, weights.map(|w| w.0), weights.map(|w| w.1)];
    if numbers.iter().flatten().any(|number: &f64| !number.is_finite()) {
        return Err(parameters.refuse("a parameter is not a finite number"));
    }
    if fine && (s.is_some() || weights.is_some()) {
        return Err(parameters.refuse("the fine splines give f2, f3 and s themselves"));
    }
    let splines = if fine { Splines::Fine } else { Splines::Paper };
    Ok(Spec::Lambda {
        lambda,
        s,
        weights,
        splines,
    })
}

impl FromStr for Spec {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let (name, rest) = match text.split_once(':') {
            Some((name, rest)) => (name, Some(rest)),
            None => (text, None),
        };
        let Some(family) = registry().iter().find(|family| family.name == name) else {
            let known: Vec<&str> = registry().iter().map(|family| family.usage).collect();
            let similar = did_you_mean(name, registry().iter().map(|family| family.name));
            return Err(Error::Spec {
                spec: text.to_owned(),
                reason: format!("no such family{similar}"),
                accepted: known.join(" | "),
            });
        };
        let mut parameters = Parameters::new(text, family.usage, rest)?;
        // a name that no form of the family knows, before the complaint that the right one is missing
        let known = |name: &str| name.is_empty() || names(family.usage).any(|known| known == name);
        if let Some(&(name, _)) = parameters.pairs.iter().find(|(name, _)| !known(name)) {
            return Err(parameters.unknown(name));
        }
        let spec = (family.parse)(&mut parameters)?;
        parameters.finish()?;
        Ok(spec)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_registered_example_parses_and_prints_itself() {
        for family in registry() {
            assert!(!family.examples.is_empty(), "{} has no example", family.name);
            for example in family.examples {
                let spec: Spec = example.parse().unwrap();
                assert_eq!(spec.to_string().parse::<Spec>().unwrap(), spec);
                assert!(spec.to_string().starts_with(family.name));
            }
        }
    }

    #[test]
    fn cases_of_the_tension_scheme_are_told_apart_by_name_only() {
        for (name, same) in [
            ("doo-sabin:uniform", "tension:order=3"),
            ("stam:order=7", "tension:order=7"),
            ("morin:u0=0.3", "tension:order=4,u0=0.3"),
        ] {
            let scheme = |text: &str| text.parse::<Spec>().unwrap().scheme::<f64>(5).unwrap();
            let (named, general) = (scheme(name), scheme(same));
            assert_eq!(named.name(), name);
            assert_eq!(named.leading().len(), general.leading().len());
            for index in 0..=named.leading().len() {
                let pairs = named.level(index).passes().iter().zip(general.level(index).passes());
                for (a, b) in pairs {
                    assert!(a.line() == b.line() && a.special() == b.special(), "{name}");
                }
            }
        }
        for text in [
            "stam:order=2",
            "morin:u0=-1",
            "tension:order=4,u0=nan",
            "tension:order=33",
        ] {
            let error = text.parse::<Spec>().unwrap().scheme::<f64>(5).unwrap_err().to_string();
            assert!(error.contains("accepted"), "{text}: {error}");
        }
    }

    #[test]
    fn explicit_weights_need_no_table() {
        let spec: Spec = "lambda:lambda=0.5,f2=0.25,f3=0.25".parse().unwrap();
        let level = spec.scheme::<f64>(4).unwrap().limit().clone();
        let reference = crate::families::catmull_clark_weights::<f64>(4);
        let reference = reference.scheme("reference", 4).unwrap().limit().clone();
        for &site in reference.passes()[0].special().keys() {
            let (a, b) = (level.stencil(0, site).unwrap(), reference.stencil(0, site).unwrap());
            for (a, b) in a.terms().iter().zip(b.terms()) {
                assert!(a.0 == b.0 && (a.1 - b.1).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn bad_specs_say_what_is_accepted() {
        for (text, needle) in [
            ("", "no such family"),
            ("loop", "no such family"),
            ("catmull-clark:order=4", "unknown parameter"),
            ("lambda", "neither"),
            ("lambda:lambda=x", "not a value"),
            ("lambda:lambda=nan", "finite"),
            ("lambda:lambda=0.5,f2=0.3", "together"),
            ("lambda:lambda=0.5,lambda=0.6", "twice"),
            ("lambda:optimal,s=1", "unknown"),
            ("tension:u0=1", "no order"),
            ("stam", "no order"),
            ("stam:order=6,u0=2", "unknown parameter 'u0'"),
            ("morin", "no tension"),
            ("morin:order=4,u0=2", "unknown parameter 'order'"),
            ("doo-sabin:original", "unknown parameter 'original'"),
            ("tension:order=4,u=1", "unknown parameter 'u'"),
        ] {
            let error = text.parse::<Spec>().unwrap_err().to_string();
            assert!(error.contains(needle) && error.contains("accepted"), "{text}: {error}");
        }
    }
}
