//! The correction at the cycle of an interface.

use crate::export::header::number;
use crate::export::orientation::roll_pitch_yaw;
use crate::report::Report;
use crate::units::{DEG, MM};
use nalgebra::Vector3;

/// The correction of a path over time.
#[derive(Debug, Clone, PartialEq)]
pub struct CorrectionTable {
    /// Time from row to row [s].
    pub cycle: f64,
    /// The rows; the last one is at the end of the run or after it.
    pub rows: Vec<CorrectionRow>,
}

/// The correction at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CorrectionRow {
    /// Time [s].
    pub time: f64,
    /// Arc length of the desired path [m].
    pub arc_length: f64,
    /// Commanded less desired position, in the frame of the workpiece [m].
    pub shift: Vector3<f64>,
    /// The turn from the desired to the commanded orientation: A, B, C [deg] about z, the new y and the new x of the
    /// workpiece.
    pub turn: [f64; 3],
    /// The same shift along the path, across it and along the tool [m]: x along the feed, y = tool z × x with the tool's z out
    /// of the tool, z = x × y.
    pub in_path: Vector3<f64>,
}

impl CorrectionTable {
    /// The report's correction at the job's `online.cycle_s`. Between two samples it is interpolated; after the last one it
    /// stays.
    pub fn of(report: &Report) -> Self {
        let samples: Vec<CorrectionRow> = (0..report.samples()).map(|k| row(report, k)).collect();
        let step = report.plan.trajectory.sample_time;
        let cycle = report.setup().correction_cycle;
        let last = samples.len() - 1;
        let count = (last as f64 * step / cycle - 1e-9).ceil() as usize + 1;
        let at = |time: f64| {
            let place = time / step;
            let k = ((place + 1e-9).floor() as usize).min(last);
            let (from, to) = (&samples[k], &samples[(k + 1).min(last)]);
            let share = (place - k as f64).clamp(0.0, 1.0);
            let between = |a: f64, b: f64| a + (b - a) * share;
            CorrectionRow {
                time,
                arc_length: between(from.arc_length, to.arc_length),
                shift: from.shift + (to.shift - from.shift) * share,
                turn: [0, 1, 2].map(|axis| between(from.turn[axis], to.turn[axis])),
                in_path: from.in_path + (to.in_path - from.in_path) * share,
            }
        };
        Self { cycle, rows: (0..count).map(|row| at(row as f64 * cycle)).collect() }
    }

    /// Largest shift [m].
    pub fn largest_shift(&self) -> f64 {
        self.rows.iter().map(|row| row.shift.norm()).fold(0.0, f64::max)
    }

    /// Largest shift along one axis of the workpiece [m].
    pub fn largest_component(&self) -> f64 {
        self.rows.iter().map(|row| row.shift.amax()).fold(0.0, f64::max)
    }

    /// Largest of the angles A, B and C [deg].
    pub fn largest_turn(&self) -> f64 {
        self.rows.iter().flat_map(|row| row.turn).map(f64::abs).fold(0.0, f64::max)
    }

    /// The rows as CSV.
    pub fn csv(&self) -> String {
        let mut text = String::from("time_s,s_mm,dx_mm,dy_mm,dz_mm,a_deg,b_deg,c_deg\n");
        for row in &self.rows {
            let first = [number(row.time, 6), number(row.arc_length / MM, 4)];
            let shift = row.shift.iter().map(|shift| number(shift / MM, 5));
            let cells = first.into_iter().chain(shift).chain(row.turn.map(|angle| number(angle, 6)));
            text.push_str(&cells.collect::<Vec<_>>().join(","));
            text.push('\n');
        }
        text
    }
}

/// The correction at the sample `k`.
fn row(report: &Report, k: usize) -> CorrectionRow {
    let trajectory = &report.plan.trajectory;
    let into = report.setup().workpiece.inverse();
    let arc_length = trajectory.timing.arc_length[k];
    let correction = report.compensation.correction[k];
    let (desired, commanded) = (trajectory.axis.at(k), report.compensation.axis.at(k));
    let turn = match desired == commanded {
        true => [0.0; 3],
        false => {
            let path = &report.plan.path;
            let [from, to] = [desired, commanded].map(|axis| path.orientation(arc_length, axis, 0.0));
            let turned = into.rotation * (to * from.transpose()) * into.rotation.transpose();
            let [c, b, a] = roll_pitch_yaw(&turned);
            [a, b, c].map(|angle| angle / DEG)
        }
    };
    let x = trajectory.timing.heading[k];
    let y = (-desired).cross(&x);
    // Where the tool moves along itself, there is no direction across.
    let y = if y.norm() > 1e-9 { y.normalize() } else { Vector3::zeros() };
    let in_path = Vector3::new(correction.dot(&x), correction.dot(&y), correction.dot(&x.cross(&y)));
    CorrectionRow {
        time: k as f64 * trajectory.sample_time,
        arc_length,
        shift: into.direction(&correction),
        turn,
        in_path,
    }
}
