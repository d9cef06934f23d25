//! Modal state, and the codes that set it.

use super::arc::Plane;
use super::block::Block;
use super::code::Group;
use super::cycle::Cycle;
use super::word::WordFault;
use crate::path::builder::{self, SPINDLE};
use crate::units::{INCH, MM, RPM};

/// The active motion, made by a line with axis words.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Motion {
    /// G0.
    Rapid,
    /// G1.
    Line,
    /// G2, G3.
    Arc {
        /// G3.
        counter_clockwise: bool,
    },
    /// G73, G81 to G83, G85, G89.
    Cycle(Cycle),
}

/// The meaning of F.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FeedMode {
    /// G93: a move takes 1/F minutes.
    InverseTime,
    /// G94: length per minute.
    PerMinute,
    /// G95: length per spindle revolution.
    PerRevolution,
}

/// The modal state.
#[derive(Debug, Clone)]
pub(super) struct Modal {
    /// `None` at the start.
    pub(super) motion: Option<Motion>,
    /// G0 to G3 before the canned cycles, in force again after G80.
    before_cycle: Option<Motion>,
    pub(super) plane: Plane,
    /// Length of one unit [m].
    pub(super) unit: f64,
    /// Whether the program has set its unit.
    pub(super) unit_said: bool,
    /// G91.
    pub(super) incremental: bool,
    /// G90.1.
    pub(super) centers_absolute: bool,
    pub(super) feed_mode: FeedMode,
    /// F in SI: m/s in G94, m per revolution in G95, 1/s in G93 (for its own line only).
    pub(super) feed: Option<f64>,
    /// S [1/s].
    speed: Option<f64>,
    /// M5.
    spindle_off: bool,
    /// G98: cycles return to the level at which they started; G99: to R.
    pub(super) returns_to_start: bool,
    /// T of the last line that has one.
    pub(super) tool: Option<f64>,
}

impl Default for Modal {
    fn default() -> Self {
        Self {
            motion: None,
            before_cycle: None,
            plane: Plane::Xy,
            unit: MM,
            unit_said: false,
            incremental: false,
            centers_absolute: false,
            feed_mode: FeedMode::PerMinute,
            feed: None,
            speed: None,
            spindle_off: false,
            returns_to_start: true,
            tool: None,
        }
    }
}

impl Modal {
    /// The state at the start, with the length of one unit [m].
    pub(super) fn starting_in(unit: f64) -> Self {
        Self { unit, ..Self::default() }
    }

    /// Name of the unit of length.
    pub(super) fn unit_name(&self) -> &'static str {
        if self.unit == INCH { "inch" } else { "mm" }
    }

    /// Puts the motion before a canned cycle in force again.
    pub(super) fn end_cycle(&mut self) {
        self.motion = self.before_cycle;
    }

    /// Spindle speed [1/s], if the program sets one above 0.
    pub(super) fn spindle(&self) -> Option<f64> {
        self.speed.filter(|&speed| speed > 0.0)
    }

    /// Whether the program has stopped the spindle.
    pub(super) fn spindle_stopped(&self) -> bool {
        self.spindle_off || self.speed == Some(0.0)
    }

    /// Applies the codes that set a state, then F and S, which use the unit and feed mode of their
    /// own line.
    pub(super) fn set(&mut self, block: &mut Block) -> Result<(), WordFault> {
        if let Some(code) = block.code(Group::Unit) {
            self.unit = if matches!(code.tenths, 200 | 700 | 7000) { INCH } else { MM };
            self.unit_said = true;
        }
        if let Some(code) = block.code(Group::Plane) {
            self.plane = match code.tenths {
                170 => Plane::Xy,
                180 => Plane::Zx,
                _ => Plane::Yz,
            };
        }
        if let Some(code) = block.code(Group::Distance) {
            self.incremental = code.tenths == 910;
        }
        if let Some(code) = block.code(Group::ArcDistance) {
            self.centers_absolute = code.tenths == 901;
        }
        if let Some(code) = block.code(Group::Retract) {
            self.returns_to_start = code.tenths == 980;
        }
        if let Some(code) = block.code(Group::FeedMode) {
            let mode = match code.tenths {
                930 => FeedMode::InverseTime,
                940 => FeedMode::PerMinute,
                _ => FeedMode::PerRevolution,
            };
            if mode != self.feed_mode {
                // A feed is meaningless in another feed mode.
                self.feed = None;
            }
            self.feed_mode = mode;
        }
        if let Some(code) = block.code(Group::Spindle) {
            self.spindle_off = code.tenths == 50;
        }
        self.set_motion(block)?;
        self.set_feed(block)?;
        self.set_speed(block)
    }

    fn set_motion(&mut self, block: &Block) -> Result<(), WordFault> {
        let motion = block.code(Group::Motion);
        let cycle = block.code(Group::Cycle);
        if let (Some(_), Some(cycle)) = (motion, cycle)
            && cycle.tenths != 800
        {
            let expected = "a line holds one motion: only one of G0 to G3 and the canned cycles";
            return Err(cycle.word.fault(block.text, expected));
        }
        if let Some(motion) = motion {
            let given = match motion.tenths {
                0 => Motion::Rapid,
                10 => Motion::Line,
                tenths => Motion::Arc { counter_clockwise: tenths == 30 },
            };
            self.before_cycle = Some(given);
            // One that is called at each position stays.
            if !matches!(self.motion, Some(Motion::Cycle(cycle)) if cycle.is_called) {
                self.motion = Some(given);
            }
        } else if let Some(code) = cycle {
            self.motion = match self.motion {
                // Cycles are a group of their own on most controllers; LinuxCNC has no motion then.
                _ if code.tenths == 800 => self.before_cycle,
                Some(Motion::Cycle(cycle)) => Some(Motion::Cycle(cycle.or_new(code.tenths))),
                _ => Some(Motion::Cycle(Cycle::new(code.tenths))),
            };
        }
        Ok(())
    }

    fn set_feed(&mut self, block: &mut Block) -> Result<(), WordFault> {
        if self.feed_mode == FeedMode::InverseTime {
            self.feed = None;
        }
        // A dwell's F is its time.
        if block.has(Group::NonModal, 40) && block.first_of(&['P', 'X', 'U']).is_none() {
            return Ok(());
        }
        let Some(word) = block.take('F') else { return Ok(()) };
        if word.value <= 0.0 {
            return Err(word.fault(block.text, "a feed is greater than 0"));
        }
        self.feed = Some(match self.feed_mode {
            FeedMode::InverseTime => word.value / 60.0,
            FeedMode::PerMinute => builder::feed(word.value * self.unit / 60.0)
                .map_err(|fault| word.fault(block.text, fault.expected))?,
            FeedMode::PerRevolution => word.value * self.unit,
        });
        Ok(())
    }

    fn set_speed(&mut self, block: &mut Block) -> Result<(), WordFault> {
        let Some(word) = block.take('S') else { return Ok(()) };
        if !(word.value == 0.0 || SPINDLE.contains(&word.value)) {
            let expected = "a spindle speed is 0, or 1 to 1000000 rpm";
            return Err(word.fault(block.text, expected));
        }
        self.speed = Some(word.value * RPM);
        Ok(())
    }
}
