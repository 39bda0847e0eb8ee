//! A linear combination of sites.

use crate::{Fan, Scalar, Site};

/// Weights on sites. Terms keep the order in which they were added; a site may occur only once.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Stencil<S> {
    terms: Vec<(Site, S)>,
}

impl<S: Scalar> Stencil<S> {
    /// The empty combination.
    pub fn new() -> Self {
        Stencil { terms: Vec::new() }
    }

    /// Adds `weight` to the weight of `site`.
    pub fn add(&mut self, site: Site, weight: S) {
        match self.terms.iter_mut().find(|(known, _)| *known == site) {
            Some((_, sum)) => *sum += weight,
            None => self.terms.push((site, weight)),
        }
    }

    /// The same with one more term: for writing stencils down.
    pub fn with(mut self, site: Site, weight: S) -> Self {
        self.add(site, weight);
        self
    }

    /// The same with `weight` for `site` of **each** sector.
    pub fn with_orbit(mut self, fan: Fan, site: Site, weight: S) -> Self {
        for sector in 0..fan.sectors() {
            self.add(site.rotated(fan, sector as i64), weight);
        }
        self
    }

    /// The weights.
    pub fn terms(&self) -> &[(Site, S)] {
        &self.terms
    }

    /// The sum of the weights: 1 for an affine combination.
    pub fn sum(&self) -> S {
        self.terms.iter().fold(S::zero(), |sum, &(_, weight)| sum + weight)
    }

    /// The stencil of the place `sectors` further on.
    pub fn rotated(&self, fan: Fan, sectors: i64) -> Self {
        Stencil {
            terms: self
                .terms
                .iter()
                .map(|&(site, weight)| (site.rotated(fan, sectors), weight))
                .collect(),
        }
    }
}
