//! Finding the rotation of a matrix: which permutation of its points leaves it as it is.
//!
//! A rotation of order N leaves some points where they are and moves the others in cycles of N, the *orbits*:
//! point s of an orbit to point s+1. What is tried are the orders in which people number points. With the
//! fixed points first or last, and m orbits:
//!
//! * by sector: the m points of sector 0, of sector 1, ..;
//! * by orbit: the N points of orbit 0 (all edge neighbours), of orbit 1 (all face neighbours), ..;
//! * by ring: rings outwards, each by sector, as `eigenring matrix` numbers them.

use eigenring_scheme::{Fan, Lattice, Numbering};
use eigenring_spectral::Matrix;

/// A permutation of order N, as its cycles.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotation {
    /// Its order N.
    pub valence: usize,
    /// The points that it leaves where they are.
    pub fixed: Vec<usize>,
    /// The cycles of the others: point s of an orbit is moved to point s+1.
    pub orbits: Vec<Vec<usize>>,
    /// In which order points are numbered, in words.
    pub order: String,
}

/// The order of [`Numbering`].
const BY_RING: &str = "by ring, as by 'eigenring matrix'";

/// Entries may differ by this much relative to the largest: single precision, printed to six digits or more.
pub(super) const TOLERANCE: f64 = 1e-5;

impl Rotation {
    /// The largest difference between an entry and its image, relative to the largest entry.
    pub fn distance(&self, matrix: &Matrix<f64>) -> f64 {
        self.within(matrix, f64::INFINITY).unwrap_or(f64::INFINITY)
    }

    /// The same, if it is not above a bound.
    fn within(&self, matrix: &Matrix<f64>, bound: f64) -> Option<f64> {
        let largest = matrix.entries().iter().fold(0.0_f64, |max, entry| max.max(entry.abs()));
        let mut next: Vec<usize> = (0..matrix.rows()).collect();
        for orbit in &self.orbits {
            for (s, &point) in orbit.iter().enumerate() {
                next[point] = orbit[(s + 1) % orbit.len()];
            }
        }
        let mut worst = 0.0_f64;
        for row in 0..matrix.rows() {
            for column in 0..matrix.columns() {
                let difference = (matrix[(row, column)] - matrix[(next[row], next[column])]).abs();
                worst = worst.max(difference);
                if worst > bound * largest {
                    return None;
                }
            }
        }
        Some(if largest == 0.0 { 0.0 } else { worst / largest })
    }

    /// The matrix whose entries are the means over the rotation.
    pub fn symmetrised(&self, matrix: &Matrix<f64>) -> Matrix<f64> {
        let mut place = vec![None; matrix.rows()];
        for (index, orbit) in self.orbits.iter().enumerate() {
            for (s, &point) in orbit.iter().enumerate() {
                place[point] = Some((index, s));
            }
        }
        let turned = |point: usize, turn: usize| match place[point] {
            Some((orbit, s)) => self.orbits[orbit][(s + turn) % self.valence],
            None => point,
        };
        let mean = |row: usize, column: usize| {
            let (first, mut sum) = (matrix[(row, column)], 0.0);
            for turn in 0..self.valence {
                // the mean of differences: equal entries stay what they are
                sum += matrix[(turned(row, turn), turned(column, turn))] - first;
            }
            first + sum / self.valence as f64
        };
        Matrix::from_fn(matrix.rows(), matrix.columns(), mean)
    }

    /// What was found, in one line.
    pub fn words(&self) -> String {
        let count = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
        format!(
            "a rotation of order {}: {} and {}, numbered {}",
            self.valence,
            count(self.fixed.len(), "fixed point"),
            count(self.orbits.len(), "orbit"),
            self.order
        )
    }

    /// The rotation that a numbering describes, from the sector and the place within its sector of each
    /// point; a place that occurs once only is fixed.
    pub fn numbered(points: &[(usize, Vec<i64>)]) -> Option<Rotation> {
        let mut places: Vec<&Vec<i64>> = points.iter().map(|(_, place)| place).collect();
        places.sort();
        places.dedup();
        let valence = points.iter().map(|(sector, _)| sector + 1).max()?;
        let (mut fixed, mut orbits) = (Vec::new(), Vec::new());
        for place in places {
            let mut orbit: Vec<(usize, usize)> = points
                .iter()
                .enumerate()
                .filter(|(_, (_, other))| other == place)
                .map(|(index, (sector, _))| (*sector, index))
                .collect();
            orbit.sort_unstable();
            match orbit.as_slice() {
                [(_, point)] => fixed.push(*point),
                cycle if cycle.len() == valence && cycle.iter().enumerate().all(|(s, (sector, _))| s == *sector) => {
                    orbits.push(cycle.iter().map(|(_, point)| *point).collect());
                }
                _ => return None,
            }
        }
        Some(Rotation {
            valence,
            fixed,
            orbits,
            order: "as given".to_owned(),
        })
    }

    /// The usual orders of `count` points for an order of the rotation, fewest fixed points first.
    fn candidates(count: usize, valence: usize) -> Vec<Rotation> {
        let mut found: Vec<Rotation> = Self::by_ring(count, valence).into_iter().collect();
        for m in (1..=count / valence).rev() {
            let still = count - m * valence;
            // where the moving points begin
            for first in if still == 0 { vec![0] } else { vec![still, 0] } {
                let fixed: Vec<usize> = (0..count)
                    .filter(|point| !(first..first + m * valence).contains(point))
                    .collect();
                let where_fixed = match (still, first) {
                    (0, _) => "",
                    (_, 0) => ", fixed points last",
                    _ => ", fixed points first",
                };
                let orbits = |point: &dyn Fn(usize, usize) -> usize| -> Vec<Vec<usize>> {
                    (0..m)
                        .map(|orbit| (0..valence).map(|s| first + point(orbit, s)).collect())
                        .collect()
                };
                let mut add = |orbits, order: &str| {
                    found.push(Rotation {
                        valence,
                        fixed: fixed.clone(),
                        orbits,
                        order: format!("{order}{where_fixed}"),
                    });
                };
                add(orbits(&|orbit, s| s * m + orbit), "by sector");
                if m > 1 {
                    add(orbits(&|orbit, s| orbit * valence + s), "by orbit");
                }
            }
        }
        found
    }

    /// The order of `eigenring matrix`, if it has as many points.
    fn by_ring(count: usize, valence: usize) -> Option<Rotation> {
        let numbering = [Lattice::Vertex, Lattice::Face].into_iter().find_map(|lattice| {
            let of = |rings| Numbering {
                fan: Fan::Closed(valence),
                lattice,
                rings,
            };
            // a face of no rings has its corners; a vertex of no rings is no net
            (0..)
                .map(of)
                .take_while(|n| n.count() <= count)
                .find(|n| n.count() == count && n.sector_points() > 0)
        });
        let numbering = numbering.filter(|_| valence >= 3)?;
        let sites = numbering.sites();
        let points: Vec<(usize, Vec<i64>)> = sites
            .iter()
            .map(|site| (site.sector, vec![i64::from(site.x), i64::from(site.y)]))
            .collect();
        let rotation = Rotation::numbered(&points)?;
        Some(Rotation {
            order: BY_RING.to_owned(),
            ..rotation
        })
    }

    /// Whether points are in the order of [`Numbering`].
    pub fn is_by_ring(&self) -> bool {
        self.order == BY_RING
    }
}

/// The rotation of a matrix, of a given order or of the largest there is, and how far the matrix is from
/// having it exactly. Orders that leave at most one point fixed are tried first.
pub fn find(matrix: &Matrix<f64>, valence: Option<usize>) -> Option<(Rotation, f64)> {
    let count = matrix.rows();
    let orders: Vec<usize> = match valence {
        Some(valence) => vec![valence],
        None => (2..=count).rev().collect(),
    };
    for few in [true, false] {
        for &order in orders.iter().filter(|order| (2..=count).contains(*order)) {
            let fits = |rotation: &Rotation| (rotation.fixed.len() <= 1) == few;
            for rotation in Rotation::candidates(count, order).into_iter().filter(fits) {
                if let Some(distance) = rotation.within(matrix, TOLERANCE) {
                    return Some((rotation, distance));
                }
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix with a rotation in the order of `points`, and entries that tell all else apart.
    fn planted(points: &[Vec<usize>], fixed: &[usize]) -> Matrix<f64> {
        let count = points.iter().map(Vec::len).sum::<usize>() + fixed.len();
        let mut place = vec![None; count];
        for (orbit, points) in points.iter().enumerate() {
            points
                .iter()
                .enumerate()
                .for_each(|(s, &point)| place[point] = Some((orbit, s)));
        }
        let n = points[0].len();
        Matrix::from_fn(count, count, |i, j| match (place[i], place[j]) {
            (Some((a, s)), Some((b, t))) => (1 + a * 31 + b * 7) as f64 + ((t + n - s) % n) as f64 * 0.37,
            (Some((a, _)), None) => -((a * 3 + j) as f64) - 0.5,
            (None, Some((b, _))) => -((b * 5 + i) as f64) - 0.25,
            (None, None) => 0.1 * (1 + i * 2 + j) as f64,
        })
    }

    #[test]
    fn planted_rotations_are_found_in_every_order() {
        let by_orbit = |n: usize, m: usize, first: usize| -> Vec<Vec<usize>> {
            (0..m).map(|o| (0..n).map(|s| first + o * n + s).collect()).collect()
        };
        let by_sector = |n: usize, m: usize, first: usize| -> Vec<Vec<usize>> {
            (0..m).map(|o| (0..n).map(|s| first + s * m + o).collect()).collect()
        };
        for (n, m) in [(2, 1), (2, 3), (3, 2), (5, 1), (5, 4), (7, 3)] {
            for still in [0, 1, 3] {
                for first in [0, still] {
                    let fixed: Vec<usize> = (0..n * m + still)
                        .filter(|p| !(first..first + n * m).contains(p))
                        .collect();
                    for orbits in [by_orbit(n, m, first), by_sector(n, m, first)] {
                        let matrix = planted(&orbits, &fixed);
                        for given in [None, Some(n)] {
                            let (found, distance) = find(&matrix, given).unwrap();
                            assert_eq!((found.valence, distance), (n, 0.0), "N = {n}, m = {m}, {still} fixed");
                            assert_eq!(found.fixed, fixed);
                        }
                        assert!(find(&matrix, Some(n + 1)).is_none());
                    }
                }
            }
        }
    }

    #[test]
    fn noise_is_averaged_and_measured() {
        let exact = planted(&[vec![1, 2, 3, 4, 5]], &[0]);
        let noisy = exact.map(|entry| f64::from(entry as f32));
        let (found, distance) = find(&noisy, None).unwrap();
        assert!(found.valence == 5 && distance < 1e-6);
        assert!(found.distance(&found.symmetrised(&noisy)) < 1e-15);
        let broken = Matrix::from_fn(6, 6, |i, j| exact[(i, j)] + if (i, j) == (2, 3) { 0.01 } else { 0.0 });
        assert!(find(&broken, Some(5)).is_none());
    }
}
