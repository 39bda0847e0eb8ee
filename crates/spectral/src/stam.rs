//! The basis of J. Stam, *Exact evaluation of Catmull-Clark subdivision surfaces at arbitrary parameter
//! values* (SIGGRAPH 1998): the surface at a vertex as a sum of eigenfunctions.
//!
//! The K control points C of a face at the vertex are refined by the K x K matrix A, whose eigenvalues L,
//! right vectors V and inverse `V^-1` turn m refinements into powers of numbers. The face `[0, 1]^2`, the
//! vertex at (0, 0), is made of annuli `2^-(m+1) < max(s, t) <= 2^-m`, each of the same patches,
//!
//! ```text
//! S(s, t) = sum_i L_i^m (V^-1 C)_i sum_j X_(k, i, j) b_j(u, v),    k the patch, b uniform bicubic B-splines,
//! ```
//!
//! with the coefficients X of the eigenfunctions. **Layouts.** Where the edge and face points next to the
//! vertex have the regular rules, `K = 2N + 8` (the vertex, its edge points, its face points, and the seven
//! points beyond of sector 0), with 3 patches (p, q), `max(p, q) = 1`, in units of `2^-(m+1)`. Otherwise `K =
//! 6N + 1`, two rings in the order of the numbering, with 12 patches, `max(p, q)` 2 or 3, in units of
//! `2^-(m+2)`.
//!
//! With 2N+8 points the matrix is `[S 0; B D]`: S has one ring, and D the seven points beyond. A vector r of
//! S continues with `(L - D)^-1 B r`, and a left vector q of D with `q B (L - S)^-1`, both as sums over the
//! vectors of the other; where S and D have an eigenvalue in common, `q B r` must be zero.

use crate::extended::Extended;
use crate::repeated::Precision;
use crate::{Annulus, Block, Chain, Error, LocalSystem, Matrix, PatchIndex, numbering};
use eigenring_scheme::{Complex, DenseNet, Fan, Lattice, Scheme, Site, refine};
use eigenring_spline::uniform;

/// Eigenvalues of one ring and of the points beyond within this are the same, and couplings below this are
/// rounding.
const SAME: f64 = 1e-11;

/// Stam's basis at a vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Stam {
    /// The valence.
    pub valence: usize,
    /// Eigenvalues, by falling modulus.
    pub eigenvalues: Vec<f64>,
    /// `V^-1`: a row for each eigenvalue, the weights of the K points.
    pub inverse: Matrix<f64>,
    /// The patches of the annulus.
    pub patches: Vec<[usize; 2]>,
    /// Of each patch and each eigenfunction the 16 control values, 4 along s for each of 4 along t.
    pub coefficients: Vec<Vec<[f64; 16]>>,
}

/// A real eigenvalue with a right and a left vector.
type Pair = (f64, Vec<f64>, Vec<f64>);

/// The points of a layout, in its order.
pub fn stam_points(valence: usize, regular: bool) -> Vec<Site> {
    let fan = Fan::Closed(valence);
    let numbering = eigenring_scheme::Numbering {
        fan,
        lattice: Lattice::Vertex,
        rings: 2,
    };
    if !regular {
        return numbering.sites();
    }
    let ring = |x: i32, y: i32| (0..valence as i64).filter_map(move |sector| Site::new(fan, sector, 2 * x, 2 * y));
    let beyond = [(2, -1), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (-1, 2)];
    let beyond = beyond.into_iter().filter_map(|(x, y)| Site::new(fan, 0, 2 * x, 2 * y));
    [Site::CENTRE]
        .into_iter()
        .chain(ring(1, 0))
        .chain(ring(1, 1))
        .chain(beyond)
        .collect()
}

impl Stam {
    /// The basis of a scheme, whose rules are given in more precision too where there are some.
    ///
    /// # Errors
    /// [`Error::NotBicubic`] for other surfaces than bicubic ones around a vertex, with the same rules on
    /// all levels; [`Error::NotReal`] and [`Error::JordanBlock`] for matrices without a basis of real
    /// eigenvectors; those of the chains.
    pub fn new(scheme: &Scheme<f64>, extended: Option<&Scheme<Extended>>) -> Result<Self, Error> {
        let level = scheme.limit();
        let bicubic = scheme.degree() == Some(3) && level.lattice() == Lattice::Vertex;
        let annulus = match Annulus::new(scheme) {
            Ok(annulus) if bicubic && scheme.leading().is_empty() && annulus.inner <= 2 => annulus,
            _ => return Err(Error::NotBicubic),
        };
        let regular = annulus.inner == 1;
        let valence = level.fan().sectors();
        let points = stam_points(valence, regular);
        let rings = if regular { 1 } else { 2 };
        let system = LocalSystem::new(level, rings)?;
        let chains = system.chains(extended.map(Scheme::limit))?;
        let pairs = real_pairs(&chains, valence)?;
        let net = numbering(level, 2);
        let places: Vec<usize> = points.iter().filter_map(|&site| net.index(site)).collect();
        let mut pairs = if regular {
            let rows = refine(level, &DenseNet { numbering: net }, &points)?;
            let matrix = Matrix::from_fn(points.len(), points.len(), |i, j| rows[i][places[j]]);
            let ring = numbering(level, 1);
            let order: Vec<usize> = points.iter().filter_map(|&site| ring.index(site)).collect();
            let own = |v: &[f64]| order.iter().map(|&place| v[place]).collect::<Vec<f64>>();
            let pairs: Vec<Pair> = pairs.iter().map(|(value, r, l)| (*value, own(r), own(l))).collect();
            continued(&matrix, pairs)?
        } else {
            pairs
        };
        pairs.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
        // the net of the annulus from the two rings
        let outer = refine(level, &DenseNet { numbering: net }, &numbering(level, 3).sites())?;
        let mut rows: Vec<Vec<f64>> = outer
            .iter()
            .map(|row| places.iter().map(|&place| row[place]).collect())
            .collect();
        if !regular {
            let third = DenseNet {
                numbering: numbering(level, 3),
            };
            let next = refine(level, &third, &annulus.numbering.sites())?;
            let combine = |row: &Vec<f64>| {
                let mut sum = vec![0.0; places.len()];
                for (&weight, inner) in row.iter().zip(&rows).filter(|(weight, _)| **weight != 0.0) {
                    sum.iter_mut().zip(inner).for_each(|(s, x)| *s += weight * x);
                }
                sum
            };
            rows = next.iter().map(combine).collect();
        }
        let patches: Vec<PatchIndex> = annulus.patches(0).collect();
        let coefficients = patches.iter().map(|&patch| {
            let control = annulus.control(patch);
            let of = |(_, right, _): &Pair| {
                let mut values = [0.0; 16];
                for (value, &index) in values.iter_mut().zip(&control) {
                    *value = rows[index].iter().zip(right).map(|(a, b)| a * b).sum();
                }
                values
            };
            pairs.iter().map(of).collect()
        });
        Ok(Stam {
            valence,
            coefficients: coefficients.collect(),
            patches: patches.iter().map(|patch| [patch.p, patch.q]).collect(),
            eigenvalues: pairs.iter().map(|pair| pair.0).collect(),
            inverse: Matrix::from_rows(pairs.into_iter().map(|pair| pair.2).collect(), points.len()),
        })
    }

    /// Whether the layout is that of 2N+8 points.
    pub fn is_regular(&self) -> bool {
        self.patches.len() == 3
    }

    /// The limit at (s, t) of the K control points, each of so many coordinates; s runs along the spoke of
    /// sector 0, t along the next. `None` outside of `[0, 1]^2`, and for another number of points.
    pub fn limit<const D: usize>(&self, points: &[[f64; D]], s: f64, t: f64) -> Option<[f64; D]> {
        let inside = |x: f64| (0.0..=1.0).contains(&x);
        if points.len() != self.eigenvalues.len() || !inside(s) || !inside(t) {
            return None;
        }
        let largest = s.max(t);
        // of the vertex the eigenvalue 1 remains; below 2^-1000 nothing else does
        let annuli = if largest > 0.0 {
            (-largest.log2()).floor().min(1000.0)
        } else {
            1000.0
        };
        // the rounded logarithm of a number next to a power of two may be that of the power
        let annuli = (0..=1)
            .map(|more| annuli - 1.0 + f64::from(more))
            .rfind(|m| largest <= (-m).exp2());
        let annuli = annuli.unwrap_or(0.0).max(0.0) as i32;
        let inner = if self.is_regular() { 1.0 } else { 2.0 };
        let scale = inner * f64::from(annuli + 1).exp2();
        let place = |x: f64| {
            let x = x * scale;
            let start = x.floor().min(2.0 * inner - 1.0);
            (start as usize, uniform::values(3, x - start))
        };
        let ((p, along), (q, across)) = (place(s), place(t));
        let patch = self.patches.iter().position(|&patch| patch == [p, q]);
        let mut sum = [0.0; D];
        for (i, &value) in self.eigenvalues.iter().enumerate() {
            let function = match patch {
                Some(patch) => {
                    let control = &self.coefficients[patch][i];
                    let weight = |j: usize| along[j % 4] * across[j / 4];
                    (0..16).map(|j| weight(j) * control[j]).sum::<f64>()
                }
                // the vertex itself: the dominant function is constant
                None => self.coefficients[0][i][0],
            };
            let power = value.powi(annuli) * function;
            for (weight, point) in self.inverse.row(i).iter().zip(points) {
                sum.iter_mut()
                    .zip(point)
                    .for_each(|(sum, x)| *sum += power * weight * x);
            }
        }
        Some(sum)
    }
}

/// The vectors of all blocks as real ones: of an index that is shared by N-k the real and imaginary parts.
fn real_pairs(chains: &[Chain], valence: usize) -> Result<Vec<Pair>, Error> {
    let mut pairs = Vec::new();
    for chain in chains {
        if chain.value.im != 0.0 {
            return Err(Error::NotReal {
                re: chain.value.re,
                im: chain.value.im,
            });
        }
        if chain.right.len() > 1 {
            return Err(Error::JordanBlock {
                value: chain.value.re,
                fourier: chain.fourier,
                size: chain.right.len(),
            });
        }
        let (r, l) = (&chain.right[0], &chain.left[0]);
        let part = |f: fn(&Complex<f64>) -> f64, by: f64| -> Pair {
            let left = l.iter().map(|x| by * f(x)).collect();
            (chain.value.re, r.iter().map(f).collect(), left)
        };
        if chain.fourier.is_none_or(|k| k == 0 || 2 * k == valence) {
            pairs.push(part(|x| x.re, 1.0));
        } else {
            pairs.push(part(|x| x.re, 2.0));
            pairs.push(part(|x| x.im, -2.0));
        }
    }
    Ok(pairs)
}

/// The vectors of `[S 0; B D]` from those of S.
fn continued(matrix: &Matrix<f64>, inner: Vec<Pair>) -> Result<Vec<Pair>, Error> {
    let (all, size) = (matrix.rows(), inner.len());
    let part = Matrix::from_fn(all - size, all - size, |i, j| matrix[(size + i, size + j)]);
    let mut beyond: Vec<Pair> = Vec::new();
    // the rules beyond are regular, with dyadic weights
    for (value, chains) in Block::Real(part).lifted().vectors(Precision::Extended, 0)? {
        for (right, left) in chains {
            if right.len() > 1 || value.im != 0.0 {
                return Err(Error::JordanBlock {
                    value: value.re,
                    fourier: None,
                    size: right.len(),
                });
            }
            let round = |v: &Vec<Complex<Extended>>| v.iter().map(|x| x.re.to_f64()).collect();
            beyond.push((value.re, round(&right[0]), round(&left[0])));
        }
    }
    let image = |r: &[f64], i: usize| -> f64 { matrix.row(size + i)[..size].iter().zip(r).map(|(a, b)| a * b).sum() };
    let mut pairs = Vec::with_capacity(all);
    let mut lefts: Vec<Vec<f64>> = vec![vec![0.0; size]; beyond.len()];
    for (value, right, left) in inner {
        let images: Vec<f64> = (0..all - size).map(|i| image(&right, i)).collect();
        let largest = right.iter().fold(0.0_f64, |max, x| max.max(x.abs()));
        let mut rest = vec![0.0; all - size];
        for ((other, r, l), sum) in beyond.iter().zip(&mut lefts) {
            let coupling: f64 = l.iter().zip(&images).map(|(a, b)| a * b).sum();
            let length = l.iter().fold(0.0_f64, |max, x| max.max(x.abs()));
            if coupling.abs() <= SAME * largest * length {
                continue;
            }
            let gap = value - other;
            if gap.abs() <= SAME {
                return Err(Error::JordanBlock {
                    value,
                    fourier: None,
                    size: 2,
                });
            }
            rest.iter_mut().zip(r).for_each(|(x, r)| *x += coupling / gap * r);
            sum.iter_mut().zip(&left).for_each(|(x, l)| *x -= coupling / gap * l);
        }
        let weights = left.into_iter().chain(std::iter::repeat_n(0.0, all - size)).collect();
        pairs.push((value, right.into_iter().chain(rest).collect(), weights));
    }
    for ((value, right, left), sum) in beyond.into_iter().zip(lefts) {
        let zeros = std::iter::repeat_n(0.0, size);
        pairs.push((
            value,
            zeros.chain(right).collect(),
            sum.into_iter().chain(left).collect(),
        ));
    }
    Ok(pairs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::local_matrix;
    use eigenring_scheme::families::catmull_clark;
    use eigenring_scheme::{Centre, Corner, Definition, PointNet, Spec};

    /// `V^-1 A = L V^-1`, with A refined from the rules, relative to the largest absolute column sum and
    /// entry; and the limit against plain refinement, down to parameters of 2^-20.
    fn check(scheme: &Scheme<f64>, stam: &Stam) {
        let (n, level) = (stam.valence, scheme.limit());
        let points = stam_points(n, stam.is_regular());
        let count = points.len();
        assert_eq!(count, if stam.is_regular() { 2 * n + 8 } else { 6 * n + 1 });
        let net = numbering(level, 2);
        let rows = refine(level, &DenseNet { numbering: net }, &points).unwrap();
        let places: Vec<usize> = points.iter().map(|&site| net.index(site).unwrap()).collect();
        let matrix = Matrix::from_fn(count, count, |i, j| rows[i][places[j]]);
        let norm = (0..count)
            .map(|j| (0..count).map(|i| matrix[(i, j)].abs()).sum::<f64>())
            .fold(0.0, f64::max);
        for (i, value) in stam.eigenvalues.iter().enumerate() {
            let left = stam.inverse.row(i);
            let largest = left.iter().fold(0.0_f64, |max, x| max.max(x.abs()));
            for j in 0..count {
                let image: f64 = (0..count).map(|k| left[k] * matrix[(k, j)]).sum();
                let error = (image - value * left[j]).abs() / (norm * largest);
                assert!(error < 1e-13, "{n}: row {i}, {error}");
            }
        }
        // a net of two rings, refined again and again
        let control: Vec<[f64; 2]> = (0..net.count())
            .map(|i| [(i as f64 * 1.7).sin(), (i as f64 * 0.9).cos()])
            .collect();
        let own: Vec<[f64; 2]> = places.iter().map(|&place| control[place]).collect();
        let annulus = Annulus::new(scheme).unwrap();
        let whole = local_matrix(level, 2).unwrap();
        let (first, mut fine) = (control.clone(), control);
        for m in 0..=20_i32 {
            let unit = 0.5_f64.powi(m);
            let mut outer = fine.clone();
            for rings in (3..=annulus.numbering.rings).step_by(2) {
                let source = if rings == 3 { net } else { numbering(level, 3) };
                outer = refine(
                    level,
                    &PointNet {
                        numbering: source,
                        points: outer,
                    },
                    &numbering(level, rings).sites(),
                )
                .unwrap();
            }
            for (s, t) in [
                (1.0, 0.3),
                (0.8, 0.9),
                (0.2, 0.7),
                (0.55, 0.0),
                (0.0, 1.0),
                (0.51, 0.25),
            ] {
                let found = stam.limit(&own, s * unit, t * unit).unwrap();
                let scale = 2.0 * annulus.inner as f64;
                let start = |x: f64| (x * scale).floor().min(scale - 1.0);
                let patch = PatchIndex {
                    sector: 0,
                    p: start(s) as usize,
                    q: start(t) as usize,
                };
                let (u, v) = (s * scale - start(s), t * scale - start(t));
                // cubic B-splines by the matrix of their coefficients
                let b = |u: f64| {
                    [
                        (1.0 - u).powi(3) / 6.0,
                        (3.0 * u.powi(3) - 6.0 * u * u + 4.0) / 6.0,
                        (-3.0 * u.powi(3) + 3.0 * u * u + 3.0 * u + 1.0) / 6.0,
                        u.powi(3) / 6.0,
                    ]
                };
                let mut expected = [0.0; 2];
                for (j, index) in annulus.control(patch).into_iter().enumerate() {
                    let weight = b(u)[j % 4] * b(v)[j / 4];
                    (0..2).for_each(|d| expected[d] += weight * outer[index][d]);
                }
                for d in 0..2 {
                    assert!(
                        (found[d] - expected[d]).abs() < 1e-12,
                        "{n}: 2^-{m} ({s}, {t}): {found:?} {expected:?}"
                    );
                }
            }
            fine = (0..net.count())
                .map(|i| {
                    let sum = |d: usize| (0..net.count()).map(|j| whole[(i, j)] * fine[j][d]).sum();
                    [sum(0), sum(1)]
                })
                .collect();
        }
        // the vertex itself, by the limit stencil
        let position = LocalSystem::new(level, 2).unwrap().limit_position().unwrap();
        let at_vertex = stam.limit(&own, 0.0, 0.0).unwrap();
        for d in 0..2 {
            let expected: f64 = position.iter().zip(&first).map(|(w, p)| w * p[d]).sum();
            assert!((at_vertex[d] - expected).abs() < 1e-12, "{n}: {at_vertex:?}");
        }
    }

    #[test]
    fn catmull_clark_at_all_valences() {
        for valence in 3..=64 {
            let scheme = catmull_clark::<f64>(valence).unwrap();
            let stam = Stam::new(&scheme, Some(&catmull_clark(valence).unwrap())).unwrap();
            assert!(stam.is_regular());
            check(&scheme, &stam);
        }
    }

    #[test]
    fn special_edge_and_face_points_take_two_rings() {
        let definition = Definition::Family("lambda:lambda=0.55".parse::<Spec>().unwrap());
        let scheme: Scheme<f64> = definition.around(&Corner::closed(Centre::Vertex, 6).unwrap()).unwrap();
        let stam = Stam::new(&scheme, None).unwrap();
        assert!(!stam.is_regular());
        check(&scheme, &stam);
    }

    #[test]
    fn other_surfaces_are_refused() {
        let scheme = eigenring_scheme::families::doo_sabin::<f64>(5).unwrap();
        assert_eq!(Stam::new(&scheme, None), Err(Error::NotBicubic));
    }
}
