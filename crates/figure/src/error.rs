//! Why a figure cannot be drawn.

/// Everything that can be wrong with a figure; lengths in millimetres.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An axis or colour scale that spans nothing.
    #[error("{what} has the range {low} to {high}: accepted are finite numbers in ascending order{}", if *.log { ", above 0" } else { "" })]
    Range {
        /// The axis or scale.
        what: String,
        /// Its lower end.
        low: f64,
        /// Its upper end.
        high: f64,
        /// Whether the axis is logarithmic.
        log: bool,
    },
    /// Values are shown as colours that nothing explains.
    #[error("panel {panel} has coloured cells but neither it nor the figure has a colour bar")]
    NoColourBar {
        /// Which panel, from 1.
        panel: usize,
    },
    /// A figure without panels, or a panel outside the grid.
    #[error("a figure of {rows} rows and {columns} columns has nothing at row {row}, column {column}")]
    Grid {
        /// Rows of the grid.
        rows: usize,
        /// Columns of the grid.
        columns: usize,
        /// The asked row.
        row: usize,
        /// The asked column.
        column: usize,
    },
    /// What surrounds the data leaves no room for it.
    #[error(
        "panel {panel} leaves {width:.1} mm by {height:.1} mm for its data: accepted are at least {least} mm each way"
    )]
    NoRoom {
        /// Which panel, from 1.
        panel: usize,
        /// What is left.
        width: f64,
        /// What is left.
        height: f64,
        /// What is needed.
        least: f64,
    },
    /// A character that the embedded font lacks.
    #[error("the font has no character {0:?}")]
    Character(char),
    /// A resolution that gives no picture or one too large for memory.
    #[error("resolution {0} is out of range: accepted are 20 to 2400 dots per inch")]
    Resolution(f64),
    /// A page beyond what is drawn to the micrometre.
    #[error("a figure of {width} mm by {height} mm is out of range: accepted are up to {most} mm each way")]
    Size {
        /// Its width.
        width: f64,
        /// Its height.
        height: f64,
        /// What is accepted.
        most: f64,
    },
    /// The chart library refused the chart.
    #[error("the chart cannot be drawn: {0}")]
    Chart(String),
    /// The drawing is beyond what makes a PNG or a PDF of it.
    #[error("the drawing cannot be converted: {0}")]
    Raster(String),
}
