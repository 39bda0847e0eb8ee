//! The rules of blocks: of each pass of a level its line, and the rows of corners.

use super::kernel::Kernel;
use crate::active::{Active, Kind, Masks};
use crate::rules::{Method, Rules};
use crate::topology::FanAt;
use crate::{Error, Topology};
use eigenring_scheme::{Line, Site};

/// How the point of a corner or beside it is made: weights of points in the frame of a half-edge, the steps
/// along it and to its left.
pub(super) type Local = Vec<(u32, usize, usize, f64)>;

/// The row of a special point: the half-edge in whose frame it lies, the steps to its left (0 on the edge, 1
/// in the face), and the weights.
pub(super) type Special = (u32, usize, Local);

/// One pass over all blocks.
pub(super) struct Pass {
    pub kernel: Kernel,
    /// Rows of the vertices of the control mesh.
    pub corners: Vec<Local>,
    /// Whether the inner points of an edge read along it only.
    pub creases: Vec<bool>,
    /// Rows of the points (1, 0) or (1, 1) in the frame of a half-edge, which are special.
    pub special: Vec<Special>,
}

/// What the passes of any level are made of.
pub(super) struct Source<'a> {
    pub topology: &'a Topology,
    pub rules: &'a Rules,
    pub active: Active,
}

impl Source<'_> {
    /// The passes of a level; `None` if marks fade in it, or special rules reach farther than one step.
    pub fn level(&self, level: usize) -> Result<Option<Vec<Pass>>, Error> {
        match self.rules.method()? {
            Method::Bicubic => Ok(self.bicubic()?.map(|pass| vec![pass])),
            Method::Even { order, .. } => {
                let mut passes = vec![self.linear()];
                for step in 0..order / 2 - 1 {
                    let Some(pass) = self.smoothing(level, step)? else {
                        return Ok(None);
                    };
                    passes.push(pass);
                }
                Ok(Some(passes))
            }
            Method::Odd { .. } | Method::Passes => Ok(None),
        }
    }

    fn edges(&self, is_crease: impl Fn([u32; 2]) -> bool) -> Vec<bool> {
        let edges = 0..self.topology.edge_count() as u32;
        edges
            .map(|number| is_crease(self.topology.edge_points(number)))
            .collect()
    }

    /// Linear refinement: corners stay, and no edge reads across.
    fn linear(&self) -> Pass {
        let own = |vertex| self.topology.first_spoke(vertex).map(|half| (half, 0, 0, 1.0));
        let vertices = 0..self.topology.vertex_count() as u32;
        Pass {
            kernel: Kernel::new(&Line::midpoint()),
            corners: vertices.map(|vertex| own(vertex).into_iter().collect()).collect(),
            creases: self.edges(|_| true),
            special: Vec::new(),
        }
    }

    fn smoothing(&self, level: usize, step: usize) -> Result<Option<Pass>, Error> {
        let regular = self.rules.inner(None, 4)?;
        let line = regular.level(level).passes()[step + 1].line().cloned();
        let Some(corners) = self.corners(step + 1, step, level)? else {
            return Ok(None);
        };
        Ok(Some(Pass {
            kernel: Kernel::new(&line.unwrap_or_else(|| Line::smoothing(1.0))),
            corners,
            creases: self.edges(|pair| self.active.acts(pair, step)),
            special: Vec::new(),
        }))
    }

    fn bicubic(&self) -> Result<Option<Pass>, Error> {
        let regular = self.rules.inner(None, 4)?;
        let line = regular.limit().passes()[0].line().cloned();
        let (Some(corners), Some(special)) = (self.corners(0, 0, 0)?, self.special()?) else {
            return Ok(None);
        };
        Ok(Some(Pass {
            kernel: Kernel::new(&line.unwrap_or_else(Line::cubic)),
            corners,
            creases: self.edges(|pair| self.active.edge_weight(pair) >= 1.0),
            special,
        }))
    }

    /// The rows of all vertices in a pass, which is the given smoothing step.
    fn corners(&self, pass: usize, step: usize, level: usize) -> Result<Option<Vec<Local>>, Error> {
        let mut corners = Vec::with_capacity(self.topology.vertex_count());
        for vertex in 0..self.topology.vertex_count() as u32 {
            let fan = self.topology.fan(vertex);
            if fan.spokes.is_empty() {
                corners.push(Vec::new());
                continue;
            }
            let Masks::One(kind) = self.active.masks(vertex, step) else {
                return Ok(None);
            };
            corners.push(self.corner(vertex, &fan, kind, pass, level)?);
        }
        Ok(Some(corners))
    }

    fn corner(&self, vertex: u32, fan: &FanAt, kind: Kind, pass: usize, level: usize) -> Result<Local, Error> {
        let (own, n) = ((fan.spokes[0], 0, 0), fan.spokes.len());
        Ok(match kind {
            Kind::Stays => vec![(own.0, 0, 0, 1.0)],
            Kind::Crease(a, b) => {
                let beside = self.rules.beside()?;
                let stencil = beside.level(level).stencil(pass, Site::CENTRE)?;
                let towards = |end: u32| {
                    let mut spokes = fan.spokes.iter();
                    match spokes.find(|&&spoke| self.topology.head(spoke) == end) {
                        Some(&spoke) => (spoke, 1, 0),
                        // the last spoke is the upper end of the last face
                        None => (fan.spokes[n - 1], 0, 1),
                    }
                };
                let (a, b) = (towards(a), towards(b));
                let terms = stencil.terms().iter().map(|(site, weight)| {
                    let (half, p, q) = match (*site == Site::CENTRE, site.sector) {
                        (true, _) => own,
                        (_, 0) => a,
                        _ => b,
                    };
                    (half, p, q, *weight)
                });
                terms.collect()
            }
            Kind::Smooth => {
                let plain = self.active.is_plain(vertex);
                let [weight, edges, middles] = self.rules.mask(vertex, n, plain, pass, level)?;
                let mut row = vec![(own.0, 0, 0, weight)];
                row.extend(fan.spokes.iter().map(|&spoke| (spoke, 1, 0, edges)));
                row.extend(fan.spokes.iter().map(|&spoke| (spoke, 1, 1, middles)));
                row
            }
        })
    }

    /// The rows of special points beside vertices; `None` if they reach farther than one step.
    fn special(&self) -> Result<Option<Vec<Special>>, Error> {
        let mut special = Vec::new();
        for vertex in 0..self.topology.vertex_count() as u32 {
            let fan = self.topology.fan(vertex);
            let n = fan.spokes.len();
            if !self.active.is_plain(vertex) || n < 3 || !self.rules.is_special(vertex, n) {
                continue;
            }
            let scheme = self.rules.inner(Some(vertex), n)?;
            let level = scheme.limit();
            for (sector, &spoke) in fan.spokes.iter().enumerate() {
                let listed = level.passes()[0].special().keys().filter(|&&site| site != Site::CENTRE);
                for &site in listed {
                    if site.x > 2 || site.y > 2 || site.sector > 0 {
                        return Ok(None);
                    }
                    let stencil = level.stencil(0, site.rotated(level.fan(), sector as i64))?;
                    let terms = stencil.terms().iter().map(|(at, weight)| {
                        let half = fan.spokes[at.sector];
                        (half, (at.x / 2) as usize, (at.y / 2) as usize, *weight)
                    });
                    let terms: Local = terms.collect();
                    if terms.iter().any(|&(_, p, q, _)| p > 1 || q > 1) {
                        return Ok(None);
                    }
                    special.push((spoke, (site.y / 2) as usize, terms));
                }
            }
        }
        Ok(Some(special))
    }
}
