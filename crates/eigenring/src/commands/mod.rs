//! The subcommands, one module each.

mod blending;
mod compare;
mod completions;
mod curvature;
mod curve;
mod eigenvectors;
mod glossary;
mod iga;
mod limit;
mod make;
mod matrix;
mod mesh;
mod new_scheme;
mod objective;
mod plot;
mod render;
mod report;
mod reproduce;
mod spectrum;
mod stencil;
mod subdivide;
mod tables;
mod tune;
mod verify;

use crate::error::Error;
use crate::progress::watch;
use clap::{Parser, Subcommand};
use eigenring_atlas::glossary as words;
use std::process::ExitCode;

/// Where files go that are no part of the stored results, by default.
const UNSTORED: &str = "eigenring-out";

/// Where the stored results are.
const RESULTS: &str = "results";

/// Examples, and what the words mean that a command prints, for its long help.
fn with_words(examples: &str, command: &str) -> String {
    format!("{examples}\n\nWords: {}", words::plain(Some(command)))
}

/// Design, analyse and tabulate subdivision schemes around extraordinary vertices.
#[derive(Parser, Debug)]
#[command(
    name = "eigenring",
    version,
    after_help = "Examples:\n  eigenring tables                                   regenerate results/lambda from nothing\n  eigenring stencil -N 6 --lambda 0.55               the stencils of one valence and lambda\n  eigenring spectrum --scheme catmull-clark -N 5     eigenvalues and limit stencils\n  eigenring compare --schemes catmull-clark,lambda:optimal --valences 3..12\n  eigenring verify --scheme catmull-clark -N 5       prove that it is C1\n  eigenring curve --example circle                   control points that give an exact circle\n  eigenring plot --all                               every figure, with its data\n\nSchemes: catmull-clark | doo-sabin[:uniform] | lambda:optimal | lambda:lambda=L[,f2=X,f3=Y][,s=S] |\n         lambda:fine,lambda=L | tension:order=K[,u0=U] | stam:order=K | morin:u0=U |\n         file:SCHEME.toml[,a=X,..]\n         with knot intervals: nurss | eigen-polyhedron | hnuss[:simple|printed]\nExit codes: 0 done, 1 refuted or different, 2 bad input."
)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand, Debug)]
enum Command {
    Tables(tables::Arguments),
    Stencil(stencil::Arguments),
    Objective(objective::Arguments),
    Tune(tune::Arguments),
    Verify(verify::Arguments),
    Spectrum(spectrum::Arguments),
    Eigenvectors(eigenvectors::Arguments),
    Blending(blending::Arguments),
    Glossary(glossary::Arguments),
    Matrix(matrix::Arguments),
    Compare(compare::Arguments),
    Curve(curve::Arguments),
    Mesh(mesh::Arguments),
    Subdivide(subdivide::Arguments),
    Iga(iga::Arguments),
    Limit(limit::Arguments),
    Make(make::Arguments),
    Curvature(curvature::Arguments),
    Render(render::Arguments),
    Plot(plot::Arguments),
    Report(report::Arguments),
    Reproduce(reproduce::Arguments),
    NewScheme(new_scheme::Arguments),
    Completions(completions::Arguments),
}

impl Cli {
    /// Runs the chosen command.
    pub fn run(self) -> Result<ExitCode, Error> {
        let _watch = watch();
        match self.command {
            Command::Tables(arguments) => arguments.run(),
            Command::Stencil(arguments) => arguments.run(),
            Command::Objective(arguments) => arguments.run(),
            Command::Tune(arguments) => arguments.run(),
            Command::Verify(arguments) => arguments.run(),
            Command::Spectrum(arguments) => arguments.run(),
            Command::Eigenvectors(arguments) => arguments.run(),
            Command::Blending(arguments) => arguments.run(),
            Command::Glossary(arguments) => arguments.run(),
            Command::Matrix(arguments) => arguments.run(),
            Command::Compare(arguments) => arguments.run(),
            Command::Curve(arguments) => arguments.run(),
            Command::Mesh(arguments) => arguments.run(),
            Command::Subdivide(arguments) => arguments.run(),
            Command::Iga(arguments) => arguments.run(),
            Command::Limit(arguments) => arguments.run(),
            Command::Make(arguments) => arguments.run(),
            Command::Curvature(arguments) => arguments.run(),
            Command::Render(arguments) => arguments.run(),
            Command::Plot(arguments) => arguments.run(),
            Command::Report(arguments) => arguments.run(),
            Command::Reproduce(arguments) => arguments.run(),
            Command::NewScheme(arguments) => arguments.run(),
            Command::Completions(arguments) => arguments.run(),
        }
    }
}
