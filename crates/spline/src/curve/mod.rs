//! Curves and tensor-product surfaces of the generalised scheme.
//!
//! Fang, Ma and Wang, *A generalized surface subdivision scheme of arbitrary order with a tension parameter*,
//! Eqs. 1 and 2: a level of order k >= 3 cuts corners with tension u and then averages neighbours k-3 times,
//!
//! ```text
//! Q_2i = ((1+2u) P_i + P_i-1) / (2 (1+u)),   Q_2i+1 = ((1+2u) P_i + P_i+1) / (2 (1+u)),
//! R_i = (Q_i + Q_i+1) / 2,
//! ```
//!
//! and the next level has the tension `sqrt((1+u)/2)`. The limit is k-2 times continuously differentiable: a
//! uniform B-spline of degree k-1 at `u = 1`, a trigonometric one below, a hyperbolic one above ([`Basis`];
//! what it reproduces: [`Space`]).
//!
//! **Parameters.** Knots are the integers. Control point i belongs to the parameter `i` for even orders
//! (primal) and `i + 1/2` for odd ones (dual). Points of level l keep the curve's parameter, so their knots
//! are the multiples of `2^-l`. The limit at a parameter is the same seen from any level.
//!
//! **Ends.** A closed polygon of n points has period n, and 2n points on the next level. An open one has a
//! curve where all k points that matter are there: the n-k+1 intervals of `[k/2 - 1, n - k/2]` (even) or
//! `[(k-1)/2, n - (k-1)/2]` (odd). Refined points that would read beyond the ends are dropped, which leaves
//! `2n - k + 1`, exactly those of twice as many intervals over the same domain: the polygon shrinks from
//! level to level, the curve does not. `m` levels leave `2^m (n-k+1) + k-1`.
//!
//! A **clamped** polygon, at `u0 = 1`, has k-fold knots at its ends, starts in its first control point and
//! ends in its last: n points make the n-k+1 intervals of `[0, n-k+1]`, point i belongs to the mean of its
//! k-1 inner knots, and a level has `2n - k + 1` points, by the Oslo algorithm. No such ends of the
//! generalised basis are published. Order 2, the control polygon itself, exists at `u0 = 1` alone.
//!
//! A direction is an [`Axis`]; a [`Curve`] is an axis with points, a [`Grid`] two of them (Algorithm 1), and
//! [`Grid::revolution`] makes one from a curve (Algorithm 2).

mod axis;
mod basis;
mod clamped;
mod grid;
mod piece;
mod polygon;
mod revolution;
mod rule;
mod space;
mod tension;

pub use axis::{Axis, Weights};
pub use basis::Basis;
pub use grid::Grid;
pub use piece::{Piece, Values};
pub use polygon::Curve;
pub use rule::{Rule, rules};
pub use space::{Function, Space};
pub use tension::{Angle, Tension};

/// The largest order: a refined point is a combination of about k/2 others, and nothing beyond degree 31 is
/// of use.
pub const MAX_ORDER: usize = 32;

/// The smallest order with tension: order 2 is the control polygon.
pub const MIN_ORDER: usize = 3;

/// How a polygon ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// It has a first and a last point, between which the curve begins and ends.
    Open,
    /// It has a first and a last point, in which the curve starts and ends.
    Clamped,
    /// The last point is followed by the first.
    Closed,
}

/// The page's program is compiled and run as a test.
#[cfg(doctest)]
#[doc = include_str!("../../../../docs/curves.md")]
struct Page;
