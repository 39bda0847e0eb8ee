//! The scheme of a file at one valence.

use super::file::Contents;
use super::formula::{Bindings, Context, Residual, sum_degrees};
use super::rules::{Evaluator, Form, PassForm, Rules, of_each, order};
use super::{Balance, PassRules, Reading, balance};
use crate::families::{catmull_clark_weights, tensions_from};
use crate::{Error, Exact, Fan, Level, Line, OneRing, Pass, Same, Scalar, Scheme, Site, Stencil};
use num_rational::BigRational;

/// The rules at a valence: numbers, and formulas in what is open.
#[derive(Clone, Debug)]
pub(super) struct ValenceRules {
    /// The limit level, at tension 1.
    pub limit: Level<Residual>,
    /// The named weights in it, and the order in which they read each other.
    names: Vec<Option<Residual>>,
    order: Vec<usize>,
    /// The leading levels, in their tension.
    leading: Option<Leading>,
    /// The degree of the regular surface.
    pub degree: Option<usize>,
    /// What was balanced.
    pub balance: Balance,
}

#[derive(Clone, Debug)]
struct Leading {
    level: Level<Residual>,
    names: Vec<Option<Residual>>,
    order: Vec<usize>,
    /// The tension of the first refinement.
    tension: Residual,
}

impl ValenceRules {
    /// Evaluates rules at a valence. Stencils' terms are counted in `terms`.
    pub(super) fn new(
        contents: &Contents,
        form: &Form,
        n: usize,
        reading: Reading,
        free: &[usize],
        terms: &mut usize,
    ) -> Result<Self, Error> {
        let definitions = contents.definitions(form);
        let needed = match form {
            Form::OneRing(_) => (contents.names.len()..definitions.len()).collect(),
            Form::Passes(_) => {
                let formulas = form.formulas().into_iter();
                let read = formulas.flat_map(|formula| formula.names()).map(|(name, _)| name);
                let mut read: Vec<usize> = read.collect();
                read.sort_unstable();
                read.dedup();
                read
            }
        };
        // circles have been refused
        let order = order(&definitions, needed).unwrap_or_default();
        let parameter = |(index, known): (usize, &super::Parameter)| match free.contains(&index) {
            true => Residual::Parameter(index),
            false => Residual::Value(known.at(n).to()),
        };
        let parameters: Vec<Residual> = contents.parameters.iter().enumerate().map(parameter).collect();
        let values: Vec<f64> = contents.parameters.iter().map(|known| known.at(n).value()).collect();
        let evaluator = |tension: Residual, value: f64| Evaluator {
            text: &contents.text,
            context: Context::new(n, tension, parameters.clone(), vec![None; definitions.len()]),
            what: "tension".to_owned(),
            terms: 0,
            doubles: Bindings {
                tension: value,
                parameters: values.clone(),
                names: vec![None; definitions.len()],
            },
        };
        let mut evaluate = |tension: Residual, value: f64, reading: Reading| {
            let mut evaluator = evaluator(tension, value);
            evaluator.terms = *terms;
            evaluator.names(&definitions, &order)?;
            let rules = evaluator.rules(form, contents.names.len())?;
            let (level, balance) = level(rules, n, reading)?;
            *terms = evaluator.terms;
            Ok::<_, Error>((level, balance, evaluator.context.names))
        };
        let (limit, balance, names) = evaluate(Residual::Value(Exact::one()), 1.0, reading)?;
        let leading = match &contents.tension {
            None => None,
            Some(formula) => {
                let mut before = evaluator(Residual::Value(Exact::one()), 1.0);
                let tension = before.weight(formula, 0)?;
                let value = tension.to(&before.doubles);
                if value <= -1.0 {
                    return Err(Error::Tension { tension: value });
                }
                let (level, _, names) = evaluate(Residual::Tension, value, Reading::Exact)?;
                Some(Leading {
                    level,
                    names,
                    order: order.clone(),
                    tension,
                })
            }
        };
        let mut entry = ValenceRules {
            limit,
            names,
            order,
            leading,
            degree: None,
            balance,
        };
        let limit = entry.limit.map(|weight| entry.exact_weight(weight));
        entry.degree = Scheme::stationary("", limit).degree();
        Ok(entry)
    }

    fn exact_weight(&self, weight: &Residual) -> Exact {
        let named = |weight: &Residual| match weight {
            Residual::Name(index) => self.names[*index].clone(),
            weight => Some(weight.clone()),
        };
        let value = named(weight).and_then(|weight| weight.exact().cloned());
        value.unwrap_or_else(|| Exact::exact(f64::NAN))
    }

    /// Whether all weights of the limit level are exact numbers.
    pub(super) fn is_exact(&self) -> bool {
        let mut all = true;
        self.limit.map(|weight| all &= self.exact_weight(weight).has_value());
        all
    }

    /// A bound for the degree of the numerators of all sums of weights, less 1, as rational functions of the
    /// open parameters; `None` where they are no rational functions, or levels differ.
    pub(super) fn sums_degree(&self) -> Option<usize> {
        if self.leading.is_some() {
            return None;
        }
        let mut names = vec![None; self.names.len()];
        for &index in &self.order {
            names[index] = self.names[index].as_ref().and_then(|weight| weight.degrees(&names));
        }
        let of = |weights: &mut dyn Iterator<Item = &Residual>| {
            // the sum and -1
            sum_degrees(weights.map(|weight| weight.degrees(&names)).chain([Some([0, 0])]))
        };
        let mut largest = 0;
        for pass in self.limit.passes() {
            for stencil in pass.special().values() {
                largest = largest.max(of(&mut stencil.terms().iter().map(|(_, weight)| weight))?[0]);
            }
            for taps in pass.all_lines().flat_map(|line| line.classes()) {
                largest = largest.max(of(&mut taps.iter().map(|(_, weight)| weight))?[0]);
            }
        }
        Some(largest)
    }

    /// Whether the weights of every point that a pass makes sum to 1.
    pub(super) fn is_affine(&self) -> bool {
        let one = |weights: &mut dyn Iterator<Item = &Residual>| {
            let sum = weights.fold(Exact::zero(), |sum, weight| sum + self.exact_weight(weight));
            sum.same(&Exact::one())
        };
        self.limit.passes().iter().all(|pass| {
            let mut stencils = pass.special().values();
            let mut classes = pass.all_lines().flat_map(|line| line.classes());
            stencils.all(|stencil| one(&mut stencil.terms().iter().map(|(_, weight)| weight)))
                && classes.all(|taps| one(&mut taps.iter().map(|(_, weight)| weight)))
        })
    }

    /// The scheme in exact numbers.
    pub(super) fn exact(&self, name: &str) -> Scheme<Exact> {
        let limit = self.limit.map(|weight| self.exact_weight(weight));
        let leading = match &self.leading {
            // leading levels need not be exact to be enclosed, but where they are the sums of their rows are
            Some(leading) => leading.levels::<Exact>(&[]),
            None => Vec::new(),
        };
        Scheme::of_degree(name, leading, limit, self.degree)
    }

    /// The scheme in a number type, for the given values of all parameters.
    pub(super) fn scheme<S: Scalar>(&self, name: &str, values: &[S]) -> Scheme<S> {
        let bindings = bound(&self.names, &self.order, S::one(), values);
        let limit = self.limit.map(|weight| weight.to(&bindings));
        let leading = self
            .leading
            .as_ref()
            .map_or(Vec::new(), |leading| leading.levels(values));
        Scheme::of_degree(name, leading, limit, self.degree)
    }
}

impl Leading {
    fn levels<S: Scalar>(&self, values: &[S]) -> Vec<Level<S>> {
        let open = bound(&self.names, &self.order, S::exact(f64::NAN), values);
        let rough = Bindings {
            tension: f64::NAN,
            parameters: Vec::new(),
            names: Vec::new(),
        };
        let mut tensions = tensions_from(self.tension.to(&open), self.tension.to(&rough));
        tensions.pop();
        let level = |tension: S| {
            let bindings = bound(&self.names, &self.order, tension, values);
            self.level.map(|weight| weight.to(&bindings))
        };
        tensions.into_iter().map(level).collect()
    }
}

/// What is open, with the named weights evaluated in their order.
fn bound<S: Scalar>(names: &[Option<Residual>], order: &[usize], tension: S, values: &[S]) -> Bindings<S> {
    let mut bindings = Bindings {
        tension,
        parameters: values.to_vec(),
        names: vec![None; names.len()],
    };
    for &index in order {
        bindings.names[index] = names[index].as_ref().map(|residual| residual.to(&bindings));
    }
    bindings
}

/// The level of rules, and what was balanced.
fn level(rules: Rules, n: usize, reading: Reading) -> Result<(Level<Residual>, Balance), Error> {
    let fan = Fan::Closed(n);
    let mut passes = match rules {
        Rules::Passes(passes) => passes,
        Rules::OneRing(weights) => {
            // over names, so that the symmetry holds whatever the weights are
            let ratio = |p, q| Residual::Value(Exact::ratio(p, q));
            let is = |weight: &Residual, p, q| weight.same(&ratio(p, q));
            let OneRing {
                f1,
                f2,
                f3,
                d1,
                d2,
                e1,
                e2,
                ..
            } = &weights;
            // points with the regular rule are regular ones
            let regular_face = [f1, f2, f3].iter().all(|weight| is(weight, 1, 4));
            let regular_edge =
                [d1, d2].iter().all(|weight| is(weight, 3, 8)) && [e1, e2].iter().all(|weight| is(weight, 1, 16));
            let special = |site: Site| match (site.x, site.y) {
                (0, 0) => true,
                (_, 0) => !regular_edge,
                _ => !regular_face,
            };
            let level = weights.level_of(n, special, of_each(&weights, n), ratio)?;
            if reading == Reading::Exact {
                return Ok((level, Balance::default()));
            }
            let mut passes: Vec<PassRules<Residual>> = level.passes().iter().map(listed).collect();
            let balance = balance::balance(fan, &mut passes);
            return Ok(match balance.rows {
                0 => (level, balance),
                _ => (Level::new(fan, passes.into_iter().map(pass).collect())?, balance),
            });
        }
    };
    let balance = match reading {
        Reading::Balanced => balance::balance(fan, &mut passes),
        Reading::Exact => Balance::default(),
    };
    Ok((Level::new(fan, passes.into_iter().map(pass).collect())?, balance))
}

fn listed(pass: &Pass<Residual>) -> PassRules<Residual> {
    let special = pass.special().iter();
    PassRules {
        from: pass.from(),
        to: pass.to(),
        line: pass.line().map_or(Vec::new(), |line| line.classes().to_vec()),
        special: special
            .map(|(site, stencil)| (*site, stencil.terms().to_vec()))
            .collect(),
    }
}

fn pass(rules: PassRules<Residual>) -> Pass<Residual> {
    let regular = Pass::regular(rules.from, rules.to, Line::new(rules.line));
    rules.special.into_iter().fold(regular, |pass, (site, terms)| {
        let stencil = terms
            .into_iter()
            .fold(Stencil::new(), |stencil, (source, weight)| stencil.with(source, weight));
        pass.with(site, stencil)
    })
}

impl Form {
    /// The rules of a regular point: a valence of 4 that a file says nothing of.
    pub(super) fn regular(&self) -> Form {
        match self {
            Form::OneRing(_) => {
                let number = |value: Exact| {
                    let value: BigRational = value.as_rational().unwrap_or_default();
                    super::Formula::number(value, 0)
                };
                let weights: OneRing<Exact> = catmull_clark_weights(4);
                Form::OneRing(Box::new(weights.map(number)))
            }
            Form::Passes(passes) => {
                let regular = |pass: &PassForm| PassForm {
                    special: Vec::new(),
                    ..pass.clone()
                };
                Form::Passes(passes.iter().map(regular).collect())
            }
        }
    }
}
