//! Natural configurations as drawings: the net of the characteristic map, its inner rings.

use super::sheet::{Turn, shrinking};
use crate::error::Error;
use crate::table::{Cell, Table};
use eigenring_figure::{Chart, Colour, LINE, Marker, Style};
use eigenring_scheme::{Level, Scheme, Site};
use eigenring_spectral::{LocalSystem, Natural};
use std::collections::BTreeMap;

/// The inner rings of a natural configuration, its first point (1, 0) turned so that a sector's bisector
/// points up.
#[derive(Clone, Debug)]
pub struct NaturalNet {
    /// The subdominant eigenvalue.
    pub lambda: f64,
    /// Points with their rings, in the order of the numbering.
    pub points: Vec<(usize, [f64; 2])>,
    /// Faces with their outer rings, corners in turn.
    pub faces: Vec<(usize, Vec<[f64; 2]>)>,
    centre: bool,
}

impl NaturalNet {
    /// As many rings of faces as given around a vertex, half a ring less around a face.
    pub fn new(scheme: &Scheme<f64>, rings: usize) -> Result<Self, Error> {
        NaturalNet::at(scheme, scheme.limit(), rings)
    }

    /// The net of one of the scheme's levels.
    pub fn at(scheme: &Scheme<f64>, level: &Level<f64>, rings: usize) -> Result<Self, Error> {
        let parity = scheme.lattice().parity();
        let numbering = scheme.numbering(if parity == 0 { rings } else { rings.saturating_sub(1) });
        // an eigenvector of more rings continues that of fewer
        let closed = scheme.closed_rings()?.max(numbering.rings);
        let Natural { lambda, points: [x, y] } = shrinking(&LocalSystem::new(level, closed)?)?;
        let sectors = numbering.fan.sectors();
        let turn = Turn::upright(numbering.lattice, sectors);
        let points = numbering.sites().into_iter().enumerate();
        let points = points.map(|(index, site)| (site.ring(), turn.plane([x[index], y[index]])));
        let mut net = NaturalNet {
            lambda,
            points: points.collect(),
            faces: Vec::new(),
            centre: parity == 0,
        };
        let corner = |sector: usize, x: i32, y: i32| {
            let index = numbering.index(Site::new(numbering.fan, sector as i64, x, y)?)?;
            Some(net.points[index])
        };
        let mut faces = Vec::new();
        if parity != 0 {
            let corners: Option<Vec<_>> = (0..sectors).map(|sector| corner(sector, 1, 1)).collect();
            faces.extend(corners);
        }
        // around a face the first column lies across the spoke between two sectors
        let last = 2 * numbering.rings as i32 + parity;
        for sector in 0..sectors {
            for x in (-parity..last).step_by(2) {
                for y in (parity..last).step_by(2) {
                    let corners = [(x, y), (x + 2, y), (x + 2, y + 2), (x, y + 2)];
                    let corners: Option<Vec<_>> = corners.iter().map(|&(x, y)| corner(sector, x, y)).collect();
                    faces.extend(corners);
                }
            }
        }
        net.faces = faces
            .into_iter()
            .map(|corners| {
                let ring = corners.iter().map(|corner| corner.0).max().unwrap_or(0);
                (ring, corners.into_iter().map(|corner| corner.1).collect())
            })
            .collect();
        Ok(net)
    }

    /// Half the side of the smallest square around the centre that holds all points.
    pub fn radius(&self) -> f64 {
        let coordinates = self.points.iter().flat_map(|(_, point)| point).map(|c| c.abs());
        coordinates.fold(0.0, f64::max)
    }

    /// The net as it can be read, and what a title adds if that is not the net itself: where many sectors
    /// crowd around the centre, radii become `log(1 + r/r_1)`, with r_1 the smallest of ring 1, in proportion
    /// to the rim; edges join their points as before.
    pub fn readable(&self) -> (NaturalNet, &'static str) {
        let around = |ring: usize| self.points.iter().filter(move |point| point.0 == ring);
        let radii = around(1).map(|(_, [x, y])| x.hypot(*y));
        let first = radii.fold(f64::INFINITY, f64::min);
        let crowded = around(1).count() > 2 * LARGE && first < CROWDED * self.radius();
        if !(crowded && first > 0.0) {
            return (self.clone(), "");
        }
        let rim = (1.0 + self.radius() / first).ln();
        let place = |[x, y]: [f64; 2]| {
            let r = x.hypot(y);
            let scale = if r > 0.0 {
                (1.0 + r / first).ln() / (rim * r)
            } else {
                1.0
            };
            [scale * x, scale * y]
        };
        let net = NaturalNet {
            points: self.points.iter().map(|&(ring, point)| (ring, place(point))).collect(),
            faces: self
                .faces
                .iter()
                .map(|(ring, corners)| (*ring, corners.iter().map(|&corner| place(corner)).collect()))
                .collect(),
            ..*self
        };
        (net, ", log radii")
    }

    /// A table of nets: columns that tell them apart, then ring and coordinates.
    pub fn table(keys: &[&str]) -> Table {
        Table::new(keys.iter().copied().chain(["ring", "x", "y"]))
    }

    /// Adds the points, with what tells this net apart.
    pub fn push(&self, table: &mut Table, keys: &[Cell]) {
        for (ring, [x, y]) in &self.points {
            let own = [(*ring).into(), (*x).into(), (*y).into()];
            table.push(keys.iter().cloned().chain(own).collect());
        }
    }

    /// The sides of the faces, each once.
    fn edges(&self) -> Vec<[[f64; 2]; 2]> {
        let mut edges = BTreeMap::new();
        for (_, corners) in &self.faces {
            let next = corners.iter().cycle().skip(1);
            for (&a, &b) in corners.iter().zip(next) {
                let bits = |p: [f64; 2]| p.map(f64::to_bits);
                edges
                    .entry((bits(a).min(bits(b)), bits(a).max(bits(b))))
                    .or_insert([a, b]);
            }
        }
        edges.into_values().collect()
    }

    /// The net, drawn to fill a square. Lines are thinner where they are many, and dots smaller than what
    /// separates them, down to none.
    pub fn chart(&self) -> Chart {
        let side = 1.06 * self.radius();
        let colour = Colour::line(0);
        let tint = |ring: usize| Colour::WHITE.mix(colour, [0.0, 0.38, 0.2, 0.08][ring.min(3)]);
        let fills = self
            .faces
            .iter()
            .map(|(ring, corners)| (corners.clone(), tint(*ring + usize::from(!self.centre))));
        let chart = Chart::map((-side, side), (-side, side)).areas(fills);
        // lengths on a page where the square is as wide as in the figures of many nets
        let length = |[a, b]: &[[f64; 2]; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) * USUAL / (2.0 * side);
        let edges = self.edges();
        let mut lengths: Vec<f64> = edges.iter().map(length).collect();
        lengths.sort_by(f64::total_cmp);
        let middle = lengths.get(lengths.len() / 2).copied().unwrap_or(USUAL);
        let width = (0.12 * middle).clamp(0.06, 0.6 * LINE);
        let gap = [f64::NAN; 2];
        let lines = edges.iter().flat_map(|[a, b]| [*a, *b, gap]);
        let mut chart = chart.series(lines, Style::solid(colour).wide(width));
        // the shortest side at each point
        let mut room: BTreeMap<[u64; 2], f64> = BTreeMap::new();
        for edge in &edges {
            for end in edge {
                let shortest = room.entry(end.map(f64::to_bits)).or_insert(f64::INFINITY);
                *shortest = shortest.min(length(edge));
            }
        }
        let room = |point: [f64; 2]| room.get(&point.map(f64::to_bits)).copied().unwrap_or(USUAL);
        let outer = self
            .points
            .iter()
            .skip(usize::from(self.centre))
            .map(|(_, point)| *point);
        let outer: Vec<[f64; 2]> = outer.collect();
        let usual = (0.22 * middle).min(DOT);
        let fits = |radius: f64| move |room: f64| radius >= LEAST && radius <= ROOM * room;
        let (large, small) = (fits(usual), fits(usual / 2.0));
        let here = outer.iter().copied().filter(|&p| large(room(p)));
        chart = chart.series(here, dots(colour, usual));
        let here = outer.iter().copied().filter(|&p| !large(room(p)) && small(room(p)));
        chart = chart.series(here, dots(colour, usual / 2.0));
        let middle = self.centre.then_some(self.points[0].1);
        let radius = middle.map_or(0.0, |centre| (ROOM * room(centre)).clamp(LEAST, 0.8));
        chart.series(middle, dots(Colour::line(1), radius))
    }
}

/// The largest valence whose nets are always drawn in proportion, and the radius of ring 1, relative to the
/// rim, below which larger ones are not.
const LARGE: usize = 12;
const CROWDED: f64 = 0.3;

/// The width of the square in the figures of many nets, in millimetres.
const USUAL: f64 = 36.0;
/// The usual radius of dots and the least one, and how much of the way to the next point one may take.
const DOT: f64 = 0.42;
const LEAST: f64 = 0.16;
const ROOM: f64 = 0.35;

fn dots(colour: Colour, radius: f64) -> Style {
    let mut style = Style::points(Marker::Disc, colour);
    style.marker = Some((Marker::Disc, radius));
    style
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::families::catmull_clark;

    #[test]
    fn the_regular_net_is_the_integer_grid() {
        let net = NaturalNet::new(&catmull_clark(4).unwrap(), 3).unwrap();
        assert_eq!((net.points.len(), net.faces.len()), (49, 36));
        assert!(
            (net.radius() - 3.0 * 2f64.sqrt()).abs() < 1e-9,
            "turned by 45 degrees: {}",
            net.radius()
        );
        let area: f64 = net
            .faces
            .iter()
            .map(|(_, face)| (face[0][0] - face[2][0]).hypot(face[0][1] - face[2][1]).powi(2) / 2.0)
            .sum();
        assert!((area - 36.0).abs() < 1e-9);
    }

    #[test]
    fn crowded_rings_are_spread_by_logarithms() {
        let scheme = |spec: &str, n| {
            spec.parse::<eigenring_scheme::Spec>()
                .unwrap()
                .scheme::<f64>(n)
                .unwrap()
        };
        for (spec, valence, crowded) in [
            ("lambda:lambda=0.35", 20, true),
            ("lambda:lambda=0.35", 12, false),
            ("lambda:optimal", 20, false),
        ] {
            let net = NaturalNet::new(&scheme(spec, valence), 3).unwrap();
            let (drawn, title) = net.readable();
            assert_eq!(!title.is_empty(), crowded, "{spec} {valence}");
            assert!(crowded || drawn.points == net.points);
            let polar = |net: &NaturalNet, i: usize| {
                let [x, y] = net.points[i].1;
                (x.hypot(y), y.atan2(x))
            };
            for i in 1..net.points.len() {
                let ((r, angle), (radius, same)) = (polar(&net, i), polar(&drawn, i));
                assert!(
                    (angle - same).abs() < 1e-12 && (!crowded || radius >= r / net.radius() - 1e-9),
                    "{spec} {i}"
                );
            }
        }
    }

    #[test]
    fn one_face_for_each_pair_of_coordinates_and_sector() {
        for valence in [3, 5, 20] {
            let net = NaturalNet::new(&catmull_clark(valence).unwrap(), 3).unwrap();
            assert_eq!(net.faces.len(), 9 * valence);
            assert_eq!(net.points.len(), 1 + 12 * valence);
            // Euler: V - E + F = 1 of a disc
            assert_eq!(net.points.len() + net.faces.len() - net.edges().len(), 1);
        }
    }
}
