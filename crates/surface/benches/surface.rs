//! Times of refinement and evaluation on a mesh like a modeller's: 180 faces, a million quads after six
//! levels.
//!
//! Compare with OpenSubdiv 3.5 on one thread (topology and positions of six levels .133 s, a million points
//! with second derivatives .19 s), which stores the topology that is not made here.

use criterion::{Criterion, criterion_group, criterion_main};
use eigenring_scheme::{Definition, Spec};
use eigenring_surface::{Refiner, Rules, Surface, shapes};
use std::hint::black_box;

fn rules(spec: &str) -> Rules {
    Rules::new(Definition::Family(spec.parse::<Spec>().expect("a registered scheme")))
}

/// The mesh of a file named by the environment, or a gear.
fn control() -> eigenring_surface::Mesh {
    let Ok(path) = std::env::var("EIGENRING_MESH") else {
        return shapes::gear(11);
    };
    let file = std::fs::File::open(path).expect("EIGENRING_MESH names an OBJ file");
    let mesh = eigenring_surface::io::read(file, eigenring_surface::io::Format::Obj);
    mesh.and_then(eigenring_surface::io::MeshFile::surface)
        .expect("it is a surface")
}

fn refinement(criterion: &mut Criterion) {
    let control = control();
    let mut group = criterion.benchmark_group("refinement");
    group.sample_size(10);
    for (spec, levels) in [
        ("catmull-clark", 6),
        ("catmull-clark", 7),
        ("doo-sabin", 6),
        ("lambda:optimal", 6),
        ("stam:order=5", 6),
        ("tension:order=6,u0=0.5", 6),
        ("stam:order=8", 6),
    ] {
        let rules = rules(spec);
        group.bench_function(format!("{spec}/{levels}"), |bench| {
            bench.iter(|| {
                Refiner::new(&rules)
                    .refined(black_box(&control), levels)
                    .expect("it is a surface")
            });
        });
    }
    group.finish();
}

fn evaluation(criterion: &mut Criterion) {
    let control = control();
    let rules = rules("catmull-clark");
    let surface = Surface::new(&control, &rules).expect("it is a surface");
    // about a million places
    let quarters: usize = control
        .faces()
        .map(|face| if face.len() == 4 { 1 } else { face.len() })
        .sum();
    let places = surface.grid((1e6 / quarters as f64).sqrt().round() as usize);
    let mut group = criterion.benchmark_group("evaluation");
    group.sample_size(10);
    group.bench_function(format!("{} points with curvature", places.len()), |bench| {
        bench.iter(|| surface.at_all(black_box(&places)).expect("places are on the surface"));
    });
    group.finish();
}

criterion_group!(benches, refinement, evaluation);
criterion_main!(benches);
