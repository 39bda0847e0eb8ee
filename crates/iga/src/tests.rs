//! What no public function shows: nestedness, invariants of the matrices, deflation, the operator of Laplace
//! and Beltrami.

use crate::Error;
use crate::around::Around;
use crate::assembly::{assemble, assemble_by};
use crate::boundary::nitsche;
use crate::geometry::Geometry;
use crate::hybrid;
use crate::integrals::{Form, Integrands, Load, Local, Room};
use crate::multigrid::{Goals, Multigrid};
use crate::nested::{embedding, refinement};
use crate::norms::errors;
use crate::patch::bicubic;
use crate::patch::{Control, Data, Jets, Maps, Wanted};
use crate::solution;
use crate::space::{Depth, Ends, Space};
use crate::sparse::Sparse;
use eigenring_nonuniform::{FirstLevel, Outside, Refinement};
use eigenring_scheme::{Definition, Spec};
use eigenring_surface::{Boundary, Mesh, Refiner, Rules, shapes};
use std::collections::BTreeMap;

fn rules(name: &str) -> Rules {
    Rules::new(Definition::Family(name.parse::<Spec>().expect("a scheme")))
}

fn space(mesh: &Mesh, rules: &Rules, ends: Ends) -> Space {
    Space::new(mesh, rules, ends, true)
        .expect("a space")
        .expect("vertices are apart")
}

fn refined(mesh: &Mesh, rules: &Rules) -> Mesh {
    let mut refiner = Refiner::new(rules);
    refiner.boundary = Some(Boundary::Corner);
    refiner.refined(mesh, 1).expect("a mesh")
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[test]
fn energies_of_a_function_are_those_of_its_embeddings() {
    for (n, scheme, ends) in [
        (3, "lambda:lambda=0.39", Ends::Open),
        (5, "catmull-clark", Ends::Open),
        (6, "lambda:lambda=0.5", Ends::Natural),
    ] {
        let rules = rules(scheme);
        let mut mesh = shapes::fan(n);
        let mut coarse = space(&mesh, &rules, ends);
        let mut u: Vec<f64> = (0..coarse.positions.len()).map(|i| (7.3 * i as f64).sin()).collect();
        if ends == Ends::Natural {
            u[coarse.inner..].fill(0.0);
        }
        let mut all = Vec::new();
        for level in 0..3 {
            // the mass is of bidegree 11, and energies are rational
            let energy = |form: Form, gauss: usize| {
                let tables = coarse.tables(gauss, Depth::Area, false);
                let (matrices, _) = assemble(&coarse, &tables, &[form], None).expect("matrices");
                dot(&u, &matrices[0].times(&u))
            };
            all.push([energy(Form::Mass, 6), energy(Form::Stiffness, 12)]);
            if level < 2 {
                let finer = refined(&mesh, &rules);
                let fine = space(&finer, &rules, ends);
                let control = refinement(&mesh, &coarse, &fine).expect("a matrix");
                for axis in 0..2 {
                    let of = |space: &Space| -> Vec<f64> { space.positions.iter().map(|p| p[axis]).collect() };
                    let moved = control.times(&of(&coarse));
                    let off = moved.iter().zip(of(&fine)).map(|(a, b)| (a - b).abs());
                    assert!(
                        off.fold(0.0, f64::max) < 1e-14,
                        "{scheme}: refined points are those of the mesh"
                    );
                }
                u = embedding(&mesh, &coarse, &fine).expect("a matrix").times(&u);
                (mesh, coarse) = (finer, fine);
            }
        }
        for form in 0..2 {
            let values: Vec<f64> = all.iter().map(|pair| pair[form]).collect();
            let off = values
                .iter()
                .map(|value| (value / values[0] - 1.0).abs())
                .fold(0.0, f64::max);
            assert!(off <= 1e-12, "{scheme}, N = {n}, {ends:?}: {values:?}");
        }
    }
}

/// Refinement makes points by rules of its own; the functions of a net are those of the next.
#[test]
fn energies_with_knot_intervals_are_those_of_the_next_nets() {
    use eigenring_nonuniform::Scheme::{EigenPolyhedron, Hnuss, Nurss};
    for (scheme, intervals) in [
        (Hnuss(FirstLevel::Improved), [3.0, 1.0]),
        (Nurss, [3.0, 1.0]),
        (EigenPolyhedron, [1.5, 1.0]),
    ] {
        let mesh = shapes::uneven_fan(5, &intervals);
        let mut refinement = Refinement::new(&mesh, scheme, Outside::Error).expect("a net");
        if refinement.hybrid().is_none() {
            // until four edges of a spoke have one interval
            (0..2).for_each(|_| refinement.refine().expect("a net"));
        }
        let positions: Vec<[f64; 3]> = mesh.points().iter().map(|p| [p.x, p.y, p.z]).collect();
        let count = refinement.net().topology().vertex_count();
        let mut u: Vec<[f64; 1]> = (0..count).map(|i| [(7.3 * i as f64).sin()]).collect();
        let mut all: Vec<[f64; 2]> = Vec::new();
        for level in 0..3 {
            let points = refinement.apply(&positions).expect("points");
            let space = hybrid::space(&refinement, &points, level, Ends::Natural)
                .expect("a space")
                .expect("wide enough");
            let mut values = vec![0.0; space.positions.len()];
            u.iter().zip(&mut values).for_each(|([u], value)| *value = *u);
            let energy = |form: Form, gauss: usize| {
                let (matrices, _) =
                    assemble(&space, &space.tables(gauss, Depth::Area, false), &[form], None).expect("matrices");
                dot(&values, &matrices[0].times(&values))
            };
            all.push([energy(Form::Mass, 6), energy(Form::Stiffness, 12)]);
            refinement.refine().expect("a net");
            let table = refinement.tables().last().expect("of the last level");
            u = table.apply(&u).expect("points");
        }
        for form in 0..2 {
            let values: Vec<f64> = all.iter().map(|pair| pair[form]).collect();
            assert!(
                values.iter().all(|value| (value / values[0] - 1.0).abs() <= 1e-12),
                "{scheme}: {values:?}"
            );
        }
    }
}

#[test]
fn coordinates_have_the_energy_of_the_area() {
    let rules = rules("lambda:lambda=0.39");
    let mut space = space(&shapes::fan(5), &rules, Ends::Open);
    // over control points and ghosts
    space.transform = Sparse::identity_but(space.positions.len(), BTreeMap::new());
    let tables = space.tables(4, Depth::Area, false);
    let (matrices, weights) = assemble(&space, &tables, &[Form::Stiffness], Some(&|_| 1.0)).expect("matrices");
    let area: f64 = weights.iter().sum();
    let [x, y]: [Vec<f64>; 2] = [0, 1].map(|axis| space.positions.iter().map(|p| p[axis]).collect());
    let [kx, ky] = [&x, &y].map(|v| matrices[0].times(v));
    let ones = matrices[0].times(&vec![1.0; x.len()]);
    // a regular pentagon of circumradius 1
    let pentagon = 2.5 * (0.4 * std::f64::consts::PI).sin();
    for (value, expected) in [
        (area, pentagon),
        (dot(&x, &kx), area),
        (dot(&y, &ky), area),
        (dot(&x, &ky), 0.0),
    ] {
        assert!((value - expected).abs() <= 1e-12, "{value} for {expected}");
    }
    assert!(ones.iter().all(|value| value.abs() <= 1e-12));
}

/// Traces and Frobenius norms of the matrices over control points and ghosts, whatever their order, against a
/// prototype with 10 x 10 points.
#[test]
fn matrices_have_the_invariants_of_the_prototype() {
    let cases: serde_json::Value = serde_json::from_str(include_str!("../tests/data/eigenvalues.json")).expect("JSON");
    for case in cases.as_array().expect("cases") {
        let [mesh, scheme] = ["mesh", "scheme"].map(|key| case[key].as_str().expect("text"));
        let rules = rules(scheme);
        let mut mesh = shapes::fan(mesh[3..].parse().expect("a valence"));
        for _ in 0..case["level"].as_u64().expect("a level") {
            mesh = refined(&mesh, &rules);
        }
        let mut space = space(&mesh, &rules, Ends::Open);
        assert_eq!(Some(space.positions.len() as u64), case["dof"].as_u64());
        assert_eq!(Some(space.inner as u64), case["interior_dof"].as_u64());
        space.transform = Sparse::identity_but(space.positions.len(), BTreeMap::new());
        let tables = space.tables(10, Depth::Area, false);
        let (matrices, _) = assemble(&space, &tables, &[Form::Stiffness, Form::Mass], None).expect("matrices");
        for (name, matrix) in ["K", "M"].into_iter().zip(&matrices) {
            let diagonal = |row: usize| matrix.row(row).find(|(column, _)| *column == row).map_or(0.0, |e| e.1);
            let trace = (0..matrix.height()).map(diagonal).sum::<f64>();
            for (key, value) in [
                ("trace", trace),
                ("frobenius", dot(&matrix.values, &matrix.values).sqrt()),
            ] {
                let expected = case[format!("{key}_{name}")].as_f64().expect("a number");
                let off = (value / expected - 1.0).abs();
                assert!(
                    off <= 1e-8,
                    "{scheme}, {key} of {name}: {value} for {expected}, off {off:e}"
                );
            }
        }
    }
}

/// On a torus of three by three quads the grid of a face has points twice. Coordinates have twice the area as
/// their energy, and functions of the coarse space have the same norm in the fine one.
#[test]
fn a_point_that_a_face_has_twice_counts_twice() {
    let rules = rules("catmull-clark");
    let coarse = shapes::torus(3, 3);
    let fine = refined(&coarse, &rules);
    let all = [space(&coarse, &rules, Ends::Open), space(&fine, &rules, Ends::Open)];
    let up = embedding(&coarse, &all[0], &all[1]).expect("a matrix");
    let function: Vec<f64> = (0..up.width).map(|k| (k as f64).sin()).collect();
    let mut norms = Vec::new();
    for (space, v) in all.iter().zip([function.clone(), up.times(&function)]) {
        let tables = space.tables(10, Depth::Area, false);
        let forms = [Form::Stiffness, Form::Mass];
        let (matrices, weights) = assemble(space, &tables, &forms, Some(&|_| 1.0)).expect("matrices");
        let area: f64 = weights.iter().sum();
        let energy = (0..3).map(|axis| {
            let x: Vec<f64> = space.positions.iter().map(|p| p[axis]).collect();
            dot(&x, &matrices[0].times(&x))
        });
        let energy: f64 = energy.sum();
        assert!((energy / (2.0 * area) - 1.0).abs() < 1e-14, "{energy} for twice {area}");
        norms.push(dot(&v, &matrices[1].times(&v)));
    }
    // the measure is no polynomial: quadrature is off by 4e-7
    assert!((norms[0] / norms[1] - 1.0).abs() < 1e-6, "{norms:?}");
}

/// In whatever groups, sums are those over the faces one by one.
#[test]
fn parts_add_up_to_the_sum_over_faces() {
    let rules = rules("lambda:lambda=0.39");
    let mut mesh = shapes::fan(12);
    (0..3).for_each(|_| mesh = refined(&mesh, &rules));
    let space = space(&mesh, &rules, Ends::Open);
    assert!(space.cells.len() > 3000);
    let tables = space.tables(4, Depth::Area, false);
    let forms = [Form::Mass, Form::Stiffness];
    let integrands = Integrands {
        forms: &forms,
        load: Some(&|at: &Geometry| at.x[0]),
    };
    let mut entries = vec![BTreeMap::<(u32, u32), f64>::new(); 2];
    let mut right = vec![0.0; space.positions.len()];
    let (mut room, mut local) = (Room::default(), Local::default());
    for face in 0..space.cells.len() {
        integrands
            .local(&space, &tables, face, &mut room, &mut local)
            .expect("a regular map");
        let width = local.ids.len();
        for (i, &row) in local.ids.iter().enumerate() {
            right[row as usize] += local.sums.load[i];
            for (j, &column) in local.ids.iter().enumerate() {
                for (entries, matrix) in entries.iter_mut().zip(&local.sums.matrices) {
                    *entries.entry((row, column)).or_default() += matrix[i * width + j];
                }
            }
        }
    }
    for group in [1, 2, 100] {
        let (matrices, load) = assemble_by(group, &space, &tables, integrands).expect("matrices");
        let close = |a: f64, b: f64| (a - b).abs() < 1e-14;
        assert!(load.iter().zip(&right).all(|(a, b)| close(*a, *b)));
        for (matrix, entries) in matrices.iter().zip(&entries) {
            assert_eq!(matrix.columns.len(), entries.len());
            let rows = (0..matrix.height() as u32).flat_map(|row| {
                matrix
                    .row(row as usize)
                    .map(move |(column, value)| ((row, column as u32), value))
            });
            for ((at, value), (place, expected)) in rows.zip(entries) {
                assert!(
                    at == *place && close(value, *expected),
                    "{at:?}: {value} for {expected}"
                );
            }
        }
    }
}

/// Nitsche's form is as well conditioned as the others, and what the two solvers leave is rounding and the
/// goal of the iteration.
#[test]
fn both_solvers_of_nitsches_form_leave_small_residuals() {
    let u = solution::named("mix").expect("a solution");
    for (n, scheme) in [(3, "catmull-clark"), (6, "lambda:lambda=0.25")] {
        let rules = rules(scheme);
        let mut meshes = vec![shapes::fan(n)];
        (0..3).for_each(|level| meshes.push(refined(&meshes[level], &rules)));
        let spaces: Vec<Space> = meshes.iter().map(|mesh| space(mesh, &rules, Ends::Open)).collect();
        let embeddings = (0..3).map(|k| embedding(&meshes[k], &spaces[k], &spaces[k + 1]).expect("a matrix"));
        let fine = &spaces[3];
        let load: &Load<'_> = &|at| {
            let [xx, _, yy] = at.exact(&u).hessian;
            -xx - yy
        };
        let tables = fine.tables(4, Depth::Area, false);
        let (mut matrices, mut right) = assemble(fine, &tables, &[Form::Stiffness], Some(load)).expect("matrices");
        let mut matrix = matrices.swap_remove(0);
        nitsche(fine, &mut matrix, &mut right, &u);
        let residual = |x: &[f64]| {
            let rest: Vec<f64> = right.iter().zip(matrix.times(x)).map(|(b, ax)| b - ax).collect();
            (dot(&rest, &rest) / dot(&right, &right)).sqrt()
        };
        let factored = matrix.clone().factor(None).expect("a factor").solve(&right);
        assert!(residual(&factored) < 1e-15, "{scheme}: {:e}", residual(&factored));
        let cycle = Multigrid::new(matrix.clone(), embeddings.collect(), false).expect("a cycle");
        let goals = Goals {
            residual: f64::INFINITY,
            reduction: 1e-12,
        };
        let (iterated, _) = cycle.solve(&right, goals).expect("a solution");
        assert!(residual(&iterated) < 1e-12, "{scheme}: {:e}", residual(&iterated));
        let largest = factored.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let off = factored.iter().zip(&iterated).map(|(a, b)| (a - b).abs());
        let off = off.fold(0.0, f64::max) / largest;
        assert!(off < 1e-9, "{scheme}: {off:e}");
    }
}

#[test]
fn second_derivatives_need_the_matrix_without_its_dominant_eigenvalue() {
    let (rules, u) = (rules("lambda:lambda=0.39"), solution::named("lin").expect("a solution"));
    let mut space = space(&shapes::fan(6), &rules, Ends::Open);
    let exact: Vec<f64> = space.positions.iter().map(|p| 1.0 + 2.0 * p[0] - 3.0 * p[1]).collect();
    let mut h2 = || {
        let tables = space.tables(6, Depth::Given(35), false);
        let error = errors(&space, &tables, &exact, &u).expect("norms")[0];
        space.around.values_mut().for_each(Around::forget_deflation);
        error
    };
    let (with, without) = (h2(), h2());
    assert!(with.h2 <= 1e-9, "{with:?}");
    assert!(without.h2 > 1e-3 && without.l2 <= 1e-12, "{without:?}");
}

/// A bicubic patch near the unit sphere has the operator of the sphere on functions of x and y:
/// `laplace u - 2 (x u_x + y u_y) - (x^2 u_xx + 2 xy u_xy + y^2 u_yy)`.
#[test]
fn the_laplacian_on_a_surface_bends_with_it() {
    // control points whose patch has the sphere's second-order contact at its middle
    let size = 1e-3;
    let side = |k: usize| size * (k as f64 - 1.5);
    let (sin, cos) = 0.6_f64.sin_cos();
    let points: Vec<[f64; 3]> = (0..16)
        .map(|k| {
            let (a, b) = (side(k % 4), side(k / 4));
            // blossoms of -(s^2 + t^2)/2: the square's coefficient is k^2 - 1/3 in units of the knots
            let height = 1.0 - 0.5 * (a * a + b * b - 2.0 / 3.0 * size * size);
            [a * cos + height * sin, b, height * cos - a * sin]
        })
        .collect();
    let jets = Jets::new(&[([0.5, 0.5], 1.0)], bicubic);
    let data: [Data; 16] = std::array::from_fn(|k| [0.0, points[k][0], points[k][1], points[k][2]]);
    let control = Control {
        values: data,
        derivatives: data,
    };
    let wanted = Wanted {
        coefficient: false,
        space: true,
        second: true,
    };
    let mut maps = Maps::default();
    jets.sums(&control, wanted, &mut maps);
    let map = maps.iter().next().expect("one point");
    let at = Geometry::new(&map, 1.0, false).expect("a regular point");
    for name in ["mix", "exp", "quadratic"] {
        let u = solution::named(name).expect("a solution");
        let found = at.exact(&u).hessian;
        let [x, y, _] = at.x;
        let v = u(x, y);
        let [xx, xy, yy] = v.hessian;
        let bent = 2.0 * (x * v.gradient[0] + y * v.gradient[1]) + x * x * xx + 2.0 * x * y * xy + y * y * yy;
        let expected = xx + yy - bent;
        assert!(
            (found[0] + found[2] - expected).abs() < 1e-9,
            "{name}: {found:?} for {expected}"
        );
    }
}

/// Eigenvalues 3 and -1.
#[test]
fn a_matrix_with_a_negative_eigenvalue_has_no_factor() {
    let matrix = Sparse::from_rows(&[vec![(0, 1.0), (1, 2.0)], vec![(0, 2.0), (1, 1.0)]], 2);
    assert!(matches!(matrix.factor(None), Err(Error::NotDefinite { unknowns: 2 })));
}
