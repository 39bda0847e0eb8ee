//! Regular meshes against tensor products of splines on open knots, by code that shares nothing: Cox and de
//! Boor's recursion, a midpoint rule's worth of Gauss points in closed form, dense matrices. The eigenvalues
//! on a square are the sums of those on an interval.

use crate::common::{rules, squares};
use eigenring_iga::{Domain, Membrane, Options, Study};
use faer::{Mat, Side};

/// The values of all cubic functions on `n` open intervals of the unit interval, and their derivatives.
fn functions(n: usize, x: f64) -> [Vec<f64>; 2] {
    let knots: Vec<f64> = (0..n + 7).map(|k| (k.clamp(3, n + 3) - 3) as f64 / n as f64).collect();
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

/// The eigenvalues of `-u'' = a u` on the unit interval in splines, free or held at the ends.
fn interval(n: usize, held: bool) -> Vec<f64> {
    // four points are exact to degree 7 (Abramowitz and Stegun, table 25.4)
    let gauss = [
        (0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
        (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    ];
    let skipped = usize::from(held);
    let size = n + 3 - 2 * skipped;
    let (mut stiffness, mut mass) = (Mat::<f64>::zeros(size, size), Mat::<f64>::zeros(size, size));
    for cell in 0..n {
        for (node, weight) in gauss.into_iter().flat_map(|(x, w)| [(x, w), (-x, w)]) {
            let [values, slopes] = functions(n, (cell as f64 + 0.5 + 0.5 * node) / n as f64);
            let weight = 0.5 * weight / n as f64;
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
        let line = interval(6, held);
        let mut sums: Vec<f64> = line.iter().flat_map(|a| line.iter().map(move |b| a + b)).collect();
        sums.sort_by(f64::total_cmp);
        for (value, expected) in found.eigenvalues.iter().zip(sums) {
            assert!(
                (value - expected).abs() <= 1e-11 * (1.0 + expected),
                "{membrane:?}: {value} for {expected}"
            );
        }
    }
}
