//! Limit points, derivatives, normals and curvature of Catmull-Clark against independent evaluations:
//! OpenSubdiv's patches outside of their end caps, and refinement in 50 digits beside irregular vertices.
//!
//! Tolerances are ten times the errors that the reference states: at depth d of isolation first derivatives
//! are off by 1e-15 2^d, second ones by 1e-15 4^d, and curvatures by what follows from that.

use crate::common::{json, own, rules, shared};
use eigenring_scheme::lambda::Splines;
use eigenring_scheme::{Definition, Spec};
use eigenring_surface::io::Format;
use eigenring_surface::limit::{Kind, Place, Surface};
use eigenring_surface::shapes::StarKind;
use eigenring_surface::{Mesh, Refiner, Rules, Vector3};
use serde_json::Value;
use std::path::Path;

fn vector(value: &Value) -> Vector3<f64> {
    Vector3::new(
        value[0].as_f64().unwrap(),
        value[1].as_f64().unwrap(),
        value[2].as_f64().unwrap(),
    )
}

struct Worst(Vec<String>, usize);

impl Worst {
    fn check(&mut self, label: impl Fn() -> String, error: f64, tolerance: f64) {
        self.1 += 1;
        if !(error <= tolerance) {
            self.0
                .push(format!("{}: off by {error:.1e}, allowed {tolerance:.1e}", label()));
        }
    }
}

fn compare(mesh: &Mesh, case: &Value, worst: &mut Worst) {
    let rules = rules("catmull-clark");
    let surface = Surface::new(mesh, &rules).unwrap();
    let shape = case["shape"].as_str().unwrap();
    let mut fans = surface.vertices().unwrap();
    // points that were doubled stand for the one they came from
    let count = case["control_vertices"].as_array().unwrap().len();
    for fan in fans.iter_mut().filter(|fan| fan.vertex as usize >= count) {
        let doubled = mesh.points()[fan.vertex as usize];
        fan.vertex = mesh.points().iter().position(|point| *point == doubled).unwrap() as u32;
    }
    for vertex in case["control_vertices"].as_array().unwrap() {
        let number = vertex["vertex"].as_u64().unwrap() as u32;
        let label = || format!("{shape} vertex {number}");
        let expected = vertex["fans"].as_array().unwrap();
        let found: Vec<_> = fans.iter().filter(|fan| fan.vertex == number).collect();
        assert_eq!(found.len(), expected.len(), "{}", label());
        for fan in &found {
            assert_eq!(fan.rule.name(), vertex["rule"].as_str().unwrap(), "{}", label());
            let off = (fan.sample.position.coords - vector(&vertex["position"])).norm();
            worst.check(label, off, 1e-12);
        }
        for expected in expected {
            let sorted = |list: Vec<u64>| {
                let mut list = list;
                list.sort_unstable();
                list
            };
            let faces = sorted(
                expected["faces"]
                    .as_array()
                    .unwrap()
                    .iter()
                    .map(|f| f.as_u64().unwrap())
                    .collect(),
            );
            let fan = found
                .iter()
                .find(|fan| sorted(fan.faces.iter().map(|&f| u64::from(f)).collect()) == faces);
            let fan = fan.unwrap_or_else(|| panic!("{}: no fan {faces:?}", label()));
            match (&fan.sample.normal, expected["normal"].is_null()) {
                (None, true) => assert!(matches!(fan.sample.kind, Kind::Undefined(_))),
                (Some(normal), false) => worst.check(label, (normal - vector(&expected["normal"])).norm(), 1e-10),
                (found, _) => worst.0.push(format!(
                    "{} {faces:?}: normal {found:?} ({:?}), expected {}",
                    label(),
                    fan.sample.kind,
                    expected["normal"]
                )),
            }
        }
    }
    for (index, sample) in case["samples"].as_array().unwrap().iter().enumerate() {
        let number = |name: &str| sample[name].as_f64().unwrap();
        let place = Place {
            face: number("face") as u32,
            sub: number("sub") as u32,
            corner: 0,
            s: number("s"),
            t: number("t"),
        };
        let found = surface
            .at(place)
            .unwrap_or_else(|error| panic!("{shape} sample {index}: {error}"));
        let label = |what: &'static str| move || format!("{shape} sample {index} {what}");
        let depth = number("depth");
        let (two, four) = (2_f64.powf(depth), 4_f64.powf(depth));
        let values: Vec<Vector3<f64>> = sample["values"].as_array().unwrap().iter().map(vector).collect();
        let size = values.iter().map(|v| v.norm()).fold(1.0, f64::max);
        worst.check(label("position"), (found.position.coords - values[0]).norm(), 1e-12);
        let (first, second) = (found.first.unwrap(), found.second.unwrap());
        let printed = 1e-14;
        for i in 0..2 {
            let tolerance = 1e-14 * two + printed * size;
            worst.check(label("first"), (first[i] - values[i + 1]).norm(), tolerance);
        }
        for i in 0..3 {
            let tolerance = 1e-14 * four + printed * size;
            worst.check(label("second"), (second[i] - values[i + 3]).norm(), tolerance);
        }
        let (e, f, g) = (
            values[1].norm_squared(),
            values[1].dot(&values[2]),
            values[2].norm_squared(),
        );
        let mu = (e + g) / 2.0 - ((e - g) / 2.0).hypot(f);
        let delta = 1e-15 * four / mu + 1e-14;
        let normal = vector(&sample["normal"]);
        let tolerance = f64::max(1e-14 * two / mu.sqrt(), 1e-13);
        worst.check(
            label("normal"),
            (found.normal.unwrap() - normal).norm(),
            tolerance.min(1e-10),
        );
        let (gauss, mean) = (number("gauss"), number("mean"));
        let root = (mean * mean - gauss).max(0.0).sqrt();
        let tolerance = 10.0 * (2.0 * delta + 1e-14 * mean.abs());
        worst.check(label("mean"), (found.mean.unwrap() - mean).abs(), tolerance);
        let tolerance = 10.0 * (2.0 * delta * (mean.abs() + root) + delta * delta + 1e-14 * gauss.abs());
        worst.check(label("gauss"), (found.gauss.unwrap() - gauss).abs(), tolerance);
    }
}

fn all(limits: &Path, shapes: &Path) {
    let mut worst = Worst(Vec::new(), 0);
    let mut count = 0;
    let mut paths: Vec<_> = std::fs::read_dir(limits)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    for path in paths
        .iter()
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
    {
        let case = json(path);
        let name = format!("{}.obj", case["shape"].as_str().unwrap());
        let beside = limits.join(&name);
        let path = if beside.exists() { beside } else { shapes.join(&name) };
        // one shape joins two faces in a vertex only, which OpenSubdiv takes for a corner of both
        let file = eigenring_surface::io::read(std::fs::File::open(&path).unwrap(), Format::Obj).unwrap();
        let mut mesh = file.mesh.split_non_manifold();
        mesh.features = mesh.features.in_single_precision();
        compare(&mesh, &case, &mut worst);
        count += 1;
    }
    assert!(count > 0 && worst.1 > 100);
    assert!(
        worst.0.is_empty(),
        "{} of {} differ:\n{}",
        worst.0.len(),
        worst.1,
        worst.0[..worst.0.len().min(40)].join("\n")
    );
}

#[test]
fn limits_of_independent_evaluations() {
    all(&own("limits"), &own("opensubdiv"));
    if let (Some(limits), Some(shapes)) = (shared("reference/limits"), shared("data/opensubdiv")) {
        all(&limits, &shapes);
    }
}

/// Limit points of arbitrary places are the combinations that their stencils say, and regular parts are
/// bicubic B-splines.
#[test]
fn stencils_reproduce_points_and_regular_parts_are_splines() {
    let rules = rules("catmull-clark");
    for mesh in [
        eigenring_surface::shapes::propeller(5),
        eigenring_surface::shapes::star(5, 2, StarKind::Convex),
    ] {
        let surface = Surface::new(&mesh, &rules).unwrap();
        for place in surface.grid(1).into_iter().step_by(3) {
            let stencil = surface.stencil(place).unwrap();
            let sum: f64 = stencil.iter().map(|(_, w)| w).sum();
            let terms = stencil.iter().map(|&(v, w)| mesh.points()[v as usize].coords * w);
            let point: Vector3<f64> = terms.sum();
            assert!((sum - 1.0).abs() < 1e-14);
            assert!((point - surface.at(place).unwrap().position.coords).norm() < 1e-13);
        }
    }
    let torus = eigenring_surface::shapes::torus(9, 7);
    let surface = Surface::new(&torus, &rules).unwrap();
    let at = |i: i32, j: i32| torus.points()[(i.rem_euclid(9) * 7 + j.rem_euclid(7)) as usize].coords;
    for (i, j) in (0..9).flat_map(|i| (0..7).map(move |j| (i, j))) {
        let (s, t) = (0.1 + f64::from(i) / 10.0, 0.9 - f64::from(j) / 10.0);
        let sample = surface
            .at(Place {
                face: (i * 7 + j) as u32,
                sub: 0,
                corner: 0,
                s,
                t,
            })
            .unwrap();
        let (in_s, in_t) = (
            eigenring_spline::uniform::basis(3, s),
            eigenring_spline::uniform::basis(3, t),
        );
        let sum = |a: usize, b: usize| -> Vector3<f64> {
            (0..16)
                .map(|k| at(i + k % 4 - 1, j + k / 4 - 1) * in_s[a][(k % 4) as usize] * in_t[b][(k / 4) as usize])
                .sum()
        };
        assert!((sample.position.coords - sum(0, 0)).norm() < 1e-13);
        let (first, second) = (sample.first.unwrap(), sample.second.unwrap());
        assert!((first[0] - sum(1, 0)).norm() < 1e-13 && (first[1] - sum(0, 1)).norm() < 1e-13);
        assert!((second[0] - sum(2, 0)).norm() < 1e-13 && (second[1] - sum(1, 1)).norm() < 1e-13);
    }
}

/// Beside a centre, at any depth: far in, the Gauss curvature grows by one factor a level. The next modes die
/// out like 0.914^m at worst (N = 3: eigenvalues .1667 and .1524), so that what is left at depth 300 is
/// rounding, which plain products of matrices lose all digits to from depth 26 on.
#[test]
fn curvature_keeps_its_digits_at_any_depth() {
    let rules = rules("catmull-clark");
    for n in [3, 5, 7] {
        let mut star = eigenring_surface::shapes::star(n, 3, StarKind::Convex);
        // with a part in the slowest second-order mode, so that rounding does not take its place
        for point in star.points_mut() {
            point.z += 0.3 * point.x * point.x + 0.2 * point.x * point.y;
        }
        let surface = Surface::new(&star, &rules).unwrap();
        let at = |depth: i32| {
            let (s, t) = (0.7 * 0.5_f64.powi(depth), 0.3 * 0.5_f64.powi(depth));
            surface
                .at(Place {
                    face: 0,
                    sub: 0,
                    corner: 0,
                    s,
                    t,
                })
                .unwrap()
        };
        let ratio = |depth: i32| at(depth + 1).gauss.unwrap() / at(depth).gauss.unwrap();
        let normal = at(0).normal.unwrap();
        assert!((normal.norm() - 1.0).abs() < 1e-15);
        for depth in [280, 300] {
            let jump = ratio(depth) / ratio(depth + 1) - 1.0;
            assert!(jump.abs() < 1e-9, "N = {n} depth {depth}: {jump:e}");
            assert!(at(depth).position.coords.norm().is_finite());
        }
    }
}

/// Doo-Sabin: regular parts are biquadratic B-splines, faces' middles stay, and places are where refinement
/// goes.
#[test]
fn limits_of_corner_cutting() {
    let doo_sabin = rules("doo-sabin");
    let torus = eigenring_surface::shapes::torus(9, 7);
    let surface = Surface::new(&torus, &doo_sabin).unwrap();
    let at = |i: i32, j: i32| torus.points()[(i.rem_euclid(9) * 7 + j.rem_euclid(7)) as usize].coords;
    for (i, j) in (0..9).flat_map(|i| (0..7).map(move |j| (i, j))) {
        let (s, t) = (0.05 + f64::from(i) / 9.0, 0.95 - f64::from(j) / 7.0);
        let place = |s: f64, t: f64| Place {
            face: (i * 7 + j) as u32,
            sub: 0,
            corner: 0,
            s,
            t,
        };
        // the piece around the nearer vertex
        let piece = |x: f64| if x < 0.5 { (0, x + 0.5) } else { (1, x - 0.5) };
        let ((di, u), (dj, v)) = (piece(s), piece(t));
        let (in_s, in_t) = (
            eigenring_spline::uniform::basis(2, u),
            eigenring_spline::uniform::basis(2, v),
        );
        let sum = |a: usize, b: usize| -> Vector3<f64> {
            let term = |k: i32| {
                at(i + di + k % 3 - 1, j + dj + k / 3 - 1) * in_s[a][(k % 3) as usize] * in_t[b][(k / 3) as usize]
            };
            (0..9).map(term).sum()
        };
        let sample = surface.at(place(s, t)).unwrap();
        assert!((sample.position.coords - sum(0, 0)).norm() < 1e-13);
        assert!((sample.first.unwrap()[0] - sum(1, 0)).norm() < 1e-12);
        assert!((sample.second.unwrap()[1] - sum(1, 1)).norm() < 1e-12);
    }
    let mesh = eigenring_surface::shapes::propeller(5);
    let surface = Surface::new(&mesh, &doo_sabin).unwrap();
    let refined = eigenring_surface::Refiner::new(&doo_sabin).refined(&mesh, 7).unwrap();
    for (face, corners) in mesh.faces().enumerate() {
        let middle: Vector3<f64> = corners
            .iter()
            .map(|&v| mesh.points()[v as usize].coords)
            .sum::<Vector3<f64>>()
            / corners.len() as f64;
        let quad = corners.len() == 4;
        let place = |s: f64, t: f64| Place {
            face: face as u32,
            sub: 0,
            corner: 0,
            s,
            t,
        };
        let x = if quad { 0.5 } else { 1.0 };
        let sample = surface.at(place(x, x)).unwrap();
        assert!((sample.position.coords - middle).norm() < 1e-13, "face {face}");
        assert!(sample.normal.is_some());
        let sample = surface.at(place(0.2, 0.1)).unwrap();
        let near = refined
            .points()
            .iter()
            .map(|p| (p - sample.position).norm())
            .fold(f64::INFINITY, f64::min);
        assert!(near < 0.05, "face {face}: {near}");
        // one-sided limits beside the middle tend to it
        let beside = surface.at(place(x - 1e-9, x)).unwrap();
        assert!((beside.position.coords - middle).norm() < 1e-6 && beside.gauss.is_some());
    }
}

/// Vertices with a lambda of their own, adjacent ones too: limits at all vertices are those of refinement.
#[test]
fn single_vertices_have_their_own_lambda() {
    let control = eigenring_surface::shapes::brick([3, 2, 1]);
    let own = |lambda: f64| {
        Definition::Family(Spec::Lambda {
            lambda,
            s: None,
            weights: None,
            splines: Splines::Paper,
        })
    };
    let rules = Rules::new(Definition::Family(Spec::CatmullClark));
    let rules = rules
        .with_vertex(0, own(0.35))
        .with_vertex(1, own(0.55))
        .with_vertex(9, own(0.4));
    let surface = Surface::new(&control, &rules).unwrap();
    let refined: Vec<Mesh> = (4..=6)
        .map(|levels| Refiner::new(&rules).refined(&control, levels).unwrap())
        .collect();
    for fan in surface.vertices().unwrap() {
        let limit = fan.sample.position;
        let errors: Vec<f64> = refined
            .iter()
            .map(|mesh| (mesh.points()[fan.vertex as usize] - limit).norm())
            .collect();
        // the error falls by mu, at most .43 here: it would stop at a wrong point
        assert!(
            errors[2] < 0.45 * errors[1] && errors[1] < 0.45 * errors[0] || errors[2] < 1e-12,
            "{}: {errors:?}",
            fan.vertex
        );
    }
}
