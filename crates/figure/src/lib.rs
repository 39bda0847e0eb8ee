//! Figures at printed size: charts, maps and surfaces as SVG, PNG and PDF.
//!
//! The crate draws. It knows nothing of subdivision, reads and writes no files, and needs no font of the
//! system: characters are outlines of an embedded DejaVu Sans. Axes, grids, ticks and series of charts are
//! drawn by plotters. PNG and PDF are made from the SVG. Equal figures give equal bytes.
//!
//! A [`Figure`] is as wide as one or two printed columns and holds [`Panel`]s on a grid. A panel shows a
//! [`Chart`] (two [`Axis`] and layers: lines, markers, bands, rules, coloured cells, texts) or a [`Surface`]
//! in space. Colours of values come from a [`ColourScale`], which a colour bar must explain. Texts are plain
//! Unicode with symbols between dollar signs, as in `$λ_C^*$`.
//!
//! ```
//! use eigenring_figure::{Axis, Chart, Colour, Dash, Figure, Marker, Panel, Side, Stroke, Style, Width};
//!
//! let parabola = (0..=50).map(|k| f64::from(k) / 50.0).map(|x| [x, x * x]);
//! let samples = [[0.2, 0.05], [0.5, 0.24], [0.8, 0.66]];
//! let chart = Chart::new(Axis::new("$λ$", (0.0, 1.0)), Axis::new("weight", (0.0, 1.0)).with_grid())
//!     .span(0.3, 0.7, Colour::SHADE).label("recommended")
//!     .vertical(0.5, "$λ_M^*$", Stroke { dash: Dash::Dashed, ..Stroke::solid(Colour::GREY, 0.2) })
//!     .series(parabola, Style::line(0)).label("$λ^2$")
//!     .series(samples, Style::points(Marker::Circle, Colour::line(1))).label("samples");
//! let panel = Panel::new(chart).legend(Side::Bottom);
//! let figure = Figure::new(Width::One, 60.0, "A parabola").panel(0, 0, panel);
//! assert!(figure.layout()?.faults().is_empty());
//! let svg: String = figure.svg()?;
//! let png: Vec<u8> = figure.png(300.0)?;
//! assert!(svg.starts_with("<svg") && png.starts_with(b"\x89PNG"));
//! # Ok::<(), eigenring_figure::Error>(())
//! ```
//!
//! A map coloured by values, with its colour bar, and a surface:
//!
//! ```
//! use eigenring_figure::{Chart, ColourMap, ColourScale, Figure, Panel, Surface, View, Width};
//!
//! let scale = ColourScale::new(ColourMap::Viridis, (0.0, 2.0), "height $z$");
//! let strip = |x: f64| vec![[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 2.0], [x, 2.0]];
//! let cells = (0..4).map(|k| f64::from(k)).map(|x| (strip(x), x / 2.0));
//! let map = Chart::map((0.0, 4.0), (0.0, 2.0)).cells(cells, &scale);
//! let quad = [[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [1.0, 1.0, 2.0], [0.0, 1.0, 1.0]];
//! let surface = Surface::new(View::default()).quads([(quad, 1.0)], &scale);
//! let figure = Figure::new(Width::Two, 60.0, "A map and a surface")
//!     .panel(0, 0, Panel::new(map).title("a map"))
//!     .panel(0, 1, Panel::new(surface).title("a surface"))
//!     .colour_bar(&scale);
//! assert!(figure.svg().is_ok());
//! ```
//!
//! Where things go: panels are aligned by their frames; legends stand above, below or to the right of the
//! data, never on them; a colour bar is at the right of its panel, or of the figure. [`Layout::faults`] finds
//! texts that leave the page or overlap, legends that cover data or list what is not drawn, and is meant for
//! tests of figures.

mod axes;
mod backend;
mod chart;
mod clip;
mod colour;
mod draw;
mod error;
mod figure;
mod hatch;
mod layers;
mod layout;
mod legend;
mod panel;
mod pdf;
mod pixels;
mod raster;
mod scene;
mod surface;
mod text;
mod ticks;

pub use chart::{Axis, Chart, Fill, LINE, MARKER, Marker, Scale, Style, decades_of, range_of};
pub use colour::{Colour, ColourMap, ColourScale};
pub use error::Error;
pub use figure::{Figure, TEXT_LINE};
pub use layout::Layout;
pub use legend::Side;
pub use panel::{Content, Panel, Width};
pub use pixels::Pixels;
pub use scene::{Dash, Rect, Stroke};
pub use surface::{Surface, View};
pub use text::{Anchor, POINT};
