//! A chart: two axes and layers of data, in the data's own coordinates.
//!
//! Layers are drawn in the order in which they are added, so bands and cells come first. Whatever lies
//! outside the axes' ranges is cut off; a point that is not finite interrupts a line and is left out
//! elsewhere. A layer with a label appears in the legend.

use crate::colour::{Colour, ColourScale};
use crate::scene::{Dash, Stroke};
use crate::text::Anchor;

/// How an area is filled. Colours are opaque: two that show through each other make a third one, which no
/// legend explains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fill {
    /// With a colour.
    Plain(Colour),
    /// With an outline and parallel lines of this colour, between which others are seen.
    Hatched(Colour),
}

/// How values are laid out along an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    #[default]
    Linear,
    /// By their logarithms; the range must be positive.
    Log,
}

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What is on it, with markup; empty for none.
    pub label: String,
    /// Lower and upper end.
    pub range: (f64, f64),
    /// Linear or logarithmic.
    pub scale: Scale,
    /// A value at which a linear axis changes its scale, and where it lies: 0 at the lower end, 1 at the
    /// upper one.
    pub joint: Option<(f64, f64)>,
    /// Ticks with their texts, where the usual ones will not do.
    pub ticks: Option<Vec<(f64, String)>>,
    /// Whether lines run across the chart at its ticks.
    pub grid: bool,
}

impl Axis {
    /// A linear axis without grid.
    pub fn new(label: impl Into<String>, range: (f64, f64)) -> Self {
        Axis {
            label: label.into(),
            range,
            scale: Scale::Linear,
            joint: None,
            ticks: None,
            grid: false,
        }
    }

    /// A logarithmic axis without grid.
    pub fn log(label: impl Into<String>, range: (f64, f64)) -> Self {
        Axis {
            scale: Scale::Log,
            ..Axis::new(label, range)
        }
    }

    /// With lines across the chart.
    pub fn with_grid(mut self) -> Self {
        self.grid = true;
        self
    }

    /// With ticks at these whole numbers, for valences and orders.
    pub fn with_integers(mut self, values: impl IntoIterator<Item = usize>) -> Self {
        self.ticks = Some(values.into_iter().map(|k| (k as f64, k.to_string())).collect());
        self
    }

    /// With another scale above a value, which lies at this part of the axis. A joint that is not inside the
    /// range, or of a logarithmic axis, is none.
    pub fn with_joint(mut self, value: f64, position: f64) -> Self {
        let inside = self.range.0 < value && value < self.range.1 && 0.0 < position && position < 1.0;
        self.joint = (inside && self.scale == Scale::Linear).then_some((value, position));
        self
    }

    /// Where a value lies: 0 at the lower end, 1 at the upper one.
    pub(crate) fn position(&self, value: f64) -> f64 {
        let (low, high) = self.range;
        match self.scale {
            Scale::Linear => match self.joint {
                Some((joint, at)) if value > joint => at + (1.0 - at) * (value - joint) / (high - joint),
                Some((joint, at)) => at * (value - low) / (joint - low),
                None => (value - low) / (high - low),
            },
            Scale::Log if value > 0.0 => (value / low).ln() / (high / low).ln(),
            // below everything that a logarithmic axis shows: lines leave through the lower end
            Scale::Log if value <= 0.0 => -10.0,
            Scale::Log => f64::NAN,
        }
    }

    /// What lies at a position, the inverse of [`Axis::position`].
    pub(crate) fn value(&self, position: f64) -> f64 {
        let (low, high) = self.range;
        match self.scale {
            Scale::Linear => match self.joint {
                Some((joint, at)) if position > at => joint + (position - at) / (1.0 - at) * (high - joint),
                Some((joint, at)) => low + position / at * (joint - low),
                None => low + position * (high - low),
            },
            Scale::Log => low * (high / low).powf(position),
        }
    }
}

/// The smallest range that holds all finite values, widened by a fraction of itself at both ends; `None` if
/// there are none.
pub fn range_of(values: impl IntoIterator<Item = f64>, margin: f64) -> Option<(f64, f64)> {
    let finite = values.into_iter().filter(|value| value.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    if low > high {
        return None;
    }
    // equal values get a range around them
    let span = if high > low { high - low } else { low.abs().max(1.0) };
    Some((low - margin * span, high + margin * span))
}

/// The smallest range of whole powers of ten that holds all positive finite values.
pub fn decades_of(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    let positive = values.into_iter().filter(|&value| value.is_finite() && value > 0.0);
    let (low, high) = range_of(positive.map(f64::log10), 0.0)?;
    let (low, high) = (low.floor(), high.ceil());
    Some((10f64.powf(low), 10f64.powf(if high > low { high } else { low + 1.0 })))
}

/// How the points of a series are marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// A ring, filled white.
    Circle,
    /// A square, filled white.
    Square,
    /// A triangle, filled white.
    Triangle,
    /// A diamond, filled white.
    Diamond,
    /// A filled disc.
    Disc,
    /// A diagonal cross.
    Cross,
}

impl Marker {
    /// The marker of the series number `index`, over and over.
    pub fn line(index: usize) -> Marker {
        [
            Marker::Circle,
            Marker::Square,
            Marker::Triangle,
            Marker::Diamond,
            Marker::Disc,
            Marker::Cross,
        ][index % 6]
    }
}

/// How a series of points is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// The line, if there is one.
    pub line: Option<Stroke>,
    /// The markers with their radius in millimetres, if there are any.
    pub marker: Option<(Marker, f64)>,
    /// The colour of the markers.
    pub colour: Colour,
}

/// The usual width of lines, in millimetres: 1 point.
pub const LINE: f64 = 0.35;
/// The usual radius of markers, in millimetres.
pub const MARKER: f64 = 0.75;

impl Style {
    /// The line number `index` of a chart: a colour with a dash of its own.
    pub fn line(index: usize) -> Self {
        let colour = Colour::line(index);
        Style {
            line: Some(Stroke {
                colour,
                width: LINE,
                dash: Dash::line(index),
            }),
            marker: None,
            colour,
        }
    }

    /// A solid line.
    pub fn solid(colour: Colour) -> Self {
        Style {
            line: Some(Stroke::solid(colour, LINE)),
            marker: None,
            colour,
        }
    }

    /// Markers only.
    pub fn points(marker: Marker, colour: Colour) -> Self {
        Style {
            line: None,
            marker: Some((marker, MARKER)),
            colour,
        }
    }

    /// With these markers too.
    pub fn marked(mut self, marker: Marker) -> Self {
        self.marker = Some((marker, MARKER));
        self
    }

    /// With lines of this width, in millimetres.
    pub fn wide(mut self, width: f64) -> Self {
        if let Some(line) = &mut self.line {
            line.width = width;
        }
        self
    }

    /// With dashed lines.
    pub fn dashed(mut self, dash: Dash) -> Self {
        if let Some(line) = &mut self.line {
            line.dash = dash;
        }
        self
    }
}

/// Something in a chart; see the functions of [`Chart`], which add them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Layer {
    Series {
        points: Vec<[f64; 2]>,
        style: Style,
    },
    /// Between two curves over the same abscissae: `[x, low, high]`.
    Band {
        points: Vec<[f64; 3]>,
        fill: Fill,
    },
    /// An interval of x over the whole height.
    Span {
        from: f64,
        to: f64,
        colour: Colour,
    },
    /// A line across the whole chart, with a text above the frame (vertical ones only).
    Rule {
        at: f64,
        vertical: bool,
        stroke: Stroke,
        text: String,
    },
    Cells {
        cells: Vec<(Vec<[f64; 2]>, Colour)>,
    },
    Outline {
        corners: Vec<[f64; 2]>,
        stroke: Stroke,
        fill: Option<Fill>,
    },
    Text {
        at: [f64; 2],
        text: String,
        anchor: Anchor,
        colour: Colour,
    },
}

/// Two axes with layers.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    pub(crate) equal: bool,
    pub(crate) frame: bool,
    pub(crate) layers: Vec<(Layer, Option<String>)>,
    pub(crate) scales: Vec<(ColourScale, [bool; 2])>,
}

impl Chart {
    /// An empty chart with a frame.
    pub fn new(x: Axis, y: Axis) -> Self {
        Chart {
            x,
            y,
            equal: false,
            frame: true,
            layers: Vec::new(),
            scales: Vec::new(),
        }
    }

    /// A picture of the plane: the same scale in both directions, no frame, ticks and labels. For natural
    /// configurations and characteristic maps.
    pub fn map(x: (f64, f64), y: (f64, f64)) -> Self {
        Chart {
            equal: true,
            frame: false,
            ..Chart::new(Axis::new("", x), Axis::new("", y))
        }
    }

    /// With the same scale in both directions, and axes.
    pub fn equal(mut self) -> Self {
        self.equal = true;
        self
    }

    fn add(mut self, layer: Layer) -> Self {
        self.layers.push((layer, None));
        self
    }

    /// Names the layer that was added last in the legend.
    pub fn label(mut self, text: impl Into<String>) -> Self {
        if let Some((_, label)) = self.layers.last_mut() {
            *label = Some(text.into());
        }
        self
    }

    /// Points that are joined, marked, or both.
    pub fn series(self, points: impl IntoIterator<Item = [f64; 2]>, style: Style) -> Self {
        let points = points.into_iter().collect();
        self.add(Layer::Series { points, style })
    }

    /// The area between two curves, given as `[x, low, high]`; where any of them is not finite it is
    /// interrupted. Bands lie below the grid.
    pub fn band(self, points: impl IntoIterator<Item = [f64; 3]>, fill: Fill) -> Self {
        let points = points.into_iter().collect();
        self.add(Layer::Band { points, fill })
    }

    /// Shades an interval of x.
    pub fn span(self, from: f64, to: f64, colour: Colour) -> Self {
        self.add(Layer::Span { from, to, colour })
    }

    /// A vertical line with a text above the frame, or an empty one. Texts that are too close are moved
    /// apart.
    pub fn vertical(self, at: f64, text: impl Into<String>, stroke: Stroke) -> Self {
        let text = text.into();
        self.add(Layer::Rule {
            at,
            vertical: true,
            stroke,
            text,
        })
    }

    /// A horizontal line.
    pub fn horizontal(self, at: f64, stroke: Stroke) -> Self {
        self.add(Layer::Rule {
            at,
            vertical: false,
            stroke,
            text: String::new(),
        })
    }

    /// Polygons coloured by a value each, without seams between them, drawn by rising value. The panel or the
    /// figure needs a colour bar for the scale.
    pub fn cells(mut self, cells: impl IntoIterator<Item = (Vec<[f64; 2]>, f64)>, scale: &ColourScale) -> Self {
        let mut cells: Vec<_> = cells.into_iter().collect();
        cells.sort_by(|a, b| a.1.total_cmp(&b.1));
        self.scales
            .push((scale.clone(), scale.beyond(cells.iter().map(|cell| cell.1))));
        let coloured = |(corners, value)| (corners, scale.colour(value));
        let cells = cells.into_iter().map(coloured).collect();
        self.add(Layer::Cells { cells })
    }

    /// Polygons of a plain colour each, without seams; for areas that a legend or nothing needs to explain.
    pub fn areas(self, cells: impl IntoIterator<Item = (Vec<[f64; 2]>, Colour)>) -> Self {
        let cells = cells.into_iter().collect();
        self.add(Layer::Cells { cells })
    }

    /// A closed line, filled or not.
    pub fn outline(self, corners: impl IntoIterator<Item = [f64; 2]>, stroke: Stroke, fill: Option<Fill>) -> Self {
        let corners = corners.into_iter().collect();
        self.add(Layer::Outline { corners, stroke, fill })
    }

    /// A text at a point of the chart.
    pub fn text(self, at: [f64; 2], text: impl Into<String>, anchor: Anchor, colour: Colour) -> Self {
        let text = text.into();
        self.add(Layer::Text {
            at,
            text,
            anchor,
            colour,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_leave_out_what_is_not_finite() {
        assert_eq!(range_of([1.0, f64::NAN, 3.0, f64::INFINITY], 0.5), Some((0.0, 4.0)));
        assert_eq!(range_of([f64::NAN], 0.1), None);
        assert_eq!(range_of([2.0, 2.0], 0.5), Some((1.0, 3.0)));
        assert_eq!(decades_of([0.0, 0.02, 300.0]), Some((0.01, 1000.0)));
        assert_eq!(decades_of([1.0]), Some((1.0, 10.0)));
    }

    #[test]
    fn positions() {
        assert_eq!(Axis::new("", (2.0, 4.0)).position(3.0), 0.5);
        let log = Axis::log("", (1.0, 100.0));
        assert!((log.position(10.0) - 0.5).abs() < 1e-15);
        assert!(log.position(0.0) < 0.0 && log.position(f64::NAN).is_nan());
        let joined = Axis::new("", (0.0, 1.0)).with_joint(0.9, 0.6);
        for (value, position) in [(0.0, 0.0), (0.45, 0.3), (0.9, 0.6), (0.95, 0.8), (1.0, 1.0)] {
            assert!((joined.position(value) - position).abs() < 1e-15, "{value}");
        }
        assert!(joined.position(-1.0) < 0.0 && joined.position(1.1) > 1.0);
        assert_eq!(Axis::new("", (0.0, 1.0)).with_joint(1.0, 0.5).joint, None);
        for axis in [log, Axis::new("", (-3.0, 7.0)), joined] {
            for position in [0.0, 0.3, 1.0] {
                assert!((axis.position(axis.value(position)) - position).abs() < 1e-15);
            }
        }
    }
}
