//! **Claim**: a page is well-formed and accessible, names nothing outside of itself, and says what is known
//! of the scheme. **Oracle**: a reader of tags written here; what is proven in the literature.

use super::*;
use std::collections::BTreeSet;

/// A tag as it is written: its name, its attributes, and the text after it.
struct Tag<'a> {
    name: &'a str,
    attributes: &'a str,
    text: &'a str,
}

impl Tag<'_> {
    fn get(&self, attribute: &str) -> Option<&str> {
        let (_, rest) = self.attributes.split_once(&format!(" {attribute}=\""))?;
        rest.split('"').next()
    }
}

/// The tags of a page in order; all that are opened are closed, one in the other.
fn tags(page: &str) -> Vec<Tag<'_>> {
    const VOID: [&str; 1] = ["meta"];
    let (mut tags, mut open, mut rest) = (Vec::new(), Vec::new(), page.strip_prefix("<!DOCTYPE html>").unwrap());
    while let Some(start) = rest.find('<') {
        let end = start + rest[start..].find('>').unwrap();
        let inside = &rest[start + 1..end];
        rest = &rest[end + 1..];
        if let Some(name) = inside.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "closed out of turn");
            continue;
        }
        let name = inside.split([' ', '/', '\n']).next().unwrap();
        // a script's text is no markup
        if ["script", "style"].contains(&name) {
            rest = rest.split_once(&format!("</{name}>")).unwrap().1;
        } else if !inside.ends_with('/') && !VOID.contains(&name) {
            open.push(name);
        }
        let text = rest.split('<').next().unwrap_or_default();
        tags.push(Tag {
            name,
            attributes: &inside[name.len()..],
            text,
        });
    }
    assert!(open.is_empty(), "left open: {open:?}");
    tags
}

fn checked(scheme: &str, valences: &[usize]) -> String {
    let name: SchemeName = scheme.parse().unwrap();
    let page = page(&name, valences, &Tuner::default()).unwrap();
    let tags = tags(&page);
    // identifiers are there once, and what is linked to is there
    let ids: Vec<&str> = tags.iter().filter_map(|tag| tag.get("id")).collect();
    let known: BTreeSet<&str> = ids.iter().copied().collect();
    assert_eq!(known.len(), ids.len(), "{scheme}: identifiers are not unique");
    for tag in &tags {
        for link in ["href", "xlink:href", "src"].iter().filter_map(|name| tag.get(name)) {
            let inside = link.strip_prefix('#').is_some_and(|id| known.contains(id));
            assert!(inside || link.starts_with("data:image/png;base64,"), "{scheme}: {link}");
        }
        if let Some(id) = tag.get("aria-labelledby") {
            assert!(known.contains(id), "{scheme}: {id}");
        }
        match tag.name {
            "html" => assert_eq!(tag.get("lang"), Some("en")),
            "th" => assert!(tag.get("scope").is_some(), "{scheme}: a heading that heads nothing"),
            _ => {}
        }
    }
    // one first heading, and no level is left out
    let levels = tags
        .iter()
        .filter_map(|tag| tag.name.strip_prefix('h')?.parse::<usize>().ok());
    let levels: Vec<usize> = levels.collect();
    assert_eq!((levels[0], levels.iter().filter(|level| **level == 1).count()), (1, 1));
    assert!(
        levels.windows(2).all(|pair| pair[1] <= pair[0] + 1),
        "{scheme}: {levels:?}"
    );
    // tables have captions, pictures have names
    for pair in tags.windows(2) {
        match pair[0].name {
            "table" => assert_eq!(pair[1].name, "caption", "{scheme}"),
            "svg" => {
                assert_eq!(pair[0].get("role"), Some("img"));
                assert!(pair[1].name == "title" && !pair[1].text.is_empty(), "{scheme}");
            }
            _ => {}
        }
    }
    for section in [
        "scheme",
        "verdicts",
        "spectra",
        "limit-stencils",
        "natural",
        "characteristic",
        "second-order",
        "comparison",
    ] {
        assert!(known.contains(section), "{scheme}: no section {section}");
    }
    assert!(tags.iter().all(|tag| !tag.text.contains("NaN")), "{scheme}");
    page
}

/// The cells of a row of the first table, at a valence.
fn glance(page: &str, valence: usize) -> Vec<String> {
    let table = page.split("</table>").next().unwrap();
    let (_, row) = table.split_once(&format!("<th scope=\"row\">{valence}</th>")).unwrap();
    let row = row.split("</tr>").next().unwrap();
    let cells = row
        .split("</td>")
        .map(|cell| cell.rsplit("<td").next().unwrap().split('>'));
    cells
        .map(|parts| parts.skip(1).map(|part| part.split('<').next().unwrap()).collect())
        .filter(|cell: &String| !cell.is_empty())
        .collect()
}

/// Catmull-Clark is C1 at all valences (Peters and Reif 1998), and its curvature is bounded at N = 3 only
/// (Doo and Sabin 1978), but for the regular valence.
#[test]
fn the_page_of_catmull_clark() {
    let page = checked("catmull-clark", &[3, 5]);
    assert_eq!(glance(&page, 3)[2..4], ["proven", "proven"]);
    assert_eq!(glance(&page, 5)[2..4], ["proven", "refuted"]);
    assert_eq!(glance(&page, 5)[0], "0.5499883545");
    // its vertex rule, 3/(2n) and 1/(4n) in all
    for part in [
        "<mi>α</mi><mo>=</mo><mrow><mfrac><mrow><mi>a</mi></mrow><mrow><mi>n</mi></mrow></mfrac></mrow>",
        "Witness: an eigenvalue of block 2",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert!(page.contains("eigenring verify --scheme catmull-clark -N 3,5\n"));
    assert!(page.contains("data:image/png;base64,"), "dense maps are pixels");
}

#[test]
fn pages_of_schemes_of_all_kinds() {
    // around a face; levels that differ, without formulas of their own; an optimal member, tuned tables
    for (scheme, valence) in [("doo-sabin", 3), ("tension:order=5,u0=0.5", 5), ("lambda:optimal", 4)] {
        let page = checked(scheme, &[valence]);
        assert_eq!(glance(&page, valence)[2], "proven", "{scheme}");
    }
}

/// Where there is no characteristic map the page says so: block 0 leads in this file.
#[test]
fn what_has_no_meaning_is_said_in_a_line() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/cases/");
    let page = checked(&format!("file:{folder}block0_subdominant3.toml"), &[3]);
    assert_eq!(glance(&page, 3)[2], "undecided");
    assert_eq!(
        page.matches("<p class=\"note\">No picture at N = 3: the subdominant eigenvalue")
            .count(),
        3
    );
    assert_eq!(
        page.matches("<svg").count(),
        1,
        "the spectrum is drawn, and nothing else"
    );
}
