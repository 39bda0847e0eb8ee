//! Odd orders around a face: control points sit on quads, one for each corner of a face of the control mesh;
//! where there are rims (boundaries and creases), points `b` of the rim sit on rim edges, and corners that
//! stay on their vertices. Each quad is one piece of the surface.
//!
//! A level cuts every quad into four, each with the point that the cell around its corner gives by the
//! scheme's rule for as many sides as quads meet there, or by that of half cells
//! ([`half_cell`]); smoothing then moves a point to the mean of the centres of its quad's four cells. A half
//! cell's centre, `c` below, is the middle of its two rim points, or its corner.

use super::kernel::Kernel;
use super::local::Local;
use crate::dual::{corner_stencil, smoothing_passes, whole_cell};
use crate::features::{INFINITE, edge};
use crate::refine::{Row, Step, add, quads};
use crate::rules::Rules;
use crate::topology::FanAt;
use crate::{Error, Mesh, Topology};
use eigenring_scheme::Table;
use eigenring_scheme::families::half_cell;
use nalgebra::Point3;
use std::collections::HashMap;

/// The control points of a dual scheme on a mesh of quads.
#[derive(Clone, Debug)]
pub(crate) struct DualNet {
    /// First one for each face, then those of rims and corners.
    pub points: Vec<Point3<f64>>,
    /// The point on a rim edge, by the ends of the edge.
    pub rims: HashMap<[u32; 2], u32>,
    /// The points of corners, by their vertices.
    pub corners: HashMap<u32, u32>,
}

impl DualNet {
    /// The control points of a part, and their numbers here: its faces, its rim edges and its corners with
    /// their new names.
    pub fn part(
        &self,
        faces: impl Iterator<Item = u32>,
        rims: impl Iterator<Item = ([u32; 2], u32)>,
        corners: impl Iterator<Item = (u32, u32)>,
    ) -> (DualNet, Vec<u32>) {
        let mut ids: Vec<u32> = faces.collect();
        let mut numbered = |id: u32| {
            ids.push(id);
            ids.len() as u32 - 1
        };
        let rims = rims.map(|(pair, id)| (pair, numbered(id))).collect();
        let corners = corners.map(|(vertex, id)| (vertex, numbered(id))).collect();
        let net = DualNet {
            points: ids.iter().map(|&id| self.points[id as usize]).collect(),
            rims,
            corners,
        };
        (net, ids)
    }
}

impl DualNet {
    /// The points around a vertex in turn, those of its rim first and last, and the weights of its centre.
    pub fn around(&self, fan: &FanAt, topology: &Topology, vertex: u32) -> (Vec<u32>, Row) {
        let quads = fan.spokes.iter().map(|&spoke| topology.face(spoke));
        let rim = |half: u32| {
            let [a, b] = topology.ends(half);
            self.rims.get(&edge(a, b)).copied()
        };
        let ends = (fan.spokes.first().and_then(|&first| rim(first)), fan.last.and_then(rim));
        let (Some(right), Some(left)) = ends else {
            let quads: Vec<u32> = quads.collect();
            let weight = 1.0 / quads.len() as f64;
            let centre = quads.iter().map(|&quad| (quad, weight)).collect();
            return (quads, centre);
        };
        let centre = match self.corners.get(&vertex) {
            Some(&corner) => vec![(corner, 1.0)],
            None => vec![(right, 0.5), (left, 0.5)],
        };
        ([right].into_iter().chain(quads).chain([left]).collect(), centre)
    }
}

/// The quads around a vertex that a quad belongs to.
enum Cell {
    /// All round, from the given quad on.
    Whole(Vec<u32>),
    /// Between two rim edges: the right one, quads counter-clockwise, the left one, and the place of the
    /// given quad among them.
    Half([u32; 2], Vec<u32>, [u32; 2], u32, usize),
}

/// A mesh of quads with what is where in its net.
struct Cells<'a> {
    topology: &'a Topology,
    mesh: &'a Mesh,
    rims: &'a HashMap<[u32; 2], u32>,
    corners: &'a HashMap<u32, u32>,
    /// The control point of each quad.
    quads: &'a [u32],
}

impl Cells<'_> {
    fn is_rim(&self, half: u32) -> bool {
        let [a, b] = self.topology.ends(half);
        let creases = &self.mesh.features.creases;
        creases.get(&edge(a, b)).is_some_and(|&s| s >= INFINITE)
    }

    fn pair(&self, half: u32) -> [u32; 2] {
        let [a, b] = self.topology.ends(half);
        edge(a, b)
    }

    fn quad(&self, half: u32) -> u32 {
        self.quads[self.topology.face(half) as usize]
    }

    /// The cell of the quad that follows a spoke; `None` where the part ends.
    fn cell(&self, start: u32) -> Option<Cell> {
        let topology = self.topology;
        let mut ahead = vec![self.quad(start)];
        let mut spoke = start;
        while !self.is_rim(topology.previous(spoke)) {
            spoke = topology.turned(spoke)?;
            if spoke == start {
                return Some(Cell::Whole(ahead));
            }
            ahead.push(self.quad(spoke));
        }
        let left = self.pair(topology.previous(spoke));
        let mut behind = Vec::new();
        spoke = start;
        while !self.is_rim(spoke) {
            spoke = topology.turned_back(spoke)?;
            behind.push(self.quad(spoke));
        }
        let place = behind.len();
        behind.reverse();
        behind.extend(ahead);
        Some(Cell::Half(
            self.pair(spoke),
            behind,
            left,
            topology.origin(start),
            place,
        ))
    }

    /// The centre of a cell, of a half cell its `c`.
    fn centre(&self, cell: &Cell) -> Row {
        match cell {
            Cell::Whole(quads) => {
                let weight = 1.0 / quads.len() as f64;
                quads.iter().map(|&quad| (quad, weight)).collect()
            }
            Cell::Half(right, _, left, vertex, _) => match self.corners.get(vertex) {
                Some(&corner) => vec![(corner, 1.0)],
                None => vec![(self.rims[right], 0.5), (self.rims[left], 0.5)],
            },
        }
    }

    /// `c` at the end of a rim edge; `None` where the part ends.
    fn rim_centre(&self, end: u32, others: &HashMap<u32, Vec<[u32; 2]>>) -> Option<Row> {
        if let Some(&corner) = self.corners.get(&end) {
            return Some(vec![(corner, 1.0)]);
        }
        let [first, second] = others.get(&end)?[..] else {
            return None;
        };
        Some(vec![(self.rims[&first], 0.5), (self.rims[&second], 0.5)])
    }

    /// The rim edges at each vertex.
    fn at_ends(&self) -> HashMap<u32, Vec<[u32; 2]>> {
        let mut found: HashMap<u32, Vec<[u32; 2]>> = HashMap::new();
        for pair in self.rims.keys() {
            pair.iter().for_each(|&end| found.entry(end).or_default().push(*pair));
        }
        // rows must not depend on the order of a hash table
        found.values_mut().for_each(|pairs| pairs.sort_unstable());
        found
    }
}

/// The part, refined once.
pub(crate) fn step(local: &Local, rules: &Rules, kernel: &Kernel, level: usize) -> Result<Step, Error> {
    let topology = &local.topology;
    let Some((net, _)) = &local.net else {
        return Err(super::quarter::missing());
    };
    let u = kernel.tension(level);
    let fine = quads(&local.mesh, topology);
    let vertices = topology.vertex_count() as u32;
    let own: Vec<u32> = (0..topology.face_count() as u32).collect();
    let before = Cells {
        topology,
        mesh: &local.mesh,
        rims: &net.rims,
        corners: &net.corners,
        quads: &own,
    };
    let mut rows: Vec<Row> = Vec::new();
    let (mut halves, mut corners) = (Vec::new(), Vec::new());
    for half in 0..topology.half_count() as u32 {
        let row = match before.cell(half) {
            Some(Cell::Whole(quads)) if quads.len() >= 3 => {
                let stencil = corner_stencil(rules, level, quads.len())?;
                whole_cell(&stencil, &quads, 0)
            }
            Some(Cell::Half(right, quads, left, vertex, place)) => {
                let corner = net.corners.get(&vertex);
                let weights = half_cell(quads.len(), &u, corner.is_some()).swap_remove(place);
                let ends = [net.rims[&right], net.rims[&left]];
                let points = corner
                    .copied()
                    .into_iter()
                    .chain([ends[0]])
                    .chain(quads)
                    .chain([ends[1]]);
                points.zip(weights).filter(|(_, w)| *w != 0.0).collect()
            }
            _ => continue,
        };
        rows.push(row);
        halves.push(half);
        corners.extend_from_slice(fine.face(half as usize));
    }
    let mut mesh = Mesh::of_quads(fine.points().to_vec(), corners);
    mesh.features = fine.features;
    let (mut rims, mut kept) = (HashMap::new(), HashMap::new());
    let others = before.at_ends();
    for number in 0..topology.edge_count() as u32 {
        let pair = topology.edge_points(number);
        let Some(&on) = net.rims.get(&pair) else { continue };
        for end in pair {
            let Some(centre) = before.rim_centre(end, &others) else {
                continue;
            };
            let mut row = vec![(on, u / (1.0 + u))];
            add(&mut row, 1.0 / (1.0 + u), &centre);
            rims.insert(edge(end, vertices + number), rows.len() as u32);
            rows.push(row);
        }
    }
    let mut stay: Vec<(u32, u32)> = net.corners.iter().map(|(&vertex, &at)| (vertex, at)).collect();
    stay.sort_unstable();
    for (vertex, at) in stay {
        kept.insert(vertex, rows.len() as u32);
        rows.push(vec![(at, 1.0)]);
    }
    let mut refined = Refined {
        mesh,
        halves,
        rims,
        corners: kept,
    };
    let mut tables = vec![table(&rows)?];
    for _ in 0..smoothing_passes(rules, level)? {
        tables.push(table(&refined.smoothed())?);
    }
    let mut points: Vec<[f64; 3]> = net.points.iter().map(|p| [p.x, p.y, p.z]).collect();
    for table in &tables {
        points = table.apply(&points)?;
    }
    Ok(Step {
        mesh: refined.mesh,
        tables,
        halves: refined.halves,
        net: Some(DualNet {
            points: points.into_iter().map(Point3::from).collect(),
            rims: refined.rims,
            corners: refined.corners,
        }),
    })
}

fn table(rows: &[Row]) -> Result<Table<f64>, Error> {
    let mut table = Table::default();
    for row in rows {
        table.push(row.iter().copied())?;
    }
    Ok(table)
}

/// A refined part with the numbers of its points.
struct Refined {
    mesh: Mesh,
    halves: Vec<u32>,
    rims: HashMap<[u32; 2], u32>,
    corners: HashMap<u32, u32>,
}

impl Refined {
    /// One mean of the centres of cells: the rows of the new points. Quads of which a cell is not whole are
    /// left out.
    fn smoothed(&mut self) -> Vec<Row> {
        let topology = Topology::unchecked(&self.mesh);
        let own: Vec<u32> = (0..topology.face_count() as u32).collect();
        let cells = Cells {
            topology: &topology,
            mesh: &self.mesh,
            rims: &self.rims,
            corners: &self.corners,
            quads: &own,
        };
        let (mut rows, mut halves, mut list) = (Vec::new(), Vec::new(), Vec::new());
        for &face in &own {
            let centres: Option<Vec<Row>> = topology
                .face_halves(face)
                .map(|half| cells.cell(half).map(|cell| cells.centre(&cell)))
                .collect();
            let Some(centres) = centres else { continue };
            let mut row = Row::new();
            centres.iter().for_each(|centre| add(&mut row, 0.25, centre));
            rows.push(row);
            halves.push(self.halves[face as usize]);
            list.extend_from_slice(self.mesh.face(face as usize));
        }
        let others = cells.at_ends();
        let mut along: Vec<[u32; 2]> = self.rims.keys().copied().collect();
        along.sort_unstable();
        let mut rims = HashMap::new();
        for pair in along {
            let centres = pair.map(|end| cells.rim_centre(end, &others));
            let [Some(first), Some(second)] = centres else {
                continue;
            };
            let mut row = Row::new();
            add(&mut row, 0.5, &first);
            add(&mut row, 0.5, &second);
            rims.insert(pair, rows.len() as u32);
            rows.push(row);
        }
        let mut stay: Vec<(u32, u32)> = self.corners.iter().map(|(&vertex, &at)| (vertex, at)).collect();
        stay.sort_unstable();
        let mut corners = HashMap::new();
        for (vertex, at) in stay {
            corners.insert(vertex, rows.len() as u32);
            rows.push(vec![(at, 1.0)]);
        }
        let mut mesh = Mesh::of_quads(self.mesh.points().to_vec(), list);
        mesh.features = std::mem::take(&mut self.mesh.features);
        *self = Refined {
            mesh,
            halves,
            rims,
            corners,
        };
        rows
    }
}
