//! **Oracle**: families whose best parameter is known in closed form, the tuning of the lambda-scheme by its
//! own objective and search, and the numbers that `compare` prints.

use super::*;
use crate::compare;
use crate::progress::Silent;
use eigenring_certify::Status;
use eigenring_scheme::lambda::{LambdaTable, Relaxation};
use eigenring_scheme::user::starters;
use eigenring_spectral::LocalSystem;
use eigenring_tune::objective::{Objective, Settings};

/// Catmull-Clark's rules with two free weights.
const FAMILY: &str = r#"
kind = "one-ring"
[parameters]
t = { default = "3/8", range = ["1/100", "9/20"], doc = "the weight of an edge's other end" }
b = { default = "1/4", range = ["0", "2"], doc = "n times the total weight of the faces" }
[rule]
n = "3.."
f1 = "1/4"
f2 = "1/4"
f3 = "1/4"
d1 = "3/4 - t"
d2 = "t"
e1 = "1/16"
e2 = "1/16"
alpha = "3/2/n"
beta = "b/n"
"#;

/// A plan for a text; what is fixed has a value or none.
fn plan(folder: &tempfile::TempDir, text: &str, goal: &str, fixed: &[(&str, Option<&str>)]) -> Plan {
    let path = folder.path().join("mine.toml");
    std::fs::write(&path, text).unwrap();
    let fix = |(name, value): &(&str, Option<&str>)| ((*name).to_owned(), value.map(|value| value.parse().unwrap()));
    Plan {
        scheme: SchemeFile { path, values: vec![] },
        fixed: fixed.iter().map(fix).collect(),
        goal: goal.parse().unwrap(),
        conditions: vec![],
        margin: 2e-6,
        seed: 0,
        descents: 3,
    }
}

fn value(row: &Row, name: &str) -> f64 {
    row.parameters.iter().find(|(known, _)| known == name).unwrap().1
}

#[test]
fn lambda_meets_its_target_where_the_range_reaches() {
    // (t + 2 e1 c - lambda)(f3 - lambda) = 2 e2 f2 (1 + c), c = cos(2 pi/N): at 1/2 it is t = 3/8 - c/4
    let folder = tempfile::tempdir().unwrap();
    let plan = plan(&folder, FAMILY, "lambda:1/2", &[("b", None)]);
    let tuned = plan.run(&[3, 4, 5, 8, 9], "found", &(), &Silent).unwrap();
    assert!(plan.holds(&tuned));
    for row in &tuned.rows {
        let c = (std::f64::consts::TAU / row.valence as f64).cos();
        let expected = (3.0 / 8.0 - c / 4.0).min(9.0 / 20.0);
        assert!((value(row, "t") - expected).abs() < 1e-12, "{row:?}");
        let at_end = row.valence == 3;
        assert_eq!(row.active, if at_end { vec!["t = 9/20"] } else { vec![] });
        assert!(at_end || row.after.unwrap() < 1e-13);
        assert!(row.after.unwrap() <= row.before.unwrap());
    }
    // the text holds the values, exact ends of ranges among them
    let read = UserScheme::parse(&tuned.text, "x", Reading::Balanced).unwrap();
    let t = &read.parameters()[0];
    assert_eq!(t.at(3).to_string(), "9/20");
    assert_eq!((t.at(4), t.at(6)), (&t.default, &t.default));
    assert!(read.parameters()[1].except.is_empty());
}

#[test]
fn curvature_is_bounded_by_the_weight_of_the_faces() {
    // N = 3: block 0 has the eigenvalues 1, 1/4 - b/3 and 0, block 1 has trace 9/16 and determinant 1/16; for
    // b above 1 mu may be -lambda^2, which has the same modulus
    let text = FAMILY.replace("[\"0\", \"2\"]", "[\"0\", \"1\"]");
    let lambda = (9.0 / 16.0 + (81.0_f64 / 256.0 - 0.25).sqrt()) / 2.0;
    let best = 3.0 * (0.25 - lambda * lambda);
    let folder = tempfile::tempdir().unwrap();
    let mut plan = plan(&folder, &text, "10*ratio", &[("t", None)]);
    let tuned = plan.run(&[3], "found", &(), &Silent).unwrap();
    assert!(
        (value(&tuned.rows[0], "b") - best).abs() < 1e-12,
        "{:?}",
        tuned.rows[0].parameters
    );
    assert!(tuned.rows[0].after.unwrap() < 1e-11);
    // with room for a proof: mu = (1 - margin) lambda^2
    plan.conditions = vec![Condition::Bounded, Condition::C1];
    plan.margin = 1e-6;
    let tuned = plan.run(&[3], "found", &(), &Silent).unwrap();
    let row = &tuned.rows[0];
    assert!(
        (row.after.unwrap() - 1e-5).abs() < 1e-9 && row.active == ["bounded"],
        "{row:?}"
    );
    assert!(plan.holds(&tuned));
    let verdicts = plan.verdicts(&row.certificate.checks);
    assert_eq!(verdicts, [("c1", Status::Proven), ("bounded", Status::Proven)]);
}

#[test]
fn gradients_by_duals_are_central_differences() {
    let scheme = UserScheme::parse(FAMILY, "x", Reading::Balanced).unwrap();
    let free = free(&scheme, &[]).unwrap();
    for (goal, valence) in [("lambda:0.3", 5), ("2*ratio", 3), ("ratio", 6), ("ratio", 7)] {
        let goal: Goal = goal.parse().unwrap();
        let family = Family::new(&scheme, valence, &free, (&goal, &[], 0.0), &[]).unwrap();
        let point = [0.4, 0.3];
        let (value, gradient) = family.smooth(&point).unwrap();
        assert!((value - family.worth(&point).value.powi(2)).abs() < 1e-12 * value);
        for axis in 0..2 {
            let step = 1e-6;
            let at = |by: f64| {
                let mut point = point;
                point[axis] += by;
                family.smooth(&point).unwrap().0
            };
            let difference = (at(step) - at(-step)) / (2.0 * step);
            assert!(
                (gradient[axis] - difference).abs() < 1e-8 * (1.0 + difference.abs()),
                "{goal} {axis}"
            );
        }
    }
}

/// The optimum of the lambda-scheme at its optimal lambda, from its formulas: it agrees with what its own
/// search has found with exact gradients, which shares neither the objective's code nor the solver.
#[test]
fn the_optimum_of_the_lambda_scheme_is_found_from_its_formulas() {
    let folder = tempfile::tempdir().unwrap();
    let text = starters().iter().find(|starter| starter.like == "lambda").unwrap().text;
    for valence in 5..=8 {
        let entry = LambdaTable::embedded().unwrap().entry(valence).unwrap();
        let lambda = entry.lambda_optimal;
        let (f2, f3) = entry.weights(lambda).unwrap();
        let objective = Objective::new(
            Relaxation::new(valence).unwrap().plane(lambda).unwrap(),
            Settings::default(),
        );
        let expected = objective.unwrap().value(f2, f3).unwrap();
        let lambda = lambda.to_string();
        let fixed = [("lambda", Some(lambda.as_str())), ("s", None), ("phi", None)];
        let mut plan = plan(&folder, text, "E", &fixed);
        plan.conditions = vec![Condition::Hull, Condition::Order];
        plan.descents = 1;
        let tuned = plan.run(&[valence], "found", &(), &Silent).unwrap();
        let row = &tuned.rows[0];
        let after = row.after.unwrap();
        assert!(
            (after - expected).abs() <= 1e-6 * expected,
            "{valence}: {after} {expected}"
        );
        assert!(plan.holds(&tuned), "{:?}", plan.verdicts(&row.certificate.checks));
        // flat at the minimum: half the digits
        assert!((value(row, "p") - f2).abs() < 1e-4 && (value(row, "q") - f3).abs() < 1e-4);
    }
}

#[test]
fn measures_are_what_compare_prints() {
    let scheme = UserScheme::parse(FAMILY, "x", Reading::Balanced).unwrap();
    for valence in [3, 5, 8] {
        let rules = scheme.scheme::<f64>(valence).unwrap();
        let extended = scheme.scheme(valence).unwrap();
        let row = compare::Row::new("x", &rules, Some(&extended)).unwrap();
        let full = Measured::full(&rules, &extended);
        let fast = Measured::fast(&rules);
        for (goal, expected) in [
            ("E-unweighted", row.total),
            ("K_m", row.sign_change),
            ("ratio", row.ratio.map(|ratio| (ratio - 1.0).abs())),
            ("lambda:0", row.lambda),
            ("strictness", row.strict.map(|strict| 1.0 - strict)),
            ("hull", row.hull.map(|hull| -hull)),
        ] {
            let goal: Goal = goal.parse().unwrap();
            let expected = expected.unwrap();
            // 1 - (1 - x) is x up to rounding
            assert!((full.value(&goal) - expected).abs() <= 2e-16, "{goal} at {valence}");
            assert!(
                (fast.value(&goal) - expected).abs() <= 1e-12 * (1.0 + expected),
                "{goal} at {valence}"
            );
        }
    }
}

/// Edges are counted anew: all pairs of points within two rings that a step of the grid joins.
#[test]
fn the_polar_artefact_is_the_variance_of_all_edges() {
    let goal: Goal = "polar".parse().unwrap();
    let regular = crate::schemes::SchemeName::Spec("catmull-clark".parse().unwrap());
    let tuner = crate::schemes::Tuner::default();
    assert!(Measured::fast(&regular.scheme(4, &tuner).unwrap()).value(&goal) < 1e-20);
    for (spec, valence, rings) in [
        ("catmull-clark", 7, 2),
        ("lambda:lambda=0.5", 5, 2),
        ("stam:order=5", 6, 1),
    ] {
        let scheme = crate::schemes::SchemeName::Spec(spec.parse().unwrap());
        let scheme = scheme.scheme(valence, &tuner).unwrap();
        let system = LocalSystem::new(scheme.limit(), rings.max(scheme.closed_rings().unwrap())).unwrap();
        let points = system.natural().unwrap().points;
        let numbering = system.numbering();
        let (mut edges, mut lengths) = (std::collections::BTreeSet::new(), Vec::new());
        let within = scheme.numbering(rings).sites();
        for (index, site) in within.iter().enumerate() {
            for (dx, dy) in [(2, 0), (0, 2), (-2, 0), (0, -2)] {
                let sector = site.sector as i64;
                let other = eigenring_scheme::Site::new(scheme.fan(), sector, site.x + dx, site.y + dy);
                let Some(other) = other.filter(|other| within.contains(other)) else {
                    continue;
                };
                let (a, b) = (index, numbering.index(other).unwrap());
                if edges.insert((a.min(b), a.max(b))) {
                    lengths.push((points[0][a] - points[0][b]).hypot(points[1][a] - points[1][b]));
                }
            }
        }
        // the centre has an edge on every spoke
        let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
        let variance = lengths.iter().map(|l| (l / mean - 1.0).powi(2)).sum::<f64>() / lengths.len() as f64;
        let found = Measured::fast(&scheme).value(&goal);
        assert!(
            (found - variance).abs() < 1e-10,
            "{spec}: {found} {variance} of {}",
            lengths.len()
        );
    }
}

#[test]
fn what_cannot_be_tuned_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |plan: Plan| plan.run(&[5], "found", &(), &Silent).unwrap_err().to_string();
    let negative = FAMILY
        .replace("d2 = \"t\"", "d2 = \"-t\"")
        .replace("3/4 - t", "3/4 + t");
    let mut infeasible = plan(&folder, &negative, "lambda:1/2", &[]);
    infeasible.conditions = vec![Condition::Hull];
    let message = refused(infeasible);
    assert!(
        message.contains("at N = 5: hull fails at all of 65 samples"),
        "{message}"
    );
    let message = refused(plan(&folder, FAMILY, "E", &[("t", None), ("b", None)]));
    assert!(message.contains("no parameter of mine is free"), "{message}");
    let message = refused(plan(&folder, FAMILY, "E", &[("t", Some("1"))]));
    assert!(
        message.contains("t = 1 is out of range: accepted is 1/100 <= t <= 9/20"),
        "{message}"
    );
    let message = refused(plan(&folder, FAMILY, "E", &[("c", None)]));
    assert!(
        message.contains("unknown parameter 'c': accepted are t, b"),
        "{message}"
    );
    let open = FAMILY.replace("range = [\"0\", \"2\"], ", "");
    let message = refused(plan(&folder, &open, "E", &[]));
    assert!(message.contains("the parameter b of mine has no range"), "{message}");
    let message = refused(plan(&folder, "kind = \"one-ring\"\n[[valence]]\nn = 5\n", "E", &[]));
    assert!(message.contains("f1 is missing"), "{message}");
}
