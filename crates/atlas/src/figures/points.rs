//! Tables of sampled maps: one sector of the outer annulus; other sectors follow by rotation, other annuli by
//! the factors.

use super::sheet::{MapPoint, Sheet};
use crate::table::{Cell, Table};

/// Columns that tell maps apart, the parameters u along a sector's own and v along the next spoke, the point,
/// and columns of values.
pub fn table(keys: &[&str], values: &[&str]) -> Table {
    let columns = keys.iter().chain(&["u", "v", "x", "y"]).chain(values);
    Table::new(columns.copied())
}

/// Adds the points of a sheet, with what tells it apart.
pub fn push<const N: usize>(table: &mut Table, keys: &[Cell], sheet: &Sheet, values: impl Fn(MapPoint) -> [f64; N]) {
    for (u, v, point) in sheet.sector_points() {
        let own = [u, v, point.x, point.y].into_iter().chain(values(point));
        table.push(keys.iter().cloned().chain(own.map(Cell::from)).collect());
    }
}
