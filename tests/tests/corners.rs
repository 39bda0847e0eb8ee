//! **Claim**: rules beside boundaries, creases, darts, corners and cusps, with knot intervals, and around a
//! face that is never split are what they should be. **Oracles**: eigenvalues and limits computed by an
//! independent implementation in another language (`data/split_faces.json`, and the table below); curve
//! rules; reflection of a regular net; blossoms; and one family against another that states its rules in
//! other passes.

use eigenring_scheme::{
    Centre, Corner, Definition, DenseNet, Error, Fan, Level, PointNet, Scheme, Site, Spec, Symmetry, refine,
};
use eigenring_spectral::{LocalSystem, Matrix, local_matrix};
use proptest::prelude::*;
use serde::Deserialize;

fn definition(spec: &str) -> Definition {
    Definition::Family(spec.parse::<Spec>().unwrap())
}

fn around(spec: &str, corner: &Corner) -> Scheme<f64> {
    definition(spec).around(corner).unwrap()
}

/// Eigenvalues on the smallest closed rings, by falling modulus, and how many vectors each cluster has.
fn leading(scheme: &Scheme<f64>) -> Vec<f64> {
    let system = LocalSystem::new(scheme.limit(), scheme.closed_rings().unwrap()).unwrap();
    let spectrum = system.spectrum().unwrap();
    let values = spectrum.eigenvalues.iter();
    values.flat_map(|e| vec![e.value.re; e.multiplicity]).collect()
}

fn close(found: &[f64], expected: &[f64], tolerance: f64) -> bool {
    found.len() >= expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < tolerance)
}

/// From the independent implementation, six digits, for the corners of its meshes; and closed forms where
/// there are some.
#[test]
fn leading_eigenvalues_of_catmull_clark_at_corners() {
    let golden = (3.0 + 5.0_f64.sqrt()) / 8.0;
    for (corner, expected) in [
        (Corner::fan(1).unwrap(), vec![1.0, 0.5, 0.25, 0.25]),
        (Corner::fan(2).unwrap(), vec![1.0, 0.5, 0.5, 0.25]),
        (Corner::fan(3).unwrap(), vec![1.0, 0.579682, 0.5, 0.410097]),
        (Corner::fan(4).unwrap(), vec![1.0, 0.611117, 0.5, 0.5]),
        (Corner::fan(5).unwrap(), vec![1.0, 0.626341, 0.549988, 0.5]),
        (Corner::fan(1).unwrap().fixed(), vec![1.0, 0.5, 0.5, 0.25]),
        (Corner::dart(4).unwrap(), vec![1.0, 0.5, 0.5, 0.319682]),
        (Corner::dart(5).unwrap(), vec![1.0, 0.549988, 0.526424, 0.391956]),
        // the needle's mode is that of block 0 without the centre, the same at every valence
        (Corner::cusp(3).unwrap(), vec![1.0, golden]),
        (Corner::cusp(7).unwrap(), vec![1.0, golden]),
    ] {
        let found = leading(&around("catmull-clark", &corner));
        assert!(close(&found, &expected, 1e-4), "{corner}: {found:?}");
    }
    assert!(close(
        &leading(&around("catmull-clark", &Corner::dart(5).unwrap())),
        &[1.0, 0.549988, 0.526424, 0.391956],
        6e-7
    ));
}

/// The open fan of n faces has the curve's 1, 1/2, 1/4 and the sine modes of the closed fan of 2n: its
/// Fourier blocks 1 to n-1.
#[test]
fn open_fans_have_the_sine_modes_of_the_double_fan() {
    for faces in 1..=8 {
        for order in [4, 6, 8] {
            let spec = format!("stam:order={order}");
            let open = leading(&around(&spec, &Corner::fan(faces).unwrap()));
            let mut expected = vec![1.0, 0.5, 0.25];
            if faces > 1 {
                let closed = definition(&spec).closed(2 * faces).unwrap();
                let closed: Scheme<f64> = definition(&spec).around(&closed).unwrap();
                let system = LocalSystem::new(closed.limit(), closed.closed_rings().unwrap()).unwrap();
                for block in &system.blocks()[1..faces] {
                    expected.push(block.eigenvalues().unwrap()[0].value.re);
                }
            }
            for value in expected {
                let nearest = open
                    .iter()
                    .map(|found| (found - value).abs())
                    .fold(f64::INFINITY, f64::min);
                assert!(nearest < 1e-7, "{faces} faces, order {order}: {value} of {open:?}");
            }
        }
    }
}

#[test]
fn a_crease_with_one_face_is_defective_at_a_quarter() {
    let eigenvalue = |corner: Corner, value: f64| {
        let scheme = around("catmull-clark", &corner);
        let spectrum = LocalSystem::new(scheme.limit(), 1).unwrap().spectrum().unwrap();
        let found = spectrum
            .eigenvalues
            .into_iter()
            .find(|e| (e.value.re - value).abs() < 1e-9);
        found.unwrap()
    };
    let quarter = eigenvalue(Corner::fan(1).unwrap(), 0.25);
    assert_eq!((quarter.multiplicity, quarter.geometric), (2, Some(1)));
    // a corner with two faces: the pair itself
    let half = eigenvalue(Corner::fan(2).unwrap().fixed(), 0.5);
    assert!(half.is_defective(), "{half:?}");
    // a dart of valence four is semisimple
    let half = eigenvalue(Corner::dart(4).unwrap(), 0.5);
    assert_eq!((half.multiplicity, half.geometric), (2, Some(2)));
}

fn rows(level: &Level<f64>, rings: usize) -> Matrix<f64> {
    local_matrix(level, rings).unwrap()
}

/// Order 4 at u = 1 states the same rules in two passes.
#[test]
fn catmull_clark_and_order_four_agree_at_every_corner() {
    let mut corners: Vec<Corner> = (1..=8).map(|n| Corner::fan(n).unwrap()).collect();
    corners.extend((1..=8).map(|n| Corner::fan(n).unwrap().fixed()));
    corners.extend((3..=9).flat_map(|n| [Corner::dart(n).unwrap(), Corner::cusp(n).unwrap()]));
    for corner in corners {
        let [one, other] = ["catmull-clark", "stam:order=4"].map(|spec| around(spec, &corner));
        let (one, other) = (rows(one.limit(), 3), rows(other.limit(), 3));
        for (a, b) in one.entries().iter().zip(other.entries()) {
            assert!((a - b).abs() < 1e-15, "{corner}");
        }
    }
}

/// A boundary is a mirror: on a regular net the rules are those of the net continued by `P(-j) = 2 P(0) -
/// P(j)`.
#[test]
fn a_regular_boundary_is_the_net_continued_by_reflection() {
    for order in [4, 6, 8] {
        for u0 in [0.3, 1.0, 2.0] {
            let spec = format!("tension:order={order},u0={u0}");
            let open = around(&spec, &Corner::fan(2).unwrap());
            let closed: Scheme<f64> = definition(&spec).around(&definition(&spec).closed(4).unwrap()).unwrap();
            let rings = 6;
            let value = |site: Site| (1.3 * f64::from(site.x) + 0.7 * f64::from(site.y) + site.sector as f64).sin();
            // the open fan's sectors 0 and 1 are the upper half plane; spoke 2 of the closed fan continues
            // spoke 0
            let reflected = |site: Site| {
                let below = site.sector >= 2 && !(site.sector == 2 && site.y == 0);
                if !below {
                    return value(site);
                }
                let image = site.mirrored(Fan::Closed(4));
                let foot = match (image.sector, image.x, image.y) {
                    (0, x, _) => Site { sector: 0, x, y: 0 },
                    (1, x, 0) => {
                        debug_assert!(x > 0);
                        Site::CENTRE
                    }
                    (_, _, y) => Site { sector: 2, x: y, y: 0 },
                };
                2.0 * value(foot) - value(image)
            };
            for level in 0..3 {
                let (open, closed) = (open.level(level), closed.level(level));
                let points = |level: &Level<f64>, at: &dyn Fn(Site) -> f64| {
                    let numbering = level.numbering(rings);
                    let points = numbering.sites().into_iter().map(|site| [at(site)]).collect();
                    PointNet { numbering, points }
                };
                let wanted = open.numbering(rings - 2).sites();
                let found = refine(open, &points(open, &value), &wanted).unwrap();
                let expected = refine(closed, &points(closed, &reflected), &wanted).unwrap();
                for (site, (a, b)) in wanted.iter().zip(found.iter().zip(&expected)) {
                    assert!(
                        (a[0] - b[0]).abs() < 1e-14,
                        "{spec} level {level} {site:?}: {} {}",
                        a[0],
                        b[0]
                    );
                }
            }
        }
    }
}

#[test]
fn the_limit_of_a_crease_is_that_of_its_curve() {
    for faces in 1..=8 {
        let scheme = around("catmull-clark", &Corner::fan(faces).unwrap());
        let system = LocalSystem::new(scheme.limit(), 1).unwrap();
        for (site, weight) in system.numbering().sites().iter().zip(system.limit_position().unwrap()) {
            let expected = match (site.sector, site.x, site.y) {
                (_, 0, 0) => 4.0 / 6.0,
                (sector, 2, 0) if sector == 0 || sector == faces => 1.0 / 6.0,
                _ => 0.0,
            };
            assert!((weight - expected).abs() < 1e-12, "{faces} {site:?}: {weight}");
        }
    }
}

/// Creases that act in one of two steps only: across them an eigenvalue above 1/4.
#[test]
fn creases_act_in_the_steps_they_are_given() {
    let corner = |steps| {
        let mut spokes = Corner::dart(4).unwrap();
        if let Some(steps) = steps {
            spokes = spokes.with_steps(steps);
        }
        spokes
    };
    let matrix = |steps| rows(around("stam:order=6", &corner(steps)).limit(), 3);
    assert_eq!(matrix(None), matrix(Some(2)));
    assert_ne!(matrix(Some(1)), matrix(Some(2)));
    let smooth = around("stam:order=6", &definition("stam:order=6").closed(4).unwrap());
    assert_eq!(matrix(Some(0)), rows(smooth.limit(), 3));
    let error = definition("stam:order=6")
        .around::<f64>(&corner(Some(3)))
        .unwrap_err()
        .to_string();
    assert!(error.contains("0 to 2"), "{error}");
}

#[test]
fn corners_without_rules_are_refused() {
    for (spec, corner) in [
        ("doo-sabin", Corner::fan(2).unwrap()),
        ("tension:order=5", Corner::fan(2).unwrap()),
        ("tension:order=3", Corner::dart(5).unwrap()),
        ("catmull-clark", Corner::dart(5).unwrap().with_steps(1)),
        ("catmull-clark", Corner::closed(Centre::Face, 5).unwrap()),
        ("stam:order=6", Corner::closed(Centre::SplitFace, 5).unwrap()),
    ] {
        let error = definition(spec).around::<f64>(&corner).unwrap_err();
        assert!(matches!(error, Error::Unsupported { .. }), "{spec} {corner}: {error}");
    }
    let five = Corner::closed(Centre::Vertex, 5).unwrap();
    let five = five.with_intervals(&[1.0, 2.0, 1.0, 1.0, 1.0], &[1.0; 5]).unwrap();
    assert!(definition("catmull-clark").around::<f64>(&five).is_err());
}

/// Knots along one direction, from their intervals.
fn knots(intervals: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    std::iter::once(0.0)
        .chain(intervals.iter().map(|d| {
            sum += d;
            sum
        }))
        .collect()
}

/// The blossom of a cubic.
fn blossom(c: [f64; 4], [a, b, d]: [f64; 3]) -> f64 {
    c[0] + c[1] * (a + b + d) / 3.0 + c[2] * (a * b + a * d + b * d) / 3.0 + c[3] * a * b * d
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    /// Where four sectors meet, points are products of two blossoms at three knots each, and so are refined
    /// points at the knots with all intervals halved: insertion of a knot in the middle of every interval, in
    /// both directions.
    #[test]
    fn valence_four_with_intervals_is_knot_insertion(
        d in proptest::array::uniform4(0.05..4.0_f64), a in proptest::array::uniform4(0.05..4.0_f64),
        c in proptest::array::uniform4(-1.0..1.0_f64), e in proptest::array::uniform4(-1.0..1.0_f64),
    ) {
        let corner = Corner::closed(Centre::Vertex, 4).unwrap().with_intervals(&d, &a).unwrap();
        let scheme = around("catmull-clark", &corner);
        const REACH: i32 = 16;
        // intervals along spoke 0 and its continuation 2, and along 1 and 3; refined ones for each level
        let line = |level: u32, plus: usize, minus: usize| {
            let side = |spoke: usize| -> Vec<f64> {
                let mut list = vec![a[spoke]; REACH as usize];
                list[0] = d[spoke];
                for _ in 0..level {
                    list = list.iter().flat_map(|x| [x / 2.0, x / 2.0]).take(REACH as usize).collect();
                }
                list
            };
            let (before, after) = (side(minus), side(plus));
            let all: Vec<f64> = before.iter().rev().chain(&after).copied().collect();
            let all = knots(&all);
            let zero = all[REACH as usize];
            move |j: i32| all[(j + REACH) as usize] - zero
        };
        for level in 0..3 {
            let [x, y] = [line(level, 0, 2), line(level, 1, 3)];
            let [fine_x, fine_y] = [line(level + 1, 0, 2), line(level + 1, 1, 3)];
            let place = |site: Site| {
                let (mut x, mut y) = (site.x / 2, site.y / 2);
                for _ in 0..site.sector {
                    (x, y) = (-y, x);
                }
                (x, y)
            };
            let at = |knot: &dyn Fn(i32) -> f64, j: i32| [knot(j - 1), knot(j), knot(j + 1)];
            let level = scheme.level(level as usize);
            let numbering = level.numbering(5);
            let value = |site: Site| {
                let (i, j) = place(site);
                [blossom(c, at(&x, i)) * blossom(e, at(&y, j))]
            };
            let points = numbering.sites().into_iter().map(value).collect();
            let wanted = level.numbering(5).sites();
            let found = refine(level, &PointNet { numbering, points }, &wanted).unwrap();
            for (site, [found]) in wanted.into_iter().zip(found) {
                let (i, j) = place(site);
                let expected = blossom(c, at(&fine_x, i)) * blossom(e, at(&fine_y, j));
                let scale = 1.0 + expected.abs();
                prop_assert!((found - expected).abs() < 1e-11 * scale, "{:?}: {} {}", site, found, expected);
            }
        }
    }

    /// Any positive intervals around any n-gon: 1, 1/2, 1/2, and the rest strictly below.
    #[test]
    fn split_faces_have_one_half_twice(n in 3..12_usize, d in proptest::collection::vec(0.1..10.0_f64, 12)) {
        let corner = Corner::closed(Centre::SplitFace, n).unwrap();
        let corner = corner.with_intervals(&d[..n], &d[..n]).unwrap();
        let scheme = around("catmull-clark", &corner);
        let matrix = rows(scheme.limit(), scheme.closed_rings().unwrap());
        for row in 0..matrix.rows() {
            prop_assert!((matrix.row(row).iter().sum::<f64>() - 1.0).abs() < 1e-13);
        }
        let found = leading(&scheme);
        prop_assert!(close(&found, &[1.0, 0.5, 0.5], 1e-7), "{:?}", found);
        prop_assert!(found.get(3).is_none_or(|&next| next < 0.5 - 1e-6), "{:?}", found);
    }
}

#[derive(Deserialize)]
struct SplitFace {
    valence: usize,
    intervals: Vec<f64>,
    next: Vec<f64>,
    q: Vec<Vec<f64>>,
    spectrum: Vec<f64>,
    limit_weights: Vec<f64>,
}

#[test]
fn corners_of_the_split_face_are_those_of_the_reference() {
    let cases: Vec<SplitFace> = serde_json::from_str(include_str!("../data/split_faces.json")).unwrap();
    assert!(cases.len() >= 10);
    for case in cases {
        let n = case.valence;
        let corner = Corner::closed(Centre::SplitFace, n).unwrap();
        let corner = corner.with_intervals(&case.intervals, &case.next).unwrap();
        let scheme = around("catmull-clark", &corner);
        let matrix = rows(scheme.limit(), 0);
        for (i, row) in case.q.iter().enumerate() {
            for (found, expected) in matrix.row(i).iter().zip(row) {
                assert!((found - expected).abs() < 1e-13, "{n}: {found} {expected}");
            }
        }
        let system = LocalSystem::new(scheme.limit(), 0).unwrap();
        assert!(
            close(&leading(&scheme), &case.spectrum, 1e-7),
            "{n}: {:?} {:?}",
            leading(&scheme),
            case.spectrum
        );
        for (found, expected) in system.limit_position().unwrap().iter().zip(&case.limit_weights) {
            assert!((found - expected).abs() < 1e-10, "{n}: {found} {expected}");
        }
    }
}

#[test]
fn equal_intervals_keep_the_symmetry_and_are_doo_sabin_on_the_n_gon() {
    for n in [3, 5, 6, 9] {
        let corner = Corner::closed(Centre::SplitFace, n).unwrap();
        let scheme = around("catmull-clark", &corner);
        assert_eq!(scheme.limit().symmetry(), Symmetry::Dihedral, "{n}");
        let closed = definition("doo-sabin").closed(n).unwrap();
        let doo_sabin: Scheme<f64> = definition("doo-sabin").around(&closed).unwrap();
        let (one, other) = (rows(scheme.limit(), 0), rows(doo_sabin.limit(), 0));
        for (a, b) in one.entries().iter().zip(other.entries()) {
            assert!((a - b).abs() < 1e-15, "{n}");
        }
    }
}

#[test]
fn what_is_not_the_same_all_round_has_no_fourier_blocks() {
    for corner in [Corner::dart(5).unwrap(), Corner::fan(3).unwrap()] {
        let scheme = around("catmull-clark", &corner);
        assert_eq!(
            (scheme.limit().symmetry(), scheme.degree()),
            (Symmetry::None, None),
            "{corner}"
        );
        let net = DenseNet {
            numbering: scheme.numbering(2),
        };
        assert!(refine(scheme.limit(), &net, &net.numbering.sites()).is_ok());
    }
    // a cusp is the same all round
    let cusp = around("catmull-clark", &Corner::cusp(5).unwrap());
    assert_eq!((cusp.limit().symmetry(), cusp.degree()), (Symmetry::Dihedral, Some(3)));
}
