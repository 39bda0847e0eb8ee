//! Axes and grids, which plotters draws: where values lie, where the ticks are, and the room for their texts.
//!
//! The ticks are those of [`crate::ticks`], chosen by the printed length of the axis. plotters' own choice
//! leaves a single tick where no multiple of a coarser step fits, writes no powers of ten, and has no minor
//! ticks; through [`Ranged`] it takes ours.

use crate::backend::{Backend, font_size, line_style, pixels, refused};
use crate::chart::{Axis, Chart, Scale};
use crate::colour::Colour;
use crate::draw::SMALL;
use crate::error::Error;
use crate::scene::{Rect, Stroke};
use crate::text::Font;
use crate::ticks::{self, Tick};
use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::drawing::DrawingArea;
use plotters::element::Rectangle;
use plotters::style::{FontDesc, FontFamily, FontStyle, TextStyle};
use std::ops::Range;

/// Length of ticks, in millimetres. plotters sets their texts at twice that distance.
pub(crate) const TICK: f64 = 0.7;
/// Between texts of ticks.
const APART: f64 = 0.45;
/// Millimetres of an axis for each tick.
const PER_X_TICK: f64 = 9.0;
const PER_Y_TICK: f64 = 5.0;
/// The room for texts below the horizontal axis, relative to their size: texts of ticks, and a label below.
const TEXT: f64 = 1.1;
const TEXTS: f64 = 2.4;
/// The room for the label of the vertical axis beside the texts of its ticks: its height and a gap.
const BESIDE: f64 = 1.21;

/// plotters' chart on the page.
pub(crate) type Context<'a, 'p> = ChartContext<'a, Backend<'p>, Cartesian2d<Ticked<'a>, Ticked<'a>>>;

/// An axis with its ticks, as plotters knows it.
pub(crate) struct Ticked<'a> {
    axis: &'a Axis,
    ticks: Vec<Tick>,
}

impl Ranged for Ticked<'_> {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    /// The nearest pixel. Values beyond the ends, which are cut off before they get here, lie on them.
    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        let along = self.axis.position(*value).clamp(0.0, 1.0);
        from + (along * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        // the light ones would be further lines between those of the grid
        match hint.weight().allow_light_points() {
            true => Vec::new(),
            false => self.ticks.iter().map(|tick| tick.value).collect(),
        }
    }

    fn range(&self) -> Range<f64> {
        self.axis.range.0..self.axis.range.1
    }
}

impl ValueFormatter<f64> for Ticked<'_> {
    fn format_ext(&self, value: &f64) -> String {
        let tick = self.ticks.iter().find(|tick| tick.value == *value);
        tick.map(|tick| tick.text.clone()).unwrap_or_default()
    }
}

impl Axis {
    pub(crate) fn check(&self) -> Result<(), Error> {
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

    /// At most about so many ticks, whose texts count from `base`.
    fn ticks(&self, most: usize, base: f64) -> Vec<Tick> {
        let (low, high) = self.range;
        match (&self.ticks, self.scale, self.joint) {
            (Some(ticks), ..) => {
                let inside = ticks.iter().filter(|tick| (low..=high).contains(&tick.0));
                let tick = |(value, text): &(f64, String)| Tick {
                    value: *value,
                    text: text.clone(),
                };
                inside.map(tick).collect()
            }
            (None, Scale::Linear, None) => {
                let mut ticks = ticks::linear(low - base, high - base, most);
                ticks.iter_mut().for_each(|tick| tick.value += base);
                ticks
            }
            (None, Scale::Linear, Some((joint, at))) => {
                let part = |share: f64| ((most as f64 * share).round() as usize).max(2);
                let mut ticks = ticks::linear(low, joint, part(at));
                let last = ticks.last().map_or(low, |tick| tick.value);
                let above = ticks::linear(joint, high, part(1.0 - at)).into_iter();
                ticks.extend(above.filter(|tick| tick.value > last));
                ticks
            }
            (None, Scale::Log, _) => ticks::logarithmic(low, high, most),
        }
    }

    /// The ticks of a horizontal axis of about this length whose texts stand side by side: as many as fit. If
    /// not even two do, since they have too many digits, they count from a base, which the label tells.
    fn fitting(&self, length: f64, font: &Font) -> Result<(Vec<Tick>, Option<String>), Error> {
        let most = most_ticks(length, PER_X_TICK);
        let usual = self.ticks(most, 0.0);
        if self.ticks.is_some() || self.scale == Scale::Log || self.joint.is_some() {
            return Ok((usual, None));
        }
        let (base, text) = ticks::base(self.range.0, self.range.1);
        for (base, text) in [(0.0, None), (base, Some(text))] {
            for most in (2..=most).rev() {
                let ticks = self.ticks(most, base);
                let mut free = f64::NEG_INFINITY;
                let mut fits = ticks.len() >= 2;
                for tick in &ticks {
                    let (at, half) = (
                        length * self.position(tick.value),
                        font.line(&tick.text, SMALL)?.width / 2.0,
                    );
                    fits &= at - half >= free;
                    free = at + half + APART;
                }
                if fits {
                    return Ok((ticks, text));
                }
            }
        }
        Ok((usual, None))
    }
}

/// The most ticks on an axis of this length.
fn most_ticks(length: f64, per_tick: f64) -> usize {
    ((length / per_tick) as usize).clamp(3, 12)
}

/// Both axes of a chart with their ticks, horizontal first.
pub(crate) struct Axes<'a> {
    pub chart: &'a Chart,
    /// The label below the horizontal axis.
    label: String,
    /// Those with texts.
    major: [Vec<Tick>; 2],
    /// Those without.
    minor: [Vec<Tick>; 2],
    widths: [Vec<f64>; 2],
}

impl<'a> Axes<'a> {
    /// The axes of a chart whose frame has about the given size.
    pub fn new(chart: &'a Chart, about: [f64; 2], font: &Font) -> Result<Self, Error> {
        let (x, base) = chart.x.fitting(about[0], font)?;
        let y = chart.y.ticks(most_ticks(about[1], PER_Y_TICK), 0.0);
        let split =
            |ticks: Vec<Tick>| -> (Vec<Tick>, Vec<Tick>) { ticks.into_iter().partition(|tick| !tick.text.is_empty()) };
        let ((x_major, x_minor), (y_major, y_minor)) = (split(x), split(y));
        let major = [x_major, y_major];
        let mut widths = [Vec::new(), Vec::new()];
        for (ticks, widths) in major.iter().zip(&mut widths) {
            for tick in ticks {
                widths.push(font.line(&tick.text, SMALL)?.width);
            }
        }
        let label = match (base, chart.x.label.as_str()) {
            (None, label) => label.to_owned(),
            (Some(base), "") => format!("from {base}"),
            (Some(base), label) => format!("{label}, from {base}"),
        };
        Ok(Axes {
            chart,
            label,
            major,
            minor: [x_minor, y_minor],
            widths,
        })
    }

    /// The room to the left of the frame and below it.
    pub fn room(&self) -> [f64; 2] {
        if !self.chart.frame {
            return [0.0, 0.0];
        }
        let beside = if self.chart.y.label.is_empty() { 0.0 } else { BESIDE };
        let below = if self.label.is_empty() { TEXT } else { TEXTS };
        let widest = self.widths[1].iter().copied().fold(0.0, f64::max);
        [2.0 * TICK + widest + beside * SMALL, 2.0 * TICK + below * SMALL]
    }

    /// How far the first and the last text of the horizontal axis reach beyond the frame, at most.
    pub fn overhang(&self) -> [f64; 2] {
        let (ticks, widths) = (&self.major[0], &self.widths[0]);
        let inward = |tick: &Tick| self.chart.x.position(tick.value);
        let first = ticks.first().zip(widths.first());
        let last = ticks.last().zip(widths.last());
        [
            first.map_or(0.0, |(tick, width)| width / 2.0 * (1.0 - inward(tick))),
            last.map_or(0.0, |(tick, width)| width / 2.0 * inward(tick)),
        ]
    }

    /// Blanks texts of the horizontal axis that would touch the one before them.
    pub fn thin_out(&mut self, length: f64) {
        let mut free = f64::NEG_INFINITY;
        for (tick, width) in self.major[0].iter_mut().zip(&self.widths[0]) {
            let at = length * self.chart.x.position(tick.value);
            if at - width / 2.0 < free {
                tick.text.clear();
            } else {
                free = at + width / 2.0 + APART;
            }
        }
    }

    fn ticked(&self, [x, y]: &[Vec<Tick>; 2]) -> (Ticked<'a>, Ticked<'a>) {
        let ticked = |axis, ticks: &Vec<Tick>| Ticked {
            axis,
            ticks: ticks.clone(),
        };
        (ticked(&self.chart.x, x), ticked(&self.chart.y, y))
    }

    fn build<'p>(
        &self,
        ticks: &[Vec<Tick>; 2],
        page: &DrawingArea<Backend<'p>, Shift>,
        plot: Rect,
    ) -> Result<Context<'a, 'p>, Error> {
        let [left, below] = self.room().map(pixels);
        let [l, t, r, b] = [plot.left, plot.top, plot.right, plot.bottom].map(pixels);
        // plotters' areas end before their last pixel, and the frame is on it
        let area = page
            .clone()
            .shrink((l - left, t), (r + 1 - l + left, b + 1 - t + below));
        let (x, y) = self.ticked(ticks);
        let mut builder = ChartBuilder::on(&area);
        builder.y_label_area_size(left).x_label_area_size(below);
        builder.build_cartesian_2d(x, y).map_err(refused)
    }

    /// plotters' chart with its plotting area on the given rectangle.
    pub fn context<'p>(&self, page: &DrawingArea<Backend<'p>, Shift>, plot: Rect) -> Result<Context<'a, 'p>, Error> {
        self.build(&self.major, page, plot)
    }

    /// Lines across the chart at its ticks.
    pub fn draw_grid(&self, context: &mut Context<'a, '_>) -> Result<(), Error> {
        let mut mesh = context.configure_mesh();
        mesh.disable_axes()
            .bold_line_style(line_style(Stroke::solid(Colour::PALE, 0.12)));
        if !self.chart.x.grid {
            mesh.disable_x_mesh();
        }
        if !self.chart.y.grid {
            mesh.disable_y_mesh();
        }
        mesh.draw().map_err(refused)
    }

    /// The frame, the ticks and all texts.
    pub fn draw_axes<'p>(
        &self,
        context: &mut Context<'a, 'p>,
        page: &DrawingArea<Backend<'p>, Shift>,
        plot: Rect,
    ) -> Result<(), Error> {
        let style = line_style(Stroke::solid(Colour::INK, 0.2));
        let (x, y) = (self.chart.x.range, self.chart.y.range);
        let frame = Rectangle::new([(x.0, y.1), (x.1, y.0)], style);
        context.plotting_area().draw(&frame).map_err(refused)?;
        let font = FontDesc::new(FontFamily::SansSerif, font_size(SMALL), FontStyle::Normal);
        let text = TextStyle::from(font).color(&style.color);
        let mut mesh = context.configure_mesh();
        mesh.disable_mesh().axis_style(style).label_style(text);
        mesh.set_all_tick_mark_size(pixels(TICK));
        if !self.label.is_empty() {
            mesh.x_desc(&self.label);
        }
        if !self.chart.y.label.is_empty() {
            mesh.y_desc(&self.chart.y.label);
        }
        mesh.draw().map_err(refused)?;
        if self.minor.iter().all(Vec::is_empty) {
            return Ok(());
        }
        // plotters ticks an axis in one length only: shorter ones are those of another chart in the same
        // place
        let mut minor = self.build(&self.minor, page, plot)?;
        let mut mesh = minor.configure_mesh();
        mesh.disable_mesh().axis_style(style);
        mesh.set_all_tick_mark_size(pixels(TICK / 2.0));
        mesh.draw().map_err(refused)
    }
}
