//! The regularisation and the weight of the objective: Ma, Wang and Ma (2023), Fig. 5.
//!
//! Eqs. 16 and 17, `r(K, e) = (K + sqrt(K^2 + 4 e^2))/2` and `w = r(K, n e)/r(K, e)`, straight from their
//! definition. K is in units of the ideal map's |ac - b^2|, as in Eq. 20.

use super::{Drawing, FigureEntry, Inputs};
use crate::error::Error;
use crate::table::{Cell, Table};
use eigenring_figure::{Axis, Chart, Colour, Figure, Panel, Side, Stroke, Style};
use eigenring_tune::objective::Settings;

pub const ENTRY: FigureEntry = FigureEntry::new(
    "weighting",
    "regularisation r(K, epsilon) and weight w(K, epsilon, n) of the objective",
    "Ma, Wang and Ma 2023, Fig. 5",
    build,
);

/// `r(K, e)`, without cancellation for negative K.
fn regularised(k: f64, e: f64) -> f64 {
    let root = (k * k + 4.0 * e * e).sqrt();
    if k >= 0.0 {
        (k + root) / 2.0
    } else {
        2.0 * e * e / (root - k)
    }
}

fn weight(k: f64, e: f64, n: f64) -> f64 {
    regularised(k, n * e) / regularised(k, e)
}

/// The K shown, and the steps between.
const K: (f64, f64) = (-2.0, 2.0);
const STEPS: usize = 400;

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    let usual = Settings::default();
    let epsilons = [0.05, usual.epsilon, 0.5];
    // the usual weight first, then a steeper and a lower one
    let weights = [(usual.n, usual.epsilon), (usual.n, 0.05), (3.0, usual.epsilon)];
    let k = |i: usize| K.0 + (K.1 - K.0) * i as f64 / STEPS as f64;
    let axis = || Axis::new("$K/|ac-b^2|$", K);
    let zero = Stroke::solid(Colour::GREY, 0.15);

    let mut columns = vec!["K".to_owned()];
    let mut left = Chart::new(axis(), Axis::new("$r(K, ε)$", (0.0, 2.2)).with_grid()).vertical(0.0, "", zero);
    for (index, e) in epsilons.into_iter().enumerate() {
        columns.push(format!("r_epsilon={e}"));
        let curve = (0..=STEPS).map(|i| [k(i), regularised(k(i), e)]);
        left = left.series(curve, Style::line(index)).label(format!("$ε$ = {e}"));
    }
    let mut right = Chart::new(axis(), Axis::new("$w(K, ε, n)$", (0.0, 26.0)).with_grid()).vertical(0.0, "", zero);
    for (index, (n, e)) in weights.into_iter().enumerate() {
        columns.push(format!("w_n={n}_epsilon={e}"));
        let curve = (0..=STEPS).map(|i| [k(i), weight(k(i), e, n)]);
        right = right
            .series(curve, Style::line(index))
            .label(format!("$n$ = {n}, $ε$ = {e}"));
    }

    let mut table = Table::new(columns);
    for k in (0..=STEPS).map(k) {
        let mut row = vec![Cell::from(k)];
        row.extend(epsilons.map(|e| Cell::from(regularised(k, e))));
        row.extend(weights.map(|(n, e)| Cell::from(weight(k, e, n))));
        table.push(row);
    }
    let (height, second) = if inputs.is_wide() {
        (62.0, (0, 1))
    } else {
        (124.0, (1, 0))
    };
    let figure = Figure::new(inputs.width, height, "Regularisation and weight of the objective")
        .panel(0, 0, Panel::new(left).title("regularisation").legend(Side::Bottom))
        .panel(
            second.0,
            second.1,
            Panel::new(right).title("weight").legend(Side::Bottom),
        );
    Ok(vec![Drawing::of(&ENTRY, figure, table)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_of_the_weight() {
        assert!((weight(0.0, 0.2, 5.0) - 5.0).abs() < 1e-14);
        assert!((weight(-1e6, 0.2, 5.0) - 25.0).abs() < 1e-9 && (weight(1e6, 0.2, 5.0) - 1.0).abs() < 1e-9);
        // r(K) r(-K) = e^2
        for k in [0.1, 1.0, 7.5] {
            assert!((regularised(k, 0.3) * regularised(-k, 0.3) - 0.09).abs() < 1e-15);
        }
    }
}
