//! Identification: measured data, recovered models, errors in the texts.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]
#![allow(clippy::disallowed_methods, reason = "signals made by other functions than the core's")]

#[path = "../common/mod.rs"]
mod common;

mod measurement;
mod nnls;
mod response;
mod script;
mod stiffness;
