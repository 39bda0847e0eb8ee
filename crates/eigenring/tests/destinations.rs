//! Where output goes: stored results are overwritten by nothing but their own command, files are listed,
//! devices are written into, and a file's name says its format.

use crate::common::{Place, Run, files};
use serde_json::Value;

fn run(place: &Place, line: &str) -> Run {
    place.run(&line.split_whitespace().collect::<Vec<_>>())
}

fn ok(place: &Place, line: &str) -> (String, String) {
    let run = run(place, line);
    assert_eq!(run.code, Some(0), "{line}: {}", run.stderr);
    (run.stdout, run.stderr)
}

fn refused(place: &Place, line: &str) -> String {
    let run = run(place, line);
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{line}: {}", run.stderr);
    assert_eq!(run.stderr.lines().count(), 1, "{line}: {}", run.stderr);
    assert!(
        run.stderr.contains("accepted") || run.stderr.contains("cannot be used"),
        "{line}: {}",
        run.stderr
    );
    run.stderr
}

#[test]
fn a_selection_leaves_the_stored_results_alone() {
    let place = Place::new();
    std::fs::create_dir_all(place.path().join("results/lambda")).unwrap();
    place.write("results/lambda/samples.csv", "stored");
    let (_, said) = ok(&place, "tables --valences 5");
    let listed = said
        .lines()
        .filter(|line| line.starts_with("wrote eigenring-out/lambda/"));
    assert_eq!(listed.count(), 11, "{said}");
    assert!(said.contains("100 stencils were tuned at 1 valence (N = 5)"), "{said}");
    for figure in [
        "weighting --format svg",
        "characteristic-map --schemes catmull-clark --valences 5 --format svg",
    ] {
        let (names, _) = ok(&place, &format!("plot {figure}"));
        for name in names.lines() {
            assert!(
                name.starts_with("eigenring-out/figures/") && place.path().join(name).is_file(),
                "{name}"
            );
        }
    }
    // other numbers than the stored ones, at the stored valences
    let message = refused(&place, "tables --unweighted --embed");
    assert!(message.contains("--embed FILE"), "{message}");
    let stored: Vec<String> = files(&place.path().join("results"))
        .into_iter()
        .map(|(name, _)| name)
        .collect();
    assert_eq!(stored, ["lambda/samples.csv"]);
    assert_eq!(place.read("results/lambda/samples.csv"), "stored");
}

#[test]
fn the_name_of_a_file_says_its_format() {
    let place = Place::new();
    for (line, start) in [
        ("matrix --scheme catmull-clark -N 5 -o b.csv", "0."),
        ("matrix --scheme catmull-clark -N 5 -o b.json", "{"),
        ("matrix --scheme catmull-clark -N 5 -o b.npy", "\u{fffd}NUMPY"),
        ("matrix --scheme catmull-clark -N 5 -o b.dat", "%%MatrixMarket"),
        ("spectrum --scheme catmull-clark -N 5 -o b.csv", "re,im"),
        ("compare --schemes catmull-clark -N 5 -o b.tex", "\\begin{tabular}"),
        ("stencil -N 5 --lambda 0.5 -o b.json", "{"),
        ("stencil -N 5 --lambda 0.5 -o b.dat --format csv", "valence,"),
        ("curve --example circle -o b.json", "{"),
        ("verify --scheme catmull-clark -N 5 -o b.csv", "{"),
    ] {
        let (_, stderr) = ok(&place, line);
        let file = line.split(' ').find(|word| word.starts_with("b.")).unwrap();
        assert!(stderr.contains(&format!("wrote {file}\n")), "{line}: {stderr}");
        let bytes = std::fs::read(place.path().join(file)).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        assert!(text.starts_with(start), "{line}: {}", &text[..20]);
    }
    for line in [
        "matrix --scheme catmull-clark -N 5 --format mtx -o c.csv",
        "spectrum --scheme catmull-clark -N 5 --format latex -o c.csv",
        "compare --schemes catmull-clark -N 5 --format csv -o c.json",
    ] {
        assert!(refused(&place, line).contains("disagrees with c."), "{line}");
    }
    assert!(!place.path().join("c.csv").exists());
}

#[cfg(unix)]
#[test]
fn devices_are_written_into() {
    use std::os::unix::fs::FileTypeExt;
    let place = Place::new();
    ok(&place, "matrix --scheme catmull-clark -N 5 -o /dev/null");
    assert!(std::fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    let (text, stderr) = ok(&place, "matrix --scheme catmull-clark -N 5 -o /dev/stdout");
    assert!(text.starts_with("%%MatrixMarket") && stderr.is_empty(), "{stderr}");
    let (text, stderr) = ok(&place, "plot weighting --format svg -o /dev/stdout");
    assert!(text.starts_with("<svg") && text.ends_with("</svg>\n"), "{stderr}");
}

#[cfg(unix)]
#[test]
fn named_pipes_are_written_into() {
    use std::os::unix::fs::FileTypeExt;
    let place = Place::new();
    let pipe = place.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.is_ok_and(|status| status.success()));
    for (line, start) in [
        ("matrix --scheme catmull-clark -N 5 -o pipe", "%%MatrixMarket"),
        ("compare --schemes catmull-clark -N 5 --format csv -o pipe", "valence,"),
        ("verify --scheme catmull-clark -N 5 -o pipe", "{"),
        ("plot weighting --format pdf -o pipe", "%PDF"),
        ("make cube -o pipe", ""),
    ] {
        if line.starts_with("make") {
            // a mesh file's format is its extension, and a refusal leaves the pipe alone too
            refused(&place, line);
        } else {
            let (source, wanted) = (pipe.clone(), start.to_owned());
            let reader = std::thread::spawn(move || {
                let bytes = std::fs::read(source).unwrap();
                assert!(
                    bytes.starts_with(wanted.as_bytes()) && bytes.len() > 50,
                    "{} bytes",
                    bytes.len()
                );
            });
            ok(&place, line);
            reader.join().unwrap();
        }
        let there = std::fs::symlink_metadata(&pipe).unwrap();
        assert!(there.file_type().is_fifo(), "{line}");
    }
    let names: Vec<_> = std::fs::read_dir(place.path()).unwrap().collect();
    assert_eq!(names.len(), 1, "{names:?}");
}

#[test]
fn folders_are_made_below_existing_ones_or_with_a_notice() {
    let place = Place::new();
    let (_, stderr) = ok(&place, "matrix --scheme catmull-clark -N 5 -o new/S.csv");
    assert!(!stderr.contains("note"), "{stderr}");
    let (_, stderr) = ok(&place, "matrix --scheme catmull-clark -N 5 -o far/away/S.csv");
    assert!(stderr.contains("note: far/away is made"), "{stderr}");
}

#[test]
fn options_that_would_be_ignored_are_refused() {
    let place = Place::new();
    place.write("points.csv", "0,0\n1,0\n1,1\n0,1\n");
    place.write("mine.toml", "kind = \"one-ring\"\n");
    for line in [
        "curve points.csv --segments 5",
        "curve points.csv --segments 5 --limit l.csv",
        "curve points.csv --samples 5",
        "curve points.csv --count 5",
        "curve points.csv --dpi 100",
        "curve points.csv --plot a.svg --dpi 100",
        "curve points.csv --size two",
        "curve points.csv --obj a.obj",
        "spectrum --scheme catmull-clark --dart -N 5 --corner",
        "spectrum --scheme catmull-clark -N 5 --next 1,1",
        "spectrum --scheme catmull-clark --dart -N 5 --next 1,1",
        "spectrum --matrix S.csv -N 5 --rings 2",
        "spectrum --matrix S.csv -N 5 --dart",
        "verify --scheme catmull-clark -N 5 --exact",
        "verify --scheme catmull-clark -N 5 --out there",
        "verify --recheck there --require strict",
        "verify --recheck there -N 5",
        "verify --recheck there --dart",
        "verify --all --dart",
        "verify --all --require strict",
        "verify --all -o c.json",
        "reproduce --atol 1",
        "reproduce --rtol 1",
        "plot --list --valences 5",
        "plot weighting --dpi 100 --format svg",
        "plot weighting --results there",
        "objective -N 6 --lambda 0.55 --f2 0.25 --f3 0.2 --unweighted --weight 3",
        "tune -N 6 --lambda 0.5 --unweighted --epsilon 0.1",
        "tables --scheme tension --unweighted",
    ] {
        refused(&place, line);
    }
    assert!(refused(&place, "curve points.csv --segments 5").contains("--segments with --revolve"));
}

#[test]
fn valences_are_one_option() {
    let place = Place::new();
    for line in [
        "spectrum --scheme catmull-clark",
        "matrix --scheme catmull-clark",
        "stencil --lambda 0.5",
        "objective --lambda 0.55 --f2 0.25 --f3 0.2",
        "tune --lambda 0.5",
        "verify --scheme catmull-clark",
        "compare --schemes catmull-clark",
    ] {
        let [a, b, c] = ["-N", "--valence", "--valences"].map(|name| ok(&place, &format!("{line} {name} 6")).0);
        assert!(a == b && b == c, "{line}");
    }
    // commands about one corner take one value
    let message = refused(&place, "spectrum --scheme catmull-clark -N 3,5");
    assert!(
        message.contains("'-N': this command takes one valence: accepted is 3 to 1000"),
        "{message}"
    );
    let message = refused(&place, "spectrum --scheme catmull-clark --valences 2000");
    assert!(message.contains("'--valences': accepted"), "{message}");
    let open = refused(&place, "compare --schemes catmull-clark -N 3..");
    assert!(
        open.contains("3.. has no end: accepted is a range with an end, such as 3..12"),
        "{open}"
    );
    // and certificates come for each
    let found = place.json("verify --scheme catmull-clark -N 3,5");
    let valences: Vec<&Value> = found.as_array().unwrap().iter().map(|one| &one["valence"]).collect();
    assert_eq!(valences, [3, 5]);
    let (text, _) = ok(&place, "verify --scheme catmull-clark -N 3..4 -o stored --threads 2");
    assert_eq!(text.matches("c1 is proven").count(), 2, "{text}");
    let (text, _) = ok(&place, "verify --recheck stored");
    assert!(
        text.contains("stored/N003.json") && text.contains("stored/N004.json"),
        "{text}"
    );
    let (csv, _) = ok(&place, "verify --scheme catmull-clark -N 3,5 --format csv");
    assert!(csv.starts_with("valence,check,status,margin,value,remark\n3,"), "{csv}");
}

const CATMULL_CLARK_5: &str = "kind = \"one-ring\"\nname = \"mine\"\n[[valence]]\nn = 5\nf1 = \"1/4\"\nf2 = \"1/4\"\nf3 = \"1/4\"\nd1 = \"3/8\"\nd2 = \"3/8\"\ne1 = \"1/16\"\ne2 = \"1/16\"\nalpha = \"3/10\"\nbeta = \"1/20\"\n";

#[test]
fn a_scheme_file_has_one_name_and_any_path() {
    let place = Place::new();
    place.write("a,b.toml", CATMULL_CLARK_5);
    for spec in ["file:\"a,b.toml\"", "file:a,b.toml"] {
        let row = &place.json(&format!(
            "compare --schemes {spec} --schemes doo-sabin,tension:order=4,u0=2 -N 5"
        ));
        let names: Vec<&str> = row
            .as_array()
            .unwrap()
            .iter()
            .map(|row| row["scheme"].as_str().unwrap())
            .collect();
        assert_eq!(names, ["mine", "doo-sabin", "tension:order=4,u0=2"]);
        assert_eq!(place.json(&format!("spectrum --scheme {spec} -N 5"))["scheme"], "mine");
        assert_eq!(place.json(&format!("matrix --scheme {spec} -N 5"))["scheme"], "mine");
        assert_eq!(place.json(&format!("verify --scheme {spec} -N 5"))["scheme"], "mine");
    }
    let row = &place.json("compare --schemes catmull-clark,file:\"a,b.toml\",doo-sabin -N 5")[1];
    assert_eq!(row["scheme"], "mine");
    let (names, _) = ok(
        &place,
        "plot characteristic-map --schemes file:\"a,b.toml\" --valences 5 --format svg",
    );
    assert!(!names.contains("a,b"), "{names}");
}

/// A file for one valence fixes it, for every command that asks for one.
#[test]
fn a_file_for_one_valence_needs_no_option() {
    let place = Place::new();
    place.write("mine.toml", CATMULL_CLARK_5);
    place.write("six.toml", CATMULL_CLARK_5.replace("n = 5", "n = 6"));
    for line in [
        "spectrum --scheme file:mine.toml",
        "matrix --scheme file:mine.toml",
        "eigenvectors --scheme file:mine.toml",
        "verify --scheme file:mine.toml",
        "compare --schemes file:mine.toml,catmull-clark",
        "plot spectrum --schemes file:mine.toml --format svg -o s.svg",
    ] {
        assert_eq!(ok(&place, line).0, ok(&place, &format!("{line} -N 5")).0, "{line}");
    }
    assert!(refused(&place, "spectrum --scheme file:mine.toml -N 6").contains("accepted"));
    // two that disagree fix nothing
    refused(&place, "compare --schemes file:mine.toml,file:six.toml");
    let two = format!(
        "{CATMULL_CLARK_5}{}",
        &CATMULL_CLARK_5[CATMULL_CLARK_5.find("[[").unwrap()..].replace("n = 5", "n = 6")
    );
    place.write("two.toml", two);
    assert!(refused(&place, "spectrum --scheme file:two.toml").contains("no valence is given"));
}

/// Files of one name are told apart by their paths, and it is said that they are.
#[test]
fn files_of_the_same_name_are_told_apart() {
    let place = Place::new();
    std::fs::create_dir(place.path().join("other")).unwrap();
    place.write("mine.toml", CATMULL_CLARK_5);
    place.write(
        "other/mine.toml",
        CATMULL_CLARK_5.replace("1/20", "1/25").replace("3/10", "8/25"),
    );
    let schemes = "--schemes file:mine.toml,file:other/mine.toml,doo-sabin -N 5";
    let (text, said) = ok(&place, &format!("compare {schemes} --format json"));
    let rows: Value = serde_json::from_str(&text).unwrap();
    let names: Vec<&str> = rows
        .as_array()
        .unwrap()
        .iter()
        .map(|row| row["scheme"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["mine (mine.toml)", "mine (other/mine.toml)", "doo-sabin"]);
    assert!(said.contains("several schemes are called mine"), "{said}");
    ok(
        &place,
        &format!("plot natural-configurations {schemes} --format svg --out ."),
    );
    let csv = place.read("natural-configurations.csv");
    for name in names {
        assert!(
            csv.lines().any(|line| line.starts_with(&format!("{name},5,"))),
            "{name}"
        );
    }
    assert!(place.read("natural-configurations.svg").contains("other/mine.toml"));
}

#[test]
fn what_was_meant_is_said() {
    let place = Place::new();
    for (line, meant) in [
        ("spectrum --scheme catmul-clark -N 5", "did you mean 'catmull-clark'?"),
        ("spectrum --scheme mine.toml -N 5", "did you mean 'file:mine.toml'?"),
        ("spectrum --scheme loop -N 5", "| file:SCHEME.toml"),
        ("spectrum --scheme tension:ordr=4 -N 5", "did you mean 'order'?"),
        ("plot characteristic-maps", "did you mean 'characteristic-map'?"),
        ("spectrm --scheme catmull-clark", "did you mean 'spectrum'?"),
        ("spectrum --schema catmull-clark -N 5", "did you mean '--scheme'?"),
        (
            "spectrum --scheme catmull-clark -N 5 --format jsn",
            "did you mean 'json'?",
        ),
        ("stencil -N 1000 --lambda 0.5", "as it is up to N = "),
    ] {
        let message = refused(&place, line);
        assert!(message.contains(meant), "{line}: {message}");
    }
    place.write("mine.toml", CATMULL_CLARK_5.replace("alpha", "alhpa"));
    let message = refused(&place, "spectrum --scheme file:mine.toml -N 5");
    assert!(
        message.contains("mine.toml: line 12, column 1: ") && message.contains("did you mean 'alpha'?"),
        "{message}"
    );
}
