//! The local matrix of an odd order around a half cell: a vertex of a boundary, or one side of a crease.
//!
//! Control points are named by sites in half steps, as around a face: those of quads are `(2a+1, 2b+1)` of
//! their sector, those of the rims `(2a+1, 0)` of sector 0 and of the sector after the last, and a corner is
//! the centre. R rings of n faces hold `n (R+1)^2` points of quads and `2 (R+1)` of rims.

use super::DualNet;
use super::centre::composed;
use super::dual;
use super::kernel::Kernel;
use super::local::Local;
use super::quarter::missing;
use crate::features::{INFINITE, edge};
use crate::refine::Row;
use crate::rules::Rules;
use crate::walk::locate;
use crate::{Error, Mesh, Topology};
use eigenring_scheme::Site;
use nalgebra::Point3;
use std::collections::HashMap;

/// A level around a half cell, as one matrix.
#[derive(Clone, Debug)]
pub struct HalfCell {
    /// Where the points are: rings outwards, in a ring from the right rim to the left one.
    pub sites: Vec<Site>,
    /// The weights of the points before in each point, by their numbers.
    pub rows: Vec<Vec<(u32, f64)>>,
    /// The smallest number of rings that refinement does not leave.
    pub closed_rings: usize,
    /// The level, counted from 0, and the first level from which on all are alike.
    pub level: [usize; 2],
}

impl HalfCell {
    /// The level of a dual scheme around a half cell of so many faces, with the corner in front or without,
    /// on so many rings beyond the smallest closed number; by default the level that all later ones equal.
    ///
    /// # Errors
    /// [`Error::NoRule`] for schemes other than those of odd order.
    pub fn new(rules: &Rules, faces: usize, corner: bool, more: usize, level: Option<usize>) -> Result<Self, Error> {
        let kernel = Kernel::new(rules)?;
        if !kernel.dual {
            return Err(Error::NoRule {
                what: format!("no half cells in {}", rules.definition().name()),
                elements: "any boundary".to_owned(),
                accepted: "are odd orders of the tension scheme, and doo-sabin".to_owned(),
            });
        }
        let level = level.unwrap_or(kernel.stationary).min(kernel.stationary);
        let closed_rings = (kernel.order - 3) / 2;
        let rings = closed_rings + more;
        // smoothing leaves out the quads at the end of the part, a ring each time
        let local = part(faces, rings + 2, corner);
        let refined = dual::step(&local, rules, &kernel, level)?;
        let sites = sites(faces, rings, corner);
        let net = |local: &Local| local.net.as_ref().map(|(net, _)| net.clone());
        let before = numbers(&sites, faces, &local.topology, &net(&local).ok_or_else(missing)?)?;
        let topology = Topology::unchecked(&refined.mesh);
        let after = numbers(&sites, faces, &topology, refined.net.as_ref().ok_or_else(missing)?)?;
        let columns: HashMap<u32, u32> = before.into_iter().zip(0..).collect();
        let row = |terms: Row| -> Result<Row, Error> {
            let terms = terms.into_iter().filter(|(_, weight)| *weight != 0.0);
            let mut row = terms
                .map(|(at, weight)| columns.get(&at).map(|&column| (column, weight)))
                .collect::<Option<Vec<_>>>()
                .ok_or_else(missing)?;
            row.sort_unstable_by_key(|term| term.0);
            Ok(row)
        };
        Ok(HalfCell {
            rows: composed(&refined, &after)
                .into_iter()
                .map(row)
                .collect::<Result<_, _>>()?,
            sites,
            closed_rings,
            level: [level, kernel.stationary],
        })
    }
}

fn sites(faces: usize, rings: usize, corner: bool) -> Vec<Site> {
    let mut sites: Vec<Site> = corner.then_some(Site::CENTRE).into_iter().collect();
    for ring in 0..=rings as i32 {
        let far = 2 * ring + 1;
        let rim = |sector| Site { sector, x: far, y: 0 };
        sites.push(rim(0));
        for sector in 0..faces {
            let up = (1..=far).step_by(2).map(|y| (far, y));
            let back = (1..far).step_by(2).rev().map(|x| (x, far));
            sites.extend(up.chain(back).map(|(x, y)| Site { sector, x, y }));
        }
        sites.push(rim(faces));
    }
    sites
}

/// Quads around a vertex on a rim, in so many rings.
fn part(faces: usize, rings: usize, corner: bool) -> Local {
    let mut numbers = HashMap::from([(Site::CENTRE, 0)]);
    for sector in 0..=faces {
        for (a, b) in (1..=rings as i32).flat_map(|a| (0..=rings as i32).map(move |b| (a, b))) {
            if sector < faces || b == 0 {
                let number = numbers.len() as u32;
                let (x, y) = (2 * a, 2 * b);
                numbers.insert(Site { sector, x, y }, number);
            }
        }
    }
    let at = |sector: usize, a: usize, b: usize| {
        let (x, y) = (2 * a as i32, 2 * b as i32);
        match (a, b) {
            (0, 0) => 0,
            (0, _) => {
                numbers[&Site {
                    sector: sector + 1,
                    x: y,
                    y: 0,
                }]
            }
            _ => numbers[&Site { sector, x, y }],
        }
    };
    let mut list = Vec::with_capacity(4 * faces * rings * rings);
    for (sector, a, b) in (0..faces).flat_map(|s| (0..rings).flat_map(move |a| (0..rings).map(move |b| (s, a, b)))) {
        list.extend([
            at(sector, a, b),
            at(sector, a + 1, b),
            at(sector, a + 1, b + 1),
            at(sector, a, b + 1),
        ]);
    }
    let mut mesh = Mesh::of_quads(vec![Point3::origin(); numbers.len()], list);
    let mut net = DualNet {
        points: Vec::new(),
        rims: HashMap::new(),
        corners: HashMap::new(),
    };
    let mut next = mesh.face_count() as u32;
    let mut point = || {
        next += 1;
        next - 1
    };
    for (sector, a) in [0, faces].into_iter().flat_map(|s| (0..rings).map(move |a| (s, a))) {
        let end = |a: usize| match a {
            0 => 0,
            a => {
                numbers[&Site {
                    sector,
                    x: 2 * a as i32,
                    y: 0,
                }]
            }
        };
        let pair = edge(end(a), end(a + 1));
        mesh.features.creases.insert(pair, INFINITE);
        net.rims.insert(pair, point());
    }
    if corner {
        net.corners.insert(0, point());
    }
    net.points = vec![Point3::origin(); next as usize];
    let topology = Topology::unchecked(&mesh);
    Local {
        ids: (0..mesh.points().len() as u32).collect(),
        topology,
        mesh,
        net: Some((net, (0..next).collect())),
        named: HashMap::new(),
    }
}

/// The numbers of the points at sites around vertex 0.
fn numbers(sites: &[Site], faces: usize, topology: &Topology, net: &DualNet) -> Result<Vec<u32>, Error> {
    let first = topology.fan(0).spokes.first().copied().ok_or_else(missing)?;
    let vertex = |sector: usize, x: i32| match x {
        0 => Some(0),
        _ => locate(topology, first, Site { sector, x, y: 0 }),
    };
    let number = |&site: &Site| -> Option<u32> {
        if site == Site::CENTRE {
            return net.corners.get(&0).copied();
        }
        if site.y == 0 {
            debug_assert!(site.sector == 0 || site.sector == faces, "rims are first and last");
            let pair = edge(vertex(site.sector, site.x - 1)?, vertex(site.sector, site.x + 1)?);
            return net.rims.get(&pair).copied();
        }
        locate(topology, first, site)
    };
    sites.iter().map(|site| number(site).ok_or_else(missing)).collect()
}
