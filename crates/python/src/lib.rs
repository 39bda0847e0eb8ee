//! The native part of the Python package `eigenring`. It holds no algorithm: what is computed is computed by
//! the library behind the command, and what is checked here are the types and shapes that come from Python.

mod at;
mod failure;
mod figure;
mod foreign;
mod input;
mod limit_points;
mod maps;
mod mesh;
mod pickle;
mod proofs;
mod scheme;
mod solve;
mod spectrum;
mod tuning;
mod values;
mod work;

use pyo3::prelude::*;

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<scheme::Scheme>()?;
    module.add_class::<scheme::Corner>()?;
    module.add_class::<at::At>()?;
    module.add_class::<spectrum::Spectrum>()?;
    module.add_class::<spectrum::Eigenvectors>()?;
    module.add_class::<spectrum::LimitStencils>()?;
    module.add_class::<spectrum::NaturalConfiguration>()?;
    module.add_class::<maps::CharacteristicMap>()?;
    module.add_class::<maps::SecondOrderMaps>()?;
    module.add_class::<maps::Sample>()?;
    module.add_class::<proofs::Certificate>()?;
    module.add_class::<mesh::Mesh>()?;
    module.add_class::<limit_points::Limits>()?;
    module.add_class::<figure::Figure>()?;
    module.add_class::<figure::Picture>()?;
    module.add_class::<tuning::Tuned>()?;
    module.add_function(wrap_pyfunction!(figure::figure, module)?)?;
    module.add_function(wrap_pyfunction!(tuning::tune, module)?)?;
    module.add_function(wrap_pyfunction!(tuning::lambda_table, module)?)?;
    module.add_function(wrap_pyfunction!(tuning::table_columns, module)?)?;
    Ok(())
}
