//! What was tuned, for people and programs, and what certificates say of it.

use super::{Condition, Plan, Row, Tuned};
use crate::table::{Cell, Format, Table, WIDTH, pretty};
use eigenring_certify::{Check, Requirement, Statement, Status};
use serde_json::{Map, Value, json};

impl Plan {
    /// What a certificate says of C1 and of each condition.
    pub fn verdicts(&self, checks: &[Check]) -> Vec<(&'static str, Status)> {
        let others = self.conditions.iter().filter(|condition| **condition != Condition::C1);
        let all = std::iter::once(&Condition::C1).chain(others);
        all.map(|condition| (condition.name(), verdict(*condition, checks)))
            .collect()
    }

    /// Whether each condition is proven of each result.
    pub fn holds(&self, tuned: &Tuned) -> bool {
        tuned.rows.iter().all(|row| {
            let verdicts = self
                .conditions
                .iter()
                .map(|condition| verdict(*condition, &row.certificate.checks));
            verdicts.into_iter().all(|status| status == Status::Proven)
        })
    }

    /// The rows as a table.
    pub fn table(&self, tuned: &Tuned) -> Table {
        let Some(first) = tuned.rows.first() else {
            return Table::default();
        };
        let mut columns: Vec<String> = ["valence", "before", "after"].map(str::to_owned).to_vec();
        columns.extend(first.parameters.iter().map(|(name, _)| name.clone()));
        columns.push("active".to_owned());
        let verdicts = self.verdicts(&first.certificate.checks);
        columns.extend(verdicts.iter().map(|(name, _)| format!("verify_{name}")));
        columns.push("evaluations".to_owned());
        let mut table = Table::new(columns);
        for row in &tuned.rows {
            let mut cells: Vec<Cell> = vec![row.valence.into(), row.before.into(), row.after.into()];
            cells.extend(row.parameters.iter().map(|(_, value)| Cell::from(*value)));
            cells.push(row.active.join("; ").into());
            let verdicts = self.verdicts(&row.certificate.checks);
            cells.extend(verdicts.into_iter().map(|(_, status)| Cell::from(status.to_string())));
            cells.push(row.evaluations.into());
            table.push(cells);
        }
        table
    }

    /// The rows for people, with what they are.
    pub fn text_of(&self, tuned: &Tuned) -> String {
        let conditions: Vec<&str> = self.conditions.iter().map(|condition| condition.name()).collect();
        let subject = match conditions.is_empty() {
            true => String::new(),
            false => format!(" subject to {}", conditions.join(", ")),
        };
        let mut table = self.table(tuned).without("evaluations");
        if tuned.rows.iter().all(|row| row.active.is_empty()) {
            table = table.without("active");
        }
        format!("{}: {}{subject}\n\n{}", tuned.scheme, self.goal, table.fitted(WIDTH))
    }

    /// The rows for programs.
    pub fn json(&self, tuned: &Tuned) -> Map<String, Value> {
        let row = |row: &Row| {
            let verdicts = self.verdicts(&row.certificate.checks).into_iter();
            let verdicts: Map<String, Value> = verdicts
                .map(|(name, status)| (name.to_owned(), json!(status)))
                .collect();
            let parameters: Map<String, Value> = row.parameters.iter().map(|(n, v)| (n.clone(), json!(v))).collect();
            json!({
                "valence": row.valence,
                "before": row.before,
                "after": row.after,
                "parameters": parameters,
                "active": row.active,
                "evaluations": row.evaluations,
                "verify": verdicts,
            })
        };
        let mut object = Map::new();
        object.insert("scheme".to_owned(), json!(tuned.scheme));
        object.insert("minimise".to_owned(), json!(self.goal.to_string()));
        let conditions: Vec<&str> = self.conditions.iter().map(|condition| condition.name()).collect();
        object.insert("subject_to".to_owned(), json!(conditions));
        object.insert("seed".to_owned(), json!(self.seed));
        object.insert("rows".to_owned(), tuned.rows.iter().map(row).collect());
        object
    }

    /// The rows in a format.
    pub fn render(&self, tuned: &Tuned, format: Format) -> String {
        match format {
            Format::Text => self.text_of(tuned),
            Format::Json => pretty(&Value::Object(self.json(tuned))),
            format => self.table(tuned).render(format),
        }
    }
}

/// What a certificate says of a condition.
fn verdict(condition: Condition, checks: &[Check]) -> Status {
    match condition {
        Condition::Hull => Requirement::Hull.verdict(checks).1,
        Condition::Bounded => Requirement::Bounded.verdict(checks).1,
        Condition::C1 => Requirement::C1.verdict(checks).1,
        Condition::Order => {
            let statements = [Statement::Dominant, Statement::Subdominant, Statement::Strict].into_iter();
            let status = |statement| {
                checks
                    .iter()
                    .find(|check| check.name == statement)
                    .map(|check| check.status)
            };
            let statuses = statements.map(|statement| status(statement).unwrap_or(Status::Undecided));
            statuses.fold(Status::Proven, Status::and)
        }
    }
}
