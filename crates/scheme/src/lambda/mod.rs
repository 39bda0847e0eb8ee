//! The lambda-scheme: one family of stencils for every subdominant eigenvalue.
//!
//! Ma, Wang and Ma, *An unified lambda-subdivision scheme for quadrilateral meshes with optimal curvature
//! performance in extraordinary regions*, ACM TOG 42(6) 209, 2023, <https://doi.org/10.1145/3618400>. The
//! stencils around a vertex of valence N have nine weights. Demanding affine invariance, the eigenvalue
//! `lambda` in Fourier blocks 1 and N-1, the eigenvalue `mu = s lambda^2` in blocks 0, 2 and N-2, and
//! `alpha = phi beta` leaves two free weights, `f2` and `f3`, of the face stencil: a [`Plane`].
//! The [`Relaxation`] says which `s` belongs to a lambda, the [`Domain`] which part of the plane gives
//! admissible stencils.

mod domain;
mod knots;
mod member;
mod paper;
mod plane;
mod relaxation;
mod table;

pub use domain::{Bounds, Constraint, ConstraintCurve, Domain, F2End, F2Interval, F3End, InfeasiblePoint, Root, Strip};
pub use knots::LambdaKnots;
pub use member::{Member, Source, Untabulated};
pub use paper::{LAMBDA_A, LAMBDA_M, LAMBDA_R1, PAPER_TABLE_1, PaperRow};
pub use plane::{LambdaStencil, Plane};
pub use relaxation::{Addition, Branch, Relaxation, Term};
pub use table::{LambdaEntry, LambdaTable, Provenance, Splines, TABLE_VERSION, TableError};
