//! The frame in which the points are given: MSYS, ORIGIN, CSYS and the comment `$$-> CSYS`.
//!
//! None of them moves a point: it is read as written. An identity says nothing. One other frame for
//! the whole program gets a remark; a change on the way would move the points that follow, and is
//! refused. `CSYS` as a statement, as SolidWorks CAM writes it, is followed as an identity only.

use super::reader::Reader;
use super::statement::Statement;
use super::words;
use crate::error::Error;

/// Numbers of two frames that differ by less are the same (seven decimals are common).
const SAME: f64 = 1e-6;

/// Origin, x axis and y axis of the identity.
const IDENTITY: [f64; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];

impl<'a> Reader<'a> {
    pub(super) fn frame(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        let frame = self.frame_of(statement)?;
        let identity = is_same(&frame, &IDENTITY);
        if statement.word == "CSYS" && !identity {
            let expected = words::refused("CSYS").unwrap_or_default();
            return Err(self.error(&statement.place, statement.written(), expected));
        }
        let first = match &self.frame {
            Some(first) => Some(first.as_slice()),
            None => self.builder.pose.map(|_| IDENTITY.as_slice()),
        };
        if first.is_some_and(|first| !is_same(first, &frame)) {
            let expected = "use one frame for the whole program: have the CAM system write one file for each";
            return Err(self.error(&statement.place, statement.written(), expected));
        }
        if !identity {
            self.builder.remark("other-frame", statement.place.line, || {
                format!("{}: the points are read as written, in this frame", statement.written())
            });
        }
        self.frame = Some(frame);
        if statement.note().is_none() {
            self.ignore(statement);
        }
        Ok(())
    }

    /// Origin, x axis and y axis; or the numbers as written, if their count is another one.
    fn frame_of(&self, statement: &Statement<'a>) -> Result<Vec<f64>, Error> {
        let tokens = self.tokens(statement)?;
        let numbers: Vec<f64> = tokens.iter().map(|token| self.number(token)).collect::<Result<_, _>>()?;
        Ok(match numbers.as_slice() {
            [x, y, z] => [&[*x, *y, *z], &IDENTITY[3..]].concat(),
            // Three rows of a matrix, the fourth of each being the origin's coordinate.
            [xx, yx, _, x, xy, yy, _, y, xz, yz, _, z] => vec![*x, *y, *z, *xx, *xy, *xz, *yx, *yy, *yz],
            _ => numbers,
        })
    }
}

fn is_same(one: &[f64], other: &[f64]) -> bool {
    one.len() == other.len() && one.iter().zip(other).all(|(a, b)| (a - b).abs() <= SAME)
}
