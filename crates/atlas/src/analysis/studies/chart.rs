//! Curves of errors, lines of predicted slopes below them.

use super::{NORMS, Run, norm};
use eigenring_figure::{Anchor, Axis, Chart, Colour, Dash, Figure, Marker, Panel, Side, Style, Width, decades_of};

/// Levels over which lines of predicted slopes run.
const SLOPES: i32 = 3;

/// The height of a line of text over that of a panel.
const TEXT: f64 = 0.085;

/// Places beside ascending ones with at least this ratio between them, about the same middles.
pub(super) fn spread(tops: &[f64], ratio: f64) -> Vec<f64> {
    let mut groups: Vec<(f64, usize)> = Vec::new();
    // a group of places that touch is centred at the mean of what they belong to, in logarithms
    for top in tops {
        groups.push((top.ln(), 1));
        while let [.., (below, n), (above, m)] = groups[..] {
            if above - below >= 0.5 * (n + m) as f64 * ratio.ln() {
                break;
            }
            groups.truncate(groups.len() - 2);
            groups.push(((below * n as f64 + above * m as f64) / (n + m) as f64, n + m));
        }
    }
    let place = |(middle, n): (f64, usize)| (0..n).map(move |k| (middle, k as f64 - 0.5 * (n - 1) as f64));
    let places = groups.into_iter().flat_map(place);
    places.map(|(middle, k)| (middle + k * ratio.ln()).exp()).collect()
}

/// The curves of one panel, lines with the predicted slopes below them.
pub(super) fn chart(runs: &[Run], name: &str) -> Chart {
    let place = NORMS.iter().find(|(of, _)| *of == name).expect("a norm").1;
    let levels = runs.iter().map(|run| run.errors.len()).max().unwrap_or(1) as i32;
    let h = |level: i32| 0.5_f64.powi(level);
    let all = || {
        runs.iter()
            .flat_map(|run| run.errors.iter().map(|error| norm(error, name)))
    };
    let lowest = all().fold(f64::INFINITY, f64::min);
    let (_, high) = decades_of(all()).unwrap_or((0.1, 1.0));
    let mut rates: Vec<f64> = runs.iter().filter_map(|run| run.predicted[place]).collect();
    rates.sort_by(f64::total_cmp);
    // rates that are nearly equal share a line
    rates.dedup_by(|a, b| (*a - *b).abs() < 0.1);
    let foot = lowest / 8.0_f64.powf(rates.last().copied().unwrap_or(0.0) * 0.35) / 10.0;
    // labels of slopes stand behind their lines
    let end = if levels > SLOPES + 1 { 1.3 } else { 2.6 };
    let x = Axis::log("$h$", (h(levels - 1) / 1.3, end));
    let mut chart = Chart::new(
        x,
        Axis::log(format!("error in {}", spelled(name)), (foot / 3.0, high)).with_grid(),
    );
    for run in runs {
        let points = run
            .errors
            .iter()
            .enumerate()
            .map(|(level, error)| [h(level as i32), norm(error, name)]);
        let (colour, marker) = (Colour::line(run.place), Marker::line(run.place));
        chart = chart
            .series(points.collect::<Vec<_>>(), Style::solid(colour).marked(marker))
            .label(run.label.clone());
    }
    let from = levels - 1;
    let to = (from - SLOPES).max(0);
    let tops: Vec<f64> = rates
        .iter()
        .map(|rate| foot * 2.0_f64.powf(rate * f64::from(from - to)))
        .collect();
    let places = spread(&tops, (high / foot * 3.0).powf(TEXT));
    for ((rate, top), place) in rates.into_iter().zip(tops).zip(places) {
        let line = Style::solid(Colour::INK).dashed(Dash::Dashed);
        chart = chart.series(vec![[h(from), foot], [h(to), top]], line).text(
            [1.08 * h(to), place],
            format!("{rate:.2}"),
            Anchor::Start,
            Colour::INK,
        );
    }
    chart
}

pub(super) fn spelled(name: &str) -> &'static str {
    match name {
        "L2" => "$L^2$",
        "H1" => "$H^1$",
        "H2" => "$H^2$",
        _ => "the maximum",
    }
}

/// Panels in rows of three, with one legend.
pub(super) fn figure(title: &str, panels: Vec<(String, Chart)>) -> Figure {
    let columns = panels.len().min(3);
    let rows = panels.len().div_ceil(columns);
    let mut figure = Figure::new(Width::Two, 55.0 * rows as f64 + 12.0, title);
    for (index, (title, chart)) in panels.into_iter().enumerate() {
        figure = figure.panel(index / columns, index % columns, Panel::new(chart).title(title));
    }
    figure.legend(Side::Bottom)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_do_not_overlap_and_stay_in_order() {
        let tops = [1.0, 1.1, 1.2, 50.0, 1000.0, 1500.0];
        let places = spread(&tops, 2.0);
        assert!(
            places.windows(2).all(|pair| pair[1] >= 2.0 * pair[0] * (1.0 - 1e-12)),
            "{places:?}"
        );
        assert!(
            (places[3] - 50.0).abs() < 1e-9 && (places[1] - 1.097).abs() < 1e-2,
            "{places:?}"
        );
        assert!((places[4] * places[5] - 1.5e6).abs() < 1.0, "{places:?}");
    }
}
