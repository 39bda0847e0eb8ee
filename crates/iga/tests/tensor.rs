//! Regular meshes against tensor products of splines on open knots, by code that shares nothing: Cox and de
//! Boor's recursion, a midpoint rule's worth of Gauss points in closed form, dense matrices. The eigenvalues
//! on a square are the sums of those on an interval.

use crate::common::{of_hnuss, rules, squares};
use eigenring_iga::{Domain, Membrane, Options, Spectrum, Study};
use eigenring_surface::features::edge;
use eigenring_surface::{Mesh, Point3};
use faer::{Mat, Side};

/// The values of all cubic functions on an interval with these breaks, open at its ends, and their
/// derivatives.
fn functions(breaks: &[f64], x: f64) -> [Vec<f64>; 2] {
    let n = breaks.len() - 1;
    let knots: Vec<f64> = (0..n + 7).map(|k| breaks[k.clamp(3, n + 3) - 3]).collect();
    let inside = |k: usize| f64::from(u8::from(knots[k] <= x && x < knots[k + 1]));
    let mut rows = vec![(0..n + 6).map(inside).collect::<Vec<f64>>()];
    let over = |a: f64, b: f64| if b > 0.0 { a / b } else { 0.0 };
    for degree in 1..=3 {
        let last = &rows[degree - 1];
        let next = (0..n + 6 - degree).map(|k| {
            over(x - knots[k], knots[k + degree] - knots[k]) * last[k]
                + over(knots[k + degree + 1] - x, knots[k + degree + 1] - knots[k + 1]) * last[k + 1]
        });
        let next = next.collect();
        rows.push(next);
    }
    let slope = |k: usize| {
        3.0 * (over(rows[2][k], knots[k + 3] - knots[k]) - over(rows[2][k + 1], knots[k + 4] - knots[k + 1]))
    };
    let slopes = (0..n + 3).map(slope).collect();
    [rows.swap_remove(3), slopes]
}

/// The eigenvalues of `-u'' = a u` on an interval in splines, free or held at the ends.
fn interval(breaks: &[f64], held: bool) -> Vec<f64> {
    let n = breaks.len() - 1;
    // four points are exact to degree 7 (Abramowitz and Stegun, table 25.4)
    let gauss = [
        (0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
        (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    ];
    let skipped = usize::from(held);
    let size = n + 3 - 2 * skipped;
    let (mut stiffness, mut mass) = (Mat::<f64>::zeros(size, size), Mat::<f64>::zeros(size, size));
    for cell in breaks.windows(2) {
        let half = 0.5 * (cell[1] - cell[0]);
        for (node, weight) in gauss.into_iter().flat_map(|(x, w)| [(x, w), (-x, w)]) {
            let [values, slopes] = functions(breaks, cell[0] + half * (1.0 + node));
            let weight = half * weight;
            for i in 0..size {
                for j in 0..size {
                    mass[(i, j)] += weight * values[i + skipped] * values[j + skipped];
                    stiffness[(i, j)] += weight * slopes[i + skipped] * slopes[j + skipped];
                }
            }
        }
    }
    let root = mass.self_adjoint_eigen(Side::Lower).expect("eigenvalues");
    let scaled = Mat::from_fn(size, size, |i, j| root.U()[(i, j)] / root.S()[j].sqrt());
    let standard = scaled.transpose() * &stiffness * &scaled;
    let eigen = standard.self_adjoint_eigen(Side::Lower).expect("eigenvalues");
    (0..size).map(|k| eigen.S()[k]).collect()
}

#[test]
fn a_square_has_the_eigenvalues_of_tensor_splines() {
    let rules = rules("catmull-clark");
    let study = Study::new(&squares(3, &[[0.0, 0.0]]), &rules, Domain::Planar).expect("a study");
    for (membrane, held) in [(Membrane::Free, false), (Membrane::Held, true)] {
        let found = study
            .spectrum(1, membrane, 20, &Options::default())
            .expect("a spectrum");
        let line = interval(&(0..=6).map(|k| f64::from(k) / 6.0).collect::<Vec<_>>(), held);
        compare(&found, sums(&line, &line), &format!("{membrane:?}"));
    }
}

fn sums(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut sums: Vec<f64> = a.iter().flat_map(|a| b.iter().map(move |b| a + b)).collect();
    sums.sort_by(f64::total_cmp);
    sums
}

fn compare(found: &Spectrum, expected: Vec<f64>, what: &str) {
    for (value, expected) in found.eigenvalues.iter().zip(expected) {
        let off = (value - expected).abs();
        assert!(off <= 1e-11 * (1.0 + expected), "{what}: {value} for {expected}");
    }
}

/// A rectangle with unequal knot intervals. Points are where splines are linear in the parameter: the means
/// of three knots, mirrored at the ends.
#[test]
fn a_rectangle_with_knot_intervals_has_the_eigenvalues_of_tensor_splines() {
    let breaks: [&[f64]; 2] = [&[0.0, 1.0, 4.0, 4.5, 6.0], &[0.0, 0.7, 1.0, 3.0]];
    let means = |breaks: &[f64]| -> Vec<f64> {
        let last = breaks.len() - 1;
        let inside = breaks.windows(3).map(|w| (w[0] + w[1] + w[2]) / 3.0);
        [breaks[0]].into_iter().chain(inside).chain([breaks[last]]).collect()
    };
    let [x, y] = breaks.map(means);
    let (columns, rows) = (x.len(), y.len());
    let at = |i: usize, j: usize| (j * columns + i) as u32;
    let points = y.iter().flat_map(|&y| x.iter().map(move |&x| Point3::new(x, y, 0.0)));
    let cells = (1..rows).flat_map(|j| (1..columns).map(move |i| (i, j)));
    let faces = cells.flat_map(|(i, j)| [at(i - 1, j - 1), at(i, j - 1), at(i, j), at(i - 1, j)]);
    let mut mesh = Mesh::of_quads(points.collect(), faces.collect());
    let along = (1..columns).map(|i| (edge(at(i - 1, 0), at(i, 0)), breaks[0][i] - breaks[0][i - 1]));
    let across = (1..rows).map(|j| (edge(at(0, j - 1), at(0, j)), breaks[1][j] - breaks[1][j - 1]));
    mesh.features.knots = along.chain(across).collect();
    let study = of_hnuss(&mesh);
    for (membrane, held) in [(Membrane::Free, false), (Membrane::Held, true)] {
        for level in 0..2 {
            let found = study
                .spectrum(level, membrane, 12, &Options::default())
                .expect("a spectrum");
            let lines = breaks.map(|breaks| {
                let middle = breaks.windows(2).map(|w| 0.5 * (w[0] + w[1]));
                let mut all: Vec<f64> = breaks.iter().copied().chain(middle.filter(|_| level == 1)).collect();
                all.sort_by(f64::total_cmp);
                interval(&all, held)
            });
            let [a, b] = lines;
            compare(&found, sums(&a, &b), &format!("{membrane:?}, level {level}"));
        }
    }
}
