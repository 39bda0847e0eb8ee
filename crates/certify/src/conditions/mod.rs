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
//! surface is proven to see ([`sees`](crate::spectral::EnclosedSpectrum::sees)) as its witness:
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

pub mod differing;
mod facts;
mod second_order;

pub use facts::Facts;
pub use second_order::second_order;

use crate::interval::digits;
use crate::spectral::{EnclosedEigenvalue, EnclosedSpectrum};
use crate::{Check, Interval, Statement, Subject, Witness};

/// The subdominant eigenvalue.
#[derive(Clone, Copy, Debug)]
pub struct Subdominant {
    /// Its position among the entries of the spectrum.
    pub position: usize,
    /// Its sharpest enclosure.
    pub value: Interval,
}

/// `dominant`, of rules whose rows sum to 1.
pub fn dominant(spectrum: &EnclosedSpectrum) -> Check {
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
            digits(entry.value.modulus().mid())
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
            format!("block {index}: an eigenvalue of modulus up to {}", digits(modulus.hi())),
        )
    }
}

fn named(witness: Witness, entry: &EnclosedEigenvalue) -> Witness {
    witness.with("re", entry.value.re).with("im", entry.value.im)
}

/// `subdominant`, and the eigenvalue if it was proven.
pub fn subdominant(subject: &Subject, spectrum: &EnclosedSpectrum, facts: &mut Facts) -> (Check, Option<Subdominant>) {
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
    let of_index_1 = |&(_, entry): &(usize, &EnclosedEigenvalue)| entry.index == 1;
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
    let beside = |index: usize| move |entry: &&EnclosedEigenvalue| entry.index == index;
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
            digits(entry.value.modulus().mid())
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
        let text = format!(
            "the largest eigenvalue of block 1 is {}, not positive",
            digits(value.mid())
        );
        if spectrum.leads(leading) && spectrum.sees(leading) {
            return refuted(named(Witness::new(text), leading));
        }
        return open(text);
    }
    if leading.value.im.certainly_nonzero() {
        return open(format!(
            "the largest eigenvalues of block 1 are {} +- {} i: the criterion is for real ones",
            digits(leading.value.re.mid()),
            digits(leading.value.im.mid().abs())
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
                digits(value.mid())
            ));
        }
        return open(format!(
            "block {index} has an eigenvalue of modulus up to {}, lambda is {value}",
            digits(other.hi())
        ));
    }
    let margin = (Interval::point(1.0) - other / value).lo();
    let check = Check::proven(NAME).margin(margin).enclosing(value);
    (check, Some(Subdominant { position, value }))
}
