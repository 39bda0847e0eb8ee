//! Natural configurations as drawings: the net of the characteristic map, its inner rings.

use crate::error::Error;
use eigenring_figure::{Chart, Colour, LINE, Marker, Stroke, Style};
use eigenring_scheme::{Scheme, Site};
use eigenring_spectral::Maps;

/// The inner rings of a natural configuration, `E_0 = 1`, turned so that a sector's bisector points up.
#[derive(Clone, Debug)]
pub struct Net {
    /// Points with their rings, the centre first.
    pub points: Vec<(usize, [f64; 2])>,
    /// Faces with their rings, corners in turn.
    pub faces: Vec<(usize, [[f64; 2]; 4])>,
}

impl Net {
    /// The rings up to `rings` of a scheme around a vertex.
    pub fn new(scheme: &Scheme<f64>, rings: usize) -> Result<Self, Error> {
        let maps = Maps::new(scheme)?;
        let numbering = maps.annulus.numbering;
        let sectors = numbering.fan.sectors();
        let turn = std::f64::consts::PI * (0.5 - 1.0 / sectors as f64);
        let (sin, cos) = turn.sin_cos();
        let place = |sector: usize, a: usize, b: usize| {
            let site = Site::new(numbering.fan, sector as i64, 2 * a as i32, 2 * b as i32)?;
            let index = numbering.index(site)?;
            let [x, y] = [maps.natural[0][index], maps.natural[1][index]];
            Some([cos * x - sin * y, sin * x + cos * y])
        };
        let mut net = Net {
            points: vec![(0, [0.0, 0.0])],
            faces: Vec::new(),
        };
        for sector in 0..sectors {
            for (a, b) in (1..=rings).flat_map(|a| (0..=rings).map(move |b| (a, b))) {
                net.points.extend(place(sector, a, b).map(|point| (a.max(b), point)));
            }
            for (a, b) in (0..rings).flat_map(|a| (0..rings).map(move |b| (a, b))) {
                let corners = [(a, b), (a + 1, b), (a + 1, b + 1), (a, b + 1)].map(|(a, b)| place(sector, a, b));
                if let [Some(p), Some(q), Some(r), Some(s)] = corners {
                    net.faces.push((a.max(b) + 1, [p, q, r, s]));
                }
            }
        }
        Ok(net)
    }

    /// Half the side of the smallest square around the centre that holds all points.
    pub fn radius(&self) -> f64 {
        let coordinates = self.points.iter().flat_map(|(_, point)| point).map(|c| c.abs());
        coordinates.fold(0.0, f64::max)
    }

    /// The net, drawn to fill a square.
    pub fn chart(&self) -> Chart {
        let side = 1.06 * self.radius();
        let colour = Colour::line(0);
        let tint = |ring: usize| Colour::WHITE.mix(colour, [0.0, 0.38, 0.2, 0.08][ring.min(3)]);
        let fills = self.faces.iter().map(|(ring, corners)| (corners.to_vec(), tint(*ring)));
        let mut chart = Chart::map((-side, side), (-side, side)).areas(fills);
        for (_, corners) in &self.faces {
            chart = chart.outline(*corners, Stroke::solid(colour, 0.6 * LINE), None);
        }
        let mut dots = Style::points(Marker::Disc, colour);
        dots.marker = Some((Marker::Disc, 0.42));
        let mut centre = Style::points(Marker::Disc, Colour::line(1));
        centre.marker = Some((Marker::Disc, 0.8));
        let outer = self.points.iter().skip(1).map(|(_, point)| *point);
        chart.series(outer, dots).series([[0.0, 0.0]], centre)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::families::catmull_clark;

    #[test]
    fn the_regular_net_is_the_integer_grid() {
        let net = Net::new(&catmull_clark(4).unwrap(), 3).unwrap();
        assert_eq!((net.points.len(), net.faces.len()), (49, 36));
        assert!((net.radius() - 3.0 * 2f64.sqrt()).abs() < 1e-9, "{}", net.radius());
        let squares = net
            .faces
            .iter()
            .map(|(_, [p, _, r, _])| (p[0] - r[0]).hypot(p[1] - r[1]).powi(2) / 2.0);
        assert!((squares.sum::<f64>() - 36.0).abs() < 1e-9);
    }

    #[test]
    fn one_face_for_each_pair_of_coordinates_and_sector() {
        for valence in [3, 5, 20] {
            let net = Net::new(&catmull_clark(valence).unwrap(), 3).unwrap();
            assert_eq!((net.faces.len(), net.points.len()), (9 * valence, 1 + 12 * valence));
        }
    }
}
