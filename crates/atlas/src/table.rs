//! Tables of numbers and words, in the formats that people and programs read.

use serde_json::Value;

/// How a table is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// Columns for people; numbers to ten digits.
    #[default]
    Text,
    /// One JSON value, full precision.
    Json,
    /// Comma-separated values with a header, full precision.
    Csv,
    /// A LaTeX tabular; numbers to ten digits.
    Latex,
}

/// An entry.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A number; printed in full where programs read it.
    Number(f64),
    /// A count or index.
    Count(usize),
    /// A word.
    Word(String),
    /// Nothing: not defined, or not applicable.
    Empty,
}

impl From<f64> for Cell {
    fn from(number: f64) -> Cell {
        Cell::Number(number)
    }
}

impl From<usize> for Cell {
    fn from(count: usize) -> Cell {
        Cell::Count(count)
    }
}

impl From<&str> for Cell {
    fn from(word: &str) -> Cell {
        Cell::Word(word.to_owned())
    }
}

impl From<String> for Cell {
    fn from(word: String) -> Cell {
        Cell::Word(word)
    }
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(cell: Option<T>) -> Cell {
        cell.map_or(Cell::Empty, Into::into)
    }
}

/// Ten significant digits without trailing zeros; exponents only where they are shorter.
pub fn short(number: f64) -> String {
    if number == 0.0 || !number.is_finite() {
        return format!("{}", number + 0.0);
    }
    let exponent = number.abs().log10().floor() as i32;
    if !(-5..10).contains(&exponent) {
        let text = format!("{number:.9e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", mantissa.trim_end_matches('0').trim_end_matches('.'));
    }
    let text = format!("{number:.*}", (9 - exponent).max(0) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

impl Cell {
    fn for_people(&self) -> String {
        match self {
            Cell::Number(number) => short(*number),
            Cell::Empty => "-".to_owned(),
            other => other.for_programs(),
        }
    }

    /// Shortest text that reads back as the same double.
    fn for_programs(&self) -> String {
        match self {
            Cell::Number(number) => format!("{number}"),
            Cell::Count(count) => count.to_string(),
            Cell::Word(word) => word.clone(),
            Cell::Empty => String::new(),
        }
    }

    fn json(&self) -> Value {
        match self {
            Cell::Number(number) => Value::from(*number),
            Cell::Count(count) => Value::from(*count),
            Cell::Word(word) => Value::from(word.clone()),
            Cell::Empty => Value::Null,
        }
    }
}

/// Columns with names, and rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// An empty table with these columns.
    pub fn new<C: Into<String>>(columns: impl IntoIterator<Item = C>) -> Self {
        Table {
            columns: columns.into_iter().map(Into::into).collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row, one cell a column.
    pub fn push(&mut self, row: Vec<Cell>) {
        debug_assert_eq!(row.len(), self.columns.len(), "a row has one cell for each column");
        self.rows.push(row);
    }

    /// The table with one more column, the first, whose cells are all alike.
    pub fn beside(mut self, column: &str, cell: impl Into<Cell>) -> Self {
        let cell = cell.into();
        self.columns.insert(0, column.to_owned());
        self.rows.iter_mut().for_each(|row| row.insert(0, cell.clone()));
        self
    }

    /// Adds the rows of a table with the same columns.
    pub fn append(&mut self, other: Table) {
        debug_assert_eq!(self.columns, other.columns, "rows have one cell for each column");
        self.rows.extend(other.rows);
    }

    /// The table in a format; JSON as a list of objects.
    pub fn render(&self, format: Format) -> String {
        match format {
            Format::Text => self.text(),
            Format::Json => pretty(&self.json()),
            Format::Csv => self.csv(),
            Format::Latex => self.latex(),
        }
    }

    /// The rows as objects.
    pub fn json(&self) -> Value {
        let object = |row: &Vec<Cell>| {
            let pairs = self.columns.iter().cloned().zip(row.iter().map(Cell::json));
            Value::Object(pairs.collect())
        };
        Value::Array(self.rows.iter().map(object).collect())
    }

    /// Whether a column holds words, which are aligned on the left.
    fn is_words(&self, column: usize) -> bool {
        let word = |row: &Vec<Cell>| matches!(row[column], Cell::Word(_));
        self.rows.iter().any(word) && self.rows.iter().all(|row| word(row) || row[column] == Cell::Empty)
    }

    fn text(&self) -> String {
        let cells: Vec<Vec<String>> = self
            .rows
            .iter()
            .map(|row| row.iter().map(Cell::for_people).collect())
            .collect();
        let width = |column: usize| {
            let longest = cells.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
            longest.max(self.columns[column].chars().count())
        };
        let widths: Vec<usize> = (0..self.columns.len()).map(width).collect();
        let left: Vec<bool> = (0..self.columns.len()).map(|column| self.is_words(column)).collect();
        let line = |cells: &[String]| {
            let padded: Vec<String> = cells
                .iter()
                .zip(&widths)
                .zip(&left)
                .map(|((cell, &width), &left)| {
                    if left {
                        format!("{cell:<width$}")
                    } else {
                        format!("{cell:>width$}")
                    }
                })
                .collect();
            format!("{}\n", padded.join("  ").trim_end())
        };
        let mut text = line(&self.columns);
        for row in &cells {
            text.push_str(&line(row));
        }
        text
    }

    fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let mut records = vec![self.columns.clone()];
        records.extend(self.rows.iter().map(|row| row.iter().map(Cell::for_programs).collect()));
        for record in records {
            writer
                .write_record(&record)
                .expect("all records have the same length, and memory does not fail");
        }
        let bytes = writer.into_inner().expect("memory does not fail");
        String::from_utf8(bytes).expect("text in gives text out")
    }

    fn latex(&self) -> String {
        let escape = |text: &str| -> String {
            let character = |character: char| match character {
                '\\' => "\\textbackslash{}".to_owned(),
                '^' => "\\textasciicircum{}".to_owned(),
                '~' => "\\textasciitilde{}".to_owned(),
                '_' | '%' | '&' | '#' | '$' | '{' | '}' => format!("\\{character}"),
                other => other.to_string(),
            };
            text.chars().map(character).collect()
        };
        let alignment: String = (0..self.columns.len())
            .map(|column| if self.is_words(column) { 'l' } else { 'r' })
            .collect();
        let mut text = format!("\\begin{{tabular}}{{{alignment}}}\n\\hline\n");
        let mut line = |cells: Vec<String>| {
            text.push_str(&cells.join(" & "));
            text.push_str(" \\\\\n");
        };
        line(self.columns.iter().map(|column| escape(column)).collect());
        line(vec!["\\hline".to_owned()]);
        for row in &self.rows {
            line(row.iter().map(|cell| escape(&cell.for_people())).collect());
        }
        text = text.replace("\\hline \\\\\n", "\\hline\n");
        text.push_str("\\hline\n\\end{tabular}\n");
        text
    }
}

/// Indented JSON with a final newline.
pub fn pretty(value: &Value) -> String {
    format!("{value:#}\n")
}

/// Names and values that belong together: one JSON object, one row in CSV, two columns for people.
#[derive(Clone, Debug, Default)]
pub struct Record {
    fields: Vec<(String, Cell)>,
}

impl Record {
    /// Adds a field.
    pub fn with(mut self, name: &str, cell: impl Into<Cell>) -> Self {
        self.fields.push((name.to_owned(), cell.into()));
        self
    }

    /// The fields as a JSON object.
    pub fn json(&self) -> serde_json::Map<String, Value> {
        self.fields
            .iter()
            .map(|(name, cell)| (name.clone(), cell.json()))
            .collect()
    }

    /// For people: names and values below each other.
    pub fn text(&self) -> String {
        let width = self
            .fields
            .iter()
            .map(|(name, _)| name.chars().count())
            .max()
            .unwrap_or(0);
        let line = |(name, cell): &(String, Cell)| format!("{name:<width$}  {}\n", cell.for_people());
        self.fields.iter().map(line).collect()
    }

    /// The fields as the columns of a table with one row.
    pub fn table(&self) -> Table {
        let mut table = Table::new(self.fields.iter().map(|(name, _)| name.clone()));
        table.push(self.fields.iter().map(|(_, cell)| cell.clone()).collect());
        table
    }

    /// The record in a format.
    pub fn render(&self, format: Format) -> String {
        match format {
            Format::Text => self.text(),
            Format::Json => pretty(&Value::Object(self.json())),
            Format::Csv | Format::Latex => self.table().render(format),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let mut table = Table::new(["name", "x_1"]);
        table.push(vec!["a,b".into(), (1.0 / 3.0).into()]);
        table.push(vec!["c".into(), Cell::Empty]);
        table
    }

    #[test]
    fn numbers_survive_the_formats_for_programs() {
        let csv = table().render(Format::Csv);
        assert_eq!(csv, "name,x_1\n\"a,b\",0.3333333333333333\nc,\n");
        let json: Value = serde_json::from_str(&table().render(Format::Json)).unwrap();
        assert_eq!(json[0]["x_1"].as_f64(), Some(1.0 / 3.0));
        assert!(json[1]["x_1"].is_null());
    }

    #[test]
    fn people_get_columns_and_short_numbers() {
        assert_eq!(
            table().render(Format::Text),
            "name           x_1\na,b   0.3333333333\nc                -\n"
        );
        assert_eq!(
            table().render(Format::Latex),
            "\\begin{tabular}{lr}\n\\hline\nname & x\\_1 \\\\\n\\hline\na,b & 0.3333333333 \\\\\nc & - \\\\\n\\hline\n\\end{tabular}\n"
        );
        assert!(
            Table::new(["mu/lambda^2"])
                .render(Format::Latex)
                .contains("lambda\\textasciicircum{}2")
        );
        for (number, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (0.25, "0.25"),
            (1.0, "1"),
            (123456.75, "123456.75"),
            (1e-7, "1e-7"),
            (2.5e-12, "2.5e-12"),
            (1e10, "1e10"),
            (1234567890.0, "1234567890"),
            (-0.000123, "-0.000123"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(short(number), text);
        }
    }
}
