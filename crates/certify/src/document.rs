//! Certificates as documents: what the kinds of them have in common when they are written, read and compared
//! with their text.
//!
//! A document is JSON with a version of its format and a digest of everything else in it. The digest detects
//! accidents; see [`certificate`](crate::certificate) on why that is all it needs to do.

use crate::Error;
use serde::{Deserialize, Serialize};

/// Name and version of the tool, as documents record it.
pub(crate) fn tool() -> String {
    format!("eigenring {}", env!("CARGO_PKG_VERSION"))
}

/// A kind of document.
pub trait Document: Clone + Serialize + for<'de> Deserialize<'de> {
    /// The version of the format that is read and written.
    const VERSION: u32;

    /// The stored digest.
    fn digest(&mut self) -> &mut String;

    /// The digest of everything but the digest: FNV-1a over compact JSON, as 16 hexadecimal digits.
    fn computed_digest(&self) -> String {
        let mut bare = self.clone();
        bare.digest().clear();
        let text = serde_json::to_string(&bare).unwrap_or_default();
        let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        });
        format!("{hash:016x}")
    }

    /// The document with its digest.
    fn signed(mut self) -> Self {
        *self.digest() = self.computed_digest();
        self
    }

    /// The document as indented JSON.
    fn written(&self) -> Result<String, Error> {
        let mut text = serde_json::to_string_pretty(self).map_err(syntax)?;
        text.push('\n');
        Ok(text)
    }

    /// The document as JSON on one line: evidence is for the checks to read, and takes a third of the room of
    /// indented JSON.
    fn on_one_line(&self) -> Result<String, Error> {
        Ok(serde_json::to_string(self).map_err(syntax)? + "\n")
    }

    /// Reads a document, whatever its digest says.
    fn read(text: &str) -> Result<Self, Error> {
        /// Read before the rest, so that another format is named as such.
        #[derive(Deserialize)]
        struct Header {
            version: u32,
        }
        let Header { version: found } = serde_json::from_str(text).map_err(syntax)?;
        let accepted = Self::VERSION;
        if found != accepted {
            return Err(Error::Version { found, accepted });
        }
        serde_json::from_str(text).map_err(syntax)
    }

    /// Whether a text is what is written for the document: indented, or on one line.
    fn is_text(&self, text: &str) -> Result<bool, Error> {
        Ok(text == self.on_one_line()? || text == self.written()?)
    }
}

fn syntax(error: serde_json::Error) -> Error {
    // the place is told apart
    let message = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    Error::Syntax {
        line: error.line().max(1),
        column: error.column().max(1),
        message: message.strip_suffix(&place).unwrap_or(&message).to_owned(),
    }
}
