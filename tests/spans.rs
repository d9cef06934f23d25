//! The stretches of a warning are those at which it holds, no more and no less.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]

use crate::common::{self, any_vector, between, column, run};
use armill::Report;
use armill::report::{MOST_SPANS, Warning};
use armill::robot::forward;
use serde_json::json;
use std::collections::BTreeSet;

fn warning<'r>(report: &'r Report, code: &str) -> Option<&'r Warning> {
    report.warnings.iter().find(|warning| warning.code == code)
}

/// Whether a warning's condition holds at each sample, from columns and forward model alone; `None`
/// for one that is not judged here.
fn held(report: &Report, warning: &Warning) -> Option<Vec<bool>> {
    let count = report.samples();
    let trajectory = &report.plan.trajectory;
    let number = |after: &str| -> f64 {
        let rest = warning.message.split_once(after).unwrap().1;
        rest.chars().take_while(char::is_ascii_digit).collect::<String>().parse().unwrap()
    };
    let all = |holds: &dyn Fn(usize) -> bool| Some((0..count).map(holds).collect());
    let frames = |k: usize| forward::frames(&report.plan.robot, &report.q[k]);
    match warning.code {
        "joint-limit" | "joint-limit-near" => {
            let joint = number("joint ") as usize;
            let (low, high) = report.plan.robot.limits().unwrap()[joint - 1];
            let [own, bent] = ["", "compensated_"].map(|kind| column(report, &format!("{kind}q{joint}_deg")));
            let room = if warning.code == "joint-limit" { 0.0 } else { 2.0 };
            let beyond = |q: f64| (low.to_degrees() - q).max(q - high.to_degrees()) > -room;
            all(&|k| beyond(own[k]) || beyond(bent[k]))
        }
        "singularity-wrist" => all(&|k| {
            let frames = frames(k);
            let sine = frames[3].rotation.column(2).cross(&frames[5].rotation.column(2)).norm();
            sine < 5.0_f64.to_radians().sin()
        }),
        "singularity-shoulder" => all(&|k| frames(k)[5].position.xy().norm() < 0.010),
        "joint-jump" => all(&|k| {
            k > 0 && (report.q[k] - report.q[k - 1]).iter().any(|turn| turn.abs() > 5.0_f64.to_radians())
        }),
        "force-payload" => {
            let rated = report.setup().payload.unwrap() * 9.80665;
            let parts = ["x", "y", "z"].map(|axis| column(report, &format!("force_{axis}_n")));
            all(&|k| parts.iter().map(|part| part[k] * part[k]).sum::<f64>().sqrt() > rated)
        }
        "plunge" => all(&|k| {
            let timing = &trajectory.timing;
            let waits = timing.speed[k] == 0.0 && k > 0 && k + 1 < trajectory.moving;
            let along = timing.heading[k].dot(trajectory.axis.at(k)) * timing.engaged[k];
            !waits && along.abs() > 0.5
        }),
        "run-in" | "run-out" => {
            let after = column(report, "after_contour_error_mm");
            let end = warning.code == "run-out";
            // Of the run-in only that it is beyond the tolerance: where a cut begins, the model says.
            let tolerance = report.summary().tolerance_mm;
            all(&|k| {
                let listed = |&(from, to): &(usize, usize)| (from..=to).contains(&k);
                after[k] > tolerance
                    && if end { k >= trajectory.moving } else { warning.spans_samples.iter().any(listed) }
            })
        }
        _ => None,
    }
}

/// Times that a message names [s].
fn named(message: &str) -> Vec<f64> {
    let words = message.split(" at ").skip(1);
    words.filter_map(|rest| rest.split_once(" s")?.0.parse().ok()).collect()
}

fn check(report: &Report, seen: &mut BTreeSet<&'static str>) {
    let dt = report.plan.trajectory.sample_time;
    for warning in &report.warnings {
        let Warning { code, message, spans_samples, spans_s, .. } = warning;
        assert_eq!(warning.from_sample, spans_samples.first().map(|span| span.0), "{code}");
        assert_eq!(warning.to_sample, spans_samples.last().map(|span| span.1), "{code}");
        assert_eq!(spans_s.len(), spans_samples.len());
        for (samples, times) in spans_samples.iter().zip(spans_s) {
            assert!(samples.0 <= samples.1 && samples.1 < report.samples(), "{code}: {samples:?}");
            assert_eq!(*times, (samples.0 as f64 * dt, samples.1 as f64 * dt), "{code}");
        }
        assert!(spans_samples.windows(2).all(|pair| pair[0].1 < pair[1].0), "{code}: {spans_samples:?}");
        if spans_samples.is_empty() {
            continue;
        }
        for time in named(message) {
            // Messages round to a millisecond.
            let within = |&&(from, to): &&(f64, f64)| from - 6e-4 <= time && time <= to + 6e-4;
            assert!(spans_s.iter().find(within).is_some(), "{message}: {spans_s:?}");
        }
        let Some(held) = held(report, warning) else { continue };
        seen.insert(code);
        let mut listed = vec![false; held.len()];
        spans_samples.iter().for_each(|&(from, to)| listed[from..=to].fill(true));
        if spans_samples.len() < MOST_SPANS {
            let other = (0..held.len()).find(|&k| held[k] != listed[k]);
            assert_eq!(other, None, "{message}: {spans_samples:?}");
        }
        assert!(spans_samples.iter().all(|&(from, to)| held[from] && held[to]), "{message}");
    }
}

#[test]
fn stretches_are_where_the_condition_holds() {
    let mut random = fastrand::Rng::with_seed(7);
    let mut seen = BTreeSet::new();
    check(&run(&[]), &mut seen);
    for _ in 0..60 {
        let mut at = |size: f64| -> [f64; 3] { any_vector(&mut random, size).into() };
        let points: Vec<[f64; 3]> = (0..5).map(|_| at(150.0)).collect();
        let place = at(300.0);
        let shaper = if random.bool() {
            json!("none")
        } else {
            json!({"kind":"zv","frequency_hz":between(&mut random, 4.0, 12.0),"damping":0.05})
        };
        let robot = ["kuka-kr-210-2", "staubli-rx90", "staubli-tx90"][random.usize(..3)];
        let reach = if robot.starts_with("kuka") { 1700.0 } else { 500.0 };
        let changes = [
            ("robot", json!({ "preset": robot })),
            ("workpiece_frame", json!({"xyz_mm":[reach + place[0], 2.0 * place[1], 500.0 + place[2]]})),
            ("tool_frame", json!({"xyz_mm":[0,0,100],"rpy_deg":[0,between(&mut random, 0.0, 90.0),0]})),
            ("spin", json!({"angle_deg": between(&mut random, -180.0, 180.0)})),
            ("path", json!({"kind":"polyline","points_mm":points})),
            ("motion.feed_mm_s", json!(60)),
            ("motion.sample_time_s", json!(0.01)),
            ("cutting.axial_depth_mm", json!(between(&mut random, 0.5, 5.0))),
            ("shaper", shaper),
        ];
        if let Ok(report) = armill::run_json(&common::job_text(&changes), &mut armill::Progress::none()) {
            check(&report, &mut seen);
        }
    }
    for code in ["joint-limit", "joint-limit-near", "singularity-wrist", "force-payload", "plunge", "run-in"]
    {
        assert!(seen.contains(code), "{code} is not among {seen:?}");
    }
}

#[test]
fn the_excess_of_a_joint_is_what_its_command_is_beyond_its_range() {
    // Around its own base the arm turns joints 1 and 3 too far, on a part of the way.
    let report = run(&[("motion.sample_time_s", json!(0.05))]);
    let limits = report.plan.robot.limits().unwrap();
    let columns = |kind: &str| [1, 2, 3, 4, 5, 6].map(|i| column(&report, &format!("{kind}q{i}_deg")));
    let (own, bent) = (columns(""), columns("compensated_"));
    let mut signs = BTreeSet::new();
    for k in 0..report.samples() {
        let excess = report.joint_excess(k).unwrap();
        for (i, (low, high)) in limits.iter().enumerate() {
            let beyond = |q: f64| (low.to_degrees() - q).max(q - high.to_degrees());
            let wanted = beyond(own[i][k]).max(beyond(bent[i][k]));
            // Degrees from radians and back: the last bits.
            assert!((excess[i].to_degrees() - wanted).abs() < 1e-9, "joint {} at {k}", i + 1);
            signs.insert(wanted > 0.0);
        }
    }
    assert_eq!(signs.len(), 2, "inside and outside both occur");
    assert_eq!(report.joint_excess(usize::MAX), report.joint_excess(report.samples() - 1));
}

#[test]
fn three_plunges_are_three_stretches() {
    let hole = |x: f64| [[x, 0.0, 5.0], [x, 0.0, -5.0], [x, 0.0, 5.0], [x + 20.0, 0.0, 5.0]];
    let points: Vec<[f64; 3]> = [0.0, 20.0, 40.0].into_iter().flat_map(hole).collect();
    let report = run(&[
        ("robot", json!({"preset":"kuka-kr-210-2"})),
        ("workpiece_frame", json!({"xyz_mm":[1700,0,800]})),
        ("path", json!({"kind":"polyline","points_mm":points})),
        ("shaper", json!("none")),
    ]);
    let found = warning(&report, "plunge").unwrap();
    // Down and up again, with a rest at the bottom: nothing between two holes.
    let x = column(&report, "desired_x_mm");
    let offset = x[0];
    for hole in [0.0, 20.0, 40.0] {
        let there = |&&(from, to): &&(usize, usize)| {
            (x[from] - offset - hole).abs() < 1e-6 && (x[to] - offset - hole).abs() < 1e-6
        };
        assert!(found.spans_samples.iter().find(there).is_some(), "{hole}: {:?}", found.spans_samples);
    }
    let mut seen = BTreeSet::new();
    check(&report, &mut seen);
    let middle = |&(from, to): &(usize, usize)| (x[from] - x[to]).abs() < 1e-6;
    assert!(found.spans_samples.iter().all(middle), "none spans the way to the next hole");
}

#[test]
fn many_stretches_are_bounded_and_counted() {
    // 150 teeth of a comb, each with a plunge.
    let points: Vec<[f64; 3]> = (0..=300)
        .map(|i| [2.0 * f64::from(i / 2 + i % 2), 0.0, if i / 2 % 2 == 0 { 0.0 } else { 2.0 }])
        .collect();
    let report = run(&[
        ("robot", json!({"preset":"kuka-kr-210-2"})),
        ("workpiece_frame", json!({"xyz_mm":[1500,0,800]})),
        ("path", json!({"kind":"polyline","points_mm":points})),
        ("motion.sample_time_s", json!(0.01)),
        ("shaper", json!("none")),
    ]);
    let found = warning(&report, "plunge").unwrap();
    assert_eq!(found.spans_samples.len(), MOST_SPANS);
    assert!(found.message.contains("merged into 100"), "{}", found.message);
    check(&report, &mut BTreeSet::new());
}
