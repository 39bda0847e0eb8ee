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

impl Status {
    /// What is known of two statements together: the one conjunction of this crate. A refuted part refutes
    /// the whole; an undecided one leaves it undecided; a numerical one leaves it numerical.
    pub fn and(self, other: Status) -> Status {
        let rank = |status| match status {
            Status::Refuted => 0,
            Status::Undecided => 1,
            Status::Numerical => 2,
            Status::Proven => 3,
        };
        if rank(other) < rank(self) { other } else { self }
    }
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
#[serde(deny_unknown_fields)]
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
#[serde(deny_unknown_fields)]
pub struct Check {
    /// Which statement.
    pub name: Statement,
    /// How much is known.
    pub status: Status,
    /// Whether the statement holds, as far as is known: true if proven, or if computed to hold for rounded
    /// numbers.
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

/// A statement about a scheme at one valence. The order is that in which statements are listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Statement {
    /// The weights of every refined point sum to 1, in every level.
    RowSums,
    /// No weight is negative, in any level.
    Hull,
    /// Levels that differ approach the limit level fast enough for C1 to carry over.
    Levels,
    /// The eigenvalue 1 is simple, and all others lie inside the unit disc.
    Dominant,
    /// A real positive pair of Fourier index 1 leads all other eigenvalues.
    Subdominant,
    /// The Jacobian of the characteristic map has one sign.
    Regular,
    /// The characteristic map is injective.
    Injective,
    /// No further eigenvalue exceeds `lambda^2` in modulus, and none that reaches it has a Jordan block.
    BoundedCurvature,
    /// `lambda^2` is an eigenvalue of the three second-order modes.
    NonDegenerate,
    /// All eigenvalues after these three are smaller in modulus.
    Strict,
    /// The corner angle of the natural configuration is within its bound.
    Corner,
    /// The Gauss curvature of the second-order maps has the wanted signs.
    Gauss,
}

impl Statement {
    /// All of them.
    pub const ALL: [Statement; 12] = [
        Statement::RowSums,
        Statement::Hull,
        Statement::Levels,
        Statement::Dominant,
        Statement::Subdominant,
        Statement::Regular,
        Statement::Injective,
        Statement::BoundedCurvature,
        Statement::NonDegenerate,
        Statement::Strict,
        Statement::Corner,
        Statement::Gauss,
    ];

    /// The name that is printed and stored.
    pub fn name(self) -> &'static str {
        match self {
            Statement::RowSums => "row_sums",
            Statement::Hull => "hull",
            Statement::Levels => "levels",
            Statement::Dominant => "dominant",
            Statement::Subdominant => "subdominant",
            Statement::Regular => "regular",
            Statement::Injective => "injective",
            Statement::BoundedCurvature => "bounded_curvature",
            Statement::NonDegenerate => "non_degenerate",
            Statement::Strict => "strict",
            Statement::Corner => "corner",
            Statement::Gauss => "gauss",
        }
    }
}

impl fmt::Display for Statement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Check {
    fn new(name: Statement, status: Status) -> Self {
        Check {
            name,
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
    pub fn proven(name: Statement) -> Self {
        Check::new(name, Status::Proven)
    }

    /// A refutation.
    pub fn refuted(name: Statement, witness: Witness) -> Self {
        let mut check = Check::new(name, Status::Refuted);
        check.witness = Some(witness);
        check
    }

    /// Neither.
    pub fn undecided(name: Statement, reached: impl Into<String>) -> Self {
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
        // rows of rounded weights sum to 1 only nearly, so that not even a refutation is one of an exact
        // scheme
        self.rigorous = false;
        self
    }
}

/// Sets of statements that are asked for together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Requirement {
    /// Tangent-plane continuity and single sheets: the criterion of Reif (1995) with that of Peters and Reif
    /// (1998).
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

    /// The statements it consists of; `levels` is one only of schemes whose levels differ.
    pub fn statements(self) -> &'static [Statement] {
        use Statement::{BoundedCurvature, Dominant, Hull, Injective, Levels, Regular, RowSums, Strict, Subdominant};
        match self {
            Requirement::C1 => &[RowSums, Levels, Dominant, Subdominant, Regular, Injective],
            Requirement::Bounded => &[
                RowSums,
                Levels,
                Dominant,
                Subdominant,
                Regular,
                Injective,
                BoundedCurvature,
            ],
            Requirement::Strict => &[
                RowSums,
                Levels,
                Dominant,
                Subdominant,
                Regular,
                Injective,
                BoundedCurvature,
                Strict,
            ],
            Requirement::Hull => &[Hull],
        }
    }

    /// Whether all of its statements are in the list and hold, and how much is known of that at least.
    pub fn verdict(self, checks: &[Check]) -> (bool, Status) {
        let found = |statement: &Statement| checks.iter().find(|check| check.name == *statement).map(|c| c.status);
        let statuses = self.statements().iter().filter_map(|statement| match found(statement) {
            // of a stationary scheme there is nothing to say
            None if *statement == Statement::Levels => None,
            found => Some(found.unwrap_or(Status::Undecided)),
        });
        let status = statuses.fold(Status::Proven, Status::and);
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
