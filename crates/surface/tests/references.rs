//! Refined meshes against those of other programs.
//!
//! Catmull-Clark with creases, corners, semi-sharp edges, boundaries and faces of any size: refinements by
//! OpenSubdiv (Pixar, regression suite; 9 digits, sharpness in 32 bits). Doo-Sabin with its original weights:
//! CGAL 5.5, whose open meshes shrink. Tension scheme of all orders with features: an independent
//! implementation. Points are matched as sets, counts and sums over faces beside them.

use crate::common::{centroid_sums, distance, json, load, mesh, own, points, rules, shared};
use eigenring_surface::{Boundary, Refiner};
use std::path::Path;

fn opensubdiv(folder: &Path) -> usize {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.contains(".refined"))
        .collect();
    names.sort();
    let rules = rules("catmull-clark");
    for name in &names {
        let (shape, rest) = name.split_once(".refined").unwrap();
        let levels: usize = rest.trim_end_matches(".obj").parse().unwrap();
        let mut control = load(&folder.join(format!("{shape}.obj")));
        control.features = control.features.in_single_precision();
        let found = Refiner::new(&rules).refined(&control, levels).unwrap();
        let expected = load(&folder.join(name));
        assert_eq!(found.points().len(), expected.points().len(), "{name}");
        assert_eq!(found.faces_by_size(), expected.faces_by_size(), "{name}");
        let distance = distance(found.points(), expected.points());
        assert!(distance <= 2e-6, "{name}: {distance:e}");
        let (a, b) = (centroid_sums(&found), centroid_sums(&expected));
        assert!(
            (0..2).all(|i| (a[i] - b[i]).abs() < 1e-5 * (1.0 + b[0])),
            "{name}: {a:?} {b:?}"
        );
    }
    names.len()
}

#[test]
fn refinements_of_opensubdiv() {
    assert!(opensubdiv(&own("opensubdiv")) > 0);
    if let Some(folder) = shared("data/opensubdiv") {
        assert!(opensubdiv(&folder) >= 18);
    }
}

fn runs(
    path: &Path,
    scheme: impl Fn(&serde_json::Value) -> String,
    boundary: Option<Boundary>,
    tolerance: f64,
) -> usize {
    let case = json(path);
    let runs = case["runs"].as_array().unwrap();
    for run in runs {
        let spec = scheme(run);
        let mut rules = rules(&spec);
        let mut control = mesh(&case);
        mark(&mut control, &case, run, &mut rules);
        let mut refiner = Refiner::new(&rules);
        refiner.boundary = boundary;
        let levels = run["levels"].as_u64().unwrap() as usize;
        let label = format!("{} {spec} {levels}", path.display());
        let found = refiner
            .refined(&control, levels)
            .unwrap_or_else(|error| panic!("{label}: {error}"));
        let expected = points(&run["positions"]);
        assert_eq!(found.points().len(), expected.len(), "{label}");
        let distance = distance(found.points(), &expected);
        assert!(distance <= tolerance, "{label}: {distance:e}");
        for (size, count) in run["faces_by_size"].as_object().unwrap() {
            let size: usize = size.parse().unwrap();
            assert_eq!(
                found.faces_by_size().get(&size).copied(),
                count.as_u64().map(|n| n as usize),
                "{label}"
            );
        }
        let sums = centroid_sums(&found);
        for (found, expected) in sums.iter().zip(run["centroid_sums"].as_array().unwrap()) {
            let expected = expected.as_f64().unwrap();
            assert!(
                (found - expected).abs() <= 1e-12 * (1.0 + sums[0]),
                "{label}: {found} {expected}"
            );
        }
    }
    runs.len()
}

/// The marks of a reference mesh.
fn mark(
    control: &mut eigenring_surface::Mesh,
    case: &serde_json::Value,
    run: &serde_json::Value,
    rules: &mut eigenring_surface::Rules,
) {
    let index = |value: &serde_json::Value| value.as_u64().unwrap() as u32;
    let list = |value: &serde_json::Value| value.as_array().cloned().unwrap_or_default();
    let edge = |value: &serde_json::Value| eigenring_surface::features::edge(index(&value[0]), index(&value[1]));
    let features = &mut control.features;
    rules.steps = run["cs"].as_u64().map(|cs| cs as usize);
    for crease in list(&case["creases"]) {
        features.creases.insert(edge(&crease), 10.0);
        if let Some(steps) = crease.get(2) {
            features.edge_steps.insert(edge(&crease), index(steps));
        }
    }
    for fixed in list(&case["fixed"]) {
        match fixed.as_array() {
            Some(pair) => {
                features.corners.insert(index(&pair[0]), 10.0);
                features.vertex_steps.insert(index(&pair[0]), index(&pair[1]));
            }
            None => {
                features.corners.insert(index(&fixed), 10.0);
            }
        }
    }
    for sharp in list(&case["sharpness"]) {
        features.creases.insert(edge(&sharp), sharp[2].as_f64().unwrap());
    }
    for sharp in list(&case["corner_sharpness"]) {
        features.corners.insert(index(&sharp[0]), sharp[1].as_f64().unwrap());
    }
}

fn cases(folder: &Path) -> Vec<std::path::PathBuf> {
    let mut paths: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| !path.to_string_lossy().contains("_limits"))
        .collect();
    paths.sort();
    assert!(!paths.is_empty());
    paths
}

#[test]
fn doo_sabin_of_cgal() {
    let check = |folder: &Path| {
        let count: usize = cases(folder)
            .iter()
            .map(|path| runs(path, |_| "doo-sabin".to_owned(), Some(Boundary::Shrink), 1e-12))
            .sum();
        assert!(count > 0);
    };
    check(&own("doo_sabin"));
    if let Some(folder) = shared("reference/doo_sabin") {
        check(&folder);
    }
}

#[test]
fn tension_scheme_with_features() {
    let check = |folder: &Path| {
        for path in cases(folder) {
            let scheme = |run: &serde_json::Value| format!("tension:order={},u0={}", run["order"], run["u0"]);
            assert!(runs(&path, scheme, None, 1e-12) > 0);
        }
    };
    check(&own("tension_meshes"));
    if let Some(folder) = shared("reference/tension_meshes") {
        check(&folder);
    }
}
