//! The correction at the cycle of an interface.
//!
//! An interface adds its correction behind the controller's own filter. Where that shapes the desired program, S(d), the tip
//! gets the corrected commands' way S(c) by adding S(c - d), at the place where the shaped program has the tool.

use crate::export::header::number;
use crate::export::orientation::roll_pitch_yaw;
use crate::job::Sources;
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
    /// Largest shift at any sample [m].
    pub largest_shift: f64,
    /// Largest shift along one axis of the workpiece at any sample [m].
    pub largest_component: f64,
    /// Largest of the angles A, B and C at any sample [deg].
    pub largest_turn: f64,
    /// Largest part of a shift at any sample that is not across the path [m].
    pub largest_along: f64,
}

/// The correction at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CorrectionRow {
    /// Time [s].
    pub time: f64,
    /// Arc length of the desired path where the controller has the tool [m].
    pub arc_length: f64,
    /// What is added to its position, in the frame of the workpiece [m].
    pub shift: Vector3<f64>,
    /// What is added to its orientation: A, B, C [deg] about z, the new y and the new x of the workpiece.
    pub turn: Vector3<f64>,
    /// The shift across the path, y and z [m]: y = tool z × x and z = x × y, with x along the feed and the tool's z out of the
    /// tool. Zero where the tool moves along itself.
    pub across: [f64; 2],
}

impl CorrectionTable {
    /// The report's correction at the job's `online.cycle_s`. Between two samples it is interpolated; after the last one it
    /// stays.
    pub fn of(report: &Report) -> Self {
        let samples = samples(report);
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
                turn: from.turn + (to.turn - from.turn) * share,
                across: [0, 1].map(|way| between(from.across[way], to.across[way])),
            }
        };
        let most = |of: fn(&CorrectionRow) -> f64| samples.iter().map(of).fold(0.0, f64::max);
        Self {
            cycle,
            rows: (0..count).map(|row| at(row as f64 * cycle)).collect(),
            largest_shift: most(|row| row.shift.norm()),
            largest_component: most(|row| row.shift.amax()),
            largest_turn: most(|row| row.turn.amax()),
            largest_along: most(CorrectionRow::along),
        }
    }

    /// The rows as CSV.
    pub fn csv(&self) -> String {
        let mut text = String::from("time_s,s_mm,dx_mm,dy_mm,dz_mm,a_deg,b_deg,c_deg\n");
        for row in &self.rows {
            let first = [number(row.time, 6), number(row.arc_length / MM, 4)];
            let shift = row.shift.iter().map(|shift| number(shift / MM, 5));
            let cells = first.into_iter().chain(shift).chain(row.turn.iter().map(|angle| number(*angle, 6)));
            text.push_str(&cells.collect::<Vec<_>>().join(","));
            text.push('\n');
        }
        text
    }
}

impl CorrectionRow {
    /// Length of the part of the shift that is not across the path [m].
    pub fn along(&self) -> f64 {
        let [y, z] = self.across;
        (self.shift.norm_squared() - y * y - z * z).max(0.0).sqrt()
    }
}

/// The correction at each sample.
fn samples(report: &Report) -> Vec<CorrectionRow> {
    let plan = &report.plan;
    let step = plan.trajectory.sample_time;
    let timing = plan.timing(Sources::ALL);
    let into = report.setup().workpiece.inverse();
    let shifts = plan.shaper().apply(&report.compensation.correction, step);
    let turns: Vec<_> = (0..report.samples()).map(|k| turn(report, k)).collect();
    let turns = plan.shaper().apply(&turns, step);
    let row = |(k, (shift, turn)): (usize, (&Vector3<f64>, &Vector3<f64>))| {
        let x = timing.heading[k];
        // Where the tool moves along itself, there is no direction across.
        let across = match (-timing.axis(&plan.path, k)).cross(&x) {
            y if y.norm() > 1e-9 => [shift.dot(&y.normalize()), shift.dot(&x.cross(&y.normalize()))],
            _ => [0.0; 2],
        };
        CorrectionRow {
            time: k as f64 * step,
            arc_length: timing.arc_length[k],
            shift: into.direction(shift),
            turn: *turn,
            across,
        }
    };
    shifts.iter().zip(&turns).enumerate().map(row).collect()
}

/// The turn from the desired to the commanded orientation at the sample `k`: A, B, C [deg].
fn turn(report: &Report, k: usize) -> Vector3<f64> {
    let (desired, commanded) = (report.plan.trajectory.axis.at(k), report.compensation.axis.at(k));
    if desired == commanded {
        return Vector3::zeros();
    }
    let (path, s) = (&report.plan.path, report.plan.trajectory.timing.arc_length[k]);
    let [from, to] = [desired, commanded].map(|axis| path.orientation(s, axis, 0.0));
    let into = report.setup().workpiece.inverse().rotation;
    let [c, b, a] = roll_pitch_yaw(&(into * (to * from.transpose()) * into.transpose()));
    Vector3::new(a, b, c) / DEG
}
