//! Limits of the generalised tension scheme of any order: against reference positions, further refinement,
//! surfaces that it reproduces exactly, and differences.

use crate::common::{json, mesh, own, points, rules, shared};
use eigenring_surface::limit::{Place, Surface};
use eigenring_surface::{Mesh, Point3, Refiner};
use std::path::Path;

fn place(face: u32, s: f64, t: f64) -> Place {
    Place {
        face,
        sub: 0,
        corner: 0,
        s,
        t,
    }
}

/// The place of the middle of a face.
fn middle(mesh: &Mesh, face: u32) -> Place {
    if mesh.face(face as usize).len() == 4 {
        place(face, 0.5, 0.5)
    } else {
        place(face, 1.0, 1.0)
    }
}

/// The place of a vertex in the first face that has it.
fn at_vertex(mesh: &Mesh, vertex: u32) -> Place {
    let (face, corner) = (0..mesh.face_count() as u32)
        .find_map(|face| {
            let corner = mesh.face(face as usize).iter().position(|&v| v == vertex)?;
            Some((face, corner as u32))
        })
        .unwrap();
    let quad = mesh.face(face as usize).len() == 4;
    Place {
        face,
        sub: if quad { 0 } else { corner },
        corner: if quad { corner } else { 0 },
        s: 0.0,
        t: 0.0,
    }
}

#[test]
fn positions_are_those_of_the_references() {
    let check = |folder: &Path| {
        let mut count = 0;
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if !path.to_string_lossy().ends_with("_limits.json") {
                continue;
            }
            let case = json(&path);
            let mut control = mesh(&case);
            for crease in case["creases"].as_array().unwrap() {
                let [a, b] = [0, 1].map(|i| crease[i].as_u64().unwrap() as u32);
                control.features.creases.insert([a.min(b), a.max(b)], 10.0);
            }
            for run in case["runs"].as_array().unwrap() {
                let rules = rules(&format!("tension:order={},u0={}", run["order"], run["u0"]));
                let surface = Surface::new(&control, &rules).unwrap();
                for (number, expected) in points(&run["positions"]).into_iter().enumerate() {
                    let number = number as u32;
                    let at = match run["at"].as_str().unwrap() {
                        "vertices" => at_vertex(&control, number),
                        _ => middle(&control, number),
                    };
                    let found = surface.at(at).unwrap().position;
                    let off = (found - expected).norm();
                    assert!(
                        off < 1e-11,
                        "{}: order {}, u0 {}, {number}: {off:e}",
                        path.display(),
                        run["order"],
                        run["u0"]
                    );
                    count += 1;
                }
            }
        }
        assert!(count > 0, "{}", folder.display());
    };
    check(&own("tension_meshes"));
    if let Some(folder) = shared("reference/tension_meshes") {
        check(&folder);
    }
}

/// n x n quads on a torus, turned about the z axis.
fn torus(n: u32, radius: f64, tube: f64) -> Mesh {
    let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(n);
    let point = |i: u32, j: u32| {
        let out = radius + tube * angle(j).cos();
        Point3::new(out * angle(i).cos(), out * angle(i).sin(), tube * angle(j).sin())
    };
    let points = (0..n * n).map(|k| point(k / n, k % n)).collect();
    let at = |i: u32, j: u32| (i % n) * n + j % n;
    let faces = (0..n * n).map(|k| {
        let (i, j) = (k / n, k % n);
        vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
    });
    Mesh::new(points, faces).unwrap()
}

/// The factor from a polygon's circle to the limit's: `u (sin a / a)^(k-3)`, u = cos a.
fn shrinking(order: usize, a: f64) -> f64 {
    a.cos() * (a.sin() / a).powi(order as i32 - 3)
}

#[test]
fn tori_and_spheres_are_exact() {
    for order in [3, 4, 5, 6, 7, 8, 9, 10, 17] {
        for (n, radius, tube) in [(5, 2.0, 0.7), (6, 0.0, 1.0)] {
            let a = std::f64::consts::PI / f64::from(n);
            let rules = rules(&format!("tension:order={order},u0={:?}", a.cos()));
            let shape = torus(n, radius, tube);
            let surface = Surface::new(&shape, &rules).unwrap();
            let kappa = shrinking(order, a);
            for (s, t) in [(0.1, 0.3), (0.5, 0.8), (0.0, 0.6), (0.77, 1.0)] {
                for face in [0, n + 1, 2 * n + 3] {
                    let sample = surface.at(place(face, s, t)).unwrap();
                    let p = sample.position;
                    let out = p.x.hypot(p.y) / kappa;
                    // circles along both directions shrink by the same factor
                    let off = ((out - radius).hypot(p.z) - tube * kappa).abs();
                    assert!(off < 1e-12, "order {order}, n = {n}: off by {off:e}");
                }
            }
        }
    }
}

/// An open tube of n x m quads around the z axis, narrower at its upper end.
fn frustum(n: u32, m: u32) -> Mesh {
    let point = |i: u32, j: u32| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
        let (height, radius) = (f64::from(j), 2.0 - 0.1 * f64::from(j));
        Point3::new(radius * angle.cos(), radius * angle.sin(), height)
    };
    let points = (0..n * (m + 1)).map(|k| point(k % n, k / n)).collect();
    let at = |i: u32, j: u32| j * n + i % n;
    let faces = (0..n * m).map(|k| {
        let (i, j) = (k % n, k / n);
        vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
    });
    Mesh::new(points, faces).unwrap()
}

#[test]
fn open_cones_are_exact_up_to_their_rims() {
    let (n, m) = (7, 4);
    let a = std::f64::consts::PI / f64::from(n);
    for order in 3..=10 {
        let rules = rules(&format!("tension:order={order},u0={:?}", a.cos()));
        let shape = frustum(n, m);
        let surface = Surface::new(&shape, &rules).unwrap();
        let kappa = shrinking(order, a);
        for face in [0, n + 2, 3 * n + 5] {
            for (s, t) in [(0.3, 0.0), (0.2, 0.45), (0.8, 1.0), (0.0, 1e-9)] {
                let sample = surface.at(place(face, s, t)).unwrap();
                let p = sample.position;
                // along the axis linear data stay as they are, up to the parameter
                let off = p.x.hypot(p.y) / kappa - (2.0 - 0.1 * p.z);
                assert!(off.abs() < 1e-12, "order {order}, face {face}, ({s}, {t}): {off:e}");
                assert!(sample.gauss.unwrap().abs() < 1e-9, "order {order}: {:?}", sample.gauss);
                let rim = (face == 0 && t == 0.0) || (face == 3 * n + 5 && t == 1.0);
                if rim {
                    assert!((p.z - f64::from(face / n) - t).abs() < 1e-13, "order {order}: {}", p.z);
                }
            }
        }
    }
}

#[test]
fn curvature_of_spheres() {
    for order in [3, 4, 5, 6, 8, 10] {
        let n = 8;
        let a = std::f64::consts::PI / f64::from(n);
        let kappa = shrinking(order, a);
        let rules = rules(&format!("tension:order={order},u0={:?}", a.cos()));
        let mut shape = torus(n, 0.0, 1.0);
        // the equator shrinks twice, the axis once
        shape
            .points_mut()
            .iter_mut()
            .for_each(|p| *p = Point3::new(p.x / kappa, p.y / kappa, p.z) / kappa);
        let surface = Surface::new(&shape, &rules).unwrap();
        for (face, s, t) in [(0, 0.2, 0.3), (n + 2, 0.5, 0.2), (3 * n + 1, 0.9, 0.97)] {
            let sample = surface.at(place(face, s, t)).unwrap();
            assert!((sample.position.coords.norm() - 1.0).abs() < 1e-12, "order {order}");
            assert!(
                (sample.gauss.unwrap() - 1.0).abs() < 1e-9,
                "order {order}: {:?}",
                sample.gauss
            );
            let outward = sample.normal.unwrap().dot(&sample.position.coords);
            assert!((sample.mean.unwrap() * outward + 1.0).abs() < 1e-9, "order {order}");
        }
    }
}

/// The limit at the middle of a face with a centre there, or at a vertex, by plain refinement: mesh points
/// of twelve levels, or as many as are cheap, extrapolated by the ratio of their steps.
#[test]
fn centres_are_those_of_refinement() {
    let path = own("tension_meshes").join("cube_limits.json");
    let control = mesh(&json(&path));
    for (order, u0) in [(4, 0.3), (6, 2.0), (8, 0.5)] {
        let rules = rules(&format!("tension:order={order},u0={u0}"));
        let surface = Surface::new(&control, &rules).unwrap();
        let at = |levels: usize| Refiner::new(&rules).refined(&control, levels).unwrap().points()[3];
        // the error falls by the second largest eigenvalue at each level, here known from three levels
        let points: Vec<Point3<f64>> = (4..=7).map(at).collect();
        let steps: Vec<_> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let ratio = steps[2].norm() / steps[1].norm();
        let limit = points[3] + steps[2] * (ratio / (1.0 - ratio));
        let found = surface.at(at_vertex(&control, 3)).unwrap().position;
        assert!(
            (found - limit).norm() < 1e-4 * steps[0].norm(),
            "order {order}: {:e}",
            (found - limit).norm()
        );
    }
}

#[test]
fn derivatives_are_those_of_differences() {
    let path = own("tension_meshes").join("prism_limits.json");
    let control = mesh(&json(&path));
    for order in [3, 4, 5, 6, 7, 8] {
        for u0 in ["0.3", "1", "2"] {
            let rules = rules(&format!("tension:order={order},u0={u0}"));
            let surface = Surface::new(&control, &rules).unwrap();
            // near a centre, between levels of tension, and far away
            for (face, s, t) in [(0, 0.013, 0.021), (3, 0.31, 0.12), (5, 0.6, 0.7)] {
                let h = 1e-3 * s;
                let at = |ds: f64, dt: f64| surface.at(place(face, s + ds * h, t + dt * h)).unwrap();
                let sample = at(0.0, 0.0);
                let first = sample.first.unwrap();
                let second = sample.second.unwrap();
                let size = first[0].norm() + first[1].norm();
                let curved = second.iter().map(|d| d.norm()).sum::<f64>();
                let by_s = (at(1.0, 0.0).position - at(-1.0, 0.0).position) / (2.0 * h);
                let by_t = (at(0.0, 1.0).position - at(0.0, -1.0).position) / (2.0 * h);
                assert!(
                    (by_s - first[0]).norm() + (by_t - first[1]).norm() < 1e-4 * size,
                    "order {order}, u0 {u0}"
                );
                let by_ss = (at(1.0, 0.0).first.unwrap()[0] - at(-1.0, 0.0).first.unwrap()[0]) / (2.0 * h);
                let by_st = (at(0.0, 1.0).first.unwrap()[0] - at(0.0, -1.0).first.unwrap()[0]) / (2.0 * h);
                let by_tt = (at(0.0, 1.0).first.unwrap()[1] - at(0.0, -1.0).first.unwrap()[1]) / (2.0 * h);
                let off = (by_ss - second[0]).norm() + (by_st - second[1]).norm() + (by_tt - second[2]).norm();
                assert!(
                    off < 2e-2 * (curved + size),
                    "order {order}, u0 {u0}, face {face}: {off:e} of {curved:e}"
                );
            }
        }
    }
}

#[test]
fn tension_one_is_a_limit() {
    let path = own("tension_meshes").join("prism_limits.json");
    let control = mesh(&json(&path));
    for order in [3, 4, 6, 7] {
        let [one, near] = ["1", "1.000000001"].map(|u0| rules(&format!("tension:order={order},u0={u0}")));
        let [one, near] = [&one, &near].map(|rules| Surface::new(&control, rules).unwrap());
        for (face, s, t) in [(0, 1e-5, 3e-6), (2, 0.4, 0.2), (4, 0.0, 0.0), (5, 1.0, 0.999)] {
            let [a, b] = [&one, &near].map(|surface| surface.at(place(face, s, t)).unwrap());
            assert!((a.position - b.position).norm() < 1e-8);
            if let (Some(a), Some(b)) = (a.normal, b.normal) {
                assert!((a - b).norm() < 1e-7, "order {order}: {:e}", (a - b).norm());
            }
        }
    }
}

#[test]
fn curvature_beside_a_centre_keeps_its_digits() {
    let path = own("tension_meshes").join("prism_limits.json");
    let control = mesh(&json(&path));
    for (order, u0) in [(6, "0.3"), (5, "0.3"), (8, "2")] {
        let rules = rules(&format!("tension:order={order},u0={u0}"));
        let surface = Surface::new(&control, &rules).unwrap();
        let at = |depth: i32| {
            let scale = 2_f64.powi(-depth);
            surface.at(place(2, 0.7 * scale, 0.4 * scale)).unwrap().gauss.unwrap()
        };
        // so far inside all other eigenvalues have died out, and the ratio from level to level is constant
        let ratios: Vec<f64> = (80..90).map(|depth| at(depth + 1) / at(depth)).collect();
        for ratio in &ratios {
            assert!(
                (ratio / ratios[0] - 1.0).abs() < 1e-10,
                "order {order}, u0 {u0}: {ratios:?}"
            );
        }
    }
}
