//! The content of each chart in the catalogue.

use crate::chart::chart::{Axis, Band};
use crate::chart::content::{BOUND, Content, Curve, Shape, SpacePath, TIME, points};
use crate::chart::over::Over;
use crate::chart::unit::Units;
use crate::math;
use crate::path::unit::LengthUnit;
use crate::report::{Report, length_text};
use crate::robot::Joints;
use crate::units::{DEG, MM};
use nalgebra::Vector3;

const AXES: [(&str, &str); 3] = [("x", "s1"), ("y", "s2"), ("z", "s3")];

/// Key, label and class of a curve.
type Name = (&'static str, &'static str, &'static str);

const BEFORE: Name = ("before", "Before", "before");
const AFTER: Name = ("after", "After", "after");
const P95: Name = ("after-p95", "95 %", BOUND);
pub(super) const DEFLECTION: Name = ("deflection", "Forces alone", "deflection");
pub(super) const SHAPING: Name = ("shaping", "Shaping alone", "shaping");
pub(super) const BOTH: Name = ("both", "Both together", "both");

/// The figures of a report, in the displayed units.
pub(super) struct Figures<'a> {
    pub(super) report: &'a Report,
    pub(super) units: Units,
    pub(super) over: Over,
}

impl Figures<'_> {
    /// A length [m] as text in a sentence, without its unit: no finer than a tenth of a micrometre,
    /// beyond any machine's resolution.
    pub(super) fn read(&self, length: f64) -> String {
        match self.units.length {
            LengthUnit::Mm => length_text(length, MM, 4),
            LengthUnit::Inch => length_text(length, LengthUnit::Inch.in_m(), 6),
        }
    }

    /// The least length that is read, in the displayed unit; see [`Figures::read`].
    fn least(&self) -> f64 {
        match self.units.length {
            LengthUnit::Mm => 1e-4,
            LengthUnit::Inch => 1e-6,
        }
    }

    /// Curves with a value for each sample.
    fn over_run_with(
        &self,
        description: String,
        y: Axis<'static>,
        curves: Vec<Curve>,
        bands: Vec<Band>,
    ) -> Content {
        let x = self.over.axis(self.units);
        let shape = Shape::Curves { x, y, curves, markers: false, bands };
        Content { description, at: self.over.values(self.report, self.units), shape }
    }

    pub(super) fn over_run(&self, description: String, y: Axis<'static>, curves: Vec<Curve>) -> Content {
        self.over_run_with(description, y, curves, vec![])
    }

    pub(super) fn tolerance(&self) -> (f64, Vec<Band>) {
        let tolerance = self.report.setup().goal.tolerance;
        (tolerance, vec![Band { from: 0.0, to: tolerance / self.units.length.in_m(), label: "tolerance" }])
    }

    pub(super) fn errors(&self, sources: &[(Name, &[Vector3<f64>])]) -> Content {
        let norms = |errors: &[Vector3<f64>]| errors.iter().map(Vector3::norm).collect();
        self.error_lengths(sources.iter().map(|&(name, errors)| (name, norms(errors))).collect())
    }

    /// Lengths of contour errors [m].
    fn error_lengths(&self, sources: Vec<(Name, Vec<f64>)>) -> Content {
        let (size, unit) = (self.units.length.in_m(), self.units.length.name());
        let mut texts = Vec::new();
        let mut curves = Vec::new();
        for ((key, label, class), lengths) in sources {
            let values: Vec<f64> = lengths.iter().map(|length| length / size).collect();
            let (mean, max) = (self.read(mean(&values) * size), self.read(max(&values) * size));
            texts.push(format!("{label}: mean {mean} {unit}, max {max} {unit}"));
            curves.push(Curve { key, label, class, values });
        }
        let (tolerance, bands) = self.tolerance();
        let description = format!("{}; the tolerance is {} {unit}.", texts.join("; "), self.read(tolerance));
        let y =
            Axis { label: "Contour error", unit, zero: true, floor: Some(self.least()), ..Axis::default() };
        self.over_run_with(description, y, curves, bands)
    }

    pub(super) fn before_and_after(&self, before: &[Vector3<f64>], after: &[Vector3<f64>]) -> Content {
        self.errors(&[(BEFORE, before), (AFTER, after)])
    }

    /// Before and after compensation with every source acting, and what 95 of 100 drawn plants stay
    /// below.
    pub(super) fn expected(&self) -> Content {
        let Report { before, after, band, .. } = self.report;
        let norms = |errors: &[Vector3<f64>]| errors.iter().map(Vector3::norm).collect();
        let p95 = (0..self.report.samples()).map(|sample| band.p95_at(sample)).collect();
        self.error_lengths(vec![
            (BEFORE, norms(&before.contour_error)),
            (AFTER, norms(&after.contour_error)),
            (P95, p95),
        ])
    }

    /// The angle between the actual and the desired tool axis.
    pub(super) fn axis_errors(&self) -> Content {
        let (before, after) = (&self.report.before.axis_error, &self.report.after.axis_error);
        let curves = [(BEFORE, before), (AFTER, after)].map(|((key, label, class), angles)| Curve {
            key,
            label,
            class,
            values: angles.iter().map(|angle| angle / DEG).collect(),
        });
        let texts = curves.each_ref().map(|Curve { label, values, .. }| {
            format!("{label}: mean {} deg, max {} deg", digits(mean(values)), digits(max(values)))
        });
        let y = Axis { label: "Angle", unit: "deg", zero: true, floor: Some(1e-4), ..Axis::default() };
        self.over_run(format!("{}.", texts.join("; ")), y, curves.into())
    }

    pub(super) fn forces(&self) -> Content {
        let force = self.units.force;
        self.vectors("Force", force.name(), &self.report.force, force.in_n())
    }

    pub(super) fn lengths(&self, label: &'static str, vectors: &[Vector3<f64>]) -> Content {
        let length = self.units.length;
        self.vectors(label, length.name(), vectors, length.in_m())
    }

    fn vectors(
        &self,
        label: &'static str,
        unit: &'static str,
        vectors: &[Vector3<f64>],
        size: f64,
    ) -> Content {
        let curves = [0, 1, 2].map(|axis| {
            let (name, class) = AXES[axis];
            Curve { key: name, label: name, class, values: vectors.iter().map(|v| v[axis] / size).collect() }
        });
        let texts = curves.each_ref().map(|Curve { label, values, .. }| {
            format!("{label} from {} to {} {unit}", digits(min(values)), digits(max(values)))
        });
        let description = format!("{label} in the base frame: {}.", texts.join(", "));
        self.over_run(description, Axis { label, unit, ..Axis::default() }, curves.into())
    }

    pub(super) fn convergence(&self) -> Content {
        let history = &self.report.compensation;
        let (size, unit) = (self.units.length.in_m(), self.units.length.name());
        let curve = |key, label, class, lengths: &[f64]| Curve {
            key,
            label,
            class,
            values: lengths.iter().map(|v| v / size).collect(),
        };
        let curves = vec![
            curve("max", "Largest", "before", &history.history_max),
            curve("mean", "Mean", "after", &history.history_mean),
        ];
        let texts: Vec<_> = history.history_max.iter().map(|&max| self.read(max)).collect();
        let (tolerance, bands) = self.tolerance();
        let description = format!(
            "Largest contour error before and after each pass: {} {unit}; the tolerance is {} {unit}.",
            texts.join(", "),
            self.read(tolerance)
        );
        let at: Vec<f64> = (0..texts.len()).map(|pass| pass as f64).collect();
        let last = at.last().map_or(1.0, |pass| pass.max(1.0));
        let x = Axis { label: "Pass", whole: true, range: Some((0.0, last)), ..Axis::default() };
        let y =
            Axis { label: "Contour error", unit, log: true, floor: Some(self.least()), ..Axis::default() };
        Content { description, at, shape: Shape::Curves { x, y, curves, markers: true, bands } }
    }

    fn space(&self, description: String, paths: Vec<(Name, String, &[Vector3<f64>])>) -> Content {
        let unit = self.units.length;
        let path = |((key, name, class), note, positions): (Name, String, &[Vector3<f64>])| {
            let points = points(positions, unit.in_m());
            SpacePath { key, label: format!("{name}{note}"), class, points }
        };
        let paths = paths.into_iter().map(path).collect();
        let at = Over::Time.values(self.report, self.units);
        Content { description, at, shape: Shape::Paths { unit, paths } }
    }

    fn desired(&self) -> (Name, String, &[Vector3<f64>]) {
        (("desired", "Desired", "desired"), String::new(), &self.report.plan.trajectory.position)
    }

    pub(super) fn path(&self) -> Content {
        let (length, unit) =
            (self.report.plan.path.length() / self.units.length.in_m(), self.units.length.name());
        self.space(
            format!("The desired path in the base frame, {length:.1} {unit} long."),
            vec![self.desired()],
        )
    }

    /// A bent path beside the desired one: each point is moved away from the closest desired point
    /// by a stated factor.
    pub(super) fn bent(
        &self,
        actual: &[Vector3<f64>],
        errors: &[Vector3<f64>],
        label: &'static str,
        class: &'static str,
    ) -> Content {
        let largest = largest(errors);
        let factor = self.magnification(largest);
        let bent: Vec<_> =
            actual.iter().zip(errors).map(|(tip, error)| tip + error - error * factor).collect();
        let description = format!(
            "Deviation magnified {factor} times; the largest is {} {}.",
            self.read(largest),
            self.units.length.name()
        );
        let note = format!(" (deviation x {factor})");
        self.space(description, vec![self.desired(), (("bent", label, class), note, &bent)])
    }

    pub(super) fn compensated(&self) -> Content {
        let correction = &self.report.compensation.correction;
        let largest = largest(correction);
        let factor = self.magnification(largest);
        let position = &self.report.plan.trajectory.position;
        let commanded: Vec<_> = position.iter().zip(correction).map(|(p, c)| p + c * factor).collect();
        let description = format!(
            "Correction magnified {factor} times; the largest is {} {}.",
            self.read(largest),
            self.units.length.name()
        );
        let name = ("compensated", "To command", "after");
        let note = format!(" (correction x {factor})");
        self.space(description, vec![self.desired(), (name, note, &commanded)])
    }

    /// 1, 2 or 5 times a power of ten, so that the largest deviation [m] appears as about a tenth
    /// of the path's size.
    fn magnification(&self, largest: f64) -> f64 {
        let position = &self.report.plan.trajectory.position;
        let size = [0, 1, 2]
            .map(|axis| {
                let values: Vec<f64> = position.iter().map(|p| p[axis]).collect();
                max(&values) - min(&values)
            })
            .into_iter()
            .fold(0.0, f64::max);
        if largest < 1e-12 {
            return 1.0;
        }
        let wanted = (0.1 * size / largest).max(1.0);
        let decade = math::pow(10.0, math::log10(wanted).floor());
        let step = [5.0, 2.0, 1.0].into_iter().find(|step| step * decade <= wanted).unwrap_or(1.0);
        (step * decade).round()
    }

    pub(super) fn revolution(&self) -> Content {
        let (size, unit) = (self.units.force.in_n(), self.units.force.name());
        let (angles, forces) = self.report.revolution(720);
        let mut curves: Vec<_> = AXES
            .iter()
            .enumerate()
            .map(|(axis, &(name, class))| Curve {
                key: name,
                label: name,
                class,
                values: forces.iter().map(|f| f[axis] / size).collect(),
            })
            .collect();
        let resultant: Vec<f64> = forces.iter().map(|f| f.norm() / size).collect();
        let mean = self.report.mean_force() / size;
        let description = format!(
            "{}n the cutting frame (x along the feed, z along the tool axis), on the tool: mean \
             ({:.1}, {:.1}, {:.1}) {unit}, largest resultant {:.1} {unit}.",
            if self.report.setup().contacts.is_some() { "Where the force is largest, i" } else { "I" },
            mean.x,
            mean.y,
            mean.z,
            self.report.peak_force() / size
        );
        curves.push(Curve { key: "resultant", label: "resultant", class: "s4", values: resultant });
        for (key, label, value) in
            [("mean-x", "mean x", mean.x), ("mean-y", "mean y", mean.y), ("mean-z", "mean z", mean.z)]
        {
            curves.push(Curve { key, label, class: "mean", values: vec![value; forces.len()] });
        }
        let at = angles.iter().map(|angle| angle / DEG).collect();
        let x = Axis { label: "Rotation", unit: "deg", range: Some((0.0, 360.0)), ..Axis::default() };
        let y = Axis { label: "Force", unit, zero: true, ..Axis::default() };
        Content { description, at, shape: Shape::Curves { x, y, curves, markers: false, bands: vec![] } }
    }

    pub(super) fn joints(&self) -> Content {
        let names = [("q1", "s1"), ("q2", "s2"), ("q3", "s3"), ("q4", "s4"), ("q5", "s5"), ("q6", "s6")];
        let curves: Vec<_> = names
            .iter()
            .enumerate()
            .map(|(i, &(name, class))| Curve {
                key: name,
                label: name,
                class,
                values: degrees(&self.report.q, i),
            })
            .collect();
        let texts: Vec<_> = curves
            .iter()
            .map(|Curve { key, values, .. }| format!("{key} {:.1} to {:.1}", min(values), max(values)))
            .collect();
        let y = Axis { label: "Joint angle", unit: "deg", ..Axis::default() };
        self.over_run(format!("Ranges in deg: {}.", texts.join(", ")), y, curves)
    }

    /// The spin over time, and the fixed angle that a free one is compared with.
    pub(super) fn spin(&self) -> Content {
        let plan = &self.report.plan;
        let values: Vec<f64> =
            plan.trajectory.timing.arc_length.iter().map(|&s| plan.path.roll(s) / DEG).collect();
        let mut description = format!("From {:.1} to {:.1} deg", min(&values), max(&values));
        let count = values.len();
        let mut curves = vec![Curve { key: "spin", label: "Chosen", class: "s1", values }];
        if let Some(gain) = &self.report.roll {
            description += &format!(", compared with a constant {:.1} deg", gain.fixed_deg);
            let values = vec![gain.fixed_deg; count];
            curves.push(Curve { key: "fixed", label: "Fixed", class: "desired", values });
        }
        let y = Axis { label: "Angle", unit: "deg", ..Axis::default() };
        self.over_run(format!("{description}."), y, curves)
    }

    pub(super) fn shaped_joint(&self, joint: usize) -> Content {
        let original = degrees(&self.report.q, joint);
        let shaped = self.report.shaped(&self.report.q);
        let shaped: Vec<f64> = (0..original.len()).map(|k| shaped.part_at(k, |q| q[joint]) / DEG).collect();
        let apart: Vec<f64> = original.iter().zip(&shaped).map(|(a, b)| (a - b).abs()).collect();
        let description =
            format!("Original and shaped command differ by up to {:.3} deg at the same time.", max(&apart));
        let y = Axis { label: "Joint angle", unit: "deg", ..Axis::default() };
        self.over_run(description, y, original_and_shaped(original, shaped))
    }

    /// A unit step at time 0, original and shaped (Fig. 4.10).
    pub(super) fn step(&self) -> Content {
        let impulses = self.report.setup().shaper.impulses();
        let duration = self.report.setup().shaper.duration();
        let margin = if duration > 0.0 { 0.25 * duration } else { 0.1 };
        let (mut at, mut original, mut shaped) = (vec![-margin], vec![0.0], vec![0.0]);
        let mut level = 0.0;
        for impulse in impulses {
            at.extend([impulse.time, impulse.time]);
            // The first impulse comes with the step.
            original.extend([if original.len() > 1 { 1.0 } else { 0.0 }, 1.0]);
            shaped.extend([level, level + impulse.amplitude]);
            level += impulse.amplitude;
        }
        at.push(duration + margin);
        original.push(1.0);
        shaped.push(level);
        let texts: Vec<_> =
            impulses.iter().map(|i| format!("{:.4} at {:.4} s", i.amplitude, i.time)).collect();
        let description = format!("Impulses: {}.", texts.join(", "));
        let curves = original_and_shaped(original, shaped);
        let y = Axis { label: "Command", zero: true, ..Axis::default() };
        Content {
            description,
            at,
            shape: Shape::Curves { x: TIME, y, curves, markers: false, bands: vec![] },
        }
    }

    /// Residual vibration over the true frequency, as a share of the design frequency.
    pub(super) fn robustness(&self) -> Content {
        let shaper = &self.report.setup().shaper;
        let at: Vec<f64> = (0..=400).map(|i| 0.5 + f64::from(i) / 400.0).collect();
        let left: Vec<f64> = match self.report.setup().mode {
            Some((frequency, damping)) => {
                at.iter().map(|r| 100.0 * shaper.residual_vibration(r * frequency, damping)).collect()
            }
            None => vec![100.0; at.len()],
        };
        let little = at.iter().zip(&left).filter(|(_, left)| **left <= 5.0).map(|(ratio, _)| *ratio);
        let within: Vec<f64> = little.collect();
        let description = if self.report.setup().mode.is_none() {
            "No shaper: all of the vibration is left.".to_owned()
        } else if within.is_empty() {
            "Never below 5 % of the vibration of an unshaped command.".to_owned()
        } else {
            format!(
                "At most 5 % of the vibration is left from {:.2} to {:.2} times the design frequency.",
                min(&within),
                max(&within)
            )
        };
        let curves = vec![Curve { key: "left", label: "Vibration left", class: "shaping", values: left }];
        let bands = vec![Band { from: 0.0, to: 5.0, label: "5 %" }];
        let x = Axis { label: "True frequency / design frequency", ..Axis::default() };
        let y = Axis { label: "Residual vibration", unit: "%", zero: true, ..Axis::default() };
        Content { description, at, shape: Shape::Curves { x, y, curves, markers: false, bands } }
    }
}

fn original_and_shaped(original: Vec<f64>, shaped: Vec<f64>) -> Vec<Curve> {
    vec![
        Curve { key: "original", label: "Original", class: "desired", values: original },
        Curve { key: "shaped", label: "Shaped", class: "shaping", values: shaped },
    ]
}

fn degrees(q: &[Joints], joint: usize) -> Vec<f64> {
    q.iter().map(|q| q[joint] / DEG).collect()
}

fn largest(vectors: &[Vector3<f64>]) -> f64 {
    vectors.iter().map(|v| v.norm()).fold(0.0, f64::max)
}

pub(super) fn max(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

fn min(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// A number as text in a sentence.
pub(super) fn digits(value: f64) -> String {
    match value.abs() {
        large if large >= 100.0 => format!("{value:.0}"),
        middle if middle >= 1.0 => format!("{value:.2}"),
        _ => format!("{value:.4}"),
    }
}
