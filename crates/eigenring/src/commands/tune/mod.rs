//! `eigenring tune`: the best stencil at one lambda, or over all; the best parameters of a scheme file.

mod file;

use super::with_words;
use crate::args::{self, SchemeSettings, TuningArgs};
use crate::error::Error;
use crate::output::Output;
use crate::progress::Terminal;
use crate::threads::Threads;
use crate::valences::{self, Valences};
use clap::{ArgGroup, Args};
use eigenring_atlas::schemes::SchemeName;
use eigenring_atlas::studies::optimality;
use eigenring_atlas::table::{Format, pretty};
use eigenring_atlas::tune::{Found, at, over_lambda};
use eigenring_certify::Status;
use serde_json::Value;
use std::process::ExitCode;

const EXAMPLES: &str = "Examples:\n  eigenring tune -N 6 --lambda 0.39\n  eigenring tune -N 6 --lambda 0.593 --prove 0.5 --unweighted\n  eigenring tune -N 25 --global --format json\n  eigenring new-scheme --like catmull-clark -o my.toml\n  eigenring tune --scheme file:my.toml -N 5..8 --minimise ratio --subject-to hull,c1 -o tuned.toml\n  eigenring tune --scheme file:my.toml -N 5 --fix b=1/4 --minimise E+0.5*lambda:1/2 --resume run.jsonl";

/// Optimise f2 and f3 at one lambda, or lambda too; or the parameters of a scheme file.
///
/// With --scheme file:SCHEME.toml its free parameters run over their ranges. OBJECTIVE is one of E
/// (weighted, as 'objective' prints it), E-unweighted, ratio (|mu/lambda^2 - 1|), lambda:TARGET (|lambda -
/// TARGET|), K_m, strictness (|lambda_6|/mu), hull (the smallest weight, negated) and polar (the variance of
/// edge lengths in the natural configuration), or a sum such as 1*E+10*ratio. The file with the numbers
/// filled in goes to -o, with a certificate for each valence beside it; the exit code is 1 if a condition is
/// not proven.
///
/// Without --scheme: at one lambda there may be several local minima; the one reported is that of the branch
/// which is continued from the global optimum over lambda (branch: "continued"), as far as the valence is
/// tabulated, else the lowest (branch: "lowest"). The lowest value is reported beside it. With --prove, a
/// search by intervals proves that nothing lower was missed; the exit code is 1 if it does not.
#[derive(Args, Debug)]
#[command(group = ArgGroup::new("target").required(true))]
#[command(
    after_help = EXAMPLES,
    after_long_help = with_words(EXAMPLES, "tune")
)]
pub struct Arguments {
    /// Valence; with --scheme also numbers and ranges, such as 3..12
    #[arg(
        short = 'N',
        long = "valence",
        visible_alias = "valences",
        value_name = "LIST",
        value_parser = valences::one_or_list,
        allow_hyphen_values = true
    )]
    valence: Valences,
    /// Tune the parameters of a scheme file
    #[arg(long, value_name = "SPEC", group = "target", requires = "minimise", conflicts_with_all = ["starts", "bounds", "unweighted", "epsilon", "weight", "quadrature", "phi", "normalisation"])]
    scheme: Option<SchemeName>,
    #[command(flatten)]
    settings: SchemeSettings,
    #[command(flatten)]
    file: file::FileArgs,
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
    /// Prove that no admissible stencil at this lambda is better than the lowest one found by more than this
    /// part of its objective, 1e-6 without a number; minutes. Valences 5 to 64; the paper's bounds, phi,
    /// normalisation, weight and quadrature
    #[arg(long, value_name = "REL", value_parser = args::number, num_args = 0..=1, default_missing_value = "1e-6", conflicts_with_all = ["scheme", "bounds", "epsilon", "weight", "quadrature", "phi", "normalisation"])]
    prove: Option<f64>,
    #[command(flatten)]
    tuning: TuningArgs,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let format = self.output.format()?;
        self.threads.start()?;
        if let Some(scheme) = &self.scheme {
            let scheme = self.settings.apply(scheme.clone())?;
            return self
                .file
                .run(scheme, self.valence.closed()?, self.tuning.margin, &self.output);
        }
        self.file.refuse()?;
        self.settings.refuse("--scheme file:SCHEME.toml")?;
        let &[valence] = self.valence.closed()? else {
            return Err(Error::usage(
                "several valences have no meaning without --scheme",
                "one valence, or --scheme file:SCHEME.toml",
            ));
        };
        let options = self.tuning.options();
        let mut found = match self.lambda {
            Some(lambda) => at(valence, lambda, &options)?,
            None => over_lambda(valence, &options, &Terminal)?,
        };
        let mut holds = true;
        if let Some(epsilon) = self.prove {
            let tuned = found.tuned(&options);
            let proofs = optimality::prove(&[tuned], epsilon, &Terminal)?;
            holds = proofs[0].status() == Status::Proven;
            found.record = optimality::with_proof(found.record, &proofs[0], epsilon);
        }
        let Found {
            lowest: _,
            record,
            active,
            title,
            minima,
        } = found;
        let text = match format {
            Format::Json => {
                let mut object = record.json();
                object.insert("active".to_owned(), active.into());
                object.insert(title.to_owned(), minima.json());
                pretty(&Value::Object(object))
            }
            Format::Text => {
                let record = record.with("active", active.join("+"));
                let title = title.replace('_', " ");
                format!("{}\n{title}\n{}", record.text(), minima.render(Format::Text))
            }
            format => record.with("active", active.join("+")).render(format),
        };
        self.output.emit(&text)?;
        Ok(ExitCode::from(u8::from(!holds)))
    }
}
