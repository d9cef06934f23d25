//! The columns of a report: one row per sample, with the unit in each key.

use crate::column::Column;
use crate::cutting::run_in::RunIn;
use crate::path::Axes;
use crate::report::{Report, norms_mm};
use crate::units::{DEG, MM};
use nalgebra::Vector3;
use std::ops::Range;
use xxhash_rust::xxh3::Xxh3;

/// A column of a report whose values are computed on demand: for a long run, all columns at once
/// would take half a gigabyte.
pub struct Series<'a> {
    /// See [`Column::key`].
    pub key: String,
    /// See [`Column::label`].
    pub label: String,
    /// See [`Column::unit`].
    pub unit: &'static str,
    values: Box<dyn Fn(Range<usize>) -> Vec<f64> + 'a>,
    samples: usize,
}

impl<'a> Series<'a> {
    pub(super) fn new(
        key: impl Into<String>,
        label: impl Into<String>,
        unit: &'static str,
        samples: usize,
        values: impl Fn(Range<usize>) -> Vec<f64> + 'a,
    ) -> Self {
        Self { key: key.into(), label: label.into(), unit, values: Box::new(values), samples }
    }

    /// The column.
    pub fn column(&self) -> Column {
        Column::new(self.key.as_str(), self.label.as_str(), self.unit, self.values(0..self.samples))
    }

    /// Its values over a range of samples.
    pub fn values(&self, samples: Range<usize>) -> Vec<f64> {
        (self.values)(samples.start.min(self.samples)..samples.end.min(self.samples))
    }
}

/// Number of samples hashed at a time.
const HASHED: usize = 512;

impl Report {
    /// All columns at once; [`Report::series`] computes one at a time.
    pub fn columns(&self) -> Vec<Column> {
        self.series().iter().map(Series::column).collect()
    }

    /// All columns, in order. Positions and forces are in the base frame.
    pub fn series(&self) -> Vec<Series<'_>> {
        let trajectory = &self.plan.trajectory;
        let count = trajectory.len();
        let time = |samples: Range<usize>| samples.map(|k| k as f64 * trajectory.sample_time).collect();
        let mut series = vec![
            Series::new("time_s", "Time", "s", count, time),
            scaled("arc_length_mm", "Arc length", "mm", &trajectory.timing.arc_length, MM),
        ];
        series.extend(xyz("desired", "Desired", "mm", &trajectory.position, MM));
        series.extend(joints("q", "Joint", count, |k, i| self.q[k][i]));
        let shaped = self.shaped(&self.q);
        series.extend(joints("shaped_q", "Shaped joint", count, move |k, i| shaped.part_at(k, |q| q[i])));
        series.extend(xyz("force", "Force", "n", &self.force, 1.0));
        series.extend(xyz("deflection", "Deflection", "mm", &self.deflection, MM));
        series.extend(xyz("actual", "Actual", "mm", &self.before.actual, MM));
        series.push(norm("contour_error_mm", "Contour error before", &self.before.contour_error));
        let (desired, correction) = (&trajectory.position, &self.compensation.correction);
        series.extend(xyz_of("compensated", "Compensated", "mm", count, move |axis, samples| {
            samples.map(|k| (desired[k][axis] + correction[k][axis]) / MM).collect()
        }));
        series.push(norm("after_contour_error_mm", "Contour error after", &self.after.contour_error));
        series.push(scaled("feed_mm_s", "Feed", "mm/s", &trajectory.timing.speed, MM));
        let force_alone = &self.deflection_only.contour_error;
        series.push(norm("deflection_contour_error_mm", "Contour error by deflection alone", force_alone));
        let shaping_alone = &self.shaping_only.contour_error;
        series.push(norm("shaping_contour_error_mm", "Contour error by shaping alone", shaping_alone));
        series.extend(xyz("shaped", "Shaped", "mm", &self.shaping_only.actual, MM));
        series.extend(xyz("after_actual", "Actual after", "mm", &self.after.actual, MM));
        series.extend(joints("compensated_q", "Compensated joint", count, |k, i| self.compensation.q[k][i]));
        series.push(self.tracking_error());
        series.extend(ijk("tool_axis", "Tool axis", count, &trajectory.axis));
        series.extend(ijk("compensated_axis", "Compensated axis", count, &self.compensation.axis));
        let (before, after) = (&self.before.axis_error, &self.after.axis_error);
        series.push(scaled("axis_error_deg", "Tool axis error before", "deg", before, DEG));
        series.push(scaled("after_axis_error_deg", "Tool axis error after", "deg", after, DEG));
        series.push(self.cuts());
        series.push(self.run_in_series());
        let (path, timing) = (&self.plan.path, &trajectory.timing);
        series.push(Series::new("program_line", "Line of the program", "", count, move |samples| {
            timing.index[samples].iter().map(|&index| path.moves()[index as usize].line as f64).collect()
        }));
        let band = &self.band;
        series.push(Series::new("after_p95_mm", "Contour error after, 95 %", "mm", count, move |samples| {
            samples.map(|k| band.p95_at(k) / MM).collect()
        }));
        if self.roll.is_some() {
            series.push(Series::new("spin_deg", "Spin about the tool axis", "deg", count, move |samples| {
                timing.arc_length[samples].iter().map(|&s| path.roll(s) / DEG).collect()
            }));
        }
        series.extend(self.in_stock());
        series
    }

    fn tracking_error(&self) -> Series<'_> {
        let (desired, actual) = (&self.plan.trajectory.position, &self.before.actual);
        Series::new("tracking_error_mm", "Tracking error before (eq. 5.1)", "mm", desired.len(), |samples| {
            samples.map(|k| (desired[k] - actual[k]).norm() / MM).collect()
        })
    }

    /// Whether the tool cuts, shaped like the force: a shaped tool arrives later, and while cutting
    /// starts or ends the value lies between 0 and 1.
    fn cuts(&self) -> Series<'_> {
        let trajectory = &self.plan.trajectory;
        let cuts = self.plan.shaper().shaped(&trajectory.timing.engaged, trajectory.sample_time);
        Series::new("cuts", "Cuts", "", trajectory.len(), move |samples| {
            let whole =
                |share: f64| if (share - share.round()).abs() < 1e-12 { share.round() } else { share };
            samples.map(|k| whole(cuts.at(k))).collect()
        })
    }

    /// Share of the force by the run-in at each sample; see [`RunIn`].
    pub(super) fn run_in(&self) -> Vec<f64> {
        self.run_in_series().values(0..self.samples())
    }

    fn run_in_series(&self) -> Series<'_> {
        let (path, trajectory) = (&self.plan.path, &self.plan.trajectory);
        let run_in = RunIn::along(path, self.setup().loading.run_in);
        let place = self.plan.shaper().shaped(&trajectory.timing.arc_length, trajectory.sample_time);
        Series::new("run_in", "Run-in of the cut", "", trajectory.len(), move |samples| {
            let mut near = 0;
            let share = |k: usize| {
                let s = place.at(k);
                (near, _) = path.locate_near(s, near);
                run_in.at(near, s)
            };
            samples.map(share).collect()
        })
    }

    /// Hash over the keys and bits of all columns (XXH3, 128 bit). The same job gives the same hash
    /// natively and in every browser.
    pub fn fingerprint(&self) -> String {
        self.fingerprint.get_or_init(|| self.hash()).clone()
    }

    /// The fingerprint, computed at every call.
    pub fn hash(&self) -> String {
        let mut hash = Xxh3::new();
        let mut bytes = [0; 8 * HASHED];
        for series in self.series() {
            hash.update(series.key.as_bytes());
            // Blocks small enough for the processor's cache.
            for from in (0..self.samples()).step_by(HASHED) {
                let values = series.values(from..from + HASHED);
                for (place, value) in bytes.chunks_exact_mut(8).zip(&values) {
                    place.copy_from_slice(&value.to_le_bytes());
                }
                hash.update(&bytes[..8 * values.len()]);
            }
        }
        format!("{:032x}", hash.digest128())
    }
}

/// A column of numbers converted to another unit.
fn scaled<'a>(key: &str, label: &str, unit: &'static str, values: &'a [f64], factor: f64) -> Series<'a> {
    Series::new(key, label, unit, values.len(), move |samples| {
        values[samples].iter().map(|v| v / factor).collect()
    })
}

/// A column of vector lengths [mm].
fn norm<'a>(key: &str, label: &str, errors: &'a [Vector3<f64>]) -> Series<'a> {
    Series::new(key, label, "mm", errors.len(), |samples| norms_mm(&errors[samples]))
}

/// Columns `key_x_unit`, `key_y_unit`, `key_z_unit`.
fn xyz<'a>(
    key: &str,
    label: &str,
    unit: &'static str,
    vectors: &'a [Vector3<f64>],
    factor: f64,
) -> [Series<'a>; 3] {
    xyz_of(key, label, unit, vectors.len(), move |axis, samples| {
        vectors[samples].iter().map(|v| v[axis] / factor).collect()
    })
}

/// As [`xyz`], from a function of axis and samples.
fn xyz_of<'a>(
    key: &str,
    label: &str,
    unit: &'static str,
    samples: usize,
    values: impl Fn(usize, Range<usize>) -> Vec<f64> + Copy + 'a,
) -> [Series<'a>; 3] {
    let read = if unit == "n" { "N" } else { unit };
    [0, 1, 2].map(|axis| {
        let name = ["x", "y", "z"][axis];
        let (key, label) = (format!("{key}_{name}_{unit}"), format!("{label} {name}"));
        Series::new(key, label, read, samples, move |samples| values(axis, samples))
    })
}

/// Columns `key_i`, `key_j`, `key_k`.
fn ijk<'a>(key: &str, label: &str, count: usize, axes: &'a Axes) -> [Series<'a>; 3] {
    [0, 1, 2].map(|axis| {
        let name = ["i", "j", "k"][axis];
        let values = move |samples: Range<usize>| samples.map(|k| axes.at(k)[axis]).collect();
        Series::new(format!("{key}_{name}"), format!("{label} {name}"), "", count, values)
    })
}

/// Columns `key1_deg` to `key6_deg`.
fn joints<'a>(
    key: &str,
    label: &str,
    count: usize,
    q: impl Fn(usize, usize) -> f64 + Clone + 'a,
) -> [Series<'a>; 6] {
    [0, 1, 2, 3, 4, 5].map(|i| {
        let q = q.clone();
        let values = move |samples: Range<usize>| samples.map(|k| q(k, i) / DEG).collect();
        Series::new(format!("{key}{}_deg", i + 1), format!("{label} {}", i + 1), "deg", count, values)
    })
}
