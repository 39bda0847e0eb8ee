//! The surface at the vertices of its control mesh, a fan of faces at a time.

use super::{Kind, Place, Sample, Surface};
use crate::features::INFINITE;
use crate::limit::local::Source;
use crate::{Error, Topology};

/// What a vertex is once no sharpness is left that ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Inside, without sharp edges.
    Smooth,
    /// Where one crease ends.
    Dart,
    /// On a boundary or crease.
    Crease,
    /// A point that stays.
    Corner,
}

impl Rule {
    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Rule::Smooth => "smooth",
            Rule::Dart => "dart",
            Rule::Crease => "crease",
            Rule::Corner => "corner",
        }
    }
}

/// The surface at a vertex, seen from the faces between two sharp edges.
#[derive(Clone, Debug)]
pub struct VertexFan {
    /// The vertex.
    pub vertex: u32,
    /// The number of the fan at this vertex.
    pub fan: u32,
    /// The faces, counter-clockwise.
    pub faces: Vec<u32>,
    /// What the vertex is.
    pub rule: Rule,
    /// The point; curvature ranges are those of all faces of the fan.
    pub sample: Sample,
}

impl Surface<'_> {
    /// The surface at all vertices of faces, in their order.
    ///
    /// # Errors
    /// As [`Surface::at`].
    pub fn vertices(&self) -> Result<Vec<VertexFan>, Error> {
        let topology = Topology::unchecked(&self.control);
        let source = Source {
            mesh: &self.control,
            topology: &topology,
            ends: self.ends,
            soft: false,
            net: None,
            full: self.kernel.full_steps(),
        };
        let valences = topology.valences();
        let mut found = Vec::new();
        for vertex in 0..topology.vertex_count() as u32 {
            found.extend(self.at_vertex(&source, vertex, &valences)?);
        }
        Ok(found)
    }

    /// The spokes of a fan in whose faces the surface is looked at, in turn: of many so many evenly spread.
    /// Faces at another vertex with many faces come last, as evaluating one takes as long as all of these.
    fn asked(&self, topology: &Topology, spokes: &[u32], valences: &[(usize, bool)]) -> Vec<u32> {
        if spokes.len() > MANY {
            return (0..SECTORS).map(|i| spokes[i * spokes.len() / SECTORS]).collect();
        }
        let busy = |&spoke: &u32| {
            let corners = self.control.face(topology.face(spoke) as usize).iter();
            let most = corners.map(|&corner| valences[corner as usize].0).max();
            most.filter(|&most| most > MANY).unwrap_or(0)
        };
        let mut spokes = spokes.to_vec();
        spokes.sort_by_key(busy);
        spokes
    }

    fn at_vertex(&self, source: &Source<'_>, vertex: u32, valences: &[(usize, bool)]) -> Result<Vec<VertexFan>, Error> {
        let topology = source.topology;
        let fan = topology.fan(vertex);
        let n = fan.spokes.len();
        if n == 0 {
            return Ok(Vec::new());
        }
        let sharp: Vec<usize> = (0..n).filter(|&i| source.cuts(fan.spokes[i])).collect();
        // what acts in the first smoothing step
        let spokes = fan.spokes.iter().copied().chain(fan.last);
        let count = spokes.filter(|&spoke| source.sharpness(spoke) >= INFINITE).count();
        let rule = match count {
            _ if source.own(vertex) >= INFINITE => Rule::Corner,
            0 => Rule::Smooth,
            1 => Rule::Dart,
            2 => Rule::Crease,
            _ => Rule::Corner,
        };
        // fans begin at sharp spokes; a dart has one fan all round
        let starts: Vec<usize> = if sharp.is_empty() { vec![0] } else { sharp };
        let mut fans = Vec::new();
        for (number, &start) in starts.iter().enumerate() {
            let end = match starts.get(number + 1) {
                Some(&next) => next,
                None if fan.is_closed() => starts[0] + n,
                None => n,
            };
            let spokes: Vec<u32> = (start..end).map(|i| fan.spokes[i % n]).collect();
            let mut sample: Option<Sample> = None;
            for &spoke in &self.asked(topology, &spokes, valences) {
                let face = topology.face(spoke);
                let corner = spoke - self.control.starts()[face as usize];
                let quad = topology.face_size(face) == 4;
                let here = self.at(Place {
                    face,
                    sub: if quad { 0 } else { corner },
                    corner: if quad { corner } else { 0 },
                    s: 0.0,
                    t: 0.0,
                })?;
                sample = Some(sample.map_or(here, |first| merged(first, &here)));
                if !matches!(here.kind, Kind::Bounded { .. } | Kind::Unbounded { .. }) {
                    // one face says all of a fan
                    break;
                }
            }
            fans.extend(sample.map(|sample| VertexFan {
                vertex,
                fan: number as u32,
                faces: spokes.iter().map(|&spoke| topology.face(spoke)).collect(),
                rule,
                sample,
            }));
        }
        Ok(fans)
    }
}

/// From so many faces on, vertices are seen from faces that have fewer neighbours.
const MANY: usize = 48;

/// Around a centre of many sectors curvature is looked at in so many.
const SECTORS: usize = 16;

/// A sample with the ranges of both.
fn merged(mut first: Sample, other: &Sample) -> Sample {
    let join = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
    first.kind = match (first.kind, other.kind) {
        (Kind::Bounded { gauss: a, mean: b }, Kind::Bounded { gauss: c, mean: d }) => Kind::Bounded {
            gauss: join(a, c),
            mean: join(b, d),
        },
        (
            Kind::Unbounded { exponent, signs },
            Kind::Unbounded {
                exponent: other,
                signs: more,
            },
        ) => Kind::Unbounded {
            exponent: exponent.min(other),
            signs: join(signs, more),
        },
        (kind, _) => kind,
    };
    first
}
