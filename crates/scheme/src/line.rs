//! Rules for regular points: one dimension, to be used in both.

use crate::{Lattice, Same, Scalar};
use std::collections::BTreeMap;

/// The points that make another one: positions in half steps, and weights.
pub type Taps<W> = Vec<(i32, W)>;

/// A rule of univariate subdivision or smoothing, across one spoke. The regular points of a
/// [`Pass`](crate::Pass) use the tensor product of two.
///
/// All positions are in half steps from the spoke. A target point `X` belongs to the class `floor(X/2) mod
/// scale`; a tap `(offset, w)` of its class reads the source point `(X + offset) / scale` with weight `w`.
/// Targets near the spoke may have taps of their own, given by their sources: a crease keeps what lies beyond
/// it out of its rules, and knot intervals change from one side of a spoke to the other. Beyond them the rule
/// is uniform.
#[derive(Clone, Debug, PartialEq)]
pub struct Line<W> {
    classes: Vec<Taps<W>>,
    near: BTreeMap<i32, Taps<W>>,
}

impl<W: Clone> Line<W> {
    /// A uniform rule with one list of taps per class; as many classes as the target is finer than the
    /// source.
    pub fn new(classes: Vec<Taps<W>>) -> Self {
        Line {
            classes,
            near: BTreeMap::new(),
        }
    }

    /// The same with taps `(source, weight)` of its own for the target at `x >= 0`.
    pub fn with_near(mut self, x: i32, taps: Taps<W>) -> Self {
        debug_assert!(x >= 0, "a point of a sector has no negative coordinate");
        self.near.insert(x, taps);
        self
    }

    /// Target points per source point: 1 for smoothing, 2 for refinement.
    pub fn scale(&self) -> i32 {
        self.classes.len() as i32
    }

    /// Whether no target near the spoke has taps of its own.
    pub fn is_uniform(&self) -> bool {
        self.near.is_empty()
    }

    /// The farthest target that has taps of its own.
    pub fn last_near(&self) -> Option<i32> {
        self.near.last_key_value().map(|(&x, _)| x)
    }

    /// The taps of each class.
    pub fn classes(&self) -> &[Taps<W>] {
        &self.classes
    }

    /// The sources and weights of the target point `x`.
    pub fn taps(&self, x: i32) -> impl Iterator<Item = (i32, W)> + '_ {
        let scale = self.scale();
        let near = self.near.get(&x);
        let class = x.div_euclid(2).rem_euclid(scale) as usize;
        let uniform = if near.is_some() { &[][..] } else { &self.classes[class] };
        let uniform = uniform
            .iter()
            .map(move |(offset, weight)| ((x + offset).div_euclid(scale), weight.clone()));
        near.into_iter().flatten().cloned().chain(uniform)
    }

    /// The farthest target that can read a source at most `reach` half steps away from the spoke.
    pub(crate) fn farthest_reader(&self, reach: i32) -> i32 {
        let offsets = self.classes.iter().flatten().map(|(offset, _)| offset.abs());
        let uniform = self.scale() * reach + offsets.max().unwrap_or(0);
        uniform.max(self.last_near().unwrap_or(0))
    }

    /// Whether every tap of every class leads from a point of `to` to a point of `from`.
    pub fn connects(&self, from: Lattice, to: Lattice) -> bool {
        let scale = self.scale();
        let on = |lattice: Lattice, x: i32| (x - lattice.parity()).rem_euclid(2) == 0;
        let uniform = (0..scale).all(|class| {
            let x = 2 * class + to.parity();
            let mut taps = self.classes[class as usize].iter();
            taps.all(|&(offset, _)| (x + offset).rem_euclid(scale) == 0 && on(from, (x + offset) / scale))
        });
        let mut near = self.near.iter();
        uniform && near.all(|(&x, taps)| on(to, x) && taps.iter().all(|&(source, _)| on(from, source)))
    }

    /// The same rule with other weights.
    pub fn map<T: Clone>(&self, mut f: impl FnMut(&W) -> T) -> Line<T> {
        let mut taps = |list: &Taps<W>| list.iter().map(|(x, weight)| (*x, f(weight))).collect();
        Line {
            classes: self.classes.iter().map(&mut taps).collect(),
            near: self.near.iter().map(|(&x, list)| (x, taps(list))).collect(),
        }
    }
}

impl<W: Same> Line<W> {
    /// Whether both rules are known to be the same.
    pub fn same(&self, other: &Self) -> bool {
        let taps =
            |a: &Taps<W>, b: &Taps<W>| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.0 == b.0 && a.1.same(&b.1));
        self.classes.len() == other.classes.len()
            && self.classes.iter().zip(&other.classes).all(|(a, b)| taps(a, b))
            && self.near.len() == other.near.len()
            && self
                .near
                .iter()
                .zip(&other.near)
                .all(|(a, b)| a.0 == b.0 && taps(a.1, b.1))
    }

    /// Whether the uniform rule for targets of the given parity is its own mirror image. Coordinates count
    /// outwards on both sides of a spoke, so that a rule which is not is another one on the other side, and
    /// no uniform rule across it.
    pub fn is_mirror_image(&self, to: Lattice) -> bool {
        let scale = self.scale();
        let taps = |x: i32| -> BTreeMap<i32, W> {
            let class = x.div_euclid(2).rem_euclid(scale) as usize;
            let taps = self.classes[class].iter();
            taps.map(|(offset, weight)| ((x + offset).div_euclid(scale), weight.clone()))
                .collect()
        };
        (0..scale).all(|class| {
            let x = 2 * class + to.parity();
            let (own, image) = (taps(x), taps(-x));
            let same = |(source, weight): (&i32, &W)| image.get(&-source).is_some_and(|other| weight.same(other));
            own.len() == image.len() && own.iter().all(same)
        })
    }

    /// Whether a point on the spoke is made alike from both sides of it.
    pub fn is_symmetric_on_spoke(&self) -> bool {
        let taps: BTreeMap<i32, W> = self.taps(0).collect();
        let symmetric = |(x, weight): (&i32, &W)| taps.get(&-x).is_some_and(|image| weight.same(image));
        taps.len() == self.taps(0).count() && taps.iter().all(symmetric)
    }
}

impl<S: Scalar> Line<S> {
    /// Points stay, edges get their midpoint: refinement of linear B-splines on a vertex net.
    pub fn midpoint() -> Self {
        let half = S::ratio(1, 2);
        Line::new(vec![vec![(0, S::one())], vec![(-2, half.clone()), (2, half)]])
    }

    /// Refinement of uniform cubic B-splines on a vertex net: (1, 6, 1)/8 and (1, 1)/2.
    pub fn cubic() -> Self {
        let (eighth, half) = (S::ratio(1, 8), S::ratio(1, 2));
        Line::new(vec![
            vec![(-4, eighth.clone()), (0, S::ratio(3, 4)), (4, eighth)],
            vec![(-2, half.clone()), (2, half)],
        ])
    }

    /// The mean of two neighbours: from a vertex net to the face net between, or back.
    pub fn average() -> Self {
        let half = S::ratio(1, 2);
        Line::new(vec![vec![(-1, half.clone()), (1, half)]])
    }

    /// Smoothing (1, 2u, 1) / (2 (1+u)) with tension `u`; `u = 1` averages twice. Fang, Ma and Wang,
    /// generalised tension scheme, even orders.
    pub fn smoothing(u: S) -> Self {
        let (one, two) = (S::one(), S::ratio(2, 1));
        let side = one.clone() / (two * (one.clone() + u.clone()));
        Line::new(vec![vec![(-2, side.clone()), (0, u.clone() / (one + u)), (2, side)]])
    }

    /// Corner cutting (1+2u, 1) / (2 (1+u)) with tension `u` on a face net; `u = 1` is Chaikin's rule. Fang,
    /// Ma and Wang, generalised tension scheme, order 3.
    pub fn corner_cutting(u: S) -> Self {
        let (one, two) = (S::one(), S::ratio(2, 1));
        let far = one.clone() / (two * (one.clone() + u));
        let near = one - far.clone();
        Line::new(vec![
            vec![(1, near.clone()), (-3, far.clone())],
            vec![(-1, near), (3, far)],
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Lattice::{Face, Vertex};

    #[test]
    fn rules_are_affine_and_connect_their_lattices() {
        let u = 0.3;
        for (line, from, to) in [
            (Line::midpoint(), Vertex, Vertex),
            (Line::cubic(), Vertex, Vertex),
            (Line::average(), Vertex, Face),
            (Line::average(), Face, Vertex),
            (Line::smoothing(u), Vertex, Vertex),
            (Line::smoothing(u), Face, Face),
            (Line::corner_cutting(u), Face, Face),
        ] {
            assert!(line.connects(from, to));
            for x in -4..5 {
                let x = 2 * x + to.parity();
                let taps: Vec<(i32, f64)> = line.taps(x).collect();
                assert!((taps.iter().map(|t| t.1).sum::<f64>() - 1.0).abs() < 1e-15);
                let mean: f64 = taps.iter().map(|&(source, w)| w * f64::from(source)).sum();
                // straight lines are reproduced at their own place by all rules but corner cutting off u = 1,
                // which moves the points of both classes by (1-u)/(1+u) half steps towards each other
                let shift = mean * f64::from(line.scale()) - f64::from(x);
                let expected = if line == Line::corner_cutting(u) {
                    let towards = if x.div_euclid(2).rem_euclid(2) == 0 { -1.0 } else { 1.0 };
                    towards * (1.0 - u) / (1.0 + u)
                } else {
                    0.0
                };
                assert!((shift - expected).abs() < 1e-14, "{x}: {shift}");
            }
        }
        assert!(!Line::<f64>::cubic().connects(Face, Face));
        assert!(!Line::<f64>::average().connects(Vertex, Vertex));
    }

    #[test]
    fn smoothing_twice_after_midpoints_is_cubic() {
        // Lane and Riesenfeld: midpoints and one smoothing with u = 1
        let (midpoint, smoothing, cubic) = (Line::<f64>::midpoint(), Line::smoothing(1.0), Line::<f64>::cubic());
        for x in [0, 2] {
            let mut composed = std::collections::BTreeMap::new();
            for (between, w) in smoothing.taps(x) {
                for (source, v) in midpoint.taps(between) {
                    *composed.entry(source).or_insert(0.0) += w * v;
                }
            }
            for (source, w) in cubic.taps(x) {
                assert_eq!(composed.remove(&source), Some(w));
            }
            assert!(composed.is_empty());
        }
    }
}
