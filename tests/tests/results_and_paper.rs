//! **Claim**: the stored results stand beside the paper as `docs/deviations.md` says. **Oracle**: Table 1 of
//! Ma, Wang and Ma (2023), which none of these numbers was fitted to: the end of the recommended region
//! lambda_r2, found here by a criterion of our own, and the tabulated knots lambda_b and lambda_d of N = 8,
//! 9, 10, 12, which are kinks.

use eigenring_scheme::lambda::{LambdaTable, PAPER_TABLE_1};
use eigenring_tests::Comparison;
use eigenring_tune::sweep::sample_lambdas;
use std::path::Path;

/// The rows of a file of the results, each as its entries by column.
fn rows(name: &str) -> Vec<Vec<String>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../results/lambda")
        .join(name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("results/lambda/{name}: {error}"));
    // no entry of these tables has a comma or a quote
    text.lines()
        .skip(1)
        .map(|line| line.split(',').map(str::to_owned).collect())
        .collect()
}

#[test]
fn the_recommended_region_ends_where_the_paper_says() {
    // 2.9e-3 at N = 5, 1.1e-3 elsewhere: see docs/deviations.md
    let mut comparison = Comparison::new("lambda_r2", 3e-3);
    for row in PAPER_TABLE_1 {
        let entry = LambdaTable::embedded().unwrap().entry(row.valence).unwrap();
        comparison.check(format!("N = {}", row.valence), entry.lambda_r2, row.lambda_r2);
        if row.valence != 5 {
            assert!((entry.lambda_r2 - row.lambda_r2).abs() < 1.2e-3, "N = {}", row.valence);
        }
    }
    assert_eq!(comparison.count(), PAPER_TABLE_1.len());
    comparison.finish();
}

#[test]
fn the_papers_kinks_are_among_the_candidates() {
    let candidates = rows("kinks.csv");
    let mut checked = 0;
    for row in PAPER_TABLE_1.iter().filter(|row| [8, 9, 10, 12].contains(&row.valence)) {
        let samples = sample_lambdas(row.valence).unwrap();
        for (slot, paper) in [("b", row.lambda_b), ("d", row.lambda_d)] {
            // samples are spaced differently on both sides of lambda_l
            let index = samples.partition_point(|&lambda| lambda < paper);
            let spacing = samples[index] - samples[index - 1];
            let nearest = candidates
                .iter()
                .filter(|c| c[0] == row.valence.to_string() && c[2] == slot)
                .map(|c| (c[1].parse::<f64>().unwrap() - paper).abs())
                .fold(f64::INFINITY, f64::min);
            assert!(
                nearest <= 3.0 * spacing,
                "N = {}, lambda_{slot} = {paper}: nearest at {nearest}",
                row.valence
            );
            checked += 1;
        }
    }
    assert_eq!(checked, 8);
}

#[test]
fn splines_stay_close_to_the_samples() {
    // E of the splines exceeds that of the samples by at most 8.2 %, and eigenvalue bounds keep their margin
    // of 1e-6
    let table = rows("accuracy.csv");
    assert_eq!(table.len(), 18);
    for row in table {
        let number = |column: usize| row[column].parse::<f64>().unwrap();
        let (excess, strictness, slack) = (number(5), number(6), number(7));
        assert!((0.0..0.083).contains(&excess), "N = {}: excess {excess}", row[0]);
        assert!(strictness > 0.99e-6, "N = {}: strictness {strictness}", row[0]);
        assert!(slack > -1e-12, "N = {}: slack {slack}", row[0]);
    }
}
