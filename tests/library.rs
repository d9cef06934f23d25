//! The library of robots: its data are complete, its kinematics agree with another author's, and
//! its rule for unknown stiffness agrees with the rule's own sources.
#![allow(clippy::disallowed_types, clippy::disallowed_methods, reason = "compared within tolerances")]
#![allow(clippy::print_stdout, reason = "quantiles are worth seeing: cargo test -- --nocapture")]

use crate::common;
use crate::common::peer::peer;
use crate::common::{any_joints, any_vector, between, run};
use armill::Error;
use armill::math::Pose;
use armill::robot::library::{self, RULE_PAYLOAD, RULE_STIFFNESS};
use armill::robot::{Joints, Opw, Robot, compliance, forward, inverse, jacobian};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use rs_opw_kinematics::kinematic_traits::Kinematics;
use serde_json::json;
use std::collections::BTreeSet;
use std::f64::consts::TAU;

fn robot(preset: &library::Preset) -> Robot {
    Robot::new(preset.name(), preset.links(), preset.limits(), preset.joint_compliance).unwrap()
}

fn pose_of(peer: &rs_opw_kinematics::pose::Pose) -> Pose {
    let rotation: Vec<f64> = glam_columns(peer);
    Pose {
        rotation: Matrix3::from_column_slice(&rotation),
        position: Vector3::new(peer.translation.x, peer.translation.y, peer.translation.z),
    }
}

/// The columns of the rotation matrix of the peer's quaternion (x, y, z, w).
fn glam_columns(peer: &rs_opw_kinematics::pose::Pose) -> Vec<f64> {
    let [x, y, z, w] = peer.rotation.to_array();
    let q = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
    q.to_rotation_matrix().matrix().iter().copied().collect()
}

/// q75, q99 and the maximum.
fn quantiles(mut errors: Vec<f64>) -> [f64; 3] {
    errors.sort_by(f64::total_cmp);
    let at = |share: f64| errors[((errors.len() - 1) as f64 * share) as usize];
    [at(0.75), at(0.99), at(1.0)]
}

#[test]
fn every_line_is_whole() {
    let all: Vec<_> = library::robots().collect();
    assert!(all.len() >= 60, "{}", all.len());
    assert_eq!(
        all.len(),
        all.iter().map(|preset| preset.id).collect::<BTreeSet<_>>().len(),
        "ids are unique"
    );
    for preset in &all {
        let robot = robot(preset);
        assert!(preset.geometry_note.len() > 40, "{} names its source: {}", preset.id, preset.geometry_note);
        assert_eq!(
            preset.stiffness_assumed,
            preset.stiffness_note.contains("order of magnitude"),
            "{}",
            preset.id
        );
        assert!(preset.mode_note.is_empty() || preset.mode_note.contains("Hz"), "{}", preset.mode_note);
        // Of the size for machining, or of the RX-90's family.
        let reach = robot.reach().1 + preset.opw.lengths_mm[0] * 1e-3;
        assert!(reach > 1.5 || preset.maker == "Stäubli", "{} reaches {reach} m", preset.id);
        assert!(preset.joint_compliance.iter().all(|c| (0.0..2e-5).contains(c)), "{}", preset.id);
        for [low, high] in preset.joint_limits_deg.into_iter().flatten() {
            assert!(-500.0 < low && low < high && high < 500.0, "{}: {low} to {high}", preset.id);
        }
        for speed in preset.joint_speed_deg_s.into_iter().flatten() {
            assert!((20.0..2000.0).contains(&speed), "{}: {speed} deg/s", preset.id);
        }
    }
    assert_eq!(run(&[]).summary().robot, "Stäubli RX-90");
    assert!(all.iter().any(|preset| !preset.mode_note.is_empty()));
    let known = all.iter().filter(|preset| !preset.stiffness_assumed).count();
    assert_eq!(known, 5);
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/robot/library");
    let files = ["robots.csv", "zeros.csv", "stiffness.csv", "sources.txt"];
    let bytes: u64 =
        files.iter().map(|file| std::fs::metadata(format!("{folder}/{file}")).unwrap().len()).sum();
    // 74 rows of six joint speeds are 1.8 kB of it.
    assert!(bytes < 16_500, "the library is {bytes} bytes");
}

/// `velocity` of the six joints in the URDFs that `sources.txt` names; two are in rad/s
/// there.
/// A semicolon within a text would shift the columns behind it.
#[test]
fn every_row_has_the_columns_of_its_head() {
    for table in [
        include_str!("../src/robot/library/robots.csv"),
        include_str!("../src/robot/library/stiffness.csv"),
        include_str!("../src/robot/library/zeros.csv"),
    ] {
        let columns = table.lines().next().unwrap().split(';').count();
        for line in table.lines() {
            assert_eq!(line.split(';').count(), columns, "{line}");
        }
    }
    for preset in library::robots() {
        for spread in preset.stiffness_spread {
            assert!((0.01..2.0).contains(&spread.deviation()), "{}: {spread:?}", preset.id);
        }
        assert!(!preset.stiffness_note.contains("  "), "{}", preset.stiffness_note);
    }
    for set in library::published() {
        assert!(!set.source.is_empty() && !set.confidence.is_empty(), "{}", set.key);
    }
}

#[test]
fn joint_speeds_are_those_of_the_sources() {
    let known = library::robots().filter(|preset| preset.joint_speed_deg_s.is_some()).count();
    assert_eq!(known, 74);
    for (id, speeds) in [
        ("fanuc-r-2000ic-165f", [130.0, 115.0, 125.0, 180.0, 180.0, 260.0]),
        ("staubli-tx2-90", [265.0, 210.0, 315.0, 450.0, 370.0, 630.0]),
        ("yaskawa-gp25", [210.0, 210.0, 265.0, 420.0, 420.0, 885.0]),
        (
            "kuka-kr-210-r2700-2",
            [2.0384_f64.to_degrees(), 1.9451_f64.to_degrees(), 112.0, 179.0, 172.0, 220.0],
        ),
    ] {
        let found = library::robot(id).unwrap().joint_speed_deg_s.unwrap();
        for (found, speed) in found.into_iter().zip(speeds) {
            // The table has one decimal.
            assert!((found - speed).abs() <= 0.05 + 1e-9, "{id}: {found} for {speed}");
        }
    }
    for unknown in ["staubli-rx90", "kuka-kr-500-3-mt", "staubli-tx2-140"] {
        assert_eq!(library::robot(unknown).unwrap().joint_speed_deg_s, None, "{unknown}");
    }
}

/// The joint `base_link-base` of ROS-Industrial's URDFs: where the controller's world is, by the
/// convention of those packages.
#[test]
fn the_controllers_world_is_where_the_sources_have_it() {
    for (id, mm) in [
        ("staubli-tx2-90", 478.0),
        ("staubli-rx160", 550.0),
        ("fanuc-m-20ia", 525.0),
        ("fanuc-r-2000ic-165f", 670.0),
        ("fanuc-m-900ia-260l", 950.0),
        ("yaskawa-gp25", 505.0),
        ("yaskawa-ms210", 650.0),
        ("kuka-kr-210-r2700-2", 0.0),
        ("abb-irb-6640-185-280", 0.0),
    ] {
        assert_eq!(library::robot(id).unwrap().world_mm, Some(mm), "{id}");
    }
    for preset in library::robots() {
        let c1 = preset.opw.lengths_mm[3];
        let above = ["FANUC", "Yaskawa", "Stäubli"].contains(&preset.maker);
        assert_eq!(preset.world_mm, Some(if above { c1 } else { 0.0 }), "{}", preset.id);
        let says = if above { format!("axis 2, {c1} mm above the foot") } else { "from the foot".into() };
        let note = preset.world_note();
        assert!(note.contains(&says) && note.contains("URDF"), "{}: {note}", preset.id);
    }
    let unknown = library::Preset { world_mm: None, ..library::robot("kuka-kr-60-3").unwrap() };
    assert_eq!(unknown.world().height(), 0.0);
    assert!(unknown.world_note().contains("not known"), "{}", unknown.world_note());
}

#[test]
fn forward_and_inverse_agree_with_another_authors() {
    let mut random = fastrand::Rng::with_seed(41);
    let (mut places, mut turns, mut angles) = (Vec::new(), Vec::new(), Vec::new());
    for preset in library::robots() {
        let (ours, theirs) = (robot(&preset), peer(&preset));
        for _ in 0..150 {
            let q = any_joints(&mut random);
            let tcp = forward::forward(&ours, &q);
            let joints: [f64; 6] = q.into();
            let other = pose_of(&theirs.forward(&joints));
            places.push((tcp.position - other.position).norm());
            turns.push((tcp.rotation - other.rotation).norm());

            let solutions = inverse::inverse(&ours, &tcp, &Joints::zeros()).unwrap();
            let margin = solutions
                .iter()
                .map(|s| s.margin.elbow.min(s.margin.wrist).min(s.margin.shoulder))
                .fold(f64::INFINITY, f64::min);
            // Near a singularity both are right about the pose but differ in the angles.
            if margin < 0.05 {
                continue;
            }
            for solution in theirs.inverse(&theirs.forward(&joints)) {
                let apart = |s: &inverse::Solution| {
                    let turn = |d: f64| (d - TAU * (d / TAU).round()).abs();
                    (s.q - Joints::from(solution)).iter().map(|d| turn(*d)).fold(0.0, f64::max)
                };
                angles.push(solutions.iter().map(apart).fold(f64::INFINITY, f64::min));
            }
        }
    }
    let count = angles.len();
    let [places, turns, angles] = [places, turns, angles].map(quantiles);
    println!("q75, q99, max: position {places:?} m, rotation {turns:?}, {count} solutions {angles:?} rad");
    assert!(count > 20_000, "{count} solutions were compared");
    // Both are double precision over 3 m: rounding. Up to 0.05 from a singularity the errors of
    // angles are twenty times those of the pose, and of their sums more.
    assert!(places[2] < 1e-14 && turns[2] < 1e-14);
    assert!(angles[0] < 1e-14 && angles[1] < 1e-13 && angles[2] < 1e-11, "{angles:?}");
}

#[test]
fn any_parameters_mean_what_another_author_takes_them_for() {
    let mut random = fastrand::Rng::with_seed(44);
    let any = library::robots().next().unwrap();
    for _ in 0..300 {
        let mut numbers = |size: f64| [0; 7].map(|_| between(&mut random, -size, size));
        let (lengths_mm, [o1, o2, o3, o4, o5, o6, _], signs) = (numbers(900.0), numbers(180.0), numbers(1.0));
        let [s1, s2, s3, s4, s5, s6, _] = signs.map(f64::signum);
        let joint_offset_deg = [o1, o2, o3, o4, o5, o6];
        let opw = Opw { lengths_mm, joint_sign: [s1, s2, s3, s4, s5, s6], joint_offset_deg };
        let preset = library::Preset { opw, joint_limits_deg: None, ..any.clone() };
        let q = any_joints(&mut random);
        let (ours, theirs) =
            (forward::forward(&robot(&preset), &q), pose_of(&peer(&preset).forward(&q.into())));
        // Rounding of a few dozen products of metres.
        assert!((ours.position - theirs.position).norm() < 1e-14, "{preset:?}");
        assert!((ours.rotation - theirs.rotation).norm() < 1e-14, "{preset:?}");
    }
}

#[test]
fn out_of_reach_the_nearer_shoulder_tells_its_distance() {
    let mut random = fastrand::Rng::with_seed(45);
    let (mut near, mut far) = (0, 0);
    for preset in library::robots() {
        let robot = robot(&preset);
        let [a1, a2, b, c1, c2, c3, c4] = preset.opw.lengths_mm.map(|length| length * 1e-3);
        let (least, most) = ((c2 - a2.hypot(c3)).abs(), c2 + a2.hypot(c3));
        for _ in 0..400 {
            let size = if random.bool() { 0.7 } else { 2.0 * most };
            let wrist = Vector3::new(0.0, 0.0, c1) + any_vector(&mut random, size);
            let beside = wrist.x * wrist.x + wrist.y * wrist.y - b * b;
            if beside <= 1e-6 {
                continue;
            }
            let off = |ahead: f64| (ahead - a1).hypot(wrist.z - c1);
            let miss = |d: f64| (d - most).max(least - d);
            let shoulders = [off(beside.sqrt()), off(-beside.sqrt())];
            let nearest = if miss(shoulders[1]) < miss(shoulders[0]) { shoulders[1] } else { shoulders[0] };
            // The flange points down, the wrist centre is above it.
            let rotation = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
            let tcp = Pose { rotation, position: wrist - Vector3::z() * c4 };
            let found = inverse::inverse(&robot, &tcp, &Joints::zeros());
            if miss(nearest) < -1e-9 {
                assert!(found.is_ok(), "{} reaches {wrist}", preset.id);
            } else if miss(nearest) > 1e-9 {
                let Err(Error::Unreachable { distance, reach_min, reach_max, .. }) = found else {
                    panic!("{wrist}")
                };
                assert!((distance - nearest).abs() < 1e-12, "{}: {distance} instead of {nearest}", preset.id);
                assert!((reach_min - least).abs() < 1e-12 && (reach_max - most).abs() < 1e-12);
                if nearest < least { near += 1 } else { far += 1 }
            }
        }
    }
    assert!(near > 100 && far > 1000, "{near} too near, {far} too far");
}

/// C_x = J C_theta J^T (eq. 3.48), with the Jacobian from differences of the other author's forward
/// model.
#[test]
fn jacobian_and_compliance_agree_with_differences_of_another_authors_poses() {
    let mut random = fastrand::Rng::with_seed(43);
    let (mut jacobians, mut compliances) = (Vec::new(), Vec::new());
    let h = 1e-4;
    for preset in library::robots() {
        let (ours, theirs) = (robot(&preset), peer(&preset));
        for _ in 0..60 {
            let q = any_joints(&mut random);
            let pose = |i: usize, step: f64| {
                let mut q: [f64; 6] = q.into();
                q[i] += step;
                pose_of(&theirs.forward(&q))
            };
            let columns: [Vector6<f64>; 6] = std::array::from_fn(|i| {
                // Four points: the error is of the fourth power of the step.
                let difference = |f: &dyn Fn(&Pose) -> Vector3<f64>| {
                    let at = |part: f64| f(&pose(i, part * h));
                    ((at(1.0) - at(-1.0)) * 8.0 - (at(2.0) - at(-2.0))) / (12.0 * h)
                };
                let here = pose(i, 0.0);
                let way = difference(&|pose| pose.position);
                let axis = |k: usize| here.rotation.column(k).into_owned();
                let turned =
                    |k: usize| axis(k).cross(&difference(&|pose| pose.rotation.column(k).into_owned()));
                let turn = (turned(0) + turned(1) + turned(2)) / 2.0;
                Vector6::new(way.x, way.y, way.z, turn.x, turn.y, turn.z)
            });
            let j = Matrix6::from_columns(&columns);
            jacobians.push((jacobian::jacobian(&ours, &q) - j).norm() / j.norm());
            let c = j * Matrix6::from_diagonal(&preset.joint_compliance.into()) * j.transpose();
            compliances.push((compliance::cartesian_compliance(&ours, &q) - c).norm() / c.norm());
        }
    }
    let count = jacobians.len();
    let [jacobians, compliances] = [jacobians, compliances].map(quantiles);
    println!("q75, q99, max of {count}: Jacobian {jacobians:?}, compliance {compliances:?}, relative");
    assert!(count > 4000);
    // Rounding of poses over the step, 4e-16 * 3 m / 1e-4, is a few 1e-12 of a lever arm; the
    // step's fourth power is less.
    for [q75, q99, max] in [jacobians, compliances] {
        assert!(q75 < 1e-11 && q99 < 2e-11 && max < 1e-10, "{q75}, {q99}, {max}");
    }
}

#[test]
fn the_rule_for_unknown_stiffness_follows_from_the_published_sets() {
    let sets: Vec<_> = library::published().collect();
    assert_eq!(sets.len(), 8);
    // ln k = ln K_i + p ln(payload / 200 kg): for given p, ln K_i is a mean; p by the smallest sum
    // of squares.
    let fit = |p: f64| {
        let logs = |i: usize| -> Vec<f64> {
            let of = |set: &library::Published| {
                set.measured[i]
                    .then(|| -set.compliance[i].unwrap().ln() - p * (set.payload / RULE_PAYLOAD).ln())
            };
            sets.iter().filter_map(of).collect()
        };
        let means: [f64; 6] = std::array::from_fn(|i| logs(i).iter().sum::<f64>() / logs(i).len() as f64);
        let rest: Vec<f64> = (0..6).flat_map(|i| logs(i).into_iter().map(move |l| l - means[i])).collect();
        (means.map(f64::exp), rest)
    };
    let squares = |p: f64| fit(p).1.iter().map(|r| r * r).sum::<f64>();
    let best =
        (0..1500).map(|p| f64::from(p) / 1000.0).min_by(|a, b| squares(*a).total_cmp(&squares(*b))).unwrap();
    assert!((best - 0.259).abs() < 0.001, "best exponent {best}");
    let (stiffness, rest) = fit(0.25);
    for (rule, fitted) in RULE_STIFFNESS.iter().zip(stiffness) {
        assert!((rule / fitted - 1.0).abs() < 0.03, "two digits: {rule} against {fitted}");
    }
    let deviation = (rest.iter().map(|r| r * r).sum::<f64>() / (rest.len() - 7) as f64).sqrt().exp();
    let worst = rest.iter().fold(0.0_f64, |a, b| a.max(b.abs())).exp();
    assert!((1.9..2.1).contains(&deviation) && (8.0..9.0).contains(&worst), "{deviation}, {worst}");
    // The table's values inverted, to one digit: a sixteenth of the payload has twice the compliance.
    assert_eq!(library::assumed_compliance(200.0), [4e-7, 3e-7, 5e-7, 2e-6, 3e-6, 3e-6]);
    assert_eq!(library::assumed_compliance(12.5), [8e-7, 6e-7, 9e-7, 5e-6, 6e-6, 5e-6]);
}

/// The IRB 6700's shared castings: 2.85 m of reach is the arm of 2.60 m with 250 mm more forearm.
#[test]
fn the_irb_6700_has_one_upper_arm_and_two_forearms() {
    let lengths = |id: &str| library::robot(id).unwrap().opw.lengths_mm;
    let mut short = lengths("abb-irb-6700-200-260");
    short[5] += 250.0;
    assert_eq!(lengths("abb-irb-6700-155-285"), short);
}

/// The URDF of Huynh's arm, its joint origins added up [mm], and his springs about the joint axes,
/// both as quoted in the source of the row.
#[test]
fn the_tx200_is_the_arm_that_its_springs_were_identified_on() {
    let preset = library::robot("staubli-tx200").unwrap();
    let [a1, b, c1, c2, c3, c4] =
        [250.0, 235.0 + 44.0 - 279.0, 344.0 + 298.0, 950.0, 179.0 + 621.0, 177.0 + 17.0];
    assert_eq!(preset.opw.lengths_mm, [a1, 0.0, b, c1, c2, c3, c4]);
    for (compliance, k) in preset.joint_compliance.iter().zip([2.3e6, 8.6e6, 2.8e6, 3.0e6, 0.2e6, 0.9e6]) {
        // The library keeps four digits.
        assert!((compliance * k - 1.0).abs() < 5e-4, "{compliance} for {k}");
    }
    assert!(!preset.stiffness_assumed && preset.mode_note.contains("8.77 Hz"));
    let kr500 = library::robot("kuka-kr-500-3-mt").unwrap();
    assert!(kr500.stiffness_note.contains("COROUSSO"), "{}", kr500.stiffness_note);
}

#[test]
fn assumed_stiffness_is_remarked_and_ones_own_is_not() {
    let path = json!({"kind":"line","from_mm":[1600,-200,800],"to_mm":[1600,200,800]});
    let codes = |robot: serde_json::Value| {
        let report = run(&[("robot", robot), ("path", path.clone())]);
        let remarked = report.warnings.iter().any(|warning| warning.code == "stiffness-assumed");
        (remarked, report.summary().stiffness)
    };
    let (remarked, note) = codes(json!({"preset":"kuka-kr-210-r2700-2"}));
    assert!(remarked && note.contains("order of magnitude"), "{note}");
    let (remarked, note) = codes(json!({"preset":"kuka-kr-500-3-mt"}));
    assert!(!remarked && note.contains("COROUSSO"), "{note}");
    let own =
        json!({"preset":"kuka-kr-210-r2700-2","joint_compliance_rad_per_nm":[1e-6,1e-6,1e-6,1e-6,1e-6,1e-6]});
    assert_eq!(codes(own), (false, "Joint stiffness: as given in the job.".into()));
}

#[test]
fn every_robot_mills_a_line_in_front_of_it() {
    for preset in library::robots() {
        let reach = robot(&preset).reach().1 * 1e3;
        let x = preset.opw.lengths_mm[0] + 0.65 * reach;
        let z = preset.opw.lengths_mm[3] - 0.2 * reach;
        let report = run(&[
            ("robot", json!({ "preset": preset.id })),
            ("path", json!({"kind":"line","from_mm":[x,-50,z],"to_mm":[x,50,z]})),
            // The force sets in faster than the default job's slow shaper could follow.
            ("shaper", json!("none")),
        ]);
        assert!(report.compensation.converged, "{}: {:?}", preset.id, report.warnings);
        let limits = report.warnings.iter().filter(|warning| warning.code == "joint-limit").count();
        assert_eq!(limits, 0, "{}: {:?}", preset.id, report.warnings);
    }
}

#[test]
fn a_path_out_of_reach_is_placed_where_the_robot_mills_it() {
    for (robot, base) in [
        (json!({"preset":"abb-irb-6640-235-255"}), json!({"xyz_mm":[0,0,0],"rpy_deg":[0,0,0]})),
        (json!({"preset":"kuka-kr-60-ha"}), json!({"xyz_mm":[500,-300,200],"rpy_deg":[0,0,40]})),
        (json!({"preset":"staubli-rx90"}), json!({"xyz_mm":[0,0,0],"rpy_deg":[0,0,0]})),
    ] {
        let far = [
            ("robot", robot),
            ("base_frame", base),
            ("path", json!({"kind":"rectangle","center_mm":[5000,0,0],"width_mm":200,"height_mm":150})),
        ];
        assert_eq!(common::refused(&far).code(), "unreachable");
        let job = armill::Job::from_json(&common::job_text(&far)).unwrap();
        let place = armill::placement::in_front(&job).unwrap();
        let mut near = far.to_vec();
        near.push(("workpiece_frame", json!({"xyz_mm":place,"rpy_deg":[0,0,0]})));
        let report = run(&near);
        let remarks: Vec<_> = report.warnings.iter().map(|warning| warning.code).collect();
        assert!(
            !remarks.iter().any(|code| code.starts_with("joint-limit") || code.starts_with("singularity")),
            "{remarks:?}"
        );
    }
    let wide = [("path", json!({"kind":"line","from_mm":[-3000,0,0],"to_mm":[3000,0,0]}))];
    let error =
        armill::placement::in_front(&armill::Job::from_json(&common::job_text(&wide)).unwrap()).unwrap_err();
    assert_eq!(error.field(), Some("workpiece_frame.xyz_mm"));
    assert!(error.to_string().contains("6000 x 0 x 0 mm"), "{error}");
}
