use super::*;
use num_bigint::BigInt;
use num_rational::BigRational;
use proptest::prelude::*;

fn rational(value: f64) -> BigRational {
    BigRational::from_float(value).expect("finite")
}

fn contains(interval: Interval, value: &BigRational) -> bool {
    rational(interval.lo()) <= *value && *value <= rational(interval.hi())
}

/// Integer fractions `entries / 64`, exact in doubles.
fn matrix(size: usize, entries: &[i32]) -> Matrix<f64> {
    Matrix::from_fn(size, size, |i, j| f64::from(entries[size * i + j]) / 64.0)
}

/// The solution by exact elimination; `None` for a singular matrix.
fn exact_solution(matrix: &Matrix<f64>, right: &[f64]) -> Option<Vec<BigRational>> {
    let size = matrix.rows();
    let mut rows: Vec<Vec<BigRational>> = (0..size)
        .map(|i| matrix.row(i).iter().chain([&right[i]]).map(|&x| rational(x)).collect())
        .collect();
    let zero = BigRational::from(BigInt::from(0));
    for k in 0..size {
        let pivot = (k..size).find(|&i| rows[i][k] != zero)?;
        rows.swap(k, pivot);
        let pivot_row = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            if i != k {
                let factor = row[k].clone() / pivot_row[k].clone();
                for (entry, pivot) in row.iter_mut().zip(&pivot_row) {
                    *entry -= factor.clone() * pivot;
                }
            }
        }
    }
    Some((0..size).map(|i| rows[i][size].clone() / rows[i][i].clone()).collect())
}

proptest! {
    #[test]
    fn enclosed_solutions_contain_the_exact_one(
        entries in proptest::collection::vec(-64..64_i32, 16),
        right in proptest::collection::vec(-64..64_i32, 4),
    ) {
        let matrix = matrix(4, &entries);
        let right: Vec<f64> = right.iter().map(|&x| f64::from(x)).collect();
        let enclosed = solve(&matrix.map(Interval::point), &right.iter().map(|&x| Interval::point(x)).collect::<Vec<_>>());
        match exact_solution(&matrix, &right) {
            // a singular matrix is never proven regular
            None => prop_assert!(enclosed.is_none()),
            Some(exact) => {
                for (interval, value) in enclosed.into_iter().flatten().zip(&exact) {
                    prop_assert!(contains(interval, value));
                    prop_assert!(interval.width() <= 1e-9 * (1.0 + interval.mag()));
                }
            }
        }
    }

    // S = T D T^-1 with a unimodular integer T: the eigenvalues D / 64 are exact
    #[test]
    fn planted_eigenvalues_are_enclosed(
        values in proptest::collection::vec(-60..60_i32, 4),
        below in proptest::collection::vec(-2..3_i32, 6),
        wrong in -1e-6..1e-6_f64,
    ) {
        let size = 4;
        let mut t = vec![vec![0_i64; size]; size];
        let mut next = below.iter();
        for (i, row) in t.iter_mut().enumerate() {
            row[i] = 1;
            for entry in row.iter_mut().take(i) {
                *entry = i64::from(*next.next().unwrap());
            }
        }
        // the inverse of a unit triangular matrix by forward substitution
        let mut inverse: Vec<Vec<i64>> = Vec::new();
        for (i, row) in t.iter().enumerate() {
            let entry = |j: usize| i64::from(i == j) - (0..i).map(|k| row[k] * inverse[k][j]).sum::<i64>();
            let next = (0..size).map(entry).collect();
            inverse.push(next);
        }
        let s = Matrix::from_fn(size, size, |i, j| {
            (0..size).map(|k| t[i][k] * i64::from(values[k]) * inverse[k][j]).sum::<i64>() as f64 / 64.0
        });
        let s = s.map(Interval::point);
        let distinct = (0..size).all(|i| (0..i).all(|j| values[i] != values[j]));
        for k in 0..size {
            let vector: Vec<f64> = (0..size).map(|i| t[i][k] as f64 + wrong).collect();
            let value = f64::from(values[k]) / 64.0;
            let Some(found) = eigenpair(&s, value + wrong, &vector) else {
                prop_assert!(!distinct, "a simple eigenvalue is proven");
                continue;
            };
            prop_assert!(found.value.contains(value) && found.value.width() < 1e-12);
            for (i, x) in found.vector.iter().enumerate() {
                let exact = BigRational::new(t[i][k].into(), t[found.pivot][k].into());
                prop_assert!(contains(*x, &exact));
            }
            // what remains has the other eigenvalues, with the vectors below
            let rest = quotient(&s, &found.vector, found.pivot);
            let other = (k + 1) % size;
            let image: Vec<f64> = (0..size)
                .filter(|&i| i != found.pivot)
                .map(|i| t[i][other] as f64 - t[i][k] as f64 / t[found.pivot][k] as f64 * t[found.pivot][other] as f64)
                .collect();
            let value = f64::from(values[other]) / 64.0;
            if let Some(pair) = eigenpair(&rest, value, &image) {
                prop_assert!(pair.value.contains(value));
                if let Some(lifted) = lift(&s, &found, pair.value, &pair.vector) {
                    for i in 0..size {
                        let image: Interval = s.row(i).iter().zip(&lifted).map(|(&a, &x)| a * x).sum();
                        prop_assert!(!image.disjoint(pair.value * lifted[i]));
                    }
                }
            }
        }
    }

    #[test]
    fn both_values_of_a_pair_are_enclosed(a in -64..64_i32, b in -64..64_i32, p in -3..4_i64, q in -3..4_i64) {
        // T = [[1, p], [q, 1 + p q]] has determinant 1
        let (d, e) = (i64::from(a), i64::from(b));
        let t = [[1, p], [q, 1 + p * q]];
        let u = [[1 + p * q, -p], [-q, 1]];
        let s = Matrix::from_fn(2, 2, |i, j| {
            Interval::point((t[i][0] * d * u[0][j] + t[i][1] * e * u[1][j]) as f64 / 64.0)
        });
        let found = pair(&s);
        prop_assert!(d == e || found.iter().all(|value| value.is_real()));
        for value in [a, b] {
            prop_assert!(found.iter().any(|found| found.re.contains(f64::from(value) / 64.0)));
        }
    }
}

#[test]
fn conjugate_pairs_and_jordan_blocks_are_enclosed() {
    let turn = Matrix::from_fn(2, 2, |i, j| Interval::point([[0.25, -0.5], [0.5, 0.25]][i][j]));
    let [first, second] = pair(&turn);
    assert!(first.re.contains(0.25) && first.im.contains(0.5) && second.im.contains(-0.5));
    assert!(first.modulus().contains(0.3125_f64.sqrt()));
    let jordan = Matrix::from_fn(2, 2, |i, j| Interval::point([[1.5, 1.0], [-1.0, -0.5]][i][j]));
    for value in pair(&jordan) {
        assert!(value.re.contains(0.5) && value.im.contains_zero());
    }
    // no eigenpair of a defective value is claimed
    assert!(eigenpair(&jordan, 0.5, &[1.0, -1.0]).is_none());
    assert!(eigenpair(&jordan, f64::NAN, &[1.0, -1.0]).is_none());
}

#[test]
fn radii_are_bounded_by_any_good_factor_and_no_other() {
    // a Jordan block of size 3 at 1/2: diag(1, s, s^2) makes its norm 1/2 + s
    let jordan = Matrix::from_fn(3, 3, |i, j| {
        Interval::point(if i == j { 0.5 } else { f64::from(j == i + 1) })
    });
    let factor = |s: f64| Matrix::from_fn(3, 3, |i, j| if i == j { s.powi(i as i32) } else { 0.0 });
    assert!(radius_below(&jordan, &factor(10.0), 0.7));
    assert!(!radius_below(&jordan, &factor(1.0), 0.7));
    for s in [0.1, 1.0, 3.0, 10.0, 1e3] {
        assert!(
            !radius_below(&jordan, &factor(s), 0.5),
            "never at the eigenvalue itself"
        );
    }
    assert!(!radius_below(&jordan, &factor(f64::NAN), 0.7));
}
