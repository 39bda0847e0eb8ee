//! Doo-Sabin subdivision with the original weights.
//!
//! D. Doo and M. Sabin, *Behaviour of recursive division surfaces near extraordinary points*, Computer-Aided
//! Design 10(6), 1978, <https://doi.org/10.1016/0010-4485(78)90111-2>. A biquadratic scheme on face nets: the
//! new corner of an N-gon keeps `(N+5)/(4N)` of the old one and takes `(3 + 2 cos(2 pi j/N))/(4N)` of the
//! corner `j` places further. In the Fourier basis this is the eigenvalue 1/2 in blocks 1 and N-1 and 1/4 in
//! all others, for every N.

use crate::{Error, Fan, Lattice, Level, Line, Pass, Same, Scalar, Scheme, Site, Stencil};

/// The corner of the central face in sector 0.
pub(super) const CORNER: Site = Site { sector: 0, x: 1, y: 1 };

/// The scheme around a face.
///
/// # Errors
/// [`Error::Valence`] below 3.
pub fn doo_sabin<S: Scalar>(valence: usize) -> Result<Scheme<S>, Error> {
    if valence < 3 {
        return Err(Error::Valence { valence });
    }
    let (fan, n) = (Fan::Closed(valence), valence as i64);
    // over names, so that the symmetry does not depend on how the cosines are represented
    let corner = (0..n).fold(Stencil::new(), |stencil, j| {
        stencil.with(CORNER.rotated(fan, j), Name::Corner(j.min(n - j)))
    });
    let line = Line::new(vec![
        vec![(1, Name::Near), (-3, Name::Far)],
        vec![(-1, Name::Near), (3, Name::Far)],
    ]);
    let pass = Pass::regular(Lattice::Face, Lattice::Face, line).with(CORNER, corner);
    let quarter = S::ratio(1, 4 * n);
    let level = Level::new(fan, vec![pass])?.map(|name| match *name {
        Name::Corner(0) => S::ratio(n + 5, 4 * n),
        Name::Corner(j) => quarter.clone() * (S::ratio(3, 1) + S::ratio(2, 1) * S::cos_turn(j, n)),
        Name::Near => S::ratio(3, 4),
        Name::Far => S::ratio(1, 4),
    });
    Ok(Scheme::stationary("doo-sabin", level))
}

/// The weights by name.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Name {
    /// Of the corner so many corners away, whichever way round.
    Corner(i64),
    /// Of the nearer point of corner cutting.
    Near,
    /// Of the farther one.
    Far,
}

impl Same for Name {
    fn same(&self, other: &Self) -> bool {
        self == other
    }
}
