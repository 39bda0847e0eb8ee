//! Fourier blocks and row sums of a scheme with exact weights.

use super::field::{Element, Field, add, subtract};
use super::{MAX_SIZE, Poly};
use crate::Interval;
use eigenring_scheme::{Error, Exact, Lattice, Level, Net, Numbering, Scalar, Site, refine};

/// Control points of Fourier index `k`, as in [`FourierNet`](eigenring_scheme::FourierNet) without mirror
/// symmetry, over the cyclotomic field. A value is `None` once a weight without exact value took part.
struct ExactNet<'a> {
    field: &'a Field,
    numbering: Numbering,
    index: usize,
}

impl ExactNet<'_> {
    fn centre(&self) -> usize {
        usize::from(self.index == 0 && self.numbering.lattice == Lattice::Vertex)
    }

    fn size(&self) -> usize {
        self.numbering.sector_points() + self.centre()
    }

    fn sites(&self) -> Vec<Site> {
        let centre = (self.centre() == 1).then_some(Site::CENTRE);
        centre.into_iter().chain(self.numbering.sector_sites(0)).collect()
    }
}

impl Net<Exact> for ExactNet<'_> {
    type Value = Option<Vec<Element>>;

    fn zero(&self) -> Self::Value {
        Some(vec![Vec::new(); self.size()])
    }

    fn control(&self, site: Site) -> Result<Self::Value, Error> {
        let mut row = vec![Vec::new(); self.size()];
        if site == Site::CENTRE {
            if self.centre() == 1 {
                row[0] = self.field.integer(1);
            }
        } else {
            let column = self.numbering.index_in_sector(site).ok_or(Error::BeyondNet {
                site,
                rings: self.numbering.rings,
            })?;
            row[column + self.centre()] = self.field.integer(1);
        }
        Ok(Some(row))
    }

    fn orbit(&self, site: Site) -> Site {
        Site { sector: 0, ..site }
    }

    fn accumulate(&self, sum: &mut Self::Value, weight: &Exact, at_orbit: &Self::Value, site: Site) {
        if site == Site::CENTRE && self.index != 0 {
            return;
        }
        let (Some(weight), Some(values)) = (self.field.weight(weight), at_orbit) else {
            *sum = None;
            return;
        };
        let Some(sum) = sum else { return };
        let phase = self.field.root((self.index * site.sector) as i64);
        let factor = self.field.times(&weight, &phase);
        for (sum, value) in sum.iter_mut().zip(values) {
            if !value.is_empty() {
                *sum = add(sum, &self.field.times(&factor, value));
            }
        }
    }
}

/// The exact characteristic polynomial of the block of Fourier index `index` on `rings` rings of a level that
/// is the same in all sectors. `None` if it has more than [`MAX_SIZE`] unknowns, a weight is not exact, or
/// the rings are not closed.
pub fn block_polynomial(field: &Field, level: &Level<Exact>, rings: usize, index: usize) -> Option<Poly> {
    let numbering = eigenring_spectral::numbering(level, rings);
    let net = ExactNet {
        field,
        numbering,
        index,
    };
    if net.size() > MAX_SIZE || !level.is_rotation_symmetric() {
        return None;
    }
    let rows = refine(level, &net, &net.sites()).ok()?;
    let matrix: Vec<Vec<Element>> = rows.into_iter().collect::<Option<_>>()?;
    Some(Poly::characteristic(&matrix, field))
}

/// Every point is 1: a refined point's value is the sum of the weights that make it.
struct SumNet<'a> {
    field: &'a Field,
}

impl Net<Exact> for SumNet<'_> {
    type Value = Option<Element>;

    fn zero(&self) -> Self::Value {
        Some(Vec::new())
    }

    fn control(&self, _site: Site) -> Result<Self::Value, Error> {
        Ok(Some(self.field.integer(1)))
    }

    fn orbit(&self, site: Site) -> Site {
        site
    }

    fn accumulate(&self, sum: &mut Self::Value, weight: &Exact, at_orbit: &Self::Value, _site: Site) {
        *sum = match (sum.take(), self.field.weight(weight), at_orbit) {
            (Some(sum), Some(weight), Some(value)) => Some(add(&sum, &self.field.times(&weight, value))),
            _ => None,
        };
    }
}

/// The exact sum of the weights of a refined point, less 1, for each of the given points: whether it is zero,
/// and an enclosure of it. `None` for a point that a weight without exact value takes part in; nothing at all
/// if the rules cannot be run.
pub fn row_sum_defect(field: &Field, level: &Level<Exact>, sites: &[Site]) -> Option<Vec<Option<(bool, Interval)>>> {
    let sums = refine(level, &SumNet { field }, sites).ok()?;
    let defect = |sum: Option<Element>| {
        let defect = subtract(&sum?, &field.integer(1));
        let rough = match defect.as_slice() {
            [] => Interval::point(0.0),
            [rational] => Interval::rational(rational),
            _ => field.enclose(&defect).0,
        };
        Some((defect.is_empty(), rough))
    };
    Some(sums.into_iter().map(defect).collect())
}
