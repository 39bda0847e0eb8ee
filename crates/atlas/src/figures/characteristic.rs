//! Characteristic maps: their patches with the Jacobian determinant as colour.
//!
//! The map is regular where the Jacobian is positive; a scheme is C1 at the centre if the map is regular and
//! injective (Reif 1995). Annuli of patches shrink by lambda, and the Jacobian changes by `4 lambda^2` from
//! one to the next, so that it fades or grows toward the centre unless lambda = 1/2. The sheets (see `sheet`)
//! say how values are scaled. Rows are schemes, columns valences.

use super::grid::{Grid, NARROWEST};
use super::sheet::{Point, Sheet, common_inner};
use super::subject::{Subject, chosen};
use super::{Drawing, Entry, Inputs};
use crate::error::Error;
use crate::table::Table;
use eigenring_figure::{Chart, Colour, ColourMap, ColourScale, Figure, Panel, Side, Stroke, Style, Width};

pub const ENTRY: Entry = Entry {
    name: "characteristic-map",
    title: "patches of the characteristic maps coloured by the Jacobian; columns: valences, rows: schemes",
    reference: "Reif 1995",
    valences: &[3, 5, 8, 20],
    lambdas: &[],
    schemes: Some(&["catmull-clark", "lambda:optimal"]),
    range: false,
    colours: Some((0.0, 3.0)),
    studies: false,
    width: Width::Two,
    build,
};

/// The most a panel is wide and high, in millimetres.
const SIDE: f64 = 70.0;
/// Room for the colour bar, in millimetres.
const BAR: f64 = 16.0;
/// Cells of a figure, about: more show nothing new at the printed size and make large files.
const CELLS: f64 = 24_000.0;
/// Lines thinner than this, in millimetres, are not drawn: a fifth of a pixel at 300 dots per inch.
const THINNEST: f64 = 0.016;
/// Steps of the tables along the edge of a patch.
const STEPS: usize = 4;

/// Cells along the edge of a patch for a figure of so many patches in the outer annuli. The annuli inside
/// them add a third, and more where cells cannot become fewer.
pub fn resolution(patches: usize, cells: f64) -> usize {
    let wanted = (0.7 * cells / patches as f64).sqrt();
    let allowed = [16, 12, 8, 6, 4];
    allowed.into_iter().find(|&k| k as f64 <= wanted).unwrap_or(2)
}

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    let columns = inputs.valences.iter().map(|&valence| chosen(inputs, valence));
    let columns: Vec<Vec<Subject>> = columns.collect::<Result<_, _>>()?;
    let inner = common_inner(columns.iter().flatten().map(|subject| &subject.scheme))?;
    let patches: usize = columns
        .iter()
        .flatten()
        .map(|subject| 3 * inner * inner * subject.valence)
        .sum();
    let cells = resolution(patches, CELLS);
    let scale = ColourScale::new(
        ColourMap::Viridis,
        inputs.colours.unwrap_or_default(),
        "Jacobian / mean of outer annulus",
    );
    let grid = Grid::new(inputs.schemes.len(), columns.len(), inputs.width, BAR, NARROWEST);
    let side = grid.across.min(SIDE);
    let mut figure = Figure::new(inputs.width, grid.height(side), "Characteristic maps").colour_bar(&scale);
    let mut table = Table::new(["scheme", "valence", "lambda", "u", "v", "x", "y", "jacobian"]);
    let mut folds = false;
    for (column, subjects) in columns.iter().enumerate() {
        for (row, subject) in subjects.iter().enumerate() {
            let sheet = Sheet::characteristic(&subject.scheme, inner, cells)?;
            push(
                &mut table,
                subject,
                &Sheet::characteristic(&subject.scheme, inner, STEPS)?,
            );
            let (chart, folded) = chart(&sheet, side, &scale);
            folds |= folded;
            let (at_row, at_column) = grid.place(row, column);
            figure = figure.panel(at_row, at_column, Panel::new(chart).title(subject.full_title()));
        }
    }
    if folds {
        figure = figure.legend(Side::Bottom);
    }
    Ok(vec![Drawing {
        stem: ENTRY.name.to_owned(),
        figure,
        data: vec![("", table)],
    }])
}

/// Points of sector 0 of the outer annulus, by the parameters u along its own and v along the next spoke;
/// other sectors follow by rotation, other annuli by the factors.
fn push(table: &mut Table, subject: &Subject, sheet: &Sheet) {
    for (u, v, point) in sheet.sector_points() {
        table.push(vec![
            subject.name.as_str().into(),
            subject.valence.into(),
            sheet.factors.plane.into(),
            u.into(),
            v.into(),
            point.x.into(),
            point.y.into(),
            point.value.into(),
        ]);
    }
}

/// The map in a square of this side (in millimetres), and whether it has folds.
fn chart(sheet: &Sheet, side: f64, scale: &ColourScale) -> (Chart, bool) {
    let radius = 1.01 * sheet.radius();
    let mut chart = Chart::map((-radius, radius), (-radius, radius));
    let annuli = sheet.all();
    let turn = sheet.upright();
    let place = |point: Point| turn.plane(point.plane());
    let fan = annuli.last().into_iter().flat_map(Sheet::fan);
    let quads = annuli.iter().flat_map(Sheet::quads).chain(fan);
    let cells = quads.map(|quad| {
        let value = quad.iter().map(|corner| corner.value).sum::<f64>() / 4.0;
        (quad.map(place).to_vec(), value)
    });
    chart = chart.cells(cells, scale);
    let white = |width: f64| Stroke::solid(Colour::WHITE, width);
    for (level, annulus) in annuli.iter().enumerate() {
        // lines become thinner with the patches
        let shrunk = sheet.factors.plane.powi(level as i32);
        let step = side * shrunk * std::f64::consts::PI / (2.0 * sheet.inner as f64 * sheet.sectors() as f64).max(8.0);
        let widths = [f64::min(0.06, 0.04 * step), f64::min(0.16, 0.1 * step)];
        for (lines, width) in [annulus.isolines(2), annulus.edges()].into_iter().zip(widths) {
            if width < THINNEST {
                continue;
            }
            let points = lines.into_iter().flat_map(|line| {
                let gap = std::iter::once([f64::NAN; 2]);
                line.into_iter().map(place).chain(gap).collect::<Vec<_>>()
            });
            let style = Style {
                line: Some(white(width)),
                marker: None,
                colour: Colour::WHITE,
            };
            chart = chart.series(points, style);
        }
    }
    let folds: Vec<_> = annuli.iter().flat_map(|annulus| annulus.zero_lines(1.0)).collect();
    if folds.is_empty() {
        return (chart, false);
    }
    let points = folds.into_iter().flat_map(|[a, b]| [place(a), place(b), [f64::NAN; 2]]);
    (
        chart.series(points, Style::solid(Colour::line(1))).label("Jacobian 0"),
        true,
    )
}
