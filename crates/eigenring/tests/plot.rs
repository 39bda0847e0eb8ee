//! Figures: their data, compared as data; determinism; what is refused.

#![allow(missing_docs)]

use crate::common::{Place, csv_rows};
use std::collections::BTreeMap;

type Row = BTreeMap<String, String>;

fn value(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column}: {row:?}"))
}

/// The repository's results, or a folder of it.
fn repository(path: &str) -> String {
    format!("{}/../../{path}", env!("CARGO_MANIFEST_DIR"))
}

fn published(name: &str) -> Vec<Row> {
    let path = repository(&format!("results/lambda/{name}.csv"));
    csv_rows(&std::fs::read_to_string(path).unwrap())
}

fn refused(place: &Place, line: &str) -> String {
    let arguments: Vec<&str> = line.split_whitespace().collect();
    let run = place.run(&arguments);
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{line}: {}", run.stderr);
    assert_eq!(run.stderr.lines().count(), 1, "{line}: {}", run.stderr);
    run.stderr
}

fn plot(place: &Place, line: &str) -> Vec<String> {
    let arguments: Vec<&str> = ["plot"].into_iter().chain(line.split_whitespace()).collect();
    place.ok(&arguments).lines().map(str::to_owned).collect()
}

#[test]
fn every_figure_is_drawn_and_alike_for_any_number_of_threads() {
    let (place, other) = (Place::new(), Place::new());
    let results = repository("results");
    let line = format!("--all --dpi 50 --results {results}");
    let names = plot(&place, &line);
    let list = place.ok(&["plot", "--list"]);
    // what a figure shows stands below its line
    for line in list.lines().skip(1).filter(|line| !line.starts_with(' ')) {
        let name = line.split_whitespace().next().unwrap();
        for end in [".svg", ".png", ".csv"] {
            let start = format!("results/figures/{name}");
            let found = names.iter().any(|file| file.starts_with(&start) && file.ends_with(end));
            assert!(found, "{name}{end}");
        }
    }
    let arguments: Vec<&str> = ["plot"].into_iter().chain(line.split_whitespace()).collect();
    let one = other
        .command(&arguments)
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .unwrap();
    assert!(one.status.success());
    for name in &names {
        let read = |place: &Place| std::fs::read(place.path().join(name)).unwrap();
        assert!(read(&place) == read(&other), "{name} differs");
    }
}

#[test]
fn what_is_not_stored_is_computed_and_agrees() {
    let (place, other) = (Place::new(), Place::new());
    let run = place.run(&["plot", "samples", "--valences", "8", "--format", "svg", "--out", "."]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stderr.contains("N = 8"), "{}", run.stderr);
    plot(
        &other,
        &format!(
            "samples --valences 8 --format svg --out . --results {}",
            repository("results")
        ),
    );
    let read = |place: &Place| csv_rows(&place.read("samples-n8-samples.csv"));
    let (computed, stored) = (read(&place), read(&other));
    assert_eq!(computed.len(), stored.len());
    for (a, b) in computed.iter().zip(&stored) {
        for column in ["f2", "f3", "E", "f2_spline", "f3_spline"] {
            let (a, b) = (value(a, column), value(b, column));
            assert!((a - b).abs() <= 1e-6 * b.abs().max(1e-3), "{column}: {a} is not {b}");
        }
    }
}

#[test]
fn splines_lie_in_the_drawn_domain() {
    let place = Place::new();
    plot(&place, "stencils --valences 3..20 --format svg --out .");
    let rows = csv_rows(&place.read("stencils.csv"));
    assert!(rows.len() > 18 * 400);
    let slack = 1e-9;
    for row in rows {
        let get = |column: &str| value(&row, column);
        let (f2, f3) = (get("f2"), get("f3"));
        assert!(get("f3_min") - slack <= f3 && f3 <= get("f3_max") + slack, "{row:?}");
        let inside = |low: &str, high: &str| !row[low].is_empty() && get(low) - slack <= f2 && f2 <= get(high) + slack;
        assert!(inside("f2_min", "f2_max") || inside("f2_min_2", "f2_max_2"), "{row:?}");
        assert!(get("theta") <= 90.0 - 90.0 / get("valence") + 1e-6, "{row:?}");
    }
}

#[test]
fn drawn_errors_of_the_splines_are_the_published_ones() {
    let place = Place::new();
    let results = repository("results");
    plot(
        &place,
        &format!("samples --valences 3,6,20 --format svg --out . --results {results}"),
    );
    for n in [3, 6, 20] {
        let of = |rows: Vec<Row>| rows.into_iter().filter(move |row| row["valence"] == n.to_string());
        let accuracy = of(published("accuracy")).next().unwrap();
        let region = |name: &str| {
            let found = of(published("table1_featured_lambda")).find(|row| row["name"] == name);
            value(&found.unwrap(), "lambda")
        };
        let recommended = region("lambda_r1")..=region("lambda_r2");
        let rows = csv_rows(&place.read(&format!("samples-n{n}-samples.csv")));
        let samples: Vec<Row> = of(published("samples")).collect();
        assert_eq!(rows.len(), samples.len());
        let mut worst = [0.0f64; 3];
        for (row, sample) in rows.iter().zip(&samples) {
            for column in ["lambda", "s", "f2", "f3", "E", "active"] {
                assert_eq!(row[column], sample[column], "N = {n}, lambda = {}", sample["lambda"]);
            }
            if recommended.contains(&value(row, "lambda")) {
                let error = |column: &str| (value(row, column) - value(row, &format!("{column}_spline"))).abs();
                for (worst, error) in worst.iter_mut().zip([error("f2"), error("f3"), value(row, "excess")]) {
                    *worst = worst.max(error);
                }
            }
        }
        for (worst, column) in worst.into_iter().zip(["f2", "f3", "excess"]) {
            let known = value(&accuracy, column);
            assert!(
                (worst - known).abs() <= 1e-9 + 1e-6 * known,
                "N = {n}, {column}: {worst} is not {known}"
            );
        }
    }
}

#[test]
fn featured_values_are_those_of_the_table() {
    let place = Place::new();
    plot(&place, "feasible-region --format svg --out . --size two");
    let rows = csv_rows(&place.read("feasible-region.csv"));
    assert_eq!(rows.len(), 18);
    let table = published("table1_featured_lambda");
    for row in &rows {
        for name in [
            "lambda_r1",
            "lambda_A",
            "lambda_l",
            "lambda_M",
            "lambda_CC",
            "lambda_C",
            "lambda_r2",
        ] {
            let known = table
                .iter()
                .find(|known| known["valence"] == row["valence"] && known["name"] == name);
            let known = value(known.unwrap(), "lambda");
            assert!(
                (value(row, name) - known).abs() < 1e-9,
                "{name}: {row:?} is not {known}"
            );
        }
    }
}

#[test]
fn wrong_signs_of_the_gauss_curvature() {
    let place = Place::new();
    plot(&place, "curvature-sign --valences 3..12 --format svg --out .");
    for row in csv_rows(&place.read("curvature-sign.csv")) {
        // the spline's stencil, measured by the objective's parts as the command prints them
        let [n, f2, f3] = ["valence", "splines_f2", "splines_f3"].map(|column| row[column].clone());
        let found = place.json(&format!("objective -N {n} --lambda 0.39 --f2 {f2} --f3 {f3}"));
        let parts = found["parts"].as_array().unwrap();
        let part = |k: usize, field: &str| parts[k][field].as_f64().unwrap();
        let wrong = (-part(0, "gauss_min")).max(0.0) + part(1, "gauss_max").max(0.0) + part(2, "gauss_max").max(0.0);
        assert!(
            (value(&row, "splines") - wrong).abs() <= 1e-6 * wrong.max(1.0),
            "{row:?} is not {wrong}"
        );
        // no wrong signs at N = 3 and 4, and the weight lessens those of N = 5, 6
        let (with, without) = (value(&row, "weighted"), value(&row, "unweighted"));
        match n.as_str() {
            "3" | "4" => assert_eq!((with, without), (0.0, 0.0)),
            "5" | "6" => assert!(with < 0.8 * without, "{row:?}"),
            _ => {}
        }
    }
}

#[test]
fn weights_of_the_objective() {
    let place = Place::new();
    plot(&place, "weighting --format svg --out .");
    let rows = csv_rows(&place.read("weighting.csv"));
    for row in &rows {
        let [k, r] = ["K", "r_epsilon=0.2"].map(|column| value(row, column));
        // r solves r^2 - K r = e^2
        assert!((r * r - k * r - 0.04).abs() < 1e-12 && r > 0.0, "{row:?}");
    }
    let at_zero = rows.iter().find(|row| value(row, "K") == 0.0).unwrap();
    assert!((value(at_zero, "w_n=5_epsilon=0.2") - 5.0).abs() < 1e-12);
}

#[test]
fn options_choose_files_and_ranges() {
    let place = Place::new();
    let names = plot(&place, "stencils weighting --format png --dpi 40 --out sub/folder");
    assert_eq!(
        names,
        ["stencils.png", "stencils.csv", "weighting.png", "weighting.csv"].map(|name| format!("sub/folder/{name}"))
    );
    plot(&place, "stencils --valences 5 --range 0.3..0.4 --out . --format svg");
    for row in csv_rows(&place.read("stencils.csv")) {
        assert!((0.3..=0.4).contains(&value(&row, "lambda")) && row["valence"] == "5");
    }
    let names = plot(
        &place,
        "curvature-sign --lambda 0.3,0.5 --valences 5 --out . --format svg",
    );
    assert_eq!(names.iter().filter(|name| name.ends_with("lambda0.3.csv")).count(), 1);
    assert_eq!(names.len(), 4);
}

/// One drawing in three formats; a single picture into a file.
#[test]
fn pictures_as_pages_and_into_files() {
    let place = Place::new();
    let names = plot(&place, "weighting --format pdf,svg --out .");
    assert_eq!(names, ["./weighting.svg", "./weighting.pdf", "./weighting.csv"]);
    let names = plot(&place, "weighting -o new.pdf --size one");
    assert_eq!(names, ["new.pdf", "new.csv"]);
    let names = plot(&place, "weighting -o other/new.PNG --dpi 40");
    assert_eq!(names, ["other/new.PNG", "other/new.csv"]);
    assert_eq!(place.read("new.csv"), place.read("weighting.csv"));
    let pdf = std::fs::read(place.path().join("weighting.pdf")).unwrap();
    let text = String::from_utf8_lossy(&pdf);
    // 178 mm by 62 mm, of 72 points an inch
    let start = text.find("/MediaBox [0 0 ").unwrap() + 15;
    let size: Vec<f64> = text[start..]
        .split(']')
        .next()
        .unwrap()
        .split(' ')
        .map(|n| n.parse().unwrap())
        .collect();
    assert!(
        (size[0] - 178.0 / 25.4 * 72.0).abs() < 0.01 && (size[1] - 62.0 / 25.4 * 72.0).abs() < 0.01,
        "{size:?}"
    );
    assert!(!text.contains("Date") && !text.contains("/Font"));
    place.ok(&["curve", "--example", "circle", "--plot", "circle.pdf"]);
    assert!(
        std::fs::read(place.path().join("circle.pdf"))
            .unwrap()
            .starts_with(b"%PDF")
    );
    for (line, words) in [
        ("plot weighting -o a.pdf --format svg", "disagrees with a.pdf"),
        ("plot weighting -o a.pdf --format svg,pdf", "several formats"),
        (
            "plot second-order-maps --valences 5,6 --schemes catmull-clark -o a.pdf",
            "2 pictures",
        ),
        ("plot weighting -o a.pdf --dpi 100", "--dpi has no meaning"),
        ("curve --example circle --plot a.pdf --dpi 100", "--dpi"),
    ] {
        let message = refused(&place, line);
        assert!(message.contains(words), "{line}: {message}");
    }
    assert!(!place.path().join("a.pdf").exists() && !place.path().join("a.csv").exists());
    let list = place.ok(&["plot", "--list"]);
    assert!(list.lines().all(|line| line.chars().count() <= 100), "{list}");
}

/// Maps of block 1 where another block has the subdominant eigenvalue say so, in their tables too.
#[test]
fn maps_of_a_pair_that_is_not_subdominant_say_so() {
    let place = Place::new();
    let rules = "f1 = \"1/4\"\nf2 = \"1/4\"\nf3 = \"1/4\"\nd1 = \"3/8\"\nd2 = \"3/8\"\ne1 = \"1/16\"\ne2 = \"1/16\"\nalpha = \"1/5\"\nbeta = \"1/30\"\n";
    place.write(
        "stray.toml",
        format!("kind = \"one-ring\"\n[[valence]]\nn = 3\n{rules}"),
    );
    for figure in ["characteristic-map", "natural-configurations", "second-order-maps"] {
        let line =
            format!("plot {figure} --schemes file:stray.toml,catmull-clark --valences 3 --format svg --out {figure}");
        let run = place.run(&line.split(' ').collect::<Vec<_>>());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        assert!(
            run.stderr
                .contains("note: stray at N = 3: the subdominant eigenvalue 0.4293190377 is of Fourier index 0, not 1"),
            "{}",
            run.stderr
        );
        let csv = run.stdout.lines().find(|name| name.ends_with(".csv")).unwrap();
        for row in csv_rows(&place.read(csv)) {
            assert_eq!(
                row["remark"].contains("index 0, not 1"),
                row["scheme"] == "stray",
                "{row:?}"
            );
        }
    }
}

#[test]
fn refusals() {
    let place = Place::new();
    let message = refused(&place, "plot nothing");
    assert!(
        message.contains("\"nothing\"") && message.contains("feasible-region, weighting, samples"),
        "{message}"
    );
    assert!(refused(&place, "plot").contains("--all"));
    place.write("file", "");
    assert!(refused(&place, "plot weighting --out file").contains("file is a file, and no picture"));
    assert!(refused(&place, "plot weighting --out file/below").contains("cannot write file/below"));
    assert!(refused(&place, "plot samples --results none").contains("cannot read none/lambda/tables.json"));
    std::fs::create_dir_all(place.path().join("old/lambda")).unwrap();
    place.write("old/lambda/tables.json", "{\"version\": 0}");
    assert!(refused(&place, "plot samples --results old").contains("old/lambda/tables.json"));
    for range in [
        "0.5..0.5", "0.6..0.5", "0.5", "x..1", "NaN..0.9", "0.1..0.9", "0.2..1.5",
    ] {
        let message = refused(&place, &format!("plot stencils --range {range}"));
        assert!(message.contains("0.125 <= A < B <= 1"), "{message}");
    }
    assert!(refused(&place, "plot stencils --range 0.95..0.96").contains("0.15..0.9"));
    assert!(refused(&place, "plot stencils --valences 30").contains("3 to 20"));
    assert!(refused(&place, "plot samples --valences 500").contains("lambda"));
    assert!(refused(&place, "plot weighting --valences 5").contains("does not take --valences"));
    assert!(refused(&place, "plot weighting --range 0.2..0.3").contains("--range for"));
    assert!(refused(&place, "plot weighting --lambda 0.3").contains("--lambda for curvature-sign"));
    for lambda in ["NaN", "0.125", "1", "-1"] {
        assert!(refused(&place, &format!("plot curvature-sign --lambda {lambda}")).contains("0.125 < lambda < 1"));
    }
    for dpi in ["0", "NaN", "1e9"] {
        assert!(refused(&place, &format!("plot weighting --dpi {dpi}")).contains("20 to 2400"));
    }
    assert!(refused(&place, "plot weighting --format gif").contains("svg, png, pdf"));
}
