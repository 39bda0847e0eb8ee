//! PDF from the SVG: one drawing, three formats.
//!
//! One page of the printed size. Texts are outlines as in the SVG, colours are opaque, so that the page is
//! one stream of paths. There is no date and no identifier in the file: equal figures give equal bytes.

use crate::error::Error;
use pdf_writer::{Content, Filter, Finish, Pdf, Rect, Ref, TextStr};
use resvg::tiny_skia::{PathSegment, Point};
use resvg::usvg::{FillRule, Group, LineCap, LineJoin, Node, Options, Paint, Path, Transform, Tree};

/// A PDF's unit in parts of an inch.
const POINTS: f32 = 72.0;

/// How strongly the stream is packed, of ten levels.
const PACKED: u8 = 9;

pub(crate) fn pdf(svg: &str, title: &str) -> Result<Vec<u8>, Error> {
    let options = Options {
        dpi: POINTS,
        ..Options::default()
    };
    let tree = Tree::from_str(svg, &options).map_err(|error| Error::Raster(error.to_string()))?;
    let (width, height) = (tree.size().width(), tree.size().height());
    let mut content = Content::new();
    // pages have their y upwards
    let page = Transform::from_row(1.0, 0.0, 0.0, -1.0, 0.0, height);
    group(tree.root(), page.pre_concat(tree.root().transform()), &mut content)?;
    let stream = miniz_oxide::deflate::compress_to_vec_zlib(&content.finish(), PACKED);

    let [catalog, pages, page, drawn, information] = [1, 2, 3, 4, 5].map(Ref::new);
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([page]).count(1);
    let mut leaf = pdf.page(page);
    leaf.parent(pages)
        .media_box(Rect::new(0.0, 0.0, width, height))
        .contents(drawn);
    leaf.resources();
    leaf.finish();
    pdf.stream(drawn, &stream).filter(Filter::FlateDecode);
    pdf.document_info(information).title(TextStr(title));
    Ok(pdf.finish())
}

/// Draws what is in a group, given the way from there to the page.
fn group(group: &Group, page: Transform, content: &mut Content) -> Result<(), Error> {
    for node in group.children() {
        match node {
            Node::Group(inner) => self::group(inner, page.pre_concat(inner.transform()), content)?,
            Node::Path(path) => draw(path, page, content)?,
            // scenes hold neither
            Node::Image(_) | Node::Text(_) => return Err(Error::Raster("it is not made of paths".to_owned())),
        }
    }
    Ok(())
}

fn draw(path: &Path, page: Transform, content: &mut Content) -> Result<(), Error> {
    if !path.is_visible() || path.fill().is_none() && path.stroke().is_none() {
        return Ok(());
    }
    let Transform { sx, ky, kx, sy, tx, ty } = page;
    content.save_state().transform([sx, ky, kx, sy, tx, ty]);
    if let Some(fill) = path.fill() {
        let [r, g, b] = colour(fill.paint())?;
        content.set_fill_rgb(r, g, b);
    }
    if let Some(stroke) = path.stroke() {
        let [r, g, b] = colour(stroke.paint())?;
        content.set_stroke_rgb(r, g, b).set_line_width(stroke.width().get());
        content.set_line_join(match stroke.linejoin() {
            LineJoin::Miter | LineJoin::MiterClip => pdf_writer::types::LineJoinStyle::MiterJoin,
            LineJoin::Round => pdf_writer::types::LineJoinStyle::RoundJoin,
            LineJoin::Bevel => pdf_writer::types::LineJoinStyle::BevelJoin,
        });
        content.set_line_cap(match stroke.linecap() {
            LineCap::Butt => pdf_writer::types::LineCapStyle::ButtCap,
            LineCap::Round => pdf_writer::types::LineCapStyle::RoundCap,
            LineCap::Square => pdf_writer::types::LineCapStyle::ProjectingSquareCap,
        });
        if let Some(dashes) = stroke.dasharray() {
            content.set_dash_pattern(dashes.iter().copied(), stroke.dashoffset());
        }
    }
    let mut at = Point::zero();
    for segment in path.data().segments() {
        match segment {
            PathSegment::MoveTo(p) => drop(content.move_to(p.x, p.y)),
            PathSegment::LineTo(p) => drop(content.line_to(p.x, p.y)),
            // the same parabola as a cubic
            PathSegment::QuadTo(c, p) => {
                let third = |end: Point| (end.x + 2.0 / 3.0 * (c.x - end.x), end.y + 2.0 / 3.0 * (c.y - end.y));
                let (first, second) = (third(at), third(p));
                content.cubic_to(first.0, first.1, second.0, second.1, p.x, p.y);
            }
            PathSegment::CubicTo(a, b, p) => drop(content.cubic_to(a.x, a.y, b.x, b.y, p.x, p.y)),
            PathSegment::Close => drop(content.close_path()),
        }
        if let PathSegment::MoveTo(p)
        | PathSegment::LineTo(p)
        | PathSegment::QuadTo(_, p)
        | PathSegment::CubicTo(_, _, p) = segment
        {
            at = p;
        }
    }
    let even_odd = path.fill().is_some_and(|fill| fill.rule() == FillRule::EvenOdd);
    match (path.fill().is_some(), path.stroke().is_some()) {
        (true, true) if even_odd => content.fill_even_odd_and_stroke(),
        (true, true) => content.fill_nonzero_and_stroke(),
        (true, false) if even_odd => content.fill_even_odd(),
        (true, false) => content.fill_nonzero(),
        (false, _) => content.stroke(),
    };
    content.restore_state();
    Ok(())
}

fn colour(paint: &Paint) -> Result<[f32; 3], Error> {
    match paint {
        Paint::Color(colour) => Ok([colour.red, colour.green, colour.blue].map(|channel| f32::from(channel) / 255.0)),
        _ => Err(Error::Raster("it has other paints than colours".to_owned())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the page says, read back by hand.
    #[test]
    fn a_page_of_the_printed_size_without_a_date() {
        let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"25.4mm\" height=\"50.8mm\" viewBox=\"0 0 25.4 50.8\">\
                   <defs><path id=\"a\" d=\"m0 0l12.7 0q0 6.35 6.35 6.35z\"/></defs>\
                   <g fill=\"#ff0000\" transform=\"translate(0 12.7)\"><use href=\"#a\" transform=\"scale(0.5)\"/></g>\
                   <path d=\"m0 0l25.4 0\" fill=\"none\" stroke=\"#000000\" stroke-width=\"0.254\" stroke-dasharray=\"2 1\"/></svg>";
        let bytes = pdf(svg, "λ (a)").unwrap();
        assert_eq!(bytes, pdf(svg, "λ (a)").unwrap());
        let text = String::from_utf8_lossy(&bytes);
        assert!(text.starts_with("%PDF-1.7") && text.trim_end().ends_with("%%EOF"));
        assert!(
            text.contains("/MediaBox [0 0 72 144]") && text.contains("/Count 1"),
            "{text}"
        );
        assert!(
            !text.contains("Date") && !text.contains("/ID") && !text.contains("/Font"),
            "{text}"
        );
        let find = |what: &[u8]| bytes.windows(what.len()).position(|window| window == what).unwrap();
        let stream = &bytes[find(b"stream\n") + 7..find(b"\nendstream")];
        let drawn = miniz_oxide::inflate::decompress_to_vec_zlib(stream).unwrap();
        let drawn = String::from_utf8(drawn).unwrap();
        // a quarter down is 108 from below; paths are in units of a drawing that is half as large
        let lines: Vec<&str> = drawn.lines().collect();
        let matrix: Vec<f64> = lines[1]
            .split(' ')
            .take(6)
            .map(|number| number.parse().unwrap())
            .collect();
        let near = |a: f64, b: f64| (a - b).abs() < 1e-3;
        let scale = 72.0 / 25.4;
        assert!(
            near(matrix[0], scale / 2.0) && near(matrix[3], -scale / 2.0) && near(matrix[5], 108.0),
            "{drawn}"
        );
        assert!(
            drawn.contains("1 0 0 rg") && drawn.contains("12.7 0 l") && drawn.contains(" c\nh\nf\n"),
            "{drawn}"
        );
        assert!(
            drawn.contains("[2 1] 0 d") && drawn.contains("0.254 w") && drawn.contains("25.4 0 l\nS\n"),
            "{drawn}"
        );
        // a quadratic from (12.7, 0) over (12.7, 6.35) to (19.05, 6.35), raised
        let cubic = drawn.lines().find(|line| line.ends_with(" c")).unwrap();
        let cubic: Vec<f64> = cubic.split(' ').take(6).map(|number| number.parse().unwrap()).collect();
        let expected = [12.7, 6.35 * 2.0 / 3.0, 12.7 + 6.35 / 3.0, 6.35, 19.05, 6.35];
        assert!(cubic.iter().zip(expected).all(|(&a, b)| near(a, b)), "{cubic:?}");
    }

    #[test]
    fn other_drawings_are_refused() {
        let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\"><defs><linearGradient id=\"g\">\
                   <stop offset=\"0\" stop-color=\"red\"/><stop offset=\"1\"/></linearGradient></defs>\
                   <rect width=\"9\" height=\"9\" fill=\"url(#g)\"/></svg>";
        assert!(matches!(pdf(svg, ""), Err(Error::Raster(_))));
    }
}
