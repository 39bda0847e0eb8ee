//! Tables of numbers and words, in the formats that people and programs read.

mod html;
mod latex;
mod text;

use serde_json::Value;

/// The width of a text for people.
pub const WIDTH: usize = 100;

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

/// Significant digits of numbers for people.
const DIGITS: usize = 10;

/// Ten significant digits without trailing zeros; exponents only where they are shorter.
pub fn short(number: f64) -> String {
    rounded(number, DIGITS)
}

/// So many significant digits without trailing zeros.
fn rounded(number: f64, digits: usize) -> String {
    if number == 0.0 || !number.is_finite() {
        return format!("{}", number + 0.0);
    }
    let exponent = number.abs().log10().floor() as i32;
    if !(-5..10).contains(&exponent) {
        let text = format!("{number:.*e}", digits - 1);
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let mantissa = match mantissa.contains('.') {
            true => mantissa.trim_end_matches('0').trim_end_matches('.'),
            false => mantissa,
        };
        return format!("{mantissa}e{exponent}");
    }
    let text = format!("{number:.*}", (digits as i32 - 1 - exponent).max(0) as usize);
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

    /// Adds a column, whose cells are functions of the row's index.
    pub fn extend(&mut self, column: &str, cell: impl Fn(usize) -> Cell) {
        self.columns.push(column.to_owned());
        for (index, row) in self.rows.iter_mut().enumerate() {
            row.push(cell(index));
        }
    }

    /// Adds a column, whose cells are functions of the cells before.
    pub fn extend_by(&mut self, column: &str, cell: impl Fn(&[Cell]) -> Cell) {
        self.columns.push(column.to_owned());
        for row in &mut self.rows {
            row.push(cell(row));
        }
    }

    /// The table with other headings for people, which carry units; names that programs read are kept.
    pub fn headed(mut self, format: Format, headings: &[(&str, &str)]) -> Self {
        if matches!(format, Format::Text | Format::Latex) {
            for column in &mut self.columns {
                if let Some((_, heading)) = headings.iter().find(|(name, _)| name == column) {
                    *column = (*heading).to_owned();
                }
            }
        }
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
            Format::Text => text::whole(self),
            Format::Json => pretty(&self.json()),
            Format::Csv => self.csv(),
            Format::Latex => latex::render(self),
        }
    }

    /// The table for people, in lines of at most `width` characters: numbers get fewer digits, words of a
    /// last column go below their rows, and last columns are left out where that is not enough.
    pub fn fitted(&self, width: usize) -> String {
        text::fitted(self, width)
    }

    /// The table without a column.
    pub fn without(mut self, column: &str) -> Self {
        if let Some(index) = self.columns.iter().position(|name| name == column) {
            self.columns.remove(index);
            self.rows.iter_mut().for_each(|row| drop(row.remove(index)));
        }
        self
    }

    /// The names of the columns.
    pub fn columns(&self) -> &[String] {
        &self.columns
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
            "\\begin{tabular}{lr}\n\\hline\nname & x 1 \\\\\n\\hline\na,b & 0.3333333333 \\\\\nc & -- \\\\\n\\hline\n\\end{tabular}\n"
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

    #[test]
    fn mathematics_in_latex() {
        let mut table = Table::new(["mu/lambda^2", "K_m", "f2", "xi12", "a_b"]);
        table.push(vec![
            (-0.5).into(),
            1.5e-7.into(),
            0.25.into(),
            1.0.into(),
            "x_y".into(),
        ]);
        let latex = table.render(Format::Latex);
        assert!(
            latex.contains("$\\mu/\\lambda^2$ & $K_m$ & $f_2$ & $\\xi_{12}$ & a b \\\\"),
            "{latex}"
        );
        assert!(
            latex.contains("$-0.5$ & $1.5 \\times 10^{-7}$ & 0.25 & 1 & x\\_y \\\\"),
            "{latex}"
        );
    }

    #[test]
    fn wide_tables_are_split_for_pages_and_narrowed_for_people() {
        let columns: Vec<String> = ["valence".to_owned()]
            .into_iter()
            .chain((1..=17).map(|i| format!("C{i}")))
            .collect();
        let mut wide = Table::new(columns);
        wide.push(
            std::iter::once(5.into())
                .chain((0..17).map(|i| (1.0 / f64::from(i + 3)).into()))
                .collect(),
        );
        let latex = wide.render(Format::Latex);
        assert!(
            latex.matches("\\begin{tabular}").count() >= 3 && latex.matches("$N$").count() >= 3,
            "{latex}"
        );
        // without the words of LaTeX no line is wider than a page
        assert!(
            latex
                .lines()
                .filter(|line| line.contains('&'))
                .all(|line| line.len() < 130),
            "{latex}"
        );
        assert_eq!(latex.matches("0.3333333333").count(), 1);
        let text = wide.fitted(WIDTH);
        assert!(text.lines().all(|line| line.chars().count() <= WIDTH), "{text}");
        assert!(
            text.contains("left out for want of room: C") && text.contains("--wide"),
            "{text}"
        );
        let mut remarks = Table::new(["check", "x", "remark"]);
        let remark = "words ".repeat(30);
        remarks.push(vec!["a".into(), (1.0 / 3.0).into(), remark.trim().into()]);
        remarks.push(vec!["b".into(), 2.0.into(), "".into()]);
        let text = remarks.fitted(WIDTH);
        assert!(
            text.starts_with("check             x\na      0.3333333333\n    words words"),
            "{text}"
        );
        assert!(
            text.ends_with("\nb                 2\n") && text.matches("words").count() == 30,
            "{text}"
        );
    }
}
