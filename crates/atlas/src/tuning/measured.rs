//! The measures and conditions of a scheme at a valence.
//!
//! They are the numbers that `compare` and `objective` print. A search takes eigenvalues in doubles, without
//! the multiplicities that cost a hundred times as much; what is reported is computed as these commands do.

use super::goal::{Condition, Goal, Measure};
use crate::compare::{QUADRATURE, comparable, hull, spans};
use crate::spectrum::Analysis;
use eigenring_scheme::{Lattice, Level, Scheme, Site};
use eigenring_spectral::{Annulus, Extended, LocalSystem, NaturalMode, Spectrum, Sufficient, outer};
use eigenring_spline::uniform::basis;
use eigenring_tune::quality::Quality;
use std::cell::OnceCell;

/// Rings of the natural configuration whose edges are measured around a vertex; one less around a face.
const EDGE_RINGS: i32 = 2;

/// Moduli that are this close are equal: rounding, with room for condition numbers up to 1e6.
const EQUAL: f64 = 1e-9;

/// Weights below this are zeros that a formula does not make exactly.
const ZERO: f64 = 1e-14;

/// How far from zero weights stay that may not be negative, for rounding.
const HULL_MARGIN: f64 = 1e-12;

/// A scheme, and what has been computed of it.
pub(super) struct Measured<'a> {
    scheme: &'a Scheme<f64>,
    /// As `compare` does it, with these rules, or as fast as it goes.
    full: Option<&'a Scheme<Extended>>,
    spectrum: OnceCell<Option<(Spectrum, f64)>>,
    quality: OnceCell<Option<Quality>>,
    hull: OnceCell<Option<f64>>,
}

impl<'a> Measured<'a> {
    pub(super) fn fast(scheme: &'a Scheme<f64>) -> Self {
        Measured {
            scheme,
            full: None,
            spectrum: OnceCell::new(),
            quality: OnceCell::new(),
            hull: OnceCell::new(),
        }
    }

    /// Multiplicities are told from the rules in more precision, as `compare` does.
    pub(super) fn full(scheme: &'a Scheme<f64>, extended: &'a Scheme<Extended>) -> Self {
        Measured {
            full: Some(extended),
            ..Measured::fast(scheme)
        }
    }

    /// The eigenvalues, and the largest modulus of those that are not listed.
    pub(super) fn spectrum(&self) -> Option<&(Spectrum, f64)> {
        let find = || {
            if let Some(extended) = self.full {
                let analysis = Analysis::of_rules(self.scheme, Some(extended), None, None).ok()?;
                let beyond = analysis.beyond(self.scheme).ok()?;
                return Some((analysis.spectrum, beyond));
            }
            let closed = self.scheme.closed_rings().ok()?;
            let Sufficient { system, outer: found } = Sufficient::new(self.scheme.limit(), closed).ok()?;
            let rings = system.numbering().rings;
            let beyond = match rings == closed {
                true => found,
                false => outer(self.scheme.limit(), rings).ok()?,
            };
            Some((system.eigenvalues().ok()?, beyond))
        };
        self.spectrum.get_or_init(find).as_ref()
    }

    /// The maps, where E and K_m mean something: of bicubic schemes around a vertex.
    fn quality(&self) -> Option<&Quality> {
        let find = || {
            let (affine, spanned) = spans(&self.spectrum()?.0);
            let quality = Quality::new(self.scheme, QUADRATURE)
                .ok()
                .filter(|_| affine && spanned)?;
            // where the characteristic map folds over there is no function to differentiate
            comparable(self.scheme, quality).filter(|quality| quality.jacobian_min > 0.0)
        };
        self.quality.get_or_init(find).as_ref()
    }

    fn hull(&self) -> Option<f64> {
        *self.hull.get_or_init(|| hull(self.scheme).ok().flatten())
    }

    /// What is minimised; NaN where it is not defined.
    pub(super) fn value(&self, goal: &Goal) -> f64 {
        let terms = goal.terms.iter();
        let terms: f64 = terms
            .map(|(factor, measure)| factor * self.measure(*measure).unwrap_or(f64::NAN))
            .sum();
        terms + goal.own.as_ref().map_or(0.0, |own| (own.value)(self.scheme))
    }

    fn measure(&self, measure: Measure) -> Option<f64> {
        match measure {
            Measure::Weighted => Some(self.quality()?.weighted()),
            Measure::Unweighted => Some(self.quality()?.total()),
            Measure::Ratio => Some((self.spectrum()?.0.curvature_ratio()? - 1.0).abs()),
            Measure::Lambda(target) => {
                let spectrum = &self.spectrum()?.0;
                let lambda = spectrum.subdominant().filter(|_| spectrum.stray().is_none())?;
                Some((lambda.modulus() - target).abs())
            }
            Measure::SignChange => Some(self.quality()?.sign_change()),
            Measure::Strictness => {
                let (spectrum, beyond) = self.spectrum()?;
                spectrum.sixth(self.scheme.valence(), *beyond)
            }
            Measure::Hull => Some(-self.hull()?),
            Measure::Polar => {
                let lambda = self.spectrum()?.0.subdominant()?;
                polar(self.scheme.limit(), lambda.value.re)
            }
        }
    }

    /// How far a condition is from failing: negative where it does, NaN where it cannot be judged, infinite
    /// where an equality holds by the rules. Moduli that must stay below others do so by a relative `margin`;
    /// `identity` says that mu is lambda^2 whatever the parameters are.
    pub(super) fn slack(&self, condition: Condition, margin: f64, identity: bool) -> f64 {
        let slack = || match condition {
            Condition::Hull => Some(match self.hull()? {
                least if least.abs() < ZERO => f64::INFINITY,
                least => least - HULL_MARGIN,
            }),
            Condition::Bounded => {
                let above = self.spectrum()?.0.curvature_ratio()? - 1.0;
                Some(match identity && above.abs() <= EQUAL {
                    true => f64::INFINITY,
                    false => -above - margin,
                })
            }
            Condition::Order => {
                let (spectrum, beyond) = self.spectrum()?;
                Some(1.0 - spectrum.sixth(self.scheme.valence(), *beyond)? - margin)
            }
            Condition::C1 => self.regular(margin),
        };
        slack().unwrap_or(f64::NAN)
    }

    /// Whether mu is lambda^2, up to rounding.
    pub(super) fn is_tight(&self) -> Option<bool> {
        Some((self.spectrum()?.0.curvature_ratio()? - 1.0).abs() <= EQUAL)
    }

    /// What is necessary for C1: 1 leads, a real positive pair of index 1 follows, and the Jacobian of the
    /// characteristic map is positive where it is looked at.
    fn regular(&self, margin: f64) -> Option<f64> {
        let spectrum = &self.spectrum()?.0;
        let (affine, _) = spans(spectrum);
        let pair = spectrum.subdominant()?;
        let leads = affine && pair.fourier == Some(1) && pair.value.im == 0.0 && pair.value.re > 0.0;
        if !leads || pair.multiplicity != pair.blocks {
            return Some(-1.0);
        }
        let next = spectrum.eigenvalues.get(2).map_or(0.0, |next| next.modulus());
        let gaps = [1.0 - pair.modulus(), 1.0 - next / pair.modulus()].map(|gap| gap - margin);
        Some(jacobian(self.scheme)?.min(gaps[0]).min(gaps[1]))
    }
}

/// The smallest Jacobian of the characteristic map beside the largest, at nine points of each patch of a
/// sector.
fn jacobian(scheme: &Scheme<f64>) -> Option<f64> {
    let annulus = Annulus::new(scheme).ok()?;
    let system = LocalSystem::new(scheme.limit(), annulus.numbering.rings).ok()?;
    let natural = system.natural().ok()?;
    let functions = [0.0, 0.5, 1.0].map(|t| basis(annulus.degree, t));
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for patch in annulus.patches(0) {
        let [x, y] = natural.points.each_ref().map(|net| annulus.patch(net, patch));
        for in_u in &functions {
            for in_v in &functions {
                let (x, y) = (x.jet_in(in_u, in_v), y.jet_in(in_u, in_v));
                let jacobian = x.first[0] * y.first[1] - x.first[1] * y.first[0];
                least = least.min(jacobian);
                most = most.max(jacobian.abs());
            }
        }
    }
    (most > 0.0).then_some(least / most)
}

/// The variance of the lengths of the edges of the natural configuration within two rings around a vertex, or
/// the face and one ring around it, their mean being 1. It vanishes for the regular net, whose edges are all
/// alike, and grows where refined edges shrink by another factor than 1/2.
fn polar(level: &Level<f64>, lambda: f64) -> Option<f64> {
    let parity = level.lattice().parity();
    let last = 2 * EDGE_RINGS - parity;
    // edges may lead to points of the next sectors, which are within the same rings
    let mode = NaturalMode::new(level, level.closed_rings().ok()?.max(EDGE_RINGS as usize), lambda).ok()?;
    let at = |x: i32, y: i32| mode.at(Site::new(level.fan(), 0, x, y)?).ok();
    let first = -parity;
    let mut lengths = Vec::new();
    for along in (first..last).step_by(2) {
        for across in (parity..=last).step_by(2) {
            // along the own spoke from `along`, and across it; edges on the next spoke, and those that cross
            // it, are of the next sector
            let mut ends = Vec::new();
            if along >= 0 {
                ends.push([(along, across), (along + 2, across)]);
            }
            if level.lattice() == Lattice::Face || across > 0 {
                ends.push([(across, along), (across, along + 2)]);
            }
            for [from, to] in ends {
                let ([ax, ay], [bx, by]) = (at(from.0, from.1)?, at(to.0, to.1)?);
                lengths.push((ax - bx).hypot(ay - by));
            }
        }
    }
    let count = lengths.len() as f64;
    let mean = lengths.iter().sum::<f64>() / count;
    let squares = lengths.iter().map(|length| (length / mean - 1.0).powi(2));
    Some(squares.sum::<f64>() / count).filter(|variance| variance.is_finite())
}
