//! FANUC's teach pendant programs as text (`.LS`). W, P, R are angles about fixed X, Y and Z: `Rz(R) Ry(P) Rx(W)`.

mod listing;

use super::scan::Scan;
use super::{
    Blend, ControllerProgram, File, Frame, Motion, Target, about_x, about_y, about_z, checked, main_of,
};
use listing::{Listing, Position, Values};
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// A frame that is being stated, component by component.
type Register = [Option<f64>; 6];

struct Controller<'a> {
    listings: BTreeMap<String, Listing<'a>>,
    registers: BTreeMap<i64, Register>,
    /// User frames and tool frames, by number.
    user: BTreeMap<i64, Register>,
    tools: BTreeMap<i64, Register>,
    active: (Option<i64>, Option<i64>),
    /// CONFIG of the target before, if it was Cartesian.
    letters: Option<String>,
    running: Vec<String>,
    program: ControllerProgram,
}

/// Reads a package of `.LS` files.
pub(crate) fn fanuc(files: &[File]) -> Result<ControllerProgram, String> {
    let texts = checked(files, &["ls"])?;
    let mut listings = BTreeMap::new();
    for text in &texts {
        let listing = listing::listing(text)?;
        listings.insert(text.stem.to_owned(), listing);
    }
    let names: Vec<String> = listings.keys().cloned().collect();
    let lines = listings.values().flat_map(|listing| &listing.lines);
    let called: Vec<String> = lines
        .filter_map(|line| {
            let mut line = line.clone();
            if line.take("CALL") { line.word().ok().map(str::to_owned) } else { None }
        })
        .collect();
    let main = main_of(&names, &called, "program")?;
    let mut controller = Controller {
        listings,
        registers: BTreeMap::new(),
        user: BTreeMap::new(),
        tools: BTreeMap::new(),
        active: (None, None),
        letters: None,
        running: Vec::new(),
        program: ControllerProgram::of(&main, &texts),
    };
    controller.run(&main)?;
    controller.program.stop_last();
    Ok(controller.program)
}

impl Controller<'_> {
    fn run(&mut self, name: &str) -> Result<(), String> {
        if self.running.iter().any(|other| other == name) {
            return Err(format!("{name} calls itself"));
        }
        let Some(Listing { lines, .. }) = self.listings.get(name) else { return Err(format!("no {name}")) };
        let lines = lines.clone();
        self.running.push(name.to_owned());
        for mut line in lines {
            self.statement(&mut line, name)?;
            line.end()?;
        }
        self.running.pop();
        Ok(())
    }

    fn statement(&mut self, line: &mut Scan, name: &str) -> Result<(), String> {
        if line.is_done() {
            return Ok(());
        }
        let from = line.clone();
        if line.take("!") {
            return self.remark(line);
        }
        match line.word()? {
            "J" | "L" | "C" => return self.motion(line, &from, name),
            "UFRAME_NUM" => {
                line.need("=")?;
                self.active.0 = Some(line.integer(0, 9)?);
            }
            "UTOOL_NUM" => {
                line.need("=")?;
                self.active.1 = Some(line.integer(1, 10)?);
            }
            "PAYLOAD" => index(line, 10).map(drop)?,
            "PR" => self.register(line, name)?,
            word @ ("UFRAME" | "UTOOL") => {
                let is_user = word == "UFRAME";
                let number = index(line, if is_user { 9 } else { 10 })?;
                line.need_all(&["=", "PR"])?;
                let register = index(line, 100)?;
                let Some(value) = self.registers.get(&register) else {
                    return from.fail("the PR has no value");
                };
                let frames = if is_user { &mut self.user } else { &mut self.tools };
                frames.insert(number, *value);
            }
            "WAIT" => {
                let seconds = line.number()?;
                line.need_all(&["(", "sec", ")"])?;
                if seconds < 0.0 || self.program.is_blending() {
                    return from.fail("a wait below zero, or while the motion before blends");
                }
                self.program.wait_at_end_s += seconds;
            }
            "CALL" => {
                let called = line.word()?.to_owned();
                listing::program_name(&called).or_else(|what| from.fail(what))?;
                if self.listings.contains_key(&called) {
                    return self.run(&called);
                }
                if line.take("(") {
                    while !line.take(")") {
                        line.number()?;
                        line.take(",");
                    }
                }
                self.program.hooks.push(from.rest().trim_end().to_owned());
            }
            word @ ("DO" | "RO" | "R") => {
                let number = index(line, if word == "R" { 200 } else { 512 })?;
                line.need("=")?;
                let is_set =
                    if word == "R" { constant(line).is_ok() } else { line.take("ON") || line.take("OFF") };
                if !is_set {
                    return from.fail(format!("no value for {word}[{number}]"));
                }
                self.program.hooks.push(from.rest().trim_end().to_owned());
            }
            _ => return from.fail("no statement that this controller knows"),
        }
        Ok(())
    }

    /// A remark may state the value of a frame that stays on the controller: `!UFRAME[1] X 1462.485 Y 0`.
    fn remark(&mut self, line: &mut Scan) -> Result<(), String> {
        let mut stated = line.clone();
        let frames = if stated.take("UFRAME") { &mut self.user } else { &mut self.tools };
        let is_frame = line.clone().take("UFRAME") || stated.take("UTOOL");
        if let (true, Ok(number)) = (is_frame, index(&mut stated, 10)) {
            let register = frames.entry(number).or_default();
            while let Some(place) = ["X", "Y", "Z", "W", "P", "R"].iter().position(|name| stated.prefix(name))
            {
                stated.take("=");
                let Ok(number) = stated.number() else { break };
                register[place] = Some(number);
                stated.take(",");
            }
        }
        line.finish();
        Ok(())
    }

    /// `PR[1]=P[2]`, or `PR[1,3]=12.5` for a component.
    fn register(&mut self, line: &mut Scan, name: &str) -> Result<(), String> {
        line.need("[")?;
        let number = line.integer(1, 100)?;
        if line.take(",") {
            let component = line.integer(1, 6)?;
            line.need_all(&["]", "="])?;
            self.registers.entry(number).or_default()[component as usize - 1] = Some(constant(line)?);
            return Ok(());
        }
        line.need_all(&["]", "=", "P"])?;
        match self.position(line, name)?.values {
            Values::Pose { frame, .. } => self.registers.insert(number, frame.map(Some)),
            Values::Joints(_) => return line.fail("a frame from a position in joints"),
        };
        Ok(())
    }

    /// The position of `[n]` in this program.
    fn position(&self, line: &mut Scan, name: &str) -> Result<Position, String> {
        let from = line.clone();
        let number = index(line, 32767)?;
        match self.listings.get(name).and_then(|listing| listing.positions.get(&number)) {
            Some(position) => Ok(position.clone()),
            None => from.fail(format!("P[{number}] has no position")),
        }
    }

    fn motion(&mut self, line: &mut Scan, from: &Scan, name: &str) -> Result<(), String> {
        let is_joint = from.clone().take("J");
        let mut motion = if is_joint { Motion::Free } else { Motion::Line };
        line.need("P")?;
        let mut position = self.position(line, name)?;
        if from.clone().take("C") {
            self.is_active(&position, from)?;
            let Values::Pose { frame: via, .. } = position.values else {
                return from.fail("an arc through joints");
            };
            motion = Motion::Arc { via: Vector3::new(via[0], via[1], via[2]) };
            line.need_all(&[":", "P"])?;
            position = self.position(line, name)?;
        }
        self.is_active(&position, from)?;
        let written = line.clone();
        let size = line.number()?;
        let speed = if is_joint {
            line.need("%")?;
            if size.fract() != 0.0 || !(1.0..=100.0).contains(&size) {
                return written.fail("a joint speed is 1 to 100 %");
            }
            None
        } else {
            let unit = if line.take("mm/sec") { 1.0 } else { line.need("cm/min").map(|()| 10.0 / 60.0)? };
            if (size * 10.0 - (size * 10.0).round()).abs() > 1e-9 || size <= 0.0 || size * unit > 2000.0 {
                return written.fail("a speed is above 0, up to 2000 mm/sec, with one decimal at most");
            }
            Some(size * unit)
        };
        let blend = if line.take("FINE") {
            Blend::Stop
        } else if line.prefix("CNT") {
            Blend::Percent(line.integer(0, 100)? as f64)
        } else if line.prefix("CR") && !is_joint {
            Blend::Distance(line.integer(0, 1000)? as f64)
        } else {
            return line.fail("FINE, CNT or CR is missing");
        };
        if line.prefix("ACC") {
            line.integer(1, 150)?;
        }
        let (frame, config) = match position.values {
            Values::Joints(axes) if is_joint => {
                self.letters = None;
                self.program.joints(axes, speed, blend);
                return Ok(());
            }
            Values::Joints(_) => return from.fail("a straight line or an arc to joints"),
            Values::Pose { frame, config } => (pose(frame), config),
        };
        let letters = config.split(',').next().unwrap_or_default().to_owned();
        if !is_joint && self.letters.as_ref().is_some_and(|before| *before != letters) {
            return from.fail("the letters of CONFIG change along a line or an arc");
        }
        self.letters = Some(letters);
        let (base, tool) =
            (self.frame(&self.user, self.active.0, from)?, self.frame(&self.tools, self.active.1, from)?);
        let (position, rotation) = frame;
        let configuration = Some(config);
        let target = Target { motion, position, rotation, speed, blend, configuration, wait_before_s: 0.0 };
        self.program.cartesian(base, tool, target).or_else(|what| from.fail(what))
    }

    /// Whether a position belongs to the frames that are chosen.
    fn is_active(&self, position: &Position, from: &Scan) -> Result<(), String> {
        if self.active == (Some(position.user), Some(position.tool)) {
            Ok(())
        } else {
            from.fail(format!(
                "the position has UF {}, UT {}, others are chosen",
                position.user, position.tool
            ))
        }
    }

    /// The value of a frame; user frame 0 is the world.
    fn frame(
        &self,
        frames: &BTreeMap<i64, Register>,
        number: Option<i64>,
        from: &Scan,
    ) -> Result<Frame, String> {
        if number == Some(0) {
            return Ok(super::identity());
        }
        let register = number.and_then(|number| frames.get(&number));
        match register.and_then(|register| register.iter().copied().collect::<Option<Vec<f64>>>()) {
            Some(all) => Ok(pose([all[0], all[1], all[2], all[3], all[4], all[5]])),
            None => from.fail("the frame that is chosen has no value, or not all of it"),
        }
    }
}

fn pose([x, y, z, w, p, r]: [f64; 6]) -> Frame {
    (Vector3::new(x, y, z), about_z(r) * about_y(p) * about_x(w))
}

/// A number in brackets.
fn index(line: &mut Scan, most: i64) -> Result<i64, String> {
    line.need("[")?;
    let number = line.integer(1, most)?;
    line.need("]")?;
    Ok(number)
}

/// A constant; a negative one stands in parentheses.
fn constant(line: &mut Scan) -> Result<f64, String> {
    let from = line.clone();
    let is_enclosed = line.take("(");
    let number = line.number()?;
    if is_enclosed {
        line.need(")")?;
    }
    if number < 0.0 && !is_enclosed {
        from.fail("a negative constant without parentheses")
    } else {
        Ok(number)
    }
}
