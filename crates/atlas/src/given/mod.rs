//! A local matrix that somebody has, in any order of its points, with any rotation or none.
//!
//! With a rotation of order N (module `rotation`) a net of Fourier index k has the values `v_j w^(k s)` at
//! point s of orbit j, `w = exp(2 pi i/N)`, and is mapped to one of the same index by the block
//!
//! `B_k[i][j] = sum_s S[o_i(0), o_j(s)] w^(k s)`,
//!
//! rows and columns being orbits, preceded by the fixed points if k = 0. A left eigenvector l of `B_k` has
//! the weights `l_j w^(-k s) / N` in the whole matrix, and those of fixed points as they are. Without a
//! rotation the one block is the matrix.

mod half_cell;
mod rotation;

pub use rotation::{Rotation, find};

use crate::error::{Accepted, Error};
use crate::table::{Cell, Format, Record, Table, short};
use eigenring_scheme::Complex;
/// The matrices that are analysed.
pub use eigenring_spectral::Matrix;
use eigenring_spectral::{Block, Eigenvalue, Spectrum};
use serde_json::{Map, Value, json};

/// Values of a vector below this times the largest are zero.
const REAL: f64 = 1e-9;

/// Row sums further than this from 1 are worth a warning: beyond the rounding of printed weights.
const AFFINE: f64 = 1e-12;

/// An eigenvalue this near to 1 is the one of affine rules, in weights of single precision.
const ONE: f64 = 1e-5;

/// A matrix with its spectrum.
#[derive(Clone, Debug)]
pub struct Given {
    /// What it is called.
    name: String,
    /// As it was given, or its mean over the rotation.
    matrix: Matrix<f64>,
    /// The rotation, and how far the matrix was from it, relative to its largest entry.
    rotation: Option<(Rotation, f64)>,
    blocks: Vec<Block<f64>>,
    spectrum: Spectrum,
    defect: f64,
    /// Of a scheme beside a boundary or crease where that is.
    around: Option<half_cell::Around>,
}

/// Weights of the points, or why there are none.
type Weights<T> = Result<T, String>;

impl Given {
    /// Analyses a matrix, with the rotation of a numbering, of a valence, or the largest that is found.
    ///
    /// # Errors
    /// [`Error::Content`] for a matrix that is not square, or has no rotation of the given valence.
    pub fn new(
        name: impl Into<String>,
        matrix: &Matrix<f64>,
        valence: Option<usize>,
        numbered: Option<Rotation>,
    ) -> Result<Self, Error> {
        let (rows, columns) = (matrix.rows(), matrix.columns());
        if rows != columns || rows == 0 {
            let accepted = Accepted::Are("square ones".to_owned());
            return Err(Error::refused(format!("the matrix is {rows} x {columns}"), accepted));
        }
        if let (Some(valence), Some(rotation)) = (valence, &numbered)
            && rotation.valence != valence
        {
            let accepted = Accepted::Is(format!("{}, or no -N", rotation.valence));
            return Err(Error::refused(
                format!("-N is {valence}, and the numbering has another"),
                accepted,
            ));
        }
        let rotation = match numbered {
            Some(rotation) => {
                let distance = rotation.distance(matrix);
                if distance > rotation::TOLERANCE {
                    let message =
                        format!("the matrix has no rotation in this numbering: entries differ by {distance:e}");
                    return Err(Error::refused(
                        message,
                        Accepted::Are("numberings of its rotation".to_owned()),
                    ));
                }
                Some((rotation, distance))
            }
            None => find(matrix, valence),
        };
        if let (Some(valence), None) = (valence, &rotation)
            && valence > 1
        {
            let other = find(matrix, None).map_or("no -N, since it has no rotation".to_owned(), |(found, _)| {
                format!("-N {}, or no -N", found.valence)
            });
            let message = format!(
                "the {rows} x {rows} matrix has no rotation of order {valence}, in no order of points that is known"
            );
            return Err(Error::refused(message, Accepted::Is(other)));
        }
        let matrix = rotation
            .as_ref()
            .map_or_else(|| matrix.clone(), |(rotation, _)| rotation.symmetrised(matrix));
        let blocks = match &rotation {
            Some((rotation, _)) => (0..=rotation.valence / 2)
                .map(|k| block(&matrix, rotation, k))
                .collect(),
            None => vec![Block::Real(matrix.clone())],
        };
        let sums = (0..rows).map(|row| matrix.row(row).iter().sum::<f64>());
        let defect = sums.fold(0.0_f64, |worst, sum| worst.max((sum - 1.0).abs()));
        let mut given = Given {
            name: name.into(),
            matrix,
            rotation,
            blocks,
            spectrum: Spectrum {
                eigenvalues: Vec::new(),
            },
            defect,
            around: None,
        };
        given.spectrum = Spectrum::of_blocks(&given.blocks, given.order(), given.rounding())?;
        Ok(given)
    }

    /// How well the entries are known relative to the largest, as far as the rotation and the row sums tell:
    /// printed weights have few digits. Row sums that are no matter of rounding tell nothing.
    pub fn rounding(&self) -> f64 {
        let distance = self.rotation.as_ref().map_or(0.0, |(_, distance)| *distance);
        let defect = if self.defect <= ONE { self.defect } else { 0.0 };
        distance.max(defect)
    }

    /// The order of the rotation.
    fn order(&self) -> Option<usize> {
        self.rotation.as_ref().map(|(rotation, _)| rotation.valence)
    }

    /// As it was given, or its mean over the rotation that was found.
    pub fn matrix(&self) -> &Matrix<f64> {
        &self.matrix
    }

    /// Whether the subdominant eigenvalue is not real, so that there is no characteristic map.
    pub fn has_complex_lambda(&self) -> bool {
        self.spectrum.subdominant().is_some_and(|lambda| lambda.value.im != 0.0)
    }

    /// The rotation that was found.
    pub fn rotation(&self) -> Option<&Rotation> {
        self.rotation.as_ref().map(|(rotation, _)| rotation)
    }

    /// A warning if rows do not sum to 1.
    pub fn warning(&self) -> Option<String> {
        (self.defect > AFFINE).then(|| {
            format!(
                "the rows of the matrix do not sum to 1: the largest defect is {:e}",
                self.defect
            )
        })
    }

    /// What was found, and what the list of eigenvalues does not say by itself.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = match (&self.rotation, &self.around) {
            (_, Some(around)) => around.notes(),
            (Some((rotation, _)), _) => vec![format!("found {}", rotation.words())],
            (None, None) => vec![
                "no rotation was found: the eigenvalues are those of the whole matrix, without Fourier indices"
                    .to_owned(),
            ],
        };
        if let Some((_, distance)) = &self.rotation
            && *distance > 0.0
        {
            notes.push(format!(
                "entries that correspond differ by up to {distance:.1e} of the largest: their means were taken"
            ));
        }
        if let Some(lambda) = self.spectrum.subdominant() {
            if self.has_complex_lambda() {
                let Complex { re, im } = lambda.value;
                notes.push(format!(
                    "the subdominant eigenvalues are complex, {} +- {} i: their modulus is listed",
                    short(re),
                    short(im.abs())
                ));
            }
            if self
                .spectrum
                .eigenvalues
                .iter()
                .any(|e| e.is_close(lambda) && e.is_defective())
            {
                notes.push(format!(
                    "the subdominant eigenvalue {} is defective",
                    short(lambda.modulus())
                ));
            }
        }
        notes
    }

    /// The eigenvalues, by falling modulus.
    pub fn eigenvalues(&self) -> Table {
        let mut table = Table::new(["re", "im", "fourier", "multiplicity", "geometric", "jordan"]);
        for e in &self.spectrum.eigenvalues {
            let sizes = e.is_defective().then(|| self.sizes(e)).flatten();
            let sizes = sizes.map(|sizes| sizes.iter().map(usize::to_string).collect::<Vec<_>>().join("+"));
            table.push(vec![
                e.value.re.into(),
                e.value.im.into(),
                e.fourier.into(),
                e.multiplicity.into(),
                e.geometric.into(),
                sizes.into(),
            ]);
        }
        table
    }

    /// The sizes of an eigenvalue's Jordan blocks in its block.
    fn sizes(&self, eigenvalue: &Eigenvalue) -> Option<Vec<usize>> {
        let (block, value) = self.place(eigenvalue);
        self.blocks[block].jordan_sizes(value).ok()
    }

    /// The block of an eigenvalue, and what the eigenvalue is there: block N-k is the conjugate of block k.
    fn place(&self, eigenvalue: &Eigenvalue) -> (usize, Complex<f64>) {
        match eigenvalue.fourier.unwrap_or(0) {
            k if k < self.blocks.len() => (k, eigenvalue.value),
            k => (self.valence() - k, eigenvalue.value.conj()),
        }
    }

    fn valence(&self) -> usize {
        self.order().unwrap_or(1)
    }

    fn head(&self) -> Record {
        let (spectrum, around) = (&self.spectrum, self.around.as_ref());
        let signed = |e: &Eigenvalue| if e.value.im == 0.0 { e.value.re } else { e.modulus() };
        Record::default()
            .with("scheme", self.name.as_str())
            .with("corner", around.map_or("closed", |around| around.corner.as_str()))
            .with("valence", around.map_or(self.order(), |around| Some(around.faces)))
            .with("lattice", around.map_or(Cell::Empty, |_| "face".into()))
            .with("rings", around.map(|around| around.rings))
            .with("level", around.map(|around| around.level[0]))
            .with("closed_rings", around.map(|around| around.closed_rings))
            .with("outer", around.map(|around| around.outer))
            .with("points", self.matrix.rows())
            .with("subdominant", spectrum.subdominant().map(signed))
            .with("subsubdominant", spectrum.subsubdominant().map(signed))
            .with("s", spectrum.curvature_ratio())
    }

    /// Everything as a JSON object.
    pub fn json(&self) -> Map<String, Value> {
        let mut object = self.head().json();
        object.insert("eigenvalues".to_owned(), self.eigenvalues().json());
        let (position, tangents) = (self.position(), self.tangents());
        let missing: Vec<&String> = [position.as_ref().err(), tangents.as_ref().err()]
            .into_iter()
            .flatten()
            .collect();
        object.insert(
            "limit_stencils".to_owned(),
            json!({
                "points": self.points().json(),
                "position": position.as_ref().ok(),
                "tangent_x": tangents.as_ref().ok().map(|t| &t[0]),
                "tangent_y": tangents.as_ref().ok().map(|t| &t[1]),
                "missing": missing,
            }),
        );
        object.insert("notes".to_owned(), json!(self.notes()));
        if self.rotation.is_none() {
            // for each eigenvalue its vectors, and of each the value at each point as [re, im]
            let vectors = |left: bool| -> Vec<Vec<Vec<[f64; 2]>>> {
                let pairs = |vector: Vec<Complex<f64>>| vector.into_iter().map(|entry| [entry.re, entry.im]).collect();
                let all = self.spectrum.eigenvalues.iter().map(|e| self.vectors(e, left));
                all.map(|list| list.into_iter().map(pairs).collect()).collect()
            };
            let chains: Vec<Option<Vec<usize>>> = self.spectrum.eigenvalues.iter().map(|e| self.sizes(e)).collect();
            object.insert("right".to_owned(), json!(vectors(false)));
            object.insert("left".to_owned(), json!(vectors(true)));
            object.insert("chains".to_owned(), json!(chains));
        }
        object
    }

    /// Right or left eigenvectors of an eigenvalue of the whole matrix, of unit length.
    fn vectors(&self, eigenvalue: &Eigenvalue, left: bool) -> Vec<Vec<Complex<f64>>> {
        match self.blocks[0].eigenspace(eigenvalue.value, 0) {
            Ok(space) => {
                if left {
                    space.left
                } else {
                    space.right
                }
            }
            Err(_) => Vec::new(),
        }
    }

    /// The limit stencils, as weights of all points; empty where one is not defined.
    pub fn limit_stencils(&self) -> Table {
        let (position, tangents) = (self.position(), self.tangents());
        let mut table = self.points();
        table.extend("position", |index| position.as_ref().ok().map(|p| p[index]).into());
        for (which, name) in ["tangent_x", "tangent_y"].into_iter().enumerate() {
            table.extend(name, |index| tangents.as_ref().ok().map(|t| t[which][index]).into());
        }
        table
    }

    /// Everything for people.
    pub fn text(&self) -> String {
        let (position, tangents) = (self.position(), self.tangents());
        let mut text = format!(
            "{}{}\n{}\nlimit stencils ({})\n{}",
            self.head().text(),
            self.notes()
                .iter()
                .map(|text| format!("note: {text}\n"))
                .collect::<String>(),
            self.eigenvalues().render(Format::Text),
            match self.around {
                Some(_) => "x along spoke i and y along spoke i+1 in half steps; 0 on the rims",
                None => "points counted from 0, as in the file",
            },
            self.limit_stencils().render(Format::Text)
        );
        for error in [position.err(), tangents.err()].into_iter().flatten() {
            text.push_str(&format!("not defined: {error}\n"));
        }
        text
    }

    /// Where each point is: its sector and orbit, none for fixed points.
    fn points(&self) -> Table {
        if let Some(around) = &self.around {
            return around.points();
        }
        let mut places: Vec<Option<(usize, usize)>> = vec![None; self.matrix.rows()];
        if let Some((rotation, _)) = &self.rotation {
            for (index, orbit) in rotation.orbits.iter().enumerate() {
                orbit
                    .iter()
                    .enumerate()
                    .for_each(|(s, &point)| places[point] = Some((s, index)));
            }
        }
        let mut table = Table::new(["point", "sector", "orbit"]);
        for (index, place) in places.into_iter().enumerate() {
            table.push(vec![index.into(), place.map(|p| p.0).into(), place.map(|p| p.1).into()]);
        }
        table
    }

    /// A left eigenvector of block k in the whole matrix.
    fn spread(&self, k: usize, left: &[Complex<f64>]) -> Vec<Complex<f64>> {
        let Some((rotation, _)) = &self.rotation else {
            return left.to_vec();
        };
        let (n, fixed) = (rotation.valence, if k == 0 { rotation.fixed.as_slice() } else { &[] });
        let mut weights = vec![Complex::zero(); self.matrix.rows()];
        fixed
            .iter()
            .zip(left)
            .for_each(|(&point, &weight)| weights[point] = weight);
        for (orbit, &weight) in rotation.orbits.iter().zip(&left[fixed.len()..]) {
            for (s, &point) in orbit.iter().enumerate() {
                let turned = weight * Complex::turn(-((k * s) as i64), n as i64);
                weights[point] = turned.map(|part| part / n as f64);
            }
        }
        weights
    }

    /// The weights of the limit position: the left eigenvector of 1, sum 1.
    fn position(&self) -> Weights<Vec<f64>> {
        let one = |e: &&Eigenvalue| e.fourier.unwrap_or(0) == 0 && (e.value - Complex::one()).modulus() <= ONE;
        let found = self.spectrum.eigenvalues.iter().find(one);
        let found = found.ok_or("1 is no eigenvalue of nets that are alike in all sectors")?;
        let space = self.blocks[0]
            .eigenspace(found.value, 0)
            .map_err(|error| error.to_string())?;
        let [left] = space.left.as_slice() else {
            return Err(format!("1 has {} eigenvectors, not 1", space.left.len()));
        };
        let weights = self.spread(0, left);
        let sum = weights.iter().fold(Complex::zero(), |sum, &w| sum + w);
        Ok(weights.iter().map(|&weight| (weight / sum).re).collect())
    }

    /// The weights of the two limit tangents: dual to the real and imaginary part of the mode of block 1,
    /// which is 1 at the first point of the first orbit where it does not vanish; without such a block, to
    /// the eigenvectors of the pair after 1.
    fn tangents(&self) -> Weights<[Vec<f64>; 2]> {
        if self.valence() < 3 {
            return self.pair();
        }
        let of_block = |e: &&Eigenvalue| e.fourier == Some(1);
        let lambda = self
            .spectrum
            .eigenvalues
            .iter()
            .find(of_block)
            .ok_or("block 1 has no eigenvalue")?;
        let space = self.blocks[1]
            .eigenspace(lambda.value, 1)
            .map_err(|error| error.to_string())?;
        let ([right], [left]) = (space.right.as_slice(), space.left.as_slice()) else {
            return Err(format!(
                "{} has {} eigenvectors in block 1, not 1",
                short(lambda.modulus()),
                space.right.len()
            ));
        };
        let largest = right.iter().map(|v| v.modulus()).fold(0.0, f64::max);
        let pivot = right
            .iter()
            .find(|v| v.modulus() > REAL * largest)
            .copied()
            .unwrap_or(Complex::one());
        let product = left
            .iter()
            .zip(right)
            .fold(Complex::zero(), |sum, (&l, &r)| sum + l * r);
        if product.modulus() <= REAL * largest {
            return Err(format!("{} is defective", short(lambda.modulus())));
        }
        // the mode is divided by its pivot, its functional multiplied by it
        let scale = pivot / product;
        let weights = self.spread(1, left);
        let scaled = |&weight: &Complex<f64>| weight * scale;
        Ok([
            weights.iter().map(|w| 2.0 * scaled(w).re).collect(),
            weights.iter().map(|w| -2.0 * scaled(w).im).collect(),
        ])
    }

    /// Functionals of the pair of eigenvalues after the dominant one, in the whole matrix.
    fn pair(&self) -> Weights<[Vec<f64>; 2]> {
        let whole = Block::Real(self.matrix.clone());
        let none = || "the eigenvalues after 1 are no real pair with two eigenvectors".to_owned();
        let mut functionals: Vec<Vec<f64>> = Vec::new();
        let mut multiplicity = 0;
        for e in self.spectrum.eigenvalues.iter().skip(1) {
            // a value that two blocks have brings the vectors of both
            if functionals.len() >= 2 {
                break;
            }
            multiplicity += e.multiplicity;
            if e.value.im != 0.0 || multiplicity > 2 {
                return Err(none());
            }
            let space = whole.eigenspace(e.value, 0).map_err(|error| error.to_string())?;
            functionals.extend(
                space
                    .left
                    .iter()
                    .map(|left| left.iter().map(|weight| weight.re).collect::<Vec<f64>>()),
            );
        }
        functionals.try_into().map_err(|_| none())
    }
}

fn block(matrix: &Matrix<f64>, rotation: &Rotation, k: usize) -> Block<f64> {
    let n = rotation.valence;
    let fixed: Vec<Vec<usize>> = match k {
        0 => rotation.fixed.iter().map(|&point| vec![point]).collect(),
        _ => Vec::new(),
    };
    let points: Vec<&Vec<usize>> = fixed.iter().chain(&rotation.orbits).collect();
    let entry = |i: usize, j: usize| {
        points[j].iter().enumerate().fold(Complex::zero(), |sum, (s, &column)| {
            sum + Complex::turn((k * s) as i64, n as i64).scale(matrix[(points[i][0], column)])
        })
    };
    if k == 0 || 2 * k == n {
        return Block::Real(Matrix::from_fn(points.len(), points.len(), |i, j| entry(i, j).re));
    }
    Block::Complex(Matrix::from_fn(points.len(), points.len(), entry))
}
