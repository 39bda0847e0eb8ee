//! What is known of a scheme with knot intervals around one vertex.
//!
//! Of HNUSS the paper's lemmas are checked in exact arithmetic, for intervals that are taken as the exact
//! numbers that they are. Of the others eigenvalues are computed; whether their characteristic maps are
//! regular is not known.

use crate::error::Error;
use crate::table::{Format, Table, WIDTH, pretty};
use eigenring_certify::Status;
use eigenring_nonuniform::{EigenPolyhedron, FirstLevel, NGon, Scheme, Spokes, lemmas, nurss};
use eigenring_scheme::BigRational;
use eigenring_spectral::{Block, Matrix};
use serde_json::{Value, json};

/// One statement about a scheme and what is known of it.
#[derive(Clone, Debug)]
pub struct Check {
    /// Which statement.
    pub name: &'static str,
    /// How much is known.
    pub status: Status,
    /// How far it is from failing, where that is a number; a lower bound if proven.
    pub margin: Option<f64>,
    /// The quantity that the statement is about, from below and above.
    pub enclosure: Option<[f64; 2]>,
    /// What the answer rests on.
    pub reached: String,
}

/// What must hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Required {
    /// A surface with a continuous normal.
    C1,
    /// And with bounded curvature.
    Bounded,
}

impl Required {
    fn name(self) -> &'static str {
        match self {
            Required::C1 => "c1",
            Required::Bounded => "bounded",
        }
    }
}

/// All statements about a scheme around a vertex.
#[derive(Clone, Debug)]
pub struct Report {
    scheme: Scheme,
    spokes: Spokes,
    required: Required,
    checks: Vec<Check>,
}

/// The statements that C1 asks for.
const C1: [&str; 5] = ["row_sums", "subdominant", "polygon", "regular", "injective"];

impl Report {
    /// What is known of a scheme around a vertex with these intervals.
    ///
    /// # Errors
    /// Those of the scheme's matrices: intervals for which there is none.
    pub fn new(scheme: Scheme, spokes: Spokes, required: Required) -> Result<Self, Error> {
        let checks = match scheme {
            Scheme::Hnuss(rule) => hnuss(&spokes, rule)?,
            Scheme::EigenPolyhedron => eigen_polyhedron(&spokes)?,
            Scheme::Nurss => averaged(&spokes)?,
        };
        Ok(Report {
            scheme,
            spokes,
            required,
            checks,
        })
    }

    /// What is known of all that is required together.
    pub fn status(&self) -> Status {
        let wanted = |check: &&Check| {
            C1.contains(&check.name) || (self.required == Required::Bounded && check.name == "bounded_curvature")
        };
        let wanted: Vec<&Check> = self.checks.iter().filter(wanted).collect();
        wanted
            .iter()
            .fold(Status::Proven, |status, check| status.and(check.status))
    }

    fn corner(&self) -> String {
        let list = |list: &[f64]| list.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        format!(
            "closed, knots {} next {}",
            list(self.spokes.intervals()),
            list(self.spokes.next())
        )
    }

    fn table(&self) -> Table {
        let mut table = Table::new(["check", "status", "margin", "value", "remark"]);
        for check in &self.checks {
            table.push(vec![
                check.name.into(),
                check.status.to_string().into(),
                check.margin.into(),
                check.enclosure.map(|[low, high]| 0.5 * (low + high)).into(),
                check.reached.clone().into(),
            ]);
        }
        table
    }

    /// The report in the form of a certificate's.
    pub fn render(&self, format: Format) -> String {
        let status = self.status();
        match format {
            Format::Json => pretty(&json!({
                "scheme": self.scheme.to_string(),
                "valence": self.spokes.valence(),
                "corner": self.corner(),
                "require": self.required.name(),
                "status": status,
                "holds": matches!(status, Status::Proven | Status::Numerical),
                "degree": 3,
                "balanced": Value::Null,
                "checks": self.checks.iter().map(check_json).collect::<Vec<_>>(),
            })),
            Format::Text => format!(
                "{}, N = {}, {}, regular surface of degree 3\n\n{}\n{} is {status}\n",
                self.scheme,
                self.spokes.valence(),
                self.corner(),
                self.table().fitted(WIDTH),
                self.required.name(),
            ),
            format => self.table().render(format),
        }
    }
}

fn check_json(check: &Check) -> Value {
    json!({
        "name": check.name,
        "status": check.status,
        "holds": matches!(check.status, Status::Proven | Status::Numerical),
        "rigorous": matches!(check.status, Status::Proven | Status::Refuted),
        "margin": check.margin,
        "enclosure": check.enclosure,
        "witness": Value::Null,
        "reached": check.reached,
    })
}

/// A rational number from below.
fn below(value: &BigRational) -> f64 {
    <f64 as eigenring_scheme::Scalar>::rational(value).next_down()
}

fn hnuss(spokes: &Spokes, rule: FirstLevel) -> Result<Vec<Check>, Error> {
    let d = spokes.intervals();
    let n = d.len();
    let nonuniform = |error: eigenring_scheme::Error| eigenring_nonuniform::Error::from(error);
    let ngon = NGon::new(d)?;
    if rule.needs_polyhedron() {
        // without it there is no first level, and no surface to speak of
        EigenPolyhedron::new(d)?;
    }
    let proven = |holds: bool| if holds { Status::Proven } else { Status::Undecided };
    let sums = lemmas::rows_sum_to_one(d).map_err(nonuniform)?;
    let polygon = lemmas::polygon_is_an_eigenvector(d).map_err(nonuniform)?;
    let mut checks = vec![Check {
        name: "row_sums",
        status: proven(sums),
        margin: None,
        enclosure: None,
        reached: "exact: rows of Q_n; all other rules are univariate ones".to_owned(),
    }];
    let positive = d.iter().all(|&d| d > 0.0);
    let bound = lemmas::gap_bound(d).map_err(nonuniform)?;
    let fourth = ngon
        .spectrum()
        .into_iter()
        .skip(3)
        .fold(0.0, |m: f64, x| m.max(x.abs()));
    checks.push(Check {
        name: "subdominant",
        status: proven(lemmas::is_strict(d).map_err(nonuniform)?),
        margin: positive.then(|| below(&bound)),
        enclosure: Some([0.5, 0.5]),
        reached: match positive {
            true => "Lemma 1: 1, 1/2, 1/2 lead; the margin bounds 1/2 - |lambda_4|, from min and max of n alpha, exactly".to_owned(),
            false => "Lemma 1: 1, 1/2, 1/2 lead; at most three alpha vanish, so that no vector orthogonal to the modes 0, 1, -1 has them alone".to_owned(),
        },
    });
    checks.push(Check {
        name: "polygon",
        status: proven(polygon),
        margin: None,
        enclosure: None,
        reached: "Lemma 2: the regular polygon is the eigenvector of 1/2, in exact cyclotomic numbers".to_owned(),
    });
    let patches = lemmas::patches();
    let least = patches.iter().flat_map(|patch| patch.least()).min();
    let most = patches
        .iter()
        .map(|patch| patch.least().into_iter().max())
        .min()
        .flatten();
    let lemma = |holds: bool| proven(holds && positive && polygon);
    let needs = if positive {
        ""
    } else {
        "; the proof needs positive intervals"
    };
    checks.push(Check {
        name: "regular",
        status: lemma(patches.iter().all(lemmas::Patch::is_regular)),
        margin: most.as_ref().filter(|_| positive).map(below),
        enclosure: None,
        reached: format!(
            "Lemma 3, for every valence and all positive intervals: all 108 Bernstein coefficients of each of three patches are at least {}{needs}",
            least.map_or(String::new(), |least| least.to_string()),
        ),
    });
    checks.push(Check {
        name: "injective",
        status: lemma(patches.iter().all(lemmas::Patch::is_injective)),
        margin: None,
        enclosure: None,
        reached: format!(
            "Lemma 3: the Jacobian in the directions of the lines is a P-matrix (Gale and Nikaido){needs}"
        ),
    });
    // Lines and sectors add 1/4 and less; where lambda_4 is 1/4 itself, it has Jordan blocks with them. What
    // is closer to it than 1e-9, far beyond rounding, counts as equal. All arguments are for positive
    // intervals.
    let bounded = positive && (n < 5 || fourth < 0.25 - 1e-9);
    checks.push(Check {
        name: "bounded_curvature_matrix",
        status: if bounded { Status::Numerical } else { Status::Undecided },
        margin: Some(0.25 - fourth),
        enclosure: Some([fourth, fourth]),
        reached: match bounded {
            true => "the matrix alone: no eigenvalue of Q_n after 1/2 reaches 1/4, or only a semisimple one".to_owned(),
            false if positive => "the matrix alone: |lambda_4| exceeds 1/4, or is 1/4 with Jordan blocks".to_owned(),
            false => "of zero intervals nothing is known".to_owned(),
        },
    });
    let coplanar = rule.needs_polyhedron() && positive;
    checks.push(Check {
        name: "bounded_curvature",
        status: if bounded || coplanar { Status::Numerical } else { Status::Undecided },
        margin: None,
        enclosure: None,
        reached: match (bounded, coplanar) {
            (true, _) => "by the eigenvalues of the matrix".to_owned(),
            (_, true) => "the first level makes the corners of the n-gon coplanar, so that the height has no part in the modes of Q_n, and 1/4 leads it".to_owned(),
            _ if !positive => "of zero intervals nothing is known".to_owned(),
            _ => "the simple rule makes corners that are not coplanar: curvature grows like (4 lambda_4)^m, or like m for equal intervals".to_owned(),
        },
    });
    Ok(checks)
}

/// Moduli of the eigenvalues, falling, and whether they are real.
fn moduli(matrix: &Matrix<f64>) -> Result<Vec<(f64, bool)>, Error> {
    let values = Block::Real(matrix.clone()).eigenvalues()?;
    let repeated = values.iter().flat_map(|e| {
        let one = (e.value.re.hypot(e.value.im), e.value.im.abs() < 1e-12);
        std::iter::repeat_n(one, e.multiplicity)
    });
    let mut all: Vec<(f64, bool)> = repeated.collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    Ok(all)
}

/// Statements that hold for matrices in doubles, and what nobody has proven.
fn computed(matrix: &Matrix<f64>) -> Result<Vec<Check>, Error> {
    let defect = (0..matrix.rows())
        .map(|i| (matrix.row(i).iter().sum::<f64>() - 1.0).abs())
        .fold(0.0, f64::max);
    let values = moduli(matrix)?;
    let [second, third, fourth] = [1, 2, 3].map(|i| values.get(i).map_or(0.0, |value| value.0));
    let double = (second - third).abs() < 1e-10 && values[1].1;
    let open = |name| Check {
        name,
        status: Status::Undecided,
        margin: None,
        enclosure: None,
        reached: "the characteristic map is not proven regular for unequal intervals".to_owned(),
    };
    Ok(vec![
        Check {
            name: "row_sums",
            status: if defect < 1e-13 {
                Status::Numerical
            } else {
                Status::Undecided
            },
            margin: Some(defect),
            enclosure: None,
            reached: "in doubles".to_owned(),
        },
        Check {
            name: "subdominant",
            status: if double && fourth < third {
                Status::Numerical
            } else {
                Status::Undecided
            },
            margin: Some(third - fourth),
            enclosure: Some([third, second]),
            reached: match double {
                true => format!("a double eigenvalue; the next modulus is {fourth:.6}"),
                false => {
                    format!("the eigenvalues {second:.6} and {third:.6} differ: the criterion for C1 does not apply")
                }
            },
        },
        open("regular"),
        open("injective"),
    ])
}

fn averaged(spokes: &Spokes) -> Result<Vec<Check>, Error> {
    computed(&nurss::matrix::<f64>(&spokes.after_a_level())?)
}

fn eigen_polyhedron(spokes: &Spokes) -> Result<Vec<Check>, Error> {
    let polyhedron = EigenPolyhedron::new(spokes.intervals())?;
    let inside = |w: &f64| w.min(1.0 - w);
    let weights = polyhedron.alpha.iter().chain(&polyhedron.beta).flatten();
    let margin = weights.map(inside).fold(f64::INFINITY, f64::min);
    let mut checks = computed(&polyhedron.matrix()?)?;
    checks.insert(
        1,
        Check {
            name: "domain",
            status: Status::Numerical,
            margin: Some(margin),
            enclosure: None,
            reached: "the eigen-polyhedron exists: all weights lie in [0, 1]".to_owned(),
        },
    );
    Ok(checks)
}
