//! **Claim**: what is proven of a scheme file over a range of a parameter is proven at every value, what is
//! refuted fails at every value, and faults inside the range are found, however small. **Oracle**: proofs at
//! single values, in exact numbers, which share neither the intervals nor the identities of the range.

use eigenring_certify::parameter::{Limits, ParameterCertificate, Recheck, prove, recheck_parameter_text};
use eigenring_certify::{Input, Requirement, Status, certify};
use eigenring_scheme::Number;
use eigenring_scheme::user::{Reading, starters};

/// Catmull-Clark with the weight c of the edge neighbours in the face rule.
fn text() -> String {
    let text = starters()[0].text;
    text.replace("f2 = \"1/4\"", "f2 = \"c\"").replace(
        "[parameters]",
        "[parameters]\nc = { default = \"1/4\", range = [\"0\", \"1/2\"] }",
    )
}

fn input(text: &str, ends: [&str; 2]) -> Input {
    Input::TomlRange {
        text: text.to_owned(),
        name: "unnamed".to_owned(),
        reading: Reading::default(),
        parameters: Default::default(),
        parameter: "c".to_owned(),
        ends: ends.map(str::to_owned),
    }
}

fn at(text: &str, valence: usize, value: &Number, required: Requirement) -> Status {
    let single = Input::Toml {
        text: text.to_owned(),
        name: "unnamed".to_owned(),
        reading: Reading::Exact,
        parameters: [("c".to_owned(), value.to_string())].into(),
    };
    required.verdict(&certify(single, valence).unwrap().checks).1
}

/// Compares the stretches of a certificate with single proofs at so many values; how many were decided.
fn compare(certificate: &ParameterCertificate, text: &str, required: Requirement, count: usize) -> usize {
    let stretches = certificate.required(required);
    let number = |text: &str| -> Number { text.parse().unwrap() };
    let first = number(&stretches[0].ends[0]);
    let last = number(&stretches[stretches.len() - 1].ends[1]);
    let mut decided = 0;
    let mut state = 7_u64;
    let values = first.steps_to(&last, 99_991);
    for _ in 0..count {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        let value = &values[(state >> 40) as usize % values.len()];
        let holds =
            |end: &str, below: bool| (number(end).rational() <= value.rational()) == below || number(end) == *value;
        let inside = |ends: &[String; 2]| holds(&ends[0], true) && holds(&ends[1], false);
        let stretch = stretches.iter().find(|stretch| inside(&stretch.ends)).unwrap();
        if stretch.status != Status::Undecided {
            assert_eq!(
                at(text, certificate.valence, value, required),
                stretch.status,
                "{value}"
            );
            decided += 1;
        }
    }
    decided
}

#[test]
fn ranges_say_what_single_values_say() {
    let text = text();
    for (valence, ends, required) in [
        (3, ["6/25", "13/50"], Requirement::C1),
        (5, ["1/5", "3/10"], Requirement::C1),
        (6, ["1/5", "3/10"], Requirement::Bounded),
        (5, ["3/10", "9/20"], Requirement::Hull),
    ] {
        let certificate = prove(input(&text, ends), valence, required, Limits::default()).unwrap();
        let decided = compare(&certificate, &text, required, 50);
        assert!(decided >= 45, "{valence}, {}: {decided}", required.name());
        // the place where the hull property ends: f1 = 3/4 - 2c
        if required == Requirement::Hull {
            let stretches = certificate.required(required);
            let statuses: Vec<Status> = stretches.iter().map(|stretch| stretch.status).collect();
            assert_eq!(statuses, [Status::Proven, Status::Undecided, Status::Refuted]);
            let [from, to] = stretches[1]
                .ends
                .each_ref()
                .map(|end| end.parse::<Number>().unwrap().value());
            assert!(from <= 0.375 && 0.375 <= to && to - from < 1e-4);
        }
    }
}

/// Row sums that are 1 at both ends only, and miss it by 1e-14 between them, where balancing would hide it.
#[test]
fn faults_inside_the_range_are_found() {
    for fault in ["(c - 1/5)*(c - 1/4)/10^10", "(c - 1/5)*(c - 9/40)*(c - 1/4)/10^8"] {
        let text = text().replace("f1 = \"1 - 2*f2 - f3\"", &format!("f1 = \"1 - 2*f2 - f3 + {fault}\""));
        let limits = Limits { halvings: 2, tiles: 10 };
        let certificate = prove(input(&text, ["1/5", "1/4"]), 5, Requirement::C1, limits).unwrap();
        let stretches = certificate.required(Requirement::C1);
        assert!(
            stretches.iter().all(|stretch| stretch.status == Status::Undecided),
            "{stretches:?}"
        );
    }
    // a pole inside the range, at a place where the search looks and at one where it does not
    let with_pole = |at: &str| text().replace("alpha = \"a/n\"", &format!("alpha = \"a/n + 0/(c - {at})\""));
    let refused = prove(
        input(&with_pole("9/40"), ["1/5", "1/4"]),
        5,
        Requirement::C1,
        Limits::default(),
    );
    assert!(refused.unwrap_err().to_string().contains("division by zero"));
    let text = with_pole("17/77");
    let certificate = prove(input(&text, ["1/5", "1/4"]), 5, Requirement::C1, Limits::default()).unwrap();
    let stretches = certificate.required(Requirement::C1);
    assert!(
        stretches.iter().any(|stretch| stretch.status == Status::Undecided),
        "{stretches:?}"
    );
}

#[test]
fn stored_ranges_are_checked_by_their_evidence() {
    let certificate = prove(input(&text(), ["6/25", "13/50"]), 5, Requirement::C1, Limits::default()).unwrap();
    let stored = certificate.to_line().unwrap();
    let (_, found) = recheck_parameter_text(&stored).unwrap();
    let good = Recheck {
        intact: true,
        covered: true,
        different: Vec::new(),
    };
    assert_eq!(found, good);
    // another file, and a range that is not covered
    let (_, found) = recheck_parameter_text(&stored.replace("d1 = \\\"3/8\\\"", "d1 = \\\"7/16\\\"")).unwrap();
    assert!(!found.intact && !found.different.is_empty());
    let (_, found) = recheck_parameter_text(&stored.replacen("13/50", "14/50", 1)).unwrap();
    assert!(!found.intact && !found.covered);
    let empty = prove(input(&text(), ["1/4", "1/4"]), 5, Requirement::C1, Limits::default());
    assert!(empty.unwrap_err().to_string().contains("accepted is A..B with A < B"));
    let beyond = prove(input(&text(), ["1/4", "2/3"]), 5, Requirement::C1, Limits::default());
    assert!(beyond.unwrap_err().to_string().contains("out of range"));
}
