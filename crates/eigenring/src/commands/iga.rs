//! `eigenring iga`: Galerkin solutions on subdivision spaces.

use super::UNSTORED;
use super::plot::{DPI, PictureFormat};
use super::subdivide::IntervalArgs;
use crate::args::{self, OneScheme};
use crate::error::Error;
use crate::files::{self, Written};
use crate::memory;
use crate::output::Output;
use crate::progress::{Terminal, note};
use crate::threads::Threads;
use crate::valences::OptionalValences;
use clap::{Args, Subcommand, ValueEnum};
use eigenring_atlas::analysis::studies::{StudyEntry, find};
use eigenring_atlas::analysis::{Basis, Membranes, Request, Task as Kind, rates, spectra, study};
use eigenring_atlas::meshes;
use eigenring_atlas::schemes::SchemeName;
use eigenring_atlas::table::{Format, pretty};
use eigenring_iga::{Dirichlet, Domain, Ends, Membrane, Options, Solver};
use eigenring_surface::Mesh;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Solve on the basis functions of a subdivision scheme, and measure the errors.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring make fan -N 6 -o fan6.obj\n  eigenring iga poisson fan6.obj --scheme lambda:lambda=0.39 --solution exp --levels 4\n  eigenring iga patch-test fan6.obj --scheme catmull-clark --tail scaled\n  eigenring iga spectrum cube.obj --scheme catmull-clark --bc closed --sphere --count 9\n  eigenring iga patch-test fan6.obj --scheme hnuss --depth 24\n  eigenring iga poisson fan6.obj --scheme nurss --levels 3\n  eigenring iga rates --scheme catmull-clark -N 3..12"
)]
pub struct Arguments {
    #[command(subcommand)]
    problem: Task,
}

#[derive(Subcommand, Debug)]
enum Task {
    /// Poisson's equation with a manufactured solution
    Poisson(Solve),
    /// The projection in the mean square
    L2(Solve),
    /// A clamped plate with a manufactured solution
    Biharmonic(Solve),
    /// Poisson's equation with a linear solution, which must be met: exit 1 if it is not
    PatchTest(Solve),
    /// The lowest eigenvalues of the Laplacian: of membranes in the plane, of closed surfaces
    Spectrum(Eigenvalues),
    /// The rates that the subdominant eigenvalue predicts, by valence
    Rates(Rates),
    /// Studies over meshes, schemes and levels, as pictures with their numbers
    Study(Studies),
}

/// Which studies are run.
#[derive(Args, Debug)]
struct Studies {
    /// convergence, annuli, boundary, plates, spectra, lambda, intervals, pictures
    #[arg(value_name = "NAME", required = true)]
    names: Vec<String>,
    /// The number of levels, by default each study's own
    #[arg(long)]
    levels: Option<usize>,
    /// The folder of the pictures and tables, by default eigenring-out/analysis
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    #[command(flatten)]
    threads: Threads,
}

/// Which rates are asked for.
#[derive(Args, Debug)]
struct Rates {
    #[command(flatten)]
    scheme: OneScheme,
    #[command(flatten)]
    valences: OptionalValences,
    #[command(flatten)]
    output: Output,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Beyond {
    Open,
    Natural,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Tail {
    Drop,
    Scaled,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Data {
    Projection,
    Nitsche,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Method {
    Cholesky,
    Multigrid,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Condition {
    Dirichlet,
    Neumann,
    Closed,
}

/// A mesh, a scheme and how integrals are taken.
#[derive(Args, Debug)]
struct Setting {
    /// The control mesh: .obj, .off or .ply; planar with z = 0, or closed
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    scheme: OneScheme,
    #[command(flatten)]
    intervals: IntervalArgs,
    /// The number of levels, 1 to 10
    #[arg(long, default_value = "4")]
    levels: usize,
    /// The solution beyond the boundary
    #[arg(long, value_enum, default_value = "open")]
    boundary: Beyond,
    /// With --bc closed: fit the unit sphere about the origin on every level
    #[arg(long)]
    sphere: bool,
    /// Gauss points of an element in each direction, 2 to 10
    #[arg(long, default_value = "4")]
    gauss: usize,
    /// Annuli at extraordinary vertices: auto or 1 to 200
    #[arg(long, value_name = "auto|M", default_value = "auto")]
    depth: String,
    /// What the annuli beyond the depth count
    #[arg(long, value_enum, default_value = "drop")]
    tail: Tail,
    /// Run although the levels may not fit into memory
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    output: Output,
}

#[derive(Args, Debug)]
struct Solve {
    #[command(flatten)]
    setting: Setting,
    /// sin, exp, mix, lin or quadratic, of x and y
    #[arg(long, value_name = "NAME", default_value = "exp")]
    solution: String,
    /// Of poisson: what is given on the boundary. A closed surface has none, and u is added to the equation
    #[arg(long, value_enum)]
    bc: Option<Condition>,
    /// How values on the boundary are enforced
    #[arg(long, value_enum)]
    dirichlet: Option<Data>,
    /// By default cholesky up to 200000 unknowns
    #[arg(long, value_enum)]
    solver: Option<Method>,
}

#[derive(Args, Debug)]
struct Eigenvalues {
    #[command(flatten)]
    setting: Setting,
    /// The boundary of the membrane, or none
    #[arg(long, value_enum, default_value = "neumann")]
    bc: Condition,
    /// How many eigenvalues, 1 to 200
    #[arg(long, default_value = "20")]
    count: usize,
}

impl Setting {
    fn options(&self) -> Result<Options, Error> {
        let depth = match self.depth.as_str() {
            "auto" => None,
            text => {
                let depth = text.parse();
                Some(depth.map_err(|_| Error::range("depth", text, "auto and 1 to 200"))?)
            }
        };
        Ok(Options {
            ends: match self.boundary {
                Beyond::Open => Ends::Open,
                Beyond::Natural => Ends::Natural,
            },
            gauss: self.gauss,
            depth,
            scaled: self.tail == Tail::Scaled,
            ..Options::default()
        })
    }

    fn domain(&self, bc: Condition) -> Result<Domain, Error> {
        match (bc, self.sphere) {
            (Condition::Closed, true) => Ok(Domain::Sphere),
            (Condition::Closed, false) => Ok(Domain::Closed),
            (_, true) => Err(Error::usage("--sphere is for --bc closed", "--bc closed --sphere")),
            (_, false) => Ok(Domain::Planar),
        }
    }

    /// The mesh with what makes its spaces.
    fn surface(&self) -> Result<(Mesh, Basis), Error> {
        let scheme = self.scheme.clone().name()?;
        let mesh = if matches!(scheme, SchemeName::NonUniform(_)) {
            let (mut mesh, notices) = meshes::read_with_intervals(&self.file)?;
            notices.iter().for_each(|notice| note(notice));
            self.intervals.read(&mut mesh)?;
            mesh
        } else {
            self.intervals.refuse()?;
            let (mesh, notices) = meshes::read_surface(&self.file)?;
            notices.iter().for_each(|notice| note(notice));
            mesh
        };
        let basis = Basis::new(&scheme.into(), &mesh, self.intervals.outside(), &args::tuner())?;
        Ok((mesh, basis))
    }

    fn fits(&self, bytes: f64) -> Result<(), Error> {
        memory::check(bytes, self.force, &format!("{} levels", self.levels))
    }
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        match self.problem {
            Task::Poisson(solve) => {
                let kind = match solve.bc {
                    None | Some(Condition::Dirichlet) => Kind::Poisson,
                    Some(Condition::Neumann) => Kind::Neumann,
                    Some(Condition::Closed) => Kind::LaplaceBeltrami,
                };
                solve.run(kind)
            }
            Task::Biharmonic(solve) => solve.run(Kind::Biharmonic),
            Task::Spectrum(eigenvalues) => eigenvalues.run(),
            Task::L2(solve) => solve.run(Kind::L2),
            Task::PatchTest(solve) => solve.run(Kind::PatchTest),
            Task::Rates(rates) => rates.run(),
            Task::Study(studies) => studies.run(),
        }
    }
}

/// Valences by default.
const USUAL: std::ops::RangeInclusive<usize> = 3..=12;

impl Rates {
    fn run(self) -> Result<ExitCode, Error> {
        let format = self.output.format()?;
        let scheme = self.scheme.name()?;
        let valences = match (&self.valences.valences, scheme.only_valence()?) {
            (Some(valences), _) => valences.closed()?.to_vec(),
            (None, Some(only)) => vec![only],
            (None, None) => USUAL.collect(),
        };
        self.output
            .emit(&rates(&scheme, &valences, &args::tuner())?.render(format))?;
        Ok(ExitCode::SUCCESS)
    }
}

impl Solve {
    fn run(self, task: Kind) -> Result<ExitCode, Error> {
        let setting = &self.setting;
        setting.threads.start()?;
        let format = setting.output.format()?;
        let bc = self.bc.unwrap_or(Condition::Dirichlet);
        let without = matches!(task, Kind::L2 | Kind::Biharmonic | Kind::PatchTest);
        if without && bc != Condition::Dirichlet && task != Kind::L2 || task == Kind::L2 && bc == Condition::Neumann {
            return Err(Error::usage(
                "this problem has no choice of --bc",
                "--bc with poisson and spectrum, --bc closed with l2",
            ));
        }
        if self.dirichlet.is_some() && !matches!(task, Kind::Poisson | Kind::PatchTest) {
            return Err(Error::usage(
                "--dirichlet has no effect here",
                "--dirichlet with poisson and patch-test",
            ));
        }
        let request = Request {
            task,
            solution: self.solution.clone(),
            domain: setting.domain(bc)?,
            levels: setting.levels,
            options: Options {
                dirichlet: match self.dirichlet {
                    None | Some(Data::Projection) => Dirichlet::Projection,
                    Some(Data::Nitsche) => Dirichlet::Nitsche,
                },
                solver: self.solver.map(|method| match method {
                    Method::Cholesky => Solver::Cholesky,
                    Method::Multigrid => Solver::Multigrid,
                }),
                ..setting.options()?
            },
        };
        let (mesh, basis) = setting.surface()?;
        let fits = |bytes: f64| setting.fits(bytes);
        let answer = study(&request, &setting.file, &mesh, &basis, fits, &Terminal)?;
        let text = match format {
            Format::Json => pretty(&answer.json()),
            format => answer.table().render(format),
        };
        setting.output.emit(&text)?;
        Ok(if answer.holds() {
            ExitCode::SUCCESS
        } else {
            ExitCode::FAILURE
        })
    }
}

impl Eigenvalues {
    fn run(self) -> Result<ExitCode, Error> {
        let setting = &self.setting;
        setting.threads.start()?;
        let format = setting.output.format()?;
        let request = Membranes {
            domain: setting.domain(self.bc)?,
            membrane: match self.bc {
                Condition::Dirichlet => Membrane::Held,
                Condition::Neumann | Condition::Closed => Membrane::Free,
            },
            count: self.count,
            levels: setting.levels,
            options: setting.options()?,
        };
        let (mesh, basis) = setting.surface()?;
        let fits = |bytes: f64| setting.fits(bytes);
        let answer = spectra(&request, &setting.file, &mesh, &basis, fits, &Terminal)?;
        let text = match format {
            Format::Json => pretty(&answer.json()),
            format => answer.table().render(format),
        };
        setting.output.emit(&text)?;
        Ok(ExitCode::SUCCESS)
    }
}

/// The most levels of a study: the last has 4096 elements for each face.
const MOST_LEVELS: usize = 7;

impl Studies {
    fn run(self) -> Result<ExitCode, Error> {
        if let Some(levels) = self.levels.filter(|levels| !(2..=MOST_LEVELS).contains(levels)) {
            return Err(Error::range("levels", levels, format!("2 to {MOST_LEVELS}")));
        }
        let entries: Vec<&StudyEntry> = self.names.iter().map(|name| find(name)).collect::<Result<_, _>>()?;
        self.threads.start()?;
        let out = self.out.unwrap_or_else(|| Path::new(UNSTORED).join("analysis"));
        files::check_writable(&out, &out)?;
        let tuner = args::tuner();
        let mut written = Written::default();
        // each part is written before the next begins
        let parts = entries
            .iter()
            .flat_map(|entry| entry.parts.iter().map(move |part| (entry, part)));
        for (entry, part) in parts {
            for drawing in part(self.levels.unwrap_or(entry.levels), &tuner)? {
                let picture = PictureFormat::Png.draw(&drawing.figure, DPI)?;
                written.write(out.join(format!("{}.png", drawing.stem)), &picture)?;
                for (suffix, table) in &drawing.data {
                    let text = table.render(Format::Csv);
                    written.write(out.join(format!("{}{suffix}.csv", drawing.stem)), text.as_bytes())?;
                }
            }
        }
        files::emit(None, written.list().as_bytes())?;
        Ok(ExitCode::SUCCESS)
    }
}
