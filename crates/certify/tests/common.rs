//! Schemes and statuses that several tests ask for.

use eigenring_certify::{Certificate, Check, Input, Statement, Status, certify};
use eigenring_scheme::Spec;
use eigenring_scheme::user::Reading;

pub fn of_spec(spec: &str, valence: usize) -> Certificate {
    let spec: Spec = spec.parse().unwrap();
    certify(Input::from_spec(&spec, valence).unwrap(), valence).unwrap()
}

pub fn status(certificate: &Certificate, name: Statement) -> Status {
    certificate.check(name).unwrap().status
}

/// A one-ring scheme file; weights as they are written.
pub fn one_ring(valence: usize, weights: &[(&str, &str)]) -> Input {
    let lines: String = weights
        .iter()
        .map(|(name, value)| format!("{name} = \"{value}\"\n"))
        .collect();
    Input::Toml {
        text: format!("kind = \"one-ring\"\nname = \"planted\"\n[[valence]]\nn = {valence}\n{lines}"),
        name: "planted".into(),
        reading: Reading::Balanced,
        parameters: Default::default(),
    }
}

/// Catmull-Clark at valence 5 with some weights replaced.
pub fn altered(changes: &[(&str, &str)]) -> Input {
    let mut weights = vec![
        ("f1", "1/4"),
        ("f2", "1/4"),
        ("f3", "1/4"),
        ("d1", "3/8"),
        ("d2", "3/8"),
        ("e1", "1/16"),
        ("e2", "1/16"),
        ("alpha", "3/10"),
        ("beta", "1/20"),
    ];
    for &(name, value) in changes {
        weights.iter_mut().find(|weight| weight.0 == name).unwrap().1 = value;
    }
    one_ring(5, &weights)
}

pub fn witness(check: &Check) -> &str {
    &check.witness.as_ref().expect("a refutation has a witness").text
}
