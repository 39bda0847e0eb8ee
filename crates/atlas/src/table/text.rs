//! Tables as columns for people.

use super::{Cell, Table, rounded};

/// The most digits of a number, and the fewest that a table is narrowed to.
const DIGITS: [usize; 7] = [10, 9, 8, 7, 6, 5, 4];

/// The cells as text, with so many digits.
fn cells(table: &Table, digits: usize) -> Vec<Vec<String>> {
    let text = |cell: &Cell| match cell {
        Cell::Number(number) => rounded(*number, digits),
        other => other.for_people(),
    };
    table.rows.iter().map(|row| row.iter().map(text).collect()).collect()
}

fn widths(table: &Table, cells: &[Vec<String>]) -> Vec<usize> {
    let width = |column: usize| {
        let longest = cells.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
        longest.max(table.columns[column].chars().count())
    };
    (0..table.columns.len()).map(width).collect()
}

/// Columns with these cells; numbers on the right, words on the left.
fn aligned(table: &Table, cells: &[Vec<String>]) -> Vec<String> {
    let widths = widths(table, cells);
    let left: Vec<bool> = (0..table.columns.len()).map(|column| table.is_words(column)).collect();
    let line = |cells: &[String]| {
        let padded: Vec<String> = cells
            .iter()
            .zip(&widths)
            .zip(&left)
            .map(|((cell, &width), &left)| match left {
                true => format!("{cell:<width$}"),
                false => format!("{cell:>width$}"),
            })
            .collect();
        format!("{}\n", padded.join("  ").trim_end())
    };
    std::iter::once(&table.columns)
        .chain(cells)
        .map(|row| line(row))
        .collect()
}

/// All columns, numbers to ten digits.
pub fn whole(table: &Table) -> String {
    aligned(table, &cells(table, DIGITS[0])).concat()
}

/// Lines of at most `width` characters: numbers get fewer digits, then the words of a last column go below
/// their rows, then last columns are left out, which is said.
pub fn fitted(table: &Table, width: usize) -> String {
    let narrow = |table: &Table| {
        DIGITS.iter().find_map(|&digits| {
            let cells = cells(table, digits);
            let widths = widths(table, &cells);
            let total = widths.iter().sum::<usize>() + 2 * widths.len().saturating_sub(1);
            (total <= width).then(|| aligned(table, &cells))
        })
    };
    if let Some(lines) = narrow(table) {
        return lines.concat();
    }
    let last = table.columns.len().saturating_sub(1);
    if last > 0 && table.is_words(last) {
        let mut shorter = table.clone();
        shorter.columns.pop();
        let words: Vec<String> = shorter
            .rows
            .iter_mut()
            .filter_map(Vec::pop)
            .map(|cell| cell.for_programs())
            .collect();
        if let Some(lines) = narrow(&shorter) {
            return with_words(&lines, &table.columns[last], &words, width);
        }
    }
    let mut shorter = table.clone();
    while shorter.columns.len() > 1 {
        shorter.columns.pop();
        shorter.rows.iter_mut().for_each(|row| drop(row.pop()));
        if let Some(lines) = narrow(&shorter) {
            let left_out = table.columns[shorter.columns.len()..].join(", ");
            return format!(
                "{}left out for want of room: {left_out}; --wide shows all\n",
                lines.concat()
            );
        }
    }
    whole(table)
}

/// Lines with the words of a last column: beside the row where they fit, below it where not.
fn with_words(lines: &[String], column: &str, words: &[String], width: usize) -> String {
    let longest = lines
        .iter()
        .map(|line| line.trim_end().chars().count())
        .max()
        .unwrap_or(0);
    let fits = |words: &str| words.is_empty() || longest + 2 + words.chars().count() <= width;
    let beside =
        |line: &str, words: &str| format!("{}\n", format!("{:<longest$}  {words}", line.trim_end()).trim_end());
    let mut text = String::new();
    // the heading stands above those that are beside their rows
    let heading = if words.iter().any(|words| !words.is_empty() && fits(words)) {
        column
    } else {
        ""
    };
    for (line, words) in lines
        .iter()
        .zip(std::iter::once(heading).chain(words.iter().map(String::as_str)))
    {
        match fits(words) {
            true => text.push_str(&beside(line, words)),
            false => text.push_str(&format!("{line}{}", indented(words, width))),
        }
    }
    text
}

/// Words in indented lines.
fn indented(words: &str, width: usize) -> String {
    const INDENT: &str = "    ";
    let mut text = String::new();
    let mut line = String::new();
    for word in words.split_whitespace() {
        if !line.is_empty() && INDENT.len() + line.chars().count() + 1 + word.chars().count() > width {
            text.push_str(&format!("{INDENT}{line}\n"));
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    text.push_str(&format!("{INDENT}{line}\n"));
    text
}
