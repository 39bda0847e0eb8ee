//! Statements about eigenvalues.
//!
//! With the eigenvalues `1 > lambda = lambda > ...` of the local matrix on all rings that determine the
//! patches:
//!
//! | check | statement | source |
//! |---|---|---|
//! | `dominant` | 1 is simple, all others lie inside the unit disc | convergence (Reif 1995) |
//! | `subdominant` | lambda is real and positive, simple in the blocks of index 1 and N-1, and larger in modulus than all others | Peters and Reif 1998, *Analysis of algorithms generalizing B-spline subdivision* |
//! | `bounded_curvature` | all others have a modulus of at most `lambda^2`, with equality only for values without Jordan block | Doo and Sabin 1978; Peters and Reif 2008, *Subdivision Surfaces*, section 7 |
//! | `non_degenerate` | `lambda^2` is an eigenvalue in the blocks 0, 2 and N-2: curvatures have a limit that is not zero | Prautzsch and Umlauf; Ma, Wang and Ma 2023 |
//! | `strict` | all eigenvalues after these three are smaller in modulus | Ma, Wang and Ma 2023, Eq. 26 |
//!
//! At N = 3 index 2 is index N-1, and the second value of block 1 takes its part; at N = 4 both saddles are
//! in block 2. Inequalities are decided by enclosures, equalities exactly ([`Facts`]). Where a Jordan block
//! could decide, an enclosure that does not exceed another one proves nothing: the value is strictly below,
//! or it is exactly the same and known to be semisimple.
//!
//! **What refutes.** These statements are sufficient for C1; one that does not hold is *undecided* unless a
//! theorem says that the surface is not C1, or its curvature not bounded, with an eigenvector that the
//! surface is proven to see ([`Spectrum::sees`](crate::spectral::Spectrum::sees)) as its witness:
//!
//! * `dominant`: an eigenvalue other than the constant vector's has a modulus of 1 or more. Data with a part
//!   in its eigenvector, which almost all have, do not converge to a point at the centre (Peters and Reif
//!   2008, section 4.2).
//! * `subdominant`: a real positive eigenvalue of Fourier index 2 to (N-1)/2, simple in its block, leads all
//!   others: its characteristic map winds so many times round the centre (Peters and Reif 2008, section 5.3);
//!   or a negative one of index 1, simple and alone in modulus, in rules with mirror symmetry: the image of a
//!   spoke lies on the mirror and leads from one side of the centre to the other within the annulus, so that
//!   the map is not injective (*ibid.*).
//! * `bounded_curvature`: a real eigenvalue exceeds lambda^2 in modulus. Over the tangent plane its part of
//!   the surface grows by its ratio to lambda^2 a level; its second derivatives do not all vanish, since a
//!   function that is linear on the rings scales with 1 or lambda (Peters and Reif 2008, section 7).

use crate::exact::{self, Field, Poly, block_polynomial};
use crate::linear::Eigenvalue;
use crate::spectral::{Entry, Spectrum};
use crate::{Check, Interval, Statement, Subject, Witness};
use std::collections::BTreeMap;

/// The subdominant eigenvalue.
#[derive(Clone, Copy, Debug)]
pub struct Subdominant {
    /// Its position among the entries of the spectrum.
    pub position: usize,
    /// Its sharpest enclosure.
    pub value: Interval,
}

/// `dominant`, of rules whose rows sum to 1.
pub fn dominant(spectrum: &Spectrum) -> Check {
    const NAME: Statement = Statement::Dominant;
    let one = Interval::point(1.0);
    let outside = spectrum
        .entries
        .iter()
        .find(|entry| one.certainly_le(entry.value.modulus()) && entry.value.is_real() && spectrum.sees(entry));
    if let Some(entry) = outside {
        let text = format!(
            "an eigenvalue of block {} has modulus {}",
            entry.index,
            entry.value.modulus().mid()
        );
        return Check::refuted(NAME, named(Witness::new(text), entry));
    }
    let Some((modulus, index)) = spectrum.largest_other(&[]) else {
        return Check::undecided(NAME, "no eigenvalues");
    };
    let margin = (one - modulus).lo();
    if margin > 0.0 {
        Check::proven(NAME).margin(margin).enclosing(modulus)
    } else {
        Check::undecided(
            NAME,
            format!("block {index}: an eigenvalue of modulus up to {}", modulus.hi()),
        )
    }
}

fn named(witness: Witness, entry: &Entry) -> Witness {
    witness.with("re", entry.value.re).with("im", entry.value.im)
}

/// `subdominant`, and the eigenvalue if it was proven.
pub fn subdominant(subject: &Subject, spectrum: &Spectrum, facts: &mut Facts) -> (Check, Option<Subdominant>) {
    const NAME: Statement = Statement::Subdominant;
    let open = |text: String| (Check::undecided(NAME, text), None);
    let refuted = |witness: Witness| (Check::refuted(NAME, witness), None);
    match spectrum.block(1).map(|block| block.is_real()) {
        Some(true) => {}
        Some(false) => {
            return open("the rules have no mirror symmetry: real eigenvalues are not told from others".into());
        }
        None => return open("the rules differ from sector to sector".into()),
    }
    let of_index_1 = |&(_, entry): &(usize, &Entry)| entry.index == 1;
    let entries = || spectrum.entries.iter().enumerate();
    let Some((position, leading)) = entries()
        .filter(of_index_1)
        .max_by(|a, b| a.1.value.modulus().mid().total_cmp(&b.1.value.modulus().mid()))
    else {
        return open("no eigenvalue of block 1 was enclosed".into());
    };
    let mut value = leading.value.re;
    if let Some(identities) = subject.identities {
        value = value.intersect(identities.lambda).unwrap_or(value);
    }
    let modulus = if leading.value.is_real() {
        value.abs()
    } else {
        leading.value.modulus()
    };
    let beside = |index: usize| move |entry: &&Entry| entry.index == index;
    // larger than all of block 1, wherever it is
    let reach = entries()
        .filter(of_index_1)
        .map(|(_, entry)| entry.value.modulus().hi())
        .chain(
            spectrum
                .bounds
                .iter()
                .filter(|bound| bound.index == 1)
                .map(|bound| bound.radius),
        )
        .fold(0.0, f64::max);
    let larger = spectrum
        .entries
        .iter()
        .filter(|entry| entry.index != 1 && entry.value.modulus().lo() > reach);
    if let Some(entry) = larger.max_by(|a, b| a.value.modulus().lo().total_cmp(&b.value.modulus().lo())) {
        let text = format!(
            "an eigenvalue of block {} has modulus {}, block 1 has none above {reach}",
            entry.index,
            entry.value.modulus().mid()
        );
        let n = subject.scheme.valence();
        // a pair of index k, simple and ahead of everything else, belongs to a map that winds k times round
        // the centre
        let pair =
            (2..n.div_ceil(2)).contains(&entry.index) && entry.value.is_real() && entry.value.re.certainly_positive();
        if pair && spectrum.leads(entry) && spectrum.sees(entry) {
            return refuted(named(Witness::new(text), entry).with("fourier", Interval::point(entry.index as f64)));
        }
        return open(text);
    }
    let others = spectrum.largest_other(&[position]);
    let (other, index) = others.unwrap_or((Interval::point(0.0), 0));
    let within = spectrum
        .entries
        .iter()
        .enumerate()
        .filter(|(other, entry)| *other != position && beside(1)(entry))
        .map(|(_, entry)| entry.value.modulus())
        .chain(
            spectrum
                .bounds
                .iter()
                .filter(|bound| bound.index == 1)
                .map(|bound| Interval::new(0.0, bound.radius).unwrap_or(Interval::ENTIRE)),
        );
    let leads_block = within.map(Interval::hi).fold(0.0, f64::max) < modulus.lo();
    if leads_block && leading.value.is_real() && value.certainly_negative() {
        let text = format!("the largest eigenvalue of block 1 is {}, not positive", value.mid());
        if spectrum.leads(leading) && spectrum.sees(leading) {
            return refuted(named(Witness::new(text), leading));
        }
        return open(text);
    }
    if leading.value.im.certainly_nonzero() {
        return open(format!(
            "the largest eigenvalues of block 1 are {} +- {} i: the criterion is for real ones",
            leading.value.re.mid(),
            leading.value.im.mid().abs()
        ));
    }
    if !leading.value.is_real() || !value.certainly_positive() {
        return open(format!(
            "the largest eigenvalue of block 1 is not known to be real and positive: {value}"
        ));
    }
    if !other.certainly_lt(value) {
        let enclosed = spectrum
            .bounds
            .iter()
            .all(|bound| bound.index != 1 || bound.radius < value.lo());
        if index == 1 && enclosed && facts.repeated(spectrum, leading) == Some(true) {
            return open(format!(
                "{} is a repeated eigenvalue of block 1, which outer rings share: the criterion is for simple ones",
                value.mid()
            ));
        }
        return open(format!(
            "block {index} has an eigenvalue of modulus up to {}, lambda is {value}",
            other.hi()
        ));
    }
    let margin = (Interval::point(1.0) - other / value).lo();
    let check = Check::proven(NAME).margin(margin).enclosing(value);
    (check, Some(Subdominant { position, value }))
}

/// `subdominant` for rules that differ from sector to sector: two real positive eigenvalues, both simple, the
/// second larger in modulus than all others, and both of them, if that was proven.
///
/// Where the two are equal, the one matrix that there is has them as a double eigenvalue, of which no
/// enclosure can tell whether it is semisimple: undecided.
pub fn distinct_pair(spectrum: &Spectrum) -> (Check, Option<[Subdominant; 2]>) {
    const NAME: Statement = Statement::Subdominant;
    let open = |text: String| (Check::undecided(NAME, text), None);
    let mut order: Vec<usize> = (0..spectrum.entries.len()).collect();
    let modulus = |position: usize| spectrum.entries[position].value.modulus();
    order.sort_by(|&a, &b| modulus(b).mid().total_cmp(&modulus(a).mid()));
    let &[first, second, ..] = order.as_slice() else {
        return open("fewer than two eigenvalues were enclosed one by one".to_owned());
    };
    let pair = [first, second].map(|position| Subdominant {
        position,
        value: spectrum.entries[position].value.re,
    });
    let real = [first, second].map(|position| spectrum.entries[position].value.is_real());
    if !(real[0] && real[1] && pair.iter().all(|entry| entry.value.certainly_positive())) {
        return open("the two largest eigenvalues are not known to be real and positive".to_owned());
    }
    let [larger, smaller] = pair.map(|entry| entry.value);
    if !smaller.certainly_lt(larger) {
        return open(format!(
            "the two largest eigenvalues, {larger} and {smaller}, are not known to differ: a double one may have a Jordan block"
        ));
    }
    let others = spectrum.largest_other(&[first, second]);
    let (other, _) = others.unwrap_or((Interval::point(0.0), 0));
    if !other.certainly_lt(smaller) {
        return open(format!(
            "an eigenvalue has a modulus up to {}, the second one is {smaller}",
            other.hi()
        ));
    }
    let margin = (Interval::point(1.0) - other / smaller).lo();
    let remark = format!(
        "rules differ from sector to sector: a pair of different eigenvalues, {} and {}",
        larger.mid(),
        smaller.mid()
    );
    let check = Check::proven(NAME).margin(margin).enclosing(larger).remark(remark);
    (check, Some(pair))
}

/// Equalities, decided exactly: whether `lambda^2` is an eigenvalue of a block.
pub struct Facts<'a> {
    subject: &'a Subject,
    field: Option<Field>,
    polynomials: BTreeMap<(usize, usize), Option<Poly>>,
}

impl<'a> Facts<'a> {
    /// The facts of a subject. Polynomials are worked out when they are asked for.
    pub fn new(subject: &'a Subject) -> Self {
        Facts {
            subject,
            field: None,
            polynomials: BTreeMap::new(),
        }
    }

    fn polynomial(&mut self, index: usize, rings: usize) -> Option<(&Field, Poly)> {
        let exact = self.subject.exact.as_ref()?;
        let field = self.field.get_or_insert_with(|| Field::new(exact.valence()));
        let known = self
            .polynomials
            .entry((index, rings))
            .or_insert_with(|| block_polynomial(field, exact.limit(), rings, index));
        Some((&*field, known.clone()?))
    }

    /// Whether the square of lambda, an eigenvalue of block 1 that no other of the block comes near, is an
    /// eigenvalue of a block.
    fn square_in(&mut self, index: usize, lambda: Interval) -> Option<bool> {
        let valence = self.subject.scheme.valence();
        if let Some(identities) = self.subject.identities {
            let second_order = if valence == 3 {
                index <= 1
            } else {
                index == 0 || index == 2
            };
            return (second_order && identities.square).then_some(true);
        }
        let rings = self.subject.scheme.closed_rings().ok()?;
        let (_, first) = self.polynomial(1, rings)?;
        let (field, second) = self.polynomial(index, rings)?;
        exact::square_is_root(field, &first, &second, lambda)
    }

    /// Whether `lambda^2`, an eigenvalue of a block, is a repeated one there.
    fn square_is_double(&mut self, index: usize, lambda: Interval) -> bool {
        if self.subject.identities.is_some() {
            // block 2 at valence 4 is diagonal with the entries g3 = mu and f3 = mu
            return true;
        }
        let Ok(rings) = self.subject.scheme.closed_rings() else {
            return false;
        };
        let polynomial = self.polynomial(index, rings);
        polynomial.and_then(|(field, f)| exact::is_repeated(field, &f, lambda.square())) == Some(true)
    }

    /// Whether an eigenvalue of a block is repeated already on one ring more than the smallest net.
    fn repeated(&mut self, spectrum: &Spectrum, entry: &Entry) -> Option<bool> {
        let rings = self.subject.scheme.closed_rings().ok()? + 1;
        if !within(spectrum, entry, rings) {
            return None;
        }
        // no root in the hull of all that come near is simple: then this one is not
        let near = spectrum
            .entries
            .iter()
            .filter(|e| e.index == entry.index && !e.value.re.disjoint(entry.value.re));
        let hull = near.fold(entry.value.re, |hull, near| hull.hull(near.value.re));
        let (field, polynomial) = self.polynomial(entry.index, rings)?;
        exact::is_repeated(field, &polynomial, hull)
    }
}

/// Whether an eigenvalue is one of the smaller block on `rings` rings: that of a component inside them.
fn within(spectrum: &Spectrum, entry: &Entry, rings: usize) -> bool {
    let block = spectrum.block(entry.index).filter(|block| block.is_real());
    block.is_some_and(|block| block.ring(entry.component) <= rings)
}

/// The eigenvalues that are exactly `lambda^2` and without Jordan block: their positions among the entries,
/// and the Fourier indices that have them.
struct Squares {
    positions: Vec<usize>,
    indices: Vec<usize>,
    /// The indices that certainly have none.
    without: Vec<usize>,
}

fn squares(subject: &Subject, spectrum: &Spectrum, lambda: &Subdominant, facts: &mut Facts) -> Squares {
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
            // both saddles of valence 4 lie in block 2
            (Some(true), 2)
                if valence == 4
                    && block.index == 2
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
pub fn second_order(subject: &Subject, spectrum: &Spectrum, lambda: &Subdominant, facts: &mut Facts) -> [Check; 3] {
    let valence = subject.scheme.valence();
    let squares = squares(subject, spectrum, lambda, facts);
    [
        bounded(spectrum, lambda, &squares),
        non_degenerate(valence, spectrum, lambda, &squares),
        strict(subject, spectrum, lambda, &squares),
    ]
}

fn bounded(spectrum: &Spectrum, lambda: &Subdominant, squares: &Squares) -> Check {
    const NAME: Statement = Statement::BoundedCurvature;
    let square = lambda.value.square();
    let ratio = |entry: &Entry| entry.value.modulus() / square;
    let others = || {
        let all = spectrum.entries.iter().enumerate();
        all.filter(|(position, _)| *position != lambda.position)
            .map(|(_, entry)| entry)
    };
    let larger = others().filter(|entry| square.certainly_lt(entry.value.modulus()) && entry.value.is_real());
    let mut larger: Vec<&Entry> = larger.collect();
    larger.sort_by(|a, b| b.value.modulus().lo().total_cmp(&a.value.modulus().lo()));
    if let Some(entry) = larger.into_iter().find(|entry| spectrum.sees(entry)) {
        let text = format!(
            "an eigenvalue of block {} is {} lambda^2: mu = {}, lambda = {}",
            entry.index,
            ratio(entry).mid(),
            entry.value.modulus().mid(),
            lambda.value.mid()
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
            modulus.hi()
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

/// The indices, at most N/2, of the blocks in which the three second-order eigenvalues lie.
fn second_order_indices(valence: usize) -> [usize; 2] {
    if valence == 3 { [0, 1] } else { [0, 2] }
}

fn non_degenerate(valence: usize, spectrum: &Spectrum, lambda: &Subdominant, squares: &Squares) -> Check {
    const NAME: Statement = Statement::NonDegenerate;
    let square = lambda.value.square();
    for index in second_order_indices(valence) {
        let others = spectrum.entries.iter().enumerate();
        let mut in_block: Vec<&Entry> = others
            .filter(|(position, e)| *position != lambda.position && e.index == index)
            .map(|(_, entry)| entry)
            .collect();
        in_block.sort_by(|a, b| b.value.modulus().mid().total_cmp(&a.value.modulus().mid()));
        let wanted = if valence == 4 && index == 2 { 2 } else { 1 };
        if squares.without.contains(&index) {
            let nearest = in_block
                .get(wanted - 1)
                .map_or(Interval::point(0.0), |entry| entry.value.re);
            let ratio = nearest / square;
            let text = format!("block {index}: mu is {} lambda^2", ratio.mid());
            let witness = Witness::new(text).with("mu", nearest).with("ratio", ratio);
            return Check::refuted(NAME, witness).enclosing(ratio);
        }
        // one of the two saddles of valence 4 has it, the other has not
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
                (mu / square).mid()
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

fn strict(subject: &Subject, spectrum: &Spectrum, lambda: &Subdominant, squares: &Squares) -> Check {
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
    for index in second_order_indices(valence) {
        let wanted = if valence == 4 && index == 2 { 2 } else { 1 };
        for _ in 0..wanted {
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
        .find(|bound| second_order_indices(valence).contains(&bound.index) && bound.radius >= mu.lo());
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
    let comes_after = |entry: &Entry| {
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
            entry.value.modulus().mid(),
            mu.mid()
        );
        return Check::refuted(NAME, named(Witness::new(text), entry).with("mu", mu))
            .enclosing(entry.value.modulus() / mu);
    }
    if !other.certainly_lt(mu) {
        return Check::undecided(
            NAME,
            format!(
                "block {index} has an eigenvalue of modulus up to {}, mu is {mu}",
                other.hi()
            ),
        );
    }
    Check::proven(NAME)
        .margin((Interval::point(1.0) - ratio).lo())
        .enclosing(ratio)
}
