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

use crate::levels::{Beyond, Tail};
use crate::{Error, Interval};
use eigenring_scheme::families::tension_level;
use eigenring_scheme::lambda::{Member, Plane, Source, Untabulated};
use eigenring_scheme::user::{Balance, Reading, UserScheme};
use eigenring_scheme::{Corner, Definition, Exact, Level, Number, OneRing, Same, Scalar, Scheme, Shape, Spec, Taps};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

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
                Some(f3) => format!("lambda:lambda={lambda},f2={f2},f3={f3},s={s}"),
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
                let exact = spec.exact(valence)?;
                let corner = Definition::Family(spec.clone()).closed(valence)?;
                let (beyond, affine_levels) = beyond_leading(&spec, &corner)?;
                // enclosures of exact numbers, or, where levels have roots in them, of the formulas
                let scheme = match &exact {
                    Some(exact) if exact.leading().is_empty() => enclosed(exact),
                    _ => spec.scheme(valence)?,
                };
                Ok(Subject {
                    scheme,
                    exact,
                    identities: None,
                    floating: false,
                    corner: Some(corner),
                    beyond,
                    affine_levels,
                    balance: Balance::default(),
                })
            }
            Input::Corner { spec, shape, steps } => {
                let spec: Spec = spec.parse()?;
                let definition = Definition::Family(spec.clone());
                let corner = shape.corner(definition.centre(), *steps)?;
                let (beyond, affine_levels) = beyond_leading(&spec, &corner)?;
                let found = corner.sectors().sectors();
                if found != valence {
                    return Err(Error::Sectors { found, valence });
                }
                let exact = definition.exact(&corner)?;
                let scheme = match &exact {
                    Some(exact) if exact.leading().is_empty() => enclosed(exact),
                    _ => definition.around(&corner)?,
                };
                Ok(Subject {
                    scheme,
                    exact,
                    identities: None,
                    floating: false,
                    corner: Some(corner),
                    beyond,
                    affine_levels,
                    balance: Balance::default(),
                })
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

/// The scheme for a range of a parameter: the weights are enclosures of what they are at any value in it.
fn ranged_subject(
    file: &UserScheme,
    name: &str,
    valence: usize,
    parameter: &str,
    ends: &[String; 2],
) -> Result<Subject, Error> {
    let [first, last] = [ends[0].parse::<Number>()?, ends[1].parse::<Number>()?];
    // both ends are accepted values
    let at_first = file.with(&[(parameter, first.clone())])?;
    file.with(&[(parameter, last.clone())])?;
    let free = at_first.freeing(&[parameter])?;
    let value = |number: &Number| -> Interval { number.to() };
    let range = Interval::new(value(&first).lo(), value(&last).hi());
    let range = range.ok_or_else(|| Error::ParameterRange { ends: ends.clone() })?;
    let values: Vec<Interval> = free
        .parameters()
        .iter()
        .map(|known| {
            if known.name == parameter {
                range
            } else {
                known.value.to()
            }
        })
        .collect();
    let affine = file.is_affine_in(parameter, valence, [&first, &last])?;
    Ok(Subject {
        scheme: free.scheme_with(valence, &values)?.named(name),
        // weights that depend on the parameter have no exact value; without the identity of the row sums
        // nothing is to be taken for granted
        exact: if affine { None } else { Some(free.exact(valence)?) },
        identities: None,
        floating: false,
        corner: None,
        beyond: Beyond::Unknown,
        affine_levels: false,
        balance: Balance::default(),
    })
}

/// A scheme at one valence, ready for proofs.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The rules with enclosures of the weights.
    pub scheme: Scheme<Interval>,
    /// The rules with exact weights, where there are any.
    pub exact: Option<Scheme<Exact>>,
    /// Equalities that hold by construction.
    pub identities: Option<Identities>,
    /// Whether the weights are results of rounding.
    pub floating: bool,
    /// What the scheme sees, where it is a corner of a family.
    pub corner: Option<Corner>,
    /// What is known of the levels beyond the leading ones.
    pub beyond: Beyond,
    /// Whether the rows of the leading levels sum to 1 whatever the tension is.
    pub affine_levels: bool,
    /// What was balanced in the weights of a file.
    pub balance: Balance,
}

/// What is known of a family's levels beyond the leading ones around a corner, and whether the rows of all
/// levels of the tension scheme sum to 1. The weights of a pass, times `(1+u)^2`, are polynomials of degree 2
/// in u; a sum of such that is `(1+u)^2` at three values of u is so at all.
fn beyond_leading(spec: &Spec, corner: &Corner) -> Result<(Beyond, bool), Error> {
    let Some((order, u0)) = spec.order_and_tension() else {
        // of other families only knot intervals have levels that differ
        return Ok((Beyond::Same, false));
    };
    let affine = [0, 2, 3].into_iter().all(|u| {
        let level = tension_level(corner, order, Exact::ratio(u, 1));
        level.is_ok_and(|level| passes_are_affine(&level))
    });
    let tail = Tail::new(corner, order, u0)?;
    Ok((
        tail.map_or(Beyond::Unknown, |tail| Beyond::Tail(Box::new(tail))),
        affine,
    ))
}

/// Whether the weights of every point that a pass makes are known to sum to 1: then those of the whole level
/// do.
pub(crate) fn passes_are_affine(level: &Level<Exact>) -> bool {
    let one = |sum: Exact| sum.same(&Exact::one());
    level.passes().iter().all(|pass| {
        let sum = |taps: &Taps<Exact>| taps.iter().fold(Exact::zero(), |sum, (_, weight)| sum + weight.clone());
        let mut classes = pass.all_lines().flat_map(|line| line.classes());
        let mut special = pass.special().values();
        classes.all(|taps| one(sum(taps))) && special.all(|stencil| one(stencil.sum()))
    })
}

/// The enclosures of exact weights; nothing is known of one without value. Symmetry and degree are those of
/// the exact scheme.
fn enclosed(exact: &Scheme<Exact>) -> Scheme<Interval> {
    exact.map(|weight| weight.to().unwrap_or(Interval::ENTIRE))
}

/// Equalities of the lambda-scheme (Ma, Wang and Ma 2023), which its closed forms give at all parameters,
/// whether admissible or not.
///
/// Let `p_k(x) = x^2 - T_k x + f3 g3` with `T_k = g3 + f3 + h (1 + c_k)`: the characteristic polynomial of
/// block k != 0 on (E, F), for all one-ring stencils in the generalised Catmull-Clark form. In the notation
/// of [`Plane`] with `sg = s lambda` and `mu = sg lambda`, for arbitrary numbers c1, c2:
///
/// ```text
/// p_1(lambda) = (lambda - f3)(lambda - g3) - h (1 + c1) lambda = 0
/// p_2(mu)     = (mu - f3)(mu - g3)         - h (1 + c2) mu     = 0
/// ```
///
/// Multiplied by the denominator `C - D f3` these are polynomial identities of degree at most 6 in lambda, 3
/// in s, 2 in f3 and 1 in each of c1 and c2; the tests evaluate them in rational arithmetic on a grid with
/// more points than that in every direction, which proves them. In block 0 on (E - V, F - V), `det(x - S_0)`
/// without its factor `x - 1` is
///
/// ```text
/// p_0(x) + beta [ 2 f2 + phi h f3/f2 - (g3 + 2h - x + phi (f3 - x)) ]
/// ```
///
/// (expand; the terms in `beta^2` cancel). At `x = mu`, `p_0(mu) = p_2(mu) - h (1 - c2) mu = -h (1 - c2) mu`,
/// so that the value is zero exactly for the beta of [`Plane`]. Row sums are `f1 + 2 f2 + f3 = 1`, hence
/// `d1 + d2 + 2 e1 + 2 e2 = g1 + g3 + 2 g2 (f1 + 2 f2 + f3) = 1`. At valence 4 all this holds for `f3 = mu`,
/// where g3 and h are given by continuation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Identities {
    /// An eigenvalue of block 1.
    pub lambda: Interval,
    /// An eigenvalue of blocks 0 and 2 (at valence 3 of block 1; at valence 4 twice in block 2).
    pub mu: Interval,
    /// Whether `mu = lambda^2`, that is `s = 1`.
    pub square: bool,
}

fn lambda_subject(valence: usize, lambda: f64, s: f64, f2: f64, f3: Option<f64>) -> Result<Subject, Error> {
    // the accepted ranges of lambda and s are those of the plane
    let rough = Plane::new(valence, lambda, s)?;
    for (what, value) in [("f2", f2), ("f3", f3.unwrap_or(0.0))] {
        if !value.is_finite() {
            return Err(Error::NotFinite { what, value });
        }
    }
    let plane = Plane {
        valence,
        lambda: Interval::point(lambda),
        s: Interval::point(s),
        phi: Interval::point(rough.phi),
    };
    let mu = plane.mu();
    // at valence 4 block 2 is diagonal with f3 as one entry, and the closed forms hold for f3 = mu only
    let holds = match f3 {
        None => true,
        Some(f3) => valence != 4 || mu.is_point() && mu.contains(f3),
    };
    let stencil = plane.stencil(Interval::point(f2), f3.map_or(mu, Interval::point));
    let name = Input::Lambda { lambda, s, f2, f3 }.name();
    Ok(Subject {
        scheme: stencil.weights.scheme(name, valence)?,
        exact: None,
        identities: holds.then_some(Identities {
            lambda: plane.lambda,
            mu,
            square: s == 1.0,
        }),
        floating: false,
        corner: None,
        beyond: Beyond::Unknown,
        affine_levels: false,
        balance: Balance::default(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;

    type Q = BigRational;

    fn q(p: i64, r: i64) -> Q {
        Q::new(p.into(), r.into())
    }

    /// A g3, h and the denominator of both, of the closed forms with c1 and c2 as free numbers.
    fn closed(c: &[Q; 2], s: &Q, lambda: &Q, f3: &Q) -> [Q; 3] {
        let one = q(1, 1);
        let (sg, mu) = (s * lambda, s * lambda * lambda);
        let a = (&one + &c[0]) * &mu - (&one + &c[1]) * lambda;
        let b = &c[0] - &c[1];
        let denominator = &b * &mu - (&one + &c[0] - (&one + &c[1]) * &sg) * f3;
        [
            &mu * (a - b * f3),
            (&one - &sg) * (&mu - f3) * (lambda - f3),
            denominator,
        ]
    }

    /// Degrees of `p_1(lambda)` and `p_2(mu)` times the denominator are at most 6 in lambda, 3 in s, 2 in f3
    /// and 1 in each of c1, c2. A polynomial that vanishes on a grid with more points than its degree in
    /// every direction is zero.
    #[test]
    fn the_demanded_eigenvalues_hold_by_identity() {
        let points = |count: i64, shift: i64| (0..count).map(move |i| q(i + shift, 3));
        let zero = q(0, 1);
        let mut evaluated = 0;
        for lambda in points(9, 1) {
            for s in points(6, 2) {
                for f3 in points(5, -1) {
                    for c1 in points(5, -2) {
                        for c2 in points(5, -3) {
                            let c = [c1.clone(), c2];
                            let [g3, h, d] = closed(&c, &s, &lambda, &f3);
                            let mu = &s * &lambda * &lambda;
                            for (value, cosine) in [(&lambda, &c[0]), (&mu, &c[1])] {
                                let p = (value - &f3) * (value * &d - &g3) - &h * (q(1, 1) + cosine) * value;
                                assert_eq!(p, zero);
                            }
                            evaluated += 1;
                        }
                    }
                }
            }
        }
        assert_eq!(evaluated, 9 * 6 * 125);
    }

    /// The closed forms above are those of [`Plane`], and the stencils have the demanded eigenvalues in block
    /// 0 too.
    #[test]
    fn planes_evaluate_these_closed_forms() {
        for (valence, cosines) in [(3, [q(-1, 2), q(-1, 2)]), (6, [q(1, 2), q(-1, 2)])] {
            for (lambda, s, f2, f3) in [
                (0.5, 1.0, 0.25, 0.3125),
                (0.625, 1.25, 0.28125, 0.5),
                (0.40625, 1.0, 0.3, 0.21875),
            ] {
                let exact = |x: f64| Q::from_float(x).unwrap();
                let [g3, h, d] = closed(&cosines, &exact(s), &exact(lambda), &exact(f3));
                let plane = Plane {
                    valence,
                    lambda: Interval::point(lambda),
                    s: Interval::point(s),
                    phi: Interval::point(6.0),
                };
                let found = plane.g3_and_h(Interval::point(f3));
                for (found, expected) in [(found.0, g3 / &d), (found.1, h / &d)] {
                    assert!(exact(found.lo()) <= expected && expected <= exact(found.hi()) && found.width() < 1e-12);
                }
                // block 0 on (E - V, F - V): x^2 - t x + det at mu
                let w = plane.stencil(Interval::point(f2), Interval::point(f3)).weights;
                let two = Interval::point(2.0);
                let (a, b) = (w.d2 + two * w.e1 - w.alpha, two * w.e2 - w.beta);
                let (c, e) = (two * w.f2 - w.alpha, w.f3 - w.beta);
                let mu = plane.mu();
                let value = (a - mu) * (e - mu) - b * c;
                assert!(value.contains_zero() && value.width() < 1e-11, "{value:?}");
            }
        }
    }

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
