//! Armill predicts where the tool tip of a milling robot really goes and returns the path to command instead.

pub mod column;
