//! Certificates.

use crate::failure::Failure;
use crate::input::Text;
use crate::pickle::{self, Reduced};
use crate::{values, work};
use eigenring_atlas::table::Format;
use eigenring_atlas::verify;
use eigenring_certify as certify;
use eigenring_certify::Requirement;
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
    certificate: certify::Certificate,
    requirement: Requirement,
    /// As it was read.
    text: Option<String>,
}

impl Certificate {
    /// With the verdict on a requirement.
    pub fn new(certificate: certify::Certificate, requirement: Requirement) -> Self {
        Certificate {
            certificate,
            requirement,
            text: None,
        }
    }

    fn printed(&self) -> Value {
        let text = verify::certificates(std::slice::from_ref(&self.certificate), self.requirement, Format::Json);
        // the command's own JSON is JSON
        serde_json::from_str(&text).unwrap_or_default()
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
        self.requirement.verdict(&self.certificate.checks).0
    }

    /// ``proven``, ``refuted``, ``undecided``, or ``numerical`` for weights that are results of rounding.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).verify("bounded").status
    /// 'refuted'
    #[getter]
    fn status(&self) -> String {
        self.requirement.verdict(&self.certificate.checks).1.to_string()
    }

    /// What was required.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).verify("hull").require
    /// 'hull'
    #[getter]
    fn require(&self) -> &'static str {
        self.requirement.name()
    }

    /// The valence.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).verify().valence
    /// 5
    #[getter]
    fn valence(&self) -> usize {
        self.certificate.valence
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
        match &self.text {
            Some(text) => Ok(text.clone()),
            None => Ok(self.certificate.to_json()?),
        }
    }

    /// Reads the stored form. What it claims is not checked: see :meth:`recheck`.
    ///
    /// >>> import eigenring
    /// >>> text = eigenring.Scheme("catmull-clark").at(5).verify().to_json()
    /// >>> eigenring.Certificate.from_json(text, require="bounded").status
    /// 'refuted'
    #[staticmethod]
    #[pyo3(signature = (text, *, require = Text::of("c1")), text_signature = "(text, *, require='c1')")]
    fn from_json(text: Text, require: Text) -> Result<Self, Failure> {
        let text = text.get("a certificate")?;
        Ok(Certificate {
            certificate: certify::Certificate::from_json(&text)?,
            requirement: requirement(&require.get("require")?)?,
            text: Some(text),
        })
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
        let arguments = (self.to_json()?, self.requirement.name());
        Ok(pickle::reduced(py, "certificate", arguments)?)
    }

    fn __repr__(&self) -> String {
        let (name, valence) = (self.certificate.input.name(), self.certificate.valence);
        format!(
            "<Certificate {name}, N = {valence}: {} is {}>",
            self.requirement.name(),
            self.status()
        )
    }
}
