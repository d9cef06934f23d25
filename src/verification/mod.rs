//! The accuracy of a program itself, not of the samples it was made from: it is rehearsed before it
//! is written, and can be read back afterwards.

pub mod as_run;
mod programs;
mod remarks;
pub mod rehearsal;
pub mod replay;

pub use programs::{Package, ProgramAccuracy, Programs, export};
pub use replay::{Replay, read_back};
