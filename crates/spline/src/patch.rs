//! Polynomial patches of a tensor-product surface, and derivatives of functions of two variables.

use crate::Scalar;
use crate::bernstein::Polynomial;
use crate::uniform::{basis, to_bernstein};

/// A polynomial patch as a tensor-product uniform B-spline: `(d+1)^2` control values, the first parameter
/// running fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct TensorPatch<S> {
    /// The degree in each direction.
    pub degree: usize,
    /// The control values.
    pub control: Vec<S>,
}

/// A function of two variables and its derivatives at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<S> {
    /// The value of the patch.
    pub value: S,
    /// First derivatives: by u, by v.
    pub first: [S; 2],
    /// Second derivatives: uu, uv, vv.
    pub second: [S; 3],
}

impl<S: Scalar + Copy> TensorPatch<S> {
    /// Value and derivatives at `(u, v)` in the unit square.
    pub fn jet(&self, u: S, v: S) -> Jet<S> {
        self.jet_in(&basis(self.degree, u), &basis(self.degree, v))
    }

    /// The same from the [`basis`] functions of the degree at u and at v, for many patches.
    pub fn jet_in(&self, in_u: &[Vec<S>; 3], in_v: &[Vec<S>; 3]) -> Jet<S> {
        let width = self.degree + 1;
        let combine = |du: usize, dv: usize| {
            let mut sum = S::zero();
            for (row, &weight) in self.control.chunks(width).zip(&in_v[dv]) {
                let mut inner = S::zero();
                for (&value, &weight) in row.iter().zip(&in_u[du]) {
                    inner += weight * value;
                }
                sum += weight * inner;
            }
            sum
        };
        Jet {
            value: combine(0, 0),
            first: [combine(1, 0), combine(0, 1)],
            second: [combine(2, 0), combine(1, 1), combine(0, 2)],
        }
    }

    /// The same polynomial in Bernstein form.
    pub fn bernstein(&self) -> Polynomial<S> {
        Polynomial::from_control(&self.control, &to_bernstein(self.degree))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bernstein_corners_interpolate() {
        let patch = TensorPatch {
            degree: 3,
            control: (0..16).map(|i| f64::from(i * i % 7)).collect(),
        };
        let corners = patch.bernstein().corners();
        for (corner, (u, v)) in corners
            .into_iter()
            .zip([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)])
        {
            assert!((corner - patch.jet(u, v).value).abs() < 1e-14);
        }
    }
}
