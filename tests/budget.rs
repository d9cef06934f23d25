//! The error budget and the scene: their parts add up to the report's totals.

use crate::common::{column, run};
use armill::Report;
use armill::report::scene::{FRAME, ROW};
use armill::robot::{Joints, forward};
use nalgebra::Vector3;
use serde_json::{Value, json};

/// The report of a job with some values replaced, on paths that bend, stop and turn.
fn reports() -> Vec<Report> {
    let rectangle =
        json!({"kind":"rectangle","center_mm":[600,0,100],"width_mm":80,"height_mm":50,"corner_radius_mm":5});
    let sharp = json!({"kind":"csv","text":"600,-60,100\n660,0,120\n600,60,100"});
    let leaning = json!({"kind":"csv","text":"600,-60,100,0,0,1\n660,0,120,0.1,0,1\n600,60,100,0,0.1,1"});
    // The RX-90 as if a parallelogram linkage drove its forearm.
    let held = json!({"opw":{"c1_mm":420,"c2_mm":450,"c3_mm":650,"c4_mm":85},"joint_3":"parallelogram",
        "joint_compliance_rad_per_nm":[9e-7,11e-7,15e-7,28e-7,98e-7,1e-6]});
    let changes: [Vec<(&str, Value)>; 5] = [
        vec![],
        vec![
            ("path", rectangle),
            ("workpiece_frame", json!({"xyz_mm":[10,20,30],"rpy_deg":[10,-20,30]})),
            ("tool_frame", json!({"xyz_mm":[0,50,120],"rpy_deg":[0,30,0]})),
        ],
        vec![("path", sharp), ("shaper", json!("none"))],
        vec![("path", leaning.clone())],
        vec![("path", leaning), ("robot", held)],
    ];
    changes.iter().map(|changes| run(changes)).collect()
}

#[test]
fn what_the_joints_give_adds_up_to_the_deflection() {
    for report in reports() {
        for k in (0..report.samples()).step_by(97) {
            let sum: Vector3<f64> = report.deflection_by_joint(k).iter().sum();
            // Summed in the same order, but rounded differently on the way.
            assert!((sum - report.deflection[k]).norm() < 1e-15);
        }
    }
}

#[test]
fn tip_and_axis_go_where_the_turned_joints_put_them() {
    for report in reports() {
        let (robot, before) = (&report.plan.robot, &report.before);
        for k in (0..report.samples()).step_by(211) {
            let (q, force) = (report.shaped(&report.q).at(k), report.force[k]);
            let tip = |q| forward::forward(robot, &q).position;
            // Work: a joint's torque is the force times the tip's motion (eq. 3.47), by central
            // differences.
            let turns = Joints::from_fn(|i, _| {
                let mut step = Joints::zeros();
                step[i] = 1e-5;
                robot.compliance()[i] * force.dot(&(tip(q + step) - tip(q - step))) / 2e-5
            });
            let bent = forward::forward(robot, &(q + turns));
            let axis = -bent.rotation.column(2);
            // Levers are taken before the joints turn: the error is the square of the turn, on 1.5
            // m.
            let square = turns.norm_squared() * 1.5 + 1e-15;
            assert!((before.actual[k] - bent.position).norm() <= square, "sample {k}");
            // A path with one constant axis stores only the angle to it.
            if report.plan.path.is_multi_axis() {
                assert!((before.axis[k] - axis).norm() <= square, "sample {k}");
            }
            // At rest nothing is bent.
            let little = force.norm() < 0.1 * report.mean_force().norm();
            assert!(little || (tip(q) - bent.position).norm() > 20.0 * square, "no little thing at {k}");
        }
    }
}

#[test]
fn the_parts_add_up_to_the_contour_error() {
    for report in reports() {
        let summary = report.summary();
        let (budget, both) = (summary.budget, summary.before_mm.both);
        for (parts, whole) in [(budget.worst_mm, both.max), (budget.mean_mm, both.mean)] {
            let sum = parts.deflection() + parts.shaping;
            // Rounding of about twenty thousand additions of millimetres.
            assert!((sum - whole).abs() < 1e-10, "{sum} of {whole}");
            assert!((parts.total - whole).abs() < 1e-10);
        }
        assert_eq!(column(&report, "contour_error_mm")[budget.sample], both.max);
        assert_eq!(column(&report, "time_s")[budget.sample], budget.time_s);
    }
}

#[test]
fn a_joint_that_alone_gives_way_gives_all_of_it() {
    for joint in 0..6 {
        let mut compliance = [0.0; 6];
        compliance[joint] = 1e-6;
        let robot = json!({"preset":"staubli-rx90","joint_compliance_rad_per_nm":compliance});
        let path = json!({"kind":"line","from_mm":[600,-50,100],"to_mm":[600,50,100]});
        let report = run(&[("robot", robot), ("path", path), ("shaper", json!("none"))]);
        let worst = report.budget().worst_mm;
        for other in (0..6).filter(|other| *other != joint) {
            assert_eq!(worst.joints[other], 0.0);
        }
        // On a line only the joints move the tip; the rest is the closure error of the inverse
        // model.
        assert!((worst.joints[joint] - worst.total).abs() < 1e-6, "{worst:?}");
    }
}

#[test]
fn a_rigid_arm_leaves_everything_to_the_shaper() {
    let robot = json!({"preset":"staubli-rx90","joint_compliance_rad_per_nm":[0,0,0,0,0,0]});
    let budget = run(&[("robot", robot)]).budget();
    assert_eq!(budget.worst_mm.joints, [0.0; 6]);
    // A projection onto its own direction: the last bits.
    assert!((budget.worst_mm.shaping - budget.worst_mm.total).abs() < 1e-12);
    assert_eq!(budget.sentence, "Shaping causes 100 % of the contour error where it is largest.");
}

#[test]
fn the_frames_end_in_the_tip_that_the_columns_name() {
    for report in reports() {
        let coordinates =
            |key: &str| ["x", "y", "z"].map(|axis| column(&report, &format!("{key}_{axis}_mm")));
        let (actual, deflection) = (coordinates("actual"), coordinates("deflection"));
        for k in (0..report.samples()).step_by(211) {
            let frames = report.frames(k);
            assert_eq!(frames.len(), 9 * FRAME);
            for axis in 0..3 {
                let tcp = frames[7 * FRAME + axis];
                // Millimetres from metres and back: the last bits.
                assert!((tcp + deflection[axis][k] - actual[axis][k]).abs() < 1e-9);
                assert!(
                    (frames[8 * FRAME + axis] - report.setup().workpiece.position[axis] * 1e3).abs() < 1e-9
                );
            }
        }
        assert_eq!(report.frames(usize::MAX), report.frames(report.samples() - 1));
    }
}

#[test]
fn a_shortened_track_keeps_ends_corners_and_the_largest_error() {
    for report in reports() {
        let whole = report.track(usize::MAX);
        assert_eq!(whole.len(), report.samples() * ROW);
        let short = report.track(300);
        let rows: Vec<&[f64]> = short.chunks(ROW).collect();
        assert!(rows.len() <= 304, "{} rows", rows.len());
        assert!(rows.windows(2).all(|pair| pair[0][0] < pair[1][0]), "in their order, each once");
        for row in &rows {
            assert_eq!(*row, &whole[row[0] as usize * ROW..][..ROW], "rows are samples");
        }
        assert_eq!(rows[rows.len() - 1][0] as usize, report.samples() - 1);
        assert!(rows.iter().any(|row| row[0] as usize == report.budget().sample));
    }
    // The corner of the bent line.
    let report = &reports()[2];
    let corner = Vector3::new(660.0, 0.0, 120.0);
    let nearest = report
        .track(300)
        .chunks(ROW)
        .map(|row| (Vector3::from_row_slice(&row[2..5]) - corner).norm())
        .fold(f64::MAX, f64::min);
    assert!(nearest < 0.1, "{nearest} mm");
}
