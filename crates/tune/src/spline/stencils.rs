//! Both functions of a valence: f3 first, then f2 within the bounds that the fitted f3 leaves.

use super::error::FitError;
use super::fit::{Bound, Datum, Fit, FitProblem};
use super::kinks::smooth;
use eigenring_scheme::lambda::LambdaKnots;

/// The tuned stencil at one lambda.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StencilSample {
    /// The subdominant eigenvalue at which it is so.
    pub lambda: f64,
    /// The tuned f2.
    pub f2: f64,
    /// The tuned f3.
    pub f3: f64,
    /// Label of the set of bounds that are active at the optimum, e.g. one bit a bound. Only compared for
    /// equality.
    pub active: u32,
    /// Weights of the squared distances in f2 and f3, positive.
    pub weights: [f64; 2],
}

/// An interval of admissible values; infinite ends where there is no bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// Lower end.
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
}

impl Band {
    /// No bounds.
    pub const FREE: Band = Band {
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
    };
}

/// The admissible stencils along lambda. At valence 4, where f3 is not free, the band of f3 is [`Band::FREE`]
/// and that of f2 does not depend on f3.
pub trait StencilBounds {
    /// The admissible stencils at one lambda; made once for each.
    type Domain;
    /// The domain at lambda.
    fn domain(&self, lambda: f64) -> Self::Domain;
    /// The admissible f3.
    fn f3(&self, domain: &Self::Domain) -> Band;
    /// The admissible f2 for an f3 within its band.
    fn f2(&self, domain: &Self::Domain, f3: f64) -> Band;
}

/// The spline stencils of one valence.
#[derive(Clone, Debug)]
pub struct StencilFit {
    /// The knots of both.
    pub knots: LambdaKnots,
    /// f2.
    pub f2: Fit,
    /// f3.
    pub f3: Fit,
}

/// Fits f3 and f2.
///
/// `kinks` says which of the triple knots b, c, d are kinks; at the others the splines are twice continuously
/// differentiable. The points `fixed` = (lambda, f2, f3) are interpolated. Bounds are demanded at all
/// samples, at all lambdas of `grid` and at the fixed points. Between them they hold up to half the squared
/// spacing times the curvature, so the bounds given here need a margin against those that are to hold
/// everywhere.
///
/// # Errors
/// Those of [`FitProblem::solve`].
pub fn fit_stencils<B: StencilBounds>(
    knots: &LambdaKnots,
    kinks: [bool; 3],
    samples: &[StencilSample],
    fixed: &[(f64, f64, f64)],
    grid: &[f64],
    bounds: &B,
) -> Result<StencilFit, FitError> {
    let space = knots.knots()?;
    let smooth = smooth(knots, kinks);
    let mut lambdas: Vec<f64> = samples.iter().map(|s| s.lambda).chain(grid.iter().copied()).collect();
    lambdas.extend(fixed.iter().map(|point| point.0));
    lambdas.sort_by(f64::total_cmp);
    lambdas.dedup();

    let domains: Vec<B::Domain> = lambdas.iter().map(|&lambda| bounds.domain(lambda)).collect();
    let f3_bands: Vec<Band> = domains.iter().map(|domain| bounds.f3(domain)).collect();

    let fit = |value: fn(&StencilSample) -> (f64, f64), fixed: &[(f64, f64)], bands: &[Band]| {
        let sample = |s: &StencilSample| {
            let (value, weight) = value(s);
            Datum {
                lambda: s.lambda,
                value,
                weight,
            }
        };
        let samples: Vec<Datum> = samples.iter().map(sample).collect();
        let bound = |(&lambda, &Band { lower, upper })| Bound { lambda, lower, upper };
        let bounds: Vec<Bound> = lambdas.iter().zip(bands).map(bound).collect();
        FitProblem {
            knots: &space,
            samples: &samples,
            interpolate: fixed,
            bounds: &bounds,
            smooth: &smooth,
        }
        .solve()
    };
    let fixed_f3: Vec<(f64, f64)> = fixed.iter().map(|&(lambda, _, f3)| (lambda, f3)).collect();
    let f3 = fit(|s| (s.f3, s.weights[1]), &fixed_f3, &f3_bands)?;
    let mut f2_bands = Vec::with_capacity(lambdas.len());
    for ((&lambda, domain), band) in lambdas.iter().zip(&domains).zip(&f3_bands) {
        // NaN cannot occur: the first fit has refused lambdas outside of the knots
        let value = f3.spline.value(lambda).unwrap_or(f64::NAN);
        // a bound that is met exactly may be missed by rounding
        f2_bands.push(bounds.f2(domain, value.max(band.lower).min(band.upper)));
    }
    let fixed_f2: Vec<(f64, f64)> = fixed.iter().map(|&(lambda, f2, _)| (lambda, f2)).collect();
    let f2 = fit(|s| (s.f2, s.weights[0]), &fixed_f2, &f2_bands)?;
    Ok(StencilFit { knots: *knots, f2, f3 })
}
