//! Times of assembly, solvers and a whole run on regular meshes, on one thread.
//!
//! Floor of assembly with 4 x 4 points (the triangle of 136 entries, two products each, and some 200 more a
//! point): 7600 products a face, 1.5 microseconds at 5 of them a nanosecond.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use eigenring_iga::{Domain, Options, Outcome, Problem, Solver, Study, solution};
use eigenring_scheme::{Definition, Spec};
use eigenring_surface::{Rules, shapes};
use std::hint::black_box;
use std::time::{Duration, Instant};

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

/// Multiply-adds of a face's floor, and lanes of independent sums: enough that they do not wait for each
/// other.
const FLOOR: usize = 16 * (2 * 136 + 200);
const SUMS: usize = 64;

/// The seconds of a face's multiply-adds on this processor, products and sums by themselves as those of the
/// library are, in the registers that it uses.
fn floor() -> f64 {
    struct Sweep(usize);
    impl pulp::WithSimd for Sweep {
        type Output = f64;

        #[inline(always)]
        fn with_simd<S: pulp::Simd>(self, _: S) -> f64 {
            let (mut sums, factors) = (black_box([1.0; SUMS]), black_box([1e-9; SUMS]));
            let scale = black_box(1.000_000_1);
            for _ in 0..self.0 {
                for (sum, factor) in sums.iter_mut().zip(&factors) {
                    *sum += scale * factor;
                }
                // nothing is taken out of the loop
                sums = black_box(sums);
            }
            sums.iter().sum()
        }
    }
    let faces = 20_000;
    let start = Instant::now();
    black_box(pulp::Arch::new().dispatch(Sweep(faces * FLOOR / SUMS)));
    start.elapsed().as_secs_f64() / f64::from(faces as u32)
}

/// Seconds of assembly by face over those of the floor, both the best of some runs in turn.
fn ratio(_: &mut Criterion) {
    let rules = Rules::new(Definition::Family(Spec::CatmullClark));
    let u = solution::named("exp").expect("a solution");
    let study = Study::new(&shapes::fan(4), &rules, Domain::Planar).expect("a study");
    let (mut own, mut least) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..5 {
        least = least.min(floor());
        let run = study.level(6, Problem::Poisson, &u, &Options::default());
        let run = run.expect("an outcome");
        own = own.min(run.seconds[0] / run.faces as f64);
    }
    println!(
        "assembly of a regular face: {:.2} us, {:.1} times its {FLOOR} multiply-adds ({:.2} us)",
        1e6 * own,
        own / least,
        1e6 * least
    );
}

criterion_group!(benches, levels, ratio);
criterion_main!(benches);
