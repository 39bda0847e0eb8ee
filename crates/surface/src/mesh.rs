//! Polygon meshes: points, faces of any size, and what is marked on them.

use crate::Features;
use nalgebra::Point3;

/// A polygon mesh. Faces are lists of points, counter-clockwise seen from outside; any number of them may
/// meet, a boundary is where they end.
///
/// A mesh holds what it was given, as long as the faces' points exist: what keeps it from being a surface is
/// for [`Mesh::defects`](crate::Mesh::defects) to say, and every algorithm asks for a
/// [`Topology`](crate::Topology), which exists for a mesh without defects only.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    points: Vec<Point3<f64>>,
    weights: Option<Vec<f64>>,
    /// Where each face begins among the corners, and where the last one ends.
    starts: Vec<u32>,
    corners: Vec<u32>,
    /// Creases, corners and whatever else is marked.
    pub features: Features,
}

impl Default for Mesh {
    fn default() -> Self {
        Mesh {
            points: Vec::new(),
            weights: None,
            starts: vec![0],
            corners: Vec::new(),
            features: Features::default(),
        }
    }
}

impl Mesh {
    /// A mesh of the given points without faces.
    pub fn of_points(points: Vec<Point3<f64>>) -> Self {
        Mesh {
            points,
            ..Mesh::default()
        }
    }

    /// A mesh of points and faces.
    ///
    /// # Errors
    /// [`Error::NoSuchPoint`](crate::Error::NoSuchPoint) if a face names a point that is not there,
    /// [`Error::TooLarge`](crate::Error::TooLarge) beyond 32-bit indices.
    pub fn new<F: AsRef<[u32]>>(
        points: Vec<Point3<f64>>,
        faces: impl IntoIterator<Item = F>,
    ) -> Result<Self, crate::Error> {
        let mut mesh = Mesh::of_points(points);
        for face in faces {
            mesh.push_face(face.as_ref())?;
        }
        Ok(mesh)
    }

    /// A mesh of quads, four corners each, all of them below the number of points.
    pub fn of_quads(points: Vec<Point3<f64>>, corners: Vec<u32>) -> Self {
        debug_assert!(corners.len().is_multiple_of(4));
        Mesh {
            points,
            weights: None,
            starts: (0..=corners.len() as u32).step_by(4).collect(),
            corners,
            features: Features::default(),
        }
    }

    /// A mesh of faces of the given sizes, with their corners one after the other, all of them below the
    /// number of points.
    pub(crate) fn of_faces(
        points: Vec<Point3<f64>>,
        sizes: impl IntoIterator<Item = usize>,
        corners: Vec<u32>,
    ) -> Result<Self, crate::Error> {
        let mut end = 0;
        let mut starts = vec![0];
        starts.extend(sizes.into_iter().map(|size| {
            end += size;
            end as u32
        }));
        debug_assert_eq!(end, corners.len());
        if u32::try_from(end).is_err() {
            return Err(crate::Error::TooLarge {
                what: "corners of faces",
                count: end,
            });
        }
        Ok(Mesh {
            starts,
            corners,
            ..Mesh::of_points(points)
        })
    }

    /// Adds a point and returns its index.
    pub fn push_point(&mut self, point: Point3<f64>) -> u32 {
        self.points.push(point);
        self.points.len() as u32 - 1
    }

    /// Adds a face and returns its index.
    ///
    /// # Errors
    /// As [`Mesh::new`].
    pub fn push_face(&mut self, face: &[u32]) -> Result<u32, crate::Error> {
        if let Some(&index) = face.iter().find(|&&index| index as usize >= self.points.len()) {
            return Err(crate::Error::NoSuchPoint {
                face: self.face_count(),
                index: i64::from(index),
                points: self.points.len(),
            });
        }
        let end = u32::try_from(self.corners.len() + face.len()).map_err(|_| crate::Error::TooLarge {
            what: "corners of faces",
            count: self.corners.len() + face.len(),
        })?;
        self.corners.extend_from_slice(face);
        self.starts.push(end);
        Ok(self.starts.len() as u32 - 2)
    }

    /// Makes room for so many faces, and corners of them.
    pub(crate) fn reserve(&mut self, faces: usize, corners: usize) {
        self.starts.reserve(faces + 2);
        self.corners.reserve(corners);
    }

    /// Adds a face whose points come later.
    pub(crate) fn push_corners(&mut self, face: &[u32]) {
        self.corners.extend_from_slice(face);
        self.starts.push(self.corners.len() as u32);
    }

    /// The points.
    pub fn points(&self) -> &[Point3<f64>] {
        &self.points
    }

    /// The points, to be moved.
    pub fn points_mut(&mut self) -> &mut [Point3<f64>] {
        &mut self.points
    }

    /// The points without the mesh.
    pub fn into_points(self) -> Vec<Point3<f64>> {
        self.points
    }

    /// Fourth coordinates, weights of rational surfaces, if the mesh came with such. No rule of this crate
    /// uses them.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// Sets the fourth coordinates, one for each point.
    pub fn set_weights(&mut self, weights: Vec<f64>) {
        debug_assert_eq!(weights.len(), self.points.len());
        self.weights = Some(weights);
    }

    /// The number of faces.
    pub fn face_count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The points of a face.
    pub fn face(&self, face: usize) -> &[u32] {
        &self.corners[self.starts[face] as usize..self.starts[face + 1] as usize]
    }

    /// All faces in order.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        (0..self.face_count()).map(|face| self.face(face))
    }

    /// Where each face begins among all corners, and where the last one ends.
    pub fn starts(&self) -> &[u32] {
        &self.starts
    }

    /// The points of all faces, one after the other.
    pub fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// Whether every face has four corners.
    pub fn is_quads(&self) -> bool {
        self.faces().all(|face| face.len() == 4)
    }

    /// How many faces there are of each size.
    pub fn faces_by_size(&self) -> std::collections::BTreeMap<usize, usize> {
        let mut sizes = std::collections::BTreeMap::new();
        for face in self.faces() {
            *sizes.entry(face.len()).or_insert(0) += 1;
        }
        sizes
    }

    /// The points that belong to no face.
    pub fn unused(&self) -> Vec<u32> {
        let mut used = vec![false; self.points.len()];
        for &corner in &self.corners {
            used[corner as usize] = true;
        }
        (0..self.points.len() as u32)
            .filter(|&index| !used[index as usize])
            .collect()
    }

    /// The mesh without unused points; the others keep their order.
    pub fn without_unused(&self) -> Mesh {
        let unused = self.unused();
        if unused.is_empty() {
            return self.clone();
        }
        let mut renumbered = vec![u32::MAX; self.points.len()];
        let mut kept = Vec::new();
        for (index, number) in renumbered.iter_mut().enumerate() {
            if unused.binary_search(&(index as u32)).is_err() {
                *number = kept.len() as u32;
                kept.push(index);
            }
        }
        let map = |index: u32| renumbered[index as usize];
        Mesh {
            points: kept.iter().map(|&index| self.points[index]).collect(),
            weights: self
                .weights
                .as_ref()
                .map(|weights| kept.iter().map(|&index| weights[index]).collect()),
            starts: self.starts.clone(),
            corners: self.corners.iter().map(|&corner| map(corner)).collect(),
            features: self
                .features
                .renumbered(|index| Some(map(index)).filter(|&index| index != u32::MAX)),
        }
    }

    /// The same mesh with other corners of its faces, which keep their sizes.
    pub(crate) fn with_corners(&self, points: Vec<Point3<f64>>, corners: Vec<u32>) -> Mesh {
        debug_assert_eq!(corners.len(), self.corners.len());
        Mesh {
            points,
            weights: None,
            starts: self.starts.clone(),
            corners,
            features: self.features.clone(),
        }
    }

    /// The smallest box around all points: its least and its greatest corner; `None` without points.
    pub fn bounds(&self) -> Option<[Point3<f64>; 2]> {
        let first = *self.points.first()?;
        let fold = |[low, high]: [Point3<f64>; 2], point: &Point3<f64>| [low.inf(point), high.sup(point)];
        Some(self.points.iter().fold([first, first], fold))
    }
}
