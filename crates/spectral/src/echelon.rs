//! Bases of an eigenspace in echelon form, and the bases dual to them.

use crate::{Eigenspace, Error};
use eigenring_scheme::Complex;

/// An entry of a unit eigenvector below this is zero in the echelon form. Empirical: vectors are accurate to
/// 1e-12.
pub(crate) const PIVOT: f64 = 1e-8;
/// `l . r` of unit vectors below this marks a (nearly) defective eigenvalue: its functional would be known to
/// less than five digits.
const DEFECTIVE: f64 = 1e-10;

/// Bases of an eigenspace and of its dual, as unknowns of the block.
pub(crate) struct Dual {
    pub right: Vec<Vec<Complex<f64>>>,
    pub left: Vec<Vec<Complex<f64>>>,
    /// The row of the 1 in each right vector.
    pub pivots: Vec<usize>,
}

/// The echelon form of the right vectors, by elimination with the pivots tried in the given order, and the
/// left vectors dual to it.
pub(crate) fn dual(space: &Eigenspace, fourier: usize, order: impl Fn(usize) -> usize) -> Result<Dual, Error> {
    let scaled = |v: &[Complex<f64>], by: Complex<f64>| -> Vec<Complex<f64>> { v.iter().map(|&x| x * by).collect() };
    let subtract = |v: &mut [Complex<f64>], by: Complex<f64>, w: &[Complex<f64>]| {
        for (v, &w) in v.iter_mut().zip(w) {
            *v = *v - by * w;
        }
    };
    let mut right = space.right.clone();
    let size = right.first().map_or(0, Vec::len);
    let (mut done, mut pivots) = (0, Vec::new());
    for position in (0..size).map(order) {
        if done == right.len() {
            break;
        }
        let largest = |v: &Vec<Complex<f64>>| v[position].modulus();
        let best = (done..right.len()).max_by(|&a, &b| largest(&right[a]).total_cmp(&largest(&right[b])));
        let Some(best) = best.filter(|&best| largest(&right[best]) > PIVOT) else {
            continue;
        };
        right.swap(done, best);
        right[done] = scaled(&right[done], right[done][position].recip());
        let pivot = right[done].clone();
        for (other, vector) in right.iter_mut().enumerate() {
            if other != done {
                let factor = vector[position];
                subtract(vector, factor, &pivot);
            }
        }
        pivots.push(position);
        done += 1;
    }
    // the Gram matrix L R, inverted onto L by elimination
    let dot =
        |l: &[Complex<f64>], r: &[Complex<f64>]| l.iter().zip(r).fold(Complex::zero(), |sum, (&l, &r)| sum + l * r);
    let mut left = space.left.clone();
    for column in 0..right.len() {
        let size = |l: &Vec<Complex<f64>>| dot(l, &right[column]).modulus() / length(l) / length(&right[column]);
        let best = (column..left.len())
            .max_by(|&a, &b| size(&left[a]).total_cmp(&size(&left[b])))
            .filter(|&best| size(&left[best]) > DEFECTIVE);
        let Some(best) = best else {
            return Err(Error::Defective {
                value: space.value.re,
                fourier,
                product: left[column..].iter().map(size).fold(0.0, f64::max),
            });
        };
        left.swap(column, best);
        let product = dot(&left[column], &right[column]);
        left[column] = scaled(&left[column], product.recip());
        let pivot = left[column].clone();
        for (other, vector) in left.iter_mut().enumerate() {
            if other != column {
                let factor = dot(vector, &right[column]);
                subtract(vector, factor, &pivot);
            }
        }
    }
    Ok(Dual { right, left, pivots })
}

pub(crate) fn length(v: &[Complex<f64>]) -> f64 {
    v.iter().map(|x| x.norm_square()).sum::<f64>().sqrt()
}
