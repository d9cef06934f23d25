//! Polar words of LinuxCNC: `@` is the distance from X0 Y0, `^` the angle from +X in degrees. They become
//! the X and Y of their line.

use super::block::Block;
use super::code::Group;
use super::interpreter::Interpreter;
use super::modal::Motion;
use super::word::{Word, WordFault, WordMode};
use crate::math;
use crate::units::DEG;

impl Interpreter<'_> {
    /// Puts X and Y in place of the polar words of a line.
    ///
    /// What is not given is that of the position; under G91 both are added to it (LinuxCNC user manual,
    /// "Polar Coordinates").
    pub(super) fn resolve_polar(&mut self, block: &mut Block) -> Result<(), WordFault> {
        let (distance, angle) = (block.take('@'), block.take('^'));
        let Some(word) = distance.or(angle) else { return Ok(()) };
        let fault = |expected: &str| Err(word.fault(block.text, expected));
        if self.modal.plane.axes()[2] != 2 {
            return fault("polar words are of the plane of G17");
        }
        if let Some(other) = block.first_of(&['X', 'Y']) {
            return Err(other.fault(block.text, "a line gives X and Y, or polar words, not both"));
        }
        if block.code(Group::NonModal).is_some() || matches!(self.modal.motion, None | Some(Motion::Cycle(_)))
        {
            return fault("polar words are of G0, G1, G2 and G3: give X and Y here");
        }
        let at = (self.position - self.origin()) / self.modal.unit;
        let incremental = self.modal.incremental;
        let (mut length, mut turn) = (0.0, 0.0);
        if incremental || distance.is_none() || angle.is_none() {
            if !self.is_certain(0) || !self.is_certain(1) {
                return fault(
                    "a distance @ and an angle ^: the position from which one is taken is not known here",
                );
            }
            length = math::hypot(at.x, at.y);
            turn = math::atan2(at.y, at.x) / DEG;
            if length == 0.0 && (incremental || angle.is_none()) {
                return fault("an angle ^ under G90: at X0 Y0 there is none to keep or to add to");
            }
        }
        let sum = |now: f64, word: Option<Word>| match word {
            Some(word) if incremental => now + word.value,
            Some(word) => word.value,
            None => now,
        };
        let (length, turn) = (sum(length, distance), sum(turn, angle));
        let (sin, cos) = math::sin_cos(turn * DEG);
        for (letter, value) in [('X', length * cos), ('Y', length * sin)] {
            block.put(Word { letter, value, mode: WordMode::Absolute, ..word });
        }
        Ok(())
    }
}
