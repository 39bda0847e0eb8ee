//! Arguments that several commands share.

use crate::error::Error;
use crate::table::Format;
use clap::Args;
use eigenring_tune::objective::{Normalisation, Settings};
use std::ops::RangeInclusive;
use std::str::FromStr;

/// The largest valence the command takes. Local matrices grow with the square of the valence, and nothing beyond is met in
/// practice.
pub const MAX_VALENCE: usize = 1000;

/// Refuses valences out of range.
pub fn check_valence(valence: usize) -> Result<usize, Error> {
    if (3..=MAX_VALENCE).contains(&valence) {
        return Ok(valence);
    }
    Err(Error::Range {
        what: "valence",
        given: valence.to_string(),
        accepted: format!("3 to {MAX_VALENCE}"),
    })
}

/// The output format.
#[derive(Args, Clone, Copy, Debug)]
pub struct Output {
    /// How results are printed
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

/// A list of valences: "5", "3..20" (both ends included), "3,5,8..10".
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Valences(pub Vec<usize>);

impl FromStr for Valences {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let refuse = || {
            format!(
                "'{text}' is no list of valences: accepted are numbers from 3 to {MAX_VALENCE} and ranges, such as 3..20 or 3,5,8..10"
            )
        };
        let mut valences = Vec::new();
        for part in text.split(',') {
            let number = |text: &str| text.trim().parse::<usize>().map_err(|_| refuse());
            let range: RangeInclusive<usize> = match part.split_once("..") {
                Some((first, last)) => number(first)?..=number(last.trim_start_matches('='))?,
                None => number(part)?..=number(part)?,
            };
            if range.is_empty() || check_valence(*range.start()).is_err() || check_valence(*range.end()).is_err() {
                return Err(refuse());
            }
            valences.extend(range);
        }
        valences.sort_unstable();
        valences.dedup();
        Ok(Valences(valences))
    }
}

/// The constants of the objective.
#[derive(Args, Clone, Copy, Debug)]
pub struct ObjectiveArgs {
    /// Do not penalise sign changes of the Gauss curvature
    #[arg(long)]
    pub unweighted: bool,
    /// Width of the weight's transition, relative to the ideal Gauss curvature
    #[arg(long, default_value_t = 0.2, value_name = "X")]
    pub epsilon: f64,
    /// Square root of the largest weight
    #[arg(long, default_value_t = 5.0, value_name = "X")]
    pub weight: f64,
    /// Gauss points per patch and direction
    #[arg(long, default_value_t = 5, value_name = "COUNT")]
    pub quadrature: usize,
    /// Ratio alpha/beta of the vertex stencil's total weights
    #[arg(long, default_value_t = 6.0, value_name = "X")]
    pub phi: f64,
    /// Scale of the eigenvectors: unit norm over five rings, or unit first edge neighbour
    #[arg(long, value_enum, default_value_t)]
    pub normalisation: NormalisationArg,
}

/// See [`Normalisation`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum NormalisationArg {
    /// Unit norm over the five rings.
    #[default]
    Paper,
    /// First edge neighbour at distance 1.
    UnitRing,
}

impl ObjectiveArgs {
    /// The settings of the objective.
    pub fn settings(&self) -> Settings {
        Settings {
            epsilon: self.epsilon,
            n: self.weight,
            quadrature_order: self.quadrature,
            weighted: !self.unweighted,
            normalisation: match self.normalisation {
                NormalisationArg::Paper => Normalisation::Paper,
                NormalisationArg::UnitRing => Normalisation::UnitRing,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_valences() {
        let list = |text: &str| text.parse::<Valences>().map(|v| v.0);
        assert_eq!(list("5"), Ok(vec![5]));
        assert_eq!(list("3..6"), Ok(vec![3, 4, 5, 6]));
        assert_eq!(list("8..=9,3, 4,3"), Ok(vec![3, 4, 8, 9]));
        for bad in ["", "2", "2..5", "6..3", "x", "3..", "1001", "3..99999999999999999999"] {
            assert!(list(bad).is_err(), "{bad}");
        }
    }
}
