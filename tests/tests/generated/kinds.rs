//! Scheme files of each kind in which a certificate could believe too much: what varies, and the file of it.

use super::{
    File, Pass, Special, cubic, cubic_centre, doo_sabin, one_ring, q, repeated_averaging, rounded, shift_and_back,
    smoothings,
};
use num_rational::BigRational;
use num_traits::{One, Zero};
use proptest::strategy::Strategy;

type Q = BigRational;

/// Cubic stencils at the centre, and a line that is stated to be of some degree.
pub fn any_line() -> impl Strategy<Value = (usize, usize, [i64; 3], bool, bool)> {
    // valence, stated degree, weights in twentieths; mirror-symmetric or not; four taps on edges or two
    (
        3_usize..=6,
        1_usize..=5,
        [-4_i64..=8, -4_i64..=8, -4_i64..=8],
        proptest::bool::ANY,
        proptest::bool::weighted(0.25),
    )
}

pub fn line_file(&(n, degree, [a, b, c], mirror, wide): &(usize, usize, [i64; 3], bool, bool)) -> File {
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
    pass.special = cubic_centre(n, if wide { 3 } else { 1 });
    File {
        degree,
        n,
        passes: vec![pass],
    }
}

/// Midpoints and smoothings, or centroids, as several passes; the last numbers disturb one of them.
pub fn factors() -> impl Strategy<Value = (usize, bool, usize, usize, i64, i64)> {
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

pub fn prop_oneof_i64(values: &[i64]) -> impl Strategy<Value = i64> + use<> {
    proptest::sample::select(values.to_vec())
}

pub fn factored(&(n, dual, factors, degree, by, shift): &(usize, bool, usize, usize, i64, i64)) -> File {
    if dual {
        return File {
            degree,
            n,
            passes: repeated_averaging(n, factors, by),
        };
    }
    let mut passes = smoothings(n, factors, by);
    if shift != 0 {
        // a shift and its inverse are the identity, but not across a spoke
        passes.extend(shift_and_back(n, shift));
    }
    File { degree, n, passes }
}

/// Catmull-Clark, disturbed in one of six ways by up to some twentieths.
pub fn disturbances() -> impl Strategy<Value = (usize, usize, i64, [i64; 8])> {
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

pub fn disturbed(&(n, kind, by, unequal): &(usize, usize, i64, [i64; 8])) -> File {
    let mut pass = Pass::vertex(cubic());
    pass.special = cubic_centre(n, 1);
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

/// Catmull-Clark with one or two points of a ring that keep some tenths of themselves and take the rest from
/// further in.
pub fn far() -> impl Strategy<Value = (usize, i64, i64, i64, bool, bool)> {
    (
        3_usize..=5,
        2_i64..=8,
        0_i64..=8,
        1_i64..=12,
        proptest::bool::ANY,
        proptest::bool::ANY,
    )
}

pub fn far_special(&(n, ring, along, keeps, both, far_inside): &(usize, i64, i64, i64, bool, bool)) -> File {
    let mut pass = Pass::vertex(cubic());
    pass.special = cubic_centre(n, 1);
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

/// A one-ring scheme with lambda and, in one block, `lambda^2` twice.
#[derive(Clone, Copy, Debug)]
pub struct Tie {
    /// In block 2 at valence 6, or in block 0.
    pub in_two: bool,
    pub n: usize,
    /// A fraction. With powers of two all is exact in doubles as well, where proofs are easily too bold.
    pub lambda: (i64, i64),
    /// In thirty-seconds.
    pub e1: i64,
    /// In thirty-seconds.
    pub beta: i64,
    /// What couples the two, in sixteenths.
    pub lean: i64,
}

pub fn ties() -> impl Strategy<Value = Tie> {
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
pub const PLANTED: Tie = Tie {
    in_two: false,
    n: 4,
    lambda: (1, 2),
    e1: 4,
    beta: 0,
    lean: 0,
};

pub fn tied(tie: &Tie) -> File {
    let (one, two, half) = (Q::one(), q(2, 1), q(1, 2));
    let (lambda, lean, beta) = (q(tie.lambda.0, tie.lambda.1), q(tie.lean, 16), q(tie.beta, 32));
    let square = &lambda * &lambda;
    let file = |n: usize, weights: &[Q; 9]| File {
        degree: 3,
        n,
        passes: vec![one_ring(n, weights)],
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

/// A scheme with weights that are no decimals, printed to some digits.
pub fn rounding() -> impl Strategy<Value = (usize, usize, i64, usize)> {
    // valence, which scheme, a weight of it, digits
    (3_usize..=7, 0_usize..3, 1_i64..=9, 12_usize..=17)
}

pub fn printed(&(n, scheme, weight, digits): &(usize, usize, i64, usize)) -> File {
    let mut file = match scheme {
        0 => File {
            degree: 3,
            n,
            passes: vec![Pass {
                special: cubic_centre(n, 1),
                ..Pass::vertex(cubic())
            }],
        },
        1 => File {
            degree: 2,
            n,
            passes: vec![doo_sabin(n)],
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
                passes: vec![one_ring(n, &weights)],
            }
        }
    };
    for special in file.passes.iter_mut().flat_map(|pass| &mut pass.special) {
        special
            .terms
            .iter_mut()
            .for_each(|term| term.2 = rounded(&term.2, digits));
    }
    file
}

/// Rows that miss 1 by no more than this are rounded; nothing may be refuted because of that.
pub fn tolerated() -> Q {
    q(1, 1_000_000_000_000)
}

/// One-ring weights in sixteenths and their rows, of both signs.
pub fn any_weights() -> impl Strategy<Value = (usize, [i64; 7], bool)> {
    let weight = || -6_i64..=12;
    (
        3_usize..=8,
        [weight(), weight(), -4..=6, -4..=6, -4..=14, -4..=8, weight()],
        proptest::bool::weighted(0.2),
    )
}

pub fn any_one_ring(&(n, [f2, f3, e1, e2, alpha, beta, d2], unread): &(usize, [i64; 7], bool)) -> File {
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
        passes: vec![one_ring(n, &weights)],
    }
}

/// Stencils of the first two rings with weights of any sort on the points around.
pub fn any_stencils() -> impl Strategy<Value = (usize, Vec<(usize, [i64; 5])>, i64)> {
    let stencil = (0_usize..5, [-3_i64..=6, -3..=6, -3..=6, -3..=6, -3..=6]);
    (3_usize..=6, proptest::collection::vec(stencil, 1..=3), -4_i64..=20)
}

pub fn any_stencil_file((n, stencils, centre): &(usize, Vec<(usize, [i64; 5])>, i64)) -> File {
    let n = *n;
    let mut pass = Pass::vertex(cubic());
    pass.special = super::centre(n, &q(16 - centre, 16), &q(0, 1));
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
