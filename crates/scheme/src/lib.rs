//! What a subdivision scheme is, around an extraordinary vertex or face.
//!
//! A [`Scheme`] is data: [`Level`]s of [`Pass`]es on the twisted lattice of [`Site`]s. A pass makes regular
//! points by a tensor product of a [`Line`] rule and points near the centre by explicit [`Stencil`]s;
//! [`refine`] runs passes on any [`Net`]. Families are constructors in [`families`] and [`lambda`]; user
//! schemes come from TOML through [`user`]; [`Spec`] finds a scheme by name. All of it is generic over the
//! [`Scalar`].
//!
//! A [`Definition`] is a scheme at all [`Corner`]s: ask it for the rules around one, and the rules for what
//! follows from them. Symmetry and degree are derived, and never stated:
//!
//! ```
//! use eigenring_scheme::{Corner, Definition, Scheme, Spec, Symmetry};
//!
//! let definition = Definition::Family("catmull-clark".parse::<Spec>()?);
//! let inner: Scheme<f64> = definition.around(&definition.closed(5)?)?;
//! assert_eq!((inner.limit().symmetry(), inner.degree()), (Symmetry::Dihedral, Some(3)));
//! // a boundary vertex with two faces: no rule reads beyond the boundary
//! let boundary: Scheme<f64> = definition.around(&Corner::fan(2)?)?;
//! assert_eq!((boundary.limit().symmetry(), boundary.closed_rings()?), (Symmetry::None, 1));
//! # Ok::<(), eigenring_scheme::Error>(())
//! ```

mod corner;
mod definition;
mod error;
mod exact;
pub mod families;
mod fourier;
mod knots;
pub mod lambda;
mod level;
mod line;
mod net;
mod number;
mod one_ring;
mod pass;
mod reach;
mod rows;
mod scheme;
mod similar;
mod site;
mod spec;
mod stencil;
mod table;
pub mod user;

pub use corner::{Centre, Corner, MAX_SECTORS, Shape, Spoke, is_interval};
pub use definition::Definition;
/// The number types that rules are generic over.
pub use eigenring_spline::{BigRational, Complex, Dual, Same, Scalar};
pub use error::{Error, RuleFault};
pub use exact::{Cosines, Exact};
pub use fourier::{Form, FourierNet};
pub use level::{Level, Symmetry};
pub use line::{Line, Taps};
pub use net::{DenseNet, Net, Plan, PointNet, refine};
pub use number::Number;
pub use one_ring::OneRing;
pub use pass::Pass;
pub use scheme::Scheme;
pub use similar::did_you_mean;
pub use site::{Fan, Lattice, Numbering, Site};
pub use spec::{Family, Spec, registry};
pub use stencil::Stencil;
pub use table::{Table, Topology};

/// The README's program is compiled and run as a test.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
