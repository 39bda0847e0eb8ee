//! What a subdivision scheme is, around an extraordinary vertex or face.
//!
//! A [`Scheme`] is data: [`Level`]s of [`Pass`]es on the twisted lattice of [`Site`]s. A pass makes regular points by a
//! tensor product of a [`Line`] rule and points near the centre by explicit [`Stencil`]s; [`refine`] runs passes on any
//! [`Net`]. Families are constructors in [`families`] and [`lambda`]; user schemes come from TOML through [`user`];
//! [`Spec`] finds a scheme by name. All of it is generic over the [`Scalar`].

pub mod curve;
mod dual;
mod error;
pub mod families;
mod fourier;
pub mod lambda;
mod line;
mod net;
mod number;
mod one_ring;
mod pass;
mod scalar;
mod scheme;
mod site;
mod spec;
mod spline;
mod stencil;
pub mod user;

pub use dual::Dual;
pub use error::Error;
pub use fourier::{Complex, Form, FourierNet};
pub use line::Line;
pub use net::{DenseNet, Net, Plan, PointNet, refine};
pub use number::Number;
pub use one_ring::OneRing;
pub use pass::{Level, Pass};
pub use scalar::Scalar;
pub use scheme::Scheme;
pub use site::{Fan, Lattice, Numbering, Site};
pub use spec::{Family, Spec, registry};
pub use spline::{Basis, Knots, Spline};
pub use stencil::Stencil;

/// The README's program is compiled and run as a test.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
