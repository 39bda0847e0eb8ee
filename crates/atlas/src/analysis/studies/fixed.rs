//! Errors against lambda at fixed levels.
//!
//! The setting: Poisson's equation, `e^((x+y)/2)`, fans, tuned stencils of the lambda-scheme, relative
//! errors. It is no published study.

use super::chart::figure;
use super::with;
use crate::error::Error;
use crate::figures::Drawing;
use crate::progress::{Silent, each};
use crate::schemes::Tuner;
use crate::table::{Cell, Table};
use eigenring_figure::{Axis, Chart, Colour, Dash, Marker, Stroke, Style, decades_of};
use eigenring_iga::{Domain, Options, Outcome, Problem, solution};
use eigenring_surface::shapes;

const VALENCES: [usize; 9] = [3, 5, 6, 7, 8, 9, 10, 11, 12];
/// Values of lambda: from this one, in steps, so many.
const FROM: f64 = 0.21;
const STEP: f64 = 0.02;
const COUNT: usize = 21;

fn outcomes(n: usize, spec: &str, levels: usize, tuner: &Tuner<'_>) -> Result<(f64, Vec<Outcome>), Error> {
    let u = solution::named("exp").expect("a name of the library");
    with(&shapes::fan(n), spec, Domain::Planar, tuner, |study| {
        let level = |level| study.level(level, Problem::Poisson, &u, &Options::default());
        let all = (0..levels).map(level).collect::<Result<_, _>>()?;
        Ok((study.lambdas.first().map_or(f64::NAN, |(_, lambda)| *lambda), all))
    })
}

pub(super) fn against_lambda(levels: usize, tuner: &Tuner<'_>) -> Result<Vec<Drawing>, Error> {
    let mut table = Table::new(["valence", "scheme", "lambda", "level", "L2", "H1", "Linf", "H2"]);
    let mut panels = Vec::new();
    for n in VALENCES {
        let tuned = (0..COUNT).map(|k| format!("lambda:lambda={:.2}", FROM + k as f64 * STEP));
        let others = ["lambda:optimal", "catmull-clark"].map(str::to_owned);
        let specs: Vec<String> = tuned.chain(others).collect();
        let found = each(&Silent, "values", &specs, |spec| outcomes(n, spec, levels, tuner))?;
        let relative = |outcome: &Outcome| {
            let (e, u) = (outcome.error, outcome.norm);
            [e.l2 / u.l2, e.h1 / u.h1, e.linf / u.linf, e.h2 / u.h2]
        };
        for (spec, (lambda, outcomes)) in specs.iter().zip(&found) {
            for (level, outcome) in outcomes.iter().enumerate() {
                let mut row: Vec<Cell> = vec![n.into(), spec.as_str().into(), (*lambda).into(), level.into()];
                row.extend(relative(outcome).map(Cell::from));
                table.push(row);
            }
        }
        let value = |(lambda, outcomes): &(f64, Vec<Outcome>), level: usize| [*lambda, relative(&outcomes[level])[0]];
        // the first levels are too coarse for a fan of two faces
        let shown = || (levels.saturating_sub(3)..levels).map(|level| (level, Marker::line(level)));
        let all = found
            .iter()
            .flat_map(|one| shown().map(move |(level, _)| value(one, level)[1]));
        let (low, high) = decades_of(all).unwrap_or((1e-9, 1.0));
        let mut chart = Chart::new(
            Axis::new("$λ$", (0.2, 0.65)),
            Axis::log("relative error in $L^2$", (low, high)).with_grid(),
        );
        let optimal = found[COUNT].0;
        let dashed = Stroke {
            dash: Dash::Dashed,
            ..Stroke::solid(Colour::INK, 0.2)
        };
        chart = chart.vertical(optimal, "$λ_C^*$", dashed);
        for (place, (level, marker)) in shown().enumerate() {
            let points = found[..COUNT].iter().map(|one| value(one, level));
            let colour = Colour::line(place);
            let style = Style::solid(colour).marked(marker);
            chart = chart
                .series(points.collect::<Vec<_>>(), style)
                .label(format!("level {level}"));
        }
        panels.push((format!("$N$ = {n}"), chart));
    }
    Ok(vec![Drawing {
        stem: "lambda".to_owned(),
        figure: figure("Errors against lambda", panels),
        data: vec![("", table)],
    }])
}
