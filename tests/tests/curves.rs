//! **Claim**: curves and grids of any order and tension converge to generalised B-splines, which are
//! evaluated at any parameter. **Oracles**: Lane and Riesenfeld's algorithm and de Boor's for tension 1; the
//! basis as differences of truncated functions with 220 digits (`data/generalised_basis.json`); the integral
//! recurrence from order to order; 34 levels of refinement; the family's own rule around a vertex or face of
//! valence 4.

use eigenring_scheme::families::{MAX_ORDER, tension};
use eigenring_scheme::{Numbering, PointNet, Site, refine};
use eigenring_spline::curve::{Axis, Curve, Ends, Grid, rules};
use eigenring_tests::Comparison;
use serde::Deserialize;
use std::collections::HashMap;

/// Points without a pattern, each coordinate in [-1, 1].
fn scattered(count: usize) -> Vec<[f64; 2]> {
    let at = |i: usize, a: f64| (a * (i * i + 3 * i + 1) as f64).sin();
    (0..count).map(|i| [at(i, 0.71), at(i, 1.93)]).collect()
}

/// Doubling and k-1 averages, each one point less at an open end. A row of points may be of any width.
fn lane_riesenfeld(order: usize, points: &[Vec<f64>], closed: bool) -> Vec<Vec<f64>> {
    let mut points: Vec<Vec<f64>> = points.iter().flat_map(|p| [p.clone(), p.clone()]).collect();
    for _ in 1..order {
        let mean = |a: &Vec<f64>, b: &Vec<f64>| a.iter().zip(b).map(|(a, b)| (a + b) / 2.0).collect();
        let mut next: Vec<Vec<f64>> = points.windows(2).map(|pair| mean(&pair[0], &pair[1])).collect();
        if closed {
            next.push(mean(&points[points.len() - 1], &points[0]));
        }
        points = next;
    }
    points
}

/// The same points counted as ours are: k-1 averages, each of a point and the next, move on by (k-1)/2
/// points.
fn turned(order: usize, mut points: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let count = points.len();
    points.rotate_right((order - 1) / 2 % count);
    points
}

fn rows(points: &[[f64; 2]]) -> Vec<Vec<f64>> {
    points.iter().map(|p| p.to_vec()).collect()
}

#[test]
fn tension_one_is_lane_riesenfeld() {
    let mut comparison = Comparison::new("u = 1 against Lane and Riesenfeld", 1e-13);
    for order in 3..=22 {
        for ends in [Ends::Open, Ends::Closed] {
            let points = scattered(order + 3);
            let ours = Curve::new(order, 1.0, ends, &points).unwrap().refine().unwrap();
            let mut expected = lane_riesenfeld(order, &rows(&points), ends == Ends::Closed);
            if ends == Ends::Closed {
                expected = turned(order, expected);
            }
            assert_eq!(ours.points().len(), expected.len(), "order {order}, {ends:?}");
            for (i, (point, expected)) in ours.points().zip(&expected).enumerate() {
                comparison.check(format!("order {order}, {ends:?}, point {i}"), point[0], expected[0]);
                comparison.check(format!("order {order}, {ends:?}, point {i}"), point[1], expected[1]);
            }
        }
    }
    comparison.finish();
}

#[test]
fn grids_of_tension_one_are_lane_riesenfeld_twice() {
    let mut comparison = Comparison::new("grids at u = 1 against Lane and Riesenfeld", 1e-13);
    for (k_u, k_v) in (3..=22).map(|k| (k, 25 - k)).chain((3..=22).map(|k| (k, k))) {
        let (rows, columns) = (k_u + 1, k_v + 2);
        let points: Vec<[f64; 2]> = scattered(rows * columns);
        let axis = |order, count| Axis::new(order, 1.0, Ends::Open, count).unwrap();
        let ours = Grid::new(axis(k_u, rows), axis(k_v, columns), &points)
            .unwrap()
            .refine()
            .unwrap();
        // rows first: each point of a line is a whole row
        let lines: Vec<Vec<f64>> = points
            .chunks(columns)
            .map(|row| row.iter().flatten().copied().collect())
            .collect();
        let expected = lane_riesenfeld(k_u, &lines, false).into_iter().flat_map(|line| {
            let row: Vec<Vec<f64>> = line.chunks(2).map(<[f64]>::to_vec).collect();
            lane_riesenfeld(k_v, &row, false)
        });
        let expected: Vec<Vec<f64>> = expected.collect();
        assert_eq!(ours.points().len(), expected.len());
        for (point, expected) in ours.points().zip(&expected) {
            comparison.check(format!("orders {k_u} x {k_v}"), point[0], expected[0]);
            comparison.check(format!("orders {k_u} x {k_v}"), point[1], expected[1]);
        }
    }
    comparison.finish();
}

/// Where a site of a fan of four sectors lies in the plane, in half steps.
fn in_plane(site: Site) -> (i64, i64) {
    let (x, y) = (i64::from(site.x), i64::from(site.y));
    match site.sector {
        0 => (x, y),
        1 => (-y, x),
        2 => (-x, -y),
        _ => (y, -x),
    }
}

#[test]
fn the_family_at_valence_four_is_the_grid() {
    let mut comparison = Comparison::new("families::tension at valence 4 against the grid", 1e-13);
    for order in 3..=22 {
        for u0 in [-0.4, 0.01, 0.5, 1.0, 2.0, 50.0] {
            let scheme = tension::<f64>(4, order, u0).unwrap();
            let numbering: Numbering = scheme.numbering(scheme.closed_rings().unwrap() + 1);
            // a square of 2R+1 (even orders) or 2R+2 points; its middle lies `middle` half steps from the
            // first
            let side = 2 * numbering.rings + 2 - usize::from(order % 2 == 0);
            let middle = side as i64 - 1;
            let grid_points = scattered(side * side);
            let index = |site: Site| {
                let (x, y) = in_plane(site);
                (((x + middle) / 2) * side as i64 + (y + middle) / 2) as usize
            };
            let points = numbering
                .sites()
                .into_iter()
                .map(|site| grid_points[index(site)])
                .collect();
            let net = PointNet { numbering, points };
            let axis = Axis::new(order, u0, Ends::Open, side).unwrap();
            let fine = Grid::new(axis.clone(), axis, &grid_points).unwrap().refine().unwrap();
            // every refined point of the grid, and where it lies around the middle
            let centre = (side as f64 - 1.0) / 2.0 + if order % 2 == 0 { 0.0 } else { 0.5 };
            let half_steps = |i: usize| (4.0 * (fine.u().parameter(i) - centre)).round() as i64;
            let sites = scheme.numbering(2 * numbering.rings + 2).sites();
            let count = fine.u().count();
            let places = (0..count * count).map(|index| (half_steps(index / count), half_steps(index % count)));
            let by_place: HashMap<(i64, i64), Site> = sites.into_iter().map(|site| (in_plane(site), site)).collect();
            let sites: Vec<Site> = places.map(|place| by_place[&place]).collect();
            assert!(sites.len() >= 16);
            let local = refine(scheme.level(0), &net, &sites).unwrap();
            for ((site, point), local) in sites.iter().zip(fine.points()).zip(&local) {
                for (a, b) in point.iter().zip(local) {
                    comparison.check(format_args!("order {order}, u0 = {u0}, {site:?}"), *a, *b);
                }
            }
        }
    }
    comparison.finish();
}

/// De Boor's algorithm on uniform knots: the point at parameter t of an open polygon whose knots are as
/// documented.
fn de_boor(order: usize, points: &[[f64; 2]], t: f64) -> [f64; 2] {
    let degree = order - 1;
    // point i has support from i + shift to i + shift + order
    let shift = 0.5 * (order % 2) as f64 - order as f64 / 2.0;
    let last = points.len() - 1;
    let span = ((t - shift).floor() as usize).clamp(degree, last);
    let mut d: Vec<[f64; 2]> = points[span - degree..=span].to_vec();
    for r in 1..=degree {
        for j in (r..=degree).rev() {
            let left = (span - degree + j) as f64 + shift;
            let alpha = (t - left) / (order - r) as f64;
            d[j] = std::array::from_fn(|c| (1.0 - alpha) * d[j - 1][c] + alpha * d[j][c]);
        }
    }
    d[degree]
}

#[test]
fn tension_one_is_de_boor() {
    let mut comparison = Comparison::new("limits at u = 1 against de Boor", 1e-13);
    for order in 3..=32 {
        let points = scattered(order + 3);
        let curve = Curve::new(order, 1.0, Ends::Open, &points).unwrap();
        for (t, point) in curve.sample(5).unwrap() {
            let expected = de_boor(order, &points, t);
            for c in 0..2 {
                comparison.check(format!("order {order}, t = {t}"), point[c], expected[c]);
                comparison.check(
                    format!("order {order}, t = {t}"),
                    curve.limit(t).unwrap()[c],
                    expected[c],
                );
            }
        }
    }
    comparison.finish();
}

/// B_k(x) as the limit of a single 1 among zeros.
fn function(order: usize, u0: f64, x: f64) -> f64 {
    let half = order / 2 + 1;
    let mut points = vec![[0.0]; 2 * half + order];
    let middle = half + order / 2;
    points[middle] = [1.0];
    let curve = Curve::new(order, u0, Ends::Open, &points).unwrap();
    curve.limit(curve.axis().parameter(middle) + x).unwrap()[0]
}

#[derive(Deserialize)]
struct Value {
    order: usize,
    u: f64,
    x: f64,
    value: f64,
}

#[test]
fn the_basis_to_many_digits() {
    let values: Vec<Value> = serde_json::from_str(include_str!("../data/generalised_basis.json")).unwrap();
    let mut comparison = Comparison::new("the basis against 220-digit differences, relative", 2e-13);
    for Value { order, u, x, value } in values {
        for x in [x, -x] {
            // relative, except where functions that are not positive cancel
            let scale = value.abs().max(if u < 0.0 { 1.0 } else { 1e-300 });
            comparison.check(
                format!("B_{order}({x}) at u = {u}"),
                function(order, u, x) / scale,
                value / scale,
            );
        }
    }
    assert_eq!(comparison.count(), 576);
    comparison.finish();
}

#[test]
fn orders_follow_by_averaging_over_a_step() {
    // B_{k+1}(x) = integral of B_k over [x - 1/2, x + 1/2], by Simpson's rule with Richardson's two
    // corrections
    let mut comparison = Comparison::new("integral recurrence", 1e-10);
    for order in [4, 5, 7] {
        for u0 in [-0.5, 0.3, 1.0, 3.0] {
            for x in [0.1_f64, 0.6, 1.3] {
                let trapezoid = |from: f64, to: f64, parts: usize| {
                    let h = (to - from) / parts as f64;
                    let inner: f64 = (1..parts).map(|i| function(order, u0, from + i as f64 * h)).sum();
                    h * (inner + (function(order, u0, from) + function(order, u0, to)) / 2.0)
                };
                let romberg = |from: f64, to: f64| {
                    let mut table: Vec<f64> = (0..7).map(|i| trapezoid(from, to, 1 << i)).collect();
                    for step in 1..table.len() {
                        let power = 4.0_f64.powi(step as i32);
                        table = table
                            .windows(2)
                            .map(|w| (power * w[1] - w[0]) / (power - 1.0))
                            .collect();
                    }
                    table[0]
                };
                // a knot of order k lies in between
                let offset = if order % 2 == 0 { 0.0 } else { 0.5 };
                let knot = (x + 0.5 - offset).floor() + offset;
                let integral = romberg(x - 0.5, knot) + romberg(knot, x + 0.5);
                comparison.check(
                    format!("B_{}({x}) at u = {u0}", order + 1),
                    function(order + 1, u0, x),
                    integral,
                );
            }
        }
    }
    comparison.finish();
}

/// Refines only what matters near t, until the tension is 1 to rounding; then the polynomial limit mask at
/// the nearest point.
fn deep_limit(order: usize, u0: f64, points: &[[f64; 2]], mut t: f64, levels: usize) -> [f64; 2] {
    let (mut window, mut u) = (points.to_vec(), u0);
    for _ in 0..levels {
        let fine = Curve::new(order, u, Ends::Open, &window).unwrap().refine().unwrap();
        // the k points of the interval that t lies in; a new polygon counts its parameters from its own first
        // point
        let (start, _) = fine.axis().domain();
        let interval = (2.0 * (t - start)).floor().min(fine.axis().intervals() as f64 - 1.0);
        let first = interval as usize;
        window = fine.points().skip(first).take(order).map(|p| [p[0], p[1]]).collect();
        let own = (order as f64 - 1.0) / 2.0;
        t = 2.0 * (t - start) - interval + own.floor();
        u = fine.axis().tension().value();
    }
    de_boor(order, &window, t)
}

#[test]
fn limits_are_where_refinement_goes() {
    let mut comparison = Comparison::new("limits against 34 levels", 1e-12);
    for order in [3, 4, 5, 6, 9, 14, 22, 32] {
        let points = scattered(order + 2);
        for u0 in [-0.8, -0.1, 0.0, 0.01, 0.5, 0.999, 1.0, 2.0, 50.0, 1e5] {
            let curve = Curve::new(order, u0, Ends::Open, &points).unwrap();
            let (lower, upper) = curve.axis().domain();
            for part in [0.0, 0.03, 0.31, 0.5, 0.77, 1.0] {
                let t = lower + part * (upper - lower);
                let (point, deep) = (curve.limit(t).unwrap(), deep_limit(order, u0, &points, t, 34));
                for c in 0..2 {
                    comparison.check(format!("order {order}, u0 = {u0}, t = {t}"), point[c], deep[c]);
                }
            }
        }
    }
    comparison.finish();
}

#[test]
fn every_level_has_the_same_limit() {
    let mut comparison = Comparison::new("limits of refined polygons", 1e-12);
    for order in [3, 4, 7, 12, 21] {
        for u0 in [-0.5, 0.2, 1.0, 1.5, 100.0] {
            for ends in [Ends::Open, Ends::Closed] {
                let curve = Curve::new(order, u0, ends, &scattered(order + 1)).unwrap();
                let fine = curve.refine_levels(3).unwrap();
                let (lower, upper) = curve.axis().domain();
                for i in 0..=20 {
                    let t = lower + f64::from(i) / 20.0 * (upper - lower);
                    let (a, b) = (curve.limit(t).unwrap(), fine.limit(t).unwrap());
                    comparison.check(format!("order {order}, u0 = {u0}, {ends:?}, t = {t}"), a[0], b[0]);
                    comparison.check(format!("order {order}, u0 = {u0}, {ends:?}, t = {t}"), a[1], b[1]);
                }
            }
        }
    }
    comparison.finish();
}

/// Curves state their rules by the numbers of points, the family by places in half steps: they are the same.
#[test]
fn rules_are_the_regular_ones_of_the_family() {
    for order in 3..=MAX_ORDER {
        for u in [-0.5, 0.3, 1.0, 2.0] {
            let scheme = tension::<f64>(4, order, u).unwrap();
            let passes = scheme.level(0).passes();
            let rules = rules(order, u);
            assert_eq!(passes.len(), rules.len());
            for (pass, rule) in passes.iter().zip(&rules) {
                let line = pass.line().expect("one line for all spokes");
                let scale = line.scale();
                let expected: Vec<Vec<(i64, f64)>> = (0..scale)
                    .map(|class| {
                        let taps = line.taps(2 * class + pass.to().parity());
                        let number = |source: i32| i64::from((source - pass.from().parity()) / 2);
                        taps.map(|(source, weight)| (number(source), weight)).collect()
                    })
                    .collect();
                assert_eq!(rule.classes(), expected, "order {order}, u = {u}");
            }
        }
    }
}
