//! The embedded spline stencils: f2 and f3 as functions of lambda, for each tabulated valence.
//!
//! Evaluation is Eq. 22 of Ma, Wang and Ma (2023), `f_i(lambda) = b(lambda)^T C_i` with the cubic basis on
//! [`LambdaKnots`]. There are two tables, [`Splines`]: that of the paper's 17 coefficients, and a finer one
//! for whoever asks for it. The files `data/lambda*.json` are written by the tool itself and never by hand;
//! their `digest` covers every number in them, so that a changed file is refused instead of giving other
//! stencils. At valence 4, block 2 is diagonal with f3 on its diagonal, so f3 is `mu = s lambda^2` by
//! formula; the tabulated spline only approximates it and is kept to be compared.

use super::{LambdaKnots, Relaxation};
use crate::Error;
use eigenring_spline::{Error as Refused, Spline};
use serde::{Deserialize, Serialize};
use std::sync::OnceLock;

/// The format that this version reads and writes.
pub const TABLE_VERSION: u32 = 1;

/// All tabulated valences, in ascending order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LambdaTable {
    /// Version of the format, [`TABLE_VERSION`].
    pub version: u32,
    /// Where the numbers come from.
    pub provenance: Provenance,
    /// One entry for each valence.
    pub valences: Vec<LambdaEntry>,
}

/// What wrote a table, and a digest of what was written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// Version of the tool.
    pub tool: String,
    /// The command that regenerates the table.
    pub command: String,
    /// [`LambdaTable::digest`] of the entries.
    pub digest: String,
}

/// The spline stencils and featured lambda values of one valence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LambdaEntry {
    /// The valence N.
    pub valence: usize,
    /// The knots.
    pub knots: LambdaKnots,
    /// Coefficients of f2, [`LambdaKnots::dimension`] of them.
    pub f2: Vec<f64>,
    /// Coefficients of f3, as many.
    pub f3: Vec<f64>,
    /// The globally optimal lambda, lambda_C*.
    pub lambda_optimal: f64,
    /// The smallest lambda with bounded curvature.
    pub lambda_l: f64,
    /// Start of the recommended region.
    pub lambda_r1: f64,
    /// End of the recommended region.
    pub lambda_r2: f64,
    /// The ratio `alpha / beta`.
    pub phi: f64,
}

/// What is wrong with a table file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// Not JSON, or not of this structure.
    #[error("line {line}, column {column}: {message}")]
    Syntax {
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What was expected there.
        message: String,
    },
    /// Written in another format.
    #[error("format version {found}: accepted is {TABLE_VERSION}")]
    Version {
        /// The file's version.
        found: u32,
    },
    /// Valences are listed in ascending order, each once.
    #[error("valence {valence} is repeated or out of order: accepted are ascending valences")]
    Order {
        /// The first one out of order.
        valence: usize,
    },
    /// A featured lambda outside of the knots' domain, or a ratio that is not positive.
    #[error("valence {valence}: {field} = {value} is out of range: accepted is {lower} to {upper}")]
    Field {
        /// The entry.
        valence: usize,
        /// Name of the field.
        field: &'static str,
        /// Its value.
        value: f64,
        /// Smallest accepted value.
        lower: f64,
        /// Largest accepted value.
        upper: f64,
    },
    /// The numbers are not those that were written.
    #[error("the entries' digest is {actual}, the file says {stated}: it was changed after it was written")]
    Digest {
        /// What the file says.
        stated: String,
        /// What its entries give.
        actual: String,
    },
}

/// Which of the tables that are compiled into this crate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Splines {
    /// With the 17 coefficients of the paper.
    #[default]
    Paper,
    /// With more single knots where 17 coefficients lose more than a hundredth of the objective against the
    /// samples.
    Fine,
}

impl Splines {
    /// The table.
    ///
    /// # Errors
    /// [`Error::Table`] if the file that was compiled in is not valid.
    pub fn table(self) -> Result<&'static LambdaTable, Error> {
        static PAPER: OnceLock<Result<LambdaTable, Error>> = OnceLock::new();
        static FINE: OnceLock<Result<LambdaTable, Error>> = OnceLock::new();
        let (table, text) = match self {
            Splines::Paper => (&PAPER, include_str!("../../data/lambda.json")),
            Splines::Fine => (&FINE, include_str!("../../data/lambda-fine.json")),
        };
        table
            .get_or_init(|| LambdaTable::from_json(text))
            .as_ref()
            .map_err(Clone::clone)
    }
}

impl LambdaTable {
    /// The table of the paper's splines, [`Splines::Paper`].
    ///
    /// # Errors
    /// Those of [`Splines::table`].
    pub fn embedded() -> Result<&'static LambdaTable, Error> {
        Splines::Paper.table()
    }

    /// A table of the given entries, with their digest.
    ///
    /// # Errors
    /// As for [`LambdaTable::from_json`].
    pub fn new(tool: String, command: String, valences: Vec<LambdaEntry>) -> Result<Self, Error> {
        let mut table = LambdaTable {
            version: TABLE_VERSION,
            provenance: Provenance {
                tool,
                command,
                digest: String::new(),
            },
            valences,
        };
        table.provenance.digest = table.digest();
        table.validate()?;
        Ok(table)
    }

    /// Reads and checks a table.
    ///
    /// # Errors
    /// [`Error::Table`] unless the text is a table of this version with ascending valences, featured values
    /// in the domain and the stated digest; the errors of [`LambdaKnots::knots`], [`Spline::new`] and
    /// [`Error::Valence`] for a bad entry.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        /// Read before the rest, so that another format is named as such.
        #[derive(Deserialize)]
        struct Header {
            version: u32,
        }
        let Header { version: found } = serde_json::from_str(text).map_err(syntax)?;
        if found != TABLE_VERSION {
            return Err(TableError::Version { found }.into());
        }
        let table: LambdaTable = serde_json::from_str(text).map_err(syntax)?;
        table.validate()?;
        Ok(table)
    }

    /// The table as indented JSON; reading it gives the same bits back.
    ///
    /// # Errors
    /// The errors of [`LambdaTable::from_json`]: an invalid table is not written.
    pub fn to_json(&self) -> Result<String, Error> {
        self.validate()?;
        let mut text = serde_json::to_string_pretty(self).map_err(syntax)?;
        text.push('\n');
        Ok(text)
    }

    /// The tabulated valences, ascending.
    pub fn valences(&self) -> impl Iterator<Item = usize> + '_ {
        self.valences.iter().map(|entry| entry.valence)
    }

    /// The entry of a valence.
    ///
    /// # Errors
    /// [`Error::NotTabulated`] if there is none.
    pub fn entry(&self, valence: usize) -> Result<&LambdaEntry, Error> {
        match self.valences.binary_search_by_key(&valence, |entry| entry.valence) {
            Ok(index) => Ok(&self.valences[index]),
            Err(_) => Err(Error::NotTabulated {
                valence,
                tabulated: self.valences().collect(),
            }),
        }
    }

    /// 64-bit FNV-1a hash over the bits of all numbers of all entries, as 16 hexadecimal digits. It detects
    /// accidents, not attacks.
    pub fn digest(&self) -> String {
        let words = self.valences.iter().flat_map(|entry| {
            let featured = [
                entry.lambda_optimal,
                entry.lambda_l,
                entry.lambda_r1,
                entry.lambda_r2,
                entry.phi,
            ];
            // those of the paper's knots are not stored either
            let singles = Some(entry.knots.singles).filter(|singles| *singles != LambdaKnots::SINGLES);
            let singles = singles.into_iter().flatten().map(|count| count as u64);
            let coefficients = entry.f2.iter().chain(&entry.f3).copied();
            let numbers = entry.knots.values().into_iter().chain(coefficients).chain(featured);
            std::iter::once(entry.valence as u64)
                .chain(numbers.map(f64::to_bits))
                .chain(singles)
        });
        let hash = words
            .flat_map(u64::to_le_bytes)
            .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
                (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
            });
        format!("{hash:016x}")
    }

    fn validate(&self) -> Result<(), Error> {
        if let Some(pair) = self.valences.windows(2).find(|pair| pair[1].valence <= pair[0].valence) {
            let valence = pair[1].valence;
            return Err(TableError::Order { valence }.into());
        }
        self.valences.iter().try_for_each(LambdaEntry::validate)?;
        let actual = self.digest();
        if actual != self.provenance.digest {
            let stated = self.provenance.digest.clone();
            return Err(TableError::Digest { stated, actual }.into());
        }
        Ok(())
    }
}

/// Coefficients of f3 are at most 1 and four of them are combined: a value below this is the rounding of
/// zero.
const ROUNDING: f64 = 1e-15;

impl LambdaEntry {
    /// f2 and f3 at `lambda` (Eq. 22; f3 at valence 4 is mu).
    ///
    /// # Errors
    /// [`OutsideSpline`](Refused::OutsideSpline) unless `lambda` lies between the first and the last knot.
    pub fn weights(&self, lambda: f64) -> Result<(f64, f64), Error> {
        let knots = self.knots.knots()?;
        let Some(span) = knots.span(lambda) else {
            let (lower, upper) = knots.domain();
            return Err(Refused::OutsideSpline {
                value: lambda,
                lower,
                upper,
            }
            .into());
        };
        let basis = knots.basis(span, lambda);
        let f2 = basis.combine(&basis.values, &self.f2);
        let f3 = match self.valence {
            4 => mu(lambda)?,
            _ => basis.combine(&basis.values, &self.f3),
        };
        // where the spline touches its bound f3 >= 0, the sum of its terms ends within rounding on either
        // side
        let f3 = if f3.abs() < ROUNDING { 0.0 } else { f3 };
        Ok((f2, f3))
    }

    /// f2 and f3 at the globally optimal lambda.
    ///
    /// # Errors
    /// Those of [`LambdaEntry::weights`].
    pub fn optimal(&self) -> Result<(f64, f64), Error> {
        self.weights(self.lambda_optimal)
    }

    /// The spline of f2.
    ///
    /// # Errors
    /// [`Knots`](Refused::Knots) or [`Coefficients`](Refused::Coefficients) if the entry's numbers are not a
    /// spline.
    pub fn f2_spline(&self) -> Result<Spline, Error> {
        Ok(Spline::new(self.knots.knots()?, self.f2.clone())?)
    }

    /// The spline of f3; at valence 4 only an approximation of mu.
    ///
    /// # Errors
    /// [`Knots`](Refused::Knots) or [`Coefficients`](Refused::Coefficients) if the entry's numbers are not a
    /// spline.
    pub fn f3_spline(&self) -> Result<Spline, Error> {
        Ok(Spline::new(self.knots.knots()?, self.f3.clone())?)
    }

    fn validate(&self) -> Result<(), Error> {
        let valence = self.valence;
        if valence < 3 {
            return Err(Error::Valence { valence });
        }
        self.f2_spline()?;
        self.f3_spline()?;
        let LambdaKnots { a, e, .. } = self.knots;
        for (field, value, lower, upper) in [
            ("lambda_optimal", self.lambda_optimal, a, e),
            // beyond the splines' range from N = 24 on
            ("lambda_l", self.lambda_l, a, 1.0),
            ("lambda_r1", self.lambda_r1, a, self.lambda_r2.min(e)),
            ("lambda_r2", self.lambda_r2, a, e),
            ("phi", self.phi, f64::MIN_POSITIVE, f64::MAX),
        ] {
            if !(lower <= value && value <= upper) {
                return Err(TableError::Field {
                    valence,
                    field,
                    value,
                    lower,
                    upper,
                }
                .into());
            }
        }
        Ok(())
    }
}

fn mu(lambda: f64) -> Result<f64, Error> {
    Ok(Relaxation::new(4)?.s(lambda)? * lambda * lambda)
}

fn syntax(error: serde_json::Error) -> Error {
    TableError::Syntax {
        line: error.line(),
        column: error.column(),
        message: error.to_string(),
    }
    .into()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Knots of the paper, and coefficients that reproduce f2 = lambda/2, f3 = lambda/3 (the knot averages
    /// are their Greville abscissae).
    fn entry(valence: usize) -> LambdaEntry {
        let knots = LambdaKnots {
            a: 0.15,
            b: 0.25,
            c: 0.3536,
            d: 0.55,
            e: 0.9,
            singles: LambdaKnots::SINGLES,
        };
        let values = knots.knots().unwrap().values().to_vec();
        let greville = |i: usize| (values[i + 1] + values[i + 2] + values[i + 3]) / 3.0;
        LambdaEntry {
            valence,
            knots,
            f2: (0..17).map(|i| greville(i) / 2.0).collect(),
            f3: (0..17).map(|i| greville(i) / 3.0).collect(),
            lambda_optimal: 0.5,
            lambda_l: 0.3536,
            lambda_r1: 0.2,
            lambda_r2: 0.7438,
            phi: 6.0,
        }
    }

    fn table(valences: Vec<LambdaEntry>) -> Result<LambdaTable, Error> {
        LambdaTable::new("0.1.0".into(), "eigenring tables".into(), valences)
    }

    #[test]
    fn the_embedded_table_is_valid() {
        let table = LambdaTable::embedded().unwrap();
        assert_eq!(table.version, TABLE_VERSION);
        for valence in table.valences() {
            let entry = table.entry(valence).unwrap();
            assert!(entry.optimal().is_ok());
        }
        let error = table.entry(2).unwrap_err();
        assert!(
            error.to_string().contains("valence 2 is not tabulated: accepted "),
            "{error}"
        );
    }

    #[test]
    fn weights_are_the_splines() {
        let entry = entry(5);
        for step in 0..=75 {
            let lambda = (15 + step) as f64 / 100.0;
            let (f2, f3) = entry.weights(lambda).unwrap();
            assert!((f2 - lambda / 2.0).abs() < 1e-15 && (f3 - lambda / 3.0).abs() < 1e-15);
            assert_eq!(entry.f2_spline().unwrap().value(lambda), Some(f2));
            assert_eq!(entry.f3_spline().unwrap().value(lambda), Some(f3));
        }
        assert_eq!(entry.optimal().unwrap(), entry.weights(0.5).unwrap());
        for lambda in [0.149, 0.901, f64::NAN] {
            assert!(matches!(
                entry.weights(lambda),
                Err(Error::Spline(Refused::OutsideSpline { .. }))
            ));
        }
    }

    #[test]
    fn at_valence_four_f3_is_mu() {
        let entry = entry(4);
        assert_eq!(entry.optimal().unwrap().1, 0.25);
        let (_, f3) = entry.weights(0.8).unwrap();
        assert!((f3 - 0.64).abs() < 1e-15);
        // below sqrt(1/8) the relaxation keeps mu above the outer rings' 1/8
        let (_, f3) = entry.weights(0.2).unwrap();
        assert!(f3 > 0.125 && f3 < 0.126, "{f3}");
    }

    #[test]
    fn writing_and_reading_keeps_every_bit() {
        let mut entries = vec![entry(3), entry(4), entry(20)];
        for (i, entry) in entries.iter_mut().enumerate() {
            for (k, coefficient) in entry.f2.iter_mut().enumerate() {
                *coefficient = ((i * 17 + k) as f64 + 0.1).sqrt() * 10f64.powi(k as i32 - 20);
            }
        }
        let written = table(entries).unwrap();
        let read = LambdaTable::from_json(&written.to_json().unwrap()).unwrap();
        assert_eq!(read, written);
        assert_eq!(read.valences().collect::<Vec<_>>(), [3, 4, 20]);
        assert_eq!(read.entry(20).unwrap(), &written.valences[2]);
        let error = read.entry(10).unwrap_err().to_string();
        assert_eq!(error, "valence 10 is not tabulated: accepted are 3, 4, 20");
    }

    #[test]
    fn bad_tables_are_refused() {
        let good = table(vec![entry(3), entry(5)]).unwrap();
        let json = good.to_json().unwrap();
        let read = |text: &str| LambdaTable::from_json(text).unwrap_err();
        assert!(matches!(read("{"), Error::Table(TableError::Syntax { line: 1, .. })));
        assert!(matches!(
            read(r#"{"version": 2}"#),
            Error::Table(TableError::Version { found: 2 })
        ));
        let changed = json.replacen("0.7438", "0.7439", 1);
        assert!(matches!(read(&changed), Error::Table(TableError::Digest { .. })));
        let renamed = json.replacen("\"phi\"", "\"psi\"", 1);
        assert!(matches!(read(&renamed), Error::Table(TableError::Syntax { .. })));

        let with = |change: fn(&mut LambdaEntry)| {
            let mut changed = entry(5);
            change(&mut changed);
            table(vec![entry(3), changed]).unwrap_err()
        };
        assert!(matches!(
            with(|entry| entry.valence = 3),
            Error::Table(TableError::Order { valence: 3 })
        ));
        assert!(matches!(
            with(|entry| entry.f3[4] = f64::NAN),
            Error::Spline(Refused::Coefficients { .. })
        ));
        assert!(matches!(
            with(|entry| entry.knots.b = 0.4),
            Error::Spline(Refused::Knots { .. })
        ));
        for change in [
            (|entry| entry.lambda_optimal = 0.95) as fn(&mut LambdaEntry),
            |entry| entry.lambda_l = f64::NAN,
            |entry| entry.lambda_r1 = 0.8,
            |entry| entry.phi = 0.0,
        ] {
            assert!(matches!(
                with(change),
                Error::Table(TableError::Field { valence: 5, .. })
            ));
        }
        assert!(matches!(
            table(vec![LambdaEntry { valence: 2, ..entry(3) }]),
            Err(Error::Valence { valence: 2 })
        ));
    }
}
