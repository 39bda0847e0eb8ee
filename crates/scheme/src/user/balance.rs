//! Weights that were rounded when they were written down.
//!
//! A program that prints weights prints them rounded, and their sums and symmetries then hold to the last
//! digits only. Taken literally such rules have no affine invariance and no mirror symmetry, which helps
//! nobody. Rules are therefore **balanced**, pass by pass, in exact arithmetic:
//!
//! 1. weights that a reflection in a spoke exchanges, and those of the centre that a rotation exchanges, are
//!    replaced by their mean where they differ by at most [`TOLERANCE`];
//! 2. a stencil whose weights sum to 1 within [`TOLERANCE`] is given the sum 1: the weight of the point
//!    itself takes the rest, or all weights alike where the point is not among its own sources.
//!
//! What differs by more is meant, and stays. [`Balance`] says how many stencils were changed and by how much.

use super::PassRules;
use super::formula::Residual;
use crate::{Exact, Fan, Scalar, Site};
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::collections::BTreeMap;

/// Weights and sums closer than this are meant to be equal: weights below 1 that were printed with 13 or more
/// decimals are off by less than a tenth of it, and no rule is known whose weights differ by so little on
/// purpose.
const TOLERANCE: f64 = 1e-12;

/// What balancing has changed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Balance {
    /// How many special stencils were changed.
    pub rows: usize,
    /// The largest change of a weight.
    pub largest: f64,
}

type Terms = BTreeMap<Site, BigRational>;

/// Balances the special stencils of all passes.
pub(super) fn balance(fan: Fan, passes: &mut [PassRules<Residual>]) -> Balance {
    let repeated = passes
        .iter()
        .flat_map(|pass| &pass.special)
        .all(|(site, _)| site.sector == 0);
    let mut found = Balance::default();
    for pass in passes {
        let written: BTreeMap<Site, Terms> = pass
            .special
            .iter()
            .filter_map(|(site, terms)| Some((*site, rational(terms)?)))
            .collect();
        let mut balanced = written.clone();
        if let Some(centre) = balanced.get_mut(&Site::CENTRE) {
            alike_in_all_sectors(fan, centre);
        }
        if !repeated {
            between_sectors(fan, &mut balanced);
        }
        mirror_images(fan, repeated, &mut balanced);
        for (site, terms) in &mut balanced {
            sum_to_one(*site, terms);
        }
        for (site, terms) in &mut pass.special {
            let (Some(before), Some(after)) = (written.get(site), balanced.get(site)) else {
                continue;
            };
            let changes = before.iter().map(|(source, weight)| (weight - &after[source]).abs());
            let largest = changes.max().unwrap_or_default();
            if !largest.is_zero() {
                found.rows += 1;
                found.largest = found.largest.max(largest.to_f64().unwrap_or(f64::INFINITY));
                for (source, weight) in terms.iter_mut() {
                    *weight = Residual::Value(Exact::rational(&after[source]));
                }
            }
        }
    }
    found
}

fn rational(terms: &[(Site, Residual)]) -> Option<Terms> {
    let term = |(site, weight): &(Site, Residual)| Some((*site, weight.exact()?.as_rational()?));
    terms.iter().map(term).collect()
}

fn is_rounding(difference: &BigRational) -> bool {
    difference
        .abs()
        .to_f64()
        .is_some_and(|difference| difference <= TOLERANCE)
}

/// Replaces the weights of the given sites by their mean where they are all there, and close.
fn level_out(terms: &mut Terms, sites: &[Site]) {
    let weights = sites.iter().map(|site| terms.get(site).cloned());
    let Some(mean) = weights
        .collect::<Option<Vec<_>>>()
        .and_then(|weights| mean_of(&weights))
    else {
        return;
    };
    for site in sites {
        terms.insert(*site, mean.clone());
    }
}

/// The weights of the centre are those of each sector.
fn alike_in_all_sectors(fan: Fan, centre: &mut Terms) {
    let first: Vec<Site> = centre
        .keys()
        .copied()
        .filter(|site| site.sector == 0 && *site != Site::CENTRE)
        .collect();
    for site in first {
        let orbit: Vec<Site> = (0..fan.sectors() as i64)
            .map(|sector| site.rotated(fan, sector))
            .collect();
        level_out(centre, &orbit);
    }
}

/// Stencils of the same point of every sector, where each is listed: weights at the same place are those of
/// each sector.
fn between_sectors(fan: Fan, stencils: &mut BTreeMap<Site, Terms>) {
    let n = fan.sectors() as i64;
    let first: Vec<Site> = stencils
        .keys()
        .copied()
        .filter(|site| site.sector == 0 && *site != Site::CENTRE)
        .collect();
    for site in first {
        for source in stencils[&site].keys().copied().collect::<Vec<_>>() {
            let places: Vec<(Site, Site)> = (0..n)
                .map(|by| (site.rotated(fan, by), source.rotated(fan, by)))
                .collect();
            let weight = |&(site, source): &(Site, Site)| stencils.get(&site)?.get(&source).cloned();
            let Some(weights) = places.iter().map(weight).collect::<Option<Vec<_>>>() else {
                continue;
            };
            let Some(mean) = mean_of(&weights) else { continue };
            for (site, source) in places {
                if let Some(terms) = stencils.get_mut(&site) {
                    terms.insert(source, mean.clone());
                }
            }
        }
    }
}

/// The mean of weights that are close but not equal.
fn mean_of(weights: &[BigRational]) -> Option<BigRational> {
    let (least, most) = (weights.iter().min()?, weights.iter().max()?);
    if least == most || !is_rounding(&(most - least)) {
        return None;
    }
    Some(weights.iter().sum::<BigRational>() / BigRational::from_integer(weights.len().into()))
}

/// Weights that a reflection exchanges, of one stencil or of two that are each other's image.
fn mirror_images(fan: Fan, repeated: bool, stencils: &mut BTreeMap<Site, Terms>) {
    for site in stencils.keys().copied().collect::<Vec<_>>() {
        // the reflection in spoke 0, followed by the rotation that leads back to the sector in which stencils
        // are listed
        let mirrored = site.mirrored(fan);
        let back = if repeated { -(mirrored.sector as i64) } else { 0 };
        let image = mirrored.rotated(fan, back);
        for source in stencils[&site].keys().copied().collect::<Vec<_>>() {
            let other = source.mirrored(fan).rotated(fan, back);
            let pair = (
                stencils[&site].get(&source),
                stencils.get(&image).and_then(|terms| terms.get(&other)),
            );
            let (Some(a), Some(b)) = pair else { continue };
            if a == b || !is_rounding(&(a - b)) {
                continue;
            }
            let mean = (a + b) / BigRational::from_integer(2.into());
            for (site, source) in [(site, source), (image, other)] {
                if let Some(terms) = stencils.get_mut(&site) {
                    terms.insert(source, mean.clone());
                }
            }
        }
    }
}

fn sum_to_one(site: Site, terms: &mut Terms) {
    let rest = BigRational::one() - terms.values().sum::<BigRational>();
    if rest.is_zero() || !is_rounding(&rest) {
        return;
    }
    if let Some(own) = terms.get_mut(&site) {
        *own += rest;
        return;
    }
    let share = rest / BigRational::from_integer(terms.len().into());
    for weight in terms.values_mut() {
        *weight += &share;
    }
}
