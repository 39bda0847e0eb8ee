//! Whole figures: determinism, layout, what is refused.

use eigenring_figure::{
    Axis, Chart, Colour, ColourMap, ColourScale, Error, Figure, Fill, Marker, Panel, Side, Stroke, Style, Surface,
    View, Width,
};

fn chart(range: (f64, f64)) -> Chart {
    Chart::new(Axis::new("$λ$", range), Axis::new("$E$", (0.0, 1.0)))
        .span(range.0, range.1, Colour::SHADE)
        .label("recommended")
        .vertical(0.5, "$λ_M^*$", Stroke::solid(Colour::GREY, 0.2))
        .vertical(0.51, "$λ_{CC}$", Stroke::solid(Colour::GREY, 0.2))
        .series(
            [[0.1, 0.2], [0.4, 0.9], [0.8, 0.1]],
            Style::line(0).marked(Marker::Circle),
        )
        .label("a series with a rather long label")
}

fn figure() -> Figure {
    Figure::new(Width::One, 70.0, "Test")
        .panel(0, 0, Panel::new(chart((0.0, 1.0))).title("first"))
        .panel(0, 1, Panel::new(chart((0.2, 0.9))).title("second"))
        .legend(Side::Bottom)
}

#[test]
fn equal_figures_give_equal_bytes() {
    assert_eq!(figure().svg().unwrap(), figure().svg().unwrap());
    assert_eq!(figure().png(100.0).unwrap(), figure().png(100.0).unwrap());
    assert_ne!(figure().svg().unwrap(), figure().legend(Side::Top).svg().unwrap());
}

#[test]
fn the_page_has_its_printed_size() {
    let svg = figure().svg().unwrap();
    assert!(svg.contains("width=\"85mm\" height=\"70mm\""), "{}", &svg[..200]);
    let png = figure().png(254.0).unwrap();
    // the header chunk: width and height at ten dots a millimetre
    let number = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    assert_eq!((number(16), number(20)), (850, 700));
    assert!(png.windows(4).any(|chunk| chunk == b"pHYs"));
}

#[test]
fn legends_stand_beside_the_data_and_texts_on_the_page() {
    for side in [Side::Top, Side::Bottom] {
        let layout = figure().legend(side).layout().unwrap();
        assert_eq!(layout.faults(), [""; 0]);
        assert_eq!((layout.plots.len(), layout.legends.len()), (2, 1));
    }
    for side in [Side::Top, Side::Bottom, Side::Right] {
        let single = Figure::new(Width::One, 60.0, "").panel(0, 0, Panel::new(chart((0.0, 1.0))).legend(side));
        assert_eq!(single.layout().unwrap().faults(), [""; 0], "{side:?}");
    }
}

#[test]
fn faults_are_found() {
    let axis = |label: &str| Axis::new(label, (0.0, 1.0));
    let long =
        "a label that is much longer than the axis which it is meant to explain to its reader, who sees half of it";
    let wide = Figure::new(Width::One, 40.0, "").panel(0, 0, Panel::new(Chart::new(axis(long), axis(""))));
    assert!(wide.layout().unwrap().faults()[0].contains("leaves the page"));
    let twice = Chart::new(axis(""), axis(""))
        .text([0.5, 0.5], "one", Default::default(), Colour::INK)
        .text([0.52, 0.5], "two", Default::default(), Colour::INK);
    let faults = Figure::new(Width::One, 40.0, "")
        .panel(0, 0, Panel::new(twice))
        .layout()
        .unwrap()
        .faults();
    assert!(faults.len() == 1 && faults[0].contains("overlap"), "{faults:?}");
}

#[test]
fn what_lies_outside_the_axes_is_cut_off() {
    let data = [
        [-5.0, 0.5],
        [0.5, 0.5],
        [0.6, f64::NAN],
        [0.7, f64::INFINITY],
        [0.8, 0.5],
        [9.0, 99.0],
    ];
    let chart = Chart::new(Axis::new("", (0.0, 1.0)), Axis::log("", (0.1, 1.0)))
        .series(data, Style::line(0).marked(Marker::Cross))
        .series([[0.0, 0.0], [1.0, -1.0]], Style::line(1))
        .band(
            [[0.0, f64::NAN, 1.0], [0.5, 0.2, 7.0], [2.0, 0.2, 0.3]],
            Fill::Plain(Colour::line(2)),
        );
    let figure = Figure::new(Width::One, 50.0, "").panel(0, 0, Panel::new(chart));
    let plot = figure.layout().unwrap().plots[0];
    let svg = figure.svg().unwrap();
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    for path in svg
        .lines()
        .filter(|line| line.starts_with("<path d") && line.contains("stroke=\"#005b96\""))
    {
        let data = path.split('"').nth(1).unwrap().replace('-', " -");
        assert!(!data.contains('z'), "lines and crosses are open");
        let (mut x, mut y) = (0.0, 0.0);
        for step in data.split(['m', 'l']).skip(1) {
            let step: Vec<f64> = step.split_whitespace().map(|number| number.parse().unwrap()).collect();
            (x, y) = (x + step[0], y + step[1]);
            // crosses have arms
            assert!(x > plot.left - 1.0 && x < plot.right + 1.0 && y > plot.top - 1.0 && y < plot.bottom + 1.0);
        }
    }
}

#[test]
fn values_in_colour_need_a_bar() {
    let scale = ColourScale::new(ColourMap::Cividis, (0.0, 1.0), "$J$");
    let cell = || [(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], 2.0)];
    let map = || Panel::new(Chart::map((0.0, 1.0), (0.0, 1.0)).cells(cell(), &scale));
    let bare = Figure::new(Width::One, 50.0, "").panel(0, 0, map());
    assert_eq!(bare.svg(), Err(Error::NoColourBar { panel: 1 }));
    let other = ColourScale::signed(1.0, "$J$");
    assert!(bare.clone().colour_bar(&other).svg().is_err());
    let with = bare.clone().colour_bar(&scale);
    assert_eq!(with.layout().unwrap().faults(), [""; 0]);
    let own = Figure::new(Width::One, 50.0, "").panel(0, 0, map().colour_bar(&scale));
    assert_eq!(own.layout().unwrap().faults(), [""; 0]);
    let quad = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let surface = Surface::new(View::default()).quads([(quad, 0.5)], &scale);
    let space = Figure::new(Width::One, 50.0, "").panel(0, 0, Panel::new(surface));
    assert!(space.svg().is_err() && space.colour_bar(&scale).svg().is_ok());
}

#[test]
fn what_cannot_be_drawn_is_refused_with_numbers() {
    let draw = |x: Axis, y: Axis| {
        let panel = Panel::new(Chart::new(x, y));
        Figure::new(Width::One, 50.0, "").panel(0, 0, panel).svg()
    };
    let good = || Axis::new("", (0.0, 1.0));
    for range in [(1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
        assert!(
            matches!(draw(Axis::new("$λ$", range), good()), Err(Error::Range { .. })),
            "{range:?}"
        );
    }
    let error = draw(good(), Axis::log("$E$", (0.0, 1.0))).unwrap_err().to_string();
    assert!(error.contains("$E$") && error.ends_with("above 0"), "{error}");
    assert_eq!(
        draw(Axis::new("\u{e000}", (0.0, 1.0)), good()),
        Err(Error::Character('\u{e000}'))
    );
    assert!(matches!(
        Figure::new(Width::One, 50.0, "").svg(),
        Err(Error::Grid { .. })
    ));
    let tiny = Figure::new(Width::Millimetres(15.0), 50.0, "").panel(0, 0, Panel::new(chart((0.0, 1.0))));
    assert!(matches!(tiny.svg(), Err(Error::NoRoom { .. })));
    for size in [f64::NAN, f64::INFINITY, 1e9] {
        let large = Figure::new(Width::One, size, "").panel(0, 0, Panel::new(chart((0.0, 1.0))));
        assert!(matches!(large.svg(), Err(Error::Size { .. })), "{size}");
    }
    assert!(figure().png(f64::NAN).unwrap_err().to_string().contains("20 to 2400"));
    assert!(figure().png(1.0).is_err());
}

#[test]
fn frames_are_aligned_and_wide_panels_span_columns() {
    let panel = |range| Panel::new(chart(range));
    let figure = Figure::new(Width::Two, 120.0, "")
        .wide_panel(0, 0, 2, panel((0.0, 1.0)).legend(Side::Bottom))
        .panel(0, 2, panel((0.0, 1e-7)))
        .panel(1, 0, panel((0.0, 1.0)))
        .panel(1, 1, panel((0.0, 1.0)))
        .panel(1, 2, panel((0.0, 1.0)))
        .column_widths(&[2.0, 2.0, 1.0])
        .row_heights(&[2.0, 1.0]);
    let layout = figure.layout().unwrap();
    let [wide, side, first, second, third] = layout.plots[..] else {
        panic!("{:?}", layout.plots)
    };
    assert_eq!((wide.left, wide.right), (first.left, second.right));
    assert_eq!((side.left, side.top), (third.left, wide.top));
    assert!((first.width() - 2.0 * third.width()).abs() < 1e-9 && (wide.height() - 2.0 * first.height()).abs() < 1e-9);
    let short = figure.column_widths(&[1.0, 1.0]);
    assert!(matches!(short.svg(), Err(Error::Grid { .. })));
}

#[test]
fn a_legend_of_many_rows_fits_whatever_its_entries() {
    for count in 1..14 {
        let axis = |label: &str| Axis::new(label, (0.0, 1.0));
        let mut chart = Chart::new(axis("abscissa"), axis("ordinate"));
        for index in 0..count {
            let series = [[0.1, 0.2], [0.9, 0.4]];
            chart = chart
                .series(series, Style::line(index))
                .label("entry ".repeat(1 + index % 3) + &index.to_string());
        }
        for side in [Side::Top, Side::Bottom] {
            let panel = || Panel::new(chart.clone()).title("title").legend(side);
            let single = Figure::new(Width::One, 90.0, "").panel(0, 0, panel());
            let pair = Figure::new(Width::Two, 90.0, "")
                .panel(0, 0, panel())
                .panel(0, 1, panel());
            for figure in [single, pair] {
                assert_eq!(figure.layout().unwrap().faults(), [""; 0], "{count} {side:?}");
            }
        }
    }
}
