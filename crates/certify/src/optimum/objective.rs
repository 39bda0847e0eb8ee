//! The objective of the tuning over a box of stencils.
//!
//! Ma, Wang and Ma (2023), Eqs. 11 to 20, in the frame of sector 0 and by spins: of a complex field u with
//! real part z, `z_xx + z_yy = Re L` and `D = z_xx - z_yy - 2 i z_xy = P + conj(Q)` with
//!
//! ```text
//! L = 4 u_zeta zetabar        P = 2 u_zeta zeta        Q = 2 u_zetabar zetabar
//! ```
//!
//! In the sector turned by phi, where u is `exp(2 i phi)` times as large, `L^2` and Q are turned by `t =
//! exp(4 i phi)` and P stays. With `h = z_xx`, `z_xy`, `z_yy` and fitted values a, b, c the series over the
//! annuli is, for each h, `(a - rho h)^2 + kappa h^2` with `p = lambda^2` and
//!
//! ```text
//! rho = (1-p)/(1 - p s)        kappa = p (1-p) (s-1)^2 / ((1 - p s^2) (1 - p s)^2)
//! ```
//!
//! and the fit is rho times the mean of h. The weight `w(k)` of the Gauss curvature `k`, relative to that of
//! the fitted quadratic, falls from n^2 to 1 as k grows.

use super::fields::{Fields, Jet, Point};
use crate::{Centred, Enclose, Interval};
use eigenring_scheme::lambda::Plane;
use eigenring_spline::{Complex, Scalar};

/// A box without an objective: the characteristic map folds at a point of the quadrature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fold {
    /// For every stencil of the box.
    Everywhere,
    /// For some, as far as intervals tell.
    Somewhere,
}

/// A number that depends on R alone.
type Radial = Centred<1>;
/// A number that depends on R and f3.
type Planar = Centred<2>;

/// The objective's constants and tables at one (N, lambda, s).
pub(super) struct Objective {
    pub plane: Plane<Interval>,
    fields: Fields,
    /// `t` of each class of sectors.
    turns: Vec<Complex<Interval>>,
    rho: Interval,
    kappa: Interval,
    weighted: bool,
}

/// `4 epsilon^2` and `n` of the weight, with the paper's epsilon = 0.2 and n = 5 (section 3.2.4).
const LOWER: (i64, i64) = (4, 25);
const RATIO: i64 = 5;

impl Objective {
    pub fn new(plane: Plane<Interval>, weighted: bool) -> Self {
        let (one, p, s) = (Interval::one(), plane.lambda.square(), plane.s);
        let excess = (s - one) / (one - p * s);
        let n = plane.valence as i64;
        // the classes repeat after N/gcd(N,4) sectors
        let classes = n / [4, 1, 2, 1][plane.valence % 4];
        Objective {
            fields: Fields::new(plane.valence, plane.lambda, plane.mu()),
            turns: (0..classes).map(|i| Complex::turn(2 * (2 * i + 1), n)).collect(),
            rho: (one - p) / (one - p * s),
            kappa: p * (one - p) * excess.square() / (one - p * s.square()),
            plane,
            weighted,
        }
    }

    /// The objective on a box of corner radius and f3.
    ///
    /// # Errors
    /// [`Fold`] if the characteristic map may fold at a point of the quadrature.
    pub fn over(&self, radius: Interval, f3: Interval) -> Result<Planar, Fold> {
        let maps = Maps::new(self, radius, f3);
        let radius = Radial::parameter(radius, 0);
        let mut samples = Vec::with_capacity(self.fields.points.len());
        let (mut area, mut saddle_mean, mut cup_mean) = (Radial::zero(), Planar::zero(), Planar::zero());
        for point in &self.fields.points {
            let sample = Sample::new(point, radius, &maps)?;
            area += sample.area;
            let planar = lift(sample.area);
            saddle_mean += planar * sample.p.re;
            cup_mean += planar * sample.cup_laplacian;
            samples.push(sample);
        }
        let area = lift(area);
        let half = Planar::constant(self.rho * Interval::ratio(1, 2));
        let (saddle_fit, cup_fit) = (half * saddle_mean / area, half * cup_mean / area);
        let (mut saddles, mut cup) = (Planar::zero(), Planar::zero());
        for sample in &samples {
            let planar = lift(sample.area);
            saddles += planar * self.saddles(sample, saddle_fit);
            cup += planar * self.cup(sample, cup_fit);
        }
        saddles = times(saddles, Interval::ratio(1, self.turns.len() as i64));
        Ok((maps.saddle_scale * saddles + maps.cup_scale * cup) / area)
    }

    /// Of both saddles, summed over the classes of sectors.
    fn saddles(&self, sample: &Sample, fit: Planar) -> Planar {
        let (half, quarter) = (Interval::ratio(1, 2), Interval::ratio(1, 4));
        let tau = self.rho.square() + self.kappa;
        let (p, laplacian) = (sample.p, sample.laplacian);
        let norm = square(laplacian.re) + square(laplacian.im);
        let doubled = Complex::new(
            square(laplacian.re) - square(laplacian.im),
            times(laplacian.re * laplacian.im, Interval::ratio(2, 1)),
        );
        let inverse = times(Planar::one() / square(fit), quarter);
        let mut sum = Planar::zero();
        for turn in &self.turns {
            let q = product(sample.q, *turn);
            let real = times(doubled.re, turn.re) - times(doubled.im, turn.im);
            // Re u: z_xx and -z_yy are fitted by `fit`, z_xy by 0; Im u: z_xy by `fit`, the others by 0
            let (re, im) = (p.re + q.re, p.im - q.im);
            let trace = times(norm + real, half);
            let error = times(square(fit - times(re, self.rho * half)), Interval::ratio(2, 1))
                + times(trace, tau * half)
                + times(square(re), self.kappa * half)
                + times(square(im), tau * quarter);
            sum += self.weighed((square(re) + square(im) - trace) * inverse, error);

            let (re, im) = (p.im + q.im, p.re - q.re);
            let trace = times(norm - real, half);
            let error = square(fit - times(im, self.rho * half))
                + times(square(im), self.kappa * quarter)
                + times(trace + square(re), tau * half);
            sum += self.weighed((square(re) + square(im) - trace) * inverse, error);
        }
        sum
    }

    fn cup(&self, sample: &Sample, fit: Planar) -> Planar {
        let (half, quarter) = (Interval::ratio(1, 2), Interval::ratio(1, 4));
        let tau = self.rho.square() + self.kappa;
        let laplacian = sample.cup_laplacian;
        let norm = square(sample.cup_p.re) + square(sample.cup_p.im);
        let error = times(square(fit - times(laplacian, self.rho * half)), Interval::ratio(2, 1))
            + times(square(laplacian), self.kappa * half)
            // the mean over the sectors of (z_xx - z_yy)^2/2 + z_xy^2
            + times(norm, tau * Interval::ratio(3, 8));
        let curvature = times(square(laplacian) - norm, quarter) / square(fit);
        self.weighed(curvature, error)
    }

    fn weighed(&self, curvature: Planar, error: Planar) -> Planar {
        if self.weighted {
            weight(curvature) * error
        } else {
            error
        }
    }
}

/// The maps on a box: coefficients of the fields and factors of the squares of second derivatives.
struct Maps {
    saddle: [Planar; 2],
    cup: [Planar; 3],
    saddle_scale: Planar,
    cup_scale: Planar,
}

impl Maps {
    fn new(objective: &Objective, radius: Interval, f3: Interval) -> Self {
        let plane = planar(&objective.plane);
        let (r, f3) = (Planar::parameter(radius, 0), Planar::parameter(f3, 1));
        let (two, mu) = (Planar::ratio(2, 1), plane.mu());
        let f2 = edge_weight(&plane, r, f3);
        let stencil = plane.stencil(f2, f3);
        let (f1, g1, g2, g3) = (stencil.weights.f1, stencil.g1, stencil.g2, stencil.g3);
        let saddle = [mu - f3, two * f2 * plane.cosine(1)];
        // the vector of block 0: (mu - f3) F = f1 V + 2 f2 E and (mu - g3) E = g1 V + 2 g2 mu F
        let cup = [
            two * plane.g3_and_h(f3).1 * mu - (mu - f3) * (mu - g3),
            -((mu - f3) * g1 + two * g2 * mu * f1),
            -(f1 * (mu - g3) + two * f2 * g1),
        ];
        let square_of_plane = square(form(&objective.fields.plane, &[Planar::one(), r]));
        Maps {
            saddle_scale: square_of_plane / form(&objective.fields.saddle, &saddle),
            cup_scale: square_of_plane / form(&objective.fields.cup, &cup),
            saddle,
            cup,
        }
    }
}

/// `f2` of a corner radius.
pub(super) fn edge_weight(plane: &Plane<Planar>, radius: Planar, f3: Planar) -> Planar {
    radius * (plane.lambda - f3) / (Planar::ratio(2, 1) * plane.cos_half_sector())
}

/// The plane with constants for its numbers.
pub(super) fn planar(plane: &Plane<Interval>) -> Plane<Planar> {
    Plane {
        valence: plane.valence,
        lambda: Planar::constant(plane.lambda),
        s: Planar::constant(plane.s),
        phi: Planar::constant(plane.phi),
    }
}

/// `c^T gram c` of a positive definite form.
fn form<const C: usize>(gram: &[[Interval; C]; C], c: &[Planar; C]) -> Planar {
    let mut sum = Planar::zero();
    for i in 0..C {
        sum += times(square(c[i]), gram[i][i]);
        for j in 0..i {
            sum += times(c[i] * c[j], gram[i][j] + gram[j][i]);
        }
    }
    sum
}

/// Second derivatives at one point of the quadrature.
struct Sample {
    /// Its share of the area.
    area: Radial,
    laplacian: Complex<Planar>,
    p: Complex<Planar>,
    q: Complex<Planar>,
    cup_laplacian: Planar,
    cup_p: Complex<Planar>,
}

impl Sample {
    fn new(point: &Point, radius: Radial, maps: &Maps) -> Result<Self, Fold> {
        let zeta: Jet<Complex<Radial>> = std::array::from_fn(|d| {
            let [constant, slope] = [point.plane[0][d], point.plane[1][d]];
            let part = |constant, slope| Radial::constant(constant) + times(radius, slope);
            Complex::new(part(constant.re, slope.re), part(constant.im, slope.im))
        });
        let [u, v, ..] = zeta;
        let jacobian = u.re * v.im - u.im * v.re;
        match jacobian.enclosure() {
            range if range.certainly_positive() => {}
            range if range.hi() <= 0.0 => return Err(Fold::Everywhere),
            _ => return Err(Fold::Somewhere),
        }
        // d/d zeta = a d/du + b d/dv
        let inverse = Radial::ratio(1, 2) / jacobian;
        let a = Complex::new(v.im * inverse, v.re * inverse);
        let b = Complex::new(-(u.im * inverse), -(u.re * inverse));
        let (aa, ab, bb) = (a * a, (a * b).map(double), b * b);
        let mixed = [
            square(a.re) + square(a.im),
            double(a.re * b.re + a.im * b.im),
            square(b.re) + square(b.im),
        ];
        // what the curvature of the coordinate lines takes away
        let [.., uu, uv, vv] = zeta;
        let bend = aa * uu + ab * uv + bb * vv;
        let twist = aa * uu.conj() + ab * uv.conj() + bb * vv.conj();
        let real = |z: [Complex<Radial>; 3]| {
            let part =
                |of: fn(Complex<Radial>) -> Radial| of(z[0]) * mixed[0] + of(z[1]) * mixed[1] + of(z[2]) * mixed[2];
            Complex::new(part(|z| z.re), part(|z| z.im))
        };
        let across = real([uu, uv, vv]);
        let second = [
            -(bend * a + twist * a.conj()),
            -(bend * b + twist * b.conj()),
            aa,
            ab,
            bb,
        ];
        let laplacian = [
            -double(across.real_of_product(a)),
            -double(across.real_of_product(b)),
            mixed[0],
            mixed[1],
            mixed[2],
        ];
        let saddle = point.saddle.map(|jet| {
            let mut sums = [Complex::<Radial>::zero(); 3];
            for ((value, second), laplacian) in jet.into_iter().zip(second).zip(laplacian) {
                let [l, p, q] = [
                    Complex::new(times(laplacian, value.re), times(laplacian, value.im)),
                    product(second, value),
                    product(second.conj(), value),
                ];
                sums = [sums[0] + l, sums[1] + p, sums[2] + q];
            }
            sums
        });
        let cup = point.cup.map(|jet| {
            let (mut l, mut p) = (Radial::zero(), Complex::<Radial>::zero());
            for ((value, second), laplacian) in jet.into_iter().zip(second).zip(laplacian) {
                l += times(laplacian, value);
                p += second.map(|part| times(part, value));
            }
            (l, p)
        });
        let saddle_sum = |which: usize, factor: i64| {
            let sum = |of: fn(Complex<Radial>) -> Radial| {
                let terms = [0, 1].map(|i| lift(of(saddle[i][which])) * maps.saddle[i]);
                times(terms[0] + terms[1], Interval::integer(factor))
            };
            Complex::new(sum(|z| z.re), sum(|z| z.im))
        };
        let cup_sum = |of: &dyn Fn(usize) -> Radial| {
            let terms = [0, 1, 2].map(|i| lift(of(i)) * maps.cup[i]);
            times(terms[0] + terms[1] + terms[2], Interval::integer(4))
        };
        Ok(Sample {
            area: times(jacobian, point.weight),
            laplacian: saddle_sum(0, 4),
            p: saddle_sum(1, 2),
            q: saddle_sum(2, 2),
            cup_laplacian: cup_sum(&|i| cup[i].0),
            // of a real field conj(Q) is P
            cup_p: Complex::new(cup_sum(&|i| cup[i].1.re), cup_sum(&|i| cup[i].1.im)),
        })
    }
}

fn double<const D: usize>(value: Centred<D>) -> Centred<D> {
    times(value, Interval::ratio(2, 1))
}

/// The product with a number that does not depend on the parameters.
fn times<const D: usize>(value: Centred<D>, factor: Interval) -> Centred<D> {
    let slopes = value.slopes().map(|slope| slope * factor);
    Centred::from_parts(value.central() * factor, slopes, value.enclosure() * factor)
}

/// The product with a complex constant.
fn product<const D: usize>(value: Complex<Centred<D>>, factor: Complex<Interval>) -> Complex<Centred<D>> {
    Complex::new(
        times(value.re, factor.re) - times(value.im, factor.im),
        times(value.re, factor.im) + times(value.im, factor.re),
    )
}

/// The square, never negative.
fn square<const D: usize>(value: Centred<D>) -> Centred<D> {
    let (central, range) = (value.central(), value.enclosure());
    let slopes = value.slopes().map(|slope| slope * (central + range));
    Centred::from_parts(central.square(), slopes, range.square())
}

/// A number that does not depend on f3.
fn lift(value: Radial) -> Planar {
    let [slope] = value.slopes();
    Centred::from_parts(value.central(), [slope, Interval::zero()], value.enclosure())
}

/// `w(k)`, decreasing, between n^2 and 1.
fn weight(k: Planar) -> Planar {
    let lower = Interval::ratio(LOWER.0, LOWER.1);
    let squared = Interval::integer(RATIO * RATIO);
    let upper = lower * squared;
    if !k.enclosure().is_bounded() {
        let nothing = Interval::ENTIRE;
        let range = Interval::one().hull(squared);
        return Centred::from_parts(range, [nothing; 2], range);
    }
    let roots = |k: Interval| [lower, upper].map(|term| (k.square() + term).sqrt());
    // two forms of one function, each where it does not cancel
    let value = |end: f64| {
        let k = Interval::point(end);
        let [small, large] = roots(k);
        if end >= 0.0 {
            (k + large) / (k + small)
        } else {
            squared * (small - k) / (large - k)
        }
    };
    let range = |k: Interval| {
        let (low, high) = (value(k.hi()), value(k.lo()));
        Interval::new(low.lo(), high.hi()).unwrap_or(Interval::ENTIRE)
    };
    // w' = -w (1/small - 1/large), whose bracket falls with |k|
    let bracket = |size: f64| {
        let [small, large] = roots(Interval::point(size));
        Interval::one() / small - Interval::one() / large
    };
    let all = range(k.enclosure());
    let size = k.enclosure().abs();
    let slope = -(all * bracket(size.hi()).hull(bracket(size.lo())));
    Centred::from_parts(range(k.central()), k.slopes().map(|s| s * slope), all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn weights_of_members_stay_inside(m in -3.0..3.0_f64, r in 0.0..1.0_f64, t in -1.0..1.0_f64) {
            let k = Planar::parameter(Interval::around(m, r), 0);
            let member = (m + r * t).clamp(k.enclosure().lo(), k.enclosure().hi());
            let root = |e: f64| (member + (member * member + 4.0 * e * e).sqrt()) / 2.0;
            let exact = root(1.0) / root(0.2);
            let found = weight(k);
            let near = |i: Interval| i.lo() - 1e-9 <= exact && exact <= i.hi() + 1e-9;
            prop_assert!(near(found.enclosure()));
            let reach = found.central() + found.slopes()[0] * Interval::around((member - m) / r.max(1e-300), 1e-9);
            prop_assert!(r == 0.0 || near(reach));
        }
    }
}
