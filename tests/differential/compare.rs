//! The report against the plain model: every column of every job, with bounds for the quantiles of
//! their differences.

use super::arm::{Refusal, column};
use super::model::{Answer, Outcome, Question};
use armill::Report;
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Bounds of one group of columns.
pub(crate) struct Bound {
    /// First words of the columns' keys.
    pub(crate) keys: &'static [&'static str],
    pub(crate) unit: &'static str,
    /// Whether differences are relative to the largest value of the column in the job.
    share: bool,
    /// q75, q99 and maximum, over the jobs, of a job's largest difference: tools without a corner
    /// radius.
    pub(crate) flat: [f64; 3],
    /// These quantiles for tools with a corner radius, ball noses among them.
    pub(crate) round: [f64; 3],
    pub(crate) because: &'static str,
}

const fn bound(
    keys: &'static [&'static str],
    unit: &'static str,
    [flat, round]: [[f64; 3]; 2],
    because: &'static str,
) -> Bound {
    Bound { keys, unit, share: false, flat, round, because }
}

/// A bound for both kinds of tool.
const fn any_tool(
    keys: &'static [&'static str],
    unit: &'static str,
    both: [f64; 3],
    because: &'static str,
) -> Bound {
    bound(keys, unit, [both, both], because)
}

const FORCE: &[&str] = &["force_x_n", "force_y_n", "force_z_n", "mean_force_n"];

/// Every column has its row; the summary's figures share the rows of the columns they are computed
/// from.
pub(crate) const BOUNDS: &[Bound] = &[
    any_tool(&["time_s"], "s", [1e-14, 1e-13, 1e-12], "rounding"),
    any_tool(
        &["arc_length_mm", "desired_", "feed_mm_s"],
        "mm, mm/s",
        [5e-12, 5e-9, 1e-6],
        "the plain timing halves the way until the square of the speed is straight to 1e-12",
    ),
    any_tool(
        &["q1", "q2", "q3", "q4", "q5", "q6", "shaped_q"],
        "deg",
        [1e-12, 1e-10, 1e-7],
        "positions above over lever arms, larger near singularities (up to 50 times: sines from 0.02 on are compared)",
    ),
    any_tool(
        &["shaped_x", "shaped_y", "shaped_z"],
        "mm",
        [1e-10, 1e-8, 1e-6],
        "joints above over lever arms",
    ),
    any_tool(&["tool_axis_"], "", [1e-14; 3], "rounding"),
    any_tool(&["cuts"], "", [1e-12, 1e-12, 1e-9], "rounding"),
    any_tool(&["run_in"], "", [1e-11, 1e-9, 1e-6], "arc length above over the length of the run-in"),
    Bound {
        share: true,
        ..bound(
            FORCE,
            "of the largest",
            [[1e-7, 1e-6, 1e-4], [2e-5, 3e-4, 2e-2]],
            "midpoint rule in 3000 steps of the angle, (pi / 3000)^2 / 24 of the second derivative, \
             more where directions cancel; corners: 300 by 300 steps against 256 slices",
        )
    },
    Bound {
        share: true,
        ..bound(
            &["deflection_x", "deflection_y", "deflection_z"],
            "of the largest",
            [[1e-7, 1e-6, 1e-4], [2e-5, 3e-4, 2e-2]],
            "as the force; the differences of 1e-5 rad behind the Jacobian add 1e-10",
        )
    },
    bound(
        &["actual_", "contour_error_mm", "deflection_contour_error_mm", "tracking_error_mm", "before"],
        "mm",
        [[3e-8, 5e-7, 1e-4], [5e-6, 2e-4, 5e-3]],
        "the force's share of deflections of up to some mm",
    ),
    any_tool(
        &["shaping_contour_error_mm"],
        "mm",
        [6e-8, 6e-8, 1e-6],
        "the plain closest point is found to 1e-10 m: where the tip is on the path that is up to 5e-8 mm",
    ),
    bound(
        &[
            "compensated_x",
            "compensated_y",
            "compensated_z",
            "after",
            "after_actual_",
            "after_contour_error_mm",
            "history",
        ],
        "mm",
        [[3e-8, 5e-7, 1e-4], [5e-6, 2e-4, 5e-3]],
        "the errors before, passed through up to three passes, which do not amplify them",
    ),
    bound(
        &["compensated_q"],
        "deg",
        [[1e-10, 1e-8, 1e-5], [2e-8, 4e-6, 1e-3]],
        "the corrections above over lever arms",
    ),
    any_tool(&["compensated_axis_"], "", [1e-14; 3], "the tool stays upright: rounding"),
    bound(
        &["axis_error_deg", "after_axis_error_deg"],
        "deg",
        [[1e-9, 1e-7, 1e-5], [2e-7, 2e-5, 1e-3]],
        "the force's share of rotations of up to some tenths of a degree",
    ),
];

/// The row of [`BOUNDS`] for a key: the one with the longest matching prefix.
pub(crate) fn row(key: &str) -> usize {
    let fit =
        |bound: &Bound| bound.keys.iter().filter(|k| key.starts_with(*k)).map(|k| k.len()).max().unwrap_or(0);
    let (length, row) = BOUNDS
        .iter()
        .enumerate()
        .map(|(i, bound)| (fit(bound), i))
        .max_by_key(|(fit, i)| (*fit, usize::MAX - i))
        .unwrap();
    assert!(length > 0, "no bound for {key}");
    row
}

/// The plain model's columns, in the report's units.
fn columns(question: &Question, answer: &Answer) -> BTreeMap<String, Vec<f64>> {
    let mut all = BTreeMap::new();
    let mut one = |key: &str, values: Vec<f64>| {
        all.insert(key.to_owned(), values);
    };
    let count = answer.desired.len();
    one("time_s", (0..count).map(|k| k as f64 * question.tempo.dt).collect());
    one("arc_length_mm", answer.desired.iter().map(|at| at.s * 1e3).collect());
    one("feed_mm_s", answer.desired.iter().map(|at| at.speed * 1e3).collect());
    let axis = vec![column(&question.place, 2); count];
    for (name, vectors, unit) in [
        ("desired_?_mm", &answer.position, 1e3),
        ("force_?_n", &answer.before.force, 1.0),
        ("deflection_?_mm", &answer.before.deflection, 1e3),
        ("actual_?_mm", &answer.before.actual, 1e3),
        ("compensated_?_mm", &answer.commanded, 1e3),
        ("shaped_?_mm", &answer.shaping_only.actual, 1e3),
        ("after_actual_?_mm", &answer.after.actual, 1e3),
    ] {
        for (i, letter) in ["x", "y", "z"].into_iter().enumerate() {
            one(&name.replace('?', letter), vectors.iter().map(|v| v[i] * unit).collect());
        }
    }
    for (i, letter) in ["i", "j", "k"].into_iter().enumerate() {
        one(&format!("tool_axis_{letter}"), axis.iter().map(|v| v[i]).collect());
        one(&format!("compensated_axis_{letter}"), axis.iter().map(|v| v[i]).collect());
    }
    for (name, q) in [("q", &answer.q), ("shaped_q", &answer.before.q), ("compensated_q", &answer.command_q)]
    {
        for i in 0..6 {
            let seen = q.iter().map(|q| question.arm.displayed(q)[i].to_degrees());
            one(&format!("{name}{}_deg", i + 1), seen.collect());
        }
    }
    let mm = |outcome: &Outcome| outcome.error.iter().map(|e| e * 1e3).collect::<Vec<f64>>();
    one("contour_error_mm", mm(&answer.before));
    one("deflection_contour_error_mm", mm(&answer.deflection_only));
    one("shaping_contour_error_mm", mm(&answer.shaping_only));
    one("after_contour_error_mm", mm(&answer.after));
    let way = |(a, b): (&Vector3<f64>, &Vector3<f64>)| (a - b).norm() * 1e3;
    one("tracking_error_mm", answer.position.iter().zip(&answer.before.actual).map(way).collect());
    one("axis_error_deg", answer.before.tilt.iter().map(|tilt| tilt.to_degrees()).collect());
    one("after_axis_error_deg", answer.after.tilt.iter().map(|tilt| tilt.to_degrees()).collect());
    one("cuts", question.shaped_cuts(&answer.desired));
    one(
        "run_in",
        question.run_in(&answer.desired).iter().map(|w| if w.is_nan() { 0.0 } else { *w }).collect(),
    );
    // Figures of the summary, as columns of their own.
    let figures = 1e3;
    // The largest of the pieces that cut.
    let cuts = question.way.pieces.iter().filter(|piece| piece.cuts);
    let chips = cuts.map(|piece| question.cut.per_tooth(piece.limit, piece.spindle));
    let c = chips.reduce(f64::max).unwrap_or(question.cut.per_tooth(question.cut.feed, None));
    one("mean_force_n", (answer.force.cutting * c + answer.force.edge).iter().copied().collect());
    let before = [&answer.deflection_only, &answer.shaping_only, &answer.before];
    one("before", before.iter().flat_map(|outcome| outcome.figures().map(|f| f * figures)).collect());
    one("after", answer.after.figures().map(|f| f * figures).to_vec());
    one("history", answer.history.iter().flat_map(|pass| pass.map(|f| f * figures)).collect());
    all
}

/// The largest difference of each column, in the unit of its bound; or the first disagreement in
/// words.
pub(crate) fn differences(
    report: &Report,
    question: &Question,
    answer: &Answer,
) -> Result<Vec<(usize, f64)>, String> {
    let summary = report.summary();
    let seen = (summary.passes, report.compensation.stopped.is_some(), report.samples());
    // Where a correction reaches the end of the branch, both stop, unless another branch is so near
    // that Armill's goes on, sees no improvement, and drops the pass.
    let goes_on = answer.stopped == Some(Refusal::Branch) && report.compensation.stopped.is_none();
    let plain = (answer.passes, answer.stopped.is_some() && !goes_on, answer.desired.len());
    let dropped = usize::from(goes_on);
    if seen != plain || summary.history_max_mm.len() != answer.history.len() + dropped {
        return Err(format!("passes, stopped and samples are {seen:?}, plain {plain:?}"));
    }
    let warned = |code: &str| report.warnings.iter().any(|warning| warning.code == code);
    match question.beyond(answer) {
        None if !warned("joint-limits-unknown") => return Err("no warning of unknown joint limits".into()),
        // Nearer than this, either answer is right.
        Some(beyond) if beyond.abs() > 1e-6 && warned("joint-limit") != (beyond > 0.0) => {
            return Err(format!("a joint is {beyond} rad beyond its range"));
        }
        _ => {}
    }
    let mut plain = columns(question, answer);
    let borders: Vec<_> = question.run_in(&answer.desired).iter().map(|w| w.is_nan()).collect();
    let mut all = Vec::new();
    let mut compare = |key: &str, ours: &[f64]| {
        // Random plants; `tests/band.rs` runs each of them through the whole model.
        if key == "after_p95_mm" {
            return;
        }
        let theirs = plain.remove(key).unwrap_or_else(|| panic!("the plain model has no {key}"));
        assert_eq!(ours.len(), theirs.len(), "{key}");
        let row = row(key);
        let largest = theirs.iter().fold(1e-9, |most: f64, v| most.max(v.abs()));
        let scale = if BOUNDS[row].share { largest } else { 1.0 };
        let apart = ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs());
        // A NaN is not a small number.
        all.push((row, apart.fold(0.0, |most: f64, d| if d <= most { most } else { d }) / scale));
    };
    // Program lines are whole numbers, and at the border of two moves either is right.
    for column in report.columns().iter_mut().filter(|column| column.key != "program_line") {
        if column.key == "run_in" {
            for (ours, border) in column.values.iter_mut().zip(&borders) {
                *ours = if *border { 0.0 } else { *ours };
            }
        }
        compare(&column.key, &column.values);
    }
    compare("mean_force_n", &summary.mean_force_n);
    let before = summary.before_mm;
    let before = [before.deflection, before.shaping, before.both];
    compare("before", &before.map(|of| [of.mean, of.max]).concat());
    compare("after", &[summary.after_mm.mean, summary.after_mm.max]);
    let history =
        summary.history_mean_mm.iter().zip(&summary.history_max_mm).flat_map(|(mean, max)| [*mean, *max]);
    compare("history", &history.take(2 * answer.history.len()).collect::<Vec<_>>());
    assert!(plain.is_empty(), "not reported: {:?}", plain.keys());
    Ok(all)
}
