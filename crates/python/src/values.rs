//! Numbers in and out: arrays that are refused where they are not what is asked for, and JSON as Python's own
//! objects, so that they are what the command prints.

use crate::failure::Failure;
use eigenring_atlas::table::Table;
use eigenring_scheme::Complex;
use eigenring_spectral::Matrix;
use numpy::{Complex64, PyArray1, PyArray2, PyArrayDyn, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyInt, PyList};
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

/// Entries of a float64 array of `columns` columns, checked; lists of numbers are made one.
///
/// # Errors
/// What is no such array, or holds numbers that are not finite.
pub fn rows(given: &Bound<'_, PyAny>, what: &str, columns: Option<usize>) -> Result<(Vec<f64>, usize, usize), Failure> {
    let accepted = match columns {
        Some(columns) => format!("a C-contiguous float64 array of shape (n, {columns}) with finite entries"),
        None => "a C-contiguous float64 array of shape (n, m) with finite entries".to_owned(),
    };
    let py = given.py();
    let refuse = |reason: String| Failure::usage(format!("{what}: {reason}"), accepted.clone());
    let array = match given.cast::<PyUntypedArray>() {
        Ok(array) => array.clone(),
        // a list of lists; what is ragged or no number is refused by numpy
        Err(_) => py
            .import("numpy")?
            .call_method1("asarray", (given, "float64"))
            .map_err(|error| refuse(error.value(py).to_string()))?
            .cast_into::<PyUntypedArray>()
            .map_err(PyErr::from)?,
    };
    let shape = array.shape().to_vec();
    if shape.len() != 2 || columns.is_some_and(|columns| columns != shape[1]) {
        return Err(refuse(format!("the shape is {shape:?}")));
    }
    let Ok(array) = array.cast::<PyArray2<f64>>() else {
        return Err(refuse(format!("the type of the entries is {}", array.dtype())));
    };
    if !array.is_c_contiguous() {
        return Err(refuse("the array is not contiguous".to_owned()));
    }
    let entries = array.to_vec().map_err(|error| refuse(error.to_string()))?;
    if let Some(place) = entries.iter().position(|x| !x.is_finite()) {
        let (row, column) = (place / shape[1], place % shape[1]);
        return Err(refuse(format!("the entry [{row}, {column}] is {}", entries[place])));
    }
    Ok((entries, shape[0], shape[1]))
}

/// Whole numbers, an integer array of any width or a list.
///
/// # Errors
/// What is no whole number from 0 to 2^32 - 2.
pub fn indices(given: &Bound<'_, PyAny>, what: &str) -> Result<Vec<u32>, Failure> {
    let refuse = |reason: String| Failure::usage(format!("{what}: {reason}"), "whole numbers from 0 on");
    if let Ok(array) = given.cast::<PyUntypedArray>() {
        let kind: String = array.dtype().getattr("kind")?.extract()?;
        if kind != "i" && kind != "u" {
            return Err(refuse(format!("the type of the entries is {}", array.dtype())));
        }
        if array.ndim() != 1 {
            return Err(refuse(format!("the shape is {:?}", array.shape())));
        }
        let wide = array.call_method1("astype", ("int64",))?;
        let wide = wide.cast_into::<PyArray1<i64>>().map_err(PyErr::from)?;
        let entries = wide.to_vec().map_err(|error| refuse(error.to_string()))?;
        return entries
            .into_iter()
            .map(|index| {
                let small = u32::try_from(index).ok().filter(|&index| index < u32::MAX);
                small.ok_or_else(|| refuse(index.to_string()))
            })
            .collect();
    }
    let mut found = Vec::new();
    for item in given.try_iter().map_err(|_| refuse("no list".to_owned()))? {
        found.push(whole(&item?, what)?);
    }
    Ok(found)
}

/// One whole number; numpy's integers are ones, True and 3.0 are not.
///
/// # Errors
/// What is no whole number from 0 to 2^32 - 2.
pub fn whole(given: &Bound<'_, PyAny>, what: &str) -> Result<u32, Failure> {
    let refuse = || {
        let shown = given.repr().map_or_else(|_| "?".to_owned(), |text| text.to_string());
        Failure::usage(format!("{what} {shown} is no whole number"), "whole numbers from 0 on")
    };
    if given.is_instance_of::<PyBool>() {
        return Err(refuse());
    }
    let index = given.call_method0("__index__").map_err(|_| refuse())?;
    let index = index.cast::<PyInt>().map_err(|_| refuse())?.extract::<u32>();
    index.ok().filter(|&index| index < u32::MAX).ok_or_else(refuse)
}

/// One number or many: a one-dimensional float64 array, a list, or a number.
///
/// # Errors
/// What is none, or holds numbers that are not finite.
pub fn numbers(given: &Bound<'_, PyAny>, what: &str) -> Result<Vec<f64>, Failure> {
    let accepted = "finite numbers, as a C-contiguous float64 array of shape (n,) or a list";
    let refuse = |reason: String| Failure::usage(format!("{what}: {reason}"), accepted);
    let entries = match given.cast::<PyUntypedArray>() {
        Ok(array) => {
            let Ok(array) = array.cast::<PyArray1<f64>>() else {
                let reason = format!("the type is {}, the shape {:?}", array.dtype(), array.shape());
                return Err(refuse(reason));
            };
            if !array.is_c_contiguous() {
                return Err(refuse("the array is not contiguous".to_owned()));
            }
            array.to_vec().map_err(|error| refuse(error.to_string()))?
        }
        Err(_) => match given.extract::<f64>() {
            Ok(number) => vec![number],
            Err(_) => given
                .extract::<Vec<f64>>()
                .map_err(|_| refuse("no numbers".to_owned()))?,
        },
    };
    match entries.iter().position(|x| !x.is_finite()) {
        Some(place) => Err(refuse(format!("the entry {place} is {}", entries[place]))),
        None => Ok(entries),
    }
}

/// Whole numbers: as many as are given, or one that stands for `count`.
///
/// # Errors
/// As [`indices`].
pub fn whole_or_many(given: &Bound<'_, PyAny>, what: &str, count: usize) -> Result<Vec<u32>, Failure> {
    let many = given.cast::<PyUntypedArray>().is_ok_and(|array| array.ndim() > 0) || given.is_instance_of::<PyList>();
    match many {
        true => indices(given, what),
        false => Ok(vec![whole(given, what)?; count]),
    }
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
