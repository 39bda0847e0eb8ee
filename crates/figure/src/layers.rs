//! The layers of a chart, drawn through plotters.
//!
//! plotters puts points outside the frame on its border, which would bend lines: they are cut there before,
//! by their positions along the axes, so that a line across a logarithmic axis is cut where it is straight.
//! Meshes of cells, whose seams are closed, and texts beside points go to the page directly.

use crate::axes::{Axes, Context};
use crate::backend::{Backend, Line, MIDDLE, Mark, Point, fill_style, refused};
use crate::chart::{Chart, Fill, Layer, Marker};
use crate::clip;
use crate::colour::Colour;
use crate::draw::{Page, SMALL};
use crate::error::Error;
use crate::hatch;
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

    /// Draws everything: spans, then bands, then the grid, and all else above it.
    pub fn draw(mut self) -> Result<(), Error> {
        let layers = &self.chart.layers;
        let order = |layer: &Layer| match layer {
            Layer::Span { .. } => 0,
            Layer::Band { .. } => 1,
            _ => 2,
        };
        for turn in 0..3 {
            if turn == 2 {
                self.axes.draw_grid(&mut self.context)?;
            }
            let mut these = layers.iter().filter(|(layer, _)| order(layer) == turn);
            these.try_for_each(|layer| self.labelled(layer))?;
        }
        match self.chart.frame {
            true => self.axes.draw_axes(&mut self.context, &self.page, self.plot),
            false => Ok(()),
        }
    }

    /// Draws a layer, and notes its label if that has left something on the page.
    fn labelled(&mut self, (layer, label): &(Layer, Option<String>)) -> Result<(), Error> {
        let shapes = |canvas: &Self| canvas.backend.borrow().page.scene.shapes.len();
        let before = shapes(self);
        self.layer(layer)?;
        let left_something = shapes(self) > before;
        if let Some(label) = label.as_ref().filter(|_| left_something) {
            self.backend.borrow_mut().page.drawn.push(label.clone());
        }
        Ok(())
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
        self.on_page(self.position(point))
    }

    /// Where a position lies on the page.
    fn on_page(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            self.plot.left + x * self.plot.width(),
            self.plot.bottom - y * self.plot.height(),
        ]
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
    fn fill(&mut self, corners: &[[f64; 2]], fill: Fill) -> Result<(), Error> {
        let inside = clip::polygon(corners, &FRAME);
        if inside.is_empty() {
            return Ok(());
        }
        match fill {
            Fill::Plain(colour) => {
                let corners: Vec<Point> = inside.into_iter().map(|at| self.value(at)).collect();
                let area = Polygon::new(corners, fill_style(colour));
                self.context.draw_series([area]).map(|_| ()).map_err(refused)
            }
            Fill::Hatched(colour) => {
                let corners: Vec<[f64; 2]> = inside.into_iter().map(|at| self.on_page(at)).collect();
                self.backend
                    .borrow_mut()
                    .page
                    .scene
                    .shapes
                    .extend(hatched(corners, colour));
                Ok(())
            }
        }
    }

    fn markers(&mut self, positions: &[[f64; 2]], marker: Marker, radius: f64, colour: Colour) -> Result<(), Error> {
        let seen = positions.iter().filter(|at| is_inside(at));
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
            Layer::Band { points, fill } => band(self.chart, points)
                .iter()
                .try_for_each(|corners| self.fill(corners, *fill)),
            Layer::Span { from, to, colour } => self.fill(&span(self.chart, *from, *to), Fill::Plain(*colour)),
            Layer::Rule {
                at, vertical, stroke, ..
            } => self.line(&rule(self.chart, *at, *vertical), *stroke),
            Layer::Cells { cells } => {
                let placed = cells.iter().filter_map(|(corners, colour)| {
                    let corners: Vec<[f64; 2]> = corners.iter().map(|p| self.place(*p)).collect();
                    let kept = clip::polygon(&corners, &self.plot);
                    (kept.len() > 2).then_some((*colour, kept))
                });
                let cells: Vec<_> = placed.collect();
                if !cells.is_empty() {
                    self.backend.borrow_mut().page.scene.shapes.push(Shape::Mesh { cells });
                }
                Ok(())
            }
            Layer::Outline { corners, stroke, fill } => {
                let mut corners: Vec<[f64; 2]> = corners.iter().map(|p| self.position(*p)).collect();
                if let Some(fill) = fill {
                    self.fill(&corners, *fill)?;
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

fn is_inside(&[x, y]: &[f64; 2]) -> bool {
    FRAME.contains(&Rect::new(x, y, x, y), SLACK)
}

/// The pieces of a band as polygons, by positions.
fn band(chart: &Chart, points: &[[f64; 3]]) -> Vec<Vec<[f64; 2]>> {
    let position = |x: f64, y: f64| [chart.x.position(x), chart.y.position(y)];
    let runs = points.split(|p| !p.iter().all(|c| c.is_finite()));
    let polygons = runs.map(|run| {
        let below = run.iter().map(|p| position(p[0], p[1]));
        let above = run.iter().rev().map(|p| position(p[0], p[2]));
        below.chain(above).collect()
    });
    polygons.collect()
}

fn span(chart: &Chart, from: f64, to: f64) -> [[f64; 2]; 4] {
    let [from, to] = [from, to].map(|end| chart.x.position(end));
    [[from, 0.0], [to, 0.0], [to, 1.0], [from, 1.0]]
}

fn rule(chart: &Chart, at: f64, vertical: bool) -> [[f64; 2]; 2] {
    match vertical {
        true => [1.0, 0.0].map(|end| [chart.x.position(at), end]),
        false => [0.0, 1.0].map(|end| [end, chart.y.position(at)]),
    }
}

/// Whether any of a layer lies inside the frame, for legends, which are measured before anything is drawn.
pub(crate) fn is_visible(chart: &Chart, layer: &Layer) -> bool {
    let positions = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
        points
            .iter()
            .map(|[x, y]| [chart.x.position(*x), chart.y.position(*y)])
            .collect()
    };
    let line = |points: &[[f64; 2]]| !clip::polyline(points, &FRAME).is_empty();
    let area = |corners: &[[f64; 2]]| !clip::polygon(corners, &FRAME).is_empty();
    match layer {
        Layer::Series { points, style } => {
            let points = positions(points);
            style.line.is_some() && line(&points) || style.marker.is_some() && points.iter().any(is_inside)
        }
        Layer::Band { points, .. } => band(chart, points).iter().any(|corners| area(corners)),
        Layer::Span { from, to, .. } => area(&span(chart, *from, *to)),
        Layer::Rule { at, vertical, .. } => line(&rule(chart, *at, *vertical)),
        Layer::Cells { cells } => cells.iter().any(|(corners, _)| area(&positions(corners))),
        Layer::Outline { corners, .. } => {
            let mut corners = positions(corners);
            corners.extend(corners.first().copied());
            area(&corners) || line(&corners)
        }
        Layer::Text { .. } => false,
    }
}

/// A hatched polygon on the page.
pub(crate) fn hatched(corners: Vec<[f64; 2]>, colour: Colour) -> [Shape; 2] {
    let shape = |lines, closed| Shape::Path {
        lines,
        closed,
        fill: None,
        stroke: Some(Stroke::solid(colour, hatch::WIDTH)),
    };
    [shape(hatch::hatch(&corners), false), shape(vec![corners], true)]
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
        fill: Some(Colour::WHITE),
        stroke: Some(stroke),
    });
}
