//! Characteristic maps: their patches with the Jacobian determinant as colour.
//!
//! The map is regular where the Jacobian is positive; a scheme is C1 at the centre if the map is regular and
//! injective (Reif 1995). Annuli of patches shrink by lambda, and the Jacobian changes by `4 lambda^2` from
//! one to the next, so that it fades or grows toward the centre unless lambda = 1/2. The sheets (see `sheet`)
//! say how values are scaled. Rows are schemes, columns valences.
//!
//! At large valences lambda is large and patches are narrow: annuli crowd at the rim. There radii are
//! drawn by their logarithms, so that all annuli are equally wide, and a few of them stand for the rest.

use super::grid::{Grid, NARROWEST, narrowest};
use super::sheet::{MapPoint, Sheet, common_inner};
use super::subject::{Subject, chosen, tell};
use super::{Drawing, FigureEntry, Inputs, points, uneven};
use crate::error::Error;
use eigenring_figure::{Chart, Colour, ColourMap, ColourScale, Figure, Panel, Side, Stroke, Style};

pub const ENTRY: FigureEntry = FigureEntry {
    valences: &[3, 5, 8, 20],
    schemes: Some(&["catmull-clark", "lambda:optimal"]),
    colours: Some((0.0, 3.0)),
    knots: true,
    ..FigureEntry::new(
        "characteristic-map",
        "patches of the characteristic maps coloured by the Jacobian; columns: valences, rows: schemes",
        "Reif 1995",
        build,
    )
};

/// The most a panel is wide and high, in millimetres.
const SIDE: f64 = 70.0;
/// Room for the colour bar, in millimetres.
const BAR: f64 = 16.0;
/// Cells of a figure, about: more show nothing new at the printed size and make large files.
const CELLS: f64 = 24_000.0;
/// Lines thinner than this, in millimetres, are not drawn: a fifth of a pixel at 300 dots per inch.
const THINNEST: f64 = 0.016;
/// The largest valence that is drawn in proportion.
const LARGE: usize = 12;
/// Annuli drawn by logarithms, and the radius that is left inside them.
const SHOWN: usize = 3;
const INNER: f64 = 0.2;
/// The height of the line above all panels, in millimetres.
const HEADING: f64 = 5.0;
/// Steps of the tables along the edge of a patch.
const STEPS: usize = 4;

/// Cells along the edge of a patch for a figure of so many patches in the outer annuli. The annuli inside
/// them add a third, and more where cells cannot become fewer.
pub fn resolution(patches: usize, cells: f64) -> usize {
    let wanted = (0.7 * cells / patches as f64).sqrt();
    let allowed = [16, 12, 8, 6, 4, 3];
    allowed.into_iter().find(|&k| k as f64 <= wanted).unwrap_or(2)
}

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    if let Some(spokes) = inputs.knots {
        return uneven::build(&ENTRY, inputs, spokes);
    }
    let columns = inputs.valences.iter().map(|&valence| chosen(inputs, valence));
    let columns: Vec<Vec<Subject>> = columns.collect::<Result<_, _>>()?;
    let inner = common_inner(columns.iter().flatten().map(|subject| &subject.scheme))?;
    let panels = columns.iter().map(Vec::len).sum::<usize>().max(1);
    let scale = ColourScale::new(
        ColourMap::Viridis,
        inputs.colours.unwrap_or_default(),
        "Jacobian / mean of outer annulus",
    );
    let narrowest = narrowest(columns.iter().flatten().map(Subject::full_title), NARROWEST);
    let grid = Grid::new(inputs.schemes.len(), columns.len(), inputs.width, BAR, narrowest);
    let side = grid.across.min(SIDE);
    let mut height = grid.height(side);
    let large = inputs.valences.iter().any(|&valence| valence > LARGE);
    if large {
        height += HEADING;
    }
    let mut figure = Figure::new(inputs.width, height, "Characteristic maps").colour_bar(&scale);
    if large {
        figure = figure.heading(format!("$N$ > {LARGE}: {SHOWN} annuli, radii by their logarithms"));
    }
    let mut table = points::table(&["scheme", "valence", "lambda"], &["jacobian"]);
    let mut folds = false;
    for (column, subjects) in columns.iter().enumerate() {
        for (row, subject) in subjects.iter().enumerate() {
            // even: lines run through the middle of patches
            let cells = resolution(3 * inner * inner * subject.valence, CELLS / panels as f64) / 2 * 2;
            let sheet = Sheet::characteristic(&subject.scheme, inner, cells)?;
            let of = [
                subject.name.as_str().into(),
                subject.valence.into(),
                sheet.factors.plane.into(),
            ];
            let tabulated = Sheet::characteristic(&subject.scheme, inner, STEPS)?;
            points::push(&mut table, &of, &tabulated, |point| [point.value]);
            let (chart, folded) = chart(&sheet, side, &scale);
            folds |= folded;
            let (at_row, at_column) = grid.place(row, column);
            figure = figure.panel(at_row, at_column, Panel::new(chart).title(subject.full_title()));
        }
    }
    if folds {
        figure = figure.legend(Side::Bottom);
    }
    tell(columns.iter().flatten(), &mut table, inputs.tuner.progress);
    Ok(vec![Drawing::of(&ENTRY, figure, table)])
}

/// A radius, relative to the rim, so that each of [`SHOWN`] annuli is equally wide around the hole.
fn logarithmic(radius: f64, lambda: f64) -> f64 {
    let annuli = radius.ln() / lambda.ln();
    (1.0 - (1.0 - INNER) * annuli / SHOWN as f64).max(0.0)
}

/// The map in a square of this side (in millimetres), and whether it has folds.
fn chart(sheet: &Sheet, side: f64, scale: &ColourScale) -> (Chart, bool) {
    let rim = sheet.radius();
    let radius = 1.01 * rim;
    let mut chart = Chart::map((-radius, radius), (-radius, radius));
    let by_logarithms = sheet.sectors() > LARGE;
    let annuli = if by_logarithms { sheet.first(SHOWN) } else { sheet.all() };
    let turn = sheet.upright();
    let place = |point: MapPoint| {
        let [x, y] = turn.plane(point.plane());
        let r = x.hypot(y);
        let scale = match by_logarithms && r > 0.0 {
            true => logarithmic(r / rim, sheet.factors.plane) * rim / r,
            false => 1.0,
        };
        [scale * x, scale * y]
    };
    let fan = annuli
        .last()
        .into_iter()
        .filter(|_| !by_logarithms)
        .flat_map(Sheet::fan);
    let quads = annuli.iter().flat_map(Sheet::quads).chain(fan);
    let cells = quads.map(|quad| {
        let value = quad.iter().map(|corner| corner.value).sum::<f64>() / 4.0;
        (quad.map(place).to_vec(), value)
    });
    chart = chart.cells(cells, scale);
    let white = |width: f64| Stroke::solid(Colour::WHITE, width);
    for (level, annulus) in annuli.iter().enumerate() {
        // lines become thinner with the patches
        let shrunk = match by_logarithms {
            true => logarithmic(sheet.factors.plane.powf(level as f64 + 0.5), sheet.factors.plane),
            false => sheet.factors.plane.powi(level as i32),
        };
        let step = side * shrunk * std::f64::consts::PI / (2.0 * sheet.inner as f64 * sheet.sectors() as f64).max(8.0);
        let widths = [f64::min(0.06, 0.025 * step), f64::min(0.16, 0.06 * step)];
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn annuli_by_logarithms_are_equally_wide() {
        for lambda in [0.35f64, 0.65, 0.9] {
            let at = |k: usize| logarithmic(lambda.powi(k as i32), lambda);
            assert!((at(0) - 1.0).abs() < 1e-12 && (at(SHOWN) - INNER).abs() < 1e-12);
            assert!((at(1) - at(2) - (at(2) - at(3))).abs() < 1e-12);
            assert_eq!(logarithmic(1e-30, lambda), 0.0);
        }
    }
}
