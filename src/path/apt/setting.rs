//! Statements that set a state (FEDRAT, SPINDL, UNITS), and waits.

use super::reader::{Feed, Reader};
use super::statement::{AptToken, Statement};
use crate::error::Error;
use crate::path::builder::{self, LONGEST_WAIT, SPINDLE};
use crate::path::program::{Dwell, Tool};
use crate::path::unit::LengthUnit;
use crate::units::{MINUTE, RPM};

/// What a word says of a feed: whether it is per revolution, and its unit of length.
fn feed_word(word: &str) -> Option<(Option<bool>, Option<LengthUnit>)> {
    Some(match word {
        "PERMIN" => (Some(false), None),
        "PERREV" => (Some(true), None),
        "MMPM" => (Some(false), Some(LengthUnit::Mm)),
        "MMPR" => (Some(true), Some(LengthUnit::Mm)),
        "IPM" => (Some(false), Some(LengthUnit::Inch)),
        "IPR" => (Some(true), Some(LengthUnit::Inch)),
        _ => return None,
    })
}

impl<'a> Reader<'a> {
    pub(super) fn feed(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        let tokens = self.tokens(statement)?;
        let (values, words): (Vec<_>, Vec<_>) =
            tokens.iter().copied().partition(|token| token.number().is_some());
        match values.as_slice() {
            [value] if words.len() <= 2 => self.feed = Some(self.feed_of(value, &words)?),
            _ => {
                let found = format!("FEDRAT with {} values", tokens.len());
                return Err(self.error(&statement.end(), found, "a feed is FEDRAT/f or FEDRAT/f,MMPM"));
            }
        }
        Ok(())
    }

    /// A feed, in the text's unit of length a minute unless words say another.
    pub(super) fn feed_of(&mut self, value: &AptToken<'a>, words: &[AptToken<'a>]) -> Result<Feed, Error> {
        let number = self.number(value)?;
        let (mut per_turn, mut length) = (None, None);
        for word in words {
            let known = feed_word(&word.text.to_ascii_uppercase());
            let agrees = known.is_some_and(|(turn, unit)| {
                turn.is_none_or(|turn| *per_turn.get_or_insert(turn) == turn)
                    && unit.is_none_or(|unit| *length.get_or_insert(unit) == unit)
            });
            if !agrees {
                let found = format!("\"{}\"", word.text);
                return Err(self.error(&word.place, found, "a feed is in MMPM, IPM, MMPR or IPR"));
            }
        }
        if number <= 0.0 {
            return Err(self.error(&value.place, format!("the feed {number}"), "a feed is larger than 0"));
        }
        if let Some(unit) = length.filter(|unit| *unit != self.unit) {
            let (unit, lengths) = (unit.name(), self.unit.name());
            self.builder.remark("feed-unit", value.place.line, || {
                format!("the feed is in {unit}, but lengths are in {lengths}")
            });
        }
        let size = number * length.unwrap_or(self.unit).in_m();
        if per_turn == Some(true) {
            return builder::coordinate(size)
                .map(Feed::PerTurn)
                .map_err(|fault| fault.at(self.field, value.place.position()));
        }
        builder::feed(size / MINUTE)
            .map(Feed::PerTime)
            .map_err(|fault| fault.at(self.field, value.place.position()))
    }

    pub(super) fn spindle(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        let tokens = self.tokens(statement)?;
        let mut speed = None;
        let mut rest = tokens.iter();
        while let Some(token) = rest.next() {
            match token.number() {
                Some(0.0) if speed.is_none() => {
                    self.spinning = false;
                    self.builder.remark("spindle-zero", token.place.line, || {
                        "a spindle speed of 0 is read as a stopped spindle".into()
                    });
                    return Ok(());
                }
                Some(rpm) if speed.is_none() && SPINDLE.contains(&rpm) => speed = Some(rpm * RPM),
                Some(rpm) => {
                    let expected = "one speed, from 1 to 1000000 rpm; SPINDL/OFF stops the spindle";
                    return Err(self.error(&token.place, format!("the spindle speed {rpm}"), expected));
                }
                None if token.is("RPM") || token.is("CLW") || token.is("ON") => {}
                // The gear.
                None if token.is("RANGE") && rest.next().is_some() => {}
                None if token.is("OFF") && tokens.len() == 1 => {
                    self.spinning = false;
                    return Ok(());
                }
                None => {
                    let expected = if token.is("CCLW") {
                        "the cutting model is for a clockwise spindle: use a right-hand tool and CLW"
                    } else if token.is("SFM") || token.is("SMM") {
                        "surface speed needs a diameter: have the CAM system write RPM"
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
            None => {
                return Err(self.error(
                    &statement.end(),
                    "nothing",
                    format!("{} is followed by MM or INCHES", statement.word),
                ));
            }
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
        let time = self.wait_of(token)?;
        let after = self.builder.program.moves.len();
        self.builder.program.dwells.push(Dwell { after, time, line: statement.place.line });
        Ok(())
    }

    /// A time [s].
    pub(super) fn wait_of(&self, token: &AptToken<'a>) -> Result<f64, Error> {
        let time = self.number(token)?;
        if (0.0..=LONGEST_WAIT).contains(&time) {
            return Ok(time);
        }
        let expected = format!("a wait is 0 to {LONGEST_WAIT} s");
        Err(self.error(&token.place, format!("a wait of {time} s"), expected))
    }
}
