//! Values and derivatives of basis functions at the quadrature points of a face: tables that depend on the
//! scheme, the valence and the rule only, and are shared by all faces.
//!
//! A face at an extraordinary vertex consists of annuli m = 0, 1, .., each of 12 bicubic patches with control
//! points `T_53 T_32 S^m`. Derivatives use `S - 1 l^T` in place of S: the rows of `S^m` tend to the limit
//! stencil l, and their differences would lose `lambda^-m` of their digits for each order. A patch has
//! parameters of its own, so there are no powers of two; Jacobians may become as small as `lambda^2m`.

use crate::{Error, MOST_ANNULI};
use eigenring_nonuniform::Element;
use eigenring_scheme::{DenseNet, Level, Site, refine};
use eigenring_spectral::{Eigenvalue, LocalSystem, Matrix, local_matrix, numbering};
use eigenring_spline::intervals::basis;
use eigenring_spline::quadrature::gauss_legendre;
use eigenring_spline::uniform;

/// The part of the area that annuli may leave out: rounding.
const REST: f64 = 1e-16;

/// The part of the energy of second derivatives that annuli may leave out.
const ENERGY: f64 = 1e-10;

/// Value, s, t, ss, st, tt.
pub(crate) type Jet = [f64; 6];

/// Basis functions at the points of a rule.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    /// Which control points of the numbering the functions belong to.
    pub columns: Vec<usize>,
    /// Weights of the points, in patch parameters.
    pub weights: Vec<f64>,
    /// For each point the jets of the functions.
    pub jets: Vec<Jet>,
    /// Of a face at an extraordinary vertex, the weights of the functions' coefficients in the limit there.
    pub limit: Option<Vec<f64>>,
}

impl Table {
    /// The jets of all functions at a point.
    pub fn at(&self, point: usize) -> &[Jet] {
        let n = self.columns.len();
        &self.jets[point * n..(point + 1) * n]
    }
}

/// The 16 jets at a point of a patch, the control point (i, j) at `4 j + i`.
pub(crate) fn bicubic(s: f64, t: f64) -> [Jet; 16] {
    let four = |t: f64| uniform::basis(3, t).map(|values| [values[0], values[1], values[2], values[3]]);
    tensor(four(s), four(t))
}

/// The same with knot intervals, s and t in units of the own one.
pub(crate) fn with_intervals(intervals: [[f64; 5]; 2], s: f64, t: f64) -> [Jet; 16] {
    let [along, across] = intervals.map(|five| five.map(|d| d / five[2]));
    tensor(basis(along, s), basis(across, t))
}

/// From values, first and second derivatives in both directions.
fn tensor(a: [[f64; 4]; 3], b: [[f64; 4]; 3]) -> [Jet; 16] {
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

/// Points of the unit square with their weights.
pub(crate) type Rule = [([f64; 2], f64)];

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

/// A face without an extraordinary vertex in its grid.
pub(crate) fn far(rule: &Rule) -> Table {
    let mut table = Table {
        columns: (0..16).collect(),
        weights: Vec::new(),
        jets: Vec::new(),
        limit: None,
    };
    for &([s, t], weight) in rule {
        table.weights.push(weight);
        table.jets.extend(bicubic(s, t));
    }
    table
}

/// An element with knot intervals.
pub(crate) fn element(of: &Element, rule: &Rule, depth: usize, scaled: bool) -> Table {
    let (pieces, limit) = of.pieces(depth);
    let read = |column: &usize| {
        pieces
            .iter()
            .any(|piece| (0..16).any(|k| piece.values[(k, *column)] != 0.0))
    };
    let columns: Vec<usize> = (0..of.columns()).filter(read).collect();
    let mut table = Table {
        limit: limit.map(|weights| columns.iter().map(|&column| weights[column]).collect()),
        columns,
        weights: Vec::new(),
        jets: Vec::new(),
    };
    for piece in &pieces {
        let factor = if scaled && piece.is_last {
            1.0 / (1.0 - of.left())
        } else {
            1.0
        };
        for &([s, t], weight) in rule {
            table.weights.push(weight * factor);
            let jets = with_intervals(piece.intervals, s, t);
            for &column in &table.columns {
                let mut sum = [0.0; 6];
                for (k, jet) in jets.iter().enumerate() {
                    sum[0] += jet[0] * piece.values[(k, column)];
                    let entry = piece.derivatives[(k, column)];
                    (1..6).for_each(|order| sum[order] += jet[order] * entry);
                }
                table.jets.push(sum);
            }
        }
    }
    table
}

/// A patch: its control points, the matrices of values and of derivatives, a factor of its weights.
type Patch<'a> = ([usize; 16], &'a Matrix<f64>, &'a Matrix<f64>, f64);

fn patches(of: &[Patch<'_>], columns: Vec<usize>, rule: &Rule) -> Table {
    let mut table = Table {
        columns,
        weights: Vec::new(),
        jets: Vec::new(),
        limit: None,
    };
    for (rows, values, derivatives, factor) in of {
        for &([s, t], weight) in rule {
            table.weights.push(weight * factor);
            let jets = bicubic(s, t);
            for &column in &table.columns {
                let mut sum = [0.0; 6];
                for (jet, &row) in jets.iter().zip(rows) {
                    sum[0] += jet[0] * values[(row, column)];
                    let entry = derivatives[(row, column)];
                    (1..6).for_each(|k| sum[k] += jet[k] * entry);
                }
                table.jets.push(sum);
            }
        }
    }
    table
}

/// What the rules around vertices of one valence give.
#[derive(Debug)]
pub(crate) struct Around {
    pub lambda: f64,
    /// The largest of the others over the one of the characteristic map: by its square the energies of
    /// second derivatives change from annulus to annulus.
    pub ratio: f64,
    /// The position of the centre in two rings.
    pub limit: Vec<f64>,
    s: Matrix<f64>,
    deflated: Matrix<f64>,
    inner: Matrix<f64>,
    outer: Matrix<f64>,
    level: Level<f64>,
    one: Matrix<f64>,
}

fn product(a: &Matrix<f64>, b: &Matrix<f64>) -> Matrix<f64> {
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

impl Around {
    /// The tables' matrices, of a scheme that [`accepts`](crate::accepts) accepts.
    pub fn new(valence: usize, level: &Level<f64>) -> Result<Self, Error> {
        let from = |rings: usize, to: usize| -> Result<Matrix<f64>, Error> {
            let net = DenseNet {
                numbering: numbering(level, rings),
            };
            let rows = refine(level, &net, &numbering(level, to).sites())?;
            Ok(Matrix::from_rows(rows, net.numbering.count()))
        };
        let system = LocalSystem::new(level, 2)?;
        let limit = system.limit_position()?;
        let spectrum = system.spectrum()?;
        let lambda = spectrum.subdominant().map_or(f64::NAN, |value| value.modulus());
        let most = REST.powf(0.5 / MOST_ANNULI as f64);
        if !(0.0 < lambda && lambda <= most) {
            return Err(Error::Lambda {
                valence,
                lambda,
                most,
                annuli: MOST_ANNULI,
            });
        }
        // beside the dominant one and the pair of block 1 that makes up the characteristic map
        let mut others = spectrum.eigenvalues[1..].to_vec();
        let tangent = others
            .iter()
            .position(|value| value.fourier == Some(1) && value.multiplicity == 2);
        tangent.map(|at| others.remove(at));
        let mu = others.first().map_or(0.0, Eigenvalue::modulus);
        let tangent = tangent.map_or(lambda, |at| spectrum.eigenvalues[at + 1].modulus());
        let s = local_matrix(level, 2)?;
        let deflated = Matrix::from_fn(s.rows(), s.columns(), |i, j| s[(i, j)] - limit[j]);
        Ok(Around {
            lambda,
            ratio: mu / tangent,
            limit,
            s,
            deflated,
            inner: from(2, 3)?,
            outer: from(3, 5)?,
            level: level.clone(),
            one: local_matrix(level, 1)?,
        })
    }

    /// Rows of the fine net of five rings for the patch whose lower corner is (p, q).
    fn rows(&self, p: i32, q: i32) -> [usize; 16] {
        self.grid(5, p, q)
    }

    fn grid(&self, rings: usize, p: i32, q: i32) -> [usize; 16] {
        let numbering = numbering(&self.level, rings);
        std::array::from_fn(|k| {
            let (x, y) = (p - 1 + (k % 4) as i32, q - 1 + (k / 4) as i32);
            let site = Site::new(self.level.fan(), 0, 2 * x, 2 * y).expect("no patch contains the centre");
            numbering
                .index(site)
                .expect("five rings hold all patches of an annulus")
        })
    }

    /// For tests: derivatives by the powers of the matrix itself.
    #[cfg(test)]
    pub fn forget_deflation(&mut self) {
        self.deflated = self.s.clone();
    }

    /// The annuli that leave less than [`REST`] of the area.
    pub fn depth(&self) -> usize {
        (REST.ln() / (2.0 * self.lambda.ln())).ceil() as usize
    }

    /// The annuli that leave less than [`ENERGY`] of the energy of second derivatives as well; `None` if they
    /// are too many, or none suffice as the functions are not in H2 (Reif and Schroeder 2001).
    pub fn plate_depth(&self) -> Option<usize> {
        let depth = (ENERGY.ln() / (2.0 * self.ratio.ln())).ceil();
        let own = self.depth();
        (self.ratio < 1.0 && depth <= MOST_ANNULI as f64).then(|| own.max(depth as usize))
    }

    /// The largest ratio with which [`MOST_ANNULI`] suffice for the energy of second derivatives.
    pub fn most_ratio(&self) -> f64 {
        ENERGY.powf(0.5 / MOST_ANNULI as f64)
    }

    /// The rule of a point of the next level over one ring, in the order of its numbering: the centre, the
    /// first edge, the first face.
    pub fn rule(&self, kind: usize) -> &[f64] {
        let [x, y] = [[0, 0], [2, 0], [2, 2]][kind];
        let site = Site::new(self.level.fan(), 0, x, y).expect("of one ring");
        self.one
            .row(numbering(&self.level, 1).index(site).expect("of one ring"))
    }

    /// A face at the centre, in sector 0, over the points of two rings.
    pub fn irregular(&self, rule: &Rule, depth: usize, scaled: bool) -> Table {
        let places: Vec<(i32, i32)> = (0..4)
            .flat_map(|q| (0..4).map(move |p| (p, q)))
            .filter(|(p, q)| *p.max(q) >= 2)
            .collect();
        let mut grids: Vec<[usize; 16]> = places.iter().map(|&(p, q)| self.rows(p, q)).collect();
        let mut kept = grids.concat();
        kept.sort_unstable();
        kept.dedup();
        for row in grids.iter_mut().flatten() {
            *row = kept.binary_search(row).expect("it is kept");
        }
        let outer = Matrix::from_fn(kept.len(), self.outer.columns(), |i, j| self.outer[(kept[i], j)]);
        // powers from the left are of these rows only
        let lift = product(&outer, &self.inner);
        let (mut power, mut deflated) = (lift.clone(), lift);
        let mut annuli = Vec::with_capacity(depth);
        for _ in 0..depth {
            let next = (product(&power, &self.s), product(&deflated, &self.deflated));
            annuli.push((power, deflated));
            (power, deflated) = next;
        }
        let mut list = Vec::new();
        for (m, (values, derivatives)) in annuli.iter().enumerate() {
            let last = scaled && m + 1 == depth;
            let factor = if last {
                1.0 / (1.0 - self.lambda * self.lambda)
            } else {
                1.0
            };
            list.extend(grids.iter().map(|rows| (*rows, values, derivatives, factor)));
        }
        // deflation subtracts a multiple of the sum of all functions, whose derivatives vanish
        let used = |column: &usize| {
            list.iter()
                .any(|(rows, values, ..)| rows.iter().any(|&r| values[(r, *column)] != 0.0))
        };
        let columns = (0..self.s.rows()).filter(used).collect();
        let mut table = patches(&list, columns, rule);
        table.limit = Some(table.columns.iter().map(|&column| self.limit[column]).collect());
        table
    }

    /// A face beside those at the centre, at (1, 0), (1, 1) or (0, 1), over its own 16 points.
    pub fn near(&self, rule: &Rule, at: [i32; 2]) -> Table {
        let [x, y] = at;
        let own = self.grid(3, x, y);
        let parts = [[0, 0], [1, 0], [0, 1], [1, 1]]
            .map(|[i, j]| (self.rows(2 * x + i, 2 * y + j), &self.outer, &self.outer, 1.0));
        let mut table = patches(&parts, own.to_vec(), rule);
        table.columns = (0..16).collect();
        table
    }
}
