//! One level of a dual scheme on a mesh: Doo-Sabin, and all odd orders.
//!
//! A level cuts the corners of every face by the rules of the scheme around its middle; the new faces, here
//! called *cells*, belong to the faces, edges and vertices before. Where there are rims (boundary or crease
//! edges) cells along them are *half cells*, with the points `b` of the rim on them:
//!
//! * the first level, on the control mesh: each rim edge `vw` gives the curve's two points
//!   `((1+2u) v + w) / (2(1+u))`, each side of it a half cell `b_w, q_w, q_v, b_v`; each vertex a cell in
//!   each fan between rim edges, with the corner in front if the vertex stays;
//! * later ones: `b' = (u b + c)/(1+u)` for both rim edges of a rim point, `c` the edge's middle, or the
//!   corner in which it ends; half cells by [`half_cell`]. A cell becomes a cell, an edge between two corners
//!   of cells a quad, an edge that ends on the rim a half cell, a corner of four cells a quad.
//!
//! Smoothing (orders 5, 7, ..) then moves each point to the mean of the centres of its four cells, a half
//! cell's centre being the middle of its rim edge or its corner, and a rim point to the mean of its two `c`.

use crate::features::{INFINITE, edge};
use crate::limit::DualNet;
use crate::refine::{Row, add};
use crate::rules::{Method, Rules};
use crate::{Boundary, Error, Mesh, Topology};
use eigenring_scheme::families::{half_cell, tension_at};
use eigenring_scheme::{Lattice, Site, Stencil, Table};
use nalgebra::Point3;
use std::collections::{BTreeSet, HashMap};

/// A net of cells.
#[derive(Clone, Debug)]
pub struct CellNet {
    /// Points and cells.
    pub mesh: Mesh,
    /// For each cell whether it is a half cell: with a corner in front, or without.
    halves: Vec<Option<bool>>,
    /// For each point what it is.
    points: Vec<Role>,
    /// Whether this is the control mesh, whose faces are whole.
    control: bool,
    rims: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Role {
    /// Of four cells.
    Inner,
    /// On a boundary or crease.
    Rim,
    /// Where a rim stays.
    Corner,
}

impl CellNet {
    /// The control mesh of a dual scheme.
    pub fn new(mut mesh: Mesh, boundary: Boundary) -> Self {
        mesh.features.boundary = Some(boundary);
        CellNet {
            halves: vec![None; mesh.face_count()],
            points: vec![Role::Inner; mesh.points().len()],
            mesh,
            control: true,
            rims: boundary != Boundary::Shrink,
        }
    }

    /// The net after a level, 0 for the first.
    ///
    /// # Errors
    /// [`Error::NoRule`] for darts, cusps and creases that are not sharp for ever, and for passes that are no
    /// corner cutting with averaging.
    pub fn refined(&self, rules: &Rules, level: usize) -> Result<CellNet, Error> {
        let (mut net, _) = self.refined_with_places(rules, level)?;
        if !net.rims {
            // points at the rim of an open net are in cells still
            net.mesh = net.mesh.without_unused();
            net.points = vec![Role::Inner; net.mesh.points().len()];
        }
        Ok(net)
    }

    /// The points of the first level on the quarters of faces ([`quads`](crate::refine::quads)), a face for
    /// each corner.
    pub(crate) fn first_on_quads(self, rules: &Rules) -> Result<DualNet, Error> {
        let topology = Topology::unchecked(&self.mesh);
        let vertices = topology.vertex_count() as u32;
        let (net, places) = self.refined_with_places(rules, 0)?;
        // the quarters' points get the first numbers
        let rims = places.on_rim.into_iter();
        let rims = rims.map(|((number, end), at)| (edge(end, vertices + number), at));
        let corners = places.kept.into_iter();
        let all = DualNet {
            points: net.mesh.points().to_vec(),
            rims: HashMap::new(),
            corners: HashMap::new(),
        };
        let mut rims: Vec<_> = rims.collect();
        let mut corners: Vec<_> = corners.collect();
        rims.sort_unstable();
        corners.sort_unstable();
        Ok(all
            .part(places.cut.into_iter(), rims.into_iter(), corners.into_iter())
            .0)
    }

    fn refined_with_places(&self, rules: &Rules, level: usize) -> Result<(CellNet, Places), Error> {
        let topology = Topology::unchecked(&self.mesh);
        let mut builder = Builder {
            net: self,
            topology: &topology,
            rules,
            level,
            u: match rules.method()? {
                Method::Odd { u0 } => tension_at(u0, level),
                _ => 1.0,
            },
            places: Places {
                cut: vec![u32::MAX; topology.half_count()],
                on_rim: HashMap::new(),
                kept: HashMap::new(),
            },
            rows: Vec::new(),
            roles: Vec::new(),
            cells: Mesh::default(),
            halves: Vec::new(),
        };
        builder.cut_faces()?;
        if self.control {
            builder.first()?;
        } else {
            builder.later();
        }
        let passes = smoothing_passes(rules, level)?;
        let places = std::mem::take(&mut builder.places);
        let mut net = builder.finish()?;
        for _ in 0..passes {
            net.smooth()?;
        }
        Ok((net, places))
    }

    /// One mean of the centres of cells.
    fn smooth(&mut self) -> Result<(), Error> {
        let topology = Topology::unchecked(&self.mesh);
        let points = self.mesh.points();
        let centre = |cell: u32| -> nalgebra::Vector3<f64> {
            let corners = self.mesh.face(cell as usize);
            match self.halves[cell as usize] {
                None => {
                    let sum: nalgebra::Vector3<f64> = corners.iter().map(|&c| points[c as usize].coords).sum();
                    sum / corners.len() as f64
                }
                Some(true) => points[corners[0] as usize].coords,
                Some(false) => {
                    let ends = [corners[0], corners[corners.len() - 1]].map(|c| points[c as usize].coords);
                    (ends[0] + ends[1]) * 0.5
                }
            }
        };
        let mut moved = points.to_vec();
        let mut left_out = BTreeSet::new();
        for (vertex, role) in self.points.iter().enumerate() {
            let fan = topology.fan(vertex as u32);
            match role {
                Role::Corner => {}
                Role::Inner if !fan.is_closed() || fan.spokes.is_empty() => {
                    left_out.insert(vertex as u32);
                }
                Role::Inner => {
                    let sum: nalgebra::Vector3<f64> =
                        fan.spokes.iter().map(|&spoke| centre(topology.face(spoke))).sum();
                    moved[vertex] = Point3::from(sum / fan.spokes.len() as f64);
                }
                Role::Rim => {
                    let mut sum = nalgebra::Vector3::zeros();
                    for other in rim_neighbours(&topology, &self.points, vertex as u32) {
                        let end = points[other as usize].coords;
                        sum += match self.points[other as usize] {
                            Role::Corner => end,
                            _ => (end + points[vertex].coords) * 0.5,
                        };
                    }
                    moved[vertex] = Point3::from(sum * 0.5);
                }
            }
        }
        self.mesh.points_mut().copy_from_slice(&moved);
        if !left_out.is_empty() {
            let mut kept = Mesh::of_points(moved);
            for face in self
                .mesh
                .faces()
                .filter(|face| face.iter().all(|v| !left_out.contains(v)))
            {
                kept.push_face(face)?;
            }
            self.halves = vec![None; kept.face_count()];
            kept.features = self.mesh.features.clone();
            self.mesh = kept;
        }
        Ok(())
    }

    /// The cells that are half cells.
    pub fn half_cells(&self) -> usize {
        self.halves.iter().flatten().count()
    }
}

/// The two points that follow a rim point on the rim.
fn rim_neighbours(topology: &Topology, roles: &[Role], vertex: u32) -> Vec<u32> {
    let fan = topology.fan(vertex);
    let heads = fan.spokes.iter().map(|&spoke| topology.head(spoke));
    let all = heads.chain(fan.last.map(|last| topology.origin(last)));
    all.filter(|&other| roles[other as usize] != Role::Inner).collect()
}

/// Where the points of a level are, by what they come from.
#[derive(Default)]
struct Places {
    /// The new point of each corner of a face.
    cut: Vec<u32>,
    /// The new point of a rim edge (by number) next to one of its ends.
    on_rim: HashMap<(u32, u32), u32>,
    /// The new number of each corner.
    kept: HashMap<u32, u32>,
}

struct Builder<'a> {
    net: &'a CellNet,
    topology: &'a Topology,
    rules: &'a Rules,
    level: usize,
    u: f64,
    places: Places,
    rows: Vec<Row>,
    roles: Vec<Role>,
    cells: Mesh,
    halves: Vec<Option<bool>>,
}

impl Builder<'_> {
    fn point(&mut self, row: Row, role: Role) -> u32 {
        self.rows.push(row);
        self.roles.push(role);
        self.rows.len() as u32 - 1
    }

    fn cell(&mut self, corners: &[u32], half: Option<bool>) {
        self.halves.push(half);
        // numbers of points that are made below: checked when the net is finished
        self.cells.push_corners(corners);
    }

    /// New points of all corners of faces.
    fn cut_faces(&mut self) -> Result<(), Error> {
        for face in 0..self.topology.face_count() as u32 {
            let halves = self.topology.face_halves(face);
            if let Some(corner) = self.net.halves[face as usize] {
                let corners = self.net.mesh.face(face as usize).to_vec();
                let n = corners.len() - 2 - usize::from(corner);
                let rows = half_cell(n, &self.u, corner);
                for (i, weights) in rows.into_iter().enumerate() {
                    let row = corners
                        .iter()
                        .copied()
                        .zip(weights)
                        .filter(|(_, w)| *w != 0.0)
                        .collect();
                    let half = halves.start + (i + 1 + usize::from(corner)) as u32;
                    self.places.cut[half as usize] = self.point(row, Role::Inner);
                }
                continue;
            }
            let corners = self.net.mesh.face(face as usize).to_vec();
            let stencil = corner_stencil(self.rules, self.level, corners.len())?;
            for (place, half) in halves.enumerate() {
                let row = whole_cell(&stencil, &corners, place);
                self.places.cut[half as usize] = self.point(row, Role::Inner);
            }
        }
        Ok(())
    }

    /// The rim edges of the control mesh.
    fn rim_edges(&self) -> Result<Vec<bool>, Error> {
        let features = &self.net.mesh.features;
        let mut rims = vec![false; self.topology.edge_count()];
        if !self.net.rims {
            return Ok(rims);
        }
        let mut soft = Vec::new();
        for number in 0..self.topology.edge_count() as u32 {
            let pair = self.topology.edge_points(number);
            let sharpness = features.creases.get(&pair).copied().unwrap_or(0.0);
            let boundary = self.topology.is_boundary(number);
            if !boundary && sharpness > 0.0 && sharpness < INFINITE {
                soft.extend(pair);
            }
            rims[number as usize] = boundary || sharpness >= INFINITE;
        }
        soft.sort_unstable();
        soft.dedup();
        if soft.is_empty() {
            Ok(rims)
        } else {
            Err(no_rule("creases of sharpness below 10 in a dual scheme", &soft))
        }
    }

    fn first(&mut self) -> Result<(), Error> {
        let topology = self.topology;
        let rims = self.rim_edges()?;
        let features = &self.net.mesh.features;
        let corners_at_one_face = features.boundary == Some(Boundary::Corner);
        let u = self.u;
        // rim points
        for number in (0..topology.edge_count() as u32).filter(|&e| rims[e as usize]) {
            let [v, w] = topology.edge_points(number);
            for (near, far) in [(v, w), (w, v)] {
                let weight = 1.0 / (2.0 * (1.0 + u));
                let point = self.point(vec![(near, 1.0 - weight), (far, weight)], Role::Rim);
                self.places.on_rim.insert((number, near), point);
            }
        }
        for face in 0..topology.face_count() as u32 {
            let corners: Vec<u32> = topology
                .face_halves(face)
                .map(|half| self.places.cut[half as usize])
                .collect();
            self.cell(&corners, None);
        }
        for half in 0..topology.half_count() as u32 {
            let number = topology.edge(half);
            let [v, w] = topology.ends(half);
            let own = [half, topology.next(half)].map(|half| self.places.cut[half as usize]);
            if rims[number as usize] {
                let [b_v, b_w] = [v, w].map(|end| self.places.on_rim[&(number, end)]);
                self.cell(&[b_w, own[1], own[0], b_v], Some(false));
            } else if let Some(twin) = topology.twin(half).filter(|&twin| half < twin) {
                let other = [twin, topology.next(twin)].map(|half| self.places.cut[half as usize]);
                // below the edge from v to w, then above it back
                self.cell(&[other[1], other[0], own[1], own[0]], None);
            }
        }
        let (mut darts, mut cusps) = (Vec::new(), Vec::new());
        for vertex in 0..topology.vertex_count() as u32 {
            let fan = topology.fan(vertex);
            if fan.spokes.is_empty() {
                continue;
            }
            let mut starts: Vec<usize> = (0..fan.spokes.len())
                .filter(|&i| rims[topology.edge(fan.spokes[i]) as usize])
                .collect();
            let count = starts.len() + usize::from(fan.last.is_some_and(|last| rims[topology.edge(last) as usize]));
            let tagged = features.corners.get(&vertex).is_some_and(|&s| s > 0.0);
            let one_face = corners_at_one_face && !fan.is_closed() && fan.spokes.len() == 1;
            match count {
                0 if tagged && self.net.rims => cusps.push(vertex),
                1 => darts.push(vertex),
                0 if fan.is_closed() => {
                    let corners: Vec<u32> = fan
                        .spokes
                        .iter()
                        .map(|&spoke| self.places.cut[spoke as usize])
                        .collect();
                    self.cell(&corners, None);
                }
                0 => {}
                _ => {
                    let corner = tagged || one_face || count > 2;
                    let front = corner.then(|| {
                        let point = self.point(vec![(vertex, 1.0)], Role::Corner);
                        self.places.kept.insert(vertex, point);
                        point
                    });
                    let n = fan.spokes.len();
                    if !fan.is_closed() {
                        // the sectors before the first rim are those after the last
                        debug_assert_eq!(starts.first(), Some(&0));
                    }
                    let first = starts[0];
                    starts.push(first + n);
                    for pair in starts.windows(2) {
                        let mut corners: Vec<u32> = front.into_iter().collect();
                        let spoke = |i: usize| fan.spokes[i % n];
                        corners.push(self.places.on_rim[&(topology.edge(spoke(pair[0])), vertex)]);
                        corners.extend((pair[0]..pair[1]).map(|i| self.places.cut[spoke(i) as usize]));
                        let end = topology.edge(topology.previous(spoke(pair[1] - 1)));
                        corners.push(self.places.on_rim[&(end, vertex)]);
                        self.cell(&corners, Some(corner));
                    }
                }
            }
        }
        if !darts.is_empty() {
            return Err(no_rule("a crease that ends inside (a dart) in a dual scheme", &darts));
        }
        if !cusps.is_empty() {
            return Err(no_rule("a corner without creases (a cusp) in a dual scheme", &cusps));
        }
        Ok(())
    }

    fn later(&mut self) {
        let (topology, net, u) = (self.topology, self.net, self.u);
        let role = |vertex: u32| net.points[vertex as usize];
        for vertex in 0..topology.vertex_count() as u32 {
            if role(vertex) == Role::Corner {
                let point = self.point(vec![(vertex, 1.0)], Role::Corner);
                self.places.kept.insert(vertex, point);
            }
        }
        for number in 0..topology.edge_count() as u32 {
            let pair = topology.edge_points(number);
            if pair.iter().any(|&end| role(end) == Role::Inner) {
                continue;
            }
            for (own, other) in [(pair[0], pair[1]), (pair[1], pair[0])] {
                if role(own) == Role::Corner {
                    continue;
                }
                let mut row = vec![(own, u / (1.0 + u))];
                let to = 1.0 / (1.0 + u);
                match role(other) {
                    Role::Corner => row.push((other, to)),
                    _ => add(&mut row, to, &vec![(own, 0.5), (other, 0.5)]),
                }
                let point = self.point(row, Role::Rim);
                self.places.on_rim.insert((number, own), point);
            }
        }
        for cell in 0..topology.face_count() as u32 {
            let halves: Vec<u32> = topology.face_halves(cell).collect();
            let Some(corner) = net.halves[cell as usize] else {
                let corners: Vec<u32> = halves.iter().map(|&half| self.places.cut[half as usize]).collect();
                self.cell(&corners, None);
                continue;
            };
            let first = usize::from(corner);
            let last = halves.len() - 1;
            let mut corners = Vec::with_capacity(halves.len());
            if corner {
                corners.push(self.places.kept[&topology.origin(halves[0])]);
            }
            // the rim edge before b_r and the one after b_l
            let before = topology.edge(topology.previous(halves[first]));
            corners.push(self.places.on_rim[&(before, topology.origin(halves[first]))]);
            corners.extend(
                halves[first + 1..last]
                    .iter()
                    .map(|&half| self.places.cut[half as usize]),
            );
            corners.push(self.places.on_rim[&(topology.edge(halves[last]), topology.origin(halves[last]))]);
            self.cell(&corners, Some(corner));
        }
        for half in 0..topology.half_count() as u32 {
            let Some(twin) = topology.twin(half) else { continue };
            let [x, y] = topology.ends(half);
            match (role(x), role(y)) {
                (Role::Inner, Role::Inner) if half < twin => {
                    let own = [half, topology.next(half)].map(|half| self.places.cut[half as usize]);
                    let other = [twin, topology.next(twin)].map(|half| self.places.cut[half as usize]);
                    self.cell(&[other[1], other[0], own[1], own[0]], None);
                }
                (Role::Rim, Role::Inner) => {
                    // upwards from the rim: the left cell begins here, the right one ends here
                    let left = topology.edge(topology.previous(half));
                    let right = topology.edge(topology.next(twin));
                    let [b_r, b_l] = [right, left].map(|number| self.places.on_rim[&(number, x)]);
                    let corners = [
                        b_r,
                        self.places.cut[twin as usize],
                        self.places.cut[topology.next(half) as usize],
                        b_l,
                    ];
                    self.cell(&corners, Some(false));
                }
                _ => {}
            }
        }
        for vertex in 0..topology.vertex_count() as u32 {
            let fan = topology.fan(vertex);
            if role(vertex) == Role::Inner && fan.is_closed() && !fan.spokes.is_empty() {
                let corners: Vec<u32> = fan
                    .spokes
                    .iter()
                    .map(|&spoke| self.places.cut[spoke as usize])
                    .collect();
                self.cell(&corners, None);
            }
        }
    }

    fn finish(self) -> Result<CellNet, Error> {
        let mut table = Table::default();
        for row in &self.rows {
            table.push(row.iter().copied())?;
        }
        let values: Vec<[f64; 3]> = self.net.mesh.points().iter().map(|p| [p.x, p.y, p.z]).collect();
        let points = table.apply(&values)?.into_iter().map(Point3::from).collect();
        let mut mesh = Mesh::new(points, self.cells.faces())?;
        mesh.features.boundary = self.net.mesh.features.boundary;
        Ok(CellNet {
            mesh,
            halves: self.halves,
            points: self.roles,
            control: false,
            rims: self.net.rims,
        })
    }
}

/// The weights that a corner of a face, or of a cell, takes from its own and the others in turn, by their
/// sectors.
pub(crate) fn corner_stencil(rules: &Rules, level: usize, n: usize) -> Result<Stencil<f64>, Error> {
    let scheme = rules.inner(None, n)?;
    let stencil = scheme.level(level).stencil(0, Site { sector: 0, x: 1, y: 1 })?;
    if stencil.terms().iter().all(|(site, _)| (site.x, site.y) == (1, 1)) {
        Ok(stencil)
    } else {
        Err(no_rule("rules that read beyond their face", &[]))
    }
}

/// The row of a corner, over the points in turn.
pub(crate) fn whole_cell(stencil: &Stencil<f64>, points: &[u32], place: usize) -> Row {
    let terms = stencil.terms().iter();
    terms
        .map(|(site, weight)| (points[(place + site.sector) % points.len()], *weight))
        .collect()
}

/// The number of mean steps after corner cutting.
pub(crate) fn smoothing_passes(rules: &Rules, level: usize) -> Result<usize, Error> {
    let scheme = rules.inner(None, 4)?;
    let passes = scheme.level(level).passes();
    let chain: Vec<Lattice> = passes.iter().map(|pass| pass.to()).collect();
    let average = eigenring_scheme::Line::average();
    let fits = passes[0].scale() == 2
        && chain[0] == Lattice::Face
        && chain[1..]
            .chunks(2)
            .all(|pair| pair == [Lattice::Vertex, Lattice::Face])
        && passes[1..].iter().all(|pass| pass.line() == Some(&average));
    if fits {
        Ok(chain.len() / 2)
    } else {
        Err(no_rule("passes other than corner cutting and averages", &[]))
    }
}

fn no_rule(what: &str, elements: &[u32]) -> Error {
    let named: Vec<String> = elements.iter().take(10).map(u32::to_string).collect();
    Error::NoRule {
        what: what.to_owned(),
        elements: if named.is_empty() {
            "every vertex".to_owned()
        } else {
            format!("vertices {}", named.join(", "))
        },
        accepted:
            "are boundaries, creases of sharpness 10 and above that run on or end in corners, and corners on them"
                .to_owned(),
    }
}
