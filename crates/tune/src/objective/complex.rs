//! Complex numbers over any scalar: the Fourier modes (over `f64`) and the spin components (over lanes).

use eigenring_spline::Scalar;
use std::ops::{Add, Mul, Neg, Sub};

/// `re + i im`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Complex<S> {
    pub re: S,
    pub im: S,
}

impl<S: Scalar + Copy> Complex<S> {
    #[inline(always)]
    pub fn new(re: S, im: S) -> Self {
        Complex { re, im }
    }

    #[inline(always)]
    pub fn zero() -> Self {
        Complex::new(S::zero(), S::zero())
    }

    /// `exp(2 pi i k / n)`.
    pub fn turn(k: i64, n: i64) -> Self {
        Complex::new(S::cos_turn(k, n), S::sin_turn(k, n))
    }

    #[inline(always)]
    pub fn conj(self) -> Self {
        Complex::new(self.re, -self.im)
    }

    #[inline(always)]
    pub fn scale(self, factor: S) -> Self {
        Complex::new(self.re * factor, self.im * factor)
    }

    /// `|z|^2`.
    #[inline(always)]
    pub fn norm_square(self) -> S {
        self.re * self.re + self.im * self.im
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
}

impl<S: Scalar + Copy> Add for Complex<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Complex::new(self.re + other.re, self.im + other.im)
    }
}

impl<S: Scalar + Copy> Sub for Complex<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Complex::new(self.re - other.re, self.im - other.im)
    }
}

impl<S: Scalar + Copy> Neg for Complex<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Complex::new(-self.re, -self.im)
    }
}

impl<S: Scalar + Copy> Mul for Complex<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Complex::new(
            self.re * other.re - self.im * other.im,
            self.re * other.im + self.im * other.re,
        )
    }
}
