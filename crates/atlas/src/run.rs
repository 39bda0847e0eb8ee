//! The main job: samples in parallel, then a study for each valence.
//!
//! Samples take hours for many valences. They can be kept elsewhere as they are finished ([`Kept`]), so that
//! an interrupted run resumes to the same results.

use crate::error::Error;
use crate::progress::{Progress, each};
use eigenring_scheme::lambda::{Bounds, LambdaEntry, Relaxation};
use eigenring_tune::global::{Global, global};
use eigenring_tune::objective::{Normalisation, Settings};
use eigenring_tune::search::Starts;
use eigenring_tune::study::{Knots, Study};
use eigenring_tune::sweep::{LambdaSample, Options, Problem, Range, sample};
use serde::{Deserialize, Serialize};

/// Everything that results depend on, as it is recorded with them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameters {
    /// The valences.
    pub valences: Vec<usize>,
    /// "10x10" or "full".
    pub starts: String,
    /// "paper" or "sharp".
    pub bounds: String,
    /// "detected" or "paper".
    pub knots: Knots,
    /// Relative margin of the samples.
    pub margin: f64,
    /// Ratio alpha / beta.
    pub phi: f64,
    /// Constants of the weight.
    pub epsilon: f64,
    /// Constants of the weight.
    pub weight: f64,
    /// Whether the weight is applied.
    pub weighted: bool,
    /// Gauss points per patch and direction.
    pub quadrature: usize,
    /// "paper" or "unit-ring".
    pub normalisation: String,
    /// lambda_a and lambda_e.
    pub range: [f64; 2],
    /// Steps below and above lambda_l.
    pub steps: [usize; 2],
}

impl Parameters {
    /// The parameters of a run.
    pub fn new(valences: Vec<usize>, knots: Knots, options: &Options, range: &Range) -> Self {
        let settings = &options.settings;
        Parameters {
            valences,
            starts: match options.starts {
                Starts::Grid => "10x10",
                Starts::Full => "full",
            }
            .to_owned(),
            bounds: match options.bounds {
                Bounds::Paper => "paper",
                Bounds::Sharp => "sharp",
            }
            .to_owned(),
            knots,
            margin: options.margin,
            phi: options.phi,
            epsilon: settings.epsilon,
            weight: settings.n,
            weighted: settings.weighted,
            quadrature: settings.quadrature_order,
            normalisation: match settings.normalisation {
                Normalisation::UnitRing => "unit-ring",
                Normalisation::Relative => "relative",
                _ => "paper",
            }
            .to_owned(),
            range: [range.start, range.end],
            steps: [range.below, range.above],
        }
    }

    /// The run that is described; words that are not known count as the defaults.
    pub fn options(&self) -> (Options, Range) {
        let options = Options {
            bounds: if self.bounds == "sharp" {
                Bounds::Sharp
            } else {
                Bounds::Paper
            },
            margin: self.margin,
            phi: self.phi,
            settings: Settings {
                epsilon: self.epsilon,
                n: self.weight,
                quadrature_order: self.quadrature,
                weighted: self.weighted,
                normalisation: match self.normalisation.as_str() {
                    "unit-ring" => Normalisation::UnitRing,
                    "relative" => Normalisation::Relative,
                    _ => Normalisation::Paper,
                },
            },
            starts: if self.starts == "full" {
                Starts::Full
            } else {
                Starts::Grid
            },
        };
        let range = Range {
            start: self.range[0],
            end: self.range[1],
            below: self.steps[0],
            above: self.steps[1],
        };
        (options, range)
    }

    /// The splines and featured values of a study of this run. Where no end of the recommended region was
    /// found, it is that of the range.
    pub fn entry(&self, study: &Study) -> LambdaEntry {
        let lambda_r2 = study.featured("lambda_r2").map_or(self.range[1], |f| f.lambda);
        study.entry(self.phi, lambda_r2)
    }

    /// What the samples depend on, on one line: the parameters but those that come later, and the tool's
    /// version.
    pub fn sample_key(&self) -> String {
        let later = Parameters {
            valences: Vec::new(),
            knots: Knots::Detected,
            ..self.clone()
        };
        let parameters = serde_json::to_string(&later).unwrap_or_default();
        format!(
            "{{\"version\":\"{}\",\"parameters\":{parameters}}}",
            env!("CARGO_PKG_VERSION")
        )
    }
}

/// Refuses parameters with which no study can be made, before anything is written.
///
/// # Errors
/// Those of the margin, of the objective's constants, and of a valence at which mu reaches lambda.
pub fn check(parameters: &Parameters) -> Result<(), Error> {
    let (options, range) = parameters.options();
    for &valence in &parameters.valences {
        // mu comes nearest to lambda at the end
        Relaxation::new(valence)?.plane(range.end)?;
        // the margin and the constants of the objective are refused here
        Problem::new(valence, range.start, &options)?;
    }
    Ok(())
}

/// Where finished samples are kept while a run lasts.
pub trait Kept: Sync {
    /// The sample of a valence at a lambda, if it is finished.
    fn get(&self, valence: usize, lambda: f64) -> Option<LambdaSample>;

    /// Keeps a finished sample.
    ///
    /// # Errors
    /// Whatever prevents it, which ends the run.
    fn add(&self, sample: &LambdaSample) -> Result<(), Error>;
}

/// Nothing is kept.
impl Kept for () {
    fn get(&self, _: usize, _: f64) -> Option<LambdaSample> {
        None
    }

    fn add(&self, _: &LambdaSample) -> Result<(), Error> {
        Ok(())
    }
}

/// Computes the studies of all valences, in their order. Finished samples are taken from where they are
/// `kept`, and added there.
///
/// # Errors
/// Those of [`check`], of tuning and fitting, and of keeping samples.
pub fn studies(parameters: &Parameters, kept: &dyn Kept, progress: &dyn Progress) -> Result<Vec<Study>, Error> {
    check(parameters)?;
    let (options, range) = parameters.options();
    let mut tasks = Vec::new();
    for &valence in &parameters.valences {
        let lambdas = range.lambdas(valence)?;
        tasks.extend(lambdas.into_iter().map(|lambda| (valence, lambda)));
    }
    let computed = each(progress, "tuning", &tasks, |&(valence, lambda)| {
        if let Some(sample) = kept.get(valence, lambda) {
            return Ok(sample);
        }
        let found = sample(valence, lambda, &options)?;
        kept.add(&found)?;
        Ok::<LambdaSample, Error>(found)
    })?;
    each(progress, "splines", &parameters.valences, |&valence| {
        let samples: Vec<LambdaSample> = computed.iter().filter(|s| s.valence == valence).cloned().collect();
        Ok(Study::new(&samples, &range, &options, parameters.knots)?)
    })
}

/// The minima over lambda of one valence, and the samples between which they were found.
///
/// # Errors
/// A valence for which the rule for s has no solution at some lambda; those of tuning.
pub fn minima_over_lambda(
    valence: usize,
    options: &Options,
    progress: &dyn Progress,
) -> Result<(Global, Vec<LambdaSample>), Error> {
    let lambdas = Range::default().lambdas(valence)?;
    let rule = Relaxation::new(valence)?;
    // before work that may take minutes
    for &lambda in &lambdas {
        rule.plane(lambda)?;
    }
    let samples = each(progress, "tuning", &lambdas, |&lambda| sample(valence, lambda, options))?;
    Ok((global(&samples, options)?, samples))
}
