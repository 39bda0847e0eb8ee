//! Exact evaluation: the prototype's numbers, limits of nets that are refined further, both sides of lines,
//! and the curvature beside an extraordinary vertex.

use crate::common::{Sequence, cases};
use crate::meshes::mesh_of;
use eigenring_nonuniform::{FirstLevel, NGon, Outside, Refinement, Scheme, Star, Surface};
use eigenring_spline::intervals::limit;
use eigenring_surface::features::edge;
use eigenring_surface::{Mesh, Point3, Topology, Vector3};

/// Derivatives by the parameters of one corner in those of another.
type Turn = fn(Vector3<f64>, Vector3<f64>) -> [Vector3<f64>; 2];

fn vector(v: [f64; 3]) -> Vector3<f64> {
    Vector3::from(v)
}

#[test]
fn points_and_derivatives_are_those_of_the_prototype() {
    let case = cases().evaluation;
    let mesh = mesh_of(&case.control);
    let surface = Surface::new(&mesh, FirstLevel::Improved, Outside::Error).unwrap();
    let topology = Topology::new(&mesh).unwrap();
    let fan = topology.fan(case.centre_vertex).spokes;
    for sample in &case.samples {
        let towards = case.spokes[sample.sector];
        // through faces whose lower left corner is the origin of `half`
        let mut half = *fan.iter().find(|&&spoke| topology.head(spoke) == towards).unwrap();
        let sides = |half: u32| {
            let sides = surface.sides(topology.face(half)).unwrap();
            if (half - topology.face_halves(topology.face(half)).start).is_multiple_of(2) {
                sides
            } else {
                [sides[1], sides[0]]
            }
        };
        let (mut u, mut v) = (sample.u, sample.v);
        while u > sides(half)[0] {
            u -= sides(half)[0];
            half = topology.next(topology.twin(topology.next(half)).unwrap());
        }
        while v > sides(half)[1] {
            v -= sides(half)[1];
            half = topology.twin(topology.next(topology.next(half))).unwrap();
        }
        let face = topology.face(half);
        let corner = half - topology.face_halves(face).start;
        let [a, b] = sides(half);
        let (place, turn): ([f64; 2], Turn) = match corner {
            0 => ([u, v], |u, v| [u, v]),
            1 => ([b - v, u], |u, v| [v, -u]),
            2 => ([a - u, b - v], |u, v| [-u, -v]),
            _ => ([v, a - u], |u, v| [-v, u]),
        };
        let found = surface.at(face, place[0], place[1]).unwrap();
        assert!(
            (found.position.coords - vector(sample.point)).norm() < 1e-11,
            "{:?}",
            found.position
        );
        let [u, v] = found.derivatives.unwrap();
        let [du, dv] = turn(u, v);
        assert!((du - vector(sample.du)).norm() < 1e-10, "{du:?} {:?}", sample.du);
        assert!((dv - vector(sample.dv)).norm() < 1e-10, "{dv:?} {:?}", sample.dv);
    }
    let ngon = surface.net().extraordinary_faces().next().unwrap();
    let centre = surface.centre(ngon).unwrap();
    assert!((centre.position.coords - vector(case.limit)).norm() < 1e-11);
    assert!(centre.normal.unwrap().cross(&vector(case.normal)).norm() < 1e-10);
}

/// A star of three rings with uneven intervals and points above a plane.
fn star(n: usize, seed: u64, ratio: f64) -> (Star, Mesh) {
    let mut sequence = Sequence(seed);
    let intervals: Vec<Vec<f64>> = (0..n).map(|_| sequence.intervals(3, ratio)).collect();
    let star = Star::new(&intervals, 3).unwrap();
    let mut mesh = star.mesh().clone();
    let turn = std::f64::consts::TAU / n as f64;
    for i in 0..n {
        for (a, b) in (0..=3).flat_map(|a| (0..=3).map(move |b| (a, b))) {
            let spoke = |i: usize| Vector3::new((turn * i as f64).cos(), (turn * i as f64).sin(), 0.0);
            let noise = Vector3::new(sequence.next(), sequence.next(), 3.0 * sequence.next()) * 0.2;
            let at = spoke(i) * a as f64 + spoke(i + 1) * b as f64 + noise;
            let at = at + Vector3::new(0.0, 0.0, 0.4 * at.norm_squared());
            mesh.points_mut()[star.point(i, a, b) as usize] = Point3::from(at);
        }
    }
    (star, mesh)
}

#[test]
fn both_sides_of_a_spoke_agree_down_to_tiny_parameters() {
    for n in [3, 5, 6, 8] {
        let (star, mesh) = star(n, n as u64, 2.5);
        let surface = Surface::new(&mesh, FirstLevel::Improved, Outside::Error).unwrap();
        let ngon = surface.net().extraordinary_faces().next().unwrap();
        let centre = surface.centre(ngon).unwrap();
        let topology = Topology::new(&mesh).unwrap();
        for i in 0..n {
            // faces of a star begin at their inner corner: v = 0 is spoke i, u = 0 spoke i+1
            let face = |i: usize| {
                let spokes = topology.fan(0).spokes;
                let spoke = *spokes
                    .iter()
                    .find(|&&s| topology.head(s) == star.point(i % n, 1, 0))
                    .unwrap();
                topology.face(spoke)
            };
            let (before, after) = (face(i + n - 1), face(i));
            let d = surface.sides(after).unwrap()[0];
            for exponent in [0, 1, 2, 3, 7, 20, 40] {
                let t = d * 0.9 * 0.5_f64.powi(exponent);
                let [a, b] = [surface.at(before, 0.0, t).unwrap(), surface.at(after, t, 0.0).unwrap()];
                assert!((a.position - b.position).norm() < 1e-13, "n = {n} {exponent}");
                let ([across, along], [own, beyond]) = (a.derivatives.unwrap(), b.derivatives.unwrap());
                assert!(
                    (along - own).norm() < 1e-11,
                    "n = {n} {exponent}: {:e}",
                    (along - own).norm()
                );
                // across, by the parameters of both sides
                assert!(
                    (across + beyond).norm() < 1e-11,
                    "n = {n} {exponent}: {:e}",
                    (across + beyond).norm()
                );
            }
            // normals approach at rate 1/2
            let gap = |m: i32| {
                let t = d * 0.5_f64.powi(m);
                let sample = surface.at(after, t, 0.4 * t).unwrap();
                sample.normal.unwrap().cross(&centre.normal.unwrap()).norm()
            };
            for m in [12, 16] {
                let ratio = gap(m + 1) / gap(m);
                assert!((ratio - 0.5).abs() < 2e-2, "n = {n}: {ratio}");
            }
        }
    }
}

#[test]
fn points_are_the_limits_of_nets_that_are_refined_further() {
    let case = cases().evaluation;
    let mesh = mesh_of(&case.control);
    let surface = Surface::new(&mesh, FirstLevel::Improved, Outside::Error).unwrap();
    let scheme = Scheme::Hnuss(FirstLevel::Improved);
    let mut refinement = Refinement::new(&mesh, scheme, Outside::Error).unwrap();
    (0..3).for_each(|_| refinement.refine().unwrap());
    let points: Vec<[f64; 3]> = mesh.points().iter().map(|p| [p.x, p.y, p.z]).collect();
    let points = refinement.apply(&points).unwrap();
    let (fine, coarse) = (refinement.net(), surface.net().net());
    let mut count = 0;
    for face in 0..mesh.face_count() as u32 {
        let half = coarse.topology().face_halves(face).start;
        // vertices keep their numbers
        let vertex = coarse.topology().origin(half);
        if coarse.is_on_boundary(vertex) || surface.net().ngon_at(vertex).is_some() {
            continue;
        }
        let spokes = fine.topology().fan(vertex).spokes;
        let line = |ahead: u32, back: u32| {
            limit::<f64>([
                fine.beyond(back),
                fine.interval(back),
                fine.interval(ahead),
                fine.beyond(ahead),
            ])
        };
        let (u, v) = (line(spokes[0], spokes[2]), line(spokes[1], spokes[3]));
        let head = |i: usize| fine.topology().head(spokes[i]);
        let corner = |i: usize| fine.topology().head(fine.topology().next(spokes[i]));
        let terms = [
            (vertex, u[1] * v[1]),
            (head(0), u[2] * v[1]),
            (head(1), u[1] * v[2]),
            (head(2), u[0] * v[1]),
            (head(3), u[1] * v[0]),
            (corner(0), u[2] * v[2]),
            (corner(1), u[0] * v[2]),
            (corner(2), u[0] * v[0]),
            (corner(3), u[2] * v[0]),
        ];
        let expected: Vector3<f64> = terms.iter().map(|(at, w)| vector(points[*at as usize]) * *w).sum();
        let found = surface.at(face, 0.0, 0.0).unwrap().position.coords;
        assert!(
            (found - expected).norm() < 1e-12,
            "vertex {vertex}: {:e}",
            (found - expected).norm()
        );
        count += 1;
    }
    assert!(count > 30, "{count}");
    // and the centre is that of the refined n-gon
    let ngon = refinement.hybrid().unwrap().extraordinary_faces().next().unwrap();
    let corners = fine
        .topology()
        .face_halves(ngon)
        .map(|half| vector(points[fine.topology().origin(half) as usize]));
    let weights = NGon::new(&refinement.hybrid().unwrap().spokes(ngon))
        .unwrap()
        .limit_weights();
    let found: Vector3<f64> = corners.zip(weights).map(|(p, w)| p * w).sum();
    assert!((found - vector(case.limit)).norm() < 1e-12);
}

/// The principal curvatures, as their product and the sum of their squares, by differences of exact first
/// derivatives whose steps are relative to the distance from the vertex.
fn curvature(surface: &Surface, face: u32, [u, v]: [f64; 2]) -> [f64; 2] {
    let h = 1e-4 * u.max(v);
    let at = |u: f64, v: f64| surface.at(face, u, v).unwrap().derivatives.unwrap();
    let [xu, xv] = at(u, v);
    let normal = xu.cross(&xv).normalize();
    let slope = |k: usize, a: [Vector3<f64>; 2], b: [Vector3<f64>; 2]| (a[k] - b[k]).dot(&normal) / (2.0 * h);
    let (right, left) = (at(u + h, v), at(u - h, v));
    let (above, below) = (at(u, v + h), at(u, v - h));
    let (l, m, q) = (slope(0, right, left), slope(0, above, below), slope(1, above, below));
    let [e, f, g] = [xu.norm_squared(), xu.dot(&xv), xv.norm_squared()];
    let first = e * g - f * f;
    let gauss = (l * q - m * m) / first;
    let twice_mean = (l * g - 2.0 * m * f + q * e) / first;
    [gauss, twice_mean * twice_mean - 2.0 * gauss]
}

#[test]
fn curvature_is_bounded_with_coplanar_corners_alone() {
    for n in [3, 5, 6, 8] {
        let (_, mesh) = star(n, 90 + n as u64, 2.5);
        let improved = Surface::new(&mesh, FirstLevel::Improved, Outside::Error).unwrap();
        let face = 0;
        let sides = improved.sides(face).unwrap();
        let at = |surface: &Surface, m: i32| {
            let t = 0.5_f64.powi(m);
            curvature(surface, face, [0.7 * sides[0] * t, 0.6 * sides[1] * t])
        };
        let levels: Vec<f64> = [8, 12, 16].iter().map(|&m| at(&improved, m)[0]).collect();
        // empirical: the other eigenvalues of spokes and sectors fade out
        for (k, share) in levels.iter().zip([0.1, 0.01]) {
            assert!((k - levels[2]).abs() < share * levels[2].abs(), "n = {n}: {levels:?}");
        }
        if n == 8 {
            // the simple rule: squares grow like (4 lambda_4)^(2m)
            let simple = Surface::new(&mesh, FirstLevel::Simple, Outside::Error).unwrap();
            let ngon = simple.net().extraordinary_faces().next().unwrap();
            let d = simple.net().spokes(ngon);
            let lambda = eigenring_nonuniform::NGon::new(&d).unwrap().spectrum()[3];
            let growth = at(&simple, 24)[1] / at(&simple, 20)[1];
            let expected = (4.0 * lambda).powi(8);
            assert!((growth / expected - 1.0).abs() < 0.3, "{growth} {expected}");
        }
    }
}

/// Limits and tangent planes at the vertices of refined hybrid nets against evaluation of patches.
#[test]
fn limits_at_vertices_are_points_of_the_surface() {
    use eigenring_nonuniform::Limits;
    let (_, mesh) = star(5, 7, 2.5);
    let surface = Surface::new(&mesh, FirstLevel::Improved, Outside::Error).unwrap();
    let scheme = Scheme::Hnuss(FirstLevel::Improved);
    let refinement = Refinement::new(&mesh, scheme, Outside::Error).unwrap();
    let points: Vec<[f64; 3]> = mesh.points().iter().map(|p| [p.x, p.y, p.z]).collect();
    let limits = Limits::new(&refinement)
        .unwrap()
        .of(&refinement.apply(&points).unwrap())
        .unwrap();
    let net = refinement.net();
    let mut count = 0;
    for face in 0..mesh.face_count() as u32 {
        let start = net.topology().face_halves(face).start;
        let [a, b] = surface.sides(face).unwrap();
        for (k, [u, v]) in [[0.0, 0.0], [a, 0.0], [a, b], [0.0, b]].into_iter().enumerate() {
            let sample = surface.at(face, u, v).unwrap();
            let [at, s, t] = limits[net.topology().origin(start + k as u32) as usize].map(vector);
            assert!((sample.position.coords - at).norm() < 1e-12, "face {face}, corner {k}");
            let normal = s.cross(&t).normalize();
            assert!(
                sample.normal.unwrap().cross(&normal).norm() < 1e-9,
                "face {face}, corner {k}"
            );
            count += 1;
        }
    }
    assert_eq!(count, 4 * 5 * 9);
}

/// Limits of NURSS and of eigen-polyhedra do not move when the net is refined once more.
#[test]
fn limits_stay_under_refinement() {
    use eigenring_nonuniform::Limits;
    for (n, scheme) in [
        (5, Scheme::Nurss),
        (5, Scheme::EigenPolyhedron),
        (3, Scheme::Nurss),
        (6, Scheme::EigenPolyhedron),
    ] {
        let (_, mesh) = star(n, 11, 2.5);
        let points: Vec<[f64; 3]> = mesh.points().iter().map(|p| [p.x, p.y, p.z]).collect();
        let mut refinement = Refinement::new(&mesh, scheme, Outside::Error).unwrap();
        let mut before: Vec<[[f64; 3]; 3]> = Vec::new();
        for level in 0..4 {
            let limits = Limits::new(&refinement)
                .unwrap()
                .of(&refinement.apply(&points).unwrap())
                .unwrap();
            for (vertex, (old, new)) in before.iter().zip(&limits).enumerate() {
                let ([p, s, t], [q, u, v]) = (old.map(vector), new.map(vector));
                assert!(
                    (p - q).norm() < 1e-11,
                    "{scheme} level {level} vertex {vertex}: {:e}",
                    (p - q).norm()
                );
                let planes = s.cross(&t).normalize().cross(&u.cross(&v).normalize());
                assert!(
                    planes.norm() < 1e-8,
                    "{scheme} level {level} vertex {vertex}: {:e}",
                    planes.norm()
                );
            }
            before = limits;
            refinement.refine().unwrap();
        }
    }
}

/// A spoke without width that ends at the boundary: points beside the vertex are limits of refined nets.
#[test]
fn zero_spokes_may_lead_to_the_boundary() {
    use eigenring_nonuniform::Limits;
    for n in [4, 5, 6] {
        let (whole, full) = star(n, 3, 2.0);
        // the faces beyond the first edge of spoke 0 are left out
        let mut mesh = Mesh::of_points(full.points().to_vec());
        for (face, corners) in full.faces().enumerate() {
            let (sector, b, a) = (face / 9, face / 3 % 3, face % 3);
            if !(sector == 0 && a > 0 || sector == n - 1 && b > 0) {
                mesh.push_face(corners).unwrap();
            }
        }
        let first = edge(0, whole.point(0, 1, 0));
        mesh.features.knots = full.features.knots.clone();
        mesh.features.knots.retain(|pair, _| *pair != first);
        for outer in [1, 2].map(|a| edge(whole.point(0, a, 0), whole.point(0, a + 1, 0))) {
            mesh.features.knots.remove(&outer);
        }
        mesh.features.knots.insert(first, 0.0);
        let mesh = mesh.without_unused();
        let surface = Surface::new(&mesh, FirstLevel::Simple, Outside::Error).unwrap();
        let mut refinement = Refinement::new(&mesh, Scheme::Hnuss(FirstLevel::Simple), Outside::Error).unwrap();
        (0..4).for_each(|_| refinement.refine().unwrap());
        let points: Vec<[f64; 3]> = mesh.points().iter().map(|p| [p.x, p.y, p.z]).collect();
        let limits = Limits::new(&refinement)
            .unwrap()
            .of(&refinement.apply(&points).unwrap())
            .unwrap();
        let mut count = 0;
        for face in 0..mesh.face_count() as u32 {
            let Ok([a, b]) = surface.sides(face) else { continue };
            for (s, t) in [(0.5, 0.5), (0.25, 0.125), (0.0625, 0.0), (0.125, 0.0625), (1.0, 0.25)] {
                let found = surface.at(face, s * a, t * b).unwrap().position.coords;
                let gap = limits
                    .iter()
                    .map(|[p, ..]| (vector(*p) - found).norm())
                    .fold(f64::INFINITY, f64::min);
                assert!(gap < 1e-12, "n = {n}, face {face} ({s}, {t}): {gap:e}");
                count += 1;
            }
        }
        assert!(count > 5 * 4 * (n - 2), "{count}");
    }
}
