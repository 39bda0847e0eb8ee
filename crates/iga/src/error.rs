//! What is no input for analysis.

/// Why there is no space or no solution.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Of the mesh.
    #[error(transparent)]
    Surface(#[from] eigenring_surface::Error),
    /// Of the rules.
    #[error(transparent)]
    Scheme(#[from] eigenring_scheme::Error),
    /// Of the local matrix.
    #[error(transparent)]
    Spectral(#[from] eigenring_spectral::Error),
    /// Of knot intervals and hybrid nets.
    #[error(transparent)]
    Intervals(#[from] eigenring_nonuniform::Error),
    /// A scheme that is no bicubic one-ring scheme.
    #[error(
        "'{0}' has no finite elements here: accepted are stationary bicubic schemes around vertices with one-ring rules, and the regular rule at valence 4"
    )]
    NotBicubic(String),
    /// A face that is no quad.
    #[error("face {face} has {corners} corners: accepted are quads, which one step of 'eigenring subdivide' makes")]
    NotQuad {
        /// Its number.
        face: usize,
        /// Its corners.
        corners: usize,
    },
    /// A vertex that is not finite.
    #[error("vertex {vertex} is at {position:?}: accepted are finite points")]
    NotFinite {
        /// Its number.
        vertex: usize,
        /// Where it is.
        position: [f64; 3],
    },
    /// A vertex off the plane z = 0.
    #[error("vertex {vertex} is at {position:?}: accepted are points with z = 0")]
    NotPlanar {
        /// Its number.
        vertex: usize,
        /// Where it is.
        position: [f64; 3],
    },
    /// A boundary vertex of more than two faces.
    #[error("boundary vertex {vertex} has {faces} faces: accepted are one or two")]
    Reentrant {
        /// Its number.
        vertex: usize,
        /// Its faces.
        faces: usize,
    },
    /// A closed mesh has no boundary for Dirichlet data.
    #[error("the mesh has no boundary: accepted are planar meshes with one")]
    Closed,
    /// A mesh with a boundary, where a closed surface is wanted.
    #[error("the mesh has a boundary: accepted are closed ones")]
    Open,
    /// No sphere can be fitted.
    #[error(
        "face {face} does not turn its front away from the origin: accepted are surfaces around it whose faces run counter-clockwise from outside"
    )]
    NotStar {
        /// The face of the refined mesh.
        face: usize,
    },
    /// Functions without square-integrable second derivatives.
    #[error(
        "at valence {valence} the ratio of mu and lambda is {ratio:.4}: accepted are ratios up to {most:.4}, whose functions have second derivatives that {annuli} annuli integrate"
    )]
    NotH2 {
        /// The valence.
        valence: usize,
        /// |mu| / lambda.
        ratio: f64,
        /// The largest accepted one.
        most: f64,
        /// How many annuli there may be.
        annuli: usize,
    },
    /// Two choices that exclude each other.
    #[error("{what}: accepted is {accepted}")]
    Combination {
        /// What was asked for.
        what: &'static str,
        /// What may be.
        accepted: &'static str,
    },
    /// Conjugate gradients do not end.
    #[error(
        "the residual of {unknowns} unknowns is {residual:.1e} of its start after {iterations} iterations: accepted are problems for which 1e-12 is reached"
    )]
    NoConvergence {
        /// The size.
        unknowns: usize,
        /// How many there were.
        iterations: usize,
        /// Residual over that at the start.
        residual: f64,
    },
    /// The mesh stays too narrow.
    #[error(
        "extraordinary vertices or boundaries are too close to each other after {steps} steps: accepted are meshes with two faces between them"
    )]
    TooClose {
        /// Steps that were tried.
        steps: usize,
    },
    /// The map is not regular.
    #[error(
        "the Jacobian is {value:e} at {at:?} in face {face} of the level: accepted are positive ones, of faces that are not folded and run counter-clockwise"
    )]
    Jacobian {
        /// The face of the level's mesh.
        face: usize,
        /// The point.
        at: [f64; 3],
        /// Its value in the parameters of the patch.
        value: f64,
    },
    /// A solution that overflows.
    #[error("the solution or its derivatives are no finite numbers near {at:?}: accepted are meshes where they are")]
    Solution {
        /// The point, or where the domain begins if squares overflow.
        at: [f64; 3],
    },
    /// A subdominant eigenvalue that makes no annuli that shrink, or too slowly.
    #[error(
        "lambda is {lambda} at valence {valence}: accepted is above 0 and at most {most:.3}, with which {annuli} annuli suffice"
    )]
    Lambda {
        /// The valence.
        valence: usize,
        /// The modulus of the subdominant eigenvalue.
        lambda: f64,
        /// The largest accepted one.
        most: f64,
        /// How many annuli there may be.
        annuli: usize,
    },
    /// An integer parameter out of its range.
    #[error("{name} is {value}: accepted are {accepted}")]
    Range {
        /// Its name.
        name: &'static str,
        /// What was given.
        value: usize,
        /// What may be given.
        accepted: &'static str,
    },
    /// The factor has more entries than 32 bits count, or than memory has room for.
    #[error(
        "the Cholesky factor of {unknowns} unknowns is too large: accepted are fewer levels or, in spaces without knot intervals, --solver multigrid"
    )]
    TooLarge {
        /// The size of the matrix.
        unknowns: usize,
    },
    /// The factorisation failed.
    #[error(
        "the matrix of {unknowns} unknowns is not positive definite in floating point: accepted are meshes and schemes of which it is"
    )]
    NotDefinite {
        /// Its size.
        unknowns: usize,
    },
}
