//! Odd orders beside a boundary or crease: the matrix of a half cell, as one without a rotation.

use super::{AFFINE, Given};
use crate::error::Error;
use crate::schemes::SchemeName;
use crate::spectrum::check_rings;
use crate::table::{Table, short};
use eigenring_scheme::user::Reading;
use eigenring_scheme::{Corner, Site};
use eigenring_spectral::{Block, Matrix, Spectrum};
use eigenring_surface::Rules;
use eigenring_surface::limit::HalfCell;

/// Matrices beyond this size take minutes: 80 faces at order 11.
const MOST: usize = 2000;

/// What the matrix belongs to.
#[derive(Clone, Debug)]
pub(super) struct Around {
    pub corner: String,
    pub faces: usize,
    pub rings: usize,
    pub closed_rings: usize,
    /// The largest modulus of the eigenvalues of the rings outside.
    pub outer: f64,
    /// The level, and how many lead to the limit level.
    pub level: [usize; 2],
    sites: Vec<Site>,
}

impl Given {
    /// The level of a scheme of odd order around a half cell of so many faces, with the corner in front or
    /// without, on so many rings: by default the limit level, the smallest closed set, and one ring more
    /// where the eigenvalues outside of it are not strictly below the subsubdominant one.
    ///
    /// # Errors
    /// [`Error::Range`] for rings that are not closed and for matrices that are too large; those of the
    /// scheme.
    pub fn of_half_cell(
        scheme: &SchemeName,
        faces: usize,
        corner: bool,
        [rings, level]: [Option<usize>; 2],
    ) -> Result<Self, Error> {
        let mut place = Corner::fan(faces)?;
        if corner {
            place = place.fixed();
        }
        let rules = Rules::new(scheme.definition(Reading::default())?);
        // the smallest set of a single face costs little and says how many rings it has
        let closed = HalfCell::new(&rules, 1, corner, 0, level)?.closed_rings;
        let rings = rings.map(|rings| check_rings(rings, closed)).transpose()?;
        let size = |rings: usize| faces * (rings + 1) * (rings + 1) + 2 * (rings + 1) + usize::from(corner);
        if size(rings.unwrap_or(closed + 1)) > MOST {
            return Err(Error::Range {
                what: "number of points",
                given: size(rings.unwrap_or(closed + 1)).to_string(),
                accepted: format!("at most {MOST}: fewer faces or rings, or a lower order"),
            });
        }
        let name = rules.definition().name();
        let build = |rings: usize| HalfCell::new(&rules, faces, corner, rings - closed, level);
        let wider = build(closed + 1)?;
        let outer = outer(&wider, closed)?;
        let mut given = match rings {
            Some(rings) => of(name.clone(), build(rings)?, rings)?,
            None => {
                let least = of(name.clone(), build(closed)?, closed)?;
                let third = least.spectrum.subsubdominant().map_or(0.0, |e| e.modulus());
                if outer < third * (1.0 - 1e-9) {
                    least
                } else {
                    of(name.clone(), wider, closed + 1)?
                }
            }
        };
        if let Some(around) = &mut given.around {
            around.corner = place.to_string();
            around.faces = faces;
            around.outer = outer;
        }
        Ok(given)
    }
}

/// The largest modulus of the eigenvalues of the ring after the smallest closed ones.
fn outer(wider: &HalfCell, closed: usize) -> Result<f64, Error> {
    let last: Vec<usize> = (0..wider.sites.len())
        .filter(|&index| wider.sites[index].ring() > closed)
        .collect();
    let entry = |row: usize, column: usize| weight(wider, last[row], last[column]);
    let block = Block::Real(Matrix::from_fn(last.len(), last.len(), entry));
    let found = block.eigenvalues()?;
    Ok(found.iter().fold(0.0, |most, e| most.max(e.value.modulus())))
}

fn weight(half_cell: &HalfCell, row: usize, column: usize) -> f64 {
    let terms = &half_cell.rows[row];
    let found = terms.iter().find(|term| term.0 as usize == column);
    found.map_or(0.0, |term| term.1)
}

fn of(name: String, half_cell: HalfCell, rings: usize) -> Result<Given, Error> {
    let size = half_cell.sites.len();
    let matrix = Matrix::from_fn(size, size, |row, column| weight(&half_cell, row, column));
    let sums = (0..size).map(|row| matrix.row(row).iter().sum::<f64>());
    let defect = sums.fold(0.0_f64, |worst, sum| worst.max((sum - 1.0).abs()));
    let blocks = vec![Block::Real(matrix.clone())];
    debug_assert!(defect < AFFINE, "rules of half cells are affine");
    Ok(Given {
        name,
        spectrum: Spectrum::of_blocks(&blocks, None, 0.0)?,
        matrix,
        rotation: None,
        blocks,
        defect,
        around: Some(Around {
            corner: String::new(),
            faces: 0,
            rings,
            closed_rings: half_cell.closed_rings,
            outer: 0.0,
            level: half_cell.level,
            sites: half_cell.sites,
        }),
    })
}

impl Around {
    /// What the list of eigenvalues does not say by itself.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if self.rings > self.closed_rings {
            notes.push(format!(
                "rings 0 to {}, the smallest closed set has 0 to {}: eigenvalues up to {} appear with the rings beyond",
                self.rings,
                self.closed_rings,
                short(self.outer)
            ));
        }
        let [level, leading] = self.level;
        if leading > 0 {
            notes.push(match leading - level {
                0 => format!(
                    "the limit level, which governs continuity; {leading} levels, 0 to {}, lead to it",
                    leading - 1
                ),
                _ => format!("a leading level; the limit level, which governs continuity, is {leading}"),
            });
        }
        notes
    }

    /// The points by their places in half steps: on rims y = 0, the corner at (0, 0).
    pub fn points(&self) -> Table {
        let mut table = Table::new(["point", "sector", "x", "y"]);
        for (index, site) in self.sites.iter().enumerate() {
            let (x, y) = (site.x as usize, site.y as usize);
            table.push(vec![index.into(), site.sector.into(), x.into(), y.into()]);
        }
        table
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moduli(scheme: &str, faces: usize, corner: bool, rings: usize) -> Vec<f64> {
        let scheme: SchemeName = scheme.parse().unwrap();
        let given = Given::of_half_cell(&scheme, faces, corner, [Some(rings), None]).unwrap();
        let all = given.spectrum.eigenvalues.iter();
        all.flat_map(|e| {
            assert!(e.value.im == 0.0 && e.value.re > -1e-12, "{}", e.value.re);
            std::iter::repeat_n(e.value.re, e.multiplicity)
        })
        .collect()
    }

    fn begin(found: &[f64], expected: &[f64]) {
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < 1e-12, "{found:?} begins with {expected:?}");
        }
        assert!(found.len() >= expected.len());
    }

    /// Two faces on a rim, and one at a corner, are a spline of degree k-1 continued by odd reflection: its
    /// functions are `s^i t^j`, of the eigenvalue `2^-(i+j)`, where a direction across a rim has the powers 0
    /// and those that are odd.
    #[test]
    fn regular_half_cells_have_the_powers_of_reflected_splines() {
        for order in [3, 5, 7, 9] {
            let rings = (order - 3) / 2 + 1;
            let across = |j: i32| j == 0 || j % 2 == 1;
            for corner in [false, true] {
                let mut powers: Vec<f64> = Vec::new();
                for (i, j) in (0..order as i32).flat_map(|i| (0..order as i32).map(move |j| (i, j))) {
                    if across(j) && (across(i) || !corner) {
                        powers.push(0.5_f64.powi(i + j));
                    }
                }
                powers.sort_by(|a, b| b.total_cmp(a));
                // before other eigenvalues may come between
                powers.retain(|&power| power > 2.0_f64.powi(-(order as i32 - 1)) * 0.99);
                let faces = if corner { 1 } else { 2 };
                let found = moduli(&format!("stam:order={order}"), faces, corner, rings);
                begin(&found, &powers);
            }
        }
    }

    /// Half a face of 2n corners at order 3: the rim's 1 and 1/2, one sine mode of 1/2, n-1 of 1/4; with
    /// Doo and Sabin's own weights too.
    #[test]
    fn half_cells_of_order_three_have_one_more_half() {
        for scheme in ["stam:order=3", "doo-sabin"] {
            for faces in 1..9 {
                let mut expected = vec![1.0, 0.5, 0.5];
                expected.resize(faces + 2, 0.25);
                let found = moduli(scheme, faces, false, 0);
                assert_eq!(found.len(), expected.len());
                begin(&found, &expected);
            }
        }
    }

    /// The ring outside counts where its eigenvalues are not below the third.
    #[test]
    fn rings_are_added_where_outer_eigenvalues_interfere() {
        let scheme: SchemeName = "stam:order=3".parse().unwrap();
        let given = Given::of_half_cell(&scheme, 3, false, [None, None]).unwrap();
        let around = given.around.as_ref().unwrap();
        // the curve along the rim has 1/4 in the ring outside
        assert_eq!((around.rings, around.closed_rings), (1, 0));
        assert!((around.outer - 0.25).abs() < 1e-12);
        let refused = Given::of_half_cell(&"stam:order=4".parse().unwrap(), 3, false, [None, None]);
        assert!(refused.is_err());
    }
}
