//! Samples of an unfinished sweep, so that it can be resumed after any interruption.
//!
//! One file a valence: a first line with the parameters, then one line for each finished sample, in whatever
//! order they were finished. A line that was cut off is dropped; a file with other parameters is started
//! anew. Numbers are written so that they read back to the same bits, and samples do not depend on each
//! other: a resumed sweep gives the same results.

use eigenring_atlas::run::{Kept, Parameters};
use eigenring_atlas::{Error, files};
use eigenring_tune::sweep::LambdaSample;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// The samples of one valence, on disk and in memory.
#[derive(Debug)]
pub struct Checkpoint {
    path: PathBuf,
    file: Mutex<File>,
    known: BTreeMap<u64, LambdaSample>,
}

impl Checkpoint {
    /// Opens or starts the file of a valence; `parameters` is everything that its samples depend on.
    pub fn open(folder: &Path, valence: usize, parameters: &str) -> Result<Self, Error> {
        let path = folder.join(format!("N{valence:03}.jsonl"));
        let mut known = BTreeMap::new();
        let mut kept = format!("{parameters}\n");
        if let Ok(text) = std::fs::read_to_string(&path) {
            let mut lines = text.lines();
            if lines.next() == Some(parameters) {
                for line in lines {
                    let Ok(sample) = serde_json::from_str::<LambdaSample>(line) else {
                        continue;
                    };
                    kept.push_str(line);
                    kept.push('\n');
                    known.insert(sample.lambda.to_bits(), sample);
                }
            }
        }
        // without the line that was cut off, if there is one
        files::write(&path, kept.as_bytes())?;
        let file = File::options()
            .append(true)
            .open(&path)
            .map_err(|source| Error::Write {
                path: path.clone(),
                source,
            })?;
        Ok(Checkpoint {
            path,
            file: Mutex::new(file),
            known,
        })
    }

    /// The sample at a lambda, if it is finished.
    pub fn get(&self, lambda: f64) -> Option<&LambdaSample> {
        self.known.get(&lambda.to_bits())
    }

    /// Stores a finished sample.
    pub fn add(&self, sample: &LambdaSample) -> Result<(), Error> {
        let failed = |source| Error::Write {
            path: self.path.clone(),
            source,
        };
        let line = serde_json::to_string(sample).map_err(|error| failed(error.into()))? + "\n";
        // a poisoned lock means that another thread panicked while writing; its line is dropped on resumption
        let mut file = self.file.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        file.write_all(line.as_bytes()).map_err(failed)
    }
}

/// The samples of a run, one file a valence.
#[derive(Debug)]
pub struct Checkpoints(BTreeMap<usize, Checkpoint>);

impl Checkpoints {
    /// Opens or starts the files of a run.
    pub fn open(folder: &Path, parameters: &Parameters) -> Result<Self, Error> {
        let key = parameters.sample_key();
        let of = |&valence: &usize| Ok((valence, Checkpoint::open(folder, valence, &key)?));
        parameters
            .valences
            .iter()
            .map(of)
            .collect::<Result<_, Error>>()
            .map(Checkpoints)
    }
}

impl Kept for Checkpoints {
    fn get(&self, valence: usize, lambda: f64) -> Option<LambdaSample> {
        self.0.get(&valence)?.get(lambda).cloned()
    }

    fn add(&self, sample: &LambdaSample) -> Result<(), Error> {
        match self.0.get(&sample.valence) {
            Some(checkpoint) => checkpoint.add(sample),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_tune::sweep::{Options, sample};

    #[test]
    fn samples_survive_a_cut_line_and_other_parameters_start_anew() {
        let folder = tempfile::tempdir().unwrap();
        let samples: Vec<LambdaSample> = [0.45, 0.55].map(|l| sample(5, l, &Options::default()).unwrap()).into();
        let checkpoint = Checkpoint::open(folder.path(), 5, "p").unwrap();
        for sample in &samples {
            assert_eq!(checkpoint.get(sample.lambda), None);
            checkpoint.add(sample).unwrap();
        }
        let path = folder.path().join("N005.jsonl");
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, &text[..text.len() - 20]).unwrap();
        let resumed = Checkpoint::open(folder.path(), 5, "p").unwrap();
        assert_eq!(resumed.get(samples[0].lambda), Some(&samples[0]));
        assert_eq!(resumed.get(samples[1].lambda), None);
        resumed.add(&samples[1]).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
        assert_eq!(
            Checkpoint::open(folder.path(), 5, "q").unwrap().get(samples[0].lambda),
            None
        );
    }
}
