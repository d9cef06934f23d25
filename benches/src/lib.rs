//! The work that `cargo xtask bench` times: the default job stage by stage, kinematics pose by
//! pose, a long program, a pocket in a stock, and questions about a job. It is a library so that the browser runs the same code as the native benchmarks.

pub mod adaptive;
pub mod poses;
pub mod program;
pub mod questions;
pub mod stages;
#[cfg(target_arch = "wasm32")]
mod wasm;

/// A named piece of work on prepared input: name and function.
pub type Work<T> = (&'static str, fn(&T));
