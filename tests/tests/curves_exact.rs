//! **Claim**: curves of order k contain the functions of their space exactly; surfaces of revolution have
//! exact circles. **Oracles**: the functions themselves, on limits and on deeply refined points; implicit
//! equations; the closed forms of regular polygons; the printed control points of Fang, Ma and Wang, Fig. 1.

use eigenring_spline::Error;
use eigenring_spline::curve::{Axis, Curve, Ends, Function, Grid, Space};
use eigenring_tests::Comparison;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4, PI};

fn constant(a: f64) -> Function {
    polynomial(&[a])
}

fn polynomial(coefficients: &[f64]) -> Function {
    Function {
        polynomial: coefficients.to_vec(),
        ..Function::default()
    }
}

fn cosine(cosine: f64) -> Function {
    Function {
        cosine,
        ..Function::default()
    }
}

fn sine(sine: f64) -> Function {
    Function {
        sine,
        ..Function::default()
    }
}

/// Limit radius of the square of circumradius sqrt 2 with tension cos(pi/4), and of a regular n-gon.
#[test]
fn regular_polygons_become_circles() {
    // five units of the last place: those of the quadrature's weights and of the sum
    let mut comparison = Comparison::new("radii of circles", 1.2e-15);
    let polygon = |order, n: usize, radius: f64| {
        let corner = |i: usize| {
            let angle = 2.0 * PI * (i as f64 + 0.5) / n as f64;
            [radius * angle.cos(), radius * angle.sin()]
        };
        let points: Vec<[f64; 2]> = (0..n).map(corner).collect();
        let u0 = (PI / n as f64).cos();
        let curve = Curve::new(order, u0, Ends::Closed, &points).unwrap();
        curve
            .sample(7)
            .unwrap()
            .into_iter()
            .map(|(_, p)| p[0].hypot(p[1]))
            .collect::<Vec<f64>>()
    };
    for radius in polygon(3, 4, 2.0_f64.sqrt()) {
        comparison.check("square of circumradius sqrt 2", radius, 1.0);
    }
    for n in 3..40 {
        for radius in polygon(3, n, 1.0) {
            comparison.check(format!("{n}-gon"), radius, (PI / n as f64).cos());
        }
    }
    comparison.finish();

    let mut comparison = Comparison::new("radii for orders 4 to 6, 5 digits", 5e-6);
    for (order, expected) in [(4, 0.90032), (5, 0.81057), (6, 0.72977)] {
        for radius in polygon(order, 4, 2.0_f64.sqrt()) {
            comparison.check(format!("order {order}"), radius, expected);
        }
    }
    comparison.finish();
}

/// Checks the limits of a curve against its functions. The basis damps an oscillation, for high orders and
/// `u0 < 0` by many powers of ten, so that control points are as much larger and carry rounding errors of
/// their own size: 1e-14 of it.
fn check(comparison: &mut Comparison, label: &str, order: usize, u0: f64, count: usize, functions: &[Function]) {
    let space = Space::new(order, u0).unwrap();
    let curve = Curve::reproduce(order, u0, Ends::Open, count, functions).unwrap();
    let size = curve.points().flatten().fold(0.0_f64, |size, x| size.max(x.abs()));
    for (t, point) in curve.sample(5).unwrap() {
        for (x, f) in point.iter().zip(functions) {
            let expected = space.value(f, t);
            let scale = expected.abs().max(1.0).max(size / 100.0);
            comparison.check(
                format!("{label}, order {order}, u0 = {u0}, t = {t}"),
                x / scale,
                expected / scale,
            );
        }
    }
}

#[test]
fn every_function_of_every_order() {
    let mut comparison = Comparison::new("reproduction", 1e-12);
    for order in 3..=22 {
        for u0 in [
            -0.6,
            -0.05,
            0.05,
            0.5,
            FRAC_1_SQRT_2,
            0.999,
            1.0 - 1e-10,
            1.0 + 1e-10,
            1.001,
            2.0,
            10.0,
        ] {
            let count = order + 3;
            let parts = [cosine(1.0), sine(1.0)];
            check(&mut comparison, "oscillation", order, u0, count, &parts);
            let degree = Space::new(order, u0).unwrap().degree();
            assert_eq!(degree, order - 3);
            for power in 0..=degree {
                // around the middle and to scale, so that powers stay of the size of 1
                let power_function = centred_power(power, count as f64 / 2.0, 2.0 / count as f64);
                check(
                    &mut comparison,
                    &format!("power {power}"),
                    order,
                    u0,
                    count,
                    &[power_function],
                );
            }
        }
        // at u = 1 two more
        for power in 0..order {
            let power_function = centred_power(power, (order + 3) as f64 / 2.0, 2.0 / (order + 3) as f64);
            check(
                &mut comparison,
                &format!("power {power}"),
                order,
                1.0,
                order + 3,
                &[power_function],
            );
        }
    }
    comparison.finish();
}

/// `((t - centre) scale)^power`.
fn centred_power(power: usize, centre: f64, scale: f64) -> Function {
    let mut polynomial = vec![0.0; power + 1];
    polynomial[power] = scale.powi(power as i32);
    Function {
        origin: centre,
        polynomial,
        ..Function::default()
    }
}

/// Powers beyond k-3 are not in the space, and the limit of their samples is another function.
#[test]
fn one_power_more_is_refused() {
    for order in 3..=10 {
        for u0 in [-0.5, 0.0, 0.5, 2.0] {
            let space = Space::new(order, u0).unwrap();
            let mut coefficients = vec![0.0; order - 2];
            coefficients.push(1.0);
            let refused = space.control(&polynomial(&coefficients));
            assert!(matches!(refused, Err(Error::NotReproduced { .. })), "order {order}");
        }
        assert!(
            Space::new(order, 1.0)
                .unwrap()
                .control(&polynomial(&vec![1.0; order]))
                .is_ok()
        );
        assert!(
            Space::new(order, 1.0)
                .unwrap()
                .control(&polynomial(&vec![1.0; order + 1]))
                .is_err()
        );
        assert!(Space::new(order, 1.0).unwrap().control(&cosine(1.0)).is_err());
        // at u = 0 cosine and sine have points of alternating signs, which cannot be told apart
        assert!(Space::new(order, 0.0).unwrap().control(&sine(1.0)).is_err());
    }
    let cosines = [cosine(1.0), sine(1.0)];
    let closed = |u0: f64, count| Curve::reproduce(4, u0, Ends::Closed, count, &cosines);
    assert!(closed((PI / 7.0).cos(), 7).is_ok() && closed((2.0 * PI / 7.0).cos(), 7).is_ok());
    assert!(matches!(closed((PI / 7.0).cos(), 6), Err(Error::NotReproduced { .. })));
    assert!(matches!(closed(1.5, 6), Err(Error::NotReproduced { .. })));
    assert!(matches!(
        Curve::reproduce(4, 0.5, Ends::Open, 6, &[polynomial(&[f64::NAN])]),
        Err(Error::NotReproduced { .. })
    ));
    assert!(matches!(
        Curve::reproduce(4, 0.5, Ends::Open, 6, &[]),
        Err(Error::Dimension { .. })
    ));
    // the straight line is not periodic
    let line = [polynomial(&[0.0, 1.0])];
    assert!(matches!(
        Curve::reproduce(4, 0.5, Ends::Closed, 6, &line),
        Err(Error::NotReproduced { .. })
    ));
}

#[test]
fn conics_and_lines() {
    let mut comparison = Comparison::new("implicit equations", 1e-12);
    for order in 3..=12 {
        // an ellipse with semi-axes 3 and 2 around (1, -1), closed with n points
        for n in [3, 5, 8, 13] {
            let with = |mut f: Function, a| {
                f.polynomial = vec![a];
                f
            };
            let functions = [with(cosine(3.0), 1.0), with(sine(2.0), -1.0)];
            let ellipse = Curve::reproduce(order, (PI / n as f64).cos(), Ends::Closed, n, &functions).unwrap();
            for (t, p) in ellipse.sample(6).unwrap() {
                let (x, y) = ((p[0] - 1.0) / 3.0, (p[1] + 1.0) / 2.0);
                comparison.check(format!("ellipse, order {order}, n = {n}, t = {t}"), x.hypot(y), 1.0);
            }
            let deep = ellipse.refine_levels(10).unwrap();
            for p in deep.points() {
                let radius = ((p[0] - 1.0) / 3.0).hypot((p[1] + 1.0) / 2.0);
                assert!((radius - 1.0).abs() < 1e-5 * order as f64, "order {order}: {radius}");
            }
        }
        // a branch of x^2 - y^2 = 1
        let hyperbola = Curve::reproduce(order, 1.1, Ends::Open, order + 2, &[cosine(1.0), sine(1.0)]).unwrap();
        for (t, p) in hyperbola.sample(6).unwrap() {
            let value = (p[0] - p[1]) * (p[0] + p[1]);
            comparison.check(
                format!("hyperbola, order {order}, t = {t}"),
                value / p[0].powi(2),
                1.0 / p[0].powi(2),
            );
        }
        // points on a line in equal steps: their limit moves along it evenly from order 4 on
        let functions = [polynomial(&[1.0, 2.0]), polynomial(&[0.0, -1.0])];
        if order > 3 {
            let line = Curve::reproduce(order, 0.3, Ends::Open, order + 2, &functions).unwrap();
            for (t, p) in line.sample(6).unwrap() {
                comparison.check(format!("line, order {order}, t = {t}"), p[0], 1.0 + 2.0 * t);
                comparison.check(format!("line, order {order}, t = {t}"), p[1], -t);
            }
            // an even spiral staircase: a helix
            let helix = [cosine(1.0), sine(1.0), polynomial(&[0.0, 0.25])];
            let helix = Curve::reproduce(order, 0.9, Ends::Open, order + 9, &helix).unwrap();
            let w = Space::new(order, 0.9).unwrap().frequency();
            for (t, p) in helix.sample(3).unwrap() {
                comparison.check(format!("helix, order {order}, t = {t}"), p[0], (w * 4.0 * p[2]).cos());
            }
        }
    }
    comparison.finish();
}

/// Fang, Ma and Wang, Fig. 1: order 5, v0 = cos(pi/4); the printed control points.
const FIG_1: [[f64; 8]; 3] = [
    [6.002, 4.320, 2.638, 5.891, 9.143, 7.461, 5.779, 9.032],
    [4.768, 3.086, 3.871, 7.124, 7.910, 6.228, 7.013, 10.266],
    [21.756, 29.495, 33.534, 43.740, 60.116, 72.790, 81.763, 96.904],
];

/// Least squares by the normal equations of an orthogonalised basis (Gram-Schmidt, twice): coefficients.
fn least_squares(columns: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let n = columns.len();
    let mut q: Vec<Vec<f64>> = Vec::new();
    let mut r = vec![vec![0.0; n]; n];
    for (j, column) in columns.iter().enumerate() {
        let mut v = column.clone();
        for _ in 0..2 {
            for (i, unit) in q.iter().enumerate() {
                let along = dot(unit, &v);
                r[i][j] += along;
                v.iter_mut().zip(unit).for_each(|(v, u)| *v -= along * u);
            }
        }
        r[j][j] = dot(&v, &v).sqrt();
        q.push(v.iter().map(|x| x / r[j][j]).collect());
    }
    let mut x = vec![0.0; n];
    for j in (0..n).rev() {
        let known: f64 = (j + 1..n).map(|k| r[j][k] * x[k]).sum();
        x[j] = (dot(&q[j], right) - known) / r[j][j];
    }
    x
}

/// A curve's parameter as a function of T, and back: `T = start + pi/4 (t - 2)`, as the domain of 8 points of
/// order 5 is from 2 to 6. The functions `1, T, T^2, cos 2T, sin 2T`, of which the last are those of v0 =
/// cos(pi/4).
fn fig_1_functions(start: f64) -> [Function; 5] {
    let h = FRAC_PI_4;
    // T = 0
    let origin = 2.0 - start / h;
    let from_origin = |f: Function| Function { origin, ..f };
    [
        constant(1.0),
        polynomial(&[0.0, h]),
        polynomial(&[0.0, 0.0, h * h]),
        cosine(1.0),
        sine(1.0),
    ]
    .map(from_origin)
}

/// Coefficients of the printed points over those functions, and the largest residual.
fn fig_1_fit(start: f64) -> (Vec<Vec<f64>>, f64) {
    let columns: Vec<Vec<f64>> = fig_1_functions(start)
        .into_iter()
        .map(|f| {
            let curve = Curve::reproduce(5, FRAC_PI_4.cos(), Ends::Open, 8, &[f]).unwrap();
            curve.points().map(|p| p[0]).collect()
        })
        .collect();
    let mut residual = 0.0_f64;
    let mut fits = Vec::new();
    for printed in FIG_1 {
        let fit = least_squares(&columns, &printed);
        for (i, value) in printed.iter().enumerate() {
            let fitted: f64 = fit.iter().zip(&columns).map(|(a, column)| a * column[i]).sum();
            residual = residual.max((fitted - value).abs());
        }
        fits.push(fit);
    }
    (fits, residual)
}

/// The printed equation is `(t + t2, t + sin 2t, 2t + cos 2t + 2 t^2)` on `[pi/4, pi]` in the text that is
/// available. The printed points are those of another curve of the same span, with the parameter T from 3
/// pi/2 to 5 pi/2.
#[test]
fn printed_points_of_figure_1() {
    let start = 1.5 * PI;
    let curve = |coefficients: &[[f64; 5]; 3]| {
        let space = fig_1_functions(start);
        let sum = |row: &[f64; 5]| {
            row.iter().zip(&space).fold(polynomial(&[0.0; 3]), |mut sum, (a, f)| {
                f.polynomial
                    .iter()
                    .enumerate()
                    .for_each(|(i, c)| sum.polynomial[i] += a * c);
                sum.cosine += a * f.cosine;
                sum.sine += a * f.sine;
                sum.origin = f.origin;
                sum
            })
        };
        let functions = coefficients.each_ref().map(sum);
        Curve::reproduce(5, FRAC_PI_4.cos(), Ends::Open, 8, &functions).unwrap()
    };
    // 1, T, T^2, cos 2T, sin 2T
    let clean = [
        [0.0, 1.0, 0.0, 1.0, 1.0],
        [0.0, 1.0, 0.0, 1.0, 0.0],
        [0.0, 2.0, 1.0, 0.0, 2.0],
    ];
    let exact = curve(&clean);
    let mut largest = 0.0_f64;
    for (i, point) in exact.points().enumerate() {
        for (printed, x) in FIG_1.iter().zip(point) {
            largest = largest.max((printed[i] - x).abs());
        }
    }
    // half a unit of the last printed digit is 5e-4
    assert!((5.1e-4..5.2e-4).contains(&largest), "{largest}");
    for (t, point) in exact.sample(4).unwrap() {
        let t = start + FRAC_PI_4 * (t - 2.0);
        let expected = [
            t + (2.0 * t).cos() + (2.0 * t).sin(),
            t + (2.0 * t).cos(),
            2.0 * t + t * t + 2.0 * (2.0 * t).sin(),
        ];
        assert!(
            point.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12),
            "T = {t}"
        );
    }
    // least squares without knowledge of that curve
    let (fits, residual) = fig_1_fit(start);
    let (_, elsewhere) = fig_1_fit(FRAC_PI_4);
    // the span is invariant under shifts
    assert!((residual - elsewhere).abs() < 1e-10);
    assert!((4.4e-4..4.5e-4).contains(&residual), "{residual}");
    for (fit, clean) in fits.iter().zip(clean) {
        assert!(fit.iter().zip(clean).all(|(a, b)| (a - b).abs() < 2.1e-3), "{fit:?}");
    }
    // the printed equation is far from the curve of the printed points
    let equation = |t: f64| [t + (2.0 * t).sin(), 2.0 * t + (2.0 * t).cos() + 2.0 * t * t];
    let printed: Vec<[f64; 3]> = (0..8).map(|i| [FIG_1[0][i], FIG_1[1][i], FIG_1[2][i]]).collect();
    let printed = Curve::new(5, FRAC_PI_4.cos(), Ends::Open, &printed).unwrap();
    let mut off = [0.0_f64; 2];
    for (t, point) in printed.sample(4).unwrap() {
        let expected = equation(FRAC_PI_4 + FRAC_PI_4 * (t - 2.0));
        for i in 0..2 {
            off[i] = off[i].max((point[i + 1] - expected[i]).abs());
        }
    }
    assert!(off[0] > 5.9 && off[1] > 39.0, "{off:?}");
}

fn revolved(functions: &[Function; 3], order: usize, u0: f64, ends: Ends, count: usize) -> Vec<Grid> {
    let generatrix = Curve::reproduce(order, u0, ends, count, functions).unwrap();
    let ways = [(3, 4), (3, 3), (3, 7), (4, 4), (5, 5), (8, 6)];
    ways.map(|(order, segments)| Grid::revolution(&generatrix, order, segments).unwrap())
        .to_vec()
}

/// All samples of all grids.
fn points(grids: &[Grid]) -> Vec<Vec<f64>> {
    grids
        .iter()
        .flat_map(|grid| grid.sample(4).unwrap().into_iter().flatten())
        .collect()
}

#[test]
fn surfaces_of_revolution() {
    let mut comparison = Comparison::new("implicit equations of surfaces of revolution", 1e-12);
    // a torus: closed generatrix of 5 points, radii 3 and 1
    let torus = [
        Function {
            polynomial: vec![3.0],
            ..cosine(1.0)
        },
        constant(0.0),
        sine(1.0),
    ];
    let grids = revolved(&torus, 4, (PI / 5.0).cos(), Ends::Closed, 5);
    for p in points(&grids) {
        comparison.check("torus", (p[0].hypot(p[1]) - 3.0).hypot(p[2]), 1.0);
    }
    // the parameters are angles, and refined points tend to the surface
    for grid in &grids {
        let point = grid.limit(1.25, 0.5).unwrap();
        let (a, b) = (2.0 * PI * 1.25 / 5.0, 2.0 * PI * 0.5 / grid.v().count() as f64);
        let expected = [(3.0 + a.cos()) * b.cos(), (3.0 + a.cos()) * b.sin(), a.sin()];
        for (x, expected) in point.iter().zip(expected) {
            comparison.check("torus by angles", *x, expected);
        }
        let fine = grid.refine_levels(5).unwrap();
        for p in fine.points() {
            let radius = (p[0].hypot(p[1]) - 3.0).hypot(p[2]);
            assert!((radius - 1.0).abs() < 2e-2, "{radius}");
        }
        for (a, b) in fine.limit(1.3, 0.7).unwrap().iter().zip(grid.limit(1.3, 0.7).unwrap()) {
            comparison.check("torus, limit of a refined grid", *a, b);
        }
    }
    // a sphere of radius 2: half a circle in 4 intervals of w = pi/4, which start at the south pole
    let (order, count) = (4, 7);
    let axis = Axis::new(order, 0.5, Ends::Open, count).unwrap();
    let equator = (axis.domain().0 + axis.domain().1) / 2.0;
    let around = |f: Function| Function { origin: equator, ..f };
    let sphere = [around(cosine(2.0)), constant(0.0), around(sine(2.0))];
    let grids = revolved(&sphere, order, (FRAC_PI_4 / 2.0).cos(), Ends::Open, count);
    let all = points(&grids);
    for p in &all {
        comparison.check("sphere", p[0].hypot(p[1]).hypot(p[2]), 2.0);
    }
    let poles = all.iter().filter(|p| (p[2].abs() - 2.0).abs() < 1e-12).count();
    assert!(poles >= 2 * grids.len(), "{poles} samples at the poles");
    // a cone and a hyperboloid of one sheet
    let cone = [polynomial(&[0.5, 1.0]), constant(0.0), polynomial(&[1.0, 2.0])];
    for p in points(&revolved(&cone, 5, 0.7, Ends::Open, 7)) {
        comparison.check("cone", 2.0 * p[0].hypot(p[1]), p[2]);
    }
    let hyperboloid = [cosine(1.0), constant(0.0), sine(1.0)];
    for p in points(&revolved(&hyperboloid, 3, 1.05, Ends::Open, 6)) {
        comparison.check("hyperboloid", p[0] * p[0] + p[1] * p[1] - p[2] * p[2], 1.0);
    }
    comparison.finish();
}

/// Clamped curves of every order: the limit by the open-knot basis of Piegl and Tiller, and one level by
/// de Casteljau where there is one interval.
#[test]
fn clamped_curves_are_nurbs_curves_with_equal_weights() {
    let mut limits = Comparison::new("clamped limits", 1e-14);
    let mut halves = Comparison::new("halves of Bezier curves", 1e-14);
    for order in 2..=32_usize {
        for intervals in [1_usize, 2, 7] {
            let count = intervals + order - 1;
            let points: Vec<[f64; 1]> = (0..count).map(|i| [((i * i + 3 * i) as f64).sin()]).collect();
            let curve = Curve::new(order, 1.0, Ends::Clamped, &points).unwrap();
            assert_eq!(curve.axis().domain(), (0.0, intervals as f64));
            let inner = (1..intervals).map(|t| t as f64);
            let ends = |t: f64| std::iter::repeat_n(t, order);
            let values = ends(0.0).chain(inner).chain(ends(intervals as f64)).collect();
            let knots = eigenring_spline::Knots::new(order - 1, values).unwrap();
            let refined = curve.refine_levels(3).unwrap();
            for j in 0..=16 * intervals {
                let t = j as f64 / 16.0;
                let basis = knots.basis(knots.span(t).unwrap(), t);
                let terms = basis.values.iter().enumerate();
                let expected: f64 = terms.map(|(i, value)| value * points[basis.first + i][0]).sum();
                limits.check(format!("order {order}, t = {t}"), curve.limit(t).unwrap()[0], expected);
                let from_level_3 = refined.limit(t).unwrap()[0];
                limits.check(format!("order {order}, t = {t}, level 3"), from_level_3, expected);
            }
            let sampled = curve.sample(4).unwrap();
            assert_eq!(sampled.len(), 4 * intervals + 1);
            let (first, last) = (&sampled[0].1, &sampled[4 * intervals].1);
            assert_eq!((first[0], last[0]), (points[0][0], points[count - 1][0]));
            if intervals == 1 {
                let mut row: Vec<f64> = points.iter().map(|p| p[0]).collect();
                let (mut left, mut right) = (vec![row[0]], vec![row[order - 1]]);
                while row.len() > 1 {
                    row = row.windows(2).map(|pair| (pair[0] + pair[1]) / 2.0).collect();
                    left.push(row[0]);
                    right.push(row[row.len() - 1]);
                }
                // the middle knot is simple: of the two halves only the ends of the sequence are k-fold
                let fine = curve.refine().unwrap();
                let fine: Vec<f64> = fine.points().map(|p| p[0]).collect();
                assert_eq!(fine.len(), order + 1);
                halves.check(format!("order {order}, first"), fine[0], left[0]);
                halves.check(format!("order {order}, second"), fine[1], left[1]);
                halves.check(format!("order {order}, last"), fine[order], right[0]);
            }
        }
    }
    limits.finish();
    halves.finish();
}
