//! The parameters of a scheme file.

use crate::Number;
use std::collections::BTreeMap;

/// A number that the formulas of a file use by name.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The name.
    pub name: String,
    /// The value that it has unless another one is given.
    pub default: Number,
    /// The values of their own that the file gives for single valences.
    pub except: BTreeMap<usize, Number>,
    /// The least and the largest accepted value, if there are any.
    pub range: Option<[Number; 2]>,
    /// What it means, in the words of the file.
    pub doc: String,
    /// The value that it is set to, at all valences.
    pub set: Option<Number>,
}

impl Parameter {
    /// The value at a valence: the one that is set, else the file's for this valence, else the default.
    pub fn at(&self, valence: usize) -> &Number {
        let declared = || self.except.get(&valence).unwrap_or(&self.default);
        self.set.as_ref().unwrap_or_else(declared)
    }

    /// The value that it is set to, if that makes a difference at any valence.
    pub fn changed(&self) -> Option<&Number> {
        let declared = || std::iter::once(&self.default).chain(self.except.values());
        self.set.as_ref().filter(|&set| declared().any(|known| known != set))
    }

    /// The value, if it is in the range.
    ///
    /// # Errors
    /// Says the value and the range.
    pub fn check(&self, value: Number) -> Result<Number, String> {
        match &self.range {
            Some([least, most]) if value.rational() < least.rational() || value.rational() > most.rational() => {
                let name = &self.name;
                Err(format!(
                    "{name} = {value} is out of range: accepted is {least} <= {name} <= {most}"
                ))
            }
            _ => Ok(value),
        }
    }
}
