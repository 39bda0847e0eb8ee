//! Sparse matrices by rows, and the Cholesky factor of symmetric ones.

use crate::Error;
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::Llt;
use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use rayon::prelude::*;

/// A matrix by rows, columns ascending in each.
#[derive(Clone, Debug)]
pub(crate) struct Sparse {
    pub width: usize,
    pub starts: Vec<usize>,
    pub columns: Vec<u32>,
    pub values: Vec<f64>,
}

/// Weights of rules are O(1), and where they cancel they leave rounding below this.
const CANCELLED: f64 = 1e-14;

impl Sparse {
    /// From rows whose columns ascend.
    pub fn from_rows(rows: &[Vec<(u32, f64)>], width: usize) -> Self {
        let mut starts = vec![0];
        let (mut columns, mut values) = (Vec::new(), Vec::new());
        for row in rows {
            for &(column, value) in row {
                columns.push(column);
                values.push(value);
            }
            starts.push(columns.len());
        }
        Sparse {
            width,
            starts,
            columns,
            values,
        }
    }

    pub fn height(&self) -> usize {
        self.starts.len() - 1
    }

    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.starts[row]..self.starts[row + 1];
        let columns = self.columns[range.clone()].iter().map(|&c| c as usize);
        columns.zip(self.values[range].iter().copied())
    }

    /// A row times x, in four sums that do not wait for each other.
    pub fn row_times(&self, row: usize, x: &[f64]) -> f64 {
        let range = self.starts[row]..self.starts[row + 1];
        let (columns, values) = (&self.columns[range.clone()], &self.values[range]);
        let (columns, last_columns) = columns.as_chunks::<4>();
        let (values, last_values) = values.as_chunks::<4>();
        let mut sums = [0.0; 4];
        for (columns, values) in columns.iter().zip(values) {
            for k in 0..4 {
                sums[k] += values[k] * x[columns[k] as usize];
            }
        }
        let last = last_columns.iter().zip(last_values);
        let rest: f64 = last.map(|(&column, value)| value * x[column as usize]).sum();
        (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
    }

    pub fn diagonal(&self) -> Vec<f64> {
        let of = |row: usize| {
            self.row(row)
                .find(|(column, _)| *column == row)
                .map_or(0.0, |(_, value)| value)
        };
        (0..self.height()).map(of).collect()
    }

    /// A x.
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        let rows = (0..self.height()).into_par_iter().with_min_len(1024);
        rows.map(|row| self.row_times(row, x)).collect()
    }

    pub fn transposed(&self) -> Self {
        let mut starts = vec![0; self.width + 1];
        self.columns.iter().for_each(|&c| starts[c as usize + 1] += 1);
        (0..self.width).for_each(|c| starts[c + 1] += starts[c]);
        let mut next = starts.clone();
        let (mut columns, mut values) = (vec![0; self.columns.len()], vec![0.0; self.columns.len()]);
        for row in 0..self.height() {
            for (column, value) in self.row(row) {
                columns[next[column]] = row as u32;
                values[next[column]] = value;
                next[column] += 1;
            }
        }
        Sparse {
            width: self.height(),
            starts,
            columns,
            values,
        }
    }

    /// A B.
    pub fn product(&self, other: &Sparse) -> Self {
        let scratch = || (vec![0.0; other.width], vec![false; other.width], Vec::new());
        let rows: Vec<Vec<(u32, f64)>> = (0..self.height())
            .into_par_iter()
            .with_min_len(4096)
            .map_init(scratch, |(sums, seen, touched), row| {
                for (k, a) in self.row(row) {
                    for (column, b) in other.row(k) {
                        if !seen[column] {
                            seen[column] = true;
                            touched.push(column as u32);
                        }
                        sums[column] += a * b;
                    }
                }
                touched.sort_unstable();
                let result = touched.iter().map(|&column| (column, sums[column as usize])).collect();
                for column in touched.drain(..) {
                    sums[column as usize] = 0.0;
                    seen[column as usize] = false;
                }
                result
            })
            .collect();
        Sparse::from_rows(&rows, other.width)
    }

    /// Without weights that have cancelled.
    pub fn pruned(&self) -> Self {
        let kept = |row: usize| {
            let row = self.row(row).filter(|(_, w)| w.abs() > CANCELLED);
            row.map(|(column, w)| (column as u32, w)).collect()
        };
        let rows: Vec<Vec<(u32, f64)>> = (0..self.height()).map(kept).collect();
        Sparse::from_rows(&rows, self.width)
    }

    /// The rows and columns that have a number, in its order; numbers ascend.
    pub fn part(&self, rows: &Numbering, columns: &Numbering) -> Self {
        let mut starts = Vec::with_capacity(rows.list.len() + 1);
        starts.push(0);
        let (mut kept, mut values) = (Vec::new(), Vec::new());
        for &row in &rows.list {
            for (column, value) in self.row(row) {
                let number = columns.of[column];
                if number != u32::MAX {
                    kept.push(number);
                    values.push(value);
                }
            }
            starts.push(kept.len());
        }
        Sparse {
            width: columns.list.len(),
            starts,
            columns: kept,
            values,
        }
    }

    /// The factor of a symmetric matrix, which makes room for it.
    pub fn factor(self) -> Result<Factor, Error> {
        let unknowns = self.height();
        let refused = || Error::NotDefinite { unknowns };
        let half = (self.columns.len() + unknowns) / 2;
        let (mut starts, mut rows, mut values) = (vec![0_u32], Vec::with_capacity(half), Vec::with_capacity(half));
        for column in 0..unknowns {
            for (row, value) in self.row(column).filter(|(row, _)| *row >= column) {
                rows.push(row as u32);
                values.push(value);
            }
            starts.push(u32::try_from(rows.len()).map_err(|_| refused())?);
        }
        drop(self);
        let symbolic = SymbolicSparseColMat::new_checked(unknowns, unknowns, starts, None, rows);
        let matrix = SparseColMat::new(symbolic, values);
        let factor = matrix.sp_cholesky(faer::Side::Lower).map_err(|_| refused())?;
        Ok(Factor { factor, unknowns })
    }
}

/// Which of all unknowns are solved for.
#[derive(Clone, Debug)]
pub(crate) struct Numbering {
    pub list: Vec<usize>,
    of: Vec<u32>,
}

impl Numbering {
    pub fn new(free: &[bool]) -> Self {
        let list: Vec<usize> = (0..free.len()).filter(|&i| free[i]).collect();
        let mut of = vec![u32::MAX; free.len()];
        list.iter().enumerate().for_each(|(k, &i)| of[i] = k as u32);
        Numbering { list, of }
    }

    /// Without the first one.
    pub fn without_first(&self) -> Self {
        let mut free = vec![false; self.of.len()];
        self.list.iter().skip(1).for_each(|&i| free[i] = true);
        Numbering::new(&free)
    }

    pub fn gather(&self, all: &[f64]) -> Vec<f64> {
        self.list.iter().map(|&i| all[i]).collect()
    }
}

/// `A = L L^T`.
pub(crate) struct Factor {
    factor: Llt<u32, f64>,
    unknowns: usize,
}

impl Factor {
    pub fn solve(&self, right: &[f64]) -> Vec<f64> {
        let right = faer::Mat::from_fn(self.unknowns, 1, |i, _| right[i]);
        let result = self.factor.solve(&right);
        (0..self.unknowns).map(|i| result[(i, 0)]).collect()
    }
}
