//! The passes of a scheme file: lines, special stencils and their terms.

use super::values::place;
use super::{MAX_OFFSET, MAX_VALENCE, Node, Reader, file_error};
use crate::user::formula::Formula;
use crate::user::rules::{PassForm, Sectors, SpecialForm, TermForm};
use crate::{Error, Lattice, Line, RuleFault};
use std::collections::BTreeMap;
use toml::de::DeTable;

impl Reader<'_> {
    pub(super) fn passes(&self, node: &Node, table: &DeTable, what: &str, path: &str) -> Result<Vec<PassForm>, Error> {
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

    pub(super) fn lattice(&self, node: &Node, what: &str) -> Result<Lattice, Error> {
        const NETS: &str = "\"vertex\" and \"face\"";
        let found = self.string(node, what, NETS)?;
        let known = [Lattice::Vertex, Lattice::Face]
            .into_iter()
            .find(|net| net.name() == found);
        known.ok_or_else(|| self.error(node, format!("{what} = \"{found}\": accepted are {NETS}")))
    }

    pub(super) fn pass(&self, node: &Node, place: &str, path: &str) -> Result<PassForm, Error> {
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
    pub(super) fn sector<'n>(&self, node: Option<&'n Node>, words: &[&'n str]) -> Result<Result<i64, &'n str>, Error> {
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

    pub(super) fn special(&self, entry: &Node, place: &str, [from, to]: [Lattice; 2]) -> Result<SpecialForm, Error> {
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

    pub(super) fn term(&self, term: &Node, what: &str, from: Lattice) -> Result<TermForm, Error> {
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
    pub(super) fn except(&self, node: &Node, what: &str) -> Result<BTreeMap<i64, Formula>, Error> {
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

    pub(super) fn site(&self, node: &Node, lattice: Lattice) -> Result<[i32; 2], Error> {
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
