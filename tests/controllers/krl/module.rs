//! The two files of a module: `.src` with routines, `.dat` with data.

use super::value::{TYPES, Value, name, place, value};
use super::{Controller, Routine};
use crate::controllers::Text;
use crate::controllers::scan::Scan;

/// Names that modules must not have: those of the BAS package, and words of the language.
const TAKEN: [&str; 25] = [
    "BAS", "CELL", "SPS", "IR_STOPM", "HOME", "TOOL", "BASE", "FRAMES", "INITMOV", "MAIN", "PTP", "LIN",
    "CIRC", "DEF", "DEFDAT", "END", "ENDDAT", "WAIT", "HALT", "IF", "FOR", "LOOP", "INT", "REAL", "FRAME",
];

/// The lines of a module that say something, without comments; folds are balanced.
fn lines<'a>(text: &Text<'a>) -> Result<Vec<Scan<'a>>, String> {
    let mut folds: Vec<&str> = Vec::new();
    let mut lines = Vec::new();
    for (index, line) in text.text.lines().enumerate() {
        let scan = Scan::of(text.path, index + 1, line);
        let trimmed = line.trim();
        if trimmed.len() > 250 {
            return scan.fail("a line of more than 250 characters");
        }
        if let Some(name) = trimmed.strip_prefix(";FOLD") {
            folds.push(name.trim());
        } else if let Some(name) = trimmed.strip_prefix(";ENDFOLD") {
            let name = name.trim().trim_start_matches('(').trim_end_matches(')');
            if !folds.pop().is_some_and(|open| open.starts_with(name)) {
                return scan.fail("no such fold is open");
            }
        }
        let code = line.split(';').next().unwrap_or(line).trim();
        if !code.is_empty() {
            lines.push(Scan::of(text.path, index + 1, code));
        }
    }
    match folds.last() {
        Some(open) => {
            Err(format!("{}:{}: the fold {open} is not closed", text.path, text.text.lines().count()))
        }
        None => Ok(lines),
    }
}

/// The name of a module, which must be its file's.
fn module(scan: &mut Scan, text: &Text) -> Result<String, String> {
    let from = scan.clone();
    let module = name(scan)?;
    if module != text.stem.to_uppercase() {
        return from.fail(format!("the file is called {}", text.stem));
    }
    if TAKEN.contains(&module.as_str()) {
        from.fail("a name that the controller uses itself")
    } else {
        Ok(module)
    }
}

impl<'a> Controller<'a> {
    /// Files the routines of a `.src`.
    pub(super) fn source(&mut self, text: &Text<'a>) -> Result<(), String> {
        let mut open: Option<String> = None;
        let (mut is_first, mut file) = (true, String::new());
        for mut line in lines(text)? {
            if line.rest().starts_with('&') && is_first {
                continue;
            }
            let whole = line.clone();
            if line.take("GLOBAL") && !line.clone().take("DEF") {
                line = whole.clone();
            }
            match &open {
                None if line.take("DEF") => {
                    let routine = if is_first { module(&mut line, text)? } else { name(&mut line)? };
                    line.need_all(&["(", ")"])?;
                    line.end()?;
                    if is_first {
                        file = routine.clone();
                    }
                    is_first = false;
                    let empty = Routine { module: file.clone(), lines: Vec::new() };
                    if self.routines.insert(routine.clone(), empty).is_some() {
                        return line.fail("a second DEF of this name");
                    }
                    open = Some(routine);
                }
                None => return line.fail("outside DEF and END"),
                Some(_) if line.take("END") => {
                    line.end()?;
                    open = None;
                }
                Some(name) => {
                    self.routines.entry(name.clone()).and_modify(|routine| routine.lines.push(whole));
                }
            }
        }
        match (is_first, open) {
            (false, None) => Ok(()),
            _ => Err(format!("{}:{}: DEF or END is missing", text.path, text.text.lines().count())),
        }
    }

    /// Takes in the data of a `.dat`.
    pub(super) fn list(&mut self, text: &Text<'a>, texts: &[Text]) -> Result<(), String> {
        let mut lines = lines(text)?.into_iter().skip_while(|line| line.rest().starts_with('&'));
        let Some(mut first) = lines.next() else { return Err(format!("{}:1: no DEFDAT", text.path)) };
        first.need("DEFDAT")?;
        let module = module(&mut first, text)?;
        let is_public = first.take("PUBLIC");
        first.end()?;
        let is_system = module == "$CONFIG";
        if !is_system
            && !texts.iter().any(|other| other.ending == "src" && other.stem.eq_ignore_ascii_case(text.stem))
        {
            return first.fail("no .src of this name");
        }
        let mut is_ended = false;
        for mut line in lines {
            if is_ended {
                return line.fail("after ENDDAT");
            }
            if line.take("ENDDAT") {
                line.end()?;
                is_ended = true;
            } else if line.take("EXT") {
                name(&mut line)?;
                line.need("(")?;
                line.until(')')?;
                line.end()?;
            } else {
                let is_global = line.clone().take("DECL") && line.rest().to_uppercase().contains(" GLOBAL ");
                if is_global && !is_public {
                    return line.fail("global data need DEFDAT ... PUBLIC");
                }
                let owner = if is_global || is_system { String::new() } else { module.clone() };
                self.declaration(&mut line, &owner)?;
            }
        }
        if is_ended { Ok(()) } else { first.fail("ENDDAT is missing") }
    }

    /// `DECL GLOBAL TYPE NAME[n]=value`, or an assignment to data that the controller has.
    pub(super) fn declaration(&mut self, line: &mut Scan, owner: &str) -> Result<(), String> {
        let is_declared = line.take("DECL");
        line.take("GLOBAL");
        let is_typed = TYPES.iter().any(|known| line.take(known));
        let place = place(line)?;
        let is_stored =
            ["TOOL_DATA[", "BASE_DATA[", "LOAD_DATA["].iter().any(|start| place.starts_with(start));
        if is_typed == is_stored || (is_declared && !is_typed) {
            return line.fail("neither a declaration of a known type nor data of the controller");
        }
        let owner = if is_stored { "" } else { owner };
        let value = if line.take("=") { value(line)? } else { Value::Word("unset".to_owned()) };
        line.end()?;
        let old = self.data.insert((owner.to_owned(), place), value);
        if old.is_some() && !is_stored { line.fail("declared twice") } else { Ok(()) }
    }
}
