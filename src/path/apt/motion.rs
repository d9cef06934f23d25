//! Statements that move the tool to a point: GOTO, FROM, GOHOME.

use super::reader::{Feed, Reader};
use super::statement::{Statement, TextPlace};
use crate::error::Error;
use crate::path::builder::{self, Circle, Target};
use crate::path::program::MovePace;
use crate::units::MM;
use nalgebra::Vector3;

impl<'a> Reader<'a> {
    pub(super) fn no_circle_waits(&self) -> Result<(), Error> {
        match &self.circle {
            Some((_, place)) => {
                Err(self.error(place, "an arc without an end", "the GOTO of the arc's end follows it"))
            }
            None => Ok(()),
        }
    }

    pub(super) fn go(&mut self, statement: &Statement<'a>, made: Option<Circle>) -> Result<(), Error> {
        let place = statement.place;
        let before = self.builder.pose;
        let (point, axis) = self.point_and_axis(statement)?;
        if let Some(cycle) = self.cycle {
            return self.drill(&cycle, (point, axis), &place);
        }
        let target = self.target(&place, point, axis)?;
        let done = match self.circle.take() {
            Some((circle, _)) => {
                self.made = Some(circle);
                self.builder.arc_to(circle, target)
            }
            None => {
                if let (Some(circle), Some((from, _))) = (made, before)
                    && target.pace != MovePace::Rapid
                    && circle.passes(&from)
                    && circle.passes(&point)
                {
                    self.builder.remark("chord", place.line, || {
                        "a straight move between two points of the arc before it: if the CAM system writes several points \
                         for one CIRCLE, have it write the end only".into()
                    });
                }
                self.builder.line_to(target)
            }
        };
        done.map_err(|fault| fault.at(self.field, place.position()))
    }

    /// End point, pace and spindle speed of a move at `place`, from the current state. Consumes a
    /// RAPID.
    pub(super) fn target(
        &mut self,
        place: &TextPlace<'_>,
        point: Vector3<f64>,
        axis: Vector3<f64>,
    ) -> Result<Target, Error> {
        if let Some(line) = self.home {
            let found = format!("a move after GOHOME (line {line})");
            let expected = "the program does not say where home is: write RAPID and a GOTO instead";
            return Err(self.error(place, found, expected));
        }
        let pace = if self.builder.pose.is_some() { self.pace(place)? } else { MovePace::JobFeed };
        self.rapid = false;
        let spindle = self.speed.filter(|_| self.spinning);
        Ok(Target { point, axis, pace, spindle, line: place.line })
    }

    /// A rapid move to a point.
    pub(super) fn rapid_to(
        &mut self,
        place: &TextPlace<'_>,
        point: Vector3<f64>,
        axis: Vector3<f64>,
    ) -> Result<(), Error> {
        self.rapid = true;
        let target = self.target(place, point, axis)?;
        self.builder.line_to(target).map_err(|fault| fault.at(self.field, place.position()))
    }

    /// `GOHOME/x,y,z` is a rapid move; where `GOHOME` alone leads is not known.
    pub(super) fn go_home(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        self.no_circle_waits()?;
        let place = statement.place;
        if !statement.is_bare() {
            let (point, axis) = self.point_and_axis(statement)?;
            return self.rapid_to(&place, point, axis);
        }
        self.home = Some(place.line);
        self.ignore(statement);
        self.builder.remark("home", place.line, || "the move home is not part of the path".into());
        Ok(())
    }

    /// The pace of the move at `place`.
    fn pace(&mut self, place: &TextPlace<'_>) -> Result<MovePace, Error> {
        if self.rapid {
            return Ok(MovePace::Rapid);
        }
        if self.speed.is_some() && !self.spinning {
            self.builder
                .remark("spindle-stopped", place.line, || "a feed move while the spindle is stopped".into());
        }
        let feed = match self.feed {
            Some(Feed::PerTime(feed)) => feed,
            Some(Feed::PerTurn(feed)) => match self.speed {
                Some(speed) if self.spinning => feed * speed,
                _ => {
                    let expected = "write SPINDL/RPM,n,CLW before it, or the feed in MMPM or IPM";
                    return Err(self.error(place, "a feed per revolution without a spindle speed", expected));
                }
            },
            None => {
                self.builder
                    .remark("feed-missing", place.line, || "no FEDRAT yet: the job's feed is used".into());
                return Ok(MovePace::JobFeed);
            }
        };
        builder::feed(feed).map(MovePace::Feed).map_err(|fault| fault.at(self.field, place.position()))
    }

    pub(super) fn start(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        self.no_circle_waits()?;
        let (point, axis) = self.point_and_axis(statement)?;
        let place = statement.place;
        match self.builder.pose {
            None => self.builder.pose = Some((point, axis)),
            Some((from, _)) if (from - point).norm() <= 1e-3 * MM => {}
            Some(_) => {
                let expected = "FROM says where the path starts: write RAPID and GOTO to go on elsewhere";
                return Err(self.error(&place, "FROM at another point than the tool's", expected));
            }
        }
        Ok(())
    }
}
