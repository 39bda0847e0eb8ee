//! The rules of a scheme at every valence at once.
//!
//! What the valence enters is written down in closed form: the stencils of the centre and of the points next
//! to it. All other points follow lines that know nothing of the valence; their rows are taken from the
//! scheme at one [`NOMINAL`] valence, where it is checked that they are no special points, have rational
//! weights, and read no ring beyond their own.

use crate::{Error, Interval};
use eigenring_scheme::families::{catmull_clark, doo_sabin};
use eigenring_scheme::{BigRational, Exact, OneRing, Scalar, Scheme, Site};
use eigenring_spectral::Annulus;
use serde::{Deserialize, Serialize};

/// A valence at which rows are read: large enough for no row to meet itself around the centre.
const NOMINAL: usize = 9;

/// A scheme with one rule for all valences.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// Catmull and Clark (1978).
    CatmullClark,
    /// Doo and Sabin (1978), with their own weights.
    DooSabin,
}

impl Family {
    /// All of them.
    pub const ALL: [Family; 2] = [Family::CatmullClark, Family::DooSabin];

    /// The name in schemes' names.
    pub fn name(self) -> &'static str {
        match self {
            Family::CatmullClark => "catmull-clark",
            Family::DooSabin => "doo-sabin",
        }
    }
}

/// The points next to the centre.
#[derive(Clone, Debug)]
pub(super) enum Inner {
    /// Around a vertex: stencils of edge and face points that are the same at all valences, and one of the
    /// vertex with total weights `alpha/N` and `beta/N` of its neighbours and `own[0] + own[1]/N` of itself.
    Vertex {
        /// The weights; `alpha` and `beta` are N times the totals.
        weights: Box<OneRing<BigRational>>,
        /// The vertex's own weight.
        own: [BigRational; 2],
    },
    /// Around a face: its corners follow one circulant stencil. Its eigenvalues are 1 in block 0, `first` in
    /// the blocks 1 and N-1, `others` in all other blocks.
    Face {
        /// Of index 1.
        first: BigRational,
        /// Of the indices 2 to N-2.
        others: BigRational,
        /// Whether all weights are positive.
        positive: bool,
    },
}

/// A weight of a row: how many sectors further on the point lies, its image in sector 0, and the weight.
pub(super) type Weight = (i64, Site, BigRational);

/// All that is the same at every valence.
#[derive(Clone, Debug)]
pub(super) struct Rules {
    /// The points next to the centre.
    pub inner: Inner,
    /// The annulus of patches, at the nominal valence.
    pub annulus: Annulus,
    /// The rows of the points of sector 0 beyond these, ring by ring.
    pub outer: Vec<Vec<(Site, Vec<Weight>)>>,
    /// Whether the weights of all rows sum to 1.
    pub affine: bool,
    /// Whether no weight of the rows beyond the inner ones is negative.
    pub positive: bool,
}

/// `p/q`.
pub(super) fn ratio(p: i64, q: i64) -> BigRational {
    BigRational::new(p.into(), q.into())
}

impl Rules {
    /// The rules of a family.
    ///
    /// # Errors
    /// None are known: those of running the rules.
    pub fn new(family: Family) -> Result<Option<Self>, Error> {
        match family {
            Family::CatmullClark => {
                let weights = Box::new(OneRing {
                    f1: ratio(1, 4),
                    f2: ratio(1, 4),
                    f3: ratio(1, 4),
                    d1: ratio(3, 8),
                    d2: ratio(3, 8),
                    e1: ratio(1, 16),
                    e2: ratio(1, 16),
                    alpha: ratio(3, 2),
                    beta: ratio(1, 4),
                });
                let own = [ratio(1, 1), ratio(-7, 4)];
                let inner = Inner::Vertex { weights, own };
                Rules::with(inner, &catmull_clark(NOMINAL)?, &catmull_clark(NOMINAL)?)
            }
            // of the weights (3 + 2 cos(2 pi j/N))/(4 N) and 1/4 more at j = 0 the discrete Fourier transform
            // is 1/4 everywhere, 3/4 more at 0, and 1/4 more at 1 and N-1
            Family::DooSabin => {
                let inner = Inner::Face {
                    first: ratio(1, 2),
                    others: ratio(1, 4),
                    positive: true,
                };
                Rules::with(inner, &doo_sabin(NOMINAL)?, &doo_sabin(NOMINAL)?)
            }
        }
    }

    /// The same inner points with what lies beyond them in a scheme at the nominal valence; `None` where that
    /// is not as the module page says.
    fn with(inner: Inner, exact: &Scheme<Exact>, enclosed: &Scheme<Interval>) -> Result<Option<Self>, Error> {
        let (level, annulus) = (exact.limit(), Annulus::new(enclosed)?);
        let numbering = annulus.numbering;
        let first = 1 - numbering.lattice.parity() as usize;
        // one pass, so that no row contains a special stencil of an earlier one
        let single = level.passes().len() == 1 && level.special_rings()?.is_none_or(|ring| ring <= first);
        if !single {
            return Ok(None);
        }
        let mut outer = Vec::new();
        let (mut affine, mut positive) = (inner.is_affine(), true);
        for ring in first + 1..=numbering.rings {
            let sites: Vec<Site> = numbering.sector_sites(0).filter(|site| site.ring() == ring).collect();
            let mut rows = Vec::new();
            for (&site, row) in sites.iter().zip(level.rows(&sites)?) {
                let mut weights = Vec::new();
                for (source, weight) in row {
                    let Some(weight) = weight.as_rational() else {
                        return Ok(None);
                    };
                    let turned = source.sector as i64;
                    let turned = if 2 * turned > NOMINAL as i64 {
                        turned - NOMINAL as i64
                    } else {
                        turned
                    };
                    if level.is_special(0, site) || source.ring() > ring || turned.abs() > 2 {
                        return Ok(None);
                    }
                    weights.push((turned, Site { sector: 0, ..source }, weight));
                }
                let sum: BigRational = weights.iter().map(|(_, _, weight)| weight).sum();
                affine &= sum == ratio(1, 1);
                positive &= weights.iter().all(|(_, _, weight)| *weight >= ratio(0, 1));
                rows.push((site, weights));
            }
            outer.push(rows);
        }
        Ok(Some(Rules {
            inner,
            annulus,
            outer,
            affine,
            positive,
        }))
    }

    /// A strict upper bound of the eigenvalues of all rings beyond the inner points, in every block: rows
    /// read their own ring and those within, so that these are the eigenvalues of the rings one by one, and
    /// turning the sources by phases leaves sums of moduli as they are.
    pub fn outer_radius(&self) -> Interval {
        let rows = self.outer.iter().flatten().map(|(site, weights)| {
            let own = weights.iter().filter(|(_, source, _)| source.ring() == site.ring());
            let sum = own.fold(ratio(0, 1), |sum, (_, _, weight)| {
                if *weight < ratio(0, 1) {
                    sum - weight
                } else {
                    sum + weight
                }
            });
            Interval::rational(&sum)
        });
        rows.fold(Interval::point(0.0), Interval::max)
    }
}

impl Inner {
    /// Whether the weights of each of these stencils sum to 1 at every valence.
    pub fn is_affine(&self) -> bool {
        match self {
            Inner::Vertex { weights: w, own } => {
                let two = ratio(2, 1);
                let face = &w.f1 + &two * &w.f2 + &w.f3;
                let edge = &w.d1 + &w.d2 + &two * (&w.e1 + &w.e2);
                let one = ratio(1, 1);
                face == one && edge == one && own[0] == one && &own[1] + &w.alpha + &w.beta == ratio(0, 1)
            }
            // the sum is the eigenvalue of block 0
            Inner::Face { .. } => true,
        }
    }

    /// Whether no weight of these stencils is negative at any valence from `valence` on.
    pub fn is_positive(&self, valence: usize) -> bool {
        let zero = ratio(0, 1);
        match self {
            Inner::Vertex { weights, own } => {
                // linear in 1/N, which lies between 0 and that of the first valence
                let last = &own[0] + &own[1] * ratio(1, valence.max(1) as i64);
                weights.each().iter().all(|(_, weight)| **weight >= zero) && own[0] >= zero && last >= zero
            }
            Inner::Face { positive, .. } => *positive,
        }
    }
}
