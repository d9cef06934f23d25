//! "Thesis, recomputed": what the thesis prints beside what its own equations give, with the reason where they differ.

use crate::error::Error;
use crate::math::Pose;
use crate::motion::shaper;
use crate::report::{Report, Statistics};
use crate::robot::{Joints, Robot, forward, inverse, library};
use crate::units::{DEG, MM};
use serde::Serialize;

/// One figure of the thesis.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// What it is.
    pub quantity: &'static str,
    /// Where the thesis prints it.
    pub source: &'static str,
    /// As printed.
    pub printed: String,
    /// As its equations give it.
    pub ours: String,
    /// Whether the two agree to the digits printed.
    pub agrees: bool,
    /// Why they differ, or what to know; may be empty.
    pub reason: &'static str,
}

/// Joint values q1, q2, q3, q5 [rad] and tip position [mm] of Table 5.1; q4 is 0.
pub const TABLE_5_1: [([f64; 4], [f64; 3]); 8] = [
    ([1.4698, 1.6581, 1.5244, -0.0410], [42.5149, 419.5080, -268.7108]),
    ([1.4798, 1.6558, 1.5259, -0.0401], [38.3769, 420.5603, -267.6869]),
    ([1.4898, 1.6534, 1.5274, -0.0392], [34.2230, 421.5832, -266.6391]),
    ([1.4998, 1.6510, 1.5289, -0.0383], [30.0534, 422.5764, -265.5672]),
    ([1.5098, 1.6485, 1.5305, -0.0374], [25.8680, 423.5398, -264.4710]),
    ([1.5198, 1.6459, 1.5321, -0.0365], [21.6668, 424.4728, -263.3504]),
    ([1.5298, 1.6433, 1.5338, -0.0355], [17.4501, 425.3751, -262.2051]),
    ([1.5398, 1.6407, 1.5355, -0.0345], [13.2178, 426.2464, -261.0350]),
];

/// The RX-90 of the thesis, with its d6 [m]: Table 3.2's 85 mm, or 0 where the thesis takes the wrist point as the tip.
pub fn rx90(d6: f64) -> Result<Robot, Error> {
    let preset = library::robot("staubli-rx90")?;
    let mut links = preset.links();
    links[5].d = d6;
    Robot::new(preset.name(), links, preset.limits(), preset.joint_compliance)
}

/// All rows; `report` is the default job's.
///
/// # Errors
/// None for the default job; the inverse model's, if its robot were changed.
pub fn rows(report: &Report) -> Result<Vec<Row>, Error> {
    let mut rows = Vec::new();
    let mut row = |quantity, source, printed: &str, ours: String, agrees, reason| {
        rows.push(Row { quantity, source, printed: printed.into(), ours, agrees, reason });
    };

    let zero = forward::forward(&rx90(85.0 * MM)?, &Joints::zeros());
    let at_zero = (zero.position / MM - nalgebra::Vector3::new(0.0, 0.0, 1605.0)).norm() < 0.05;
    row("Tip at zero joint angles, mm", "eq. 3.6", "(0, 0, 1605)", point(&zero, 0), at_zero, "");

    let q = Joints::from([70.0, 20.0, 60.0, 0.0, 50.0, 100.0]) * DEG;
    let wrist = forward::forward(&rx90(0.0)?, &q);
    let printed = nalgebra::Vector3::new(271.6, 746.1, 955.7);
    let reason = "Position and approach agree with d6 = 0, the wrist point; the printed n and s columns have the opposite sign of what eq. 3.5 gives.";
    row(
        "Position for q = (70, 20, 60, 0, 50, 100) deg, mm",
        "eq. 3.22",
        "(271.6, 746.1, 955.7)",
        point(&wrist, 1),
        (wrist.position / MM - printed).norm() < 0.1,
        reason,
    );

    let solutions =
        inverse::inverse(&rx90(85.0 * MM)?, &forward::forward(&rx90(85.0 * MM)?, &q), &Joints::zeros())?;
    let reason = "Two wrists, two elbows and two shoulders: the conclusions count 6, Table 3.3 shows 2, and heads the column of theta6 with theta5.";
    row(
        "Solutions of the inverse model for that pose",
        "chapter 6",
        "6",
        solutions.iter().count().to_string(),
        false,
        reason,
    );

    let force = report.mean_force();
    let printed = nalgebra::Vector3::new(302.9372, 1071.9, 509.3078);
    let reason = "Closed form; the printed digits carry the error of the thesis's step in angle.";
    let ours = format!("({:.3}, {:.3}, {:.3})", force.x, force.y, force.z);
    row(
        "Mean cutting force, N",
        "eq. 4.7",
        "(302.9372, 1071.9, 509.3078)",
        ours,
        (force - printed).norm() < 1e-4 * force.norm(),
        reason,
    );

    let shaped = shaper::kind("zvd").map(|kind| (kind.impulses)(18.0, 0.1)).unwrap_or_default();
    let text: Vec<_> = shaped.iter().map(|i| format!("{:.4} at {:.4}", i.amplitude, i.time)).collect();
    let printed = [(0.3344, 0.0), (0.4877, 0.1754), (0.1778, 0.3508)];
    let agrees = shaped.len() == 3
        && shaped
            .iter()
            .zip(printed)
            .all(|(i, (a, t))| (i.amplitude - a).abs() < 1e-4 && (i.time - t).abs() < 1e-4);
    let reason =
        "The text says 18 Hz, the numbers are those of 18 rad/s (2.9 Hz); at 18 Hz the shaper lasts 0.056 s.";
    row(
        "ZVD impulses and their times in s",
        "eq. 4.15",
        "0.3344 at 0, 0.4877 at 0.1754, 0.1778 at 0.3508",
        text.join(", "),
        agrees,
        reason,
    );

    let mut worst = 0.0_f64;
    let mut radii = (f64::INFINITY, 0.0_f64);
    for ([q1, q2, q3, q5], printed) in TABLE_5_1 {
        let tip = forward::forward(&rx90(0.0)?, &Joints::from([q1, q2, q3, 0.0, q5, 0.0])).position / MM;
        let printed = nalgebra::Vector3::from(printed);
        worst = worst.max((tip - printed).norm());
        radii = (radii.0.min(printed.norm()), radii.1.max(printed.norm()));
    }
    let reason = "With d6 = 0: the wrist point stands for the tip there.";
    row(
        "Points from the joint angles, largest difference in mm",
        "Table 5.1",
        "0",
        format!("{worst:.3}"),
        worst < 0.06,
        reason,
    );
    let reason = "The points of Table 5.1 lie on a circle of 500 mm about the base, not on the 300 mm that the text states.";
    row(
        "Radius of the circle, mm",
        "section 5.2",
        "300",
        format!("{:.1} to {:.1}", radii.0, radii.1),
        false,
        reason,
    );

    let deflection = Statistics::from(report.deflection_only.statistics);
    let reason = "J C J^T of the thesis's own tables gives 1.5 to 2 times less; eq. 3.34 is off by one joint for modified Denavit-Hartenberg frames, which explains most of it. Also d6 and the circle's radius differ between text and tables.";
    row(
        "Contour error by cutting forces, mean and max, mm",
        "Fig. 5.8",
        "1.6 and 2.5",
        mean_max(deflection),
        false,
        reason,
    );

    let shaping = Statistics::from(report.shaping_only.statistics);
    let agrees = (shaping.mean - 0.1).abs() < 0.005 && (shaping.max - 0.16).abs() < 0.005;
    let reason = "The mean agrees to the digit that is printed. The maximum comes out at 0.18 mm whatever the sample time; the figure's data are lost.";
    row(
        "Contour error by the ZVD shaper, mean and max, mm",
        "Fig. 5.9",
        "0.1 and 0.16",
        mean_max(shaping),
        agrees,
        reason,
    );

    let after = Statistics::from(report.after.statistics);
    let reason = "The correction is filed under the command that causes the error; filed under the time index it stays at 0.02 mm.";
    row(
        "Combined contour error after compensation, max, mm",
        "Fig. 5.18",
        "below 0.02",
        format!("{:.4}", after.max),
        after.max < 0.02,
        reason,
    );

    let turn = report
        .q
        .iter()
        .map(|q| q[0])
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), q| (low.min(q), high.max(q)));
    let reason = "The circle runs all around the base: joint 1 turns once, beyond any RX-90's range of about +-160 deg. We compute it and warn.";
    let turned = (turn.1 - turn.0) / DEG;
    row(
        "Turn of joint 1 along the circle, deg",
        "Fig. 5.4",
        "within the robot's range",
        format!("{turned:.0}"),
        turned < 320.0,
        reason,
    );

    let chip = report.setup().limits.feed / report.setup().teeth_per_second / MM;
    let reason = "The feed of 100 mm/s at 4000 rpm and 4 flutes gives more than the chip that the forces were computed with. We keep 0.1 mm, as printed, and warn.";
    row(
        "Feed per tooth, mm",
        "sections 4.2, 5.2",
        "0.1",
        format!("{chip:.3}"),
        (chip - 0.1).abs() < 0.001,
        reason,
    );
    Ok(rows)
}

fn point(pose: &Pose, decimals: usize) -> String {
    // A rounding error must not show as -0.
    let [x, y, z]: [f64; 3] = (pose.position / MM).map(|v| if v.abs() < 1e-6 { 0.0 } else { v }).into();
    format!("({x:.decimals$}, {y:.decimals$}, {z:.decimals$})")
}

fn mean_max(statistics: Statistics) -> String {
    format!("{:.3} and {:.3}", statistics.mean, statistics.max)
}
