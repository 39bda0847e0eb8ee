//! Eigenvalues, eigenvectors, limit stencils and the natural configuration as arrays.

use crate::failure::Failure;
use crate::values::{self, complex};
use eigenring_atlas::eigenvectors;
use eigenring_atlas::given::Given;
use eigenring_atlas::spectrum::Analysis;
use eigenring_spectral::Natural;
use numpy::{Complex64, PyArray1, PyArrayDyn};
use pyo3::prelude::*;
use serde_json::Value;
use std::sync::Arc;

#[derive(Clone, Debug)]
enum Of {
    Scheme(Box<Analysis>),
    Matrix(Arc<Given>),
}

/// The eigenvalues of a local matrix. All arrays have an entry for each eigenvalue, repeated by multiplicity,
/// by falling modulus.
///
/// >>> import eigenring
/// >>> spectrum = eigenring.Scheme("catmull-clark").at(5).spectrum()
/// >>> len(spectrum.eigenvalues) == spectrum.points
/// True
#[pyclass(frozen, module = "eigenring")]
#[derive(Debug)]
pub struct Spectrum {
    of: Of,
}

impl Spectrum {
    /// Of a scheme.
    pub fn of_scheme(analysis: Analysis) -> Self {
        Spectrum {
            of: Of::Scheme(Box::new(analysis)),
        }
    }

    /// Of a matrix.
    pub fn of_matrix(given: Arc<Given>) -> Self {
        Spectrum { of: Of::Matrix(given) }
    }

    fn object(&self) -> serde_json::Map<String, Value> {
        match &self.of {
            Of::Scheme(analysis) => analysis.json(),
            Of::Matrix(given) => given.json(),
        }
    }

    /// What is listed of each eigenvalue, once.
    fn listed(&self) -> Vec<Value> {
        let table = match &self.of {
            Of::Scheme(analysis) => analysis.eigenvalues(),
            Of::Matrix(given) => given.eigenvalues(),
        };
        match table.json() {
            Value::Array(rows) => rows,
            _ => Vec::new(),
        }
    }

    fn repeated<T: Clone>(&self, of: impl Fn(&Value) -> T) -> Vec<T> {
        let rows = self.listed();
        let repeat = |row: &Value| std::iter::repeat_n(of(row), row["multiplicity"].as_u64().unwrap_or(0) as usize);
        rows.iter().flat_map(repeat).collect()
    }

    /// Whole numbers; -1 where there is none.
    fn integers<'py>(&self, py: Python<'py>, column: &str) -> Bound<'py, PyArray1<i64>> {
        PyArray1::from_vec(py, self.repeated(|row| row[column].as_i64().unwrap_or(-1)))
    }

    fn head(&self, field: &str) -> Option<f64> {
        match &self.of {
            Of::Scheme(analysis) => analysis.head().json().get(field)?.as_f64(),
            Of::Matrix(given) => given.json().get(field)?.as_f64(),
        }
    }
}

#[pymethods]
impl Spectrum {
    /// complex128 of shape (points,).
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(4).spectrum().eigenvalues[:4].real.tolist()
    /// [1.0, 0.5, 0.5, 0.25]
    #[getter]
    fn eigenvalues<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<Complex64>> {
        let part = |row: &Value, name: &str| row[name].as_f64().unwrap_or(f64::NAN);
        let values = self.repeated(|row| Complex64::new(part(row, "re"), part(row, "im")));
        PyArray1::from_vec(py, values)
    }

    /// int64: Fourier indices up to N/2, which stand for their block and its conjugate; -1 without blocks.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).spectrum().fourier[:3].tolist()
    /// [0, 1, 1]
    #[getter]
    fn fourier<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        self.integers(py, "fourier")
    }

    /// int64: algebraic multiplicities in the whole matrix.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).spectrum().multiplicities[:3].tolist()
    /// [1, 2, 2]
    #[getter]
    fn multiplicities<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        self.integers(py, "multiplicity")
    }

    /// int64: numbers of independent eigenvectors in the whole matrix; -1 where unknown.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).spectrum().geometric[:3].tolist()
    /// [1, 2, 2]
    #[getter]
    fn geometric<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        self.integers(py, "geometric")
    }

    /// The sizes of each eigenvalue's Jordan blocks, such as ``"2+1"``, in one of two conjugate Fourier
    /// blocks; None where there are as many eigenvectors as the multiplicity.
    ///
    /// >>> import eigenring
    /// >>> set(eigenring.Scheme("catmull-clark").at(5).spectrum(rings=1).jordan)
    /// {None}
    #[getter]
    fn jordan(&self) -> Vec<Option<String>> {
        self.repeated(|row| row["jordan"].as_str().map(str::to_owned))
    }

    /// lambda, the modulus of the subdominant eigenvalue with its sign if it is real.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(4).spectrum().subdominant
    /// 0.5
    #[getter]
    fn subdominant(&self) -> Option<f64> {
        self.head("subdominant")
    }

    /// mu, the next after lambda.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(4).spectrum().subsubdominant
    /// 0.25
    #[getter]
    fn subsubdominant(&self) -> Option<f64> {
        self.head("subsubdominant")
    }

    /// mu / lambda^2: 1 for bounded curvature that does not vanish.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(4).spectrum().s
    /// 1.0
    #[getter]
    fn s(&self) -> Option<f64> {
        self.head("s")
    }

    /// The valence, if it is known.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).spectrum().valence
    /// 5
    #[getter]
    fn valence(&self) -> Option<usize> {
        match &self.of {
            Of::Scheme(analysis) => Some(analysis.system.valence()),
            Of::Matrix(given) => given.rotation().map(|rotation| rotation.valence),
        }
    }

    /// The number of control points.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).spectrum(rings=1).points
    /// 11
    #[getter]
    fn points(&self) -> usize {
        match &self.of {
            Of::Scheme(analysis) => analysis.system.numbering().count(),
            Of::Matrix(given) => given.matrix().rows(),
        }
    }

    /// What the list does not say by itself.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).spectrum(rings=1).notes
    /// []
    #[getter]
    fn notes(&self) -> Vec<String> {
        match &self.of {
            Of::Scheme(analysis) => analysis.notes(),
            Of::Matrix(given) => given.notes(),
        }
    }

    /// Everything, as ``eigenring spectrum --format json`` prints it.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).spectrum().json()["eigenvalues"][0]["re"]
    /// 1.0
    fn json<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        values::object(py, &Value::Object(self.object()))
    }

    fn __len__(&self) -> usize {
        self.points()
    }

    fn __repr__(&self) -> String {
        let valence = self
            .valence()
            .map_or(String::new(), |valence| format!(", N = {valence}"));
        let lambda = self
            .subdominant()
            .map_or(String::new(), |lambda| format!(", lambda = {lambda:.6}"));
        format!("<Spectrum of {} points{valence}{lambda}>", self.points())
    }
}

/// Right and left eigenvectors: ``matrix @ right[:, j]`` is ``eigenvalues[j] * right[:, j]``, and ``left.T @
/// right`` is the identity. In a chain each further vector is mapped to its multiple plus the one before.
///
/// >>> import eigenring, numpy
/// >>> v = eigenring.Scheme("catmull-clark").at(5).eigenvectors(rings=1)
/// >>> bool(abs(v.left.T @ v.right - numpy.eye(11)).max() < 1e-10)
/// True
#[pyclass(frozen, module = "eigenring")]
#[derive(Debug)]
pub struct Eigenvectors {
    values: Vec<Complex64>,
    fourier: Vec<i64>,
    right: Vec<Vec<Complex64>>,
    left: Vec<Vec<Complex64>>,
    chains: Vec<Vec<usize>>,
    json: Value,
}

impl Eigenvectors {
    /// What was found.
    pub fn new(found: &eigenvectors::Eigenvectors<'_>) -> Self {
        let all = |vector: &[eigenring_scheme::Complex<f64>]| vector.iter().map(|&entry| complex(entry)).collect();
        Eigenvectors {
            values: found.vectors.iter().map(|vector| complex(vector.value)).collect(),
            fourier: found
                .vectors
                .iter()
                .map(|v| v.fourier.map_or(-1, |index| index as i64))
                .collect(),
            right: found.vectors.iter().map(|vector| all(&vector.right)).collect(),
            left: found.vectors.iter().map(|vector| all(&vector.left)).collect(),
            chains: found.chains.clone(),
            json: found.json(),
        }
    }

    fn columns<'py>(&self, py: Python<'py>, vectors: &[Vec<Complex64>]) -> PyResult<Bound<'py, PyAny>> {
        let n = vectors.len();
        let entry = |place: usize| vectors[place % n][place / n];
        if self.values.iter().all(|value| value.im == 0.0) {
            // no negative zeros, as in the command's JSON
            let entries = (0..n * n).map(|place| entry(place).re + 0.0).collect();
            return Ok(values::shaped::<f64>(py, entries, &[n, n])?.into_any());
        }
        Ok(values::shaped(py, (0..n * n).map(entry).collect(), &[n, n])?.into_any())
    }
}

#[pymethods]
impl Eigenvectors {
    /// complex128 of shape (points,), one for each column.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).eigenvectors().eigenvalues[0].real.round(12).tolist()
    /// 1.0
    #[getter]
    fn eigenvalues<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<Complex64>> {
        PyArray1::from_slice(py, &self.values)
    }

    /// int64: the Fourier index of each column; -1 without blocks.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).eigenvectors().fourier[:3].tolist()
    /// [0, 1, 1]
    #[getter]
    fn fourier<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        PyArray1::from_slice(py, &self.fourier)
    }

    /// Right eigenvectors as columns: float64 of shape (points, points), complex128 if an eigenvalue is not
    /// real.
    ///
    /// >>> import eigenring
    /// >>> v = eigenring.Scheme("catmull-clark").at(5).eigenvectors(rings=1).right
    /// >>> bool(abs(v[:, 0] / v[0, 0] - 1).max() < 1e-12)
    /// True
    #[getter]
    fn right<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.columns(py, &self.right)
    }

    /// Left eigenvectors as columns, in the same shape.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).eigenvectors(rings=1).left.shape
    /// (11, 11)
    #[getter]
    fn left<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.columns(py, &self.left)
    }

    /// The columns of each Jordan chain longer than one, the eigenvector first.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).eigenvectors(rings=1).chains
    /// []
    #[getter]
    fn chains(&self) -> Vec<Vec<usize>> {
        self.chains.clone()
    }

    /// Everything, as ``eigenring eigenvectors`` prints it.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).eigenvectors().json()["points"][0]["name"]
    /// 'V'
    fn json<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        values::object(py, &self.json)
    }
}

/// Weights of all points, in the order of :meth:`At.points`: float64 of shape (points,), or None where
/// undefined.
///
/// >>> import eigenring
/// >>> stencils = eigenring.Scheme("catmull-clark").at(5).limit_stencils()
/// >>> float(stencils.position.sum().round(12)), float(abs(stencils.tangent_x.sum()).round(12))
/// (1.0, 0.0)
#[pyclass(frozen, module = "eigenring")]
#[derive(Debug)]
pub struct LimitStencils {
    weights: [Option<Vec<f64>>; 3],
    missing: Vec<String>,
}

impl LimitStencils {
    /// From the command's JSON.
    pub fn new(json: &Value) -> Self {
        let numbers = |name: &str| {
            let entries = json[name].as_array()?.iter();
            entries.map(Value::as_f64).collect::<Option<Vec<f64>>>()
        };
        let missing = json["missing"].as_array().into_iter().flatten();
        LimitStencils {
            weights: ["position", "tangent_x", "tangent_y"].map(numbers),
            missing: missing.filter_map(|text| Some(text.as_str()?.to_owned())).collect(),
        }
    }

    fn array<'py>(&self, py: Python<'py>, which: usize) -> Option<Bound<'py, PyArray1<f64>>> {
        Some(PyArray1::from_slice(py, self.weights[which].as_ref()?))
    }
}

#[pymethods]
impl LimitStencils {
    /// Of the limit point of the centre; they sum to 1.
    ///
    /// >>> import eigenring
    /// >>> float(eigenring.Scheme("catmull-clark").at(5).limit_stencils().position[0].round(12))
    /// 0.5
    #[getter]
    fn position<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.array(py, 0)
    }

    /// Of the first tangent; they sum to 0.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).limit_stencils().tangent_x.dtype
    /// dtype('float64')
    #[getter]
    fn tangent_x<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.array(py, 1)
    }

    /// Of the second tangent; they sum to 0.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).limit_stencils().tangent_y.dtype
    /// dtype('float64')
    #[getter]
    fn tangent_y<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.array(py, 2)
    }

    /// Why stencils are not defined.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).limit_stencils().missing
    /// []
    #[getter]
    fn missing(&self) -> Vec<String> {
        self.missing.clone()
    }
}

/// Control points in the plane that refinement maps to lambda times themselves; the first point of ring 1 is
/// (1, 0).
///
/// >>> import eigenring
/// >>> at = eigenring.Scheme("catmull-clark").at(5)
/// >>> natural = at.natural_configuration(rings=1)
/// >>> bool(abs(at.matrix(1) @ natural.points - natural.value * natural.points).max() < 1e-12)
/// True
#[pyclass(frozen, module = "eigenring")]
#[derive(Debug)]
pub struct NaturalConfiguration(pub Natural);

#[pymethods]
impl NaturalConfiguration {
    /// lambda.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(4).natural_configuration().value
    /// 0.5
    #[getter]
    fn value(&self) -> f64 {
        self.0.lambda
    }

    /// float64 of shape (points, 2), in the order of :meth:`At.points`.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(4).natural_configuration(rings=1).points.shape
    /// (9, 2)
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> Result<Bound<'py, PyArrayDyn<f64>>, Failure> {
        let [x, y] = &self.0.points;
        let entries: Vec<f64> = x.iter().zip(y).flat_map(|(&x, &y)| [x, y]).collect();
        Ok(values::shaped(py, entries, &[x.len(), 2])?)
    }
}
