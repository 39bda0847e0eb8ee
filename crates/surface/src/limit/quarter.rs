//! The quarters of a face beside a centre, which are cut until they are regular pieces.

use super::kernel::Kernel;
use super::local::Local;
use super::net::{Control, control};
use super::patch::Patch;
use crate::refine::Step;
use crate::rules::Rules;
use crate::{Error, Topology};
use eigenring_scheme::Table;
use std::sync::OnceLock;

/// What refines parts of a surface.
#[derive(Clone, Copy)]
pub(crate) struct Context<'a> {
    pub rules: &'a Rules,
    pub kernel: &'a Kernel,
}

/// A quarter of a face beside the centre, or a quarter of one.
#[derive(Debug)]
pub(crate) struct Quarter {
    pub local: Local,
    /// The level whose control points it has.
    level: usize,
    split: OnceLock<Option<Box<Split>>>,
    /// The control points of its piece, if it is one.
    control: OnceLock<Option<Control>>,
}

/// A quarter that is no regular piece yet.
#[derive(Debug)]
struct Split {
    tables: Vec<Table<f64>>,
    quarters: [Quarter; 4],
}

/// A part of a mesh that ends where its rules read: at a boundary without rules.
pub(crate) fn missing() -> Error {
    Error::NoRule {
        what: "the surface ends".to_owned(),
        elements: "a boundary without rules".to_owned(),
        accepted: "are places farther inside".to_owned(),
    }
}

impl Quarter {
    pub fn new(
        local: &Local,
        (refined, topology): (&Step, &Topology),
        corner: u32,
        level: usize,
        kernel: &Kernel,
    ) -> Result<Self, Error> {
        let child = local.child(refined, topology, corner, kernel.reach());
        Ok(Quarter {
            local: child.ok_or_else(missing)?,
            level,
            split: OnceLock::new(),
            control: OnceLock::new(),
        })
    }

    /// Makes the piece at a place of the quarter, the last of `made`, with its name; control points are
    /// picked from those of the refined part. Pieces beside it that have their points then come before.
    pub fn patches(
        &self,
        context: Context<'_>,
        refined: &[[f64; 3]],
        at: &mut Path,
        depth: usize,
        made: &mut Vec<(u64, Patch)>,
    ) -> Result<(), Error> {
        let points: Vec<[f64; 3]> = self.local.unknowns().iter().map(|&id| refined[id as usize]).collect();
        match self.split(context, depth)? {
            None => {
                let control = self.control.get_or_init(|| control(&self.local, context.kernel));
                let control = control.as_ref().ok_or_else(missing)?;
                made.push((at.name, Patch::new(control, &points, context.kernel, self.level)?));
                Ok(())
            }
            Some(split) => {
                let name = 4 * at.name;
                let quarter = at.descend();
                let refined = applied(&split.tables, &points)?;
                for (number, beside) in split.quarters.iter().enumerate().filter(|(n, _)| *n != quarter) {
                    if depth > 1 && beside.split(context, depth - 1)?.is_none() {
                        let mut at = Path {
                            name: name + number as u64,
                            ..*at
                        };
                        beside.patches(context, &refined, &mut at, depth - 1, made)?;
                    }
                }
                split.quarters[quarter].patches(context, &refined, at, depth - 1, made)
            }
        }
    }

    /// Moves a place into the quarters where it lies, without computing anything there.
    pub fn locate(&self, context: Context<'_>, at: &mut Path, depth: usize) -> Result<(), Error> {
        if let Some(split) = self.split(context, depth)? {
            let quarter = at.descend();
            split.quarters[quarter].locate(context, at, depth - 1)?;
        }
        Ok(())
    }

    /// The quarters of a quarter that is not regular.
    fn split(&self, context: Context<'_>, depth: usize) -> Result<Option<&Split>, Error> {
        if let Some(known) = self.split.get() {
            return Ok(known.as_deref());
        }
        let Context { rules, kernel } = context;
        let near = kernel.beyond && self.local.is_near_special(rules);
        let split = if self.local.irregular(rules, kernel.rings).is_empty() && !near {
            None
        } else if depth == 0 {
            return Err(Error::NoRule {
                what: "special rules that reach too far for limits".to_owned(),
                elements: "an irregular vertex".to_owned(),
                accepted: "are rules of the points next to the vertex".to_owned(),
            });
        } else {
            let refined = self.local.refined(rules, kernel, self.level)?;
            let topology = Topology::unchecked(&refined.mesh);
            let fine = (&refined, &topology);
            let quarter = |corner| Quarter::new(&self.local, fine, corner, self.level + 1, kernel);
            let quarters = [quarter(0)?, quarter(1)?, quarter(2)?, quarter(3)?];
            let tables = refined.tables;
            Some(Box::new(Split { tables, quarters }))
        };
        Ok(self.split.get_or_init(|| split).as_deref())
    }
}

/// A place in a quarter, on its way into the piece where it lies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path {
    pub s: f64,
    pub t: f64,
    /// The corners of the quarters, in base 4 after the first.
    pub name: u64,
    /// How much finer the parameters are than those of the face.
    pub finer: f64,
}

impl Path {
    /// In a quarter of a face.
    pub fn new(quarter: usize, s: f64, t: f64) -> Self {
        Path {
            s,
            t,
            name: quarter as u64,
            finer: 2.0,
        }
    }

    fn descend(&mut self) -> usize {
        let (quarter, s, t) = quartered(self.s, self.t);
        *self = Path {
            s,
            t,
            name: 4 * self.name + quarter as u64,
            finer: 2.0 * self.finer,
        };
        quarter
    }
}

/// A quarter at distance 1 from the centre, in units of its own size, is at distance `2^d` after d cuts: a
/// piece that reads 15 rings, the most, is free of the centre after 4; one more for rules that reach farther.
pub(super) const DEEPEST: usize = 5;

pub(super) fn applied<const D: usize>(tables: &[Table<f64>], points: &[[f64; D]]) -> Result<Vec<[f64; D]>, Error> {
    let mut points = points.to_vec();
    for table in tables {
        points = table.apply(&points)?;
    }
    Ok(points)
}

/// The quarter of a face in which parameters lie, by its corner, and the parameters there.
pub(crate) fn quartered(s: f64, t: f64) -> (usize, f64, f64) {
    let (right, up) = (s >= 0.5, t >= 0.5);
    let quarter = match (right, up) {
        (false, false) => 0,
        (true, false) => 1,
        (true, true) => 2,
        (false, true) => 3,
    };
    let fine = |x: f64, upper: bool| if upper { 2.0 * x - 1.0 } else { 2.0 * x };
    (quarter, fine(s, right), fine(t, up))
}
