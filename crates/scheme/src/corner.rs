//! What a scheme sees at a centre: how sectors are joined there, and what its spokes carry.

use crate::{Error, Fan, Lattice};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::hash::{Hash, Hasher};

/// What is in the middle of the fan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Centre {
    /// A control point.
    Vertex,
    /// The middle of a face.
    Face,
    /// The middle of a face that is never split, between strips of faces of zero width along its spokes:
    /// control points are doubled along each spoke (HNUSS: Li, Wei and Zhang 2019, section 4).
    SplitFace,
}

impl Centre {
    /// The kind of net around it.
    pub fn lattice(self) -> Lattice {
        match self {
            Centre::Vertex => Lattice::Vertex,
            Centre::Face | Centre::SplitFace => Lattice::Face,
        }
    }
}

/// A chain of edges that starts at the centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spoke {
    /// Whether it is a boundary or a crease that never softens.
    pub sharp: bool,
    /// The knot interval of its first edge; only ratios matter.
    pub interval: f64,
    /// The knot interval of all edges further out.
    pub next: f64,
}

impl Spoke {
    /// A spoke like all others of a uniform net.
    pub const SMOOTH: Spoke = Spoke {
        sharp: false,
        interval: 1.0,
        next: 1.0,
    };

    /// A boundary, or a crease of full sharpness, in a uniform net.
    pub const SHARP: Spoke = Spoke {
        sharp: true,
        ..Spoke::SMOOTH
    };
}

/// Fans with more sectors are a typing error rather than a corner: a dense local matrix would not fit into
/// memory.
pub const MAX_SECTORS: usize = 1000;

/// A corner in few words: what certificates store and options say.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Shape {
    /// A closed fan of like sectors.
    Closed {
        /// How many.
        sectors: usize,
    },
    /// An open fan: a boundary vertex, or one side of a crease vertex.
    Fan {
        /// The number of faces.
        faces: usize,
        /// Whether the vertex is a corner.
        corner: bool,
    },
    /// A vertex at which one crease ends.
    Dart {
        /// The valence.
        valence: usize,
    },
    /// A fixed vertex without creases.
    Cusp {
        /// The valence.
        valence: usize,
    },
    /// A closed fan with knot intervals.
    Knots {
        /// Of the first edge of each spoke.
        intervals: Vec<f64>,
        /// Of all further edges of each spoke.
        next: Vec<f64>,
    },
}

impl Shape {
    /// The corner of this shape around a centre of the given kind, with creases that act in the given number
    /// of steps.
    ///
    /// # Errors
    /// Those of the constructors of [`Corner`].
    pub fn corner(&self, centre: Centre, steps: Option<usize>) -> Result<Corner, Error> {
        let corner = match self {
            &Shape::Closed { sectors } => Corner::closed(centre, sectors)?,
            &Shape::Fan { faces, corner: false } => Corner::fan(faces)?,
            &Shape::Fan { faces, corner: true } => Corner::fan(faces)?.fixed(),
            &Shape::Dart { valence } => Corner::dart(valence)?,
            &Shape::Cusp { valence } => Corner::cusp(valence)?,
            Shape::Knots { intervals, next } => {
                Corner::closed(centre, intervals.len())?.with_intervals(intervals, next)?
            }
        };
        Ok(match steps {
            Some(steps) => corner.with_steps(steps),
            None => corner,
        })
    }
}

/// A centre with everything that decides the rules around it.
///
/// A closed fan has N spokes, an open one, which is a boundary or one side of a crease, N + 1, of which the
/// first and the last are sharp. With one sharp spoke a closed fan is a **dart**. The centre may be fixed: a
/// **corner** if it has sharp spokes, a **cusp** if it has none.
#[derive(Clone, Debug)]
pub struct Corner {
    fan: Fan,
    centre: Centre,
    spokes: Vec<Spoke>,
    fixed: bool,
    steps: Option<usize>,
}

/// Whether a number is a knot interval that rules take: 0, or a number from 1e-60 to 1e60, so that products
/// of four, which rules form, are doubles.
pub fn is_interval(value: f64) -> bool {
    value == 0.0 || (1e-60..=1e60).contains(&value)
}

impl Corner {
    /// A closed fan of `sectors` sectors, the same all round.
    ///
    /// # Errors
    /// [`Error::Valence`] below 3, [`Error::Sectors`] beyond [`MAX_SECTORS`].
    pub fn closed(centre: Centre, sectors: usize) -> Result<Self, Error> {
        if sectors < 3 {
            return Err(Error::Valence { valence: sectors });
        }
        Self::of(Fan::Closed(sectors), centre, Spoke::SMOOTH)
    }

    /// A vertex on a boundary, or one side of a crease vertex, with so many faces. With one face it is a
    /// crease vertex as well, unless it is [fixed](Corner::fixed).
    ///
    /// # Errors
    /// [`Error::Sectors`] unless there are 1 to [`MAX_SECTORS`] faces.
    pub fn fan(faces: usize) -> Result<Self, Error> {
        let mut corner = Self::of(Fan::Open(faces), Centre::Vertex, Spoke::SMOOTH)?;
        (corner.spokes[0], corner.spokes[faces]) = (Spoke::SHARP, Spoke::SHARP);
        Ok(corner)
    }

    /// A vertex of the given valence at which one crease ends.
    ///
    /// # Errors
    /// As [`Corner::closed`].
    pub fn dart(valence: usize) -> Result<Self, Error> {
        let mut corner = Self::closed(Centre::Vertex, valence)?;
        corner.spokes[0] = Spoke::SHARP;
        Ok(corner)
    }

    /// A fixed vertex of the given valence without creases.
    ///
    /// # Errors
    /// As [`Corner::closed`].
    pub fn cusp(valence: usize) -> Result<Self, Error> {
        Ok(Self::closed(Centre::Vertex, valence)?.fixed())
    }

    fn of(fan: Fan, centre: Centre, spoke: Spoke) -> Result<Self, Error> {
        let sectors = fan.sectors();
        if !(1..=MAX_SECTORS).contains(&sectors) {
            return Err(Error::Sectors {
                sectors,
                maximum: MAX_SECTORS,
            });
        }
        Ok(Corner {
            fan,
            centre,
            spokes: vec![spoke; fan.spokes()],
            fixed: false,
            steps: None,
        })
    }

    /// The same with a centre that stays where it is.
    pub fn fixed(mut self) -> Self {
        self.fixed = true;
        self
    }

    /// The same with creases, and a fixed centre, that act in the first `steps` smoothing steps of each level
    /// only; boundaries act in all. For schemes of even order with several steps.
    pub fn with_steps(mut self, steps: usize) -> Self {
        self.steps = Some(steps);
        self
    }

    /// The same with knot intervals: of the first edge of each spoke, and of all further ones.
    ///
    /// # Errors
    /// [`Error::Intervals`] unless there is one pair for each spoke, all finite and not negative, and no
    /// spoke is zero as a whole.
    pub fn with_intervals(mut self, intervals: &[f64], next: &[f64]) -> Result<Self, Error> {
        let spokes = self.spokes.len();
        for list in [intervals, next] {
            let bad = list.iter().position(|&d| !is_interval(d));
            if list.len() != spokes || bad.is_some() {
                return Err(Error::Intervals {
                    found: list.len(),
                    expected: spokes,
                    bad: bad.map(|index| (index, list[index])),
                });
            }
        }
        for (spoke, (&interval, &next)) in self.spokes.iter_mut().zip(intervals.iter().zip(next)) {
            (spoke.interval, spoke.next) = (interval, next);
        }
        Ok(self)
    }

    /// How the sectors are joined.
    pub fn sectors(&self) -> Fan {
        self.fan
    }

    /// What is in the middle.
    pub fn centre(&self) -> Centre {
        self.centre
    }

    /// The spokes, in order.
    pub fn spokes(&self) -> &[Spoke] {
        &self.spokes
    }

    /// Whether the centre stays where it is.
    pub fn is_fixed(&self) -> bool {
        self.fixed
    }

    /// In how many smoothing steps of a level creases act; `None` for all.
    pub fn steps(&self) -> Option<usize> {
        self.steps
    }

    /// Whether there is nothing but a closed fan of like sectors.
    pub fn is_plain(&self) -> bool {
        self.fan.is_closed() && !self.fixed && !self.has_creases() && self.is_uniform()
    }

    /// Whether a spoke is sharp.
    pub fn has_creases(&self) -> bool {
        self.spokes.iter().any(|spoke| spoke.sharp)
    }

    /// The knot intervals of each spoke: of its first edge, and of all further ones.
    pub fn intervals(&self) -> Vec<Vec<f64>> {
        let spokes = self.spokes.iter();
        spokes.map(|spoke| vec![spoke.interval, spoke.next]).collect()
    }

    /// Whether all knot intervals are alike.
    pub fn is_uniform(&self) -> bool {
        let first = self.spokes[0].interval;
        let mut all = self.spokes.iter().flat_map(|spoke| [spoke.interval, spoke.next]);
        first > 0.0 && all.all(|interval| interval == first)
    }

    /// What decides the rules, with intervals as bits so that they can be compared.
    fn key(&self) -> impl Eq + Hash {
        let bits = |spoke: &Spoke| (spoke.sharp, spoke.interval.to_bits(), spoke.next.to_bits());
        let spokes: Vec<(bool, u64, u64)> = self.spokes.iter().map(bits).collect();
        (self.fan, self.centre, spokes, self.fixed, self.steps)
    }
}

/// Corners are the keys of caches of masks, spectra and limit functionals.
impl PartialEq for Corner {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}

impl Eq for Corner {}

impl Hash for Corner {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.key().hash(state);
    }
}

impl fmt::Display for Corner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sharp = self.spokes.iter().filter(|spoke| spoke.sharp).count();
        match (self.fan, sharp, self.fixed) {
            (Fan::Open(_), ..) if self.fixed => write!(f, "fan, corner")?,
            (Fan::Open(_), ..) => write!(f, "fan")?,
            (Fan::Closed(_), 0, false) => write!(f, "closed")?,
            (Fan::Closed(_), 0, true) => write!(f, "cusp")?,
            (Fan::Closed(_), 1, false) => write!(f, "dart")?,
            (Fan::Closed(_), creases, fixed) => {
                write!(f, "{creases} creases{}", if fixed { ", corner" } else { "" })?;
            }
        }
        if let Some(steps) = self.steps {
            write!(f, ", cs {steps}")?;
        }
        if !self.is_uniform() {
            let list = |of: fn(&Spoke) -> f64| -> String {
                let texts: Vec<String> = self.spokes.iter().map(|spoke| of(spoke).to_string()).collect();
                texts.join(",")
            };
            write!(
                f,
                ", knots {} next {}",
                list(|spoke| spoke.interval),
                list(|spoke| spoke.next)
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_say_what_they_are() {
        let text = |corner: Corner| corner.to_string();
        assert_eq!(text(Corner::closed(Centre::Face, 5).unwrap()), "closed");
        assert_eq!(text(Corner::fan(2).unwrap().fixed()), "fan, corner");
        assert_eq!(text(Corner::dart(5).unwrap().with_steps(1)), "dart, cs 1");
        assert_eq!(text(Corner::cusp(3).unwrap()), "cusp");
        let knots = Corner::closed(Centre::Vertex, 3)
            .unwrap()
            .with_intervals(&[1.0, 0.5, 2.0], &[1.0; 3])
            .unwrap();
        assert_eq!(text(knots.clone()), "closed, knots 1,0.5,2 next 1,1,1");
        assert!(!knots.is_plain() && knots != Corner::closed(Centre::Vertex, 3).unwrap());
        assert!(Corner::fan(1).unwrap().has_creases() && !Corner::fan(1).unwrap().is_plain());
    }

    #[test]
    fn what_is_no_corner_is_refused() {
        assert!(Corner::closed(Centre::Vertex, 2).is_err() && Corner::fan(0).is_err());
        assert!(Corner::fan(MAX_SECTORS + 1).is_err());
        let corner = || Corner::closed(Centre::Vertex, 3).unwrap();
        for bad in [&[1.0, 1.0][..], &[1.0, -1.0, 1.0], &[1.0, f64::NAN, 1.0]] {
            let error = corner().with_intervals(bad, &[1.0; 3]).unwrap_err().to_string();
            assert!(error.contains("accepted"), "{error}");
        }
    }
}
