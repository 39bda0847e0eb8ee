//! Matrices and loads over all unknowns, summed over the faces.

use crate::Error;
use crate::integrals::{Footprint, Form, Integrands, Load, Local, Room, Tables, footprint, ids_of};
use crate::space::Space;
use crate::sparse::Sparse;
use rayon::prelude::*;

/// Faces that are integrated before their matrices are added up, and entries of these matrices: bounds on
/// memory.
const BLOCK: usize = 4096;
const ENTRIES: usize = 1 << 22;

/// The matrix of zeros with an entry for each pair of unknowns that share a face.
fn pattern(space: &Space, tables: &Tables) -> Sparse {
    let count = space.positions.len();
    let footprints: Vec<Vec<u32>> = (0..space.cells.len())
        .into_par_iter()
        .map(|face| {
            footprint(
                space,
                &ids_of(space, &tables[&space.cells[face].kind], face).collect::<Vec<u32>>(),
            )
            .ids
        })
        .collect();
    let mut starts = vec![0_usize; count + 1];
    footprints.iter().flatten().for_each(|&id| starts[id as usize + 1] += 1);
    (0..count).for_each(|id| starts[id + 1] += starts[id]);
    let mut next = starts.clone();
    let mut faces = vec![0_u32; starts[count]];
    for (face, ids) in footprints.iter().enumerate() {
        for &id in ids {
            faces[next[id as usize]] = face as u32;
            next[id as usize] += 1;
        }
    }
    let numbers: Vec<u32> = (0..count as u32).collect();
    // the sizes of some rows and their columns
    let rows = |stamps: &mut Vec<u32>, ids: &[u32]| {
        let (mut sizes, mut columns) = (Vec::with_capacity(ids.len()), Vec::with_capacity(49 * ids.len()));
        for &id in ids {
            let first = columns.len();
            for &face in &faces[starts[id as usize]..starts[id as usize + 1]] {
                for &other in &footprints[face as usize] {
                    if stamps[other as usize] != id {
                        stamps[other as usize] = id;
                        columns.push(other);
                    }
                }
            }
            columns[first..].sort_unstable();
            sizes.push(columns.len() - first);
        }
        (sizes, columns)
    };
    let parts: Vec<(Vec<usize>, Vec<u32>)> = numbers
        .par_chunks(BLOCK)
        .map_init(|| vec![u32::MAX; count], rows)
        .collect();
    let mut sizes = vec![0];
    let mut columns = Vec::with_capacity(parts.iter().map(|(_, columns)| columns.len()).sum());
    for (own, part) in parts {
        let mut end = columns.len();
        sizes.extend(own.into_iter().map(|size| {
            end += size;
            end
        }));
        columns.extend(part);
    }
    Sparse {
        width: count,
        starts: sizes,
        values: vec![0.0; columns.len()],
        columns,
    }
}

/// Ranges of rows into which parts are added at the same time.
const RANGES: usize = 8;

/// Bounds of ranges that some faces have about equally many unknowns in. Faces come in blocks, whose unknowns
/// are few of all; where the bounds are makes no difference to the sums.
fn bounds(parts: &[Local], count: usize) -> Vec<usize> {
    let ids = parts.iter().map(|part| &part.footprint.ids);
    let mut some: Vec<u32> = ids.flat_map(|ids| ids.iter().step_by(4).copied()).collect();
    some.sort_unstable();
    let inner = (1..RANGES).filter_map(|k| some.get(k * some.len() / RANGES));
    let mut bounds: Vec<usize> = inner.map(|id| *id as usize).collect();
    bounds.dedup();
    bounds.insert(0, 0);
    bounds.push(count);
    bounds
}

/// Adds the parts of some faces, in their order, to a matrix whose rows are shared out.
fn gather(sum: &mut Sparse, parts: &[Local], form: usize) {
    let Sparse {
        starts,
        columns,
        values,
        ..
    } = sum;
    let mut rest = &mut values[..];
    let mut shares = Vec::with_capacity(RANGES);
    for pair in bounds(parts, starts.len() - 1).windows(2) {
        let (own, others) = rest.split_at_mut(starts[pair[1]] - starts[pair[0]]);
        shares.push((pair[0] as u32..pair[1] as u32, own));
        rest = others;
    }
    shares.into_par_iter().for_each(|(rows, values)| {
        let before = starts[rows.start as usize];
        for part in parts {
            let Footprint { ids, places, .. } = &part.footprint;
            let own = ids.partition_point(|id| *id < rows.start)..ids.partition_point(|id| *id < rows.end);
            for i in own {
                let row = ids[i] as usize;
                let entries = &part.sums.matrices[form][places[i] * ids.len()..][..ids.len()];
                let columns = &columns[starts[row]..starts[row + 1]];
                let values = &mut values[starts[row] - before..][..columns.len()];
                let mut all = columns.iter().zip(values);
                for (id, &place) in ids.iter().zip(places) {
                    let (_, value) = all.find(|(column, _)| *column == id).expect("the pattern has it");
                    *value += entries[place];
                }
            }
        }
    });
}

/// The matrices of some forms and the load, over all unknowns. Sums run in the order of the faces, so that
/// they are the same for any number of threads.
pub(crate) fn assemble(
    space: &Space,
    tables: &Tables,
    forms: &[Form],
    load: Option<&Load<'_>>,
) -> Result<(Vec<Sparse>, Vec<f64>), Error> {
    let mut sums = vec![pattern(space, tables); forms.len()];
    let mut right = vec![0.0; space.positions.len()];
    let integrands = Integrands { forms, load };
    // their memory serves one block after the other
    let mut parts: Vec<Local> = Vec::new();
    let mut next = 0;
    while next < space.cells.len() {
        let (first, mut entries) = (next, 0);
        while next < space.cells.len() && next < first + BLOCK && entries < ENTRIES {
            entries += tables[&space.cells[next].kind].columns.len().pow(2);
            next += 1;
        }
        let count = next - first;
        parts.resize_with(parts.len().max(count), Local::default);
        let parts = &mut parts[..count];
        let done: Vec<Result<(), Error>> = (parts.par_iter_mut(), first..next)
            .into_par_iter()
            .map_init(Room::default, |room, (part, face)| {
                integrands.local(space, tables, face, room, part)
            })
            .collect();
        // the first of all errors, whichever thread came first
        done.into_iter().collect::<Result<(), _>>()?;
        for part in parts.iter() {
            let Footprint { ids, places, .. } = &part.footprint;
            ids.iter()
                .zip(places)
                .for_each(|(&id, &k)| right[id as usize] += part.sums.load[k]);
        }
        for (form, sum) in sums.iter_mut().enumerate() {
            gather(sum, parts, form);
        }
    }
    Ok((sums, right))
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
