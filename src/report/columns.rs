//! The columns of a report: one row a sample, units in the names.

use crate::column::Column;
use crate::deviation::Sources;
use crate::report::{Report, norms_mm};
use crate::robot::Joints;
use crate::units::{DEG, MM};
use nalgebra::Vector3;
use xxhash_rust::xxh3::Xxh3;

impl Report {
    /// All columns. Desired, forces and positions are in the base frame.
    pub fn columns(&self) -> Vec<Column> {
        let trajectory = &self.plan.trajectory;
        let scaled = |values: &[f64], unit: f64| values.iter().map(|v| v / unit).collect::<Vec<f64>>();
        let time = (0..trajectory.len()).map(|k| k as f64 * trajectory.sample_time).collect();
        let mut columns = vec![
            Column::new("time_s", "Time", "s", time),
            Column::new("arc_length_mm", "Arc length", "mm", scaled(&trajectory.pace.arc_length, MM)),
        ];
        columns.extend(xyz("desired", "Desired", "mm", &trajectory.position, MM));
        columns.extend(joints("q", "Joint", &self.joints.q));
        columns.extend(joints("shaped_q", "Shaped joint", &self.before.q));
        columns.extend(xyz("force", "Force", "n", &self.before.force, 1.0));
        columns.extend(xyz("deflection", "Deflection", "mm", &self.before.deflection, MM));
        columns.extend(xyz("actual", "Actual", "mm", &self.before.actual, MM));
        let norm =
            |key: &str, label: &str, errors: &[Vector3<f64>]| Column::new(key, label, "mm", norms_mm(errors));
        columns.push(norm("contour_error_mm", "Contour error before", &self.before.contour_error));
        columns.extend(xyz("compensated", "Compensated", "mm", &self.commanded(), MM));
        columns.push(norm("after_contour_error_mm", "Contour error after", &self.after.contour_error));
        columns.push(Column::new("feed_mm_s", "Feed", "mm/s", scaled(&trajectory.pace.speed, MM)));
        let force_alone = &self.deflection_only.contour_error;
        columns.push(norm("deflection_contour_error_mm", "Contour error by deflection alone", force_alone));
        let shaping_alone = &self.shaping_only.contour_error;
        columns.push(norm("shaping_contour_error_mm", "Contour error by shaping alone", shaping_alone));
        columns.extend(xyz("shaped", "Shaped", "mm", &self.shaping_only.actual, MM));
        columns.extend(xyz("after_actual", "Actual after", "mm", &self.after.actual, MM));
        columns.extend(joints("compensated_q", "Compensated joint", &self.compensation.q));
        let tracking: Vec<_> = trajectory
            .position
            .iter()
            .zip(&self.before.actual)
            .map(|(desired, actual)| desired - actual)
            .collect();
        columns.push(norm("tracking_error_mm", "Tracking error before (eq. 5.1)", &tracking));
        for (axis, name) in ["i", "j", "k"].into_iter().enumerate() {
            let values = trajectory.axis.iter().map(|v| v[axis]).collect();
            columns.push(Column::new(format!("tool_axis_{name}"), format!("Tool axis {name}"), "", values));
        }
        for (axis, name) in ["i", "j", "k"].into_iter().enumerate() {
            let values = self.compensation.axis.iter().map(|v| v[axis]).collect();
            columns.push(Column::new(
                format!("compensated_axis_{name}"),
                format!("Compensated axis {name}"),
                "",
                values,
            ));
        }
        let tilt = |key, label, errors: &[f64]| Column::new(key, label, "deg", scaled(errors, DEG));
        columns.push(tilt("axis_error_deg", "Tool axis error before", &self.before.axis_error));
        columns.push(tilt("after_axis_error_deg", "Tool axis error after", &self.after.axis_error));
        // As the force has it: a shaped tool arrives later, and between cutting and not it is partly both.
        let mut cuts = self.plan.pace(Sources::ALL).engaged;
        for share in cuts.iter_mut().filter(|share| (**share - share.round()).abs() < 1e-12) {
            *share = share.round();
        }
        columns.push(Column::new("cuts", "Cuts", "", cuts));
        let path = &self.plan.path;
        let lines =
            trajectory.pace.arc_length.iter().map(|&s| path.moves()[path.locate(s).0].line as f64).collect();
        columns.push(Column::new("program_line", "Line of the program", "", lines));
        if self.spin.is_some() {
            let angles = trajectory.pace.arc_length.iter().map(|&s| path.spin(s) / DEG).collect();
            columns.push(Column::new("spin_deg", "Spin about the tool axis", "deg", angles));
        }
        columns
    }

    /// Hash over the bits of all columns (XXH3, 128 bit): the same job gives the same one natively and in every browser.
    pub fn fingerprint(&self) -> String {
        fingerprint(&self.columns())
    }
}

/// Hash over names and bits of columns.
pub fn fingerprint(columns: &[Column]) -> String {
    let mut hash = Xxh3::new();
    let mut bytes = Vec::new();
    for column in columns {
        hash.update(column.key.as_bytes());
        bytes.clear();
        bytes.extend(column.values.iter().flat_map(|value| value.to_le_bytes()));
        hash.update(&bytes);
    }
    format!("{:032x}", hash.digest128())
}

/// Columns `key_x_unit`, `key_y_unit`, `key_z_unit`.
fn xyz(key: &str, label: &str, unit: &'static str, vectors: &[Vector3<f64>], factor: f64) -> [Column; 3] {
    let read = if unit == "n" { "N" } else { unit };
    [0, 1, 2].map(|axis| {
        let name = ["x", "y", "z"][axis];
        let values = vectors.iter().map(|v| v[axis] / factor).collect();
        Column::new(format!("{key}_{name}_{unit}"), format!("{label} {name}"), read, values)
    })
}

/// Columns `key1_deg` to `key6_deg`.
fn joints(key: &str, label: &str, q: &[Joints]) -> [Column; 6] {
    [0, 1, 2, 3, 4, 5].map(|i| {
        let values = q.iter().map(|q| q[i] / DEG).collect();
        Column::new(format!("{key}{}_deg", i + 1), format!("{label} {}", i + 1), "deg", values)
    })
}
