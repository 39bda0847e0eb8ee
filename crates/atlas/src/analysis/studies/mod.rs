//! Studies of convergence as pictures with their numbers.
//!
//! Each is a set of runs over meshes, schemes and levels. Curves are errors against `h = 2^-level`; the
//! dashed lines below them have the slopes that the subdominant eigenvalues predict, and never look at the
//! errors.

mod chart;
mod eigenvalues;
mod fixed;
mod intervals;
mod pictures;

use super::{Basis, ends_name};
use crate::error::Error;
use crate::figures::Drawing;
use crate::schemes::{SchemeName, Tuner};
use crate::table::{Cell, Table};
use chart::{chart, figure, spelled};
use eigenring_figure::{Axis, Chart, Colour, Marker, Style};
use eigenring_iga::{Domain, Ends, Norms, Options, Problem, Study, solution};
use eigenring_nonuniform::Outside;
use eigenring_surface::{Mesh, shapes};
use eigenvalues::spectra;
use fixed::against_lambda;
use intervals::{nurss, polyhedra};
use pictures::{functions, solutions};

/// A registered study.
#[derive(Debug)]
pub struct StudyEntry {
    /// What it is called on the command line.
    pub name: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// Levels by default.
    pub levels: usize,
    /// Its parts, which are run on so many levels: each is complete by itself, so that it can be kept when
    /// the next is interrupted.
    pub parts: &'static [Part],
}

/// A part of a study, from the number of levels.
pub type Part = fn(usize, &Tuner<'_>) -> Result<Vec<Drawing>, Error>;

/// All studies.
pub const STUDIES: &[StudyEntry] = &[
    StudyEntry {
        name: "convergence",
        title: "errors of Poisson's equation on fans and on a square, two solutions (Li, Wei and Zhang 2019, Figs. 15 to 18, on meshes of our own)",
        levels: 6,
        parts: &[
            |levels, tuner| convergence(levels, "exp", tuner),
            |levels, tuner| convergence(levels, "sin", tuner),
        ],
    },
    StudyEntry {
        name: "annuli",
        title: "the patch test against the number of annuli, dropped and scaled tail",
        levels: 3,
        parts: &[annuli],
    },
    StudyEntry {
        name: "boundary",
        title: "open and natural boundary",
        levels: 6,
        parts: &[boundary],
    },
    StudyEntry {
        name: "plates",
        title: "clamped plates",
        levels: 6,
        parts: &[plates],
    },
    StudyEntry {
        name: "spectra",
        title: "eigenvalues of the equilateral triangle and of the sphere against their closed forms",
        levels: 5,
        parts: &[spectra],
    },
    StudyEntry {
        name: "lambda",
        title: "errors against lambda at fixed levels, tuned stencils, N = 3 to 12",
        levels: 5,
        parts: &[against_lambda],
    },
    StudyEntry {
        name: "intervals",
        title: "NURSS and eigen-polyhedra at unequal knot intervals, beside HNUSS and Catmull-Clark",
        levels: 4,
        parts: &[nurss, polyhedra],
    },
    StudyEntry {
        name: "pictures",
        title: "a solution, its error beside an extraordinary vertex with the elements, and basis functions of that vertex",
        levels: 3,
        parts: &[solutions, functions],
    },
];

/// The study with a name.
///
/// # Errors
/// [`Error::Usage`] for an unknown one.
pub fn find(name: &str) -> Result<&'static StudyEntry, Error> {
    STUDIES.iter().find(|entry| entry.name == name).ok_or_else(|| {
        let names: Vec<&str> = STUDIES.iter().map(|entry| entry.name).collect();
        Error::Usage {
            message: format!("there is no study {name:?}"),
            accepted: names.join(", "),
        }
    })
}

/// Schemes with what they are called in pictures.
const SCHEMES: [(&str, &str); 5] = [
    ("catmull-clark", "Catmull-Clark"),
    ("lambda:lambda=0.5", "$λ$ = 0.5"),
    ("lambda:lambda=0.39", "$λ$ = 0.39"),
    ("lambda:lambda=0.3535533905932738", "$λ = 2^{-3/2}$"),
    ("lambda:optimal", "$λ_C^*$"),
];

/// The norms: name, place among predicted rates.
const NORMS: [(&str, usize); 4] = [("L2", 0), ("H1", 1), ("Linf", 2), ("H2", 3)];

fn norm(of: &Norms, name: &str) -> f64 {
    match name {
        "L2" => of.l2,
        "H1" => of.h1,
        "Linf" => of.linf,
        _ => of.h2,
    }
}

/// The errors of one scheme on the levels of a mesh, and what is predicted.
struct Run {
    label: String,
    place: usize,
    dof: Vec<usize>,
    errors: Vec<Norms>,
    predicted: [Option<f64>; 4],
}

/// One setting of a study: what is solved, where.
struct Setting<'a> {
    mesh_name: &'a str,
    mesh: &'a Mesh,
    problem: Problem,
    solution: &'static str,
    options: Options,
    levels: usize,
}

/// Runs `work` on a study of a mesh.
fn with<T>(
    mesh: &Mesh,
    spec: &str,
    domain: Domain,
    tuner: &Tuner<'_>,
    work: impl FnOnce(&Study<'_>) -> Result<T, eigenring_iga::Error>,
) -> Result<T, Error> {
    let scheme: SchemeName = spec.parse()?;
    let basis = Basis::new(&scheme.into(), mesh, Outside::Error, tuner)?;
    Ok(work(&basis.study(mesh, domain)?)?)
}

impl Setting<'_> {
    fn run(&self, spec: &str, label: &str, place: usize, tuner: &Tuner<'_>) -> Result<Run, Error> {
        let u = solution::named(self.solution).expect("a name of the library");
        with(self.mesh, spec, Domain::Planar, tuner, |study| {
            let (mut dof, mut errors) = (Vec::new(), Vec::new());
            for level in 0..self.levels {
                let outcome = study.level(level, self.problem, &u, &self.options)?;
                dof.push(outcome.dof);
                errors.push(outcome.error);
            }
            Ok(Run {
                label: label.to_owned(),
                place,
                dof,
                errors,
                predicted: study.predicted(self.problem, self.options.ends),
            })
        })
    }

    fn push(&self, table: &mut Table, scheme: &str, run: &Run) {
        for (level, (dof, error)) in run.dof.iter().zip(&run.errors).enumerate() {
            let mut row: Vec<Cell> = vec![
                self.mesh_name.into(),
                scheme.into(),
                self.solution.into(),
                ends_name(self.options.ends).into(),
                level.into(),
                (*dof).into(),
            ];
            row.extend(NORMS.map(|(name, _)| norm(error, name).into()));
            let before = level.checked_sub(1).map(|before| &run.errors[before]);
            row.extend(NORMS.map(|(name, _)| before.map(|b| (norm(b, name) / norm(error, name)).log2()).into()));
            row.extend(NORMS.map(|(_, place)| run.predicted[place].into()));
            table.push(row);
        }
    }
}

/// The columns of [`Setting::push`].
fn errors_table() -> Table {
    let columns = ["mesh", "scheme", "solution", "boundary", "level", "dof"].map(str::to_owned);
    let of = |kind: &'static str| NORMS.map(|(name, _)| format!("{kind}{name}"));
    Table::new(
        columns
            .into_iter()
            .chain(of(""))
            .chain(of("rate "))
            .chain(of("predicted ")),
    )
}

/// HNUSS beside the others, of which it has the place after the last.
const HNUSS: (&str, &str) = ("hnuss", "HNUSS");

fn convergence(levels: usize, solution: &'static str, tuner: &Tuner<'_>) -> Result<Vec<Drawing>, Error> {
    let fans = [3, 5, 6, 7, 8].map(|n| (format!("fan{n}"), format!("$N$ = {n}"), shapes::fan(n)));
    let square = (
        "square3355".to_owned(),
        "square, $N$ = 3, 5".to_owned(),
        shapes::square3355(),
    );
    let schemes: Vec<(usize, (&str, &str))> = SCHEMES.into_iter().chain([HNUSS]).enumerate().collect();
    let mut table = errors_table();
    let mut panels: Vec<(String, Vec<Run>)> = Vec::new();
    for (mesh_name, title, mesh) in fans.into_iter().chain([square]) {
        let setting = Setting {
            mesh_name: &mesh_name,
            mesh: &mesh,
            problem: Problem::Poisson,
            solution,
            options: Options::default(),
            levels,
        };
        let mut runs = Vec::new();
        for &(place, (spec, label)) in &schemes {
            let run = setting.run(spec, label, place, tuner)?;
            setting.push(&mut table, spec, &run);
            runs.push(run);
        }
        panels.push((title, runs));
    }
    let drawing = |(name, suffix, data): (&str, &str, Vec<(&'static str, Table)>)| {
        let charts = panels.iter().map(|(title, runs)| (title.clone(), chart(runs, name)));
        Drawing {
            stem: format!("convergence-{solution}{suffix}"),
            figure: figure(&format!("Errors of {solution} in {name}"), charts.collect()),
            data,
        }
    };
    let all = [("L2", "", vec![("", table)]), ("H1", "-h1", Vec::new())];
    Ok(all.map(drawing).into())
}

fn annuli(levels: usize, tuner: &Tuner<'_>) -> Result<Vec<Drawing>, Error> {
    let level = levels - 1;
    let mut table = Table::new(["scheme", "tail", "depth", "L2", "H1", "H2"]);
    let mut panels = Vec::new();
    let u = solution::named("lin").expect("a name of the library");
    for (title, scaled) in [("tail dropped", false), ("tail scaled", true)] {
        let mut chart = Chart::new(
            Axis::new("annuli", (0.0, 42.0)).with_integers((0..=40).step_by(10)),
            Axis::log("error in $H^1$", (1e-16, 1.0)).with_grid(),
        );
        for (place, (spec, label)) in SCHEMES.into_iter().enumerate() {
            let mut points = Vec::new();
            for depth in (2..=40).step_by(2) {
                let options = Options {
                    depth: Some(depth),
                    scaled,
                    ..Options::default()
                };
                let error = with(&shapes::fan(6), spec, Domain::Planar, tuner, |study| {
                    Ok(study.level(level, Problem::Poisson, &u, &options)?.error)
                })?;
                let tail = if scaled { "scaled" } else { "drop" };
                table.push(vec![
                    spec.into(),
                    tail.into(),
                    depth.into(),
                    error.l2.into(),
                    error.h1.into(),
                    error.h2.into(),
                ]);
                points.push([depth as f64, error.h1]);
            }
            let style = Style::solid(Colour::line(place)).marked(Marker::line(place));
            chart = chart.series(points, style).label(label);
        }
        panels.push((title.to_owned(), chart));
    }
    Ok(vec![Drawing {
        stem: "annuli".to_owned(),
        figure: figure("The patch test against the number of annuli", panels),
        data: vec![("", table)],
    }])
}

fn boundary(levels: usize, tuner: &Tuner<'_>) -> Result<Vec<Drawing>, Error> {
    let mut table = errors_table();
    let mut runs = Vec::new();
    let mesh = shapes::fan(6);
    for (place, (ends, solution, label)) in [
        (Ends::Open, "exp", "open, exp"),
        (Ends::Natural, "exp", "natural, exp"),
        (Ends::Open, "sin", "open, sin"),
        (Ends::Natural, "sin", "natural, sin"),
    ]
    .into_iter()
    .enumerate()
    {
        let setting = Setting {
            mesh_name: "fan6",
            mesh: &mesh,
            problem: Problem::Poisson,
            solution,
            options: Options {
                ends,
                ..Options::default()
            },
            levels,
        };
        let run = setting.run("lambda:lambda=0.39", label, place, tuner)?;
        setting.push(&mut table, "lambda:lambda=0.39", &run);
        runs.push(run);
    }
    let charts = ["L2", "H1", "H2"].map(|name| (spelled(name).to_owned(), chart(&runs, name)));
    Ok(vec![Drawing {
        stem: "boundary".to_owned(),
        figure: figure("Open and natural boundary", charts.into()),
        data: vec![("", table)],
    }])
}

fn plates(levels: usize, tuner: &Tuner<'_>) -> Result<Vec<Drawing>, Error> {
    let mut table = errors_table();
    let mut runs = Vec::new();
    let mesh = shapes::fan(6);
    let setting = Setting {
        mesh_name: "fan6",
        mesh: &mesh,
        problem: Problem::Biharmonic,
        solution: "exp",
        options: Options::default(),
        levels,
    };
    for (place, (spec, label)) in SCHEMES.into_iter().enumerate() {
        let run = setting.run(spec, label, place, tuner)?;
        setting.push(&mut table, spec, &run);
        runs.push(run);
    }
    let charts = ["L2", "H1", "H2"].map(|name| (spelled(name).to_owned(), chart(&runs, name)));
    Ok(vec![Drawing {
        stem: "plates".to_owned(),
        figure: figure("Clamped plates", charts.into()),
        data: vec![("", table)],
    }])
}
