//! The leading eigenvalues of one scheme at several levels.

use crate::error::Error;
use crate::table::{Cell, Table};
use eigenring_scheme::families::tension;
use eigenring_spectral::LocalSystem;

/// A scheme.
#[derive(Clone, Debug)]
pub struct Case {
    pub order: usize,
    pub valence: usize,
    pub u0: f64,
}

impl Case {
    /// All combinations: by order, then valence, then tension.
    pub fn all(orders: &[usize], valences: &[usize], tensions: &[f64]) -> Vec<Case> {
        let mut cases = Vec::new();
        for &order in orders {
            for &valence in valences {
                cases.extend(tensions.iter().map(|&u0| Case { order, valence, u0 }));
            }
        }
        cases
    }
}

/// The eigenvalues below 1 of the matrix of one level.
#[derive(Clone, Debug)]
pub struct Row {
    pub case: Case,
    /// The level; `None` is the limit level.
    pub level: Option<usize>,
    /// The tension at this level.
    pub u: f64,
    /// |lambda_1|, |lambda_2|, |lambda_3|; the corners of a triangle alone have no lambda_3.
    pub moduli: [Option<f64>; 3],
    /// Their Fourier indices, folded to k <= N/2.
    pub indices: [Option<usize>; 3],
    /// The largest modulus that further rings add.
    pub outer: f64,
    /// The dominant eigenvalue is 1 and simple.
    dominant: bool,
}

/// Moduli closer than this are equal: eigenvalues are accurate to 1e-13 or so where they are
/// well-conditioned, and a gap that is not seen to be larger is none.
const EQUAL: f64 = 1e-10;

impl Row {
    /// `|lambda_2|` less the largest modulus below it, further rings included.
    pub fn gap(&self) -> f64 {
        self.moduli[1].unwrap_or(0.0) - self.moduli[2].unwrap_or(0.0).max(self.outer)
    }

    /// Whether `1 = lambda_0 > |lambda_1| = |lambda_2| > |lambda_3|`, further rings included, with the pair
    /// in blocks 1, N-1.
    pub fn holds(&self) -> bool {
        let [Some(first), Some(second), _] = self.moduli else {
            return false;
        };
        let pair = self.indices[0] == Some(1) && self.indices[1] == Some(1);
        self.dominant && first < 1.0 - EQUAL && pair && first - second <= EQUAL && self.gap() > EQUAL
    }
}

/// The rows of a case at the given levels.
///
/// # Errors
/// Those of the scheme and its local systems.
pub fn rows(case: &Case, levels: &[Option<usize>]) -> Result<Vec<Row>, Error> {
    let scheme = tension::<f64>(case.valence, case.order, case.u0)?;
    let rings = scheme.closed_rings()?;
    // one step a level, as the scheme takes them
    let tension_at = |level: usize| (0..level).fold(case.u0, |u, _| ((1.0 + u) / 2.0).sqrt());
    let mut rows: Vec<Row> = Vec::with_capacity(levels.len());
    for &level in levels {
        let u = level.map_or(1.0, tension_at);
        // the rules depend on u alone
        if let Some(same) = rows.iter().find(|row| row.u == u) {
            rows.push(Row { level, ..same.clone() });
            continue;
        }
        let rules = level.map_or(scheme.limit(), |level| scheme.level(level));
        let eigenvalues = LocalSystem::new(rules, rings)?.eigenvalues()?.eigenvalues;
        let leading: Vec<(f64, Option<usize>)> = eigenvalues
            .iter()
            .flat_map(|e| std::iter::repeat_n((e.modulus(), e.fourier), e.multiplicity))
            .take(4)
            .collect();
        let at = |index: usize| leading.get(index).copied();
        rows.push(Row {
            case: case.clone(),
            level,
            u,
            moduli: [1, 2, 3].map(|index| at(index).map(|(modulus, _)| modulus)),
            indices: [1, 2, 3].map(|index| at(index).and_then(|(_, fourier)| fourier)),
            outer: 0.5_f64.powi(case.order as i32 - 2) / (1.0 + u),
            dominant: eigenvalues.first().is_some_and(|one| {
                (one.value.re - 1.0).abs() <= EQUAL && (one.fourier, one.multiplicity) == (Some(0), 1)
            }),
        });
    }
    Ok(rows)
}

/// The rows as they are stored.
pub fn table(rows: &[Row]) -> Table {
    let mut table = Table::new([
        "order", "valence", "u0", "level", "u", "lambda1", "lambda2", "lambda3", "outer", "gap", "index1", "index2",
        "index3", "ok",
    ]);
    for row in rows {
        let mut cells: Vec<Cell> = vec![
            row.case.order.into(),
            row.case.valence.into(),
            row.case.u0.into(),
            row.level.into(),
            row.u.into(),
        ];
        cells.extend(row.moduli.map(Cell::from));
        cells.extend([row.outer.into(), row.gap().into()]);
        cells.extend(row.indices.map(Cell::from));
        cells.push(usize::from(row.holds()).into());
        table.push(cells);
    }
    table
}
