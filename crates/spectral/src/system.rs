//! The local system of a scheme: one matrix, its blocks, its modes.
//!
//! A [`Mode`] is an eigenvector of a Fourier block spread over all sectors, `P_i(x, y) = w^{k i} v(x, y)`,
//! complex for `0 < k < N/2`. Modes of one eigenvalue are given in reduced echelon form: the first point of
//! ring 1 (`E_0`, or the corner of the face) has value 1 in the first mode and 0 in the others, and so on
//! along the numbering, the centre last. The functionals of an eigenspace are the left eigenvectors dual to
//! its modes, `l_i . r_j = delta_ij`.

use crate::echelon::{Dual, PIVOT, dual, length};
use crate::{Block, Eigenvalue, Error, Matrix, Spectrum, fourier_blocks, local_matrix, numbering};
use eigenring_scheme::{Complex, Fan, FourierNet, Lattice, Level, Numbering, Site};

/// The local matrix of a level of refinement, in Fourier blocks if its rules are the same in all sectors.
#[derive(Clone, Debug)]
pub struct LocalSystem {
    numbering: Numbering,
    mirror: bool,
    blocks: Vec<Block<f64>>,
    row_sum_defect: f64,
}

/// An eigenvector over all sectors.
#[derive(Clone, Debug)]
pub struct Mode {
    /// The eigenvalue.
    pub value: Complex<f64>,
    /// The Fourier index; `None` for a system without rotation symmetry.
    pub fourier: Option<usize>,
    /// The values at the points of the numbering.
    pub values: Vec<Complex<f64>>,
    /// The dual left eigenvector: weights of the points, in the same order.
    pub functional: Vec<Complex<f64>>,
    /// `|l . r|` for vectors of unit length in the unknowns of the block, between 0 and 1: the reciprocal
    /// condition number of the eigenvalue. Perturbing the matrix by `eps` moves the eigenvalue by up to `eps`
    /// over this, and near a resonance it falls with the distance of the two eigenvalues.
    pub product: f64,
}

/// Rows of a local matrix of affine rules sum to 1 up to this: N + 1 roundings of weights below 1, with room
/// to spare.
const ROW_SUM: f64 = 1e-9;

impl LocalSystem {
    /// The system of `level` on `rings` rings.
    ///
    /// # Errors
    /// [`Error::Scheme`] if these rings are not closed under refinement.
    pub fn new(level: &Level<f64>, rings: usize) -> Result<Self, Error> {
        let numbering = numbering(level, rings);
        if !level.is_rotation_symmetric() {
            let matrix = local_matrix(level, rings)?;
            let row_sum_defect = defect(&matrix);
            return Ok(LocalSystem {
                numbering,
                mirror: false,
                blocks: vec![Block::Real(matrix)],
                row_sum_defect,
            });
        }
        let blocks = fourier_blocks(level, rings)?;
        // a constant net has p = 1 and q = 0 in the unknowns of block 0, and so must have its image
        let net = FourierNet::<f64>::new(numbering, 0, level.has_mirror())?;
        let constant: Vec<f64> = net
            .rows()
            .iter()
            .map(|site| f64::from(!level.has_mirror() || site.x >= site.y))
            .collect();
        let row_sum_defect = defect_at(&blocks[0].to_complex(), &constant);
        Ok(LocalSystem {
            numbering,
            mirror: level.has_mirror(),
            blocks,
            row_sum_defect,
        })
    }

    /// The system of a given local matrix, which must be block-circulant in the order of the [`Numbering`].
    /// The number of rings and the kind of net follow from the size and the valence.
    ///
    /// # Errors
    /// [`Error::MatrixSize`] or [`Error::NotCirculant`] (entries of corresponding places differ by more than
    /// `tolerance` times the largest entry), [`Error::Scheme`] for a valence below 3,
    /// [`Error::Decomposition`] if an entry is not finite.
    pub fn from_matrix(matrix: &Matrix<f64>, valence: usize, tolerance: f64) -> Result<Self, Error> {
        if valence < 3 {
            return Err(eigenring_scheme::Error::Valence { valence }.into());
        }
        let (rows, columns) = (matrix.rows(), matrix.columns());
        let mut candidates = [Lattice::Vertex, Lattice::Face].into_iter().flat_map(|lattice| {
            let numbering = move |rings| Numbering {
                fan: Fan::Closed(valence),
                lattice,
                rings,
            };
            (0..).map(numbering).take_while(move |n| n.count() <= rows)
        });
        // the centre alone is no net
        let fits = candidates.find(|n| n.count() == rows && n.sector_points() > 0);
        let numbering = match fits {
            Some(numbering) if rows == columns => numbering,
            _ => return Err(Error::MatrixSize { rows, columns, valence }),
        };
        let largest = matrix.entries().iter().fold(0.0_f64, |max, &entry| {
            if entry.is_finite() {
                max.max(entry.abs())
            } else {
                f64::NAN
            }
        });
        if matrix.entries().iter().any(|entry| !entry.is_finite()) {
            return Err(Error::Decomposition {
                size: rows,
                largest: f64::NAN,
            });
        }
        let sites = numbering.sites();
        let index = |site: Site| numbering.index(site).expect("rotation keeps a site on the net");
        let next: Vec<usize> = sites.iter().map(|site| index(site.rotated(numbering.fan, 1))).collect();
        for row in 0..rows {
            for column in 0..columns {
                let (value, rotated) = (matrix[(row, column)], matrix[(next[row], next[column])]);
                if (value - rotated).abs() > tolerance * largest {
                    return Err(Error::NotCirculant {
                        valence,
                        row,
                        column,
                        value,
                        rotated,
                    });
                }
            }
        }
        let blocks = (0..=valence / 2)
            .map(|k| {
                let net = FourierNet::<f64>::new(numbering, k, false)?;
                let points = net.rows();
                Ok(Block::Complex(Matrix::from_fn(
                    points.len(),
                    points.len(),
                    |row, column| {
                        let target = index(points[row]);
                        if points[column] == Site::CENTRE {
                            return Complex::real(matrix[(target, 0)]);
                        }
                        (0..valence).fold(Complex::zero(), |sum, j| {
                            let entry = matrix[(target, index(points[column].rotated(numbering.fan, j as i64)))];
                            sum + Complex::turn((k * j) as i64, valence as i64).scale(entry)
                        })
                    },
                )))
            })
            .collect::<Result<Vec<_>, Error>>()?;
        Ok(LocalSystem {
            numbering,
            mirror: false,
            blocks,
            row_sum_defect: defect(matrix),
        })
    }

    /// The points, in the order of rows and columns.
    pub fn numbering(&self) -> Numbering {
        self.numbering
    }

    /// The number of sectors.
    pub fn valence(&self) -> usize {
        self.numbering.fan.sectors()
    }

    /// Whether there are Fourier blocks.
    pub fn symmetric(&self) -> bool {
        self.blocks.len() > 1
    }

    /// The blocks of index 0 to N/2, or the one dense matrix.
    pub fn blocks(&self) -> &[Block<f64>] {
        &self.blocks
    }

    /// Whether the unknowns of the blocks are those of rules with mirror symmetry.
    pub(crate) fn has_mirror(&self) -> bool {
        self.mirror
    }

    /// The largest distance of a row sum of the local matrix from 1.
    pub fn row_sum_defect(&self) -> f64 {
        self.row_sum_defect
    }

    /// The modes of an eigenvalue of the block of index `fourier` (any index below N; 0 for a dense system).
    ///
    /// # Errors
    /// Those of [`Block::eigenspace`]; [`Error::Defective`] if there are no dual functionals.
    pub fn modes(&self, fourier: usize, value: Complex<f64>) -> Result<Vec<Mode>, Error> {
        let n = self.valence();
        if !self.symmetric() {
            let Dual { right, left, .. } = self.dual(0, value, 0)?;
            let modes = right.into_iter().zip(left).map(|(values, functional)| Mode {
                value,
                fourier: None,
                // l . r = 1
                product: 1.0 / (length(&values) * length(&functional)),
                values,
                functional,
            });
            return Ok(modes.collect());
        }
        if fourier >= n {
            return Err(eigenring_scheme::Error::FourierIndex {
                index: fourier,
                valence: n,
            }
            .into());
        }
        if fourier > n / 2 {
            // block N-k is the conjugate of block k
            let mut modes = self.modes(n - fourier, value.conj())?;
            for mode in &mut modes {
                mode.fourier = Some(fourier);
                mode.value = value;
                mode.values.iter_mut().for_each(|v| *v = v.conj());
                mode.functional.iter_mut().for_each(|v| *v = v.conj());
            }
            return Ok(modes);
        }
        let net = FourierNet::<f64>::new(self.numbering, fourier, self.mirror)?;
        // the centre, first in the block, comes last in the echelon form
        let centre = usize::from(net.rows().first() == Some(&Site::CENTRE));
        let Dual { right, left, pivots } = self.dual(fourier, value, centre)?;
        let (rows, sites) = (net.rows(), self.numbering.sites());
        let mut modes = Vec::with_capacity(right.len());
        for ((unknowns, coefficients), pivot) in right.iter().zip(&left).zip(pivots) {
            // the unknowns of points off the spokes carry a phase: turn the mode so that the value at the
            // pivot is 1
            let at_pivot = net.mode(unknowns, rows[pivot])?;
            let turned = at_pivot.modulus() > PIVOT;
            let (forth, back) = if turned {
                (at_pivot.recip(), at_pivot)
            } else {
                (Complex::one(), Complex::one())
            };
            let value_at = |&site: &Site| Ok(net.mode(unknowns, site)? * forth);
            let weight_at = |&site: &Site| Ok(net.functional(coefficients, site)? * back);
            modes.push(Mode {
                value,
                fourier: Some(fourier),
                values: sites.iter().map(value_at).collect::<Result<_, Error>>()?,
                functional: sites.iter().map(weight_at).collect::<Result<_, Error>>()?,
                product: 1.0 / (length(unknowns) * length(coefficients)),
            });
        }
        Ok(modes)
    }

    /// Dual bases of an eigenspace, in the unknowns of a block whose first `centre` points come last in the
    /// echelon form.
    fn dual(&self, index: usize, value: Complex<f64>, centre: usize) -> Result<Dual, Error> {
        let block = &self.blocks[index];
        let core = block.core_for(value);
        let inner = core.as_ref().unwrap_or(block);
        let size = inner.size();
        let mut found = dual(&inner.eigenspace(value, index)?, index, |i| (i + centre) % size)?;
        found.right.iter_mut().for_each(|vector| block.extend(vector, value));
        let zeros = |vector: &mut Vec<_>| vector.resize(block.size(), Complex::zero());
        found.left.iter_mut().for_each(zeros);
        Ok(found)
    }

    /// The weights of the points in the limit position of the centre: the left eigenvector of the eigenvalue
    /// 1, sum 1.
    ///
    /// # Errors
    /// [`Error::RowSums`] unless rows sum to 1, [`Error::Multiplicity`] unless 1 is a simple eigenvalue.
    pub fn limit_position(&self) -> Result<Vec<f64>, Error> {
        if !(self.row_sum_defect <= ROW_SUM) {
            return Err(Error::RowSums {
                defect: self.row_sum_defect,
            });
        }
        let modes = self.modes(0, Complex::one())?;
        let [mode] = modes.as_slice() else {
            return Err(Error::Multiplicity {
                value: 1.0,
                fourier: 0,
                found: modes.len(),
                expected: 1,
            });
        };
        // the mode is constant: its values are 1 by the scaling of the echelon form
        Ok(mode.functional.iter().map(|w| w.re).collect())
    }

    /// The weights of the points in the two limit tangents: the left eigenvectors of the subdominant
    /// eigenvalue `lambda` dual to its real eigenvectors x and y, the coordinates of the natural
    /// configuration (`E_0 = (1, 0)`).
    ///
    /// # Errors
    /// [`Error::Multiplicity`] unless the eigenspace in block 1 has dimension one.
    pub fn limit_tangents(&self, lambda: f64) -> Result<[Vec<f64>; 2], Error> {
        self.complex_tangents(Complex::real(lambda))
    }

    /// The same for a simple eigenvalue of block 1 that may be complex: without mirror symmetry, blocks 1 and
    /// N-1 have conjugates, and the tangent plane is that of the real and imaginary part of the left vector.
    ///
    /// # Errors
    /// As [`LocalSystem::limit_tangents`].
    pub fn complex_tangents(&self, lambda: Complex<f64>) -> Result<[Vec<f64>; 2], Error> {
        let modes = self.modes(1, lambda)?;
        let [mode] = modes.as_slice() else {
            return Err(Error::Multiplicity {
                value: lambda.modulus(),
                fourier: 1,
                found: modes.len(),
                expected: 1,
            });
        };
        Ok([
            mode.functional.iter().map(|w| 2.0 * w.re).collect(),
            mode.functional.iter().map(|w| -2.0 * w.im).collect(),
        ])
    }

    /// The functionals of the pair of eigenvalues after the dominant one, of a system without Fourier blocks:
    /// left eigenvectors dual to the right ones of a double eigenvalue, or of two different real ones, the
    /// larger first. Each is scaled so that its right eigenvector has the value 1 at the first point where it
    /// does not vanish.
    ///
    /// # Errors
    /// [`Error::Pair`] unless the two are real, have two eigenvectors and are larger in modulus than all
    /// others.
    pub fn pair_functionals(&self, spectrum: &Spectrum) -> Result<[Vec<f64>; 2], Error> {
        let others = spectrum.eigenvalues.get(1..).unwrap_or_default();
        let refuse = |found: &Eigenvalue| Error::Pair {
            value: found.modulus(),
            multiplicity: found.multiplicity,
        };
        let (values, rest) = match others {
            [double, rest @ ..] if double.multiplicity == 2 && double.geometric == Some(2) => (vec![double], rest),
            [first, second, rest @ ..] if first.multiplicity == 1 && second.multiplicity == 1 => {
                (vec![first, second], rest)
            }
            [first, ..] => return Err(refuse(first)),
            [] => return Err(Error::NotSymmetric),
        };
        let least = values[values.len() - 1];
        if values.iter().any(|e| e.value.im != 0.0) || rest.first().is_some_and(|next| next.is_close(least)) {
            return Err(refuse(least));
        }
        let mut functionals = Vec::new();
        for e in values {
            for mode in self.modes(0, e.value)? {
                functionals.push(mode.functional.iter().map(|weight| weight.re).collect::<Vec<f64>>());
            }
        }
        let pair: Result<[Vec<f64>; 2], _> = functionals.try_into();
        pair.map_err(|_| refuse(least))
    }

    /// The only mode of a real eigenvalue of a block.
    ///
    /// # Errors
    /// [`Error::Multiplicity`] if there are more; those of [`LocalSystem::modes`].
    pub fn single(&self, fourier: usize, value: f64) -> Result<Mode, Error> {
        let mut modes = self.modes(fourier, Complex::real(value))?;
        match (modes.pop(), modes.len()) {
            (Some(mode), 0) => Ok(mode),
            (_, others) => Err(Error::Multiplicity {
                value,
                fourier,
                found: others + 1,
                expected: 1,
            }),
        }
    }
}

fn defect(matrix: &Matrix<f64>) -> f64 {
    defect_at(&matrix.map(Complex::real), &vec![1.0; matrix.columns()])
}

/// The largest entry of `S c - c`.
fn defect_at(matrix: &Matrix<Complex<f64>>, constant: &[f64]) -> f64 {
    let image = |row: usize| {
        let sum = matrix.row(row).iter().zip(constant);
        sum.fold(Complex::zero(), |sum, (m, &c)| sum + m.scale(c))
    };
    (0..matrix.rows())
        .map(|row| (image(row) - Complex::real(constant[row])).modulus())
        // a NaN must not be lost, as f64::max would
        .fold(
            0.0,
            |max, defect| if defect > max || defect.is_nan() { defect } else { max },
        )
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::families::{catmull_clark, doo_sabin, tension};
    use eigenring_scheme::{DenseNet, Scheme, refine};

    fn dense(scheme: &Scheme<f64>, rings: usize) -> Matrix<f64> {
        let numbering = scheme.numbering(rings);
        let rows = refine(scheme.limit(), &DenseNet { numbering }, &numbering.sites()).unwrap();
        Matrix::from_rows(rows, numbering.count())
    }

    /// `M r = value r`, `l M = value l` and `l . r = 1` on the dense matrix.
    fn check(matrix: &Matrix<f64>, mode: &Mode) {
        let size = matrix.rows();
        let largest = |v: &[Complex<f64>]| v.iter().map(|x| x.modulus()).fold(1.0, f64::max);
        let scales = [largest(&mode.values), largest(&mode.functional)];
        for i in 0..size {
            let (mut image, mut co_image) = (Complex::zero(), Complex::zero());
            for j in 0..size {
                image += mode.values[j].scale(matrix[(i, j)]);
                co_image += mode.functional[j].scale(matrix[(j, i)]);
            }
            let pairs = [(image, mode.values[i]), (co_image, mode.functional[i])];
            for ((image, vector), scale) in pairs.into_iter().zip(scales) {
                let error = (image - mode.value * vector).modulus();
                assert!(error < 1e-11 * scale, "{error} {mode:?}");
            }
        }
        let product = mode
            .values
            .iter()
            .zip(&mode.functional)
            .fold(Complex::zero(), |sum, (&r, &l)| sum + l * r);
        assert!((product - Complex::one()).modulus() < 1e-11 * scales[0] * scales[1]);
    }

    #[test]
    fn modes_are_eigenvectors_of_the_dense_matrix() {
        for valence in [3, 4, 5, 6, 9] {
            for scheme in [
                catmull_clark::<f64>(valence).unwrap(),
                doo_sabin(valence).unwrap(),
                tension(valence, 6, 1.0).unwrap(),
                tension(valence, 5, 1.0).unwrap(),
            ] {
                // around a face one ring more would repeat eigenvalues of the inner rings: see the next test
                let more = usize::from(scheme.lattice() == Lattice::Vertex);
                let rings = scheme.closed_rings().unwrap() + more;
                let system = LocalSystem::new(scheme.limit(), rings).unwrap();
                let matrix = dense(&scheme, rings);
                assert!(system.row_sum_defect() < 1e-15);
                for k in 0..valence {
                    let block = &system.blocks()[k.min(valence - k)];
                    // the two leading eigenvalues of each block
                    for eigenvalue in block.eigenvalues().unwrap().iter().take(2) {
                        for mode in system.modes(k, eigenvalue.value).unwrap() {
                            check(&matrix, &mode);
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn a_resonance_with_the_outer_ring_is_reported_as_defective() {
        // Doo-Sabin's 1/4 of block 2 is also the outer ring's largest eigenvalue; the ring is coupled to the
        // corners
        let scheme = doo_sabin::<f64>(5).unwrap();
        let system = LocalSystem::new(scheme.limit(), 1).unwrap();
        let eigenvalues = system.blocks()[2].eigenvalues().unwrap();
        assert!((eigenvalues[0].value.re - 0.25).abs() < 1e-14 && eigenvalues[0].multiplicity == 2);
        assert!(matches!(
            system.modes(2, eigenvalues[0].value),
            Err(Error::Defective { .. })
        ));
        // tension order 3 at valence 3 has it in block 1: lambda = 1/4 is a Jordan block of size 2
        let scheme = tension::<f64>(3, 3, 1.0).unwrap();
        let system = LocalSystem::new(scheme.limit(), 1).unwrap();
        let eigenvalues = system.blocks()[1].eigenvalues().unwrap();
        assert!((eigenvalues[0].value.re - 0.25).abs() < 1e-14 && eigenvalues[0].multiplicity == 2);
        assert!(matches!(
            system.modes(1, eigenvalues[0].value),
            Err(Error::Defective { .. })
        ));
    }

    #[test]
    fn near_resonance_shows_in_the_product_of_left_and_right() {
        use eigenring_scheme::lambda::Plane;
        // mu = 1/8 + gap meets the outer rings' 1/8: vectors stay eigenvectors, and l . r falls with the gap
        let lambda: f64 = 0.3;
        let product = |gap: f64| {
            let plane = Plane::new(6, lambda, (0.125 + gap) / (lambda * lambda)).unwrap();
            let scheme = plane.stencil(0.16, 0.05).weights.scheme("lambda", 6).unwrap();
            let system = LocalSystem::new(scheme.limit(), 5).unwrap();
            let mode = system.single(2, plane.mu()).unwrap();
            check(&dense(&scheme, 5), &mode);
            mode.product
        };
        let products = [1e-2, 1e-4, 1e-6].map(product);
        for pair in products.windows(2) {
            let ratio = pair[0] / pair[1];
            assert!((50.0..200.0).contains(&ratio), "{products:?}");
        }
        // at the resonance itself the eigenvalue is defective
        let plane = Plane::new(6, lambda, 0.125 / (lambda * lambda)).unwrap();
        let scheme = plane.stencil(0.16, 0.05).weights.scheme("lambda", 6).unwrap();
        let system = LocalSystem::new(scheme.limit(), 5).unwrap();
        assert!(matches!(system.single(2, plane.mu()), Err(Error::Defective { .. })));
    }

    #[test]
    fn limit_position_of_catmull_clark() {
        // N^2 : 4 : 1 over N (N+5) (Halstead, Kass and DeRose 1993)
        for valence in 3..=20 {
            let scheme = catmull_clark::<f64>(valence).unwrap();
            let weights = LocalSystem::new(scheme.limit(), 1).unwrap().limit_position().unwrap();
            let n = valence as f64;
            let numbering = scheme.numbering(1);
            for (site, weight) in numbering.sites().into_iter().zip(weights) {
                let expected = match (site.x, site.y) {
                    (0, 0) => n * n,
                    (2, 0) => 4.0,
                    _ => 1.0,
                } / (n * (n + 5.0));
                assert!(
                    (weight - expected).abs() < 1e-14,
                    "{valence} {site:?}: {weight} {expected}"
                );
            }
        }
    }

    #[test]
    fn limit_tangents_are_dual_to_the_natural_configuration() {
        for valence in [3, 4, 5, 8] {
            let scheme = catmull_clark::<f64>(valence).unwrap();
            let system = LocalSystem::new(scheme.limit(), 2).unwrap();
            let lambda = system.blocks()[1].eigenvalues().unwrap()[0].value.re;
            let mode = system.single(1, lambda).unwrap();
            let tangents = system.limit_tangents(lambda).unwrap();
            let coordinates = [|v: &Complex<f64>| v.re, |v: &Complex<f64>| v.im];
            for (i, tangent) in tangents.iter().enumerate() {
                assert!(tangent.iter().sum::<f64>().abs() < 1e-13);
                for (j, coordinate) in coordinates.iter().enumerate() {
                    let product: f64 = tangent.iter().zip(&mode.values).map(|(t, v)| t * coordinate(v)).sum();
                    assert!((product - f64::from(u8::from(i == j))).abs() < 1e-13);
                }
            }
            let first = system.numbering().index(Site { sector: 0, x: 2, y: 0 }).unwrap();
            assert!((mode.values[first] - Complex::one()).modulus() < 1e-14);
        }
    }

    #[test]
    fn an_imported_matrix_gives_the_same_blocks() {
        for scheme in [catmull_clark::<f64>(5).unwrap(), doo_sabin(6).unwrap()] {
            let rings = scheme.closed_rings().unwrap() + 1;
            let (system, matrix) = (LocalSystem::new(scheme.limit(), rings).unwrap(), dense(&scheme, rings));
            let imported = LocalSystem::from_matrix(&matrix, scheme.valence(), 1e-12).unwrap();
            assert_eq!(imported.numbering(), system.numbering());
            for (a, b) in imported.blocks().iter().zip(system.blocks()) {
                let (a, b) = (a.eigenvalues().unwrap(), b.eigenvalues().unwrap());
                assert!((a[0].value.re - b[0].value.re).abs() < 1e-14);
            }
            let mut spoilt = matrix.clone();
            spoilt = Matrix::from_fn(spoilt.rows(), spoilt.columns(), |i, j| {
                spoilt[(i, j)] + if (i, j) == (2, 3) { 1e-6 } else { 0.0 }
            });
            assert!(matches!(
                LocalSystem::from_matrix(&spoilt, scheme.valence(), 1e-9),
                Err(Error::NotCirculant { .. })
            ));
            assert!(matches!(
                LocalSystem::from_matrix(&matrix, 7, 1e-9),
                Err(Error::MatrixSize { .. } | Error::NotCirculant { .. })
            ));
        }
    }

    #[test]
    fn the_double_mode_of_valence_four_is_split_in_echelon_form() {
        // bicubic B-splines: 1/4 is double in block 2, with an edge mode and a face mode
        let scheme = catmull_clark::<f64>(4).unwrap();
        let system = LocalSystem::new(scheme.limit(), 1).unwrap();
        let modes = system.modes(2, Complex::real(0.25)).unwrap();
        assert_eq!(modes.len(), 2);
        let at = |mode: &Mode, x, y| mode.values[system.numbering().index(Site { sector: 0, x, y }).unwrap()];
        assert!((at(&modes[0], 2, 0).re - 1.0).abs() < 1e-14 && at(&modes[0], 2, 2).re.abs() < 1e-14);
        assert!(at(&modes[1], 2, 0).re.abs() < 1e-14 && (at(&modes[1], 2, 2).re - 1.0).abs() < 1e-14);
    }
}
