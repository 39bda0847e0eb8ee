//! `eigenring verify`: certificates.

mod all;

use super::{RESULTS, UNSTORED, with_words};
use crate::args::{self, CornerArgs, SchemeSettings};
use crate::error::Error;
use crate::files;
use crate::output::FormatOption;
use crate::progress::{Terminal, note};
use crate::threads::Threads;
use crate::valences::{self, MAX_VALENCE, Valences};
use clap::{ArgGroup, Args, ValueEnum};
use eigenring_atlas::certificates::{beside, confirm, curve, family, input, ranged};
use eigenring_atlas::nonuniform::certificate::Certificate;
use eigenring_atlas::nonuniform::verify as nonuniform;
use eigenring_atlas::progress::each;
use eigenring_atlas::schemes::SchemeName;
use eigenring_atlas::verify;
use eigenring_certify::parameter::{self, ParameterCertificate};
use eigenring_certify::range::{Limits, RangeCertificate, prove_range};
use eigenring_certify::valences as all_valences;
use eigenring_certify::{Requirement, Status, certify};
use eigenring_nonuniform::{Scheme as NonUniform, Spokes};
use eigenring_scheme::user::Reading;
use eigenring_scheme::{Number, Shape};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const EXAMPLES: &str = "Examples:\n  eigenring verify --scheme catmull-clark -N 5\n  eigenring verify --scheme lambda:optimal -N 3,6..8 --require strict\n  eigenring verify --lambda-range 0.4..0.6 -N 6 --require strict\n  eigenring verify --scheme catmull-clark -N 3 --format json\n  eigenring verify --scheme catmull-clark -N 7 -o N7.json   store it, to be checked again:\n  eigenring verify --recheck N7.json\n  eigenring verify --scheme catmull-clark --valences 3..       every valence, by one proof\n  eigenring verify --all                                       rebuilds results/certificates";

/// Prove that a scheme is C1, or has bounded curvature, at a valence or over a range of lambda.
///
/// What is certified is the exact scheme: decimals and fractions stand for themselves. Each statement is
/// proven, refuted with a witness, undecided, or, for weights that are results of rounding, numerical. The
/// exit code is 0 if everything that is required is proven, and 1 if not. docs/certificates.md says what each
/// statement means and which theorems are used.
#[derive(Args, Debug)]
#[command(group = ArgGroup::new("what").required(true).multiple(true))]
#[command(
    after_help = EXAMPLES,
    after_long_help = with_words(EXAMPLES, "verify")
)]
pub struct Arguments {
    /// The scheme: see 'eigenring --help'; with --lambda-range its weights f2 and f3 are kept, by default
    /// those of the splines
    #[arg(long, value_name = "SPEC", group = "what", conflicts_with_all = ["recheck", "all"])]
    scheme: Option<SchemeName>,
    #[command(flatten)]
    settings: SchemeSettings,
    /// Valences: numbers and ranges, such as 5 or 3,5..8, with a certificate for each; 3.. is every valence,
    /// of catmull-clark and doo-sabin, and of hnuss for all positive knot intervals. May be left out where
    /// --fan, --knots or a scheme file for one valence fix it. With --all: those of the lambda-scheme, by
    /// default 3..20
    #[arg(
        short = 'N',
        long = "valence",
        visible_alias = "valences",
        value_name = "LIST",
        conflicts_with = "recheck",
        allow_negative_numbers = true
    )]
    valences: Option<Valences>,
    #[command(flatten)]
    corner: CornerArgs,
    /// The lambda-scheme for every lambda from A to B
    #[arg(long, value_name = "A..B", group = "what", value_parser = range, allow_hyphen_values = true, conflicts_with_all = ["recheck", "all"])]
    lambda_range: Option<[f64; 2]>,
    /// A scheme file for every value of a parameter from A to B
    #[arg(long = "range", value_name = "NAME=A..B", value_parser = parameter_range, allow_hyphen_values = true, requires = "scheme", conflicts_with_all = ["recheck", "all", "lambda_range"])]
    parameter: Option<(String, [Number; 2])>,
    /// What must be proven
    #[arg(long, value_enum, default_value_t, conflicts_with_all = ["recheck", "all"])]
    require: Required,
    /// Take the weights of a file as they are written: by default the special stencils' sums within 1e-12 of
    /// 1, and weights that a reflection exchanges (at the centre also a rotation) and that differ by no more,
    /// are taken for rounded and balanced
    #[arg(long, conflicts_with_all = ["recheck", "all", "lambda_range"])]
    exact: bool,
    /// Also store the certificate; with several valences a folder, with a file such as N005.json for each
    #[arg(short, long, value_name = "FILE", conflicts_with_all = ["recheck", "all"])]
    output: Option<PathBuf>,
    /// Check a stored certificate again, or all that a folder holds, by its evidence alone
    #[arg(long, value_name = "PATH", group = "what", conflicts_with = "all")]
    recheck: Option<PathBuf>,
    /// Make the certificates of results/certificates: Catmull-Clark, featured members of the lambda-scheme,
    /// and ranges of lambda
    #[arg(long, group = "what")]
    all: bool,
    /// With --all: output folder; files go to its subfolder certificates. By default results, or
    /// eigenring-out with a choice of valences
    #[arg(long, value_name = "FOLDER", requires = "all")]
    out: Option<PathBuf>,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    format: FormatOption,
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

/// Reads `NAME=A..B`.
fn parameter_range(text: &str) -> Result<(String, [Number; 2]), String> {
    let parts = || {
        let (name, range) = text.split_once('=')?;
        let (first, last) = range.split_once("..")?;
        let ends: [Number; 2] = [first.trim().parse().ok()?, last.trim().parse().ok()?];
        (ends[0].rational() < ends[1].rational()).then(|| (name.trim().to_owned(), ends))
    };
    parts().ok_or_else(|| "accepted is NAME=A..B with A < B, such as a=0.2..0.4".to_owned())
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        // the parser lets an option pass whose partner conflicts with another one
        if self.out.is_some() && !self.all {
            return Err(Error::usage(
                "--out has no meaning for one certificate",
                "--all with --out, or -o FILE",
            ));
        }
        self.threads.start()?;
        if let Some(path) = &self.recheck {
            self.corner.refuse("with --recheck")?;
            return self.check_again(path);
        }
        if self.all {
            self.corner.refuse("with --all")?;
            let default = if self.valences.is_some() { UNSTORED } else { RESULTS };
            let out = self.out.clone().unwrap_or_else(|| default.into());
            let usual: Vec<usize> = (3..=20).collect();
            let valences = self.valences.as_ref().map_or(Ok(usual.as_slice()), Valences::closed)?;
            return all::make(valences, &out, self.format.format());
        }
        if let (Some(valences), Some(scheme), None) = (&self.valences, &self.scheme, &self.parameter)
            && let (Some(from), None) = (valences.from(), self.lambda_range)
        {
            self.corner.refuse("for all valences at once")?;
            if let SchemeName::NonUniform(scheme) = scheme {
                return self.for_all_intervals(*scheme, from);
            }
            return self.at_all_valences(scheme, valences, from);
        }
        let valences = self.valences.as_ref().map(Valences::closed).transpose()?;
        if let Some(range) = &self.parameter {
            self.corner.refuse("over a range of a parameter")?;
            return self.over_parameter(valences, range);
        }
        match self.lambda_range {
            Some(lambda) => {
                self.corner.refuse("over a range of lambda")?;
                self.over_range(valences.ok_or_else(valences::missing)?, lambda)
            }
            None => self.at_corners(valences),
        }
    }

    /// One certificate of all valences from one on, and certificates of those that come before.
    fn at_all_valences(&self, scheme: &SchemeName, valences: &Valences, from: usize) -> Result<ExitCode, Error> {
        let scheme = &self.settings.apply(scheme.clone())?;
        let family = family(scheme)?;
        self.refuse_exact(scheme)?;
        let first = from.max(all_valences::LEAST);
        let inputs = valences.below(first).into_iter().map(|valence| {
            let input = input(scheme, valence, Reading::Balanced, &args::tuner())?;
            Ok((input, valence))
        });
        let inputs = inputs.collect::<Result<Vec<_>, Error>>()?;
        let singles = each(&Terminal, "certificates", &inputs, |(input, valence)| {
            certify(input.clone(), *valence)
        })?;
        let rest = all_valences::prove(family, first)?;
        if let Some(path) = &self.output {
            let mut written = vec![(format!("N{first:03}-and-more.json"), rest.to_json()?)];
            for single in &singles {
                written.push((format!("N{:03}.json", single.valence), single.to_json()?));
            }
            for (name, text) in &written {
                let path = if singles.is_empty() {
                    path.clone()
                } else {
                    path.join(name)
                };
                files::save(&path, text.as_bytes())?;
            }
        }
        let (status, text) = verify::all_valences(&singles, &rest, self.require.into(), self.format.format());
        files::emit(None, text.as_bytes())?;
        Ok(exit(status == Status::Proven))
    }

    fn refuse_exact(&self, scheme: &SchemeName) -> Result<(), Error> {
        if self.exact && !matches!(scheme, SchemeName::File(_)) {
            return Err(Error::usage(
                "--exact has no meaning for a scheme that is built in, whose weights are exact",
                "--exact with --scheme file:SCHEME.toml",
            ));
        }
        Ok(())
    }

    /// Certificates of a scheme around the corners that are asked for, one for each valence.
    fn at_corners(&self, valences: Option<&[usize]>) -> Result<ExitCode, Error> {
        let scheme = self.scheme.clone();
        let scheme = scheme.ok_or_else(|| Error::usage("no scheme is given", "--scheme SPEC"))?;
        let scheme = &self.settings.apply(scheme)?;
        if let SchemeName::NonUniform(scheme) = scheme {
            return self.with_intervals(*scheme, valences);
        }
        let corners = match valences {
            Some(valences) => valences
                .iter()
                .map(|&valence| self.corner.shape(Some(valence), scheme))
                .collect(),
            None => self.corner.shape(None, scheme).map(|corner| vec![corner]),
        }?;
        self.refuse_exact(scheme)?;
        let reading = if self.exact { Reading::Exact } else { Reading::Balanced };
        let tuner = args::tuner();
        let mut inputs = Vec::new();
        let mut large = false;
        for (shape, steps) in &corners {
            let corner = shape.corner(scheme.centre()?, *steps)?;
            let input = beside(scheme, shape, *steps, reading, &tuner)?;
            let degree = scheme.around(&corner, &tuner)?.degree();
            large |= degree.is_some_and(|degree| degree >= LARGE);
            inputs.push((input, corner.sectors().sectors()));
        }
        if large {
            note("patches of high degree have large blocks: this may take minutes");
        }
        let certificates = each(&Terminal, "certificates", &inputs, |(input, valence)| {
            certify(input.clone(), *valence)
        })?;
        self.store(&certificates, |certificate| {
            (certificate.valence, certificate.to_json())
        })?;
        let requirement = self.require.into();
        let text = verify::certificates(&certificates, requirement, self.format.format());
        files::emit(None, text.as_bytes())?;
        let balanced: Vec<_> = certificates
            .iter()
            .filter_map(|certificate| certificate.balanced)
            .collect();
        if let Some(largest) = balanced.iter().map(|balanced| balanced.largest).reduce(f64::max) {
            let rows: usize = balanced.iter().map(|balanced| balanced.rows).sum();
            note(&format!(
                "rounded weights were balanced in {rows} stencil{}, the largest change is {largest:e}; --exact takes them as written",
                if rows == 1 { "" } else { "s" },
            ));
        }
        let statuses: Vec<Status> = certificates
            .iter()
            .map(|certificate| requirement.verdict(&certificate.checks).1)
            .collect();
        if statuses.contains(&Status::Numerical) {
            note("holds for weights that are results of rounding; of the exact scheme nothing is proven");
        }
        Ok(exit(statuses.iter().all(|&status| status == Status::Proven)))
    }

    /// What is known of a scheme with knot intervals.
    fn with_intervals(&self, scheme: NonUniform, valences: Option<&[usize]>) -> Result<ExitCode, Error> {
        let required = self.required(scheme)?;
        if self.exact {
            let message = format!("--exact has no meaning for {scheme}, whose intervals are exact");
            return Err(Error::usage(message, "--exact with --scheme file:SCHEME.toml"));
        }
        let name = SchemeName::NonUniform(scheme);
        let valences = match valences {
            Some(valences) => valences.iter().copied().map(Some).collect(),
            None => vec![None],
        };
        let mut reports = Vec::new();
        for valence in valences {
            let spokes = match self.corner.shape(valence, &name)? {
                (Shape::Knots { intervals, next }, None) => Spokes::new(intervals, next),
                (Shape::Closed { sectors }, None) => Spokes::stationary(vec![1.0; sectors]),
                _ => {
                    return Err(Error::usage(
                        format!("{scheme} has closed fans only"),
                        "--knots, or -N alone",
                    ));
                }
            };
            let spokes = spokes.map_err(eigenring_atlas::Error::from)?;
            reports.push(nonuniform::Report::new(scheme, spokes, required)?);
        }
        self.report(&reports)
    }

    /// What is known of HNUSS at all valences for all positive intervals.
    fn for_all_intervals(&self, scheme: NonUniform, from: usize) -> Result<ExitCode, Error> {
        self.corner
            .refuse("with an open range of valences, which is about all intervals")?;
        if from != 3 {
            return Err(Error::usage(
                format!("the proof for all valences begins at 3, and not at {from}"),
                "-N 3.., or a range with an end",
            ));
        }
        self.report(&[nonuniform::Report::for_all(scheme, self.required(scheme)?)?])
    }

    /// Stores certificates if that is asked for, and prints what they say.
    fn report(&self, reports: &[nonuniform::Report]) -> Result<ExitCode, Error> {
        let certificates: Vec<Certificate> = reports.iter().map(Certificate::of).collect();
        self.store(&certificates, |certificate| {
            (certificate.valence().unwrap_or(0), certificate.to_json())
        })?;
        for report in reports {
            files::emit(None, report.render(self.format.format()).as_bytes())?;
        }
        Ok(exit(reports.iter().all(|report| report.status() == Status::Proven)))
    }

    /// What must hold of a scheme with knot intervals.
    fn required(&self, scheme: NonUniform) -> Result<nonuniform::Required, Error> {
        match self.require {
            Required::C1 => Ok(nonuniform::Required::C1),
            Required::Bounded => Ok(nonuniform::Required::Bounded),
            _ => Err(Error::usage(
                format!("this is not examined for {scheme}"),
                "--require c1 or bounded",
            )),
        }
    }

    fn over_parameter(&self, valences: Option<&[usize]>, range: &(String, [Number; 2])) -> Result<ExitCode, Error> {
        let requirement: Requirement = self.require.into();
        let scheme = self.scheme.clone();
        let scheme = scheme.ok_or_else(|| Error::usage("no scheme is given", "--scheme SPEC"))?;
        let scheme = self.settings.apply(scheme)?;
        let valences = match valences {
            Some(valences) => valences.to_vec(),
            None => vec![args::only_valence(&scheme)?],
        };
        let reading = if self.exact { Reading::Exact } else { Reading::Balanced };
        let inputs = valences
            .iter()
            .map(|&valence| Ok((valence, ranged(&scheme, valence, range, reading, &args::tuner())?)));
        let inputs: Vec<_> = inputs.collect::<Result<_, Error>>()?;
        let certificates = each(&Terminal, "ranges", &inputs, |(valence, input)| {
            let proven = parameter::prove(input.clone(), *valence, requirement, parameter::Limits::default());
            scheme.blamed(proven)
        })?;
        self.store(&certificates, |certificate| {
            (certificate.valence, certificate.to_line())
        })?;
        let text = verify::parameters(&certificates, requirement, self.format.format());
        files::emit(None, text.as_bytes())?;
        let proven = |certificate: &ParameterCertificate| {
            let required = certificate.required(requirement);
            required.iter().all(|stretch| stretch.status == Status::Proven)
        };
        Ok(exit(certificates.iter().all(proven)))
    }

    fn over_range(&self, valences: &[usize], lambda: [f64; 2]) -> Result<ExitCode, Error> {
        let requirement: Requirement = self.require.into();
        if requirement == Requirement::Hull {
            return Err(Error::usage("hull is not checked over a range", "c1, bounded, strict"));
        }
        let curves = valences
            .iter()
            .map(|&valence| Ok((valence, curve(self.scheme.as_ref(), valence)?)));
        let curves: Vec<_> = curves.collect::<Result<_, Error>>()?;
        let certificates = each(&Terminal, "ranges of lambda", &curves, |(valence, curve)| {
            prove_range(*valence, curve.clone(), lambda, Limits::default())
        })?;
        self.store(&certificates, |certificate| {
            (certificate.valence, certificate.to_json())
        })?;
        let text = verify::ranges(&certificates, requirement, self.format.format());
        files::emit(None, text.as_bytes())?;
        let proven = |certificate: &RangeCertificate| {
            let required = certificate.required(requirement);
            required.iter().all(|segment| segment.status == Status::Proven)
        };
        Ok(exit(certificates.iter().all(proven)))
    }

    /// Writes certificates to the file that is named, or several into a folder.
    fn store<C, E: Into<Error>>(
        &self,
        certificates: &[C],
        text: impl Fn(&C) -> (usize, Result<String, E>),
    ) -> Result<(), Error> {
        let Some(path) = &self.output else {
            return Ok(());
        };
        for certificate in certificates {
            let (valence, json) = text(certificate);
            let path = match certificates {
                [_] => path.clone(),
                _ => path.join(format!("N{valence:03}.json")),
            };
            files::save(&path, json.map_err(Into::into)?.as_bytes())?;
        }
        Ok(())
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
        let rows = each(&Terminal, "certificates", &paths, |path| confirm(path, MAX_VALENCE))?;
        files::emit(None, verify::rechecks(&rows, self.format.format()).as_bytes())?;
        Ok(exit(rows.iter().all(|row| row.confirmed)))
    }
}

fn exit(proven: bool) -> ExitCode {
    ExitCode::from(u8::from(!proven))
}
