//! One scheme of the family: where a name such as `lambda:optimal` becomes weights.
//!
//! A [`Member`] is a point of a [`Plane`]. Its weights are given, or come from the embedded table. Where the
//! table does not reach, one tunes; this crate cannot, so whoever asks for a member hands in a function that
//! is asked for the [`Untabulated`] one. A caller without a tuner hands in [`Untabulated::refuse`]. So a name
//! means the same to all of them, or is refused.

use super::{LambdaTable, Plane, Relaxation, Splines};
use crate::{Error, Scalar, Scheme};

/// A scheme of the family at one valence.
#[derive(Clone, Copy, Debug)]
pub struct Member {
    /// Valence, lambda, s and phi.
    pub plane: Plane<f64>,
    /// The first free weight.
    pub f2: f64,
    /// The second; at valence 4 it is mu up to rounding, unless it was given.
    pub f3: f64,
    /// Where the weights come from.
    pub source: Source,
}

/// Where weights come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// From whoever asks.
    Given,
    /// From the embedded spline table.
    Table,
    /// From tuning, now or earlier.
    Tuned,
}

impl Source {
    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Source::Given => "given",
            Source::Table => "table",
            Source::Tuned => "tuned",
        }
    }
}

/// A member that the embedded table does not hold.
#[derive(Clone, Copy, Debug)]
pub enum Untabulated {
    /// The globally optimal one of a valence without splines.
    Optimal {
        /// The valence.
        valence: usize,
    },
    /// The best one of a plane: at a valence without splines, a lambda beyond them, or an s that was given.
    At {
        /// Valence, lambda, s and phi.
        plane: Plane<f64>,
    },
}

impl Untabulated {
    /// Refuses it, with what is tabulated.
    ///
    /// # Errors
    /// Always: [`Error::NotTabulated`], [`Error::Spline`], or [`Error::GivenRelaxation`] where valence
    /// and lambda are tabulated and the splines belong to the s of the rule.
    pub fn refuse(self) -> Result<Member, Error> {
        let table = LambdaTable::embedded()?;
        Err(match self {
            Untabulated::Optimal { valence } => match table.entry(valence) {
                Err(error) => error,
                Ok(_) => Error::NotTabulated {
                    valence,
                    tabulated: table.valences().collect(),
                },
            },
            Untabulated::At { plane } => {
                table.entry(plane.valence)?.weights(plane.lambda)?;
                Error::GivenRelaxation {
                    valence: plane.valence,
                    s: plane.s,
                }
            }
        })
    }
}

/// The plane at lambda with the given s, or that of the rule.
fn plane(valence: usize, lambda: f64, s: Option<f64>) -> Result<Plane<f64>, Error> {
    match s {
        Some(s) => Plane::new(valence, lambda, s),
        None => Relaxation::new(valence)?.plane(lambda),
    }
}

impl Member {
    /// The member with given weights, which are taken as they are: what they violate is for an analysis to
    /// show.
    ///
    /// # Errors
    /// Those of [`Plane::new`] and [`Relaxation::plane`].
    pub fn given(valence: usize, lambda: f64, s: Option<f64>, [f2, f3]: [f64; 2]) -> Result<Self, Error> {
        Ok(Member {
            plane: plane(valence, lambda, s)?,
            f2,
            f3,
            source: Source::Given,
        })
    }

    /// The member at lambda: that of the table of these splines where it reaches and s is left to the rule,
    /// else what `beyond` gives.
    ///
    /// # Errors
    /// Those of the plane as in [`Member::given`], and those of `beyond`.
    pub fn at<E: From<Error>>(
        valence: usize,
        lambda: f64,
        s: Option<f64>,
        splines: Splines,
        beyond: impl FnOnce(Untabulated) -> Result<Self, E>,
    ) -> Result<Self, E> {
        let plane = plane(valence, lambda, s)?;
        let tabulated = splines.table()?.entry(valence).ok();
        match tabulated {
            Some(entry) if s.is_none() && (entry.knots.a..=entry.knots.e).contains(&lambda) => {
                let (f2, f3) = entry.weights(lambda)?;
                Ok(Member {
                    plane,
                    f2,
                    f3,
                    source: Source::Table,
                })
            }
            _ => beyond(Untabulated::At { plane }),
        }
    }

    /// The globally optimal member of a valence: that of the table, else what `beyond` gives.
    ///
    /// # Errors
    /// [`Error::Valence`] below 3, and those of `beyond`.
    pub fn optimal<E: From<Error>>(
        valence: usize,
        beyond: impl FnOnce(Untabulated) -> Result<Self, E>,
    ) -> Result<Self, E> {
        if valence < 3 {
            return Err(Error::Valence { valence }.into());
        }
        match LambdaTable::embedded()?.entry(valence) {
            Ok(entry) => Member::at(valence, entry.lambda_optimal, None, Splines::Paper, beyond),
            Err(_) => beyond(Untabulated::Optimal { valence }),
        }
    }

    /// The scheme, in any scalar: valence, lambda, s, phi, f2 and f3 stand for the numbers that they are.
    ///
    /// # Errors
    /// Those of [`OneRing::scheme`](crate::OneRing::scheme), and [`Error::Divisor`].
    pub fn scheme<S: Scalar + Copy>(&self, name: impl Into<String>) -> Result<Scheme<S>, Error> {
        let plane = Plane {
            valence: self.plane.valence,
            lambda: S::exact(self.plane.lambda),
            s: S::exact(self.plane.s),
            phi: S::exact(self.plane.phi),
        };
        self.plane.check(self.f2, self.f3)?;
        let weights = plane.stencil(S::exact(self.f2), S::exact(self.f3)).weights;
        weights.scheme(name, self.plane.valence)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refuse(untabulated: Untabulated) -> Result<Member, Error> {
        untabulated.refuse()
    }

    #[test]
    fn the_table_is_asked_where_it_reaches() {
        let table = LambdaTable::embedded().unwrap();
        for valence in table.valences() {
            let entry = table.entry(valence).unwrap();
            let optimal = Member::optimal(valence, refuse).unwrap();
            assert_eq!(optimal.plane.lambda, entry.lambda_optimal);
            assert_eq!(optimal.source, Source::Table);
            let inside = Member::at(valence, 0.5, None, Splines::Paper, refuse).unwrap();
            assert_eq!((inside.f2, inside.f3), entry.weights(0.5).unwrap());
        }
    }

    #[test]
    fn beyond_the_table_somebody_else_is_asked_or_the_table_is_named() {
        let asked = |untabulated| match untabulated {
            Untabulated::Optimal { valence } => Member::given(valence, 0.6, None, [0.25, 0.2]),
            Untabulated::At { plane } => Member::given(plane.valence, plane.lambda, Some(plane.s), [0.3, 0.1]),
        };
        assert_eq!(Member::optimal(25, asked).unwrap().f2, 0.25);
        for (valence, lambda, s) in [(25, 0.6, None), (6, 0.95, None), (6, 0.5, Some(1.2))] {
            assert_eq!(Member::at(valence, lambda, s, Splines::Fine, asked).unwrap().f2, 0.3);
        }
        assert!(matches!(
            Member::optimal(25, refuse),
            Err(Error::NotTabulated { valence: 25, .. })
        ));
        assert!(matches!(
            Member::at(25, 0.6, None, Splines::Paper, refuse),
            Err(Error::NotTabulated { .. })
        ));
        assert!(matches!(
            Member::at(6, 0.95, None, Splines::Fine, refuse),
            Err(Error::Spline(eigenring_spline::Error::OutsideSpline { .. }))
        ));
        assert!(matches!(
            Member::at(6, 0.5, Some(1.2), Splines::Paper, refuse),
            Err(Error::GivenRelaxation { valence: 6, .. })
        ));
        assert!(matches!(Member::optimal(2, refuse), Err(Error::Valence { valence: 2 })));
    }
}
