//! How panels of equal size fill a page: columns for valences, rows for schemes or lambdas.

use eigenring_figure::Width;

/// Rows and columns of panels, wrapped where the page is too narrow for all columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    rows: usize,
    columns: usize,
    /// Columns side by side.
    abreast: usize,
    /// Width of a panel, in millimetres.
    pub across: f64,
}

/// The narrowest panel of a map: titles such as "(a) N = 20, Catmull-Clark" fit above it.
pub const NARROWEST: f64 = 33.0;
/// The mean width of a title's characters, in millimetres; empirical.
const CHARACTER: f64 = 1.32;
/// The height of a panel's title and the distance to the next one, in millimetres.
const TITLE: f64 = 7.8;
/// The lowest figure: the label of a colour bar fits beside it.
const LOWEST: f64 = 52.0;

/// The narrowest panel above which all these titles fit, and no narrower than given, in millimetres.
pub fn narrowest(titles: impl IntoIterator<Item = String>, least: f64) -> f64 {
    titles
        .into_iter()
        .map(|title| title_width(&title))
        .fold(least, f64::max)
}

/// About the width of a title with its letter, in millimetres.
fn title_width(title: &str) -> f64 {
    let letters = "(aa) ".chars().chain(title.chars());
    CHARACTER * letters.filter(|letter| !"$_^{}".contains(*letter)).count() as f64
}

impl Grid {
    /// A grid of panels no narrower than given on a page of this width, of which `beside` millimetres are for
    /// colour bars.
    pub fn new(rows: usize, columns: usize, width: Width, beside: f64, narrowest: f64) -> Self {
        let free = width.millimetres() - beside - 2.0;
        let abreast = columns.clamp(1, ((free / narrowest) as usize).max(1));
        Grid {
            rows: rows.max(1),
            columns: columns.max(1),
            abreast,
            across: free / abreast as f64 - 4.0,
        }
    }

    /// Whether not all columns fit side by side.
    pub fn wraps(&self) -> bool {
        self.abreast < self.columns
    }

    /// Row and column on the page.
    pub fn place(&self, row: usize, column: usize) -> (usize, usize) {
        (row + self.rows * (column / self.abreast), column % self.abreast)
    }

    /// The height of a figure of panels as high as given.
    pub fn height(&self, panel: f64) -> f64 {
        let rows = self.rows * self.columns.div_ceil(self.abreast);
        (rows as f64 * (panel + TITLE) + 2.0).max(LOWEST)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_that_do_not_fit_are_wrapped() {
        let wide = Grid::new(5, 3, Width::Two, 0.0, NARROWEST);
        assert_eq!((wide.place(4, 2), wide.abreast), ((4, 2), 3));
        assert!(!wide.wraps());
        let narrow = Grid::new(5, 3, Width::One, 0.0, NARROWEST);
        assert_eq!((narrow.place(0, 1), narrow.place(1, 2)), ((0, 1), (6, 0)));
        assert!(narrow.wraps() && narrow.across >= NARROWEST - 4.0);
        assert_eq!(Grid::new(1, 9, Width::Two, 16.0, NARROWEST).abreast, 4);
        assert!(narrow.height(30.0) > 1.9 * Grid::new(5, 2, Width::One, 0.0, NARROWEST).height(30.0));
        assert_eq!(Grid::new(1, 1, Width::One, 80.0, NARROWEST).abreast, 1);
    }
}
