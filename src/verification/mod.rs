//! What a program is worth, not the samples it was made from: it is rehearsed before it is written, and
//! read back after.

mod programs;
pub mod rehearsal;
pub mod replay;

pub use programs::{ProgramAccuracy, Programs, export};
pub use replay::{Replay, read_back};
