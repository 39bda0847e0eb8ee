//! The maps of the lambda-scheme at the Gauss points of the regular annulus, over intervals.
//!
//! At fixed (N, lambda, s) no tuned weight acts beyond the first ring, so each map is a combination of fields
//! that start from one point of it. With `R` the corner radius,
//!
//! ```text
//! zeta = x + i y = X0 + R X1                      Fourier block 1, eigenvalue lambda
//! u              = z0 Z0 + z1 Z1                  Fourier block 2, eigenvalue mu; saddles Re u, Im u
//! cup            = V C0 + E C1 + F C2             Fourier block 0, eigenvalue mu
//! ```
//!
//! where X0, Z0, C1 start from the edge points, X1, Z1, C2 from the face points, and C0 from the centre.
//! Coordinates are turned so that the bisector of sector 0 is the x axis. Mirroring at it conjugates every
//! field, so that half a sector carries the whole integral.

use crate::Interval;
use eigenring_spline::{Complex, Scalar};

type Number = Complex<Interval>;

/// Derivatives u, v, uu, uv, vv in the parameters of a patch.
pub(super) type Jet<T> = [T; 5];

/// The rings carried: the patches of the annulus reach to the fifth.
const RINGS: usize = 5;

/// The sites of ring 2 that belong to one sector.
const SECOND: [(i32, i32); 4] = [(2, 0), (2, 1), (2, 2), (1, 2)];

/// All fields at one Gauss point.
pub(super) struct Point {
    /// The weight of the quadrature, halved on the mirror.
    pub weight: Interval,
    /// X0, X1.
    pub plane: [Jet<Number>; 2],
    /// Z0, Z1.
    pub saddle: [Jet<Number>; 2],
    /// C0, C1, C2.
    pub cup: [Jet<Interval>; 3],
}

/// The fields of one (N, lambda, s).
pub(super) struct Fields {
    pub points: Vec<Point>,
    /// Inner products over all points of the five rings: of X0 and X1, of Z0 and Z1, of C0, C1 and C2.
    pub plane: [[Interval; 2]; 2],
    pub saddle: [[Interval; 2]; 2],
    pub cup: [[Interval; 3]; 3],
}

impl Fields {
    /// Valence from 5 on; neither lambda nor mu may be an eigenvalue of the regular rings.
    pub fn new(valence: usize, lambda: Interval, mu: Interval) -> Self {
        let grow = |k: i64, eigenvalue: Interval, start: usize| Mode::grow(valence as i64, k, eigenvalue, start);
        let plane = [grow(1, lambda, 1), grow(1, lambda, 2)];
        let saddle = [grow(2, mu, 1), grow(2, mu, 2)];
        let cup = [grow(0, mu, 0), grow(0, mu, 1), grow(0, mu, 2)];
        let half = Interval::integer(valence as i64) * Interval::ratio(1, 2);
        // sectors carry Re (e^{ik phi} v), whose squares sum to half of |v|^2; those of block 0 are real
        let product = |a: &Mode, b: &Mode| half * a.product(b);
        let whole = |a: &Mode, b: &Mode| a.centre * b.centre + product(a, b) + product(a, b);
        Fields {
            points: points(&plane, &saddle, &cup),
            plane: gram(&plane, product),
            saddle: gram(&saddle, product),
            cup: gram(&cup, whole),
        }
    }
}

fn gram<const C: usize>(modes: &[Mode; C], product: impl Fn(&Mode, &Mode) -> Interval) -> [[Interval; C]; C] {
    std::array::from_fn(|i| std::array::from_fn(|j| product(&modes[i], &modes[j])))
}

/// An eigenvector of one Fourier block, on the points `P(a, b)`, `1 <= a <= 5`, `0 <= b <= 5`, of sector 0.
struct Mode {
    centre: Interval,
    values: [[Number; RINGS + 1]; RINGS + 1],
    /// `exp(2 pi i k/N)`, by which the next sector's values differ.
    phase: Number,
}

impl Mode {
    /// The eigenvector whose first ring is 1 on the centre (`start` 0), on the edge points (1), or on the
    /// face points (2).
    fn grow(valence: i64, k: i64, eigenvalue: Interval, start: usize) -> Self {
        let mut mode = Mode::blank(valence, k);
        match start {
            0 => mode.centre = Interval::one(),
            // the edge point is half a sector before the bisector
            1 => mode.values[1][0] = Number::turn(-k, 2 * valence),
            _ => mode.values[1][1] = Number::one(),
        }
        // eigenvalue v = A v + (what the first ring contributes), with v the second ring
        let mut system: [[Number; 5]; 4] = std::array::from_fn(|row| {
            let mut equation = [Number::zero(); 5];
            for (column, &(a, b)) in SECOND.iter().enumerate() {
                let mut unit = Mode::blank(valence, k);
                unit.values[a as usize][b as usize] = Number::one();
                equation[column] = -unit.refined(SECOND[row]);
            }
            equation[row] += Number::real(eigenvalue);
            equation[4] = mode.refined(SECOND[row]);
            equation
        });
        for (value, (a, b)) in solve(&mut system).into_iter().zip(SECOND) {
            mode.values[a as usize][b as usize] = value;
        }
        for ring in 3..=RINGS as i32 {
            let sites = (0..=ring).map(|b| (ring, b)).chain((1..ring).map(|a| (a, ring)));
            for (a, b) in sites {
                let value = mode.refined((a, b));
                mode.values[a as usize][b as usize] = value.map(|part| part / eigenvalue);
            }
        }
        mode
    }

    fn blank(valence: i64, k: i64) -> Self {
        Mode {
            centre: Interval::zero(),
            values: [[Number::zero(); RINGS + 1]; RINGS + 1],
            phase: Number::turn(k, valence),
        }
    }

    /// The value at `P(a, b)`, where one of the two may be negative: the rotation rules of the numbering.
    fn at(&self, a: i32, b: i32) -> Number {
        match (a, b) {
            (0, 0) => Number::real(self.centre),
            (1.., 0..) => self.values[a as usize][b as usize],
            (0.., ..0) => self.phase.conj() * self.values[-b as usize][a as usize],
            _ => self.phase * self.values[b as usize][-a as usize],
        }
    }

    /// The bicubic refinement at the fine point (a, b), which lies at (a/2, b/2).
    fn refined(&self, (a, b): (i32, i32)) -> Number {
        let mut sum = Number::zero();
        for (i, weight) in line(a) {
            for (j, other) in line(b) {
                sum += self.at(i, j).scale(weight * other);
            }
        }
        sum
    }

    /// `Re sum v conj(w)` over the points of one sector.
    fn product(&self, other: &Self) -> Interval {
        let sites = (1..=RINGS).flat_map(|a| (0..=RINGS).map(move |b| (a, b)));
        sites.map(|(a, b)| self.values[a][b].dot(other.values[a][b])).sum()
    }
}

/// The uniform cubic rule at a fine index.
fn line(fine: i32) -> Vec<(i32, Interval)> {
    let (m, eighths) = (fine.div_euclid(2), |p| Interval::ratio(p, 8));
    match fine.rem_euclid(2) {
        0 => vec![(m - 1, eighths(1)), (m, eighths(6)), (m + 1, eighths(1))],
        _ => vec![(m, eighths(4)), (m + 1, eighths(4))],
    }
}

/// Gaussian elimination, by the pivots that are certainly largest at their centres.
fn solve(system: &mut [[Number; 5]; 4]) -> [Number; 4] {
    let size = |z: &Number| z.re.mid().hypot(z.im.mid());
    for column in 0..4 {
        let pivot = (column..4).max_by(|&a, &b| size(&system[a][column]).total_cmp(&size(&system[b][column])));
        system.swap(column, pivot.unwrap_or(column));
        let head = system[column];
        for equation in &mut system[column + 1..] {
            let factor = equation[column] / head[column];
            for (entry, above) in equation.iter_mut().zip(head).skip(column) {
                *entry = *entry - factor * above;
            }
        }
    }
    let mut x = [Number::zero(); 4];
    for row in (0..4).rev() {
        let known = (row + 1..4).fold(system[row][4], |sum, column| sum - system[row][column] * x[column]);
        x[row] = known / system[row][row];
    }
    x
}

/// The patches below the diagonal of sector 0; the diagonal passes through the last two.
const PATCHES: [(i32, i32); 7] = [(2, 0), (2, 1), (3, 0), (3, 1), (3, 2), (2, 2), (3, 3)];

fn points(plane: &[Mode; 2], saddle: &[Mode; 2], cup: &[Mode; 3]) -> Vec<Point> {
    let rule = gauss();
    let mut points = Vec::new();
    for (p, q) in PATCHES {
        for (i, &(u, weight_u)) in rule.iter().enumerate() {
            let below = if p == q { i + 1 } else { rule.len() };
            for (j, &(v, weight_v)) in rule.iter().enumerate().take(below) {
                let fold = if p == q && i == j {
                    Interval::ratio(1, 2)
                } else {
                    Interval::one()
                };
                let (along, across) = (basis(u), basis(v));
                let jet = |mode: &Mode| -> Jet<Number> {
                    [(1, 0), (0, 1), (2, 0), (1, 1), (0, 2)].map(|(du, dv)| {
                        let mut sum = Number::zero();
                        for (a, &f) in (p - 1..).zip(&along[du]) {
                            for (b, &g) in (q - 1..).zip(&across[dv]) {
                                sum += mode.at(a, b).scale(f * g);
                            }
                        }
                        sum
                    })
                };
                points.push(Point {
                    weight: fold * weight_u * weight_v,
                    plane: [jet(&plane[0]), jet(&plane[1])],
                    saddle: [jet(&saddle[0]), jet(&saddle[1])],
                    cup: std::array::from_fn(|c| jet(&cup[c]).map(|value| value.re)),
                });
            }
        }
    }
    points
}

/// The four uniform cubic B-splines on [0, 1] with first and second derivatives.
fn basis(t: Interval) -> [[Interval; 4]; 3] {
    let (one, ratio) = (Interval::one(), Interval::ratio);
    let r = one - t;
    let inner = |t: Interval| ratio(2, 3) - t.square() + t * t.square() * ratio(1, 2);
    let slope = |t: Interval| t * (t * ratio(3, 2) - ratio(2, 1));
    [
        [
            r * r.square() * ratio(1, 6),
            inner(t),
            inner(r),
            t * t.square() * ratio(1, 6),
        ],
        [
            -(r.square() * ratio(1, 2)),
            slope(t),
            -slope(r),
            t.square() * ratio(1, 2),
        ],
        [r, ratio(3, 1) * t - ratio(2, 1), ratio(3, 1) * r - ratio(2, 1), t],
    ]
}

/// Nodes and weights of Gauss and Legendre's rule with five points on [0, 1], from their closed forms: zeros
/// of `63 x^5 - 70 x^3 + 15 x`.
fn gauss() -> [(Interval, Interval); 5] {
    let (ratio, half) = (Interval::ratio, Interval::ratio(1, 2));
    let root = ratio(2, 1) * ratio(10, 7).sqrt();
    let [inner, outer] = [-root, root].map(|root| (ratio(5, 1) + root).sqrt() * ratio(1, 3));
    let seventy = ratio(13, 1) * ratio(70, 1).sqrt();
    let [light, heavy] = [-seventy, seventy].map(|term| (ratio(322, 1) + term) * ratio(1, 900));
    let node = |at: Interval, weight: Interval| ((Interval::one() + at) * half, weight * half);
    [
        node(-outer, light),
        node(-inner, heavy),
        node(Interval::zero(), ratio(128, 225)),
        node(inner, heavy),
        node(outer, light),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_integrates_up_to_degree_nine() {
        for degree in 0..=9 {
            let sum: Interval = gauss().iter().map(|&(at, weight)| weight * at.powi(degree)).sum();
            let exact = Interval::ratio(1, i64::from(degree) + 1);
            assert!(
                sum.intersect(exact).is_some() && sum.width() < 1e-14,
                "{degree} {sum:?}"
            );
        }
        let sum: Interval = gauss().iter().map(|&(at, weight)| weight * at.powi(10)).sum();
        assert!(sum.disjoint(Interval::ratio(1, 11)));
    }

    #[test]
    fn quadratics_are_reproduced_at_valence_four() {
        // refinement of bicubic splines: P(a,b) = a + i b of block 1, halved
        let half = Interval::ratio(1, 2);
        let [edge, face] = [1, 2].map(|start| Mode::grow(4, 1, half, start));
        let corner = Number::turn(-1, 8);
        for (a, b) in [(2, 0), (5, 3), (1, 4)] {
            // F = 1 + i is, in the frame of the bisector, sqrt 2
            let value = edge.at(a, b) + face.at(a, b).scale(Interval::ratio(2, 1).sqrt());
            let exact = corner * Number::new(Interval::integer(i64::from(a)), Interval::integer(i64::from(b)));
            for difference in [value.re - exact.re, value.im - exact.im] {
                assert!(difference.contains_zero() && difference.width() < 1e-12);
            }
        }
    }
}
