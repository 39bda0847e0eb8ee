//! The same bits for any number of threads: refinement in blocks, and limit points.

use eigenring_atlas::limits::samples;
use eigenring_atlas::meshes::Pool;
use eigenring_scheme::{Definition, Spec};
use eigenring_surface::{Refiner, Rules, Serial, Surface, shapes};

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
        let places = surface.grid(4);
        let expected = surface.at_all(&places).unwrap();
        for threads in [1, 2, 8] {
            // a surface of its own, so that nothing is remembered from the run before
            let fresh = Surface::new(&control, &rules).unwrap();
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            assert!(
                pool.install(|| samples(&fresh, &places).unwrap()) == expected,
                "{spec} {threads}"
            );
        }
    }
}
