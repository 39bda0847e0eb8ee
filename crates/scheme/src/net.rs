//! Running passes: what is combined, where it is read, and the one interpreter.
//!
//! A pass says how points combine; it does not say what a point is. The interpreter [`refine`] runs the passes of a level
//! for any [`Net`]: rows of the local matrix ([`DenseNet`]), rows of a Fourier block ([`FourierNet`]), points of a surface
//! ([`PointNet`]), or a mere mark (is a special stencil involved?). Local matrix, Fourier blocks and refinement thus come
//! from the same rules by construction.

use crate::{Error, Level, Numbering, Scalar, Site};
use std::collections::{BTreeMap, BTreeSet};

/// Where a level reads its control points, and how their values combine.
///
/// On a net with a symmetry only one value per orbit need be stored: [`Net::orbit`] names the stored site, and
/// [`Net::accumulate`] moves its value to where it is read.
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
    fn accumulate(&self, sum: &mut Self::Value, weight: S, at_orbit: &Self::Value, site: Site);
}

/// The values that the level gives to the refined points `targets`, in their order.
///
/// Cost: one [`Net::accumulate`] per stencil term of each point that is needed in between, each point computed once.
///
/// # Errors
/// Those of [`Level::stencil`] and [`Net::control`].
pub fn refine<S: Scalar, N: Net<S>>(level: &Level<S>, net: &N, targets: &[Site]) -> Result<Vec<N::Value>, Error> {
    // backwards: which points each pass must make, and how
    let mut plans = Vec::with_capacity(level.passes.len());
    let mut needed: BTreeSet<Site> = targets.iter().map(|&site| net.orbit(site)).collect();
    for pass in (0..level.passes.len()).rev() {
        let mut plan = Vec::with_capacity(needed.len());
        for site in needed {
            plan.push((site, level.stencil(pass, site)?));
        }
        needed = plan
            .iter()
            .flat_map(|(_, stencil)| stencil.terms())
            .map(|&(site, _)| net.orbit(site))
            .collect();
        plans.push(plan);
    }
    // forwards: make them
    let mut values = BTreeMap::new();
    for site in needed {
        values.insert(site, net.control(site)?);
    }
    for plan in plans.into_iter().rev() {
        let made = plan.into_iter().map(|(site, stencil)| {
            let mut sum = net.zero();
            for &(source, weight) in stencil.terms() {
                net.accumulate(&mut sum, weight, &values[&net.orbit(source)], source);
            }
            (site, sum)
        });
        values = made.collect();
    }
    Ok(targets
        .iter()
        .map(|&site| {
            let mut value = net.zero();
            net.accumulate(&mut value, S::one(), &values[&net.orbit(site)], site);
            value
        })
        .collect())
}

/// Control points are unit vectors: a refined point's value is its row of the local matrix, columns in the order of the
/// numbering.
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

    fn accumulate(&self, sum: &mut Vec<S>, weight: S, at_orbit: &Vec<S>, _site: Site) {
        for (sum, &entry) in sum.iter_mut().zip(at_orbit) {
            *sum += weight * entry;
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
        [S::zero(); D]
    }

    fn control(&self, site: Site) -> Result<[S; D], Error> {
        Ok(self.points[beyond(self.numbering, site)?])
    }

    fn orbit(&self, site: Site) -> Site {
        site
    }

    fn accumulate(&self, sum: &mut [S; D], weight: S, at_orbit: &[S; D], _site: Site) {
        for (sum, &coordinate) in sum.iter_mut().zip(at_orbit) {
            *sum += weight * coordinate;
        }
    }
}

/// Control points of Fourier index `k`: `P_i(x, y) = w^{k i} v(x, y)`, `w = exp(2 pi i / N)`; a refined point's value is its
/// row of the block `S_k`, a complex linear form.
///
/// For a level with mirror symmetry the unknowns are **real**: points of a spoke have `v = r`, points of the diagonal
/// `v = w^{k/2} r`, and a pair of points `(x, y), (y, x)` with `x > y > 0` has `v = w^{k/2} (p + i q)` and
/// `w^{k/2} (p - i q)`, `p` standing in the column of `(x, y)` and `q` in that of `(y, x)`. In these unknowns the block is a
/// real matrix, and only points with `x >= y` need be computed.
#[derive(Clone, Debug)]
pub struct FourierNet<S> {
    /// The control points.
    numbering: Numbering,
    index: usize,
    mirror: bool,
    /// `w^{k j/2}` for `j = 0 .. 2N`.
    half_phases: Vec<Complex<S>>,
}

/// A complex number as (real, imaginary).
pub type Complex<S> = (S, S);

fn times<S: Scalar>(a: Complex<S>, b: Complex<S>) -> Complex<S> {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

impl<S: Scalar> FourierNet<S> {
    /// The net of Fourier index `index`, with real unknowns if `mirror`.
    ///
    /// # Errors
    /// [`Error::FourierIndex`] unless `index` is below the number of sectors.
    pub fn new(numbering: Numbering, index: usize, mirror: bool) -> Result<Self, Error> {
        let n = numbering.fan.sectors();
        if index >= n {
            return Err(Error::FourierIndex { index, valence: n });
        }
        let half_phases = (0..2 * n)
            .map(|j| {
                let (k, n) = ((index * j) as i64, 2 * n as i64);
                (S::cos_turn(k, n), S::sin_turn(k, n))
            })
            .collect();
        Ok(FourierNet {
            numbering,
            index,
            mirror,
            half_phases,
        })
    }

    /// The size of the block: points of one sector, and the centre if the index is 0 and the centre is a point.
    pub fn size(&self) -> usize {
        self.numbering.sector_points() + self.centre()
    }

    fn centre(&self) -> usize {
        usize::from(self.index == 0 && self.numbering.lattice.parity() == 0)
    }

    /// The points whose rows make up the block, in row order: the centre if it takes part, then those of sector 0.
    pub fn rows(&self) -> Vec<Site> {
        let centre = (self.centre() == 1).then_some(Site::CENTRE);
        centre.into_iter().chain(self.numbering.sector_sites(0)).collect()
    }

    fn column(&self, site: Site) -> Result<usize, Error> {
        self.numbering
            .index_in_sector(site)
            .map(|index| index + self.centre())
            .ok_or(Error::BeyondNet {
                site,
                rings: self.numbering.rings,
            })
    }

    /// `w^{k j / 2}`.
    fn half_phase(&self, j: usize) -> Complex<S> {
        self.half_phases[j % self.half_phases.len()]
    }

    /// The value of a mode at a site, given its unknowns (real ones as (r, 0) if the net has mirror symmetry).
    pub fn mode(&self, unknowns: &[Complex<S>], site: Site) -> Result<Complex<S>, Error> {
        let row = self.control(self.orbit(site))?;
        let mut moved = self.zero();
        self.accumulate(&mut moved, S::one(), &row, site);
        let mut sum = (S::zero(), S::zero());
        for (&coefficient, &unknown) in moved.iter().zip(unknowns) {
            let term = times(coefficient, unknown);
            sum.0 += term.0;
            sum.1 += term.1;
        }
        Ok(sum)
    }

    /// The weight of a point in a linear form on the modes of this index, given the form's coefficients on the unknowns: if
    /// `P` is any net, the sum of these weights times the points is the form's value on the unknowns of P's part of index k.
    ///
    /// # Errors
    /// [`Error::BeyondNet`] if the net does not reach `site`.
    pub fn functional(&self, coefficients: &[Complex<S>], site: Site) -> Result<Complex<S>, Error> {
        if site == Site::CENTRE {
            let part = self.centre() == 1;
            return Ok(if part { coefficients[0] } else { (S::zero(), S::zero()) });
        }
        let own = coefficients[self.column(site)?];
        let swapped = Site {
            x: site.y,
            y: site.x,
            ..site
        };
        // the unknowns in terms of the values: r = v; r = w^{-k/2} v; p = w^{-k/2} (v + v')/2; q = w^{-k/2} (v - v')/2i
        let (half_turns, own) = if !self.mirror || site.y == 0 {
            (0, own)
        } else if site.x == site.y {
            (1, own)
        } else {
            let other = coefficients[self.column(swapped)?];
            let half = S::ratio(1, 2);
            let (p, q, sign) = if site.x > site.y {
                (own, other, half)
            } else {
                (other, own, -half)
            };
            // (p -+ i q) / 2
            (1, (half * p.0 + sign * q.1, half * p.1 - sign * q.0))
        };
        let phase = self.half_phase(2 * site.sector + half_turns);
        let n = S::ratio(self.numbering.fan.sectors() as i64, 1);
        Ok(times((phase.0 / n, -(phase.1 / n)), own))
    }

    /// The block's row of the unknown at `site` (of [`FourierNet::rows`]), from the value of its orbit. Imaginary parts are
    /// zero with mirror symmetry.
    pub fn unknown_row(&self, site: Site, at_orbit: &[Complex<S>]) -> Vec<Complex<S>> {
        if !self.mirror || site == Site::CENTRE {
            return at_orbit.to_vec();
        }
        let phase = if site.y == 0 {
            (S::one(), S::zero())
        } else {
            self.half_phase(1)
        };
        let back = (phase.0, -phase.1);
        at_orbit
            .iter()
            .map(|&coefficient| {
                let (p, q) = times(back, coefficient);
                (if site.x >= site.y { p } else { q }, S::zero())
            })
            .collect()
    }
}

impl<S: Scalar> Net<S> for FourierNet<S> {
    type Value = Vec<Complex<S>>;

    fn zero(&self) -> Vec<Complex<S>> {
        vec![(S::zero(), S::zero()); self.size()]
    }

    fn control(&self, site: Site) -> Result<Vec<Complex<S>>, Error> {
        let mut row = self.zero();
        let one = (S::one(), S::zero());
        if site == Site::CENTRE {
            // the centre is zero in every mode but those of index 0
            if self.centre() == 1 {
                row[0] = one;
            }
        } else if !self.mirror || site.y == 0 {
            row[self.column(site)?] = one;
        } else {
            let phase = self.half_phase(1);
            row[self.column(site)?] = phase;
            if site.x > site.y {
                row[self.column(Site {
                    x: site.y,
                    y: site.x,
                    ..site
                })?] = (-phase.1, phase.0);
            }
        }
        Ok(row)
    }

    fn orbit(&self, site: Site) -> Site {
        let (x, y) = if self.mirror && site.x < site.y {
            (site.y, site.x)
        } else {
            (site.x, site.y)
        };
        Site { sector: 0, x, y }
    }

    /// A point `(x, y)` with `x < y` is the reflection of `(y, x)`: its value is `w^{k (2i+1)/2}` times the conjugate of
    /// `w^{-k/2} v(y, x)`.
    fn accumulate(&self, sum: &mut Vec<Complex<S>>, weight: S, at_orbit: &Vec<Complex<S>>, site: Site) {
        if site == Site::CENTRE {
            if self.index == 0 {
                for (sum, &value) in sum.iter_mut().zip(at_orbit) {
                    sum.0 += weight * value.0;
                    sum.1 += weight * value.1;
                }
            }
            return;
        }
        let conjugate = self.mirror && site.x < site.y;
        let turns = 2 * site.sector + if conjugate { 2 } else { 0 };
        let phase = self.half_phase(turns);
        let factor = (weight * phase.0, weight * phase.1);
        for (sum, &(re, im)) in sum.iter_mut().zip(at_orbit) {
            let term = times(factor, (re, if conjugate { -im } else { im }));
            sum.0 += term.0;
            sum.1 += term.1;
        }
    }
}
