//! Charts on the page: margins for their texts, then axes and layers.
//!
//! plotters draws axes, grids and what is drawn along them ([`crate::axes`], [`crate::layers`]). The texts of
//! rules, which move apart where they are too close, have no counterpart there.

use crate::axes::Axes;
use crate::chart::{Chart, Layer};
use crate::colour::Colour;
use crate::error::Error;
use crate::layers::Canvas;
use crate::scene::{Rect, Scene, Shape, Stroke};
use crate::text::{Anchor, Font, POINT, Placed};

/// Sizes of text at the printed size: labels and ticks, and titles of panels.
pub(crate) const SMALL: f64 = 7.0 * POINT;
pub(crate) const TITLE: f64 = 7.5 * POINT;
/// Blank around a chart, in millimetres.
const GAP: f64 = 0.6;
/// Between the label of the vertical axis and what stands beside it, relative to its size.
const BESIDE: f64 = 0.24;
/// Between a frame and the texts of rules above it: room for leaders.
const LEADER: f64 = 1.5;
/// Between texts in a row.
const APART: f64 = 0.9;
/// How far the texts of rules may reach beyond the frame: the border of the page is wider.
const BEYOND: f64 = 1.5;

/// A page being drawn, with the boxes by which its layout is judged.
pub(crate) struct Page {
    pub font: Font,
    pub scene: Scene,
    pub texts: Vec<(String, Rect)>,
    pub plots: Vec<Rect>,
    pub legends: Vec<Rect>,
    /// What the legends list.
    pub entries: Vec<String>,
    /// The labels of layers that have left something on the page.
    pub drawn: Vec<String>,
}

impl Page {
    pub fn new(size: [f64; 2]) -> Self {
        Page {
            font: Font::new(),
            scene: Scene {
                size,
                shapes: Vec::new(),
            },
            texts: Vec::new(),
            plots: Vec::new(),
            legends: Vec::new(),
            entries: Vec::new(),
            drawn: Vec::new(),
        }
    }

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
    let axes = Axes::new(chart, about, &page.font)?;
    [margins.left, margins.bottom] = axes.room();
    if !chart.y.label.is_empty() {
        margins.left += BESIDE * SMALL;
    }
    let [left, right] = axes.overhang();
    margins.left = margins.left.max(left);
    margins.right = margins.right.max(right);
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
    let mut axes = Axes::new(chart, [to.width(), to.height()], &page.font)?;
    axes.thin_out(plot.width());
    Canvas::new(&axes, page, plot)?.draw()?;
    rule_texts(chart, page, plot)?;
    Ok(plot)
}

/// The texts of vertical rules in a row above the frame, moved apart where they are too close, with leaders
/// to their rules.
fn rule_texts(chart: &Chart, page: &mut Page, plot: Rect) -> Result<(), Error> {
    let x = |value: f64| plot.left + chart.x.position(value) * plot.width();
    let rules = named_rules(chart);
    let mut wanted = Vec::new();
    for &(at, text) in &rules {
        wanted.push((x(at), page.font.line(text, SMALL)?.width + APART));
    }
    let bounds = [plot.left - BEYOND, plot.right + BEYOND];
    for (&(at, text), place) in rules.iter().zip(spread(&wanted, bounds)) {
        let leader = vec![[x(at), plot.top], [place, plot.top - LEADER + 0.3]];
        page.line(leader, Stroke::solid(Colour::GREY, 0.15));
        let at = [place, plot.top - LEADER - 0.25 * SMALL];
        page.text(text, SMALL, at, Anchor::Middle, false, Colour::INK)?;
    }
    Ok(())
}

/// Centres of intervals of the given widths, in order and disjoint, as close to the wanted centres as
/// possible (least squares, by merging neighbours that overlap), within bounds if there is room.
fn spread(wanted: &[(f64, f64)], [least, most]: [f64; 2]) -> Vec<f64> {
    let within = |centre: f64, width: f64| centre.min(most - width / 2.0).max(least + width / 2.0);
    // (first index, count, centre of the group, its width)
    let mut groups: Vec<(usize, usize, f64, f64)> = Vec::new();
    for (index, &(centre, width)) in wanted.iter().enumerate() {
        groups.push((index, 1, within(centre, width), width));
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
            groups.push((first, count, within(middle, width), width));
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_moved_apart_but_not_farther() {
        let wide = [-100.0, 100.0];
        assert_eq!(spread(&[(0.0, 1.0), (5.0, 1.0)], wide), [0.0, 5.0]);
        let centres = spread(&[(0.0, 2.0), (1.0, 2.0), (10.0, 2.0), (10.0, 4.0)], wide);
        assert_eq!(&centres[..2], [-0.5, 1.5]);
        assert_eq!(centres[3] - centres[2], 3.0);
        let sum = centres[2] + centres[3];
        assert!((sum - 20.0).abs() < 1e-12);
        // at the bounds they push each other inwards
        assert_eq!(
            spread(&[(0.0, 2.0), (0.5, 2.0), (9.0, 2.0)], [0.0, 9.0]),
            [1.0, 3.0, 8.0]
        );
        assert_eq!(
            spread(&[(7.0, 2.0), (9.0, 2.0), (9.5, 2.0)], [0.0, 10.0]),
            [5.0, 7.0, 9.0]
        );
    }
}
