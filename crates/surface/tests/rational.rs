//! Limits beside centres against refinement in whole numbers, which shares no code with the library: nothing
//! is rounded (Catmull-Clark), or after 150 digits (orders with a tension).
//!
//! The net around a vertex of valence N is kept on its lattice: `(k, x, y)`, x from 1, is x steps along spoke
//! k and y along the next one. A level halves the quads and moves each point to a mean of its neighbours'.

use crate::common::rules;
use eigenring_surface::{Mesh, Place, Point3, Surface, Vector3};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};
use std::collections::BTreeMap;

type Point = [BigInt; 3];
type At = (i64, i64, i64);

/// A net of so many rings around a vertex, with coordinates in units of `1 / scale`.
struct Net {
    n: i64,
    rings: i64,
    points: BTreeMap<At, Point>,
    scale: BigInt,
}

/// The name of a point of the sector k or beyond its first or second spoke.
fn folded(n: i64, (k, x, y): At) -> At {
    match (x, y) {
        (0, 0) => (0, 0, 0),
        (_, ..0) => folded(n, (k - 1, -y, x)),
        (..=0, _) => folded(n, (k + 1, y, -x)),
        _ => (k.rem_euclid(n), x, y),
    }
}

impl Net {
    /// Whole numbers, wavy enough to have no symmetry.
    fn new(n: i64, rings: i64) -> Net {
        let mut points = BTreeMap::new();
        let mut at = vec![(0, 0, 0)];
        at.extend((0..n).flat_map(|k| (1..=rings).flat_map(move |x| (0..=rings).map(move |y| (k, x, y)))));
        for (index, (k, x, y)) in at.into_iter().enumerate() {
            let turn = |k: i64| std::f64::consts::TAU * k as f64 / n as f64;
            let flat = [
                x as f64 * turn(k).cos() + y as f64 * turn(k + 1).cos(),
                x as f64 * turn(k).sin() + y as f64 * turn(k + 1).sin(),
            ];
            let wave = (1.3 * index as f64).sin();
            let height = 0.2 * flat[0] * flat[0] + 0.1 * flat[1] * flat[0] - 0.07 * flat[1] * flat[1] + 0.3 * wave;
            let [a, b] = flat;
            let whole = [a + 0.1 * wave, b, height].map(|c| BigInt::from((c * 1024.0).round() as i64));
            points.insert((k, x, y), whole);
        }
        Net {
            n,
            rings,
            points,
            scale: BigInt::from(1024),
        }
    }

    fn get(&self, at: At) -> &Point {
        &self.points[&folded(self.n, at)]
    }

    /// The mesh of the net; its first face has the vertex, spoke 0, and spoke 1 at its corners.
    fn mesh(&self) -> Mesh {
        let scale = self.scale.to_f64().unwrap();
        let coordinates = |p: &Point| Point3::from(p.clone().map(|c| c.to_f64().unwrap() / scale));
        let numbers: BTreeMap<At, u32> = self.points.keys().copied().zip(0..).collect();
        let at = |k, x, y| numbers[&folded(self.n, (k, x, y))];
        let cells = |k: i64| (0..self.rings).flat_map(move |y| (0..self.rings).map(move |x| (k, x, y)));
        let faces = (0..self.n).flat_map(cells);
        let faces = faces.map(|(k, x, y)| [at(k, x, y), at(k, x + 1, y), at(k, x + 1, y + 1), at(k, x, y + 1)]);
        Mesh::new(self.points.values().map(coordinates).collect(), faces).unwrap()
    }

    /// Quads halved, so many rings of them: 4 times the midpoints.
    fn halved(&self, rings: i64) -> Net {
        let point = |&(k, x, y): &At| -> Point {
            let (low, high) = (
                [x.div_euclid(2), y.div_euclid(2)],
                [(x + 1).div_euclid(2), (y + 1).div_euclid(2)],
            );
            let corners = [
                [low[0], low[1]],
                [high[0], low[1]],
                [low[0], high[1]],
                [high[0], high[1]],
            ];
            sum(corners.map(|[x, y]| (BigInt::from(1), self.get((k, x, y)))))
        };
        self.made(rings, 4, point)
    }

    /// Each point of so many rings moved: its own weight, of each edge neighbour, of each face neighbour, at
    /// the vertex and elsewhere, over a common denominator.
    fn smoothed(&self, rings: i64, weights: [[BigInt; 3]; 2], denominator: &BigInt) -> Net {
        let point = |&(k, x, y): &At| -> Point {
            let mut terms = Vec::new();
            if (x, y) == (0, 0) {
                let [own, edge, face] = &weights[0];
                terms.push((own.clone(), self.get((0, 0, 0))));
                for k in 0..self.n {
                    terms.push((edge.clone(), self.get((k, 1, 0))));
                    terms.push((face.clone(), self.get((k, 1, 1))));
                }
            } else {
                for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
                    let kind = (dx * dx + dy * dy) as usize;
                    terms.push((weights[1][kind].clone(), self.get((k, x + dx, y + dy))));
                }
            }
            sum(terms)
        };
        let mut net = self.made(rings, 1, point);
        net.scale *= denominator;
        net
    }

    fn made(&self, rings: i64, factor: i64, point: impl Fn(&At) -> Point) -> Net {
        let mut at = vec![(0, 0, 0)];
        at.extend((0..self.n).flat_map(|k| (1..=rings).flat_map(move |x| (0..=rings).map(move |y| (k, x, y)))));
        Net {
            n: self.n,
            rings,
            points: at.iter().map(|at| (*at, point(at))).collect(),
            scale: &self.scale * factor,
        }
    }

    /// The same with coordinates rounded to so many binary digits.
    fn rounded(mut self, bits: usize) -> Net {
        let unit = BigInt::from(1) << bits;
        for point in self.points.values_mut() {
            point.iter_mut().for_each(|c| *c = &*c * &unit / &self.scale);
        }
        self.scale = unit;
        self
    }

    /// One level of Catmull-Clark.
    fn catmull_clark(&self) -> Net {
        let n = self.n;
        // masks over 16 N^2: with halves and quarters put in for E and F, (N-3)/N V + 2/N^2 sum e + 1/N^2 sum
        // f
        let masks = [[16 * n * (n - 3), 32, 16], [4 * n * n, 2 * n * n, n * n]];
        let masks = masks.map(|mask| mask.map(BigInt::from));
        self.halved(self.rings + 1)
            .smoothed(self.rings, masks, &BigInt::from(16 * n * n))
    }

    /// One level of order 6 with a tension in units of `2^-bits`.
    fn order_six(&self, tension: &BigInt, bits: usize) -> Net {
        let (one, n) = (BigInt::from(1) << bits, BigInt::from(self.n));
        let u = tension;
        let square = (&one + u) * (&one + u);
        // over 4 N^2 (1+u)^2
        let centre = [
            ((&n - 4) * (&one + u * 2) * &one + &n * u * u) * &n * 4,
            u * &one * 32,
            &one * &one * 16,
        ];
        let side = &n * &n;
        let regular = [u * u * 4 * &side, u * &one * 2 * &side, &one * &one * &side];
        let first = self.halved(self.rings + 2);
        let first = first
            .smoothed(self.rings + 1, [centre, regular], &(square * 4 * &side))
            .rounded(bits);
        let masks = [
            [16 * self.n * (self.n - 3), 32, 16],
            [4, 2, 1].map(|w| w * self.n * self.n),
        ];
        let masks = masks.map(|mask| mask.map(BigInt::from));
        first.smoothed(self.rings, masks, &(side * 16)).rounded(bits)
    }

    /// Normal, Gauss and mean curvature at `(s, t)` of the spline of an order whose control points begin at
    /// `(x, y)` of sector 0, with weights for values, first and second derivatives.
    fn curvature(&self, corner: [i64; 2], [in_s, in_t]: [&[Vec<BigRational>; 3]; 2]) -> (Vector3<f64>, f64, f64) {
        let jet = |a: usize, b: usize| -> [BigRational; 3] {
            let mut total = [(); 3].map(|()| BigRational::zero());
            for (j, wt) in (0..).zip(&in_t[b]) {
                for (i, ws) in (0..).zip(&in_s[a]) {
                    let point = self.get((0, corner[0] + i, corner[1] + j));
                    for (total, c) in total.iter_mut().zip(point) {
                        *total += ws * wt * BigRational::new(c.clone(), self.scale.clone());
                    }
                }
            }
            total
        };
        let dot =
            |a: &[BigRational; 3], b: &[BigRational; 3]| -> BigRational { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let (xs, xt, xss, xst, xtt) = (jet(1, 0), jet(0, 1), jet(2, 0), jet(1, 1), jet(0, 2));
        let cross = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &xs[i] * &xt[j] - &xs[j] * &xt[i]);
        let (e, f, g) = (dot(&xs, &xs), dot(&xs, &xt), dot(&xt, &xt));
        let (l, m, n) = (dot(&cross, &xss), dot(&cross, &xst), dot(&cross, &xtt));
        let area = dot(&cross, &cross);
        let gauss = (&l * &n - &m * &m) / (&area * &area);
        let mean = (e * n - f * m * BigRational::from_integer(2.into()) + g * l) / &area;
        let mean_square = &mean * &mean / &area;
        let size = cross.iter().map(Signed::abs).max().unwrap();
        let normal = Vector3::from(cross.map(|c| (c / &size).to_f64().unwrap())).normalize();
        let sign = if mean.is_negative() { -0.5 } else { 0.5 };
        (
            normal,
            gauss.to_f64().unwrap(),
            sign * mean_square.to_f64().unwrap().sqrt(),
        )
    }
}

fn sum<'a>(terms: impl IntoIterator<Item = (BigInt, &'a Point)>) -> Point {
    let mut total = [(); 3].map(|()| BigInt::zero());
    for (weight, point) in terms {
        total.iter_mut().zip(point).for_each(|(total, c)| *total += &weight * c);
    }
    total
}

/// The B-splines of an order on one interval at `u`, with first and second derivatives, by the recursion of
/// Cox and de Boor on knots `-order+1, .., order`.
fn basis(order: usize, u: &BigRational) -> [Vec<BigRational>; 3] {
    let number = |k: usize| BigRational::from_integer(k.into());
    let value = |order: usize| -> Vec<BigRational> {
        let mut values = vec![number(1)];
        for k in 2..=order {
            // the i-th function of order k begins at the knot i-k+1
            let at = |i: usize| values.get(i).cloned().unwrap_or_else(BigRational::zero);
            let next = (0..k).map(|i| {
                let begins = if i > 0 { at(i - 1) } else { BigRational::zero() };
                let from_begin = u + number(k - 1) - number(i);
                let to_end = number(i + 1) - u;
                (from_begin * begins + to_end * at(i)) / number(k - 1)
            });
            values = next.collect();
        }
        values
    };
    let differences = |values: &[BigRational]| -> Vec<BigRational> {
        let at = |i: Option<usize>| i.and_then(|i| values.get(i)).cloned().unwrap_or_else(BigRational::zero);
        (0..=values.len()).map(|i| at(i.checked_sub(1)) - at(Some(i))).collect()
    };
    [
        value(order),
        differences(&value(order - 1)),
        differences(&differences(&value(order - 2))),
    ]
}

const S: f64 = 0.6875;
const T: f64 = 0.3125;

/// Compares the surface at `(S, T) 2^-depth` of the first face with the net after `finer` levels more: there
/// the place is in a regular quad.
fn agrees(label: &str, surface: &Surface<'_>, depth: i32, net: &Net, order: i64, finer: u32) {
    let small = 2_f64.powi(-depth);
    let found = surface
        .at(Place {
            face: 0,
            sub: 0,
            corner: 0,
            s: S * small,
            t: T * small,
        })
        .unwrap();
    let within = |x: f64| {
        let x = BigRational::from_float(x * 2_f64.powi(finer as i32)).unwrap();
        let quad = x.to_integer();
        (quad.to_i64().unwrap(), x - BigRational::from_integer(quad))
    };
    let ((x, s), (y, t)) = (within(S), within(T));
    let bases = [basis(order as usize, &s), basis(order as usize, &t)];
    let first = order / 2 - 1;
    let (normal, gauss, mean) = net.curvature([x - first, y - first], [&bases[0], &bases[1]]);
    let turned = (found.normal.unwrap() - normal).norm();
    let off = [found.gauss.unwrap() / gauss - 1.0, found.mean.unwrap() / mean - 1.0].map(f64::abs);
    assert!(turned < 1e-13, "{label}, depth {depth}: normal {turned:e}");
    assert!(off[0] < 1e-11 && off[1] < 1e-11, "{label}, depth {depth}: K, H {off:?}");
}

#[test]
fn catmull_clark_in_whole_numbers() {
    let rules = rules("catmull-clark");
    for n in [3, 5, 6] {
        let mut net = Net::new(n, 3);
        let control = net.mesh();
        let surface = Surface::new(&control, &rules).unwrap();
        for depth in 0..=60 {
            net = net.catmull_clark();
            if [0, 1, 7, 20, 40, 60].contains(&depth) {
                agrees(&format!("N = {n}"), &surface, depth, &net, 4, 1);
            }
        }
    }
}

#[test]
fn order_six_with_a_tension_in_150_digits() {
    const BITS: usize = 500;
    let rules = rules("tension:order=6,u0=0.3");
    let mut net = Net::new(5, 5);
    let control = net.mesh();
    let surface = Surface::new(&control, &rules).unwrap();
    let one = BigInt::from(1) << BITS;
    let exact = BigRational::from_float(0.3).unwrap();
    let mut u = exact.numer() * &one / exact.denom();
    for level in 0..=41 {
        net = net.order_six(&u, BITS);
        // u' = sqrt((1+u)/2)
        u = (((&one + u) << (BITS - 1)) as BigInt).sqrt();
        // by then the tension differs from 1 by 1e-25, and its functions from B-splines likewise
        if level == 41 {
            agrees("order 6", &surface, level - 1, &net, 6, 2);
        }
    }
}
