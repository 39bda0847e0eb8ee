//! Passes: the primitive from which every scheme is made.

use crate::{Fan, Lattice, Line, Site, Stencil};
use std::collections::BTreeMap;

/// One linear step from a net to a net: a tensor-product rule at regular points, explicit stencils near the
/// centre.
///
/// A pass reads a neighbourhood of one step only; wider rules are several passes in a row, run and never
/// multiplied out.
#[derive(Clone, Debug)]
pub struct Pass<W> {
    from: Lattice,
    to: Lattice,
    lines: Lines<W>,
    special: BTreeMap<Site, Stencil<W>>,
}

/// The rules of regular points.
#[derive(Clone, Debug)]
enum Lines<W> {
    /// One rule in every sector and in both directions.
    Alike(Line<W>),
    /// For each spoke i the rules of the sector that begins there: of the coordinate along spoke i, which
    /// crosses spoke i+1, and of the coordinate along spoke i+1, which crosses spoke i.
    Sectors(Vec<[Line<W>; 2]>),
}

impl<W: Clone> Pass<W> {
    /// A pass without special points, the same rule everywhere.
    pub fn regular(from: Lattice, to: Lattice, line: Line<W>) -> Self {
        Pass {
            from,
            to,
            lines: Lines::Alike(line),
            special: BTreeMap::new(),
        }
    }

    /// A pass without special points whose rules differ from spoke to spoke: `lines[i]` are those of the
    /// sector that begins at spoke i, along that spoke (across the next) and along the next (across that
    /// spoke). There is one pair for each [spoke](Fan::spokes); the last of an open fan belongs to the points
    /// of its last spoke.
    pub fn by_sector(from: Lattice, to: Lattice, lines: Vec<[Line<W>; 2]>) -> Self {
        Pass {
            from,
            to,
            lines: Lines::Sectors(lines),
            special: BTreeMap::new(),
        }
    }

    /// The same with a stencil at `site`. In a closed fan stencils of sector 0 stand for all sectors unless
    /// some pass of the level has one in another sector.
    pub fn with(mut self, site: Site, stencil: Stencil<W>) -> Self {
        self.special.insert(site, stencil);
        self
    }

    /// The net that is read.
    pub fn from(&self) -> Lattice {
        self.from
    }

    /// The net that is made.
    pub fn to(&self) -> Lattice {
        self.to
    }

    /// The rules of the points of a sector: along its own spoke, and along the next.
    pub fn lines(&self, sector: usize) -> [&Line<W>; 2] {
        match &self.lines {
            Lines::Alike(line) => [line, line],
            // the centre and the regular points of sectors beyond the list do not exist: Level::new has
            // counted them
            Lines::Sectors(lines) => {
                let [own, next] = &lines[sector];
                [own, next]
            }
        }
    }

    /// The one rule, if it is the same in all sectors and directions.
    pub fn line(&self) -> Option<&Line<W>> {
        match &self.lines {
            Lines::Alike(line) => Some(line),
            Lines::Sectors(_) => None,
        }
    }

    /// Every rule that is in use, with the sector it belongs to.
    pub fn all_lines(&self) -> impl Iterator<Item = &Line<W>> {
        let (alike, sectors) = match &self.lines {
            Lines::Alike(line) => (Some(line), &[][..]),
            Lines::Sectors(lines) => (None, lines.as_slice()),
        };
        alike.into_iter().chain(sectors.iter().flatten())
    }

    /// How many sectors have rules of their own; `None` if all are alike.
    pub fn listed_sectors(&self) -> Option<usize> {
        match &self.lines {
            Lines::Alike(_) => None,
            Lines::Sectors(lines) => Some(lines.len()),
        }
    }

    /// Target points per source point.
    pub fn scale(&self) -> i32 {
        self.all_lines().next().map_or(1, Line::scale)
    }

    /// The points with a stencil of their own, as listed.
    pub fn special(&self) -> &BTreeMap<Site, Stencil<W>> {
        &self.special
    }

    /// The same with the special stencils that `keep` agrees to.
    pub(crate) fn retaining(mut self, keep: impl Fn(Site) -> bool) -> Self {
        self.special.retain(|&site, _| keep(site));
        self
    }

    /// The same rules with other weights.
    pub fn map<T: Clone>(&self, mut f: impl FnMut(&W) -> T) -> Pass<T> {
        let lines = match &self.lines {
            Lines::Alike(line) => Lines::Alike(line.map(&mut f)),
            Lines::Sectors(lines) => {
                let pairs = lines.iter().map(|[own, next]| [own.map(&mut f), next.map(&mut f)]);
                Lines::Sectors(pairs.collect())
            }
        };
        let special = self.special.iter().map(|(&site, stencil)| (site, stencil.map(&mut f)));
        Pass {
            from: self.from,
            to: self.to,
            lines,
            special: special.collect(),
        }
    }

    /// The farthest target ring that can read a source ring at most `ring`.
    pub(crate) fn farthest_reader(&self, ring: usize) -> usize {
        let reach = 2 * ring as i32 + 1;
        let regular = self.all_lines().map(|line| line.farthest_reader(reach)).max();
        let special = self.special.keys().map(|site| site.x.max(site.y)).max();
        (regular.max(special).unwrap_or(0) / 2) as usize
    }

    /// The sites that the regular rule of `site` reads, by their coordinates in its sector.
    pub(crate) fn tensor_sources(&self, site: Site) -> impl Iterator<Item = (i32, i32)> {
        let [own, next] = self.lines(site.sector);
        let ys: Vec<i32> = next.taps(site.y).map(|(y, _)| y).collect();
        let xs: Vec<i32> = own.taps(site.x).map(|(x, _)| x).collect();
        xs.into_iter()
            .flat_map(move |x| ys.clone().into_iter().map(move |y| (x, y)))
    }

    /// Where a regular rule of `site` finds the point `(x, y)` of its sector's plane. A point of a spoke that
    /// reads straight across the centre has two continuations, which agree only where four sectors meet.
    pub(crate) fn source(fan: Fan, site: Site, x: i32, y: i32) -> Option<Site> {
        if site.y == 0 && y == 0 && x < 0 && fan != Fan::Closed(4) {
            return None;
        }
        Site::new(fan, site.sector as i64, x, y)
    }
}
