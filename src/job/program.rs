//! The job's section `program`: for which controller the path leaves, and how.

use crate::job::choice::{BlendingDistance, Choice, LoadMass, choice};
use crate::job::json::keys;
use serde::Serialize;

choice! {
    /// Controller that a program is for.
    ControllerWord {
        /// That of the robot's maker; G-code where there is none.
        #[default]
        Brand = "brand",
        /// KUKA.
        Kuka = "kuka",
        /// ABB.
        Abb = "abb",
        /// Staubli.
        Staubli = "staubli",
        /// FANUC.
        Fanuc = "fanuc",
        /// Any that reads G-code.
        Gcode = "gcode",
        /// A postprocessor that reads APT.
        Apt = "apt",
        /// A table of points.
        Csv = "csv",
    }
}
choice! {
    /// What a program says of base, tool and load.
    FrameValues {
        /// Their numbers, and the values they stand for, which it stores in the controller.
        #[default]
        Values = "values",
        /// Their numbers only; the controller's own values hold.
        Numbers = "numbers",
    }
}

/// What leaves: a program with its frames, its blending and its names.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RobotProgram {
    /// Its controller.
    pub controller: ControllerWord,
    /// Its name.
    pub name: String,
    /// Number of the tool in the controller.
    pub tool_number: u32,
    /// Number of the base, user frame or work object.
    pub base_number: u32,
    /// Number of the load; KUKA's is that of the tool unless it is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load_number: Option<u32>,
    /// Whether their values are stored in the controller.
    pub frames: FrameValues,
    /// Mass of the spindle with its tool.
    pub load_kg: LoadMass,
    /// Its centre of mass in the flange frame.
    pub load_centre_mm: [f64; 3],
    /// Distance from a point at which the path leaves for the next one; 0 is an exact stop.
    pub blending_mm: BlendingDistance,
    /// Points nearer to each other are merged.
    pub least_step_mm: f64,
    /// A longer program is split.
    pub lines_per_file: u32,
    /// Positions of external axes, in mm or degrees, in their order.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub external_axes: Option<Vec<f64>>,
    /// Procedure of the controller that starts the spindle and waits until it is at speed.
    pub spindle_on: String,
    /// Procedure that stops it.
    pub spindle_off: String,
    /// Procedure that turns the coolant on.
    pub coolant_on: String,
    /// Procedure that turns it off.
    pub coolant_off: String,
}

impl Default for RobotProgram {
    fn default() -> Self {
        Self {
            controller: ControllerWord::Brand,
            name: "ARMILL".into(),
            tool_number: 1,
            base_number: 1,
            load_number: None,
            frames: FrameValues::Values,
            load_kg: Choice::Word,
            load_centre_mm: [0.0; 3],
            blending_mm: Choice::Word,
            least_step_mm: 0.1,
            lines_per_file: 5000,
            external_axes: None,
            spindle_on: String::new(),
            spindle_off: String::new(),
            coolant_on: String::new(),
            coolant_off: String::new(),
        }
    }
}

keys!(RobotProgram {
    controller,
    name,
    tool_number,
    base_number,
    load_number,
    frames,
    load_kg,
    load_centre_mm,
    blending_mm,
    least_step_mm,
    lines_per_file,
    external_axes,
    spindle_on,
    spindle_off,
    coolant_on,
    coolant_off
});
