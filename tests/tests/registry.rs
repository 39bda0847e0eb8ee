//! **Claim**: every registered scheme is an affine-invariant scheme with the eigenstructure of a C1 scheme,
//! and its Fourier blocks hold the spectrum of its local matrix. **Oracles**: row sums of the dense matrix;
//! traces of its powers, which are sums of powers of all eigenvalues, repeated and defective ones included;
//! its discrete Fourier transform; closed forms.
//!
//! The table [`expectation`] names every family. A family that is registered without an entry fails the test:
//! what is new must say what it claims.

use eigenring_scheme::lambda::{Bounds, Domain, LambdaTable, Relaxation, Splines};
use eigenring_scheme::{Complex, Error, FourierNet, Lattice, Level, Numbering, Scheme, Site, Spec, Symmetry, registry};
use eigenring_spectral::{LocalSystem, Matrix, fourier_block, local_matrix, numbering};
use eigenring_tests::Comparison;
use std::f64::consts::TAU;

const VALENCES: std::ops::RangeInclusive<usize> = 3..=12;

/// What a family claims.
struct Expectation {
    /// The kind of net, the degree of the surface and the smallest closed rings.
    form: fn(&Spec) -> (Lattice, usize, usize),
    /// The subdominant eigenvalue of the limit level, where there is a formula.
    lambda: fn(&Spec, usize) -> Option<f64>,
    /// Specs beside the registered examples.
    more: fn(usize) -> Vec<Spec>,
}

fn catmull_clark_lambda(n: usize) -> f64 {
    let c = (TAU / n as f64).cos();
    (c + 5.0 + ((c + 9.0) * (c + 1.0)).sqrt()) / 16.0
}

fn expectation(family: &str) -> Option<Expectation> {
    Some(match family {
        "catmull-clark" => Expectation {
            form: |_| (Lattice::Vertex, 3, 1),
            lambda: |_, n| Some(catmull_clark_lambda(n)),
            more: |_| Vec::new(),
        },
        "doo-sabin" => Expectation {
            form: |_| (Lattice::Face, 2, 0),
            lambda: |spec, n| match *spec {
                Spec::DooSabin => Some(0.5),
                _ => Some(order_three_lambda(n)),
            },
            more: |_| Vec::new(),
        },
        "lambda" => Expectation {
            form: |_| (Lattice::Vertex, 3, 1),
            lambda: |spec, n| match *spec {
                Spec::Lambda { lambda, .. } => Some(lambda),
                _ => LambdaTable::embedded()
                    .unwrap()
                    .entry(n)
                    .ok()
                    .map(|entry| entry.lambda_optimal),
            },
            more: |n| {
                let points = [0.2, 0.4, 0.55, 0.8].into_iter().flat_map(|lambda| {
                    let plane = Relaxation::new(n).unwrap().plane(lambda).unwrap();
                    let starts = Domain::new(plane, Bounds::Paper, 1e-3).unwrap().starts(2);
                    starts.into_iter().map(move |[f2, f3]| Spec::Lambda {
                        lambda,
                        s: None,
                        weights: Some((f2, f3)),
                        splines: Splines::Paper,
                    })
                });
                points.collect()
            },
        },
        "tension" => of_tension(|_| [8, 11].map(|order| Spec::Tension { order, u0: 0.1 }).to_vec()),
        "stam" => of_tension(|_| [3, 4, 5, 9].map(|order| Spec::Stam { order }).to_vec()),
        "morin" => of_tension(|_| [0.01, 1.0, 50.0].map(|u0| Spec::Morin { u0 }).to_vec()),
        _ => return None,
    })
}

fn order_three_lambda(n: usize) -> f64 {
    (3.0 * n as f64 - 4.0 + 4.0 * (TAU / n as f64).cos()) / (4.0 * n as f64)
}

/// What the tension scheme claims, under any of its names.
fn of_tension(more: fn(usize) -> Vec<Spec>) -> Expectation {
    fn order(spec: &Spec) -> usize {
        spec.order_and_tension().expect("a case of the tension scheme").0
    }
    Expectation {
        form: |spec| match order(spec) {
            even if even % 2 == 0 => (Lattice::Vertex, even - 1, even / 2 - 1),
            odd => (Lattice::Face, odd - 1, (odd - 3) / 2),
        },
        // the limit level is that of u = 1
        lambda: |spec, n| match (order(spec), n) {
            (_, 4) => Some(0.5),
            (3, _) => Some(order_three_lambda(n)),
            (4, _) => Some(catmull_clark_lambda(n)),
            _ => None,
        },
        more,
    }
}

/// All schemes under test. Only a spec that needs the embedded table may be missing, and only while that is
/// empty.
fn schemes() -> Vec<(Expectation, Spec, Scheme<f64>)> {
    let table_is_empty = LambdaTable::embedded().unwrap().valences.is_empty();
    let (mut schemes, mut left_out) = (Vec::new(), 0);
    for family in registry() {
        for n in VALENCES {
            let expected = || {
                expectation(family.name)
                    .unwrap_or_else(|| panic!("the registered family '{}' has no expectation", family.name))
            };
            let registered = family.examples.iter().map(|example| example.parse().unwrap());
            let specs: Vec<Spec> = registered.chain((expected().more)(n)).collect();
            let before = schemes.len();
            for spec in specs {
                match spec.scheme(n) {
                    Ok(scheme) => schemes.push((expected(), spec, scheme)),
                    Err(Error::NotTabulated { .. }) if table_is_empty => left_out += 1,
                    Err(error) => panic!("{spec}, N = {n}: {error}"),
                }
            }
            assert!(schemes.len() > before, "{}: no scheme at N = {n}", family.name);
        }
    }
    if left_out > 0 {
        eprintln!("{left_out} schemes are left out while the embedded table is empty");
    }
    schemes
}

/// [`schemes`] panics for a family that says nothing, and this is what it asks.
#[test]
fn an_unknown_family_has_no_expectation() {
    assert!(expectation("registered-but-forgotten").is_none());
}

/// The first refinement and the limit level.
fn levels(scheme: &Scheme<f64>) -> impl Iterator<Item = (&'static str, &Level<f64>)> {
    let first = scheme.leading().first().map(|level| ("first level", level));
    first.into_iter().chain([("limit level", scheme.limit())])
}

#[test]
fn nets_are_as_claimed_and_rows_are_affine() {
    let mut sums = Comparison::new("row sums", 1e-14);
    for (expected, spec, scheme) in schemes() {
        let label = format!("{spec}, N = {}", scheme.valence());
        let rings = scheme.closed_rings().unwrap();
        assert_eq!(
            (scheme.lattice(), scheme.degree().unwrap(), rings),
            (expected.form)(&spec),
            "{label}"
        );
        // fewer rings have no square matrix
        if rings > 1 - scheme.lattice().parity() as usize {
            assert!(local_matrix(scheme.limit(), rings - 1).is_err(), "{label}");
        }
        for (which, level) in levels(&scheme) {
            let matrix = local_matrix(level, rings + 1).unwrap();
            for row in 0..matrix.rows() {
                let sum = matrix.row(row).iter().sum();
                sums.check(format!("{label}, {which}, row {row}"), sum, 1.0);
            }
        }
    }
    sums.finish();
}

#[test]
fn spectra_are_those_of_smooth_surfaces() {
    let mut leading = Comparison::new("leading eigenvalues", 1e-12);
    for (expected, spec, scheme) in schemes() {
        let n = scheme.valence();
        let rings = scheme.closed_rings().unwrap();
        for (which, level) in levels(&scheme) {
            let label = format!("{spec}, N = {n}, {which}");
            let spectrum = LocalSystem::new(level, rings).unwrap().spectrum().unwrap();
            let [one, lambda] = spectrum.eigenvalues[..2] else {
                unreachable!("blocks 0 and 1 exist and have an eigenvalue each")
            };
            leading.check(format!("{label}, dominant"), one.value.re, 1.0);
            assert_eq!((one.fourier, one.multiplicity), (Some(0), 1), "{label}: {one:?}");
            assert_eq!(
                (lambda.fourier, lambda.multiplicity),
                (Some(1), 2),
                "{label}: {lambda:?}"
            );
            assert!(lambda.value.im == 0.0 && lambda.value.re > 0.0, "{label}: {lambda:?}");
            // valence 3 on ring 0 of a face net has no third
            let mu = spectrum.eigenvalues.get(2).map_or(0.0, |mu| mu.modulus());
            assert!(one.modulus() > lambda.modulus() && lambda.modulus() > mu, "{label}");
            if which == "limit level" {
                if let Some(formula) = (expected.lambda)(&spec, n) {
                    leading.check(format!("{label}, subdominant"), lambda.value.re, formula);
                }
                if let Spec::Lambda { lambda, s, .. } = spec {
                    let s = s.unwrap_or_else(|| Relaxation::new(n).unwrap().s(lambda).unwrap());
                    let next = spectrum.subsubdominant().unwrap();
                    leading.check(format!("{label}, next"), next.value.re, s * lambda * lambda);
                }
            }
        }
    }
    leading.finish();
}

#[test]
fn the_blocks_hold_the_spectrum_of_the_dense_matrix() {
    let mut traces = Comparison::new("traces of powers", 1e-12);
    let mut transforms = Comparison::new("entries of the Fourier blocks", 1e-14);
    for (_, spec, scheme) in schemes() {
        let n = scheme.valence();
        let rings = scheme.closed_rings().unwrap();
        for (which, level) in levels(&scheme) {
            let label = format!("{spec}, N = {n}, {which}");
            let matrix = local_matrix(level, rings).unwrap();
            let spectrum = LocalSystem::new(level, rings).unwrap().spectrum().unwrap();
            let count: usize = spectrum.eigenvalues.iter().map(|e| e.multiplicity).sum();
            assert_eq!(count, matrix.rows(), "{label}");
            for (power, trace) in traces_of_powers(&matrix, 4).into_iter().enumerate() {
                let sum = spectrum.eigenvalues.iter().map(|e| {
                    let angle = e.value.im.atan2(e.value.re) * (power + 1) as f64;
                    e.multiplicity as f64 * e.modulus().powi(power as i32 + 1) * angle.cos()
                });
                traces.check(format!("{label}, power {}", power + 1), sum.sum(), trace);
            }
            // the same rules without the use of mirror symmetry give the block in the values themselves
            let plain = level.clone().with_at_most(Symmetry::Rotation);
            for k in 0..n {
                let block = fourier_block(&plain, rings, k).unwrap().to_complex();
                let transform = transform(&matrix, numbering(level, rings), k);
                for (i, (a, b)) in block.entries().iter().zip(transform.entries()).enumerate() {
                    transforms.check(format!("{label}, block {k}, entry {i}, re"), a.re, b.re);
                    transforms.check(format!("{label}, block {k}, entry {i}, im"), a.im, b.im);
                }
            }
        }
    }
    traces.finish();
    transforms.finish();
}

/// `tr S, tr S^2, ..`.
fn traces_of_powers(matrix: &Matrix<f64>, powers: usize) -> Vec<f64> {
    let size = matrix.rows();
    let mut power = matrix.clone();
    (0..powers)
        .map(|_| {
            let trace = (0..size).map(|i| power[(i, i)]).sum();
            let rows = (0..size).map(|i| {
                let mut row = vec![0.0; size];
                for (j, &entry) in power.row(i).iter().enumerate().filter(|(_, entry)| **entry != 0.0) {
                    for (sum, &right) in row.iter_mut().zip(matrix.row(j)) {
                        *sum += entry * right;
                    }
                }
                row
            });
            power = Matrix::from_rows(rows.collect(), size);
            trace
        })
        .collect()
}

/// `sum_j M[row of sector 0, column of sector j] w^{kj}`, `w = exp(2 pi i/N)`.
fn transform(matrix: &Matrix<f64>, numbering: Numbering, k: usize) -> Matrix<Complex<f64>> {
    let n = numbering.fan.sectors();
    let sites = FourierNet::<f64>::new(numbering, k, false).unwrap().rows();
    Matrix::from_fn(sites.len(), sites.len(), |row, column| {
        let target = numbering.index(sites[row]).unwrap();
        let copies = if sites[column] == Site::CENTRE { 1 } else { n };
        (0..copies).fold(Complex::zero(), |sum, j| {
            let source = numbering.index(sites[column].rotated(numbering.fan, j as i64)).unwrap();
            let angle = TAU * ((k * j) % n) as f64 / n as f64;
            let entry = matrix[(target, source)];
            sum + Complex::new(entry * angle.cos(), entry * angle.sin())
        })
    })
}
