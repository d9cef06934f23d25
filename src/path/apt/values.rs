//! Values after a statement's slash: words, numbers, points and axes.

use super::reader::Reader;
use super::statement::{AptToken, Statement, TextPlace};
use crate::error::Error;
use crate::path::builder::{self, Fault};
use nalgebra::Vector3;

impl<'a> Reader<'a> {
    pub(super) fn error(
        &self,
        place: &TextPlace<'_>,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Error {
        Fault::new(found, expected).at(self.field, place.position())
    }

    pub(super) fn tokens(&self, statement: &Statement<'a>) -> Result<Vec<AptToken<'a>>, Error> {
        let tokens = statement.tokens().map_err(|place| {
            self.error(
                &place,
                "a value without a comma before it",
                "values are separated by commas, also across lines",
            )
        })?;
        match tokens.iter().find(|token| token.text.is_empty()) {
            Some(token) => {
                Err(self.error(&token.place, "nothing", "each comma needs a value before and after it"))
            }
            None => Ok(tokens),
        }
    }

    /// The statement's only word, which must be one of `allowed`; `None` if it has no values.
    pub(super) fn words(
        &self,
        statement: &Statement<'a>,
        allowed: &[&'static str],
    ) -> Result<Option<&'static str>, Error> {
        if statement.is_bare() {
            return Ok(None);
        }
        let tokens = self.tokens(statement)?;
        let Some(token) = tokens.first() else { return Ok(None) };
        match allowed.iter().find(|word| token.is(word)) {
            Some(word) if tokens.len() == 1 => Ok(Some(word)),
            _ => {
                let token =
                    tokens.get(1).filter(|_| allowed.iter().any(|word| token.is(word))).unwrap_or(token);
                let expected = match allowed {
                    [] => format!("{} takes no values", statement.word),
                    _ => format!("{} is followed by {}", statement.word, allowed.join(" or ")),
                };
                Err(self.error(&token.place, format!("\"{}\"", token.text), expected))
            }
        }
    }

    pub(super) fn number(&self, token: &AptToken<'_>) -> Result<f64, Error> {
        token.number().ok_or_else(|| {
            self.error(
                &token.place,
                format!("\"{}\"", token.text),
                "a number with a decimal point, such as 12.5",
            )
        })
    }

    /// All values as numbers; their count must be one of `counts`.
    pub(super) fn numbers(
        &self,
        statement: &Statement<'a>,
        counts: &[usize],
    ) -> Result<(Vec<f64>, Vec<AptToken<'a>>), Error> {
        let tokens = self.tokens(statement)?;
        let numbers: Vec<f64> = tokens.iter().map(|token| self.number(token)).collect::<Result<_, _>>()?;
        if counts.contains(&numbers.len()) {
            return Ok((numbers, tokens));
        }
        let most = counts.iter().max().map_or(0, |most| *most);
        let place = tokens.get(most).map_or(statement.end(), |token| token.place);
        let counts: Vec<String> = counts.iter().map(usize::to_string).collect();
        Err(self.error(
            &place,
            format!("{} with {} values", statement.word, numbers.len()),
            format!("{} has {} values", statement.word, counts.join(" or ")),
        ))
    }

    /// A radius [m].
    pub(super) fn radius(&self, token: &AptToken<'_>) -> Result<f64, Error> {
        let number = self.number(token)?;
        if number <= 0.0 {
            return Err(self.error(
                &token.place,
                format!("the radius {number}"),
                "a radius is larger than 0",
            ));
        }
        builder::coordinate(number * self.unit.in_m())
            .map_err(|fault| fault.at(self.field, token.place.position()))
    }

    /// Three coordinates [m].
    pub(super) fn point(&mut self, numbers: &[f64], tokens: &[AptToken<'_>]) -> Result<Vector3<f64>, Error> {
        let mut point = Vector3::zeros();
        for ((value, number), token) in point.iter_mut().zip(numbers).zip(tokens) {
            *value = builder::coordinate(number * self.unit.in_m())
                .map_err(|fault| fault.at(self.field, token.place.position()))?;
            self.first_length.get_or_insert(token.place.line);
        }
        Ok(point)
    }

    pub(super) fn point_and_axis(
        &mut self,
        statement: &Statement<'a>,
    ) -> Result<(Vector3<f64>, Vector3<f64>), Error> {
        let (numbers, tokens) = self.numbers(statement, &[3, 6])?;
        let line = statement.place.line;
        let point = self.point(&numbers, &tokens)?;
        let upright = Vector3::z();
        if let Some(ijk) = numbers.get(3..6) {
            let place = tokens[3].place;
            if self.multax == Some(false) {
                let expected = "after MULTAX/OFF a point has three values; MULTAX/ON adds an axis";
                return Err(self.error(&place, "six values", expected));
            }
            let other = Vector3::from_column_slice(ijk);
            if let Some((circle, _)) = &self.circle
                && (other.norm() - 1.0).abs() > 1e-3
                && circle.passes(&(other * self.unit.in_m()))
            {
                let expected =
                    "one GOTO gives the end of the arc: have the CAM system write no points in between";
                return Err(self.error(&place, "a second point on the arc", expected));
            }
            self.fixed_axis = None;
            let axis = self.builder.direction(Vector3::from_column_slice(ijk), line);
            return Ok((point, axis.map_err(|fault| fault.at(self.field, place.position()))?));
        }
        if let Some(axis) = self.fixed_axis {
            return Ok((point, axis));
        }
        let last = self.builder.pose.map_or(upright, |(_, axis)| axis);
        if self.multax == Some(false) || (last - upright).norm() < 1e-9 {
            return Ok((point, upright));
        }
        self.builder.remark("axis-kept", line, || {
            format!("no axis here: the tool axis stays ({:.4}, {:.4}, {:.4})", last.x, last.y, last.z)
        });
        Ok((point, last))
    }
}
