//! Spline tables beyond those of the paper: for larger valences, and with less loss.

use crate::error::Error;
use crate::progress::Progress;
use crate::results::tables;
use crate::run::{Parameters, studies};
use crate::table::{Format, Table};
use eigenring_tune::study::{Knots, Study, paper_row};
use eigenring_tune::sweep::{Options, Range};

fn run(valences: Vec<usize>, knots: Knots, progress: &dyn Progress) -> Result<Vec<Study>, Error> {
    let parameters = Parameters::new(valences, knots, &Options::default(), &Range::default());
    studies(&parameters, &(), progress)
}

/// The tables of a run whose names are given, as files with names of their own.
fn files(studies: &[Study], prefix: &str, names: &[(&str, &str)]) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    for (name, table) in tables(studies) {
        if let Some((_, own)) = names.iter().find(|(known, _)| *known == name) {
            files.push((format!("{prefix}_{own}.csv"), table.render(Format::Csv).into_bytes()));
        }
    }
    files
}

/// The tables of the valences from 21 to 64.
pub(super) fn large(progress: &dyn Progress) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let studies = run((21..=64).collect(), Knots::Detected, progress)?;
    let names = [
        ("table1_featured_lambda", "featured"),
        ("table5_f2_coefficients", "f2"),
        ("table6_f3_coefficients", "f3"),
        ("knots", "knots"),
        ("accuracy", "accuracy"),
    ];
    Ok(files(&studies, "large", &names))
}

/// What the splines of the paper's valences lose with the knots of the tables, with those of the paper, and
/// with knots and a fit that lose least; and the coefficients of the last.
pub(super) fn sharp(progress: &dyn Progress) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let kinds = [
        ("detected", Knots::Detected),
        ("paper", Knots::Paper),
        ("sharp", Knots::Sharp),
    ];
    let (table, all) = losses(&kinds, progress)?;
    let names = [
        ("table5_f2_coefficients", "f2"),
        ("table6_f3_coefficients", "f3"),
        ("knots", "knots"),
        ("accuracy", "accuracy"),
    ];
    let mut written = vec![("sharp.csv".to_owned(), table.render(Format::Csv).into_bytes())];
    written.extend(files(&all[2], "sharp", &names));
    Ok(written)
}

/// What the embedded splines of the paper's valences lose, and those with more coefficients.
pub(super) fn fine(progress: &dyn Progress) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let (table, _) = losses(&[("detected", Knots::Detected), ("fine", Knots::Fine)], progress)?;
    Ok(vec![("fine.csv".to_owned(), table.render(Format::Csv).into_bytes())])
}

/// What splines of several kinds lose at the paper's valences, a row for each valence and kind; and the runs.
fn losses(kinds: &[(&str, Knots)], progress: &dyn Progress) -> Result<(Table, Vec<Vec<Study>>), Error> {
    let valences: Vec<usize> = (3..=20).collect();
    let mut table = Table::new([
        "valence",
        "knots",
        "coefficients",
        "lambda_b",
        "lambda_d",
        "excess",
        "excess_at",
        "excess_overall",
    ]);
    let mut all = Vec::new();
    for &(_, knots) in kinds {
        all.push(run(valences.clone(), knots, progress)?);
    }
    for index in 0..valences.len() {
        for ((name, _), studies) in kinds.iter().zip(&all) {
            let study = &studies[index];
            if *name == "paper" && paper_row(study.valence).is_none() {
                continue;
            }
            let (knots, accuracy) = (&study.knots.values, &study.accuracy);
            table.push(vec![
                study.valence.into(),
                (*name).into(),
                knots.dimension().into(),
                knots.b.into(),
                knots.d.into(),
                accuracy.excess.into(),
                accuracy.excess_at.into(),
                accuracy.excess_overall.into(),
            ]);
        }
    }
    Ok((table, all))
}
