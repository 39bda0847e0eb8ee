//! Patch test, reference errors, rates and refused input.

use crate::common::{rules, warped};
use eigenring_iga::{Domain, Ends, Error, Norms, Options, Problem, Study, solution};
use eigenring_scheme::Definition;
use eigenring_scheme::user::{Reading, UserScheme};
use eigenring_surface::{Mesh, Rules, shapes};

fn options(ends: Ends, gauss: usize) -> Options {
    Options {
        ends,
        gauss,
        ..Options::default()
    }
}

fn error(mesh: &Mesh, scheme: &str, name: &str, problem: Problem, level: usize, options: &Options) -> Norms {
    let rules = rules(scheme);
    let u = solution::named(name).expect("a solution");
    let study = Study::new(mesh, &rules, Domain::Planar).expect("a study");
    study.level(level, problem, &u, options).expect("an outcome").error
}

#[test]
fn linear_functions_are_reproduced() {
    let schemes = ["catmull-clark", "lambda:lambda=0.39", "lambda:lambda=0.5"];
    for (n, scheme) in [3, 5, 6, 7, 9]
        .into_iter()
        .flat_map(|n| schemes.map(|scheme| (n, scheme)))
    {
        for (mesh, ends) in [
            (shapes::fan(n), Ends::Open),
            (warped(shapes::fan(n)), Ends::Open),
            (warped(shapes::fan(n)), Ends::Natural),
        ] {
            let e = error(&mesh, scheme, "lin", Problem::Poisson, 1, &options(ends, 4));
            assert!(
                e.l2 <= 1e-12 && e.h1 <= 1e-11 && e.h2 <= 1e-9,
                "{scheme}, N = {n}, {ends:?}: {e:?}"
            );
        }
    }
    for scheme in schemes {
        let e = error(
            &shapes::square3355(),
            scheme,
            "lin",
            Problem::Poisson,
            0,
            &options(Ends::Open, 4),
        );
        assert!(
            e.l2 <= 1e-12 && e.h1 <= 1e-11 && e.h2 <= 1e-9,
            "{scheme}, square: {e:?}"
        );
    }
}

#[test]
fn errors_are_those_of_the_reference() {
    let cases: serde_json::Value = serde_json::from_str(include_str!("data/errors.json")).expect("JSON");
    for case in cases.as_array().expect("cases") {
        let text = |key: &str| case[key].as_str().expect("text");
        let mesh = match text("mesh") {
            "square3355" => shapes::square3355(),
            fan => shapes::fan(fan[3..].parse().expect("a valence")),
        };
        let ends = if text("boundary") == "open" {
            Ends::Open
        } else {
            Ends::Natural
        };
        let problem = if text("problem") == "l2" {
            Problem::L2
        } else {
            Problem::Poisson
        };
        let levels = case["levels"].as_array().expect("levels");
        for level in levels {
            let number = level["level"].as_u64().expect("a level") as usize;
            // the default rule on the last level, where what it leaves is largest beside the error
            let last = number + 1 == levels.len();
            let rules = [(6, 1e-5), (4, 1e-4)];
            for (gauss, tolerance) in rules.into_iter().take(if last { 2 } else { 1 }) {
                let e = error(&mesh, text("scheme"), "exp", problem, number, &options(ends, gauss));
                for (key, value) in [("L2", e.l2), ("H1", e.h1), ("H2", e.h2)] {
                    let expected = level[key].as_f64().expect("a number");
                    let off = (value / expected - 1.0).abs();
                    assert!(
                        off <= tolerance,
                        "{case:?} {key} on {number}: {value}, {gauss} points, off {off:e}"
                    );
                }
            }
        }
    }
}

#[test]
fn rates_are_the_predicted_ones() {
    for scheme in ["catmull-clark", "lambda:lambda=0.5"] {
        let all = [3, 4].map(|level| {
            error(
                &shapes::fan(6),
                scheme,
                "exp",
                Problem::Poisson,
                level,
                &options(Ends::Open, 4),
            )
        });
        let study_rules = rules(scheme);
        let predicted = Study::new(&shapes::fan(6), &study_rules, Domain::Planar)
            .expect("a study")
            .predicted(Problem::Poisson, Ends::Open);
        let rate = |of: fn(&Norms) -> f64| (of(&all[0]) / of(&all[1])).log2();
        let observed = [rate(|e| e.l2), rate(|e| e.h1), rate(|e| e.linf), rate(|e| e.h2)];
        for (observed, predicted) in observed.iter().zip(predicted) {
            let predicted = predicted.expect("of this problem all are predicted");
            assert!(
                (observed - predicted).abs() < 0.1,
                "{scheme}: {observed} for {predicted}"
            );
        }
    }
}

#[test]
fn a_scaled_tail_stands_for_the_annuli_left_out() {
    let with = |scaled: bool| {
        let options = Options {
            depth: Some(16),
            scaled,
            ..Options::default()
        };
        error(&shapes::fan(6), "catmull-clark", "lin", Problem::Poisson, 2, &options).h1
    };
    assert!(with(true) <= 1e-12, "{:e}", with(true));
    assert!((1e-8..1e-7).contains(&with(false)), "{:e}", with(false));
}

#[test]
fn what_has_no_space_is_refused() {
    let cc = rules("catmull-clark");
    assert!(matches!(
        Study::new(&shapes::cube(), &cc, Domain::Planar),
        Err(Error::NotPlanar { .. })
    ));
    let dual = rules("doo-sabin");
    assert!(matches!(
        Study::new(&shapes::fan(5), &dual, Domain::Planar),
        Err(Error::NotBicubic(_))
    ));
    // levels that differ, and rules that reach further or are special where the mesh is regular
    let tension = rules("tension:order=4,u0=2");
    assert!(matches!(
        Study::new(&shapes::fan(5), &tension, Domain::Planar),
        Err(Error::NotBicubic(_))
    ));
    let file = |name: &str| {
        let path = format!("{}/../../tests/data/cases/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).expect("a file");
        let scheme = UserScheme::parse(&text, name, Reading::default()).expect("a scheme");
        Rules::new(Definition::File(scheme.into()))
    };
    let two_rings = file("tworing5");
    assert!(matches!(
        Study::new(&shapes::fan(5), &two_rings, Domain::Planar),
        Err(Error::NotBicubic(_))
    ));
    let at_four = file("jordan-one-ring-n4");
    assert!(Study::new(&shapes::fan(4), &at_four, Domain::Planar).is_err());
    // the levels of u0 = 1 are one
    assert!(Study::new(&shapes::fan(5), &rules("tension:order=4"), Domain::Planar).is_ok());
    let mut far = shapes::fan(5);
    far.points_mut().iter_mut().for_each(|p| p.x += 1e4);
    let u = solution::named("exp").expect("a solution");
    let study = Study::new(&far, &cc, Domain::Planar).expect("a study");
    let outcome = study.level(0, Problem::Poisson, &u, &options(Ends::Open, 4));
    assert!(matches!(outcome, Err(Error::Solution { .. })), "{outcome:?}");
    let many = Study::new(&shapes::fan(129), &cc, Domain::Planar);
    assert!(matches!(many, Err(Error::Range { name: "valence", .. })));
    let mut folded = shapes::fan(5);
    folded.points_mut().iter_mut().for_each(|p| p.x = -p.x);
    let study = Study::new(&folded, &cc, Domain::Planar).expect("a study");
    let u = solution::named("lin").expect("a solution");
    let outcome = study.level(0, Problem::L2, &u, &options(Ends::Open, 4));
    assert!(matches!(outcome, Err(Error::Jacobian { .. })));
    let outcome = study.level(0, Problem::L2, &u, &options(Ends::Open, 1));
    assert!(matches!(outcome, Err(Error::Range { .. })));
}
