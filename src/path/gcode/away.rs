//! Moves to positions of the machine, which are left out, and the way back to the workpiece.

use super::block::Block;
use super::code::Group;
use super::interpreter::{AXES, Interpreter};
use super::modal::Motion;
use super::word::{Word, WordFault};
use nalgebra::Vector3;

impl Interpreter<'_> {
    /// A move to a position of the machine: G53, G28, G30. Where that lies from the workpiece is not
    /// known, and an arm has no such position. The tool stays where it is, or goes up to the highest
    /// level so far, because such a move takes it out of the way.
    pub(super) fn leave_out(&mut self, block: &mut Block) -> Result<(), WordFault> {
        let code = block.code(Group::NonModal);
        let axes: Vec<Word> =
            ['X', 'Y', 'Z', 'A', 'B', 'C'].iter().filter_map(|&axis| block.take(axis)).collect();
        if let Some(word) = axes.iter().find(|word| word.letter < 'X' && word.value != 0.0) {
            return Err(
                word.fault(block.text, "rotary axes are not supported in G-code: post for three axes")
            );
        }
        // G30 P2 is the second of them.
        block.take('P');
        let up = axes.is_empty() || axes.iter().any(|word| word.letter == 'Z');
        if !up && self.known[2] && self.tip.z < self.highest {
            let at = axes.first().map_or(block.start(), |word| word.start);
            return Err(WordFault {
                at,
                found: "a move to a machine position with the tool down".into(),
                expected: "lift the tool first, in a line of its own: it is not known where this move leads"
                    .into(),
            });
        }
        for word in &axes {
            self.ignore(word.text(block.text));
        }
        let name = code.map_or_else(String::new, |code| code.word.text(block.text).to_ascii_uppercase());
        self.ignore(&name);
        self.remark("machine-zero", || {
            format!(
                "{name} goes to a machine position, which has no place in the workpiece frame: such moves are \
                 left out, and the tool stays clear where it is"
            )
        });
        for (axis, letter) in AXES.into_iter().enumerate() {
            let goes = axes.is_empty() || axes.iter().any(|word| word.letter == letter);
            self.away[axis] |= goes && self.known[axis];
        }
        // The codes of the line stay in force.
        if up && !self.known.contains(&false) && self.tip.z < self.highest {
            let mut clear = self.position;
            clear.z = self.highest;
            self.rapid(clear)?;
        }
        Ok(())
    }

    /// Whether the place of an axis in the workpiece is known: not at the start, and not behind a move to
    /// a position of the machine.
    pub(super) fn is_certain(&self, axis: usize) -> bool {
        self.known[axis] && !self.away[axis]
    }

    /// The axes that the move being made has words for are back in the workpiece.
    pub(super) fn come_back(&mut self) {
        for (away, given) in self.away.iter_mut().zip(self.given) {
            *away &= !given;
        }
    }

    /// Handles a straight move while the tool is at a position of the machine. As long as X and Y are not
    /// both given, it stays where it was left: what such lines say, the next ones start from.
    ///
    /// # Errors
    /// If it cuts there.
    pub(super) fn stays_away(&mut self, to: Vector3<f64>, block: &Block) -> Result<bool, WordFault> {
        if self.away == [false; 3] {
            return Ok(false);
        }
        let (was_beside, low) = (self.away[0] || self.away[1], self.position.z < self.tip.z);
        self.come_back();
        if self.away[0] || self.away[1] {
            if self.modal.motion != Some(Motion::Rapid) {
                self.all_back(2, block)?;
            }
            self.position = to;
            return Ok(true);
        }
        // It has come down beside the workpiece: over the place first, then down.
        if was_beside && low {
            let mut over = to;
            over.z = self.tip.z;
            self.rapid(over)?;
        }
        Ok(false)
    }

    /// The line of a hole may bring the tool back over the workpiece: at the height at which it was left.
    pub(super) fn return_over_hole(&mut self, block: &Block) -> Result<(), WordFault> {
        let gives = |axis: usize| !self.away[axis] || block.peek(AXES[axis]).is_some();
        if !(self.away[0] || self.away[1]) || self.modal.incremental || !(gives(0) && gives(1)) {
            return Ok(());
        }
        let (level, mut over) = (self.position.z, self.target(block)?);
        over.z = level.max(self.tip.z);
        self.rapid(over)?;
        self.position.z = level;
        (self.away[0], self.away[1]) = (false, false);
        Ok(())
    }

    /// Fails if the first `axes` of X, Y and Z have one that is at a position of the machine.
    pub(super) fn all_back(&self, axes: usize, block: &Block) -> Result<(), WordFault> {
        match AXES.iter().zip(self.away).take(axes).find(|(_, away)| *away) {
            None => Ok(()),
            Some((axis, _)) => Err(WordFault {
                at: block.start(),
                found: format!("a cut while the tool is at a machine position in {axis}"),
                expected: format!(
                    "first bring the tool back to the workpiece with a G0 line that has {axis}"
                ),
            }),
        }
    }
}
