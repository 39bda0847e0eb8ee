//! A bicubic patch at the points of a rule: its basis functions, the points of a map, and the products that
//! matrices are made of.
//!
//! Loops run over points or over functions in lanes, whichever leaves the order of each sum as it is written;
//! nothing is contracted, so that the bits do not depend on the registers of a processor.

use eigenring_spline::intervals::basis;
use eigenring_spline::uniform;

/// Value, s, t, ss, st, tt.
pub(crate) type Jet = [f64; 6];

/// Points of the unit square with their weights.
pub(crate) type Rule = [([f64; 2], f64)];

/// The functions of a patch.
pub(crate) const FUNCTIONS: usize = 16;

/// Points that are summed for at the same time.
const LANES: usize = 4;

/// The 16 jets at a point of a patch, the control point (i, j) at `4 j + i`.
pub(crate) fn bicubic(s: f64, t: f64) -> [Jet; FUNCTIONS] {
    let four = |t: f64| uniform::basis(3, t).map(|values| [values[0], values[1], values[2], values[3]]);
    tensor(four(s), four(t))
}

/// The same with knot intervals, s and t in units of the own one.
pub(crate) fn with_intervals(intervals: [[f64; 5]; 2], s: f64, t: f64) -> [Jet; FUNCTIONS] {
    let [along, across] = intervals.map(|five| five.map(|d| d / five[2]));
    tensor(basis(along, s), basis(across, t))
}

/// From values, first and second derivatives in both directions.
fn tensor(a: [[f64; 4]; 3], b: [[f64; 4]; 3]) -> [Jet; FUNCTIONS] {
    std::array::from_fn(|k| {
        let (i, j) = (k % 4, k / 4);
        [
            a[0][i] * b[0][j],
            a[1][i] * b[0][j],
            a[0][i] * b[1][j],
            a[2][i] * b[0][j],
            a[1][i] * b[1][j],
            a[0][i] * b[2][j],
        ]
    })
}

/// What the control points of a patch have: a coefficient and three coordinates.
pub(crate) type Data = [f64; 4];

/// Control points of a patch: for values, and, up to a constant that is the same for all, for derivatives.
pub(crate) struct Control {
    pub values: [Data; FUNCTIONS],
    pub derivatives: [Data; FUNCTIONS],
}

/// What is summed: coordinates alone or with the coefficient, first or second derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Wanted {
    pub coefficient: bool,
    /// Whether the third coordinate is not zero throughout.
    pub space: bool,
    pub second: bool,
}

/// Basis functions of a patch at the points of a rule.
#[derive(Clone, Debug)]
pub(crate) struct Jets {
    pub weights: Vec<f64>,
    /// For each point, order and function: what sums over points read.
    pub at: Vec<[[f64; FUNCTIONS]; 6]>,
    /// For some points at a time, function, order and point: what sums over functions read.
    blocks: Vec<[[[f64; LANES]; 6]; FUNCTIONS]>,
}

impl Jets {
    /// Of functions that are given at a point.
    pub fn new(rule: &Rule, functions: impl Fn(f64, f64) -> [Jet; FUNCTIONS]) -> Self {
        let mut blocks = vec![[[[0.0; LANES]; 6]; FUNCTIONS]; rule.len().div_ceil(LANES)];
        let mut at = vec![[[0.0; FUNCTIONS]; 6]; rule.len()];
        for (q, &([s, t], _)) in rule.iter().enumerate() {
            for (k, jet) in functions(s, t).iter().enumerate() {
                for (order, &value) in jet.iter().enumerate() {
                    at[q][order][k] = value;
                    blocks[q / LANES][k][order][q % LANES] = value;
                }
            }
        }
        Jets {
            weights: rule.iter().map(|(_, weight)| *weight).collect(),
            at,
            blocks,
        }
    }

    /// At each point the map and the function with these control points, and their derivatives, by order and
    /// then as in [`Data`]; zero where not wanted.
    pub fn sums(&self, control: &Control, wanted: Wanted, sums: &mut Maps) {
        sums.count = self.at.len();
        sums.blocks.resize(self.blocks.len(), [[[0.0; LANES]; 6]; 4]);
        pulp::Arch::new().dispatch(Sums {
            jets: self,
            control,
            wanted,
            sums: &mut sums.blocks,
        });
    }
}

struct Sums<'a> {
    jets: &'a Jets,
    control: &'a Control,
    wanted: Wanted,
    sums: &'a mut [[[[f64; LANES]; 6]; 4]],
}

/// A map and a function at the points of a patch.
#[derive(Default)]
pub(crate) struct Maps {
    count: usize,
    /// By [`Data`], order and point, as blocks of [`Jets`] are.
    blocks: Vec<[[[f64; LANES]; 6]; 4]>,
}

impl Maps {
    /// At each point by order.
    pub fn iter(&self) -> impl Iterator<Item = [Data; 6]> + '_ {
        (0..self.count).map(|q| {
            let block = &self.blocks[q / LANES];
            std::array::from_fn(|order| std::array::from_fn(|axis| block[axis][order][q % LANES]))
        })
    }
}

impl pulp::WithSimd for Sums<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let first = usize::from(!self.wanted.coefficient);
        let last = if self.wanted.space { 4 } else { 3 };
        for sums in self.sums.iter_mut() {
            sums[..first].fill([[0.0; LANES]; 6]);
            sums[last..].fill([[0.0; LANES]; 6]);
        }
        for axis in first..last {
            if self.wanted.second {
                along_axis::<6>(self.jets, self.control, axis, self.sums);
            } else {
                along_axis::<3>(self.jets, self.control, axis, self.sums);
            }
        }
    }
}

#[inline(always)]
fn along_axis<const ORDERS: usize>(jets: &Jets, control: &Control, axis: usize, sums: &mut [[[[f64; LANES]; 6]; 4]]) {
    let values: [f64; FUNCTIONS] = std::array::from_fn(|k| control.values[k][axis]);
    let derivatives: [f64; FUNCTIONS] = std::array::from_fn(|k| control.derivatives[k][axis]);
    for (block, sums) in jets.blocks.iter().zip(sums) {
        let mut own = [[0.0; LANES]; ORDERS];
        for k in 0..FUNCTIONS {
            for order in 0..ORDERS {
                let point = if order == 0 { values[k] } else { derivatives[k] };
                for lane in 0..LANES {
                    own[order][lane] += point * block[k][order][lane];
                }
            }
        }
        sums[axis] = [[0.0; LANES]; 6];
        sums[axis][..ORDERS].copy_from_slice(&own);
    }
}

/// A matrix over the functions of a patch. Below the diagonal, and in tiles on it, are the sums.
pub(crate) type Square = [[f64; FUNCTIONS]; FUNCTIONS];

/// Rows and columns of a tile of a matrix, whose sums stay in registers for all points.
const TILE: [usize; 2] = [4, 8];

/// `A^T B` below the diagonal.
pub(crate) fn products(a: &[[f64; FUNCTIONS]], b: &[[f64; FUNCTIONS]]) -> Square {
    pulp::Arch::new().dispatch(Products { a, b })
}

struct Products<'a> {
    a: &'a [[f64; FUNCTIONS]],
    b: &'a [[f64; FUNCTIONS]],
}

impl pulp::WithSimd for Products<'_> {
    type Output = Square;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Square {
        let mut sum = [[0.0; FUNCTIONS]; FUNCTIONS];
        tile::<0, 0>(&self, &mut sum);
        tile::<4, 0>(&self, &mut sum);
        tile::<8, 0>(&self, &mut sum);
        tile::<8, 8>(&self, &mut sum);
        tile::<12, 0>(&self, &mut sum);
        tile::<12, 8>(&self, &mut sum);
        sum
    }
}

#[inline(always)]
fn tile<const ROW: usize, const COLUMN: usize>(of: &Products<'_>, sum: &mut Square) {
    let mut tile = [[0.0; TILE[1]]; TILE[0]];
    for (a, b) in of.a.iter().zip(of.b) {
        for i in 0..TILE[0] {
            for j in 0..TILE[1] {
                tile[i][j] += a[ROW + i] * b[COLUMN + j];
            }
        }
    }
    for (i, entries) in tile.iter().enumerate() {
        sum[ROW + i][COLUMN..COLUMN + TILE[1]].copy_from_slice(entries);
    }
}
