//! Whether the drives can follow: acceleration and joint speeds of the shaped command.
//!
//! The force sets in and turns within a few samples, and the correction with it. A controller does
//! not accelerate an arm like that: it trips, or goes elsewhere.

use crate::motion::shaper::Shaped;
use crate::report::span::{Span, spans};
use crate::report::{Report, Warning};
use crate::robot::{Elbow, Joints, forward};
use crate::units::{DEG, MM};
use nalgebra::Vector3;

/// Interval of the second difference [s]: three cycles of a common robot controller.
const INTERVAL: f64 = 0.012;
/// Number of steps that the interval is divided into where samples are that fine.
const STEPS: usize = 3;
/// The command may accelerate this many times as much as the job's motion along the path.
const ALLOWED: f64 = 3.0;

/// All warnings about the drives.
pub(super) fn warnings(report: &Report) -> Vec<Warning> {
    let command = report.shaped(&report.compensation.q);
    let speed = match report.setup().joint_speeds {
        None => Some(Warning::new(
            "joint-speeds-unknown",
            "the maximum joint speeds of this robot are not known, so they are not checked",
        )),
        Some(largest) => joint_speed(report, &command, &largest),
    };
    acceleration(report, &command).into_iter().chain(speed).collect()
}

/// A command that accelerates the tool more than any drive follows: the second difference of the
/// commanded tip over [`INTERVAL`].
fn acceleration(report: &Report, command: &Shaped<Joints>) -> Option<Warning> {
    let dt = report.plan.trajectory.sample_time;
    // Whole samples, and not every sample on a fine grid.
    if dt > INTERVAL + 1e-9 {
        let message = format!(
            "samples every {dt} s are too far apart to judge what the drives can follow, so the acceleration of \
             the command is not checked; use {INTERVAL} s or less (motion.sample_time_s)"
        );
        return Some(Warning::new("command-unchecked", message));
    }
    let step = ((INTERVAL / dt / STEPS as f64).round() as usize).max(1);
    let reach = ((INTERVAL / (dt * step as f64)).round() as usize).max(1);
    let limit = ALLOWED * report.setup().limits.acceleration;
    let tips: Vec<Vector3<f64>> = (0..report.samples())
        .step_by(step)
        .map(|k| forward::forward(&report.plan.robot, &command.at(k)).position)
        .collect();
    let span = (reach * step) as f64 * dt;
    let size = |i: usize| (tips[i + reach] - tips[i] * 2.0 + tips[i - reach]).norm() / (span * span);
    let inner = reach..tips.len().saturating_sub(reach);
    let beyond = || inner.clone().filter(|&i| size(i) > limit);
    let all = spans(tips.len(), |i| inner.contains(&i) && size(i) > limit);
    let all: Vec<Span> = all.into_iter().map(|(first, last)| (first * step, last * step)).collect();
    let worst = beyond().max_by(|&a, &b| size(a).total_cmp(&size(b)))?;
    let message = format!(
        "the command would accelerate the tool at {:.0} mm/s², more than {ALLOWED:.0} times the motion's {:.0} mm/s²: no \
         arm can follow that; a shaper, rounded corners, lead-ins and lead-outs or a lighter cut make it smoother",
        size(worst) / MM,
        report.setup().limits.acceleration / MM
    );
    Warning::new("command-acceleration", message).within(&all, dt)
}

/// A joint that would have to turn faster than it can; `largest` are the drives' speeds [rad/s].
fn joint_speed(report: &Report, command: &Shaped<Joints>, largest: &Joints) -> Option<Warning> {
    let (robot, dt) = (&report.plan.robot, report.plan.trajectory.sample_time);
    // Where joint 3 is counted from the base, its drive still turns against the upper arm.
    let drives = |k: usize| {
        let q = command.at(k);
        if robot.elbow() == Elbow::Pendant { robot.to_serial(&q) } else { q }
    };
    let mut before = drives(0);
    let (mut all, mut worst) = (Vec::<Span>::new(), (1.0, 0));
    for k in 1..report.samples() {
        let now = drives(k);
        let share = (now - before).abs().component_div(largest) / dt;
        before = now;
        let joint = share.imax();
        if share[joint] > 1.0 {
            // From one sample to the next: both belong to it.
            match all.last_mut() {
                Some((_, last)) if *last + 1 == k => *last = k,
                _ => all.push((k - 1, k)),
            }
            if share[joint] > worst.0 {
                worst = (share[joint], joint);
            }
        }
    }
    let (share, joint) = worst;
    let message = format!(
        "joint {} would have to turn at {:.0} deg/s; its maximum is {:.0} deg/s",
        joint + 1,
        share * largest[joint] / DEG,
        largest[joint] / DEG
    );
    Warning::new("joint-speed", message).within(&all, dt)
}
