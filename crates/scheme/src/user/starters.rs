//! The built-in families as scheme files with formulas: what a scheme of one's own can start from.

/// A built-in family as a scheme file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Starter {
    /// The family, in the words of [`Spec`](crate::Spec), without the parameters that the file has itself.
    pub like: &'static str,
    /// The file.
    pub text: &'static str,
}

/// All of them, in the order of the registry.
pub fn starters() -> &'static [Starter] {
    macro_rules! starter {
        ($like:literal, $file:literal) => {
            Starter {
                like: $like,
                text: include_str!(concat!("../../data/formulas/", $file)),
            }
        };
    }
    &[
        starter!("catmull-clark", "catmull-clark.toml"),
        starter!("doo-sabin", "doo-sabin.toml"),
        starter!("doo-sabin:uniform", "doo-sabin-uniform.toml"),
        starter!("lambda", "lambda.toml"),
        starter!("tension:order=3", "tension-3.toml"),
        starter!("stam:order=6", "stam-6.toml"),
        starter!("morin", "morin.toml"),
    ]
}
