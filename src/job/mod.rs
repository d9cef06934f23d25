//! The job: the complete input as a person or a script writes it (JSON, units in the names).
//!
//! [`Job`] mirrors the JSON and computes nothing. Absent keys take the value of the default job,
//! the thesis's case, and the report lists them. Unknown keys are errors. The module
//! [`setup`](crate::setup) checks the values and converts them to SI.

mod json;
mod choice;
mod source;
mod spin;
mod input;
mod learned;
mod motion;
mod online;
mod cutting;
mod path;
mod program;
mod stock;
mod uncertainty;
mod read;
mod opening;
pub mod presets;
pub mod fields;

pub use choice::{
    BlendingDistance, ChipLimit, ChipThickness, Choice, CornerDwell, CornerRadius, FeedPerTooth, HeldForce,
    HolderDiameter, LargestCorrection, LoadMass, LoopGain, SpindlePower, SpindleTorque, SpreadPercent,
};
pub use cutting::{Coupling, Cutting, Engaged, HelixHand, Line, Material, Tool, ToolBending};
pub use input::{
    Branch, CompensateAt, Compensation, DhRow, Elbow, Frame, Job, Joint3, Opw, Robot, SagZero, Shaper,
    ShaperKind, ShaperSpec, Shoulder, Wrist,
};
pub use learned::Learned;
pub use motion::{FeedRule, Motion};
pub use online::{MeasuredOnline, Online};
pub use path::{FeedUnit, Path, PathKind, ProgramDialect, Unit};
pub use program::{ControllerWord, FrameValues, RobotProgram};
pub use source::{Source, Sources};
pub use spin::{Spin, SpinGoal, SpinMode, SpinReference};
pub use stock::{EarlierProgram, Stock, StockKind};
pub use uncertainty::Uncertainty;
