//! ABB's RAPID. Orientations are quaternions, scalar first, whose sum of squares is 1 (RAPID reference manual).

mod argument;
mod memory;
mod module;

use super::scan::Scan;
use super::{Blend, ControllerProgram, File, Frame, Motion, Target, Text, checked, identity, within, xml};
use memory::last;
use module::{Data, Module, Value, frame, has_type, module, name, numbers, value};
use std::collections::BTreeMap;

struct Controller<'a> {
    modules: Vec<Module<'a>>,
    /// Which modules are in memory, and by which text those were loaded that were loaded at run time.
    loaded: BTreeMap<usize, Option<String>>,
    used: Vec<usize>,
    running: Vec<String>,
    program: ControllerProgram,
}

/// Reads a package: a `.pgf` with its modules, or one module with `main`; others are loaded at run time.
pub(crate) fn rapid(files: &[File]) -> Result<ControllerProgram, String> {
    let texts = checked(files, &["mod", "modx", "sys", "sysx", "pgf"])?;
    let program = ControllerProgram::of("", &texts);
    let (mut modules, mut listed) = (Vec::new(), Vec::new());
    let mut loaded = BTreeMap::new();
    for text in &texts {
        if text.ending == "pgf" {
            listed.push((text.path, listing(text)?));
        } else {
            if text.ending.starts_with("sys") {
                loaded.insert(modules.len(), None);
            }
            modules.push(module(text)?);
        }
    }
    let has_main = |module: &Module| module.procedures.contains_key("main");
    match &listed[..] {
        [] => loaded.extend(
            modules.iter().enumerate().filter(|(_, module)| has_main(module)).map(|(at, _)| (at, None)),
        ),
        [(path, names)] => {
            for name in names {
                let found = modules.iter().position(|module| last(module.path).eq_ignore_ascii_case(name));
                let Some(found) = found else {
                    return Err(format!("{path}:0: no file {name} in the package"));
                };
                loaded.insert(found, None);
            }
        }
        _ => return Err("two .pgf files".to_owned()),
    }
    let Some(main) = loaded.keys().copied().find(|&at| has_main(&modules[at])) else {
        return Err("no module that is loaded has PROC main".to_owned());
    };
    let used = loaded.keys().copied().collect();
    let mut controller = Controller { modules, loaded, used, running: Vec::new(), program };
    controller.program.name = controller.modules[main].name.clone();
    controller.ambiguous()?;
    controller.run(main, "main")?;
    if controller.program.is_blending() {
        return Err("the program ends within a corner zone".to_owned());
    }
    if let Some(module) = (0..controller.modules.len()).find(|at| !controller.used.contains(at)) {
        return Err(format!("{}:0: never loaded", controller.modules[module].path));
    }
    match controller.loaded.values().flatten().next() {
        Some(path) => Err(format!("{path} is never unloaded")),
        None => Ok(controller.program),
    }
}

/// The modules that a `.pgf` lists.
fn listing(text: &Text) -> Result<Vec<String>, String> {
    let root = xml::document(text.path, text.text)?;
    let fail = |what: &str| Err(format!("{}:{}: {what}", text.path, root.line));
    if root.name != "Program" || !root.attributes.is_empty() || root.children.is_empty() {
        return fail("a <Program> with its modules is expected");
    }
    if root.children.iter().any(|child| child.name != "Module" || !child.children.is_empty()) {
        return fail("only <Module> is known here");
    }
    Ok(root.children.iter().map(|child| child.text.trim().to_owned()).collect())
}

impl Controller<'_> {
    fn run(&mut self, module: usize, procedure: &str) -> Result<(), String> {
        if self.running.iter().any(|other| other == procedure) {
            return Err(format!("{procedure} calls itself"));
        }
        self.running.push(procedure.to_owned());
        for mut statement in self.modules[module].procedures[procedure].clone() {
            self.statement(&mut statement)?;
            statement.end()?;
        }
        self.running.pop();
        Ok(())
    }

    fn statement(&mut self, scan: &mut Scan) -> Result<(), String> {
        let from = scan.clone();
        if scan.take("%") {
            let called = scan.quoted('"')?.to_ascii_lowercase();
            scan.need("%")?;
            let (module, procedure) =
                called.split_once(':').map_or((None, called.as_str()), |(m, p)| (Some(m), p));
            let found = self.loaded.keys().copied().find(|&at| {
                let here = &self.modules[at];
                module.is_none_or(|module| module == here.name) && here.procedures.contains_key(procedure)
            });
            return match found {
                Some(at) => self.run(at, procedure),
                None => from.fail("no procedure of this name is loaded"),
            };
        }
        let word = name(scan)?;
        match word.as_str() {
            "moveabsj" | "movej" | "movel" | "movec" => return self.motion(scan, &word),
            "accset" => in_range(scan, [20.0, 10.0], 100.0)?,
            "velset" => in_range(scan, [1.0, 1.0], 20000.0)?,
            "confj" | "confl" | "singarea" => {
                scan.need("\\")?;
                let is_known = scan.take("Off") || scan.take(if word == "singarea" { "Wrist" } else { "On" });
                return if is_known { Ok(()) } else { scan.fail("no such switch") };
            }
            "pathacclim" => {
                for (at, limit) in ["AccMax", "DecelMax"].iter().enumerate() {
                    if at > 0 {
                        scan.need(",")?;
                    }
                    if !scan.take("FALSE") {
                        scan.need_all(&["TRUE", "\\", limit, ":="])?;
                        if scan.number()? < 0.1 {
                            return from.fail("less than 0.1 m/s2");
                        }
                    }
                }
            }
            "load" | "unload" => return self.memory(scan, word == "load"),
            "waittime" => {
                if scan.take("\\") {
                    scan.need_all(&["InPos", ","])?;
                }
                let seconds = scan.number()?;
                if seconds < 0.0 || self.program.is_blending() {
                    return from.fail("a wait below zero, or within a corner zone");
                }
                self.program.wait_at_end_s += seconds;
            }
            "stop" => {}
            "tpwrite" => drop(scan.quoted('"')?),
            "setdo" => {
                name(scan)?;
                scan.need(",")?;
                scan.integer(0, 1)?;
                self.program.hooks.push(from.rest().to_owned());
            }
            _ => {
                let loaded = self.loaded.keys().copied();
                if let Some(at) =
                    loaded.into_iter().find(|&at| self.modules[at].procedures.contains_key(&word))
                {
                    return self.run(at, &word);
                }
                if !scan.is_done() {
                    value(scan)?;
                    while scan.take(",") {
                        value(scan)?;
                    }
                }
                self.program.hooks.push(from.rest().to_owned());
            }
        }
        Ok(())
    }

    /// A value of this type, written out or by name, with the names within it resolved.
    fn value_of(&self, scan: &mut Scan, kind: &str) -> Result<Value, String> {
        let from = scan.clone();
        let written = value(scan)?;
        let named = if let Value::Name(name) = &written { self.data(name) } else { None };
        match (named, &written) {
            (Some((found, value)), _) if found == kind => Ok(value),
            (_, Value::Name(name)) => from.fail(format!("no {kind} {name} is declared")),
            _ => {
                let value = self.resolved(written);
                if has_type(kind, &value) { Ok(value) } else { from.fail(format!("no value of a {kind}")) }
            }
        }
    }

    fn data(&self, name: &str) -> Option<Data> {
        self.loaded.keys().find_map(|&at| self.modules[at].data.get(name)).cloned()
    }

    fn resolved(&self, value: Value) -> Value {
        match value {
            Value::List(list) => Value::List(list.into_iter().map(|item| self.resolved(item)).collect()),
            Value::Name(name) => self.data(&name).map_or(Value::Name(name), |(_, value)| value),
            other => other,
        }
    }

    fn motion(&mut self, scan: &mut Scan, word: &str) -> Result<(), String> {
        let from = scan.clone();
        let kind = if word == "moveabsj" { "jointtarget" } else { "robtarget" };
        let mut end = self.value_of(scan, kind)?;
        let mut motion = if word == "movej" { Motion::Free } else { Motion::Line };
        if word == "movec" {
            let Some((via, _)) = frame(&end) else { return from.fail("no robtarget") };
            motion = Motion::Arc { via };
            scan.need(",")?;
            end = self.value_of(scan, kind)?;
        }
        while scan.take("\\") {
            match word {
                "moveabsj" if scan.take("NoEOffs") => {}
                _ if scan.take("ID") => scan.need(":=").and_then(|()| scan.integer(0, 2000)).map(drop)?,
                _ => return scan.fail("no such switch"),
            }
        }
        scan.need(",")?;
        let mut speed = self.speed(scan)?;
        if scan.take("\\") {
            scan.need_all(&["V", ":="])?;
            speed = scan.number()?;
        }
        scan.need(",")?;
        let blend = self.zone(scan)?;
        scan.need(",")?;
        let (tool, mass) = self.tool(scan)?;
        let base = if scan.take("\\") {
            scan.need_all(&["WObj", ":="]).and_then(|()| self.base(scan))?
        } else {
            identity()
        };
        self.program.load_kg = mass.or(self.program.load_kg);
        let Value::List(parts) = &end else { return from.fail("no target") };
        if word == "moveabsj" {
            let Some(axes) = parts.first().and_then(numbers::<6>) else { return from.fail("no axes") };
            self.program.joints(axes, Some(speed), blend);
            return Ok(());
        }
        let (Some((position, rotation)), Some(conf)) = (frame(&end), parts.get(2).and_then(numbers::<4>))
        else {
            return from.fail("no robtarget");
        };
        if conf.iter().any(|quarter| quarter.fract() != 0.0) || !(0.0..=7.0).contains(&conf[3]) {
            return from.fail("confdata are whole, cfx from 0 to 7");
        }
        let configuration = Some(format!("[{},{},{},{}]", conf[0], conf[1], conf[2], conf[3]));
        let target = Target {
            motion,
            position,
            rotation,
            speed: Some(speed),
            blend,
            configuration,
            wait_before_s: 0.0,
        };
        self.program.cartesian(base, tool, target).or_else(|what| from.fail(what))
    }
}

fn in_range(scan: &mut Scan, least: [f64; 2], most: f64) -> Result<(), String> {
    let from = scan.clone();
    let values = scan.numbers::<2>()?;
    let is_right = values.iter().zip(least).all(|(value, least)| (least..=most).contains(value));
    if is_right { Ok(()) } else { from.fail("out of range") }
}
