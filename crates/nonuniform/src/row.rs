//! Rows of sparse matrices while they are made.

/// Weights of points, each point once.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Row(Vec<(u32, f64)>);

impl Row {
    pub fn unit(point: u32) -> Self {
        Row(vec![(point, 1.0)])
    }

    pub fn push(&mut self, point: u32, weight: f64) {
        match self.0.iter_mut().find(|(known, _)| *known == point) {
            Some((_, sum)) => *sum += weight,
            None => self.0.push((point, weight)),
        }
    }

    pub fn add(&mut self, weight: f64, row: &Row) {
        for &(point, own) in &row.0 {
            self.push(point, weight * own);
        }
    }

    /// Weights of points that are known to be different.
    pub fn of(terms: impl IntoIterator<Item = (u32, f64)>) -> Self {
        let mut row = Row::default();
        for (point, weight) in terms {
            row.push(point, weight);
        }
        row
    }

    /// Whether two rows differ by rounding only.
    pub fn is_close(&self, other: &Row) -> bool {
        let mut difference = self.clone();
        difference.add(-1.0, other);
        difference.0.iter().all(|(_, weight)| weight.abs() < 1e-12)
    }

    /// The terms that are not zero.
    pub fn terms(&self) -> impl Iterator<Item = (u32, f64)> + '_ {
        self.0.iter().copied().filter(|(_, weight)| *weight != 0.0)
    }

    /// The combination of points with any numbers.
    pub fn applied<const D: usize>(&self, points: &[[f64; D]]) -> [f64; D] {
        let mut sum = [0.0; D];
        for &(point, weight) in &self.0 {
            for (sum, x) in sum.iter_mut().zip(points[point as usize]) {
                *sum += weight * x;
            }
        }
        sum
    }
}
