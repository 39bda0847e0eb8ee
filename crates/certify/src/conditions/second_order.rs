//! Statements about the eigenvalues after the subdominant one: `bounded_curvature`, `non_degenerate`,
//! `strict`.

use super::facts::{Facts, within};
use super::{Subdominant, named};
use crate::interval::digits;
use crate::linear::Eigenvalue;
use crate::spectral::{EnclosedEigenvalue, EnclosedSpectrum};
use crate::{Check, Interval, Statement, Subject, Witness};
use eigenring_spectral::SecondOrder;

/// The eigenvalues that are exactly `lambda^2` and without Jordan block: their positions among the entries,
/// and the Fourier indices that have them.
struct Squares {
    positions: Vec<usize>,
    indices: Vec<usize>,
    /// The indices that certainly have none.
    without: Vec<usize>,
}

fn squares(subject: &Subject, spectrum: &EnclosedSpectrum, lambda: &Subdominant, facts: &mut Facts) -> Squares {
    let square = lambda.value.square();
    let valence = subject.scheme.valence();
    let mut found = Squares {
        positions: Vec::new(),
        indices: Vec::new(),
        without: Vec::new(),
    };
    // exact polynomials are those of the smallest net, which must have lambda
    let rings = subject.scheme.closed_rings().unwrap_or(0);
    let inner = |position: usize| within(spectrum, &spectrum.entries[position], rings);
    let known = subject.identities.is_some() || inner(lambda.position);
    for block in &spectrum.blocks {
        let near: Vec<usize> = spectrum
            .entries
            .iter()
            .enumerate()
            .filter(|(position, e)| *position != lambda.position && e.index == block.index)
            .filter(|(_, e)| !(e.value.re.disjoint(square) || e.value.im.certainly_nonzero()))
            .map(|(position, _)| position)
            .collect();
        let bounded = spectrum
            .bounds
            .iter()
            .all(|b| b.index != block.index || b.radius < square.lo());
        // components that do not depend on each other share no Jordan block
        let apart = |a: usize, b: usize| {
            let (a, b) = (spectrum.entries[a].component, spectrum.entries[b].component);
            a != b && !block.reads[a].contains(&b) && !block.reads[b].contains(&a)
        };
        let all_apart = || {
            near.iter()
                .enumerate()
                .all(|(i, &a)| near[..i].iter().all(|&b| apart(a, b)))
        };
        if near.is_empty() {
            if bounded {
                found.without.push(block.index);
            }
            continue;
        }
        let exact = if known {
            facts.square_in(block.index, lambda.value)
        } else {
            None
        };
        match (exact, near.len()) {
            (Some(false), _) if bounded && near.iter().all(|&position| inner(position)) => {
                found.without.push(block.index);
            }
            // the only one that comes near is the one, and a simple eigenvalue of the block
            (Some(true), 1) if bounded => {
                found.positions.extend(near);
                found.indices.push(block.index);
            }
            // both saddles lie in one block
            (Some(true), 2)
                if SecondOrder::copies_in(valence, block.index) == 2
                    && bounded
                    && all_apart()
                    && near.iter().all(|&p| inner(p))
                    && facts.square_is_double(block.index, lambda.value) =>
            {
                found.positions.extend(near);
                found.indices.push(block.index);
            }
            // eigenvalues that are known as numbers
            _ if bounded && square.is_point() && all_apart() => {
                let equal = |&position: &usize| {
                    let value = spectrum.entries[position].value;
                    value.is_real() && value.re.is_point() && value.re == square
                };
                if near.iter().all(equal) {
                    found.positions.extend(near);
                    found.indices.push(block.index);
                }
            }
            _ => {}
        }
    }
    found
}

/// `bounded_curvature`, `non_degenerate` and `strict`.
pub fn second_order(
    subject: &Subject,
    spectrum: &EnclosedSpectrum,
    lambda: &Subdominant,
    facts: &mut Facts,
) -> [Check; 3] {
    let valence = subject.scheme.valence();
    let squares = squares(subject, spectrum, lambda, facts);
    [
        bounded(spectrum, lambda, &squares),
        non_degenerate(valence, spectrum, lambda, &squares),
        strict(subject, spectrum, lambda, &squares),
    ]
}

fn bounded(spectrum: &EnclosedSpectrum, lambda: &Subdominant, squares: &Squares) -> Check {
    const NAME: Statement = Statement::BoundedCurvature;
    let square = lambda.value.square();
    let ratio = |entry: &EnclosedEigenvalue| entry.value.modulus() / square;
    let others = || {
        let all = spectrum.entries.iter().enumerate();
        all.filter(|(position, _)| *position != lambda.position)
            .map(|(_, entry)| entry)
    };
    let larger = others().filter(|entry| square.certainly_lt(entry.value.modulus()) && entry.value.is_real());
    let mut larger: Vec<&EnclosedEigenvalue> = larger.collect();
    larger.sort_by(|a, b| b.value.modulus().lo().total_cmp(&a.value.modulus().lo()));
    if let Some(entry) = larger.into_iter().find(|entry| spectrum.sees(entry)) {
        let text = format!(
            "an eigenvalue of block {} is {} lambda^2: mu = {}, lambda = {}",
            entry.index,
            digits(ratio(entry).mid()),
            digits(entry.value.modulus().mid()),
            digits(lambda.value.mid())
        );
        let witness = named(Witness::new(text), entry)
            .with("ratio", ratio(entry))
            .with("lambda", lambda.value);
        return Check::refuted(NAME, witness).enclosing(ratio(entry));
    }
    let except: Vec<usize> = squares.positions.iter().copied().chain([lambda.position]).collect();
    let Some((modulus, index)) = spectrum.largest_other(&except) else {
        return Check::undecided(NAME, "no further eigenvalues");
    };
    if !modulus.certainly_lt(square) {
        let text = format!(
            "block {index} has an eigenvalue of modulus up to {}, lambda^2 is {square}: where they are equal a Jordan block may decide",
            digits(modulus.hi())
        );
        return Check::undecided(NAME, text);
    }
    let (enclosure, margin) = if squares.positions.is_empty() {
        let ratio = modulus / square;
        (ratio, (Interval::point(1.0) - ratio).lo())
    } else {
        (Interval::point(1.0), 0.0)
    };
    Check::proven(NAME).margin(margin).enclosing(enclosure)
}

fn non_degenerate(valence: usize, spectrum: &EnclosedSpectrum, lambda: &Subdominant, squares: &Squares) -> Check {
    const NAME: Statement = Statement::NonDegenerate;
    let square = lambda.value.square();
    for SecondOrder {
        block: index,
        copies: wanted,
        ..
    } in SecondOrder::of(valence)
    {
        let others = spectrum.entries.iter().enumerate();
        let mut in_block: Vec<&EnclosedEigenvalue> = others
            .filter(|(position, e)| *position != lambda.position && e.index == index)
            .map(|(_, entry)| entry)
            .collect();
        in_block.sort_by(|a, b| b.value.modulus().mid().total_cmp(&a.value.modulus().mid()));
        if squares.without.contains(&index) {
            let nearest = in_block
                .get(wanted - 1)
                .map_or(Interval::point(0.0), |entry| entry.value.re);
            let ratio = nearest / square;
            let text = format!("block {index}: mu is {} lambda^2", digits(ratio.mid()));
            let witness = Witness::new(text).with("mu", nearest).with("ratio", ratio);
            return Check::refuted(NAME, witness).enclosing(ratio);
        }
        // one of two saddles in one block has it, the other has not
        let candidates = in_block.iter().filter(|e| !e.value.re.disjoint(square)).count();
        let bounded = spectrum
            .bounds
            .iter()
            .all(|b| b.index != index || b.radius < square.lo());
        if candidates < wanted && bounded {
            let other = in_block.iter().find(|e| e.value.re.disjoint(square));
            let mu = other.map_or(Interval::point(0.0), |entry| entry.value.re);
            let text = format!(
                "block {index}: a second-order eigenvalue is {} lambda^2",
                digits((mu / square).mid())
            );
            let witness = Witness::new(text).with("mu", mu).with("ratio", mu / square);
            return Check::refuted(NAME, witness).enclosing(mu / square);
        }
        if !squares.indices.contains(&index) {
            return Check::undecided(
                NAME,
                format!("block {index}: equality with lambda^2 = {square} is not decided"),
            );
        }
    }
    Check::proven(NAME)
        .enclosing(square)
        .remark("eigenvalue lambda^2 in the blocks of index 0, 2 and N-2")
}

fn strict(subject: &Subject, spectrum: &EnclosedSpectrum, lambda: &Subdominant, squares: &Squares) -> Check {
    const NAME: Statement = Statement::Strict;
    let valence = subject.scheme.valence();
    let sharp = |position: usize| -> Eigenvalue {
        let value = spectrum.entries[position].value;
        let known = if squares.positions.contains(&position) {
            lambda.value.square()
        } else {
            subject.identities.map_or(Interval::ENTIRE, |identities| identities.mu)
        };
        value.re.intersect(known).map_or(value, |re| Eigenvalue { re, ..value })
    };
    // the three second-order eigenvalues: the largest of their blocks
    let mut chosen = vec![lambda.position];
    let mut mu: Option<Interval> = None;
    for SecondOrder {
        block: index, copies, ..
    } in SecondOrder::of(valence)
    {
        for _ in 0..copies {
            let entries = spectrum.entries.iter().enumerate();
            let next = entries
                .filter(|(position, entry)| entry.index == index && !chosen.contains(position))
                .max_by(|a, b| a.1.value.modulus().mid().total_cmp(&b.1.value.modulus().mid()));
            let Some((position, entry)) = next.filter(|(_, entry)| entry.value.is_real()) else {
                return Check::undecided(
                    NAME,
                    format!("block {index} has no second-order eigenvalue that is proven to be real"),
                );
            };
            chosen.push(position);
            // identities hold for the second-order values only; elsewhere intersect() finds nothing in common
            let value = if entry
                .value
                .re
                .disjoint(subject.identities.map_or(entry.value.re, |i| i.mu))
            {
                entry.value.re
            } else {
                sharp(position).re
            };
            mu = Some(mu.map_or(value.abs(), |mu| mu.min(value.abs())));
        }
    }
    let Some(mu) = mu else {
        return Check::undecided(NAME, "no second-order eigenvalues");
    };
    // one that is only bounded may be the second-order eigenvalue of its block
    let hidden = spectrum
        .bounds
        .iter()
        .find(|bound| SecondOrder::copies_in(valence, bound.index) > 0 && bound.radius >= mu.lo());
    if let Some(bound) = hidden {
        return Check::undecided(
            NAME,
            format!(
                "block {} has eigenvalues of modulus up to {}, which may be mu",
                bound.index, bound.radius
            ),
        );
    }
    let Some((other, index)) = spectrum.largest_other(&chosen) else {
        return Check::undecided(NAME, "no further eigenvalues");
    };
    let ratio = other / mu;
    // within a block the chosen ones must be known to come first
    let comes_after = |entry: &EnclosedEigenvalue| {
        let before = chosen[1..].iter().map(|&position| &spectrum.entries[position]);
        before
            .filter(|first| first.index == entry.index)
            .all(|first| first.value.modulus().lo() >= entry.value.modulus().hi())
    };
    let larger = spectrum.entries.iter().enumerate().find(|(position, entry)| {
        !chosen.contains(position) && entry.value.modulus().lo() > mu.hi() && comes_after(entry)
    });
    if let Some((_, entry)) = larger {
        let text = format!(
            "an eigenvalue of block {} has modulus {}, mu is {}",
            entry.index,
            digits(entry.value.modulus().mid()),
            digits(mu.mid())
        );
        return Check::refuted(NAME, named(Witness::new(text), entry).with("mu", mu))
            .enclosing(entry.value.modulus() / mu);
    }
    if !other.certainly_lt(mu) {
        return Check::undecided(
            NAME,
            format!(
                "block {index} has an eigenvalue of modulus up to {}, mu is {mu}",
                digits(other.hi())
            ),
        );
    }
    Check::proven(NAME)
        .margin((Interval::point(1.0) - ratio).lo())
        .enclosing(ratio)
}
