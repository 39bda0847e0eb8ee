//! **Claim**: no status of a certificate contradicts what is true, whatever the scheme file. **Oracle**: the
//! independent model of scheme files. **Input**: generated files of six kinds, each built around a way in
//! which a certificate could believe too much: regular parts that are no splines, broken symmetries, special
//! stencils far out, equal eigenvalues with and without Jordan blocks, rounded weights, and weights of any
//! sort. The sequence of cases is fixed.

use crate::generated::kinds::{
    PLANTED, Tie, any_line, any_one_ring, any_stencil_file, any_stencils, any_weights, disturbances, disturbed,
    factored, factors, far, far_special, line_file, printed, rounding, tied, ties, tolerated,
};
use crate::generated::{self, File};
use eigenring_certify::{Check, Statement, Status, Witness};
use eigenring_tests::oracle::claims::{c1, checks, status};
use eigenring_tests::oracle::facts::{Facts, Truth};
use num_traits::Signed;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use std::panic::catch_unwind;

/// What the cases of one kind came to.
#[derive(Debug, Default)]
struct Tally {
    /// Cases for which facts could be found.
    known: usize,
    /// Cases that were certified and not refused.
    certified: usize,
    /// Cases whose C1 is proven, and truly not refuted by any fact.
    proven: usize,
    /// Statements that the facts decide.
    decided: usize,
    /// Contradictions, each with its file.
    wrong: Vec<String>,
}

/// Whether a file's certificate contradicts the facts, beyond what `also` demands.
fn judge(file: &File, also: &dyn Fn(&Facts, &[Check]) -> Option<String>, tally: &mut Tally) -> Option<String> {
    let text = file.text();
    let facts = Facts::new(&text, file.n).ok()?;
    tally.known += 1;
    let decided = |statement: &&Statement| facts.truth(statement.name()) != Truth::Open;
    tally.decided += Statement::ALL.iter().filter(decided).count();
    let checks = match catch_unwind(|| checks(&text, file.n)) {
        Ok(Ok(checks)) => checks,
        // what is refused is not claimed
        Ok(Err(_)) => return None,
        Err(_) => return Some("the certificate panics".into()),
    };
    tally.certified += 1;
    tally.proven += usize::from(c1(&checks) == Status::Proven);
    facts.contradicts(&checks).or_else(|| also(&facts, &checks))
}

/// Runs a fixed sequence of cases, all to the end, so that the message says how many fail; the first that
/// fails is made simpler.
fn examine<S: Strategy>(
    cases: usize,
    strategy: S,
    file: impl Fn(&S::Value) -> File,
    also: impl Fn(&Facts, &[Check]) -> Option<String>,
) -> Tally {
    /// Attempts to simplify; each costs a certificate.
    const STEPS: usize = 25;
    let config = Config {
        failure_persistence: None,
        ..Config::default()
    };
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let mut tally = Tally::default();
    // a longer search, by hand: EIGENRING_CASES=20 tries twenty times as many, of which these are the first
    let factor = std::env::var("EIGENRING_CASES")
        .ok()
        .and_then(|factor| factor.parse().ok());
    for _ in 0..cases * factor.unwrap_or(1) {
        let mut tree = strategy.new_tree(&mut runner).expect("the strategies reject nothing");
        let mut found = file(&tree.current());
        let Some(mut why) = judge(&found, &also, &mut tally) else {
            continue;
        };
        for _ in 0..if tally.wrong.is_empty() { STEPS } else { 0 } {
            if !tree.simplify() {
                break;
            }
            let simpler = file(&tree.current());
            match judge(&simpler, &also, &mut Tally::default()) {
                Some(still) => (found, why) = (simpler, still),
                None if tree.complicate() => {}
                None => break,
            }
        }
        tally.wrong.push(format!("N = {}: {why}\n{}", found.n, found.text()));
    }
    tally
}

/// Panics with the contradictions, the first of them with its file.
fn finish(tally: &Tally) {
    let Some(first) = tally.wrong.first() else {
        return;
    };
    let lines: Vec<&str> = tally
        .wrong
        .iter()
        .skip(1)
        .filter_map(|text| text.lines().next())
        .collect();
    panic!(
        "{} contradictions in {} cases:\n{first}\n{}",
        tally.wrong.len(),
        tally.known,
        lines.join("\n")
    );
}

fn nothing_else(_: &Facts, _: &[Check]) -> Option<String> {
    None
}

/// Every statement proven, then every one refuted: a list without any truth must be found out for most files
/// of a kind.
fn finds_lies(text: &str, n: usize) {
    let facts = Facts::new(text, n).unwrap();
    for name in Statement::ALL {
        let lie = match facts.truth(name.name()) {
            Truth::Holds => Check::refuted(name, Witness::new("planted")),
            Truth::Fails => Check::proven(name),
            Truth::Open => continue,
        };
        assert!(
            facts.contradicts(std::slice::from_ref(&lie)).is_some(),
            "{name}: {text}"
        );
    }
}

#[test]
fn lines_that_are_no_splines() {
    let tally = examine(50, any_line(), line_file, nothing_else);
    finish(&tally);
    assert!(tally.certified >= 25 && tally.decided >= 100, "{tally:?}");
}

#[test]
fn splines_in_factors_and_what_comes_near() {
    let tally = examine(24, factors(), factored, nothing_else);
    finish(&tally);
    assert!(tally.known >= 20, "{tally:?}");
}

/// Factors that are a spline's together stay decidable.
#[test]
fn splines_in_factors_are_decided() {
    for n in [3, 4, 5] {
        for (degree, passes) in [
            (3, generated::smoothings(n, 1, 0)),
            (5, generated::smoothings(n, 2, 0)),
            (2, generated::repeated_averaging(n, 0, 0)),
            (4, generated::repeated_averaging(n, 1, 0)),
        ] {
            let file = File { degree, n, passes };
            let facts = Facts::new(&file.text(), n).unwrap();
            assert_eq!(facts.degree(), Some(degree), "{}", file.text());
            finds_lies(&file.text(), n);
            let checks = checks(&file.text(), n).unwrap();
            assert_eq!(facts.contradicts(&checks), None);
            for name in ["row_sums", "hull", "dominant"] {
                assert_eq!(status(&checks, name), Status::Proven, "{n} {degree} {name}");
            }
            // order 3 at a triangle is the one that is defective
            assert!(c1(&checks) == Status::Proven || (n, degree) == (3, 2), "{n} {degree}");
        }
    }
}

#[test]
fn broken_symmetries() {
    let tally = examine(60, disturbances(), disturbed, nothing_else);
    finish(&tally);
    assert!(tally.certified >= 50 && tally.decided >= 200, "{tally:?}");
}

#[test]
fn special_stencils_far_out() {
    let tally = examine(30, far(), far_special, nothing_else);
    finish(&tally);
    assert!(tally.known >= 28 && tally.decided >= 100, "{tally:?}");
}

#[test]
fn equal_eigenvalues_of_second_order() {
    let (mut jordan, mut semisimple) = (0, 0);
    for lean in [0, 2] {
        let file = tied(&Tie { lean, ..PLANTED });
        let facts = Facts::new(&file.text(), file.n).unwrap();
        assert!(
            (facts.ratio.unwrap() - 1.0).abs() < 1e-6,
            "{}",
            facts.of("bounded_curvature").why
        );
        match facts.truth("bounded_curvature") {
            Truth::Fails => jordan += 1,
            Truth::Holds => semisimple += 1,
            Truth::Open => {}
        }
        finds_lies(&file.text(), file.n);
    }
    assert_eq!((jordan, semisimple), (1, 1));
    let tally = examine(60, ties(), tied, nothing_else);
    finish(&tally);
    assert!(tally.certified >= 55 && tally.proven >= 5, "{tally:?}");
}

#[test]
fn rounded_weights_are_not_refuted() {
    let not_refuted = |facts: &Facts, checks: &[Check]| {
        if facts.local.defect > tolerated() {
            return None;
        }
        let refuted = status(checks, "row_sums") == Status::Refuted;
        let twice = c1(checks) == Status::Refuted && facts.truth("c1") != Truth::Fails;
        (refuted || twice).then(|| format!("refuted because rows miss 1 by {}", facts.local.defect))
    };
    let tally = examine(40, rounding(), printed, not_refuted);
    finish(&tally);
    // every file must be read
    assert_eq!(tally.certified, tally.known, "{tally:?}");
}

#[test]
fn any_one_ring_weights() {
    let tally = examine(30, any_weights(), any_one_ring, nothing_else);
    finish(&tally);
    assert!(tally.certified == tally.known && tally.decided >= 120, "{tally:?}");
}

#[test]
fn any_stencils_near_the_centre() {
    let tally = examine(24, any_stencils(), any_stencil_file, nothing_else);
    finish(&tally);
    assert!(tally.certified >= 20 && tally.decided >= 80, "{tally:?}");
}

#[test]
fn each_kind_finds_lies() {
    let files = [
        line_file(&(5, 3, [4, 4, 0], true, false)),
        factored(&(5, false, 2, 5, 1, 0)),
        factored(&(5, false, 1, 3, 0, 2)),
        disturbed(&(5, 0, 0, [1, 0, 0, 0, 0, 0, 0, 0])),
        disturbed(&(5, 2, 3, [0; 8])),
        far_special(&(4, 6, 0, 10, false, false)),
        tied(&Tie {
            in_two: true,
            lean: 2,
            ..PLANTED
        }),
        printed(&(6, 0, 1, 14)),
        any_one_ring(&(5, [4, 4, 1, 1, 5, 1, 6], false)),
    ];
    for file in files {
        let facts = Facts::new(&file.text(), file.n).unwrap();
        finds_lies(&file.text(), file.n);
        // where nothing is a spline nothing is proven of patches
        assert!(facts.has_patches() || facts.contradicts(&[Check::proven(Statement::Regular)]).is_some());
        assert!(!facts.local.defect.is_negative());
    }
    // a runner that finds nothing wrong with a certificate for another scheme would be no test
    let lies = |_: &Facts, _: &[Check]| Some("planted".to_owned());
    assert_eq!(examine(2, any_weights(), any_one_ring, lies).wrong.len(), 2);
}
