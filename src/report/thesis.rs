//! "Thesis, recomputed": the printed figures beside those that its own equations give, and the
//! reason where they differ.

use crate::compensation::{Compensation, Question, compensate};
use crate::cutting::{Cut, Hand, Loading, MeanForces, along};
use crate::deviation::{Deviation, Reference, Source, Sources, simulate};
use crate::error::Error;
use crate::math::Pose;
use crate::motion::TimingLaw;
use crate::motion::shaper::{self, Impulse};
use crate::plan::Plan;
use crate::progress::Progress;
use crate::report::{Report, Statistics};
use crate::robot::{Joints, Robot, forward, inverse, library};
use crate::setup::Setup;
use crate::units::{DEG, MM};
use nalgebra::Vector3;
use serde::Serialize;
use std::sync::Arc;

/// One figure of the thesis.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ThesisRow {
    /// The quantity.
    pub quantity: &'static str,
    /// Where the thesis prints it.
    pub source: &'static str,
    /// As printed.
    pub printed: &'static str,
    /// As computed from its equations.
    pub ours: String,
    /// Whether the two agree to the digits printed.
    pub agrees: bool,
    /// Why they differ, or what else to note; may be empty.
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

/// The RX-90 of the thesis, with its d6 [m]: Table 3.2's 85 mm, or 0 where the thesis takes the
/// wrist point as the tip.
pub fn rx90(d6: f64) -> Result<Robot, Error> {
    let preset = library::robot("staubli-rx90")?;
    let mut links = preset.links();
    links[5].d = d6;
    Robot::new(preset.name(), links, preset.limits(), preset.joint_compliance)
}

/// The thesis's own force along the default job: constant from start to end, with the axial force
/// towards the spindle (eq. 4.3).
#[derive(Debug, Clone)]
pub struct ConstantForce {
    /// Mean force in {T} [N] (eq. 4.7).
    pub force: Vector3<f64>,
    /// Deviation of the desired path by this force alone.
    pub deflection_only: Deviation,
    /// Deviation of the desired path by force and shaper.
    pub before: Arc<Deviation>,
    /// Compensation of both.
    pub compensation: Compensation,
}

impl ConstantForce {
    /// The case for the default job's report.
    pub fn of(report: &Report) -> Self {
        let setup = report.setup();
        // On a flat end mill only the hand of the helix decides the direction of the axial force.
        let force = Cut { hand: Hand::Left, ..setup.cut }.mean_force();
        let mean = MeanForces::Stated(force);
        let loading = Loading { run_in: 0.0, ..setup.loading };
        let plan = Plan {
            setup: Setup { mean_force: mean.clone(), loading, ..setup.clone() }.into(),
            ..report.plan.clone()
        };
        let reference = |acting: Sources| {
            let timing = plan.timing(acting).into_owned();
            let full = TimingLaw { speed: vec![setup.limits.feed; timing.speed.len()], ..timing.clone() };
            let force = along::forces(&plan.path, &full, &mean, &loading);
            Reference::under(&plan.path, timing, acting, (force, Vec::new()))
        };
        let alone = reference(Sources::only(Source::Deflection));
        let both = reference(Sources::ALL);
        let before = Arc::new(simulate(&plan, &both, &report.q, &mut Progress::none()));
        let question = Question { reference: &both, q: &report.q, before: &before, goal: setup.goal };
        Self {
            force: force.at(report.feed_per_tooth()),
            deflection_only: simulate(&plan, &alone, &report.q, &mut Progress::none()),
            compensation: compensate(&plan, &question, &mut Progress::none()),
            before,
        }
    }
}

/// All rows; `report` is the default job's.
///
/// # Errors
/// None for the default job; the inverse model's, if its robot were changed.
pub fn rows(report: &Report) -> Result<Vec<ThesisRow>, Error> {
    let constant = ConstantForce::of(report);
    Ok(vec![
        tip_at_zero()?,
        pose()?,
        solutions()?,
        mean_force(&constant),
        impulses(),
        points()?,
        radius(),
        errors_by_force(&constant),
        errors_by_shaper(report),
        error_after(&constant),
        turn_of_joint_1(report),
        feed_per_tooth(report),
    ])
}

/// The joint values of eq. 3.22 [rad].
fn pose_of_eq_3_22() -> Joints {
    Joints::from([70.0, 20.0, 60.0, 0.0, 50.0, 100.0]) * DEG
}

fn tip_at_zero() -> Result<ThesisRow, Error> {
    let zero = forward::forward(&rx90(85.0 * MM)?, &Joints::zeros());
    Ok(ThesisRow {
        quantity: "Tip at zero joint angles, mm",
        source: "eq. 3.6",
        printed: "(0, 0, 1605)",
        ours: point(&zero, 0),
        agrees: (zero.position / MM - Vector3::new(0.0, 0.0, 1605.0)).norm() < 0.05,
        reason: "",
    })
}

fn pose() -> Result<ThesisRow, Error> {
    let wrist = forward::forward(&rx90(0.0)?, &pose_of_eq_3_22());
    Ok(ThesisRow {
        quantity: "Position for q = (70, 20, 60, 0, 50, 100) deg, mm",
        source: "eq. 3.22",
        printed: "(271.6, 746.1, 955.7)",
        ours: point(&wrist, 1),
        agrees: (wrist.position / MM - Vector3::new(271.6, 746.1, 955.7)).norm() < 0.1,
        reason: "Position and approach agree with d6 = 0, the wrist point; the printed columns \
                 n and s have the opposite sign to eq. 3.5.",
    })
}

fn solutions() -> Result<ThesisRow, Error> {
    let robot = rx90(85.0 * MM)?;
    let tcp = forward::forward(&robot, &pose_of_eq_3_22());
    let solutions = inverse::inverse(&robot, &tcp, &Joints::zeros())?;
    Ok(ThesisRow {
        quantity: "Solutions of the inverse model for that pose",
        source: "chapter 6",
        printed: "6",
        ours: solutions.iter().count().to_string(),
        agrees: false,
        reason: "Two wrists, two elbows and two shoulders: the conclusions count 6, Table 3.3 shows 2, and \
                 heads the column of theta6 with theta5.",
    })
}

fn mean_force(case: &ConstantForce) -> ThesisRow {
    let force = case.force;
    ThesisRow {
        quantity: "Mean cutting force, N",
        source: "eq. 4.7",
        printed: "(302.9372, 1071.9, 509.3078)",
        ours: format!("({:.3}, {:.3}, {:.3})", force.x, force.y, force.z),
        agrees: (force - Vector3::new(302.9372, 1071.9, 509.3078)).norm() < 1e-4 * force.norm(),
        reason: "Closed form; the printed digits contain the error of the thesis's angular step. The axial \
                 force has the thesis's sign, towards the spindle. A right-hand helix pulls the other \
                 way, and so Armill does in every job.",
    }
}

fn impulses() -> ThesisRow {
    let shaped = shaper::kind("zvd").map(|kind| (kind.impulses)(18.0, 0.1)).unwrap_or_default();
    let text: Vec<_> = shaped.iter().map(|i| format!("{:.4} at {:.4}", i.amplitude, i.time)).collect();
    let printed = [(0.3344, 0.0), (0.4877, 0.1754), (0.1778, 0.3508)];
    let same =
        |(i, (a, t)): (&Impulse, (f64, f64))| (i.amplitude - a).abs() < 1e-4 && (i.time - t).abs() < 1e-4;
    ThesisRow {
        quantity: "ZVD impulses and their times in s",
        source: "eq. 4.15",
        printed: "0.3344 at 0, 0.4877 at 0.1754, 0.1778 at 0.3508",
        ours: text.join(", "),
        agrees: shaped.len() == 3 && shaped.iter().zip(printed).all(same),
        reason: "The text says 18 Hz, but the numbers are for 18 rad/s (2.9 Hz); at 18 Hz the \
                 shaper would last 0.056 s.",
    }
}

fn points() -> Result<ThesisRow, Error> {
    let robot = rx90(0.0)?;
    let differences = TABLE_5_1.map(|([q1, q2, q3, q5], printed)| {
        let tip = forward::forward(&robot, &Joints::from([q1, q2, q3, 0.0, q5, 0.0])).position / MM;
        (tip - Vector3::from(printed)).norm()
    });
    let worst = differences.into_iter().fold(0.0, f64::max);
    Ok(ThesisRow {
        quantity: "Points from the joint angles, largest difference in mm",
        source: "Table 5.1",
        printed: "0",
        ours: format!("{worst:.3}"),
        agrees: worst < 0.06,
        reason: "With d6 = 0: the wrist point is used as the tip there.",
    })
}

fn radius() -> ThesisRow {
    let radii = TABLE_5_1.map(|(_, printed)| Vector3::from(printed).norm());
    let smallest = radii.into_iter().fold(f64::INFINITY, f64::min);
    let largest = radii.into_iter().fold(0.0, f64::max);
    ThesisRow {
        quantity: "Radius of the circle, mm",
        source: "section 5.2",
        printed: "300",
        ours: format!("{smallest:.1} to {largest:.1}"),
        agrees: false,
        reason: "The points of Table 5.1 lie on a circle of 500 mm about the base, not on the 300 mm that \
                 the text states.",
    }
}

fn errors_by_force(case: &ConstantForce) -> ThesisRow {
    ThesisRow {
        quantity: "Contour error by cutting forces, mean and max, mm",
        source: "Fig. 5.8",
        printed: "1.6 and 2.5",
        ours: mean_max(case.deflection_only.statistics.into()),
        agrees: false,
        reason: "With the thesis's force: constant, its axial part towards the spindle. J C J^T of the thesis's \
                 own tables gives 1.5 to 2 times less; eq. 3.34 is off by one joint for modified \
                 Denavit-Hartenberg frames, which explains most of it. Also d6 and the circle's radius differ \
                 between text and tables.",
    }
}

fn errors_by_shaper(report: &Report) -> ThesisRow {
    let shaping = Statistics::from(report.shaping_only.statistics);
    ThesisRow {
        quantity: "Contour error by the ZVD shaper, mean and max, mm",
        source: "Fig. 5.9",
        printed: "0.1 and 0.16",
        ours: mean_max(shaping),
        agrees: (shaping.mean - 0.1).abs() < 0.005 && (shaping.max - 0.16).abs() < 0.005,
        reason: "The mean agrees to the last printed digit. The maximum is 0.18 mm at \
                 any sample time; the figure's data are lost.",
    }
}

fn error_after(case: &ConstantForce) -> ThesisRow {
    let after = Statistics::from(case.compensation.result.statistics);
    ThesisRow {
        quantity: "Combined contour error after compensation, max, mm",
        source: "Fig. 5.18",
        printed: "below 0.02",
        ours: format!("{:.4}", after.max),
        agrees: after.max < 0.02,
        reason: "With the thesis's force, constant from the first sample on. The correction is assigned \
                 to the command that causes the error; assigned to the time index, it stays at 0.02 mm.",
    }
}

fn turn_of_joint_1(report: &Report) -> ThesisRow {
    let joint_1 = || report.q.iter().map(|q| q[0]);
    let (low, high) = (joint_1().fold(f64::INFINITY, f64::min), joint_1().fold(f64::NEG_INFINITY, f64::max));
    let turned = (high - low) / DEG;
    ThesisRow {
        quantity: "Turn of joint 1 along the circle, deg",
        source: "Fig. 5.4",
        printed: "within the robot's range",
        ours: format!("{turned:.0}"),
        agrees: turned < 320.0,
        reason: "The circle runs all around the base: joint 1 turns once, beyond the RX-90's range of \
                 about +-160 deg. Armill computes it and warns.",
    }
}

fn feed_per_tooth(report: &Report) -> ThesisRow {
    let chip = report.setup().limits.feed / report.setup().teeth_per_second / MM;
    ThesisRow {
        quantity: "Feed per tooth, mm",
        source: "sections 4.2, 5.2",
        printed: "0.1",
        ours: format!("{chip:.3}"),
        agrees: (chip - 0.1).abs() < 0.001,
        reason: "The feed of 100 mm/s at 4000 rpm and 4 flutes gives a larger chip than the \
                 forces were computed with. Armill keeps 0.1 mm, as printed, and warns.",
    }
}

fn point(pose: &Pose, decimals: usize) -> String {
    // A rounding error must not show as -0.
    let [x, y, z]: [f64; 3] = (pose.position / MM).map(|v| if v.abs() < 1e-6 { 0.0 } else { v }).into();
    format!("({x:.decimals$}, {y:.decimals$}, {z:.decimals$})")
}

fn mean_max(statistics: Statistics) -> String {
    format!("{:.3} and {:.3}", statistics.mean, statistics.max)
}
