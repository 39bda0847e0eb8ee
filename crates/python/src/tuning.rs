//! The best values of parameters, and the tables of the lambda-scheme.

use crate::at::{At, Source};
use crate::failure::Failure;
use crate::input::{self, Real, Text, Whole};
use crate::mesh::Named;
use crate::proofs::Certificate;
use crate::{values, work};
use eigenring_atlas::progress::Progress;
use eigenring_atlas::results::tables;
use eigenring_atlas::run::{Parameters, check, studies};
use eigenring_atlas::schemes::SchemeName;
use eigenring_atlas::tune::{at, over_lambda};
use eigenring_atlas::tuning::{Condition, Goal, Own, Plan};
use eigenring_certify::Requirement;
use eigenring_scheme::Scheme;
use eigenring_scheme::lambda::Splines;
use eigenring_tune::study::Knots;
use eigenring_tune::sweep::{Options, Range};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use serde_json::Value;
use std::sync::{Arc, Mutex};

/// The most descents that are taken for meant.
const MAX_DESCENTS: usize = 10_000;

/// What a tuning has found.
///
/// >>> import eigenring
/// >>> scheme = eigenring.Scheme.from_stencils(
/// ...     dict(f1="1/4", f2="1/4", f3="1/4", d1="b", d2="3/4-b", e1="1/16", e2="1/16",
/// ...          alpha="3/(2*n)", beta="1/(4*n)"),
/// ...     parameters={"b": {"default": "3/8", "range": ["1/4", "1/2"]}})
/// >>> tuned = eigenring.tune(scheme, 5, "ratio", descents=1)
/// >>> [row["after"] < row["before"] for row in tuned.json()["rows"]]
/// [True]
#[pyclass(frozen, module = "eigenring")]
#[derive(Debug)]
pub struct Tuned {
    json: Value,
    text: String,
    certificates: Vec<eigenring_certify::Certificate>,
}

#[pymethods]
impl Tuned {
    /// What ``eigenring tune --format json`` prints.
    ///
    /// >>> import eigenring
    /// >>> eigenring.tune("lambda", 5, lambda_=0.5).json()["branch"]
    /// 'continued'
    fn json<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        values::object(py, &self.json)
    }

    /// The scheme file with the values that were found; empty for the lambda-scheme.
    ///
    /// >>> import eigenring
    /// >>> eigenring.tune("lambda", 5, lambda_=0.5).text
    /// ''
    #[getter]
    fn text(&self) -> String {
        self.text.clone()
    }

    /// What is proven of the result at each valence.
    ///
    /// >>> import eigenring
    /// >>> eigenring.tune("lambda", 5, lambda_=0.5).certificates
    /// []
    #[getter]
    fn certificates(&self) -> Vec<Certificate> {
        let all = self.certificates.iter();
        all.map(|certificate| Certificate::new(certificate.clone(), Requirement::C1))
            .collect()
    }
}

/// Tunes the free parameters of a scheme file at one valence or several, or the lambda-scheme.
///
/// ``minimise`` is one of the command's objectives (``"E"``, ``"E-unweighted"``, ``"ratio"``,
/// ``"lambda:TARGET"``, ``"K_m"``, ``"strictness"``, ``"hull"``, ``"polar"``, or a sum such as
/// ``"1*E+10*ratio"``), or a function that takes the scheme :class:`At` the valence and returns a number, NaN
/// where it is not defined. ``subject_to`` lists conditions out of ``"hull"``, ``"bounded"``, ``"order"``,
/// ``"c1"``; ``fix`` maps parameters to values they keep.
///
/// With ``scheme="lambda"`` the weights f2, f3 are tuned for one ``lambda_``, or lambda too.
///
/// >>> import eigenring
/// >>> scheme = eigenring.Scheme.from_stencils(
/// ...     dict(f1="1/4", f2="1/4", f3="1/4", d1="b", d2="3/4-b", e1="1/16", e2="1/16",
/// ...          alpha="3/(2*n)", beta="1/(4*n)"),
/// ...     parameters={"b": {"default": "3/8", "range": ["1/4", "1/2"]}})
/// >>> own = eigenring.tune(scheme, 5, lambda at: abs(at.spectrum().subdominant - 0.57), descents=1)
/// >>> built_in = eigenring.tune(scheme, 5, "lambda:0.57", descents=1)
/// >>> a, b = (found.json()["rows"][0]["parameters"]["b"] for found in (own, built_in))
/// >>> abs(a - b) < 1e-6
/// True
#[pyfunction]
#[pyo3(signature = (
    scheme, valence, minimise = None, *, lambda_ = None, subject_to = Vec::new(), fix = None, margin = None, seed = Whole::of(0),
    descents = Whole::of(6), name = Text::of("tuned"), progress = None
), text_signature = "(scheme, valence, minimise=None, *, lambda_=None, subject_to=(), fix=None, margin=None, seed=0, descents=6, name='tuned', progress=None)")]
#[allow(clippy::too_many_arguments)]
pub fn tune(
    py: Python<'_>,
    scheme: Named<'_>,
    valence: &Bound<'_, PyAny>,
    minimise: Option<&Bound<'_, PyAny>>,
    lambda_: Option<Real>,
    subject_to: Vec<Text>,
    fix: Option<&Bound<'_, PyDict>>,
    margin: Option<Real>,
    seed: Whole,
    descents: Whole,
    name: Text,
    progress: Option<Py<PyAny>>,
) -> Result<Tuned, Failure> {
    let valences = input::valences(valence)?;
    let lambda_ = lambda_.map(|lambda| lambda.finite("lambda_")).transpose()?;
    let accepted = "0 to below 0.5";
    let margin = margin.map(|margin| margin.such("margin", accepted, |margin| (0.0..0.5).contains(&margin)));
    let margin = margin.transpose()?;
    let seed = seed.up_to(u64::MAX, "seed")?;
    let descents = descents.count("descents")?;
    if let Named::Name(text) = &scheme
        && text.cast::<PyString>().is_ok_and(|text| text == "lambda")
    {
        let &[valence] = valences.as_slice() else {
            return Err(Failure::usage("several valences", "one valence for the lambda-scheme"));
        };
        if minimise.is_some() || !subject_to.is_empty() || fix.is_some() {
            return Err(Failure::usage(
                "minimise, subject_to and fix have no meaning for the lambda-scheme",
                "a scheme file with them",
            ));
        }
        let mut options = Options::default();
        if let Some(margin) = margin {
            options.margin = margin;
        }
        return of_lambda(py, valence, lambda_, options, progress);
    }
    let margin = margin.unwrap_or(Options::default().margin);
    if lambda_.is_some() {
        return Err(Failure::usage(
            "lambda_ has no meaning for a scheme file",
            "lambda_ with the scheme \"lambda\"",
        ));
    }
    if !(1..=MAX_DESCENTS).contains(&descents) {
        return Err(Failure::usage(
            format!("descents is {descents}"),
            format!("1 to {MAX_DESCENTS}"),
        ));
    }
    let scheme = scheme.scheme(py)?;
    let SchemeName::File(file) = scheme.get().name()?.clone() else {
        return Err(Failure::usage(
            "tuning is for the parameters of a scheme file",
            "a scheme from a file, text or stencils, or \"lambda\"",
        ));
    };
    let Some(minimise) = minimise else {
        return Err(Failure::usage(
            "no objective is given",
            "minimise as text or a function",
        ));
    };
    // the first exception of a callback, which is raised when the work has stopped
    let raised: Arc<Mutex<Option<PyErr>>> = Arc::default();
    let own = match minimise.cast::<PyString>() {
        Ok(_) => None,
        Err(_) if minimise.is_callable() => Some(minimise.clone().unbind()),
        Err(_) => {
            return Err(Failure::usage(
                "the objective is no function",
                "text, or a function of a scheme at a valence",
            ));
        }
    };
    let named = match &own {
        None => Some(minimise.extract::<Text>()?.get("minimise")?.parse::<Goal>()?),
        Some(_) => None,
    };
    let settings = input::settings(fix)?.into_iter();
    let fixed = settings.map(|(name, value)| (name, Some(value))).collect();
    let mut conditions: Vec<Condition> = Vec::new();
    for text in subject_to {
        let condition = text.get("a condition")?.parse()?;
        if !conditions.contains(&condition) {
            conditions.push(condition);
        }
    }
    let name = name.get("name")?;
    let kept = Arc::clone(&raised);
    let result = work::run(py, progress, move |reporter| {
        let _kept = scheme;
        let goal = match (named, own) {
            (Some(goal), _) => goal,
            (None, Some(function)) => called(function, kept, reporter.clone()).into(),
            (None, None) => return Err(Failure::usage("no objective is given", "minimise")),
        };
        let plan = Plan {
            scheme: file,
            fixed,
            goal,
            conditions,
            margin,
            seed,
            descents,
        };
        let tuned = plan.run(&valences, &name, &(), reporter)?;
        Ok(Tuned {
            json: Value::Object(plan.json(&tuned)),
            text: tuned.text,
            certificates: tuned.rows.into_iter().map(|row| row.certificate).collect(),
        })
    });
    match raised.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).take() {
        Some(error) => Err(error.into()),
        None => result,
    }
}

/// A Python function as objective. After it has raised, work stops.
fn called(function: Py<PyAny>, raised: Arc<Mutex<Option<PyErr>>>, reporter: work::Reporter) -> Own {
    let value = move |scheme: &Scheme<f64>| -> f64 {
        Python::attach(|py| {
            let at = At::new(Source::Rules(Arc::new(scheme.clone())));
            let found = function.call1(py, (at,)).and_then(|value| value.extract::<f64>(py));
            found.unwrap_or_else(|error| {
                let mut first = raised.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
                first.get_or_insert(error);
                reporter.cancel();
                f64::NAN
            })
        })
    };
    Own {
        name: "a function".to_owned(),
        value: Arc::new(value),
    }
}

fn of_lambda(
    py: Python<'_>,
    valence: usize,
    lambda: Option<f64>,
    options: Options,
    progress: Option<Py<PyAny>>,
) -> Result<Tuned, Failure> {
    let found = work::run(py, progress, move |reporter| {
        Ok(match lambda {
            Some(lambda) => at(valence, lambda, &options)?,
            None => over_lambda(valence, &options, reporter)?,
        })
    })?;
    let mut object = found.record.json();
    object.insert("active".to_owned(), found.active.into());
    object.insert(found.title.to_owned(), found.minima.json());
    Ok(Tuned {
        json: Value::Object(object),
        text: String::new(),
        certificates: Vec::new(),
    })
}

/// The stored splines and featured lambdas of the lambda-scheme at a valence, as a dict.
///
/// ``splines`` is ``"paper"``, those with the paper's 17 coefficients, which ``lambda:lambda=L`` stands for;
/// or ``"fine"``, those with as many as it takes to lose less than a hundredth of the objective against the
/// samples, which ``lambda:fine,lambda=L`` stands for. The knots then say how many single ones there are.
///
/// >>> import eigenring
/// >>> entry, fine = eigenring.lambda_table(5), eigenring.lambda_table(5, splines="fine")
/// >>> entry["valence"], len(entry["f2"]), len(fine["f2"]) > 17
/// (5, 17, True)
#[pyfunction]
#[pyo3(signature = (valence, *, splines = Text::of("paper")), text_signature = "(valence, *, splines='paper')")]
pub fn lambda_table<'py>(py: Python<'py>, valence: Whole, splines: Text) -> Result<Bound<'py, PyAny>, Failure> {
    let valence = valence.valence("valence")?;
    let tables = [("paper", Splines::Paper), ("fine", Splines::Fine)];
    let entry = input::word("splines", &splines.get("splines")?, &tables)?
        .table()?
        .entry(valence)?;
    let json = serde_json::to_value(entry).map_err(|error| eigenring_atlas::Error::content(error.to_string()))?;
    Ok(values::object(py, &json)?)
}

/// The tables of the lambda-scheme as dicts of columns, computed anew.
#[pyfunction]
#[pyo3(signature = (valences, progress = None, knots = Text::of("detected")), text_signature = "(valences, progress=None, knots='detected')")]
pub fn table_columns<'py>(
    py: Python<'py>,
    valences: &Bound<'py, PyAny>,
    progress: Option<Py<PyAny>>,
    knots: Text,
) -> Result<Bound<'py, PyDict>, Failure> {
    let all = [
        ("detected", Knots::Detected),
        ("paper", Knots::Paper),
        ("sharp", Knots::Sharp),
        ("fine", Knots::Fine),
    ];
    let knots = input::word("knots", &knots.get("knots")?, &all)?;
    let valences = input::valences(valences)?;
    let parameters = Parameters::new(valences, knots, &Options::default(), &Range::default());
    let found = work::run(py, progress, move |reporter| {
        check(&parameters)?;
        Ok(studies(&parameters, &(), reporter as &dyn Progress)?)
    })?;
    let named = PyDict::new(py);
    for (name, table) in tables(&found) {
        named.set_item(name, values::columns(py, &table)?)?;
    }
    Ok(named)
}
