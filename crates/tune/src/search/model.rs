//! A quadratic model and its minimum over the domain within a box.
//!
//! The model `q(d) = g.d + d.H d/2` in the step d from a point p need not be convex. Over a polygon its
//! minimum is a stationary point inside (H positive definite), a stationary point of a side, or a corner;
//! they can be enumerated. The domain's sides are curved, so they are followed exactly: a candidate on a
//! boundary curve is placed at an f3, which a model of second order along the curve suggests, and on the
//! curve itself; a candidate corner is where two curves meet. The model is then evaluated at these true
//! points, and the lowest wins. (With the multiplier m of an active curve the bend adds `m bend` to the
//! curvature along it: the Hessian of the Lagrangian, here without a Lagrangian.)

use super::frame::{Arc, Frame};
use eigenring_scheme::lambda::ConstraintCurve;

/// Symmetric second derivatives `[xx, xy, yy]`.
pub(super) type Hessian = [f64; 3];

/// The quadratic model at a point, in units of the domain.
#[derive(Clone, Copy, Debug)]
pub(super) struct Model {
    pub gradient: [f64; 2],
    pub hessian: Hessian,
}

impl Model {
    /// The change of value that the model predicts for a step.
    pub fn change(&self, [x, y]: [f64; 2]) -> f64 {
        let ([gx, gy], [hxx, hxy, hyy]) = (self.gradient, self.hessian);
        x * (gx + 0.5 * hxx * x + hxy * y) + y * (gy + 0.5 * hyy * y)
    }

    /// The Frobenius norm of the Hessian.
    pub fn stiffness(&self) -> f64 {
        let [hxx, hxy, hyy] = self.hessian;
        (hxx * hxx + 2.0 * hxy * hxy + hyy * hyy).sqrt()
    }

    /// The point of the domain with the lowest model value in the box of the given half size around `point`,
    /// the step to it and the predicted change; `None` if no point promises a decrease.
    pub fn minimum(&self, frame: &Frame, point: [f64; 2], radius: f64) -> Option<([f64; 2], [f64; 2], f64)> {
        let mut best = None;
        let mut lowest = 0.0;
        let mut offer = |place: [f64; 2]| {
            let Some(place) = frame.project(place) else { return };
            let step = frame.step(point, place);
            let change = self.change(step);
            // the box only bounds how far the model is trusted; the slack is for rounding
            let inside = step.iter().all(|s| s.abs() <= 1.001 * radius);
            if inside && change < lowest {
                lowest = change;
                best = Some((place, step, change));
            }
        };
        let [low, high] = frame.room(point[1]);
        let rows = [low.max(-radius), high.min(radius)];
        for step in self.box_candidates(rows, radius, frame.is_flat()) {
            offer(frame.moved(point, step));
        }
        let arcs = frame.arcs(point, radius);
        let on_curve = |curve: ConstraintCurve, y: f64| {
            let f3 = (point[1] + y * frame.unit[1]).clamp(frame.f3[0], frame.f3[1]);
            frame.domain.curve(curve, f3).map(|(f2, _)| [f2, f3])
        };
        for (i, arc) in arcs.iter().enumerate() {
            for y in self.arc_candidates(arc, rows, radius) {
                on_curve(arc.curve, y).into_iter().for_each(&mut offer);
            }
            for other in &arcs[i + 1..] {
                let meeting = meeting(frame, [arc, other], point[1], rows);
                meeting
                    .and_then(|y| on_curve(arc.curve, y))
                    .into_iter()
                    .for_each(&mut offer);
            }
        }
        best
    }

    /// The candidates of the model without the domain's curves: the stationary point, the end of the box in
    /// the direction of steepest descent, and on each side of the box its stationary point and ends.
    fn box_candidates(&self, rows: [f64; 2], radius: f64, flat: bool) -> Vec<[f64; 2]> {
        let ([gx, gy], [hxx, hxy, hyy]) = (self.gradient, self.hessian);
        // straight down, where all else is out of the domain
        let down = radius / gx.abs().max(gy.abs());
        let mut steps = vec![[-gx * down, -gy * down]];
        let det = hxx * hyy - hxy * hxy;
        if flat && hxx > 0.0 {
            steps.push([-gx / hxx, 0.0]);
        } else if hxx > 0.0 && det > 0.0 {
            steps.push([(hxy * gy - hyy * gx) / det, (hxy * gx - hxx * gy) / det]);
        }
        for y in rows {
            if hxx > 0.0 {
                steps.push([(-(gx + hxy * y) / hxx).clamp(-radius, radius), y]);
            }
            steps.extend([[-radius, y], [radius, y]]);
        }
        for x in [-radius, radius] {
            if hyy > 0.0 {
                steps.push([x, (-(gy + hxy * x) / hyy).clamp(rows[0], rows[1])]);
            }
        }
        steps
    }

    /// Steps in f3 to try on a boundary curve: the stationary point of the second-order model along it, the
    /// ends of the box. A steep curve (around the hole at N = 3 they become vertical) is followed by x
    /// instead of y.
    fn arc_candidates(&self, arc: &Arc, rows: [f64; 2], radius: f64) -> Vec<f64> {
        let ([gx, gy], [hxx, hxy, hyy]) = (self.gradient, self.hessian);
        let &Arc {
            offset, slope, bend, ..
        } = arc;
        let mut steps = vec![rows[0], rows[1]];
        if slope.abs() <= 1.0 {
            let linear = (gx + hxx * offset) * slope + gy + hxy * offset;
            let square = (gx + hxx * offset) * bend + (hxx * slope + 2.0 * hxy) * slope + hyy;
            if square > 0.0 {
                steps.push((-linear / square).clamp(rows[0], rows[1]));
            }
        } else {
            // y = start + x/slope + turn x^2/2
            let (start, turn) = (-offset / slope, -bend / (slope * slope * slope));
            let linear = gx + hxy * start + (gy + hyy * start) / slope;
            let square = hxx + (2.0 * hxy + hyy / slope) / slope + (gy + hyy * start) * turn;
            let mut xs = vec![-radius, -0.9 * radius, 0.9 * radius, radius];
            if square > 0.0 {
                xs.push((-linear / square).clamp(-radius, radius));
            }
            let ys = xs.into_iter().map(|x| start + x / slope + 0.5 * turn * x * x);
            steps.extend(ys.filter(|&y| rows[0] < y && y < rows[1]));
        }
        steps
    }
}

/// The step in f3 at which two curves meet near a point, by Newton's method on their difference. It is
/// quadratic, as curves meet at an angle; three steps from within a trust region leave rounding only in the
/// last descents, where it matters.
fn meeting(frame: &Frame, [a, b]: [&Arc; 2], f3: f64, rows: [f64; 2]) -> Option<f64> {
    let mut y = -(a.offset - b.offset) / (a.slope - b.slope);
    for _ in 0..3 {
        if !(rows[0] <= y && y <= rows[1]) {
            return None;
        }
        let at = (f3 + y * frame.unit[1]).clamp(frame.f3[0], frame.f3[1]);
        let (value_a, slope_a) = frame.domain.curve(a.curve, at)?;
        let (value_b, slope_b) = frame.domain.curve(b.curve, at)?;
        y -= (value_a - value_b) / (slope_a - slope_b) / frame.unit[1];
    }
    (rows[0] <= y && y <= rows[1]).then_some(y)
}
