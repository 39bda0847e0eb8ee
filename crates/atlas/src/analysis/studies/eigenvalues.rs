//! Errors of eigenvalues.

use super::chart::figure;
use super::{SCHEMES, with};
use crate::error::Error;
use crate::figures::Drawing;
use crate::schemes::Tuner;
use crate::table::Table;
use eigenring_figure::{Anchor, Axis, Chart, Colour, Dash, Marker, Style, decades_of};
use eigenring_iga::{Domain, Ends, Membrane, Options, Problem};
use eigenring_surface::shapes;
use std::f64::consts::PI;

pub(super) fn spectra(levels: usize, tuner: &Tuner<'_>) -> Result<Vec<Drawing>, Error> {
    let mut table = Table::new([
        "domain",
        "scheme",
        "level",
        "dof",
        "eigenvalue",
        "value",
        "exact",
        "relative error",
        "rate",
    ]);
    let mut panels = Vec::new();
    let triangle = 16.0 * PI * PI / 27.0;
    for (name, title, mesh, domain, index, exact) in [
        (
            "triangle",
            "triangle, first eigenvalue",
            shapes::fan(3),
            Domain::Planar,
            1,
            triangle,
        ),
        (
            "sphere",
            "sphere, $l$ = 2, the largest",
            shapes::cube(),
            Domain::Sphere,
            8,
            6.0,
        ),
    ] {
        let mut found: Vec<(usize, &str, Vec<[f64; 2]>, f64)> = Vec::new();
        for (place, (spec, label)) in SCHEMES.into_iter().enumerate() {
            let (points, h1) = with(&mesh, spec, domain, tuner, |study| {
                let mut points: Vec<[f64; 2]> = Vec::new();
                // levels of closed meshes are counted from the cube
                for level in study.steps.max(1)..levels.max(2) + study.steps.min(1) {
                    let options = Options {
                        gauss: 6,
                        ..Options::default()
                    };
                    let spectrum = study.spectrum(level - study.steps, Membrane::Free, 9, &options)?;
                    let value = spectrum.eigenvalues[index];
                    let off = (value / exact - 1.0).abs();
                    let rate = points.last().map(|[_, before]| (before / off).log2());
                    table.push(vec![
                        name.into(),
                        spec.into(),
                        level.into(),
                        spectrum.dof.into(),
                        index.into(),
                        value.into(),
                        exact.into(),
                        off.into(),
                        rate.into(),
                    ]);
                    points.push([0.5_f64.powi(level as i32), off]);
                }
                Ok((points, study.predicted(Problem::Poisson, Ends::Open)[1].unwrap_or(0.0)))
            })?;
            found.push((place, label, points, 2.0 * h1));
        }
        let all = || found.iter().flat_map(|(_, _, points, _)| points.iter().copied());
        let (low, high) = decades_of(all().map(|[_, off]| off)).unwrap_or((1e-12, 1.0));
        let least = all().map(|[h, _]| h).fold(1.0, f64::min);
        let mut chart = Chart::new(
            Axis::log("$h$", (least / 1.3, 0.65)),
            Axis::log("relative error", (low / 1e3, high)).with_grid(),
        );
        for (place, label, points, _) in &found {
            let style = Style::solid(Colour::line(*place)).marked(Marker::line(*place));
            chart = chart.series(points.clone(), style).label(*label);
        }
        let mut rates: Vec<f64> = found.iter().map(|(.., rate)| *rate).collect();
        rates.sort_by(f64::total_cmp);
        rates.dedup_by(|a, b| (*a - *b).abs() < 0.6);
        for rate in rates {
            let (foot, top) = (low / 3e2, low / 3e2 * 4.0_f64.powf(rate));
            let stroke = Style::solid(Colour::INK).dashed(Dash::Dashed);
            chart = chart.series(vec![[least, foot], [4.0 * least, top]], stroke).text(
                [4.3 * least, top],
                format!("{rate:.2}"),
                Anchor::Start,
                Colour::INK,
            );
        }
        panels.push((title.to_owned(), chart));
    }
    Ok(vec![Drawing {
        stem: "spectra".to_owned(),
        figure: figure("Errors of eigenvalues", panels),
        data: vec![("", table)],
    }])
}
