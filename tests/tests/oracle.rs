//! **Claim**: the independent model of scheme files says what is true of schemes that are known, and finds a
//! false status. **Oracle**: closed forms (Peters and Reif 2008, 6.2; Doo and Sabin 1978), and the numbers of
//! an older program in another language, dense eigenvectors and 9 x 9 samples of the Jacobian on each patch,
//! in `JACOBIANS`.

use eigenring_certify::{Check, Status, Witness};
use eigenring_tests::Comparison;
use eigenring_tests::oracle::claims::{c1, checks, status};
use eigenring_tests::oracle::facts::{Facts, Truth};
use eigenring_tests::oracle::local::Local;
use eigenring_tests::oracle::model::Model;
use eigenring_tests::oracle::regular::{self, Regular};
use eigenring_tests::oracle::spline::{At, Patch, control, evaluate, patches};

fn case(name: &str) -> String {
    let path = format!("{}/data/cases/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("the cases are committed")
}

/// Catmull-Clark as a one-ring file.
fn catmull_clark(n: usize) -> String {
    format!(
        "kind = \"one-ring\"\n[[valence]]\nn = {n}\nf1 = 0.25\nf2 = 0.25\nf3 = 0.25\nd1 = 0.375\nd2 = 0.375\ne1 = 0.0625\ne2 = 0.0625\n\
         alpha = \"3/{}\"\nbeta = \"1/{}\"\n",
        2 * n,
        4 * n
    )
}

/// Doo-Sabin at a valence where its cosines are rational, `twice[i] = 2 cos(2 pi i/n)`.
fn doo_sabin(n: usize, twice: &[i64]) -> String {
    let weight = |i: usize| format!("{}/{}", if i == 0 { n as i64 + 5 } else { 3 + twice[i] }, 4 * n);
    let terms: String = (0..n)
        .map(|i| format!("{{ at = [1, 1], sector = {i}, weight = \"{}\" }}, ", weight(i)))
        .collect();
    format!(
        "kind = \"stencils\"\ndegree = 2\n[[valence]]\nn = {n}\n[[valence.pass]]\nfrom = \"face\"\nto = \"face\"\n\
         line = [[[1, 0.75], [-3, 0.25]], [[-1, 0.75], [3, 0.25]]]\n[[valence.pass.special]]\nat = [1, 1]\nstencil = [{terms}]\n"
    )
}

#[test]
fn catmull_clark_is_what_is_known() {
    let mut comparison = Comparison::new("subdominant eigenvalue", 1e-12);
    for n in 3..=8 {
        let facts = Facts::new(&catmull_clark(n), n).unwrap();
        assert_eq!(facts.local.regular, Regular::Spline(3));
        assert!(facts.local.rotation && facts.local.mirror);
        for name in [
            "row_sums",
            "hull",
            "dominant",
            "subdominant",
            "regular",
            "injective",
            "corner",
            "c1",
        ] {
            assert_eq!(facts.truth(name), Truth::Holds, "{n} {name}: {}", facts.of(name).why);
        }
        let c = (std::f64::consts::TAU / n as f64).cos();
        comparison.check(n, facts.radius(), (c + 5.0 + ((c + 9.0) * (c + 1.0)).sqrt()) / 16.0);
        let bounded = if n <= 4 { Truth::Holds } else { Truth::Fails };
        assert_eq!(facts.truth("bounded_curvature"), bounded, "{n}");
        let degenerate = if n == 4 { Truth::Holds } else { Truth::Fails };
        assert_eq!(facts.truth("non_degenerate"), degenerate, "{n}");
        // 1/8 of the next ring comes close to the third second-order value at valence 3, and stays below
        assert_eq!(facts.truth("strict"), Truth::Holds, "{n}: {}", facts.of("strict").why);
    }
    comparison.finish();
}

#[test]
fn doo_sabin_is_what_is_known() {
    for (n, twice) in [
        (3, vec![2, -1, -1]),
        (4, vec![2, 0, -2, 0]),
        (6, vec![2, 1, -1, -2, -1, 1]),
    ] {
        let facts = Facts::new(&doo_sabin(n, &twice), n).unwrap();
        assert_eq!(facts.local.regular, Regular::Spline(2));
        assert!((facts.radius() - 0.5).abs() < 1e-12);
        for name in [
            "row_sums",
            "hull",
            "dominant",
            "subdominant",
            "regular",
            "injective",
            "c1",
        ] {
            assert_eq!(facts.truth(name), Truth::Holds, "{n} {name}: {}", facts.of(name).why);
        }
        // biquadratic B-splines have quadratic polynomials
        assert!(n != 4 || facts.truth("bounded_curvature") == Truth::Holds);
    }
}

/// File, valence, smallest and largest Jacobian as parts of the largest modulus.
const JACOBIANS: [(&str, usize, [f64; 2]); 6] = [
    ("lopsided-centre-n5", 5, [-0.10009622771882973, 1.0]),
    ("peters_reif5", 5, [0.7526663067013455, 1.0]),
    ("dietzx5", 5, [0.9263067093339798, 1.0]),
    ("jordan-one-ring-n4", 4, [0.8272848380431496, 1.0]),
    ("centre-not-read-twin-n4", 4, [0.40225095165867, 1.0]),
    ("doosabin5_decimal", 5, [0.8830522239483041, 1.0]),
];

#[test]
fn jacobians_are_those_of_the_older_program() {
    let mut comparison = Comparison::new("Jacobians", 1e-9);
    for (name, n, expected) in JACOBIANS {
        let found = Facts::new(&case(name), n).unwrap().jacobian.expect("a leading pair");
        // the orientation is the eigenvector's own
        let found = if found[1] < 1.0 { [-found[1], -found[0]] } else { found };
        (0..2).for_each(|i| comparison.check(format!("{name} {i}"), found[i], expected[i]));
    }
    comparison.finish();
}

#[test]
fn eigenvalues_of_blocks_are_those_of_the_whole() {
    // the symmetric functions of a cluster are accurate where its members are not: compare sums of powers
    let mut comparison = Comparison::new("traces of powers", 1e-11);
    let files = [
        (catmull_clark(5), 5),
        (case("zs3_5"), 5),
        (case("far-special-eigenvalue-one-n5"), 5),
        (doo_sabin(3, &[2, -1, -1]), 3),
    ];
    for (text, n) in files {
        let local = Local::new(Model::parse(&text, n).unwrap()).unwrap();
        let whole = local.whole().values;
        let divided: Vec<_> = local
            .blocks()
            .into_iter()
            .map(|block| (block.values, block.copies as f64))
            .collect();
        for power in 1..=6 {
            let all: f64 = whole.iter().map(|value| value.powi(power).re).sum();
            let blocks: f64 = divided
                .iter()
                .map(|(values, copies)| copies * values.iter().map(|v| v.powi(power).re).sum::<f64>())
                .sum();
            comparison.check(format!("{n} {power}"), blocks, all);
        }
    }
    comparison.finish();
}

/// Refining the net and evaluating the refined patch gives the same surface.
#[test]
fn patches_are_limits_of_refinement() {
    let mut comparison = Comparison::new("points of patches", 1e-13);
    for (text, n) in [
        (catmull_clark(5), 5),
        (case("zs3_5"), 5),
        (case("far-special-eigenvalue-one-n5"), 5),
        (doo_sabin(3, &[2, -1, -1]), 3),
    ] {
        let local = Local::new(Model::parse(&text, n).unwrap()).unwrap();
        let Regular::Spline(degree) = local.regular else {
            panic!("a spline")
        };
        let values: Vec<[f64; 1]> = (0..local.points.len()).map(|i| [(i as f64 * 1.3).cos()]).collect();
        for patch in patches(&local, 2).into_iter().filter(|patch| patch.sector == 1) {
            let (i, j) = (patch.p % 2, (patch.q + 1) % 2);
            let fine = Patch {
                p: 2 * patch.p + i,
                q: 2 * patch.q + j,
                ..patch
            };
            let half = degree as i64 / 2;
            let mut refined = Vec::new();
            for b in fine.q - half..=fine.q - half + degree as i64 {
                for a in fine.p - half..=fine.p - half + degree as i64 {
                    let (x, y) = (2 * a + local.model.parity, 2 * b + local.model.parity);
                    let row = local.model.row(local.model.fold(1, x, y).unwrap()).unwrap();
                    let value = |(point, weight): (&_, &_)| {
                        eigenring_tests::oracle::number::double(weight) * values[local.index[point]][0]
                    };
                    refined.push([row.iter().map(value).sum::<f64>()]);
                }
            }
            let places: Vec<usize> = (0..refined.len()).collect();
            let at = |t: f64| At::new(degree, t);
            let (u, v) = (at((i as f64 + 0.3) / 2.0), at((j as f64 + 0.8) / 2.0));
            let coarse = evaluate(&control(&local, degree, patch), &values, &u, &v);
            let found = evaluate(&places, &refined, &at(0.3), &at(0.8));
            comparison.check(format!("{n} {patch:?}"), found.value[0], coarse.value[0]);
        }
    }
    comparison.finish();
}

#[test]
fn points_fold_as_the_numbering_page_says() {
    let model = Model::parse(&catmull_clark(5), 5).unwrap();
    assert_eq!(model.fold(0, 2, -2), Some((4, 2, 2)));
    assert_eq!(model.fold(0, 0, 4), Some((1, 4, 0)));
    assert_eq!(model.fold(4, 0, 2), Some((0, 2, 0)));
    assert_eq!(model.fold(0, -2, -2), None);
    let regular = Model::parse(&catmull_clark(4), 4).unwrap();
    assert_eq!(regular.fold(0, -2, -4), Some((2, 2, 4)));
    for point in regular.ring(3) {
        assert_eq!(regular.reflected(regular.reflected(point)), point);
    }
}

#[test]
fn lines_are_told_apart() {
    let of = |name: &str, n: usize| regular::compose(&Model::parse(&case(name), n).unwrap());
    assert_eq!(regular::degree(&of("zs3_5", 5)), Some(4));
    assert_eq!(regular::degree(&of("bilinear5", 5)), Some(1));
    assert_eq!(regular::degree(&of("asymmetric-line-n5", 5)), None);
    assert_eq!(regular::degree(&of("fourpoint5", 5)), None);
    // second differences of bicubic data settle; those of the rule (1, 3, 1)/5 grow by 1.093 a level
    assert!((regular::growth(&of("dietzx5", 5)) - 1.0).abs() < 1e-2);
    assert!((regular::growth(&of("line-not-bicubic-n4", 4)) - 1.093).abs() < 2e-3);
}

/// Every status of a true certificate, turned round, is a contradiction wherever the facts are decided.
#[test]
fn a_false_status_is_found() {
    let mut found = 0;
    for n in [3, 4, 5, 8] {
        let text = catmull_clark(n);
        let (facts, truth) = (Facts::new(&text, n).unwrap(), checks(&text, n).unwrap());
        assert_eq!(facts.contradicts(&truth), None);
        for check in &truth {
            let turned = match check.status {
                Status::Proven => Check::refuted(check.name, Witness::new("planted")),
                _ => Check::proven(check.name),
            };
            let list: Vec<Check> = truth
                .iter()
                .map(|old| {
                    if old.name == check.name {
                        turned.clone()
                    } else {
                        old.clone()
                    }
                })
                .collect();
            let decided = facts.truth(check.name.name()) != Truth::Open;
            assert_eq!(facts.contradicts(&list).is_some(), decided, "{n} {}", check.name);
            found += usize::from(decided);
        }
    }
    assert!(found >= 36, "{found}");
}

/// A number beside a proof that is not the scheme's is a contradiction as well.
#[test]
fn a_false_number_is_found() {
    let (mine, other) = (catmull_clark(5), catmull_clark(6));
    let facts = Facts::new(&mine, 5).unwrap();
    let claimed = checks(&other, 6).unwrap();
    assert_eq!(
        (status(&claimed, "subdominant"), c1(&claimed)),
        (Status::Proven, Status::Proven)
    );
    let contradiction = facts.contradicts(&claimed).expect("lambda is another");
    assert!(contradiction.contains("enclosed in"), "{contradiction}");
}
