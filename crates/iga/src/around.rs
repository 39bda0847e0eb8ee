//! What the rules around an extraordinary vertex give: the annuli of its faces, and the limit there.
//!
//! A face at an extraordinary vertex consists of annuli m = 0, 1, .., each of 12 bicubic patches with control
//! points `T_53 T_32 S^m`. Derivatives use `S - 1 l^T` in place of S: the rows of `S^m` tend to the limit
//! stencil l, and their differences would lose `lambda^-m` of their digits for each order. A patch has
//! parameters of its own, so there are no powers of two; Jacobians may become as small as `lambda^2m`.

use crate::patch::{FUNCTIONS, Jets};
use crate::tables::{Annulus, Lift, Patch, Table, combined};
use crate::{Error, MOST_ANNULI};
use eigenring_scheme::{DenseNet, Level, Site, refine};
use eigenring_spectral::{Eigenvalue, LocalSystem, Matrix, local_matrix, numbering};
use std::sync::Arc;

/// The part of the area that annuli may leave out: rounding.
const REST: f64 = 1e-16;

/// The part of the energy of second derivatives that annuli may leave out.
const ENERGY: f64 = 1e-10;

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
    fn rows(&self, p: i32, q: i32) -> [usize; FUNCTIONS] {
        self.grid(5, p, q)
    }

    fn grid(&self, rings: usize, p: i32, q: i32) -> [usize; FUNCTIONS] {
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
    pub fn irregular(&self, jets: &Arc<Jets>, depth: usize, scaled: bool) -> Table {
        let places: Vec<(i32, i32)> = (0..4)
            .flat_map(|q| (0..4).map(move |p| (p, q)))
            .filter(|(p, q)| *p.max(q) >= 2)
            .collect();
        let mut grids: Vec<[usize; FUNCTIONS]> = places.iter().map(|&(p, q)| self.rows(p, q)).collect();
        let kept = renumbered(&mut grids);
        let outer = Matrix::from_fn(kept.len(), self.outer.columns(), |i, j| self.outer[(kept[i], j)]);
        // powers from the left are of these rows only
        let lift = combined(&outer, &self.inner);
        let (mut power, mut deflated) = (lift.clone(), lift);
        let mut all = Vec::with_capacity(depth);
        for _ in 0..depth {
            let next = (combined(&power, &self.s), combined(&deflated, &self.deflated));
            all.push((power, deflated));
            (power, deflated) = next;
        }
        // deflation subtracts a multiple of the sum of all functions, whose derivatives vanish
        let used = |column: &usize| {
            let mut values = all.iter().map(|(values, _)| values);
            values.any(|values| (0..values.rows()).any(|r| values[(r, *column)] != 0.0))
        };
        let columns: Vec<usize> = (0..self.s.rows()).filter(used).collect();
        let part = |m: &Matrix<f64>| Matrix::from_fn(m.rows(), columns.len(), |i, j| m[(i, columns[j])]);
        let annulus = |(m, (values, derivatives)): (usize, &(Matrix<f64>, Matrix<f64>))| {
            let last = scaled && m + 1 == depth;
            let factor = match last {
                true => 1.0 / (1.0 - self.lambda * self.lambda),
                false => 1.0,
            };
            let patch = |rows: &[usize; FUNCTIONS]| Patch {
                rows: *rows,
                jets: Arc::clone(jets),
                factor,
            };
            Annulus {
                lift: Some(Lift {
                    values: part(values),
                    derivatives: part(derivatives),
                }),
                patches: grids.iter().map(patch).collect(),
            }
        };
        Table {
            annuli: all.iter().enumerate().map(annulus).collect(),
            limit: Some(columns.iter().map(|&column| self.limit[column]).collect()),
            columns,
        }
    }

    /// A face beside those at the centre, at (1, 0), (1, 1) or (0, 1), over its own 16 points.
    pub fn near(&self, jets: &Arc<Jets>, at: [i32; 2]) -> Table {
        let [x, y] = at;
        let own = self.grid(3, x, y);
        let parts = [[0, 0], [1, 0], [0, 1], [1, 1]];
        let mut grids = parts.map(|[i, j]| self.rows(2 * x + i, 2 * y + j));
        let kept = renumbered(&mut grids);
        let rows = Matrix::from_fn(kept.len(), FUNCTIONS, |i, j| self.outer[(kept[i], own[j])]);
        let patch = |rows: &[usize; FUNCTIONS]| Patch {
            rows: *rows,
            jets: Arc::clone(jets),
            factor: 1.0,
        };
        Table {
            columns: (0..FUNCTIONS).collect(),
            annuli: vec![Annulus {
                lift: Some(Lift {
                    values: rows.clone(),
                    derivatives: rows,
                }),
                patches: grids.iter().map(patch).collect(),
            }],
            limit: None,
        }
    }
}

/// Numbers the points of patches from zero; the numbers that they had, in ascending order.
fn renumbered(grids: &mut [[usize; FUNCTIONS]]) -> Vec<usize> {
    let mut kept = grids.concat();
    kept.sort_unstable();
    kept.dedup();
    for row in grids.iter_mut().flatten() {
        *row = kept.binary_search(row).expect("it is kept");
    }
    kept
}
