//! Statements about eigenvalues of rules that differ from sector to sector: the one matrix of all points.
//!
//! With `1 > lambda_1 >= lambda_2 > ..` real and positive, and two eigenvectors x, y of the pair, rings
//! scaled by the powers of both tend, for almost all data, to affine images of the map (x, y), if
//!
//! * both are simple and proven to **differ**; or
//! * they are 1/2 twice, with the **coordinates** of the plane as eigenvectors, exactly
//!   ([`coordinates`](crate::patches::coordinates())), and what is left without these has smaller eigenvalues
//!   only: the double value is semisimple then.
//!
//! The rest is as for a double eigenvalue of Fourier index 1 (D. Zorin 2000, *Smoothness of stationary
//! subdivision on irregular meshes*, Constructive Approximation 16). Of a double value that is neither no
//! enclosure can tell whether it has a Jordan block.
//!
//! **Curvature.** Let p, q be what data have of x and y, and let a further eigenvalue mu have the function f.
//! Over the tangent plane, with coordinates that shrink like `lambda_1^m` and `lambda_2^m`, the part of f in
//! the surface has second derivatives `(mu/lambda_1^2)^m f_xx`, `(mu/(lambda_1 lambda_2))^m f_xy`,
//! `(mu/lambda_2^2)^m f_yy`. All of them tend to 0 if every further |mu| is below `lambda_2^2`: curvature is
//! bounded. If some real |mu| exceeds `lambda_1^2` and its f is seen, curvature grows: f is C1 on a connected
//! ring, at a crease cut open, so that it would be linear where all three vanish, and would scale with 1,
//! lambda_1 or lambda_2. Between the two squares nothing is said.

use super::named;
use crate::interval::digits;
use crate::linear::Eigenvalue;
use crate::spectral::{EnclosedEigenvalue, EnclosedSpectrum};
use crate::{Check, Interval, Statement, Witness};

/// The pair of subdominant eigenvalues.
#[derive(Clone, Debug)]
pub struct Leading {
    /// The eigenvalues, the larger first.
    pub values: [Interval; 2],
    /// Their positions among the entries of the spectrum; none for the coordinates of the plane, which are
    /// not among them.
    positions: Vec<usize>,
    /// The two eigenvectors, where they could be enclosed: a value for each point.
    pub vectors: Option<[Vec<Interval>; 2]>,
}

/// `dominant`, of rules whose rows sum to 1.
pub fn dominant(spectrum: &EnclosedSpectrum) -> Check {
    let check = super::dominant(spectrum);
    match (&spectrum.coordinates, check.margin, check.enclosure) {
        // 1/2 is an eigenvalue too
        (Some(_), Some(margin), Some(enclosure)) => check
            .margin(margin.min(0.5))
            .enclosing(enclosure.max(Interval::point(0.5))),
        _ => check,
    }
}

/// `subdominant`, and the pair if it was proven.
pub fn subdominant(spectrum: &EnclosedSpectrum) -> (Check, Option<Leading>) {
    match &spectrum.coordinates {
        Some(parts) => plane(spectrum, parts),
        None => distinct(spectrum),
    }
}

const SUBDOMINANT: Statement = Statement::Subdominant;

fn open(text: String) -> (Check, Option<Leading>) {
    (Check::undecided(SUBDOMINANT, text), None)
}

fn plane(spectrum: &EnclosedSpectrum, parts: &[Vec<Interval>; 2]) -> (Check, Option<Leading>) {
    let half = Interval::point(0.5);
    let (other, _) = spectrum.largest_other(&[]).unwrap_or((Interval::point(0.0), 0));
    if !other.certainly_lt(half) {
        return open(format!(
            "an eigenvalue has a modulus up to {}, and the coordinates of the plane have 1/2",
            digits(other.hi())
        ));
    }
    let margin = (Interval::point(1.0) - other / half).lo();
    let remark = "the rules halve the coordinates of the plane: 1/2 twice, with two eigenvectors";
    let check = Check::proven(SUBDOMINANT).margin(margin).enclosing(half).remark(remark);
    let leading = Leading {
        values: [half; 2],
        positions: Vec::new(),
        vectors: Some(parts.clone()),
    };
    (check, Some(leading))
}

fn distinct(spectrum: &EnclosedSpectrum) -> (Check, Option<Leading>) {
    let mut order: Vec<usize> = (0..spectrum.entries.len()).collect();
    let modulus = |position: usize| spectrum.entries[position].value.modulus();
    order.sort_by(|&a, &b| modulus(b).mid().total_cmp(&modulus(a).mid()));
    let &[first, second, ..] = order.as_slice() else {
        return open("fewer than two eigenvalues were enclosed one by one".to_owned());
    };
    let pair = [first, second].map(|position| spectrum.entries[position].value);
    let [larger, smaller] = pair.map(|value| value.re);
    if !pair
        .iter()
        .all(|value| value.is_real() && value.re.certainly_positive())
    {
        return open("the two largest eigenvalues are not known to be real and positive".to_owned());
    }
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
            digits(other.hi())
        ));
    }
    let margin = (Interval::point(1.0) - other / smaller).lo();
    let remark = format!(
        "rules differ from sector to sector: a pair of different eigenvalues, {} and {}",
        digits(larger.mid()),
        digits(smaller.mid())
    );
    let check = Check::proven(SUBDOMINANT)
        .margin(margin)
        .enclosing(larger)
        .remark(remark);
    let vector = |position: usize| spectrum.points(&spectrum.entries[position]);
    let leading = Leading {
        values: [larger, smaller],
        positions: vec![first, second],
        vectors: vector(first).zip(vector(second)).map(<[_; 2]>::from),
    };
    (check, Some(leading))
}

/// `bounded_curvature`; see the module page. `tending` says that levels tend to the limit level like `4^-l`,
/// by which the part of lambda_1 leaves one of the size of `(lambda_1/4)^l` in all others.
pub fn curvature(spectrum: &EnclosedSpectrum, leading: &Leading, tending: bool) -> Check {
    const NAME: Statement = Statement::BoundedCurvature;
    let [larger, smaller] = leading.values.map(Interval::square);
    let others = spectrum.entries.iter().enumerate();
    let others = others.filter(|(position, _)| !leading.positions.contains(position));
    let mut beyond: Vec<&EnclosedEigenvalue> = others
        .map(|(_, entry)| entry)
        .filter(|entry| entry.value.is_real() && larger.certainly_lt(entry.value.modulus()))
        .collect();
    let size = |value: Eigenvalue| value.modulus().lo();
    beyond.sort_by(|a, b| size(b.value).total_cmp(&size(a.value)));
    if let Some(entry) = beyond.into_iter().find(|entry| spectrum.sees(entry)) {
        let ratio = entry.value.modulus() / larger;
        let text = format!(
            "an eigenvalue is {} lambda^2: mu = {}, lambda = {}",
            digits(ratio.mid()),
            digits(entry.value.modulus().mid()),
            digits(leading.values[0].mid())
        );
        let witness = named(Witness::new(text), entry)
            .with("ratio", ratio)
            .with("lambda", leading.values[0]);
        return Check::refuted(NAME, witness).enclosing(ratio);
    }
    let Some((modulus, _)) = spectrum.largest_other(&leading.positions) else {
        return Check::undecided(NAME, "no further eigenvalues");
    };
    if !modulus.certainly_lt(smaller) {
        let text = format!(
            "an eigenvalue has a modulus up to {}, the square of the smaller subdominant one is {smaller}",
            digits(modulus.hi())
        );
        return Check::undecided(NAME, text);
    }
    if tending && !(Interval::point(0.25) * leading.values[0]).certainly_lt(smaller) {
        let text = "a quarter of the larger subdominant eigenvalue is not below the square of the smaller: levels may differ for too long";
        return Check::undecided(NAME, text);
    }
    let ratio = modulus / smaller;
    let margin = (Interval::point(1.0) - ratio).lo();
    Check::proven(NAME).margin(margin).enclosing(ratio)
}
