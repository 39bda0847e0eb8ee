//! What other programs read: names, fields and formats of the command's output.

#![allow(missing_docs)]

use crate::common::{Place, csv_rows, has_fields, number};
use serde_json::Value;

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{a} is not {b}");
}

#[test]
fn stencil() {
    let place = Place::new();
    for n in [3, 4, 5, 20] {
        let found = place.json(&format!("stencil -N {n} --lambda 0.55"));
        has_fields(
            &found,
            "valence lambda mu s f1 f2 f3 d1 d2 e1 e2 alpha beta g1 g2 g3 source",
        );
        let get = |field| number(&found, field);
        assert_eq!(found["valence"], n);
        assert_eq!(get("lambda"), 0.55);
        close(get("mu"), get("s") * 0.55 * 0.55, 1e-15);
        // affine invariance of the face and edge stencils
        close(get("f1") + 2.0 * get("f2") + get("f3"), 1.0, 1e-14);
        close(get("d1") + get("d2") + 2.0 * (get("e1") + get("e2")), 1.0, 1e-14);
        close(get("alpha"), 6.0 * get("beta"), 1e-14);
        assert_eq!(found["source"], "table");
    }
    let given = place.json("stencil -N 6 --lambda 0.55 --f2 0.25 --f3 0.2");
    assert_eq!((number(&given, "f2"), number(&given, "f3")), (0.25, 0.2));
    assert_eq!(given["source"], "given");
    let relaxed = place.json("stencil -N 6 --lambda 0.55 --s 1.25 --f2 0.3 --f3 0.15");
    close(number(&relaxed, "mu"), 1.25 * 0.55 * 0.55, 1e-15);
}

#[test]
fn objective() {
    let place = Place::new();
    let arguments = "objective -N 6 --lambda 0.55 --f2 0.25 --f3 0.2";
    let found = place.json(arguments);
    has_fields(&found, "valence lambda s f2 f3 total parts");
    let parts = found["parts"].as_array().unwrap();
    let maps: Vec<&str> = parts.iter().map(|part| part["map"].as_str().unwrap()).collect();
    assert_eq!(maps, ["cup", "saddle_re", "saddle_im"]);
    for part in parts {
        has_fields(part, "map value a b c gauss_min gauss_max");
        assert!(number(part, "gauss_min") <= number(part, "gauss_max"));
    }
    let sum: f64 = parts.iter().map(|part| number(part, "value")).sum();
    close(number(&found, "total"), sum, 1e-12 * sum);
    // a cup where the Gauss curvature is positive, saddles where it is negative
    assert!(number(&parts[0], "gauss_max") > 0.0 && number(&parts[1], "gauss_min") < 0.0);
    // without sign changes the weight is idle; its constants do matter in general
    assert_eq!(place.json(&format!("{arguments} --unweighted"))["valence"], 6);
    let finer = place.json(&format!("{arguments} --quadrature 9"));
    assert_ne!(number(&finer, "total"), number(&found, "total"));
    close(number(&finer, "total"), sum, 1e-2 * sum);
}

#[test]
fn tune() {
    let place = Place::new();
    let fields = "valence lambda s f2 f3 total branch lowest active minima starts evaluations";
    let found = place.json("tune -N 6 --lambda 0.39");
    has_fields(&found, fields);
    assert_eq!((number(&found, "lambda"), found["starts"].as_u64()), (0.39, Some(100)));
    assert_eq!(found["active"], serde_json::json!(["last_block"]));
    assert_eq!(found["branch"], "continued");
    assert!(number(&found, "lowest") <= number(&found, "total"));
    // what tuning reports is what the objective gives there
    let (f2, f3) = (&found["f2"], &found["f3"]);
    let there = place.json(&format!("objective -N 6 --lambda 0.39 --f2 {f2} --f3 {f3}"));
    close(
        number(&there, "total"),
        number(&found, "total"),
        1e-9 * number(&found, "total"),
    );
    // from all starting points the same
    let full = place.json("tune -N 6 --lambda 0.39 --starts full");
    close(
        number(&full, "lowest"),
        number(&found, "lowest"),
        1e-6 * number(&found, "lowest"),
    );
    // another objective is not the one that was tabulated
    assert_eq!(place.json("tune -N 6 --lambda 0.39 --unweighted")["branch"], "lowest");

    let four = place.json("tune -N 4 --global");
    has_fields(&four, fields);
    close(number(&four, "lambda"), 0.5, 1e-12);
    close(number(&four, "f2"), 0.25, 1e-12);
    close(number(&four, "f3"), 0.25, 1e-12);
    assert!(number(&four, "total") < 1e-12);
    // Ma, Wang and Ma (2023), Table 1
    let five = place.json("tune -N 5 --global");
    close(number(&five, "lambda"), 0.5599, 1e-3);
    assert!(number(&five, "total") <= number(&place.json("tune -N 5 --lambda 0.55"), "total"));
}

fn eigenvalues(spectrum: &Value) -> Vec<(f64, f64, u64, u64)> {
    let read = |e: &Value| {
        has_fields(e, "re im fourier multiplicity");
        let count = |field: &str| e[field].as_u64().unwrap();
        (
            number(e, "re"),
            number(e, "im"),
            count("fourier"),
            count("multiplicity"),
        )
    };
    spectrum["eigenvalues"].as_array().unwrap().iter().map(read).collect()
}

#[test]
fn spectrum() {
    let place = Place::new();
    for n in [3, 4, 5, 64] {
        for scheme in [
            "catmull-clark",
            "lambda:lambda=0.75",
            "tension:order=4,u0=2",
            "doo-sabin",
        ] {
            let found = place.json(&format!("spectrum --scheme {scheme} -N {n}"));
            has_fields(&found, "scheme valence rings eigenvalues subdominant subsubdominant s");
            let list = eigenvalues(&found);
            let moduli: Vec<f64> = list.iter().map(|e| e.0.hypot(e.1)).collect();
            assert!(
                moduli.windows(2).all(|pair| pair[0] >= pair[1] - 1e-12),
                "{scheme} {n}: {moduli:?}"
            );
            close(list[0].0, 1.0, 1e-12);
            assert!(list.iter().all(|e| e.2 <= n / 2));
            // the sum of all eigenvalues is the trace of the matrix, the sum of multiplicities its size
            let matrix = place.json(&format!("matrix --scheme {scheme} -N {n}"));
            let rows = matrix["rows"].as_array().unwrap();
            assert_eq!(list.iter().map(|e| e.3).sum::<u64>(), rows.len() as u64);
            let trace: f64 = rows.iter().enumerate().map(|(i, row)| row[i].as_f64().unwrap()).sum();
            close(list.iter().map(|e| e.0 * e.3 as f64).sum(), trace, 1e-9);
            if scheme.starts_with("tension") || scheme.starts_with("catmull") {
                assert_eq!(rows.len() as u64, 2 * n + 1);
                // Peters and Reif (2008), 6.2
                let c = (std::f64::consts::TAU / n as f64).cos();
                let lambda = (c + 5.0 + ((c + 9.0) * (c + 1.0)).sqrt()) / 16.0;
                close(number(&found, "subdominant"), lambda, 1e-12);
                let (mu, s) = (number(&found, "subsubdominant"), number(&found, "s"));
                close(s, mu / (lambda * lambda), 1e-12);
            }
        }
    }
    let more = place.json("spectrum --scheme catmull-clark -N 5 --rings 3");
    assert_eq!(more["rings"], 3);
    assert_eq!(eigenvalues(&more).iter().map(|e| e.3).sum::<u64>(), 1 + 5 * 12);
    let stencils = &place.json("spectrum --scheme catmull-clark -N 5")["limit_stencils"];
    // the limit point of Catmull-Clark surfaces: N/(N+5) V + ... (Halstead, Kass and DeRose 1993)
    close(stencils["position"][0].as_f64().unwrap(), 0.5, 1e-12);
    close(stencils["position"][1].as_f64().unwrap(), 4.0 / 50.0, 1e-12);
    close(stencils["position"][2].as_f64().unwrap(), 1.0 / 50.0, 1e-12);
}

#[test]
fn matrix_in_all_formats() {
    let place = Place::new();
    for (scheme, n) in [("catmull-clark", 5), ("lambda:optimal", 3), ("tension:order=6,u0=2", 4)] {
        let n = n.to_string();
        let write = |format: &str| {
            let name = format!("S.{format}");
            let arguments = ["matrix", "--scheme", scheme, "-N", &n, "--format", format, "-o", &name];
            assert_eq!(place.ok(&arguments), "");
            name
        };
        let json: Value = serde_json::from_str(&place.read(&write("json"))).unwrap();
        let rows: Vec<Vec<f64>> = serde_json::from_value(json["rows"].clone()).unwrap();
        let size = rows.len();
        let points = json["points"].as_array().unwrap();
        assert_eq!(points.len(), size);
        has_fields(&points[0], "index sector a b");
        assert!(rows.iter().all(|row| (row.iter().sum::<f64>() - 1.0).abs() < 1e-12));

        let csv: Vec<Vec<f64>> = place
            .read(&write("csv"))
            .lines()
            .map(|line| line.split(',').map(|entry| entry.parse().unwrap()).collect())
            .collect();
        assert_eq!(csv, rows);

        let mtx = place.read(&write("mtx"));
        assert!(mtx.starts_with("%%MatrixMarket matrix coordinate real general\n"));
        let mut lines = mtx.lines().filter(|line| !line.starts_with('%'));
        let counts: Vec<usize> = lines.next().unwrap().split(' ').map(|c| c.parse().unwrap()).collect();
        let mut dense = vec![vec![0.0; size]; size];
        let mut entries = 0;
        for line in lines {
            let parts: Vec<&str> = line.split(' ').collect();
            let index = |i: usize| parts[i].parse::<usize>().unwrap() - 1;
            dense[index(0)][index(1)] = parts[2].parse().unwrap();
            entries += 1;
        }
        assert_eq!(counts, [size, size, entries]);
        assert_eq!(dense, rows);

        let npy = std::fs::read(place.path().join(write("npy"))).unwrap();
        assert_eq!(&npy[..8], b"\x93NUMPY\x01\x00");
        let length = usize::from(u16::from_le_bytes([npy[8], npy[9]]));
        assert_eq!((10 + length) % 64, 0);
        let header = std::str::from_utf8(&npy[10..10 + length]).unwrap();
        let shape = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({size}, {size}), }}");
        assert_eq!(header.trim_end(), shape);
        assert!(header.ends_with('\n'));
        let data: Vec<f64> = npy[10 + length..]
            .chunks_exact(8)
            .map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap()))
            .collect();
        assert_eq!(data, rows.concat());

        // a matrix of one's own has the eigenvalues of its scheme
        let own = eigenvalues(&place.json(&format!("spectrum --matrix S.csv -N {n}")));
        let scheme = eigenvalues(&place.json(&format!("spectrum --scheme {scheme} -N {n}")));
        let key = |e: &(f64, f64, u64, u64)| (e.2, e.3);
        assert_eq!(own.len(), scheme.len());
        for (a, b) in own.iter().zip(&scheme) {
            close(a.0, b.0, 1e-9);
            close(a.1.abs(), b.1.abs(), 1e-9);
            assert_eq!(key(a), key(b));
        }
        // and must be the same in all sectors
        let mut lines: Vec<String> = place.read("S.csv").lines().map(str::to_owned).collect();
        let last = lines.len() - 1;
        lines[last] = lines[last].replacen("0", "1", 1);
        place.write("bad.csv", lines.join("\n"));
        let run = place.run(&["spectrum", "--matrix", "bad.csv", "-N", &n]);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""));
        assert!(run.stderr.contains("bad.csv"), "{}", run.stderr);
    }
    place.ok(&[
        "matrix",
        "--scheme",
        "catmull-clark",
        "-N",
        "5",
        "--numbering",
        "points.csv",
    ]);
    let points = csv_rows(&place.read("points.csv"));
    assert_eq!(points.len(), 11);
    assert_eq!(
        (
            points[2]["sector"].as_str(),
            points[2]["a"].as_str(),
            points[2]["b"].as_str()
        ),
        ("0", "1", "1")
    );
}

#[test]
fn compare() {
    let place = Place::new();
    let line = "compare --schemes catmull-clark,lambda:optimal,tension:order=4,u0=2,doo-sabin --valences 3..6";
    let found = place.json(line);
    let rows = found.as_array().unwrap();
    assert_eq!(rows.len(), 16);
    for row in rows {
        has_fields(
            row,
            "valence scheme lambda mu/lambda^2 K_m E theta gap strict hull remark",
        );
    }
    // beyond valence 4 bounded curvature and a smaller objective are what the optimal scheme is for
    let (catmull_clark, optimal) = (&rows[8], &rows[9]);
    assert_eq!(catmull_clark["valence"], 5);
    assert!(number(catmull_clark, "mu/lambda^2") > 1.1);
    close(number(optimal, "mu/lambda^2"), 1.0, 1e-9);
    assert!(number(optimal, "E") < number(catmull_clark, "E"));
    let arguments: Vec<&str> = line.split(' ').chain(["--format", "csv"]).collect();
    let csv = csv_rows(&place.ok(&arguments));
    for (row, json) in csv.iter().zip(rows) {
        assert_eq!(row["lambda"].parse::<f64>().ok(), json["lambda"].as_f64());
    }
}

#[test]
fn tables_come_out_in_every_format() {
    let place = Place::new();
    for line in [
        "stencil -N 6 --lambda 0.55",
        "objective -N 6 --lambda 0.55 --f2 0.25 --f3 0.2",
        "tune -N 6 --lambda 0.39",
        "spectrum --scheme catmull-clark -N 5",
        "compare --schemes catmull-clark --valences 3,4",
    ] {
        let run = |format: &str| {
            let arguments: Vec<&str> = line.split(' ').chain(["--format", format]).collect();
            place.ok(&arguments)
        };
        let csv = run("csv");
        let mut records = csv::Reader::from_reader(csv.as_bytes());
        // the reader refuses rows of different lengths
        let rows = records.records().map(Result::unwrap).count();
        assert!(rows > 0, "{line}");
        let latex = run("latex");
        assert!(
            latex.starts_with("\\begin{tabular}{") && latex.ends_with("\\end{tabular}\n"),
            "{latex}"
        );
        // tables that are wider than a page are split
        let parts = latex.matches("\\begin{tabular}").count();
        assert_eq!(latex.matches(" \\\\\n").count(), parts * (rows + 1), "{latex}");
        let text = run("text");
        assert!(
            text.lines().count() > 1 && text.lines().all(|l| l == l.trim_end()),
            "{text}"
        );
    }
}

/// Help texts quote the glossary, which is a command and a topic of help itself.
#[test]
fn help_quotes_the_glossary() {
    let place = Place::new();
    let plain = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let page = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/glossary.md")).unwrap();
    let page = page.replace(['`', '*'], "");
    let topic = plain(&place.ok(&["help", "glossary"]));
    let printed = plain(&place.ok(&["glossary"]));
    let mut quoted = 0;
    for row in page.lines().filter(|line| line.starts_with("| ")).skip(1) {
        let cells: Vec<&str> = row.trim_matches('|').split(" | ").map(str::trim).collect();
        let entry = plain(&format!("{}: {}", cells[0], cells[1]));
        assert!(topic.contains(&entry) && printed.contains(&entry), "{entry}\n{topic}");
        for command in ["compare", "spectrum", "verify", "tune", "objective"] {
            let help = plain(&place.ok(&[command, "--help"]));
            let wanted = cells[2].split([',', ';', ' ']).any(|word| word == command);
            assert_eq!(help.contains(&entry), wanted, "{command}: {entry}");
            quoted += usize::from(wanted);
        }
    }
    assert!(quoted > 15, "{quoted}");
}

#[test]
fn every_command_has_a_page_for_man() {
    let place = Place::new();
    let top = place.ok(&["completions", "man"]);
    let listed: Vec<_> = top
        .lines()
        .filter_map(|line| line.strip_prefix("eigenring\\-")?.strip_suffix("(1)"))
        .map(|name| name.replace('\\', ""))
        .filter(|name| name != "help")
        .collect();
    assert!(
        listed.len() > 20 && listed.contains(&"new-scheme".to_owned()),
        "{listed:?}"
    );
    for name in ["new-scheme", "make revolve"] {
        let words: Vec<_> = ["completions", "man"].into_iter().chain(name.split(' ')).collect();
        let page = place.ok(&words);
        assert!(
            page.contains(&format!(".TH eigenring-{} 1 ", name.replace(' ', "-"))),
            "{page}"
        );
        assert!(page.contains(".SH SYNOPSIS") && page.contains("\\-\\-help"), "{page}");
    }
    for wrong in [["completions", "man", "tuna"], ["completions", "bash", "tune"]] {
        let run = place.run(&wrong);
        assert!(run.code == Some(2) && run.stderr.contains("accepted"), "{}", run.stderr);
    }
}

#[test]
fn help_has_examples_and_no_escape_sequences() {
    let place = Place::new();
    assert!(place.ok(&["--version"]).starts_with("eigenring "));
    let top = place.ok(&["--help"]);
    for command in [
        "tables",
        "stencil",
        "objective",
        "tune",
        "spectrum",
        "matrix",
        "compare",
        "curve",
        "verify",
        "reproduce",
        "completions",
        "plot",
    ] {
        assert!(top.contains(&format!("  {command} ")), "{command}");
        place.write("points.csv", "0,0\n1,2\n3,1\n4,4\n6,0\n");
        let help = place.ok(&[command, "--help"]);
        assert!(
            help.contains("Example") && help.contains(&format!("  eigenring {command}")),
            "{help}"
        );
        assert!(!help.contains('\x1b'), "{command}");
        // the examples in help texts are run, but those that take long or need files
        for line in help.lines().filter(|line| line.starts_with("  eigenring ")) {
            let line = line.split("   ").next().unwrap_or(line).trim();
            if line.contains("tables")
                || line.contains("reproduce")
                || line.contains("--matrix")
                || line.contains("my.toml")
                || line.contains("--all")
                || line.contains("--recheck")
            {
                continue;
            }
            let arguments: Vec<&str> = line.split_whitespace().skip(1).collect();
            place.ok(&arguments);
        }
    }
}
