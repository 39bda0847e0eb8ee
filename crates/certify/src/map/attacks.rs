//! Evidence made to deceive: whatever it says, nothing false is proven or refuted.
//!
//! Claims: a subdivision that is accepted covers its whole once; a map that folds is never proven regular and
//! a regular one never refuted; a winding number that is claimed is the true one; a curvature of the wrong
//! sign is never proven and one of the right sign never refuted. Oracle: maps of which the truth is known.

use super::find::Limits;
use super::tests::{heights, mode, moved, net, widened};
use super::*;
use crate::Status;
use crate::interval::oracle::Operands;
use eigenring_scheme::families::catmull_clark;
use eigenring_spectral::Maps;

/// A text as a subdivision, as it would be read from a file.
fn tree(text: &str) -> Subdivision {
    serde_json::from_value(text.into()).expect("any text is read")
}

/// A text that is a tree, or nearly one or none where it is spoilt: `parts` is the number of pieces of a cut.
fn text(operands: &mut Operands, parts: usize, spoilt: bool) -> String {
    let mut text = String::new();
    let mut open = 1;
    let (many, limit) = (operands.below(4), 1 + operands.below(60));
    while open > 0 {
        let cut = text.len() < limit && operands.below(4) <= many;
        text.push(if cut { '1' } else { '0' });
        open = if cut { open + parts - 1 } else { open - 1 };
    }
    match operands.below(5) {
        _ if !spoilt => {}
        // cut off, a part twice, a wrong symbol, too deep, empty
        0 => text.truncate(operands.below(text.len())),
        1 => text.push('0'),
        2 => text.insert(operands.below(text.len()), ['2', 'x', ' ', '\u{e9}'][operands.below(4)]),
        3 => text.insert_str(0, &"1".repeat(25)),
        _ => text.clear(),
    }
    text
}

fn trees(operands: &mut Operands, count: usize, parts: usize) -> Vec<Subdivision> {
    let count = match operands.below(12) {
        0 => 0,
        1 => count + 1,
        2 => count - 1,
        _ => count,
    };
    // one in two lists has a tree that is none
    let spoilt = operands.below(2 * count.max(1));
    (0..count)
        .map(|at| tree(&text(operands, parts, at == spoilt)))
        .collect()
}

/// A place, mostly one of the annulus.
fn place(operands: &mut Operands, annulus: &Annulus) -> Place {
    let inner = annulus.inner;
    let mut step = || match operands.below(20) {
        0 => usize::MAX,
        1 => 2 * inner,
        _ => operands.below(2 * inner),
    };
    let (p, q) = (step(), step());
    let mut parameter = || match operands.below(10) {
        0 => 0.0,
        1 => 1.0,
        2 => [
            -0.0,
            1.0_f64.next_up(),
            -f64::MIN_POSITIVE,
            f64::NAN,
            f64::INFINITY,
            1e300,
        ][operands.below(6)],
        _ => operands.fraction(),
    };
    let (u, v) = (parameter(), parameter());
    let sectors = annulus.numbering.fan.sectors();
    let beyond = usize::from(operands.below(8) == 0);
    let sector = operands.below(sectors + beyond);
    Place { sector, p, q, u, v }
}

#[test]
fn what_is_accepted_as_a_subdivision_covers_the_square_once() {
    let mut operands = Operands::new(31);
    let (mut accepted, mut refused) = (0, 0);
    let quarters = |[x, y, size]: &[u64; 3]| {
        let half = size / 2;
        [[0, 0], [half, 0], [0, half], [half, half]]
            .map(|[a, b]| [x + a, y + b, half])
            .to_vec()
    };
    for _ in 0..2000 {
        let mut cells: Vec<[u64; 3]> = Vec::new();
        let spoilt = operands.below(2) == 0;
        let walk = tree(&text(&mut operands, 4, spoilt))
            .walk([0, 0, 1 << MAX_DEPTH], &quarters, &mut |cell| cells.push(*cell));
        let Some(walk) = walk else {
            refused += 1;
            continue;
        };
        accepted += 1;
        assert_eq!(walk.cells, cells.len());
        assert!(cells.iter().all(|cell| cell[2] > 0));
        // squares of one tree are nested or disjoint: with the whole area and no two at one corner they cover
        // it once
        assert_eq!(
            cells.iter().map(|cell| cell[2] * cell[2]).sum::<u64>(),
            1 << (2 * MAX_DEPTH)
        );
        cells.sort_unstable();
        assert!(cells.windows(2).all(|pair| pair[0][..2] != pair[1][..2]));
    }
    assert!(accepted > 500 && refused > 500, "{accepted} {refused}");
}

#[test]
fn no_evidence_proves_a_fold_regular_or_refutes_a_regular_map() {
    let mut operands = Operands::new(32);
    let sound = net(&catmull_clark(5).unwrap(), 1);
    let folded = moved(5, (4, 4), -1.0).unwrap();
    let (mut proven, mut refuted) = (0, 0);
    for round in 0..1500 {
        let evidence = if round % 2 == 0 {
            JacobianEvidence::Sign {
                positive: operands.below(2) == 0,
                patches: trees(&mut operands, sound.patches().len(), 4),
            }
        } else {
            let first = place(&mut operands, sound.annulus());
            let second = match operands.below(4) {
                0 => first,
                _ => place(&mut operands, sound.annulus()),
            };
            JacobianEvidence::Fold {
                places: [first, second],
            }
        };
        let positive = !matches!(evidence, JacobianEvidence::Sign { positive: false, .. });
        match regular(&sound, &evidence).status {
            Status::Proven => {
                assert!(positive, "{evidence:?}");
                proven += 1;
            }
            status => assert_eq!(status, Status::Undecided, "{evidence:?}"),
        }
        match regular(&folded, &evidence).status {
            Status::Refuted => refuted += 1,
            status => assert_eq!(status, Status::Undecided, "{evidence:?}"),
        }
    }
    assert!(proven > 50 && refuted > 5, "{proven} {refuted}");
}

#[test]
fn no_evidence_gives_another_winding_number() {
    let mut operands = Operands::new(33);
    let nets: Vec<(i64, PlaneNet<Interval>)> = vec![
        (1, net(&catmull_clark(3).unwrap(), 1)),
        (1, net(&catmull_clark(7).unwrap(), 1)),
        (2, net(&catmull_clark(6).unwrap(), 2)),
        (3, net(&catmull_clark(9).unwrap(), 3)),
    ];
    let mut decided = 0;
    for round in 0..4000 {
        let (number, net) = &nets[round % 4];
        let curves = winding::boundary(net).len();
        let found = winding(net, &trees(&mut operands, curves, 2));
        if let Some(found) = found.number {
            assert_eq!(found, *number);
            decided += 1;
        }
        let allowed = if *number == 1 { Status::Proven } else { Status::Refuted };
        assert!(found.status == allowed || found.status == Status::Undecided);
        assert_eq!(found.status == Status::Undecided, found.number.is_none());
    }
    assert!(decided > 100, "{decided}");
}

#[test]
fn a_map_that_vanishes_is_neither_regular_nor_injective() {
    let annulus = Annulus::new(&catmull_clark::<f64>(5).unwrap()).unwrap();
    let zeros = vec![Interval::point(0.0); annulus.numbering.count()];
    let flat = PlaneNet::new(annulus, 1, true, [zeros.clone(), zeros]).unwrap();
    let mut operands = Operands::new(34);
    for _ in 0..200 {
        for positive in [true, false] {
            let patches = trees(&mut operands, flat.patches().len(), 4);
            let found = regular(&flat, &JacobianEvidence::Sign { positive, patches });
            assert_eq!(found.status, Status::Undecided);
            assert!(found.margin() <= 0.0);
        }
        let curves = winding::boundary(&flat).len();
        assert_eq!(
            winding(&flat, &trees(&mut operands, curves, 2)).status,
            Status::Undecided
        );
    }
    let corner = corner(&flat).unwrap();
    assert_eq!(corner.within, Status::Undecided);
    assert_ne!(corner.convex, Status::Proven);
}

#[test]
fn no_evidence_gives_a_curvature_another_sign() {
    let mut operands = Operands::new(35);
    let (mut proven, mut refuted) = (0, 0);
    for valence in [3, 4, 5, 6] {
        let scheme = catmull_clark::<f64>(valence).unwrap();
        let maps = Maps::on(&scheme, Annulus::at_least(&scheme, 2).unwrap()).unwrap();
        let natural = maps.natural.each_ref().map(|part| widened(part));
        let net = PlaneNet::new(maps.annulus, 1, true, natural).unwrap();
        for (sign, heights) in heights(&net, &maps) {
            let honest = find::curvature(&net, &heights, sign, Limits::default());
            let opposite = match sign {
                Sign::Positive => Sign::Negative,
                Sign::Negative => Sign::Positive,
            };
            for round in 0..12 {
                let mut evidence = honest.clone();
                if round % 2 == 0 {
                    evidence.patches = trees(&mut operands, evidence.patches.len(), 4);
                }
                if round % 3 != 0 {
                    evidence.places = honest
                        .places
                        .iter()
                        .map(|_| place(&mut operands, net.annulus()))
                        .collect();
                }
                match round {
                    10 => evidence.places.clear(),
                    11 => evidence.places.push(honest.places[0]),
                    _ => {}
                }
                for (wanted, wrong) in [(sign, Status::Refuted), (opposite, Status::Proven)] {
                    let ranges = curvature(&net, &heights, wanted, &evidence);
                    assert!(round < 10 || ranges.is_none());
                    for range in ranges.into_iter().flatten() {
                        assert_ne!(range.status, wrong, "{valence} {evidence:?}");
                        proven += usize::from(range.status == Status::Proven);
                        refuted += usize::from(range.status == Status::Refuted);
                    }
                }
            }
        }
    }
    assert!(proven > 20 && refuted > 20, "{proven} {refuted}");
}

/// The signs of the phase: the values of each saddle in each sector are those of the turned map there.
#[test]
fn curvatures_in_other_sectors_are_those_of_the_maps_there() {
    let valence = 7;
    let scheme = catmull_clark::<f64>(valence).unwrap();
    let maps = Maps::on(&scheme, Annulus::at_least(&scheme, 2).unwrap()).unwrap();
    let natural = maps.natural.each_ref().map(|part| widened(part));
    let net = PlaneNet::new(maps.annulus, 1, true, natural).unwrap();
    let [_, (sign, heights)] = <[_; 2]>::try_from(heights(&net, &maps)).unwrap();
    let honest = find::curvature(&net, &heights, sign, Limits::default());
    let norm = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>();
    for sector in 0..valence {
        let at = Place {
            sector,
            p: 2,
            q: 1,
            u: 0.25,
            v: 0.75,
        };
        let evidence = CurvatureEvidence {
            places: vec![at; 2],
            ..honest.clone()
        };
        let ranges = curvature(&net, &heights, sign, &evidence).unwrap();
        for (which, range) in ranges.iter().enumerate() {
            let factor = norm(&maps.natural[0]).powi(2) / norm(&maps.second_order[1 + which]);
            let patch = PatchIndex { sector, p: 2, q: 1 };
            let gauss = factor * maps.graph(1 + which, patch, 0.25, 0.75).gauss();
            // the inner bound of the extreme is the value at the place, which is the lower one of a saddle
            assert!(
                (range.extreme.lo() - gauss).abs() < 1e-6 * gauss.abs(),
                "{sector} {which} {gauss} {range:?}"
            );
        }
    }
}

/// Ranges of numbers, and numbers that are not known, prove nothing by any evidence.
#[test]
fn what_is_unknown_is_never_decided() {
    let annulus = Annulus::new(&catmull_clark::<f64>(5).unwrap()).unwrap();
    let (_, parts) = mode(&catmull_clark(5).unwrap(), annulus, 1);
    for spoilt in [Interval::ENTIRE, Interval::new(-1e300, 1e300).unwrap()] {
        let parts = parts.clone().map(|part| {
            let mut part = widened(&part);
            part.iter_mut().for_each(|x| *x = x.hull(spoilt));
            part
        });
        let net = PlaneNet::new(annulus, 1, true, parts).unwrap();
        let mut operands = Operands::new(36);
        for _ in 0..50 {
            let patches = trees(&mut operands, net.patches().len(), 4);
            let places = [place(&mut operands, &annulus), place(&mut operands, &annulus)];
            for evidence in [
                JacobianEvidence::Sign {
                    positive: true,
                    patches,
                },
                JacobianEvidence::Fold { places },
            ] {
                assert_eq!(regular(&net, &evidence).status, Status::Undecided);
            }
            let curves = winding::boundary(&net).len();
            assert_eq!(
                winding(&net, &trees(&mut operands, curves, 2)).status,
                Status::Undecided
            );
        }
        let corner = corner(&net).unwrap();
        assert_eq!((corner.convex, corner.within), (Status::Undecided, Status::Undecided));
    }
}
