//! **Claim**: a level that is said to refine B-splines of degree d does so across every spoke. **Oracle**:
//! where four sectors meet the lattice is the plane, and a point that no special stencil makes is the tensor
//! product of two binomial masks; the places are worked out here, without the folding of the library.

use eigenring_scheme::{Exact, Fan, Lattice, Level, Line, Pass, PointNet, Scalar, Site, refine};
use proptest::prelude::*;

/// Rules between nets, some of which lean to one side.
fn lines(from: Lattice, to: Lattice) -> Vec<Line<Exact>> {
    let r = |p, q| Exact::ratio(p, q);
    let pairs = |offsets: &[i32]| {
        let share = r(1, offsets.len() as i64);
        Line::new(vec![offsets.iter().map(|&offset| (offset, share.clone())).collect()])
    };
    match (from, to) {
        (Lattice::Vertex, Lattice::Vertex) | (Lattice::Face, Lattice::Face) => vec![
            pairs(&[0, 2]),
            pairs(&[0, -2]),
            pairs(&[2]),
            pairs(&[-2]),
            pairs(&[-2, 0, 2]),
            Line::smoothing(r(1, 1)),
        ],
        _ => vec![
            pairs(&[-1, 1]),
            pairs(&[1]),
            pairs(&[-1]),
            pairs(&[1, 3]),
            pairs(&[-1, -3]),
        ],
    }
}

fn refinements(from: Lattice) -> Vec<Line<Exact>> {
    let half = || Exact::ratio(1, 2);
    match from {
        Lattice::Vertex => vec![
            Line::midpoint(),
            Line::cubic(),
            Line::new(vec![vec![(0, half()), (4, half())], vec![(-2, Exact::one())]]),
        ],
        Lattice::Face => vec![
            Line::corner_cutting(Exact::one()),
            Line::new(vec![vec![(1, Exact::one())], vec![(-1, Exact::one())]]),
            Line::new(vec![vec![(1, half()), (-3, half())], vec![(-1, half()), (3, half())]]),
        ],
    }
}

fn other(lattice: Lattice) -> Lattice {
    if lattice == Lattice::Vertex {
        Lattice::Face
    } else {
        Lattice::Vertex
    }
}

/// A chain of passes: the refinement, then steps that stay or change to the other net and back.
fn level(start: Lattice, first: usize, steps: &[(bool, usize)]) -> Option<Level<Exact>> {
    let refinement = refinements(start);
    let mut passes = vec![Pass::regular(
        start,
        start,
        refinement[first % refinement.len()].clone(),
    )];
    let mut at = start;
    for &(change, choice) in steps {
        let to = if change { other(at) } else { at };
        let choices = lines(at, to);
        passes.push(Pass::regular(at, to, choices[choice % choices.len()].clone()));
        at = to;
    }
    if at != start {
        passes.push(Pass::regular(at, start, Line::average()));
    }
    Level::new(Fan::Closed(4), passes).ok()
}

/// The place of a site in the plane, in half steps.
fn place(site: Site) -> (i32, i32) {
    let (mut x, mut y) = (site.x, site.y);
    for _ in 0..site.sector {
        (x, y) = (-y, x);
    }
    (x, y)
}

fn binomial_mask(degree: usize) -> Vec<f64> {
    let mut row = vec![1.0];
    for _ in 0..=degree {
        let mut next = vec![0.0; row.len() + 1];
        for (i, value) in row.iter().enumerate() {
            next[i] += value;
            next[i + 1] += value;
        }
        row = next;
    }
    row.iter().map(|c| c / 2.0_f64.powi(degree as i32)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn a_degree_is_that_of_the_whole_plane(
        face in any::<bool>(), first in 0..3_usize,
        steps in proptest::collection::vec((any::<bool>(), 0..6_usize), 0..5),
    ) {
        let start = if face { Lattice::Face } else { Lattice::Vertex };
        let Some(level) = level(start, first, &steps) else { return Ok(()) };
        let Some(degree) = level.spline_degree() else { return Ok(()) };
        let level = level.map(|weight| weight.to::<f64>().unwrap());
        let value = |(x, y): (i32, i32)| (1.1 * f64::from(x)).sin() + (0.6 * f64::from(y) + 0.3 * f64::from(x)).cos();
        let numbering = level.numbering(14);
        let points = numbering.sites().into_iter().map(|site| [value(place(site))]).collect();
        let wanted = level.numbering(4).sites();
        let found = refine(&level, &PointNet { numbering, points }, &wanted).unwrap();
        let mask = binomial_mask(degree);
        for (site, [found]) in wanted.into_iter().zip(found) {
            let (x, y) = place(site);
            let mut expected = 0.0;
            // the source s reaches the fine points 2 s + 2 j - (d + 1)
            let sources = |fine: i32| -> Vec<(i32, f64)> {
                let terms = mask.iter().enumerate().map(|(j, &weight)| (fine - 2 * j as i32 + degree as i32 + 1, weight));
                let parity = start.parity();
                terms.filter(|(twice, _)| twice % 2 == 0 && (twice / 2 - parity) % 2 == 0).map(|(twice, w)| (twice / 2, w)).collect()
            };
            for &(sx, wx) in &sources(x) {
                for &(sy, wy) in &sources(y) {
                    expected += wx * wy * value((sx, sy));
                }
            }
            prop_assert!((found - expected).abs() < 1e-12, "degree {}, {:?}: {} {}", degree, site, found, expected);
        }
    }
}
