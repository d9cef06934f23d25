//! The same arms in another author's library, rs-opw-kinematics.

use armill::robot::library::Preset;
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;

/// A robot of the library, joint 3 relative to the upper arm.
pub(crate) fn peer(preset: &Preset) -> OPWKinematics {
    let [a1, a2, b, c1, c2, c3, c4] = preset.opw.lengths_mm.map(|length| length * 1e-3);
    OPWKinematics::new(Parameters {
        a1,
        a2,
        b,
        c1,
        c2,
        c3,
        c4,
        offsets: preset.opw.joint_offset_deg.map(f64::to_radians),
        sign_corrections: preset.opw.joint_sign.map(|sign| sign as i8),
        dof: 6,
    })
}
