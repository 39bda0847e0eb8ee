//! How far a patch or a curve is cut up: a tree of halvings, written down in preorder.
//!
//! The text has a `1` for a part that is cut (a square into four quarters, a curve into two halves, whose
//! trees follow in order) and a `0` for one that is kept. Whatever the text, the parts kept cover the whole
//! without gaps, so a check that walks the tree needs no proof of coverage; a text that ends early, goes on,
//! or is deeper than [`MAX_DEPTH`] is refused.

use serde::{Deserialize, Serialize};

/// The deepest subdivision accepted: parts of size `2^-20`, beyond which enclosures of doubles have no digits
/// to win.
pub const MAX_DEPTH: usize = 20;

/// A tree of halvings, see the module page.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Subdivision(String);

/// What a walk has met.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Walk {
    /// Parts kept.
    pub cells: usize,
    /// The depth of the deepest.
    pub depth: usize,
}

impl Subdivision {
    /// Nothing cut.
    pub fn whole() -> Self {
        Subdivision("0".into())
    }

    /// The tree that results from asking of every part whether to cut it, coarse parts first, parts in order.
    pub fn grow<T>(root: T, cut: &impl Fn(&T) -> Vec<T>, wanted: &mut impl FnMut(&T, usize) -> bool) -> Self {
        fn descend<T>(
            part: &T,
            depth: usize,
            text: &mut String,
            cut: &impl Fn(&T) -> Vec<T>,
            wanted: &mut impl FnMut(&T, usize) -> bool,
        ) {
            if depth < MAX_DEPTH && wanted(part, depth) {
                text.push('1');
                for piece in cut(part) {
                    descend(&piece, depth + 1, text, cut, wanted);
                }
            } else {
                text.push('0');
            }
        }
        let mut text = String::new();
        descend(&root, 0, &mut text, cut, wanted);
        Subdivision(text)
    }

    /// Visits the parts kept, in order; `None` where the text is no tree.
    pub fn walk<T>(&self, root: T, cut: &impl Fn(&T) -> Vec<T>, visit: &mut impl FnMut(&T)) -> Option<Walk> {
        let mut symbols = self.0.bytes();
        let mut walk = Walk::default();
        // parts still to come, the next one last
        let mut waiting = vec![(root, 0)];
        while let Some((part, depth)) = waiting.pop() {
            match symbols.next()? {
                b'0' => {
                    walk.cells += 1;
                    walk.depth = walk.depth.max(depth);
                    visit(&part);
                }
                b'1' if depth < MAX_DEPTH => {
                    waiting.extend(cut(&part).into_iter().rev().map(|piece| (piece, depth + 1)))
                }
                _ => return None,
            }
        }
        symbols.next().is_none().then_some(walk)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(range: &[f64; 2]) -> Vec<[f64; 2]> {
        let mid = (range[0] + range[1]) / 2.0;
        vec![[range[0], mid], [mid, range[1]]]
    }

    #[test]
    fn what_is_grown_is_walked() {
        let tree = Subdivision::grow([0.0, 1.0], &cut, &mut |range, _| {
            range[0] <= 0.3 && 0.3 < range[1] && range[1] - range[0] > 0.1
        });
        let mut cells = Vec::new();
        let walk = tree
            .walk([0.0, 1.0], &cut, &mut |range| cells.push(*range))
            .expect("a tree");
        assert_eq!(
            cells,
            [[0.0, 0.25], [0.25, 0.3125], [0.3125, 0.375], [0.375, 0.5], [0.5, 1.0]]
        );
        assert_eq!((walk.cells, walk.depth), (5, 4));
    }

    #[test]
    fn what_is_no_tree_is_refused() {
        let deep = "1".repeat(30);
        for text in ["", "1", "10", "00", "1000", "2", "10a", deep.as_str()] {
            assert_eq!(
                Subdivision(text.into()).walk([0.0, 1.0], &cut, &mut |_| ()),
                None,
                "{text}"
            );
        }
    }
}
