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
//! `kind = "stencils"` describes any passes around a vertex or a face; all positions are half steps (see [`Site`]):
//!
//! ```toml
//! kind = "stencils"
//! name = "doo-sabin-like"
//! degree = 2                       # of the regular surface
//!
//! [[valence]]
//! n = 3
//!
//! [[valence.pass]]                 # passes in order; the refined net must be of the kind that is read first
//! from = "face"
//! to = "face"
//! # one class of taps per target point and source point: [offset, weight], the target X reads (X + offset) / classes
//! line = [[[1, "3/4"], [-3, "1/4"]], [[-1, "3/4"], [3, "1/4"]]]
//!
//! [[valence.pass.special]]         # a point with a stencil of its own, in sector 0 unless `sector` says otherwise
//! at = [1, 1]
//! stencil = [
//!     { at = [1, 1], weight = "2/3" },
//!     { at = [1, 1], sector = 1, weight = "1/6" },
//!     { at = [1, 1], sector = -1, weight = "1/6" },
//! ]                                # sector = "all" gives the weight to the point of every sector
//! ```
//!
//! A special point given for sector 0 only holds for all sectors; if any is given for another sector, every sector stands for
//! itself (`symmetric = false`). Decimals are taken as the exact decimal numbers that are written.

use crate::{Error, Fan, Lattice, Level, Line, Number, OneRing, Pass, Scalar, Scheme, Site, Stencil};
use serde::Deserialize;

/// A scheme file, read and checked, for the valences it lists.
#[derive(Clone, Debug)]
pub struct UserScheme {
    name: String,
    valences: Vec<(usize, Rules)>,
}

#[derive(Clone, Debug)]
enum Rules {
    OneRing(OneRing<Number>),
    Passes { degree: usize, passes: Vec<PassRules> },
}

#[derive(Clone, Debug)]
struct PassRules {
    from: Lattice,
    to: Lattice,
    line: Vec<Vec<(i32, Number)>>,
    special: Vec<(Site, Vec<(Site, Number)>)>,
}

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

fn file_error(message: impl Into<String>) -> Error {
    Error::SchemeFile {
        message: message.into(),
    }
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

impl UserScheme {
    /// Reads a scheme from the text of a TOML file; `default_name` is used if the file gives none.
    ///
    /// # Errors
    /// [`Error::SchemeFile`], with what is wrong and where. Sums of weights are not checked here: they are a property to be
    /// verified, not a matter of form.
    pub fn parse(text: &str, default_name: &str) -> Result<Self, Error> {
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
        let scheme = UserScheme {
            name: name.unwrap_or_else(|| default_name.to_owned()),
            valences,
        };
        for &(n, _) in &scheme.valences {
            scheme
                .scheme::<f64>(n)?
                .closed_rings()
                .map_err(|error| file_error(format!("valence n = {n}: {error}")))?;
        }
        Ok(scheme)
    }

    /// The name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The valences with rules, in the order of the file.
    pub fn valences(&self) -> impl Iterator<Item = usize> + '_ {
        self.valences.iter().map(|&(n, _)| n)
    }

    /// The scheme around a centre of the given valence.
    ///
    /// # Errors
    /// [`Error::NoSuchValence`] if the file does not list it.
    pub fn scheme<S: Scalar>(&self, valence: usize) -> Result<Scheme<S>, Error> {
        let Some((_, rules)) = self.valences.iter().find(|&&(n, _)| n == valence) else {
            let accepted: Vec<String> = self.valences().map(|n| n.to_string()).collect();
            return Err(Error::NoSuchValence {
                scheme: self.name.clone(),
                valence,
                accepted: accepted.join(", "),
            });
        };
        match rules {
            Rules::OneRing(weights) => weights.to_scalar::<S>().scheme(self.name.clone(), valence),
            Rules::Passes { degree, passes } => {
                Ok(Scheme::stationary(self.name.clone(), *degree, level(valence, passes)))
            }
        }
    }
}

impl OneRing<Number> {
    fn to_scalar<S: Scalar>(self) -> OneRing<S> {
        self.map(Number::to)
    }
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

fn level<S: Scalar>(valence: usize, rules: &[PassRules]) -> Level<S> {
    let symmetric = rules
        .iter()
        .flat_map(|pass| &pass.special)
        .all(|(site, _)| site.sector == 0);
    let build = |mirror| Level {
        fan: Fan::Closed(valence),
        passes: rules.iter().map(pass::<S>).collect(),
        symmetric,
        mirror,
    };
    let doubles: Level<f64> = Level {
        fan: Fan::Closed(valence),
        passes: rules.iter().map(pass::<f64>).collect(),
        symmetric,
        mirror: true,
    };
    // the weights are exact numbers, so their doubles are equal where they are
    build(symmetric && doubles.is_mirror_symmetric(0.0, |weight| weight))
}

fn pass<S: Scalar>(rules: &PassRules) -> Pass<S> {
    let line = rules
        .line
        .iter()
        .map(|taps| taps.iter().map(|&(offset, weight)| (offset, weight.to())).collect())
        .collect();
    rules.special.iter().fold(
        Pass::regular(rules.from, rules.to, Line::new(line)),
        |pass, (site, terms)| {
            let stencil = terms.iter().fold(Stencil::new(), |stencil, &(source, weight)| {
                stencil.with(source, weight.to())
            });
            pass.with(*site, stencil)
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::families::{catmull_clark_weights, doo_sabin};

    /// The module page's examples are the tests' input.
    fn example(kind: &str) -> String {
        let page = include_str!("user.rs");
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
        let scheme = UserScheme::parse(&example("one-ring"), "x").unwrap();
        assert_eq!(scheme.name(), "mine");
        let ours = scheme.scheme::<f64>(5).unwrap();
        let reference = catmull_clark_weights::<f64>(5).scheme("reference", 5).unwrap();
        for &site in reference.limit.passes[0].special.keys() {
            let (a, b) = (
                ours.limit.stencil(0, site).unwrap(),
                reference.limit.stencil(0, site).unwrap(),
            );
            for (a, b) in a.terms().iter().zip(b.terms()) {
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
        let scheme = UserScheme::parse(&example("stencils"), "x")
            .unwrap()
            .scheme::<f64>(3)
            .unwrap();
        assert!(scheme.limit.symmetric && scheme.limit.mirror);
        let reference = doo_sabin::<f64>(3).unwrap();
        let net = crate::DenseNet {
            numbering: reference.numbering(1),
        };
        let sites = net.numbering.sites();
        let (ours, theirs) = (
            crate::refine(&scheme.limit, &net, &sites).unwrap(),
            crate::refine(&reference.limit, &net, &sites).unwrap(),
        );
        for (a, b) in ours.iter().flatten().zip(theirs.iter().flatten()) {
            assert!((a - b).abs() < 1e-15);
        }
    }

    #[test]
    fn a_lopsided_stencil_is_not_mirror_symmetric() {
        let text = example("stencils").replace("sector = -1, weight = \"1/6\"", "sector = -1, weight = \"1/12\"");
        let scheme = UserScheme::parse(&text, "x").unwrap().scheme::<f64>(3).unwrap();
        assert!(scheme.limit.symmetric && !scheme.limit.mirror);
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
            let error = UserScheme::parse(&text, "x").map(|_| ()).unwrap_err().to_string();
            assert!(error.contains(needle), "{needle}: {error}");
            assert!(!error.contains('\n'), "{error}");
        }
    }
}
