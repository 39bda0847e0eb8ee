//! The local matrix around an irregular centre, split into limit, tangents and rest.

use super::local::{Local, Reach};
use super::patch::{Jet3, control, jet};
use crate::Error;
use crate::refine::{Row, Step, add};
use crate::rules::Rules;
use eigenring_spectral::{Block, Matrix};
use nalgebra::{Point3, Vector3};
use std::collections::HashMap;

/// Local matrices beyond this size are not decomposed: the positions of their centres are known, their
/// tangents are not. A valence of about 450.
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

/// Patches away from the centre: the control points of a quarter of the face, or of quarters of it.
#[derive(Debug)]
pub(crate) enum Annulus {
    Patch(Box<[Row; 16]>),
    Split(Box<[Annulus; 4]>),
}

/// A centre at the first corner of a face, with the part around the face that refinement reproduces.
#[derive(Debug)]
pub(crate) struct Centre {
    /// The rows of the next part's points.
    pub matrix: Vec<Row>,
    /// The limit of the centre.
    pub limit: Vec<f64>,
    pub pair: Result<Pair, Undefined>,
    /// The quarters at the second, third and last corner.
    pub annulus: [Annulus; 3],
}

/// The row of a refined point over the points before.
pub(crate) fn composed(refined: &Step, index: u32) -> Row {
    let mut row: Row = vec![(index, 1.0)];
    for table in refined.tables.iter().rev() {
        let mut before = Row::new();
        for (at, weight) in row {
            let terms: Row = table.row(at as usize).map(|(source, &w)| (source as u32, w)).collect();
            add(&mut before, weight, &terms);
        }
        row = before;
    }
    row
}

fn over(row: &Row, rows: &[Row]) -> Row {
    let mut sum = Row::new();
    for &(at, weight) in row {
        add(&mut sum, weight, &rows[at as usize]);
    }
    sum
}

fn annulus(local: &Local, rows: &[Row], rules: &Rules, reach: Reach, depth: usize) -> Result<Annulus, Error> {
    let near = reach == Reach::Two && local.is_near_special(rules);
    if local.irregular(rules).is_empty() && !near {
        let points = control(local).map(|row| over(&row, rows));
        return Ok(Annulus::Patch(Box::new(points)));
    }
    if depth == 0 {
        return Err(Error::NoRule {
            what: "special rules that reach too far for limits".to_owned(),
            elements: "an irregular vertex".to_owned(),
            accepted: "are rules of the points next to the vertex".to_owned(),
        });
    }
    let refined = local.refined(rules)?;
    let mut quarters = Vec::with_capacity(4);
    for corner in 0..4 {
        let child = local.child(&refined, corner, reach).ok_or_else(missing)?;
        let fine: Vec<Row> = child
            .ids
            .iter()
            .map(|&id| over(&composed(&refined, id), rows))
            .collect();
        quarters.push(annulus(&child, &fine, rules, reach, depth - 1)?);
    }
    let quarters: [Annulus; 4] = quarters.try_into().map_err(|_| missing())?;
    Ok(Annulus::Split(Box::new(quarters)))
}

/// A part of a mesh that ends where its rules read: at a boundary without rules.
pub(crate) fn missing() -> Error {
    Error::NoRule {
        what: "the surface ends".to_owned(),
        elements: "a boundary without rules".to_owned(),
        accepted: "are places farther inside".to_owned(),
    }
}

impl Centre {
    /// The centre at the first corner of a part, of which `child` is the refined image.
    pub fn new(local: &Local, refined: &Step, child: &Local, rules: &Rules, reach: Reach) -> Result<Self, Error> {
        let matrix: Vec<Row> = child.unknowns().iter().map(|&id| composed(refined, id)).collect();
        let mut quarters = Vec::with_capacity(3);
        for corner in 1..4 {
            let quarter = local.child(refined, corner, reach).ok_or_else(missing)?;
            let rows: Vec<Row> = quarter.unknowns().iter().map(|&id| composed(refined, id)).collect();
            quarters.push(annulus(&quarter, &rows, rules, reach, 2)?);
        }
        Ok(Centre {
            pair: pair(&matrix, local)?,
            limit: limit(&matrix),
            matrix,
            annulus: quarters.try_into().map_err(|_| missing())?,
        })
    }

    /// Whether a net's height over the tangent plane has a part in each eigenvalue beyond the pair: the
    /// largest modulus that it has.
    pub fn second_modulus(&self, heights: &[f64]) -> Option<f64> {
        let block = block(&self.matrix);
        let size = heights.iter().fold(0.0, |most: f64, z| most.max(z.abs()));
        if size == 0.0 {
            return None;
        }
        let mut last = f64::NAN;
        for eigenvalue in block.eigenvalues().ok()?.iter().skip(1) {
            let modulus = eigenvalue.value.0.hypot(eigenvalue.value.1);
            let in_pair = self.pair.as_ref().is_ok_and(|pair| {
                pair.lambda
                    .iter()
                    .any(|lambda| (modulus - lambda).abs() < EQUAL * lambda)
            });
            if in_pair || modulus == last || modulus < 1e-3 {
                continue;
            }
            last = modulus;
            let Ok(space) = block.eigenspace(eigenvalue.value, 0) else {
                continue;
            };
            for left in space.left {
                let part = left
                    .iter()
                    .zip(heights)
                    .fold([0.0, 0.0], |sum, (l, z)| [sum[0] + l.0 * z, sum[1] + l.1 * z]);
                // functionals have unit length
                if part[0].hypot(part[1]) > 1e-10 * size {
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

/// The left eigenvector of 1, by powers of the transpose: all others vanish, the slowest like the subdominant
/// eigenvalue.
fn limit(matrix: &[Row]) -> Vec<f64> {
    let mut weights = vec![0.0; matrix.len()];
    weights[0] = 1.0;
    for _ in 0..4000 {
        let mut next = vec![0.0; matrix.len()];
        for (row, weight) in matrix.iter().zip(&weights) {
            for &(at, w) in row {
                next[at as usize] += weight * w;
            }
        }
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

fn pair(matrix: &[Row], local: &Local) -> Result<Result<Pair, Undefined>, Error> {
    if matrix.len() > MOST {
        return Ok(Err(Undefined::TooLarge));
    }
    let block = block(matrix);
    let found = block.eigenvalues()?;
    let modulus = |value: (f64, f64)| value.0.hypot(value.1);
    let all: Vec<(f64, f64)> = found
        .iter()
        .flat_map(|e| std::iter::repeat_n(e.value, e.multiplicity))
        .collect();
    let refuse = |why| Ok(Err(why));
    let [one, first, second, rest @ ..] = all.as_slice() else {
        return refuse(Undefined::NotDominant);
    };
    let third = rest.first().map_or(0.0, |&value| modulus(value));
    let real = first.1 == 0.0 && second.1 == 0.0 && first.0 > 0.0 && second.0 > 0.0;
    if !real || (one.0 - 1.0).abs() > EQUAL || first.0 > 1.0 - EQUAL || third > second.0 * (1.0 - EQUAL) {
        return refuse(Undefined::NotDominant);
    }
    let real_part = |vectors: &[Vec<(f64, f64)>]| -> Vec<Vec<f64>> {
        vectors.iter().map(|v| v.iter().map(|x| x.0).collect()).collect()
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
    let ([r0, r1], [l0, l1]) = (right.as_slice(), left.as_slice()) else {
        return refuse(Undefined::Defective);
    };
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
    let (mut ends, centre): (Vec<u32>, [f64; 2]) = if local.values.is_some() {
        let faces: Vec<u32> = fan.spokes.iter().map(|&spoke| topology.face(spoke)).collect();
        let mean = |k: usize| faces.iter().map(|&face| right[face as usize][k]).sum::<f64>() / faces.len() as f64;
        let centre = [mean(0), mean(1)];
        (faces, centre)
    } else {
        let heads = fan.spokes.iter().map(|&spoke| topology.head(spoke));
        let ends = heads.chain(fan.last.map(|last| topology.origin(last))).collect();
        (ends, right[topology.origin(0) as usize])
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
        lambda: [first.0, second.0],
        right,
        left,
    }))
}

/// The control points of a face beside a centre, level by level.
#[derive(Debug)]
pub(crate) struct Ladder {
    /// The limit of the centre.
    pub position: Point3<f64>,
    /// Tangents and normal, each of unit length.
    pub frame: [Vector3<f64>; 3],
    /// The tangents a, unless there is no tangent plane.
    pub tangents: Result<[Vector3<f64>; 2], Undefined>,
    /// By how much x and y shrink a level.
    pub lambda: f64,
    /// The tangents' coordinates in the frame, and how the second shrinks beside the first.
    plane: [[f64; 2]; 2],
    ratio: f64,
    /// T of each level, in the frame.
    rest: Vec<Vec<[f64; 3]>>,
    patches: HashMap<(usize, u8), [[f64; 3]; 16]>,
}

/// Levels beyond this are computed anew from the last one kept.
const KEPT: usize = 64;

impl Ladder {
    pub fn new(centre: &Centre, points: &[Point3<f64>]) -> Self {
        let combined = |weights: &[f64]| -> Vector3<f64> {
            // of differences from the first point, so that large coordinates cost no digits
            let first = points[0];
            weights.iter().zip(points).map(|(w, p)| (p - first) * *w).sum()
        };
        let from_first = combined(&centre.limit);
        let position = points[0] + from_first;
        let scale = points.iter().map(|p| (p - position).norm()).fold(0.0, f64::max);
        let tangents = centre.pair.as_ref().map_err(|&why| why).and_then(|pair| {
            let a = [combined(&pair.left[0]), combined(&pair.left[1])];
            // rounding of the coordinates themselves: tangents below it are none
            let least = 1e-13 * scale.max(f64::MIN_POSITIVE) * scale;
            if a[0].cross(&a[1]).norm() > least {
                Ok(a)
            } else {
                Err(Undefined::Degenerate)
            }
        });
        let mut frame = [Vector3::x(), Vector3::y(), Vector3::z()];
        let (mut lambda, mut ratio, mut plane) = (1.0, 1.0, [[0.0; 2]; 2]);
        if let (Ok(a), Ok(pair)) = (&tangents, &centre.pair) {
            let normal = a[0].cross(&a[1]).normalize();
            let first = a[0].normalize();
            frame = [first, normal.cross(&first), normal];
            (lambda, ratio) = (pair.lambda[0], pair.lambda[1] / pair.lambda[0]);
            plane = [0, 1].map(|r| [0, 1].map(|k| a[r].dot(&frame[k])));
        }
        let mut first: Vec<[f64; 3]> = Vec::with_capacity(points.len());
        for (index, point) in points.iter().enumerate() {
            let mut d = (point - points[0]) - from_first;
            if let (Ok(a), Ok(pair)) = (&tangents, &centre.pair) {
                d -= a[0] * pair.right[index][0] + a[1] * pair.right[index][1];
            }
            first.push([0, 1, 2].map(|k| d.dot(&frame[k])));
        }
        let mut ladder = Ladder {
            position,
            frame,
            tangents,
            lambda,
            plane,
            ratio,
            rest: Vec::new(),
            patches: HashMap::new(),
        };
        ladder.project(centre, &mut first);
        ladder.rest.push(first);
        ladder
    }

    /// Takes limit and tangents out of the rest.
    fn project(&self, centre: &Centre, rest: &mut [[f64; 3]]) {
        let part = |weights: &[f64], rest: &[[f64; 3]]| {
            let mut sum = [0.0; 3];
            for (w, t) in weights.iter().zip(rest) {
                (0..3).for_each(|k| sum[k] += w * t[k]);
            }
            sum
        };
        let limit = part(&centre.limit, rest);
        rest.iter_mut().for_each(|t| (0..3).for_each(|k| t[k] -= limit[k]));
        if let (Ok(_), Ok(pair)) = (&self.tangents, &centre.pair) {
            let parts = [part(&pair.left[0], rest), part(&pair.left[1], rest)];
            for (t, r) in rest.iter_mut().zip(&pair.right) {
                (0..3).for_each(|k| t[k] -= r[0] * parts[0][k] + r[1] * parts[1][k]);
            }
        }
    }

    fn advanced(&self, centre: &Centre, rest: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let row = |row: &Row| {
            let mut sum = [0.0; 3];
            for &(at, w) in row {
                (0..3).for_each(|k| sum[k] += w * rest[at as usize][k]);
            }
            sum
        };
        let mut next: Vec<[f64; 3]> = centre.matrix.iter().map(row).collect();
        self.project(centre, &mut next);
        next
    }

    /// The points of a level in the frame, x and y over `lambda^m`, z over `lambda^2m`.
    pub fn points(&mut self, centre: &Centre, m: usize) -> Vec<[f64; 3]> {
        while self.rest.len() <= m.min(KEPT) {
            let next = self.advanced(centre, &self.rest[self.rest.len() - 1]);
            self.rest.push(next);
        }
        let mut rest = self.rest[m.min(KEPT)].clone();
        for _ in KEPT..m {
            rest = self.advanced(centre, &rest);
        }
        let shrunk = self.lambda.powi(m as i32);
        let slower = self.ratio.powi(m as i32);
        for (index, t) in rest.iter_mut().enumerate() {
            *t = [t[0] / shrunk, t[1] / shrunk, t[2] / shrunk / shrunk];
            if let (Ok(_), Ok(pair)) = (&self.tangents, &centre.pair) {
                let r = [pair.right[index][0], pair.right[index][1] * slower];
                (0..2).for_each(|k| t[k] += r[0] * self.plane[0][k] + r[1] * self.plane[1][k]);
            }
        }
        rest
    }

    /// The jet at `(s, t)` of the quarter at a corner (1 to 3) of the face of level m, in the frame, and the
    /// factor by which parameters of the jet are finer than those of that face.
    pub fn jet(&mut self, centre: &Centre, m: usize, corner: usize, mut s: f64, mut t: f64) -> (Jet3, f64) {
        let mut annulus = &centre.annulus[corner - 1];
        let (mut path, mut finer) = (corner as u8, 2.0);
        let rows = loop {
            match annulus {
                Annulus::Patch(rows) => break rows,
                Annulus::Split(quarters) => {
                    let (quarter, fine_s, fine_t) = quartered(s, t);
                    (s, t) = (fine_s, fine_t);
                    path = path * 4 + quarter as u8;
                    finer *= 2.0;
                    annulus = &quarters[quarter];
                }
            }
        };
        if m <= KEPT
            && let Some(points) = self.patches.get(&(m, path))
        {
            return (jet(points, s, t), finer);
        }
        let points = self.points(centre, m);
        let control: [[f64; 3]; 16] = std::array::from_fn(|index| {
            let mut sum = [0.0; 3];
            for &(at, w) in &rows[index] {
                (0..3).for_each(|k| sum[k] += w * points[at as usize][k]);
            }
            sum
        });
        if m <= KEPT {
            self.patches.insert((m, path), control);
        }
        (jet(&control, s, t), finer)
    }
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
