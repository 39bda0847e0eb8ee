//! PNG from the SVG: one drawing, two formats.

use crate::error::Error;
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree};

/// Accepted resolutions, in dots per inch: from thumbnails to line art in print.
const LEAST: f64 = 20.0;
const MOST: f64 = 2400.0;

/// Pixels on a white page, which the file records in dots per inch.
pub(crate) fn png(svg: &str, dpi: f64) -> Result<Vec<u8>, Error> {
    png_on(svg, dpi, Some(Color::WHITE))
}

/// The same on any ground, or on none: what is not drawn is then transparent.
pub(crate) fn png_on(svg: &str, dpi: f64, ground: Option<Color>) -> Result<Vec<u8>, Error> {
    if !(LEAST..=MOST).contains(&dpi) {
        return Err(Error::Resolution(dpi));
    }
    let failed = |error: &dyn std::fmt::Display| Error::Raster(error.to_string());
    // millimetres become pixels at this resolution
    let options = Options {
        dpi: dpi as f32,
        ..Options::default()
    };
    let tree = Tree::from_str(svg, &options).map_err(|error| failed(&error))?;
    let size = tree.size().to_int_size();
    let mut pixels =
        Pixmap::new(size.width(), size.height()).ok_or_else(|| failed(&format!("{size:?} is too large")))?;
    // the last row and column may be covered in part only
    if let Some(ground) = ground {
        pixels.fill(ground);
    }
    resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());

    let width = size.width() as usize;
    let (kind, data) = match ground {
        // the page is opaque, so that three channels hold everything
        Some(_) => {
            let colours: Vec<[u8; 3]> = pixels.data().chunks_exact(4).map(|p| [p[0], p[1], p[2]]).collect();
            (png::ColorType::Rgb, with_coarse_edges(&colours, width).concat())
        }
        None => {
            let colours = pixels.pixels().iter().map(|pixel| {
                let colour = pixel.demultiply();
                [colour.red(), colour.green(), colour.blue(), colour.alpha()]
            });
            let colours: Vec<[u8; 4]> = colours.collect();
            (png::ColorType::Rgba, with_coarse_edges(&colours, width).concat())
        }
    };
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size.width(), size.height());
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    encoder.set_color(kind);
    // equal rows of flat colours are found as they are; differences of neighbours hide them
    encoder.set_filter(png::Filter::NoFilter);
    let per_metre = (dpi / 0.0254).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header().map_err(|error| failed(&error))?;
    writer.write_image_data(&data).map_err(|error| failed(&error))?;
    writer.finish().map_err(|error| failed(&error))?;
    Ok(bytes)
}

/// The picture with fewer shades where nothing is flat. A pixel unlike its four neighbours lies on an edge,
/// whose smoothing is good enough in steps of eight; all others, so whatever a colour bar or a legend
/// explains, are left as they are. So pictures of many lines stay small.
fn with_coarse_edges<const CHANNELS: usize>(colours: &[[u8; CHANNELS]], width: usize) -> Vec<[u8; CHANNELS]> {
    let coarse = |channel: u8| (u16::from(channel) + 4) / 8 * 8;
    let at = |index: usize| {
        let (colour, column) = (colours[index], index % width);
        let flat = column > 0 && colours[index - 1] == colour
            || column + 1 < width && colours[index + 1] == colour
            || index >= width && colours[index - width] == colour
            || colours.get(index + width) == Some(&colour);
        match flat {
            true => colour,
            false => colour.map(|channel| coarse(channel).min(255) as u8),
        }
    };
    (0..colours.len()).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_edges_are_coarse() {
        let (a, b, edge) = ([10, 20, 30], [200, 210, 255], [101, 103, 254]);
        let picture = [a, a, edge, b, b, a, a, [77, 1, 252], b, b];
        let expected = [a, a, [104, 104, 255], b, b, a, a, [80, 0, 255], b, b];
        assert_eq!(with_coarse_edges(&picture, 5), expected);
    }
}
