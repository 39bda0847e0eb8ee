//! Signs of the Gauss curvature of second-order maps.
//!
//! A second-order map z over the characteristic map (x, y) is meant to be a cup with `z_xx z_yy - z_xy^2 > 0`
//! everywhere or a saddle with `< 0`; `K_m` of Ma, Wang and Ma (2023, Eq. 33) collects the worst values of
//! the cup and of two saddles. With J the Jacobian and, for w = uu, uv, vv,
//!
//! ```text
//! L_w = J z_w + z_u (x_v y_w - y_v x_w) + z_v (y_u x_w - x_u y_w)
//! ```
//!
//! (the determinants that give the second fundamental form) the chain rule gives `z_xx z_yy - z_xy^2 = K /
//! J^4` with the polynomial `K = L_uu L_vv - L_uv^2` of degrees `6 d - 4`. Raised to the degrees `8 d - 4` of
//! `J^4`, the quotient is a rational Bezier function: where all coefficients `w_i` of `J^4` are positive its
//! values are convex combinations of the quotients `k_i / w_i` of coefficients, whose smallest is therefore a
//! bound. On parts of the patches it converges to the extreme value, quadratically with their size.
//!
//! **Sectors.** A cup (index 0) and a mode of index N/2 look the same in every sector, up to sign. The pair
//! of saddles `z1 + i z2` of another index k turns with the sectors by `phi = 2 pi k j / N`. K is a quadratic
//! form in z; with its bilinear form `K_ab` on sector 0 the two maps have, in sector j,
//!
//! ```text
//! (K_11 + K_22) / 2 +- ((K_11 - K_22) / 2 cos 2 phi - K_12 sin 2 phi),
//! ```
//!
//! so three polynomials `P_0, P_1, P_2` of one sector serve all. A bound for all phases, `P_0 -+ |(P_1,
//! P_2)|`, is tried first.
//!
//! **Scaling.** Values are those of maps with unit Euclidean norm of x and z over the net, as the paper's:
//! they carry the factor `|x|^4 / |z|^2`. On the image of the annulus under m scalings, K has the same sign.

use super::regular::between;
use super::{NetError, Place, PlaneNet, Subdivision, check_symmetry};
use crate::{Enclose, Interval, Status};
use eigenring_spectral::PatchIndex;
use eigenring_spline::Scalar;
use eigenring_spline::bernstein::{Coefficient, Polynomial, Scaled};
use eigenring_spline::uniform::to_bernstein;
use serde::{Deserialize, Serialize};

/// The heights of second-order maps over a plane net: one real mode, or real and imaginary part of a complex
/// one.
#[derive(Clone, Debug)]
pub struct Heights<S> {
    fourier: usize,
    parts: Vec<Vec<S>>,
}

/// The sign the Gauss curvature should have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sign {
    /// A cup.
    Positive,
    /// A saddle.
    Negative,
}

/// A claim about the Gauss curvature of the maps of [`Heights`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurvatureEvidence {
    /// The parts of each of [`PlaneNet::patches`] whose coefficients give the bound.
    pub patches: Vec<Subdivision>,
    /// For each map a place, on one of these patches or its image in another sector, where the curvature is
    /// nearest to the wrong sign, or has it.
    pub places: Vec<Place>,
}

/// The extreme Gauss curvature of one map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurvatureRange {
    /// Proven: the sign holds everywhere. Refuted: it does not at `place`.
    pub status: Status,
    /// The smallest `z_xx z_yy - z_xy^2` of a cup, the largest of a saddle.
    pub extreme: Interval,
    /// Where the inner bound of `extreme` is met.
    pub place: Option<Place>,
    /// Parts examined, for all maps together.
    pub cells: usize,
    /// The depth of the finest subdivision.
    pub depth: usize,
}

impl<S: Enclose> Heights<S> {
    /// The heights of a mode of Fourier index `fourier` over the same numbering as the plane net.
    ///
    /// # Errors
    /// [`NetError`] where lengths or number of parts do not fit, or the values contradict the symmetry.
    pub fn new(net: &PlaneNet<S>, fourier: usize, parts: Vec<Vec<S>>) -> Result<Self, NetError> {
        let (numbering, sectors) = (net.annulus().numbering, net.sectors());
        if fourier >= sectors {
            return Err(NetError::Fourier { fourier, sectors });
        }
        let expected = if (2 * fourier).is_multiple_of(sectors) { 1 } else { 2 };
        if parts.len() != expected {
            return Err(NetError::Parts {
                fourier,
                found: parts.len(),
                expected,
            });
        }
        for part in &parts {
            if part.len() != numbering.count() {
                return Err(NetError::Length {
                    found: part.len(),
                    expected: numbering.count(),
                });
            }
        }
        let at = |part: usize, index: usize| {
            parts
                .get(part)
                .map_or(Interval::point(0.0), |z: &Vec<S>| z[index].enclosure())
        };
        let check = |signs| check_symmetry(numbering, fourier, signs, |index| [at(0, index), at(1, index)]);
        match (net.mirror, expected) {
            (false, _) => check(None)?,
            (true, 2) => check(Some([1, -1]))?,
            // a real mode may be even or odd
            (true, _) => check(Some([1, 1])).or_else(|_| check(Some([-1, 1])))?,
        }
        Ok(Heights { fourier, parts })
    }

    /// The heights of the middles, in floating point.
    pub fn middle(&self) -> Heights<f64> {
        let parts = self
            .parts
            .iter()
            .map(|z| z.iter().map(|value| value.central().mid()).collect());
        Heights {
            fourier: self.fourier,
            parts: parts.collect(),
        }
    }

    /// `|x|^4 / |z|^2` of a part, see the module page.
    fn factor(&self, net: &PlaneNet<S>, part: usize) -> Interval {
        let square = |values: &[S]| values.iter().map(|value| value.enclosure().square()).sum::<Interval>();
        square(&net.x).square() / square(&self.parts[part])
    }
}

impl<S> Heights<S> {
    /// The number of maps.
    pub fn maps(&self) -> usize {
        self.parts.len()
    }

    /// The phases `2 phi` that occur, in units of a turn over N.
    pub(super) fn phases(&self, sectors: usize) -> Vec<usize> {
        let mut phases: Vec<usize> = (0..sectors).map(|sector| self.phase(sector, sectors)).collect();
        phases.sort_unstable();
        phases.dedup();
        phases
    }

    /// `2 phi` in a sector, in units of a turn over N.
    pub(super) fn phase(&self, sector: usize, sectors: usize) -> usize {
        2 * self.fourier * sector % sectors
    }
}

/// The polynomials of one patch, of equal degrees: `J^4`, then K for one map or `P_0, P_1, P_2` for a pair.
pub(super) fn forms<S: Coefficient>(net: &PlaneNet<S>, heights: &Heights<S>, patch: PatchIndex) -> Vec<Polynomial<S>> {
    let conversion = to_bernstein::<S>(net.annulus().degree);
    let scaled = |f: Polynomial<S>| f.scaled();
    let [x, y] = net.coordinates(patch, &conversion);
    let [xu, xv, yu, yv] = [x.by_u(), x.by_v(), y.by_u(), y.by_v()].map(scaled);
    let second = |f: &Polynomial<S>| [f.by_u().by_u(), f.by_u().by_v(), f.by_v().by_v()].map(scaled);
    let jacobian = xu.product(&yv).minus(&xv.product(&yu));
    let (xw, yw) = (second(&x), second(&y));
    let by_u: [_; 3] = std::array::from_fn(|w| xv.product(&yw[w]).minus(&yv.product(&xw[w])));
    let by_v: [_; 3] = std::array::from_fn(|w| yu.product(&xw[w]).minus(&xu.product(&yw[w])));
    let control = net.annulus().control(patch);
    let forms: Vec<_> = heights
        .parts
        .iter()
        .map(|values| {
            let values: Vec<S> = control.iter().map(|&index| values[index]).collect();
            let z = Polynomial::from_control(&values, &conversion);
            let (zu, zv, zw) = (z.by_u().scaled(), z.by_v().scaled(), second(&z));
            let form = |w: usize| {
                let own = jacobian.product(&zw[w]);
                own.plus(&zu.product(&by_u[w])).plus(&zv.product(&by_v[w]))
            };
            [form(0), form(1), form(2)]
        })
        .collect();
    let square = jacobian.product(&jacobian);
    let raised = Scaled::one([2 * net.annulus().degree; 2]);
    let curvature = |a: &[Scaled<S>; 3], b: &[Scaled<S>; 3]| a[0].product(&b[2]).minus(&a[1].product(&b[1]));
    let polynomial = |k: Scaled<S>| k.product(&raised).unscaled();
    let mut result = vec![square.product(&square).unscaled()];
    match forms.as_slice() {
        [a, b] => {
            let half = S::ratio(1, 2);
            let (first, second) = (curvature(a, a), curvature(b, b));
            // the two orders of a and b differ in which one gives L_uu
            let mixed = curvature(a, b).plus(&curvature(b, a));
            result.extend([first.plus(&second), first.minus(&second), mixed].map(|k| polynomial(k).times(half)));
        }
        forms => result.extend(forms.iter().map(|l| polynomial(curvature(l, l)))),
    }
    result
}

pub(super) fn cut<S: Scalar + Copy>(part: &Vec<Polynomial<S>>) -> Vec<Vec<Polynomial<S>>> {
    let mut pieces = vec![Vec::new(); 4];
    for polynomial in part {
        for (piece, quarter) in pieces.iter_mut().zip(polynomial.quarters()) {
            piece.push(quarter);
        }
    }
    pieces
}

/// Checks the claim for each map of the heights; `None` where the evidence does not fit the net.
pub fn curvature<S: Enclose>(
    net: &PlaneNet<S>,
    heights: &Heights<S>,
    sign: Sign,
    evidence: &CurvatureEvidence,
) -> Option<Vec<CurvatureRange>> {
    let patches = net.patches();
    if patches.len() != evidence.patches.len() || evidence.places.len() != heights.maps() {
        return None;
    }
    let check = Check {
        sign,
        sectors: net.sectors(),
        phases: phases(heights, net.sectors()),
    };
    let forms: Vec<_> = patches.iter().map(|&patch| forms(net, heights, patch)).collect();
    // bounds of the extreme from inside: values at places, times the sign
    let mut inner = Vec::new();
    for (part, place) in evidence.places.iter().enumerate() {
        let patch = PatchIndex {
            sector: 0,
            ..place.patch(net.annulus())?
        };
        let at = patches.iter().position(|&known| known == patch)?;
        inner.push(
            check
                .value(&forms[at], part, heights.phase(place.sector, net.sectors()), *place)?
                .hi(),
        );
    }
    let mut floor: Vec<f64> = inner.clone();
    let (mut cells, mut depth) = (0, 0);
    for (forms, tree) in forms.into_iter().zip(&evidence.patches) {
        let walk = tree.walk(forms, &cut, &mut |part| check.lower(part, &mut floor))?;
        cells += walk.cells;
        depth = depth.max(walk.depth);
    }
    let ranges = floor.into_iter().zip(inner).enumerate().map(|(part, (floor, inner))| {
        let status = match () {
            () if floor > 0.0 => Status::Proven,
            () if inner <= 0.0 => Status::Refuted,
            () => Status::Undecided,
        };
        let extreme = sign.times(between(floor, inner)) * heights.factor(net, part);
        CurvatureRange {
            status,
            extreme,
            place: Some(evidence.places[part]),
            cells,
            depth,
        }
    });
    Some(ranges.collect())
}

impl Sign {
    pub(super) fn times<S: Scalar + Copy>(self, value: S) -> S {
        match self {
            Sign::Positive => value,
            Sign::Negative => -value,
        }
    }
}

/// The cosine and sine of each phase that occurs.
fn phases<S>(heights: &Heights<S>, sectors: usize) -> Vec<(Interval, Interval)> {
    heights
        .phases(sectors)
        .into_iter()
        .map(|phase| super::turn(phase, sectors))
        .collect()
}

struct Check {
    sign: Sign,
    sectors: usize,
    phases: Vec<(Interval, Interval)>,
}

impl Check {
    /// The curvature times the sign of a map at a place of a patch, in a sector of the given phase.
    fn value<S: Enclose>(&self, forms: &[Polynomial<S>], part: usize, phase: usize, place: Place) -> Option<Interval> {
        let values: Vec<Interval> = forms
            .iter()
            .map(|f| f.value(S::exact(place.u), S::exact(place.v)).enclosure())
            .collect();
        let numerator = match values[1..] {
            [single] => single,
            [p0, p1, p2] => {
                let (cos, sin) = super::turn(phase, self.sectors);
                let varying = p1 * cos - p2 * sin;
                if part == 0 { p0 + varying } else { p0 - varying }
            }
            _ => return None,
        };
        Some(self.sign.times(numerator) / values[0])
    }

    /// Lowers the bounds of the curvature times the sign for each map to what holds on a part of a patch in
    /// all sectors.
    fn lower<S: Enclose>(&self, part: &[Polynomial<S>], floor: &mut [f64]) {
        let coefficients: Vec<Vec<Interval>> = part
            .iter()
            .map(|f| f.coefficients().iter().map(Enclose::enclosure).collect())
            .collect();
        let weights = &coefficients[0];
        if !weights.iter().all(|weight| weight.certainly_positive()) {
            floor.fill(f64::NEG_INFINITY);
            return;
        }
        match &coefficients[1..] {
            [single] => {
                let quotients = single.iter().zip(weights).map(|(&k, &w)| (self.sign.times(k) / w).lo());
                floor[0] = quotients.fold(floor[0], f64::min);
            }
            [p0, p1, p2] => {
                for (i, &weight) in weights.iter().enumerate() {
                    let (mean, b, c) = (self.sign.times(p0[i]), p1[i], p2[i]);
                    let in_any_phase = ((mean - (b.square() + c.square()).sqrt()) / weight).lo();
                    if floor.iter().all(|&floor| in_any_phase >= floor) {
                        continue;
                    }
                    for &(cos, sin) in &self.phases {
                        let varying = self.sign.times(b * cos - c * sin);
                        floor[0] = floor[0].min(((mean + varying) / weight).lo());
                        floor[1] = floor[1].min(((mean - varying) / weight).lo());
                    }
                }
            }
            _ => floor.fill(f64::NEG_INFINITY),
        }
    }
}
