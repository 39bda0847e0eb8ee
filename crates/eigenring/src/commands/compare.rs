//! `eigenring compare`: schemes side by side.

use crate::args::{Output, Valences};
use crate::error::Error;
use crate::files;
use crate::schemes::SchemeList;
use crate::table::Table;
use clap::Args;
use eigenring_scheme::Scheme;
use eigenring_spectral::LocalSystem;
use eigenring_tune::quality::Quality;
use std::process::ExitCode;

/// Compare schemes over valences.
///
/// Columns: lambda; mu/lambda^2 (1: bounded curvature without a flat spot); K_m, the reach of the second-order maps' Gauss
/// curvatures to the wrong side of zero, and the unweighted objective E, both over the annulus from 2 to 4 with unit 5-ring norm
/// (bicubic schemes around a vertex only); theta, the angle at F between V and E, in degrees; and margins: gap = 1 - |mu|/lambda,
/// strict = 1 - |next eigenvalue|/mu, hull = the smallest weight of a special stencil.
#[derive(Args, Debug)]
#[command(
    after_help = "Example:\n  eigenring compare --schemes catmull-clark,lambda:optimal,tension:order=4,u0=2 --valences 3..12"
)]
pub struct Arguments {
    /// Schemes, separated by commas; see 'eigenring --help'
    #[arg(long, value_name = "SPEC,SPEC,...")]
    schemes: SchemeList,
    /// Valences: numbers and ranges
    #[arg(long, value_name = "LIST", default_value = "3..12", allow_hyphen_values = true)]
    valences: Valences,
    #[command(flatten)]
    output: Output,
}

/// Gauss points per patch and direction, as in the tuning.
const QUADRATURE: usize = 5;

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
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
        for &valence in &self.valences.0 {
            for (name, scheme) in &self.schemes.0 {
                let scheme = scheme.scheme(valence)?;
                let rings = scheme.closed_rings()?;
                let spectrum = LocalSystem::new(scheme.limit(), rings)?.spectrum()?;
                let lambda = spectrum.subdominant().map(|e| e.modulus());
                let mu = spectrum.subsubdominant().map(|e| e.modulus());
                let next = mu.and_then(|mu| {
                    let below = |modulus: &f64| *modulus < mu * (1.0 - EQUAL);
                    spectrum.eigenvalues.iter().map(|e| e.modulus()).find(below)
                });
                let (quality, remark) = match Quality::new(&scheme, QUADRATURE) {
                    Ok(quality) => (Some(quality), String::new()),
                    Err(error) => (None, error.to_string()),
                };
                // other degrees live on other annuli with other norms
                let comparable = quality.filter(|quality| scheme.degree() == Some(3) && quality.theta.is_some());
                table.push(vec![
                    valence.into(),
                    name.as_str().into(),
                    lambda.into(),
                    spectrum.curvature_ratio().into(),
                    comparable.map(|q| q.sign_change()).into(),
                    comparable.map(|q| q.total()).filter(|e| e.is_finite()).into(),
                    quality.and_then(|q| q.theta).map(f64::to_degrees).into(),
                    lambda.zip(mu).map(|(lambda, mu)| 1.0 - mu / lambda).into(),
                    mu.filter(|&mu| mu > 0.0)
                        .map(|mu| 1.0 - next.unwrap_or(0.0) / mu)
                        .into(),
                    hull(&scheme).into(),
                    remark.into(),
                ]);
            }
        }
        files::emit(None, table.render(self.output.format).as_bytes())?;
        Ok(ExitCode::SUCCESS)
    }
}

/// Eigenvalues closer than this, relatively, are one.
const EQUAL: f64 = 1e-9;

/// The smallest weight of a special stencil of the limit level.
fn hull(scheme: &Scheme<f64>) -> Option<f64> {
    let passes = scheme.limit().passes();
    let weights = passes
        .iter()
        .flat_map(|pass| pass.special().values())
        .flat_map(|stencil| stencil.terms());
    weights.map(|&(_, weight)| weight).reduce(f64::min)
}
