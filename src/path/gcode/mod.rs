//! G-code (RS-274, ISO 6983) for three-axis milling, read as a control would run it, or refused by
//! line and column.
//!
//! A word is a letter and a number; a block is a line of words; the modal codes stay in force from
//! line to line; the interpreter turns lines into the moves of a [`Program`]. The rules are those
//! of "The NIST RS274NGC Interpreter, Version 3" (Kramer, Proctor, Messina, NISTIR 6556, 2000);
//! where controls differ, it is said here.
//!
//! | Words | Meaning here |
//! |---|---|
//! | G0, G1 | straight; rapids too, though many controls bend theirs |
//! | G2, G3 with I J K or R, P | arcs and helices in the plane of G17, G18 (axes Z, X, seen from +Y) or G19; R below 0 takes the long way; an arc that ends within 1 nm of its start is a full circle; P counts turns |
//! | G20 G21, G70 G71 | inch, mm; they count for the whole of their line; without one mm is taken, with a remark |
//! | G90 G91, G90.1 G91.1 | end points and centres as points or as steps; at the start G90 and G91.1 |
//! | G93 G94 G95, F, S | feed as 1/minutes, length a minute, length a revolution; without F the job's feed, with a remark |
//! | G54 to G59.3, G52, G92, G92.1, G53 | offsets; machine zero is the workpiece frame's origin |
//! | G43 G44 H, G49 | tool length offsets along Z, what the job's tool frame does not hold already |
//! | G73 G81 G82 G83 G85 G89, G80, G98 G99 | drilling, expanded to moves; G98 at the start; L repeats; under G91, R counts from the level at which the series began and the bottom from R |
//! | G4 P | waits in seconds |
//! | M0 M1 M60, M2 M30, M3 M5, M6 T, M7 M8 M9, M48 M49, G61 G64, G15 G40 G50 G69 G97 | the end, the spindle, and words without effect on the path, which are listed |
//!
//! All else is an error: what it is and what to do stands in the message. Above all cutter
//! compensation (G41, G42), scaling, rotation, polar coordinates, reference moves (G28, G30), G10,
//! tapping, macros, sub-programs, expressions, rotary axes and M4. A lone `O` number in the first
//! line names the program and is passed over.

mod arc;
mod block;
mod code;
mod cycle;
mod drill;
mod interpreter;
mod modal;
mod motion;
mod offset;
mod options;
pub(crate) mod token;
mod word;

pub use drill::PECK_CLEARANCE;
pub use options::{ARC_TOLERANCE_PART, Options};

use crate::error::Error;
use crate::path::program::Program;
use crate::units::INCH;
use block::Block;
use interpreter::Interpreter;
use word::WordFault;

/// Reads a program; `on_line` hears the number of lines done after each.
///
/// Before X, Y and Z have all been given, G0 (or one G1, with a remark) only says where the path
/// begins. A program without a move is no error here: it has no moves.
///
/// # Errors
/// [`Error::Text`] with line and column of the first word that is not understood, does not fit, or
/// would change the path in a way that is not modelled.
pub fn program(text: &str, options: &Options, mut on_line: impl FnMut(usize)) -> Result<Program, Error> {
    let mut interpreter = Interpreter::new(options);
    let mut block = Block::default();
    let mut opened = false;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    for (index, line) in text.lines().enumerate() {
        interpreter.line = index + 1;
        run_line(line, &mut interpreter, &mut block, &mut opened).map_err(|fault| Error::Text {
            field: options.field.clone(),
            line: index + 1,
            column: line[..fault.at].chars().count() + 1,
            found: fault.found,
            expected: fault.expected,
        })?;
        on_line(index + 1);
    }
    let mut program = interpreter.program;
    if program.unit.is_empty() {
        program.unit = if interpreter.modal.unit == INCH { "inch" } else { "mm" };
    }
    program.lines = text.lines().count();
    Ok(program)
}

/// One line: the tape's percent signs, what stands after the end, block delete, and else a block.
fn run_line<'t>(
    line: &'t str,
    interpreter: &mut Interpreter,
    block: &mut Block<'t>,
    opened: &mut bool,
) -> Result<(), WordFault> {
    let content = line.trim_start();
    let start = line.len() - content.len();
    if content.is_empty() {
        return Ok(());
    }
    if interpreter.ended() {
        if !content.starts_with(['%', '(', ';']) {
            interpreter.remark("text-after-end", || "what follows the end of the program is not read".into());
        }
        return Ok(());
    }
    if let Some(rest) = content.strip_prefix('%') {
        let rest = rest.trim();
        if !rest.is_empty() && !rest.starts_with(['(', ';']) {
            let expected = "a percent sign stands alone on its line".into();
            return Err(WordFault { at: start, found: format!("\"{}\"", content.trim_end()), expected });
        }
        if *opened || interpreter.started() {
            interpreter.end();
        }
        *opened = true;
        return Ok(());
    }
    let from = after_slash(line);
    if from > 0 && interpreter.options.block_delete {
        interpreter.ignore(content.trim_end());
        interpreter.remark("block-delete", || "lines with a slash are left out: block delete is on".into());
        return Ok(());
    }
    block.read(line, from)?;
    if block.is_empty() { Ok(()) } else { interpreter.run(block) }
}

/// The byte after the slash of a line marked for block delete (`/G1`, `/2 G1`, `N10 /G1`); 0 where
/// there is none.
fn after_slash(line: &str) -> usize {
    let blank = |text: &str| text.len() - text.trim_start().len();
    let mut at = blank(line);
    if line[at..].starts_with(['N', 'n']) {
        at += 1 + blank(&line[at + 1..]);
        at += line[at..].bytes().take_while(u8::is_ascii_digit).count();
        at += blank(&line[at..]);
    }
    match line[at..].strip_prefix('/') {
        Some(rest) => at + 1 + usize::from(rest.starts_with(|c: char| c.is_ascii_digit())),
        None => 0,
    }
}
