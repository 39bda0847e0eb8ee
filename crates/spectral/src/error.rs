//! What can go wrong in an analysis.

/// Why an analysis is refused or failed. Variants carry the offending numbers.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The scheme's rules cannot be run on this net.
    #[error(transparent)]
    Scheme(#[from] eigenring_scheme::Error),
    /// Polynomial patches exist where the regular rules refine uniform B-splines.
    #[error("the regular rules are not those of a uniform B-spline of any degree: there are no patches to look at")]
    NotSpline,
    /// There is no pair of eigenvalues whose eigenvectors span the tangent plane.
    #[error(
        "the eigenvalue {value}, {multiplicity}-fold, is not one of a real pair with two eigenvectors that leads all further ones"
    )]
    Pair {
        /// Its modulus.
        value: f64,
        /// Its multiplicity.
        multiplicity: usize,
    },
    /// The eigenvalue after 1 is of another block than that of the tangent plane.
    #[error("the subdominant eigenvalue {value} is of Fourier index {fourier}, not 1: there is no tangent plane")]
    Stray {
        /// Its modulus.
        value: f64,
        /// Its block.
        fourier: usize,
    },
    /// Fourier blocks exist for rotation-symmetric rules only.
    #[error("the rules differ from sector to sector: there are no Fourier blocks")]
    NotSymmetric,
    /// The iteration for eigenvalues or singular values did not converge, or an entry was not finite.
    #[error("no decomposition of the {size} x {size} matrix was found: its largest entry is {largest}")]
    Decomposition {
        /// The size of the matrix.
        size: usize,
        /// Its largest entry in modulus; NaN if one is.
        largest: f64,
    },
    /// Stam's basis is made of bicubic patches.
    #[error(
        "Stam's basis is of bicubic patches around a vertex, with the same rules on all levels and no special rules beyond \
         its edge and face points: this surface is another"
    )]
    NotBicubic,
    /// Stam's basis has real eigenvalues.
    #[error("the eigenvalue {re} {im:+} i is complex: there is no basis of real eigenvectors")]
    NotReal {
        /// Its real part.
        re: f64,
        /// Its imaginary part.
        im: f64,
    },
    /// Stam's basis is one of eigenvectors.
    #[error(
        "the eigenvalue {value}{} is defective, with a Jordan block of size {size}: there is no basis of eigenvectors",
        fourier.map_or(String::new(), |index| format!(" of Fourier block {index}"))
    )]
    JordanBlock {
        /// The eigenvalue.
        value: f64,
        /// Its Fourier block.
        fourier: Option<usize>,
        /// The size.
        size: usize,
    },
    /// Jordan chains are found in extended precision, whose time grows with the cube of the size.
    #[error("a block of {size} unknowns is too large for Jordan chains: at most {most}")]
    Large {
        /// The unknowns.
        size: usize,
        /// How many are accepted.
        most: usize,
    },
    /// A matrix has no eigenvalue near the given one.
    #[error(
        "{value} is not an eigenvalue of Fourier block {fourier}: the smallest singular value of S - {value} is {gap}"
    )]
    NotAnEigenvalue {
        /// The number that was asked about.
        value: f64,
        /// The block.
        fourier: usize,
        /// The distance to singularity.
        gap: f64,
    },
    /// An eigenspace has not the dimension that the question needs.
    #[error("eigenvalue {value} of Fourier block {fourier} has {found} eigenvectors where {expected} is needed")]
    Multiplicity {
        /// The eigenvalue.
        value: f64,
        /// The block.
        fourier: usize,
        /// The dimension of the eigenspace.
        found: usize,
        /// The dimension that is needed.
        expected: usize,
    },
    /// The eigenvalue is defective or so close to another that left and right eigenvectors are orthogonal.
    #[error(
        "eigenvalue {value} of Fourier block {fourier} is defective or nearly so: l.r = {product:.0e} for unit vectors"
    )]
    Defective {
        /// The eigenvalue.
        value: f64,
        /// The block.
        fourier: usize,
        /// The product of unit left and right eigenvectors.
        product: f64,
    },
    /// An eigenvector cannot be scaled as asked since its entry at E_0 is zero.
    #[error("the eigenvector of {value} in Fourier block {fourier} vanishes at the first point of ring 1")]
    Scaling {
        /// The eigenvalue.
        value: f64,
        /// The block.
        fourier: usize,
    },
    /// A matrix file is not square or has no size that fits the valence.
    #[error(
        "a {rows} x {columns} matrix is no local matrix of valence {valence}: accepted are square ones of size 1 + {valence} R (R+1) around a vertex, {valence} (R+1)^2 around a face"
    )]
    MatrixSize {
        /// Its rows.
        rows: usize,
        /// Its columns.
        columns: usize,
        /// The valence.
        valence: usize,
    },
    /// A matrix is not block-circulant.
    #[error(
        "the matrix is not block-circulant for valence {valence}: entry ({row}, {column}) is {value}, but {rotated} one sector further"
    )]
    NotCirculant {
        /// The valence.
        valence: usize,
        /// The row, counted from 0.
        row: usize,
        /// The column, counted from 0.
        column: usize,
        /// The entry.
        value: f64,
        /// The entry that should equal it.
        rotated: f64,
    },
    /// The dominant eigenvalue is not 1, so there is no limit position.
    #[error("the rows of the local matrix do not sum to 1: the largest defect is {defect}")]
    RowSums {
        /// The largest distance of a row sum from 1.
        defect: f64,
    },
}
