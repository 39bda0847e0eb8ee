//! The unnormalised parts of the objective and their derivatives with respect to the coefficients of the
//! maps.
//!
//! Two passes over the Gauss points. The first computes Hessians and Jacobians and, by summing them, the
//! fitted second derivatives; the second the weights, which depend on the fit, and the squared errors. With
//! `J` the Jacobian (area per parameter area), `A = sum J` over the points with their quadrature weights, and
//! `q` the weighted squared error at a point,
//!
//! ```text
//! fit = rho <h>,  E = <q>,  <f> = sum J f / A
//! dE = ( sum [ dJ (q - E) + J q_h dh ] + (sum J q_fit) dfit ) / A
//! ```
//!
//! and `dfit` alike. `dh` is known in closed form: Hessians are linear in the height's coefficients, and with
//! respect to the corner radius, which moves (x, y), they are transported (see `jet`). So E costs one
//! evaluation and one adjoint of the error, whatever the number of coefficients.

use super::fields::{Block, Derivatives, Fields, Turns};
use super::jet::{Frame, Jet, Spin, Velocity};
use super::lanes::{Lanes, Total};
use super::maps::{self, Annuli};
use super::saddle::{self, Saddle};
use super::sectors::WeightTable;
use super::weight::Weight;

/// The numbers that make the maps of the fields.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coefficients<S> {
    /// The corner radius R.
    pub radius: S,
    /// Factors of Z0 and Z1.
    pub saddle: [S; 2],
    /// Factors of C0, C1 and C2: the first ring V, E, F of block 0.
    pub cup: [S; 3],
}

/// A number with its derivatives with respect to the corner radius and the height's coefficients.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slope<const C: usize> {
    pub value: f64,
    pub by_radius: f64,
    pub by_height: [f64; C],
}

impl<const C: usize> Slope<C> {
    const ZERO: Self = Slope {
        value: 0.0,
        by_radius: 0.0,
        by_height: [0.0; C],
    };
}

/// What an evaluation yields, unnormalised: fits and parts, saddles in the order real, imaginary.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outcome {
    pub cup_fit: f64,
    pub saddle_fits: [f64; 2],
    pub cup: Slope<3>,
    pub saddles: [Slope<2>; 2],
    /// The smallest Jacobian over the points.
    pub jacobian_min: f64,
}

/// The maps at a block of points.
#[derive(Clone, Copy)]
pub(super) struct MapBlock {
    /// Quadrature weight times Jacobian.
    area: Lanes,
    pub saddle: Saddle,
    pub cup: Spin,
}

/// Their rates of change.
#[derive(Clone, Copy)]
struct Rates {
    /// Of the area, relative, with respect to the corner radius.
    divergence: Lanes,
    /// With respect to R, then to the factors of Z0, Z1.
    saddle: [Saddle; 3],
    /// With respect to R, then to the factors of C0, C1, C2.
    cup: [Spin; 4],
}

/// Blocks whose weights are computed together: enough to hide the latency of a square root, few enough for
/// the fastest cache.
const GROUP: usize = 4;

/// The sign that tells the real from the imaginary saddle.
pub(super) const SIGNS: [f64; 2] = [1.0, -1.0];

#[inline(always)]
fn affine(base: &Derivatives, slope: &Derivatives, factor: f64) -> Derivatives {
    let mut sum = *base;
    for (sum, &slope) in sum.iter_mut().zip(slope) {
        *sum += slope * factor;
    }
    sum
}

/// Jets of all heights at a block; pairs are real and imaginary part.
struct Jets {
    frame: Frame,
    fields: [[Jet; 2]; 2],
    cups: [Jet; 3],
    saddle: [Jet; 2],
    cup: Jet,
}

impl Jets {
    #[inline(always)]
    fn new(block: &Block, c: &Coefficients<f64>) -> Jets {
        let x = affine(&block.x0[0], &block.x1[0], c.radius);
        let y = affine(&block.x0[1], &block.x1[1], c.radius);
        let frame = Frame::new(&x, &y);
        let z0 = [frame.jet(&block.z0[0]), frame.jet(&block.z0[1])];
        let z1 = [frame.jet(&block.z1[0]), frame.jet(&block.z1[1])];
        let cups = [
            frame.jet(&block.cup[0]),
            frame.jet(&block.cup[1]),
            frame.jet(&block.cup[2]),
        ];
        let ([a, b], [v, e, f]) = (c.saddle, c.cup);
        Jets {
            frame,
            saddle: [z0[0].combine(a, z1[0], b), z0[1].combine(a, z1[1], b)],
            cup: cups[0].combine(v, cups[1], e).combine(1.0, cups[2], f),
            fields: [z0, z1],
            cups,
        }
    }

    #[inline(always)]
    fn sample(&self, weight: Lanes) -> MapBlock {
        MapBlock {
            area: weight * self.frame.jacobian,
            saddle: Saddle::new(self.saddle[0].hessian, self.saddle[1].hessian),
            cup: self.cup.hessian,
        }
    }

    #[inline(always)]
    fn rates(&self, block: &Block) -> Rates {
        let velocity = Velocity::new(self.frame.jet(&block.x1[0]), self.frame.jet(&block.x1[1]));
        let [z0, z1] = &self.fields;
        Rates {
            divergence: velocity.divergence,
            saddle: [
                Saddle::new(velocity.transport(&self.saddle[0]), velocity.transport(&self.saddle[1])),
                Saddle::new(z0[0].hessian, z0[1].hessian),
                Saddle::new(z1[0].hessian, z1[1].hessian),
            ],
            cup: [
                velocity.transport(&self.cup),
                self.cups[0].hessian,
                self.cups[1].hessian,
                self.cups[2].hessian,
            ],
        }
    }
}

/// The sums of a mean `<h>` and of its derivatives.
#[derive(Clone, Copy)]
struct Moment<const R: usize> {
    value: Total,
    rates: [Total; R],
}

impl<const R: usize> Moment<R> {
    const ZERO: Self = Moment {
        value: Total::ZERO,
        rates: [Total::ZERO; R],
    };

    /// The fit `factor * value / area` and its derivatives; the first rate is that with respect to the corner
    /// radius.
    fn fit<const C: usize>(&self, factor: f64, area: f64, area_rate: f64) -> Slope<C> {
        let value = factor * self.value.sum() / area;
        Slope {
            value,
            by_radius: (factor * self.rates[0].sum() - value * area_rate) / area,
            by_height: std::array::from_fn(|i| factor * self.rates[i + 1].sum() / area),
        }
    }
}

/// From what the second derivatives' squared distance is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum From {
    /// From the best constants.
    Fit,
    /// From zero.
    Zero,
}

/// Evaluates all three parts; without `GRADIENT` the same value, bit for bit, and meaningless derivatives.
pub(super) fn evaluate<const GRADIENT: bool>(
    fields: &Fields,
    turns: &Turns,
    annuli: &Annuli,
    weight: Option<&Weight>,
    coefficients: &Coefficients<f64>,
    from: From,
) -> Outcome {
    // once for the registers that the processor has; nothing is contracted or reordered, so that the bits are
    // the same on all of them
    pulp::Arch::new().dispatch(Kernel::<GRADIENT> {
        fields,
        turns,
        annuli,
        weight,
        coefficients,
        from,
    })
}

/// The arguments of an evaluation.
struct Kernel<'a, const GRADIENT: bool> {
    fields: &'a Fields,
    turns: &'a Turns,
    annuli: &'a Annuli,
    weight: Option<&'a Weight>,
    coefficients: &'a Coefficients<f64>,
    from: From,
}

impl<const GRADIENT: bool> pulp::WithSimd for Kernel<'_, GRADIENT> {
    type Output = Outcome;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Outcome {
        at_width::<GRADIENT>(
            self.fields,
            self.turns,
            self.annuli,
            self.weight,
            self.coefficients,
            self.from,
        )
    }
}

#[inline(always)]
fn at_width<const GRADIENT: bool>(
    fields: &Fields,
    turns: &Turns,
    annuli: &Annuli,
    weight: Option<&Weight>,
    coefficients: &Coefficients<f64>,
    from: From,
) -> Outcome {
    let mut samples = Vec::with_capacity(fields.blocks.len());
    let mut rates = Vec::with_capacity(if GRADIENT { fields.blocks.len() } else { 0 });
    let mut jacobian_min = f64::INFINITY;
    let mut area = Moment::<1>::ZERO;
    let mut cup = Moment::<4>::ZERO;
    let mut saddles = [Moment::<3>::ZERO; 2];
    let fitted = |saddle: &Saddle, sign: f64| saddle.y.re + saddle.v.re * (sign * annuli.mean_turn);
    for block in &fields.blocks {
        let jets = Jets::new(block, coefficients);
        let point = jets.sample(block.weight);
        for jacobian in jets.frame.jacobian.0 {
            jacobian_min = jacobian_min.min(jacobian);
        }
        area.value += point.area;
        cup.value += point.area * point.cup.t;
        for (moment, sign) in saddles.iter_mut().zip(SIGNS) {
            moment.value += point.area * fitted(&point.saddle, sign);
        }
        if GRADIENT {
            let rate = jets.rates(block);
            let growth = point.area * rate.divergence;
            area.rates[0] += growth;
            let [by_radius, by_height @ ..] = rate.cup;
            cup.rates[0].add(&[growth * point.cup.t, point.area * by_radius.t]);
            for (sum, rate) in cup.rates[1..].iter_mut().zip(by_height) {
                *sum += point.area * rate.t;
            }
            for (moment, sign) in saddles.iter_mut().zip(SIGNS) {
                let [by_radius, by_height @ ..] = &rate.saddle;
                let moved = point.area * fitted(by_radius, sign);
                moment.rates[0].add(&[growth * fitted(&point.saddle, sign), moved]);
                for (sum, rate) in moment.rates[1..].iter_mut().zip(by_height) {
                    *sum += point.area * fitted(rate, sign);
                }
            }
            rates.push(rate);
        }
        samples.push(point);
    }
    let (total, growth) = (area.value.sum(), area.rates[0].sum());
    let (cup_fit, saddle_fits) = match from {
        From::Fit => (
            cup.fit::<3>(annuli.rho, total, growth),
            saddles.map(|moment| moment.fit::<2>(annuli.rho, total, growth)),
        ),
        From::Zero => (Slope::ZERO, [Slope::ZERO; 2]),
    };

    let mut cup = Sum::<4>::ZERO;
    let mut parts = [Sum::<3>::ZERO; 2];
    let mut table = WeightTable::new(turns, 2 * GROUP);
    for (group, points) in samples.chunks(GROUP).enumerate() {
        if let Some(weight) = weight {
            for (i, point) in points.iter().enumerate() {
                for (j, sign) in SIGNS.into_iter().enumerate() {
                    let fit = saddle_fits[j].value;
                    table.put(2 * i + j, saddle::curvature(&point.saddle, sign, fit, annuli));
                }
            }
            table.fill(weight);
        }
        for (i, point) in points.iter().enumerate() {
            let rate = rates.get(group * GROUP + i);
            let error = maps::cup(&point.cup, cup_fit.value, annuli, weight);
            cup.add(point.area, error.value, error.by_fit, rate, |rate, k| {
                error.by_hessian.dot(rate.cup[k])
            });
            for (j, sign) in SIGNS.into_iter().enumerate() {
                let weights = weight.map(|_| table.get(2 * i + j));
                let fit = saddle_fits[j].value;
                let error = saddle::error::<GRADIENT>(&point.saddle, sign, fit, annuli, turns, weights);
                parts[j].add(point.area, error.value, error.by_fit, rate, |rate, k| {
                    error.by_hessian.dot(&rate.saddle[k])
                });
            }
        }
    }
    let classes = turns.count() as f64;
    Outcome {
        cup_fit: cup_fit.value,
        saddle_fits: saddle_fits.map(|fit| fit.value),
        cup: cup.mean(&cup_fit, 1.0, total, growth),
        saddles: [0, 1].map(|i| parts[i].mean(&saddle_fits[i], classes, total, growth)),
        jacobian_min,
    }
}

/// The sums of one part.
struct Sum<const R: usize> {
    value: Total,
    /// `sum dJ q`.
    growth: Total,
    /// `sum J q_fit`.
    by_fit: Total,
    /// `sum J q_h dh`.
    rates: [Total; R],
}

impl<const R: usize> Sum<R> {
    const ZERO: Self = Sum {
        value: Total::ZERO,
        growth: Total::ZERO,
        by_fit: Total::ZERO,
        rates: [Total::ZERO; R],
    };

    #[inline(always)]
    fn add(
        &mut self,
        area: Lanes,
        value: Lanes,
        by_fit: Lanes,
        rates: Option<&Rates>,
        dot: impl Fn(&Rates, usize) -> Lanes,
    ) {
        let part = area * value;
        self.value += part;
        if let Some(rates) = rates {
            self.growth += part * rates.divergence;
            self.by_fit += area * by_fit;
            for (k, sum) in self.rates.iter_mut().enumerate() {
                *sum += area * dot(rates, k);
            }
        }
    }

    /// The part and its derivatives, from sums over `classes` sector classes.
    fn mean<const C: usize>(&self, fit: &Slope<C>, classes: f64, area: f64, area_rate: f64) -> Slope<C> {
        let divisor = classes * area;
        let value = self.value.sum() / divisor;
        let by_fit = self.by_fit.sum();
        Slope {
            value,
            by_radius: (self.growth.sum() + self.rates[0].sum() + by_fit * fit.by_radius) / divisor
                - value * area_rate / area,
            by_height: std::array::from_fn(|i| (self.rates[i + 1].sum() + by_fit * fit.by_height[i]) / divisor),
        }
    }
}

/// Extremes over all sectors and points of the Gauss curvature's numerator `z_xx z_yy - z_xy^2`,
/// unnormalised, as (min, max) of the cup and of the two saddles.
pub(super) fn curvature_extremes(
    fields: &Fields,
    turns: &Turns,
    coefficients: &Coefficients<f64>,
) -> ((f64, f64), [(f64, f64); 2]) {
    let none = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut cup, mut saddles) = (none, [none; 2]);
    let widen = |range: &mut (f64, f64), values: Lanes| {
        for value in values.0 {
            *range = (range.0.min(value), range.1.max(value));
        }
    };
    for block in &fields.blocks {
        let point = Jets::new(block, coefficients).sample(block.weight);
        widen(&mut cup, point.cup.t * point.cup.t - point.cup.s.norm_square());
        for (range, sign) in saddles.iter_mut().zip(SIGNS) {
            let (k0, k1) = point.saddle.curvature(sign);
            for turn in turns.real.iter().chain(&turns.pairs) {
                let (even, odd) = (k0 + k1.re * turn.t.re, k1.im * turn.t.im);
                widen(range, odd - even);
                widen(range, -odd - even);
            }
        }
    }
    (cup, saddles)
}
