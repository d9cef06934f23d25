//! Spin about the tool axis: what turns, what must not, and what a free spin gains.

use crate::common::{column, job_text, refused, run};
use armill::Report;
use armill::math::angle_between;
use armill::robot::forward;
use serde_json::{Value, json};

/// A program of three lines, the spindle at 40 deg on the flange, so that the spin moves all
/// joints.
fn text(spin: Value, changes: &[(&str, Value)]) -> String {
    let mut all = vec![
        ("path", json!({"kind":"csv","text":"350,-400,120\n600,0,120\n350,400,150\n100,500,150"})),
        ("tool_frame", json!({"xyz_mm":[30,0,120],"rpy_deg":[0,40,0]})),
        ("motion.sample_time_s", json!(0.01)),
        ("spin", spin),
    ];
    all.extend(changes.iter().cloned());
    job_text(&all)
}

fn angled(spin: Value, changes: &[(&str, Value)]) -> Report {
    armill::run_json(&text(spin, changes), &mut armill::Progress::none()).unwrap()
}

fn free(goal: &str, low: f64, high: f64) -> Value {
    json!({"mode":"free","range_deg":[low,high],"goal":goal})
}

#[test]
fn a_fixed_spin_turns_the_tcp_and_moves_neither_tip_nor_axis() {
    let [straight, turned] = [0.0, 35.0].map(|angle| angled(json!({"angle_deg":angle}), &[]));
    for key in ["desired_x_mm", "desired_y_mm", "desired_z_mm", "tool_axis_k", "force_x_n", "force_z_n"] {
        assert_eq!(column(&straight, key), column(&turned, key), "{key}");
    }
    for (a, b) in straight.q.iter().zip(turned.q.iter()) {
        let [a, b] =
            [(&straight, a), (&turned, b)].map(|(report, q)| forward::forward(&report.plan.robot, q));
        assert!((a.position - b.position).norm() < 1e-9);
        assert!((a.rotation.column(2) - b.rotation.column(2)).norm() < 1e-9);
        let (x, y) = (a.rotation.column(0).into_owned(), b.rotation.column(0).into_owned());
        assert!((angle_between(&x, &y) - 35_f64.to_radians()).abs() < 1e-9);
        // Counter-clockwise seen from the spindle: about the axis from tip to spindle, which is -z.
        assert!(x.cross(&y).dot(&-a.rotation.column(2)) > 0.0);
    }
    assert!(straight.columns().iter().all(|column| column.key != "spin_deg"));
    assert!(straight.summary().spin.is_none());
}

#[test]
fn a_range_without_width_is_the_fixed_spin() {
    for angle in [0.0, -20.0] {
        let fixed = angled(json!({"angle_deg":angle}), &[]);
        for goal in ["smooth-joints", "least-error"] {
            let bound = angled(free(goal, angle, angle), &[]);
            for (ours, theirs) in fixed.columns().iter().zip(bound.columns()) {
                assert_eq!(ours.values, theirs.values, "{}", ours.key);
            }
            assert!(column(&bound, "spin_deg").iter().all(|spin| (spin - angle).abs() < 1e-12));
        }
    }
}

#[test]
fn a_free_spin_does_what_it_is_chosen_for() {
    let fixed = angled(json!({}), &[]);
    let calm = angled(free("smooth-joints", -90.0, 90.0), &[]);
    let exact = angled(free("least-error", -90.0, 90.0), &[]);
    // Squared joint travel along the path, and the largest error: the objectives themselves, over
    // all samples.
    let turning = |report: &Report| {
        let steps = report.q.windows(2).zip(report.plan.trajectory.timing.arc_length.windows(2));
        steps
            .map(|(q, s)| if s[1] > s[0] { (q[1] - q[0]).norm_squared() / (s[1] - s[0]) } else { 0.0 })
            .sum::<f64>()
    };
    let erring = |report: &Report| report.summary().before_mm.both.max;
    assert!(turning(&calm) < 0.97 * turning(&fixed), "{} of {}", turning(&calm), turning(&fixed));
    assert!(erring(&exact) < 0.995 * erring(&fixed), "{} of {}", erring(&exact), erring(&fixed));
    for angle in [-90, -60, -30, 30, 60, 90] {
        // Any single angle is worse; 1 % allows for the angles between the stations.
        let Ok(job) = armill::Job::from_json(&text(json!({"angle_deg":angle}), &[])) else { panic!() };
        let Ok(held) = armill::run(&job, &mut armill::Progress::none()) else { continue };
        assert!(
            turning(&calm) < 1.01 * turning(&held),
            "{angle} deg: {} of {}",
            turning(&calm),
            turning(&held)
        );
        assert!(erring(&exact) < 1.02 * erring(&held), "{angle} deg: {}", erring(&held));
    }
    for report in [&calm, &exact] {
        let spin = column(report, "spin_deg");
        assert!(spin.iter().all(|spin| spin.abs() <= 90.0 + 1e-9), "the range holds");
        // The path is the same; only the arm's posture differs. Compensation still works.
        assert_eq!(column(report, "desired_x_mm"), column(&fixed, "desired_x_mm"));
        let summary = report.summary();
        assert!(summary.after_mm.max < 0.05 * summary.before_mm.both.max, "{}", summary.verdict);
        let gain = summary.spin.unwrap();
        let compared = gain.fixed.unwrap();
        assert_eq!(
            compared.error_mm,
            fixed.summary().before_mm.both.max,
            "the gain is against the fixed run itself"
        );
        assert_eq!(gain.free.error_mm, summary.before_mm.both.max);
        let used = spin.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(*x), b.max(*x)));
        assert_eq!(gain.used_deg, [used.0, used.1]);
        // The joints' travel and the fastest joint, from the columns.
        let steps: Vec<f64> = (1..=6)
            .flat_map(|i| {
                let q = column(report, &format!("q{i}_deg"));
                q.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect::<Vec<_>>()
            })
            .collect();
        let (way, fastest) =
            (steps.iter().sum::<f64>(), steps.iter().fold(0.0, |a, b| f64::max(a, b / 0.01)));
        assert!((gain.free.joint_travel_deg - way).abs() < 1e-9 * way);
        assert!((gain.free.joint_speed_deg_s - fastest).abs() < 1e-9 * fastest);
        assert!(gain.sentence.contains("instead of"), "{}", gain.sentence);
    }
}

#[test]
fn a_free_spin_keeps_the_joints_in_their_range_where_it_can() {
    // With the part's X kept, joint 6 turns against joint 1 all around; with a free spin it need
    // not.
    let narrow = json!({
        "preset":"staubli-rx90",
        "joint_limits_deg":[[-170,170],[-137.5,137.5],[-142.5,142.5],[-270,270],[-105,120],[-20,20]]
    });
    let path = json!({"kind":"arc","center_mm":[0,0,100],"radius_mm":550,"normal":[0,0,1],"start_deg":-60,"sweep_deg":120});
    let warns = |spin: Value| {
        let report = run(&[
            ("path", path.clone()),
            ("robot", narrow.clone()),
            ("spin", spin),
            ("motion.sample_time_s", json!(0.01)),
            ("shaper", json!("none")),
        ]);
        report.warnings.iter().any(|warning| warning.code == "joint-limit")
    };
    assert!(warns(json!({"mode":"fixed"})), "the case is one");
    assert!(!warns(free("smooth-joints", 0.0, 360.0)));
    assert!(!warns(free("least-error", 0.0, 360.0)));
}

#[test]
fn mistakes_are_named() {
    for (spin, field) in [
        (json!({"mode":"free","range_deg":[10,-10]}), "spin.range_deg"),
        (json!({"mode":"free","range_deg":[-400,0]}), "spin.range_deg[0]"),
        (json!({"angle_deg":1000}), "spin.angle_deg"),
        (json!({"mode":"loose"}), "spin.mode"),
    ] {
        assert_eq!(refused(&[("spin", spin)]).field(), Some(field));
    }
}
