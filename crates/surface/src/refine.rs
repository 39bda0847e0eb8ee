//! One level of refinement on a mesh: the passes of the scheme, each as one sparse table.
//!
//! A level of a primal scheme splits every n-gon into n quads (corner, edge, middle, edge) and gives each
//! point of the split mesh a row over the points before. Rows near a vertex are those of the scheme's own
//! level around it ([`Rules`]); rows of a regular edge or face are the tensor product of the pass's
//! [`Line`]; rows on creases are those of the open fan. Vertices keep their numbers; edges follow in the
//! order of their first half-edge, then faces.
//!
//! **Faces that are no quads** have a rule of their own in the first level: the middle becomes the centroid.
//! Catmull-Clark then takes `(v + w + F + F')/4` for edges and `(1-2/n) V + 1/n^2 sum E + 1/n^2 sum F` for
//! vertices, the tension scheme smooths the split mesh as any other.

use crate::active::{Active, Ends, Kind, Masks};
use crate::features::{after_one_level, edge};
use crate::limit::DualNet;
use crate::rules::{Method, Rules};
use crate::walk::locate;
use crate::{Error, Features, Mesh, Topology};
use eigenring_scheme::{Line, Site, Stencil, Table};
use nalgebra::Point3;

/// Weights of points.
pub(crate) type Row = Vec<(u32, f64)>;

/// One level, run.
#[derive(Debug)]
pub(crate) struct Step {
    /// The refined mesh. Points without a rule are not finite and in no face.
    pub mesh: Mesh,
    /// For each pass the rows of the points it makes.
    pub tables: Vec<Table<f64>>,
    /// For each face the half-edge from whose corner it was cut.
    pub halves: Vec<u32>,
    /// Of dual schemes the control points, of which the tables have the rows.
    pub net: Option<DualNet>,
}

/// The quads of a mesh, one for each corner of a face: the corner, the edge that leaves it, the face, the
/// edge before. Points are not set; vertices come first, edges next, in the order of the topology, then
/// faces.
pub fn quads(mesh: &Mesh, topology: &Topology) -> Mesh {
    Split::new(mesh, topology).mesh
}

/// Adds `weight` times a row to another.
pub(crate) fn add(row: &mut Row, weight: f64, other: &Row) {
    for &(at, w) in other {
        match row.iter_mut().find(|(known, _)| *known == at) {
            Some((_, sum)) => *sum += weight * w,
            None => row.push((at, weight * w)),
        }
    }
}

/// One level of a primal scheme.
pub(crate) fn step(mesh: &Mesh, topology: &Topology, rules: &Rules, level: usize, ends: Ends) -> Result<Step, Error> {
    let method = rules.method()?;
    let quads = mesh.is_quads();
    let active = Active::new(topology, &mesh.features, ends, rules.steps);
    let split = Split::new(mesh, topology);
    let context = Context {
        topology,
        rules,
        level,
        active: &active,
        ends,
    };
    let rows = match method {
        Method::Bicubic if quads => vec![context.bicubic(&split)?],
        Method::Bicubic => context.polygons(&split)?,
        Method::Even { order, .. } => {
            let fine = Topology::unchecked(&split.mesh);
            let carried = Active::new(&fine, &split.mesh.features, ends, rules.steps);
            let smoothing = Context {
                topology: &fine,
                active: &carried,
                ..context
            };
            let mut passes = vec![context.linear()];
            for step in 0..order / 2 - 1 {
                let previous = passes.last().expect("the linear pass is there");
                let rows = smoothing.smoothed(step, previous)?;
                passes.push(rows);
            }
            passes
        }
        Method::Passes => context.passes(&split)?,
        Method::Odd { .. } => {
            return Err(Error::NoRule {
                what: "a primal level of a dual scheme".to_owned(),
                elements: "every face".to_owned(),
                accepted: "are schemes around vertices".to_owned(),
            });
        }
    };
    split.run(mesh, rows)
}

/// The split mesh without its points.
struct Split {
    mesh: Mesh,
    vertices: u32,
    edges: u32,
}

impl Split {
    fn new(mesh: &Mesh, topology: &Topology) -> Self {
        let (vertices, edges) = (topology.vertex_count() as u32, topology.edge_count() as u32);
        let mut corners = Vec::with_capacity(4 * topology.half_count());
        for half in 0..topology.half_count() as u32 {
            corners.extend([
                topology.origin(half),
                vertices + topology.edge(half),
                vertices + edges + topology.face(half),
                vertices + topology.edge(topology.previous(half)),
            ]);
        }
        let count = vertices as usize + edges as usize + topology.face_count();
        let mut split = Mesh::of_quads(vec![Point3::origin(); count], corners);
        split.features = halved(&mesh.features, topology, vertices);
        Split {
            mesh: split,
            vertices,
            edges,
        }
    }

    fn run(mut self, mesh: &Mesh, passes: Vec<Vec<Option<Row>>>) -> Result<Step, Error> {
        let mut values: Vec<[f64; 3]> = mesh.points().iter().map(|p| [p.x, p.y, p.z]).collect();
        let mut tables = Vec::with_capacity(passes.len());
        let mut missing = vec![false; values.len()];
        for rows in passes {
            let mut table = Table::default();
            let mut left_out = Vec::with_capacity(rows.len());
            for row in rows {
                let row = row.filter(|row| row.iter().all(|&(at, _)| !missing[at as usize]));
                left_out.push(row.is_none());
                table.push(row.unwrap_or_default())?;
            }
            table.shrink();
            values = table.apply(&values)?;
            missing = left_out;
            tables.push(table);
        }
        for ((point, value), &missing) in self.mesh.points_mut().iter_mut().zip(values).zip(&missing) {
            *point = if missing {
                Point3::new(f64::NAN, f64::NAN, f64::NAN)
            } else {
                Point3::from(value)
            };
        }
        let features = &mut self.mesh.features;
        for sharpness in features.creases.values_mut().chain(features.corners.values_mut()) {
            *sharpness = after_one_level(*sharpness);
        }
        features.creases.retain(|_, s| *s > 0.0);
        features.corners.retain(|_, s| *s > 0.0);
        let all = self.mesh.face_count() as u32;
        if !missing.contains(&true) {
            return Ok(Step {
                mesh: self.mesh,
                tables,
                halves: (0..all).collect(),
                net: None,
            });
        }
        let kept = |face: &u32| self.mesh.face(*face as usize).iter().all(|&v| !missing[v as usize]);
        let halves: Vec<u32> = (0..all).filter(kept).collect();
        let corners = halves
            .iter()
            .flat_map(|&face| self.mesh.face(face as usize).iter().copied());
        let mut mesh = Mesh::of_quads(self.mesh.points().to_vec(), corners.collect());
        mesh.features = self.mesh.features.clone();
        Ok(Step {
            mesh,
            tables,
            halves,
            net: None,
        })
    }
}

/// The marks of the split mesh, with the sharpness of the mesh before.
fn halved(features: &Features, topology: &Topology, vertices: u32) -> Features {
    let mut fine = Features {
        corners: features.corners.clone(),
        boundary: features.boundary,
        vertex_steps: features.vertex_steps.clone(),
        extraordinary: features.extraordinary.clone(),
        ..Features::default()
    };
    if features.creases.is_empty() && features.edge_steps.is_empty() && features.knots.is_empty() {
        return fine;
    }
    for number in 0..topology.edge_count() as u32 {
        let pair = topology.edge_points(number);
        for end in pair {
            let half = edge(end, vertices + number);
            if let Some(&s) = features.creases.get(&pair) {
                fine.creases.insert(half, s);
            }
            if let Some(&steps) = features.edge_steps.get(&pair) {
                fine.edge_steps.insert(half, steps);
            }
            if let Some(&interval) = features.knots.get(&pair) {
                fine.knots.insert(half, interval);
            }
        }
    }
    fine
}

#[derive(Clone, Copy)]
struct Context<'a> {
    topology: &'a Topology,
    rules: &'a Rules,
    level: usize,
    active: &'a Active,
    ends: Ends,
}

impl Context<'_> {
    /// The row of a vertex in a pass, of which `step` is the number among the smoothing steps. `faces` gives
    /// what is read of the face that follows a spoke; `own` may replace the smooth mask.
    fn vertex(
        &self,
        vertex: u32,
        pass: usize,
        step: usize,
        faces: impl Fn(u32) -> u32,
        own: impl Fn(usize) -> Option<[f64; 3]>,
    ) -> Result<Option<Row>, Error> {
        let fan = self.topology.fan(vertex);
        if fan.spokes.is_empty() {
            return Ok(Some(vec![(vertex, 1.0)]));
        }
        let row = |kind: Kind| -> Result<Option<Row>, Error> {
            match kind {
                Kind::Stays => Ok(Some(vec![(vertex, 1.0)])),
                Kind::Crease(a, b) => {
                    let beside = self.rules.beside()?;
                    let stencil = beside.level(self.level).stencil(pass, Site::CENTRE)?;
                    let at = |site: Site| match (site == Site::CENTRE, site.sector) {
                        (true, _) => vertex,
                        (_, 0) => a,
                        _ => b,
                    };
                    Ok(Some(stencil.terms().iter().map(|(site, w)| (at(*site), *w)).collect()))
                }
                Kind::Smooth if !fan.is_closed() => Ok(None),
                Kind::Smooth => {
                    let n = fan.spokes.len();
                    let plain = self.active.is_plain(vertex);
                    let [own, edges, middles] = match own(n) {
                        Some(mask) => mask,
                        None => self.rules.mask(vertex, n, plain, pass, self.level)?,
                    };
                    let mut row = vec![(vertex, own)];
                    row.extend(fan.spokes.iter().map(|&spoke| (self.topology.head(spoke), edges)));
                    row.extend(fan.spokes.iter().map(|&spoke| (faces(spoke), middles)));
                    Ok(Some(row))
                }
            }
        };
        Ok(match self.active.masks(vertex, step) {
            Masks::One(kind) => row(kind)?,
            Masks::Blend(before, weight, after) => match (row(before)?, row(after)?) {
                (Some(before), Some(after)) => {
                    let mut sum = Row::new();
                    add(&mut sum, weight, &before);
                    add(&mut sum, 1.0 - weight, &after);
                    Some(sum)
                }
                _ => None,
            },
        })
    }

    fn opposite(&self, spoke: u32) -> u32 {
        self.topology.head(self.topology.next(spoke))
    }

    fn centroid(&self, face: u32) -> Row {
        let halves = self.topology.face_halves(face);
        let weight = 1.0 / halves.len() as f64;
        halves.map(|half| (self.topology.origin(half), weight)).collect()
    }

    /// The rows of one bicubic pass on quads.
    fn bicubic(&self, split: &Split) -> Result<Vec<Option<Row>>, Error> {
        let topology = self.topology;
        let regular = self.rules.inner(None, 4)?;
        let line = regular.limit().passes()[0].line().cloned().unwrap_or_else(Line::cubic);
        let mut rows = Vec::with_capacity(split.mesh.points().len());
        for vertex in 0..split.vertices {
            rows.push(self.vertex(vertex, 0, 0, |spoke| self.opposite(spoke), |_| None)?);
        }
        for number in 0..split.edges {
            rows.push(self.edge(number, |half| tensor_edge(topology, &line, half)));
        }
        for face in 0..topology.face_count() as u32 {
            rows.push(Some(tensor_face(topology, &line, face)));
        }
        self.special(&mut rows, split, 0)?;
        Ok(rows)
    }

    /// The row of an edge: that of a crease, the given smooth one, or a blend.
    fn edge(&self, number: u32, smooth: impl Fn(u32) -> Row) -> Option<Row> {
        let half = self.topology.half_of_edge(number);
        let [a, b] = self.topology.ends(half);
        let weight = self.active.edge_weight([a, b]);
        if weight >= 1.0 {
            return Some(vec![(a, 0.5), (b, 0.5)]);
        }
        if self.topology.is_boundary(number) {
            debug_assert!(self.ends == Ends::Open, "boundary edges with rules are creases");
            return None;
        }
        let smooth = smooth(half);
        if weight == 0.0 {
            return Some(smooth);
        }
        let mut row = Row::new();
        add(&mut row, weight, &vec![(a, 0.5), (b, 0.5)]);
        add(&mut row, 1.0 - weight, &smooth);
        Some(row)
    }

    /// Rows that schemes have beside special vertices, in place of the regular ones.
    fn special(&self, rows: &mut [Option<Row>], split: &Split, pass: usize) -> Result<(), Error> {
        let topology = self.topology;
        let mut owners: std::collections::HashMap<u32, u32> = std::collections::HashMap::new();
        let mut fine = None;
        for vertex in 0..split.vertices {
            let fan = topology.fan(vertex);
            let n = fan.spokes.len();
            if n == 0 || !fan.is_closed() || !self.active.is_plain(vertex) || !self.rules.is_special(vertex, n) || n < 3
            {
                continue;
            }
            let scheme = self.rules.inner(Some(vertex), n)?;
            let level = scheme.level(self.level);
            let sites = level.passes()[pass].special().keys().copied();
            let sites: Vec<Site> = sites.filter(|&site| site != Site::CENTRE).collect();
            if sites.is_empty() {
                continue;
            }
            let fine = fine.get_or_insert_with(|| Topology::unchecked(&split.mesh));
            let sectors = if level.is_rotation_symmetric() || sites.iter().all(|site| site.sector == 0) {
                0..n
            } else {
                0..1
            };
            for (sector, &site) in sectors.flat_map(|sector| sites.iter().map(move |site| (sector, site))) {
                let target = if sector == 0 {
                    site
                } else {
                    site.rotated(level.fan(), sector as i64)
                };
                // the child of a half-edge's corner starts with that half-edge's first half
                let at = locate(fine, 4 * fan.spokes[0], target);
                let row = stencil_row(topology, fan.spokes[0], &level.stencil(pass, target)?);
                let (Some(at), Some(row)) = (at, row) else {
                    if self.ends == Ends::Open {
                        // what lies beyond a part of a mesh is not asked for
                        if let Some(at) = at {
                            rows[at as usize] = None;
                        }
                        continue;
                    }
                    return Err(crowded(vertex, vertex));
                };
                if let Some(other) = owners.insert(at, vertex).filter(|&other| other != vertex) {
                    return Err(crowded(other, vertex));
                }
                rows[at as usize] = Some(row);
            }
        }
        Ok(())
    }

    /// The rows of Catmull-Clark beside faces of any size.
    fn polygons(&self, split: &Split) -> Result<Vec<Vec<Option<Row>>>, Error> {
        let topology = self.topology;
        // the middles of faces first, which edges and vertices read: rows stay short beside large faces
        let vertices = (0..split.vertices).map(|vertex| Some(vec![(vertex, 1.0)]));
        let middles = (0..topology.face_count() as u32).map(|face| Some(self.centroid(face)));
        let first = vertices.chain(middles).collect();
        let middle = |face: u32| split.vertices + face;
        let mut rows = Vec::with_capacity(split.mesh.points().len());
        for vertex in 0..split.vertices {
            let mask = |n: usize| {
                let square = 1.0 / (n * n) as f64;
                Some([1.0 - 2.0 / n as f64, square, square])
            };
            rows.push(self.vertex(vertex, 0, 0, |spoke| middle(topology.face(spoke)), mask)?);
        }
        for number in 0..split.edges {
            rows.push(self.edge(number, |half| {
                let [a, b] = topology.ends(half);
                let sides = [Some(half), topology.twin(half)].into_iter().flatten();
                let faces = sides.map(|half| (middle(topology.face(half)), 0.25));
                [(a, 0.25), (b, 0.25)].into_iter().chain(faces).collect()
            }));
        }
        rows.extend((0..topology.face_count() as u32).map(|face| Some(vec![(middle(face), 1.0)])));
        Ok(vec![first, rows])
    }

    /// Linear refinement.
    fn linear(&self) -> Vec<Option<Row>> {
        let topology = self.topology;
        let stay = (0..topology.vertex_count() as u32).map(|vertex| Some(vec![(vertex, 1.0)]));
        let middles = (0..topology.edge_count() as u32).map(|number| {
            let [a, b] = topology.edge_points(number);
            Some(vec![(a, 0.5), (b, 0.5)])
        });
        let centroids = (0..topology.face_count() as u32).map(|face| Some(self.centroid(face)));
        stay.chain(middles).chain(centroids).collect()
    }

    /// A smoothing step on the split mesh.
    fn smoothed(&self, step: usize, before: &[Option<Row>]) -> Result<Vec<Option<Row>>, Error> {
        let count = self.topology.vertex_count() as u32;
        debug_assert_eq!(before.len(), count as usize);
        (0..count)
            .map(|vertex| self.vertex(vertex, step + 1, step, |spoke| self.opposite(spoke), |_| None))
            .collect()
    }

    /// Any passes around vertices, as files describe them: on quads, without features.
    fn passes(&self, split: &Split) -> Result<Vec<Vec<Option<Row>>>, Error> {
        crate::passes::rows(self.topology, self.rules, self.active, &split.mesh)
    }
}

fn crowded(a: u32, b: u32) -> Error {
    let elements = if a == b {
        format!("vertex {a}")
    } else {
        format!("vertices {a} and {b}")
    };
    Error::NoRule {
        what: "special rules that meet each other or a boundary".to_owned(),
        elements,
        accepted: "are special vertices that lie farther apart".to_owned(),
    }
}

/// The points that a stencil around a vertex reads; `None` if one of them is not there.
pub(crate) fn stencil_row(topology: &Topology, first: u32, stencil: &Stencil<f64>) -> Option<Row> {
    let terms = stencil.terms().iter();
    terms
        .map(|(site, weight)| Some((locate(topology, first, *site)?, *weight)))
        .collect()
}

/// The tensor product of a line along a half-edge and across it.
pub(crate) fn tensor_edge(topology: &Topology, line: &Line<f64>, half: u32) -> Row {
    let twin = topology.twin(half);
    let mut row = Row::new();
    for (x, wx) in line.taps(2) {
        for (y, wy) in line.taps(0) {
            let at = match (x, y) {
                (0, 0) => Some(topology.origin(half)),
                (2, 0) => Some(topology.head(half)),
                (0, 2) => Some(topology.origin(topology.previous(half))),
                (2, 2) => Some(topology.head(topology.next(half))),
                (0, -2) => twin.map(|twin| topology.head(topology.next(twin))),
                _ => twin.map(|twin| topology.origin(topology.previous(twin))),
            };
            if let Some(at) = at {
                row.push((at, wx * wy));
            }
        }
    }
    row
}

/// The tensor product of a line in both directions of a quad.
pub(crate) fn tensor_face(topology: &Topology, line: &Line<f64>, face: u32) -> Row {
    let first = topology.face_halves(face).start;
    let mut row = Row::new();
    for (x, wx) in line.taps(2) {
        for (y, wy) in line.taps(2) {
            let corner = match (x, y) {
                (0, 0) => 0,
                (2, 0) => 1,
                (2, 2) => 2,
                _ => 3,
            };
            row.push((topology.origin(first + corner), wx * wy));
        }
    }
    row
}
