//! The proofs against closed forms in many digits, single certificates and planted faults.

use super::rules::ratio;
use super::*;
use crate::{Input, Requirement, Status, certify};
use eigenring_scheme::BigRational;
use num_bigint::BigInt;

fn status(certificate: &ValencesCertificate, statement: Statement) -> Status {
    let check = certificate.checks.iter().find(|check| check.name == statement);
    check.expect("every statement is listed").status
}

#[test]
fn both_families_are_c1_at_every_valence() {
    for family in Family::ALL {
        for from in [5, 17, 1000] {
            let certificate = prove(family, from).unwrap();
            assert_eq!(
                Requirement::C1.verdict(&certificate.checks),
                (true, Status::Proven),
                "{family:?}"
            );
            assert_eq!(status(&certificate, Statement::Hull), Status::Proven);
            let curvature = match family {
                Family::CatmullClark => Status::Refuted,
                Family::DooSabin => Status::Undecided,
            };
            assert_eq!(status(&certificate, Statement::BoundedCurvature), curvature);
            let text = certificate.to_line().unwrap();
            assert!(recheck_valences_text(&text).unwrap().1.confirmed());
        }
        for from in [0, 4, 1001] {
            assert!(matches!(prove(family, from), Err(Error::Valences { .. })));
        }
    }
}

/// The tile that tau of a valence lies in.
fn at(rules: &Rules, tiles: &[Tile], valence: usize) -> Found {
    let tau = (std::f64::consts::PI / valence as f64).tan();
    let tile = tiles.iter().find(|tile| tile.tau[0] <= tau && tau <= tile.tau[1]);
    tile.and_then(|tile| tile.check(rules)).expect("a tile")
}

#[test]
fn single_certificates_lie_in_the_tiles() {
    for (family, spec) in Family::ALL.into_iter().zip(["catmull-clark", "doo-sabin"]) {
        let rules = Rules::new(family).unwrap().unwrap();
        let tiles = prove(family, 5).unwrap().tiles;
        for valence in [5, 6, 7, 12, 40] {
            let input = Input::from_spec(&spec.parse().unwrap(), valence).unwrap();
            let single = certify(input, valence).unwrap();
            let value = |statement| {
                single
                    .check(statement)
                    .and_then(|check| check.enclosure)
                    .expect("enclosed")
            };
            let found = at(&rules, &tiles, valence);
            let known = value(Statement::Subdominant);
            assert!(
                known.width() < 1e-12 && !found.lambda.disjoint(known),
                "{spec} {valence}"
            );
            if let Some(ratio) = found.second {
                assert!(
                    ratio.contains(value(Statement::BoundedCurvature).mid()),
                    "{spec} {valence}"
                );
            }
            // on a tile of no width the same coefficients bound the same Jacobian; single maps are scaled to
            // 1 at the face point, which is here at f on the x-axis, and their y is not divided by tau
            let tau = (std::f64::consts::PI / valence as f64).tan();
            let narrow = Tile::find(&rules, [tau, tau]).check(&rules).expect("a tile");
            let face = match family {
                Family::CatmullClark => 0.5 / (narrow.lambda.mid() - 0.25),
                Family::DooSabin => 1.0,
            };
            let there = single.check(Statement::Regular).and_then(|check| check.margin);
            let (here, there) = (narrow.jacobian.expect("positive"), there.expect("positive"));
            let there = there * face * face / tau;
            assert!((here - there).abs() < 1e-12 * here, "{spec} {valence}: {here} {there}");
            assert!(found.jacobian.is_some_and(|least| least <= here), "{spec} {valence}");
        }
    }
}

/// Digits after the point of the numbers below.
const DIGITS: u32 = 60;

fn one() -> BigInt {
    BigInt::from(10).pow(DIGITS)
}

fn times(a: &BigInt, b: &BigInt) -> BigInt {
    a * b / one()
}

/// The square root of a non-negative number.
fn root(a: &BigInt) -> BigInt {
    (a * one()).sqrt()
}

/// `atan(1/q)`.
fn atan_of_reciprocal(q: i64) -> BigInt {
    let mut power = one() / q;
    let (mut sum, mut k) = (BigInt::from(0), 0_i64);
    while power != BigInt::from(0) {
        let term = &power / (2 * k + 1);
        sum += if k % 2 == 0 { term } else { -term };
        power /= q * q;
        k += 1;
    }
    sum
}

/// The cosine of `2 pi k/n` by Machin's formula and Taylor's series.
fn cosine(k: i64, n: i64) -> BigInt {
    let pi: BigInt = 4 * (4 * atan_of_reciprocal(5) - atan_of_reciprocal(239));
    let angle = 2 * k * pi / n;
    let square = times(&angle, &angle);
    let (mut term, mut sum, mut j) = (one(), one(), 0_i64);
    while term != BigInt::from(0) {
        term = -times(&term, &square) / ((2 * j + 1) * (2 * j + 2));
        sum += &term;
        j += 1;
    }
    sum
}

/// Lambda of Catmull-Clark, `(c + 5 + sqrt((c + 9)(c + 1)))/16`.
fn lambda_of(c: &BigInt) -> BigInt {
    (c + 5 * one() + root(&times(&(c + 9 * one()), &(c + one())))) / 16
}

/// What the tiles prove against the eigenvalues in 50 digits and more, by the formulas in the literature
/// (Peters and Reif 2008, section 6.2), at twenty valences up to a million.
#[test]
fn closed_forms_in_fifty_digits_agree() {
    let rules = Rules::new(Family::CatmullClark).unwrap().unwrap();
    let tiles = prove(Family::CatmullClark, 5).unwrap().tiles;
    let valences = [
        5, 6, 7, 8, 9, 10, 11, 13, 16, 21, 34, 64, 100, 317, 1000, 3163, 10_000, 31_623, 100_000, 1_000_000,
    ];
    for n in valences {
        let lambda = lambda_of(&cosine(1, n));
        let second = lambda_of(&cosine(2, n));
        // (3 n - 7 + sqrt(5 n^2 - 30 n + 49))/(8 n)
        let inside: BigInt = (5 * n * n - 30 * n + 49) * one();
        let in_block_0 = ((3 * n - 7) * one() + root(&inside)) / (8 * n);
        assert!(in_block_0 < lambda && second < lambda && lambda < one(), "{n}");
        assert!(second > times(&lambda, &lambda), "{n}");
        let found = at(&rules, &tiles, n as usize);
        let double = |x: &BigInt| {
            (x * BigInt::from(1_u64 << 60) / one())
                .to_string()
                .parse::<f64>()
                .unwrap()
                / 2_f64.powi(60)
        };
        assert!(found.leads && found.lambda.contains(double(&lambda)), "{n}");
        let ratio = double(&(&second * one() / times(&lambda, &lambda)));
        assert!(found.second.is_some_and(|second| second.contains(ratio)), "{n}");
    }
    // where lambda and the largest of block 0 meet
    let n = 1_000_000;
    let gap = lambda_of(&cosine(1, n)) - ((3 * n - 7) * one() + root(&((5 * n * n - 30 * n + 49) * one()))) / (8 * n);
    assert!(gap > BigInt::from(0) && gap * 1_000_000 < 2 * one());
}

/// A weight that is off by a thousandth is not proven, whichever it is.
#[test]
fn planted_faults_are_not_proven() {
    let rules = Rules::new(Family::CatmullClark).unwrap().unwrap();
    let end = last(5).unwrap();
    let tiles = cover(&rules, end);
    let Inner::Vertex { weights, own } = rules.inner.clone() else {
        panic!("a vertex scheme");
    };
    let off = ratio(1, 1000);
    let names: Vec<&str> = weights.each().iter().map(|(name, _)| *name).collect();
    let mut faulty = vec![[&own[0] + &off, own[1].clone()], [own[0].clone(), &own[1] + &off]]
        .into_iter()
        .map(|own| Inner::Vertex {
            weights: weights.clone(),
            own,
        })
        .collect::<Vec<_>>();
    for changed in names {
        let named = weights.each().map(|(name, weight)| match name == changed {
            true => weight + &off,
            false => weight.clone(),
        });
        let mut values = named.into_iter();
        let weights = Box::new(weights.as_ref().clone().map(|_| values.next().expect("nine weights")));
        faulty.push(Inner::Vertex {
            weights,
            own: own.clone(),
        });
    }
    assert_eq!(faulty.len(), 11);
    for inner in faulty {
        let affine = inner.is_affine();
        let faulty = Rules {
            inner,
            affine,
            ..rules.clone()
        };
        let found = checks(&faulty, 5, end, &tiles);
        assert_eq!(
            Requirement::C1.verdict(&found).1,
            Status::Undecided,
            "{:?}",
            faulty.inner
        );
    }
    // weights that sum to 1, and whose block 0 leads at large valences
    let heavy = |alpha: BigRational| {
        let mut weights = weights.clone();
        let own = [ratio(1, 1), -(&alpha + &weights.beta)];
        weights.alpha = alpha;
        let rules = Rules {
            inner: Inner::Vertex { weights, own },
            ..rules.clone()
        };
        checks(&rules, 5, end, &tiles)
    };
    // lambda (A + B) > A f3 + B (d2 + 2 e1) - 2 A e2 - 2 B f2 in the limit: (A + B) .6545 > A/8
    assert_eq!(Requirement::C1.verdict(&heavy(ratio(2, 1))).1, Status::Proven);
    assert_eq!(Requirement::C1.verdict(&heavy(ratio(-1, 3))).1, Status::Undecided);
    // a folded map
    let folded = Rules {
        inner: match rules.inner.clone() {
            Inner::Vertex { mut weights, own } => {
                weights.f2 = ratio(-1, 4);
                weights.f1 = ratio(5, 4);
                Inner::Vertex { weights, own }
            }
            face => face,
        },
        ..rules
    };
    assert_eq!(
        Requirement::C1.verdict(&checks(&folded, 5, end, &tiles)).1,
        Status::Undecided
    );
}

#[test]
fn changed_certificates_are_not_confirmed() {
    let certificate = prove(Family::CatmullClark, 7).unwrap();
    let attempts: [fn(&mut ValencesCertificate); 6] = [
        |c| drop(c.tiles.pop()),
        |c| c.tiles[0].tau[0] = 1e-9,
        |c| c.from = 5,
        |c| c.scheme = Family::DooSabin,
        |c| c.tiles.clear(),
        |c| {
            let curvature = c.checks.last_mut().expect("checks");
            *curvature = Check::proven(Statement::BoundedCurvature);
        },
    ];
    for (which, attempt) in attempts.into_iter().enumerate() {
        let mut changed = certificate.clone();
        attempt(&mut changed);
        let (_, found) = recheck_valences_text(&changed.signed().to_json().unwrap()).unwrap();
        assert!(!found.confirmed() && !found.differences.is_empty(), "{which}");
    }
    let text = certificate
        .to_json()
        .unwrap()
        .replacen("\"from\"", "\"extra\": 1, \"from\"", 1);
    assert!(matches!(recheck_valences_text(&text), Err(Error::Syntax { .. })));
}
