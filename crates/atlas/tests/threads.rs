//! The same bits for any number of threads: refinement in blocks, and limit points.

use eigenring_atlas::limits::{Columns, KINDS, columns, samples};
use eigenring_atlas::meshes::Pool;
use eigenring_scheme::{Definition, Spec};
use eigenring_surface::{Place, Refiner, Rules, Sample, Serial, Surface, Vector3, shapes};

#[test]
fn threads_change_no_bit() {
    let control = shapes::gear(3);
    for spec in ["catmull-clark", "doo-sabin", "lambda:optimal"] {
        let rules = Rules::new(Definition::Family(spec.parse::<Spec>().unwrap()));
        let mut refiner = Refiner::new(&rules);
        refiner.workers = &Serial;
        let expected = refiner.refined(&control, 5).unwrap();
        refiner.workers = &Pool;
        for threads in [1, 2, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            assert!(
                pool.install(|| refiner.refined(&control, 5).unwrap()) == expected,
                "{spec} {threads}"
            );
        }
        if spec == "doo-sabin" {
            continue;
        }
        let surface = Surface::new(&control, &rules).unwrap();
        // face by face, and with the faces of a million places in turn
        let sorted = surface.grid(36);
        assert!(sorted.len() > 3 << 14, "{} places are one part or two", sorted.len());
        let mixed: Vec<Place> = (0..sorted.len()).map(|i| sorted[i * 7919 % sorted.len()]).collect();
        for places in [sorted, mixed] {
            let expected = surface.at_all(&places).unwrap();
            for threads in [1, 2, 8] {
                // a surface of its own, so that nothing is remembered from the run before
                let fresh = Surface::new(&control, &rules).unwrap();
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let (found, columns) =
                    pool.install(|| (samples(&fresh, &places).unwrap(), columns_at(&fresh, &places).unwrap()));
                assert!(found == expected, "{spec} {threads}");
                assert_same(&columns, &expected);
                for bad in [3, places.len() / 2] {
                    let mut places = places.clone();
                    (places[bad].s, places[bad + 1].t) = (1.5, -0.5);
                    let message = surface.at_all(&places).unwrap_err().to_string();
                    let refused = pool.install(|| samples(&fresh, &places).unwrap_err());
                    assert_eq!(refused.to_string(), message, "{spec} {threads}");
                    let refused = pool.install(|| columns_at(&fresh, &places).unwrap_err());
                    assert_eq!(refused.to_string(), message, "{spec} {threads}");
                }
            }
        }
    }
}

fn columns_at(surface: &Surface<'_>, places: &[Place]) -> Result<Columns, eigenring_atlas::Error> {
    columns(surface, places.len(), |index| places[index])
}

/// The columns hold the numbers of the samples.
fn assert_same(columns: &Columns, samples: &[Sample]) {
    let same = |found: &[f64], expected: Option<&[f64]>| match expected {
        Some(expected) => found == expected,
        None => found.iter().all(|x| x.is_nan()),
    };
    for (row, sample) in samples.iter().enumerate() {
        let wide = |width: usize| width * row..width * (row + 1);
        let flat = |vectors: &[Vector3<f64>]| vectors.iter().flat_map(|v| [v.x, v.y, v.z]).collect::<Vec<_>>();
        let (first, second) = (sample.first.map(|v| flat(&v)), sample.second.map(|v| flat(&v)));
        assert!(same(&columns.points[wide(3)], Some(sample.position.coords.as_slice())));
        assert!(same(&columns.first[wide(6)], first.as_deref()));
        assert!(same(&columns.second[wide(9)], second.as_deref()));
        assert!(same(
            &columns.normals[wide(3)],
            sample.normal.as_ref().map(|v| v.as_slice())
        ));
        assert!(same(
            &columns.gauss[wide(1)],
            sample.gauss.as_ref().map(std::slice::from_ref)
        ));
        assert!(same(
            &columns.mean[wide(1)],
            sample.mean.as_ref().map(std::slice::from_ref)
        ));
        assert!(same(
            &columns.principal[wide(2)],
            sample.principal.as_ref().map(|k| &k[..])
        ));
        assert_eq!(KINDS[usize::from(columns.kinds[row])], sample.kind.name());
    }
}
