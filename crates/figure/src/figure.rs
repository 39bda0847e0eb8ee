//! A figure: panels on a grid, with what they share, at printed size.
//!
//! The width of the figure is that of the printed column, so that text has its nominal size on paper. Panels
//! of a row or column have aligned frames: each gets the largest margins that any of them needs.

use crate::colour::{Colour, ColourScale};
use crate::draw::{self, Margins, Page, SMALL, TITLE};
use crate::error::Error;
use crate::layout::Layout;
use crate::legend::{Legend, Side, bar_width, draw_bar};
use crate::panel::{Content, Panel, Width};
use crate::scene::Rect;
use crate::text::Anchor;
use std::ops::RangeInclusive;

/// Where a panel stands on the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    row: usize,
    column: usize,
    /// Columns that it takes.
    span: usize,
}

impl Place {
    fn last(self) -> usize {
        self.column + self.span - 1
    }
}

/// Panels on a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    size: [f64; 2],
    description: String,
    heading: String,
    panels: Vec<(Place, Panel)>,
    rows: Vec<f64>,
    columns: Vec<f64>,
    bar: Option<ColourScale>,
    legend: Option<Side>,
}

/// Blank border of the page, and distances between panels, legends and titles.
const BORDER: f64 = 1.0;
const BETWEEN: f64 = 3.0;
const NEAR: f64 = 1.2;
/// Smallest frame.
const LEAST: f64 = 8.0;
/// Largest page: ten metres, which plotters' whole micrometres hold two hundred times.
const MOST: f64 = 1e4;

impl Figure {
    /// An empty figure; the description is its accessible title.
    pub fn new(width: Width, height: f64, description: impl Into<String>) -> Self {
        Figure {
            size: [width.millimetres(), height],
            description: description.into(),
            heading: String::new(),
            panels: Vec::new(),
            rows: Vec::new(),
            columns: Vec::new(),
            bar: None,
            legend: None,
        }
    }

    /// Puts a panel at a row and column, both from 0; the grid grows as needed.
    pub fn panel(self, row: usize, column: usize, panel: Panel) -> Self {
        self.wide_panel(row, column, 1, panel)
    }

    /// Puts a panel over several columns, from the given one on.
    pub fn wide_panel(mut self, row: usize, column: usize, columns: usize, panel: Panel) -> Self {
        let span = columns.max(1);
        let place = Place { row, column, span };
        self.rows.resize(self.rows.len().max(row + 1), 1.0);
        self.columns.resize(self.columns.len().max(place.last() + 1), 1.0);
        self.panels.push((place, panel));
        // letters run along the rows
        self.panels.sort_by_key(|&(place, _)| place);
        self
    }

    /// The heights of the rows relative to each other; equal by default. Frames, not their margins, have
    /// these proportions.
    pub fn row_heights(mut self, relative: &[f64]) -> Self {
        self.rows = relative.to_vec();
        self
    }

    /// The widths of the columns relative to each other.
    pub fn column_widths(mut self, relative: &[f64]) -> Self {
        self.columns = relative.to_vec();
        self
    }

    /// With a line above all panels: what holds for each of them.
    pub fn heading(mut self, text: impl Into<String>) -> Self {
        self.heading = text.into();
        self
    }

    /// With one colour bar for all panels, at the right.
    pub fn colour_bar(mut self, scale: &ColourScale) -> Self {
        self.bar = Some(scale.clone());
        self
    }

    /// With one legend for all panels.
    pub fn legend(mut self, side: Side) -> Self {
        self.legend = Some(side);
        self
    }

    /// Width and height in millimetres.
    pub fn size(&self) -> [f64; 2] {
        self.size
    }

    /// Where things are.
    ///
    /// # Errors
    /// Those of [`Figure::svg`].
    pub fn layout(&self) -> Result<Layout, Error> {
        let page = self.draw()?;
        Ok(Layout {
            canvas: Rect::new(0.0, 0.0, self.size[0], self.size[1]),
            texts: page.texts,
            plots: page.plots,
            legends: page.legends,
            entries: page.entries,
            drawn: page.drawn,
        })
    }

    /// The figure as SVG. Equal figures give equal bytes.
    ///
    /// # Errors
    /// [`Error::Range`] for an axis or colour scale without extent, [`Error::NoColourBar`] for coloured
    /// values that no bar explains, [`Error::NoRoom`], [`Error::Size`] and [`Error::Grid`] for a page too
    /// small, too large or empty, [`Error::Character`] for text beyond the font.
    pub fn svg(&self) -> Result<String, Error> {
        let page = self.draw()?;
        Ok(page.scene.svg(&self.description, &page.font, ""))
    }

    /// The figure as SVG within a page of other pictures: all identifiers begin with `prefix`, and dense maps
    /// are pixels of so many dots per inch, which keeps the page small. Texts and lines stay what they are,
    /// and so do the colours of text, frames and page (see [`Colour`]), which a style sheet may replace.
    ///
    /// # Errors
    /// Those of [`Figure::svg`], and [`Error::Resolution`].
    pub fn inline_svg(&self, prefix: &str, dpi: f64) -> Result<String, Error> {
        let page = self.draw()?;
        let scene = page.scene.with_pixels(dpi)?;
        Ok(scene.svg(&self.description, &page.font, prefix))
    }

    /// The figure as PNG: the SVG, rasterised at so many dots per inch of the printed size, which the file
    /// records.
    ///
    /// # Errors
    /// Those of [`Figure::svg`], and [`Error::Resolution`].
    pub fn png(&self, dpi: f64) -> Result<Vec<u8>, Error> {
        crate::raster::png(&self.svg()?, dpi)
    }

    /// The figure as PDF: the SVG on one page of the printed size, with texts as outlines.
    ///
    /// # Errors
    /// Those of [`Figure::svg`].
    pub fn pdf(&self) -> Result<Vec<u8>, Error> {
        crate::pdf::pdf(&self.svg()?, &self.description)
    }

    /// Margins of a panel around its frame: its content's, title, colour bar and legend.
    fn margins(&self, panel: &Panel, about: [f64; 2], page: &Page) -> Result<Margins, Error> {
        let mut margins = match &panel.content {
            Content::Chart(chart) => draw::margins(chart, about, page)?,
            Content::Surface(_) => Margins {
                left: NEAR,
                right: NEAR,
                top: NEAR,
                bottom: NEAR,
            },
        };
        if self.headed(panel) {
            margins.top += TITLE + NEAR;
        }
        if let Some(scale) = &panel.bar {
            margins.right = margins.right.max(bar_width(scale, about[1], page)?);
        }
        if let (Some(side), Some(chart)) = (panel.legend, panel.chart()) {
            let [width, height] = Legend::of([chart], page)?.size(side, about[0]);
            match side {
                Side::Top => margins.top += height + NEAR,
                Side::Bottom => margins.bottom += height + NEAR,
                Side::Right => margins.right += width + 2.0 * NEAR,
            }
        }
        Ok(margins)
    }

    fn headed(&self, panel: &Panel) -> bool {
        !panel.title.is_empty() || self.panels.len() > 1
    }

    fn check(&self) -> Result<(), Error> {
        let empty = |row, column| Error::Grid {
            rows: self.rows.len(),
            columns: self.columns.len(),
            row,
            column,
        };
        if self.panels.is_empty() {
            return Err(empty(0, 0));
        }
        let [width, height] = self.size;
        if !(width <= MOST && height <= MOST) {
            let most = MOST;
            return Err(Error::Size { width, height, most });
        }
        for (index, (place, panel)) in self.panels.iter().enumerate() {
            if place.row >= self.rows.len() || place.last() >= self.columns.len() {
                return Err(empty(place.row, place.last()));
            }
            for (scale, _) in panel.scales() {
                scale.check()?;
                if panel.bar.as_ref() != Some(scale) && self.bar.as_ref() != Some(scale) {
                    return Err(Error::NoColourBar { panel: index + 1 });
                }
            }
        }
        Ok(())
    }

    fn draw(&self) -> Result<Page, Error> {
        self.check()?;
        let mut page = Page::new(self.size);
        let [width, height] = self.size;
        let mut inside = Rect::new(BORDER, BORDER, width - BORDER, height - BORDER);

        // what all panels share takes its place first
        if !self.heading.is_empty() {
            let at = [inside.left, inside.top + 0.85 * TITLE];
            page.text(&self.heading, TITLE, at, Anchor::Start, false, Colour::INK)?;
            inside.top += TITLE + 2.0 * NEAR;
        }
        if let Some(side) = self.legend {
            let legend = Legend::of(self.panels.iter().filter_map(|(_, panel)| panel.chart()), &page)?;
            let inside_width = inside.width();
            let [w, h] = legend.size(side, inside_width);
            let mut place = inside;
            match side {
                Side::Top => {
                    place.bottom = place.top + h;
                    inside.top = place.bottom + NEAR;
                }
                Side::Bottom => {
                    place.top = place.bottom - h;
                    inside.bottom = place.top - NEAR;
                }
                Side::Right => {
                    place.left = place.right - w;
                    place.top += TITLE + NEAR;
                    place.bottom = place.top + h;
                    inside.right = place.left - 2.0 * NEAR;
                }
            }
            legend.draw(&mut page, side, place, inside_width)?;
        }
        if let Some(scale) = &self.bar {
            inside.right -= bar_width(scale, inside.height(), &page)?;
        }

        let cells = self.frames(inside, &page)?;
        for (index, ((place, panel), (frame, margins))) in self.panels.iter().zip(&cells).enumerate() {
            let most = self.about(*place, inside)[0];
            self.draw_panel(index, panel, (*frame, *margins), most, &mut page)?;
        }
        if let Some(scale) = &self.bar {
            let all = self.panels.iter().flat_map(|(_, panel)| panel.scales());
            let beyond = all
                .filter(|(other, _)| other == scale)
                .fold([false; 2], |a, (_, b)| [a[0] || b[0], a[1] || b[1]]);
            let top = cells.iter().map(|(frame, _)| frame.top).fold(f64::INFINITY, f64::min);
            let bottom = cells.iter().map(|(frame, _)| frame.bottom).fold(0.0, f64::max);
            let beside = Rect::new(inside.left, top, inside.right, bottom);
            draw_bar(&mut page, scale, beside, beyond)?;
        }
        Ok(page)
    }

    /// The size of a panel if all had the same margins.
    fn about(&self, place: Place, inside: Rect) -> [f64; 2] {
        [
            share(
                &self.columns,
                place.column..=place.last(),
                inside.width() - gaps(self.columns.len()),
            ),
            share(
                &self.rows,
                place.row..=place.row,
                inside.height() - gaps(self.rows.len()),
            ),
        ]
    }

    /// The frames of the panels with their margins, aligned along rows and columns.
    fn frames(&self, inside: Rect, page: &Page) -> Result<Vec<(Rect, Margins)>, Error> {
        let (rows, columns) = (self.rows.len(), self.columns.len());
        let (mut left, mut right) = (vec![0.0f64; columns], vec![0.0f64; columns]);
        let (mut top, mut bottom) = (vec![0.0f64; rows], vec![0.0f64; rows]);
        let grow = |margin: &mut f64, needed: f64| *margin = margin.max(needed);
        for (place, panel) in &self.panels {
            let about = self.about(*place, inside);
            let margins = self.margins(panel, about, page)?;
            grow(&mut left[place.column], margins.left);
            grow(&mut right[place.last()], margins.right);
            grow(&mut top[place.row], margins.top);
            grow(&mut bottom[place.row], margins.bottom);
        }
        let across = intervals(
            &self.columns,
            &left,
            &right,
            inside.left,
            inside.width() - gaps(columns),
        );
        let down = intervals(&self.rows, &top, &bottom, inside.top, inside.height() - gaps(rows));
        let mut frames = Vec::with_capacity(self.panels.len());
        for (index, (place, _)) in self.panels.iter().enumerate() {
            let (first, last, row) = (place.column, place.last(), place.row);
            let frame = Rect::new(across[first].0, down[row].0, across[last].1, down[row].1);
            if !(frame.width() >= LEAST && frame.height() >= LEAST) {
                return Err(Error::NoRoom {
                    panel: index + 1,
                    width: frame.width(),
                    height: frame.height(),
                    least: LEAST,
                });
            }
            // titles and legends are aligned like the frames
            let margins = Margins {
                left: left[first],
                right: right[last],
                top: top[row],
                bottom: bottom[row],
            };
            frames.push((frame, margins));
        }
        Ok(frames)
    }

    fn draw_panel(
        &self,
        index: usize,
        panel: &Panel,
        (frame, margins): (Rect, Margins),
        legend_width: f64,
        page: &mut Page,
    ) -> Result<(), Error> {
        let plot = match &panel.content {
            Content::Chart(chart) => draw::draw(chart, page, frame)?,
            Content::Surface(surface) => {
                surface.draw(&mut page.scene, frame);
                page.plots.push(frame);
                frame
            }
        };
        if let Some(scale) = &panel.bar {
            let seen = panel.scales().iter().find(|(other, _)| other == scale);
            draw_bar(page, scale, plot, seen.map_or([false; 2], |(_, beyond)| *beyond))?;
        }
        let mut top = frame.top - margins.top;
        if self.headed(panel) {
            let letter = match self.panels.len() {
                1 => String::new(),
                _ => format!("({}) ", letters(index)),
            };
            let at = [frame.left - margins.left, top + 0.85 * TITLE];
            let title = format!("{letter}{}", panel.title);
            page.text(title.trim_end(), TITLE, at, Anchor::Start, false, Colour::INK)?;
            top += TITLE + NEAR;
        }
        if let (Some(side), Some(chart)) = (panel.legend, panel.chart()) {
            let legend = Legend::of([chart], page)?;
            let (left, right) = (frame.left - margins.left, frame.right + margins.right);
            let [w, h] = legend.size(side, legend_width);
            let place = match side {
                Side::Top => Rect::new(left, top, right, top + h),
                Side::Bottom => {
                    // below its own axis, however much room another panel of the row needs
                    let own = draw::margins(chart, [frame.width(), frame.height()], page)?.bottom;
                    let top = frame.bottom + own + NEAR;
                    Rect::new(left, top, right, top + h)
                }
                Side::Right => Rect::new(right - w, frame.top, right, frame.top + h),
            };
            legend.draw(page, side, place, legend_width)?;
        }
        Ok(())
    }
}

/// a, b, ..., z, aa, ab, ...
fn letters(index: usize) -> String {
    let before = if index < 26 {
        String::new()
    } else {
        letters(index / 26 - 1)
    };
    format!("{before}{}", char::from(b'a' + (index % 26) as u8))
}

/// The sum of the gaps between rows or columns.
fn gaps(count: usize) -> f64 {
    BETWEEN * (count - 1) as f64
}

/// The part of a length that some of the rows or columns get.
fn share(relative: &[f64], which: RangeInclusive<usize>, total: f64) -> f64 {
    total * relative[which].iter().sum::<f64>() / relative.iter().sum::<f64>()
}

/// The frames' extents along rows or columns, from the margins before and after each; `total` is without the
/// gaps between.
fn intervals(relative: &[f64], before: &[f64], after: &[f64], origin: f64, total: f64) -> Vec<(f64, f64)> {
    let free = total - before.iter().chain(after).sum::<f64>();
    let mut at = origin;
    let extent = |index: usize| {
        let start = at + before[index];
        let end = start + share(relative, index..=index, free);
        at = end + after[index] + BETWEEN;
        (start, end)
    };
    (0..relative.len()).map(extent).collect()
}

/// The height of one line of labels, in millimetres: a help in choosing the height of a figure.
pub const TEXT_LINE: f64 = 1.3 * SMALL;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_go_on_after_z() {
        let expected = [
            (0, "a"),
            (25, "z"),
            (26, "aa"),
            (27, "ab"),
            (51, "az"),
            (52, "ba"),
            (701, "zz"),
            (702, "aaa"),
        ];
        assert!(expected.iter().all(|&(index, text)| letters(index) == text));
    }
}
