use super::*;
use eigenring_scheme::families::{catmull_clark, doo_sabin, tension};
use eigenring_scheme::{Corner, Definition, Scalar, Scheme, Spec};
use eigenring_spline::BigRational;

fn largest(v: &[Complex<f64>]) -> f64 {
    v.iter().map(|x| x.re.hypot(x.im)).fold(0.0, f64::max)
}

/// The chain equations and duality on the dense matrix, relative to the norms: the largest entry of a
/// residual over the largest absolute row (column) sum times the largest entry of the vector.
fn check(level: &Level<f64>, chains: &[Chain], rings: usize) -> f64 {
    let matrix = local_matrix(level, rings).unwrap();
    let n = matrix.rows();
    let norm = |entry: &dyn Fn(usize, usize) -> f64| {
        (0..n)
            .map(|i| (0..n).map(|j| entry(i, j).abs()).sum::<f64>())
            .fold(0.0, f64::max)
    };
    let norms = [norm(&|i, j| matrix[(i, j)]), norm(&|i, j| matrix[(j, i)])];
    let mut worst = 0.0_f64;
    let mut residual =
        |norm: f64, transposed: bool, v: &[Complex<f64>], value: Complex<f64>, before: Option<&Vec<Complex<f64>>>| {
            let scale = norm * largest(v).max(before.map_or(0.0, |b| largest(b)));
            for i in 0..n {
                let entry = |j: usize| if transposed { matrix[(j, i)] } else { matrix[(i, j)] };
                let image = (0..n).fold((0.0, 0.0), |s, j| (s.0 + entry(j) * v[j].re, s.1 + entry(j) * v[j].im));
                let b = before.map_or(Complex::default(), |b| b[i]);
                let re = image.0 - value.re * v[i].re + value.im * v[i].im - b.re;
                let im = image.1 - value.re * v[i].im - value.im * v[i].re - b.im;
                worst = worst.max(re.hypot(im) / scale);
            }
        };
    for chain in chains {
        for k in 0..chain.right.len() {
            residual(
                norms[0],
                false,
                &chain.right[k],
                chain.value,
                k.checked_sub(1).map(|b| &chain.right[b]),
            );
            residual(norms[1], true, &chain.left[k], chain.value, chain.left.get(k + 1));
        }
    }
    let flat = |side: fn(&Chain) -> &Vec<Vec<Complex<f64>>>| -> Vec<(Option<usize>, &Vec<Complex<f64>>)> {
        chains
            .iter()
            .flat_map(|c| side(c).iter().map(|v| (c.fourier, v)))
            .collect()
    };
    let length = |v: &[Complex<f64>]| v.iter().map(|x| x.re * x.re + x.im * x.im).sum::<f64>().sqrt();
    for (i, (_, l)) in flat(|c| &c.left).iter().enumerate() {
        for (j, (_, r)) in flat(|c| &c.right).iter().enumerate() {
            let dot = l.iter().zip(r.iter()).fold((0.0, 0.0), |s, (l, r)| {
                (s.0 + l.re * r.re - l.im * r.im, s.1 + l.re * r.im + l.im * r.re)
            });
            let defect = (dot.0 - f64::from(u8::from(i == j))).hypot(dot.1);
            worst = worst.max(defect / (length(l) * length(r)).max(1.0));
        }
    }
    worst
}

fn chains(scheme: &Scheme<f64>, extended: &Scheme<Extended>, rings: usize) -> Vec<Chain> {
    let system = LocalSystem::new(scheme.limit(), rings).unwrap();
    let found = system.chains(Some(extended.limit())).unwrap();
    // each block's vectors are as many as its unknowns
    for (index, block) in system.blocks().iter().enumerate() {
        let of_block = found.iter().filter(|c| c.fourier.unwrap_or(0) == index);
        assert_eq!(of_block.map(|c| c.right.len()).sum::<usize>(), block.size());
    }
    found
}

#[test]
fn vectors_are_those_of_the_dense_matrix() {
    for valence in (3..=20).chain([31, 64]) {
        let worst = |scheme: Scheme<f64>, extended: Scheme<Extended>, rings: usize| {
            let found = chains(&scheme, &extended, rings);
            let error = check(scheme.limit(), &found, rings);
            assert!(error < 1e-14, "{} {valence}: {error}", scheme.name());
        };
        worst(catmull_clark(valence).unwrap(), catmull_clark(valence).unwrap(), 1);
        if valence <= 12 {
            worst(catmull_clark(valence).unwrap(), catmull_clark(valence).unwrap(), 2);
            worst(doo_sabin(valence).unwrap(), doo_sabin(valence).unwrap(), 1);
            let tense = |u: f64| tension::<Extended>(valence, 6, u).unwrap();
            worst(tension(valence, 6, 1.0).unwrap(), tense(1.0), 3);
        }
    }
}

/// The oracle is a closed form: the outermost ring of order 3 at valence 3 has 1/4 in every block, and
/// block 1 has it twice with one vector.
#[test]
fn defective_eigenvalues_have_chains() {
    let scheme = tension::<f64>(3, 3, 1.0).unwrap();
    let extended = tension::<Extended>(3, 3, 1.0).unwrap();
    let found = chains(&scheme, &extended, 1);
    let long: Vec<&Chain> = found
        .iter()
        .filter(|c| c.right.len() > 1 && c.fourier == Some(1))
        .collect();
    assert_eq!(long.len(), 1, "{found:?}");
    assert!(long[0].right.len() == 2 && (long[0].value.re - 0.25).abs() < 1e-15);
}

/// The oracle is a planted Jordan form with integer similarity: blocks of sizes 3 and 2 at 1/2, 2 and 1
/// at zero, and a simple 1.
#[test]
fn planted_jordan_forms_are_found() {
    let sizes = [(1.0, 1), (0.5, 3), (0.5, 2), (0.0, 2), (0.0, 1)];
    let n = 9;
    let mut jordan = Matrix::from_fn(n, n, |_, _| Extended::default());
    let mut at = 0;
    for (value, size) in sizes {
        for k in 0..size {
            jordan[(at + k, at + k)] = Extended::exact(value);
            if k + 1 < size {
                jordan[(at + k, at + k + 1)] = Extended::exact(1.0);
            }
        }
        at += size;
    }
    // unit lower times unit upper triangular matrices of integers have inverses of integers
    let entry = |i: usize, j: usize| ((3 * i + 5 * j) % 4) as f64 - 1.0;
    let triangle = |lower: bool, i: usize, j: usize| {
        Extended::exact(if i == j {
            1.0
        } else if (i > j) == lower {
            entry(i, j)
        } else {
            0.0
        })
    };
    let t = product(
        &Matrix::from_fn(n, n, |i, j| triangle(true, i, j)),
        &Matrix::from_fn(n, n, |i, j| triangle(false, i, j)),
    );
    let unit = |j: usize| {
        (0..n)
            .map(|i| Extended::exact(f64::from(u8::from(i == j))))
            .collect::<Vec<_>>()
    };
    let columns: Vec<Vec<Extended>> = (0..n).map(|j| (0..n).map(|i| t[(i, j)]).collect()).collect();
    let inverse = Matrix::from_rows(dual(&(0..n).map(unit).collect::<Vec<_>>(), &columns).unwrap(), n);
    let matrix = product(&product(&t, &jordan), &inverse);
    assert!(repeated(&Block::Real(matrix.clone()), Precision::Extended).is_ok());
    let found = Block::Real(matrix.clone()).vectors(Precision::Extended, 0).unwrap();
    let mut lengths: Vec<(f64, usize)> = Vec::new();
    for (value, chains) in &found {
        for (right, left) in chains {
            lengths.push((value.re, right.len()));
            for k in 0..right.len() {
                let vector: Vec<Extended> = right[k].iter().map(|x| x.re).collect();
                for (i, image) in times(&matrix, &vector).into_iter().enumerate() {
                    let before = if k == 0 {
                        Extended::default()
                    } else {
                        right[k - 1][i].re
                    };
                    let error = (image - Extended::exact(value.re) * vector[i] - before).to_f64();
                    assert!(error.abs() < 1e-40, "{error}");
                }
                let functional: Vec<Extended> = left[k].iter().map(|x| x.re).collect();
                for (i, image) in times(&transposed(&matrix), &functional).into_iter().enumerate() {
                    let next = left.get(k + 1).map_or(Extended::default(), |next| next[i].re);
                    let error = (image - Extended::exact(value.re) * functional[i] - next).to_f64();
                    assert!(error.abs() < 1e-40, "{error}");
                }
            }
        }
    }
    assert_eq!(lengths, [(1.0, 1), (0.5, 3), (0.5, 2), (0.0, 2), (0.0, 1)]);
}
/// The fraction of least denominator within rounding of a number.
fn fraction(x: f64) -> BigRational {
    let found = (1..1_000_000_i64).find_map(|q| {
        let p = (x * q as f64).round();
        ((p / q as f64 - x).abs() <= 4.0 * f64::EPSILON * x.abs())
            .then(|| BigRational::new((p as i64).into(), q.into()))
    });
    // the vectors of a rational matrix at a rational value are rational
    found.unwrap_or_else(|| panic!("{x:e} is no fraction"))
}

/// The oracle is rational arithmetic: the matrix of a crease with one face is dyadic, so are its
/// eigenvalues 1, 1/2, 1/4, 1/4 and those of the outer ring, and the chain equations and duality hold
/// exactly for the fractions that the entries round to.
#[test]
fn chains_of_a_crease_are_exact() {
    let corner = Corner::fan(1).unwrap();
    let definition = Definition::Family("catmull-clark".parse::<Spec>().unwrap());
    let scheme: Scheme<f64> = definition.around(&corner).unwrap();
    let extended: Scheme<Extended> = definition.around(&corner).unwrap();
    let rings = scheme.closed_rings().unwrap();
    let found = chains(&scheme, &extended, rings);
    assert!(
        found
            .iter()
            .any(|c| c.right.len() == 2 && (c.value.re - 0.25).abs() < 1e-15),
        "{found:?}"
    );
    let matrix = local_matrix(scheme.limit(), rings).unwrap();
    let n = matrix.rows();
    let exact = |v: &[Complex<f64>]| v.iter().map(|x| fraction(x.re)).collect::<Vec<_>>();
    let zero = || BigRational::from_float(0.0).unwrap();
    let entry = |i: usize, j: usize| BigRational::from_float(matrix[(i, j)]).unwrap();
    let (mut all_right, mut all_left) = (Vec::new(), Vec::new());
    for chain in &found {
        let (right, left): (Vec<_>, Vec<_>) = (
            chain.right.iter().map(|v| exact(v)).collect(),
            chain.left.iter().map(|v| exact(v)).collect(),
        );
        let value = fraction(chain.value.re);
        for k in 0..right.len() {
            for i in 0..n {
                let image = (0..n).fold(zero(), |sum, j| sum + entry(i, j) * &right[k][j]);
                let before = if k == 0 { zero() } else { right[k - 1][i].clone() };
                assert_eq!(image, &value * &right[k][i] + before);
                let image = (0..n).fold(zero(), |sum, j| sum + entry(j, i) * &left[k][j]);
                let next = left.get(k + 1).map_or(zero(), |next| next[i].clone());
                assert_eq!(image, &value * &left[k][i] + next);
            }
        }
        all_right.extend(right);
        all_left.extend(left);
    }
    assert_eq!(all_right.len(), n);
    for (i, l) in all_left.iter().enumerate() {
        for (j, r) in all_right.iter().enumerate() {
            let product = l.iter().zip(r).fold(zero(), |sum, (l, r)| sum + l * r);
            assert_eq!(product, BigRational::from_float(f64::from(u8::from(i == j))).unwrap());
        }
    }
}
