//! The objective straight from its definition, slowly: the oracle of the tests.
//!
//! Of the fast evaluation only the quadrature is used, whose nodes are held against exact arithmetic where
//! they are made. The local matrix of the five rings is written down densely from the rules, eigenvectors
//! come from inverse iteration on its one-ring block and a linear solve for the second ring, every patch of
//! every sector is evaluated, and the integrals over the inner annuli are either summed one by one or by
//! their geometric series.

use super::{Normalisation, Objective, Settings};
use approx::assert_relative_eq;
use eigenring_scheme::OneRing;
use eigenring_scheme::lambda::Plane;
use eigenring_spline::quadrature::gauss_legendre;
use std::f64::consts::{PI, TAU};

const RINGS: i32 = 5;

/// The five-ring neighbourhood and its local matrix.
struct Local {
    valence: i32,
    /// Site of each row: (sector, a, b), the centre first.
    sites: Vec<(i32, i32, i32)>,
    matrix: Vec<Vec<f64>>,
}

impl Local {
    fn new(valence: usize, weights: &OneRing<f64>) -> Local {
        let n = valence as i32;
        let mut sites = vec![(0, 0, 0)];
        // ring by ring, so that the one-ring and two-ring blocks are leading
        for ring in 1..=RINGS {
            for sector in 0..n {
                for b in 0..=ring {
                    sites.push((sector, ring, b));
                }
                for a in 1..ring {
                    sites.push((sector, a, ring));
                }
            }
        }
        let mut local = Local {
            valence: n,
            matrix: vec![vec![0.0; sites.len()]; sites.len()],
            sites,
        };
        let w = weights;
        for row in 0..local.sites.len() {
            let mut terms: Vec<((i32, i32, i32), f64)> = Vec::new();
            let (i, a, b) = local.sites[row];
            match (a, b) {
                (0, 0) => {
                    terms.push(((0, 0, 0), 1.0 - w.alpha - w.beta));
                    for i in 0..n {
                        terms.push(((i, 1, 0), w.alpha / f64::from(n)));
                        terms.push(((i, 1, 1), w.beta / f64::from(n)));
                    }
                }
                (1, 0) => {
                    terms.extend([((0, 0, 0), w.d1), ((i, 1, 0), w.d2)]);
                    terms.extend([((i - 1, 1, 0), w.e1), ((i + 1, 1, 0), w.e1)]);
                    terms.extend([((i - 1, 1, 1), w.e2), ((i, 1, 1), w.e2)]);
                }
                (1, 1) => {
                    terms.extend([((0, 0, 0), w.f1), ((i, 1, 1), w.f3)]);
                    terms.extend([((i, 1, 0), w.f2), ((i + 1, 1, 0), w.f2)]);
                }
                _ => {
                    for (p, x) in curve_rule(a) {
                        for (q, y) in curve_rule(b) {
                            terms.push(((i, p, q), x * y));
                        }
                    }
                }
            }
            for (site, weight) in terms {
                let column = local.index(site);
                local.matrix[row][column] += weight;
            }
        }
        local
    }

    /// The number of a site, read with the rotation rules.
    fn index(&self, (sector, a, b): (i32, i32, i32)) -> usize {
        let n = self.valence;
        let (sector, a, b) = match (a, b) {
            (0, 0) => return 0,
            (a, b) if a >= 1 && b >= 0 => (sector, a, b),
            (a, b) if a >= 0 && b < 0 => (sector - 1, -b, a),
            (a, b) => (sector + 1, b, -a),
        };
        let ring = a.max(b);
        let before = 1 + n * ring * (ring - 1) + sector.rem_euclid(n) * 2 * ring;
        (before + if a == ring { b } else { ring + a }) as usize
    }

    /// The eigenvector of `eigenvalue` in the invariant subspace of `start` (given on the one-ring), scaled
    /// so that its inner product with `start` is that of `start` with itself.
    fn eigenvector(&self, eigenvalue: f64, start: &[f64]) -> Vec<f64> {
        let (first, second) = (start.len(), start.len() + 4 * self.valence as usize);
        // Inverse iteration gains the ratio of gap and shift in every step. A small shift would need fewer
        // steps but blow up rounding errors in the directions of the other eigenvectors of the same
        // eigenvalue.
        let shifted: Vec<Vec<f64>> = (0..first)
            .map(|i| {
                let mut row = self.matrix[i][..first].to_vec();
                row[i] -= eigenvalue * (1.0 + 1e-3);
                row
            })
            .collect();
        let mut v = start.to_vec();
        for _ in 0..25 {
            v = solve(shifted.clone(), v);
            let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
            v.iter_mut().for_each(|x| *x /= norm);
        }
        let product = |u: &[f64]| -> f64 { u.iter().zip(start).map(|(a, b)| a * b).sum() };
        let factor = product(start) / product(&v);
        v.iter_mut().for_each(|x| *x *= factor);

        let system = (first..second)
            .map(|i| {
                let mut row: Vec<f64> = self.matrix[i][first..second].iter().map(|x| -x).collect();
                row[i - first] += eigenvalue;
                row
            })
            .collect();
        let right = (first..second)
            .map(|i| (0..first).map(|j| self.matrix[i][j] * v[j]).sum())
            .collect();
        v.extend(solve(system, right));
        for row in second..self.sites.len() {
            let sum: f64 = v.iter().zip(&self.matrix[row]).map(|(x, w)| x * w).sum();
            v.push(sum / eigenvalue);
        }
        let size = v.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        for (row, value) in self.matrix.iter().zip(&v) {
            let image: f64 = row.iter().zip(&v).map(|(w, x)| w * x).sum();
            assert!((image - eigenvalue * value).abs() < 1e-10 * size);
        }
        v
    }
}

fn curve_rule(fine: i32) -> Vec<(i32, f64)> {
    let m = fine.div_euclid(2);
    if fine.rem_euclid(2) == 0 {
        vec![(m - 1, 1.0 / 8.0), (m, 6.0 / 8.0), (m + 1, 1.0 / 8.0)]
    } else {
        vec![(m, 0.5), (m + 1, 0.5)]
    }
}

fn solve(mut m: Vec<Vec<f64>>, mut x: Vec<f64>) -> Vec<f64> {
    let n = x.len();
    for column in 0..n {
        let pivot = (column..n)
            .max_by(|&i, &j| m[i][column].abs().total_cmp(&m[j][column].abs()))
            .unwrap();
        m.swap(column, pivot);
        x.swap(column, pivot);
        let head = m[column].clone();
        for row in column + 1..n {
            let factor = m[row][column] / head[column];
            if factor != 0.0 {
                for k in column..n {
                    m[row][k] -= factor * head[k];
                }
                x[row] -= factor * x[column];
            }
        }
    }
    for row in (0..n).rev() {
        let sum: f64 = (row + 1..n).map(|k| m[row][k] * x[k]).sum();
        x[row] = (x[row] - sum) / m[row][row];
    }
    x
}

/// Area element and Hessian (xx, xy, yy) at every Gauss point of the annulus.
struct Sampled {
    area: Vec<f64>,
    hessians: [Vec<[f64; 3]>; 3],
}

/// The cubic B-spline with support [-2, 2] and its first two derivatives.
fn spline(t: f64) -> [f64; 3] {
    let (r, sign) = (t.abs(), t.signum());
    if r >= 2.0 {
        [0.0; 3]
    } else if r >= 1.0 {
        let d = 2.0 - r;
        [d * d * d / 6.0, -sign * d * d / 2.0, d]
    } else {
        [
            2.0 / 3.0 - r * r + r * r * r / 2.0,
            sign * (1.5 * r * r - 2.0 * r),
            3.0 * r - 2.0,
        ]
    }
}

impl Sampled {
    fn new(local: &Local, x: &[f64], y: &[f64], z: [&[f64]; 3]) -> Sampled {
        let mut sampled = Sampled {
            area: Vec::new(),
            hessians: [Vec::new(), Vec::new(), Vec::new()],
        };
        let patches = (0..4).flat_map(|p| (0..4).map(move |q| (p, q)));
        for (p, q) in patches.filter(|&(p, q)| p.max(q) >= 2) {
            for sector in 0..local.valence {
                let rule = gauss_legendre(5);
                for (u, wu) in rule.iter().map(|node| (node.at, node.weight)) {
                    for (v, wv) in rule.iter().map(|node| (node.at, node.weight)) {
                        let derivatives = |field: &[f64]| {
                            let mut d = [0.0; 5];
                            for a in p - 1..=p + 2 {
                                for b in q - 1..=q + 2 {
                                    let value = field[local.index((sector, a, b))];
                                    let f = spline(f64::from(p - a) + u);
                                    let g = spline(f64::from(q - b) + v);
                                    d[0] += value * f[1] * g[0];
                                    d[1] += value * f[0] * g[1];
                                    d[2] += value * f[2] * g[0];
                                    d[3] += value * f[1] * g[1];
                                    d[4] += value * f[0] * g[2];
                                }
                            }
                            d
                        };
                        let (dx, dy) = (derivatives(x), derivatives(y));
                        let jacobian = dx[0] * dy[1] - dx[1] * dy[0];
                        sampled.area.push(wu * wv * jacobian);
                        for (hessians, z) in sampled.hessians.iter_mut().zip(z) {
                            hessians.push(hessian(&dx, &dy, &derivatives(z), jacobian));
                        }
                    }
                }
            }
        }
        sampled
    }
}

/// Solves the chain rule `z_ab = z_xx x_a x_b + z_xy (x_a y_b + x_b y_a) + z_yy y_a y_b + z_x x_ab + z_y
/// y_ab`.
fn hessian(x: &[f64; 5], y: &[f64; 5], z: &[f64; 5], jacobian: f64) -> [f64; 3] {
    let zx = (z[0] * y[1] - z[1] * y[0]) / jacobian;
    let zy = (x[0] * z[1] - x[1] * z[0]) / jacobian;
    let row = |a: usize, b: usize| vec![x[a] * x[b], x[a] * y[b] + x[b] * y[a], y[a] * y[b]];
    let right = (2..5).map(|i| z[i] - zx * x[i] - zy * y[i]).collect();
    let solution = solve(vec![row(0, 0), row(0, 1), row(1, 1)], right);
    [solution[0], solution[1], solution[2]]
}

/// What the tests compare: value, fits and Gauss curvature extremes of a map.
#[derive(Clone, Copy, Debug)]
struct Direct {
    value: f64,
    fit: [f64; 3],
    gauss: (f64, f64),
}

enum Series {
    Closed,
    /// The given number of annuli.
    Summed(i32),
}

fn direct(plane: &Plane<f64>, settings: &Settings, f2: f64, f3: f64, series: Series) -> [Direct; 3] {
    let n = plane.valence;
    let local = Local::new(n, &plane.stencil(f2, f3).weights);
    let (lambda, s, mu) = (plane.lambda, plane.s, plane.mu());
    // the first ring is ordered E_0, F_0, E_1, F_1, ...
    let wave = |k: usize, shape: fn(f64) -> f64, edge: f64, face: f64| {
        let angle = |i: f64| shape(TAU * k as f64 * i / n as f64);
        let mut start = vec![0.0];
        for i in 0..n {
            start.extend([edge * angle(i as f64), face * angle(i as f64 + 0.5)]);
        }
        start
    };
    // a start on the edge points alone fixes the scale there
    let edges = |k, shape| wave(k, shape, 1.0, 0.0);
    let grow = |eigenvalue, start: Vec<f64>| local.eigenvector(eigenvalue, &start);
    let mut x = grow(lambda, edges(1, f64::cos));
    let mut y = grow(lambda, edges(1, f64::sin));
    let mut cup = grow(mu, edges(0, f64::cos));
    let mut re = grow(mu, edges(2, f64::cos));
    let mut im = if n == 4 {
        // sin at the face points (2i+1) pi/4 of mode 2 is (-1)^i
        grow(mu, wave(2, f64::sin, 0.0, 1.0))
    } else {
        grow(mu, edges(2, f64::sin))
    };
    if settings.normalisation == Normalisation::Paper {
        for v in [&mut x, &mut y, &mut cup, &mut re, &mut im] {
            assert_eq!(v.len(), 30 * n + 1);
            let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
            v.iter_mut().for_each(|x| *x /= norm);
        }
    }
    let sampled = Sampled::new(&local, &x, &y, [&cup, &re, &im]);
    let p = lambda * lambda;
    let terms = match series {
        Series::Closed => 0,
        Series::Summed(terms) => terms,
    };
    // sum over the annuli of p^m s^(j m)
    let geometric = |j: i32| match series {
        Series::Closed => 1.0 / (1.0 - p * s.powi(j)),
        Series::Summed(terms) => (0..terms).map(|m| (p * s.powi(j)).powi(m)).sum(),
    };
    let area: f64 = sampled.area.iter().sum::<f64>() * geometric(0);
    [0, 1, 2].map(|map| {
        let hessians = &sampled.hessians[map];
        let fit = [0, 1, 2].map(|h| {
            let integral: f64 = sampled.area.iter().zip(hessians).map(|(da, z)| da * z[h]).sum();
            integral * geometric(1) / area
        });
        let ideal = fit[0] * fit[2] - fit[1] * fit[1];
        let mut gauss = (f64::INFINITY, f64::NEG_INFINITY);
        let mut value = 0.0;
        for (da, z) in sampled.area.iter().zip(hessians) {
            let curvature = z[0] * z[2] - z[1] * z[1];
            gauss = (gauss.0.min(curvature), gauss.1.max(curvature));
            let r = |e: f64| {
                let k = ideal.signum() * curvature;
                (k + (k * k + 4.0 * e * e).sqrt()) / 2.0
            };
            let epsilon = settings.epsilon * ideal.abs();
            let w = if settings.weighted {
                r(settings.n * epsilon) / r(epsilon)
            } else {
                1.0
            };
            for h in 0..3 {
                value += match series {
                    Series::Closed => {
                        w * da * (z[h] * z[h] * geometric(2) - 2.0 * fit[h] * z[h] * geometric(1))
                            + w * da * fit[h] * fit[h] * geometric(0)
                    }
                    Series::Summed(_) => (0..terms)
                        .map(|m| w * da * p.powi(m) * (z[h] * s.powi(m) - fit[h]).powi(2))
                        .sum(),
                };
            }
        }
        Direct {
            value: value / area,
            fit,
            gauss,
        }
    })
}

/// A reproducible stream of numbers in [0, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A random plane and feasible point: non-negative weights, |eigenvalues| of every other block below mu,
/// corner radius at least 1.
fn feasible(valence: usize, random: &mut Random) -> (Plane<f64>, f64, f64) {
    let n = valence as f64;
    let c = |k: f64| (TAU * k / n).cos();
    for _ in 0..100_000 {
        let lambda = 0.2 + 0.65 * random.next();
        let mut lowest = f64::max(1.0, 1.0 / (8.0 * lambda * lambda));
        if valence >= 5 {
            lowest = lowest
                .max(c(2.0) / (c(1.0) * lambda))
                .max((1.0 + c(2.0)) / ((1.0 + 2.0 * c(1.0) - c(2.0)) * lambda));
        }
        let s = lowest + if random.next() < 0.5 { 0.0 } else { 0.02 } + if lowest > 1.0 { 0.001 } else { 0.0 };
        let Ok(plane) = Plane::new(valence, lambda, s) else {
            continue;
        };
        let mu = plane.mu();
        // where s exceeds 1 only very small f3 are feasible
        let f3 = match valence {
            3 => mu + (lambda - mu) * random.next(),
            4 => mu,
            _ if lowest > 1.2 => 0.01 * mu * random.next() * random.next(),
            _ => mu * random.next(),
        };
        let f2 = 0.1 + 0.4 * random.next();
        let stencil = plane.stencil(f2, f3);
        let w = stencil.weights;
        let weights = [w.f1, w.d1, w.d2, w.e1, w.e2, w.beta, 1.0 - 7.0 * w.beta];
        let blocks = (3..=valence / 2).all(|k| {
            let trace = w.d2 + 2.0 * w.e1 * c(k as f64) + f3;
            let root = (trace * trace / 4.0 - f3 * stencil.g3).sqrt();
            trace.abs() / 2.0 + root < mu
        });
        // the other eigenvalues of blocks 2 (at N = 3 there is none beside block 1's) and 0
        let rest = if valence == 3 { 0.0 } else { f3 * stencil.g3 / mu };
        let third = stencil.g3 + 4.0 * stencil.g2 * f2 + f3 - 7.0 * w.beta - mu;
        if weights.iter().all(|&w| w >= 0.0)
            && blocks
            && rest.abs() < mu
            && third.abs() < mu
            && 2.0 * f2 * (PI / n).cos() / (lambda - f3) >= 1.0
        {
            return (plane, f2, f3);
        }
    }
    panic!("no feasible point at valence {valence}");
}

fn compare(objective: &Objective, f2: f64, f3: f64, direct: [Direct; 3], tolerance: f64) {
    let parts = objective.parts(f2, f3).unwrap();
    let mut total = 0.0;
    for (part, direct) in [parts.cup, parts.saddle_re, parts.saddle_im].iter().zip(direct) {
        total += direct.value;
        assert_relative_eq!(part.value, direct.value, max_relative = tolerance);
        let size = direct.fit.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        for (fast, slow) in [part.a, part.b, part.c].iter().zip(direct.fit) {
            assert_relative_eq!(*fast, slow, epsilon = tolerance * size);
        }
        assert_relative_eq!(
            part.gauss_min,
            direct.gauss.0,
            epsilon = tolerance * size * size,
            max_relative = tolerance
        );
        assert_relative_eq!(
            part.gauss_max,
            direct.gauss.1,
            epsilon = tolerance * size * size,
            max_relative = tolerance
        );
    }
    assert_relative_eq!(objective.value(f2, f3).unwrap(), total, max_relative = tolerance);
    assert_relative_eq!(parts.total(), total, max_relative = tolerance);
}

#[test]
fn the_fast_evaluation_is_the_definition() {
    let mut random = Random(1);
    let unit = Settings {
        normalisation: Normalisation::UnitRing,
        ..Settings::default()
    };
    let unweighted = Settings {
        weighted: false,
        ..Settings::default()
    };
    let gentle = Settings {
        epsilon: 0.7,
        n: 2.0,
        ..Settings::default()
    };
    for valence in (3..=20).chain([64]) {
        let rounds = if valence == 64 { 1 } else { 2 };
        for _ in 0..rounds {
            let (plane, f2, f3) = feasible(valence, &mut random);
            for settings in [Settings::default(), unit, unweighted, gentle] {
                let objective = Objective::new(plane, settings).unwrap();
                let slow = direct(&plane, &settings, f2, f3, Series::Closed);
                compare(&objective, f2, f3, slow, 1e-9);
            }
        }
    }
}

#[test]
fn the_geometric_series_is_the_sum_over_the_annuli() {
    let mut random = Random(2);
    for valence in [3, 4, 5, 6, 7, 8, 11, 14] {
        let (plane, f2, f3) = feasible(valence, &mut random);
        let settings = Settings::default();
        let ratio = (plane.lambda * plane.lambda).max((plane.s * plane.lambda).powi(2));
        let annuli = (1e-13_f64.ln() / ratio.ln()).ceil() as i32;
        let slow = direct(&plane, &settings, f2, f3, Series::Summed(annuli));
        compare(&Objective::new(plane, settings).unwrap(), f2, f3, slow, 1e-9);
    }
}

#[test]
fn the_gradient_is_that_of_central_differences() {
    let mut random = Random(3);
    for valence in (3..=20).chain([33, 64]) {
        for round in 0..6 {
            let (plane, f2, f3) = feasible(valence, &mut random);
            // the boundary f3 = 0, where formulas continue to both sides
            let f3 = if round == 0 && valence > 4 { 0.0 } else { f3 };
            let settings = Settings {
                weighted: round != 1,
                normalisation: if round == 2 {
                    Normalisation::UnitRing
                } else {
                    Normalisation::Paper
                },
                ..Settings::default()
            };
            let objective = Objective::new(plane, settings).unwrap();
            let (value, gradient) = objective.value_and_gradient(f2, f3).unwrap();
            assert_eq!(value, objective.value(f2, f3).unwrap());
            let at = |f2: f64, f3: f64| objective.value(f2, f3).unwrap();
            // fourth-order differences; the step balances truncation and rounding for functions of relative
            // scale 0.1
            let step = 2e-5;
            let difference = |f: &dyn Fn(f64) -> f64| {
                (8.0 * (f(step) - f(-step)) - (f(2.0 * step) - f(-2.0 * step))) / (12.0 * step)
            };
            let by_f2 = difference(&|h| at(f2 + h, f3));
            let by_f3 = difference(&|h| at(f2, f3 + h));
            let size = by_f2.hypot(by_f3);
            assert!(
                (gradient[0] - by_f2).abs() < 1e-6 * size,
                "{valence} {gradient:?} {by_f2} {by_f3}"
            );
            assert!(
                (gradient[1] - by_f3).abs() < 1e-6 * size,
                "{valence} {gradient:?} {by_f2} {by_f3}"
            );
            if valence == 4 {
                assert_eq!(gradient[1], 0.0);
            }
        }
    }
}
