//! The cell: tool, base and workpiece frames with their orientation, checked through every stage by
//! a second kinematic model written here with quaternions and plain DH steps.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]

use crate::common::{column, run};
use armill::Report;
use armill::export::ExportOptions;
use armill::verification::export;
use nalgebra::Vector3;
use serde_json::{Value, json};

/// A rotation as a quaternion w, x, y, z and a translation [mm].
#[derive(Clone, Copy)]
struct Placed {
    turn: [f64; 4],
    at: Vector3<f64>,
}

fn times([a, b, c, d]: [f64; 4], [e, f, g, h]: [f64; 4]) -> [f64; 4] {
    [
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    ]
}

/// Rotation by an angle [deg] about an axis of the frame: 0, 1, 2.
fn about(axis: usize, deg: f64) -> [f64; 4] {
    let half = deg.to_radians() / 2.0;
    let mut q = [half.cos(), 0.0, 0.0, 0.0];
    q[axis + 1] = half.sin();
    q
}

fn turned(q: [f64; 4], v: Vector3<f64>) -> Vector3<f64> {
    let [w, x, y, z] = q;
    let r = times(times(q, [0.0, v.x, v.y, v.z]), [w, -x, -y, -z]);
    Vector3::new(r[1], r[2], r[3])
}

impl Placed {
    fn then(self, inner: Placed) -> Placed {
        Placed { turn: times(self.turn, inner.turn), at: self.at + turned(self.turn, inner.at) }
    }

    /// A frame of a job: rotations about the fixed axes x, y, z in this order, so that z is the
    /// outermost.
    fn of(xyz: [f64; 3], [roll, pitch, yaw]: [f64; 3]) -> Placed {
        let turn = times(about(2, yaw), times(about(1, pitch), about(0, roll)));
        Placed { turn, at: Vector3::from(xyz) }
    }

    fn back(self) -> Placed {
        let [w, x, y, z] = self.turn;
        let turn = [w, -x, -y, -z];
        Placed { turn, at: -turned(turn, self.at) }
    }

    /// Roll, pitch and yaw [deg], computed from the rotated axes.
    fn rpy(self) -> [f64; 3] {
        let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()].map(|v| turned(self.turn, v));
        [y.z.atan2(z.z), (-x.z).asin(), x.y.atan2(x.x)].map(f64::to_degrees)
    }
}

/// The RX-90's flange in the base for joint angles [deg], and each joint's frame (thesis Table
/// 3.1).
fn flange(q: &[f64]) -> Vec<Placed> {
    let rows = [
        (0.0, 0.0, 420.0, 0.0),
        (-90.0, 0.0, 0.0, -90.0),
        (0.0, 450.0, 0.0, 90.0),
        (90.0, 0.0, 650.0, 0.0),
        (-90.0, 0.0, 0.0, 0.0),
        (90.0, 0.0, 85.0, 0.0),
    ];
    let mut at = Placed { turn: [1.0, 0.0, 0.0, 0.0], at: Vector3::zeros() };
    let step = |((alpha, a, d, offset), q): ((f64, f64, f64, f64), &f64)| {
        let twist = Placed { turn: about(0, alpha), at: Vector3::new(a, 0.0, 0.0) };
        let joint = Placed { turn: about(2, q + offset), at: Vector3::new(0.0, 0.0, d) };
        at = at.then(twist).then(joint);
        at
    };
    rows.into_iter().zip(q).map(step).collect()
}

const TOOL: ([f64; 3], [f64; 3]) = ([60.0, -25.0, 140.0], [0.0, 45.0, 20.0]);
const BASE: ([f64; 3], [f64; 3]) = ([-400.0, 250.0, 700.0], [10.0, -15.0, 120.0]);
const PART: ([f64; 3], [f64; 3]) = ([-650.0, 720.0, 900.0], [25.0, 5.0, -50.0]);

fn frame((xyz, rpy): ([f64; 3], [f64; 3])) -> Value {
    json!({"xyz_mm": xyz, "rpy_deg": rpy})
}

/// A spindle at 45 deg on the flange, a base rotated on its plinth, a tilted part; a short tilted
/// arc.
fn angled(changes: &[(&str, Value)]) -> Report {
    let arc = json!({"kind":"arc","center_mm":[0,0,0],"radius_mm":60,"normal":[0.1,0,1],"start_deg":20,"sweep_deg":120});
    let mut all = vec![
        ("path", arc),
        ("tool_frame", frame(TOOL)),
        ("base_frame", frame(BASE)),
        ("workpiece_frame", frame(PART)),
        ("motion.sample_time_s", json!(0.01)),
    ];
    all.extend(changes.iter().cloned());
    run(&all)
}

/// Three columns as vectors.
fn vectors(report: &Report, key: &str, unit: &str) -> Vec<Vector3<f64>> {
    let [x, y, z] = ["x", "y", "z"].map(|axis| column(report, &format!("{key}_{axis}_{unit}")));
    x.iter().zip(&y).zip(&z).map(|((x, y), z)| Vector3::new(*x, *y, *z)).collect()
}

fn joints(report: &Report, key: &str) -> Vec<[f64; 6]> {
    let all: [Vec<f64>; 6] = std::array::from_fn(|i| column(report, &format!("{key}{}_deg", i + 1)));
    (0..report.samples()).map(|k| std::array::from_fn(|i| all[i][k])).collect()
}

/// The part in the robot's base.
fn part_in_base() -> Placed {
    Placed::of(BASE.0, BASE.1).back().then(Placed::of(PART.0, PART.1))
}

#[test]
fn joint_commands_put_an_angled_spindle_on_a_tilted_part() {
    let report = angled(&[]);
    let (tool, part) = (Placed::of(TOOL.0, TOOL.1), part_in_base());
    let desired = vectors(&report, "desired", "mm");
    // The arc about its normal, starting at +X projected onto its plane (DESIGN section 4), in the
    // part.
    let normal = Vector3::new(0.1, 0.0, 1.0).normalize();
    let x = (Vector3::x() - normal * normal.x).normalize();
    let y = normal.cross(&x);
    for ((q, desired), s) in joints(&report, "q").iter().zip(&desired).zip(column(&report, "arc_length_mm")) {
        let tcp = flange(q)[5].then(tool);
        let angle = 20_f64.to_radians() + s / 60.0;
        let on_part = x * (60.0 * angle.cos()) + y * (60.0 * angle.sin());
        // Fractions of a micrometre: two kinematic models in double precision over metres.
        assert!((tcp.at - desired).norm() < 1e-6, "the tip is where the path is");
        assert!((part.at + turned(part.turn, on_part) - desired).norm() < 1e-6, "the path is on the part");
        let [tcp_x, tcp_z] = [Vector3::x(), Vector3::z()].map(|v| turned(tcp.turn, v));
        // The tool stands upright on the part; its x axis is the part's.
        assert!((tcp_z + turned(part.turn, Vector3::z())).norm() < 1e-9);
        assert!((tcp_x - turned(part.turn, Vector3::x())).norm() < 1e-9);
    }
}

#[test]
fn force_turns_with_the_part_and_bends_the_arm_at_the_tip() {
    let report = angled(&[("shaper", json!("none"))]);
    let (tool, part) = (Placed::of(TOOL.0, TOOL.1), part_in_base());
    let up = turned(part.turn, Vector3::z());
    let mean = report.mean_force();
    let desired = vectors(&report, "desired", "mm");
    let (force, moved) = (vectors(&report, "force", "n"), vectors(&report, "deflection", "mm"));
    let actual = vectors(&report, "actual", "mm");
    let q = joints(&report, "q");
    let compliance = [9.03e-7, 11.17e-7, 14.74e-7, 27.65e-7, 97.58e-7, 0.0];
    for k in 10..report.samples() - 10 {
        let feed = desired[k + 1] - desired[k - 1];
        let Some(x) = (feed - up * up.dot(&feed)).try_normalize(1e-6) else { continue };
        // This material has no edge force, so the force keeps its direction while it grows with speed
        // and run-in; its size has tests of its own.
        let expected = (x * mean.x + up.cross(&x) * mean.y + up * mean.z) * (force[k].norm() / mean.norm());
        // The chord of three samples is parallel to the tangent, except for the change of speed
        // between them.
        assert!((force[k] - expected).norm() < 2e-3 * mean.norm(), "sample {k}");
        // Eqs. 3.41 to 3.47 by differences: the torque about each joint, its turn, and the
        // resulting motion of the tip.
        let tip = |i: usize, deg: f64| {
            let mut q = q[k];
            q[i] += deg;
            flange(&q)[5].then(tool).at
        };
        let bent: Vector3<f64> = (0..6)
            .map(|i| {
                let per_rad = (tip(i, 0.01) - tip(i, -0.01)) / 0.02_f64.to_radians();
                let torque = per_rad.dot(&force[k]) * 1e-3;
                per_rad * (compliance[i] * torque)
            })
            .sum();
        // Central differences over 0.01 deg: relative error about 1e-8.
        assert!((bent - moved[k]).norm() <= 1e-6 * moved[k].norm(), "sample {k}: {bent} and {}", moved[k]);
        assert!((actual[k] - desired[k] - moved[k]).norm() < 1e-6, "sample {k}");
    }
}

#[test]
fn only_where_the_part_is_from_the_base_matters() {
    let report = angled(&[]);
    let part = part_in_base();
    let zero = ([0.0; 3], [0.0; 3]);
    let same =
        angled(&[("base_frame", frame(zero)), ("workpiece_frame", frame((part.at.into(), part.rpy())))]);
    // Base and part moved together through the cell.
    let far = Placed::of([5000.0, -300.0, 90.0], [170.0, 30.0, -80.0]);
    let [base, moved] = [BASE, PART].map(|(xyz, rpy)| far.then(Placed::of(xyz, rpy)));
    let elsewhere = angled(&[
        ("base_frame", frame((base.at.into(), base.rpy()))),
        ("workpiece_frame", frame((moved.at.into(), moved.rpy()))),
    ]);
    for other in [same, elsewhere] {
        for (ours, theirs) in report.columns().iter().zip(other.columns()) {
            let apart =
                ours.values.iter().zip(&theirs.values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-6, "{} differs by {apart}", ours.key);
        }
    }
}

/// The numbers of a KRL aggregate `{... X 1,Y 2,Z 3,A 4,B 5,C 6}` as a frame: A, B, C about z, the
/// new y, the new x.
fn krl(line: &str) -> Placed {
    let inside = line.split_once('{').unwrap().1.trim_end_matches('}').replace("FRAME: ", "");
    let v: Vec<f64> =
        inside.split(',').map(|part| part.split_once(' ').unwrap().1.parse().unwrap()).collect();
    Placed::of([v[0], v[1], v[2]], [v[5], v[4], v[3]])
}

#[test]
fn a_robot_program_holds_frames_that_lead_back_to_the_joints() {
    // Without compensation the program commands the path itself.
    let report = angled(&[("compensation.max_passes", json!(0))]);
    let text = export(&report, "krl", &ExportOptions::default()).unwrap().text;
    let line = |start: &str| text.lines().find(|line| line.starts_with(start)).unwrap();
    // The frames count from axis 2 of the RX-90, 420 mm above its foot.
    let world = Placed::of([0.0, 0.0, 420.0], [0.0; 3]);
    let (base, tool) = (world.then(krl(line("BASE_DATA[1]="))), krl(line("TOOL_DATA[1]=")));
    let arrives = |line: &str, q: &[f64; 6]| {
        let tcp = base.then(krl(line));
        let arm = flange(q)[5].then(tool);
        // Output has five decimals of a millimetre and six of a degree.
        assert!((tcp.at - arm.at).norm() < 2e-5, "{} and {}", tcp.at, arm.at);
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            assert!((turned(tcp.turn, axis) - turned(arm.turn, axis)).norm() < 1e-7);
        }
    };
    let q = joints(&report, "q");
    // The first move is by axes, to the same point as stated in the base.
    let axes = line("PTP {A1").trim_start_matches("PTP {").trim_end_matches('}');
    let axes: Vec<f64> =
        axes.split(',').map(|part| part.split_once(' ').unwrap().1.parse().unwrap()).collect();
    assert!(axes.iter().zip(q[0]).all(|(axis, q)| (axis - q).abs() < 1e-5), "{axes:?} and {:?}", q[0]);
    arrives(line("; In the base that is").split(",S ").next().unwrap(), &q[0]);
    arrives(text.lines().rfind(|line| line.starts_with("LIN {")).unwrap(), &q[q.len() - 1]);
    assert!(
        text.contains("foot of the arm in the cell at x -400.0 y 250.0 z 700.0 mm"),
        "the header states the base"
    );
}
