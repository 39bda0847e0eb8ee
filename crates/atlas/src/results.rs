//! The files of `results/lambda`: what is tabulated, as text.
//!
//! Everything here is a pure function of the studies, so that a check can compare a regenerated file with the
//! one on disk.

use crate::run::Parameters;
use crate::table::{Format, Table, short};
use eigenring_scheme::lambda::{LambdaKnots, LambdaTable};
use eigenring_tune::study::{Knots, Study};
use eigenring_tune::sweep::{Options, Range};
use serde::{Deserialize, Serialize};

/// The version of the JSON file's format.
pub const FORMAT_VERSION: u32 = 1;

/// The folder below the output folder.
pub const FOLDER: &str = "lambda";

/// The file that holds everything at full precision.
pub const EVERYTHING: &str = "tables.json";

/// `tables.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Results {
    /// [`FORMAT_VERSION`].
    pub version: u32,
    /// Where the numbers come from.
    pub provenance: Provenance,
    /// One study a valence.
    pub valences: Vec<Study>,
}

/// How results were made, and a digest of the spline table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// Name and version of the tool.
    pub tool: String,
    /// The command that made them.
    pub command: String,
    /// All parameters of the run.
    pub parameters: Parameters,
    /// FNV-1a over the knots, coefficients and featured values, the same as that of the embedded table.
    pub digest: String,
}

impl Results {
    /// The studies with their provenance.
    pub fn new(valences: Vec<Study>, parameters: Parameters) -> Result<Self, eigenring_scheme::Error> {
        let table = table(&valences, &parameters)?;
        Ok(Results {
            version: FORMAT_VERSION,
            provenance: Provenance {
                tool: tool(),
                command: command(&parameters),
                parameters,
                digest: table.provenance.digest,
            },
            valences,
        })
    }

    /// All files with their names: CSV tables and the JSON file with everything.
    pub fn files(&self) -> Vec<(String, String)> {
        let mut files: Vec<(String, String)> = tables(&self.valences)
            .into_iter()
            .map(|(name, table)| (format!("{name}.csv"), table.render(Format::Csv)))
            .collect();
        files.push((EVERYTHING.to_owned(), self.json()));
        files
    }

    /// The tables that the paper prints, as LaTeX.
    pub fn latex(&self) -> Vec<(String, String)> {
        tables(&self.valences)
            .into_iter()
            .filter(|(name, _)| name.starts_with("table"))
            .map(|(name, table)| (format!("{name}.tex"), table.render(Format::Latex)))
            .collect()
    }

    /// One valence a line: readable in pieces, small, and no number loses a bit.
    fn json(&self) -> String {
        let studies: Vec<String> = self.valences.iter().map(compact).collect();
        format!(
            "{{\"version\":{},\n\"provenance\":{},\n\"valences\":[\n{}\n]}}\n",
            self.version,
            compact(&self.provenance),
            studies.join(",\n")
        )
    }
}

/// Compact JSON of plain data.
fn compact(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("plain data with string keys has a JSON form")
}

/// Name and version of the tool, as results record it.
pub fn tool() -> String {
    format!("eigenring {}", env!("CARGO_PKG_VERSION"))
}

/// The command line that makes the results of these parameters; what it does not say is the default.
fn command(parameters: &Parameters) -> String {
    let valences: Vec<String> = parameters.valences.iter().map(usize::to_string).collect();
    let valences = match parameters.valences.as_slice() {
        [first, .., last] if last - first + 1 == parameters.valences.len() => format!("{first}..{last}"),
        _ => valences.join(","),
    };
    let mut command = format!("eigenring tables --valences {valences} --starts {}", parameters.starts);
    let usual = Parameters::new(Vec::new(), Knots::Detected, &Options::default(), &Range::default());
    let mut option = |differs: bool, text: String| {
        if differs {
            command.push_str(&text);
        }
    };
    let p = parameters;
    option(p.bounds != usual.bounds, format!(" --bounds {}", p.bounds));
    option(p.margin != usual.margin, format!(" --margin {}", p.margin));
    option(p.knots == Knots::Paper, " --knots paper".to_owned());
    option(p.knots == Knots::Sharp, " --knots sharp".to_owned());
    option(p.knots == Knots::Fine, " --knots fine".to_owned());
    option(p.weighted != usual.weighted, " --unweighted".to_owned());
    option(p.epsilon != usual.epsilon, format!(" --epsilon {}", p.epsilon));
    option(p.weight != usual.weight, format!(" --weight {}", p.weight));
    option(
        p.quadrature != usual.quadrature,
        format!(" --quadrature {}", p.quadrature),
    );
    option(p.phi != usual.phi, format!(" --phi {}", p.phi));
    option(
        p.normalisation != usual.normalisation,
        format!(" --normalisation {}", p.normalisation),
    );
    command
}

/// The table to be embedded.
pub fn table(studies: &[Study], parameters: &Parameters) -> Result<LambdaTable, eigenring_scheme::Error> {
    let entries = studies.iter().map(|study| parameters.entry(study)).collect();
    LambdaTable::new(tool(), command(parameters) + " --embed", entries)
}

/// What people look at first: the optimal lambda of each valence beside the published one, its stencil, and
/// how good the splines are.
pub fn summary(studies: &[Study]) -> Table {
    let mut table = Table::new([
        "N",
        "lambda_l",
        "lambda_C",
        "paper",
        "difference",
        "E",
        "f2",
        "f3",
        "active",
        "excess",
        "strictness",
    ]);
    for study in studies {
        let best = study.global.optimum();
        let paper = study.featured("lambda_C").and_then(|f| f.paper);
        table.push(vec![
            study.valence.into(),
            study.lambda_l.into(),
            best.lambda.into(),
            paper.into(),
            paper.map(|paper| best.lambda - paper).into(),
            best.minimum.total.into(),
            best.minimum.f2.into(),
            best.minimum.f3.into(),
            best.minimum.active.join("+").into(),
            study.accuracy.excess.into(),
            study.accuracy.strictness.into(),
        ]);
    }
    table
}

/// What the summary says, in sentences.
pub fn in_words(studies: &[Study]) -> String {
    let samples: usize = studies.iter().map(|study| study.samples.len()).sum();
    let differences = studies.iter().filter_map(|study| {
        let paper = study.featured("lambda_C").and_then(|f| f.paper)?;
        Some((study.global.optimum().lambda - paper).abs())
    });
    let paper = match differences.reduce(f64::max) {
        Some(largest) => format!(
            " The optimal lambdas differ from the published ones by up to {}.",
            short(largest)
        ),
        None => String::new(),
    };
    let excess = studies.iter().map(|study| study.accuracy.excess).fold(0.0, f64::max);
    let (valences, list) = (studies.len(), ranges(studies.iter().map(|study| study.valence)));
    format!(
        "{samples} stencils were tuned at {valences} valence{} (N = {list}).{paper} The objective of the splines exceeds that of the samples by up to {}.",
        if valences == 1 { "" } else { "s" },
        short(excess),
    )
}

/// Ascending numbers as ranges, such as `3..8, 12`.
pub(crate) fn ranges(numbers: impl IntoIterator<Item = usize>) -> String {
    let mut found: Vec<(usize, usize)> = Vec::new();
    for number in numbers {
        match found.last_mut() {
            Some((_, last)) if *last + 1 == number => *last = number,
            _ => found.push((number, number)),
        }
    }
    let text = |&(first, last): &(usize, usize)| match last - first {
        0 => first.to_string(),
        _ => format!("{first}..{last}"),
    };
    found.iter().map(text).collect::<Vec<_>>().join(", ")
}

/// The tables by file name. Those that the paper has are numbered as there.
pub fn tables(studies: &[Study]) -> Vec<(&'static str, Table)> {
    vec![
        ("table1_featured_lambda", featured(studies)),
        ("table2_f2_at_featured", at_featured(studies, |f| f.f2)),
        ("table3_f3_at_featured", at_featured(studies, |f| f.f3)),
        (
            "table5_f2_coefficients",
            coefficients(studies, |study| &study.f2.coefficients),
        ),
        (
            "table6_f3_coefficients",
            coefficients(studies, |study| &study.f3.coefficients),
        ),
        ("knots", knots(studies)),
        ("kinks", kinks(studies)),
        ("samples", samples(studies)),
        ("optima", optima(studies)),
        ("accuracy", accuracy(studies)),
    ]
}

fn featured(studies: &[Study]) -> Table {
    let mut table = Table::new(["valence", "name", "lambda", "paper", "difference", "f2", "f3", "E"]);
    for study in studies {
        for f in &study.featured {
            table.push(vec![
                study.valence.into(),
                f.name.as_str().into(),
                f.lambda.into(),
                f.paper.into(),
                f.paper.map(|paper| f.lambda - paper).into(),
                f.f2.into(),
                f.f3.into(),
                f.total.into(),
            ]);
        }
    }
    table
}

/// The featured lambdas that are the same for all valences or have a column of their own.
pub const FEATURED: [&str; 7] = [
    "lambda_r1",
    "lambda_A",
    "lambda_l",
    "lambda_M",
    "lambda_CC",
    "lambda_C",
    "lambda_r2",
];

fn at_featured(studies: &[Study], value: impl Fn(&eigenring_tune::study::Featured) -> f64) -> Table {
    let mut table = Table::new(std::iter::once("valence").chain(FEATURED));
    for study in studies {
        let values = FEATURED.map(|name| study.featured(name).map(&value).into());
        table.push(std::iter::once(study.valence.into()).chain(values).collect());
    }
    table
}

/// The most coefficients of a valence.
fn most_coefficients(studies: &[Study]) -> usize {
    let counts = studies.iter().map(|study| study.knots.values.dimension());
    counts.max().unwrap_or(17)
}

/// Cells are empty where a valence has fewer coefficients than another one.
fn coefficients(studies: &[Study], values: impl Fn(&Study) -> &[f64]) -> Table {
    let most = most_coefficients(studies);
    let mut table = Table::new(std::iter::once("valence".to_owned()).chain((1..=most).map(|i| format!("C{i}"))));
    for study in studies {
        let values = values(study);
        let cells = (0..most).map(|i| values.get(i).copied().into());
        table.push(std::iter::once(study.valence.into()).chain(cells).collect());
    }
    table
}

fn knots(studies: &[Study]) -> Table {
    let most = most_coefficients(studies) + LambdaKnots::DEGREE + 1;
    let mut table = Table::new(std::iter::once("valence".to_owned()).chain((1..=most).map(|i| format!("xi{i}"))));
    for study in studies {
        // Eq. 21: fourfold ends, triple knots b, c, d, and the middles. A study's knots were valid when it
        // was made
        let knots = study
            .knots
            .values
            .knots()
            .map_or(Vec::new(), |knots| knots.values().to_vec());
        let cells = (0..most).map(|i| knots.get(i).copied().into());
        table.push(std::iter::once(study.valence.into()).chain(cells).collect());
    }
    table
}

fn kinks(studies: &[Study]) -> Table {
    let mut table = Table::new(["valence", "lambda", "slot", "source", "residual", "chosen", "paper"]);
    for study in studies {
        let row = eigenring_tune::study::paper_row(study.valence);
        for c in &study.knots.candidates {
            let (chosen, paper) = match c.slot.as_str() {
                "b" => (study.knots.values.b, row.map(|row| row.lambda_b)),
                _ => (study.knots.values.d, row.map(|row| row.lambda_d)),
            };
            table.push(vec![
                study.valence.into(),
                c.lambda.into(),
                c.slot.as_str().into(),
                c.source.as_str().into(),
                c.residual.into(),
                usize::from(c.lambda == chosen).into(),
                paper.into(),
            ]);
        }
    }
    table
}

fn samples(studies: &[Study]) -> Table {
    let mut table = Table::new([
        "valence",
        "lambda",
        "s",
        "f2",
        "f3",
        "E",
        "E_cup",
        "E_saddle_re",
        "E_saddle_im",
        "theta",
        "active",
        "minima",
        "kkt_residual",
        "lowest_E",
        "lowest_f2",
        "lowest_f3",
    ]);
    for study in studies {
        for sample in &study.samples {
            let m = &sample.minimum;
            let lowest = sample.lowest;
            table.push(vec![
                study.valence.into(),
                sample.lambda.into(),
                sample.s.into(),
                m.f2.into(),
                m.f3.into(),
                m.total.into(),
                m.parts[0].into(),
                m.parts[1].into(),
                m.parts[2].into(),
                m.theta.into(),
                m.active.join("+").into(),
                sample.minima.into(),
                m.kkt_residual.into(),
                lowest.map(|l| l.total).into(),
                lowest.map(|l| l.f2).into(),
                lowest.map(|l| l.f3).into(),
            ]);
        }
    }
    table
}

fn optima(studies: &[Study]) -> Table {
    let mut table = Table::new(["valence", "lambda", "s", "f2", "f3", "E", "active", "kind", "global"]);
    for study in studies {
        for (index, found) in study.global.minima.iter().enumerate() {
            table.push(vec![
                study.valence.into(),
                found.lambda.into(),
                found.s.into(),
                found.minimum.f2.into(),
                found.minimum.f3.into(),
                found.minimum.total.into(),
                found.minimum.active.join("+").into(),
                format!("{:?}", found.kind).to_lowercase().into(),
                usize::from(index == 0).into(),
            ]);
        }
    }
    table
}

fn accuracy(studies: &[Study]) -> Table {
    let mut table = Table::new([
        "valence",
        "f2",
        "f3",
        "excess",
        "excess_at",
        "excess_overall",
        "strictness",
        "slack",
        "slack_at",
        "f2_kkt",
        "f3_kkt",
        "f2_active_bounds",
        "f3_active_bounds",
    ]);
    for study in studies {
        let a = &study.accuracy;
        table.push(vec![
            study.valence.into(),
            a.f2.into(),
            a.f3.into(),
            a.excess.into(),
            a.excess_at.into(),
            a.excess_overall.into(),
            a.strictness.into(),
            a.slack.into(),
            a.slack_at.into(),
            study.f2.kkt.into(),
            study.f3.kkt.into(),
            study.f2.active_bounds.into(),
            study.f3.active_bounds.into(),
        ]);
    }
    table
}
