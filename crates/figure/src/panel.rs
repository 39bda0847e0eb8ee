//! One part of a figure: what it shows, and the title, colour bar and legend of its own.

use crate::chart::Chart;
use crate::colour::ColourScale;
use crate::legend::Side;
use crate::surface::Surface;

/// The width of a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Width {
    /// One column: 85 mm.
    One,
    /// Both columns: 178 mm.
    Two,
    /// Any other, in millimetres.
    Millimetres(f64),
}

impl Width {
    /// In millimetres.
    pub fn millimetres(self) -> f64 {
        match self {
            Width::One => 85.0,
            Width::Two => 178.0,
            Width::Millimetres(width) => width,
        }
    }
}

/// What a panel shows.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// A chart.
    Chart(Chart),
    /// A surface in space.
    Surface(Surface),
}

impl From<Chart> for Content {
    fn from(chart: Chart) -> Self {
        Content::Chart(chart)
    }
}

impl From<Surface> for Content {
    fn from(surface: Surface) -> Self {
        Content::Surface(surface)
    }
}

/// One part of a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    pub(crate) content: Content,
    pub(crate) title: String,
    pub(crate) bar: Option<ColourScale>,
    pub(crate) legend: Option<Side>,
}

impl Panel {
    /// A chart or surface without title.
    pub fn new(content: impl Into<Content>) -> Self {
        Panel {
            content: content.into(),
            title: String::new(),
            bar: None,
            legend: None,
        }
    }

    /// With a title; in figures of several panels the letter (a), (b), ..., (z), (aa), ... comes before it.
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// With a colour bar to the right.
    pub fn colour_bar(mut self, scale: &ColourScale) -> Self {
        self.bar = Some(scale.clone());
        self
    }

    /// With a legend of its labelled layers.
    pub fn legend(mut self, side: Side) -> Self {
        self.legend = Some(side);
        self
    }

    pub(crate) fn chart(&self) -> Option<&Chart> {
        match &self.content {
            Content::Chart(chart) => Some(chart),
            Content::Surface(_) => None,
        }
    }

    pub(crate) fn scales(&self) -> &[(ColourScale, [bool; 2])] {
        match &self.content {
            Content::Chart(chart) => &chart.scales,
            Content::Surface(surface) => &surface.scales,
        }
    }
}
