//! What it costs to keep eigenvalues apart and curvatures of one sign.
//!
//! Three things are wanted of a stencil with bounded curvature: a small objective E, a next eigenvalue
//! lambda_6 well below mu (the margin `1 - |lambda_6|/mu`), and no second-order map with a Gauss curvature of
//! the wrong sign (K_m, Ma, Wang and Ma 2023, Eq. 33). Stencils are tuned over lambda with demanded margins
//! and with weights of the sign that are none, the paper's and a larger one; those remain that no other one
//! beats in all three (the Pareto front).

use crate::error::Error;
use crate::progress::{Progress, each};
use crate::table::{Format, Table};
use eigenring_figure::{Axis, Chart, Figure, Panel, Side, Style, Width, decades_of, range_of};
use eigenring_scheme::lambda::{Bounds, Relaxation};
use eigenring_tune::objective::{Objective, Settings};
use eigenring_tune::search::Starts;
use eigenring_tune::sweep::{Options, Problem};

const VALENCES: [usize; 4] = [5, 6, 7, 8];

/// Steps of lambda, from the end of the relaxation, where s is 1, to the end of the tables.
const LAMBDAS: usize = 80;
const END: f64 = 0.9;

/// Demanded margins: that of the tables, then twentieths.
const MARGINS: usize = 20;

/// The weight's n: none, the paper's, a larger one.
const WEIGHTS: [f64; 3] = [1.0, 5.0, 25.0];

/// A tuned stencil and the three things that are wanted of it.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    lambda: f64,
    f2: f64,
    f3: f64,
    /// The weight's n it was tuned with.
    n: f64,
    /// The paper's objective.
    objective: f64,
    margin: f64,
    sign_change: f64,
}

impl Candidate {
    /// What is wanted, each smaller the better, to the six digits to which a tuned stencil has it.
    fn wanted(&self) -> [f64; 3] {
        [self.objective, -self.margin, self.sign_change].map(|value| format!("{value:.5e}").parse().unwrap_or(value))
    }

    /// Whether it is as good in everything and better in something.
    fn beats(&self, other: &Self) -> bool {
        let (own, others) = (self.wanted(), other.wanted());
        own != others && own.iter().zip(&others).all(|(own, others)| own <= others)
    }
}

/// The stencils of one valence and lambda, for all margins and weights that admit any.
fn candidates(valence: usize, lambda: f64) -> Result<Vec<Candidate>, Error> {
    let plane = Relaxation::new(valence)?.plane(lambda)?;
    let paper = Objective::new(plane, Settings::default())?;
    let mut found = Vec::new();
    for n in WEIGHTS {
        for step in 0..MARGINS {
            let options = Options {
                margin: (step as f64 / MARGINS as f64).max(Options::default().margin),
                settings: Settings {
                    n,
                    ..Settings::default()
                },
                ..Options::default()
            };
            // a margin that leaves nothing admissible, or nothing that does not fold
            let Ok(problem) = Problem::on_plane(plane, &options) else {
                continue;
            };
            let Ok(search) = problem.search(Starts::Grid) else {
                continue;
            };
            let best = search.lowest();
            let Ok(parts) = paper.parts(best.f2, best.f3) else {
                continue;
            };
            let slack = plane.slack(Bounds::Paper, 0.0, best.f2, best.f3).into_iter();
            let room = slack.filter(|(constraint, _)| constraint.is_eigenvalue_bound());
            found.push(Candidate {
                lambda,
                f2: best.f2,
                f3: best.f3,
                n,
                objective: parts.total(),
                margin: room.map(|(_, slack)| slack).fold(f64::INFINITY, f64::min) / plane.mu(),
                sign_change: parts.sign_change(),
            });
        }
    }
    Ok(found)
}

/// Those that no other one beats, by falling margin; of equally good ones the first.
fn front(mut all: Vec<Candidate>) -> Vec<Candidate> {
    all.sort_by(|a, b| {
        let [a_wanted, b_wanted] = [a, b].map(Candidate::wanted);
        let by = |i: usize| a_wanted[i].total_cmp(&b_wanted[i]);
        by(1).then(by(0)).then(by(2)).then(a.lambda.total_cmp(&b.lambda))
    });
    all.dedup_by(|later, earlier| later.wanted() == earlier.wanted());
    let beaten: Vec<bool> = all.iter().map(|own| all.iter().any(|other| other.beats(own))).collect();
    all.into_iter()
        .zip(beaten)
        .filter(|(_, beaten)| !beaten)
        .map(|(own, _)| own)
        .collect()
}

pub(super) fn files(progress: &dyn Progress) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let mut items = Vec::new();
    for valence in VALENCES {
        let start = Relaxation::new(valence)?.ramp_end();
        items.extend((0..=LAMBDAS).map(|i| (valence, start + (END - start) * i as f64 / LAMBDAS as f64)));
    }
    let found = each(progress, "lambdas", &items, |&(valence, lambda)| {
        candidates(valence, lambda)
    })?;
    let mut fronts = Vec::new();
    for valence in VALENCES {
        let own = items.iter().zip(&found).filter(|((n, _), _)| *n == valence);
        fronts.push((
            valence,
            front(own.flat_map(|(_, found)| found.iter().copied()).collect()),
        ));
    }
    Ok(vec![
        ("margin.csv".into(), table(&fronts).render(Format::Csv).into_bytes()),
        ("margin.png".into(), figure(&fronts).png(300.0)?),
    ])
}

fn table(fronts: &[(usize, Vec<Candidate>)]) -> Table {
    let mut table = Table::new(["valence", "lambda", "f2", "f3", "n", "E", "margin", "K_m"]);
    for (valence, front) in fronts {
        for c in front {
            let numbers = [c.lambda, c.f2, c.f3, c.n, c.objective, c.margin, c.sign_change];
            table.push(
                std::iter::once((*valence).into())
                    .chain(numbers.map(Into::into))
                    .collect(),
            );
        }
    }
    table
}

/// The least E with at least a margin, for all stencils and for those without wrong signs.
fn figure(fronts: &[(usize, Vec<Candidate>)]) -> Figure {
    let values = fronts.iter().flat_map(|(_, front)| front.iter().map(|c| c.objective));
    // what lies a hundred thousand times above the least is of no use to anybody
    let least = values.clone().fold(f64::INFINITY, f64::min);
    let range = decades_of(values.filter(|value| *value < 1e5 * least)).unwrap_or((1.0, 10.0));
    let margins = fronts.iter().flat_map(|(_, front)| front.iter().map(|c| c.margin));
    let margins = range_of(margins, 0.05).unwrap_or((0.0, 1.0));
    let mut whole = Figure::new(
        Width::Two,
        124.0,
        "The least objective against the margin of the next eigenvalue",
    );
    for (index, (valence, front)) in fronts.iter().enumerate() {
        let axis = Axis::new("$1 - |λ_6|/μ$", margins).with_grid();
        let mut chart = Chart::new(axis, Axis::log("$E$", range).with_grid());
        for (label, colour, signless) in [("any sign of curvature", 0, false), ("$K_m = 0$", 1, true)] {
            // by falling margin, so that the least so far is the least with at least this margin
            let mut lowest = f64::INFINITY;
            let mut points = Vec::new();
            for c in front.iter().filter(|c| !signless || c.sign_change == 0.0) {
                if c.objective < lowest {
                    lowest = c.objective;
                    points.push([c.margin, lowest]);
                }
            }
            chart = chart.series(points, Style::line(colour)).label(label);
        }
        let panel = Panel::new(chart).title(format!("$N$ = {valence}")).legend(Side::Bottom);
        whole = whole.panel(index / 2, index % 2, panel);
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_front_has_all_that_nothing_beats() {
        let candidate = |objective, margin, sign_change| Candidate {
            lambda: 0.6,
            f2: 0.3,
            f3: 0.1,
            n: 5.0,
            objective,
            margin,
            sign_change,
        };
        let all = vec![
            candidate(1.0, 0.1, 0.0),
            candidate(2.0, 0.1, 0.0),
            candidate(2.0, 0.2, 0.0),
            candidate(0.5, 0.1, 1.0),
            candidate(0.6, 0.05, 1.0),
        ];
        let front = front(all);
        let kept: Vec<[f64; 3]> = front.iter().map(|c| [c.objective, c.margin, c.sign_change]).collect();
        assert_eq!(kept, [[2.0, 0.2, 0.0], [0.5, 0.1, 1.0], [1.0, 0.1, 0.0]]);
    }
}
