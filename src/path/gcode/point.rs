//! Numbers without a decimal point, which some controls count in their least increment.

use super::block::Block;
use super::interpreter::Interpreter;
use super::word::Word;

/// Letters of lengths.
const LENGTHS: [char; 8] = ['X', 'Y', 'Z', 'I', 'J', 'K', 'R', 'Q'];

/// The ways in which a program has written its lengths so far.
#[derive(Debug, Default)]
pub(super) struct Points {
    /// Whether a number has had a decimal point.
    with: bool,
    /// The first word without one, other than 0, and its line.
    without: Option<(String, usize)>,
}

impl Interpreter<'_> {
    /// Remarks on a program that writes lengths with a decimal point and without.
    pub(super) fn note_points(&mut self, block: &Block) {
        if self.points.with && self.points.without.is_some() {
            return;
        }
        let is_plain =
            |word: &&Word| LENGTHS.contains(&word.letter) && !word.text(block.text).contains(['#', '[', '=']);
        for word in block.words().iter().filter(is_plain) {
            let text = word.text(block.text);
            if text.contains('.') {
                self.points.with = true;
            } else if word.value != 0.0 && self.points.without.is_none() {
                self.points.without = Some((text.to_ascii_uppercase(), self.line));
            }
        }
        if let (true, Some((text, line))) = (self.points.with, self.points.without.clone()) {
            let number = text[1..].trim();
            let unit =
                if self.modal.unit_name() == "mm" { ("mm", "0.001 mm") } else { ("inch", "0.0001 inch") };
            let message = format!(
                "{text} has no decimal point, other words have one: it is read as {number} {}; \
                 some controls count such numbers in steps of {}",
                unit.0, unit.1
            );
            let now = std::mem::replace(&mut self.line, line);
            self.remark("decimal-point-missing", || message);
            self.line = now;
        }
    }
}
