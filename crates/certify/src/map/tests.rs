//! Maps of known schemes, planted faults, and independent values.

use super::find::Limits;
use super::*;
use crate::{Centred, Status};
use eigenring_scheme::Scheme;
use eigenring_scheme::families::{catmull_clark, doo_sabin, tension};
use eigenring_spectral::{LocalSystem, Maps, SecondOrder};

/// The modes computed in doubles are right within this, relative to values of size 10.
const RADIUS: f64 = 1e-12;

/// The leading mode of a Fourier index on the scheme's annulus, real and imaginary part, with its eigenvalue.
pub(super) fn mode(scheme: &Scheme<f64>, annulus: Annulus, fourier: usize) -> (f64, [Vec<f64>; 2]) {
    let system = LocalSystem::new(scheme.limit(), annulus.numbering.rings).unwrap();
    let value = system.blocks()[fourier].eigenvalues().unwrap()[0].value.re;
    let mode = system.single(fourier, value).unwrap();
    (
        value,
        [
            mode.values.iter().map(|v| v.re).collect(),
            mode.values.iter().map(|v| v.im).collect(),
        ],
    )
}

pub(super) fn widened(values: &[f64]) -> Vec<Interval> {
    values
        .iter()
        .map(|&value| Interval::around(value, RADIUS * value.abs().max(1.0)))
        .collect()
}

pub(super) fn net(scheme: &Scheme<f64>, fourier: usize) -> PlaneNet<Interval> {
    let annulus = Annulus::new(scheme).unwrap();
    let (_, parts) = mode(scheme, annulus, fourier);
    PlaneNet::new(annulus, fourier, true, parts.map(|part| widened(&part))).unwrap()
}

fn check(net: &PlaneNet<Interval>) -> (Regularity, Winding) {
    let limits = Limits::default();
    let regular = regular(net, &find::jacobian(net, limits));
    (regular, winding(net, &find::boundary(net, limits)))
}

#[test]
fn catmull_clark_is_regular_and_injective() {
    for valence in 3..=64 {
        let net = net(&catmull_clark(valence).unwrap(), 1);
        let (regular, winding) = check(&net);
        assert_eq!(regular.status, Status::Proven, "valence {valence}: {regular:?}");
        assert!(regular.positive && regular.margin() > 0.0);
        assert_eq!(
            (winding.status, winding.number),
            (Status::Proven, Some(1)),
            "valence {valence}"
        );
        // the bounds hold the values at points
        let scheme = catmull_clark(valence).unwrap();
        let annulus = Annulus::new(&scheme).unwrap();
        let (_, [x, y]) = mode(&scheme, annulus, 1);
        let [smallest, largest] = regular.jacobian;
        for patch in annulus.patches(1) {
            for (u, v) in [(0.0, 0.0), (0.3, 0.7), (1.0, 0.5), (1.0, 1.0)] {
                let (x, y) = (annulus.patch(&x, patch).jet(u, v), annulus.patch(&y, patch).jet(u, v));
                let jacobian = x.first[0] * y.first[1] - x.first[1] * y.first[0];
                assert!(smallest.lo() <= jacobian && jacobian <= largest.hi());
            }
        }
        assert!(smallest.width() < 0.5 * smallest.hi(), "{regular:?}");
    }
}

#[test]
fn other_degrees_and_kinds_of_net() {
    for valence in [3, 5, 8, 17] {
        for scheme in [
            doo_sabin(valence).unwrap(),
            tension(valence, 5, 1.0).unwrap(),
            tension(valence, 6, 1.0).unwrap(),
        ] {
            if (valence, scheme.degree()) == (3, Some(2)) {
                continue; // Doo and Sabin's lambda is defective with the outer ring: there is no eigenvector
            }
            let net = net(&scheme, 1);
            let (regular, winding) = check(&net);
            assert_eq!(
                regular.status,
                Status::Proven,
                "{} {valence} {regular:?}",
                scheme.name()
            );
            assert_eq!(winding.number, Some(1), "{} {valence}", scheme.name());
            let corner = corner(&net);
            assert_eq!(corner.is_some(), scheme.degree().unwrap() % 2 == 1);
        }
    }
}

#[test]
fn a_map_of_fourier_index_two_winds_twice() {
    for valence in [5, 6, 7, 8, 12, 20, 64] {
        let net = net(&catmull_clark(valence).unwrap(), 2);
        let (regular, winding) = check(&net);
        assert_eq!(
            (winding.status, winding.number),
            (Status::Refuted, Some(2)),
            "valence {valence}"
        );
        // for enough sectors the map is regular all the same: like z^2 it is a double covering
        if valence >= 8 {
            assert_eq!(regular.status, Status::Proven, "valence {valence} {regular:?}");
        }
    }
}

#[test]
fn a_square_map_has_positive_jacobian_and_winds_twice() {
    // control values on the square of the regular configuration of N = 12: z -> z^2 turns at index 2
    let valence = 12;
    let scheme = catmull_clark::<f64>(valence).unwrap();
    let annulus = Annulus::new(&scheme).unwrap();
    let (_, [x, y]) = mode(&scheme, annulus, 1);
    let square: [Vec<f64>; 2] = [
        x.iter().zip(&y).map(|(x, y)| x * x - y * y).collect(),
        x.iter().zip(&y).map(|(x, y)| 2.0 * x * y).collect(),
    ];
    let net = PlaneNet::new(annulus, 2, true, square.map(|part| widened(&part))).unwrap();
    let (regular, winding) = check(&net);
    assert_eq!(regular.status, Status::Proven, "{regular:?}");
    assert_eq!((winding.status, winding.number), (Status::Refuted, Some(2)));
}

/// The natural configuration of Catmull-Clark with all points of one orbit moved along their radius.
pub(super) fn moved(valence: usize, site: (i32, i32), factor: f64) -> Result<PlaneNet<Interval>, NetError> {
    let scheme = catmull_clark::<f64>(valence).unwrap();
    let annulus = Annulus::new(&scheme).unwrap();
    let (_, mut parts) = mode(&scheme, annulus, 1);
    for (index, at) in annulus.numbering.sites().into_iter().enumerate() {
        if (at.x, at.y) == site {
            parts.iter_mut().for_each(|part| part[index] *= factor);
        }
    }
    PlaneNet::new(annulus, 1, true, parts.map(|part| widened(&part)))
}

#[test]
fn a_folded_map_is_caught_with_its_witness() {
    for valence in [3, 5, 6, 10, 33] {
        // the corners of ring 2 pulled through the centre to the other side
        let net = moved(valence, (4, 4), -1.0).unwrap();
        let (regular, _) = check(&net);
        assert_eq!(regular.status, Status::Refuted, "valence {valence}: {regular:?}");
        let [negative, positive] = regular.fold.unwrap();
        let middle = net.middle();
        let jacobian = |place: Place| {
            let patch = PatchIndex {
                sector: place.sector,
                p: place.p,
                q: place.q,
            };
            let jet = |values: &[f64]| net.annulus().patch(values, patch).jet(place.u, place.v);
            let (x, y) = (jet(&middle.x), jet(&middle.y));
            x.first[0] * y.first[1] - x.first[1] * y.first[0]
        };
        assert!(jacobian(negative) < 0.0 && jacobian(positive) > 0.0);
        assert!(regular.jacobian[0].certainly_negative() && regular.jacobian[1].certainly_positive());
        // the same places do not refute a map that is regular
        let sound = self::net(&catmull_clark(valence).unwrap(), 1);
        let claim = JacobianEvidence::Fold {
            places: [negative, positive],
        };
        assert_eq!(super::regular(&sound, &claim).status, Status::Undecided);
    }
}

#[test]
fn subdivision_decides_what_whole_patches_do_not() {
    // somewhere between the sound map and the fold the coefficients of whole patches no longer suffice
    let mut subdivided = 0;
    let mut statuses = Vec::new();
    for step in 0..=40 {
        let net = moved(5, (4, 4), 1.0 - 0.04 * f64::from(step)).unwrap();
        let (regular, _) = check(&net);
        if regular.status == Status::Proven && regular.depth > 0 {
            subdivided += 1;
            let whole = JacobianEvidence::Sign {
                positive: true,
                patches: vec![Subdivision::whole(); net.patches().len()],
            };
            let coarse = super::regular(&net, &whole);
            assert_eq!(coarse.status, Status::Undecided);
            assert!(coarse.margin() <= 0.0 && coarse.jacobian[0].encloses(regular.jacobian[0]));
        }
        statuses.push(regular.status);
    }
    assert!(subdivided > 0);
    let first_refuted = statuses.iter().position(|&v| v == Status::Refuted).unwrap();
    assert!(
        statuses[..first_refuted].iter().all(|&v| v == Status::Proven),
        "{statuses:?}"
    );
    assert!(
        statuses[first_refuted..].iter().all(|&v| v == Status::Refuted),
        "{statuses:?}"
    );
}

#[test]
fn a_mirrored_map_is_regular_with_the_other_orientation() {
    let scheme = catmull_clark::<f64>(7).unwrap();
    let annulus = Annulus::new(&scheme).unwrap();
    let (_, [x, y]) = mode(&scheme, annulus, 1);
    let y: Vec<f64> = y.into_iter().map(|y| -y).collect();
    let net = PlaneNet::new(annulus, 6, true, [widened(&x), widened(&y)]).unwrap();
    let (regular, winding) = check(&net);
    assert_eq!((regular.status, regular.positive), (Status::Proven, false));
    assert!(regular.margin() > 0.0);
    assert_eq!((winding.status, winding.number), (Status::Proven, Some(-1)));
}

#[test]
fn wide_enclosures_are_undecided_and_say_how_far() {
    let scheme = catmull_clark::<f64>(5).unwrap();
    let annulus = Annulus::new(&scheme).unwrap();
    let (_, parts) = mode(&scheme, annulus, 1);
    let wide = |radius: f64| {
        let parts = parts
            .clone()
            .map(|part| part.into_iter().map(|v| Interval::around(v, radius)).collect());
        check(&PlaneNet::new(annulus, 1, true, parts).unwrap())
    };
    let (regular, winding) = wide(1e-3);
    assert_eq!((regular.status, winding.number), (Status::Proven, Some(1)));
    let (regular, winding) = wide(10.0);
    assert_eq!((regular.status, winding.status), (Status::Undecided, Status::Undecided));
    assert!(regular.margin() < 0.0 && regular.margin().is_finite());
    let unknown = vec![Interval::ENTIRE; annulus.numbering.count()];
    let (regular, winding) = check(&PlaneNet::new(annulus, 1, true, [unknown.clone(), unknown]).unwrap());
    assert_eq!((regular.status, winding.status), (Status::Undecided, Status::Undecided));
}

#[test]
fn evidence_of_the_wrong_shape_proves_nothing() {
    let net = net(&catmull_clark(6).unwrap(), 1);
    for patches in [Vec::new(), vec![Subdivision::whole(); 5]] {
        assert_eq!(
            regular(
                &net,
                &JacobianEvidence::Sign {
                    positive: true,
                    patches: patches.clone()
                }
            )
            .status,
            Status::Undecided
        );
        assert_eq!(winding(&net, &patches).status, Status::Undecided);
    }
    let JacobianEvidence::Sign { patches, .. } = find::jacobian(&net, Limits::default()) else {
        panic!("it is regular")
    };
    let mirrored = regular(
        &net,
        &JacobianEvidence::Sign {
            positive: false,
            patches,
        },
    );
    assert_eq!(mirrored.status, Status::Undecided);
    let inside = Place {
        sector: 0,
        p: 1,
        q: 0,
        u: 0.5,
        v: 0.5,
    };
    for place in [
        Place { p: 0, ..inside },
        Place { q: 2, ..inside },
        Place { u: 1.5, ..inside },
        Place { v: f64::NAN, ..inside },
        Place { sector: 6, ..inside },
    ] {
        assert_eq!(
            regular(
                &net,
                &JacobianEvidence::Fold {
                    places: [place, inside]
                }
            )
            .status,
            Status::Undecided
        );
    }
}

#[test]
fn nets_that_do_not_fit_are_refused() {
    let scheme = catmull_clark::<f64>(5).unwrap();
    let annulus = Annulus::new(&scheme).unwrap();
    let (_, [x, y]) = mode(&scheme, annulus, 1);
    let (x, y) = (widened(&x), widened(&y));
    let short = vec![Interval::point(0.0); 3];
    assert!(matches!(
        PlaneNet::new(annulus, 1, true, [short, y.clone()]),
        Err(NetError::Length { found: 3, .. })
    ));
    assert!(matches!(
        PlaneNet::new(annulus, 5, true, [x.clone(), y.clone()]),
        Err(NetError::Fourier { .. })
    ));
    assert!(matches!(
        PlaneNet::new(annulus, 2, true, [x.clone(), y.clone()]),
        Err(NetError::Symmetry { .. })
    ));
    let mut spoilt = x.clone();
    spoilt[7] += Interval::point(1e-9);
    assert!(matches!(
        PlaneNet::new(annulus, 1, true, [spoilt, y.clone()]),
        Err(NetError::Symmetry { .. })
    ));
    let linear = Annulus { degree: 1, ..annulus };
    assert!(matches!(
        PlaneNet::new(linear, 1, true, [x.clone(), y.clone()]),
        Err(NetError::Degree { degree: 1 })
    ));
    let net = PlaneNet::new(annulus, 1, true, [x.clone(), y]).unwrap();
    assert!(matches!(
        Heights::new(&net, 0, vec![x.clone(), x.clone()]),
        Err(NetError::Parts { expected: 1, .. })
    ));
    assert!(matches!(Heights::new(&net, 0, vec![x]), Err(NetError::Symmetry { .. })));
}

#[test]
fn reflection_halves_the_work_and_changes_nothing() {
    let scheme = catmull_clark::<f64>(9).unwrap();
    let annulus = Annulus::at_least(&scheme, 2).unwrap();
    let (_, parts) = mode(&scheme, annulus, 1);
    let parts = parts.map(|part| widened(&part));
    let nets = [true, false].map(|mirror| PlaneNet::new(annulus, 1, mirror, parts.clone()).unwrap());
    assert_eq!(nets.each_ref().map(|net| net.patches().len()), [7, 12]);
    let [half, full] = nets.each_ref().map(|net| check(net).0);
    assert_eq!(half.status, full.status);
    assert!((half.margin() - full.margin()).abs() < 1e-9);
}

#[test]
fn corner_angles_are_those_of_the_configuration() {
    // N = 4: V E F is half a square; bicubic B-splines have theta = pi/4
    let corner_of = |valence: usize| corner(&net(&catmull_clark(valence).unwrap(), 1)).unwrap();
    let regular = corner_of(4);
    assert!(regular.theta.contains(std::f64::consts::FRAC_PI_4) && regular.theta.width() < 1e-10);
    for valence in [3, 5, 8, 20] {
        let corner = corner_of(valence);
        assert_eq!((corner.convex, corner.within), (Status::Proven, Status::Proven));
        // E = 1 and F = r e^(i pi/N): the angle at F of the triangle 0, 1, F
        let scheme = catmull_clark::<f64>(valence).unwrap();
        let annulus = Annulus::new(&scheme).unwrap();
        let (_, [x, y]) = mode(&scheme, annulus, 1);
        let f = annulus.numbering.index(Site { sector: 0, x: 2, y: 2 }).unwrap();
        let angle = y[f].atan2(x[f]) + (y[f]).atan2(1.0 - x[f]);
        assert!((corner.theta.mid() - (std::f64::consts::PI - angle)).abs() < 1e-11);
    }
    let folded = corner(&moved(5, (2, 2), 0.3).unwrap()).unwrap();
    assert_eq!((folded.convex, folded.within), (Status::Refuted, Status::Refuted));
}

/// The heights of the second-order maps and the signs they should have.
pub(super) fn heights(net: &PlaneNet<Interval>, maps: &Maps) -> Vec<(Sign, Heights<Interval>)> {
    let n = net.sectors();
    let [cup, re, im] = maps.second_order.each_ref().map(|z| widened(z));
    let cup = (Sign::Positive, Heights::new(net, 0, vec![cup]).unwrap());
    let saddles = if SecondOrder::copies_in(n, 2) == 2 {
        vec![
            Heights::new(net, 2, vec![re]).unwrap(),
            Heights::new(net, 2, vec![im]).unwrap(),
        ]
    } else {
        vec![Heights::new(net, 2, vec![re, im]).unwrap()]
    };
    let saddles = saddles.into_iter().map(|heights| (Sign::Negative, heights));
    std::iter::once(cup).chain(saddles).collect()
}

fn curvatures(scheme: &Scheme<f64>, limits: Limits) -> (Maps, Vec<CurvatureRange>) {
    let maps = Maps::on(scheme, Annulus::at_least(scheme, 2).unwrap()).unwrap();
    let natural = maps.natural.each_ref().map(|part| widened(part));
    let net = PlaneNet::new(maps.annulus, 1, true, natural).unwrap();
    let ranges = heights(&net, &maps).into_iter().flat_map(|(sign, heights)| {
        let evidence = find::curvature(&net, &heights, sign, limits);
        curvature(&net, &heights, sign, &evidence).unwrap()
    });
    let ranges = ranges.collect();
    (maps, ranges)
}

#[test]
fn curvature_signs_of_known_maps() {
    for valence in [3, 4, 5, 6, 7, 12] {
        let scheme = catmull_clark::<f64>(valence).unwrap();
        let (maps, ranges) = curvatures(
            &scheme,
            Limits {
                tolerance: 1e-2,
                ..Limits::default()
            },
        );
        assert_eq!(ranges.len(), 3);
        for (which, range) in ranges.iter().enumerate() {
            // every value on a grid over all sectors is on the right side of the extreme, which some come
            // close to
            let norm = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>();
            let factor = norm(&maps.natural[0]).powi(2) / norm(&maps.second_order[which]);
            let mut nearest = f64::INFINITY;
            for patch in (0..valence).flat_map(|sector| maps.annulus.patches(sector)) {
                for at in (0..25).map(|i| [f64::from(i % 5) / 4.0, f64::from(i / 5) / 4.0]) {
                    let gauss = factor * maps.graph(which, patch, at[0], at[1]).gauss();
                    let excess = if which == 0 {
                        gauss - range.extreme.lo()
                    } else {
                        range.extreme.hi() - gauss
                    };
                    let slack = 1e-9 * range.extreme.mag();
                    assert!(excess >= -slack, "{valence} {which} {gauss} {range:?}");
                    nearest = nearest.min(excess);
                }
            }
            assert!(
                nearest <= 0.3 * range.extreme.mag(),
                "{valence} {which} {nearest} {range:?}"
            );
            assert!(
                range.extreme.width() <= 0.02 * range.extreme.mag(),
                "{valence} {which} {range:?}"
            );
            assert_eq!(range.status, Status::Proven, "{valence} {which} {range:?}");
        }
    }
}

#[test]
fn a_change_of_curvature_sign_is_caught_with_its_place() {
    // a cup with a share of saddle in one block is not rotation-symmetric; a cup pressed in at its middle is
    let scheme = catmull_clark::<f64>(6).unwrap();
    let maps = Maps::on(&scheme, Annulus::at_least(&scheme, 2).unwrap()).unwrap();
    let net = PlaneNet::new(maps.annulus, 1, true, maps.natural.each_ref().map(|part| widened(part))).unwrap();
    let mut cup = maps.second_order[0].clone();
    for (index, site) in maps.annulus.numbering.sites().into_iter().enumerate() {
        if site.ring() == 3 {
            cup[index] *= 1.3;
        }
    }
    let heights = Heights::new(&net, 0, vec![widened(&cup)]).unwrap();
    let evidence = find::curvature(&net, &heights, Sign::Positive, Limits::default());
    let [range] = <[_; 1]>::try_from(curvature(&net, &heights, Sign::Positive, &evidence).unwrap()).unwrap();
    assert_eq!(range.status, Status::Refuted);
    let place = range.place.unwrap();
    let patch = PatchIndex {
        sector: place.sector,
        p: place.p,
        q: place.q,
    };
    let bent = Maps {
        second_order: [cup, maps.second_order[1].clone(), maps.second_order[2].clone()],
        ..maps
    };
    assert!(bent.graph(0, patch, place.u, place.v).gauss() < 0.0);
    // evidence for another net is refused
    let short = CurvatureEvidence {
        patches: evidence.patches[1..].to_vec(),
        ..evidence.clone()
    };
    assert_eq!(curvature(&net, &heights, Sign::Positive, &short), None);
    let nowhere = CurvatureEvidence {
        places: vec![Place { p: 9, ..place }],
        ..evidence
    };
    assert_eq!(curvature(&net, &heights, Sign::Positive, &nowhere), None);
}

#[test]
fn a_whole_range_of_maps_is_checked_at_once() {
    use eigenring_scheme::lambda::Relaxation;
    // corner points of ring 1 moved by a parameter: X = X0 + t X1 for all t at once
    let valence = 6;
    let plane = Relaxation::new(valence).unwrap().plane(0.55).unwrap();
    let natural = |f2: f64| {
        let scheme = plane.stencil(f2, 0.2).weights.scheme("lambda", valence).unwrap();
        Maps::new(&scheme).unwrap()
    };
    // E_0 = 1, and at fixed lambda and f3 the points are affine in f2 (through F of ring 1)
    let (low, high) = (natural(0.25), natural(0.27));
    let family = |k: usize| -> Vec<Centred<1>> {
        let pairs = low.natural[k].iter().zip(&high.natural[k]);
        pairs
            .map(|(&a, &b)| {
                let t = Centred::<1>::parameter(Interval::new(-1.0, 1.0).unwrap(), 0);
                let (mid, half) = (
                    Interval::around((a + b) / 2.0, 1e-11),
                    Interval::around((b - a) / 2.0, 1e-11),
                );
                Centred::constant(mid) + Centred::constant(half) * t
            })
            .collect()
    };
    let net = PlaneNet::new(low.annulus, 1, true, [family(0), family(1)]).unwrap();
    let limits = Limits::default();
    let over = regular(&net, &find::jacobian(&net, limits));
    assert_eq!(over.status, Status::Proven, "{over:?}");
    assert_eq!(winding(&net, &find::boundary(&net, limits)).number, Some(1));
    for f2 in [0.25, 0.256, 0.264, 0.27] {
        let maps = natural(f2);
        let one = PlaneNet::new(maps.annulus, 1, true, maps.natural.each_ref().map(|p| widened(p))).unwrap();
        let single = check(&one).0;
        assert!(over.margin() <= single.margin() + 1e-9, "{over:?} {single:?}");
        // plain intervals over the same range lose more
        let theta = corner(&one).unwrap().theta;
        assert!(corner(&net).unwrap().theta.intersect(theta).is_some());
    }
    let plain = [0, 1].map(|k| family(k).iter().map(Enclose::enclosure).collect::<Vec<Interval>>());
    let plain = PlaneNet::new(low.annulus, 1, true, plain).unwrap();
    let plain = regular(&plain, &find::jacobian(&plain, limits));
    assert!(plain.margin() < over.margin(), "{plain:?} {over:?}");
}

#[test]
fn evidence_reads_back() {
    let net = net(&catmull_clark(5).unwrap(), 1);
    let evidence = find::jacobian(&net, Limits::default());
    let text = serde_json::to_string(&evidence).unwrap();
    assert_eq!(serde_json::from_str::<JacobianEvidence>(&text).unwrap(), evidence);
    let result = regular(&net, &evidence);
    let text = serde_json::to_string(&result).unwrap();
    assert_eq!(serde_json::from_str::<Regularity>(&text).unwrap(), result);
}
