//! Blending functions against the prototype's table, on guesses of the red edges of the paper's Figs. 9 to
//! 11; partition of unity, and properties of refined closed meshes.

use crate::common::Sequence;
use crate::meshes::distance_of_edges;
use eigenring_nonuniform::{Blending, FirstLevel, Outside, Refinement, Scheme, Spokes, refined};
use eigenring_surface::{Mesh, Point3, Topology, Vector3, features::edge, shapes};

const SCHEMES: [Scheme; 5] = [
    Scheme::Nurss,
    Scheme::EigenPolyhedron,
    Scheme::Hnuss(FirstLevel::Simple),
    Scheme::Hnuss(FirstLevel::Printed),
    Scheme::Hnuss(FirstLevel::Improved),
];

#[test]
fn maxima_are_those_of_the_table() {
    let red = |n: usize, spokes: &[usize], d: f64| {
        let intervals = (0..n).map(|i| if spokes.contains(&i) { d } else { 1.0 }).collect();
        Spokes::new(intervals, vec![1.0; n]).unwrap()
    };
    // highest value; depth of the other maxima, if there are any; value at the centre
    let none = None;
    type Row = (f64, Option<f64>, f64);
    let table: [(Spokes, [Row; 5]); 3] = [
        (
            red(5, &[0, 1, 3], 10.0),
            [
                (0.2925, none, 0.2385),
                (0.3464, none, 0.3451),
                (0.2212, Some(0.0364), 0.1917),
                (0.3805, none, 0.3451),
                (0.3490, none, 0.3451),
            ],
        ),
        (
            red(6, &[0, 3], 10.0),
            [
                (0.2681, Some(0.1022), 0.1658),
                (0.3329, Some(0.0041), 0.3288),
                (0.2639, Some(0.1843), 0.0796),
                (0.3288, none, 0.3288),
                (0.3288, none, 0.3288),
            ],
        ),
        (
            red(7, &[0, 1, 4], 7.0),
            [
                (0.3912, Some(0.1206), 0.2015),
                (0.3969, none, 0.3888),
                (0.2605, Some(0.0894), 0.1028),
                (0.3906, none, 0.3888),
                (0.3889, none, 0.3888),
            ],
        ),
    ];
    for (spokes, rows) in table {
        for (scheme, (highest, depth, centre)) in SCHEMES.into_iter().zip(rows) {
            let found = Blending::new(scheme, &spokes, 5).unwrap();
            let label = format!("{scheme} {:?}: {:?} {}", spokes.intervals(), &found.peaks, found.centre);
            assert!((found.peaks[0].value - highest).abs() < 1e-3, "{label}");
            assert!((found.centre - centre).abs() < 1e-3, "{label}");
            let others: Vec<f64> = found.others(0.002).map(|peak| peak.depth).collect();
            match depth {
                Some(depth) => assert!(others.len() == 1 && (others[0] - depth).abs() < 1e-3, "{label}"),
                None => assert!(others.is_empty(), "{label}"),
            }
        }
    }
}

/// A cube with a knot interval for each of its three strips: eight irregular vertices, all adjacent.
fn cube() -> Mesh {
    let mut mesh = shapes::cube();
    let face = mesh.face(0).to_vec();
    mesh.features.knots.insert(edge(face[0], face[1]), 2.0);
    mesh.features.knots.insert(edge(face[1], face[2]), 0.7);
    mesh
}

#[test]
fn closed_meshes_keep_what_they_are() {
    // eight adjacent irregular vertices, and a plate with holes, whose lines cross those of its rim
    let mut plate = shapes::triple_torus();
    let face = plate.face(0).to_vec();
    plate.features.knots.insert(edge(face[0], face[1]), 2.0);
    closed_mesh_keeps_what_it_is(&cube(), 0);
    closed_mesh_keeps_what_it_is(&plate, 3);
}

fn closed_mesh_keeps_what_it_is(mesh: &Mesh, genus: i64) {
    for scheme in SCHEMES {
        let mut refinement = Refinement::new(mesh, scheme, Outside::Error).unwrap();
        if let Some(hybrid) = refinement.hybrid() {
            let net = hybrid.net();
            let topology = net.topology();
            let crossings = (0..topology.face_count() as u32).filter(|&face| {
                let halves = topology.face_halves(face);
                halves.len() == 4 && halves.clone().all(|half| net.interval(half) == 0.0)
            });
            assert_eq!(crossings.count() > 0, genus > 0);
            // eight corners, and eight around each hole
            assert_eq!(hybrid.extraordinary_faces().count() as i64, 8 + 8 * genus);
        }
        for level in 0..if genus > 0 { 2 } else { 4 } {
            let net = refinement.net();
            let topology = net.topology();
            let euler = topology.vertex_count() as i64 - topology.edge_count() as i64 + topology.face_count() as i64;
            assert_eq!(euler, 2 - 2 * genus, "{scheme} {level}");
            if refinement.hybrid().is_some() {
                assert!(
                    (0..topology.vertex_count() as u32).all(|v| net.valence(v) == 4),
                    "{scheme} {level}"
                );
            }
            // strips are consistent
            for face in (0..topology.face_count() as u32).filter(|&face| topology.face_size(face) == 4) {
                let h = topology.face_halves(face).start;
                assert!(net.interval(h) == net.interval(h + 2) && net.interval(h + 1) == net.interval(h + 3));
            }
            // a sum of blending functions is 1 everywhere
            let ones = refinement.apply(&vec![[1.0]; mesh.points().len()]).unwrap();
            assert!(ones.iter().all(|[x]| (x - 1.0).abs() < 1e-13), "{scheme} {level}");
            refinement.refine().unwrap();
        }
        // an isometry of the mesh moves the result with it
        let mut sequence = Sequence(5);
        let mut noisy = mesh.clone();
        noisy
            .points_mut()
            .iter_mut()
            .for_each(|p| *p += Vector3::from([0; 3].map(|_| sequence.next())));
        let turn = nalgebra::Rotation3::from_euler_angles(0.4, 1.1, -0.7);
        let moved = |p: &Point3<f64>| turn * p + Vector3::new(3.0, -1.0, 2.0);
        let mut other = noisy.clone();
        other.points_mut().iter_mut().for_each(|p| *p = moved(p));
        let [a, b] = [&noisy, &other].map(|mesh| refined(mesh, scheme, 2, Outside::Error).unwrap().mesh);
        let gap = a
            .points()
            .iter()
            .zip(b.points())
            .map(|(p, q)| (moved(p) - q).norm())
            .fold(0.0, f64::max);
        assert!(gap < 1e-13 * 10.0, "{scheme}: {gap:e}");
        assert!(Topology::new(&a).is_ok());
        // a net with its intervals goes on as if it had not been written
        let more = |mesh: &Mesh, levels: usize| refined(mesh, scheme, levels, Outside::Error).unwrap().mesh;
        let first = more(&noisy, 1);
        match scheme {
            // the first level is another one than those after it
            Scheme::EigenPolyhedron => continue,
            // blocks begin with another net, so that points have other numbers
            Scheme::Hnuss(_) => {
                let (at_once, again) = (more(&noisy, 2), more(&first, 1));
                assert_eq!(at_once.faces_by_size(), again.faces_by_size());
                let gap = distance_of_edges(&at_once, &again);
                assert!(gap < 1e-14, "{scheme}: {gap:e}");
            }
            Scheme::Nurss => {
                let (at_once, again) = (more(&noisy, 3), more(&first, 2));
                let bits = |mesh: &Mesh| {
                    mesh.points()
                        .iter()
                        .flat_map(|p| [p.x, p.y, p.z].map(f64::to_bits))
                        .collect::<Vec<_>>()
                };
                assert_eq!(bits(&at_once), bits(&again), "{scheme}");
                assert_eq!(
                    (at_once.corners(), &at_once.features.knots),
                    (again.corners(), &again.features.knots)
                );
            }
        }
    }
}

#[test]
fn equal_intervals_on_triangles_are_catmull_and_clark() {
    use eigenring_scheme::{Definition, Spec};
    use eigenring_surface::{Refiner, Rules};
    let mesh = shapes::tetrahedron();
    let rules = Rules::new(Definition::Family(Spec::CatmullClark));
    for levels in 1..4 {
        let expected = Refiner::new(&rules).refined(&mesh, levels).unwrap();
        for scheme in [Scheme::Nurss, Scheme::EigenPolyhedron] {
            let found = refined(&mesh, scheme, levels, Outside::Error).unwrap().mesh;
            assert_eq!(found.points().len(), expected.points().len());
            let nearest = |p: &Point3<f64>| {
                let gaps = expected.points().iter().map(|q| (p - q).norm());
                gaps.fold(f64::INFINITY, f64::min)
            };
            let gap = found.points().iter().map(nearest).fold(0.0, f64::max);
            assert!(gap < 2e-15, "{scheme} {levels}: {gap:e}");
        }
    }
}
