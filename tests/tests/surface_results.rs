//! What the stored tables of surfaces say, against theorems and closed forms: Gauss and Bonnet, the power by
//! which Catmull-Clark's curvature grows, sine modes of open fans, darts and cusps known to many digits.

use std::f64::consts::{PI, TAU};
use std::path::Path;

fn rows(file: &str) -> Vec<std::collections::HashMap<String, String>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../results").join(file);
    let text = std::fs::read_to_string(path).unwrap();
    let mut lines = text
        .lines()
        .map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let head = lines.next().unwrap();
    lines.map(|line| head.iter().cloned().zip(line).collect()).collect()
}

/// The subdominant eigenvalue of Catmull-Clark, and that of any Fourier frequency.
fn catmull_clark(cosine: f64) -> f64 {
    (5.0 + cosine + ((9.0 + cosine) * (1.0 + cosine)).sqrt()) / 16.0
}

#[test]
fn total_curvature_approaches_that_of_gauss_and_bonnet() {
    let rows = rows("surfaces/total-curvature.csv");
    assert_eq!(rows.len(), 12);
    for row in rows {
        let number = |key: &str| row[key].parse::<f64>().unwrap();
        let expected = number("two_pi_chi");
        assert!((expected / TAU - (expected / TAU).round()).abs() < 1e-12);
        let off = |key: &str| (number(key) - expected).abs();
        assert!(off("graded") < 0.02, "{row:?}");
        // beside centres of Catmull-Clark curvature is unbounded, and equal cells find it slowly
        assert!(off("samples_32") < 0.7 * off("samples_16"), "{row:?}");
        let modelled = ["spot", "fish", "penguin"].contains(&row["shape"].as_str());
        let most = match (modelled, row["scheme"].as_str()) {
            (true, "catmull-clark") => 1.1,
            _ => 0.09,
        };
        assert!(off("samples_32") < most, "{row:?}");
    }
}

/// K grows like `r^(2 log mu / log lambda - 4)`; of a saddle mu is the eigenvalue of frequency 2, of a bowl
/// that of frequency 0, which is smaller.
#[test]
fn centres_have_the_known_exponents() {
    let rows = rows("surfaces/curvature.csv");
    assert_eq!(rows.len(), 40);
    for row in rows {
        let valence: f64 = row["valence"].parse().unwrap();
        let number = |key: &str| row[key].parse::<f64>().unwrap();
        if row["scheme"] != "catmull-clark" {
            assert!(["bounded", "regular"].contains(&row["kind"].as_str()), "{row:?}");
            // curvature beside the centre is within the range that is given for it
            let slack = 1e-3 * (number("gauss_max") - number("gauss_min")).abs() + 1e-6;
            assert!(number("gauss_min@1e-12") > number("gauss_min") - slack, "{row:?}");
            assert!(number("gauss_max@1e-12") < number("gauss_max") + slack, "{row:?}");
            continue;
        }
        if valence < 5.0 {
            assert_eq!(row["kind"], if valence == 3.0 { "flat" } else { "regular" });
            continue;
        }
        let lambda = catmull_clark((TAU / valence).cos());
        let saddle = catmull_clark((2.0 * TAU / valence).cos());
        let exponent = |mu: f64| 2.0 * mu.ln() / lambda.ln() - 4.0;
        if row["star"] == "saddle" {
            assert!(
                (number("exponent") - exponent(saddle)).abs() < 1e-9,
                "{row:?} {}",
                exponent(saddle)
            );
        } else {
            assert!(
                number("exponent") < 0.0 && number("exponent") > exponent(saddle),
                "{row:?}"
            );
        }
    }
}

#[test]
fn features_have_the_known_eigenvalues() {
    let rows = rows("tension-surfaces/spectra.csv");
    let has = |order: &str, feature: &str, faces: usize, value: f64, digits: f64| {
        let row = rows
            .iter()
            .find(|row| {
                row["order"] == order
                    && row["feature"] == feature
                    && row["faces"] == faces.to_string()
                    && row["cs"].is_empty()
            })
            .unwrap();
        let found = (0..6).filter_map(|k| row[&format!("eigenvalue_{k}")].parse::<f64>().ok());
        assert!(
            found.into_iter().any(|x| (x - value).abs() < digits),
            "{value} in {row:?}"
        );
    };
    for n in 1..=8 {
        // the crease curve's half, and the first sine mode of the closed fan of 2n faces
        has("4", "fan", n, 0.5, 1e-12);
        if n > 1 {
            has("4", "fan", n, catmull_clark((PI / n as f64).cos()), 1e-12);
        }
    }
    for n in 3..=8 {
        has("4", "cusp", n, (3.0 + 5_f64.sqrt()) / 8.0, 1e-12);
    }
    has("4", "dart", 5, 0.5264, 5e-5);
    has("4", "dart", 5, 0.5500, 5e-5);
    has("4", "dart", 5, 0.3920, 5e-5);
    has("4", "dart", 4, 0.3197, 5e-5);
}
