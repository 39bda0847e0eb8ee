//! Faces with their control points.

use std::ops::{Deref, Range};

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Kind {
    Far,
    Near(usize, [i32; 2]),
    Irregular(usize),
    /// With knot intervals: an element of the space's list.
    Element(usize),
}

#[derive(Debug)]
pub(crate) struct Cell {
    /// The number of the face in the mesh of the level.
    pub face: u32,
    pub kind: Kind,
    points: Range<usize>,
}

/// Faces, whose control points are in one list.
#[derive(Debug, Default)]
pub(crate) struct Cells {
    list: Vec<Cell>,
    points: Vec<u32>,
}

impl Cells {
    /// A face with points of the mesh with ghosts, by the numbering of its kind's table.
    pub fn push(&mut self, face: u32, kind: Kind, points: &[u32]) {
        let first = self.points.len();
        self.points.extend(points);
        let points = first..self.points.len();
        self.list.push(Cell { face, kind, points });
    }

    pub fn points(&self, cell: usize) -> &[u32] {
        &self.points[self.list[cell].points.clone()]
    }
}

impl Deref for Cells {
    type Target = [Cell];

    fn deref(&self) -> &[Cell] {
        &self.list
    }
}
