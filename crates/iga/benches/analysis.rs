//! Times of assembly, solvers and a whole run on regular meshes, on one thread.
//!
//! Floor of assembly with 4 x 4 points (the triangle of 136 entries, two products each, and some 200 more a
//! point): 7600 products a face, 1.5 microseconds at 5 of them a nanosecond.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use eigenring_iga::{Domain, Options, Outcome, Problem, Solver, Study, solution};
use eigenring_scheme::{Definition, Spec};
use eigenring_surface::{Rules, shapes};
use std::time::Duration;

fn levels(c: &mut Criterion) {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .use_current_thread()
        .build_global()
        .expect("the only pool");
    let rules = Rules::new(Definition::Family(Spec::CatmullClark));
    let u = solution::named("exp").expect("a solution");
    // valence 4 is regular
    let study = Study::new(&shapes::fan(4), &rules, Domain::Planar).expect("a study");
    let run = |level: usize, solver: Solver| -> Outcome {
        let options = Options {
            solver: Some(solver),
            ..Options::default()
        };
        study.level(level, Problem::Poisson, &u, &options).expect("an outcome")
    };
    let mut group = c.benchmark_group("poisson");
    group.sample_size(10);
    for level in [4, 6] {
        let faces = 16 << (2 * level);
        group.throughput(Throughput::Elements(faces));
        // assembly, solution, errors, of the same runs as the whole, which refines the mesh too
        for (part, name) in ["assembly", "solve", "errors"].into_iter().enumerate() {
            for solver in [Solver::Cholesky, Solver::Multigrid] {
                if part != 1 && solver == Solver::Multigrid {
                    continue;
                }
                let id = BenchmarkId::new(format!("{name}, {solver:?}"), faces);
                group.bench_function(id, |b| {
                    b.iter_custom(|times| {
                        let seconds: f64 = (0..times).map(|_| run(level, solver).seconds[part]).sum();
                        Duration::from_secs_f64(seconds)
                    });
                });
            }
        }
        group.bench_function(BenchmarkId::new("whole", faces), |b| {
            b.iter(|| run(level, Solver::Cholesky));
        });
    }
    group.finish();
}

criterion_group!(benches, levels);
criterion_main!(benches);
