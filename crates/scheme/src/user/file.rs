//! The form of a scheme file: what TOML may hold, and its translation into rules with formulas.

use super::formula::{self, Formula, Scope};
use super::parameters::Parameter;
use super::rules::{Form, PassForm, Sectors, SpecialForm, TermForm};
use crate::{Error, Lattice, Line, Number, OneRing, RuleFault, did_you_mean};
use std::collections::BTreeMap;
use std::sync::Arc;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

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

/// "line 3, column 5: ".
fn place(text: &str, offset: usize) -> String {
    let before = text.get(..offset).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    format!("line {line}, column {column}: ")
}

struct Reader<'a> {
    text: &'a str,
    /// What formulas may name.
    scope: Scope,
}

impl Reader<'_> {
    fn error(&self, node: &Node, message: impl std::fmt::Display) -> Error {
        file_error(format!("{}{message}", place(self.text, node.span().start)))
    }

    fn expected<T>(&self, node: &Node, what: &str, accepted: &str) -> Result<T, Error> {
        let found = node.get_ref().type_str();
        Err(self.error(node, format!("{what} is a {found}: accepted is {accepted}")))
    }

    fn table<'n, 'i>(&self, node: &'n Node<'i>, what: &str, keys: &[&str]) -> Result<&'n DeTable<'i>, Error> {
        match node.get_ref().as_table() {
            Some(table) => {
                self.known(table, what, keys)?;
                Ok(table)
            }
            None => self.expected(node, what, "a table"),
        }
    }

    /// Refuses keys that mean nothing.
    fn known(&self, table: &DeTable, what: &str, keys: &[&str]) -> Result<(), Error> {
        match table.keys().find(|key| !keys.contains(&key.get_ref().as_ref())) {
            None => Ok(()),
            Some(key) => Err(file_error(format!(
                "{}unknown key '{}' of {what}{}: accepted are {}",
                place(self.text, key.span().start),
                key.get_ref(),
                did_you_mean(key.get_ref(), keys.iter().copied()),
                keys.join(", ")
            ))),
        }
    }

    fn array<'n, 'i>(&self, node: &'n Node<'i>, what: &str, accepted: &str) -> Result<Vec<&'n Node<'i>>, Error> {
        match node.get_ref().as_array() {
            Some(array) => Ok(array.iter().collect()),
            None => self.expected(node, what, accepted),
        }
    }

    fn string<'n>(&self, node: &'n Node, what: &str, accepted: &str) -> Result<&'n str, Error> {
        match node.get_ref().as_str() {
            Some(text) => Ok(text),
            None => self.expected(node, what, accepted),
        }
    }

    /// An integer from `least` to `most`.
    fn integer(&self, node: &Node, what: &str, least: i64, most: i64) -> Result<i64, Error> {
        let accepted = format!("an integer from {least} to {most}");
        let Some(integer) = node.get_ref().as_integer() else {
            return self.expected(node, what, &accepted);
        };
        let value = i64::from_str_radix(integer.as_str(), integer.radix()).ok();
        match value.filter(|value| (least..=most).contains(value)) {
            Some(value) => Ok(value),
            None => Err(self.error(
                node,
                format!("{what} = {integer} is out of range: accepted is {accepted}"),
            )),
        }
    }

    /// A number as it is written, with or without quotes.
    fn number(&self, node: &Node, what: &str) -> Result<Number, Error> {
        let text = match node.get_ref() {
            DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str(),
            DeValue::Float(float) => float.as_str(),
            DeValue::String(text) => text,
            _ => return self.expected(node, what, "a decimal, or a fraction in quotes such as \"7/12\""),
        };
        text.parse()
            .map_err(|error| self.error(node, format!("{what}: {error}")))
    }

    /// A number, or in quotes a formula, which may name `k` if `sector` says so.
    fn formula(&self, node: &Node, what: &str, sector: bool) -> Result<Formula, Error> {
        let DeValue::String(text) = node.get_ref() else {
            const ACCEPTED: &str = "a decimal, or a fraction or formula in quotes such as \"7/12\" or \"1/(4*n)\"";
            return match node.get_ref() {
                DeValue::Integer(_) | DeValue::Float(_) => {
                    let number = self.number(node, what)?;
                    Ok(Formula::number(number.rational().clone(), node.span().start))
                }
                _ => self.expected(node, what, ACCEPTED),
            };
        };
        if let Ok(number) = text.parse::<Number>() {
            return Ok(Formula::number(number.rational().clone(), node.span().start));
        }
        let span = node.span();
        // without escapes the text stands in the file as it is
        let written = self.text.get(span.clone()).and_then(|raw| raw.find(text.as_ref()));
        let mut formula = Formula {
            start: span.start + written.unwrap_or(0),
            literal: written.is_some(),
            ..Formula::number(Default::default(), 0)
        };
        let scope = Scope {
            sector,
            ..self.scope.clone()
        };
        match formula::parse(text, &scope) {
            Ok(root) => formula.root = root,
            Err(fault) => {
                let place = place(self.text, formula.place(&fault));
                return Err(file_error(format!("{place}{what}: {}", fault.message)));
            }
        }
        Ok(formula)
    }

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
            let table = self.table(node, &what, &["default", "range", "doc"])?;
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
            let parameter = Parameter {
                name,
                value: default.clone(),
                default,
                range,
                doc,
            };
            parameter
                .check(parameter.default.clone())
                .map_err(|error| self.error(node, error))?;
            found.push(parameter);
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

    fn get<'n, 'i>(&self, node: &Node, table: &'n DeTable<'i>, key: &str) -> Result<&'n Node<'i>, Error> {
        table
            .get(key)
            .ok_or_else(|| self.error(node, format!("{key} is missing")))
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

    fn passes(&self, node: &Node, table: &DeTable, what: &str, path: &str) -> Result<Vec<PassForm>, Error> {
        let Some(list) = table.get("pass") else {
            return Err(self.error(node, format!("{what}: no pass is given")));
        };
        let mut passes = Vec::new();
        for node in self.array(list, "pass", &format!("one or more [[{path}.pass]] tables"))? {
            let place = format!("{what}, pass {}", passes.len() + 1);
            passes.push(self.pass(node, &place, path)?);
        }
        Ok(passes)
    }

    fn lattice(&self, node: &Node, what: &str) -> Result<Lattice, Error> {
        const NETS: &str = "\"vertex\" and \"face\"";
        let found = self.string(node, what, NETS)?;
        let known = [Lattice::Vertex, Lattice::Face]
            .into_iter()
            .find(|net| net.name() == found);
        known.ok_or_else(|| self.error(node, format!("{what} = \"{found}\": accepted are {NETS}")))
    }

    fn pass(&self, node: &Node, place: &str, path: &str) -> Result<PassForm, Error> {
        let table = self.table(node, "a pass", &["from", "to", "line", "special"])?;
        let from = self.lattice(self.get(node, table, "from")?, &format!("{place}, from"))?;
        let to = self.lattice(self.get(node, table, "to")?, &format!("{place}, to"))?;
        let what = format!("{place}, line");
        const LINE: &str = "one list of taps [offset, weight] for each class, one or two classes";
        let classes = self.get(node, table, "line")?;
        let lists = self.array(classes, &what, LINE)?;
        if !(1..=2).contains(&lists.len()) {
            let count = lists.len();
            return Err(self.error(
                classes,
                format!("{what} has {count} classes of taps: accepted are 1 and 2"),
            ));
        }
        let mut line = Vec::new();
        for list in lists {
            let mut taps: Vec<(i32, Formula)> = Vec::new();
            for tap in self.array(list, &what, LINE)? {
                let &[offset, weight] = self.array(tap, &what, "a tap [offset, weight]")?.as_slice() else {
                    return Err(self.error(tap, format!("{what}: accepted is a tap [offset, weight]")));
                };
                let most = i64::from(MAX_OFFSET);
                let offset = self.integer(offset, &format!("{what}, offset"), -most, most)? as i32;
                if taps.iter().any(|(known, _)| *known == offset) {
                    return Err(self.error(tap, format!("{what} has offset {offset} twice in a class")));
                }
                taps.push((offset, self.formula(weight, &what, false)?));
            }
            line.push(taps);
        }
        let offsets = |taps: &Vec<(i32, Formula)>| taps.iter().map(|(offset, _)| (*offset, ())).collect();
        if !Line::new(line.iter().map(offsets).collect()).connects(from, to) {
            return Err(self.error(classes, format!("{place}: {}", RuleFault::Line { from, to })));
        }
        let list = table.get("special").map_or(Ok(Vec::new()), |list| {
            self.array(
                list,
                &format!("{place}, special"),
                &format!("[[{path}.pass.special]] tables"),
            )
        })?;
        let special = list.into_iter().map(|entry| self.special(entry, place, [from, to]));
        Ok(PassForm {
            from,
            to,
            line,
            special: special.collect::<Result<_, _>>()?,
        })
    }

    /// The sector that a key names; `words` are accepted beside numbers.
    fn sector<'n>(&self, node: Option<&'n Node>, words: &[&'n str]) -> Result<Result<i64, &'n str>, Error> {
        let most = MAX_VALENCE as i64;
        let Some(node) = node else { return Ok(Ok(0)) };
        match node.get_ref().as_str() {
            Some(word) if words.contains(&word) => Ok(Err(word)),
            Some(word) => {
                let words: String = words.iter().map(|word| format!(" and \"{word}\"")).collect();
                Err(self.error(node, format!("sector = \"{word}\": accepted are integers{words}")))
            }
            None => Ok(Ok(self.integer(node, "sector", -most, most)?)),
        }
    }

    fn special(&self, entry: &Node, place: &str, [from, to]: [Lattice; 2]) -> Result<SpecialForm, Error> {
        let table = self.table(entry, "a special point", &["at", "sector", "stencil"])?;
        let node = self.get(entry, table, "at")?;
        let sector = self.sector(table.get("sector"), &[])?.unwrap_or(0);
        let at = self.site(node, to)?;
        let what = format!("{place}, stencil at = [{}, {}]", at[0], at[1]);
        let list = self.get(entry, table, "stencil")?;
        let list = self.array(list, &what, "a list of terms { at, sector, weight }")?;
        let terms = list.into_iter().map(|term| self.term(term, &what, from));
        Ok(SpecialForm {
            start: entry.span().start,
            at,
            sector,
            terms: terms.collect::<Result<_, _>>()?,
        })
    }

    fn term(&self, term: &Node, what: &str, from: Lattice) -> Result<TermForm, Error> {
        let table = self.table(term, "a term", &["at", "sector", "weight", "except"])?;
        let at = self.site(self.get(term, table, "at")?, from)?;
        let weight = self.get(term, table, "weight")?;
        let sector = self.sector(table.get("sector"), &["all", "k"])?;
        let each = sector == Err("k");
        let weight = self.formula(weight, what, each)?;
        if let Some(node) = table.get("except").filter(|_| !each) {
            return Err(self.error(node, format!("{what}, except: accepted beside sector = \"k\"")));
        }
        let weights = match sector {
            Ok(sector) => Sectors::One(sector, weight),
            Err("all") => Sectors::All(weight),
            Err(_) => Sectors::Each {
                weight,
                except: match table.get("except") {
                    Some(node) => self.except(node, what)?,
                    None => BTreeMap::new(),
                },
            },
        };
        Ok(TermForm {
            start: term.span().start,
            at,
            weights,
        })
    }

    /// Sectors with weights of their own.
    fn except(&self, node: &Node, what: &str) -> Result<BTreeMap<i64, Formula>, Error> {
        const SECTORS: &str = "a table of sectors with their weights, such as { \"0\" = \"1/2\" }";
        let Some(table) = node.get_ref().as_table() else {
            return self.expected(node, &format!("{what}, except"), SECTORS);
        };
        let most = MAX_VALENCE as i64;
        let mut found = BTreeMap::new();
        for (key, node) in table {
            let sector = key.get_ref().parse::<i64>().ok().filter(|k| (-most..=most).contains(k));
            let Some(sector) = sector else {
                let place = place(self.text, key.span().start);
                let key = key.get_ref();
                return Err(file_error(format!(
                    "{place}{what}, except: sector \"{key}\": accepted is {SECTORS}"
                )));
            };
            found.insert(sector, self.formula(node, &format!("{what}, except"), true)?);
        }
        Ok(found)
    }

    fn site(&self, node: &Node, lattice: Lattice) -> Result<[i32; 2], Error> {
        const PAIR: &str = "a pair of half steps [x, y]: [2, 0] is the next vertex on the spoke, [1, 1] the next face";
        let &[x, y] = self.array(node, "at", PAIR)?.as_slice() else {
            return Err(self.error(node, format!("at: accepted is {PAIR}")));
        };
        let bound = i64::from(MAX_OFFSET);
        let (x, y) = (
            self.integer(x, "at", -bound, bound)? as i32,
            self.integer(y, "at", -bound, bound)? as i32,
        );
        let parity = lattice.parity();
        let canonical = (x, y) == (0, 0) || (x > 0 && y >= 0);
        let on_lattice = canonical && x.rem_euclid(2) == parity && y.rem_euclid(2) == parity;
        on_lattice.then_some([x, y]).ok_or_else(|| {
            let (numbers, centre) = if parity == 0 { ("even", ", and [0, 0]") } else { ("odd", "") };
            let name = lattice.name();
            self.error(
                node,
                format!(
                    "at = [{x}, {y}] is not a point of the {name} net: accepted are {numbers} half steps with 0 < x <= {bound}, 0 <= y <= {bound}{centre}; [2, 0] is one edge, [1, 1] the middle of the next face"
                ),
            )
        })
    }
}
