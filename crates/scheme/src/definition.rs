//! A scheme at all corners.

use crate::families::{catmull_clark_around, tension_around, with_intervals};
use crate::user::UserScheme;
use crate::{Centre, Corner, Error, Exact, Lattice, Scalar, Scheme, Spec};

/// A scheme before it is known around what: a family with its parameters, or a file. [`Definition::around`]
/// is the only way from a name or a file to rules.
#[derive(Clone, Debug)]
pub enum Definition {
    /// A registered family.
    Family(Spec),
    /// A scheme file, read and checked.
    File(Box<UserScheme>),
}

impl Definition {
    /// The scheme's name.
    pub fn name(&self) -> String {
        match self {
            Definition::Family(spec) => spec.to_string(),
            Definition::File(file) => file.name(),
        }
    }

    /// What the scheme has in the middle of its closed fans.
    pub fn centre(&self) -> Centre {
        let lattice = match self {
            Definition::Family(Spec::DooSabin | Spec::DooSabinUniform) => Lattice::Face,
            Definition::Family(spec) => match spec.order_and_tension() {
                Some((order, _)) if order % 2 == 1 => Lattice::Face,
                _ => Lattice::Vertex,
            },
            Definition::File(file) => file.lattice(),
        };
        match lattice {
            Lattice::Vertex => Centre::Vertex,
            Lattice::Face => Centre::Face,
        }
    }

    /// The closed fan of so many like sectors that the scheme has rules for.
    ///
    /// # Errors
    /// Those of [`Corner::closed`].
    pub fn closed(&self, valence: usize) -> Result<Corner, Error> {
        Corner::closed(self.centre(), valence)
    }

    /// The rules around an inner centre of any valence: those [around](Definition::around) a closed fan of so
    /// many like sectors, of which there may be more than a local matrix can have.
    ///
    /// # Errors
    /// Those of the family or file.
    pub fn inner<S: Scalar + Copy>(&self, valence: usize) -> Result<Scheme<S>, Error> {
        match self {
            Definition::Family(spec) => spec.scheme(valence),
            Definition::File(file) => file.scheme(valence),
        }
    }

    /// The rules around a corner.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a kind of corner that the scheme has no rules for; those of the family or
    /// file.
    pub fn around<S: Scalar + Copy>(&self, corner: &Corner) -> Result<Scheme<S>, Error> {
        let valence = corner.sectors().sectors();
        if corner.is_plain() && corner.centre() == self.centre() {
            return self.inner(valence);
        }
        self.beside_features(corner)
    }

    /// The rules in exact numbers; `None` where the weights are no [`Exact`] ones.
    ///
    /// # Errors
    /// As [`Definition::around`].
    pub fn exact(&self, corner: &Corner) -> Result<Option<Scheme<Exact>>, Error> {
        let valence = corner.sectors().sectors();
        if corner.is_plain() && corner.centre() == self.centre() {
            return match self {
                Definition::Family(spec) => spec.exact(valence),
                Definition::File(file) => Ok(Some(file.exact(valence)?)),
            };
        }
        self.beside_features(corner).map(Some)
    }

    /// The families that have rules beside boundaries, creases and knots run in every scalar.
    fn beside_features<S: Scalar>(&self, corner: &Corner) -> Result<Scheme<S>, Error> {
        let name = self.name();
        let Definition::Family(spec) = self else {
            return Err(Error::Unsupported {
                scheme: name,
                corner: corner.to_string(),
                accepted: "closed fans without creases and knot intervals, as files describe them".to_owned(),
            });
        };
        if corner.centre() == Centre::SplitFace && *spec == Spec::CatmullClark {
            return with_intervals("hnuss", corner);
        }
        let scheme = match spec.order_and_tension() {
            Some((order, u0)) => tension_around(corner, order, u0)?,
            None if *spec == Spec::DooSabin => {
                return Err(Error::Unsupported {
                    scheme: name,
                    corner: corner.to_string(),
                    accepted: "closed fans of faces without creases and knot intervals".to_owned(),
                });
            }
            // the lambda-scheme follows Catmull and Clark on boundaries and creases
            None => catmull_clark_around(corner)?,
        };
        Ok(scheme.named(name))
    }
}
