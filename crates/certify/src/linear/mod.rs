//! Verified linear algebra: systems, eigenpairs and spectral radii of matrices of intervals.
//!
//! Every function takes approximations that may come from anywhere and returns an enclosure that holds for
//! **every** real matrix inside the given interval matrix, or nothing. An approximation that is bad costs
//! width or success, never truth.
//!
//! * [`solve`]: a system, by the residual iteration of Krawczyk (1969) and Rump (1980) about an approximate
//!   inverse.
//! * [`eigenpair`]: a simple real eigenvalue with its vector, by the operator of Krawczyk on `A x = lambda x,
//!   x_p = 1`.
//! * [`quotient`]: the matrix that is left when a known eigenvector is divided out.
//! * [`pair`]: both eigenvalues of a 2 x 2 matrix in closed form.
//! * [`radius_below`]: a strict bound of all eigenvalues of a matrix, defective or not, by the inequality of
//!   Stein (1952).

mod eigenpair;
mod eliminate;
mod solve;
mod stein;

pub use eigenpair::{Eigenpair, eigenpair, lift, quotient};
pub(crate) use eliminate::eliminate;
pub use solve::solve;
pub use stein::radius_below;

use crate::Interval;
use eigenring_spectral::Matrix;

/// An eigenvalue as an enclosure of its real and its imaginary part. The imaginary part is exactly zero where
/// the value is proven to be real.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eigenvalue {
    /// Real part.
    pub re: Interval,
    /// Imaginary part.
    pub im: Interval,
}

impl Eigenvalue {
    /// A real one.
    pub fn real(value: Interval) -> Self {
        let im = Interval::point(0.0);
        Eigenvalue { re: value, im }
    }

    /// Whether it is proven to be real.
    pub fn is_real(self) -> bool {
        self.im.is_zero()
    }

    /// The modulus.
    pub fn modulus(self) -> Interval {
        if self.is_real() {
            return self.re.abs();
        }
        (self.re.square() + self.im.square()).sqrt()
    }
}

/// Both eigenvalues of a 2 x 2 matrix, with a bound on their kind: from `trace`, `det` and the discriminant
/// `(a - d)^2 + 4 b c`, which does not cancel where the matrix is nearly triangular.
///
/// They are called real, by an imaginary part that is exactly zero, only if the discriminant of every member
/// is not negative. Of real ones the first is the root away from the cancellation, on the side of the middle
/// of the trace: where the sign of the trace is certain it is the larger in modulus. The other is enclosed as
/// the determinant over it as well, so that it is as sharp, relatively, as the determinant. Squares below the
/// range of doubles leave enclosures that are right and wide.
pub fn pair(matrix: &Matrix<Interval>) -> [Eigenvalue; 2] {
    let (a, b, c, d) = (matrix[(0, 0)], matrix[(0, 1)], matrix[(1, 0)], matrix[(1, 1)]);
    let half = Interval::point(0.5);
    let (trace, det) = (a + d, a * d - b * c);
    let discriminant = (a - d).square() + Interval::point(4.0) * b * c;
    roots(trace, det, discriminant, half)
}

/// The roots of `x^2 - trace x + det` with the given enclosure of the discriminant `trace^2 - 4 det`.
pub(crate) fn roots(trace: Interval, det: Interval, discriminant: Interval, half: Interval) -> [Eigenvalue; 2] {
    let middle = half * trace;
    if discriminant.lo() >= 0.0 {
        let root = half * discriminant.sqrt();
        let (upper, lower) = (middle + root, middle - root);
        // the root away from the cancellation, then the other as det over it
        let (large, small) = if trace.mid() >= 0.0 {
            (upper, lower)
        } else {
            (lower, upper)
        };
        let sharp = if large.certainly_nonzero() {
            det / large
        } else {
            Interval::ENTIRE
        };
        let small = small.intersect(sharp).unwrap_or(small);
        return [Eigenvalue::real(large), Eigenvalue::real(small)];
    }
    if discriminant.certainly_negative() {
        let im = half * (-discriminant).sqrt();
        return [im, -im].map(|im| Eigenvalue { re: middle, im });
    }
    // a double value, two real ones or a conjugate pair: all within the root of the discriminant's magnitude
    let reach = half * Interval::point(discriminant.mag()).sqrt();
    let span = (-reach).hull(reach);
    [Eigenvalue {
        re: middle + span,
        im: span,
    }; 2]
}

/// The largest sum of magnitudes of a row, rounded up: no eigenvalue has a larger modulus. One may have just
/// this modulus.
pub(crate) fn norm(matrix: &Matrix<Interval>) -> f64 {
    let sums = (0..matrix.rows()).map(|i| matrix.row(i).iter().map(|&entry| Interval::point(entry.mag())).sum());
    sums.fold(0.0, |max: f64, sum: Interval| max.max(sum.hi()))
}

#[cfg(test)]
mod extremes;
#[cfg(test)]
mod tests;
