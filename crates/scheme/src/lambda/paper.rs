//! The literature's featured lambda values, to compare with.
//!
//! Table 1 of Ma, Wang and Ma, ACM TOG 42(6) 209, 2023, <https://doi.org/10.1145/3618400>, to its printed
//! digits. The rows N = 7, 11, 13 and 18 are not in the text this was taken from.

use super::LambdaKnots;

/// Optimal convergence in analysis, lambda_A* of all valences.
pub const LAMBDA_A: f64 = 0.39;
/// Uniform refined meshes, lambda_M* of all valences.
pub const LAMBDA_M: f64 = 0.5;
/// The empirical start of the recommended region, lambda_r1 of all valences.
pub const LAMBDA_R1: f64 = 0.2;

/// One row of Table 1. The end knots 0.15 and 0.9 are the same in all rows and not listed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperRow {
    /// The valence N.
    pub valence: usize,
    /// Start of the recommended region (empirical).
    pub lambda_r1: f64,
    /// First triple knot.
    pub lambda_b: f64,
    /// Optimal L2 convergence in analysis.
    pub lambda_a_star: f64,
    /// Second triple knot and the smallest lambda with bounded curvature.
    pub lambda_l: f64,
    /// Uniform refined meshes.
    pub lambda_m_star: f64,
    /// Subdominant eigenvalue of Catmull-Clark subdivision.
    pub lambda_cc: f64,
    /// Third triple knot.
    pub lambda_d: f64,
    /// The globally optimal lambda.
    pub lambda_c_star: f64,
    /// End of the recommended region: beyond it 2-ring quadrilaterals of the natural configuration overlap or
    /// are concave.
    pub lambda_r2: f64,
}

impl PaperRow {
    /// The row's knots with the common ends 0.15 and 0.9.
    pub fn knots(&self) -> LambdaKnots {
        LambdaKnots {
            a: 0.15,
            b: self.lambda_b,
            c: self.lambda_l,
            d: self.lambda_d,
            e: 0.9,
            singles: LambdaKnots::SINGLES,
        }
    }
}

const fn row(valence: usize, v: [f64; 6]) -> PaperRow {
    let [lambda_b, lambda_l, lambda_cc, lambda_d, lambda_c_star, lambda_r2] = v;
    PaperRow {
        valence,
        lambda_r1: LAMBDA_R1,
        lambda_b,
        lambda_a_star: LAMBDA_A,
        lambda_l,
        lambda_m_star: LAMBDA_M,
        lambda_cc,
        lambda_d,
        lambda_c_star,
        lambda_r2,
    }
}

/// The table's 14 rows; lambda_r1, lambda_A* and lambda_M* are the same in all.
pub const PAPER_TABLE_1: [PaperRow; 14] = [
    //        b       l       CC      d       C*      r2
    row(3, [0.25, 0.3536, 0.4101, 0.5, 0.4112, 0.5832]),
    row(4, [0.25, 0.3536, 0.5, 0.55, 0.5, 0.7438]),
    row(5, [0.25, 0.3536, 0.55, 0.3973, 0.5599, 0.8017]),
    row(6, [0.25, 0.3536, 0.5797, 0.3973, 0.5935, 0.8625]),
    row(8, [0.301, 0.4142, 0.6111, 0.55, 0.6320, 0.8842]),
    row(9, [0.2564, 0.4976, 0.6199, 0.5540, 0.6455, 0.8887]),
    row(10, [0.2265, 0.5669, 0.6263, 0.6868, 0.6587, 0.8910]),
    row(12, [0.2, 0.6720, 0.6348, 0.7768, 0.6860, 0.8962]),
    row(14, [0.3, 0.7453, 0.64, 0.7948, 0.7138, 0.8992]),
    row(15, [0.3, 0.7735, 0.6418, 0.8064, 0.7268, 0.9]),
    row(16, [0.3, 0.7975, 0.6433, 0.8221, 0.7348, 0.9]),
    row(17, [0.3, 0.8180, 0.6446, 0.8344, 0.7405, 0.9]),
    row(19, [0.3, 0.8510, 0.6466, 0.8647, 0.7510, 0.9]),
    row(20, [0.3, 0.8643, 0.6473, 0.8721, 0.7551, 0.9]),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn catmull_clark_column_is_its_closed_form() {
        // lambda = (c + 5 + sqrt((c + 9)(c + 1)))/16 with c = cos(2 pi/N), printed to four digits
        for row in PAPER_TABLE_1 {
            let c = (std::f64::consts::TAU / row.valence as f64).cos();
            let lambda = (c + 5.0 + ((c + 9.0) * (c + 1.0)).sqrt()) / 16.0;
            assert!((lambda - row.lambda_cc).abs() < 5.1e-5, "N = {}: {lambda}", row.valence);
        }
    }

    #[test]
    fn lambda_l_column_is_equation_23() {
        for row in PAPER_TABLE_1 {
            let c = |k: f64| (k * std::f64::consts::TAU / row.valence as f64).cos();
            let mut lambda = 0.125_f64.sqrt();
            if row.valence >= 5 {
                lambda = lambda
                    .max(c(2.0) / c(1.0))
                    .max((1.0 + c(2.0)) / (1.0 + 2.0 * c(1.0) - c(2.0)));
            }
            assert!((lambda - row.lambda_l).abs() < 5.1e-5, "N = {}: {lambda}", row.valence);
        }
    }
}
