//! What `cargo xtask bench` times: the default job stage by stage, and kinematics pose by pose. One library, so that the browser runs
//! the same code as the native benchmarks.

pub mod poses;
pub mod stages;
#[cfg(target_arch = "wasm32")]
mod wasm;

/// A piece of work on what is ready beforehand: name and function.
pub type Work<T> = (&'static str, fn(&T));
