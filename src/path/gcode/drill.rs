//! Expands canned drilling cycles into moves (NIST, "The NIST RS274NGC Interpreter", version 3,
//! section 3.5.16).

use super::arc::SAME;
use super::block::Block;
use super::code::Group;
use super::cycle::{Cycle, Level};
use super::interpreter::{AXES, Interpreter};
use super::modal::{FeedMode, Motion};
use super::word::WordFault;
use nalgebra::Vector3;

/// Chip-breaking retract of G73, and height above the last depth at which G83 slows down from rapid
/// [m]: 0.010 inch, as in LinuxCNC.
pub const PECK_CLEARANCE: f64 = 0.254e-3;

/// Most holes in one line, and most pecks in one hole; more is probably a misplaced decimal point.
const MOST: u32 = 1000;

/// The heights of one hole [m].
#[derive(Debug, Clone, Copy)]
struct Hole {
    clearance: f64,
    bottom: f64,
    retract: f64,
}

impl Interpreter<'_> {
    /// Drills the holes of a line.
    ///
    /// Under G91, R is relative to the level at the start of the series and the bottom is relative
    /// to R. L repeats the hole at equal steps.
    pub(super) fn drill(&mut self, mut cycle: Cycle, block: &mut Block) -> Result<(), WordFault> {
        let normal = self.modal.plane.axes()[2];
        let letter = AXES[normal];
        let place = block.code(Group::Cycle).map_or(block.start(), |code| code.word.start);
        let fault = |found: String, expected: &str| WordFault { at: place, found, expected: expected.into() };
        let name = format!("G{}", cycle.tenths / 10);
        if self.modal.feed_mode == FeedMode::InverseTime {
            return Err(fault(
                format!("{name} under G93"),
                "a canned cycle needs a feed per minute (G94) or per revolution (G95)",
            ));
        }
        if cycle.is_called
            && let Some(word) = block.peek(letter)
        {
            return Err(
                word.fault(block.text, "between MCALL and its end the tool moves across the holes only")
            );
        }
        cycle.update(block, letter, self.modal.unit, self.modal.incremental)?;
        if let Some(word) = block.take('P') {
            cycle.dwell = Some(self.dwell_time(word, block)?);
        }
        // L in the standard, K on a Fanuc.
        let repeats = match block.take('L').or_else(|| block.take('K')) {
            Some(word) => word.whole(block.text, 0, MOST)?,
            None => 1,
        };
        let level = self.position[normal];
        if let Some(given) = block.cycle {
            let absolute = |value: f64| value * self.modal.unit + self.origin()[normal];
            (cycle.start, cycle.surface) = (Some(absolute(given.level)), Some(absolute(given.surface)));
            cycle.is_called = given.stays;
        }
        let start = *cycle.start.get_or_insert(level);
        self.modal.motion = Some(Motion::Cycle(cycle));
        if cycle.clearance.is_none() {
            self.remark("cycle-clearance", || {
                format!("{name} has no R (clearance plane): the previous level is used")
            });
        }
        let absolute = |level: Level| level.value + self.origin()[normal];
        let clearance = cycle.clearance.unwrap_or(Level { value: 0.0, incremental: true });
        let Some(bottom) = cycle.bottom else {
            return Err(fault(
                format!("{name} without a depth"),
                &format!("{name} needs {letter} (bottom of the hole)"),
            ));
        };
        let clearance = if clearance.incremental { start + clearance.value } else { absolute(clearance) };
        let bottom = if bottom.incremental { clearance + bottom.value } else { absolute(bottom) };
        if bottom > clearance {
            return Err(fault(
                format!("a hole with its bottom {:.3} mm above R", (bottom - clearance) * 1e3),
                "R must be above the bottom of the hole",
            ));
        }
        let retract = if self.modal.returns_to_start { start.max(clearance) } else { clearance };
        self.check_cycle(&cycle, clearance - bottom, &name, place)?;
        for _ in 0..repeats {
            let before = self.position;
            let mut over = self.target(block)?;
            over[normal] = before[normal];
            if over[normal] < clearance {
                self.rapid_to_level(normal, clearance)?;
                over[normal] = clearance;
            }
            self.rapid(over)?;
            self.hole(&cycle, normal, Hole { clearance, bottom, retract }, place)?;
        }
        for letter in AXES {
            block.take(letter);
        }
        if block.cycle.is_some_and(|given| !given.stays) {
            self.modal.end_cycle();
        }
        Ok(())
    }

    /// Fails if the cycle lacks a word, or pecks too often.
    fn check_cycle(&self, cycle: &Cycle, depth: f64, name: &str, at: usize) -> Result<(), WordFault> {
        if cycle.dwells() && cycle.dwell.is_none() {
            let expected = format!("{name} waits at the bottom: give P in seconds");
            return Err(WordFault { at, found: format!("{name} without P"), expected });
        }
        if cycle.pecks() {
            let Some(peck) = cycle.peck else {
                let expected = format!("{name} drills in steps: give the depth of a step, Q");
                return Err(WordFault { at, found: format!("{name} without Q"), expected });
            };
            if depth / peck > f64::from(MOST) {
                let least = depth / f64::from(MOST) * 1e3;
                let found = format!("{:.0} pecks in one hole", depth / peck);
                return Err(WordFault {
                    at,
                    found,
                    expected: format!("at most {MOST}: Q of at least {least:.4} mm"),
                });
            }
        }
        Ok(())
    }

    /// Drills one hole; the tool is above it.
    fn hole(&mut self, cycle: &Cycle, normal: usize, hole: Hole, at: usize) -> Result<(), WordFault> {
        self.rapid_to_level(normal, hole.clearance)?;
        if let Some(peck) = cycle.peck {
            let lift = PECK_CLEARANCE.min(peck);
            let mut step = 1.0;
            let top = cycle.surface.unwrap_or(hole.clearance);
            while top - peck * step > hole.bottom + SAME {
                let depth = top - peck * step;
                self.feed_to_level(normal, depth, at)?;
                if cycle.tenths == 830 {
                    self.rapid_to_level(normal, hole.clearance)?;
                }
                self.rapid_to_level(normal, depth + lift)?;
                step += 1.0;
            }
        }
        self.feed_to_level(normal, hole.bottom, at)?;
        if let Some(time) = cycle.dwell {
            self.wait(time);
        }
        if matches!(cycle.tenths, 850 | 890) {
            // Up to R only, as on controllers. LinuxCNC does the same in G85, but in G89 feeds up
            // to the level of G98.
            self.feed_to_level(normal, hole.clearance, at)?;
        }
        self.rapid_to_level(normal, hole.retract)
    }

    fn at_level(&self, normal: usize, level: f64) -> Vector3<f64> {
        let mut point = self.position;
        point[normal] = level;
        point
    }

    fn rapid_to_level(&mut self, normal: usize, level: f64) -> Result<(), WordFault> {
        self.rapid(self.at_level(normal, level))
    }

    fn feed_to_level(&mut self, normal: usize, level: f64, at: usize) -> Result<(), WordFault> {
        self.feed(self.at_level(normal, level), at)
    }
}
