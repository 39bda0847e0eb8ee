//! Matrices and loads of consecutive faces, over the unknowns of these faces alone.

use crate::Error;
use crate::integrals::{Form, Integrands, Local, Room, Tables};
use crate::space::Space;
use std::ops::Range;

/// Faces of a part, and entries of their matrices: so many that most unknowns of regular faces have all faces
/// in one part, and so few that there is work for all threads. Both are empirical: with a quarter of them
/// 10^6 faces take a fifth longer.
const FACES: usize = 1024;
const ENTRIES: usize = 1 << 18;

/// Rows of the matrices of some forms, which have the same pattern, and of the load.
pub(crate) struct Part {
    /// The unknowns whose rows these are, ascending.
    pub ids: Vec<u32>,
    pub starts: Vec<usize>,
    /// Unknowns, ascending in each row.
    pub columns: Vec<u32>,
    /// By form.
    pub values: Vec<Vec<f64>>,
    pub load: Vec<f64>,
}

/// The faces of all parts.
pub(crate) fn ranges(space: &Space, tables: &Tables) -> Vec<Range<usize>> {
    let mut ranges = Vec::new();
    let (mut first, mut entries) = (0, 0);
    for (face, cell) in space.cells.iter().enumerate() {
        let own = tables[&cell.kind].columns.len().pow(2);
        if face - first == FACES || face > first && entries + own > ENTRIES {
            ranges.push(first..face);
            (first, entries) = (face, 0);
        }
        entries += own;
    }
    if first < space.cells.len() {
        ranges.push(first..space.cells.len());
    }
    ranges
}

/// Memory that serves one part after the other.
pub(crate) struct Workplace {
    room: Room,
    locals: Vec<Local>,
    /// Of all unknowns, the place among those of the part.
    numbers: Vec<u32>,
    /// A row of each matrix over the unknowns of the part; zero between rows.
    rows: Vec<Vec<f64>>,
    columns: Vec<u32>,
    values: Vec<Vec<f64>>,
}

impl Workplace {
    pub fn new(space: &Space, forms: &[Form]) -> Self {
        Workplace {
            room: Room::default(),
            locals: Vec::new(),
            numbers: vec![u32::MAX; space.positions.len()],
            rows: vec![Vec::new(); forms.len()],
            columns: Vec::new(),
            values: vec![Vec::new(); forms.len()],
        }
    }

    /// The unknowns of some faces, ascending; those of each face become their places among them.
    fn unknowns(numbers: &mut [u32], locals: &mut [Local]) -> Vec<u32> {
        let mut ids = Vec::new();
        for &id in locals.iter().flat_map(|local| &local.ids) {
            if numbers[id as usize] == u32::MAX {
                numbers[id as usize] = 0;
                ids.push(id);
            }
        }
        ids.sort_unstable();
        (0..).zip(&ids).for_each(|(k, &id)| numbers[id as usize] = k);
        let of_faces = locals.iter_mut().flat_map(|local| &mut local.ids);
        of_faces.for_each(|id| *id = numbers[*id as usize]);
        ids.iter().for_each(|&id| numbers[id as usize] = u32::MAX);
        ids
    }

    /// The integrals over some faces. Sums run in the order of the faces.
    pub fn part(
        &mut self,
        integrands: Integrands<'_>,
        space: &Space,
        tables: &Tables,
        faces: Range<usize>,
    ) -> Result<Part, Error> {
        let count = faces.len();
        self.locals.resize_with(self.locals.len().max(count), Local::default);
        let locals = &mut self.locals[..count];
        for (local, face) in locals.iter_mut().zip(faces) {
            integrands.local(space, tables, face, &mut self.room, local)?;
        }
        let ids = Self::unknowns(&mut self.numbers, locals);
        let mut load = vec![0.0; ids.len()];
        for local in locals.iter() {
            let terms = local.ids.iter().zip(&local.sums.load);
            terms.for_each(|(&k, value)| load[k as usize] += value);
        }
        let incident = Incident::new(locals, ids.len());
        self.columns.clear();
        self.values.iter_mut().for_each(Vec::clear);
        self.rows
            .iter_mut()
            .for_each(|row| row.resize(row.len().max(ids.len()), 0.0));
        let mut starts = Vec::with_capacity(ids.len() + 1);
        starts.push(0);
        for number in 0..ids.len() {
            let of_row = incident.row(number);
            for (form, row) in self.rows.iter_mut().enumerate() {
                for &[face, place] in of_row {
                    let local = &locals[face as usize];
                    let width = local.ids.len();
                    let entries = &local.sums.matrices[form][place as usize * width..][..width];
                    for (&k, entry) in local.ids.iter().zip(entries) {
                        row[k as usize] += entry;
                    }
                }
            }
            incident.columns(of_row, |k| {
                self.columns.push(ids[k]);
                for (row, values) in self.rows.iter_mut().zip(&mut self.values) {
                    values.push(std::mem::take(&mut row[k]));
                }
            });
            starts.push(self.columns.len());
        }
        Ok(Part {
            ids,
            starts,
            columns: self.columns.clone(),
            values: self.values.clone(),
            load,
        })
    }
}

/// Which faces an unknown has, and which unknowns a face.
struct Incident {
    starts: Vec<u32>,
    /// By unknown: the face, and the place of the unknown in it.
    faces: Vec<[u32; 2]>,
    /// By face, a bit for each unknown.
    sets: Vec<u64>,
    words: usize,
}

impl Incident {
    fn new(locals: &[Local], count: usize) -> Self {
        let mut starts = vec![0; count + 1];
        let of_faces = || locals.iter().flat_map(|local| &local.ids);
        of_faces().for_each(|&k| starts[k as usize + 1] += 1);
        (0..count).for_each(|k| starts[k + 1] += starts[k]);
        let mut next = starts.clone();
        let mut faces = vec![[0; 2]; starts[count] as usize];
        let words = count.div_ceil(64);
        let mut sets = vec![0; words * locals.len()];
        for (face, (local, set)) in locals.iter().zip(sets.chunks_mut(words)).enumerate() {
            for (place, &k) in local.ids.iter().enumerate() {
                faces[next[k as usize] as usize] = [face as u32, place as u32];
                next[k as usize] += 1;
                set[k as usize / 64] |= 1 << (k % 64);
            }
        }
        Incident {
            starts,
            faces,
            sets,
            words,
        }
    }

    /// The faces of an unknown, ascending.
    fn row(&self, number: usize) -> &[[u32; 2]] {
        &self.faces[self.starts[number] as usize..self.starts[number + 1] as usize]
    }

    /// Visits the unknowns of some faces in ascending order.
    fn columns(&self, of_row: &[[u32; 2]], mut visit: impl FnMut(usize)) {
        for word in 0..self.words {
            let sets = of_row
                .iter()
                .map(|[face, _]| self.sets[*face as usize * self.words + word]);
            let mut set = sets.fold(0, |all, set| all | set);
            while set != 0 {
                visit(64 * word + set.trailing_zeros() as usize);
                set &= set - 1;
            }
        }
    }
}
