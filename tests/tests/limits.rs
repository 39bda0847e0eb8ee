//! **Claim**: the limit stencils are the limit of refinement. **Oracle**: refinement itself: a random net is
//! refined m times by the passes, and never through a matrix. With the eigenvalues 1 > lambda > |mu| of a C1
//! scheme
//!
//! ```text
//! P_i^m = p + lambda^m (x_i t1 + y_i t2) + O(mu^m)
//! ```
//!
//! where p is the limit position, t1, t2 the limit tangents and (x_i, y_i) the natural configuration (Reif
//! 1995).

use eigenring_scheme::families::{catmull_clark, doo_sabin, tension};
use eigenring_scheme::lambda::{Bounds, Domain, Relaxation};
use eigenring_scheme::{Complex, PointNet, Scheme, refine};
use eigenring_spectral::LocalSystem;

/// Numbers in [-1, 1) by a linear congruence (Knuth's MMIX constants): the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn schemes(valence: usize) -> Vec<Scheme<f64>> {
    let mut schemes = vec![
        catmull_clark(valence).unwrap(),
        doo_sabin(valence).unwrap(),
        tension(valence, 5, 1.0).unwrap(),
        tension(valence, 6, 1.0).unwrap(),
    ];
    for lambda in [0.4, 0.55, 0.7] {
        let plane = Relaxation::new(valence).unwrap().plane(lambda).unwrap();
        let [f2, f3] = Domain::new(plane, Bounds::Paper, 1e-3).unwrap().starts(2)[0];
        let name = format!("lambda = {lambda}");
        schemes.push(plane.stencil(f2, f3).weights.scheme(name, valence).unwrap());
    }
    schemes
}

fn combination(weights: &[f64], points: &[[f64; 3]]) -> [f64; 3] {
    std::array::from_fn(|d| weights.iter().zip(points).map(|(w, p)| w * p[d]).sum())
}

#[test]
fn refinement_converges_to_the_limit_stencils() {
    for valence in [3, 4, 5, 6, 9, 12] {
        for scheme in schemes(valence) {
            let rings = scheme.closed_rings().unwrap() + 1;
            let system = LocalSystem::new(scheme.limit(), rings).unwrap();
            let spectrum = system.spectrum().unwrap();
            let lambda = spectrum.subdominant().unwrap().value.re;
            let mu = spectrum.subsubdominant().unwrap().modulus();
            let label = format!("{}, N = {valence}, lambda = {lambda}, mu = {mu}", scheme.name());

            let mut random = Random(valence as u64);
            let numbering = system.numbering();
            let start: Vec<[f64; 3]> = (0..numbering.count())
                .map(|_| std::array::from_fn(|_| random.next()))
                .collect();
            let weights = system.limit_position().unwrap();
            assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-13, "{label}");
            let limit = combination(&weights, &start);
            let tangents = system.limit_tangents(lambda).unwrap().map(|weights| {
                assert!(
                    weights.iter().sum::<f64>().abs() < 1e-12,
                    "{label}: a tangent is a direction"
                );
                combination(&weights, &start)
            });
            let natural = system.single(1, lambda).unwrap().values;

            let mut net = PointNet {
                numbering,
                points: start,
            };
            let sites = numbering.sites();
            let mut first_remainder = 0.0;
            for m in 0..=80 {
                let (scale, mut remainder) = (lambda.powi(m), 0.0_f64);
                for (point, &Complex { re: x, im: y }) in net.points.iter().zip(&natural) {
                    for d in 0..3 {
                        let first_order = limit[d] + scale * (x * tangents[0][d] + y * tangents[1][d]);
                        remainder = remainder.max((point[d] - first_order).abs());
                    }
                }
                if m == 0 {
                    first_remainder = remainder;
                    // the net is not in the span of the first three eigenvectors, so there is something to
                    // converge
                    assert!(remainder > 0.1, "{label}");
                }
                // 40: eigenvectors are not orthogonal, and defective eigenvalues below mu add powers of m.
                // Measured: below 32.
                let bound = 40.0 * first_remainder * mu.powi(m) + 1e-13;
                assert!(remainder <= bound, "{label}, m = {m}: {remainder} is more than {bound}");
                net.points = refine(scheme.limit(), &net, &sites).unwrap();
            }
            for point in &net.points {
                for d in 0..3 {
                    let distance = (point[d] - limit[d]).abs();
                    assert!(distance <= 1e2 * lambda.powi(80) + 1e-13, "{label}: {distance}");
                }
            }
        }
    }
}
