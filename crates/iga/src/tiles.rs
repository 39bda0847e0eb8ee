//! Functions of a space as lattices of points: what pictures are made of.

use crate::integrals::points_of;
use crate::patch::{Maps, Wanted};
use crate::space::{Depth, Ends};
use crate::{Error, Study};

/// A patch of a face as a lattice of points.
#[derive(Clone, Debug)]
pub struct Tile {
    /// The face of the level's mesh.
    pub face: usize,
    /// x, y, z and the value, row by row, as many in each as there are rows.
    pub points: Vec<[f64; 4]>,
}

impl Study<'_> {
    /// The function with these coefficients on a level, each patch cut `cuts` times in both directions; at
    /// extraordinary vertices there are patches of so many annuli.
    ///
    /// # Errors
    /// [`Error::Range`] for no cuts; those of [`Study::level`].
    pub fn tiles(
        &self,
        level: usize,
        coefficients: &[f64],
        cuts: usize,
        annuli: usize,
        ends: Ends,
    ) -> Result<Vec<Tile>, Error> {
        if !(1..=64).contains(&cuts) {
            return Err(Error::Range {
                name: "cuts",
                value: cuts,
                accepted: "1 to 64",
            });
        }
        let space = self.space(level, ends)?;
        if coefficients.len() != space.positions.len() {
            return Err(Error::Range {
                name: "coefficients",
                value: coefficients.len(),
                accepted: "as many as the level has control points with ghosts",
            });
        }
        let at = |i: usize| i as f64 / cuts as f64;
        let lattice: Vec<([f64; 2], f64)> = (0..=cuts)
            .flat_map(|j| (0..=cuts).map(move |i| ([at(i), at(j)], 1.0)))
            .collect();
        let tables = space.tables_at(&lattice, Depth::Given(annuli), false);
        let (mut tiles, mut maps) = (Vec::new(), Maps::default());
        let wanted = Wanted {
            coefficient: true,
            space: true,
            second: false,
        };
        for (number, cell) in space.cells.iter().enumerate() {
            let table = &tables[&cell.kind];
            let (ids, mut data) = points_of(&space, table, number);
            for (data, &id) in data.iter_mut().zip(&ids) {
                data[0] = coefficients[id as usize];
            }
            table.patches(&data, |patch, control| {
                patch.jets.sums(control, wanted, &mut maps);
                tiles.push(Tile {
                    face: cell.face as usize,
                    points: maps.iter().map(|[[c, x, y, z], ..]| [x, y, z, c]).collect(),
                });
                Ok(())
            })?;
        }
        Ok(tiles)
    }

    /// The coefficients on level 0 of the function of a control point, which is 1 there and 0 at all others;
    /// under HNUSS of a vertex of the mesh whose hybrid net is level 0.
    ///
    /// # Errors
    /// [`Error::Range`] for a point that is none.
    pub fn function(&self, vertex: usize, ends: Ends) -> Result<Vec<f64>, Error> {
        let count = self.mesh().points().len();
        if vertex >= count {
            return Err(Error::Range {
                name: "vertex",
                value: vertex,
                accepted: "those of the mesh",
            });
        }
        let unit: Vec<[f64; 1]> = (0..count).map(|i| [f64::from(u8::from(i == vertex))]).collect();
        let own = self.first_level(&unit)?;
        let mut all = vec![0.0; self.space(0, ends)?.positions.len()];
        all.iter_mut().zip(own).for_each(|(value, [own])| *value = own);
        Ok(all)
    }
}
