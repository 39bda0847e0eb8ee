//! **Claim**: what `compare` measures of a scheme is what its certificate and its spectrum say, for every
//! registered scheme. **Oracle**: the certificate's enclosures come from intervals and need not know the
//! eigenvalues of double arithmetic; the spectrum's list is read here by hand.

use eigenring_atlas::compare::Row;
use eigenring_atlas::eigenvectors::Eigenvectors;
use eigenring_atlas::figures::{self, Inputs, Studies};
use eigenring_atlas::matrix::LocalMatrix;
use eigenring_atlas::progress::Silent;
use eigenring_atlas::schemes::{SchemeName, Tuner};
use eigenring_atlas::spectrum::Analysis;
use eigenring_atlas::stencil::objective;
use eigenring_atlas::tune::at;
use eigenring_certify::{Input, Statement, Status, certify};
use eigenring_scheme::lambda::Member;
use eigenring_scheme::user::{Reading, UserScheme};
use eigenring_scheme::{Corner, Scheme, Spec, registry};
use eigenring_spectral::Extended;
use eigenring_tune::objective::Settings;
use eigenring_tune::sweep::Options;
use rayon::prelude::*;
use serde_json::Value;

/// Enclosures are up to 1e-12 wide; eigenvalues of double arithmetic with a vector each are closer still.
const ROUNDING: f64 = 1e-9;

/// The bound of a cluster of two equal eigenvalues, the square root of rounding, with some room.
const COARSE: f64 = 1e-5;

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= ROUNDING * a.abs().max(b.abs()).max(1e-3)
}

/// The rules of a scheme by name, in both precisions.
fn rules(name: &str, valence: usize) -> (Scheme<f64>, Option<Scheme<Extended>>) {
    let name: SchemeName = name.parse().unwrap();
    let corner = Corner::closed(name.centre().unwrap(), valence).unwrap();
    let scheme = name.around(&corner, &Tuner::default()).unwrap();
    (scheme, name.extended(&corner).unwrap())
}

#[test]
fn compare_says_what_certificates_and_spectra_say() {
    let examples = registry().iter().flat_map(|family| family.examples);
    let cases: Vec<(&str, usize)> = examples
        .flat_map(|&example| (3..=12).map(move |n| (example, n)))
        .collect();
    // certificates of high orders take most of the time
    let counts = cases.into_par_iter().map(|(example, valence)| {
        let spec: Spec = example.parse().unwrap();
        let (scheme, extended) = rules(example, valence);
        let row = Row::new(example, &scheme, extended.as_ref()).unwrap();
        let place = format!("{example} at N = {valence}: {row:?}");

        let analysis = Analysis::of_rules(&scheme, extended.as_ref(), None, None).unwrap();
        let list = analysis.spectrum.eigenvalues;
        let lambda = list[1].modulus();
        let mu = list[2..]
            .iter()
            .map(|e| e.modulus())
            .find(|m| *m < lambda * (1.0 - ROUNDING));
        assert!(close(row.lambda.unwrap(), lambda), "{place}");
        assert!(
            close(row.ratio.unwrap(), mu.unwrap_or(0.0) / (lambda * lambda)),
            "{place}"
        );
        assert!(close(row.gap.unwrap(), 1.0 - mu.unwrap_or(0.0) / lambda), "{place}");

        let certificate = certify(Input::from_spec(&spec, valence).unwrap(), valence).unwrap();
        let check = |name: Statement| certificate.checks.iter().find(|check| check.name == name).unwrap();
        let of = |name: Statement| check(name).enclosure.map(|enclosure| enclosure.mid());
        assert!(close(row.hull.unwrap(), of(Statement::Hull).unwrap()), "{place}");
        if let Some(lambda) = of(Statement::Dominant).filter(|_| check(Statement::Dominant).holds) {
            assert!(close(row.lambda.unwrap(), lambda), "{place}");
        }
        if let Some(ratio) = of(Statement::BoundedCurvature) {
            assert!(close(row.ratio.unwrap(), ratio), "{place}, {ratio}");
        }
        // a margin is printed where the statement holds, and nowhere else
        let certified = check(Statement::Strict);
        match (row.strict, certified.margin.filter(|_| certified.holds)) {
            (Some(margin), Some(known)) => {
                // a lower bound, which is coarse where repeated eigenvalues are only bounded
                assert!((-ROUNDING..COARSE).contains(&(margin - known)), "{place}, {known}");
                [1, 0]
            }
            (None, None) => [0, 1],
            // a certificate may be unable to tell what floating point numbers tell by a wide gap
            (Some(_), None) => {
                assert_eq!(certified.status, Status::Undecided, "{place}");
                [0, 0]
            }
            (None, Some(known)) => panic!("{place}, proven with {known}"),
        }
    });
    let [strict, tied] = counts.reduce(|| [0, 0], |[a, b], [c, d]| [a + c, b + d]);
    // both happen: Catmull-Clark is strict, the biquadratic schemes have ties at N >= 4
    assert!(strict > 60 && tied > 10, "{strict} and {tied}");
}

/// What spectrum, eigenvectors, matrix, objective and the tables of figures print of a scheme is what compare
/// prints, wherever two of them print the same.
#[test]
fn other_commands_say_what_compare_says() {
    let examples: Vec<&str> = registry().iter().flat_map(|family| family.examples).copied().collect();
    let tuner = Tuner::default();
    let mut objectives = 0;
    for example in &examples {
        let name: SchemeName = example.parse().unwrap();
        for valence in 3..=12 {
            let (scheme, extended) = rules(example, valence);
            let place = format!("{example} at N = {valence}");
            let row = Row::new(example, &scheme, extended.as_ref()).unwrap();
            let corner = Corner::closed(name.centre().unwrap(), valence).unwrap();
            let analysis = Analysis::of_name(&name, &corner, [None; 2], &tuner).unwrap();
            let json = analysis.json();
            assert!(
                close(json["subdominant"].as_f64().unwrap().abs(), row.lambda.unwrap()),
                "{place}"
            );
            assert_eq!(json["s"].as_f64(), row.ratio, "{place}");
            // the matrix has the trace of the eigenvalues, and the limit stencil is its left eigenvector
            let rings = analysis.system.numbering().rings;
            let LocalMatrix { matrix, .. } = LocalMatrix::new(&scheme, Some(rings), None).unwrap();
            let trace: f64 = (0..matrix.rows()).map(|i| matrix[(i, i)]).sum();
            let sum: f64 = analysis
                .spectrum
                .eigenvalues
                .iter()
                .map(|e| e.value.re * e.multiplicity as f64)
                .sum();
            assert!(
                (trace - sum).abs() < 1e-10 * matrix.rows() as f64,
                "{place}: {trace} {sum}"
            );
            let position = json["limit_stencils"]["position"].as_array();
            if let Some(position) = position {
                let weights: Vec<f64> = position.iter().map(|w| w.as_f64().unwrap()).collect();
                for (j, weight) in weights.iter().enumerate() {
                    let image: f64 = (0..matrix.rows()).map(|i| weights[i] * matrix[(i, j)]).sum();
                    assert!((image - weight).abs() < 1e-12, "{place}");
                }
            }
            // a defective matrix of many points has no such list
            if let Ok(vectors) = Eigenvectors::new(&analysis, extended.as_ref()) {
                let listed = vectors.vectors.iter().map(|v| (v.value.re, v.value.im.abs()));
                let repeated = analysis.spectrum.eigenvalues.iter();
                let repeated =
                    repeated.flat_map(|e| std::iter::repeat_n((e.value.re, e.value.im.abs()), e.multiplicity));
                assert!(listed.eq(repeated), "{place}");
            }
            if let Some(member) = name.member(valence, &tuner).unwrap() {
                let settings = Settings {
                    weighted: false,
                    ..Settings::default()
                };
                let (record, _) = objective(&member, settings).unwrap();
                let record = record.json();
                let number = |field: &str| record[field].as_f64().unwrap();
                assert!(
                    close(number("total"), row.total.unwrap()),
                    "{place}: {record:?}, {row:?}"
                );
                assert!(close(number("sign_change"), row.sign_change.unwrap()), "{place}");
                assert!(
                    close(number("lambda"), row.lambda.unwrap()) || row.lambda.unwrap() > number("lambda"),
                    "{place}"
                );
                objectives += 1;
            }
        }
    }
    assert!(objectives >= 20, "{objectives}");
}

/// The tables of figures have the eigenvalues that `spectrum` prints.
#[test]
fn tables_of_figures_say_what_spectra_say() {
    let tuner = Tuner::default();
    let schemes: Vec<SchemeName> = ["catmull-clark", "stam:order=12", "doo-sabin", "lambda:lambda=0.5"]
        .map(|name| name.parse().unwrap())
        .to_vec();
    let studies = Studies::load(None, &[], &Silent).unwrap();
    for name in ["spectrum", "characteristic-map", "natural-configurations"] {
        let entry = figures::find(name).unwrap();
        let inputs = Inputs {
            valences: &[3, 5],
            lambdas: &[],
            schemes: &schemes,
            colours: entry.colours,
            range: (0.15, 0.9),
            width: entry.width,
            sweep: None,
            knots: None,
            studies: &studies,
            tuner: &tuner,
        };
        let drawing = (entry.build)(&inputs).unwrap().remove(0);
        let rows = drawing.data[0].1.json();
        for scheme in &schemes {
            for valence in [3, 5] {
                let corner = Corner::closed(scheme.centre().unwrap(), valence).unwrap();
                let analysis = Analysis::of_name(scheme, &corner, [None; 2], &tuner).unwrap();
                let of = |row: &&Value| row["scheme"] == analysis.name.as_str() && row["valence"] == valence;
                let rows: Vec<&Value> = rows.as_array().unwrap().iter().filter(of).collect();
                let place = format!("{name}: {} at N = {valence}", analysis.name);
                assert!(!rows.is_empty(), "{place}");
                if name == "spectrum" {
                    let listed = rows.iter().map(|row| {
                        let number = |field: &str| row[field].as_f64().unwrap();
                        (
                            number("re"),
                            number("im"),
                            row["multiplicity"].as_u64(),
                            row["geometric"].as_u64(),
                        )
                    });
                    let known = analysis.spectrum.eigenvalues.iter();
                    let known = known.map(|e| {
                        let geometric = e.geometric.map(|count| count as u64);
                        (e.value.re, e.value.im, Some(e.multiplicity as u64), geometric)
                    });
                    assert!(listed.eq(known), "{place}");
                } else {
                    let of_block_1 = analysis.spectrum.eigenvalues.iter().find(|e| e.fourier == Some(1));
                    let lambda = of_block_1.unwrap().modulus();
                    assert!(
                        rows.iter().all(|row| close(row["lambda"].as_f64().unwrap(), lambda)),
                        "{place}"
                    );
                }
            }
        }
    }
}

/// What `tune` finds is what `objective` says of it.
#[test]
fn tuned_stencils_have_their_objective() {
    let options = Options::default();
    let record = at(6, 0.5, &options).unwrap().record.json();
    let number = |field: &str| record[field].as_f64().unwrap();
    let weights = [number("f2"), number("f3")];
    let member = Member::given(6, number("lambda"), Some(number("s")), weights).unwrap();
    let (found, _) = objective(&member, options.settings).unwrap();
    assert!(close(found.json()["total"].as_f64().unwrap(), number("total")));
}

/// One scheme under two names.
#[test]
fn catmull_clark_is_stam_of_order_four() {
    for valence in 3..=12 {
        let row = |name: &str| {
            let (scheme, extended) = rules(name, valence);
            Row::new("", &scheme, extended.as_ref()).unwrap()
        };
        let (one, other) = (row("catmull-clark"), row("stam:order=4"));
        for (a, b) in [
            (one.lambda, other.lambda),
            (one.ratio, other.ratio),
            (one.gap, other.gap),
            (one.strict, other.strict),
            (one.hull, other.hull),
            (one.theta, other.theta),
        ] {
            assert!(close(a.unwrap(), b.unwrap()), "{one:?}\n{other:?}");
        }
    }
}

/// The largest eigenvalue after 1 is in block 0, for large weights of the vertex rule.
const STRAY: &str = r#"
kind = "one-ring"
name = "stray"
[[valence]]
n = 3
f1 = "1/4"
f2 = "1/4"
f3 = "1/4"
d1 = "3/8"
d2 = "3/8"
e1 = "1/16"
e2 = "1/16"
alpha = "1/5"
beta = "1/30"
"#;

/// What has no meaning without a characteristic map is left out by all that would print it, and they say why.
#[test]
fn a_subdominant_eigenvalue_of_another_block_is_said_to_be() {
    let file = UserScheme::parse(STRAY, "stray", Reading::default()).unwrap();
    let scheme: Scheme<f64> = file.scheme(3).unwrap();
    let analysis = Analysis::of_scheme(&scheme, None, None).unwrap();
    let lambda = analysis.spectrum.subdominant().unwrap();
    assert_eq!((lambda.fourier, analysis.spectrum.stray()), (Some(0), Some(0)));
    let json = analysis.json();
    assert!(json["s"].is_null() && json["limit_stencils"]["tangent_x"].is_null());
    assert!(json["limit_stencils"]["position"].is_array());
    assert!(analysis.text().contains("note: the subdominant eigenvalue") && analysis.text().contains("index 0, not 1"));
    let row = Row::new("stray", &scheme, None).unwrap();
    assert!(close(row.lambda.unwrap(), lambda.modulus()));
    assert_eq!((row.ratio, row.total, row.theta, row.strict), (None, None, None, None));
    assert!(row.remark.contains("Fourier index 0, not 1"), "{}", row.remark);
    let input = Input::Toml {
        text: STRAY.to_owned(),
        name: "stray".to_owned(),
        reading: Reading::default(),
        parameters: Default::default(),
    };
    let certificate = certify(input, 3).unwrap();
    let c1 = certificate
        .checks
        .iter()
        .filter(|check| check.name == Statement::Dominant || check.name == Statement::Subdominant);
    assert!(c1.clone().count() > 0 && c1.into_iter().any(|check| !check.holds));
}

/// Fields of the JSON of `spectrum` that others rely upon, of the limit level and of a leading one.
#[test]
fn spectra_name_their_level() {
    let scheme: Scheme<f64> = "tension:order=6,u0=2".parse::<Spec>().unwrap().scheme(7).unwrap();
    let leading = scheme.leading().len();
    let (limit, first) = (
        Analysis::of_scheme(&scheme, None, None).unwrap(),
        Analysis::of_scheme(&scheme, None, Some(0)).unwrap(),
    );
    let (json, text) = (limit.json(), limit.text());
    for field in "scheme corner valence rings points level eigenvalues subdominant subsubdominant s lattice closed_rings outer limit_stencils notes"
        .split(' ')
    {
        assert!(json.contains_key(field), "{field}");
    }
    assert_eq!(
        (json["level"].as_u64(), first.json()["level"].as_u64()),
        (Some(leading as u64), Some(0))
    );
    assert!(text.contains("level") && text.contains("the limit level"), "{text}");
    assert!(first.text().contains("a leading level"));
    assert!(limit.spectrum.subdominant() != first.spectrum.subdominant());
    let total: u64 = json["eigenvalues"]
        .as_array()
        .unwrap()
        .iter()
        .map(|e| e["multiplicity"].as_u64().unwrap())
        .sum();
    assert_eq!(Some(total), json["points"].as_u64());
}
