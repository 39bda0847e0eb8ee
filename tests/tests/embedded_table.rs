//! **Claim**: the embedded spline stencils of the lambda-scheme are the tabulated ones, are strictly feasible
//! for every lambda of [0.15, 0.9], and meet the optimum they were fitted to. **Oracles**:
//! `results/lambda/tables.json` and the tables beside it, written by the same command; the constraints of Ma,
//! Wang and Ma (2023, section 3.2) evaluated on the stencils and their spectra, never on the curves that
//! bounded the fit; the paper's Table 1. The finer splines lose less than a hundredth against stencils that
//! are tuned on their own, at the lambdas of the fit and between them.
//!
//! Until the table has been written there is nothing to check, and the tests say so; a table that is there
//! must be whole.

use eigenring_scheme::lambda::{
    Bounds, Constraint, Domain, LambdaEntry, LambdaKnots, LambdaTable, PAPER_TABLE_1, Relaxation, Splines,
};
use eigenring_tests::Comparison;
use eigenring_tune::objective::{Objective, Settings};
use eigenring_tune::sweep::{Options, sample};
use serde_json::Value;
use std::path::Path;

/// The table, or `None` with a message while it is empty.
fn table() -> Option<&'static LambdaTable> {
    let table = LambdaTable::embedded().unwrap();
    if table.valences.is_empty() {
        eprintln!("the embedded table is empty: nothing is checked until 'eigenring tables --embed' has written it");
        return None;
    }
    assert_eq!(
        table.valences().collect::<Vec<_>>(),
        (3..=20).collect::<Vec<_>>(),
        "a written table has all valences"
    );
    Some(table)
}

/// The results of a valence: every object, however deep, with this "valence".
fn objects_of<'a>(json: &'a Value, valence: usize, found: &mut Vec<&'a Value>) {
    match json {
        Value::Array(items) => items.iter().for_each(|item| objects_of(item, valence, found)),
        Value::Object(fields) => match fields.get("valence").and_then(Value::as_u64) {
            Some(n) if n == valence as u64 => found.push(json),
            _ => fields.values().for_each(|item| objects_of(item, valence, found)),
        },
        _ => {}
    }
}

/// Whether `json` contains, at any depth, something for which `is_it` holds.
fn contains(json: &Value, is_it: &mut dyn FnMut(&Value) -> bool) -> bool {
    is_it(json)
        || match json {
            Value::Array(items) => items.iter().any(|item| contains(item, is_it)),
            Value::Object(fields) => fields.values().any(|item| contains(item, is_it)),
            _ => false,
        }
}

/// A file of the results, which must be there once a table is embedded.
fn results(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../results/lambda")
        .join(name);
    std::fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("a table is embedded, but results/lambda/{name} cannot be read: {error}"))
}

/// The rows of a table of coefficients: the valence, then the numbers.
fn coefficients(name: &str) -> Vec<(usize, Vec<f64>)> {
    let text = results(name);
    let rows = text.lines().skip(1).map(|line| {
        let mut cells = line.split(',');
        let valence = cells.next().and_then(|cell| cell.parse().ok()).unwrap();
        (valence, cells.map(|cell| cell.parse().unwrap()).collect())
    });
    rows.collect()
}

#[test]
fn is_the_printed_table() {
    let Some(table) = table() else { return };
    let (f2, f3) = (
        coefficients("table5_f2_coefficients.csv"),
        coefficients("table6_f3_coefficients.csv"),
    );
    let embedded_f2 = table.valences.iter().map(|entry| (entry.valence, entry.f2.clone()));
    let embedded_f3 = table.valences.iter().map(|entry| (entry.valence, entry.f3.clone()));
    assert_eq!(f2, embedded_f2.collect::<Vec<_>>());
    assert_eq!(f3, embedded_f3.collect::<Vec<_>>());
}

#[test]
fn is_the_published_table() {
    let Some(table) = table() else { return };
    let results: Value = serde_json::from_str(&results("tables.json")).unwrap();
    assert!(
        contains(&results, &mut |value| value.as_str() == Some(&table.provenance.digest)),
        "the results do not name the embedded table's digest {}",
        table.provenance.digest
    );
    let mut interpolated = Comparison::new("f2 and f3 at lambda_C*", 1e-12);
    for entry in &table.valences {
        let n = entry.valence;
        let mut own = Vec::new();
        objects_of(&results, n, &mut own);
        for (name, coefficients) in [("f2", &entry.f2), ("f3", &entry.f3)] {
            let wanted: Vec<Option<f64>> = coefficients.iter().copied().map(Some).collect();
            let mut same = |value: &Value| {
                let numbers = value
                    .as_array()
                    .map(|a| a.iter().map(Value::as_f64).collect::<Vec<_>>());
                numbers.as_ref() == Some(&wanted)
            };
            assert!(
                own.iter().any(|object| contains(object, &mut same)),
                "N = {n}: the coefficients of {name} are not those of the results"
            );
        }
        // what was tuned at lambda_C* is interpolated
        let (f2, f3) = entry.optimal().unwrap();
        let before = interpolated.count();
        for object in own {
            contains(object, &mut |value| {
                // a tuned stencil: its lambda beside its minimum
                let number = |value: Option<&Value>| value.and_then(Value::as_f64);
                let tuned = |name: &str| number(value.get("minimum").and_then(|minimum| minimum.get(name)));
                if let (Some(lambda), Some(tuned_f2), Some(tuned_f3)) =
                    (number(value.get("lambda")), tuned("f2"), tuned("f3"))
                    && lambda == entry.lambda_optimal
                {
                    interpolated.check(format!("N = {n}, f2"), f2, tuned_f2);
                    interpolated.check(format!("N = {n}, f3"), f3, tuned_f3);
                }
                false
            });
        }
        assert!(
            interpolated.count() > before,
            "N = {n}: no tuned stencil at lambda_C* = {}",
            entry.lambda_optimal
        );
    }
    interpolated.finish();
}

/// Slacks over the lambdas of one entry that are too small, worst first.
fn infeasible(entry: &LambdaEntry) -> Vec<(f64, String)> {
    /// Weights may vanish, and then rounding of the splines leaves this much.
    const ROUNDING: f64 = 1e-14;
    /// Eigenvalues must stay below mu by this factor: the fit keeps 1e-6 at its own lambdas and may lose some
    /// of it between.
    const MARGIN: f64 = 1e-7;
    let relaxation = Relaxation::new(entry.valence).unwrap();
    let (a, e) = (entry.knots.a, entry.knots.e);
    let ramp = [relaxation.lambda_l(), relaxation.ramp_end(), entry.lambda_optimal];
    let even = (0..2000).map(|i| a + (e - a) * f64::from(i) / 1999.0);
    let mut failures = Vec::new();
    for lambda in even.chain(ramp.into_iter().filter(|&lambda| lambda <= e)) {
        let lambda = lambda.min(e);
        let plane = relaxation.plane(lambda).unwrap();
        let domain = Domain::new(plane, Bounds::Paper, 0.0).unwrap();
        let (f2, f3) = entry.weights(lambda).unwrap();
        for (constraint, slack) in domain.slack(f2, f3) {
            let least = match constraint {
                Constraint::Z0Lower | Constraint::Z0Upper | Constraint::LastBlock | Constraint::InnerBlocks => {
                    MARGIN * plane.mu()
                }
                _ => -ROUNDING,
            };
            // (slack is minus infinity where it is not a number)
            if slack < least {
                let text = format!(
                    "N = {}, lambda = {lambda}: {constraint:?} has slack {slack:e}",
                    entry.valence
                );
                failures.push((slack - least, text));
            }
        }
    }
    failures.sort_by(|a, b| a.0.total_cmp(&b.0));
    failures
}

#[test]
fn is_strictly_feasible_everywhere() {
    let Some(table) = table() else { return };
    let fine = Splines::Fine.table().unwrap();
    let worst: Vec<String> = (table.valences.iter())
        .chain(&fine.valences)
        .flat_map(|entry| infeasible(entry).into_iter().take(3))
        .map(|(_, text)| text)
        .collect();
    assert!(
        worst.is_empty(),
        "infeasible stencils, the worst of each valence:\n{}",
        worst.join("\n")
    );
}

/// The check above is able to fail: one coefficient away from the feasible domain.
#[test]
fn an_infeasible_spline_is_noticed() {
    let Some(table) = table() else { return };
    for entry in &table.valences {
        let mut changed = entry.clone();
        changed.f2[8] += 0.5;
        assert!(!infeasible(&changed).is_empty(), "N = {}", entry.valence);
    }
}

#[test]
fn lambda_optimal_is_that_of_the_paper() {
    let Some(table) = table() else { return };
    let mut comparison = Comparison::new("lambda_C* of Table 1", 1e-3);
    for row in PAPER_TABLE_1 {
        let entry = table.entry(row.valence).unwrap();
        comparison.check(format!("N = {}", row.valence), entry.lambda_optimal, row.lambda_c_star);
    }
    comparison.finish();
}

/// At valence 4 the best scheme is bicubic B-spline refinement, and its objective vanishes.
#[test]
fn valence_four_is_exact() {
    let Some(table) = table() else { return };
    let entry = table.entry(4).unwrap();
    assert_eq!(entry.lambda_optimal, 0.5);
    let (f2, f3) = entry.optimal().unwrap();
    assert!((f2 - 0.25).abs() < 1e-12 && f3 == 0.25, "{f2}, {f3}");
    let plane = Relaxation::new(4).unwrap().plane(0.5).unwrap();
    let total = Objective::new(plane, Settings::default())
        .unwrap()
        .value(f2, f3)
        .unwrap();
    assert!(total < 1e-12, "{total}");
}

/// `E/E_sample - 1` of an entry.
fn excess(entry: &LambdaEntry, lambda: f64, tuned: f64) -> f64 {
    let (f2, f3) = entry.weights(lambda).unwrap();
    let plane = Relaxation::new(entry.valence).unwrap().plane(lambda).unwrap();
    let objective = Objective::new(plane, Settings::default()).unwrap();
    objective.value(f2, f3).unwrap() / tuned - 1.0
}

#[test]
fn finer_splines_lose_less_than_a_hundredth() {
    let (paper, fine) = (LambdaTable::embedded().unwrap(), Splines::Fine.table().unwrap());
    assert!(fine.valences().eq(3..=20));
    let mut improved = 0;
    for (usual, finer) in paper.valences.iter().zip(&fine.valences) {
        let n = usual.valence;
        assert_eq!(
            (usual.knots.values(), usual.lambda_optimal),
            (finer.knots.values(), finer.lambda_optimal)
        );
        assert_eq!(finer.f2.len(), finer.knots.dimension());
        if finer.knots.singles == LambdaKnots::SINGLES {
            assert_eq!((&usual.f2, &usual.f3), (&finer.f2, &finer.f3), "N = {n}");
        } else {
            improved += 1;
        }
        let [a, b] = [usual, finer].map(|entry| entry.optimal().unwrap());
        assert!((a.0 - b.0).abs() < 1e-12 && (a.1 - b.1).abs() < 1e-12, "N = {n}");
    }
    assert!(improved >= 10, "{improved}");
    let mut worst = [0.0_f64; 2];
    for line in results("samples.csv").lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [lambda, tuned] = [cells[1], cells[5]].map(|cell| cell.parse::<f64>().unwrap());
        // at N = 4, lambda = 1/2 nothing is left to lose
        if tuned < 1e-9 {
            continue;
        }
        let valence = cells[0].parse().unwrap();
        let [usual, finer] = [paper, fine].map(|table| excess(table.entry(valence).unwrap(), lambda, tuned));
        worst = [worst[0].max(usual), worst[1].max(finer)];
        assert!(finer < 0.01, "N = {valence}, lambda = {lambda}: {finer}");
    }
    // the usual splines would not pass
    assert!(worst[0] > 0.05, "{worst:?}");
    // half way between two samples of the fit, tuned anew
    for (valence, lambda) in [(3, 0.3825), (5, 0.375), (5, 0.885), (11, 0.8775), (15, 0.16)] {
        let tuned = sample(valence, lambda, &Options::default()).unwrap();
        let entry = fine.entry(valence).unwrap();
        // the samples lie on one branch, which need not be the lowest
        let (f2, f3) = entry.weights(lambda).unwrap();
        let near = |m: &&eigenring_tune::sweep::Minimum| (m.f2 - f2).hypot(m.f3 - f3);
        let nearest = tuned.minima.iter().min_by(|a, b| near(a).total_cmp(&near(b))).unwrap();
        let lost = excess(entry, lambda, nearest.total);
        assert!(lost < 0.012, "N = {valence}, lambda = {lambda}: {lost}");
    }
}

#[test]
fn finer_splines_are_never_taken_silently() {
    use eigenring_scheme::{Error, Spec};
    let spec = |text: &str| text.parse::<Spec>();
    let (usual, finer) = (
        spec("lambda:lambda=0.39").unwrap(),
        spec("lambda:fine,lambda=0.39").unwrap(),
    );
    assert_ne!(usual, finer);
    assert_eq!(finer.to_string(), "lambda:fine,lambda=0.39");
    let weights = |spec: &Spec, n| {
        let member = spec.member(n, |wanted| wanted.refuse()).unwrap().unwrap();
        (member.f2, member.f3)
    };
    let table = Splines::Fine.table().unwrap();
    for n in 3..=20 {
        assert_eq!(weights(&finer, n), table.entry(n).unwrap().weights(0.39).unwrap());
    }
    assert_ne!(weights(&usual, 5), weights(&finer, 5));
    for bad in [
        "lambda:fine",
        "lambda:fine,optimal",
        "lambda:fine,lambda=0.5,s=1",
        "lambda:fine,lambda=0.5,f2=0.2,f3=0.1",
    ] {
        assert!(matches!(spec(bad), Err(Error::Spec { .. })), "{bad}");
    }
}
