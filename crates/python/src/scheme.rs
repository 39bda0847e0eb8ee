//! Schemes, and the corners at which they are looked at.

use crate::at::{At, Source};
use crate::failure::Failure;
use crate::input::{self, Text, Whole};
use crate::pickle::{self, Reduced};
use crate::{values, work};
use eigenring_atlas::given::Given;
use eigenring_atlas::schemes::{SchemeFile, SchemeName};
use eigenring_scheme::Shape;
use eigenring_spectral::Matrix;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[derive(Clone, Debug)]
enum What {
    Named(SchemeName),
    Matrix(Arc<Matrix<f64>>),
}

/// A subdivision scheme.
///
/// ``Scheme(spec)`` takes a name of the command such as ``"catmull-clark"``, ``"lambda:optimal"`` or
/// ``"tension:order=6,u0=2"``, the path of a scheme file (``.toml``), or the text of one.
///
/// >>> import eigenring
/// >>> scheme = eigenring.Scheme("catmull-clark")
/// >>> scheme.at(5).spectrum().eigenvalues[:2].real.round(6).tolist()
/// [1.0, 0.549988]
#[pyclass(frozen, module = "eigenring")]
#[derive(Debug)]
pub struct Scheme {
    what: What,
    /// The folder of a file whose text was given, as long as somebody needs it.
    written: Option<Arc<tempfile::TempDir>>,
}

/// A path without quotes is cut at its first comma.
fn of_file(path: &Path) -> SchemeName {
    SchemeName::File(SchemeFile {
        path: path.to_owned(),
        values: Vec::new(),
    })
}

impl Scheme {
    /// The name by which the libraries know it.
    ///
    /// # Errors
    /// A scheme that is a matrix has none.
    pub fn name(&self) -> Result<&SchemeName, Failure> {
        match &self.what {
            What::Named(name) => Ok(name),
            What::Matrix(_) => Err(Failure::usage(
                "a matrix has no rules",
                "a scheme by name or from a file; a matrix has at() with spectrum() and matrix()",
            )),
        }
    }

    fn of_text(text: &str) -> Result<Self, Failure> {
        let write = || -> std::io::Result<(PathBuf, tempfile::TempDir)> {
            let folder = tempfile::Builder::new().prefix("eigenring-").tempdir()?;
            let path = folder.path().join("scheme.toml");
            std::fs::write(&path, text)?;
            Ok((path, folder))
        };
        let (path, folder) = write().map_err(PyErr::from)?;
        Ok(Scheme {
            what: What::Named(of_file(&path)),
            written: Some(Arc::new(folder)),
        })
    }
}

#[pymethods]
impl Scheme {
    #[new]
    pub fn new(spec: &Bound<'_, PyAny>) -> Result<Self, Failure> {
        if !spec.is_instance_of::<PyString>() {
            let path: PathBuf = spec.extract().map_err(|_| {
                let message = format!("a scheme is given as {}", input::shown(spec));
                Failure::usage(message, "a name, the path of a scheme file, or its text")
            })?;
            return Scheme::checked(of_file(&path));
        }
        let text = spec.extract::<Text>()?.get("a scheme")?;
        if text.contains('\n') {
            let scheme = Scheme::of_text(&text)?;
            // mistakes are told now
            scheme.name()?.centre()?;
            return Ok(scheme);
        }
        match text.parse::<SchemeName>() {
            Ok(name) => Scheme::checked(name),
            Err(_) if text.ends_with(".toml") => Scheme::checked(of_file(Path::new(&text))),
            Err(error) => Err(error.into()),
        }
    }

    /// A scheme from the weights of its rule: the tables of a scheme file as a dict.
    ///
    /// ``rule`` maps the names of weights to numbers or formulas in the valence ``n`` and the parameters;
    /// ``valences`` are those it holds for; ``parameters`` maps each to its default or a dict with
    /// ``default``, ``range``, ``doc``.
    ///
    /// >>> import eigenring
    /// >>> scheme = eigenring.Scheme.from_stencils(
    /// ...     dict(f1="1/4", f2="1/4", f3="1/4", d1="3/8", d2="3/8", e1="1/16", e2="1/16",
    /// ...          alpha="a/n", beta="1/(4*n)"),
    /// ...     name="mine", parameters={"a": {"default": "3/2", "range": ["0", "2"]}})
    /// >>> round(scheme.at(5).spectrum().subdominant, 6)
    /// 0.549988
    #[staticmethod]
    #[pyo3(signature = (rule, *, name = Text::of("stencils"), kind = Text::of("one-ring"), valences = Text::of("3.."), parameters = None), text_signature = "(rule, *, name='stencils', kind='one-ring', valences='3..', parameters=None)")]
    fn from_stencils(
        rule: &Bound<'_, PyDict>,
        name: Text,
        kind: Text,
        valences: Text,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> Result<Self, Failure> {
        let mut table = toml::Table::new();
        table.insert("name".to_owned(), name.get("name")?.into());
        table.insert("kind".to_owned(), kind.get("kind")?.into());
        let valences = valences.get("valences")?;
        if let Some(parameters) = parameters {
            let mut named = toml::Table::new();
            for (key, value) in parameters.iter() {
                let value = match toml_of(&value, "parameter")? {
                    table @ toml::Value::Table(_) => table,
                    default => toml::Value::Table([("default".to_owned(), default)].into_iter().collect()),
                };
                named.insert(key.extract::<Text>()?.get("the name of a parameter")?, value);
            }
            table.insert("parameters".to_owned(), named.into());
        }
        let toml::Value::Table(mut rule) = toml_of(rule.as_any(), "rule")? else {
            return Err(Failure::usage("the rule is no dict", "a dict of weights"));
        };
        rule.entry("n").or_insert_with(|| valences.into());
        table.insert("rule".to_owned(), rule.into());
        let scheme = Scheme::of_text(&table.to_string())?;
        scheme.name()?.centre()?;
        Ok(scheme)
    }

    /// A scheme that is known by one local matrix only: an (n, n) float64 array, rows are new points.
    ///
    /// The rotation of its points is found in all usual orders.
    ///
    /// >>> import eigenring
    /// >>> S = eigenring.Scheme("catmull-clark").at(5).matrix()
    /// >>> given = eigenring.Scheme.from_matrix(S)
    /// >>> round(given.at().spectrum().subdominant, 6)
    /// 0.549988
    #[staticmethod]
    fn from_matrix(array: &Bound<'_, PyAny>) -> Result<Self, Failure> {
        let (entries, rows, columns) = input::rows(array, "matrix", None)?;
        if rows != columns || rows == 0 {
            return Err(Failure::usage(
                format!("the matrix is {rows} x {columns}"),
                "square ones",
            ));
        }
        // the largest that the command's own matrices may be
        if entries.len() > 100_000_000 {
            return Err(Failure::usage(
                format!("the matrix is {rows} x {columns}"),
                "at most 10^8 entries",
            ));
        }
        Ok(Scheme::of_matrix(Matrix::from_fn(rows, columns, |i, j| {
            entries[i * columns + j]
        })))
    }

    /// The same scheme with values for parameters of its file.
    ///
    /// >>> import eigenring
    /// >>> scheme = eigenring.Scheme.from_stencils(
    /// ...     dict(f1="1/4", f2="1/4", f3="1/4", d1="3/8", d2="3/8", e1="1/16", e2="1/16",
    /// ...          alpha="a/n", beta="1/(4*n)"), parameters={"a": "3/2"})
    /// >>> scheme.set(a=1.25).at(5).spectrum().valence
    /// 5
    #[pyo3(signature = (**parameters))]
    fn set(&self, parameters: Option<&Bound<'_, PyDict>>) -> Result<Self, Failure> {
        let values = input::settings(parameters)?;
        let name = self.name()?.clone().setting(&values)?;
        name.definition(Default::default())
            .map(|_| ())
            .or_else(|error| match name {
                SchemeName::NonUniform(_) => Ok(()),
                _ => Err(error),
            })?;
        Ok(Scheme {
            what: What::Named(name),
            written: self.written.clone(),
        })
    }

    /// The scheme around a vertex or face of a valence, or another :class:`Corner`.
    ///
    /// ``knots`` are the intervals of the spokes' first edges and ``next`` those of all further ones
    /// (default: the same); ``cs`` is the number of smoothing steps on creases.
    ///
    /// >>> import eigenring
    /// >>> scheme = eigenring.Scheme("catmull-clark")
    /// >>> scheme.at(eigenring.Corner.fan(3))
    /// <At catmull-clark, fan, 3 sectors>
    #[pyo3(signature = (valence = None, knots = None, *, next = None, cs = None))]
    fn at(
        &self,
        py: Python<'_>,
        valence: Option<&Bound<'_, PyAny>>,
        knots: Option<&Bound<'_, PyAny>>,
        next: Option<&Bound<'_, PyAny>>,
        cs: Option<Whole>,
    ) -> Result<At, Failure> {
        let intervals = |given: Option<&Bound<'_, PyAny>>, what| given.map(|g| input::numbers(g, what)).transpose();
        let (knots, next) = (intervals(knots, "knots")?, intervals(next, "next")?);
        if let Some(knots) = &knots {
            Whole::of(knots.len() as u64).valence("the number of knots")?;
        }
        let cs = input::count(cs, "cs")?;
        if next.is_some() && knots.is_none() {
            return Err(Failure::usage("next without knots", "next beside knots"));
        }
        let corner = valence.and_then(|valence| valence.cast::<Corner>().ok());
        let number = match (valence, corner) {
            (Some(valence), None) => Some(valence.extract::<Whole>()?.valence("valence")?),
            _ => None,
        };
        if let What::Matrix(matrix) = &self.what {
            if corner.is_some() || knots.is_some() || cs.is_some() {
                return Err(Failure::usage("a matrix has one corner", "at() or at(valence)"));
            }
            let matrix = Arc::clone(matrix);
            let large = matrix.rows() > 100;
            let given = work::alone(py, large, move || Ok(Given::new("matrix", &matrix, number, None)?))?;
            return Ok(At::new(Source::Matrix(Arc::new(given))));
        }
        let name = self.name()?;
        let shape = match (corner, knots) {
            (Some(corner), None) => corner.get().shape.clone(),
            (Some(_), Some(_)) => return Err(Failure::usage("a corner with knots", "a valence with knots")),
            (None, Some(knots)) => {
                if number.is_some_and(|number| number != knots.len()) {
                    let message = format!(
                        "the valence is {}, and {} knots are given",
                        number.unwrap_or(0),
                        knots.len()
                    );
                    return Err(Failure::usage(message, "as many knots as the valence"));
                }
                let next = next.unwrap_or_else(|| knots.clone());
                Shape::Knots { intervals: knots, next }
            }
            (None, None) => match number.map_or_else(|| name.only_valence(), |number| Ok(Some(number)))? {
                Some(sectors) => Shape::Closed { sectors },
                None => return Err(Failure::usage("no valence is given", "at(N) with N >= 3")),
            },
        };
        let corner = shape.corner(name.centre()?, cs)?;
        Ok(At::new(Source::Named {
            name: name.clone(),
            corner,
            shape,
            steps: cs,
            kept: self
                .written
                .clone()
                .map(|written| written as Arc<dyn std::any::Any + Send + Sync>),
        }))
    }

    /// What the command calls it.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("doo-sabin").spec
    /// 'doo-sabin'
    #[getter]
    fn spec(&self) -> String {
        match &self.what {
            What::Named(name) => called(name),
            What::Matrix(matrix) => format!("matrix of {} points", matrix.rows()),
        }
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> Result<Reduced<'py>, Failure> {
        Ok(match &self.what {
            What::Named(name) => pickle::reduced(py, "scheme", pickle::plain(name)?)?,
            What::Matrix(matrix) => pickle::reduced(py, "matrix", (values::matrix(py, matrix)?,))?,
        })
    }

    fn __repr__(&self) -> String {
        format!("<Scheme {}>", self.spec())
    }
}

/// What a scheme is called: a file by its own name.
pub fn called(name: &SchemeName) -> String {
    match name {
        SchemeName::Spec(spec) => spec.to_string(),
        SchemeName::NonUniform(scheme) => scheme.to_string(),
        SchemeName::File(file) => file
            .read(Default::default())
            .map_or_else(|_| file.path.display().to_string(), |scheme| scheme.name()),
    }
}

impl Scheme {
    /// By name, as long as what belongs to it is there.
    pub fn named(name: SchemeName) -> Self {
        Scheme {
            what: What::Named(name),
            written: None,
        }
    }

    /// By its matrix.
    pub fn of_matrix(matrix: Matrix<f64>) -> Self {
        Scheme {
            what: What::Matrix(Arc::new(matrix)),
            written: None,
        }
    }

    fn checked(name: SchemeName) -> Result<Self, Failure> {
        name.centre()?;
        Ok(Scheme::named(name))
    }
}

/// Python's objects as those of a scheme file.
fn toml_of(value: &Bound<'_, PyAny>, what: &str) -> Result<toml::Value, Failure> {
    let list = |items: &mut dyn Iterator<Item = Bound<'_, PyAny>>| -> Result<toml::Value, Failure> {
        let items: Result<Vec<_>, _> = items.map(|item| toml_of(&item, what)).collect();
        Ok(toml::Value::Array(items?))
    };
    if value.is_instance_of::<PyString>() {
        return Ok(toml::Value::String(value.extract::<Text>()?.get(what)?));
    }
    if value.is_instance_of::<PyBool>() {
        return Ok(toml::Value::Boolean(value.extract()?));
    }
    if value.is_instance_of::<PyInt>() {
        let refuse = |_| {
            let message = format!("{what}: {} has more than 64 bits", input::shown(value));
            Failure::usage(message, "whole numbers of 64 bits, or text with any")
        };
        return Ok(toml::Value::Integer(value.extract().map_err(refuse)?));
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(toml::Value::Float(value.extract()?));
    }
    if let Ok(dict) = value.cast::<PyDict>() {
        let mut table = toml::Table::new();
        for (key, value) in dict.iter() {
            table.insert(key.extract::<Text>()?.get(what)?, toml_of(&value, what)?);
        }
        return Ok(toml::Value::Table(table));
    }
    if let Ok(items) = value.cast::<PyList>() {
        return list(&mut items.iter());
    }
    if let Ok(items) = value.cast::<PyTuple>() {
        return list(&mut items.iter());
    }
    Err(Failure::usage(
        format!("{what}: {} has no meaning in a scheme file", value.get_type()),
        "text, numbers, dicts and lists of these",
    ))
}

/// What a scheme sees around a vertex or face.
///
/// >>> import eigenring
/// >>> eigenring.Corner.fan(3), eigenring.Corner.dart(5)
/// (<Corner fan 3>, <Corner dart 5>)
#[pyclass(frozen, module = "eigenring")]
#[derive(Debug)]
pub struct Corner {
    pub shape: Shape,
}

#[pymethods]
impl Corner {
    /// A closed fan of ``valence`` faces.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Corner.closed(5)
    /// <Corner closed 5>
    #[staticmethod]
    fn closed(valence: Whole) -> Result<Self, Failure> {
        let sectors = valence.valence("valence")?;
        let shape = Shape::Closed { sectors };
        Ok(Corner { shape })
    }

    /// An open fan: a boundary vertex, or one side of a crease; ``corner`` for a fixed vertex.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Corner.fan(2, corner=True)
    /// <Corner fan 2, corner>
    #[staticmethod]
    #[pyo3(signature = (faces, corner = false))]
    fn fan(faces: Whole, corner: bool) -> Result<Self, Failure> {
        let faces = faces.valence("faces")?;
        let shape = Shape::Fan { faces, corner };
        Ok(Corner { shape })
    }

    /// A vertex at which one crease ends.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Corner.dart(5)
    /// <Corner dart 5>
    #[staticmethod]
    fn dart(valence: Whole) -> Result<Self, Failure> {
        let valence = valence.valence("valence")?;
        let shape = Shape::Dart { valence };
        Ok(Corner { shape })
    }

    /// A fixed vertex without creases.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Corner.cusp(5)
    /// <Corner cusp 5>
    #[staticmethod]
    fn cusp(valence: Whole) -> Result<Self, Failure> {
        let valence = valence.valence("valence")?;
        let shape = Shape::Cusp { valence };
        Ok(Corner { shape })
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        // knots are given with a valence, and are no corner of their own
        let (kind, sectors, fixed) = pickle::corner(&self.shape).unwrap_or(("closed", 0, false));
        pickle::reduced(py, "corner", (kind, sectors, fixed))
    }

    fn __repr__(&self) -> String {
        let words = match &self.shape {
            Shape::Closed { sectors } => format!("closed {sectors}"),
            Shape::Fan { faces, corner } => format!("fan {faces}{}", if *corner { ", corner" } else { "" }),
            Shape::Dart { valence } => format!("dart {valence}"),
            Shape::Cusp { valence } => format!("cusp {valence}"),
            Shape::Knots { intervals, .. } => format!("knots {intervals:?}"),
        };
        format!("<Corner {words}>")
    }
}
