//! The job's robot: a preset in the library, a table of links, or ortho-parallel parameters.

use crate::error::Error;
use crate::job::{self, Job, Joint3};
use crate::robot::{Elbow, Joints, Link, Opw, Robot, World, library};
use crate::spread::InputSpread;
use crate::units::{DEG, MM};

/// An arm without its tool.
pub(super) struct BareArm {
    /// The arm.
    pub(super) robot: Robot,
    /// Where its controller counts from.
    pub(super) world: World,
    /// Largest speeds of the joints' drives [rad/s], if known.
    pub(super) joint_speeds: Option<Joints>,
    /// Its maker, if it is in the library.
    pub(super) maker: Option<&'static str>,
    /// Mass that it is rated to carry [kg], if known.
    pub(super) payload: Option<f64>,
    /// Source of its compliance, and how far to trust it.
    pub(super) stiffness_note: String,
    /// Whether the compliance is only an order of magnitude.
    pub(super) stiffness_assumed: bool,
    /// How far the library's stiffness may be from the true one, if the job takes that.
    pub(super) spread: Option<[InputSpread; 6]>,
}

/// A job's arm with its tool.
///
/// # Errors
/// If the job's robot is invalid.
pub fn robot(job: &Job) -> Result<Robot, Error> {
    Ok(arm(&job.robot)?.robot.with_tool(super::frame(&job.tool_frame)))
}

/// The arm given in the section `robot`.
pub(super) fn arm(given: &job::Robot) -> Result<BareArm, Error> {
    let forms = [given.preset.is_some(), given.modified_dh.is_some(), given.opw.is_some()];
    if forms.into_iter().filter(|form| *form).count() > 1 {
        let field = if forms[0] { "robot.preset" } else { "robot.opw" };
        return Err(Error::invalid(
            field,
            "given together with another form",
            "give one of preset, modified_dh and opw",
        ));
    }
    let mut library_note = None;
    let mut elbow = Elbow::Serial;
    let mut world = World::default();
    let mut joint_speeds = None;
    let mut payload = None;
    let mut maker = None;
    let (name, links, limits, compliance) = if let Some(id) = &given.preset {
        let preset = library::robot(id)?;
        elbow = preset.elbow;
        world = preset.world();
        joint_speeds = preset.joint_speed_deg_s.map(|speeds| Joints::from(speeds) * DEG);
        payload = Some(preset.payload_kg);
        maker = Some(preset.maker);
        library_note =
            Some((preset.stiffness_note.clone(), preset.stiffness_assumed, preset.stiffness_spread));
        (preset.name(), preset.links(), preset.limits(), Some(preset.joint_compliance))
    } else if let Some(rows) = given.modified_dh {
        let links = rows.map(|row| Link {
            alpha: row.alpha_deg * DEG,
            a: row.a_mm * MM,
            d: row.d_mm * MM,
            theta_offset: row.theta_offset_deg * DEG,
            sign: row.joint_sign,
        });
        (String::new(), links, None, None)
    } else if let Some(opw) = &given.opw {
        (String::new(), ortho_parallel(opw)?.links(), None, None)
    } else {
        return Err(Error::missing("robot.preset", "name a preset, or give modified_dh or opw"));
    };
    let limits =
        given.joint_limits_deg.map(|ranges| ranges.map(|[low, high]| (low * DEG, high * DEG))).or(limits);
    let compliance = given.joint_compliance_rad_per_nm.or(compliance).ok_or_else(|| {
        Error::missing("robot.joint_compliance_rad_per_nm", "six compliances, 0 for a rigid joint")
    })?;
    let (stiffness_note, stiffness_assumed, spread) = match (given.joint_compliance_rad_per_nm, library_note)
    {
        (None, Some((note, assumed, spread))) => (note, assumed, Some(spread)),
        _ => ("Joint stiffness: as given in the job.".into(), false, None),
    };
    let robot = Robot::new(given.name.clone().unwrap_or(name), links, limits, compliance)?;
    let elbow = match given.joint_3 {
        Some(Joint3::Serial) => Elbow::Serial,
        Some(Joint3::Pendant) => Elbow::Pendant,
        Some(Joint3::Parallelogram) => Elbow::Parallelogram,
        None => elbow,
    };
    let robot = robot.with_elbow(elbow)?;
    Ok(BareArm { robot, world, joint_speeds, maker, payload, stiffness_note, stiffness_assumed, spread })
}

/// The parameters, checked for errors that a table of links could not name.
fn ortho_parallel(given: &job::Opw) -> Result<Opw, Error> {
    let job::Opw { a1_mm, a2_mm, b_mm, c1_mm, c2_mm, c3_mm, c4_mm, joint_sign, joint_offset_deg } = *given;
    if let Some(i) = joint_sign.iter().position(|sign| sign.abs() != 1.0) {
        let field = format!("robot.opw.joint_sign[{i}]");
        return Err(Error::invalid(field, joint_sign[i], "the sign of a joint is 1 or -1"));
    }
    for (key, length) in [("c2_mm", c2_mm), ("c3_mm", c3_mm)] {
        if length < 0.001 {
            return Err(Error::invalid(
                format!("robot.opw.{key}"),
                length,
                "upper arm and forearm need a length",
            ));
        }
    }
    let lengths_mm = [a1_mm, a2_mm, b_mm, c1_mm, c2_mm, c3_mm, c4_mm];
    Ok(Opw { lengths_mm, joint_sign, joint_offset_deg })
}
