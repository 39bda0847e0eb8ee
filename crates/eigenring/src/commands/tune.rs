//! `eigenring tune`: the best stencil at one lambda, or over all.

use crate::args::{self, Output, TuningArgs};
use crate::error::Error;
use crate::files;
use crate::run::minima_over_lambda;
use crate::schemes::check_rule;
use crate::table::{Format, Record, Table, pretty};
use clap::{ArgGroup, Args};
use eigenring_scheme::lambda::LambdaTable;
use eigenring_tune::objective::Settings;
use eigenring_tune::search::distance;
use eigenring_tune::sweep::{Minimum, Options, Problem, Sample, sample};
use serde_json::Value;
use std::process::ExitCode;

/// Optimise f2 and f3 at one lambda, or lambda too.
///
/// At one lambda there may be several local minima; the one reported is that of the branch which is continued from the
/// global optimum over lambda (branch: "continued"), as far as the valence is tabulated, else the lowest (branch: "lowest"). The
/// lowest value is reported beside it.
#[derive(Args, Debug)]
#[command(group = ArgGroup::new("target").required(true))]
#[command(after_help = "Examples:\n  eigenring tune -N 6 --lambda 0.39\n  eigenring tune -N 25 --global --format json")]
pub struct Arguments {
    /// Valence
    #[arg(short = 'N', long, value_name = "N", value_parser = args::valence, allow_negative_numbers = true)]
    valence: usize,
    /// Subdominant eigenvalue, 1/8 < lambda < 1
    #[arg(
        long,
        value_name = "L",
        value_parser = args::number,
        group = "target",
        allow_negative_numbers = true
    )]
    lambda: Option<f64>,
    /// Optimise lambda as well, over [0.15, 0.9]
    #[arg(long, group = "target")]
    global: bool,
    #[command(flatten)]
    tuning: TuningArgs,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let valence = self.valence;
        let options = self.tuning.options();
        match self.lambda {
            Some(lambda) => self.at(valence, lambda, &options),
            None => self.over_all(valence, &options),
        }
    }

    fn at(&self, valence: usize, lambda: f64, options: &Options) -> Result<ExitCode, Error> {
        check_rule(valence, lambda)?;
        let found = sample(valence, lambda, options)?;
        let (index, branch) = match tabulated(&found, options)? {
            Some(index) => (index, "continued"),
            None => (0, "lowest"),
        };
        let record = record(&found, index, branch);
        self.print(record, "all_minima", minima(&found.minima))
    }

    fn over_all(&self, valence: usize, options: &Options) -> Result<ExitCode, Error> {
        let (found, samples) = minima_over_lambda(valence, options)?;
        let best = found.optimum();
        let evaluations: usize = samples.iter().map(|s| s.evaluations + s.gradient_evaluations).sum();
        let at_optimum = Sample {
            valence,
            lambda: best.lambda,
            s: best.s,
            minima: vec![best.minimum.clone()],
            starts: samples.iter().map(|s| s.starts).sum(),
            descents: samples.iter().map(|s| s.descents).sum(),
            evaluations,
            gradient_evaluations: found.gradient_evaluations,
        };
        let (record, active) = record(&at_optimum, 0, "continued");
        let record = record.with("lambda_minima", found.minima.len());
        let mut table = Table::new(["lambda", "s", "f2", "f3", "total", "active", "kind"]);
        for m in &found.minima {
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
        self.print((record, active), "minima_over_lambda", table)
    }

    fn print(&self, found: (Record, Vec<String>), name: &str, minima: Table) -> Result<ExitCode, Error> {
        let (record, active) = found;
        let text = match self.output.format {
            Format::Json => {
                let mut object = record.json();
                object.insert("active".to_owned(), active.into());
                object.insert(name.to_owned(), minima.json());
                pretty(&Value::Object(object))
            }
            Format::Text => {
                let record = record.with("active", active.join("+"));
                let title = name.replace('_', " ");
                format!("{}\n{title}\n{}", record.text(), minima.render(Format::Text))
            }
            format => record.with("active", active.join("+")).render(format),
        };
        files::emit(None, text.as_bytes())?;
        Ok(ExitCode::SUCCESS)
    }
}

/// Which of the minima the embedded spline follows: the nearest, if the valence is tabulated at this lambda and the objective
/// is the one that was tabulated.
fn tabulated(found: &Sample, options: &Options) -> Result<Option<usize>, Error> {
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

fn record(found: &Sample, index: usize, branch: &str) -> (Record, Vec<String>) {
    let best = &found.minima[index];
    let record = Record::default()
        .with("valence", found.valence)
        .with("lambda", found.lambda)
        .with("s", found.s)
        .with("f2", best.f2)
        .with("f3", best.f3)
        .with("total", best.total)
        .with("branch", branch)
        .with("lowest", found.minima[0].total)
        .with("theta", best.theta)
        .with("kkt_residual", best.kkt_residual)
        .with("minima", found.minima.len())
        .with("starts", found.starts)
        .with("descents", found.descents)
        .with("evaluations", found.evaluations + found.gradient_evaluations);
    (record, best.active.clone())
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
