//! The local matrices around an irregular centre, and what splits limit and tangents off.
//!
//! Levels may differ for a while (tension) before all are alike. The functionals of the limit `l0` and of the
//! tangents `L` are the left eigenvectors of the last matrix, carried back: `l0_l = l0_(l+1) S_l`, `L_l =
//! L_(l+1) S_l / lambda`, freed of constants at each step, since their rounding would grow like `lambda^-l`.
//! The maps `R` go forwards from the last matrix's right eigenvectors, `R_(l+1) = S_l R_l / lambda`.

use super::kernel::Kernel;
use super::local::Local;
use super::net::{Control, control};
use super::patch::Patch;
use super::rotation::Rotation;
use crate::refine::{Row, Step};
use crate::rules::Rules;
use crate::{Error, NONE, Topology};
use eigenring_scheme::{Complex, Table};
use eigenring_spectral::{Block, Matrix};
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

/// Local matrices beyond this size are not decomposed unless they turn with the sectors of a closed fan: the
/// positions of their centres are known, their tangents are not. A boundary vertex of about 450 faces.
const MOST: usize = 900;

/// Moduli of eigenvalues that differ by less than this, relatively, are taken as equal: far above the
/// rounding of simple eigenvalues, 1e-14, and below the distance of any two that schemes have. Empirical.
const EQUAL: f64 = 1e-9;

/// Why a normal is not defined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Undefined {
    /// The two eigenvalues after 1 are not real, or not larger than all others.
    NotDominant,
    /// They have one eigenvector only.
    Defective,
    /// Their map folds over or collapses along a rim.
    NotInjective,
    /// The local matrix is too large to be decomposed.
    TooLarge,
    /// The control points have no tangent plane there.
    Degenerate,
}

impl Undefined {
    /// The reason in words.
    pub fn words(self) -> &'static str {
        match self {
            Undefined::NotDominant => "no dominant pair of eigenvalues",
            Undefined::Defective => "the pair of eigenvalues has one eigenvector",
            Undefined::NotInjective => "the characteristic map is not injective",
            Undefined::TooLarge => "the local matrix is too large",
            Undefined::Degenerate => "the control points are degenerate",
        }
    }
}

/// The dominant pair of a standard centre.
#[derive(Debug)]
pub(crate) struct Pair {
    pub lambda: [f64; 2],
    /// Right eigenvectors, a row for each point.
    pub right: Vec<[f64; 2]>,
    /// Left ones, dual to them.
    pub left: [Vec<f64>; 2],
}

/// What refines parts of a surface.
#[derive(Clone, Copy)]
pub(crate) struct Context<'a> {
    pub rules: &'a Rules,
    pub kernel: &'a Kernel,
}

/// A quarter of a face beside the centre, or a quarter of one.
#[derive(Debug)]
pub(crate) struct Quarter {
    local: Local,
    /// The level whose control points it has.
    level: usize,
    split: OnceLock<Option<Box<Split>>>,
    /// The control points of its piece, if it is one.
    control: OnceLock<Option<Control>>,
}

/// A quarter that is no regular piece yet.
#[derive(Debug)]
struct Split {
    tables: Vec<Table<f64>>,
    quarters: [Quarter; 4],
}

/// One level around a centre at the first corner of a face, on the part around the face that refinement
/// reproduces.
#[derive(Debug)]
pub(crate) struct Stage {
    tables: Vec<Table<f64>>,
    /// The rows of the next part's points.
    pub matrix: Vec<Row>,
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

/// A part of a mesh that ends where its rules read: at a boundary without rules.
pub(crate) fn missing() -> Error {
    Error::NoRule {
        what: "the surface ends".to_owned(),
        elements: "a boundary without rules".to_owned(),
        accepted: "are places farther inside".to_owned(),
    }
}

impl Quarter {
    fn new(
        local: &Local,
        (refined, topology): (&Step, &Topology),
        corner: u32,
        level: usize,
        kernel: &Kernel,
    ) -> Result<Self, Error> {
        let child = local.child(refined, topology, corner, kernel.reach());
        Ok(Quarter {
            local: child.ok_or_else(missing)?,
            level,
            split: OnceLock::new(),
            control: OnceLock::new(),
        })
    }

    /// Makes the piece at a place of the quarter, the last of `made`, with its name; control points are
    /// picked from those of the refined part. Pieces beside it that have their points then come before.
    fn patches(
        &self,
        context: Context<'_>,
        refined: &[[f64; 3]],
        at: &mut Path,
        depth: usize,
        made: &mut Vec<(u64, Patch)>,
    ) -> Result<(), Error> {
        let points: Vec<[f64; 3]> = self.local.unknowns().iter().map(|&id| refined[id as usize]).collect();
        match self.split(context, depth)? {
            None => {
                let control = self.control.get_or_init(|| control(&self.local, context.kernel));
                let control = control.as_ref().ok_or_else(missing)?;
                made.push((at.name, Patch::new(control, &points, context.kernel, self.level)?));
                Ok(())
            }
            Some(split) => {
                let name = 4 * at.name;
                let quarter = at.descend();
                let refined = applied(&split.tables, &points)?;
                for (number, beside) in split.quarters.iter().enumerate().filter(|(n, _)| *n != quarter) {
                    if depth > 1 && beside.split(context, depth - 1)?.is_none() {
                        let mut at = Path {
                            name: name + number as u64,
                            ..*at
                        };
                        beside.patches(context, &refined, &mut at, depth - 1, made)?;
                    }
                }
                split.quarters[quarter].patches(context, &refined, at, depth - 1, made)
            }
        }
    }

    /// Moves a place into the quarters where it lies, without computing anything there.
    fn locate(&self, context: Context<'_>, at: &mut Path, depth: usize) -> Result<(), Error> {
        if let Some(split) = self.split(context, depth)? {
            let quarter = at.descend();
            split.quarters[quarter].locate(context, at, depth - 1)?;
        }
        Ok(())
    }

    /// The quarters of a quarter that is not regular.
    fn split(&self, context: Context<'_>, depth: usize) -> Result<Option<&Split>, Error> {
        if let Some(known) = self.split.get() {
            return Ok(known.as_deref());
        }
        let Context { rules, kernel } = context;
        let near = kernel.beyond && self.local.is_near_special(rules);
        let split = if self.local.irregular(rules, kernel.rings).is_empty() && !near {
            None
        } else if depth == 0 {
            return Err(Error::NoRule {
                what: "special rules that reach too far for limits".to_owned(),
                elements: "an irregular vertex".to_owned(),
                accepted: "are rules of the points next to the vertex".to_owned(),
            });
        } else {
            let refined = self.local.refined(rules, kernel, self.level)?;
            let topology = Topology::unchecked(&refined.mesh);
            let fine = (&refined, &topology);
            let quarter = |corner| Quarter::new(&self.local, fine, corner, self.level + 1, kernel);
            let quarters = [quarter(0)?, quarter(1)?, quarter(2)?, quarter(3)?];
            let tables = refined.tables;
            Some(Box::new(Split { tables, quarters }))
        };
        Ok(self.split.get_or_init(|| split).as_deref())
    }
}

/// A place in a quarter, on its way into the piece where it lies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path {
    pub s: f64,
    pub t: f64,
    /// The corners of the quarters, in base 4 after the first.
    pub name: u64,
    /// How much finer the parameters are than those of the face.
    pub finer: f64,
}

impl Path {
    /// In a quarter of a face.
    fn new(quarter: usize, s: f64, t: f64) -> Self {
        Path {
            s,
            t,
            name: quarter as u64,
            finer: 2.0,
        }
    }

    fn descend(&mut self) -> usize {
        let (quarter, s, t) = quartered(self.s, self.t);
        *self = Path {
            s,
            t,
            name: 4 * self.name + quarter as u64,
            finer: 2.0 * self.finer,
        };
        quarter
    }
}

/// A quarter at distance 1 from the centre, in units of its own size, is at distance `2^d` after d cuts: a
/// piece that reads 15 rings, the most, is free of the centre after 4; one more for rules that reach farther.
const DEEPEST: usize = 5;

pub(super) fn applied(tables: &[Table<f64>], points: &[[f64; 3]]) -> Result<Vec<[f64; 3]>, Error> {
    let mut points = points.to_vec();
    for table in tables {
        points = table.apply(&points)?;
    }
    Ok(points)
}

/// A row times a matrix.
fn times(row: &[f64], matrix: &[Row]) -> Vec<f64> {
    let mut product = vec![0.0; row.len()];
    for (terms, weight) in matrix.iter().zip(row) {
        terms.iter().for_each(|&(at, w)| product[at as usize] += weight * w);
    }
    product
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
        let matrix = composed(&refined, child.unknowns());
        let quarter = |corner| Quarter::new(local, (&refined, topology), corner, level + 1, kernel);
        let quarters = [quarter(1)?, quarter(2)?, quarter(3)?];
        let rotation = match next {
            None => Rotation::find(&matrix, local, kernel.reach()),
            Some(_) => None,
        };
        let (limit, left, own) = match next {
            None => {
                let pair = pair(&matrix, local, rotation.as_ref())?;
                (
                    limit(&matrix, rotation.as_ref()),
                    pair.as_ref().ok().map(|pair| pair.left.clone()),
                    Some(pair),
                )
            }
            Some((next, pair)) => {
                let limit = times(&next.limit, &matrix);
                let left = match (&next.left, pair) {
                    (Some(left), Ok(pair)) => Some([0, 1].map(|i| {
                        let mut row = times(&left[i], &matrix);
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
            tables: refined.tables,
            matrix,
            limit,
            left,
            quarters,
            rotation,
            spectrum: OnceLock::new(),
        };
        Ok((stage, own))
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
                None => of_block(block(&self.matrix), 0),
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
            None => block(&self.matrix),
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
    pub fn new(stages: Vec<Arc<Stage>>, pair: &Result<Pair, Undefined>) -> Self {
        let Ok(pair) = pair else {
            return Centre {
                lambda: pair.as_ref().map(|pair| pair.lambda).map_err(|&why| why),
                stages,
                right: Vec::new(),
                beyond: None,
            };
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
                let row = |row: &Row| {
                    [0, 1].map(|k| {
                        let sum: f64 = row.iter().map(|&(at, w)| w * before[at as usize][k]).sum();
                        sum / pair.lambda[k]
                    })
                };
                let mut map: Vec<[f64; 2]> = stage.matrix.iter().map(row).collect();
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
        Centre {
            lambda: Ok(pair.lambda),
            stages,
            right,
            beyond,
        }
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

fn block(matrix: &[Row]) -> Block<f64> {
    let weight = |row: usize, column: usize| {
        let terms = &matrix[row];
        terms
            .iter()
            .find(|(at, _)| *at as usize == column)
            .map_or(0.0, |term| term.1)
    };
    Block::Real(Matrix::from_fn(matrix.len(), matrix.len(), weight))
}

/// The left eigenvector of 1, whose entries add up to 1.
pub(super) fn limit(matrix: &[Row], rotation: Option<&Rotation>) -> Vec<f64> {
    let Some(rotation) = rotation else {
        return fixed(matrix.len(), |weights| times(weights, matrix));
    };
    // the same at all points of an orbit, and nothing at points outside of the rings
    let block = rotation.means();
    let parts = fixed(block.len(), |weights| {
        let column = |j: usize| weights.iter().zip(&block).map(|(w, row)| w * row[j]).sum();
        (0..block.len()).map(column).collect()
    });
    rotation.shared(&parts, matrix.len())
}

/// The row that a map leaves as it is, by its powers: all others vanish, the slowest like the subdominant
/// eigenvalue.
fn fixed(size: usize, map: impl Fn(&[f64]) -> Vec<f64>) -> Vec<f64> {
    let mut weights = vec![0.0; size];
    weights[0] = 1.0;
    for _ in 0..4000 {
        let next = map(&weights);
        let change = next
            .iter()
            .zip(&weights)
            .fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        weights = next;
        if change < 1e-18 {
            break;
        }
    }
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|w| w / sum).collect()
}

/// The two eigenvalues after 1, if they dominate all others, with their vectors.
pub(super) struct Leading {
    pub values: [f64; 2],
    pub right: [Vec<f64>; 2],
    pub left: [Vec<f64>; 2],
}

/// Of a dense matrix.
pub(super) fn leading(matrix: &[Row]) -> Result<Result<Leading, Undefined>, Error> {
    if matrix.len() > MOST {
        return Ok(Err(Undefined::TooLarge));
    }
    let block = block(matrix);
    let found = block.eigenvalues()?;
    let all: Vec<Complex<f64>> = found
        .iter()
        .flat_map(|e| std::iter::repeat_n(e.value, e.multiplicity))
        .collect();
    let refuse = |why| Ok(Err(why));
    let [one, first, second, rest @ ..] = all.as_slice() else {
        return refuse(Undefined::NotDominant);
    };
    let third = rest.first().map_or(0.0, |value| value.modulus());
    let real = first.im == 0.0 && second.im == 0.0 && first.re > 0.0 && second.re > 0.0;
    if !real || (one.re - 1.0).abs() > EQUAL || first.re > 1.0 - EQUAL || third > second.re * (1.0 - EQUAL) {
        return refuse(Undefined::NotDominant);
    }
    let real_part = |vectors: &[Vec<Complex<f64>>]| -> Vec<Vec<f64>> {
        vectors.iter().map(|v| v.iter().map(|x| x.re).collect()).collect()
    };
    let (mut right, mut left) = (Vec::new(), Vec::new());
    let values = if first == second {
        vec![*first]
    } else {
        vec![*first, *second]
    };
    for value in values {
        let space = block.eigenspace(value, 0)?;
        right.extend(real_part(&space.right));
        left.extend(real_part(&space.left));
    }
    let (Ok(right), Ok(left)) = (right.try_into(), left.try_into()) else {
        return refuse(Undefined::Defective);
    };
    let values = [first.re, second.re];
    Ok(Ok(Leading { values, right, left }))
}

/// Of a matrix that turns: the pair of blocks 1 and N-1.
pub(super) fn turning(matrix: &[Row], rotation: &Rotation) -> Result<Result<Leading, Undefined>, Error> {
    let refuse = |why| Ok(Err(why));
    let (mut lambda, mut third) = (None, 0.0_f64);
    for k in 0..=rotation.sectors() / 2 {
        let found = rotation.block(k).eigenvalues()?;
        let all: Vec<Complex<f64>> = found
            .iter()
            .flat_map(|e| std::iter::repeat_n(e.value, e.multiplicity))
            .collect();
        let own = usize::from(k < 2);
        match (k, all.first()) {
            (0, Some(one)) if (one.re - 1.0).abs() <= EQUAL => {}
            (1, Some(first)) if first.im.abs() <= 1e-12 && first.re > 0.0 && first.re < 1.0 - EQUAL => {
                lambda = Some(*first);
            }
            (0 | 1, _) => return refuse(Undefined::NotDominant),
            _ => {}
        }
        third = third.max(all.get(own).map_or(0.0, |value| value.modulus()));
    }
    let Some(lambda) = lambda.filter(|lambda| third <= lambda.re * (1.0 - EQUAL)) else {
        return refuse(Undefined::NotDominant);
    };
    let space = rotation.block(1).eigenspace(lambda, 1)?;
    let ([right], [left]) = (space.right.as_slice(), space.left.as_slice()) else {
        return refuse(Undefined::Defective);
    };
    let mut right = rotation.spread(1, right, false, matrix.len());
    for vector in &mut right {
        rotation.continued(matrix, lambda.re, vector);
    }
    let left = rotation.spread(1, left, true, matrix.len());
    let values = [lambda.re; 2];
    Ok(Ok(Leading { values, right, left }))
}

fn pair(matrix: &[Row], local: &Local, rotation: Option<&Rotation>) -> Result<Result<Pair, Undefined>, Error> {
    let found = match rotation {
        Some(rotation) => turning(matrix, rotation)?,
        None => leading(matrix)?,
    };
    let refuse = |why| Ok(Err(why));
    let Leading { values, right, left } = match found {
        Ok(found) => found,
        Err(why) => return refuse(why),
    };
    let ([r0, r1], [l0, l1]) = (&right, &left);
    // L <- (L R)^-1 L
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let gram = [[dot(l0, r0), dot(l0, r1)], [dot(l1, r0), dot(l1, r1)]];
    let determinant = gram[0][0] * gram[1][1] - gram[0][1] * gram[1][0];
    if determinant.abs() < 1e-12 {
        return refuse(Undefined::Defective);
    }
    let mixed =
        |a: f64, b: f64| -> Vec<f64> { l0.iter().zip(l1).map(|(x, y)| (a * x + b * y) / determinant).collect() };
    let mut left = [mixed(gram[1][1], -gram[0][1]), mixed(-gram[1][0], gram[0][0])];
    let mut right: Vec<[f64; 2]> = r0.iter().zip(r1).map(|(&x, &y)| [x, y]).collect();
    // the ends of the spokes, or the faces between them, must run round the centre once
    let topology = &local.topology;
    let fan = topology.fan(topology.origin(0));
    let (mut ends, centre): (Vec<u32>, [f64; 2]) = match &local.net {
        Some((net, _)) => {
            let (ends, weights) = net.around(&fan, topology, topology.origin(0));
            let mean = |k: usize| weights.iter().map(|&(at, w)| w * right[at as usize][k]).sum::<f64>();
            let centre = [mean(0), mean(1)];
            (ends, centre)
        }
        None => {
            let heads = fan.spokes.iter().map(|&spoke| topology.head(spoke));
            let ends = heads.chain(fan.last.map(|last| topology.origin(last))).collect();
            (ends, right[topology.origin(0) as usize])
        }
    };
    if fan.is_closed() {
        ends.push(ends[0]);
    }
    let at = |end: u32| [0, 1].map(|k| right[end as usize][k] - centre[k]);
    let turns: Vec<(f64, f64)> = ends
        .windows(2)
        .map(|pair| {
            let (a, b) = (at(pair[0]), at(pair[1]));
            let (cross, along) = (a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
            (cross / (a[0].hypot(a[1]) * b[0].hypot(b[1])), cross.atan2(along))
        })
        .collect();
    let sign = turns.iter().map(|turn| turn.0).sum::<f64>().signum();
    let total: f64 = turns.iter().map(|turn| sign * turn.1).sum();
    // at most a turn of a closed fan, up to rounding
    let once = total < std::f64::consts::TAU + 1e-6;
    let size = right.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    let apart = ends.iter().all(|&end| at(end).iter().any(|x| x.abs() > 1e-8 * size));
    if !apart || !once || turns.iter().any(|turn| !(sign * turn.0 > 1e-9)) {
        return refuse(Undefined::NotInjective);
    }
    if sign < 0.0 {
        right.iter_mut().for_each(|r| r[1] = -r[1]);
        left[1].iter_mut().for_each(|l| *l = -*l);
    }
    Ok(Ok(Pair {
        lambda: values,
        right,
        left,
    }))
}

/// The quarter of a face in which parameters lie, by its corner, and the parameters there.
pub(crate) fn quartered(s: f64, t: f64) -> (usize, f64, f64) {
    let (right, up) = (s >= 0.5, t >= 0.5);
    let quarter = match (right, up) {
        (false, false) => 0,
        (true, false) => 1,
        (true, true) => 2,
        (false, true) => 3,
    };
    let fine = |x: f64, upper: bool| if upper { 2.0 * x - 1.0 } else { 2.0 * x };
    (quarter, fine(s, right), fine(t, up))
}
