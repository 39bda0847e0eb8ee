//! The Fourier blocks of the quadratic terms.

/// A Fourier block with the eigenvalues of quadratic terms: `x^2 + y^2` turns with index 0, the saddles
/// `x^2 - y^2` and `2 x y` with 2 and N-2. Blocks k and N-k are conjugate, and of two the one with `k <= N/2`
/// is listed.
///
/// At N = 3 the saddles' indices are those of the characteristic map, 1 and 2, and both saddles come after
/// its eigenvalue in block 1. At N = 4 they are the same, and two eigenvalues of block 2 belong to one saddle
/// each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SecondOrder {
    /// The index of the block, at most N/2.
    pub block: usize,
    /// How many eigenvalues of the block they are.
    pub copies: usize,
    /// How many eigenvalues of the block come before: 1 in block 0, lambda in block 1.
    pub before: usize,
}

impl SecondOrder {
    /// The block of the cup and that of the saddles, for a valence of 3 or more.
    pub fn of(valence: usize) -> [SecondOrder; 2] {
        let (index, conjugate) = (2, valence.saturating_sub(2));
        let of = |block: usize, copies: usize| SecondOrder {
            block,
            copies,
            before: usize::from(block < 2),
        };
        [of(0, 1), of(index.min(conjugate), 1 + usize::from(index == conjugate))]
    }

    /// How many of the eigenvalues are in a block.
    pub fn copies_in(valence: usize, block: usize) -> usize {
        let here = Self::of(valence).into_iter().find(|of| of.block == block);
        here.map_or(0, |of| of.copies)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LocalSystem;
    use eigenring_scheme::families::catmull_clark;

    /// Of the regular rules all are 1/4; elsewhere the blocks are where the definition puts them.
    #[test]
    fn three_indices_are_paired_in_two_blocks() {
        let list = |valence| SecondOrder::of(valence).map(|of| (of.block, of.copies, of.before));
        assert_eq!(list(3), [(0, 1, 1), (1, 1, 1)]);
        assert_eq!(list(4), [(0, 1, 1), (2, 2, 0)]);
        for valence in 5..=64 {
            assert_eq!(list(valence), [(0, 1, 1), (2, 1, 0)]);
        }
        let scheme = catmull_clark::<f64>(4).unwrap();
        let system = LocalSystem::new(scheme.limit(), 1).unwrap();
        for of in SecondOrder::of(4) {
            let values = system.blocks()[of.block].eigenvalues().unwrap();
            let all: Vec<f64> = values
                .iter()
                .flat_map(|e| std::iter::repeat_n(e.value.re, e.multiplicity))
                .collect();
            let squares = &all[of.before..of.before + of.copies];
            assert!(
                squares.iter().all(|value| (value - 0.25).abs() < 1e-14),
                "{of:?}: {all:?}"
            );
        }
    }
}
