//! A scheme at one corner: its matrix and everything that follows from it.

use crate::failure::Failure;
use crate::input::{Text, Whole, count};
use crate::maps::{CharacteristicMap, SecondOrderMaps};
use crate::pickle::{self, Reduced};
use crate::proofs::{Certificate, requirement};
use crate::scheme::called;
use crate::spectrum::{Eigenvectors, LimitStencils, NaturalConfiguration, Spectrum};
use crate::values::{self, complex};
use crate::work;
use eigenring_atlas::Error;
use eigenring_atlas::certificates::beside;
use eigenring_atlas::eigenvectors;
use eigenring_atlas::given::Given;
use eigenring_atlas::matrix::LocalMatrix;
use eigenring_atlas::schemes::{SchemeName, Tuner};
use eigenring_atlas::spectrum::Analysis;
use eigenring_certify::certify;
use eigenring_scheme::user::Reading;
use eigenring_scheme::{Corner, Scheme, Shape, Spec};
use eigenring_spectral::{Annulus, Block, Maps};
use numpy::PyArray2;
use pyo3::prelude::*;
use std::any::Any;
use std::sync::Arc;

/// Where the matrix comes from.
#[derive(Clone, Debug)]
pub enum Source {
    /// A scheme by name.
    Named {
        /// The scheme.
        name: SchemeName,
        /// The corner.
        corner: Corner,
        /// How the corner was asked for.
        shape: Shape,
        /// Smoothing steps on creases.
        steps: Option<usize>,
        /// What must not be deleted before.
        kept: Option<Arc<dyn Any + Send + Sync>>,
    },
    /// Rules that were given to a callback.
    Rules(Arc<Scheme<f64>>),
    /// A matrix of the caller.
    Matrix(Arc<Given>),
}

/// A scheme at one corner; made by :meth:`Scheme.at`.
///
/// >>> import eigenring
/// >>> at = eigenring.Scheme("catmull-clark").at(5)
/// >>> at.matrix(1).shape
/// (11, 11)
#[pyclass(frozen, module = "eigenring")]
#[derive(Clone, Debug)]
pub struct At {
    source: Source,
}

impl At {
    /// What stands for a source.
    pub fn new(source: Source) -> Self {
        At { source }
    }

    fn rules(&self) -> Result<Scheme<f64>, Failure> {
        match &self.source {
            Source::Named { name, corner, .. } => Ok(name.around(corner, &Tuner::default())?),
            Source::Rules(scheme) => Ok(scheme.as_ref().clone()),
            Source::Matrix(_) => Err(Failure::usage(
                "a matrix has no rules, from which maps and further rings could be found",
                "matrix(), spectrum() and limit_stencils() of a matrix",
            )),
        }
    }

    fn analysis(&self, rings: Option<usize>, level: Option<usize>) -> Result<Analysis, Failure> {
        Ok(match &self.source {
            Source::Named { name, corner, .. } => Analysis::of_name(name, corner, [rings, level], &Tuner::default())?,
            Source::Rules(scheme) => Analysis::of_scheme(scheme, rings, level)?,
            Source::Matrix(_) => return Err(self.rules().err().unwrap_or_else(no_rings)),
        })
    }
}

impl At {
    /// Whether its eigenvalues may take longer than some milliseconds.
    fn is_long(&self, rings: Option<usize>) -> bool {
        const SECTORS: usize = 20;
        const ORDER: usize = 6;
        let high = |name: &SchemeName| match name {
            SchemeName::Spec(Spec::Tension { order, .. } | Spec::Stam { order }) => *order > ORDER,
            SchemeName::Spec(_) | SchemeName::NonUniform(_) => false,
            SchemeName::File(_) => true,
        };
        let many = rings.is_some_and(|rings| rings > 3);
        many || match &self.source {
            Source::Named { name, corner, .. } => corner.sectors().sectors() > SECTORS || high(name),
            Source::Rules(scheme) => scheme.valence() > SECTORS,
            Source::Matrix(_) => false,
        }
    }
}

fn no_rings() -> Failure {
    Failure::usage("a matrix has the points that it has", "no rings and no level")
}

#[pymethods]
impl At {
    /// The local subdivision matrix as an (n, n) float64 array: new points are ``matrix @ points``.
    ///
    /// ``rings`` of control points, by default the smallest closed set as ``eigenring matrix`` takes it;
    /// ``level`` of refinement from 0, by default the limit level.
    ///
    /// >>> import eigenring
    /// >>> S = eigenring.Scheme("catmull-clark").at(5).matrix(rings=2)
    /// >>> S.shape, bool(abs(S.sum(axis=1) - 1).max() < 1e-15)
    /// ((31, 31), True)
    #[pyo3(signature = (rings = None, *, level = None))]
    fn matrix<'py>(
        &self,
        py: Python<'py>,
        rings: Option<Whole>,
        level: Option<Whole>,
    ) -> Result<Bound<'py, PyArray2<f64>>, Failure> {
        let [rings, level] = [count(rings, "rings")?, count(level, "level")?];
        if let Source::Matrix(given) = &self.source {
            if rings.is_some() || level.is_some() {
                return Err(no_rings());
            }
            return Ok(values::matrix(py, given.matrix())?);
        }
        let this = self.clone();
        let local = work::alone(py, self.is_long(rings), move || {
            Ok(LocalMatrix::new(&this.rules()?, rings, level)?)
        })?;
        Ok(values::matrix(py, &local.matrix)?)
    }

    /// The points in the order of rows and columns: dicts with index, sector, a, b.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).points(1)[1]
    /// {'a': 1, 'b': 0, 'index': 1, 'sector': 0}
    #[pyo3(signature = (rings = None))]
    fn points<'py>(&self, py: Python<'py>, rings: Option<Whole>) -> Result<Bound<'py, PyAny>, Failure> {
        let rings = count(rings, "rings")?;
        let this = self.clone();
        let points = work::alone(py, self.is_long(rings), move || {
            Ok(LocalMatrix::new(&this.rules()?, rings, None)?.points().json())
        })?;
        Ok(values::object(py, &points)?)
    }

    /// The Fourier blocks of the matrix, index 0 to N/2, of which N - k is the conjugate of k: real float64
    /// arrays where a reflection allows it, else complex ones. One block, the matrix itself, where rules
    /// differ from sector to sector.
    ///
    /// >>> import eigenring
    /// >>> blocks = eigenring.Scheme("catmull-clark").at(5).blocks(1)
    /// >>> [block.shape for block in blocks]
    /// [(3, 3), (2, 2), (2, 2)]
    #[pyo3(signature = (rings = None, *, level = None))]
    fn blocks<'py>(
        &self,
        py: Python<'py>,
        rings: Option<Whole>,
        level: Option<Whole>,
    ) -> Result<Vec<Bound<'py, PyAny>>, Failure> {
        let [rings, level] = [count(rings, "rings")?, count(level, "level")?];
        let this = self.clone();
        let analysis = work::alone(py, self.is_long(rings), move || this.analysis(rings, level))?;
        let blocks = analysis.system.blocks().iter().map(|block| -> Result<_, Failure> {
            Ok(match block {
                Block::Real(matrix) => values::matrix(py, matrix)?.into_any(),
                Block::Complex(matrix) => {
                    let entries = matrix.entries().iter().map(|&entry| complex(entry)).collect();
                    values::shaped(py, entries, &[matrix.rows(), matrix.columns()])?.into_any()
                }
            })
        });
        blocks.collect()
    }

    /// The eigenvalues with Fourier indices and multiplicities, as ``eigenring spectrum`` prints them.
    ///
    /// >>> import eigenring
    /// >>> spectrum = eigenring.Scheme("catmull-clark").at(5).spectrum()
    /// >>> spectrum.fourier[:3].tolist(), spectrum.multiplicities[:3].tolist()
    /// ([0, 1, 1], [1, 2, 2])
    #[pyo3(signature = (rings = None, *, level = None))]
    fn spectrum(&self, py: Python<'_>, rings: Option<Whole>, level: Option<Whole>) -> Result<Spectrum, Failure> {
        let [rings, level] = [count(rings, "rings")?, count(level, "level")?];
        if let Source::Matrix(given) = &self.source {
            if rings.is_some() || level.is_some() {
                return Err(no_rings());
            }
            return Ok(Spectrum::of_matrix(Arc::clone(given)));
        }
        let this = self.clone();
        let of_scheme = move || Ok(Spectrum::of_scheme(this.analysis(rings, level)?));
        work::alone(py, self.is_long(rings), of_scheme)
    }

    /// All right and left eigenvectors with Jordan chains.
    ///
    /// >>> import eigenring
    /// >>> v = eigenring.Scheme("catmull-clark").at(5).eigenvectors()
    /// >>> v.right.shape == v.left.shape == (len(v.eigenvalues),) * 2
    /// True
    #[pyo3(signature = (rings = None, *, level = None))]
    fn eigenvectors(
        &self,
        py: Python<'_>,
        rings: Option<Whole>,
        level: Option<Whole>,
    ) -> Result<Eigenvectors, Failure> {
        let [rings, level] = [count(rings, "rings")?, count(level, "level")?];
        let this = self.clone();
        work::alone(py, self.is_long(rings), move || {
            let analysis = this.analysis(rings, level)?;
            let extended = match &this.source {
                Source::Named { name, corner, .. } => name.extended(corner)?,
                _ => None,
            };
            let found = eigenvectors::Eigenvectors::new(&analysis, extended.as_ref())?;
            Ok(Eigenvectors::new(&found))
        })
    }

    /// The weights of all points in limit position and tangents.
    ///
    /// >>> import eigenring
    /// >>> stencils = eigenring.Scheme("catmull-clark").at(5).limit_stencils()
    /// >>> float(stencils.position[0].round(12))  # N^2 / (N^2 + 5 N)
    /// 0.5
    #[pyo3(signature = (rings = None))]
    fn limit_stencils(&self, py: Python<'_>, rings: Option<Whole>) -> Result<LimitStencils, Failure> {
        let rings = count(rings, "rings")?;
        let this = self.clone();
        let json = work::alone(py, self.is_long(rings), move || {
            Ok(match &this.source {
                Source::Matrix(given) => given.json(),
                _ => this.analysis(rings, None)?.json(),
            })
        })?;
        Ok(LimitStencils::new(&json["limit_stencils"]))
    }

    /// The natural configuration: control points that are mapped to lambda times themselves.
    ///
    /// >>> import eigenring
    /// >>> natural = eigenring.Scheme("catmull-clark").at(5).natural_configuration()
    /// >>> natural.points[:2].tolist(), round(natural.value, 6)
    /// ([[0.0, 0.0], [1.0, 0.0]], 0.549988)
    #[pyo3(signature = (rings = None))]
    fn natural_configuration(&self, py: Python<'_>, rings: Option<Whole>) -> Result<NaturalConfiguration, Failure> {
        let rings = count(rings, "rings")?;
        let this = self.clone();
        let natural = move || Ok(NaturalConfiguration(this.analysis(rings, None)?.system.natural()?));
        work::alone(py, self.is_long(rings), natural)
    }

    /// The characteristic map on the regular patches of one annulus around the centre.
    ///
    /// >>> import eigenring
    /// >>> sample = eigenring.Scheme("catmull-clark").at(5).characteristic_map().sample(3)
    /// >>> sample.points.shape, bool((sample.jacobians > 0).all())
    /// ((15, 3, 3, 2), True)
    fn characteristic_map(&self, py: Python<'_>) -> Result<CharacteristicMap, Failure> {
        let this = self.clone();
        work::alone(py, self.is_long(None), move || {
            let scheme = this.rules()?;
            let annulus = Annulus::new(&scheme)?;
            let system = eigenring_spectral::LocalSystem::new(scheme.limit(), annulus.numbering.rings)?;
            Ok(CharacteristicMap::new(annulus, system.natural()?, system.valence()))
        })
    }

    /// The second-order maps: graphs of a cup and two saddles over the characteristic map.
    ///
    /// >>> import eigenring
    /// >>> maps = eigenring.Scheme("catmull-clark").at(5).second_order_maps()
    /// >>> maps.mu.round(6).tolist()
    /// [0.322474, 0.340107, 0.340107]
    fn second_order_maps(&self, py: Python<'_>) -> Result<SecondOrderMaps, Failure> {
        let this = self.clone();
        work::alone(py, self.is_long(None), move || {
            let scheme = this.rules()?;
            Ok(SecondOrderMaps::new(Maps::new(&scheme)?, scheme.valence()))
        })
    }

    /// Proves or refutes that the scheme is C1 here (``"c1"``), has bounded curvature (``"bounded"``), is
    /// strict (``"strict"``) or has no negative weight (``"hull"``), as ``eigenring verify`` does.
    ///
    /// ``exact`` takes the weights of a file as written; ``progress(what, done, total)`` is called now and
    /// then.
    ///
    /// >>> import eigenring
    /// >>> certificate = eigenring.Scheme("catmull-clark").at(5).verify(require="c1")
    /// >>> certificate.holds, certificate.status
    /// (True, 'proven')
    #[pyo3(signature = (require = Text::of("c1"), *, exact = false, progress = None), text_signature = "($self, require='c1', *, exact=False, progress=None)")]
    fn verify(
        &self,
        py: Python<'_>,
        require: Text,
        exact: bool,
        progress: Option<Py<PyAny>>,
    ) -> Result<Certificate, Failure> {
        let requirement = requirement(&require.get("require")?)?;
        let Source::Named { name, shape, steps, .. } = self.source.clone() else {
            return Err(Failure::usage(
                "what is proven is said of rules, and a matrix has none",
                "schemes by name or from a file",
            ));
        };
        if exact && !matches!(name, SchemeName::File(_)) {
            return Err(Failure::usage(
                "exact has no meaning for a scheme that is built in, whose weights are exact",
                "exact with a scheme file",
            ));
        }
        let reading = if exact { Reading::Exact } else { Reading::Balanced };
        if let SchemeName::NonUniform(scheme) = name {
            return work::run(py, progress, move |_| {
                Certificate::with_intervals(scheme, shape, requirement)
            });
        }
        // the file, if there is one, lives as long as the work
        let kept = self.clone();
        let certificate = work::run(py, progress, move |reporter| {
            let _kept = &kept;
            let tuner = Tuner {
                progress: reporter,
                ..Tuner::default()
            };
            let input = beside(&name, &shape, steps, reading, &tuner)?;
            let valence = shape.corner(name.centre()?, steps)?.sectors().sectors();
            Ok(certify(input, valence).map_err(Error::from)?)
        })?;
        Ok(Certificate::new(certificate, requirement))
    }

    /// How many sectors there are.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).valence
    /// 5
    #[getter]
    fn valence(&self) -> Option<usize> {
        match &self.source {
            Source::Named { corner, .. } => Some(corner.sectors().sectors()),
            Source::Rules(scheme) => Some(scheme.valence()),
            Source::Matrix(given) => given.rotation().map(|rotation| rotation.valence),
        }
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> Result<Reduced<'py>, Failure> {
        Ok(match &self.source {
            Source::Named { name, shape, steps, .. } => {
                let scheme = Py::new(py, crate::scheme::Scheme::named(name.clone()))?;
                let (place, knots) = match shape {
                    Shape::Knots { intervals, next } => (None, Some((intervals.clone(), next.clone()))),
                    shape => (Some(Py::new(py, crate::scheme::Corner { shape: shape.clone() })?), None),
                };
                let (knots, next) = knots.unzip();
                pickle::reduced(py, "at", (scheme, place, knots, next, *steps))?
            }
            Source::Matrix(given) => {
                let scheme = crate::scheme::Scheme::of_matrix(given.matrix().clone());
                pickle::reduced(py, "at_matrix", (Py::new(py, scheme)?, self.valence()))?
            }
            Source::Rules(_) => {
                return Err(Failure::usage(
                    "the scheme of an objective is no name and no file",
                    "pickles of schemes by name, from files and of matrices",
                ));
            }
        })
    }

    fn __repr__(&self) -> String {
        match &self.source {
            Source::Named { name, corner, .. } => {
                let sectors = corner.sectors().sectors();
                format!("<At {}, {corner}, {sectors} sectors>", called(name))
            }
            Source::Rules(scheme) => format!("<At {}, closed {}>", scheme.name(), scheme.valence()),
            Source::Matrix(given) => format!("<At matrix of {} points>", given.matrix().rows()),
        }
    }
}
