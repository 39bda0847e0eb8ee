//! What plotters draws of a chart: clipped and not clamped, to the micrometre, with outlines for text, and
//! the same again.
//!
//! The oracle is plain proportion: where a point must lie between the sides of the frame, which the layout
//! tells, compared with the coordinates in the SVG.

use eigenring_figure::{Axis, Chart, Colour, Dash, Figure, Fill, Marker, Panel, Rect, Stroke, Style, Width};

/// Frame and point are rounded to whole micrometres each, by half of one at most.
const ROUNDING: f64 = 1.0e-3 + 1e-9;

fn figure(chart: Chart) -> Figure {
    Figure::new(Width::One, 60.0, "Test").panel(0, 0, Panel::new(chart))
}

fn frame(figure: &Figure) -> Rect {
    figure.layout().unwrap().plots[0]
}

/// The lines of the paths with a stroke of this colour.
fn paths(svg: &str, colour: &str) -> Vec<Vec<[f64; 2]>> {
    let stroke = format!("stroke=\"{colour}\"");
    let paths = svg
        .lines()
        .filter(|line| line.starts_with("<path d") && line.contains(&stroke));
    paths.flat_map(|path| steps(path.split('"').nth(1).unwrap())).collect()
}

/// The lines of a path: moves and steps, each relative to the point before or, after a closed line, to its
/// start.
fn steps(data: &str) -> Vec<Vec<[f64; 2]>> {
    let (mut at, mut lines) = ([0.0; 2], Vec::<Vec<[f64; 2]>>::new());
    for line in data.split('m').skip(1) {
        let mut points = Vec::new();
        for step in line
            .trim_end_matches('z')
            .split('l')
            .map(|step| step.replace('-', " -"))
        {
            let step: Vec<f64> = step.split_whitespace().map(|number| number.parse().unwrap()).collect();
            at = [at[0] + step[0], at[1] + step[1]];
            points.push(at);
        }
        if line.ends_with('z') {
            at = points[0];
        }
        lines.push(points);
    }
    lines
}

/// The centres of circles.
fn circles(svg: &str) -> Vec<[f64; 2]> {
    let number = |line: &str, name: &str| {
        let from = line.find(name).unwrap() + name.len();
        line[from..].split('"').next().unwrap().parse().unwrap()
    };
    let circles = svg.lines().filter(|line| line.starts_with("<circle"));
    circles
        .map(|line| [number(line, "cx=\""), number(line, "cy=\"")])
        .collect()
}

fn at(frame: &Rect, [x, y]: [f64; 2]) -> [f64; 2] {
    [frame.left + x * frame.width(), frame.bottom - y * frame.height()]
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs())
}

const RED: Colour = Colour(0xff, 0, 0);

#[test]
fn a_line_that_leaves_the_frame_ends_on_it_where_they_meet() {
    // clamping would end both at the corner
    let linear = Chart::new(Axis::new("", (0.0, 1.0)), Axis::new("", (0.0, 1.0)));
    let linear = linear.series([[0.5, 0.5], [1.5, 2.0]], Style::solid(RED));
    // on a logarithmic axis the line is straight from 10 to 10^7, and a third of the way is 1000
    let log = Chart::new(Axis::new("", (0.0, 1.0)), Axis::log("", (1.0, 1000.0)));
    let log = log.series([[0.5, 10.0], [0.8, 1e7]], Style::solid(RED));
    let into = Chart::new(Axis::new("", (-1.0, 1.0)), Axis::new("", (-2.0, 2.0)));
    let into = into.series([[0.0, 0.0], [-3.0, 3.0]], Style::solid(RED).dashed(Dash::Dashed));
    for (chart, from, to) in [
        (linear, [0.5, 0.5], [0.5 + 1.0 / 3.0, 1.0]),
        (log, [0.5, 1.0 / 3.0], [0.6, 1.0]),
        (into, [0.5, 0.5], [0.0, 0.75]),
    ] {
        let figure = figure(chart);
        let lines = paths(&figure.svg().unwrap(), "#ff0000");
        assert_eq!((lines.len(), lines[0].len()), (1, 2));
        for (point, expected) in lines[0].iter().zip([from, to]) {
            let expected = at(&frame(&figure), expected);
            assert!(distance(*point, expected) <= ROUNDING, "{point:?} {expected:?}");
        }
    }
}

#[test]
fn what_is_outside_altogether_is_not_drawn() {
    let axis = || Axis::new("", (0.0, 1.0));
    let outside = [
        [-0.5, 0.5],
        [-0.1, 3.0],
        [0.5, 1.5],
        [2.0, 0.5],
        [0.5, f64::NAN],
        [0.5, -1e-6],
    ];
    let inside = [[0.0, 0.0], [1.0, 1.0], [0.3, 0.7], [1.0, 0.2]];
    let points = outside.into_iter().chain(inside);
    let chart = Chart::new(axis(), axis())
        .series(points, Style::points(Marker::Circle, RED))
        .series([[-1.0, 0.5], [0.5, 3.0]], Style::solid(RED))
        .horizontal(1.2, Stroke::solid(RED, 0.2))
        .vertical(-0.1, "", Stroke::solid(RED, 0.2))
        .span(1.5, 2.0, RED)
        .band([[2.0, 0.1, 0.2], [3.0, 0.1, 0.2]], Fill::Plain(RED))
        .outline(
            [[1.1, 0.0], [1.2, 0.0], [1.2, 1.0]],
            Stroke::solid(RED, 0.2),
            Some(Fill::Hatched(RED)),
        );
    let figure = figure(chart);
    let svg = figure.svg().unwrap();
    let seen = circles(&svg);
    assert_eq!(seen.len(), inside.len());
    for (point, expected) in seen.into_iter().zip(inside) {
        assert!(
            distance(point, at(&frame(&figure), expected)) <= ROUNDING,
            "{point:?} {expected:?}"
        );
    }
    assert_eq!(svg.matches("#ff0000").count(), inside.len());
}

#[test]
fn coordinates_are_good_to_a_micrometre() {
    let count = 997;
    let share = |k: usize| k as f64 / (count - 1) as f64;
    // between all pairs of axes, the same curve on the page
    let curve = |k: usize| [share(k), 0.5 + 0.4 * (9.0 * share(k)).sin()];
    for (x, y) in [(false, false), (true, false), (false, true), (true, true)] {
        let axis = |log| match log {
            true => Axis::log("", (0.02, 70.0)),
            false => Axis::new("", (-3.0, 11.0)),
        };
        let value = |log, t: f64| match log {
            true => (0.02f64.ln() + t * (70.0f64.ln() - 0.02f64.ln())).exp(),
            false => -3.0 + 14.0 * t,
        };
        let points = (0..count).map(curve).map(|[s, t]| [value(x, s), value(y, t)]);
        let figure = figure(Chart::new(axis(x), axis(y)).series(points, Style::solid(RED)));
        let lines = paths(&figure.svg().unwrap(), "#ff0000");
        assert_eq!((lines.len(), lines[0].len()), (1, count));
        let expected = (0..count).map(|k| at(&frame(&figure), curve(k)));
        let worst = lines[0]
            .iter()
            .zip(expected)
            .map(|(a, b)| distance(*a, b))
            .fold(0.0, f64::max);
        assert!(worst <= ROUNDING, "{x} {y}: {worst}");
    }
}

/// Everything that plotters draws: ticks of both lengths, a grid, labels, lines, markers, areas.
fn rich() -> Figure {
    let chart = Chart::new(
        Axis::new("$λ$ & <more>", (0.0, 1.0)).with_grid(),
        Axis::log("$E$", (0.1, 100.0)).with_grid(),
    )
    .span(0.2, 0.4, Colour::SHADE)
    .band([[0.0, 0.1, 1.0], [1.0, 0.2, 30.0]], Fill::Hatched(Colour::line(2)))
    .series(
        [[0.0, 0.5], [0.7, 40.0], [1.2, 3.0]],
        Style::line(1).marked(Marker::Diamond),
    )
    .outline(
        [[0.1, 1.0], [0.2, 1.0], [0.2, 2.0]],
        Stroke::solid(RED, 0.1),
        Some(Fill::Plain(RED)),
    );
    figure(chart)
}

#[test]
fn texts_are_outlines() {
    let figure = rich();
    let svg = figure.svg().unwrap();
    assert!(!svg.contains("<text") && !svg.contains("font-family"));
    // by the names that readers of the screen are told
    for text in ["λ &amp; &lt;more>", "E", "0.2", "10^{0}", "10^{2}"] {
        assert!(svg.contains(&format!("aria-label=\"{text}\"")), "{text}");
    }
    let layout = figure.layout().unwrap();
    assert_eq!(layout.faults(), [""; 0]);
    // 0 to 1 by steps of 0.1 or 0.2, four powers of ten, two labels
    assert!(layout.texts.len() >= 6 + 4 + 2, "{:?}", layout.texts);
    // labels of axes are centred beside the frame, ticks' texts to the left of it end before it
    let plot = layout.plots[0];
    let place = |wanted: &str| layout.texts.iter().find(|(text, _)| text == wanted).unwrap().1;
    let below = place("$λ$ & <more>");
    assert!((below.left + below.right - plot.left - plot.right).abs() < 2.0 * ROUNDING && below.top > plot.bottom);
    let beside = place("$E$");
    assert!((beside.top + beside.bottom - plot.top - plot.bottom).abs() < 2.0 * ROUNDING);
    assert!(beside.right < place("$10^{0}$").left && place("$10^{0}$").right < plot.left);
}

#[test]
fn ticks_stand_at_their_values_and_the_frame_is_drawn_once() {
    let figure = rich();
    let plot = frame(&figure);
    let ink = paths(&figure.svg().unwrap(), "#222222");
    let frames = ink.iter().filter(|line| line.len() == 4).count();
    let ticks: Vec<&Vec<[f64; 2]>> = ink.iter().filter(|line| line.len() == 2).collect();
    assert_eq!((frames, frames + ticks.len()), (1, ink.len()));
    let sideways = |line: &&&Vec<[f64; 2]>| line[0][1] == line[1][1];
    // of a logarithmic axis over three decades: 4 with texts, 8 shorter ones in each decade
    for (length, values) in [
        (0.7, vec![0.1, 1.0, 10.0, 100.0]),
        (
            0.35,
            (0..24).map(|k| f64::from(k % 8 + 2) * 10f64.powi(k / 8 - 1)).collect(),
        ),
    ] {
        let long = |line: &&&Vec<[f64; 2]>| ((line[1][0] - line[0][0]).abs() - length).abs() <= ROUNDING;
        let found: Vec<f64> = ticks
            .iter()
            .filter(sideways)
            .filter(long)
            .map(|line| line[0][1])
            .collect();
        assert_eq!(found.len(), values.len(), "{length}");
        for (y, value) in found.into_iter().zip(values) {
            let expected = at(&plot, [0.0, (value.log10() + 1.0) / 3.0])[1];
            assert!((y - expected).abs() <= ROUNDING, "{value}: {y} {expected}");
        }
    }
    let upright = ticks
        .iter()
        .filter(|line| line[0][0] == line[1][0])
        .map(|line| line[0][0]);
    let steps: Vec<f64> = upright.map(|x| (x - plot.left) / plot.width() * 10.0).collect();
    assert!(
        steps.len() >= 6 && steps.iter().all(|step| (step - step.round()).abs() < 1e-3),
        "{steps:?}"
    );
}

#[test]
fn the_same_chart_gives_the_same_bytes_on_any_thread() {
    let here = rich().svg().unwrap();
    let threads: Vec<_> = (0..4).map(|_| std::thread::spawn(|| rich().svg().unwrap())).collect();
    for thread in threads {
        assert_eq!(thread.join().unwrap(), here);
    }
    assert_eq!(rich().png(100.0).unwrap(), rich().png(100.0).unwrap());
}
