//! Tables as LaTeX tabulars that need no package: names of quantities in mathematics, true minus signs, and
//! no tabular wider than a page.

use super::{Cell, Table, short};

/// Characters of a line that fit into the text width of an article at ten points.
const PAGE: usize = 80;

/// The names of quantities and how they are set. Other names are words.
const SYMBOLS: &[(&str, &str)] = &[
    ("lambda", "\\lambda"),
    ("mu", "\\mu"),
    ("mu/lambda^2", "\\mu/\\lambda^2"),
    ("K_m", "K_m"),
    ("E", "E"),
    ("E_cup", "E_\\mathrm{cup}"),
    ("theta", "\\theta"),
    ("valence", "N"),
    ("N", "N"),
    ("s", "s"),
    ("a", "a"),
    ("b", "b"),
    ("c", "c"),
    ("u", "u"),
    ("u0", "u_0"),
    ("f1", "f_1"),
    ("f2", "f_2"),
    ("f3", "f_3"),
    ("d1", "d_1"),
    ("d2", "d_2"),
    ("e1", "e_1"),
    ("e2", "e_2"),
    ("g1", "g_1"),
    ("g2", "g_2"),
    ("g3", "g_3"),
    ("alpha", "\\alpha"),
    ("beta", "\\beta"),
    ("delta", "\\delta"),
    ("re", "\\mathrm{Re}"),
    ("im", "\\mathrm{Im}"),
    ("lambda_r1", "\\lambda_{r1}"),
    ("lambda_r2", "\\lambda_{r2}"),
    ("lambda_A", "\\lambda_A"),
    ("lambda_C", "\\lambda_C"),
    ("lambda_CC", "\\lambda_{CC}"),
    ("lambda_M", "\\lambda_M"),
    ("lambda_l", "\\lambda_l"),
    ("lambda1", "\\lambda_1"),
    ("lambda3", "\\lambda_3"),
];

fn head(name: &str) -> String {
    let known = SYMBOLS
        .iter()
        .find(|(known, _)| *known == name)
        .map(|(_, symbol)| (*symbol).to_owned());
    // coefficients and knots are numbered
    let numbered = || {
        let digits = name.trim_start_matches(|letter: char| letter.is_ascii_alphabetic());
        match &name[..name.len() - digits.len()] {
            "C" if !digits.is_empty() => Some(format!("C_{{{digits}}}")),
            "xi" if !digits.is_empty() => Some(format!("\\xi_{{{digits}}}")),
            _ => None,
        }
    };
    match known.or_else(numbered) {
        Some(symbol) => format!("${symbol}$"),
        None => escape(&name.replace('_', " ")),
    }
}

fn escape(text: &str) -> String {
    let character = |character: char| match character {
        '\\' => "\\textbackslash{}".to_owned(),
        '^' => "\\textasciicircum{}".to_owned(),
        '~' => "\\textasciitilde{}".to_owned(),
        '_' | '%' | '&' | '#' | '$' | '{' | '}' => format!("\\{character}"),
        other => other.to_string(),
    };
    text.chars().map(character).collect()
}

fn entry(cell: &Cell) -> String {
    match cell {
        Cell::Number(number) if !number.is_finite() => escape(&cell.for_people()),
        Cell::Number(number) => {
            let text = short(*number);
            match text.split_once('e') {
                Some((mantissa, exponent)) => format!("${mantissa} \\times 10^{{{exponent}}}$"),
                // a minus sign, and no hyphen
                None if text.starts_with('-') => format!("${text}$"),
                None => text,
            }
        }
        Cell::Empty => "--".to_owned(),
        other => escape(&other.for_people()),
    }
}

/// One tabular, or several below each other, each of which begins with the columns that say what a row is.
pub fn render(table: &Table) -> String {
    let cells: Vec<Vec<String>> = table.rows.iter().map(|row| row.iter().map(entry).collect()).collect();
    // as it is seen: without the markup
    let seen = |column: usize| {
        let longest = table
            .rows
            .iter()
            .map(|row| row[column].for_people().chars().count())
            .max()
            .unwrap_or(0);
        longest.max(table.columns[column].chars().count().min(12)) + 2
    };
    let is_number = |column: usize| table.rows.iter().any(|row| matches!(row[column], Cell::Number(_)));
    let keys = (0..table.columns.len())
        .take(2)
        .take_while(|&column| !is_number(column))
        .count();
    let key_width: usize = (0..keys).map(seen).sum();
    let mut groups: Vec<Vec<usize>> = vec![(0..keys).collect()];
    let mut width = key_width;
    for column in keys..table.columns.len() {
        let full = groups.last().is_some_and(|group| group.len() > keys) && width + seen(column) > PAGE;
        if full {
            groups.push((0..keys).collect());
            width = key_width;
        }
        width += seen(column);
        if let Some(group) = groups.last_mut() {
            group.push(column);
        }
    }
    let tabular = |group: &Vec<usize>| {
        let alignment: String = group
            .iter()
            .map(|&column| if table.is_words(column) { 'l' } else { 'r' })
            .collect();
        let line = |cells: Vec<String>| format!("{} \\\\\n", cells.join(" & "));
        let mut text = format!("\\begin{{tabular}}{{{alignment}}}\n\\hline\n");
        text.push_str(&line(
            group.iter().map(|&column| head(&table.columns[column])).collect(),
        ));
        text.push_str("\\hline\n");
        for row in &cells {
            text.push_str(&line(group.iter().map(|&column| row[column].clone()).collect()));
        }
        text + "\\hline\n\\end{tabular}\n"
    };
    groups.iter().map(tabular).collect::<Vec<_>>().join("\n\\medskip\n\n")
}
