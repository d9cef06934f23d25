//! G-code (RS-274, ISO 6983) for three-axis milling. It is read as a controller would run it;
//! anything unsupported is refused with its line and column.
//!
//! A word is a letter and a number, a block is a line of words, and modal codes stay active from
//! line to line. The interpreter turns lines into the moves of a [`Program`]. The rules are those
//! of "The NIST RS274NGC Interpreter, Version 3" (Kramer, Proctor, Messina, NISTIR 6556, 2000).
//! Where controllers differ, the list states the choice made here.
//!
//! - G0, G1: straight. Rapids too, although many controllers bend theirs.
//! - G2, G3 with I J K or R, P: arcs and helices in the plane of G17, G18 (axes Z, X, seen from +Y)
//!   or G19. R below 0 selects the arc of more than half a turn. An arc that ends within 1 nm of
//!   its start is a full circle. P is the number of turns.
//! - G20 G21, G70 G71: inch, mm; they apply to the whole of their line. The default is that of the
//!   job, or mm with a remark.
//! - G90 G91, G90.1 G91.1: end points and centres, absolute or incremental. The default is G90 and
//!   G91.1.
//! - G93 G94 G95, F, S: feed in 1/minutes, length per minute, length per revolution. Without F the
//!   job's feed is used, with a remark.
//! - G54 to G59.3, G52, G92, G92.1: offsets. G54.1 P, G154 P and G110 to G129 (Haas) are at zero, with a
//!   remark, and so is what G10 sets; other values are refused.
//! - G28, G30, G53: positions of the machine. They are left out, with a remark: the tool goes up to
//!   the highest level so far if they move Z, and otherwise stays where it is. The axes that they move are
//!   not known until they are given again: nothing cuts and nothing counts from there, and what the tool
//!   does beside the workpiece is left out.
//! - `@`, `^`: polar words of LinuxCNC, a distance from X0 Y0 and an angle.
//! - G43 G44 H, G49: tool length offsets along Z, in addition to the job's tool frame.
//! - G73 G81 G82 G83 G85 G89, G80, G98 G99: drilling, expanded into moves. The default is G98. L (K)
//!   repeats. Under G91, R is relative to the level at the start of the series and the bottom is
//!   relative to R. After G80 the motion before the cycle is in force again.
//! - G4 P, X, U: wait. X and U are seconds, P what the [`GcodeDialect`] counts.
//! - M0 M1 M60, M2 M17 M30 M99, M3 M5, M6 T: the end, the spindle. Any other M is a function of the
//!   machine. It is listed, like G codes that only smooth, look ahead or end a mode.
//!
//! Everything else is an error whose message says what to do: above all cutter compensation (G41,
//! G42), scaling, rotation, polar coordinates (G16), tapping, modal macro calls (G66), rotary axes other
//! than 0 and M4. A lone `O` number in the first line names the program and is skipped.
//!
//! Variables and expressions (`expression.rs`), subprograms, macros, loops and jumps of LinuxCNC and Fanuc in
//! the same text (`flow.rs`, `call.rs`) and the words of Siemens (`siemens.rs`) are followed. On a Fanuc a
//! variable may have no value (#0): its word is passed over.

mod arc;
mod away;
mod block;
mod call;
mod code;
mod control;
mod cycle;
mod dialect;
mod expression;
mod flow;
mod drill;
mod foreign;
mod interpreter;
mod modal;
mod motion;
mod offset;
mod operator;
mod options;
mod point;
mod polar;
mod siemens;
mod siemens_word;
pub(crate) mod token;
mod variables;
mod word;

pub use dialect::GcodeDialect;
pub use drill::PECK_CLEARANCE;
pub use options::{ARC_TOLERANCE_PART, Options};

use crate::error::Error;
use crate::path::lines::TextLines;
use crate::path::program::Program;
use block::Block;
use flow::Flow;
use interpreter::Interpreter;
use variables::Variables;
use word::WordFault;

/// Reads a program. `on_line` is called after each line with the number of lines read.
///
/// Until X, Y and Z have all been given, G0 (or one G1, with a remark) only sets the start of the
/// path. A program without a move is not an error here; the result has no moves.
///
/// # Errors
/// [`Error::Text`] with line and column of the first word that is unknown, does not fit, or would
/// change the path in a way that is not modelled.
pub fn program(text: &str, options: &Options, mut on_line: impl FnMut(usize)) -> Result<Program, Error> {
    let lines = TextLines::of(text);
    let dialect = options.dialect.unwrap_or_else(|| GcodeDialect::of(text));
    if dialect != GcodeDialect::Siemens {
        foreign::check(text, &options.field)?;
    }
    let mut interpreter = Interpreter::new(options, dialect);
    let mut block = Block::default();
    let mut opened = false;
    let mut variables = Variables::of(dialect);
    let place = |index: usize, line: &str, fault: WordFault| Error::Text {
        field: options.field.clone(),
        line: index + 1,
        column: line[..fault.at].chars().count() + 1,
        found: fault.found,
        expected: fault.expected,
    };
    let jumps = flow::decides(text);
    let mut count = 0;
    if jumps {
        let parts = flow::parts(lines);
        count = parts.last().map_or(0, |(index, _)| index + 1);
        let mut block = Block::default();
        let mut flow = Flow::new(&parts, options.block_delete);
        let mut furthest = 0;
        while !interpreter.ended() {
            let next = flow.next(&mut variables);
            let next = next.map_err(|(index, fault)| place(flow.sources[index], flow.lines[index], fault))?;
            let Some(piece) = next else { break };
            let (index, line) = (flow.sources[piece], flow.lines[piece]);
            interpreter.line = index + 1;
            run_line(line, &mut interpreter, &mut block, &mut variables, &mut opened)
                .map_err(|fault| place(index, line, fault))?;
            if index + 1 > furthest {
                furthest = index + 1;
                on_line(furthest);
            }
        }
    } else {
        for (index, line) in lines.enumerate() {
            count = index + 1;
            interpreter.line = count;
            run_line(line, &mut interpreter, &mut block, &mut variables, &mut opened)
                .map_err(|fault| place(index, line, fault))?;
            on_line(count);
        }
    }
    let mut program = interpreter.program;
    program.dialect = Some(dialect);
    program.jumps = jumps;
    if program.unit.is_empty() {
        program.unit = interpreter.modal.unit_name();
    }
    program.lines = count;
    Ok(program)
}

/// Handles one line: percent signs, text after the end, block delete, or a block.
fn run_line<'t>(
    line: &'t str,
    interpreter: &mut Interpreter,
    block: &mut Block<'t>,
    variables: &mut Variables,
    opened: &mut bool,
) -> Result<(), WordFault> {
    let content = line.trim_start();
    if content.is_empty() {
        return Ok(());
    }
    if interpreter.ended() {
        if !content.starts_with(['%', '(', ';']) {
            interpreter
                .remark("text-after-end", || "the text after the end of the program is ignored".into());
        }
        return Ok(());
    }
    if let Some(rest) = content.strip_prefix('%') {
        let rest = rest.trim();
        if !rest.is_empty() && !rest.starts_with(['(', ';']) {
            // The name or number of the program, or a note.
            interpreter.ignore(content.trim_end());
            *opened = true;
            return Ok(());
        }
        if *opened || interpreter.started() {
            interpreter.end();
        }
        *opened = true;
        return Ok(());
    }
    let from = if content.starts_with(['N', 'n', '/']) { after_slash(line) } else { 0 };
    if from > 0 && interpreter.options.block_delete {
        interpreter.ignore(content.trim_end());
        interpreter
            .remark("block-delete", || "lines with a slash are skipped: block delete is assumed on".into());
        return Ok(());
    }
    let line = without_tail(line, interpreter);
    let siemens = (interpreter.dialect == GcodeDialect::Siemens).then_some(&mut interpreter.siemens);
    block.read(line, from, variables, siemens)?;
    if variables.used_vacant.take() {
        interpreter.remark("vacant-variable", || {
            "a variable without a value is used here: its word is ignored, and in sums it counts as 0 (Fanuc)"
                .into()
        });
    }
    if interpreter.dialect == GcodeDialect::Fanuc {
        interpreter.note_points(block);
    }
    if block.is_empty() { Ok(()) } else { interpreter.run(block) }
}

/// A line without what no motion hangs on: a command to the sender (`$H`), the text of M117, the
/// checksum of a line, and what a slash in it leaves to the operator.
fn without_tail<'t>(line: &'t str, interpreter: &mut Interpreter) -> &'t str {
    if !line.bytes().any(|sign| matches!(sign, b'$' | b'*' | b'/' | b'M' | b'm')) {
        return line;
    }
    let mut end = line.len();
    let computed = line.find(['#', '=', '[']).unwrap_or(line.len());
    let mut stopped = false;
    for token in token::tokens(line, after_slash(line)) {
        let text = token.text;
        // Behind a variable or an equals sign, a slash divides and a star multiplies.
        if token.start > computed {
            break;
        }
        if token.kind != token::Kind::Word {
            continue;
        }
        let skipped = match text.as_bytes()[0] {
            b'$' => interpreter.dialect != GcodeDialect::Siemens,
            b'*' => {
                line[token.end()..].trim().is_empty() && text[1..].bytes().all(|sign| sign.is_ascii_digit())
            }
            b'/' => interpreter.options.block_delete,
            b'M' | b'm' if text[1..].trim_ascii_start() == "117" => true,
            // A stop may have a message for the operator.
            b'M' | b'm' if !stopped && ["0", "00", "1", "01"].contains(&text[1..].trim_ascii_start()) => {
                stopped = true;
                let rest = line[token.end()..].split(['(', ';']).next().unwrap_or_default();
                let is_note = rest.trim().len() > 1
                    && !rest.contains(['#', '[', '='])
                    && !rest.bytes().any(|sign| sign.is_ascii_digit());
                if is_note {
                    interpreter.ignore(rest.trim());
                    end = token.end();
                    break;
                }
                false
            }
            _ => false,
        };
        if skipped {
            interpreter.ignore(line[token.start..].trim_end());
            end = token.start;
            break;
        }
    }
    &line[..end]
}

/// The byte after the slash of a line marked for block delete (`/G1`, `/2 G1`, `N10 /G1`); 0
/// without a slash.
pub(crate) fn after_slash(line: &str) -> usize {
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
