//! Where the points of blocks are.

use crate::Topology;
use nalgebra::Point3;

/// The points of a level.
pub(super) struct Layout<'a> {
    pub topology: &'a Topology,
    pub n: usize,
}

impl Layout<'_> {
    pub fn side_start(&self) -> usize {
        self.topology.vertex_count()
    }

    pub fn inner_start(&self) -> usize {
        self.side_start() + self.topology.edge_count() * (self.n - 1)
    }

    /// Where the inner points of a block begin.
    pub fn inner(&self, face: usize) -> usize {
        self.inner_start() + face * (self.n - 1) * (self.n - 1)
    }

    pub fn count(&self) -> usize {
        self.inner_start() + self.topology.face_count() * (self.n - 1) * (self.n - 1)
    }

    /// The point at `p` along a half-edge and `q` to its left.
    pub fn at(&self, half: u32, p: usize, q: usize) -> usize {
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
    pub fn grid(&self, face: u32, x: usize, y: usize) -> usize {
        let n = self.n;
        let first = 4 * face;
        let (half, p) = match (x, y) {
            _ if x > 0 && x < n && y > 0 && y < n => {
                return self.inner(face as usize) + (y - 1) * (n - 1) + x - 1;
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

    /// Adds the points of a block, row by row: inner ones are given, the others are among those before them.
    pub fn block(&self, outer: &[Point3<f64>], inner: &[Point3<f64>], face: u32, into: &mut Vec<Point3<f64>>) {
        let n = self.n;
        self.line(outer, 4 * face, 0, into);
        for y in 1..n {
            into.push(outer[self.grid(face, 0, y)]);
            into.extend_from_slice(&inner[(y - 1) * (n - 1)..y * (n - 1)]);
            into.push(outer[self.grid(face, n, y)]);
        }
        self.line(outer, 4 * face, n, into);
    }

    /// Adds the points along a half-edge, `q` to its left.
    pub fn line(&self, points: &[Point3<f64>], half: u32, q: usize, into: &mut Vec<Point3<f64>>) {
        let n = self.n;
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
}
