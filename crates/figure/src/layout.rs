//! Where things are on the page, for tests: what overlaps, leaves the page, or is explained by nothing.

use crate::scene::Rect;

/// Where things are. Millimetres from the upper left corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// The page.
    pub canvas: Rect,
    /// Every text (its markup) with its box.
    pub texts: Vec<(String, Rect)>,
    /// Where data are drawn.
    pub plots: Vec<Rect>,
    /// Legends and colour bars.
    pub legends: Vec<Rect>,
    /// What the legends list.
    pub entries: Vec<String>,
    /// The labels of the layers of which something is on the page.
    pub drawn: Vec<String>,
}

/// Boxes of texts are those of capitals; a fraction of a millimetre of overlap is not seen.
const TOUCH: f64 = 0.15;

impl Layout {
    /// What is wrong with the layout: texts beyond the page or over each other, legends over data, legends
    /// that list what is not drawn or lack what is. Empty if nothing is.
    pub fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        for (index, (text, rect)) in self.texts.iter().enumerate() {
            if !self.canvas.contains(rect, 0.0) {
                faults.push(format!("text {text:?} leaves the page: {rect:?}"));
            }
            for (other, place) in &self.texts[..index] {
                if rect.meets(place, TOUCH) {
                    faults.push(format!("texts {other:?} and {text:?} overlap: {place:?}, {rect:?}"));
                }
            }
        }
        for legend in &self.legends {
            if !self.canvas.contains(legend, 0.0) {
                faults.push(format!("a legend leaves the page: {legend:?}"));
            }
            faults.extend(
                self.plots
                    .iter()
                    .filter(|plot| plot.meets(legend, 0.0))
                    .map(|plot| format!("a legend covers data: {legend:?}, {plot:?}")),
            );
        }
        let without = |these: &[String], those: &[String]| -> Vec<String> {
            these.iter().filter(|label| !those.contains(label)).cloned().collect()
        };
        let (idle, bare) = (without(&self.entries, &self.drawn), without(&self.drawn, &self.entries));
        faults.extend(
            idle.iter()
                .map(|label| format!("the legend lists {label:?}, which is not drawn")),
        );
        faults.extend(
            bare.iter()
                .map(|label| format!("{label:?} is drawn, and no legend lists it")),
        );
        faults
    }
}
