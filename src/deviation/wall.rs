//! Error of the wall: the tool's deviation at the top of the cut, where its tilt counts as well.
//!
//! The contour error is the tip's. A tool that leans by an angle cuts a wall that leans: at the
//! height h the error is the tip's plus h times that angle.

use crate::path::{Closest, MovePace, Path};
use nalgebra::Vector3;

/// The error of the tool at a height [m] above its tip, which `height` gives by the place on the path:
/// the place of its axis there minus the one above the closest point of the path, without its
/// component along the path, which moves the tool along the wall. `None` on a rapid move, where
/// nothing is cut.
///
/// `axis` is the actual tool axis, from tip to spindle.
pub fn error_at_height(
    path: &Path,
    closest: &Closest,
    (tip, axis): (&Vector3<f64>, &Vector3<f64>),
    height: impl Fn((usize, f64)) -> f64,
) -> Option<Vector3<f64>> {
    let place = path.locate(closest.s_on(path));
    let (index, within) = place;
    let step = &path.moves()[index];
    if step.pace == MovePace::Rapid {
        return None;
    }
    let error = tip - closest.point + (axis - path.axis_at(place)) * height(place);
    let tangent = step.segment.tangent(within);
    Some(error - tangent * tangent.dot(&error))
}
