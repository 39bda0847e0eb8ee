//! What keeps polygons from being a surface, and two repairs.

use crate::features::edge;
use crate::{Error, Mesh};
use std::collections::BTreeMap;
use std::fmt;

/// What is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum DefectKind {
    /// A face with fewer than three corners.
    SmallFace,
    /// A face that names a point twice.
    RepeatedIndex,
    /// A point with a coordinate that is not finite.
    NotFinite,
    /// An edge with three faces or more.
    NonManifoldEdge,
    /// An edge that two faces use in the same direction: one of them is turned over.
    FlippedFace,
    /// A vertex at which several fans of faces meet.
    NonManifoldVertex,
    /// A mark on two points that no edge joins, or on a vertex that is in no face.
    NoSuchEdge,
    /// A sharpness or a knot interval that is negative or no number.
    BadMark,
}

impl DefectKind {
    /// The name for programs.
    pub fn name(self) -> &'static str {
        match self {
            DefectKind::SmallFace => "small-face",
            DefectKind::RepeatedIndex => "repeated-index",
            DefectKind::NotFinite => "not-finite",
            DefectKind::NonManifoldEdge => "non-manifold-edge",
            DefectKind::FlippedFace => "flipped-face",
            DefectKind::NonManifoldVertex => "non-manifold-vertex",
            DefectKind::NoSuchEdge => "tag-on-no-edge",
            DefectKind::BadMark => "bad-mark",
        }
    }

    fn explained(self) -> (&'static str, &'static str) {
        match self {
            DefectKind::SmallFace => ("has fewer than three corners", "faces with three corners or more"),
            DefectKind::RepeatedIndex => ("names a point twice", "faces whose corners differ"),
            DefectKind::NotFinite => ("has a coordinate that is no finite number", "finite coordinates"),
            DefectKind::NonManifoldEdge => (
                "has three faces or more",
                "edges with one or two faces (--split-non-manifold takes them apart)",
            ),
            DefectKind::FlippedFace => (
                "is used twice in the same direction: a face beside it is turned over",
                "neighbours with the same orientation (--orient turns faces)",
            ),
            DefectKind::NonManifoldVertex => (
                "joins several fans of faces",
                "one fan of faces at a vertex (--split-non-manifold takes them apart)",
            ),
            DefectKind::NoSuchEdge => (
                "is marked but is no edge of a face",
                "marks on edges and vertices of faces",
            ),
            DefectKind::BadMark => (
                "has a mark that is negative or no number",
                "finite numbers, none negative",
            ),
        }
    }
}

/// Where something is wrong. Numbers count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Element {
    /// A vertex.
    Vertex(u32),
    /// An edge, by its points.
    Edge([u32; 2]),
    /// A face.
    Face(u32),
}

impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Element::Vertex(vertex) => write!(f, "vertex {vertex}"),
            Element::Edge([a, b]) => write!(f, "edge {a}-{b}"),
            Element::Face(face) => write!(f, "face {face}"),
        }
    }
}

/// A reason why a mesh is no surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Defect {
    /// What is wrong.
    pub kind: DefectKind,
    /// Where.
    pub element: Element,
    /// The faces that take part.
    pub faces: Vec<u32>,
}

/// How many defects a message names.
pub const NAMED: usize = 10;

/// Defects in one line, each with the line of its file if that is known.
pub fn in_words(defects: &[(Defect, Option<u32>)]) -> String {
    let Some((first, _)) = defects.first() else {
        return "no defect".to_owned();
    };
    let kind = first.kind;
    let alike = defects.iter().filter(|(defect, _)| defect.kind == kind);
    let named: Vec<String> = alike
        .clone()
        .take(NAMED)
        .map(|(defect, line)| match line {
            Some(line) => format!("{} (line {line})", defect.element),
            None => defect.element.to_string(),
        })
        .collect();
    let (what, accepted) = kind.explained();
    let more = alike.count().saturating_sub(NAMED);
    let more = if more > 0 {
        format!(" and {more} more")
    } else {
        String::new()
    };
    let others = defects.iter().filter(|(defect, _)| defect.kind != kind).count();
    let others = match others {
        0 => String::new(),
        others => format!("; {others} defects of other kinds"),
    };
    format!("{}{more} {what}{others}: accepted are {accepted}", named.join(", "))
}

impl Mesh {
    /// Everything that keeps the mesh from being an oriented manifold with boundary; empty if nothing does.
    /// Where faces themselves are wrong, nothing is said of how they meet.
    pub fn defects(&self) -> Vec<Defect> {
        let mut defects = self.own_defects();
        if defects.is_empty() {
            defects = self.edge_defects();
        }
        if defects.is_empty() {
            defects = self.vertex_defects();
        }
        defects.extend(self.mark_defects());
        defects
    }

    fn own_defects(&self) -> Vec<Defect> {
        let mut defects = Vec::new();
        for (index, point) in self.points().iter().enumerate() {
            if !point.iter().all(|x| x.is_finite()) {
                defects.push(Defect {
                    kind: DefectKind::NotFinite,
                    element: Element::Vertex(index as u32),
                    faces: Vec::new(),
                });
            }
        }
        let mut sorted = Vec::new();
        for (index, face) in self.faces().enumerate() {
            sorted.clear();
            sorted.extend_from_slice(face);
            sorted.sort_unstable();
            let kind = if face.len() < 3 {
                DefectKind::SmallFace
            } else if sorted.windows(2).any(|pair| pair[0] == pair[1]) {
                DefectKind::RepeatedIndex
            } else {
                continue;
            };
            defects.push(Defect {
                kind,
                element: Element::Face(index as u32),
                faces: vec![index as u32],
            });
        }
        defects
    }

    /// The faces of each edge, with whether they run from the smaller point to the larger, by edges.
    fn faces_at_edges(&self) -> Vec<([u32; 2], u32, bool)> {
        let mut uses = Vec::with_capacity(self.corners().len());
        for (index, face) in self.faces().enumerate() {
            for (&a, &b) in face.iter().zip(face.iter().cycle().skip(1)) {
                uses.push((edge(a, b), index as u32, a < b));
            }
        }
        uses.sort_unstable();
        uses
    }

    fn edge_defects(&self) -> Vec<Defect> {
        let uses = self.faces_at_edges();
        let alike = uses.chunk_by(|a, b| a.0 == b.0);
        let defect = |uses: &[([u32; 2], u32, bool)]| {
            let kind = match uses {
                [_] => return None,
                [a, b] if a.2 != b.2 => return None,
                [_, _] => DefectKind::FlippedFace,
                _ => DefectKind::NonManifoldEdge,
            };
            Some(Defect {
                kind,
                element: Element::Edge(uses[0].0),
                faces: uses.iter().map(|u| u.1).collect(),
            })
        };
        alike.filter_map(defect).collect()
    }

    fn vertex_defects(&self) -> Vec<Defect> {
        let topology = crate::Topology::unchecked(self);
        let mut halves: Vec<Vec<u32>> = vec![Vec::new(); self.points().len()];
        for (half, &corner) in self.corners().iter().enumerate() {
            halves[corner as usize].push(half as u32);
        }
        let mut defects = Vec::new();
        for (vertex, halves) in halves.into_iter().enumerate() {
            if !halves.is_empty() && topology.fan(vertex as u32).spokes.len() != halves.len() {
                defects.push(Defect {
                    kind: DefectKind::NonManifoldVertex,
                    element: Element::Vertex(vertex as u32),
                    faces: halves.into_iter().map(|half| topology.face(half)).collect(),
                });
            }
        }
        defects
    }

    fn mark_defects(&self) -> Vec<Defect> {
        let features = &self.features;
        let mut defects = Vec::new();
        if *features == crate::Features::default() {
            return defects;
        }
        let mut push = |kind, element| {
            defects.push(Defect {
                kind,
                element,
                faces: Vec::new(),
            });
        };
        let uses = self.faces_at_edges();
        let exists = |pair: [u32; 2]| uses.binary_search_by(|u| u.0.cmp(&pair)).is_ok();
        let mut used = vec![false; self.points().len()];
        for &corner in self.corners() {
            used[corner as usize] = true;
        }
        let in_face = |vertex: u32| used.get(vertex as usize).copied().unwrap_or(false);
        for (&pair, &value) in features.creases.iter().chain(&features.knots) {
            if !exists(pair) {
                push(DefectKind::NoSuchEdge, Element::Edge(pair));
            }
            if !(value >= 0.0) {
                push(DefectKind::BadMark, Element::Edge(pair));
            }
        }
        for &pair in features.edge_steps.keys().filter(|&&pair| !exists(pair)) {
            push(DefectKind::NoSuchEdge, Element::Edge(pair));
        }
        for (&vertex, &value) in &features.corners {
            if !in_face(vertex) {
                push(DefectKind::NoSuchEdge, Element::Vertex(vertex));
            }
            if !(value >= 0.0) {
                push(DefectKind::BadMark, Element::Vertex(vertex));
            }
        }
        let others = features.vertex_steps.keys().chain(&features.extraordinary);
        for &vertex in others.filter(|&&vertex| !in_face(vertex)) {
            push(DefectKind::NoSuchEdge, Element::Vertex(vertex));
        }
        defects
    }

    /// The same faces, turned so that neighbours agree: each component follows its first face.
    ///
    /// # Errors
    /// [`Error::NotOrientable`] for a surface with one side.
    pub fn oriented(&self) -> Result<Mesh, Error> {
        let uses = self.faces_at_edges();
        let mut neighbours: Vec<Vec<(u32, bool)>> = vec![Vec::new(); self.face_count()];
        for pair in uses.chunk_by(|a, b| a.0 == b.0) {
            // across an edge with more faces no neighbour is known
            if let [a, b] = pair
                && a.1 != b.1
            {
                neighbours[a.1 as usize].push((b.1, a.2 == b.2));
                neighbours[b.1 as usize].push((a.1, a.2 == b.2));
            }
        }
        let mut turned: Vec<Option<bool>> = vec![None; self.face_count()];
        for start in 0..self.face_count() {
            if turned[start].is_some() {
                continue;
            }
            turned[start] = Some(false);
            let mut stack = vec![start];
            while let Some(face) = stack.pop() {
                let own = turned[face] == Some(true);
                for &(other, flipped) in &neighbours[face] {
                    let wanted = own != flipped;
                    match turned[other as usize] {
                        None => {
                            turned[other as usize] = Some(wanted);
                            stack.push(other as usize);
                        }
                        Some(found) if found != wanted => return Err(Error::NotOrientable { face: other }),
                        Some(_) => {}
                    }
                }
            }
        }
        let mut corners = Vec::with_capacity(self.corners().len());
        for (face, turned) in self.faces().zip(turned) {
            if turned == Some(true) {
                // the first corner stays the first
                corners.push(face[0]);
                corners.extend(face[1..].iter().rev());
            } else {
                corners.extend_from_slice(face);
            }
        }
        Ok(self.with_corners(self.points().to_vec(), corners))
    }

    /// The same faces, with points doubled until no edge has more than two faces and every vertex one fan:
    /// faces stay joined across edges that two of them share in opposite directions. The first fan keeps the
    /// point. Marks stay with the points that are kept.
    pub fn split_non_manifold(&self) -> Mesh {
        let uses = self.faces_at_edges();
        let mut joined: BTreeMap<[u32; 2], [u32; 2]> = BTreeMap::new();
        for pair in uses.chunk_by(|a, b| a.0 == b.0) {
            if let [a, b] = pair
                && a.2 != b.2
                && a.1 != b.1
            {
                joined.insert(a.0, [a.1, b.1]);
            }
        }
        // corners of one vertex, in groups of faces that are joined at it
        let mut corners_of: Vec<Vec<u32>> = vec![Vec::new(); self.points().len()];
        for (half, &corner) in self.corners().iter().enumerate() {
            corners_of[corner as usize].push(half as u32);
        }
        let mut face_of = Vec::with_capacity(self.corners().len());
        for (index, face) in self.faces().enumerate() {
            face_of.extend(std::iter::repeat_n(index, face.len()));
        }
        let mut points = self.points().to_vec();
        let mut corners = self.corners().to_vec();
        for (vertex, halves) in corners_of.iter().enumerate() {
            let vertex = vertex as u32;
            let mut left = halves.clone();
            let mut fans = 0;
            while let Some(&start) = left.first() {
                let mut group = vec![start];
                left.remove(0);
                let mut at = 0;
                while at < group.len() {
                    let face = face_of[group[at] as usize];
                    let range = self.starts()[face]..self.starts()[face + 1];
                    let size = range.len() as u32;
                    let place = group[at] - range.start;
                    let beside = [(place + 1) % size, (place + size - 1) % size];
                    for other in beside.map(|place| self.corners()[(range.start + place) as usize]) {
                        let Some(pair) = joined.get(&edge(vertex, other)) else {
                            continue;
                        };
                        let next = pair.iter().find(|&&next| next as usize != face).copied();
                        let found = left
                            .iter()
                            .position(|&half| Some(face_of[half as usize] as u32) == next);
                        if let Some(found) = found {
                            group.push(left.remove(found));
                        }
                    }
                    at += 1;
                }
                if fans > 0 {
                    points.push(points[vertex as usize]);
                    for half in group {
                        corners[half as usize] = points.len() as u32 - 1;
                    }
                }
                fans += 1;
            }
        }
        self.with_corners(points, corners)
    }
}
