//! What can be wrong with a scheme's description.

use crate::{Lattice, Site};

/// Why a scheme, a parameter or a scheme file is refused. Every variant carries the offending numbers; the
/// message of a range error ends with the accepted range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A vertex or face needs at least three sectors.
    #[error("valence {valence} is out of range: accepted are 3 and above")]
    Valence {
        /// The given valence.
        valence: usize,
    },
    /// The subdominant eigenvalue lies between the outer rings' largest eigenvalue and 1.
    #[error("lambda = {lambda} is out of range: accepted is 0.125 < lambda < 1")]
    Lambda {
        /// The given lambda.
        lambda: f64,
    },
    /// `mu = s lambda^2` must lie between `lambda^2` and `lambda`.
    #[error("s = {s} is out of range: accepted is 1 <= s < {} = 1/lambda", 1.0 / lambda)]
    Relaxation {
        /// The given ratio mu / lambda^2.
        s: f64,
        /// The lambda it was given for.
        lambda: f64,
    },
    /// Weights of the lambda-scheme that are no numbers.
    #[error(
        "the lambda-scheme has no weights at N = {valence}, lambda = {lambda}, f2 = {}, f3 = {}: {divisor} vanishes, or is too small a number to divide by: accepted are other f2 and f3",
        weights[0], weights[1]
    )]
    Divisor {
        /// The valence.
        valence: usize,
        /// The subdominant eigenvalue.
        lambda: f64,
        /// The free weights f2 and f3.
        weights: [f64; 2],
        /// What is divided by.
        divisor: &'static str,
    },
    /// The rule for s asks for a mu that is not below lambda: what is out of range is the valence, and not an
    /// s that was given.
    #[error(
        "at N = {valence}, lambda = {lambda} the rule for s gives {s}, which is not below 1/lambda = {}{}: accepted is a smaller valence",
        1.0 / lambda,
        largest.map_or(String::new(), |largest| format!(", as it is up to N = {largest}"))
    )]
    RelaxationRule {
        /// The valence.
        valence: usize,
        /// The subdominant eigenvalue.
        lambda: f64,
        /// What the rule gives.
        s: f64,
        /// The largest valence up to which the rule has a solution at this lambda, if there is one.
        largest: Option<usize>,
    },
    /// The lambda-scheme is tabulated for the s of its rule only.
    #[error(
        "with s = {s} no weights are tabulated at N = {valence}: accepted are f2 and f3 beside s, or s by its rule"
    )]
    GivenRelaxation {
        /// The valence.
        valence: usize,
        /// The relaxation.
        s: f64,
    },
    /// A table counts its terms in 32 bits.
    #[error("a table of {terms} terms: accepted are up to {maximum}")]
    TableSize {
        /// How many there would be.
        terms: usize,
        /// How many can be counted.
        maximum: usize,
    },
    /// A table reads a point that is not there.
    #[error("a table reads point {index} of {count}: accepted are as many points as it was made for")]
    TablePoint {
        /// The point's index.
        index: usize,
        /// How many points there are.
        count: usize,
    },
    /// A fan has at least one sector.
    #[error("{sectors} sectors: accepted are 1 to {maximum}")]
    Sectors {
        /// The given number of sectors.
        sectors: usize,
        /// The most that are accepted.
        maximum: usize,
    },
    /// Knot intervals are given for each spoke.
    #[error("{}: accepted are exactly {expected} numbers, each 0 or from 1e-60 to 1e60", intervals(*found, *bad))]
    Intervals {
        /// How many are given.
        found: usize,
        /// The number of spokes.
        expected: usize,
        /// The first that is not accepted: its spoke and its value.
        bad: Option<(usize, f64)>,
    },
    /// Knot intervals by whose sum a rule divides.
    #[error("the knot intervals of spokes {} and {} are both zero, and a rule divides by their sum: accepted is at most one of them", spokes[0], spokes[1])]
    ZeroIntervals {
        /// The spokes, from 0.
        spokes: [usize; 2],
    },
    /// The scheme has no rules for this kind of corner.
    #[error("{scheme} has no rules for this corner ({corner}): accepted are {accepted}")]
    Unsupported {
        /// The scheme.
        scheme: String,
        /// The corner.
        corner: String,
        /// What it has rules for.
        accepted: String,
    },
    /// Passes that are no level of refinement.
    #[error("{}{fault}", pass.map_or(String::new(), |pass| format!("pass {}: ", pass + 1)))]
    Rules {
        /// The pass, from 0; `None` for all together.
        pass: Option<usize>,
        /// What is wrong.
        fault: RuleFault,
    },
    /// A regular rule reaches across the centre, where the plane has no unique continuation.
    #[error(
        "the rule of ({}, {}) reads ({x}, {y}) across the centre: points that near to it need a stencil of their own",
        site.x, site.y
    )]
    AcrossCentre {
        /// The point that is made.
        site: Site,
        /// Where its rule reads, in half steps along the sector's spokes.
        x: i32,
        /// See `x`.
        y: i32,
    },
    /// A rule reads a point outside the given control net.
    #[error("point ({}, {}) lies beyond the {rings} rings of the net", site.x, site.y)]
    BeyondNet {
        /// The point that is read.
        site: Site,
        /// The rings there are.
        rings: usize,
    },
    /// Fourier indices count from 0 to N-1.
    #[error("Fourier index {index} is out of range: accepted are 0 to {}", valence - 1)]
    FourierIndex {
        /// The given Fourier index.
        index: usize,
        /// The number of sectors.
        valence: usize,
    },
    /// The rules of a scheme whose sectors differ reach over too many points.
    #[error("the rules reach over {points} points of sectors that differ: accepted are up to {maximum}")]
    NetSize {
        /// How many there are.
        points: usize,
        /// How many are looked at.
        maximum: usize,
    },
    /// No ring is closed under refinement.
    #[error("no control net of up to {rings} rings is closed under refinement")]
    NotClosed {
        /// How many rings were tried.
        rings: usize,
    },
    /// The tension of the generalised scheme; u = -1 divides by zero.
    #[error("tension u0 = {tension} is out of range: accepted is u0 > -1")]
    Tension {
        /// The given tension.
        tension: f64,
    },
    /// The order of the generalised tension scheme.
    #[error("order {order} is out of range: accepted are 3 to {maximum}")]
    Order {
        /// The given order, one more than the degree.
        order: usize,
        /// The largest accepted order.
        maximum: usize,
    },
    /// The scheme has no rules for this valence.
    #[error("scheme {scheme} has no rules for valence {valence}: accepted are {accepted}")]
    NoSuchValence {
        /// The scheme.
        scheme: String,
        /// What was asked for.
        valence: usize,
        /// The valences it has.
        accepted: String,
    },
    /// A weight is neither a number nor a fraction.
    #[error("'{text}' is not a number: accepted are decimals and fractions of integers such as 7/12")]
    Number {
        /// The text as it was given.
        text: String,
    },
    /// A scheme file does not have the expected form.
    #[error("{message}")]
    SchemeFile {
        /// What is wrong, and where.
        message: String,
    },
    /// A parameter of a scheme file is unknown, or its value out of range.
    #[error("{scheme}: {message}")]
    Parameter {
        /// The scheme.
        scheme: String,
        /// What is wrong, and what is accepted.
        message: String,
    },
    /// The name of a scheme is unknown or its parameters do not fit it.
    #[error("scheme '{spec}': {reason}; accepted are {accepted}")]
    Spec {
        /// The name as it was given.
        spec: String,
        /// What is wrong with it.
        reason: String,
        /// What is accepted in its place.
        accepted: String,
    },
    /// The margin to the eigenvalue bounds is a fraction of mu.
    #[error("margin kappa = {margin} is out of range: accepted is 0 <= kappa < 1")]
    Margin {
        /// The given margin.
        margin: f64,
    },
    /// The ratio of the vertex stencil's weights must not make one of them negative.
    #[error("phi = {phi} is out of range: accepted is 0 <= phi < infinity")]
    Phi {
        /// The given ratio alpha / beta of the vertex stencil.
        phi: f64,
    },
    /// No (f2, f3) is admissible.
    #[error("no stencil is admissible at N = {valence}, lambda = {lambda}, s = {s}, phi = {phi}")]
    Infeasible {
        /// The valence.
        valence: usize,
        /// The subdominant eigenvalue.
        lambda: f64,
        /// The relaxation `mu / lambda^2`.
        s: f64,
        /// The ratio `alpha / beta`.
        phi: f64,
    },
    /// A given (f2, f3) is not admissible.
    #[error(transparent)]
    Point(#[from] Box<crate::lambda::InfeasiblePoint>),
    /// A spline, a curve or a number type is refused.
    #[error(transparent)]
    Spline(#[from] eigenring_spline::Error),
    /// The lambda-scheme's table has no entry for a valence.
    #[error("valence {valence} is not tabulated: accepted {}", accepted(tabulated))]
    NotTabulated {
        /// What was asked for.
        valence: usize,
        /// What there is.
        tabulated: Vec<usize>,
    },
    /// A table of the lambda-scheme is not valid.
    #[error("table of the lambda-scheme: {0}")]
    Table(#[from] crate::lambda::TableError),
}

/// Why passes are no level of refinement.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RuleFault {
    /// A level has at least one pass.
    #[error("no pass is given: accepted is one or more")]
    NoPass,
    /// Passes follow each other.
    #[error(
        "each pass must read the kind of net that the pass before makes, and the last make the kind that the first reads"
    )]
    Chain,
    /// A level refines twofold.
    #[error("the passes refine {scale}-fold: accepted is 2 (one pass with two classes of taps, the others with one)")]
    Scale {
        /// The product of the passes' scales.
        scale: i64,
    },
    /// Open fans are those of vertices.
    #[error("an open fan around a face: accepted are open fans of vertex nets")]
    OpenFace,
    /// Lines by sector come in one pair for each spoke.
    #[error("lines for {found} spokes: accepted are exactly {expected}")]
    Sectors {
        /// How many are given.
        found: usize,
        /// The number of spokes.
        expected: usize,
    },
    /// The taps do not lead from net to net.
    #[error("line: the offsets do not lead from the {} net to the {} net: {}", from.name(), to.name(), offsets(*from, *to))]
    Line {
        /// The net that is read.
        from: Lattice,
        /// The net that is made.
        to: Lattice,
    },
    /// A special stencil makes no point of the net.
    #[error("({}, {}) of sector {} is no point of the {} net of the fan", site.x, site.y, site.sector, lattice.name())]
    Target {
        /// The point.
        site: Site,
        /// The net that is made.
        lattice: Lattice,
    },
    /// A special stencil reads no point of the net.
    #[error(
        "the stencil of ({}, {}) reads ({}, {}) of sector {}, which is no point of the {} net of the fan",
        site.x, site.y, read.x, read.y, read.sector, lattice.name()
    )]
    Source {
        /// The point that is made.
        site: Site,
        /// What it reads.
        read: Site,
        /// The net that is read.
        lattice: Lattice,
    },
}

fn offsets(from: Lattice, to: Lattice) -> &'static str {
    match (from, to) {
        (Lattice::Vertex, Lattice::Vertex) => {
            "with one class of taps even offsets are accepted; with two, multiples of 4 in the first and 2 more in the second"
        }
        (Lattice::Face, Lattice::Face) => {
            "with one class of taps even offsets are accepted; with two, offsets 1, -3, 5, .. in the first and -1, 3, -5, .. in the second"
        }
        (Lattice::Vertex, Lattice::Face) => {
            "with one class of taps odd offsets are accepted; with two, offsets -1, 3, -5, .. in the first and 1, -3, 5, .. in the second"
        }
        (Lattice::Face, Lattice::Vertex) => {
            "with one class of taps odd offsets are accepted; with two, offsets 2, -2, 6, .. in the first and multiples of 4 in the second"
        }
    }
}

fn intervals(found: usize, bad: Option<(usize, f64)>) -> String {
    match bad {
        Some((spoke, value)) => format!("knot interval {value} of spoke {spoke}"),
        None => format!("{found} knot intervals"),
    }
}

fn accepted(tabulated: &[usize]) -> String {
    if tabulated.is_empty() {
        return "are none, the table is empty".into();
    }
    let list: Vec<String> = tabulated.iter().map(usize::to_string).collect();
    format!("are {}", list.join(", "))
}
