//! Values of a scheme file, each read with its place for what is to be said of it.

use super::{Node, Reader, file_error};
use crate::user::formula::{self, Formula, Scope};
use crate::{Error, Number, did_you_mean};
use toml::de::{DeTable, DeValue};

/// "line 3, column 5: ".
pub(super) fn place(text: &str, offset: usize) -> String {
    let before = text.get(..offset).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    format!("line {line}, column {column}: ")
}

impl Reader<'_> {
    pub(super) fn error(&self, node: &Node, message: impl std::fmt::Display) -> Error {
        file_error(format!("{}{message}", place(self.text, node.span().start)))
    }

    pub(super) fn expected<T>(&self, node: &Node, what: &str, accepted: &str) -> Result<T, Error> {
        let found = node.get_ref().type_str();
        Err(self.error(node, format!("{what} is a {found}: accepted is {accepted}")))
    }

    pub(super) fn table<'n, 'i>(
        &self,
        node: &'n Node<'i>,
        what: &str,
        keys: &[&str],
    ) -> Result<&'n DeTable<'i>, Error> {
        match node.get_ref().as_table() {
            Some(table) => {
                self.known(table, what, keys)?;
                Ok(table)
            }
            None => self.expected(node, what, "a table"),
        }
    }

    /// Refuses keys that mean nothing.
    pub(super) fn known(&self, table: &DeTable, what: &str, keys: &[&str]) -> Result<(), Error> {
        match table.keys().find(|key| !keys.contains(&key.get_ref().as_ref())) {
            None => Ok(()),
            Some(key) => Err(file_error(format!(
                "{}unknown key '{}' of {what}{}: accepted are {}",
                place(self.text, key.span().start),
                key.get_ref(),
                did_you_mean(key.get_ref(), keys.iter().copied()),
                keys.join(", ")
            ))),
        }
    }

    pub(super) fn array<'n, 'i>(
        &self,
        node: &'n Node<'i>,
        what: &str,
        accepted: &str,
    ) -> Result<Vec<&'n Node<'i>>, Error> {
        match node.get_ref().as_array() {
            Some(array) => Ok(array.iter().collect()),
            None => self.expected(node, what, accepted),
        }
    }

    pub(super) fn string<'n>(&self, node: &'n Node, what: &str, accepted: &str) -> Result<&'n str, Error> {
        match node.get_ref().as_str() {
            Some(text) => Ok(text),
            None => self.expected(node, what, accepted),
        }
    }

    /// An integer from `least` to `most`.
    pub(super) fn integer(&self, node: &Node, what: &str, least: i64, most: i64) -> Result<i64, Error> {
        let accepted = format!("an integer from {least} to {most}");
        let Some(integer) = node.get_ref().as_integer() else {
            return self.expected(node, what, &accepted);
        };
        let value = i64::from_str_radix(integer.as_str(), integer.radix()).ok();
        match value.filter(|value| (least..=most).contains(value)) {
            Some(value) => Ok(value),
            None => Err(self.error(
                node,
                format!("{what} = {integer} is out of range: accepted is {accepted}"),
            )),
        }
    }

    /// A number as it is written, with or without quotes.
    pub(super) fn number(&self, node: &Node, what: &str) -> Result<Number, Error> {
        let text = match node.get_ref() {
            DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str(),
            DeValue::Float(float) => float.as_str(),
            DeValue::String(text) => text,
            _ => return self.expected(node, what, "a decimal, or a fraction in quotes such as \"7/12\""),
        };
        text.parse()
            .map_err(|error| self.error(node, format!("{what}: {error}")))
    }

    /// A number, or in quotes a formula, which may name `k` if `sector` says so.
    pub(super) fn formula(&self, node: &Node, what: &str, sector: bool) -> Result<Formula, Error> {
        let DeValue::String(text) = node.get_ref() else {
            const ACCEPTED: &str = "a decimal, or a fraction or formula in quotes such as \"7/12\" or \"1/(4*n)\"";
            return match node.get_ref() {
                DeValue::Integer(_) | DeValue::Float(_) => {
                    let number = self.number(node, what)?;
                    Ok(Formula::number(number.rational().clone(), node.span().start))
                }
                _ => self.expected(node, what, ACCEPTED),
            };
        };
        if let Ok(number) = text.parse::<Number>() {
            return Ok(Formula::number(number.rational().clone(), node.span().start));
        }
        let span = node.span();
        // without escapes the text stands in the file as it is
        let written = self.text.get(span.clone()).and_then(|raw| raw.find(text.as_ref()));
        let mut formula = Formula {
            start: span.start + written.unwrap_or(0),
            literal: written.is_some(),
            ..Formula::number(Default::default(), 0)
        };
        let scope = Scope {
            sector,
            ..self.scope.clone()
        };
        match formula::parse(text, &scope) {
            Ok(root) => formula.root = root,
            Err(fault) => {
                let place = place(self.text, formula.place(&fault));
                return Err(file_error(format!("{place}{what}: {}", fault.message)));
            }
        }
        Ok(formula)
    }

    pub(super) fn get<'n, 'i>(&self, node: &Node, table: &'n DeTable<'i>, key: &str) -> Result<&'n Node<'i>, Error> {
        table
            .get(key)
            .ok_or_else(|| self.error(node, format!("{key} is missing")))
    }
}
