//! Times of refinement and evaluation on a mesh like a modeller's: 180 faces, a million quads after six
//! levels.
//!
//! Compare with OpenSubdiv 3.5 on one thread (topology and positions of six levels .133 s, a million points
//! with second derivatives .19 s), which stores the topology that is not made here.

use criterion::measurement::{Measurement, ValueFormatter, WallTime};
use criterion::{Criterion, criterion_group, criterion_main};
use eigenring_scheme::{Definition, Spec};
use eigenring_surface::{Mesh, Place, Refiner, Rules, Surface, Topology, shapes};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Time of the processor, where the system tells it (Linux), so that other work on the machine counts less;
/// wall time elsewhere. It goes in ticks of a few milliseconds.
struct ProcessorTime;

impl ProcessorTime {
    fn nanoseconds() -> Option<u64> {
        let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
        text.split_whitespace().next()?.parse().ok()
    }
}

impl Measurement for ProcessorTime {
    type Intermediate = (Instant, Option<u64>);
    type Value = Duration;

    fn start(&self) -> Self::Intermediate {
        (Instant::now(), Self::nanoseconds())
    }

    fn end(&self, (wall, start): Self::Intermediate) -> Duration {
        let end = Self::nanoseconds();
        start
            .zip(end)
            .map_or_else(|| wall.elapsed(), |(start, end)| Duration::from_nanos(end - start))
    }

    fn add(&self, a: &Duration, b: &Duration) -> Duration {
        *a + *b
    }

    fn zero(&self) -> Duration {
        Duration::ZERO
    }

    // never zero, which a tick may leave of something short
    fn to_f64(&self, value: &Duration) -> f64 {
        value.as_nanos().max(1) as f64
    }

    fn formatter(&self) -> &dyn ValueFormatter {
        WallTime.formatter()
    }
}

fn rules(spec: &str) -> Rules {
    Rules::new(Definition::Family(spec.parse::<Spec>().expect("a registered scheme")))
}

/// The mesh of a file named by the environment, or a gear.
fn control() -> Mesh {
    let Ok(path) = std::env::var("EIGENRING_MESH") else {
        return shapes::gear(11);
    };
    let file = std::fs::File::open(path).expect("EIGENRING_MESH names an OBJ file");
    let mesh = eigenring_surface::io::read(file, eigenring_surface::io::Format::Obj);
    mesh.and_then(eigenring_surface::io::MeshFile::surface)
        .expect("it is a surface")
}

fn refinement(criterion: &mut Criterion<ProcessorTime>) {
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

/// A million pseudo-random places, so far apart in memory as they come.
fn places(control: &Mesh, count: usize) -> Vec<Place> {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(1);
    // 53 bits each
    let mut unit = move || (random.next_u64() >> 11) as f64 * 2.0_f64.powi(-53);
    let faces = control.face_count();
    let place = |_| {
        let face = (unit() * faces as f64) as usize;
        let size = control.face(face).len();
        let sub = if size == 4 { 0 } else { (unit() * size as f64) as u32 };
        let (face, corner) = (face as u32, 0);
        let (s, t) = (unit(), unit());
        Place {
            face,
            sub,
            corner,
            s,
            t,
        }
    };
    (0..count).map(place).collect()
}

fn evaluation(criterion: &mut Criterion<ProcessorTime>) {
    let control = control();
    let places = places(&control, 1_000_000);
    let mut group = criterion.benchmark_group("evaluation");
    group.sample_size(10);
    for spec in ["catmull-clark", "tension:order=6,u0=0.5"] {
        let rules = rules(spec);
        let surface = Surface::new(&control, &rules).expect("it is a surface");
        group.bench_function(format!("{spec}/a million samples, taken as they come"), |bench| {
            bench.iter(|| {
                let taken = surface.at_each(black_box(&places), |_, found| {
                    black_box(found);
                });
                taken.expect("places are on the surface");
            });
        });
        group.bench_function(format!("{spec}/a million samples, kept"), |bench| {
            bench.iter(|| surface.at_all(black_box(&places)).expect("places are on the surface"));
        });
    }
    // what comes before: matrices of all levels around irregular vertices of each valence, then parts of
    // faces
    let first = [
        ("valence", places_beside(&control, true)),
        ("corner", places_beside(&control, false)),
    ];
    for spec in ["catmull-clark", "tension:order=6,u0=1", "tension:order=6,u0=0.5"] {
        let rules = rules(spec);
        for (what, places) in &first {
            group.bench_function(format!("{spec}/first places beside each {what}"), |bench| {
                bench.iter(|| {
                    let surface = Surface::new(black_box(&control), &rules).expect("it is a surface");
                    surface.at_all(places).expect("places are on the surface")
                });
            });
        }
    }
    group.finish();
}

/// A place beside each corner of each face, or beside one of each valence in faces of each size.
fn places_beside(control: &Mesh, once: bool) -> Vec<Place> {
    let valences = Topology::unchecked(control).valences();
    let mut seen = std::collections::BTreeSet::new();
    let mut places = Vec::new();
    for (face, corners) in (0..).zip(control.faces()) {
        let size = corners.len();
        let near = [
            (1e-3, 2e-3),
            (1.0 - 1e-3, 2e-3),
            (1.0 - 1e-3, 1.0 - 2e-3),
            (1e-3, 1.0 - 2e-3),
        ];
        for (corner, &vertex) in corners.iter().enumerate() {
            if once && !seen.insert((size, valences[vertex as usize])) {
                continue;
            }
            let (sub, (s, t)) = match size {
                4 => (0, near[corner]),
                _ => (corner as u32, near[0]),
            };
            places.push(Place {
                face,
                sub,
                corner: 0,
                s,
                t,
            });
        }
    }
    places
}

criterion_group! {
    name = benches;
    config = Criterion::default().with_measurement(ProcessorTime);
    targets = refinement, evaluation
}
criterion_main!(benches);
