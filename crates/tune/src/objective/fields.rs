//! The eleven fields of which the maps are made, with their derivatives at the Gauss points.
//!
//! At fixed valence, lambda and s no free weight acts beyond the first ring, so the maps are linear in a few
//! numbers:
//!
//! ```text
//! x + i y = X0 + R X1                       R = 2 f2 cos(pi/N) / (lambda - f3), the corner radius
//! saddles = Z = (mu - f3) Z0 + 2 f2 cos(2 pi/N) Z1
//! cup     = V C0 + E C1 + F C2              (V, E, F) the first ring of the eigenvector of block 0
//! ```
//!
//! `X0`, `Z0` start from the edge points 1, 0 ..., `X1`, `Z1` from the face points; X0, X1, Z0, Z1 are
//! complex, which makes eleven real fields. At N = 4 block 2 is diagonal and `Z = Z0 + Z1` carries its two
//! modes as real and imaginary part.
//!
//! **Frame.** Coordinates are turned so that the bisector of sector 0 is the x axis: then mirroring sector 0
//! at its bisector conjugates every mode, and half a sector suffices. Sector i is the image under the turn by
//! `phi_i = (2i+1) pi/N`, where the modes are `exp(i phi) (x + i y)` and `exp(2 i phi) Z`.
//!
//! **Domain.** The patches `[p,p+1] x [q,q+1]` with max(p,q) = 2 or 3 form the annulus Omega_0; they are the
//! innermost ones that are regular bicubic and whose images under lambda^m tile the rest. Of each mirrored
//! pair of points only the one below the diagonal is kept; weights are halved on the diagonal, so that they
//! sum to 6, half a sector's area in parameters.

use super::lanes::{Lanes, WIDTH};
use super::rings::{FirstRing, Rings, to_bisector};
use eigenring_scheme::lambda::Plane;
use eigenring_spline::quadrature::gauss_legendre;
use eigenring_spline::{Complex, Scalar};

/// Derivatives of a field with respect to the patch parameters: u, v, uu, uv, vv.
pub(super) type Derivatives = [Lanes; 5];

/// [`WIDTH`] Gauss points: quadrature weights and the fields' derivatives. Complex fields are [real part,
/// imaginary part].
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub weight: Lanes,
    pub x0: [Derivatives; 2],
    pub x1: [Derivatives; 2],
    pub z0: [Derivatives; 2],
    pub z1: [Derivatives; 2],
    pub cup: [Derivatives; 3],
}

/// The fields of one (valence, lambda, s).
#[derive(Clone, Debug)]
pub(super) struct Fields {
    /// The points of half a sector; the last block is filled up with points of weight zero.
    pub blocks: Vec<Block>,
    /// Eigenvectors in the order X0, X1.
    pub x: [Rings; 2],
    /// Eigenvectors in the order Z0, Z1.
    pub z: [Rings; 2],
    /// Eigenvectors in the order C0, C1, C2.
    pub cup: [Rings; 3],
}

/// Patches with points below the diagonal; on the last two the diagonal passes through.
const PATCHES: [(usize, usize); 7] = [(2, 0), (2, 1), (3, 0), (3, 1), (3, 2), (2, 2), (3, 3)];

/// A field on the lattice points (a, b), a, b = -1..5, of which only the part next to the patches above is
/// used.
type Grid = [[f64; 7]; 7];

impl Fields {
    pub fn new(plane: &Plane<f64>, order: usize) -> Fields {
        let grow = |k: i64, eigenvalue: f64, vertex: f64, edge: f64, face: f64| {
            let real = |value: f64| Complex::new(value, 0.0);
            let first = FirstRing {
                vertex: real(vertex),
                edge: to_bisector(plane.valence, k).scale(edge),
                face: real(face),
            };
            Rings::grow(plane.valence, k, eigenvalue, first)
        };
        let (lambda, mu) = (plane.lambda, plane.mu());
        let x = [grow(1, lambda, 0.0, 1.0, 0.0), grow(1, lambda, 0.0, 0.0, 1.0)];
        let z = [grow(2, mu, 0.0, 1.0, 0.0), grow(2, mu, 0.0, 0.0, 1.0)];
        let cup = [
            grow(0, mu, 1.0, 0.0, 0.0),
            grow(0, mu, 0.0, 1.0, 0.0),
            grow(0, mu, 0.0, 0.0, 1.0),
        ];
        Fields {
            blocks: tabulate(&x, &z, &cup, order),
            x,
            z,
            cup,
        }
    }
}

/// Evaluates all fields at all points of half a sector.
fn tabulate(x: &[Rings; 2], z: &[Rings; 2], cup: &[Rings; 3], order: usize) -> Vec<Block> {
    let mut grids = Vec::with_capacity(11);
    for rings in x.iter().chain(z) {
        let [re, im] = grid(rings);
        grids.extend([re, im]);
    }
    grids.extend(cup.iter().map(|rings| grid(rings)[0]));

    let nodes = gauss_legendre(order);
    let basis: Vec<[[f64; 4]; 3]> = nodes.iter().map(|node| cubic(node.at)).collect();
    let zero = [Lanes::ZERO; 5];
    let empty = Block {
        weight: Lanes::ZERO,
        x0: [zero; 2],
        x1: [zero; 2],
        z0: [zero; 2],
        z1: [zero; 2],
        cup: [zero; 3],
    };
    let count = 5 * order * order + order * (order + 1);
    let mut blocks = vec![empty; count.div_ceil(WIDTH)];
    let mut index = 0;
    let mut last = [[0.0; 5]; 11];
    for (p, q) in PATCHES {
        for i in 0..order {
            // per field: the rows b contracted along a with the basis and its two derivatives
            let rows: [[[f64; 4]; 3]; 11] = std::array::from_fn(|f| contract(&grids[f], p, q, &basis[i]));
            let below = if p == q { i + 1 } else { order };
            for j in 0..below {
                let fold = if p == q && i == j { 0.5 } else { 1.0 };
                last = std::array::from_fn(|f| {
                    let dot = |du: usize, dv: usize| -> f64 {
                        let (row, b) = (&rows[f][du], &basis[j][dv]);
                        row[0] * b[0] + row[1] * b[1] + row[2] * b[2] + row[3] * b[3]
                    };
                    [dot(1, 0), dot(0, 1), dot(2, 0), dot(1, 1), dot(0, 2)]
                });
                blocks[index / WIDTH].put(index % WIDTH, fold * nodes[i].weight * nodes[j].weight, &last);
                index += 1;
            }
        }
    }
    // a repeated point keeps the unused lanes free of divisions by zero
    for lane in index..blocks.len() * WIDTH {
        blocks[lane / WIDTH].put(lane % WIDTH, 0.0, &last);
    }
    blocks
}

impl Block {
    fn put(&mut self, lane: usize, weight: f64, derivatives: &[[f64; 5]; 11]) {
        self.weight.0[lane] = weight;
        let fields = (self.x0.iter_mut())
            .chain(&mut self.x1)
            .chain(&mut self.z0)
            .chain(&mut self.z1)
            .chain(&mut self.cup);
        for (field, values) in fields.zip(derivatives) {
            for (target, &value) in field.iter_mut().zip(values) {
                target.0[lane] = value;
            }
        }
    }
}

/// Real and imaginary part of a mode on the lattice around the patches.
fn grid(rings: &Rings) -> [Grid; 2] {
    let mut grids = [[[0.0; 7]; 7]; 2];
    // the patches lie at a >= 2, b >= 0
    for a in 1..=5 {
        for b in -1..=5 {
            let value = rings.at(a, b);
            grids[0][(a + 1) as usize][(b + 1) as usize] = value.re;
            grids[1][(a + 1) as usize][(b + 1) as usize] = value.im;
        }
    }
    grids
}

/// For each derivative order in u, the four rows of patch (p, q) contracted with the basis.
fn contract(grid: &Grid, p: usize, q: usize, basis: &[[f64; 4]; 3]) -> [[f64; 4]; 3] {
    let mut rows = [[0.0; 4]; 3];
    for (row, weights) in rows.iter_mut().zip(basis) {
        for (i, &weight) in weights.iter().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry += weight * grid[p + i][q + j];
            }
        }
    }
    rows
}

/// The four uniform cubic B-splines on a unit interval at `t`, and their first and second derivatives, as
/// polynomials: the tabulated optima were found with the roundings of these.
fn cubic(t: f64) -> [[f64; 4]; 3] {
    let r = 1.0 - t;
    [
        [
            r * r * r / 6.0,
            (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
            (4.0 - 6.0 * r * r + 3.0 * r * r * r) / 6.0,
            t * t * t / 6.0,
        ],
        [
            -r * r / 2.0,
            (3.0 * t - 4.0) * t / 2.0,
            (4.0 - 3.0 * r) * r / 2.0,
            t * t / 2.0,
        ],
        [r, 3.0 * t - 2.0, 1.0 - 3.0 * t, t],
    ]
}

/// A class of sectors by `t = exp(4 i phi)`: t and its square.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    pub t: Complex<f64>,
    pub square: Complex<f64>,
}

/// The `N / gcd(N, 4)` classes of sectors that differ in `t`, all of the same size. Sectors come in mirrored
/// pairs, so the classes are real or conjugate in pairs, of which the one with the positive imaginary part is
/// listed.
#[derive(Clone, Debug)]
pub(super) struct Turns {
    /// t = 1 or t = -1.
    pub real: Vec<Turn>,
    /// One of each pair.
    pub pairs: Vec<Turn>,
}

impl Turns {
    pub fn new(valence: usize) -> Turns {
        let n = valence as i64;
        let classes = match valence % 4 {
            0 => n / 4,
            2 => n / 2,
            _ => n,
        };
        let (mut real, mut pairs) = (Vec::new(), Vec::new());
        // t = exp(2 pi i k / N); exact comparisons in integers
        for k in (0..classes).map(|i| (2 * (2 * i + 1)) % n) {
            let turn = Turn {
                t: Complex::turn(k, n),
                square: Complex::turn(2 * k, n),
            };
            if 2 * k % n == 0 {
                real.push(turn);
            } else if 2 * k < n {
                pairs.push(turn);
            }
        }
        Turns { real, pairs }
    }

    /// The number of classes.
    pub fn count(&self) -> usize {
        self.real.len() + 2 * self.pairs.len()
    }
}

/// The mean of `exp(4 i phi)` over all sectors: zero unless N divides 4.
pub(super) fn mean_turn(valence: usize) -> f64 {
    if valence == 4 { f64::cos_turn(1, 2) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_of_sectors_have_the_moments_of_all_sectors() {
        for valence in 3..=64_usize {
            let turns = Turns::new(valence);
            assert_eq!(turns.count() * [4, 1, 2, 1][valence % 4], valence);
            for power in 1..=3 {
                let angle = |i: usize| 4.0 * power as f64 * (2 * i + 1) as f64 * std::f64::consts::PI / valence as f64;
                let mean = (0..valence).map(|i| angle(i).cos()).sum::<f64>() / valence as f64;
                let of = |turn: &Turn| match power {
                    1 => turn.t.re,
                    2 => turn.square.re,
                    _ => (turn.t * turn.square).re,
                };
                let sum = turns.real.iter().map(of).sum::<f64>() + 2.0 * turns.pairs.iter().map(of).sum::<f64>();
                assert!((sum / turns.count() as f64 - mean).abs() < 1e-13);
                if power == 1 {
                    assert!((mean_turn(valence) - mean).abs() < 1e-13);
                }
            }
        }
    }
}
