//! Levels of any passes around vertices, as scheme files describe them, on quads without features.
//!
//! Values sit on vertices or on faces. Each point is made around a centre that owns it: a vertex itself, an
//! edge or a face of the split mesh one of its ends; special rules take precedence over regular ones.

use crate::active::Active;
use crate::refine::{Row, stencil_row};
use crate::rules::Rules;
use crate::walk::locate;
use crate::{Error, Mesh, Topology};
use eigenring_scheme::{Lattice, Site};
use std::collections::HashMap;

const EDGE: Site = Site { sector: 0, x: 2, y: 0 };
const FACE: Site = Site { sector: 0, x: 2, y: 2 };
const MIDDLE: Site = Site { sector: 0, x: 1, y: 1 };

/// The rows of all passes of a level.
pub(crate) fn rows(
    topology: &Topology,
    rules: &Rules,
    active: &Active,
    split: &Mesh,
) -> Result<Vec<Vec<Option<Row>>>, Error> {
    let fine = Topology::unchecked(split);
    let any = rules.inner(None, 4)?;
    let passes = any.limit().passes().len();
    let vertices = topology.vertex_count() as u32;
    // the mesh that is read, and the first spoke of a vertex of the control mesh on it
    let mut refined = false;
    let mut all = Vec::with_capacity(passes);
    for pass in 0..passes {
        let level = any.limit();
        let (to, scale) = (level.passes()[pass].to(), level.passes()[pass].scale());
        let read = if refined { &fine } else { topology };
        refined |= scale == 2;
        let made = if refined { &fine } else { topology };
        let spoke_of = |half: u32, on_fine: bool| if on_fine { 4 * half } else { half };
        let regular = |first: Option<u32>, site: Site| -> Result<Option<Row>, Error> {
            let Some(first) = first else { return Ok(None) };
            let fan = read.fan(read.origin(first));
            // regular rules read across as many sectors as there are
            let scheme = if fan.is_closed() && fan.spokes.len() >= 3 {
                rules.inner(Some(read.origin(first)).filter(|&v| v < vertices), fan.spokes.len())?
            } else {
                return Ok(None);
            };
            Ok(stencil_row(read, first, &scheme.limit().stencil(pass, site)?))
        };
        let mut rows: Vec<Option<Row>> = Vec::new();
        match (to, scale) {
            (Lattice::Vertex, 2) => {
                for vertex in 0..vertices {
                    rows.push(regular(read.first_spoke(vertex), Site::CENTRE)?);
                }
                for number in 0..read.edge_count() as u32 {
                    rows.push(regular(Some(read.half_of_edge(number)), EDGE)?);
                }
                for face in 0..read.face_count() as u32 {
                    rows.push(regular(Some(read.face_halves(face).start), FACE)?);
                }
            }
            (Lattice::Vertex, _) => {
                for vertex in 0..made.vertex_count() as u32 {
                    rows.push(regular(read.first_spoke(vertex), Site::CENTRE)?);
                }
            }
            (Lattice::Face, _) => {
                for face in 0..made.face_count() as u32 {
                    rows.push(regular(Some(read.face_halves(face).start), MIDDLE)?);
                }
            }
        }
        let mut owners: HashMap<u32, u32> = HashMap::new();
        let read_fine = refined && scale != 2;
        for vertex in 0..vertices {
            let fan = topology.fan(vertex);
            let n = fan.spokes.len();
            if n < 3 || !fan.is_closed() || !active.is_plain(vertex) || !rules.is_special(vertex, n) {
                continue;
            }
            let scheme = rules.inner(Some(vertex), n)?;
            let level = scheme.limit();
            let listed: Vec<Site> = level.passes()[pass].special().keys().copied().collect();
            let turns = if listed.iter().all(|site| site.sector == 0) {
                n
            } else {
                1
            };
            for sector in 0..turns {
                for &site in &listed {
                    let site = if site == Site::CENTRE {
                        site
                    } else {
                        site.rotated(level.fan(), sector as i64)
                    };
                    let stencil = level.stencil(pass, site)?;
                    let at = locate(made, spoke_of(fan.spokes[0], refined), site);
                    let row = stencil_row(read, spoke_of(fan.spokes[0], read_fine), &stencil);
                    let Some(at) = at else { continue };
                    if let Some(other) = owners.insert(at, vertex).filter(|&other| other != vertex) {
                        return Err(Error::NoRule {
                            what: "special rules that meet each other".to_owned(),
                            elements: format!("vertices {other} and {vertex}"),
                            accepted: "are special vertices that lie farther apart".to_owned(),
                        });
                    }
                    rows[at as usize] = row;
                }
            }
        }
        all.push(rows);
    }
    Ok(all)
}
