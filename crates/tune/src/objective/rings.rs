//! Eigenvectors of the local matrix, continued outwards from the first ring.
//!
//! The points of a Fourier mode are `P_i(a,b) = v(a,b) w^{k i}` with `w = exp(2 pi i/N)`, where P_i(a,b),
//! a >= 1, b >= 0, sits `a` steps along spoke `i` and `b` steps along spoke `i+1`. Points of ring >= 2 are
//! refined by the uniform bicubic rule, so once the first ring and the eigenvalue are given, ring 2 follows
//! from a 4x4 system (whose matrix has the eigenvalues 1/8, 1/16, 1/32, 1/64 in every mode) and rings 3 to 5
//! explicitly. No tuned weight acts beyond the first ring: at a fixed eigenvalue the outer rings depend
//! linearly on the first.

use eigenring_spline::{Complex, Scalar};

/// The rings carried: patches of the third and fourth layer need five.
const RINGS: usize = 5;

/// The sites of ring 2 that belong to one sector.
const SECOND: [(usize, usize); 4] = [(2, 0), (2, 1), (2, 2), (1, 2)];

/// Values of the centre (mode 0 only) and of the first ring's edge and face points in sector 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct FirstRing {
    pub vertex: Complex<f64>,
    pub edge: Complex<f64>,
    pub face: Complex<f64>,
}

/// A mode on sector 0: `v(a,b)` for `1 <= a <= 5`, `0 <= b <= 5`, the centre and the phase `w^k` of one
/// sector.
#[derive(Clone, Debug)]
pub(super) struct Rings {
    vertex: Complex<f64>,
    values: [[Complex<f64>; RINGS + 1]; RINGS + 1],
    phase: Complex<f64>,
}

impl Rings {
    /// The eigenvector of mode `k` with the given eigenvalue and first ring. The eigenvalue must not be one
    /// of ring 2's own, which the caller has checked.
    pub fn grow(valence: usize, k: i64, eigenvalue: f64, first: FirstRing) -> Rings {
        let mut rings = Rings {
            vertex: first.vertex,
            values: [[Complex::zero(); RINGS + 1]; RINGS + 1],
            phase: Complex::turn(k, valence as i64),
        };
        let blank = Rings {
            vertex: Complex::zero(),
            ..rings.clone()
        };
        rings.values[1][0] = first.edge;
        rings.values[1][1] = first.face;

        // eigenvalue * second = A second + (contribution of the first ring)
        let mut system = [[Complex::zero(); 5]; 4];
        for (column, &(a, b)) in SECOND.iter().enumerate() {
            let mut unit = blank.clone();
            unit.values[a][b] = Complex::new(1.0, 0.0);
            for (row, &site) in SECOND.iter().enumerate() {
                system[row][column] = -unit.refined(site);
            }
            system[column][column] += Complex::new(eigenvalue, 0.0);
        }
        for (row, &site) in SECOND.iter().enumerate() {
            system[row][4] = rings.refined(site);
        }
        for (value, &(a, b)) in solve(system).into_iter().zip(&SECOND) {
            rings.values[a][b] = value;
        }
        for ring in 3..=RINGS {
            for (a, b) in sites(ring) {
                rings.values[a][b] = rings.refined((a, b)).scale(1.0 / eigenvalue);
            }
        }
        rings
    }

    /// The value at `a` steps along spoke 0 and `b` steps along spoke 1; one of the two may be negative.
    pub fn at(&self, a: i32, b: i32) -> Complex<f64> {
        let v = |a: i32, b: i32| self.values[a as usize][b as usize];
        match (a, b) {
            (0, 0) => self.vertex,
            (1.., 0..) => v(a, b),
            (0.., ..0) => self.phase.conj() * v(-b, a),
            _ => self.phase * v(b, -a),
        }
    }

    /// `sum conj(v) u` and `sum v u` (real parts) over the sites of one sector, without the centre.
    pub fn products(&self, other: &Rings) -> (f64, f64) {
        let mut sums = (0.0, 0.0);
        for (a, b) in (1..=RINGS).flat_map(sites) {
            let (v, u) = (self.values[a][b], other.values[a][b]);
            sums.0 += v.dot(u);
            sums.1 += v.real_of_product(u);
        }
        sums
    }

    /// One step of uniform bicubic refinement, read at the fine site (A, B), which sits at the coarse (A/2,
    /// B/2).
    fn refined(&self, (a, b): (usize, usize)) -> Complex<f64> {
        let mut sum = Complex::zero();
        for &(i, weight_a) in line(a).iter() {
            for &(j, weight_b) in line(b).iter() {
                sum += self.at(i, j).scale(weight_a * weight_b);
            }
        }
        sum
    }
}

/// The cubic curve rule at a fine index: (1, 6, 1)/8 for an even one, (1, 1)/2 for an odd one (its third
/// entry is void).
fn line(fine: usize) -> [(i32, f64); 3] {
    let m = (fine / 2) as i32;
    if fine.is_multiple_of(2) {
        [(m - 1, 0.125), (m, 0.75), (m + 1, 0.125)]
    } else {
        [(m, 0.5), (m + 1, 0.5), (m, 0.0)]
    }
}

/// The 2r sites of ring r that belong to one sector.
fn sites(ring: usize) -> impl Iterator<Item = (usize, usize)> {
    let side = (0..=ring).map(move |b| (ring, b));
    side.chain((1..ring).map(move |a| (a, ring)))
}

/// Gaussian elimination with row pivoting on an augmented 4x4 system.
fn solve(mut m: [[Complex<f64>; 5]; 4]) -> [Complex<f64>; 4] {
    for column in 0..4 {
        let size = |row: &[Complex<f64>; 5]| row[column].norm_square();
        let pivot = (column..4).fold(
            column,
            |best, row| if size(&m[row]) > size(&m[best]) { row } else { best },
        );
        m.swap(column, pivot);
        let head = m[column];
        let inverse = head[column].conj().scale(1.0 / head[column].norm_square());
        for row in m.iter_mut().skip(column + 1) {
            let factor = row[column] * inverse;
            for (entry, above) in row.iter_mut().zip(head).skip(column) {
                *entry = *entry - factor * above;
            }
        }
    }
    let mut x = [Complex::zero(); 4];
    for row in (0..4).rev() {
        let mut sum = m[row][4];
        for column in row + 1..4 {
            sum = sum - m[row][column] * x[column];
        }
        x[row] = sum * m[row][row].conj().scale(1.0 / m[row][row].norm_square());
    }
    x
}

/// `exp(-pi i k / N)`: rotates a mode so that the bisector of sector 0 becomes the positive real axis.
pub(super) fn to_bisector(valence: usize, k: i64) -> Complex<f64> {
    Complex::new(
        f64::cos_turn(k, 2 * valence as i64),
        -f64::sin_turn(k, 2 * valence as i64),
    )
}
