//! All right and left eigenvectors of a local matrix, with the names of its points.
//!
//! Columns stand in the order of the spectrum. A real eigenvalue has real vectors: where blocks k and N-k
//! share it, each vector `r` of block k stands for two, its real and its imaginary part, whose left vectors
//! are `2 Re l` and `-2 Im l`. Of a complex eigenvalue each conjugate has its own vector, with its own
//! Fourier index. With R and L the matrices of columns and D the eigenvalues, `S R = R D` and `L^T R = I`.

use crate::error::{Accepted, Error};
use crate::matrix::npy;
use crate::spectrum::Analysis;
use crate::table::{Cell, Table};
use eigenring_scheme::{Complex, Scheme, Site};
use eigenring_spectral::{Chain, Eigenvalue, Extended, Matrix, Mode};
use serde_json::{Value, json};

/// Entries of `L^T R - I`, relative to the lengths of the vectors, beyond which they are refused: a missing
/// or a doubled vector leaves one of the order of 1. Empirical: half of the digits.
const RESIDUAL: f64 = 1e-6;

/// A right eigenvector and the left one that belongs to it.
#[derive(Clone, Debug)]
pub struct Vectors {
    /// The eigenvalue.
    pub value: Complex<f64>,
    /// The Fourier index, below N; k <= N/2 for the real and imaginary parts that k and N-k share. `None`
    /// without blocks.
    pub fourier: Option<usize>,
    /// The place in its Jordan chain, 1 for an eigenvector.
    pub place: usize,
    /// Values at the points.
    pub right: Vec<Complex<f64>>,
    /// Weights of the points.
    pub left: Vec<Complex<f64>>,
}

/// The eigenvectors of an analysed matrix.
#[derive(Clone, Debug)]
pub struct Eigenvectors<'a> {
    analysis: &'a Analysis,
    /// As many as there are points.
    pub vectors: Vec<Vectors>,
    /// The places of the vectors of each Jordan chain that is longer than one, the eigenvector first.
    pub chains: Vec<Vec<usize>>,
}

/// The chains of a system that no eigenvalue of the spectrum has claimed yet.
struct Open {
    valence: usize,
    chains: Vec<Chain>,
    /// Of each chain, whether it was taken for its own block and for the conjugate one.
    taken: Vec<[bool; 2]>,
}

impl Open {
    fn new(chains: Vec<Chain>, valence: usize) -> Self {
        let taken = vec![[false; 2]; chains.len()];
        Open { valence, chains, taken }
    }

    /// The chain of an eigenvalue, the nearest that is left in its block; block N-k has the conjugates of
    /// block k.
    fn next(&mut self, e: &Eigenvalue) -> Option<Chain> {
        let mirrored = e.fourier.is_some_and(|index| 2 * index > self.valence);
        let index = e
            .fourier
            .map(|index| if mirrored { self.valence - index } else { index });
        let value = if mirrored { e.value.conj() } else { e.value };
        let distance = |chain: &Chain| (chain.value - value).modulus();
        let side = usize::from(mirrored);
        let left = (0..self.chains.len()).filter(|&i| self.chains[i].fourier == index && !self.taken[i][side]);
        // the first of equal ones
        let best = left.min_by(|&a, &b| distance(&self.chains[a]).total_cmp(&distance(&self.chains[b])))?;
        if distance(&self.chains[best]) > SAME * value.modulus().max(SAME) {
            return None;
        }
        self.taken[best][side] = true;
        let chain = self.chains[best].clone();
        Some(if mirrored { chain.conjugate() } else { chain })
    }
}

/// Eigenvalues of the spectrum and of the chains are those of the same computation, or of one in doubles.
const SAME: f64 = 1e-7;

/// The vectors of a chain with their parts.
trait Parts {
    fn map(
        &self,
        value: Complex<f64>,
        fourier: Option<usize>,
        right: impl Fn(&Vec<Complex<f64>>) -> Vec<Complex<f64>>,
        left: impl Fn(&Vec<Complex<f64>>) -> Vec<Complex<f64>>,
    ) -> Vec<Vectors>;
    fn conjugate(self) -> Self;
}

impl Parts for Chain {
    fn map(
        &self,
        value: Complex<f64>,
        fourier: Option<usize>,
        right: impl Fn(&Vec<Complex<f64>>) -> Vec<Complex<f64>>,
        left: impl Fn(&Vec<Complex<f64>>) -> Vec<Complex<f64>>,
    ) -> Vec<Vectors> {
        let pairs = self.right.iter().zip(&self.left);
        let vectors = pairs.enumerate().map(|(place, (r, l))| Vectors {
            value,
            fourier,
            place: place + 1,
            right: right(r),
            left: left(l),
        });
        vectors.collect()
    }

    fn conjugate(mut self) -> Self {
        self.value.im = -self.value.im;
        for x in self.right.iter_mut().chain(&mut self.left).flatten() {
            x.im = -x.im;
        }
        self
    }
}

impl<'a> Eigenvectors<'a> {
    /// All eigenvectors, and the further vectors of Jordan chains. With the rules in more precision they are
    /// as exact as doubles are.
    ///
    /// # Errors
    /// [`Error::Content`] where the precision does not tell eigenvectors of different eigenvalues apart, and
    /// for a defective eigenvalue of a block that is too large for Jordan chains; those of the decomposition.
    pub fn new(analysis: &'a Analysis, extended: Option<&Scheme<Extended>>) -> Result<Self, Error> {
        let system = &analysis.system;
        crate::matrix::check_size(system.numbering().count())?;
        let number = analysis.level.map_or(0, |(level, _)| level);
        let mut found = Eigenvectors {
            analysis,
            vectors: Vec::new(),
            chains: Vec::new(),
        };
        match system.chains(extended.map(|scheme| scheme.level(number))) {
            Ok(chains) => {
                let mut open = Open::new(chains, system.valence());
                for e in &analysis.spectrum.eigenvalues {
                    found.add(e, &mut open)?;
                }
            }
            // in doubles, where every eigenvalue has as many vectors as its multiplicity
            Err(eigenring_spectral::Error::Large { .. }) => {
                for e in &analysis.spectrum.eigenvalues {
                    if e.is_defective() {
                        return Err(defective(analysis, e));
                    }
                    found.vectors.extend(of_eigenvalue(analysis, e)?);
                }
            }
            Err(error) => return Err(error.into()),
        }
        let points = system.numbering().count();
        if found.vectors.len() != points || !(found.residual() <= RESIDUAL) {
            return Err(Error::refused(
                format!(
                    "{} eigenvectors were found for {points} points: eigenvalues are too close",
                    found.vectors.len()
                ),
                Accepted::Are("matrices whose eigenvectors can be told apart: lower orders, fewer rings".to_owned()),
            ));
        }
        Ok(found)
    }

    /// Appends the vectors of an eigenvalue.
    fn add(&mut self, e: &Eigenvalue, open: &mut Open) -> Result<(), Error> {
        let mut missing = e.multiplicity;
        while missing > 0 {
            let Some(chain) = open.next(e) else {
                return Err(Error::refused(
                    format!("the vectors of the eigenvalue {} were not found", number(e.value)),
                    Accepted::Are("matrices whose eigenvalues can be told apart: lower orders, fewer rings".to_owned()),
                ));
            };
            let n = self.analysis.system.valence();
            let twice = e.blocks == 2;
            let conjugate = Complex::<f64>::conj;
            let parts: Vec<Vec<Vectors>> = if twice && e.value.im == 0.0 {
                let part = |f: fn(&Complex<f64>) -> f64, sign: f64| {
                    let take = |v: &Vec<Complex<f64>>, by: f64| v.iter().map(|x| Complex::real(by * f(x))).collect();
                    chain.map(e.value, e.fourier, |r| take(r, 1.0), |l| take(l, 2.0 * sign))
                };
                vec![part(|x| x.re, 1.0), part(|x| x.im, -1.0)]
            } else if twice {
                let all = |v: &Vec<Complex<f64>>| v.iter().copied().map(conjugate).collect();
                let other = e.fourier.map(|index| n - index);
                vec![
                    chain.map(e.value, e.fourier, Clone::clone, Clone::clone),
                    chain.map(conjugate(e.value), other, all, all),
                ]
            } else {
                vec![chain.map(e.value, e.fourier, Clone::clone, Clone::clone)]
            };
            for part in parts {
                missing = missing.saturating_sub(part.len());
                if part.len() > 1 {
                    self.chains
                        .push((self.vectors.len()..self.vectors.len() + part.len()).collect());
                }
                self.vectors.extend(part);
            }
        }
        Ok(())
    }

    /// The largest entry of `L^T R - I`, relative to the lengths of the vectors.
    pub fn residual(&self) -> f64 {
        let mut largest = 0.0_f64;
        let length = |v: &[Complex<f64>]| v.iter().map(|x| x.norm_square()).sum::<f64>().sqrt();
        for (i, a) in self.vectors.iter().enumerate() {
            for (j, b) in self.vectors.iter().enumerate() {
                let pairs = a.left.iter().zip(&b.right);
                let product = pairs.fold(Complex::zero(), |sum, (&l, &r)| sum + l * r);
                let defect = (product - Complex::real(f64::from(u8::from(i == j)))).modulus();
                let relative = defect / (length(&a.left) * length(&b.right)).max(1.0);
                // a NaN is kept
                if !(relative <= largest) {
                    largest = relative;
                }
            }
        }
        largest
    }

    /// The points: name, sector, and steps x along the sector's spoke and y along the next.
    pub fn points(&self) -> Table {
        let mut table = Table::new(["name", "sector", "x", "y"]);
        for Site { sector, x, y } in self.analysis.system.numbering().sites() {
            // x, y >= 0 for canonical sites
            let (x, y) = (x as usize / 2, y as usize / 2);
            table.push(vec![
                name(sector, x, y, self.analysis).into(),
                sector.into(),
                x.into(),
                y.into(),
            ]);
        }
        table
    }

    /// The matrix of the real or imaginary parts of all right or left vectors, as columns.
    fn matrix(&self, part: impl Fn(&Vectors) -> &Vec<Complex<f64>>, imaginary: bool) -> Matrix<f64> {
        let size = self.vectors.len();
        Matrix::from_fn(size, size, |i, j| {
            let entry = part(&self.vectors[j])[i];
            // no negative zeros
            (if imaginary { entry.im } else { entry.re }) + 0.0
        })
    }

    fn is_real(&self) -> bool {
        self.vectors.iter().all(|v| v.value.im == 0.0)
    }

    /// Everything as a JSON object. Rows are points, columns vectors; `right_im` and `left_im` are the
    /// imaginary parts, null where all are real.
    pub fn json(&self) -> Value {
        let rows =
            |matrix: Matrix<f64>| -> Vec<Vec<f64>> { (0..matrix.rows()).map(|i| matrix.row(i).to_vec()).collect() };
        let imaginary =
            |part: fn(&Vectors) -> &Vec<Complex<f64>>| (!self.is_real()).then(|| rows(self.matrix(part, true)));
        let eigenvalues: Vec<Value> = self
            .vectors
            .iter()
            .map(|v| json!({"re": v.value.re, "im": v.value.im, "fourier": v.fourier}))
            .collect();
        json!({
            "scheme": self.analysis.name,
            "corner": self.analysis.corner,
            "valence": self.analysis.system.valence(),
            "rings": self.analysis.system.numbering().rings,
            "points": self.points().json(),
            "eigenvalues": eigenvalues,
            "right": rows(self.matrix(|v| &v.right, false)),
            "right_im": imaginary(|v| &v.right),
            "left": rows(self.matrix(|v| &v.left, false)),
            "left_im": imaginary(|v| &v.left),
            // columns, the eigenvector first
            "chains": self.chains,
        })
    }

    /// A row for each vector: the eigenvalue, its Fourier index, `right` or `left`, `re` or `im`, the place
    /// in its Jordan chain, and the entries under the names of the points.
    pub fn table(&self) -> Table {
        let sites = self.analysis.system.numbering().sites();
        let names = sites
            .into_iter()
            .map(|Site { sector, x, y }| name(sector, x as usize / 2, y as usize / 2, self.analysis));
        let head = ["re", "im", "fourier", "side", "part", "chain"].map(str::to_owned);
        let mut table = Table::new(head.into_iter().chain(names));
        for v in &self.vectors {
            for (side, vector) in [("right", &v.right), ("left", &v.left)] {
                for (part, imaginary) in [("re", false), ("im", true)] {
                    if imaginary && v.value.im == 0.0 {
                        continue;
                    }
                    let mut row: Vec<Cell> = vec![
                        v.value.re.into(),
                        v.value.im.into(),
                        v.fourier.into(),
                        side.into(),
                        part.into(),
                        v.place.into(),
                    ];
                    row.extend(
                        vector
                            .iter()
                            .map(|x| Cell::from((if imaginary { x.im } else { x.re }) + 0.0)),
                    );
                    table.push(row);
                }
            }
        }
        table
    }

    /// NumPy's format: an array of shape (2, points, points), the right vectors as columns, then the left
    /// ones.
    ///
    /// # Errors
    /// [`Error::Content`] where some are complex.
    pub fn npy(&self) -> Result<Vec<u8>, Error> {
        if !self.is_real() {
            return Err(Error::refused(
                "some eigenvalues are complex, and npy holds real arrays",
                Accepted::Are("--format json and csv".to_owned()),
            ));
        }
        let (right, left) = (self.matrix(|v| &v.right, false), self.matrix(|v| &v.left, false));
        let size = right.rows();
        Ok(npy(
            &[2, size, size],
            right.entries().iter().chain(left.entries()).copied(),
        ))
    }
}

/// `V`, or `P_sector(x,y)`.
fn name(sector: usize, x: usize, y: usize, analysis: &Analysis) -> String {
    let vertex = analysis.system.numbering().lattice == eigenring_scheme::Lattice::Vertex;
    if vertex && x == 0 && y == 0 {
        "V".to_owned()
    } else {
        format!("P_{sector}({x},{y})")
    }
}

fn number(value: Complex<f64>) -> String {
    let Complex { re, im } = value;
    if im == 0.0 {
        re.to_string()
    } else {
        format!("{re} {im:+} i")
    }
}

/// The refusal of a matrix whose Jordan chains are out of reach, with its Jordan block.
fn defective(analysis: &Analysis, e: &Eigenvalue) -> Error {
    let sizes = analysis
        .jordan(e)
        .map_or(String::new(), |sizes| format!(", Jordan blocks of sizes {sizes}"));
    let block = e
        .fourier
        .map_or(String::new(), |index| format!(" of Fourier block {index}"));
    Error::refused(
        format!(
            "the eigenvalue {}{block} is defective: multiplicity {}, {} eigenvectors{sizes}",
            number(e.value),
            e.multiplicity,
            e.geometric.unwrap_or(0),
        ),
        Accepted::Are("here matrices with as many eigenvectors as points; fewer --rings have Jordan chains".to_owned()),
    )
}

/// The vectors of one eigenvalue of the spectrum, in doubles.
fn of_eigenvalue(analysis: &Analysis, e: &Eigenvalue) -> Result<Vec<Vectors>, Error> {
    let (system, n) = (&analysis.system, analysis.system.valence());
    let plain = |mode: Mode, value, fourier| Vectors {
        value,
        fourier,
        place: 1,
        right: mode.values,
        left: mode.functional,
    };
    let Some(index) = e.fourier else {
        let modes = system.modes(0, e.value)?.into_iter();
        return Ok(modes.map(|mode| plain(mode, e.value, None)).collect());
    };
    let modes = system.modes(index, e.value)?;
    if e.blocks == 1 {
        return Ok(modes
            .into_iter()
            .map(|mode| plain(mode, e.value, Some(index)))
            .collect());
    }
    let mut vectors = Vec::new();
    if e.value.im == 0.0 {
        for mode in modes {
            let real = |v: &[Complex<f64>], factor: f64| v.iter().map(|x| Complex::real(factor * x.re)).collect();
            let imaginary = |v: &[Complex<f64>], factor: f64| v.iter().map(|x| Complex::real(factor * x.im)).collect();
            let of = |right, left| Vectors {
                value: e.value,
                fourier: Some(index),
                place: 1,
                right,
                left,
            };
            vectors.push(of(real(&mode.values, 1.0), real(&mode.functional, 2.0)));
            vectors.push(of(imaginary(&mode.values, 1.0), imaginary(&mode.functional, -2.0)));
        }
    } else {
        vectors.extend(modes.into_iter().map(|mode| plain(mode, e.value, Some(index))));
        let conjugate = e.value.conj();
        let modes = system.modes(n - index, conjugate)?.into_iter();
        vectors.extend(modes.map(|mode| plain(mode, conjugate, Some(n - index))));
    }
    Ok(vectors)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrix::LocalMatrix;
    use crate::schemes::{SchemeName, Tuner};
    use eigenring_scheme::Shape;

    fn found(spec: &str, valence: usize, rings: Option<usize>) -> (Scheme<f64>, Option<Scheme<Extended>>, Analysis) {
        let name = spec.parse::<SchemeName>().unwrap();
        let scheme = name.scheme(valence, &Tuner::default()).unwrap();
        let corner = Shape::Closed { sectors: valence }
            .corner(name.centre().unwrap(), None)
            .unwrap();
        let extended = name.extended(&corner).unwrap();
        let rings = rings.or(Some(scheme.closed_rings().unwrap()));
        let analysis = Analysis::of_rules(&scheme, extended.as_ref(), rings, None).unwrap();
        (scheme, extended, analysis)
    }

    /// `S R = R J` on the dense matrix, which is made without Fourier blocks.
    #[test]
    fn vectors_are_those_of_the_dense_matrix() {
        for (spec, valences, rings) in [
            ("catmull-clark", vec![3, 4, 5, 6, 9, 16, 64], None),
            ("doo-sabin:uniform", vec![3, 5, 8, 20], None),
            // defective
            ("doo-sabin", vec![5, 8], Some(1)),
            ("stam:order=3", vec![3, 5], Some(1)),
            ("stam:order=6", vec![7, 20], None),
            ("lambda:optimal", vec![3, 6, 7, 20], None),
        ] {
            for valence in valences {
                let (scheme, extended, analysis) = found(spec, valence, rings);
                let found = Eigenvectors::new(&analysis, extended.as_ref()).unwrap();
                let rings = analysis.system.numbering().rings;
                let matrix = LocalMatrix::new(&scheme, Some(rings), None).unwrap().matrix;
                assert!(found.residual() < 1e-13, "{spec} {valence}: {}", found.residual());
                let defective = analysis.spectrum.eigenvalues.iter().any(Eigenvalue::is_defective);
                assert_eq!(!found.chains.is_empty(), defective, "{spec} {valence}");
                for (column, v) in found.vectors.iter().enumerate() {
                    let largest = v.right.iter().map(|x| x.modulus()).fold(0.0, f64::max);
                    let before = (v.place > 1).then(|| &found.vectors[column - 1].right);
                    let largest = before
                        .iter()
                        .flat_map(|b| b.iter())
                        .map(|x| x.modulus())
                        .fold(largest, f64::max);
                    for (i, x) in v.right.iter().enumerate() {
                        let image: f64 = matrix.row(i).iter().zip(&v.right).map(|(m, x)| m * x.re).sum();
                        let chained = before.map_or(0.0, |b| b[i].re);
                        let error = (image - v.value.re * x.re + v.value.im * x.im - chained).abs();
                        assert!(error < 1e-13 * largest, "{spec} {valence}: {error}");
                    }
                }
            }
        }
    }

    /// Rules of valence 5 that a rotation leaves as they are, and no mirror.
    const WITHOUT_MIRROR: &str = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/data/cases/asymmetric-line-n5.toml"
    );

    /// Without a mirror symmetry eigenvalues are complex, and each conjugate is of a block of its own.
    #[test]
    fn conjugates_are_listed_each_and_have_vectors_of_their_own() {
        let (_, extended, analysis) = found(&format!("file:{WITHOUT_MIRROR}"), 5, None);
        let eigenvalues = &analysis.spectrum.eigenvalues;
        let complex: Vec<_> = eigenvalues.iter().filter(|e| e.value.im != 0.0).collect();
        assert!(!complex.is_empty());
        for e in complex.iter().filter(|e| e.fourier != Some(0)) {
            let other = complex.iter().find(|o| o.value == e.value.conj()).unwrap();
            assert_eq!(e.fourier.unwrap() + other.fourier.unwrap(), 5, "{e:?}");
        }
        let count: usize = eigenvalues.iter().map(|e| e.multiplicity).sum();
        assert_eq!(count, analysis.system.numbering().count());
        let vectors = Eigenvectors::new(&analysis, extended.as_ref()).unwrap();
        assert!(vectors.residual() < 1e-13);
        assert!(vectors.vectors.iter().any(|v| v.fourier == Some(4) && v.value.im > 0.0));
    }

    /// `l S = lambda l` on the dense matrix for the complex vector whose parts the tangents are.
    #[test]
    fn tangents_of_a_complex_pair_are_its_left_vector() {
        let (scheme, _, analysis) = found(&format!("file:{WITHOUT_MIRROR}"), 5, None);
        let rings = analysis.system.numbering().rings;
        let matrix = LocalMatrix::new(&scheme, Some(rings), None).unwrap().matrix;
        let eigenvalues = analysis.spectrum.eigenvalues.iter();
        let lambda = eigenvalues.into_iter().find(|e| e.fourier == Some(1)).unwrap().value;
        assert!(lambda.im != 0.0);
        let json = analysis.json();
        let tangent = |name: &str| -> Vec<f64> {
            let numbers = json["limit_stencils"][name].as_array().unwrap();
            numbers.iter().map(|x| x.as_f64().unwrap()).collect()
        };
        let (x, y) = (tangent("tangent_x"), tangent("tangent_y"));
        assert!(x.iter().any(|w| w.abs() > 0.1));
        for j in 0..x.len() {
            // l = x - i y
            let image = |t: &[f64]| (0..t.len()).map(|i| t[i] * matrix[(i, j)]).sum::<f64>();
            assert!((image(&x) - lambda.re * x[j] - lambda.im * y[j]).abs() < 1e-13);
            assert!((-image(&y) - lambda.im * x[j] + lambda.re * y[j]).abs() < 1e-13);
        }
    }
}
