//! Canned drilling cycles: the active one and its sticky words.

use super::block::Block;
use super::word::{Word, WordFault, WordMode};

/// The active cycle, with the words that carry over from hole to hole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cycle {
    /// G code number in tenths.
    pub(super) tenths: u32,
    /// Level along the plane's normal at the start of the series of cycles [m].
    pub(super) start: Option<f64>,
    /// R: clearance plane.
    pub(super) clearance: Option<Level>,
    /// The word along the normal (Z in G17): bottom of the hole.
    pub(super) bottom: Option<Level>,
    /// Q: peck depth [m].
    pub(super) peck: Option<f64>,
    /// P: dwell at the bottom [s].
    pub(super) dwell: Option<f64>,
    /// Whether it is called at each position, however the tool gets there (Siemens MCALL).
    pub(super) is_called: bool,
    /// Level from which pecks count, if not the clearance plane [m].
    pub(super) surface: Option<f64>,
}

/// A programmed height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Level {
    /// [m].
    pub(super) value: f64,
    /// Programmed under G91.
    pub(super) incremental: bool,
}

impl Cycle {
    /// A cycle that starts a series.
    pub(super) fn new(tenths: u32) -> Self {
        Self {
            tenths,
            start: None,
            clearance: None,
            bottom: None,
            peck: None,
            dwell: None,
            surface: None,
            is_called: false,
        }
    }

    /// The cycle for this code. A repeated code keeps its words; another code continues the series
    /// but needs words of its own.
    pub(super) fn or_new(self, tenths: u32) -> Self {
        if tenths == self.tenths { self } else { Self { start: self.start, ..Self::new(tenths) } }
    }

    /// Whether it drills in pecks of Q.
    pub(super) fn pecks(&self) -> bool {
        matches!(self.tenths, 730 | 830)
    }

    /// Whether it always waits at the bottom for P.
    pub(super) fn dwells(&self) -> bool {
        matches!(self.tenths, 820 | 890)
    }

    /// Consumes the words of this cycle; absent words keep their values.
    pub(super) fn update(
        &mut self,
        block: &mut Block,
        normal: char,
        unit: f64,
        incremental: bool,
    ) -> Result<(), WordFault> {
        let level = |word: Word| Level {
            value: word.value * unit,
            incremental: incremental && word.mode == WordMode::Modal,
        };
        self.clearance = block.take('R').map(level).or(self.clearance);
        self.bottom = block.take(normal).map(level).or(self.bottom);
        if self.pecks()
            && let Some(word) = block.take('Q')
        {
            if word.value < 0.0 {
                return Err(word.fault(block.text, "the depth of a peck is 0 (no pecking) or more"));
            }
            // A depth of 0 drills in one go.
            self.peck = Some(if word.value > 0.0 { word.value * unit } else { f64::INFINITY });
        }
        Ok(())
    }
}
