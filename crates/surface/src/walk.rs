//! Where the sites around a vertex are on a mesh of quads.

use crate::Topology;
use eigenring_scheme::Site;

/// The spoke `sectors` further on around the origin of `spoke`; beyond the last spoke of an open fan none.
fn turned(topology: &Topology, mut spoke: u32, sectors: usize) -> Option<u32> {
    for _ in 0..sectors {
        spoke = topology.turned(spoke)?;
    }
    Some(spoke)
}

/// The point (even coordinates) or face (odd ones) that is `site` around the vertex from which `first`, its
/// first spoke, leaves. `None` if the mesh ends before it.
pub(crate) fn locate(topology: &Topology, first: u32, site: Site) -> Option<u32> {
    if site == Site::CENTRE {
        return Some(topology.origin(first));
    }
    let odd = site.x % 2 != 0;
    let (a, b) = (site.x / 2, site.y / 2);
    let Some(spoke) = turned(topology, first, site.sector) else {
        // the last spoke of an open fan: along the upper side of the sector before it
        let mut half = topology.previous(turned(topology, first, site.sector.checked_sub(1)?)?);
        for _ in 1..a {
            half = topology.previous(topology.twin(topology.previous(half))?);
        }
        return (!odd && b == 0).then(|| topology.origin(half));
    };
    // the cell whose lower left corner is (a-1, b-1), or (a-1, 0); a face is its own cell
    let (right, up) = if odd { (a, b) } else { (a - 1, (b - 1).max(0)) };
    let mut half = spoke;
    for _ in 0..right {
        half = topology.next(topology.twin(topology.next(half))?);
    }
    for _ in 0..up {
        half = topology.twin(topology.next(topology.next(half)))?;
    }
    Some(if odd {
        topology.face(half)
    } else if b == 0 {
        topology.head(half)
    } else {
        topology.head(topology.next(half))
    })
}
