//! Nets of one Fourier index: the blocks of rotation-symmetric rules, real ones under mirror symmetry.

use crate::{Complex, Error, Net, Numbering, Scalar, Site};
use std::ops::Range;
use std::sync::Arc;

/// Control points of Fourier index `k`: `P_i(x, y) = w^{k i} v(x, y)`, `w = exp(2 pi i / N)`; a refined
/// point's value is its row of the block `S_k`, a complex linear form.
///
/// For a level with mirror symmetry the unknowns are **real**: points of a spoke have `v = r`, points of the
/// diagonal `v = w^{k/2} r`, and a pair of points `(x, y), (y, x)` with `x > y > 0` has `v = w^{k/2} (p + i
/// q)` and `w^{k/2} (p - i q)`, `p` standing in the column of `(x, y)` and `q` in that of `(y, x)`. In these
/// unknowns the block is a real matrix, and only points with `x >= y` need be computed.
#[derive(Clone, Debug)]
pub struct FourierNet<S> {
    /// The control points.
    numbering: Numbering,
    index: usize,
    mirror: bool,
    /// `w^{j/2}` for `j = 0 .. 2N`, shared by the nets of all indices.
    half_turns: Arc<[Complex<S>]>,
}

/// A linear form on the unknowns of a block.
///
/// A refined point depends on a few rings, which are neighbours in the order of the unknowns: coefficients
/// outside `nonzero` vanish and are not touched.
#[derive(Clone, Debug)]
pub struct Form<S> {
    nonzero: Range<usize>,
    coefficients: Vec<Complex<S>>,
}

impl<S: Scalar> Form<S> {
    /// The coefficients of all unknowns.
    pub fn coefficients(&self) -> &[Complex<S>] {
        &self.coefficients
    }

    fn set(&mut self, column: usize, value: Complex<S>) {
        self.widen(&(column..column + 1));
        self.coefficients[column] = value;
    }

    fn widen(&mut self, range: &Range<usize>) {
        self.nonzero = match (self.nonzero.is_empty(), range.is_empty()) {
            (true, _) => range.clone(),
            (_, true) => return,
            _ => self.nonzero.start.min(range.start)..self.nonzero.end.max(range.end),
        };
    }

    /// Adds `term(c)` to each coefficient, c being that of the other form.
    fn add(&mut self, other: &Form<S>, term: impl Fn(Complex<S>) -> Complex<S>) {
        let range = other.nonzero.clone();
        self.widen(&range);
        for (sum, c) in self.coefficients[range.clone()]
            .iter_mut()
            .zip(&other.coefficients[range])
        {
            *sum += term(c.clone());
        }
    }
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
        Ok(FourierNet {
            numbering,
            index,
            mirror,
            half_turns: (0..2 * n as i64).map(|j| Complex::turn(j, 2 * n as i64)).collect(),
        })
    }

    /// The net of another Fourier index, without computing the roots of unity again.
    ///
    /// # Errors
    /// [`Error::FourierIndex`] unless `index` is below the number of sectors.
    pub fn of_index(&self, index: usize) -> Result<Self, Error> {
        let valence = self.numbering.fan.sectors();
        if index >= valence {
            return Err(Error::FourierIndex { index, valence });
        }
        Ok(FourierNet { index, ..self.clone() })
    }

    /// The size of the block: points of one sector, and the centre if the index is 0 and the centre is a
    /// point.
    pub fn size(&self) -> usize {
        self.numbering.sector_points() + self.centre()
    }

    fn centre(&self) -> usize {
        usize::from(self.index == 0 && self.numbering.lattice.parity() == 0)
    }

    /// The points whose rows make up the block, in row order: the centre if it takes part, then those of
    /// sector 0.
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
        self.half_turns[self.index * j % self.half_turns.len()].clone()
    }

    /// The value of a mode at a site, given its unknowns, which are real if the net has mirror symmetry.
    pub fn mode(&self, unknowns: &[Complex<S>], site: Site) -> Result<Complex<S>, Error> {
        let control = self.control(self.orbit(site))?;
        let mut moved = self.zero();
        self.accumulate(&mut moved, &S::one(), &control, site);
        let mut sum = Complex::zero();
        for (coefficient, unknown) in moved.coefficients.into_iter().zip(unknowns) {
            sum += coefficient * unknown.clone();
        }
        Ok(sum)
    }

    /// The weight of a point in a linear form on the modes of this index, given the form's coefficients on
    /// the unknowns: if `P` is any net, the sum of these weights times the points is the form's value on the
    /// unknowns of P's part of index k.
    ///
    /// # Errors
    /// [`Error::BeyondNet`] if the net does not reach `site`.
    pub fn functional(&self, coefficients: &[Complex<S>], site: Site) -> Result<Complex<S>, Error> {
        if site == Site::CENTRE {
            let part = self.centre() == 1;
            return Ok(if part { coefficients[0].clone() } else { Complex::zero() });
        }
        let own = coefficients[self.column(site)?].clone();
        let swapped = Site {
            x: site.y,
            y: site.x,
            ..site
        };
        // the unknowns in terms of the values: r = v; r = w^{-k/2} v; p = w^{-k/2} (v + v')/2; q = w^{-k/2}
        // (v - v')/2i
        let (half_turns, own) = if !self.mirror || site.y == 0 {
            (0, own)
        } else if site.x == site.y {
            (1, own)
        } else {
            let other = coefficients[self.column(swapped)?].clone();
            let half = S::ratio(1, 2);
            let (p, q, sign) = if site.x > site.y {
                (own, other, half.clone())
            } else {
                (other, own, -half.clone())
            };
            // (p -+ i q) / 2
            (1, p.scale(half) + Complex::new(q.im, -q.re).scale(sign))
        };
        let phase = self.half_phase(2 * site.sector + half_turns);
        let n = S::ratio(self.numbering.fan.sectors() as i64, 1);
        Ok(Complex::new(phase.re / n.clone(), -(phase.im / n)) * own)
    }

    /// The block's row of the unknown at `site` (of [`FourierNet::rows`]), from the value of its orbit.
    /// Imaginary parts are zero with mirror symmetry.
    pub fn unknown_row(&self, site: Site, at_orbit: &Form<S>) -> Vec<Complex<S>> {
        let at_orbit = at_orbit.coefficients();
        if !self.mirror || site == Site::CENTRE {
            return at_orbit.to_vec();
        }
        let phase = if site.y == 0 {
            Complex::one()
        } else {
            self.half_phase(1)
        };
        let back = phase.conj();
        at_orbit
            .iter()
            .map(|coefficient| {
                let Complex { re: p, im: q } = back.clone() * coefficient.clone();
                Complex::real(if site.x >= site.y { p } else { q })
            })
            .collect()
    }
}

impl<S: Scalar> Net<S> for FourierNet<S> {
    type Value = Form<S>;

    fn zero(&self) -> Form<S> {
        Form {
            nonzero: 0..0,
            coefficients: vec![Complex::zero(); self.size()],
        }
    }

    fn control(&self, site: Site) -> Result<Form<S>, Error> {
        let mut form = self.zero();
        let one = Complex::one();
        if site == Site::CENTRE {
            // the centre is zero in every mode but those of index 0
            if self.centre() == 1 {
                form.set(0, one);
            }
        } else if !self.mirror || site.y == 0 {
            form.set(self.column(site)?, one);
        } else {
            let phase = self.half_phase(1);
            form.set(self.column(site)?, phase.clone());
            if site.x > site.y {
                let swapped = Site {
                    x: site.y,
                    y: site.x,
                    ..site
                };
                form.set(self.column(swapped)?, Complex::new(-phase.im, phase.re));
            }
        }
        Ok(form)
    }

    fn orbit(&self, site: Site) -> Site {
        let (x, y) = if self.mirror && site.x < site.y {
            (site.y, site.x)
        } else {
            (site.x, site.y)
        };
        Site { sector: 0, x, y }
    }

    /// A point `(x, y)` with `x < y` is the reflection of `(y, x)`: its value is `w^{k (2i+1)/2}` times the
    /// conjugate of `w^{-k/2} v(y, x)`.
    fn accumulate(&self, sum: &mut Form<S>, weight: &S, at_orbit: &Form<S>, site: Site) {
        if site == Site::CENTRE && self.index != 0 {
            return;
        }
        let conjugate = self.mirror && site.x < site.y;
        let turns = 2 * site.sector + if conjugate { 2 } else { 0 };
        if turns == 0 {
            // most sources lie in the sector of their target
            return sum.add(at_orbit, |c| c.scale(weight.clone()));
        }
        let factor = self.half_phase(turns).scale(weight.clone());
        sum.add(at_orbit, |c| factor.clone() * if conjugate { c.conj() } else { c });
    }
}
