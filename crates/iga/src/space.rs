//! The space of one level: control points with a layer of ghosts, and faces with their basis functions.
//!
//! Every boundary vertex of two faces has a ghost beyond it, a corner three. The geometry extrapolates,
//! `c_(-1) = 2 c_0 - c_1`. The solution has either the same relation ([`Ends::Natural`]) or ghosts of its
//! own, in the basis of an open knot vector ([`Ends::Open`]): `c_(-1) = 6 b_(-1) - 6 b_0 + b_1`,
//! `c_0 = (3 b_0 - b_1)/2`, `c_1 = b_1` in each normal direction, tensor at corners. Then the trace is a
//! spline of the ghosts' b alone.

use crate::Error;
use crate::around::Around;
use crate::cells::{Cells, Kind};
use crate::patch::Rule;
use crate::sparse::Sparse;
use crate::tables::{Known, Table, element, far, gauss};
use eigenring_nonuniform::{Element, grid};
use eigenring_scheme::{Fan, Lattice, Numbering};
use eigenring_surface::{Mesh, Point3, Rules, Topology};
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, HashMap};

/// The solution beyond the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// Ghost coefficients are unknowns: all bicubic splines.
    Open,
    /// Ghosts are extrapolated: the second normal derivative in the parameter vanishes.
    Natural,
}

/// How deep the annuli of an extraordinary vertex go.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Depth {
    /// Until the rest of the area is rounding.
    Area,
    /// Until the rest of the energy of second derivatives is small.
    Energy,
    /// As wanted.
    Given(usize),
}

/// A boundary edge with the 16 points around its face: it runs from (0, 0) to (1, 0), the face above.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    pub points: [u32; 16],
    /// Knot intervals along and across; `None` for equal ones.
    pub intervals: Option<[[f64; 5]; 2]>,
}

/// One level of a space.
#[derive(Debug)]
pub(crate) struct Space {
    /// Coordinates of control points and ghosts.
    pub positions: Vec<[f64; 3]>,
    /// Whether all of it is in the plane z = 0, where orientation is told.
    pub planar: bool,
    pub cells: Cells,
    /// Control points without ghosts.
    pub inner: usize,
    /// Control points of the boundary.
    pub boundary: Vec<bool>,
    /// Coefficients in unknowns.
    pub transform: Sparse,
    /// Unknowns in coefficients, as far as the ends have them.
    pub inverse: Sparse,
    /// The ghosts of boundary vertices.
    pub layers: Vec<(u32, Corner)>,
    pub edges: Vec<Edge>,
    pub around: BTreeMap<usize, Around>,
    pub elements: Vec<Element>,
}

/// The mesh with its ghosts.
pub(crate) fn extended(mesh: &Mesh, topology: &Topology) -> Result<(Mesh, Vec<(u32, Corner)>), Error> {
    let mut points = mesh.points().to_vec();
    let mut layers = Vec::new();
    let mut corners = Vec::new();
    let extrapolated = |a: Point3<f64>, b: Point3<f64>| a + (a - b);
    let mut beyond: HashMap<u32, [u32; 2]> = HashMap::new();
    for v in 0..topology.vertex_count() as u32 {
        let fan = topology.fan(v);
        let Some(last) = fan.last else { continue };
        let at = |i: u32| mesh.points()[i as usize];
        let next = points.len() as u32;
        match fan.spokes[..] {
            [spoke] => {
                let (a, b) = (topology.head(spoke), topology.origin(last));
                let diagonal = topology.head(topology.next(spoke));
                let [west, south] = [extrapolated(at(v), at(a)), extrapolated(at(v), at(b))];
                let along = extrapolated(at(b), at(diagonal));
                points.extend([west, extrapolated(west, along), south]);
                corners.extend([v, next, next + 1, next + 2]);
                beyond.insert(v, [next + 2, next]);
                layers.push((v, Corner::Two([a, b, diagonal], [next, next + 1, next + 2])));
            }
            [_, middle] => {
                let inside = topology.head(middle);
                points.push(extrapolated(at(v), at(inside)));
                beyond.insert(v, [next; 2]);
                layers.push((v, Corner::One(inside, next)));
            }
            _ => {
                return Err(Error::Reentrant {
                    vertex: v as usize,
                    faces: fan.spokes.len(),
                });
            }
        }
    }
    for half in (0..topology.half_count() as u32).filter(|&half| topology.twin(half).is_none()) {
        let [a, b] = topology.ends(half);
        corners.extend([a, beyond[&a][0], beyond[&b][1], b]);
    }
    if mesh.is_quads() {
        return Ok((Mesh::of_quads(points, [mesh.corners(), &corners].concat()), layers));
    }
    let mut full = Mesh::of_points(points);
    for face in mesh.faces().chain(corners.chunks(4)) {
        full.push_face(face)?;
    }
    Ok((full, layers))
}

/// The ghosts of a boundary vertex, and what they depend on.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Corner {
    /// The inner neighbour and the ghost.
    One(u32, u32),
    /// At a corner of the domain: neighbours (1,0), (0,1), (1,1); ghosts (-1,0), (-1,-1), (0,-1).
    Two([u32; 3], [u32; 3]),
}

/// What equal intervals have for [`across`].
pub(crate) const EQUAL: f64 = 2.0;

/// Control points -1, 0, 1 across the boundary in unknowns -1, 0, 1. With the intervals d and e of the first
/// two faces inside, which the ghosts mirror, `r = (d + e)/d`: control points are the values of the polar
/// form at `(-d-e, -d, 0)`, `(-d, 0, d)`, `(0, d, d+e)`, unknowns those at `(0, 0, 0)`, `(0, 0, d)` and the
/// same last.
fn across(ends: Ends, r: f64) -> [[f64; 3]; 3] {
    match ends {
        Ends::Open => {
            let twice = 2.0 * (1.0 + r);
            [[twice, -twice, 1.0], [0.0, 1.0 + 1.0 / r, -1.0 / r], [0.0, 0.0, 1.0]]
        }
        Ends::Natural => [[0.0, 2.0, -1.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    }
}

/// The inverse of [`across`]; natural ends have no unknowns beyond the boundary.
fn back_across(ends: Ends, r: f64) -> [[f64; 3]; 3] {
    match ends {
        Ends::Open => [
            [0.5 / (r + 1.0), r / (r + 1.0), 0.5 / (r + 1.0)],
            [0.0, r / (r + 1.0), 1.0 / (r + 1.0)],
            [0.0, 0.0, 1.0],
        ],
        Ends::Natural => [[0.0; 3], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    }
}

/// Coefficients in unknowns by the relation across the boundary, or the other way round; `None` where two
/// corners of the domain are neighbours. `line` is the relation at a vertex towards each of its inner
/// neighbours.
fn transform(count: usize, layers: &[(u32, Corner)], line: impl Fn(u32, usize) -> [[f64; 3]; 3]) -> Option<Sparse> {
    let mut rows: BTreeMap<u32, Vec<(u32, f64)>> = BTreeMap::new();
    let single = |(v, corner): &(u32, Corner)| match corner {
        Corner::One(_, ghost) => Some((*v, *ghost)),
        Corner::Two(..) => None,
    };
    let ghosts: HashMap<u32, u32> = layers.iter().filter_map(single).collect();
    for (v, corner) in layers {
        match corner {
            Corner::One(inside, ghost) => {
                let (ids, line) = ([*ghost, *v, *inside], line(*v, 0));
                for i in 0..2 {
                    let terms = (0..3).map(|k| (ids[k], line[i][k]));
                    rows.insert(ids[i], terms.filter(|(_, w)| *w != 0.0).collect());
                }
            }
            Corner::Two([a, b, diagonal], [west, both, south]) => {
                // ids[i][j] is the point (i - 1, j - 1)
                let (under, beside) = (*ghosts.get(a)?, *ghosts.get(b)?);
                let ids = [[*both, *west, beside], [*south, *v, *b], [under, *a, *diagonal]];
                let [first, second] = [0, 1].map(|direction| line(*v, direction));
                for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let terms = (0..9).map(|k| (ids[k / 3][k % 3], first[i][k / 3] * second[j][k % 3]));
                    rows.insert(ids[i][j], terms.filter(|(_, w)| *w != 0.0).collect());
                }
            }
        }
    }
    Some(Sparse::identity_but(count, rows))
}

/// Coefficients in unknowns and unknowns in coefficients, see [`transform`]. `ratio` is that of [`across`] at
/// a vertex towards each of its inner neighbours.
pub(crate) fn transforms(
    count: usize,
    layers: &[(u32, Corner)],
    ends: Ends,
    ratio: impl Fn(u32, usize) -> f64,
) -> Option<[Sparse; 2]> {
    let forth = transform(count, layers, |v, direction| across(ends, ratio(v, direction)))?;
    let back = transform(count, layers, |v, direction| back_across(ends, ratio(v, direction)))?;
    Some([forth, back])
}

/// The points of some rings around a vertex, sector 0 at a spoke.
pub(crate) fn rings(topology: &Topology, half: u32, valence: usize, rings: usize) -> Option<Vec<u32>> {
    let numbering = Numbering {
        fan: Fan::Closed(valence),
        lattice: Lattice::Vertex,
        rings,
    };
    let mut points = vec![0; numbering.count()];
    let straight = |half: u32| topology.turned_back(topology.next(half));
    let mut spokes = vec![half];
    while spokes.len() < valence {
        spokes.push(topology.turned(*spokes.last()?)?);
    }
    for site in numbering.sites() {
        let Some(index) = numbering.index(site) else { continue };
        let mut at = spokes[site.sector];
        if site.x == 0 {
            points[index] = topology.origin(at);
            continue;
        }
        for _ in 1..site.x / 2 {
            at = straight(at)?;
        }
        for step in 0..site.y / 2 {
            at = if step == 0 { topology.next(at) } else { straight(at)? };
        }
        points[index] = topology.head(at);
    }
    Some(points)
}

impl Space {
    /// The space over a mesh of quads; `None` if extraordinary vertices or boundaries are too close.
    pub fn new(mesh: &Mesh, rules: &Rules, ends: Ends, tuned: bool) -> Result<Option<Self>, Error> {
        let coarse = Topology::new(mesh).map_err(eigenring_surface::Error::from)?;
        let (full, layers) = extended(mesh, &coarse)?;
        let topology = Topology::unchecked(&full);
        let inner = mesh.points().len();
        let mut boundary = vec![false; full.points().len()];
        for (v, _) in &layers {
            boundary[*v as usize] = true;
        }
        for number in 0..coarse.edge_count() as u32 {
            let [a, b] = coarse.edge_points(number);
            if !coarse.is_boundary(number) && boundary[a as usize] && boundary[b as usize] {
                return Ok(None);
            }
        }
        let valence: Vec<usize> = (0..inner as u32).map(|v| topology.fan(v).spokes.len()).collect();
        let special = |v: u32| (v as usize) < inner && valence[v as usize] != 4;
        let mut around = BTreeMap::new();
        let mut cells = Cells::default();
        for face in 0..mesh.face_count() as u32 {
            let halves = topology.face_halves(face);
            let mut centres = halves.clone().filter(|&half| special(topology.origin(half)));
            if let Some(half) = centres.next() {
                let n = valence[topology.origin(half) as usize];
                crate::check_valence(n)?;
                let Some(points) = rings(&topology, half, n, 2) else {
                    return Ok(None);
                };
                let others = points.iter().skip(1).any(|&v| special(v));
                let rim = points.iter().skip(1).any(|&v| v as usize >= inner);
                if centres.next().is_some() || (tuned && (others || rim)) {
                    return Ok(None);
                }
                cells.push(face, Kind::Irregular(n), &points);
                if let Entry::Vacant(entry) = around.entry(n) {
                    let scheme = rules.inner(None, n)?;
                    if !crate::accepts(&scheme)? {
                        return Err(Error::NotBicubic(scheme.name().to_owned()));
                    }
                    entry.insert(Around::new(n, scheme.limit())?);
                }
                continue;
            }
            let Some(first) = grid(&topology, halves.start) else {
                return Ok(None);
            };
            let count = first.iter().filter(|&&v| special(v)).count();
            if !tuned || count == 0 {
                cells.push(face, Kind::Far, &first);
                continue;
            }
            let grids: Option<Vec<[u32; 16]>> = halves.map(|half| grid(&topology, half)).collect();
            let Some(grids) = grids else { return Ok(None) };
            let beside = grids.iter().find_map(|grid| {
                let places = [(4, [1, 0]), (0, [1, 1]), (1, [0, 1])];
                places
                    .iter()
                    .find(|(k, _)| special(grid[*k]))
                    .map(|(k, at)| (grid, grid[*k], *at))
            });
            let Some((grid, v, at)) = beside.filter(|_| count == 1) else {
                return Ok(None);
            };
            cells.push(face, Kind::Near(valence[v as usize], at), grid);
        }
        let edges: Option<Vec<Edge>> = (0..coarse.half_count() as u32)
            .filter(|&half| coarse.twin(half).is_none())
            .map(|half| {
                Some(Edge {
                    points: grid(&topology, half)?,
                    intervals: None,
                })
            })
            .collect();
        let transforms = transforms(full.points().len(), &layers, ends, |_, _| EQUAL);
        let (Some(edges), Some([transform, inverse])) = (edges, transforms) else {
            return Ok(None);
        };
        let planar = full.points().iter().all(|p| p.z == 0.0);
        Ok(Some(Space {
            positions: full.points().iter().map(|p| [p.x, p.y, p.z]).collect(),
            planar,
            cells,
            inner,
            boundary,
            transform,
            inverse,
            layers,
            edges,
            around,
            elements: Vec::new(),
        }))
    }

    /// The tables of all kinds of faces; `scaled` tells whether the last annulus stands for those that
    /// follow.
    pub fn tables(&self, order: usize, depth: Depth, scaled: bool) -> BTreeMap<Kind, Table> {
        self.tables_at(&gauss(order), depth, scaled)
    }

    /// The same at any points of the patches.
    pub fn tables_at(&self, rule: &Rule, depth: Depth, scaled: bool) -> BTreeMap<Kind, Table> {
        let of = |around: &Around| match depth {
            Depth::Area => around.depth(),
            Depth::Energy => around.plate_depth().unwrap_or(crate::MOST_ANNULI),
            Depth::Given(depth) => depth,
        };
        let mut tables = BTreeMap::new();
        let mut known = Known::new(rule);
        for cell in self.cells.iter() {
            tables.entry(cell.kind).or_insert_with(|| match cell.kind {
                Kind::Far => far(&known.uniform),
                Kind::Near(n, at) => self.around[&n].near(&known.uniform, at),
                Kind::Irregular(n) => {
                    let around = &self.around[&n];
                    around.irregular(&known.uniform, of(around), scaled)
                }
                Kind::Element(k) => {
                    let of = &self.elements[k];
                    let depth = match depth {
                        Depth::Given(depth) => depth,
                        _ => of.depth(),
                    };
                    element(of, &mut known, depth, scaled)
                }
            });
        }
        tables
    }
}
