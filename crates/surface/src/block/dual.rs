//! Fine levels of dual schemes as blocks: all odd orders on closed meshes without creases.
//!
//! After the first level every corner `h` of a face of the control mesh is a point, and from then on a block
//! of `n x n` points, `n = 1, 2, 4, ..`: from the face's vertex v at (0, 0) along its edge to (1, 0), the
//! middle of the face at (1, 1). Each point becomes four by the scheme's [`Line`], and reads its neighbours
//! in the block or across its sides; only the points next to a vertex or face that is not of size 4 have rows
//! of their own. Smoothing then moves each point to the mean of the centres of its four cells, two averages
//! by [`Line::average`] on arrays, with the centres of cells that are no quads put in their places.

use crate::dual::smoothing_passes;
use crate::rules::Rules;
use crate::workers::Workers;
use crate::{Error, Mesh, Topology};
use eigenring_scheme::{Line, Site};
use nalgebra::Point3;

/// The blocks of a control mesh.
struct Blocks<'a> {
    topology: &'a Topology,
    rules: &'a Rules,
    workers: &'a dyn Workers,
}

/// Where the point `(x, y)` of the block of a corner is.
fn at(n: usize, half: u32, x: usize, y: usize) -> usize {
    (half as usize * n + y) * n + x
}

/// The net after `levels` levels, at least two, of a closed mesh.
pub(crate) fn refined(mesh: &Mesh, rules: &Rules, levels: usize, workers: &dyn Workers) -> Result<Mesh, Error> {
    let topology = &Topology::unchecked(mesh);
    let blocks = Blocks {
        topology,
        rules,
        workers,
    };
    let count = topology.half_count() << (2 * (levels - 1));
    if 4 * count >= u32::MAX as usize {
        return Err(Error::TooLarge {
            what: "corners of faces",
            count: 4 * count,
        });
    }
    let (mut points, mut n) = (Vec::new(), 1);
    for level in 0..levels {
        points = if level == 0 {
            blocks.first(mesh)?
        } else {
            n *= 2;
            blocks.cut_all(&points, n / 2, level)?
        };
        for _ in 0..smoothing_passes(rules, level)? {
            points = blocks.smoothed(points, n);
        }
    }
    blocks.cells(points, n)
}

impl Blocks<'_> {
    /// The points of the first level, in the order of corners.
    fn first(&self, mesh: &Mesh) -> Result<Vec<Point3<f64>>, Error> {
        let mut points = vec![Point3::origin(); self.topology.half_count()];
        for face in 0..self.topology.face_count() as u32 {
            let halves: Vec<u32> = self.topology.face_halves(face).collect();
            let old: Vec<Point3<f64>> = mesh
                .face(face as usize)
                .iter()
                .map(|&v| mesh.points()[v as usize])
                .collect();
            for (half, point) in halves.into_iter().zip(self.cut(&old, 0)?) {
                points[half as usize] = point;
            }
        }
        Ok(points)
    }

    /// The new corners of a cell.
    fn cut(&self, old: &[Point3<f64>], level: usize) -> Result<Vec<Point3<f64>>, Error> {
        let n = old.len();
        let scheme = self.rules.inner(None, n)?;
        let stencil = scheme.level(level).stencil(0, Site { sector: 0, x: 1, y: 1 })?;
        let new = |corner: usize| {
            let mut sum = [0.0; 3];
            for (site, weight) in stencil.terms() {
                let point = &old[(corner + site.sector) % n];
                (0..3).for_each(|k| sum[k] += weight * point[k]);
            }
            Point3::from(sum)
        };
        Ok((0..n).map(new).collect())
    }

    /// Blocks of twice the size by corner cutting.
    fn cut_all(&self, old: &[Point3<f64>], n: usize, level: usize) -> Result<Vec<Point3<f64>>, Error> {
        let topology = self.topology;
        let regular = self.rules.inner(None, 4)?;
        let line = regular.level(level).passes()[0]
            .line()
            .cloned()
            .unwrap_or_else(|| Line::corner_cutting(1.0));
        let mut new = super::origins(4 * old.len());
        let parts = new.chunks_mut(4 * n * n).collect();
        self.workers.points(parts, &|half, part| {
            let mut halo = vec![Point3::origin(); 4 * (n + 1)];
            self.halo(old, n, half as u32, &mut halo);
            let block = with_halo(&old[n * n * half..n * n * (half + 1)], &halo, n);
            cut_block(&line, &block, n, part);
        });
        for vertex in 0..topology.vertex_count() as u32 {
            let spokes = topology.fan(vertex).spokes;
            if spokes.len() != 4 && !spokes.is_empty() {
                let corners: Vec<Point3<f64>> = spokes.iter().map(|&half| old[at(n, half, 0, 0)]).collect();
                for (&half, point) in spokes.iter().zip(self.cut(&corners, level)?) {
                    new[at(2 * n, half, 0, 0)] = point;
                }
            }
        }
        for face in 0..topology.face_count() as u32 {
            let halves: Vec<u32> = topology.face_halves(face).collect();
            if halves.len() != 4 {
                let corners: Vec<Point3<f64>> = halves.iter().map(|&half| old[at(n, half, n - 1, n - 1)]).collect();
                for (&half, point) in halves.iter().zip(self.cut(&corners, level)?) {
                    new[at(2 * n, half, 2 * n - 1, 2 * n - 1)] = point;
                }
            }
        }
        Ok(new)
    }

    /// Each point moved to the mean of the centres of its four cells.
    fn smoothed(&self, mut points: Vec<Point3<f64>>, n: usize) -> Vec<Point3<f64>> {
        let topology = self.topology;
        let old = points.as_slice();
        let mean = |cell: &mut dyn ExactSizeIterator<Item = usize>| {
            let count = cell.len();
            let sum: nalgebra::Vector3<f64> = cell.map(|at| old[at].coords).sum();
            (count != 4 && count > 0).then(|| Point3::from(sum / count as f64))
        };
        let vertices = (0..topology.vertex_count() as u32)
            .map(|vertex| mean(&mut topology.fan(vertex).spokes.iter().map(|&half| at(n, half, 0, 0))));
        let vertices: Vec<Option<Point3<f64>>> = vertices.collect();
        let faces = (0..topology.face_count() as u32)
            .map(|face| mean(&mut topology.face_halves(face).map(|half| at(n, half, n - 1, n - 1))));
        let faces: Vec<Option<Point3<f64>>> = faces.collect();
        // what blocks read of each other, so that they can be moved in place
        let rim = 4 * (n + 1);
        let mut halos = vec![Point3::origin(); rim * topology.half_count()];
        let old = points.as_slice();
        self.workers.points(halos.chunks_mut(rim).collect(), &|half, halo| {
            self.halo(old, n, half as u32, halo);
        });
        self.workers.points(points.chunks_mut(n * n).collect(), &|half, part| {
            let block = with_halo(part, &halos[rim * half..rim * (half + 1)], n);
            let (half, side) = (half as u32, n + 1);
            let mut centres = vec![Point3::origin(); side * side];
            averaged(&block, &mut centres, side);
            if let Some(centre) = vertices[topology.origin(half) as usize] {
                centres[0] = centre;
            }
            if let Some(centre) = faces[topology.face(half) as usize] {
                centres[side * side - 1] = centre;
            }
            averaged(&centres, part, n);
        });
        points
    }

    /// The points around a block: those below, above, on the left and on the right, `n+1` each, beginning at
    /// the corners (-1, -1), (0, n), (-1, 0) and (n, -1). Where there is no unique point beyond a corner the
    /// block's own stands for it; it is read by the point that has its own row only.
    fn halo(&self, old: &[Point3<f64>], n: usize, half: u32, halo: &mut [Point3<f64>]) {
        let topology = self.topology;
        // closed meshes have twins
        let twin = |half: u32| topology.twin(half).unwrap_or(half);
        let below = topology.next(twin(half));
        let left = twin(topology.previous(half));
        let (right, above) = (topology.next(half), topology.previous(half));
        let sides = [
            at(n, topology.next(twin(below)), 0, 0),
            at(n, topology.next(right), n - 1, n - 1),
            at(n, topology.next(left), 0, n - 1),
            at(n, twin(half), n - 1, 0),
        ];
        let side = n + 1;
        halo[0] = old[sides[0]];
        halo[side + n] = old[sides[1]];
        halo[2 * side + n] = old[sides[2]];
        halo[3 * side] = old[sides[3]];
        for i in 0..n {
            halo[1 + i] = old[at(n, below, 0, i)];
            halo[side + i] = old[at(n, above, n - 1, i)];
            halo[2 * side + i] = old[at(n, left, i, 0)];
            halo[3 * side + 1 + i] = old[at(n, right, i, n - 1)];
        }
    }

    fn cells(&self, points: Vec<Point3<f64>>, n: usize) -> Result<Mesh, Error> {
        let topology = self.topology;
        let count = points.len();
        let mut mesh = Mesh::of_points(points);
        mesh.reserve(count, 4 * count);
        let index = |half: u32, x: usize, y: usize| at(n, half, x, y) as u32;
        for half in 0..topology.half_count() as u32 {
            let twin = topology.twin(half).unwrap_or(half);
            let (below, right) = (topology.next(twin), topology.next(half));
            for y in 0..n - 1 {
                for x in 0..n - 1 {
                    mesh.push_corners(&[
                        index(half, x, y),
                        index(half, x + 1, y),
                        index(half, x + 1, y + 1),
                        index(half, x, y + 1),
                    ]);
                }
            }
            for i in 0..n - 1 {
                mesh.push_corners(&[
                    index(below, 0, i),
                    index(below, 0, i + 1),
                    index(half, i + 1, 0),
                    index(half, i, 0),
                ]);
                mesh.push_corners(&[
                    index(half, n - 1, i),
                    index(right, i, n - 1),
                    index(right, i + 1, n - 1),
                    index(half, n - 1, i + 1),
                ]);
            }
            if half < twin {
                mesh.push_corners(&[
                    index(right, 0, n - 1),
                    index(half, n - 1, 0),
                    index(below, 0, n - 1),
                    index(twin, n - 1, 0),
                ]);
            }
        }
        for vertex in 0..topology.vertex_count() as u32 {
            let corners: Vec<u32> = topology
                .fan(vertex)
                .spokes
                .iter()
                .map(|&half| index(half, 0, 0))
                .collect();
            if !corners.is_empty() {
                mesh.push_corners(&corners);
            }
        }
        for face in 0..topology.face_count() as u32 {
            let corners: Vec<u32> = topology
                .face_halves(face)
                .map(|half| index(half, n - 1, n - 1))
                .collect();
            mesh.push_corners(&corners);
        }
        Ok(mesh)
    }
}

/// The points of a block and those around it, row by row from (-1, -1).
fn with_halo(points: &[Point3<f64>], halo: &[Point3<f64>], n: usize) -> Vec<Point3<f64>> {
    let side = n + 1;
    let mut block = Vec::with_capacity((n + 2) * (n + 2));
    block.extend_from_slice(&halo[..side]);
    block.push(halo[3 * side]);
    for (row, y) in points.chunks_exact(n).zip(0..) {
        block.push(halo[2 * side + y]);
        block.extend_from_slice(row);
        block.push(halo[3 * side + 1 + y]);
    }
    block.push(halo[2 * side + n]);
    block.extend_from_slice(&halo[side..2 * side]);
    block
}

/// The means of four neighbours, `n` in a row, by [`Line::average`] in both directions.
fn averaged(block: &[Point3<f64>], means: &mut [Point3<f64>], n: usize) {
    for (mean, pair) in means.chunks_exact_mut(n).zip(block.windows(2 * (n + 1)).step_by(n + 1)) {
        let (low, high) = pair.split_at(n + 1);
        for ((mean, low), high) in mean.iter_mut().zip(low.windows(2)).zip(high.windows(2)) {
            *mean = Point3::from((low[0].coords + low[1].coords + high[0].coords + high[1].coords) * 0.25);
        }
    }
}

/// Four points for each of a block with its halo.
fn cut_block(line: &Line<f64>, block: &[Point3<f64>], n: usize, part: &mut [Point3<f64>]) {
    // of the targets 2i, 2i+1 of a point i: the offsets of both sources in points, and their weights
    let taps = [0, 1].map(|a| -> [(usize, f64); 2] {
        let mut found = [(0, 0.0); 2];
        for (slot, (source, weight)) in found.iter_mut().zip(line.taps(2 * (8 + a) + 1)) {
            // the point i = 4 sits at 9 half steps; offsets count from one point before
            *slot = (((source - 9) / 2 + 1) as usize, weight);
        }
        found
    });
    let side = n + 2;
    for (y2, row) in part.chunks_exact_mut(2 * n).enumerate() {
        for (x2, point) in row.iter_mut().enumerate() {
            let base = (y2 / 2) * side + x2 / 2;
            let mut sum = [0.0; 3];
            for (x, wx) in taps[x2 % 2] {
                for (y, wy) in taps[y2 % 2] {
                    let source = &block[base + y * side + x];
                    let weight = wx * wy;
                    sum[0] += weight * source.x;
                    sum[1] += weight * source.y;
                    sum[2] += weight * source.z;
                }
            }
            *point = Point3::from(sum);
        }
    }
}
