//! Questions about a job that one run does not answer: how deep may I go, what if, which robot?
//!
//! A question and its answer are values. Every run of an answer is a plain [`run`](crate::run) of a
//! changed job, so it equals that run bit for bit, whatever the number of threads. A run that fails
//! is a point of the answer, not its end.

mod choices;
mod largest;
mod loops;
mod outcome;
mod range;
mod robots;
mod search;
mod sweep;
mod tornado;
mod variation;
mod varied;

pub use choices::{ChoiceRow, EveryChoice, choices};
pub use largest::{ErrorMeasure, Holds, LargestAnswer, LargestQuestion};
pub use loops::{EveryLoop, LoopRow};
pub use outcome::Outcome;
pub use range::ValueRange;
pub use robots::{EveryRobot, PartPlace, RobotRow, robots};
pub use sweep::{Sweep, SweepRow, sweep};
pub use tornado::{Tornado, TornadoBar, tornado};
pub use variation::{ChoiceWords, ListedNumbers, Taken, Variation};
pub use varied::VariedJob;
