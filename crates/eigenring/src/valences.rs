//! Valences as they are written: numbers and ranges, separated by commas.
//!
//! `-N`, `--valence` and `--valences` are one option in every command. Commands about one corner take one
//! value, the others lists such as `3,5..8`; a range without an end, `3..`, is for `verify`, which may know
//! a proof for all valences at once.

use crate::error::Error;
use clap::Args;
use std::str::FromStr;

pub use eigenring_atlas::schemes::MAX_VALENCE;

/// The smallest valence that a scheme has rules for, unless a matrix or a corner says otherwise.
const MIN_VALENCE: usize = 3;

/// A list of valences, ascending, each once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Valences {
    /// The valences that are listed.
    listed: Vec<usize>,
    /// All valences from here on, if there is a range without an end.
    from: Option<usize>,
}

impl Valences {
    /// The list, of what has no answer for all valences.
    ///
    /// # Errors
    /// A range without an end.
    pub fn closed(&self) -> Result<&[usize], Error> {
        match self.from {
            None => Ok(&self.listed),
            Some(from) => Err(Error::usage(
                format!("{from}.. has no end"),
                format!("a range with an end, such as {from}..{}", (from + 9).min(MAX_VALENCE)),
            )),
        }
    }
}

impl Valences {
    /// The first of a range without an end.
    pub fn from(&self) -> Option<usize> {
        self.from
    }

    /// The valences below `first` that are listed, or lie in the range without an end.
    pub fn below(&self, first: usize) -> Vec<usize> {
        let in_range = self.from.map_or(first, |from| from.min(first))..first;
        let mut all: Vec<usize> = self
            .listed
            .iter()
            .copied()
            .filter(|&valence| valence < first)
            .chain(in_range)
            .collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}

impl FromStr for Valences {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let refuse = || {
            format!("accepted are numbers from {MIN_VALENCE} to {MAX_VALENCE} and ranges, such as 3..20 or 3,5,8..10")
        };
        let number = |text: &str| text.trim().parse::<usize>().map_err(|_| refuse());
        let (mut listed, mut from) = (Vec::new(), None);
        for part in text.split(',') {
            let (first, last) = match part.split_once("..") {
                Some((first, last)) if last.trim().is_empty() => (number(first)?, None),
                Some((first, last)) => (number(first)?, Some(number(last.trim_start_matches('='))?)),
                None => (number(part)?, Some(number(part)?)),
            };
            let end = last.unwrap_or(MAX_VALENCE);
            if first > end || first < MIN_VALENCE || end > MAX_VALENCE {
                return Err(refuse());
            }
            match last {
                Some(last) => listed.extend(first..=last),
                None => from = Some(from.map_or(first, |known: usize| known.min(first))),
            }
        }
        listed.sort_unstable();
        listed.dedup();
        Ok(Valences { listed, from })
    }
}

/// Reads one valence, or a list without open ranges: what is neither is refused as the one that it resembles.
pub fn one_or_list(text: &str) -> Result<Valences, String> {
    if text.contains(',') || text.contains("..") {
        return list(text);
    }
    let listed = vec![one_of_scheme(text)?];
    Ok(Valences { listed, from: None })
}

/// Reads a list without open ranges.
pub fn list(text: &str) -> Result<Valences, String> {
    let valences: Valences = text.parse()?;
    match valences.closed() {
        Ok(_) => Ok(valences),
        Err(error) => Err(error.line()),
    }
}

/// Reads one valence of a corner, which may be as small as 1.
fn one(text: &str) -> Result<usize, String> {
    let valence = text.trim().parse().ok();
    let valence = valence.filter(|valence| (1..=MAX_VALENCE).contains(valence));
    valence.ok_or_else(|| {
        let several = list(text).is_ok_and(|found| found.listed.len() > 1);
        let reason = if several {
            "this command takes one valence: "
        } else {
            ""
        };
        format!("{reason}accepted is {MIN_VALENCE} to {MAX_VALENCE}")
    })
}

/// Reads one valence of a scheme.
fn one_of_scheme(text: &str) -> Result<usize, String> {
    let valence = one(text)?;
    match valence < MIN_VALENCE {
        true => Err(format!("accepted is {MIN_VALENCE} to {MAX_VALENCE}")),
        false => Ok(valence),
    }
}

/// The valences of a command that has its own where none are given.
#[derive(Args, Clone, Debug)]
pub struct OptionalValences {
    /// Valences: numbers and ranges, such as 3..20 or 3,5,8..10
    #[arg(
        short = 'N',
        long,
        visible_alias = "valence",
        value_name = "LIST",
        value_parser = list,
        allow_hyphen_values = true
    )]
    pub valences: Option<Valences>,
}

/// The valence of a command about one vertex or face.
#[derive(Args, Clone, Copy, Debug)]
pub struct Valence {
    /// Valence
    #[arg(
        short = 'N',
        long = "valence",
        visible_alias = "valences",
        value_name = "N",
        value_parser = one_of_scheme,
        allow_negative_numbers = true
    )]
    pub valence: usize,
}

/// The valence of a command about one corner, which other options may fix.
#[derive(Args, Clone, Copy, Debug)]
pub struct OptionalValence {
    /// Valence; may be left out where --fan, --knots or the input fix it
    #[arg(
        short = 'N',
        long = "valence",
        visible_alias = "valences",
        value_name = "N",
        value_parser = one,
        allow_negative_numbers = true
    )]
    pub valence: Option<usize>,
}

/// Refuses a valence that is none of a closed fan.
///
/// # Errors
/// A valence below 3.
pub fn of_scheme(valence: usize) -> Result<usize, Error> {
    match valence < MIN_VALENCE {
        true => Err(Error::range(
            "valence",
            valence,
            format!("{MIN_VALENCE} to {MAX_VALENCE}"),
        )),
        false => Ok(valence),
    }
}

/// No valence is given, and nothing fixes one.
pub fn missing() -> Error {
    Error::usage("no valence is given", format!("-N with {MIN_VALENCE} to {MAX_VALENCE}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_valences() {
        let list = |text: &str| list(text).map(|found| found.listed);
        assert_eq!(list("5"), Ok(vec![5]));
        assert_eq!(list("3..6"), Ok(vec![3, 4, 5, 6]));
        assert_eq!(list("3,5..8"), Ok(vec![3, 5, 6, 7, 8]));
        assert_eq!(list("8..=9,3, 4,3"), Ok(vec![3, 4, 8, 9]));
        for bad in [
            "",
            "2",
            "2..5",
            "6..3",
            "x",
            "3..",
            "1001",
            "3..99999999999999999999",
            "..5",
        ] {
            assert!(list(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn ranges_without_an_end() {
        let open: Valences = "5,8..,7".parse().unwrap();
        assert_eq!((open.listed.as_slice(), open.from), (&[5, 7][..], Some(8)));
        assert!(
            open.closed()
                .unwrap_err()
                .line()
                .contains("8.. has no end: accepted is a range with an end")
        );
        assert!("2..".parse::<Valences>().is_err());
    }

    #[test]
    fn one_valence_is_no_list() {
        assert_eq!(one("2"), Ok(2));
        assert_eq!(one_of_scheme("5"), Ok(5));
        assert!(one("3,5").unwrap_err().starts_with("this command takes one valence"));
        for bad in ["0", "-3", "1001", "six", "5.5"] {
            assert_eq!(one(bad), Err("accepted is 3 to 1000".to_owned()));
        }
    }
}
