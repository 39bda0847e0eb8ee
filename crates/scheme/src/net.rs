//! Running passes: what is combined, where it is read, and the one interpreter.
//!
//! A pass says how points combine; it does not say what a point is. The interpreter, a [`Plan`] that is made
//! once and run on nets ([`refine`] does both), runs the passes of a level for any [`Net`]: rows of the local
//! matrix ([`DenseNet`]), rows of a Fourier block ([`FourierNet`]), points of a surface ([`PointNet`]), or a
//! mere mark (is a special stencil involved?). Local matrix, Fourier blocks and refinement thus come from the
//! same rules by construction.

use crate::{Error, Level, Numbering, Scalar, Site, Table};

/// Where a level reads its control points, and how their values combine.
///
/// On a net with a symmetry only one value per orbit need be stored: [`Net::orbit`] names the stored site,
/// and [`Net::accumulate`] moves its value to where it is read.
pub trait Net<S: Scalar> {
    /// What is attached to a point; an element of a module over the scalars.
    type Value;

    /// The value of an empty combination.
    fn zero(&self) -> Self::Value;

    /// The value of a control point.
    ///
    /// # Errors
    /// [`Error::BeyondNet`] if the net does not reach that far.
    fn control(&self, site: Site) -> Result<Self::Value, Error>;

    /// The site whose value stands for that of `site`.
    fn orbit(&self, site: Site) -> Site;

    /// Adds `weight` times the value at `site` to `sum`, given the value at `orbit(site)`.
    fn accumulate(&self, sum: &mut Self::Value, weight: &S, at_orbit: &Self::Value, site: Site);
}

/// The values that the level gives to the refined points `targets`, in their order.
///
/// # Errors
/// Those of [`Plan::new`] and [`Plan::run`].
pub fn refine<S: Scalar, N: Net<S>>(level: &Level<S>, net: &N, targets: &[Site]) -> Result<Vec<N::Value>, Error> {
    Plan::new(level, |site| net.orbit(site), targets)?.run(net)
}

/// A level made ready to run: which points each pass must make so that the targets can be made, and out of
/// which others.
///
/// The plan depends on the rules and on what counts as one orbit, and not on the values: all Fourier blocks
/// of a level share one.
#[derive(Clone, Debug)]
pub struct Plan<S> {
    /// The control points that are read, one of each orbit.
    controls: Vec<Site>,
    /// For each pass the sums that it makes, one for each orbit, of what the pass before has made.
    passes: Vec<Pass<S>>,
    /// Where each target's orbit is among the sums of the last pass, and the target itself.
    targets: Vec<(usize, Site)>,
}

/// One pass: the table over orbits, and for each term the site that it reads, which says how its orbit's
/// value is moved there.
#[derive(Clone, Debug)]
struct Pass<S> {
    table: Table<S>,
    sites: Vec<Site>,
}

impl<S: Scalar> Plan<S> {
    /// The plan for `targets`; `orbit` names the site whose value stands for that of a site.
    ///
    /// # Errors
    /// Those of [`Level::stencil`].
    pub fn new(level: &Level<S>, orbit: impl Fn(Site) -> Site, targets: &[Site]) -> Result<Self, Error> {
        let distinct = |sites: &mut Vec<Site>| {
            sites.sort_unstable();
            sites.dedup();
        };
        let place = |sites: &[Site], site: Site| {
            let found = sites.binary_search(&orbit(site));
            found.expect("the orbit of every site that is read was collected")
        };
        let mut needed: Vec<Site> = targets.iter().map(|&site| orbit(site)).collect();
        distinct(&mut needed);
        let targets = targets.iter().map(|&site| (place(&needed, site), site)).collect();
        // backwards, since what a pass must make is what the next one reads
        let mut passes = Vec::with_capacity(level.passes().len());
        for pass in (0..level.passes().len()).rev() {
            let stencils = needed
                .iter()
                .map(|&site| level.stencil(pass, site))
                .collect::<Result<Vec<_>, Error>>()?;
            needed = stencils
                .iter()
                .flat_map(|stencil| stencil.terms())
                .map(|(source, _)| orbit(*source))
                .collect();
            distinct(&mut needed);
            let (mut table, mut sites) = (Table::default(), Vec::new());
            for stencil in &stencils {
                let terms = stencil.terms().iter();
                table.push(terms.map(|(source, weight)| (place(&needed, *source) as u32, weight.clone())))?;
                sites.extend(stencil.terms().iter().map(|(source, _)| *source));
            }
            passes.push(Pass { table, sites });
        }
        passes.reverse();
        Ok(Plan {
            controls: needed,
            passes,
            targets,
        })
    }

    /// The values of the targets, in their order. The net's orbits must be those of the plan.
    ///
    /// Cost: one [`Net::accumulate`] for each term of each point that some pass makes.
    ///
    /// # Errors
    /// Those of [`Net::control`].
    pub fn run<N: Net<S>>(&self, net: &N) -> Result<Vec<N::Value>, Error> {
        let controls = self.controls.iter().map(|&site| net.control(site));
        let mut values = controls.collect::<Result<Vec<_>, Error>>()?;
        for pass in &self.passes {
            let made = (0..pass.table.rows()).map(|row| {
                let mut sum = net.zero();
                let sites = &pass.sites[pass.table.range(row)];
                for ((at, weight), &site) in pass.table.row(row).zip(sites) {
                    net.accumulate(&mut sum, weight, &values[at], site);
                }
                sum
            });
            values = made.collect();
        }
        let one = S::one();
        let targets = self.targets.iter().map(|&(at, site)| {
            let mut value = net.zero();
            net.accumulate(&mut value, &one, &values[at], site);
            value
        });
        Ok(targets.collect())
    }
}

/// Control points are unit vectors: a refined point's value is its row of the local matrix, columns in the
/// order of the numbering.
#[derive(Clone, Copy, Debug)]
pub struct DenseNet {
    /// The control points.
    pub numbering: Numbering,
}

impl<S: Scalar> Net<S> for DenseNet {
    type Value = Vec<S>;

    fn zero(&self) -> Vec<S> {
        vec![S::zero(); self.numbering.count()]
    }

    fn control(&self, site: Site) -> Result<Vec<S>, Error> {
        let mut row = Net::<S>::zero(self);
        row[beyond(self.numbering, site)?] = S::one();
        Ok(row)
    }

    fn orbit(&self, site: Site) -> Site {
        site
    }

    fn accumulate(&self, sum: &mut Vec<S>, weight: &S, at_orbit: &Vec<S>, _site: Site) {
        for (sum, entry) in sum.iter_mut().zip(at_orbit) {
            *sum += weight.clone() * entry.clone();
        }
    }
}

fn beyond(numbering: Numbering, site: Site) -> Result<usize, Error> {
    numbering.index(site).ok_or(Error::BeyondNet {
        site,
        rings: numbering.rings,
    })
}

/// Control points carry coordinates; refined points get theirs.
#[derive(Clone, Debug)]
pub struct PointNet<S, const D: usize> {
    /// The control points.
    pub numbering: Numbering,
    /// Their coordinates, in the order of the numbering.
    pub points: Vec<[S; D]>,
}

impl<S: Scalar, const D: usize> Net<S> for PointNet<S, D> {
    type Value = [S; D];

    fn zero(&self) -> [S; D] {
        std::array::from_fn(|_| S::zero())
    }

    fn control(&self, site: Site) -> Result<[S; D], Error> {
        Ok(self.points[beyond(self.numbering, site)?].clone())
    }

    fn orbit(&self, site: Site) -> Site {
        site
    }

    fn accumulate(&self, sum: &mut [S; D], weight: &S, at_orbit: &[S; D], _site: Site) {
        for (sum, coordinate) in sum.iter_mut().zip(at_orbit) {
            *sum += weight.clone() * coordinate.clone();
        }
    }
}
