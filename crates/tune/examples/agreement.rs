//! x
use eigenring_scheme::lambda::{Bounds, Domain, Relaxation};
use eigenring_tune::objective::{Objective, Settings};
use eigenring_tune::search::{Starts, search};
use std::time::Instant;

fn main() {
    let arg: Vec<usize> = std::env::args().skip(1).map(|a| a.parse().unwrap()).collect();
    let step = *arg.get(2).unwrap_or(&1);
    for n in arg[0]..=arg[1] {
        let rule = Relaxation::new(n).unwrap();
        let l = rule.lambda_l();
        let mut worst = 0.0_f64;
        let (mut t_grid, mut t_full, mut evals, mut grads, mut desc, mut fgrads, mut kkt, mut kktf, mut maxmin) =
            (0.0, 0.0, 0, 0, 0, 0, 0.0_f64, 0.0_f64, 0);
        let mut count = 0;
        for i in (0..100).step_by(step) {
            let lambda = if i < 50 {
                0.15 + i as f64 * (l - 0.15) / 49.0
            } else {
                l + (i - 49) as f64 * (0.9 - l) / 50.0
            };
            let plane = rule.plane(lambda).unwrap();
            let domain = Domain::new(plane, Bounds::Paper, 2e-6).unwrap();
            let t = Instant::now();
            let objective = Objective::new(plane, Settings::default()).unwrap();
            let grid = search(&objective, &domain, Starts::Grid).unwrap();
            t_grid += t.elapsed().as_secs_f64();
            let t = Instant::now();
            let full = search(&objective, &domain, Starts::Full).unwrap();
            t_full += t.elapsed().as_secs_f64();
            count += 1;
            evals += grid.evaluations;
            grads += grid.gradient_evaluations;
            desc += grid.descents;
            fgrads += full.gradient_evaluations;
            let (a, b) = (grid.lowest().total, full.lowest().total);
            let d = (a - b) / b;
            worst = worst.max(d);
            kkt = grid.optima.iter().map(|o| o.kkt_residual).fold(kkt, f64::max);
            kktf = full.optima.iter().map(|o| o.kkt_residual).fold(kktf, f64::max);
            maxmin = maxmin.max(full.optima.len());
            if d > 1e-9 || full.optima.len() > 1 || full.optima.iter().any(|o| o.kkt_residual > 1e-7) {
                println!(
                    "N {n} lambda {lambda:.5} diff {d:.1e} grid {} full {} :",
                    grid.optima.len(),
                    full.optima.len()
                );
                for o in full.optima.iter().take(6) {
                    println!(
                        "     {:.9} {:.9} {:.12} {:?} {:.1e}",
                        o.f2,
                        o.f3,
                        o.total,
                        o.active_names(),
                        o.kkt_residual
                    );
                }
            }
        }
        let c = count as f64;
        println!(
            "== N {n}: worst {worst:.1e} kkt {kkt:.1e} full {kktf:.1e} maxmin {maxmin} ms/lambda {:.2} full {:.2} evals {:.0} descents {:.2} grads/descent {:.1} full {:.1}",
            t_grid * 1e3 / c,
            t_full * 1e3 / c,
            evals as f64 / c,
            desc as f64 / c,
            grads as f64 / desc as f64,
            fgrads as f64 / c / 100.0
        );
    }
}
