//! All figures over usual and odd inputs: what is on the page can be read, and is what the legend says.

use super::*;
use crate::progress::Silent;
use crate::table::Format;
use std::collections::BTreeSet;

/// What a figure is asked for, where it is not its own choice.
#[derive(Clone, Copy, Debug)]
struct Asked<'a> {
    width: Width,
    valences: Option<&'a [usize]>,
    range: (f64, f64),
    schemes: Option<&'a [&'a str]>,
    colours: Option<(f64, f64)>,
}

const USUAL: Asked<'_> = Asked {
    width: Width::Two,
    valences: None,
    range: (0.15, 0.9),
    schemes: None,
    colours: None,
};

/// The drawings of a figure, with what it takes of what is asked for.
fn draw(entry: &FigureEntry, asked: &Asked<'_>, studies: &Studies) -> Vec<Drawing> {
    let schemes = match asked.schemes.filter(|_| entry.schemes.is_some() && !entry.uneven) {
        Some(specs) => specs.iter().map(|spec| spec.parse().unwrap()).collect(),
        None => entry.default_schemes().unwrap(),
    };
    let inputs = Inputs {
        schemes: &schemes,
        colours: entry.colours.map(|own| asked.colours.unwrap_or(own)),
        valences: match asked.valences.filter(|_| !entry.valences.is_empty()) {
            Some(valences) => valences,
            None => entry.valences,
        },
        lambdas: entry.lambdas,
        range: asked.range,
        width: asked.width,
        sweep: None,
        knots: None,
        studies,
        tuner: &Tuner::default(),
    };
    (entry.build)(&inputs).unwrap_or_else(|error| panic!("{} {asked:?}: {error}", entry.name))
}

fn is_readable(entry: &FigureEntry, asked: &Asked<'_>, studies: &Studies) {
    for drawing in draw(entry, asked, studies) {
        let layout = drawing.figure.layout().unwrap();
        let faults = layout.faults();
        assert!(faults.is_empty(), "{} {asked:?}: {faults:#?}", drawing.stem);
        // an axis from which no number can be read
        let has_digit = |(text, _): &&(String, _)| text.contains(|c: char| c.is_ascii_digit());
        assert!(
            layout.texts.iter().filter(has_digit).count() >= 2,
            "{} {asked:?}",
            drawing.stem
        );
    }
}

fn stored() -> Studies {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../results");
    Studies::load(Some(std::path::Path::new(folder)), &[], &Silent).unwrap()
}

#[test]
fn names_are_distinct_and_unknown_ones_list_them() {
    let names: BTreeSet<&str> = FIGURES.iter().map(|entry| entry.name).collect();
    assert_eq!(names.len(), FIGURES.len());
    let error = find("nothing").unwrap_err();
    assert!(names.iter().all(|name| error.accepted().unwrap().contains(name)));
}

#[test]
fn figures_are_readable_at_usual_and_extreme_valences() {
    let studies = stored();
    let sets: [&[usize]; 4] = [&[3], &[6], &[20], &[3, 4, 6, 8, 12, 20]];
    for entry in FIGURES {
        for width in [Width::One, Width::Two] {
            is_readable(entry, &Asked { width, ..USUAL }, &studies);
        }
        for (index, valences) in sets.into_iter().enumerate().filter(|_| !entry.valences.is_empty()) {
            let width = if index % 2 == 0 { Width::One } else { Width::Two };
            let valences = Some(valences);
            is_readable(
                entry,
                &Asked {
                    width,
                    valences,
                    ..USUAL
                },
                &studies,
            );
        }
    }
}

#[test]
fn figures_over_lambda_are_readable_over_tiny_and_odd_ranges() {
    let studies = stored();
    let ranges = [
        (0.15, 0.1501),
        // around a featured value, and around none
        (0.39 - 1e-6, 0.39 + 1e-6),
        (0.5 + 1e-7, 0.5 + 2e-7),
        (0.353_553_390_593, 0.353_553_390_594),
        // lambda_l and lambda_r2 of N = 20, all featured values of N = 3
        (0.86, 0.9),
        (0.34, 0.42),
        // beyond the splines' end
        (0.899, 1.0),
    ];
    for entry in FIGURES.iter().filter(|entry| entry.range) {
        for (index, range) in ranges.into_iter().enumerate() {
            let width = if index % 2 == 0 { Width::Two } else { Width::One };
            let valences = Some(&[3usize, 6, 20][..]);
            let asked = Asked {
                width,
                valences,
                range,
                ..USUAL
            };
            is_readable(entry, &asked, &studies);
        }
    }
}

#[test]
fn figures_of_schemes_are_readable_with_one_and_with_many() {
    let studies = stored();
    let one: &[&str] = &["tension:order=8,u0=0.3"];
    let many: &[&str] = &[
        "catmull-clark",
        "tension:order=6",
        "lambda:optimal",
        "lambda:lambda=0.35",
        "stam:order=8",
        "lambda:lambda=0.6",
        "tension:order=5",
    ];
    for entry in FIGURES.iter().filter(|entry| entry.schemes.is_some() && !entry.uneven) {
        for (schemes, valences, width) in [
            (one, &[20usize][..], Width::One),
            (one, &[3], Width::Two),
            // more panels than letters, where they cost little
            (
                many,
                if entry.name == "natural-configurations" {
                    &[5, 8, 13, 20]
                } else {
                    &[20]
                },
                Width::Two,
            ),
            (many, &[3], Width::One),
        ] {
            // Doo-Sabin has no second-order maps
            let rough = (entry.name != "second-order-maps").then_some("doo-sabin");
            let schemes: Vec<&str> = schemes.iter().copied().chain(rough).collect();
            let asked = Asked {
                width,
                valences: Some(valences),
                schemes: Some(&schemes),
                ..USUAL
            };
            is_readable(entry, &asked, &studies);
        }
    }
}

#[test]
fn maps_name_their_valence_and_meshes_their_level() {
    let studies = stored();
    let titles = |name: &str| {
        let drawing = draw(
            find(name).unwrap(),
            &Asked {
                valences: Some(&[20]),
                ..USUAL
            },
            &studies,
        )
        .remove(0);
        drawing.figure.layout().unwrap().texts.into_iter().map(|(text, _)| text)
    };
    let lettered = titles("second-order-maps")
        .filter(|text| text.starts_with('('))
        .collect::<Vec<_>>();
    assert!(
        lettered.len() == 6 && lettered.iter().all(|text| text.contains("$N$ = 20")),
        "{lettered:?}"
    );
    let mut texts = titles("characteristic-meshes");
    assert!(texts.any(|text| text.contains("$u_0$ = 0.01") && text.contains("$u_1$ = 0.505")));
    assert!(titles("characteristic-map").any(|text| text.contains("logarithms")));
}

#[test]
fn colour_bars_of_tiny_ranges_are_readable() {
    let studies = stored();
    for entry in FIGURES.iter().filter(|entry| entry.colours.is_some()) {
        for colours in [(-1e-9, 1e-9), (1.0, 1.000_000_1), (0.0, 1e12)] {
            let valences: &[usize] = if entry.lambdas.is_empty() { &[3] } else { &[4] };
            let asked = Asked {
                valences: Some(valences),
                colours: Some(colours),
                schemes: Some(&["lambda:optimal"]),
                ..USUAL
            };
            is_readable(entry, &asked, &studies);
        }
    }
}

#[test]
fn bounded_curvature_is_shaded_where_it_is_proven() {
    // the oracle is the picture: the colour of a legend entry is found in the chart, over the lambdas that
    // the stored certificates give
    let entry = find("feasible-region").unwrap();
    let studies = stored();
    let shaded = |studies: &Studies| {
        let drawing = draw(
            entry,
            &Asked {
                valences: Some(&[9]),
                ..USUAL
            },
            studies,
        )
        .remove(0);
        let layout = drawing.figure.layout().unwrap();
        let (plot, svg) = (layout.plots[0], drawing.figure.svg().unwrap());
        // meshes: whole hundredths of a millimetre, a move to a corner and steps from there
        let cells = svg.lines().filter(|line| line.starts_with("<path color"));
        let lambda = |y: f64| (plot.bottom - y / 100.0) / plot.height();
        let cell = |line: &str| {
            let data = line
                .split("d=\"")
                .nth(1)
                .unwrap()
                .trim_end_matches("\"/>")
                .trim_matches(['m', 'z']);
            let numbers = data.replace('-', " -");
            let y: Vec<f64> = numbers
                .split_whitespace()
                .skip(1)
                .step_by(2)
                .map(|n| n.parse().unwrap())
                .collect();
            let corners = y.iter().scan(0.0, |at, step| {
                *at += step;
                Some(lambda(*at))
            });
            corners.fold((1.0f64, 0.0f64), |(low, high), y| (low.min(y), high.max(y)))
        };
        (cells.map(cell).collect::<Vec<_>>(), layout.entries)
    };
    let (cells, entries) = shaded(&studies);
    // lambda_l of N = 9 is 0.4976, and the relaxation ends 0.01 above it
    let expected = [(0.15, 0.5076), (0.5076, 0.9)];
    assert_eq!(cells.len(), 2);
    for ((low, high), (from, to)) in cells.into_iter().zip(expected) {
        assert!((low - from).abs() < 1e-3 && (high - to).abs() < 1e-3, "{low} {high}");
    }
    assert!(entries.iter().any(|entry| entry.contains("bounded")));
    let without = Studies::load(None, &[], &Silent).unwrap();
    let (cells, entries) = shaded(&without);
    assert!(
        cells.is_empty() && !entries.iter().any(|entry| entry.contains("bounded")),
        "{entries:?}"
    );
}

#[test]
fn drawings_are_deterministic_and_have_data() {
    let studies = stored();
    let asked = Asked {
        valences: Some(&[3, 6]),
        ..USUAL
    };
    let draw = || FIGURES.iter().flat_map(|entry| draw(entry, &asked, &studies));
    let mut stems = BTreeSet::new();
    for (a, b) in draw().zip(draw()) {
        assert!(stems.insert(a.stem.clone()), "{} twice", a.stem);
        assert_eq!(a.figure.svg().unwrap(), b.figure.svg().unwrap());
        assert!(!a.data.is_empty(), "{}", a.stem);
        for ((name, table), (_, other)) in a.data.iter().zip(&b.data) {
            let csv = table.render(Format::Csv);
            assert!(csv.lines().count() > 2, "{} {name}", a.stem);
            assert!(!csv.contains("NaN") && !csv.contains("inf"), "{} {name}", a.stem);
            assert_eq!(csv, other.render(Format::Csv));
        }
    }
}
