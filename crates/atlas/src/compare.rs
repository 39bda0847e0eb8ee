//! Schemes side by side over valences.

use crate::error::Error;
use crate::progress::each;
use crate::schemes::{SchemeName, Tuner, distinct};
use crate::spectrum::Analysis;
use crate::table::{Format, Table, WIDTH};
use eigenring_scheme::{Corner, Scheme};
use eigenring_spectral::{Extended, Spectrum};
use eigenring_tune::quality::Quality;

/// Gauss points per patch and direction, as in the tuning.
pub(crate) const QUADRATURE: usize = 5;

/// How far the dominant eigenvalue may be from 1: rounding, with room for condition numbers up to 1e6.
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
    /// How far all further eigenvalues are below the three of the quadratic terms, as
    /// [`Spectrum::strictness`](eigenring_spectral::Spectrum::strictness) says; absent where they are not.
    pub strict: Option<f64>,
    /// The smallest weight, of those that are not zero, of the rules of one level, passes composed.
    pub hull: Option<f64>,
    /// What is wrong with the scheme, or why its maps could not be measured; empty where nothing is.
    pub remark: String,
}

impl Row {
    /// Measures a scheme, whose multiplicities are told from its rules in more precision, if these are known;
    /// `name` is what it is called.
    ///
    /// # Errors
    /// Those of its local system. Maps that do not exist are no error, but a remark.
    pub fn new(name: &str, scheme: &Scheme<f64>, extended: Option<&Scheme<Extended>>) -> Result<Self, Error> {
        // the eigenvalues that `spectrum` prints
        let analysis = Analysis::of_rules(scheme, extended, None, None)?;
        let beyond = analysis.beyond(scheme)?;
        let spectrum = analysis.spectrum;
        let hull = hull(scheme)?;
        let subdominant = spectrum.subdominant();
        let lambda = subdominant.map(|e| e.modulus());
        let mu = spectrum.subsubdominant().map(|e| e.modulus());
        let mut remarks = Vec::new();
        let dominant = spectrum.eigenvalues.first().map_or(0.0, |e| e.modulus());
        let (affine, spanned) = spans(&spectrum);
        if !affine {
            remarks.push(format!("the dominant eigenvalue is {dominant:.6}, not 1"));
        }
        if affine && !spanned {
            let fourier = subdominant.and_then(|e| e.fourier).unwrap_or_default();
            let tie = if spectrum.stray().is_none() {
                ", as large as that of index 1"
            } else {
                ", not 1"
            };
            remarks.push(format!("the subdominant eigenvalue is of Fourier index {fourier}{tie}"));
        }
        if subdominant.is_some_and(|e| e.value.im != 0.0) {
            remarks.push("the subdominant eigenvalue is complex".to_owned());
        }
        let quality = if affine && spanned {
            Quality::new(scheme, QUADRATURE)
                .map_err(|error| remarks.push(error.to_string()))
                .ok()
        } else {
            None
        };
        if hull.is_some_and(|least| least < 0.0) {
            remarks.push("weights are negative".to_owned());
        }
        let comparable = quality.and_then(|quality| comparable(scheme, quality));
        Ok(Row {
            valence: scheme.valence(),
            scheme: name.to_owned(),
            lambda,
            ratio: spectrum.curvature_ratio(),
            sign_change: comparable.map(|q| q.sign_change()),
            total: comparable.map(|q| q.total()).filter(|e| e.is_finite()),
            theta: quality.and_then(|q| q.theta).map(f64::to_degrees),
            gap: lambda.zip(mu).map(|(lambda, mu)| 1.0 - mu / lambda),
            strict: spectrum.strictness(scheme.valence(), beyond),
            hull,
            remark: remarks.join("; "),
        })
    }
}

/// Whether 1 is the dominant eigenvalue, and whether block 1 spans the tangent plane: where it does not there
/// is no characteristic map to measure.
pub(crate) fn spans(spectrum: &Spectrum) -> (bool, bool) {
    let dominant = spectrum.eigenvalues.first().map_or(0.0, |e| e.modulus());
    let subdominant = spectrum.subdominant();
    (
        (dominant - 1.0).abs() <= EQUAL,
        subdominant.is_some_and(|e| e.fourier.is_none_or(|k| k == 1)),
    )
}

/// The maps of schemes that can be compared by E and K_m: bicubic ones around a vertex. Other degrees live on
/// other annuli with other norms.
pub(crate) fn comparable(scheme: &Scheme<f64>, quality: Quality) -> Option<Quality> {
    Some(quality).filter(|quality| scheme.degree() == Some(3) && quality.theta.is_some())
}

/// The smallest weight, of those that are not zero, of a control point in a point that is refined once, over
/// all levels: what the margin of `hull` in a certificate is.
pub(crate) fn hull(scheme: &Scheme<f64>) -> Result<Option<f64>, Error> {
    let mut least: Option<f64> = None;
    for level in (0..=scheme.leading().len()).map(|index| scheme.level(index)) {
        let rows = level.rows(&level.row_sites()?)?;
        let weights = rows.iter().flat_map(|row| row.values().copied());
        least = weights.filter(|&weight| weight != 0.0).chain(least).reduce(f64::min);
    }
    Ok(least)
}

/// Measures schemes at all valences: valence by valence, in the order of the schemes.
///
/// # Errors
/// Those of the names and of [`Row::new`].
pub fn compare(schemes: &[SchemeName], valences: &[usize], tuner: &Tuner<'_>) -> Result<Vec<Row>, Error> {
    let pairs: Vec<(usize, &SchemeName)> = valences
        .iter()
        .flat_map(|&valence| schemes.iter().map(move |scheme| (valence, scheme)))
        .collect();
    // what must be tuned is tuned one after the other: all threads work on each, and it is remembered for the
    // next
    let found: Vec<(Scheme<f64>, Option<Scheme<Extended>>)> = pairs
        .into_iter()
        .map(|(valence, scheme)| {
            let corner = Corner::closed(scheme.centre()?, valence)?;
            Ok((scheme.scheme(valence, tuner)?, scheme.extended(&corner)?))
        })
        .collect::<Result<_, Error>>()?;
    // a scheme has the same name at all valences
    let names: Vec<&str> = found
        .iter()
        .take(schemes.len())
        .map(|(scheme, _)| scheme.name())
        .collect();
    let called = distinct(schemes, &names);
    if let Some((called, name)) = called.iter().zip(&names).find(|(called, name)| called != name) {
        tuner.progress.note(&format!(
            "several schemes are called {name}: their files tell them apart, as in {called}"
        ));
    }
    let found: Vec<_> = found.iter().zip(called.iter().cycle()).collect();
    each(tuner.progress, "schemes", &found, |((scheme, extended), called)| {
        Row::new(called, scheme, extended.as_ref())
    })
}

/// What the columns mean.
pub(crate) const LEGEND: &str = "\
lambda       modulus of the subdominant eigenvalue
mu/lambda^2  1 for bounded curvature without a flat spot
K_m, E       reach of the Gauss curvatures to the wrong side of zero; the unweighted objective
theta        angle at F between V and E in the natural configuration, in degrees
gap, strict  1 - |mu|/lambda; how far all further eigenvalues are below those of the quadratic terms
hull         the smallest weight that is not zero
";

/// The rows for people: a heading for each valence, a row for each scheme, and what the columns mean. Unless
/// it is `wide`, lines have at most [`WIDTH`] characters.
pub fn text(rows: &[Row], wide: bool) -> String {
    let mut text = String::new();
    for rows in rows.chunk_by(|a, b| a.valence == b.valence) {
        let mut table = table(rows.to_vec()).without("valence");
        if rows.iter().all(|row| row.remark.is_empty()) {
            table = table.without("remark");
        }
        let table = if wide {
            table.render(Format::Text)
        } else {
            table.fitted(WIDTH)
        };
        text.push_str(&format!("N = {}\n{table}\n", rows[0].valence));
    }
    text + LEGEND
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
