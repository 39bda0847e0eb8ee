//! The lambda-scheme on surfaces: Figs. 8, 9, 11, 14 and 15 of Ma, Wang and Ma (2023) on shapes of the same
//! kinds, curvature around single centres, total curvature, and creases by low lambda (its section 5.3).

use super::{Item, picture, settings, table};
use crate::curvature::curvatures;
use crate::error::Error;
use crate::render::Show;
use crate::schemes::Tuner;
use crate::table::{Cell, Table};
use eigenring_scheme::lambda::{LambdaTable, Member, Plane};
use eigenring_surface::limit::{Kind, Surface};
use eigenring_surface::shapes::{self, StarKind};
use eigenring_surface::{Facts, Mesh, Topology};
use eigenring_tune::sweep::{Options, Problem};

/// The lambda of Ma and Ma (2019a), whose scheme is the unweighted one there.
const LAMBDA_A: f64 = 0.39;

pub(super) fn files(tuner: &Tuner<'_>) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let mut files = Vec::new();
    files.extend(models(tuner)?);
    files.extend(featured(tuner)?);
    for (name, valence, kind) in [("fig14", 5, StarKind::Saddle), ("fig15", 6, StarKind::Convex)] {
        files.extend(comparison(name, valence, kind, tuner)?);
    }
    files.push(soft_creases(tuner)?);
    files.push(centres(tuner)?);
    files.push(totals(tuner)?);
    Ok(files)
}

/// Figs. 8 and 9: closed models at values of lambda.
fn models(tuner: &Tuner<'_>) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let schemes = [
        ("λ = 0.35", "lambda:lambda=0.35"),
        ("λ_M* = 0.5", "lambda:lambda=0.5"),
        ("λ_C*", "lambda:optimal"),
        ("Catmull-Clark", "catmull-clark"),
    ];
    let row = |mesh: &Mesh| -> Result<Vec<Item>, Error> {
        schemes
            .iter()
            .map(|(caption, scheme)| Item::new(*caption, scheme, mesh))
            .collect()
    };
    let torus = row(&shapes::triple_torus())?;
    let brick = row(&shapes::brick([3, 2, 1]))?;
    let propeller = row(&shapes::propeller(5))?;
    let shaded = |zoom| settings(Show::Shaded, [-60.0, 40.0, zoom], 240, 4);
    let lines = settings(Show::Highlight, [-60.0, 40.0, 1.0], 240, 4);
    Ok(vec![
        picture("fig8-triple-torus", &torus, &shaded(1.0), tuner)?,
        picture("fig8-brick", &brick, &shaded(1.0), tuner)?,
        picture("fig9-propeller", &propeller, &lines, tuner)?,
    ])
}

/// Fig. 11: one centre of valence 7 at featured lambdas.
fn featured(tuner: &Tuner<'_>) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let star = shapes::star(7, 2, StarKind::Saddle);
    let entry = LambdaTable::embedded()?.entry(7)?;
    let best = entry.lambda_optimal;
    let between = best + 0.5 * (entry.lambda_r2 - best);
    let mut items = Vec::new();
    for (name, lambda) in [
        ("λ", 0.35),
        ("λ_A*", LAMBDA_A),
        ("λ_M*", 0.5),
        ("λ_C*", best),
        ("λ_C* + Δλ", between),
    ] {
        let scheme = format!("lambda:lambda={lambda}");
        items.push(Item::new(format!("{name} = {lambda:.4}"), &scheme, &star)?);
    }
    items.push(Item::new("Catmull-Clark", "catmull-clark", &star)?);
    let view = [-75.0, 52.0, 1.0];
    Ok(vec![
        picture("fig11-gauss", &items, &settings(Show::Gauss, view, 240, 3), tuner)?,
        picture(
            "fig11-highlight",
            &items,
            &settings(Show::Highlight, view, 240, 3),
            tuner,
        )?,
    ])
}

/// The stencil at a lambda that the unweighted objective is least for.
fn unweighted(valence: usize, lambda: f64) -> Result<Member, Error> {
    let mut options = Options::default();
    options.settings.weighted = false;
    let problem = Problem::new(valence, lambda, &options)?;
    let best = problem.search(options.starts)?;
    let plane: Plane<f64> = *problem.domain.plane();
    let lowest = best.lowest();
    Ok(Member::given(valence, lambda, Some(plane.s), [lowest.f2, lowest.f3])?)
}

/// Figs. 14 and 15: the stencil tuned at .39 without and with weight, the best one, and Catmull-Clark.
fn comparison(name: &str, valence: usize, kind: StarKind, tuner: &Tuner<'_>) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let star = shapes::star(valence, 2, kind);
    let Member { plane, f2, f3, .. } = unweighted(valence, LAMBDA_A)?;
    let plain = format!("lambda:lambda={},f2={f2},f3={f3},s={}", plane.lambda, plane.s);
    let items = [
        Item::new("λ = 0.39, no weight", &plain, &star)?,
        Item::new("λ_A* = 0.39", "lambda:lambda=0.39", &star)?,
        Item::new("λ_C*", "lambda:optimal", &star)?,
        Item::new("Catmull-Clark", "catmull-clark", &star)?,
    ];
    let view = [-75.0, 52.0, 1.0];
    let of = |what: &str| format!("{name}-n{valence}-{what}");
    Ok(vec![
        picture(&of("gauss"), &items, &settings(Show::Gauss, view, 240, 4), tuner)?,
        picture(
            &of("highlight"),
            &items,
            &settings(Show::Highlight, view, 240, 4),
            tuner,
        )?,
    ])
}

/// A box whose upper rim is tagged with low lambdas.
fn soft_creases(tuner: &Tuner<'_>) -> Result<(String, Vec<u8>), Error> {
    let roof = shapes::brick([4, 3, 2]);
    // the upper rim
    let topology = Topology::unchecked(&roof);
    let on_rim = |v: u32| {
        let p = roof.points()[v as usize];
        p.z == 2.0 && (p.x == 0.0 || p.x == 4.0 || p.y == 0.0 || p.y == 3.0)
    };
    let rim: Vec<u32> = (0..topology.vertex_count() as u32).filter(|&v| on_rim(v)).collect();
    let mut items = Vec::new();
    for lambda in [0.2, 0.3, 0.4] {
        let mut item = Item::new(format!("λ = {lambda} at the rim"), "lambda:optimal", &roof)?;
        item.lambdas = rim.iter().map(|&vertex| (vertex, lambda)).collect();
        items.push(item);
    }
    items.push(Item::new("λ_C*", "lambda:optimal", &roof)?);
    picture(
        "soft-creases",
        &items,
        &settings(Show::Shaded, [-60.0, 30.0, 1.0], 240, 4),
        tuner,
    )
}

/// Curvature around single centres of Catmull-Clark and the best stencils.
fn centres(tuner: &Tuner<'_>) -> Result<(String, Vec<u8>), Error> {
    let radii = [1e-1, 1e-3, 1e-6, 1e-12];
    let mut columns: Vec<String> = [
        "scheme",
        "valence",
        "star",
        "kind",
        "exponent",
        "gauss_min",
        "gauss_max",
        "mean_min",
        "mean_max",
    ]
    .map(str::to_owned)
    .to_vec();
    for radius in radii {
        columns.extend([format!("gauss_min@{radius:e}"), format!("gauss_max@{radius:e}")]);
    }
    let mut rows = Table::new(columns);
    for scheme in ["catmull-clark", "lambda:optimal"] {
        for valence in 3..=12 {
            for (word, kind) in [("convex", StarKind::Convex), ("saddle", StarKind::Saddle)] {
                let item = Item::new("", scheme, &shapes::star(valence, 3, kind))?;
                let rules = item.rules(tuner)?;
                let surface = Surface::new(&item.mesh, &rules)?;
                let centre = crate::curvature::at_vertex(&surface, 0)?;
                let empty = || vec![Cell::Empty; 4];
                let sample = &centre.sample;
                let ranges = match sample.kind {
                    Kind::Bounded { gauss, mean } => [gauss, mean].concat().into_iter().map(Cell::from).collect(),
                    Kind::Regular | Kind::Flat => match (sample.gauss, sample.mean) {
                        (Some(gauss), Some(mean)) => [gauss, gauss, mean, mean].map(Cell::from).to_vec(),
                        _ => empty(),
                    },
                    _ => empty(),
                };
                let exponent = match sample.kind {
                    Kind::Unbounded { exponent, .. } => Cell::from(exponent),
                    _ => Cell::Empty,
                };
                let mut row: Vec<Cell> = vec![scheme.into(), valence.into(), word.into(), sample.kind.name().into()];
                row.push(exponent);
                row.extend(ranges);
                for radius in radii {
                    let range = crate::curvature::gauss_around(&surface, &centre, radius)?;
                    row.extend(
                        range
                            .map(|range| range.map(Cell::from).to_vec())
                            .unwrap_or(vec![Cell::Empty; 2]),
                    );
                }
                rows.push(row);
            }
        }
    }
    Ok(table("curvature", &rows))
}

/// Total Gauss curvature of closed surfaces, by so many samples a side of each face and by the graded rule,
/// against 2 pi times the Euler characteristic.
fn totals(tuner: &Tuner<'_>) -> Result<(String, Vec<u8>), Error> {
    let samples = [4, 8, 16, 32];
    let mut columns: Vec<String> = ["shape", "scheme", "two_pi_chi", "graded"].map(str::to_owned).to_vec();
    columns.extend(samples.map(|n| format!("samples_{n}")));
    let mut rows = Table::new(columns);
    for (name, mesh) in [
        ("cube", shapes::cube()),
        ("propeller", shapes::propeller(5)),
        ("triple-torus", shapes::triple_torus()),
        ("spot", modelled(include_str!("../../data/meshes/spot.obj"))?),
        ("fish", modelled(include_str!("../../data/meshes/fish.obj"))?),
        ("penguin", modelled(include_str!("../../data/meshes/penguin.obj"))?),
    ] {
        for scheme in ["catmull-clark", "lambda:optimal"] {
            let item = Item::new("", scheme, &mesh)?;
            let rules = item.rules(tuner)?;
            let surface = Surface::new(&mesh, &rules)?;
            let topology = Topology::new(&mesh).map_err(eigenring_surface::Error::from)?;
            let euler = Facts::of(&mesh, &topology).euler;
            let found = curvatures(&surface, 2, Some(euler))?;
            let mut row: Vec<Cell> = vec![name.into(), scheme.into()];
            row.push(Cell::from(std::f64::consts::TAU * euler as f64));
            row.push(Cell::from(found.totals.gauss));
            for n in samples {
                row.push(Cell::from(crate::curvature::sampled_total(&surface, n)?));
            }
            rows.push(row);
        }
    }
    Ok(table("total-curvature", &rows))
}

/// A mesh that somebody modelled: `data/meshes/README.md`.
fn modelled(text: &str) -> Result<Mesh, Error> {
    let file = eigenring_surface::io::read(text.as_bytes(), eigenring_surface::io::Format::Obj)?;
    Ok(file.surface()?)
}
