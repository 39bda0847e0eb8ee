//! Eigenvalues that are hard to tell: nearly and exactly defective matrices at all scales, against exact
//! integers.
//!
//! Claims: an enclosure that is returned holds for every member of the matrix, what is called real is real,
//! what is called simple is simple, and no bound of the moduli is met. Oracle: matrices made from known
//! eigenvalues by integer similarities, and the exact signs of polynomials, in integers with the unit
//! `2^-1074` of doubles.

use super::*;
use crate::interval::oracle::{Operands, UNIT, between, units};
use num_bigint::BigInt;

/// `2^k` for `-1074 <= k < 1024`.
fn power(k: i32) -> f64 {
    2f64.powi(k.max(-1000)) * 2f64.powi(k.min(-1000) + 1000)
}

/// Whether `x <= sqrt(d)`.
fn at_most_root(x: &BigInt, d: &BigInt) -> bool {
    *x <= BigInt::from(0) || x * x <= *d
}

/// Whether `x >= sqrt(d)`.
fn at_least_root(x: &BigInt, d: &BigInt) -> bool {
    *x >= BigInt::from(0) && x * x >= *d
}

/// Whether `(t + s sqrt(d)) / 2` is in an interval, for s = 1 or -1.
fn holds_root(interval: Interval, t: &BigInt, d: &BigInt, positive: bool) -> bool {
    // 2 lo - t <= s sqrt(d) <= 2 hi - t
    let end = |bound: f64| bound.is_finite().then(|| units(bound) * 2 - t);
    let (low, high) = (end(interval.lo()), end(interval.hi()));
    if positive {
        low.is_none_or(|low| at_most_root(&low, d)) && high.is_none_or(|high| at_least_root(&high, d))
    } else {
        low.is_none_or(|low| at_least_root(&-low, d)) && high.is_none_or(|high| at_most_root(&-high, d))
    }
}

/// What is wrong with the enclosed eigenvalues of a matrix, for one member.
fn fault(found: &[Eigenvalue; 2], [a, b, c, d]: [f64; 4]) -> Option<&'static str> {
    let [a, b, c, d] = [a, b, c, d].map(units);
    let trace = &a + &d;
    let discriminant = (&a - &d) * (&a - &d) + b * c * 4;
    let zero = BigInt::from(0);
    let either = |holds: &dyn Fn(&Eigenvalue, bool) -> bool| {
        let [first, second] = found;
        holds(first, true) && holds(second, false) || holds(first, false) && holds(second, true)
    };
    if discriminant >= zero {
        if found.iter().any(|value| value.im.certainly_nonzero()) {
            return Some("real values are called complex");
        }
        let real = |value: &Eigenvalue, positive| {
            value.im.contains_zero() && holds_root(value.re, &trace, &discriminant, positive)
        };
        return (!either(&real)).then_some("a real value is not enclosed");
    }
    if found.iter().any(|value| value.is_real()) {
        return Some("a conjugate pair is called real");
    }
    let opposite = -discriminant;
    let complex = |value: &Eigenvalue, positive| {
        holds_root(value.re, &trace, &zero, true) && holds_root(value.im, &zero, &opposite, positive)
    };
    (!either(&complex)).then_some("a conjugate pair is not enclosed")
}

#[test]
fn pairs_are_enclosed_at_all_scales() {
    let mut operands = Operands::new(11);
    let (mut real, mut complex, mut open) = (0, 0, 0);
    for round in 0..30_000 {
        let mut entries = [0; 4].map(|_| match round % 3 {
            0 => operands.double(),
            _ => operands.fraction() * operands.sign(),
        });
        if round % 3 == 2 {
            // a discriminant that vanishes as far as doubles allow, or exactly
            let [a, b, _, d] = &mut entries;
            if round % 2 == 0 {
                for x in [&mut *a, &mut *d] {
                    *x = (*x * 64.0).round() / 64.0;
                }
                *b = b.signum() / 4.0;
            }
            let gap = *a - *d;
            entries[2] = -gap * gap / (4.0 * *b);
            if operands.below(4) == 0 {
                entries[2] = entries[2].next_up();
            }
        }
        if round % 3 != 0 {
            // the same matrix at another size: exact, but where it leaves the range of doubles
            let scale = power([-1060, -1000, -540, -500, 0, 0, 500, 1000][operands.below(8)]);
            entries = entries.map(|x| x * scale);
        }
        let radius = [0.0, 0.0, 1e-16, 1e-3][operands.below(4)];
        let matrix = Matrix::from_fn(2, 2, |i, j| {
            let x = entries[2 * i + j];
            Interval::around(x, radius * x.abs())
        });
        let found = pair(&matrix);
        match () {
            () if found[0].is_real() => real += 1,
            () if found[0].im.certainly_nonzero() => complex += 1,
            () => open += 1,
        }
        for corner in 0..4 {
            let member = [0, 1, 2, 3].map(|at| {
                let entry = matrix[(at / 2, at % 2)];
                let inside = match (corner, operands.below(2)) {
                    (0, _) => entries[at],
                    (_, 0) => entry.lo(),
                    _ => entry.hi(),
                };
                if inside.is_finite() { inside } else { entries[at] }
            });
            assert_eq!(fault(&found, member), None, "{member:?} {found:?}");
        }
    }
    // each of the three kinds occurs
    assert!(real > 5000 && complex > 2000 && open > 1000, "{real} {complex} {open}");
}

/// Where the sign of the trace is certain the first value is the larger in modulus, and the other does not
/// lose its digits to it: 1 and 2^-60, of which the difference of middle and root has none.
#[test]
fn both_values_of_a_pair_are_sharp() {
    let tiny = power(-60);
    for (scale, sign) in [-900, -400, 0, 400, 900]
        .map(power)
        .into_iter()
        .flat_map(|s| [(s, 1.0), (s, -1.0)])
    {
        let rows = [[sign, 1.0], [0.0, sign * tiny]];
        let [large, small] = pair(&Matrix::from_fn(2, 2, |i, j| Interval::point(rows[i][j] * scale)));
        assert!(large.re.contains(sign * scale) && small.re.contains(sign * tiny * scale));
        if scale == 1.0 {
            assert!(small.re.width() < 1e-14 * tiny, "{small:?}");
        }
    }
}

/// `T J T^-1 2^k` with an integer T of determinant 1 and J of integer eigenvalues, exact in doubles.
struct Planted {
    t: Vec<Vec<i64>>,
    values: Vec<i64>,
    /// Whether J has a 1 above the diagonal in this column.
    linked: Vec<bool>,
    exponent: i32,
}

impl Planted {
    fn new(operands: &mut Operands, size: usize) -> (Self, Matrix<f64>) {
        let mut small = |_| operands.below(5) as i64 - 2;
        let lower: Vec<Vec<i64>> = (0..size).map(|_| (0..size).map(&mut small).collect()).collect();
        let upper: Vec<Vec<i64>> = (0..size).map(|_| (0..size).map(&mut small).collect()).collect();
        let entry = |triangle: &[Vec<i64>], i: usize, j: usize, low: bool| match i.cmp(&j) {
            std::cmp::Ordering::Equal => 1,
            order => triangle[i][j] * i64::from((order == std::cmp::Ordering::Greater) == low),
        };
        let l = |i, j| entry(&lower, i, j, true);
        let u = |i, j| entry(&upper, i, j, false);
        let t: Vec<Vec<i64>> = (0..size)
            .map(|i| (0..size).map(|j| (0..size).map(|k| l(i, k) * u(k, j)).sum()).collect())
            .collect();
        // values in clusters: equal ones, neighbours, and far ones
        let base = operands.below(1 << 36) as i64 - (1 << 35);
        let mut values = vec![base];
        for _ in 1..size {
            let step = [0, 1, 1 << 10, 1 << 34, 3 << 34][operands.below(5)];
            values.push(values[operands.below(values.len())] + step);
        }
        let linked: Vec<bool> = (0..size)
            .map(|i| i > 0 && values[i] == values[i - 1] && operands.below(2) == 0)
            .collect();
        let exponent = [-1070, -1020, -500, -36, 500, 960][operands.below(6)];
        // S T = T J, row by row: S = T J T^-1 by solving with U and L, both with unit diagonals
        let image: Vec<Vec<i64>> = (0..size)
            .map(|i| {
                let linked = |j: usize| if linked[j] { t[i][j - 1] } else { 0 };
                (0..size).map(|j| t[i][j] * values[j] + linked(j)).collect()
            })
            .collect();
        let rows = image.iter().map(|row| {
            let mut x = row.clone();
            for j in 0..size {
                x[j] -= (0..j).map(|k| x[k] * u(k, j)).sum::<i64>();
            }
            for j in (0..size).rev() {
                x[j] -= (j + 1..size).map(|k| x[k] * l(k, j)).sum::<i64>();
            }
            x.into_iter()
                .map(|x| {
                    assert!(x.abs() < 1 << 53, "exact in a double");
                    x as f64 * power(exponent)
                })
                .collect()
        });
        let matrix = Matrix::from_rows(rows.collect(), size);
        let planted = Planted {
            t,
            values,
            linked,
            exponent,
        };
        (planted, matrix)
    }

    fn size(&self) -> usize {
        self.values.len()
    }

    /// An eigenvalue in units of `2^-1074`.
    fn value(&self, k: usize) -> BigInt {
        BigInt::from(self.values[k]) << (self.exponent + UNIT as i32)
    }

    fn is_simple(&self, k: usize) -> bool {
        (0..self.size()).all(|i| i == k || self.values[i] != self.values[k])
    }

    /// Whether column k of T is an eigenvector and the found pair holds it.
    fn is_in(&self, k: usize, found: &Eigenpair) -> bool {
        let at_pivot = self.t[found.pivot][k];
        !self.linked[k]
            && at_pivot != 0
            && between(found.value, &self.value(k), 0)
            && (0..self.size()).all(|i| holds_fraction(found.vector[i], self.t[i][k], at_pivot))
    }
}

/// Whether `p / q` is in an interval.
fn holds_fraction(interval: Interval, p: i64, q: i64) -> bool {
    let scaled = |bound: f64| units(bound) * q.abs();
    let exact = BigInt::from(p * q.signum()) << UNIT;
    (interval.lo() == f64::NEG_INFINITY || scaled(interval.lo()) <= exact)
        && (interval.hi() == f64::INFINITY || exact <= scaled(interval.hi()))
}

#[test]
fn what_is_called_simple_is_simple_and_the_only_one() {
    let mut operands = Operands::new(12);
    let (mut found_simple, mut refused) = (0, 0);
    for _ in 0..20_000 {
        let size = 2 + operands.below(3);
        let (planted, matrix) = Planted::new(&mut operands, size);
        let matrix = matrix.map(Interval::point);
        for k in 0..size {
            let wrong = [0.0, 1e-15, 1e-10, 1e-6][operands.below(4)];
            let mut off = |x: f64| x * (1.0 + wrong * operands.fraction() * operands.sign());
            let value = off(planted.values[k] as f64) * power(planted.exponent);
            let vector: Vec<f64> = (0..size).map(|i| off(planted.t[i][k] as f64)).collect();
            let Some(found) = eigenpair(&matrix, value, &vector) else {
                refused += 1;
                continue;
            };
            // exactly one pair in the box, and it is a simple one
            let inside: Vec<usize> = (0..size).filter(|&i| planted.is_in(i, &found)).collect();
            let [only] = inside[..] else {
                panic!("{inside:?} of {:?} in {found:?}", planted.values)
            };
            assert!(planted.is_simple(only), "{:?} {found:?}", planted.values);
            found_simple += 1;
            // the quotient holds a_ij - x_i a_pj, times x_p in integers
            let rest = quotient(&matrix, &found.vector, found.pivot);
            let others: Vec<usize> = (0..size).filter(|&i| i != found.pivot).collect();
            let at_pivot = planted.t[found.pivot][only];
            for (i, &row) in others.iter().enumerate() {
                for (j, &column) in others.iter().enumerate() {
                    let a = |i: usize, j: usize| units(matrix[(i, j)].mid());
                    let exact = a(row, column) * at_pivot - a(found.pivot, column) * planted.t[row][only];
                    let scaled = |bound: f64| units(bound) * at_pivot;
                    let (low, high) = (scaled(rest[(i, j)].lo()), scaled(rest[(i, j)].hi()));
                    assert!((low <= exact && exact <= high) || (high <= exact && exact <= low));
                }
            }
            // an eigenvector of the quotient, enclosed, is lifted to one that holds the column it comes from
            for other in (0..size).filter(|&i| i != only && planted.is_simple(i)) {
                let below: Vec<Interval> = others
                    .iter()
                    .map(|&i| {
                        let part = Interval::integer(planted.t[found.pivot][other]) / Interval::integer(at_pivot);
                        Interval::integer(planted.t[i][other]) - part * Interval::integer(planted.t[i][only])
                    })
                    .collect();
                let value = Interval::point(planted.values[other] as f64 * power(planted.exponent));
                if let Some(lifted) = lift(&matrix, &found, value, &below) {
                    for (i, &x) in lifted.iter().enumerate() {
                        assert!(holds_fraction(x, planted.t[i][other], 1), "{lifted:?}");
                    }
                }
            }
        }
    }
    // approximations that are far off, clusters and extreme scales leave fewer than one in five
    assert!(found_simple > 4000 && refused > 4000, "{found_simple} {refused}");
}

#[test]
fn solutions_hold_at_all_scales() {
    let mut operands = Operands::new(13);
    let mut solved = 0;
    for _ in 0..2000 {
        let size = 2 + operands.below(3);
        let (planted, matrix) = Planted::new(&mut operands, size);
        let singular = planted.values.contains(&0);
        // A x = b with an integer x, where b is exact
        let x: Vec<i64> = (0..size).map(|_| operands.below(9) as i64 - 4).collect();
        let right: Vec<BigInt> = (0..size)
            .map(|i| (0..size).map(|j| units(matrix[(i, j)]) * x[j]).sum())
            .collect();
        let doubles: Vec<f64> = (0..size)
            .map(|i| (0..size).map(|j| matrix[(i, j)] * x[j] as f64).sum())
            .collect();
        if doubles.iter().any(|b| !b.is_finite()) || doubles.iter().zip(&right).any(|(&b, exact)| units(b) != *exact) {
            continue;
        }
        let points: Vec<Interval> = doubles.iter().map(|&b| Interval::point(b)).collect();
        let Some(found) = solve(&matrix.map(Interval::point), &points) else {
            continue;
        };
        assert!(!singular);
        solved += 1;
        for (interval, &x) in found.iter().zip(&x) {
            assert!(interval.contains(x as f64), "{found:?} {x}");
        }
    }
    assert!(solved > 500, "{solved}");
}

#[test]
fn arguments_that_do_not_fit_are_refused() {
    let unit = Matrix::from_fn(2, 2, |i, j| Interval::point(f64::from(i == j)));
    let flat = Matrix::from_fn(2, 3, |_, _| Interval::point(1.0));
    assert!(solve(&unit, &[Interval::point(1.0)]).is_none() && solve(&flat, &[Interval::point(1.0); 2]).is_none());
    for vector in [
        &[][..],
        &[1.0],
        &[1.0; 3],
        &[0.0, 0.0],
        &[f64::NAN, 1.0],
        &[f64::INFINITY, 1.0],
    ] {
        assert!(eigenpair(&unit, 1.0, vector).is_none(), "{vector:?}");
    }
    assert!(eigenpair(&flat, 1.0, &[1.0, 1.0]).is_none());
    assert!(!radius_below(&flat, &Matrix::from_fn(2, 2, |_, _| 1.0), 9.0));
    let square = Matrix::from_fn(2, 2, |i, j| Interval::point([[1.0, 0.0], [0.0, 2.0]][i][j]));
    let found = eigenpair(&square, 1.0, &[1.0, 0.0]).expect("simple");
    assert!(lift(&square, &found, Interval::point(2.0), &[]).is_none());
}

/// `|z| < r` is strict: with eigenvalues of modulus exactly r, in Jordan blocks or not, nothing is a proof,
/// at any scale.
#[test]
fn no_factor_shows_a_radius_that_is_reached() {
    let mut operands = Operands::new(14);
    let mut shown = 0;
    for round in 0..4000 {
        let k = [-1060, -530, -300, 0, 0, 300, 500, 1000][operands.below(8)];
        let l = [-1060, -530, -300, 0, 0, 300, 500, 1000][operands.below(8)];
        // modulus 5: a Jordan block of size 2 or 3, a semisimple value, a conjugate pair 3 + 4 i
        let (rows, size): ([[f64; 3]; 3], usize) = match round % 4 {
            0 => ([[5.0, 1.0, 0.0], [0.0, 5.0, 0.0], [0.0; 3]], 2),
            1 => ([[-5.0, 1.0, 0.0], [0.0, -5.0, 1.0], [0.0, 0.0, -5.0]], 3),
            2 => ([[5.0, 0.0, 0.0], [0.0, -5.0, 0.0], [0.0, 0.0, 1.0]], 3),
            _ => ([[3.0, -4.0, 0.0], [4.0, 3.0, 0.0], [0.0, 0.0, 2.0]], 3),
        };
        let matrix = Matrix::from_fn(size, size, |i, j| Interval::point(rows[i][j] * power(k)));
        // diag(1, s, s^2) makes the links as small as is wanted
        let s: f64 = [1.0, 2.0, 1e3, 1e8, 1e20][operands.below(5)];
        let mut factor = Matrix::from_fn(
            size,
            size,
            |i, j| if i == j { s.powi(i as i32) * power(l) } else { 0.0 },
        );
        if operands.below(4) == 0 {
            factor = Matrix::from_fn(size, size, |_, _| operands.double());
        }
        let radius = 5.0 * power(k);
        for reached in [radius, radius.next_down(), radius / 2.0] {
            assert!(
                !radius_below(&matrix, &factor, reached),
                "{rows:?} 2^{k} 2^{l} {factor:?}"
            );
        }
        // one member of an interval matrix is enough
        let wide = matrix.map(|x| {
            if x.is_zero() {
                x
            } else {
                x + Interval::around(0.0, power(k))
            }
        });
        assert!(!radius_below(&wide, &factor, radius), "{rows:?} 2^{k} 2^{l} {factor:?}");
        shown += usize::from(radius_below(&matrix, &factor, radius * 1.001));
    }
    // with a little room there is a proof
    assert!(shown > 200, "{shown}");
}
