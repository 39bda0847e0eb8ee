//! The control points of a face beside a centre, split into limit, tangents and rest, level by level.

use super::centre::Centre;
use super::numbers::ByNumber;
use super::pair::Undefined;
use super::patch::{Jet3, OnCrease, Patch};
use super::quarter::{Context, missing};
use crate::Error;
use nalgebra::{Point3, Vector3};

/// The control points of a face beside a centre, level by level.
#[derive(Debug)]
pub(crate) struct Ladder {
    /// The limit of the centre.
    pub position: Point3<f64>,
    /// Tangents and normal, each of unit length.
    pub frame: [Vector3<f64>; 3],
    /// The tangents a, unless there is no tangent plane.
    pub tangents: Result<[Vector3<f64>; 2], Undefined>,
    /// By how much x and y shrink a level.
    pub lambda: f64,
    /// The tangents' coordinates in the frame, and how the second shrinks beside the first.
    plane: [[f64; 2]; 2],
    ratio: f64,
    /// T of each level, in the frame.
    rest: Vec<Vec<[f64; 3]>>,
    /// The pieces met, by level and quarter.
    patches: ByNumber<Patch>,
    /// The points after the level from which a piece was made last.
    refined: Option<(usize, Vec<[f64; 3]>)>,
}

/// Levels beyond this are computed anew from the last one kept.
const KEPT: usize = 64;

impl Ladder {
    pub fn new(centre: &Centre, points: &[Point3<f64>]) -> Self {
        let combined = |weights: &[f64]| -> Vector3<f64> {
            // of differences from the first point, so that large coordinates cost no digits
            let first = points[0];
            weights.iter().zip(points).map(|(w, p)| (p - first) * *w).sum()
        };
        let from_first = combined(&centre.stage(0).limit);
        let position = points[0] + from_first;
        let scale = points.iter().map(|p| (p - position).norm()).fold(0.0, f64::max);
        let tangents = centre.lambda.and_then(|_| {
            let Some([first, second]) = &centre.stage(0).left else {
                return Err(Undefined::Defective);
            };
            let a = [combined(first), combined(second)];
            // rounding of the coordinates themselves: tangents below it are none
            let least = 1e-13 * scale.max(f64::MIN_POSITIVE) * scale;
            if a[0].cross(&a[1]).norm() > least {
                Ok(a)
            } else {
                Err(Undefined::Degenerate)
            }
        });
        let mut frame = [Vector3::x(), Vector3::y(), Vector3::z()];
        let (mut lambda, mut ratio, mut plane) = (1.0, 1.0, [[0.0; 2]; 2]);
        if let (Ok(a), Ok(pair)) = (&tangents, centre.lambda) {
            let normal = a[0].cross(&a[1]).normalize();
            let first = a[0].normalize();
            frame = [first, normal.cross(&first), normal];
            (lambda, ratio) = (pair[0], pair[1] / pair[0]);
            plane = [0, 1].map(|r| [0, 1].map(|k| a[r].dot(&frame[k])));
        }
        let mut first: Vec<[f64; 3]> = Vec::with_capacity(points.len());
        for (index, point) in points.iter().enumerate() {
            let mut d = (point - points[0]) - from_first;
            if let (Ok(a), Some(map)) = (&tangents, centre.map(0)) {
                d -= a[0] * map[index][0] + a[1] * map[index][1];
            }
            first.push([0, 1, 2].map(|k| d.dot(&frame[k])));
        }
        let mut ladder = Ladder {
            position,
            frame,
            tangents,
            lambda,
            plane,
            ratio,
            rest: Vec::new(),
            patches: ByNumber::default(),
            refined: None,
        };
        ladder.project(centre, 0, &mut first);
        ladder.rest.push(first);
        ladder
    }

    /// Takes limit and tangents out of the rest of a level.
    fn project(&self, centre: &Centre, m: usize, rest: &mut [[f64; 3]]) {
        let part = |weights: &[f64], rest: &[[f64; 3]]| {
            let mut sum = [0.0; 3];
            for (w, t) in weights.iter().zip(rest) {
                (0..3).for_each(|k| sum[k] += w * t[k]);
            }
            sum
        };
        let stage = centre.stage(m);
        let limit = part(&stage.limit, rest);
        rest.iter_mut().for_each(|t| (0..3).for_each(|k| t[k] -= limit[k]));
        if let (Ok(_), Some([first, second]), Some(map)) = (&self.tangents, &stage.left, centre.map(m)) {
            let parts = [part(first, rest), part(second, rest)];
            for (t, r) in rest.iter_mut().zip(map) {
                (0..3).for_each(|k| t[k] -= r[0] * parts[0][k] + r[1] * parts[1][k]);
            }
        }
    }

    /// The rest of the level after m.
    fn advanced(&self, centre: &Centre, m: usize, rest: &[[f64; 3]]) -> Result<Vec<[f64; 3]>, Error> {
        let mut next = centre.stage(m).advanced(rest)?;
        if let (true, Some(beyond), Ok(_)) = (m + 1 == centre.leading(), &centre.beyond, &self.tangents) {
            let shrunk = [1.0, self.ratio.powi(m as i32 + 1)].map(|ratio| ratio * self.lambda.powi(m as i32 + 1));
            for (t, r) in next.iter_mut().zip(beyond) {
                let along = [r[0] * shrunk[0], r[1] * shrunk[1]];
                (0..2).for_each(|k| t[k] += along[0] * self.plane[0][k] + along[1] * self.plane[1][k]);
            }
        }
        self.project(centre, m + 1, &mut next);
        Ok(next)
    }

    /// The points of a level in the frame, x and y over `lambda^m`, z over `lambda^2m`.
    pub fn points(&mut self, centre: &Centre, m: usize) -> Result<Vec<[f64; 3]>, Error> {
        while self.rest.len() <= m.min(KEPT) {
            let m = self.rest.len() - 1;
            let next = self.advanced(centre, m, &self.rest[m])?;
            self.rest.push(next);
        }
        let mut rest = self.rest[m.min(KEPT)].clone();
        for level in KEPT..m {
            rest = self.advanced(centre, level, &rest)?;
        }
        let shrunk = self.lambda.powi(m as i32);
        let slower = self.ratio.powi(m as i32);
        for (index, t) in rest.iter_mut().enumerate() {
            *t = [t[0] / shrunk, t[1] / shrunk, t[2] / shrunk / shrunk];
            if let (Ok(_), Some(map)) = (&self.tangents, centre.map(m)) {
                let r = [map[index][0], map[index][1] * slower];
                (0..2).for_each(|k| t[k] += r[0] * self.plane[0][k] + r[1] * self.plane[1][k]);
            }
        }
        Ok(rest)
    }

    /// The jet at `(s, t)` of the quarter at a corner (1 to 3) of the face of level m, in the frame, and the
    /// factor by which parameters of the jet are finer than those of that face.
    pub fn jet(
        &mut self,
        context: Context<'_>,
        centre: &Centre,
        m: usize,
        quarter: usize,
        s: f64,
        t: f64,
    ) -> Result<(Jet3, f64, Option<OnCrease>), Error> {
        let stage = centre.stage(m);
        let path = stage.locate(context, quarter, s, t)?;
        // names are short: a digit of two bits for each of few cuts
        let key = ((m as u64) << 32) | path.name;
        if let Some(patch) = self.patches.get(&key) {
            return Ok((patch.jet(path.s, path.t), path.finer, patch.on_crease(path.s, path.t)));
        }
        let refined = match self.refined.take() {
            Some((known, refined)) if known == m => refined,
            _ => stage.refined(&self.points(centre, m)?)?,
        };
        let mut made = stage.patches(context, &refined, quarter, s, t)?;
        self.refined = Some((m, refined));
        let Some((_, patch)) = made.last() else {
            return Err(missing());
        };
        let (jet, on_crease) = (patch.jet(path.s, path.t), patch.on_crease(path.s, path.t));
        if m <= KEPT {
            let level = (m as u64) << 32;
            self.patches
                .extend(made.drain(..).map(|(name, patch)| (level | name, patch)));
        }
        Ok((jet, path.finer, on_crease))
    }
}
