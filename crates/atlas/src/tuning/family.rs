//! The schemes of a file at a valence, over its open parameters.

use super::goal::{Condition, Goal, Measure};
use super::measured::Measured;
use crate::error::Error;
use eigenring_scheme::user::{RulesAt, UserScheme};
use eigenring_scheme::{Complex, Dual, Number};
use eigenring_spectral::{Eigenvalue, LocalSystem, fourier_block};
use eigenring_tune::minimise::{Problem, Worth};

/// A parameter that is tuned.
#[derive(Clone, Debug, PartialEq)]
pub struct Free {
    /// Its name.
    pub name: String,
    /// Its place among all parameters.
    index: usize,
    /// The ends of its range.
    pub range: [f64; 2],
    /// The same as they are written.
    ends: [Number; 2],
}

impl Free {
    /// The value at a coordinate of the unit cube, of 15 digits: with one more, numbers as people write them
    /// would not come back from their coordinates.
    pub(super) fn value(&self, x: f64) -> f64 {
        let [least, most] = self.range;
        let value = least + x * (most - least);
        let short = format!("{value:.14e}").parse().unwrap_or(value);
        f64::clamp(short, least, most)
    }

    /// A value as it is written: in decimals, or as the end of the range that it is.
    pub(super) fn written(&self, value: f64) -> String {
        match self.range {
            [least, _] if value <= least => self.ends[0].to_string(),
            [_, most] if value >= most => self.ends[1].to_string(),
            _ => format!("{value}"),
        }
    }

    /// The coordinate of a value.
    pub(super) fn coordinate(&self, value: f64) -> f64 {
        let [least, most] = self.range;
        ((value - least) / (most - least)).clamp(0.0, 1.0)
    }
}

/// The parameters of a file that are neither set nor fixed. A range of one value leaves nothing to tune.
///
/// # Errors
/// [`Error::Usage`] if there are none, or one has no range.
pub(super) fn free(scheme: &UserScheme, fixed: &[String]) -> Result<Vec<Free>, Error> {
    let mut free = Vec::new();
    for (index, parameter) in scheme.parameters().iter().enumerate() {
        let name = &parameter.name;
        if parameter.set.is_some() || fixed.contains(name) {
            continue;
        }
        let Some(ends) = &parameter.range else {
            return Err(Error::Usage {
                message: format!("the parameter {name} of {} has no range", scheme.name()),
                accepted: format!("range = [least, most] in the file, or --fix {name}"),
            });
        };
        let range = ends.each_ref().map(Number::value);
        if range[0] < range[1] {
            free.push(Free {
                name: name.clone(),
                index,
                range,
                ends: ends.clone(),
            });
        }
    }
    if free.is_empty() {
        let message = match scheme.parameters().is_empty() {
            true => format!("{} has no parameters", scheme.name()),
            false => format!("no parameter of {} is free", scheme.name()),
        };
        return Err(Error::Usage {
            message,
            accepted: "a file with [parameters] that have ranges, not all of them set or fixed".to_owned(),
        });
    }
    Ok(free)
}

/// What is searched at a valence.
pub(super) struct Family<'a> {
    pub valence: usize,
    rules: RulesAt,
    /// The values of all parameters, those of the free ones being the declared ones.
    declared: Vec<f64>,
    pub free: &'a [Free],
    goal: &'a Goal,
    conditions: &'a [Condition],
    margin: f64,
    /// Whether mu is lambda^2 whatever the parameters are.
    identity: bool,
}

impl<'a> Family<'a> {
    pub(super) fn new(
        scheme: &UserScheme,
        valence: usize,
        free: &'a [Free],
        (goal, conditions, margin): (&'a Goal, &'a [Condition], f64),
        points: &[Vec<f64>],
    ) -> Result<Self, Error> {
        let names: Vec<&str> = free.iter().map(|free| free.name.as_str()).collect();
        let mut family = Family {
            valence,
            rules: scheme.freeing(&names)?.at(valence)?,
            declared: scheme
                .parameters()
                .iter()
                .map(|known| known.at(valence).value())
                .collect(),
            free,
            goal,
            conditions,
            margin,
            identity: false,
        };
        family.look(points);
        Ok(family)
    }

    /// Looks at some points whether mu is lambda^2 whatever the parameters are: then the condition that it is
    /// not larger needs no margin.
    fn look(&mut self, points: &[Vec<f64>]) {
        if self.conditions.contains(&Condition::Bounded) {
            let tight = |point: &Vec<f64>| Measured::fast(&self.rules.scheme(&self.values(point))).is_tight();
            let known: Vec<bool> = points.iter().take(12).filter_map(tight).collect();
            self.identity = !known.is_empty() && known.iter().all(|tight| *tight);
        }
    }

    /// The declared values of the free parameters, as a point of the cube.
    pub(super) fn start(&self) -> Vec<f64> {
        let coordinate = |free: &Free| free.coordinate(self.declared[free.index]);
        self.free.iter().map(coordinate).collect()
    }

    /// The values of all parameters at a point.
    pub(super) fn values(&self, point: &[f64]) -> Vec<f64> {
        let mut values = self.declared.clone();
        for (free, &x) in self.free.iter().zip(point) {
            values[free.index] = free.value(x);
        }
        values
    }

    /// The derivatives of an eigenvalue's modulus by the free parameters, relative to it.
    fn slopes(&self, values: &[f64], system: &LocalSystem, eigenvalue: &Eigenvalue) -> Option<Vec<f64>> {
        let fourier = eigenvalue.fourier?;
        let block = system.blocks().get(fourier)?;
        let space = block.eigenspace(eigenvalue.value, fourier).ok()?;
        let ([right], [left]) = (space.right.as_slice(), space.left.as_slice()) else {
            return None;
        };
        let dot = |a: &[Complex<f64>], b: &[Complex<f64>]| {
            a.iter()
                .zip(b)
                .fold(Complex::zero(), |sum: Complex<f64>, (&a, &b)| sum + a * b)
        };
        let denominator = dot(left, right) * eigenvalue.value;
        let slope = |free: &Free| {
            let mut duals: Vec<Dual<f64>> = values.iter().map(|&value| Dual::constant(value)).collect();
            duals[free.index] = Dual::variable(values[free.index], 0);
            let scheme = self.rules.scheme(&duals);
            let block = fourier_block(scheme.limit(), system.numbering().rings, fourier).ok()?;
            let derivative = block.to_complex().map(|entry| entry.map(|part| part.parts[0]));
            // d value = l dS r / (l r), and d |value| / |value| = Re (d value / value)
            let images: Vec<Complex<f64>> = (0..derivative.rows())
                .map(|row| dot(derivative.row(row), right))
                .collect();
            let slope = (dot(left, &images) / denominator).re;
            slope.is_finite().then_some(slope * (free.range[1] - free.range[0]))
        };
        self.free.iter().map(slope).collect()
    }
}

impl Problem for Family<'_> {
    fn dimension(&self) -> usize {
        self.free.len()
    }

    fn worth(&self, point: &[f64]) -> Worth {
        let scheme = self.rules.scheme(&self.values(point));
        let measured = Measured::fast(&scheme);
        // what is cheap decides first whether the rest is needed
        let conditions = self.conditions.iter();
        let slacks: Vec<f64> = conditions
            .map(|&condition| measured.slack(condition, self.margin, self.identity))
            .collect();
        Worth {
            value: match slacks.iter().all(|slack| *slack >= 0.0) {
                true => measured.value(self.goal),
                false => 0.0,
            },
            slacks,
        }
    }

    /// The squares of `ratio` and of `lambda`, with the derivatives of eigenvalues by duals.
    fn smooth(&self, point: &[f64]) -> Option<(f64, Vec<f64>)> {
        let [(factor, measure @ (Measure::Ratio | Measure::Lambda(_)))] = self.goal.terms.as_slice() else {
            return None;
        };
        let values = self.values(point);
        let scheme = self.rules.scheme(&values);
        let measured = Measured::fast(&scheme);
        let spectrum = &measured.spectrum()?.0;
        let system = LocalSystem::new(scheme.limit(), scheme.closed_rings().ok()?).ok()?;
        let lambda = spectrum.subdominant()?;
        let by_lambda = self.slopes(&values, &system, lambda)?;
        let (distance, slopes) = match measure {
            Measure::Lambda(target) => {
                let modulus = lambda.modulus();
                let slopes: Vec<f64> = by_lambda.iter().map(|slope| modulus * slope).collect();
                (modulus - target, slopes)
            }
            _ => {
                let ratio = spectrum.curvature_ratio()?;
                let by_mu = self.slopes(&values, &system, spectrum.subsubdominant()?)?;
                let pairs = by_mu.iter().zip(&by_lambda);
                (
                    ratio - 1.0,
                    pairs.map(|(mu, lambda)| ratio * (mu - 2.0 * lambda)).collect(),
                )
            }
        };
        let distance = factor * distance;
        let gradient = slopes.iter().map(|slope| 2.0 * distance * factor * slope);
        Some((distance * distance, gradient.collect()))
    }
}
