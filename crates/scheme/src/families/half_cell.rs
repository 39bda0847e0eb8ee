//! Odd orders beside boundaries and creases: rules of half cells.
//!
//! The literature leaves the boundary of dual schemes open; these rules are this project's. A boundary or
//! crease (a *rim*) carries points `b` of the curve of the same order; the cells along it are *half cells*,
//! `b_r, q_1 .. q_n, b_l` counter-clockwise from the rim on the right, in front of them the corner if the rim
//! turns there. On regular nets (n = 2; n = 1 at corners) the rules are those of the net continued by odd
//! reflection, `P_-j = 2 P_0 - P_j`; in general they have the spectrum 1, 1/2, 1/2, 1/4, .. of half a face of
//! 2n corners. With `m` the middle of `b_r` and `b_l`, or the corner, `t_j = (2j-1) pi/(2n)` and `B_i` the
//! nearer one of `b_r`, `b_l`:
//!
//! ```text
//! q_i' = m + (u/(1+u))^2 (q_i - m)
//!          + u/(1+u)^2 [ (2/n) sin t_i sum_j sin t_j (q_j - m) + |cos t_i|/cos t_1 (B_i - m) ]
//! ```
//!
//! without the last term in the middle; for n = 1 `m + u/(1+u) (q - m)` on a rim, and
//! `m + (u/(1+u))^2 (q - m) + u/(1+u)^2 (b_r + b_l - 2m)` at a corner.

use crate::Scalar;

/// The rules of the corners of a half cell with `n` of them at tension `u`: a row for each `q_i'`, with the
/// weights of `corner` (if there is one), `b_r`, `q_1 .. q_n`, `b_l`.
pub fn half_cell<S: Scalar>(n: usize, u: &S, corner: bool) -> Vec<Vec<S>> {
    debug_assert!(n > 0, "a half cell has corners");
    let one = S::one;
    let square = (one() + u.clone()) * (one() + u.clone());
    let keep = u.clone() * u.clone() / square.clone();
    let take = u.clone() / square;
    let size = n + 2 + usize::from(corner);
    let first = usize::from(corner);
    let (right, left) = (first, size - 1);
    let turns = 4 * n as i64;
    let sin = |j: usize| S::sin_turn(2 * j as i64 + 1, turns);
    let cos = |j: usize| S::cos_turn(2 * j as i64 + 1, turns);
    let row = |i: usize| {
        // weights of differences from m first
        let mut row = vec![S::zero(); size];
        let q = |j: usize| first + 1 + j;
        if n == 1 && !corner {
            row[q(0)] = u.clone() / (one() + u.clone());
        } else {
            row[q(i)] += keep.clone();
            if n == 1 {
                row[right] += take.clone();
                row[left] += take.clone();
            } else {
                for j in 0..n {
                    row[q(j)] += take.clone() * S::ratio(2, n as i64) * sin(i) * sin(j);
                }
                match (2 * i + 1).cmp(&n) {
                    std::cmp::Ordering::Less => row[right] += take.clone() * (cos(i) / cos(0)),
                    std::cmp::Ordering::Greater => row[left] += take.clone() * (cos(n - 1 - i) / cos(0)),
                    std::cmp::Ordering::Equal => {}
                }
            }
        }
        let rest = row.iter().fold(one(), |rest, weight| rest - weight.clone());
        if corner {
            row[0] += rest;
        } else {
            let half = rest * S::ratio(1, 2);
            row[right] += half.clone();
            row[left] += half;
        }
        row
    };
    (0..n).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The regular cases are tensor products of corner cutting with the net continued by reflection.
    #[test]
    fn regular_half_cells_are_reflected_tensor_products() {
        for u in [0.3, 1.0, 2.0] {
            let (near, far) = ((1.0 + 2.0 * u) / (2.0 * (1.0 + u)), 1.0 / (2.0 * (1.0 + u)));
            // q' = near^2 q + near far (along the rim) + near far (2b - q) + far^2 (2b' - q')
            let row = &half_cell(2, &u, false)[0];
            let expected = [
                2.0 * near * far,
                near * near - near * far,
                far * near - far * far,
                2.0 * far * far,
            ];
            for (found, expected) in row.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-15, "{row:?} {expected:?}");
            }
            // reflected in both rims: 2 b_r - q, 2 b_l - q, and 4c - 2 b_r - 2 b_l + q across the corner
            let row = &half_cell(1, &u, true)[0];
            let side = 2.0 * near * far - 2.0 * far * far;
            let expected = [4.0 * far * far, side, (near - far) * (near - far), side];
            for (found, expected) in row.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-15, "{row:?} {expected:?}");
            }
        }
    }

    #[test]
    fn rows_are_affine_and_mirror_images() {
        for n in 1..9 {
            for corner in [false, true] {
                let rows = half_cell(n, &0.7, corner);
                for (row, image) in rows.iter().zip(rows.iter().rev()) {
                    assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-14);
                    let from = usize::from(corner);
                    for (a, b) in row[from..].iter().zip(image[from..].iter().rev()) {
                        assert!((a - b).abs() < 1e-15);
                    }
                }
            }
        }
    }
}
