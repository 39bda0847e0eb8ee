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
    /// The word for it.
    pub fn name(self) -> &'static str {
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
    /// None: all valences and all positive intervals.
    spokes: Option<Spokes>,
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
            spokes: Some(spokes),
            required,
            checks,
        })
    }

    /// What is known of HNUSS at every valence from 3 for all positive intervals at once, wherever its first
    /// level exists.
    ///
    /// # Errors
    /// [`Error::Usage`] for the other schemes, of which nothing is known for all intervals.
    pub fn for_all(scheme: Scheme, required: Required) -> Result<Self, Error> {
        let Scheme::Hnuss(rule) = scheme else {
            return Err(Error::Usage {
                message: format!("of {scheme} nothing is known for all valences and intervals"),
                accepted: "hnuss[:simple|printed], or --knots".to_owned(),
            });
        };
        Ok(Report {
            scheme,
            spokes: None,
            required,
            checks: for_all(rule),
        })
    }

    /// The scheme.
    pub fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// The intervals, unless it is about all.
    pub fn spokes(&self) -> Option<&Spokes> {
        self.spokes.as_ref()
    }

    /// What must hold.
    pub fn required(&self) -> Required {
        self.required
    }

    /// The statements.
    pub fn checks(&self) -> &[Check] {
        &self.checks
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
        let Some(spokes) = &self.spokes else {
            return "closed, all positive knots".to_owned();
        };
        let list = |list: &[f64]| list.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        format!(
            "closed, knots {} next {}",
            list(spokes.intervals()),
            list(spokes.next())
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
                "valence": self.spokes.as_ref().map(Spokes::valence),
                "corner": self.corner(),
                "require": self.required.name(),
                "status": status,
                "holds": matches!(status, Status::Proven | Status::Numerical),
                "degree": 3,
                "balanced": Value::Null,
                "checks": self.checks.iter().map(check_json).collect::<Vec<_>>(),
            })),
            Format::Text => format!(
                "{}, N {}, {}, regular surface of degree 3\n\n{}\n{} is {status}\n",
                self.scheme,
                match &self.spokes {
                    Some(spokes) => format!("= {}", spokes.valence()),
                    None => ">= 3".to_owned(),
                },
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

/// A positive rational number from below.
fn below(value: &BigRational) -> f64 {
    <f64 as eigenring_scheme::Scalar>::rational(value).next_down().max(0.0)
}

fn proven(holds: bool) -> Status {
    if holds { Status::Proven } else { Status::Undecided }
}

/// Lemma 3 where it applies, and in words what it needs.
fn third_lemma(applies: bool, needs: &str) -> [Check; 2] {
    let patches = lemmas::patches();
    let least = patches.iter().flat_map(|patch| patch.least()).min();
    let most = patches
        .iter()
        .map(|patch| patch.least().into_iter().max())
        .min()
        .flatten();
    let check = |name, holds: bool, reached: String| Check {
        name,
        status: proven(holds && applies),
        margin: None,
        enclosure: None,
        reached,
    };
    let coefficients = format!(
        "Lemma 3, for every valence and all positive intervals: all 108 Bernstein coefficients of each of three patches are at least {}{needs}",
        least.map_or(String::new(), |least| least.to_string()),
    );
    let direction =
        format!("Lemma 3: the Jacobian in the directions of the lines is a P-matrix (Gale and Nikaido){needs}");
    [
        Check {
            margin: most.as_ref().filter(|_| applies).map(below),
            ..check("regular", patches.iter().all(lemmas::Patch::is_regular), coefficients)
        },
        check("injective", patches.iter().all(lemmas::Patch::is_injective), direction),
    ]
}

/// What holds at every valence and for all positive intervals: identities and inequalities of formulas, and
/// Lemma 3.
fn for_all(rule: FirstLevel) -> Vec<Check> {
    let check = |name, holds, reached: &str| Check {
        name,
        status: proven(holds),
        margin: None,
        enclosure: None,
        reached: reached.to_owned(),
    };
    let mut checks = vec![
        check(
            "row_sums",
            lemmas::beta_sums_to_one(),
            "beta sums to 1, an identity of products of intervals, and I - Pi takes constants to 0",
        ),
        Check {
            enclosure: Some([0.5, 0.5]),
            ..check(
                "subdominant",
                true,
                "Lemma 1: n alpha, a product of d/(d + d') twice, lies between 0 and 1, and so do all mu; no gap holds for all",
            )
        },
        check(
            "polygon",
            true,
            "Lemma 2: I - Pi takes the modes 1 and -1, of which a regular polygon consists, to 0",
        ),
    ];
    checks.extend(third_lemma(true, ""));
    let coplanar = rule.needs_polyhedron();
    checks.push(Check {
        status: if coplanar { Status::Numerical } else { Status::Undecided },
        ..check(
            "bounded_curvature",
            false,
            match coplanar {
                true => "wherever the first level exists, it makes the corners of the n-gon coplanar, and 1/4 leads the height",
                false => "the simple rule makes corners that are not coplanar; for n = 3 and 4 it is bounded by the matrix",
            },
        )
    });
    checks
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
    let strict = lemmas::is_strict(d).map_err(nonuniform)?;
    checks.push(Check {
        name: "subdominant",
        status: proven(positive && strict),
        margin: positive.then(|| below(&bound)),
        enclosure: Some([0.5, 0.5]),
        reached: match (positive, strict) {
            (true, _) => {
                "Lemma 1: 1, 1/2, 1/2 lead; the margin bounds 1/2 - |lambda_4|, from min and max of n alpha, exactly"
            }
            // the line across a zero spoke is a triple knot
            (_, true) => "Lemma 1: 1, 1/2, 1/2 lead the n-gon; a zero spoke has a further 1/2 outside of it",
            _ => "1/2 is no double eigenvalue of the n-gon",
        }
        .to_owned(),
    });
    checks.push(Check {
        name: "polygon",
        status: proven(polygon),
        margin: None,
        enclosure: None,
        reached: "Lemma 2: the regular polygon is the eigenvector of 1/2, in exact cyclotomic numbers".to_owned(),
    });
    checks.extend(third_lemma(
        positive && polygon,
        if positive {
            ""
        } else {
            "; the proof needs positive intervals"
        },
    ));
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
