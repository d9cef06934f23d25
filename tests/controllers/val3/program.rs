//! A program of a VAL3 application, and the variables that its code names.

use super::Controller;
use super::data::{self, Row};
use crate::controllers::scan::Scan;
use crate::controllers::xml::Element;
use crate::controllers::{Text, is_identifier};
use std::collections::BTreeMap;

/// A program: its parameters, local variables and statements.
#[derive(Clone)]
pub(super) struct Program<'a> {
    pub(super) parameters: Vec<String>,
    pub(super) locals: Vec<(String, usize)>,
    pub(super) statements: Vec<Scan<'a>>,
}

pub(super) fn file_name(text: &Text) -> String {
    format!("{}.{}", text.stem, text.ending)
}

pub(super) fn program<'a>(text: &Text<'a>, root: &'a Element) -> Result<Program<'a>, String> {
    data::is(text, root, "Programs", "http://www.staubli.com/robotics/VAL3/Program/2")?;
    let [element] = &root.children[..] else { return data::fail(text, root, "one <Program> is expected") };
    if element.name != "Program"
        || element.attribute("name") != Some(text.stem)
        || !is_identifier(text.stem, 15)
    {
        return data::fail(text, element, "a program is called as its file, by at most 15 characters");
    }
    let mut program = Program { parameters: Vec::new(), locals: Vec::new(), statements: Vec::new() };
    let mut has_code = false;
    for part in &element.children {
        match part.name.as_str() {
            "Parameters" | "Locals" => {
                for child in &part.children {
                    let name = child.attribute("name").unwrap_or_default();
                    let size = child.attribute("size").unwrap_or("1").parse().unwrap_or(0);
                    if !is_identifier(name, 15) || child.attribute("type") != Some("num") || size == 0 {
                        return data::fail(text, child, "a num with a name and a size is expected");
                    }
                    match child.name.as_str() {
                        "Parameter" => program.parameters.push(name.to_owned()),
                        "Local" => program.locals.push((name.to_owned(), size)),
                        _ => return data::fail(text, child, "not known here"),
                    }
                }
            }
            "Code" if !has_code => {
                has_code = true;
                for (index, line) in part.text.lines().enumerate() {
                    let code = line.split("//").next().unwrap_or(line).trim();
                    if !code.is_empty() {
                        program.statements.push(Scan::of(text.path, part.line + index, code));
                    }
                }
            }
            _ => return data::fail(text, part, "not known here, or twice"),
        }
    }
    let is_whole = program.statements.len() > 1
        && program.statements.remove(0).rest() == "begin"
        && program.statements.pop().is_some_and(|last| last.rest() == "end");
    if is_whole { Ok(program) } else { data::fail(text, element, "code stands between begin and end") }
}

impl Controller<'_> {
    pub(super) fn set(&mut self, scan: &Scan, name: &str, index: usize, value: f64) -> Result<(), String> {
        let local = self.locals.last_mut().and_then(|locals| locals.get_mut(name));
        match (local.and_then(|values| values.get_mut(index)), self.data.get_mut(name)) {
            (Some(place), _) => *place = value,
            (None, Some(datum)) if datum.kind == "num" && index < datum.rows.len() => {
                datum.rows[index].numbers.insert("value", value);
            }
            _ => return scan.fail(format!("no num {name}[{index}]")),
        }
        Ok(())
    }

    /// A sum of numbers and num variables.
    pub(super) fn number(&self, scan: &mut Scan) -> Result<f64, String> {
        let mut sum = self.term(scan)?;
        loop {
            let sign = if scan.take("+") {
                1.0
            } else if scan.take("-") {
                -1.0
            } else {
                return Ok(sum);
            };
            sum += sign * self.term(scan)?;
        }
    }

    pub(super) fn term(&self, scan: &mut Scan) -> Result<f64, String> {
        let from = scan.clone();
        let Ok(name) = scan.word() else { return scan.number() };
        let index = self.index(scan)?;
        let local =
            self.locals.last().and_then(|locals| locals.get(name)).and_then(|values| values.get(index));
        let global = || {
            self.data.get(name).filter(|datum| datum.kind == "num").and_then(|datum| datum.rows.get(index))
        };
        match local.copied().or_else(|| global().map(|row| row.number("value"))) {
            Some(value) => Ok(value),
            None => from.fail(format!("no num {name}[{index}]")),
        }
    }

    pub(super) fn index(&self, scan: &mut Scan) -> Result<usize, String> {
        if !scan.take("[") {
            return Ok(0);
        }
        let index = self.number(scan)?;
        scan.need("]")?;
        if index.fract() == 0.0 && index >= 0.0 { Ok(index as usize) } else { scan.fail("no index") }
    }

    /// The type of a datum of one of these types, its name and its place.
    pub(super) fn place(&self, scan: &mut Scan, kinds: &[&str]) -> Result<(String, usize), String> {
        let from = scan.clone();
        let name = scan.word()?;
        let index = self.index(scan)?;
        match self.data.get(name) {
            Some(datum) if kinds.contains(&datum.kind.as_str()) && index < datum.rows.len() => {
                Ok((name.to_owned(), index))
            }
            _ => from.fail(format!("no {} {name}[{index}]", kinds.join(" or "))),
        }
    }

    pub(super) fn row(&self, place: &(String, usize)) -> &Row {
        &self.data[&place.0].rows[place.1]
    }
}
