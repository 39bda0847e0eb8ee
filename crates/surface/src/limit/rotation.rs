//! Local matrices around a centre of many like sectors: Fourier blocks in place of one large matrix.
//!
//! The points of the rings around the centre form orbits of N points each, and the centre itself is fixed.
//! They refine to themselves by a matrix that turns with the sectors; all other points of the part lie around
//! its face alone, depend on these, and have eigenvalues below theirs:
//!
//! ```text
//! S = | C 0 |    C in blocks  B_k[p][q] = sum_s C[o_p(0), o_q(s)] w^(k s),  w = exp(2 pi i/N)
//!     | A B |    right vectors of C go on by  (lambda - B) r = A r_C,  left ones by 0
//! ```

use super::local::Local;
use crate::refine::Row;
use crate::walk::locate;
use eigenring_scheme::{Complex, Site};
use eigenring_spectral::{Block, Matrix};

/// Fewer sectors are left to the dense matrix, whose vectors know no symmetry.
pub(super) const MANY: usize = 16;

/// More work than this, in blocks times the cube of their size, is refused: a minute or so.
const MOST: usize = 1 << 32;

/// Sums around a centre may differ in rounding.
const SAME: f64 = 1e-12;

/// A point of the rings: its orbit and sector, or the centre.
type Seat = Option<(usize, usize)>;

/// A point and its weight.
type Term = (Seat, f64);

/// The orbits around a centre, and the blocks of the matrix.
#[derive(Debug)]
pub(super) struct Rotation {
    sectors: usize,
    /// The points of each orbit in turn.
    orbits: Vec<Vec<u32>>,
    /// The centre, if it is a point.
    fixed: Option<u32>,
    /// Rows of the first point of each orbit: orbit and sector of a point, or `None` for the centre, with its
    /// weight.
    rows: Vec<Vec<Term>>,
    centre: Vec<Term>,
    /// The rows of all other points.
    outside: Vec<(u32, Row)>,
    points: usize,
}

/// Whether a map turns with the sectors and reads nothing else: of two columns, of which one is the other
/// turned and which differ outside, so are the images. The columns have no symmetry of their own.
fn turns(places: &[Option<Seat>], sectors: usize, map: impl Fn(&[[f64; 2]]) -> Option<Vec<[f64; 2]>>) -> Option<bool> {
    let value = |orbit: usize, sector: usize| (1.3 * orbit as f64 + 2.9 * (sector % sectors) as f64).sin();
    let columns = places.iter().map(|place| match *place {
        Some(Some((orbit, sector))) => [value(orbit, sector), value(orbit, sector + 1)],
        Some(None) => [0.3; 2],
        None => [0.7, -0.7],
    });
    let images = map(&columns.collect::<Vec<_>>())?;
    let mut first: Vec<Vec<f64>> = Vec::new();
    for (place, image) in places.iter().zip(&images) {
        if let Some(Some((orbit, sector))) = *place {
            if first.len() <= orbit {
                first.resize(orbit + 1, vec![0.0; sectors]);
            }
            first[orbit][sector] = image[0];
        }
    }
    let agrees = |(place, image): (&Option<Seat>, &[f64; 2])| match *place {
        Some(Some((orbit, sector))) => (image[1] - first[orbit][(sector + 1) % sectors]).abs() <= SAME,
        Some(None) => (image[1] - image[0]).abs() <= SAME,
        None => true,
    };
    Some(places.iter().zip(&images).all(agrees))
}

impl Rotation {
    /// The rotation of a part's matrix around its first corner, if it has one. The matrix has as many rows as
    /// there are points; `rows` gives some of them, and `map` applies it to a pair of columns.
    pub fn find(
        local: &Local,
        points: usize,
        rings: usize,
        rows: impl Fn(&[u32]) -> Vec<Row>,
        map: impl Fn(&[[f64; 2]]) -> Option<Vec<[f64; 2]>>,
    ) -> Option<Self> {
        let topology = &local.topology;
        let centre = topology.origin(0);
        let fan = topology.fan(centre);
        let sectors = fan.spokes.len();
        let dual = local.net.is_some();
        if !fan.is_closed() || sectors < MANY || !local.mesh.features.is_empty() {
            return None;
        }
        // of dual nets quads out to ring `rings`, of others vertices
        let parity = i32::from(dual);
        let far = if dual { rings as i32 - 1 } else { rings as i32 };
        let low = 1 - parity;
        let mut orbits = Vec::new();
        for (a, b) in (low..=far).flat_map(|a| (0..=far).map(move |b| (a, b))) {
            let site = Site {
                sector: 0,
                x: 2 * a + parity,
                y: 2 * b + parity,
            };
            let orbit = fan.spokes.iter().map(|&spoke| locate(topology, spoke, site));
            orbits.push(orbit.collect::<Option<Vec<u32>>>()?);
        }
        let fixed = (!dual).then_some(centre);
        let mut places: Vec<Option<Seat>> = vec![None; points];
        for (orbit, points) in orbits.iter().enumerate() {
            for (sector, &point) in points.iter().enumerate() {
                // a net so small that a point is met twice has no such rotation
                if places[point as usize].replace(Some((orbit, sector))).is_some() {
                    return None;
                }
            }
        }
        if let Some(centre) = fixed {
            places[centre as usize] = Some(None);
        }
        if !turns(&places, sectors, map)? {
            return None;
        }
        let named = |row: &Row| -> Option<Vec<Term>> {
            let terms = row.iter().filter(|(_, weight)| *weight != 0.0);
            let mut terms: Vec<Term> = terms
                .map(|&(at, weight)| Some((places[at as usize]?, weight)))
                .collect::<Option<_>>()?;
            terms.sort_unstable_by_key(|term| term.0);
            Some(terms)
        };
        let firsts: Vec<u32> = orbits.iter().map(|orbit| orbit[0]).collect();
        let own: Vec<Vec<Term>> = rows(&firsts).iter().map(named).collect::<Option<_>>()?;
        let centre = match fixed {
            Some(centre) => named(&rows(&[centre])[0])?,
            None => Vec::new(),
        };
        let others: Vec<u32> = (0..points as u32).filter(|&at| places[at as usize].is_none()).collect();
        let outside = others.iter().copied().zip(rows(&others)).collect();
        let size = orbits.len();
        if (sectors / 2 + 1).checked_mul(size.pow(3))? > MOST {
            return None;
        }
        Some(Rotation {
            sectors,
            orbits,
            fixed,
            rows: own,
            centre,
            outside,
            points,
        })
    }

    pub fn sectors(&self) -> usize {
        self.sectors
    }

    /// The block of a frequency: the centre first in that of 0.
    pub fn block(&self, k: usize) -> Block<f64> {
        let n = self.sectors;
        let first = usize::from(k == 0 && self.fixed.is_some());
        let size = self.orbits.len() + first;
        let mut entries = vec![vec![Complex::<f64>::zero(); size]; size];
        let mut fill = |row: usize, terms: &[Term]| {
            for &(place, weight) in terms {
                match place {
                    Some((orbit, sector)) => {
                        let turned = Complex::<f64>::turn(((k * sector) % n) as i64, n as i64).scale(weight);
                        entries[row][first + orbit] += turned;
                    }
                    None if k == 0 => entries[row][0] += Complex::one().scale(weight),
                    None => {}
                }
            }
        };
        if first == 1 {
            fill(0, &self.centre);
        }
        for (index, row) in self.rows.iter().enumerate() {
            fill(first + index, row);
        }
        if k == 0 || 2 * k == n {
            return Block::Real(Matrix::from_fn(size, size, |i, j| entries[i][j].re));
        }
        Block::Complex(Matrix::from_fn(size, size, |i, j| entries[i][j]))
    }

    /// The block of frequency 0, of what is alike in all sectors: rows of the centre, if it is a point, and
    /// of the orbits.
    pub fn means(&self) -> Vec<Vec<f64>> {
        let first = usize::from(self.fixed.is_some());
        let size = self.orbits.len() + first;
        let row = |terms: &Vec<Term>| {
            let mut row = vec![0.0; size];
            for &(place, weight) in terms {
                row[place.map_or(0, |(orbit, _)| first + orbit)] += weight;
            }
            row
        };
        let centre = self.fixed.map(|_| &self.centre);
        centre.into_iter().chain(&self.rows).map(row).collect()
    }

    /// The row of weights at all points whose sums over orbits are those of a row of [`Rotation::means`].
    pub fn shared(&self, sums: &[f64]) -> Vec<f64> {
        let mut weights = vec![0.0; self.points];
        let mut sums = sums.iter();
        if let (Some(centre), Some(&sum)) = (self.fixed, self.fixed.and_then(|_| sums.next())) {
            weights[centre as usize] = sum;
        }
        for (orbit, sum) in self.orbits.iter().zip(sums) {
            orbit
                .iter()
                .for_each(|&point| weights[point as usize] = sum / self.sectors as f64);
        }
        weights
    }

    /// A vector of a frequency above 0 at all points of the orbits, its real and imaginary parts: `v_p w^(k
    /// s)` of right vectors, `v_p w^(-k s)` of left ones.
    pub fn spread(&self, k: usize, vector: &[Complex<f64>], left: bool) -> [Vec<f64>; 2] {
        let n = self.sectors as i64;
        let mut parts = [vec![0.0; self.points], vec![0.0; self.points]];
        for (orbit, &value) in self.orbits.iter().zip(vector) {
            for (sector, &point) in orbit.iter().enumerate() {
                let angle = (k as i64 * sector as i64) % n;
                let turned = value * Complex::turn(if left { -angle } else { angle }, n);
                parts[0][point as usize] = turned.re;
                parts[1][point as usize] = turned.im;
            }
        }
        parts
    }

    /// Goes on with a right vector of the rings to the points around the face.
    pub fn continued(&self, value: f64, vector: &mut [f64]) {
        // the eigenvalues of these points are far below
        for _ in 0..400 {
            let mut change = 0.0_f64;
            for (point, row) in &self.outside {
                let sum: f64 = row.iter().map(|&(at, weight)| weight * vector[at as usize]).sum();
                let old = &mut vector[*point as usize];
                change = change.max((sum / value - *old).abs());
                *old = sum / value;
            }
            if change < 1e-17 {
                break;
            }
        }
    }

    /// The part of frequency k in heights at the points: by orbits, after the centre's in that of frequency
    /// 0.
    pub fn part(&self, k: usize, heights: &[f64]) -> Vec<Complex<f64>> {
        let n = self.sectors;
        let turns: Vec<Complex<f64>> = (0..n).map(|s| Complex::turn(-(s as i64), n as i64)).collect();
        let centre = self.fixed.filter(|_| k == 0);
        let centre = centre.map(|centre| Complex::one().scale(heights[centre as usize]));
        let orbit = |points: &Vec<u32>| {
            let terms = points.iter().enumerate();
            let sum = terms.fold(Complex::zero(), |sum: Complex<f64>, (s, &point)| {
                sum + turns[(k * s) % n].scale(heights[point as usize])
            });
            sum.scale(1.0 / n as f64)
        };
        centre.into_iter().chain(self.orbits.iter().map(orbit)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limit::Surface;
    use crate::limit::centre::composed;
    use crate::limit::local::Source;
    use crate::limit::pair::{Leading, leading, limit_turning, turning};
    use crate::shapes::{StarKind, star};
    use crate::{Rules, Topology};
    use eigenring_scheme::{Definition, Spec};

    /// Eigenvectors are judged by the matrix itself, their dominance by the dense decomposition.
    #[test]
    fn blocks_and_the_whole_matrix_have_the_same_pair() {
        for (spec, n) in [
            ("catmull-clark", 50),
            ("catmull-clark", 51),
            ("stam:order=6", 48),
            ("doo-sabin", 50),
            ("stam:order=5", 49),
        ] {
            let rules = Rules::new(Definition::Family(spec.parse::<Spec>().unwrap()));
            let mesh = star(n, 5, StarKind::Saddle);
            let surface = Surface::new(&mesh, &rules).unwrap();
            let (kernel, topology) = (&surface.kernel, &surface.topology);
            let source = Source {
                mesh: &surface.base,
                topology,
                ends: surface.ends,
                soft: false,
                net: surface.net.as_ref(),
                full: kernel.full_steps(),
            };
            // the face of the base at vertex 0, counted from there
            let start = topology.fan(0).spokes[0];
            let local = source.part(start, kernel.reach(), |_| None);
            let refined = local.refined(&rules, kernel, 0).unwrap();
            let fine = Topology::unchecked(&refined.mesh);
            let child = local.child(&refined, &fine, 0, kernel.reach()).unwrap();
            let matrix = composed(&refined, child.unknowns());
            let find = |matrix: &[Row]| {
                let some = |points: &[u32]| points.iter().map(|&point| matrix[point as usize].clone()).collect();
                let map = |columns: &[[f64; 2]]| {
                    let image = |row: &Row| {
                        let terms = row.iter().map(|&(at, w)| columns[at as usize].map(|x| w * x));
                        terms.fold([0.0; 2], |sum, x| [sum[0] + x[0], sum[1] + x[1]])
                    };
                    Some(matrix.iter().map(image).collect())
                };
                Rotation::find(&local, matrix.len(), kernel.reach(), some, map)
            };
            let rotation = find(&matrix).expect(spec);
            // one weight of one sector is another one
            let mut broken = matrix.clone();
            broken[rotation.orbits[0][n / 3] as usize][2].1 += 1e-9;
            assert!(find(&broken).is_none(), "{spec}: no rotation");
            let dense = leading(&matrix)
                .unwrap()
                .unwrap_or_else(|why| panic!("{spec}: {why:?}"));
            // the limit is a left eigenvector of the whole matrix
            let fixed = limit_turning(&rotation);
            let mut back = vec![0.0; matrix.len()];
            for (row, weight) in matrix.iter().zip(&fixed) {
                row.iter().for_each(|&(at, w)| back[at as usize] += weight * w);
            }
            let off = back.iter().zip(&fixed).map(|(b, l)| (b - l).abs());
            let off = off.fold(0.0, f64::max);
            // the rounding of sums over all sectors
            assert!(off < 1e-14, "{spec}: limit {off:e}");
            assert!((fixed.iter().sum::<f64>() - 1.0).abs() < 1e-14, "{spec}: limit");
            let Leading { values, right, left } = turning(&rotation).unwrap().unwrap();
            for (value, expected) in values.iter().zip(dense.values) {
                assert!((value - expected).abs() < 1e-12, "{spec}: {value} {expected}");
            }
            for (value, (right, left)) in values.iter().zip(right.iter().zip(&left)) {
                let mut back = vec![0.0; matrix.len()];
                for (row, (image, weight)) in matrix.iter().zip(right.iter().zip(left)) {
                    let sum: f64 = row.iter().map(|&(at, w)| w * right[at as usize]).sum();
                    assert!((sum - value * image).abs() < 1e-13, "{spec}: right");
                    row.iter().for_each(|&(at, w)| back[at as usize] += weight * w);
                }
                let off = back.iter().zip(left).map(|(b, l)| (b - value * l).abs());
                assert!(off.fold(0.0, f64::max) < 1e-13, "{spec}: left");
                assert!(right.iter().chain(left).any(|x| x.abs() > 0.1), "no zero vectors");
            }
            // heights of frequency 2 alone have a part in no other
            let heights: Vec<f64> = rotation.spread(2, &vec![Complex::one(); rotation.orbits.len()], false)[0].clone();
            for k in 0..=n / 2 {
                let part = rotation.part(k, &heights);
                let most = part.iter().fold(0.0_f64, |most, c| most.max(c.modulus()));
                assert_eq!(most > 1e-12, k == 2, "{spec}: {k}");
            }
        }
    }
}
