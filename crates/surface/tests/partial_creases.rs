//! Limits beside creases and corners that act in some smoothing steps only: against further refinement of
//! whole meshes, the surface of the refined mesh, differences, and the eigenvalue known of order 6.

use crate::common::{json, mesh, own, rules};
use eigenring_surface::limit::{Kind, Place, Surface};
use eigenring_surface::{Mesh, Point3, Refiner, Rules, Topology};

fn with_steps(spec: &str, steps: Option<usize>) -> Rules {
    let mut rules = rules(spec);
    rules.steps = steps;
    rules
}

fn place(face: u32, corner: u32, s: f64, t: f64) -> Place {
    Place {
        face,
        sub: 0,
        corner,
        s,
        t,
    }
}

/// A cube with creases of different steps that cross, run on, and end; and one with a corner.
fn cubes() -> Vec<(Mesh, &'static str, Option<usize>)> {
    let read = |name: &str| mesh(&json(&own("tension_meshes").join(name)));
    let mut looped = read("cube_mixed_cs.json");
    for pair in [[4, 5], [5, 6], [6, 7], [4, 7]] {
        looped.features.creases.insert(pair, 10.0);
    }
    let mut mixed = read("cube_mixed_cs.json");
    for (pair, steps) in [([0, 1], 1), ([1, 2], 3), ([2, 3], 2), ([0, 3], 3), ([2, 6], 2)] {
        mixed.features.creases.insert(pair, 10.0);
        mixed.features.edge_steps.insert(pair, steps);
    }
    mixed.features.corners.insert(7, 10.0);
    mixed.features.vertex_steps.insert(7, 1);
    let mut soft = looped.clone();
    soft.features
        .creases
        .values_mut()
        .for_each(|sharpness| *sharpness = 1.4);
    vec![
        (looped.clone(), "tension:order=6,u0=1", Some(1)),
        (looped, "tension:order=8,u0=0.3", Some(2)),
        (mixed, "tension:order=8,u0=2", None),
        (soft, "tension:order=6,u0=1", Some(1)),
    ]
}

/// A sheet of 6 x 6 quads, bent, with creases along its middle lines.
fn sheet(steps: [u32; 2]) -> Mesh {
    let n = 6;
    let point = |k: u32| {
        let (x, y) = (f64::from(k % (n + 1)), f64::from(k / (n + 1)));
        Point3::new(
            x + 0.1 * (y * 1.3).sin(),
            y,
            (0.8 * x).sin() * (0.5 * y).cos() + 0.1 * (x * y).cos(),
        )
    };
    let quad = |k: u32| {
        let at = k / n * (n + 1) + k % n;
        vec![at, at + 1, at + n + 2, at + n + 1]
    };
    let mut mesh = Mesh::new((0..(n + 1) * (n + 1)).map(point).collect(), (0..n * n).map(quad)).unwrap();
    for i in 0..n {
        for (pair, steps) in [([3 + 7 * i, 10 + 7 * i], steps[0]), ([21 + i, 22 + i], steps[1])] {
            mesh.features.creases.insert(pair, 10.0);
            mesh.features.edge_steps.insert(pair, steps);
        }
    }
    mesh
}

/// Where the points of the mesh after a level are: vertices, middles of edges, middles of faces.
fn places(control: &Mesh) -> Vec<Place> {
    let topology = Topology::new(control).unwrap();
    let corner = |half: u32, s: f64| place(half / 4, half % 4, s, 0.0);
    let vertices = (0..topology.vertex_count() as u32).map(|v| corner(topology.fan(v).spokes[0], 0.0));
    let edges = (0..topology.edge_count() as u32).map(|edge| corner(topology.half_of_edge(edge), 0.5));
    let faces = (0..control.face_count() as u32).map(|face| place(face, 0, 0.5, 0.5));
    vertices.chain(edges).chain(faces).collect()
}

#[test]
fn positions_are_those_of_refinement() {
    for (control, spec, steps) in cubes() {
        let rules = with_steps(spec, steps);
        let surface = Surface::new(&control, &rules).unwrap();
        let refined = |levels: usize| Refiner::new(&rules).refined(&control, levels).unwrap();
        let levels: Vec<Mesh> = (3..=6).map(refined).collect();
        for (id, place) in places(&control).into_iter().enumerate() {
            // errors fall by the second largest eigenvalues at each level: they would stop at a wrong point
            let limit = surface.at(place).unwrap().position;
            let errors: Vec<f64> = levels.iter().map(|mesh| (mesh.points()[id] - limit).norm()).collect();
            assert!(
                errors[3] < 0.66 * errors[2] && errors[2] < 0.7 * errors[1],
                "{spec}, point {id}: {errors:?}"
            );
        }
    }
}

#[test]
fn the_surface_of_the_refined_mesh_is_the_same() {
    let mut cases: Vec<(Mesh, &str, Option<usize>)> = cubes()
        .into_iter()
        .filter(|(_, spec, _)| spec.ends_with("u0=1"))
        .collect();
    cases.push((sheet([1, 3]), "tension:order=10,u0=1", None));
    cases.push((sheet([2, 2]), "tension:order=8,u0=1", None));
    for (control, spec, steps) in cases {
        let rules = with_steps(spec, steps);
        let coarse = Surface::new(&control, &rules).unwrap();
        let refined = Refiner::new(&rules).refined(&control, 1).unwrap();
        let fine = Surface::new(&refined, &rules).unwrap();
        for half in (0..4 * control.face_count() as u32).step_by(3) {
            let mut coarse = coarse.evaluator(half / 4).unwrap();
            let mut fine = fine.evaluator(half).unwrap();
            for (s, t) in [(0.31, 0.0), (0.2, 1e-7), (0.0, 0.4), (0.37, 0.22), (0.0, 0.0)] {
                let one = coarse.at(place(half / 4, half % 4, s, t)).unwrap();
                let other = fine.at(place(half, 0, 2.0 * s, 2.0 * t)).unwrap();
                assert!(
                    (one.position - other.position).norm() < 1e-13,
                    "{spec}, {half}, {s}, {t}"
                );
                assert_eq!(one.normal.is_some(), other.normal.is_some(), "{spec}, {half}, {s}, {t}");
                assert_eq!(one.kind.name(), other.kind.name(), "{spec}, {half}, {s}, {t}");
                if let (Some(a), Some(b)) = (one.normal, other.normal) {
                    assert!((a - b).norm() < 1e-10, "{spec}, {half}, {s}, {t}: {:e}", (a - b).norm());
                }
                if let (Some(a), Some(b)) = (one.gauss, other.gauss) {
                    assert!(
                        (a - b).abs() < 1e-9 * (1.0 + a.abs()),
                        "{spec}, {half}, {s}, {t}: {a} {b}"
                    );
                }
            }
        }
    }
}

/// The second eigenvalue of order 6 with one step is .2958: (6 + sqrt(12))/32 of the even part's matrix.
#[test]
fn curvature_grows_beside_creases_by_the_known_power() {
    let control = sheet([1, 1]);
    let rules = rules("tension:order=6,u0=1");
    let surface = Surface::new(&control, &rules).unwrap();
    let on_crease = surface.at(place(14, 1, 0.0, 0.4)).unwrap();
    let Kind::Unbounded { exponent, signs } = surface.at(place(15, 0, 0.0, 0.4)).unwrap().kind else {
        panic!("the crease at x = 3: {:?}", on_crease.kind)
    };
    let at = |d: f64| surface.at(place(15, 0, d, 0.4)).unwrap();
    let slow = |m: i32| at(2_f64.powi(-m)).gauss.unwrap();
    let ratios = [20, 40, 59].map(|m| slow(m + 1) / slow(m));
    // from level to level by 4 times the eigenvalue
    assert!((2_f64.powf(-exponent) / 4.0 - 0.2958).abs() < 5e-5, "{exponent}");
    assert!(
        (ratios[2] - 2_f64.powf(-exponent)).abs() < 1e-3,
        "{ratios:?} {exponent}"
    );
    assert_eq!(slow(40).signum(), signs[0]);
    // C1: both sides have the same tangents, and differences agree
    let left = surface.at(place(14, 1, 0.4, 0.0)).unwrap();
    let right = surface.at(place(15, 0, 0.0, 0.4)).unwrap();
    assert!((left.position - right.position).norm() < 1e-14);
    assert!((left.normal.unwrap() - right.normal.unwrap()).norm() < 1e-13);
    assert!(right.second.is_none() && right.gauss.is_none());
    let h = 1e-7;
    let difference = (at(h).position - right.position) / h;
    assert!((difference - right.first.unwrap()[0]).norm() < 1e-5);
    let (a, b) = (at(0.1 - 1e-5), at(0.1 + 1e-5));
    let second = (b.first.unwrap()[0] - a.first.unwrap()[0]) / 2e-5;
    assert!((second - at(0.1).second.unwrap()[0]).norm() < 1e-6);
}

#[test]
fn all_steps_and_none_are_creases_and_none() {
    let (looped, ..) = cubes().swap_remove(0);
    let mut plain = looped.clone();
    plain.features.creases.clear();
    let spec = "tension:order=6,u0=0.5";
    for (mesh, steps, same, other) in [(&looped, Some(0), &plain, None), (&looped, Some(2), &looped, None)] {
        let (a, b) = (with_steps(spec, steps), with_steps(spec, other));
        let (one, two) = (Surface::new(mesh, &a).unwrap(), Surface::new(same, &b).unwrap());
        for half in [0, 5, 10, 19] {
            for (s, t) in [(0.0, 0.0), (0.3, 0.0), (0.01, 0.2)] {
                let at = place(half / 4, half % 4, s, t);
                assert_eq!(one.at(at).unwrap(), two.at(at).unwrap());
            }
        }
    }
    let error = Surface::new(&looped, &with_steps(spec, Some(3)))
        .unwrap_err()
        .to_string();
    assert!(error.contains("0 to 2"), "{error}");
}
