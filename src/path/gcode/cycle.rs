//! A canned drilling cycle: which one is in force, and the words that stay from hole to hole.

use super::block::Block;
use super::word::{Word, WordFault};

/// A cycle in force, with the words that stay from hole to hole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cycle {
    /// Number of its G code in tenths.
    pub(super) tenths: u32,
    /// Level along the plane's normal at which the series of cycles began [m].
    pub(super) start: Option<f64>,
    /// R: clearance plane.
    pub(super) clearance: Option<Level>,
    /// The word along the normal (Z in G17): bottom of the hole.
    pub(super) bottom: Option<Level>,
    /// Q: depth of a peck [m].
    pub(super) peck: Option<f64>,
    /// P: dwell at the bottom [s].
    pub(super) dwell: Option<f64>,
}

/// A height as programmed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Level {
    /// [m].
    pub(super) value: f64,
    /// Programmed under G91.
    pub(super) incremental: bool,
}

impl Cycle {
    /// A cycle that begins a series.
    pub(super) fn new(tenths: u32) -> Self {
        Self { tenths, start: None, clearance: None, bottom: None, peck: None, dwell: None }
    }

    /// This cycle named again, or another one in the same series: that one needs its own words.
    pub(super) fn or_new(self, tenths: u32) -> Self {
        if tenths == self.tenths { self } else { Self { start: self.start, ..Self::new(tenths) } }
    }

    /// Whether it drills in steps of Q.
    pub(super) fn pecks(&self) -> bool {
        matches!(self.tenths, 730 | 830)
    }

    /// Whether it waits at the bottom for P.
    pub(super) fn dwells(&self) -> bool {
        matches!(self.tenths, 820 | 890)
    }

    /// Takes the words of this cycle; those that are not there stay as they were.
    pub(super) fn update(
        &mut self,
        block: &mut Block,
        normal: char,
        unit: f64,
        incremental: bool,
    ) -> Result<(), WordFault> {
        let level = |word: Word| Level { value: word.value * unit, incremental };
        self.clearance = block.take('R').map(level).or(self.clearance);
        self.bottom = block.take(normal).map(level).or(self.bottom);
        if self.pecks()
            && let Some(word) = block.take('Q')
        {
            if word.value <= 0.0 {
                return Err(word.fault(block.text, "the depth of a peck is greater than 0"));
            }
            self.peck = Some(word.value * unit);
        }
        if self.dwells()
            && let Some(word) = block.take('P')
        {
            if word.value < 0.0 {
                return Err(word.fault(block.text, "a dwell is 0 or more seconds"));
            }
            self.dwell = Some(word.value);
        }
        Ok(())
    }
}
