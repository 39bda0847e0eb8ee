//! Schemes that users write down, in TOML.
//!
//! Two forms. `kind = "one-ring"` changes the three bicubic stencils next to a vertex:
//!
//! ```toml
//! kind = "one-ring"
//! name = "mine"
//!
//! [[valence]]
//! n = 5
//! f1 = "1/4"        # numbers, or exact fractions as strings
//! f2 = 0.25
//! f3 = 0.25
//! d1 = 0.375
//! d2 = 0.375
//! e1 = 0.0625
//! e2 = 0.0625
//! alpha = 0.3       # total weight of the N edge neighbours
//! beta = 0.05       # total weight of the N face neighbours
//! ```
//!
//! `kind = "stencils"` describes any passes around a vertex or a face; all positions are half steps (see
//! [`Site`]):
//!
//! ```toml
//! kind = "stencils"
//! name = "doo-sabin-like"
//! degree = 2                       # of the regular surface; may be left out
//!
//! [[valence]]
//! n = 3
//!
//! [[valence.pass]]                 # passes in order; the refined net must be of the kind that is read first
//! from = "face"
//! to = "face"
//! # one class of taps per target point and source point: [offset, weight];
//! # the target X reads (X + offset) / classes
//! line = [[[1, "3/4"], [-3, "1/4"]], [[-1, "3/4"], [3, "1/4"]]]
//!
//! [[valence.pass.special]]   # a point with a stencil of its own, in sector 0 unless `sector` says otherwise
//! at = [1, 1]
//! stencil = [
//!     { at = [1, 1], weight = "2/3" },
//!     { at = [1, 1], sector = 1, weight = "1/6" },
//!     { at = [1, 1], sector = -1, weight = "1/6" },
//! ]                                # sector = "all" gives the weight to the point of every sector
//! ```
//!
//! Weights in quotes may be formulas in the valence n, and then one rule holds for all valences that are not
//! listed; the same example with a parameter:
//!
//! ```toml
//! kind = "stencils"
//! name = "doo-sabin"
//!
//! [parameters]                     # values can be set from outside, within the range
//! a = { default = "1/4", range = ["0", "1"], doc = "n times the least weight" }
//!
//! [names]                          # names for weights that formulas use
//! far = "a/n"
//!
//! [rule]
//! n = "3.."
//!
//! [[rule.pass]]
//! from = "face"
//! to = "face"
//! line = [[[1, "3/4"], [-3, "1/4"]], [[-1, "3/4"], [3, "1/4"]]]
//!
//! [[rule.pass.special]]
//! at = [1, 1]
//! stencil = [                      # sector = "k" is every sector, by its number
//!     { at = [1, 1], sector = "k", weight = "far*(3 + 2*cos(2*pi*k/n))", except = { "0" = "1/4 + 5*far" } },
//! ]
//! ```
//!
//! A parameter may have values of its own at single valences, `except = { "5" = "0.26", "6" = "0.27" }`
//! beside its default, as tuning finds them; what is set from outside holds at every valence.
//!
//! Formulas are made of numbers, `+ - * / ^`, brackets, `n`, in a stencil over all sectors `k`, parameters,
//! names, in the one-ring form the other weights, `sqrt(..)`, `cos(..)` and `sin(..)` of rational multiples
//! of `pi`, `sum(k, ..)` over all sectors and `sum(k, from, to, ..)`. With `tension = "2"` (a number or a
//! formula in parameters) at the head of the file, `u` is the tension of the level: that value at the
//! first, then `sqrt((1 + u)/2)` of the one before, and 1 in the limit. They are evaluated exactly as long
//! as they stay in real cyclotomic fields, see [`Exact`]; [`UserScheme::is_exact`] says whether they do. At
//! a valence of 4 that neither a rule nor a list speaks of, all points are regular ones.
//!
//! A special point given for sector 0 only holds for all sectors; if any is given for another sector, every
//! sector stands for itself. Numbers are taken as the exact decimals and fractions that are written, of any
//! length; symmetry and degree are derived from them. `degree` may be left out; another one than that of the
//! B-splines that the lines refine is refused, and it has no effect where they refine none. How weights that
//! a program has rounded are read is said in [`Reading`].

mod balance;
mod file;
mod formula;
mod parameters;
mod rules;
mod starters;
mod tuned;
mod typeset;
mod valence_rules;

pub use balance::Balance;
pub use parameters::Parameter;
pub use starters::{Starter, starters};
pub use typeset::{Typeset, TypesetForm, TypesetPass, TypesetRule, TypesetSectors, TypesetStencil, TypesetTerm};

use crate::{Error, Exact, Lattice, Number, Scalar, Scheme, Site};
use file::{Contents, MAX_VALENCE, SchemeText, file_error};
use formula::Formula;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use valence_rules::ValenceRules;

/// How the weights of a file are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Reading {
    /// Weights of special stencils that a reflection in a spoke exchanges, those of the centre's also if a
    /// rotation does, and sums of special stencils, are taken for rounded where they differ by at most 1e-12,
    /// from each other or from 1, and balanced: the weights become their mean, and a point's own weight takes
    /// what is missing to 1, or all weights alike if the point is not among its own sources.
    #[default]
    Balanced,
    /// As written.
    Exact,
}

/// A scheme file, read and checked: rules for the valences it lists, and for those that its formulas are for.
#[derive(Clone, Debug)]
pub struct UserScheme {
    contents: Contents,
    name: String,
    reading: Reading,
    /// The parameters that stay open, by their place.
    free: Vec<usize>,
    /// The scheme at the valences that are listed.
    entries: Vec<(usize, ValenceRules)>,
}

/// The rules of a file at one valence, read once.
#[derive(Clone, Debug)]
pub struct RulesAt {
    name: String,
    entry: ValenceRules,
}

impl RulesAt {
    /// The scheme with the given values of all parameters, which count where the parameter is open.
    pub fn scheme<S: Scalar>(&self, values: &[S]) -> Scheme<S> {
        self.entry.scheme(&self.name, values)
    }
}

#[derive(Clone, Debug)]
struct PassRules<W> {
    from: Lattice,
    to: Lattice,
    line: Vec<Vec<(i32, W)>>,
    special: Vec<(Site, Vec<(Site, W)>)>,
}

impl UserScheme {
    /// Reads a scheme from the text of a TOML file; `default_name` is used if the file gives none.
    ///
    /// # Errors
    /// [`Error::SchemeFile`], with what is wrong and where. Sums of weights are not checked here: they are a
    /// property to be verified, not a matter of form. Formulas of a rule are tried at a valence of its range.
    pub fn parse(text: &str, default_name: &str, reading: Reading) -> Result<Self, Error> {
        let contents = file::read(text)?;
        contents.check_names()?;
        let name = contents.name.clone().unwrap_or_else(|| default_name.to_owned());
        UserScheme {
            contents,
            name,
            reading,
            free: Vec::new(),
            entries: Vec::new(),
        }
        .evaluated()
    }

    /// The same file with other values of parameters.
    ///
    /// # Errors
    /// [`Error::Parameter`] for an unknown parameter, one that is set twice, or a value out of its range;
    /// those of the formulas.
    pub fn with<N: AsRef<str>>(&self, values: &[(N, Number)]) -> Result<Self, Error> {
        let mut scheme = self.clone();
        let mut known: Vec<usize> = Vec::new();
        for (name, value) in values {
            let index = scheme.index(name.as_ref())?;
            let parameter = &mut scheme.contents.parameters[index];
            let refuse = |message: String| Error::Parameter {
                scheme: self.name.clone(),
                message,
            };
            if known.contains(&index) {
                return Err(refuse(format!("{} is set twice: accepted is once", parameter.name)));
            }
            known.push(index);
            parameter.set = Some(parameter.check(value.clone()).map_err(refuse)?);
        }
        match known.is_empty() {
            true => Ok(scheme),
            false => scheme.evaluated(),
        }
    }

    /// The same file with open parameters, which get their values in [`UserScheme::scheme_with`]. What
    /// depends on them has no exact number, and the present values are only tried.
    ///
    /// # Errors
    /// [`Error::Parameter`] for an unknown parameter; those of the formulas.
    pub fn freeing<N: AsRef<str>>(&self, names: &[N]) -> Result<Self, Error> {
        let mut scheme = self.clone();
        let free = names.iter().map(|name| self.index(name.as_ref()));
        scheme.free = free.collect::<Result<_, _>>()?;
        scheme.evaluated()
    }

    fn index(&self, name: &str) -> Result<usize, Error> {
        let found = self.contents.parameters.iter().position(|known| known.name == name);
        found.ok_or_else(|| {
            let names: Vec<&str> = self.parameters().iter().map(|known| known.name.as_str()).collect();
            let accepted = match names.as_slice() {
                [] => "none, the file has no [parameters]".to_owned(),
                names => names.join(", "),
            };
            Error::Parameter {
                scheme: self.name.clone(),
                message: format!("unknown parameter '{name}': accepted are {accepted}"),
            }
        })
    }

    /// Evaluates what is listed, and tries the rule.
    fn evaluated(mut self) -> Result<Self, Error> {
        let mut terms = 0;
        let mut entries = Vec::new();
        for (n, form) in &self.contents.valences {
            let at_n = |error: Error| match error {
                Error::SchemeFile { .. } => error,
                error => file_error(format!("valence n = {n}: {error}")),
            };
            let entry = self.entry_of(form, *n, &mut terms).map_err(at_n)?;
            entries.push((*n, entry));
        }
        self.entries = entries;
        if let Some(rule) = &self.contents.rule {
            let last = rule.last.unwrap_or(MAX_VALENCE);
            // formulas may divide by zero at a valence that nobody asks for
            let tried = [5, 6, 7, rule.first, last];
            let mut found = None;
            for n in tried.into_iter().filter(|n| (rule.first..=last).contains(n)) {
                match self.entry_of(&rule.form, n, &mut 0) {
                    Ok(_) => return Ok(self),
                    Err(error) => found = found.or(Some(error)),
                }
            }
            if let Some(error) = found {
                return Err(error);
            }
        }
        Ok(self)
    }

    /// The name, with the parameters that are set to another value than the file's.
    pub fn name(&self) -> String {
        let set = self
            .parameters()
            .iter()
            .filter_map(|known| Some((&known.name, known.changed()?)));
        let set: String = set.map(|(name, value)| format!(",{name}={value}")).collect();
        format!("{}{set}", self.name)
    }

    /// The parameters, in the order of the file.
    pub fn parameters(&self) -> &[Parameter] {
        &self.contents.parameters
    }

    /// Whether the file declares the crease rule of its degree.
    pub fn has_creases(&self) -> bool {
        self.contents.creases
    }

    /// The valences that are listed, in the order of the file.
    pub fn valences(&self) -> impl Iterator<Item = usize> + '_ {
        self.entries.iter().map(|(n, _)| *n)
    }

    /// The valences that formulas are for, the last one included, beside those that are listed.
    pub fn rule(&self) -> Option<(usize, Option<usize>)> {
        self.contents.rule.as_ref().map(|rule| (rule.first, rule.last))
    }

    /// Whether the scheme is one of face nets or of vertex nets.
    pub fn lattice(&self) -> Lattice {
        match self.contents.forms().next() {
            Some(rules::Form::Passes(passes)) => passes.first().map_or(Lattice::Vertex, |pass| pass.from),
            _ => Lattice::Vertex,
        }
    }

    /// The scheme around a centre of the given valence, in exact numbers. Weights that are none have no
    /// value, see [`UserScheme::is_exact`].
    ///
    /// # Errors
    /// [`Error::NoSuchValence`] if the file has no rules for it; those of the formulas.
    pub fn exact(&self, valence: usize) -> Result<Scheme<Exact>, Error> {
        Ok(self.entry(valence)?.exact(&self.name()))
    }

    /// Whether all weights of the limit level are exact numbers.
    ///
    /// # Errors
    /// As [`UserScheme::exact`].
    pub fn is_exact(&self, valence: usize) -> Result<bool, Error> {
        Ok(self.entry(valence)?.is_exact())
    }

    /// The scheme around a centre of the given valence.
    ///
    /// # Errors
    /// As [`UserScheme::exact`].
    pub fn scheme<S: Scalar>(&self, valence: usize) -> Result<Scheme<S>, Error> {
        let values: Vec<S> = self.parameters().iter().map(|known| known.at(valence).to()).collect();
        self.scheme_with(valence, &values)
    }

    /// The scheme with the given values of all parameters, which count where the parameter is open.
    ///
    /// # Errors
    /// As [`UserScheme::exact`].
    pub fn scheme_with<S: Scalar>(&self, valence: usize, values: &[S]) -> Result<Scheme<S>, Error> {
        Ok(self.entry(valence)?.scheme(&self.name(), values))
    }

    /// The rules at a valence, for many values of the open parameters.
    ///
    /// # Errors
    /// As [`UserScheme::exact`].
    pub fn at(&self, valence: usize) -> Result<RulesAt, Error> {
        Ok(RulesAt {
            name: self.name(),
            entry: self.entry(valence)?.into_owned(),
        })
    }

    /// Whether the weights of every point sum to 1 for all values of a parameter at which they have a value.
    ///
    /// Sums, less 1, are rational functions of the parameter, with a bound for the degree of the numerator by
    /// the form of the formulas. One that is zero at more values than that is zero: the values are taken
    /// between the given ends, in exact numbers, and nothing is balanced. False says nothing.
    ///
    /// # Errors
    /// As [`UserScheme::with`] and [`UserScheme::exact`].
    pub fn is_affine_in(&self, parameter: &str, valence: usize, [first, last]: [&Number; 2]) -> Result<bool, Error> {
        const MAX_DEGREE: usize = 200;
        let free = self.freeing(&[parameter])?;
        let degree = match free.entry(valence)?.sums_degree() {
            Some(degree) if degree <= MAX_DEGREE && first != last => degree,
            _ => return Ok(false),
        };
        // balancing would make sums 1 that are not
        let written = UserScheme {
            reading: Reading::Exact,
            ..self.clone()
        };
        for value in first.steps_to(last, degree.max(1) as u32) {
            let set = written.with(&[(parameter, value)])?;
            if !set.entry(valence)?.is_affine() {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether all levels are alike.
    pub fn is_stationary(&self) -> bool {
        self.contents.tension.is_none()
    }

    /// What was balanced at a valence.
    ///
    /// # Errors
    /// As [`UserScheme::exact`].
    pub fn balance(&self, valence: usize) -> Result<Balance, Error> {
        Ok(self.entry(valence)?.balance)
    }

    fn entry(&self, valence: usize) -> Result<Cow<'_, ValenceRules>, Error> {
        if let Some((_, entry)) = self.entries.iter().find(|(n, _)| *n == valence) {
            return Ok(Cow::Borrowed(entry));
        }
        if let Some(rule) = &self.contents.rule
            && (rule.first..=rule.last.unwrap_or(MAX_VALENCE)).contains(&valence)
        {
            return Ok(Cow::Owned(self.entry_of(&rule.form, valence, &mut 0)?));
        }
        if valence == 4
            && let Some(form) = self.contents.forms().next()
        {
            return Ok(Cow::Owned(self.entry_of(&form.regular(), 4, &mut 0)?));
        }
        let mut accepted: Vec<String> = self.valences().map(|n| n.to_string()).collect();
        accepted.extend(self.rule().map(|(first, last)| match last {
            Some(last) => format!("{first}..{last}"),
            None => format!("{first}..{MAX_VALENCE}"),
        }));
        Err(Error::NoSuchValence {
            scheme: self.name.clone(),
            valence,
            accepted: accepted.join(", "),
        })
    }

    fn entry_of(&self, form: &rules::Form, n: usize, terms: &mut usize) -> Result<ValenceRules, Error> {
        let entry = ValenceRules::new(&self.contents, form, n, self.reading, &self.free, terms)?;
        if let (Some(stated), Some(degree)) = (self.contents.degree, entry.degree)
            && stated != degree
        {
            return Err(file_error(format!(
                "valence n = {n}: degree = {stated} is stated, but the lines refine B-splines of degree {degree}: accepted is degree = {degree}, or none"
            )));
        }
        entry.limit.closed_rings()?;
        Ok(entry)
    }
}

impl Contents {
    /// All rules, the general ones first.
    fn forms(&self) -> impl Iterator<Item = &rules::Form> {
        let rule = self.rule.iter().map(|rule| &rule.form);
        rule.chain(self.valences.iter().map(|(_, form)| form))
    }

    /// The named weights of rules, those of the one-ring form last.
    fn definitions<'a>(&'a self, form: &'a rules::Form) -> Vec<(&'a str, &'a Formula)> {
        let names = self.names.iter().map(|(name, formula)| (name.as_str(), formula));
        match form {
            rules::Form::OneRing(weights) => names.chain(weights.each()).collect(),
            rules::Form::Passes(_) => names.collect(),
        }
    }

    /// Refuses named weights that read themselves.
    fn check_names(&self) -> Result<(), Error> {
        for form in self.forms() {
            let definitions = self.definitions(form);
            let Err((formula, fault, circle)) = rules::order(&definitions, 0..definitions.len()) else {
                continue;
            };
            let place = self.text.place(definitions[formula].1.place(&fault));
            let way: Vec<&str> = circle.into_iter().map(|index| definitions[index].0).collect();
            return Err(file_error(format!(
                "{place}{} depends on itself: {}: accepted are weights that do not",
                way[0],
                way.join(" -> ")
            )));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::families::{catmull_clark_weights, doo_sabin};

    /// The module page's examples are the tests' input.
    fn example(kind: &str) -> String {
        let page = include_str!("mod.rs");
        let block = page
            .split("//! ```toml\n")
            .skip(1)
            .map(|rest| rest.split("//! ```").next().unwrap_or_default())
            .find(|block| block.contains(&format!("kind = \"{kind}\"")))
            .expect("the page shows both kinds");
        block
            .lines()
            .map(|line| line.trim_start_matches("//!").to_owned() + "\n")
            .collect()
    }

    #[test]
    fn the_one_ring_example_is_catmull_clark_with_another_notation() {
        let scheme = UserScheme::parse(&example("one-ring"), "x", Reading::Balanced).unwrap();
        assert_eq!(scheme.name(), "mine");
        let ours = scheme.scheme::<f64>(5).unwrap();
        let reference = catmull_clark_weights::<f64>(5).scheme("reference", 5).unwrap();
        for &site in reference.limit().passes()[0].special().keys() {
            let [a, b] = [&ours, &reference].map(|scheme| {
                let mut terms = scheme.limit().stencil(0, site).unwrap().terms().to_vec();
                terms.sort_by_key(|(site, _)| *site);
                terms
            });
            for (a, b) in a.iter().zip(&b) {
                assert_eq!(a.0, b.0);
                assert!((a.1 - b.1).abs() < 1e-15);
            }
        }
        assert!(matches!(
            scheme.scheme::<f64>(6),
            Err(Error::NoSuchValence { valence: 6, .. })
        ));
    }

    #[test]
    fn the_stencils_example_is_doo_sabin_at_valence_three() {
        let scheme = UserScheme::parse(&example("stencils"), "x", Reading::Balanced)
            .unwrap()
            .scheme::<f64>(3)
            .unwrap();
        assert_eq!(
            (scheme.limit().symmetry(), scheme.degree()),
            (crate::Symmetry::Dihedral, Some(2))
        );
        let reference = doo_sabin::<f64>(3).unwrap();
        let net = crate::DenseNet {
            numbering: reference.numbering(1),
        };
        let sites = net.numbering.sites();
        let (ours, theirs) = (
            crate::refine(scheme.limit(), &net, &sites).unwrap(),
            crate::refine(reference.limit(), &net, &sites).unwrap(),
        );
        for (a, b) in ours.iter().flatten().zip(theirs.iter().flatten()) {
            assert!((a - b).abs() < 1e-15);
        }
    }

    #[test]
    fn a_lopsided_stencil_is_not_mirror_symmetric() {
        let text = example("stencils").replace("sector = -1, weight = \"1/6\"", "sector = -1, weight = \"1/12\"");
        let scheme = UserScheme::parse(&text, "x", Reading::Balanced)
            .unwrap()
            .scheme::<f64>(3)
            .unwrap();
        assert_eq!(scheme.limit().symmetry(), crate::Symmetry::Rotation);
    }

    #[test]
    fn bad_files_are_refused_with_their_place() {
        let stencils = example("stencils");
        let one_ring = example("one-ring");
        for (text, needle) in [
            (String::new(), "kind"),
            ("kind = \"two-ring\"".into(), "two-ring"),
            (one_ring.replace("f2 = 0.25", "f2 = \"1/0\""), "f2"),
            (one_ring.replace("f2 = 0.25", "f2 = nan"), "f2"),
            (one_ring.replace("f2 = 0.25", ""), "f2"),
            (one_ring.replace("f2 = 0.25", "f2 = 0.25\nf9 = 1"), "f9"),
            (one_ring.replace("n = 5", "n = 2"), "n = 2"),
            (one_ring.replace("n = 5", "n = "), "line"),
            (stencils.replace("to = \"face\"", "to = \"vertex\""), "do not lead"),
            (stencils.replace("at = [1, 1]\n", "at = [2, 1]\n"), "[2, 1]"),
            (stencils.replace("sector = -1", "sector = \"some\""), "some"),
            (stencils.replace("sector = -1", "sector = 1"), "twice"),
            (stencils.replace("degree = 2", "degree = 0"), "degree"),
            (stencils.replace("[3, \"1/4\"]", "[300, \"1/4\"]"), "300"),
        ] {
            let error = UserScheme::parse(&text, "x", Reading::Balanced)
                .map(|_| ())
                .unwrap_err()
                .to_string();
            assert!(error.contains(needle), "{needle}: {error}");
            assert!(!error.contains('\n'), "{error}");
        }
    }
}
