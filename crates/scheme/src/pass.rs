//! Passes: the primitive from which every scheme is made.

use crate::{Error, Fan, Lattice, Line, Scalar, Site, Stencil};
use std::collections::BTreeMap;

/// One linear step from a net to a net: a tensor-product rule at regular points, explicit stencils near the centre.
///
/// A pass reads a neighbourhood of one step only; wider rules are several passes in a row, run and never multiplied out.
#[derive(Clone, Debug)]
pub struct Pass<S> {
    /// The net that is read.
    pub from: Lattice,
    /// The net that is made.
    pub to: Lattice,
    /// The rule of regular points, used along both spokes.
    pub line: Line<S>,
    /// The points with a stencil of their own. In a rotation-symmetric level only sites of sector 0 are listed.
    pub special: BTreeMap<Site, Stencil<S>>,
}

impl<S: Scalar> Pass<S> {
    /// A pass without special points.
    pub fn regular(from: Lattice, to: Lattice, line: Line<S>) -> Self {
        debug_assert!(
            line.connects(from, to),
            "the rule does not lead from {from:?} to {to:?}"
        );
        Pass {
            from,
            to,
            line,
            special: BTreeMap::new(),
        }
    }

    /// The same with a stencil at `site`.
    pub fn with(mut self, site: Site, stencil: Stencil<S>) -> Self {
        debug_assert!(site.lattice() == self.to, "{site:?} is not a point of the target net");
        self.special.insert(site, stencil);
        self
    }

    /// The tensor-product rule at `site`.
    fn tensor_product(&self, fan: Fan, site: Site) -> Result<Stencil<S>, Error> {
        let mut stencil = Stencil::new();
        for (x, wx) in self.line.taps(site.x) {
            for (y, wy) in self.line.taps(site.y) {
                let source = Site::new(fan, site.sector as i64, x, y).ok_or(Error::AcrossCentre { site, x, y })?;
                stencil.add(source, wx * wy);
            }
        }
        Ok(stencil)
    }
}

/// One level of refinement: passes in order.
#[derive(Clone, Debug)]
pub struct Level<S> {
    /// The sectors around the centre.
    pub fan: Fan,
    /// The passes; the first reads the control net, the last makes the refined one.
    pub passes: Vec<Pass<S>>,
    /// Whether all sectors have the rules of sector 0 (then special stencils are listed for sector 0 only).
    pub symmetric: bool,
    /// Whether the rules are also symmetric under reflection in a spoke, so that every Fourier block is similar to a real
    /// matrix.
    pub mirror: bool,
}

impl<S: Scalar> Level<S> {
    /// The kind of net before and after refinement.
    pub fn lattice(&self) -> Lattice {
        self.passes.first().map_or(Lattice::Vertex, |pass| pass.from)
    }

    /// The site that stands for `site` and all places that the symmetries of the rules exchange with it.
    pub fn orbit(&self, site: Site) -> Site {
        let Site {
            mut sector,
            mut x,
            mut y,
        } = site;
        if self.symmetric {
            sector = 0;
            if self.mirror && x < y {
                (x, y) = (y, x);
            }
        }
        Site { sector, x, y }
    }

    fn special(&self, pass: usize, site: Site) -> Option<Stencil<S>> {
        let special = &self.passes[pass].special;
        if self.symmetric {
            special
                .get(&Site { sector: 0, ..site })
                .map(|stencil| stencil.rotated(self.fan, site.sector as i64))
        } else {
            special.get(&site).cloned()
        }
    }

    /// Whether `site` has a stencil of its own in the given pass.
    pub fn is_special(&self, pass: usize, site: Site) -> bool {
        let site = if self.symmetric {
            Site { sector: 0, ..site }
        } else {
            site
        };
        self.passes[pass].special.contains_key(&site)
    }

    /// How the given pass makes the point `site` of its target net.
    ///
    /// # Errors
    /// [`Error::AcrossCentre`] if a regular rule reaches into the quadrant opposite to the point's sector, which has no
    /// meaning unless four sectors meet: such a point needs a special stencil.
    pub fn stencil(&self, pass: usize, site: Site) -> Result<Stencil<S>, Error> {
        match self.special(pass, site) {
            Some(stencil) => Ok(stencil),
            None => self.passes[pass].tensor_product(self.fan, site),
        }
    }

    /// Whether the special stencils are what they would be after a reflection in spoke 0: what
    /// [`Level::mirror`](Level#structfield.mirror) claims, up to `tolerance` in each weight.
    pub fn is_mirror_symmetric(&self, tolerance: f64, as_f64: impl Fn(S) -> f64) -> bool {
        let reflected = |pass: usize, site: Site| -> Option<Stencil<S>> {
            let stencil = self.special(pass, site.mirrored(self.fan))?;
            let mut image = Stencil::new();
            for &(source, weight) in stencil.terms() {
                image.add(source.mirrored(self.fan), weight);
            }
            Some(image)
        };
        self.passes.iter().enumerate().all(|(index, pass)| {
            pass.special.keys().all(|&site| {
                let (Some(stencil), Some(image)) = (self.special(index, site), reflected(index, site)) else {
                    return false;
                };
                let mut difference = stencil;
                for &(source, weight) in image.terms() {
                    difference.add(source, -weight);
                }
                difference
                    .terms()
                    .iter()
                    .all(|&(_, weight)| as_f64(weight).abs() <= tolerance)
            })
        })
    }
}
