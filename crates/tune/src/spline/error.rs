//! What can go wrong in fitting a spline.

/// The side of a bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The spline lies above.
    Lower,
    /// The spline lies below.
    Upper,
}

impl std::fmt::Display for Side {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Side::Lower => "lower",
            Side::Upper => "upper",
        })
    }
}

/// Why there is no fit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// The knots are not those of a spline space.
    #[error(transparent)]
    Spline(#[from] eigenring_spline::Error),
    /// Smoothness and energy are written down for quadratic and cubic splines.
    #[error("degree {degree} is out of range: accepted are 2 and 3")]
    Degree {
        /// The given degree.
        degree: usize,
    },
    /// A sample, interpolation point or bound lies outside the knots or is not a number, or a weight is not
    /// positive.
    #[error(
        "{what} {index} (lambda = {lambda}, value {value}): accepted are finite numbers with {lower} <= lambda <= {upper} and positive weights"
    )]
    Point {
        /// "sample", "interpolation point" or "bound".
        what: &'static str,
        /// Its index.
        index: usize,
        /// Its lambda.
        lambda: f64,
        /// Its value.
        value: f64,
        /// Start of the domain.
        lower: f64,
        /// End of the domain.
        upper: f64,
    },
    /// The lower bound lies above the upper one.
    #[error("no value lies between the bounds {lower} and {upper} at lambda = {lambda}")]
    EmptyBand {
        /// The subdominant eigenvalue at which it is so.
        lambda: f64,
        /// The lower bound.
        lower: f64,
        /// The upper bound.
        upper: f64,
    },
    /// Smoothness was asked for where there is no interior knot.
    #[error("lambda = {lambda} is not an interior knot: accepted are interior knots")]
    NotAKnot {
        /// The given lambda.
        lambda: f64,
    },
    /// An interpolation condition contradicts the others.
    #[error("the spline cannot take the value {value} at lambda = {lambda} together with the other equalities")]
    Contradiction {
        /// The subdominant eigenvalue at which it is so.
        lambda: f64,
        /// The value that is asked for.
        value: f64,
    },
    /// The samples do not determine the spline.
    #[error(
        "the samples determine {rank} of {free} free directions of the spline, with curvature energy: accepted are samples in every part of the domain"
    )]
    Undetermined {
        /// Directions that are determined.
        rank: usize,
        /// Directions that are free under the equalities.
        free: usize,
    },
    /// No spline satisfies all bounds and equalities.
    #[error(
        "no spline satisfies all bounds: the {side} bound {bound} at lambda = {lambda} is missed (value {value}) because of the bounds at lambda = {conflicts:?} and the equalities"
    )]
    Infeasible {
        /// Where the contradiction was met.
        lambda: f64,
        /// Which side.
        side: Side,
        /// The bound.
        bound: f64,
        /// The value of the best spline without this bound.
        value: f64,
        /// Where the bounds lie that it contradicts.
        conflicts: Vec<f64>,
    },
    /// Rounding keeps the active-set method from ending.
    #[error("no optimum after {steps} steps: a bound is still missed by {violation}")]
    NotConverged {
        /// Steps made.
        steps: usize,
        /// The largest violation left.
        violation: f64,
    },
    /// No pair of knots leaves enough samples between neighbours.
    #[error(
        "no pair of knots lambda_b, lambda_d leaves {needed} samples between neighbouring triple knots: accepted are denser samples"
    )]
    NoKnots {
        /// How many samples are needed.
        needed: usize,
    },
}
