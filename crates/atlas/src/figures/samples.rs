//! Samples and splines of one valence: Ma, Wang and Ma (2023), Fig. 6.
//!
//! The objective and the weights of the tuned samples (the paper's superscript #) beside those of the
//! splines. Where the paper draws the curve (f2, f3, E) in space, the angle theta has a panel of its own.

use super::{Drawing, FigureEntry, Inputs, sweep};
use crate::error::Error;
use crate::table::Table;
use eigenring_figure::{Axis, Chart, Colour, Dash, Figure, Marker, Panel, Side, Stroke, Style, decades_of, range_of};
use eigenring_scheme::lambda::{LambdaEntry as Splines, Relaxation};
use eigenring_tune::objective::Objective;
use eigenring_tune::study::TINY;
use eigenring_tune::sweep::BranchSample;

pub const ENTRY: FigureEntry = FigureEntry {
    valences: &[3, 6, 20],
    range: true,
    studies: true,
    ..FigureEntry::new(
        "samples",
        "samples and splines of f2 and f3, their errors, E, s and theta, one picture for each valence",
        "Ma, Wang and Ma 2023, Fig. 6",
        build,
    )
};

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    inputs.valences.iter().map(|&valence| draw(valence, inputs)).collect()
}

/// A sample and the spline stencil at its lambda.
struct Pair<'a> {
    sample: &'a BranchSample,
    f2: f64,
    f3: f64,
    total: f64,
}

impl Pair<'_> {
    fn lambda(&self) -> f64 {
        self.sample.lambda
    }

    /// `E/E# - 1`, where E# is not zero up to rounding.
    fn excess(&self) -> Option<f64> {
        let tuned = self.sample.minimum.total;
        (tuned > TINY).then(|| self.total / tuned - 1.0)
    }
}

fn pairs<'a>(splines: &Splines, inputs: &Inputs<'a>) -> Result<Vec<Pair<'a>>, Error> {
    let options = inputs.studies.options();
    let study = inputs.studies.get(splines.valence)?;
    let shown = study
        .samples
        .iter()
        .filter(|sample| (inputs.range.0..=inputs.range.1).contains(&sample.lambda));
    shown
        .map(|sample| {
            let mut plane = Relaxation::new(splines.valence)?.plane(sample.lambda)?;
            plane.phi = options.phi;
            let (f2, f3) = splines.weights(sample.lambda)?;
            let total = Objective::new(plane, options.settings)?.value(f2, f3)?;
            Ok(Pair { sample, f2, f3, total })
        })
        .collect()
}

/// Height of a row of panels over two columns and over one, and of the legend, in millimetres.
const ROWS: [f64; 2] = [50.0, 35.0];
const AROUND: [f64; 2] = [12.0, 22.0];

fn draw(valence: usize, inputs: &Inputs<'_>) -> Result<Drawing, Error> {
    let (splines, points) = sweep::curve(valence, inputs)?;
    let pairs = pairs(&splines, inputs)?;
    let charts = charts(&splines, &points, &pairs, inputs);
    let across = if inputs.is_wide() { 2 } else { 1 };
    let count = charts.len();
    let height = ROWS[2 - across] * count.div_ceil(across) as f64 + AROUND[2 - across];
    let description = format!("Samples and splines of the lambda-scheme at valence {valence}");
    let mut figure = Figure::new(inputs.width, height, description);
    for (index, (title, mut chart)) in charts.into_iter().enumerate() {
        chart.x = sweep::own_axis(inputs, &splines, index + across >= count);
        // the symbols of the featured values stand above the first row
        let chart = sweep::mark_joint(sweep::mark(chart, &splines, index < across));
        figure = figure.panel(index / across, index % across, Panel::new(chart).title(title));
    }
    let mut curve = sweep::curve_table();
    sweep::push_curve(&mut curve, valence, &points);
    Ok(Drawing {
        stem: format!("{}-n{valence}", ENTRY.name),
        figure: figure.legend(Side::Bottom),
        data: vec![("curve", curve), ("samples", table(valence, &pairs))],
    })
}

fn charts(
    splines: &Splines,
    points: &[sweep::SweepPoint],
    pairs: &[Pair<'_>],
    inputs: &Inputs<'_>,
) -> Vec<(String, Chart)> {
    let chart = |y: Axis| Chart::new(sweep::lambda_axis(inputs, false), y.with_grid());
    let [f2, f3, other] = [sweep::F2, sweep::F3, 2];
    let marked = |index: usize| {
        let mut style = Style::points(Marker::line(index), Colour::line(index));
        style.marker = Some((Marker::line(index), 0.45));
        style
    };
    let samples = |value: fn(&BranchSample) -> f64| pairs.iter().map(move |pair| [pair.lambda(), value(pair.sample)]);

    let weights = chart(Axis::new("weight", (0.0, 1.04 * sweep::largest(points))));
    let weights = sweep::draw_weights(weights, points)
        .series(samples(|s| s.minimum.f2), marked(f2))
        .label("$f_2^#$ (tuned)")
        .series(samples(|s| s.minimum.f3), marked(f3))
        .label("$f_3^#$ (tuned)");

    let errors = |value: fn(&Pair<'_>) -> f64| pairs.iter().map(move |pair| [pair.lambda(), value(pair)]);
    let in_f2 = |pair: &Pair<'_>| shown_error(pair.f2 - pair.sample.minimum.f2);
    let in_f3 = |pair: &Pair<'_>| shown_error(pair.f3 - pair.sample.minimum.f3);
    let thin = |index: usize, style: Style| {
        let mut style = style.wide(0.18);
        style.marker = Some((Marker::line(index), 0.5));
        style
    };
    let both = pairs.iter().flat_map(|pair| [in_f2(pair), in_f3(pair)]);
    let error = chart(Axis::log("distance to samples", shown_decades(both)))
        .series(errors(in_f2), thin(f2, sweep::style(f2)))
        .label("$|f_2 - f_2^#|$")
        .series(errors(in_f3), thin(f3, sweep::style(f3)))
        .label("$|f_3 - f_3^#|$");

    let totals = points
        .iter()
        .map(|p| p.total)
        .chain(pairs.iter().map(|pair| pair.sample.minimum.total));
    let objective = chart(Axis::log("objective $E$", shown_decades(totals)))
        .series(
            points.iter().map(|p| [p.lambda, p.total]),
            Style::solid(Colour::line(other)),
        )
        .label("$E$, $s$, $θ$ of the splines")
        .series(samples(|s| s.minimum.total), marked(other))
        .label("of the samples");

    let excess = |pair: &Pair<'_>| pair.excess().map_or(f64::NAN, shown_error);
    let loss = chart(Axis::log("$|E/E^# - 1|$", shown_decades(pairs.iter().map(excess))))
        .series(errors(excess), thin(other, Style::solid(Colour::line(other))));

    let largest = points.iter().map(|p| p.s).fold(1.0, f64::max);
    let s = chart(Axis::new("$s = μ/λ^2$", (0.0, 1.06 * largest)))
        .series(
            points.iter().map(|p| [p.lambda, p.s]),
            Style::solid(Colour::line(other)),
        )
        .series(samples(|s| s.s), marked(other));

    let bound = 90.0 - 90.0 / splines.valence as f64;
    let angles = points
        .iter()
        .map(|p| p.theta)
        .chain(pairs.iter().map(|p| p.sample.minimum.theta.to_degrees()));
    let range = range_of(angles.chain([bound]), 0.06).unwrap_or((0.0, 90.0));
    let theta = chart(Axis::new("$θ$ in degrees", range))
        .horizontal(
            bound,
            Stroke {
                dash: Dash::Dotted,
                ..Stroke::solid(Colour::INK, 0.25)
            },
        )
        .label("bound of $θ$")
        .series(
            points.iter().map(|p| [p.lambda, p.theta]),
            Style::solid(Colour::line(other)),
        )
        .series(samples(|s| s.minimum.theta.to_degrees()), marked(other));

    vec![
        (format!("$N$ = {}: weights", splines.valence), weights),
        ("error of the splines".to_owned(), error),
        ("objective".to_owned(), objective),
        ("relative loss of the splines".to_owned(), loss),
        ("relaxation".to_owned(), s),
        ("angle".to_owned(), theta),
    ]
}

/// The size of an error; where splines interpolate it is rounding, which is not shown.
fn shown_error(error: f64) -> f64 {
    if error.abs() > INTERPOLATED {
        error.abs()
    } else {
        f64::NAN
    }
}

/// Interpolated samples are met to rounding of the fit.
const INTERPOLATED: f64 = 1e-12;

/// The powers of ten around the values, without what is below [`LEAST`] of the largest.
fn shown_decades(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let (low, high) = decades_of(values).unwrap_or((1e-3, 1.0));
    (low.max(high * LEAST), high)
}

/// Errors this much smaller than the largest one tell nothing.
const LEAST: f64 = 1e-8;

fn table(valence: usize, pairs: &[Pair<'_>]) -> Table {
    let mut table = Table::new([
        "valence",
        "lambda",
        "s",
        "f2",
        "f3",
        "E",
        "theta",
        "f2_spline",
        "f3_spline",
        "E_spline",
        "excess",
        "active",
    ]);
    for pair in pairs {
        let (sample, m) = (pair.sample, &pair.sample.minimum);
        table.push(vec![
            valence.into(),
            sample.lambda.into(),
            sample.s.into(),
            m.f2.into(),
            m.f3.into(),
            m.total.into(),
            m.theta.to_degrees().into(),
            pair.f2.into(),
            pair.f3.into(),
            pair.total.into(),
            pair.excess().into(),
            m.active.join("+").into(),
        ]);
    }
    table
}
