//! A scheme: levels of passes around one centre.

use crate::{Error, Fan, Lattice, Level, Net, Numbering, Scalar, Site, refine};

/// A subdivision scheme around one extraordinary vertex or face.
///
/// A scheme is data, made by the constructor of its family. A non-stationary scheme lists its leading levels; from then on
/// its limit level holds, the one that governs continuity.
#[derive(Clone, Debug)]
pub struct Scheme<S> {
    /// What the scheme is, in the words of [`Spec`](crate::Spec).
    pub name: String,
    /// The degree of the regular surface in each direction: 3 for bicubic.
    pub degree: usize,
    /// The levels before the limit level, the first refinement first; empty for a stationary scheme.
    pub leading: Vec<Level<S>>,
    /// All further levels.
    pub limit: Level<S>,
}

impl<S: Scalar> Scheme<S> {
    /// A scheme whose levels are all the same.
    pub fn stationary(name: impl Into<String>, degree: usize, level: Level<S>) -> Self {
        Scheme {
            name: name.into(),
            degree,
            leading: Vec::new(),
            limit: level,
        }
    }

    /// The rules of refinement `index`, 0 for the first.
    pub fn level(&self, index: usize) -> &Level<S> {
        self.leading.get(index).unwrap_or(&self.limit)
    }

    /// The level that governs continuity in the limit.
    pub fn limit(&self) -> &Level<S> {
        &self.limit
    }

    /// The number of sectors.
    pub fn valence(&self) -> usize {
        self.limit.fan.sectors()
    }

    /// The kind of the control net.
    pub fn lattice(&self) -> Lattice {
        self.limit.lattice()
    }

    /// The control net out to a ring.
    pub fn numbering(&self, rings: usize) -> Numbering {
        Numbering {
            fan: self.limit.fan,
            lattice: self.lattice(),
            rings,
        }
    }

    /// The smallest number of rings whose refinement reads no point outside them: the smallest net with a square local
    /// matrix, which holds all eigenvalues that are not those of regular rings alone.
    ///
    /// # Errors
    /// Those of [`refine`]; [`Error::NotClosed`] if no ring up to 64 closes.
    pub fn closed_rings(&self) -> Result<usize, Error> {
        // a face net closes with ring 0 at the earliest, a vertex net with ring 1: the centre alone never determines a patch
        let first = 1 - self.lattice().parity() as usize;
        // the outermost ring read grows with the ring made, so that iterating it from below ends at the smallest closed one
        let mut rings = first;
        while rings <= MAX_CLOSED {
            let reach = self.reach(rings)?;
            if reach <= rings {
                return Ok(rings);
            }
            rings = reach;
        }
        Err(Error::NotClosed { rings: MAX_CLOSED })
    }

    /// The outermost control ring read by refined points of the given ring, or by the centre.
    fn reach(&self, ring: usize) -> Result<usize, Error> {
        let sites = self.representatives(ring).into_iter();
        let sites: Vec<Site> = sites.filter(|s| [0, ring].contains(&s.ring())).collect();
        let reach = refine(&self.limit, &ReachNet { level: &self.limit }, &sites)?;
        Ok(reach.into_iter().max().unwrap_or(0))
    }

    /// The outermost refined ring in whose rule a special stencil takes part (`None` without special stencils): beyond it
    /// the surface is a regular spline.
    ///
    /// # Errors
    /// Those of [`refine`].
    pub fn special_rings(&self) -> Result<Option<usize>, Error> {
        let level = &self.limit;
        // the marks start with the special points of each pass and spread through the passes after it
        let mut outermost = None;
        for first in 0..level.passes.len() {
            let rest = Level {
                passes: level.passes[first + 1..].to_vec(),
                ..level.clone()
            };
            // each pass carries a mark one ring further at most
            let sites = self.representatives(level.passes.len() + 2);
            let marks = MarkNet { level, pass: first };
            let marked = if rest.passes.is_empty() {
                sites.iter().map(|&site| level.is_special(first, site)).collect()
            } else {
                refine(&rest, &marks, &sites)?
            };
            let rings = sites.iter().zip(marked).filter(|(_, marked)| *marked);
            outermost = outermost.max(rings.map(|(site, _)| site.ring()).max());
        }
        Ok(outermost)
    }

    /// One site of each orbit under rotation, or every site if there is no symmetry.
    fn representatives(&self, rings: usize) -> Vec<Site> {
        let mut sites = self.numbering(rings).sites();
        sites.retain(|site| !self.limit.symmetric || site.sector == 0);
        sites
    }

    /// The fan.
    pub fn fan(&self) -> Fan {
        self.limit.fan
    }
}

/// Nets beyond this many rings are not looked at: order 32, the largest there is, closes with 15.
const MAX_CLOSED: usize = 64;

/// A point's value is the outermost control ring it depends on.
struct ReachNet<'a, S> {
    level: &'a Level<S>,
}

impl<S: Scalar> Net<S> for ReachNet<'_, S> {
    type Value = usize;

    fn zero(&self) -> usize {
        0
    }

    fn control(&self, site: Site) -> Result<usize, Error> {
        Ok(site.ring())
    }

    fn orbit(&self, site: Site) -> Site {
        self.level.orbit(site)
    }

    fn accumulate(&self, sum: &mut usize, _weight: S, at_orbit: &usize, _site: Site) {
        *sum = (*sum).max(*at_orbit);
    }
}

/// A point's value says whether it depends on a point that the given pass makes by a special stencil.
struct MarkNet<'a, S> {
    level: &'a Level<S>,
    pass: usize,
}

impl<S: Scalar> Net<S> for MarkNet<'_, S> {
    type Value = bool;

    fn zero(&self) -> bool {
        false
    }

    fn control(&self, site: Site) -> Result<bool, Error> {
        Ok(self.level.is_special(self.pass, site))
    }

    fn orbit(&self, site: Site) -> Site {
        self.level.orbit(site)
    }

    fn accumulate(&self, sum: &mut bool, _weight: S, at_orbit: &bool, _site: Site) {
        *sum |= *at_orbit;
    }
}
