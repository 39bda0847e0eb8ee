//! The form of a scheme file: what TOML may hold, and its translation into rules.

use super::{PassRules, Rules};
use crate::{Error, Fan, Lattice, Line, Number, OneRing, Site};
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
enum File {
    OneRing {
        name: Option<String>,
        valence: Vec<OneRingTable>,
    },
    Stencils {
        name: Option<String>,
        degree: usize,
        valence: Vec<PassesTable>,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OneRingTable {
    n: usize,
    f1: Text,
    f2: Text,
    f3: Text,
    d1: Text,
    d2: Text,
    e1: Text,
    e2: Text,
    alpha: Text,
    beta: Text,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PassesTable {
    n: usize,
    pass: Vec<PassTable>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PassTable {
    from: LatticeName,
    to: LatticeName,
    line: Vec<Vec<(i32, Text)>>,
    #[serde(default)]
    special: Vec<SpecialTable>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SpecialTable {
    at: (i32, i32),
    #[serde(default)]
    sector: i64,
    stencil: Vec<TermTable>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TermTable {
    at: (i32, i32),
    #[serde(default)]
    sector: SectorName,
    weight: Text,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum LatticeName {
    Vertex,
    Face,
}

impl From<LatticeName> for Lattice {
    fn from(name: LatticeName) -> Lattice {
        match name {
            LatticeName::Vertex => Lattice::Vertex,
            LatticeName::Face => Lattice::Face,
        }
    }
}

#[derive(Deserialize)]
#[serde(untagged)]
enum SectorName {
    Index(i64),
    Word(String),
}

impl Default for SectorName {
    fn default() -> Self {
        SectorName::Index(0)
    }
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Text {
    Integer(i64),
    Decimal(f64),
    Written(String),
}

impl Text {
    fn number(&self, place: impl FnOnce() -> String) -> Result<Number, Error> {
        let number = match self {
            Text::Integer(i) => i.to_string().parse(),
            Text::Decimal(x) => Number::from_decimal(*x),
            Text::Written(text) => text.parse(),
        };
        number.map_err(|error| file_error(format!("{}: {error}", place())))
    }
}

pub(super) fn file_error(message: impl Into<String>) -> Error {
    Error::SchemeFile {
        message: message.into(),
    }
}

/// The name, if there is one, and the rules of each valence.
type Contents = (Option<String>, Vec<(usize, Rules)>);

/// Reads the text of a file and checks its form.
pub(super) fn read(text: &str) -> Result<Contents, Error> {
    let file: File = toml::from_str(text).map_err(|error| {
        let line = error.span().map(|span| text[..span.start].matches('\n').count() + 1);
        let place = line.map_or(String::new(), |line| format!("line {line}: "));
        // one line, whatever the parser says
        let message = error.message().split_whitespace().collect::<Vec<_>>().join(" ");
        file_error(format!("{place}{message}"))
    })?;
    let (name, valences) = match file {
        File::OneRing { name, valence } => (
            name,
            valence
                .iter()
                .map(|table| Ok((table.n, Rules::OneRing(one_ring(table)?))))
                .collect::<Result<Vec<_>, Error>>()?,
        ),
        File::Stencils { name, degree, valence } => (
            name,
            valence
                .iter()
                .map(|table| {
                    let passes = passes(table, degree)?;
                    Ok((table.n, Rules::Passes { degree, passes }))
                })
                .collect::<Result<Vec<_>, Error>>()?,
        ),
    };
    if valences.is_empty() {
        return Err(file_error("no [[valence]] table: at least one is needed"));
    }
    for (index, (n, _)) in valences.iter().enumerate() {
        check_valence(*n)?;
        if valences[..index].iter().any(|(other, _)| other == n) {
            return Err(file_error(format!("valence n = {n} is given twice")));
        }
    }
    Ok((name, valences))
}

/// Valences beyond this are a typing error rather than a scheme: a dense local matrix would not fit into memory.
const MAX_VALENCE: usize = 1000;

fn check_valence(n: usize) -> Result<(), Error> {
    if (3..=MAX_VALENCE).contains(&n) {
        return Ok(());
    }
    Err(file_error(format!(
        "valence n = {n} is out of range: accepted are 3 to {MAX_VALENCE}"
    )))
}

fn one_ring(table: &OneRingTable) -> Result<OneRing<Number>, Error> {
    let n = table.n;
    let weight = |name: &str, text: &Text| text.number(|| format!("valence n = {n}, {name}"));
    Ok(OneRing {
        f1: weight("f1", &table.f1)?,
        f2: weight("f2", &table.f2)?,
        f3: weight("f3", &table.f3)?,
        d1: weight("d1", &table.d1)?,
        d2: weight("d2", &table.d2)?,
        e1: weight("e1", &table.e1)?,
        e2: weight("e2", &table.e2)?,
        alpha: weight("alpha", &table.alpha)?,
        beta: weight("beta", &table.beta)?,
    })
}

/// The largest degree and tap reach that are taken for meant.
const MAX_DEGREE: usize = 31;
const MAX_OFFSET: i32 = 64;

fn passes(table: &PassesTable, degree: usize) -> Result<Vec<PassRules>, Error> {
    let n = table.n;
    check_valence(n)?;
    if !(1..=MAX_DEGREE).contains(&degree) {
        return Err(file_error(format!(
            "degree = {degree} is out of range: accepted are 1 to {MAX_DEGREE}"
        )));
    }
    let passes = table
        .pass
        .iter()
        .enumerate()
        .map(|(index, pass)| {
            let place = format!("valence n = {n}, pass {}", index + 1);
            pass_rules(n, pass).map_err(|error| match error {
                Error::SchemeFile { message } => file_error(format!("{place}: {message}")),
                other => other,
            })
        })
        .collect::<Result<Vec<_>, Error>>()?;
    let (Some(first), Some(last)) = (passes.first(), passes.last()) else {
        return Err(file_error(format!("valence n = {n}: no pass is given")));
    };
    if passes.windows(2).any(|pair| pair[0].to != pair[1].from) || first.from != last.to {
        return Err(file_error(format!(
            "valence n = {n}: each pass must read the kind of net that the pass before makes, and the last make the kind that the first reads"
        )));
    }
    let scale: usize = passes.iter().map(|pass| pass.line.len()).product();
    if scale != 2 {
        return Err(file_error(format!(
            "valence n = {n}: the passes refine {scale}-fold; accepted is 2 (one pass with two classes of taps, the others with one)"
        )));
    }
    Ok(passes)
}

fn pass_rules(n: usize, table: &PassTable) -> Result<PassRules, Error> {
    let fan = Fan::Closed(n);
    let (from, to) = (table.from.into(), table.to.into());
    if !(1..=2).contains(&table.line.len()) {
        return Err(file_error(format!(
            "line has {} classes of taps: accepted are 1 and 2",
            table.line.len()
        )));
    }
    let mut line = Vec::new();
    for class in &table.line {
        let mut taps = Vec::new();
        for (offset, weight) in class {
            if offset.abs() > MAX_OFFSET {
                return Err(file_error(format!(
                    "line: offset {offset} is out of range: accepted are -{MAX_OFFSET} to {MAX_OFFSET}"
                )));
            }
            taps.push((*offset, weight.number(|| "line".to_owned())?));
        }
        line.push(taps);
    }
    let probe = Line::new(
        line.iter()
            .map(|taps| taps.iter().map(|&(o, w)| (o, w.value())).collect())
            .collect(),
    );
    if !probe.connects(from, to) {
        return Err(file_error(format!(
            "line: the offsets do not lead from the {from:?} net to the {to:?} net"
        )));
    }
    let site = |lattice: Lattice, sector: i64, (x, y): (i32, i32)| {
        let parity = lattice.parity();
        let canonical = (x, y) == (0, 0) || (x > 0 && y >= 0);
        if !canonical || x.rem_euclid(2) != parity || y.rem_euclid(2) != parity || x.max(y) > MAX_OFFSET {
            return Err(file_error(format!(
                "at = [{x}, {y}] is not a point of the {lattice:?} net: accepted are {} coordinates with 0 < x <= {MAX_OFFSET}, 0 <= y <= {MAX_OFFSET}{}",
                if parity == 0 { "even" } else { "odd" },
                if parity == 0 { ", and [0, 0]" } else { "" },
            )));
        }
        Site::new(fan, sector, x, y).ok_or_else(|| file_error(format!("at = [{x}, {y}] is not a point of the fan")))
    };
    let mut special: Vec<(Site, Vec<(Site, Number)>)> = Vec::new();
    for entry in &table.special {
        let target = site(to, entry.sector, entry.at)?;
        if special.iter().any(|(known, _)| *known == target) {
            return Err(file_error(format!(
                "the special point at = {:?} is given twice",
                entry.at
            )));
        }
        let mut terms: Vec<(Site, Number)> = Vec::new();
        for term in &entry.stencil {
            let weight = term.weight.number(|| format!("stencil at = {:?}", entry.at))?;
            let sectors = match &term.sector {
                SectorName::Index(sector) => *sector..*sector + 1,
                SectorName::Word(word) if word == "all" => 0..n as i64,
                SectorName::Word(word) => {
                    return Err(file_error(format!(
                        "sector = \"{word}\": accepted are integers and \"all\""
                    )));
                }
            };
            for sector in sectors {
                let source = site(from, sector, term.at)?;
                if terms.iter().any(|(known, _)| *known == source) {
                    return Err(file_error(format!(
                        "stencil at = {:?} gives point {:?} of sector {} twice",
                        entry.at, term.at, source.sector
                    )));
                }
                terms.push((source, weight));
            }
        }
        special.push((target, terms));
    }
    Ok(PassRules {
        from,
        to,
        line,
        special,
    })
}
