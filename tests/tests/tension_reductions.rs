//! **Claim**: the tension scheme reduces to what it generalises, and its matrices are the same by every path.
//! **Oracles**: Catmull-Clark's and Doo and Sabin's own rules; the masks of uniform B-splines (Lane and
//! Riesenfeld 1980: binomial coefficients); the local matrix against its Fourier blocks and against
//! refinement of points.

use eigenring_scheme::families::{catmull_clark, doo_sabin, tension};
use eigenring_scheme::{Lattice, PointNet, Site, Spec, refine};
use eigenring_spectral::{Eigenvalue, LocalSystem, local_matrix};
use eigenring_tests::Comparison;

#[test]
fn order_four_without_tension_is_catmull_clark() {
    let mut entries = Comparison::new("entries of the local matrix", 1e-13);
    for n in 3..=20 {
        let reference = catmull_clark::<f64>(n).unwrap();
        for spec in ["tension:order=4", "stam:order=4", "morin:u0=1"] {
            let scheme = spec.parse::<Spec>().unwrap().scheme::<f64>(n).unwrap();
            assert!(scheme.leading().is_empty(), "{spec}");
            let [ours, theirs] = [&scheme, &reference].map(|scheme| local_matrix(scheme.limit(), 2).unwrap());
            for (index, (a, b)) in ours.entries().iter().zip(theirs.entries()).enumerate() {
                entries.check(format!("{spec}, N = {n}, entry {index}"), *a, *b);
            }
        }
    }
    entries.finish();
}

#[test]
fn order_three_without_tension_is_doo_sabin_on_regular_faces_only() {
    let mut weights = Comparison::new("face weights", 1e-15);
    for n in 3..=20 {
        let uniform = "doo-sabin:uniform".parse::<Spec>().unwrap().scheme::<f64>(n).unwrap();
        let matrix = local_matrix(uniform.limit(), 0).unwrap();
        let original = local_matrix(doo_sabin::<f64>(n).unwrap().limit(), 0).unwrap();
        for j in 0..n {
            let part = match j {
                0 => 3 * n - 3,
                j if j == 1 || j == n - 1 => 3,
                _ => 1,
            };
            weights.check(
                format!("N = {n}, corner {j}"),
                matrix[(0, j)],
                part as f64 / (4 * n) as f64,
            );
        }
        let pairs = matrix.entries().iter().zip(original.entries());
        let distance = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert_eq!(distance < 1e-15, n == 4, "N = {n}: {distance}");
    }
    weights.finish();
}

/// The place of a point in the plane of four sectors, in half steps.
fn in_the_plane(site: Site) -> (i32, i32) {
    (0..site.sector).fold((site.x, site.y), |(x, y), _| (-y, x))
}

/// `C(k, j) / 2^(k-1)`, 0 outside of 0..=k.
fn mask(order: i32, j: i32) -> f64 {
    if !(0..=order).contains(&j) {
        return 0.0;
    }
    (0..j).fold(0.5_f64.powi(order - 1), |c, i| {
        c * f64::from(order - i) / f64::from(i + 1)
    })
}

#[test]
fn regular_nets_without_tension_are_uniform_b_splines() {
    let mut entries = Comparison::new("entries of the local matrix at N = 4", 1e-15);
    for order in 3..=22 {
        let scheme = tension::<f64>(4, order, 1.0).unwrap();
        let rings = scheme.closed_rings().unwrap();
        let matrix = local_matrix(scheme.limit(), rings).unwrap();
        let places: Vec<(i32, i32)> = scheme.numbering(rings).sites().into_iter().map(in_the_plane).collect();
        let k = order as i32;
        // refined X at X/2 between control points at integers (even orders) or half integers, all in half
        // steps
        let weight = |fine: i32, coarse: i32| mask(k, (fine - 2 * coarse + k) / 2);
        for (row, &(x, y)) in places.iter().enumerate() {
            for (column, &(a, b)) in places.iter().enumerate() {
                let expected = weight(x, a) * weight(y, b);
                entries.check(
                    format!("k = {order}, {x},{y} from {a},{b}"),
                    matrix[(row, column)],
                    expected,
                );
            }
        }
    }
    entries.finish();
}

/// Moduli of a spectrum, each as often as its multiplicity.
fn moduli(eigenvalues: &[Eigenvalue]) -> Vec<f64> {
    let repeated = eigenvalues
        .iter()
        .flat_map(|e| std::iter::repeat_n(e.modulus(), e.multiplicity));
    repeated.collect()
}

#[test]
fn the_dense_matrix_has_the_eigenvalues_of_the_blocks() {
    let mut comparison = Comparison::new("moduli, dense against Fourier", 1e-9);
    for order in [3, 4, 5, 6, 7, 8, 9, 10] {
        for (n, u0) in [(3, 0.01), (4, 0.5), (5, 2.0), (6, 1.0), (8, 50.0)] {
            let scheme = tension::<f64>(n, order, u0).unwrap();
            for level in [0, 1, 4] {
                let (rules, rings) = (scheme.level(level), scheme.closed_rings().unwrap());
                let blocks = LocalSystem::new(rules, rings).unwrap().eigenvalues().unwrap();
                // the transform of the dense matrix, which knows no mirror symmetry
                let matrix = local_matrix(rules, rings).unwrap();
                let dense = LocalSystem::from_matrix(&matrix, n, 1e-12)
                    .unwrap()
                    .eigenvalues()
                    .unwrap();
                let (ours, theirs) = (moduli(&blocks.eigenvalues), moduli(&dense.eigenvalues));
                assert_eq!(ours.len(), theirs.len());
                for (rank, (a, b)) in ours.iter().zip(&theirs).take(12).enumerate() {
                    comparison.check(
                        format!("k = {order}, N = {n}, u0 = {u0}, l = {level}, rank {rank}"),
                        *a,
                        *b,
                    );
                }
            }
        }
    }
    comparison.finish();
}

#[test]
fn refinement_of_points_is_multiplication_by_the_matrix() {
    let mut comparison = Comparison::new("refined points", 1e-13);
    for order in [3, 6, 9, 12, 13] {
        for (n, u0, level) in [(3, 0.01, 0), (7, 2.0, 1), (5, 1.0, 0)] {
            let scheme = tension::<f64>(n, order, u0).unwrap();
            let rings = scheme.closed_rings().unwrap() + 1;
            let (rules, numbering) = (scheme.level(level), scheme.numbering(rings));
            let points: Vec<[f64; 2]> = (0..numbering.count())
                .map(|i| [(i as f64 * 0.7).sin(), (i as f64 * 1.9).cos()])
                .collect();
            let matrix = local_matrix(rules, rings).unwrap();
            let net = PointNet { numbering, points };
            let refined = refine(rules, &net, &numbering.sites()).unwrap();
            for (row, found) in refined.iter().enumerate() {
                for d in 0..2 {
                    let expected = matrix.row(row).iter().zip(&net.points).map(|(m, p)| m * p[d]).sum();
                    comparison.check(format!("k = {order}, N = {n}, point {row}"), found[d], expected);
                }
            }
        }
    }
    comparison.finish();
}

#[test]
fn odd_orders_surround_a_face() {
    for order in 3..=22 {
        let lattice = tension::<f64>(5, order, 1.0).unwrap().lattice();
        assert_eq!(lattice == Lattice::Face, order % 2 == 1);
    }
}
