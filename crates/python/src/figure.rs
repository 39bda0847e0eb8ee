//! Figures of the command, and rendered pictures.

use crate::failure::Failure;
use crate::input::{self, Real, Text};
use crate::mesh::Named;
use crate::{values, work};
use eigenring_atlas::figures::{Drawing, Inputs, Studies, find};
use eigenring_atlas::schemes::{SchemeName, Tuner};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::borrow::Cow;

/// A figure with its data; notebooks show it as SVG.
///
/// >>> import eigenring
/// >>> [figure] = eigenring.figure("natural-configurations", schemes=["catmull-clark"], valences=[5])
/// >>> figure.name, figure.svg()[:4]
/// ('natural-configurations', '<svg')
#[pyclass(frozen, module = "eigenring")]
#[derive(Debug)]
pub struct Figure {
    drawing: Drawing,
}

#[pymethods]
impl Figure {
    /// What its files are called.
    ///
    /// >>> import eigenring
    /// >>> eigenring.figure("natural-configurations", valences=[5])[0].name
    /// 'natural-configurations'
    #[getter]
    fn name(&self) -> &str {
        &self.drawing.stem
    }

    /// The picture as SVG.
    ///
    /// >>> import eigenring
    /// >>> eigenring.figure("natural-configurations", valences=[5])[0].svg().startswith("<svg")
    /// True
    fn svg(&self) -> Result<String, Failure> {
        Ok(self.drawing.figure.svg().map_err(eigenring_atlas::Error::from)?)
    }

    fn _repr_svg_(&self) -> Result<String, Failure> {
        self.svg()
    }

    /// The picture as PNG, in dots per inch from 10 to 2400.
    ///
    /// >>> import eigenring
    /// >>> eigenring.figure("natural-configurations", valences=[5])[0].png(dpi=50)[1:4]
    /// b'PNG'
    #[pyo3(signature = (dpi = Real::of(300.0)), text_signature = "($self, dpi=300.0)")]
    fn png<'py>(slf: &Bound<'py, Self>, dpi: Real) -> Result<Bound<'py, PyBytes>, Failure> {
        let dpi = dpi.such("dpi", "10 to 2400", |dpi| (10.0..=2400.0).contains(&dpi))?;
        let figure = slf.clone().unbind();
        let bytes = work::alone(slf.py(), true, move || {
            let drawn = figure.get().drawing.figure.png(dpi);
            Ok(drawn.map_err(eigenring_atlas::Error::from)?)
        })?;
        Ok(PyBytes::new(slf.py(), &bytes))
    }

    /// What it shows, as tables of columns: a dict of dicts of lists.
    ///
    /// >>> import eigenring
    /// >>> tables = eigenring.figure("natural-configurations", valences=[5])[0].data()
    /// >>> all(len(table) > 1 for table in tables.values())
    /// True
    fn data<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let tables = PyDict::new(py);
        for (name, table) in &self.drawing.data {
            tables.set_item(*name, values::columns(py, table)?)?;
        }
        Ok(tables)
    }

    fn __repr__(&self) -> String {
        format!("<Figure {}>", self.drawing.stem)
    }
}

/// A rendered picture; notebooks show it.
///
/// >>> import eigenring
/// >>> square = eigenring.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
/// >>> square.render("catmull-clark", size=64)
/// <Picture>
#[pyclass(frozen, module = "eigenring")]
#[derive(Debug)]
pub struct Picture {
    /// PNG.
    pub bytes: Vec<u8>,
}

#[pymethods]
impl Picture {
    /// The picture as PNG.
    ///
    /// >>> import eigenring
    /// >>> square = eigenring.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    /// >>> square.render("catmull-clark", size=64).png()[1:4]
    /// b'PNG'
    fn png<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.bytes)
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        self.png(py)
    }

    fn __repr__(&self) -> &'static str {
        "<Picture>"
    }
}

/// Figures by the names of ``eigenring plot``, with their own valences, schemes and lambdas where none are
/// given. Those that need the studies of the lambda-scheme compute them, some seconds for each valence.
///
/// >>> import eigenring
/// >>> eigenring.figure("characteristic-map", schemes=["catmull-clark"], valences=[5])
/// [<Figure characteristic-map>]
#[pyfunction]
#[pyo3(signature = (name, *, schemes = None, valences = None, lambdas = None, progress = None))]
pub fn figure(
    py: Python<'_>,
    name: Text,
    schemes: Option<Vec<Named<'_>>>,
    valences: Option<&Bound<'_, PyAny>>,
    lambdas: Option<&Bound<'_, PyAny>>,
    progress: Option<Py<PyAny>>,
) -> Result<Vec<Figure>, Failure> {
    let name = name.get("a figure")?;
    let entry = find(&name)?;
    let valences = valences.map(|given| input::valences(given)).transpose()?;
    let lambdas = lambdas.map(|given| input::numbers(given, "lambdas")).transpose()?;
    let refuse = |what: &str| {
        Err(Failure::usage(
            format!("figure {name} takes no {what}"),
            format!("{name} without them"),
        ))
    };
    if valences.is_some() && entry.valences.is_empty() {
        return refuse("valences");
    }
    if schemes.is_some() && entry.schemes.is_none() {
        return refuse("schemes");
    }
    if lambdas.is_some() && entry.lambdas.is_empty() {
        return refuse("lambdas");
    }
    let kept: Option<Vec<_>> = schemes
        .map(|all| all.iter().map(|one| one.scheme(py)).collect())
        .transpose()?;
    let names: Vec<SchemeName> = match &kept {
        Some(kept) => kept
            .iter()
            .map(|one| Ok(one.get().name()?.clone()))
            .collect::<Result<_, Failure>>()?,
        None => entry.default_schemes()?,
    };
    let drawings = work::run(py, progress, move |reporter| {
        let _kept = kept;
        let valences = valences.map_or(Cow::Borrowed(entry.valences), Cow::Owned);
        let lambdas = lambdas.map_or(Cow::Borrowed(entry.lambdas), Cow::Owned);
        let tuner = Tuner {
            progress: reporter,
            ..Tuner::default()
        };
        let needed: &[usize] = if entry.studies { &valences } else { &[] };
        let inputs = Inputs {
            valences: &valences,
            lambdas: &lambdas,
            schemes: &names,
            colours: entry.colours,
            range: (0.15, 0.9),
            width: entry.width,
            sweep: None,
            knots: None,
            studies: &Studies::load(None, needed, reporter)?,
            tuner: &tuner,
        };
        Ok((entry.build)(&inputs)?)
    })?;
    Ok(drawings.into_iter().map(|drawing| Figure { drawing }).collect())
}
