//! Names that were meant where others were typed.

/// Words for an error message, such as ` (did you mean 'catmull-clark'?)`: the name that is nearest to what
/// was given, if it is so near that it may be meant. At most a third of its letters are missing, exchanged
/// or too many, or it begins with all that was given.
pub fn did_you_mean<'a>(given: &str, names: impl IntoIterator<Item = &'a str>) -> String {
    let given = given.to_lowercase();
    let distance = |name: &str| match name.strip_prefix(given.as_str()) {
        Some(rest) if given.len() > 2 && !rest.is_empty() => 1,
        _ => strsim::damerau_levenshtein(&given, name),
    };
    let near = names
        .into_iter()
        .map(|name| (distance(name), name))
        .filter(|(distance, name)| *distance <= (name.chars().count() / 3).max(1) && *distance < name.chars().count())
        .min_by_key(|(distance, _)| *distance);
    near.map_or(String::new(), |(_, name)| format!(" (did you mean '{name}'?)"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_names_only() {
        let names = ["catmull-clark", "doo-sabin", "u0", "order"];
        for (given, meant) in [
            ("catmul-clark", "catmull-clark"),
            ("Catmull-Clark", "catmull-clark"),
            ("catmull", "catmull-clark"),
            ("doosabin", "doo-sabin"),
            ("odrer", "order"),
            ("u", "u0"),
        ] {
            assert_eq!(did_you_mean(given, names), format!(" (did you mean '{meant}'?)"));
        }
        for given in ["loop", "", "x", "butterfly"] {
            assert_eq!(did_you_mean(given, names), "", "{given}");
        }
    }
}
