//! Clipping to a rectangle, so that drawings need no clip paths.

use crate::scene::Rect;

/// The part of the segment inside the rectangle (Liang and Barsky 1984).
fn segment(a: [f64; 2], b: [f64; 2], to: &Rect) -> Option<[[f64; 2]; 2]> {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    let sides = [
        (-dx, a[0] - to.left),
        (dx, to.right - a[0]),
        (-dy, a[1] - to.top),
        (dy, to.bottom - a[1]),
    ];
    for (rate, room) in sides {
        if rate == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if rate < 0.0 {
            enter = enter.max(room / rate);
        } else {
            leave = leave.min(room / rate);
        }
    }
    let at = |t: f64| if t == 1.0 { b } else { [a[0] + t * dx, a[1] + t * dy] };
    (enter <= leave).then(|| [at(enter), at(leave)])
}

/// The pieces of a polyline inside the rectangle. Points that are not finite interrupt it.
pub(crate) fn polyline(points: &[[f64; 2]], to: &Rect) -> Vec<Vec<[f64; 2]>> {
    let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut joined = false;
    for pair in points.windows(2) {
        let inside = pair
            .iter()
            .all(|p| p[0].is_finite() && p[1].is_finite())
            .then(|| segment(pair[0], pair[1], to))
            .flatten();
        let Some([from, until]) = inside else {
            joined = false;
            continue;
        };
        match pieces.last_mut() {
            Some(piece) if joined && from == pair[0] => piece.push(until),
            _ => pieces.push(vec![from, until]),
        }
        joined = until == pair[1];
    }
    pieces
}

/// The part of a polygon inside the rectangle (Sutherland and Hodgman 1974); empty if nothing is left or a
/// corner is not finite.
pub(crate) fn polygon(corners: &[[f64; 2]], to: &Rect) -> Vec<[f64; 2]> {
    if !corners.iter().flatten().all(|c| c.is_finite()) {
        return Vec::new();
    }
    let mut kept = corners.to_vec();
    // one side after the other: axis, sign of the inside, position
    for (axis, sign, limit) in [
        (0, 1.0, to.left),
        (0, -1.0, to.right),
        (1, 1.0, to.top),
        (1, -1.0, to.bottom),
    ] {
        let distance = |p: &[f64; 2]| sign * (p[axis] - limit);
        let mut next = Vec::with_capacity(kept.len() + 1);
        for (index, p) in kept.iter().enumerate() {
            let q = &kept[(index + 1) % kept.len()];
            let (from, until) = (distance(p), distance(q));
            if from >= 0.0 {
                next.push(*p);
            }
            if (from >= 0.0) != (until >= 0.0) {
                let t = from / (from - until);
                next.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
            }
        }
        kept = next;
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Rect = Rect {
        left: 0.0,
        top: 0.0,
        right: 1.0,
        bottom: 1.0,
    };

    #[test]
    fn lines_are_cut_at_the_border_and_at_gaps() {
        let pieces = polyline(&[[-1.0, 0.5], [0.5, 0.5], [0.5, 2.0], [0.9, 0.5]], &UNIT);
        assert_eq!(pieces.len(), 2);
        assert_eq!(pieces[0], [[0.0, 0.5], [0.5, 0.5], [0.5, 1.0]]);
        let gap = polyline(&[[0.1, 0.1], [0.2, f64::NAN], [0.3, 0.1], [0.4, 0.1]], &UNIT);
        assert_eq!(gap, [[[0.3, 0.1], [0.4, 0.1]]]);
        assert!(polyline(&[[2.0, 0.0], [3.0, 1.0]], &UNIT).is_empty());
    }

    #[test]
    fn polygons_keep_their_area_inside() {
        let area = |p: &[[f64; 2]]| {
            let twice: f64 = (0..p.len())
                .map(|i| {
                    let (a, b) = (p[i], p[(i + 1) % p.len()]);
                    a[0] * b[1] - a[1] * b[0]
                })
                .sum();
            (twice / 2.0).abs()
        };
        // a diamond of half diagonal 1 around a corner: a quarter of its area 2 is inside
        let diamond = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        assert!((area(&polygon(&diamond, &UNIT)) - 0.5).abs() < 1e-15);
        assert_eq!(
            area(&polygon(&[[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]], &UNIT)),
            1.0
        );
        assert!(polygon(&[[5.0, 5.0], [6.0, 5.0], [6.0, 6.0]], &UNIT).is_empty());
        assert!(polygon(&[[0.0, 0.0], [f64::NAN, 0.0], [1.0, 1.0]], &UNIT).is_empty());
    }
}
