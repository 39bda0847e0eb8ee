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
use eigenring_scheme::{Complex, Site};
use eigenring_spectral::{Eigenvalue, Matrix, Mode};
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
}

impl<'a> Eigenvectors<'a> {
    /// All eigenvectors.
    ///
    /// # Errors
    /// [`Error::Content`] for a defective eigenvalue, with the sizes of its Jordan blocks, and where doubles
    /// do not tell eigenvectors of different eigenvalues apart; those of the modes.
    pub fn new(analysis: &'a Analysis) -> Result<Self, Error> {
        let system = &analysis.system;
        crate::matrix::check_size(system.numbering().count())?;
        if let Some(e) = analysis.spectrum.eigenvalues.iter().find(|e| e.is_defective()) {
            let sizes = analysis
                .jordan(e)
                .map_or(String::new(), |sizes| format!(", Jordan blocks of sizes {sizes}"));
            let block = e
                .fourier
                .map_or(String::new(), |index| format!(" of Fourier block {index}"));
            return Err(Error::refused(
                format!(
                    "the eigenvalue {}{block} is defective: multiplicity {}, {} eigenvectors{sizes}",
                    number(e.value),
                    e.multiplicity,
                    e.geometric.unwrap_or(0),
                ),
                Accepted::Are(
                    "matrices with as many eigenvectors as points; another number of --rings may help".to_owned(),
                ),
            ));
        }
        let mut vectors = Vec::new();
        for e in &analysis.spectrum.eigenvalues {
            vectors.extend(of_eigenvalue(analysis, e)?);
        }
        let points = system.numbering().count();
        let found = Eigenvectors { analysis, vectors };
        if found.vectors.len() != points || !(found.residual() <= RESIDUAL) {
            return Err(Error::refused(
                format!(
                    "{} eigenvectors were found for {points} points: eigenvalues are too close for doubles",
                    found.vectors.len()
                ),
                Accepted::Are("matrices whose eigenvectors doubles tell apart: lower orders, fewer rings".to_owned()),
            ));
        }
        Ok(found)
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
            // a defective matrix is refused
            "chains": [],
        })
    }

    /// A row for each vector: the eigenvalue, its Fourier index, `right` or `left`, `re` or `im`, and the
    /// entries under the names of the points.
    pub fn table(&self) -> Table {
        let sites = self.analysis.system.numbering().sites();
        let names = sites
            .into_iter()
            .map(|Site { sector, x, y }| name(sector, x as usize / 2, y as usize / 2, self.analysis));
        let head = ["re", "im", "fourier", "side", "part"].map(str::to_owned);
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

/// The vectors of one eigenvalue of the spectrum.
fn of_eigenvalue(analysis: &Analysis, e: &Eigenvalue) -> Result<Vec<Vectors>, Error> {
    let (system, n) = (&analysis.system, analysis.system.valence());
    let plain = |mode: Mode, value, fourier| Vectors {
        value,
        fourier,
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

    /// `S R = R D` on the dense matrix, which is made without Fourier blocks.
    #[test]
    fn vectors_are_those_of_the_dense_matrix() {
        for (spec, valences) in [
            ("catmull-clark", vec![3, 4, 5, 6, 9, 16, 64]),
            ("doo-sabin:uniform", vec![5, 8]),
            ("stam:order=3", vec![5]),
            ("lambda:optimal", vec![3, 6, 7]),
        ] {
            for valence in valences {
                let scheme = spec
                    .parse::<SchemeName>()
                    .unwrap()
                    .scheme(valence, &Tuner::default())
                    .unwrap();
                let rings = scheme.closed_rings().unwrap();
                let analysis = Analysis::of_scheme(&scheme, Some(rings), None).unwrap();
                let found = Eigenvectors::new(&analysis).unwrap();
                let matrix = LocalMatrix::new(&scheme, Some(rings), None).unwrap().matrix;
                assert!(found.residual() < 1e-10, "{spec} {valence}: {}", found.residual());
                for v in &found.vectors {
                    let largest = v.right.iter().map(|x| x.modulus()).fold(0.0, f64::max);
                    for (i, x) in v.right.iter().enumerate() {
                        let image: f64 = matrix.row(i).iter().zip(&v.right).map(|(m, x)| m * x.re).sum();
                        let error = (image - v.value.re * x.re + v.value.im * x.im).abs();
                        assert!(error < 1e-11 * largest, "{spec} {valence}: {error}");
                    }
                }
            }
        }
    }

    /// Without a mirror symmetry eigenvalues are complex, and each conjugate is of a block of its own.
    #[test]
    fn conjugates_are_listed_each_and_have_vectors_of_their_own() {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../tests/data/cases/asymmetric-line-n5.toml"
        );
        let name = format!("file:{path}").parse::<SchemeName>().unwrap();
        let scheme = name.scheme(5, &Tuner::default()).unwrap();
        let rings = scheme.closed_rings().unwrap();
        let analysis = Analysis::of_scheme(&scheme, Some(rings), None).unwrap();
        let eigenvalues = &analysis.spectrum.eigenvalues;
        let complex: Vec<_> = eigenvalues.iter().filter(|e| e.value.im != 0.0).collect();
        assert!(!complex.is_empty());
        for e in complex.iter().filter(|e| e.fourier != Some(0)) {
            let other = complex.iter().find(|o| o.value == e.value.conj()).unwrap();
            assert_eq!(e.fourier.unwrap() + other.fourier.unwrap(), 5, "{e:?}");
        }
        let count: usize = eigenvalues.iter().map(|e| e.multiplicity).sum();
        assert_eq!(count, analysis.system.numbering().count());
        let vectors = Eigenvectors::new(&analysis).unwrap();
        assert!(vectors.residual() < 1e-10);
        assert!(vectors.vectors.iter().any(|v| v.fourier == Some(4) && v.value.im > 0.0));
    }

    #[test]
    fn defective_matrices_are_refused_with_their_jordan_blocks() {
        let scheme = "doo-sabin"
            .parse::<SchemeName>()
            .unwrap()
            .scheme(5, &Tuner::default())
            .unwrap();
        let analysis = Analysis::of_scheme(&scheme, Some(1), None).unwrap();
        let error = Eigenvectors::new(&analysis).unwrap_err().to_string();
        assert!(error.contains("defective"), "{error}");
    }
}
