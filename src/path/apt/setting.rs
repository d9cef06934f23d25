//! Statements that set a state (FEDRAT, SPINDL, UNITS), and waits.

use super::reader::{Feed, Reader};
use super::statement::Statement;
use crate::error::Error;
use crate::path::builder::{self, LONGEST_WAIT, SPINDLE};
use crate::path::program::{Dwell, Tool};
use crate::path::unit::LengthUnit;
use crate::units::{INCH, MINUTE, MM, RPM};

impl<'a> Reader<'a> {
    pub(super) fn feed(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        let tokens = self.tokens(statement)?;
        let (value, word) = match tokens.as_slice() {
            [value] => (value, None),
            [first, second] if first.number().is_some() => (first, Some(second)),
            [first, second] => (second, Some(first)),
            _ => {
                let found = format!("FEDRAT with {} values", tokens.len());
                return Err(self.error(&statement.end(), found, "a feed is FEDRAT/f or FEDRAT/f,MMPM"));
            }
        };
        let number = self.number(value)?;
        let (inch, mm) = (INCH * number, MM * number);
        let own = self.unit.in_m() * number;
        let unit = word.map_or(String::new(), |word| word.text.to_ascii_uppercase());
        self.feed = Some(match unit.as_str() {
            "" | "PERMIN" => Feed::PerTime(own / MINUTE),
            "PERREV" => Feed::PerTurn(own),
            "MMPM" => Feed::PerTime(mm / MINUTE),
            "IPM" => Feed::PerTime(inch / MINUTE),
            "MMPR" => Feed::PerTurn(mm),
            "IPR" => Feed::PerTurn(inch),
            _ => {
                let place = word.map_or(value.place, |word| word.place);
                return Err(self.error(&place, format!("\"{unit}\""), "a feed is in MMPM, IPM, MMPR or IPR"));
            }
        });
        if number <= 0.0 {
            return Err(self.error(&value.place, format!("the feed {number}"), "a feed is larger than 0"));
        }
        match self.feed {
            Some(Feed::PerTime(feed)) => {
                builder::feed(feed).map_err(|fault| fault.at(self.field, value.place.position()))?;
            }
            _ => {
                builder::coordinate(own).map_err(|fault| fault.at(self.field, value.place.position()))?;
            }
        }
        let line = statement.place.line;
        match (unit.starts_with('I'), unit.starts_with("MM"), self.unit) {
            (true, _, LengthUnit::Mm) | (_, true, LengthUnit::Inch) => {
                let lengths = self.unit.name();
                self.builder.remark("feed-unit", line, || {
                    format!("the feed is in {unit}, but lengths are in {lengths}")
                });
            }
            _ => {}
        }
        Ok(())
    }

    pub(super) fn spindle(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        let tokens = self.tokens(statement)?;
        let mut speed = None;
        for token in &tokens {
            match token.number() {
                Some(rpm) if speed.is_none() && SPINDLE.contains(&rpm) => speed = Some(rpm * RPM),
                Some(rpm) => {
                    let expected = "one speed, from 1 to 1000000 rpm; SPINDL/OFF stops the spindle";
                    return Err(self.error(&token.place, format!("the spindle speed {rpm}"), expected));
                }
                None if token.is("RPM") || token.is("CLW") || token.is("ON") => {}
                None if token.is("OFF") && tokens.len() == 1 => {
                    self.spinning = false;
                    return Ok(());
                }
                None => {
                    let expected = if token.is("CCLW") {
                        "the cutting model is for a clockwise spindle: use a right-hand tool and CLW"
                    } else if token.is("SFM") || token.is("SMM") {
                        "surface speed needs a diameter: let the CAM system write RPM"
                    } else {
                        "the spindle is SPINDL/RPM,n,CLW or SPINDL/ON or SPINDL/OFF"
                    };
                    return Err(self.error(&token.place, format!("\"{}\"", token.text), expected));
                }
            }
        }
        self.speed = speed.or(self.speed);
        self.spinning = true;
        Ok(())
    }

    /// Records the diameter of `CUTTER/d,...` and of a mill's `TLDATA/MILL,d,...`, in the text's
    /// unit. The path is that of the tip, whatever the tool.
    pub(super) fn tool(&mut self, statement: &Statement<'a>) {
        let Ok(tokens) = statement.tokens() else { return };
        let diameter = match tokens.as_slice() {
            [kind, diameter, ..] if kind.is("MILL") => diameter.number(),
            [diameter, ..] => diameter.number(),
            [] => None,
        };
        if let Some(diameter) = diameter.filter(|diameter| *diameter > 0.0) {
            self.builder.program.tools.push(Tool { diameter, line: statement.place.line });
        }
    }

    pub(super) fn units(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        let place = &statement.place;
        let unit = match self.words(statement, &["MM", "INCHES", "INCH", "IN"])? {
            Some("MM") => LengthUnit::Mm,
            Some(_) => LengthUnit::Inch,
            None => return Err(self.error(&statement.end(), "nothing", "UNITS is followed by MM or INCHES")),
        };
        if let (Some(line), true) = (self.first_length, unit != self.unit) {
            let found =
                format!("{} after lengths in {} (line {line})", statement.written(), self.unit.name());
            return Err(self.error(
                place,
                found,
                "UNITS stands before the first length and holds to the end",
            ));
        }
        self.unit = unit;
        self.unit_said = true;
        Ok(())
    }

    pub(super) fn dwell(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        let tokens = self.tokens(statement)?;
        let token = match tokens.as_slice() {
            [token] => token,
            [word, token] if word.is("DWELL") => token,
            _ => {
                let place = tokens.get(1).map_or(statement.end(), |token| token.place);
                return Err(self.error(&place, statement.written(), "a wait is DELAY/t, in seconds"));
            }
        };
        let time = self.number(token)?;
        if !(0.0..=LONGEST_WAIT).contains(&time) {
            return Err(self.error(
                &token.place,
                format!("a wait of {time} s"),
                format!("a wait is 0 to {LONGEST_WAIT} s"),
            ));
        }
        let after = self.builder.program.moves.len();
        self.builder.program.dwells.push(Dwell { after, time, line: statement.place.line });
        Ok(())
    }
}
