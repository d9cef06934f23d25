//! Remedies: a turn of the tool about its axis, another place for the path, a stock where the program
//! cuts, a job without shaper. They are looked for only where a warning asks for one, and by the inverse
//! model alone.

use crate::job::{Job, SpinMode, Stock};
use crate::math::{Pose, within_half_turn};
use crate::motion::{Trajectory, roll};
use crate::path::{Path, Roll};
use crate::placement;
use crate::plan::Plan;
use crate::progress::Progress;
use crate::report::limit::LIMIT_MARGIN;
use crate::report::singularity::{JUMP, is_near};
use crate::report::{Remedy, Report, UNTOUCHED};
use crate::setup;
use crate::units::{DEG, MM};
use nalgebra::Vector3;
use serde_json::json;
use std::sync::Arc;

/// Codes of warnings that another turn of the tool about its axis may cure.
const TURNED: [&str; 6] = [
    "joint-limit",
    "joint-limit-near",
    "joint-jump",
    "singularity-elbow",
    "singularity-shoulder",
    "singularity-wrist",
];
/// Codes of warnings about a shaper that does harm or nothing.
const SHAPED: [&str; 2] = ["corners-rounded", "shaper-sampling"];
/// Step of the turns tried [deg], and their number to either side.
const STEP_DEG: f64 = 10.0;
const STEPS: usize = 18;
/// Largest number of turns that are checked closely.
const MOST_CHECKED: usize = 4;
/// Most places along the path of a close check. Between them, joints turn by far less than
/// [`CORRECTION`].
const CLOSE: usize = 2000;
/// Room to the joint limits that the correction of the compensated command may take [rad].
const CORRECTION: f64 = 0.5 * DEG;

/// Adds to the warnings of a job's report the change that cures each, where one is known.
pub(super) fn offer(job: &Job, report: &mut Report) {
    let has = |code: &str| report.warnings.iter().any(|warning| warning.code == code);
    let turned = TURNED.into_iter().any(has).then(|| turned(job, &report.plan)).flatten();
    let placed = (turned.is_none() && has("joint-limit")).then(|| placed(job, &report.plan)).flatten();
    for warning in &mut report.warnings {
        warning.remedy = match warning.code {
            "joint-limit" => turned.as_ref().map(|turn| &turn.remedy).or(placed.as_ref()).cloned(),
            "joint-limit-near" => turned.as_ref().filter(|turn| turn.roomy).map(|turn| turn.remedy.clone()),
            code if TURNED.contains(&code) => turned.as_ref().map(|turn| turn.remedy.clone()),
            code if SHAPED.contains(&code) => Some(unshaped()),
            UNTOUCHED => restocked(job),
            _ => None,
        };
    }
}

/// How far a motion keeps from the limits of the arm.
struct Clearance {
    /// Least distance of a joint from its limits [rad]; negative beyond them, infinite if these are
    /// unknown.
    room: f64,
    /// Whether it comes near a singularity.
    singular: bool,
    /// Largest turn of a joint from one sample to the next [rad].
    jump: f64,
}

/// A plan at every sample, or at [`CLOSE`] places if there are more.
fn closely(plan: &Plan, path: Path) -> Plan {
    if plan.trajectory.len() > CLOSE {
        return plan.at_stations(path, CLOSE);
    }
    let trajectory = Arc::new(Trajectory::new(&path, &plan.setup.limits));
    Plan { path, trajectory, ..plan.clone() }
}

/// The clearance of a plan's motion; `None` if the arm cannot follow it.
fn clearance(plan: &Plan) -> Option<Clearance> {
    let joints = plan.joints(&mut Progress::none()).ok()?;
    let jumps = joints.q.windows(2).map(|pair| (pair[1] - pair[0]).amax());
    Some(Clearance {
        room: joints.q.iter().map(|q| plan.robot.limit_room(q)).fold(f64::INFINITY, f64::min),
        singular: joints.margin.iter().any(is_near),
        jump: jumps.fold(0.0, f64::max),
    })
}

/// A turn that clears limits and singularities.
struct TurnedTool {
    remedy: Remedy,
    /// Whether it keeps away from the limits, too.
    roomy: bool,
}

/// The smallest turn of the tool about its axis that clears joint limits and singularities, with
/// the margin that [`LIMIT_MARGIN`] asks for if one does.
fn turned(job: &Job, plan: &Plan) -> Option<TurnedTool> {
    let stations = plan.at_stations(plan.path.clone(), roll::STATIONS);
    let held = |plan: &Plan, angle_deg: f64| {
        let path = plan.path.clone().with_roll(Roll::fixed(angle_deg * DEG));
        clearance(&Plan { path, ..plan.clone() }).filter(|clearance| !clearance.singular)
    };
    let close = closely(plan, plan.path.clone());
    let is_clear = |angle_deg: f64, least: f64| {
        held(&close, angle_deg).is_some_and(|clearance| clearance.room >= least && clearance.jump <= JUMP)
    };
    let roomy = LIMIT_MARGIN + CORRECTION;
    let steps = (1..=STEPS).flat_map(|i| [i as f64, -(i as f64)]).take(2 * STEPS - 1);
    let (mut tight, mut checked) = (Vec::new(), 0);
    for turn_deg in steps.map(|step| step * STEP_DEG) {
        let angle_deg = within_half_turn(job.spin.angle_deg + turn_deg);
        match held(&stations, angle_deg) {
            Some(clearance) if clearance.room >= roomy && checked < MOST_CHECKED => {
                checked += 1;
                if is_clear(angle_deg, roomy) {
                    return Some(TurnedTool { remedy: turn(job, turn_deg, angle_deg), roomy: true });
                }
            }
            Some(clearance) if clearance.room >= CORRECTION => tight.push((turn_deg, angle_deg)),
            _ => {}
        }
    }
    let mut tight = tight.into_iter().take(MOST_CHECKED);
    let (turn_deg, angle_deg) = tight.find(|(_, angle_deg)| is_clear(*angle_deg, CORRECTION))?;
    Some(TurnedTool { remedy: turn(job, turn_deg, angle_deg), roomy: false })
}

fn turn(job: &Job, turn_deg: f64, angle_deg: f64) -> Remedy {
    match job.spin.mode {
        SpinMode::Fixed => Remedy {
            label: format!("Turn the tool {turn_deg:.0} deg about its axis"),
            patch: json!({ "spin": { "angle_deg": angle_deg } }),
        },
        SpinMode::Free => Remedy {
            label: format!("Hold the tool at {angle_deg:.0} deg about its axis"),
            patch: json!({ "spin": { "mode": "fixed", "angle_deg": angle_deg } }),
        },
    }
}

/// The path in front of the robot, if all joints then stay within their limits.
fn placed(job: &Job, plan: &Plan) -> Option<Remedy> {
    let setup = &plan.setup;
    // A free spin is chosen again at each place.
    if setup.roll_range.is_some() {
        return None;
    }
    let from = job.workpiece_frame.xyz_mm;
    let to = placement::in_front_of(setup, from).ok()?;
    let shift = (Vector3::from(to) - Vector3::from(from)) * MM;
    let position = setup.base.inverse().direction(&shift);
    let path = plan.path.placed(&Pose { position, ..Pose::identity() });
    let clearance = clearance(&closely(plan, path))?;
    let [x, y, z] = to;
    (clearance.room >= CORRECTION && clearance.jump <= JUMP).then(|| Remedy {
        label: format!("Place the path in front of the robot, with the workpiece at ({x}, {y}, {z}) mm"),
        patch: json!({ "workpiece_frame": { "xyz_mm": to } }),
    })
}

/// The stock around the program's own moves, if it has any that cut.
fn restocked(job: &Job) -> Option<Remedy> {
    let mut bare = job.clone();
    bare.stock = Stock::default();
    let proposed = setup::proposed_stock(&bare).ok()??;
    // Null removes a key (RFC 7386).
    let patch = json!({
        "kind": "extents", "top_mm": proposed.top_mm,
        "from_mm": null, "to_mm": null, "center_mm": null, "radius_mm": null, "height_mm": null,
        "allowance_mm": null, "points_mm": null, "bottom_mm": null, "stl": null, "earlier": null,
    });
    Some(Remedy {
        label: "Take the stock from the program's extents".into(),
        patch: json!({ "stock": patch }),
    })
}

fn unshaped() -> Remedy {
    Remedy { label: "Switch the shaper off".into(), patch: json!({ "shaper": "none" }) }
}
