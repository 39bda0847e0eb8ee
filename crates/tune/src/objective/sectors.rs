//! Sums over the sectors: the inner loops of the whole computation.
//!
//! The Gauss curvature and the squared error of a saddle are trigonometric polynomials in the class `t =
//! exp(4 i phi)` of a sector (see `saddle`). The weight of every point and class takes two square roots and
//! one division; the rest are sums.

use super::fields::{Turn, Turns};
use super::lanes::{Lanes, WIDTH};
use super::weight::Weight;
use eigenring_spline::Complex;

const ZERO: Complex<Lanes> = Complex {
    re: Lanes::ZERO,
    im: Lanes::ZERO,
};

/// Sums over the sector classes of w, w t, w t^2 (`w0`, `w1`, `w2`) and, with u = q dw/dk, of u and u t
/// (`v0`, `v1`).
pub(super) struct Sums {
    pub w0: Lanes,
    pub w1: Complex<Lanes>,
    pub w2: Complex<Lanes>,
    pub v0: Lanes,
    pub v1: Complex<Lanes>,
}

impl Sums {
    const ZERO: Sums = Sums {
        w0: Lanes::ZERO,
        w1: ZERO,
        w2: ZERO,
        v0: Lanes::ZERO,
        v1: ZERO,
    };

    /// With all weights 1.
    pub fn unweighted(turns: &Turns) -> Sums {
        let sum = |of: fn(&Turn) -> f64| {
            let sum = |turns: &[Turn]| turns.iter().map(of).sum::<f64>();
            // conjugate classes cancel in the imaginary part
            Complex::new(Lanes::splat(sum(&turns.real) + 2.0 * sum(&turns.pairs)), Lanes::ZERO)
        };
        Sums {
            w0: Lanes::splat(turns.count() as f64),
            w1: sum(|turn| turn.t.re),
            w2: sum(|turn| turn.square.re),
            ..Sums::ZERO
        }
    }

    /// A pair of conjugate classes shares the even and odd halves of all polynomials and sums.
    #[inline(always)]
    pub fn weighted<const GRADIENT: bool>(
        turns: &Turns,
        weights: Weights,
        q0: Lanes,
        q1: Complex<Lanes>,
        q2: Complex<Lanes>,
    ) -> Sums {
        let mut sums = Sums::ZERO;
        let (w_pairs, w_real) = weights.w.split_at(2 * turns.pairs.len());
        for (Turn { t, square }, w) in turns.pairs.iter().zip(w_pairs.as_chunks::<2>().0) {
            let (even, odd) = (Lanes(w[0]) + Lanes(w[1]), Lanes(w[0]) - Lanes(w[1]));
            sums.w0 += even;
            sums.w1.re += even * t.re;
            sums.w1.im += odd * t.im;
            sums.w2.re += even * square.re;
            sums.w2.im += odd * square.im;
        }
        for (Turn { t, square }, &w) in turns.real.iter().zip(w_real) {
            sums.w0 += Lanes(w);
            sums.w1.re += Lanes(w) * t.re;
            sums.w2.re += Lanes(w) * square.re;
        }
        if GRADIENT {
            let even_q = |turn: &Turn| q0 + q1.re * turn.t.re + q2.re * turn.square.re;
            let (slope_pairs, slope_real) = weights.slope.split_at(2 * turns.pairs.len());
            for (turn, slope) in turns.pairs.iter().zip(slope_pairs.as_chunks::<2>().0) {
                let (even, odd) = (even_q(turn), q1.im * turn.t.im + q2.im * turn.square.im);
                let (u, u_conj) = (Lanes(slope[0]) * (even - odd), Lanes(slope[1]) * (even + odd));
                let (even, odd) = (u + u_conj, u - u_conj);
                sums.v0 += even;
                sums.v1.re += even * turn.t.re;
                sums.v1.im += odd * turn.t.im;
            }
            for (turn, &slope) in turns.real.iter().zip(slope_real) {
                let u = Lanes(slope) * even_q(turn);
                sums.v0 += u;
                sums.v1.re += u * turn.t.re;
            }
        }
        sums
    }
}

/// w and dw/dk of one saddle at a block of points: of each pair of classes first t, then its conjugate; then
/// the real ones.
#[derive(Clone, Copy)]
pub(super) struct Weights<'a> {
    w: &'a [[f64; WIDTH]],
    slope: &'a [[f64; WIDTH]],
}

/// The weights of a few blocks, computed in one go: a loop over plain numbers, long enough to keep the
/// divider busy.
pub(super) struct WeightTable<'a> {
    turns: &'a Turns,
    k: Vec<[f64; WIDTH]>,
    w: Vec<[f64; WIDTH]>,
    slope: Vec<[f64; WIDTH]>,
}

impl<'a> WeightTable<'a> {
    /// Room for the given number of (block, saddle) pairs.
    pub fn new(turns: &'a Turns, slots: usize) -> WeightTable<'a> {
        let blank = vec![[0.0; WIDTH]; slots * turns.count()];
        WeightTable {
            turns,
            k: blank.clone(),
            w: blank.clone(),
            slope: blank,
        }
    }

    /// Writes the relative Gauss curvature `k0 + Re(t k1)` of a saddle in all classes.
    #[inline(always)]
    pub fn put(&mut self, slot: usize, (k0, k1): (Lanes, Complex<Lanes>)) {
        let count = self.turns.count();
        let (pairs, real) = self.k[slot * count..][..count].split_at_mut(2 * self.turns.pairs.len());
        for (Turn { t, .. }, k) in self.turns.pairs.iter().zip(pairs.as_chunks_mut::<2>().0) {
            let (even, odd) = (k0 + k1.re * t.re, k1.im * t.im);
            *k = [(even - odd).0, (even + odd).0];
        }
        for (Turn { t, .. }, k) in self.turns.real.iter().zip(real) {
            *k = (k0 + k1.re * t.re).0;
        }
    }

    /// Two square roots and one division per point and class: the floor of the whole computation.
    #[inline(always)]
    pub fn fill(&mut self, weight: &Weight) {
        weight.fill(
            self.k.as_flattened(),
            self.w.as_flattened_mut(),
            self.slope.as_flattened_mut(),
        );
    }

    /// The weights of a slot.
    #[inline(always)]
    pub fn get(&self, slot: usize) -> Weights<'_> {
        let count = self.turns.count();
        Weights {
            w: &self.w[slot * count..][..count],
            slope: &self.slope[slot * count..][..count],
        }
    }
}
