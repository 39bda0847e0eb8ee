//! Refined meshes against Boehm insertion on regular grids and against the prototype's nets.

use crate::common::{Net, Regular, cases};
use eigenring_nonuniform::{FirstLevel, Limits, Outside, Refinement, Scheme, refined};
use eigenring_surface::features::edge;
use eigenring_surface::{Mesh, Point3};

const HNUSS: Scheme = Scheme::Hnuss(FirstLevel::Improved);

/// A grid of which `points` has columns along u, row by row.
fn grid(case: &Regular) -> (Mesh, Vec<[f64; 4]>) {
    let (columns, rows) = (case.du.len() as u32 + 1, case.dv.len() as u32 + 1);
    let lifted: Vec<[f64; 4]> = case
        .points
        .iter()
        .map(|p| [p[0], p[1], p[2], p.get(3).copied().unwrap_or(1.0)])
        .collect();
    let at = |i: u32, j: u32| j * columns + i;
    let faces = (0..rows - 1).flat_map(|j| (0..columns - 1).map(move |i| (i, j)));
    let faces = faces.map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
    let points = lifted
        .iter()
        .map(|p| Point3::new(p[0] / p[3], p[1] / p[3], p[2] / p[3]));
    let mut mesh = Mesh::new(points.collect(), faces).unwrap();
    if case.homogeneous {
        mesh.set_weights(lifted.iter().map(|p| p[3]).collect());
    }
    for (i, &d) in (0..).zip(&case.du) {
        mesh.features.knots.insert(edge(at(i, 0), at(i + 1, 0)), d);
    }
    for (j, &d) in (0..).zip(&case.dv) {
        mesh.features.knots.insert(edge(at(0, j), at(0, j + 1)), d);
    }
    for &i in &case.doubled_columns {
        for &j in &case.doubled_rows {
            mesh.features.extraordinary.insert(at(i as u32, j as u32));
        }
    }
    (mesh, lifted)
}

/// The largest distance of two sets of points, each to its nearest of the other; counts must agree.
fn distance<const D: usize>(found: &[[f64; D]], expected: &[Vec<f64>]) -> f64 {
    assert_eq!(found.len(), expected.len(), "numbers of points");
    let gap = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    let nearest =
        |p: &[f64], all: &mut dyn Iterator<Item = &[f64]>| all.map(|q| gap(p, q)).fold(f64::INFINITY, f64::min);
    let there = found
        .iter()
        .map(|p| nearest(p, &mut expected.iter().map(Vec::as_slice)));
    let back = expected
        .iter()
        .map(|p| nearest(p, &mut found.iter().map(|q| q.as_slice())));
    there.chain(back).fold(0.0, f64::max)
}

#[test]
fn regular_grids_are_refined_as_by_knot_insertion() {
    for case in &cases().regular {
        let (mesh, lifted) = grid(case);
        let doubled = !case.doubled_columns.is_empty();
        let zeros = case.du.iter().chain(&case.dv).any(|&d| d == 0.0);
        let mut schemes = vec![HNUSS, Scheme::Hnuss(FirstLevel::Simple)];
        if !doubled && !zeros {
            schemes.extend([Scheme::Nurss, Scheme::EigenPolyhedron]);
        }
        for scheme in schemes {
            let mut refinement = Refinement::new(&mesh, scheme, Outside::Error).unwrap();
            for (level, expected) in case.levels.iter().enumerate() {
                if level > 0 {
                    refinement.refine().unwrap();
                }
                let points = refinement.apply(&lifted).unwrap();
                let width = expected.points[0].len();
                let error = if width == 4 {
                    distance(&points, &expected.points)
                } else {
                    let points: Vec<[f64; 3]> = points.iter().map(|p| [p[0], p[1], p[2]]).collect();
                    distance(&points, &expected.points)
                };
                let size = lifted.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
                assert!(error < 1e-13 * size, "{scheme:?} level {level}: {error:e}");
            }
        }
    }
}

/// How far the edges of two meshes are from each other: their middles, and their intervals.
pub fn distance_of_edges(a: &Mesh, b: &Mesh) -> f64 {
    let edges = |mesh: &Mesh| -> Vec<[f64; 4]> {
        let knots = mesh.features.knots.iter();
        let middle = |&[a, b]: &[u32; 2]| {
            let [a, b] = [a, b].map(|end| mesh.points()[end as usize].coords);
            (a + b) / 2.0
        };
        let at = knots.map(|(pair, &d)| (middle(pair), d));
        at.map(|(p, d)| [p.x, p.y, p.z, d]).collect()
    };
    assert_eq!(a.features.knots.len(), b.features.knots.len());
    let expected: Vec<Vec<f64>> = edges(b).iter().map(|edge| edge.to_vec()).collect();
    distance(&edges(a), &expected)
}

/// Blocks against the tables of single levels, which are held to account by the prototype: points, and edges
/// with their intervals at the same places.
#[test]
fn blocks_are_halvings() {
    let cases = cases();
    let grids = cases.regular.iter().map(|case| grid(case).0);
    let meshes = cases.meshes.iter().map(|case| mesh_of(&case.control));
    let (mut cut, mut ngons) = (0, 0);
    for mesh in grids.chain(meshes) {
        let size = mesh.points().iter().fold(0.0, |m: f64, p| m.max(p.coords.amax()));
        let mut refinement = Refinement::new(&mesh, HNUSS, Outside::Error).unwrap();
        for level in 0..3 {
            if level > 0 {
                refinement.refine().unwrap();
            }
            let lifted: Vec<[f64; 4]> = mesh
                .points()
                .iter()
                .zip(0..)
                .map(|(p, k)| {
                    let w = mesh.weights().map_or(1.0, |weights| weights[k]);
                    [w * p.x, w * p.y, w * p.z, w]
                })
                .collect();
            let points = refinement.apply(&lifted).unwrap();
            let points = points.iter().map(|[x, y, z, w]| Point3::new(x / w, y / w, z / w));
            let expected = refinement.net().with_points(points.collect(), None);
            let found = refined(&mesh, HNUSS, level, Outside::Error).unwrap().mesh;
            assert_eq!(found.faces_by_size(), expected.faces_by_size());
            let error = distance_of_edges(&found, &expected);
            assert!(error < 1e-13 * size.max(1.0), "level {level}: {error:e}");
            cut += found.face_count();
            ngons += found.faces().filter(|face| face.len() != 4).count();
        }
    }
    assert!(cut > 1000 && ngons > 10, "{cut} faces, {ngons} extraordinary ones");
}

pub fn mesh_of(net: &Net) -> Mesh {
    let points = net.points.iter().map(|p| Point3::new(p[0], p[1], p[2]));
    let mut mesh = Mesh::new(points.collect(), net.faces.as_ref().unwrap()).unwrap();
    for &(a, b, d) in net.intervals.as_ref().unwrap() {
        mesh.features.knots.insert(edge(a, b), d);
    }
    mesh
}

#[test]
fn meshes_are_refined_as_by_the_prototype() {
    for case in &cases().meshes {
        let mesh = mesh_of(&case.control);
        for (name, nets) in &case.refined {
            let (scheme, first) = match name.as_str() {
                "nurss" => (Scheme::Nurss, 1),
                "eigen-polyhedron" => (Scheme::EigenPolyhedron, 1),
                "hnuss-simple" => (Scheme::Hnuss(FirstLevel::Simple), 0),
                "hnuss-printed" => (Scheme::Hnuss(FirstLevel::Printed), 0),
                _ => (HNUSS, 0),
            };
            for (level, expected) in (first..).zip(nets) {
                let label = format!("{} {name} {level}", case.name);
                let found = refined(&mesh, scheme, level, Outside::Error).unwrap().mesh;
                let points: Vec<[f64; 3]> = found.points().iter().map(|p| [p.x, p.y, p.z]).collect();
                let error = distance(&points, &expected.points);
                assert!(error < 1e-12, "{label}: {error:e}");
                let faces = expected.face_count.or(expected.faces.as_ref().map(Vec::len));
                assert_eq!(Some(found.face_count()), faces, "{label}");
                let edges = expected.edge_count.or(expected.intervals.as_ref().map(Vec::len));
                assert_eq!(Some(found.features.knots.len()), edges, "{label}");
                if let Some(ngons) = &expected.extraordinary_faces {
                    let found = found.faces().filter(|face| face.len() != 4).count();
                    let expected = ngons
                        .iter()
                        .filter(|&&f| expected.faces.as_ref().unwrap()[f].len() != 4)
                        .count();
                    assert_eq!(found, expected, "{label}");
                }
                // intervals are those of the edges between the same points
                if let Some(intervals) = &expected.intervals {
                    let nearest = |p: &[f64]| {
                        let gap = |q: &[f64; 3]| q.iter().zip(p).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
                        let best = points.iter().enumerate().min_by(|a, b| gap(a.1).total_cmp(&gap(b.1)));
                        best.unwrap().0 as u32
                    };
                    for &(a, b, d) in intervals {
                        let pair = edge(
                            nearest(&expected.points[a as usize]),
                            nearest(&expected.points[b as usize]),
                        );
                        let own = found.features.knots.get(&pair);
                        assert!(own.is_some_and(|own| (own - d).abs() < 1e-12), "{label}: {a}-{b}");
                    }
                }
            }
        }
    }
}

/// The polar form of the cubic with these coefficients, lowest first.
fn polar(c: [f64; 4], [a, b, d]: [f64; 3]) -> f64 {
    c[0] + c[1] * (a + b + d) / 3.0 + c[2] * (a * b + a * d + b * d) / 3.0 + c[3] * a * b * d
}

/// Products of cubics are refined exactly, whatever the intervals: inner points are values of polar forms at
/// the refined knots.
#[test]
fn intervals_of_a_ratio_of_a_million_lose_few_digits() {
    let mut sequence = crate::common::Sequence(6);
    for ratio in [30.0, 1e6] {
        let mut direction = || {
            let d = sequence.intervals(5, ratio);
            let mut knots = vec![-d[0], 0.0];
            d.iter().for_each(|d| knots.push(knots[knots.len() - 1] + d));
            knots.push(knots[6] + d[4]);
            // of unit size over all knots
            let size = knots[6];
            let c = [0, 1, 2, 3].map(|k| (sequence.next() - 0.5) / size.powi(k));
            (d, knots, c)
        };
        let ((du, u, p), (dv, v, q)) = (direction(), direction());
        let control = |knots: &[f64], c: [f64; 4]| -> Vec<f64> {
            knots.windows(3).map(|t| polar(c, [t[0], t[1], t[2]])).collect()
        };
        let fine = |knots: &[f64], c: [f64; 4]| {
            let halves = knots.windows(2).flat_map(|t| [t[0], 0.5 * (t[0] + t[1])]);
            let halved: Vec<f64> = halves.chain([knots[knots.len() - 1]]).collect();
            // from the first knot on: the edge, the vertex, and so on; the ends are boundaries
            control(&halved[1..halved.len() - 1], c)
        };
        let products = |u: &[f64], v: &[f64]| -> Vec<Vec<f64>> {
            v.iter()
                .flat_map(|b| u.iter().map(move |a| vec![*a, *b, a * b]))
                .collect()
        };
        let case = Regular {
            points: products(&control(&u, p), &control(&v, q)),
            du,
            dv,
            doubled_columns: Vec::new(),
            doubled_rows: Vec::new(),
            homogeneous: false,
            levels: Vec::new(),
        };
        let (mesh, _) = grid(&case);
        let (inner_u, inner_v) = (fine(&u, p), fine(&v, q));
        let inner = products(&inner_u[1..inner_u.len() - 1], &inner_v[1..inner_v.len() - 1]);
        for scheme in [Scheme::Nurss, Scheme::EigenPolyhedron, HNUSS] {
            let found = refined(&mesh, scheme, 1, Outside::Error).unwrap().mesh;
            for point in &inner {
                let gap = |p: &Point3<f64>| (0..3).map(|k| (p[k] - point[k]).abs()).fold(0.0, f64::max);
                let nearest = found.points().iter().map(gap).fold(f64::INFINITY, f64::min);
                let tolerance = if ratio > 100.0 { 1e-11 } else { 1e-13 };
                assert!(nearest < tolerance, "{scheme} {ratio}: {nearest:e}");
            }
        }
    }
}

/// A quarter of a ring of radii 1 to 2 as a rational patch: intervals 0, 1, 0 both ways. Limits on its arcs
/// have these radii, at every level and under every scheme.
#[test]
fn a_quarter_ring_stays_round() {
    let (root, third) = (0.5_f64.sqrt(), |a: f64, b: f64| (a + 2.0 * b) / 3.0);
    // an arc of degree 2 with its degree raised, in homogeneous coordinates
    let arc = [[1.0, 0.0, 1.0], [root, root, root], [0.0, 1.0, 1.0]];
    let between = |end: usize| [0, 1, 2].map(|k| third(arc[end][k], arc[1][k]));
    let arc = [arc[0], between(0), between(2), arc[2]];
    let radii = [1.0, 4.0 / 3.0, 5.0 / 3.0, 2.0];
    let lifted: Vec<[f64; 4]> = radii
        .iter()
        .flat_map(|r| arc.map(|[x, y, w]| [r * x, r * y, 0.0, w]))
        .collect();
    let at = |i: u32, j: u32| 4 * j + i;
    let faces = (0..9).map(|k| (k % 3, k / 3));
    let faces = faces.map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
    let mut mesh = Mesh::new(vec![Point3::origin(); 16], faces).unwrap();
    for (i, d) in [(0, 0.0), (1, 1.0), (2, 0.0)] {
        mesh.features.knots.insert(edge(at(i, 0), at(i + 1, 0)), d);
        mesh.features.knots.insert(edge(at(0, i), at(0, i + 1)), d);
    }
    for scheme in [Scheme::Nurss, Scheme::EigenPolyhedron, HNUSS] {
        let mut refinement = Refinement::new(&mesh, scheme, Outside::Error).unwrap();
        for level in 1..=4 {
            refinement.refine().unwrap();
            let points = refinement.apply(&lifted).unwrap();
            let limits = Limits::new(&refinement).unwrap().of(&points).unwrap();
            let net = refinement.net();
            let on_arc = |r: f64| -> usize {
                let vertices = 0..net.topology().vertex_count() as u32;
                let round = vertices.filter(|&vertex| {
                    let [x, y, _, w] = limits[vertex as usize][0];
                    net.is_on_boundary(vertex) && ((x / w).hypot(y / w) - r).abs() < 1e-14
                });
                round.count()
            };
            // the interval of width 1 has become 2^level
            for r in [1.0, 2.0] {
                assert!(
                    on_arc(r) > 1 << level,
                    "{scheme:?} level {level}, radius {r}: {}",
                    on_arc(r)
                );
            }
        }
    }
}
