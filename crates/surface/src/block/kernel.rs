//! The inner points of blocks, by the tensor product of a [`Line`].

use eigenring_scheme::Line;
use nalgebra::Point3;

/// A term of a rule: a source relative to the target's place, counted from one step before it in both
/// directions, and its weight.
type Term = (usize, usize, f64);

/// The tensor product of a line on a vertex net, for each class of points, in the order of the line's taps.
pub(super) struct Kernel {
    scale: usize,
    classes: Vec<Vec<Vec<Term>>>,
    /// Along a crease, where nothing is read across.
    along: Vec<Vec<Term>>,
}

impl Kernel {
    pub fn new(line: &Line<f64>) -> Self {
        let scale = line.scale();
        // the targets of a source far enough inside that nothing is negative
        let taps = |class: i32| {
            line.taps(2 * (4 * scale + class))
                .map(|(x, w)| ((x / 2 - 3) as usize, w))
        };
        let class = |i, j| {
            let across: Vec<(usize, f64)> = taps(j).collect();
            let term = |x, wx: f64| across.iter().map(move |&(y, wy)| (x, y, wx * wy));
            taps(i).flat_map(|(x, wx)| term(x, wx)).collect()
        };
        Kernel {
            scale: scale as usize,
            classes: (0..scale).map(|i| (0..scale).map(|j| class(i, j)).collect()).collect(),
            along: (0..scale).map(|i| taps(i).map(|(x, w)| (x, 1, w)).collect()).collect(),
        }
    }

    /// How many targets there are for a source in one direction.
    pub fn scale(&self) -> usize {
        self.scale
    }

    /// The inner points of a block out of the `(n+1) x (n+1)` points of a block before, both row by row.
    pub fn run(&self, block: &[Point3<f64>], n: usize, inner: &mut [Point3<f64>]) {
        let (stride, width) = (n + 1, self.scale * n - 1);
        for (row, j) in inner.chunks_exact_mut(width).zip(1..) {
            let base = (j / self.scale) * stride;
            for i in 0..self.scale {
                self.row(&self.classes[i][j % self.scale], block, base, stride, i, row);
            }
        }
    }

    /// The inner points of a side out of three rows of `n+1` points: below it, on it, above it. A crease
    /// reads the middle one alone.
    pub fn side(&self, rows: &[Point3<f64>], n: usize, crease: bool, side: &mut [Point3<f64>]) {
        let stride = n + 1;
        for i in 0..self.scale {
            let terms = if crease { &self.along[i] } else { &self.classes[i][0] };
            self.row(terms, rows, stride, stride, i, side);
        }
    }

    /// The points of class `i` of a row, of which the first one is at place 1, from the sources around
    /// `base`.
    fn row(
        &self,
        terms: &[Term],
        block: &[Point3<f64>],
        base: usize,
        stride: usize,
        i: usize,
        row: &mut [Point3<f64>],
    ) {
        // place p = scale x + i reads around source x; the first one is x = 0 or 1
        let first = if i == 0 { 1 } else { 0 };
        let skipped = self.scale * first + i - 1;
        let sources = |&(x, y, weight): &Term| (base + first + y * stride + x - stride - 1, weight);
        let targets = row.get_mut(skipped..).unwrap_or_default();
        match terms.len() {
            1 => combine::<1>(terms.iter().map(sources), block, self.scale, targets),
            2 => combine::<2>(terms.iter().map(sources), block, self.scale, targets),
            3 => combine::<3>(terms.iter().map(sources), block, self.scale, targets),
            4 => combine::<4>(terms.iter().map(sources), block, self.scale, targets),
            6 => combine::<6>(terms.iter().map(sources), block, self.scale, targets),
            9 => combine::<9>(terms.iter().map(sources), block, self.scale, targets),
            _ => {
                for (k, target) in targets.iter_mut().step_by(self.scale).enumerate() {
                    let mut sum = [0.0; 3];
                    for (start, weight) in terms.iter().map(sources) {
                        accumulate(&mut sum, weight, &block[start + k]);
                    }
                    *target = Point3::from(sum);
                }
            }
        }
    }
}

/// Each `step`-th target from as many sources, one after the other. With the number of terms known the
/// compiler keeps sums in registers.
fn combine<const TERMS: usize>(
    terms: impl Iterator<Item = (usize, f64)>,
    block: &[Point3<f64>],
    step: usize,
    targets: &mut [Point3<f64>],
) {
    let count = targets.len().div_ceil(step);
    let mut sources: [(&[Point3<f64>], f64); TERMS] = [(&[], 0.0); TERMS];
    for (source, (start, weight)) in sources.iter_mut().zip(terms) {
        *source = (&block[start..start + count], weight);
    }
    for (k, target) in targets.iter_mut().step_by(step).enumerate() {
        let mut sum = [0.0; 3];
        for (source, weight) in &sources {
            accumulate(&mut sum, *weight, &source[k]);
        }
        *target = Point3::from(sum);
    }
}

pub(super) fn accumulate(sum: &mut [f64; 3], weight: f64, point: &Point3<f64>) {
    sum[0] += weight * point.x;
    sum[1] += weight * point.y;
    sum[2] += weight * point.z;
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::{Lattice, Site, Table, Topology as Sites};

    /// The inner points of one block, seen as sites around each of its vertices.
    struct Grid {
        n: i32,
    }

    impl Sites for Grid {
        fn point(&self, centre: u32, site: Site) -> Option<u32> {
            let (mut x, mut y) = (site.x / 2, site.y / 2);
            for _ in 0..site.sector {
                (x, y) = (-y, x);
            }
            let side = self.n + 1;
            let (i, j) = (centre as i32 % side + x, centre as i32 / side + y);
            ((0..side).contains(&i) && (0..side).contains(&j)).then_some((j * side + i) as u32)
        }
    }

    #[test]
    fn block_kernels_are_the_tables_of_their_lines_bit_for_bit() {
        for line in [
            Line::cubic(),
            Line::midpoint(),
            Line::smoothing(0.3),
            Line::smoothing(1.0),
        ] {
            agrees(&line);
        }
    }

    fn agrees(line: &Line<f64>) {
        let (n, scale) = (8, line.scale() as usize);
        let grid = Grid { n: n as i32 };
        let points: Vec<Point3<f64>> = (0..(n + 1) * (n + 1))
            .map(|k| Point3::new((k as f64 * 1.7).sin(), (k as f64).cos(), k as f64 / 7.0))
            .collect();
        // a level without stencils of its own, whose terms come in another order
        let pass = |line| eigenring_scheme::Pass::regular(Lattice::Vertex, Lattice::Vertex, line);
        let mut passes = vec![pass(line.clone())];
        if scale == 1 {
            passes.push(pass(Line::midpoint()));
        }
        let level = eigenring_scheme::Level::new(eigenring_scheme::Fan::Closed(4), passes).unwrap();
        let width = scale * n - 1;
        let targets = (0..width * width).map(|k| {
            let (i, j) = (k % width + 1, k / width + 1);
            let centre = ((j / scale) * (n + 1) + i / scale) as u32;
            let site = match (i % scale, j % scale) {
                (0, 0) => Site::CENTRE,
                (1, 0) => Site { sector: 0, x: 2, y: 0 },
                (0, _) => Site { sector: 1, x: 2, y: 0 },
                _ => Site { sector: 0, x: 2, y: 2 },
            };
            (centre, site)
        });
        let targets: Vec<(u32, Site)> = targets.collect();
        let table = Table::around(&grid, 0, |_| &level, targets.iter().copied()).unwrap();
        let values: Vec<[f64; 3]> = points.iter().map(|p| [p.x, p.y, p.z]).collect();
        let expected = table.apply(&values).unwrap();
        let mut made = vec![Point3::origin(); width * width];
        Kernel::new(line).run(&points, n, &mut made);
        for ((made, expected), (_, site)) in made.iter().zip(&expected).zip(&targets) {
            // a point of spoke 1 is the table's transposed sum: equal up to the order of its terms
            if site.sector == 0 {
                assert_eq!([made.x, made.y, made.z], *expected);
            } else {
                assert!((made.x - expected[0]).abs() < 1e-15 * 100.0);
            }
        }
    }
}
