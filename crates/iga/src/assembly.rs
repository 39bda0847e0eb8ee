//! Matrices and loads by quadrature over the faces.

use crate::Error;
use crate::geometry::Geometry;
use crate::space::{Kind, Space};
use crate::sparse::Sparse;
use crate::tables::Table;
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

/// Faces that are integrated before their matrices are added up: a bound on memory.
const BLOCK: usize = 4096;

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
fn refused(space: &Space, cell: usize, value: f64) -> Error {
    let face = space.cells[cell].face as usize;
    Error::Jacobian { face, value }
}

/// Matrices and load of one face over its footprint, whose places they follow.
struct Local {
    footprint: Footprint,
    matrices: Vec<Vec<f64>>,
    load: Vec<f64>,
}

fn local(space: &Space, tables: &Tables, face: usize, forms: &[Form], load: Option<&Load<'_>>) -> Result<Local, Error> {
    let table = &tables[&space.cells[face].kind];
    let (points, positions) = points_of(space, table, face);
    let n = points.len();
    let second = load.is_some() && !space.planar || forms.contains(&Form::Plate);
    let mut matrices = vec![vec![0.0; n * n]; forms.len()];
    let mut right = vec![0.0; n];
    let mut factors = vec![[0.0; 2]; n];
    for (q, &weight) in table.weights.iter().enumerate() {
        let jets = table.at(q);
        let at = Geometry::new(jets, &positions, weight, space.planar, second)
            .map_err(|value| refused(space, face, value))?;
        if let Some(load) = load {
            let f = load(&at) * at.measure;
            right.iter_mut().zip(jets).for_each(|(sum, jet)| *sum += f * jet[0]);
        }
        for (form, matrix) in forms.iter().zip(&mut matrices) {
            for (factor, jet) in factors.iter_mut().zip(jets) {
                *factor = match form {
                    Form::Stiffness => at.gradient(jet[1], jet[2]),
                    Form::Mass => [jet[0], 0.0],
                    Form::Plate => {
                        let hessian = at.hessian(jet, at.gradient(jet[1], jet[2]));
                        [hessian[0] + hessian[2], 0.0]
                    }
                };
            }
            for i in 0..n {
                let [a, b] = factors[i].map(|g| g * at.measure);
                for (entry, other) in matrix[i * n..=i * n + i].iter_mut().zip(&factors) {
                    *entry += a * other[0] + b * other[1];
                }
            }
        }
    }
    for matrix in &mut matrices {
        for i in 0..n {
            (0..i).for_each(|j| matrix[j * n + i] = matrix[i * n + j]);
        }
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
    let rows: Vec<Vec<u32>> = (0..count)
        .into_par_iter()
        .with_min_len(4096)
        .map_init(
            || vec![u32::MAX; count],
            |stamps, id| {
                let mut row = Vec::with_capacity(49);
                for &face in &faces[starts[id]..starts[id + 1]] {
                    for &other in &footprints[face as usize] {
                        if stamps[other as usize] != id as u32 {
                            stamps[other as usize] = id as u32;
                            row.push(other);
                        }
                    }
                }
                row.sort_unstable();
                row
            },
        )
        .collect();
    let mut sizes = vec![0];
    rows.iter()
        .for_each(|row| sizes.push(sizes.last().expect("zero") + row.len()));
    let columns = rows.concat();
    Sparse {
        width: count,
        starts: sizes,
        values: vec![0.0; columns.len()],
        columns,
    }
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
    let faces: Vec<usize> = (0..space.cells.len()).collect();
    for block in faces.chunks(BLOCK) {
        let parts: Vec<Local> = block
            .par_iter()
            .map(|&face| local(space, tables, face, forms, load))
            .collect::<Result<_, _>>()?;
        for part in parts {
            let Footprint { ids, places, .. } = &part.footprint;
            ids.iter()
                .zip(places)
                .for_each(|(&id, &k)| right[id as usize] += part.load[k]);
            for (sum, matrix) in sums.iter_mut().zip(&part.matrices) {
                add(sum, ids, |i, j| matrix[places[i] * ids.len() + places[j]]);
            }
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
                .map_err(|value| refused(space, face, value))?;
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
