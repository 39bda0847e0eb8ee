//! Limit points as arrays.

use crate::failure::Failure;
use crate::values;
use eigenring_atlas::limits::Columns;
use eigenring_surface::Kind;
use numpy::{PyArray1, PyArrayDyn};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyList, PyString};

/// Limit points, as arrays with a row for each; NaN where something does not exist.
///
/// >>> import eigenring
/// >>> square = eigenring.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
/// >>> found = square.limit("catmull-clark", [0, 0], [0.5, 0.25], [0.5, 0.25])
/// >>> found.normals[:, 2].round(12).tolist(), found.kinds
/// ([1.0, 1.0], ['regular', 'regular'])
#[pyclass(frozen, module = "eigenring", name = "LimitPoints")]
pub struct Limits {
    /// float64 of shape (n, 3).
    #[pyo3(get)]
    points: Py<PyArrayDyn<f64>>,
    /// float64 of shape (n, 2, 3): derivatives by u and v.
    #[pyo3(get)]
    first: Py<PyArrayDyn<f64>>,
    /// float64 of shape (n, 3, 3): derivatives by uu, uv, vv.
    #[pyo3(get)]
    second: Py<PyArrayDyn<f64>>,
    /// float64 of shape (n, 3): unit normals.
    #[pyo3(get)]
    normals: Py<PyArrayDyn<f64>>,
    /// float64 of shape (n,): Gauss curvature.
    #[pyo3(get)]
    gauss: Py<PyArray1<f64>>,
    /// float64 of shape (n,): mean curvature, negative on a sphere with outward normal.
    #[pyo3(get)]
    mean: Py<PyArray1<f64>>,
    /// float64 of shape (n, 2): principal curvatures, the smaller first.
    #[pyo3(get)]
    principal: Py<PyArrayDyn<f64>>,
    kinds: Vec<Kind>,
    listed: PyOnceLock<Py<PyList>>,
}

impl Limits {
    pub fn new(py: Python<'_>, columns: Columns) -> Result<Self, Failure> {
        let n = columns.kinds.len();
        Ok(Limits {
            points: values::shaped(py, columns.points, &[n, 3])?.unbind(),
            first: values::shaped(py, columns.first, &[n, 2, 3])?.unbind(),
            second: values::shaped(py, columns.second, &[n, 3, 3])?.unbind(),
            normals: values::shaped(py, columns.normals, &[n, 3])?.unbind(),
            gauss: PyArray1::from_vec(py, columns.gauss).unbind(),
            mean: PyArray1::from_vec(py, columns.mean).unbind(),
            principal: values::shaped(py, columns.principal, &[n, 2])?.unbind(),
            kinds: columns.kinds,
            listed: PyOnceLock::new(),
        })
    }
}

#[pymethods]
impl Limits {
    /// What the surface is like: regular, flat, bounded, unbounded, not defined.
    #[getter]
    fn kinds(&self, py: Python<'_>) -> PyResult<Py<PyList>> {
        // few words for many points: each is one string
        let list = self.listed.get_or_try_init(py, || {
            let names = self.kinds.iter().map(|kind| PyString::intern(py, kind.name()));
            Ok::<_, PyErr>(PyList::new(py, names.collect::<Vec<_>>())?.unbind())
        });
        Ok(list?.clone_ref(py))
    }
}
