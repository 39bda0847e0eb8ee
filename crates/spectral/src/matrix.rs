//! The local subdivision matrix and its Fourier blocks: two readings of the same passes.
//!
//! With control points in the order of a [`Numbering`] the refined points of the same rings are `P' = S P`;
//! row `i` of S holds the weights of refined point `i`. For rotation-symmetric rules S is block-circulant,
//! and a net of Fourier index k, `P_i(x, y) = w^{k i} v(x, y)`, is mapped to one of the same index by the
//! block `S_k` (Ball and Storry 1988). Rows and columns of `S_k` are the points of sector 0 in numbering
//! order, preceded by the centre if k = 0 and the centre is a point. For levels with mirror symmetry the
//! unknowns are the real ones of [`FourierNet`] and `S_k` is a real matrix.

use crate::{Error, Extended};
use eigenring_scheme::{Complex, DenseNet, FourierNet, Level, Net, Numbering, Plan, Scalar, Site, refine};

/// A dense matrix, stored by rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix<T> {
    rows: usize,
    columns: usize,
    entries: Vec<T>,
}

impl<T: Clone> Matrix<T> {
    /// The matrix with the entries `f(row, column)`.
    pub fn from_fn(rows: usize, columns: usize, mut f: impl FnMut(usize, usize) -> T) -> Self {
        let entries = (0..rows * columns).map(|i| f(i / columns, i % columns)).collect();
        Matrix { rows, columns, entries }
    }

    /// The matrix with the given rows, all of length `columns`.
    pub fn from_rows(rows: Vec<Vec<T>>, columns: usize) -> Self {
        debug_assert!(rows.iter().all(|row| row.len() == columns), "rows differ in length");
        Matrix {
            rows: rows.len(),
            columns,
            entries: rows.into_iter().flatten().collect(),
        }
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// One row.
    pub fn row(&self, row: usize) -> &[T] {
        &self.entries[row * self.columns..(row + 1) * self.columns]
    }

    pub(crate) fn row_mut(&mut self, row: usize) -> &mut [T] {
        &mut self.entries[row * self.columns..(row + 1) * self.columns]
    }

    /// A row, and all that follow.
    pub(crate) fn row_and_rest(&mut self, row: usize) -> (&mut [T], &mut [T]) {
        self.entries[row * self.columns..].split_at_mut(self.columns)
    }

    /// The entries by rows.
    pub fn entries(&self) -> &[T] {
        &self.entries
    }

    /// The matrix of the images of the entries.
    pub fn map<U>(&self, f: impl Fn(T) -> U) -> Matrix<U> {
        Matrix {
            rows: self.rows,
            columns: self.columns,
            entries: self.entries.iter().cloned().map(f).collect(),
        }
    }
}

impl<T> std::ops::Index<(usize, usize)> for Matrix<T> {
    type Output = T;
    fn index(&self, (row, column): (usize, usize)) -> &T {
        &self.entries[row * self.columns + column]
    }
}

impl<T> std::ops::IndexMut<(usize, usize)> for Matrix<T> {
    fn index_mut(&mut self, (row, column): (usize, usize)) -> &mut T {
        &mut self.entries[row * self.columns + column]
    }
}

/// The Fourier block `S_k`, real where the rules have mirror symmetry.
#[derive(Clone, Debug)]
pub enum Block<S> {
    /// In the real unknowns of [`FourierNet`].
    Real(Matrix<S>),
    /// In the values `v(x, y)` themselves.
    Complex(Matrix<Complex<S>>),
}

impl<S: Scalar> Block<S> {
    /// The number of rows and columns.
    pub fn size(&self) -> usize {
        match self {
            Block::Real(matrix) => matrix.rows(),
            Block::Complex(matrix) => matrix.rows(),
        }
    }

    /// The block with complex entries, whatever it was.
    pub fn to_complex(&self) -> Matrix<Complex<S>> {
        match self {
            Block::Real(matrix) => matrix.map(Complex::real),
            Block::Complex(matrix) => matrix.clone(),
        }
    }
}

impl Block<f64> {
    /// The same numbers in more precision.
    pub(crate) fn lifted(&self) -> Block<Extended> {
        let lift = Extended::exact;
        match self {
            Block::Real(matrix) => Block::Real(matrix.map(lift)),
            Block::Complex(matrix) => Block::Complex(matrix.map(|entry| entry.map(lift))),
        }
    }
}

/// The net of `level` out to `rings`.
pub fn numbering<S: Scalar>(level: &Level<S>, rings: usize) -> Numbering {
    Numbering {
        fan: level.fan(),
        lattice: level.lattice(),
        rings,
    }
}

/// The local matrix on `rings` rings, rows and columns in the order of the [`numbering`].
///
/// # Errors
/// [`Error::Scheme`] if a refined point of these rings reads a control point beyond them.
pub fn local_matrix<S: Scalar>(level: &Level<S>, rings: usize) -> Result<Matrix<S>, Error> {
    let numbering = numbering(level, rings);
    let rows = refine(level, &DenseNet { numbering }, &numbering.sites())?;
    Ok(Matrix::from_rows(rows, numbering.count()))
}

/// The Fourier block of index `index` on `rings` rings.
///
/// # Errors
/// [`Error::NotSymmetric`] if the rules differ from sector to sector; otherwise as [`local_matrix`].
pub fn fourier_block<S: Scalar>(level: &Level<S>, rings: usize, index: usize) -> Result<Block<S>, Error> {
    Assembly::new(level, rings)?.block(index)
}

/// The blocks of index 0 to N/2; block N-k is the complex conjugate of block k.
///
/// # Errors
/// As [`fourier_block`].
pub fn fourier_blocks<S: Scalar>(level: &Level<S>, rings: usize) -> Result<Vec<Block<S>>, Error> {
    let assembly = Assembly::new(level, rings)?;
    (0..=level.fan().sectors() / 2)
        .map(|index| assembly.block(index))
        .collect()
}

/// What the Fourier blocks of a level share: the plan by which one point of each orbit is made, from which
/// the rows of all its unknowns follow.
pub(crate) struct Assembly<S> {
    /// The net of index 0, which has all rows.
    net: FourierNet<S>,
    mirror: bool,
    orbits: Vec<Site>,
    plan: Plan<S>,
}

impl<S: Scalar> Assembly<S> {
    pub fn new(level: &Level<S>, rings: usize) -> Result<Self, Error> {
        if !level.is_rotation_symmetric() {
            return Err(Error::NotSymmetric);
        }
        let (numbering, mirror) = (numbering(level, rings), level.has_mirror());
        // orbits are the same for all indices
        let net = FourierNet::<S>::new(numbering, 0, mirror)?;
        let mut orbits: Vec<Site> = net.rows().into_iter().map(|site| net.orbit(site)).collect();
        orbits.sort_unstable();
        orbits.dedup();
        let plan = Plan::new(level, |site| net.orbit(site), &orbits)?;
        Ok(Assembly {
            net,
            mirror,
            orbits,
            plan,
        })
    }

    pub fn block(&self, index: usize) -> Result<Block<S>, Error> {
        let net = self.net.of_index(index)?;
        let values = self.plan.run(&net)?;
        let rows = net.rows().into_iter().map(|site| {
            let position = self.orbits.binary_search(&net.orbit(site));
            net.unknown_row(site, &values[position.expect("every orbit was computed")])
        });
        let matrix = Matrix::from_rows(rows.collect(), net.size());
        Ok(if self.mirror {
            Block::Real(matrix.map(|entry| entry.re))
        } else {
            Block::Complex(matrix)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::families::{catmull_clark, doo_sabin, tension};
    use eigenring_scheme::lambda::{Bounds, Domain, Relaxation};
    use eigenring_scheme::{PointNet, Scheme, Symmetry};

    /// `sum_j M[row of sector 0, column of sector j] w^{k j}`: the block by the discrete Fourier transform of
    /// the matrix.
    fn transformed(matrix: &Matrix<f64>, numbering: Numbering, index: usize) -> Matrix<Complex<f64>> {
        let n = numbering.fan.sectors();
        let net = FourierNet::<f64>::new(numbering, index, false).unwrap();
        let sites = net.rows();
        let position = |site: Site, by: usize| numbering.index(site.rotated(numbering.fan, by as i64)).unwrap();
        Matrix::from_fn(sites.len(), sites.len(), |row, column| {
            if sites[column] == Site::CENTRE {
                return Complex::real(matrix[(position(sites[row], 0), 0)]);
            }
            (0..n).fold(Complex::zero(), |sum, j| {
                let angle = std::f64::consts::TAU * ((index * j) % n) as f64 / n as f64;
                let entry = matrix[(position(sites[row], 0), position(sites[column], j))];
                sum + Complex::new(angle.cos(), angle.sin()).scale(entry)
            })
        })
    }

    /// Values at sector-0 sites in terms of the real unknowns: `v = T u`.
    fn basis(numbering: Numbering, index: usize) -> Matrix<Complex<f64>> {
        let net = FourierNet::<f64>::new(numbering, index, true).unwrap();
        let sites = net.rows();
        Matrix::from_fn(sites.len(), sites.len(), |row, column| {
            let mut unknowns = vec![Complex::zero(); sites.len()];
            unknowns[column] = Complex::one();
            net.mode(&unknowns, sites[row]).unwrap()
        })
    }

    fn product(a: &Matrix<Complex<f64>>, b: &Matrix<Complex<f64>>) -> Matrix<Complex<f64>> {
        Matrix::from_fn(a.rows(), b.columns(), |i, j| {
            (0..a.columns()).fold(Complex::zero(), |sum, k| sum + a[(i, k)] * b[(k, j)])
        })
    }

    fn distance(a: &Matrix<Complex<f64>>, b: &Matrix<Complex<f64>>) -> f64 {
        let pairs = a.entries().iter().zip(b.entries());
        pairs.map(|(a, b)| (*a - *b).modulus()).fold(0.0, f64::max)
    }

    fn schemes(valence: usize) -> Vec<Scheme<f64>> {
        let mut schemes = vec![catmull_clark(valence).unwrap(), doo_sabin(valence).unwrap()];
        for order in [3, 5, 6, 8] {
            schemes.push(tension(valence, order, 0.4).unwrap());
        }
        for lambda in [0.3, 0.55, 0.7] {
            let plane = Relaxation::new(valence).unwrap().plane(lambda).unwrap();
            let domain = Domain::new(plane, Bounds::Sharp, 0.0).unwrap();
            for [f2, f3] in domain.starts(3) {
                schemes.push(plane.stencil(f2, f3).weights.scheme("lambda", valence).unwrap());
            }
        }
        schemes
    }

    #[test]
    fn fourier_blocks_are_the_transform_of_the_dense_matrix() {
        for valence in 3..=20 {
            for scheme in schemes(valence) {
                let level = scheme.level(0);
                let rings = scheme.closed_rings().unwrap() + 1;
                let matrix = local_matrix(level, rings).unwrap();
                for index in [0, 1, 2, 3, valence / 2, valence - 1] {
                    let index = index % valence;
                    let expected = transformed(&matrix, numbering(level, rings), index);
                    let plain = level.clone().with_at_most(Symmetry::Rotation);
                    let complex = fourier_block(&plain, rings, index).unwrap().to_complex();
                    assert!(
                        distance(&complex, &expected) < 1e-14,
                        "{} {valence} {index}",
                        scheme.name()
                    );
                    // and the real block is the same map in other unknowns
                    let real = fourier_block(level, rings, index).unwrap().to_complex();
                    let basis = basis(numbering(level, rings), index);
                    let error = distance(&product(&complex, &basis), &product(&basis, &real));
                    assert!(error < 4e-15, "{} {valence} {index}: {error}", scheme.name());
                }
            }
        }
    }

    #[test]
    fn refinement_of_points_is_multiplication_by_the_matrix() {
        for scheme in schemes(5) {
            let level = scheme.level(0);
            let rings = scheme.closed_rings().unwrap() + 2;
            let (matrix, numbering) = (local_matrix(level, rings).unwrap(), numbering(level, rings));
            let points: Vec<[f64; 1]> = (0..numbering.count()).map(|i| [(i as f64 * 0.7).sin()]).collect();
            let net = PointNet {
                numbering,
                points: points.clone(),
            };
            let refined = refine(level, &net, &numbering.sites()).unwrap();
            for (row, [value]) in refined.iter().enumerate() {
                let expected: f64 = matrix.row(row).iter().zip(&points).map(|(m, p)| m * p[0]).sum();
                assert!((value - expected).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn too_few_rings_are_an_error() {
        let scheme = tension::<f64>(5, 8, 1.0).unwrap();
        assert!(matches!(local_matrix(scheme.limit(), 2), Err(Error::Scheme(_))));
    }
}
