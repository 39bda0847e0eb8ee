//! The annulus of patches: uniform B-splines by the recursion of de Boor and Cox, sampled Jacobians and
//! winding numbers.

use super::local::Local;

/// The `d+1` basis functions that are not zero on `[0, 1]`, at `t`.
pub fn basis(degree: usize, t: f64) -> Vec<f64> {
    let mut values = vec![1.0];
    for k in 1..=degree {
        let in_k = |j: usize| {
            let rising = if j > 0 {
                (t + (k - j) as f64) * values[j - 1]
            } else {
                0.0
            };
            let falling = if j < k { ((j + 1) as f64 - t) * values[j] } else { 0.0 };
            (rising + falling) / k as f64
        };
        values = (0..=k).map(in_k).collect();
    }
    values
}

/// Their derivatives.
pub fn derivatives(degree: usize, t: f64) -> Vec<f64> {
    let lower = basis(degree - 1, t);
    let at = |j: usize| if j < degree { lower[j] } else { 0.0 };
    (0..=degree)
        .map(|j| if j > 0 { lower[j - 1] } else { 0.0 } - at(j))
        .collect()
}

/// The square `[p, p+1] x [q, q+1]` of a sector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// The sector.
    pub sector: usize,
    /// Steps along the sector's own spoke.
    pub p: i64,
    /// Steps along the next one.
    pub q: i64,
}

/// A point of a surface patch and its two derivatives.
pub struct Jet<const D: usize> {
    /// The point.
    pub value: [f64; D],
    /// The derivative along the own spoke.
    pub u: [f64; D],
    /// The derivative along the next one.
    pub v: [f64; D],
}

/// The patches between the radii `inner` and `2 inner`.
pub fn patches(local: &Local, sectors: usize) -> Vec<Patch> {
    let m = local.inner;
    let of_sector = |sector: usize| {
        let all = (0..2 * m).flat_map(move |q| (0..2 * m).map(move |p| Patch { sector, p, q }));
        all.filter(move |patch| patch.p.max(patch.q) >= m)
    };
    (0..sectors).flat_map(of_sector).collect()
}

/// The places of a patch's control points, the first parameter running fastest.
pub fn control(local: &Local, degree: usize, patch: Patch) -> Vec<usize> {
    let (half, model) = ((degree / 2) as i64, &local.model);
    let mut places = Vec::new();
    for j in 0..=degree as i64 {
        for i in 0..=degree as i64 {
            let (x, y) = (
                2 * (patch.p - half + i) + model.parity,
                2 * (patch.q - half + j) + model.parity,
            );
            let point = model
                .fold(patch.sector, x, y)
                .expect("the annulus lies beyond what reads across the centre");
            places.push(local.index[&point]);
        }
    }
    places
}

/// The basis at a parameter and its derivatives, worked out once for all patches.
#[derive(Clone, Debug)]
pub struct At {
    values: Vec<f64>,
    slopes: Vec<f64>,
}

impl At {
    /// At `t`.
    pub fn new(degree: usize, t: f64) -> At {
        At {
            values: basis(degree, t),
            slopes: derivatives(degree, t),
        }
    }

    /// At `0, 1/samples, .., 1`.
    pub fn samples(degree: usize, samples: usize) -> Vec<At> {
        let at = |i: usize| At::new(degree, i as f64 / samples as f64);
        (0..=samples).map(at).collect()
    }
}

/// A patch of the surface with these control values, at `(u, v)`.
pub fn evaluate<const D: usize>(places: &[usize], values: &[[f64; D]], u: &At, v: &At) -> Jet<D> {
    let mut jet = Jet {
        value: [0.0; D],
        u: [0.0; D],
        v: [0.0; D],
    };
    for (j, row) in places.chunks(u.values.len()).enumerate() {
        for (i, &place) in row.iter().enumerate() {
            let value = &values[place];
            for (axis, x) in value.iter().enumerate() {
                jet.value[axis] += u.values[i] * v.values[j] * x;
                jet.u[axis] += u.slopes[i] * v.values[j] * x;
                jet.v[axis] += u.values[i] * v.slopes[j] * x;
            }
        }
    }
    jet
}

/// The smallest and largest Jacobian of a plane map, at `(samples + 1)^2` places of each patch of the first
/// `sectors` sectors.
pub fn jacobian(local: &Local, degree: usize, map: &[[f64; 2]], sectors: usize, samples: usize) -> [f64; 2] {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let at = At::samples(degree, samples);
    for patch in patches(local, sectors) {
        let places = control(local, degree, patch);
        for u in &at {
            for v in &at {
                let jet = evaluate(&places, map, u, v);
                let determinant = jet.u[0] * jet.v[1] - jet.u[1] * jet.v[0];
                (low, high) = (low.min(determinant), high.max(determinant));
            }
        }
    }
    [low, high]
}

/// How often the outer boundary winds round a place; `None` if it comes too near to it for the samples to
/// tell.
pub fn winding(local: &Local, degree: usize, map: &[[f64; 2]], around: [f64; 2]) -> Option<i64> {
    const SAMPLES: usize = 8;
    let last = 2 * local.inner - 1;
    let at = At::samples(degree, SAMPLES);
    let mut curve: Vec<[f64; 2]> = Vec::new();
    let mut side = |patch: Patch, along_u: bool| {
        let places = control(local, degree, patch);
        for i in 0..SAMPLES {
            let (u, v) = if along_u { (SAMPLES - i, SAMPLES) } else { (SAMPLES, i) };
            let value = evaluate(&places, map, &at[u], &at[v]).value;
            curve.push([value[0] - around[0], value[1] - around[1]]);
        }
    };
    for sector in 0..local.model.n {
        (0..=last).for_each(|q| side(Patch { sector, p: last, q }, false));
        (0..=last).rev().for_each(|p| side(Patch { sector, p, q: last }, true));
    }
    // an oblong ring is made round, which keeps its winding number: with the Cholesky factor of its second
    // moments
    let moment = |i: usize, j: usize| curve.iter().map(|point| point[i] * point[j]).sum::<f64>();
    let first = moment(0, 0).sqrt();
    let below = moment(0, 1) / first;
    let second = (moment(1, 1) - below * below).sqrt();
    if !(second > 1e-6 * first.max(below.abs())) {
        return None;
    }
    for point in &mut curve {
        let x = point[0] / first;
        *point = [x, (point[1] - below * x) / second];
    }
    let radius = |point: &[f64; 2]| point[0].hypot(point[1]);
    let largest = curve.iter().map(radius).fold(0.0, f64::max);
    let mut turned = 0.0;
    for (i, a) in curve.iter().enumerate() {
        let b = &curve[(i + 1) % curve.len()];
        let step = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
        // a step of more than a third of a half turn, or a point near the centre, says that samples are too
        // few
        if radius(a) < 1e-3 * largest || step.abs() > 1.0 {
            return None;
        }
        turned += step;
    }
    Some((turned / std::f64::consts::TAU).round() as i64)
}
