//! Arcs along a drive curve, as CATIA V5 and PTC Creo write them: a start direction, then the circle
//! that the tool is on and the line that ends the arc.

use super::reader::Reader;
use super::statement::{AptToken, Statement, TextPlace};
use crate::error::Error;
use crate::path::builder::{self, Circle};
use nalgebra::Vector3;

/// How far a start direction may lie off the circle's tangent (sine of the angle); CAM systems
/// round it.
const OFF_TANGENT: f64 = 0.05;
/// Least part along the tangent (cosine of the angle) of the way to a point that gives the sense.
const TOWARDS: f64 = 0.1;

/// The direction in which the next arc starts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ahead<'a> {
    /// Along or towards.
    direction: Vector3<f64>,
    /// Whether it is the tangent itself (`INDIRV`), or only says which way round (`INDIRP`).
    tangent: bool,
    pub(super) place: TextPlace<'a>,
}

/// Where the tool runs along the drive curve: `TLON`, `TLLFT` or `TLRGT`, and its place.
pub(super) type DriveSide<'a> = (String, TextPlace<'a>);

impl<'a> Reader<'a> {
    /// `INDIRV/i,j,k`, or `INDIRP/x,y,z` as seen from the tool.
    pub(super) fn direct(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        self.no_circle_waits()?;
        let place = statement.place;
        let (numbers, tokens) = self.numbers(statement, &[3])?;
        let tangent = statement.word == "INDIRV";
        let direction = if tangent {
            Vector3::from_column_slice(&numbers)
        } else {
            let Some((from, _)) = self.builder.pose else {
                let expected =
                    "INDIRP/x,y,z points from the tool: write a GOTO before it to say where the tool is";
                return Err(self.error(&place, "a direction before the first point", expected));
            };
            self.point(&numbers, &tokens)? - from
        };
        self.ahead = Some(Ahead { direction, tangent, place });
        Ok(())
    }

    /// `TLON`, `TLLFT` or `TLRGT` in a statement of its own.
    pub(super) fn side(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        self.words(statement, &[])?;
        self.side = Some((statement.word.clone(), statement.place));
        Ok(())
    }

    /// `GOFWD/(CIRCLE/xc,yc,zc,r),ON[,n,INTOF],(LINE/x1,y1,z1,x2,y2,z2)` after `INDIRV/i,j,k` and
    /// `TLON`, which may stand in the same statement: `TLON,GOFWD/...`. The circle is parallel to the XY
    /// plane, and the arc ends at the line's second point.
    pub(super) fn arc_on_circle(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        let place = statement.place;
        let tokens = self.tokens(statement)?;
        let unknown = "an arc here is TLON,GOFWD/(CIRCLE/xc,yc,zc,r),ON,(LINE/xc,yc,zc,x,y,z); have the CAM system write others as points";
        let (circle, line) = match tokens.as_slice() {
            [circle @ .., a, b, c, d, e, f] if circle.len() >= 5 => (circle, [*a, *b, *c, *d, *e, *f]),
            _ => return Err(self.error(&statement.end(), statement.written(), unknown)),
        };
        let on = &circle[4..];
        let intersection = on.len() == 3 && on[1].number().is_some() && on[2].is("INTOF");
        let (Some(xc), Some(r), Some(_), Some(z), true) = (
            circle[0].opened("CIRCLE"),
            circle[3].closed(),
            line[0].opened("LINE"),
            line[5].closed(),
            on[0].is("ON") && (on.len() == 1 || intersection),
        ) else {
            return Err(self.error(&place, statement.written(), unknown));
        };
        if let Some(side) = statement.word.strip_suffix(",GOFWD") {
            self.side = Some((side.to_string(), place));
        }
        let Some((side, side_at)) = self.side.clone() else {
            let expected = "write TLON before it to put the tool on the circle";
            return Err(self.error(&place, "GOFWD without TLON", expected));
        };
        let Some(ahead) = self.ahead.take() else {
            return Err(self.error(
                &place,
                "an arc without a direction",
                "write INDIRV/i,j,k before it to say which way it runs",
            ));
        };
        let Some((from, tool_axis)) = self.builder.pose else {
            return Err(self.error(
                &place,
                "an arc before the first point",
                "an arc starts at the point before it",
            ));
        };
        let center = self.point_of(&[xc, circle[1], circle[2]])?;
        let end = self.point_of(&[line[3], line[4], z])?;
        let axis = self.axis_of(&ahead, from - center)?;
        let circle = Circle { center, axis, radius: self.radius(&r)?, sweep: None };
        // A tool beside the circle is on it only if its radius is zero.
        if side != "TLON" && !(circle.passes(&from) && circle.passes(&end)) {
            let expected = "the tool runs beside the circle, which is not supported: \
                            have the CAM system write the path of its centre with TLON, as CIRCLE or as points";
            return Err(self.error(&side_at, side, expected));
        }
        let target = self.target(&place, end, tool_axis)?;
        self.builder.arc_to(circle, target).map_err(|fault| fault.at(self.field, place.position()))
    }

    /// The axis, +Z or -Z, about which an arc turns counter-clockwise if it starts in the given
    /// direction; `spoke` leads from the centre to its start.
    fn axis_of(&self, ahead: &Ahead<'_>, spoke: Vector3<f64>) -> Result<Vector3<f64>, Error> {
        let (direction, _) =
            builder::unit(ahead.direction).map_err(|fault| fault.at(self.field, ahead.place.position()))?;
        let turn = Vector3::z().dot(&spoke.cross(&direction));
        // NaN if the start is the centre, which has no tangent either.
        let along = turn.abs() / spoke.xy().norm();
        let least = if ahead.tangent { (1.0 - OFF_TANGENT * OFF_TANGENT).sqrt() } else { TOWARDS };
        if along > least {
            return Ok(if turn > 0.0 { Vector3::z() } else { -Vector3::z() });
        }
        let expected = if ahead.tangent {
            "INDIRV points along the circle, parallel to the XY plane"
        } else {
            "INDIRP must point to one side of the start, along the circle"
        };
        Err(self.error(&ahead.place, "a direction that is not the arc's", expected))
    }

    fn point_of(&mut self, tokens: &[AptToken<'a>; 3]) -> Result<Vector3<f64>, Error> {
        let [x, y, z] = tokens;
        let numbers = [self.number(x)?, self.number(y)?, self.number(z)?];
        self.point(&numbers, tokens)
    }
}
