//! Drilling cycles, expanded hole by hole as the G-code reader expands G81, G82, G83 and G73.
//!
//! `CYCLE/DRILL,DEPTH,d,MMPM,f,CLEAR,c` with named values (ISO 4343:2000, 10.8.7), until `CYCLE/OFF`.
//! Each `GOTO` between is a hole, given at the surface: the tool goes to the clearance c above the
//! point along its axis in rapid, drills to the depth d below it, and returns in rapid to the
//! clearance, or to the height that `RETURN` gives. `DEEP` (G83) and `BRKCHP` (G73) drill in steps of
//! `STEP`; `FACE` (G82) waits at the bottom for `DWELL` in seconds. Lengths are in the text's unit.
//!
//! Every other form is refused: values by position, `FEDTO` and `RTRCTO,AUTO` mean different things in
//! different systems.

use super::reader::{Feed, Reader};
use super::statement::{AptToken, Statement, TextPlace};
use super::words;
use crate::error::Error;
use crate::path::builder;
use crate::path::gcode::PECK_CLEARANCE;
use crate::path::program::Dwell;
use crate::units::MM;
use nalgebra::Vector3;

/// Most steps in one hole; more is probably a misplaced decimal point.
const MOST_STEPS: f64 = 1000.0;
/// A bottom closer than this is reached [m].
const SAME: f64 = 1e-9;

/// A drilling cycle in force. Heights count from the point of the hole along the tool's axis [m].
#[derive(Debug, Clone, Copy)]
pub(super) struct DrillCycle {
    clearance: f64,
    depth: f64,
    retract: f64,
    /// Depth of a step [m].
    step: Option<f64>,
    /// Whether the tool leaves the hole after each step.
    clears: bool,
    /// Wait at the bottom [s].
    dwell: Option<f64>,
    feed: Option<Feed>,
    /// Line of the text, from 1.
    pub(super) line: usize,
}

/// The values of a cycle as written, each with its token.
#[derive(Default)]
struct Values<'a> {
    depth: Option<AptToken<'a>>,
    clear: Option<AptToken<'a>>,
    retract: Option<AptToken<'a>>,
    step: Option<AptToken<'a>>,
    dwell: Option<AptToken<'a>>,
    /// The unit and the number.
    feed: Option<(AptToken<'a>, AptToken<'a>)>,
}

impl<'a> Values<'a> {
    /// The values of `DEPTH,d,CLEAR,c,...`, in any order; `None` if one is unknown, missing or
    /// doubled.
    fn of(tokens: &[AptToken<'a>]) -> Option<Self> {
        let mut values = Self::default();
        for pair in tokens.chunks(2) {
            let [word, value] = pair else { return None };
            value.number()?;
            let slot = match word.text.to_ascii_uppercase().as_str() {
                "DEPTH" => &mut values.depth,
                "CLEAR" => &mut values.clear,
                "RETURN" | "RETRCT" | "RETRACT" | "RTRCTO" => &mut values.retract,
                "STEP" | "INCR" => &mut values.step,
                "DWELL" => &mut values.dwell,
                "MMPM" | "IPM" | "MMPR" | "IPR" | "PERMIN" | "PERREV" => {
                    values.feed.replace((*word, *value)).is_none().then_some(())?;
                    continue;
                }
                _ => return None,
            };
            slot.replace(*value).is_none().then_some(())?;
        }
        Some(values)
    }
}

impl<'a> Reader<'a> {
    pub(super) fn cycle(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        self.no_circle_waits()?;
        let tokens = self.tokens(statement)?;
        if let [token] = tokens.as_slice()
            && (token.is("OFF") || token.is("NOMORE"))
        {
            self.cycle = None;
            self.ignore(statement);
            return Ok(());
        }
        let unknown = || {
            let expected = words::refused("CYCLE").unwrap_or_default();
            self.error(&statement.place, statement.written(), expected)
        };
        let (kind, values) = match tokens.as_slice() {
            [drill, kind, values @ ..] if drill.is("DRILL") && (kind.is("DEEP") || kind.is("BRKCHP")) => {
                (kind, values)
            }
            [kind, values @ ..] => (kind, values),
            [] => return Err(unknown()),
        };
        let kind = ["DRILL", "FACE", "DEEP", "BRKCHP"].into_iter().find(|known| kind.is(known));
        let (Some(kind), Some(values)) = (kind, Values::of(values)) else { return Err(unknown()) };
        let steps = matches!(kind, "DEEP" | "BRKCHP");
        let (Some(depth), Some(clear)) = (values.depth, values.clear) else { return Err(unknown()) };
        if steps != values.step.is_some() || (kind == "FACE" && values.dwell.is_none()) {
            return Err(unknown());
        }
        let clearance = self.height(&clear, 0.0, "CLEAR is 0 or more, above the point of the hole")?;
        let cycle = DrillCycle {
            clearance,
            depth: self.height(&depth, SAME, "DEPTH is above 0, counted down from the point of the hole")?,
            retract: match values.retract {
                Some(token) => self.height(&token, clearance, "the tool returns to CLEAR or above")?,
                None => clearance,
            },
            step: match values.step {
                Some(token) => Some(self.height(&token, SAME, "a step is above 0")?),
                None => None,
            },
            clears: kind == "DEEP",
            dwell: values.dwell.map(|token| self.wait_of(&token)).transpose()?,
            feed: values.feed.map(|(unit, value)| self.feed_of(&value, &[unit])).transpose()?,
            line: statement.place.line,
        };
        self.check_steps(&cycle, statement)?;
        self.cycle = Some(cycle);
        self.rapid = false;
        Ok(())
    }

    /// A height [m] of at least `least`.
    fn height(&self, token: &AptToken<'a>, least: f64, expected: &str) -> Result<f64, Error> {
        let number = self.number(token)?;
        let height = builder::coordinate(number * self.unit.in_m())
            .map_err(|fault| fault.at(self.field, token.place.position()))?;
        if height < least {
            return Err(self.error(&token.place, format!("the height {number}"), expected));
        }
        Ok(height)
    }

    fn check_steps(&self, cycle: &DrillCycle, statement: &Statement<'a>) -> Result<(), Error> {
        let way = cycle.clearance + cycle.depth;
        match cycle.step {
            Some(step) if way / step > MOST_STEPS => {
                let found = format!("{:.0} steps in one hole", way / step);
                let expected =
                    format!("at most {MOST_STEPS}: STEP of at least {:.4} mm", way / MOST_STEPS / MM);
                Err(self.error(&statement.place, found, expected))
            }
            _ => Ok(()),
        }
    }

    /// Drills the hole at a point. The tool keeps its height on the way there, unless it has to rise to
    /// the clearance; where its axis turns, it goes straight to the clearance of the hole.
    pub(super) fn drill(
        &mut self,
        cycle: &DrillCycle,
        (point, axis): (Vector3<f64>, Vector3<f64>),
        place: &TextPlace<'_>,
    ) -> Result<(), Error> {
        if self.rapid {
            let found = format!("a rapid move while the cycle of line {} is active", cycle.line);
            let expected = "each GOTO is a hole here: CYCLE/OFF before RAPID ends the cycle";
            return Err(self.error(place, found, expected));
        }
        let at = |height: f64| point + axis * height;
        if let Some((from, before)) = self.builder.pose
            && (before - axis).norm() < 1e-9
        {
            let height = (from - point).dot(&axis);
            if height < cycle.clearance {
                self.rapid_to(place, from + axis * (cycle.clearance - height), axis)?;
            }
            self.rapid_to(place, at(height.max(cycle.clearance)), axis)?;
        }
        self.rapid_to(place, at(cycle.clearance), axis)?;
        if let Some(step) = cycle.step {
            let mut depth = cycle.clearance - step;
            let mut count = 1.0;
            while depth > SAME - cycle.depth {
                self.feed_to(cycle, place, at(depth), axis)?;
                if cycle.clears {
                    self.rapid_to(place, at(cycle.clearance), axis)?;
                }
                self.rapid_to(place, at(depth + PECK_CLEARANCE.min(step)), axis)?;
                count += 1.0;
                depth = cycle.clearance - step * count;
            }
        }
        self.feed_to(cycle, place, at(-cycle.depth), axis)?;
        if let Some(time) = cycle.dwell {
            let after = self.builder.program.moves.len();
            self.builder.program.dwells.push(Dwell { after, time, line: place.line });
        }
        self.rapid_to(place, at(cycle.retract), axis)
    }

    /// A straight move at the cycle's feed, or at that of FEDRAT if it has none.
    fn feed_to(
        &mut self,
        cycle: &DrillCycle,
        place: &TextPlace<'_>,
        point: Vector3<f64>,
        axis: Vector3<f64>,
    ) -> Result<(), Error> {
        let modal = self.feed;
        self.feed = cycle.feed.or(modal);
        let target = self.target(place, point, axis)?;
        self.feed = modal;
        self.builder.line_to(target).map_err(|fault| fault.at(self.field, place.position()))
    }
}
