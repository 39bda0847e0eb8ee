//! **Claim**: `tune --scheme` writes a scheme file that has the numbers that it prints, with certificates
//! that hold; an interrupted run goes on to the same bytes; what cannot be tuned is refused with what is
//! accepted.
//! **Oracle**: the other commands, on the file that was written.

#![allow(missing_docs)]

use crate::common::Place;
use serde_json::Value;

fn place() -> Place {
    let place = Place::new();
    place.ok(&["new-scheme", "--like", "catmull-clark", "-o", "my.toml"]);
    place
}

fn read(place: &Place, name: &str) -> String {
    std::fs::read_to_string(place.path().join(name)).unwrap()
}

const TUNE: [&str; 13] = [
    "tune",
    "--scheme",
    "file:my.toml",
    "-N",
    "3,5",
    "--minimise",
    "ratio+0.1*hull",
    "--fix",
    "b=1/3",
    "--subject-to",
    "hull,c1",
    "--descents",
    "2",
];

#[test]
fn the_written_file_is_what_is_printed() {
    let place = place();
    let printed = place.ok(&[&TUNE[..], &["-o", "tuned.toml", "--format", "json"]].concat());
    let printed: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(printed["minimise"], "ratio+0.1*hull");
    for row in printed["rows"].as_array().unwrap() {
        let n = row["valence"].to_string();
        let compared = place.ok(&["compare", "--schemes", "file:tuned.toml", "-N", &n, "--format", "json"]);
        let compared: Value = serde_json::from_str(&compared).unwrap();
        let number = |name: &str| compared[0][name].as_f64().unwrap();
        let value = (number("mu/lambda^2") - 1.0).abs() - 0.1 * number("hull");
        assert!(
            (row["after"].as_f64().unwrap() - value).abs() < 1e-15,
            "{row} {compared}"
        );
        assert!(row["after"].as_f64() <= row["before"].as_f64());
        assert_eq!(row["verify"], serde_json::json!({"c1": "proven", "hull": "proven"}));
        assert_eq!(compared[0]["scheme"], "tuned");
        let certificate = format!("tuned-N{n:0>3}.json");
        place.ok(&["verify", "--recheck", &certificate]);
        place.ok(&["verify", "--scheme", "file:tuned.toml", "-N", &n]);
    }
    let text = read(&place, "tuned.toml");
    assert!(
        text.contains("# Catmull and Clark (1978)") && text.contains("except = { 3 = \"1/3\", 5 = \"1/3\" }"),
        "{text}"
    );
}

#[test]
fn runs_are_the_same_for_any_threads_and_resumed() {
    let place = place();
    let run = |more: &[&str]| place.ok(&[&TUNE[..], &["--format", "csv"], more].concat());
    let once = run(&["--threads", "1", "-o", "a.toml", "--resume", "kept.jsonl"]);
    let kept = read(&place, "kept.jsonl");
    // without the last descents, one of them cut off
    std::fs::write(place.path().join("kept.jsonl"), &kept[..kept.len() - 150]).unwrap();
    assert_eq!(run(&["--threads", "2", "-o", "b.toml", "--resume", "kept.jsonl"]), once);
    assert_eq!(read(&place, "a-N005.json").len(), read(&place, "b-N005.json").len());
    assert_eq!(
        read(&place, "b.toml"),
        read(&place, "a.toml").replace("name = \"a\"", "name = \"b\"")
    );
    // another tuning leaves the file alone
    let other = place.run(&[&TUNE[..], &["--seed", "2", "--resume", "kept.jsonl"]].concat());
    assert!(
        other.code == Some(2) && other.stderr.contains("is not of this tuning"),
        "{}",
        other.stderr
    );
    let scheme = place.run(&[&TUNE[..], &["--resume", "my.toml"]].concat());
    assert!(scheme.code == Some(2) && read(&place, "my.toml").starts_with("# Catmull"));
}

#[test]
fn what_cannot_be_tuned_is_refused() {
    let place = place();
    let file = "--scheme file:my.toml --minimise";
    for (arguments, needle) in [
        (
            format!("-N 5 {file} ratoi"),
            "did you mean 'ratio'?): accepted are E, E-unweighted",
        ),
        (
            format!("-N 5 {file} E --subject-to bound"),
            "accepted are hull, bounded, order, c1",
        ),
        (
            format!("-N 5 {file} E --fix a=9"),
            "a = 9 is out of range: accepted is 0 <= a <= 3",
        ),
        (
            format!("-N 5 {file} E --fix a --fix b"),
            "no parameter of catmull-clark is free",
        ),
        (
            format!("-N 5 {file} E -o my.toml"),
            "is the file that is tuned: accepted is another file",
        ),
        (format!("-N 5 {file} E -o x.json"), "accepted is -o FILE.toml"),
        (format!("-N 5 {file} E --starts full"), "--starts"),
        (format!("-N 5 {file} E --margin nan"), "margin NaN is out of range"),
        (format!("-N 5 {file} E --descents 0"), "accepted is 1 to 10000"),
        ("-N 5 --scheme file:my.toml".to_owned(), "--minimise"),
        (
            "-N 5 --scheme catmull-clark --minimise E".to_owned(),
            "accepted is --scheme file:SCHEME.toml",
        ),
        ("-N 5 --lambda 0.5 --minimise E".to_owned(), "--minimise with --scheme"),
        ("-N 5 --lambda 0.5 --set a=1".to_owned(), "--set has no meaning"),
        ("-N 5,6 --lambda 0.5".to_owned(), "accepted is one valence"),
    ] {
        let arguments: Vec<&str> = std::iter::once("tune").chain(arguments.split(' ')).collect();
        let found = place.run(&arguments);
        assert_eq!(found.code, Some(2), "{arguments:?}: {}", found.stderr);
        assert!(
            found.stderr.contains(needle) && found.stderr.lines().count() == 1,
            "{}",
            found.stderr
        );
    }
    std::fs::write(
        place.path().join("bad.toml"),
        read(&place, "my.toml").replace("f2 = \"1/4\"", "f2 = \"-1/4 - a/100\""),
    )
    .unwrap();
    let found = place.run(&[
        "tune",
        "--scheme",
        "file:bad.toml",
        "-N",
        "5",
        "--minimise",
        "ratio",
        "--subject-to",
        "hull",
    ]);
    assert!(
        found.code == Some(2) && found.stderr.contains("hull fails at all of"),
        "{}",
        found.stderr
    );
}
