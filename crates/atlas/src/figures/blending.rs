//! Blending functions of an extraordinary vertex with knot intervals, as graphs (Li, Wei and Zhang 2019,
//! Figs. 9 to 11).
//!
//! The control points are a star in the plane with steps of 1, and the vertex is lifted by 1; what is drawn
//! is the limit surface, with its height as colour and the edges of the net before refinement as lines. Which
//! edges of the paper's figures have the large interval is lost: spokes are guesses (`docs/nonuniform.md`).
//! Rows are sets of intervals, columns schemes; above each graph is the number of its maxima, counted as in
//! [`blending`](crate::nonuniform::blending).

use super::grid::{Grid, NARROWEST, narrowest};
use super::{Drawing, FigureEntry, Inputs};
use crate::error::Error;
use crate::nonuniform::blending::{PAPER, SHARE, columns, row, with_intervals};
use crate::progress::{Silent, each};
use crate::table::Table;
use eigenring_figure::{Colour, ColourMap, ColourScale, Figure, Panel, Stroke, Surface, View};
use eigenring_nonuniform::{Blending, FirstLevel, Scheme, Spokes};

pub const ENTRY: FigureEntry = FigureEntry {
    schemes: Some(&["nurss", "eigen-polyhedron", "hnuss:simple", "hnuss:printed", "hnuss"]),
    colours: Some((0.0, 0.4)),
    knots: true,
    uneven: true,
    ..FigureEntry::new(
        "blending-functions",
        "blending functions of an extraordinary vertex with knot intervals and the number of their maxima; columns: schemes",
        "Li, Wei and Zhang 2019, Figs. 9 to 11",
        build,
    )
};

/// Looks at the vertex from above, so that a valley between two maxima is seen.
const VIEW: View = View {
    azimuth: -62.0,
    elevation: 38.0,
};
/// Room for the colour bar, in millimetres.
const BAR: f64 = 16.0;
/// The height of a panel relative to its width, as this view needs.
const ASPECT: f64 = 0.7;
/// The height of the line above all panels, in millimetres.
const HEADING: f64 = 5.0;
/// Levels of the graph that is drawn, and of the net on which maxima are counted.
const DRAWN: usize = 3;
const COUNTED: usize = 4;
/// The radius that is drawn: the functions reach two steps, and beyond that a little.
const RADIUS: f64 = 2.3;
/// The height on the page of a function whose value is 1, in steps of the star.
const HEIGHT: f64 = 5.5;

/// What a scheme is called above a panel.
pub(super) fn called(scheme: Scheme) -> &'static str {
    match scheme {
        Scheme::Nurss => "NURSS",
        Scheme::EigenPolyhedron => "eigen-polyhedron",
        Scheme::Hnuss(FirstLevel::Simple) => "HNUSS simple",
        Scheme::Hnuss(FirstLevel::Printed) => "HNUSS printed",
        Scheme::Hnuss(FirstLevel::Improved) => "HNUSS",
    }
}

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    let schemes: Vec<Scheme> = inputs.schemes.iter().map(with_intervals).collect::<Result<_, _>>()?;
    let sets = match inputs.knots {
        Some(spokes) => vec![spokes.clone()],
        None => PAPER
            .iter()
            .map(|red| red.spokes())
            .collect::<Result<Vec<Spokes>, _>>()?,
    };
    let all: Vec<(usize, usize)> = (0..sets.len())
        .flat_map(|set| (0..schemes.len()).map(move |scheme| (set, scheme)))
        .collect();
    let found = each(&Silent, "graphs", &all, |&(set, scheme)| {
        let of = |levels: usize| Blending::new(schemes[scheme], &sets[set], levels).map_err(Error::from);
        Ok::<_, Error>([of(DRAWN)?, of(COUNTED)?])
    })?;
    let scale = ColourScale::new(ColourMap::Viridis, inputs.colours.unwrap_or_default(), "value");
    let title = |scheme: Scheme, blending: &Blending| {
        let count = 1 + blending.others(SHARE).count();
        // five names stand side by side
        format!("{}: {count}", called(scheme).trim_start_matches("eigen-"))
    };
    let titles = all
        .iter()
        .zip(&found)
        .map(|(&(_, scheme), [_, counted])| title(schemes[scheme], counted));
    let narrowest = narrowest(titles, NARROWEST - 4.0);
    let grid = Grid::new(sets.len(), schemes.len(), inputs.width, BAR, narrowest);
    let highest = found.iter().map(|[drawn, _]| drawn.peaks[0].value).fold(0.0, f64::max);
    let mut table = Table::new(columns());
    let valences: Vec<String> = sets.iter().map(|spokes| spokes.valence().to_string()).collect();
    let height = grid.height(ASPECT * grid.across) + HEADING;
    let mut figure = Figure::new(inputs.width, height, "Blending functions with knot intervals").colour_bar(&scale);
    let rows = if sets.len() > 1 { "rows: " } else { "" };
    figure = figure.heading(format!("{rows}$N$ = {}; after each name: maxima", valences.join(", ")));
    for (&(set, scheme), [drawn, counted]) in all.iter().zip(&found) {
        table.push(row(schemes[scheme], &sets[set], counted));
        let (at_row, at_column) = grid.place(set, scheme);
        let panel = Panel::new(surface(drawn, highest, &scale)).title(title(schemes[scheme], counted));
        figure = figure.panel(at_row, at_column, panel);
    }
    Ok(vec![Drawing::of(&ENTRY, figure, table)])
}

fn surface(blending: &Blending, highest: f64, scale: &ColourScale) -> Surface {
    let inside = |at: u32| {
        let [x, y, _] = blending.graph[at as usize];
        x.hypot(y) < RADIUS
    };
    // what lies outside is drawn on the rim, where the functions have all but vanished
    let place = |at: u32| {
        let [x, y, z] = blending.graph[at as usize];
        let shrunk = (RADIUS / x.hypot(y)).min(1.0);
        [shrunk * x, shrunk * y, HEIGHT * z]
    };
    let quads = blending.quads().filter_map(|quad| {
        let corners = quad.map(place);
        let value = corners.iter().map(|corner| corner[2]).sum::<f64>() / (4.0 * HEIGHT);
        quad.into_iter().any(inside).then_some((corners, value))
    });
    // a disc needs less room than the square around it, and the peak stands in its middle
    let (side, rise) = (0.74 * RADIUS, RADIUS * VIEW.elevation.to_radians().tan());
    let top = (HEIGHT * highest - rise).max(0.0);
    let mut surface = Surface::new(VIEW)
        .quads(quads, scale)
        .within([[-side, -side, 0.0], [side, side, top]]);
    let thin = Stroke::solid(Colour::WHITE, 0.1);
    for line in blending.lines() {
        let kept = line.into_iter().filter(|&at| inside(at)).map(place);
        surface = surface.line(kept, thin);
    }
    surface
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::{Studies, find};
    use crate::schemes::Tuner;
    use eigenring_figure::Width;

    /// The titles have the counts of the table, for sets of any valence and schemes in any number.
    #[test]
    fn graphs_are_readable_for_any_intervals() {
        let entry = find("blending-functions").unwrap();
        let schemes = entry.default_schemes().unwrap();
        let three = Spokes::new(vec![2.0, 1.0, 1.0], vec![1.0; 3]).unwrap();
        let eleven = Spokes::stationary(vec![1.0; 11]).unwrap();
        let studies = Studies::load(None, &[], &Silent).unwrap();
        for (knots, schemes, width) in [
            (Some(&three), &schemes[..2], Width::One),
            (Some(&eleven), &schemes[3..], Width::Two),
        ] {
            let inputs = Inputs {
                valences: &[],
                lambdas: &[],
                schemes,
                colours: entry.colours,
                range: (0.0, 1.0),
                width,
                sweep: None,
                knots,
                studies: &studies,
                tuner: &Tuner::default(),
            };
            let drawings = build(&inputs).unwrap();
            let layout = drawings[0].figure.layout().unwrap();
            assert!(layout.faults().is_empty(), "{:#?}", layout.faults());
            let csv = drawings[0].data[0].1.render(crate::table::Format::Csv);
            assert_eq!(csv.lines().count(), 1 + schemes.len());
        }
    }
}
