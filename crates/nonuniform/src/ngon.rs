//! The extraordinary n-gon of HNUSS (Li, Wei and Zhang 2019) in closed form.
//!
//! Its corners go to `P' = Q_n P` with the rule of [`SplitFace`]. With `A = diag(n alpha_i)` and the
//! projector Pi on the Fourier modes 0 and +-1,
//!
//! ```text
//! Q_n = I/2 + 1 beta^T/2 - A (I - Pi)
//! ```
//!
//! has the eigenvalues 1, 1/2, 1/2 and `1/2 - mu_k`, where mu_k are those of `U^T A U` for an orthonormal
//! basis U of the other modes. So `min n alpha <= mu_k <= max n alpha`, which lies between 0 and 1: Lemma 1.
//! The limit of the corners is `v P` with `v = (I + 2 (I - Pi) A)^-1 beta`, and tangents are
//!
//! ```text
//! sum_i (cos th_i - m)/alpha_i P_i,   m = sum (cos th_i/alpha_i) / sum (1/alpha_i),   th_i = 2 pi i/n
//! ```
//!
//! and the same with sines. Where `d_z+1 = 0`, alpha_z and alpha_(z+1) vanish, and tangents are `P_z -
//! P_(z+1)` and `sum_(j != z, z+1) g_j/alpha_j (P_j - P_z)`, `g_j = cos(th_j - th_z - pi/n) - cos(pi/n)`;
//! where three vanish, the differences of these corners.

use crate::{Error, Spokes};
use eigenring_scheme::Scalar;
use eigenring_scheme::families::SplitFace;
use eigenring_spectral::Matrix;
use nalgebra::{DMatrix, DVector};

/// The rule around one n-gon.
#[derive(Clone, Debug, PartialEq)]
pub struct NGon {
    face: SplitFace<f64>,
}

impl NGon {
    /// The rule for the intervals of the spokes.
    ///
    /// # Errors
    /// Those of [`SplitFace::new`]; [`Error::ZeroSpokes`] where more than three alpha vanish, which leaves no
    /// strict subdominant eigenvalue.
    pub fn new(d: &[f64]) -> Result<Self, Error> {
        let spokes = Spokes::stationary(d.to_vec())?;
        let face = SplitFace::<f64>::new(spokes.intervals())?;
        if face.alpha.iter().filter(|&&alpha| alpha == 0.0).count() > 3 {
            return Err(Error::ZeroSpokes {
                spokes: (0..d.len()).filter(|&i| d[i] == 0.0).collect(),
                valence: d.len(),
                place: None,
            });
        }
        Ok(NGon { face })
    }

    fn valence(&self) -> usize {
        self.face.alpha.len()
    }

    /// n alpha_i.
    pub fn scaled_alpha(&self) -> &[f64] {
        &self.face.alpha
    }

    /// beta_i.
    pub fn beta(&self) -> &[f64] {
        &self.face.beta
    }

    /// The weight of corner j in the new corner i.
    pub fn weight(&self, i: usize, j: usize) -> f64 {
        self.face.weight(i, j)
    }

    /// The matrix Q_n.
    pub fn matrix(&self) -> Matrix<f64> {
        let n = self.valence();
        Matrix::from_fn(n, n, |i, j| self.face.weight(i, j))
    }

    /// mu_k, falling: n-3 numbers between the least and the greatest n alpha.
    pub fn mu(&self) -> Vec<f64> {
        let n = self.valence();
        if n == 3 {
            return Vec::new();
        }
        let basis = other_modes(n);
        let scaled = DMatrix::from_fn(n, n - 3, |i, k| self.face.alpha[i] * basis[(i, k)]);
        let mut mu: Vec<f64> = basis.tr_mul(&scaled).symmetric_eigenvalues().iter().copied().collect();
        mu.sort_by(|a, b| b.total_cmp(a));
        mu
    }

    /// The eigenvalues of Q_n, falling.
    pub fn spectrum(&self) -> Vec<f64> {
        let mut spectrum: Vec<f64> = [1.0, 0.5, 0.5]
            .into_iter()
            .chain(self.mu().into_iter().map(|mu| 0.5 - mu))
            .collect();
        spectrum.sort_by(|a, b| b.total_cmp(a));
        spectrum
    }

    /// How far all |1/2 - mu_k| stay below 1/2 by Lemma 1: the lesser of min n alpha and 1 - max n alpha. At
    /// n = 3 there are none.
    pub fn gap_bound(&self) -> f64 {
        let alpha = self.face.alpha.iter().copied();
        alpha.fold(0.5, |gap: f64, alpha| gap.min(alpha).min(1.0 - alpha))
    }

    /// The weights v of the limit of all corners, of sum 1.
    pub fn limit_weights(&self) -> Vec<f64> {
        let n = self.valence();
        let system = DMatrix::from_fn(n, n, |i, j| {
            let own = if i == j { 1.0 } else { 0.0 };
            own + 2.0 * (own - mode(n, i, j)) * self.face.alpha[j]
        });
        let beta = DVector::from_column_slice(&self.face.beta);
        let v = system
            .lu()
            .solve(&beta)
            .expect("I + 2 (I - Pi) A has eigenvalues of real part 1 and more");
        v.iter().copied().collect()
    }

    /// Two left eigenvectors of 1/2, whose combinations of corners span the tangent plane; the first turns
    /// into the second counter-clockwise.
    pub fn tangent_weights(&self) -> [Vec<f64>; 2] {
        let n = self.valence();
        let alpha = &self.face.alpha;
        let zeros: Vec<usize> = (0..n).filter(|&i| alpha[i] == 0.0).collect();
        match zeros.len() {
            0 => [f64::cos_turn, f64::sin_turn].map(|turn: fn(i64, i64) -> f64| {
                let t = |i: usize| turn(i as i64, n as i64);
                let weighted: f64 = (0..n).map(|i| t(i) / alpha[i]).sum();
                let mean = weighted / alpha.iter().map(|a| 1.0 / a).sum::<f64>();
                (0..n).map(|i| (t(i) - mean) / alpha[i]).collect()
            }),
            2 => {
                // the vanishing ones are neighbours z and z+1
                let z = if zeros[1] == zeros[0] + 1 { zeros[0] } else { zeros[1] };
                let next = (z + 1) % n;
                let mut along = vec![0.0; n];
                (along[next], along[z]) = (1.0, -1.0);
                let mut outward = vec![0.0; n];
                for j in (0..n).filter(|&j| j != z && j != next) {
                    // half turns, since the axis of symmetry lies between two corners
                    let turn = |k: usize| f64::cos_turn(2 * k as i64 - 1, 2 * n as i64);
                    let g = turn((j + n - z) % n) - turn(1);
                    outward[j] += g / alpha[j];
                    outward[z] -= g / alpha[j];
                }
                [along, outward]
            }
            _ => {
                // z, z+1, z+2: the corner whose both neighbours vanish too is the middle one
                let vanishes = |i: usize| alpha[i % n] == 0.0;
                let middle = *zeros
                    .iter()
                    .find(|&&i| vanishes(i + 1) && vanishes(i + n - 1))
                    .expect("zeros of alpha are those of adjacent spokes");
                [(middle, middle + 1), (middle, middle + n - 1)].map(|(from, to)| {
                    let mut weights = vec![0.0; n];
                    weights[from] -= 1.0;
                    weights[to % n] += 1.0;
                    weights
                })
            }
        }
    }
}

/// The entry (i, j) of the projector on the modes 0 and +-1.
fn mode(n: usize, i: usize, j: usize) -> f64 {
    (1.0 + 2.0 * f64::cos_turn(i as i64 - j as i64, n as i64)) / n as f64
}

/// An orthonormal basis of the modes 2 .. n-2, as columns.
fn other_modes(n: usize) -> DMatrix<f64> {
    let scale = (2.0 / n as f64).sqrt();
    DMatrix::from_fn(n, n - 3, |i, column| {
        let k = (column / 2 + 2) as i64;
        let turn = i as i64 * k;
        if 2 * k == n as i64 {
            (1.0 / n as f64).sqrt() * f64::cos_turn(turn, n as i64)
        } else if column % 2 == 0 {
            scale * f64::cos_turn(turn, n as i64)
        } else {
            scale * f64::sin_turn(turn, n as i64)
        }
    })
}
