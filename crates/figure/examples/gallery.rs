//! Draws one figure of each kind into the folder given, `gallery-*.svg` and `.png`.

use eigenring_figure::{
    Anchor, Axis, Chart, Colour, ColourMap, ColourScale, Dash, Figure, Fill, Marker, Panel, Side, Stroke, Style,
    Surface, View, Width,
};

fn charts() -> Figure {
    let rule = Stroke {
        dash: Dash::Dashed,
        ..Stroke::solid(Colour::GREY, 0.2)
    };
    let x = || (0..=200).map(|k| f64::from(k) / 200.0);
    let weights = Chart::new(
        Axis::new("subdominant eigenvalue $λ$", (0.15, 0.9)),
        Axis::new("weight", (0.0, 0.8)).with_grid(),
    )
    .span(0.2, 0.86, Colour::SHADE)
    .label("recommended")
    .band(x().map(|x| [x, 0.2 * x, 0.5 * x + 0.1]), Fill::Hatched(Colour::line(0)))
    .label("feasible $f_2$")
    .vertical(0.5, "$λ_M^*$", rule)
    .vertical(0.55, "$λ_{CC}$", rule)
    .vertical(0.56, "$λ_C^*$", rule)
    .series(x().map(|x| [x, 0.3 * x + 0.1 * (9.0 * x).sin()]), Style::line(0))
    .label("$f_2$")
    .series(x().map(|x| [x, x * x]), Style::line(1))
    .label("$f_3$")
    .series(
        x().step_by(10).map(|x| [x, x * x + 0.01]),
        Style::points(Marker::Circle, Colour::line(1)),
    )
    .label("samples");
    let errors = Chart::new(
        Axis::new("valence $N$", (2.5, 20.5)).with_integers((4..=20).step_by(2)),
        Axis::log("error", (1e-9, 1e3)).with_grid(),
    )
    .series(
        (3..=20).map(|n| [f64::from(n), 10f64.powf(-9.0 + f64::from(n) / 2.0)]),
        Style::line(2).marked(Marker::Diamond),
    )
    .label("$|f_3 - f_3^#|$")
    .text([10.0, 1e2], "a text at a point", Anchor::Middle, Colour::INK);
    Figure::new(Width::Two, 75.0, "Charts")
        .panel(0, 0, Panel::new(weights).title("$N$ = 6"))
        .panel(0, 1, Panel::new(errors).title("errors"))
        .legend(Side::Bottom)
}

fn maps() -> Figure {
    let scale = ColourScale::signed(1.0, "Gauss curvature $K$");
    let z = |x: f64, y: f64| x * x - y * y;
    let at = |k: u32| f64::from(k) / 20.0 - 1.0;
    let grid = || (0..40).flat_map(move |i| (0..40).map(move |j| [at(i), at(j), at(i + 1), at(j + 1)]));
    let corners = |[a, b, c, d]: [f64; 4]| [[a, b], [c, b], [c, d], [a, d]];
    let height = |cell: [f64; 4]| z((cell[0] + cell[2]) / 2.0, (cell[1] + cell[3]) / 2.0);
    let cells = grid().map(|cell| (corners(cell).to_vec(), height(cell)));
    let map = Chart::map((-1.0, 1.0), (-1.0, 1.0)).cells(cells, &scale);
    let quads = grid().map(|cell| (corners(cell).map(|[x, y]| [x, y, z(x, y)]), 1.5 * height(cell)));
    let diagonal = (0..=40).map(|k| [at(k), at(k), 0.0]);
    let surface = Surface::new(View::default())
        .quads(quads, &scale)
        .line(diagonal, Stroke::solid(Colour::INK, 0.3));
    let sequential = ColourScale::new(ColourMap::Viridis, (0.0, 2.0), "$x^2 + y^2$");
    let cells = grid().map(|cell| (corners(cell).to_vec(), cell[0] * cell[0] + cell[1] * cell[1]));
    let framed = Chart::new(Axis::new("$x$", (-1.0, 1.0)), Axis::new("$y$", (-1.0, 1.0)))
        .equal()
        .cells(cells, &sequential);
    Figure::new(Width::Two, 55.0, "Maps")
        .panel(0, 0, Panel::new(map).title("a map").colour_bar(&scale))
        .panel(0, 1, Panel::new(surface).title("a surface").colour_bar(&scale))
        .panel(0, 2, Panel::new(framed).title("with axes").colour_bar(&sequential))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("usage: gallery FOLDER")?;
    for (name, figure) in [("charts", charts()), ("maps", maps())] {
        for fault in figure.layout()?.faults() {
            eprintln!("{name}: {fault}");
        }
        std::fs::write(format!("{folder}/gallery-{name}.svg"), figure.svg()?)?;
        std::fs::write(format!("{folder}/gallery-{name}.png"), figure.png(300.0)?)?;
    }
    Ok(())
}
