//! Is it the constrained least-squares optimum? The Karush-Kuhn-Tucker conditions, measured on the problem as
//! it was posed.
//!
//! x minimises the convex objective `1/2 |M x - y|^2` under `E x = e`, `A x >= b` if and only if there are
//! multipliers with `M^T (M x - y) = E^T nu + A^T u`, `u >= 0` and `u_i (A x - b)_i = 0`. Nothing here comes
//! from the solver but x and the indices of the bounds in its working set: the multipliers are the
//! least-squares solution of the first equation.

use super::active_set::Inequality;
use super::reduce::{Factored, Row};

/// The largest defect of each condition; all are zero at an exact optimum.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Kkt {
    /// Largest entry of `M^T (M x - y) - E^T nu - A^T u`, divided by the largest diagonal entry of `M^T M`:
    /// in units of x.
    pub stationarity: f64,
    /// Largest defect of an equality (continuity rows have unit norm).
    pub equality: f64,
    /// Largest violation of a bound.
    pub violation: f64,
    /// Largest distance of a working bound from equality.
    pub activity: f64,
    /// Largest negative multiplier, as a positive number, relative to the largest multiplier.
    pub negativity: f64,
    /// Largest product of multiplier and slack, relative to the largest multiplier.
    pub complementarity: f64,
}

impl Kkt {
    /// The largest of all defects.
    pub fn worst(&self) -> f64 {
        [
            self.equality,
            self.violation,
            self.activity,
            self.negativity,
            self.complementarity,
        ]
        .into_iter()
        .fold(self.stationarity, f64::max)
    }
}

/// The defects at x, and the multipliers of the working bounds.
pub(super) fn measure(
    factored: &Factored,
    (rows, y): (&[Row], &[f64]),
    (equalities, e): (&[Row], &[f64]),
    bounds: &[Inequality],
    x: &[f64],
    working: &[usize],
) -> (Kkt, Vec<f64>) {
    let n = x.len();
    let (mut gradient, mut diagonal) = (vec![0.0; n], vec![0.0; n]);
    for (row, y) in rows.iter().zip(y) {
        row.add_to(&mut gradient, row.dot(x) - y);
        for (k, value) in row.values.iter().enumerate() {
            diagonal[row.first + k] += value * value;
        }
    }
    let active: Vec<(&Row, f64)> = working.iter().map(|&i| (&bounds[i].row, bounds[i].bound)).collect();
    let (frame, independent) = factored.settle(&mut x.to_vec(), e, &active);
    let multipliers = frame.solve(&frame.project(&gradient).0);
    let (nu, u) = multipliers.split_at(independent.len());
    for (&k, nu) in independent.iter().zip(nu) {
        equalities[k].add_to(&mut gradient, -nu);
    }
    for ((row, _), u) in active.iter().zip(u) {
        row.add_to(&mut gradient, -u);
    }
    let largest = |values: &mut dyn Iterator<Item = f64>| values.map(f64::abs).fold(0.0, f64::max);
    let size = largest(&mut u.iter().copied()).max(f64::MIN_POSITIVE);
    let kkt = Kkt {
        stationarity: largest(&mut gradient.iter().copied()) / largest(&mut diagonal.iter().copied()),
        equality: largest(&mut equalities.iter().zip(e).map(|(row, e)| row.dot(x) - e)),
        violation: largest(&mut bounds.iter().map(|b| b.slack(x).min(0.0))),
        activity: largest(&mut working.iter().map(|&i| bounds[i].slack(x))),
        negativity: largest(&mut u.iter().map(|u| u.min(0.0) / size)),
        complementarity: largest(&mut working.iter().zip(u).map(|(&i, u)| bounds[i].slack(x) * u / size)),
    };
    (kkt, u.to_vec())
}
