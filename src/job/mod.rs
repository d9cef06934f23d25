//! The job: the whole question as a person or a script writes it (JSON, units in the names), and the way from there to SI.
//!
//! [`Job`] mirrors the JSON one to one. Keys that are not given take the value of the default job, the thesis's case, and the
//! report says which; unknown keys are errors. [`Job::setup`] checks everything and gives the validated model in SI.

mod json;
mod choice;
mod input;
mod milling;
mod path;
mod program;
pub mod presets;
mod read;
mod burden;
mod setup;
mod placement;
mod cut;
pub mod fields;

pub use choice::{ChipThickness, Choice, CornerRadius, Dwell, FeedPerTooth, SpindlePower};
pub use cut::Stock;
pub use input::{
    Branch, Compensation, DhRow, Elbow, Frame, Job, Joint3, Motion, Opw, Robot, SagZero, Shaper, ShaperKind,
    ShaperSpec, Shoulder, Source, Spin, SpinGoal, SpinMode, Wrist,
};
pub use milling::{Cutting, Engaged, Line, Material, Tool, ToolBending};
pub use path::{FeedUnit, Path, PathKind, Unit};
pub use setup::Setup;
