//! Matrices and loads over all unknowns, summed over the faces.

use crate::Error;
use crate::integrals::{Form, Integrands, Load, Tables};
use crate::part::{Part, Workplace, ranges};
use crate::space::Space;
use crate::sparse::Sparse;
use rayon::prelude::*;

/// Bounds on memory.
#[derive(Clone, Copy)]
pub(crate) struct Bounds {
    /// Parts that are made before it is asked whether they have to be added up.
    pub parts: usize,
    /// Entries with which they have.
    pub entries: usize,
}

/// 10^6 regular faces are added up at once, with 0.8 GB; those of many extraordinary vertices of high valence
/// are not, as each has the rows of all others of its vertex.
const BOUNDS: Bounds = Bounds {
    parts: 1024,
    entries: 1 << 26,
};
/// Rows that are added up together.
const ROWS: usize = 4096;

/// Where the rows of an unknown are.
struct Places {
    starts: Vec<u32>,
    /// The part, and the row in it.
    rows: Vec<[u32; 2]>,
}

impl Places {
    fn new(parts: &[Part], count: usize) -> Self {
        let mut starts = vec![0; count + 1];
        let ids = parts.iter().flat_map(|part| &part.ids);
        ids.for_each(|&id| starts[id as usize + 1] += 1);
        (0..count).for_each(|id| starts[id + 1] += starts[id]);
        let mut next = starts.clone();
        let mut rows = vec![[0; 2]; starts[count] as usize];
        for (number, part) in (0..).zip(parts) {
            for (row, &id) in (0..).zip(&part.ids) {
                rows[next[id as usize] as usize] = [number, row];
                next[id as usize] += 1;
            }
        }
        Places { starts, rows }
    }

    /// The rows of an unknown, in the order of the parts.
    fn of<'a>(&'a self, parts: &'a [Part], id: usize) -> impl Iterator<Item = (&'a Part, usize)> + Clone {
        let rows = &self.rows[self.starts[id] as usize..self.starts[id + 1] as usize];
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

/// The sum of some parts, over all unknowns. Sums run in the order of the parts.
fn added(parts: &[Part], count: usize, forms: usize) -> Part {
    let places = Places::new(parts, count);
    let size = |columns: &mut Vec<u32>, id: usize| {
        let rows = places.of(parts, id);
        match rows.clone().take(2).count() {
            0 | 1 => rows.map(|(part, row)| part.row(row).len()).sum(),
            _ => {
                union(rows, columns);
                columns.len()
            }
        }
    };
    let sizes: Vec<usize> = (0..count)
        .into_par_iter()
        .with_min_len(ROWS)
        .map_init(Vec::new, size)
        .collect();
    let mut starts = Vec::with_capacity(count + 1);
    starts.push(0);
    starts.extend(sizes.iter().scan(0, |end, size| {
        *end += size;
        Some(*end)
    }));
    let mut sum = Part {
        ids: (0..count as u32).collect(),
        columns: vec![0; starts[count]],
        values: vec![vec![0.0; starts[count]]; forms],
        load: vec![0.0; count],
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
            let id = self.first + row;
            let rows = places.of(parts, id);
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

/// The matrices of some forms and the load, over all unknowns. Faces are put into parts whatever the number
/// of threads, and parts are added up in their order, so that sums are the same for any number.
pub(crate) fn assemble(
    space: &Space,
    tables: &Tables,
    forms: &[Form],
    load: Option<&Load<'_>>,
) -> Result<(Vec<Sparse>, Vec<f64>), Error> {
    assemble_within(BOUNDS, space, tables, Integrands { forms, load })
}

/// The same with other bounds, which make no difference to the sums.
pub(crate) fn assemble_within(
    bounds: Bounds,
    space: &Space,
    tables: &Tables,
    integrands: Integrands<'_>,
) -> Result<(Vec<Sparse>, Vec<f64>), Error> {
    let (count, forms) = (space.positions.len(), integrands.forms);
    let mut parts: Vec<Part> = Vec::new();
    let mut most = bounds.entries;
    for ranges in ranges(space, tables).chunks(bounds.parts) {
        let done: Vec<Result<Part, Error>> = ranges
            .par_iter()
            .map_init(
                || Workplace::new(space, forms),
                |workplace, range| workplace.part(integrands, space, tables, range.clone()),
            )
            .collect();
        // the first of all errors, whichever thread came first
        for part in done {
            parts.push(part?);
        }
        if parts.iter().map(|part| part.columns.len()).sum::<usize>() > most {
            parts = vec![added(&parts, count, forms.len())];
            // the sum is copied no oftener than new entries are added
            most = bounds.entries.max(2 * parts[0].columns.len());
        }
    }
    let Part {
        starts,
        columns,
        values,
        load,
        ..
    } = added(&parts, count, forms.len());
    drop(parts);
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
