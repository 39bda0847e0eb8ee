//! Eigenvalues by Fourier index: the spectrum of a scheme at a glance.
//!
//! Moduli of the eigenvalues of each Fourier block, by their logarithms, on the smallest closed set of rings
//! that hides none of interest (see [`Sufficient`]); blocks k and N-k have conjugate spectra, so k runs to
//! N/2. A multiple eigenvalue of a block is as many marks side by side; which ones are defective is for the
//! spectrum to say. For bounded curvature lambda is from block 1, mu = lambda^2 (s = 1) from blocks 0 and 2,
//! and all others are smaller (Ma, Wang and Ma 2023, section 3).

use super::grid::Grid;
use super::subject::{Subject, chosen};
use super::{Drawing, FigureEntry, Inputs, along};
use crate::error::Error;
use crate::spectrum::Analysis;
use crate::table::{Cell, Table};
use eigenring_figure::{Anchor, Axis, Chart, Colour, Dash, Figure, Marker, Panel, Side, Stroke, Style, decades_of};
use eigenring_scheme::Corner;
use eigenring_spectral::{Eigenvalue, Spectrum};

pub const ENTRY: FigureEntry = FigureEntry {
    valences: &[5, 8],
    schemes: Some(&["catmull-clark", "doo-sabin", "tension:order=8", "lambda:optimal"]),
    sweep: true,
    ..FigureEntry::new(
        "spectrum",
        "moduli of the eigenvalues by Fourier index; columns: valences, rows: schemes",
        "Doo and Sabin 1978",
        build,
    )
};

/// The narrowest panel, in millimetres: the labels of lambda and mu fit beside the marks.
const NARROWEST: f64 = 70.0;
/// Height of a panel, in millimetres.
const HEIGHT: f64 = 38.0;
/// Room for labels to the right of the last index, relative to that of the indices.
const BESIDE: f64 = 0.36;
/// How far the middle of a label is from its line, relative to the height of the axis: that of lambda stands
/// on it, that of mu hangs from it.
const LIFT: f64 = 0.07;
/// Eigenvalues below this are not drawn: structural zeros, of which there may be many.
const SMALLEST: f64 = 1e-3;

/// How an eigenvalue is marked.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Positive,
    Negative,
    Complex,
    Defective,
}

const KINDS: [(Kind, Marker, usize, &str); 4] = [
    (Kind::Positive, Marker::Circle, 0, "positive"),
    (Kind::Negative, Marker::Square, 1, "negative"),
    (Kind::Complex, Marker::Triangle, 3, "complex"),
    (Kind::Defective, Marker::Cross, 2, "defective"),
];

fn kind(eigenvalue: &Eigenvalue) -> Kind {
    match eigenvalue.value {
        _ if eigenvalue
            .geometric
            .is_some_and(|vectors| vectors < eigenvalue.multiplicity) =>
        {
            Kind::Defective
        }
        value if value.im != 0.0 => Kind::Complex,
        value if value.re < 0.0 => Kind::Negative,
        _ => Kind::Positive,
    }
}

/// What the data say of an eigenvalue.
pub(super) const COLUMNS: [&str; 6] = ["fourier", "re", "im", "modulus", "multiplicity", "geometric"];

/// The cells of [`COLUMNS`].
pub(super) fn cells(e: &Eigenvalue) -> [Cell; 6] {
    [
        e.fourier.into(),
        e.value.re.into(),
        e.value.im.into(),
        e.modulus().into(),
        e.multiplicity.into(),
        e.geometric.into(),
    ]
}

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    if let Some(sweep) = inputs.sweep {
        return along::build(&ENTRY, inputs, sweep);
    }
    let grid = Grid::new(
        inputs.schemes.len(),
        inputs.valences.len(),
        inputs.width,
        0.0,
        NARROWEST,
    );
    let mut figure = Figure::new(inputs.width, grid.height(HEIGHT) + 10.0, "Eigenvalues by Fourier index");
    figure = figure.heading(format!("moduli above {SMALLEST}"));
    let mut table = Table::new(["scheme", "valence"].into_iter().chain(COLUMNS));
    for (column, &valence) in inputs.valences.iter().enumerate() {
        for (row, (subject, argument)) in chosen(inputs, valence)?.iter().zip(inputs.schemes).enumerate() {
            let extended = argument.extended(&Corner::closed(argument.centre()?, valence)?)?;
            let Analysis { system, spectrum, .. } = Analysis::of_rules(&subject.scheme, extended.as_ref(), None, None)?;
            if !system.symmetric() {
                return Err(eigenring_spectral::Error::NotSymmetric.into());
            }
            for e in &spectrum.eigenvalues {
                let mut row = vec![subject.name.as_str().into(), valence.into()];
                row.extend(cells(e));
                table.push(row);
            }
            let (at_row, at_column) = grid.place(row, column);
            let chart = chart(subject, &spectrum);
            figure = figure.panel(at_row, at_column, Panel::new(chart).title(subject.full_title()));
        }
    }
    Ok(vec![Drawing::of(&ENTRY, figure.legend(Side::Bottom), table)])
}

fn chart(subject: &Subject, spectrum: &Spectrum) -> Chart {
    let n = subject.valence;
    let last = n / 2;
    // at most about ten ticks
    let width = last as f64 + 1.2;
    let right = last as f64 + 0.6 + BESIDE * width;
    let x = Axis::new("Fourier index $k$", (-0.6, right)).with_integers((0..=last).step_by(last / 10 + 1));
    let shown = || spectrum.eigenvalues.iter().filter(|e| e.modulus() > SMALLEST);
    // marks and labels have room at both ends
    let (low, _) = decades_of(shown().map(|e| 0.6 * e.modulus())).unwrap_or((SMALLEST, 1.0));
    let (low, high) = (low.max(0.5 * SMALLEST), 2.0);
    let mut chart = Chart::new(x, Axis::log("|eigenvalue|", (low, high)));
    let rule = |dash| Stroke {
        dash,
        ..Stroke::solid(Colour::GREY, 0.2)
    };
    let lambda = spectrum.subdominant().map_or(0.0, Eigenvalue::modulus);
    let mu = spectrum.subsubdominant().map_or(0.0, Eigenvalue::modulus);
    let ratio = spectrum.curvature_ratio().unwrap_or_default();
    for (value, lift, dash, label) in [
        (lambda, LIFT, Dash::Dashed, format!("$λ$ = {lambda:.4}")),
        (mu, -LIFT, Dash::Dotted, format!("$μ$ = {ratio:.3} $λ^2$")),
    ] {
        if value > SMALLEST {
            chart = chart.horizontal(value, rule(dash)).text(
                [right - 0.02 * width, value * (high / low).powf(lift)],
                label,
                Anchor::End,
                Colour::INK,
            );
        }
    }
    for (kind_, marker, colour, label) in KINDS {
        let mut points = Vec::new();
        for e in shown().filter(|e| kind(e) == kind_) {
            // blocks k and N-k stand in one place
            let k = e.fourier.map_or(0, |k| k.min(n - k));
            let count = e.multiplicity / e.blocks;
            let step = (0.16 * last as f64 / 5.0).min(0.8 / count as f64);
            points.extend((0..count).map(|i| [k as f64 + step * (i as f64 - 0.5 * (count - 1) as f64), e.modulus()]));
        }
        if !points.is_empty() {
            chart = chart
                .series(points, Style::points(marker, Colour::line(colour)))
                .label(label);
        }
    }
    chart
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;
    use crate::schemes::Tuner;
    use eigenring_figure::Width;
    use eigenring_spectral::Sufficient;

    fn value(re: f64, im: f64, multiplicity: usize, geometric: usize) -> Eigenvalue {
        Eigenvalue {
            value: eigenring_scheme::Complex::new(re, im),
            fourier: Some(1),
            blocks: 1,
            multiplicity,
            geometric: Some(geometric),
        }
    }

    #[test]
    fn kinds_of_eigenvalues() {
        assert!(kind(&value(0.5, 0.0, 2, 2)) == Kind::Positive);
        assert!(kind(&value(-0.5, 0.0, 2, 2)) == Kind::Negative);
        assert!(kind(&value(0.5, 0.1, 2, 2)) == Kind::Complex);
        assert!(kind(&value(0.5, 0.0, 4, 2)) == Kind::Defective);
    }

    #[test]
    fn tables_hold_the_whole_spectrum() -> Result<(), Error> {
        let studies = crate::figures::Studies::load(None, &[], &Silent)?;
        let (schemes, tuner) = (ENTRY.default_schemes()?, Tuner::default());
        let inputs = Inputs {
            valences: &[3, 20],
            lambdas: &[],
            schemes: &schemes,
            colours: None,
            range: (0.15, 0.9),
            width: Width::One,
            sweep: None,
            knots: None,
            studies: &studies,
            tuner: &tuner,
        };
        let drawing = build(&inputs)?.remove(0);
        let csv = drawing.data[0].1.render(crate::table::Format::Csv);
        let rows: Vec<Vec<&str>> = csv
            .lines()
            .skip(1)
            .map(|line| line.split(',').rev().collect())
            .collect();
        for valence in [3usize, 20] {
            let shown = rows.iter().filter(|row| row[6] == valence.to_string());
            let total: usize = shown.map(|row| row[1].parse::<usize>().unwrap()).sum();
            let expected = schemes.iter().map(|argument| -> Result<usize, Error> {
                let scheme = argument.scheme(valence, &tuner)?;
                let sufficient = Sufficient::new(scheme.limit(), scheme.closed_rings()?)?;
                Ok(sufficient.system.numbering().count())
            });
            assert_eq!(total, expected.sum::<Result<usize, Error>>()?);
        }
        Ok(())
    }
}
