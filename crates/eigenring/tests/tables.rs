//! `tables` and `reproduce`: complete, the same whatever the threads and interruptions, and checkable.

#![allow(missing_docs)]

use crate::common::{Place, csv_rows, files, number};
use eigenring_scheme::lambda::LambdaTable;
use std::io::{BufRead, BufReader};
use std::time::{Duration, Instant};

const FILES: [&str; 11] = [
    "accuracy.csv",
    "kinks.csv",
    "knots.csv",
    "optima.csv",
    "samples.csv",
    "table1_featured_lambda.csv",
    "table2_f2_at_featured.csv",
    "table3_f3_at_featured.csv",
    "table5_f2_coefficients.csv",
    "table6_f3_coefficients.csv",
    "tables.json",
];

/// `tables` for valence 5 into a folder, with more arguments.
fn tables(place: &Place, out: &str, more: &[&str]) -> Vec<(String, Vec<u8>)> {
    place.ok(&[&["tables", "--valences", "5", "--out", out], more].concat());
    files(&place.path().join(out).join("lambda"))
}

fn names(found: &[(String, Vec<u8>)]) -> Vec<&str> {
    found.iter().map(|(name, _)| name.as_str()).collect()
}

#[test]
fn same_bytes_for_any_number_of_threads_and_again() {
    let place = Place::new();
    let first = tables(&place, "out", &["--threads", "1"]);
    assert_eq!(names(&first), FILES);
    assert_eq!(csv_rows(&place.read("out/lambda/samples.csv")).len(), 100);
    for (name, bytes) in &first {
        assert!(
            !bytes.is_empty() && !String::from_utf8_lossy(bytes).contains("NaN"),
            "{name}"
        );
    }
    for threads in ["2", "8"] {
        assert!(
            tables(&place, threads, &["--threads", threads]) == first,
            "{threads} threads"
        );
    }
    // over existing results
    assert!(tables(&place, "out", &[]) == first);
}

#[test]
fn a_killed_run_resumes_to_the_same_files() {
    let place = Place::new();
    let whole = tables(&place, "whole", &[]);
    let samples = place.path().join("cut/lambda/.resume/N005.jsonl");
    for lines in [2, 10, 60] {
        let arguments = ["tables", "--valences", "5", "--out", "cut", "--threads", "1"];
        let mut child = place
            .command(&arguments)
            .stdout(std::process::Stdio::null())
            .spawn()
            .unwrap();
        let count = || match std::fs::File::open(&samples) {
            Ok(file) => BufReader::new(file).lines().count(),
            Err(_) => 0,
        };
        // each round starts where the last one was killed; the first line is the parameters
        let patience = Instant::now();
        while count() <= lines && patience.elapsed() < Duration::from_secs(60) && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_micros(200));
        }
        child.kill().unwrap();
        child.wait().unwrap();
        let text = std::fs::read_to_string(&samples).expect("the run was killed before its end");
        assert!(text.lines().count() > lines, "the run was killed after {lines} samples");
        // as if the machine had stopped while the last line was written
        std::fs::write(&samples, &text[..text.len() - 7]).unwrap();
        assert!(!place.path().join("cut/lambda/tables.json").exists());
    }
    let resumed = tables(&place, "cut", &[]);
    assert!(resumed == whole);
    assert!(!samples.parent().unwrap().exists());
}

#[test]
fn samples_of_other_parameters_are_not_resumed() {
    let place = Place::new();
    let whole = tables(&place, "whole", &["--unweighted"]);
    std::fs::create_dir_all(place.path().join("out/lambda/.resume")).unwrap();
    let strange = "{\"version\":\"0\",\"parameters\":{}}\n{\"valence\":5,\"lambda\":0.15}\n";
    place.write("out/lambda/.resume/N005.jsonl", strange);
    let found = tables(&place, "out", &["--unweighted"]);
    assert!(found == whole);
    // and unweighted is another objective
    assert!(tables(&place, "out", &[]) != whole);
}

#[test]
fn a_check_finds_a_changed_digit() {
    let place = Place::new();
    place.ok(&["tables", "--valences", "5", "--out", "out"]);
    let before = files(place.path());
    let check = ["reproduce", "--check", "--out", "out"];
    let report = place.ok(&check);
    assert_eq!(report.lines().count(), FILES.len());
    assert!(!report.contains("DIFFERENT"), "{report}");
    assert!(files(place.path()) == before, "a check writes nothing");

    // the third digit of f2 in one sample
    let csv = place.read("out/lambda/samples.csv");
    let line = csv.lines().nth(40).unwrap();
    let f2 = csv_rows(&csv)[39]["f2"].clone();
    let digit = f2.as_bytes()[4];
    let other = format!("{}{}{}", &f2[..4], if digit == b'7' { '8' } else { '7' }, &f2[5..]);
    place.write("out/lambda/samples.csv", csv.replace(line, &line.replace(&f2, &other)));
    let run = place.run(&check);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stdout.contains("DIFFERENT  lambda/samples.csv"), "{}", run.stdout);
    let place_line = run
        .stdout
        .lines()
        .find(|line| line.contains("row 41, f2"))
        .expect(&run.stdout);
    assert!(
        place_line.contains(&format!("stored {other}, now {f2}")),
        "{place_line}"
    );
    assert_eq!(run.stdout.matches("DIFFERENT").count(), 1);
    // a digit beyond the tolerances' reach is no difference, but told
    place.write(
        "out/lambda/samples.csv",
        csv.replace(line, &line.replace(&f2, &format!("{f2}1"))),
    );
    let report = place.ok(&check);
    let notices: Vec<&str> = report.lines().filter(|line| line.starts_with("notice")).collect();
    let expected = format!("differing within the tolerances: 1, most row 41, f2: stored {f2}1, now {f2}, by ");
    assert!(notices.len() == 1 && notices[0].contains(&expected), "{report}");
    // a missing row
    let shorter: Vec<&str> = csv.lines().take(100).collect();
    place.write("out/lambda/samples.csv", shorter.join("\n") + "\n");
    assert_eq!(place.run(&check).code, Some(1));
    place.write("out/lambda/samples.csv", &csv);

    let json = place.read("out/lambda/tables.json");
    let mut value: serde_json::Value = serde_json::from_str(&json).unwrap();
    let entry = &mut value["valences"][0]["lambda_l"];
    *entry = (entry.as_f64().unwrap() + 1e-4).into();
    place.write("out/lambda/tables.json", value.to_string());
    let run = place.run(&check);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stdout.contains("DIFFERENT  lambda/tables.json"), "{}", run.stdout);
    assert!(run.stdout.contains(".valences[0].lambda_l: stored"), "{}", run.stdout);
    // coarse tolerances let it pass
    assert_eq!(place.run(&[&check[..], &["--atol", "1e-3"]].concat()).code, Some(0));

    // a missing file, and all of it rebuilt
    std::fs::remove_file(place.path().join("out/lambda/knots.csv")).unwrap();
    assert_eq!(place.run(&check).code, Some(2));
    place.ok(&["reproduce", "--out", "out"]);
    assert!(files(place.path()) == before);
}

#[test]
fn an_index_says_what_is_made_and_checked() {
    let place = Place::new();
    place.ok(&["tables", "--valences", "5", "--out", "out"]);
    let index = |rest: &str| {
        let lambda = "[[entry]]\nname = \"lambda\"\ncommand = \"eigenring tables --valences 5\"\nfiles = [\"lambda/knots.csv\", \"lambda/samples.csv\"]\n";
        place.write("out/index.toml", format!("version = 1\n{lambda}{rest}"));
    };
    index("");
    let check = ["reproduce", "--check", "--out", "out"];
    let report = place.ok(&check);
    assert_eq!(report.lines().count(), 2, "{report}");
    // a slow entry with its own check, which holds or not; by name it is made anew
    let own = |check: &str| {
        index(&format!(
            "[[entry]]\nname = \"slow\"\ncommand = \"eigenring tables --valences 4\"\ncheck = \"{check}\"\nfiles = [\"lambda/tables.json\"]\n"
        ));
    };
    own("eigenring stencil -N 5 --lambda 0.5");
    assert!(place.ok(&check).contains("holds      slow"));
    own("eigenring stencil -N 5 --lambda 1.5");
    let run = place.run(&check);
    assert_eq!(run.code, Some(1));
    assert!(
        run.stdout.contains("REFUTED    slow") && run.stdout.contains("1.5"),
        "{}",
        run.stdout
    );
    let run = place.run(&[&check[..], &["--only", "slow"]].concat());
    assert_eq!(run.code, Some(1), "the files are those of another valence");
    assert!(run.stdout.contains("DIFFERENT  lambda/tables.json"), "{}", run.stdout);
    let report = place.ok(&[&check[..], &["--only", "lambda"]].concat());
    assert!(!report.contains("slow"), "{report}");
    let run = place.run(&[&check[..], &["--only", "quick"]].concat());
    assert_eq!((run.code, run.stderr.lines().count()), (Some(2), 1), "{}", run.stderr);
    assert!(run.stderr.contains("accepted is lambda, slow"), "{}", run.stderr);
}

#[test]
fn the_embedded_table_is_one_that_the_library_reads() {
    let place = Place::new();
    place.ok(&[
        "tables",
        "--valences",
        "4,5",
        "--out",
        "out",
        "--embed",
        "embedded/lambda.json",
    ]);
    let table = LambdaTable::from_json(&place.read("embedded/lambda.json")).unwrap();
    let entry = table.entry(5).unwrap();
    assert!((entry.lambda_optimal - 0.5599).abs() < 1e-3);
    let (f2, f3) = entry.weights(entry.lambda_optimal).unwrap();
    let optima = csv_rows(&place.read("out/lambda/optima.csv"));
    let row = optima
        .iter()
        .find(|row| row["valence"] == "5" && row["global"] == "1")
        .unwrap();
    assert!((row["f2"].parse::<f64>().unwrap() - f2).abs() < 1e-12);
    assert!((row["f3"].parse::<f64>().unwrap() - f3).abs() < 1e-12);
    assert!(table.entry(6).is_err());
    // the library carries the same numbers for these valences
    let embedded = LambdaTable::embedded().unwrap().entry(5).unwrap();
    assert!((embedded.lambda_optimal - entry.lambda_optimal).abs() < 1e-9);
}

#[test]
fn the_recorded_command_makes_the_same_results() {
    let place = Place::new();
    let options =
        "--unweighted --knots paper --margin 1e-5 --quadrature 4 --phi 5 --bounds sharp --normalisation unit-ring";
    let options: Vec<&str> = options.split(' ').collect();
    let first = tables(&place, "first", &options);
    let json: serde_json::Value = serde_json::from_str(&place.read("first/lambda/tables.json")).unwrap();
    let command = json["provenance"]["command"].as_str().unwrap();
    let arguments: Vec<&str> = command.split(' ').skip(1).chain(["--out", "second"]).collect();
    place.ok(&arguments);
    assert!(files(&place.path().join("second/lambda")) == first, "{command}");
    place.ok(&["reproduce", "--check", "--out", "second"]);
}

#[test]
fn knots_of_the_paper() {
    let place = Place::new();
    place.ok(&["tables", "--valences", "5,8", "--out", "out", "--knots", "paper"]);
    let kinks = csv_rows(&place.read("out/lambda/kinks.csv"));
    for row in csv_rows(&place.read("out/lambda/knots.csv")) {
        let triple = |knot: f64| {
            (1..=21)
                .filter(|i| row[&format!("xi{i}")].parse::<f64>().unwrap() == knot)
                .count()
        };
        let mut slots = 0;
        for kink in kinks.iter().filter(|kink| kink["valence"] == row["valence"]) {
            let paper: f64 = kink["paper"].parse().unwrap();
            assert_eq!(triple(paper), 3, "valence {}, knot {paper}", row["valence"]);
            slots += 1;
        }
        assert!(slots > 0, "no kinks at valence {}", row["valence"]);
    }
}

#[test]
fn latex_on_request() {
    let place = Place::new();
    let run = place.run(&["tables", "--valences", "5", "--out", "out", "--format", "latex"]);
    assert!(run.stdout.starts_with("\\begin{tabular}"), "{}", run.stdout);
    let found = files(&place.path().join("out/lambda"));
    let tex: Vec<&str> = names(&found)
        .into_iter()
        .filter(|name| name.ends_with(".tex"))
        .collect();
    assert_eq!(
        tex,
        [
            "table1_featured_lambda.tex",
            "table2_f2_at_featured.tex",
            "table3_f3_at_featured.tex",
            "table5_f2_coefficients.tex",
            "table6_f3_coefficients.tex"
        ]
    );
    assert_eq!(found.len(), FILES.len() + tex.len());
}

/// At some lambdas; `scripts/starting-points.sh` has those of the whole table.
#[test]
fn all_starting_points_lead_to_the_same_minima() {
    let place = Place::new();
    for lambda in ["0.16", "0.3", "0.39", "0.55", "0.7", "0.86"] {
        let [grid, full] = ["10x10", "full"].map(|starts| {
            let found = place.json(&format!("tune -N 5 --lambda {lambda} --starts {starts}"));
            ["total", "lowest"].map(|field| number(&found, field))
        });
        for (x, y) in grid.into_iter().zip(full) {
            assert!((x - y).abs() <= 1e-6 * x, "lambda = {lambda}: {x} and {y}");
        }
    }
}
