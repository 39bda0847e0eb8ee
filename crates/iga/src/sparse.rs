//! Sparse matrices by rows, and the Cholesky factor of symmetric ones.

use crate::Error;
use crate::ordering::dissected;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side, Spec};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// A matrix by rows, columns ascending in each.
#[derive(Clone, Debug)]
pub(crate) struct Sparse {
    pub width: usize,
    pub starts: Vec<usize>,
    pub columns: Vec<u32>,
    pub values: Vec<f64>,
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(crate) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// Unknowns from which on an order by places is tried: with fewer, factors of both take the same time.
const DISSECTED: usize = 20_000;

/// Weights of rules are O(1), and where they cancel they leave rounding below this.
const CANCELLED: f64 = 1e-14;

/// Rows of a block that are computed one after the other, and blocks that wait to be appended: a bound on
/// memory.
const ROWS: usize = 4096;
const BLOCKS: usize = 32;

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

    /// The identity but for some rows, by number; their columns are in any order.
    pub fn identity_but(size: usize, mut rows: BTreeMap<u32, Vec<(u32, f64)>>) -> Self {
        let mut starts = Vec::with_capacity(size + 1);
        starts.push(0);
        let (mut columns, mut values) = (Vec::with_capacity(size), Vec::with_capacity(size));
        for row in 0..size as u32 {
            match rows.remove(&row) {
                None => {
                    columns.push(row);
                    values.push(1.0);
                }
                Some(mut entries) => {
                    entries.sort_unstable_by_key(|(column, _)| *column);
                    columns.extend(entries.iter().map(|(column, _)| *column));
                    values.extend(entries.iter().map(|(_, value)| *value));
                }
            }
            starts.push(columns.len());
        }
        Sparse {
            width: size,
            starts,
            columns,
            values,
        }
    }

    /// Whether a row is that of the identity.
    pub fn is_unit(&self, row: usize) -> bool {
        let range = self.starts[row]..self.starts[row + 1];
        range.len() == 1 && self.columns[range.start] as usize == row && self.values[range.start] == 1.0
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

    /// From rows that are appended to the columns and values of their block, blocks at the same time.
    fn by_blocks<S>(
        [height, width]: [usize; 2],
        scratch: impl Fn() -> S + Sync + Send,
        append: impl Fn(&mut S, usize, &mut Vec<u32>, &mut Vec<f64>) + Sync,
    ) -> Self {
        let block = |scratch: &mut S, first: usize| {
            let (mut ends, mut columns, mut values) = (Vec::with_capacity(ROWS), Vec::new(), Vec::new());
            for row in first..height.min(first + ROWS) {
                append(scratch, row, &mut columns, &mut values);
                ends.push(columns.len());
            }
            (ends, columns, values)
        };
        let firsts: Vec<usize> = (0..height).step_by(ROWS).collect();
        let mut starts = Vec::with_capacity(height + 1);
        starts.push(0);
        let (mut columns, mut values) = (Vec::new(), Vec::new());
        for firsts in firsts.chunks(BLOCKS) {
            let blocks: Vec<_> = firsts
                .par_iter()
                .map_init(&scratch, |scratch, &first| block(scratch, first))
                .collect();
            for (ends, own_columns, own_values) in blocks {
                starts.extend(ends.into_iter().map(|end| columns.len() + end));
                columns.extend(own_columns);
                values.extend(own_values);
            }
        }
        columns.shrink_to_fit();
        values.shrink_to_fit();
        Sparse {
            width,
            starts,
            columns,
            values,
        }
    }

    /// A B.
    pub fn product(&self, other: &Sparse) -> Self {
        let scratch = || (vec![0.0; other.width], vec![false; other.width], Vec::new());
        Sparse::by_blocks(
            [self.height(), other.width],
            scratch,
            |(sums, seen, touched), row, columns, values| {
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
                for column in touched.drain(..) {
                    columns.push(column);
                    values.push(std::mem::take(&mut sums[column as usize]));
                    seen[column as usize] = false;
                }
            },
        )
    }

    /// Without weights that have cancelled.
    pub fn pruned(&self) -> Self {
        let size = [self.height(), self.width];
        Sparse::by_blocks(
            size,
            || (),
            |(), row, columns, values| {
                for (column, value) in self.row(row).filter(|(_, w)| w.abs() > CANCELLED) {
                    columns.push(column as u32);
                    values.push(value);
                }
            },
        )
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

    /// The factor of a symmetric matrix, which makes room for it. The order of elimination has approximate
    /// minimum degree or, of two whose entries are counted, follows the places of the unknowns.
    ///
    /// # Errors
    /// [`Error::TooLarge`] before anything is factored, [`Error::NotDefinite`] for a pivot that is not
    /// positive.
    pub fn factor(self, places: Option<&[[f64; 3]]>) -> Result<Factor, Error> {
        let unknowns = self.height();
        let too_large = || Error::TooLarge { unknowns };
        let half = (self.columns.len() + unknowns) / 2;
        let (mut starts, mut rows, mut values) = (vec![0_u32], Vec::with_capacity(half), Vec::with_capacity(half));
        for column in 0..unknowns {
            for (row, value) in self.row(column).filter(|(row, _)| *row >= column) {
                rows.push(row as u32);
                values.push(value);
            }
            starts.push(u32::try_from(rows.len()).map_err(|_| too_large())?);
        }
        let pattern = SymbolicSparseColMat::new_checked(unknowns, unknowns, starts, None, rows);
        let analysed = |order: SymmetricOrdering<'_, u32>| {
            factorize_symbolic_cholesky(pattern.as_ref(), Side::Lower, order, CholeskySymbolicParams::default())
        };
        let by_places = |places: &[[f64; 3]]| {
            let order = dissected(&self, places);
            let mut numbers = vec![0; unknowns];
            (0..).zip(&order).for_each(|(k, &v)| numbers[v as usize] = k);
            analysed(SymmetricOrdering::Custom(PermRef::new_checked(
                &order, &numbers, unknowns,
            )))
        };
        let places = places.filter(|_| unknowns >= DISSECTED);
        let (by_degree, by_places) = rayon::join(|| analysed(SymmetricOrdering::Amd), || places.map(by_places));
        drop(self);
        let found = [Some(by_degree), by_places].into_iter().flatten().flatten();
        let symbolic = found.min_by_key(SymbolicCholesky::len_val).ok_or_else(too_large)?;
        let matrix = SparseColMat::new(pattern, values);
        let mut values = vec![0.0; symbolic.len_val()];
        let room = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let mut room = MemBuffer::try_new(room).map_err(|_| too_large())?;
        symbolic
            .factorize_numeric_llt(
                &mut values,
                matrix.as_ref(),
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut room),
                Spec::default(),
            )
            .map_err(|_| Error::NotDefinite { unknowns })?;
        Ok(Factor { symbolic, values })
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

    /// Adds values of these unknowns to those of all.
    pub fn add(&self, values: &[f64], all: &mut [f64]) {
        self.list.iter().zip(values).for_each(|(&i, value)| all[i] += value);
    }

    pub fn gather<T: Copy>(&self, all: &[T]) -> Vec<T> {
        self.list.iter().map(|&i| all[i]).collect()
    }
}

/// `A = L L^T`.
pub(crate) struct Factor {
    symbolic: SymbolicCholesky<u32>,
    values: Vec<f64>,
}

impl Factor {
    /// Its entries, with zeros in the blocks of columns that share their rows.
    #[cfg(test)]
    pub fn len(&self) -> usize {
        self.values.len()
    }

    pub fn solve(&self, right: &[f64]) -> Vec<f64> {
        let mut solution = right.to_vec();
        let mut room = MemBuffer::new(self.symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(&mut solution, right.len(), 1),
            Par::Seq,
            MemStack::new(&mut room),
        );
        solution
    }
}
