//! `eigenring report`: one page about a scheme.

use crate::args::{OneScheme, tuner};
use crate::error::Error;
use crate::files;
use crate::threads::Threads;
use crate::valences::{self, Valences};
use clap::Args;
use eigenring_atlas::report::page;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Write one page about a scheme: its formulas, proofs, spectra, limit stencils and maps.
///
/// The page is one HTML file that needs no other: formulas are MathML, figures SVG. It says what is proven at
/// each valence, with margins and witnesses, gives tables to be copied as CSV and LaTeX, compares the scheme
/// with Catmull-Clark, and names the commands that print each part. What has no meaning for the scheme is
/// said in a line.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  eigenring report --scheme catmull-clark -N 3..12 -o page.html\n  eigenring report --scheme file:my.toml --set a=1.4 -N 3..8 -o my.html"
)]
pub struct Arguments {
    #[command(flatten)]
    scheme: OneScheme,
    /// Valences: numbers and ranges
    #[arg(
        short = 'N',
        long,
        visible_alias = "valence",
        value_name = "LIST",
        default_value = "3..12",
        value_parser = valences::list,
        allow_hyphen_values = true
    )]
    valences: Valences,
    #[command(flatten)]
    threads: Threads,
    /// The file to write, with a name that ends with .html; standard output by default
    #[arg(short, long, value_name = "FILE", value_parser = html)]
    output: Option<PathBuf>,
}

/// A file whose name does not say that it is something else.
fn html(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let extension = path.extension().map(|found| found.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        None | Some("html" | "htm") => Ok(path),
        Some(_) if !eigenring_atlas::files::is_replaced(&path) => Ok(path),
        Some(other) => Err(format!(
            "a page is no .{other} file: accepted is a name that ends with .html"
        )),
    }
}

impl Arguments {
    pub fn run(self) -> Result<ExitCode, Error> {
        let scheme = self.scheme.name()?;
        self.threads.start()?;
        if let Some(path) = self
            .output
            .as_deref()
            .filter(|path| eigenring_atlas::files::is_replaced(path))
        {
            // before long work is done for it
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
            let folder = folder.unwrap_or(Path::new("."));
            files::check_writable(folder, folder)?;
        }
        let text = page(&scheme, self.valences.closed()?, &tuner())?;
        files::emit(self.output.as_deref(), text.as_bytes())?;
        Ok(ExitCode::SUCCESS)
    }
}
