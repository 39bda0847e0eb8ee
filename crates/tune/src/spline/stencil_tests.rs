//! Both functions: planted kinks, and feasibility along all lambda.

use super::tests::{KNOTS, grid, lambdas};
use super::*;
use eigenring_scheme::lambda::{self as scheme, Domain, LambdaKnots, Relaxation};

#[test]
fn kinks_are_found_and_chosen() {
    let base: Vec<f64> = lambdas(&KNOTS);
    // planted kinks at two samples, with labels that change there; a third change without a kink
    let (kink_b, kink_d) = (base[20], base[75]);
    let function = |lambda: f64, t: f64| {
        t * lambda * lambda + 0.3 * (lambda - kink_b).max(0.0) - t * (lambda - kink_d).max(0.0)
            + 0.2 * (lambda - KNOTS.c).max(0.0)
    };
    let stencil: Vec<StencilSample> = base
        .iter()
        .map(|&lambda| StencilSample {
            lambda,
            f2: function(lambda, 0.5),
            f3: function(lambda, -0.8),
            active: u32::from(lambda > kink_b) + 2 * u32::from(lambda > kink_d) + 4 * u32::from(lambda > 0.8),
            weights: [1.0; 2],
        })
        .collect();
    let optimum = (0.6, function(0.6, 0.5), function(0.6, -0.8));
    let choice = choose_knots(&stencil, (KNOTS.a, KNOTS.e), KNOTS.c, optimum, &[0.27, KNOTS.c]).unwrap();
    assert_eq!((choice.knots.b, choice.knots.d), (kink_b, kink_d));
    assert_eq!(choice.kinks, [true; 3]);
    assert!(choice.residual < 1e-14);
    let find = |lambda: f64| choice.candidates.iter().find(|c| c.lambda == lambda);
    assert_eq!(find(base[76]).unwrap().source, Source::ActiveSet { here: 3, there: 1 });
    assert_eq!(find(0.27).unwrap().source, Source::Analytic);
    assert_eq!(find(0.25).unwrap().source, Source::Default);
    assert!(find(KNOTS.c).is_none());
    assert!(find(0.27).unwrap().residual.unwrap() > 1e-6);
    assert!(find(kink_b).unwrap().residual.unwrap() < 1e-14);
    assert!(
        choice
            .candidates
            .iter()
            .all(|c| (c.slot == Slot::B) == (c.lambda < KNOTS.c))
    );

    // nothing changes: defaults, also where lambda_l is above all of them
    for lambda_l in [0.3536, 0.8643] {
        let knots = LambdaKnots { c: lambda_l, ..KNOTS };
        let stencil: Vec<StencilSample> = lambdas(&knots)
            .into_iter()
            .map(|lambda| StencilSample {
                lambda,
                f2: lambda.sin(),
                f3: lambda.cos(),
                active: 0,
                weights: [1.0; 2],
            })
            .collect();
        let optimum = (0.6, 0.6_f64.sin(), 0.6_f64.cos());
        let choice = choose_knots(&stencil, (0.15, 0.9), lambda_l, optimum, &[]).unwrap();
        assert_eq!(choice.kinks, [false, true, false]);
        assert!([0.2, 0.25, 0.3].contains(&choice.knots.b) || lambda_l > 0.5);
        assert!(choice.knots.knots().is_ok());
    }
    assert!(matches!(
        choose_knots(&stencil[..8], (0.15, 0.9), 0.3536, optimum, &[]),
        Err(FitError::NoKnots { .. })
    ));
}

/// The feasible domain with a relative margin.
struct Feasible {
    valence: usize,
    margin: f64,
}

impl StencilBounds for Feasible {
    type Domain = Domain;
    fn domain(&self, lambda: f64) -> Domain {
        let plane = Relaxation::new(self.valence).unwrap().plane(lambda).unwrap();
        Domain::new(plane, scheme::Bounds::Paper, self.margin).unwrap()
    }
    fn f3(&self, domain: &Domain) -> Band {
        let [lower, upper] = domain.f3_range().map(|end| end.f3);
        Band { lower, upper }
    }
    fn f2(&self, domain: &Domain, f3: f64) -> Band {
        let interval = domain.f2_intervals(f3)[0];
        Band {
            lower: interval.lower.f2,
            upper: interval.upper.f2,
        }
    }
}

#[test]
fn stencils_stay_feasible_along_all_lambda() {
    for (valence, lambda_b, lambda_d) in [
        (5, 0.25, 0.3973),
        (8, 0.301, 0.55),
        (12, 0.2, 0.7768),
        (20, 0.3, 0.8721),
    ] {
        let relaxation = Relaxation::new(valence).unwrap();
        let knots = LambdaKnots {
            a: 0.15,
            b: lambda_b,
            c: relaxation.lambda_l(),
            d: lambda_d,
            e: 0.9,
            singles: LambdaKnots::SINGLES,
        };
        // the wish: smooth, and outside of the domain at many lambdas; the samples are the nearest feasible
        // stencils
        let inner = Feasible { valence, margin: 2e-6 };
        let nearest = |lambda: f64| {
            let domain = inner.domain(lambda);
            let band = inner.f3(&domain);
            let f3 = (0.9 * (lambda - 0.5)).max(band.lower).min(band.upper);
            let band = inner.f2(&domain, f3);
            let f2 = (0.75 - 0.75 * lambda).max(band.lower).min(band.upper);
            (f2, f3)
        };
        let samples: Vec<StencilSample> = lambdas(&knots)
            .into_iter()
            .map(|lambda| {
                let (f2, f3) = nearest(lambda);
                let wish = (0.75 - 0.75 * lambda, 0.9 * (lambda - 0.5));
                let active = u32::from(f2 != wish.0) + 2 * u32::from(f3 != wish.1);
                StencilSample {
                    lambda,
                    f2,
                    f3,
                    active,
                    weights: [1.0; 2],
                }
            })
            .collect();
        let (f2, f3) = nearest(0.7);
        let optimum = (0.7, f2, f3);
        let mut dense = grid(1000);
        dense.extend(relaxation.kinks());
        dense.retain(|&lambda| (0.15..=0.9).contains(&lambda));
        let bounds = Feasible { valence, margin: 1e-6 };
        let fit = fit_stencils(&knots, [true; 3], &samples, &[optimum], &dense, &bounds).unwrap();
        for f in [&fit.f2, &fit.f3] {
            assert!(f.kkt.worst() < 1e-12, "N = {valence}: {:?}", f.kkt);
        }
        assert!((fit.f2.spline.value(0.7).unwrap() - f2).abs() < 1e-13);
        assert!((fit.f3.spline.value(0.7).unwrap() - f3).abs() < 1e-13);
        for &lambda in &dense {
            let [f2, f3] = [&fit.f2, &fit.f3].map(|f| f.spline.value(lambda).unwrap());
            let domain = bounds.domain(lambda);
            let band = bounds.f3(&domain);
            assert!(
                f3 >= band.lower - 1e-13 && f3 <= band.upper + 1e-13,
                "N = {valence}, f3({lambda})"
            );
            let band = bounds.f2(&domain, f3.clamp(band.lower, band.upper));
            assert!(
                f2 >= band.lower - 1e-13 && f2 <= band.upper + 1e-13,
                "N = {valence}, f2({lambda})"
            );
        }
        let choice = choose_knots(
            &samples,
            (0.15, 0.9),
            relaxation.lambda_l(),
            optimum,
            &relaxation.kinks(),
        )
        .unwrap();
        assert!(choice.residual.is_finite() && choice.candidates.len() >= 3);
    }
}
