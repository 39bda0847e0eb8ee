//! Eigenvalues and eigenspaces of one block: the policy for repeated and defective ones.
//!
//! **Values** are computed component by component (see [`components`](crate::components)), each by a QR
//! iteration. Within a component, values closer than [`EQUAL`] times its norm are taken as one repeated
//! value, represented by their mean: a defective eigenvalue of index m is scattered by rounding over a circle
//! of radius `eps^(1/m)`, but the mean of the scattered values keeps full accuracy. Values of different
//! components are computed independently and merged within [`MERGED`].
//!
//! **Vectors** span the null spaces of `S - ev` and of its transpose, found by a singular value
//! decomposition, which is as stable for repeated as for simple values. Its dimension is the geometric
//! multiplicity; below the algebraic one the eigenvalue is defective. Near a resonance (mu close to the outer
//! rings' 1/8) two eigenvectors become parallel, and left and right vectors orthogonal: their product is the
//! reciprocal condition number of the eigenvalue, given with each [`Mode`](crate::Mode).

use crate::components::strong_components;
use crate::core::sizes_of;
use crate::{Block, Error};
use eigenring_scheme::Complex;
use faer::traits::ComplexField;
use faer::{Mat, c64};

/// Two eigenvalues of one component are one if they are closer than this times the component's norm.
/// Empirical: the square root of the rounding unit, 1.5e-8, is the scatter of a double defective eigenvalue
/// of a unit matrix.
pub const EQUAL: f64 = 1e-7;

/// Eigenvalues of different components are one if they are closer than this times the larger, or than this
/// times the rounding of the whole: a hundred times the error of a well-conditioned eigenvalue.
pub const MERGED: f64 = 1e-12;

/// A singular value of `S - value` below this times the largest, or times the value, is zero. Empirical:
/// rounding leaves 1e-16 to 1e-14, and two eigenvalues that are told apart by [`EQUAL`] leave more than 1e-9.
pub const NULL: f64 = 1e-11;

/// Entries below this times the largest are rounding errors of zeros and carry no dependence: a few rounding
/// units.
pub(crate) const NEGLIGIBLE: f64 = 1e-15;

/// Blocks of more unknowns have the dimensions of zero by sparse elimination.
const MAX_DENSE: usize = 250;

/// An eigenvalue of a block with its algebraic multiplicity there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockEigenvalue {
    /// The value.
    pub value: Complex<f64>,
    /// The algebraic multiplicity in the block.
    pub multiplicity: usize,
}

/// The eigenvectors of one eigenvalue of a block, as columns of complex numbers (imaginary parts zero for
/// real blocks and values). Scaled to unit length; a basis without further meaning if there are several.
#[derive(Clone, Debug)]
pub struct Eigenspace {
    /// The eigenvalue.
    pub value: Complex<f64>,
    /// The right eigenvectors, `S r = value r`.
    pub right: Vec<Vec<Complex<f64>>>,
    /// The left eigenvectors, `l S = value l` (no conjugation).
    pub left: Vec<Vec<Complex<f64>>>,
}

impl Block<f64> {
    /// The eigenvalues by falling modulus, equal ones merged.
    ///
    /// # Errors
    /// [`Error::Decomposition`] if an entry is not finite or the iteration fails.
    pub fn eigenvalues(&self) -> Result<Vec<BlockEigenvalue>, Error> {
        match self {
            Block::Real(matrix) => eigenvalues(matrix.rows(), |i, j| matrix[(i, j)], f64::abs),
            Block::Complex(matrix) => eigenvalues(matrix.rows(), |i, j| to_faer(matrix[(i, j)]), |entry| entry.norm()),
        }
    }

    /// The eigenvectors of the given eigenvalue.
    ///
    /// # Errors
    /// [`Error::NotAnEigenvalue`] if `S - value` is regular, [`Error::Decomposition`] as above.
    pub fn eigenspace(&self, value: Complex<f64>, fourier: usize) -> Result<Eigenspace, Error> {
        match self.shifted(value) {
            Shifted::Real(matrix) => eigenspace(matrix, value, fourier, Complex::real),
            Shifted::Complex(matrix) => eigenspace(matrix, value, fourier, from_faer),
        }
    }

    /// The number of independent eigenvectors of the given eigenvalue: as many as [`Block::eigenspace`] has,
    /// with another bound in place of [`NULL`].
    ///
    /// # Errors
    /// [`Error::Decomposition`] as above.
    pub(crate) fn nullity(&self, value: Complex<f64>, null: f64) -> Result<usize, Error> {
        match self.shifted(value) {
            Shifted::Real(matrix) => nullity(matrix, value, null),
            Shifted::Complex(matrix) => nullity(matrix, value, null),
        }
    }

    /// The sizes of the Jordan blocks of an eigenvalue, falling, from the numbers of vectors that the powers
    /// of `S - value` map to zero: each power adds one for every block that is at least as large. Ranks are
    /// judged by [`NULL`], so that an eigenvalue known to half its digits, as a defective one is, has its
    /// blocks found up to size 2, and larger ones mostly.
    ///
    /// # Errors
    /// [`Error::Decomposition`] as above.
    pub fn jordan_sizes(&self, value: Complex<f64>) -> Result<Vec<usize>, Error> {
        if let Some(core) = self.core_for(value) {
            return core.jordan_sizes(value);
        }
        if self.size() > MAX_DENSE && value == Complex::zero() {
            return Ok(self.nilpotent_sizes());
        }
        let shifted = match self.shifted(value) {
            Shifted::Real(matrix) => Mat::from_fn(matrix.nrows(), matrix.nrows(), |i, j| c64::new(matrix[(i, j)], 0.0)),
            Shifted::Complex(matrix) => matrix,
        };
        let mut power = shifted.clone();
        let mut kernels = vec![0];
        loop {
            let kernel = nullity(power.clone(), Complex::zero(), NULL)?;
            let known = kernels[kernels.len() - 1];
            if kernel <= known || kernels.len() > shifted.nrows() {
                break;
            }
            kernels.push(kernel);
            power = &power * &shifted;
        }
        Ok(sizes_of(&kernels[1..]))
    }

    /// `S - value`.
    fn shifted(&self, value: Complex<f64>) -> Shifted {
        match self {
            Block::Real(matrix) if value.im == 0.0 => {
                Shifted::Real(Mat::from_fn(matrix.rows(), matrix.rows(), |i, j| {
                    matrix[(i, j)] - if i == j { value.re } else { 0.0 }
                }))
            }
            _ => {
                let matrix = self.to_complex();
                Shifted::Complex(Mat::from_fn(matrix.rows(), matrix.rows(), |i, j| {
                    let shift = if i == j { value } else { Complex::zero() };
                    to_faer(matrix[(i, j)] - shift)
                }))
            }
        }
    }
}

pub(crate) fn to_faer(value: Complex<f64>) -> c64 {
    c64::new(value.re, value.im)
}

fn from_faer(value: c64) -> Complex<f64> {
    Complex::new(value.re, value.im)
}

enum Shifted {
    Real(Mat<f64>),
    Complex(Mat<c64>),
}

fn eigenvalues<T: ComplexField<Real = f64> + Copy>(
    size: usize,
    entry: impl Fn(usize, usize) -> T,
    norm: impl Fn(T) -> f64,
) -> Result<Vec<BlockEigenvalue>, Error> {
    let mut largest = 0.0_f64;
    for i in 0..size {
        for j in 0..size {
            let size_of_entry = norm(entry(i, j));
            largest = if size_of_entry.is_nan() {
                f64::NAN
            } else {
                largest.max(size_of_entry)
            };
            if !largest.is_finite() {
                return Err(Error::Decomposition { size, largest });
            }
        }
    }
    let failure = Error::Decomposition { size, largest };
    let components = strong_components(size, |i, j| norm(entry(i, j)) > NEGLIGIBLE * largest);
    let mut all: Vec<BlockEigenvalue> = Vec::new();
    for component in components {
        let part = Mat::from_fn(component.len(), component.len(), |i, j| {
            entry(component[i], component[j])
        });
        let scale = (0..component.len())
            .map(|i| (0..component.len()).map(|j| norm(part[(i, j)])).sum::<f64>())
            .fold(0.0, f64::max);
        let values = part.eigenvalues().map_err(|_| failure.clone())?;
        for cluster in clusters(values.iter().copied().map(from_faer).collect(), EQUAL * scale) {
            let known = all
                .iter_mut()
                .find(|known| distance(known.value, cluster.value) <= MERGED * largest.max(cluster.value.modulus()));
            match known {
                Some(known) => known.multiplicity += cluster.multiplicity,
                None => all.push(cluster),
            }
        }
    }
    if all.iter().any(|e| !e.value.modulus().is_finite()) {
        return Err(failure);
    }
    all.sort_by(|a, b| order(a.value, b.value));
    Ok(all)
}

fn distance(a: Complex<f64>, b: Complex<f64>) -> f64 {
    (a - b).modulus()
}

/// Falling modulus; equal moduli with the larger real part, then the larger imaginary part first.
pub(crate) fn order(a: Complex<f64>, b: Complex<f64>) -> std::cmp::Ordering {
    b.modulus()
        .total_cmp(&a.modulus())
        .then(b.re.total_cmp(&a.re))
        .then(b.im.total_cmp(&a.im))
}

/// Merges values that are linked by chains of steps up to `radius` into their means. A real matrix's clusters
/// are symmetric about the real axis or come in conjugate pairs, so that a mean that should be real is: its
/// imaginary part is rounding.
fn clusters(values: Vec<Complex<f64>>, radius: f64) -> Vec<BlockEigenvalue> {
    let linked = strong_components(values.len(), |i, j| distance(values[i], values[j]) <= radius);
    linked
        .into_iter()
        .map(|members| {
            let count = members.len() as f64;
            let sum = members.iter().fold(Complex::zero(), |sum, &i| sum + values[i]);
            let mean = sum.map(|part| part / count);
            let real = mean.im.abs() <= f64::EPSILON * count * mean.modulus().max(radius / EQUAL);
            BlockEigenvalue {
                value: if real { Complex::real(mean.re) } else { mean },
                multiplicity: members.len(),
            }
        })
        .collect()
}

/// How many of the falling singular values of `S - value` are not zero: measured by the largest of them, and
/// by the value, of which rounding leaves a trace where the block is a multiple of the identity.
fn rank(singular: &[f64], value: Complex<f64>, null: f64) -> Result<usize, Error> {
    let largest = singular.first().copied().unwrap_or(0.0);
    if !largest.is_finite() {
        return Err(Error::Decomposition {
            size: singular.len(),
            largest,
        });
    }
    let scale = largest.max(value.modulus());
    Ok(singular.iter().filter(|&&s| s > null * scale).count())
}

fn nullity<T: ComplexField<Real = f64>>(shifted: Mat<T>, value: Complex<f64>, null: f64) -> Result<usize, Error> {
    let size = shifted.nrows();
    let singular = shifted.singular_values().map_err(|_| Error::Decomposition {
        size,
        largest: f64::NAN,
    })?;
    Ok(size - rank(&singular, value, null)?)
}

fn eigenspace<T: ComplexField<Real = f64> + Copy>(
    shifted: Mat<T>,
    value: Complex<f64>,
    fourier: usize,
    pair: impl Fn(T) -> Complex<f64>,
) -> Result<Eigenspace, Error> {
    let size = shifted.nrows();
    let svd = shifted.svd().map_err(|_| Error::Decomposition {
        size,
        largest: f64::NAN,
    })?;
    let singular: Vec<f64> = (0..size).map(|i| pair(svd.S().column_vector()[i]).re).collect();
    let rank = rank(&singular, value, NULL)?;
    if rank == size {
        return Err(Error::NotAnEigenvalue {
            value: value.re,
            fourier,
            gap: singular[size - 1],
        });
    }
    // A = U diag V^H: A v = 0 for the last columns of V, and u^H A = 0 for the last columns of U
    let column = |matrix: faer::MatRef<'_, T>, j: usize, sign: f64| -> Vec<Complex<f64>> {
        (0..size)
            .map(|i| pair(matrix[(i, j)]))
            .map(|entry| Complex::new(entry.re, sign * entry.im))
            .collect()
    };
    Ok(Eigenspace {
        value,
        right: (rank..size).map(|j| column(svd.V(), j, 1.0)).collect(),
        left: (rank..size).map(|j| column(svd.U(), j, -1.0)).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Matrix;
    use proptest::prelude::*;

    fn real(rows: &[&[f64]]) -> Block<f64> {
        Block::Real(Matrix::from_fn(rows.len(), rows.len(), |i, j| rows[i][j]))
    }

    fn product(a: &Matrix<f64>, b: &Matrix<f64>) -> Matrix<f64> {
        Matrix::from_fn(a.rows(), b.columns(), |i, j| {
            (0..a.columns()).map(|k| a[(i, k)] * b[(k, j)]).sum()
        })
    }

    #[test]
    fn a_jordan_block_has_one_eigenvalue_and_one_vector() {
        // full 3 x 3 Jordan block of 1/2, hidden by an integer similarity
        let jordan = Matrix::from_fn(3, 3, |i, j| if i == j { 0.5 } else { f64::from(j == i + 1) });
        let t = Matrix::from_fn(3, 3, |i, j| [[1.0, 2.0, 3.0], [0.0, 1.0, 4.0], [5.0, 6.0, 0.0]][i][j]);
        let inverse = Matrix::from_fn(3, 3, |i, j| {
            [[-24.0, 18.0, 5.0], [20.0, -15.0, -4.0], [-5.0, 4.0, 1.0]][i][j]
        });
        let block = Block::Real(product(&product(&t, &jordan), &inverse));
        let scattered = block.eigenvalues().unwrap();
        // index 3 is scattered by eps^(1/3), which is beyond what EQUAL merges: reported as found, never as a
        // wrong vector
        assert!(
            scattered
                .iter()
                .all(|e| distance(e.value, Complex::new(0.5, 0.0)) < 1e-2)
        );
        let space = block.eigenspace(Complex::real(0.5), 0).unwrap();
        assert_eq!((space.right.len(), space.left.len()), (1, 1));
        let product: f64 = space.left[0]
            .iter()
            .zip(&space.right[0])
            .map(|(l, r)| l.re * r.re)
            .sum();
        assert!(
            product.abs() < 1e-10,
            "left and right vectors of a defective eigenvalue are orthogonal"
        );
    }

    #[test]
    fn a_double_defective_value_is_found_to_full_accuracy() {
        let block = real(&[&[0.5, 1.0, 0.3], &[0.0, 0.5, 0.2], &[0.0, 0.0, 0.1]]);
        assert_eq!(
            block
                .eigenvalues()
                .unwrap()
                .iter()
                .map(|e| e.multiplicity)
                .collect::<Vec<_>>(),
            [2, 1]
        );
        // the same in one component
        let block = real(&[&[1.5, 1.0], &[-1.0, -0.5]]);
        let values = block.eigenvalues().unwrap();
        assert_eq!(values.len(), 1);
        assert!(values[0].multiplicity == 2 && distance(values[0].value, Complex::new(0.5, 0.0)) < 1e-15);
        assert_eq!(block.eigenspace(Complex::real(0.5), 0).unwrap().right.len(), 1);
    }

    #[test]
    fn nilpotent_parts_are_exactly_zero() {
        let block = Block::Real(Matrix::from_fn(6, 6, |i, j| if i > j { 1.0 } else { 0.0 }));
        let values = block.eigenvalues().unwrap();
        assert_eq!(
            values,
            [BlockEigenvalue {
                value: Complex::zero(),
                multiplicity: 6
            }]
        );
        assert_eq!(block.eigenspace(Complex::real(0.0), 0).unwrap().right.len(), 1);
    }

    #[test]
    fn complex_pairs_and_multiples_of_the_identity() {
        let rotation = real(&[&[0.0, -0.5], &[0.5, 0.0]]);
        let values = rotation.eigenvalues().unwrap();
        assert_eq!(values.len(), 2);
        assert!(distance(values[0].value, Complex::new(0.0, 0.5)) < 1e-15);
        let space = rotation.eigenspace(values[0].value, 0).unwrap();
        assert_eq!(space.right.len(), 1);
        let identity = real(&[&[0.25, 0.0], &[0.0, 0.25]]);
        assert_eq!(identity.eigenspace(Complex::real(0.25), 0).unwrap().right.len(), 2);
        assert!(matches!(
            identity.eigenspace(Complex::real(0.3), 0),
            Err(Error::NotAnEigenvalue { .. })
        ));
    }

    #[test]
    fn entries_that_are_not_numbers_are_refused() {
        let block = real(&[&[f64::NAN, 0.0], &[0.0, 1.0]]);
        assert!(matches!(block.eigenvalues(), Err(Error::Decomposition { .. })));
        let block = real(&[&[f64::INFINITY, 0.0], &[0.0, 1.0]]);
        assert!(matches!(block.eigenvalues(), Err(Error::Decomposition { .. })));
    }

    proptest! {
        #[test]
        fn planted_eigenvalues_and_vectors_are_found(
            values in proptest::collection::vec(-1.0..1.0_f64, 5),
            mix in proptest::collection::vec(-0.3..0.3_f64, 25),
        ) {
            // S = T D T^-1 with T = I + mix, well conditioned; its inverse by elimination on columns of the
            // identity
            let t = Matrix::from_fn(5, 5, |i, j| mix[5 * i + j] * 0.5 + f64::from(i == j));
            let rows: Vec<Vec<f64>> = (0..5).map(|j| {
                let (mut a, mut b) = (t.clone(), vec![0.0; 5]);
                b[j] = 1.0;
                for k in 0..5 {
                    for i in 0..5 {
                        if i != k {
                            let f = a[(i, k)] / a[(k, k)];
                            a = Matrix::from_fn(5, 5, |r, c| if r == i { a[(r, c)] - f * a[(k, c)] } else { a[(r, c)] });
                            b[i] -= f * b[k];
                        }
                    }
                }
                (0..5).map(|k| b[k] / a[(k, k)]).collect()
            }).collect();
            let inverse = Matrix::from_fn(5, 5, |i, j| rows[j][i]);
            let diagonal = Matrix::from_fn(5, 5, |i, j| if i == j { values[i] } else { 0.0 });
            let s = product(&product(&t, &diagonal), &inverse);
            let block = Block::Real(s.clone());
            let mut expected = values.clone();
            expected.sort_by(|a, b| b.abs().total_cmp(&a.abs()));
            let mut found: Vec<f64> = Vec::new();
            for e in block.eigenvalues().unwrap() {
                found.extend(std::iter::repeat_n(e.value.re, e.multiplicity));
                let Ok(space) = block.eigenspace(e.value, 0) else { continue };
                for r in &space.right {
                    for i in 0..5 {
                        let image: f64 = (0..5).map(|j| s[(i, j)] * r[j].re).sum();
                        prop_assert!((image - e.value.re * r[i].re).abs() < 1e-7);
                    }
                }
            }
            prop_assert_eq!(found.len(), 5);
            for (a, b) in found.iter().zip(&expected) {
                prop_assert!((a.abs() - b.abs()).abs() < 1e-6);
            }
        }
    }
}
