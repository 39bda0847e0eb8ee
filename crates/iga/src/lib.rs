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

use eigenring_scheme::{Definition, Lattice, Scheme, Spec};
use eigenring_surface::{Boundary, Mesh, Refiner, Rules};
use solution::Solution;
use space::Space;

/// Whether a scheme around a vertex has tables here: bicubic with one-ring rules, the same at every level.
///
/// # Errors
/// Those of the reach of its stencils.
pub fn accepts(scheme: &Scheme<f64>) -> Result<bool, Error> {
    let one_ring = scheme.limit().special_rings()?.is_none_or(|rings| rings <= 1);
    let bicubic = scheme.lattice() == Lattice::Vertex && scheme.degree() == Some(3);
    Ok(bicubic && one_ring && scheme.leading().is_empty())
}

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
        if let Some(value) = options.depth.filter(|depth| !(1..=MOST_ANNULI).contains(depth)) {
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

    /// About how many bytes a level takes: entries of the elements twice, before and after they are numbered,
    /// and the factor, which has some 22 n log2 n entries (empirical, meshes of 10^4 to 10^6 unknowns).
    pub fn bytes(&self, level: usize) -> f64 {
        let faces = self.mesh.face_count() as f64 * 4.0_f64.powi(level as i32);
        faces * (2.0 * 24.0 * 136.0 + 8.0 * 22.0 * faces.log2().max(1.0))
    }

    /// The rates that the worst of the valences predicts, see [`predicted`]. A natural solution is not better
    /// than 5/2, 3/2, 2, 1/2: its second derivatives across the boundary vanish there, and those of u do not.
    pub fn predicted(&self, ends: Ends) -> [f64; 4] {
        let lambdas = self.lambdas.iter().map(|(_, lambda)| *lambda);
        let rates = predicted(lambdas.fold(0.0, f64::max));
        match ends {
            Ends::Open => rates,
            Ends::Natural => {
                let most = [2.5, 1.5, 2.0, 0.5];
                std::array::from_fn(|norm| f64::min(rates[norm], most[norm]))
            }
        }
    }
}

/// The most annuli of an extraordinary vertex: what they leave out is `lambda^400` of the area.
pub(crate) const MOST_ANNULI: usize = 200;

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
