//! One objective value with its exact gradient, one value alone, and the table they read.
//!
//! N = 6 has 3 classes of sectors, N = 20 has 5, N = 19 (the worst up to 20) has 19; each class costs two
//! square roots and one division per saddle and point. The time does not depend on where in (f2, f3) it is
//! taken.

use criterion::{Criterion, criterion_group, criterion_main};
use eigenring_scheme::lambda::Plane;
use eigenring_tune::objective::{Objective, Settings};
use std::hint::black_box;

fn objective(criterion: &mut Criterion) {
    for (valence, lambda, f2, f3) in [
        (4, 0.55, 0.25, 0.3025),
        (6, 0.5935, 0.3055, 0.1705),
        (19, 0.7, 0.43, 0.0),
        (20, 0.7, 0.43, 0.0),
        (64, 0.85, 0.43, 0.0),
    ] {
        let s = f64::max(1.0, 1.0 / (8.0 * lambda * lambda));
        let plane = Plane::new(valence, lambda, s).expect("a lambda in range");
        let objective = Objective::new(plane, Settings::default()).expect("the paper's settings");
        criterion.bench_function(&format!("value and gradient, N = {valence}"), |b| {
            b.iter(|| objective.value_and_gradient(black_box(f2), black_box(f3)));
        });
        criterion.bench_function(&format!("value, N = {valence}"), |b| {
            b.iter(|| objective.value(black_box(f2), black_box(f3)));
        });
    }
    let plane = Plane::new(6, 0.5935, 1.0).expect("a lambda in range");
    criterion.bench_function("table, N = 6", |b| {
        b.iter(|| Objective::new(black_box(plane), Settings::default()));
    });
}

criterion_group!(benches, objective);
criterion_main!(benches);
