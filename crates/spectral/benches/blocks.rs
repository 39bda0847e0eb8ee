//! The Fourier blocks of a high order and their eigenvalues: order 22 at N = 20 has 11 blocks of 110 rows
//! (111 in block 0).
//!
//! Order 12 has blocks of 30 rows; order 21 is the largest odd one that is tabulated, 11 blocks of 100 rows.

use criterion::{Criterion, criterion_group, criterion_main};
use eigenring_scheme::families::tension;
use eigenring_spectral::{LocalSystem, fourier_blocks};
use std::hint::black_box;

fn blocks(criterion: &mut Criterion) {
    for order in [12, 21, 22] {
        let scheme = tension::<f64>(20, order, 2.0).expect("a scheme in range");
        let rings = scheme.closed_rings().expect("a closed scheme");
        let level = scheme.level(0);
        criterion.bench_function(&format!("closed rings, order {order}"), |b| {
            b.iter(|| black_box(&scheme).closed_rings());
        });
        criterion.bench_function(&format!("blocks, order {order}"), |b| {
            b.iter(|| fourier_blocks(black_box(level), rings));
        });
        let system = LocalSystem::new(level, rings).expect("closed rings");
        criterion.bench_function(&format!("eigenvalues, order {order}"), |b| {
            b.iter(|| black_box(&system).eigenvalues());
        });
    }
}

criterion_group!(benches, blocks);
criterion_main!(benches);
