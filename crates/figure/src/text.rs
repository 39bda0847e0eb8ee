//! Text as outlines of an embedded font.
//!
//! A figure must look the same everywhere, so its characters are drawn as the outlines of DejaVu Sans and
//! need no font of the reader's. Symbols are written between dollar signs, as in LaTeX: letters become
//! oblique, `_` and `^` (with braces for more than one character) lower and raise, and a sub- and a
//! superscript of one symbol stand above each other: `$λ_C^*$`, `$10^{-3}$`. The oblique letters are the
//! upright ones, sheared by the angle of DejaVu Sans Oblique.
//!
//! All lengths are millimetres, y points down, and the origin of a text is the left end of its baseline.

use crate::error::Error;
use crate::scene::Rect;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

static FONT: &[u8] = include_bytes!("../assets/DejaVuSans.ttf");

/// Millimetres in a printer's point.
pub const POINT: f64 = 25.4 / 72.0;

/// Tangent of the oblique's angle, 11 degrees.
const SHEAR: f64 = 0.194;
/// Size of sub- and superscripts relative to the text.
const SCRIPT: f64 = 0.72;
/// Their shifts, relative to the text's size: a subscript's capital and the superscript above it do not
/// touch.
const LOWER: f64 = 0.22;
const RAISE: f64 = 0.42;
/// Height of capitals and depth of descenders, relative to the size; from the font.
const CAPITAL: f64 = 0.73;
const DESCENT: f64 = 0.21;

/// A character's place, relative to the text's origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Glyph {
    pub id: u16,
    pub at: [f64; 2],
    pub size: f64,
    pub oblique: bool,
}

/// A measured line of text.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Line {
    pub glyphs: Vec<Glyph>,
    pub width: f64,
    /// From the baseline up, counted positive.
    pub ascent: f64,
    /// From the baseline down.
    pub descent: f64,
}

#[derive(Clone, Copy, PartialEq)]
enum Level {
    Base,
    Sub,
    Sup,
}

/// The embedded font.
pub(crate) struct Font {
    face: Face<'static>,
    em: f64,
}

impl Font {
    pub fn new() -> Self {
        let face = Face::parse(FONT, 0).expect("the embedded font is valid: every test draws with it");
        let em = f64::from(face.units_per_em());
        Font { face, em }
    }

    /// Measures a text of the given size (millimetres).
    pub fn line(&self, text: &str, size: f64) -> Result<Line, Error> {
        let mut line = Line {
            glyphs: Vec::new(),
            width: 0.0,
            ascent: CAPITAL * size,
            descent: 0.0,
        };
        // where the next sub- and superscript begin, and where the text goes on
        let mut pens = [0.0; 3];
        for (character, level, oblique) in characters(text) {
            let id = self.face.glyph_index(character).ok_or(Error::Character(character))?;
            let (scale, shift) = match level {
                Level::Base => (size, 0.0),
                Level::Sub => (SCRIPT * size, LOWER * size),
                Level::Sup => (SCRIPT * size, -RAISE * size),
            };
            let pen = &mut pens[level as usize];
            line.glyphs.push(Glyph {
                id: id.0,
                at: [*pen, shift],
                size: scale,
                oblique,
            });
            *pen += self.advance(id) * scale;
            if level == Level::Base {
                pens = [pens[0]; 3];
            } else {
                pens[0] = pens[1].max(pens[2]);
            }
            line.ascent = line.ascent.max(CAPITAL * scale - shift);
            let deep = matches!(
                character,
                'g' | 'j' | 'p' | 'q' | 'y' | 'μ' | 'φ' | 'β' | 'ρ' | 'f' | '(' | ')' | ','
            );
            line.descent = line.descent.max(if deep { DESCENT * scale } else { 0.0 } + shift);
        }
        line.width = pens[0];
        Ok(line)
    }

    fn advance(&self, id: GlyphId) -> f64 {
        f64::from(self.face.glyph_hor_advance(id).unwrap_or(0)) / self.em
    }

    /// The outline as SVG path data in the font's units, y up.
    pub fn outline(&self, id: u16) -> String {
        let mut path = PathData(String::new());
        self.face.outline_glyph(GlyphId(id), &mut path);
        path.0
    }

    /// Hands the outline, in the font's units and y up, to a builder.
    pub fn draw(&self, id: u16, builder: &mut dyn OutlineBuilder) {
        self.face.outline_glyph(GlyphId(id), builder);
    }

    /// Scale from the font's units to a size.
    pub fn scale(&self, size: f64) -> f64 {
        size / self.em
    }

    pub fn shear() -> f64 {
        SHEAR
    }
}

/// Splits markup into characters with their level and slant.
fn characters(text: &str) -> Vec<(char, Level, bool)> {
    let mut found = Vec::new();
    let (mut math, mut level, mut braces) = (false, Level::Base, false);
    for character in text.chars() {
        match character {
            '$' => (math, level, braces) = (!math, Level::Base, false),
            '_' if math => level = Level::Sub,
            '^' if math => level = Level::Sup,
            '{' if math => braces = true,
            '}' if math => (level, braces) = (Level::Base, false),
            _ => {
                let shown = match character {
                    '-' if math => '−',
                    '*' if math => '∗',
                    other => other,
                };
                found.push((shown, level, math && shown.is_alphabetic()));
                if !braces {
                    level = Level::Base;
                }
            }
        }
    }
    found
}

struct PathData(String);

impl PathData {
    fn put(&mut self, command: char, numbers: &[f32]) {
        self.0.push(command);
        for (index, number) in numbers.iter().enumerate() {
            if index > 0 {
                self.0.push(' ');
            }
            self.0.push_str(&crate::scene::number(f64::from(*number), 1));
        }
    }
}

impl OutlineBuilder for PathData {
    fn move_to(&mut self, x: f32, y: f32) {
        self.put('M', &[x, y]);
    }
    fn line_to(&mut self, x: f32, y: f32) {
        self.put('L', &[x, y]);
    }
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.put('Q', &[x1, y1, x, y]);
    }
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.put('C', &[x1, y1, x2, y2, x, y]);
    }
    fn close(&mut self) {
        self.0.push('Z');
    }
}

/// Where a text's reference point lies, horizontally in reading direction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Anchor {
    /// At its left end.
    #[default]
    Start,
    /// In the middle.
    Middle,
    /// At its right end.
    End,
}

/// A measured line at its place on the page.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Placed {
    pub line: Line,
    /// The origin of the baseline.
    pub at: [f64; 2],
    /// Whether it reads upwards.
    pub upwards: bool,
}

impl Placed {
    pub fn new(line: Line, reference: [f64; 2], anchor: Anchor, upwards: bool) -> Self {
        let back = line.width
            * match anchor {
                Anchor::Start => 0.0,
                Anchor::Middle => 0.5,
                Anchor::End => 1.0,
            };
        let [x, y] = reference;
        let at = if upwards { [x, y + back] } else { [x - back, y] };
        Placed { line, at, upwards }
    }

    pub fn bounds(&self) -> Rect {
        let [x, y] = self.at;
        let (width, up, down) = (self.line.width, self.line.ascent, self.line.descent);
        if self.upwards {
            Rect::new(x - up, y - width, x + down, y)
        } else {
            Rect::new(x, y - up, x + width, y + down)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sub_and_superscript_of_one_symbol_stand_above_each_other() {
        let font = Font::new();
        let line = font.line("$λ_C^*$x", 3.0).unwrap();
        assert_eq!(line.glyphs.len(), 4);
        let [base, sub, sup, next] = [0, 1, 2, 3].map(|i| line.glyphs[i]);
        assert_eq!(sub.at[0], sup.at[0]);
        assert!(sub.at[1] > 0.0 && sup.at[1] < 0.0 && sub.size < base.size);
        assert!(next.at[0] > sub.at[0] && !next.oblique && base.oblique);
        let braces = font.line("$10^{-3}$", 3.0).unwrap();
        assert_eq!(braces.glyphs.iter().filter(|g| g.at[1] < 0.0).count(), 2);
    }

    #[test]
    fn widths_follow_the_font() {
        let font = Font::new();
        let width = |text| font.line(text, 1.0).unwrap().width;
        // advance widths of DejaVu Sans: 'i' 569, 'm' 1995, of 2048
        assert!((width("i") - 569.0 / 2048.0).abs() < 1e-12);
        assert!((width("mi") - (569.0 + 1995.0) / 2048.0).abs() < 1e-12);
        assert_eq!(font.line("\u{e123}", 1.0), Err(Error::Character('\u{e123}')));
    }

    #[test]
    fn bounds_of_turned_text() {
        let line = Font::new().line("axis", 2.0).unwrap();
        let flat = Placed::new(line.clone(), [10.0, 10.0], Anchor::Middle, false).bounds();
        let turned = Placed::new(line, [10.0, 10.0], Anchor::Middle, true).bounds();
        assert!((flat.width() - turned.height()).abs() < 1e-12);
        assert!(((turned.top + turned.bottom) / 2.0 - 10.0).abs() < 1e-12);
    }
}
