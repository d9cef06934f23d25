//! Staubli's VAL3, an application of CS8 or CS9. `rx ry rz` are angles about moving axes: `Rx Ry Rz`.

mod data;
mod program;

use super::scan::Scan;
use super::xml::{self, Element};
use super::{Blend, ControllerProgram, File, Frame, Motion, Target, Text, checked, identity, within};
use data::Datum;
use program::{Program, file_name, program};
use std::collections::BTreeMap;

struct Controller<'a> {
    data: BTreeMap<String, Datum>,
    /// Programs of the project; `None` for one whose file is not in the package.
    programs: BTreeMap<String, Option<Program<'a>>>,
    libraries: Vec<String>,
    /// Variables of the programs that run, the innermost last.
    locals: Vec<BTreeMap<String, Vec<f64>>>,
    /// Whether motions may be under way.
    is_moving: bool,
    program: ControllerProgram,
}

/// Reads an application: a folder with a `.pjx`, `.dtx` and `.pgx`.
pub(crate) fn val3(files: &[File]) -> Result<ControllerProgram, String> {
    let texts = checked(files, &["pjx", "dtx", "pgx"])?;
    let mut projects = texts.iter().filter(|text| text.ending == "pjx");
    let (Some(project), None) = (projects.next(), projects.next()) else {
        return Err("a package has one .pjx".to_owned());
    };
    let listed = data::project(project)?;
    // The code of a program is copied out of its element, so these must outlive the controller.
    let mut roots: Vec<(&Text, Element)> = Vec::new();
    for text in texts.iter().filter(|text| text.ending == "pgx") {
        if !listed.programs.contains(&file_name(text)) {
            return Err(format!("{}:0: not listed in {}", text.path, project.path));
        }
        roots.push((text, xml::document(text.path, text.text)?));
    }
    let mut controller = Controller {
        data: BTreeMap::new(),
        programs: listed
            .programs
            .iter()
            .map(|name| (name.trim_end_matches(".pgx").to_owned(), None))
            .collect(),
        libraries: listed.libraries,
        locals: Vec::new(),
        is_moving: false,
        program: ControllerProgram::of(project.stem, &texts),
    };
    for text in texts.iter().filter(|text| text.ending == "dtx") {
        if !listed.data.contains(&file_name(text)) {
            return Err(format!("{}:0: not listed in {}", text.path, project.path));
        }
        data::database(text, &mut controller.data)?;
    }
    if let Some(absent) = listed.data.iter().find(|name| !texts.iter().any(|text| file_name(text) == **name))
    {
        return Err(format!("{}:0: {absent} is not in the package", project.path));
    }
    for (text, root) in &roots {
        let program = program(text, root)?;
        controller.programs.insert(text.stem.to_owned(), Some(program));
    }
    for needed in ["start", "stop"] {
        if !matches!(controller.programs.get(needed), Some(Some(_))) {
            return Err(format!("{}:0: no program {needed}", project.path));
        }
    }
    controller.run("start", &[])?;
    if controller.is_moving {
        return Err("start ends while motions are under way".to_owned());
    }
    Ok(controller.program)
}

impl Controller<'_> {
    fn run(&mut self, name: &str, arguments: &[f64]) -> Result<(), String> {
        let Some(Some(program)) = self.programs.get(name).cloned() else {
            return Err(format!("no program {name}"));
        };
        if program.parameters.len() != arguments.len() || self.locals.len() > 20 {
            return Err(format!("{name} has other parameters, or calls itself"));
        }
        let mut locals: BTreeMap<String, Vec<f64>> =
            program.parameters.iter().cloned().zip(arguments.iter().map(|value| vec![*value])).collect();
        locals.extend(program.locals.iter().map(|(name, size)| (name.clone(), vec![0.0; *size])));
        self.locals.push(locals);
        self.block(&program.statements)?;
        self.locals.pop();
        Ok(())
    }

    /// Runs statements, with loops among them.
    fn block(&mut self, statements: &[Scan]) -> Result<(), String> {
        let mut at = 0;
        while at < statements.len() {
            let mut scan = statements[at].clone();
            at += 1;
            if !scan.take("for") {
                self.statement(&mut scan)?;
                scan.end()?;
                continue;
            }
            let mut depth = 1;
            let Some(length) = statements[at..].iter().position(|line| {
                depth += i32::from(line.clone().take("for")) - i32::from(line.clone().take("endFor"));
                depth == 0
            }) else {
                return scan.fail("endFor is missing");
            };
            let variable = scan.word()?.to_owned();
            scan.need("=")?;
            let (from, _, to) = (self.number(&mut scan)?, scan.need("to")?, self.number(&mut scan)?);
            let step = if scan.take("step") { self.number(&mut scan)? } else { 1.0 };
            scan.end()?;
            if step <= 0.0 {
                return scan.fail("a step that is not above zero");
            }
            let mut value = from;
            while value <= to {
                self.set(&scan, &variable, 0, value)?;
                self.block(&statements[at..at + length])?;
                value += step;
            }
            at += length + 1;
        }
        Ok(())
    }

    fn statement(&mut self, scan: &mut Scan) -> Result<(), String> {
        let from = scan.clone();
        let mut assigned = scan.clone();
        if assigned.word().is_ok()
            && assigned.take("=")
            && assigned.word().is_ok_and(|word| word.starts_with("move"))
        {
            let number = scan.word()?.to_owned();
            self.set(&from, &number, 0, 0.0)?;
            scan.need("=")?;
        }
        let word = scan.word()?;
        match word {
            "movej" | "movel" | "movec" => return self.motion(scan, word),
            "call" => return self.call(scan, &from),
            "delay" | "putln" | "autoConnect" | "setPayload" | "aioSet" | "open" | "close" | "link" => {
                scan.need("(")?;
                self.instruction(scan, word, &from)?;
                return scan.need(")");
            }
            "waitEndMove" | "resetMotion" | "enablePower" | "disablePower" => {
                if word == "waitEndMove" {
                    self.is_moving = false;
                    self.program.stop_last();
                }
                return scan.need_all(&["(", ")"]);
            }
            _ => *scan = from.clone(),
        }
        if let Ok(place) = self.place(&mut scan.clone(), &["mdesc", "pointRx", "frame", "tool", "dio", "num"])
        {
            self.place(scan, &[&self.data[&place.0].kind])?;
            return self.field(scan, &place, &from);
        }
        let name = scan.word()?.to_owned();
        let index = self.index(scan)?;
        scan.need("=")?;
        let value = self.number(scan)?;
        self.set(&from, &name, index, value)
    }

    fn instruction(&mut self, scan: &mut Scan, word: &str, from: &Scan) -> Result<(), String> {
        match word {
            "delay" => {
                let seconds = self.number(scan)?;
                if seconds < 0.0 || self.is_moving {
                    return from.fail("a delay below zero, or while motions are under way");
                }
                self.program.wait_at_end_s += seconds;
            }
            "putln" => drop(scan.quoted('"')?),
            "autoConnect" => drop(scan.word()?),
            "setPayload" => {
                self.place(scan, &["tool"])?;
                scan.need(",")?;
                self.program.load_kg = Some(self.number(scan)?);
                scan.need(",")?;
                self.place(scan, &["trsf"])?;
            }
            "link" => {
                let point = self.place(scan, &["pointRx"])?;
                scan.need(",")?;
                let father = self.place(scan, &["frame"])?;
                if let Some(row) = self.data.get_mut(&point.0).and_then(|datum| datum.rows.get_mut(point.1)) {
                    row.father = Some(father);
                }
            }
            _ => {
                self.place(scan, &[if word == "aioSet" { "aio" } else { "tool" }])?;
                if word == "aioSet" {
                    scan.need(",")?;
                    self.number(scan)?;
                }
                if self.is_moving {
                    return from.fail("an output while motions are under way");
                }
                self.program.hooks.push(from.rest().to_owned());
            }
        }
        Ok(())
    }

    fn call(&mut self, scan: &mut Scan, from: &Scan) -> Result<(), String> {
        let name = scan.word()?;
        let is_library = scan.take(":");
        if is_library {
            scan.word()?;
        }
        scan.need("(")?;
        let mut arguments = Vec::new();
        while !scan.take(")") {
            if !arguments.is_empty() {
                scan.need(",")?;
            }
            arguments.push(self.number(scan)?);
        }
        match self.programs.get(name) {
            Some(Some(program)) if !is_library && !program.statements.is_empty() => {
                return self
                    .run(name, &arguments)
                    .or_else(|what| if what.contains(':') { Err(what) } else { from.fail(what) });
            }
            // A program with no statement is there for the shop to fill in.
            Some(_) if !is_library => {}
            _ if is_library && self.libraries.iter().any(|library| library == name) => {}
            _ => return from.fail(format!("{name} is neither a program of the project nor a library")),
        }
        if self.is_moving {
            return from.fail("a call to the shop's program while motions are under way");
        }
        self.program.hooks.push(from.rest().to_owned());
        Ok(())
    }

    /// `mCut.tvel=20`, `pPath[0].trsf={..}`, `dOut=true` or `nCount=1`.
    fn field(&mut self, scan: &mut Scan, place: &(String, usize), from: &Scan) -> Result<(), String> {
        let kind = self.data[&place.0].kind.clone();
        let name = if scan.take(".") { scan.word()? } else { "" };
        scan.need("=")?;
        let mut row = self.row(place).clone();
        match (kind.as_str(), name) {
            ("num", "") => drop(row.numbers.insert("value", self.number(scan)?)),
            ("dio", "") => {
                if self.is_moving || !(scan.take("true") || scan.take("false")) {
                    return from.fail("no value, or an output while motions are under way");
                }
                self.program.hooks.push(from.rest().to_owned());
            }
            ("pointRx" | "frame" | "tool", "trsf") => {
                scan.need("{")?;
                for (index, axis) in data::TRSF.iter().enumerate() {
                    if index > 0 {
                        scan.need(",")?;
                    }
                    row.numbers.insert(axis, self.number(scan)?);
                }
                scan.need("}")?;
            }
            ("mdesc", "blend") => row.blend = data::blend(scan.word()?).or_else(|what| from.fail(what))?,
            ("mdesc", _) => {
                let fields = [
                    ("tvel", "tmax"),
                    ("rvel", "rmax"),
                    ("vel", "vel"),
                    ("accel", "accel"),
                    ("decel", "decel"),
                    ("leave", "leave"),
                    ("reach", "reach"),
                ];
                let Some((_, key)) = fields.iter().find(|(field, _)| *field == name) else {
                    return from.fail("no such field of an mdesc");
                };
                row.numbers.insert(key, self.number(scan)?);
            }
            _ => return from.fail(format!("no field {name} of a {kind}")),
        }
        if let Some(datum) = self.data.get_mut(&place.0) {
            datum.rows[place.1] = row;
        }
        Ok(())
    }

    fn motion(&mut self, scan: &mut Scan, word: &str) -> Result<(), String> {
        let from = scan.clone();
        scan.need("(")?;
        let points: &[&str] = if word == "movej" { &["jointRx", "pointRx"] } else { &["pointRx"] };
        let mut end = self.place(scan, points)?;
        scan.need(",")?;
        let mut motion = if word == "movej" { Motion::Free } else { Motion::Line };
        if word == "movec" {
            motion = Motion::Arc { via: self.row(&end).frame().0 };
            end = self.place(scan, points)?;
            scan.need(",")?;
        }
        let tool = self.place(scan, &["tool"])?;
        scan.need(",")?;
        let how = self.place(scan, &["mdesc"])?;
        scan.need(")")?;
        let how = self.row(&how);
        let (leave, reach) = (how.number("leave"), how.number("reach"));
        let blend = match how.blend {
            "off" => Blend::Stop,
            _ if leave != reach => return from.fail("leave and reach differ"),
            _ => Blend::Distance(leave),
        };
        let speed = Some(how.number("tmax")).filter(|speed| *speed < 9999.0);
        if speed.is_some_and(|speed| speed <= 0.0) || how.number("vel") <= 0.0 {
            return from.fail("a speed that is not above zero");
        }
        self.is_moving = true;
        let row = self.row(&end).clone();
        if self.data[&end.0].kind == "jointRx" {
            let joints = ["j1", "j2", "j3", "j4", "j5", "j6"].map(|joint| row.number(joint));
            self.program.joints(joints, speed, blend);
            return Ok(());
        }
        let (position, rotation) = row.frame();
        let base = self.in_world(row.father.as_ref(), &from)?;
        let tool = within(self.in_world(self.row(&tool).father.as_ref(), &from)?, self.row(&tool).frame());
        let target = Target {
            motion,
            position,
            rotation,
            speed,
            blend,
            configuration: row.config(),
            wait_before_s: 0.0,
        };
        self.program.cartesian(base, tool, target).or_else(|what| from.fail(what))
    }

    /// A frame in the world, or a tool on the flange, through its fathers.
    fn in_world(&self, father: Option<&(String, usize)>, from: &Scan) -> Result<Frame, String> {
        let (mut place, mut frame) = (father, identity());
        for _ in 0..10 {
            let Some((name, index)) = place else { return from.fail("a point without a father") };
            if *index == 0 && (name == "world" || name == "flange") {
                return Ok(frame);
            }
            let father = (name.clone(), *index);
            frame = within(self.row(&father).frame(), frame);
            place = self.row(place.unwrap_or(&father)).father.as_ref();
        }
        from.fail("fathers in a ring")
    }
}
