//! Complex numbers over any scalar.

use crate::Scalar;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// `re + i im`: values of Fourier modes, eigenvalues, and fields that turn with the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Complex<S> {
    /// The real part.
    pub re: S,
    /// The imaginary part.
    pub im: S,
}

impl<S> Complex<S> {
    /// The number with these parts.
    #[inline(always)]
    pub const fn new(re: S, im: S) -> Self {
        Complex { re, im }
    }

    /// The number with the images of the parts, which is the same number where `f` only changes the type.
    #[inline(always)]
    pub fn map<T>(self, f: impl Fn(S) -> T) -> Complex<T> {
        Complex::new(f(self.re), f(self.im))
    }
}

impl<S: Scalar> Complex<S> {
    /// A real number.
    #[inline(always)]
    pub fn real(re: S) -> Self {
        Complex::new(re, S::zero())
    }

    /// The additive unit.
    #[inline(always)]
    pub fn zero() -> Self {
        Complex::real(S::zero())
    }

    /// The multiplicative unit.
    #[inline(always)]
    pub fn one() -> Self {
        Complex::real(S::one())
    }

    /// `exp(2 pi i k / n)`. `n` must not be zero.
    pub fn turn(k: i64, n: i64) -> Self {
        Complex::new(S::cos_turn(k, n), S::sin_turn(k, n))
    }

    /// The conjugate.
    #[inline(always)]
    pub fn conj(self) -> Self {
        Complex::new(self.re, -self.im)
    }

    /// Times a real number.
    #[inline(always)]
    pub fn scale(self, factor: S) -> Self {
        Complex::new(self.re * factor.clone(), self.im * factor)
    }

    /// `|z|^2`.
    #[inline(always)]
    pub fn norm_square(self) -> S {
        self.re.clone() * self.re + self.im.clone() * self.im
    }

    /// `Re(z w)`.
    #[inline(always)]
    pub fn real_of_product(self, other: Self) -> S {
        self.re * other.re - self.im * other.im
    }

    /// `Re(z conj(w))`: the inner product of the plane.
    #[inline(always)]
    pub fn dot(self, other: Self) -> S {
        self.re * other.re + self.im * other.im
    }

    /// `1/z`.
    pub fn recip(self) -> Self {
        let square = self.clone().norm_square();
        Complex::new(self.re / square.clone(), -self.im / square)
    }
}

impl Complex<f64> {
    /// `|z|`, without overflow of the square.
    pub fn modulus(self) -> f64 {
        self.re.hypot(self.im)
    }
}

impl<S: Scalar> Add for Complex<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Complex::new(self.re + other.re, self.im + other.im)
    }
}

impl<S: Scalar> AddAssign for Complex<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        self.re += other.re;
        self.im += other.im;
    }
}

impl<S: Scalar> Sub for Complex<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Complex::new(self.re - other.re, self.im - other.im)
    }
}

impl<S: Scalar> Neg for Complex<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Complex::new(-self.re, -self.im)
    }
}

impl<S: Scalar> Mul for Complex<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Complex::new(
            self.re.clone() * other.re.clone() - self.im.clone() * other.im.clone(),
            self.re * other.im + self.im * other.re,
        )
    }
}

impl<S: Scalar> Div for Complex<S> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let square = other.clone().norm_square();
        let Complex { re, im } = self * other.conj();
        Complex::new(re / square.clone(), im / square)
    }
}
