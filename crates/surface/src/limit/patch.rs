//! Bicubic patches: control points of a regular face, and their values.

use super::local::Local;
use crate::refine::{Row, add};

/// Values and derivatives of the four basis functions of uniform cubic splines at `t`. Written out, since a
/// patch is evaluated a million times a second and must not allocate.
#[inline]
pub(crate) fn basis(t: f64) -> [[f64; 4]; 3] {
    let u = 1.0 - t;
    let (t2, u2) = (t * t, u * u);
    let sixth = 1.0 / 6.0;
    [
        [
            u2 * u * sixth,
            (3.0 * t2 * t - 6.0 * t2 + 4.0) * sixth,
            (3.0 * u2 * u - 6.0 * u2 + 4.0) * sixth,
            t2 * t * sixth,
        ],
        [-0.5 * u2, 1.5 * t2 - 2.0 * t, 2.0 * u - 1.5 * u2, 0.5 * t2],
        [u, 3.0 * t - 2.0, 3.0 * u - 2.0, t],
    ]
}

/// Value, first derivatives by s and t, second by ss, st, tt.
pub(crate) type Jet3 = [[f64; 3]; 6];

/// The jet of a patch whose control points run along s first.
#[inline]
pub(crate) fn jet(control: &[[f64; 3]; 16], s: f64, t: f64) -> Jet3 {
    let (in_s, in_t) = (basis(s), basis(t));
    let mut jet = [[0.0; 3]; 6];
    for (row, j) in control.chunks_exact(4).zip(0..) {
        let mut sums = [[0.0; 3]; 3];
        for (point, i) in row.iter().zip(0..) {
            for (sum, weights) in sums.iter_mut().zip(&in_s) {
                sum.iter_mut().zip(point).for_each(|(sum, x)| *sum += weights[i] * x);
            }
        }
        let parts = [(0, 0), (0, 1), (1, 0), (0, 2), (1, 1), (2, 0)];
        for (jet, (by_t, by_s)) in jet.iter_mut().zip(parts) {
            let weight = in_t[by_t][j];
            jet.iter_mut().zip(&sums[by_s]).for_each(|(jet, x)| *jet += weight * x);
        }
    }
    jet
}

/// The rows of the sixteen control points of a regular face over the points of its part, along s first.
/// Beyond rims points are reflected.
pub(crate) fn control(local: &Local) -> [Row; 16] {
    if local.values.is_some() {
        return super::dual::control(local);
    }
    let topology = &local.topology;
    let mut rows: [Row; 16] = std::array::from_fn(|_| Row::new());
    let place = |x: i32, y: i32| (4 * (y + 1) + x + 1) as usize;
    for (corner, (x, y)) in [(0, 0), (1, 0), (1, 1), (0, 1)].into_iter().enumerate() {
        rows[place(x, y)] = vec![(corner as u32, 1.0)];
    }
    // a side's frame: its two corners, and the direction outwards
    let sides = [
        ([(0, 0), (1, 0)], (0, -1)),
        ([(1, 0), (1, 1)], (1, 0)),
        ([(1, 1), (0, 1)], (0, 1)),
        ([(0, 1), (0, 0)], (-1, 0)),
    ];
    let reflected = |on: &Row, inside: &Row| {
        let mut row = Row::new();
        add(&mut row, 2.0, on);
        add(&mut row, -1.0, inside);
        row
    };
    for (half, ([first, second], (dx, dy))) in sides.into_iter().enumerate() {
        let half = half as u32;
        if let Some(twin) = topology.twin(half).filter(|_| !local.is_rim(half)) {
            let outer = topology.head(topology.next(twin));
            rows[place(first.0 + dx, first.1 + dy)] = vec![(outer, 1.0)];
            let outer = topology.origin(topology.previous(twin));
            rows[place(second.0 + dx, second.1 + dy)] = vec![(outer, 1.0)];
        } else {
            for (x, y) in [first, second] {
                let row = reflected(&rows[place(x, y)], &rows[place(x - dx, y - dy)]);
                rows[place(x + dx, y + dy)] = row;
            }
        }
    }
    for (corner, ([(x, y), _], (dx, dy))) in sides.into_iter().enumerate() {
        let half = corner as u32;
        let before = (half + 3) % 4;
        // the side before leads outwards at right angles
        let (ex, ey) = sides[before as usize].1;
        let target = place(x + dx + ex, y + dy + ey);
        let across = |from: (i32, i32), by: (i32, i32)| {
            let on = &rows[place(from.0, from.1)];
            reflected(on, &rows[place(from.0 - by.0, from.1 - by.1)])
        };
        rows[target] = if local.is_rim(half) {
            // reflected in this side, from outside the other one
            across((x + ex, y + ey), (dx, dy))
        } else if local.is_rim(before) {
            across((x + dx, y + dy), (ex, ey))
        } else {
            let spoke = topology.turned(half).and_then(|spoke| topology.turned(spoke));
            let opposite = spoke.map(|spoke| topology.head(topology.next(spoke)));
            opposite.map_or_else(Row::new, |at| vec![(at, 1.0)])
        };
    }
    rows
}
