//! What is drawn, in millimetres on the page, and its SVG text.
//!
//! A scene is a list of shapes from back to front: paths, meshes of filled cells, circles, and text.
//! Everything is clipped before it gets here, so that no clip paths (whose identifiers would clash on a page
//! with several pictures) are needed. Numbers have a fixed count of decimals: equal scenes give equal bytes.

use crate::colour::Colour;
use crate::error::Error;
use crate::text::{Font, Placed};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::collections::BTreeSet;
use std::fmt::Write;

/// A rectangle on the page; y grows downwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Smallest x.
    pub left: f64,
    /// Smallest y.
    pub top: f64,
    /// Largest x.
    pub right: f64,
    /// Largest y.
    pub bottom: f64,
}

impl Rect {
    /// From its four sides.
    pub fn new(left: f64, top: f64, right: f64, bottom: f64) -> Self {
        Rect {
            left,
            top,
            right,
            bottom,
        }
    }

    /// Its extent in x.
    pub fn width(&self) -> f64 {
        self.right - self.left
    }

    /// Its extent in y.
    pub fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// Whether the other one lies inside, up to `slack`.
    pub fn contains(&self, other: &Rect, slack: f64) -> bool {
        other.left >= self.left - slack
            && other.top >= self.top - slack
            && other.right <= self.right + slack
            && other.bottom <= self.bottom + slack
    }

    /// Whether the insides meet, by more than `slack` each way.
    pub fn meets(&self, other: &Rect, slack: f64) -> bool {
        self.left < other.right - slack
            && other.left < self.right - slack
            && self.top < other.bottom - slack
            && other.top < self.bottom - slack
    }
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub colour: Colour,
    /// Its width in millimetres.
    pub width: f64,
    /// Its dashes.
    pub dash: Dash,
}

impl Stroke {
    /// A solid line.
    pub fn solid(colour: Colour, width: f64) -> Self {
        Stroke {
            colour,
            width,
            dash: Dash::Solid,
        }
    }
}

/// Dashes, in an order in which neighbours are easily told apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Dash {
    /// None.
    #[default]
    Solid,
    /// Long ones.
    Dashed,
    /// Dots.
    Dotted,
    /// Dash and dot in turn.
    DashDot,
}

impl Dash {
    /// The dashes of the line number `index`, over and over.
    pub fn line(index: usize) -> Dash {
        [Dash::Solid, Dash::Dashed, Dash::DashDot, Dash::Dotted][index % 4]
    }

    /// Lengths in units of millimetres.
    fn lengths(self) -> &'static str {
        match self {
            Dash::Solid => "",
            Dash::Dashed => "1.5 0.8",
            Dash::Dotted => "0.3 0.6",
            Dash::DashDot => "1.8 0.6 0.3 0.6",
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    Path {
        lines: Vec<Vec<[f64; 2]>>,
        closed: bool,
        fill: Option<Colour>,
        stroke: Option<Stroke>,
    },
    /// Cells that are stroked with their own colour, so that no seam shows between neighbours.
    Mesh { cells: Vec<(Colour, Vec<[f64; 2]>)> },
    Circle {
        at: [f64; 2],
        radius: f64,
        fill: Colour,
        stroke: Stroke,
    },
    /// Pixels, as a PNG file.
    Image { place: Rect, png: Vec<u8> },
    Text {
        text: Placed,
        colour: Colour,
        source: String,
    },
}

/// Width of the strokes that close the seams of a mesh, in its units: one and a half pixels at 300 dots per
/// inch. With less, a pixel that two neighbours share lets the page through.
const SEAM: i64 = 12;
/// Units of a mesh in a millimetre: whole numbers, counted from corner to corner, make small files.
const UNITS: f64 = 100.0;

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Scene {
    pub size: [f64; 2],
    pub shapes: Vec<Shape>,
}

/// A number with at most `decimals` decimals, without trailing zeros.
pub(crate) fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

/// Lines to the micrometre: after the first place steps from point to point, which are short.
fn path_data(lines: &[Vec<[f64; 2]>], closed: bool) -> String {
    let micrometres = |c: f64| (c * 1000.0).round() as i64;
    let (mut data, mut at) = (String::new(), [0; 2]);
    for line in lines {
        let mut start = at;
        for (index, point) in line.iter().enumerate() {
            let place = point.map(micrometres);
            let [x, y] = [0, 1].map(|i| (place[i] - at[i]) as f64 / 1000.0);
            at = place;
            if index == 0 {
                start = place;
            }
            data.push(if index == 0 { 'm' } else { 'l' });
            data.push_str(&number(x, 3));
            if y >= 0.0 {
                data.push(' ');
            }
            data.push_str(&number(y, 3));
        }
        if closed {
            data.push('z');
            at = start;
        }
    }
    data
}

/// Closed polygons in whole units, each corner relative to the one before; `pen` is where the last one began.
fn mesh_data(cell: &[[f64; 2]], pen: &mut [i64; 2], data: &mut String) {
    let mut at = *pen;
    for (index, corner) in cell
        .iter()
        .map(|corner| corner.map(|c| (c * UNITS).round() as i64))
        .enumerate()
    {
        let step = [corner[0] - at[0], corner[1] - at[1]];
        at = corner;
        match index {
            0 => *pen = corner,
            // a corner that rounding has put on the one before
            _ if step == [0, 0] => continue,
            _ => {}
        }
        // after a move all pairs are lines; a sign separates as well as a blank
        data.push(if index == 0 { 'm' } else { ' ' });
        let apart = if step[1] < 0 { "" } else { " " };
        // writing to a String cannot fail
        let _ = write!(data, "{}{apart}{}", step[0], step[1]);
    }
    data.push('z');
}

fn stroke_attributes(stroke: &Option<Stroke>) -> String {
    let Some(stroke) = stroke else { return String::new() };
    let mut text = format!(
        " stroke=\"{}\" stroke-width=\"{}\"",
        stroke.colour.hex(),
        number(stroke.width, 3)
    );
    if stroke.dash != Dash::Solid {
        let _ = write!(text, " stroke-dasharray=\"{}\"", stroke.dash.lengths());
    }
    text
}

/// How many cells a run of meshes has at least that is better kept as pixels.
const DENSE: usize = 600;

impl Scene {
    /// `prefix` begins all identifiers, which must be different on a page with several pictures.
    pub fn svg(&self, title: &str, font: &Font, prefix: &str) -> String {
        let [width, height] = self.size.map(|length| number(length, 3));
        let mut out = String::new();
        // writing to a String cannot fail
        let _ = writeln!(
            out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{width}mm\" \
             height=\"{height}mm\" viewBox=\"0 0 {width} {height}\" stroke-linejoin=\"round\" role=\"img\">\n\
             <title>{}</title>",
            escape(title)
        );
        let glyphs = self.shapes.iter().flat_map(|shape| match shape {
            Shape::Text { text, .. } => text.line.glyphs.as_slice(),
            _ => &[],
        });
        let used: BTreeSet<u16> = glyphs.map(|glyph| glyph.id).collect();
        out.push_str("<defs>\n");
        for id in used {
            let outline = font.outline(id);
            if !outline.is_empty() {
                let _ = writeln!(out, "<path id=\"{prefix}glyph{id}\" d=\"{outline}\"/>");
            }
        }
        let _ = writeln!(
            out,
            "</defs>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>"
        );
        for shape in &self.shapes {
            shape.svg(&mut out, font, prefix);
        }
        out.push_str("</svg>\n");
        out
    }

    /// The same with pixels in place of every run of meshes of many cells, with the lines between them and
    /// those upon them that follow: at so many dots per inch, on a transparent ground.
    ///
    /// # Errors
    /// Those of the rasteriser.
    pub fn with_pixels(self, dpi: f64) -> Result<Scene, Error> {
        let Scene { size, shapes } = self;
        let mut found = Vec::new();
        for run in shapes.chunk_by(|a, b| a.may_be_pixels() == b.may_be_pixels()) {
            let first = run.iter().position(Shape::is_mesh);
            let last = run.iter().rposition(Shape::is_mesh);
            let (Some(first), Some(last)) = (first, last) else {
                found.extend_from_slice(run);
                continue;
            };
            let place = within(&run[first..=last], size);
            let upon = run[last + 1..].iter().take_while(|shape| shape.is_line_in(&place));
            let last = last + upon.count();
            let dense = &run[first..=last];
            if dense.iter().map(Shape::cells).sum::<usize>() < DENSE {
                found.extend_from_slice(run);
                continue;
            }
            found.extend_from_slice(&run[..first]);
            found.push(Scene::image(dense, place, dpi)?);
            found.extend_from_slice(&run[last + 1..]);
        }
        Ok(Scene { size, shapes: found })
    }

    /// Some shapes as the pixels of a place on the page.
    fn image(shapes: &[Shape], place: Rect, dpi: f64) -> Result<Shape, Error> {
        let mut inner = String::new();
        for shape in shapes {
            shape.svg(&mut inner, &Font::new(), "");
        }
        let [x, y, width, height] =
            [place.left, place.top, place.width(), place.height()].map(|length| number(length, 3));
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" viewBox=\"{x} {y} {width} \
             {height}\" stroke-linejoin=\"round\">\n{inner}</svg>"
        );
        let png = crate::raster::png_on(&svg, dpi, None)?;
        Ok(Shape::Image { place, png })
    }
}

/// The smallest rectangle on a page that holds the cells and lines of some shapes.
fn within(shapes: &[Shape], page: [f64; 2]) -> Rect {
    let range = |axis: usize| {
        let values = shapes.iter().flat_map(Shape::points).map(|point| point[axis]);
        // lines reach beyond their points by half their width
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value - 0.5), high.max(value + 0.5))
        });
        // a surface may grow beyond the page, and nothing of it is seen there
        let low = low.clamp(0.0, page[axis] - 1.0);
        (low, high.clamp(low + 1.0, page[axis]))
    };
    let [(left, right), (top, bottom)] = [range(0), range(1)];
    Rect::new(left, top, right, bottom)
}

impl Shape {
    /// Whether it is nothing but strokes within a place.
    fn is_line_in(&self, place: &Rect) -> bool {
        let inside = |[x, y]: [f64; 2]| place.contains(&Rect::new(x, y, x, y), 0.0);
        matches!(self, Shape::Path { fill: None, .. }) && self.points().into_iter().all(inside)
    }

    fn is_mesh(&self) -> bool {
        matches!(self, Shape::Mesh { .. })
    }

    fn may_be_pixels(&self) -> bool {
        matches!(self, Shape::Mesh { .. } | Shape::Path { .. })
    }

    fn cells(&self) -> usize {
        match self {
            Shape::Mesh { cells } => cells.len(),
            _ => 0,
        }
    }

    /// The corners of cells and lines.
    fn points(&self) -> Vec<[f64; 2]> {
        match self {
            Shape::Mesh { cells } => cells.iter().flat_map(|(_, corners)| corners.iter().copied()).collect(),
            Shape::Path { lines, .. } => lines.concat(),
            _ => Vec::new(),
        }
    }
}

impl Shape {
    fn svg(&self, out: &mut String, font: &Font, prefix: &str) {
        // writing to a String cannot fail
        let _ = match self {
            Shape::Path {
                lines,
                closed,
                fill,
                stroke,
            } => {
                let fill = fill.map_or("none".to_owned(), Colour::hex);
                let data = path_data(lines, *closed);
                writeln!(out, "<path d=\"{data}\" fill=\"{fill}\"{}/>", stroke_attributes(stroke))
            }
            Shape::Mesh { cells } => {
                let scale = 1.0 / UNITS;
                let _ = writeln!(
                    out,
                    "<g transform=\"scale({scale})\" fill=\"currentColor\" stroke=\"currentColor\" stroke-width=\"{SEAM}\">"
                );
                for run in cells.chunk_by(|a, b| a.0 == b.0) {
                    let (mut pen, mut data) = ([0; 2], String::new());
                    for (_, cell) in run {
                        mesh_data(cell, &mut pen, &mut data);
                    }
                    let _ = writeln!(out, "<path color=\"{}\" d=\"{data}\"/>", run[0].0.hex());
                }
                writeln!(out, "</g>")
            }
            Shape::Circle {
                at: [x, y],
                radius,
                fill,
                stroke,
            } => writeln!(
                out,
                "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"{}/>",
                number(*x, 3),
                number(*y, 3),
                number(*radius, 3),
                fill.hex(),
                stroke_attributes(&Some(*stroke))
            ),
            Shape::Image { place, png } => writeln!(
                out,
                "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" href=\"data:image/png;base64,{}\"/>",
                number(place.left, 3),
                number(place.top, 3),
                number(place.width(), 3),
                number(place.height(), 3),
                STANDARD.encode(png)
            ),
            Shape::Text { text, colour, source } => {
                let _ = writeln!(
                    out,
                    "<g fill=\"{}\" aria-label=\"{}\">",
                    colour.hex(),
                    escape(&source.replace('$', ""))
                );
                for glyph in &text.line.glyphs {
                    if font.outline(glyph.id).is_empty() {
                        continue;
                    }
                    let scale = font.scale(glyph.size);
                    let shear = if glyph.oblique { scale * Font::shear() } else { 0.0 };
                    let ([x, y], [dx, dy]) = (text.at, glyph.at);
                    let (matrix, at) = if text.upwards {
                        ([0.0, -scale, -scale, -shear], [x + dy, y - dx])
                    } else {
                        ([scale, 0.0, shear, -scale], [x + dx, y + dy])
                    };
                    let matrix: Vec<String> = matrix.iter().map(|&m| number(m, 7)).collect();
                    let _ = writeln!(
                        out,
                        "<use xlink:href=\"#{prefix}glyph{}\" transform=\"matrix({} {} {})\"/>",
                        glyph.id,
                        matrix.join(" "),
                        number(at[0], 3),
                        number(at[1], 3)
                    );
                }
                writeln!(out, "</g>")
            }
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_one_form() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0001, "0"),
            (1.25, "1.25"),
            (1.2345, "1.234"),
            (-3.0, "-3"),
            (100.0, "100"),
        ] {
            assert_eq!(number(value, 3), text);
        }
    }

    #[test]
    fn meshes_are_counted_from_corner_to_corner() {
        let (mut pen, mut data) = ([0; 2], String::new());
        // the last corner is the third but for rounding
        for cell in [
            vec![[1.0, 2.0], [1.5, 2.0], [1.5, 1.75], [1.501, 1.751]],
            vec![[1.5, 2.0], [2.0, 2.0], [2.0, 2.5]],
        ] {
            mesh_data(&cell, &mut pen, &mut data);
        }
        assert_eq!(data, "m100 200 50 0 0-25zm50 0 50 0 0 50z");
    }

    #[test]
    fn rectangles() {
        let a = Rect::new(0.0, 0.0, 2.0, 1.0);
        assert!(a.contains(&Rect::new(0.5, 0.0, 2.0, 1.0), 0.0) && !a.contains(&Rect::new(0.5, 0.0, 2.1, 1.0), 0.05));
        assert!(a.meets(&Rect::new(1.0, 0.5, 3.0, 3.0), 0.0) && !a.meets(&Rect::new(2.0, 0.0, 3.0, 1.0), 0.0));
    }
}
