//! What can be wrong with a spline, a curve or a grid.

/// Why knots, coefficients, control points or arguments are refused. Every variant carries the offending
/// numbers; the message of a range error ends with the accepted range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The tension of the generalised scheme; u = -1 divides by zero.
    #[error("tension u0 = {tension} is out of range: accepted is u0 > -1")]
    Tension {
        /// The given tension.
        tension: f64,
    },
    /// A tension where only polynomials are defined.
    #[error("{what} with tension u0 = {tension}: accepted is u0 = 1")]
    Polynomial {
        /// What has no tension.
        what: &'static str,
        /// The given tension.
        tension: f64,
    },
    /// The order of the generalised tension scheme.
    #[error("order {order} is out of range: accepted are {minimum} to {maximum}")]
    Order {
        /// The given order, one more than the degree.
        order: usize,
        /// The smallest accepted order.
        minimum: usize,
        /// The largest accepted order.
        maximum: usize,
    },
    /// Not the knots of an open spline space.
    #[error("knot {index} = {value}: accepted is that {reason}")]
    Knots {
        /// Position of the first bad knot, from 0.
        index: usize,
        /// Its value (NaN if it is missing).
        value: f64,
        /// The condition it breaks.
        reason: &'static str,
    },
    /// A spline has one finite coefficient for each dimension of its space.
    #[error("{finite} finite spline coefficients: accepted are exactly {expected}, all finite")]
    Coefficients {
        /// How many of the given ones are finite.
        finite: usize,
        /// The dimension of the space.
        expected: usize,
    },
    /// An argument outside of a spline's domain.
    #[error("{value} is outside of the spline's domain: accepted are {lower} to {upper}")]
    OutsideSpline {
        /// The number that was given.
        value: f64,
        /// Start of the domain.
        lower: f64,
        /// End of the domain.
        upper: f64,
    },
    /// A control polygon has at least as many points as one interval of its curve needs.
    #[error("{count} control points: accepted are {minimum} to {maximum} here")]
    ControlPoints {
        /// How many there are, or would be.
        count: usize,
        /// The order for open polygons, 3 for closed ones.
        minimum: usize,
        /// What memory allows.
        maximum: usize,
    },
    /// The points of a grid fill its rows.
    #[error("{count} control points: accepted are {rows} x {columns}")]
    GridPoints {
        /// How many there are.
        count: usize,
        /// Points in the first direction.
        rows: usize,
        /// Points in the second direction.
        columns: usize,
    },
    /// Control points have at least one coordinate, and all as many.
    #[error("control point {index} has {found} coordinates: accepted are exactly {expected}")]
    Dimension {
        /// Position of the point, from 0.
        index: usize,
        /// Its number of coordinates.
        found: usize,
        /// That of the first point.
        expected: usize,
    },
    /// A coordinate is not finite, or overflows.
    #[error("coordinate {value} of point {index}: accepted are finite numbers")]
    NotFinite {
        /// Position of the point, from 0.
        index: usize,
        /// The coordinate.
        value: f64,
    },
    /// A function is not one of those that curves of this order and tension reproduce.
    #[error("the function is not reproduced: accepted is that {reason}")]
    NotReproduced {
        /// The condition it breaks.
        reason: String,
    },
    /// Only a spatial curve can turn around the third axis.
    #[error("a generatrix with {dimension} coordinates: accepted are exactly 3")]
    Revolution {
        /// The number of coordinates.
        dimension: usize,
    },
}
