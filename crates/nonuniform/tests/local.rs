//! Properties of the local rules at any valence and interval set: symmetries, known special cases, tensor
//! products at valence 4 by the polar form, and what eigenvectors must satisfy.

use crate::common::{Sequence, difference};
use eigenring_nonuniform::eigen_polyhedron::safe_ratio;
use eigenring_nonuniform::{EigenPolyhedron, Error, FirstLevel, NGon, Spokes, first_level, nurss};
use eigenring_spectral::{Block, Matrix};

const RULES: [FirstLevel; 3] = [FirstLevel::Simple, FirstLevel::Printed, FirstLevel::Improved];

fn random(sequence: &mut Sequence, n: usize, ratio: f64) -> Spokes {
    Spokes::new(sequence.intervals(n, ratio), sequence.intervals(n, 100.0)).unwrap()
}

/// The mirror image: spoke i becomes spoke -i, sector i sector -i-1.
fn mirrored(spokes: &Spokes) -> Spokes {
    let n = spokes.valence();
    let turn = |list: &[f64]| (0..n).map(|i| list[(n - i) % n]).collect();
    Spokes::new(turn(spokes.intervals()), turn(spokes.next())).unwrap()
}

/// The point that is the mirror image of a point in the order V, E_0.., F_0.. .
fn image(n: usize, point: usize) -> usize {
    match point {
        0 => 0,
        _ if point <= n => 1 + (n - (point - 1)) % n,
        _ => 1 + n + (2 * n - (point - 1 - n) - 1) % n,
    }
}

/// All matrices of the spokes: M, N, and the first levels with their rows in the order of the sectors.
fn matrices(spokes: &Spokes) -> Vec<Matrix<f64>> {
    let n = spokes.valence();
    let padded = |rows: &Matrix<f64>| {
        // as rows of the faces
        Matrix::from_fn(
            2 * n + 1,
            2 * n + 1,
            |i, j| if i > n { rows[(i - n - 1, j)] } else { 0.0 },
        )
    };
    let polyhedron = EigenPolyhedron::new(spokes.intervals()).unwrap();
    let ngon = NGon::new(spokes.intervals()).unwrap().matrix();
    let corners = Matrix::from_fn(n, 2 * n + 1, |i, j| if j > n { ngon[(i, j - n - 1)] } else { 0.0 });
    let mut all = vec![
        nurss::matrix(spokes).unwrap(),
        polyhedron.matrix().unwrap(),
        padded(&corners),
    ];
    all.extend(RULES.map(|rule| padded(&first_level::rows(spokes, rule).unwrap())));
    all
}

#[test]
fn rules_do_not_depend_on_orientation_and_scale() {
    let mut sequence = Sequence(1);
    for n in [3, 4, 5, 6, 7, 8, 11] {
        let spokes = random(&mut sequence, n, 2.5);
        let own = matrices(&spokes);
        let scaled = |list: &[f64]| list.iter().map(|d| d * 7.3).collect();
        let scaled = Spokes::new(scaled(spokes.intervals()), scaled(spokes.next())).unwrap();
        for (a, b) in own.iter().zip(matrices(&scaled)) {
            assert!(difference(a.entries(), b.entries()) < 1e-13, "n = {n}");
        }
        for (a, b) in own.iter().zip(matrices(&mirrored(&spokes))) {
            let turned = Matrix::from_fn(2 * n + 1, 2 * n + 1, |i, j| b[(image(n, i), image(n, j))]);
            let error = difference(a.entries(), turned.entries());
            assert!(error < 1e-13, "n = {n}: {error:e}");
        }
    }
}

#[test]
fn equal_intervals_give_the_uniform_schemes() {
    for n in 3..13 {
        let spokes = Spokes::stationary(vec![0.7; n]).unwrap();
        let size = n as f64;
        // Catmull and Clark: faces, edges, and 1 - 7/(4n), 3/(2n^2), 1/(4n^2)
        let expected = Matrix::from_fn(2 * n + 1, 2 * n + 1, |i, j| {
            match (i, j) {
                (0, 0) => 1.0 - 7.0 / (4.0 * size),
                (0, _) if j <= n => 1.5 / (size * size),
                (0, _) => 0.25 / (size * size),
                (_, 0) => {
                    if i <= n {
                        3.0 / 8.0
                    } else {
                        0.25
                    }
                }
                (_, _) if i <= n && j <= n => match (j + n - i) % n {
                    0 => 3.0 / 8.0,
                    k if k == 1 || k == n - 1 => 1.0 / 16.0,
                    _ => 0.0,
                },
                // face k lies between spokes k and k+1
                (_, _) if i <= n => {
                    if [0, n - 1].contains(&((j - n + n - i) % n)) {
                        1.0 / 16.0
                    } else {
                        0.0
                    }
                }
                (_, _) if j <= n => {
                    if [0, 1].contains(&((j + 2 * n - i) % n)) {
                        0.25
                    } else {
                        0.0
                    }
                }
                _ => {
                    if i == j {
                        0.25
                    } else {
                        0.0
                    }
                }
            }
        });
        let found = nurss::matrix::<f64>(&spokes).unwrap();
        assert!(difference(found.entries(), expected.entries()) < 1e-15, "n = {n}");
        let polyhedron = EigenPolyhedron::new(spokes.intervals()).unwrap().matrix().unwrap();
        assert!(difference(polyhedron.entries(), expected.entries()) < 2e-15, "n = {n}");
        // Doo and Sabin: (n+5)/(4n), (3 + 2 cos)/(4n)
        let ngon = NGon::new(spokes.intervals()).unwrap().matrix();
        let turn = |k: usize| (std::f64::consts::TAU * k as f64 / size).cos();
        let doo_sabin = Matrix::from_fn(n, n, |i, j| match (i + n - j) % n {
            0 => (size + 5.0) / (4.0 * size),
            k => (3.0 + 2.0 * turn(k)) / (4.0 * size),
        });
        assert!(difference(ngon.entries(), doo_sabin.entries()) < 1e-15, "n = {n}");
    }
}

/// The polar form of the cubic with these coefficients, lowest first.
fn polar(c: [f64; 4], [a, b, d]: [f64; 3]) -> f64 {
    c[0] + c[1] * (a + b + d) / 3.0 + c[2] * (a * b + a * d + b * d) / 3.0 + c[3] * a * b * d
}

/// The nine points around a vertex of valence 4 of a product of cubics, from knots -2 .. 2 in each direction.
fn products(p: [f64; 4], q: [f64; 4], u: [f64; 5], v: [f64; 5]) -> Vec<f64> {
    let at = |i: i32, j: i32| {
        let knots = |t: [f64; 5], i: i32| [-1, 0, 1].map(|k| t[(2 + i + k) as usize]);
        polar(p, knots(u, i)) * polar(q, knots(v, j))
    };
    let places = [
        (0, 0),
        (1, 0),
        (0, 1),
        (-1, 0),
        (0, -1),
        (1, 1),
        (-1, 1),
        (-1, -1),
        (1, -1),
    ];
    places.map(|(i, j)| at(i, j)).to_vec()
}

fn applied(matrix: &Matrix<f64>, points: &[f64]) -> Vec<f64> {
    (0..matrix.rows())
        .map(|i| matrix.row(i).iter().zip(points).map(|(w, p)| w * p).sum())
        .collect()
}

#[test]
fn valence_4_is_the_tensor_product() {
    let mut sequence = Sequence(4);
    for _ in 0..20 {
        let spokes = random(&mut sequence, 4, 30.0);
        let (d, a) = (spokes.intervals(), spokes.next());
        let knots = |k: usize| [-d[k + 2] - a[k + 2], -d[k + 2], 0.0, d[k], d[k] + a[k]];
        let (u, v) = (knots(0), knots(1));
        let mut cubic = || [0; 4].map(|_| sequence.next() - 0.5);
        let (p, q) = (cubic(), cubic());
        let points = products(p, q, u, v);
        let halved = |t: [f64; 5]| [t[1], t[1] / 2.0, 0.0, t[3] / 2.0, t[3]];
        let size = points.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
        let found = applied(&nurss::matrix(&spokes).unwrap(), &points);
        assert!(difference(&found, &products(p, q, halved(u), halved(v))) < 1e-13 * size);
        // doubled knots: the corner of sector 0 is f(0, 0, d) in both directions
        let found = applied(&first_level::rows(&spokes, FirstLevel::Simple).unwrap(), &points);
        let corner = |i: usize, j: usize| polar(p, [0.0, 0.0, u[i]]) * polar(q, [0.0, 0.0, v[j]]);
        assert!(difference(&found, &[corner(3, 3), corner(1, 3), corner(1, 1), corner(3, 1)]) < 1e-13 * size);
        // linear data have Greville abscissae as points, and the improved rule is exact for them
        let greville = products([1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], u, v);
        let found = applied(&first_level::rows(&spokes, FirstLevel::Improved).unwrap(), &greville);
        let third = [v[3] / 3.0, v[3] / 3.0, v[1] / 3.0, v[1] / 3.0];
        let size = greville.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
        assert!(difference(&found, &third) < 1e-13 * size, "{found:?} {third:?}");
    }
}

/// The smallest gaps 1/2 - |lambda_4| over so many sets of each ratio, n = 3 to 20, none of which may violate
/// Lemma 1.
fn smallest_gaps(sets: usize) -> Vec<f64> {
    let mut sequence = Sequence(2019);
    let mut gaps = Vec::new();
    for ratio in [2.0, 10.0, 100.0, 1e4, 1e6] {
        let mut smallest = f64::INFINITY;
        for n in (3..=20).cycle().take(sets) {
            let ngon = NGon::new(&sequence.intervals(n, ratio)).unwrap();
            let mu = ngon.mu();
            let [least, greatest] =
                [f64::min, f64::max].map(|f| ngon.scaled_alpha().iter().copied().reduce(f).unwrap());
            assert!(least > 0.0 && greatest < 1.0);
            assert!(
                mu.iter().all(|&mu| least - 2e-15 <= mu && mu <= greatest + 2e-15),
                "{mu:?}"
            );
            let gap = mu.iter().map(|mu| 0.5 - (0.5 - mu).abs()).fold(0.5, f64::min);
            assert!(gap > 0.0 && gap >= ngon.gap_bound() - 2e-15);
            smallest = smallest.min(gap);
        }
        gaps.push(smallest);
    }
    gaps
}

/// Sets of each ratio; `results/nonuniform/lemma-1.csv` has 20 000.
const SETS: usize = 720;

#[test]
fn the_ngon_has_the_spectrum_of_lemma_1() {
    let gaps = smallest_gaps(SETS);
    // of the order of the design's: far from 0 at ratio 2, and falling
    assert!(
        gaps[0] > 0.1 && gaps.windows(2).all(|pair| pair[1] < pair[0]),
        "{gaps:?}"
    );
}

/// A vector times a matrix, from the left.
fn from_left(vector: &[f64], matrix: &Matrix<f64>) -> Vec<f64> {
    (0..matrix.columns())
        .map(|j| vector.iter().enumerate().map(|(i, w)| w * matrix[(i, j)]).sum())
        .collect()
}

fn check_ngon(d: &[f64]) {
    let n = d.len();
    let ngon = NGon::new(d).unwrap();
    let matrix = ngon.matrix();
    // Lemma 2: the regular polygon, from C
    let turn = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
    for coordinate in [f64::cos, f64::sin] {
        let centre: f64 = ngon
            .beta()
            .iter()
            .enumerate()
            .map(|(i, b)| b * coordinate(turn(i)))
            .sum();
        let polygon: Vec<f64> = (0..n).map(|i| coordinate(turn(i)) - centre).collect();
        let half: Vec<f64> = polygon.iter().map(|x| x / 2.0).collect();
        assert!(difference(&applied(&matrix, &polygon), &half) < 1e-14, "{d:?}");
    }
    let v = ngon.limit_weights();
    assert!((v.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    assert!(difference(&from_left(&v, &matrix), &v) < 1e-12, "{d:?}");
    for tangent in ngon.tangent_weights() {
        let size = tangent.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let half: Vec<f64> = tangent.iter().map(|x| x / 2.0).collect();
        assert!(difference(&from_left(&tangent, &matrix), &half) < 1e-12 * size, "{d:?}");
        assert!(tangent.iter().sum::<f64>().abs() < 1e-12 * size);
    }
}

#[test]
fn limits_and_tangents_of_the_ngon_are_left_eigenvectors() {
    let mut sequence = Sequence(77);
    for n in (3..=20).cycle().take(200) {
        check_ngon(&sequence.intervals(n, 100.0));
    }
    // one zero spoke and two adjacent ones, around the end of the list too
    for n in [4, 5, 6, 7, 9] {
        for zeros in [vec![0], vec![2], vec![n - 1], vec![0, 1], vec![n - 1, 0]] {
            let mut d = sequence.intervals(n, 3.0);
            zeros.iter().for_each(|&i| d[i] = 0.0);
            check_ngon(&d);
            let mu = NGon::new(&d).unwrap().mu();
            assert!(mu.iter().all(|&mu| mu > 1e-9 && mu < 1.0 - 1e-9), "{d:?} {mu:?}");
        }
    }
    let refused = |d: &[f64]| NGon::new(d).unwrap_err();
    assert!(matches!(
        refused(&[0.0, 1.0, 1.0, 0.0, 1.0, 1.0]),
        Error::ZeroSpokes { .. }
    ));
    for d in [
        &[0.0, 1.0, 0.0, 1.0, 1.0][..],
        &[0.0, 0.0, 1.0],
        &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
    ] {
        assert!(matches!(refused(d), Error::Scheme(_)), "{d:?}");
    }
}

fn eigenvalues(matrix: &Matrix<f64>) -> Vec<f64> {
    let values = Block::Real(matrix.clone()).eigenvalues().unwrap();
    values
        .iter()
        .flat_map(|e| std::iter::repeat_n(e.value.re.hypot(e.value.im), e.multiplicity))
        .collect()
}

#[test]
fn eigen_polyhedra_have_the_subdominant_eigenvalue_of_catmull_and_clark() {
    let mut sequence = Sequence(2016);
    for n in 3..=12 {
        let c = (std::f64::consts::TAU / n as f64).cos();
        let lambda = (5.0 + c + ((c + 9.0) * (c + 1.0)).sqrt()) / 16.0;
        let ratio = safe_ratio(n).unwrap().min(30.0);
        for _ in 0..25 {
            let d = sequence.intervals(n, ratio);
            let found = eigenvalues(&EigenPolyhedron::new(&d).unwrap().matrix().unwrap());
            assert!(
                (found[1] - lambda).abs() < 1e-12 && (found[2] - lambda).abs() < 1e-12,
                "{d:?} {found:?}"
            );
            assert!(found[3] < lambda - 1e-6 && (found[0] - 1.0).abs() < 1e-12, "{d:?}");
        }
    }
    // beyond the domain: refused, though there are real weights, which make a divergent scheme
    let d = [10.0, 1.0, 10.0, 1.0, 1.0];
    let wrong = eigenvalues(&EigenPolyhedron::anywhere(&d).unwrap().matrix().unwrap());
    assert!((wrong[0] - 1.42).abs() < 5e-3, "{wrong:?}");
    for d in [
        &d[..],
        &[10.0, 1.0, 10.0, 1.0, 10.0, 1.0],
        &[1e4, 1.0, 1.0, 1.0, 1.0, 1.0],
    ] {
        assert!(
            matches!(EigenPolyhedron::new(d), Err(Error::OutsideDomain { .. })),
            "{d:?}"
        );
    }
    for d in [&[10.0, 10.0, 1.0, 10.0, 1.0][..], &[10.0, 1.0, 1.0, 10.0, 1.0, 1.0]] {
        assert!(EigenPolyhedron::new(d).is_ok(), "{d:?}");
    }
}

#[test]
fn the_domain_ends_where_the_table_says() {
    for (n, threshold) in [
        (3, 9.6237),
        (5, 3.7301),
        (6, 4.6374),
        (7, 3.2069),
        (8, 3.0378),
        (9, 2.8434),
    ] {
        let exists = |ratio: f64| {
            let patterns = 1..(1_u32 << n) - 1;
            patterns.into_iter().all(|pattern| {
                let d: Vec<f64> = (0..n)
                    .map(|i| if pattern >> i & 1 == 1 { ratio } else { 1.0 })
                    .collect();
                EigenPolyhedron::new(&d).is_ok()
            })
        };
        assert!(exists(threshold - 1e-3) && !exists(threshold + 1e-3), "n = {n}");
    }
}

#[test]
fn the_improved_rule_has_the_limit_and_the_tangent_plane_of_the_eigen_polyhedron_surface() {
    let mut sequence = Sequence(42);
    for n in [3, 5, 6, 7, 8] {
        let spokes = random(&mut sequence, n, 2.9);
        let points: Vec<[f64; 3]> = (0..2 * n + 1).map(|_| [0; 3].map(|_| sequence.next())).collect();
        let combined = |row: &[f64]| {
            let sum = |k: usize| row.iter().zip(&points).map(|(w, p)| w * p[k]).sum::<f64>();
            nalgebra::Vector3::new(sum(0), sum(1), sum(2))
        };
        let polyhedron = EigenPolyhedron::new(spokes.intervals()).unwrap();
        let first = nurss::matrix::<f64>(&spokes).unwrap();
        let space = Block::Real(polyhedron.matrix().unwrap())
            .eigenspace(eigenring_scheme::Complex::real(polyhedron.lambda), 0)
            .unwrap();
        let tangents: Vec<_> = space
            .left
            .iter()
            .map(|left| combined(&from_left(&left.iter().map(|w| w.re).collect::<Vec<f64>>(), &first)))
            .collect();
        let normal = tangents[0].cross(&tangents[1]).normalize();
        let limit = combined(&from_left(&polyhedron.limit_weights().unwrap(), &first));
        let v = NGon::new(spokes.intervals()).unwrap().limit_weights();
        for rule in [FirstLevel::Improved, FirstLevel::Printed] {
            let rows = first_level::rows(&spokes, rule).unwrap();
            let corners: Vec<_> = (0..n).map(|i| combined(rows.row(i))).collect();
            let own: nalgebra::Vector3<f64> = corners.iter().zip(&v).map(|(p, w)| p * *w).sum();
            assert!((own - limit).norm() < 1e-10, "n = {n} {rule:?}");
            let plane = (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).normalize();
            let flat = corners
                .iter()
                .map(|p| (p - corners[0]).dot(&plane).abs())
                .fold(0.0, f64::max);
            assert!(flat < 1e-13, "n = {n} {rule:?}: {flat:e}");
            let angle = plane.cross(&normal).norm();
            // the printed rule has another plane
            assert!(
                if rule == FirstLevel::Improved {
                    angle < 1e-10
                } else {
                    angle > 1e-3
                },
                "n = {n} {angle:e}"
            );
        }
    }
}

/// On the net of a star a characteristic map is a multiple of itself at the next level: faces of the first
/// ring, refined, are those of both rings, scaled.
#[test]
fn characteristic_maps_are_multiples_of_themselves() {
    use eigenring_nonuniform::CharacteristicMap;
    for (scheme, d) in [
        ("nurss", vec![1.0, 2.0, 1.5, 0.8, 1.2]),
        ("eigen-polyhedron", vec![1.0, 2.0, 1.5, 0.8, 1.2]),
        ("eigen-polyhedron", vec![1.0, 3.0, 2.0]),
        ("hnuss", vec![1.0, 10.0, 1.0, 1.0, 3.0, 1.0, 7.0]),
        ("hnuss", vec![1.0, 2.0, 3.0]),
        ("nurss", vec![1.0, 2.0, 3.0, 1.0]),
    ] {
        let scheme: eigenring_nonuniform::Scheme = scheme.parse().unwrap();
        let [fine, coarse] = [2, 1].map(|levels| CharacteristicMap::new(scheme, &d, levels).unwrap());
        for sector in 0..d.len() {
            for face in 0..4 {
                // the face at place (a, b) has become quarter 0, 1, 3, 2 of the first
                let quarter = 16 * 4 * sector + 4 * [0, 1, 3, 2][face];
                let parts = &fine.cells[quarter..quarter + 4];
                for cell in &coarse.cells[4 * (4 * sector + face)..][..4] {
                    let scaled = cell.map(|p| [p[0] * fine.factors[0], p[1] * fine.factors[1]]);
                    let near = |p: &[f64; 2], q: &[f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]) < 1e-11;
                    let is = |part: &[[f64; 2]; 4]| scaled.iter().all(|p| part.iter().any(|q| near(p, q)));
                    assert!(parts.iter().any(is), "{scheme} {d:?} {sector} {face}");
                }
            }
        }
        assert!(fine.jacobians.iter().all(|jacobian| *jacobian > 0.0), "{scheme} {d:?}");
    }
}
