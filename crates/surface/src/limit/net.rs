//! The control points of a regular piece: where the quads of a part lie around its face, continued by
//! reflection beyond rims.
//!
//! The middle of the quad `(x, y)` has the doubled coordinates `(2x+1, 2y+1)`, vertices have even ones: the
//! face is `(0, 0)`, its first side leads from `(0, 0)` to `(2, 0)`. A boundary or crease of a regular net is
//! a line of even coordinate, and the net is continued by `P(a-d) = 2 P(a) - P(a+d)` beyond it.

use super::kernel::Kernel;
use super::local::Local;
use super::partial::Lines;
use crate::refine::{Row, add};
use std::collections::{BTreeMap, HashMap};

struct Net<'a> {
    local: &'a Local,
    /// The control points that are there, by doubled coordinates.
    known: HashMap<[i32; 2], u32>,
    /// The rims to the left and to the right, below and above.
    ends: [[Option<i32>; 2]; 2],
    /// Creases that act in some smoothing steps, by their places.
    lines: [BTreeMap<i32, u32>; 2],
}

/// The control points of a piece, as rows over the points of its part, along s first, and the creases across
/// s and t that act in some smoothing steps only.
#[derive(Debug)]
pub(crate) struct Control {
    pub rows: Vec<Row>,
    pub lines: [Lines; 2],
}

/// The control points of the face's piece; `None` where the part ends before the piece does.
pub(crate) fn control(local: &Local, kernel: &Kernel) -> Option<Control> {
    let rings = kernel.rings as i32;
    let mut net = Net {
        local,
        known: HashMap::new(),
        ends: [[None; 2]; 2],
        lines: [BTreeMap::new(), BTreeMap::new()],
    };
    net.spread(rings);
    let places: Vec<i32> = if kernel.dual {
        (-rings..=rings).map(|x| 2 * x + 1).collect()
    } else {
        (-rings..=rings + 1).map(|x| 2 * x).collect()
    };
    let mut rows = Vec::with_capacity(places.len() * places.len());
    for &y in &places {
        for &x in &places {
            rows.push(net.row([x, y])?);
        }
    }
    Some(Control {
        rows,
        lines: [0, 1].map(|axis| net.mirrored_lines(axis, kernel)),
    })
}

impl Net<'_> {
    /// Finds the quads of so many rings from neighbour to neighbour, up to rims.
    fn spread(&mut self, rings: i32) {
        let topology = &self.local.topology;
        let next = |half: u32, times: usize| (0..times).fold(half, |half, _| topology.next(half));
        // quads by the half-edge of their lower side
        let mut placed: HashMap<[i32; 2], u32> = HashMap::from([([0, 0], 0)]);
        let mut queue = vec![[0, 0]];
        while let Some([x, y]) = queue.pop() {
            let lower = placed[&[x, y]];
            self.note([2 * x + 1, 2 * y + 1], lower);
            // sides counter-clockwise from below, and the turns from the twin to the neighbour's lower side
            let sides = [([0, -1], 2), ([1, 0], 1), ([0, 1], 0), ([-1, 0], 3)];
            for (side, ([dx, dy], turns)) in sides.into_iter().enumerate() {
                let half = next(lower, side);
                if let Some(steps) = self.local.steps(half) {
                    let (axis, upper) = (usize::from(dx == 0), i32::from(dx + dy > 0));
                    self.lines[axis].insert([x, y][axis] + upper, steps);
                }
                if self.local.is_rim(half) {
                    let (axis, upper) = (usize::from(dx == 0), usize::from(dx + dy > 0));
                    let line = 2 * [x, y][axis] + if upper == 1 { 2 } else { 0 };
                    let end = &mut self.ends[axis][upper];
                    let nearer = |known: i32| if upper == 1 { known.min(line) } else { known.max(line) };
                    *end = Some(end.map_or(line, nearer));
                    continue;
                }
                let at = [x + dx, y + dy];
                if at.iter().any(|c| c.abs() > rings) || placed.contains_key(&at) {
                    continue;
                }
                if let Some(twin) = topology.twin(half) {
                    placed.insert(at, next(twin, turns));
                    queue.push(at);
                }
            }
        }
    }

    /// Notes the control points of a quad, given by the half-edge of its lower side.
    fn note(&mut self, [x, y]: [i32; 2], lower: u32) {
        let topology = &self.local.topology;
        let corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
        let Some((net, _)) = &self.local.net else {
            let mut half = lower;
            for [dx, dy] in corners {
                self.known.insert([x + dx, y + dy], topology.origin(half));
                half = topology.next(half);
            }
            return;
        };
        self.known.insert([x, y], topology.face(lower));
        let mut half = lower;
        for ([dx, dy], [ex, ey]) in corners.into_iter().zip([[0, -1], [1, 0], [0, 1], [-1, 0]]) {
            if let Some(&corner) = net.corners.get(&topology.origin(half)) {
                self.known.insert([x + dx, y + dy], corner);
            }
            let [a, b] = topology.ends(half);
            if let Some(&rim) = net.rims.get(&crate::features::edge(a, b)) {
                self.known.insert([x + ex, y + ey], rim);
            }
            half = topology.next(half);
        }
    }

    /// The creases across an axis, and their images beyond rims.
    fn mirrored_lines(&self, axis: usize, kernel: &Kernel) -> Lines {
        let mut lines = self.lines[axis].clone();
        lines.retain(|&line, _| kernel.is_within(line));
        loop {
            let ends = self.ends[axis].into_iter().flatten();
            let images = ends.flat_map(|end| lines.iter().map(move |(&line, &steps)| (end - line, steps)));
            let images: Vec<(i32, u32)> = images.filter(|&(line, _)| kernel.is_within(line)).collect();
            let before = lines.len();
            lines.extend(images);
            if lines.len() == before {
                return lines.into_iter().collect();
            }
        }
    }

    fn row(&self, at: [i32; 2]) -> Option<Row> {
        for axis in 0..2 {
            for (end, sign) in self.ends[axis].into_iter().zip([-1, 1]) {
                let Some(line) = end.filter(|line| (at[axis] - line) * sign > 0) else {
                    continue;
                };
                let (mut on, mut inside) = (at, at);
                on[axis] = line;
                inside[axis] = 2 * line - at[axis];
                let mut row = Row::new();
                add(&mut row, 2.0, &self.row(on)?);
                add(&mut row, -1.0, &self.row(inside)?);
                return Some(row);
            }
        }
        self.known.get(&at).map(|&point| vec![(point, 1.0)])
    }
}
