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
        "the knot intervals of spokes {spokes:?}{} are zero: accepted are one or two adjacent ones of {valence}",
        at(*.place)
    )]
    ZeroSpokes {
        /// The spokes.
        spokes: Vec<usize>,
        /// The valence.
        valence: usize,
        /// Of a mesh where.
        place: Option<Place>,
    },
    /// Intervals for which the eigen-polyhedron does not exist.
    #[error(
        "the eigen-polyhedron does not exist{} for the intervals {intervals:?}: weights beyond [0, 1] at {outside}: accepted are ratios up to {safe} at valence {valence}, and sets with all weights in [0, 1]",
        at(*.place)
    )]
    OutsideDomain {
        /// Of a mesh where.
        place: Option<Place>,
        /// The intervals of the spokes, as they were given.
        intervals: Vec<f64>,
        /// Sectors and spokes with their weights.
        outside: String,
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
    #[error("{place} {what}: accepted {accepted}")]
    Vertex {
        /// The vertex, or that from which a vertex was made.
        place: Place,
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

/// What a vertex of a net is to whoever gave the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A vertex of the mesh.
    Vertex(u32),
    /// The vertex in the middle of a face of the mesh, after a level.
    Face(u32),
    /// Another vertex that a level has made.
    New,
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Place::Vertex(number) => write!(f, "vertex {number}"),
            Place::Face(number) => write!(f, "the middle of face {number}"),
            Place::New => f.write_str("a refined vertex"),
        }
    }
}

/// The place in words after what is there.
fn at(place: Option<Place>) -> String {
    place.map_or(String::new(), |place| format!(" at {place}"))
}

/// An edge in words, by its ends.
pub(crate) fn edge_between(ends: [Place; 2]) -> String {
    let [a, b] = ends.map(|end| match end {
        Place::Vertex(number) => number.to_string(),
        other => format!("({other})"),
    });
    format!("{a}-{b}")
}

impl Error {
    /// The same error without the vertex, which is that of a corner.
    #[must_use]
    pub(crate) fn of_spokes(mut self) -> Self {
        if let Error::OutsideDomain { place, .. } | Error::ZeroSpokes { place, .. } = &mut self {
            *place = None;
        }
        self
    }

    /// The same error of a vertex of a net whose spokes lead to `heads`, after so many halvings of intervals.
    #[must_use]
    pub(crate) fn at(mut self, vertex: Place, heads: &[Place], halvings: i32) -> Self {
        if let Error::Scheme(eigenring_scheme::Error::ZeroIntervals { spokes }) = &self {
            let edges = spokes.map(|i| {
                let head = heads.get(i);
                head.map_or(format!("spoke {i}"), |head| edge_between([vertex, *head]))
            });
            return Error::ZeroSum {
                what: format!("edges {} of {vertex}", edges.join(" and ")),
                rule: "the rule of HNUSS",
            };
        }
        match &mut self {
            Error::OutsideDomain { place, intervals, .. } => {
                *place = Some(vertex);
                intervals.iter_mut().for_each(|d| *d *= 2_f64.powi(halvings));
            }
            Error::ZeroSpokes { place, .. } => *place = Some(vertex),
            Error::ZeroSum { what, .. } => *what = format!("{what} of {vertex}"),
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
