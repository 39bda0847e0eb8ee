use super::*;
use eigenring_scheme::Spec;
use eigenring_tune::quality::Quality;

fn scheme(spec: &str, valence: usize) -> Scheme<f64> {
    spec.parse::<Spec>().unwrap().scheme(valence).unwrap()
}

/// Twice the area of a polygon, by the shoelace formula.
fn doubled_area(corners: &[MapPoint]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| a.x * b.y - a.y * b.x).sum()
}

/// The points of one sheet that lie where points of another do, in pairs.
fn shared(a: &Sheet, b: &Sheet) -> Vec<(MapPoint, MapPoint)> {
    let points = |sheet: &Sheet| -> Vec<MapPoint> { sheet.tiles.iter().flat_map(|tile| tile.points.clone()).collect() };
    let (a, b) = (points(a), points(b));
    let near = |p: &MapPoint, q: &&MapPoint| (p.x - q.x).hypot(p.y - q.y) < 1e-9;
    a.iter()
        .filter_map(|p| b.iter().find(|q| near(p, q)).map(|q| (*p, *q)))
        .collect()
}

#[test]
fn jacobians_are_differences_over_the_mean_area_of_a_patch() {
    for spec in ["catmull-clark", "doo-sabin", "tension:order=8", "lambda:optimal"] {
        for valence in [3, 5, 20] {
            let scheme = scheme(spec, valence);
            let sheet = Sheet::characteristic(&scheme, 2, 16).unwrap();
            // the mean by the area of all cells, which the sampling does not know of
            let area: f64 = sheet.quads().map(|quad| doubled_area(&quad) / 2.0).sum();
            let mean = area / sheet.tiles.len() as f64;
            let (width, step) = (sheet.cells + 1, 1.0 / sheet.cells as f64);
            for tile in sheet.tiles.iter().take(20) {
                for (i, j) in [(1, 1), (8, 8), (3, 12), (15, 2)] {
                    let at = |i: usize, j: usize| tile.points[i + j * width];
                    let difference =
                        |a: MapPoint, b: MapPoint| [(b.x - a.x) / (2.0 * step), (b.y - a.y) / (2.0 * step)];
                    let (u, v) = (
                        difference(at(i - 1, j), at(i + 1, j)),
                        difference(at(i, j - 1), at(i, j + 1)),
                    );
                    let expected = (u[0] * v[1] - u[1] * v[0]) / mean;
                    let found = at(i, j).value;
                    assert!(
                        (found - expected).abs() < 0.01 * (1.0 + expected),
                        "{spec} {valence}: {found} {expected}"
                    );
                }
            }
        }
    }
}

#[test]
fn annuli_fit_together_with_their_values() {
    // C2 maps: points, heights, Jacobians and K* agree where one annulus ends and the next begins
    for (spec, valence) in [
        ("catmull-clark", 3),
        ("lambda:optimal", 5),
        ("tension:order=8", 7),
        ("lambda:lambda=0.35", 4),
    ] {
        let scheme = scheme(spec, valence);
        let map = Sheet::characteristic(&scheme, 1, 4).unwrap();
        let maps = Sheet::second_order(&scheme, 1, 4).unwrap();
        for sheet in std::iter::once(&map).chain(&maps) {
            let all = sheet.all();
            assert!(all[1].cells == 2 && all.last().unwrap().cells == 1);
            for pair in all.windows(2).take(3) {
                let shared = shared(&pair[1], &pair[0]);
                assert!(
                    shared.len() >= 2 * sheet.inner * valence,
                    "{} shared points",
                    shared.len()
                );
                for (p, q) in shared {
                    let tolerance = 1e-8 * (1.0 + q.value.abs());
                    assert!(
                        (p.z - q.z).abs() < 1e-10 && (p.value - q.value).abs() < tolerance,
                        "{spec}: {p:?} {q:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn sectors_are_rotations_and_saddles_turn_twice_as_fast() {
    for (spec, valence) in [("catmull-clark", 5), ("lambda:optimal", 8), ("catmull-clark", 3)] {
        let [cup, re, im] = Sheet::second_order(&scheme(spec, valence), 2, 3).unwrap();
        let per_sector = cup.tiles.len() / valence;
        let turn = std::f64::consts::TAU / valence as f64;
        let ((sin, cos), (sin2, cos2)) = (turn.sin_cos(), (2.0 * turn).sin_cos());
        for k in 0..per_sector {
            for i in 0..cup.tiles[k].points.len() {
                let pair = |sheet: &Sheet| (sheet.tiles[k].points[i], sheet.tiles[k + per_sector].points[i]);
                let ((a, b), (p, q), (r, s)) = (pair(&cup), pair(&re), pair(&im));
                assert!((b.x - cos * a.x + sin * a.y).abs() < 1e-10 && (b.y - sin * a.x - cos * a.y).abs() < 1e-10);
                assert!((a.z - b.z).abs() < 1e-10 && (a.value - b.value).abs() < 1e-8);
                assert!((q.z - cos2 * p.z + sin2 * r.z).abs() < 1e-9, "{spec}");
                assert!((s.z - sin2 * p.z - cos2 * r.z).abs() < 1e-9, "{spec}");
            }
        }
    }
}

#[test]
fn the_regular_maps_have_constant_values() {
    let regular = scheme("catmull-clark", 4);
    let map = Sheet::characteristic(&regular, 1, 4).unwrap();
    let maps = Sheet::second_order(&regular, 1, 4).unwrap();
    for (sheet, sign) in std::iter::once(&map).chain(&maps).zip([1.0, 1.0, -1.0, -1.0]) {
        for annulus in sheet.all() {
            assert!(annulus.quads().flatten().all(|point| (point.value - sign).abs() < 1e-9));
            assert!(annulus.zero_lines(sign).is_empty());
        }
    }
    assert!((map.radius() - 8f64.sqrt()).abs() < 1e-12);
    // squares: the boundaries of 12 patches, of which those of the hole belong to the next annulus
    let length: f64 = map
        .edges()
        .iter()
        .flat_map(|edge| {
            edge.windows(2)
                .map(|p| (p[0].x - p[1].x).hypot(p[0].y - p[1].y))
                .collect::<Vec<_>>()
        })
        .sum();
    assert!((length - (16.0 + 12.0)).abs() < 1e-9, "{length}");
    assert_eq!(map.isolines(2).len(), 2 * 12);
}

#[test]
fn wrong_signs_are_outlined_where_the_gauss_curvature_has_them() {
    for (spec, valence) in [
        ("catmull-clark", 6),
        ("lambda:optimal", 6),
        ("lambda:optimal", 20),
        ("lambda:lambda=0.35", 8),
    ] {
        let scheme = scheme(spec, valence);
        let quality = Quality::new(&scheme, 9).unwrap();
        let maps = Sheet::second_order(&scheme, 2, 8).unwrap();
        let mut outlined = 0;
        for ((sheet, map), sign) in maps.iter().zip(quality.maps).zip([1.0, -1.0, -1.0]) {
            let lines = sheet.zero_lines(sign);
            outlined += lines.len();
            // a region that Gauss points do not meet can still be outlined, but only a small one
            let wrong = if sign > 0.0 {
                map.gauss_min < 0.0
            } else {
                map.gauss_max > 0.0
            };
            let area: usize = sheet
                .quads()
                .filter(|quad| quad.iter().any(|point| sign * point.value < 0.0))
                .count();
            assert!(
                wrong != lines.is_empty() || (!wrong && area < 8 * valence),
                "{spec} {valence}: {area} cells"
            );
            assert!(lines.iter().flatten().all(|point| point.value.abs() < 1e-9));
        }
        assert_eq!(outlined > 0, quality.sign_change() > 0.0, "{spec} {valence}");
    }
}

#[test]
fn opposite_corners_are_cut_off_one_by_one() {
    let point = |x: f64, y: f64, value: f64| MapPoint { x, y, z: 0.0, value };
    let sheet = |values: [f64; 4]| Sheet {
        lattice: Lattice::Vertex,
        inner: 1,
        cells: 1,
        factors: Factors {
            plane: 0.5,
            height: 0.25,
            value: 1.0,
        },
        tiles: vec![Tile {
            patch: PatchIndex { sector: 0, p: 1, q: 0 },
            points: vec![
                point(0.0, 0.0, values[0]),
                point(1.0, 0.0, values[1]),
                point(0.0, 1.0, values[2]),
                point(1.0, 1.0, values[3]),
            ],
        }],
    };
    // corners (0,0) and (1,1) are wrong: each segment is nearer to one of them than to the right ones
    let lines = sheet([-1.0, 2.0, 2.0, -1.0]).zero_lines(1.0);
    assert_eq!(lines.len(), 2);
    for [a, b] in &lines {
        assert!((a.x + a.y - b.x - b.y).abs() < 1e-12, "{a:?} {b:?}");
        assert!(((a.x + a.y) - 1.0 / 3.0).abs() < 1e-12 || ((a.x + a.y) - 5.0 / 3.0).abs() < 1e-12);
    }
    let lines = sheet([1.0, -2.0, -2.0, 1.0]).zero_lines(1.0);
    assert!(lines.len() == 2 && lines.iter().all(|[a, b]| (a.x - a.y - b.x + b.y).abs() < 1e-12));
    assert_eq!(sheet([1.0, 1.0, -1.0, -1.0]).zero_lines(1.0).len(), 1);
    assert!(sheet([f64::NAN; 4]).zero_lines(1.0).is_empty());
}

#[test]
fn schemes_without_a_map_are_refused() {
    // tension order 3 at valence 3: lambda = 1/4 is defective
    assert!(Sheet::characteristic(&scheme("tension:order=3", 3), 1, 2).is_err());
    // Doo-Sabin has a characteristic map but resonant second-order maps
    assert!(Sheet::second_order(&scheme("doo-sabin", 5), 1, 2).is_err());
    assert_eq!(common_inner([&scheme("catmull-clark", 5)]).unwrap(), 1);
    assert_eq!(
        common_inner([&scheme("catmull-clark", 5), &scheme("lambda:optimal", 5)]).unwrap(),
        2
    );
}
