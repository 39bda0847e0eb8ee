//! Halving a hybrid net of a million quads beside a level of Catmull-Clark, and spectra of n-gons.

use criterion::{Criterion, criterion_group, criterion_main};
use eigenring_nonuniform::{FirstLevel, NGon, Net, Outside, Scheme, nurss_step};
use eigenring_scheme::{Definition, Spec};
use eigenring_surface::{Refiner, Rules, shapes};

fn meshes(c: &mut Criterion) {
    let rules = Rules::new(Definition::Family(Spec::CatmullClark));
    // 6 * 4^9 quads are cut by doubled lines into some more
    let mesh = Refiner::new(&rules).refined(&shapes::cube(), 9).expect("a cube");
    let net = Net::new(&mesh).expect("quads with equal intervals");
    let hybrid = eigenring_nonuniform::HybridNet::of(&net, FirstLevel::Improved, Outside::Error);
    let hybrid = hybrid.expect("a closed mesh of quads").net;
    println!(
        "{} quads, {} of the hybrid net",
        mesh.face_count(),
        hybrid.net().topology().face_count()
    );
    let mut group = c.benchmark_group("meshes");
    group.sample_size(10);
    // a mesh that is given has no structure; one that was refined consists of blocks
    group.bench_function("a level of Catmull-Clark on the mesh", |b| {
        b.iter(|| Refiner::new(&rules).refined(&mesh, 1))
    });
    for levels in [9, 10] {
        group.bench_function(format!("{levels} levels of Catmull-Clark by blocks"), |b| {
            b.iter(|| Refiner::new(&rules).refined(&shapes::cube(), levels))
        });
    }
    group.bench_function("a halving of HNUSS", |b| b.iter(|| hybrid.halved()));
    let points: Vec<[f64; 3]> = vec![[1.0; 3]; hybrid.net().topology().vertex_count()];
    let (table, _) = hybrid.halved().expect("positive intervals");
    group.bench_function("its table on three channels", |b| b.iter(|| table.apply(&points)));
    // a hybrid net of a cube has eight extraordinary faces and doubled lines along all edges
    let cube = Net::new(&shapes::cube()).expect("quads with equal intervals");
    let coarse = eigenring_nonuniform::HybridNet::of(&cube, FirstLevel::Improved, Outside::Error);
    let coarse = coarse.expect("a closed mesh of quads").net;
    let points: Vec<[f64; 3]> = vec![[1.0; 3]; coarse.net().topology().vertex_count()];
    for levels in [9, 10] {
        group.bench_function(format!("{levels} halvings of HNUSS by blocks"), |b| {
            b.iter(|| {
                let mut blocks = coarse.blocks(points.clone());
                (0..levels).for_each(|_| blocks.halve().expect("positive intervals"));
                blocks.into_mesh()
            });
        });
    }
    group.bench_function("a level of NURSS", |b| b.iter(|| nurss_step(&net)));
    group.bench_function("a hybrid net", |b| {
        b.iter(|| eigenring_nonuniform::Refinement::new(&mesh, Scheme::Hnuss(FirstLevel::Improved), Outside::Error));
    });
    group.finish();
}

fn spectra(c: &mut Criterion) {
    let mut group = c.benchmark_group("spectra");
    group.sample_size(10);
    group.bench_function("1800 n-gons, n = 3 to 20", |b| {
        b.iter(|| {
            let sets = (0..1800).map(|k| {
                (0..3 + k % 18)
                    .map(|i| 1.0 + f64::from((i * 7 + k * 13) % 11))
                    .collect()
            });
            sets.map(|d: Vec<f64>| NGon::new(&d).map(|ngon| ngon.spectrum()[1]))
                .sum::<Result<f64, _>>()
        });
    });
    group.finish();
}

criterion_group!(benches, meshes, spectra);
criterion_main!(benches);
