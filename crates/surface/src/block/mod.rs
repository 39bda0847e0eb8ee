//! Fine levels as blocks: no adjacency structure is made for them.
//!
//! When all faces are quads and nothing but sharp edges is left, each face of that mesh becomes a block of
//! `n x n` quads, `n = 2, 4, 8, ..`. Points are stored corners first, then sides (the inner points of each
//! edge, in its direction), then the inner points of each face, row by row. A level is a list of passes, and
//! so is its work on blocks: inner points follow the tensor product of the pass's
//! [`Line`](eigenring_scheme::Line) on arrays, sides read the first rows of both blocks, corners and the
//! points beside special ones have the rows of their level. Within a pass blocks do not depend on each other.
//!
//! Blocks of dual schemes are in [`dual`].

pub(crate) mod dual;
mod kernel;
pub(crate) mod layout;
mod pass;

use crate::active::{Active, Ends};
use crate::refiner::{Refiner, RulesOn};
use crate::rules::Method;
use crate::workers::Workers;
use crate::{Error, Mesh, Topology};
use kernel::accumulate;
use layout::Layout;
use nalgebra::Point3;
use pass::{Local, Pass, Source};

/// The mesh after `levels` levels, of which the first ones run on the whole mesh; `None` where blocks do not
/// apply.
pub(crate) fn refined(refiner: &Refiner<'_>, mesh: &Mesh, levels: usize) -> Result<Option<Mesh>, Error> {
    let rules = refiner.rules();
    // the points of the first level keep their numbers under even orders
    let first = match rules.method()? {
        Method::Bicubic => 0,
        Method::Even { .. } => 1,
        Method::Odd { .. } | Method::Passes => return Ok(None),
    };
    if refiner.ends(mesh) == Ends::Open {
        return Ok(None);
    }
    let mut coarse = mesh.clone();
    for level in 0..levels {
        let topology = Topology::unchecked(&coarse);
        let own = matches!(refiner.rules_on(&coarse, &topology)?, RulesOn::Own(_));
        if level >= first && own && coarse.is_quads() && coarse.features.largest_finite_sharpness() == 0.0 {
            let source = Source {
                topology: &topology,
                rules,
                active: Active::new(&topology, &coarse.features, refiner.ends(&coarse), rules.steps),
            };
            if let Some(first) = source.level(level)? {
                let blocks = Blocks {
                    mesh: &coarse,
                    source,
                    workers: refiner.workers,
                };
                return blocks.run(level..levels, first).map(Some);
            }
        }
        coarse = refiner.level(&coarse, level)?;
    }
    Ok(Some(coarse))
}

struct Blocks<'a> {
    mesh: &'a Mesh,
    source: Source<'a>,
    workers: &'a dyn Workers,
}

impl Blocks<'_> {
    fn run(self, levels: std::ops::Range<usize>, mut passes: Vec<Pass>) -> Result<Mesh, Error> {
        let topology = self.source.topology;
        let corners = (topology.half_count() as f64) * 4_f64.powi(levels.len() as i32);
        if corners >= f64::from(u32::MAX) {
            return Err(Error::TooLarge {
                what: "corners of faces",
                count: corners as usize,
            });
        }
        let stationary = self.source.rules.method()? == Method::Bicubic;
        let (mut points, mut n) = (self.mesh.points().to_vec(), 1);
        for level in levels.clone() {
            if level > levels.start && !stationary {
                // what holds in one level of sharp features holds in all of them
                passes = self.source.level(level)?.unwrap_or(passes);
            }
            for pass in &passes {
                points = match pass.kernel.scale() {
                    1 => self.smoothed(points, n, pass),
                    _ => self.refined(&points, n, pass),
                };
                n *= pass.kernel.scale();
            }
        }
        Ok(self.mesh(points, n))
    }

    /// The points that a refining pass makes of those of blocks of size `n`.
    fn refined(&self, old: &[Point3<f64>], n: usize, pass: &Pass) -> Vec<Point3<f64>> {
        let topology = self.source.topology;
        let kernel = &pass.kernel;
        let coarse = Layout::new(topology, n, |_| true);
        let size = kernel.scale() * n;
        let fine = Layout::new(topology, size, |_| true);
        let mut new = origins(fine.count());
        let (outer, inner) = new.split_at_mut(fine.inner_start());
        self.outer(old, &coarse, pass, outer);
        let parts = inner.chunks_mut((size - 1) * (size - 1)).collect();
        self.workers.points(parts, &|face, targets| {
            let mut block = Vec::with_capacity((n + 1) * (n + 1));
            let face = face as u32;
            coarse.block(old, &old[coarse.inner(face)], face, &mut block);
            kernel.run(&block, n, targets);
        });
        for (half, q, row) in &pass.special {
            new[fine.at(*half, 1, *q)] = combined(old, &coarse, row);
        }
        new
    }

    /// The points that a smoothing pass moves, in place: inner points of a block read those of the block and
    /// corners and sides, which are therefore put in their places last.
    fn smoothed(&self, mut points: Vec<Point3<f64>>, n: usize, pass: &Pass) -> Vec<Point3<f64>> {
        debug_assert!(pass.special.is_empty(), "smoothing has rows of vertices only");
        let layout = Layout::new(self.source.topology, n, |_| true);
        let mut outer = vec![Point3::origin(); layout.inner_start()];
        self.outer(&points, &layout, pass, &mut outer);
        let (before, inner) = points.split_at_mut(layout.inner_start());
        if n > 1 {
            let parts = inner.chunks_mut((n - 1) * (n - 1)).collect();
            self.workers.points(parts, &|face, targets| {
                let mut block = Vec::with_capacity((n + 1) * (n + 1));
                layout.block(before, targets, face as u32, &mut block);
                pass.kernel.run(&block, n, targets);
            });
        }
        before.copy_from_slice(&outer);
        points
    }

    /// The corners and sides that a pass makes.
    fn outer(&self, old: &[Point3<f64>], coarse: &Layout<'_>, pass: &Pass, outer: &mut [Point3<f64>]) {
        let topology = self.source.topology;
        let n = coarse.parts(0);
        let (corners, sides) = outer.split_at_mut(topology.vertex_count());
        for (point, row) in corners.iter_mut().zip(&pass.corners) {
            *point = combined(old, coarse, row);
        }
        let width = pass.kernel.scale() * n - 1;
        if width == 0 {
            return;
        }
        self.workers
            .points(sides.chunks_mut(width).collect(), &|edge, targets| {
                let half = topology.half_of_edge(edge as u32);
                let mut rows = Vec::with_capacity(3 * (n + 1));
                let twin = topology.twin(half).filter(|_| !pass.creases[edge]);
                match twin {
                    Some(twin) => {
                        coarse.line(old, twin, 1, &mut rows);
                        rows.reverse();
                        coarse.line(old, half, 0, &mut rows);
                        coarse.line(old, half, 1, &mut rows);
                    }
                    // only the middle row is read
                    None => (0..3).for_each(|_| coarse.line(old, half, 0, &mut rows)),
                }
                pass.kernel.side(&rows, n, twin.is_none(), targets);
            });
    }

    /// The quads of blocks of size `n`, and the marks on them.
    fn mesh(&self, points: Vec<Point3<f64>>, n: usize) -> Mesh {
        let topology = self.source.topology;
        let layout = Layout::new(topology, n, |_| true);
        let mut corners = vec![0_u32; topology.half_count() * n * n];
        let parts = corners.chunks_mut(4 * n * n).collect();
        self.workers
            .indices(parts, &|face, part| layout.quads(face as u32, part));
        let mut mesh = Mesh::of_quads(points, corners);
        let (coarse, fine) = (&self.mesh.features, &mut mesh.features);
        fine.boundary = coarse.boundary;
        fine.corners.clone_from(&coarse.corners);
        fine.vertex_steps.clone_from(&coarse.vertex_steps);
        fine.extraordinary.clone_from(&coarse.extraordinary);
        if coarse.creases.is_empty() && coarse.edge_steps.is_empty() {
            return mesh;
        }
        for number in 0..topology.edge_count() as u32 {
            let pair = topology.edge_points(number);
            let (sharpness, steps) = (coarse.creases.get(&pair), coarse.edge_steps.get(&pair));
            if sharpness.is_none() && steps.is_none() {
                continue;
            }
            let half = topology.half_of_edge(number);
            for p in 0..n {
                let [a, b] = [p, p + 1].map(|p| layout.at(half, p, 0) as u32);
                let part = crate::features::edge(a, b);
                if let Some(&sharpness) = sharpness {
                    fine.creases.insert(part, sharpness);
                }
                if let Some(&steps) = steps {
                    fine.edge_steps.insert(part, steps);
                }
            }
        }
        mesh
    }
}

/// So many points, without touching their memory: the system hands out zeros, when they are written.
fn origins(count: usize) -> Vec<Point3<f64>> {
    vec![[0.0; 3]; count].into_iter().map(Point3::from).collect()
}

fn combined(old: &[Point3<f64>], coarse: &Layout<'_>, row: &Local) -> Point3<f64> {
    let mut sum = [0.0; 3];
    for &(half, p, q, weight) in row {
        accumulate(&mut sum, weight, &old[coarse.at(half, p, q)]);
    }
    Point3::from(sum)
}
