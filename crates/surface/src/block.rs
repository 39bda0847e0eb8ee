//! Fine levels of bicubic schemes as blocks: no adjacency structure is made for them.
//!
//! When all faces are quads and nothing but sharp edges is left, each face of that mesh becomes a block of
//! `n x n` quads, `n = 2, 4, 8, ..`. Points are stored corners first, then sides (the inner points of each
//! edge, in its direction), then the inner points of each face, row by row. Inner points follow the tensor
//! product of the scheme's [`Line`], on arrays; sides read the first rows of both blocks; corners and the
//! points beside special ones have the rows of their level. Blocks do not depend on each other.

use crate::active::{Active, Ends, Kind, Masks};
use crate::refiner::Refiner;
use crate::rules::Method;
use crate::workers::Workers;
use crate::{Error, Mesh, Topology};
use eigenring_scheme::{Line, Site};
use nalgebra::Point3;

/// The mesh after `levels` levels, of which the first ones run on the whole mesh; `None` where blocks do not
/// apply.
pub(crate) fn refined(refiner: &Refiner<'_>, mesh: &Mesh, levels: usize) -> Result<Option<Mesh>, Error> {
    let rules = refiner.rules();
    if rules.method()? != Method::Bicubic || refiner.ends(mesh) == Ends::Open {
        return Ok(None);
    }
    let mut coarse = mesh.clone();
    for level in 0..levels {
        let topology = Topology::unchecked(&coarse);
        let own = matches!(refiner.rules_on(&coarse, &topology)?, crate::refiner::RulesOn::Own(_));
        let ready = own && coarse.is_quads() && coarse.features.largest_finite_sharpness() == 0.0;
        if ready && let Some(blocks) = Blocks::new(refiner, &coarse, &topology)? {
            return blocks.run(levels - level, refiner.workers).map(Some);
        }
        coarse = refiner.level(&coarse, level)?;
    }
    Ok(Some(coarse))
}

/// How the point of a corner or beside it is made: weights of points in the frame of a half-edge.
type Local = Vec<(u32, usize, usize, f64)>;

struct Blocks<'a> {
    mesh: &'a Mesh,
    topology: &'a Topology,
    line: Line<f64>,
    corners: Vec<Local>,
    creases: Vec<bool>,
    /// Rows of points (1, 0) and (1, 1) in the frame of a half-edge, which are special.
    special: Vec<(u32, usize, Local)>,
}

/// The points of a level.
struct Layout<'a> {
    topology: &'a Topology,
    n: usize,
}

impl Layout<'_> {
    fn side_start(&self) -> usize {
        self.topology.vertex_count()
    }

    fn inner_start(&self) -> usize {
        self.side_start() + self.topology.edge_count() * (self.n - 1)
    }

    fn count(&self) -> usize {
        self.inner_start() + self.topology.face_count() * (self.n - 1) * (self.n - 1)
    }

    /// The point at `p` along a half-edge and `q` to its left.
    fn at(&self, half: u32, p: usize, q: usize) -> usize {
        let n = self.n;
        let (face, turn) = (half / 4, half % 4);
        let (x, y) = match turn {
            0 => (p, q),
            1 => (n - q, p),
            2 => (n - p, n - q),
            _ => (q, n - p),
        };
        self.grid(face, x, y)
    }

    /// The point `(x, y)` of a block, from its first corner along its first and its last side.
    fn grid(&self, face: u32, x: usize, y: usize) -> usize {
        let n = self.n;
        let first = 4 * face;
        let (half, p) = match (x, y) {
            _ if x > 0 && x < n && y > 0 && y < n => {
                return self.inner_start() + (face as usize * (n - 1) + y - 1) * (n - 1) + x - 1;
            }
            (x, 0) => (first, x),
            (x, y) if x == n => (first + 1, y),
            (x, y) if y == n => (first + 2, n - x),
            (_, y) => (first + 3, n - y),
        };
        if p == 0 {
            return self.topology.origin(half) as usize;
        }
        if p == n {
            return self.topology.head(half) as usize;
        }
        let edge = self.topology.edge(half);
        let p = if self.topology.half_of_edge(edge) == half {
            p
        } else {
            n - p
        };
        self.side_start() + edge as usize * (n - 1) + p - 1
    }
}

impl<'a> Blocks<'a> {
    /// What the blocks of a mesh need; `None` if special rules reach farther than one step.
    fn new(refiner: &Refiner<'_>, mesh: &'a Mesh, topology: &'a Topology) -> Result<Option<Self>, Error> {
        let rules = refiner.rules();
        let active = Active::new(topology, &mesh.features, refiner.ends(mesh), rules.steps);
        let regular = rules.inner(None, 4)?;
        let line = regular.limit().passes()[0].line().cloned().unwrap_or_else(Line::cubic);
        let mut corners = Vec::with_capacity(topology.vertex_count());
        let mut special = Vec::new();
        for vertex in 0..topology.vertex_count() as u32 {
            let fan = topology.fan(vertex);
            let Some(&first) = fan.spokes.first() else {
                corners.push(Vec::new());
                continue;
            };
            let own = (first, 0, 0);
            let Masks::One(kind) = active.masks(vertex, 0) else {
                return Ok(None);
            };
            let n = fan.spokes.len();
            corners.push(match kind {
                Kind::Stays => vec![(own.0, 0, 0, 1.0)],
                Kind::Crease(a, b) => {
                    let beside = rules.beside()?;
                    let stencil = beside.limit().stencil(0, Site::CENTRE)?;
                    let towards = |end: u32| {
                        let spoke = fan.spokes.iter().find(|&&spoke| topology.head(spoke) == end);
                        match (spoke, fan.last) {
                            (Some(&spoke), _) => (spoke, 1, 0),
                            // the last spoke is the upper end of the last face
                            (None, _) => (fan.spokes[n - 1], 0, 1),
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
                    let plain = active.is_plain(vertex);
                    let [weight, edges, middles] = rules.mask(vertex, n, plain, 0, 0)?;
                    let mut row = vec![(own.0, 0, 0, weight)];
                    row.extend(fan.spokes.iter().map(|&spoke| (spoke, 1, 0, edges)));
                    row.extend(fan.spokes.iter().map(|&spoke| (spoke, 1, 1, middles)));
                    row
                }
            });
            if kind != Kind::Smooth || !active.is_plain(vertex) || n < 3 || !rules.is_special(vertex, n) {
                continue;
            }
            let scheme = rules.inner(Some(vertex), n)?;
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
        let creases = (0..topology.edge_count() as u32)
            .map(|number| active.edge_weight(topology.edge_points(number)) >= 1.0)
            .collect();
        Ok(Some(Blocks {
            mesh,
            topology,
            line,
            corners,
            creases,
            special,
        }))
    }

    fn run(self, levels: usize, workers: &dyn Workers) -> Result<Mesh, Error> {
        let mut points = self.mesh.points().to_vec();
        let mut n = 1;
        for _ in 0..levels {
            points = self.level(&points, n, workers);
            n *= 2;
        }
        let layout = Layout {
            topology: self.topology,
            n,
        };
        if 4 * self.topology.face_count() * n * n >= u32::MAX as usize {
            return Err(Error::TooLarge {
                what: "corners of faces",
                count: 4 * self.topology.face_count() * n * n,
            });
        }
        let mut corners = vec![0_u32; 4 * self.topology.face_count() * n * n];
        let parts = corners.chunks_mut(4 * n * n).collect();
        workers.indices(parts, &|face, part| {
            let mut quads = part.chunks_exact_mut(4);
            let row = |y: usize, into: &mut Vec<u32>| {
                into.clear();
                into.extend((0..=n).map(|x| layout.grid(face as u32, x, y) as u32));
            };
            let (mut low, mut high) = (Vec::with_capacity(n + 1), Vec::with_capacity(n + 1));
            row(0, &mut low);
            for y in 0..n {
                row(y + 1, &mut high);
                for x in 0..n {
                    if let Some(quad) = quads.next() {
                        quad.copy_from_slice(&[low[x], low[x + 1], high[x + 1], high[x]]);
                    }
                }
                std::mem::swap(&mut low, &mut high);
            }
        });
        let mut mesh = Mesh::of_quads(points, corners);
        mesh.features.boundary = self.mesh.features.boundary;
        mesh.features.corners.clone_from(&self.mesh.features.corners);
        mesh.features
            .extraordinary
            .clone_from(&self.mesh.features.extraordinary);
        for (pair, &sharpness) in &self.mesh.features.creases {
            let half = (0..self.topology.edge_count() as u32).find(|&e| self.topology.edge_points(e) == *pair);
            let Some(half) = half.map(|number| self.topology.half_of_edge(number)) else {
                continue;
            };
            for p in 0..n {
                let ends = [p, p + 1].map(|p| layout.at(half, p, 0) as u32);
                mesh.features
                    .creases
                    .insert(crate::features::edge(ends[0], ends[1]), sharpness);
            }
        }
        Ok(mesh)
    }

    /// The points of blocks of twice the size.
    fn level(&self, old: &[Point3<f64>], n: usize, workers: &dyn Workers) -> Vec<Point3<f64>> {
        let topology = self.topology;
        let coarse = Layout { topology, n };
        let fine = Layout { topology, n: 2 * n };
        debug_assert_eq!(old.len(), coarse.count());
        let mut new = vec![Point3::origin(); fine.count()];
        let combined = |row: &Local| {
            let mut sum = [0.0; 3];
            for &(half, p, q, weight) in row {
                accumulate(&mut sum, weight, &old[coarse.at(half, p, q)]);
            }
            Point3::from(sum)
        };
        for (point, row) in new.iter_mut().zip(&self.corners) {
            *point = combined(row);
        }
        for edge in 0..topology.edge_count() {
            let half = topology.half_of_edge(edge as u32);
            let start = fine.side_start() + edge * (2 * n - 1);
            for j in 1..2 * n {
                new[start + j - 1] = self.side(old, &coarse, half, j, self.creases[edge]);
            }
        }
        let inner = fine.inner_start();
        let width = 2 * n - 1;
        let parts = new[inner..].chunks_mut(width * width).collect();
        let kernel = Kernel::new(&self.line);
        workers.points(parts, &|face, part| {
            let mut block = Vec::with_capacity((n + 1) * (n + 1));
            for y in 0..=n {
                for x in 0..=n {
                    block.push(old[coarse.grid(face as u32, x, y)]);
                }
            }
            kernel.run(&block, n, part);
        });
        for (half, q, row) in &self.special {
            new[fine.at(*half, 1, *q)] = combined(row);
        }
        new
    }

    fn side(&self, old: &[Point3<f64>], coarse: &Layout<'_>, half: u32, j: usize, crease: bool) -> Point3<f64> {
        let n = coarse.n;
        let twin = self.topology.twin(half);
        let mut sum = [0.0; 3];
        for (x, along) in self.line.taps(2 * j as i32) {
            let p = (x / 2) as usize;
            if crease {
                accumulate(&mut sum, along, &old[coarse.at(half, p, 0)]);
                continue;
            }
            for (y, across) in self.line.taps(0) {
                let at = match (y, twin) {
                    (0, _) => coarse.at(half, p, 0),
                    (1.., _) => coarse.at(half, p, 1),
                    (_, Some(twin)) => coarse.at(twin, n - p, 1),
                    // smooth edges have faces on both sides
                    (_, None) => continue,
                };
                accumulate(&mut sum, along * across, &old[at]);
            }
        }
        Point3::from(sum)
    }
}

fn accumulate(sum: &mut [f64; 3], weight: f64, point: &Point3<f64>) {
    sum[0] += weight * point.x;
    sum[1] += weight * point.y;
    sum[2] += weight * point.z;
}

/// The tensor product of a bicubic line, for the four classes of points: sources relative to half the
/// point's place, and weights, in the order of the line's taps.
pub(crate) struct Kernel {
    classes: [[Vec<(usize, usize, f64)>; 2]; 2],
}

impl Kernel {
    pub fn new(line: &Line<f64>) -> Self {
        let class = |i: usize, j: usize| {
            // of a point far enough inside that nothing is negative; offsets count from one step before
            let mut terms = Vec::new();
            for (x, wx) in line.taps(2 * (4 + i as i32)) {
                for (y, wy) in line.taps(2 * (4 + j as i32)) {
                    terms.push(((x / 2 - 1) as usize, (y / 2 - 1) as usize, wx * wy));
                }
            }
            terms
        };
        Kernel {
            classes: [[class(0, 0), class(0, 1)], [class(1, 0), class(1, 1)]],
        }
    }

    /// The inner points of a block of `2n x 2n` out of the `(n+1) x (n+1)` points of a block, both row by
    /// row.
    pub fn run(&self, block: &[Point3<f64>], n: usize, inner: &mut [Point3<f64>]) {
        let stride = n + 1;
        // offsets from the point before half the place, in both directions
        let flat = |class: &Vec<(usize, usize, f64)>| -> Vec<(usize, f64)> {
            class.iter().map(|&(x, y, w)| (y * stride + x, w)).collect()
        };
        let flats = [0, 1].map(|i| [0, 1].map(|j| flat(&self.classes[i][j])));
        let width = 2 * n - 1;
        for (row, j) in inner.chunks_exact_mut(width).zip(1..) {
            for (point, i) in row.iter_mut().zip(1..) {
                let (x, y) = (i / 2, j / 2);
                // block index of (x - 1, y - 1) plus one row and one point, so that it is never negative
                let base = y * stride + x;
                let mut sum = [0.0; 3];
                for &(offset, weight) in &flats[i % 2][j % 2] {
                    accumulate(&mut sum, weight, &block[base + offset - stride - 1]);
                }
                *point = Point3::from(sum);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::families::catmull_clark;
    use eigenring_scheme::{Table, Topology as Sites};

    /// The inner points of one block, seen as sites around each of its vertices.
    struct Grid {
        n: i32,
    }

    impl Sites for Grid {
        fn point(&self, centre: u32, site: Site) -> Option<u32> {
            let (mut x, mut y) = (site.x / 2, site.y / 2);
            for _ in 0..site.sector {
                (x, y) = (-y, x);
            }
            let side = self.n + 1;
            let (i, j) = (centre as i32 % side + x, centre as i32 / side + y);
            ((0..side).contains(&i) && (0..side).contains(&j)).then_some((j * side + i) as u32)
        }
    }

    #[test]
    fn block_kernels_are_the_tables_of_their_lines_bit_for_bit() {
        let n = 8;
        let grid = Grid { n: n as i32 };
        let points: Vec<Point3<f64>> = (0..(n + 1) * (n + 1))
            .map(|k| Point3::new((k as f64 * 1.7).sin(), (k as f64).cos(), k as f64 / 7.0))
            .collect();
        let scheme = catmull_clark::<f64>(4).unwrap();
        let line = scheme.limit().passes()[0].line().unwrap();
        // the regular level without the vertex's own stencil, whose terms come in another order
        let pass = eigenring_scheme::Pass::regular(
            eigenring_scheme::Lattice::Vertex,
            eigenring_scheme::Lattice::Vertex,
            line.clone(),
        );
        let level = eigenring_scheme::Level::new(eigenring_scheme::Fan::Closed(4), vec![pass]).unwrap();
        let width = 2 * n - 1;
        let targets = (0..width * width).map(|k| {
            let (i, j) = (k % width + 1, k / width + 1);
            let centre = ((j / 2) * (n + 1) + i / 2) as u32;
            let site = match (i % 2, j % 2) {
                (0, 0) => Site::CENTRE,
                (1, 0) => Site { sector: 0, x: 2, y: 0 },
                (0, _) => Site { sector: 1, x: 2, y: 0 },
                _ => Site { sector: 0, x: 2, y: 2 },
            };
            (centre, site)
        });
        let targets: Vec<(u32, Site)> = targets.collect();
        let table = Table::around(&grid, 0, |_| &level, targets.iter().copied()).unwrap();
        let values: Vec<[f64; 3]> = points.iter().map(|p| [p.x, p.y, p.z]).collect();
        let expected = table.apply(&values).unwrap();
        let mut made = vec![Point3::origin(); width * width];
        Kernel::new(line).run(&points, n, &mut made);
        for ((made, expected), (_, site)) in made.iter().zip(&expected).zip(&targets) {
            // a point of spoke 1 is the table's transposed sum: equal up to the order of its terms
            if site.sector == 0 {
                assert_eq!([made.x, made.y, made.z], *expected);
            } else {
                assert!((made.x - expected[0]).abs() < 1e-15 * 100.0);
            }
        }
    }
}
