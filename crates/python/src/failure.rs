//! What is raised: `eigenring.Error` with the message of the libraries and what is accepted.

use eigenring_atlas as atlas;
use pyo3::PyTypeInfo;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

/// Why a call fails.
#[derive(Debug)]
pub enum Failure {
    /// Python's own reasons: an interrupt, an exception of a callback.
    Python(PyErr),
    /// The libraries' reasons.
    Refused(Box<atlas::Error>),
}

impl Failure {
    /// A value that is not accepted.
    pub fn usage(message: impl Into<String>, accepted: impl Into<String>) -> Self {
        atlas::Error::Usage {
            message: message.into(),
            accepted: accepted.into(),
        }
        .into()
    }
}

impl From<PyErr> for Failure {
    fn from(error: PyErr) -> Self {
        Failure::Python(error)
    }
}

impl From<atlas::Error> for Failure {
    fn from(error: atlas::Error) -> Self {
        Failure::Refused(Box::new(error))
    }
}

macro_rules! refused {
    ($($name:ty),*) => {
        $(impl From<$name> for Failure {
            fn from(error: $name) -> Self {
                atlas::Error::from(error).into()
            }
        })*
    };
}

refused!(
    eigenring_certify::Error,
    eigenring_scheme::Error,
    eigenring_spectral::Error,
    eigenring_surface::Error
);

/// The class is written in Python: only there can a class extend `ValueError` in every version of the
/// interpreter that one wheel serves.
fn class(py: Python<'_>) -> PyResult<&Bound<'_, PyType>> {
    static CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    CLASS.import(py, "eigenring._error", "Error")
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        let error = match failure {
            Failure::Python(error) => return error,
            Failure::Refused(error) => error,
        };
        Python::attach(|py| {
            let class = class(py).unwrap_or(&PyValueError::type_object(py)).clone();
            // what was given may have lines of its own
            let message = error.to_string().replace('\n', "\\n");
            PyErr::from_type(class, (message, error.accepted()))
        })
    }
}
