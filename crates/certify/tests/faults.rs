//! What certificates must say of planted faults: statements that are nearly true, missing evidence.

use crate::common::{altered, of_spec, one_ring, status, witness};
use eigenring_certify::range::{Limits, StencilCurve, prove_range};
use eigenring_certify::{Input, Requirement, Statement, Status, certify};
use eigenring_scheme::OneRing;
use eigenring_scheme::families::catmull_clark_weights;
use eigenring_scheme::lambda::{Bounds, Domain, LambdaTable, Relaxation};
use eigenring_scheme::user::Reading;

#[test]
fn an_optimum_on_the_boundary_is_not_called_strict() {
    // g3 = -mu at the end of the range of f3, for even valences (Ma, Wang and Ma 2023, Eq. 49)
    for (valence, lambda) in [(6, 0.39), (8, 0.5), (12, 0.75)] {
        let plane = Relaxation::new(valence).unwrap().plane(lambda).unwrap();
        assert_eq!(plane.s, 1.0);
        let boundary = |margin: f64| {
            let domain = Domain::new(plane, Bounds::Paper, margin).unwrap();
            let f3 = domain.f3_range()[1].f3;
            let f2 = domain.f2_intervals(f3)[0];
            let f2 = 0.5 * (f2.lower.f2 + f2.upper.f2);
            let input = Input::Lambda {
                lambda,
                s: 1.0,
                f2,
                f3: Some(f3),
            };
            certify(input, valence).unwrap()
        };
        assert_ne!(status(&boundary(0.0), Statement::Strict), Status::Proven, "{valence}");
        assert_eq!(status(&boundary(1e-6), Statement::Strict), Status::Proven, "{valence}");
        // the margin that is found is the one that was kept
        let margin = boundary(1e-6).check(Statement::Strict).unwrap().margin.unwrap();
        assert!(margin > 0.99e-6 && margin < 1.01e-6, "{margin}");
    }
}

#[test]
fn a_jordan_block_of_lambda_is_not_certified() {
    let certificate = of_spec("tension:order=3", 3);
    let subdominant = certificate.check(Statement::Subdominant).unwrap();
    // the criterion does not apply; normals of the surface do converge, like 1/m over the rings m
    assert_eq!(subdominant.status, Status::Undecided);
    assert!(subdominant.reached.as_ref().unwrap().contains("repeated"));
    assert_eq!(Requirement::C1.verdict(&certificate.checks), (false, Status::Undecided));
    // other valences are fine
    assert_eq!(
        Requirement::C1.verdict(&of_spec("tension:order=3", 5).checks),
        (true, Status::Proven)
    );
}

#[test]
fn a_row_sum_off_by_a_billionth_is_refuted() {
    let certificate = certify(altered(&[("f1", "250000001/1000000000")]), 5).unwrap();
    let check = certificate.check(Statement::RowSums).unwrap();
    assert_eq!(check.status, Status::Refuted);
    assert!(check.enclosure.unwrap().contains(1e-9) && witness(check).contains("sum to 1 + "));
    assert_eq!(status(&certificate, Statement::Dominant), Status::Undecided);
}

#[test]
fn a_negative_subdominant_eigenvalue_is_refuted() {
    // the E row alone makes d2 + 2 e1 cos(2 pi k/5) in block k != 0: -.46 at k = 1, less in modulus elsewhere
    let leading = [
        ("d1", "8/5"),
        ("d2", "-2/5"),
        ("e1", "-1/10"),
        ("e2", "0"),
        ("f2", "0"),
        ("f3", "1/8"),
        ("f1", "7/8"),
        ("alpha", "-1/4"),
    ];
    let certificate = certify(altered(&leading), 5).unwrap();
    let check = certificate.check(Statement::Subdominant).unwrap();
    assert_eq!(check.status, Status::Refuted, "{check:?}");
    assert!(witness(check).contains("not positive"), "{}", witness(check));
    assert_eq!(status(&certificate, Statement::RowSums), Status::Proven);
    assert_eq!(status(&certificate, Statement::Hull), Status::Refuted);
    // without e1 it is the same in all blocks, and no theorem applies
    let mut tied = leading;
    (tied[0].1, tied[1].1, tied[2].1) = ("3/2", "-1/2", "0");
    let certificate = certify(altered(&tied), 5).unwrap();
    assert_eq!(status(&certificate, Statement::Subdominant), Status::Undecided);
}

#[test]
fn a_subdominant_pair_of_index_two_is_refuted() {
    // d2 + 2 e1 cos(2 pi k/5) with a negative e1 is largest at k = 2
    let changes = [
        ("d1", "7/10"),
        ("d2", "1/2"),
        ("e1", "-1/10"),
        ("e2", "0"),
        ("f2", "0"),
        ("f3", "1/8"),
        ("f1", "7/8"),
    ];
    let certificate = certify(altered(&changes), 5).unwrap();
    let check = certificate.check(Statement::Subdominant).unwrap();
    assert_eq!(check.status, Status::Refuted);
    assert!(witness(check).contains("block 2"), "{}", witness(check));
    let fourier = check.witness.as_ref().unwrap().data["fourier"];
    assert!(fourier.contains(2.0));
}

#[test]
fn a_complex_subdominant_pair_is_left_open() {
    // block 1 at N = 4: [[d2, e2 (1 - i)], [f2 (1 + i), f3]] with e2 f2 < 0
    let weights = [
        ("f1", "0"),
        ("f2", "1/4"),
        ("f3", "1/2"),
        ("d1", "1"),
        ("d2", "1/2"),
        ("e1", "0"),
        ("e2", "-1/4"),
        ("alpha", "3/8"),
        ("beta", "1/16"),
    ];
    let certificate = certify(one_ring(4, &weights), 4).unwrap();
    // no theorem says that the surface is not C1
    let check = certificate.check(Statement::Subdominant).unwrap();
    assert_eq!(check.status, Status::Undecided);
    assert!(check.reached.as_ref().unwrap().contains(" i"), "{check:?}");
}

#[test]
fn lambda_squared_missed_by_a_millionth_is_refuted_and_met_is_proven() {
    // bicubic B-splines have mu = lambda^2 exactly; f3 moves one of the saddles
    let regular = |f3: &str, f1: &str| {
        let weights = [
            ("f1", f1),
            ("f2", "1/4"),
            ("f3", f3),
            ("d1", "3/8"),
            ("d2", "3/8"),
            ("e1", "1/16"),
            ("e2", "1/16"),
            ("alpha", "3/8"),
            ("beta", "1/16"),
        ];
        certify(one_ring(4, &weights), 4).unwrap()
    };
    let exact = regular("1/4", "1/4");
    assert_eq!(status(&exact, Statement::BoundedCurvature), Status::Proven);
    assert_eq!(status(&exact, Statement::NonDegenerate), Status::Proven);
    assert_eq!(status(&exact, Statement::Strict), Status::Proven);
    let missed = regular("250001/1000000", "249999/1000000");
    assert_eq!(status(&missed, Statement::NonDegenerate), Status::Refuted);
    assert_eq!(status(&missed, Statement::BoundedCurvature), Status::Refuted);
    // relaxed by a millionth
    let entry = LambdaTable::embedded().unwrap().entry(6).unwrap();
    let (f2, f3) = entry.optimal().unwrap();
    let input = |s: f64| Input::Lambda {
        lambda: entry.lambda_optimal,
        s,
        f2,
        f3: Some(f3),
    };
    assert_eq!(
        status(&certify(input(1.0), 6).unwrap(), Statement::BoundedCurvature),
        Status::Proven
    );
    let check = certify(input(1.0 + 1e-6), 6).unwrap();
    let check = check.check(Statement::BoundedCurvature).unwrap();
    assert_eq!(check.status, Status::Refuted);
    assert!(check.witness.as_ref().unwrap().data["ratio"].contains(1.0 + 1e-6));
}

#[test]
fn doubles_are_numerical_and_their_defect_is_reported() {
    let weights: OneRing<f64> = catmull_clark_weights(7);
    let certificate = certify(Input::floating(weights), 7).unwrap();
    for name in [
        Statement::RowSums,
        Statement::Dominant,
        Statement::Subdominant,
        Statement::Regular,
        Statement::Injective,
    ] {
        let check = certificate.check(name).unwrap();
        assert_eq!(check.status, Status::Numerical, "{name}");
        assert!(check.holds && !check.rigorous);
    }
    assert_eq!(Requirement::C1.verdict(&certificate.checks), (true, Status::Numerical));
    assert!(certificate.check(Statement::RowSums).unwrap().enclosure.unwrap().mag() < 1e-15);
    assert_eq!(status(&certificate, Statement::BoundedCurvature), Status::Refuted);
    let off = OneRing {
        f1: weights.f1 + 1e-9,
        ..weights
    };
    let certificate = certify(Input::floating(off), 7).unwrap();
    assert_eq!(status(&certificate, Statement::RowSums), Status::Refuted);
    let bad = OneRing {
        beta: f64::NAN,
        ..weights
    };
    assert!(certify(Input::floating(bad), 7).is_err());
}

#[test]
fn rules_without_symmetry_are_left_open_and_not_guessed() {
    // one lopsided corner weight: symmetric under rotation, not under reflection
    let text = "kind = \"stencils\"\nname = \"twisted\"\ndegree = 2\n[[valence]]\nn = 5\n[[valence.pass]]\nfrom = \"face\"\nto = \"face\"\nline = [[[1, \"3/4\"], [-3, \"1/4\"]], [[-1, \"3/4\"], [3, \"1/4\"]]]\n[[valence.pass.special]]\nat = [1, 1]\nstencil = [\n{ at = [1, 1], weight = \"1/2\" },\n{ at = [1, 1], sector = 1, weight = \"1/3\" },\n{ at = [1, 1], sector = -1, weight = \"1/6\" },\n]\n";
    let certificate = certify(
        Input::Toml {
            text: text.into(),
            name: "x".into(),
            reading: Reading::Balanced,
            parameters: Default::default(),
        },
        5,
    )
    .unwrap();
    assert_eq!(status(&certificate, Statement::RowSums), Status::Proven);
    assert_eq!(status(&certificate, Statement::Dominant), Status::Proven);
    assert_eq!(status(&certificate, Statement::Subdominant), Status::Undecided);
    // and different rules in one sector
    let head = text.split("[[valence.pass.special]]").next().unwrap();
    let corner = |sector: usize| {
        let own = if sector == 2 {
            ["1", "0", "0"]
        } else {
            ["1/2", "1/4", "1/4"]
        };
        let terms = [0, 1, 4].map(|by| (sector + by) % 5);
        let terms: String = terms
            .iter()
            .zip(own)
            .map(|(at, weight)| format!("{{ at = [1, 1], sector = {at}, weight = \"{weight}\" }},\n"))
            .collect();
        format!("[[valence.pass.special]]\nat = [1, 1]\nsector = {sector}\nstencil = [\n{terms}]\n")
    };
    let uneven: String = std::iter::once(head.to_owned()).chain((0..5).map(corner)).collect();
    let certificate = certify(
        Input::Toml {
            text: uneven,
            name: "x".into(),
            reading: Reading::Balanced,
            parameters: Default::default(),
        },
        5,
    )
    .unwrap();
    assert_eq!(status(&certificate, Statement::RowSums), Status::Proven);
    // without blocks the pair is one of two different eigenvalues, and all others are below their squares
    let pair = certificate.check(Statement::Subdominant).unwrap();
    assert!(pair.status == Status::Proven && pair.reached.as_ref().unwrap().contains("different eigenvalues"));
    assert_eq!(status(&certificate, Statement::BoundedCurvature), Status::Proven);
    assert_eq!(status(&certificate, Statement::Strict), Status::Undecided);
}

/// Without evidence for the second-order blocks their largest eigenvalues are only bounded. What is then
/// claimed of mu must not be what holds for some smaller eigenvalue that happens to be enclosed.
#[test]
fn a_hidden_second_order_eigenvalue_is_not_passed_over() {
    let mut opened = 0;
    for (spec, valence) in [("tension:order=6", 5), ("tension:order=5", 6), ("tension:order=6", 4)] {
        let input = Input::from_spec(&spec.parse().unwrap(), valence).unwrap();
        let honest = certify(input.clone(), valence).unwrap();
        for hidden in [0, 2] {
            let mut evidence = honest.evidence.clone();
            for peel in &mut evidence.spectrum[hidden] {
                *peel = Default::default();
            }
            for check in eigenring_certify::check(&input, valence, &evidence).unwrap() {
                let before = honest.check(check.name).map_or(Status::Undecided, |check| check.status);
                let weaker = check.status == before || check.status == Status::Undecided;
                assert!(
                    weaker,
                    "{spec} {valence}: {} was {before}, is {}",
                    check.name, check.status
                );
                opened += usize::from(check.name == Statement::Strict && check.status != before);
            }
        }
    }
    // small components need no evidence; the others do
    assert!(opened >= 3, "{opened}");
}

#[test]
fn a_curve_that_leaves_the_domain_is_refuted_where_it_does() {
    // constant weights: f3 beyond g3 = -mu for small lambda
    let curve = StencilCurve::Constant { f2: 0.3, f3: 0.12 };
    let certificate = prove_range(8, curve, [0.45, 0.8], Limits::default()).unwrap();
    let strict = certificate.segments(Statement::Strict);
    assert!(strict.iter().any(|s| s.status == Status::Proven) && strict.iter().any(|s| s.status == Status::Refuted));
    for segment in strict.iter().filter(|s| s.status == Status::Refuted) {
        let lambda = 0.5 * (segment.lambda[0] + segment.lambda[1]);
        let s = Relaxation::new(8).unwrap().s(lambda).unwrap();
        let single = certify(
            Input::Lambda {
                lambda,
                s,
                f2: 0.3,
                f3: Some(0.12),
            },
            8,
        )
        .unwrap();
        let single = [Statement::Subdominant, Statement::Strict].map(|check| status(&single, check));
        assert!(
            single[0] != Status::Proven || single[1] == Status::Refuted,
            "{lambda}: {single:?}"
        );
        assert!(segment.witness.as_ref().unwrap().data["lambda"].contains(lambda));
    }
}
