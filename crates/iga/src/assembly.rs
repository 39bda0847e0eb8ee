//! Matrices and loads over all unknowns, summed over the faces.

use crate::Error;
use crate::integrals::{Form, Integrands, Load, Tables};
use crate::part::{Part, Workplace, ranges};
use crate::space::Space;
use crate::sparse::Sparse;
use rayon::prelude::*;

/// Parts that are added up before others are made: the faces of an extraordinary vertex of high valence have
/// all rows in common, and take much more memory in parts than in sum.
const PARTS: usize = 128;
/// Rows that are added up together.
const ROWS: usize = 4096;

/// Where the rows of an unknown are.
struct Places {
    starts: Vec<u32>,
    /// The part, and the row in it.
    rows: Vec<[u32; 2]>,
}

impl Places {
    /// Of the unknowns with these numbers.
    fn new(parts: &[Part], ids: &[u32], count: usize) -> Self {
        let mut numbers = vec![0; count];
        (0..).zip(ids).for_each(|(k, &id)| numbers[id as usize] = k);
        let mut starts = vec![0; ids.len() + 1];
        let all = parts.iter().flat_map(|part| &part.ids);
        all.for_each(|&id| starts[numbers[id as usize] as usize + 1] += 1);
        (0..ids.len()).for_each(|k| starts[k + 1] += starts[k]);
        let mut next = starts.clone();
        let mut rows = vec![[0; 2]; starts[ids.len()] as usize];
        for (part, of_part) in (0..).zip(parts) {
            for (row, &id) in (0..).zip(&of_part.ids) {
                let next = &mut next[numbers[id as usize] as usize];
                rows[*next as usize] = [part, row];
                *next += 1;
            }
        }
        Places { starts, rows }
    }

    /// The rows of an unknown, in the order of the parts.
    fn of<'a>(&'a self, parts: &'a [Part], number: usize) -> impl Iterator<Item = (&'a Part, usize)> + Clone {
        let rows = &self.rows[self.starts[number] as usize..self.starts[number + 1] as usize];
        rows.iter().map(|&[part, row]| (&parts[part as usize], row as usize))
    }
}

impl Part {
    fn row(&self, row: usize) -> std::ops::Range<usize> {
        self.starts[row]..self.starts[row + 1]
    }
}

/// The columns of some rows together, ascending.
fn union<'a>(rows: impl Iterator<Item = (&'a Part, usize)>, columns: &mut Vec<u32>) {
    columns.clear();
    for (part, row) in rows {
        columns.extend(&part.columns[part.row(row)]);
    }
    columns.sort_unstable();
    columns.dedup();
}

/// The sum of some parts over unknowns that ascend, theirs or more, out of all. Sums run in the order of the
/// parts.
fn added(parts: &[Part], ids: Vec<u32>, count: usize, forms: usize) -> Part {
    let places = Places::new(parts, &ids, count);
    let size = |columns: &mut Vec<u32>, number: usize| {
        let rows = places.of(parts, number);
        match rows.clone().take(2).count() {
            0 | 1 => rows.map(|(part, row)| part.row(row).len()).sum(),
            _ => {
                union(rows, columns);
                columns.len()
            }
        }
    };
    let sizes: Vec<usize> = (0..ids.len())
        .into_par_iter()
        .with_min_len(ROWS)
        .map_init(Vec::new, size)
        .collect();
    let mut starts = Vec::with_capacity(ids.len() + 1);
    starts.push(0);
    starts.extend(sizes.iter().scan(0, |end, size| {
        *end += size;
        Some(*end)
    }));
    let entries = starts[ids.len()];
    let mut sum = Part {
        columns: vec![0; entries],
        values: (0..forms).map(|_| vec![0.0; entries]).collect(),
        load: vec![0.0; ids.len()],
        ids,
        starts,
    };
    let blocks = blocks(&mut sum);
    blocks.into_par_iter().for_each(|mut block| block.fill(parts, &places));
    sum
}

/// Consecutive rows of a sum.
struct Block<'a> {
    first: usize,
    starts: &'a [usize],
    columns: &'a mut [u32],
    values: Vec<&'a mut [f64]>,
    load: &'a mut [f64],
}

fn blocks(sum: &mut Part) -> Vec<Block<'_>> {
    let mut columns = &mut sum.columns[..];
    let mut values: Vec<&mut [f64]> = sum.values.iter_mut().map(|values| &mut values[..]).collect();
    let mut blocks = Vec::with_capacity(sum.load.len().div_ceil(ROWS));
    for (number, load) in sum.load.chunks_mut(ROWS).enumerate() {
        let first = ROWS * number;
        let starts = &sum.starts[first..=first + load.len()];
        let size = starts[load.len()] - starts[0];
        let own = columns.split_off_mut(..size).expect("rows of the sum");
        let of_forms = values
            .iter_mut()
            .map(|values| values.split_off_mut(..size).expect("rows of the sum"));
        blocks.push(Block {
            first,
            starts,
            columns: own,
            values: of_forms.collect(),
            load,
        });
    }
    blocks
}

impl Block<'_> {
    fn fill(&mut self, parts: &[Part], places: &Places) {
        let mut together = Vec::new();
        for row in 0..self.load.len() {
            let rows = places.of(parts, self.first + row);
            let range = self.starts[row] - self.starts[0]..self.starts[row + 1] - self.starts[0];
            let columns = &mut self.columns[range.clone()];
            let alone = rows.clone().take(2).count() == 1;
            if !alone {
                union(rows.clone(), &mut together);
                columns.copy_from_slice(&together);
            }
            for (part, own) in rows {
                self.load[row] += part.load[own];
                let own = part.row(own);
                if alone {
                    columns.copy_from_slice(&part.columns[own.clone()]);
                }
                for (values, of_part) in self.values.iter_mut().zip(&part.values) {
                    let (values, of_part) = (&mut values[range.clone()], &of_part[own.clone()]);
                    if alone {
                        values.copy_from_slice(of_part);
                        continue;
                    }
                    let mut all = columns.iter().zip(values);
                    for (column, entry) in part.columns[own.clone()].iter().zip(of_part) {
                        let (_, value) = all.find(|(other, _)| *other == column).expect("the union has it");
                        *value += entry;
                    }
                }
            }
        }
    }
}

/// The unknowns of some parts, ascending.
fn unknowns(parts: &[Part], count: usize) -> Vec<u32> {
    let mut is_used = vec![false; count];
    let ids = parts.iter().flat_map(|part| &part.ids);
    ids.for_each(|&id| is_used[id as usize] = true);
    (0..count as u32).filter(|&id| is_used[id as usize]).collect()
}

/// The matrices of some forms and the load, over all unknowns. Faces are put into parts, and parts into
/// groups, whatever the number of threads, and each adds up its own in their order, so that sums are the same
/// for any number.
pub(crate) fn assemble(
    space: &Space,
    tables: &Tables,
    forms: &[Form],
    load: Option<&Load<'_>>,
) -> Result<(Vec<Sparse>, Vec<f64>), Error> {
    assemble_by(PARTS, space, tables, Integrands { forms, load })
}

/// The same in groups of so many parts.
pub(crate) fn assemble_by(
    group: usize,
    space: &Space,
    tables: &Tables,
    integrands: Integrands<'_>,
) -> Result<(Vec<Sparse>, Vec<f64>), Error> {
    let (count, forms) = (space.positions.len(), integrands.forms);
    let mut groups: Vec<Part> = Vec::new();
    for ranges in ranges(space, tables).chunks(group) {
        let parts: Vec<Result<Part, Error>> = ranges
            .par_iter()
            .map_init(
                || Workplace::new(space, forms),
                |workplace, range| workplace.part(integrands, space, tables, range.clone()),
            )
            .collect();
        // the first of all errors, whichever thread came first
        let parts: Vec<Part> = parts.into_iter().collect::<Result<_, _>>()?;
        let ids = unknowns(&parts, count);
        groups.push(added(&parts, ids, count, forms.len()));
    }
    let sum = match &groups[..] {
        [one] if one.ids.len() == count => groups.remove(0),
        _ => added(&groups, (0..count as u32).collect(), count, forms.len()),
    };
    drop(groups);
    let Part {
        starts,
        columns,
        values,
        load,
        ..
    } = sum;
    let matrices = std::iter::repeat_n((starts, columns), values.len()).zip(values);
    let matrix = |((starts, columns), values)| Sparse {
        width: count,
        starts,
        columns,
        values,
    };
    Ok((matrices.map(matrix).collect(), load))
}

/// Adds the matrix of some unknowns, which ascend and share a face.
pub(crate) fn add(sum: &mut Sparse, ids: &[u32], entry: impl Fn(usize, usize) -> f64) {
    for (i, &row) in ids.iter().enumerate() {
        let mut at = sum.starts[row as usize];
        for (j, &column) in ids.iter().enumerate() {
            while sum.columns[at] != column {
                at += 1;
            }
            sum.values[at] += entry(i, j);
        }
    }
}
