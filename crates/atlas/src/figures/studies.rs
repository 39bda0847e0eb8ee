//! Where the numbers of figures come from: stored results, or computed on the spot.

use crate::error::{Accepted, Error};
use crate::files;
use crate::progress::Progress;
use crate::results::{EVERYTHING, FOLDER, FORMAT_VERSION, Results};
use crate::run::{Parameters, studies};
use eigenring_scheme::lambda::{LambdaEntry, LambdaTable};
use eigenring_tune::study::{Knots, Study};
use eigenring_tune::sweep::{Options, Range};
use std::collections::BTreeMap;
use std::path::Path;

/// Where `eigenring verify --all` leaves its summary of ranges, below the folder of results.
const RANGES: &str = "certificates/ranges.csv";

/// Studies by valence, all of one set of parameters.
#[derive(Debug)]
pub struct Studies {
    parameters: Parameters,
    by_valence: BTreeMap<usize, Study>,
    /// The stored `certificates/ranges.csv`, if there is one.
    pub ranges: Option<String>,
    /// Of what was computed, for people.
    pub remark: Option<String>,
}

impl Studies {
    /// The studies stored below a folder (`FOLDER/lambda/tables.json`), and those of the needed valences,
    /// computed where they are not stored. Without a folder nothing is read.
    ///
    /// # Errors
    /// [`Error::Read`] and [`Error::InFile`] for what is stored; those of [`studies`] for what is not.
    pub fn load(folder: Option<&Path>, needed: &[usize], progress: &dyn Progress) -> Result<Self, Error> {
        let stored = folder.map(read).transpose()?;
        let (parameters, known) = match stored {
            Some(results) => (results.provenance.parameters, results.valences),
            None => (
                Parameters::new(Vec::new(), Knots::Detected, &Options::default(), &Range::default()),
                Vec::new(),
            ),
        };
        let mut by_valence: BTreeMap<usize, Study> = known.into_iter().map(|study| (study.valence, study)).collect();
        let mut missing: Vec<usize> = needed.iter().copied().filter(|n| !by_valence.contains_key(n)).collect();
        missing.sort_unstable();
        missing.dedup();
        let mut remark = None;
        if !missing.is_empty() {
            let names: Vec<String> = missing.iter().map(usize::to_string).collect();
            let place = folder.map_or("stored results".to_owned(), |folder| folder.display().to_string());
            remark = Some(format!(
                "samples of N = {} are not in {place}; tuned now",
                names.join(", ")
            ));
            let parameters = Parameters {
                valences: missing,
                ..parameters.clone()
            };
            let computed = studies(&parameters, &(), progress)?;
            by_valence.extend(computed.into_iter().map(|study| (study.valence, study)));
        }
        let ranges = folder.map(|folder| folder.join(RANGES)).filter(|path| path.exists());
        Ok(Studies {
            parameters,
            by_valence,
            ranges: ranges.map(|path| files::read(&path)).transpose()?,
            remark,
        })
    }

    /// The study of a valence that was asked for.
    pub fn get(&self, valence: usize) -> Result<&Study, Error> {
        self.by_valence.get(&valence).ok_or_else(|| Error::Usage {
            message: format!("there are no samples of N = {valence}"),
            accepted: format!("{:?}", self.by_valence.keys().collect::<Vec<_>>()),
        })
    }

    /// The splines and featured values of a valence: stored ones, else the embedded ones; `None` where there
    /// are neither.
    pub fn entry(&self, valence: usize) -> Result<Option<LambdaEntry>, Error> {
        if let Some(study) = self.by_valence.get(&valence) {
            return Ok(Some(self.parameters.entry(study)));
        }
        Ok(LambdaTable::embedded()?.entry(valence).ok().cloned())
    }

    /// How the stencils were tuned.
    pub fn options(&self) -> Options {
        self.parameters.options().0
    }
}

/// The stored results, if their format is this one.
fn read(folder: &Path) -> Result<Results, Error> {
    let path = folder.join(FOLDER).join(EVERYTHING);
    let text = files::read(&path)?;
    let results: Results = serde_json::from_str(&text)
        .map_err(|error| Error::content(format!("no results of this version: {error}")).in_file(&path))?;
    if results.version != FORMAT_VERSION {
        let accepted = Accepted::Is(FORMAT_VERSION.to_string());
        return Err(Error::refused(format!("version {}", results.version), accepted).in_file(&path));
    }
    Ok(results)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;

    #[test]
    fn what_is_not_stored_is_computed_and_agrees_with_the_embedded_table() {
        let studies = Studies::load(None, &[6], &Silent).unwrap();
        let computed = studies.entry(6).unwrap().unwrap();
        let embedded = LambdaTable::embedded().unwrap().entry(6).unwrap();
        assert!((computed.lambda_optimal - embedded.lambda_optimal).abs() < 1e-6);
        assert!(studies.get(6).is_ok() && studies.get(7).is_err());
        assert!(studies.entry(7).unwrap().is_some() && studies.entry(64).unwrap().is_none());
    }

    #[test]
    fn missing_and_broken_results_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        assert!(matches!(
            Studies::load(Some(folder.path()), &[], &Silent),
            Err(Error::Read { .. })
        ));
        files::write(&folder.path().join("lambda/tables.json"), b"{}").unwrap();
        assert!(matches!(
            Studies::load(Some(folder.path()), &[], &Silent),
            Err(Error::InFile { .. })
        ));
    }
}
