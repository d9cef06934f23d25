//! The model's number: figures of the same number can be compared.
//!
//! Summaries, saved jobs and exported programs carry it, so that whoever opens an old one learns
//! that its figures differ from today's.

/// Number of the model that figures are computed with.
///
/// It is raised by one when the physics changes such that jobs in general give other figures; a
/// corrected robot, material or rounding does not raise it. What changed is in CHANGELOG,
/// "Numbers".
///
/// - 1: the thesis's. The axial force has one sign, and the whole force acts at any speed and from
///   the first touch on; a round nose takes its radial depth at the full diameter.
/// - 2: the axial force has the sign of the helix's hand, the chip follows the speed, the force
///   rises along the run-in, and the radial depth counts from the local radius.
pub const MODEL: u32 = 2;

/// The line by which an exported program says what it was computed with.
pub fn stamp(fingerprint: &str) -> String {
    format!("Armill {}, model {MODEL}, run {fingerprint}", env!("CARGO_PKG_VERSION"))
}
