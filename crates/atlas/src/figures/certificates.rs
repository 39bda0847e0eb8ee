//! What is proven of the lambda-scheme: valence against lambda.
//!
//! A bar for each valence is cut where the status of a requirement changes. Undecided intervals, at kinks of
//! the relaxation, are often narrower than any line: they are drawn with an outline, which stays visible, and
//! the table has their ends. The statements are those of docs/certificates.md; they come from
//! `certificates/ranges.csv` of the results. Without that file they are proven on the spot, some seconds a
//! valence, and of many valences only a few are shown.

use super::{Drawing, Entry, Inputs};
use crate::certificates::TABULATED;
use crate::error::Error;
use crate::progress::each;
use crate::table::Table;
use eigenring_certify::Requirement;
use eigenring_certify::range::{Curve, Limits, prove_range};
use eigenring_figure::{Axis, Chart, Colour, Figure, Marker, Panel, Side, Stroke, Style, Width};
use eigenring_scheme::lambda::Relaxation;
use eigenring_tune::study::LAMBDA_R1;
use serde::Deserialize;

pub const ENTRY: Entry = Entry {
    name: "certificates",
    title: "where the lambda-scheme's splines are proven C1 and of bounded curvature: valence against lambda",
    reference: "none",
    valences: &[3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20],
    lambdas: &[],
    schemes: None,
    colours: None,
    range: false,
    studies: false,
    width: Width::Two,
    build,
};

/// The requirements shown, with the titles of their panels.
const SHOWN: [(Requirement, &str); 2] = [(Requirement::C1, "$C^1$"), (Requirement::Bounded, "bounded curvature")];

/// Half the width of a bar, of 1 from valence to valence.
const HALF: f64 = 0.4;

/// The valences shown where more are asked for and none is stored.
const FEW: [usize; 6] = [3, 4, 6, 8, 12, 20];

/// A line of `ranges.csv`, of which the witness is not shown.
#[derive(Clone, Debug, PartialEq, Deserialize)]
struct Interval {
    valence: usize,
    range: String,
    require: String,
    from: f64,
    to: f64,
    status: String,
}

/// The intervals stored in a text of the form of `ranges.csv`.
fn stored(text: &str) -> Result<Vec<Interval>, Error> {
    let rows = csv::Reader::from_reader(text.as_bytes()).into_deserialize();
    let rows: Result<Vec<Interval>, csv::Error> = rows.collect();
    let rows = rows.map_err(|error| Error::content(error.to_string()).in_file("certificates/ranges.csv".as_ref()))?;
    Ok(rows.into_iter().filter(|row| row.range == TABULATED).collect())
}

/// The intervals of a valence, proven now; none where there are no splines.
fn proven(inputs: &Inputs<'_>, valence: usize) -> Result<Vec<Interval>, Error> {
    let Some(entry) = inputs.studies.entry(valence)? else {
        return Ok(Vec::new());
    };
    let lambda = [entry.knots.a, entry.knots.e];
    let curve = Curve::Splines {
        knots: entry.knots,
        f2: entry.f2.to_vec(),
        f3: entry.f3.to_vec(),
    };
    let certificate = prove_range(valence, curve, lambda, Limits::default())?;
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
    let known = inputs
        .studies
        .ranges
        .as_deref()
        .map(stored)
        .transpose()?
        .unwrap_or_default();
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

/// The lambdas that are marked.
struct Featured {
    valence: usize,
    lambda_l: f64,
    lambda_c: Option<f64>,
    ends: [Option<f64>; 2],
}

fn featured(inputs: &Inputs<'_>, valences: &[usize]) -> Result<Vec<Featured>, Error> {
    let of = |&valence: &usize| {
        let entry = inputs.studies.entry(valence)?;
        Ok(Featured {
            valence,
            lambda_l: Relaxation::new(valence)?.lambda_l(),
            lambda_c: entry.as_ref().map(|entry| entry.lambda_optimal),
            ends: [
                entry.as_ref().map(|_| LAMBDA_R1),
                entry.as_ref().map(|entry| entry.lambda_r2),
            ],
        })
    };
    valences.iter().map(of).collect()
}

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    let valences = valences(inputs);
    let (intervals, featured) = (intervals(inputs, &valences)?, featured(inputs, &valences)?);
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
            ("featured", featured_table(&featured)),
        ],
    }])
}

/// Fill and outline of a status: light, dark, and white with a dark outline, also on a grey print.
fn look(status: &str) -> (Colour, Stroke) {
    let (green, red) = (Colour::line(3), Colour::line(1));
    match status {
        "proven" => (green.mix(Colour::WHITE, 0.6), Stroke::solid(green, 0.1)),
        "refuted" => (red.mix(Colour::INK, 0.3), Stroke::solid(red.mix(Colour::INK, 0.3), 0.1)),
        _ => (Colour::WHITE, Stroke::solid(Colour::INK, 0.3)),
    }
}

fn chart<'a>(valences: &[usize], intervals: impl Iterator<Item = &'a Interval>, featured: &[Featured]) -> Chart {
    let (first, last) = (
        valences.iter().copied().min().unwrap_or(3),
        valences.iter().copied().max().unwrap_or(3),
    );
    // about eight ticks, on multiples of the step
    let step = (last - first).div_ceil(8).max(1);
    let ticks = (first..=last).filter(|valence| valence % step == 0);
    let x = Axis::new("valence $N$", (first as f64 - 0.7, last as f64 + 0.7)).with_integers(ticks);
    let mut chart = Chart::new(x, Axis::new("subdominant eigenvalue $λ$", (0.1, 0.95)));
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
        .series(points(&|row| row.ends[1]), Style::points(Marker::Diamond, Colour::INK))
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
        .series(points(&|row| row.ends[0]), Style::points(Marker::Square, Colour::INK))
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

fn featured_table(featured: &[Featured]) -> Table {
    let mut table = Table::new(["valence", "lambda_r1", "lambda_l", "lambda_C", "lambda_r2"]);
    for row in featured {
        table.push(vec![
            row.valence.into(),
            row.ends[0].into(),
            row.lambda_l.into(),
            row.lambda_c.into(),
            row.ends[1].into(),
        ]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_ranges_over_all_lambdas_are_read() {
        let text = "valence,range,require,from,to,status,witness\n\
            3,recommended,c1,0.2,0.5,proven,\n\
            3,tabulated,c1,0.15,0.9,proven,\n\
            3,tabulated,bounded,0.15,0.35,refuted,\"s > 1, here\"\n";
        let rows = stored(text).unwrap();
        assert_eq!(rows.len(), 2);
        assert_eq!((rows[1].to, rows[1].status.as_str()), (0.35, "refuted"));
        assert!(matches!(
            stored("valence,range\nx,tabulated\n"),
            Err(Error::InFile { .. })
        ));
    }

    #[test]
    fn statuses_differ_in_grey() {
        let grey = |status: &str| look(status).0.grey();
        assert!(grey("undecided") > grey("proven") + 0.1 && grey("proven") > grey("refuted") + 0.2);
    }
}
