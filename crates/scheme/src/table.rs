//! A pass as one sparse matrix.

use crate::{Error, Level, Scalar, Site};

/// The points that one pass makes, each as a combination of the points before it: a sparse matrix by rows,
/// with 32-bit indices.
///
/// What the points are, sites of a lattice or vertices, edges and faces of a mesh, does not matter here: the
/// [`Plan`](crate::Plan) of a level around one centre and the refinement of a mesh are the same tables, run
/// on different values.
#[derive(Clone, Debug, PartialEq)]
pub struct Table<S> {
    /// Where each row begins among the terms, and where the last one ends.
    starts: Vec<u32>,
    sources: Vec<u32>,
    weights: Vec<S>,
}

impl<S> Default for Table<S> {
    fn default() -> Self {
        Table {
            starts: vec![0],
            sources: Vec::new(),
            weights: Vec::new(),
        }
    }
}

impl<S: Scalar> Table<S> {
    /// An empty table with memory for so many rows and terms.
    pub fn with_capacity(rows: usize, terms: usize) -> Self {
        let mut starts = Vec::with_capacity(rows + 1);
        starts.push(0);
        Table {
            starts,
            sources: Vec::with_capacity(terms),
            weights: Vec::with_capacity(terms),
        }
    }

    /// Adds a row.
    ///
    /// # Errors
    /// [`Error::TableSize`] if there are more terms than 32 bits can count.
    pub fn push(&mut self, terms: impl IntoIterator<Item = (u32, S)>) -> Result<(), Error> {
        for (source, weight) in terms {
            self.sources.push(source);
            self.weights.push(weight);
        }
        let end = u32::try_from(self.sources.len()).map_err(|_| Error::TableSize {
            terms: self.sources.len(),
            maximum: u32::MAX as usize,
        })?;
        self.starts.push(end);
        Ok(())
    }

    /// The number of points that are made.
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// The number of terms of all rows.
    pub fn terms(&self) -> usize {
        self.sources.len()
    }

    /// The terms of a row: indices of points, and their weights.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, &S)> {
        let range = self.range(row);
        let sources = self.sources[range.clone()].iter().map(|&source| source as usize);
        sources.zip(&self.weights[range])
    }

    /// The places of a row's terms among all terms.
    pub(crate) fn range(&self, row: usize) -> std::ops::Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }

    /// The memory of the table in bytes, as it is: 4 a row, and 4 and a weight a term.
    pub fn bytes(&self) -> usize {
        4 * (self.starts.capacity() + self.sources.capacity()) + size_of::<S>() * self.weights.capacity()
    }

    /// Gives back memory that was taken in advance.
    pub fn shrink(&mut self) {
        self.starts.shrink_to_fit();
        self.sources.shrink_to_fit();
        self.weights.shrink_to_fit();
    }

    /// The points that are made of the given ones: `D` coordinates each.
    ///
    /// # Errors
    /// [`Error::TablePoint`] if a row reads a point that is not there.
    pub fn apply<const D: usize>(&self, points: &[[S; D]]) -> Result<Vec<[S; D]>, Error> {
        let count = points.len();
        if let Some(&source) = self.sources.iter().find(|&&source| source as usize >= count) {
            return Err(Error::TablePoint {
                index: source as usize,
                count,
            });
        }
        let made = |row: usize| {
            let mut sum: [S; D] = std::array::from_fn(|_| S::zero());
            for (source, weight) in self.row(row) {
                for (sum, coordinate) in sum.iter_mut().zip(&points[source]) {
                    *sum += weight.clone() * coordinate.clone();
                }
            }
            sum
        };
        Ok((0..self.rows()).map(made).collect())
    }
}

/// A net on which centres lie next to each other: where the sites around each of them are found.
pub trait Topology {
    /// The index of the point that is `site` around the centre of the given index; `None` if there is none.
    fn point(&self, centre: u32, site: Site) -> Option<u32>;
}

impl<S: Scalar> Table<S> {
    /// The table of pass `pass` of a mesh, of which `level` gives the rules around each centre: one row for
    /// each target, a centre and the site around it that is made.
    ///
    /// # Errors
    /// Those of [`Level::stencil`]; [`Error::BeyondNet`] if the topology has no point where a rule reads;
    /// [`Error::TableSize`].
    pub fn around<'a, T: Topology>(
        topology: &T,
        pass: usize,
        level: impl Fn(u32) -> &'a Level<S>,
        targets: impl IntoIterator<Item = (u32, Site)>,
    ) -> Result<Self, Error>
    where
        S: 'a,
    {
        let mut table = Table::default();
        for (centre, target) in targets {
            let stencil = level(centre).stencil(pass, target)?;
            let mut terms = Vec::with_capacity(stencil.terms().len());
            for (site, weight) in stencil.terms() {
                let source = topology.point(centre, *site).ok_or(Error::BeyondNet {
                    site: *site,
                    rings: site.ring().saturating_sub(1),
                })?;
                terms.push((source, weight.clone()));
            }
            table.push(terms)?;
        }
        table.shrink();
        Ok(table)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::families::catmull_clark;

    /// A grid of quads closed in both directions: every vertex has four sectors.
    struct Torus {
        side: i32,
    }

    impl Torus {
        fn index(&self, i: i32, j: i32) -> u32 {
            (i.rem_euclid(self.side) * self.side + j.rem_euclid(self.side)) as u32
        }

        /// Vertex points, edge points of spokes 0 and 1, face points of sector 0, around each vertex.
        fn targets(&self) -> impl Iterator<Item = (u32, Site)> {
            let site = |sector, x, y| Site { sector, x, y };
            let own = [Site::CENTRE, site(0, 2, 0), site(1, 2, 0), site(0, 2, 2)];
            (0..(self.side * self.side) as u32).flat_map(move |vertex| own.map(|site| (vertex, site)))
        }
    }

    impl Topology for Torus {
        fn point(&self, centre: u32, site: Site) -> Option<u32> {
            let (mut x, mut y) = (site.x / 2, site.y / 2);
            for _ in 0..site.sector {
                (x, y) = (-y, x);
            }
            let (i, j) = (centre as i32 / self.side, centre as i32 % self.side);
            Some(self.index(i + x, j + y))
        }
    }

    fn table(torus: &Torus) -> Table<f64> {
        let scheme = catmull_clark::<f64>(4).unwrap();
        Table::around(torus, 0, |_| scheme.limit(), torus.targets()).unwrap()
    }

    /// At regular points a kernel that runs over the lines' taps gives the same bits.
    #[test]
    fn tables_are_the_kernels_of_their_lines_bit_for_bit() {
        let torus = Torus { side: 12 };
        let scheme = catmull_clark::<f64>(4).unwrap();
        let points: Vec<[f64; 2]> = (0..144)
            .map(|i| [(i as f64 * 1.7).sin(), (i as f64 * 0.3).cos()])
            .collect();
        let made = table(&torus).apply(&points).unwrap();
        let line = scheme.limit().passes()[0].line().unwrap();
        for (row, (vertex, site)) in torus
            .targets()
            .enumerate()
            .filter(|(_, (_, site))| *site != Site::CENTRE)
        {
            let mut sum = [0.0; 2];
            for (x, wx) in line.taps(site.x) {
                for (y, wy) in line.taps(site.y) {
                    let folded = Site::new(scheme.fan(), site.sector as i64, x, y).unwrap();
                    let point = points[torus.point(vertex, folded).unwrap() as usize];
                    for (sum, coordinate) in sum.iter_mut().zip(point) {
                        *sum += wx * wy * coordinate;
                    }
                }
            }
            assert_eq!(made[row], sum);
        }
        // and the vertex rule is affine
        let ones = vec![[1.0]; 144];
        assert!(
            table(&torus)
                .apply(&ones)
                .unwrap()
                .iter()
                .all(|p| (p[0] - 1.0).abs() < 1e-15)
        );
        assert!(table(&torus).apply(&ones[1..]).is_err());
    }

    /// A quarter of a million quads become a million in one table.
    #[test]
    fn a_million_quads_fit_into_one_table() {
        let torus = Torus { side: 500 };
        let table = table(&torus);
        assert_eq!(table.rows(), 1_000_000);
        // per vertex: 9 of the vertex point, twice 6 of edge points, 4 of the face point
        assert_eq!(table.terms(), 250_000 * 25);
        assert_eq!(table.bytes(), 4 * 1_000_001 + 12 * table.terms());
        assert!(table.bytes() < 400_000_000);
    }
}
