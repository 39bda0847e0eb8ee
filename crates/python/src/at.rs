//! A scheme at one corner: its matrix and everything that follows from it.

use crate::failure::Failure;
use crate::maps::{CharacteristicMap, SecondOrderMaps};
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
use eigenring_scheme::{Corner, Scheme, Shape};
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
        rings: Option<usize>,
        level: Option<usize>,
    ) -> Result<Bound<'py, PyArray2<f64>>, Failure> {
        if let Source::Matrix(given) = &self.source {
            if rings.is_some() || level.is_some() {
                return Err(no_rings());
            }
            return Ok(values::matrix(py, given.matrix())?);
        }
        let local = py.detach(|| Ok::<_, Failure>(LocalMatrix::new(&self.rules()?, rings, level)?))?;
        Ok(values::matrix(py, &local.matrix)?)
    }

    /// The points in the order of rows and columns: dicts with index, sector, a, b.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).points(1)[1]
    /// {'a': 1, 'b': 0, 'index': 1, 'sector': 0}
    #[pyo3(signature = (rings = None))]
    fn points<'py>(&self, py: Python<'py>, rings: Option<usize>) -> Result<Bound<'py, PyAny>, Failure> {
        let local = LocalMatrix::new(&self.rules()?, rings, None)?;
        Ok(values::object(py, &local.points().json())?)
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
        rings: Option<usize>,
        level: Option<usize>,
    ) -> Result<Vec<Bound<'py, PyAny>>, Failure> {
        let analysis = py.detach(|| self.analysis(rings, level))?;
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
    fn spectrum(&self, py: Python<'_>, rings: Option<usize>, level: Option<usize>) -> Result<Spectrum, Failure> {
        if let Source::Matrix(given) = &self.source {
            if rings.is_some() || level.is_some() {
                return Err(no_rings());
            }
            return Ok(Spectrum::of_matrix(Arc::clone(given)));
        }
        py.detach(|| Ok(Spectrum::of_scheme(self.analysis(rings, level)?)))
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
        rings: Option<usize>,
        level: Option<usize>,
    ) -> Result<Eigenvectors, Failure> {
        py.detach(|| {
            let analysis = self.analysis(rings, level)?;
            let extended = match &self.source {
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
    fn limit_stencils(&self, py: Python<'_>, rings: Option<usize>) -> Result<LimitStencils, Failure> {
        let json = match &self.source {
            Source::Matrix(given) => given.json(),
            _ => py.detach(|| Ok::<_, Failure>(self.analysis(rings, None)?.json()))?,
        };
        Ok(LimitStencils::new(&json["limit_stencils"]))
    }

    /// The natural configuration: control points that are mapped to lambda times themselves.
    ///
    /// >>> import eigenring
    /// >>> natural = eigenring.Scheme("catmull-clark").at(5).natural_configuration()
    /// >>> natural.points[:2].tolist(), round(natural.value, 6)
    /// ([[0.0, 0.0], [1.0, 0.0]], 0.549988)
    #[pyo3(signature = (rings = None))]
    fn natural_configuration(&self, py: Python<'_>, rings: Option<usize>) -> Result<NaturalConfiguration, Failure> {
        py.detach(|| Ok(NaturalConfiguration(self.analysis(rings, None)?.system.natural()?)))
    }

    /// The characteristic map on the regular patches of one annulus around the centre.
    ///
    /// >>> import eigenring
    /// >>> sample = eigenring.Scheme("catmull-clark").at(5).characteristic_map().sample(3)
    /// >>> sample.points.shape, bool((sample.jacobians > 0).all())
    /// ((15, 3, 3, 2), True)
    fn characteristic_map(&self, py: Python<'_>) -> Result<CharacteristicMap, Failure> {
        py.detach(|| {
            let scheme = self.rules()?;
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
        py.detach(|| {
            let scheme = self.rules()?;
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
    #[pyo3(signature = (require = "c1", *, exact = false, progress = None))]
    fn verify(
        &self,
        py: Python<'_>,
        require: &str,
        exact: bool,
        progress: Option<Py<PyAny>>,
    ) -> Result<Certificate, Failure> {
        let requirement = requirement(require)?;
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
