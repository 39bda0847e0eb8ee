//! NURSS and eigen-polyhedra at unequal knot intervals, beside HNUSS at the same ones and Catmull-Clark at
//! equal ones.

use super::chart::{chart, figure, spelled};
use super::{Run, Setting, errors_table};
use crate::error::Error;
use crate::figures::Drawing;
use crate::schemes::Tuner;
use eigenring_iga::{Options, Problem};
use eigenring_surface::{Mesh, shapes};

const VALENCES: [usize; 3] = [3, 5, 6];

/// Intervals of the spokes in turn: eigen-polyhedra exist at the first.
const SPOKES: [(&str, [f64; 2]); 2] = [("3/2 and 1", [1.5, 1.0]), ("3 and 1", [3.0, 1.0])];

/// Levels before the first: rules of NURSS and of eigen-polyhedra are stationary from then on.
const BEFORE: usize = 2;

fn study(levels: usize, spec: &'static str, title: &str, sets: usize, tuner: &Tuner<'_>) -> Result<Drawing, Error> {
    let mut table = errors_table();
    let mut panels: Vec<(usize, Vec<Run>)> = Vec::new();
    for n in VALENCES {
        let mut runs = Vec::new();
        let mut run = |mesh: &Mesh, spokes: &str, spec: &str, label: String, before: usize| -> Result<(), Error> {
            let mesh_name = format!("fan{n} spokes {spokes}");
            let setting = Setting {
                mesh_name: &mesh_name,
                mesh,
                problem: Problem::Poisson,
                solution: "exp",
                options: Options::default(),
                levels: before + levels,
            };
            let mut run = setting.run(spec, &label, runs.len(), tuner)?;
            run.dof.drain(..before);
            run.errors.drain(..before);
            setting.push(&mut table, spec, &run);
            runs.push(run);
            Ok(())
        };
        run(
            &shapes::fan(n),
            "1",
            "catmull-clark",
            "Catmull-Clark".to_owned(),
            BEFORE,
        )?;
        for (spokes, intervals) in &SPOKES[..sets] {
            let mesh = shapes::uneven_fan(n, intervals);
            run(&mesh, spokes, spec, format!("{title}, spokes {spokes}"), 0)?;
            run(&mesh, spokes, "hnuss", format!("HNUSS, spokes {spokes}"), BEFORE)?;
        }
        panels.push((n, runs));
    }
    let norms = ["L2", "H1"].into_iter();
    let charts = norms.flat_map(|name| {
        let of = move |(n, runs): &(usize, Vec<Run>)| (format!("$N$ = {n}, {}", spelled(name)), chart(runs, name));
        panels.iter().map(of).collect::<Vec<_>>()
    });
    Ok(Drawing {
        stem: format!("intervals-{spec}"),
        figure: figure(&format!("{title} at unequal knot intervals"), charts.collect()),
        data: vec![("", table)],
    })
}

pub(super) fn nurss(levels: usize, tuner: &Tuner<'_>) -> Result<Vec<Drawing>, Error> {
    Ok(vec![study(levels, "nurss", "NURSS", 2, tuner)?])
}

pub(super) fn polyhedra(levels: usize, tuner: &Tuner<'_>) -> Result<Vec<Drawing>, Error> {
    Ok(vec![study(levels, "eigen-polyhedron", "eigen-polyhedron", 1, tuner)?])
}
