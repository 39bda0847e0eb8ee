//! Natural configurations as drawings: the net of the characteristic map, its inner rings.

use super::sheet::{Turn, shrinking};
use crate::error::Error;
use eigenring_figure::{Chart, Colour, LINE, Marker, Stroke, Style};
use eigenring_scheme::{Level, Scheme, Site};
use eigenring_spectral::{LocalSystem, Natural};

/// The inner rings of a natural configuration, its first point (1, 0) turned so that a sector's bisector
/// points up.
#[derive(Clone, Debug)]
pub struct Net {
    /// The subdominant eigenvalue.
    pub lambda: f64,
    /// Points with their rings, in the order of the numbering.
    pub points: Vec<(usize, [f64; 2])>,
    /// Faces with their outer rings, corners in turn.
    pub faces: Vec<(usize, Vec<[f64; 2]>)>,
    centre: bool,
}

impl Net {
    /// As many rings of faces as given around a vertex, half a ring less around a face.
    pub fn new(scheme: &Scheme<f64>, rings: usize) -> Result<Self, Error> {
        Net::at(scheme, scheme.limit(), rings)
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
        let mut net = Net {
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

    /// The net, drawn to fill a square.
    pub fn chart(&self) -> Chart {
        let side = 1.06 * self.radius();
        let colour = Colour::line(0);
        let tint = |ring: usize| Colour::WHITE.mix(colour, [0.0, 0.38, 0.2, 0.08][ring.min(3)]);
        let fills = self
            .faces
            .iter()
            .map(|(ring, corners)| (corners.clone(), tint(*ring + usize::from(!self.centre))));
        let mut chart = Chart::map((-side, side), (-side, side)).areas(fills);
        for (_, corners) in &self.faces {
            chart = chart.outline(corners.clone(), Stroke::solid(colour, 0.6 * LINE), None);
        }
        let mut dots = Style::points(Marker::Disc, colour);
        // smaller where there are many
        let radius = 0.42 * (80.0 / self.points.len() as f64).sqrt().min(1.0);
        dots.marker = Some((Marker::Disc, radius));
        let mut centre = Style::points(Marker::Disc, Colour::line(1));
        centre.marker = Some((Marker::Disc, 0.8));
        let outer = self
            .points
            .iter()
            .skip(usize::from(self.centre))
            .map(|(_, point)| *point);
        let middle = self.centre.then_some([0.0, 0.0]);
        chart.series(outer, dots).series(middle, centre)
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
    fn one_face_for_each_pair_of_coordinates_and_sector() {
        for valence in [3, 5, 20] {
            let net = Net::new(&catmull_clark(valence).unwrap(), 3).unwrap();
            assert_eq!(net.faces.len(), 9 * valence);
            assert_eq!(net.points.len(), 1 + 12 * valence);
        }
    }
}
