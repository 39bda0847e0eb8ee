//! The form of a scheme file: what TOML may hold, and its translation into rules with formulas.

mod passes;
mod values;

use super::formula::{self, Formula, Scope};
use super::parameters::Parameter;
use super::rules::Form;
use crate::{Error, Number, OneRing};
use std::collections::BTreeMap;
use std::sync::Arc;
use toml::Spanned;
use toml::de::{DeTable, DeValue};
use values::place;

/// The longest text that is taken for a scheme file: a line for each of the most terms.
const MAX_TEXT: usize = 1 << 24;

/// Valences beyond this are a typing error rather than a scheme: a dense local matrix would not fit into
/// memory.
pub(super) const MAX_VALENCE: usize = 1000;

/// The largest degree and tap reach that are taken for meant.
const MAX_DEGREE: usize = 31;
const MAX_OFFSET: i32 = 64;

/// The most parameters, and the most named weights.
const MAX_NAMES: usize = 1000;

/// The weights of the one-ring form.
const ONE_RING: [&str; 9] = ["f1", "f2", "f3", "d1", "d2", "e1", "e2", "alpha", "beta"];

pub(super) fn file_error(message: impl Into<String>) -> Error {
    Error::SchemeFile {
        message: message.into(),
    }
}

/// The text of a file, for saying where something is.
#[derive(Clone, Debug)]
pub(super) struct SchemeText(Arc<str>);

impl SchemeText {
    /// "line 3, column 5: ".
    pub(super) fn place(&self, offset: usize) -> String {
        place(&self.0, offset)
    }

    /// All of it.
    pub(super) fn whole(&self) -> &str {
        &self.0
    }
}

/// What a file says.
#[derive(Clone, Debug)]
pub(super) struct Contents {
    pub text: SchemeText,
    pub name: Option<String>,
    /// The degree of the regular surface, if it is stated.
    pub degree: Option<usize>,
    /// Whether the crease rule of the degree is declared.
    pub creases: bool,
    pub parameters: Vec<Parameter>,
    /// The tension of the first refinement.
    pub tension: Option<Formula>,
    /// Named weights.
    pub names: Vec<(String, Formula)>,
    /// The rules of all valences in a range that are not listed.
    pub rule: Option<Rule>,
    /// The rules of single valences, in the order of the file.
    pub valences: Vec<(usize, Form)>,
}

/// Rules for a range of valences, the last one included.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    pub first: usize,
    pub last: Option<usize>,
    pub form: Form,
}

/// A value with its place in the text.
type Node<'a> = Spanned<DeValue<'a>>;

/// Reads the text of a file and checks its form.
pub(super) fn read(text: &str) -> Result<Contents, Error> {
    if text.len() > MAX_TEXT {
        return Err(file_error(format!(
            "the text has {} bytes: accepted are up to {MAX_TEXT}",
            text.len()
        )));
    }
    // a byte order mark is no part of the text
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let root = DeTable::parse(text).map_err(|error| {
        let place = error.span().map_or(String::new(), |span| place(text, span.start));
        // one line, whatever the parser says
        let message = error.message().split_whitespace().collect::<Vec<_>>().join(" ");
        file_error(format!("{place}{message}"))
    })?;
    let mut reader = Reader {
        text,
        scope: Scope::default(),
    };
    reader.file(root.get_ref())
}

struct Reader<'a> {
    text: &'a str,
    /// What formulas may name.
    scope: Scope,
}

impl Reader<'_> {
    fn file(&mut self, root: &DeTable) -> Result<Contents, Error> {
        const KINDS: &str = "\"one-ring\" and \"stencils\"";
        let Some(kind) = root.get("kind") else {
            return Err(file_error(format!("no kind is given: accepted are kind = {KINDS}")));
        };
        let stencils = match self.string(kind, "kind", KINDS)? {
            "one-ring" => false,
            "stencils" => true,
            other => return Err(self.error(kind, format!("kind = \"{other}\": accepted are {KINDS}"))),
        };
        let keys = [
            "name",
            "kind",
            "degree",
            "features",
            "parameters",
            "tension",
            "names",
            "rule",
            "valence",
        ];
        self.known(root, "a scheme file", &keys)?;
        let name = match root.get("name") {
            Some(node) => Some(self.string(node, "name", "a text in quotes")?.to_owned()),
            None => None,
        };
        let degree = match root.get("degree") {
            Some(node) => Some(self.integer(node, "degree", 1, MAX_DEGREE as i64)? as usize),
            None => None,
        };
        let creases = match root.get("features") {
            Some(node) => match self.string(node, "features", "\"crease\"")? {
                "crease" => true,
                other => return Err(self.error(node, format!("features = \"{other}\": accepted is \"crease\""))),
            },
            None => false,
        };
        let parameters = match root.get("parameters") {
            Some(node) => self.parameters(node, stencils)?,
            None => Vec::new(),
        };
        self.scope.parameters = parameters.iter().map(|parameter| parameter.name.clone()).collect();
        let tension = match root.get("tension") {
            Some(node) => Some(self.formula(node, "tension", false)?),
            None => None,
        };
        self.scope.tension = tension.is_some();
        let names = match root.get("names") {
            Some(node) => self.names(node, stencils)?,
            None => Vec::new(),
        };
        if names.is_empty() && !stencils {
            self.scope.names = ONE_RING.map(str::to_owned).to_vec();
        }
        let rule = match root.get("rule") {
            Some(node) => Some(self.rule(node, stencils)?),
            None => None,
        };
        let valences = match root.get("valence") {
            Some(node) => self.valences(node, stencils)?,
            None => Vec::new(),
        };
        if rule.is_none() && valences.is_empty() {
            return Err(file_error("no [rule] and no [[valence]] table: at least one is needed"));
        }
        Ok(Contents {
            text: SchemeText(self.text.into()),
            name,
            degree,
            creases,
            parameters,
            tension,
            names,
            rule,
            valences,
        })
    }

    /// A word that formulas can use as a name of their own.
    fn word(&self, key: &Spanned<std::borrow::Cow<'_, str>>, stencils: bool) -> Result<String, Error> {
        let word = key.get_ref().as_ref();
        let letters = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let form = word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') && word.chars().all(letters);
        let taken = formula::RESERVED.contains(&word)
            || self.scope.parameters.iter().any(|known| known == word)
            || !stencils && ONE_RING.contains(&word);
        if form && !taken {
            return Ok(word.to_owned());
        }
        let place = place(self.text, key.span().start);
        let why = if taken { "has a meaning already" } else { "is no name" };
        Err(file_error(format!(
            "{place}'{word}' {why}: accepted are letters, digits and _, other than {} and the names of weights and parameters",
            formula::RESERVED.join(", ")
        )))
    }

    fn bounded(&self, node: &Node, count: usize, what: &str) -> Result<(), Error> {
        match count > MAX_NAMES {
            true => Err(self.error(node, format!("{count} {what}: accepted are up to {MAX_NAMES}"))),
            false => Ok(()),
        }
    }

    fn parameters(&self, node: &Node, stencils: bool) -> Result<Vec<Parameter>, Error> {
        let Some(table) = node.get_ref().as_table() else {
            return self.expected(node, "parameters", "a [parameters] table");
        };
        self.bounded(node, table.len(), "parameters")?;
        let mut found = Vec::new();
        // in the order of the file
        let mut entries: Vec<_> = table.iter().collect();
        entries.sort_by_key(|(key, _)| key.span().start);
        for (key, node) in entries {
            let name = self.word(key, stencils)?;
            let what = format!("parameter {name}");
            let table = self.table(node, &what, &["default", "range", "doc", "except"])?;
            let default = self.number(self.get(node, table, "default")?, &format!("{what}, default"))?;
            let doc = match table.get("doc") {
                Some(node) => self
                    .string(node, &format!("{what}, doc"), "a text in quotes")?
                    .to_owned(),
                None => String::new(),
            };
            let range = match table.get("range") {
                None => None,
                Some(node) => {
                    const ENDS: &str = "a pair [least, most] of numbers";
                    let &[least, most] = self.array(node, &format!("{what}, range"), ENDS)?.as_slice() else {
                        return Err(self.error(node, format!("{what}, range: accepted is {ENDS}")));
                    };
                    let end = |node: &Node| self.number(node, &format!("{what}, range"));
                    let (least, most) = (end(least)?, end(most)?);
                    if least.rational() > most.rational() {
                        return Err(self.error(
                            node,
                            format!("{what}, range: {least} is above {most}: accepted is {ENDS}"),
                        ));
                    }
                    Some([least, most])
                }
            };
            let except = match table.get("except") {
                Some(node) => self.exceptions(node, &what)?,
                None => BTreeMap::new(),
            };
            let parameter = Parameter {
                name,
                default,
                except,
                range,
                doc,
                set: None,
            };
            for value in std::iter::once(&parameter.default).chain(parameter.except.values()) {
                parameter
                    .check(value.clone())
                    .map_err(|error| self.error(node, error))?;
            }
            found.push(parameter);
        }
        Ok(found)
    }

    /// The values of a parameter at single valences.
    fn exceptions(&self, node: &Node, what: &str) -> Result<BTreeMap<usize, Number>, Error> {
        const VALENCES: &str = "a table of valences with their values, such as { \"5\" = \"0.26\" }";
        let Some(table) = node.get_ref().as_table() else {
            return self.expected(node, &format!("{what}, except"), VALENCES);
        };
        let mut found = BTreeMap::new();
        for (key, node) in table {
            let valence = key.get_ref().parse::<usize>().ok();
            let Some(valence) = valence.filter(|n| (3..=MAX_VALENCE).contains(n)) else {
                let (place, key) = (place(self.text, key.span().start), key.get_ref());
                return Err(file_error(format!(
                    "{place}{what}, except: valence \"{key}\": accepted is {VALENCES}, from 3 to {MAX_VALENCE}"
                )));
            };
            found.insert(valence, self.number(node, &format!("{what}, except \"{valence}\""))?);
        }
        Ok(found)
    }

    fn names(&mut self, node: &Node, stencils: bool) -> Result<Vec<(String, Formula)>, Error> {
        let Some(table) = node.get_ref().as_table() else {
            return self.expected(node, "names", "a [names] table");
        };
        self.bounded(node, table.len(), "names")?;
        let mut entries: Vec<_> = table.iter().collect();
        entries.sort_by_key(|(key, _)| key.span().start);
        let mut names = Vec::new();
        for (key, _) in &entries {
            names.push(self.word(key, stencils)?);
        }
        self.scope.names = names.clone();
        if !stencils {
            self.scope.names.extend(ONE_RING.map(str::to_owned));
        }
        let formulas = entries.iter().zip(names);
        formulas
            .map(|((_, node), name)| Ok((name.clone(), self.formula(node, &name, false)?)))
            .collect()
    }

    fn form(&self, node: &Node, table: &DeTable, stencils: bool, what: &str, path: &str) -> Result<Form, Error> {
        if stencils {
            Ok(Form::Passes(self.passes(node, table, what, path)?))
        } else {
            Ok(Form::OneRing(Box::new(self.one_ring(node, table, what)?)))
        }
    }

    fn keys(stencils: bool) -> Vec<&'static str> {
        let own: &[&str] = if stencils { &["pass"] } else { &ONE_RING };
        std::iter::once("n").chain(own.iter().copied()).collect()
    }

    fn rule(&self, node: &Node, stencils: bool) -> Result<Rule, Error> {
        let table = self.table(node, "the [rule] table", &Self::keys(stencils))?;
        const RANGE: &str = "a range in quotes such as \"3..\" or \"5..12\"";
        let (first, last) = match table.get("n") {
            None => (3, None),
            Some(node) => {
                let text = self.string(node, "rule, n", RANGE)?;
                let refuse = || {
                    self.error(
                        node,
                        format!("rule, n = \"{text}\": accepted is {RANGE}, from 3 to {MAX_VALENCE}"),
                    )
                };
                let end = |text: &str| {
                    let value = text.trim().parse::<usize>().ok();
                    value.filter(|n| (3..=MAX_VALENCE).contains(n)).ok_or_else(refuse)
                };
                match text.split_once("..") {
                    Some((first, "")) => (end(first)?, None),
                    Some((first, last)) => (end(first)?, Some(end(last)?)),
                    None => (end(text)?, Some(end(text)?)),
                }
            }
        };
        if last.is_some_and(|last| last < first) {
            return Err(self.error(node, format!("rule, n: the range is empty: accepted is {RANGE}")));
        }
        let form = self.form(node, table, stencils, "rule", "rule")?;
        Ok(Rule { first, last, form })
    }

    fn valences(&self, node: &Node, stencils: bool) -> Result<Vec<(usize, Form)>, Error> {
        let mut valences: Vec<(usize, Form)> = Vec::new();
        for node in self.array(node, "valence", "one or more [[valence]] tables")? {
            let table = self.table(node, "a [[valence]] table", &Self::keys(stencils))?;
            let n = self.integer(self.get(node, table, "n")?, "valence n", 3, MAX_VALENCE as i64)? as usize;
            if valences.iter().any(|(other, _)| *other == n) {
                return Err(self.error(node, format!("valence n = {n} is given twice")));
            }
            let form = self.form(node, table, stencils, &format!("valence n = {n}"), "valence")?;
            valences.push((n, form));
        }
        Ok(valences)
    }

    fn one_ring(&self, node: &Node, table: &DeTable, what: &str) -> Result<OneRing<Formula>, Error> {
        let weight = |name: &str| self.formula(self.get(node, table, name)?, &format!("{what}, {name}"), false);
        Ok(OneRing {
            f1: weight("f1")?,
            f2: weight("f2")?,
            f3: weight("f3")?,
            d1: weight("d1")?,
            d2: weight("d2")?,
            e1: weight("e1")?,
            e2: weight("e2")?,
            alpha: weight("alpha")?,
            beta: weight("beta")?,
        })
    }
}
