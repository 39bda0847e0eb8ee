//! The checks of a certificate, from the scheme and its evidence alone.

use crate::boundary;
use crate::certificate::Evidence;
use crate::conditions::{self, Facts, Subdominant, differing};
use crate::interval::digits;
use crate::levels::{Pair, levels};
use crate::map::{self, Heights, PlaneNet, Sign};
use crate::patches::Unknown;
use crate::rows;
use crate::spectral::{self, EnclosedSpectrum, Problem};
use crate::{Check, Error, Interval, Statement, Status, Subject, Witness};
use eigenring_scheme::Lattice;
use eigenring_spectral::SecondOrder;
use std::slice;

/// What is to be enclosed; or, where no patches are known, all that can be said without.
pub fn problem(subject: &Subject) -> Result<Result<Problem, Vec<Check>>, Error> {
    Ok(match Problem::new(subject)? {
        Ok(problem) => Ok(problem),
        Err(Unknown(reason)) => {
            let (row_sums, hull) = (rows::row_sums(subject)?, rows::hull(subject)?);
            Err(without_patches(subject, row_sums, hull, &reason))
        }
    })
}

/// What is said where nothing but rows can be looked at.
fn without_patches(subject: &Subject, row_sums: Check, hull: Check, reason: &str) -> Vec<Check> {
    let mut checks = vec![row_sums, hull];
    let others = Statement::ALL.into_iter().filter(|statement| match statement {
        Statement::RowSums | Statement::Hull => false,
        Statement::Levels => !subject.scheme.leading().is_empty(),
        Statement::Corner => subject.scheme.lattice() == Lattice::Vertex,
        _ => true,
    });
    checks.extend(others.map(|statement| Check::undecided(statement, reason)));
    checks
}

/// Why statements about the natural configuration and its second-order modes are left open.
const OF_INDICES: &str = "stated of rules that are the same in all sectors";

/// The checks, up to the point where the characteristic map is known.
pub struct Proof<'a> {
    subject: &'a Subject,
    checks: Vec<Check>,
    /// Whether subdominant eigenvalues were proven.
    found: bool,
    /// The net of the characteristic map, if it was enclosed.
    pub net: Option<PlaneNet<Interval>>,
    /// The heights of the second-order maps: cup, then saddles.
    pub heights: Vec<(Heights<Interval>, Sign)>,
    /// A refutation of `regular` by a boundary.
    unseen: Option<Check>,
}

impl<'a> Proof<'a> {
    pub fn new(subject: &'a Subject, problem: Problem, evidence: &spectral::Evidence) -> Result<Self, Error> {
        let row_sums = rows::row_sums(subject)?;
        let affine = matches!(row_sums.status, Status::Proven | Status::Numerical);
        let hull = rows::hull(subject)?;
        if !affine {
            // block 0 was divided by a vector that is then no eigenvector, and what is left says nothing of
            // the scheme
            let reason = "rows are not known to sum to 1";
            let checks = without_patches(subject, row_sums, hull, reason);
            return Ok(Proof {
                subject,
                checks,
                found: false,
                net: None,
                heights: Vec::new(),
                unseen: None,
            });
        }
        let spectrum = EnclosedSpectrum::new(problem, evidence);
        if !subject.scheme.limit().is_rotation_symmetric() {
            return Ok(Proof::of_different_sectors(subject, vec![row_sums, hull], &spectrum));
        }
        let mut facts = Facts::new(subject);
        let dominant = conditions::dominant(&spectrum);
        let (subdominant, lambda) = conditions::subdominant(subject, &spectrum, &mut facts);
        let mut checks = vec![row_sums, hull, dominant, subdominant];
        let pair = lambda.as_ref().map(|lambda| Pair {
            values: slice::from_ref(&lambda.value),
            double: None,
        });
        checks.extend(levels(subject, pair));
        let (mut net, mut heights) = (None, Vec::new());
        match &lambda {
            None => {
                for name in [Statement::BoundedCurvature, Statement::NonDegenerate, Statement::Strict] {
                    checks.push(Check::undecided(name, "no subdominant eigenvalue was proven"));
                }
            }
            Some(lambda) => {
                checks.extend(conditions::second_order(subject, &spectrum, lambda, &mut facts));
                net = characteristic(&spectrum, lambda);
                if let Some(net) = &net {
                    heights = second_order_maps(&spectrum, lambda, net);
                }
            }
        }
        Ok(Proof {
            subject,
            checks,
            found: lambda.is_some(),
            net,
            heights,
            unseen: None,
        })
    }

    /// The same for rules that differ from sector to sector.
    fn of_different_sectors(subject: &'a Subject, mut checks: Vec<Check>, spectrum: &EnclosedSpectrum) -> Self {
        let (subdominant, leading) = differing::subdominant(spectrum);
        checks.extend([differing::dominant(spectrum), subdominant]);
        let pair = leading.as_ref().map(|leading| Pair {
            values: &leading.values,
            double: spectrum.coordinates.as_ref(),
        });
        checks.extend(levels(subject, pair));
        checks.push(match &leading {
            None => Check::undecided(Statement::BoundedCurvature, "no subdominant eigenvalues were proven"),
            Some(leading) => differing::curvature(spectrum, leading, subject.beyond.tail().is_some()),
        });
        for name in [Statement::NonDegenerate, Statement::Strict] {
            checks.push(Check::undecided(name, OF_INDICES));
        }
        let found = leading.is_some();
        // of what leading levels leave of the boundary's tangent nothing is known
        let stationary = subject.scheme.leading().is_empty();
        let seen_by = leading.as_ref().filter(|_| stationary);
        let unseen = seen_by.and_then(|leading| boundary::unseen(spectrum, leading));
        let vectors = leading.and_then(|leading| leading.vectors);
        let net = vectors.and_then(|vectors| PlaneNet::whole(spectrum.patches.clone(), vectors).ok());
        Proof {
            subject,
            checks,
            found,
            net,
            heights: Vec::new(),
            unseen,
        }
    }

    pub fn finish(mut self, evidence: &Evidence) -> Vec<Check> {
        // where rows do not sum to 1 every statement has been spoken of
        if self.checks.iter().all(|check| check.name != Statement::Regular) {
            self.checks.extend(self.map_checks(evidence));
        }
        if self.subject.floating {
            self.checks = self.checks.into_iter().map(Check::of_rounded_numbers).collect();
        }
        self.of_the_limit_level();
        self.checks.sort_by_key(|check| check.name);
        self.checks
    }

    /// Where levels differ, what refutes a statement about the limit level refutes one about the surface only
    /// if some net shows it after the leading levels: the tangents do if `levels` is proven, and of other
    /// modes nothing is known.
    fn of_the_limit_level(&mut self) {
        if self.subject.scheme.leading().is_empty() {
            return;
        }
        let shown = self
            .checks
            .iter()
            .any(|check| check.name == Statement::Levels && check.status == Status::Proven);
        for check in &mut self.checks {
            let of_limit = match check.name {
                Statement::Regular | Statement::Injective => !shown,
                Statement::Dominant | Statement::Subdominant | Statement::BoundedCurvature => true,
                _ => false,
            };
            if of_limit && check.status == Status::Refuted {
                let text = check.witness.as_ref().map_or("", |witness| witness.text.as_str());
                let reason = format!("of the limit level: {text}; the leading levels may leave no net that shows it");
                *check = Check::undecided(check.name, reason);
            }
        }
    }

    fn map_checks(&self, evidence: &Evidence) -> Vec<Check> {
        let Some(net) = &self.net else {
            let reason = match self.found {
                false => "no subdominant eigenvalue was proven",
                true => "the characteristic map could not be enclosed",
            };
            let names = [
                Statement::Regular,
                Statement::Injective,
                Statement::Corner,
                Statement::Gauss,
            ];
            return names.map(|name| Check::undecided(name, reason)).into();
        };
        let regular = self.unseen.clone().unwrap_or_else(|| regular(net, evidence));
        let injective = injective(net, evidence);
        // the winding number decides for regular maps
        let injective = if injective.status == Status::Proven && regular.status != Status::Proven {
            Check::undecided(
                Statement::Injective,
                "the boundary winds once, but the map is not proven regular",
            )
        } else {
            injective
        };
        let mut checks = vec![regular, injective];
        if net.fourier().is_none() {
            let vertex = self.subject.scheme.lattice() == Lattice::Vertex;
            let open = [Statement::Corner, Statement::Gauss].map(|name| Check::undecided(name, OF_INDICES));
            checks.extend(
                open.into_iter()
                    .filter(|check| vertex || check.name != Statement::Corner),
            );
            return checks;
        }
        checks.extend(corner(net));
        checks.push(self.gauss(net, evidence));
        checks
    }

    fn gauss(&self, net: &PlaneNet<Interval>, evidence: &Evidence) -> Check {
        const NAME: Statement = Statement::Gauss;
        if self.heights.len() != evidence.curvature.len() || self.heights.is_empty() {
            return Check::undecided(NAME, "the second-order maps could not be enclosed");
        }
        let mut ranges = Vec::new();
        for ((heights, sign), claim) in self.heights.iter().zip(&evidence.curvature) {
            let Some(found) = map::curvature(net, heights, *sign, claim) else {
                return Check::undecided(NAME, "the evidence does not fit");
            };
            ranges.extend(found.into_iter().map(|range| (range, *sign)));
        }
        let text = |sign: &Sign| match sign {
            Sign::Positive => "cup: smallest Gauss curvature",
            Sign::Negative => "saddle: largest Gauss curvature",
        };
        let wrong = ranges.iter().find(|(range, _)| range.status == Status::Refuted);
        if let Some((range, sign)) = wrong {
            let mut witness = Witness::new(format!("{} is {}", text(sign), digits(range.extreme.mid())))
                .with("extreme", range.extreme);
            if let Some(place) = range.place {
                witness = located(witness, "", place);
            }
            return Check::refuted(NAME, witness).enclosing(range.extreme);
        }
        if ranges.iter().all(|(range, _)| range.status == Status::Proven) {
            let margin = ranges
                .iter()
                .map(|(range, _)| range.extreme.mig())
                .fold(f64::INFINITY, f64::min);
            return Check::proven(NAME).margin(margin);
        }
        Check::undecided(NAME, "a sign is open")
    }
}

fn parts(net: spectral::Net) -> [Vec<Interval>; 2] {
    let (x, y) = net.into_iter().map(|z| (z.re, z.im)).unzip();
    [x, y]
}

fn characteristic(spectrum: &EnclosedSpectrum, lambda: &Subdominant) -> Option<PlaneNet<Interval>> {
    let entry = &spectrum.entries[lambda.position];
    let net = spectrum.net(entry, lambda.value)?;
    PlaneNet::new(spectrum.patches.annulus, 1, true, parts(net)).ok()
}

/// The maps of the largest further eigenvalues of the blocks of quadratic terms.
fn second_order_maps(
    spectrum: &EnclosedSpectrum,
    lambda: &Subdominant,
    net: &PlaneNet<Interval>,
) -> Vec<(Heights<Interval>, Sign)> {
    let n = net.sectors();
    let largest = |index: usize, count: usize| {
        let mut of_block: Vec<usize> = (0..spectrum.entries.len())
            .filter(|&position| position != lambda.position && spectrum.entries[position].index == index)
            .collect();
        let modulus = |position: usize| spectrum.entries[position].value.modulus().mid();
        of_block.sort_by(|&a, &b| modulus(b).total_cmp(&modulus(a)));
        // a map is that of the largest eigenvalue only if nothing else in the block may be as large
        let enclosed = |position: usize| spectrum.entries[position].value.modulus();
        let rest = of_block.iter().skip(count).map(|&position| enclosed(position).hi());
        let rest = rest.fold(0.0, f64::max);
        of_block.truncate(count);
        if of_block.iter().any(|&position| enclosed(position).lo() <= rest) {
            of_block.clear();
        }
        // one that is only bounded may be the one that is looked for
        let smallest = of_block
            .iter()
            .map(|&position| spectrum.entries[position].value.modulus().lo());
        let smallest = smallest.fold(f64::INFINITY, f64::min);
        let mut bounds = spectrum.bounds.iter().filter(|bound| bound.index == index);
        if bounds.any(|bound| bound.radius >= smallest) {
            of_block.clear();
        }
        of_block
    };
    let heights = |position: usize, sign: Sign| {
        let entry = &spectrum.entries[position];
        let [re, im] = parts(spectrum.net(entry, entry.value.re)?);
        let zero = |part: &Vec<Interval>| part.iter().all(|z| z.is_zero());
        let parts = match 2 * entry.index == n || entry.index == 0 {
            // a mode of one sign pattern is real or imaginary as a whole
            true if zero(&im) => vec![re],
            true if zero(&re) => vec![im],
            true => return None,
            false => vec![re, im],
        };
        Some((Heights::new(net, entry.index, parts).ok()?, sign))
    };
    let maps = SecondOrder::of(n).into_iter().zip([Sign::Positive, Sign::Negative]);
    let wanted: usize = SecondOrder::of(n).iter().map(|of| of.copies).sum();
    let found: Vec<_> = maps
        .flat_map(|(of, sign)| {
            largest(of.block, of.copies)
                .into_iter()
                .map(move |position| (position, sign))
        })
        .filter_map(|(position, sign)| heights(position, sign))
        .collect();
    if found.len() == wanted { found } else { Vec::new() }
}

fn located(witness: Witness, prefix: &str, place: map::Place) -> Witness {
    let number = |x: usize| Interval::point(x as f64);
    witness
        .with(&format!("{prefix}sector"), number(place.sector))
        .with(&format!("{prefix}p"), number(place.p))
        .with(&format!("{prefix}q"), number(place.q))
        .with(&format!("{prefix}u"), Interval::point(place.u))
        .with(&format!("{prefix}v"), Interval::point(place.v))
}

fn regular(net: &PlaneNet<Interval>, evidence: &Evidence) -> Check {
    const NAME: Statement = Statement::Regular;
    let Some(claim) = &evidence.jacobian else {
        return Check::undecided(NAME, "no evidence");
    };
    let found = map::regular(net, claim);
    let [smallest, largest] = found.jacobian;
    match found.status {
        Status::Proven => {
            Check::proven(NAME)
                .margin(found.margin())
                .enclosing(if found.positive { smallest } else { largest })
        }
        Status::Refuted => {
            let text = format!(
                "the Jacobian takes the values {} and {}",
                digits(smallest.mid()),
                digits(largest.mid())
            );
            let mut witness = Witness::new(text).with("smallest", smallest).with("largest", largest);
            if let Some([low, high]) = found.fold {
                witness = located(located(witness, "smallest_", low), "largest_", high);
            }
            Check::refuted(NAME, witness).enclosing(smallest)
        }
        _ => Check::undecided(NAME, format!("{} parts, depth {}", found.cells, found.depth)),
    }
}

fn injective(net: &PlaneNet<Interval>, evidence: &Evidence) -> Check {
    const NAME: Statement = Statement::Injective;
    let Some(claim) = &evidence.winding else {
        return Check::undecided(NAME, "no evidence");
    };
    let found = map::winding(net, claim);
    match (found.status, found.number) {
        (Status::Proven, _) => Check::proven(NAME).remark("the outer boundary winds once round the centre"),
        (Status::Refuted, Some(number)) => {
            let witness = Witness::new(format!("the outer boundary winds {number} times round the centre"));
            Check::refuted(NAME, witness.with("winding", Interval::point(number as f64)))
        }
        _ => Check::undecided(NAME, format!("winding number open after {} parts", found.parts)),
    }
}

fn corner(net: &PlaneNet<Interval>) -> Option<Check> {
    const NAME: Statement = Statement::Corner;
    let found = map::corner(net)?;
    let check = match found.within {
        Status::Proven => Check::proven(NAME).margin((found.bound - found.theta).lo()),
        Status::Refuted => {
            let text = format!(
                "theta is {}, its bound {}",
                digits(found.theta.mid()),
                digits(found.bound.mid())
            );
            Check::refuted(
                NAME,
                Witness::new(text).with("theta", found.theta).with("bound", found.bound),
            )
        }
        _ => Check::undecided(NAME, format!("theta is {}, its bound {}", found.theta, found.bound)),
    };
    Some(check.enclosing(found.theta))
}
