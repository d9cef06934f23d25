//! The world of a robot's controller.

use crate::math::Pose;
use crate::units::MM;
use nalgebra::Vector3;

/// Where a controller counts positions from: a point on axis 1, with the axes of the robot's base.
/// Armill's own base frame is at the foot of the arm.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct World {
    /// Height above the foot [m]; `None`: not known, and taken as the foot.
    pub height: Option<f64>,
    /// Whether this is the height of axis 2.
    pub at_axis_2: bool,
}

impl World {
    /// The height, the foot's where it is not known [m].
    pub fn height(&self) -> f64 {
        self.height.unwrap_or(0.0)
    }

    /// A frame that is given in the base frame, as the controller counts it.
    pub fn of_base(&self, frame: &Pose) -> Pose {
        Pose { position: frame.position - Vector3::z() * self.height(), ..*frame }
    }

    /// A sentence that says it, without full stop: plain ASCII without brackets, for programs.
    pub fn sentence(&self) -> String {
        let Some(height) = self.height else {
            return "Where the controller measures from is not known, so the foot of the arm is assumed: check it"
                .into();
        };
        // Rounded to 0.1 um: millimetres to metres and back leave last bits.
        match ((height / MM * 1e4).round() / 1e4, self.at_axis_2) {
            (0.0, _) => "The controller measures from the foot of the arm".into(),
            (mm, true) => format!("The controller measures from axis 2, {mm} mm above the foot of the arm"),
            (mm, false) => format!("The controller measures from {mm} mm above the foot of the arm"),
        }
    }
}
