//! What is proven of the lambda-scheme: valence against lambda.
//!
//! A bar for each valence is cut where the status of a requirement changes. Undecided intervals, at kinks
//! of the relaxation, are often narrower than any line: they are hatched, with an outline, which stays
//! visible, and the table has their ends. White is where nothing was examined. The statements are those of
//! docs/certificates.md; they come from `certificates/ranges.csv` of the results. Without that file they
//! are proven on the spot, some seconds a valence, and of many valences only a few are shown.

use super::ranges::{Interval, stored};
use super::valences::{Featured, axis};
use super::{Drawing, FigureEntry, Inputs};
use crate::certificates::TABULATED;
use crate::error::Error;
use crate::progress::each;
use crate::table::Table;
use eigenring_certify::Requirement;
use eigenring_certify::range::{Limits, StencilCurve, prove_range};
use eigenring_figure::{Axis, Chart, Colour, Figure, Fill, Marker, Panel, Side, Stroke, Style};
use eigenring_tune::study::LAMBDA_R1;

pub const ENTRY: FigureEntry = FigureEntry {
    valences: &[3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20],
    ..FigureEntry::new(
        "certificates",
        "where the lambda-scheme's splines are proven C1 and of bounded curvature: valence against lambda",
        "none",
        build,
    )
};

/// The requirements shown, with the titles of their panels.
const SHOWN: [(Requirement, &str); 2] = [(Requirement::C1, "$C^1$"), (Requirement::Bounded, "bounded curvature")];

/// Half the width of a bar, of 1 from valence to valence.
const HALF: f64 = 0.4;

/// The valences shown where more are asked for and none is stored.
const FEW: [usize; 6] = [3, 4, 6, 8, 12, 20];

/// The intervals of a valence, proven now; none where there are no splines.
fn proven(inputs: &Inputs<'_>, valence: usize) -> Result<Vec<Interval>, Error> {
    let Some(entry) = inputs.studies.entry(valence)? else {
        return Ok(Vec::new());
    };
    let lambda = [entry.knots.a, entry.knots.e];
    let certificate = prove_range(valence, StencilCurve::of(&entry), lambda, Limits::default())?;
    let of = |requirement: Requirement| {
        let segments = certificate.required(requirement).into_iter();
        segments.map(move |segment| Interval {
            valence,
            range: TABULATED.to_owned(),
            require: requirement.name().to_owned(),
            from: segment.lambda[0],
            to: segment.lambda[1],
            status: segment.status.to_string(),
        })
    };
    Ok(SHOWN.into_iter().flat_map(|(requirement, _)| of(requirement)).collect())
}

/// The valences of the picture.
fn valences(inputs: &Inputs<'_>) -> Vec<usize> {
    let all = inputs.valences;
    if inputs.studies.ranges.is_some() || all.len() <= FEW.len() {
        return all.to_vec();
    }
    let few: Vec<usize> = all.iter().copied().filter(|valence| FEW.contains(valence)).collect();
    if few.is_empty() { all[..FEW.len()].to_vec() } else { few }
}

fn intervals(inputs: &Inputs<'_>, valences: &[usize]) -> Result<Vec<Interval>, Error> {
    let known = stored(inputs.studies.ranges.as_deref())?;
    let of = |&valence: &usize| {
        let mut here: Vec<Interval> = known.iter().filter(|row| row.valence == valence).cloned().collect();
        if here.is_empty() {
            here = proven(inputs, valence)?;
        }
        Ok::<Vec<Interval>, Error>(here)
    };
    let found: Vec<Vec<Interval>> = each(inputs.tuner.progress, "proofs", valences, of)?;
    let shown = |row: &Interval| SHOWN.iter().any(|(requirement, _)| requirement.name() == row.require);
    Ok(found.into_iter().flatten().filter(shown).collect())
}

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    let valences = valences(inputs);
    let (intervals, featured) = (intervals(inputs, &valences)?, Featured::of(&valences, inputs)?);
    let (height, second) = if inputs.is_wide() {
        (92.0, (0, 1))
    } else {
        (170.0, (1, 0))
    };
    let mut figure = Figure::new(
        inputs.width,
        height,
        "Proven properties of the lambda-scheme, valence against lambda",
    );
    for ((requirement, title), (row, column)) in SHOWN.into_iter().zip([(0, 0), second]) {
        let of = intervals.iter().filter(|row| row.require == requirement.name());
        let panel = Panel::new(chart(&valences, of, &featured)).title(title);
        figure = figure.panel(row, column, panel);
    }
    Ok(vec![Drawing {
        stem: ENTRY.name.to_owned(),
        figure: figure.legend(Side::Bottom),
        data: vec![
            ("", interval_table(&intervals)),
            ("featured", Featured::table(&featured, &[], |_| Vec::new())),
        ],
    }])
}

/// Fill and outline of a status: light, dark, and hatched with a dark outline, also on a grey print.
fn look(status: &str) -> (Fill, Stroke) {
    let (light, dark) = (
        Colour::line(3).mix(Colour::WHITE, 0.6),
        Colour::line(1).mix(Colour::INK, 0.3),
    );
    match status {
        "proven" => (Fill::Plain(light), Stroke::solid(Colour::line(3), 0.1)),
        "refuted" => (Fill::Plain(dark), Stroke::solid(dark, 0.1)),
        _ => (Fill::Hatched(Colour::INK), Stroke::solid(Colour::INK, 0.3)),
    }
}

/// The lambdas shown: all that are examined, with room for the markers at their ends.
const SHOWN_LAMBDAS: (f64, f64) = (0.12, 0.93);

fn chart<'a>(valences: &[usize], intervals: impl Iterator<Item = &'a Interval>, featured: &[Featured]) -> Chart {
    let mut chart = Chart::new(axis(valences), Axis::new("subdominant eigenvalue $λ$", SHOWN_LAMBDAS));
    // undecided ones last: on top of their neighbours
    let mut bars: Vec<&Interval> = intervals.collect();
    bars.sort_by_key(|bar| {
        ["proven", "refuted"]
            .iter()
            .position(|status| *status == bar.status)
            .unwrap_or(2)
    });
    for bar in bars {
        let (left, right) = (bar.valence as f64 - HALF, bar.valence as f64 + HALF);
        let corners = [[left, bar.from], [right, bar.from], [right, bar.to], [left, bar.to]];
        let (fill, stroke) = look(&bar.status);
        chart = chart.outline(corners, stroke, Some(fill)).label(bar.status.clone());
    }
    let points = |value: &dyn Fn(&Featured) -> Option<f64>| -> Vec<[f64; 2]> {
        let point = |row: &Featured| Some([row.valence as f64, value(row)?]);
        featured.iter().filter_map(point).collect()
    };
    chart
        .series(
            points(&|row| row.lambda_r2),
            Style::points(Marker::Diamond, Colour::INK),
        )
        .label("$λ_{r2}$")
        .series(
            points(&|row| row.lambda_c),
            Style::points(Marker::Triangle, Colour::INK),
        )
        .label("$λ_C^*$")
        .series(
            points(&|row| Some(row.lambda_l)),
            Style::points(Marker::Circle, Colour::INK),
        )
        .label("$λ_l$")
        .series(points(&|_| Some(LAMBDA_R1)), Style::points(Marker::Square, Colour::INK))
        .label("$λ_{r1}$")
}

fn interval_table(intervals: &[Interval]) -> Table {
    let mut table = Table::new(["valence", "require", "from", "to", "status"]);
    for row in intervals {
        table.push(vec![
            row.valence.into(),
            row.require.clone().into(),
            row.from.into(),
            row.to.into(),
            row.status.clone().into(),
        ]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statuses_differ_in_grey_and_undecided_is_not_white() {
        let grey = |status: &str| match look(status).0 {
            Fill::Plain(colour) => colour.grey(),
            Fill::Hatched(_) => f64::NAN,
        };
        assert!(grey("undecided").is_nan() && grey("proven") > grey("refuted") + 0.2 && grey("proven") < 0.95);
    }
}
