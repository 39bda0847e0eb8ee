//! Names of schemes on meshes, where a name may say in how many smoothing steps creases act:
//! `tension:order=8,u0=1,cs=1`.

use crate::schemes::{SchemeName, specs};
use eigenring_scheme::Error;
use std::str::FromStr;

/// A scheme on a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct OnMesh {
    /// The scheme.
    pub name: SchemeName,
    /// In how many smoothing steps of a level creases act that do not say so themselves; all if none.
    pub steps: Option<usize>,
}

impl From<SchemeName> for OnMesh {
    fn from(name: SchemeName) -> Self {
        OnMesh { name, steps: None }
    }
}

impl FromStr for OnMesh {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let without = || text.parse().map(|name| OnMesh { name, steps: None });
        let Some((family, parameters)) = text.split_once(':').filter(|(family, _)| *family != "file") else {
            return without();
        };
        let (given, others): (Vec<&str>, Vec<&str>) = parameters
            .split(',')
            .partition(|piece| piece.trim_start().starts_with("cs="));
        let Some(&given) = given.last() else {
            return without();
        };
        let name: SchemeName = match others.is_empty() {
            true => family.parse()?,
            false => format!("{family}:{}", others.join(",")).parse()?,
        };
        let refuse = |reason: String, accepted: String| {
            Err(Error::Spec {
                spec: text.to_owned(),
                reason,
                accepted,
            })
        };
        let order = match &name {
            SchemeName::Spec(spec) => spec.order_and_tension().map(|(order, _)| order),
            _ => None,
        };
        let Some(order) = order.filter(|order| order % 2 == 0) else {
            let accepted = "cs with even orders of tension and stam, and with morin".to_owned();
            return refuse(
                "there are no smoothing steps in which creases could act".to_owned(),
                accepted,
            );
        };
        let full = (order / 2).saturating_sub(1);
        let value = given.trim_start().trim_start_matches("cs=").trim();
        match value.parse::<usize>().ok().filter(|&steps| steps <= full) {
            Some(steps) => Ok(OnMesh {
                name,
                steps: Some(steps),
            }),
            None => refuse(
                format!("cs is {value}"),
                format!("cs=0 to cs={full} with order {order}"),
            ),
        }
    }
}

impl OnMesh {
    /// What the scheme is called, given the name of its definition.
    pub fn called(&self, name: &str) -> String {
        let comma = if name.contains(':') { ',' } else { ':' };
        match self.steps {
            Some(steps) => format!("{name}{comma}cs={steps}"),
            None => name.to_owned(),
        }
    }
}

/// Schemes on meshes as a list, as [`SchemeList`](crate::schemes::SchemeList).
#[derive(Clone, Debug)]
pub struct OnMeshList(pub Vec<OnMesh>);

impl FromStr for OnMeshList {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let schemes = specs(text).iter().map(|spec| spec.parse()).collect::<Result<_, _>>();
        schemes.map(OnMeshList)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_read_and_written() {
        for text in [
            "tension:order=8,u0=0.5,cs=1",
            "stam:order=6,cs=0",
            "catmull-clark",
            "lambda:optimal",
        ] {
            let scheme: OnMesh = text.parse().unwrap();
            let SchemeName::Spec(spec) = &scheme.name else {
                panic!("{text}")
            };
            assert_eq!(scheme.called(&spec.to_string()), text);
        }
        let list: OnMeshList = "tension:order=8,u0=1,cs=1,catmull-clark,morin:u0=0.3,cs=1"
            .parse()
            .unwrap();
        assert_eq!(
            list.0.iter().map(|scheme| scheme.steps).collect::<Vec<_>>(),
            [Some(1), None, Some(1)]
        );
        for text in [
            "tension:order=8,cs=4",
            "tension:order=8,cs=-1",
            "tension:order=7,cs=1",
            "catmull-clark:cs=1",
        ] {
            let error = text.parse::<OnMesh>().unwrap_err().to_string();
            assert!(error.contains("accepted") && error.contains("cs"), "{text}: {error}");
        }
    }
}
