//! The best member of the lambda-scheme at one lambda, or over all.

use crate::error::Error;
use crate::progress::Progress;
use crate::run::minima_over_lambda;
use crate::studies::optimality::Tuned;
use crate::table::{Record, Table};
use eigenring_scheme::lambda::LambdaTable;
use eigenring_tune::global::LambdaMinimum;
use eigenring_tune::objective::Settings;
use eigenring_tune::search::distance;
use eigenring_tune::sweep::{LambdaSample, Minimum, Options, Problem, sample};

/// What was found: one minimum, and those beside it.
#[derive(Clone, Debug)]
pub struct Found {
    /// valence, lambda, s, f2, f3, total, branch and what the search cost.
    pub record: Record,
    /// The bounds on which the minimum lies.
    pub active: Vec<String>,
    /// What [`Found::minima`] are.
    pub title: &'static str,
    /// All minima: over (f2, f3) at one lambda, or over lambda too.
    pub minima: Table,
    /// The lowest minimum at the reported lambda.
    pub lowest: LambdaSample,
}

impl Found {
    /// The lowest minimum, and what it was tuned for.
    pub fn tuned(&self, options: &Options) -> Tuned {
        let LambdaSample { valence, lambda, s, .. } = self.lowest;
        Tuned {
            valence,
            lambda,
            s,
            stencil: [self.lowest.minima[0].f2, self.lowest.minima[0].f3],
            weighted: options.settings.weighted,
            margin: options.margin,
        }
    }
}

/// Optimises f2 and f3 at one lambda. Of several local minima the one of the branch is taken that is
/// continued from the global optimum over lambda ("continued"), as far as that is tabulated, else the lowest
/// ("lowest").
///
/// # Errors
/// Those of [`Relaxation::plane`](eigenring_scheme::lambda::Relaxation::plane) and of the search.
pub fn at(valence: usize, lambda: f64, options: &Options) -> Result<Found, Error> {
    let found = sample(valence, lambda, options)?;
    let (index, branch) = match tabulated(&found, options)? {
        Some(index) => (index, "continued"),
        None => (0, "lowest"),
    };
    let best = &found.minima[index];
    Ok(Found {
        record: record(&found, best, branch),
        active: best.active.clone(),
        title: "all_minima",
        minima: minima(&found.minima),
        lowest: found,
    })
}

/// Optimises lambda as well.
///
/// # Errors
/// Those of [`minima_over_lambda`].
pub fn over_lambda(valence: usize, options: &Options, progress: &dyn Progress) -> Result<Found, Error> {
    let (found, samples) = minima_over_lambda(valence, options, progress)?;
    let best = found.optimum();
    let at_optimum = LambdaSample {
        valence,
        lambda: best.lambda,
        s: best.s,
        minima: vec![best.minimum.clone()],
        starts: samples.iter().map(|s| s.starts).sum(),
        descents: samples.iter().map(|s| s.descents).sum(),
        evaluations: samples.iter().map(|s| s.evaluations + s.gradient_evaluations).sum(),
        gradient_evaluations: found.gradient_evaluations,
    };
    Ok(Found {
        record: record(&at_optimum, &best.minimum, "continued").with("lambda_minima", found.minima.len()),
        active: best.minimum.active.clone(),
        title: "minima_over_lambda",
        minima: lambda_minima(&found.minima),
        lowest: at_optimum,
    })
}

/// Which of the minima the embedded spline follows: the nearest, if the valence is tabulated at this lambda
/// and the objective is the one that was tabulated.
fn tabulated(found: &LambdaSample, options: &Options) -> Result<Option<usize>, Error> {
    let Ok(entry) = LambdaTable::embedded()?.entry(found.valence) else {
        return Ok(None);
    };
    if options.phi != entry.phi || options.settings != Settings::default() {
        return Ok(None);
    }
    let Ok((f2, f3)) = entry.weights(found.lambda) else {
        return Ok(None);
    };
    let domain = Problem::new(found.valence, found.lambda, options)?.domain;
    let far = |m: &Minimum| distance(&domain, [f2, f3], [m.f2, m.f3]);
    let nearest = (0..found.minima.len()).min_by(|&a, &b| far(&found.minima[a]).total_cmp(&far(&found.minima[b])));
    Ok(nearest)
}

fn record(found: &LambdaSample, best: &Minimum, branch: &str) -> Record {
    Record::default()
        .with("valence", found.valence)
        .with("lambda", found.lambda)
        .with("s", found.s)
        .with("f2", best.f2)
        .with("f3", best.f3)
        .with("total", best.total)
        .with("branch", branch)
        .with("lowest", found.minima[0].total)
        .with("theta", best.theta.to_degrees())
        .with("kkt_residual", best.kkt_residual)
        .with("minima", found.minima.len())
        .with("starts", found.starts)
        .with("descents", found.descents)
        .with("evaluations", found.evaluations + found.gradient_evaluations)
}

fn minima(minima: &[Minimum]) -> Table {
    let mut table = Table::new(["f2", "f3", "total", "active", "kkt_residual"]);
    for m in minima {
        table.push(vec![
            m.f2.into(),
            m.f3.into(),
            m.total.into(),
            m.active.join("+").into(),
            m.kkt_residual.into(),
        ]);
    }
    table
}

fn lambda_minima(minima: &[LambdaMinimum]) -> Table {
    let mut table = Table::new(["lambda", "s", "f2", "f3", "total", "active", "kind"]);
    for m in minima {
        table.push(vec![
            m.lambda.into(),
            m.s.into(),
            m.minimum.f2.into(),
            m.minimum.f3.into(),
            m.minimum.total.into(),
            m.minimum.active.join("+").into(),
            format!("{:?}", m.kind).to_lowercase().into(),
        ]);
    }
    table
}
