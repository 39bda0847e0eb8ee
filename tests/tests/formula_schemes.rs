//! **Claim**: the built-in families, written down as formulas, are the same schemes: same matrices at every
//! level, same derived facts, and word for word the same proofs. **Oracle**: the built-in constructors.
//! **Input**: the files that users start from, `crates/scheme/data/formulas`.

use eigenring_certify::{Certificate, Input, certify};
use eigenring_scheme::user::{Reading, UserScheme, starters};
use eigenring_scheme::{Number, Scheme, Spec};
use eigenring_spectral::local_matrix;
use eigenring_tests::Comparison;

fn starter(like: &str) -> &'static str {
    let found = starters().iter().find(|starter| starter.like == like);
    found.unwrap_or_else(|| panic!("no file for {like}")).text
}

fn file(like: &str, values: &[(&str, &str)]) -> UserScheme {
    let values: Vec<(&str, Number)> = values
        .iter()
        .map(|(name, value)| (*name, value.parse().unwrap()))
        .collect();
    let scheme = UserScheme::parse(starter(like), "unnamed", Reading::default()).unwrap();
    scheme.with(&values).unwrap()
}

/// The levels of both, the leading ones too, on one ring more than needed.
fn compare(matrices: &mut Comparison, ours: &Scheme<f64>, theirs: &Scheme<f64>) {
    let n = theirs.valence();
    let facts = |scheme: &Scheme<f64>| {
        let limit = scheme.limit();
        (
            scheme.degree(),
            scheme.lattice(),
            limit.symmetry(),
            limit.closed_rings().unwrap(),
        )
    };
    assert_eq!(facts(ours), facts(theirs), "{}, N = {n}", ours.name());
    assert_eq!(ours.leading().len(), theirs.leading().len(), "{}, N = {n}", ours.name());
    for index in 0..=theirs.leading().len() {
        let rings = theirs.level(index).closed_rings().unwrap() + 1;
        assert_eq!(ours.level(index).symmetry(), theirs.level(index).symmetry());
        let [a, b] = [ours, theirs].map(|scheme| local_matrix(scheme.level(index), rings).unwrap());
        for (i, (&a, &b)) in a.entries().iter().zip(b.entries()).enumerate() {
            matrices.check(format!("{}, N = {n}, level {index}, entry {i}", ours.name()), a, b);
        }
    }
}

#[test]
fn every_family_with_a_formula_file_is_its_file() {
    let mut matrices = Comparison::new("entries of the local matrix", 4e-15);
    let mut compared = Vec::new();
    for (like, values, spec) in [
        ("catmull-clark", vec![], "catmull-clark"),
        ("doo-sabin", vec![], "doo-sabin"),
        ("doo-sabin:uniform", vec![], "doo-sabin:uniform"),
        ("tension:order=3", vec![], "tension:order=3"),
        ("tension:order=3", vec![("u0", "0.25")], "tension:order=3,u0=0.25"),
        ("stam:order=6", vec![], "stam:order=6"),
        ("morin", vec![("u0", "2")], "morin:u0=2"),
        ("morin", vec![("u0", "-0.5")], "morin:u0=-0.5"),
        (
            "lambda",
            vec![("lambda", "0.55"), ("s", "1.25"), ("p", "0.3"), ("q", "0.1")],
            "lambda:lambda=0.55,s=1.25,f2=0.3,f3=0.1",
        ),
    ] {
        let (ours, spec): (UserScheme, Spec) = (file(like, &values), spec.parse().unwrap());
        for n in (3..=12).chain([16, 33]) {
            if like == "lambda" && !(4..=12).contains(&n) {
                // these parameters give weights beyond 10, in which doubles lose digits
                continue;
            }
            let theirs = match spec {
                // at valence 4 f3 is mu whatever is given
                Spec::Lambda { .. } if n == 4 => "lambda:lambda=0.55,s=1.25,f2=0.3,f3=0.378125".parse().unwrap(),
                ref spec => spec.clone(),
            };
            let (ours, theirs) = (ours.scheme(n).unwrap(), theirs.scheme(n).unwrap());
            compare(&mut matrices, &ours, &theirs);
        }
        compared.push(like);
    }
    matrices.finish();
    for starter in starters() {
        assert!(compared.contains(&starter.like), "{} is not compared", starter.like);
    }
}

/// Statements, statuses, margins and enclosures, digit by digit.
fn same_proofs(like: &str, spec: &str, valence: usize) {
    let certificate = |input: Input| -> Certificate { certify(input, valence).unwrap() };
    let ours = certificate(Input::Toml {
        text: starter(like).to_owned(),
        name: "unnamed".to_owned(),
        reading: Reading::default(),
        parameters: Default::default(),
    });
    let theirs = certificate(Input::Family { spec: spec.to_owned() });
    let [a, b] = [&ours, &theirs].map(|certificate| format!("{:?} {:?}", certificate.degree, certificate.checks));
    assert_eq!(a, b, "{like}, N = {valence}");
    assert!(ours.to_json().unwrap().contains("2*cos(2*pi*k/n)") || like != "doo-sabin");
}

/// `scripts/formula-proofs.sh` does it at all of N = 3..64.
#[test]
fn formulas_are_proven_as_the_built_in_families_are() {
    for n in [3, 4, 5, 6, 7, 12, 19] {
        same_proofs("doo-sabin", "doo-sabin", n);
        same_proofs("catmull-clark", "catmull-clark", n);
    }
}

/// A changed formula is a changed scheme: the comparisons above are able to fail.
#[test]
fn another_formula_is_noticed() {
    let text = starter("doo-sabin").replace("(3 + 2*cos", "(3.000000001 + 2*cos");
    let changed = UserScheme::parse(&text, "changed", Reading::default()).unwrap();
    let built_in = "doo-sabin".parse::<Spec>().unwrap().scheme::<f64>(5).unwrap();
    let [a, b] = [&changed.scheme(5).unwrap(), &built_in].map(|scheme| local_matrix(scheme.limit(), 1).unwrap());
    let largest = a
        .entries()
        .iter()
        .zip(b.entries())
        .map(|(a, b): (&f64, &f64)| (a - b).abs());
    assert!(largest.fold(0.0, f64::max) > 1e-11);
    let proof = certify(
        Input::Toml {
            text,
            name: "changed".to_owned(),
            reading: Reading::default(),
            parameters: Default::default(),
        },
        5,
    );
    let row_sums = proof.unwrap().checks[0].clone();
    assert_eq!(
        (row_sums.name.name(), row_sums.status.to_string()),
        ("row_sums", "refuted".to_owned())
    );
}
