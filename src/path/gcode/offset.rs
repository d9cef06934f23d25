//! Offsets between program coordinates and the workpiece frame: work offsets, G52, G92 and tool
//! length.

use super::block::Block;
use super::block::Code;
use super::code::{EXTENDED_OFFSET, Group, HAAS_FIRST, HAAS_LAST, HAAS_OFFSET};
use super::dialect::GcodeDialect;
use super::interpreter::{AXES, Interpreter};
use super::word::{Word, WordFault, WordMode};
use nalgebra::Vector3;

impl Interpreter<'_> {
    /// Program zero in the workpiece frame [m].
    pub(super) fn origin(&self) -> Vector3<f64> {
        self.work + self.local + self.shift + Vector3::z() * self.tool_length
    }

    /// Applies G43, G44, G49, G54 to G59.3, G52, G92 and G92.1.
    pub(super) fn set_offsets(&mut self, block: &mut Block) -> Result<(), WordFault> {
        if let Some(code) = block.code(Group::ToolLength) {
            self.set_tool_length(code.tenths, code.word, block)?;
        }
        if let Some(code) = block.code(Group::WorkOffset) {
            self.set_work_offset(code, block)?;
        }
        if block.has(Group::NonModal, 100) {
            self.check_setting(block)?;
        }
        let Some(code) = block.code(Group::NonModal) else { return Ok(()) };
        if matches!(code.tenths, 520 | 920) {
            if let Some(motion) =
                block.code(Group::Motion).or(block.code(Group::Cycle).filter(|code| code.tenths != 800))
            {
                let expected =
                    "G92 and G52 take the axis words of their line: write the motion in a line of its own";
                return Err(motion.word.fault(block.text, expected));
            }
            if block.first_of(&AXES).is_none() {
                return Err(code.word.fault(block.text, "G92 and G52 need an axis word in their line"));
            }
        }
        match code.tenths {
            520 => self.set_local(code.word, block),
            920 => self.set_shift(code.word, block),
            921 => {
                self.shift = Vector3::zeros();
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// G54 to G59.3 from the job's table; G54.1 P and G154 P, which it has no row for, at zero.
    fn set_work_offset(&mut self, code: Code, block: &mut Block) -> Result<(), WordFault> {
        let mut name = code.word.text(block.text).to_ascii_uppercase();
        if self.dialect == GcodeDialect::Siemens && matches!(code.tenths, 580 | 590) {
            return Err(code
                .word
                .fault(block.text, "the programmable offsets G58 and G59 are not read: use TRANS"));
        }
        let given = if matches!(code.tenths, EXTENDED_OFFSET | HAAS_OFFSET) {
            let Some(number) = block.take('P') else {
                return Err(code.word.fault(block.text, "an extended work offset needs its number P"));
            };
            number.whole(block.text, 1, if code.tenths == HAAS_OFFSET { 99 } else { 300 })?;
            name = format!("{name} {}", number.text(block.text).to_ascii_uppercase());
            None
        } else if (HAAS_FIRST..=HAAS_LAST).contains(&code.tenths) {
            self.check_haas_offset(code, block)?;
            None
        } else {
            let index =
                if code.tenths >= 590 { code.tenths - 585 } else { (code.tenths - 540) / 10 } as usize;
            if index == 0 {
                self.work = self.options.work_offsets[0].unwrap_or_default();
                return Ok(());
            }
            self.options.work_offsets[index]
        };
        self.work = given.unwrap_or_default();
        if given.is_none() {
            self.remark("work-offset-missing", || {
                format!(
                    "the job gives no offset for {name}: its zero is taken to be that of the workpiece frame"
                )
            });
        }
        Ok(())
    }

    /// G110 to G129 are work offsets on a Haas only; G112 and G113 switch polar interpolation on a Fanuc,
    /// which G113 ends.
    fn check_haas_offset(&self, code: Code, block: &Block) -> Result<(), WordFault> {
        let is_fanuc = self.dialect == GcodeDialect::Fanuc;
        let is_polar = matches!(code.tenths, 1120 | 1130);
        let expected = match self.work == Vector3::zeros() {
            _ if is_fanuc && !is_polar => return Ok(()),
            true if is_fanuc || code.tenths == 1130 => return Ok(()),
            false if is_polar => {
                "G112 and G113 are work offsets on a Haas and polar interpolation on a Fanuc: \
                 write G154 P3 and P4, or delete them"
            }
            _ => "this G number is not known; if it is a work offset of a Haas, say path.dialect \"fanuc\"",
        };
        Err(code.word.fault(block.text, expected))
    }

    /// G10: an offset of zero is what the program has already.
    fn check_setting(&mut self, block: &mut Block) -> Result<(), WordFault> {
        let at = block.code(Group::NonModal).map(|code| code.word);
        let values: Vec<Word> = ['X', 'Y', 'Z', 'A', 'B', 'C', 'R', 'H']
            .iter()
            .filter_map(|&letter| block.take(letter))
            .collect();
        let sets_position = block.take('L').is_some_and(|word| word.value == 20.0);
        block.take('P');
        let given = self.options.work_offsets.iter().any(Option::is_some);
        match (values.iter().find(|word| word.value != 0.0), at) {
            (_, Some(code)) if sets_position || given => Err(code.fault(
                block.text,
                "offsets are not set from within a program: give them as the job's work and tool offsets",
            )),
            (Some(_), Some(code)) => Err(code.fault(
                block.text,
                "offsets other than 0 are not set from within a program: give them as the job's work and tool offsets",
            )),
            _ => {
                self.ignore("G10");
                Ok(())
            }
        }
    }

    fn set_tool_length(&mut self, tenths: u32, code: Word, block: &mut Block) -> Result<(), WordFault> {
        if tenths == 490 {
            block.take('H');
            self.tool_length = 0.0;
            return Ok(());
        }
        let Some(word) = block.take('H') else {
            // Without H, the offset in force stays.
            self.remark("tool-length-kept", || {
                let code = code.text(block.text).to_ascii_uppercase();
                format!("{code} names no offset H: the one in force is kept")
            });
            return Ok(());
        };
        let number = word.whole(block.text, 0, 9999)?;
        let table = &self.options.tool_length_offsets;
        let length = match table.get(&number) {
            Some(&length) => length,
            None if number == 0 => 0.0,
            None if table.is_empty() => {
                self.remark("tool-length-missing", || {
                    format!(
                        "the job gives no tool length offsets: that of H{number} is taken as 0, \
                         so that the program's points are those of the tool's tip"
                    )
                });
                0.0
            }
            None => {
                let numbers: Vec<String> = table.keys().map(u32::to_string).collect();
                let expected = format!("the job's tool length offsets are those of H {}", numbers.join(", "));
                return Err(word.fault(block.text, expected));
            }
        };
        self.tool_length = if tenths == 440 { -length } else { length };
        Ok(())
    }

    fn set_local(&mut self, code: Word, block: &mut Block) -> Result<(), WordFault> {
        if self.shift != Vector3::zeros() {
            return Err(code.fault(
                block.text,
                "controls differ on G52 while G92 is in force: clear that with G92.1 first",
            ));
        }
        for (axis, letter) in AXES.into_iter().enumerate() {
            if let Some(word) = block.take(letter) {
                let kept = if word.mode == WordMode::Incremental { self.local[axis] } else { 0.0 };
                self.local[axis] = kept + word.value * self.modal.unit;
            }
        }
        Ok(())
    }

    /// G92: assigns these coordinates to the current tool position. If the position is unknown,
    /// they define it.
    fn set_shift(&mut self, code: Word, block: &mut Block) -> Result<(), WordFault> {
        if self.local != Vector3::zeros() {
            return Err(code.fault(
                block.text,
                "controls differ on G92 while G52 is in force: clear that with G52 X0 Y0 Z0 first",
            ));
        }
        self.note_unit();
        let mut begins = false;
        for (axis, letter) in AXES.into_iter().enumerate() {
            let Some(word) = block.take(letter) else { continue };
            let value = word.value * self.modal.unit;
            if self.away[axis] {
                let expected =
                    format!("first a G0 line with {letter}: here the tool is at a position of the machine");
                return Err(word.fault(block.text, expected));
            }
            if self.known[axis] {
                self.shift[axis] += self.position[axis] - self.origin()[axis] - value;
            } else {
                self.position[axis] = self.origin()[axis] + value;
                self.known[axis] = true;
                begins = true;
            }
        }
        if begins {
            self.tip = self.position;
        }
        Ok(())
    }
}
