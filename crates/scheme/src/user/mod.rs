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

mod file;

use crate::{Error, Fan, Lattice, Level, Line, Number, OneRing, Pass, Scalar, Scheme, Site, Stencil};
use file::file_error;

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

impl UserScheme {
    /// Reads a scheme from the text of a TOML file; `default_name` is used if the file gives none.
    ///
    /// # Errors
    /// [`Error::SchemeFile`], with what is wrong and where. Sums of weights are not checked here: they are a property to be
    /// verified, not a matter of form.
    pub fn parse(text: &str, default_name: &str) -> Result<Self, Error> {
        let (name, valences) = file::read(text)?;
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
            Rules::OneRing(weights) => weights.map(Number::to::<S>).scheme(self.name.clone(), valence),
            Rules::Passes { degree, passes } => {
                Ok(Scheme::stationary(self.name.clone(), *degree, level(valence, passes)))
            }
        }
    }
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
