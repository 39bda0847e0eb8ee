//! **Claim**: certificates of boundaries, creases, darts, corners and knot intervals say what is known of
//! them, and no more. **Oracles**: the spectra of `maths-surfaces`, section 3, in closed form where there is
//! one; the theory of regular tensor-product splines; what is known not to be C1.

use eigenring_certify::{Certificate, Input, Requirement, Statement, Status, certify, recheck_text};
use eigenring_scheme::Shape;

fn of(spec: &str, shape: Shape) -> Certificate {
    let valence = match &shape {
        Shape::Closed { sectors } => *sectors,
        Shape::Fan { faces, .. } => *faces,
        Shape::Dart { valence } | Shape::Cusp { valence } => *valence,
        Shape::Knots { intervals, .. } => intervals.len(),
    };
    let input = Input::Corner {
        spec: spec.to_owned(),
        shape,
        steps: None,
    };
    certify(input, valence).unwrap()
}

fn fan(faces: usize) -> Shape {
    Shape::Fan { faces, corner: false }
}

fn corner(faces: usize) -> Shape {
    Shape::Fan { faces, corner: true }
}

fn knots(intervals: &[f64], next: &[f64]) -> Shape {
    Shape::Knots {
        intervals: intervals.to_vec(),
        next: next.to_vec(),
    }
}

fn status(certificate: &Certificate, name: Statement) -> Status {
    certificate.check(name).unwrap().status
}

fn c1(certificate: &Certificate) -> Status {
    Requirement::C1.verdict(&certificate.checks).1
}

/// Proven, and proven again from the text alone.
#[track_caller]
fn is_proven(spec: &str, shape: Shape) -> Certificate {
    let certificate = of(spec, shape.clone());
    assert_eq!(
        c1(&certificate),
        Status::Proven,
        "{spec} {shape:?}: {:?}",
        certificate.checks
    );
    let text = certificate.to_line().unwrap();
    assert!(recheck_text(&text).unwrap().1.confirmed(), "{spec} {shape:?}");
    certificate
}

/// Two faces are half of a regular net, three have the pair of a sine mode and the boundary's 1/2.
#[test]
fn boundaries_with_two_and_three_faces_are_c1() {
    for spec in [
        "catmull-clark",
        "stam:order=4",
        "stam:order=6",
        "tension:order=4,u0=0.3",
        "tension:order=6,u0=5",
    ] {
        let two = is_proven(spec, fan(2));
        assert!(
            two.check(Statement::Subdominant)
                .unwrap()
                .enclosure
                .unwrap()
                .contains(0.5)
        );
        is_proven(spec, fan(3));
    }
    let three = of("catmull-clark", fan(3));
    let lambda = three.check(Statement::Subdominant).unwrap().enclosure.unwrap();
    // the first mode of the closed fan of six: c = 1/2
    let expected = (0.5 + 5.0 + (9.5_f64 * 1.5).sqrt()) / 16.0;
    assert!((lambda.mid() - expected).abs() < 1e-12 && lambda.width() < 1e-12);
    // its second mode, .4101, exceeds the square of the first
    assert_eq!(status(&three, Statement::BoundedCurvature), Status::Refuted);
    assert_eq!(status(&three, Statement::Strict), Status::Undecided);
}

/// One face has no second mode but in a Jordan block, four have the boundary's 1/2 in one, and from five on
/// two modes exceed it, of which the boundary sees none.
#[test]
fn other_boundaries_are_not_proven() {
    for faces in [1, 4, 5, 6, 12] {
        for spec in ["catmull-clark", "stam:order=6", "tension:order=4,u0=0.3"] {
            let certificate = of(spec, fan(faces));
            // what leading levels leave of the boundary's tangent is not looked at
            let refuted = faces >= 5 && !spec.contains("u0");
            let expected = if refuted { Status::Refuted } else { Status::Undecided };
            assert_eq!(
                c1(&certificate),
                expected,
                "{spec} {faces}: {:?}",
                certificate.check(Statement::Regular)
            );
            for name in [Statement::RowSums, Statement::Hull, Statement::Dominant] {
                assert_eq!(status(&certificate, name), Status::Proven, "{spec} {faces} {name}");
            }
        }
    }
}

#[test]
fn corners_with_one_face_are_c1_and_others_are_not_proven() {
    for spec in ["catmull-clark", "stam:order=6", "tension:order=6,u0=2"] {
        is_proven(spec, corner(1));
    }
    for (faces, expected) in [
        (2, Status::Undecided),
        (3, Status::Undecided),
        (4, Status::Undecided),
        (8, Status::Refuted),
    ] {
        assert_eq!(c1(&of("catmull-clark", corner(faces))), expected, "{faces}");
    }
}

#[test]
fn darts_are_c1() {
    for valence in [3, 5, 6, 8, 13, 32] {
        let certificate = is_proven("catmull-clark", Shape::Dart { valence });
        let check = certificate.check(Statement::Subdominant).unwrap();
        if valence == 5 {
            let remark = check.reached.as_ref().unwrap();
            assert!(remark.contains("0.54998") && remark.contains("0.52642"), "{remark}");
        }
    }
    // 1/2 twice, and nothing told its two vectors apart before
    let four = is_proven("catmull-clark", Shape::Dart { valence: 4 });
    assert_eq!(
        four.check(Statement::Subdominant).unwrap().enclosure.unwrap().mid(),
        0.5
    );
    is_proven("stam:order=6", Shape::Dart { valence: 7 });
    // a needle
    assert_ne!(c1(&of("catmull-clark", Shape::Cusp { valence: 5 })), Status::Proven);
}

/// Around a vertex of valence 4 the surface is a tensor-product spline of these knots.
#[test]
fn knot_intervals_are_c1_whatever_they_are() {
    for (intervals, next) in [
        ([1.0, 2.0, 3.0, 4.0], [1.0, 2.0, 3.0, 4.0]),
        ([1.0, 0.1, 3.0, 1e3], [1.0, 2.0, 2.0, 0.3]),
        ([0.7, 0.7, 0.7, 0.7], [2.0, 0.7, 0.7, 1e-3]),
    ] {
        is_proven("catmull-clark", knots(&intervals, &next));
    }
    // an interval of no width is a multiple knot
    let flat = of("catmull-clark", knots(&[1.0, 0.0, 3.0, 4.0], &[1.0; 4]));
    assert_eq!(c1(&flat), Status::Undecided);
}

/// A crease that acts in some of the smoothing steps only is not the boundary of a spline.
#[test]
fn creases_that_soften_are_left_open() {
    let input = Input::Corner {
        spec: "stam:order=6".to_owned(),
        shape: Shape::Dart { valence: 5 },
        steps: Some(1),
    };
    let certificate = certify(input, 5).unwrap();
    assert_eq!(c1(&certificate), Status::Undecided);
    let reached = certificate.check(Statement::Regular).unwrap().reached.clone().unwrap();
    assert!(reached.contains("no reflection"), "{reached}");
}

/// What is stored is looked at: a proof for one corner is none for another.
#[test]
fn a_certificate_of_another_corner_is_not_confirmed() {
    let honest = of("catmull-clark", fan(3));
    for shape in [corner(3), Shape::Dart { valence: 3 }] {
        let mut forged = honest.clone();
        forged.input = Input::Corner {
            spec: "catmull-clark".to_owned(),
            shape,
            steps: None,
        };
        forged.digest = forged.content_digest();
        assert!(!recheck_text(&forged.to_line().unwrap()).unwrap().1.confirmed());
    }
    // without evidence nothing is proven of the map
    let mut empty = honest;
    empty.evidence = Default::default();
    empty.digest = empty.content_digest();
    assert!(!recheck_text(&empty.to_line().unwrap()).unwrap().1.confirmed());
}
