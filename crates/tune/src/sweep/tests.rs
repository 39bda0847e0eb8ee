//! Sample values, and the branch across the two basins of N = 3.

use super::*;

#[test]
fn sample_values_meet_at_lambda_l() {
    for valence in [3, 4, 6, 12, 20] {
        let lambdas = sample_lambdas(valence).unwrap();
        let middle = Relaxation::new(valence).unwrap().lambda_l();
        assert_eq!(lambdas.len(), 100);
        assert_eq!((lambdas[0], lambdas[49], lambdas[99]), (0.15, middle, 0.9));
        for (i, &lambda) in lambdas.iter().enumerate() {
            let expected = if i < 50 {
                0.15 + i as f64 * (middle - 0.15) / 49.0
            } else {
                middle + (i as f64 - 49.0) * (0.9 - middle) / 50.0
            };
            assert!((lambda - expected).abs() < 1e-15);
        }
        assert!(lambdas.windows(2).all(|pair| pair[0] < pair[1]));
    }
    // lambda_l = 0.93 lies beyond the range
    let lambdas = sample_lambdas(30).unwrap();
    assert!(lambdas.len() == 100 && lambdas.windows(2).all(|pair| pair[0] < pair[1]));
    assert_eq!((lambdas[0], lambdas[99]), (0.15, 0.9));
}

#[test]
fn ranges_and_lambdas_out_of_range_are_refused() {
    let range = Range::default();
    for bad in [
        Range { start: 0.1, ..range },
        Range { end: 1.0, ..range },
        Range {
            start: 0.9,
            end: 0.15,
            ..range
        },
        Range {
            start: f64::NAN,
            ..range
        },
        Range { below: 0, ..range },
    ] {
        assert!(matches!(bad.lambdas(6), Err(Error::Range { .. })));
    }
    let options = Options::default();
    assert!(matches!(sample_lambdas(2), Err(Error::Scheme(_))));
    assert!(matches!(sample(6, f64::NAN, &options), Err(Error::Scheme(_))));
    assert!(matches!(sample(6, 0.125, &options), Err(Error::Scheme(_))));
    let margin = Options {
        margin: -1.0,
        ..options
    };
    assert!(matches!(sample(6, 0.5, &margin), Err(Error::Scheme(_))));
}

fn samples(valence: usize, start: f64, end: f64, steps: usize) -> Vec<LambdaSample> {
    let lambdas = Range {
        start,
        end,
        below: steps / 2,
        above: steps - steps / 2,
    }
    .lambdas(valence)
    .unwrap();
    let options = Options::default();
    lambdas
        .into_iter()
        .map(|lambda| sample(valence, lambda, &options).unwrap())
        .collect()
}

#[test]
fn a_sample_says_what_it_found() {
    let options = Options::default();
    let sample = sample(10, 0.5, &options).unwrap();
    let lowest = &sample.minima[0];
    assert_eq!(lowest.active, ["f3"]);
    assert_eq!(lowest.f3, 0.0);
    assert!((lowest.parts.iter().sum::<f64>() / lowest.total - 1.0).abs() < 1e-12);
    assert_eq!((sample.starts, sample.evaluations), (100, 100));
    let problem = Problem::new(10, 0.5, &options).unwrap();
    assert_eq!(problem.objective.value(lowest.f2, lowest.f3).unwrap(), lowest.total);
    assert!(lowest.theta <= problem.domain.theta_max());
}

#[test]
fn the_branch_is_continuous_where_the_lowest_minimum_jumps() {
    let samples = samples(3, 0.404, 0.70, 20);
    let options = Options::default();
    let branch = branch(&samples, 0.4112169593, 0.22014595, 0.26493829, &options).unwrap();
    assert_eq!(branch.len(), samples.len());
    for (branch, sample) in branch.iter().zip(&samples) {
        assert_eq!(branch.lambda, sample.lambda);
        assert!(!branch.jumped && branch.minimum.kkt_residual < 1e-8);
        // two basins, of equal depth at about 0.446 and 0.656
        let differs = 0.446 < branch.lambda && branch.lambda < 0.656;
        assert_eq!(branch.lowest.is_some(), differs, "lambda = {}", branch.lambda);
        if let Some(lowest) = branch.lowest {
            assert_eq!(lowest.total, sample.minima[0].total);
            assert!(lowest.total < branch.minimum.total);
        }
    }
    let moves = branch.windows(2).map(|pair| {
        let ([a, b], step) = ([&pair[0].minimum, &pair[1].minimum], pair[1].lambda - pair[0].lambda);
        (a.f2 - b.f2).abs().max((a.f3 - b.f3).abs()) / step
    });
    assert!(moves.fold(0.0, f64::max) < 1.5);
    // and from a point of the other basin it is the other branch
    let other = super::branch(&samples, 0.56, 0.1731, 0.4215, &options).unwrap();
    let end = other.iter().find(|sample| sample.lambda > 0.55).unwrap();
    assert!(end.lowest.is_none() && end.minimum.f2 < 0.18);
}

#[test]
fn a_basin_that_ends_is_marked() {
    // the basin at smaller f2 ends near 0.67
    let samples = samples(3, 0.64, 0.72, 8);
    let branch = branch(&samples, 0.648, 0.16656, 0.5142, &Options::default()).unwrap();
    let jumps: Vec<f64> = branch.iter().filter(|s| s.jumped).map(|s| s.lambda).collect();
    assert_eq!(jumps.len(), 1, "{jumps:?}");
    assert!(0.665 < jumps[0] && jumps[0] < 0.69, "{jumps:?}");
    for sample in &branch {
        assert_eq!(sample.minimum.f2 < 0.19, sample.lambda < jumps[0]);
        assert!(sample.lowest.is_none() || sample.lambda > 0.656 && sample.lambda < jumps[0]);
    }
}

#[test]
fn samples_that_do_not_belong_together_are_refused() {
    let options = Options::default();
    let samples = samples(5, 0.5, 0.6, 4);
    let swapped: Vec<_> = samples.iter().rev().cloned().collect();
    assert!(matches!(
        branch(&swapped, 0.55, 0.27, 0.21, &options),
        Err(Error::Samples { index: 1, .. })
    ));
    let mut empty = samples.clone();
    empty[2].minima.clear();
    assert!(matches!(
        branch(&empty, 0.55, 0.27, 0.21, &options),
        Err(Error::Samples { index: 2, .. })
    ));
    assert!(matches!(
        branch(&samples, 0.55, f64::NAN, 0.21, &options),
        Err(Error::Search(_))
    ));
}
