//! How each chart of the catalogue is drawn from a report.

use crate::chart::catalog::Entry;
use crate::chart::plot::{Axis, Band, Caption, Chart, Options, Series, line_chart};
use crate::chart::space::{SpaceSeries, View, space_chart};
use crate::math;
use crate::report::{Report, norms_mm};
use crate::robot::Joints;
use crate::units::{DEG, MM};
use nalgebra::Vector3;

const AXES: [(&str, &str); 3] = [("x", "s1"), ("y", "s2"), ("z", "s3")];

/// One chart in the making.
pub(super) struct Sheet<'a> {
    pub(super) report: &'a Report,
    pub(super) entry: &'a Entry,
    pub(super) options: &'a Options,
}

impl Sheet<'_> {
    fn caption<'b>(&'b self, description: &'b str) -> Caption<'b> {
        Caption { name: self.entry.name, title: self.entry.title, description }
    }

    fn time(&self) -> Vec<f64> {
        let trajectory = &self.report.plan.trajectory;
        (0..trajectory.len()).map(|k| k as f64 * trajectory.sample_time).collect()
    }

    /// Curves over time.
    fn over_time(
        &self,
        description: &str,
        y: Axis,
        series: &[(&str, &str, &'static str, &[f64])],
        bands: &[Band],
    ) -> Result<Chart, String> {
        let time = self.time();
        let series: Vec<_> = series
            .iter()
            .map(|&(key, label, class, y)| Series { key, label, class, x: &time, y, markers: false })
            .collect();
        let x = Axis { label: "Time", unit: "s", ..Axis::default() };
        line_chart(self.caption(description), x, y, &series, bands, self.options)
    }

    pub(super) fn errors(
        &self,
        sources: &[(&str, &str, &'static str, &[Vector3<f64>])],
    ) -> Result<Chart, String> {
        let norms: Vec<Vec<f64>> = sources.iter().map(|(_, _, _, errors)| norms_mm(errors)).collect();
        let texts: Vec<_> = sources
            .iter()
            .zip(&norms)
            .map(|((_, label, ..), norm)| {
                format!("{label}: mean {} mm, max {} mm", read_mm(mean(norm)), read_mm(max(norm)))
            })
            .collect();
        let tolerance = self.report.setup.goal.tolerance / MM;
        let series: Vec<_> = sources
            .iter()
            .zip(&norms)
            .map(|(&(key, label, class, _), norm)| (key, label, class, norm.as_slice()))
            .collect();
        let y = Axis { label: "Contour error", unit: "mm", zero: true, ..Axis::default() };
        let bands = [Band { from: 0.0, to: tolerance, label: "tolerance" }];
        self.over_time(&format!("{}; the tolerance is {tolerance} mm.", texts.join("; ")), y, &series, &bands)
    }

    pub(super) fn before_and_after(
        &self,
        before: &[Vector3<f64>],
        after: &[Vector3<f64>],
    ) -> Result<Chart, String> {
        self.errors(&[("before", "Before", "before", before), ("after", "After", "after", after)])
    }

    pub(super) fn vectors(
        &self,
        label: &str,
        unit: &'static str,
        vectors: &[Vector3<f64>],
        factor: f64,
    ) -> Result<Chart, String> {
        let columns = [0, 1, 2].map(|axis| vectors.iter().map(|v| v[axis] / factor).collect::<Vec<f64>>());
        let texts: Vec<_> = AXES
            .iter()
            .zip(&columns)
            .map(|((axis, _), values)| {
                format!("{axis} from {} to {} {unit}", digits(min(values)), digits(max(values)))
            })
            .collect();
        let series: Vec<_> = AXES
            .iter()
            .zip(&columns)
            .map(|(&(axis, class), values)| (axis, axis, class, values.as_slice()))
            .collect();
        let description = format!("{label} in the base frame: {}.", texts.join(", "));
        self.over_time(&description, Axis { label, unit, ..Axis::default() }, &series, &[])
    }

    pub(super) fn convergence(&self) -> Result<Chart, String> {
        let history = &self.report.compensation;
        let mm = |values: &[f64]| values.iter().map(|v| v / MM).collect::<Vec<f64>>();
        let (max, mean) = (mm(&history.history_max), mm(&history.history_mean));
        let passes: Vec<f64> = (0..max.len()).map(|pass| pass as f64).collect();
        let tolerance = self.report.setup.goal.tolerance / MM;
        let limit = [tolerance, tolerance];
        let ends = [0.0, passes.len().saturating_sub(1).max(1) as f64];
        let series = [
            Series { key: "max", label: "Largest", class: "before", x: &passes, y: &max, markers: true },
            Series { key: "mean", label: "Mean", class: "after", x: &passes, y: &mean, markers: true },
            Series {
                key: "tolerance",
                label: "Tolerance",
                class: "mean",
                x: &ends,
                y: &limit,
                markers: false,
            },
        ];
        let texts: Vec<_> = max.iter().map(|value| digits(*value)).collect();
        let description = format!(
            "Largest contour error before and after each pass: {} mm; the tolerance is {tolerance} mm.",
            texts.join(", ")
        );
        let x = Axis { label: "Pass", whole: true, ..Axis::default() };
        let y = Axis { label: "Contour error", unit: "mm", log: true, ..Axis::default() };
        line_chart(self.caption(&description), x, y, &series, &[], self.options)
    }

    fn space(
        &self,
        description: &str,
        paths: &[(&str, &str, &'static str, Vec<[f64; 3]>)],
    ) -> Result<Chart, String> {
        let paths: Vec<_> = paths
            .iter()
            .map(|(key, label, class, points)| SpaceSeries { key, label, class, points })
            .collect();
        space_chart(self.caption(description), &paths, View::default(), self.options)
    }

    pub(super) fn path(&self) -> Result<Chart, String> {
        let desired = millimetres(&self.report.plan.trajectory.position);
        let length = self.report.plan.path.length() / MM;
        let description = format!("The desired path in the base frame, {length:.1} mm long.");
        self.space(&description, &[("desired", "Desired", "desired", desired)])
    }

    /// A bent path beside the desired one: each point is moved away from the closest desired point by a stated factor.
    pub(super) fn bent(
        &self,
        actual: &[Vector3<f64>],
        errors: &[Vector3<f64>],
        label: &str,
        class: &'static str,
    ) -> Result<Chart, String> {
        let factor = self.magnification(max(&norms_mm(errors)));
        let bent: Vec<_> =
            actual.iter().zip(errors).map(|(tip, error)| tip + error - error * factor).collect();
        let description = format!(
            "Deviation drawn {factor} times as large as it is; the largest is {} mm.",
            digits(max(&norms_mm(errors)))
        );
        let desired = millimetres(&self.report.plan.trajectory.position);
        let bent_label = format!("{label} (deviation x {factor})");
        self.space(
            &description,
            &[("desired", "Desired", "desired", desired), ("bent", &bent_label, class, millimetres(&bent))],
        )
    }

    pub(super) fn compensated(&self) -> Result<Chart, String> {
        let correction = &self.report.compensation.correction;
        let largest = max(&norms_mm(correction));
        let factor = self.magnification(largest);
        let position = &self.report.plan.trajectory.position;
        let commanded: Vec<_> = position.iter().zip(correction).map(|(p, c)| p + c * factor).collect();
        let description = format!(
            "Correction drawn {factor} times as large as it is; the largest is {} mm.",
            digits(largest)
        );
        let label = format!("To command (correction x {factor})");
        self.space(
            &description,
            &[
                ("desired", "Desired", "desired", millimetres(position)),
                ("compensated", &label, "after", millimetres(&commanded)),
            ],
        )
    }

    /// 1, 2 or 5 times a power of ten, so that the largest deviation [mm] shows as about a tenth of the path's size.
    fn magnification(&self, largest: f64) -> f64 {
        let position = &self.report.plan.trajectory.position;
        let size = [0, 1, 2]
            .map(|axis| {
                let values: Vec<f64> = position.iter().map(|p| p[axis] / MM).collect();
                max(&values) - min(&values)
            })
            .into_iter()
            .fold(0.0, f64::max);
        if largest < 1e-9 {
            return 1.0;
        }
        let wanted = (0.1 * size / largest).max(1.0);
        let decade = math::pow(10.0, math::log10(wanted).floor());
        let step = [5.0, 2.0, 1.0].into_iter().find(|step| step * decade <= wanted).unwrap_or(1.0);
        (step * decade).round()
    }

    pub(super) fn revolution(&self) -> Result<Chart, String> {
        let setup = &self.report.setup;
        let chip = setup.chip.at(setup.tempo.feed, None);
        let (angles, forces) = setup.cut.revolution(720, chip);
        let degrees: Vec<f64> = angles.iter().map(|angle| angle / DEG).collect();
        let columns = [0, 1, 2].map(|axis| forces.iter().map(|f| f[axis]).collect::<Vec<f64>>());
        let resultant: Vec<f64> = forces.iter().map(|f| f.norm()).collect();
        let mean = self.report.mean_force();
        let ends = [0.0, 360.0];
        let means = [0, 1, 2].map(|axis| [mean[axis], mean[axis]]);
        let mut series: Vec<_> = AXES
            .iter()
            .zip(&columns)
            .map(|(&(axis, class), y)| Series {
                key: axis,
                label: axis,
                class,
                x: &degrees,
                y,
                markers: false,
            })
            .collect();
        series.push(Series {
            key: "resultant",
            label: "resultant",
            class: "s4",
            x: &degrees,
            y: &resultant,
            markers: false,
        });
        for ((key, label), y) in
            [("mean-x", "mean x"), ("mean-y", "mean y"), ("mean-z", "mean z")].into_iter().zip(&means)
        {
            series.push(Series { key, label, class: "mean", x: &ends, y, markers: false });
        }
        let description = format!(
            "In the cutting frame (x along the feed, z along the tool axis), on the tool: mean ({:.1}, {:.1}, {:.1}) N, largest resultant {:.1} N.",
            mean.x,
            mean.y,
            mean.z,
            max(&resultant)
        );
        let x = Axis { label: "Rotation", unit: "deg", range: Some((0.0, 360.0)), ..Axis::default() };
        let y = Axis { label: "Force", unit: "N", zero: true, ..Axis::default() };
        line_chart(self.caption(&description), x, y, &series, &[], self.options)
    }

    pub(super) fn joints(&self) -> Result<Chart, String> {
        let columns = [0, 1, 2, 3, 4, 5].map(|i| degrees(&self.report.joints.q, i));
        let names = ["q1", "q2", "q3", "q4", "q5", "q6"];
        let classes = ["s1", "s2", "s3", "s4", "s5", "s6"];
        let series: Vec<_> =
            (0..6).map(|i| (names[i], names[i], classes[i], columns[i].as_slice())).collect();
        let texts: Vec<_> = names
            .iter()
            .zip(&columns)
            .map(|(name, q)| format!("{name} {:.1} to {:.1}", min(q), max(q)))
            .collect();
        let y = Axis { label: "Joint angle", unit: "deg", ..Axis::default() };
        self.over_time(&format!("Ranges in deg: {}.", texts.join(", ")), y, &series, &[])
    }

    pub(super) fn shaped_joint(&self, joint: usize) -> Result<Chart, String> {
        let original = degrees(&self.report.joints.q, joint);
        let shaped = degrees(&self.report.before.q, joint);
        let apart: Vec<f64> = original.iter().zip(&shaped).map(|(a, b)| (a - b).abs()).collect();
        let description =
            format!("Original and shaped command differ by up to {:.3} deg at the same time.", max(&apart));
        let y = Axis { label: "Joint angle", unit: "deg", ..Axis::default() };
        let series = [
            ("original", "Original", "desired", original.as_slice()),
            ("shaped", "Shaped", "shaping", shaped.as_slice()),
        ];
        self.over_time(&description, y, &series, &[])
    }

    /// A unit step at time 0 and what the shaper makes of it (Fig. 4.10).
    pub(super) fn step(&self) -> Result<Chart, String> {
        let impulses = self.report.setup.shaper.impulses();
        let duration = self.report.setup.shaper.duration();
        let margin = if duration > 0.0 { 0.25 * duration } else { 0.1 };
        let (mut time, mut shaped) = (vec![-margin], vec![0.0]);
        let mut level = 0.0;
        for impulse in impulses {
            time.extend([impulse.time, impulse.time]);
            shaped.extend([level, level + impulse.amplitude]);
            level += impulse.amplitude;
        }
        time.push(duration + margin);
        shaped.push(level);
        let (step_time, step) = ([-margin, 0.0, 0.0, duration + margin], [0.0, 0.0, 1.0, 1.0]);
        let texts: Vec<_> =
            impulses.iter().map(|i| format!("{:.4} at {:.4} s", i.amplitude, i.time)).collect();
        let description = format!("Impulses: {}.", texts.join(", "));
        let series = [
            Series {
                key: "original",
                label: "Original",
                class: "desired",
                x: &step_time,
                y: &step,
                markers: false,
            },
            Series { key: "shaped", label: "Shaped", class: "shaping", x: &time, y: &shaped, markers: false },
        ];
        let x = Axis { label: "Time", unit: "s", ..Axis::default() };
        let y = Axis { label: "Command", zero: true, ..Axis::default() };
        line_chart(self.caption(&description), x, y, &series, &[], self.options)
    }

    /// Residual vibration over the true frequency, as a share of the design frequency.
    pub(super) fn robustness(&self) -> Result<Chart, String> {
        let shaper = &self.report.setup.shaper;
        let Some((frequency, damping)) = self.report.setup.mode else {
            let caption = self.caption("No shaper: all of the vibration is left.");
            let series = [Series {
                key: "left",
                label: "Left",
                class: "shaping",
                x: &[0.5, 1.5],
                y: &[100.0, 100.0],
                markers: false,
            }];
            let x = Axis { label: "True frequency / design frequency", ..Axis::default() };
            let y = Axis { label: "Residual vibration", unit: "%", zero: true, ..Axis::default() };
            return line_chart(caption, x, y, &series, &[], self.options);
        };
        let ratios: Vec<f64> = (0..=400).map(|i| 0.5 + f64::from(i) / 400.0).collect();
        let left: Vec<f64> =
            ratios.iter().map(|r| 100.0 * shaper.residual_vibration(r * frequency, damping)).collect();
        let within = ratios
            .iter()
            .zip(&left)
            .filter(|(_, left)| **left <= 5.0)
            .map(|(ratio, _)| *ratio)
            .collect::<Vec<_>>();
        let description = if within.is_empty() {
            "Nowhere below 5 % of the vibration of an unshaped command.".to_owned()
        } else {
            format!(
                "At most 5 % of the vibration is left from {:.2} to {:.2} times the design frequency.",
                min(&within),
                max(&within)
            )
        };
        let series = [Series {
            key: "left",
            label: "Vibration left",
            class: "shaping",
            x: &ratios,
            y: &left,
            markers: false,
        }];
        let bands = [Band { from: 0.0, to: 5.0, label: "5 %" }];
        let x = Axis { label: "True frequency / design frequency", ..Axis::default() };
        let y = Axis { label: "Residual vibration", unit: "%", zero: true, ..Axis::default() };
        line_chart(self.caption(&description), x, y, &series, &bands, self.options)
    }
}

fn millimetres(points: &[Vector3<f64>]) -> Vec<[f64; 3]> {
    points.iter().map(|p| (p / MM).into()).collect()
}

fn degrees(q: &[Joints], joint: usize) -> Vec<f64> {
    q.iter().map(|q| q[joint] / DEG).collect()
}

fn max(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

fn min(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// A length [mm] as read in a sentence.
fn read_mm(mm: f64) -> String {
    crate::report::millimetres(mm * MM)
}

/// A number as read in a sentence.
fn digits(value: f64) -> String {
    match value.abs() {
        large if large >= 100.0 => format!("{value:.0}"),
        middle if middle >= 1.0 => format!("{value:.2}"),
        _ => format!("{value:.4}"),
    }
}
