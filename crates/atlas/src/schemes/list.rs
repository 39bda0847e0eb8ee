//! Lists of schemes on a command line.

use super::SchemeName;
use std::path::Path;
use std::str::FromStr;

/// Splits a list of specs at commas that are not between quotes. A piece `name=value` continues the spec
/// before it, any other begins a new one.
fn split(list: &str) -> Vec<String> {
    let mut quoted = false;
    let pieces = list.split(|letter| {
        quoted ^= letter == '"';
        letter == ',' && !quoted
    });
    let mut specs: Vec<String> = Vec::new();
    for piece in pieces {
        let continues = piece.split(['"', ':']).next().is_some_and(|start| start.contains('='));
        match specs.last_mut() {
            Some(spec) if continues => {
                spec.push(',');
                spec.push_str(piece);
            }
            _ => specs.push(piece.to_owned()),
        }
    }
    specs
}

/// The specs of a list; a path with commas is one by itself if there is such a file.
pub(crate) fn specs(text: &str) -> Vec<String> {
    let alone = text.strip_prefix("file:").is_some_and(|path| Path::new(path).is_file());
    if alone { vec![text.to_owned()] } else { split(text) }
}

/// Schemes as a list `SPEC,SPEC,..`. A piece `key=value` continues the spec before it; a path with commas
/// stands in quotes, or is a list by itself.
#[derive(Clone, Debug)]
pub struct SchemeList(pub Vec<SchemeName>);

impl FromStr for SchemeList {
    type Err = eigenring_scheme::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let schemes = specs(text).iter().map(|spec| spec.parse()).collect::<Result<_, _>>();
        schemes.map(SchemeList)
    }
}

#[cfg(test)]
mod tests {
    use super::super::SchemeFile;
    use super::*;
    use eigenring_scheme::Number;

    #[test]
    fn lists_of_specs_keep_parameters_together() {
        assert_eq!(
            split("catmull-clark,tension:order=6,u0=2,lambda:lambda=0.5,f2=0.2,f3=0.1,file:a.toml,lambda:optimal"),
            [
                "catmull-clark",
                "tension:order=6,u0=2",
                "lambda:lambda=0.5,f2=0.2,f3=0.1",
                "file:a.toml",
                "lambda:optimal"
            ]
        );
        assert_eq!(
            split("file:\"a,b.toml\",file:\"c=d,e.toml\",x=1,stam:order=4"),
            ["file:\"a,b.toml\"", "file:\"c=d,e.toml\",x=1", "stam:order=4"]
        );
        let name: SchemeName = "file:\"a,b.toml\"".parse().unwrap();
        let file = |path: &str, values: Vec<(String, Number)>| {
            let path = path.into();
            SchemeName::File(SchemeFile { path, values })
        };
        assert_eq!(name, file("a,b.toml", vec![]));
        let name: SchemeName = "file:\"a,b.toml\",x=1/3,y=-2".parse().unwrap();
        let values = vec![
            ("x".to_owned(), "1/3".parse().unwrap()),
            ("y".to_owned(), "-2".parse().unwrap()),
        ];
        assert_eq!(name, file("a,b.toml", values));
        for bad in ["file:a.toml,b", "file:a.toml,b=c", "file:a.toml,b=1/0"] {
            let message = bad.parse::<SchemeName>().unwrap_err().to_string();
            assert!(message.contains("accepted are file:SCHEME.toml"), "{message}");
        }
    }
}
