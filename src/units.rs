//! All conversion factors: the SI value of each unit used in input and output.

/// One millimetre [m].
pub const MM: f64 = 1e-3;
/// One inch [m].
pub const INCH: f64 = 25.4e-3;
/// One minute [s].
pub const MINUTE: f64 = 60.0;
/// One degree [rad].
pub const DEG: f64 = std::f64::consts::PI / 180.0;
/// One minute of arc [rad].
pub const ARCMIN: f64 = DEG / 60.0;
/// One revolution per minute [1/s].
pub const RPM: f64 = 1.0 / 60.0;
/// One newton per square millimetre [N/m^2].
pub const N_PER_MM2: f64 = 1e6;
/// One newton per millimetre [N/m].
pub const N_PER_MM: f64 = 1e3;
/// One hertz [rad/s].
pub const HZ: f64 = std::f64::consts::TAU;
/// One pound-force [N]: 0.45359237 kg at standard gravity, 9.80665 m/s^2.
pub const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// One kilowatt [W].
pub const KILOWATT: f64 = 1e3;
/// One gigapascal [N/m^2].
pub const GPA: f64 = 1e9;
