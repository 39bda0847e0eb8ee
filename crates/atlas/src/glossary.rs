//! The glossary: one definition of each word that tables, help texts and JSON use.
//!
//! Help texts quote it, and `docs/glossary.md` is its [`page`]; a test holds that file to it.

/// A word with its definition, in Markdown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The word, with its symbol and the name of its column.
    pub word: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// Which commands print it, between backticks, and where.
    pub place: &'static str,
}

/// What holds for all entries.
pub const PREFACE: &str = "One definition of each word that tables, help texts and JSON use. N is the valence, eigenvalues are \
 those of the limit level's local matrix, `|x|` is a modulus.";

/// All entries, in the order of the page.
pub const ENTRIES: &[Entry] = &[
    Entry {
        word: "lambda, `subdominant`",
        meaning: "the eigenvalue of largest modulus after the dominant 1. The characteristic map is made of \
         its eigenvectors in Fourier block 1; a remark says where it is of another block or complex",
        place: "`spectrum`, `compare`; value of `dominant` in `verify`",
    },
    Entry {
        word: "mu, `subsubdominant`",
        meaning: "the eigenvalue of largest modulus below that of lambda",
        place: "`spectrum`",
    },
    Entry {
        word: "mu/lambda^2, `s`",
        meaning: "with moduli; 1: curvature is bounded and there is no flat spot. Not defined where block 1 \
         has no eigenvalue as large as lambda",
        place: "`compare`, `spectrum`; value of `bounded_curvature` in `verify`",
    },
    Entry {
        word: "gap",
        meaning: "`1 - mu/lambda`, with moduli",
        place: "`compare`",
    },
    Entry {
        word: "strict",
        meaning: "`1 - next/mu3`: mu3 is the smallest of the three eigenvalues of the quadratic terms (the \
         largest of the blocks 0, 2 and N-2 after 1 and lambda), next the largest of all others; not \
         defined where next is not below mu3",
        place: "`compare`; margin of `strict` in `verify`",
    },
    Entry {
        word: "hull",
        meaning: "the smallest weight that is not zero in the points of one level, its passes composed; \
         negative: the surface may leave the hull of its control points",
        place: "`compare`; margin of `hull` in `verify`",
    },
    Entry {
        word: "E",
        meaning: "the objective: over the disc of the characteristic map, the mean of the squared distance of \
         the second derivatives from the best constants, summed over the three second-order maps of \
         unit 5-ring norm (Ma, Wang and Ma 2023, Eqs. 11 to 20). **Unweighted** in `compare`; `total` \
         of `tune`, `objective` and `results/lambda`, and `E` of `tune --minimise`, is **weighted** \
         where the Gauss curvature has the wrong sign, unless `--unweighted` is given",
        place: "`compare`, `tune`, `objective`",
    },
    Entry {
        word: "K_m",
        meaning: "how far the Gauss curvature of the second-order maps reaches to the wrong side of zero, over \
         the same annulus",
        place: "`compare`",
    },
    Entry {
        word: "polar",
        meaning: "the variance of the lengths of the edges of the natural configuration within two rings of a \
         vertex (the face and one ring around a face), their mean being 1: 0 for the regular net",
        place: "`tune`",
    },
    Entry {
        word: "theta",
        meaning: "the angle at F between V and E in the natural configuration, **in degrees** where it is \
         printed. Certificates (`corner`) and files of `results/` hold radians",
        place: "`compare`, `tune`",
    },
    Entry {
        word: "multiplicity",
        meaning: "how often an eigenvalue is a root of the characteristic polynomial of the whole local \
         matrix: both of the blocks k and N-k counted",
        place: "`spectrum`",
    },
    Entry {
        word: "geometric",
        meaning: "the number of its independent eigenvectors, at most the multiplicity; fewer: it is defective",
        place: "`spectrum`",
    },
    Entry {
        word: "level",
        meaning: "a step of refinement, counted from 0. Levels from the limit level on are the same, and \
         govern continuity",
        place: "`spectrum`, `matrix`",
    },
    Entry {
        word: "ring, annulus",
        meaning: "control points with the same distance from the centre; patches between two rings",
        place: "[numbering.md](numbering.md)",
    },
];

impl Entry {
    /// Whether a command prints what the word names.
    fn is_of(&self, command: &str) -> bool {
        self.place.contains(&format!("`{command}`"))
    }

    /// The entry for a terminal: a paragraph.
    fn plain(&self) -> String {
        // a link is the words that it is on
        let place = match (self.place.strip_prefix('['), self.place.find("](")) {
            (Some(_), Some(end)) => &self.place[1..end],
            _ => self.place,
        };
        format!("{}: {} ({place})\n", self.word, self.meaning)
            .replace("**", "")
            .replace('`', "")
    }
}

/// The page `docs/glossary.md`.
pub fn page() -> String {
    let row = |e: &Entry| format!("| {} | {} | {} |\n", e.word, e.meaning, e.place);
    let rows: String = ENTRIES.iter().map(row).collect();
    format!("# Glossary\n\n{PREFACE}\n\n| word | meaning | where |\n|---|---|---|\n{rows}")
}

/// The entries for a terminal: all of them, or those of what a command prints.
pub fn plain(command: Option<&str>) -> String {
    let chosen = ENTRIES
        .iter()
        .filter(|e| command.is_none_or(|command| e.is_of(command)));
    format!(
        "{}\n\n{}",
        PREFACE.replace('`', ""),
        chosen.map(Entry::plain).collect::<String>()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_is_the_glossary() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/glossary.md");
        let stored = std::fs::read_to_string(path).unwrap();
        for (line, (stored, expected)) in stored.lines().zip(page().lines()).enumerate() {
            assert_eq!(stored, expected, "docs/glossary.md, line {}", line + 1);
        }
        assert_eq!(stored, page());
    }

    #[test]
    fn commands_have_their_words() {
        for (command, word) in [
            ("compare", "E: the objective"),
            ("compare", "in degrees"),
            ("spectrum", "mu, subsubdominant"),
            ("verify", "hull: the smallest weight"),
        ] {
            let text = plain(Some(command));
            assert!(text.contains(word) && !text.contains(['`', '*']), "{text}");
        }
        assert!(!plain(Some("verify")).contains("geometric:") && plain(None).contains("geometric:"));
    }
}
