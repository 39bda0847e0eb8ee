//! Second-order maps in space: cup and two saddles over the characteristic map (Ma, Wang and Ma 2023, Fig.
//! 4b).
//!
//! A surface is curvature continuous at the centre only if these maps are quadratics: then `K* = z_xx z_yy -
//! z_xy^2` is constant, positive on the cup and negative on saddles. Colour shows K* relative to the mean of
//! its modulus over the outer annulus; where the sign is wrong, the region is outlined. Annuli further in
//! follow by lambda and mu. Rows are schemes; each valence has a picture of its own. Heights are scaled to
//! the same extent.

use super::characteristic::resolution;
use super::grid::{Grid, NARROWEST, narrowest};
use super::sheet::{MapPoint, Sheet, common_inner};
use super::subject::{Subject, chosen, tell};
use super::{Drawing, FigureEntry, Inputs, points};
use crate::error::Error;
use eigenring_figure::{Colour, ColourMap, ColourScale, Figure, Panel, Stroke, Surface, View};

pub const ENTRY: FigureEntry = FigureEntry {
    valences: &[3, 6, 20],
    schemes: Some(&["catmull-clark", "lambda:optimal"]),
    colours: Some((-2.0, 2.0)),
    ..FigureEntry::new(
        "second-order-maps",
        "cup and saddles in space, coloured by the Gauss curvature, wrong signs outlined; rows: schemes",
        "Ma, Wang and Ma 2023, Fig. 4b",
        build,
    )
};

/// Names of the maps.
const MAPS: [&str; 3] = ["cup", "saddle 1", "saddle 2"];
/// Signs of K* on quadratics.
const SIGNS: [f64; 3] = [1.0, -1.0, -1.0];
/// The vertical extent of a surface whose rim has radius 1.
const HEIGHT: f64 = 0.75;
/// Looks into the cup, and at a corner of neither saddle.
const VIEW: View = View {
    azimuth: -55.0,
    elevation: 40.0,
};
/// Room for the colour bar, in millimetres.
const BAR: f64 = 16.0;
/// The height of a panel relative to its width, as this view needs.
const ASPECT: f64 = 0.8;
/// Annuli on which the boundaries of patches are drawn, if patches are at least this wide, in millimetres.
const LINED: usize = 3;
const WIDE: f64 = 1.3;
/// About the radius of a surface on the page, in millimetres.
const RADIUS: f64 = 20.0;
/// Annuli on which wrong signs are outlined.
const OUTLINED: usize = 4;
/// The lowest figure, in millimetres: the label of the colour bar fits beside it.
const LOWEST: f64 = 66.0;
/// The height of the line above all panels, in millimetres.
const HEADING: f64 = 5.0;
/// Cells of a figure, about: larger files show nothing new at the printed size.
const CELLS: f64 = 20_500.0;
/// Steps of the tables along the edge of a patch.
const STEPS: usize = 4;

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    inputs.valences.iter().map(|&valence| draw(valence, inputs)).collect()
}

fn draw(valence: usize, inputs: &Inputs<'_>) -> Result<Drawing, Error> {
    let subjects = chosen(inputs, valence)?;
    let inner = common_inner(subjects.iter().map(|subject| &subject.scheme))?;
    let cells = resolution(9 * inner * inner * valence * subjects.len().max(1), CELLS);
    let of = |subject: &Subject| Sheet::second_order(&subject.scheme, inner, cells);
    let maps: Vec<[Sheet; 3]> = subjects.iter().map(of).collect::<Result<_, _>>()?;
    let is_wrong = |(sheet, sign): (&Sheet, f64)| {
        sheet
            .all()
            .iter()
            .take(OUTLINED)
            .any(|s| !s.zero_lines(sign).is_empty())
    };
    let outlined = maps.iter().any(|sheets| sheets.iter().zip(SIGNS).any(is_wrong));
    let label = match outlined {
        true => "$K^*$ / mean |$K^*$|  (outlined: wrong sign)",
        false => "$K^*$ / mean |$K^*$|",
    };
    let scale = ColourScale::new(ColourMap::Diverging, inputs.colours.unwrap_or_default(), label);
    let title = |subject: &Subject, which: usize| match subjects.len() {
        // one scheme is named above all panels
        1 => MAPS[which].to_owned(),
        _ => format!("{}: {}", subject.full_title(), MAPS[which]),
    };
    let narrowest = narrowest(subjects.iter().map(|subject| title(subject, 1)), NARROWEST);
    let abreast = Grid::new(subjects.len(), 3, inputs.width, BAR, narrowest);
    // where three maps do not fit side by side, schemes stand in the columns
    let (grid, turned) = match abreast.wraps() {
        true => (Grid::new(3, subjects.len(), inputs.width, BAR, narrowest), true),
        false => (abreast, false),
    };
    let mut height = grid.height(ASPECT * grid.across).max(LOWEST);
    let alone = subjects.first().filter(|_| subjects.len() == 1);
    if alone.is_some() {
        height += HEADING;
    }
    let description = format!("Second-order maps of valence {valence}");
    let mut figure = Figure::new(inputs.width, height, description).colour_bar(&scale);
    if let Some(subject) = alone {
        figure = figure.heading(subject.full_title());
    }
    let mut table = points::table(&["scheme", "valence", "lambda", "map", "mu"], &["z", "gauss"]);
    for (row, (subject, sheets)) in subjects.iter().zip(&maps).enumerate() {
        for (which, sheet) in sheets.iter().enumerate() {
            let (at_row, at_column) = match turned {
                true => grid.place(which, row),
                false => grid.place(row, which),
            };
            let panel = Panel::new(surface(sheet, SIGNS[which], &scale));
            figure = figure.panel(at_row, at_column, panel.title(title(subject, which)));
        }
        for (which, sheet) in Sheet::second_order(&subject.scheme, inner, STEPS)?.iter().enumerate() {
            let of = [
                subject.name.as_str().into(),
                valence.into(),
                sheet.factors.plane.into(),
                MAPS[which].into(),
                sheet.factors.height.into(),
            ];
            points::push(&mut table, &of, sheet, |point| [point.z, point.value]);
        }
    }
    tell(subjects.iter(), &mut table, inputs.tuner.progress);
    Ok(Drawing {
        stem: format!("{}-n{valence}", ENTRY.name),
        figure,
        data: vec![("", table)],
    })
}

fn surface(sheet: &Sheet, sign: f64, scale: &ColourScale) -> Surface {
    let radius = sheet.radius();
    let (low, high) = sheet.heights();
    // the cup stands upright, whichever sign its mode has
    let upright = if sign > 0.0 && high < -low { -1.0 } else { 1.0 };
    let vertical = upright * if high > low { HEIGHT / (high - low) } else { 1.0 };
    let place = |point: MapPoint| [point.x / radius, point.y / radius, vertical * point.z];
    let annuli = sheet.all();
    let fan = annuli.last().into_iter().flat_map(Sheet::fan);
    let quads = annuli.iter().flat_map(Sheet::quads).chain(fan).map(|quad| {
        let value = quad.iter().map(|corner| corner.value).sum::<f64>() / 4.0;
        (quad.map(place), value)
    });
    // a disc needs less room than the square around it
    let disc = 0.74;
    let mut surface = Surface::new(VIEW)
        .quads(quads, scale)
        .within([[-disc, -disc, vertical * low], [disc, disc, vertical * high]]);
    for (level, annulus) in annuli.iter().enumerate().take(LINED) {
        let shrunk = sheet.factors.plane.powi(level as i32);
        let patch = RADIUS * shrunk * std::f64::consts::PI / (sheet.inner * sheet.sectors()) as f64;
        if level > 0 && patch < WIDE {
            break;
        }
        let thin = Stroke::solid(Colour::GREY, 0.08 * shrunk);
        for line in annulus.edges() {
            surface = surface.line(line.into_iter().map(place), thin);
        }
    }
    for (level, annulus) in annuli.iter().enumerate().take(OUTLINED) {
        let bold = Stroke::solid(Colour::INK, 0.3 * sheet.factors.plane.powi(level as i32));
        for segment in annulus.zero_lines(sign) {
            surface = surface.line(segment.map(place), bold);
        }
    }
    surface
}
