//! What a program starts from.

use crate::stock::along::Earlier;
use crate::stock::solid::Solid;

/// A solid and what earlier programs have cut of it, in the workpiece frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Blank {
    /// The solid.
    pub solid: Solid,
    /// The paths that it was cut along before.
    pub earlier: Vec<Earlier>,
}
