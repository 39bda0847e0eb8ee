//! The core of a block: the leading rows and columns that hold all its eigenvalues other than zero.
//!
//! Refined points of outer rings read rings further in only. With A the rows of a closed set of points, the
//! block is `[A 0; B D]`, and D is strictly lower triangular from some ring on: it adds zeros to the
//! eigenvalues of A and nothing else. A right vector of A belongs to one of the block by forward
//! substitution, `y = (value - D)^-1 B x`, and a left one by zeros, so that what is known of an eigenvalue
//! other than zero, its Jordan blocks included, is known from the core. Of 60 rings around a vertex of
//! valence 5, a block of 3660 unknowns, the core has 20.
//!
//! Zeros have the rank of the whole block and of its powers, which are sparse.

use crate::eigen::{NEGLIGIBLE, to_faer};
use crate::hessenberg::Number;
use crate::{Block, Matrix, NULL};
use eigenring_scheme::Complex;
use faer::c64;

impl Number for f64 {
    fn size(self) -> f64 {
        self.abs()
    }
    fn real(value: f64) -> Self {
        value
    }
}

impl Number for c64 {
    fn size(self) -> f64 {
        self.norm()
    }
    fn real(value: f64) -> Self {
        c64::new(value, 0.0)
    }
}

impl<S: Copy> Block<S> {
    /// The first rows and columns.
    pub(crate) fn leading(&self, size: usize) -> Block<S> {
        match self {
            Block::Real(matrix) => Block::Real(Matrix::from_fn(size, size, |i, j| matrix[(i, j)])),
            Block::Complex(matrix) => Block::Complex(Matrix::from_fn(size, size, |i, j| matrix[(i, j)])),
        }
    }
}

impl Block<f64> {
    fn largest(&self) -> f64 {
        match self {
            Block::Real(matrix) => matrix.entries().iter().fold(0.0, |max, x| max.max(x.abs())),
            Block::Complex(matrix) => matrix.entries().iter().fold(0.0, |max, &x| max.max(x.modulus())),
        }
    }

    fn size_at(&self, i: usize, j: usize) -> f64 {
        match self {
            Block::Real(matrix) => matrix[(i, j)].abs(),
            Block::Complex(matrix) => matrix[(i, j)].modulus(),
        }
    }

    fn entry(&self, i: usize, j: usize) -> Complex<f64> {
        match self {
            Block::Real(matrix) => Complex::real(matrix[(i, j)]),
            Block::Complex(matrix) => matrix[(i, j)],
        }
    }

    /// How many unknowns the core has: every later row reads earlier columns only.
    pub(crate) fn core(&self) -> usize {
        let (size, null) = (self.size(), NEGLIGIBLE * self.largest());
        let last = |i: usize| (i..size).rev().find(|&j| self.size_at(i, j) > null);
        // of a matrix of numbers that are none, all
        if null.is_nan() {
            return size;
        }
        (0..size).filter_map(last).max().map_or(0, |last| last + 1)
    }

    /// The core where it tells of an eigenvalue: not of zero.
    pub(crate) fn core_for(&self, value: Complex<f64>) -> Option<Block<f64>> {
        let core = self.core();
        let known = core > 0 && core < self.size() && value.modulus() > NULL * self.largest();
        known.then(|| self.leading(core))
    }

    /// The right vector of an eigenvalue of the block whose entries in the core are given.
    pub(crate) fn extend(&self, vector: &mut Vec<Complex<f64>>, value: Complex<f64>) {
        for row in vector.len()..self.size() {
            let entries = vector.iter().enumerate();
            let sum = entries.fold(Complex::zero(), |sum, (j, &entry)| sum + self.entry(row, j) * entry);
            vector.push(sum / value);
        }
    }

    /// How many vectors the block maps to zero, by sparse elimination.
    pub(crate) fn sparse_nullity(&self) -> usize {
        self.kernels(1)[0]
    }

    /// The sizes of the Jordan blocks of zero, falling, by sparse elimination of the block's powers.
    pub(crate) fn nilpotent_sizes(&self) -> Vec<usize> {
        sizes_of(&self.kernels(self.size()))
    }

    /// The dimensions of the null spaces of the first powers, until they are the same.
    fn kernels(&self, most: usize) -> Vec<usize> {
        match self {
            Block::Real(_) => kernels(&Sparse::of(self, |entry| entry.re), most),
            Block::Complex(_) => kernels(&Sparse::of(self, to_faer), most),
        }
    }
}

fn kernels<T: Number>(matrix: &Sparse<T>, most: usize) -> Vec<usize> {
    let (mut power, mut kernels) = (matrix.clone(), Vec::new());
    loop {
        let kernel = matrix.0.len() - power.rank();
        if kernels.last() == Some(&kernel) {
            return kernels;
        }
        kernels.push(kernel);
        if kernels.len() == most {
            return kernels;
        }
        power = power.times(matrix);
    }
}

/// The sizes of Jordan blocks, falling, from the dimensions of the null spaces of the powers of `S - value`:
/// each power adds one for every block that is at least as large.
pub(crate) fn sizes_of(kernels: &[usize]) -> Vec<usize> {
    let before = |k: usize| if k == 0 { 0 } else { kernels[k - 1] };
    let at_least: Vec<usize> = (0..kernels.len())
        .map(|k| kernels[k].saturating_sub(before(k)))
        .collect();
    let mut sizes: Vec<usize> = Vec::new();
    for (index, &count) in at_least.iter().enumerate() {
        let next = at_least.get(index + 1).copied().unwrap_or(0);
        sizes.extend(std::iter::repeat_n(index + 1, count.saturating_sub(next)));
    }
    sizes.reverse();
    sizes
}

/// The nonzero entries of the rows of a square matrix, by falling column.
#[derive(Clone)]
struct Sparse<T>(Vec<Vec<(usize, T)>>);

impl<T: Number> Sparse<T> {
    fn of(block: &Block<f64>, convert: impl Fn(Complex<f64>) -> T) -> Self {
        let (size, null) = (block.size(), NEGLIGIBLE * block.largest());
        let row = |i: usize| {
            let columns = (0..size).rev().filter(|&j| block.size_at(i, j) > null);
            columns.map(|j| (j, convert(block.entry(i, j)))).collect()
        };
        Sparse((0..size).map(row).collect())
    }

    fn times(&self, other: &Sparse<T>) -> Sparse<T> {
        let row = |row: &Vec<(usize, T)>| {
            let mut sum: Vec<(usize, T)> = Vec::new();
            for &(column, factor) in row {
                sum = combine(&sum, &other.0[column], factor);
            }
            sum
        };
        Sparse(self.0.iter().map(row).collect())
    }

    /// The number of independent rows. Columns are eliminated from the outermost point inwards, where a
    /// refined point reads few others: pivots are the largest in their column, and what is left of a row is
    /// zero below [`NULL`] times its largest entry.
    fn rank(&self) -> usize {
        let size = self.0.len();
        let mut waiting: Vec<Vec<Vec<(usize, T)>>> = vec![Vec::new(); size];
        let largest = |row: &[(usize, T)]| row.iter().fold(0.0_f64, |max, x| max.max(x.1.size()));
        for row in self.0.iter().filter(|row| !row.is_empty()) {
            let scale = T::real(largest(row));
            waiting[row[0].0].push(row.iter().map(|&(j, x)| (j, x / scale)).collect());
        }
        let mut rank = 0;
        for column in (0..size).rev() {
            let mut rows = std::mem::take(&mut waiting[column]);
            let best = (0..rows.len()).max_by(|&a, &b| rows[a][0].1.size().total_cmp(&rows[b][0].1.size()));
            let Some(best) = best else { continue };
            let pivot = rows.swap_remove(best);
            rank += 1;
            for row in rows {
                let factor = row[0].1 / pivot[0].1;
                let mut rest = combine(&row[1..], &pivot[1..], T::real(0.0) - factor);
                rest.retain(|x| x.1.size() > NULL);
                if let Some(&(next, _)) = rest.first() {
                    waiting[next].push(rest);
                }
            }
        }
        rank
    }
}

/// The sum of a row and a multiple of another.
fn combine<T: Number>(a: &[(usize, T)], b: &[(usize, T)], factor: T) -> Vec<(usize, T)> {
    let (mut i, mut j) = (0, 0);
    let mut sum = Vec::with_capacity(a.len() + b.len());
    while i < a.len() || j < b.len() {
        let in_a = i < a.len() && (j == b.len() || a[i].0 >= b[j].0);
        let in_b = j < b.len() && (i == a.len() || b[j].0 >= a[i].0);
        let (column, value) = match (in_a, in_b) {
            (true, true) => (a[i].0, a[i].1 + factor * b[j].1),
            (true, false) => a[i],
            _ => (b[j].0, factor * b[j].1),
        };
        sum.push((column, value));
        i += usize::from(in_a);
        j += usize::from(in_b);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LocalSystem, fourier_blocks, local_matrix};
    use eigenring_scheme::families::{catmull_clark, doo_sabin, tension};

    /// The oracle is the singular value decomposition of the whole block.
    #[test]
    fn the_core_and_sparse_ranks_say_what_the_whole_block_says() {
        for (scheme, rings, core) in [
            (catmull_clark::<f64>(5).unwrap(), 6, 2),
            (catmull_clark(8).unwrap(), 5, 2),
            (doo_sabin(5).unwrap(), 6, 1),
            (tension(6, 6, 1.3).unwrap(), 7, 4),
        ] {
            let dense = Block::Real(local_matrix(scheme.limit(), 3.min(rings)).unwrap());
            for block in fourier_blocks(scheme.limit(), rings)
                .unwrap()
                .into_iter()
                .chain([dense])
            {
                assert!(block.core() <= scheme.numbering(core).count(), "{}", block.core());
                assert_eq!(block.sparse_nullity(), block.nullity(Complex::zero(), NULL).unwrap());
                let whole = block.eigenvalues().unwrap();
                let core = block.leading(block.core()).eigenvalues().unwrap();
                for e in whole.iter().filter(|e| e.value.modulus() > 1e-9) {
                    let same = core
                        .iter()
                        .find(|c| (c.value - e.value).modulus() < 1e-12 && c.multiplicity == e.multiplicity);
                    assert!(same.is_some(), "{e:?}");
                }
                assert_eq!(block.nilpotent_sizes(), block.jordan_sizes(Complex::zero()).unwrap());
            }
        }
    }

    /// The oracle is the matrix itself.
    #[test]
    fn vectors_are_extended_to_all_rings() {
        let scheme = catmull_clark::<f64>(5).unwrap();
        let system = LocalSystem::new(scheme.limit(), 12).unwrap();
        let matrix = local_matrix(scheme.limit(), 12).unwrap();
        for (index, value) in [(0, 1.0), (1, system.eigenvalues().unwrap().eigenvalues[1].value.re)] {
            let mode = system.single(index, value).unwrap();
            let largest = mode.values.iter().map(|v| v.modulus()).fold(0.0, f64::max);
            for i in 0..matrix.rows() {
                let image: f64 = (0..matrix.rows()).map(|j| matrix[(i, j)] * mode.values[j].re).sum();
                assert!((image - value * mode.values[i].re).abs() < 1e-13 * largest);
                let image: f64 = (0..matrix.rows()).map(|j| matrix[(j, i)] * mode.functional[j].re).sum();
                assert!((image - value * mode.functional[i].re).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn sizes_follow_from_the_dimensions_of_null_spaces() {
        assert_eq!(sizes_of(&[3, 5, 6]), [3, 2, 1]);
        assert_eq!(sizes_of(&[2]), [1, 1]);
        assert!(sizes_of(&[0]).is_empty());
    }
}
