//! What certificates must say of known schemes, one by one and over ranges of lambda.

use crate::common::{of_spec, status};
use eigenring_certify::range::{Limits, StencilCurve, prove_range, recheck_range};
use eigenring_certify::{Input, Requirement, Statement, Status, certify, recheck};
use eigenring_scheme::lambda::{LambdaTable, Relaxation};
use eigenring_scheme::user::Reading;

#[test]
fn catmull_clark_is_c1_and_its_curvature_is_what_is_known() {
    for valence in 3..=64 {
        let certificate = of_spec("catmull-clark", valence);
        assert_eq!(
            Requirement::C1.verdict(&certificate.checks),
            (true, Status::Proven),
            "{valence}"
        );
        assert_eq!(
            Requirement::Hull.verdict(&certificate.checks),
            (true, Status::Proven),
            "{valence}"
        );
        let bounded = certificate.check(Statement::BoundedCurvature).unwrap();
        let ratio = bounded.enclosure.unwrap();
        let expected = if valence <= 4 { Status::Proven } else { Status::Refuted };
        assert_eq!(bounded.status, expected, "{valence}");
        match valence {
            3 => assert!((ratio.mid() - 0.991).abs() < 1e-3),
            4 => assert!(ratio.contains(1.0)),
            // Catmull-Clark at N = 5: 0.340107 / 0.549988^2
            5 => assert!((ratio.mid() - 0.340107 / 0.549988_f64.powi(2)).abs() < 1e-5),
            _ => assert!(ratio.lo() > 1.0),
        }
        let degenerate = if valence == 4 { Status::Proven } else { Status::Refuted };
        assert_eq!(status(&certificate, Statement::NonDegenerate), degenerate, "{valence}");
        if valence % 7 == 0 {
            assert!(recheck(&certificate).unwrap().confirmed());
        }
    }
}

#[test]
fn tabulated_optima_are_c1_and_bounded_exactly_where_s_is_one() {
    for valence in LambdaTable::embedded().unwrap().valences() {
        let certificate = of_spec("lambda:optimal", valence);
        let entry = LambdaTable::embedded().unwrap().entry(valence).unwrap();
        assert_eq!(
            Requirement::C1.verdict(&certificate.checks),
            (true, Status::Proven),
            "{valence}"
        );
        let s = Relaxation::new(valence).unwrap().s(entry.lambda_optimal).unwrap();
        let bounded = certificate.check(Statement::BoundedCurvature).unwrap();
        if s == 1.0 {
            assert_eq!(bounded.status, Status::Proven, "{valence}");
            assert_eq!(status(&certificate, Statement::NonDegenerate), Status::Proven);
            assert_eq!(
                Requirement::Strict.verdict(&certificate.checks),
                (true, Status::Proven),
                "{valence}"
            );
        } else {
            // mu = s lambda^2
            assert_eq!(bounded.status, Status::Refuted, "{valence}");
            assert!(bounded.enclosure.unwrap().contains(s) && bounded.enclosure.unwrap().width() < 1e-12);
            assert!(entry.lambda_optimal < entry.lambda_l + 1e-2);
        }
    }
}

#[test]
fn dual_and_two_ring_schemes_are_proven_c1() {
    for spec in [
        "doo-sabin",
        "tension:order=5",
        "tension:order=6",
        "tension:order=4,u0=0.3",
    ] {
        for valence in [3, 4, 5, 7] {
            let certificate = of_spec(spec, valence);
            assert_eq!(
                Requirement::C1.verdict(&certificate.checks),
                (true, Status::Proven),
                "{spec} {valence}"
            );
            assert!(recheck(&certificate).unwrap().confirmed(), "{spec} {valence}");
        }
    }
}

/// Far from 1 and near to it, the levels beyond the leading ones included.
#[test]
fn levels_of_any_tension_carry_c1_over() {
    for (spec, valence) in [
        ("tension:order=4,u0=-0.9", 3),
        ("tension:order=5,u0=50", 3),
        ("tension:order=6,u0=1e100", 6),
        ("tension:order=4,u0=0.9999999999999999", 5),
    ] {
        let certificate = of_spec(spec, valence);
        for name in [Statement::RowSums, Statement::Levels] {
            assert_eq!(status(&certificate, name), Status::Proven, "{spec} {valence} {name}");
        }
        let hull = if spec.contains("u0=-") {
            Status::Refuted
        } else {
            Status::Proven
        };
        assert_eq!(status(&certificate, Statement::Hull), hull, "{spec} {valence}");
    }
}

#[test]
fn ranges_agree_with_single_certificates() {
    for (valence, range) in [
        (3, [0.4, 0.44]),
        (4, [0.48, 0.52]),
        (5, [0.55, 0.58]),
        (8, [0.40, 0.44]),
        (9, [0.48, 0.52]),
        (20, [0.86, 0.885]),
    ] {
        let certificate = prove_range(
            valence,
            StencilCurve::embedded(valence).unwrap(),
            range,
            Limits::default(),
        )
        .unwrap();
        assert!(recheck_range(&certificate).unwrap().confirmed(), "{valence}");
        let status_at = |check: Statement, lambda: f64| {
            let segments = certificate.segments(check);
            segments
                .iter()
                .find(|s| s.lambda[0] <= lambda && lambda <= s.lambda[1])
                .unwrap()
                .status
        };
        assert!(
            certificate
                .required(Requirement::C1)
                .iter()
                .all(|s| s.status == Status::Proven),
            "{valence}"
        );
        for step in 0..=6 {
            let lambda = range[0] + (range[1] - range[0]) * (0.03 + 0.15 * f64::from(step));
            let single = of_spec(&format!("lambda:lambda={lambda}"), valence);
            for check in [
                Statement::Dominant,
                Statement::Subdominant,
                Statement::Regular,
                Statement::Injective,
                Statement::BoundedCurvature,
                Statement::Strict,
            ] {
                let (whole, one) = (status_at(check, lambda), status(&single, check));
                assert!(
                    whole == one || whole == Status::Undecided,
                    "{valence} {lambda} {check}: {whole} {one}"
                );
            }
        }
        // undecided pieces are slivers
        for requirement in [Requirement::C1, Requirement::Bounded] {
            let open: f64 = certificate
                .required(requirement)
                .iter()
                .filter(|s| s.status == Status::Undecided)
                .map(|s| s.lambda[1] - s.lambda[0])
                .sum();
            assert!(open < 1e-6, "{valence}: {open}");
        }
        // no gap, and no false claim
        let mut forged = certificate.clone();
        for tiles in forged.tiles.values_mut() {
            tiles.remove(0);
        }
        assert!(!recheck_range(&forged).unwrap().covered);
        let mut forged = certificate.clone();
        for tile in forged.tiles.values_mut().flatten() {
            tile.statuses.iter_mut().for_each(|s| *s = Status::Proven);
        }
        forged.digest = forged.content_digest();
        let all_proven = certificate
            .tiles
            .values()
            .flatten()
            .all(|t| t.statuses.iter().all(|s| *s == Status::Proven));
        assert_eq!(recheck_range(&forged).unwrap().confirmed(), all_proven);
    }
}

/// Catmull-Clark's stencils listed for every sector, of which edge point 0 keeps a little more of its own.
fn uneven_catmull_clark(n: usize, more: i64) -> Input {
    let mut text = format!(
        "kind = \"stencils\"\nname = \"uneven\"\n[[valence]]\nn = {n}\n[[valence.pass]]\nfrom = \"vertex\"\nto = \"vertex\"\n\
         line = [[[-4, \"1/8\"], [0, \"3/4\"], [4, \"1/8\"]], [[-2, \"1/2\"], [2, \"1/2\"]]]\n"
    );
    let own = 4 * n * n - 7 * n;
    text += &format!(
        "[[valence.pass.special]]\nat = [0, 0]\nstencil = [{{ at = [0, 0], weight = \"{own}/{}\" }}, \
         {{ at = [2, 0], sector = \"all\", weight = \"3/{}\" }}, {{ at = [2, 2], sector = \"all\", weight = \"1/{}\" }}]\n",
        4 * n * n,
        2 * n * n,
        4 * n * n
    );
    for sector in 0..n {
        let (before, after) = ((sector + n - 1) % n, (sector + 1) % n);
        let change = if sector == 0 { more } else { 0 };
        text += &format!(
            "[[valence.pass.special]]\nat = [2, 0]\nsector = {sector}\nstencil = [\
             {{ at = [0, 0], weight = \"{}/80000\" }}, {{ at = [2, 0], sector = {sector}, weight = \"{}/80000\" }}, \
             {{ at = [2, 0], sector = {before}, weight = \"1/16\" }}, {{ at = [2, 0], sector = {after}, weight = \"1/16\" }}, \
             {{ at = [2, 2], sector = {before}, weight = \"1/16\" }}, {{ at = [2, 2], sector = {sector}, weight = \"1/16\" }}]\n",
            30000 - change,
            30000 + change
        );
    }
    Input::Toml {
        text,
        name: "uneven".into(),
        reading: Reading::Balanced,
        parameters: Default::default(),
    }
}

#[test]
fn sectors_that_differ_are_proven_by_the_undivided_matrix() {
    for n in [3, 5, 8, 32] {
        let certificate = certify(uneven_catmull_clark(n, 400), n).unwrap();
        let verdict = Requirement::C1.verdict(&certificate.checks);
        assert_eq!(verdict, (true, Status::Proven), "{n}: {:?}", certificate.checks);
        // as of Catmull-Clark: .991 lambda^2 at three sectors, more than the larger square from five on
        let curvature = if n == 3 { Status::Proven } else { Status::Refuted };
        assert_eq!(status(&certificate, Statement::BoundedCurvature), curvature, "{n}");
        assert!(recheck(&certificate).unwrap().confirmed());
        // evidence for fewer patches than there are proves nothing
        let mut forged = certificate.clone();
        if let Some(eigenring_certify::map::JacobianEvidence::Sign { patches, .. }) = &mut forged.evidence.jacobian {
            patches.truncate(12);
        }
        assert!(!recheck(&forged).unwrap().confirmed());
    }
    // without the change all sectors are alike, and it is Catmull-Clark
    let certificate = certify(uneven_catmull_clark(5, 0), 5).unwrap();
    assert_eq!(Requirement::C1.verdict(&certificate.checks), (true, Status::Proven));
    assert_eq!(status(&certificate, Statement::BoundedCurvature), Status::Refuted);
}
