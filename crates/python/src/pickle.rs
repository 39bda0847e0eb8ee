//! How objects are pickled: as a function of `eigenring._rebuild` and what it takes, all of it plain data, so
//! that they cross over to other processes and computers.

use crate::failure::Failure;
use eigenring_atlas::schemes::SchemeName;
use eigenring_scheme::Shape;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::collections::BTreeMap;

/// What `__reduce__` returns.
pub type Reduced<'py> = (Bound<'py, PyAny>, Bound<'py, PyTuple>);

/// A function of `eigenring._rebuild` with its arguments.
pub fn reduced<'py>(
    py: Python<'py>,
    function: &str,
    arguments: impl IntoPyObject<'py, Target = PyTuple, Output = Bound<'py, PyTuple>, Error = PyErr>,
) -> PyResult<Reduced<'py>> {
    let function = py.import("eigenring._rebuild")?.getattr(function)?;
    Ok((function, arguments.into_pyobject(py)?))
}

/// A scheme as text, with values of its parameters: a file by what it holds, which others need not have.
pub fn plain(name: &SchemeName) -> Result<(String, BTreeMap<String, String>), Failure> {
    match name {
        SchemeName::Spec(spec) => Ok((spec.to_string(), BTreeMap::new())),
        SchemeName::NonUniform(scheme) => Ok((scheme.to_string(), BTreeMap::new())),
        SchemeName::File(file) => {
            let mut text = eigenring_atlas::files::read(&file.path)?;
            // by its lines a text is told from a name
            if !text.contains('\n') {
                text.push('\n');
            }
            let values = file.values.iter();
            Ok((
                text,
                values.map(|(name, value)| (name.clone(), value.to_string())).collect(),
            ))
        }
    }
}

/// A corner by the function that makes it; none for knots.
pub fn corner(shape: &Shape) -> Option<(&'static str, usize, bool)> {
    match *shape {
        Shape::Closed { sectors } => Some(("closed", sectors, false)),
        Shape::Fan { faces, corner } => Some(("fan", faces, corner)),
        Shape::Dart { valence } => Some(("dart", valence, false)),
        Shape::Cusp { valence } => Some(("cusp", valence, false)),
        Shape::Knots { .. } => None,
    }
}
