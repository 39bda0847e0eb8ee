//! Eigenvalues against closed forms: Lame's of the equilateral triangle, those of squares and of the sphere;
//! and against a prototype that shares no code.

use crate::common::{rules, squares};
use eigenring_iga::{Domain, Ends, Error, Membrane, Options, Problem, Spectrum, Study};
use eigenring_surface::{Mesh, shapes};
use std::f64::consts::PI;

fn spectrum(mesh: &Mesh, scheme: &str, domain: Domain, held: Membrane, level: usize, gauss: usize) -> Spectrum {
    let rules = rules(scheme);
    let options = Options {
        gauss,
        ..Options::default()
    };
    let study = Study::new(mesh, &rules, domain).expect("a study");
    study.spectrum(level, held, 9, &options).expect("a spectrum")
}

#[test]
fn the_triangle_has_lames_eigenvalues() {
    // (16 pi^2/27) (m^2 + mn + n^2), circumradius 1 (Pinsky 1980)
    let first = 16.0 * PI * PI / 27.0;
    for (scheme, most) in [
        ("catmull-clark", 2e-11),
        ("lambda:lambda=0.39", 2e-11),
        ("lambda:lambda=0.5", 4e-9),
    ] {
        let of = |level| spectrum(&shapes::fan(3), scheme, Domain::Planar, Membrane::Free, level, 6).eigenvalues;
        let (coarse, fine) = (of(3), of(4));
        let off = |values: &[f64]| values[1] / first - 1.0;
        assert!(fine[0].abs() < 1e-12, "{scheme}: {:e}", fine[0]);
        assert!(off(&fine).abs() <= most, "{scheme}: {:e}", off(&fine));
        assert!((fine[2] / fine[1] - 1.0).abs() < 1e-12, "{scheme}: a pair, {fine:?}");
        for (value, factor) in fine[3..6].iter().zip([3.0, 4.0, 4.0]) {
            assert!((value / first / factor - 1.0).abs() < 1e-7, "{scheme}: {value}");
        }
        // twice the rate of H1
        let (rules, mesh) = (rules(scheme), shapes::fan(3));
        let study = Study::new(&mesh, &rules, Domain::Planar).expect("a study");
        let h1 = study.predicted(Problem::Poisson, Ends::Open)[1].expect("predicted");
        let rate = (off(&coarse) / off(&fine)).log2();
        assert!((rate - 2.0 * h1).abs() <= 0.2, "{scheme}: {rate} for {}", 2.0 * h1);
    }
    let held = spectrum(&shapes::fan(3), "catmull-clark", Domain::Planar, Membrane::Held, 3, 4).eigenvalues;
    for (value, factor) in held.iter().zip([3.0, 7.0, 7.0, 12.0]) {
        assert!((value / first / factor - 1.0).abs() < 1e-7, "held: {value}");
    }
}

#[test]
fn the_sphere_has_l_times_l_plus_1() {
    let found = spectrum(&shapes::cube(), "catmull-clark", Domain::Sphere, Membrane::Free, 4, 4);
    assert_eq!(found.dof, 6146);
    assert!((found.area / (4.0 * PI) - 1.0).abs() < 1e-10, "{:e}", found.area);
    assert!(found.eigenvalues[0].abs() < 1e-12, "{:e}", found.eigenvalues[0]);
    for (index, value) in found.eigenvalues.iter().enumerate().skip(1) {
        let exact = if index < 4 { 2.0 } else { 6.0 };
        assert!((value / exact - 1.0).abs() <= 2e-9, "{index}: {value}");
    }
}

#[test]
fn an_eigenvalue_of_more_copies_than_a_block_has_columns_is_found() {
    // six squares: the constants of each, then pi^2 of each
    let corners: Vec<[f64; 2]> = (0..6).map(|k| [2.0 * f64::from(k), 0.0]).collect();
    let found = spectrum(
        &squares(3, &corners),
        "catmull-clark",
        Domain::Planar,
        Membrane::Free,
        0,
        4,
    );
    let [zeros, others] = [&found.eigenvalues[..6], &found.eigenvalues[6..]];
    assert!(zeros.iter().all(|value| value.abs() < 1e-10), "{zeros:?}");
    assert!(
        others.iter().all(|value| (value / (PI * PI) - 1.0).abs() < 1e-3),
        "{others:?}"
    );
}

#[test]
fn eigenvalues_are_those_of_the_prototype() {
    let cases: serde_json::Value = serde_json::from_str(include_str!("data/eigenvalues.json")).expect("JSON");
    for case in cases.as_array().expect("cases") {
        let text = |key: &str| case[key].as_str().expect("text");
        let n = text("mesh")[3..].parse().expect("a valence");
        let level = case["level"].as_u64().expect("a level") as usize;
        for (key, held, skipped) in [
            ("neumann_eigenvalues", Membrane::Free, 1),
            ("dirichlet_eigenvalues", Membrane::Held, 0),
        ] {
            let found = spectrum(&shapes::fan(n), text("scheme"), Domain::Planar, held, level, 10);
            let area = case["area"].as_f64().expect("a number");
            assert!((found.area / area - 1.0).abs() < 1e-9, "{} for {area}", found.area);
            for (value, expected) in found.eigenvalues[skipped..]
                .iter()
                .zip(case[key].as_array().expect("values"))
            {
                let expected = expected.as_f64().expect("a number");
                let off = (value / expected - 1.0).abs();
                assert!(off <= 1e-8, "{case} {key}: {value} for {expected}, off {off:e}");
            }
        }
    }
}

#[test]
fn spectra_of_the_wrong_domain_are_refused() {
    let rules = rules("catmull-clark");
    let open = Study::new(&shapes::fan(5), &rules, Domain::Closed);
    assert!(matches!(open, Err(Error::Open)));
    let closed = Study::new(&shapes::cube(), &rules, Domain::Closed).expect("a study");
    let held = closed.spectrum(0, Membrane::Held, 3, &Options::default());
    assert!(matches!(held, Err(Error::Closed)));
    let none = closed.spectrum(0, Membrane::Free, 0, &Options::default());
    assert!(matches!(none, Err(Error::Range { .. })));
    // a surface beside the origin is no graph over the sphere
    let mut aside = shapes::cube();
    aside.points_mut().iter_mut().for_each(|p| p.x += 5.0);
    let aside = Study::new(&aside, &rules, Domain::Sphere).expect("a study");
    let fitted = aside.spectrum(0, Membrane::Free, 3, &Options::default());
    assert!(matches!(fitted, Err(Error::NotStar { .. })));
}
