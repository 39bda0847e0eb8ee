//! A curve as a picture: control polygon, levels, limit.
//!
//! A plane curve is drawn as it is, one coordinate as a graph over the parameter, a spatial curve in plan and
//! elevation: x, y and x, z. Scales are equal in both directions unless that would leave a thread.

use super::levels::coordinates;
use crate::error::Error;
use eigenring_figure::{Axis, Chart, Colour, Dash, Figure, Marker, Panel, Side, Stroke, Style, Width, range_of};
use eigenring_spline::curve::{Curve, Ends};

/// Levels that are drawn; later ones cannot be told from the limit.
const LEVELS: usize = 4;
/// Points are marked where they are no more than this: beyond, markers would run into each other.
const MARKED: usize = 80;
/// A picture whose sides differ by more than this factor has a scale for each.
const THREAD: f64 = 4.0;
/// What stands around the data of a panel, in millimetres: ticks and labels, title, legend.
const BESIDE: f64 = 14.0;
const AROUND: f64 = 22.0;
/// Least and largest height of the data, in millimetres.
const HEIGHT: (f64, f64) = (30.0, 120.0);

/// Coordinates that differ by less than this part of their size are the same but for rounding.
const ROUNDING: f64 = 1e-12;

/// The range that shows these values, which are coordinates of points as large as `size`: not that of
/// rounding errors.
pub fn visible_range(values: impl IntoIterator<Item = f64>, size: f64, margin: f64) -> (f64, f64) {
    let (low, high) = range_of(values, 0.0).unwrap_or((0.0, 0.0));
    let size = if size > 0.0 { size } else { 1.0 };
    let beyond = match high - low {
        span if span > ROUNDING * size => margin * span,
        _ => size / 2.0,
    };
    (low - beyond, high + beyond)
}

/// The largest absolute coordinate.
pub fn size_of<'a>(coordinates: impl IntoIterator<Item = &'a f64>) -> f64 {
    coordinates.into_iter().fold(0.0, |size, x| size.max(x.abs()))
}

/// A polygon or curve: parameters and points, the first one repeated at the end if it is closed.
type Path = Vec<(f64, Vec<f64>)>;

fn polygon(curve: &Curve) -> Path {
    let axis = curve.axis();
    let mut path: Path = curve
        .points()
        .enumerate()
        .map(|(i, point)| (axis.parameter(i), point.to_vec()))
        .collect();
    if axis.ends() == Ends::Closed {
        let (t, first) = &path[0];
        let (from, to) = axis.domain();
        path.push((t + to - from, first.clone()));
    }
    path
}

/// The picture of a curve of one to three coordinates: `levels` from the control polygon on, points of the
/// limit with their parameters.
pub fn figure(levels: &[Curve], limit: &[(f64, Vec<f64>)], width: Width, title: &str) -> Result<Figure, Error> {
    let dimension = levels.first().map_or(0, Curve::dimension);
    let pick = |i: usize| move |(t, point): &(f64, Vec<f64>)| if i == 0 { *t } else { point[i - 1] };
    // horizontal and vertical: 0 stands for the parameter, i for coordinate i
    let views: &[(usize, usize)] = match dimension {
        1 => &[(0, 1)],
        2 => &[(1, 2)],
        3 => &[(1, 2), (1, 3)],
        _ => {
            return Err(Error::Usage {
                message: format!("there is no picture of points with {dimension} coordinates"),
                accepted: "1 to 3".to_owned(),
            });
        }
    };
    let paths: Vec<Path> = levels.iter().take(LEVELS + 1).map(polygon).collect();
    let size = size_of(paths.iter().flatten().chain(limit).flat_map(|(_, point)| point));
    let name = |i: usize| match i {
        0 => "parameter $t$".to_owned(),
        _ => format!("${}$", coordinates(dimension)[i - 1]),
    };
    let range = |i: usize| {
        let all = paths.iter().flatten().chain(limit).map(pick(i));
        visible_range(all, size, 0.05)
    };
    let abreast = if width == Width::Two { views.len() } else { 1 };
    let across = width.millimetres() / abreast as f64 - BESIDE;
    let mut figure_height = AROUND;
    let mut panels = Vec::new();
    for (index, &(h, v)) in views.iter().enumerate() {
        let (x, y) = (Axis::new(name(h), range(h)), Axis::new(name(v), range(v)));
        let ratio = (x.range.1 - x.range.0) / (y.range.1 - y.range.0);
        let alike = h > 0 && (1.0 / THREAD..=THREAD).contains(&ratio);
        let mut chart = Chart::new(x.with_grid(), y.with_grid());
        if alike {
            chart = chart.equal();
        }
        let project =
            |path: &[(f64, Vec<f64>)]| -> Vec<[f64; 2]> { path.iter().map(|p| [pick(h)(p), pick(v)(p)]).collect() };
        chart = chart
            .series(project(limit), Style::solid(Colour::INK).wide(0.5))
            .label("limit");
        for (level, path) in paths.iter().enumerate() {
            let colour = match level {
                0 => Colour::GREY,
                level => Colour::line(level - 1),
            };
            let style = Style {
                line: Some(Stroke {
                    colour,
                    width: 0.2,
                    dash: if level == 0 { Dash::Dashed } else { Dash::Solid },
                }),
                marker: (path.len() <= MARKED).then_some(match level {
                    0 => (Marker::Square, 0.8),
                    level => (Marker::Disc, 0.6 / level as f64),
                }),
                colour,
            };
            let label = match level {
                0 => "control polygon".to_owned(),
                level => format!("level {level}"),
            };
            chart = chart.series(project(path), style).label(label);
        }
        let wanted = if alike { across / ratio } else { across * 0.62 };
        let height = wanted.clamp(HEIGHT.0, HEIGHT.1);
        figure_height = match abreast {
            1 => figure_height + height + if index > 0 { BESIDE } else { 0.0 },
            _ => figure_height.max(AROUND + height),
        };
        let heading = match views.len() {
            1 => title.to_owned(),
            _ if v == 2 => format!("plan: {title}"),
            _ => "elevation".to_owned(),
        };
        panels.push((index, height, Panel::new(chart).title(heading)));
    }
    let heights: Vec<f64> = panels.iter().map(|panel| panel.1).collect();
    let mut figure = Figure::new(width, figure_height, format!("Curve, {title}")).legend(Side::Bottom);
    for (index, _, panel) in panels {
        let (row, column) = if abreast == 1 { (index, 0) } else { (0, index) };
        figure = figure.panel(row, column, panel);
    }
    if abreast == 1 {
        figure = figure.row_heights(&heights);
    }
    Ok(figure)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::Example;

    #[test]
    fn rounding_errors_are_not_shown() {
        assert_eq!(visible_range([2.0, 2.0 + 4e-16], 2.0, 0.05), (1.0, 3.0 + 4e-16));
        assert_eq!(visible_range([0.0], 0.0, 0.05), (-0.5, 0.5));
        assert_eq!(visible_range([0.0, 1e-17], 8.0, 0.05), (-4.0, 4.0));
        assert_eq!(visible_range([-1.0, 1.0], 1.0, 0.5), (-2.0, 2.0));
    }

    #[test]
    fn nothing_overlaps_or_leaves_the_page() {
        for example in Example::ALL {
            let (curve, _) = example.curve(None, None, None).unwrap();
            let levels: Vec<Curve> = (0..6).map(|m| curve.refine_levels(m).unwrap()).collect();
            let limit = curve.sample(16).unwrap();
            for width in [Width::One, Width::Two] {
                let figure = figure(&levels, &limit, width, "order 4, $u_0$ = 0.8660").unwrap();
                let faults = figure.layout().unwrap().faults();
                assert!(faults.is_empty(), "{example:?} {width:?}: {faults:#?}");
            }
        }
        // one coordinate, and one that is constant
        for values in [[[1.0], [3.0], [-2.0], [0.5]], [[2.0]; 4]] {
            let curve = Curve::new(5, 2.0, Ends::Closed, &values).unwrap();
            let figure = figure(
                std::slice::from_ref(&curve),
                &curve.sample(4).unwrap(),
                Width::One,
                "order 5",
            )
            .unwrap();
            let faults = figure.layout().unwrap().faults();
            assert!(faults.is_empty(), "{values:?}: {faults:#?}");
        }
        let many = Curve::new(3, 1.0, Ends::Open, &[[0.0; 4]; 3]).unwrap();
        assert!(figure(&[many], &[], Width::One, "").is_err());
    }
}
