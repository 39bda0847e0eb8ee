//! Formulas for weights: `(3 + 2*cos(2*pi*k/n))/(4*n)`.
//!
//! A formula is read into a [`Node`] ([`parse`](parse::parse)) and then, at a valence, evaluated as far as it
//! goes ([`Context::evaluate`](evaluate::Context)): whatever does not depend on the level's tension or on a
//! parameter that is left free becomes an [`Exact`](crate::Exact) number, and the rest stays a
//! [`Residual`], which runs in every [`Scalar`](crate::Scalar).
//!
//! ```text
//! expression  term (('+' | '-') term)*
//! term        factor (('*' | '/') factor)*
//! factor      ('+' | '-') factor | atom ('^' integer)?
//! atom        number | name | '(' expression ')' | ('cos' | 'sin' | 'sqrt') '(' expression ')'
//!             | 'sum' '(' name ',' (expression ',' expression ',')? expression ')'
//! ```
//!
//! Names are `n`, in a stencil over all sectors `k`, the level's tension `u`, `pi` within `cos` and `sin`,
//! parameters, and other weights. `sum(k, x)` adds x for k = 0 to n - 1, `sum(k, a, b, x)` for k = a to b.

pub(super) mod evaluate;
mod mathml;
mod parse;
pub(super) mod residual;

pub(super) use evaluate::Context;
pub(super) use mathml::{Typesetter, identifier};
pub(super) use parse::parse;
pub(super) use residual::{Bindings, Residual, sum_degrees};

use num_rational::BigRational;

/// The longest formula.
pub(super) const MAX_LENGTH: usize = 10_000;

/// How deep brackets, signs and functions may be nested.
pub(super) const MAX_DEPTH: usize = 64;

/// The largest exponent.
pub(super) const MAX_POWER: u32 = 64;

/// Words that no parameter and no weight can be named.
pub(super) const RESERVED: [&str; 8] = ["n", "k", "u", "pi", "cos", "sin", "sqrt", "sum"];

/// A formula in a file.
#[derive(Clone, Debug)]
pub(super) struct Formula {
    /// Where it begins in the file's text, in bytes.
    pub start: usize,
    /// Whether places in it are places in the file: its text has no escapes.
    pub literal: bool,
    pub root: Node,
}

/// A part of a formula, and where it begins.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub at: usize,
    pub kind: Kind,
}

#[derive(Clone, Debug)]
pub(super) enum Kind {
    Number(BigRational),
    Pi,
    Symbol(Symbol),
    /// Terms and whether they are subtracted. Lists, and not pairs, so that long ones are no deep trees.
    Sum(Vec<(bool, Node)>),
    /// Factors and whether they divide.
    Product(Vec<(bool, Node)>),
    Power(Box<Node>, u32),
    Cos(Box<Node>),
    Sin(Box<Node>),
    Sqrt(Box<Node>),
    /// The sum of a body over a variable, the innermost local one, by default over all sectors.
    Sectors {
        bounds: Option<Box<[Node; 2]>>,
        body: Box<Node>,
    },
}

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Symbol {
    Valence,
    /// The sector of the term.
    Sector,
    /// A summation variable, from the outermost.
    Local(usize),
    Tension,
    Parameter(usize),
    /// A named weight.
    Name(usize),
}

/// The names that a formula may use.
#[derive(Clone, Debug, Default)]
pub(super) struct Scope {
    pub parameters: Vec<String>,
    pub names: Vec<String>,
    pub tension: bool,
    /// Whether the formula is the weight of every sector k.
    pub sector: bool,
}

/// What is wrong with a formula, and where in it, in bytes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fault {
    pub at: usize,
    pub message: String,
}

impl Fault {
    pub(super) fn new(at: usize, message: impl Into<String>) -> Self {
        Fault {
            at,
            message: message.into(),
        }
    }
}

impl Formula {
    /// A number.
    pub(super) fn number(value: BigRational, start: usize) -> Self {
        Formula {
            start,
            literal: false,
            root: Node {
                at: 0,
                kind: Kind::Number(value),
            },
        }
    }

    /// Where a fault is in the file's text.
    pub(super) fn place(&self, fault: &Fault) -> usize {
        self.start + if self.literal { fault.at } else { 0 }
    }

    /// The named weights that the formula reads, with their places.
    pub(super) fn names(&self) -> Vec<(usize, usize)> {
        let mut found = Vec::new();
        self.root.visit(&mut |node| {
            if let Kind::Symbol(Symbol::Name(name)) = node.kind {
                found.push((name, node.at));
            }
        });
        found
    }
}

impl Node {
    fn visit(&self, f: &mut impl FnMut(&Node)) {
        f(self);
        match &self.kind {
            Kind::Number(_) | Kind::Pi | Kind::Symbol(_) => {}
            Kind::Sum(parts) | Kind::Product(parts) => parts.iter().for_each(|(_, part)| part.visit(f)),
            Kind::Power(inner, _) | Kind::Cos(inner) | Kind::Sin(inner) | Kind::Sqrt(inner) => inner.visit(f),
            Kind::Sectors { bounds, body } => {
                bounds
                    .iter()
                    .flat_map(|pair| pair.iter())
                    .for_each(|bound| bound.visit(f));
                body.visit(f);
            }
        }
    }
}

#[cfg(test)]
mod tests;
