//! Statements about weights: affine invariance and the convex hull property.
//!
//! Both are read off the rows of the refinement itself, whatever passes it is made of: a refined point is
//! affinely invariant if the weights of control points in it sum to 1, and in the convex hull if they are not
//! negative. Beyond the rings that special stencils reach every row is one of the regular ones, so that two
//! rings more than those show all rows. Levels that differ are looked at one by one, those beyond the leading
//! ones with rules that enclose all of theirs, the limit level last.

use crate::input::passes_are_affine;
use crate::interval::digits;
use crate::{Check, Error, Interval, Statement, Subject, Witness};
use eigenring_scheme::{Error as SchemeError, Exact, Level, Net, Scalar, Site, refine};

/// The levels of a scheme with their exact twins, and how a message refers to them: the leading ones, all
/// beyond them at once, the limit level.
fn levels(subject: &Subject) -> impl Iterator<Item = (&Level<Interval>, Option<&Level<Exact>>, String)> {
    let count = subject.scheme.leading().len();
    let exact = move |index: usize| subject.exact.as_ref().map(|exact| exact.level(index));
    let leading =
        (0..count).map(move |index| (subject.scheme.level(index), exact(index), format!(" of level {index}")));
    let beyond = subject.beyond.tail().into_iter();
    let beyond = beyond.map(move |tail| (&tail.level, None, format!(" of a level from {count} on")));
    let limit = (subject.scheme.limit(), exact(count), String::new());
    leading.chain(beyond).chain([limit])
}

/// `row_sums`: all rows of all levels sum to 1.
///
/// # Errors
/// Those of running the rules.
pub fn row_sums(subject: &Subject) -> Result<Check, Error> {
    const NAME: Statement = Statement::RowSums;
    let mut weakest: Option<Check> = None;
    for (level, exact, place) in levels(subject) {
        let check = row_sums_of(subject, level, exact, &place)?;
        // of equally weak levels the limit level speaks for all
        let weaker = weakest
            .as_ref()
            .is_none_or(|known| known.status.and(check.status) == check.status);
        if weaker {
            weakest = Some(check);
        }
    }
    Ok(weakest.unwrap_or_else(|| Check::undecided(NAME, "no levels")))
}

fn row_sums_of(
    subject: &Subject,
    level: &Level<Interval>,
    exact: Option<&Level<Exact>>,
    place: &str,
) -> Result<Check, Error> {
    const NAME: Statement = Statement::RowSums;
    let sites = level.row_sites()?;
    let sums: Vec<Interval> = refine(level, &OneNet, &sites)?;
    if !sums.iter().all(|sum| sum.is_bounded()) {
        return Ok(Check::undecided(
            NAME,
            "the weights are not bounded: a closed form divides by zero or nearly so",
        ));
    }
    if subject.identities.is_some() || !subject.floating && subject.exact.is_none() {
        return Ok(Check::proven(NAME)
            .enclosing(Interval::point(0.0))
            .remark("f1 + 2 f2 + f3 = 1 and g1 + 2 g2 + g3 = 1 by construction"));
    }
    if !place.is_empty() && subject.affine_levels {
        return Ok(Check::proven(NAME)
            .enclosing(Interval::point(0.0))
            .remark("in exact arithmetic, those of leading levels as an identity in the tension"));
    }
    let defects = exact.and_then(|exact| row_sum_defects(exact, &sites));
    if let Some(defects) = defects {
        let wrong = sites.iter().zip(&defects).filter_map(|(site, defect)| match defect {
            Some((false, by)) => Some((site, *by)),
            _ => None,
        });
        let worst = wrong.max_by(|a, b| a.1.mag().total_cmp(&b.1.mag()));
        if let Some((site, by)) = worst {
            let text = format!(
                "the weights of refined point ({}, {}) of sector {}{place} sum to 1 {} {}",
                site.x,
                site.y,
                site.sector,
                if by.mid() < 0.0 { '-' } else { '+' },
                digits(by.mid().abs())
            );
            return Ok(Check::refuted(NAME, Witness::new(text).with("defect", by)).enclosing(by));
        }
        if defects.iter().all(Option::is_some) {
            let remark = if subject.balance.rows > 0 {
                "in exact arithmetic, of the balanced weights"
            } else {
                "in exact arithmetic"
            };
            return Ok(Check::proven(NAME).enclosing(Interval::point(0.0)).remark(remark));
        }
    }
    // products of the weights of several passes may be beyond exact numbers
    if exact.is_some_and(passes_are_affine) {
        return Ok(Check::proven(NAME)
            .enclosing(Interval::point(0.0))
            .remark("in exact arithmetic, pass by pass"));
    }
    // rounded weights, or exact ones that do not fit: the defect is enclosed
    let one = Interval::point(1.0);
    let (site, worst) = sites
        .iter()
        .zip(sums)
        .map(|(site, sum)| (site, sum - one))
        .max_by(|a, b| a.1.mag().total_cmp(&b.1.mag()))
        .unwrap_or((&Site::CENTRE, Interval::point(0.0)));
    if !subject.floating && worst.certainly_nonzero() {
        let text = format!(
            "the weights of refined point ({}, {}){place} do not sum to 1",
            site.x, site.y
        );
        return Ok(Check::refuted(NAME, Witness::new(text).with("defect", worst)).enclosing(worst));
    }
    let text = format!("sums{place} differ from 1 by at most {:e}", worst.mag());
    if subject.floating && worst.mag() <= ROUNDING {
        return Ok(Check::proven(NAME).enclosing(worst).remark(text).of_rounded_numbers());
    }
    if subject.floating {
        let witness = Witness::new(format!("{text}, more than rounding explains")).with("defect", worst);
        return Ok(Check::refuted(NAME, witness).enclosing(worst));
    }
    Ok(Check::undecided(NAME, text).enclosing(worst))
}

/// Weights that were rounded one by one have sums that differ from 1 by less: half a unit in the last place
/// of each of 1000 weights below 1, with room for the rounding of their own computation.
const ROUNDING: f64 = 1e-12;

/// `hull`: no weight of any level is negative. The margin is the smallest weight that is not zero: a zero is
/// as good as a control point that is not read.
///
/// # Errors
/// Those of running the rules.
pub fn hull(subject: &Subject) -> Result<Check, Error> {
    const NAME: Statement = Statement::Hull;
    let mut smallest: Option<(Site, Site, Interval, String)> = None;
    for (level, _, level_name) in levels(subject) {
        let sites = level.row_sites()?;
        let rows = level.rows(&sites)?;
        for (&target, row) in sites.iter().zip(&rows) {
            for (&source, &weight) in row.iter().filter(|(_, weight)| **weight != Interval::point(0.0)) {
                if smallest
                    .as_ref()
                    .is_none_or(|(_, _, least, _)| weight.lo() < least.lo())
                {
                    smallest = Some((target, source, weight, level_name.clone()));
                }
            }
        }
    }
    let Some((target, source, weight, level)) = smallest else {
        return Ok(Check::undecided(NAME, "no weights"));
    };
    let place = format!(
        "({}, {}) of sector {} in refined point ({}, {}){level}",
        source.x, source.y, source.sector, target.x, target.y
    );
    let check = if weight.lo() >= 0.0 {
        Check::proven(NAME).margin(weight.lo())
    } else if weight.certainly_negative() {
        let text = format!("the weight of control point {place} is {}", digits(weight.mid()));
        Check::refuted(NAME, Witness::new(text).with("weight", weight)).margin(weight.hi())
    } else {
        Check::undecided(
            NAME,
            format!("the weight of control point {place} may be zero or negative"),
        )
    };
    let check = check.enclosing(weight);
    Ok(if subject.floating {
        check.of_rounded_numbers()
    } else {
        check
    })
}

/// The exact sum of the weights of a refined point, less 1, for each of the given points: whether it is zero,
/// and an enclosure of it. `None` for a point that a weight without exact value takes part in; nothing at all
/// if the rules cannot be run.
fn row_sum_defects(level: &Level<Exact>, sites: &[Site]) -> Option<Vec<Option<(bool, Interval)>>> {
    let sums = refine(level, &OneNet, sites).ok()?;
    let defect = |sum: Exact| {
        let defect = sum - Exact::one();
        let is_zero = defect.is_zero()?;
        let rough = if is_zero { Interval::point(0.0) } else { defect.to()? };
        Some((is_zero, rough))
    };
    Some(sums.into_iter().map(defect).collect())
}

/// Every point is 1: a refined point's value is the sum of the weights that make it.
struct OneNet;

impl<S: Scalar> Net<S> for OneNet {
    type Value = S;

    fn zero(&self) -> S {
        S::zero()
    }

    fn control(&self, _site: Site) -> Result<S, SchemeError> {
        Ok(S::one())
    }

    fn orbit(&self, site: Site) -> Site {
        site
    }

    fn accumulate(&self, sum: &mut S, weight: &S, at_orbit: &S, _site: Site) {
        *sum += weight.clone() * at_orbit.clone();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::families::{doo_sabin, tension};
    use eigenring_scheme::{Fan, Lattice, Line, Pass, Scheme, Stencil};

    #[test]
    fn exact_sums_are_one_and_planted_faults_are_seen() {
        for valence in [3, 5, 8] {
            let mut schemes: Vec<Scheme<Exact>> = vec![doo_sabin(valence).unwrap()];
            schemes.extend([3, 4, 5, 6, 9].map(|order| tension(valence, order, 1.0).unwrap()));
            for scheme in schemes {
                let sites: Vec<Site> = scheme.numbering(2).sector_sites(0).collect();
                let defects = row_sum_defects(scheme.limit(), &sites).unwrap();
                let zero = Some((true, Interval::point(0.0)));
                assert!(defects.into_iter().all(|defect| defect == zero), "{}", scheme.name());
            }
        }
        let stencil = Stencil::new().with(Site::CENTRE, Exact::ratio(1_000_000_001, 1_000_000_000));
        let pass = Pass::regular(Lattice::Vertex, Lattice::Vertex, Line::cubic()).with(Site::CENTRE, stencil);
        let level = Level::new(Fan::Closed(5), vec![pass]).unwrap();
        let [Some((zero, defect))] = row_sum_defects(&level, &[Site::CENTRE]).unwrap()[..] else {
            panic!("decidable");
        };
        assert!(!zero && defect.contains(1e-9));
    }
}
