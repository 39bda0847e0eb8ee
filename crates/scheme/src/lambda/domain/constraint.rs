//! The constraints on a stencil and the curves they draw in the (f2, f3) plane.

use std::fmt;

/// What an admissible stencil fulfils. `m = (1 - kappa) mu` is the bound of all eigenvalues other than 1,
/// lambda and mu.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Constraint {
    /// `f1 >= 0`.
    F1,
    /// `f2 >= 0`.
    F2,
    /// `f3 >= 0`.
    F3,
    /// `f3 = mu`, at N = 4 only, where both saddles live in block 2.
    F3EqualsMu,
    /// `d1 >= 0`.
    D1,
    /// `d2 >= 0`.
    D2,
    /// `e1 >= 0`, equivalent to `h >= 0`.
    E1,
    /// `e2 >= 0`.
    E2,
    /// `beta >= 0`.
    Beta,
    /// `1 - alpha - beta >= 0`: the centre weight of the vertex stencil.
    Centre,
    /// The face's half angle at F is at most `pi/2 - pi/(2N)`; equivalent to a corner radius of at least 1.
    Theta,
    /// Both eigenvalues of block floor(N/2) lie in [-m, m]; `g3 >= -m` for even N and for the paper's bounds.
    LastBlock,
    /// The same for the blocks between, the second eigenvalues of blocks 1 and 2 included.
    InnerBlocks,
    /// `z0 >= -m`, the last eigenvalue of block 0.
    Z0Lower,
    /// `z0 <= m`.
    Z0Upper,
}

impl Constraint {
    /// A stable identifier.
    pub fn name(self) -> &'static str {
        match self {
            Constraint::F1 => "f1",
            Constraint::F2 => "f2",
            Constraint::F3 => "f3",
            Constraint::F3EqualsMu => "f3_equals_mu",
            Constraint::D1 => "d1",
            Constraint::D2 => "d2",
            Constraint::E1 => "e1",
            Constraint::E2 => "e2",
            Constraint::Beta => "beta",
            Constraint::Centre => "centre",
            Constraint::Theta => "theta",
            Constraint::LastBlock => "last_block",
            Constraint::InnerBlocks => "inner_blocks",
            Constraint::Z0Lower => "z0_lower",
            Constraint::Z0Upper => "z0_upper",
        }
    }

    /// Whether it keeps an eigenvalue below mu: the bounds that the margin tightens.
    pub fn is_eigenvalue_bound(self) -> bool {
        use Constraint::{InnerBlocks, LastBlock, Z0Lower, Z0Upper};
        matches!(self, LastBlock | InnerBlocks | Z0Lower | Z0Upper)
    }

    /// The inequality, for messages.
    pub fn inequality(self) -> &'static str {
        match self {
            Constraint::F1 => "f1 >= 0",
            Constraint::F2 => "f2 >= 0",
            Constraint::F3 => "f3 >= 0",
            Constraint::F3EqualsMu => "f3 = mu",
            Constraint::D1 => "d1 >= 0",
            Constraint::D2 => "d2 >= 0",
            Constraint::E1 => "e1 >= 0",
            Constraint::E2 => "e2 >= 0",
            Constraint::Beta => "beta >= 0",
            Constraint::Centre => "1 - alpha - beta >= 0",
            Constraint::Theta => "theta <= pi/2 - pi/(2N)",
            Constraint::LastBlock => "|eigenvalues of the last block| <= mu",
            Constraint::InnerBlocks => "|other eigenvalues of the inner blocks| <= mu",
            Constraint::Z0Lower => "z0 >= -mu",
            Constraint::Z0Upper => "z0 <= mu",
        }
    }
}

impl fmt::Display for Constraint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Which root of a quadratic in f2.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Root {
    /// The smaller one.
    Smaller,
    /// The larger one.
    Larger,
}

/// A smooth curve `f2 = curve(f3)` on which a constraint is active.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ConstraintCurve {
    /// `f2 = (1-f3)/2`, an upper end.
    F1,
    /// `f2 = h f3/(1-g3-2h)`, a lower end.
    D1,
    /// `f2 = (lambda-f3)/(2 cos(pi/N))`, a lower end.
    Theta,
    /// `beta = 1/(1+phi)`: a lower end at the larger root, an upper end at the smaller one.
    Centre(Root),
    /// `z0 = -m`: a lower end at the larger root, an upper end at the smaller one.
    Z0Lower(Root),
    /// `z0 = m`: an upper end at the larger root, a lower end at the smaller one.
    Z0Upper(Root),
}

impl ConstraintCurve {
    /// The constraint that is active on the curve.
    pub fn constraint(self) -> Constraint {
        match self {
            ConstraintCurve::F1 => Constraint::F1,
            ConstraintCurve::D1 => Constraint::D1,
            ConstraintCurve::Theta => Constraint::Theta,
            ConstraintCurve::Centre(_) => Constraint::Centre,
            ConstraintCurve::Z0Lower(_) => Constraint::Z0Lower,
            ConstraintCurve::Z0Upper(_) => Constraint::Z0Upper,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_pad_like_text() {
        assert_eq!(format!("[{:>6}]", Constraint::D1), "[    d1]");
        assert_eq!(
            ConstraintCurve::Z0Lower(Root::Larger).constraint().to_string(),
            "z0_lower"
        );
    }
}
