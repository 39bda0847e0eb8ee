//! NURSS around one vertex (Sederberg, Zheng, Sewell and Sabin 1998, as in Eqs. 5 to 7 of Li, Wei and Zhang
//! 2019).
//!
//! Points are V, `E_0 .. E_(n-1)`, `F_0 .. F_(n-1)`, with `F_i` between spokes i and i+1. From the intervals
//! `d_i` of V-E_i and `a_i` of the next edge,
//!
//! ```text
//! w_i  = (d_(i-2) + d_(i+2) + d_i) / (d_(i-2) + d_(i+2) + 2 d_i + 2 a_i),       M_i = w_i E_i + (1-w_i) V
//! F_i' = w_i w_(i+1) F_i + (1-w_i) w_(i+1) E_(i+1) + w_i (1-w_(i+1)) E_i + (1-w_i)(1-w_(i+1)) V
//! E_i' = M_i/2 + (d_(i-1) F_i' + d_(i+1) F_(i-1)') / (2 (d_(i-1) + d_(i+1)))
//! V'   = (n-3)/n V + 3/n sum (m_i M_i + f_i F_i') / sum (m_i + f_i)
//! f_i  = d_(i-1) d_(i+2),   m_i = f_i + f_(i-1)
//! ```
//!
//! At n = 4 these are the tensor product of univariate rules, and V' is taken in the form that has the right
//! limits for zero intervals (Eq. 3).

use crate::{Error, Spokes};
use eigenring_scheme::Scalar;
use eigenring_spectral::Matrix;

/// A row over the points V, E_0.., F_0.. .
pub(crate) type Row<S> = Vec<S>;

/// Where the points of a vertex of n spokes stand in rows and columns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Order {
    pub n: usize,
}

impl Order {
    pub fn size(self) -> usize {
        2 * self.n + 1
    }
    pub fn edge(self, i: isize) -> usize {
        1 + i.rem_euclid(self.n as isize) as usize
    }
    pub fn face(self, i: isize) -> usize {
        self.n + self.edge(i)
    }
}

pub(crate) fn zero_row<S: Scalar>(size: usize) -> Row<S> {
    (0..size).map(|_| S::zero()).collect()
}

/// Adds `weight` times a row.
pub(crate) fn add<S: Scalar>(to: &mut Row<S>, weight: &S, row: &[S]) {
    for (sum, entry) in to.iter_mut().zip(row) {
        *sum += weight.clone() * entry.clone();
    }
}

/// The bilinear combination of V, `E_i`, `E_(i+1)` and `F_i`, with the weights s along spoke i and t along
/// spoke i+1.
pub(crate) fn bilinear<S: Scalar>(order: Order, i: isize, s: &S, t: &S) -> Row<S> {
    let mut row = zero_row(order.size());
    let (s, t) = (s.clone(), t.clone());
    let (p, q) = (S::one() - s.clone(), S::one() - t.clone());
    row[0] += p.clone() * q.clone();
    row[order.edge(i)] += s.clone() * q;
    row[order.edge(i + 1)] += p * t.clone();
    row[order.face(i)] += s * t;
    row
}

/// The weight `w_i` of `E_i` in `M_i`.
pub fn averaged<S: Scalar>(spokes: &Spokes, i: isize) -> S {
    let d = |i: isize| S::exact(spokes.d(i));
    if spokes.d(i - 2) + spokes.d(i + 2) + spokes.d(i) + spokes.a(i) == 0.0 {
        return S::ratio(1, 2);
    }
    let behind = d(i - 2) + d(i + 2);
    let two = || S::ratio(2, 1);
    (behind.clone() + d(i)) / (behind + two() * d(i) + two() * S::exact(spokes.a(i)))
}

/// The matrix M of one step: 2n+1 rows and columns, V, E_0.., F_0.. .
///
/// # Errors
/// [`Error::ZeroSum`] where a rule divides by intervals that are all zero.
pub fn matrix<S: Scalar>(spokes: &Spokes) -> Result<Matrix<S>, Error> {
    let n = spokes.valence();
    let order = Order { n };
    let indices = 0..n as isize;
    let weights: Vec<S> = indices.clone().map(|i| averaged(spokes, i)).collect();
    let w = |i: isize| &weights[spokes.index(i)];
    let faces: Vec<Row<S>> = indices.clone().map(|i| bilinear(order, i, w(i), w(i + 1))).collect();
    let face = |i: isize| &faces[spokes.index(i)];
    // the middle of an edge, M_i
    let middle = |i: isize| {
        let mut row = zero_row::<S>(order.size());
        row[0] += S::one() - w(i).clone();
        row[order.edge(i)] += w(i).clone();
        row
    };
    let edge = |i: isize| -> Result<Row<S>, Error> {
        let [before, after] = [spokes.d(i - 1), spokes.d(i + 1)];
        if before + after == 0.0 {
            // at valence 4 two parallel lines coincide
            return match n {
                4 => Ok(middle(i)),
                _ => Err(zero_pair(spokes, i)),
            };
        }
        let sum = S::ratio(2, 1) * (S::exact(before) + S::exact(after));
        let mut row = zero_row(order.size());
        add(&mut row, &S::ratio(1, 2), &middle(i));
        add(&mut row, &(S::exact(before) / sum.clone()), face(i));
        add(&mut row, &(S::exact(after) / sum), face(i - 1));
        Ok(row)
    };
    let edges: Vec<Row<S>> = indices.clone().map(edge).collect::<Result<_, _>>()?;
    let vertex = if n == 4 {
        regular_vertex(spokes, order, &edges, middle)
    } else {
        extraordinary_vertex(spokes, order, &faces, middle)?
    };
    let rows: Vec<Row<S>> = [vertex].into_iter().chain(edges).chain(faces).collect();
    Ok(Matrix::from_rows(rows, order.size()))
}

fn zero_pair(spokes: &Spokes, i: isize) -> Error {
    Error::ZeroSum {
        what: format!("spokes {} and {}", spokes.index(i - 1), spokes.index(i + 1)),
        rule: "the edge point between them",
    }
}

/// Eq. 7.
fn extraordinary_vertex<S: Scalar>(
    spokes: &Spokes,
    order: Order,
    faces: &[Row<S>],
    middle: impl Fn(isize) -> Row<S>,
) -> Result<Row<S>, Error> {
    let n = spokes.valence();
    let products: f64 = (0..n as isize).map(|i| spokes.d(i - 1) * spokes.d(i + 2)).sum();
    if products == 0.0 {
        let zeros: Vec<String> = (0..n)
            .filter(|&i| spokes.intervals()[i] == 0.0)
            .map(|i| i.to_string())
            .collect();
        return Err(Error::ZeroSum {
            what: format!("spokes {}", zeros.join(", ")),
            rule: "the vertex point",
        });
    }
    let f = |i: isize| S::exact(spokes.d(i - 1)) * S::exact(spokes.d(i + 2));
    let mut sum = S::zero();
    let mut row = zero_row(order.size());
    for i in 0..n as isize {
        let m = f(i) + f(i - 1);
        add(&mut row, &m, &middle(i));
        add(&mut row, &f(i), &faces[i as usize]);
        sum += m + f(i);
    }
    let scale = S::ratio(3, n as i64) / sum;
    for entry in &mut row {
        *entry = entry.clone() * scale.clone();
    }
    row[0] += S::ratio(n as i64 - 3, n as i64);
    Ok(row)
}

/// Eq. 3: across spoke 0 by edge points, along it by middles.
fn regular_vertex<S: Scalar>(
    spokes: &Spokes,
    order: Order,
    edges: &[Row<S>],
    middle: impl Fn(isize) -> Row<S>,
) -> Row<S> {
    // half a point and half the mean of its neighbours, or the point alone where both intervals vanish
    let line = |ahead: isize, own: &Row<S>, ends: [Row<S>; 2]| {
        let [before, after] = [spokes.d(ahead + 2), spokes.d(ahead)];
        if before + after == 0.0 {
            return own.clone();
        }
        let mut row = zero_row(order.size());
        add(&mut row, &S::ratio(1, 2), own);
        let sum = S::ratio(2, 1) * (S::exact(before) + S::exact(after));
        add(&mut row, &(S::exact(before) / sum.clone()), &ends[0]);
        add(&mut row, &(S::exact(after) / sum), &ends[1]);
        row
    };
    let mut vertex = zero_row::<S>(order.size());
    vertex[0] = S::one();
    let along = line(0, &vertex, [middle(0), middle(2)]);
    line(1, &along, [edges[1].clone(), edges[3].clone()])
}
