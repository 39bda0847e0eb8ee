//! Legends and colour bars: what lines, markers and colours mean. They stand beside the data, never on it.

use crate::axes::TICK;
use crate::chart::{Chart, Fill, Layer, Style};
use crate::colour::{Colour, ColourScale};
use crate::draw::{Page, SMALL};
use crate::error::Error;
use crate::layers::{draw_marker, hatched, is_visible};
use crate::scene::{Rect, Shape, Stroke};
use crate::text::Anchor;
use crate::ticks;

/// Where a legend stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// In rows above the data.
    Top,
    /// In rows below the axis.
    Bottom,
    /// In a column to the right.
    Right,
}

/// The sample of an entry.
#[derive(Clone, Debug, PartialEq)]
enum Swatch {
    Series(Style),
    Area(Fill, Option<Stroke>),
    Rule(Stroke),
}

/// Lengths of a legend, in millimetres: sample, its distance to the text, distance between entries, height of
/// a row.
const SAMPLE: f64 = 6.0;
const BESIDE: f64 = 1.0;
const BETWEEN: f64 = 3.2;
const ROW: f64 = 3.5;

/// Entries, measured.
pub(crate) struct Legend {
    entries: Vec<(Swatch, String, f64)>,
}

impl Legend {
    /// The labelled layers of all charts of which something is seen; a text that occurs twice is listed once.
    pub fn of<'a>(charts: impl IntoIterator<Item = &'a Chart>, page: &Page) -> Result<Self, Error> {
        let mut entries: Vec<(Swatch, String, f64)> = Vec::new();
        let layers = charts
            .into_iter()
            .flat_map(|chart| chart.layers.iter().map(move |(layer, label)| (chart, layer, label)));
        for (chart, layer, label) in layers {
            let Some(label) = label else { continue };
            if entries.iter().any(|entry| entry.1 == *label) || !is_visible(chart, layer) {
                continue;
            }
            let swatch = match layer {
                Layer::Series { style, .. } => Swatch::Series(*style),
                Layer::Band { fill, .. } => Swatch::Area(*fill, None),
                Layer::Span { colour, .. } => Swatch::Area(Fill::Plain(*colour), None),
                Layer::Rule { stroke, .. } => Swatch::Rule(*stroke),
                Layer::Outline { stroke, fill: None, .. } => Swatch::Rule(*stroke),
                Layer::Outline {
                    stroke,
                    fill: Some(fill),
                    ..
                } => Swatch::Area(*fill, Some(*stroke)),
                Layer::Cells { cells } => match cells.first() {
                    Some((_, colour)) => Swatch::Area(Fill::Plain(*colour), None),
                    None => continue,
                },
                Layer::Text { .. } => continue,
            };
            let width = SAMPLE + BESIDE + page.font.line(label, SMALL)?.width;
            entries.push((swatch, label.clone(), width));
        }
        Ok(Legend { entries })
    }

    /// The entries by rows that are no wider than this, if one entry is not.
    fn rows(&self, side: Side, most: f64) -> Vec<Vec<usize>> {
        let mut rows: Vec<Vec<usize>> = Vec::new();
        let mut width = 0.0;
        for (index, entry) in self.entries.iter().enumerate() {
            match rows.last_mut() {
                Some(row) if side != Side::Right && width + BETWEEN + entry.2 <= most => {
                    row.push(index);
                    width += BETWEEN + entry.2;
                }
                _ => {
                    rows.push(vec![index]);
                    width = entry.2;
                }
            }
        }
        rows
    }

    fn width(&self, row: &[usize]) -> f64 {
        let widths: f64 = row.iter().map(|&index| self.entries[index].2).sum();
        widths + BETWEEN * (row.len().saturating_sub(1)) as f64
    }

    /// Width and height.
    pub fn size(&self, side: Side, most: f64) -> [f64; 2] {
        let rows = self.rows(side, most);
        let width = rows.iter().map(|row| self.width(row)).fold(0.0, f64::max);
        [width, ROW * rows.len() as f64]
    }

    /// Draws it into a box, with the rows of [`Legend::size`] for the same greatest width; they are centred.
    pub fn draw(&self, page: &mut Page, side: Side, to: Rect, most: f64) -> Result<(), Error> {
        let mut y = to.top + ROW / 2.0;
        for row in self.rows(side, most) {
            let mut x = match side {
                Side::Right => to.left,
                _ => (to.left + to.right - self.width(&row)) / 2.0,
            };
            for index in row {
                let (swatch, label, width) = &self.entries[index];
                swatch.draw(page, [x, y]);
                let at = [x + SAMPLE + BESIDE, y + 0.36 * SMALL];
                page.text(label, SMALL, at, Anchor::Start, false, Colour::INK)?;
                page.entries.push(label.clone());
                x += width + BETWEEN;
            }
            y += ROW;
        }
        if !self.entries.is_empty() {
            page.legends.push(to);
        }
        Ok(())
    }
}

impl Swatch {
    fn draw(&self, page: &mut Page, [x, y]: [f64; 2]) {
        let line = |stroke| Shape::Path {
            lines: vec![vec![[x, y], [x + SAMPLE, y]]],
            closed: false,
            fill: None,
            stroke: Some(stroke),
        };
        match *self {
            Swatch::Series(style) => {
                page.scene.shapes.extend(style.line.map(line));
                if let Some((marker, radius)) = style.marker {
                    draw_marker(&mut page.scene, marker, radius, style.colour, [x + SAMPLE / 2.0, y]);
                }
            }
            Swatch::Rule(stroke) => page.scene.shapes.push(line(stroke)),
            Swatch::Area(fill, stroke) => {
                let (right, top, bottom) = (x + SAMPLE, y - 0.9, y + 0.9);
                let corners = vec![[x, top], [right, top], [right, bottom], [x, bottom]];
                let colour = match fill {
                    Fill::Plain(colour) => Some(colour),
                    Fill::Hatched(colour) => {
                        page.scene.shapes.extend(hatched(corners.clone(), colour));
                        None
                    }
                };
                let stroke = match fill {
                    Fill::Plain(_) => Some(stroke.unwrap_or(Stroke::solid(Colour::GREY, 0.1))),
                    Fill::Hatched(_) => stroke,
                };
                page.scene.shapes.push(Shape::Path {
                    lines: vec![corners],
                    closed: true,
                    fill: colour,
                    stroke,
                });
            }
        }
    }
}

/// Lengths of a colour bar: its distance from the data, its width, the height of the arrows.
const AWAY: f64 = 2.0;
const BAR: f64 = 2.6;
const ARROW: f64 = 1.8;
/// Colours in it.
const BANDS: usize = 128;

/// The width that a colour bar needs, its distance from the data included.
pub(crate) fn bar_width(scale: &ColourScale, height: f64, page: &Page) -> Result<f64, Error> {
    scale.check()?;
    let mut texts: f64 = 0.0;
    for tick in bar_ticks(scale, height) {
        texts = texts.max(page.font.line(&tick.text, SMALL)?.width);
    }
    let label = if scale.label.is_empty() { 0.0 } else { 1.5 * SMALL };
    Ok(AWAY + BAR + 2.0 * TICK + texts + label)
}

fn bar_ticks(scale: &ColourScale, height: f64) -> Vec<ticks::Tick> {
    ticks::linear(scale.range.0, scale.range.1, ((height / 8.0) as usize).clamp(3, 9))
}

/// Draws a colour bar to the right of `beside`; `beyond` says whether values lie below or above its range,
/// which arrows show.
pub(crate) fn draw_bar(page: &mut Page, scale: &ColourScale, beside: Rect, beyond: [bool; 2]) -> Result<(), Error> {
    let (left, right) = (beside.right + AWAY, beside.right + AWAY + BAR);
    let bottom = beside.bottom - if beyond[0] { ARROW } else { 0.0 };
    let top = beside.top + if beyond[1] { ARROW } else { 0.0 };
    let at = |t: f64| bottom + t * (top - bottom);
    let cells = (0..BANDS).map(|k| {
        // each reaches to the top, and the next ones cover it: no seams
        let [t0, t1] = [k, BANDS].map(|k| at(k as f64 / BANDS as f64));
        let colour = scale.map.at((k as f64 + 0.5) / BANDS as f64);
        (colour, vec![[left, t0], [right, t0], [right, t1], [left, t1]])
    });
    let mut cells: Vec<_> = cells.collect();
    let middle = (left + right) / 2.0;
    let mut outline = vec![[left, bottom]];
    if beyond[0] {
        cells.push((
            scale.map.at(0.0),
            vec![[left, bottom], [middle, beside.bottom], [right, bottom]],
        ));
        outline.push([middle, beside.bottom]);
    }
    outline.extend([[right, bottom], [right, top]]);
    if beyond[1] {
        cells.push((scale.map.at(1.0), vec![[left, top], [middle, beside.top], [right, top]]));
        outline.push([middle, beside.top]);
    }
    outline.push([left, top]);
    page.scene.shapes.push(Shape::Mesh { cells });
    page.scene.shapes.push(Shape::Path {
        lines: vec![outline],
        closed: true,
        fill: None,
        stroke: Some(Stroke::solid(Colour::INK, 0.15)),
    });
    page.legends.push(Rect::new(left, beside.top, right, beside.bottom));
    let mut texts: f64 = 0.0;
    for tick in bar_ticks(scale, beside.height()) {
        let t = (tick.value - scale.range.0) / (scale.range.1 - scale.range.0);
        page.scene.shapes.push(Shape::Path {
            lines: vec![vec![[right, at(t)], [right + TICK, at(t)]]],
            closed: false,
            fill: None,
            stroke: Some(Stroke::solid(Colour::INK, 0.15)),
        });
        let place = [right + 2.0 * TICK, at(t) + 0.36 * SMALL];
        texts = texts.max(page.font.line(&tick.text, SMALL)?.width);
        page.text(&tick.text, SMALL, place, Anchor::Start, false, Colour::INK)?;
    }
    let place = [
        right + 2.0 * TICK + texts + 1.25 * SMALL,
        (beside.top + beside.bottom) / 2.0,
    ];
    page.text(&scale.label, SMALL, place, Anchor::Middle, true, Colour::INK)
}
