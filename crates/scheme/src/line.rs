//! Rules for regular points: one dimension, to be used in both.

use crate::{Lattice, Scalar};

/// A rule of univariate subdivision or smoothing. The regular points of a [`Pass`](crate::Pass) use its tensor product.
///
/// All positions are in half steps. A target point `X` belongs to the class `floor(X/2) mod scale`; a tap `(offset, w)` of
/// its class reads the source point `(X + offset) / scale` with weight `w`.
#[derive(Clone, Debug, PartialEq)]
pub struct Line<S> {
    classes: Vec<Vec<(i32, S)>>,
}

impl<S: Scalar> Line<S> {
    /// A rule with one list of taps per class; as many classes as the target is finer than the source.
    pub fn new(classes: Vec<Vec<(i32, S)>>) -> Self {
        debug_assert!(!classes.is_empty(), "a rule has at least one class");
        Line { classes }
    }

    /// Target points per source point: 1 for smoothing, 2 for refinement.
    pub fn scale(&self) -> i32 {
        self.classes.len() as i32
    }

    /// The taps of each class.
    pub fn classes(&self) -> &[Vec<(i32, S)>] {
        &self.classes
    }

    /// The sources and weights of the target point `x`.
    pub fn taps(&self, x: i32) -> impl Iterator<Item = (i32, S)> + '_ {
        let scale = self.scale();
        let class = x.div_euclid(2).rem_euclid(scale);
        self.classes[class as usize]
            .iter()
            .map(move |&(offset, weight)| ((x + offset).div_euclid(scale), weight))
    }

    /// Whether every tap of every class leads from a point of `to` to a point of `from`.
    pub fn connects(&self, from: Lattice, to: Lattice) -> bool {
        let scale = self.scale();
        (0..scale).all(|class| {
            let x = 2 * class + to.parity();
            self.classes[class as usize].iter().all(|&(offset, _)| {
                (x + offset).rem_euclid(scale) == 0 && ((x + offset) / scale - from.parity()).rem_euclid(2) == 0
            })
        })
    }

    /// Points stay, edges get their midpoint: refinement of linear B-splines on a vertex net.
    pub fn midpoint() -> Self {
        let half = S::ratio(1, 2);
        Line::new(vec![vec![(0, S::one())], vec![(-2, half), (2, half)]])
    }

    /// Refinement of uniform cubic B-splines on a vertex net: (1, 6, 1)/8 and (1, 1)/2.
    pub fn cubic() -> Self {
        let (eighth, half) = (S::ratio(1, 8), S::ratio(1, 2));
        Line::new(vec![
            vec![(-4, eighth), (0, S::ratio(3, 4)), (4, eighth)],
            vec![(-2, half), (2, half)],
        ])
    }

    /// The mean of two neighbours: from a vertex net to the face net between, or back.
    pub fn average() -> Self {
        let half = S::ratio(1, 2);
        Line::new(vec![vec![(-1, half), (1, half)]])
    }

    /// Smoothing (1, 2u, 1) / (2 (1+u)) with tension `u`; `u = 1` averages twice. Fang, Ma and Wang, generalised tension
    /// scheme, even orders.
    pub fn smoothing(u: S) -> Self {
        let (one, two) = (S::one(), S::ratio(2, 1));
        let side = one / (two * (one + u));
        Line::new(vec![vec![(-2, side), (0, u / (one + u)), (2, side)]])
    }

    /// Corner cutting (1+2u, 1) / (2 (1+u)) with tension `u` on a face net; `u = 1` is Chaikin's rule. Fang, Ma and Wang,
    /// generalised tension scheme, order 3.
    pub fn corner_cutting(u: S) -> Self {
        let (one, two) = (S::one(), S::ratio(2, 1));
        let far = one / (two * (one + u));
        let near = one - far;
        Line::new(vec![vec![(1, near), (-3, far)], vec![(-1, near), (3, far)]])
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
                // every rule here reproduces straight lines: the taps' mean is the place itself
                let mean: f64 = taps.iter().map(|&(source, w)| w * f64::from(source)).sum();
                assert!((mean * f64::from(line.scale()) - f64::from(x)).abs() < 1e-14 || line.scale() == 2);
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
