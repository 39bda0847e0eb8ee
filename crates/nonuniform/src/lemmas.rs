//! The lemmas on HNUSS (Li, Wei and Zhang 2019, appendix), checked in exact arithmetic.
//!
//! **Lemma 1** for given intervals: `0 < n alpha_i < 1` are quotients of the intervals, and bound all
//! eigenvalues after 1, 1/2, 1/2; see [`ngon`](crate::ngon). **Lemma 2**: the regular polygon is the
//! eigenvector of 1/2, an identity in a cyclotomic field.
//!
//! **Lemma 3** for all n and all positive intervals at once. Let P_i be the corners of the regular polygon, C
//! the fixed point, and
//!
//! ```text
//! E_i = (d_i P_(i+1) + d_(i+2) P_i)/(d_i + d_(i+2)),   p = P_i - C,   v = E_(i-1) - C,   w = E_i - C
//! ```
//!
//! Then all points of sector i are `C + x p + y v + z w` with numbers x, y, z that depend neither on n nor on
//! intervals: if `P_i^(j,0)` is `C + p + c_j v`, the point of the line across spoke i, combined of it and of
//! its partner as E_(i-1) is of the corners, is `C + (1 + c_j) v`. They are found here from the refinement
//! rules, one by one, since `S P = P/2` is triangular. The Jacobian of the characteristic map is, with
//! `p = s v + t w`,
//!
//! ```text
//! det(v, w) (J_vw + s J_pw + t J_vp)
//! J_vw = y_u z_v - y_v z_u,   J_pw = x_u z_v - x_v z_u,   J_vp = y_u x_v - y_v x_u
//! ```
//!
//! and s, t > 0, since C is a convex combination of the E_i. On the three patches of a sector all Bernstein
//! coefficients of the three J are non-negative, and those of one of them positive. Those of `x_u, y_u` and
//! of `x_v, z_v` are non-negative, and no two of a pair zero together, so that the Jacobian of
//! (y + s x, z + t x) is a P-matrix: on the three patches, hence on their images by 1/2, 1/4, .., which with
//! them make up the rectangle of a sector. On rectangles that makes a map injective (Gale and Nikaido 1965);
//! it stays in the cone of v and w.

use eigenring_scheme::families::SplitFace;
use eigenring_scheme::{Error, Exact, Scalar};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

fn ratio(p: i64, q: i64) -> BigRational {
    BigRational::new(p.into(), q.into())
}

/// n alpha_i, exactly: quotients of doubles.
fn scaled_alpha(d: &[f64]) -> Result<Vec<BigRational>, Error> {
    let face = SplitFace::<Exact>::new(d)?;
    // arithmetic of rational numbers ends in a rational one, or in none where it is too long: nothing is
    // proven then, since -1 is no n alpha
    let rational = face.alpha.iter().map(Exact::as_rational);
    Ok(rational.map(|alpha| alpha.unwrap_or_else(|| ratio(-1, 1))).collect())
}

/// Lemma 1: the lesser of min n alpha and 1 - max n alpha, by which all eigenvalues after 1, 1/2, 1/2 stay
/// below 1/2 in modulus; exactly. At n = 3, where there are none, 1/2 at most.
///
/// # Errors
/// Those of [`SplitFace::new`].
pub fn gap_bound(d: &[f64]) -> Result<BigRational, Error> {
    let alpha = scaled_alpha(d)?;
    let gaps = alpha.into_iter().map(|alpha| (BigRational::one() - &alpha).min(alpha));
    Ok(gaps.fold(ratio(1, 2), BigRational::min))
}

/// Whether all eigenvalues of Q_n after 1, 1/2, 1/2 are proven to be below 1/2 in modulus: mu is a mean of
/// the n alpha over a vector that is orthogonal to the Fourier modes 0 and +-1. It is 0 or 1 only if that
/// vector lives where n alpha is 0, or where it is 1, and on three places or fewer no vector but 0 is
/// orthogonal to the three. With positive intervals spokes and sectors add 1/4 and less; a zero spoke, whose
/// line across is a triple knot, adds a further 1/2 outside of the n-gon, of which this says nothing.
///
/// # Errors
/// Those of [`SplitFace::new`].
pub fn is_strict(d: &[f64]) -> Result<bool, Error> {
    let alpha = scaled_alpha(d)?;
    let within = alpha
        .iter()
        .all(|alpha| !alpha.is_negative() && *alpha <= BigRational::one());
    let count = |end: BigRational| alpha.iter().filter(|alpha| **alpha == end).count();
    Ok(within && count(BigRational::zero()) <= 3 && count(BigRational::one()) <= 3)
}

/// Whether the rows of Q_n sum to 1, exactly.
///
/// # Errors
/// Those of [`SplitFace::new`].
pub fn rows_sum_to_one(d: &[f64]) -> Result<bool, Error> {
    let face = SplitFace::<Exact>::new(d)?;
    let defect = |i: usize| (0..d.len()).fold(-Exact::one(), |sum, j| sum + face.weight(i, j));
    Ok((0..d.len()).all(|i| defect(i).is_zero() == Some(true)))
}

/// Lemma 2, exactly: whether `Q_n (P - C) = (P - C)/2` for the regular polygon.
///
/// # Errors
/// Those of [`SplitFace::new`].
pub fn polygon_is_an_eigenvector(d: &[f64]) -> Result<bool, Error> {
    let n = d.len();
    let face = SplitFace::<Exact>::new(d)?;
    let half = Exact::ratio(1, 2);
    for turn in [Exact::cos_turn, Exact::sin_turn] {
        let polygon: Vec<Exact> = (0..n).map(|i| turn(i as i64, n as i64)).collect();
        let sum = |weights: &dyn Fn(usize) -> Exact| {
            (0..n).fold(Exact::zero(), |sum, j| sum + weights(j) * polygon[j].clone())
        };
        let centre = sum(&|j| face.beta[j].clone());
        for (i, corner) in polygon.iter().enumerate() {
            let image = sum(&|j| face.weight(i, j));
            let expected = half.clone() * (corner.clone() + centre.clone());
            if (image - expected).is_zero() != Some(true) {
                return Ok(false);
            }
        }
    }
    Ok(true)
}

/// Whether the beta_i sum to 1 for every n and all intervals: numerators and denominator are sums of products
/// `d_(i+a) d_(i+b)`, which over all i depend on |a - b| alone.
pub fn beta_sums_to_one() -> bool {
    let count = |pairs: &[[i64; 2]]| -> Vec<i64> {
        let mut gaps: Vec<i64> = pairs.iter().map(|[a, b]| (a - b).abs()).collect();
        gaps.sort_unstable();
        gaps
    };
    let numerators = [[-1, 2], [3, 2], [-2, -1], [2, -1]];
    let denominator = [[0, -1], [0, 3], [2, -1], [2, 3]];
    count(&numerators) == count(&denominator)
}

/// A point of a sector, or a Bernstein coefficient: its parts of p, v and w.
type Parts = [BigRational; 3];

/// Points on the line of a spoke, and 0 .. 3 in a sector: in the univariate rules the line is "before" point
/// 0.
const LINE: usize = 0;

/// The univariate rule across a spoke with equal intervals on this side: weights of the line and of points 0,
/// 1, 2 for the new points 0 .. 3.
fn rule() -> [[BigRational; 4]; 4] {
    let row = |weights: [i64; 4]| weights.map(|w| ratio(w, 16));
    [
        row([8, 8, 0, 0]),
        row([0, 12, 4, 0]),
        row([0, 3, 11, 2]),
        row([0, 0, 8, 8]),
    ]
}

/// The points `P^(j, k)` of a sector, j, k = 0 .. 3, as parts of p, v and w.
///
/// Index 0 in each direction is the line of the spoke beside, so that point (j, k) stands at `[j + 1][k +
/// 1]`.
pub fn sector_points() -> [[Parts; 5]; 5] {
    let zero = || -> Parts { std::array::from_fn(|_| BigRational::zero()) };
    let unit = |part: usize| -> Parts {
        std::array::from_fn(|i| {
            if i == part {
                BigRational::one()
            } else {
                BigRational::zero()
            }
        })
    };
    let mut points: [[Parts; 5]; 5] = std::array::from_fn(|_| std::array::from_fn(|_| zero()));
    points[1][1] = unit(0);
    // the points of the lines at the corner are E_(i-1) and E_i
    (points[1][LINE], points[LINE][1]) = (unit(1), unit(2));
    let rule = rule();
    for k in 0..4 {
        for j in 0..4 {
            if (j, k) != (0, 0) {
                // half of the point is a combination of points that are known, and of itself
                let mut sum = zero();
                let mut own = BigRational::zero();
                for (a, wa) in rule[j].iter().enumerate() {
                    for (b, wb) in rule[k].iter().enumerate() {
                        let weight = wa * wb;
                        if (a, b) == (j + 1, k + 1) {
                            own += weight;
                        } else if (b == LINE && k == 0 && a == j + 1) || (a == LINE && j == 0 && b == k + 1) {
                            // the line's point beside it is E plus what the point has beyond its corner
                            let (corner, line) = if b == LINE {
                                (unit(0), unit(1))
                            } else {
                                (unit(0), unit(2))
                            };
                            own += &weight;
                            for i in 0..3 {
                                sum[i] += &weight * (&line[i] - &corner[i]);
                            }
                        } else {
                            for i in 0..3 {
                                sum[i] += &weight * &points[a][b][i];
                            }
                        }
                    }
                }
                let rest = ratio(1, 2) - own;
                points[j + 1][k + 1] = sum.map(|part| part / &rest);
            }
            // the line beside it
            if k == 0 {
                let point = points[j + 1][1].clone();
                points[j + 1][LINE] = std::array::from_fn(|i| &point[i] - &unit(0)[i] + &unit(1)[i]);
            }
            if j == 0 {
                let point = points[1][k + 1].clone();
                points[LINE][k + 1] = std::array::from_fn(|i| &point[i] - &unit(0)[i] + &unit(2)[i]);
            }
        }
    }
    points
}

/// The Bezier points of a cell in one direction over the line and points 0 .. 3.
fn bezier(cell: usize) -> [[BigRational; 5]; 4] {
    let row = |weights: [i64; 5]| weights.map(|w| ratio(w, 12));
    match cell {
        0 => [
            row([12, 0, 0, 0, 0]),
            row([0, 12, 0, 0, 0]),
            row([0, 6, 6, 0, 0]),
            row([0, 3, 7, 2, 0]),
        ],
        _ => [
            row([0, 3, 7, 2, 0]),
            row([0, 0, 8, 4, 0]),
            row([0, 0, 4, 8, 0]),
            row([0, 0, 2, 8, 2]),
        ],
    }
}

/// A polynomial in two variables by its Bernstein coefficients, `[i][j]` with i in u.
#[derive(Clone, Debug, PartialEq)]
struct Bernstein(Vec<Vec<BigRational>>);

impl Bernstein {
    fn degree(&self) -> [usize; 2] {
        [self.0.len() - 1, self.0[0].len() - 1]
    }

    fn by_u(&self) -> Self {
        let m = self.degree()[0];
        let factor = ratio(m as i64, 1);
        let difference =
            |pair: &[Vec<BigRational>]| pair[0].iter().zip(&pair[1]).map(|(a, b)| (b - a) * &factor).collect();
        Bernstein(self.0.windows(2).map(difference).collect())
    }

    fn by_v(&self) -> Self {
        let n = self.degree()[1];
        let factor = ratio(n as i64, 1);
        let difference = |row: &Vec<BigRational>| row.windows(2).map(|pair| (&pair[1] - &pair[0]) * &factor).collect();
        Bernstein(self.0.iter().map(difference).collect())
    }

    fn times(&self, other: &Self) -> Self {
        let ([m, n], [p, q]) = (self.degree(), other.degree());
        let mut product = vec![vec![BigRational::zero(); n + q + 1]; m + p + 1];
        for (i, row) in self.0.iter().enumerate() {
            for (j, a) in row.iter().enumerate() {
                for (k, other) in other.0.iter().enumerate() {
                    for (l, b) in other.iter().enumerate() {
                        let share = binomial(m, i) * binomial(p, k) * binomial(n, j) * binomial(q, l);
                        let whole = binomial(m + p, i + k) * binomial(n + q, j + l);
                        product[i + k][j + l] += a * b * ratio(share, whole);
                    }
                }
            }
        }
        Bernstein(product)
    }

    fn minus(&self, other: &Self) -> Self {
        let rows = self.0.iter().zip(&other.0);
        Bernstein(
            rows.map(|(a, b)| a.iter().zip(b).map(|(a, b)| a - b).collect())
                .collect(),
        )
    }
}

fn binomial(n: usize, k: usize) -> i64 {
    (0..k).fold(1, |product, i| product * (n - i) as i64 / (i + 1) as i64)
}

/// What Lemma 3 rests on, on one patch.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// The cell of the patch, steps along both spokes.
    pub cell: [usize; 2],
    /// The Bernstein coefficients of J_vw, J_pw and J_vp, 36 of each.
    pub jacobians: [Vec<BigRational>; 3],
    /// Whether no coefficient of x_u, y_u, x_v and z_v is negative, and of two that belong together, of x_u
    /// and y_u or of x_v and z_v, one is positive.
    pub grows: bool,
}

impl Patch {
    /// The least coefficients of J_vw, J_pw and J_vp.
    pub fn least(&self) -> [BigRational; 3] {
        let least = |list: &Vec<BigRational>| list.iter().min().cloned().unwrap_or_else(BigRational::zero);
        self.jacobians.each_ref().map(least)
    }

    /// Whether the Jacobian is proven to be positive, for s, t > 0.
    pub fn is_regular(&self) -> bool {
        let least = self.least();
        least.iter().all(|c| !c.is_negative()) && least.iter().any(Signed::is_positive)
    }

    /// Whether the Jacobian of (y + s x, z + t x) is proven to be a P-matrix.
    pub fn is_injective(&self) -> bool {
        self.is_regular() && self.grows
    }
}

/// The three patches of a sector.
pub fn patches() -> Vec<Patch> {
    let points = sector_points();
    [[1, 0], [1, 1], [0, 1]].map(|cell| patch(&points, cell)).to_vec()
}

fn patch(points: &[[Parts; 5]; 5], cell: [usize; 2]) -> Patch {
    let (in_u, in_v) = (bezier(cell[0]), bezier(cell[1]));
    let part = |part: usize| {
        let coefficient = |i: usize, j: usize| {
            let mut sum = BigRational::zero();
            for (a, wa) in in_u[i].iter().enumerate() {
                for (b, wb) in in_v[j].iter().enumerate() {
                    sum += wa * wb * &points[a][b][part];
                }
            }
            sum
        };
        Bernstein((0..4).map(|i| (0..4).map(|j| coefficient(i, j)).collect()).collect())
    };
    let [x, y, z] = [part(0), part(1), part(2)];
    let jacobian = |a: &Bernstein, b: &Bernstein| a.by_u().times(&b.by_v()).minus(&a.by_v().times(&b.by_u()));
    let grow = |a: &Bernstein, b: &Bernstein| {
        let mut pairs = a.0.iter().flatten().zip(b.0.iter().flatten());
        pairs.all(|(a, b)| !a.is_negative() && !b.is_negative() && (a + b).is_positive())
    };
    Patch {
        cell,
        jacobians: [jacobian(&y, &z), jacobian(&x, &z), jacobian(&y, &x)].map(|j| j.0.into_iter().flatten().collect()),
        grows: grow(&x.by_u(), &y.by_u()) && grow(&x.by_v(), &z.by_v()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Eq. 30 as the design corrects it: found from the rules, not put in.
    #[test]
    fn points_are_those_of_the_corrected_equation_30() {
        let points = sector_points();
        let expected = [
            ((1, 0), [1, 2, 0], 1),
            ((2, 0), [1, 5, 0], 1),
            ((3, 0), [1, 8, 0], 1),
            ((1, 1), [15, 6, 6], 7),
            ((2, 1), [87, 123, 18], 35),
            ((3, 1), [93, 222, 12], 35),
            ((2, 2), [3987, 2523, 2523], 1085),
            ((3, 2), [939, 1014, 363], 217),
            ((3, 3), [5853, 3912, 3912], 1085),
        ];
        for ((j, k), [p, v, w], q) in expected {
            assert_eq!(points[j + 1][k + 1], [p, v, w].map(|c| ratio(c, q)), "({j}, {k})");
            assert_eq!(points[k + 1][j + 1], [p, w, v].map(|c| ratio(c, q)), "({k}, {j})");
        }
    }

    /// The univariate rules of equal intervals beside a double knot are those by knot intervals.
    #[test]
    fn rows_are_those_of_the_rules_by_intervals() {
        use eigenring_spline::intervals::{doubled, edge, limit, vertex};
        let close = |row: &[BigRational], first: usize, expected: &[f64]| {
            let mut all = vec![0.0; row.len()];
            all[first..first + expected.len()].copy_from_slice(expected);
            let found = row.iter().map(<f64 as Scalar>::rational);
            assert!(found.zip(&all).all(|(a, b)| (a - b).abs() < 1e-15), "{row:?} {all:?}");
        };
        let rule = rule();
        // with the interval 0 before it the point itself is halved, and the rest is the line's
        let [_, own, beyond] = vertex::<f64>([5.0, 0.0, 1.0, 1.0]);
        let [_, shared] = edge::<f64>([5.0, 0.0, 1.0]);
        close(&rule[0], 0, &[0.5, own - 0.5 * shared, beyond]);
        close(&rule[1], 1, &edge::<f64>([0.0, 1.0, 1.0]));
        close(&rule[2], 1, &vertex::<f64>([0.0, 1.0, 1.0, 1.0]));
        close(&rule[3], 2, &edge::<f64>([1.0; 3]));
        let [first, second] = [bezier(0), bezier(1)];
        close(&first[1], 1, &[1.0]);
        let [far, near] = doubled::<f64>([1.0, 1.0, 0.0]);
        close(&first[2], 1, &[near, far]);
        close(&first[3], 1, &limit::<f64>([0.0, 1.0, 1.0, 1.0]));
        close(&second[1], 2, &doubled::<f64>([1.0; 3]));
        let [far, near] = doubled::<f64>([1.0; 3]);
        close(&second[2], 2, &[near, far]);
        close(&second[3], 2, &limit::<f64>([1.0; 4]));
        assert_eq!(first[3], second[0]);
    }

    #[test]
    fn sums_are_one_for_all_and_for_each() {
        assert!(beta_sums_to_one());
        for d in [
            &[1.0, 2.0, 1.5][..],
            &[1.0, 2.0, 1.5, 0.8],
            &[1.0, 2.0, 1.5, 0.8, 1.2, 1e-3, 7.0],
        ] {
            assert!(rows_sum_to_one(d).unwrap(), "{d:?}");
        }
    }

    #[test]
    fn strictness_is_counted() {
        assert!(is_strict(&[1.0, 2.0, 1.5, 0.8, 1.2]).unwrap());
        assert!(is_strict(&[0.0, 1.0, 1.0, 1.0, 1.0, 1.0]).unwrap());
        assert!(is_strict(&[0.0, 0.0, 1.0, 1.0, 1.0, 1.0]).unwrap());
        // two zero spokes opposite each other: a further eigenvalue 1/2
        assert!(!is_strict(&[0.0, 1.0, 1.0, 0.0, 1.0, 1.0]).unwrap());
    }

    #[test]
    fn all_bernstein_coefficients_are_non_negative() {
        let patches = patches();
        let bounds = [(2, ratio(576, 217)), (0, ratio(3384, 1085)), (1, ratio(576, 217))];
        for (patch, (which, bound)) in patches.iter().zip(bounds) {
            assert!(patch.jacobians.iter().all(|list| list.len() == 36));
            assert!(patch.is_injective(), "{:?}", patch.cell);
            // derivatives are by the parameter of a cell
            assert_eq!(patch.least()[which], bound, "{:?}", patch.cell);
        }
        // a proof that could fail does fail for the misprinted point
        let mut wrong = sector_points();
        wrong[3][3] = [0, 0, 0].map(|c| ratio(c, 1));
        assert!(!patch(&wrong, [1, 1]).is_regular());
    }

    #[test]
    fn lemma_2_holds_exactly() {
        for d in [
            &[1.0, 2.0, 1.5][..],
            &[1.0, 2.0, 1.5, 0.8, 1.2],
            &[10.0, 1.0, 3.0, 1.0, 7.0, 1e-3, 2.0],
        ] {
            assert!(polygon_is_an_eigenvector(d).unwrap(), "{d:?}");
        }
        assert!(polygon_is_an_eigenvector(&[0.0, 1.0, 0.0, 1.0, 1.0]).is_err());
    }
}
