//! Formulas evaluated as far as they go.

use crate::{Exact, Same, Scalar};
use std::sync::Arc;

/// A weight: a number, or what remains of a formula that depends on something that is not fixed yet.
#[derive(Clone, Debug)]
pub(in crate::user) enum Residual {
    /// An exact number, which has a value.
    Value(Exact),
    /// The tension of the level.
    Tension,
    /// A parameter that is left free, by its place in the file.
    Parameter(usize),
    /// A named weight that is no number either.
    Name(usize),
    Operation(Arc<Operation>),
}

/// What is computed from residuals.
#[derive(Debug)]
pub(in crate::user) enum Operation {
    Sum(Vec<Residual>),
    Product(Vec<Residual>),
    Quotient(Residual, Residual),
    Sqrt(Residual),
}

/// What the open places of residuals stand for.
pub(in crate::user) struct Bindings<S> {
    pub tension: S,
    /// The parameters, all of them, whether free or not.
    pub parameters: Vec<S>,
    /// The named weights, where they are no numbers.
    pub names: Vec<Option<S>>,
}

impl Residual {
    /// The exact number; one without value for a residual that is none.
    pub(in crate::user) fn exact(&self) -> Option<&Exact> {
        match self {
            Residual::Value(value) => Some(value),
            _ => None,
        }
    }

    /// The value in a number type.
    pub(in crate::user) fn to<S: Scalar>(&self, bindings: &Bindings<S>) -> S {
        let nowhere = || S::exact(f64::NAN);
        match self {
            Residual::Value(value) => value.to().unwrap_or_else(nowhere),
            Residual::Tension => bindings.tension.clone(),
            Residual::Parameter(index) => bindings.parameters.get(*index).cloned().unwrap_or_else(nowhere),
            Residual::Name(index) => bindings.names.get(*index).cloned().flatten().unwrap_or_else(nowhere),
            Residual::Operation(operation) => {
                let value = |part: &Residual| part.to(bindings);
                match &**operation {
                    Operation::Sum(parts) => parts.iter().map(value).reduce(|a, b| a + b).unwrap_or_else(S::zero),
                    Operation::Product(parts) => parts.iter().map(value).reduce(|a, b| a * b).unwrap_or_else(S::one),
                    Operation::Quotient(a, b) => value(a) / value(b),
                    Operation::Sqrt(a) => value(a).sqrt(),
                }
            }
        }
    }

    /// Bounds for the degrees of numerator and denominator of the weight as a rational function of the open
    /// parameters, given those of the named weights; `None` where there are roots or the level's tension.
    pub(in crate::user) fn degrees(&self, names: &[Option<[usize; 2]>]) -> Option<[usize; 2]> {
        match self {
            Residual::Value(_) => Some([0, 0]),
            Residual::Parameter(_) => Some([1, 0]),
            Residual::Tension => None,
            Residual::Name(index) => names.get(*index).copied().flatten(),
            Residual::Operation(operation) => match &**operation {
                Operation::Sum(parts) => sum_degrees(parts.iter().map(|part| part.degrees(names))),
                Operation::Product(parts) => parts.iter().try_fold([0, 0], |[p, q], part| {
                    let [a, b] = part.degrees(names)?;
                    Some([p + a, q + b])
                }),
                Operation::Quotient(a, b) => {
                    let ([p, q], [r, s]) = (a.degrees(names)?, b.degrees(names)?);
                    Some([p + s, q + r])
                }
                Operation::Sqrt(_) => None,
            },
        }
    }

    /// How much work the sum and the product with another number are, in machine words.
    pub(in crate::user) fn work(&self, other: &Self) -> [usize; 2] {
        let size = |residual: &Self| residual.exact().map_or((1, 1), Exact::size);
        let ((terms, words), (others, longest)) = (size(self), size(other));
        let sum = (terms + others).saturating_mul(words.max(longest).saturating_pow(2));
        [sum, (terms * others).saturating_mul(words.saturating_mul(longest))]
    }

    /// The number or computation that a list of terms is: numbers first.
    pub(in crate::user) fn sum(parts: Vec<Residual>) -> Residual {
        Self::folded(parts, Exact::zero(), |a, b| a + b, Operation::Sum)
    }

    pub(in crate::user) fn product(parts: Vec<Residual>) -> Residual {
        Self::folded(parts, Exact::one(), |a, b| a * b, Operation::Product)
    }

    /// Numbers become one number as long as that has a value; it stands first, unless it is the unit.
    fn folded(
        parts: Vec<Residual>,
        unit: Exact,
        f: impl Fn(Exact, Exact) -> Exact,
        operation: impl Fn(Vec<Residual>) -> Operation,
    ) -> Residual {
        let mut value = unit.clone();
        let mut rest = Vec::new();
        for part in parts {
            match part {
                Residual::Value(factor) => {
                    let next = f(value.clone(), factor.clone());
                    if next.has_value() {
                        value = next;
                    } else {
                        rest.push(Residual::Value(factor));
                    }
                }
                part => rest.push(part),
            }
        }
        if rest.is_empty() {
            return Residual::Value(value);
        }
        if !value.same(&unit) {
            rest.insert(0, Residual::Value(value));
        }
        match rest.len() {
            1 => rest.remove(0),
            _ => Residual::Operation(Arc::new(operation(rest))),
        }
    }

    pub(in crate::user) fn quotient(a: Residual, b: Residual) -> Residual {
        if let (Residual::Value(a), Residual::Value(b)) = (&a, &b) {
            let quotient = a.clone() / b.clone();
            if quotient.has_value() {
                return Residual::Value(quotient);
            }
        }
        Residual::Operation(Arc::new(Operation::Quotient(a, b)))
    }

    pub(in crate::user) fn sqrt(a: Residual) -> Residual {
        if let Residual::Value(a) = &a {
            let root = a.clone().sqrt();
            if root.has_value() {
                return Residual::Value(root);
            }
        }
        Residual::Operation(Arc::new(Operation::Sqrt(a)))
    }
}

/// The degrees of a sum over a common denominator, which is the product of all.
pub(in crate::user) fn sum_degrees(parts: impl Iterator<Item = Option<[usize; 2]>>) -> Option<[usize; 2]> {
    let parts: Vec<[usize; 2]> = parts.collect::<Option<_>>()?;
    let all: usize = parts.iter().map(|[_, q]| q).sum();
    let largest = parts.iter().map(|[p, q]| p + all - q).max().unwrap_or(0);
    Some([largest, all])
}

impl Same for Residual {
    /// Equal numbers, or the same computation with the same open places.
    fn same(&self, other: &Self) -> bool {
        let all = |a: &[Residual], b: &[Residual]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.same(b));
        match (self, other) {
            (Residual::Value(a), Residual::Value(b)) => a.same(b),
            (Residual::Tension, Residual::Tension) => true,
            (Residual::Parameter(a), Residual::Parameter(b)) | (Residual::Name(a), Residual::Name(b)) => a == b,
            (Residual::Operation(a), Residual::Operation(b)) => match (&**a, &**b) {
                (Operation::Sum(a), Operation::Sum(b)) | (Operation::Product(a), Operation::Product(b)) => all(a, b),
                (Operation::Quotient(a, b), Operation::Quotient(c, d)) => a.same(c) && b.same(d),
                (Operation::Sqrt(a), Operation::Sqrt(b)) => a.same(b),
                _ => false,
            },
            _ => false,
        }
    }
}
