//! The objective's quantities for any scheme, without its short cuts.
//!
//! [`Objective`](crate::objective::Objective) knows the lambda-scheme and is fast; [`Quality`] takes any
//! primal scheme's maps patch by patch, so that other schemes (Catmull-Clark, user schemes) can be compared
//! with tuned ones, and the two check each other. The three second-order maps may have eigenvalues `mu_i` of
//! their own; each part of E is then formed with its own `s_i = mu_i / lambda^2`. On ring m of the geometric
//! series the Hessian is `s_i^m H` and the area `lambda^(2m)`, so a part exists only while `lambda s_i < 1`
//! (the second derivatives are square integrable).
//!
//! All schemes are measured on the annulus `[2, 4]` and normalised by unit Euclidean norm over the rings that
//! carry it (five rings for bicubic ones), as in the tuning.

use eigenring_scheme::{Lattice, Scheme, Site};
use eigenring_spectral::{Annulus, Error, Graph, Maps};
use eigenring_spline::TensorPatch;
use eigenring_spline::quadrature::gauss_legendre;
use eigenring_spline::uniform::basis;

use crate::objective::{Settings, Weight};

/// One second-order map's share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapQuality {
    /// The eigenvalue of the map.
    pub mu: f64,
    /// The unweighted squared error E_i; infinite if the map's second derivatives are not square integrable.
    pub value: f64,
    /// The same weighted where the Gauss curvature has the wrong sign, by the paper's constants (Ma, Wang and
    /// Ma 2023, Eqs. 16 to 20).
    pub weighted: f64,
    /// Smallest `z_xx z_yy - z_xy^2` over the Gauss points.
    pub gauss_min: f64,
    /// Largest `z_xx z_yy - z_xy^2` over the Gauss points.
    pub gauss_max: f64,
}

/// How good a scheme's characteristic and second-order maps are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// The subdominant eigenvalue.
    pub lambda: f64,
    /// Cup and two saddles.
    pub maps: [MapQuality; 3],
    /// Smallest Jacobian of the characteristic map over the Gauss points, with `E_0 = (1, 0)`.
    pub jacobian_min: f64,
    /// The angle at F in the triangle V E F of the natural configuration, in radians; `None` around a face.
    pub theta: Option<f64>,
}

impl Quality {
    /// Measures a scheme; `order` Gauss points per patch and direction.
    ///
    /// # Errors
    /// Those of [`Maps::on`].
    pub fn new(scheme: &Scheme<f64>, order: usize) -> Result<Self, Error> {
        let annulus = Annulus::at_least(scheme, 2)?;
        let maps = Maps::on(scheme, annulus)?;
        let points = quadrature_points(&maps, order);
        let norm = |net: &[f64]| net.iter().map(|v| v * v).sum::<f64>().sqrt();
        let plane_norm = norm(&maps.natural[0]);
        let p = maps.lambda * maps.lambda;
        let Settings { epsilon, n, .. } = Settings::default();
        let weight = Weight::new(epsilon, n);
        let area: f64 = points.iter().map(|point| point.area).sum();
        let parts = std::array::from_fn(|which| {
            // z / |z| over x / |x|: second derivatives scale by |x|^2 / |z|
            let scale = plane_norm * plane_norm / norm(&maps.second_order[which]);
            let s = maps.mu[which] / p;
            let rho = (1.0 - p) / (1.0 - p * s);
            let (c0, far) = (
                1.0 / (1.0 - p),
                p * (s - 1.0).powi(2) / ((1.0 - p * s * s) * (1.0 - p * s).powi(2)),
            );
            let means: [f64; 3] = std::array::from_fn(|component| {
                let h = |point: &QuadraturePoint| scale * point.graphs[which].hessian[component];
                points.iter().map(|point| point.area * h(point)).sum::<f64>() * rho / area
            });
            let mut value = 0.0;
            for (component, mean) in means.into_iter().enumerate() {
                let h = |point: &QuadraturePoint| scale * point.graphs[which].hessian[component];
                value += points
                    .iter()
                    .map(|point| point.area * (c0 * (mean - rho * h(point)).powi(2) + far * h(point).powi(2)))
                    .sum::<f64>();
            }
            let ideal = means[0] * means[2] - means[1] * means[1];
            let weighted: f64 = points
                .iter()
                .map(|point| {
                    let gauss = scale * scale * point.graphs[which].gauss();
                    let (w, _) = weight.at(if ideal == 0.0 { 0.0 } else { gauss / ideal });
                    let squares = point.graphs[which].hessian.iter().zip(means).map(|(h, mean)| {
                        let h = scale * h;
                        c0 * (mean - rho * h).powi(2) + far * h * h
                    });
                    w * point.area * squares.sum::<f64>()
                })
                .sum();
            let gauss = points.iter().map(|point| scale * scale * point.graphs[which].gauss());
            let exists = p * s * s < 1.0;
            MapQuality {
                mu: maps.mu[which],
                value: if exists { value / (c0 * area) } else { f64::INFINITY },
                weighted: if exists { weighted / (c0 * area) } else { f64::INFINITY },
                gauss_min: gauss.clone().fold(f64::INFINITY, f64::min),
                gauss_max: gauss.fold(f64::NEG_INFINITY, f64::max),
            }
        });
        Ok(Quality {
            lambda: maps.lambda,
            maps: parts,
            jacobian_min: points
                .iter()
                .map(|point| point.graphs[0].jacobian)
                .fold(f64::INFINITY, f64::min),
            theta: theta(&maps),
        })
    }

    /// The unweighted objective: the sum of the three values.
    pub fn total(&self) -> f64 {
        self.maps.iter().map(|map| map.value).sum()
    }

    /// The objective that is tuned: the sum of the three weighted values.
    pub fn weighted(&self) -> f64 {
        self.maps.iter().map(|map| map.weighted).sum()
    }

    /// `K_m` of Ma, Wang and Ma (2023, Eq. 33), with the numerators of the Gauss curvatures.
    pub fn sign_change(&self) -> f64 {
        let [cup, first, second] = self.maps;
        (-cup.gauss_min).max(0.0) + first.gauss_max.max(0.0) + second.gauss_max.max(0.0)
    }
}

struct QuadraturePoint {
    /// Quadrature weight times Jacobian.
    area: f64,
    graphs: [Graph; 3],
}

fn quadrature_points(maps: &Maps, order: usize) -> Vec<QuadraturePoint> {
    let rule = gauss_legendre(order);
    let functions: Vec<[Vec<f64>; 3]> = rule.iter().map(|node| basis(maps.annulus.degree, node.at)).collect();
    let n = maps.annulus.numbering.fan.sectors();
    let patches = (0..n).flat_map(|sector| maps.annulus.patches(sector));
    patches
        .flat_map(|patch| {
            let control = maps.annulus.control(patch);
            let patch = |net: &Vec<f64>| TensorPatch {
                degree: maps.annulus.degree,
                control: control.iter().map(|&index| net[index]).collect(),
            };
            let [x, y] = maps.natural.each_ref().map(patch);
            let heights = maps.second_order.each_ref().map(patch);
            let mut points = Vec::with_capacity(order * order);
            for (u, in_u) in rule.iter().zip(&functions) {
                for (v, in_v) in rule.iter().zip(&functions) {
                    let jet = |patch: &TensorPatch<f64>| patch.jet_in(in_u, in_v);
                    let (x, y) = (jet(&x), jet(&y));
                    let graphs = heights.each_ref().map(|z| Graph::new(&x, &y, &jet(z)));
                    points.push(QuadraturePoint {
                        area: u.weight * v.weight * graphs[0].jacobian,
                        graphs,
                    });
                }
            }
            points
        })
        .collect()
}

fn theta(maps: &Maps) -> Option<f64> {
    if maps.annulus.numbering.lattice != Lattice::Vertex {
        return None;
    }
    let at = |x, y| {
        let index = maps.annulus.numbering.index(Site { sector: 0, x, y })?;
        Some([maps.natural[0][index], maps.natural[1][index]])
    };
    let ([ex, ey], [fx, fy]) = (at(2, 0)?, at(2, 2)?);
    // between the directions from F to V (the origin) and to E
    let (to_v, to_e) = ([-fx, -fy], [ex - fx, ey - fy]);
    let cross = to_v[0] * to_e[1] - to_v[1] * to_e[0];
    Some(cross.abs().atan2(to_v[0] * to_e[0] + to_v[1] * to_e[1]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::objective::{Objective, Settings};
    use eigenring_scheme::families::{catmull_clark, doo_sabin};
    use eigenring_scheme::lambda::{Bounds, Domain, Relaxation};

    #[test]
    fn agrees_with_the_objective_of_the_lambda_scheme() {
        for (valence, lambda) in [(3, 0.5), (4, 0.45), (5, 0.56), (6, 0.3), (9, 0.5), (12, 0.7)] {
            let plane = Relaxation::new(valence).unwrap().plane(lambda).unwrap();
            let domain =
                Domain::new(plane, Bounds::Paper, 1e-3).unwrap_or(Domain::new(plane, Bounds::Paper, 0.0).unwrap());
            let [f2, f3] = domain.starts(3)[1];
            let [parts, weighted] = [false, true].map(|weighted| {
                let settings = Settings {
                    weighted,
                    ..Settings::default()
                };
                Objective::new(plane, settings).unwrap().parts(f2, f3).unwrap()
            });
            let scheme = plane.stencil(f2, f3).weights.scheme("lambda", valence).unwrap();
            let quality = Quality::new(&scheme, 5).unwrap();
            let close = |a: f64, b: f64| (a - b).abs() <= 1e-6 * a.abs().max(b.abs()).max(1.0);
            for (ours, theirs) in quality.maps.iter().zip([parts.cup, parts.saddle_re, parts.saddle_im]) {
                assert!(
                    close(ours.value, theirs.value),
                    "{valence} {lambda}: {} {}",
                    ours.value,
                    theirs.value
                );
                assert!(close(ours.gauss_min, theirs.gauss_min) && close(ours.gauss_max, theirs.gauss_max));
            }
            let weighted = [weighted.cup, weighted.saddle_re, weighted.saddle_im];
            for (ours, theirs) in quality.maps.iter().zip(weighted) {
                assert!(
                    close(ours.weighted, theirs.value),
                    "{valence} {lambda}: {ours:?} {theirs:?}"
                );
            }
            assert!(close(quality.jacobian_min, parts.jacobian_min));
            assert!((quality.theta.unwrap() - domain.theta(f2, f3)).abs() < 1e-9);
        }
    }

    #[test]
    fn known_schemes() {
        // bicubic B-splines: quadratic second-order maps
        let regular = Quality::new(&catmull_clark(4).unwrap(), 5).unwrap();
        assert!(regular.total() < 1e-18 && regular.sign_change() == 0.0);
        // Ma, Wang and Ma (2023, section 5.2): K_m of Catmull-Clark vanishes
        for valence in [3, 5, 6, 8] {
            let quality = Quality::new(&catmull_clark(valence).unwrap(), 5).unwrap();
            assert!(quality.total().is_finite() && quality.jacobian_min > 0.0);
            assert_eq!(quality.sign_change(), 0.0, "valence {valence}");
        }
        assert!(
            Quality::new(&doo_sabin(6).unwrap(), 5).is_err(),
            "its 1/4 resonates with the outer rings"
        );
    }
}
