//! A scheme: levels of passes around one centre.

use crate::{Error, Fan, Lattice, Level, Numbering, Scalar};
use std::collections::BTreeMap;

/// A subdivision scheme around one extraordinary vertex or face.
///
/// A scheme is data, made by the constructor of its family. A non-stationary scheme lists its leading levels;
/// from then on its limit level holds, the one that governs continuity.
#[derive(Clone, Debug)]
pub struct Scheme<S> {
    name: String,
    leading: Vec<Level<S>>,
    limit: Level<S>,
    degree: Option<usize>,
}

impl<S: Scalar> Scheme<S> {
    /// A scheme of the given leading levels, the first refinement first, and of its limit level, which has
    /// the same fan and lattice. The degree of the regular surface is derived from the limit level's lines.
    pub fn new(name: impl Into<String>, leading: Vec<Level<S>>, limit: Level<S>) -> Self {
        debug_assert!(
            leading
                .iter()
                .all(|level| level.fan() == limit.fan() && level.lattice() == limit.lattice()),
            "all levels refine nets of one kind"
        );
        Scheme {
            name: name.into(),
            degree: limit.spline_degree(),
            leading,
            limit,
        }
    }

    /// A scheme whose levels are all the same.
    pub fn stationary(name: impl Into<String>, level: Level<S>) -> Self {
        Scheme::new(name, Vec::new(), level)
    }

    /// The mask of the regular rules, at half steps: what the degree was derived from; `None` where
    /// directions differ.
    pub fn regular_mask(&self) -> Option<BTreeMap<i32, S>> {
        self.limit.regular_mask()
    }
}

impl<S: Clone> Scheme<S> {
    /// A scheme whose degree has been derived from other forms of the same weights.
    pub(crate) fn of_degree(
        name: impl Into<String>,
        leading: Vec<Level<S>>,
        limit: Level<S>,
        degree: Option<usize>,
    ) -> Self {
        Scheme {
            name: name.into(),
            leading,
            limit,
            degree,
        }
    }

    /// The same scheme under another name.
    pub fn named(self, name: impl Into<String>) -> Self {
        Scheme {
            name: name.into(),
            ..self
        }
    }

    /// The same scheme with weights of another type. Symmetry and degree are kept: they are facts about the
    /// weights, of which the images are enclosures or approximations.
    pub fn map<T: Clone>(&self, mut f: impl FnMut(&S) -> T) -> Scheme<T> {
        Scheme {
            name: self.name.clone(),
            leading: self.leading.iter().map(|level| level.map(&mut f)).collect(),
            limit: self.limit.map(&mut f),
            degree: self.degree,
        }
    }

    /// What the scheme is, in the words of [`Spec`](crate::Spec).
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The degree of the regular surface in each direction, 3 for bicubic: that of the uniform B-splines
    /// whose mask the composed lines of the limit level are. `None` if they are no such mask; the surface
    /// then is not made of polynomial patches that this library knows.
    pub fn degree(&self) -> Option<usize> {
        self.degree
    }

    /// The levels before the limit level, the first refinement first; empty for a stationary scheme.
    pub fn leading(&self) -> &[Level<S>] {
        &self.leading
    }

    /// The rules of refinement `index`, 0 for the first.
    pub fn level(&self, index: usize) -> &Level<S> {
        self.leading.get(index).unwrap_or(&self.limit)
    }

    /// The level that governs continuity in the limit.
    pub fn limit(&self) -> &Level<S> {
        &self.limit
    }

    /// The number of sectors.
    pub fn valence(&self) -> usize {
        self.limit.fan().sectors()
    }

    /// The kind of the control net.
    pub fn lattice(&self) -> Lattice {
        self.limit.lattice()
    }

    /// The control net out to a ring.
    pub fn numbering(&self, rings: usize) -> Numbering {
        self.limit.numbering(rings)
    }

    /// See [`Level::closed_rings`], of the limit level.
    ///
    /// # Errors
    /// Those of [`Level::closed_rings`].
    pub fn closed_rings(&self) -> Result<usize, Error> {
        self.limit.closed_rings()
    }

    /// See [`Level::special_rings`], of the limit level.
    ///
    /// # Errors
    /// Those of [`Level::special_rings`].
    pub fn special_rings(&self) -> Result<Option<usize>, Error> {
        self.limit.special_rings()
    }

    /// The fan.
    pub fn fan(&self) -> Fan {
        self.limit.fan()
    }
}
