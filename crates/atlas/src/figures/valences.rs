//! What the figures over the valence share: the axis, and the featured lambdas of Ma, Wang and Ma (2023),
//! Table 1.

use super::Inputs;
use crate::error::Error;
use crate::results::FEATURED;
use crate::table::{Cell, Table};
use eigenring_figure::Axis;
use eigenring_scheme::lambda::Relaxation;
use eigenring_tune::study::{LAMBDA_A, LAMBDA_M, LAMBDA_R1, lambda_catmull_clark};

/// The axis of these valences, with about eight ticks on multiples of a step.
pub fn axis(valences: &[usize]) -> Axis {
    let first = valences.iter().copied().min().unwrap_or(3);
    let last = valences.iter().copied().max().unwrap_or(3);
    let step = (last - first).div_ceil(8).max(1);
    let ticks = (first..=last).filter(|valence| valence % step == 0);
    Axis::new("valence $N$", (first as f64 - BESIDE, last as f64 + BESIDE)).with_integers(ticks)
}

/// How far the axis goes on beyond the first and the last valence.
const BESIDE: f64 = 0.7;

/// The eigenvalue of the third ring and those beyond, which lambda has to exceed.
pub const LAMBDA_C1: f64 = 0.125;

/// The featured lambdas of one valence; those that are tuned exist for tabulated valences only.
#[derive(Clone, Copy, Debug)]
pub struct Featured {
    pub valence: usize,
    pub lambda_l: f64,
    pub lambda_cc: f64,
    pub lambda_c: Option<f64>,
    pub lambda_r2: Option<f64>,
}

impl Featured {
    /// Those of the valences given.
    pub fn of(valences: &[usize], inputs: &Inputs<'_>) -> Result<Vec<Self>, Error> {
        let row = |&valence: &usize| {
            let entry = inputs.studies.entry(valence)?;
            Ok(Featured {
                valence,
                lambda_l: Relaxation::new(valence)?.lambda_l(),
                lambda_cc: lambda_catmull_clark(valence),
                lambda_c: entry.as_ref().map(|entry| entry.lambda_optimal),
                lambda_r2: entry.as_ref().map(|entry| entry.lambda_r2),
            })
        };
        valences.iter().map(row).collect()
    }

    /// A table of them, after the paper's bound of C1, with further columns.
    pub fn table(rows: &[Self], further: &[&str], cells: impl Fn(&Self) -> Vec<Cell>) -> Table {
        let columns = ["valence", "lambda_C1"].into_iter().chain(FEATURED);
        let columns = columns.chain(further.iter().copied());
        let mut table = Table::new(columns);
        for row in rows {
            let values = [
                Some(LAMBDA_R1),
                Some(LAMBDA_A),
                Some(row.lambda_l),
                Some(LAMBDA_M),
                Some(row.lambda_cc),
                row.lambda_c,
                row.lambda_r2,
            ];
            let own = [row.valence.into(), LAMBDA_C1.into()]
                .into_iter()
                .chain(values.map(Cell::from));
            table.push(own.chain(cells(row)).collect());
        }
        table
    }
}
