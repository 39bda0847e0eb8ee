//! What is handed out: arrays that take over the memory of results, and JSON as Python's own objects, so that
//! they are what the command prints.

use eigenring_atlas::table::Table;
use eigenring_scheme::Complex;
use eigenring_spectral::Matrix;
use numpy::{Complex64, PyArray1, PyArray2, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;

/// JSON as dict, list, str, int, float, bool, None.
pub fn object<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    parsed(py, &value.to_string())
}

/// The same of text.
pub fn parsed<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (text,))
}

/// A rectangular array from its entries, the last index fastest.
pub fn shaped<'py, T: numpy::Element>(
    py: Python<'py>,
    entries: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    PyArray1::from_vec(py, entries).reshape(numpy::ndarray::IxDyn(shape))
}

/// A matrix as an array of two dimensions.
pub fn matrix<'py>(py: Python<'py>, matrix: &Matrix<f64>) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let rows = (0..matrix.rows()).flat_map(|i| matrix.row(i).to_vec()).collect();
    PyArray1::from_vec(py, rows).reshape([matrix.rows(), matrix.columns()])
}

/// A complex number as numpy has it.
pub fn complex(value: Complex<f64>) -> Complex64 {
    Complex64::new(value.re, value.im)
}

/// A table as a dict of columns, each a list.
pub fn columns<'py>(py: Python<'py>, table: &Table) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    let rows = table.json();
    let rows = rows.as_array().map_or(&[][..], Vec::as_slice);
    for name in table.columns() {
        let column = rows.iter().map(|row| row[name].clone()).collect();
        found.set_item(name, object(py, &Value::Array(column))?)?;
    }
    Ok(found)
}
