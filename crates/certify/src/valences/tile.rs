//! What is true on an interval of `tau = tan(pi/N)`.
//!
//! Sectors become thin for large N. Drawn with the sector's middle on the x-axis and y divided by tau, maps
//! have a limit: points are pairs `(x, y)` that stand for `x + j y`, `j^2 = -tau^2`, in which the rotation by
//! one sector is
//!
//! ```text
//! w = (1 + j)/(1 - j) = ((1 - tau^2) + 2 j)/(1 + tau^2)
//! ```
//!
//! without any angle in it. The Jacobian in these coordinates is the true one divided by tau. The cosines of
//! `theta = 2 pi/N` and of `2 theta` are rational in tau, and only the vertex stencil needs N itself, for
//! which bounds by tau suffice.

use super::rules::{Inner, Rules, ratio};
use crate::linear::eliminate;
use crate::map::{PlaneNet, Subdivision, cut, hull};
use crate::{Centred, Enclose, Interval};
use eigenring_scheme::{BigRational, Scalar, Site};
use eigenring_spectral::Matrix;
use eigenring_spline::bernstein::Polynomial;
use eigenring_spline::uniform::to_bernstein;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How deep patches are cut before a tile is.
const DEPTH: usize = 2;

/// An interval of tau and how far the patches of sector 0 are cut there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tile {
    /// Its ends.
    pub tau: [f64; 2],
    /// For each patch the parts on which the coefficients of the Jacobian are positive.
    pub jacobian: Vec<Subdivision>,
    /// For each patch the parts on which those of the first coordinate are.
    pub inside: Vec<Subdivision>,
}

/// What is known on a tile.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    /// Lambda.
    pub lambda: Interval,
    /// Whether lambda, of the blocks 1 and N-1, is simple there and leads everything else.
    pub leads: bool,
    /// A lower bound of the Jacobian, with y divided by tau, if it is positive.
    pub jacobian: Option<f64>,
    /// Whether the sector lies in the half-plane around its middle.
    pub inside: bool,
    /// The largest eigenvalue of block 2 divided by lambda^2, where it is known in closed form.
    pub second: Option<Interval>,
}

/// The tile as numbers that depend on tau.
#[derive(Clone, Copy)]
struct Turns {
    /// The parameter.
    tau: Interval,
    /// Its square.
    square: Centred<1>,
    /// The cosine of theta.
    cosine: Centred<1>,
}

impl Turns {
    fn new([start, end]: [f64; 2]) -> Option<Self> {
        let tau = Interval::new(start, end).filter(|tau| tau.is_bounded() && start >= 0.0)?;
        let parameter = Centred::parameter(tau, 0);
        let square = parameter * parameter;
        let cosine = (Centred::one() - square) / (Centred::one() + square);
        Some(Turns { tau, square, cosine })
    }

    /// `a b`.
    fn product(&self, [a, b]: [Centred<1>; 2], [c, d]: [Centred<1>; 2]) -> [Centred<1>; 2] {
        [a * c - self.square * (b * d), a * d + b * c]
    }

    /// The rotation by so many sectors.
    fn rotation(&self, sectors: i64) -> [Centred<1>; 2] {
        let two = Centred::ratio(2, 1);
        let sign = if sectors < 0 { -Centred::one() } else { Centred::one() };
        let once = [self.cosine, sign * two / (Centred::one() + self.square)];
        (0..sectors.abs()).fold([Centred::one(), Centred::zero()], |w, _| self.product(w, once))
    }

    /// `(1 - cos theta) N`: it is `2 pi tau` times `tau/((1 + tau^2) atan tau)`, which lies between
    /// `1/(1 + tau^2)` and 1 since `tau/(1 + tau^2) <= atan tau <= tau`.
    fn flatness(&self) -> Interval {
        let one = Interval::point(1.0);
        let factor = (one / (one + self.tau.square())).hull(one);
        Interval::integer(2) * Interval::pi() * self.tau * factor
    }

    /// `1/N`, and 0.
    fn reciprocal(&self) -> Interval {
        self.tau.atan() / Interval::pi()
    }
}

/// Trace and determinant of a block of the points next to a vertex as `[constant, slope]` in the cosine of
/// its angle.
fn trace_and_determinant(inner: &Inner) -> Option<[[BigRational; 2]; 2]> {
    let Inner::Vertex { weights: w, .. } = inner else {
        return None;
    };
    // in the real unknowns the block is ((d2 + 2 e1 c, 2 e2 h), (2 f2 h, f3)), 2 h^2 = 1 + c
    let two = ratio(2, 1);
    let product = &two * &w.e2 * &w.f2;
    Some([
        [&w.d2 + &w.f3, &two * &w.e1],
        [&w.f3 * &w.d2 - &product, &two * &w.f3 * &w.e1 - &product],
    ])
}

/// `p + q x`.
fn line<S: Scalar>([p, q]: &[BigRational; 2], x: S) -> S {
    S::rational(p) + S::rational(q) * x
}

/// Lambda: the larger root of `x^2 - T x + D` in block 1.
fn lambda(rules: &Rules, turns: &Turns) -> Option<Centred<1>> {
    match (&rules.inner, trace_and_determinant(&rules.inner)) {
        (Inner::Face { first, .. }, _) => Some(Centred::rational(first)),
        (_, Some([trace, determinant])) => {
            let (trace, determinant) = (line(&trace, turns.cosine), line(&determinant, turns.cosine));
            let discriminant = trace * trace - Centred::ratio(4, 1) * determinant;
            discriminant
                .enclosure()
                .certainly_positive()
                .then(|| (trace + discriminant.sqrt()) / Centred::ratio(2, 1))
        }
        _ => None,
    }
}

/// Whether lambda is positive, below 1, simple in block 1, and larger than the moduli of all other
/// eigenvalues at every valence from 5 on: by the conditions of Jury that both roots of `x^2 - T x + D` are
/// smaller in modulus than lambda, `p(lambda) > 0`, `p(-lambda) > 0` and `|D| < lambda^2`.
fn leads(rules: &Rules, turns: &Turns, lambda: Interval) -> bool {
    let one = Interval::point(1.0);
    if !(lambda.certainly_positive() && lambda.certainly_lt(one) && rules.outer_radius().certainly_lt(lambda)) {
        return false;
    }
    let square = lambda.square();
    let (w, [trace, determinant]) = match (&rules.inner, trace_and_determinant(&rules.inner)) {
        (Inner::Face { others, .. }, _) => return Interval::rational(others).abs().certainly_lt(lambda),
        (Inner::Vertex { weights, .. }, Some(pair)) => (weights, pair),
        _ => return false,
    };
    // the blocks 2 to N-2: their cosines c are at least -1 and less than that of block 1, where p(lambda) is
    // 0; it is linear in c, as is the rest
    let rational = Interval::rational;
    let rises = (rational(&trace[1]) * lambda - rational(&determinant[1])).certainly_positive();
    let within = [Interval::integer(-1), Interval::integer(1)].into_iter().all(|c| {
        let (t, d) = (line(&trace, c), line(&determinant, c));
        (square + t * lambda + d).certainly_positive() && d.abs().certainly_lt(square)
    });
    // block 0 without the constants: edge and face points minus the vertex, with alpha, beta of order 1/N
    let two = ratio(2, 1);
    let (p, q) = (&w.d2 + &two * &w.e1, &w.f3);
    let (r, s) = (&two * &w.e2, &two * &w.f2);
    let slope = [
        -(&w.alpha + &w.beta),
        &r * &w.alpha + &s * &w.beta - &p * &w.beta - q * &w.alpha,
    ];
    let constant = [&p + q, &p * q - &r * &s];
    let small = turns.reciprocal();
    let [t, d] = [0, 1].map(|i| rational(&constant[i]) + rational(&slope[i]) * small);
    // N p(lambda), in which p(lambda) = 0 of block 1 is subtracted: the difference is of order 1/N
    let flat = turns.flatness();
    let excess = lambda * (-rational(&slope[0]) - rational(&trace[1]) * flat)
        + rational(&slope[1])
        + rational(&determinant[1]) * flat;
    let constants =
        excess.certainly_positive() && (square + t * lambda + d).certainly_positive() && d.abs().certainly_lt(square);
    rises && within && constants
}

/// The net of the eigenvector of lambda: sector 0 from the inner points outwards, `(lambda - S_rr) v_r =
/// sum_q S_rq v_q` over the rings q before r, and its rotations.
fn characteristic(rules: &Rules, turns: &Turns, lambda: Centred<1>) -> Option<PlaneNet<Centred<1>>> {
    let one = Centred::one();
    let mut values: BTreeMap<Site, [Centred<1>; 2]> = BTreeMap::new();
    match &rules.inner {
        Inner::Vertex { weights, .. } => {
            let gap = lambda - Centred::rational(&weights.f3);
            if gap.enclosure().contains_zero() {
                return None;
            }
            let face = Centred::rational(&(ratio(2, 1) * &weights.f2)) / gap;
            values.insert(Site::CENTRE, [Centred::zero(); 2]);
            // the first spoke is that at -theta/2, times the square root of 1 + tau^2
            values.insert(Site { sector: 0, x: 2, y: 0 }, [one, -one]);
            values.insert(Site { sector: 0, x: 2, y: 2 }, [face, Centred::zero()]);
        }
        Inner::Face { .. } => {
            values.insert(Site { sector: 0, x: 1, y: 1 }, [one, Centred::zero()]);
        }
    }
    for rows in &rules.outer {
        let size = rows.len();
        let mut matrix = Matrix::from_fn(2 * size, 2 * size, |i, j| if i == j { lambda } else { Centred::zero() });
        let mut right = vec![Centred::zero(); 2 * size];
        for (i, (_, weights)) in rows.iter().enumerate() {
            for (turned, source, weight) in weights {
                let [a, b] = turns.rotation(*turned).map(|part| Centred::rational(weight) * part);
                match rows.iter().position(|(site, _)| site == source) {
                    // a + j b times x + j y
                    Some(j) => {
                        matrix[(2 * i, 2 * j)] -= a;
                        matrix[(2 * i, 2 * j + 1)] += turns.square * b;
                        matrix[(2 * i + 1, 2 * j)] -= b;
                        matrix[(2 * i + 1, 2 * j + 1)] -= a;
                    }
                    None => {
                        let [x, y] = turns.product([a, b], *values.get(source)?);
                        right[2 * i] += x;
                        right[2 * i + 1] += y;
                    }
                }
            }
        }
        let solution = eliminate(matrix, right)?;
        for ((site, _), value) in rows.iter().zip(solution.chunks(2)) {
            values.insert(*site, [value[0], value[1]]);
        }
    }
    let numbering = rules.annulus.numbering;
    let sectors = numbering.fan.sectors() as i64;
    let all: Option<Vec<[Centred<1>; 2]>> = numbering
        .sites()
        .into_iter()
        .map(|site| {
            let turned = site.sector as i64;
            let turned = if 2 * turned > sectors { turned - sectors } else { turned };
            let value = values.get(&Site { sector: 0, ..site })?;
            Some(turns.product(turns.rotation(turned), *value))
        })
        .collect();
    let (x, y) = all?.into_iter().map(|[x, y]| (x, y)).unzip();
    // at the nominal valence the rotations do not close, and sector 0 alone is looked at
    PlaneNet::whole(rules.annulus.into(), [x, y]).ok()
}

/// The Jacobians and the first coordinates of the patches of sector 0.
fn functions(net: &PlaneNet<Centred<1>>) -> [Vec<Polynomial<Centred<1>>>; 2] {
    let conversion = to_bernstein(net.annulus().degree);
    let patches: Vec<_> = net.annulus().patches(0).collect();
    let jacobian = patches.iter().map(|&patch| net.jacobian(patch)).collect();
    let along = patches.iter().map(|&patch| {
        let [x, _] = net.coordinates(patch, &conversion);
        x
    });
    [jacobian, along.collect()]
}

/// A lower bound of functions that are positive: the least coefficient on the parts that the trees name.
fn positive(functions: Vec<Polynomial<Centred<1>>>, trees: &[Subdivision]) -> Option<f64> {
    if functions.len() != trees.len() || functions.is_empty() {
        return None;
    }
    let mut least = f64::INFINITY;
    for (function, tree) in functions.into_iter().zip(trees) {
        tree.walk(function, &cut, &mut |part| {
            least = least.min(hull(part.coefficients()).lo());
        })?;
    }
    (least > 0.0).then_some(least)
}

/// How far to cut each function for its coefficients to be positive.
fn search(functions: Vec<Polynomial<Centred<1>>>) -> Vec<Subdivision> {
    let one = |function| {
        Subdivision::grow(function, &cut, &mut |part: &Polynomial<_>, depth| {
            depth < DEPTH && hull(part.coefficients()).lo() <= 0.0
        })
    };
    functions.into_iter().map(one).collect()
}

impl Tile {
    /// A tile with its evidence.
    pub(super) fn find(rules: &Rules, tau: [f64; 2]) -> Self {
        let net = Turns::new(tau).and_then(|turns| characteristic(rules, &turns, lambda(rules, &turns)?));
        let [jacobian, inside] = net.map_or([const { Vec::new() }; 2], |net| functions(&net).map(search));
        Tile { tau, jacobian, inside }
    }

    /// What the checks say of it.
    pub(super) fn check(&self, rules: &Rules) -> Option<Found> {
        let turns = Turns::new(self.tau)?;
        let lambda = lambda(rules, &turns)?;
        let functions = characteristic(rules, &turns, lambda).map(|net| functions(&net));
        let [jacobian, inside] = match functions {
            Some([jacobians, along]) => [positive(jacobians, &self.jacobian), positive(along, &self.inside)],
            None => [None; 2],
        };
        Some(Found {
            lambda: lambda.enclosure(),
            leads: leads(rules, &turns, lambda.enclosure()),
            jacobian,
            inside: inside.is_some(),
            second: second(rules, &turns, lambda),
        })
    }
}

/// The larger eigenvalue of block 2 divided by lambda^2, where it is real.
fn second(rules: &Rules, turns: &Turns, lambda: Centred<1>) -> Option<Interval> {
    let [trace, determinant] = trace_and_determinant(&rules.inner)?;
    let two = Centred::ratio(2, 1);
    let cosine = two * turns.cosine * turns.cosine - Centred::one();
    let (trace, determinant) = (line(&trace, cosine), line(&determinant, cosine));
    let discriminant = trace * trace - Centred::ratio(4, 1) * determinant;
    let real = discriminant.enclosure().certainly_positive();
    real.then(|| ((trace + discriminant.sqrt()) / (two * lambda * lambda)).enclosure())
}
