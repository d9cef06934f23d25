//! Arcs as a statement before the GOTO of their end: CIRCLE and MOVARC.

use super::reader::Reader;
use super::statement::{AptToken, Statement};
use crate::error::Error;
use crate::path::builder::Circle;
use crate::units::DEG;
use nalgebra::Vector3;

/// A way of writing an arc, recognised by the word and the number of its values. The first six values are
/// always the centre and a vector along the axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ArcForm {
    /// `CIRCLE` with 6 values: the start gives the radius.
    SolidWorks,
    /// `CIRCLE` with 7 values; the last is the radius.
    Creo,
    /// `CIRCLE` with 11 values: radius, two tolerances, the tool's diameter and corner radius. It turns
    /// clockwise about the vector: of 483 arcs in programs of NX all are the shorter ones, and the
    /// tangents of 241 fit, that way round and no other.
    Nx,
    /// `MOVARC` with the radius, `ANGLE` and the angle.
    MovArc,
}

impl ArcForm {
    fn of(word: &str, tokens: &[AptToken<'_>]) -> Option<Self> {
        match (word, tokens.len()) {
            ("CIRCLE", 6) => Some(Self::SolidWorks),
            ("CIRCLE", 7) => Some(Self::Creo),
            ("CIRCLE", 11) => Some(Self::Nx),
            ("MOVARC", 9) if tokens[7].is("ANGLE") => Some(Self::MovArc),
            _ => None,
        }
    }

    /// How the sense of the arc was read; a MOVARC says it by its angle.
    fn sense(self) -> Option<&'static str> {
        match self {
            Self::SolidWorks => Some(
                "CIRCLE with six values is read as counter-clockwise about its vector, as SolidWorks CAM means it",
            ),
            Self::Creo => Some(
                "CIRCLE is read as counter-clockwise about its vector, as PTC Creo means it; \
                 other systems may mean the opposite",
            ),
            Self::Nx => Some(
                "CIRCLE with eleven values is read as clockwise about its vector, as Siemens NX means it",
            ),
            Self::MovArc => None,
        }
    }
}

impl<'a> Reader<'a> {
    pub(super) fn arc(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        self.no_circle_waits()?;
        let place = statement.place;
        let tokens = self.tokens(statement)?;
        let form =
            ArcForm::of(&statement.word, &tokens).ok_or_else(|| self.unknown_arc(statement, &tokens))?;
        let values = if form == ArcForm::MovArc { &tokens[..7] } else { &tokens[..] };
        let numbers: Vec<f64> = values.iter().map(|token| self.number(token)).collect::<Result<_, _>>()?;
        let center = self.point(&numbers[..3], values)?;
        let axis = self
            .builder
            .direction(Vector3::from_column_slice(&numbers[3..6]), place.line)
            .map_err(|fault| fault.at(self.field, values[3].place.position()))?;
        let radius = match values.get(6) {
            Some(token) => self.radius(token)?,
            None => self.radius_at_start(statement, &center, &axis)?,
        };
        let sweep =
            tokens.get(8).filter(|_| form == ArcForm::MovArc).map(|token| match self.number(token)? {
                degrees if degrees > 0.0 && degrees <= 360e3 => Ok(degrees * DEG),
                degrees => Err(self.error(
                    &token.place,
                    format!("the angle {degrees} deg"),
                    "an angle is above 0 and at most 1000 turns",
                )),
            });
        if let Some(sense) = form.sense() {
            self.builder.remark("circle-sense", place.line, || sense.into());
        }
        let axis = if form == ArcForm::Nx { -axis } else { axis };
        self.circle = Some((Circle { center, axis, radius, sweep: sweep.transpose()? }, place));
        Ok(())
    }

    /// Distance of the tool from the axis of an arc that starts there [m].
    fn radius_at_start(
        &self,
        statement: &Statement<'a>,
        center: &Vector3<f64>,
        axis: &Vector3<f64>,
    ) -> Result<f64, Error> {
        let Some((from, _)) = self.builder.pose else {
            let expected = "an arc starts at the point before it";
            return Err(self.error(&statement.place, "an arc before the first point", expected));
        };
        Ok((from - center).cross(axis).norm())
    }

    fn unknown_arc(&self, statement: &Statement<'a>, tokens: &[AptToken<'a>]) -> Error {
        if let Some(times) = tokens.iter().find(|token| token.is("TIMES")) {
            let expected = "several turns in one CIRCLE (TIMES, Siemens NX) are not supported: \
                            have the CAM system write helical engages as straight moves";
            return self.error(&times.place, format!("{} with TIMES", statement.word), expected);
        }
        let place = tokens.get(7).map_or(statement.end(), |token| token.place);
        let expected = if statement.word == "MOVARC" {
            "an arc is MOVARC/xc,yc,zc,i,j,k,r,ANGLE,a"
        } else {
            "an arc is CIRCLE/xc,yc,zc,i,j,k,r, or has six values (SolidWorks CAM) or eleven (Siemens NX); \
             have the CAM system write others as straight moves"
        };
        self.error(&place, format!("{} with {} values", statement.word, tokens.len()), expected)
    }
}
