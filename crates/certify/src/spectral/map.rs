//! Eigenvectors on all rings, and the nets they are.

use super::block::Divided;
use super::{Block, EnclosedEigenvalue, EnclosedSpectrum, Place};
use crate::Interval;
use crate::linear::solve;
use eigenring_scheme::{Complex, Numbering, Scalar, Site};
use eigenring_spectral::Matrix;

/// A net in the complex plane: real and imaginary part of each point of the numbering.
pub type Net = Vec<Complex<Interval>>;

/// The eigenvector of a simple real eigenvalue on all unknowns of its block, before the constant vector is
/// put back: on block 0 it is one modulo constants, 0 at the unknown that was divided out. Unknowns that no
/// patch depends on are 0. `None` if another component of the block that depends on it was not proven to be
/// free of the eigenvalue.
///
/// On components that do not read the entry's own one the vector is zero; on those that do, in their order,
/// it is the solution of `(value - S_dd) v_d = sum_e S_de v_e` over the components e before d. `value` may be
/// a sharper enclosure of the entry's eigenvalue.
pub fn modulo_constants(block: &Block, entry: &EnclosedEigenvalue, value: Interval) -> Option<Vec<Interval>> {
    if matches!(block.place, Place::Parts | Place::Quotient) {
        return None;
    }
    within(block, entry, value, &|_| true)
}

/// The same on some components, of which the entry's is one and which read no others; zero elsewhere.
fn within(
    block: &Block,
    entry: &EnclosedEigenvalue,
    value: Interval,
    wanted: &dyn Fn(usize) -> bool,
) -> Option<Vec<Interval>> {
    let reduced = on_kept(block, entry, value, wanted)?;
    let mut vector = vec![Interval::point(0.0); block.size];
    for (&unknown, x) in block.kept.iter().zip(reduced) {
        vector[unknown] = x;
    }
    Some(vector)
}

fn on_kept(
    block: &Block,
    entry: &EnclosedEigenvalue,
    value: Interval,
    wanted: &dyn Fn(usize) -> bool,
) -> Option<Vec<Interval>> {
    let zero = Interval::point(0.0);
    let mut vector = vec![zero; block.matrix.rows()];
    for (&unknown, &x) in block.components[entry.component].iter().zip(entry.vector.as_ref()?) {
        vector[unknown] = x;
    }
    for (component, members) in block.components.iter().enumerate() {
        if !(wanted(component) && block.reads[component].contains(&entry.component)) {
            continue;
        }
        let right: Vec<Interval> = members
            .iter()
            .map(|&i| block.matrix.row(i).iter().zip(&vector).map(|(&s, &v)| s * v).sum())
            .collect();
        let shifted = Matrix::from_fn(members.len(), members.len(), |i, j| {
            let shift = if i == j { value } else { zero };
            shift - block.matrix[(members[i], members[j])]
        });
        let part = match &right[..] {
            [single] if shifted[(0, 0)].certainly_nonzero() => vec![*single / shifted[(0, 0)]],
            _ => solve(&shifted, &right)?,
        };
        for (&unknown, x) in members.iter().zip(part) {
            vector[unknown] = x;
        }
    }
    Some(vector)
}

/// The eigenvector of a simple real eigenvalue on all unknowns of its block; see `modulo_constants`. `None`
/// also if the constant vector's eigenvalue 1 was not proven to be another one.
pub fn eigenvector(block: &Block, entry: &EnclosedEigenvalue, value: Interval) -> Option<Vec<Interval>> {
    with_constants(block, modulo_constants(block, entry, value)?, value)
}

/// The eigenvector on some components alone, which with the centre read no others.
pub fn eigenvector_within(block: &Block, entry: &EnclosedEigenvalue, wanted: &[usize]) -> Option<Vec<Interval>> {
    if block.place != Place::Points {
        return None;
    }
    let vector = within(block, entry, entry.value.re, &|component| wanted.contains(&component))?;
    with_constants(block, vector, entry.value.re)
}

fn with_constants(block: &Block, mut vector: Vec<Interval>, value: Interval) -> Option<Vec<Interval>> {
    let Some(divided) = &block.divided else {
        return Some(vector);
    };
    // S (0, y) = value (0, y) + t c, so that y + t/(value - 1) c is the vector
    let kept = block.kept.iter().map(|&unknown| vector[unknown]);
    let excess: Interval = divided.row.iter().zip(kept).map(|(&s, v)| s * v).sum();
    let gap = value - Interval::point(1.0);
    if !gap.certainly_nonzero() {
        return None;
    }
    let factor = excess / gap;
    for (x, &one) in vector.iter_mut().zip(&divided.constant) {
        if one {
            *x += factor;
        }
    }
    Some(vector)
}

/// Whether the surface sees an eigenvector: whether its control points on the annulus are certainly not all
/// zero, or not all equal where constants do not count. B-splines are linearly independent, so that its ring
/// of patches is then not zero.
pub fn is_visible(block: &Block, entry: &EnclosedEigenvalue) -> bool {
    let Some(vector) = modulo_constants(block, entry, entry.value.re) else {
        return false;
    };
    let seen = || (0..block.size).filter(|&unknown| block.visible[unknown]);
    match &block.divided {
        None => seen().any(|unknown| vector[unknown].certainly_nonzero()),
        Some(Divided { constant, .. }) => {
            let first = seen().find(|&unknown| constant[unknown]).map(|unknown| vector[unknown]);
            seen().any(|unknown| {
                let expected = if constant[unknown] {
                    first
                } else {
                    Some(Interval::point(0.0))
                };
                expected.is_some_and(|expected| vector[unknown].disjoint(expected))
            })
        }
    }
}

/// The net of real unknowns of Fourier index `index`: points of a spoke have the value r, points of the
/// diagonal `w^{k/2} r`, pairs `w^{k/2} (p + i q)` and `w^{k/2} (p - i q)`, each times `w^{k (sector -
/// turn/2)}`. With `turn = 1` the first point around a face is real.
pub fn net<S: Scalar + Copy>(numbering: Numbering, index: usize, unknowns: &[S], turn: usize) -> Vec<Complex<S>> {
    let n = numbering.fan.sectors();
    let first = unknowns.len() - numbering.sector_points();
    let half_phases: Vec<Complex<S>> = (0..2 * n)
        .map(|j| Complex::turn((index * j) as i64, 2 * n as i64))
        .collect();
    let unknown = |x: i32, y: i32| {
        let site = Site { sector: 0, x, y };
        // a point of the numbering has its orbit in sector 0
        numbering
            .index_in_sector(site)
            .map_or(S::zero(), |column| unknowns[first + column])
    };
    let value = |site: Site| {
        if site == Site::CENTRE {
            let value = if first == 1 { unknowns[0] } else { S::zero() };
            return Complex::real(value);
        }
        let (turns, p, q) = match site.x.cmp(&site.y) {
            _ if site.y == 0 => (0, unknown(site.x, 0), S::zero()),
            std::cmp::Ordering::Equal => (1, unknown(site.x, site.y), S::zero()),
            std::cmp::Ordering::Greater => (1, unknown(site.x, site.y), unknown(site.y, site.x)),
            std::cmp::Ordering::Less => (1, unknown(site.y, site.x), -unknown(site.x, site.y)),
        };
        let phase = half_phases[(2 * (n + site.sector) + turns - turn) % (2 * n)];
        phase * Complex::new(p, q)
    };
    numbering.sites().into_iter().map(value).collect()
}

impl EnclosedSpectrum {
    /// The net of an entry on the numbering of the annulus, with the given enclosure of its eigenvalue: the
    /// first point of ring 1 is real, and positive where it is not zero.
    pub fn net(&self, entry: &EnclosedEigenvalue, value: Interval) -> Option<Net> {
        let block = self.block(entry.index)?;
        let unknowns = eigenvector(block, entry, value)?;
        let numbering = self.patches.numbering();
        let first = *unknowns.get(unknowns.len() - numbering.sector_points())?;
        let sign = if first.certainly_negative() { -1.0 } else { 1.0 };
        let unknowns: Vec<Interval> = unknowns.into_iter().map(|x| Interval::point(sign) * x).collect();
        let turn = numbering.lattice.parity() as usize;
        Some(net(numbering, entry.index, &unknowns, turn))
    }
}
