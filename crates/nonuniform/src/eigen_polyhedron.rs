//! Subdivision by an eigen-polyhedron (Li, Finnigan and Sederberg 2016, as in Eqs. 8 to 13 of Li, Wei and
//! Zhang 2019).
//!
//! The first level is [NURSS](crate::nurss). From then on the matrix N is constant, and made such that a
//! given polyhedron in the plane is an eigenvector of it. With `c = cos(2 pi/n)`,
//!
//! ```text
//! gamma = 4/(c + 1 + sqrt((c+9)(c+1))),   lambda = (1+gamma)/(4 gamma)        (that of Catmull-Clark)
//! d-_i = (d_(i-2) d_(i+1) + d_(i+2) d_(i-1))/(d_(i-1) + d_(i+1)),   l_i = (2 d_i + d-_i)/3
//! V^ = 0,   E^_i = l_i (cos, sin)(2 pi i/n),   F^_i = gamma (E^_i + E^_(i+1))
//! V- = row V of NURSS on these
//! ```
//!
//! Face points are bilinear, with weights alpha such that F^_i goes to V- + lambda F^_i; edge points are,
//! with weights beta such that E^_i goes to V- + lambda E^_i. So `N P^ = V- + lambda P^`.
//!
//! The scheme exists where all alpha and beta lie in [0, 1]. That depends on the intervals:
//! [`safe_ratio`] says up to which `max d/min d` it does for all of them. Beyond [0, 1] there may be real
//! solutions still, and they make wrong schemes (d = 10, 1, 10, 1, 1 has an eigenvalue 1.42), so that
//! [`EigenPolyhedron::new`] refuses them.

use crate::nurss::{Order, Row, add, bilinear, zero_row};
use crate::{Error, Spokes, nurss};
use eigenring_scheme::{Complex, Scalar};
use eigenring_spectral::{Block, Matrix};

/// The rounding by which a weight may miss [0, 1].
const ROUNDING: f64 = 1e-14;

/// Ratios of the largest to the smallest interval up to which the eigen-polyhedron exists, at valence 3 to
/// 12: rounded down from bisections over all patterns of two values. At valence 4 it always does.
const SAFE: [f64; 10] = [9.62, f64::INFINITY, 3.73, 4.63, 3.20, 3.03, 2.84, 2.70, 2.64, 2.60];

/// The ratio of the largest to the smallest interval up to which the eigen-polyhedron has been found to exist
/// for all intervals; `None` beyond valence 12, where nothing was tried.
pub fn safe_ratio(valence: usize) -> Option<f64> {
    SAFE.get(valence.checked_sub(3)?).copied()
}

/// The polyhedron and the weights that it leads to.
#[derive(Clone, Debug, PartialEq)]
pub struct EigenPolyhedron {
    spokes: Spokes,
    /// How far faces lie out, as a multiple of the sum of their edge points.
    pub gamma: f64,
    /// The double eigenvalue.
    pub lambda: f64,
    /// d-_i.
    pub d_minus: Vec<f64>,
    /// The lengths of the spokes E^_i.
    pub lengths: Vec<f64>,
    /// V-.
    pub centre: [f64; 2],
    /// The weights of face i towards spoke i and spoke i+1.
    pub alpha: Vec<[f64; 2]>,
    /// The weights of edge i across the spoke, towards spoke i+1, and along it.
    pub beta: Vec<[f64; 2]>,
}

fn cross(u: [f64; 2], v: [f64; 2]) -> f64 {
    u[0] * v[1] - u[1] * v[0]
}

/// A combination of vectors.
fn sum(terms: &[(f64, [f64; 2])]) -> [f64; 2] {
    terms
        .iter()
        .fold([0.0; 2], |[x, y], (w, [a, b])| [x + w * a, y + w * b])
}

impl EigenPolyhedron {
    /// The polyhedron for the intervals of the spokes, which are those of all further edges too.
    ///
    /// # Errors
    /// [`Error::OutsideDomain`] where a weight lies outside of [0, 1]; [`Error::ZeroSum`].
    pub fn new(d: &[f64]) -> Result<Self, Error> {
        let found = EigenPolyhedron::anywhere(d)?;
        let outside = found.outside();
        match outside.is_empty() {
            true => Ok(found),
            false => Err(found.refusal(outside.join("; "))),
        }
    }

    /// The weights wherever they are real, outside of [0, 1] too: for diagnostics, since the scheme is wrong
    /// there. Of two solutions the one in [0, 1]^2 is taken, or the nearest to it.
    ///
    /// # Errors
    /// [`Error::OutsideDomain`] where no weights are real; [`Error::ZeroSum`].
    pub fn anywhere(d: &[f64]) -> Result<Self, Error> {
        let spokes = Spokes::stationary(d.to_vec())?;
        let n = spokes.valence();
        let c = f64::cos_turn(1, n as i64);
        let gamma = 4.0 / (c + 1.0 + ((c + 9.0) * (c + 1.0)).sqrt());
        let lambda = (1.0 + gamma) / (4.0 * gamma);
        let first = nurss::matrix::<f64>(&spokes)?;
        let d = |i: isize| spokes.d(i);
        let minus = |i: isize| (d(i - 2) * d(i + 1) + d(i + 2) * d(i - 1)) / (d(i - 1) + d(i + 1));
        let d_minus: Vec<f64> = (0..n as isize).map(minus).collect();
        if let Some(i) = d_minus.iter().position(|x| !x.is_finite()) {
            let i = i as isize;
            return Err(Error::ZeroSum {
                what: format!("spokes {} and {}", spokes.index(i - 1), spokes.index(i + 1)),
                rule: "the eigen-polyhedron",
            });
        }
        let lengths: Vec<f64> = (0..n)
            .map(|i| (2.0 * spokes.intervals()[i] + d_minus[i]) / 3.0)
            .collect();
        if let Some(i) = lengths.iter().position(|&l| l == 0.0) {
            return Err(Error::ZeroSum {
                what: format!("spoke {i} and its neighbours"),
                rule: "the eigen-polyhedron",
            });
        }
        let mut found = EigenPolyhedron {
            gamma,
            lambda,
            d_minus,
            lengths,
            centre: [0.0; 2],
            alpha: Vec::with_capacity(n),
            beta: Vec::with_capacity(n),
            spokes,
        };
        let points = found.points();
        let row = first.row(0).iter().zip(&points);
        found.centre = row.fold([0.0; 2], |[x, y], (w, p)| [x + w * p[0], y + w * p[1]]);
        let none = |what: String| refusal(found.spokes.intervals(), what);
        for i in 0..n as isize {
            let face = found.face_weights(&points, i);
            let face = face.ok_or_else(|| none(format!("sector {i} (none is real)")))?;
            found.alpha.push(face);
        }
        for i in 0..n as isize {
            let edge = found.edge_weights(&points, i);
            let edge = edge.ok_or_else(|| none(format!("spoke {i} (none is real)")))?;
            found.beta.push(edge);
        }
        Ok(found)
    }

    /// The polyhedron: V^, E^_0.., F^_0.. .
    pub fn points(&self) -> Vec<[f64; 2]> {
        let n = self.spokes.valence();
        let edge = |i: usize| {
            let (length, i, n) = (self.lengths[i % n], (i % n) as i64, n as i64);
            [length * f64::cos_turn(i, n), length * f64::sin_turn(i, n)]
        };
        let face = |i: usize| sum(&[(self.gamma, edge(i)), (self.gamma, edge(i + 1))]);
        [[0.0; 2]]
            .into_iter()
            .chain((0..n).map(edge))
            .chain((0..n).map(face))
            .collect()
    }

    fn order(&self) -> Order {
        Order {
            n: self.spokes.valence(),
        }
    }

    /// Eq. 9: with `V- + lambda F^_i = x E^_i + y E^_(i+1)` and `b = 1 - (gamma-1)(x-y)`, the weights are
    /// `2x/(b + sqrt(b^2 + 4 (gamma-1) x))`, and the same with x and y exchanged.
    fn face_weights(&self, points: &[[f64; 2]], i: isize) -> Option<[f64; 2]> {
        let order = self.order();
        let [own, next] = [points[order.edge(i)], points[order.edge(i + 1)]];
        let target = sum(&[(1.0, self.centre), (self.lambda, points[order.face(i)])]);
        let area = cross(own, next);
        let (x, y) = (cross(target, next) / area, cross(own, target) / area);
        let g = self.gamma - 1.0;
        let weight = |x: f64, y: f64| {
            let b = 1.0 - g * (x - y);
            2.0 * x / (b + (b * b + 4.0 * g * x).sqrt())
        };
        let weights = [weight(x, y), weight(y, x)];
        weights.iter().all(|w| w.is_finite()).then_some(weights)
    }

    /// The points P_1 .. P_4 of Eqs. 11 and 12 as weights of two points each.
    fn beside(&self, i: isize) -> [[(usize, f64); 2]; 4] {
        let order = self.order();
        let before = self.alpha[self.spokes.index(i - 1)][0];
        let after = self.alpha[self.spokes.index(i)][1];
        let (own, left, right) = (order.edge(i), order.edge(i + 1), order.edge(i - 1));
        [
            [(0, 1.0 - before), (right, before)],
            [(0, 1.0 - after), (left, after)],
            [(own, 1.0 - before), (order.face(i - 1), before)],
            [(own, 1.0 - after), (order.face(i), after)],
        ]
    }

    /// Eq. 13: bilinear in (beta_1, beta_2), so that beta_2 is a root of a quadratic.
    fn edge_weights(&self, points: &[[f64; 2]], i: isize) -> Option<[f64; 2]> {
        let own = points[self.order().edge(i)];
        let p = self
            .beside(i)
            .map(|[a, b]| sum(&[(a.1, points[a.0]), (b.1, points[b.0])]));
        // target = beta_1 across + beta_2 along + beta_1 beta_2 twist
        let target = sum(&[(1.0, self.centre), (self.lambda, own), (-0.5, p[0])]);
        let across = sum(&[(0.5, p[1]), (-0.5, p[0])]);
        let along = sum(&[(0.5, p[2]), (0.5, own), (-0.5, p[0])]);
        let twist = sum(&[(0.5, p[3]), (-0.5, p[2]), (-1.0, across)]);
        let roots = quadratic(
            -cross(along, twist),
            cross(target, twist) - cross(along, across),
            cross(target, across),
        );
        let solution = |second: f64| {
            let direction = sum(&[(1.0, across), (second, twist)]);
            let rest = sum(&[(1.0, target), (-second, along)]);
            let square = direction[0] * direction[0] + direction[1] * direction[1];
            [(rest[0] * direction[0] + rest[1] * direction[1]) / square, second]
        };
        let beyond = |weights: &[f64; 2]| weights.iter().map(|w| (-w).max(w - 1.0).max(0.0)).fold(0.0, f64::max);
        let solutions = roots.into_iter().flatten().map(solution);
        solutions
            .filter(|weights| weights.iter().all(|w| w.is_finite()))
            .min_by(|a, b| beyond(a).total_cmp(&beyond(b)))
    }

    /// Sectors and spokes with a weight outside of [0, 1], in words, and the weights of the first four.
    fn outside(&self) -> Vec<String> {
        let bad = |weights: &[f64; 2]| weights.iter().any(|w| !(-ROUNDING..=1.0 + ROUNDING).contains(w));
        let named = |what: &'static str, list: &[[f64; 2]]| -> Vec<String> {
            let numbered = list.iter().enumerate().filter(|(_, weights)| bad(weights));
            numbered
                .map(|(i, [a, b])| format!("{what} {i} ({a:.4}, {b:.4})"))
                .collect()
        };
        let mut all = [named("sector", &self.alpha), named("spoke", &self.beta)].concat();
        let more = all.len().saturating_sub(4);
        if more > 0 {
            all.truncate(4);
            all.push(format!("{more} more"));
        }
        all
    }

    pub(crate) fn refusal(&self, outside: String) -> Error {
        refusal(self.spokes.intervals(), outside)
    }

    /// Whether all weights lie in [0, 1].
    pub fn is_inside(&self) -> bool {
        self.outside().is_empty()
    }

    /// The matrix N: 2n+1 rows and columns, V, E_0.., F_0.. .
    ///
    /// # Errors
    /// Those of [`nurss::matrix`], which has the row of V.
    pub fn matrix(&self) -> Result<Matrix<f64>, Error> {
        let order = self.order();
        let indices = 0..self.spokes.valence() as isize;
        let vertex = nurss::matrix::<f64>(&self.spokes)?.row(0).to_vec();
        let edge = |i: isize| -> Row<f64> {
            let [across, along] = self.beta[i as usize];
            let mut row = zero_row(order.size());
            let sides = [1.0 - across, across, 1.0 - across, across];
            let ends = [1.0 - along, 1.0 - along, along, along];
            for (point, (side, end)) in self.beside(i).iter().zip(sides.iter().zip(ends)) {
                for (at, weight) in point {
                    row[*at] += 0.5 * side * end * weight;
                }
            }
            row[0] += 0.5 * (1.0 - along);
            row[order.edge(i)] += 0.5 * along;
            row
        };
        let face = |i: isize| {
            let [own, next] = self.alpha[i as usize];
            bilinear(order, i, &own, &next)
        };
        let rows = [vertex]
            .into_iter()
            .chain(indices.clone().map(edge))
            .chain(indices.map(face));
        Ok(Matrix::from_rows(rows.collect(), order.size()))
    }

    /// The weights L0 of the limit of V under N, of sum 1.
    ///
    /// # Errors
    /// As [`EigenPolyhedron::matrix`].
    pub fn limit_weights(&self) -> Result<Vec<f64>, Error> {
        let matrix = self.matrix()?;
        let left = left_eigenvectors(&matrix, 1.0)?.swap_remove(0);
        let total: f64 = left.iter().sum();
        Ok(left.iter().map(|w| w / total).collect())
    }

    /// The weights of the limit of V over the points of the control mesh, where the first level is NURSS with
    /// the given next intervals.
    ///
    /// # Errors
    /// Those of both matrices.
    pub fn limit_of_first_step(&self, spokes: &Spokes) -> Result<Vec<f64>, Error> {
        let first = nurss::matrix::<f64>(spokes)?;
        let mut row = zero_row(first.columns());
        for (i, weight) in self.limit_weights()?.iter().enumerate() {
            add(&mut row, weight, first.row(i));
        }
        Ok(row)
    }
}

/// An error that names the sectors and spokes at which the intervals have no polyhedron.
fn refusal(d: &[f64], outside: String) -> Error {
    let valence = d.len();
    let safe = match safe_ratio(valence) {
        Some(ratio) if ratio.is_finite() => ratio.to_string(),
        Some(_) => "any number".to_owned(),
        None => "what is not known".to_owned(),
    };
    Error::OutsideDomain {
        place: None,
        intervals: d.to_vec(),
        outside,
        valence,
        safe,
    }
}

/// The real roots of `a x^2 + b x + c`, without cancellation.
fn quadratic(a: f64, b: f64, c: f64) -> [Option<f64>; 2] {
    let discriminant = b * b - 4.0 * a * c;
    if !(discriminant >= 0.0) {
        return [None, None];
    }
    let q = -0.5 * (b + discriminant.sqrt().copysign(b));
    let root = |p: f64, q: f64| Some(p / q).filter(|x| x.is_finite());
    [root(c, q), root(q, a)]
}

/// The left eigenvectors of a real eigenvalue.
pub(crate) fn left_eigenvectors(matrix: &Matrix<f64>, value: f64) -> Result<Vec<Vec<f64>>, Error> {
    let space = Block::Real(matrix.clone()).eigenspace(Complex::real(value), 0)?;
    let real = |vector: Vec<Complex<f64>>| vector.into_iter().map(|entry| entry.re).collect();
    Ok(space.left.into_iter().map(real).collect())
}
