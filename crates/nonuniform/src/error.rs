//! Why intervals, a mesh or a place are refused.

/// Everything that can go wrong here. A message is one line that ends with what is accepted where a value is
/// refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// From the rules.
    #[error(transparent)]
    Scheme(#[from] eigenring_scheme::Error),
    /// From local matrices.
    #[error(transparent)]
    Spectral(#[from] eigenring_spectral::Error),
    /// From the mesh.
    #[error(transparent)]
    Surface(#[from] eigenring_surface::Error),
    /// Too few or too many spokes, or other counts of intervals.
    #[error(
        "{spokes} spokes with {next} next intervals: accepted are {least} to {MAX_SPOKES} spokes, and as many next intervals"
    )]
    Counts {
        /// The intervals of the first edges.
        spokes: usize,
        /// Those of the next edges.
        next: usize,
        /// The least number of spokes.
        least: usize,
    },
    /// An interval that is none.
    #[error("the knot interval of {what} is {value}: accepted are 0 and numbers from 1e-60 to 1e60")]
    Interval {
        /// Of which element.
        what: String,
        /// The value.
        value: f64,
    },
    /// Intervals by whose sum a rule divides.
    #[error(
        "the knot intervals of {what} are all zero, and {rule} divides by their sum: accepted is a positive one among them"
    )]
    ZeroSum {
        /// The elements.
        what: String,
        /// The rule.
        rule: &'static str,
    },
    /// Zero intervals that leave no strict subdominant eigenvalue.
    #[error(
        "the knot intervals of spokes {spokes:?}{place} are zero: accepted are one or two adjacent ones of {valence}"
    )]
    ZeroSpokes {
        /// The spokes.
        spokes: Vec<usize>,
        /// The valence.
        valence: usize,
        /// At which vertex, in words.
        place: String,
    },
    /// Intervals for which the eigen-polyhedron does not exist.
    #[error(
        "the eigen-polyhedron does not exist{place} for the intervals {intervals:?}: weights beyond [0, 1] at {at}: accepted are ratios up to {safe} at valence {valence}, and sets with all weights in [0, 1]"
    )]
    OutsideDomain {
        /// At which vertex, in words.
        place: String,
        /// The intervals of the spokes.
        intervals: Vec<f64>,
        /// Sectors and spokes with their weights.
        at: String,
        /// The valence.
        valence: usize,
        /// The ratio up to which the polyhedron exists for all sets.
        safe: String,
    },
    /// Two values on one strip of edges.
    #[error("the knot intervals of edges {}-{} ({}) and {}-{} ({}) differ, and both lie on one strip of opposite edges: accepted is one value for a strip", .0.edge[0], .0.edge[1], .0.value, .1.edge[0], .1.edge[1], .1.value)]
    Conflict(Marked, Marked),
    /// A face that is no quad and whose split would make edges of different intervals opposite.
    #[error("face {face} has {size} corners, and its edges {}-{} ({}) and {}-{} ({}) become opposite ones: accepted are equal knot intervals there", .first.edge[0], .first.edge[1], .first.value, .second.edge[0], .second.edge[1], .second.value)]
    OpenStrip {
        /// The face.
        face: u32,
        /// Its corners.
        size: usize,
        /// One edge.
        first: Marked,
        /// The other.
        second: Marked,
    },
    /// A mark on no edge.
    #[error("a knot interval is given for edge {}-{}, which is none of the mesh: accepted are edges of faces", .0[0], .0[1])]
    NoSuchEdge([u32; 2]),
    /// A vertex that has no rule.
    #[error("vertex {vertex} {what}: accepted {accepted}")]
    Vertex {
        /// The vertex.
        vertex: u32,
        /// What it is.
        what: String,
        /// What is accepted, with its verb.
        accepted: &'static str,
    },
    /// A weight that is not positive.
    #[error("the weight of vertex {vertex} is {value}: accepted are finite positive weights")]
    Weight {
        /// The vertex.
        vertex: u32,
        /// The weight.
        value: f64,
    },
    /// A place on the surface that does not exist.
    #[error("{what} {given} is out of range: accepted is {accepted}")]
    Range {
        /// What the value is.
        what: &'static str,
        /// The value.
        given: String,
        /// What is accepted.
        accepted: String,
    },
}

impl Error {
    /// The same error without the vertex, which is that of a corner.
    #[must_use]
    pub(crate) fn of_spokes(mut self) -> Self {
        if let Error::OutsideDomain { place, .. } | Error::ZeroSpokes { place, .. } = &mut self {
            place.clear();
        }
        self
    }

    /// The same error of a vertex of a mesh whose spokes lead to `heads`.
    #[must_use]
    pub fn at(mut self, vertex: u32, heads: &[u32]) -> Self {
        if let Error::Scheme(eigenring_scheme::Error::ZeroIntervals { spokes }) = &self {
            let edges = spokes.map(|i| {
                heads
                    .get(i)
                    .map_or(format!("spoke {i}"), |head| format!("{vertex}-{head}"))
            });
            return Error::ZeroSum {
                what: format!("edges {} of vertex {vertex}", edges.join(" and ")),
                rule: "the rule of HNUSS",
            };
        }
        match &mut self {
            Error::OutsideDomain { place, .. } | Error::ZeroSpokes { place, .. } => {
                *place = format!(" at vertex {vertex}");
            }
            Error::ZeroSum { what, .. } => *what = format!("{what} of vertex {vertex}"),
            _ => {}
        }
        self
    }
}

/// An edge by its vertices, with its interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marked {
    /// The vertices.
    pub edge: [u32; 2],
    /// The interval.
    pub value: f64,
}

/// Spokes beyond this are refused, as those of all corners are.
pub const MAX_SPOKES: usize = eigenring_scheme::MAX_SECTORS;
