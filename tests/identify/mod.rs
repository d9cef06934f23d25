//! Identification: measured data, recovered models, errors in the texts.
#![allow(clippy::disallowed_methods, reason = "signals made by other functions than the core's")]

mod gear;
mod measurement;
mod nnls;
mod response;
mod script;
mod stiffness;
