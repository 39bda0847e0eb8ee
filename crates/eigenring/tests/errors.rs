//! Bad input: exit code 2, nothing on standard output, one line on standard error that says what is accepted.

#![allow(missing_docs)]

use crate::common::{Place, files, number};
use serde_json::Value;

/// Asserts the refusal in text and JSON form; gives the message and what is accepted.
fn refused(place: &Place, arguments: &[&str]) -> (String, Option<String>) {
    let text = place.run(arguments);
    assert_eq!(
        (text.code, text.stdout.as_str()),
        (Some(2), ""),
        "{arguments:?}: {}",
        text.stderr
    );
    assert_eq!(text.stderr.lines().count(), 1, "{arguments:?}: {}", text.stderr);
    let message = text.stderr.trim_end().strip_prefix("error: ");
    let message = message.unwrap_or_else(|| panic!("{arguments:?}: {}", text.stderr));
    assert!(
        message.len() < 500 && !message.contains('\x1b'),
        "{arguments:?}: {message}"
    );
    if arguments.contains(&"--format") || arguments.first() == Some(&"reproduce") {
        return (message.to_owned(), None);
    }
    let json = place.run(&[arguments, &["--format", "json"]].concat());
    assert_eq!((json.code, json.stdout.as_str()), (Some(2), ""), "{arguments:?}");
    assert_eq!(json.stderr.lines().count(), 1, "{arguments:?}: {}", json.stderr);
    let object: Value = serde_json::from_str(&json.stderr).unwrap();
    assert_eq!(object["error"], message, "{arguments:?}");
    let accepted = object["accepted"].as_str().map(str::to_owned);
    (message.to_owned(), accepted)
}

/// Asserts that a refusal says what is accepted.
fn out_of_range(place: &Place, line: &str) -> (String, String) {
    let arguments: Vec<&str> = line.split(' ').collect();
    let (message, accepted) = refused(place, &arguments);
    let accepted = accepted.unwrap_or_else(|| panic!("{line}: nothing is accepted: {message}"));
    assert!(
        accepted.len() > 2 && accepted.matches('[').count() == accepted.matches(']').count(),
        "{line}: {accepted}"
    );
    assert!(message.ends_with(&accepted), "{line}: {message}");
    (message, accepted)
}

/// A reader of errors that has gone away is no error, and numbers have no hundreds of zeros.
#[test]
fn errors_nobody_reads_and_tiny_numbers() {
    let place = Place::new();
    place.write("empty.obj", "");
    for line in [
        "mesh empty.obj",
        "spectrum --scheme catmull-clark -N 2",
        "spectrum --matrix empty.obj",
    ] {
        let arguments: Vec<&str> = line.split(' ').collect();
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let status = place
            .command(&arguments)
            .stdout(writer.try_clone().unwrap())
            .stderr(writer)
            .status();
        assert_eq!(status.unwrap().code(), Some(2), "{line}");
    }
    for line in [
        "objective -N 6 --lambda 0.55 --f2 1e-300 --f3 0.2",
        "spectrum --scheme catmull-clark -N 1000 --rings 64",
        "eigenvectors --scheme catmull-clark -N 1000 --rings 3",
        "spectrum --scheme file: -N 5",
    ] {
        let (message, _) = refused(&place, &line.split(' ').collect::<Vec<_>>());
        assert!(message.len() < 400, "{message}");
    }
}

/// What is divided by zero is named, with the scheme and the valence.
#[test]
fn divisors_that_vanish() {
    let place = Place::new();
    let scheme = "lambda:lambda=0.55,f2=0,f3=0.2";
    for line in [
        format!("spectrum -N 6 --scheme {scheme}"),
        format!("matrix -N 6 --scheme {scheme} -o out.csv"),
        format!("eigenvectors -N 6 --scheme {scheme} -o out.csv"),
        format!("compare -N 6 --schemes {scheme}"),
        format!("verify -N 6 --scheme {scheme}"),
        format!("plot characteristic-map --valences 6 --schemes {scheme}"),
    ] {
        let run = place.run(&line.split(' ').collect::<Vec<_>>());
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{line}");
        assert!(
            run.stderr
                .contains("the lambda-scheme has no weights at N = 6, lambda = 0.55, f2 = 0, f3 = 0.2: f2 vanishes"),
            "{line}: {}",
            run.stderr
        );
    }
    let over = format!("verify -N 6 --scheme {scheme} --lambda-range 0.5..0.6");
    assert!(
        refused(&place, &over.split(' ').collect::<Vec<_>>())
            .0
            .contains("divide by f2")
    );
    let file = "kind = \"one-ring\"\n[parameters]\na = { default = \"3/2\", range = [\"0\", \"2\"] }\n[rule]\nn = \"3..\"\nf1 = \"1/4\"\nf2 = \"1/4\"\nf3 = \"1/4\"\nd1 = \"3/8\"\nd2 = \"3/8\"\ne1 = \"1/16\"\ne2 = \"1/16\"\nalpha = \"1/(n*a)\"\nbeta = \"1/((n-5)*n)\"\n";
    place.write("v.toml", file);
    for line in [
        "spectrum -N 5 --scheme file:v.toml",
        "compare -N 4..6 --schemes file:v.toml",
        "verify -N 5 --scheme file:v.toml",
        "verify -N 5 --scheme file:v.toml --range a=1..2",
        "spectrum -N 5 --scheme file:v.toml --sweep a=1..2:3",
    ] {
        let (message, _) = refused(&place, &line.split(' ').collect::<Vec<_>>());
        assert!(
            message.starts_with("v.toml: line 14") && message.contains("division by zero at n = 5"),
            "{line}: {message}"
        );
    }
}

#[test]
fn numbers_out_of_range() {
    let place = Place::new();
    let lambda = |value: &str| out_of_range(&place, &format!("stencil -N 6 --lambda{value}")).1;
    for value in [" 0.125", " 1", " NaN", " -0.3", "=-0.3", " inf", " 1e-300"] {
        assert_eq!(lambda(value), "0.125 < lambda < 1");
    }
    for n in ["2", "0", "-3", "1001", "99999999999999999999999", "six", "5.5"] {
        for rest in [
            "stencil --lambda 0.5",
            "spectrum --scheme catmull-clark",
            "tune --global",
            "matrix --scheme doo-sabin",
        ] {
            if rest.starts_with("matrix") {
                // its formats are others, and its errors have one form
                let arguments: Vec<&str> = rest.split(' ').chain(["-N", n]).collect();
                assert_eq!(place.run(&arguments).code, Some(2));
            } else {
                assert_eq!(out_of_range(&place, &format!("{rest} -N {n}")).1, "3 to 1000");
            }
        }
    }
    let objective = "objective -N 6 --lambda 0.55 --f2 0.25 --f3 0.2";
    for option in [
        "--s NaN",
        "--s 0.99",
        "--s -1",
        "--s 1.9",
        "--epsilon 0",
        "--epsilon NaN",
        "--epsilon -1",
        "--epsilon inf",
        "--weight 0",
        "--weight NaN",
        "--quadrature 0",
        "--quadrature 999",
        "--quadrature -1",
        "--quadrature 2.5",
        "--phi -1",
        "--phi NaN",
        "--phi inf",
    ] {
        out_of_range(&place, &format!("{objective} {option}"));
    }
    for margin in ["NaN", "1.5", "1", "-0.1", "wide"] {
        out_of_range(&place, &format!("tune -N 6 --lambda 0.5 --margin {margin}"));
        out_of_range(&place, &format!("tune -N 5 --global --margin {margin}"));
    }
    for rings in ["0", "65", "1000000", "99999999999999999999999", "-1"] {
        out_of_range(&place, &format!("spectrum --scheme catmull-clark -N 5 --rings {rings}"));
    }
    // order 6 needs two rings
    let (_, accepted) = out_of_range(&place, "spectrum --scheme tension:order=6 -N 5 --rings 1");
    assert!(accepted.starts_with('2'), "{accepted}");
    out_of_range(
        &place,
        "spectrum --scheme catmull-clark -N 5 --level 99999999999999999999999",
    );
    // there is no such thing as too late a level: all are the limit
    place.ok(&[
        "spectrum",
        "--scheme",
        "catmull-clark",
        "-N",
        "5",
        "--level",
        "18446744073709551615",
    ]);
    // the rule for s has no solution here, which is not the fault of an s that was given
    for line in [
        "tune -N 1000 --lambda 0.5",
        "stencil -N 1000 --lambda 0.5",
        "tune -N 1000 --global",
    ] {
        assert_eq!(out_of_range(&place, line).1, "a smaller valence");
    }
    let too_large = place.run(&["matrix", "--scheme", "catmull-clark", "-N", "1000", "--rings", "60"]);
    assert_eq!(too_large.code, Some(2));
    assert!(too_large.stderr.contains("accepted"), "{}", too_large.stderr);
}

#[test]
fn infeasible_weights() {
    let place = Place::new();
    // f1 = 1 - 2 f2 - f3 >= 0 at f3 = 0.1 is f2 <= 0.45
    let (message, accepted) = out_of_range(&place, "stencil -N 6 --lambda 0.55 --f2 0.45001 --f3 0.1");
    assert!(message.contains("f1 >= 0 is missed by 1.0000"), "{message}");
    assert!(accepted.contains("<= f2 <= 0.45 "), "{accepted}");
    // weights that were printed to seven digits are taken
    let found = place.json("stencil -N 6 --lambda 0.55 --f2 0.4500001 --f3 0.1");
    assert!(number(&found, "f1") > -1e-6);
    for (weights, bound) in [
        ("--f2 0.3 --f3 -0.01", "f3 >= 0"),
        ("--f2 0.3 --f3 0.9", "f3"),
        ("--f2 -0.3 --f3 0.1", "theta"),
        ("--f2 1e300 --f3 0.1", "f1 >= 0"),
    ] {
        for command in ["stencil", "objective"] {
            let (message, _) = out_of_range(&place, &format!("{command} -N 6 --lambda 0.55 {weights}"));
            assert!(message.contains(bound), "{weights}: {message}");
        }
    }
    for weights in [
        "--f2 NaN --f3 0.1",
        "--f2 0.3 --f3 NaN",
        "--f2 inf --f3 0.1",
        "--f2 a --f3 0.1",
    ] {
        out_of_range(&place, &format!("stencil -N 6 --lambda 0.55 {weights}"));
    }
    // at valence 4 f3 is mu
    out_of_range(&place, "stencil -N 4 --lambda 0.5 --f2 0.25 --f3 0.26");
    refused(&place, &["stencil", "-N", "6", "--lambda", "0.55", "--f2", "0.25"]);
}

#[test]
fn schemes() {
    let place = Place::new();
    for spec in [
        "nonsense",
        "lambda",
        "lambda:",
        "lambda:lambda=NaN",
        "lambda:lambda=2",
        "lambda:lambda=0.5,f2=NaN,f3=0.1",
        "lambda:lambda=0.5,f2=0.1",
        "lambda:lambda=0.5,s=100",
        "lambda:lambda=0.5,f4=1",
        "tension:order=1",
        "tension:order=99999999999999999999",
        "tension:order=4,u0=NaN",
        "tension:order=4,u0=-1",
        "tension:order=x",
        "catmull-clark:order=3",
    ] {
        out_of_range(&place, &format!("spectrum --scheme {spec} -N 5"));
        out_of_range(&place, &format!("compare --valences 5 --schemes catmull-clark,{spec}"));
    }
    refused(&place, &["spectrum", "--scheme", "", "-N", "5"]);
    refused(&place, &["compare", "--schemes", ""]);
    for valences in [
        "", "2", "3..", "5..3", "x", "3,,4", "3..9999", "-5", "3-5", "1e3", "NaN",
    ] {
        let (_, accepted) = refused(
            &place,
            &["compare", "--schemes", "catmull-clark", "--valences", valences],
        );
        assert!(accepted.is_some(), "{valences}");
        let (_, accepted) = refused(&place, &["tables", "--valences", valences, "--out", "out"]);
        assert!(accepted.is_some(), "{valences}");
    }
    assert_eq!(files(place.path()), []);
}

#[test]
fn the_command_line() {
    let place = Place::new();
    let (_, accepted) = refused(&place, &["frobnicate"]);
    assert!(accepted.unwrap().starts_with("tables, stencil"));
    let none = place.run(&[]);
    assert_eq!(
        (none.code, none.stderr.lines().count(), none.stdout.as_str()),
        (Some(2), 1, "")
    );
    let (message, _) = refused(&place, &["stencil", "-N", "6", "--lamda", "0.5"]);
    assert!(
        message.contains("did you mean '--lambda'?") && message.contains("eigenring stencil --help"),
        "{message}"
    );
    let (message, _) = refused(&place, &["stencil", "-N", "6", "--lambda", "0.5", "--format", "xml"]);
    assert!(message.ends_with("accepted are text, json, csv, latex"), "{message}");
    let (message, _) = refused(
        &place,
        &["matrix", "--scheme", "doo-sabin", "-N", "5", "--format", "xyz"],
    );
    assert!(message.ends_with("accepted are mtx, npy, csv, json"), "{message}");
    let (message, _) = refused(&place, &["tune", "-N", "6"]);
    assert!(
        message.contains("--lambda") && message.contains("--global"),
        "{message}"
    );
    let (message, _) = refused(&place, &["spectrum", "-N", "6"]);
    assert!(
        message.contains("--scheme") && message.contains("--matrix"),
        "{message}"
    );
    refused(&place, &["tune", "-N", "6", "--lambda", "0.5", "--global"]);
    refused(&place, &["stencil", "-N", "6"]);
    refused(&place, &["stencil", "-N"]);
    refused(&place, &["stencil", "-N", "6", "--lambda"]);
    refused(&place, &["stencil", "-N", "6", "--lambda", "0.5", "0.6"]);
    refused(
        &place,
        &["spectrum", "--scheme", "doo-sabin", "--matrix", "S.csv", "-N", "5"],
    );
    for starts in ["5x5", "", "FULL"] {
        let (_, accepted) = refused(&place, &["tune", "-N", "6", "--global", "--starts", starts]);
        assert_eq!(accepted.as_deref(), Some("10x10, full"));
    }
}

#[test]
fn files_that_cannot_be_read() {
    let place = Place::new();
    for (text, part) in [
        ("", "kind"),
        ("kind = \"one-ring", "line 1"),
        ("kind = \"two-ring\"", "one-ring"),
        ("kind = \"one-ring\"\n[[valence]]\nn = 5\nf1 = \"a/b\"\n", ""),
        ("kind = \"one-ring\"\n[[valence]]\nn = 5\nf1 = nan\n", ""),
        ("kind = \"stencils\"\n[[valence]]\nn = -5\n", ""),
        ("\u{0}\u{1}", "line 1"),
    ] {
        place.write("scheme.toml", text);
        let (message, _) = refused(&place, &["spectrum", "--scheme", "file:scheme.toml", "-N", "5"]);
        assert!(
            message.starts_with("scheme.toml: ") && message.contains(part),
            "{text:?}: {message}"
        );
    }
    place.write("scheme.toml", [0xff, 0xfe, 0x00]);
    for scheme in ["file:scheme.toml", "file:missing.toml", "file:.", "file:"] {
        refused(&place, &["spectrum", "--scheme", scheme, "-N", "5"]);
        refused(&place, &["matrix", "--scheme", scheme, "-N", "5", "-o", "S.mtx"]);
    }
    for (text, part) in [
        ("", "0 x 0"),
        ("1,2\n3\n", "row 2 has 1"),
        ("a,b\nc,d\n", "row 1, column 1: 'a'"),
        ("1,2\n3,nan\n", "row 2, column 2"),
        ("1,2\n3,inf\n", "row 2, column 2"),
        ("1,\n3,4\n", "row 1, column 2"),
        ("1,2\n3,4\n", "2 x 2"),
        ("1,2\n3,4\n5,6\n", "3 x 2"),
        ("\"1,2\n3,4\n", "row 1"),
    ] {
        place.write("S.csv", text);
        let (message, _) = refused(&place, &["spectrum", "--matrix", "S.csv", "-N", "5"]);
        assert!(
            message.starts_with("S.csv: ") && message.contains(part),
            "{text:?}: {message}"
        );
    }
    refused(&place, &["spectrum", "--matrix", "missing.csv", "-N", "5"]);
    // a matrix of the right size for another valence only
    place.ok(&[
        "matrix",
        "--scheme",
        "catmull-clark",
        "-N",
        "5",
        "--format",
        "csv",
        "-o",
        "S.csv",
    ]);
    refused(&place, &["spectrum", "--matrix", "S.csv", "-N", "6"]);
    refused(&place, &["reproduce", "--check", "--out", "missing"]);
    for text in ["", "{}", "{\"version\":1", "[]"] {
        std::fs::create_dir_all(place.path().join("bad/lambda")).unwrap();
        place.write("bad/lambda/tables.json", text);
        refused(&place, &["reproduce", "--check", "--out", "bad"]);
        refused(&place, &["reproduce", "--out", "bad"]);
        assert_eq!(place.read("bad/lambda/tables.json"), text);
    }
    refused(&place, &["reproduce", "--check", "--atol", "NaN"]);
    refused(&place, &["reproduce", "--check", "--rtol", "-1"]);
}

#[test]
fn files_that_cannot_be_written() {
    let place = Place::new();
    // tests may run as a user to whom no permission is denied: a file stands where a folder is needed
    place.write("file", "in the way");
    let (message, _) = refused(&place, &["tables", "--valences", "5", "--out", "file"]);
    assert!(message.starts_with("cannot write file/lambda"), "{message}");
    for out in ["file/S.csv", "."] {
        let run = place.run(&["matrix", "--scheme", "catmull-clark", "-N", "5", "-o", out]);
        assert_eq!(
            (run.code, run.stdout.as_str(), run.stderr.lines().count()),
            (Some(2), "", 1)
        );
        assert!(run.stderr.contains("cannot write"), "{}", run.stderr);
    }
    let names: Vec<String> = files(place.path()).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["file"]);
    assert_eq!(place.read("file"), "in the way");
    // a cache that cannot be written to costs time only
    let output = place
        .command(&["stencil", "-N", "25", "--lambda", "0.6"])
        .env("EIGENRING_CACHE", place.path().join("file"))
        .output()
        .unwrap();
    assert!(output.status.success());
    assert!(String::from_utf8_lossy(&output.stderr).contains("not kept"));
}

#[test]
fn tables_refuse_before_they_write() {
    let place = Place::new();
    for option in [
        "--margin NaN",
        "--margin 1.5",
        "--epsilon 0",
        "--quadrature 0",
        "--quadrature 999",
        "--weight NaN",
        "--phi -1",
        "--threads 0",
        "--threads 70000",
        "--threads -1",
        "--starts 5x5",
        "--knots mine",
        "--bounds none",
    ] {
        out_of_range(&place, &format!("tables --valences 5 --out out {option}"));
    }
    // mu reaches lambda within the tables' range
    for valences in ["500", "3,1000"] {
        let (message, _) = out_of_range(&place, &format!("tables --valences {valences} --out out"));
        assert!(message.contains("lambda"), "{message}");
    }
    assert_eq!(files(place.path()), []);
    assert!(!place.path().join("out").exists());
}
