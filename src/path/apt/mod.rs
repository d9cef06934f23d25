//! APT and CLDATA, as CAM systems write it for postprocessors (ISO 4343:2000 and what is customary).
//!
//! What is read, word by word:
//! - `GOTO/x,y,z[,i,j,k]`: straight to a point. The first one, or `FROM`, says where the path starts. Without i, j, k the tool keeps
//!   its axis; after `MULTAX/OFF` it is upright (0, 0, 1); after `TLAXIS/i,j,k` it has that axis.
//! - `CIRCLE/xc,yc,zc,i,j,k,r`, then the `GOTO` of the arc's end: counter-clockwise about the vector (right-hand rule), as PTC
//!   documents it for Creo ("CL Output for Circular Interpolation"); an end that lies higher along the vector makes a helix.
//! - `MOVARC/xc,yc,zc,i,j,k,r,ANGLE,a`, then the `GOTO` of its end: the same with the angle swept [deg], as Autodesk's
//!   "Common APT ISO 4343" postprocessor writes it. The angle must agree with the end point.
//! - `INDIRV/i,j,k`, then `TLON,GOFWD/(CIRCLE/xc,yc,zc,r),ON,(LINE/xc,yc,zc,x,y,z)`: CATIA's arc, parallel to the XY plane, that
//!   starts in the direction of the vector and ends at the line's second point (also `ON,2,INTOF`).
//! - `RAPID` holds for the next `GOTO` (ISO 4343, 5.42), `FEDRAT` until the next one; a feed without a unit is per minute.
//! - `CUTTER/d` and `TLDATA/MILL,d` say the tool's diameter, which is compared with the job's; the path is the tip's in any case.
//! - `SPINDL` clockwise, `DELAY/t` and `DWELL/t` in seconds, `UNITS/MM` and `UNITS/INCHES` before the first length.
//!
//! `$` goes on in the next line, `$$` starts a comment. Words without effect on the path are listed, those that would change it
//! and all others stop the reading.

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

/// What the text itself may leave open.
#[derive(Debug, Clone, Copy)]
pub struct Options<'a> {
    /// JSON path of the text, for errors.
    pub field: &'a str,
    /// Unit of length of a text without `UNITS`; such a text is remarked on.
    pub unit: LengthUnit,
}

/// Reads an APT or CLDATA text; `on_line` is called with the number of lines done after each statement.
///
/// # Errors
/// [`Error::Text`] with line and column of the first word or number that cannot be followed, and what to do about it.
pub fn program(text: &str, options: &Options<'_>, on_line: impl FnMut(usize)) -> Result<Program, Error> {
    reader::read(text, options, on_line)
}
