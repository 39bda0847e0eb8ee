//! The tension scheme on surfaces: Figs. 1, 2, 4, 6, 8 and 9 of Fang, Ma and Wang on shapes of the same
//! kinds, and the spectra of features in even orders.

use super::{Item, drawn, picture, settings, table};
use crate::error::Error;
use crate::grids::{self, Named, Shown};
use crate::render::{Show, Subject};
use crate::schemes::{SchemeName, Tuner};
use crate::spectrum::Analysis;
use crate::table::{Cell, Table};
use eigenring_scheme::Corner;
use eigenring_surface::features::INFINITE;
use eigenring_surface::{Boundary, Mesh, shapes};

type File = (String, Vec<u8>);

pub(super) fn files(tuner: &Tuner<'_>) -> Result<Vec<File>, Error> {
    Ok(vec![
        levels()?,
        revolutions()?,
        orders("fig4-propeller", &shapes::propeller(5), [-60.0, 45.0, 1.0], tuner)?,
        orders("fig6-tetrahedron", &shapes::tetrahedron(), [-60.0, 25.0, 1.0], tuner)?,
        features(tuner)?,
        steps(tuner)?,
        boundaries(tuner)?,
        spectra(tuner)?,
    ])
}

/// Fig. 1: the control mesh, two levels, the limit.
fn levels() -> Result<File, Error> {
    let grid = Named::FangFig1.grid([None, None], None, None)?.grid;
    let mut subjects = Vec::new();
    for level in 0..3 {
        let caption = if level == 0 {
            "control mesh".to_owned()
        } else {
            format!("level {level}")
        };
        subjects.push((caption, Subject::Faces(grids::mesh(&grid, Shown::Levels(level))?)));
    }
    subjects.push(("limit".to_owned(), Subject::Fine(grids::mesh(&grid, Shown::Limit(24))?)));
    drawn(
        "fig1-levels",
        &subjects,
        &settings(Show::Shaded, [-60.0, 28.0, 1.0], 240, 4),
    )
}

/// Fig. 2: surfaces of revolution, sweeps and grids by name, each at a scale of its own.
fn revolutions() -> Result<File, Error> {
    let mut subjects = Vec::new();
    for named in Named::ALL {
        let grid = named.grid([None, None], None, None)?.grid;
        let mut mesh = grids::mesh(&grid, Shown::Limit(16))?;
        // all of one size
        let (low, high) = mesh
            .points()
            .iter()
            .fold(([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]), |(low, high), p| {
                (
                    [0, 1, 2].map(|k| p[k].min(low[k])),
                    [0, 1, 2].map(|k| p[k].max(high[k])),
                )
            });
        let size: f64 = (0..3).map(|k| (high[k] - low[k]).powi(2)).sum::<f64>().sqrt();
        for point in mesh.points_mut() {
            (0..3).for_each(|k| point[k] = (point[k] - 0.5 * (low[k] + high[k])) / size);
        }
        subjects.push((named.name().to_owned(), Subject::Fine(mesh)));
    }
    drawn(
        "fig2-exact",
        &subjects,
        &settings(Show::Shaded, [-60.0, 28.0, 1.0], 180, 6),
    )
}

/// Figs. 4 and 6: orders and tensions.
fn orders(name: &str, mesh: &Mesh, view: [f64; 3], tuner: &Tuner<'_>) -> Result<File, Error> {
    let mut items = Vec::new();
    for u0 in ["0.3", "1", "5"] {
        for order in 3..=8 {
            items.push(Item::new(
                format!("order {order}, u0 = {u0}"),
                &format!("tension:order={order},u0={u0}"),
                mesh,
            )?);
        }
    }
    picture(name, &items, &settings(Show::Shaded, view, 150, 6), tuner)
}

/// A cube with marks.
fn marked(edges: &[[u32; 2]], sharpness: f64, vertices: &[u32]) -> Mesh {
    let mut cube = shapes::cube();
    cube.features
        .creases
        .extend(edges.iter().map(|&pair| (pair, sharpness)));
    cube.features
        .corners
        .extend(vertices.iter().map(|&vertex| (vertex, INFINITE)));
    cube
}

/// The upper rim of the cube.
const RIM: [[u32; 2]; 4] = [[2, 3], [3, 7], [6, 7], [2, 6]];

/// Fig. 8: a rule each.
fn features(tuner: &Tuner<'_>) -> Result<File, Error> {
    let scheme = "tension:order=6,u0=1";
    let items = [
        Item::new("smooth", scheme, &shapes::cube())?,
        Item::new("dart: a crease that ends", scheme, &marked(&RIM[1..3], INFINITE, &[]))?,
        Item::new("crease", scheme, &marked(&RIM, INFINITE, &[]))?,
        Item::new("crease of sharpness 1.5", scheme, &marked(&RIM, 1.5, &[]))?,
        Item::new("crease with a corner", scheme, &marked(&RIM, INFINITE, &[7]))?,
        Item::new("cusp", scheme, &marked(&[], INFINITE, &[7]))?,
        Item::new("crease, order 5", "tension:order=5,u0=1", &marked(&RIM, INFINITE, &[]))?,
        Item::new(
            "with a corner, order 5",
            "tension:order=5,u0=1",
            &marked(&RIM, INFINITE, &[7]),
        )?,
    ];
    picture(
        "fig8-features",
        &items,
        &settings(Show::Shaded, [30.0, 32.0, 1.0], 220, 4),
        tuner,
    )
}

/// Fig. 9: creases that act in some smoothing steps of order 8.
fn steps(tuner: &Tuner<'_>) -> Result<File, Error> {
    let cube = marked(&RIM, INFINITE, &[]);
    let items: Result<Vec<Item>, Error> = (0..4)
        .map(|cs| {
            Item::new(
                format!("order 8, cs = {cs}"),
                &format!("tension:order=8,u0=1,cs={cs}"),
                &cube,
            )
        })
        .collect();
    picture(
        "fig9-steps",
        &items?,
        &settings(Show::Shaded, [30.0, 32.0, 1.0], 220, 4),
        tuner,
    )
}

/// What boundaries become, in an even and in an odd order.
fn boundaries(tuner: &Tuner<'_>) -> Result<File, Error> {
    let mut items = Vec::new();
    for order in [4, 5] {
        let scheme = format!("tension:order={order},u0=1");
        for (word, boundary, n) in [
            ("edge", Boundary::Edge, 4),
            ("corner", Boundary::Corner, 4),
            ("edge, n = 5", Boundary::Edge, 5),
            ("corner, n = 5", Boundary::Corner, 5),
        ] {
            let mut star = shapes::star(n, 2, shapes::StarKind::Convex);
            star.features.boundary = Some(boundary);
            items.push(Item::new(format!("order {order}, {word}"), &scheme, &star)?);
        }
    }
    picture(
        "boundaries",
        &items,
        &settings(Show::Wireframe, [-60.0, 40.0, 1.0], 220, 4),
        tuner,
    )
}

/// The first eigenvalues of features: darts, cusps, open fans as creases and corners, creases that act in
/// some steps.
fn spectra(tuner: &Tuner<'_>) -> Result<File, Error> {
    const SHOWN: usize = 6;
    let mut columns: Vec<String> = ["order", "feature", "faces", "cs"].map(str::to_owned).to_vec();
    columns.extend((0..SHOWN).map(|k| format!("eigenvalue_{k}")));
    let mut rows = Table::new(columns);
    // half cells of odd orders have the first eigenvalues of half a closed cell; they are no corners
    for order in [4, 6, 8, 10] {
        let name: SchemeName = format!("tension:order={order},u0=1").parse()?;
        let mut corners: Vec<(&str, usize, Option<usize>, Corner)> = Vec::new();
        for n in 3..=8 {
            corners.push(("dart", n, None, Corner::dart(n)?));
            corners.push(("cusp", n, None, Corner::cusp(n)?));
        }
        for steps in 1..order / 2 - 1 {
            for n in [4, 5] {
                corners.push(("dart", n, Some(steps), Corner::dart(n)?.with_steps(steps)));
                corners.push(("cusp", n, Some(steps), Corner::cusp(n)?.with_steps(steps)));
            }
        }
        let largest = if order == 10 { 4 } else { 8 };
        for n in 1..=largest {
            corners.push(("fan", n, None, Corner::fan(n)?));
            corners.push(("corner", n, None, Corner::fan(n)?.fixed()));
        }
        for (word, faces, steps, corner) in corners {
            let analysis = Analysis::of_name(&name, &corner, [None, None], tuner)?;
            let mut row: Vec<Cell> = vec![order.into(), word.into(), faces.into()];
            row.push(steps.map_or(Cell::Empty, Cell::from));
            let all = analysis.spectrum.eigenvalues.iter();
            let mut values: Vec<Cell> = all
                .flat_map(|e| std::iter::repeat_n(Cell::from(e.value.re), e.multiplicity))
                .take(SHOWN)
                .collect();
            values.resize(SHOWN, Cell::Empty);
            row.extend(values);
            rows.push(row);
        }
    }
    Ok(table("spectra", &rows))
}
