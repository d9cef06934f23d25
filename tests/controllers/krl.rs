//! KUKA's KRL. A frame's A, B, C are angles about Z, the new Y and the new X: `Rz(A) Ry(B) Rx(C)`
//! (RoboDK-API, `KUKA_2_Pose.m`).

mod module;
mod value;

use super::scan::Scan;
use super::{Blend, ControllerProgram, File, Frame, Motion, Target, checked, identity, main_of};
use std::collections::BTreeMap;
use value::{EXTERNAL, Value, components, frame, load, place, pose, value};

/// Settings that do not move a target, and their ranges.
const SETTINGS: [(&str, f64, f64); 11] = [
    ("$ADVANCE", 0.0, 5.0),
    ("$VEL.ORI1", 0.001, 1000.0),
    ("$VEL.ORI2", 0.001, 1000.0),
    ("$ACC.CP", 0.001, 20.0),
    ("$ACC.ORI1", 0.001, 10000.0),
    ("$ACC.ORI2", 0.001, 10000.0),
    ("$APO.CORI", 0.0, 180.0),
    ("$APO.CVEL", 0.0, 100.0),
    ("$APO.CPTP", 0.0, 100.0),
    ("$APO.CDIS", 0.0, 1000.0),
    ("$VEL.CP", 0.000001, 3.0),
];

/// A DEF with its statements.
struct Routine<'a> {
    module: String,
    lines: Vec<Scan<'a>>,
}

struct Controller<'a> {
    routines: BTreeMap<String, Routine<'a>>,
    /// By module (empty for global data) and name, both in upper case.
    data: BTreeMap<(String, String), Value>,
    base: Option<Frame>,
    tool: Option<Frame>,
    /// By its name in `SETTINGS`.
    settings: BTreeMap<&'static str, f64>,
    running: Vec<String>,
    program: ControllerProgram,
}

/// Reads a package of `.src` and `.dat` files.
pub(crate) fn krl(files: &[File]) -> Result<ControllerProgram, String> {
    let texts = checked(files, &["src", "dat"])?;
    let mut controller = Controller {
        routines: BTreeMap::new(),
        data: BTreeMap::new(),
        base: None,
        tool: None,
        settings: BTreeMap::new(),
        running: Vec::new(),
        program: ControllerProgram::of("", &texts),
    };
    for text in &texts {
        if text.ending == "src" { controller.source(text)? } else { controller.list(text, &texts)? }
    }
    let names: Vec<String> = controller.routines.keys().cloned().collect();
    let mut called = Vec::new();
    for line in controller.routines.values().flat_map(|routine| &routine.lines) {
        if let Ok(word) = line.clone().word() {
            called.push(word.to_uppercase());
        }
    }
    let main = main_of(&names, &called, "DEF")?;
    controller.program.name = main.clone();
    controller.run(&main)?;
    controller.program.stop_last();
    Ok(controller.program)
}

impl<'a> Controller<'a> {
    /// Runs a routine.
    fn run(&mut self, routine: &str) -> Result<(), String> {
        if self.running.iter().any(|other| other == routine) {
            return Err(format!("{routine} calls itself"));
        }
        let Some(Routine { module, lines }) = self.routines.get(routine) else {
            return Err(format!("no {routine}"));
        };
        let (module, lines) = (module.clone(), lines.clone());
        self.running.push(routine.to_owned());
        let mut may_declare = true;
        for mut line in lines {
            let is_declaration =
                ["DECL", "INT", "REAL", "FRAME", "BOOL"].iter().any(|word| line.clone().take(word));
            if is_declaration && may_declare {
                self.declaration(&mut line, &module)?;
                continue;
            }
            may_declare = false;
            self.statement(&mut line, &module)?;
            line.end()?;
        }
        self.running.pop();
        Ok(())
    }

    fn statement(&mut self, line: &mut Scan, module: &str) -> Result<(), String> {
        let from = line.clone();
        if line.take("PTP") {
            if line.take("$AXIS_ACT") || line.take("$POS_ACT") {
                return Ok(());
            }
            let target = self.value_at(line, module)?;
            let blend = self.blend(line, "C_PTP", "$APO.CPTP", Blend::Percent)?;
            let axes = components(&target, ["A1", "A2", "A3", "A4", "A5", "A6"], &EXTERNAL);
            if let Ok(axes) = axes {
                self.program.joints(axes, None, blend);
                return Ok(());
            }
            return self.cartesian(&from, Motion::Free, &target, blend);
        }
        if line.take("LIN") || line.take("CIRC") {
            let mut motion = Motion::Line;
            let mut target = self.value_at(line, module)?;
            if from.clone().take("CIRC") {
                let (via, _) = pose(&target).or_else(|what| from.fail(what))?;
                motion = Motion::Arc { via: via.0 };
                line.need(",")?;
                target = self.value_at(line, module)?;
            }
            let blend = self.blend(line, "C_DIS", "$APO.CDIS", Blend::Distance)?;
            return self.cartesian(&from, motion, &target, blend);
        }
        if line.take("WAIT") {
            line.need("SEC")?;
            let seconds = line.number()?;
            self.program.stop_last();
            self.program.wait_at_end_s += seconds;
            return if seconds < 0.0 { from.fail("a wait below zero") } else { Ok(()) };
        }
        if line.take("BAS") {
            return self.bas(line);
        }
        if line.take("GLOBAL") || line.take("INTERRUPT") {
            *line = from;
            if line.take("INTERRUPT") {
                return line.need_all(&["ON", "3"]);
            }
            let fault =
                ["GLOBAL", "INTERRUPT", "DECL", "3", "WHEN", "$STOPMESS", "==", "TRUE", "DO", "IR_STOPM"];
            return line.need_all(&fault).and_then(|()| line.need_all(&["(", ")"]));
        }
        if line.take("TRIGGER") || line.take("$OUT") {
            if from.clone().take("TRIGGER") {
                line.need_all(&["WHEN", "DISTANCE", "="])?;
                line.integer(0, 1)?;
                line.need_all(&["DELAY", "="])?;
                line.number()?;
                line.need_all(&["DO", "$OUT"])?;
            }
            line.need("[")?;
            line.integer(1, 4096)?;
            line.need_all(&["]", "="])?;
            self.program.hooks.push(from.rest().to_owned());
            return if line.take("TRUE") { Ok(()) } else { line.need("FALSE") };
        }
        if line.take("HALT") || line.take("CONTINUE") {
            return Ok(());
        }
        let place = place(line)?;
        if line.take("=") {
            return self.assignment(line, &from, module, &place);
        }
        let routine = place.split('[').next().unwrap_or(&place).to_owned();
        line.need("(")?;
        let arguments = line.until(')')?.trim();
        if self.routines.contains_key(&routine) {
            return if arguments.is_empty() {
                self.run(&routine)
            } else {
                from.fail("it takes no arguments")
            };
        }
        self.program.hooks.push(from.rest().to_owned());
        Ok(())
    }

    fn assignment(&mut self, line: &mut Scan, from: &Scan, module: &str, place: &str) -> Result<(), String> {
        let is_axis = place.starts_with("$VEL_AXIS[") || place.starts_with("$ACC_AXIS[");
        if let Some((name, least, most)) = SETTINGS.iter().find(|(name, ..)| *name == place) {
            let number = line.number()?;
            self.settings.insert(name, number);
            return if (*least..=*most).contains(&number) { Ok(()) } else { from.fail("out of range") };
        }
        let value = self.value_at(line, module)?;
        match (place, &value) {
            ("$BASE", _) => self.base = Some(frame(&value, &[]).or_else(|what| from.fail(what))?),
            ("$TOOL", _) => self.tool = Some(frame(&value, &[]).or_else(|what| from.fail(what))?),
            ("$LOAD", _) => self.program.load_kg = Some(load(&value).or_else(|what| from.fail(what))?),
            ("$IPO_MODE", Value::Word(word)) if word == "BASE" => {}
            ("$ORI_TYPE", Value::Word(word)) if ["VAR", "CONSTANT", "JOINT"].contains(&word.as_str()) => {}
            ("$CIRC_TYPE", Value::Word(word)) if ["BASE", "PATH"].contains(&word.as_str()) => {}
            (_, Value::Number(number)) if is_axis && (1.0..=100.0).contains(number) => {}
            _ if place.starts_with("LOAD_DATA[") => {
                load(&value).or_else(|what| from.fail(what))?;
                self.data.insert((String::new(), place.to_owned()), value);
            }
            _ if place.starts_with("TOOL_DATA[") || place.starts_with("BASE_DATA[") => {
                frame(&value, &[]).or_else(|what| from.fail(what))?;
                self.data.insert((String::new(), place.to_owned()), value);
            }
            _ => return from.fail("no variable that this controller knows, or not this value"),
        }
        Ok(())
    }

    /// A call of KUKA's BAS package.
    fn bas(&mut self, line: &mut Scan) -> Result<(), String> {
        let from = line.clone();
        line.need_all(&["(", "#"])?;
        let command = line.word()?.to_uppercase();
        line.need(",")?;
        let number = line.number()?;
        line.need(")")?;
        let index = number as i64;
        let stored = |kind: &str| self.data.get(&(String::new(), format!("{kind}_DATA[{index}]")));
        match command.as_str() {
            "INITMOV" => {
                self.base = Some(identity());
                self.tool = None;
                self.settings.clear();
            }
            "TOOL" if (1..=16).contains(&index) => {
                let Some(tool) = stored("TOOL") else { return from.fail("this tool has no value") };
                let load = stored("LOAD").map(load).transpose().or_else(|what| from.fail(what))?;
                self.tool = Some(frame(tool, &[]).or_else(|what| from.fail(what))?);
                self.program.load_kg = load;
            }
            "BASE" if (1..=32).contains(&index) => {
                let Some(base) = stored("BASE") else { return from.fail("this base has no value") };
                self.base = Some(frame(base, &[]).or_else(|what| from.fail(what))?);
            }
            "BASE" if index == 0 => self.base = Some(identity()),
            "VEL_PTP" | "ACC_PTP" | "ACC_CP" if (1..=100).contains(&index) => {}
            _ => return from.fail("no such command, or not this value"),
        }
        Ok(())
    }

    fn blend(
        &self,
        line: &mut Scan,
        mark: &str,
        setting: &str,
        of: fn(f64) -> Blend,
    ) -> Result<Blend, String> {
        match self.settings.get(setting) {
            _ if !line.take(mark) => Ok(Blend::Stop),
            Some(0.0) => Ok(Blend::Stop),
            Some(size) => Ok(of(*size)),
            None => line.fail(format!("{setting} has no value")),
        }
    }

    fn cartesian(&mut self, from: &Scan, motion: Motion, target: &Value, blend: Blend) -> Result<(), String> {
        let ((position, rotation), configuration) = pose(target).or_else(|what| from.fail(what))?;
        let (Some(base), Some(tool)) = (self.base, self.tool) else {
            return from.fail("no base or tool is chosen");
        };
        let speed =
            self.settings.get("$VEL.CP").map(|metres| metres * 1000.0).filter(|_| motion != Motion::Free);
        if speed.is_none() && motion != Motion::Free {
            return from.fail("$VEL.CP has no value");
        }
        let target = Target { motion, position, rotation, speed, blend, configuration, wait_before_s: 0.0 };
        self.program.cartesian(base, tool, target).or_else(|what| from.fail(what))
    }

    /// A literal, or data by name.
    fn value_at(&self, line: &mut Scan, module: &str) -> Result<Value, String> {
        if line.clone().word().is_err() {
            return value(line);
        }
        let from = line.clone();
        let place = place(line)?;
        let owners = [module.to_owned(), String::new()];
        match owners.into_iter().find_map(|owner| self.data.get(&(owner, place.clone()))) {
            Some(value) => Ok(value.clone()),
            None => from.fail(format!("{place} is not declared, or has no value")),
        }
    }
}
