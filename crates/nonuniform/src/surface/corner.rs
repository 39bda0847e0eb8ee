//! The surface beside an n-gon, after two halvings.
//!
//! By then the intervals of the first edges of every spoke are equal, and the points `P_i(j, k)`, j, k = 0 ..
//! 3, go to those of the next level by a constant matrix, that of [`with_intervals`] on the first four rings.
//! With the corner's element in units of its sides, (x, y) lies at the first level m with `max(x, y) >= 2^-m`
//! in one of three patches. All is done with the limit of the n-gon as the origin, which is found anew at
//! every level, so that distances keep their digits however small they are.

use super::elements::{Piece, product};
use super::patch::{Jet, evaluate};
use crate::{Error, HybridNet, NGon};
use eigenring_scheme::families::with_intervals;
use eigenring_scheme::{Centre, Corner as Fan, Site, Table};
use eigenring_spectral::{Matrix, local_matrix};

/// Rings of points whose patches are the three beside the corner.
const RINGS: usize = 3;

#[derive(Clone, Debug)]
pub(super) struct Corner {
    n: usize,
    /// The intervals of the spokes.
    d: Vec<f64>,
    /// From the points of a level to those of the next.
    table: Table<f64>,
    /// The weights of the corners of the n-gon in its limit.
    limit: Vec<f64>,
    /// The vertices of the net that the points are.
    pub vertices: Vec<u32>,
    sites: Vec<Site>,
}

impl Corner {
    /// The neighbourhood of an n-gon in a net after two halvings; sector 0 is that of its corner `first`.
    pub fn new(net: &HybridNet, face: u32, first: usize) -> Result<Self, Error> {
        let topology = net.net().topology();
        let mut d = net.spokes(face);
        let n = d.len();
        d.rotate_left(first);
        let mut halves: Vec<u32> = topology.face_halves(face).collect();
        halves.rotate_left(first);
        let cut_off = || Error::Range {
            what: "n-gon",
            given: face.to_string(),
            accepted: "one with four edges along each spoke".to_owned(),
        };
        let bases: Vec<u32> = halves
            .iter()
            .map(|&half| {
                // from the n-gon into the strip, and into the sector
                let twin = topology.twin(half)?;
                Some(topology.next(topology.twin(topology.next(twin))?))
            })
            .collect::<Option<_>>()
            .ok_or_else(cut_off)?;
        // the interval of the second edge of spoke i, which is another one where the first has no width
        let second = |base: u32| -> Option<f64> {
            let right = topology.twin(topology.next(base))?;
            Some(net.net().interval(topology.next(right)))
        };
        // an edge without width that leads to the boundary has none behind it: beyond, all is mirrored
        let ends: Vec<bool> = (0..n).map(|i| d[i] == 0.0 && second(bases[i]).is_none()).collect();
        let next: Vec<f64> = (0..n)
            .map(|i| if ends[i] { Some(0.0) } else { second(bases[i]) })
            .collect::<Option<_>>()
            .ok_or_else(cut_off)?;
        let fan = Fan::closed(Centre::SplitFace, n)?.with_intervals(&d, &next)?;
        let scheme = with_intervals::<f64>("hnuss", &fan)?;
        let sites = scheme.numbering(RINGS).sites();
        let matrix = local_matrix(scheme.limit(), RINGS)?;
        let mut table = Table::default();
        for row in 0..matrix.rows() {
            let entries = matrix.row(row).iter().enumerate();
            table.push(entries.filter(|(_, w)| **w != 0.0).map(|(i, w)| (i as u32, *w)))?;
        }
        // no rule reads a point beyond such an end: the point at it stands for them
        let steps = |spoke: usize, count: i32| {
            let count = (count as usize - 1) / 2;
            if ends[spoke % n] { count.min(1) } else { count }
        };
        let vertex = |site: &Site| {
            let (j, k) = (steps(site.sector, site.x), steps(site.sector + 1, site.y));
            walk(net, bases[site.sector], j, k)
        };
        let vertices: Vec<u32> = sites.iter().map(vertex).collect::<Option<_>>().ok_or_else(cut_off)?;
        Ok(Corner {
            n,
            limit: NGon::new(&d)?.limit_weights(),
            d,
            table,
            vertices,
            sites,
        })
    }

    /// The place of `P_i(j, k)`; beyond a spoke it is in the neighbouring sector.
    fn index(&self, sector: usize, j: i32, k: i32) -> usize {
        let (sector, j, k) = match (j, k) {
            (-1, _) => ((sector + 1) % self.n, k, 0),
            (_, -1) => ((sector + self.n - 1) % self.n, 0, j),
            _ => (sector, j, k),
        };
        let wanted = Site {
            sector,
            x: 2 * j + 1,
            y: 2 * k + 1,
        };
        let found = self.sites.iter().position(|site| *site == wanted);
        found.expect("the first rings hold the nets of the three patches")
    }

    /// The places of the 16 points, by rows along u, and the five intervals in both directions of the cell
    /// (a, b) of a sector, one of (1, 0), (1, 1) and (0, 1). Intervals are those of the first level.
    fn cell(&self, sector: usize, [a, b]: [i32; 2]) -> ([usize; 16], [[f64; 5]; 2]) {
        let turn = |i: usize| self.d[i % self.n];
        let five = |cell: i32, own: f64, beyond: f64| match cell {
            0 => [beyond, 0.0, own, own, own],
            _ => [0.0, own, own, own, own],
        };
        let intervals = [
            five(a, turn(sector), turn(sector + 2)),
            five(b, turn(sector + 1), turn(sector + self.n - 1)),
        ];
        let place = |k: usize| self.index(sector, a + (k % 4) as i32 - 1, b + (k / 4) as i32 - 1);
        (std::array::from_fn(place), intervals)
    }

    /// The point at parameters from the corner of a sector, along spoke i and spoke i+1.
    pub fn at(self, points: &[[f64; 4]], sector: usize, [u, v]: [f64; 2]) -> Jet {
        let (along, next) = (self.d[sector], self.d[(sector + 1) % self.n]);
        let points: Vec<[f64; 4]> = self.vertices.iter().map(|&vertex| points[vertex as usize]).collect();
        let (mut points, mut limit) = centred(&points, self.corners(), &self.limit);
        let (mut x, mut y, mut scale) = (u / along, v / next, 1.0);
        if x == 0.0 && y == 0.0 {
            return tangents(&self.d, limit, self.corners().map(|i| points[i]));
        }
        // intervals are multiples of the sides at the level
        while x.max(y) < 1.0 {
            let refined = self
                .table
                .apply(&points)
                .expect("the rows read the rings that are made");
            let (moved, by) = centred(&refined, self.corners(), &self.limit);
            (points, limit) = (moved, std::array::from_fn(|k| limit[k] + by[k]));
            (x, y, scale) = (2.0 * x, 2.0 * y, 0.5 * scale);
        }
        let [a, b] = [x, y].map(|x| i32::from(x >= 1.0));
        let (places, intervals) = self.cell(sector, [a, b]);
        let net: [[[f64; 4]; 4]; 4] = std::array::from_fn(|k| std::array::from_fn(|j| points[places[4 * k + j]]));
        let place = [(x - f64::from(a)) * along, (y - f64::from(b)) * next];
        let mut jet = evaluate(&net, intervals, place);
        // intervals were those of the first level
        jet.first = jet.first.map(|slope| slope.map(|x| x / scale));
        jet.value = std::array::from_fn(|k| jet.value[k] + limit[k]);
        jet
    }

    /// The weights of the points in the limit of the n-gon.
    fn limit_row(&self) -> Vec<f64> {
        let mut row = vec![0.0; self.vertices.len()];
        self.corners().zip(&self.limit).for_each(|(at, w)| row[at] = *w);
        row
    }

    /// The pieces of the element in sector 0 down to a depth, and the weights of its corner, over the
    /// unknowns whose `rows` make the points of the net. Derivatives use `S - 1 l^T` in place of the matrix S
    /// of the levels, l the weights of the limit: rows of `S^m` tend to l, and their differences would lose
    /// digits.
    pub fn pieces(&self, rows: &Matrix<f64>, depth: usize) -> (Vec<Piece>, Vec<f64>) {
        let columns = rows.columns();
        let limit = Matrix::from_rows(vec![self.limit_row()], self.vertices.len());
        let centre = |rows: &Matrix<f64>| product(&limit, rows).row(0).to_vec();
        let refined = |rows: &Matrix<f64>| {
            let mut fine = vec![vec![0.0; columns]; rows.rows()];
            for (at, sums) in fine.iter_mut().enumerate() {
                for (source, &weight) in self.table.row(at) {
                    sums.iter_mut()
                        .zip(rows.row(source))
                        .for_each(|(sum, x)| *sum += weight * x);
                }
            }
            fine
        };
        let (mut values, mut deflated) = (rows.clone(), rows.clone());
        let mut pieces = Vec::with_capacity(3 * depth);
        for level in 1..=depth {
            let removed = centre(&deflated);
            let mut fine = refined(&deflated);
            for row in &mut fine {
                row.iter_mut().zip(&removed).for_each(|(x, removed)| *x -= removed);
            }
            deflated = Matrix::from_rows(fine, columns);
            values = Matrix::from_rows(refined(&values), columns);
            for cell in [[1, 0], [1, 1], [0, 1]] {
                let (places, intervals) = self.cell(0, cell);
                pieces.push(Piece {
                    intervals,
                    values: Matrix::from_fn(16, columns, |k, column| values[(places[k], column)]),
                    derivatives: Matrix::from_fn(16, columns, |k, column| deflated[(places[k], column)]),
                    is_last: level == depth,
                });
            }
        }
        (pieces, centre(rows))
    }

    /// The intervals of the spokes, from that of sector 0 on.
    pub fn intervals(&self) -> &[f64] {
        &self.d
    }

    /// The places of the corners of the n-gon.
    fn corners(&self) -> impl Iterator<Item = usize> + Clone + '_ {
        (0..self.n).map(|sector| self.index(sector, 0, 0))
    }
}

/// Points with the limit of the corners as origin, and that limit.
fn centred(points: &[[f64; 4]], corners: impl Iterator<Item = usize>, weights: &[f64]) -> (Vec<[f64; 4]>, [f64; 4]) {
    let mut limit = [0.0; 4];
    for (corner, weight) in corners.zip(weights) {
        for (sum, x) in limit.iter_mut().zip(points[corner]) {
            *sum += weight * x;
        }
    }
    let moved = points.iter().map(|p| std::array::from_fn(|k| p[k] - limit[k]));
    (moved.collect(), limit)
}

/// The limit of an n-gon with two tangents.
fn tangents(d: &[f64], limit: [f64; 4], corners: impl Iterator<Item = [f64; 4]>) -> Jet {
    let corners: Vec<[f64; 4]> = corners.collect();
    let weights = NGon::new(d).map(|ngon| ngon.tangent_weights());
    let combined = |weights: &Vec<f64>| {
        let size = weights.iter().fold(0.0, |m: f64, w| m.max(w.abs()));
        let mut sum = [0.0; 4];
        for (weight, point) in weights.iter().zip(&corners) {
            for (sum, x) in sum.iter_mut().zip(point) {
                *sum += weight / size * x;
            }
        }
        sum
    };
    Jet {
        value: limit,
        first: weights.map_or([[0.0; 4]; 2], |weights| weights.each_ref().map(combined)),
        is_regular: false,
    }
}

/// The limit of an n-gon of any hybrid net.
pub(super) fn centre(net: &HybridNet, points: &[[f64; 4]], face: u32) -> Result<Jet, Error> {
    let topology = net.net().topology();
    let d = net.spokes(face);
    let weights = NGon::new(&d)?.limit_weights();
    let corners: Vec<[f64; 4]> = topology
        .face_halves(face)
        .map(|half| points[topology.origin(half) as usize])
        .collect();
    let (moved, limit) = centred(&corners, 0..corners.len(), &weights);
    Ok(tangents(&d, limit, moved.into_iter()))
}

/// The vertex j steps along a sector's first direction and k along its second; `base` leaves its corner.
fn walk(net: &HybridNet, base: u32, j: usize, k: usize) -> Option<u32> {
    let topology = net.net().topology();
    // the lower half-edge of cell (column, row); the last step is along its far edges
    let (columns, rows) = (j.saturating_sub(1), k.saturating_sub(1));
    let mut half = base;
    for _ in 0..columns {
        half = topology.next(topology.twin(topology.next(half))?);
    }
    for _ in 0..rows {
        half = topology.twin(topology.next(topology.next(half)))?;
    }
    Some(match (j, k) {
        (0, 0) => topology.origin(half),
        (_, 0) => topology.head(half),
        (0, _) => topology.origin(topology.previous(half)),
        _ => topology.head(topology.next(half)),
    })
}
