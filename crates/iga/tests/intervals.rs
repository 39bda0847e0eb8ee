//! The spaces of NURSS and of eigen-polyhedra: at equal intervals those of Catmull-Clark, linear functions at
//! unequal ones, rates.

use crate::common::{natural, nitsche, rules, warped};
use eigenring_iga::{Domain, Ends, Error, Norms, Options, Problem, Study, solution};
use eigenring_nonuniform::{Outside, Scheme};
use eigenring_surface::shapes::uneven_fan;
use eigenring_surface::{Mesh, shapes};

fn errors(mesh: &Mesh, scheme: Scheme, name: &str, levels: std::ops::Range<usize>, options: &Options) -> Vec<Norms> {
    let u = solution::named(name).expect("a solution");
    let study = Study::with_intervals(mesh, scheme, Outside::Error, Domain::Planar).expect("a study");
    let error = |level| {
        study
            .level(level, Problem::Poisson, &u, options)
            .expect("an outcome")
            .error
    };
    levels.map(error).collect()
}

/// Ratios of the spokes in turn; eigen-polyhedra exist for smaller ones.
const SETS: [(Scheme, &[f64]); 4] = [
    (Scheme::Nurss, &[1.0]),
    (Scheme::Nurss, &[3.0, 1.0, 1.7]),
    (Scheme::EigenPolyhedron, &[1.0]),
    (Scheme::EigenPolyhedron, &[1.5, 1.0]),
];

#[test]
fn equal_intervals_make_the_spaces_of_catmull_clark() {
    let rules = rules("catmull-clark");
    let u = solution::named("exp").expect("a solution");
    for n in [3, 6] {
        let mesh = shapes::fan(n);
        // level 0 is the net after one level
        let study = Study::new(&mesh, &rules, Domain::Planar).expect("a study");
        let options = Options {
            gauss: 8,
            ..Options::default()
        };
        let expected = [2, 3].map(|level| study.level(level, Problem::Poisson, &u, &options));
        let found = errors(&mesh, Scheme::Nurss, "exp", 1..3, &options);
        for (found, expected) in found.iter().zip(expected) {
            let expected = expected.expect("an outcome").error;
            for (a, b) in [
                (found.l2, expected.l2),
                (found.h1, expected.h1),
                (found.h2, expected.h2),
            ] {
                assert!((a / b - 1.0).abs() < 1e-7, "N = {n}: {found:?} for {expected:?}");
            }
        }
    }
}

#[test]
fn linear_functions_are_reproduced_at_vertices_with_intervals() {
    for (n, (scheme, set)) in [3, 5, 8].into_iter().flat_map(|n| SETS.map(|set| (n, set))) {
        let mesh = warped(uneven_fan(n, set));
        for (levels, options) in [(0..2, Options::default()), (0..1, natural()), (0..1, nitsche())] {
            for e in errors(&mesh, scheme, "lin", levels.clone(), &options) {
                // two subdominant eigenvalues, as NURSS has them, flatten annuli, so that rounding in second
                // derivatives grows as the cube of their ratio
                assert!(
                    e.l2 <= 1e-12 && e.h1 <= 1e-10 && e.h2 <= 1e-5,
                    "{scheme}, N = {n}, {set:?}, {options:?}: {e:?}"
                );
            }
        }
    }
}

/// Without depth the corner is missed, and a scaled tail stands for part of it.
#[test]
fn few_annuli_fail_the_patch_test() {
    let h1 = |scaled: bool| {
        let options = Options {
            depth: Some(6),
            scaled,
            ..Options::default()
        };
        errors(&uneven_fan(5, SETS[3].1), SETS[3].0, "lin", 0..1, &options)[0].h1
    };
    assert!(h1(false) > 1e-5, "{:e}", h1(false));
    assert!(h1(true) < 0.1 * h1(false), "{:e} for {:e}", h1(true), h1(false));
}

/// Eigen-polyhedra have one subdominant eigenvalue, that of Catmull-Clark, and NURSS mostly two.
#[test]
fn rates_are_predicted_where_annuli_keep_their_shape() {
    let mesh = uneven_fan(6, &[1.5, 1.0]);
    let study = |mesh: &Mesh, scheme| {
        let study = Study::with_intervals(mesh, scheme, Outside::Error, Domain::Planar).expect("a study");
        study.predicted(Problem::Poisson, Ends::Open)
    };
    let [l2, ..] = study(&mesh, Scheme::EigenPolyhedron);
    let l2 = l2.expect("predicted");
    assert!((l2 - 2.36).abs() < 1e-3, "{l2}");
    let e = errors(&mesh, Scheme::EigenPolyhedron, "exp", 1..3, &Options::default());
    let rate = (e[0].l2 / e[1].l2).log2();
    assert!((rate - l2).abs() < 0.1, "{rate} for {l2}");
    assert_eq!(study(&uneven_fan(5, &[3.0, 1.0]), Scheme::Nurss), [None; 4]);
}

#[test]
fn what_has_no_elements_with_intervals_is_refused() {
    let mut mesh = uneven_fan(5, &[3.0, 1.0]);
    mesh.features
        .knots
        .values_mut()
        .for_each(|d| *d = if *d == 1.0 { 0.0 } else { *d });
    let flat = Study::with_intervals(&mesh, Scheme::Nurss, Outside::Error, Domain::Planar);
    assert!(flat.is_err(), "faces without width");
    let closed = Study::with_intervals(&shapes::fan(5), Scheme::Nurss, Outside::Error, Domain::Closed);
    assert!(matches!(closed, Err(Error::Open)));
}

/// At ratio 100 the subdominant eigenvalue is 0.9736, and limits would be off by 1e-5 after the
/// multiplications that suffice at smaller ratios.
#[test]
fn limits_that_come_too_slowly_are_refused() {
    let study = |ratio: f64| {
        Study::with_intervals(
            &uneven_fan(5, &[ratio, 1.0]),
            Scheme::Nurss,
            Outside::Error,
            Domain::Planar,
        )
    };
    let refused = study(100.0).expect_err("it is refused").to_string();
    assert!(refused.contains("0.97") && refused.contains("at most 0.9"), "{refused}");
    assert!(study(10.0).is_ok());
}
