//! The rows of a level's refinement: which control points a refined point is made of, passes composed.

use crate::{Error, Lattice, Level, Net, Scalar, Site, refine};
use std::collections::BTreeMap;

impl<S: Scalar> Level<S> {
    /// Refined points that show every row of the level: those of the closed rings, which hold all special
    /// ones, and of two rings more for the regular rules; of as many rings as rules change in along a spoke;
    /// of one sector where all sectors are alike.
    ///
    /// # Errors
    /// Those of [`Level::closed_rings`].
    pub fn row_sites(&self) -> Result<Vec<Site>, Error> {
        let uniform = self
            .passes()
            .iter()
            .all(|pass| pass.all_lines().all(crate::Line::is_uniform));
        let along = if uniform { 0 } else { self.last_irregular_step() + 2 };
        let numbering = self.numbering((self.closed_rings()? + 2).max(along));
        if !self.is_rotation_symmetric() {
            return Ok(numbering.sites());
        }
        let centre = (numbering.lattice == Lattice::Vertex).then_some(Site::CENTRE);
        Ok(centre.into_iter().chain(numbering.sector_sites(0)).collect())
    }

    /// The rows of refined points: for each the weights of the control points that it reads. Weights that
    /// cancel are listed as what is left of them, be it zero.
    ///
    /// ```
    /// use eigenring_scheme::{Site, families::catmull_clark};
    ///
    /// let scheme = catmull_clark::<f64>(5)?;
    /// let rows = scheme.limit().rows(&[Site::CENTRE])?;
    /// assert_eq!(rows[0].len(), 11); // the vertex, five along spokes, five across faces
    /// assert!((rows[0].values().sum::<f64>() - 1.0).abs() < 1e-15);
    /// # Ok::<(), eigenring_scheme::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`refine`].
    pub fn rows(&self, sites: &[Site]) -> Result<Vec<BTreeMap<Site, S>>, Error> {
        refine(self, &RowNet, sites)
    }
}

/// A point's value is its row.
struct RowNet;

impl<S: Scalar> Net<S> for RowNet {
    type Value = BTreeMap<Site, S>;

    fn zero(&self) -> Self::Value {
        BTreeMap::new()
    }

    fn control(&self, site: Site) -> Result<Self::Value, Error> {
        Ok(BTreeMap::from([(site, S::one())]))
    }

    fn orbit(&self, site: Site) -> Site {
        site
    }

    fn accumulate(&self, sum: &mut Self::Value, weight: &S, at_orbit: &Self::Value, _site: Site) {
        for (&site, value) in at_orbit {
            let term = weight.clone() * value.clone();
            let entry = sum.entry(site).or_insert_with(S::zero);
            *entry = entry.clone() + term;
        }
    }
}
