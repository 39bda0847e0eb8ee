//! An order of elimination by nested dissection (George 1973).
//!
//! Unknowns have places, as the mean of a control point's neighbourhood is near it, and the matrix joins
//! those that share a face. A plane halves them; those of one half that are joined to the other are a
//! separator and are eliminated last, and both sides go the same way. A separator is short where its plane
//! runs along lines of the mesh: planes across the axes are tried, and those along the edges of some
//! unknowns. Of the square of 10^6 unknowns the factor has two thirds of the entries that it has with
//! approximate minimum degree. At vertices of high valence, where no plane follows the lines of all sectors,
//! it has more; so the caller compares.

use crate::sparse::Sparse;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Unknowns that are not halved any more: two rows of faces' functions.
const LEAF: usize = 48;
/// Unknowns of a part whose edges are looked at.
const SAMPLES: usize = 32;
/// Directions of lines that are tried.
const DIRECTIONS: usize = 4;
/// The cosine of two lines that are about the same, 10 degrees.
const SAME: f64 = 0.985;
/// The cosine of two edges that are not of one line: with 12 sectors they have 30 degrees.
const ASIDE: f64 = 0.9;
/// The extent over the longest at which a direction is tried.
const TRIED: f64 = 0.3;
/// Unknowns of which halves are left to other threads.
const SHARED: usize = 4096;
const NONE: u32 = u32::MAX;

type Vector = [f64; 3];

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn unit(a: Vector) -> Option<Vector> {
    let length = dot(a, a).sqrt();
    (length > 0.0).then(|| a.map(|c| c / length))
}

/// The part of a vector across a unit vector.
fn across(a: Vector, unit: Vector) -> Vector {
    let along = dot(a, unit);
    std::array::from_fn(|k| a[k] - along * unit[k])
}

struct Dissection<'a> {
    matrix: &'a Sparse,
    places: &'a [Vector],
    /// The half in which an unknown is, children of node k being 2 k and 2 k + 1.
    halves: Vec<AtomicU32>,
}

struct Cut {
    sides: [Vec<u32>; 2],
    separator: Vec<u32>,
}

impl Dissection<'_> {
    fn row(&self, unknown: u32) -> &[u32] {
        &self.matrix.columns[self.matrix.starts[unknown as usize]..self.matrix.starts[unknown as usize + 1]]
    }

    fn joined(&self, unknown: u32, half: u32) -> bool {
        let row = self.row(unknown);
        row.iter()
            .any(|&other| self.halves[other as usize].load(Relaxed) == half)
    }

    /// Normals of the two lines of the mesh through an unknown: its nearest neighbours on different ones.
    fn normals(&self, unknown: u32) -> Option<[Vector; 2]> {
        let at = self.places[unknown as usize];
        let edge = |&other: &u32| {
            let to = self.places[other as usize];
            let edge = std::array::from_fn(|k| to[k] - at[k]);
            unit(edge).map(|direction| (dot(edge, edge), direction))
        };
        let mut edges: Vec<(f64, Vector)> = self.row(unknown).iter().filter_map(edge).collect();
        edges.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (_, first) = *edges.first()?;
        let (_, second) = *edges.iter().find(|(_, other)| dot(*other, first).abs() < ASIDE)?;
        Some([unit(across(second, first))?, unit(across(first, second))?])
    }

    /// Normals of planes: the most frequent ones of lines of the mesh, then the axes; those along which the
    /// part is long, longest first.
    fn directions(&self, part: &[u32]) -> Vec<Vector> {
        let mut found: Vec<(usize, Vector)> = Vec::new();
        for k in 0..SAMPLES {
            let sample = part[(2 * k + 1) * part.len() / (2 * SAMPLES)];
            for normal in self.normals(sample).into_iter().flatten() {
                match found.iter_mut().find(|(_, other)| dot(*other, normal).abs() > SAME) {
                    Some((count, _)) => *count += 1,
                    None => found.push((1, normal)),
                }
            }
        }
        found.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
        let mut normals: Vec<Vector> = found.into_iter().map(|(_, normal)| normal).take(DIRECTIONS).collect();
        for axis in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
            if normals.iter().all(|normal| dot(*normal, axis).abs() <= SAME) {
                normals.push(axis);
            }
        }
        let extent = |normal: Vector| {
            let heights = part.iter().map(|&v| dot(self.places[v as usize], normal));
            let empty = (f64::INFINITY, f64::NEG_INFINITY);
            let (low, high) = heights.fold(empty, |(low, high), h| (h.min(low), h.max(high)));
            (high - low, normal)
        };
        let mut all: Vec<(f64, Vector)> = normals.into_iter().map(extent).collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        let least = TRIED * all[0].0;
        let long = all.into_iter().filter(|(extent, _)| *extent >= least);
        long.map(|(_, normal)| normal).collect()
    }

    /// Halves a part by a plane; the separator is in the half where it is smaller.
    fn cut(&self, part: &[u32], node: u32, normal: Vector) -> Cut {
        let height = |&v: &u32| (dot(self.places[v as usize], normal), v);
        let mut heights: Vec<(f64, u32)> = part.iter().map(height).collect();
        let middle = part.len() / 2;
        heights.select_nth_unstable_by(middle, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let halves = heights.split_at(middle);
        let halves = [halves.0, halves.1].map(|half| half.iter().map(|(_, v)| *v).collect::<Vec<u32>>());
        for (half, number) in halves.iter().zip(2 * node..) {
            half.iter()
                .for_each(|&v| self.halves[v as usize].store(number, Relaxed));
        }
        // its separator and what is left
        let parted = |side: usize| -> (Vec<u32>, Vec<u32>) {
            let other = 2 * node + 1 - side as u32;
            halves[side].iter().partition(|&&v| self.joined(v, other))
        };
        let (first, second) = (parted(0), parted(1));
        let [lower, upper] = halves;
        if first.0.len() < second.0.len() {
            Cut {
                sides: [first.1, upper],
                separator: first.0,
            }
        } else {
            Cut {
                sides: [lower, second.1],
                separator: second.0,
            }
        }
    }

    /// Puts a part into its order of elimination.
    fn dissect(&self, part: &mut [u32], node: u32) {
        if part.len() <= LEAF {
            return part.sort_unstable();
        }
        let cuts = self
            .directions(part)
            .into_iter()
            .map(|normal| self.cut(part, node, normal));
        let Some(Cut { sides, separator }) = cuts.min_by_key(|cut| cut.separator.len()) else {
            unreachable!("the longest direction is tried")
        };
        let (first, rest) = part.split_at_mut(sides[0].len());
        let (second, last) = rest.split_at_mut(sides[1].len());
        first.copy_from_slice(&sides[0]);
        second.copy_from_slice(&sides[1]);
        last.copy_from_slice(&separator);
        last.sort_unstable();
        drop((sides, separator));
        if first.len() + second.len() > SHARED {
            rayon::join(|| self.dissect(first, 2 * node), || self.dissect(second, 2 * node + 1));
        } else {
            self.dissect(first, 2 * node);
            self.dissect(second, 2 * node + 1);
        }
    }
}

/// The order in which the unknowns of a symmetric matrix, which are at these places, are eliminated.
pub(crate) fn dissected(matrix: &Sparse, places: &[Vector]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..places.len() as u32).collect();
    let halves = places.iter().map(|_| AtomicU32::new(0)).collect();
    Dissection { matrix, places, halves }.dissect(&mut order, 1);
    postorder(matrix, &order)
}

/// An order with the same factor in which columns that share their rows are neighbours: a postorder of the
/// elimination tree (Liu 1990).
fn postorder(matrix: &Sparse, order: &[u32]) -> Vec<u32> {
    let n = order.len();
    let mut numbers = vec![0_u32; n];
    (0..).zip(order).for_each(|(k, &v)| numbers[v as usize] = k);
    let (mut parents, mut ancestors) = (vec![NONE; n], vec![NONE; n]);
    for (k, &v) in (0..).zip(order) {
        for (other, _) in matrix.row(v as usize) {
            let mut i = numbers[other];
            while i < k {
                // paths are shortened to k
                let next = std::mem::replace(&mut ancestors[i as usize], k);
                if next == NONE {
                    parents[i as usize] = k;
                    break;
                }
                i = next;
            }
        }
    }
    // lists of children, and of roots, ascending
    let (mut children, mut siblings, mut roots) = (vec![NONE; n], vec![NONE; n], NONE);
    for k in (0..n).rev() {
        let list = match parents[k] {
            NONE => &mut roots,
            parent => &mut children[parent as usize],
        };
        siblings[k] = std::mem::replace(list, k as u32);
    }
    let mut result = Vec::with_capacity(n);
    let mut path = Vec::new();
    let mut root = roots;
    while root != NONE {
        path.push(root);
        while let Some(&k) = path.last() {
            let child = children[k as usize];
            if child == NONE {
                result.push(order[k as usize]);
                path.pop();
            } else {
                children[k as usize] = siblings[child as usize];
                path.push(child);
            }
        }
        root = siblings[root as usize];
    }
    result
}

#[cfg(test)]
mod tests {
    //! Orders against brute force: elimination row by row on sets, entries of faer's factors with approximate
    //! minimum degree, and solutions of both.

    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    /// The matrix of some edges: -1 off the diagonal, and dominant.
    fn matrix(n: usize, edges: impl IntoIterator<Item = (usize, usize)>) -> Sparse {
        let mut rows = vec![BTreeSet::new(); n];
        for (a, b) in edges.into_iter().filter(|(a, b)| a != b) {
            rows[a].insert(b as u32);
            rows[b].insert(a as u32);
        }
        let row = |(v, others): (usize, BTreeSet<u32>)| {
            let degree = others.len() as f64;
            let mut row: Vec<(u32, f64)> = others.into_iter().map(|other| (other, -1.0)).collect();
            row.push((v as u32, degree + 0.01));
            row.sort_unstable_by_key(|(column, _)| *column);
            row
        };
        let rows: Vec<Vec<(u32, f64)>> = rows.into_iter().enumerate().map(row).collect();
        Sparse::from_rows(&rows, n)
    }

    /// Bicubic functions of a grid in rows, a turned square or closed to a tube.
    fn grid(side: usize, closed: bool) -> (Sparse, Vec<Vector>) {
        let places = (0..side * side).map(|v| {
            let [x, y] = [v % side, v / side].map(|c| c as f64 / side as f64);
            let angle = std::f64::consts::TAU * x;
            match closed {
                true => [angle.cos(), angle.sin(), 3.0 * y],
                false => [x + 0.6 * y, y - 0.6 * x, 0.0],
            }
        });
        let edges = (0..side * side).flat_map(|v| {
            let (x, y) = (v % side, v / side);
            (0..49).filter_map(move |k| {
                let (to, up) = (x + k % 7, y + k / 7);
                let column = if closed {
                    Some((to + side - 3) % side)
                } else {
                    to.checked_sub(3)
                };
                let (column, row) = (column.filter(|c| *c < side)?, up.checked_sub(3).filter(|r| *r < side)?);
                Some((v, row * side + column))
            })
        });
        (matrix(side * side, edges), places.collect())
    }

    fn is_permutation(order: &[u32]) -> bool {
        let all: BTreeSet<u32> = order.iter().copied().collect();
        order.len() == all.len() && all.into_iter().eq(0..order.len() as u32)
    }

    /// The rows of each column of the factor, below the diagonal, in numbers of elimination.
    fn eliminated(matrix: &Sparse, order: &[u32]) -> Vec<BTreeSet<usize>> {
        let number = |v: usize| order.iter().position(|&o| o as usize == v).expect("all are there");
        let numbers: Vec<usize> = (0..order.len()).map(number).collect();
        let row = |&v: &u32| matrix.row(v as usize).map(|(other, _)| numbers[other]);
        let mut columns: Vec<BTreeSet<usize>> = order.iter().map(|v| row(v).collect()).collect();
        for k in 0..columns.len() {
            let below: BTreeSet<usize> = columns[k].iter().copied().filter(|&row| row > k).collect();
            if let Some(&parent) = below.first() {
                columns[parent].extend(&below);
            }
            columns[k] = below;
        }
        columns
    }

    fn entries(columns: &[BTreeSet<usize>]) -> usize {
        columns.iter().map(BTreeSet::len).sum()
    }

    /// In a postorder the descendants of a column come right before it.
    fn descendants_are_together(columns: &[BTreeSet<usize>]) -> bool {
        let mut first: Vec<usize> = (0..columns.len()).collect();
        let mut sizes = vec![1; columns.len()];
        for (k, column) in columns.iter().enumerate() {
            if let Some(&parent) = column.first() {
                first[parent] = first[parent].min(first[k]);
                sizes[parent] += sizes[k];
            }
        }
        (0..columns.len()).all(|k| first[k] + sizes[k] == k + 1)
    }

    #[test]
    fn graphs_at_the_edge_have_orders() {
        let n = 150;
        let pairs = || (0..n).flat_map(|a| (0..a).map(move |b| (a, b)));
        let all: Vec<(&str, Vec<(usize, usize)>)> = vec![
            ("no edges", vec![]),
            ("complete", pairs().collect()),
            ("star", (1..n).map(|v| (0, v)).collect()),
            ("path", (1..n).map(|v| (v - 1, v)).collect()),
            ("two parts", pairs().filter(|(a, b)| (a < &70) == (b < &70)).collect()),
        ];
        for (name, edges) in all {
            let matrix = matrix(n, edges);
            for places in [
                vec![[0.0; 3]; n],
                (0..n).map(|v| [(v * 37 % n) as f64, v as f64, 0.0]).collect(),
            ] {
                assert!(is_permutation(&dissected(&matrix, &places)), "{name}");
            }
        }
        assert!(dissected(&matrix(0, []), &[]).is_empty());
    }

    proptest! {
        #[test]
        fn orders_are_permutations(
            n in 1_usize..250,
            edges in prop::collection::vec((0_usize..250, 0_usize..250), 0..600),
            places in prop::collection::vec(prop::array::uniform3(-2.0..2.0), 250),
        ) {
            let matrix = matrix(n, edges.into_iter().map(|(a, b)| (a % n, b % n)));
            let order = dissected(&matrix, &places[..n]);
            prop_assert!(is_permutation(&order));
            prop_assert!(descendants_are_together(&eliminated(&matrix, &order)));
        }

        #[test]
        fn a_postorder_leaves_the_factor(
            edges in prop::collection::vec((0_usize..60, 0_usize..60), 0..150),
            order in Just((0..60).collect::<Vec<u32>>()).prop_shuffle(),
        ) {
            let matrix = matrix(60, edges);
            let after = eliminated(&matrix, &postorder(&matrix, &order));
            prop_assert_eq!(entries(&after), entries(&eliminated(&matrix, &order)));
            prop_assert!(descendants_are_together(&after));
        }
    }

    #[test]
    fn a_random_order_is_no_postorder() {
        let path = matrix(60, (1..60).map(|v| (v - 1, v)));
        let order: Vec<u32> = (0..60).map(|k| k * 7 % 60).collect();
        assert!(!descendants_are_together(&eliminated(&path, &order)));
    }

    /// On grids dissection saves entries, at the same solution; faer counts them.
    #[test]
    fn dissection_saves_entries_and_keeps_the_solution() {
        for closed in [false, true] {
            let (matrix, places) = grid(256, closed);
            let n = places.len();
            let right: Vec<f64> = (0..n).map(|i| (i * 7919 % 1000) as f64 - 499.5).collect();
            let by_degree = matrix.clone().factor(None).expect("a factor");
            let by_places = matrix.clone().factor(Some(&places)).expect("a factor");
            let saved = by_places.len() as f64 / by_degree.len() as f64;
            assert!(saved < 0.95, "closed {closed}: {saved}");
            let [a, b] = [by_degree, by_places].map(|factor| factor.solve(&right));
            let largest = a.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let off = a.iter().zip(&b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs())) / largest;
            assert!(off > 0.0 && off < 1e-10, "closed {closed}: {off:e}");
            let rest = matrix
                .times(&b)
                .iter()
                .zip(&right)
                .fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
            assert!(rest < 1e-10 * 500.0, "closed {closed}: {rest:e}");
        }
    }

    /// Places that say nothing about the matrix make many entries: then those of minimum degree are taken.
    #[test]
    fn the_better_order_is_taken() {
        let (matrix, places) = grid(145, false);
        let n = places.len();
        let astray: Vec<Vector> = (0..n).map(|v| places[v * 1009 % n]).collect();
        let [by_degree, by_places] =
            [None, Some(&astray[..])].map(|places| matrix.clone().factor(places).expect("a factor"));
        assert_eq!(by_degree.len(), by_places.len());
    }

    #[test]
    fn bits_do_not_depend_on_threads() {
        let (matrix, places) = grid(150, false);
        let right: Vec<f64> = places.iter().map(|p| p[0] - p[1]).collect();
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .expect("a pool");
            pool.install(|| {
                let solution = matrix.clone().factor(Some(&places)).expect("a factor").solve(&right);
                (dissected(&matrix, &places), solution)
            })
        };
        let one = with(1);
        assert!([2, 3].into_iter().all(|threads| with(threads) == one));
    }
}
