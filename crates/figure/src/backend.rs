//! What plotters draws on: a page whose pixels are micrometres.
//!
//! plotters counts in whole pixels. With a micrometre for each, which is also the last decimal of the SVG,
//! nothing that it rounds is seen. It places texts by anchors; here they become outlines of the embedded
//! font, with a box for the tests of the layout. Its styles have neither dashes nor markers with a line and a
//! filling of different colours, so that lines and markers are elements of our own, which plotters places.

use crate::chart::Marker;
use crate::colour::Colour;
use crate::draw::Page;
use crate::error::Error;
use crate::layers::draw_marker;
use crate::scene::{Rect, Shape, Stroke};
use crate::text::Anchor;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::element::{Drawable, PointCollection};
use plotters::style::{RGBAColor, ShapeStyle};
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontTransform,
};
use std::iter::{Flatten, Once};
use std::slice::Iter;

/// Pixels in a millimetre.
const PIXELS: f64 = 1000.0;

/// The nearest pixel.
pub(crate) fn pixels(millimetres: f64) -> i32 {
    (millimetres * PIXELS).round() as i32
}

fn millimetres((x, y): BackendCoord) -> [f64; 2] {
    [x, y].map(|pixels| f64::from(pixels) / PIXELS)
}

/// A text's size, for plotters.
pub(crate) fn font_size(millimetres: f64) -> f64 {
    millimetres * PIXELS
}

/// A solid line of plotters.
pub(crate) fn line_style(stroke: Stroke) -> ShapeStyle {
    let Colour(r, g, b) = stroke.colour;
    ShapeStyle::from(RGBAColor(r, g, b, 1.0)).stroke_width(pixels(stroke.width).unsigned_abs())
}

/// A filling of plotters.
pub(crate) fn fill_style(Colour(r, g, b): Colour) -> ShapeStyle {
    ShapeStyle::from(RGBAColor(r, g, b, 1.0)).filled()
}

fn colour(style: BackendColor) -> Colour {
    let (r, g, b) = style.rgb;
    Colour(r, g, b)
}

/// Where the baseline lies below the upper end, the middle and the lower end of a text, relative to its size:
/// digits and capitals of the font are 0.73 high, and centred by their middle; descenders have a quarter.
const TOP: f64 = 0.76;
pub(crate) const MIDDLE: f64 = 0.36;
const BOTTOM: f64 = -0.25;

/// A page that plotters draws on, with the frame of the chart in hand.
pub(crate) struct Backend<'p> {
    pub page: &'p mut Page,
    frame: Rect,
}

impl<'p> Backend<'p> {
    pub fn new(page: &'p mut Page, frame: Rect) -> Self {
        Backend { page, frame }
    }

    fn path(&mut self, lines: Vec<Vec<BackendCoord>>, closed: bool, fill: Option<Colour>, stroke: Option<Stroke>) {
        let on_page = |line: Vec<BackendCoord>| line.into_iter().map(millimetres).collect();
        self.page.scene.shapes.push(Shape::Path {
            lines: lines.into_iter().map(on_page).collect(),
            closed,
            fill,
            stroke,
        });
    }

    /// Whether both points are corners of the frame, up to the pixel by which plotters keeps its areas apart.
    fn is_side(&self, points: &[BackendCoord]) -> bool {
        let near = |a: i32, b: f64| (a - pixels(b)).abs() <= 1;
        let Rect {
            left,
            top,
            right,
            bottom,
        } = self.frame;
        let corner = |&(x, y): &BackendCoord| (near(x, left) || near(x, right)) && (near(y, top) || near(y, bottom));
        points.len() == 2 && points.iter().all(corner)
    }
}

fn stroke_of(style: &impl BackendStyle) -> Stroke {
    Stroke::solid(colour(style.color()), f64::from(style.stroke_width()) / PIXELS)
}

type Drawn = Result<(), DrawingErrorKind<Error>>;

impl DrawingBackend for Backend<'_> {
    type ErrorType = Error;

    fn get_size(&self) -> (u32, u32) {
        let [width, height] = self.page.scene.size;
        (pixels(width).unsigned_abs(), pixels(height).unsigned_abs())
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    /// A square micrometre: nothing is drawn by pixels here.
    fn draw_pixel(&mut self, at: BackendCoord, color: BackendColor) -> Drawn {
        self.draw_rect(at, (at.0 + 1, at.1 + 1), &color, true)
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Drawn {
        self.path(vec![vec![from, to]], false, None, Some(stroke_of(style)));
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Drawn {
        let points: Vec<BackendCoord> = path.into_iter().collect();
        // plotters draws a line along each axis; the frame, one outline with joined corners, has it already,
        // and edges drawn twice look bolder
        if !self.is_side(&points) {
            self.path(vec![points], false, None, Some(stroke_of(style)));
        }
        Ok(())
    }

    fn draw_rect<S: BackendStyle>(&mut self, a: BackendCoord, b: BackendCoord, style: &S, fill: bool) -> Drawn {
        let corners = vec![a, (b.0, a.1), b, (a.0, b.1)];
        if fill {
            return self.fill_polygon(corners, style);
        }
        self.path(vec![corners], true, None, Some(stroke_of(style)));
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(&mut self, at: BackendCoord, radius: u32, style: &S, fill: bool) -> Drawn {
        let colour = colour(style.color());
        self.page.scene.shapes.push(Shape::Circle {
            at: millimetres(at),
            radius: f64::from(radius) / PIXELS,
            fill: if fill { colour } else { Colour::WHITE },
            stroke: stroke_of(style),
        });
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, corners: I, style: &S) -> Drawn {
        let fill = Some(colour(style.color()));
        self.path(vec![corners.into_iter().collect()], true, fill, None);
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, at: BackendCoord) -> Drawn {
        let size = style.size() / PIXELS;
        let anchor = match style.anchor().h_pos {
            HPos::Left => Anchor::Start,
            HPos::Center => Anchor::Middle,
            HPos::Right => Anchor::End,
        };
        let below = size
            * match style.anchor().v_pos {
                VPos::Top => TOP,
                VPos::Center => MIDDLE,
                VPos::Bottom => BOTTOM,
            };
        let [x, y] = millimetres(at);
        // charts have no other turned texts than the label of the vertical axis, which reads upwards
        let upwards = !matches!(style.transform(), FontTransform::None);
        let at = if upwards { [x + below, y] } else { [x, y + below] };
        let drawn = self.page.text(text, size, at, anchor, upwards, colour(style.color()));
        drawn.map_err(DrawingErrorKind::DrawingError)
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Error>> {
        let line = self.page.font.line(text, style.size() / PIXELS);
        let line = line.map_err(DrawingErrorKind::DrawingError)?;
        Ok([line.width, line.ascent + line.descent]
            .map(|length| pixels(length).unsigned_abs())
            .into())
    }
}

/// What plotters says when it stops: our own error, passed through.
pub(crate) fn refused(error: DrawingAreaErrorKind<Error>) -> Error {
    match error {
        DrawingAreaErrorKind::BackendError(DrawingErrorKind::DrawingError(error)) => error,
        other => Error::Chart(other.to_string()),
    }
}

/// A point in the chart's own coordinates.
pub(crate) type Point = (f64, f64);

/// Pieces of a line, with dashes.
pub(crate) struct Line {
    pub pieces: Vec<Vec<Point>>,
    pub stroke: Stroke,
}

impl<'a> PointCollection<'a, Point> for &'a Line {
    type Point = &'a Point;
    type IntoIter = Flatten<Iter<'a, Vec<Point>>>;

    fn point_iter(self) -> Self::IntoIter {
        self.pieces.iter().flatten()
    }
}

impl<'p> Drawable<Backend<'p>> for Line {
    fn draw<I: Iterator<Item = BackendCoord>>(&self, mut points: I, backend: &mut Backend<'p>, _: (u32, u32)) -> Drawn {
        let pieces = self.pieces.iter();
        let lines = pieces
            .map(|piece| points.by_ref().take(piece.len()).collect())
            .collect();
        backend.path(lines, false, None, Some(self.stroke));
        Ok(())
    }
}

/// A marker, which has a line and a filling.
pub(crate) struct Mark {
    pub at: Point,
    pub marker: Marker,
    pub radius: f64,
    pub colour: Colour,
}

impl<'a> PointCollection<'a, Point> for &'a Mark {
    type Point = &'a Point;
    type IntoIter = Once<&'a Point>;

    fn point_iter(self) -> Once<&'a Point> {
        std::iter::once(&self.at)
    }
}

impl<'p> Drawable<Backend<'p>> for Mark {
    fn draw<I: Iterator<Item = BackendCoord>>(&self, points: I, backend: &mut Backend<'p>, _: (u32, u32)) -> Drawn {
        for at in points.map(millimetres) {
            draw_marker(&mut backend.page.scene, self.marker, self.radius, self.colour, at);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use plotters::drawing::IntoDrawingArea;
    use plotters::element::{Circle, Pixel, Rectangle, Text};
    use plotters::style::FontDesc;
    use plotters_backend::{FontFamily, FontStyle};

    fn drawn(draw: impl Fn(Backend<'_>)) -> Page {
        let mut page = Page::new([50.0, 40.0]);
        draw(Backend::new(&mut page, Rect::new(10.0, 5.0, 40.0, 30.0)));
        page
    }

    #[test]
    fn elements_of_plotters_are_shapes_and_not_pixels() {
        let red = fill_style(Colour(255, 0, 0));
        let page = drawn(|backend| {
            assert_eq!(backend.get_size(), (50_000, 40_000));
            let area = backend.into_drawing_area();
            area.draw(&Circle::new((10_000, 20_000), 1500, red)).unwrap();
            area.draw(&Rectangle::new([(0, 0), (1000, 2000)], red)).unwrap();
            area.draw(&Pixel::new((7, 8), red)).unwrap();
            area.present().unwrap();
        });
        let [
            Shape::Circle { at, radius, .. },
            Shape::Path { lines, fill, .. },
            Shape::Path { .. },
        ] = &page.scene.shapes[..]
        else {
            panic!("{:?}", page.scene.shapes)
        };
        assert_eq!((*at, *radius), ([10.0, 20.0], 1.5));
        assert_eq!(lines[0], [[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0]]);
        assert_eq!(*fill, Some(Colour(255, 0, 0)));
    }

    #[test]
    fn lines_along_the_frame_are_left_out_but_no_others() {
        let style = line_style(Stroke::solid(Colour::INK, 0.2));
        let page = drawn(|mut backend| {
            // as plotters draws the axes below and to the left, a pixel outside
            backend.draw_path([(10_000, 30_001), (40_000, 30_001)], &style).unwrap();
            backend.draw_path([(9_999, 30_000), (9_999, 5_000)], &style).unwrap();
            backend.draw_path([(9_999, 30_000), (9_299, 30_000)], &style).unwrap();
            backend
                .draw_path([(10_000, 30_000), (25_000, 30_000), (40_000, 30_000)], &style)
                .unwrap();
            backend.draw_line((10_000, 30_000), (40_000, 30_000), &style).unwrap();
        });
        assert_eq!(page.scene.shapes.len(), 3);
        let Shape::Path { stroke, .. } = &page.scene.shapes[0] else {
            unreachable!()
        };
        assert_eq!(*stroke, Some(Stroke::solid(Colour::INK, 0.2)));
    }

    #[test]
    fn texts_are_measured_and_checked_by_the_embedded_font() {
        let font = || FontDesc::new(FontFamily::SansSerif, font_size(2.0), FontStyle::Normal);
        let page = drawn(|backend| {
            let wide = backend
                .estimate_text_size("mm", &plotters::style::TextStyle::from(font()))
                .unwrap();
            // advance width of DejaVu Sans: 'm' 1995 of 2048
            assert_eq!(wide.0, pixels(2.0 * 2.0 * 1995.0 / 2048.0).unsigned_abs());
            let area = backend.into_drawing_area();
            area.draw(&Text::new("x", (5000, 5000), font())).unwrap();
            let unknown = area.draw(&Text::new("\u{e000}", (5000, 5000), font()));
            assert_eq!(unknown.map_err(refused), Err(Error::Character('\u{e000}')));
        });
        assert_eq!(page.texts.len(), 1);
        let (_, place) = &page.texts[0];
        assert!(place.left == 5.0 && place.top >= 5.0 && place.top < 5.1, "{place:?}");
    }
}
