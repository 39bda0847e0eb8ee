//! Colours: one set for lines, and scales for values.
//!
//! Lines take the colours of Okabe and Ito (Color Universal Design, 2008), which readers with any common
//! colour blindness tell apart, in an order in which neighbours also differ in grey; dashes and markers
//! repeat the distinction. Values take *viridis* or *cividis*, whose lightness rises evenly, or a diverging
//! scale, neutral in the middle, whose two ends differ in lightness: dark blue is below the middle, mid-grey
//! orange above it, also on a grey print.

use crate::error::Error;

/// A colour of the screen (sRGB, eight bits a channel).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Colour(pub u8, pub u8, pub u8);

impl Colour {
    /// Text, frames and ticks.
    pub const INK: Colour = Colour(0x22, 0x22, 0x22);
    /// Secondary lines: featured values, leaders.
    pub const GREY: Colour = Colour(0x77, 0x77, 0x77);
    /// Grid lines.
    pub const PALE: Colour = Colour(0xdd, 0xdd, 0xdd);
    /// The page.
    pub const WHITE: Colour = Colour(0xff, 0xff, 0xff);
    /// Shading of an interval that is recommended.
    pub const SHADE: Colour = Colour(0xe3, 0xf1, 0xe8);

    /// After Okabe and Ito, blue and purple darkened and yellow turned to ochre, so that neighbours differ in
    /// grey and none is too light for a line: blue, vermillion, purple, green, sky blue, ochre.
    pub const LINES: [Colour; 6] = [
        Colour(0x00, 0x5b, 0x96),
        Colour(0xd5, 0x5e, 0x00),
        Colour(0xa0, 0x3f, 0x80),
        Colour(0x00, 0x9e, 0x73),
        Colour(0x56, 0xb4, 0xe9),
        Colour(0xb8, 0x86, 0x00),
    ];

    /// The colour of the line number `index`, over and over.
    pub fn line(index: usize) -> Colour {
        Self::LINES[index % Self::LINES.len()]
    }

    /// On the way to another colour: 0 is this one, 1 the other.
    pub fn mix(self, other: Colour, t: f64) -> Colour {
        let channel = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * t.clamp(0.0, 1.0)).round() as u8;
        Colour(
            channel(self.0, other.0),
            channel(self.1, other.1),
            channel(self.2, other.2),
        )
    }

    /// How light it is on a grey print, 0 to 1 (relative luminance of sRGB, gamma 2.2).
    pub fn grey(self) -> f64 {
        let linear = |c: u8| (f64::from(c) / 255.0).powf(2.2);
        (0.2126 * linear(self.0) + 0.7152 * linear(self.1) + 0.0722 * linear(self.2)).powf(1.0 / 2.2)
    }

    /// As style sheets and SVG write it: `#rrggbb`, in lower case.
    pub fn hex(self) -> String {
        format!("#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }
}

/// How values between 0 and 1 are coloured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ColourMap {
    /// Dark violet over green to yellow.
    #[default]
    Viridis,
    /// Dark blue over grey to yellow; the same to all readers.
    Cividis,
    /// Dark blue over near white to orange, for signed values.
    Diverging,
}

/// Equidistant anchors, interpolated linearly in sRGB.
const VIRIDIS: [u32; 9] = [
    0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c, 0x28ae80, 0x5ec962, 0xaddc30, 0xfde725,
];
const CIVIDIS: [u32; 10] = [
    0x00204d, 0x00336f, 0x39486b, 0x575c6d, 0x707173, 0x8a8779, 0xa69d75, 0xc4b56c, 0xe4cf5b, 0xffea46,
];
const DIVERGING: [u32; 9] = [
    0x08224f, 0x1c4f8c, 0x4b86bd, 0xa6c8e0, 0xf4f4f2, 0xfbd9b0, 0xf6b26b, 0xe8862d, 0xcc5a00,
];

impl ColourMap {
    fn anchors(self) -> &'static [u32] {
        match self {
            ColourMap::Viridis => &VIRIDIS,
            ColourMap::Cividis => &CIVIDIS,
            ColourMap::Diverging => &DIVERGING,
        }
    }

    /// The colour of `t` in `[0, 1]`; what lies outside has the colour of the nearer end.
    pub fn at(self, t: f64) -> Colour {
        let anchors = self.anchors();
        let scaled = t.clamp(0.0, 1.0) * (anchors.len() - 1) as f64;
        let below = (scaled.floor() as usize).min(anchors.len() - 2);
        let [a, b] = [anchors[below], anchors[below + 1]].map(|c| Colour((c >> 16) as u8, (c >> 8) as u8, c as u8));
        a.mix(b, scaled - below as f64)
    }
}

/// What colours mean: a map over a range of values, which is explained by a colour bar.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourScale {
    /// The colours.
    pub map: ColourMap,
    /// The values of the first and the last colour.
    pub range: (f64, f64),
    /// What the values are, beside the bar.
    pub label: String,
}

/// Steps of the colours of cells: neighbours among them cannot be told apart, and fewer give smaller files.
const STEPS: f64 = 127.0;

impl ColourScale {
    /// A scale; the range is checked when the figure is drawn.
    pub fn new(map: ColourMap, range: (f64, f64), label: impl Into<String>) -> Self {
        ColourScale {
            map,
            range,
            label: label.into(),
        }
    }

    /// A scale for signed values: diverging, with zero in the neutral middle.
    pub fn signed(largest: f64, label: impl Into<String>) -> Self {
        Self::new(ColourMap::Diverging, (-largest, largest), label)
    }

    /// The colour of a value; values outside the range have the colour of the nearer end, and NaN is grey.
    pub fn colour(&self, value: f64) -> Colour {
        if value.is_nan() {
            return Colour(0xbb, 0xbb, 0xbb);
        }
        let t = (value - self.range.0) / (self.range.1 - self.range.0);
        self.map.at((t.clamp(0.0, 1.0) * STEPS).round() / STEPS)
    }

    /// Whether values lie below or above the range.
    pub(crate) fn beyond(&self, values: impl IntoIterator<Item = f64>) -> [bool; 2] {
        // a colour's width of rounding is not beyond
        let slack = 1e-9 * (self.range.1 - self.range.0);
        values.into_iter().fold([false; 2], |[below, above], value| {
            [
                below || value < self.range.0 - slack,
                above || value > self.range.1 + slack,
            ]
        })
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        let (low, high) = self.range;
        if low.is_finite() && high.is_finite() && low < high {
            return Ok(());
        }
        Err(Error::Range {
            what: format!("the colour scale {:?}", self.label),
            low,
            high,
            log: false,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sequential_maps_grow_lighter_throughout() {
        for map in [ColourMap::Viridis, ColourMap::Cividis] {
            let greys: Vec<f64> = (0..=64).map(|k| map.at(f64::from(k) / 64.0).grey()).collect();
            assert!(
                greys.windows(2).all(|pair| pair[1] > pair[0] - 1e-3),
                "{map:?}: {greys:?}"
            );
            assert!(greys[64] - greys[0] > 0.6);
        }
    }

    #[test]
    fn the_ends_of_the_diverging_map_differ_in_grey_and_its_middle_is_neutral() {
        let map = ColourMap::Diverging;
        let Colour(r, g, b) = map.at(0.5);
        assert!(r.abs_diff(g) < 4 && g.abs_diff(b) < 4);
        assert!(map.at(1.0).grey() - map.at(0.0).grey() > 0.25);
        assert!(map.at(0.5).grey() > map.at(1.0).grey() + 0.3);
    }

    #[test]
    fn neighbouring_lines_differ_in_grey() {
        for pair in Colour::LINES.windows(2) {
            assert!((pair[0].grey() - pair[1].grey()).abs() > 0.08, "{pair:?}");
        }
    }

    #[test]
    fn values_outside_take_the_nearer_end_and_nan_is_seen() {
        let scale = ColourScale::signed(2.0, "K");
        assert_eq!(scale.colour(-9.0), ColourMap::Diverging.at(0.0));
        assert_eq!(scale.colour(9.0), ColourMap::Diverging.at(1.0));
        assert!(scale.colour(f64::NAN) != scale.colour(0.0));
        assert!(ColourScale::new(ColourMap::Viridis, (1.0, 1.0), "").check().is_err());
        assert!(
            ColourScale::new(ColourMap::Viridis, (0.0, f64::NAN), "")
                .check()
                .is_err()
        );
    }
}
