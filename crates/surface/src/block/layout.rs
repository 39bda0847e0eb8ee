//! Where the points of blocks are.

use crate::{Error, Mesh, Topology};
use nalgebra::Point3;
use std::ops::Range;

/// The points of fine levels of a mesh: first its vertices, then *sides*, the inner points of each edge in
/// its direction, then the inner points of each face, row by row. An edge consists of `n` parts or, where it
/// is not cut, of one. Opposite edges of quads have as many parts; faces that are no quads have edges that
/// are not cut.
#[derive(Clone, Debug)]
pub struct Layout<'a> {
    topology: &'a Topology,
    /// Where the inner points of each edge and of each face begin, and where the last ones end.
    sides: Vec<usize>,
    inner: Vec<usize>,
}

impl<'a> Layout<'a> {
    /// The layout of edges in `n` parts each where they are cut, by their numbers.
    pub fn new(topology: &'a Topology, n: usize, is_cut: impl Fn(u32) -> bool) -> Self {
        let mut end = topology.vertex_count();
        let mut sides = Vec::with_capacity(topology.edge_count() + 1);
        sides.push(end);
        for edge in 0..topology.edge_count() as u32 {
            end += if is_cut(edge) { n - 1 } else { 0 };
            sides.push(end);
        }
        let mut layout = Layout {
            topology,
            sides,
            inner: Vec::with_capacity(topology.face_count() + 1),
        };
        layout.inner.push(end);
        for face in 0..topology.face_count() as u32 {
            let [width, height] = layout.size(face);
            end += (width - 1) * (height - 1);
            layout.inner.push(end);
        }
        layout
    }

    /// The number of parts of an edge.
    pub fn parts(&self, half: u32) -> usize {
        self.side(self.topology.edge(half)).len() + 1
    }

    /// The parts of a face along its first edge and along its last.
    pub fn size(&self, face: u32) -> [usize; 2] {
        let first = self.topology.face_halves(face).start;
        [self.parts(first), self.parts(first + 1)]
    }

    /// The inner points of an edge.
    pub fn side(&self, edge: u32) -> Range<usize> {
        self.sides[edge as usize]..self.sides[edge as usize + 1]
    }

    /// Those of a face.
    pub fn inner(&self, face: u32) -> Range<usize> {
        self.inner[face as usize]..self.inner[face as usize + 1]
    }

    /// Where the inner points of the first face begin.
    pub fn inner_start(&self) -> usize {
        self.inner[0]
    }

    /// The number of points.
    pub fn count(&self) -> usize {
        self.inner.last().copied().unwrap_or(0)
    }

    /// The number of faces, one for each face that is no quad.
    pub fn face_count(&self) -> usize {
        let parts = |face: u32| -> usize { self.size(face).into_iter().product() };
        (0..self.topology.face_count() as u32).map(parts).sum()
    }

    /// The point at `p` along a half-edge of a quad and `q` to its left.
    pub fn at(&self, half: u32, p: usize, q: usize) -> usize {
        let face = self.topology.face(half);
        let first = self.topology.face_halves(face).start;
        let [w, h] = self.size(face);
        let (x, y) = match half - first {
            0 => (p, q),
            1 => (w - q, p),
            2 => (w - p, h - q),
            _ => (q, h - p),
        };
        self.grid(face, x, y)
    }

    /// The point `(x, y)` of a quad, from its first corner along its first and its last side.
    pub fn grid(&self, face: u32, x: usize, y: usize) -> usize {
        let [w, h] = self.size(face);
        let first = self.topology.face_halves(face).start;
        let (half, p) = match (x, y) {
            _ if x > 0 && x < w && y > 0 && y < h => {
                return self.inner[face as usize] + (y - 1) * (w - 1) + x - 1;
            }
            (x, 0) => (first, x),
            (x, y) if x == w => (first + 1, y),
            (x, y) if y == h => (first + 2, w - x),
            (_, y) => (first + 3, h - y),
        };
        let parts = self.parts(half);
        if p == 0 {
            return self.topology.origin(half) as usize;
        }
        if p == parts {
            return self.topology.head(half) as usize;
        }
        let edge = self.topology.edge(half);
        let p = if self.topology.half_of_edge(edge) == half {
            p
        } else {
            parts - p
        };
        self.sides[edge as usize] + p - 1
    }

    /// Adds the points of a quad, row by row: inner ones are given, the others are among those before them.
    pub(super) fn block<T: Copy>(&self, outer: &[T], inner: &[T], face: u32, into: &mut Vec<T>) {
        let [w, h] = self.size(face);
        let first = self.topology.face_halves(face).start;
        self.line(outer, first, 0, into);
        for y in 1..h {
            into.push(outer[self.grid(face, 0, y)]);
            into.extend_from_slice(&inner[(y - 1) * (w - 1)..y * (w - 1)]);
            into.push(outer[self.grid(face, w, y)]);
        }
        self.line(outer, first, h, into);
    }

    /// Adds the points of a row of a quad.
    pub fn row<T: Copy>(&self, points: &[T], face: u32, y: usize, into: &mut Vec<T>) {
        self.line(points, self.topology.face_halves(face).start, y, into);
    }

    /// Adds the points along a half-edge of a quad, `q` to its left.
    pub fn line<T: Copy>(&self, points: &[T], half: u32, q: usize, into: &mut Vec<T>) {
        let n = self.parts(half);
        into.push(points[self.at(half, 0, q)]);
        if n > 1 {
            // those between the ends are equally far from each other
            let mut at = self.at(half, 1, q);
            let step = if n > 2 {
                self.at(half, 2, q) as isize - at as isize
            } else {
                0
            };
            for _ in 1..n {
                into.push(points[at]);
                at = at.wrapping_add_signed(step);
            }
        }
        into.push(points[self.at(half, n, q)]);
    }

    /// The quads of a face, four corners each, into as much room as they need.
    pub fn quads(&self, face: u32, into: &mut [u32]) {
        let [w, h] = self.size(face);
        let row = |y: usize, into: &mut Vec<u32>| {
            into.clear();
            into.extend((0..=w).map(|x| self.grid(face, x, y) as u32));
        };
        let (mut low, mut high) = (Vec::with_capacity(w + 1), Vec::with_capacity(w + 1));
        row(0, &mut low);
        for (y, quads) in (0..h).zip(into.chunks_exact_mut(4 * w)) {
            row(y + 1, &mut high);
            for (x, quad) in quads.chunks_exact_mut(4).enumerate() {
                quad.copy_from_slice(&[low[x], low[x + 1], high[x + 1], high[x]]);
            }
            std::mem::swap(&mut low, &mut high);
        }
    }

    /// The mesh of these points: the quads of each face in turn, and faces that are no quads as they are.
    ///
    /// # Errors
    /// [`Error::TooLarge`] beyond 32-bit indices.
    pub fn mesh(&self, points: Vec<Point3<f64>>) -> Result<Mesh, Error> {
        let topology = self.topology;
        let (mut sizes, mut corners) = (Vec::with_capacity(self.face_count()), Vec::new());
        for face in 0..topology.face_count() as u32 {
            if topology.face_size(face) != 4 {
                corners.extend(topology.face_halves(face).map(|half| topology.origin(half)));
                sizes.push(topology.face_size(face));
                continue;
            }
            let count = self.size(face).into_iter().product();
            let start = corners.len();
            corners.resize(start + 4 * count, 0);
            self.quads(face, &mut corners[start..]);
            sizes.extend(std::iter::repeat_n(4, count));
        }
        Mesh::of_faces(points, sizes, corners)
    }
}
