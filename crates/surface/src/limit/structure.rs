//! What the surface on a face is made of, by the structure around it alone: a piece, a centre at a corner, or
//! four quarters. Faces around which the mesh looks the same share it, and only their points differ.

use super::Surface;
use super::centre::{Centre, Stage};
use super::local::{Key, Local, Source};
use super::net::{Control, control};
use super::pair::{Pair, Undefined};
use super::quarter::missing;
use crate::refine::Step;
use crate::{Error, Topology};
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

/// What is known by the structure around a face and the level.
#[derive(Debug, Default)]
pub(super) struct Known {
    centres: HashMap<(Key, usize), Arc<Centre>>,
    stages: HashMap<(Key, usize), Arc<Stage>>,
    pairs: HashMap<Key, Arc<Result<Pair, Undefined>>>,
    structures: HashMap<(Key, usize), Arc<Structure>>,
}

/// The structure around a face, and the numbers of its control points among those of the level before.
#[derive(Debug)]
pub(super) struct Part {
    pub ids: Vec<u32>,
    pub structure: Arc<Structure>,
}

/// The surface on a face of a level.
#[derive(Debug)]
pub(super) struct Structure {
    local: Local,
    pub level: usize,
    pub what: What,
}

#[derive(Debug)]
pub(super) enum What {
    /// A piece.
    Regular(Control),
    /// A centre at a corner, with the control points in the order of the part counted from there.
    Centre {
        corner: u32,
        centre: Arc<Centre>,
        ids: Vec<u32>,
    },
    /// Quarters, once they are asked for.
    Inner(Box<Inner>),
}

#[derive(Debug)]
pub(super) struct Inner {
    pub refined: Step,
    topology: Topology,
    quarters: [OnceLock<Part>; 4],
}

/// No part of a face needs as many levels to be isolated: sharpness below 10 ends after ten.
const DEEPEST: usize = 48;

impl Part {
    /// The part of the base counted from a half-edge.
    #[cold]
    pub fn root(surface: &Surface<'_>, half: u32) -> Result<Part, Error> {
        let source = Source {
            mesh: &surface.base,
            topology: &surface.topology,
            ends: surface.ends,
            soft: surface.soft,
            net: surface.net.as_ref(),
            full: surface.kernel.full_steps(),
        };
        let own = |id: u32| surface.rules.vertices().any(|v| v == id).then_some(id);
        let none = surface.rules.vertices().next().is_none();
        let rings = surface.kernel.reach();
        let local = source.part(half, rings, |id| if none { None } else { own(id) });
        Part::new(surface, local, surface.lift)
    }

    fn new(surface: &Surface<'_>, local: Local, level: usize) -> Result<Part, Error> {
        let ids = local.unknowns().to_vec();
        let key = (local.key(), level);
        let known = surface.known.lock().ok();
        if let Some(structure) = known.and_then(|known| known.structures.get(&key).cloned()) {
            return Ok(Part { ids, structure });
        }
        let (what, is_common) = What::of(surface, &local, level)?;
        let structure = Arc::new(Structure { local, level, what });
        if let (true, Ok(mut known)) = (is_common, surface.known.lock()) {
            known.structures.insert(key, Arc::clone(&structure));
        }
        Ok(Part { ids, structure })
    }
}

impl Structure {
    /// A quarter of what consists of quarters.
    pub fn quarter(&self, surface: &Surface<'_>, quarter: usize) -> Result<&Part, Error> {
        let What::Inner(inner) = &self.what else {
            return Err(missing());
        };
        let slot = &inner.quarters[quarter];
        if let Some(known) = slot.get() {
            return Ok(known);
        }
        let (refined, rings) = (&inner.refined, surface.kernel.reach());
        let part = self.local.child(refined, &inner.topology, quarter as u32, rings);
        let part = Part::new(surface, part.ok_or_else(missing)?, self.level + 1)?;
        Ok(slot.get_or_init(|| part))
    }
}

impl What {
    /// What a part of a level is, and whether many parts are like it: those with one irregular vertex at
    /// most, of which there are only so many.
    fn of(surface: &Surface<'_>, local: &Local, level: usize) -> Result<(Self, bool), Error> {
        let (rules, kernel) = (surface.local_rules(), &surface.kernel);
        let mut is_common = false;
        if !local.is_soft() {
            let irregular = local.irregular(rules, kernel.rings);
            is_common = irregular.len() < 2;
            let near = kernel.beyond && local.is_near_special(rules);
            if irregular.is_empty() && !near {
                let control = control(local, kernel).ok_or_else(missing)?;
                return Ok((What::Regular(control), is_common));
            }
            if let &[half] = irregular.as_slice() {
                let vertex = local.topology.origin(half);
                let corner = (0..4).find(|&corner| local.topology.origin(corner) == vertex);
                if let Some(corner) = corner {
                    let turned = local.turned(corner, kernel.reach());
                    if let Some(centre) = centre(surface, &turned, level)? {
                        let ids = turned.unknowns().to_vec();
                        return Ok((What::Centre { corner, centre, ids }, is_common));
                    }
                }
            }
        }
        if level > surface.lift + DEEPEST {
            return Err(missing());
        }
        let refined = local.refined(rules, kernel, level)?;
        let inner = Inner {
            topology: Topology::unchecked(&refined.mesh),
            refined,
            quarters: Default::default(),
        };
        Ok((What::Inner(Box::new(inner)), is_common))
    }
}

/// The centre at the first corner of a part, if refinement reproduces the part.
fn centre(surface: &Surface<'_>, local: &Local, level: usize) -> Result<Option<Arc<Centre>>, Error> {
    let (rules, kernel) = (surface.local_rules(), &surface.kernel);
    let level = level.min(kernel.stationary);
    let key = local.key();
    let known = surface.known.lock().ok();
    if let Some(centre) = known.and_then(|known| known.centres.get(&(key.clone(), level)).cloned()) {
        return Ok(Some(centre));
    }
    let mut stages: Vec<Arc<Stage>> = Vec::new();
    let mut pair = None;
    // from the level that all others equal back to this one
    for at in (level..=kernel.stationary).rev() {
        let known = surface.known.lock().ok();
        let found = known.and_then(|known| {
            pair = pair.take().or_else(|| known.pairs.get(&key).cloned());
            known.stages.get(&(key.clone(), at)).cloned()
        });
        let stage = match (found, &pair) {
            (Some(stage), Some(_)) => stage,
            _ => {
                let refined = local.refined(rules, kernel, at)?;
                let topology = Topology::unchecked(&refined.mesh);
                let child = local
                    .child(&refined, &topology, 0, kernel.reach())
                    .ok_or_else(missing)?;
                if child.key() != key {
                    return Ok(None);
                }
                let next = stages.last().map(Arc::as_ref).zip(pair.as_deref());
                let (stage, own) = Stage::new(local, (refined, &topology), &child, kernel, at, next)?;
                let stage = Arc::new(stage);
                let own = own.map(Arc::new);
                if let Ok(mut known) = surface.known.lock() {
                    known.stages.insert((key.clone(), at), Arc::clone(&stage));
                    known.pairs.extend(own.clone().map(|own| (key.clone(), own)));
                }
                pair = pair.or(own);
                stage
            }
        };
        stages.push(stage);
    }
    stages.reverse();
    let Some(pair) = pair else { return Ok(None) };
    let centre = Arc::new(Centre::new(stages, &pair)?);
    if let Ok(mut known) = surface.known.lock() {
        known.centres.insert((key, level), Arc::clone(&centre));
    }
    Ok(Some(centre))
}
