//! Sign changes of the Gauss curvature, with and without the weight: Ma, Wang and Ma (2023), Fig. 13.
//!
//! K_m (Eq. 33) adds up how far the Gauss curvatures of the three second-order maps reach to the wrong side
//! of zero. The paper compares its scheme with that of Ma and Ma (2019), which minimises the unweighted
//! objective; here both are tuned at the same lambda in the same domain.

use super::valences::axis;
use super::{Drawing, FigureEntry, Inputs};
use crate::error::Error;
use crate::progress::each;
use crate::table::{Cell, Table};
use eigenring_figure::{Axis, Chart, Figure, Marker, Panel, Side, Style, Width, range_of};
use eigenring_tune::objective::Settings;
use eigenring_tune::sweep::{Options, Problem};

pub const ENTRY: FigureEntry = FigureEntry {
    valences: &[3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20],
    lambdas: &[eigenring_tune::study::LAMBDA_A],
    width: Width::One,
    ..FigureEntry::new(
        "curvature-sign",
        "K_m, wrong signs of the Gauss curvature, against the valence: weighted and unweighted tuning",
        "Ma, Wang and Ma 2023, Fig. 13",
        build,
    )
};

/// K_m and the stencil that has it.
struct Found {
    f2: f64,
    f3: f64,
    sign_change: f64,
}

struct Row {
    valence: usize,
    lambda: f64,
    unweighted: Found,
    weighted: Found,
    /// That of the splines, where there are any.
    splines: Option<Found>,
}

fn row(valence: usize, lambda: f64, inputs: &Inputs<'_>) -> Result<Row, Error> {
    let options = inputs.studies.options();
    let found = |problem: &Problem, f2, f3| -> Result<Found, Error> {
        let sign_change = problem.objective.parts(f2, f3)?.sign_change();
        Ok(Found { f2, f3, sign_change })
    };
    let tuned = |weighted: bool| {
        let settings = Settings {
            weighted,
            ..options.settings
        };
        let problem = Problem::new(valence, lambda, &Options { settings, ..options })?;
        let search = problem.search(options.starts)?;
        let best = search.lowest();
        found(&problem, best.f2, best.f3)
    };
    let splines = match inputs.studies.entry(valence)? {
        Some(entry) if (entry.knots.a..=entry.knots.e).contains(&lambda) => {
            let (f2, f3) = entry.weights(lambda)?;
            Some(found(&Problem::new(valence, lambda, &options)?, f2, f3)?)
        }
        _ => None,
    };
    Ok(Row {
        valence,
        lambda,
        unweighted: tuned(false)?,
        weighted: tuned(true)?,
        splines,
    })
}

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    inputs.lambdas.iter().map(|&lambda| draw(lambda, inputs)).collect()
}

fn draw(lambda: f64, inputs: &Inputs<'_>) -> Result<Drawing, Error> {
    let rows: Vec<Row> = each(inputs.tuner.progress, "stencils", inputs.valences, |&valence| {
        row(valence, lambda, inputs)
    })?;
    type Value = fn(&Row) -> f64;
    let series: [(&str, usize, Marker, Value); 3] = [
        ("unweighted", 1, Marker::Square, |row| row.unweighted.sign_change),
        ("weighted", 0, Marker::Circle, |row| row.weighted.sign_change),
        ("weighted, splines", 3, Marker::Cross, |row| {
            row.splines.as_ref().map_or(f64::NAN, |found| found.sign_change)
        }),
    ];
    let values = rows
        .iter()
        .flat_map(|row| series.iter().map(move |(_, _, _, value)| value(row)));
    let (_, top) = range_of(values.chain([0.0]), 0.06).unwrap_or((0.0, 1.0));
    let mut chart = Chart::new(
        axis(inputs.valences),
        Axis::new("$K_m$", (-0.03 * top, top)).with_grid(),
    );
    for (name, colour, marker, value) in series {
        let points = rows.iter().map(|row| [row.valence as f64, value(row)]);
        chart = chart.series(points, Style::line(colour).marked(marker)).label(name);
    }
    let stem = match ENTRY.lambdas.contains(&lambda) {
        true => ENTRY.name.to_owned(),
        false => format!("{}-lambda{lambda}", ENTRY.name),
    };
    let figure = Figure::new(
        inputs.width,
        66.0,
        "Sign changes of the Gauss curvature against the valence",
    )
    .panel(
        0,
        0,
        Panel::new(chart).title(format!("$λ$ = {lambda}")).legend(Side::Bottom),
    );
    Ok(Drawing {
        stem,
        figure,
        data: vec![("", table(&rows))],
    })
}

fn table(rows: &[Row]) -> Table {
    let mut table = Table::new([
        "valence",
        "lambda",
        "unweighted",
        "unweighted_f2",
        "unweighted_f3",
        "weighted",
        "weighted_f2",
        "weighted_f3",
        "splines",
        "splines_f2",
        "splines_f3",
    ]);
    for row in rows {
        let splines = row.splines.as_ref();
        let mut cells: Vec<Cell> = vec![row.valence.into(), row.lambda.into()];
        for found in [&row.unweighted, &row.weighted] {
            cells.extend([found.sign_change, found.f2, found.f3].map(Cell::from));
        }
        cells.push(splines.map(|found| found.sign_change).into());
        cells.push(splines.map(|found| found.f2).into());
        cells.push(splines.map(|found| found.f3).into());
        table.push(cells);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::Studies;
    use crate::progress::Silent;
    use crate::schemes::Tuner;

    #[test]
    fn the_weight_lessens_wrong_signs() {
        let studies = Studies::load(None, &[], &Silent).unwrap();
        let inputs = Inputs {
            valences: &[5, 6, 8],
            lambdas: ENTRY.lambdas,
            schemes: &[],
            colours: None,
            range: (0.15, 0.9),
            width: Width::One,
            sweep: None,
            knots: None,
            studies: &studies,
            tuner: &Tuner::default(),
        };
        for &valence in inputs.valences {
            let row = row(valence, 0.39, &inputs).unwrap();
            assert!(row.weighted.sign_change <= row.unweighted.sign_change, "N = {valence}");
        }
    }
}
