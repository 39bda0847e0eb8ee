//! How far a stencil's second-order maps are from quadratics: the objective of the tuning.
//!
//! Ma, Wang and Ma, *An unified lambda-subdivision scheme for quadrilateral meshes with optimal curvature
//! performance in extraordinary regions*, ACM TOG 42(6) 209, 2023, Eqs. 11 to 20 and 33. Let (x, y) be the
//! eigenfunctions of lambda around an extraordinary vertex and z_1, z_2, z_3 those of mu: a cup from Fourier
//! block 0 and two saddles from block 2. A surface is curvature continuous there exactly if each z_i is a
//! quadratic in (x, y). The objective sums, over the three maps,
//!
//! ```text
//! E_i = int w_i [ (z_xx - a)^2 + (z_xy - b)^2 + (z_yy - c)^2 ] / int 1        over Omega, dx dy
//! ```
//!
//! with a, b, c the best constants without the weight, and w_i (see `weight`) between 1 and n^2 where the
//! Gauss curvature has the wrong sign. Omega is a disc of self-similar annuli lambda^m Omega_0; its integrals
//! are geometric series over those of the regular annulus Omega_0 (see `maps`), computed by Gauss quadrature.
//!
//! Everything that does not depend on the free weights (f2, f3) is tabulated by [`Objective::new`] for one
//! (valence, lambda, s): eleven fields of which the maps are combinations of six coefficients (see `fields`).
//! An evaluation then needs no linear algebra (see `evaluate`), and the gradient is exact. At N = 4, where f3
//! must be mu, the objective is a function of f2 alone: the given f3 is not used and its derivative is zero.

#[cfg(test)]
mod direct;
mod evaluate;
mod fields;
mod jet;
mod lanes;
mod maps;
mod rings;
mod saddle;
mod sectors;
mod settings;
#[cfg(test)]
mod tests;
mod weight;

pub use settings::{Error, Normalisation, Settings};

use eigenring_scheme::lambda::Plane;
use eigenring_spectral::SecondOrder;
use eigenring_spline::{Dual, Scalar};
use evaluate::{Coefficients, From, Outcome, SIGNS, Slope, curvature_extremes, evaluate};
use fields::{Fields, Turns};
use maps::Annuli;
pub(crate) use weight::Weight;

/// A number and its derivatives with respect to f2 and f3.
type Dual2 = Dual<f64, 2>;

/// The objective at one (valence, lambda, s), as a function of (f2, f3).
#[derive(Clone, Debug)]
pub struct Objective {
    plane: Plane<f64>,
    settings: Settings,
    fields: Fields,
    turns: Turns,
    annuli: Annuli,
    weight: Option<Weight>,
    gram: Gram,
}

/// One second-order map's share of the objective.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// The weighted squared error E_i.
    pub value: f64,
    /// Fitted z_xx.
    pub a: f64,
    /// Fitted z_xy.
    pub b: f64,
    /// Fitted z_yy.
    pub c: f64,
    /// Smallest `z_xx z_yy - z_xy^2` over the Gauss points of all sectors.
    pub gauss_min: f64,
    /// Largest `z_xx z_yy - z_xy^2` over the Gauss points of all sectors.
    pub gauss_max: f64,
}

/// The objective taken apart; all numbers are in the scale of the chosen normalisation.
///
/// Signs of the eigenvectors: the cup has its edge neighbours at positive height, the real saddle is
/// symmetric about the x axis, where its first edge neighbour has positive height, and the imaginary saddle
/// is the real one turned by an eighth of a turn. At N = 4 the two saddles are the mode on the edge points
/// and the mode on the face points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parts {
    /// The map of block 0.
    pub cup: Part,
    /// The real part of the map of block 2.
    pub saddle_re: Part,
    /// The imaginary part of the map of block 2.
    pub saddle_im: Part,
    /// Smallest Jacobian of the characteristic map over the Gauss points, with (x, y) scaled so that the
    /// first edge neighbour is (1, 0).
    pub jacobian_min: f64,
}

impl Parts {
    /// The objective: the sum of the three values.
    pub fn total(&self) -> f64 {
        self.cup.value + self.saddle_re.value + self.saddle_im.value
    }

    /// `K_m` (Eq. 33): how far the Gauss curvatures reach to the wrong side of zero. Only the numerators of
    /// the curvatures enter, so it is the sign and the zero that have a meaning.
    pub fn sign_change(&self) -> f64 {
        (-self.cup.gauss_min).max(0.0) + self.saddle_re.gauss_max.max(0.0) + self.saddle_im.gauss_max.max(0.0)
    }
}

impl Objective {
    /// Tabulates the fields.
    ///
    /// # Errors
    /// [`Error`] if the plane's or the settings' numbers are out of range, or lambda or mu meets an
    /// eigenvalue of the outer rings.
    pub fn new(plane: Plane<f64>, settings: Settings) -> Result<Objective, Error> {
        settings.validate()?;
        Plane::new(plane.valence, plane.lambda, plane.s)?;
        if !(plane.phi >= 0.0 && plane.phi.is_finite()) {
            return Err(Error::Phi { phi: plane.phi });
        }
        for eigenvalue in [plane.lambda, plane.mu()] {
            for outer in [0.125, 0.0625, 0.03125, 0.015625] {
                // at this distance nine of the sixteen digits of the eigenvector are lost
                if (eigenvalue - outer).abs() < 1e-9 * outer {
                    return Err(Error::Resonance { eigenvalue, outer });
                }
            }
        }
        let fields = Fields::new(&plane, settings.quadrature_order);
        let mean_turn = fields::mean_turn(plane.valence);
        Ok(Objective {
            plane,
            settings,
            gram: Gram::new(&fields, plane.valence, mean_turn),
            fields,
            turns: Turns::new(plane.valence),
            annuli: Annuli::new(plane.lambda, plane.s, mean_turn),
            weight: settings.weighted.then(|| Weight::new(settings.epsilon, settings.n)),
        })
    }

    /// Valence, lambda, s and phi.
    pub fn plane(&self) -> &Plane<f64> {
        &self.plane
    }

    /// The constants.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The objective at (f2, f3).
    ///
    /// # Errors
    /// [`Error::NotFinite`] and [`Error::Folded`]. Feasibility of the stencil is not asked for.
    pub fn value(&self, f2: f64, f3: f64) -> Result<f64, Error> {
        let coefficients = self.coefficients(f2, f3);
        let outcome = self.outcome::<false>(&coefficients, f2, f3)?;
        let total = self.total(&coefficients, &outcome);
        finite(total.value, f2, f3)
    }

    /// The objective at (f2, f3), the same bits as [`Objective::value`], and its derivatives with respect to
    /// f2 and f3.
    ///
    /// # Errors
    /// As for [`Objective::value`].
    pub fn value_and_gradient(&self, f2: f64, f3: f64) -> Result<(f64, [f64; 2]), Error> {
        let coefficients = self.coefficients(f2, f3);
        let outcome = self.outcome::<true>(&coefficients, f2, f3)?;
        let Dual { value, parts } = self.total(&coefficients, &outcome);
        finite(value + parts[0] + parts[1], f2, f3)?;
        Ok((value, parts))
    }

    /// The objective at (f2, f3) taken apart.
    ///
    /// # Errors
    /// As for [`Objective::value`].
    pub fn parts(&self, f2: f64, f3: f64) -> Result<Parts, Error> {
        let coefficients = self.coefficients(f2, f3);
        let outcome = self.outcome::<false>(&coefficients, f2, f3)?;
        let plain = plain(&coefficients);
        let (cup_range, saddle_ranges) = curvature_extremes(&self.fields, &self.turns, &plain);
        let scales = self.scales(&coefficients);
        // second derivatives scale by `scale`, which carries the eigenvector's sign; their products by its
        // square
        let part = |value: f64, scale: f64, [a, b, c]: [f64; 3], (min, max): (f64, f64)| Part {
            value: value * scale * scale,
            a: a * scale,
            b: b * scale,
            c: c * scale,
            gauss_min: min * scale * scale,
            gauss_max: max * scale * scale,
        };
        let [re, im] = outcome.saddle_fits;
        let parts = Parts {
            cup: part(
                outcome.cup.value,
                scales.cup.value,
                [outcome.cup_fit, 0.0, outcome.cup_fit],
                cup_range,
            ),
            saddle_re: part(
                outcome.saddles[0].value,
                scales.saddles[0].value,
                [re, 0.0, -re],
                saddle_ranges[0],
            ),
            saddle_im: part(
                outcome.saddles[1].value,
                scales.saddles[1].value,
                [0.0, im, 0.0],
                saddle_ranges[1],
            ),
            jacobian_min: outcome.jacobian_min,
        };
        let sum = parts.total() + parts.sign_change() + parts.cup.a + parts.saddle_re.a + parts.saddle_im.b;
        finite(sum, f2, f3)?;
        Ok(parts)
    }

    /// The coefficients of the maps and their derivatives with respect to (f2, f3).
    ///
    /// The first ring of the cup is the null vector of `(mu - f3) F = f1 V + 2 f2 E`, `(mu - g3) E = g1 V + 2
    /// g2 mu F`, the cross product of the two rows.
    fn coefficients(&self, f2: f64, f3: f64) -> Coefficients<Dual2> {
        let constant = Dual2::constant;
        let two = Dual2::ratio(2, 1);
        let plane = Plane {
            valence: self.plane.valence,
            lambda: constant(self.plane.lambda),
            s: constant(self.plane.s),
            phi: constant(self.plane.phi),
        };
        let mu = plane.mu();
        let f2 = Dual2::variable(f2, 0);
        let f3 = if plane.valence == 4 { mu } else { Dual2::variable(f3, 1) };
        let stencil = plane.stencil(f2, f3);
        let (f1, g1, g3, h) = (stencil.weights.f1, stencil.g1, stencil.g3, two * stencil.g2 * f2);
        Coefficients {
            radius: plane.corner_radius(f2, f3),
            // two saddles of one block are its points on the spokes and on the diagonals
            saddle: if SecondOrder::copies_in(plane.valence, 2) == 2 {
                [Dual2::one(); 2]
            } else {
                [mu - f3, two * f2 * plane.cosine(1)]
            },
            cup: [
                two * h * mu - (mu - f3) * (mu - g3),
                -((mu - f3) * g1 + two * stencil.g2 * mu * f1),
                -(f1 * (mu - g3) + two * f2 * g1),
            ],
        }
    }

    fn outcome<const GRADIENT: bool>(&self, c: &Coefficients<Dual2>, f2: f64, f3: f64) -> Result<Outcome, Error> {
        let plain = plain(c);
        let finite = (plain.saddle.iter()).chain(&plain.cup).all(|c| c.is_finite());
        if !(f2.is_finite() && f3.is_finite() && finite && plain.radius.is_finite()) {
            return Err(Error::NotFinite { f2, f3 });
        }
        let weight = self.weight.as_ref();
        let outcome = evaluate::<GRADIENT>(&self.fields, &self.turns, &self.annuli, weight, &plain, From::Fit);
        let jacobian = outcome.jacobian_min;
        if jacobian > 0.0 {
            Ok(outcome)
        } else {
            Err(Error::Folded { f2, f3, jacobian })
        }
    }

    /// The sum of the parts in the chosen normalisation.
    fn total(&self, coefficients: &Coefficients<Dual2>, outcome: &Outcome) -> Dual2 {
        let scales = self.scales(coefficients);
        let [re, im] = [0, 1].map(|i| {
            let part = chain(&outcome.saddles[i], coefficients.radius, &coefficients.saddle);
            scales.saddles[i] * scales.saddles[i] * part
        });
        let cup = chain(&outcome.cup, coefficients.radius, &coefficients.cup);
        scales.cup * scales.cup * cup + re + im
    }

    /// The factors of the second derivatives: scale of z over the square of that of x, y.
    fn scales(&self, coefficients: &Coefficients<Dual2>) -> Scales {
        let Coefficients { radius, saddle, cup } = coefficients;
        // at N = 4 both saddles have unit first rings
        let (edge, cup_edge) = (saddle[0], cup[1]);
        match self.settings.normalisation {
            Normalisation::UnitRing => Scales {
                cup: Dual2::one() / cup_edge,
                saddles: [Dual2::one() / edge; 2],
            },
            Normalisation::Paper => {
                let square = form(&self.gram.plane, &[Dual2::one(), *radius]);
                let scale = |norm_square: Dual2, like: Dual2| {
                    let scale = square / norm_square.sqrt();
                    if like.value < 0.0 { -scale } else { scale }
                };
                Scales {
                    cup: scale(form(&self.gram.cup, cup), cup_edge),
                    saddles: self.gram.saddles.map(|gram| scale(form(&gram, saddle), edge)),
                }
            }
            Normalisation::Relative => {
                let plain = plain(coefficients);
                let squares = evaluate::<true>(&self.fields, &self.turns, &self.annuli, None, &plain, From::Zero);
                let scale = |mean_square: Dual2, like: Dual2| {
                    let scale = Dual2::one() / mean_square.sqrt();
                    if like.value < 0.0 { -scale } else { scale }
                };
                Scales {
                    cup: scale(chain(&squares.cup, *radius, cup), cup_edge),
                    saddles: squares
                        .saddles
                        .map(|square| scale(chain(&square, *radius, saddle), edge)),
                }
            }
        }
    }
}

/// The values of the coefficients.
fn plain(coefficients: &Coefficients<Dual2>) -> Coefficients<f64> {
    Coefficients {
        radius: coefficients.radius.value,
        saddle: coefficients.saddle.map(|c| c.value),
        cup: coefficients.cup.map(|c| c.value),
    }
}

struct Scales {
    cup: Dual2,
    saddles: [Dual2; 2],
}

/// Squared Euclidean norms over all points of the five rings, as quadratic forms in the coefficients.
#[derive(Clone, Copy, Debug)]
struct Gram {
    /// Of x, and equally of y.
    plane: [[f64; 2]; 2],
    saddles: [[[f64; 2]; 2]; 2],
    cup: [[f64; 3]; 3],
}

impl Gram {
    /// Sector phi carries `Re exp(i phi) X` and `Re exp(2 i phi) Z`, whose squares sum to `N/2 (|X|^2)` and
    /// `N/2 (|Z|^2 + mean_turn Re Z^2)`; the cup has the centre as well.
    fn new(fields: &Fields, valence: usize, mean_turn: f64) -> Gram {
        let n = valence as f64;
        let table = |i: usize, j: usize| fields.z[i].products(&fields.z[j]);
        Gram {
            plane: square(|i, j| n / 2.0 * fields.x[i].products(&fields.x[j]).0),
            saddles: SIGNS.map(|sign| {
                square(|i, j| {
                    let (norm, bare) = table(i, j);
                    n / 2.0 * (norm + sign * mean_turn * bare)
                })
            }),
            cup: square(|i, j| {
                let centre = fields.cup[i].at(0, 0).dot(fields.cup[j].at(0, 0));
                centre + n * fields.cup[i].products(&fields.cup[j]).0
            }),
        }
    }
}

fn square<const C: usize>(entry: impl Fn(usize, usize) -> f64) -> [[f64; C]; C] {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// `c^T gram c`.
fn form<const C: usize>(gram: &[[f64; C]; C], c: &[Dual2; C]) -> Dual2 {
    let mut sum = Dual2::zero();
    for (row, &ci) in gram.iter().zip(c) {
        for (&entry, &cj) in row.iter().zip(c) {
            sum += Dual2::constant(entry) * ci * cj;
        }
    }
    sum
}

/// The chain rule from the coefficients to (f2, f3).
fn chain<const C: usize>(slope: &Slope<C>, radius: Dual2, height: &[Dual2; C]) -> Dual2 {
    Dual {
        value: slope.value,
        parts: std::array::from_fn(|j| {
            let height: f64 = (slope.by_height.iter().zip(height))
                .map(|(by, c)| by * c.parts[j])
                .sum();
            slope.by_radius * radius.parts[j] + height
        }),
    }
}

fn finite(value: f64, f2: f64, f3: f64) -> Result<f64, Error> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(Error::NotFinite { f2, f3 })
    }
}
