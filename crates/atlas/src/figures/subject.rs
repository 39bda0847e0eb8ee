//! What the panels of a map show: a scheme at a valence, with the words above it.

use super::Inputs;
use crate::error::Error;
use crate::progress::Progress;
use crate::schemes::{SchemeName, Tuner, distinct};
use crate::table::{Cell, Table};
use eigenring_scheme::lambda::Splines;
use eigenring_scheme::{Scheme, Spec};
use eigenring_spectral::Sufficient;
use eigenring_tune::study::{LAMBDA_A, LAMBDA_M};

/// A scheme around a centre.
#[derive(Clone, Debug)]
pub struct Subject {
    /// What it is called, with markup, without the valence.
    pub title: String,
    /// What it is called in tables.
    pub name: String,
    /// The valence.
    pub valence: usize,
    /// The scheme.
    pub scheme: Scheme<f64>,
    /// What is to be said of its maps, if the subdominant eigenvalue is not that of block 1, whose vectors
    /// they are made of.
    remark: Option<String>,
}

/// What is to be said of the maps of a scheme.
fn remark(scheme: &Scheme<f64>) -> Result<Option<String>, Error> {
    let Sufficient { system, .. } = Sufficient::new(scheme.limit(), scheme.closed_rings()?)?;
    let spectrum = system.eigenvalues()?;
    let stray = spectrum.subdominant().zip(spectrum.stray());
    Ok(stray.map(|(lambda, index)| {
        format!(
            "the subdominant eigenvalue {} is of Fourier index {index}, not 1: what is drawn belongs to the largest of index 1",
            crate::table::short(lambda.modulus())
        )
    }))
}

/// Says of each subject what is to be said of its maps, and adds it to a table whose first columns are scheme
/// and valence. Most have no remark, and no table a column of them then.
pub fn tell<'a>(subjects: impl Iterator<Item = &'a Subject> + Clone, table: &mut Table, progress: &dyn Progress) {
    let told = subjects.filter_map(|subject| Some((subject, subject.remark.as_deref()?)));
    let told: Vec<(&Subject, &str)> = told.collect();
    for (Subject { name, valence, .. }, remark) in &told {
        progress.note(&format!("{name} at N = {valence}: {remark}"));
    }
    if told.is_empty() {
        return;
    }
    table.extend_by("remark", |row| {
        let of = |subject: &Subject| row[0] == subject.name.as_str().into() && row[1] == subject.valence.into();
        let found = told.iter().find(|(subject, _)| of(subject));
        found.map_or(Cell::Empty, |(_, remark)| (*remark).into())
    });
}

impl Subject {
    fn new(argument: &SchemeName, valence: usize, tuner: &Tuner<'_>) -> Result<Self, Error> {
        let scheme = argument.scheme(valence, tuner)?;
        let title = match argument {
            SchemeName::Spec(Spec::CatmullClark) => "Catmull-Clark".to_owned(),
            SchemeName::Spec(Spec::DooSabin) => "Doo-Sabin".to_owned(),
            SchemeName::Spec(Spec::DooSabinUniform) => "Doo-Sabin, uniform".to_owned(),
            SchemeName::Spec(Spec::Stam { order }) => format!("Stam, order {order}"),
            SchemeName::Spec(Spec::Morin { u0 }) => format!("Morin et al., $u_0$ = {u0}"),
            SchemeName::Spec(Spec::Tension { order, u0 }) if *u0 == 1.0 => format!("tension, order {order}"),
            SchemeName::Spec(Spec::Tension { order, u0 }) => format!("tension, order {order}, $u_0$ = {u0}"),
            SchemeName::Spec(Spec::LambdaOptimal | Spec::Lambda { .. }) => {
                let lambda = argument
                    .member(valence, tuner)?
                    .map_or(f64::NAN, |member| member.plane.lambda);
                let symbol = match argument {
                    SchemeName::Spec(Spec::LambdaOptimal) => "$λ_C^*$",
                    _ => "$λ$",
                };
                format!("{symbol} = {}", four(lambda))
            }
            SchemeName::File(_) | SchemeName::NonUniform(_) => short(scheme.name()),
        };
        Ok(Subject {
            title,
            name: scheme.name().to_owned(),
            valence,
            remark: remark(&scheme)?,
            scheme,
        })
    }

    /// The title with the valence.
    pub fn full_title(&self) -> String {
        format!("$N$ = {}, {}", self.valence, self.title)
    }
}

/// A file's name as far as it fits above a panel, without what would be markup.
fn short(name: &str) -> String {
    let plain: Vec<char> = name.chars().filter(|&c| c != '$').collect();
    match plain.len() {
        ..=FILE => plain.into_iter().collect(),
        _ => plain[..FILE - 1].iter().chain(&['…']).collect(),
    }
}

/// The end of a path as far as it fits above a panel, without what would be markup.
fn end(path: &str) -> String {
    let plain: Vec<char> = path.chars().filter(|&c| c != '$').collect();
    match plain.len() {
        ..=FILE => plain.into_iter().collect(),
        long => ['…'].iter().chain(&plain[long - FILE + 1..]).collect(),
    }
}

/// Characters of a file's name in a title.
const FILE: usize = 22;

/// Four decimals, without trailing zeros.
fn four(number: f64) -> String {
    let text = format!("{number:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The chosen schemes at one valence.
pub fn chosen(inputs: &Inputs<'_>, valence: usize) -> Result<Vec<Subject>, Error> {
    let schemes = inputs.schemes.iter();
    let mut subjects: Vec<Subject> = schemes
        .map(|argument| Subject::new(argument, valence, inputs.tuner))
        .collect::<Result<_, Error>>()?;
    let names: Vec<&str> = subjects.iter().map(|subject| subject.name.as_str()).collect();
    let called = distinct(inputs.schemes, &names);
    for ((subject, called), argument) in subjects.iter_mut().zip(called).zip(inputs.schemes) {
        if let SchemeName::File(file) = argument
            && called != subject.name
        {
            subject.title = end(&file.path.display().to_string());
            subject.name = called;
        }
    }
    Ok(subjects)
}

/// The lambda-scheme at five featured lambdas, ascending: 0.35, lambda_A*, lambda_M*, lambda_C* and half way
/// from there to lambda_r2 (Ma, Wang and Ma 2023, Fig. 10); four where no lambda_r2 is known.
pub fn featured(inputs: &Inputs<'_>, valence: usize) -> Result<Vec<Subject>, Error> {
    let tuner = inputs.tuner;
    let optimal = tuner.optimal(valence)?.plane.lambda;
    let mut shown = vec![
        ("$λ$", 0.35),
        ("$λ_A^*$", LAMBDA_A),
        ("$λ_M^*$", LAMBDA_M),
        ("$λ_C^*$", optimal),
    ];
    if let Some(entry) = inputs.studies.entry(valence)? {
        shown.push(("$λ_C^* + Δλ$", optimal + 0.5 * (entry.lambda_r2 - optimal)));
    }
    shown.sort_by(|a, b| a.1.total_cmp(&b.1));
    let subject = |(symbol, lambda)| {
        let spec = Spec::Lambda {
            lambda,
            s: None,
            weights: None,
            splines: Splines::Paper,
        };
        let scheme = SchemeName::Spec(spec).scheme(valence, tuner)?;
        Ok(Subject {
            title: format!("{symbol} = {}", four(lambda)),
            name: scheme.name().to_owned(),
            valence,
            remark: None,
            scheme,
        })
    };
    shown.into_iter().map(subject).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles() {
        for (spec, title) in [
            ("doo-sabin", "$N$ = 5, Doo-Sabin"),
            ("tension:order=8", "$N$ = 5, tension, order 8"),
            ("tension:order=6,u0=2", "$N$ = 5, tension, order 6, $u_0$ = 2"),
            ("lambda:lambda=0.35", "$N$ = 5, $λ$ = 0.35"),
            ("lambda:lambda=0.55,f2=0.25,f3=0.2", "$N$ = 5, $λ$ = 0.55"),
            ("lambda:optimal", "$N$ = 5, $λ_C^*$ = 0.5597"),
        ] {
            let subject = Subject::new(&spec.parse().unwrap(), 5, &Tuner::default()).unwrap();
            assert_eq!(subject.full_title(), title);
        }
        assert_eq!(short("my_$cheme"), "my_cheme");
        assert_eq!(end("folder$/mine.toml"), "folder/mine.toml");
        assert_eq!(
            end(&format!("{}/mine.toml", "x".repeat(30))),
            format!("…{}/mine.toml", "x".repeat(11))
        );
        assert_eq!(short(&"x".repeat(99)), "x".repeat(21) + "…");
    }
}
