//! The local matrices around an irregular centre, and what splits limit and tangents off.
//!
//! Levels may differ for a while (tension) before all are alike. The functionals of the limit `l0` and of the
//! tangents `L` are the left eigenvectors of the last matrix, carried back: `l0_l = l0_(l+1) S_l`, `L_l =
//! L_(l+1) S_l / lambda`, freed of constants at each step, since their rounding would grow like `lambda^-l`.
//! The maps `R` go forwards from the last matrix's right eigenvectors, `R_(l+1) = S_l R_l / lambda`.

use super::kernel::Kernel;
use super::local::Local;
use super::pair::{EQUAL, Pair, Undefined, block, leading, limit, limit_turning, pair, turning};
use super::patch::Patch;
use super::quarter::{Context, DEEPEST, Path, Quarter, applied};
use super::rotation::Rotation;
use crate::refine::{Row, Step};
use crate::{Error, NONE, Topology};
use eigenring_scheme::{Complex, Table};
use eigenring_spectral::Block;
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

/// One level around a centre at the first corner of a face, on the part around the face that refinement
/// reproduces.
#[derive(Debug)]
pub(crate) struct Stage {
    tables: Vec<Table<f64>>,
    next: Next,
    /// The functional of the limit.
    pub limit: Vec<f64>,
    /// Those of the tangents.
    pub left: Option<[Vec<f64>; 2]>,
    /// The quarters at the second, third and last corner.
    quarters: [Quarter; 3],
    /// The rotation of the last level around many sectors.
    rotation: Option<Rotation>,
    /// The eigenvalues of the matrix after 1, by falling modulus.
    spectrum: OnceLock<Vec<Mode>>,
}

/// How the next part's points are made of those of a part.
#[derive(Debug)]
enum Next {
    /// By rows, a square matrix.
    Rows(Vec<Row>),
    /// Around many sectors, where points beside the centre read all others there: by the passes of the level,
    /// of whose points these are picked.
    Picked(Vec<u32>),
}

/// An eigenvalue, and its left eigenvectors of unit length once they are asked for.
#[derive(Debug)]
struct Mode {
    value: Complex<f64>,
    /// The block, if there is a rotation.
    frequency: usize,
    left: OnceLock<Vec<Vec<Complex<f64>>>>,
}

/// A centre at the first corner of a face.
#[derive(Debug)]
pub(crate) struct Centre {
    /// Levels that differ, then the one that all others equal.
    pub stages: Vec<Arc<Stage>>,
    /// The dominant pair of the last matrix.
    pub lambda: Result<[f64; 2], Undefined>,
    /// The maps R of each level, a row for each point; without a pair none.
    pub right: Vec<Vec<[f64; 2]>>,
    /// What the map of the last level, carried forwards, has beyond its eigenvectors.
    pub beyond: Option<Vec<[f64; 2]>>,
}

/// The rows of refined points over the points before.
pub(super) fn composed(refined: &Step, points: &[u32]) -> Vec<Row> {
    // where the term of a source is in its row, so that long rows take no longer than they have terms
    let mut places: Vec<u32> = Vec::new();
    let row = |&point: &u32| {
        let mut row: Row = vec![(point, 1.0)];
        for table in refined.tables.iter().rev() {
            let mut before = Row::new();
            for (at, weight) in row {
                for (source, &own) in table.row(at as usize) {
                    if source >= places.len() {
                        places.resize(source + 1, NONE);
                    }
                    match places[source] {
                        NONE => {
                            places[source] = before.len() as u32;
                            before.push((source as u32, weight * own));
                        }
                        place => before[place as usize].1 += weight * own,
                    }
                }
            }
            before.iter().for_each(|&(source, _)| places[source as usize] = NONE);
            row = before;
        }
        row
    };
    points.iter().map(row).collect()
}

fn picked<const D: usize>(tables: &[Table<f64>], ids: &[u32], points: &[[f64; D]]) -> Result<Vec<[f64; D]>, Error> {
    let refined = applied(tables, points)?;
    Ok(ids.iter().map(|&id| refined[id as usize]).collect())
}

/// A row times a matrix.
pub(super) fn times(row: &[f64], matrix: &[Row]) -> Vec<f64> {
    let mut product = vec![0.0; row.len()];
    for (terms, weight) in matrix.iter().zip(row) {
        terms.iter().for_each(|&(at, w)| product[at as usize] += weight * w);
    }
    product
}

/// The same for the points picked last of those that passes make.
fn carried_back(tables: &[Table<f64>], ids: &[u32], row: &[f64]) -> Vec<f64> {
    let mut weights = vec![0.0; tables.last().map_or(row.len(), Table::rows)];
    for (&id, weight) in ids.iter().zip(row) {
        weights[id as usize] += weight;
    }
    for (index, table) in tables.iter().enumerate().rev() {
        // the next part has as many points as the part
        let sources = if index == 0 {
            row.len()
        } else {
            tables[index - 1].rows()
        };
        let mut before = vec![0.0; sources];
        for (at, weight) in weights.iter().enumerate() {
            table.row(at).for_each(|(source, own)| before[source] += weight * own);
        }
        weights = before;
    }
    weights
}

impl Stage {
    /// A level, of which `child` is the refined image; `next` is the level after it, and the pair belongs to
    /// that after which all are alike.
    pub fn new(
        local: &Local,
        (refined, topology): (Step, &Topology),
        child: &Local,
        kernel: &Kernel,
        level: usize,
        next: Option<(&Stage, &Result<Pair, Undefined>)>,
    ) -> Result<(Self, Option<Result<Pair, Undefined>>), Error> {
        let quarter = |corner| Quarter::new(local, (&refined, topology), corner, level + 1, kernel);
        let quarters = [quarter(1)?, quarter(2)?, quarter(3)?];
        let ids = child.unknowns();
        let map = |points: &[[f64; 2]]| picked(&refined.tables, ids, points).ok();
        let rows = |points: &[u32]| {
            let ids: Vec<u32> = points.iter().map(|&point| ids[point as usize]).collect();
            composed(&refined, &ids)
        };
        let rotation = match next {
            None => Rotation::find(local, ids.len(), kernel.reach(), rows, map),
            Some(_) => None,
        };
        let turns = rotation.is_some() || next.is_some_and(|(next, _)| matches!(next.next, Next::Picked(_)));
        let matrix = if turns { Vec::new() } else { composed(&refined, ids) };
        let back = |row: &[f64]| match turns {
            true => carried_back(&refined.tables, ids, row),
            false => times(row, &matrix),
        };
        let (limit, left, own) = match next {
            None => {
                let found = match &rotation {
                    Some(rotation) => turning(rotation)?,
                    None => leading(&matrix)?,
                };
                let pair = found.and_then(|found| pair(found, local));
                (
                    rotation.as_ref().map_or_else(|| limit(&matrix), limit_turning),
                    pair.as_ref().ok().map(|pair| pair.left.clone()),
                    Some(pair),
                )
            }
            Some((next, pair)) => {
                let limit = back(&next.limit);
                let left = match (&next.left, pair) {
                    (Some(left), Ok(pair)) => Some([0, 1].map(|i| {
                        let mut row = back(&left[i]);
                        row.iter_mut().for_each(|w| *w /= pair.lambda[i]);
                        let constant: f64 = row.iter().sum();
                        row.iter_mut().zip(&limit).for_each(|(w, l)| *w -= constant * l);
                        row
                    })),
                    _ => None,
                };
                (limit, left, None)
            }
        };
        let stage = Stage {
            next: if turns {
                Next::Picked(ids.to_vec())
            } else {
                Next::Rows(matrix)
            },
            tables: refined.tables,
            limit,
            left,
            quarters,
            rotation,
            spectrum: OnceLock::new(),
        };
        Ok((stage, own))
    }

    /// What the level makes of values at the points of the part, at those of the next one.
    pub fn advanced<const D: usize>(&self, values: &[[f64; D]]) -> Result<Vec<[f64; D]>, Error> {
        let rows = match &self.next {
            Next::Rows(rows) => rows,
            Next::Picked(ids) => return picked(&self.tables, ids, values),
        };
        let row = |row: &Row| {
            let mut sum = [0.0; D];
            for &(at, w) in row {
                (0..D).for_each(|k| sum[k] += w * values[at as usize][k]);
            }
            sum
        };
        Ok(rows.iter().map(row).collect())
    }

    /// The matrix, where there is no rotation.
    fn block(&self) -> Block<f64> {
        match &self.next {
            Next::Rows(rows) => block(rows),
            Next::Picked(_) => block(&[]),
        }
    }

    fn modes(&self) -> &[Mode] {
        self.spectrum.get_or_init(|| {
            let mode = |value, frequency| Mode {
                value,
                frequency,
                left: OnceLock::new(),
            };
            let of_block = |block: Block<f64>, k: usize| -> Vec<Mode> {
                let all = block.eigenvalues().unwrap_or_default();
                all.iter().map(|found| mode(found.value, k)).collect()
            };
            let mut modes: Vec<Mode> = match &self.rotation {
                Some(rotation) => (0..=rotation.sectors() / 2)
                    .flat_map(|k| of_block(rotation.block(k), k))
                    .collect(),
                None => of_block(self.block(), 0),
            };
            if self.rotation.is_some() {
                modes.sort_by(|a, b| b.value.modulus().total_cmp(&a.value.modulus()));
            }
            // 1 itself
            modes.drain(..modes.len().min(1));
            modes
        })
    }

    fn functionals(&self, mode: &Mode) -> Vec<Vec<Complex<f64>>> {
        let block = match &self.rotation {
            Some(rotation) => rotation.block(mode.frequency),
            None => self.block(),
        };
        let space = block.eigenspace(mode.value, mode.frequency);
        space.map(|space| space.left).unwrap_or_default()
    }

    /// Finds the piece in which a place of a quarter (1 to 3) lies.
    pub fn locate(&self, context: Context<'_>, quarter: usize, s: f64, t: f64) -> Result<Path, Error> {
        let mut path = Path::new(quarter, s, t);
        self.quarters[quarter - 1].locate(context, &mut path, DEEPEST)?;
        Ok(path)
    }

    /// The points after this level.
    pub fn refined(&self, points: &[[f64; 3]]) -> Result<Vec<[f64; 3]>, Error> {
        applied(&self.tables, points)
    }

    /// That piece for the points after this level, with its name, and before it others from the same points.
    pub fn patches(
        &self,
        context: Context<'_>,
        refined: &[[f64; 3]],
        quarter: usize,
        s: f64,
        t: f64,
    ) -> Result<Vec<(u64, Patch)>, Error> {
        let mut made = Vec::new();
        let mut path = Path::new(quarter, s, t);
        self.quarters[quarter - 1].patches(context, refined, &mut path, DEEPEST, &mut made)?;
        Ok(made)
    }
}

impl Centre {
    /// The centre of these levels.
    ///
    /// # Errors
    /// Those of the levels' tables.
    pub fn new(stages: Vec<Arc<Stage>>, pair: &Result<Pair, Undefined>) -> Result<Self, Error> {
        let Ok(pair) = pair else {
            return Ok(Centre {
                lambda: pair.as_ref().map(|pair| pair.lambda).map_err(|&why| why),
                stages,
                right: Vec::new(),
                beyond: None,
            });
        };
        let dot = |row: &[f64], map: &[[f64; 2]], k: usize| -> f64 { row.iter().zip(map).map(|(w, r)| w * r[k]).sum() };
        let free = |stage: &Stage, map: &mut Vec<[f64; 2]>| {
            let constant = [0, 1].map(|k| dot(&stage.limit, map, k));
            map.iter_mut().for_each(|r| (0..2).for_each(|k| r[k] -= constant[k]));
        };
        let (mut right, mut beyond) = (vec![pair.right.clone()], None);
        if let (true, Some(left)) = (stages.len() > 1, &stages[0].left) {
            free(&stages[0], &mut right[0]);
            let gram = [0, 1].map(|i| [0, 1].map(|k| dot(&left[i], &right[0], k)));
            let determinant = gram[0][0] * gram[1][1] - gram[0][1] * gram[1][0];
            for r in &mut right[0] {
                *r = [
                    (r[0] * gram[1][1] - r[1] * gram[1][0]) / determinant,
                    (r[1] * gram[0][0] - r[0] * gram[0][1]) / determinant,
                ];
            }
            for (stage, next) in stages.iter().zip(&stages[1..]) {
                let before = &right[right.len() - 1];
                let mut map = stage.advanced(before)?;
                map.iter_mut()
                    .for_each(|r| *r = [r[0] / pair.lambda[0], r[1] / pair.lambda[1]]);
                free(next, &mut map);
                right.push(map);
            }
            // the last level's own map takes over, and the rest of the points what it does not have
            if let Some(last) = right.last_mut() {
                let difference = |(r, own): (&[f64; 2], &[f64; 2])| [r[0] - own[0], r[1] - own[1]];
                beyond = Some(last.iter().zip(&pair.right).map(difference).collect());
                last.clone_from(&pair.right);
            }
        }
        Ok(Centre {
            lambda: Ok(pair.lambda),
            stages,
            right,
            beyond,
        })
    }

    /// The power by which curvature grows along creases that meet here and act in some smoothing steps only.
    pub fn power_of_creases(&self, context: Context<'_>) -> Result<Option<f64>, Error> {
        let kernel = context.kernel;
        let local = &self.stage(usize::MAX).quarters[1].local;
        let mut least: Option<f64> = None;
        for &steps in local.mesh.features.edge_steps.values() {
            let power = kernel.across(kernel.stationary, &vec![(0, steps)])?.power(0.0);
            least = power.into_iter().chain(least).reduce(f64::min);
        }
        Ok(least)
    }

    /// The number of levels that differ.
    pub fn leading(&self) -> usize {
        self.stages.len() - 1
    }

    /// The level after so many.
    pub fn stage(&self, m: usize) -> &Stage {
        &self.stages[m.min(self.leading())]
    }

    /// The map of the level after so many.
    pub fn map(&self, m: usize) -> Option<&[[f64; 2]]> {
        self.right.get(m.min(self.leading())).map(Vec::as_slice)
    }

    /// The largest modulus among the eigenvalues of the last matrix beyond the pair in which heights over the
    /// tangent plane have a part.
    pub fn second_modulus(&self, heights: &[f64]) -> Option<f64> {
        let stage = self.stage(usize::MAX);
        let size = heights.iter().fold(0.0, |most: f64, z| most.max(z.abs()));
        if size == 0.0 {
            return None;
        }
        // with a rotation the parts of heights by frequency, as they are asked for
        let mut parts: HashMap<usize, Vec<Complex<f64>>> = HashMap::new();
        let mut last = f64::NAN;
        for mode in stage.modes() {
            let modulus = mode.value.modulus();
            let in_pair = self
                .lambda
                .is_ok_and(|pair| pair.iter().any(|lambda| (modulus - lambda).abs() < EQUAL * lambda));
            // values of different blocks are different modes
            let again = modulus == last && stage.rotation.is_none();
            if in_pair || again || modulus < 1e-3 {
                continue;
            }
            last = modulus;
            for left in mode.left.get_or_init(|| stage.functionals(mode)) {
                let part = match &stage.rotation {
                    Some(rotation) => {
                        let k = mode.frequency;
                        let heights = parts.entry(k).or_insert_with(|| rotation.part(k, heights));
                        let terms = left.iter().zip(heights.iter());
                        terms.fold(Complex::zero(), |sum, (&l, &z)| sum + l * z)
                    }
                    None => {
                        let terms = left.iter().zip(heights);
                        terms.fold(Complex::zero(), |sum, (l, &z)| sum + l.scale(z))
                    }
                };
                if part.modulus() > 1e-10 * size {
                    return Some(modulus);
                }
            }
        }
        None
    }
}
