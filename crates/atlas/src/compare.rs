//! Schemes side by side over valences.

use crate::error::Error;
use crate::progress::each;
use crate::schemes::{SchemeName, Tuner};
use crate::table::Table;
use eigenring_scheme::Scheme;
use eigenring_spectral::LocalSystem;
use eigenring_tune::quality::Quality;

/// Gauss points per patch and direction, as in the tuning.
const QUADRATURE: usize = 5;

/// Eigenvalues closer than this, relatively, are one.
const EQUAL: f64 = 1e-9;

/// What is compared of a scheme at a valence. Numbers that are not defined for it are absent.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The valence.
    pub valence: usize,
    /// What the scheme is called.
    pub scheme: String,
    /// The modulus of the subdominant eigenvalue.
    pub lambda: Option<f64>,
    /// `mu / lambda^2`, 1 for bounded curvature without a flat spot.
    pub ratio: Option<f64>,
    /// K_m, the reach of the second-order maps' Gauss curvatures to the wrong side of zero; of bicubic
    /// schemes around a vertex.
    pub sign_change: Option<f64>,
    /// The unweighted objective E, of the same.
    pub total: Option<f64>,
    /// The angle at F between V and E in the natural configuration, in degrees.
    pub theta: Option<f64>,
    /// `1 - |mu| / lambda`.
    pub gap: Option<f64>,
    /// `1 - |next eigenvalue| / mu`.
    pub strict: Option<f64>,
    /// The smallest weight of a special stencil of the limit level.
    pub hull: Option<f64>,
    /// Why the maps could not be measured; empty where they were.
    pub remark: String,
}

impl Row {
    /// Measures a scheme; `name` is what it is called.
    ///
    /// # Errors
    /// Those of its local system. Maps that do not exist are no error, but a remark.
    pub fn new(name: &str, scheme: &Scheme<f64>) -> Result<Self, Error> {
        let spectrum = LocalSystem::new(scheme.limit(), scheme.closed_rings()?)?.spectrum()?;
        let lambda = spectrum.subdominant().map(|e| e.modulus());
        let mu = spectrum.subsubdominant().map(|e| e.modulus());
        let next = mu.and_then(|mu| {
            let below = |modulus: &f64| *modulus < mu * (1.0 - EQUAL);
            spectrum.eigenvalues.iter().map(|e| e.modulus()).find(below)
        });
        let (quality, remark) = match Quality::new(scheme, QUADRATURE) {
            Ok(quality) => (Some(quality), String::new()),
            Err(error) => (None, error.to_string()),
        };
        // other degrees live on other annuli with other norms
        let comparable = quality.filter(|quality| scheme.degree() == Some(3) && quality.theta.is_some());
        Ok(Row {
            valence: scheme.valence(),
            scheme: name.to_owned(),
            lambda,
            ratio: spectrum.curvature_ratio(),
            sign_change: comparable.map(|q| q.sign_change()),
            total: comparable.map(|q| q.total()).filter(|e| e.is_finite()),
            theta: quality.and_then(|q| q.theta).map(f64::to_degrees),
            gap: lambda.zip(mu).map(|(lambda, mu)| 1.0 - mu / lambda),
            strict: mu.filter(|&mu| mu > 0.0).map(|mu| 1.0 - next.unwrap_or(0.0) / mu),
            hull: hull(scheme),
            remark,
        })
    }
}

/// The smallest weight of a special stencil of the limit level.
fn hull(scheme: &Scheme<f64>) -> Option<f64> {
    let passes = scheme.limit().passes();
    let weights = passes
        .iter()
        .flat_map(|pass| pass.special().values())
        .flat_map(|stencil| stencil.terms());
    weights.map(|&(_, weight)| weight).reduce(f64::min)
}

/// Measures schemes, each with what it is called, at all valences: valence by valence, in the order of the
/// schemes.
///
/// # Errors
/// Those of the names and of [`Row::new`].
pub fn compare(schemes: &[(String, SchemeName)], valences: &[usize], tuner: &Tuner<'_>) -> Result<Vec<Row>, Error> {
    let pairs: Vec<(usize, &(String, SchemeName))> = valences
        .iter()
        .flat_map(|&valence| schemes.iter().map(move |scheme| (valence, scheme)))
        .collect();
    // what must be tuned is tuned one after the other: all threads work on each, and it is remembered for the
    // next
    let found: Vec<(&str, Scheme<f64>)> = pairs
        .into_iter()
        .map(|(valence, (name, scheme))| Ok((name.as_str(), scheme.scheme(valence, tuner)?)))
        .collect::<Result<_, Error>>()?;
    each(tuner.progress, "schemes", &found, |(name, scheme)| {
        Row::new(name, scheme)
    })
}

/// The rows as a table.
pub fn table(rows: Vec<Row>) -> Table {
    let mut table = Table::new([
        "valence",
        "scheme",
        "lambda",
        "mu/lambda^2",
        "K_m",
        "E",
        "theta",
        "gap",
        "strict",
        "hull",
        "remark",
    ]);
    for row in rows {
        table.push(vec![
            row.valence.into(),
            row.scheme.into(),
            row.lambda.into(),
            row.ratio.into(),
            row.sign_change.into(),
            row.total.into(),
            row.theta.into(),
            row.gap.into(),
            row.strict.into(),
            row.hull.into(),
            row.remark.into(),
        ]);
    }
    table
}
