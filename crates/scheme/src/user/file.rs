//! The form of a scheme file: what TOML may hold, and its translation into rules.

use super::{PassRules, Rules};
use crate::{Error, Exact, Fan, Lattice, Line, Number, OneRing, RuleFault, Site, did_you_mean};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The longest text that is taken for a scheme file: a line for each of [`MAX_TERMS`] terms.
const MAX_TEXT: usize = 1 << 24;

/// The most terms of all stencils together: symmetric rules of a vertex of valence 1000 have some thousands.
const MAX_TERMS: usize = 200_000;

/// Valences beyond this are a typing error rather than a scheme: a dense local matrix would not fit into
/// memory.
const MAX_VALENCE: usize = 1000;

/// The largest degree and tap reach that are taken for meant.
const MAX_DEGREE: usize = 31;
const MAX_OFFSET: i32 = 64;

pub(super) fn file_error(message: impl Into<String>) -> Error {
    Error::SchemeFile {
        message: message.into(),
    }
}

/// What a file says.
pub(super) struct Contents {
    pub name: Option<String>,
    /// The degree of the regular surface, if it is stated.
    pub degree: Option<usize>,
    /// The rules of each valence, in the order of the file.
    pub valences: Vec<(usize, Rules)>,
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
    let mut reader = Reader { text, terms: 0 };
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
    /// Terms read so far.
    terms: usize,
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
    fn number(&self, node: &Node, what: &str) -> Result<Exact, Error> {
        let text = match node.get_ref() {
            DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str(),
            DeValue::Float(float) => float.as_str(),
            DeValue::String(text) => text,
            _ => return self.expected(node, what, "a decimal, or a fraction in quotes such as \"7/12\""),
        };
        let number: Number = text
            .parse()
            .map_err(|error| self.error(node, format!("{what}: {error}")))?;
        Ok(number.to())
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
        self.known(root, "a scheme file", &["name", "kind", "degree", "valence"])?;
        let name = match root.get("name") {
            Some(node) => Some(self.string(node, "name", "a text in quotes")?.to_owned()),
            None => None,
        };
        let degree = match root.get("degree") {
            Some(node) => Some(self.integer(node, "degree", 1, MAX_DEGREE as i64)? as usize),
            None => None,
        };
        let none = || file_error("no [[valence]] table: at least one is needed");
        let tables = root.get("valence").ok_or_else(none)?;
        let mut valences: Vec<(usize, Rules)> = Vec::new();
        for node in self.array(tables, "valence", "one or more [[valence]] tables")? {
            let keys: &[&str] = if stencils {
                &["n", "pass"]
            } else {
                &["n", "f1", "f2", "f3", "d1", "d2", "e1", "e2", "alpha", "beta"]
            };
            let table = self.table(node, "a [[valence]] table", keys)?;
            let n = self.integer(self.get(node, table, "n")?, "valence n", 3, MAX_VALENCE as i64)? as usize;
            if valences.iter().any(|(other, _)| *other == n) {
                return Err(self.error(node, format!("valence n = {n} is given twice")));
            }
            let rules = if stencils {
                Rules::Passes(self.passes(node, table, n)?)
            } else {
                Rules::OneRing(self.one_ring(node, table, n)?)
            };
            valences.push((n, rules));
        }
        if valences.is_empty() {
            return Err(none());
        }
        Ok(Contents { name, degree, valences })
    }

    fn get<'n, 'i>(&self, node: &Node, table: &'n DeTable<'i>, key: &str) -> Result<&'n Node<'i>, Error> {
        table
            .get(key)
            .ok_or_else(|| self.error(node, format!("{key} is missing")))
    }

    fn one_ring(&self, node: &Node, table: &DeTable, n: usize) -> Result<OneRing<Exact>, Error> {
        let weight = |name: &str| self.number(self.get(node, table, name)?, &format!("valence n = {n}, {name}"));
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

    fn passes(&mut self, node: &Node, table: &DeTable, n: usize) -> Result<Vec<PassRules>, Error> {
        let Some(list) = table.get("pass") else {
            return Err(self.error(node, format!("valence n = {n}: no pass is given")));
        };
        let mut passes = Vec::new();
        for node in self.array(list, "pass", "one or more [[valence.pass]] tables")? {
            let place = format!("valence n = {n}, pass {}", passes.len() + 1);
            passes.push(self.pass(node, n, &place)?);
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

    fn pass(&mut self, node: &Node, n: usize, place: &str) -> Result<PassRules, Error> {
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
            let mut taps: Vec<(i32, Exact)> = Vec::new();
            for tap in self.array(list, &what, LINE)? {
                let &[offset, weight] = self.array(tap, &what, "a tap [offset, weight]")?.as_slice() else {
                    return Err(self.error(tap, format!("{what}: accepted is a tap [offset, weight]")));
                };
                let most = i64::from(MAX_OFFSET);
                let offset = self.integer(offset, &format!("{what}, offset"), -most, most)? as i32;
                if taps.iter().any(|(known, _)| *known == offset) {
                    return Err(self.error(tap, format!("{what} has offset {offset} twice in a class")));
                }
                taps.push((offset, self.number(weight, &what)?));
            }
            line.push(taps);
        }
        if !Line::new(line.clone()).connects(from, to) {
            return Err(self.error(classes, format!("{place}: {}", RuleFault::Line { from, to })));
        }
        let mut special: Vec<(Site, Vec<(Site, Exact)>)> = Vec::new();
        for entry in table.get("special").map_or(Ok(Vec::new()), |list| {
            self.array(list, &format!("{place}, special"), "[[valence.pass.special]] tables")
        })? {
            let (site, terms) = self.special(entry, n, place, [from, to])?;
            if special.iter().any(|(known, _)| *known == site) {
                let at = [site.x, site.y];
                return Err(self.error(entry, format!("{place}: the special point at = {at:?} is given twice")));
            }
            special.push((site, terms));
        }
        Ok(PassRules {
            from,
            to,
            line,
            special,
        })
    }

    /// The sectors that a key names: one, or all.
    fn sectors(&self, node: Option<&Node>, n: usize, all: bool) -> Result<std::ops::Range<i64>, Error> {
        let most = MAX_VALENCE as i64;
        match node {
            None => Ok(0..1),
            Some(node) => match node.get_ref().as_str() {
                Some("all") if all => Ok(0..n as i64),
                Some(word) => {
                    let all = if all { " and \"all\"" } else { "" };
                    Err(self.error(node, format!("sector = \"{word}\": accepted are integers{all}")))
                }
                None => {
                    let sector = self.integer(node, "sector", -most, most)?;
                    Ok(sector..sector + 1)
                }
            },
        }
    }

    fn special(
        &mut self,
        entry: &Node,
        n: usize,
        place: &str,
        [from, to]: [Lattice; 2],
    ) -> Result<(Site, Vec<(Site, Exact)>), Error> {
        let fan = Fan::Closed(n);
        let table = self.table(entry, "a special point", &["at", "sector", "stencil"])?;
        let at = self.get(entry, table, "at")?;
        let sector = self.sectors(table.get("sector"), n, false)?;
        let target = self.site(at, fan, to, sector.start)?;
        let what = format!("{place}, stencil at = [{}, {}]", target.x, target.y);
        let mut terms: Vec<(Site, Exact)> = Vec::new();
        let mut known = std::collections::BTreeSet::new();
        let list = self.get(entry, table, "stencil")?;
        for term in self.array(list, &what, "a list of terms { at, sector, weight }")? {
            let table = self.table(term, "a term", &["at", "sector", "weight"])?;
            let at = self.get(term, table, "at")?;
            let weight = self.number(self.get(term, table, "weight")?, &what)?;
            for sector in self.sectors(table.get("sector"), n, true)? {
                let source = self.site(at, fan, from, sector)?;
                if !known.insert(source) {
                    let (x, y, sector) = (source.x, source.y, source.sector);
                    return Err(self.error(term, format!("{what} gives point [{x}, {y}] of sector {sector} twice")));
                }
                self.terms += 1;
                if self.terms > MAX_TERMS {
                    return Err(self.error(
                        term,
                        format!("more than {MAX_TERMS} terms: accepted are up to {MAX_TERMS} in all stencils together"),
                    ));
                }
                terms.push((source, weight.clone()));
            }
        }
        Ok((target, terms))
    }

    fn site(&self, node: &Node, fan: Fan, lattice: Lattice, sector: i64) -> Result<Site, Error> {
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
        let site = Site::new(fan, sector, x, y).filter(|_| on_lattice);
        site.ok_or_else(|| {
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
