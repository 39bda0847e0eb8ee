//! **Claim**: a scheme written down in TOML is the same scheme as the built-in one: same local matrix, same
//! spectrum. **Oracle**: the built-in constructors. **Input**: the files in `data/schemes/`, which serve as
//! examples for users.

use eigenring_scheme::families::{catmull_clark, doo_sabin, tension};
use eigenring_scheme::user::{Reading, UserScheme};
use eigenring_scheme::{Error, Scheme};
use eigenring_spectral::{LocalSystem, local_matrix};
use eigenring_tests::{Comparison, by_block};

fn compare(text: &str, valences: &[usize], built_in: impl Fn(usize) -> Result<Scheme<f64>, Error>) {
    let user = UserScheme::parse(text, "unnamed", Reading::default()).unwrap();
    assert_eq!(user.valences().collect::<Vec<_>>(), valences);
    let mut matrices = Comparison::new("entries of the local matrix", 1e-15);
    let mut spectra = Comparison::new("eigenvalues", 1e-14);
    for &n in valences {
        let (ours, theirs) = (user.scheme::<f64>(n).unwrap(), built_in(n).unwrap());
        assert_eq!(ours.degree(), theirs.degree());
        assert_eq!(ours.lattice(), theirs.lattice());
        assert!(ours.limit().is_rotation_symmetric() && ours.limit().has_mirror());
        assert_eq!(ours.closed_rings(), theirs.closed_rings());
        let rings = theirs.closed_rings().unwrap();
        for rings in [rings, rings + 1] {
            let [a, b] = [&ours, &theirs].map(|scheme| local_matrix(scheme.limit(), rings).unwrap());
            for (i, (&a, &b)) in a.entries().iter().zip(b.entries()).enumerate() {
                matrices.check(format!("{}, N = {n}, {rings} rings, entry {i}", user.name()), a, b);
            }
        }
        let [ours, theirs] = [&ours, &theirs].map(|scheme| {
            let spectrum = LocalSystem::new(scheme.limit(), rings).unwrap().spectrum().unwrap();
            let mut values = by_block(&spectrum, n);
            values.sort_by(|a, b| a.1.cmp(&b.1).then(b.0.re.total_cmp(&a.0.re)));
            values
        });
        assert_eq!(ours.len(), theirs.len());
        for ((ours, k), (theirs, same)) in ours.into_iter().zip(theirs) {
            assert_eq!(k, same);
            spectra.check(format!("{}, N = {n}, block {k}, re", user.name()), ours.re, theirs.re);
            spectra.check(format!("{}, N = {n}, block {k}, im", user.name()), ours.im, theirs.im);
        }
    }
    matrices.finish();
    spectra.finish();
    let absent = valences.iter().max().unwrap() + 1;
    assert!(matches!(user.scheme::<f64>(absent), Err(Error::NoSuchValence { .. })));
}

#[test]
fn catmull_clark_as_one_ring() {
    let text = include_str!("../data/schemes/catmull-clark.toml");
    compare(text, &[3, 4, 5, 6, 8, 20], catmull_clark);
}

#[test]
fn doo_sabin_as_stencils() {
    let text = include_str!("../data/schemes/doo-sabin.toml");
    compare(text, &[3, 4, 6], doo_sabin);
}

#[test]
fn tension_of_order_six_as_three_passes() {
    let text = include_str!("../data/schemes/tension-order-6.toml");
    compare(text, &[5], |n| tension(n, 6, 1.0));
}

/// A changed weight is a changed scheme: the comparison above is able to fail.
#[test]
#[should_panic(expected = "entries of the local matrix")]
fn another_weight_is_noticed() {
    let text = include_str!("../data/schemes/tension-order-6.toml").replace("\"2/5\"", "\"0.4000000001\"");
    compare(&text, &[5], |n| tension(n, 6, 1.0));
}
