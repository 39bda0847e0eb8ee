//! Natural configurations: the control nets of characteristic maps (Ma, Wang and Ma 2023, Fig. 10).
//!
//! Valences stand in columns; the rows are schemes, or lambdas in ascending order. All nets have the same
//! number of rings and are drawn to the same size, so that pictures show how points crowd toward the centre
//! (small lambda) or away from it; where many sectors crowd, radii are logarithmic, which the title says.

use super::grid::{Grid, NARROWEST, narrowest};
use super::nets::NaturalNet;
use super::subject::{Subject, chosen, featured, tell};
use super::{Drawing, FigureEntry, Inputs, uneven};
use crate::error::Error;
use eigenring_figure::{Figure, Panel};

pub const ENTRY: FigureEntry = FigureEntry {
    valences: &[5, 8, 11],
    schemes: Some(&[]),
    knots: true,
    ..FigureEntry::new(
        "natural-configurations",
        "control nets of the characteristic maps; columns: valences, rows: lambdas or schemes",
        "Ma, Wang and Ma 2023, Fig. 10",
        build,
    )
};

/// Rings of the nets.
const RINGS: usize = 3;
/// The most a panel is wide and high, in millimetres: five fit a page.
const SIDE: f64 = 38.0;

fn build(inputs: &Inputs<'_>) -> Result<Vec<Drawing>, Error> {
    if let Some(spokes) = inputs.knots {
        return uneven::control_nets(&ENTRY, inputs, spokes);
    }
    let columns = inputs.valences.iter().map(|&valence| match inputs.schemes {
        [] => featured(inputs, valence),
        _ => chosen(inputs, valence),
    });
    let columns: Vec<Vec<Subject>> = columns.collect::<Result<_, _>>()?;
    let rows = columns.iter().map(Vec::len).max().unwrap_or(0);
    let of = |subject: &Subject| NaturalNet::new(&subject.scheme, RINGS);
    let nets = columns.iter().map(|subjects| subjects.iter().map(of).collect());
    let nets: Vec<Vec<NaturalNet>> = nets.collect::<Result<_, Error>>()?;
    let each = || columns.iter().flatten().zip(nets.iter().flatten());
    let title = |subject: &Subject, net: &NaturalNet| subject.full_title() + net.readable().1;
    let narrowest = narrowest(each().map(|(subject, net)| title(subject, net)), NARROWEST);
    let grid = Grid::new(rows, columns.len(), inputs.width, 0.0, narrowest);
    let height = grid.height(grid.across.min(SIDE));
    let mut figure = Figure::new(inputs.width, height, "Natural configurations");
    let mut table = NaturalNet::table(&["scheme", "valence", "lambda"]);
    for (column, (subjects, nets)) in columns.iter().zip(&nets).enumerate() {
        for (row, (subject, net)) in subjects.iter().zip(nets).enumerate() {
            let of = [subject.name.as_str().into(), subject.valence.into(), net.lambda.into()];
            net.push(&mut table, &of);
            let (at_row, at_column) = grid.place(row, column);
            let panel = Panel::new(net.readable().0.chart()).title(title(subject, net));
            figure = figure.panel(at_row, at_column, panel);
        }
    }
    tell(columns.iter().flatten(), &mut table, inputs.tuner.progress);
    Ok(vec![Drawing::of(&ENTRY, figure, table)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::Studies;
    use crate::progress::Silent;
    use crate::schemes::Tuner;
    use eigenring_figure::Width;
    use eigenring_scheme::{PointNet, Spec, refine};

    #[test]
    fn a_natural_configuration_refined_is_itself_times_lambda() {
        for spec in [
            "catmull-clark",
            "doo-sabin",
            "tension:order=8",
            "lambda:optimal",
            "lambda:lambda=0.8",
        ] {
            for valence in [3, 4, 5, 20] {
                let scheme = spec.parse::<Spec>().unwrap().scheme::<f64>(valence).unwrap();
                let net = NaturalNet::new(&scheme, RINGS + 1).unwrap();
                let numbering = scheme.numbering(net.points.iter().map(|(ring, _)| *ring).max().unwrap());
                let points = net.points.iter().map(|(_, point)| *point).collect();
                let refined = refine(scheme.limit(), &PointNet { numbering, points }, &numbering.sites()).unwrap();
                for (fine, (_, coarse)) in refined.iter().zip(&net.points) {
                    for axis in 0..2 {
                        assert!(
                            (fine[axis] - net.lambda * coarse[axis]).abs() < 1e-10,
                            "{spec} {valence}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn rows_are_ascending_lambdas_also_where_the_optimum_is_small() {
        let studies = Studies::load(None, &[], &Silent).unwrap();
        let inputs = Inputs {
            valences: &[3, 5],
            lambdas: &[],
            schemes: &[],
            colours: None,
            range: (0.15, 0.9),
            width: Width::Two,
            sweep: None,
            knots: None,
            studies: &studies,
            tuner: &Tuner::default(),
        };
        let drawings = build(&inputs).unwrap();
        let csv = drawings[0].data[0].1.render(crate::table::Format::Csv);
        let rows: Vec<Vec<&str>> = csv
            .lines()
            .skip(1)
            .map(|line| line.split(',').rev().collect())
            .collect();
        for (valence, points) in [("3", 1 + 12 * 3), ("5", 1 + 12 * 5)] {
            let lambdas: Vec<f64> = rows
                .iter()
                .filter(|r| r[4] == valence)
                .map(|r| r[3].parse().unwrap())
                .collect();
            assert_eq!(lambdas.len(), 5 * points);
            assert!(lambdas.is_sorted());
        }
        // at valence 3 the optimum lies below lambda_M* = 0.5
        let third = featured(&inputs, 3).unwrap().remove(2);
        assert_eq!(third.title, "$λ_C^*$ = 0.4112");
    }
}
