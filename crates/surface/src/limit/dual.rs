//! Corner cutting (order 3) around a face: points sit on quads, one for each corner of a face of the control
//! mesh, and each quad is one biquadratic piece.
//!
//! A level cuts every quad into four, each with the point that its corner's cell gives by the scheme's rule
//! for as many sides as quads meet there.

use super::local::Local;
use crate::refine::{Row, Step, quads};
use crate::rules::Rules;
use crate::{Error, Mesh};
use eigenring_scheme::{Site, Table};
use nalgebra::Point3;

/// The part, refined once.
pub(crate) fn step(local: &Local, rules: &Rules) -> Result<Step, Error> {
    let topology = &local.topology;
    let fine = quads(&local.mesh, topology);
    let (mut table, mut halves, mut corners) = (Table::default(), Vec::new(), Vec::new());
    for half in 0..topology.half_count() as u32 {
        let fan = topology.fan(topology.origin(half));
        let n = fan.spokes.len();
        let place = fan.spokes.iter().position(|&spoke| spoke == half);
        let (Some(place), true) = (place, fan.is_closed() && n >= 3) else {
            continue;
        };
        let scheme = rules.inner(None, n)?;
        let stencil = scheme.limit().stencil(0, Site { sector: 0, x: 1, y: 1 })?;
        let terms = stencil.terms().iter();
        table.push(terms.map(|(site, w)| (topology.face(fan.spokes[(place + site.sector) % n]), *w)))?;
        halves.push(half);
        corners.extend_from_slice(fine.face(half as usize));
    }
    let old: Vec<[f64; 3]> = local.points().iter().map(|p| [p.x, p.y, p.z]).collect();
    let values = table.apply(&old)?.into_iter().map(Point3::from).collect();
    Ok(Step {
        mesh: Mesh::of_quads(fine.points().to_vec(), corners),
        tables: vec![table],
        halves,
        values: Some(values),
    })
}

/// The biquadratic piece of a regular quad as a bicubic one: rows of sixteen control points over the points
/// of the part, along s first.
pub(crate) fn control(local: &Local) -> [Row; 16] {
    let topology = &local.topology;
    // the quads of the 3 x 3 net, along s first
    let mut net = [Some(0_u32); 9];
    let sides = [(0, -1), (1, 0), (0, 1), (-1, 0)];
    let place = |x: i32, y: i32| (3 * (y + 1) + x + 1) as usize;
    for (half, (x, y)) in (0..4).zip(sides) {
        net[place(x, y)] = topology.twin(half).map(|twin| topology.face(twin));
        // across the corner at which the side begins
        let (before_x, before_y) = sides[(half as usize + 3) % 4];
        let opposite = topology.turned(half).and_then(|spoke| topology.turned(spoke));
        net[place(x + before_x, y + before_y)] = opposite.map(|spoke| topology.face(spoke));
    }
    // the piece is a0 + a1 t + a2 t^2 in each direction, and a cubic's control point is its blossom at three
    // integers: t has the mean -1, 0, 1, 2, t^2 the mean of products
    let power = [[0.5, 0.5, 0.0], [-1.0, 1.0, 0.0], [0.5, -1.0, 0.5]];
    let blossoms = [
        [1.0, -1.0, 2.0 / 3.0],
        [1.0, 0.0, -1.0 / 3.0],
        [1.0, 1.0, 2.0 / 3.0],
        [1.0, 2.0, 11.0 / 3.0],
    ];
    let raised = |i: usize, j: usize| -> f64 { (0..3).map(|k| blossoms[i][k] * power[k][j]).sum() };
    std::array::from_fn(|index| {
        let (i, j) = (index % 4, index / 4);
        let mut row = Row::new();
        for (at, quad) in net.iter().enumerate() {
            if let Some(quad) = quad {
                row.push((*quad, raised(i, at % 3) * raised(j, at / 3)));
            }
        }
        row
    })
}
