//! Matrices and loads by quadrature over the faces.

use crate::Error;
use crate::geometry::{Geometry, Irregular};
use crate::space::{Kind, Space};
use crate::sparse::Sparse;
use crate::tables::{Jet, Table};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// A bilinear form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// `(grad u, grad v)`.
    Stiffness,
    /// `(u, v)`.
    Mass,
    /// `(laplace u, laplace v)`.
    Plate,
}

/// What stands on the right, as a function of the point.
pub(crate) type Load<'a> = dyn Fn(&Geometry) -> f64 + Sync + 'a;

pub(crate) type Tables = BTreeMap<Kind, Table>;

/// Faces that are integrated before their matrices are added up, and entries of these matrices: bounds on
/// memory.
const BLOCK: usize = 4096;
const ENTRIES: usize = 1 << 22;

/// The unknowns of a face in ascending order, and how its control points depend on them; `None` if each is
/// an unknown itself, the place in the face with each.
struct Footprint {
    ids: Vec<u32>,
    places: Vec<usize>,
    weights: Option<Vec<f64>>,
}

fn footprint(space: &Space, points: &[u32]) -> Footprint {
    let own = |p: &u32| matches!(space.transform[*p as usize][..], [(id, w)] if id == *p && w == 1.0);
    if points.iter().all(own) {
        let mut places: Vec<usize> = (0..points.len()).collect();
        places.sort_unstable_by_key(|&k| points[k]);
        return Footprint {
            ids: places.iter().map(|&k| points[k]).collect(),
            places,
            weights: None,
        };
    }
    let rows = || points.iter().map(|p| &space.transform[*p as usize]);
    let mut ids: Vec<u32> = rows().flatten().map(|(id, _)| *id).collect();
    ids.sort_unstable();
    ids.dedup();
    let mut weights = vec![0.0; points.len() * ids.len()];
    for (k, row) in rows().enumerate() {
        for (id, w) in row {
            let place = ids.binary_search(id).expect("the union holds it");
            weights[k * ids.len() + place] += w;
        }
    }
    Footprint {
        places: (0..ids.len()).collect(),
        ids,
        weights: Some(weights),
    }
}

/// The control points of a face that its table uses, and where they are.
pub(crate) fn points_of(space: &Space, table: &Table, face: usize) -> (Vec<u32>, Vec<[f64; 3]>) {
    let cell = &space.cells[face];
    let points: Vec<u32> = table.columns.iter().map(|&c| cell.points[c]).collect();
    let positions = points.iter().map(|&v| space.positions[v as usize]).collect();
    (points, positions)
}

/// The error of a cell whose map is not regular.
pub(crate) fn refused(space: &Space, cell: usize, irregular: &Irregular) -> Error {
    Error::Jacobian {
        face: space.cells[cell].face as usize,
        at: irregular.at,
        value: irregular.value,
    }
}

/// Matrices and load of one face over its footprint, whose places they follow.
struct Local {
    footprint: Footprint,
    matrices: Vec<Vec<f64>>,
    load: Vec<f64>,
}

/// Columns of matrices of faces that are summed together.
const LANES: usize = 4;

/// Points of a face whose products are summed together.
const POINTS: usize = 16;

/// Adds `A^T B` below the diagonal, and in squares of [`LANES`] on it. A and B have rows as long as those of
/// the sum, a multiple of [`LANES`]; a square's sums stay in registers for all of them.
fn add_products(a: &[f64], b: &[f64], width: usize, sum: &mut [f64]) {
    for i in (0..width).step_by(LANES) {
        for j in (0..=i).step_by(LANES) {
            let mut square = [[0.0; LANES]; LANES];
            for (a, b) in a.chunks_exact(width).zip(b.chunks_exact(width)) {
                let (Some(a), Some(b)) = (a[i..].first_chunk::<LANES>(), b[j..].first_chunk::<LANES>()) else {
                    unreachable!("the width is a multiple")
                };
                for row in 0..LANES {
                    for column in 0..LANES {
                        square[row][column] += a[row] * b[column];
                    }
                }
            }
            for (row, entries) in square.iter().enumerate() {
                let place = (i + row) * width + j;
                sum[place..place + LANES]
                    .iter_mut()
                    .zip(entries)
                    .for_each(|(sum, entry)| *sum += entry);
            }
        }
    }
}

/// Rows of factors whose products make up a form: those with the weight of the point, and without.
#[derive(Default)]
struct Factors {
    weighted: Vec<f64>,
    plain: Vec<f64>,
}

impl Factors {
    /// Those of a form at some points, their functions' jets given.
    fn fill<'a>(&mut self, form: Form, width: usize, points: impl Iterator<Item = (&'a Geometry, &'a [Jet])>) {
        self.weighted.clear();
        self.plain.clear();
        for (at, jets) in points {
            let components = if form == Form::Stiffness { 2 } else { 1 };
            let start = self.plain.len();
            self.plain.resize(start + components * width, 0.0);
            let rows = &mut self.plain[start..];
            match form {
                Form::Stiffness => {
                    let (first, second) = rows.split_at_mut(width);
                    for ((x, y), jet) in first.iter_mut().zip(second).zip(jets) {
                        [*x, *y] = at.gradient(jet[1], jet[2]);
                    }
                }
                Form::Mass => rows.iter_mut().zip(jets).for_each(|(value, jet)| *value = jet[0]),
                Form::Plate => {
                    for (value, jet) in rows.iter_mut().zip(jets) {
                        let hessian = at.hessian(jet, at.gradient(jet[1], jet[2]));
                        *value = hessian[0] + hessian[2];
                    }
                }
            }
            self.weighted.extend(rows.iter().map(|value| at.measure * *value));
        }
    }
}

fn local(
    space: &Space,
    tables: &Tables,
    face: usize,
    forms: &[Form],
    load: Option<&Load<'_>>,
    factors: &mut Factors,
) -> Result<Local, Error> {
    let table = &tables[&space.cells[face].kind];
    let (points, positions) = points_of(space, table, face);
    let n = points.len();
    let width = n.next_multiple_of(LANES);
    let second = load.is_some() && !space.planar || forms.contains(&Form::Plate);
    let mut matrices = vec![vec![0.0; width * width]; forms.len()];
    let mut right = vec![0.0; n];
    for first in (0..table.weights.len()).step_by(POINTS) {
        let weights = &table.weights[first..table.weights.len().min(first + POINTS)];
        let geometry = |(q, &weight): (usize, &f64)| {
            Geometry::new(table.at(first + q), &positions, weight, space.planar, second)
                .map_err(|irregular| refused(space, face, &irregular))
        };
        let all: Vec<Geometry> = weights.iter().enumerate().map(geometry).collect::<Result<_, _>>()?;
        let with_jets = || all.iter().enumerate().map(|(q, at)| (at, table.at(first + q)));
        if let Some(load) = load {
            for (at, jets) in with_jets() {
                let f = load(at) * at.measure;
                if !f.is_finite() {
                    return Err(Error::Solution { at: at.x });
                }
                right.iter_mut().zip(jets).for_each(|(sum, jet)| *sum += f * jet[0]);
            }
        }
        for (&form, matrix) in forms.iter().zip(&mut matrices) {
            factors.fill(form, width, with_jets());
            add_products(&factors.weighted, &factors.plain, width, matrix);
        }
    }
    for matrix in &mut matrices {
        // the lower half alone, so that the matrix is symmetric to the last bit
        let entry = |at: usize| {
            let (i, j) = (at / n, at % n);
            matrix[i.max(j) * width + i.min(j)]
        };
        *matrix = (0..n * n).map(entry).collect();
    }
    let footprint = footprint(space, &points);
    if let Some(weights) = &footprint.weights {
        let m = footprint.ids.len();
        let column = |k: usize| (0..n).map(move |i| weights[i * m + k]);
        right = (0..m)
            .map(|k| column(k).zip(&right).map(|(w, r)| w * r).sum())
            .collect();
        for matrix in &mut matrices {
            let half: Vec<f64> = (0..n * m)
                .map(|at| column(at % m).zip(&matrix[at / m * n..][..n]).map(|(w, a)| w * a).sum())
                .collect();
            *matrix = (0..m * m)
                .map(|at| column(at / m).enumerate().map(|(i, w)| w * half[i * m + at % m]).sum())
                .collect();
        }
    }
    Ok(Local {
        footprint,
        matrices,
        load: right,
    })
}

/// The matrix of zeros with an entry for each pair of unknowns that share a face.
fn pattern(space: &Space, tables: &Tables) -> Sparse {
    let count = space.positions.len();
    let footprints: Vec<Vec<u32>> = (0..space.cells.len())
        .into_par_iter()
        .map(|face| footprint(space, &points_of(space, &tables[&space.cells[face].kind], face).0).ids)
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
const RANGES: usize = 16;

/// Adds the parts of some faces, in their order, to a matrix whose rows are shared out.
fn gather(sum: &mut Sparse, parts: &[Local], form: usize) {
    let Sparse {
        starts,
        columns,
        values,
        ..
    } = sum;
    let size = (starts.len() - 1).div_ceil(RANGES).max(1);
    let mut rest = &mut values[..];
    let mut shares = Vec::with_capacity(RANGES);
    for first in (0..starts.len() - 1).step_by(size) {
        let last = (first + size).min(starts.len() - 1);
        let (own, others) = rest.split_at_mut(starts[last] - starts[first]);
        shares.push((first as u32..last as u32, own));
        rest = others;
    }
    shares.into_par_iter().for_each(|(rows, values)| {
        let before = starts[rows.start as usize];
        for part in parts {
            let Footprint { ids, places, .. } = &part.footprint;
            let own = ids.partition_point(|id| *id < rows.start)..ids.partition_point(|id| *id < rows.end);
            for i in own {
                let row = ids[i] as usize;
                let entries = &part.matrices[form][places[i] * ids.len()..][..ids.len()];
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
    let mut next = 0;
    while next < space.cells.len() {
        let (first, mut entries) = (next, 0);
        while next < space.cells.len() && next < first + BLOCK && entries < ENTRIES {
            entries += tables[&space.cells[next].kind].columns.len().pow(2);
            next += 1;
        }
        let parts: Vec<Local> = (first..next)
            .into_par_iter()
            .map_init(Factors::default, |factors, face| {
                local(space, tables, face, forms, load, factors)
            })
            .collect::<Result<_, _>>()?;
        for part in &parts {
            let Footprint { ids, places, .. } = &part.footprint;
            ids.iter()
                .zip(places)
                .for_each(|(&id, &k)| right[id as usize] += part.load[k]);
        }
        for (form, sum) in sums.iter_mut().enumerate() {
            gather(sum, &parts, form);
        }
    }
    Ok((sums, right))
}

/// The integrals of a function times that of each control point.
pub(crate) fn loads(space: &Space, tables: &Tables, f: &Load<'_>) -> Result<Vec<f64>, Error> {
    let one = |face: usize| -> Result<(Vec<u32>, Vec<f64>), Error> {
        let table = &tables[&space.cells[face].kind];
        let (points, positions) = points_of(space, table, face);
        let mut sums = vec![0.0; points.len()];
        for (q, &weight) in table.weights.iter().enumerate() {
            let jets = table.at(q);
            let at = Geometry::new(jets, &positions, weight, space.planar, !space.planar)
                .map_err(|irregular| refused(space, face, &irregular))?;
            let value = f(&at) * at.measure;
            sums.iter_mut().zip(jets).for_each(|(sum, jet)| *sum += value * jet[0]);
        }
        Ok((points, sums))
    };
    let parts: Vec<_> = (0..space.cells.len())
        .into_par_iter()
        .map(one)
        .collect::<Result<_, _>>()?;
    let mut sums = vec![0.0; space.positions.len()];
    for (points, part) in parts {
        points
            .iter()
            .zip(part)
            .for_each(|(&p, value)| sums[p as usize] += value);
    }
    Ok(sums)
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
