//! `eigenring verify`: certificates.

mod all;

use crate::args::{self, CornerArgs, Output, Valences};
use crate::error::Error;
use crate::files;
use crate::progress::{Terminal, note};
use clap::{ArgGroup, Args, ValueEnum};
use eigenring_atlas::certificates::{beside, confirm, curve};
use eigenring_atlas::progress::each;
use eigenring_atlas::report;
use eigenring_atlas::schemes::SchemeName;
use eigenring_certify::range::{Limits, prove_range};
use eigenring_certify::{Requirement, Status, certify};
use eigenring_scheme::user::Reading;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Prove that a scheme is C1, or has bounded curvature, at a valence or over a range of lambda.
///
/// What is certified is the exact scheme: decimals and fractions stand for themselves. Each statement is
/// proven, refuted with a witness, undecided, or, for weights that are results of rounding, numerical. The
/// exit code is 0 if everything that is required is proven, and 1 if not. docs/certificates.md says what each
/// statement means and which theorems are used.
#[derive(Args, Debug)]
#[command(group = ArgGroup::new("what").required(true).multiple(true))]
#[command(
    after_help = "Examples:\n  eigenring verify --scheme catmull-clark -N 5\n  eigenring verify --scheme lambda:optimal -N 6 --require strict\n  eigenring verify --lambda-range 0.4..0.6 -N 6 --require strict\n  eigenring verify --scheme catmull-clark -N 3 --format json\n  eigenring verify --scheme catmull-clark -N 7 -o N7.json      (and then: eigenring verify --recheck N7.json)\n  eigenring verify --all                                       rebuilds results/certificates"
)]
pub struct Arguments {
    /// The scheme: see 'eigenring --help'; with --lambda-range its weights f2 and f3 are kept, by default
    /// those of the splines
    #[arg(long, value_name = "SPEC", group = "what", conflicts_with_all = ["recheck", "all"])]
    scheme: Option<SchemeName>,
    #[command(flatten)]
    corner: CornerArgs,
    /// The lambda-scheme for every lambda from A to B
    #[arg(long, value_name = "A..B", group = "what", value_parser = range, allow_hyphen_values = true, conflicts_with_all = ["recheck", "all"])]
    lambda_range: Option<[f64; 2]>,
    /// What must be proven
    #[arg(long, value_enum, default_value_t)]
    require: Required,
    /// Take the weights of a file as they are written: by default the special stencils' sums within 1e-12 of
    /// 1, and weights that a reflection exchanges (at the centre also a rotation) and that differ by no more,
    /// are taken for rounded and balanced
    #[arg(long, conflicts_with_all = ["recheck", "all", "lambda_range"])]
    exact: bool,
    /// Also store the certificate
    #[arg(short, long, value_name = "FILE", conflicts_with_all = ["recheck", "all"])]
    output: Option<PathBuf>,
    /// Check a stored certificate again, or all that a folder holds, by its evidence alone
    #[arg(long, value_name = "PATH", group = "what", conflicts_with = "all")]
    recheck: Option<PathBuf>,
    /// Make the certificates of results/certificates: Catmull-Clark, featured members of the lambda-scheme,
    /// and ranges of lambda
    #[arg(long, group = "what")]
    all: bool,
    /// With --all: valences of the lambda-scheme
    #[arg(
        long,
        value_name = "LIST",
        default_value = "3..20",
        allow_hyphen_values = true,
        requires = "all"
    )]
    valences: Valences,
    /// With --all: output folder; files go to its subfolder certificates
    #[arg(long, value_name = "FOLDER", default_value = "results", requires = "all")]
    out: PathBuf,
    #[command(flatten)]
    format: Output,
}

/// Degrees from which a certificate takes ten seconds or more: 11 s at order 14, minutes at order 22.
const LARGE: usize = 13;

/// See [`Requirement`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Required {
    /// Rows sum to 1, eigenvalues 1 and lambda dominate, the characteristic map is regular and injective.
    #[default]
    C1,
    /// C1, and no further eigenvalue exceeds lambda^2 in modulus.
    Bounded,
    /// Bounded, and the eigenvalues after mu are smaller than mu.
    Strict,
    /// No weight is negative.
    Hull,
}

impl From<Required> for Requirement {
    fn from(required: Required) -> Self {
        match required {
            Required::C1 => Requirement::C1,
            Required::Bounded => Requirement::Bounded,
            Required::Strict => Requirement::Strict,
            Required::Hull => Requirement::Hull,
        }
    }
}

/// Reads `A..B`; which values are accepted depends on the scheme.
fn range(text: &str) -> Result<[f64; 2], String> {
    let refuse = || "accepted is A..B with A < B, such as 0.4..0.6".to_owned();
    let (start, end) = text.split_once("..").ok_or_else(refuse)?;
    let number = |text: &str| args::finite(text.trim()).map_err(|_| refuse());
    let (start, end) = (number(start)?, number(end)?);
    if start < end { Ok([start, end]) } else { Err(refuse()) }
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        if let Some(path) = &self.recheck {
            return self.check_again(path);
        }
        if self.all {
            all::make(&self.valences.0, &self.out)?;
            return Ok(ExitCode::SUCCESS);
        }
        match self.lambda_range {
            Some(lambda) => self.over_range(self.corner.plain()?, lambda),
            None => self.at_corner(),
        }
    }

    fn at_corner(&self) -> Result<ExitCode, Error> {
        let (shape, steps) = self.corner.shape()?;
        let scheme = self.scheme.as_ref();
        let scheme = scheme.ok_or_else(|| Error::usage("no scheme is given", "--scheme SPEC"))?;
        let reading = if self.exact { Reading::Exact } else { Reading::Balanced };
        let tuner = args::tuner();
        let corner = shape.corner(scheme.centre()?, steps)?;
        let valence = corner.sectors().sectors();
        let input = beside(scheme, &shape, steps, reading, &tuner)?;
        let degree = scheme.around(&corner, &tuner)?.degree();
        if degree.is_some_and(|degree| degree >= LARGE) {
            note("patches of high degree have large blocks: this may take minutes");
        }
        let certificate = certify(input, valence)?;
        if let Some(path) = &self.output {
            files::write(path, certificate.to_json()?.as_bytes())?;
        }
        let requirement = self.require.into();
        files::emit(
            None,
            report::certificate(&certificate, requirement, self.format.format()).as_bytes(),
        )?;
        if let Some(balanced) = certificate.balanced {
            note(&format!(
                "rounded weights were balanced in {} stencil{}, the largest change is {:e}; --exact takes them as written",
                balanced.rows,
                if balanced.rows == 1 { "" } else { "s" },
                balanced.largest
            ));
        }
        let (_, status) = requirement.verdict(&certificate.checks);
        if status == Status::Numerical {
            note("holds for weights that are results of rounding; of the exact scheme nothing is proven");
        }
        Ok(exit(status == Status::Proven))
    }

    fn over_range(&self, valence: usize, lambda: [f64; 2]) -> Result<ExitCode, Error> {
        let curve = curve(self.scheme.as_ref(), valence)?;
        let requirement: Requirement = self.require.into();
        if requirement == Requirement::Hull {
            return Err(Error::usage("hull is not checked over a range", "c1, bounded, strict"));
        }
        let certificate = prove_range(valence, curve, lambda, Limits::default())?;
        if let Some(path) = &self.output {
            files::write(path, certificate.to_json()?.as_bytes())?;
        }
        files::emit(
            None,
            report::range(&certificate, requirement, self.format.format()).as_bytes(),
        )?;
        let proven = certificate
            .required(requirement)
            .iter()
            .all(|s| s.status == Status::Proven);
        Ok(exit(proven))
    }

    fn check_again(&self, path: &Path) -> Result<ExitCode, Error> {
        let paths = if path.is_dir() {
            let json = |name: &PathBuf| name.extension().is_some_and(|extension| extension == "json");
            files::below(path)?
                .into_iter()
                .filter(json)
                .map(|name| path.join(name))
                .collect()
        } else {
            vec![path.to_owned()]
        };
        if paths.is_empty() {
            let error = eigenring_atlas::Error::content("the folder holds no certificate");
            return Err(error.in_file(path).into());
        }
        let rows = each(&Terminal, "certificates", &paths, |path| {
            confirm(path, args::MAX_VALENCE)
        })?;
        files::emit(None, report::rechecks(&rows, self.format.format()).as_bytes())?;
        Ok(exit(rows.iter().all(|row| row.confirmed)))
    }
}

fn exit(proven: bool) -> ExitCode {
    ExitCode::from(u8::from(!proven))
}
