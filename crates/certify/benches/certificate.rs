//! A certificate made (search and checks), and checked again (checks alone).
//!
//! Time goes into N/2 + 1 Fourier blocks, each of a few unknowns a ring, and into the Bernstein coefficients
//! of the Jacobian and of the second-order curvatures on the patches of half a sector, whose number does not
//! depend on N.

use criterion::{Criterion, criterion_group, criterion_main};
use eigenring_certify::{Input, certify, recheck};
use eigenring_scheme::Spec;
use std::hint::black_box;

fn certificate(criterion: &mut Criterion) {
    for (valence, spec) in [
        (5, "catmull-clark"),
        (64, "catmull-clark"),
        (6, "lambda:optimal"),
        (20, "lambda:optimal"),
    ] {
        let parsed: Spec = spec.parse().expect("a registered scheme");
        let input = Input::from_spec(&parsed, valence).expect("a tabulated valence");
        criterion.bench_function(&format!("certify {spec}, N = {valence}"), |b| {
            b.iter(|| certify(black_box(input.clone()), valence));
        });
        let stored = certify(input, valence).expect("a scheme at a valence it has");
        criterion.bench_function(&format!("recheck {spec}, N = {valence}"), |b| {
            b.iter(|| recheck(black_box(&stored)));
        });
    }
}

criterion_group!(benches, certificate);
criterion_main!(benches);
