//! What a check says.

use crate::Interval;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

/// How much is known about a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// It holds: by intervals and exact arithmetic alone.
    Proven,
    /// It does not hold, likewise proven; the witness shows why.
    Refuted,
    /// Neither could be proven.
    Undecided,
    /// Computed for numbers that are themselves rounded, so that nothing is proven of an exact scheme.
    Numerical,
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Status::Proven => "proven",
            Status::Refuted => "refuted",
            Status::Undecided => "undecided",
            Status::Numerical => "numerical",
        })
    }
}

/// What refutes a statement: a sentence and the numbers in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Witness {
    /// The sentence.
    pub text: String,
    /// The numbers, by name.
    pub data: BTreeMap<String, Interval>,
}

impl Witness {
    /// A witness without numbers.
    pub fn new(text: impl Into<String>) -> Self {
        Witness {
            text: text.into(),
            data: BTreeMap::new(),
        }
    }

    /// The same with a number.
    pub fn with(mut self, name: &str, value: Interval) -> Self {
        self.data.insert(name.to_owned(), value);
        self
    }
}

/// One statement about a scheme and what is known of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// Which statement: one of [`NAMES`].
    pub name: String,
    /// How much is known.
    pub status: Status,
    /// Whether the statement holds, as far as is known: true if proven, or if computed to hold for rounded numbers.
    pub holds: bool,
    /// Whether the status is a proof.
    pub rigorous: bool,
    /// How far the statement is from failing, where that is a number; a lower bound if proven.
    pub margin: Option<f64>,
    /// An enclosure of the quantity that the statement is about.
    pub enclosure: Option<Interval>,
    /// Why it does not hold.
    pub witness: Option<Witness>,
    /// What was reached where nothing was decided, or what the proof rests on.
    pub reached: Option<String>,
}

/// The statements, in the order in which they are listed.
pub const NAMES: [&str; 11] = [
    "row_sums",
    "hull",
    "dominant",
    "subdominant",
    "regular",
    "injective",
    "bounded_curvature",
    "non_degenerate",
    "strict",
    "corner",
    "gauss",
];

impl Check {
    fn new(name: &str, status: Status) -> Self {
        debug_assert!(NAMES.contains(&name), "{name} is not listed");
        Check {
            name: name.to_owned(),
            status,
            holds: status == Status::Proven,
            rigorous: matches!(status, Status::Proven | Status::Refuted),
            margin: None,
            enclosure: None,
            witness: None,
            reached: None,
        }
    }

    /// A proof.
    pub fn proven(name: &str) -> Self {
        Check::new(name, Status::Proven)
    }

    /// A refutation.
    pub fn refuted(name: &str, witness: Witness) -> Self {
        let mut check = Check::new(name, Status::Refuted);
        check.witness = Some(witness);
        check
    }

    /// Neither.
    pub fn undecided(name: &str, reached: impl Into<String>) -> Self {
        let mut check = Check::new(name, Status::Undecided);
        check.reached = Some(reached.into());
        check
    }

    /// The same with a margin.
    pub fn margin(mut self, margin: f64) -> Self {
        self.margin = margin.is_finite().then_some(margin);
        self
    }

    /// The same with an enclosure.
    pub fn enclosing(mut self, enclosure: Interval) -> Self {
        self.enclosure = enclosure.is_bounded().then_some(enclosure);
        self
    }

    /// The same with a remark on what was reached or what it rests on.
    pub fn remark(mut self, text: impl Into<String>) -> Self {
        self.reached = Some(text.into());
        self
    }

    /// What the same computation says of rounded numbers: nothing is proven of an exact scheme.
    pub fn of_rounded_numbers(mut self) -> Self {
        if self.status == Status::Proven {
            self.status = Status::Numerical;
        }
        self.rigorous = self.status == Status::Refuted;
        self
    }
}

/// Sets of statements that are asked for together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Requirement {
    /// Tangent-plane continuity and single sheets: the criterion of Reif (1995) with that of Peters and Reif (1998).
    C1,
    /// C1, and curvatures stay bounded.
    Bounded,
    /// Bounded, and no other eigenvalue reaches the subsubdominant one.
    Strict,
    /// All weights are non-negative.
    Hull,
}

impl Requirement {
    /// All of them.
    pub const ALL: [Requirement; 4] = [
        Requirement::C1,
        Requirement::Bounded,
        Requirement::Strict,
        Requirement::Hull,
    ];

    /// The name that users give.
    pub fn name(self) -> &'static str {
        match self {
            Requirement::C1 => "c1",
            Requirement::Bounded => "bounded",
            Requirement::Strict => "strict",
            Requirement::Hull => "hull",
        }
    }

    /// The statements it consists of.
    pub fn checks(self) -> &'static [&'static str] {
        const C1: [&str; 5] = ["row_sums", "dominant", "subdominant", "regular", "injective"];
        const BOUNDED: [&str; 6] = [C1[0], C1[1], C1[2], C1[3], C1[4], "bounded_curvature"];
        const STRICT: [&str; 7] = [C1[0], C1[1], C1[2], C1[3], C1[4], "bounded_curvature", "strict"];
        match self {
            Requirement::C1 => &C1,
            Requirement::Bounded => &BOUNDED,
            Requirement::Strict => &STRICT,
            Requirement::Hull => &["hull"],
        }
    }

    /// Whether all of its statements are in the list and hold, and how much is known of that at least.
    pub fn verdict(self, checks: &[Check]) -> (bool, Status) {
        let mut status = Status::Proven;
        for name in self.checks() {
            let found = checks.iter().find(|check| check.name == *name);
            match found.map_or(Status::Undecided, |check| check.status) {
                Status::Refuted => return (false, Status::Refuted),
                Status::Undecided => status = Status::Undecided,
                Status::Numerical if status == Status::Proven => status = Status::Numerical,
                _ => {}
            }
        }
        (matches!(status, Status::Proven | Status::Numerical), status)
    }
}

impl std::str::FromStr for Requirement {
    type Err = crate::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let found = Requirement::ALL.into_iter().find(|known| known.name() == text);
        found.ok_or_else(|| crate::Error::Requirement {
            name: text.to_owned(),
            accepted: Requirement::ALL.map(Requirement::name).join(", "),
        })
    }
}
