//! **Claim**: a page about a scheme is one file that a browser shows without an error, without asking the
//! network for anything, in light and dark and on paper; bad input leaves no file behind.
//! **Oracle**: Chromium, where it is installed: its console, its log of requests, its pixels.

#![allow(missing_docs)]

use crate::common::Place;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The browser, if there is one: named by the variable CHROMIUM, or found on the path.
fn browser() -> Option<PathBuf> {
    let named = std::env::var_os("CHROMIUM").map(PathBuf::from);
    let folders: Vec<PathBuf> =
        std::env::var_os("PATH").map_or(Vec::new(), |path| std::env::split_paths(&path).collect());
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let mut found = names
        .iter()
        .flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    named.or_else(|| found.find(|path| path.is_file()))
}

/// What the browser tells of a page.
struct Shown {
    console: Vec<String>,
    /// Who asked for what, but for the browser's own requests.
    requests: usize,
}

/// Opens a page, with options that say what becomes of it.
fn open(browser: &Path, page: &Path, options: &[String]) -> Shown {
    let profile = tempfile::tempdir().unwrap();
    let log = profile.path().join("net.json");
    let output = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--hide-scrollbars",
            "--no-first-run",
        ])
        // the browser itself asks nobody either
        .args([
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
        ])
        .args([
            "--host-resolver-rules=MAP * ~NOTFOUND",
            "--enable-logging=stderr",
            "--log-level=0",
        ])
        .arg(format!("--user-data-dir={}", profile.path().display()))
        .arg(format!("--log-net-log={}", log.display()))
        .args(options)
        .arg(format!("file://{}", page.display()))
        .stdin(Stdio::null())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    let requests = std::fs::read_to_string(log).unwrap();
    assert!(requests.contains("\"constants\""), "no log of requests was written");
    let initiators = requests.split("\"initiator\":\"").skip(1);
    Shown {
        console: told
            .lines()
            .filter(|line| line.contains(":CONSOLE"))
            .map(str::to_owned)
            .collect(),
        requests: initiators.filter(|rest| !rest.starts_with("not an origin\"")).count(),
    }
}

/// Width, height and the colours of the pixels of an RGB picture.
fn pixels(path: &Path) -> (usize, Vec<[u8; 3]>) {
    let mut reader = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path).unwrap()))
        .read_info()
        .unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    let channels = info.color_type.samples();
    let colours = bytes[..info.buffer_size()]
        .chunks_exact(channels)
        .map(|p| [p[0], p[1], p[2]]);
    (info.width as usize, colours.collect())
}

fn grey([r, g, b]: [u8; 3]) -> u32 {
    (u32::from(r) + u32::from(g) + u32::from(b)) / 3
}

#[test]
fn a_browser_shows_the_page() {
    let Some(browser) = browser() else {
        // not captured: a reader of the tests must see it
        writeln!(
            std::io::stderr(),
            "SKIPPED: no Chromium is installed; the page was not opened in a browser"
        )
        .unwrap();
        return;
    };
    let place = Place::new();
    place.ok(&["report", "--scheme", "catmull-clark", "-N", "3,5", "-o", "page.html"]);
    let page = place.path().join("page.html");
    let shot = |name: &str, dark: bool| {
        let path = place.path().join(name);
        let scheme = format!("--blink-settings=preferredColorScheme={}", u8::from(!dark));
        let shown = open(
            &browser,
            &page,
            &[
                scheme,
                "--window-size=900,6000".into(),
                format!("--screenshot={}", path.display()),
            ],
        );
        assert_eq!((shown.console, shown.requests), (Vec::<String>::new(), 0));
        pixels(&path)
    };
    let (light, dark) = (shot("light.png", false), shot("dark.png", true));
    // the page, and what is written on it: most pixels are light with dark ones among them, and the reverse
    for ((width, colours), page) in [(&light, 255), (&dark, 23)] {
        assert_eq!(*width, 900);
        let ground = colours
            .iter()
            .filter(|colour| grey(**colour).abs_diff(page) < 8)
            .count();
        let far = colours
            .iter()
            .filter(|colour| grey(**colour).abs_diff(page) > 140)
            .count();
        assert!(
            2 * ground > colours.len() && 200 * far > colours.len(),
            "{ground} and {far} of {}",
            colours.len()
        );
    }
    // figures have no white ground on a dark page
    let white = dark.1.iter().filter(|colour| grey(**colour) > 250).count();
    assert!(200 * white < dark.1.len(), "{white} white pixels");

    let paper = place.path().join("page.pdf");
    let shown = open(
        &browser,
        &page,
        &[
            "--no-pdf-header-footer".into(),
            format!("--print-to-pdf={}", paper.display()),
        ],
    );
    assert_eq!((shown.console, shown.requests), (Vec::<String>::new(), 0));
    let printed = std::fs::read(&paper).unwrap();
    assert!(
        printed.starts_with(b"%PDF-") && printed.len() > 50_000,
        "{} bytes",
        printed.len()
    );

    // what the browser would tell of a page that is not so
    place.write(
        "faulty.html",
        "<!DOCTYPE html><img src=\"http://example.invalid/a.png\" alt=\"\"><script>nonsense()</script>",
    );
    let faulty = open(&browser, &place.path().join("faulty.html"), &["--dump-dom".into()]);
    assert!(
        faulty.console.iter().any(|line| line.contains("nonsense")),
        "{:?}",
        faulty.console
    );
    assert!(faulty.requests > 0);
}

#[test]
fn a_page_is_written_whole_or_not_at_all() {
    let place = Place::new();
    place.ok(&["new-scheme", "--like", "catmull-clark", "-o", "my.toml"]);
    let run = place.run(&[
        "report",
        "--scheme",
        "file:my.toml",
        "--set",
        "a=1.4",
        "-N",
        "5",
        "-o",
        "my.html",
    ]);
    assert_eq!(
        (run.code, run.stdout.as_str(), run.stderr.as_str()),
        (Some(0), "", "wrote my.html\n")
    );
    let page = place.read("my.html");
    for part in [
        "<title>catmull-clark,a=7/5 ",
        "eigenring report --scheme file:my.toml,a=7/5 -N 5 -o page.html",
        "total weight of the edge neighbours",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert_eq!(
        place.ok(&["report", "--scheme", "file:my.toml,a=1.4", "-N", "5"]),
        page,
        "to standard output"
    );
    place.write("five.toml", place.read("my.toml").replace("n = \"3..\"", "n = \"5\""));
    for (arguments, needle) in [
        (vec!["--scheme", "file:five.toml", "-N", "5,6"], "valence"),
        (vec!["--scheme", "catmull-clark", "-N", "3.."], "has no end"),
        (vec!["--scheme", "catmul-clark"], "did you mean"),
        (vec!["--scheme", "catmull-clark", "--set", "a=1"], "--set"),
    ] {
        let run = place.run(&[vec!["report"], arguments, vec!["-o", "other.html"]].concat());
        assert!(run.code == Some(2) && run.stderr.contains(needle), "{}", run.stderr);
        assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
    }
    let run = place.run(&["report", "--scheme", "catmull-clark", "-N", "5", "-o", "page.pdf"]);
    assert!(
        run.code == Some(2) && run.stderr.contains("a name that ends with .html"),
        "{}",
        run.stderr
    );
    let names: Vec<_> = std::fs::read_dir(place.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    assert_eq!(names.len(), 3, "{names:?}");
}
