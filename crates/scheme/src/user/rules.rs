//! Rules as a file gives them, for one valence or for all, and what they are at a valence.

use super::formula::{Bindings, Context, Fault, Formula, Residual};
use super::{PassRules, SchemeText, file_error};
use crate::{Error, Exact, Fan, Lattice, OneRing, Scalar, Site};
use std::collections::{BTreeMap, BTreeSet};

/// The most terms of all stencils together: symmetric rules of a vertex of valence 1000 have some thousands.
pub(super) const MAX_TERMS: usize = 200_000;

/// Rules with formulas for weights.
#[derive(Clone, Debug)]
pub(super) enum Form {
    OneRing(Box<OneRing<Formula>>),
    Passes(Vec<PassForm>),
}

#[derive(Clone, Debug)]
pub(super) struct PassForm {
    pub from: Lattice,
    pub to: Lattice,
    pub line: Vec<Vec<(i32, Formula)>>,
    pub special: Vec<SpecialForm>,
}

/// A point with a stencil of its own.
#[derive(Clone, Debug)]
pub(super) struct SpecialForm {
    /// Where it is in the text.
    pub start: usize,
    pub at: [i32; 2],
    pub sector: i64,
    pub terms: Vec<TermForm>,
}

#[derive(Clone, Debug)]
pub(super) struct TermForm {
    /// Where it is in the text.
    pub start: usize,
    pub at: [i32; 2],
    pub weights: Sectors,
}

/// The weights of a point in one sector or in all.
#[derive(Clone, Debug)]
pub(super) enum Sectors {
    One(i64, Formula),
    All(Formula),
    /// A formula in the sector's number k, and formulas of their own for some sectors.
    Each {
        weight: Formula,
        except: BTreeMap<i64, Formula>,
    },
}

/// The rules at a valence.
pub(super) enum Rules {
    OneRing(OneRing<Residual>),
    Passes(Vec<PassRules<Residual>>),
}

impl Form {
    /// All formulas of the rules.
    pub(super) fn formulas(&self) -> Vec<&Formula> {
        match self {
            Form::OneRing(weights) => weights.each().map(|(_, formula)| formula).to_vec(),
            Form::Passes(passes) => {
                let lines = passes
                    .iter()
                    .flat_map(|pass| pass.line.iter().flatten().map(|(_, f)| f));
                let special = passes.iter().flat_map(|pass| &pass.special);
                let stencils = special.flat_map(|special| &special.terms);
                let terms = stencils.flat_map(|term| match &term.weights {
                    Sectors::One(_, weight) | Sectors::All(weight) => vec![weight],
                    Sectors::Each { weight, except } => std::iter::once(weight).chain(except.values()).collect(),
                });
                lines.chain(terms).collect()
            }
        }
    }
}

/// Evaluates formulas at a valence, and says in the words of the file what is wrong.
pub(super) struct Evaluator<'a> {
    pub text: &'a SchemeText,
    pub context: Context,
    /// The weight or stencil that is evaluated.
    pub what: String,
    /// Terms of stencils so far.
    pub terms: usize,
    /// For checks: what is open, in doubles.
    pub doubles: Bindings<f64>,
}

impl Evaluator<'_> {
    fn fault(&self, formula: &Formula, fault: &Fault) -> Error {
        let place = self.text.place(formula.place(fault));
        file_error(format!("{place}{}: {}", self.what, fault.message))
    }

    /// A weight, which must be a finite number.
    pub(super) fn weight(&mut self, formula: &Formula, sector: i64) -> Result<Residual, Error> {
        self.context.sector = sector;
        let found = self.context.evaluate(&formula.root);
        let residual = found.map_err(|fault| self.fault(formula, &fault))?;
        let value = residual.to(&self.doubles);
        if !value.is_finite() {
            let n = self.context.valence;
            let message = format!(
                "the weight is {value} at n = {n}, after a division by zero or the root of a negative number: accepted are finite numbers"
            );
            return Err(self.fault(formula, &Fault::new(formula.root.at, message)));
        }
        Ok(residual)
    }

    /// Evaluates named weights, each after those that it reads.
    pub(super) fn names(&mut self, definitions: &[(&str, &Formula)], order: &[usize]) -> Result<(), Error> {
        for &index in order {
            let (name, formula) = definitions[index];
            name.clone_into(&mut self.what);
            let value = self.weight(formula, 0)?;
            self.doubles.names[index] = Some(value.to(&self.doubles));
            self.context.names[index] = Some(value);
        }
        Ok(())
    }

    /// The rules of a form; `named` is the number of named weights before those of a one-ring scheme.
    pub(super) fn rules(&mut self, form: &Form, named: usize) -> Result<Rules, Error> {
        match form {
            Form::OneRing(weights) => {
                // the weights are named ones, and evaluated already
                let mut index = named;
                let values = weights.as_ref().clone().map(|_| {
                    index += 1;
                    match &self.context.names[index - 1] {
                        Some(Residual::Value(value)) => Residual::Value(value.clone()),
                        _ => Residual::Name(index - 1),
                    }
                });
                Ok(Rules::OneRing(values))
            }
            Form::Passes(passes) => {
                let rules = passes.iter().enumerate().map(|(index, pass)| self.pass(index, pass));
                Ok(Rules::Passes(rules.collect::<Result<_, _>>()?))
            }
        }
    }

    fn pass(&mut self, index: usize, form: &PassForm) -> Result<PassRules<Residual>, Error> {
        let mut line = Vec::new();
        self.what = format!("pass {}, line", index + 1);
        for taps in &form.line {
            let taps = taps
                .iter()
                .map(|(offset, weight)| Ok((*offset, self.weight(weight, 0)?)));
            line.push(taps.collect::<Result<Vec<_>, Error>>()?);
        }
        let mut special: Vec<(Site, Vec<(Site, Residual)>)> = Vec::new();
        let mut known = BTreeSet::new();
        for point in &form.special {
            let (site, terms) = self.special(index, point)?;
            if !known.insert(site) {
                let place = self.text.place(point.start);
                let n = self.context.valence;
                let at = point.at;
                return Err(file_error(format!(
                    "{place}valence n = {n}, pass {}: the special point at = {at:?} is given twice",
                    index + 1
                )));
            }
            special.push((site, terms));
        }
        Ok(PassRules {
            from: form.from,
            to: form.to,
            line,
            special,
        })
    }

    fn special(&mut self, pass: usize, form: &SpecialForm) -> Result<(Site, Vec<(Site, Residual)>), Error> {
        let n = self.context.valence;
        let target = self.site(form.start, form.at, form.sector)?;
        let mut terms = Vec::new();
        let mut known = BTreeSet::new();
        self.what = format!("pass {}, stencil at = {:?}", pass + 1, form.at);
        for term in &form.terms {
            for (sector, weight) in self.sectors(&term.weights)? {
                let source = self.site(term.start, term.at, sector)?;
                let place = || self.text.place(term.start);
                if !known.insert(source) {
                    let (x, y, sector) = (source.x, source.y, source.sector);
                    return Err(file_error(format!(
                        "{}valence n = {n}, pass {}, stencil at = [{}, {}] gives point [{x}, {y}] of sector {sector} twice",
                        place(),
                        pass + 1,
                        target.x,
                        target.y
                    )));
                }
                self.terms += 1;
                if self.terms > MAX_TERMS {
                    return Err(file_error(format!(
                        "{}more than {MAX_TERMS} terms: accepted are up to {MAX_TERMS} in all stencils together",
                        place()
                    )));
                }
                terms.push((source, weight));
            }
        }
        Ok((target, terms))
    }

    fn site(&self, start: usize, [x, y]: [i32; 2], sector: i64) -> Result<Site, Error> {
        let site = Site::new(Fan::Closed(self.context.valence), sector, x, y);
        site.ok_or_else(|| {
            let place = self.text.place(start);
            file_error(format!(
                "{place}at = [{x}, {y}] of sector {sector} is no point: accepted are 0 < x, 0 <= y"
            ))
        })
    }

    /// The weights by sector.
    fn sectors(&mut self, weights: &Sectors) -> Result<Vec<(i64, Residual)>, Error> {
        let n = self.context.valence as i64;
        match weights {
            Sectors::One(sector, weight) => Ok(vec![(*sector, self.weight(weight, *sector)?)]),
            Sectors::All(weight) => {
                let weight = self.weight(weight, 0)?;
                Ok((0..n).map(|sector| (sector, weight.clone())).collect())
            }
            Sectors::Each { weight, except } => {
                let special = |k: i64| except.iter().find(|(sector, _)| sector.rem_euclid(n) == k);
                (0..n)
                    .map(|k| {
                        let formula = special(k).map_or(weight, |(_, formula)| formula);
                        Ok((k, self.weight(formula, k)?))
                    })
                    .collect()
            }
        }
    }
}

/// The named weights that others read, each after those that it reads itself.
///
/// # Errors
/// One that reads itself: the formula and the place in which it does, and the way.
pub(super) fn order(
    definitions: &[(&str, &Formula)],
    roots: impl IntoIterator<Item = usize>,
) -> Result<Vec<usize>, (usize, Fault, Vec<usize>)> {
    let read: Vec<Vec<(usize, usize)>> = definitions.iter().map(|(_, formula)| formula.names()).collect();
    let (mut order, mut done) = (Vec::new(), vec![false; definitions.len()]);
    for root in roots {
        // the way to where we are, with how many of the names that each reads have been looked at
        let mut way: Vec<(usize, usize)> = if done[root] { Vec::new() } else { vec![(root, 0)] };
        while let Some((name, seen)) = way.last_mut() {
            let name = *name;
            let Some(&(next, at)) = read[name].get(*seen) else {
                done[name] = true;
                order.push(name);
                way.pop();
                continue;
            };
            *seen += 1;
            if let Some(first) = way.iter().position(|(known, _)| *known == next) {
                let mut circle: Vec<usize> = way[first..].iter().map(|(name, _)| *name).collect();
                circle.push(next);
                return Err((name, Fault::new(at, String::new()), circle));
            }
            if !done[next] {
                way.push((next, 0));
            }
        }
    }
    Ok(order)
}

/// The own weight of the centre, and those of each neighbour, of one-ring weights.
pub(super) fn of_each(weights: &OneRing<Residual>, n: usize) -> [Residual; 3] {
    let number = |value: i64| Residual::Value(Exact::ratio(value, 1));
    let minus = |x: &Residual| Residual::product(vec![number(-1), x.clone()]);
    [
        Residual::sum(vec![number(1), minus(&weights.alpha), minus(&weights.beta)]),
        Residual::quotient(weights.alpha.clone(), number(n as i64)),
        Residual::quotient(weights.beta.clone(), number(n as i64)),
    ]
}
