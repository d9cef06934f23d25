//! The interpreter: the machine state, and the effect of each line on it.

use super::block::Block;
use super::code::Group;
use super::dialect::GcodeDialect;
use super::modal::Modal;
use super::options::Options;
use super::point::Points;
use super::siemens::Siemens;
use super::word::{self, Word, WordFault};
use crate::path::builder::LONGEST_WAIT;
use crate::path::program::{Dwell, Ignored, Program, Remark};
use crate::path::unit::LengthUnit;
use crate::units::MM;
use nalgebra::Vector3;

/// The letters of the axes, in the order of a vector's components.
pub(super) const AXES: [char; 3] = ['X', 'Y', 'Z'];

/// A longer wait suggests a controller that counts milliseconds [s].
const LONG_WAIT: f64 = 30.0;

/// The state of a running program.
pub(super) struct Interpreter<'o> {
    pub(super) options: &'o Options,
    pub(super) dialect: GcodeDialect,
    pub(super) siemens: Siemens,
    pub(super) program: Program,
    pub(super) modal: Modal,
    /// Programmed tip position in the workpiece frame [m]; valid only for the axes that are
    /// `known`.
    pub(super) position: Vector3<f64>,
    pub(super) known: [bool; 3],
    /// End of the last move: `position`, unless a move was too short to keep.
    pub(super) tip: Vector3<f64>,
    /// The highest Z so far [m].
    pub(super) highest: f64,
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
    /// Axes that are at a position of the machine; `position` is where they were left.
    pub(super) away: [bool; 3],
    /// Axes that the move being made has a word for.
    pub(super) given: [bool; 3],
    /// How lengths were written.
    pub(super) points: Points,
    /// Unit of the coordinates before [m].
    pub(super) noted_unit: Option<f64>,
    started: bool,
    ended: bool,
}

impl<'o> Interpreter<'o> {
    pub(super) fn new(options: &'o Options, dialect: GcodeDialect) -> Self {
        let start = options.start.unwrap_or_default();
        Self {
            options,
            dialect,
            siemens: Siemens::default(),
            program: Program::default(),
            modal: Modal::starting_in(options.unit.map_or(MM, LengthUnit::in_m)),
            highest: options.start.map_or(f64::NEG_INFINITY, |start| start.z),
            position: start,
            known: [options.start.is_some(); 3],
            tip: start,
            line: 0,
            work: options.work_offsets[0].unwrap_or_default(),
            tool_length: 0.0,
            local: Vector3::zeros(),
            shift: Vector3::zeros(),
            away: [false; 3],
            given: [false; 3],
            points: Points::default(),
            noted_unit: None,
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
        self.resolve_polar(block)?;
        self.dwell(block)?;
        self.blending(block);
        self.motion(block)?;
        if let Some(code) = block.code(Group::Stop) {
            match code.tenths {
                20 | 170 | 300 | 990 => self.ended = true,
                _ => self.ignore(code.word.text(block.text)),
            }
        }
        self.started = true;
        block.finish()
    }

    /// Consumes tool changes and words without effect.
    fn pass_over(&mut self, block: &mut Block) -> Result<(), WordFault> {
        for (word, letters) in std::mem::take(&mut block.harmless) {
            self.ignore(word.text(block.text));
            for &letter in letters {
                if let Some(word) = block.take(letter) {
                    self.ignore(word.text(block.text));
                }
            }
        }
        self.pass_over_words(block);
        if let Some(word) = block.take('T') {
            self.ignore(word.text(block.text));
            if self.modal.tool.is_some_and(|tool| tool != word.value) {
                self.remark("tool-change", || {
                    "the program changes tools; the job's tool is used throughout".into()
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

    /// Consumes words that say nothing here: a rotary axis at 0, the number of a radius offset that
    /// is never switched on.
    fn pass_over_words(&mut self, block: &mut Block) {
        for letter in ['A', 'B', 'C'] {
            if block.peek(letter).is_some_and(|word| word.value == 0.0)
                && let Some(word) = block.take(letter)
            {
                self.ignore(word.text(block.text));
                self.remark("rotary-zero", || {
                    "a rotary axis at 0: the tool keeps its direction as long as it stays there".into()
                });
            }
        }
        if let Some(word) = block.take('D') {
            self.ignore(word.text(block.text));
        }
        if block.peek('F').is_some_and(|word| word.value == 0.0)
            && !block.has(Group::NonModal, 40)
            && let Some(word) = block.take('F')
        {
            self.ignore(word.text(block.text));
            self.remark("feed-zero", || "a feed of 0 is ignored: the previous feed stays in force".into());
        }
    }

    fn dwell(&mut self, block: &mut Block) -> Result<(), WordFault> {
        let Some(code) = block.code(Group::NonModal).filter(|code| code.tenths == 40) else { return Ok(()) };
        let expected = "the time of G4 is P, or X or U in seconds (G4 P0.5)";
        let moves = block.code(Group::Motion).is_some();
        let time = block
            .take('P')
            .or_else(|| block.take('U'))
            .or_else(|| if moves { None } else { block.take('X').or_else(|| block.take('F')) });
        let Some(word) = time else { return Err(code.word.fault(block.text, expected)) };
        let time = self.dwell_time(word, block)?;
        self.wait(time);
        Ok(())
    }

    /// The time [s] of a dwell: X, U and F are seconds, P as the dialect counts it.
    pub(super) fn dwell_time(&mut self, word: Word, block: &Block) -> Result<f64, WordFault> {
        let text = word.text(block.text);
        let in_milliseconds = word.letter == 'P' && self.dialect.counts_milliseconds(text, word.value);
        let time = if in_milliseconds { word.value / 1000.0 } else { word.value };
        if !(0.0..=LONGEST_WAIT).contains(&time) {
            return Err(word.fault(block.text, format!("a dwell is 0 to {LONGEST_WAIT} seconds")));
        }
        if in_milliseconds {
            self.remark("dwell-milliseconds", || format!("{text} is read as {time} s: milliseconds"));
        } else if time > LONG_WAIT {
            self.remark("long-dwell", || {
                format!("{text} is read as {time} s; some controls count P in milliseconds")
            });
        }
        Ok(time)
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
                "G64 lets a control round corners within its tolerance; the job's motion settings are used instead".into()
            });
        }
    }
}
