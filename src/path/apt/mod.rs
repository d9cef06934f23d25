//! APT and CLDATA, as CAM systems write them for postprocessors (ISO 4343:2000 and common
//! practice).
//!
//! Supported words:
//! - `GOTO/x,y,z[,i,j,k]`: a straight move to a point. The first one, or `FROM`, sets the start of
//!   the path. Without i, j, k the tool keeps its axis; after `MULTAX/OFF` it is upright (0, 0, 1);
//!   after `TLAXIS/i,j,k` it has that axis.
//! - `CIRCLE/xc,yc,zc,i,j,k,r`, then the `GOTO` of the arc's end: counter-clockwise about the
//!   vector (right-hand rule), as PTC documents it for Creo ("CL Output for Circular
//!   Interpolation"). An end point higher along the vector makes a helix.
//! - `MOVARC/xc,yc,zc,i,j,k,r,ANGLE,a`, then the `GOTO` of its end: an arc with its sweep [deg], as
//!   Autodesk's "Common APT ISO 4343" postprocessor writes it. The angle must agree with the end
//!   point.
//! - `INDIRV/i,j,k`, then `TLON,GOFWD/(CIRCLE/xc,yc,zc,r),ON,(LINE/xc,yc,zc,x,y,z)`: CATIA's arc,
//!   parallel to the XY plane. It starts in the direction of the vector and ends at the line's
//!   second point (also `ON,2,INTOF`).
//! - `RAPID` applies to the next `GOTO` only (ISO 4343, 5.42), `FEDRAT` until the next one. A feed
//!   without a unit is per minute.
//! - `CUTTER/d` and `TLDATA/MILL,d` give the tool's diameter, which is compared with the job's. The
//!   path is that of the tip in any case.
//! - `SPINDL` clockwise, `DELAY/t` and `DWELL/t` in seconds, `UNITS/MM` and `UNITS/INCHES` before
//!   the first length.
//!
//! `$` continues a statement on the next line, `$$` starts a comment. Words without effect on the
//! path are listed. Words that would change it, and unknown words, are errors.

mod statement;
mod reader;
mod values;
mod motion;
mod catia;
mod setting;
mod words;

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
