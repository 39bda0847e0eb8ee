//! The net around one vertex, and the schemes there as passes.
//!
//! Rules are those of refined meshes: a star of quads with the intervals of a corner is refined, and the rows
//! of its points become stencils. Only points near the vertex need them; beyond, rules are tensor products of
//! univariate ones, which differ from sector to sector.

use crate::{Error, Net, Scheme, eigen_polyhedron_step, nurss_step};
use eigenring_scheme::families::{sector_lines, with_intervals};
use eigenring_scheme::{Centre, Corner, Fan, Lattice, Level, Pass, Scalar, Site, Stencil};
use eigenring_surface::features::edge;
use eigenring_surface::{Mesh, Point3};

/// A star of quads: n sectors of `rings` times `rings` faces around vertex 0, the intervals of each spoke
/// being those of a list, of which the last holds for all further edges.
#[derive(Clone, Debug)]
pub struct Star {
    sectors: usize,
    rings: usize,
    mesh: Mesh,
}

impl Star {
    /// The star with the given intervals of its spokes.
    ///
    /// # Errors
    /// Too many points for 32 bits.
    pub fn new(intervals: &[Vec<f64>], rings: usize) -> Result<Self, Error> {
        let sectors = intervals.len();
        let mut star = Star {
            sectors,
            rings,
            mesh: Mesh::default(),
        };
        let count = 1 + sectors * rings * (rings + 1);
        let mut mesh = Mesh::of_points(vec![Point3::origin(); count]);
        for (i, list) in intervals.iter().enumerate() {
            for (b, a) in (0..rings).flat_map(|b| (0..rings).map(move |a| (b, a))) {
                let corners = [(a, b), (a + 1, b), (a + 1, b + 1), (a, b + 1)];
                mesh.push_face(&corners.map(|(a, b)| star.point(i, a, b)))?;
            }
            for a in 0..rings {
                let value = list.get(a).or(list.last()).copied().unwrap_or(1.0);
                mesh.features
                    .knots
                    .insert(edge(star.point(i, a, 0), star.point(i, a + 1, 0)), value);
            }
        }
        star.mesh = mesh;
        Ok(star)
    }

    /// The number of the point a steps along spoke i and b along the next.
    pub fn point(&self, sector: usize, a: usize, b: usize) -> u32 {
        let (sector, a, b) = if a == 0 { (sector + 1, b, 0) } else { (sector, a, b) };
        if a == 0 {
            return 0;
        }
        let own = (a - 1) * (self.rings + 1) + b;
        (1 + (sector % self.sectors) * self.rings * (self.rings + 1) + own) as u32
    }

    /// Its mesh, with points at the origin.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Points in the plane z = 0, with spokes at equal angles and steps of 1.
    pub fn in_the_plane(&self) -> Vec<[f64; 3]> {
        let spoke = |i: usize| {
            let turn = |f: fn(i64, i64) -> f64| f(i as i64, self.sectors as i64);
            [turn(f64::cos_turn), turn(f64::sin_turn)]
        };
        let mut points = vec![[0.0; 3]; self.mesh.points().len()];
        for sector in 0..self.sectors {
            let (own, next) = (spoke(sector), spoke(sector + 1));
            for (a, b) in (1..=self.rings).flat_map(|a| (0..=self.rings).map(move |b| (a, b))) {
                let at = [0, 1].map(|k| a as f64 * own[k] + b as f64 * next[k]);
                points[self.point(sector, a, b) as usize] = [at[0], at[1], 0.0];
            }
        }
        points
    }

    /// The site of each point.
    fn sites(&self) -> Vec<Site> {
        let mut sites = vec![Site::CENTRE; self.mesh.points().len()];
        for sector in 0..self.sectors {
            for (a, b) in (1..=self.rings).flat_map(|a| (0..=self.rings).map(move |b| (a, b))) {
                let (x, y) = (2 * a as i32, 2 * b as i32);
                sites[self.point(sector, a, b) as usize] = Site { sector, x, y };
            }
        }
        sites
    }
}

/// Levels until the first eight edges of every spoke have one interval.
const LEADING: usize = 3;

/// Rings of the star that is refined: rules near the vertex read two.
const RINGS: usize = 4;

impl Scheme {
    /// What the scheme has in the middle of its closed fans.
    pub fn centre(self) -> Centre {
        match self {
            Scheme::Hnuss(_) => Centre::SplitFace,
            _ => Centre::Vertex,
        }
    }

    /// The scheme around a closed corner with knot intervals; of HNUSS, around the n-gon of its hybrid net.
    ///
    /// # Errors
    /// [`eigenring_scheme::Error::Unsupported`] for other corners; those of the scheme's level.
    pub fn around(self, corner: &Corner) -> Result<eigenring_scheme::Scheme<f64>, Error> {
        if let Scheme::Hnuss(_) = self {
            return Ok(with_intervals("hnuss", corner)?);
        }
        let fan = corner.sectors();
        if !fan.is_closed() || corner.has_creases() || corner.is_fixed() || corner.centre() != Centre::Vertex {
            return Err(Error::Scheme(eigenring_scheme::Error::Unsupported {
                scheme: self.to_string(),
                corner: corner.to_string(),
                accepted: "closed fans around vertices, with knot intervals and without creases".to_owned(),
            }));
        }
        let mut intervals = corner.intervals();
        let mut leading = Vec::new();
        let uniform = |list: &Vec<f64>| list.iter().all(|d| *d == list[0]);
        while leading.len() < LEADING && (leading.is_empty() || !intervals.iter().all(uniform)) {
            if leading.is_empty() && self == Scheme::Nurss && intervals.iter().all(uniform) {
                break;
            }
            leading.push(self.level(&intervals, leading.len())?);
            intervals = intervals
                .iter()
                .map(|list| list.iter().flat_map(|&d| [d, d]).collect())
                .collect();
        }
        let limit: Vec<Vec<f64>> = intervals.iter().map(|list| vec![list[0]]).collect();
        let limit = self.level(&limit, leading.len())?;
        Ok(eigenring_scheme::Scheme::new(self.to_string(), leading, limit))
    }

    /// One level around a vertex with these intervals of its spokes.
    fn level(self, intervals: &[Vec<f64>], number: usize) -> Result<Level<f64>, Error> {
        let n = intervals.len();
        let star = Star::new(intervals, RINGS)?;
        let net = Net::new(star.mesh())?;
        let step = match self {
            Scheme::EigenPolyhedron if number > 0 => eigen_polyhedron_step(&net),
            _ => nurss_step(&net),
        };
        let step = step.map_err(Error::of_spokes)?;
        let sites = star.sites();
        let topology = net.topology();
        let (vertices, edges) = (topology.vertex_count(), topology.edge_count());
        let mut targets = vec![(Site::CENTRE, 0)];
        for spoke in topology.fan(0).spokes {
            // the fan may begin with any spoke
            let sector = sites[topology.head(spoke) as usize].sector;
            // the edges of the face that do not meet the vertex
            let (ahead, beyond) = (topology.next(spoke), topology.next(topology.next(spoke)));
            let edge = |half: u32| vertices + topology.edge(half) as usize;
            let rows = [
                ((2, 0), edge(spoke)),
                ((2, 2), vertices + edges + topology.face(spoke) as usize),
                ((4, 0), topology.head(spoke) as usize),
                ((4, 2), edge(ahead)),
                ((2, 4), edge(beyond)),
                ((4, 4), topology.head(ahead) as usize),
            ];
            targets.extend(rows.map(|((x, y), row)| (Site { sector, x, y }, row)));
        }
        let lines = Pass::by_sector(Lattice::Vertex, Lattice::Vertex, sector_lines(intervals));
        let pass = targets.into_iter().fold(lines, |pass, (target, row)| {
            let terms = step.table.row(row).map(|(at, weight)| (sites[at], *weight));
            pass.with(
                target,
                terms.fold(Stencil::new(), |stencil, (site, weight)| stencil.with(site, weight)),
            )
        });
        Ok(Level::new(Fan::Closed(n), vec![pass])?)
    }
}
