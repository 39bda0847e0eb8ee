//! Faces as bicubic patches: tables that depend on the scheme, the valence and the rule only, and are shared
//! by all faces of a kind.

use crate::Error;
use crate::patch::{Control, Data, FUNCTIONS, Jets, Rule, bicubic, with_intervals};
use eigenring_nonuniform::{Element, Piece};
use eigenring_spectral::Matrix;
use eigenring_spline::quadrature::gauss_legendre;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Gauss's tensor rule.
pub(crate) fn gauss(order: usize) -> Vec<([f64; 2], f64)> {
    let nodes = line_rule(order);
    let pairs = nodes
        .iter()
        .flat_map(|&(t, v)| nodes.iter().map(move |&(s, w)| ([s, t], v * w)));
    pairs.collect()
}

/// The Gauss rule on the unit interval.
pub(crate) fn line_rule(order: usize) -> Vec<(f64, f64)> {
    gauss_legendre(order)
        .iter()
        .map(|node| (node.at, node.weight))
        .collect()
}

/// The patches of a face.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    /// Which control points of the numbering the face depends on.
    pub columns: Vec<usize>,
    pub annuli: Vec<Annulus>,
    /// Of a face at an extraordinary vertex, the weights of the functions' coefficients in the limit there.
    pub limit: Option<Vec<f64>>,
}

/// Patches that share control points.
#[derive(Clone, Debug)]
pub(crate) struct Annulus {
    /// The control points in those of the face; `None` if they are the face's own.
    pub lift: Option<Lift>,
    pub patches: Vec<Patch>,
}

/// Control points, by rows, as combinations of those of a face: for values, and up to one that all share for
/// derivatives.
#[derive(Clone, Debug)]
pub(crate) struct Lift {
    pub values: Matrix<f64>,
    pub derivatives: Matrix<f64>,
}

/// A bicubic patch.
#[derive(Clone, Debug)]
pub(crate) struct Patch {
    /// Its control points among those of the annulus.
    pub rows: [usize; FUNCTIONS],
    pub jets: Arc<Jets>,
    /// A factor of the weights.
    pub factor: f64,
}

/// The control points of an annulus.
struct Points {
    values: Vec<Data>,
    derivatives: Vec<Data>,
}

impl Table {
    /// The points of its rule in all patches.
    pub fn points(&self) -> usize {
        let patches = self.annuli.iter().flat_map(|annulus| &annulus.patches);
        patches.map(|patch| patch.jets.weights.len()).sum()
    }

    /// All patches with their control points, given those of the face.
    pub fn patches(
        &self,
        face: &[Data],
        mut visit: impl FnMut(&Patch, &Control) -> Result<(), Error>,
    ) -> Result<(), Error> {
        self.annuli
            .iter()
            .try_for_each(|annulus| annulus.patches(face, &mut visit))
    }
}

impl Annulus {
    /// Its patches with their control points, given those of the face.
    pub fn patches(
        &self,
        face: &[Data],
        mut visit: impl FnMut(&Patch, &Control) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let lifted = self.lift.as_ref().map(|lift| Points {
            values: lifted(&lift.values, face),
            derivatives: lifted(&lift.derivatives, face),
        });
        let [values, derivatives] = match &lifted {
            Some(points) => [&points.values[..], &points.derivatives[..]],
            None => [face; 2],
        };
        self.patches.iter().try_for_each(|patch| {
            let control = Control {
                values: patch.rows.map(|row| values[row]),
                derivatives: patch.rows.map(|row| derivatives[row]),
            };
            visit(patch, &control)
        })
    }
}

fn lifted(rows: &Matrix<f64>, face: &[Data]) -> Vec<Data> {
    let of = |row: usize| {
        let mut sum = [0.0; 4];
        for (weight, point) in rows.row(row).iter().zip(face) {
            sum.iter_mut().zip(point).for_each(|(sum, x)| *sum += weight * x);
        }
        sum
    };
    (0..rows.rows()).map(of).collect()
}

/// The product A B, of an A with many zeros.
pub(crate) fn combined(a: &Matrix<f64>, b: &Matrix<f64>) -> Matrix<f64> {
    let mut entries = vec![vec![0.0; b.columns()]; a.rows()];
    for (i, row) in entries.iter_mut().enumerate() {
        for (k, &weight) in a.row(i).iter().enumerate().filter(|(_, w)| **w != 0.0) {
            row.iter_mut()
                .zip(b.row(k))
                .for_each(|(sum, entry)| *sum += weight * entry);
        }
    }
    Matrix::from_rows(entries, b.columns())
}

/// Basis functions at the points of one rule, by ratios of knot intervals.
pub(crate) struct Known<'a> {
    rule: &'a Rule,
    pub uniform: Arc<Jets>,
    others: BTreeMap<[[u64; 5]; 2], Arc<Jets>>,
}

impl<'a> Known<'a> {
    pub fn new(rule: &'a Rule) -> Self {
        Known {
            rule,
            uniform: Arc::new(Jets::new(rule, bicubic)),
            others: BTreeMap::new(),
        }
    }

    fn with(&mut self, intervals: [[f64; 5]; 2]) -> Arc<Jets> {
        let key = intervals.map(|five| five.map(|d| (d / five[2]).to_bits()));
        let own = || Arc::new(Jets::new(self.rule, |s, t| with_intervals(intervals, s, t)));
        Arc::clone(self.others.entry(key).or_insert_with(own))
    }
}

/// A face without an extraordinary vertex in its grid.
pub(crate) fn far(jets: &Arc<Jets>) -> Table {
    Table {
        columns: (0..FUNCTIONS).collect(),
        annuli: vec![Annulus {
            lift: None,
            patches: vec![Patch {
                rows: std::array::from_fn(|k| k),
                jets: Arc::clone(jets),
                factor: 1.0,
            }],
        }],
        limit: None,
    }
}

/// Whether combinations are the points themselves.
fn is_own(rows: &Matrix<f64>) -> bool {
    let entry = |i: usize, j: usize| rows[(i, j)] == f64::from(u8::from(i == j));
    rows.columns() == FUNCTIONS && (0..FUNCTIONS).all(|i| (0..FUNCTIONS).all(|j| entry(i, j)))
}

/// An element with knot intervals.
pub(crate) fn element(of: &Element, known: &mut Known<'_>, depth: usize, scaled: bool) -> Table {
    let (pieces, limit) = of.pieces(depth);
    let read = |column: &usize| {
        pieces
            .iter()
            .any(|piece| (0..FUNCTIONS).any(|k| piece.values[(k, *column)] != 0.0))
    };
    let columns: Vec<usize> = (0..of.columns()).filter(read).collect();
    let part = |m: &Matrix<f64>| Matrix::from_fn(FUNCTIONS, columns.len(), |i, j| m[(i, columns[j])]);
    let annulus = |piece: &Piece| {
        let factor = match scaled && piece.is_last {
            true => 1.0 / (1.0 - of.left()),
            false => 1.0,
        };
        let lift = Lift {
            values: part(&piece.values),
            derivatives: part(&piece.derivatives),
        };
        Annulus {
            lift: (!is_own(&lift.values)).then_some(lift),
            patches: vec![Patch {
                rows: std::array::from_fn(|k| k),
                jets: known.with(piece.intervals),
                factor,
            }],
        }
    };
    Table {
        annuli: pieces.iter().map(annulus).collect(),
        limit: limit.map(|weights| columns.iter().map(|&column| weights[column]).collect()),
        columns,
    }
}
