//! **Claim**: no status of a certificate contradicts what is true, whatever the scheme file. **Oracle**: the
//! independent model of scheme files. **Input**: generated files of six kinds, each built around a way in
//! which a certificate could believe too much: regular parts that are no splines, broken symmetries, special
//! stencils far out, equal eigenvalues with and without Jordan blocks, rounded weights, and weights of any
//! sort. The sequence of cases is fixed.

use crate::generated::{self, File, Pass, Special, q};
use eigenring_certify::{Check, Statement, Status, Witness};
use eigenring_tests::oracle::claims::{c1, checks, status};
use eigenring_tests::oracle::facts::{Facts, Truth};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use std::panic::catch_unwind;

type Q = BigRational;

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

// --- a: regular parts

/// Cubic stencils at the centre, and a line that is stated to be of some degree.
fn any_line() -> impl Strategy<Value = (usize, usize, [i64; 3], bool, bool)> {
    // valence, stated degree, weights in twentieths; mirror-symmetric or not; four taps on edges or two
    (
        3_usize..=6,
        1_usize..=5,
        [-4_i64..=8, -4_i64..=8, -4_i64..=8],
        proptest::bool::ANY,
        proptest::bool::weighted(0.25),
    )
}

fn line_file(&(n, degree, [a, b, c], mirror, wide): &(usize, usize, [i64; 3], bool, bool)) -> File {
    let t = |p: i64| q(p, 20);
    let even = if mirror {
        vec![(-4, t(a)), (0, t(20 - 2 * a)), (4, t(a))]
    } else {
        vec![(-4, t(a)), (0, t(20 - a - b)), (4, t(b))]
    };
    let odd = match (wide, mirror) {
        (false, true) => vec![(-2, q(1, 2)), (2, q(1, 2))],
        (false, false) => vec![(-2, t(10 + c)), (2, t(10 - c))],
        (true, true) => vec![(-6, t(-c)), (-2, t(10 + c)), (2, t(10 + c)), (6, t(-c))],
        (true, false) => vec![(-6, t(a)), (-2, t(10 + c)), (2, t(10 - c - a + b)), (6, t(-b))],
    };
    let mut pass = Pass::vertex(vec![even, odd]);
    pass.special = generated::cubic_centre(n, if wide { 3 } else { 1 });
    File {
        degree,
        n,
        passes: vec![pass],
    }
}

#[test]
fn lines_that_are_no_splines() {
    let tally = examine(50, any_line(), line_file, nothing_else);
    finish(&tally);
    assert!(tally.certified >= 25 && tally.decided >= 100, "{tally:?}");
}

/// Midpoints and smoothings, or centroids, as several passes; the last numbers disturb one of them.
fn factors() -> impl Strategy<Value = (usize, bool, usize, usize, i64, i64)> {
    // valence, dual, number of factors, stated degree, disturbance of the smoothing, of its position
    let disturbed = prop_oneof_i64(&[0, 0, 1, -1, 5]);
    (
        3_usize..=6,
        proptest::bool::ANY,
        1_usize..=2,
        1_usize..=6,
        disturbed,
        prop_oneof_i64(&[0, 0, 0, 2]),
    )
}

fn prop_oneof_i64(values: &[i64]) -> impl Strategy<Value = i64> + use<> {
    proptest::sample::select(values.to_vec())
}

fn factored(&(n, dual, factors, degree, by, shift): &(usize, bool, usize, usize, i64, i64)) -> File {
    if dual {
        return File {
            degree,
            n,
            passes: generated::repeated_averaging(n, factors, by),
        };
    }
    let mut passes = generated::smoothings(n, factors, by);
    if shift != 0 {
        // a shift and its inverse are the identity, but not across a spoke
        passes.extend(generated::shift_and_back(n, shift));
    }
    File { degree, n, passes }
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

// --- b: broken symmetries

/// Catmull-Clark, disturbed in one of six ways by up to some twentieths.
fn disturbances() -> impl Strategy<Value = (usize, usize, i64, [i64; 8])> {
    let unequal = || prop_oneof_i64(&[0, 0, 0, 1, 3, 6]);
    let sectors = [
        unequal(),
        unequal(),
        unequal(),
        unequal(),
        unequal(),
        unequal(),
        unequal(),
        unequal(),
    ];
    (3_usize..=7, 0_usize..6, -4_i64..=4, sectors)
}

fn disturbed(&(n, kind, by, unequal): &(usize, usize, i64, [i64; 8])) -> File {
    let mut pass = Pass::vertex(generated::cubic());
    pass.special = generated::cubic_centre(n, 1);
    let t = |p: i64| q(p, 40);
    let edge = |i: i64, extra: i64| {
        let mut edge = Special::new((2, 0), Some(i));
        edge.add((0, 0), i, q(3, 8)).add((2, 0), i, q(3, 8) - t(extra));
        edge.add((2, 0), i + 1, q(1, 16))
            .add((2, 0), i - 1, q(1, 16) + t(extra));
        edge.add((2, 2), i, q(1, 16)).add((2, 2), i - 1, q(1, 16));
        edge
    };
    match kind {
        // the centre reads the sectors unequally
        0 => {
            let total: i64 = unequal[..n].iter().sum::<i64>().max(1);
            let mut centre = Special::new((0, 0), None);
            centre.add((0, 0), 0, q(13, 20));
            let weight = |i: usize| q(7 * unequal[i], 20 * total);
            for i in 0..n {
                centre.add((2, 0), i as i64, weight(i));
            }
            let missing = q(7, 20) - (0..n).map(weight).sum::<Q>();
            centre.terms[0].2 += missing;
            pass.special = vec![centre];
        }
        // each sector has an edge rule of its own
        1 => (0..n).for_each(|i| pass.special.push(edge(i as i64, unequal[i] - 3))),
        // the edge rule leans to one side, in all sectors alike
        2 => pass.special.push(Special {
            sector: None,
            ..edge(0, by)
        }),
        // one sector alone
        3 => pass.special.push(edge(1, by)),
        // a face rule that leans
        4 => {
            let mut face = Special::new((2, 2), None);
            face.add((0, 0), 0, q(1, 4)).add((2, 0), 0, q(1, 4) + t(by));
            face.add((2, 0), 1, q(1, 4) - t(by)).add((2, 2), 0, q(1, 4));
            pass.special.push(face);
        }
        // a line that leans
        _ => pass.line[0] = vec![(-4, q(1, 8) + t(by)), (0, q(3, 4)), (4, q(1, 8) - t(by))],
    }
    File {
        degree: 3,
        n,
        passes: vec![pass],
    }
}

#[test]
fn broken_symmetries() {
    let tally = examine(60, disturbances(), disturbed, nothing_else);
    finish(&tally);
    assert!(tally.certified >= 50 && tally.decided >= 200, "{tally:?}");
}

// --- c: special stencils far out

/// Catmull-Clark with one or two points of a ring that keep some tenths of themselves and take the rest from
/// further in.
fn far() -> impl Strategy<Value = (usize, i64, i64, i64, bool, bool)> {
    (
        3_usize..=5,
        2_i64..=8,
        0_i64..=8,
        1_i64..=12,
        proptest::bool::ANY,
        proptest::bool::ANY,
    )
}

fn far_special(&(n, ring, along, keeps, both, far_inside): &(usize, i64, i64, i64, bool, bool)) -> File {
    let mut pass = Pass::vertex(generated::cubic());
    pass.special = generated::cubic_centre(n, 1);
    let along = along.min(ring);
    let reads = if far_inside { 2 } else { 2 * (ring - 1) };
    let mut put = |(x, y): (i64, i64), (u, v): (i64, i64)| {
        let mut special = Special::new((x, y), None);
        special.add((x, y), 0, q(keeps, 10)).add((u, v), 0, q(10 - keeps, 10));
        pass.special.push(special);
    };
    put((2 * ring, 2 * along), (reads, 0));
    // the mirror image of a point inside a sector; those of a spoke and the diagonal are their own
    if both && along > 0 && along < ring {
        put((2 * along, 2 * ring), (reads, 0));
    }
    File {
        degree: 3,
        n,
        passes: vec![pass],
    }
}

#[test]
fn special_stencils_far_out() {
    let tally = examine(30, far(), far_special, nothing_else);
    finish(&tally);
    assert!(tally.known >= 28 && tally.decided >= 100, "{tally:?}");
}

// --- d: ties

/// A one-ring scheme with lambda and, in one block, `lambda^2` twice.
#[derive(Clone, Copy, Debug)]
struct Tie {
    /// In block 2 at valence 6, or in block 0.
    in_two: bool,
    n: usize,
    /// A fraction. With powers of two all is exact in doubles as well, where proofs are easily too bold.
    lambda: (i64, i64),
    /// In thirty-seconds.
    e1: i64,
    /// In thirty-seconds.
    beta: i64,
    /// What couples the two, in sixteenths.
    lean: i64,
}

fn ties() -> impl Strategy<Value = Tie> {
    let n = proptest::sample::select(vec![4_usize, 4, 6, 3]);
    let lambda = proptest::sample::select(vec![(1, 2), (1, 2), (3, 8), (5, 8), (2, 5), (9, 20), (3, 5)]);
    let beta = prop_oneof_i64(&[0, 0, 1]);
    let lean = prop_oneof_i64(&[0, 0, 1, 2, 4, -2]);
    let all = (proptest::bool::weighted(0.2), n, lambda, 4_i64..=6, beta, lean);
    all.prop_map(|(in_two, n, lambda, e1, beta, lean)| Tie {
        in_two,
        n,
        lambda,
        e1,
        beta,
        lean,
    })
}

/// With `lean` this is the scheme of `jordan-one-ring-n4.toml`, nearly.
const PLANTED: Tie = Tie {
    in_two: false,
    n: 4,
    lambda: (1, 2),
    e1: 4,
    beta: 0,
    lean: 0,
};

fn tied(tie: &Tie) -> File {
    let (one, two, half) = (Q::one(), q(2, 1), q(1, 2));
    let (lambda, lean, beta) = (q(tie.lambda.0, tie.lambda.1), q(tie.lean, 16), q(tie.beta, 32));
    let square = &lambda * &lambda;
    let file = |n: usize, weights: &[Q; 9]| File {
        degree: 3,
        n,
        passes: vec![generated::one_ring(n, weights)],
    };
    if tie.in_two {
        // at valence 6 with e2 = 0 the blocks 1 and 2 are [[d2 +- e1, 0], [f2 .., f3]]
        let (d2, e1) = ((&lambda + &square) * &half, (&lambda - &square) * &half);
        let (f2, f3, e2) = (lean, square, Q::zero());
        let (f1, d1) = (&one - &two * &f2 - &f3, &one - &d2 - &two * &e1);
        return file(6, &[f1, f2, f3, d1, d2, e1, e2, q(3, 8), q(0, 1)]);
    }
    // block 0 on E - V and F - V is [[d2 + 2 e1 - alpha, 2 e2 - beta], [2 f2 - alpha, f3 - beta]], made
    // [[lambda^2, 0], [2 lean, lambda^2]]
    let cosine = match tie.n {
        3 => q(-1, 2),
        4 => Q::zero(),
        _ => half.clone(),
    };
    let (e1, e2, f3) = (q(tie.e1, 32), &beta * &half, &square + &beta);
    // (d2 + 2 e1 c - lambda) (f3 - lambda) = 2 (1 + c) e2 f2 in block 1, with f2 = alpha/2 + lean and alpha =
    // d2 + 2 e1 - lambda^2; f3 < lambda as lambda (1 - lambda) >= 15/64 and beta <= 1/32
    let slope = &two * (&one + &cosine) * &e2 / (&f3 - &lambda);
    let constant = &lambda - &two * &e1 * &cosine + &slope * ((&two * &e1 - &square) * &half + &lean);
    let d2 = constant / (&one - &slope * &half);
    let alpha = &d2 + &two * &e1 - &square;
    let f2 = &alpha * &half + &lean;
    let (f1, d1) = (&one - &two * &f2 - &f3, &one - &d2 - &two * &e1 - &two * &e2);
    file(tie.n, &[f1, f2, f3, d1, d2, e1, e2, alpha, beta])
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

// --- e: rounding

/// A scheme with weights that are no decimals, printed to some digits.
fn rounding() -> impl Strategy<Value = (usize, usize, i64, usize)> {
    // valence, which scheme, a weight of it, digits
    (3_usize..=7, 0_usize..3, 1_i64..=9, 12_usize..=17)
}

fn printed(&(n, scheme, weight, digits): &(usize, usize, i64, usize)) -> File {
    let mut file = match scheme {
        0 => File {
            degree: 3,
            n,
            passes: vec![Pass {
                special: generated::cubic_centre(n, 1),
                ..Pass::vertex(generated::cubic())
            }],
        },
        1 => File {
            degree: 2,
            n,
            passes: vec![generated::doo_sabin(n)],
        },
        _ => {
            let (alpha, beta) = (q(weight, 14), q(1, 7 + weight));
            let (third, sixth) = (q(1, 3), q(1, 6));
            let weights = [
                &third * q(1, 1),
                third.clone(),
                q(0, 1),
                q(1, 3),
                q(1, 3),
                sixth.clone(),
                q(0, 1),
                alpha,
                beta,
            ];
            File {
                degree: 3,
                n,
                passes: vec![generated::one_ring(n, &weights)],
            }
        }
    };
    for special in file.passes.iter_mut().flat_map(|pass| &mut pass.special) {
        special
            .terms
            .iter_mut()
            .for_each(|term| term.2 = generated::rounded(&term.2, digits));
    }
    file
}

/// Rows that miss 1 by no more than this are rounded; nothing may be refuted because of that.
fn tolerated() -> Q {
    q(1, 1_000_000_000_000)
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

// --- f: any weights

/// One-ring weights in sixteenths and their rows, of both signs.
fn any_weights() -> impl Strategy<Value = (usize, [i64; 7], bool)> {
    let weight = || -6_i64..=12;
    (
        3_usize..=8,
        [weight(), weight(), -4..=6, -4..=6, -4..=14, -4..=8, weight()],
        proptest::bool::weighted(0.2),
    )
}

fn any_one_ring(&(n, [f2, f3, e1, e2, alpha, beta, d2], unread): &(usize, [i64; 7], bool)) -> File {
    let s = |p: i64| q(p, 16);
    let (one, two) = (Q::one(), q(2, 1));
    let (mut f2, f3, e1, e2, mut d2) = (s(f2), s(f3), s(e1), s(e2), s(d2));
    if unread {
        // rows without the centre; the points of ring 2 read it all the same
        f2 = (&one - &f3) / &two;
        d2 = &one - &two * &e1 - &two * &e2;
    }
    let (f1, d1) = (&one - &two * &f2 - &f3, &one - &d2 - &two * &e1 - &two * &e2);
    let weights = [f1, f2, f3, d1, d2, e1, e2, s(alpha), s(beta)];
    File {
        degree: 3,
        n,
        passes: vec![generated::one_ring(n, &weights)],
    }
}

#[test]
fn any_one_ring_weights() {
    let tally = examine(30, any_weights(), any_one_ring, nothing_else);
    finish(&tally);
    assert!(tally.certified == tally.known && tally.decided >= 120, "{tally:?}");
}

/// Stencils of the first two rings with weights of any sort on the points around.
fn any_stencils() -> impl Strategy<Value = (usize, Vec<(usize, [i64; 5])>, i64)> {
    let stencil = (0_usize..5, [-3_i64..=6, -3..=6, -3..=6, -3..=6, -3..=6]);
    (3_usize..=6, proptest::collection::vec(stencil, 1..=3), -4_i64..=20)
}

fn any_stencil_file((n, stencils, centre): &(usize, Vec<(usize, [i64; 5])>, i64)) -> File {
    let n = *n;
    let mut pass = Pass::vertex(generated::cubic());
    pass.special = generated::centre(n, &q(16 - centre, 16), &q(0, 1));
    for &(place, [a, b, c, d, e]) in stencils {
        let at = [(2, 0), (2, 2), (4, 0), (4, 4), (4, 2)][place];
        if pass.special.iter().any(|special| special.at == at) {
            continue;
        }
        // mirror-symmetric about the spoke or the diagonal where the point is; (4, 2) has no such axis and
        // leans
        let mut special = Special::new(at, None);
        let mirror = if at.1 == 0 { -1 } else { 1 };
        let s = |p: i64| q(p, 16);
        special.add((2, 0), 0, s(a)).add((4, 0), 0, s(b)).add((2, 2), 0, s(c));
        special
            .add((2, 0), mirror, s(if at.1 == 0 { d } else { a }))
            .add((4, 4), 0, s(e));
        if at.1 == 0 {
            special.add((2, 0), 1, s(d)).add((2, 2), -1, s(c)).add((4, 4), -1, s(e));
        } else {
            special.add((4, 0), 1, s(b));
        }
        let rest = Q::one() - special.terms.iter().map(|term| &term.2).sum::<Q>();
        special.add((0, 0), 0, rest);
        pass.special.push(special);
    }
    File {
        degree: 3,
        n,
        passes: vec![pass],
    }
}

#[test]
fn any_stencils_near_the_centre() {
    let tally = examine(24, any_stencils(), any_stencil_file, nothing_else);
    finish(&tally);
    assert!(tally.certified >= 20 && tally.decided >= 80, "{tally:?}");
}

// --- planted faults: each kind can fail

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
