//! A mesh whose levels carry spaces.

use crate::assembly::assemble;
use crate::geometry::Geometry;
use crate::integrals::{Form, loads, points_of};
use crate::nested::embedding;
use crate::patch::{Data, Maps, Wanted};
use crate::problem::{Options, Outcome, Problem, Solver, default_solver, run, tables};
use crate::solution::Solution;
use crate::space::{Ends, Space};
use crate::sparse::Sparse;
use crate::spectrum::{Membrane, Spectrum, spectrum};
use crate::{Error, MOST_ANNULI, hybrid, predicted};
use eigenring_nonuniform::{Outside, Place, Refinement, Scheme, VertexElements};
use eigenring_scheme::{Definition, Spec};
use eigenring_surface::{Boundary, Mesh, Refiner, Rules};
use std::collections::{BTreeMap, BTreeSet};

/// What a mesh is the control mesh of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// A part of the plane z = 0 with a boundary.
    Planar,
    /// A closed surface.
    Closed,
    /// The unit sphere about the origin: each level fits it by projecting `X/|X|` in the mean square, twice.
    Sphere,
}

/// What makes the levels.
#[derive(Debug)]
enum Levels<'a> {
    /// A scheme, and whether its rules beside extraordinary vertices differ from the regular ones.
    Uniform(&'a Rules, bool),
    /// A scheme with knot intervals: HNUSS from its hybrid net on, others from where rules around
    /// extraordinary vertices do not change.
    Intervals(Box<Refinement>),
}

/// A mesh whose levels carry spaces.
#[derive(Debug)]
pub struct Study<'a> {
    levels: Levels<'a>,
    mesh: Mesh,
    domain: Domain,
    /// Steps that separated extraordinary vertices from each other and from the boundary: of Catmull-Clark;
    /// of NURSS and of eigen-polyhedra their own, one at least.
    pub steps: usize,
    /// Whether a vertex has two different subdominant eigenvalues, so that annuli become flat.
    flattened: bool,
    /// The subdominant eigenvalues of the valences in the mesh other than 4, the largest of each.
    pub lambdas: Vec<(usize, f64)>,
}

/// How often a mesh is refined so that its extraordinary vertices are apart.
const MOST_STEPS: usize = 3;
/// Eigenvalues of one level.
const MOST_EIGENVALUES: usize = 200;
/// The difference of two eigenvalues that are not the same up to rounding.
const FLATTENED: f64 = 1e-9;
/// Projections onto the sphere.
const FITS: usize = 2;

impl<'a> Study<'a> {
    /// A mesh of quads.
    ///
    /// # Errors
    /// What is no such mesh, and a scheme that is not bicubic with one-ring rules.
    pub fn new(mesh: &Mesh, rules: &'a Rules, domain: Domain) -> Result<Self, Error> {
        let definition = rules.definition();
        if rules.degree()? != Some(3) || rules.lists_four() {
            return Err(Error::NotBicubic(definition.name()));
        }
        let tuned = !matches!(definition, Definition::Family(Spec::CatmullClark));
        for (face, corners) in mesh.faces().enumerate() {
            if corners.len() != 4 {
                return Err(Error::NotQuad {
                    face,
                    corners: corners.len(),
                });
            }
        }
        check_points(mesh, domain)?;
        let steps = Rules::new(Definition::Family(Spec::CatmullClark));
        let mut mesh = mesh.without_unused();
        for step in 0..=MOST_STEPS {
            if let Some(space) = Space::new(&mesh, rules, Ends::Open, tuned)? {
                check_domain(&space, domain)?;
                let lambdas = space.around.iter().map(|(&n, around)| (n, around.lambda)).collect();
                return Ok(Study {
                    levels: Levels::Uniform(rules, tuned),
                    mesh,
                    domain,
                    steps: step,
                    flattened: false,
                    lambdas,
                });
            }
            mesh = refined(&mesh, &steps, 1)?;
        }
        Err(Error::TooClose { steps: MOST_STEPS })
    }

    /// A mesh with knot intervals. Level 0 of HNUSS is its hybrid net; where the rule of the first level does
    /// not exist, `outside` says what is done. Level 0 of NURSS and of eigen-polyhedra is the net after one
    /// level, or more ([`Study::steps`]), until extraordinary vertices are apart and rules there stationary.
    ///
    /// # Errors
    /// Those of [`Refinement::new`]; weights, and zero intervals across a boundary.
    pub fn with_intervals(mesh: &Mesh, scheme: Scheme, outside: Outside, domain: Domain) -> Result<Self, Error> {
        check_points(mesh, domain)?;
        if mesh.weights().is_some() {
            return Err(Error::Combination {
                what: "a mesh with weights, that is a fourth coordinate",
                accepted: "points of three coordinates",
            });
        }
        let mesh = mesh.without_unused();
        let refinement = Refinement::new(&mesh, scheme, outside)?;
        let mut study = Study {
            lambdas: Vec::new(),
            levels: Levels::Intervals(Box::new(refinement.clone())),
            mesh,
            domain,
            steps: 0,
            flattened: false,
        };
        if let Some(net) = refinement.hybrid() {
            let sizes: BTreeSet<usize> = net
                .extraordinary_faces()
                .map(|face| net.net().topology().face_size(face))
                .collect();
            sizes.iter().try_for_each(|&size| crate::check_valence(size))?;
            // that of every n-gon (Li, Wei and Zhang 2019, Lemma 1)
            study.lambdas = sizes.into_iter().map(|n| (n, 0.5)).collect();
        } else {
            study.separate(refinement)?;
        }
        check_domain(&study.space(0, Ends::Open)?, domain)?;
        Ok(study)
    }

    /// Levels of NURSS or of eigen-polyhedra until there is a space.
    fn separate(&mut self, mut refinement: Refinement) -> Result<(), Error> {
        let all = refinement.net().mesh();
        let valences = refinement.net().topology().valences();
        valences.iter().try_for_each(|&(n, _)| crate::check_valence(n))?;
        let points: Vec<[f64; 3]> = all.points().iter().map(|p| [p.x, p.y, p.z]).collect();
        for step in 1..=MOST_STEPS {
            refinement.refine()?;
            if hybrid::space(&refinement, &refinement.apply(&points)?, 0, Ends::Open)?.is_none() {
                continue;
            }
            let mut worst: BTreeMap<usize, f64> = BTreeMap::new();
            for (n, [lambda, other]) in VertexElements::new(refinement.net(), refinement.scheme()).lambdas()? {
                let most = worst.entry(n).or_insert(0.0);
                *most = most.max(lambda);
                self.flattened |= lambda - other > FLATTENED;
            }
            self.lambdas = worst.into_iter().collect();
            self.steps = step;
            self.levels = Levels::Intervals(Box::new(refinement));
            return Ok(());
        }
        Err(Error::TooClose { steps: MOST_STEPS })
    }

    /// Vertices with the simple rule of HNUSS for want of an eigen-polyhedron.
    pub fn simple(&self) -> &[Place] {
        match &self.levels {
            Levels::Uniform(..) => &[],
            Levels::Intervals(refinement) => &refinement.simple,
        }
    }

    /// The points of level 0 from those of the mesh.
    pub(crate) fn first_level(&self, points: &[[f64; 1]]) -> Result<Vec<[f64; 1]>, Error> {
        match &self.levels {
            Levels::Uniform(..) => Ok(points.to_vec()),
            Levels::Intervals(refinement) => Ok(refinement.apply(points)?),
        }
    }

    /// The space of a level over its control mesh.
    pub(crate) fn space(&self, level: usize, ends: Ends) -> Result<Space, Error> {
        let space = match &self.levels {
            Levels::Uniform(rules, tuned) => {
                // one by one, as several at once would have another order of points
                let one = |mesh: Mesh, _| refined(&mesh, rules, 1);
                let mesh = (0..level).try_fold(self.mesh.clone(), one)?;
                Space::new(&mesh, rules, ends, *tuned)?
            }
            Levels::Intervals(refinement) => {
                let mut refinement = refinement.clone();
                (0..level).try_for_each(|_| refinement.refine())?;
                let points: Vec<[f64; 3]> = self.mesh.points().iter().map(|p| [p.x, p.y, p.z]).collect();
                let points = refinement.apply(&points)?;
                hybrid::space(&refinement, &points, level, ends)?
            }
        };
        space.ok_or(Error::TooClose { steps: self.steps })
    }

    /// The space whose geometry is the domain.
    fn fitted(&self, level: usize, options: &Options) -> Result<Space, Error> {
        let mut space = self.space(level, options.ends)?;
        if self.domain == Domain::Sphere {
            for _ in 0..FITS {
                project_to_sphere(&mut space, options)?;
            }
        }
        Ok(space)
    }

    /// The spaces coarser than one with their embeddings, coarsest first.
    fn coarser(&self, level: usize, space: &Space, ends: Ends) -> Result<Vec<(Sparse, Space)>, Error> {
        let Levels::Uniform(rules, tuned) = &self.levels else {
            return Err(Error::Combination {
                what: "multigrid in a space with knot intervals",
                accepted: "cholesky",
            });
        };
        let mut all: Vec<(Mesh, Space)> = Vec::new();
        for coarse in 0..level {
            let mesh = match all.last() {
                Some((mesh, _)) => refined(mesh, rules, 1)?,
                None => self.mesh.clone(),
            };
            let own = Space::new(&mesh, rules, ends, *tuned)?;
            all.push((mesh, own.ok_or(Error::TooClose { steps: coarse })?));
        }
        let finer = all.iter().skip(1).map(|(_, space)| space).chain([space]);
        let embeddings: Vec<Sparse> = all
            .iter()
            .zip(finer)
            .map(|((mesh, coarse), fine)| embedding(mesh, coarse, fine))
            .collect::<Result<_, _>>()?;
        Ok(embeddings
            .into_iter()
            .zip(all.into_iter().map(|(_, space)| space))
            .collect())
    }

    /// The options with the only solver of a space that has one.
    fn solvable(&self, options: &Options) -> Options {
        let solver = match self.levels {
            Levels::Intervals(_) => options.solver.or(Some(Solver::Cholesky)),
            Levels::Uniform(..) => options.solver,
        };
        Options { solver, ..*options }
    }

    fn check(options: &Options) -> Result<(), Error> {
        if !(2..=10).contains(&options.gauss) {
            return Err(Error::Range {
                name: "gauss",
                value: options.gauss,
                accepted: "2 to 10",
            });
        }
        match options.depth.filter(|depth| !(1..=MOST_ANNULI).contains(depth)) {
            Some(value) => Err(Error::Range {
                name: "depth",
                value,
                accepted: "1 to 200",
            }),
            None => Ok(()),
        }
    }

    /// Solves on one level.
    ///
    /// # Errors
    /// Options out of range, a problem of another domain, a Jacobian that is not positive, a matrix that is
    /// not definite, an iteration that does not end; functions that are not in H2, for plates.
    pub fn level(&self, level: usize, problem: Problem, u: &Solution, options: &Options) -> Result<Outcome, Error> {
        Self::check(options)?;
        match (self.domain, problem) {
            (Domain::Planar, Problem::LaplaceBeltrami) => return Err(Error::Open),
            (Domain::Closed | Domain::Sphere, Problem::Poisson | Problem::Neumann | Problem::Biharmonic) => {
                return Err(Error::Closed);
            }
            _ => {}
        }
        let options = self.solvable(options);
        let space = self.fitted(level, &options)?;
        run(&space, problem, u, &options, || {
            self.coarser(level, &space, options.ends)
        })
    }

    /// The lowest eigenvalues of the Laplacian on one level, as many as wanted or as it has unknowns.
    ///
    /// # Errors
    /// Options out of range, a closed surface that is held, as [`Study::level`] otherwise.
    pub fn spectrum(
        &self,
        level: usize,
        membrane: Membrane,
        count: usize,
        options: &Options,
    ) -> Result<Spectrum, Error> {
        Self::check(options)?;
        if !(1..=MOST_EIGENVALUES).contains(&count) {
            return Err(Error::Range {
                name: "count",
                value: count,
                accepted: "1 to 200",
            });
        }
        if self.domain != Domain::Planar && membrane == Membrane::Held {
            return Err(Error::Closed);
        }
        let space = self.fitted(level, options)?;
        spectrum(&space, membrane, count, options)
    }

    /// The control mesh of level 0; under HNUSS the one whose hybrid net is level 0.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// About how many bytes a level takes, with as many eigenvalues, or for the solution of a problem.
    /// Without the factor some 2300 a face at 10^6 faces: mesh, space, matrix, a copy of it without held
    /// unknowns, or the coarser ones; 1300 remain beside a factor. Factors have 20 to 26 n log2 n entries
    /// (squares, fans and a cube of 10^5 to 10^6 unknowns), for which 30 are counted. Tables of solution and
    /// errors have, of each annulus at an extraordinary vertex, two matrices of 45 control points over the
    /// `2N + 8` of a face.
    pub fn bytes(&self, level: usize, options: &Options, eigenvalues: Option<usize>) -> f64 {
        let first = match &self.levels {
            Levels::Uniform(..) => self.mesh.face_count(),
            Levels::Intervals(refinement) => refinement.net().topology().face_count(),
        };
        let faces = first as f64 * 4.0_f64.powi(level as i32);
        let solver = match (eigenvalues, &self.levels) {
            (Some(_), _) => Solver::Cholesky,
            (None, Levels::Intervals(_)) => Solver::Cholesky,
            (None, Levels::Uniform(..)) => options.solver.unwrap_or(default_solver(faces as usize)),
        };
        let one = match solver {
            Solver::Cholesky => f64::max(1300.0 + 8.0 * 30.0 * faces.log2().max(1.0), 2300.0),
            Solver::Multigrid => 2300.0,
        };
        // four more matrices, and two vectors for each direction of Lanczos' basis
        let others = eigenvalues.map_or(0.0, |count| 2400.0 + 16.0 * (3.0 * count as f64 + 100.0));
        let table = |(valence, lambda): &(usize, f64)| {
            let annuli = options
                .depth
                .map_or(-16.0 / (2.0 * lambda.log10()), |depth| depth as f64)
                .clamp(1.0, MOST_ANNULI as f64);
            2.0 * 2.0 * 8.0 * 45.0 * (2 * valence + 8) as f64 * annuli
        };
        let tables: f64 = self.lambdas.iter().map(table).sum();
        faces * (one + others) + tables
    }

    /// The rates that the worst of the valences predicts, see [`predicted`]. A natural solution is not better
    /// than 5/2, 3/2, 2, 1/2: its second derivatives across the boundary vanish there, and those of u do not.
    /// Of plates H2 has its rate, L2 at most twice that; of the others nothing is predicted, nor where a
    /// vertex has two different subdominant eigenvalues.
    pub fn predicted(&self, problem: Problem, ends: Ends) -> [Option<f64>; 4] {
        if self.flattened {
            return [None; 4];
        }
        let lambdas = self.lambdas.iter().map(|(_, lambda)| *lambda);
        let rates = predicted(lambdas.fold(0.0, f64::max));
        if problem == Problem::Biharmonic {
            return [Some(rates[0].min(2.0 * rates[3])), None, None, Some(rates[3])];
        }
        match ends {
            Ends::Open => rates.map(Some),
            Ends::Natural => {
                let most = [2.5, 1.5, 2.0, 0.5];
                std::array::from_fn(|norm| Some(f64::min(rates[norm], most[norm])))
            }
        }
    }
}

fn check_points(mesh: &Mesh, domain: Domain) -> Result<(), Error> {
    for (vertex, p) in mesh.points().iter().enumerate() {
        let position = [p.x, p.y, p.z];
        if !position.iter().all(|c| c.is_finite()) {
            return Err(Error::NotFinite { vertex, position });
        }
        if domain == Domain::Planar && p.z != 0.0 {
            return Err(Error::NotPlanar { vertex, position });
        }
    }
    Ok(())
}

fn check_domain(space: &Space, domain: Domain) -> Result<(), Error> {
    match (domain, space.edges.is_empty()) {
        (Domain::Planar, true) => Err(Error::Closed),
        (Domain::Closed | Domain::Sphere, false) => Err(Error::Open),
        _ => Ok(()),
    }
}

fn refined(mesh: &Mesh, rules: &Rules, levels: usize) -> Result<Mesh, Error> {
    let mut refiner = Refiner::new(rules);
    refiner.boundary = Some(Boundary::Corner);
    Ok(refiner.refined(mesh, levels)?)
}

/// Moves a surface to the nearest one, in the mean square, to its own projection on the unit sphere.
fn project_to_sphere(space: &mut Space, options: &Options) -> Result<(), Error> {
    let tables = tables(space, options, false)?;
    let (mut mass, _) = assemble(space, &tables, &[Form::Mass], None)?;
    let mut maps = Maps::default();
    let wanted = Wanted {
        coefficient: false,
        space: true,
        second: false,
    };
    for face in 0..space.cells.len() {
        let table = &tables[&space.cells[face].kind];
        let (_, data) = points_of(space, table, face);
        table.patches(&data, |patch, control| {
            patch.jets.sums(control, wanted, &mut maps);
            let outward = |map: [Data; 6]| Geometry::new(&map, 1.0, false).is_ok_and(|at| at.outward());
            match maps.iter().all(outward) {
                true => Ok(()),
                false => Err(Error::NotStar {
                    face: space.cells[face].face as usize,
                }),
            }
        })?;
    }
    let factor = mass.swap_remove(0).factor(Some(&space.positions))?;
    let axes = [0, 1, 2].map(|axis| {
        let length = |x: [f64; 3]| x.iter().map(|c| c * c).sum::<f64>().sqrt();
        loads(space, &tables, &|at| at.x[axis] / length(at.x)).map(|load| factor.solve(&load))
    });
    for (axis, coordinates) in axes.into_iter().enumerate() {
        space
            .positions
            .iter_mut()
            .zip(coordinates?)
            .for_each(|(p, value)| p[axis] = value);
    }
    Ok(())
}
