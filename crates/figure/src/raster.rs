//! PNG from the SVG: one drawing, two formats.

use crate::error::Error;
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree};

/// Accepted resolutions, in dots per inch: from thumbnails to line art in print.
const LEAST: f64 = 20.0;
const MOST: f64 = 2400.0;

pub(crate) fn png(svg: &str, dpi: f64) -> Result<Vec<u8>, Error> {
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
    pixels.fill(Color::WHITE);
    resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());

    // the page is opaque, so that three channels hold everything
    let rgb: Vec<u8> = pixels.data().chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size.width(), size.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let per_metre = (dpi / 0.0254).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header().map_err(|error| failed(&error))?;
    writer.write_image_data(&rgb).map_err(|error| failed(&error))?;
    writer.finish().map_err(|error| failed(&error))?;
    Ok(bytes)
}
