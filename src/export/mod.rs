//! Files to take away.

pub mod csv;
