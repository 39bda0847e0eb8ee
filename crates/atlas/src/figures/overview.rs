//! The family at a glance: Ma, Wang and Ma (2023), Fig. 1.
//!
//! For one valence the splines of f2 and f3 with the tuned samples and the featured lambdas; these against
//! the valence; and three natural configurations, each drawn to the same size.

use super::nets::NaturalNet;
use super::{Drawing, FigureEntry, Inputs, feasible_region, sweep};
use crate::error::Error;
use eigenring_figure::{Axis, Chart, Colour, Figure, Marker, Panel, Side, Style};
use eigenring_scheme::lambda::{LambdaEntry as Splines, Relaxation};
use eigenring_tune::study::{LAMBDA_A, LAMBDA_M};

pub const ENTRY: FigureEntry = FigureEntry {
    valences: &[6],
    range: true,
    studies: true,
    shaded: true,
    ..FigureEntry::new(
        "overview",
        "f2 and f3 against lambda, featured lambdas against the valence, natural configurations",
        "Ma, Wang and Ma 2023, Fig. 1",
        build,
    )
};

/// Rings of the nets.
const RINGS: usize = 3;

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    inputs.valences.iter().map(|&valence| draw(valence, inputs)).collect()
}

fn draw(valence: usize, inputs: &Inputs<'_>) -> Result<Drawing, Error> {
    let (splines, points) = sweep::curve(valence, inputs)?;
    let y = Axis::new("weight", (0.0, 1.04 * sweep::largest(&points))).with_grid();
    let chart = Chart::new(sweep::own_axis(inputs, &splines, true), y);
    let chart = sweep::mark_joint(sweep::mark(chart, &splines, true));
    let mut weights = sweep::draw_weights(chart, &points);
    let samples = &inputs.studies.get(valence)?.samples;
    type Weight = fn(&eigenring_tune::sweep::BranchSample) -> f64;
    let tuned: [(usize, Weight, &str); 2] = [
        (sweep::F2, |s| s.minimum.f2, "$f_2$, tuned"),
        (sweep::F3, |s| s.minimum.f3, "$f_3$, tuned"),
    ];
    for (index, weight, label) in tuned {
        let mut style = Style::points(Marker::line(index), Colour::line(index));
        style.marker = Some((Marker::line(index), 0.45));
        weights = weights
            .series(samples.iter().map(|s| [s.lambda, weight(s)]), style)
            .label(label);
    }
    let all = Inputs {
        valences: feasible_region::ENTRY.valences,
        ..*inputs
    };
    let (region, region_table) = feasible_region::chart(&all)?;
    let weights = Panel::new(weights)
        .title(format!("stencils, $N$ = {valence}"))
        .legend(Side::Bottom);
    let region = Panel::new(region).title("featured $λ$").legend(Side::Bottom);

    let mut figure = Figure::new(
        inputs.width,
        if inputs.is_wide() { 140.0 } else { 210.0 },
        "The lambda-scheme: stencils, featured eigenvalues and natural configurations",
    );
    let row = if inputs.is_wide() {
        figure = figure.wide_panel(0, 0, 3, weights).wide_panel(0, 3, 3, region);
        1
    } else {
        figure = figure.wide_panel(0, 0, 6, weights).wide_panel(1, 0, 6, region);
        2
    };
    let mut nets = NaturalNet::table(&["symbol", "lambda", "f2", "f3"]);
    let shown = [
        ("$λ_A^*$", LAMBDA_A),
        ("$λ_M^*$", LAMBDA_M),
        ("$λ_C^*$", splines.lambda_optimal),
    ];
    for (index, (symbol, lambda)) in shown.into_iter().enumerate() {
        let (net, [f2, f3]) = net(&splines, lambda)?;
        let name = symbol.replace(['$', '^', '*'], "").replace('λ', "lambda");
        net.push(&mut nets, &[name.into(), lambda.into(), f2.into(), f3.into()]);
        let title = match index {
            2 => format!("{symbol} = {lambda:.4}"),
            _ => format!("{symbol} = {lambda}"),
        };
        figure = figure.wide_panel(row, 2 * index, 2, Panel::new(net.chart()).title(title));
    }
    let figure = figure.row_heights(if inputs.is_wide() {
        &[1.2, 1.0]
    } else {
        &[1.3, 1.3, 0.6]
    });
    let mut curve = sweep::curve_table();
    sweep::push_curve(&mut curve, valence, &points);
    let stem = match ENTRY.valences.contains(&valence) {
        true => ENTRY.name.to_owned(),
        false => format!("{}-n{valence}", ENTRY.name),
    };
    Ok(Drawing {
        stem,
        figure,
        data: vec![("curve", curve), ("featured", region_table), ("nets", nets)],
    })
}

/// The natural configuration of the spline stencil at lambda, and the stencil's f2 and f3.
fn net(splines: &Splines, lambda: f64) -> Result<(NaturalNet, [f64; 2]), Error> {
    let valence = splines.valence;
    let (f2, f3) = splines.weights(lambda)?;
    let mut plane = Relaxation::new(valence)?.plane(lambda)?;
    plane.phi = splines.phi;
    let scheme = plane.stencil(f2, f3).weights.scheme("lambda", valence)?;
    Ok((NaturalNet::new(&scheme, RINGS)?, [f2, f3]))
}
