//! **Claim**: the studies in `results/studies` say what the objective says. **Oracles**: the objective, the
//! domain and the splines themselves at the stored numbers; what is claimed of a search is tried nearby.

use eigenring_scheme::lambda::{Bounds, LambdaTable, Relaxation};
use eigenring_tune::objective::{Normalisation, Objective, Settings};
use eigenring_tune::sweep::sample_lambdas;
use std::collections::BTreeMap;
use std::path::Path;

/// The rows of a file, by column.
fn rows(name: &str) -> Vec<BTreeMap<String, String>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../results/studies")
        .join(name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("results/studies/{name}: {error}"));
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned));
    let head: Vec<String> = lines.next().expect("a header").collect();
    lines.map(|cells| head.iter().cloned().zip(cells).collect()).collect()
}

fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} of {row:?}"))
}

fn valence(row: &BTreeMap<String, String>) -> usize {
    row["valence"].parse().expect("a valence")
}

fn objective(valence: usize, lambda: f64, settings: Settings) -> Objective {
    let plane = Relaxation::new(valence).unwrap().plane(lambda).unwrap();
    Objective::new(plane, settings).unwrap()
}

#[test]
fn tuned_stencils_are_proven_the_best() {
    let rows = rows("optimality.csv");
    for row in &rows {
        let (valence, lambda) = (valence(row), number(row, "lambda"));
        let weighted = row["weighted"] == "1";
        let [f2, f3, total] = ["f2", "f3", "E"].map(|column| number(row, column));
        let settings = Settings {
            weighted,
            ..Settings::default()
        };
        let value = objective(valence, lambda, settings).value(f2, f3).unwrap();
        assert!((value - total).abs() <= 1e-8 * value, "N = {valence}: {value} {total}");
        let entry = LambdaTable::embedded().unwrap().entry(valence).unwrap();
        assert_eq!(lambda, entry.lambda_optimal);
        if weighted {
            let (tabulated_f2, tabulated_f3) = entry.optimal().unwrap();
            assert!(
                (f2 - tabulated_f2).abs() < 1e-7 && (f3 - tabulated_f3).abs() < 1e-7,
                "N = {valence}"
            );
        }
        assert_eq!(
            (row["status"].as_str(), row["undecided"].as_str()),
            ("proven", "0"),
            "N = {valence}"
        );
        assert!(number(row, "bound") >= (1.0 - 1.0001e-6) * total);
    }
    let both: Vec<(usize, &str)> = rows
        .iter()
        .map(|row| (valence(row), row["weighted"].as_str()))
        .collect();
    assert!((5..=20).all(|n| both.contains(&(n, "1")) && both.contains(&(n, "0"))));
}

#[test]
fn nothing_beats_what_is_on_the_front() {
    let rows = rows("margin.csv");
    let wanted = |row: &BTreeMap<String, String>| [number(row, "E"), -number(row, "margin"), number(row, "K_m")];
    for (index, row) in rows.iter().enumerate() {
        let own = wanted(row);
        let beaten = rows.iter().filter(|other| valence(other) == valence(row)).any(|other| {
            let others = wanted(other);
            // by more than the digits that a tuned stencil has
            others.iter().zip(&own).all(|(a, b)| a <= b) && others.iter().zip(&own).any(|(a, b)| b - a > 1e-4 * b.abs())
        });
        assert!(!beaten, "{row:?}");
        if index % 7 == 0 {
            let [lambda, f2, f3] = ["lambda", "f2", "f3"].map(|column| number(row, column));
            let plane = Relaxation::new(valence(row)).unwrap().plane(lambda).unwrap();
            let parts = objective(valence(row), lambda, Settings::default())
                .parts(f2, f3)
                .unwrap();
            assert!((parts.total() - own[0]).abs() < 1e-9 * own[0]);
            assert!((parts.sign_change() - own[2]).abs() < 1e-9);
            assert!(
                plane
                    .slack(Bounds::Paper, -own[1] - 1e-9, f2, f3)
                    .iter()
                    .all(|(_, slack)| *slack > -1e-12)
            );
        }
    }
    assert!((5..=8).all(|n| rows.iter().filter(|row| valence(row) == n).count() > 5));
}

#[test]
fn relative_optima_are_minima() {
    let settings = Settings {
        normalisation: Normalisation::Relative,
        ..Settings::default()
    };
    let rows = rows("normalisation.csv");
    for row in &rows {
        let n = valence(row);
        let [lambda, f2, f3] = ["relative_lambda_C", "relative_f2", "relative_f3"].map(|column| number(row, column));
        let least = number(row, "least_relative_E");
        let value = |lambda: f64, f2: f64, f3: f64| objective(n, lambda, settings).value(f2, f3).unwrap();
        assert!((value(lambda, f2, f3) - least).abs() <= 1e-9 * least + 1e-20, "N = {n}");
        let paper = ["lambda_C", "f2", "f3"].map(|column| number(row, column));
        let at_paper = value(paper[0], paper[1], paper[2]);
        assert!((at_paper - number(row, "relative_E")).abs() <= 1e-9 * at_paper + 1e-20);
        assert!(least <= at_paper && (lambda - paper[0]).abs() < 0.01, "N = {n}");
        // along f2, which no bound holds
        assert!(
            value(lambda, f2 + 1e-4, f3) > least && value(lambda, f2 - 1e-4, f3) > least,
            "N = {n}"
        );
    }
    assert_eq!(rows.len(), 18);
}

#[test]
fn splines_of_large_valences_are_near_the_best() {
    let accuracy = rows("large_accuracy.csv");
    assert_eq!(
        accuracy.iter().map(valence).collect::<Vec<_>>(),
        (21..=64).collect::<Vec<_>>()
    );
    for row in &accuracy {
        assert!(
            number(row, "excess_overall") < 0.03 && number(row, "slack") > -1e-12,
            "{row:?}"
        );
        assert!(number(row, "strictness") > 0.99e-6, "{row:?}");
    }
    // the stencil at lambda_C* against neighbours of its own
    for row in rows("large_featured.csv")
        .iter()
        .filter(|row| row["name"] == "lambda_C")
    {
        let (n, lambda) = (valence(row), number(row, "lambda"));
        let [f2, f3, total] = ["f2", "f3", "E"].map(|column| number(row, column));
        let objective = objective(n, lambda, Settings::default());
        let value = |d: f64| objective.value(f2 + d, f3).unwrap();
        assert!(
            (value(0.0) - total).abs() < 1e-9 * total && value(1e-5) > total && value(-1e-5) > total,
            "N = {n}"
        );
        assert!(sample_lambdas(n).unwrap().len() == 100);
    }
}

/// What splines with 17 coefficients lose at the samples of the tables is as stored, and never more than with
/// the usual fit or the paper's knots.
#[test]
fn sharper_splines_lose_what_is_stored() {
    let kinds = rows("sharp.csv");
    let coefficients = |name: &str, n: usize| -> Vec<f64> {
        let row = rows(name).into_iter().find(|row| valence(row) == n).unwrap();
        (1..=17).map(|i| number(&row, &format!("C{i}"))).collect()
    };
    let samples = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../results/lambda/samples.csv"));
    let samples = samples.expect("the samples of the tables");
    for n in 3..=20 {
        let of = |kind: &str| kinds.iter().find(|row| valence(row) == n && row["knots"] == kind);
        let sharp = of("sharp").unwrap();
        let usual = LambdaTable::embedded().unwrap().entry(n).unwrap();
        let mut entry = usual.clone();
        (entry.knots.b, entry.knots.d) = (number(sharp, "lambda_b"), number(sharp, "lambda_d"));
        (entry.f2, entry.f3) = (coefficients("sharp_f2.csv", n), coefficients("sharp_f3.csv", n));
        let (mut overall, mut ours, mut theirs) = (0.0_f64, 0.0_f64, 0.0_f64);
        for line in samples.lines().skip(1) {
            let cells: Vec<f64> = line.split(',').take(6).map(|cell| cell.parse().unwrap()).collect();
            let (lambda, tuned) = (cells[1], cells[5]);
            // nothing is left to lose at N = 4, lambda = 1/2
            if cells[0] != n as f64 || tuned < 1e-9 {
                continue;
            }
            let objective = objective(n, lambda, Settings::default());
            let lost = |(f2, f3)| objective.value(f2, f3).unwrap() / tuned - 1.0;
            let [own, of_usual] = [&entry, usual].map(|entry| lost(entry.weights(lambda).unwrap()));
            overall = overall.max(own);
            if (usual.lambda_r1..=usual.lambda_r2).contains(&lambda) {
                (ours, theirs) = (ours.max(own), theirs.max(of_usual));
            }
        }
        let stored = number(sharp, "excess_overall");
        assert!((overall - stored).abs() <= 1e-6 * stored, "N = {n}: {overall} {stored}");
        assert!(ours <= theirs + 1e-9, "N = {n}: {ours} {theirs}");
        let usual_fit = number(of("detected").unwrap(), "excess");
        assert!(
            (theirs - usual_fit).abs() <= 1e-6 * usual_fit,
            "N = {n}: {theirs} {usual_fit}"
        );
    }
}
