//! The points that act on the surface near the centre, their exact rows, symmetries, and the eigenvalues.
//!
//! The surface near the centre consists of images of an annulus of regular patches. Its control points, all
//! that these read, and so on, are the points that act; what nobody reads has no effect. Where the rows are
//! exactly symmetric under rotation the matrix is divided into Fourier blocks, otherwise it is taken whole.

use super::model::{CENTRE, Model, Point, Row, ring};
use super::number::{Q, double, ratio};
use super::regular::{self, Regular};
use faer::{Mat, c64};
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::collections::BTreeMap;

/// Points beyond this number are not looked at: their eigenvalues would take too long for a test.
const MAX_POINTS: usize = 1500;

/// A matrix of the local system: a Fourier block, or the whole.
pub struct Block {
    /// Its index, at most `n/2`; `None` is the whole matrix.
    pub fourier: Option<usize>,
    /// How often its eigenvalues occur in the whole matrix.
    pub copies: usize,
    /// The entries.
    pub matrix: Mat<c64>,
    /// All eigenvalues, by falling modulus.
    pub values: Vec<c64>,
}

/// The local system.
pub struct Local {
    /// The rules.
    pub model: Model,
    /// The regular part.
    pub regular: Regular,
    /// The outermost ring with a row that is not the regular one.
    pub special: Option<i64>,
    /// The inner radius of the annulus of patches.
    pub inner: i64,
    /// The points that act, in order.
    pub points: Vec<Point>,
    /// Their places.
    pub index: BTreeMap<Point, usize>,
    /// The weights in each point, by place.
    pub rows: Vec<Vec<(usize, f64)>>,
    /// Whether rows are exactly symmetric under rotation.
    pub rotation: bool,
    /// Whether they are exactly symmetric under reflection in spoke 0 as well.
    pub mirror: bool,
    /// The largest distance of a row sum from 1, exactly.
    pub defect: Q,
    /// The smallest weight, exactly, and the point made with it.
    pub smallest: (Q, Point),
    /// The largest denominator of a weight in doubles.
    pub denominator: f64,
}

impl Local {
    /// Prepares the system.
    ///
    /// # Errors
    /// A sentence if the rules cannot be run or the net is too large.
    pub fn new(model: Model) -> Result<Local, String> {
        let composed = regular::compose(&model);
        let regular = regular::regular(&model, &composed);
        let line = regular::as_line(&composed);
        let bound = model.bound();
        if 2 * bound * bound * model.n as i64 > 4 * MAX_POINTS as i64 {
            return Err(format!("special stencils up to ring {bound}"));
        }
        let turns = model.turns();
        let mut rows: BTreeMap<Point, Row> = BTreeMap::new();
        let mut special = None;
        for r in 0..=bound + 4 {
            for point in model.ring(r) {
                // one sector stands for all where all have the same rules, which they have beyond the special
                // points
                if point.0 != 0 && (turns || r > bound) {
                    continue;
                }
                let row = model.row(point)?;
                if r <= bound && Some(&row) != model.regular_row(&line, point).as_ref() {
                    special = Some(r);
                }
                rows.insert(point, row);
            }
        }
        let (mut defect, mut smallest, mut denominator) = (Q::zero(), (ratio(2, 1), CENTRE), 1.0);
        let passes = model.passes.iter();
        let lines = passes
            .clone()
            .flat_map(|pass| pass.line.iter().flatten().map(|(_, weight)| weight));
        for weight in lines.chain(passes.flat_map(|pass| pass.special.values().flat_map(Row::values))) {
            denominator = f64::max(denominator, weight.denom().to_f64().unwrap_or(f64::INFINITY));
        }
        for (&point, row) in &rows {
            let off = (row.values().sum::<Q>() - Q::one()).abs();
            defect = if off > defect { off } else { defect };
            if let Some(least) = row.values().min().filter(|least| **least < smallest.0) {
                smallest = (least.clone(), point);
            }
        }
        let reach = line.iter().flatten().map(|(offset, _)| offset.abs()).max().unwrap_or(0);
        let (inner, first, last) = match regular {
            Regular::Spline(degree) => {
                let degree = degree as i64;
                let inner = (special.unwrap_or(0) + degree / 2) / 2 + 1;
                (inner, inner - degree / 2, 2 * inner - 1 - degree / 2 + degree)
            }
            // no patches: rings of regular rules, two beyond the smallest closed set, as further ones only
            // add zeros
            Regular::Other(_) => (bound + 1, bound + 1, bound.max(reach / 2) + 2),
        };
        let mut open: Vec<Point> = (first.max(0)..=last).flat_map(|r| model.ring(r)).collect();
        let mut acting: BTreeMap<Point, Row> = BTreeMap::new();
        while let Some(point) = open.pop() {
            if acting.contains_key(&point) {
                continue;
            }
            let (stands, by) = if turns {
                ((0, point.1, point.2), point.0)
            } else {
                (point, 0)
            };
            let row = match rows.get(&stands) {
                Some(row) => row.clone(),
                None => model.row(stands)?,
            };
            rows.entry(stands).or_insert_with(|| row.clone());
            let turned = |(source, weight)| (model.turned(source, by), weight);
            let row: Row = row.into_iter().map(turned).collect();
            open.extend(row.keys().filter(|source| !acting.contains_key(source)));
            acting.insert(point, row);
            if acting.len() > MAX_POINTS {
                return Err(format!("more than {MAX_POINTS} points"));
            }
        }
        let image = |map: &dyn Fn(Point) -> Point| {
            acting.iter().all(|(&point, row)| {
                let moved: Row = row
                    .iter()
                    .map(|(&source, weight)| (map(source), weight.clone()))
                    .collect();
                acting.get(&map(point)) == Some(&moved)
            })
        };
        let rotation = turns || image(&|point| model.turned(point, 1));
        let mirror = image(&|point| model.reflected(point));
        let mut points: Vec<Point> = acting.keys().copied().collect();
        points.sort_by_key(|&point| (ring(point), point));
        let index: BTreeMap<Point, usize> = points.iter().enumerate().map(|(i, &point)| (point, i)).collect();
        let in_doubles = |row: &Row| {
            row.iter()
                .map(|(source, weight)| (index[source], double(weight)))
                .collect()
        };
        let rows = points.iter().map(|point| in_doubles(&acting[point])).collect();
        Ok(Local {
            model,
            regular,
            special,
            inner,
            points,
            index,
            rows,
            rotation,
            mirror,
            defect,
            smallest,
            denominator,
        })
    }

    /// The Fourier blocks with their eigenvalues, or the whole matrix.
    pub fn blocks(&self) -> Vec<Block> {
        let n = self.model.n;
        if !self.rotation {
            return vec![self.whole()];
        }
        (0..=n / 2)
            .map(|k| {
                let copies = if k == 0 || 2 * k == n { 1 } else { 2 };
                self.fourier(k, copies)
            })
            .collect()
    }

    /// The points of one sector, and the centre for index 0.
    pub fn representatives(&self, fourier: usize) -> Vec<usize> {
        let stands = |point: Point| if point == CENTRE { fourier == 0 } else { point.0 == 0 };
        (0..self.points.len()).filter(|&i| stands(self.points[i])).collect()
    }

    fn fourier(&self, k: usize, copies: usize) -> Block {
        let members = self.representatives(k);
        let place = |point: Point| {
            let stands = if point == CENTRE { CENTRE } else { (0, point.1, point.2) };
            members
                .binary_search_by_key(&(ring(stands), stands), |&i| (ring(self.points[i]), self.points[i]))
                .ok()
        };
        let mut matrix = Mat::<c64>::zeros(members.len(), members.len());
        for (i, &row) in members.iter().enumerate() {
            for &(source, weight) in &self.rows[row] {
                let point = self.points[source];
                if let Some(j) = place(point) {
                    let (re, im) = turn(k * point.0, self.model.n);
                    matrix[(i, j)] += c64::new(weight * re, weight * im);
                }
            }
        }
        Block::new(Some(k), copies, matrix)
    }

    /// The whole matrix, which needs no symmetry.
    pub fn whole(&self) -> Block {
        let mut matrix = Mat::<c64>::zeros(self.points.len(), self.points.len());
        for (i, row) in self.rows.iter().enumerate() {
            for &(j, weight) in row {
                matrix[(i, j)] += c64::new(weight, 0.0);
            }
        }
        Block::new(None, 1, matrix)
    }

    /// One refinement of values at the points.
    pub fn refine<const D: usize>(&self, values: &[[f64; D]]) -> Vec<[f64; D]> {
        let made = |row: &Vec<(usize, f64)>| {
            let mut sum = [0.0; D];
            for &(j, weight) in row {
                sum.iter_mut()
                    .zip(&values[j])
                    .for_each(|(sum, value)| *sum += weight * value);
            }
            sum
        };
        self.rows.iter().map(made).collect()
    }
}

/// Cosine and sine of `k/n` turns, exact at quarters: a coupling that vanishes there must not come back as a
/// rounding error.
pub fn turn(k: usize, n: usize) -> (f64, f64) {
    let k = k % n;
    if (4 * k).is_multiple_of(n) {
        return [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][4 * k / n];
    }
    let angle = std::f64::consts::TAU * k as f64 / n as f64;
    (angle.cos(), angle.sin())
}

impl Block {
    fn new(fourier: Option<usize>, copies: usize, matrix: Mat<c64>) -> Block {
        let mut values: Vec<c64> = components(&matrix)
            .iter()
            .flat_map(|members| eigenvalues(&matrix, members))
            .collect();
        values.sort_by(|a, b| b.norm().total_cmp(&a.norm()));
        Block {
            fourier,
            copies,
            matrix,
            values,
        }
    }

    /// Singular values of `matrix - shift`, falling, with the right singular vectors.
    pub fn singular(&self, shift: c64) -> Option<(Vec<f64>, Mat<c64>)> {
        let size = self.matrix.nrows();
        let shifted = Mat::<c64>::from_fn(size, size, |i, j| {
            self.matrix[(i, j)] - if i == j { shift } else { c64::new(0.0, 0.0) }
        });
        let svd = shifted.svd().ok()?;
        let values = (0..size).map(|i| svd.S()[i].re).collect();
        Some((values, svd.V().to_owned()))
    }
}

fn eigenvalues(matrix: &Mat<c64>, members: &[usize]) -> Vec<c64> {
    if let [only] = members {
        return vec![matrix[(*only, *only)]];
    }
    let entry = |i: usize, j: usize| matrix[(members[i], members[j])];
    let size = members.len();
    let real = (0..size).all(|i| (0..size).all(|j| entry(i, j).im == 0.0));
    let found = if real {
        Mat::<f64>::from_fn(size, size, |i, j| entry(i, j).re).eigenvalues()
    } else {
        Mat::<c64>::from_fn(size, size, entry).eigenvalues()
    };
    found.expect("the QR iteration converges on matrices of this size")
}

/// Strongly connected components of the graph of non-zero entries (Tarjan 1972): the matrix is block
/// triangular with these diagonal blocks, and its exact zeros then cost no digits.
fn components(matrix: &Mat<c64>) -> Vec<Vec<usize>> {
    struct Search {
        reads: Vec<Vec<usize>>,
        order: Vec<Option<usize>>,
        low: Vec<usize>,
        stack: Vec<usize>,
        on_stack: Vec<bool>,
        found: Vec<Vec<usize>>,
        next: usize,
    }
    impl Search {
        fn visit(&mut self, v: usize) {
            (self.order[v], self.low[v]) = (Some(self.next), self.next);
            self.next += 1;
            self.stack.push(v);
            self.on_stack[v] = true;
            for w in std::mem::take(&mut self.reads[v]) {
                match self.order[w] {
                    None => {
                        self.visit(w);
                        self.low[v] = self.low[v].min(self.low[w]);
                    }
                    Some(order) if self.on_stack[w] => self.low[v] = self.low[v].min(order),
                    Some(_) => {}
                }
            }
            if Some(self.low[v]) == self.order[v] {
                let start = self.stack.iter().rposition(|&w| w == v).expect("v was pushed");
                let members = self.stack.split_off(start);
                members.iter().for_each(|&w| self.on_stack[w] = false);
                self.found.push(members);
            }
        }
    }
    let size = matrix.nrows();
    let zero = c64::new(0.0, 0.0);
    let reads = (0..size)
        .map(|i| (0..size).filter(|&j| matrix[(i, j)] != zero).collect())
        .collect();
    let mut search = Search {
        reads,
        order: vec![None; size],
        low: vec![0; size],
        stack: Vec::new(),
        on_stack: vec![false; size],
        found: Vec::new(),
        next: 0,
    };
    for v in 0..size {
        if search.order[v].is_none() {
            search.visit(v);
        }
    }
    search.found
}
