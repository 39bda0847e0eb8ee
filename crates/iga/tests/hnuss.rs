//! The spaces of HNUSS: linear functions at equal and unequal intervals, rates, what is refused.

use crate::common::{natural, nitsche, of_hnuss, warped};
use eigenring_iga::{Domain, Error, Norms, Options, Problem, Solver, Study, solution};
use eigenring_nonuniform::{FirstLevel, Outside, Scheme};
use eigenring_surface::shapes::uneven_fan;
use eigenring_surface::{Mesh, shapes};

fn errors(mesh: &Mesh, name: &str, problem: Problem, levels: std::ops::Range<usize>, options: &Options) -> Vec<Norms> {
    let u = solution::named(name).expect("a solution");
    let study = of_hnuss(mesh);
    levels
        .map(|level| study.level(level, problem, &u, options).expect("an outcome").error)
        .collect()
}

/// Intervals of the spokes in turn, ratios up to 3.
const SETS: [&[f64]; 3] = [&[1.0], &[3.0, 1.0], &[3.0, 1.0, 1.7]];

#[test]
fn linear_functions_are_reproduced_at_equal_and_unequal_intervals() {
    for (n, set) in [3, 5, 6, 8].into_iter().flat_map(|n| SETS.map(|set| (n, set))) {
        let mesh = warped(uneven_fan(n, set));
        // the rules around an n-gon are the same from level 2 on
        for (levels, ends) in [(0..3, Options::default()), (0..1, natural()), (1..2, nitsche())] {
            let options = Options {
                depth: Some(24),
                ..ends
            };
            for e in errors(&mesh, "lin", Problem::Poisson, levels.clone(), &options) {
                assert!(
                    e.l2 <= 1e-12 && e.h1 <= 1e-10 && e.h2 <= 1e-9,
                    "N = {n}, {set:?}, {options:?}: {e:?}"
                );
            }
        }
    }
}

/// What shows that the test before measures something: with few halvings the part of the corner that is left
/// out is felt, 2e-2, 1e-4, 1e-9 at 4, 8, 16 in a prototype.
#[test]
fn few_halvings_fail_the_patch_test() {
    let h1 = |depth: usize, scaled: bool| {
        let options = Options {
            depth: Some(depth),
            scaled,
            ..Options::default()
        };
        errors(&uneven_fan(5, SETS[1]), "lin", Problem::Poisson, 1..2, &options)[0].h1
    };
    let found = [4, 8, 16].map(|depth| h1(depth, false));
    for (found, range) in found.iter().zip([1e-3..1e-1, 1e-5..1e-3, 1e-11..1e-8]) {
        assert!(range.contains(found), "{found:e} for {range:?}");
    }
    assert!(h1(8, true) < 0.1 * found[1], "{:e} for {:e}", h1(8, true), found[1]);
}

/// Lambda is 1/2 at every n-gon: 3, 2, 2, 1 in L2, H1, Linf and H2, reached late where there are many spokes.
#[test]
fn rates_are_those_of_one_half() {
    for (n, off) in [(3, 0.1), (5, 0.1)] {
        let e = errors(&shapes::fan(n), "exp", Problem::Poisson, 3..5, &Options::default());
        let rate = |of: fn(&Norms) -> f64| (of(&e[0]) / of(&e[1])).log2();
        let observed = [rate(|e| e.l2), rate(|e| e.h1), rate(|e| e.linf), rate(|e| e.h2)];
        for (observed, predicted) in observed.into_iter().zip([3.0, 2.0, 2.0, 1.0]) {
            assert!(
                (observed - predicted).abs() < off,
                "N = {n}: {observed} for {predicted}"
            );
        }
    }
}

#[test]
fn closed_surfaces_and_projections_have_spaces_too() {
    let u = solution::named("mix").expect("a solution");
    let cube = Study::with_intervals(
        &shapes::cube(),
        Scheme::Hnuss(FirstLevel::Improved),
        Outside::Error,
        Domain::Closed,
    )
    .expect("a study");
    let error = |level| {
        let outcome = cube.level(level, Problem::LaplaceBeltrami, &u, &Options::default());
        outcome.expect("an outcome").error
    };
    let (coarse, fine) = (error(1), error(2));
    // on the way to 3 and 2
    assert!(
        coarse.l2 > 5.0 * fine.l2 && coarse.h1 > 3.0 * fine.h1,
        "{coarse:?} {fine:?}"
    );
    let projected = errors(&uneven_fan(5, SETS[2]), "exp", Problem::L2, 1..3, &Options::default());
    assert!(projected[1].l2 < 0.25 * projected[0].l2, "{projected:?}");
}

#[test]
fn what_hnuss_has_no_space_for_is_refused() {
    let u = solution::named("lin").expect("a solution");
    let mesh = uneven_fan(5, SETS[1]);
    let study = of_hnuss(&mesh);
    let plate = study.level(0, Problem::Biharmonic, &u, &Options::default());
    assert!(matches!(plate, Err(Error::Combination { .. })));
    let multigrid = Options {
        solver: Some(Solver::Multigrid),
        ..Options::default()
    };
    let cycle = study.level(0, Problem::Poisson, &u, &multigrid);
    assert!(matches!(cycle, Err(Error::Combination { .. })));
    let mut flat = mesh.clone();
    flat.features.knots.values_mut().for_each(|d| *d = 20.0 * (*d - 0.95));
    let far = Study::with_intervals(
        &flat,
        Scheme::Hnuss(FirstLevel::Improved),
        Outside::Error,
        Domain::Planar,
    );
    assert!(
        matches!(far, Err(Error::Intervals(_))),
        "outside the domain of eigen-polyhedra"
    );
    let closed = Study::with_intervals(
        &mesh,
        Scheme::Hnuss(FirstLevel::Improved),
        Outside::Error,
        Domain::Closed,
    );
    assert!(matches!(closed, Err(Error::Open)));
}
