//! `--format` and `-o`: in which format results are printed, and where to.

use crate::error::Error;
use crate::files;
use clap::{Args, ValueEnum};
use eigenring_atlas::table::Format;
use std::path::{Path, PathBuf};

/// The output format.
#[derive(Args, Clone, Copy, Debug)]
pub struct FormatOption {
    /// How results are printed; text by default
    #[arg(long, value_enum)]
    format: Option<FormatArg>,
}

/// The output format, and a file in place of standard output.
#[derive(Args, Clone, Debug)]
pub struct Output {
    #[command(flatten)]
    format: FormatOption,
    /// Write to a file, in the format that its extension names (.json, .csv, .tex, .txt); standard output by
    /// default
    #[arg(short = 'o', long = "output", value_name = "FILE")]
    out: Option<PathBuf>,
}

/// How wide a text is.
#[derive(Args, Clone, Copy, Debug)]
pub struct Wide {
    /// With text: all columns and digits, in lines that may be longer than 100 characters
    #[arg(long)]
    wide: bool,
}

impl Wide {
    /// Whether it was asked for, of a text.
    ///
    /// # Errors
    /// Another format, which has all columns anyway.
    pub fn of(self, format: Format) -> Result<bool, Error> {
        match (self.wide, format) {
            (true, Format::Json | Format::Csv | Format::Latex) => {
                Err(Error::usage("--wide has no meaning for this format", "--format text"))
            }
            (wide, _) => Ok(wide),
        }
    }
}

/// See [`Format`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum FormatArg {
    /// Columns for people; numbers to ten digits.
    #[default]
    Text,
    /// One JSON value, full precision.
    Json,
    /// Comma-separated values with a header, full precision.
    Csv,
    /// A LaTeX tabular; numbers to ten digits.
    Latex,
}

impl From<FormatArg> for Format {
    fn from(format: FormatArg) -> Format {
        match format {
            FormatArg::Text => Format::Text,
            FormatArg::Json => Format::Json,
            FormatArg::Csv => Format::Csv,
            FormatArg::Latex => Format::Latex,
        }
    }
}

/// Formats that file names tell apart.
pub trait Extension: Copy + PartialEq + ValueEnum {
    /// The extensions of the format's files, without the dot.
    fn extensions(self) -> &'static [&'static str];
}

impl Extension for FormatArg {
    fn extensions(self) -> &'static [&'static str] {
        match self {
            FormatArg::Text => &["txt"],
            FormatArg::Json => &["json"],
            FormatArg::Csv => &["csv"],
            FormatArg::Latex => &["tex"],
        }
    }
}

/// The format for a file: what its extension says, which a format that is given must not contradict; else the
/// one that is given.
///
/// # Errors
/// A format that contradicts the extension.
pub fn agreed<F: Extension>(given: Option<F>, out: Option<&Path>) -> Result<Option<F>, Error> {
    let extension = out
        .and_then(Path::extension)
        .map(|found| found.to_string_lossy().to_lowercase());
    let named = extension.and_then(|extension| {
        let named = F::value_variants().iter();
        named
            .copied()
            .find(|format| format.extensions().contains(&extension.as_str()))
    });
    match (given, named, out) {
        (Some(given), Some(named), Some(path)) if given != named => {
            let name = |format: F| {
                format
                    .to_possible_value()
                    .map_or(String::new(), |value| value.get_name().to_owned())
            };
            let endings: Vec<String> = given.extensions().iter().map(|ending| format!(".{ending}")).collect();
            Err(Error::usage(
                format!("--format {} disagrees with {}", name(given), path.display()),
                format!(
                    "--format {}, or a file that ends with {}",
                    name(named),
                    endings.join(", ")
                ),
            ))
        }
        (given, named, _) => Ok(named.or(given)),
    }
}

impl FormatOption {
    /// The format that was chosen.
    pub fn format(&self) -> Format {
        self.format.unwrap_or_default().into()
    }

    /// The format that was chosen, if one was.
    pub fn given(&self) -> Option<FormatArg> {
        self.format
    }
}

impl Output {
    /// The format of what is printed or written.
    ///
    /// # Errors
    /// A format that contradicts the file's extension.
    pub fn format(&self) -> Result<Format, Error> {
        Ok(agreed(self.format.given(), self.out.as_deref())?
            .unwrap_or_default()
            .into())
    }

    /// The file that was named.
    pub fn file(&self) -> Option<&Path> {
        self.out.as_deref()
    }

    /// The format of what is printed beside a file of another kind.
    pub fn printed(&self) -> Format {
        self.format.format()
    }

    /// Prints or writes what was made.
    ///
    /// # Errors
    /// What cannot be written.
    pub fn emit(&self, text: &str) -> Result<(), Error> {
        files::emit(self.out.as_deref(), text.as_bytes())
    }

    /// Prints, or writes to the file, what need not be in memory all at once.
    pub fn emit_by(&self, fill: &dyn Fn(&mut dyn std::io::Write) -> std::io::Result<()>) -> Result<(), Error> {
        files::emit_by(self.out.as_deref(), fill)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_names_the_format() {
        let format = |given, path: &str| agreed(given, Some(Path::new(path)));
        assert_eq!(format(None, "b.csv").unwrap(), Some(FormatArg::Csv));
        assert_eq!(format(None, "B.JSON").unwrap(), Some(FormatArg::Json));
        assert_eq!(format(Some(FormatArg::Latex), "b.tex").unwrap(), Some(FormatArg::Latex));
        assert_eq!(format(Some(FormatArg::Csv), "b.dat").unwrap(), Some(FormatArg::Csv));
        assert_eq!(format(None, "b").unwrap(), None);
        let error = format(Some(FormatArg::Json), "b.csv").unwrap_err().line();
        assert!(
            error.ends_with(
                "--format json disagrees with b.csv: accepted is --format csv, or a file that ends with .json"
            ),
            "{error}"
        );
    }
}
