//! How much of the best lambda is due to the scale of the eigenvectors.
//!
//! The objective of Ma, Wang and Ma (2023, Eq. 11) depends on how eigenvectors are scaled, and their scale is
//! not printed. With each part divided by the mean square of its map's second derivatives
//! ([`Normalisation::Relative`]) none is left. Both are minimised over lambda, f2 and f3, beside each other.

use crate::error::Error;
use crate::progress::{Progress, Silent, each};
use crate::run::minima_over_lambda;
use crate::table::{Format, Table};
use eigenring_tune::global::LambdaMinimum;
use eigenring_tune::objective::{Normalisation, Settings};
use eigenring_tune::sweep::{Options, Problem};

const VALENCES: std::ops::RangeInclusive<usize> = 3..=20;

fn options(normalisation: Normalisation) -> Options {
    Options {
        settings: Settings {
            normalisation,
            ..Settings::default()
        },
        ..Options::default()
    }
}

pub(super) fn files(progress: &dyn Progress) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let valences: Vec<usize> = VALENCES.collect();
    let found = each(progress, "valences", &valences, |&valence| {
        let best = |normalisation| {
            let (found, _) = minima_over_lambda(valence, &options(normalisation), &Silent)?;
            Ok::<LambdaMinimum, Error>(found.optimum().clone())
        };
        Ok::<_, Error>([best(Normalisation::Paper)?, best(Normalisation::Relative)?])
    })?;
    let mut table = Table::new([
        "valence",
        "lambda_C",
        "f2",
        "f3",
        "relative_E",
        "relative_lambda_C",
        "relative_f2",
        "relative_f3",
        "least_relative_E",
        "lambda_difference",
        "f2_difference",
        "f3_difference",
    ]);
    for (&valence, [paper, relative]) in valences.iter().zip(&found) {
        let problem = Problem::new(valence, paper.lambda, &options(Normalisation::Relative))?;
        let (p, r) = (&paper.minimum, &relative.minimum);
        table.push(vec![
            valence.into(),
            paper.lambda.into(),
            p.f2.into(),
            p.f3.into(),
            problem
                .objective
                .value(p.f2, p.f3)
                .map_err(eigenring_tune::sweep::Error::from)?
                .into(),
            relative.lambda.into(),
            r.f2.into(),
            r.f3.into(),
            r.total.into(),
            (relative.lambda - paper.lambda).into(),
            (r.f2 - p.f2).into(),
            (r.f3 - p.f3).into(),
        ]);
    }
    Ok(vec![(
        "normalisation.csv".into(),
        table.render(Format::Csv).into_bytes(),
    )])
}
