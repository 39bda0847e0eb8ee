//! **Claim**: the picture and the page `docs/numbering.md` show the numbering that the code uses. **Oracle**:
//! each other. Every labelled point of the picture carries its site; the page's table of indices is read as
//! it stands.

use eigenring_scheme::{Fan, Lattice, Numbering, Site};

fn numbering(lattice: Lattice) -> Numbering {
    Numbering {
        fan: Fan::Closed(5),
        lattice,
        rings: if lattice == Lattice::Vertex { 2 } else { 1 },
    }
}

/// The text between `before` and `after`.
fn between<'a>(text: &'a str, before: &str, after: &str) -> Option<&'a str> {
    text.split_once(before)?.1.split_once(after).map(|parts| parts.0)
}

#[test]
fn every_point_of_the_picture_has_its_index() {
    let picture = include_str!("../../docs/numbering.svg");
    for (name, lattice) in [("vertex", Lattice::Vertex), ("face", Lattice::Face)] {
        let numbering = numbering(lattice);
        let mut seen = vec![false; numbering.count()];
        let labels = picture
            .lines()
            .filter(|line| line.contains(&format!("data-net=\"{name}\"")));
        for label in labels {
            let site = between(label, "data-site=\"", "\"").unwrap();
            let [sector, x, y] = site.split(' ').map(|c| c.parse().unwrap()).collect::<Vec<i32>>()[..] else {
                panic!("{label}");
            };
            let index: usize = between(label, "\">", "<").unwrap().parse().unwrap();
            let site = Site {
                sector: sector as usize,
                x,
                y,
            };
            assert_eq!(numbering.index(site), Some(index), "{label}");
            seen[index] = true;
        }
        assert!(seen.iter().all(|&seen| seen), "a point of the {name} net is not shown");
    }
}

#[test]
fn the_indices_of_the_page_are_those_of_the_code() {
    let page = include_str!("../../docs/numbering.md");
    let table = between(page, "| vertex net | index |", "\n\n").unwrap();
    let mut compared = 0;
    for row in table.lines().skip(2) {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        for (cell, index, lattice) in [
            (cells[0], cells[1], Lattice::Vertex),
            (cells[2], cells[3], Lattice::Face),
        ] {
            let site = match between(cell, "(", ")") {
                None if cell == "centre" => Site::CENTRE,
                None => panic!("{cell}"),
                Some(numbers) => {
                    let numbers: Vec<i32> = numbers.split(',').map(|n| n.trim().parse().unwrap()).collect();
                    Site {
                        sector: numbers[0] as usize,
                        x: numbers[1],
                        y: numbers[2],
                    }
                }
            };
            assert_eq!(numbering(lattice).index(site), Some(index.parse().unwrap()), "{row}");
            compared += 1;
        }
    }
    assert_eq!(compared, 12);
}
