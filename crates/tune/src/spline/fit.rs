//! The constrained least-squares fit of one spline.
//!
//! Minimise `sum_i w_i (f(lambda_i) - y_i)^2` over the coefficients of f, subject to
//!
//! * `f(lambda) = y` at interpolation points, exactly;
//! * all derivatives below the degree continuous at the *smooth* knots. The fit is then the one with a simple
//!   knot there, in the coefficients that inserting it until it is multiple would give;
//! * lower and upper bounds at given lambdas.
//!
//! An interior-point solution (`interior` page) says which bounds may be active, a dual active-set method
//! (`active_set` page) ends with exactly those that are, and the optimality conditions are measured
//! afterwards on the problem as posed (`kkt` page).
//!
//! If a direction of the spline space is not determined by samples and equalities (a short knot interval
//! without samples) a multiple of the curvature energy `int f''^2` is added, small against the samples' part,
//! and reported as [`Fit::energy`]. Otherwise the objective is the sum above and nothing else.

use super::active_set::{self, Inequality, Stuck};
use super::error::{FitError, Side};
use super::interior;
use super::kkt::{self, Kkt};
use super::reduce::{Factored, Row};
use eigenring_spline::{Knots, Spline};

/// A value to be approximated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Datum {
    /// The subdominant eigenvalue at which it is so.
    pub lambda: f64,
    /// The value that the spline should take there.
    pub value: f64,
    /// Weight of the squared deviation, positive.
    pub weight: f64,
}

/// Bounds on the spline at one lambda; infinite where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// The subdominant eigenvalue at which it is so.
    pub lambda: f64,
    /// Lower bound.
    pub lower: f64,
    /// Upper bound.
    pub upper: f64,
}

/// The problem of the module page.
#[derive(Clone, Copy, Debug)]
pub struct FitProblem<'a> {
    /// The spline space, of degree 2 or 3.
    pub knots: &'a Knots,
    /// What to approximate.
    pub samples: &'a [Datum],
    /// Pairs (lambda, value) to interpolate.
    pub interpolate: &'a [(f64, f64)],
    /// Bounds; equal lower and upper bounds are an interpolation.
    pub bounds: &'a [Bound],
    /// Interior knots, of whatever multiplicity, at which all derivatives below the degree are continuous.
    pub smooth: &'a [f64],
}

/// A bound that carries the optimum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActiveBound {
    /// The subdominant eigenvalue at which it is so.
    pub lambda: f64,
    /// Which side.
    pub side: Side,
    /// Its multiplier for the objective `1/2 sum w (f - y)^2`; positive.
    pub multiplier: f64,
}

/// The optimum and the evidence for it.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The spline.
    pub spline: Spline,
    /// `sum w (f - y)^2`.
    pub objective: f64,
    /// Largest `|f - y|` over the samples.
    pub max_residual: f64,
    /// The lambda of the sample with the largest residual.
    pub worst_sample: f64,
    /// The bounds that carry the optimum, independent of each other, in the order they were given. Where the
    /// spline lies on a bound over an interval, further bounds hold with equality.
    pub active: Vec<ActiveBound>,
    /// Defects of the optimality conditions.
    pub kkt: Kkt,
    /// Weight of the curvature energy; 0 if the samples determine the spline.
    pub energy: f64,
    /// Iterations of the interior-point method; 0 if it was not needed or gave up.
    pub interior_iterations: u32,
    /// Largest difference of a coefficient from the interior-point solution (0 if there is none).
    pub interior_difference: f64,
    /// Bounds taken up by the active-set method after the interior-point solution.
    pub active_set_steps: usize,
}

/// Condition number of the samples' matrix up to which the samples are said to determine the spline. Beyond
/// it, noise of 1e-8 in a sample, the accuracy of an optimiser, would show in the third digit.
const RANK_TOLERANCE: f64 = 1e-6;
/// The energy's matrix entries relative to those of the samples, if it is needed. Its square times the
/// curvature is the bias in directions which the samples do determine. Empirical.
const ENERGY: f64 = 1e-4;
/// What counts as determined once the energy is added.
const RANK_TOLERANCE_WITH_ENERGY: f64 = 1e-11;

impl FitProblem<'_> {
    /// The constrained optimum.
    ///
    /// # Errors
    /// [`FitError`]: points out of range or not finite, contradicting equalities, bounds that no spline
    /// satisfies, samples that do not determine a spline.
    pub fn solve(&self) -> Result<Fit, FitError> {
        self.check()?;
        let n = self.knots.dimension();
        let mut conditions: Vec<Condition> = Vec::new();
        for &lambda in self.smooth {
            for row in continuity(self.knots, lambda)? {
                conditions.push(Condition {
                    lambda,
                    row,
                    value: 0.0,
                });
            }
        }
        let pinned = (self.bounds.iter())
            .filter(|b| b.lower == b.upper)
            .map(|b| (b.lambda, b.lower));
        for (lambda, value) in self.interpolate.iter().copied().chain(pinned) {
            let row = self.value_row(lambda);
            conditions.push(Condition { lambda, row, value });
        }
        let equalities: Vec<Row> = conditions.iter().map(|c| c.row.clone()).collect();
        let e: Vec<f64> = conditions.iter().map(|c| c.value).collect();
        let (bounds, origin) = self.inequalities();

        let mut rows: Vec<Row> = (self.samples.iter())
            .map(|s| self.value_row(s.lambda).scaled(s.weight.sqrt()))
            .collect();
        let mut y: Vec<f64> = self.samples.iter().map(|s| s.weight.sqrt() * s.value).collect();
        let mut energy = 0.0;
        let (mut rank, free) = Factored::new(n, &rows, &equalities, RANK_TOLERANCE).rank();
        let mut tolerance = RANK_TOLERANCE;
        if rank < free {
            let curvature = energy_rows(self.knots);
            let largest = |rows: &[Row]| rows.iter().map(Row::norm).fold(0.0, f64::max);
            let factor = ENERGY * largest(&rows) / largest(&curvature);
            energy = factor * factor;
            y.resize(rows.len() + curvature.len(), 0.0);
            rows.extend(curvature.into_iter().map(|row| row.scaled(factor)));
            tolerance = RANK_TOLERANCE_WITH_ENERGY;
        }
        let factored = Factored::new(n, &rows, &equalities, tolerance);
        (rank, _) = factored.rank();
        if rank < free || self.samples.is_empty() {
            return Err(FitError::Undetermined { rank, free });
        }
        let reduced = factored.reduce(&y, &e).map_err(|index| FitError::Contradiction {
            lambda: conditions[index].lambda,
            value: conditions[index].value,
        })?;

        let guess = if bounds.is_empty() {
            None
        } else {
            interior::solve(n, &rows, &y, &equalities, &e, &bounds)
        };
        let start = guess.as_ref().map_or(&[][..], |guess| &guess.active);
        let optimum = active_set::optimum(&factored, &reduced, &e, &bounds, start)
            .map_err(|stuck| self.explain(stuck, &bounds, &origin))?;
        let (kkt, multipliers) = kkt::measure(
            &factored,
            (&rows, &y),
            (&equalities, &e),
            &bounds,
            &optimum.x,
            &optimum.working,
        );

        let interior_difference = guess.as_ref().map_or(0.0, |guess| {
            let differences = guess.x.iter().zip(&optimum.x).map(|(a, b)| (a - b).abs());
            differences.fold(0.0, f64::max)
        });
        let mut fit = Fit {
            spline: Spline::new(self.knots.clone(), optimum.x)?,
            objective: 0.0,
            max_residual: 0.0,
            worst_sample: self.samples[0].lambda,
            active: (optimum.working.iter().zip(multipliers))
                .map(|(&i, multiplier)| ActiveBound {
                    lambda: self.bounds[origin[i].0].lambda,
                    side: origin[i].1,
                    multiplier,
                })
                .collect(),
            kkt,
            energy,
            interior_iterations: guess.map_or(0, |guess| guess.iterations),
            interior_difference,
            active_set_steps: optimum.steps,
        };
        for s in self.samples {
            let residual = (self.value_row(s.lambda).dot(fit.spline.coefficients()) - s.value).abs();
            fit.objective += s.weight * residual * residual;
            if residual > fit.max_residual {
                (fit.max_residual, fit.worst_sample) = (residual, s.lambda);
            }
        }
        Ok(fit)
    }

    fn check(&self) -> Result<(), FitError> {
        let degree = self.knots.degree();
        if !(2..=3).contains(&degree) {
            return Err(FitError::Degree { degree });
        }
        let (lower, upper) = self.knots.domain();
        let samples = (self.samples.iter().enumerate()).map(|(i, s)| ("sample", i, s.lambda, s.value, s.weight));
        let points = (self.interpolate.iter().enumerate()).map(|(i, p)| ("interpolation point", i, p.0, p.1, 1.0));
        // an infinite bound is none, but +inf from below and NaN are mistakes
        let bounds = self.bounds.iter().enumerate().map(|(i, b)| {
            let bad = b.lower.is_nan() || b.upper.is_nan() || b.lower == f64::INFINITY || b.upper == f64::NEG_INFINITY;
            ("bound", i, b.lambda, if bad { b.lower + b.upper } else { 0.0 }, 1.0)
        });
        for (what, index, lambda, value, weight) in samples.chain(points).chain(bounds) {
            let inside = lower <= lambda && lambda <= upper;
            if !(inside && value.is_finite() && weight > 0.0 && weight.is_finite()) {
                return Err(FitError::Point {
                    what,
                    index,
                    lambda,
                    value,
                    lower,
                    upper,
                });
            }
        }
        match self.bounds.iter().find(|b| b.lower > b.upper) {
            Some(&Bound { lambda, lower, upper }) => Err(FitError::EmptyBand { lambda, lower, upper }),
            None => Ok(()),
        }
    }

    /// The finite bounds as inequalities, each with the index of the bound it comes from and its side.
    fn inequalities(&self) -> (Vec<Inequality>, Vec<(usize, Side)>) {
        let mut inequalities = Vec::new();
        let mut origin = Vec::new();
        for (i, b) in self.bounds.iter().enumerate().filter(|(_, b)| b.lower < b.upper) {
            for (side, sign, bound) in [(Side::Lower, 1.0, b.lower), (Side::Upper, -1.0, b.upper)] {
                if bound.is_finite() {
                    inequalities.push(Inequality {
                        row: self.value_row(b.lambda).scaled(sign),
                        bound: sign * bound,
                    });
                    origin.push((i, side));
                }
            }
        }
        (inequalities, origin)
    }

    /// The basis functions at lambda, which `check` found in the domain.
    fn value_row(&self, lambda: f64) -> Row {
        value_row(self.knots, lambda)
    }

    fn explain(&self, stuck: Stuck, bounds: &[Inequality], origin: &[(usize, Side)]) -> FitError {
        match stuck {
            Stuck::Steps { steps, violation } => FitError::NotConverged { steps, violation },
            Stuck::Infeasible {
                bound,
                value,
                conflicts,
            } => {
                let (index, side) = origin[bound];
                let sign = if side == Side::Lower { 1.0 } else { -1.0 };
                FitError::Infeasible {
                    lambda: self.bounds[index].lambda,
                    side,
                    bound: sign * bounds[bound].bound,
                    value: sign * value,
                    conflicts: conflicts.iter().map(|&i| self.bounds[origin[i].0].lambda).collect(),
                }
            }
        }
    }
}

struct Condition {
    lambda: f64,
    row: Row,
    value: f64,
}

/// The row of basis values at `lambda`, or at the nearer end of the domain.
pub(super) fn value_row(knots: &Knots, lambda: f64) -> Row {
    let (lower, upper) = knots.domain();
    let lambda = lambda.clamp(lower, upper);
    let span = knots.span(lambda).unwrap_or(knots.degree());
    let basis = knots.basis(span, lambda);
    Row {
        first: basis.first,
        values: basis.values,
    }
}

/// The conditions that derivatives 1 to p-1 are the same on both sides of a knot, scaled to unit norm; only
/// those which its multiplicity leaves open. Derivatives beyond the second are not needed: degree 3 is the
/// highest that is fitted.
pub(super) fn continuity(knots: &Knots, lambda: f64) -> Result<Vec<Row>, FitError> {
    let (lower, upper) = knots.domain();
    let spans = knots.span_before(lambda).zip(knots.span(lambda));
    let Some((left, right)) = spans.filter(|(left, right)| left < right && lower < lambda && lambda < upper) else {
        return Err(FitError::NotAKnot { lambda });
    };
    let (before, after) = (knots.basis(left, lambda), knots.basis(right, lambda));
    let jump = |before_values: &[f64], after_values: &[f64]| {
        let mut values = vec![0.0; after.first + after_values.len() - before.first];
        for (value, derivative) in values.iter_mut().zip(before_values) {
            *value = -derivative;
        }
        for (value, derivative) in values[after.first - before.first..].iter_mut().zip(after_values) {
            *value += derivative;
        }
        let row = Row {
            first: before.first,
            values,
        };
        let norm = row.norm();
        row.scaled(1.0 / norm)
    };
    // a knot of multiplicity m has p - m continuous derivatives by itself
    let continuous = knots.degree() - (right - left);
    let jumps = [
        (&before.first_derivatives, &after.first_derivatives),
        (&before.second_derivatives, &after.second_derivatives),
    ];
    let open = jumps.iter().take(knots.degree() - 1).skip(continuous);
    Ok(open.map(|(before, after)| jump(before, after)).collect())
}

/// Rows K with `|K x|^2 = int f''^2`: two Gauss points a span, exact for cubics.
pub(super) fn energy_rows(knots: &Knots) -> Vec<Row> {
    let mut rows = Vec::new();
    for span in knots.spans() {
        let (start, end) = (knots.values()[span], knots.values()[span + 1]);
        let (centre, half) = (0.5 * (start + end), 0.5 * (end - start));
        for sign in [-1.0, 1.0] {
            let basis = knots.basis(span, centre + sign * half / 3.0_f64.sqrt());
            let row = Row {
                first: basis.first,
                values: basis.second_derivatives,
            };
            rows.push(row.scaled(half.sqrt()));
        }
    }
    rows
}
