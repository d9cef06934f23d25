//! The arm's posture at the points of a program, from which each controller's own words for it follow.

use crate::error::Error;
use crate::export::command::Command;
use crate::report::Report;
use crate::robot::{Joints, Robot, forward, inverse};
use nalgebra::Vector3;

/// Joint values at the start of a command and at the end of each of its steps [rad], each set the
/// nearest to the one before; the first, to the start of the simulated motion.
///
/// # Errors
/// See [`inverse::inverse`].
pub fn joints(report: &Report, command: &Command) -> Result<Vec<Joints>, Error> {
    let robot = &report.plan.robot;
    let mut near = report.compensation.q[0];
    let points = command.moves.iter().flat_map(|commanded| commanded.points());
    let mut all = Vec::with_capacity(command.points());
    for point in std::iter::once(&command.start).chain(points) {
        let tcp = report.setup().workpiece.compose(&command.pose(point));
        near = inverse::inverse(robot, &tcp, &near)?.nearest(&near).map_or(near, |solution| solution.q);
        all.push(near);
    }
    Ok(all)
}

/// Which of the arm's shapes it is in, seen in the plane of its upper arm and forearm.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Posture {
    /// The wrist centre is behind axis 1, seen along the arm.
    pub behind: bool,
    /// The wrist centre is in front of the line through axes 2 and 3.
    pub bent_forward: bool,
    /// Joint 5 is negative.
    pub wrist_negative: bool,
}

impl Posture {
    /// For the joint values `q` [rad].
    pub fn of(robot: &Robot, q: &Joints) -> Self {
        let frames = forward::frames(robot, q);
        let ahead: Vector3<f64> = frames[0].rotation.column(0).into();
        let [foot, shoulder, elbow, wrist] = [0, 1, 2, 3].map(|i| frames[i].position);
        let in_plane = |v: Vector3<f64>| (v.dot(&ahead), v.z);
        let (upper, fore) = (in_plane(elbow - shoulder), in_plane(wrist - elbow));
        Self {
            behind: (wrist - foot).dot(&ahead) < 0.0,
            bent_forward: upper.1 * fore.0 - upper.0 * fore.1 > 0.0,
            wrist_negative: q[4] < 0.0,
        }
    }
}

/// Whether the arm changes its posture between joint values [rad] that follow each other: linear moves
/// keep it, and controllers stop where they cannot.
pub fn changes(robot: &Robot, joints: &[Joints]) -> bool {
    joints.windows(2).any(|pair| Posture::of(robot, &pair[0]) != Posture::of(robot, &pair[1]))
}

/// Turns of an axis at an angle [deg]: 0 from -180 to 180, 1 to 540, and so on.
pub fn turns(angle: f64) -> i32 {
    let whole = ((angle.abs() + 180.0) / 360.0).floor() as i32;
    if angle < 0.0 { -whole } else { whole }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Elbow, Opw};
    use crate::units::DEG;

    fn robot(lengths_mm: [f64; 7], joint_sign: [f64; 6], joint_offset_deg: [f64; 6], elbow: Elbow) -> Robot {
        let opw = Opw { lengths_mm, joint_sign, joint_offset_deg };
        Robot::new("", opw.links(), None, [0.0; 6]).unwrap().with_elbow(elbow).unwrap()
    }

    #[test]
    fn fanuc_letters_are_those_that_roboguide_gives() {
        // M-20iD/25, joints as its pendant shows them, and CONFIG as ROBOGUIDE computed it (public
        // repository LeroyDu56/CrossArm, tests/fixtures/probes/results/CFGPROBE_roboguide.LS).
        let arm = robot(
            [75.0, -215.0, 0.0, 0.0, 840.0, 890.0, 90.0],
            [1.0, 1.0, -1.0, -1.0, -1.0, -1.0],
            [0.0, 0.0, -90.0, 0.0, 0.0, 180.0],
            Elbow::Pendant,
        );
        for (q, config) in [
            ([0, 0, 0, 0, -90, 0], "N U T 0 0 0"),
            ([0, 0, 0, 0, 90, 0], "F U T 0 0 0"),
            ([0, 0, 0, 0, -30, 0], "N U T 0 0 0"),
            ([0, 0, 0, 0, 30, 0], "F U T 0 0 0"),
            ([0, 0, 0, 185, -90, 0], "N U T 0 1 0"),
            ([0, 0, 0, -185, -90, 0], "N U T 0 -1 0"),
            ([0, 0, 0, 0, -90, 190], "N U T 0 0 1"),
            ([0, 0, 0, 0, -90, -190], "N U T 0 0 -1"),
            ([0, 0, 0, 0, -90, 350], "N U T 0 0 1"),
            ([0, 40, 60, 0, -90, 0], "N D T 0 0 0"),
            ([0, 40, -60, 0, -90, 0], "N U T 0 0 0"),
            ([0, -60, -80, 0, -90, 0], "N D B 0 0 0"),
            ([0, -60, 80, 0, -90, 0], "N U B 0 0 0"),
            ([0, 60, 80, 0, -90, 0], "N D T 0 0 0"),
            ([90, 0, 0, 0, -90, 0], "N U T 0 0 0"),
            ([-150, 0, 0, 0, -90, 0], "N U T 0 0 0"),
        ] {
            let q = q.map(f64::from);
            let posture = Posture::of(&arm, &(Joints::from(q) * DEG));
            let letter = |is: bool, yes: &'static str, no: &'static str| if is { yes } else { no };
            let found = format!(
                "{} {} {} {} {} {}",
                letter(posture.wrist_negative, "N", "F"),
                letter(posture.bent_forward, "U", "D"),
                letter(posture.behind, "B", "T"),
                turns(q[0]),
                turns(q[3]),
                turns(q[5])
            );
            assert_eq!(found, config, "{q:?}");
        }
        assert_eq!([-541.0, -180.0, 180.0, 539.0, 540.0].map(turns), [-2, -1, 1, 1, 2]);
    }

    #[test]
    fn an_arm_over_its_back_and_one_in_front() {
        // IRB 1660ID: joint values and the fourth number of confdata, by its wrist centre 372 mm behind
        // axis 1 and 677 mm in front of the upper arm (tests of the public library
        // py-opw-kinematics).
        let arm = robot(
            [150.0, -110.0, 0.0, 486.5, 700.0, 678.0, 135.0],
            [1.0; 6],
            [0.0, 0.0, -90.0, 0.0, 0.0, 0.0],
            Elbow::Serial,
        );
        for (q, wrist_negative) in [
            ([-103.1, -85.03, 19.06, -70.19, -35.87, 185.01], true),
            ([-103.1, -85.03, 19.06, 109.81, 35.87, 5.01], false),
        ] {
            let posture = Posture::of(&arm, &(Joints::from(q) * DEG));
            assert_eq!(posture, Posture { behind: true, bent_forward: true, wrist_negative });
        }
        // KR 210 R2700-2 at a point that a milling cell stores with status 6 of its lower bits (public
        // repository HugoDanielson/ChinaMilling, spindle_main.dat, P2: S 22).
        let arm = robot(
            [330.0, -115.0, 0.0, 645.0, 1150.0, 1220.0, 215.0],
            [-1.0, 1.0, 1.0, -1.0, 1.0, -1.0],
            [0.0, -90.0, 0.0, 0.0, 0.0, 0.0],
            Elbow::Serial,
        );
        let q = [19.39, -79.64, 81.08, 183.67, -88.68, -178.92];
        let posture = Posture::of(&arm, &(Joints::from(q) * DEG));
        assert_eq!(posture, Posture { behind: false, bent_forward: true, wrist_negative: true });
        // Its upper arm upright and its forearm ahead; then the forearm folded back over it.
        let home = Posture::of(&arm, &(Joints::from([0.0, -90.0, 90.0, 0.0, 30.0, 0.0]) * DEG));
        assert_eq!(home, Posture { behind: false, bent_forward: true, wrist_negative: false });
        let back = Posture::of(&arm, &(Joints::from([0.0, -90.0, -60.0, 0.0, 30.0, 0.0]) * DEG));
        assert_eq!(back, Posture { behind: true, bent_forward: false, wrist_negative: false });
    }
}
