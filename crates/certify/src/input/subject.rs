//! An input at one valence, made ready for proofs.

use super::Identities;
use crate::levels::{Beyond, Tail};
use crate::{Error, Interval};
use eigenring_scheme::families::tension_level;
use eigenring_scheme::user::{Balance, UserScheme};
use eigenring_scheme::{Corner, Definition, Exact, Level, Number, Same, Scalar, Scheme, Spec, Taps};

/// A family around a corner.
pub(super) fn family_subject(spec: &Spec, corner: Corner) -> Result<Subject, Error> {
    let definition = Definition::Family(spec.clone());
    let (beyond, affine_levels) = beyond_leading(spec, &corner)?;
    let exact = definition.exact(&corner)?;
    // enclosures of exact numbers, or, where levels have roots in them, of the formulas
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

/// The scheme for a range of a parameter: the weights are enclosures of what they are at any value in it.
pub(super) fn ranged_subject(
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
                known.at(valence).to()
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
