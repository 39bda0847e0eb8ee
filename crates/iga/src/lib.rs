//! Isogeometric analysis: the basis functions of a subdivision scheme as finite elements on planar meshes.
//!
//! A [`Study`] solves one problem on the levels of a mesh and measures the errors; [`predicted`] rates depend
//! on the subdominant eigenvalue alone.

mod error;
mod problem;
pub mod solution;
mod space;
mod tables;

pub use error::Error;
pub use problem::{Norms, Options, Outcome, Problem};
pub use space::Ends;

use eigenring_scheme::{Definition, Spec};
use eigenring_surface::{Boundary, Mesh, Refiner, Rules};
use solution::Solution;
use space::Space;

/// A mesh whose levels carry spaces.
#[derive(Debug)]
pub struct Study<'a> {
    rules: &'a Rules,
    mesh: Mesh,
    tuned: bool,
    /// Catmull-Clark steps that separated extraordinary vertices from each other and from the boundary.
    pub steps: usize,
    /// The subdominant eigenvalues of the valences in the mesh other than 4.
    pub lambdas: Vec<(usize, f64)>,
}

/// How often a mesh is refined so that its extraordinary vertices are apart.
const MOST_STEPS: usize = 3;

impl<'a> Study<'a> {
    /// A planar mesh of quads with boundary, in the plane z = 0.
    ///
    /// # Errors
    /// What is no such mesh, and a scheme that is not bicubic with one-ring rules.
    pub fn new(mesh: &Mesh, rules: &'a Rules) -> Result<Self, Error> {
        let definition = rules.definition();
        let dual = matches!(definition, Definition::Family(spec) if *spec == Spec::DooSabin);
        if dual || rules.degree()? != Some(3) {
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
        for (vertex, p) in mesh.points().iter().enumerate() {
            if !(p.x.is_finite() && p.y.is_finite() && p.z == 0.0) {
                return Err(Error::NotPlanar {
                    vertex,
                    position: [p.x, p.y, p.z],
                });
            }
        }
        let steps = Rules::new(Definition::Family(Spec::CatmullClark));
        let mut mesh = mesh.without_unused();
        for step in 0..=MOST_STEPS {
            if let Some(space) = Space::new(&mesh, rules, Ends::Open, tuned)? {
                if space.edges.is_empty() {
                    return Err(Error::Closed);
                }
                let lambdas = space.around.iter().map(|(&n, around)| (n, around.lambda)).collect();
                return Ok(Study {
                    rules,
                    mesh,
                    tuned,
                    steps: step,
                    lambdas,
                });
            }
            mesh = refined(&mesh, &steps, 1)?;
        }
        Err(Error::TooClose { steps: MOST_STEPS })
    }

    /// Solves on one level.
    ///
    /// # Errors
    /// Options out of range, a Jacobian that is not positive, a matrix that is not definite.
    pub fn level(&self, level: usize, problem: Problem, u: &Solution, options: &Options) -> Result<Outcome, Error> {
        if !(2..=10).contains(&options.gauss) {
            return Err(Error::Range {
                name: "gauss",
                value: options.gauss,
                accepted: "2 to 10",
            });
        }
        if let Some(value) = options.depth.filter(|depth| !(1..=200).contains(depth)) {
            return Err(Error::Range {
                name: "depth",
                value,
                accepted: "1 to 200",
            });
        }
        let mesh = if level == 0 {
            self.mesh.clone()
        } else {
            refined(&self.mesh, self.rules, level)?
        };
        let space = Space::new(&mesh, self.rules, options.ends, self.tuned)?;
        problem::run(
            &space.ok_or(Error::TooClose { steps: self.steps })?,
            problem,
            u,
            options,
        )
    }

    /// The control mesh of level 0.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The rates that the worst of the valences predicts, see [`predicted`].
    pub fn predicted(&self) -> [f64; 4] {
        predicted(
            self.lambdas
                .iter()
                .fold(0.0, |most, (_, lambda)| f64::max(most, *lambda)),
        )
    }
}

fn refined(mesh: &Mesh, rules: &Rules, levels: usize) -> Result<Mesh, Error> {
    let mut refiner = Refiner::new(rules);
    refiner.boundary = Some(Boundary::Corner);
    Ok(refiner.refined(mesh, levels)?)
}

/// The rates in L2, H1, Linf and H2 that a subdominant eigenvalue predicts in the open space, with
/// `a = log2(1/lambda)`: `min(4, 3a)`, `min(3, 2a)`, `min(4, 2a)`, `min(2, a)`. A count of the errors in the
/// annuli, not a proof; 4, 3, 4, 2 without extraordinary vertices (lambda = 0).
pub fn predicted(lambda: f64) -> [f64; 4] {
    let a = -lambda.log2();
    [(3.0 * a).min(4.0), (2.0 * a).min(3.0), (2.0 * a).min(4.0), a.min(2.0)]
}
