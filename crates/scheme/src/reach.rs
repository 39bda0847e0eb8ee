//! How far rules reach: which points depend on special stencils, and which nets are closed under refinement.

use crate::{Error, Lattice, Level, Numbering, Site};
use std::collections::BTreeSet;

/// Nets beyond this many rings are not looked at: order 32, the largest there is, closes with 15, and special
/// points that a file may list lie within 32.
const MAX_RINGS: usize = 128;

/// The most points to look at one by one: looking at so many takes about a second, and a dense matrix of a
/// tenth of them fills the memory of a large machine. Empirical.
const MAX_POINTS: usize = 300_000;

impl<W: Clone> Level<W> {
    /// The points out to a ring.
    pub fn numbering(&self, rings: usize) -> Numbering {
        Numbering {
            fan: self.fan(),
            lattice: self.lattice(),
            rings,
        }
    }

    /// One site of each orbit of a net, or every site if there is no symmetry.
    fn representatives(&self, lattice: Lattice, rings: usize) -> Result<Vec<Site>, Error> {
        let numbering = Numbering {
            lattice,
            ..self.numbering(rings)
        };
        let sites: Vec<Site> = if self.is_rotation_symmetric() {
            let centre = (lattice == Lattice::Vertex).then_some(Site::CENTRE);
            centre.into_iter().chain(numbering.sector_sites(0)).collect()
        } else if numbering.count() > MAX_POINTS {
            return Err(Error::NetSize {
                points: numbering.count(),
                maximum: MAX_POINTS,
            });
        } else {
            numbering.sites()
        };
        Ok(sites.into_iter().filter(|&site| self.orbit(site) == site).collect())
    }

    /// The outermost refined ring that a special stencil takes part in, directly or through the passes after
    /// it; `None` without special stencils. Rules beyond it are the regular ones. Lines with taps of their
    /// own near a spoke are not counted: they hold along the whole spoke.
    ///
    /// # Errors
    /// Those of [`Level::sources`]; [`Error::NetSize`] where sectors differ and rules reach too far.
    pub fn special_rings(&self) -> Result<Option<usize>, Error> {
        let mut marked: BTreeSet<Site> = BTreeSet::new();
        for (index, pass) in self.passes().iter().enumerate() {
            let mut next: BTreeSet<Site> = pass.special().keys().map(|&site| self.orbit(site)).collect();
            if let Some(ring) = marked.iter().map(|site| site.ring()).max() {
                for site in self.representatives(pass.to(), pass.farthest_reader(ring))? {
                    if self
                        .sources(index, site)?
                        .iter()
                        .any(|&source| marked.contains(&self.orbit(source)))
                    {
                        next.insert(site);
                    }
                }
            }
            marked = next;
        }
        Ok(marked.iter().map(|site| site.ring()).max())
    }

    /// The last step from a spoke at which a refined point may be made otherwise than further out: beyond it
    /// rules are copies of each other, shifted. Special stencils are not counted.
    pub fn last_irregular_step(&self) -> usize {
        let mut last = 0;
        for pass in self.passes() {
            let taps = |line: &crate::Line<W>| {
                let offsets = line.classes().iter().flatten().map(|(offset, _)| offset.abs());
                (offsets.max().unwrap_or(0), line.last_near().unwrap_or(0))
            };
            let larger = |a: (i32, i32), b: (i32, i32)| (a.0.max(b.0), a.1.max(b.1));
            let (reach, near) = pass.all_lines().map(taps).fold((0, 0), larger);
            // what reads an irregular point, or across the spoke
            last = (last * pass.scale() + reach).max(near);
        }
        last as usize / 2 + 1
    }

    /// The smallest number of rings that holds every point with a special rule and whose refinement reads no
    /// point outside: the smallest net with a square local matrix, which has all eigenvalues that are not
    /// those of regular rings alone.
    ///
    /// # Errors
    /// Those of [`Level::special_rings`]; [`Error::NotClosed`] if no ring up to 128 closes.
    pub fn closed_rings(&self) -> Result<usize, Error> {
        // a face net closes with ring 0 at the earliest, a vertex net with ring 1: the centre alone never
        // determines a patch
        let first = 1 - self.lattice().parity() as usize;
        let mut rings = self.special_rings()?.unwrap_or(0).max(first);
        // the outermost ring read grows with the ring made, so that iterating it from below ends at the
        // smallest closed one
        while rings <= MAX_RINGS {
            let reach = self.reach(rings)?;
            if reach <= rings {
                return Ok(rings);
            }
            rings = reach;
        }
        Err(Error::NotClosed { rings: MAX_RINGS })
    }

    /// The outermost control ring that the refined points of the given rings read.
    fn reach(&self, rings: usize) -> Result<usize, Error> {
        let mut needed: BTreeSet<Site> = self.representatives(self.lattice(), rings)?.into_iter().collect();
        for index in (0..self.passes().len()).rev() {
            let mut sources = BTreeSet::new();
            for &site in &needed {
                sources.extend(self.sources(index, site)?.into_iter().map(|source| self.orbit(source)));
            }
            needed = sources;
        }
        Ok(needed.iter().map(|site| site.ring()).max().unwrap_or(0))
    }
}
