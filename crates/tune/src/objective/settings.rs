//! What can be chosen about the objective, and what is refused.

/// How the eigenvectors are scaled. The objective itself is not invariant: multiplying x, y by `p` and z by
/// `q` multiplies its part by `(q / p^2)^2`, and as the scale depends on (f2, f3) and lambda, so does the
/// optimum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Normalisation {
    /// Each of x, y and the three z has unit Euclidean norm over the whole five-ring neighbourhood of `30 N +
    /// 1` points. The paper does not state its normalisation; of the natural ones this is the one that
    /// reproduces its optimal lambda.
    Paper,
    /// The eigenvectors as they come: the edge neighbour on the x axis has the value 1 (for the second saddle
    /// at N = 4, which vanishes there, the first face neighbour).
    UnitRing,
    /// Each part divided by the mean over Omega of the squares `z_xx^2 + z_xy^2 + z_yy^2` of its own map:
    /// the part of them that no quadratic explains, between 0 and 1 without the weight. No scale of the
    /// eigenvectors enters.
    Relative,
}

/// The constants of the objective; [`Settings::default`] are the paper's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Width of the transition of the weight, relative to the ideal Gauss curvature (Eq. 20). Positive and
    /// finite.
    pub epsilon: f64,
    /// The weight runs from 1 to `n^2` (Eq. 17). At least 1 and finite.
    pub n: f64,
    /// Gauss points per patch and direction, 1 to 20.
    pub quadrature_order: usize,
    /// Whether the weight is applied; if not, the objective is that of Ma and Ma (2019).
    pub weighted: bool,
    /// Scale of the eigenvectors.
    pub normalisation: Normalisation,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            epsilon: 0.2,
            n: 5.0,
            quadrature_order: 5,
            weighted: true,
            normalisation: Normalisation::Paper,
        }
    }
}

/// Why an objective cannot be set up or evaluated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Valence, lambda or s is out of range.
    #[error(transparent)]
    Plane(#[from] eigenring_scheme::Error),
    /// The ratio of the vertex stencil's weights is not a finite non-negative number.
    #[error("phi = {phi} is out of range: accepted is 0 <= phi < inf")]
    Phi {
        /// The given ratio alpha / beta of the vertex stencil.
        phi: f64,
    },
    /// The width of the weight is out of range.
    #[error("epsilon = {epsilon} is out of range: accepted is 0 < epsilon < inf")]
    Epsilon {
        /// The given width of the weight.
        epsilon: f64,
    },
    /// The largest weight's root is out of range.
    #[error("n = {n} is out of range: accepted is 1 <= n < inf")]
    N {
        /// The given root of the largest weight.
        n: f64,
    },
    /// The quadrature order is out of range.
    #[error("quadrature order {order} is out of range: accepted are 1 to 20")]
    QuadratureOrder {
        /// The given number of Gauss points per direction.
        order: usize,
    },
    /// lambda or mu meets an eigenvalue of the outer rings, so that the eigenvector is not determined by the
    /// first ring.
    #[error("the eigenvalue {eigenvalue} coincides with the outer rings' eigenvalue {outer}")]
    Resonance {
        /// lambda or mu.
        eigenvalue: f64,
        /// The eigenvalue of the outer rings.
        outer: f64,
    },
    /// The characteristic map folds over: its Jacobian determinant is not positive at some Gauss point.
    #[error("at f2 = {f2}, f3 = {f3} the natural configuration folds over: smallest Jacobian {jacobian}")]
    Folded {
        /// The face stencil's weight of each edge neighbour.
        f2: f64,
        /// The face stencil's weight of the opposite corner.
        f3: f64,
        /// The smallest Jacobian over the Gauss points, with the first edge neighbour at distance 1.
        jacobian: f64,
    },
    /// An argument is not finite, or the stencil at (f2, f3) does not exist (a denominator vanishes).
    #[error("the objective has no finite value at f2 = {f2}, f3 = {f3}")]
    NotFinite {
        /// The face stencil's weight of each edge neighbour.
        f2: f64,
        /// The face stencil's weight of the opposite corner.
        f3: f64,
    },
}

impl Settings {
    /// Refuses constants out of range.
    pub(super) fn validate(&self) -> Result<(), Error> {
        if !(self.epsilon > 0.0 && self.epsilon.is_finite()) {
            return Err(Error::Epsilon { epsilon: self.epsilon });
        }
        if !(self.n >= 1.0 && self.n.is_finite()) {
            return Err(Error::N { n: self.n });
        }
        if !(1..=20).contains(&self.quadrature_order) {
            return Err(Error::QuadratureOrder {
                order: self.quadrature_order,
            });
        }
        Ok(())
    }
}
