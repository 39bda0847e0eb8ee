//! Pictures of pixels: PNG, and text on them.

use crate::colour::Colour;
use crate::error::Error;
use crate::text::Font;
use resvg::tiny_skia::{FillRule, Paint, PathBuilder, PixmapMut, Transform};
use ttf_parser::OutlineBuilder;

/// A picture, three bytes a pixel, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixels {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Red, green and blue of each pixel.
    pub rgb: Vec<u8>,
}

impl Pixels {
    /// A picture of one colour.
    pub fn new(width: usize, height: usize, colour: Colour) -> Self {
        let Colour(r, g, b) = colour;
        Pixels {
            width,
            height,
            rgb: [r, g, b].repeat(width * height),
        }
    }

    /// Puts another picture into this one, its upper left corner at `(x, y)`; what lies outside is left out.
    pub fn put(&mut self, other: &Pixels, x: usize, y: usize) {
        let columns = other.width.min(self.width.saturating_sub(x));
        for row in 0..other.height.min(self.height.saturating_sub(y)) {
            let from = 3 * row * other.width;
            let to = 3 * ((y + row) * self.width + x);
            self.rgb[to..to + 3 * columns].copy_from_slice(&other.rgb[from..from + 3 * columns]);
        }
    }

    /// Writes a line of text, the left end of its baseline at `(x, y)`, `size` pixels high from baseline to
    /// baseline. Symbols stand between dollar signs, as in [figures](crate::Figure).
    ///
    /// # Errors
    /// [`Error::Character`] for what the embedded font lacks, [`Error::Raster`] for a picture without pixels.
    pub fn text(&mut self, text: &str, x: f64, y: f64, size: f64, colour: Colour) -> Result<(), Error> {
        let font = Font::new();
        let line = font.line(text, size)?;
        let mut path = Outline(PathBuilder::new(), [0.0; 4]);
        for glyph in &line.glyphs {
            let scale = font.scale(glyph.size);
            path.1 = [
                x + glyph.at[0],
                y + glyph.at[1],
                scale,
                if glyph.oblique { Font::shear() } else { 0.0 },
            ];
            font.draw(glyph.id, &mut path);
        }
        let Some(path) = path.0.finish() else {
            return Ok(());
        };
        let mut rgba: Vec<u8> = self.rgb.chunks_exact(3).flat_map(|p| [p[0], p[1], p[2], 255]).collect();
        let mut pixels = PixmapMut::from_bytes(&mut rgba, self.width as u32, self.height as u32)
            .ok_or_else(|| Error::Raster("a picture without pixels".to_owned()))?;
        let mut paint = Paint::default();
        paint.set_color_rgba8(colour.0, colour.1, colour.2, 255);
        pixels.fill_path(&path, &paint, FillRule::Winding, Transform::identity(), None);
        for (pixel, painted) in self.rgb.chunks_exact_mut(3).zip(rgba.chunks_exact(4)) {
            pixel.copy_from_slice(&painted[..3]);
        }
        Ok(())
    }

    /// The picture as PNG.
    ///
    /// # Errors
    /// [`Error::Raster`] for a picture without pixels.
    pub fn png(&self) -> Result<Vec<u8>, Error> {
        let failed = |error: png::EncodingError| Error::Raster(error.to_string());
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header().map_err(failed)?;
        writer.write_image_data(&self.rgb).map_err(failed)?;
        writer.finish().map_err(failed)?;
        Ok(bytes)
    }
}

/// An outline in pixels: origin x, y, scale and slant of the present glyph.
struct Outline(PathBuilder, [f64; 4]);

impl Outline {
    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        let [x0, y0, scale, shear] = self.1;
        let (x, y) = (f64::from(x) * scale, f64::from(y) * scale);
        ((x0 + x + shear * y) as f32, (y0 - y) as f32)
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.0.move_to(x, y);
    }
    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.0.line_to(x, y);
    }
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.at(x1, y1), self.at(x, y));
        self.0.quad_to(x1, y1, x, y);
    }
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) = (self.at(x1, y1), self.at(x2, y2), self.at(x, y));
        self.0.cubic_to(x1, y1, x2, y2, x, y);
    }
    fn close(&mut self) {
        self.0.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_darkens_pixels_inside_the_picture_only() {
        let mut pixels = Pixels::new(80, 30, Colour(255, 255, 255));
        pixels
            .text("$λ$ = 1, far too long for it", 4.0, 20.0, 14.0, Colour(0, 0, 0))
            .unwrap();
        let dark = pixels.rgb.chunks_exact(3).filter(|p| p[0] < 100).count();
        assert!((60..900).contains(&dark), "{dark}");
        assert!(pixels.png().unwrap().starts_with(b"\x89PNG"));
        let mut page = Pixels::new(10, 10, Colour(0, 0, 0));
        page.put(&pixels, 5, 8);
        assert_eq!(page.rgb.iter().filter(|&&byte| byte == 255).count(), 3 * 5 * 2);
    }
}
