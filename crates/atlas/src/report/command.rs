//! The commands that print what a page shows, as they are typed into a shell.

use super::Topic;
use crate::schemes::SchemeName;

/// Quotes a word for a shell where it needs it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./:=,+@%".contains(c);
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', "'\\''")),
    }
}

/// The scheme as an argument.
fn scheme(name: &SchemeName) -> String {
    match name {
        SchemeName::Spec(spec) => spec.to_string(),
        SchemeName::NonUniform(scheme) => scheme.to_string(),
        SchemeName::File(file) => {
            let path = file.path.display().to_string();
            let path = if path.contains(',') {
                format!("\"{path}\"")
            } else {
                path
            };
            let values = file.values.iter().map(|(name, value)| format!(",{name}={value}"));
            format!("file:{path}{}", values.collect::<String>())
        }
    }
}

/// Ascending valences as ranges: `3,5..8`.
pub(super) fn ranges(valences: &[usize]) -> String {
    let runs = valences.chunk_by(|a, b| a + 1 == *b);
    let texts = runs.filter_map(|run| match run {
        [] => None,
        [one] => Some(one.to_string()),
        [first, .., last] => Some(format!("{first}..{last}")),
    });
    texts.collect::<Vec<_>>().join(",")
}

/// A command about the scheme at all valences of the page.
pub(super) fn of(command: &str, topic: &Topic, rest: &str) -> String {
    let scheme = quoted(&scheme(topic.name));
    let line = format!(
        "eigenring {command} --scheme {scheme} -N {} {rest}",
        ranges(topic.valences)
    );
    line.trim_end().to_owned()
}

/// A command about the scheme at one valence.
pub(super) fn at(command: &str, topic: &Topic, valence: usize, rest: &str) -> String {
    let line = format!(
        "eigenring {command} --scheme {} -N {valence} {rest}",
        quoted(&scheme(topic.name))
    );
    line.trim_end().to_owned()
}

/// The figure of some valences.
pub(super) fn plot(figure: &str, topic: &Topic, valences: &[usize]) -> String {
    let scheme = quoted(&scheme(topic.name));
    format!("eigenring plot {figure} --schemes {scheme} -N {}", ranges(valences))
}

/// The scheme beside Catmull-Clark, or by itself.
pub(super) fn compare(topic: &Topic, alone: bool) -> String {
    let beside = if alone { "" } else { ",catmull-clark" };
    let schemes = quoted(&format!("{}{beside}", scheme(topic.name)));
    format!("eigenring compare --schemes {schemes} -N {}", ranges(topic.valences))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_survive_a_shell() {
        assert_eq!(quoted("tension:order=6,u0=0.5"), "tension:order=6,u0=0.5");
        assert_eq!(quoted("file:my scheme.toml"), "'file:my scheme.toml'");
        assert_eq!(quoted("it's"), "'it'\\''s'");
        assert_eq!(ranges(&[3, 5, 6, 7, 9]), "3,5..7,9");
        let name: SchemeName = "file:\"a,b.toml\",x=0.5".parse().unwrap();
        assert_eq!(scheme(&name), "file:\"a,b.toml\",x=1/2");
        assert_eq!(scheme(&name).parse::<SchemeName>(), Ok(name));
    }
}
