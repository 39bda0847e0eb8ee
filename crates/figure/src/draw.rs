//! Charts on the page: margins for ticks and labels, then axes and layers.

use crate::chart::{Axis, Chart, Layer, Marker, Scale, Style};
use crate::clip;
use crate::colour::Colour;
use crate::error::Error;
use crate::scene::{Dash, Rect, Scene, Shape, Stroke};
use crate::text::{Anchor, Font, POINT, Placed};
use crate::ticks::{self, Tick};

/// Sizes of text at the printed size: labels and ticks, and titles of panels.
pub(crate) const SMALL: f64 = 7.0 * POINT;
pub(crate) const TITLE: f64 = 7.5 * POINT;
/// Length of ticks and distance of their texts, in millimetres.
pub(crate) const TICK: f64 = 0.8;
pub(crate) const GAP: f64 = 0.6;
/// Between a frame and the texts of rules above it: room for leaders.
const LEADER: f64 = 1.5;
/// Between texts in a row.
const APART: f64 = 0.9;
/// Millimetres of an axis for each tick.
const PER_X_TICK: f64 = 9.0;
const PER_Y_TICK: f64 = 5.0;

/// A page being drawn, with the boxes by which its layout is judged.
pub(crate) struct Page {
    pub font: Font,
    pub scene: Scene,
    pub texts: Vec<(String, Rect)>,
    pub plots: Vec<Rect>,
    pub legends: Vec<Rect>,
}

impl Page {
    pub fn text(
        &mut self,
        text: &str,
        size: f64,
        at: [f64; 2],
        anchor: Anchor,
        upwards: bool,
        colour: Colour,
    ) -> Result<(), Error> {
        if text.is_empty() {
            return Ok(());
        }
        let placed = Placed::new(self.font.line(text, size)?, at, anchor, upwards);
        self.texts.push((text.to_owned(), placed.bounds()));
        self.scene.shapes.push(Shape::Text {
            text: placed,
            colour,
            source: text.to_owned(),
        });
        Ok(())
    }

    pub fn line(&mut self, points: Vec<[f64; 2]>, stroke: Stroke) {
        self.scene.shapes.push(Shape::Path {
            lines: vec![points],
            closed: false,
            fill: None,
            stroke: Some(stroke),
        });
    }
}

/// What surrounds the data.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Margins {
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
}

/// The outline of a rectangle.
pub(crate) fn frame(rect: &Rect) -> Shape {
    let (l, t, r, b) = (rect.left, rect.top, rect.right, rect.bottom);
    Shape::Path {
        lines: vec![vec![[l, t], [r, t], [r, b], [l, b]]],
        closed: true,
        fill: None,
        stroke: Some(Stroke::solid(Colour::INK, 0.2)),
    }
}

impl Axis {
    fn check(&self) -> Result<(), Error> {
        let (low, high) = self.range;
        let log = self.scale == Scale::Log;
        if low.is_finite() && high.is_finite() && low < high && (!log || low > 0.0) {
            return Ok(());
        }
        let name = if self.label.is_empty() {
            "without label"
        } else {
            &self.label
        };
        Err(Error::Range {
            what: format!("the axis {name}"),
            low,
            high,
            log,
        })
    }

    fn ticks(&self, length: f64, per_tick: f64) -> Vec<Tick> {
        let most = ((length / per_tick) as usize).clamp(3, 12);
        let (low, high) = self.range;
        match (&self.ticks, self.scale) {
            (Some(ticks), _) => {
                let inside = ticks.iter().filter(|tick| (low..=high).contains(&tick.0));
                let tick = |(value, text): &(f64, String)| Tick {
                    value: *value,
                    text: text.clone(),
                };
                inside.map(tick).collect()
            }
            (None, Scale::Linear) => ticks::linear(low, high, most),
            (None, Scale::Log) => ticks::logarithmic(low, high, most),
        }
    }
}

/// The rules with a text, by position.
fn named_rules(chart: &Chart) -> Vec<(f64, &str)> {
    let mut rules: Vec<(f64, &str)> = chart
        .layers
        .iter()
        .filter_map(|(layer, _)| match layer {
            Layer::Rule {
                at,
                vertical: true,
                text,
                ..
            } if !text.is_empty() && (0.0..=1.0).contains(&chart.x.position(*at)) => Some((*at, text.as_str())),
            _ => None,
        })
        .collect();
    rules.sort_by(|a, b| a.0.total_cmp(&b.0));
    rules
}

/// The room that a chart's own texts need around a frame of about the given size.
pub(crate) fn margins(chart: &Chart, about: [f64; 2], page: &Page) -> Result<Margins, Error> {
    chart.x.check()?;
    chart.y.check()?;
    let mut margins = Margins {
        left: GAP,
        right: GAP,
        top: GAP,
        bottom: GAP,
    };
    if !named_rules(chart).is_empty() {
        margins.top = LEADER + 1.45 * SMALL;
    }
    if !chart.frame {
        return Ok(margins);
    }
    let mut last = 0.0;
    for tick in chart.x.ticks(about[0], PER_X_TICK) {
        last = page.font.line(&tick.text, SMALL)?.width * chart.x.position(tick.value);
    }
    margins.right = margins.right.max(last / 2.0);
    margins.bottom = TICK + GAP + 1.1 * SMALL;
    if !chart.x.label.is_empty() {
        margins.bottom += 1.3 * SMALL;
    }
    let mut widest: f64 = 0.0;
    for tick in chart.y.ticks(about[1], PER_Y_TICK) {
        widest = widest.max(page.font.line(&tick.text, SMALL)?.width);
    }
    margins.left = TICK + GAP + widest;
    if !chart.y.label.is_empty() {
        margins.left += 1.45 * SMALL;
    }
    margins.top = margins.top.max(0.5 * SMALL);
    Ok(margins)
}

/// The part of the rectangle that the data takes: all of it, or the largest one with equal scales.
fn plot(chart: &Chart, to: Rect) -> Rect {
    if !chart.equal {
        return to;
    }
    let (spans, room) = (
        [chart.x.range.1 - chart.x.range.0, chart.y.range.1 - chart.y.range.0],
        [to.width(), to.height()],
    );
    let scale = (room[0] / spans[0]).min(room[1] / spans[1]);
    let [dx, dy] = [0, 1].map(|i| (room[i] - scale * spans[i]) / 2.0);
    Rect::new(to.left + dx, to.top + dy, to.right - dx, to.bottom - dy)
}

/// Draws a chart whose frame is the given rectangle.
pub(crate) fn draw(chart: &Chart, page: &mut Page, to: Rect) -> Result<Rect, Error> {
    let plot = plot(chart, to);
    page.plots.push(plot);
    let x = |value: f64| plot.left + chart.x.position(value) * plot.width();
    let y = |value: f64| plot.bottom - chart.y.position(value) * plot.height();
    let (x_ticks, y_ticks) = (
        chart.x.ticks(to.width(), PER_X_TICK),
        chart.y.ticks(to.height(), PER_Y_TICK),
    );

    // spans lie below the grid, all else above it
    let (spans, others): (Vec<_>, Vec<_>) = chart
        .layers
        .iter()
        .map(|(layer, _)| layer)
        .partition(|layer| matches!(layer, Layer::Span { .. }));
    spans
        .into_iter()
        .try_for_each(|layer| draw_layer(layer, page, plot, &x, &y))?;
    let grid = Stroke::solid(Colour::PALE, 0.12);
    for tick in x_ticks.iter().filter(|tick| chart.x.grid && !tick.text.is_empty()) {
        page.line(vec![[x(tick.value), plot.top], [x(tick.value), plot.bottom]], grid);
    }
    for tick in y_ticks.iter().filter(|tick| chart.y.grid && !tick.text.is_empty()) {
        page.line(vec![[plot.left, y(tick.value)], [plot.right, y(tick.value)]], grid);
    }
    others
        .into_iter()
        .try_for_each(|layer| draw_layer(layer, page, plot, &x, &y))?;

    if chart.frame {
        page.scene.shapes.push(frame(&plot));
        axes(chart, page, plot, (&x_ticks, &x), (&y_ticks, &y))?;
    }
    rule_texts(chart, page, plot, &x)?;
    Ok(plot)
}

type Map<'a> = &'a dyn Fn(f64) -> f64;

fn axes(
    chart: &Chart,
    page: &mut Page,
    plot: Rect,
    (x_ticks, x): (&[Tick], Map<'_>),
    (y_ticks, y): (&[Tick], Map<'_>),
) -> Result<(), Error> {
    let stroke = Stroke::solid(Colour::INK, 0.2);
    let length = |tick: &Tick| if tick.text.is_empty() { TICK / 2.0 } else { TICK };
    // a tick text that would touch the one before it is left out
    let mut free = f64::NEG_INFINITY;
    for tick in x_ticks {
        let at = x(tick.value);
        page.line(vec![[at, plot.bottom], [at, plot.bottom + length(tick)]], stroke);
        let half = page.font.line(&tick.text, SMALL)?.width / 2.0;
        if at - half < free {
            continue;
        }
        free = at + half + APART / 2.0;
        let place = [at, plot.bottom + TICK + GAP + 0.76 * SMALL];
        page.text(&tick.text, SMALL, place, Anchor::Middle, false, Colour::INK)?;
    }
    let mut widest: f64 = 0.0;
    for tick in y_ticks {
        let at = y(tick.value);
        page.line(vec![[plot.left - length(tick), at], [plot.left, at]], stroke);
        widest = widest.max(page.font.line(&tick.text, SMALL)?.width);
        let place = [plot.left - TICK - GAP, at + 0.36 * SMALL];
        page.text(&tick.text, SMALL, place, Anchor::End, false, Colour::INK)?;
    }
    let middle = (plot.left + plot.right) / 2.0;
    let below = [middle, plot.bottom + TICK + GAP + 2.15 * SMALL];
    page.text(&chart.x.label, SMALL, below, Anchor::Middle, false, Colour::INK)?;
    let beside = [
        plot.left - TICK - GAP - widest - 0.45 * SMALL,
        (plot.top + plot.bottom) / 2.0,
    ];
    page.text(&chart.y.label, SMALL, beside, Anchor::Middle, true, Colour::INK)
}

/// The texts of vertical rules in a row above the frame, moved apart where they are too close, with leaders to their rules.
fn rule_texts(chart: &Chart, page: &mut Page, plot: Rect, x: Map<'_>) -> Result<(), Error> {
    let rules = named_rules(chart);
    let mut wanted = Vec::new();
    for &(at, text) in &rules {
        wanted.push((x(at), page.font.line(text, SMALL)?.width + APART));
    }
    for (&(at, text), place) in rules.iter().zip(spread(&wanted)) {
        let leader = vec![[x(at), plot.top], [place, plot.top - LEADER + 0.3]];
        page.line(leader, Stroke::solid(Colour::GREY, 0.15));
        let at = [place, plot.top - LEADER - 0.25 * SMALL];
        page.text(text, SMALL, at, Anchor::Middle, false, Colour::INK)?;
    }
    Ok(())
}

/// Centres of intervals of the given widths, in order and disjoint, as close to the wanted centres as possible (least squares, by
/// merging neighbours that overlap).
fn spread(wanted: &[(f64, f64)]) -> Vec<f64> {
    // (first index, count, centre of the group, its width)
    let mut groups: Vec<(usize, usize, f64, f64)> = Vec::new();
    for (index, &(centre, width)) in wanted.iter().enumerate() {
        groups.push((index, 1, centre, width));
        while let [.., a, b] = groups.as_slice() {
            if a.2 + a.3 / 2.0 <= b.2 - b.3 / 2.0 {
                break;
            }
            let (first, count, width) = (a.0, a.1 + b.1, a.3 + b.3);
            // each member's wish for the middle of the group
            let mut before = 0.0;
            let wishes = wanted[first..first + count].iter().map(|&(centre, own)| {
                let wish = centre - (before + own / 2.0) + width / 2.0;
                before += own;
                wish
            });
            let middle = wishes.sum::<f64>() / count as f64;
            groups.truncate(groups.len() - 2);
            groups.push((first, count, middle, width));
        }
    }
    let mut centres = Vec::with_capacity(wanted.len());
    for (first, count, centre, width) in groups {
        let mut left = centre - width / 2.0;
        for &(_, own) in &wanted[first..first + count] {
            centres.push(left + own / 2.0);
            left += own;
        }
    }
    centres
}

fn draw_layer(layer: &Layer, page: &mut Page, plot: Rect, x: Map<'_>, y: Map<'_>) -> Result<(), Error> {
    let shapes = &mut page.scene.shapes;
    let path = |lines, closed, fill, stroke| Shape::Path {
        lines,
        closed,
        fill,
        stroke,
    };
    let place = |p: &[f64; 2]| [x(p[0]), y(p[1])];
    match layer {
        Layer::Series { points, style } => {
            let points: Vec<[f64; 2]> = points.iter().map(place).collect();
            if let Some(stroke) = style.line {
                let lines = clip::polyline(&points, &plot);
                if !lines.is_empty() {
                    shapes.push(path(lines, false, None, Some(stroke)));
                }
            }
            draw_markers(&mut page.scene, style, &points, plot);
        }
        Layer::Band {
            points,
            colour,
            opacity,
        } => {
            let finite = |p: &[f64; 3]| p.iter().all(|c| c.is_finite());
            for run in points.split(|p| !finite(p)) {
                let below = run.iter().map(|p| [x(p[0]), y(p[1])]);
                let above = run.iter().rev().map(|p| [x(p[0]), y(p[2])]);
                let area = clip::polygon(&below.chain(above).collect::<Vec<_>>(), &plot);
                if !area.is_empty() {
                    shapes.push(path(vec![area], true, Some((*colour, *opacity)), None));
                }
            }
        }
        Layer::Span { from, to, colour } => {
            let (l, r) = (x(*from), x(*to));
            let corners = [[l, plot.top], [r, plot.top], [r, plot.bottom], [l, plot.bottom]];
            let area = clip::polygon(&corners, &plot);
            if !area.is_empty() {
                shapes.push(path(vec![area], true, Some((*colour, 1.0)), None));
            }
        }
        Layer::Rule {
            at, vertical, stroke, ..
        } => {
            let line = if *vertical {
                [[x(*at), plot.top], [x(*at), plot.bottom]]
            } else {
                [[plot.left, y(*at)], [plot.right, y(*at)]]
            };
            let lines = clip::polyline(&line, &plot);
            if !lines.is_empty() {
                shapes.push(path(lines, false, None, Some(*stroke)));
            }
        }
        Layer::Cells { cells } => {
            let placed = cells.iter().filter_map(|(corners, colour)| {
                let corners: Vec<[f64; 2]> = corners.iter().map(place).collect();
                let kept = clip::polygon(&corners, &plot);
                (kept.len() > 2).then_some((*colour, kept))
            });
            let cells = placed.collect();
            shapes.push(Shape::Mesh { cells });
        }
        Layer::Outline { corners, stroke, fill } => {
            let mut corners: Vec<[f64; 2]> = corners.iter().map(place).collect();
            let area = clip::polygon(&corners, &plot);
            if let (Some(colour), false) = (fill, area.is_empty()) {
                shapes.push(path(vec![area], true, Some((*colour, 1.0)), None));
            }
            corners.extend(corners.first().copied());
            let lines = clip::polyline(&corners, &plot);
            if !lines.is_empty() {
                shapes.push(path(lines, false, None, Some(*stroke)));
            }
        }
        Layer::Text {
            at,
            text,
            anchor,
            colour,
        } => {
            let [x, y] = place(at);
            if x.is_finite() && y.is_finite() {
                page.text(text, SMALL, [x, y + 0.36 * SMALL], *anchor, false, *colour)?;
            }
        }
    }
    Ok(())
}

fn draw_markers(scene: &mut Scene, style: &Style, points: &[[f64; 2]], plot: Rect) {
    let Some((marker, radius)) = style.marker else { return };
    let visible = Rect::new(plot.left - 1e-6, plot.top - 1e-6, plot.right + 1e-6, plot.bottom + 1e-6);
    for &[x, y] in points {
        if visible.contains(&Rect::new(x, y, x, y), 0.0) {
            draw_marker(scene, marker, radius, style.colour, [x, y]);
        }
    }
}

pub(crate) fn draw_marker(scene: &mut Scene, marker: Marker, radius: f64, colour: Colour, at: [f64; 2]) {
    let stroke = Stroke {
        colour,
        width: 0.3 * radius.min(1.0),
        dash: Dash::Solid,
    };
    let corners: &[[f64; 2]] = match marker {
        Marker::Circle | Marker::Disc => {
            let fill = if marker == Marker::Disc { colour } else { Colour::WHITE };
            scene.shapes.push(Shape::Circle {
                at,
                radius,
                fill,
                stroke,
            });
            return;
        }
        Marker::Cross => {
            let [x, y] = at;
            let arm = 0.9 * radius;
            let lines = [[-arm, arm], [arm, arm]].map(|[dx, dy]| vec![[x - dx, y - dy], [x + dx, y + dy]]);
            scene.shapes.push(Shape::Path {
                lines: lines.to_vec(),
                closed: false,
                fill: None,
                stroke: Some(stroke),
            });
            return;
        }
        Marker::Square => &[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]],
        Marker::Triangle => &[[0.0, -1.2], [1.1, 0.8], [-1.1, 0.8]],
        Marker::Diamond => &[[0.0, -1.25], [1.25, 0.0], [0.0, 1.25], [-1.25, 0.0]],
    };
    let placed = corners
        .iter()
        .map(|[dx, dy]| [at[0] + radius * dx, at[1] + radius * dy]);
    scene.shapes.push(Shape::Path {
        lines: vec![placed.collect()],
        closed: true,
        fill: Some((Colour::WHITE, 1.0)),
        stroke: Some(stroke),
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_moved_apart_but_not_farther() {
        assert_eq!(spread(&[(0.0, 1.0), (5.0, 1.0)]), [0.0, 5.0]);
        let centres = spread(&[(0.0, 2.0), (1.0, 2.0), (10.0, 2.0), (10.0, 4.0)]);
        assert_eq!(&centres[..2], [-0.5, 1.5]);
        assert_eq!(centres[3] - centres[2], 3.0);
        let sum = centres[2] + centres[3];
        assert!((sum - 20.0).abs() < 1e-12);
    }
}
