//! Functions across creases that act in some smoothing steps only.
//!
//! On a regular net such a crease is a straight line of vertices, which stay across the line in its steps and
//! are smoothed along it in all. So the surface remains a tensor product: along the crease a spline, across
//! it functions f_j of control points j, refined by the matrices of the line alone. Away from the crease
//! these are splines of finer and finer levels; on it they have a value and a first derivative, while the
//! second grows without bound: the even part has an eigenvalue between 1/4 and 1/2.
//!
//! With 1 and rho (the distance from the line, which every level reproduces) split off, `A^m = 1 l0 + 2^-m
//! rho l1 + T_m`, and on the m-th annulus
//!
//! ```text
//! f = l0 + t l1 + B T_m,      f' = l1 + 2^m B' T_m,      f'' = 4^m B'' T_m,
//! ```
//!
//! in which nothing cancels. Levels that differ carry l0 and l1 backwards, as around irregular centres.

use super::kernel::Kernel;
use crate::Error;
use eigenring_spline::curve::{MAX_ORDER, Piece, Values};
use std::sync::Arc;

/// Creases across an interval of unit length: places, in units of the interval from its beginning, and steps.
pub(crate) type Lines = Vec<(i32, u32)>;

/// A square matrix by rows.
type Square = Vec<Vec<f64>>;

/// Levels whose rests are kept.
const KEPT: usize = 64;

/// How far from a line second derivatives are taken that have no limit on it.
const BESIDE: f64 = 1.0 / (1u64 << 40) as f64;

/// The functions of one interval.
#[derive(Debug)]
pub(crate) enum Across {
    /// No crease is near.
    Spline(Arc<Piece>),
    /// The first and the second half.
    Halves([Half; 2]),
}

#[derive(Debug)]
pub(crate) enum Half {
    /// The functions of the half, and its control points from those of the whole.
    Inner(Square, Arc<Across>),
    /// A line at the outer end; that of the second half is seen from there.
    AtLine(Box<AtLine>),
}

/// The functions between a line at 0 and 1/2.
#[derive(Debug)]
pub(crate) struct AtLine {
    limit: Vec<f64>,
    slope: Vec<f64>,
    /// Levels that differ, with matrices to the next one, and the one that all later ones equal.
    stages: Vec<Stage>,
    rests: Vec<Square>,
    /// The power of the distance by which second derivatives grow.
    power: f64,
}

#[derive(Debug)]
struct Stage {
    limit: Vec<f64>,
    slope: Vec<f64>,
    next: Square,
    /// The second half of the interval.
    side: Option<(Square, Arc<Across>)>,
}

fn row_times(row: &[f64], matrix: &Square) -> Vec<f64> {
    let mut product = vec![0.0; row.len()];
    for (weight, terms) in row.iter().zip(matrix) {
        product.iter_mut().zip(terms).for_each(|(sum, w)| *sum += weight * w);
    }
    product
}

fn product(a: &Square, b: &Square) -> Square {
    a.iter().map(|row| row_times(row, b)).collect()
}

/// The control points of both halves from those of an interval.
fn halves(kernel: &Kernel, level: usize, lines: &Lines) -> [Square; 2] {
    let (order, rings) = (kernel.order, kernel.rings as i32);
    let unit = |j: usize| -> Vec<f64> { (0..order).map(|i| f64::from(u8::from(i == j))).collect() };
    let mean = |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect() };
    let mut rows: Square = vec![unit(0)];
    for j in 1..order {
        rows.push(mean(&unit(j - 1), &unit(j)));
        rows.push(unit(j));
    }
    let u = kernel.tension(level);
    // each step takes a point from either end
    for (step, first) in (0..kernel.rings).zip(-2 * rings..) {
        let own = if step == 0 { u / (1.0 + u) } else { 0.5 };
        let stays = |at: i32| {
            lines
                .iter()
                .any(|&(line, steps)| 2 * line == at && (step as u32) < steps)
        };
        let smoothed = rows.windows(3).zip(first + 1..).map(|(three, at)| {
            if stays(at) {
                return three[1].clone();
            }
            let ends = mean(&three[0], &three[2]);
            let mixed = three[1]
                .iter()
                .zip(ends)
                .map(|(centre, end)| own * centre + (1.0 - own) * end);
            mixed.collect()
        });
        rows = smoothed.collect();
    }
    [rows[..order].to_vec(), rows[1..].to_vec()]
}

/// The lines of a half, as far as they lie within its control points.
fn of_half(kernel: &Kernel, lines: &Lines, half: i32) -> Lines {
    let moved = lines.iter().map(|&(line, steps)| (2 * line - half, steps));
    moved.filter(|&(line, _)| kernel.is_within(line)).collect()
}

impl Across {
    /// The functions of an interval of a level.
    pub fn new(kernel: &Kernel, level: usize, lines: &Lines) -> Result<Self, Error> {
        if lines.is_empty() {
            return Ok(Across::Spline(kernel.piece(level)?));
        }
        let matrices = halves(kernel, level, lines);
        let has = |at: i32| lines.iter().any(|&(line, _)| line == at);
        let mut found = Vec::with_capacity(2);
        for (half, matrix) in (0..).zip(matrices) {
            found.push(if !has(half) {
                let inner = kernel.across(level + 1, &of_half(kernel, lines, half))?;
                Half::Inner(matrix, inner)
            } else if half == 0 {
                Half::AtLine(Box::new(AtLine::new(kernel, level, lines)?))
            } else {
                let mut mirrored: Lines = lines.iter().map(|&(line, steps)| (1 - line, steps)).collect();
                // the control points of the mirror image are those of the interval
                mirrored.sort_unstable();
                Half::AtLine(Box::new(AtLine::new(kernel, level, &mirrored)?))
            });
        }
        let mut found = found.into_iter();
        match (found.next(), found.next()) {
            (Some(first), Some(second)) => Ok(Across::Halves([first, second])),
            _ => unreachable!("an interval has two halves"),
        }
    }

    /// Values, first and second derivatives. On a line the second ones are those beside it.
    pub fn at(&self, t: f64) -> Values {
        let halves = match self {
            Across::Spline(piece) => return piece.at(t),
            Across::Halves(halves) => halves,
        };
        let half = usize::from(t >= 0.5);
        match (&halves[half], half) {
            (Half::Inner(matrix, inner), _) => {
                let fine = inner.at(2.0 * t - half as f64);
                let mut out = [[0.0; MAX_ORDER]; 3];
                for (power, (out, fine)) in (0..).zip(out.iter_mut().zip(&fine)) {
                    let scale = 2_f64.powi(power);
                    let row = row_times(&fine[..matrix.len()], matrix);
                    out.iter_mut().zip(row).for_each(|(out, x)| *out = scale * x);
                }
                out
            }
            (Half::AtLine(line), 0) => line.at(t),
            (Half::AtLine(line), _) => {
                let mut out = line.at(1.0 - t);
                let order = line.limit.len();
                out.iter_mut().for_each(|values| values[..order].reverse());
                out[1].iter_mut().for_each(|x| *x = -*x);
                out
            }
        }
    }

    /// On a line the power of the distance by which second derivatives grow beside it.
    pub fn power(&self, t: f64) -> Option<f64> {
        let Across::Halves(halves) = self else { return None };
        let half = match t {
            0.0 => &halves[0],
            1.0 => &halves[1],
            _ => return None,
        };
        match half {
            Half::AtLine(line) => Some(line.power),
            Half::Inner(..) => None,
        }
    }
}

impl AtLine {
    fn new(kernel: &Kernel, level: usize, lines: &Lines) -> Result<Self, Error> {
        let order = kernel.order;
        // the line itself, and others as long as these are near
        let mut near = lines.clone();
        let mut at = level;
        let mut stages: Vec<Stage> = Vec::new();
        loop {
            let [next, second] = halves(kernel, at, &near);
            let side = if stages.is_empty() && near.iter().any(|&(line, _)| line == 1) {
                None // where another line is at the end of the first half
            } else {
                Some((second, kernel.across(at + 1, &of_half(kernel, &near, 1))?))
            };
            stages.push(Stage {
                limit: Vec::new(),
                slope: Vec::new(),
                next,
                side,
            });
            if at >= kernel.stationary && near.len() == 1 {
                break;
            }
            near = of_half(kernel, &near, 0);
            at += 1;
        }
        let rho: Vec<f64> = (0..order).map(|j| j as f64 - kernel.rings as f64).collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        // the even part for 1, whose other eigenvalues are below 1/2, and the odd one for 1/2: then 1/8
        let centre = kernel.rings;
        let functional = |matrix: &Square, eigenvalue: f64, odd: bool| {
            let mut row = vec![0.0; order];
            (row[centre], row[centre - 1], row[centre + 1]) = if odd { (0.0, -0.5, 0.5) } else { (1.0, 0.0, 0.0) };
            for _ in 0..4000 {
                let mut next = row_times(&row, matrix);
                next.iter_mut().for_each(|x| *x /= eigenvalue);
                // of the wrong parity there is rounding only
                for j in 0..=centre {
                    let (a, b) = (next[centre - j], next[centre + j]);
                    let mean = if odd { (b - a) / 2.0 } else { (a + b) / 2.0 };
                    (next[centre - j], next[centre + j]) = if odd { (-mean, mean) } else { (mean, mean) };
                }
                let change = next
                    .iter()
                    .zip(&row)
                    .fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
                row = next;
                if change < 1e-17 {
                    break;
                }
            }
            row
        };
        let last = stages.len() - 1;
        let mut limit = functional(&stages[last].next, 1.0, false);
        let total: f64 = limit.iter().sum();
        limit.iter_mut().for_each(|x| *x /= total);
        let mut slope = functional(&stages[last].next, 0.5, true);
        let total = dot(&slope, &rho);
        slope.iter_mut().for_each(|x| *x /= total);
        for number in (0..=last).rev() {
            if number < last {
                limit = row_times(&limit, &stages[number].next);
                slope = row_times(&slope, &stages[number].next);
                slope.iter_mut().for_each(|x| *x *= 2.0);
                let constant: f64 = slope.iter().sum();
                slope.iter_mut().zip(&limit).for_each(|(x, l)| *x -= constant * l);
            }
            stages[number].limit.clone_from(&limit);
            stages[number].slope.clone_from(&slope);
        }
        let mut line = AtLine {
            limit,
            slope,
            stages,
            rests: Vec::new(),
            power: 0.0,
        };
        let unit = (0..order).map(|i| (0..order).map(|j| f64::from(u8::from(i == j))).collect());
        line.rests.push(line.projected(0, unit.collect()));
        let levels = KEPT + last;
        for m in 0..levels {
            let next = line.advanced(m, &line.rests[m]);
            line.rests.push(next);
        }
        let size = |matrix: &Square| matrix.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
        let ratio = size(&line.rests[levels]) / size(&line.rests[levels - 1]);
        line.power = -ratio.log2() - 2.0;
        Ok(line)
    }

    fn stage(&self, m: usize) -> &Stage {
        &self.stages[m.min(self.stages.len() - 1)]
    }

    /// A rest freed of constants and of the distance.
    fn projected(&self, m: usize, mut rest: Square) -> Square {
        let stage = self.stage(m);
        let (limit, slope) = (row_times(&stage.limit, &rest), row_times(&stage.slope, &rest));
        let centre = (rest.len() / 2 - 1) as f64;
        for (j, row) in rest.iter_mut().enumerate() {
            let rho = j as f64 - centre;
            row.iter_mut()
                .zip(limit.iter().zip(&slope))
                .for_each(|(x, (l, k))| *x -= l + rho * k);
        }
        rest
    }

    fn advanced(&self, m: usize, rest: &Square) -> Square {
        self.projected(m + 1, product(&self.stage(m).next, rest))
    }

    fn at(&self, t: f64) -> Values {
        let mut out = [[0.0; MAX_ORDER]; 3];
        let on_line = t == 0.0;
        let t = if on_line { BESIDE } else { t };
        let (mut fine, mut m) = (t, 0);
        while fine < 0.5 {
            fine *= 2.0;
            m += 1;
        }
        let kept = self.rests.len() - 1;
        let mut deep = None;
        for level in kept..m {
            deep = Some(self.advanced(level, deep.as_ref().unwrap_or(&self.rests[kept])));
        }
        let rest = deep.as_ref().unwrap_or(&self.rests[m.min(kept)]);
        let Some((matrix, across)) = &self.stage(m).side else {
            unreachable!("the first half has no second line");
        };
        let values = across.at(2.0 * fine - 1.0);
        for (power, (out, values)) in (0..).zip(out.iter_mut().zip(&values)) {
            let row = row_times(&row_times(&values[..matrix.len()], matrix), rest);
            let scale = 2_f64.powi(power * (m as i32 + 1));
            out.iter_mut().zip(row).for_each(|(out, x)| *out = scale * x);
        }
        if on_line {
            out[..2].iter_mut().for_each(|out| *out = [0.0; MAX_ORDER]);
        }
        let along = if on_line { 0.0 } else { t };
        for (j, (limit, slope)) in self.limit.iter().zip(&self.slope).enumerate() {
            out[0][j] += limit + along * slope;
            out[1][j] += slope;
        }
        out
    }
}
