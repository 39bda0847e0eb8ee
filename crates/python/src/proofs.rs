//! Certificates.

use crate::failure::Failure;
use crate::input::Text;
use crate::pickle::{self, Reduced};
use crate::{values, work};
use eigenring_atlas::nonuniform::certificate::Certificate as WithIntervals;
use eigenring_atlas::nonuniform::verify::{Report, Required};
use eigenring_atlas::schemes::MAX_VALENCE;
use eigenring_atlas::table::Format;
use eigenring_atlas::verify;
use eigenring_certify as certify;
use eigenring_certify::{Requirement, Status};
use eigenring_nonuniform::{Scheme as NonUniform, Spokes};
use eigenring_scheme::Shape;
use pyo3::prelude::*;
use serde_json::Value;

/// A requirement by name.
///
/// # Errors
/// An unknown name.
pub fn requirement(name: &str) -> Result<Requirement, Failure> {
    let found = Requirement::ALL
        .into_iter()
        .find(|requirement| requirement.name() == name);
    found.ok_or_else(|| {
        let names = Requirement::ALL.map(Requirement::name);
        Failure::usage(format!("unknown requirement '{name}'"), names.join(", "))
    })
}

/// What is proven of a scheme at a valence, with the evidence.
///
/// >>> import eigenring
/// >>> certificate = eigenring.Scheme("catmull-clark").at(5).verify()
/// >>> again = eigenring.Certificate.from_json(certificate.to_json())
/// >>> again.recheck(), again.holds
/// ('', True)
#[pyclass(frozen, module = "eigenring")]
#[derive(Debug)]
pub struct Certificate {
    proven: Proven,
    /// As it was read.
    text: Option<String>,
}

/// What is proven, and what is required of it.
#[derive(Debug)]
enum Proven {
    /// Of a scheme with the same rules in all sectors, or beside a feature.
    Scheme(Box<certify::Certificate>, Requirement),
    /// Of a scheme with knot intervals.
    Intervals(Report),
}

/// What may be required of schemes with knot intervals.
fn required(scheme: &dyn std::fmt::Display, requirement: Requirement) -> Result<Required, Failure> {
    match requirement {
        Requirement::C1 => Ok(Required::C1),
        Requirement::Bounded => Ok(Required::Bounded),
        _ => Err(Failure::usage(
            format!("this is not examined for {scheme}"),
            "require=\"c1\" or \"bounded\"",
        )),
    }
}

impl Certificate {
    /// With the verdict on a requirement.
    pub fn new(certificate: certify::Certificate, requirement: Requirement) -> Self {
        Certificate {
            proven: Proven::Scheme(Box::new(certificate), requirement),
            text: None,
        }
    }

    /// Of a scheme with knot intervals, by default equal ones.
    ///
    /// # Errors
    /// Other corners and requirements; those of the scheme.
    pub fn with_intervals(scheme: NonUniform, shape: Shape, requirement: Requirement) -> Result<Self, Failure> {
        let required = required(&scheme, requirement)?;
        let spokes = match shape {
            Shape::Knots { intervals, next } => Spokes::new(intervals, next),
            Shape::Closed { sectors } => Spokes::stationary(vec![1.0; sectors]),
            _ => {
                let message = format!("{scheme} has closed fans only");
                return Err(Failure::usage(message, "a valence, or knots"));
            }
        };
        let spokes = spokes.map_err(eigenring_atlas::Error::from)?;
        Ok(Certificate {
            proven: Proven::Intervals(Report::new(scheme, spokes, required)?),
            text: None,
        })
    }

    fn printed(&self) -> Value {
        let text = match &self.proven {
            Proven::Scheme(certificate, requirement) => {
                verify::certificates(std::slice::from_ref(certificate), *requirement, Format::Json)
            }
            Proven::Intervals(report) => report.render(Format::Json),
        };
        // the command's own JSON is JSON
        serde_json::from_str(&text).unwrap_or_default()
    }

    fn verdict(&self) -> Status {
        match &self.proven {
            Proven::Scheme(certificate, requirement) => requirement.verdict(&certificate.checks).1,
            Proven::Intervals(report) => report.status(),
        }
    }

    fn required(&self) -> &'static str {
        match &self.proven {
            Proven::Scheme(_, requirement) => requirement.name(),
            Proven::Intervals(report) => report.required().name(),
        }
    }
}

#[pymethods]
impl Certificate {
    /// Whether what is required was found to hold; only ``status == "proven"`` is a proof.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).verify("bounded").holds
    /// False
    #[getter]
    fn holds(&self) -> bool {
        match &self.proven {
            Proven::Scheme(certificate, requirement) => requirement.verdict(&certificate.checks).0,
            Proven::Intervals(report) => matches!(report.status(), Status::Proven | Status::Numerical),
        }
    }

    /// ``proven``, ``refuted``, ``undecided``, or ``numerical`` for weights that are results of rounding.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).verify("bounded").status
    /// 'refuted'
    #[getter]
    fn status(&self) -> String {
        self.verdict().to_string()
    }

    /// What was required.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).verify("hull").require
    /// 'hull'
    #[getter]
    fn require(&self) -> &'static str {
        self.required()
    }

    /// The valence; None where it is about all of them.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).verify().valence
    /// 5
    #[getter]
    fn valence(&self) -> Option<usize> {
        match &self.proven {
            Proven::Scheme(certificate, _) => Some(certificate.valence),
            Proven::Intervals(report) => report.spokes().map(Spokes::valence),
        }
    }

    /// The statements: dicts with name, status, holds, rigorous, margin, enclosure, witness, reached.
    ///
    /// >>> import eigenring
    /// >>> checks = eigenring.Scheme("catmull-clark").at(5).verify().checks
    /// >>> [check["status"] for check in checks if check["name"] == "injective"]
    /// ['proven']
    #[getter]
    fn checks<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        values::object(py, &self.printed()["checks"])
    }

    /// What ``eigenring verify --format json`` prints, as a dict.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).verify().json()["degree"]
    /// 3
    fn json<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        values::object(py, &self.printed())
    }

    /// The stored form, with the evidence: what ``eigenring verify -o FILE`` writes.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).verify().to_json()[:1]
    /// '{'
    fn to_json(&self) -> Result<String, Failure> {
        match (&self.text, &self.proven) {
            (Some(text), _) => Ok(text.clone()),
            (None, Proven::Scheme(certificate, _)) => Ok(certificate.to_json()?),
            (None, Proven::Intervals(report)) => Ok(WithIntervals::of(report).to_json()?),
        }
    }

    /// Reads the stored form. What it claims is not checked: see :meth:`recheck`. Of schemes with knot
    /// intervals it holds no remarks, and the statements are found anew.
    ///
    /// >>> import eigenring
    /// >>> text = eigenring.Scheme("catmull-clark").at(5).verify().to_json()
    /// >>> eigenring.Certificate.from_json(text, require="bounded").status
    /// 'refuted'
    #[staticmethod]
    #[pyo3(signature = (text, *, require = Text::of("c1")), text_signature = "(text, *, require='c1')")]
    fn from_json(text: Text, require: Text) -> Result<Self, Failure> {
        let text = text.get("a certificate")?;
        let requirement = requirement(&require.get("require")?)?;
        let value = serde_json::from_str::<Value>(&text).unwrap_or_default();
        let proven = match WithIntervals::is_of_this_kind(&value) {
            true => {
                let stored = WithIntervals::from_json(&text)?;
                let required = required(&stored.scheme, requirement)?;
                Proven::Intervals(stored.report(MAX_VALENCE, required)?)
            }
            false => Proven::Scheme(Box::new(certify::Certificate::from_json(&text)?), requirement),
        };
        let text = Some(text);
        Ok(Certificate { proven, text })
    }

    /// Checks every claim again by the evidence alone. Returns what is not confirmed, an empty string if all
    /// is.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).verify().recheck()
    /// ''
    #[pyo3(signature = (*, progress = None))]
    fn recheck(&self, py: Python<'_>, progress: Option<Py<PyAny>>) -> Result<String, Failure> {
        let text = self.to_json()?;
        let row = work::run(py, progress, move |_| {
            let path = std::path::Path::new("certificate");
            Ok(eigenring_atlas::certificates::confirm_text(
                path,
                &text,
                eigenring_atlas::schemes::MAX_VALENCE,
            )?)
        })?;
        Ok(row.remark)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> Result<Reduced<'py>, Failure> {
        let arguments = (self.to_json()?, self.required());
        Ok(pickle::reduced(py, "certificate", arguments)?)
    }

    fn __repr__(&self) -> String {
        let what = match &self.proven {
            Proven::Scheme(certificate, _) => format!("{}, N = {}", certificate.input.name(), certificate.valence),
            Proven::Intervals(report) => WithIntervals::of(report).what(),
        };
        format!("<Certificate {what}: {} is {}>", self.required(), self.verdict())
    }
}
