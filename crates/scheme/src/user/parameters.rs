//! The parameters of a scheme file.

use crate::Number;

/// A number that the formulas of a file use by name.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The name.
    pub name: String,
    /// The value that it has unless it is set.
    pub default: Number,
    /// The least and the largest accepted value, if there are any.
    pub range: Option<[Number; 2]>,
    /// What it means, in the words of the file.
    pub doc: String,
    /// The value that it has.
    pub value: Number,
}

impl Parameter {
    /// The value, if it is in the range.
    ///
    /// # Errors
    /// Says the value and the range.
    pub(super) fn check(&self, value: Number) -> Result<Number, String> {
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
