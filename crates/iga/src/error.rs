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
    /// A scheme that is no bicubic one-ring scheme.
    #[error("analysis needs a bicubic scheme around vertices with one-ring rules, and '{0}' is none")]
    NotBicubic(String),
    /// A face that is no quad.
    #[error("face {face} has {corners} corners and analysis needs quads: one step of 'eigenring subdivide' makes them")]
    NotQuad {
        /// Its number.
        face: usize,
        /// Its corners.
        corners: usize,
    },
    /// A vertex off the plane z = 0, or not finite.
    #[error("vertex {vertex} is at {position:?}: the mesh of a planar problem is finite with z = 0")]
    NotPlanar {
        /// Its number.
        vertex: usize,
        /// Where it is.
        position: [f64; 3],
    },
    /// A boundary vertex of more than two faces.
    #[error("boundary vertex {vertex} has {faces} faces, and there one or two are accepted")]
    Reentrant {
        /// Its number.
        vertex: usize,
        /// Its faces.
        faces: usize,
    },
    /// A closed mesh has no boundary for Dirichlet data.
    #[error("the mesh has no boundary, and planar problems need one")]
    Closed,
    /// The mesh stays too narrow.
    #[error("the mesh has extraordinary vertices or boundaries too close to each other after {steps} steps")]
    TooClose {
        /// Steps that were tried.
        steps: usize,
    },
    /// The map is not regular.
    #[error("the Jacobian is {value:e} at a point of face {face}, and must be positive")]
    Jacobian {
        /// The face of the refined mesh.
        face: usize,
        /// Its value in the parameters of the patch.
        value: f64,
    },
    /// An integer parameter out of its range.
    #[error("{name} is {value}; accepted are {accepted}")]
    Range {
        /// Its name.
        name: &'static str,
        /// What was given.
        value: usize,
        /// What may be given.
        accepted: &'static str,
    },
    /// The factorisation failed.
    #[error("the matrix of {unknowns} unknowns is not positive definite in floating point")]
    NotDefinite {
        /// Its size.
        unknowns: usize,
    },
}
