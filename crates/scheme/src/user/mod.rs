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
//! A special point given for sector 0 only holds for all sectors; if any is given for another sector, every
//! sector stands for itself. Numbers are taken as the exact decimals and fractions that are written, of any
//! length; symmetry and degree are derived from them. `degree` may be left out; another one than that of the
//! B-splines that the lines refine is refused, and it has no effect where they refine none. How weights that
//! a program has rounded are read is said in [`Reading`].

mod balance;
mod file;

pub use balance::Balance;

use crate::{Error, Exact, Fan, Lattice, Level, Line, OneRing, Pass, Scalar, Scheme, Site, Stencil};
use file::file_error;
use serde::{Deserialize, Serialize};

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

/// A scheme file, read and checked, for the valences it lists.
#[derive(Clone, Debug)]
pub struct UserScheme {
    name: String,
    entries: Vec<Entry>,
}

/// The scheme at one valence.
#[derive(Clone, Debug)]
struct Entry {
    scheme: Scheme<Exact>,
    balance: Balance,
}

#[derive(Clone, Debug)]
enum Rules {
    OneRing(OneRing<Exact>),
    Passes(Vec<PassRules>),
}

#[derive(Clone, Debug)]
struct PassRules {
    from: Lattice,
    to: Lattice,
    line: Vec<Vec<(i32, Exact)>>,
    special: Vec<(Site, Vec<(Site, Exact)>)>,
}

impl UserScheme {
    /// Reads a scheme from the text of a TOML file; `default_name` is used if the file gives none.
    ///
    /// # Errors
    /// [`Error::SchemeFile`], with what is wrong and where. Sums of weights are not checked here: they are a
    /// property to be verified, not a matter of form.
    pub fn parse(text: &str, default_name: &str, reading: Reading) -> Result<Self, Error> {
        let contents = file::read(text)?;
        let name = contents.name.unwrap_or_else(|| default_name.to_owned());
        let entry = |(n, rules): (usize, Rules)| {
            let at_n = |error: Error| file_error(format!("valence n = {n}: {error}"));
            let entry = Entry::new(&name, n, rules, reading).map_err(at_n)?;
            if let (Some(stated), Some(degree)) = (contents.degree, entry.scheme.degree())
                && stated != degree
            {
                return Err(file_error(format!(
                    "valence n = {n}: degree = {stated} is stated, but the lines refine B-splines of degree {degree}: accepted is degree = {degree}, or none"
                )));
            }
            entry.scheme.closed_rings().map_err(at_n)?;
            Ok(entry)
        };
        let entries = contents.valences.into_iter().map(entry).collect::<Result<_, Error>>()?;
        Ok(UserScheme { name, entries })
    }

    /// The name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The valences with rules, in the order of the file.
    pub fn valences(&self) -> impl Iterator<Item = usize> + '_ {
        self.entries.iter().map(|entry| entry.scheme.valence())
    }

    /// The scheme around a centre of the given valence, in exact numbers.
    ///
    /// # Errors
    /// [`Error::NoSuchValence`] if the file does not list it.
    pub fn exact(&self, valence: usize) -> Result<&Scheme<Exact>, Error> {
        Ok(&self.entry(valence)?.scheme)
    }

    /// The scheme around a centre of the given valence.
    ///
    /// # Errors
    /// [`Error::NoSuchValence`] if the file does not list it.
    pub fn scheme<S: Scalar>(&self, valence: usize) -> Result<Scheme<S>, Error> {
        let exact = self.exact(valence)?;
        // numbers of files are rational, and sums and products of such always have a value
        Ok(exact.map(|weight| weight.to().unwrap_or_else(|| S::exact(f64::NAN))))
    }

    /// What was balanced at a valence.
    ///
    /// # Errors
    /// [`Error::NoSuchValence`] if the file does not list it.
    pub fn balance(&self, valence: usize) -> Result<Balance, Error> {
        Ok(self.entry(valence)?.balance)
    }

    fn entry(&self, valence: usize) -> Result<&Entry, Error> {
        let found = self.entries.iter().find(|entry| entry.scheme.valence() == valence);
        found.ok_or_else(|| {
            let accepted: Vec<String> = self.valences().map(|n| n.to_string()).collect();
            Error::NoSuchValence {
                scheme: self.name.clone(),
                valence,
                accepted: accepted.join(", "),
            }
        })
    }
}

impl Entry {
    fn new(name: &str, n: usize, rules: Rules, reading: Reading) -> Result<Self, Error> {
        let fan = Fan::Closed(n);
        let mut passes = match rules {
            Rules::Passes(passes) => passes,
            Rules::OneRing(weights) => {
                let scheme = weights.scheme(name, n)?;
                let (scheme, balance) = match reading {
                    Reading::Exact => (scheme, Balance::default()),
                    Reading::Balanced => balanced_one_ring(scheme)?,
                };
                return Ok(Entry { scheme, balance });
            }
        };
        let balance = match reading {
            Reading::Balanced => balance::balance(fan, &mut passes),
            Reading::Exact => Balance::default(),
        };
        let passes = passes.into_iter().map(pass).collect();
        let scheme = Scheme::stationary(name, Level::new(fan, passes)?);
        Ok(Entry { scheme, balance })
    }
}

/// One-ring weights are symmetric by construction; their sums may need balancing.
fn balanced_one_ring(scheme: Scheme<Exact>) -> Result<(Scheme<Exact>, Balance), Error> {
    let level = scheme.limit();
    let rules = |pass: &Pass<Exact>| PassRules {
        from: pass.from(),
        to: pass.to(),
        line: pass.line().map_or(Vec::new(), |line| line.classes().to_vec()),
        special: pass
            .special()
            .iter()
            .map(|(site, stencil)| (*site, stencil.terms().to_vec()))
            .collect(),
    };
    let mut passes: Vec<PassRules> = level.passes().iter().map(rules).collect();
    let balance = balance::balance(level.fan(), &mut passes);
    if balance.rows == 0 {
        return Ok((scheme, balance));
    }
    let level = Level::new(level.fan(), passes.into_iter().map(pass).collect())?;
    Ok((Scheme::stationary(scheme.name(), level), balance))
}

fn pass(rules: PassRules) -> Pass<Exact> {
    let regular = Pass::regular(rules.from, rules.to, Line::new(rules.line));
    rules.special.into_iter().fold(regular, |pass, (site, terms)| {
        let stencil = terms
            .into_iter()
            .fold(Stencil::new(), |stencil, (source, weight)| stencil.with(source, weight));
        pass.with(site, stencil)
    })
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
            let (a, b) = (
                ours.limit().stencil(0, site).unwrap(),
                reference.limit().stencil(0, site).unwrap(),
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
