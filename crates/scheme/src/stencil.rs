//! A linear combination of sites.

use crate::{Fan, Same, Scalar, Site};

/// Weights on sites. Terms keep the order in which they were added; a site occurs only once.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Stencil<W> {
    terms: Vec<(Site, W)>,
}

impl<W: Clone> Stencil<W> {
    /// The empty combination.
    pub fn new() -> Self {
        Stencil { terms: Vec::new() }
    }

    /// The combination of the given terms. `None` if a site occurs twice.
    pub fn from_terms(terms: Vec<(Site, W)>) -> Option<Self> {
        let mut sites: Vec<Site> = terms.iter().map(|(site, _)| *site).collect();
        sites.sort_unstable();
        let distinct = sites.windows(2).all(|pair| pair[0] != pair[1]);
        distinct.then_some(Stencil { terms })
    }

    /// The same with one more term, at a new site: for writing stencils down.
    pub fn with(mut self, site: Site, weight: W) -> Self {
        debug_assert!(
            self.terms.iter().all(|(known, _)| *known != site),
            "{site:?} has a weight"
        );
        self.terms.push((site, weight));
        self
    }

    /// The same with `weight` for `site` of **each** sector of a closed fan.
    pub fn with_orbit(mut self, fan: Fan, site: Site, weight: W) -> Self {
        for sector in 0..fan.sectors() {
            self.terms.push((site.rotated(fan, sector as i64), weight.clone()));
        }
        self
    }

    /// The weights.
    pub fn terms(&self) -> &[(Site, W)] {
        &self.terms
    }

    /// The same sites with other weights.
    pub fn map<T>(&self, mut f: impl FnMut(&W) -> T) -> Stencil<T> {
        Stencil {
            terms: self.terms.iter().map(|(site, weight)| (*site, f(weight))).collect(),
        }
    }

    /// The same weights at other sites, which must be distinct as well.
    fn moved(&self, to: impl Fn(Site) -> Site) -> Self {
        let moved = self.terms.iter().map(|(site, weight)| (to(*site), weight.clone()));
        Stencil { terms: moved.collect() }
    }

    /// The stencil of the place `sectors` further on.
    pub fn rotated(&self, fan: Fan, sectors: i64) -> Self {
        self.moved(|site| site.rotated(fan, sectors))
    }

    /// The stencil of the place on the other side of the fan's mirror.
    pub fn mirrored(&self, fan: Fan) -> Self {
        self.moved(|site| site.mirrored(fan))
    }
}

impl<W: Same> Stencil<W> {
    /// Whether both are known to be the same combination, in whatever order.
    pub fn same(&self, other: &Self) -> bool {
        fn sorted<W: Clone>(stencil: &Stencil<W>) -> Vec<&(Site, W)> {
            let mut terms: Vec<&(Site, W)> = stencil.terms.iter().collect();
            terms.sort_by_key(|(site, _)| *site);
            terms
        }
        let (own, others) = (sorted(self), sorted(other));
        let mut pairs = own.iter().zip(&others);
        own.len() == others.len() && pairs.all(|(a, b)| a.0 == b.0 && a.1.same(&b.1))
    }
}

impl<S: Scalar> Stencil<S> {
    /// Adds `weight` to the weight of `site`.
    pub fn add(&mut self, site: Site, weight: S) {
        match self.terms.iter_mut().find(|(known, _)| *known == site) {
            Some((_, sum)) => *sum += weight,
            None => self.terms.push((site, weight)),
        }
    }

    /// The sum of the weights: 1 for an affine combination.
    pub fn sum(&self) -> S {
        let weights = self.terms.iter().map(|(_, weight)| weight.clone());
        weights.fold(S::zero(), |sum, weight| sum + weight)
    }
}
