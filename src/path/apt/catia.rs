//! Arcs as CATIA V5 writes them: a start direction, then the circle and the line that ends the arc.

use super::reader::Reader;
use super::statement::{AptToken, Statement};
use crate::error::Error;
use crate::path::builder::{self, Circle};
use nalgebra::Vector3;

/// How far a start direction may lie off the circle's tangent (sine of the angle); CAM systems
/// round it.
const OFF_TANGENT: f64 = 0.05;

impl<'a> Reader<'a> {
    /// `TLON,GOFWD/(CIRCLE/xc,yc,zc,r),ON[,n,INTOF],(LINE/x1,y1,z1,x2,y2,z2)` after `INDIRV/i,j,k`.
    pub(super) fn arc_on_circle(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        let place = statement.place;
        let tokens = self.tokens(statement)?;
        let unknown = "an arc here is TLON,GOFWD/(CIRCLE/xc,yc,zc,r),ON,(LINE/xc,yc,zc,x,y,z); let the CAM system write others as points";
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
        let Some((ahead, stated_at)) = self.ahead.take() else {
            return Err(self.error(
                &place,
                "an arc without a direction",
                "INDIRV/i,j,k before it says which way it runs",
            ));
        };
        let Some((from, tool_axis)) = self.builder.pose else {
            return Err(self.error(
                &place,
                "an arc before any point",
                "an arc starts at the point before it",
            ));
        };
        let (ahead, _) = builder::unit(ahead).map_err(|fault| fault.at(self.field, stated_at.position()))?;
        let center = self.point_of(&[xc, circle[1], circle[2]])?;
        let end = self.point_of(&[line[3], line[4], z])?;
        let radius = self.radius(&r)?;
        let spoke = from - center;
        let turn = Vector3::z().dot(&spoke.cross(&ahead));
        let along = turn.abs() / spoke.xy().norm();
        // NaN if the start is the centre, which has no tangent either.
        let tangent = along * along > 1.0 - OFF_TANGENT * OFF_TANGENT;
        if !tangent {
            let expected = "INDIRV points along the circle, parallel to the XY plane";
            return Err(self.error(&stated_at, "a direction that is not the arc's", expected));
        }
        let axis = if turn > 0.0 { Vector3::z() } else { -Vector3::z() };
        let target = self.target(&place, end, tool_axis)?;
        self.builder
            .arc_to(Circle { center, axis, radius, sweep: None }, target)
            .map_err(|fault| fault.at(self.field, place.position()))
    }

    fn point_of(&mut self, tokens: &[AptToken<'a>; 3]) -> Result<Vector3<f64>, Error> {
        let [x, y, z] = tokens;
        let numbers = [self.number(x)?, self.number(y)?, self.number(z)?];
        self.point(&numbers, tokens)
    }
}
