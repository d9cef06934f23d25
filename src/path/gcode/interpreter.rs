//! The interpreter: the machine state, and the effect of each line on it.

use super::block::Block;
use super::code::Group;
use super::modal::Modal;
use super::options::Options;
use super::word::{self, WordFault};
use crate::path::builder::LONGEST_WAIT;
use crate::path::program::{Dwell, Ignored, Program, Remark};
use nalgebra::Vector3;

/// The letters of the axes, in the order of a vector's components.
pub(super) const AXES: [char; 3] = ['X', 'Y', 'Z'];

/// A longer wait suggests a controller that counts milliseconds [s].
const LONG_WAIT: f64 = 30.0;

/// The state of a running program.
pub(super) struct Interpreter<'o> {
    pub(super) options: &'o Options,
    pub(super) program: Program,
    pub(super) modal: Modal,
    /// Programmed tip position in the workpiece frame [m]; valid only for the axes that are
    /// `known`.
    pub(super) position: Vector3<f64>,
    pub(super) known: [bool; 3],
    /// End of the last move: `position`, unless a move was too short to keep.
    pub(super) tip: Vector3<f64>,
    /// Line of the text, from 1.
    pub(super) line: usize,
    /// Offset of the work coordinate system in force [m].
    pub(super) work: Vector3<f64>,
    /// Tool length offset in force [m].
    pub(super) tool_length: f64,
    /// G52 [m].
    pub(super) local: Vector3<f64>,
    /// G92 [m].
    pub(super) shift: Vector3<f64>,
    started: bool,
    ended: bool,
}

impl<'o> Interpreter<'o> {
    pub(super) fn new(options: &'o Options) -> Self {
        let start = options.start.unwrap_or_default();
        Self {
            options,
            program: Program::default(),
            modal: Modal::default(),
            position: start,
            known: [options.start.is_some(); 3],
            tip: start,
            line: 0,
            work: options.work_offsets[0].unwrap_or_default(),
            tool_length: 0.0,
            local: Vector3::zeros(),
            shift: Vector3::zeros(),
            started: false,
            ended: false,
        }
    }

    /// Whether a line with words has been read.
    pub(super) fn started(&self) -> bool {
        self.started
    }

    /// Whether M2, M30 or the closing % has been read.
    pub(super) fn ended(&self) -> bool {
        self.ended
    }

    /// Ends the program; later lines are not read.
    pub(super) fn end(&mut self) {
        self.ended = true;
    }

    /// Records a remark for the user, once per program.
    pub(super) fn remark(&mut self, code: &'static str, message: impl FnOnce() -> String) {
        if self.program.remarks.iter().all(|remark| remark.code != code) {
            let (message, line) = (message(), self.line);
            self.program.remarks.push(Remark { code, message, line });
        }
    }

    /// Records a word without effect.
    pub(super) fn ignore(&mut self, word: &str) {
        self.program.ignored.push(Ignored { word: word.into(), line: self.line });
    }

    /// Executes a line in the order of the standard: states, offsets, waits, motion, end.
    pub(super) fn run(&mut self, block: &mut Block) -> Result<(), WordFault> {
        self.pass_over(block)?;
        self.modal.set(block)?;
        self.set_offsets(block)?;
        self.dwell(block)?;
        self.blending(block);
        self.motion(block)?;
        if let Some(code) = block.code(Group::Stop) {
            match code.tenths {
                20 | 300 => self.ended = true,
                _ => self.ignore(code.word.text(block.text)),
            }
        }
        self.started = true;
        block.finish()
    }

    /// Consumes tool changes and words without effect.
    fn pass_over(&mut self, block: &mut Block) -> Result<(), WordFault> {
        for word in std::mem::take(&mut block.harmless) {
            self.ignore(word.text(block.text));
        }
        if let Some(word) = block.take('T') {
            self.ignore(word.text(block.text));
            if self.modal.tool.is_some_and(|tool| tool != word.value) {
                self.remark("tool-change", || {
                    "the program changes tools; the job's tool is taken for all of it".into()
                });
            }
            self.modal.tool = Some(word.value);
        }
        if let Some(word) = block.take('O') {
            // The first line may number the program; a later O starts a subprogram.
            if self.started {
                return Err(word.fault(block.text, word::SUBPROGRAM));
            }
            self.ignore(word.text(block.text));
        }
        if let Some(code) = block.code(Group::ToolChange) {
            self.ignore(code.word.text(block.text));
        }
        Ok(())
    }

    fn dwell(&mut self, block: &mut Block) -> Result<(), WordFault> {
        let Some(code) = block.code(Group::NonModal).filter(|code| code.tenths == 40) else { return Ok(()) };
        let expected = "the time of G4 is P in seconds (G4 P0.5)";
        let moves = block.code(Group::Motion).is_some();
        if let Some(word) = block.first_of(&['X', 'Y', 'Z', 'U']).filter(|word| !moves || word.letter == 'U')
        {
            return Err(word.fault(block.text, expected));
        }
        let Some(word) = block.take('P') else { return Err(code.word.fault(block.text, expected)) };
        if !(0.0..=LONGEST_WAIT).contains(&word.value) {
            return Err(word.fault(block.text, format!("a dwell is 0 to {LONGEST_WAIT} seconds")));
        }
        if word.value > LONG_WAIT {
            self.remark("long-dwell", || {
                format!("G4 P{0} is read as {0} s; some controls count P in milliseconds", word.value)
            });
        }
        self.wait(word.value);
        Ok(())
    }

    /// Adds a wait of `time` [s].
    pub(super) fn wait(&mut self, time: f64) {
        self.program.dwells.push(Dwell { after: self.program.moves.len(), time, line: self.line });
    }

    fn blending(&mut self, block: &mut Block) {
        let Some(code) = block.code(Group::Blending) else { return };
        self.ignore(code.word.text(block.text));
        for letter in ['P', 'Q'] {
            if code.tenths == 640
                && let Some(word) = block.take(letter)
            {
                self.ignore(word.text(block.text));
            }
        }
        if code.tenths == 640 {
            self.remark("blending", || {
                "G64 lets a control round corners within its tolerance; the job's own motion settings are used instead".into()
            });
        }
    }
}
