//! Limit points as arrays.

use crate::failure::Failure;
use crate::pickle::{self, Reduced};
use crate::values;
use eigenring_atlas::limits::{Columns, KINDS};
use numpy::{PyArray1, PyArrayDyn};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBytes, PyList, PyString};

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
    kinds: Vec<u8>,
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
            let words = KINDS.map(|word| PyString::new(py, word));
            let names = self.kinds.iter().map(|&kind| words[usize::from(kind)].clone());
            Ok::<_, PyErr>(PyList::new(py, names.collect::<Vec<_>>())?.unbind())
        });
        Ok(list?.clone_ref(py))
    }

    #[staticmethod]
    #[allow(clippy::too_many_arguments)]
    fn _of(
        points: Py<PyArrayDyn<f64>>,
        first: Py<PyArrayDyn<f64>>,
        second: Py<PyArrayDyn<f64>>,
        normals: Py<PyArrayDyn<f64>>,
        gauss: Py<PyArray1<f64>>,
        mean: Py<PyArray1<f64>>,
        principal: Py<PyArrayDyn<f64>>,
        kinds: Vec<u8>,
    ) -> Result<Self, Failure> {
        if let Some(kind) = kinds.iter().find(|kind| usize::from(**kind) >= KINDS.len()) {
            return Err(Failure::usage(format!("a kind is {kind}"), "0 to 4"));
        }
        Ok(Limits {
            points,
            first,
            second,
            normals,
            gauss,
            mean,
            principal,
            kinds,
            listed: PyOnceLock::new(),
        })
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let arguments = (
            &self.points,
            &self.first,
            &self.second,
            &self.normals,
            &self.gauss,
            &self.mean,
            &self.principal,
            PyBytes::new(py, &self.kinds),
        );
        pickle::reduced(py, "limit_points", arguments)
    }
}
