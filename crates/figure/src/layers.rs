//! The layers of a chart, drawn through plotters.
//!
//! plotters puts points outside the frame on its border, which would bend lines: they are cut there before,
//! by their positions along the axes, so that a line across a logarithmic axis is cut where it is straight.
//! Meshes of cells, whose seams are closed, and texts beside points go to the page directly.

use crate::axes::{Axes, Context};
use crate::backend::{Backend, Line, MIDDLE, Mark, Point, fill_style, refused};
use crate::chart::{Chart, Layer, Marker};
use crate::clip;
use crate::colour::Colour;
use crate::draw::{Page, SMALL};
use crate::error::Error;
use crate::scene::{Dash, Rect, Scene, Shape, Stroke};
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::Polygon;
use std::cell::RefCell;
use std::rc::Rc;

/// The frame, by positions along the axes.
const FRAME: Rect = Rect {
    left: 0.0,
    top: 0.0,
    right: 1.0,
    bottom: 1.0,
};
/// A point that misses the frame by rounding is on it.
const SLACK: f64 = 1e-9;

/// A chart on its way to the page.
pub(crate) struct Canvas<'a, 'p> {
    chart: &'a Chart,
    axes: &'a Axes<'a>,
    plot: Rect,
    backend: Rc<RefCell<Backend<'p>>>,
    page: DrawingArea<Backend<'p>, Shift>,
    context: Context<'a, 'p>,
}

impl<'a, 'p> Canvas<'a, 'p> {
    /// A chart with these axes, whose data take the given rectangle.
    pub fn new(axes: &'a Axes<'a>, page: &'p mut Page, plot: Rect) -> Result<Self, Error> {
        let backend = Rc::new(RefCell::new(Backend::new(page, plot)));
        let page = DrawingArea::from(&backend);
        let context = axes.context(&page, plot)?;
        let chart = axes.chart;
        Ok(Canvas {
            chart,
            axes,
            plot,
            backend,
            page,
            context,
        })
    }

    /// Draws everything; spans lie below the grid, all else above it.
    pub fn draw(mut self) -> Result<(), Error> {
        let is_span = |layer: &Layer| matches!(layer, Layer::Span { .. });
        let layers = || self.chart.layers.iter().map(|(layer, _)| layer);
        let (spans, others): (Vec<&Layer>, Vec<&Layer>) = layers().partition(|layer| is_span(layer));
        spans.into_iter().try_for_each(|layer| self.layer(layer))?;
        self.axes.draw_grid(&mut self.context)?;
        others.into_iter().try_for_each(|layer| self.layer(layer))?;
        match self.chart.frame {
            true => self.axes.draw_axes(&mut self.context, &self.page, self.plot),
            false => Ok(()),
        }
    }

    fn position(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.chart.x.position(x), self.chart.y.position(y)]
    }

    /// Where a position lies in the chart's own coordinates, which plotters takes.
    fn value(&self, [x, y]: [f64; 2]) -> Point {
        (self.chart.x.value(x), self.chart.y.value(y))
    }

    /// Where a point lies on the page.
    fn place(&self, point: [f64; 2]) -> [f64; 2] {
        let ([x, y], plot) = (self.position(point), &self.plot);
        [plot.left + x * plot.width(), plot.bottom - y * plot.height()]
    }

    /// The pieces of a line inside the frame.
    fn line(&mut self, positions: &[[f64; 2]], stroke: Stroke) -> Result<(), Error> {
        let values = |piece: Vec<[f64; 2]>| piece.into_iter().map(|at| self.value(at)).collect();
        let pieces: Vec<Vec<Point>> = clip::polyline(positions, &FRAME).into_iter().map(values).collect();
        if pieces.is_empty() {
            return Ok(());
        }
        let line = Line { pieces, stroke };
        self.context.draw_series([line]).map(|_| ()).map_err(refused)
    }

    /// The part of a polygon inside the frame.
    fn fill(&mut self, corners: &[[f64; 2]], colour: Colour, opacity: f64) -> Result<(), Error> {
        let inside: Vec<Point> = clip::polygon(corners, &FRAME)
            .into_iter()
            .map(|at| self.value(at))
            .collect();
        if inside.is_empty() {
            return Ok(());
        }
        let area = Polygon::new(inside, fill_style(colour, opacity));
        self.context.draw_series([area]).map(|_| ()).map_err(refused)
    }

    fn markers(&mut self, positions: &[[f64; 2]], marker: Marker, radius: f64, colour: Colour) -> Result<(), Error> {
        let visible = Rect::new(-SLACK, -SLACK, 1.0 + SLACK, 1.0 + SLACK);
        let seen = positions
            .iter()
            .filter(|[x, y]| visible.contains(&Rect::new(*x, *y, *x, *y), 0.0));
        let mark = |at: &[f64; 2]| Mark {
            at: self.value(*at),
            marker,
            radius,
            colour,
        };
        let marks: Vec<Mark> = seen.map(mark).collect();
        self.context.draw_series(marks).map(|_| ()).map_err(refused)
    }

    fn layer(&mut self, layer: &Layer) -> Result<(), Error> {
        match layer {
            Layer::Series { points, style } => {
                let points: Vec<[f64; 2]> = points.iter().map(|p| self.position(*p)).collect();
                if let Some(stroke) = style.line {
                    self.line(&points, stroke)?;
                }
                match style.marker {
                    Some((marker, radius)) => self.markers(&points, marker, radius, style.colour),
                    None => Ok(()),
                }
            }
            Layer::Band {
                points,
                colour,
                opacity,
            } => {
                let finite = |p: &[f64; 3]| p.iter().all(|c| c.is_finite());
                points.split(|p| !finite(p)).try_for_each(|run| {
                    let below = run.iter().map(|p| self.position([p[0], p[1]]));
                    let above = run.iter().rev().map(|p| self.position([p[0], p[2]]));
                    let corners: Vec<[f64; 2]> = below.chain(above).collect();
                    self.fill(&corners, *colour, *opacity)
                })
            }
            Layer::Span { from, to, colour } => {
                let [from, to] = [from, to].map(|end| self.chart.x.position(*end));
                self.fill(&[[from, 0.0], [to, 0.0], [to, 1.0], [from, 1.0]], *colour, 1.0)
            }
            Layer::Rule {
                at, vertical, stroke, ..
            } => {
                let line = if *vertical {
                    [1.0, 0.0].map(|end| [self.chart.x.position(*at), end])
                } else {
                    [0.0, 1.0].map(|end| [end, self.chart.y.position(*at)])
                };
                self.line(&line, *stroke)
            }
            Layer::Cells { cells } => {
                let placed = cells.iter().filter_map(|(corners, colour)| {
                    let corners: Vec<[f64; 2]> = corners.iter().map(|p| self.place(*p)).collect();
                    let kept = clip::polygon(&corners, &self.plot);
                    (kept.len() > 2).then_some((*colour, kept))
                });
                let cells = placed.collect();
                self.backend.borrow_mut().page.scene.shapes.push(Shape::Mesh { cells });
                Ok(())
            }
            Layer::Outline { corners, stroke, fill } => {
                let mut corners: Vec<[f64; 2]> = corners.iter().map(|p| self.position(*p)).collect();
                if let Some(colour) = fill {
                    self.fill(&corners, *colour, 1.0)?;
                }
                corners.extend(corners.first().copied());
                self.line(&corners, *stroke)
            }
            Layer::Text {
                at,
                text,
                anchor,
                colour,
            } => {
                let [x, y] = self.place(*at);
                if !(x.is_finite() && y.is_finite()) {
                    return Ok(());
                }
                let mut backend = self.backend.borrow_mut();
                let at = [x, y + MIDDLE * SMALL];
                backend.page.text(text, SMALL, at, *anchor, false, *colour)
            }
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
