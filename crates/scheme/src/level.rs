//! A level of refinement: passes in order, and the symmetry that they have.

use crate::{Error, Fan, Lattice, Pass, RuleFault, Same, Scalar, Site, Stencil};
use std::collections::BTreeMap;

/// What the rules of a level have in common with their images under rotations and reflections.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Symmetry {
    /// Nothing: sectors differ, or the fan is open.
    None,
    /// All sectors have the same rules, so that the local matrix is block-circulant.
    Rotation,
    /// The rules are the same also after reflection in a spoke, so that every Fourier block is similar to a
    /// real matrix.
    Dihedral,
}

/// One level of refinement: passes in order, the first reading the control net, the last making the refined
/// one.
///
/// The symmetry is **derived** from lines, special stencils and the centre's stencils when a level is made,
/// by [`Same`] weights; it cannot be stated. A level over exact numbers thus has the symmetry that these
/// numbers have, and a level over mere names of weights has it for whatever values the names get
/// ([`Level::map`]).
#[derive(Clone, Debug)]
pub struct Level<W> {
    fan: Fan,
    passes: Vec<Pass<W>>,
    /// Whether special stencils are listed for sector 0 and hold in every sector.
    repeated: bool,
    symmetry: Symmetry,
}

impl<W: Same> Level<W> {
    /// A level of the given passes, and its symmetry.
    ///
    /// In a closed fan special stencils that are all listed in sector 0 hold in every sector; if any is
    /// listed in another, every sector stands for itself.
    ///
    /// # Errors
    /// [`Error::Valence`] for a fan without sectors; [`Error::Rules`] if passes do not follow each other, do
    /// not refine twofold, lines do not connect their nets, special sites or their sources are no points of
    /// them, or an open fan is not one of a vertex.
    pub fn new(fan: Fan, passes: Vec<Pass<W>>) -> Result<Self, Error> {
        check(fan, &passes)?;
        let mut sites = passes.iter().flat_map(|pass| pass.special().keys());
        let repeated = fan.is_closed() && sites.all(|site| site.sector == 0);
        let mut level = Level {
            fan,
            passes,
            repeated,
            symmetry: Symmetry::None,
        };
        level.symmetry = level.derived();
        if level.symmetry > Symmetry::None && !level.repeated {
            // all sectors agree: one stands for them
            let passes = std::mem::take(&mut level.passes).into_iter();
            level.passes = passes.map(|pass| pass.retaining(|site| site.sector == 0)).collect();
            level.repeated = true;
        }
        Ok(level)
    }

    fn derived(&self) -> Symmetry {
        if !self.fan.is_closed() || !self.passes.iter().all(|pass| self.is_rotated(pass)) {
            return Symmetry::None;
        }
        let mirror = self
            .passes
            .iter()
            .enumerate()
            .all(|(index, pass)| self.is_mirrored(index, pass));
        if mirror { Symmetry::Dihedral } else { Symmetry::Rotation }
    }

    /// Whether a pass has the same rules one sector further on.
    fn is_rotated(&self, pass: &Pass<W>) -> bool {
        let [own, next] = pass.lines(0);
        let mut sectors = 1..pass.listed_sectors().unwrap_or(1);
        let lines = sectors.all(|sector| {
            let [other_own, other_next] = pass.lines(sector);
            own.same(other_own) && next.same(other_next)
        });
        let mut special = pass
            .special()
            .iter()
            .filter(|(site, _)| **site == Site::CENTRE || !self.repeated);
        lines
            && special.all(|(site, stencil)| {
                let image = pass.special().get(&site.rotated(self.fan, 1));
                image.is_some_and(|image| image.same(&stencil.rotated(self.fan, 1)))
            })
    }

    /// Whether a pass of a rotation-symmetric level is its own image under reflection in spoke 0.
    fn is_mirrored(&self, index: usize, pass: &Pass<W>) -> bool {
        let [own, next] = pass.lines(0);
        // a coordinate along a spoke is positive on both sides of the mirror, so only points on a spoke see
        // both sides
        let on_spoke = pass.to() == Lattice::Face || next.is_symmetric_on_spoke();
        let mut special = pass.special().iter();
        own.same(next)
            && on_spoke
            && special.all(|(site, stencil)| {
                let image = self.special(index, site.mirrored(self.fan));
                image.is_some_and(|image| image.same(&stencil.mirrored(self.fan)))
            })
    }
}

/// Whether the passes make up a level of the fan.
fn check<W: Clone>(fan: Fan, passes: &[Pass<W>]) -> Result<(), Error> {
    if fan.sectors() == 0 {
        return Err(Error::Valence { valence: 0 });
    }
    let scale: i64 = passes.iter().map(|pass| i64::from(pass.scale())).product();
    let whole = |fault| Error::Rules { pass: None, fault };
    let (Some(first), Some(last)) = (passes.first(), passes.last()) else {
        return Err(whole(RuleFault::NoPass));
    };
    if first.from() != last.to() || passes.windows(2).any(|pair| pair[0].to() != pair[1].from()) {
        return Err(whole(RuleFault::Chain));
    }
    if scale != 2 {
        return Err(whole(RuleFault::Scale { scale }));
    }
    if !fan.is_closed() && passes.iter().any(|pass| pass.to() == Lattice::Face) {
        return Err(whole(RuleFault::OpenFace));
    }
    for (index, pass) in passes.iter().enumerate() {
        let refuse = |fault| Error::Rules {
            pass: Some(index),
            fault,
        };
        let (from, to) = (pass.from(), pass.to());
        if let Some(found) = pass.listed_sectors()
            && found != fan.spokes()
        {
            let expected = fan.spokes();
            return Err(refuse(RuleFault::Sectors { found, expected }));
        }
        let mut lines = pass.all_lines();
        if lines.any(|line| line.classes().is_empty() || line.scale() != pass.scale() || !line.connects(from, to)) {
            return Err(refuse(RuleFault::Line { from, to }));
        }
        for (&site, stencil) in pass.special() {
            if !is_canonical(fan, site, to) {
                return Err(refuse(RuleFault::Target { site, lattice: to }));
            }
            let mut sources = stencil.terms().iter().map(|(source, _)| *source);
            if let Some(read) = sources.find(|&source| !is_canonical(fan, source, from)) {
                let lattice = from;
                return Err(refuse(RuleFault::Source { site, read, lattice }));
            }
        }
    }
    Ok(())
}

fn is_canonical(fan: Fan, site: Site, lattice: Lattice) -> bool {
    let parity = lattice.parity();
    let on_lattice = site.x.rem_euclid(2) == parity && site.y.rem_euclid(2) == parity;
    on_lattice && Site::new(fan, site.sector as i64, site.x, site.y) == Some(site)
}

impl<W: Clone> Level<W> {
    /// The sectors around the centre.
    pub fn fan(&self) -> Fan {
        self.fan
    }

    /// The passes, in order.
    pub fn passes(&self) -> &[Pass<W>] {
        &self.passes
    }

    /// The symmetry of the rules.
    pub fn symmetry(&self) -> Symmetry {
        self.symmetry
    }

    /// Whether all sectors have the same rules.
    pub fn is_rotation_symmetric(&self) -> bool {
        self.symmetry >= Symmetry::Rotation
    }

    /// Whether the rules are symmetric under rotation and reflection.
    pub fn has_mirror(&self) -> bool {
        self.symmetry == Symmetry::Dihedral
    }

    /// The same rules, of whose symmetry no more than the given one will be made use of.
    pub fn with_at_most(mut self, symmetry: Symmetry) -> Self {
        self.symmetry = self.symmetry.min(symmetry);
        self
    }

    /// The kind of net before and after refinement.
    pub fn lattice(&self) -> Lattice {
        self.passes.first().map_or(Lattice::Vertex, Pass::from)
    }

    /// The site that stands for `site` and all places that the symmetries of the rules exchange with it.
    pub fn orbit(&self, site: Site) -> Site {
        let Site { x, y, .. } = site;
        match self.symmetry {
            Symmetry::None => site,
            Symmetry::Dihedral if x < y => Site { sector: 0, x: y, y: x },
            _ => Site { sector: 0, x, y },
        }
    }

    /// The same rules with other weights. The symmetry is kept: weights that are the same get the same image.
    pub fn map<T: Clone>(&self, mut f: impl FnMut(&W) -> T) -> Level<T> {
        Level {
            fan: self.fan,
            passes: self.passes.iter().map(|pass| pass.map(&mut f)).collect(),
            repeated: self.repeated,
            symmetry: self.symmetry,
        }
    }

    /// Where the stencil of a special site is listed.
    fn listed(&self, site: Site) -> Site {
        if self.repeated {
            Site { sector: 0, ..site }
        } else {
            site
        }
    }

    /// The stencil of its own that a pass has for `site`.
    pub fn special(&self, pass: usize, site: Site) -> Option<Stencil<W>> {
        let stencil = self.passes[pass].special().get(&self.listed(site))?;
        Some(if self.repeated && site.sector != 0 {
            stencil.rotated(self.fan, site.sector as i64)
        } else {
            stencil.clone()
        })
    }

    /// Whether `site` has a stencil of its own in the given pass.
    pub fn is_special(&self, pass: usize, site: Site) -> bool {
        self.passes[pass].special().contains_key(&self.listed(site))
    }

    /// The points that the given pass makes `site` of.
    ///
    /// # Errors
    /// As [`Level::stencil`].
    pub fn sources(&self, pass: usize, site: Site) -> Result<Vec<Site>, Error> {
        if let Some(stencil) = self.special(pass, site) {
            return Ok(stencil.terms().iter().map(|(source, _)| *source).collect());
        }
        let places = self.passes[pass].tensor_sources(site);
        places
            .map(|(x, y)| Pass::<W>::source(self.fan, site, x, y).ok_or(Error::AcrossCentre { site, x, y }))
            .collect()
    }
}

impl<S: Scalar> Level<S> {
    /// How the given pass makes the point `site` of its target net.
    ///
    /// # Errors
    /// [`Error::AcrossCentre`] if a regular rule reaches into the quadrant opposite to the point's sector,
    /// which has no meaning unless four sectors meet, or beyond an open fan: such a point needs a special
    /// stencil.
    pub fn stencil(&self, pass: usize, site: Site) -> Result<Stencil<S>, Error> {
        if let Some(stencil) = self.special(pass, site) {
            return Ok(stencil);
        }
        let [own, next] = self.passes[pass].lines(site.sector);
        let mut stencil = Stencil::new();
        for (x, wx) in own.taps(site.x) {
            for (y, wy) in next.taps(site.y) {
                let source = Pass::<S>::source(self.fan, site, x, y).ok_or(Error::AcrossCentre { site, x, y })?;
                stencil.add(source, wx.clone() * wy);
            }
        }
        Ok(stencil)
    }

    /// The mask of one level of refinement at regular points: the weight with which each refined point, at
    /// half steps from twice the source's place, reads the source. `None` unless it is the same in all
    /// sectors and directions and on both sides of every spoke, where each line must be its own mirror image.
    pub fn regular_mask(&self) -> Option<BTreeMap<i32, S>> {
        let uniform = |pass: &Pass<S>| {
            let mut lines = pass.all_lines();
            lines.all(|line| line.is_uniform() && line.is_mirror_image(pass.to()))
        };
        if !self.fan.is_closed() || !self.passes.iter().all(uniform) {
            return None;
        }
        let sectors = self.passes.iter().filter_map(Pass::listed_sectors).max().unwrap_or(1);
        let mut masks = (0..sectors).flat_map(|sector| [0, 1].map(|axis| self.mask_of(sector, axis)));
        let first = masks.next()?;
        masks
            .all(|mask| mask.len() == first.len() && mask.iter().zip(&first).all(|(a, b)| a.0 == b.0 && a.1.same(b.1)))
            .then_some(first)
    }

    /// What becomes of one control point of a regular line: by all passes in order.
    fn mask_of(&self, sector: usize, axis: usize) -> BTreeMap<i32, S> {
        let start = self.lattice().parity();
        let mut values = BTreeMap::from([(start, S::one())]);
        for pass in &self.passes {
            let line = pass.lines(sector)[axis];
            let scale = line.scale();
            let mut made: BTreeMap<i32, S> = BTreeMap::new();
            for (&source, value) in &values {
                for (class, taps) in line.classes().iter().enumerate() {
                    for (offset, weight) in taps {
                        // (x + offset) / scale = source, for targets of the tap's class
                        let x = scale * source - offset;
                        if x.div_euclid(2).rem_euclid(scale) == class as i32 {
                            let term = weight.clone() * value.clone();
                            *made.entry(x).or_insert_with(S::zero) += term;
                        }
                    }
                }
            }
            values = made;
        }
        values.retain(|_, value| !value.same(&S::zero()));
        values.into_iter().map(|(x, value)| (x - 2 * start, value)).collect()
    }

    /// The degree d of the uniform B-splines that the regular rules refine: the mask is `2^-d C(d+1, j)`,
    /// centred (Lane and Riesenfeld 1980). `None` if the mask is another one, or is not known well enough to
    /// tell.
    pub fn spline_degree(&self) -> Option<usize> {
        let mask = self.regular_mask()?;
        let degree = mask.len().checked_sub(2).filter(|&degree| degree > 0)?;
        let mut binomial = S::ratio(1, 1);
        for _ in 0..degree {
            binomial = binomial * S::ratio(1, 2);
        }
        for (index, (&x, weight)) in mask.iter().enumerate() {
            if x != 2 * index as i32 - (degree as i32 + 1) || !weight.same(&binomial) {
                return None;
            }
            let (count, index) = ((degree + 1 - index) as i64, index as i64 + 1);
            binomial = binomial * S::ratio(count, 1) / S::ratio(index, 1);
        }
        Some(degree)
    }
}
