//! Eigenvalues in more precision than that of doubles, and how far a number is from being one.
//!
//! A real matrix is brought to Hessenberg form by reflections and iterated on with Francis's double shifts
//! (G. Golub and C. Van Loan, *Matrix Computations*, 7.4 and 7.5; the shifts for cases of slow convergence
//! are those of EISPACK's `hqr`). Both steps are orthogonal, so that the values are those of a matrix within
//! some rounding units of the given one.

use crate::Matrix;
use crate::extended::{Extended, UNIT};
use eigenring_scheme::{Complex, Scalar};
use std::ops::{Add, Div, Mul, Sub};

/// Steps per eigenvalue that are waited for; three are usual, and defective ones take many.
const STEPS: usize = 400;

/// A matrix in Hessenberg form, with the same eigenvalues and singular values of shifts as the one it was
/// made from.
pub(crate) struct Hessenberg {
    entries: Matrix<Extended>,
}

fn zero() -> Extended {
    Extended::default()
}

impl Hessenberg {
    pub fn new(matrix: &Matrix<Extended>) -> Self {
        let n = matrix.rows();
        let mut h = matrix.clone();
        for m in 1..n.saturating_sub(1) {
            // a reflection I - v v^T / half that leaves one entry of column m-1 below the diagonal
            let column: Vec<Extended> = (m..n).map(|i| h[(i, m - 1)]).collect();
            if column[1..].iter().all(|x| x.to_f64() == 0.0) {
                continue;
            }
            let square = column.iter().fold(zero(), |sum, &x| sum + x * x);
            let norm = if column[0].to_f64() > 0.0 {
                -square.sqrt()
            } else {
                square.sqrt()
            };
            let half = square - column[0] * norm;
            let mut v = column;
            v[0] -= norm;
            // from the left, row by row of what is stored by rows
            let mut factors = vec![zero(); n - m];
            for (i, &v) in (m..n).zip(&v) {
                let row = &h.row(i)[m..];
                factors.iter_mut().zip(row).for_each(|(sum, &x)| *sum += v * x);
            }
            factors.iter_mut().for_each(|factor| *factor = *factor / half);
            for (i, &v) in (m..n).zip(&v) {
                let row = &mut h.row_mut(i)[m..];
                row.iter_mut().zip(&factors).for_each(|(x, &factor)| *x -= factor * v);
            }
            // from the right
            for i in 0..n {
                let row = &mut h.row_mut(i)[m..];
                let dot = row.iter().zip(&v).fold(zero(), |sum, (&x, &v)| sum + x * v);
                let factor = dot / half;
                row.iter_mut().zip(&v).for_each(|(x, &v)| *x -= factor * v);
            }
            h[(m, m - 1)] = norm;
            (m + 1..n).for_each(|i| h[(i, m - 1)] = zero());
        }
        Hessenberg { entries: h }
    }

    /// The eigenvalues in no particular order; `None` if the iteration does not converge.
    pub fn eigenvalues(&self) -> Option<Vec<Complex<Extended>>> {
        let mut h = self.entries.clone();
        let n = h.rows();
        let norm = (0..n)
            .flat_map(|i| (i.saturating_sub(1)..n).map(move |j| (i, j)))
            .fold(0.0, |sum, place| sum + h[place].to_f64().abs());
        let size = |x: Extended| x.to_f64().abs();
        let (mut values, mut end, mut steps, mut shifted) = (Vec::with_capacity(n), n, 0, zero());
        while end > 0 {
            let last = end - 1;
            // the part from `first` on has no small entry beside the diagonal
            let mut first = last;
            while first > 0 {
                let around = size(h[(first - 1, first - 1)]) + size(h[(first, first)]);
                let around = if around == 0.0 { norm } else { around };
                if size(h[(first, first - 1)]) < UNIT * around {
                    break;
                }
                first -= 1;
            }
            if first == last {
                values.push(Complex::real(h[(last, last)] + shifted));
                (end, steps) = (last, 0);
                continue;
            }
            let (x, y) = (h[(last, last)], h[(last - 1, last - 1)]);
            let w = h[(last, last - 1)] * h[(last - 1, last)];
            if first + 1 == last {
                let p = (y - x) / Extended::ratio(2, 1);
                let q = p * p + w;
                let (x, root) = (x + shifted, q.abs().sqrt());
                if q.to_f64() >= 0.0 {
                    let z = if p.to_f64() >= 0.0 { p + root } else { p - root };
                    let other = if z.to_f64() == 0.0 { x } else { x - w / z };
                    values.extend([x + z, other].map(Complex::real));
                } else {
                    values.extend([root, -root].map(|im| Complex::new(x + p, im)));
                }
                (end, steps) = (last - 1, 0);
                continue;
            }
            steps += 1;
            if steps > STEPS {
                return None;
            }
            let (mut x, mut y, mut w) = (x, y, w);
            if steps % 10 == 0 {
                // slow: subtract, and take shifts that have nothing to do with the matrix
                shifted += x;
                (0..end).for_each(|i| h[(i, i)] -= x);
                let s = h[(last, last - 1)].abs() + h[(last - 1, last - 2)].abs();
                x = Extended::exact(0.75) * s;
                (y, w) = (x, Extended::exact(-0.4375) * s * s);
            }
            double_shift(&mut h, first, last, [x, y, w]);
        }
        values
            .iter()
            .all(|v| v.re.to_f64().is_finite() && v.im.to_f64().is_finite())
            .then_some(values)
    }

    /// The largest absolute row sum.
    pub fn norm(&self) -> f64 {
        let rows = (0..self.entries.rows()).map(|i| self.entries.row(i));
        rows.map(|row| row.iter().map(|x| x.to_f64().abs()).sum())
            .fold(0.0, f64::max)
    }

    /// About the smallest singular value of the matrix less `value`, never below it.
    pub fn distance(&self, value: Complex<Extended>) -> f64 {
        if value.im.to_f64() == 0.0 {
            smallest(&self.entries, value.re)
        } else {
            smallest(&self.entries.map(Complex::real), value)
        }
    }
}

/// A step of Francis's iteration on the rows and columns from `first` to `last`.
fn double_shift(h: &mut Matrix<Extended>, first: usize, last: usize, [x, y, w]: [Extended; 3]) {
    let size = |x: Extended| x.to_f64().abs();
    // where two small entries in a row let the step begin
    let mut m = last - 2;
    let start = loop {
        let z = h[(m, m)];
        let (r, s) = (x - z, y - z);
        let p = (r * s - w) / h[(m + 1, m)] + h[(m, m + 1)];
        let q = h[(m + 1, m + 1)] - z - r - s;
        let r = h[(m + 2, m + 1)];
        let scale = p.abs() + q.abs() + r.abs();
        let start = [p / scale, q / scale, r / scale];
        if m == first {
            break start;
        }
        let around = size(h[(m - 1, m - 1)]) + size(z) + size(h[(m + 1, m + 1)]);
        if size(h[(m, m - 1)]) * (size(start[1]) + size(start[2])) < UNIT * size(start[0]) * around {
            break start;
        }
        m -= 1;
    };
    for i in m + 2..=last {
        h[(i, i - 2)] = zero();
        if i > m + 2 {
            h[(i, i - 3)] = zero();
        }
    }
    let [mut p, mut q, mut r] = start;
    for k in m..last {
        let three = k + 1 != last;
        let mut x = zero();
        if k != m {
            (p, q) = (h[(k, k - 1)], h[(k + 1, k - 1)]);
            r = if three { h[(k + 2, k - 1)] } else { zero() };
            x = p.abs() + q.abs() + r.abs();
            if x.to_f64() == 0.0 {
                continue;
            }
            (p, q, r) = (p / x, q / x, r / x);
        }
        let root = (p * p + q * q + r * r).sqrt();
        let s = if p.to_f64() < 0.0 { -root } else { root };
        if s.to_f64() == 0.0 {
            continue;
        }
        if k != m {
            h[(k, k - 1)] = -s * x;
        } else if first != m {
            h[(k, k - 1)] = -h[(k, k - 1)];
        }
        p += s;
        let (x, y, z) = (p / s, q / s, r / s);
        (q, r) = (q / p, r / p);
        let (above, below) = h.row_and_rest(k);
        if three {
            // the third row follows
            let (middle, third) = below.split_at_mut(above.len());
            for ((a, b), c) in above[k..=last]
                .iter_mut()
                .zip(&mut middle[k..=last])
                .zip(&mut third[k..=last])
            {
                let p = *a + q * *b + r * *c;
                *a -= p * x;
                *b -= p * y;
                *c -= p * z;
            }
        } else {
            for (a, b) in above[k..=last].iter_mut().zip(&mut below[k..=last]) {
                let p = *a + q * *b;
                *a -= p * x;
                *b -= p * y;
            }
        }
        for i in first..=last.min(k + 3) {
            match &mut h.row_mut(i)[k..] {
                [a, b, c, ..] if three => {
                    let p = x * *a + y * *b + z * *c;
                    *a -= p;
                    *b -= p * q;
                    *c -= p * r;
                }
                [a, b, ..] => {
                    let p = x * *a + y * *b;
                    *a -= p;
                    *b -= p * q;
                }
                _ => {}
            }
        }
    }
}

/// What systems of equations are solved in.
pub(crate) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    fn size(self) -> f64;
    fn real(value: f64) -> Self;
}

impl Number for Extended {
    fn size(self) -> f64 {
        self.to_f64().abs()
    }
    fn real(value: f64) -> Self {
        Extended::exact(value)
    }
}

impl Number for Complex<Extended> {
    fn size(self) -> f64 {
        self.map(Extended::to_f64).modulus()
    }
    fn real(value: f64) -> Self {
        Complex::real(Extended::exact(value))
    }
}

/// The growth of a vector under the inverse of `H - value` and of its transpose in turn, which converges to
/// the largest singular value of the inverse from below.
fn smallest<T: Number>(h: &Matrix<T>, value: T) -> f64 {
    let n = h.rows();
    let mut upper = Matrix::from_fn(n, n, |i, j| if i == j { h[(i, j)] - value } else { h[(i, j)] });
    let scale = upper.entries().iter().fold(0.0_f64, |max, x| max.max(x.size()));
    if scale == 0.0 {
        return 0.0;
    }
    // elimination with row exchanges; a pivot that vanishes is taken as one far below rounding
    let tiny = T::real(scale * UNIT * UNIT);
    let mut steps = Vec::with_capacity(n);
    for k in 0..n {
        let mut exchanged = false;
        let mut factor = T::real(0.0);
        if k + 1 < n {
            exchanged = upper[(k + 1, k)].size() > upper[(k, k)].size();
            if exchanged {
                let (above, below) = upper.row_and_rest(k);
                above[k..].swap_with_slice(&mut below[k..n]);
            }
        }
        if upper[(k, k)].size() == 0.0 {
            upper[(k, k)] = tiny;
        }
        if k + 1 < n && upper[(k + 1, k)].size() != 0.0 {
            factor = upper[(k + 1, k)] / upper[(k, k)];
            let (above, below) = upper.row_and_rest(k);
            below[k..n]
                .iter_mut()
                .zip(&above[k..])
                .for_each(|(x, &above)| *x = *x - factor * above);
        }
        steps.push((exchanged, factor));
    }
    // a start without structure; growths are compared after each pair of solutions
    let mut x: Vec<T> = (0..n)
        .map(|i| T::real(1.0 + ((7 * i + 3) % 11) as f64 / 11.0))
        .collect();
    let normalise = |x: &mut Vec<T>| {
        let norm = x.iter().map(|x| x.size() * x.size()).sum::<f64>().sqrt();
        let inverse = T::real(1.0 / norm);
        x.iter_mut().for_each(|x| *x = *x * inverse);
        norm
    };
    normalise(&mut x);
    let mut growth = 0.0_f64;
    for _ in 0..2 {
        // forwards through the exchanges, then back substitution
        for (k, &(exchanged, factor)) in steps.iter().enumerate().take(n.saturating_sub(1)) {
            if exchanged {
                x.swap(k, k + 1);
            }
            x[k + 1] = x[k + 1] - factor * x[k];
        }
        for k in (0..n).rev() {
            let row = &upper.row(k)[k + 1..];
            let known = row.iter().zip(&x[k + 1..]).fold(x[k], |sum, (&u, &x)| sum - u * x);
            x[k] = known / upper[(k, k)];
        }
        growth = growth.max(normalise(&mut x));
        // the transposed system: the same steps in reverse
        for k in 0..n {
            let solved = x[k] / upper[(k, k)];
            x[k] = solved;
            let row = &upper.row(k)[k + 1..];
            x[k + 1..].iter_mut().zip(row).for_each(|(x, &u)| *x = *x - u * solved);
        }
        for (k, &(exchanged, factor)) in steps.iter().enumerate().take(n.saturating_sub(1)).rev() {
            x[k] = x[k] - factor * x[k + 1];
            if exchanged {
                x.swap(k, k + 1);
            }
        }
        growth = growth.max(normalise(&mut x));
    }
    if growth.is_finite() { 1.0 / growth } else { 0.0 }
}
