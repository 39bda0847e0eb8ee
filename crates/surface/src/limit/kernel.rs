//! What the pieces of a surface are, and how far they read.

use super::partial::{Across, Lines};
use crate::Error;
use crate::rules::{Method, Rules};
use eigenring_scheme::families::tension_at;
use eigenring_spline::curve::{Piece, Tension};
use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock};

/// The tensor-product spline of the regular parts of a surface.
#[derive(Debug)]
pub(crate) struct Kernel {
    /// The order: a piece has so many control points in each direction.
    pub order: usize,
    /// Whether control points sit on quads, not on vertices.
    pub dual: bool,
    /// A piece reads the quads in so many rings around its own.
    pub rings: usize,
    /// Whether special rules reach a ring farther than the irregular vertex itself.
    pub beyond: bool,
    u0: f64,
    /// The first level from which on all are alike.
    pub stationary: usize,
    pieces: Vec<OnceLock<Arc<Piece>>>,
    across: Mutex<HashMap<(usize, Lines), Arc<Across>>>,
}

impl Kernel {
    pub fn new(rules: &Rules) -> Result<Self, Error> {
        let (order, u0, dual) = match rules.method()? {
            Method::Bicubic => (4, 1.0, false),
            Method::Even { order, u0 } => (order, u0, false),
            Method::Odd { u0 } => {
                let degree = rules.degree()?.filter(|degree| degree % 2 == 0);
                (degree.ok_or_else(|| refused(rules))? + 1, u0, true)
            }
            Method::Passes => return Err(refused(rules)),
        };
        let stationary = (0..).find(|&level| tension_at::<f64>(u0, level) == 1.0);
        let stationary = stationary.ok_or_else(|| refused(rules))?;
        Ok(Kernel {
            order,
            dual,
            rings: if dual { (order - 1) / 2 } else { order / 2 - 1 },
            beyond: !dual && rules.reaches_beyond_vertex(),
            u0,
            stationary,
            pieces: (0..=stationary).map(|_| OnceLock::new()).collect(),
            across: Mutex::default(),
        })
    }

    /// The rings of quads that a part has.
    pub fn reach(&self) -> usize {
        self.rings + usize::from(self.beyond)
    }

    /// The tension of the step that refines a level.
    pub fn tension(&self, level: usize) -> f64 {
        tension_at(self.u0, level.min(self.stationary))
    }

    /// Whether pieces of a level are cubic B-splines.
    pub fn is_cubic(&self, level: usize) -> bool {
        self.order == 4 && level >= self.stationary
    }

    /// In how many smoothing steps of a level creases act that act in all; 0 where there are no such steps.
    pub fn full_steps(&self) -> u32 {
        if self.dual { 0 } else { self.rings as u32 }
    }

    /// Whether a crease at a place, in units of an interval from its beginning, is among the control points
    /// that decide what the functions of the interval are.
    pub fn is_within(&self, line: i32) -> bool {
        let rings = self.rings as i32;
        (1 - rings..=rings).contains(&line)
    }

    /// The functions across creases that act in some steps, on an interval of a level.
    pub fn across(&self, level: usize, lines: &Lines) -> Result<Arc<Across>, Error> {
        let level = level.min(self.stationary);
        let key = (level, lines.clone());
        let known = self.across.lock().ok();
        if let Some(known) = known.and_then(|known| known.get(&key).cloned()) {
            return Ok(known);
        }
        let made = Arc::new(Across::new(self, level, lines)?);
        if let Ok(mut known) = self.across.lock() {
            known.insert(key, Arc::clone(&made));
        }
        Ok(made)
    }

    /// The basis of the pieces of a level.
    pub fn piece(&self, level: usize) -> Result<Arc<Piece>, Error> {
        let level = level.min(self.stationary);
        if let Some(piece) = self.pieces[level].get() {
            return Ok(Arc::clone(piece));
        }
        let tension = Tension::new(self.tension(level)).map_err(eigenring_scheme::Error::from)?;
        let piece = Piece::new(self.order, tension).map_err(eigenring_scheme::Error::from)?;
        Ok(Arc::clone(self.pieces[level].get_or_init(|| Arc::new(piece))))
    }
}

fn refused(rules: &Rules) -> Error {
    Error::NoRule {
        what: format!("no exact limits of {}", rules.definition().name()),
        elements: "any face".to_owned(),
        accepted: "are schemes whose regular surfaces are bicubic in one pass, and the tension scheme of any order"
            .to_owned(),
    }
}
