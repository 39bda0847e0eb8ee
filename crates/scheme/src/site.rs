//! The lattice around an extraordinary vertex or face, and its one numbering.
//!
//! N sectors meet in a centre. Sector `i` is the quadrant between spoke `i` and spoke `i+1`; a point of it
//! has coordinates `(x, y)`, `x` along spoke `i` and `y` along spoke `i+1`, **in half steps**: points of a
//! net around a vertex have even coordinates (`P_i(a,b)` is `(2a, 2b)`), points of a net around a face have
//! odd ones (`(2a+1, 2b+1)`). One folding rule then serves both kinds of net:
//!
//! ```text
//!            (0,4)---(2,4)---(4,4)         spoke i+1 belongs to sector i+1: (0,4) of sector i
//!              |       |       |           folds to (4,0) of sector i+1
//!            (0,2)---(2,2)---(4,2)
//!              |  (1,1)|  (3,1)|           x > 0, y < 0   ->  sector i-1, (-y,  x)
//!            (0,0)---(2,0)---(4,0)         x <= 0, y > 0  ->  sector i+1, ( y, -x)
//!            centre     spoke i
//! ```
//!
//! Ring `r` of a vertex net is `max(a, b) = r`, the centre being ring 0; R rings hold `1 + N R (R+1)` points.
//! Ring `r` of a face net is `max(a, b) = r`; rings 0 to R hold `N (R+1)^2` points.
//!
//! Around a centre on a boundary, or on one side of a crease, N sectors form an **open** fan with spokes 0 to
//! N. The last spoke belongs to no sector of faces; its points have the sector N and `y = 0`, and R rings
//! hold R points more.

/// How the sectors around a centre are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fan {
    /// `n` sectors around an interior vertex or face: sector `n` is sector 0.
    Closed(usize),
    /// `n` sectors in a row between two spokes that are boundaries or creases.
    Open(usize),
}

impl Fan {
    /// The number of sectors.
    pub fn sectors(self) -> usize {
        match self {
            Fan::Closed(n) | Fan::Open(n) => n,
        }
    }

    /// The number of spokes: one more than sectors in an open fan.
    pub fn spokes(self) -> usize {
        match self {
            Fan::Closed(n) => n,
            Fan::Open(n) => n + 1,
        }
    }

    /// Whether the last sector joins the first.
    pub fn is_closed(self) -> bool {
        matches!(self, Fan::Closed(_))
    }

    /// The sector of an index that may have run past the ends. `None` outside of an open fan.
    fn sector(self, index: i64) -> Option<usize> {
        match self {
            Fan::Closed(n) => Some(index.rem_euclid(n as i64) as usize),
            Fan::Open(n) => usize::try_from(index).ok().filter(|&sector| sector <= n),
        }
    }
}

/// Where the points of a net sit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Lattice {
    /// Even coordinates: the centre of the fan is a point of the net (primal).
    Vertex,
    /// Odd coordinates: the centre of the fan is the middle of a face of the net (dual).
    Face,
}

impl Lattice {
    /// The word that users write.
    pub fn name(self) -> &'static str {
        match self {
            Lattice::Vertex => "vertex",
            Lattice::Face => "face",
        }
    }

    /// 0 or 1: the parity of the coordinates.
    pub fn parity(self) -> i32 {
        match self {
            Lattice::Vertex => 0,
            Lattice::Face => 1,
        }
    }
}

/// A point of the lattice in its canonical sector: the centre, or `x > 0, y >= 0`. Coordinates are half
/// steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Site {
    /// The sector, 0 for the centre.
    pub sector: usize,
    /// Half steps along spoke `sector`.
    pub x: i32,
    /// Half steps along spoke `sector + 1`.
    pub y: i32,
}

impl Site {
    /// The centre of the fan.
    pub const CENTRE: Site = Site { sector: 0, x: 0, y: 0 };

    /// Folds any `(sector, x, y)` into its canonical form. Both rays that bound the quadrant opposite to the
    /// sector are reached over the spoke next to them: `(x < 0, 0)` is on spoke `i+2`, `(0, y < 0)` on spoke
    /// `i-1`. `None` inside that quadrant, where the plane of the sector has no unique continuation unless
    /// four sectors meet, and outside of an open fan.
    pub fn new(fan: Fan, sector: i64, x: i32, y: i32) -> Option<Site> {
        debug_assert!(
            (x - y) % 2 == 0,
            "({x}, {y}) is on neither the vertex nor the face lattice"
        );
        let (sector, x, y) = match (x, y) {
            (0, 0) => return Some(Site::CENTRE),
            (1.., 0..) => (sector, x, y),
            (0.., ..0) => (sector - 1, -y, x),
            (..=0, 1..) => (sector + 1, y, -x),
            (..0, 0) => (sector + 2, -x, 0),
            (..0, ..0) if fan == Fan::Closed(4) => (sector + 2, -x, -y),
            _ => return None,
        };
        let sector = fan.sector(sector)?;
        // beyond the last spoke of an open fan there is nothing
        let exists = y == 0 || sector < fan.sectors();
        exists.then_some(Site { sector, x, y })
    }

    /// The lattice this site belongs to.
    pub fn lattice(self) -> Lattice {
        if self.x % 2 == 0 {
            Lattice::Vertex
        } else {
            Lattice::Face
        }
    }

    /// The ring, as numbered on the module page.
    pub fn ring(self) -> usize {
        (self.x.max(self.y) / 2) as usize
    }

    /// The same place `sectors` further on, around a closed fan.
    pub fn rotated(self, fan: Fan, sectors: i64) -> Site {
        if self == Site::CENTRE {
            return self;
        }
        debug_assert!(fan.is_closed() || sectors == 0, "an open fan has no rotations");
        let sector = (self.sector as i64 + sectors).rem_euclid(fan.spokes() as i64);
        Site {
            sector: sector as usize,
            ..self
        }
    }

    /// The image under the reflection that exchanges spoke `i` with spoke `-i` of a closed fan, `N-i` of an
    /// open one.
    pub fn mirrored(self, fan: Fan) -> Site {
        if self == Site::CENTRE {
            return self;
        }
        let n = fan.sectors();
        if self.y > 0 {
            let sector = n - 1 - self.sector;
            return Site {
                sector,
                x: self.y,
                y: self.x,
            };
        }
        let sector = if fan.is_closed() {
            (n - self.sector) % n
        } else {
            n - self.sector
        };
        Site { sector, ..self }
    }
}

/// The points of a net out to a given ring, in the one order that every matrix and table uses: rings
/// outwards; within a ring sector by sector; within a sector from spoke `i` (`y = 0` or 1) along the ring
/// towards spoke `i+1`. The matrix of fewer rings is therefore a leading part of the matrix of more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Numbering {
    /// The sectors.
    pub fan: Fan,
    /// The kind of net.
    pub lattice: Lattice,
    /// The outermost ring.
    pub rings: usize,
}

impl Numbering {
    /// Points of one sector in ring `r`; the centre belongs to no sector.
    fn ring_width(self, ring: usize) -> usize {
        match self.lattice {
            Lattice::Vertex => 2 * ring,
            Lattice::Face => 2 * ring + 1,
        }
    }

    /// Points of one sector in the rings before `ring`, centre not counted.
    fn sector_points_before(self, ring: usize) -> usize {
        match self.lattice {
            Lattice::Vertex => ring * ring.saturating_sub(1),
            Lattice::Face => ring * ring,
        }
    }

    /// 1 if the centre is a point of the net.
    fn centre(self) -> usize {
        match self.lattice {
            Lattice::Vertex => 1,
            Lattice::Face => 0,
        }
    }

    /// The number of points.
    pub fn count(self) -> usize {
        self.centre() + self.fan.sectors() * self.sector_points() + self.last_spoke(self.rings + 1)
    }

    /// Points of the last spoke of an open fan in the rings before `ring`.
    fn last_spoke(self, ring: usize) -> usize {
        if self.fan.is_closed() {
            0
        } else {
            ring.saturating_sub(1)
        }
    }

    /// The number of points of one sector, centre not counted: the size of a Fourier block with index k != 0.
    pub fn sector_points(self) -> usize {
        self.sector_points_before(self.rings + 1)
    }

    /// The position of a site along its ring within its sector.
    fn along(site: Site) -> usize {
        // (r,0), (r,1), ..., (r,r), (r-1,r), ..., in half steps (parities cancel)
        if site.x >= site.y {
            (site.y / 2) as usize
        } else {
            (site.x.max(site.y) / 2 + (site.y - site.x) / 2) as usize
        }
    }

    /// The index of a site, `None` if it is off the net or beyond its last ring.
    pub fn index(self, site: Site) -> Option<usize> {
        if site.lattice() != self.lattice || site.ring() > self.rings {
            return None;
        }
        if site == Site::CENTRE {
            return Some(0);
        }
        let (ring, n) = (site.ring(), self.fan.sectors());
        Some(
            self.centre()
                + n * self.sector_points_before(ring)
                + self.last_spoke(ring)
                + site.sector * self.ring_width(ring)
                + Self::along(site),
        )
    }

    /// The position of a site within its own sector's points, centre not counted: its row in a Fourier block
    /// with k != 0.
    pub fn index_in_sector(self, site: Site) -> Option<usize> {
        (site != Site::CENTRE && site.lattice() == self.lattice && site.ring() <= self.rings)
            .then(|| self.sector_points_before(site.ring()) + Self::along(site))
    }

    /// The sites of one sector, in order, centre not included; of sector N of an open fan those of the last
    /// spoke.
    pub fn sector_sites(self, sector: usize) -> impl Iterator<Item = Site> {
        let parity = self.lattice.parity();
        let spoke_only = sector == self.fan.sectors();
        (0..=self.rings as i32).flat_map(move |ring| {
            let r = 2 * ring + parity;
            let up = (parity..=r).step_by(2).map(move |y| (r, y));
            let back = (1 - parity..ring).rev().map(move |a| (2 * a + parity, r));
            up.chain(back)
                .filter(move |&(x, y)| x > 0 && (y == 0 || !spoke_only))
                .map(move |(x, y)| Site { sector, x, y })
        })
    }

    /// All sites, in order.
    pub fn sites(self) -> Vec<Site> {
        let mut sites = vec![Site::CENTRE; self.count()];
        for sector in 0..self.fan.spokes() {
            for site in self.sector_sites(sector) {
                let index = self.index(site).expect("a listed site is on the net");
                sites[index] = site;
            }
        }
        sites
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numberings() -> impl Iterator<Item = Numbering> {
        (3..9).flat_map(|n| {
            (0..6).flat_map(move |rings| {
                [Lattice::Vertex, Lattice::Face].map(|lattice| Numbering {
                    fan: Fan::Closed(n),
                    lattice,
                    rings,
                })
            })
        })
    }

    #[test]
    fn every_site_has_its_own_index() {
        for numbering in numberings() {
            let (n, r) = (numbering.fan.sectors(), numbering.rings);
            let expected = match numbering.lattice {
                Lattice::Vertex => 1 + n * r * (r + 1),
                Lattice::Face => n * (r + 1) * (r + 1),
            };
            let sites = numbering.sites();
            assert_eq!(sites.len(), expected);
            for (index, &site) in sites.iter().enumerate() {
                assert_eq!(numbering.index(site), Some(index), "{site:?}");
                assert!(site.ring() <= r && site.lattice() == numbering.lattice);
            }
            for (index, site) in numbering.sector_sites(2).enumerate() {
                assert_eq!(numbering.index_in_sector(site), Some(index));
            }
        }
    }

    #[test]
    fn fewer_rings_are_a_leading_part() {
        for numbering in numberings().filter(|n| n.rings > 0) {
            let fewer = Numbering {
                rings: numbering.rings - 1,
                ..numbering
            };
            assert_eq!(fewer.sites(), numbering.sites()[..fewer.count()]);
        }
    }

    #[test]
    fn folding_turns_about_the_centre() {
        let fan = Fan::Closed(5);
        let site = |sector, x, y| Site { sector, x, y };
        assert_eq!(Site::new(fan, 2, 4, -2), Some(site(1, 2, 4)));
        assert_eq!(Site::new(fan, 0, 0, -2), Some(site(4, 2, 0)));
        assert_eq!(Site::new(fan, 4, -2, 2), Some(site(0, 2, 2)));
        assert_eq!(Site::new(fan, 3, 0, 6), Some(site(4, 6, 0)));
        assert_eq!(Site::new(fan, 0, 1, -3), Some(site(4, 3, 1)));
        assert_eq!(Site::new(fan, 0, -1, 1), Some(site(1, 1, 1)));
        assert_eq!(Site::new(fan, 0, 0, 0), Some(Site::CENTRE));
        assert_eq!(Site::new(fan, 0, -2, -2), None);
        // both rays of the opposite quadrant are reached, each over the spoke next to it
        assert_eq!(Site::new(fan, 0, -2, 0), Some(site(2, 2, 0)));
        assert_eq!(Site::new(fan, 0, 0, -2), Some(site(4, 2, 0)));
    }

    #[test]
    fn open_fans_end_at_their_last_spoke() {
        let fan = Fan::Open(3);
        let site = |sector, x, y| Site { sector, x, y };
        assert_eq!(Site::new(fan, 2, 0, 4), Some(site(3, 4, 0)));
        assert_eq!(Site::new(fan, 2, -2, 4), None);
        assert_eq!(Site::new(fan, 0, 4, -2), None);
        assert_eq!(Site::new(fan, 1, 4, -2), Some(site(0, 2, 4)));
        assert_eq!(Site::new(fan, 3, 2, 0), Some(site(3, 2, 0)));
        for rings in 0..5 {
            let numbering = Numbering {
                fan,
                lattice: Lattice::Vertex,
                rings,
            };
            let sites = numbering.sites();
            assert_eq!(sites.len(), 1 + 3 * rings * (rings + 1) + rings);
            for (index, &site) in sites.iter().enumerate() {
                assert_eq!(numbering.index(site), Some(index), "{site:?}");
                assert_eq!(site.mirrored(fan).mirrored(fan), site);
            }
            if rings > 0 {
                let fewer = Numbering {
                    rings: rings - 1,
                    ..numbering
                };
                assert_eq!(fewer.sites(), sites[..fewer.count()]);
            }
        }
    }

    #[test]
    fn at_valence_four_folding_is_rotation_of_the_plane() {
        let fan = Fan::Closed(4);
        for (x, y) in [(2, 0), (4, -2), (-2, 4), (1, -3), (-5, 3), (-2, 0), (-4, -2), (-1, -3)] {
            let Site {
                sector,
                x: mut px,
                y: mut py,
            } = Site::new(fan, 0, x, y).unwrap();
            for _ in 0..sector {
                (px, py) = (-py, px);
            }
            assert_eq!((px, py), (x, y));
        }
    }

    #[test]
    fn reflections_are_involutions_that_keep_rings() {
        for numbering in numberings() {
            let fan = numbering.fan;
            for site in numbering.sites() {
                let image = site.mirrored(fan);
                assert_eq!(image.mirrored(fan), site);
                assert_eq!(image.ring(), site.ring());
                assert!(numbering.index(image).is_some());
            }
        }
    }
}
