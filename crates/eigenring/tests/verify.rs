//! Certificates on the command line: verdicts and exit codes, planted faults, what is refused.

#![allow(missing_docs)]

use crate::common::{Place, csv_rows, has_fields, number};
use eigenring_certify::Statement;
use serde_json::Value;

/// Runs `verify` with JSON output, which must end with the code given.
fn verify(place: &Place, line: &str, code: i32) -> Value {
    let arguments: Vec<&str> = ["verify"]
        .into_iter()
        .chain(line.split_whitespace())
        .chain(["--format", "json"])
        .collect();
    let run = place.run(&arguments);
    assert_eq!(run.code, Some(code), "{line}: {}{}", run.stdout, run.stderr);
    serde_json::from_str(&run.stdout).unwrap()
}

fn check<'a>(found: &'a Value, name: &str) -> &'a Value {
    let checks = found["checks"].as_array().unwrap();
    let named = checks.iter().find(|check| check["name"] == name);
    named.unwrap_or_else(|| panic!("no check {name} in {found}"))
}

/// Asserts a refutation with a sentence; gives the numbers in it, as their enclosures.
fn witness<'a>(found: &'a Value, name: &str) -> (&'a str, &'a Value) {
    let check = check(found, name);
    assert_eq!(check["status"], "refuted", "{check}");
    assert_eq!(
        (&check["holds"], &check["rigorous"]),
        (&Value::Bool(false), &Value::Bool(true))
    );
    let witness = &check["witness"];
    (witness["text"].as_str().unwrap(), &witness["data"])
}

/// Asserts that an enclosure is narrow and holds a number, known to some digits.
fn encloses(enclosure: &Value, value: f64, tolerance: f64) {
    let [lower, upper] = [0, 1].map(|end| enclosure[end].as_f64().unwrap());
    assert!(lower <= upper && upper - lower <= 1e-9, "{enclosure}");
    assert!(
        lower - tolerance <= value && value <= upper + tolerance,
        "{enclosure} and {value}"
    );
}

/// A line of standard error, with exit code 2 and nothing on standard output.
pub(crate) fn refused(place: &Place, line: &str) -> String {
    let arguments: Vec<&str> = ["verify"].into_iter().chain(line.split_whitespace()).collect();
    let run = place.run(&arguments);
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{line}: {}", run.stderr);
    assert_eq!(run.stderr.lines().count(), 1, "{line}: {}", run.stderr);
    run.stderr
}

/// A one-ring scheme of valence 5 with these weights: f1, f2, f3, d1, d2, e1, e2, alpha, beta.
fn one_ring(place: &Place, weights: [&str; 9]) {
    let names = ["f1", "f2", "f3", "d1", "d2", "e1", "e2", "alpha", "beta"];
    let mut text = "kind = \"one-ring\"\nname = \"planted\"\n[[valence]]\nn = 5\n".to_owned();
    for (name, weight) in names.into_iter().zip(weights) {
        text.push_str(&format!("{name} = {weight}\n"));
    }
    place.write("planted.toml", text);
}

const PLANTED: &str = "--scheme file:planted.toml -N 5";

#[test]
fn fields_and_exit_codes() {
    let place = Place::new();
    for (line, code) in [
        ("--scheme catmull-clark -N 5", 0),
        ("--scheme catmull-clark -N 5 --require c1", 0),
        ("--scheme catmull-clark -N 5 --require hull", 0),
        ("--scheme catmull-clark -N 5 --require bounded", 1),
        ("--scheme catmull-clark -N 5 --require strict", 1),
        ("--scheme catmull-clark -N 4 --require bounded", 0),
        ("--scheme lambda:optimal -N 6 --require strict", 0),
    ] {
        let found = verify(&place, line, code);
        has_fields(&found, "scheme valence require status holds checks");
        assert_eq!(found["holds"], Value::Bool(code == 0), "{line}");
        assert_eq!(found["status"], ["proven", "refuted"][code as usize], "{line}");
        let names: Vec<&str> = found["checks"]
            .as_array()
            .unwrap()
            .iter()
            .map(|c| c["name"].as_str().unwrap())
            .collect();
        let expected = Statement::ALL
            .into_iter()
            .filter(|statement| *statement != Statement::Levels);
        assert!(
            names.iter().copied().eq(expected.map(Statement::name)),
            "{line}: {names:?}"
        );
        for check in found["checks"].as_array().unwrap() {
            has_fields(check, "name status holds rigorous margin enclosure witness reached");
            let proven = check["status"] == "proven";
            assert_eq!(check["holds"], Value::Bool(proven), "{check}");
            assert_eq!(check["witness"].is_null(), check["status"] != "refuted", "{check}");
            assert_eq!(
                check["reached"].is_string(),
                check["status"] == "undecided" || check["reached"].is_string()
            );
        }
    }
}

#[test]
fn catmull_clark_is_c1_and_its_curvature_what_is_known_of_it() {
    let place = Place::new();
    // Peters and Reif (2008), 6.2, for lambda; mu in block 2 by the same formula with the cosine of that
    // block
    let eigenvalue = |n: usize, k: usize| {
        let c = (std::f64::consts::TAU * k as f64 / n as f64).cos();
        (c + 5.0 + ((c + 9.0) * (c + 1.0)).sqrt()) / 16.0
    };
    for n in [3, 4, 5, 6, 17, 64] {
        let found = verify(&place, &format!("--scheme catmull-clark -N {n}"), 0);
        let lambda = eigenvalue(n, 1);
        encloses(&check(&found, "subdominant")["enclosure"], lambda, 1e-14);
        for name in ["row_sums", "dominant", "subdominant", "regular", "injective"] {
            assert_eq!(check(&found, name)["status"], "proven", "{n} {name}");
        }
        match n {
            3 => {
                // a flat spot: bounded, and less than lambda^2
                let bounded = check(&found, "bounded_curvature");
                assert_eq!(bounded["status"], "proven");
                encloses(&bounded["enclosure"], 0.991, 5e-4);
                witness(&found, "non_degenerate");
            }
            4 => {
                assert_eq!(check(&found, "bounded_curvature")["status"], "proven");
                assert_eq!(check(&found, "non_degenerate")["status"], "proven");
            }
            _ => {
                let ratio = eigenvalue(n, 2) / (lambda * lambda);
                encloses(&witness(&found, "bounded_curvature").1["ratio"], ratio, 1e-12);
            }
        }
    }
    let five = verify(&place, "--scheme catmull-clark -N 5", 0);
    encloses(
        &witness(&five, "bounded_curvature").1["ratio"],
        0.340107 / (0.549988 * 0.549988),
        1e-5,
    );
}

#[test]
fn members_of_the_lambda_scheme() {
    let place = Place::new();
    // given weights, exact as written in binary
    let given = verify(
        &place,
        "--scheme lambda:lambda=0.55,f2=0.3,f3=0.1 -N 6 --require strict",
        0,
    );
    encloses(&check(&given, "subdominant")["enclosure"], 0.55, 0.0);
    encloses(&check(&given, "non_degenerate")["enclosure"], 0.55 * 0.55, 1e-15);
    // where s > 1, curvature is unbounded with mu = s lambda^2
    let stencil = place.json("stencil -N 6 --lambda 0.3");
    let s = number(&stencil, "s");
    assert!(s > 1.1);
    let relaxed = verify(&place, "--scheme lambda:lambda=0.3 -N 6 --require bounded", 1);
    assert_eq!(verify(&place, "--scheme lambda:lambda=0.3 -N 6", 0)["holds"], true);
    encloses(&witness(&relaxed, "bounded_curvature").1["ratio"], s, 1e-14);
    // lambda^2 missed by one part in a million
    let missed = "--scheme lambda:lambda=0.55,f2=0.3,f3=0.1,s=1.000001 -N 6 --require bounded";
    encloses(
        &witness(&verify(&place, missed, 1), "bounded_curvature").1["ratio"],
        1.000001,
        1e-15,
    );
    // at valence 4 f3 is mu
    let four = verify(&place, "--scheme lambda:optimal -N 4 --require strict", 0);
    assert!(four["scheme"].as_str().unwrap().contains("f3=mu"), "{}", four["scheme"]);
}

#[test]
fn an_outer_ring_that_shares_lambda_is_left_open() {
    let place = Place::new();
    // order 3 at N = 3: lambda = 1/4 is an eigenvalue of the outer rings too, with a Jordan block
    let found = verify(&place, "--scheme tension:order=3 -N 3", 1);
    assert_eq!(found["status"], "undecided");
    let checks = found["checks"].as_array().unwrap();
    let subdominant = checks.iter().find(|check| check["name"] == "subdominant").unwrap();
    assert!(
        subdominant["reached"].as_str().unwrap().contains("repeated"),
        "{subdominant}"
    );
    assert_eq!(verify(&place, "--scheme tension:order=3 -N 4", 0)["status"], "proven");
}

#[test]
fn planted_row_sum() {
    let place = Place::new();
    one_ring(
        &place,
        [
            "0.250000001",
            "0.25",
            "0.25",
            "0.375",
            "0.375",
            "0.0625",
            "0.0625",
            "\"3/10\"",
            "\"1/20\"",
        ],
    );
    let found = verify(&place, PLANTED, 1);
    let (_, data) = witness(&found, "row_sums");
    encloses(&data["defect"], 1e-9, 1e-22);
    let [lower, upper] = [0, 1].map(|end| data["defect"][end].as_f64().unwrap());
    assert!(lower > 0.99e-9 && upper < 1.01e-9);
    assert_eq!((&found["status"], &found["holds"]), (&"refuted".into(), &false.into()));
}

#[test]
fn planted_eigenvalues() {
    let place = Place::new();
    // without f2 and e2, block k has the eigenvalues d2 + 2 e1 cos(2 pi k/5) and f3
    let cosine = |k: usize| (std::f64::consts::TAU * k as f64 / 5.0).cos();
    one_ring(&place, ["0.9", "0", "0.1", "1.6", "-0.4", "-0.1", "0", "-0.5", "0"]);
    let negative = verify(&place, PLANTED, 1);
    let (text, data) = witness(&negative, "subdominant");
    assert!(text.contains("not positive"), "{text}");
    encloses(&data["re"], -0.4 - 0.2 * cosine(1), 1e-15);

    one_ring(&place, ["0.9", "0", "0.1", "0.9", "0.3", "-0.1", "0", "0.1", "0"]);
    let second = verify(&place, PLANTED, 1);
    let (text, data) = witness(&second, "subdominant");
    assert!(text.contains("block 2"), "{text}");
    encloses(&data["fourier"], 2.0, 0.0);
    encloses(&data["re"], 0.3 - 0.2 * cosine(2), 1e-15);
}

#[test]
fn planted_square() {
    let place = Place::new();
    let weights = [
        "0.249999", "0.25", "0.250001", "0.375", "0.375", "0.0625", "0.0625", "0.375", "0.0625",
    ];
    one_ring(&place, weights);
    place.write("four.toml", place.read("planted.toml").replace("n = 5", "n = 4"));
    let line = "--scheme file:four.toml -N 4";
    let found = verify(&place, &format!("{line} --require bounded"), 1);
    let (_, data) = witness(&found, "bounded_curvature");
    // block 2 is diagonal, and f3 is one of its entries
    encloses(&data["re"], 0.250001, 1e-15);
    let lambda = number(&place.json(&format!("spectrum {line}")), "subdominant");
    encloses(&data["ratio"], 0.250001 / (lambda * lambda), 1e-12);
    assert!(data["ratio"][1].as_f64().unwrap() < 1.000_01);
    assert_eq!(verify(&place, line, 0)["status"], "proven");
}

#[test]
fn planted_fold() {
    let place = Place::new();
    // f2 < 0 takes the face points behind the centre
    one_ring(&place, ["1", "-0.05", "0.1", "0.4", "0.4", "0.1", "0", "0.4", "0"]);
    let found = verify(&place, PLANTED, 1);
    assert_eq!(check(&found, "subdominant")["status"], "proven");
    let (_, data) = witness(&found, "regular");
    // two points of the annulus with Jacobians of opposite signs
    has_fields(
        data,
        "smallest_p smallest_q smallest_u smallest_v largest_p largest_q largest_u largest_v",
    );
    assert!(data["smallest"][1].as_f64().unwrap() < 0.0 && data["largest"][0].as_f64().unwrap() > 0.0);
}

#[test]
fn planted_sheets() {
    let place = Place::new();
    // further behind it: the Jacobian has one sign again, and each sector turns by 1 - 1/5 backwards
    one_ring(&place, ["1.3", "-0.2", "0.1", "0.4", "0.4", "0.1", "0", "0.4", "0"]);
    let found = verify(&place, PLANTED, 1);
    assert_eq!(check(&found, "regular")["status"], "proven");
    encloses(&witness(&found, "injective").1["winding"], -4.0, 0.0);
}

#[test]
fn ranges() {
    let place = Place::new();
    let strict = verify(&place, "--lambda-range 0.55..0.6 -N 6 --require strict", 0);
    has_fields(&strict, "scheme valence lambda require status holds segments checks");
    assert_eq!(strict["segments"].as_array().unwrap().len(), 1);
    assert_eq!(strict["segments"][0]["lambda"], serde_json::json!([0.55, 0.6]));
    // s > 1 below lambda_l: C1, and curvature is unbounded
    let relaxed = verify(&place, "--lambda-range 0.3..0.32 -N 6 --require bounded", 1);
    assert_eq!(relaxed["status"], "refuted");
    let witness = relaxed["segments"][0]["witness"].as_str().unwrap();
    assert!(
        witness.contains("bounded_curvature fails at lambda = 0.31"),
        "{witness}"
    );
    assert_eq!(verify(&place, "--lambda-range 0.3..0.32 -N 6", 0)["status"], "proven");
    // constant weights, and the range that contains the end of what is admissible for them
    let constant = "--scheme lambda:lambda=0.5,f2=0.3,f3=0.1 -N 6";
    assert_eq!(
        verify(
            &place,
            &format!("{constant} --lambda-range 0.54..0.56 --require strict"),
            0
        )["holds"],
        true
    );
    let inside = number(&place.json("stencil -N 6 --lambda 0.6"), "lambda");
    assert_eq!(inside, 0.6);

    for (range, says) in [
        ("0.6..0.4", "A < B"),
        ("0.5..0.5", "A < B"),
        ("0.5", "A..B"),
        ("NaN..0.6", "A..B"),
        ("0.5..inf", "A..B"),
        ("-1..0.5", "0.15"),
        ("0.1..0.5", "0.15"),
        ("0.5..0.95", "0.9"),
    ] {
        let message = refused(&place, &format!("--lambda-range {range} -N 6"));
        assert!(message.contains(says), "{message}");
    }
    refused(&place, "--lambda-range 0.5..0.6 -N 64");
    refused(&place, "--lambda-range 0.5..0.6 -N 6 --require hull");
    refused(&place, "--lambda-range 0.5..0.6 -N 6 --scheme catmull-clark");
    refused(&place, "--lambda-range 0.5..0.6 -N 6 --scheme lambda:lambda=0.5,s=1.1");
}

#[test]
fn bad_input() {
    let place = Place::new();
    for (line, says) in [
        ("--scheme nothing -N 5", "catmull-clark"),
        ("--scheme catmull-clark -N 2", "3 to 1000"),
        ("--scheme catmull-clark -N -5", "3 to 1000"),
        ("--scheme catmull-clark", "-N"),
        ("-N 5", "--scheme"),
        ("--scheme catmull-clark -N 5 --require beauty", "c1"),
        ("--scheme catmull-clark -N 5 --recheck x.json", "--recheck"),
        ("--scheme lambda:lambda=0.55,f2=nan,f3=0.1 -N 6", "f2"),
        ("--scheme lambda:lambda=1.5 -N 6", "lambda"),
        ("--scheme file:missing.toml -N 5", "missing.toml"),
    ] {
        let message = refused(&place, line);
        assert!(message.contains(says), "{line}: {message}");
    }
    one_ring(&place, ["0.25"; 9]);
    let message = refused(&place, "--scheme file:planted.toml -N 6");
    assert!(message.contains('5'), "{message}");
    place.write(
        "planted.toml",
        "kind = \"one-ring\"\n[[valence]]\nn = 5\nf1 = \"1/0\"\n",
    );
    assert!(refused(&place, PLANTED).contains("planted.toml"));
}

#[test]
fn large_blocks_end_with_something_honest() {
    let place = Place::new();
    // too large for exact characteristic polynomials: proven or undecided with a reason, and exit codes
    // accordingly
    let run = place.run(&["verify", "--scheme", "tension:order=12", "-N", "5", "--format", "json"]);
    let found: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(run.code, Some(i32::from(found["status"] != "proven")), "{}", run.stderr);
    assert_ne!(found["status"], "refuted", "{found}");
    let spectrum = place.json("spectrum --scheme tension:order=12 -N 5");
    if let Some([lower, upper]) = check(&found, "subdominant")["enclosure"].as_array().map(Vec::as_slice) {
        let (lower, upper) = (lower.as_f64().unwrap(), upper.as_f64().unwrap());
        let lambda = number(&spectrum, "subdominant");
        assert!(
            lower - 1e-9 <= lambda && lambda <= upper + 1e-9,
            "{lower} {lambda} {upper}"
        );
    }
    assert_eq!(check(&found, "row_sums")["status"], "proven");
    assert_eq!(check(&found, "hull")["status"], "proven");
    for check in found["checks"].as_array().unwrap() {
        if check["status"] == "undecided" {
            assert!(
                check["reached"].as_str().is_some_and(|text| !text.is_empty()),
                "{check}"
            );
        }
    }
}

#[test]
fn tables_in_every_format() {
    let place = Place::new();
    for line in ["--scheme catmull-clark -N 5", "--lambda-range 0.55..0.56 -N 5"] {
        for format in ["text", "csv", "latex"] {
            let arguments: Vec<&str> = ["verify"]
                .into_iter()
                .chain(line.split(' '))
                .chain(["--format", format])
                .collect();
            let text = place.ok(&arguments);
            assert!(text.contains("regular") && !text.contains("NaN"), "{text}");
            if format == "csv" {
                let mut records = csv::Reader::from_reader(text.as_bytes());
                assert!(records.records().map(Result::unwrap).count() >= 7);
            }
        }
    }
}

#[test]
fn all_certificates_are_made_confirmed_and_drawn() {
    let place = Place::new();
    place.ok(&["verify", "--all", "--valences", "4", "--out", "results"]);
    let singles = csv_rows(&place.read("results/certificates/summary.csv"));
    // Catmull-Clark at 3 to 64, the lambda-scheme at A, M and C
    assert_eq!(singles.len(), 62 + 3);
    assert!(singles.iter().all(|row| row["is_c1"] == "proven"));
    let found = place.json("verify --recheck results/certificates");
    let found = found.as_array().unwrap();
    // and all valences of two schemes, the recommended range and that of the table
    assert_eq!(found.len(), 62 + 3 + 2 + 2);
    assert!(found.iter().all(|row| row["result"] == "confirmed"), "{found:?}");
    // the rule gives s = 1 from lambda_l + 0.01 on, lambda_l^2 = 1/8
    let ranges = csv_rows(&place.read("results/certificates/ranges.csv"));
    let bounded = |row: &&std::collections::BTreeMap<String, String>| {
        row["range"] == "tabulated" && row["require"] == "bounded" && row["status"] == "proven"
    };
    let from: Vec<f64> = ranges
        .iter()
        .filter(bounded)
        .map(|row| row["from"].parse().unwrap())
        .collect();
    assert_eq!(from.len(), 1);
    assert!((from[0] - (0.125_f64.sqrt() + 0.01)).abs() < 1e-6);
    // the picture is the same from stored certificates and from new ones
    let tables = concat!(env!("CARGO_MANIFEST_DIR"), "/../../results/lambda/tables.json");
    std::fs::create_dir_all(place.path().join("results/lambda")).unwrap();
    place.write("results/lambda/tables.json", std::fs::read(tables).unwrap());
    let drawn = |folder: &str| {
        let run = place
            .command(&["plot", "certificates", "--valences", "4", "--out", folder])
            .output()
            .unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        csv_rows(&place.read(&format!("{folder}/certificates.csv")))
    };
    let stored = drawn("stored");
    std::fs::remove_file(place.path().join("results/certificates/ranges.csv")).unwrap();
    assert_eq!(stored, drawn("new"));
    assert!(stored.len() >= 4);
}

#[test]
fn an_open_range_has_one_verdict() {
    let place = Place::new();
    let found = verify(&place, "--scheme catmull-clark --valences 3..", 0);
    assert_eq!((&found["status"], &found["holds"]), (&"proven".into(), &true.into()));
    assert_eq!(found["single"].as_array().unwrap().len(), 2);
    assert_eq!(found["all"]["from"], 5);
    let (text, data) = witness(&found["all"], "bounded_curvature");
    assert!(text.contains("at every valence") && data["ratio"][0].as_f64().unwrap() > 1.1);
    assert_eq!(
        verify(&place, "--scheme catmull-clark -N 3..4,9.. --require bounded", 1)["status"],
        "refuted"
    );
    assert_eq!(verify(&place, "--scheme doo-sabin -N 700..", 0)["all"]["from"], 700);
    // stored with those of the valences before, and checked again
    let run = place.run(&["verify", "--scheme", "doo-sabin", "-N", "4..", "-o", "all"]);
    assert!(
        run.stdout.ends_with("c1 is proven for every N >= 4\n"),
        "{}",
        run.stdout
    );
    let rows = place.run(&["verify", "--recheck", "all", "--format", "csv"]);
    assert_eq!(
        (rows.code, csv_rows(&rows.stdout).len()),
        (Some(0), 2),
        "{}",
        rows.stdout
    );
    let path = place.path().join("all/N005-and-more.json");
    let text = std::fs::read_to_string(&path)
        .unwrap()
        .replace("\"undecided\"", "\"proven\"");
    std::fs::write(&path, text).unwrap();
    let run = place.run(&["verify", "--recheck", "all/N005-and-more.json"]);
    assert!(
        run.code == Some(1) && run.stdout.contains("bounded_curvature: not as claimed"),
        "{}",
        run.stdout
    );
    for (line, accepted) in [
        ("--scheme lambda:optimal -N 3..", "catmull-clark and doo-sabin"),
        ("--scheme catmull-clark -N 3.. --fan 3", "--fan"),
        ("--scheme catmull-clark -N 3.. --exact", "file:"),
        ("--lambda-range 0.4..0.6 -N 3..", "a range with an end"),
        ("--scheme catmull-clark -N 1001..", "3 to 1000"),
    ] {
        assert!(refused(&place, line).contains(accepted), "{line}");
    }
}
