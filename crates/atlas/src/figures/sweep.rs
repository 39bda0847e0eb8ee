//! What the figures over lambda share: the spline stencils on a fine grid, the axis, featured values.

use super::{Inputs, Studies};
use crate::error::Error;
use crate::table::{Cell, Table};
use eigenring_figure::{Axis, Chart, Colour, Dash, Fill, Stroke};
use eigenring_scheme::lambda::{Domain, LambdaEntry, Relaxation};
use eigenring_tune::objective::Objective;
use eigenring_tune::study::{LAMBDA_A, LAMBDA_M, lambda_catmull_clark};
use eigenring_tune::sweep::Options;

/// The axis of the subdominant eigenvalue.
pub fn lambda_axis(inputs: &Inputs<'_>, label: bool) -> Axis {
    Axis::new(if label { "subdominant eigenvalue $λ$" } else { "" }, inputs.range)
}

/// The axis for one valence. At large ones the lambdas above lambda_l, a third of the samples, are a small
/// part of the range: they get a wider scale of their own.
pub fn own_axis(inputs: &Inputs<'_>, entry: &LambdaEntry, label: bool) -> Axis {
    let axis = lambda_axis(inputs, label);
    let part = (inputs.range.1 - entry.lambda_l) / (inputs.range.1 - inputs.range.0);
    match part < CROWDED {
        true => axis.with_joint(entry.lambda_l, 1.0 - WIDENED),
        false => axis,
    }
}

/// A part of the axis that is widened, and how much of the axis it then takes.
const CROWDED: f64 = 0.15;
const WIDENED: f64 = 0.4;

/// Shows where the axis changes its scale, if it does.
pub fn mark_joint(chart: Chart) -> Chart {
    match chart.x.joint {
        Some((lambda, _)) => chart
            .vertical(lambda, "", Stroke::solid(Colour::INK, 0.25))
            .label("change of scale"),
        None => chart,
    }
}

/// Colours of f2 and f3 wherever they are drawn.
pub const F2: usize = 0;
/// See [`F2`].
pub const F3: usize = 1;

/// The featured values that are marked along lambda, as symbols.
pub fn featured(entry: &LambdaEntry) -> [(&'static str, f64); 7] {
    [
        ("$λ_{r1}$", entry.lambda_r1),
        ("$λ_A^*$", LAMBDA_A),
        ("$λ_l$", entry.lambda_l),
        ("$λ_M^*$", LAMBDA_M),
        ("$λ_{CC}$", lambda_catmull_clark(entry.valence)),
        ("$λ_C^*$", entry.lambda_optimal),
        ("$λ_{r2}$", entry.lambda_r2),
    ]
}

/// The line of a featured value.
pub fn rule() -> Stroke {
    Stroke {
        dash: Dash::Dashed,
        ..Stroke::solid(Colour::GREY, 0.15)
    }
}

/// Shades the recommended region and marks the featured values, with their symbols above the frame or
/// without.
pub fn mark(chart: Chart, entry: &LambdaEntry, symbols: bool) -> Chart {
    let chart = chart
        .span(entry.lambda_r1, entry.lambda_r2, Colour::SHADE)
        .label("recommended $λ$");
    featured(entry).into_iter().fold(chart, |chart, (symbol, lambda)| {
        chart.vertical(lambda, if symbols { symbol } else { "" }, rule())
    })
}

/// The spline stencil at one lambda, with what is feasible there.
#[derive(Clone, Debug)]
pub struct SweepPoint {
    pub lambda: f64,
    pub s: f64,
    pub f2: f64,
    pub f3: f64,
    /// The objective.
    pub total: f64,
    /// The angle at F, in degrees.
    pub theta: f64,
    /// The feasible f3.
    pub f3_range: [f64; 2],
    /// The feasible f2 at this f3: one interval, or two.
    pub f2_ranges: Vec<[f64; 2]>,
}

/// Equal steps of lambda over the range shown.
const STEPS: usize = 400;

impl SweepPoint {
    fn new(entry: &LambdaEntry, lambda: f64, options: &Options) -> Result<Self, Error> {
        let mut plane = Relaxation::new(entry.valence)?.plane(lambda)?;
        plane.phi = options.phi;
        let (f2, f3) = entry.weights(lambda)?;
        let domain = Domain::new(plane, options.bounds, 0.0)?;
        let f3_range = domain.f3_range().map(|end| end.f3);
        // where f3 lies on its bound, rounding must not put it outside
        let row = f3.clamp(f3_range[0], f3_range[1]);
        Ok(SweepPoint {
            lambda,
            s: plane.s,
            f2,
            f3,
            total: Objective::new(plane, options.settings)?.value(f2, f3)?,
            theta: domain.theta(f2, f3).to_degrees(),
            f3_range,
            f2_ranges: domain
                .f2_intervals(row)
                .iter()
                .map(|interval| [interval.lower.f2, interval.upper.f2])
                .collect(),
        })
    }
}

/// The spline stencils over the range shown, as far as they are defined; kinks and knots are among the
/// lambdas.
pub fn curve(valence: usize, inputs: &Inputs<'_>) -> Result<(LambdaEntry, Vec<SweepPoint>), Error> {
    let studies: &Studies = inputs.studies;
    let options = studies.options();
    let entry = studies.entry(valence)?.ok_or_else(|| Error::Range {
        what: "valence",
        given: valence.to_string(),
        accepted: "one with tabulated splines, 3 to 20".to_owned(),
    })?;
    let knots = entry.knots;
    let (from, to) = (inputs.range.0.max(knots.a), inputs.range.1.min(knots.e));
    if !(from < to) {
        return Err(Error::Range {
            what: "lambda range",
            given: format!("{}..{}", inputs.range.0, inputs.range.1),
            accepted: format!("one that meets the splines' {}..{}", knots.a, knots.e),
        });
    }
    let grid = (0..=STEPS).map(|k| match k {
        STEPS => to,
        _ => from + (to - from) * k as f64 / STEPS as f64,
    });
    let mut lambdas: Vec<f64> = grid
        .chain(Relaxation::new(valence)?.kinks())
        .chain([knots.b, knots.c, knots.d])
        .filter(|lambda| (from..=to).contains(lambda))
        .collect();
    lambdas.sort_by(f64::total_cmp);
    lambdas.dedup();
    let points = lambdas
        .into_iter()
        .map(|lambda| SweepPoint::new(&entry, lambda, &options));
    let points = points.collect::<Result<_, _>>()?;
    Ok((entry, points))
}

/// The data of curves: one row for each valence and lambda.
pub fn curve_table() -> Table {
    Table::new([
        "valence", "lambda", "s", "f2", "f3", "E", "theta", "f3_min", "f3_max", "f2_min", "f2_max", "f2_min_2",
        "f2_max_2",
    ])
}

/// Adds the points of one valence.
pub fn push_curve(table: &mut Table, valence: usize, points: &[SweepPoint]) {
    for p in points {
        let interval = |k: usize, end: usize| Cell::from(p.f2_ranges.get(k).map(|range| range[end]));
        let mut row: Vec<Cell> = vec![valence.into()];
        row.extend(
            [
                p.lambda,
                p.s,
                p.f2,
                p.f3,
                p.total,
                p.theta,
                p.f3_range[0],
                p.f3_range[1],
            ]
            .map(Cell::from),
        );
        row.extend([interval(0, 0), interval(0, 1), interval(1, 0), interval(1, 1)]);
        table.push(row);
    }
}

/// Adds what is feasible, and the splines, of f2 and f3. Where both are feasible, f3's hatching lies over
/// f2's colour.
pub fn draw_weights(chart: Chart, points: &[SweepPoint]) -> Chart {
    let plain = Fill::Plain(Colour::line(F2).mix(Colour::WHITE, 0.7));
    let hatched = Fill::Hatched(Colour::line(F3).mix(Colour::WHITE, 0.35));
    let band = |k: usize| {
        points.iter().map(move |p| match p.f2_ranges.get(k) {
            Some([low, high]) => [p.lambda, *low, *high],
            // NaN interrupts a band: here is no second interval
            None => [p.lambda, f64::NAN, f64::NAN],
        })
    };
    let mut chart = chart.band(band(0), plain).label("feasible $f_2$ at this $f_3$");
    if points.iter().any(|p| p.f2_ranges.len() > 1) {
        chart = chart.band(band(1), plain);
    }
    let of_f3 = points.iter().map(|p| [p.lambda, p.f3_range[0], p.f3_range[1]]);
    chart = chart.band(of_f3, hatched).label("feasible $f_3$");
    chart
        .series(points.iter().map(|p| [p.lambda, p.f2]), style(F2))
        .label("$f_2(λ)$")
        .series(points.iter().map(|p| [p.lambda, p.f3]), style(F3))
        .label("$f_3(λ)$")
}

/// Lines that belong to f2 or f3; the second is dashed.
pub fn style(index: usize) -> eigenring_figure::Style {
    eigenring_figure::Style::line(index)
}

/// The largest weight or feasible weight, for the axis.
pub fn largest(points: &[SweepPoint]) -> f64 {
    let ends = points.iter().flat_map(|p| {
        [p.f2, p.f3, p.f3_range[1]]
            .into_iter()
            .chain(p.f2_ranges.iter().map(|r| r[1]))
    });
    ends.fold(0.0, f64::max)
}
