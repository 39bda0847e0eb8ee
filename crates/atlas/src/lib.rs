//! Schemes by name, from files or tuned on demand, and everything that the `eigenring` command prints of
//! them, as a library.
//!
//! The crates below know one thing each: what a scheme is, what follows from it, how one is found, what can
//! be proven of it, how a picture is drawn. This one puts them together. Its functions take plain values, and
//! return plain data, a [`table::Table`] or a [`figures::Drawing`]; where a result goes is for the caller to
//! say.
//!
//! ```
//! use eigenring_atlas::schemes::{SchemeName, Tuner};
//! use eigenring_atlas::spectrum::Analysis;
//! use eigenring_atlas::table::Format;
//!
//! let name: SchemeName = "catmull-clark".parse()?;
//! let scheme = name.scheme(5, &Tuner::default())?;
//! let analysis = Analysis::of_scheme(&scheme, None, None)?;
//! print!("{}", analysis.eigenvalues().render(Format::Text));
//!
//! // 1, then the subdominant eigenvalue, once for each of the blocks 1 and 4
//! let [one, lambda] = [0, 1].map(|index| &analysis.spectrum.eigenvalues[index]);
//! assert!((one.value.re - 1.0).abs() < 1e-12 && one.multiplicity == 1);
//! assert!((lambda.value.re - 0.549988).abs() < 1e-6);
//! assert_eq!((lambda.fourier, lambda.multiplicity), (Some(1), 2));
//! # Ok::<(), eigenring_atlas::Error>(())
//! ```
//!
//! | module | what it gives |
//! |---|---|
//! | [`schemes`] | a scheme from a name: `catmull-clark`, `lambda:optimal`, `file:my.toml`; the [`schemes::Tuner`] for what is not tabulated |
//! | [`spectrum`], [`matrix`] | eigenvalues and limit stencils; the local matrix in the formats of other programs |
//! | [`given`], [`numbers`] | a matrix that somebody has, whatever its order and rotation; reading tables of numbers |
//! | [`eigenvectors`], [`stam`] | all right and left vectors with Jordan chains; Stam's evaluation basis |
//! | [`compare`] | schemes side by side over valences |
//! | [`stencil`], [`tune`] | one member of the lambda-scheme; the best one |
//! | [`tuning`] | the best values for the parameters of a scheme file |
//! | [`certificates`], [`verify`] | what is certified, checked again, summed up and printed |
//! | [`report`] | one page about a scheme: all of the above that has a meaning for it |
//! | [`curve`] | curves and surfaces of revolution |
//! | [`meshes`], [`limits`], [`curvature`] | limit points as tables; mesh files, the rules of a scheme on a mesh, refinement |
//! | [`render`] | pictures of surfaces |
//! | [`run`], [`results`], [`tension`] | the studies behind `results/`, and its files as text |
//! | [`studies`] | what is shown of the lambda-scheme beyond the papers' tables |
//! | [`figures`] | pictures with the tables of what they show |
//! | [`index`], [`difference`] | what makes and checks `results/`, and comparing its files number by number |
//! | [`table`], [`progress`], [`files`], [`cache`], [`memory`] | tables in four formats; telling of long work, and the one parallel loop; complete files; remembered stencils; what fits into memory |
//!
//! **Surroundings.** Nothing here knows of command lines, terminals and exit codes. Whoever waits is told of
//! progress through a [`progress::Progress`]. Work is parallel on the current pool of rayon, and no result
//! depends on the number of threads. Files are read and written where a path is given; the user's cache is
//! asked only by a [`schemes::Tuner`] that was given it.
//!
//! **Errors** are one enum, [`Error`]: what is wrong, with the offending value, and what is accepted in its
//! place.

pub mod analysis;
pub mod cache;
pub mod certificates;
pub mod compare;
pub mod curvature;
pub mod curve;
mod decimal;
pub mod difference;
pub mod eigenvectors;
mod error;
pub mod figures;
pub mod files;
pub mod gallery;
pub mod given;
pub mod glossary;
pub mod grids;
pub mod index;
pub mod limits;
pub mod matrix;
pub mod memory;
pub mod meshes;
pub mod nonuniform;
pub mod numbers;
pub mod on_mesh;
pub mod progress;
pub mod render;
pub mod report;
pub mod results;
pub mod run;
pub mod schemes;
pub mod spectrum;
pub mod stam;
pub mod stencil;
pub mod studies;
pub mod sweep;
pub mod table;
pub mod tension;
pub mod tune;
pub mod tuning;
pub mod verify;

pub use error::{Accepted, Error, accepted_in};
