//! The characteristic map on an interval of lambda.

use super::stencil_box::StencilBox;
use crate::linear::eliminate;
use crate::map::PlaneNet;
use crate::spectral::net;
use crate::{Centred, Enclose};
use eigenring_scheme::{Scalar, Scheme};
use eigenring_spectral::{Annulus, Block, Matrix, fourier_block};

/// The net of the eigenvector of lambda in block 1, with `E_0 = (1, 0)`; `None` if it cannot be enclosed.
///
/// `E = 1` and, from the face rule, `F = 2 f2 cos(pi/N)/(lambda - f3)` in the real unknowns; then ring by
/// ring `(lambda - S_rr) v_r = sum_q S_rq v_q` over the rings q before r.
pub fn characteristic(point: &StencilBox) -> Option<PlaneNet<Centred<1>>> {
    let plane = &point.plane;
    let scheme: Scheme<Centred<1>> = point.stencil.weights.scheme("", plane.valence).ok()?;
    let annulus = Annulus::new(&scheme).ok()?;
    let numbering = annulus.numbering;
    let Block::Real(block) = fourier_block(scheme.limit(), numbering.rings, 1).ok()? else {
        return None;
    };
    let gap = plane.lambda - point.f3;
    if gap.enclosure().contains_zero() {
        return None;
    }
    let rings: Vec<usize> = numbering.sector_sites(0).map(|site| site.ring()).collect();
    let sites: Vec<_> = numbering.sector_sites(0).collect();
    let mut vector = vec![Centred::zero(); sites.len()];
    for (value, site) in vector.iter_mut().zip(&sites).filter(|(_, site)| site.ring() == 1) {
        *value = if site.y == 0 {
            Centred::one()
        } else {
            plane.corner_radius(point.f2, point.f3)
        };
    }
    for ring in 2..=numbering.rings {
        let members: Vec<usize> = (0..sites.len()).filter(|&i| rings[i] == ring).collect();
        let right: Vec<Centred<1>> = members
            .iter()
            .map(|&i| {
                let inner = (0..sites.len()).filter(|&j| rings[j] < ring && !block[(i, j)].enclosure().is_zero());
                inner.fold(Centred::zero(), |sum, j| sum + block[(i, j)] * vector[j])
            })
            .collect();
        let shifted = Matrix::from_fn(members.len(), members.len(), |i, j| {
            let entry = block[(members[i], members[j])];
            if i == j { plane.lambda - entry } else { -entry }
        });
        for (&unknown, value) in members.iter().zip(eliminate(shifted, right)?) {
            vector[unknown] = value;
        }
    }
    let (x, y) = net(numbering, 1, &vector, 0).into_iter().map(|z| (z.re, z.im)).unzip();
    PlaneNet::new(annulus, 1, true, [x, y]).ok()
}
