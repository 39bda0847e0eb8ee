//! Integrals over a face: matrices and loads by quadrature.

use crate::Error;
use crate::cells::Kind;
use crate::geometry::{Geometry, Irregular};
use crate::patch::{Control, Data, FUNCTIONS, Jets, Maps, Square, Wanted, products};
use crate::space::Space;
use crate::tables::{Patch, Table};
use eigenring_spectral::Matrix;
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

/// The unknowns of a face, and how its control points depend on them; `None` if each is an unknown itself.
fn unknowns(space: &Space, points: &[u32], ids: &mut Vec<u32>) -> Option<Matrix<f64>> {
    ids.clear();
    if points.iter().all(|&p| space.transform.is_unit(p as usize)) {
        ids.extend(points);
        return None;
    }
    let rows = || points.iter().map(|&p| space.transform.row(p as usize));
    ids.extend(rows().flatten().map(|(id, _)| id as u32));
    ids.sort_unstable();
    ids.dedup();
    let weights = rows().map(|row| {
        let mut weights = vec![0.0; ids.len()];
        for (id, w) in row {
            weights[ids.binary_search(&(id as u32)).expect("the union holds it")] += w;
        }
        weights
    });
    Some(Matrix::from_rows(weights.collect(), ids.len()))
}

/// The control points of a face that its table uses, with where they are; coefficients are zero.
pub(crate) fn points_of(space: &Space, table: &Table, face: usize) -> (Vec<u32>, Vec<Data>) {
    let own = space.cells.points(face);
    let points: Vec<u32> = table.columns.iter().map(|&column| own[column]).collect();
    let data = |v: &u32| {
        let [x, y, z] = space.positions[*v as usize];
        [0.0, x, y, z]
    };
    let data = points.iter().map(data).collect();
    (points, data)
}

/// The error of a cell whose map is not regular.
pub(crate) fn refused(space: &Space, cell: usize, irregular: &Irregular) -> Error {
    Error::Jacobian {
        face: space.cells[cell].face as usize,
        at: irregular.at,
        value: irregular.value,
    }
}

/// Rows of factors whose products make up a form: those with the weight of the point, and without.
#[derive(Default)]
struct Factors {
    weighted: Vec<[f64; FUNCTIONS]>,
    plain: Vec<[f64; FUNCTIONS]>,
}

impl Factors {
    /// Those of a form at the points of a patch.
    fn fill(&mut self, form: Form, jets: &Jets, geometry: &[Geometry]) {
        self.weighted.clear();
        self.plain.clear();
        pulp::Arch::new().dispatch(Fill {
            factors: self,
            form,
            jets,
            geometry,
        });
    }
}

struct Fill<'a> {
    factors: &'a mut Factors,
    form: Form,
    jets: &'a Jets,
    geometry: &'a [Geometry],
}

impl pulp::WithSimd for Fill<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Factors { weighted, plain } = self.factors;
        let mut push = |measure: f64, row: [f64; FUNCTIONS]| {
            weighted.push(row.map(|value| measure * value));
            plain.push(row);
        };
        for (at, [value, s, t, ss, st, tt]) in self.geometry.iter().zip(&self.jets.at) {
            match self.form {
                Form::Stiffness => {
                    let [mut x, mut y] = [[0.0; FUNCTIONS]; 2];
                    for k in 0..FUNCTIONS {
                        [x[k], y[k]] = at.gradient(s[k], t[k]);
                    }
                    push(at.measure, x);
                    push(at.measure, y);
                }
                Form::Mass => push(at.measure, *value),
                Form::Plate => {
                    let laplacian = |k: usize| {
                        let hessian = at.hessian([ss[k], st[k], tt[k]], at.gradient(s[k], t[k]));
                        hessian[0] + hessian[2]
                    };
                    push(at.measure, std::array::from_fn(laplacian));
                }
            }
        }
    }
}

/// Matrices and load over some points: the control points of an annulus or of a face, or unknowns.
#[derive(Default)]
pub(crate) struct Sums {
    width: usize,
    pub matrices: Vec<Vec<f64>>,
    pub load: Vec<f64>,
}

impl Sums {
    fn zero(width: usize, forms: usize) -> Self {
        let mut sums = Sums::default();
        sums.clear(width, forms);
        sums
    }

    /// Zero over other points, in the memory that it has.
    fn clear(&mut self, width: usize, forms: usize) {
        self.width = width;
        self.matrices.resize_with(forms, Vec::new);
        for entries in self.matrices.iter_mut() {
            entries.clear();
            entries.resize(width * width, 0.0);
        }
        self.load.clear();
        self.load.resize(width, 0.0);
    }

    /// Adds the square of a patch on some rows, from what it has below the diagonal, so that the sum is
    /// symmetric to the last bit.
    fn add(&mut self, form: usize, rows: &[usize; FUNCTIONS], square: &Square) {
        let (matrix, width) = (&mut self.matrices[form], self.width);
        for (i, &row) in rows.iter().enumerate() {
            for (j, &column) in rows[..i].iter().enumerate() {
                matrix[row * width + column] += square[i][j];
                matrix[column * width + row] += square[i][j];
            }
            matrix[row * width + row] += square[i][i];
        }
    }

    /// Adds those over points that are combinations of the own ones, by rows: one matrix for the coefficients
    /// of each form, and one for the load's.
    fn add_combined<'a>(&mut self, of: &Sums, forms: impl Fn(usize) -> &'a Matrix<f64>, load: &Matrix<f64>) {
        for (row, value) in of.load.iter().enumerate() {
            let weights = load.row(row);
            self.load.iter_mut().zip(weights).for_each(|(sum, w)| *sum += w * value);
        }
        for (form, (sum, matrix)) in self.matrices.iter_mut().zip(&of.matrices).enumerate() {
            pulp::Arch::new().dispatch(Combined {
                matrix,
                rows: forms(form),
                sum,
            });
        }
    }
}

/// Adds `R^T M R`, the lower half of it alone, so that the sum stays symmetric to the last bit.
struct Combined<'a> {
    matrix: &'a [f64],
    rows: &'a Matrix<f64>,
    sum: &'a mut [f64],
}

impl pulp::WithSimd for Combined<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let (height, width) = (self.rows.rows(), self.rows.columns());
        let mut right = vec![0.0; width];
        for i in 0..height {
            // row i of M R
            right.fill(0.0);
            let entries = &self.matrix[i * height..][..height];
            for (j, &entry) in entries.iter().enumerate().filter(|(_, entry)| **entry != 0.0) {
                right
                    .iter_mut()
                    .zip(self.rows.row(j))
                    .for_each(|(sum, w)| *sum += entry * w);
            }
            for (k, &weight) in self
                .rows
                .row(i)
                .iter()
                .enumerate()
                .filter(|(_, weight)| **weight != 0.0)
            {
                let sum = &mut self.sum[k * width..][..=k];
                sum.iter_mut().zip(&right).for_each(|(sum, x)| *sum += weight * x);
            }
        }
        for k in 0..width {
            for l in 0..k {
                self.sum[l * width + k] = self.sum[k * width + l];
            }
        }
    }
}

/// Matrices and load of one face over its unknowns.
#[derive(Default)]
pub(crate) struct Local {
    pub ids: Vec<u32>,
    pub sums: Sums,
}

/// What the integrals over a face need room for, one after the other.
#[derive(Default)]
pub(crate) struct Room {
    maps: Maps,
    geometry: Vec<Geometry>,
    factors: Factors,
}

/// What is integrated over a face.
#[derive(Clone, Copy)]
pub(crate) struct Integrands<'a> {
    pub forms: &'a [Form],
    pub load: Option<&'a Load<'a>>,
}

impl Integrands<'_> {
    fn wanted(&self, planar: bool) -> Wanted {
        Wanted {
            coefficient: false,
            space: !planar,
            second: self.load.is_some() && !planar || self.forms.contains(&Form::Plate),
        }
    }

    /// Adds the integrals over a patch.
    fn over(
        &self,
        space: &Space,
        face: usize,
        patch: &Patch,
        control: &Control,
        room: &mut Room,
        sums: &mut Sums,
    ) -> Result<(), Error> {
        let Room {
            maps,
            geometry,
            factors,
        } = room;
        patch.jets.sums(control, self.wanted(space.planar), maps);
        geometry.clear();
        for (map, weight) in maps.iter().zip(&patch.jets.weights) {
            let at = Geometry::new(&map, weight * patch.factor, space.planar);
            geometry.push(at.map_err(|irregular| refused(space, face, &irregular))?);
        }
        if let Some(load) = self.load {
            let mut own = [0.0; FUNCTIONS];
            for (at, [values, ..]) in geometry.iter().zip(&patch.jets.at) {
                let f = load(at) * at.measure;
                if !f.is_finite() {
                    return Err(Error::Solution { at: at.x });
                }
                own.iter_mut().zip(values).for_each(|(sum, value)| *sum += f * value);
            }
            for (&row, own) in patch.rows.iter().zip(own) {
                sums.load[row] += own;
            }
        }
        for (number, &form) in self.forms.iter().enumerate() {
            factors.fill(form, &patch.jets, geometry);
            sums.add(number, &patch.rows, &products(&factors.weighted, &factors.plain));
        }
        Ok(())
    }

    /// The integrals over a face, of the functions of its control points.
    fn over_face(
        &self,
        space: &Space,
        table: &Table,
        face: usize,
        data: &[Data],
        room: &mut Room,
        sums: &mut Sums,
    ) -> Result<(), Error> {
        let forms = self.forms.len();
        sums.clear(data.len(), forms);
        for annulus in &table.annuli {
            match &annulus.lift {
                None => annulus.patches(data, |patch, control| {
                    self.over(space, face, patch, control, room, sums)
                })?,
                Some(lift) => {
                    let mut own = Sums::zero(lift.values.rows(), forms);
                    annulus.patches(data, |patch, control| {
                        self.over(space, face, patch, control, room, &mut own)
                    })?;
                    let rows = |form: usize| match self.forms[form] {
                        Form::Mass => &lift.values,
                        Form::Stiffness | Form::Plate => &lift.derivatives,
                    };
                    sums.add_combined(&own, rows, &lift.values);
                }
            }
        }
        Ok(())
    }

    /// The integrals over a face, of the functions of its unknowns, in place of those of another.
    pub fn local(
        &self,
        space: &Space,
        tables: &Tables,
        face: usize,
        room: &mut Room,
        local: &mut Local,
    ) -> Result<(), Error> {
        let table = &tables[&space.cells[face].kind];
        let (points, data) = points_of(space, table, face);
        self.over_face(space, table, face, &data, room, &mut local.sums)?;
        if let Some(weights) = unknowns(space, &points, &mut local.ids) {
            let mut own = Sums::zero(local.ids.len(), self.forms.len());
            own.add_combined(&local.sums, |_| &weights, &weights);
            local.sums = own;
        }
        Ok(())
    }
}

/// The integrals of a function times that of each control point.
pub(crate) fn loads(space: &Space, tables: &Tables, f: &Load<'_>) -> Result<Vec<f64>, Error> {
    let integrands = Integrands {
        forms: &[],
        load: Some(f),
    };
    let one = |room: &mut Room, face: usize| -> Result<(Vec<u32>, Vec<f64>), Error> {
        let table = &tables[&space.cells[face].kind];
        let (points, data) = points_of(space, table, face);
        let mut sums = Sums::default();
        integrands.over_face(space, table, face, &data, room, &mut sums)?;
        Ok((points, sums.load))
    };
    let parts: Vec<_> = (0..space.cells.len())
        .into_par_iter()
        .map_init(Room::default, one)
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
