//! Schemes that change only the three stencils next to an extraordinary vertex of a bicubic surface.

use crate::{Error, Fan, Lattice, Level, Line, Pass, Same, Scalar, Scheme, Site, Stencil};

/// The nine weights of a one-ring scheme around a vertex V with neighbours E_i (edges) and F_i (faces,
/// between E_i and E_{i+1}):
///
/// ```text
/// F_i' = f1 V + f2 (E_i + E_{i+1}) + f3 F_i
/// E_i' = d1 V + d2 E_i + e1 (E_{i-1} + E_{i+1}) + e2 (F_{i-1} + F_i)
/// V'   = (1 - alpha - beta) V + alpha/N sum E_i + beta/N sum F_i
/// ```
///
/// `alpha` and `beta` are **total** weights of the vertex stencil. Affine invariance is `f1 + 2 f2 + f3 = 1`
/// and `d1 + d2 + 2 e1 + 2 e2 = 1`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // the weights are defined by the rules above
pub struct OneRing<S> {
    pub f1: S,
    pub f2: S,
    pub f3: S,
    pub d1: S,
    pub d2: S,
    pub e1: S,
    pub e2: S,
    pub alpha: S,
    pub beta: S,
}

/// The neighbours E_0 and F_0 of the centre.
const EDGE: Site = Site { sector: 0, x: 2, y: 0 };
const FACE: Site = Site { sector: 0, x: 2, y: 2 };

impl<S> OneRing<S> {
    /// The same weights in another number type.
    pub fn map<T>(self, mut f: impl FnMut(S) -> T) -> OneRing<T> {
        OneRing {
            f1: f(self.f1),
            f2: f(self.f2),
            f3: f(self.f3),
            d1: f(self.d1),
            d2: f(self.d2),
            e1: f(self.e1),
            e2: f(self.e2),
            alpha: f(self.alpha),
            beta: f(self.beta),
        }
    }
}

impl<S> OneRing<S> {
    /// References to the weights with their names, in the order of the fields.
    pub fn each(&self) -> [(&'static str, &S); 9] {
        [
            ("f1", &self.f1),
            ("f2", &self.f2),
            ("f3", &self.f3),
            ("d1", &self.d1),
            ("d2", &self.d2),
            ("e1", &self.e1),
            ("e2", &self.e2),
            ("alpha", &self.alpha),
            ("beta", &self.beta),
        ]
    }
}

impl<S: Clone> OneRing<S> {
    /// The level with these weights, of the centre's own weight, that of each edge neighbour and of each face
    /// neighbour in `[own, edge, face]`, and with the regular ones made by `ratio`.
    pub(crate) fn level_of(
        &self,
        valence: usize,
        special: impl Fn(Site) -> bool,
        [own, edge, face]: [S; 3],
        ratio: impl Fn(i64, i64) -> S,
    ) -> Result<Level<S>, Error> {
        Ok(Name::level(valence, special)?.map(|name| match name {
            Name::F1 => self.f1.clone(),
            Name::F2 => self.f2.clone(),
            Name::F3 => self.f3.clone(),
            Name::D1 => self.d1.clone(),
            Name::D2 => self.d2.clone(),
            Name::E1 => self.e1.clone(),
            Name::E2 => self.e2.clone(),
            Name::Own => own.clone(),
            Name::Alpha => edge.clone(),
            Name::Beta => face.clone(),
            Name::Regular(p, q) => ratio(*p, *q),
        }))
    }
}

impl<S: Scalar> OneRing<S> {
    /// The weights with their names, in the order of the fields.
    pub fn named(self) -> [(&'static str, S); 9] {
        [
            ("f1", self.f1),
            ("f2", self.f2),
            ("f3", self.f3),
            ("d1", self.d1),
            ("d2", self.d2),
            ("e1", self.e1),
            ("e2", self.e2),
            ("alpha", self.alpha),
            ("beta", self.beta),
        ]
    }

    /// The scheme: uniform bicubic refinement with these stencils at V, E_i and F_i. It has dihedral symmetry
    /// whatever the weights are.
    ///
    /// # Errors
    /// [`Error::Valence`] below 3.
    pub fn scheme(self, name: impl Into<String>, valence: usize) -> Result<Scheme<S>, Error> {
        Ok(Scheme::stationary(name, self.level_with(valence, |_| true)?))
    }

    /// The level in which only the points that `special` agrees to have these stencils, and all others the
    /// regular rules.
    pub(crate) fn level_with(self, valence: usize, special: impl Fn(Site) -> bool) -> Result<Level<S>, Error> {
        let n = S::ratio(valence.max(1) as i64, 1);
        let own = S::one() - self.alpha.clone() - self.beta.clone();
        let each = [own, self.alpha.clone() / n.clone(), self.beta.clone() / n];
        self.level_of(valence, special, each, S::ratio)
    }
}

/// The weights of the rules by name: the symmetry of a level over names holds for all values.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Name {
    F1,
    F2,
    F3,
    D1,
    D2,
    E1,
    E2,
    /// The centre's own weight.
    Own,
    /// `alpha / N`.
    Alpha,
    /// `beta / N`.
    Beta,
    /// A weight of the regular rules.
    Regular(i64, i64),
}

impl Same for Name {
    fn same(&self, other: &Self) -> bool {
        self == other
    }
}

impl Name {
    fn level(valence: usize, special: impl Fn(Site) -> bool) -> Result<Level<Name>, Error> {
        if valence < 3 {
            return Err(Error::Valence { valence });
        }
        let fan = Fan::Closed(valence);
        let next = |site: Site, by: i64| site.rotated(fan, by);
        let face = Stencil::new()
            .with(Site::CENTRE, Name::F1)
            .with(EDGE, Name::F2)
            .with(next(EDGE, 1), Name::F2)
            .with(FACE, Name::F3);
        let edge = Stencil::new()
            .with(Site::CENTRE, Name::D1)
            .with(EDGE, Name::D2)
            .with(next(EDGE, -1), Name::E1)
            .with(next(EDGE, 1), Name::E1)
            .with(next(FACE, -1), Name::E2)
            .with(FACE, Name::E2);
        let vertex = Stencil::new()
            .with(Site::CENTRE, Name::Own)
            .with_orbit(fan, EDGE, Name::Alpha)
            .with_orbit(fan, FACE, Name::Beta);
        let line = Line::new(vec![
            vec![
                (-4, Name::Regular(1, 8)),
                (0, Name::Regular(3, 4)),
                (4, Name::Regular(1, 8)),
            ],
            vec![(-2, Name::Regular(1, 2)), (2, Name::Regular(1, 2))],
        ]);
        let pass = Pass::regular(Lattice::Vertex, Lattice::Vertex, line)
            .with(Site::CENTRE, vertex)
            .with(EDGE, edge)
            .with(FACE, face)
            .retaining(special);
        Level::new(fan, vec![pass])
    }
}
