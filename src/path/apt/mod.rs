//! APT and CLDATA, as CAM systems write them for postprocessors (ISO 4343:2000 and common
//! practice).
//!
//! Supported words:
//! - `GOTO/x,y,z[,i,j,k]`: a straight move to a point. The first one, or `FROM`, sets the start of
//!   the path. Without i, j, k the tool keeps its axis; after `MULTAX/OFF` it is upright (0, 0, 1);
//!   after `TLAXIS/i,j,k` it has that axis.
//! - `CIRCLE/xc,yc,zc,i,j,k,r`, then the `GOTO` of the arc's end: counter-clockwise about the
//!   vector (right-hand rule), as PTC documents it for Creo ("CL Output for Circular
//!   Interpolation"). An end point higher along the vector makes a helix. SolidWorks CAM writes six
//!   values, without the radius; the eleven of Siemens NX turn clockwise about the vector.
//! - `MOVARC/xc,yc,zc,i,j,k,r,ANGLE,a`, then the `GOTO` of its end: an arc with its sweep [deg], as
//!   Autodesk's "Common APT ISO 4343" postprocessor writes it. The angle must agree with the end
//!   point.
//! - `INDIRV/i,j,k` or `INDIRP/x,y,z`, then `TLON` and `GOFWD/(CIRCLE/xc,yc,zc,r),ON,(LINE/...)`:
//!   the arc of CATIA (in one statement, `TLON,GOFWD/`) and Creo (in two), see `drive`.
//! - `CYCLE/DRILL,DEPTH,d,MMPM,f,CLEAR,c` and other drilling cycles, see `cycle`.
//! - `RAPID` applies to the next `GOTO` only (ISO 4343, 5.42), `FEDRAT` until the next one. A feed
//!   without a unit is per minute. `GOHOME/x,y,z` is a rapid.
//! - `CUTTER/d` and `TLDATA/MILL,d` give the tool's diameter, which is compared with the job's. The
//!   path is that of the tip in any case.
//! - `SPINDL` clockwise, `DELAY/t` and `DWELL/t` in seconds, `UNITS/MM` (or `UNIT`) and
//!   `UNITS/INCHES` before the first length.
//! - `MSYS`, `ORIGIN`, `CSYS` and the comment `$$-> CSYS` name the frame of the points, see `frame`.
//!
//! `$` continues a statement on the next line, `$$` starts a comment; a comment that starts with
//! `$$->` is continued too. Words without effect on the
//! path are listed. Words that would change it, and unknown words, are errors.

mod statement;
mod reader;
mod values;
mod motion;
mod circle;
mod drive;
mod cycle;
mod frame;
mod setting;
mod words;
mod language;

use crate::error::Error;
use crate::path::program::Program;
use crate::path::unit::LengthUnit;

/// Settings that the text may leave open.
#[derive(Debug, Clone, Copy)]
pub struct Options<'a> {
    /// JSON path of the text, for errors.
    pub field: &'a str,
    /// Unit of length if the text has no `UNITS`; this gets a remark.
    pub unit: LengthUnit,
}

/// Reads an APT or CLDATA text. `on_line` is called after each statement with the number of lines
/// read.
///
/// # Errors
/// [`Error::Text`] with line and column of the first word or number that is not supported, and what
/// to do about it.
pub fn program(text: &str, options: &Options<'_>, on_line: impl FnMut(usize)) -> Result<Program, Error> {
    reader::read(text, options, on_line)
}
