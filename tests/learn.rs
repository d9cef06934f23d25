//! What a measured pass teaches, on plants whose truth is known.

use crate::common::{between, job_text, refused, run};
use armill::cutting::{Coefficients, Cut, Engagement, Hand, PartForces};
use armill::job::Sources;
use armill::learn::alignment::{Alignment, ComparedBy, Sampled};
use armill::learn::factors::estimate;
use armill::learn::log::Clock;
use armill::learn::next_pass::learned;
use armill::learn::{
    Commanded, LearnSummary, LearnedCorrection, LearningGain, Log, MeasuredPass, NextPass, PassOptions,
    dynamometer, low_pass,
};
use armill::math::{PI, TAU, cos, exp, ln, sin};
use armill::robot::{Joints, forward};
use armill::uncertainty::draw::{deviates, normal};
use armill::uncertainty::place::places;
use armill::uncertainty::{Draw, Quantiles};
use armill::units::{DEG, MM, N_PER_MM, N_PER_MM2};
use armill::{Error, Job, Progress, Report};
use nalgebra::{SMatrix, Vector3};
use serde_json::{Value, json};

const NEVER: Commanded = Commanded { corrected: true, learned: vec![] };
const DESIRED: Commanded = Commanded { corrected: false, learned: vec![] };

fn options(commanded: Commanded) -> PassOptions {
    PassOptions { commanded, frame: None, shift: None, corner: None }
}

/// The default circle in front of the arm, 10 ms apart: the base frame is not the workpiece's.
fn placed(changes: &[(&str, Value)]) -> Report {
    let own = [
        ("motion.sample_time_s", json!(0.01)),
        ("workpiece_frame", json!({"xyz_mm": [700, 50, 300], "rpy_deg": [0, 0, 30]})),
        ("path", json!({"kind":"circle","center_mm":[0,0,0],"radius_mm":150,"normal":[0.2,0.3,0.9]})),
    ];
    run(&own.iter().chain(changes).cloned().collect::<Vec<_>>())
}

/// Where a plant takes the tip at every `stride`-th sample of commands [m].
fn tips(report: &Report, q: &[Joints], draw: &Draw, stride: usize) -> (Vec<f64>, Vec<Vector3<f64>>) {
    let plan = &report.plan;
    let timing = plan.timing(Sources::ALL);
    let parts = PartForces::of(&plan.setup.cut, plan.setup.contacts.as_ref());
    let at: Vec<usize> = (0..report.samples()).step_by(stride).collect();
    let drawn = places(plan, (&timing, &parts), (q, &at), 0.0);
    let times = at.iter().map(|k| *k as f64 * plan.trajectory.sample_time).collect();
    (times, drawn.iter().map(|place| place.tip(plan, draw)).collect())
}

/// A log of positions in the base frame [m], with noise [m], a row each `stride` samples, the run beginning `delay` [s]
/// after the first row.
fn position_log(
    report: &Report,
    q: &[Joints],
    draw: &Draw,
    (stride, noise, delay): (usize, f64, f64),
    seed: u64,
) -> Log {
    let mut random = fastrand::Rng::with_seed(seed);
    let (times, tips) = tips(report, q, draw, stride);
    let noisy = |tip: &Vector3<f64>| tip + Vector3::from_fn(|_, _| noise * normal(&mut random));
    let values: Vec<_> = tips.iter().map(noisy).map(Some).collect();
    let step = times[1];
    // The arm waits at the start.
    let waits = (delay / step).round() as usize;
    let rest = std::iter::repeat_n(values[0], waits).chain(values.iter().copied());
    let at = (0..waits + values.len()).map(|k| 17.0 + step * k as f64).collect();
    log_of(Clock::Time(at), Some((rest.collect(), Some(1.0))), None, None)
}

type Rows = Vec<Option<Vector3<f64>>>;

fn log_of(
    clock: Clock,
    position: Option<(Rows, Option<f64>)>,
    deviation: Option<(Rows, bool)>,
    force: Option<Rows>,
) -> Log {
    let rows = match &clock {
        Clock::Time(at) | Clock::Length(at) => at.len(),
        Clock::None => position.as_ref().map_or(0, |(rows, _)| rows.len()),
    };
    let (normal, motor, load) = (None, None, None);
    Log { clock, clock_is_stated: true, position, normal, deviation, force, motor, load, rows }
}

fn softer(factor: f64, cutting: f64) -> Draw {
    Draw { compliance: [factor; 6], force: [cutting; 3], frequency: 1.0 }
}

/// |1 - a g| of an error is left after each pass: 30, 9 and 3 % with a = 0.7 where a correction moves the tip as it is
/// commanded, 51, 26 and 13 % where by 0.7 times as much. With a shaper its inverse is not exact, but the error is slow.
#[test]
fn passes_leave_what_they_should() {
    for (shaper, slack) in
        [(json!("none"), 1e-9), (json!({"kind":"zvd","frequency_rad_s":18,"damping":0.1}), 0.01)]
    {
        let report = placed(&[("shaper", shaper)]);
        let step = report.plan.trajectory.sample_time;
        let count = report.samples();
        let window = |k: usize| sin(PI * k as f64 / count as f64).powi(2);
        let wave = |k: usize| cos(TAU * 3.0 * k as f64 / count as f64);
        let error = |k: usize| Vector3::new(wave(k), 0.5, 1.0 - wave(k)) * (0.2 * MM * window(k));
        let first: Vec<Vector3<f64>> = (0..count).map(error).collect();
        let size = |v: &[Vector3<f64>]| v.iter().map(Vector3::norm_squared).sum::<f64>().sqrt();
        let gain = LearningGain::new(0.7).unwrap();
        for (g, left) in [(1.0, [30.0, 9.0, 3.0]), (0.7, [51.0, 26.0, 13.0]), (1.4, [2.0, 0.0, 0.0])] {
            let (mut taught, mut now) = (vec![Vector3::zeros(); count], first.clone());
            for (pass, percent) in left.into_iter().enumerate() {
                taught = learned(&report, (&taught, &now), gain, 0.0);
                let moved = report.plan.shaper().apply(&taught, step);
                now = first.iter().zip(&moved).map(|(error, moved)| error + moved * g).collect();
                let rest = 100.0 * size(&now) / size(&first);
                // The tables print whole percents.
                assert!((rest - percent).abs() < 0.5 + 100.0 * slack, "g {g}, pass {}: {rest}", pass + 1);
                let exact = 100.0 * gain.left(g).powi(pass as i32 + 1);
                assert!((rest - exact).abs() < 100.0 * slack, "{rest} and {exact}");
            }
        }
    }
}

/// White noise of every pass leaves a g sd(n) / sqrt(1 - (1 - a g)^2) in the end.
#[test]
fn noise_has_its_floor() {
    let report = placed(&[("shaper", json!("none"))]);
    let count = report.samples();
    let mut random = fastrand::Rng::with_seed(5);
    for (a, g) in [(0.7, 1.0), (0.7, 0.7), (0.3, 1.0), (1.0, 1.0)] {
        let gain = LearningGain::new(a).unwrap();
        let mut taught = vec![Vector3::zeros(); count];
        let (mut sum, mut counted) = (0.0, 0);
        for pass in 0..40 {
            let read: Vec<Vector3<f64>> = taught
                .iter()
                .map(|v| v * g + Vector3::from_fn(|_, _| 0.01 * MM * normal(&mut random)))
                .collect();
            taught = learned(&report, (&taught, &read), gain, 0.0);
            if pass >= 20 {
                sum += taught[..count / 2].iter().map(|v| (v * g).norm_squared()).sum::<f64>();
                counted += 3 * (count / 2);
            }
        }
        let ratio = (sum / counted as f64).sqrt() / (0.01 * MM) / gain.noise_floor(g);
        assert!((ratio - 1.0).abs() < 0.03, "a {a}, g {g}: {ratio}");
    }
}

/// The low pass passes 1 / sqrt(2) of a swing at its corner, all of a slow one, and does not delay.
#[test]
fn the_low_pass_is_what_its_corner_says() {
    let step = 0.002;
    for (frequency, share) in [(5.0, 0.5_f64.sqrt()), (0.2, 1.0), (10.0, 0.25), (20.0, 1.0 / 256.0)] {
        let at = |k: usize| TAU * frequency * step * k as f64;
        let swing: Vec<_> = (0..5000).map(|k| Some(Vector3::new(cos(at(k)), sin(at(k)), 0.0))).collect();
        let passed = low_pass::smoothed(&swing, low_pass::width(5.0) / step);
        for k in 1000..4000 {
            let wanted = swing[k].unwrap() * share;
            assert!((passed[k].unwrap() - wanted).norm() < 2e-3, "{frequency} Hz");
        }
    }
    let mut random = fastrand::Rng::with_seed(3);
    let noise: Vec<_> = (0..200_000).map(|_| Some(Vector3::new(normal(&mut random), 0.0, 0.0))).collect();
    let passed = low_pass::smoothed(&noise, low_pass::width(5.0) / step);
    let left = (passed.iter().flatten().map(|v| v.x * v.x).sum::<f64>() / passed.len() as f64).sqrt();
    assert!((left / low_pass::noise_left(5.0, step) - 1.0).abs() < 0.03, "{left}");
    // A gap within the kernel is bridged, a wide one stays.
    let mut gaps: Vec<_> = vec![Some(Vector3::x()); 1000];
    gaps[100..110].fill(None);
    gaps[400..900].fill(None);
    let passed = low_pass::smoothed(&gaps, 10.0);
    assert_eq!(passed[105], Some(Vector3::x()));
    assert_eq!(passed[600], None);
}

/// A softer arm on a harder material, measured in the frame of the workpiece or the base, in unstated units, from 1.3 s
/// before the run: frame, unit and delay are found, and what is read is what the plant left.
#[test]
fn a_log_finds_its_place() {
    let report = placed(&[]);
    let draw = softer(1.3, 1.1);
    let truth = tips(&report, &report.q, &draw, 1).1;
    let log = position_log(&report, &report.q, &draw, (2, 0.002 * MM, 1.3), 1);
    let into = report.setup().workpiece.inverse();
    let (rows, _) = log.position.clone().unwrap();
    let in_workpiece = rows.iter().map(|v| v.map(|v| into.point(&v) / MM)).collect();
    for (position, frame) in [((rows, Some(1.0)), "base"), ((in_workpiece, None), "workpiece")] {
        let log = Log { position: Some(position), ..log.clone() };
        let measured = MeasuredPass::of(&report, &log, &options(DESIRED)).unwrap();
        assert_eq!(measured.frame, frame);
        let alignment = measured.alignment.unwrap();
        assert!((alignment.shift - 1.3).abs() < 0.004, "{}", alignment.shift);
        assert!(!alignment.is_doubtful() && measured.covered > 0.99);
        assert!((1.2..2.2).contains(&(measured.noise / (0.001 * MM))), "{}", measured.noise / MM);
        for (k, error) in measured.smooth.iter().enumerate().skip(100).take(report.samples() - 200) {
            let off = truth[k]
                - report
                    .plan
                    .path
                    .closest(&truth[k], report.plan.trajectory.timing.arc_length[k], 0.05)
                    .point;
            assert!((error.unwrap() - off).norm() < 0.02 * MM, "{k}: {} {}", error.unwrap() / MM, off / MM);
        }
    }
    // A wrong delay is noticed, and said.
    let wrong = PassOptions { shift: Some(0.8), ..options(DESIRED) };
    let measured = MeasuredPass::of(&report, &log, &wrong).unwrap();
    assert!(measured.alignment.unwrap().is_doubtful());
    let said = measured.said.odd.iter().find(|remark| remark.contains("alignment looks wrong")).unwrap();
    assert!(said.contains("0.800 s") && (said.contains("1.299") || said.contains("1.300")), "{said}");
    // Another part of the cell is refused, with how far off it is.
    let far = log.position.as_ref().map(|(rows, unit)| {
        (rows.iter().map(|v| v.map(|v| v + Vector3::new(0.0, 0.0, 2.0))).collect(), *unit)
    });
    let refused = MeasuredPass::of(&report, &Log { position: far, ..log }, &options(DESIRED)).unwrap_err();
    assert!(refused.to_string().contains("mm off it at best"), "{refused}");
}

/// Arc lengths of a log are those of the path, even where nothing in it says so; another run's positions are noticed.
#[test]
fn arc_lengths_count_from_the_beginning_of_the_path() {
    let report = placed(&[]);
    let length = report.plan.path.length();
    let at: Vec<f64> = (0..100).map(|k| length * (0.2 + 0.006 * f64::from(k))).collect();
    let rows = vec![Some(Vector3::new(0.3, 0.0, -0.1) * MM); at.len()];
    let log = log_of(Clock::Length(at.clone()), None, Some((rows, true)), None);
    let measured = MeasuredPass::of(&report, &log, &options(NEVER)).unwrap();
    assert!((measured.alignment.unwrap().shift + at[0]).abs() < 1e-12);
    for (k, error) in measured.error.iter().enumerate() {
        let s = measured_at(&report, k);
        let known = s > at[0] && s < at[at.len() - 1];
        assert_eq!(
            error.is_some(),
            known || (error.is_some() && (s - at[0]).abs().min((s - at[99]).abs()) < 2.0 * MM),
            "{s}"
        );
    }
    assert!(!measured.said.odd.join("").contains("alignment looks wrong"), "{:?}", measured.said);
    // A tip that stands on the path all the while was no pass of it.
    let still = vec![Some(report.plan.trajectory.position[900]); 1000];
    let at = (0..1000).map(|k| 0.02 * f64::from(k)).collect();
    let log = log_of(Clock::Time(at), Some((still, Some(1.0))), None, None);
    let measured = MeasuredPass::of(&report, &log, &options(DESIRED)).unwrap();
    assert!(measured.said.odd.join("").contains("another run's log"), "{:?}", measured.said);
}

fn measured_at(report: &Report, sample: usize) -> f64 {
    report.plan.timing(Sources::ALL).arc_length[sample]
}

/// A clock without a unit is in that with which the log is as long as the run.
#[test]
fn a_clock_without_a_unit_is_recognised() {
    let report = placed(&[]);
    let seconds = position_log(&report, &report.q, &softer(1.2, 1.0), (2, 0.002 * MM, 0.5), 3);
    let Clock::Time(at) = &seconds.clock else { panic!("a log over time") };
    for (unit, name) in [(1.0, ""), (1e-3, "ms fits"), (1e-6, "us fits")] {
        let clock = Clock::Time(at.iter().map(|at| at / unit).collect());
        let log = Log { clock, clock_is_stated: false, ..seconds.clone() };
        let measured = MeasuredPass::of(&report, &log, &options(DESIRED)).unwrap();
        assert!((measured.alignment.unwrap().shift - 0.5).abs() < 0.004, "{:?}", measured.alignment);
        assert_eq!(
            measured.said.recognised.iter().any(|text| text.contains("fits") && text.contains("axis")),
            unit != 1.0
        );
        assert!(measured.said.recognised.join(" ").contains(name));
    }
    // A unit that is stated is not doubted: such a log is not of this run.
    let clock = Clock::Time(at.iter().map(|at| at * 1e3).collect());
    assert!(MeasuredPass::of(&report, &Log { clock, ..seconds }, &options(DESIRED)).is_err());
}

/// Deviations that count the other way, and forces on the workpiece, are recognised where the model says which way an arm
/// gives way.
#[test]
fn what_is_turned_round_is_recognised() {
    let report = placed(&[]);
    let (times, tips) = tips(&report, &report.q, &softer(1.2, 1.0), 2);
    let reference = armill::deviation::Reference::along(&report.plan, Sources::ALL);
    let off: Vec<Vector3<f64>> =
        tips.iter().enumerate().map(|(k, tip)| tip - reference.target[2 * k]).collect();
    let into = report.setup().workpiece.inverse();
    let force: Rows = (0..times.len()).map(|k| Some(report.force[2 * k] * -1.15)).collect();
    for (sign, frame) in [(1.0, "base"), (-1.0, "workpiece")] {
        let turn = |v: &Vector3<f64>| if frame == "base" { *v } else { into.direction(v) };
        let rows: Rows = off.iter().map(|v| Some(turn(v) * sign)).collect();
        let forces: Rows = force.iter().map(|v| v.map(|v| turn(&v))).collect();
        let log = log_of(Clock::Time(times.clone()), None, Some((rows, true)), Some(forces));
        let measured = MeasuredPass::of(&report, &log, &options(DESIRED)).unwrap();
        assert_eq!(measured.frame, frame);
        // The course of an error says less sharply than positions when it was.
        assert!(measured.alignment.unwrap().shift.abs() < 0.03, "{}", measured.alignment.unwrap().shift);
        for (k, off) in off.iter().enumerate() {
            let Some(error) = measured.error[2 * k] else { continue };
            assert!((error - off).norm() < 0.1 * MM, "{k}: {}", (error - off).norm() / MM);
        }
        let middle = report.samples() / 2;
        let force = measured.force[middle].unwrap() / 1.15;
        assert!((force - report.force[middle]).norm() < 0.04 * force.norm(), "{force}");
        let remarks = measured.said.odd.join("\n");
        assert_eq!(remarks.contains("desired less actual"), sign < 0.0, "{remarks}");
        assert!(remarks.contains("on the workpiece"), "{remarks}");
        // The force says how hard the material is, and then the deflection how soft the arm.
        let factors = estimate(&report, &measured);
        assert!((factors.cutting.value - 1.15).abs() < 0.01, "{}", factors.cutting.value);
    }
}

/// Points of a wall with normals: a wall that stands 0.2 mm proud was left by a tip that was 0.2 mm short of it.
#[test]
fn probed_walls_say_how_far_off_the_tip_was() {
    let line = json!({"kind":"rectangle","center_mm":[0,0,0],"width_mm":120,"height_mm":80});
    let report = placed(&[("path", line), ("shaper", json!("none"))]);
    let radius = report.setup().cut.diameter / 2.0;
    let frame = report.setup().workpiece;
    let mut random = fastrand::Rng::with_seed(2);
    let (mut points, mut normals) = (Vec::new(), Vec::new());
    // The part lies inside of the rectangle: its walls are the radius of the tool within, and proud outwards.
    for _ in 0..400 {
        let along = between(&mut random, -0.5, 0.5);
        let (across, normal) = match random.usize(0..4) {
            0 => (Vector3::new(120.0 * along, 40.0, 0.0), Vector3::y()),
            1 => (Vector3::new(120.0 * along, -40.0, 0.0), -Vector3::y()),
            2 => (Vector3::new(60.0, 80.0 * along, 0.0), Vector3::x()),
            _ => (Vector3::new(-60.0, 80.0 * along, 0.0), -Vector3::x()),
        };
        let height = Vector3::z() * between(&mut random, 0.5, 5.0);
        points.push(Some(across + (normal * (0.2 * MM - radius)) / MM + height));
        normals.push(normal);
    }
    let rows = points.len();
    let log = Log { normal: Some(normals), ..log_of(Clock::None, Some((points, None)), None, None) };
    assert_eq!(log.rows, rows);
    let measured = MeasuredPass::of(&report, &log, &options(NEVER)).unwrap();
    assert_eq!(measured.frame, "workpiece");
    let moving = report.plan.trajectory.moving;
    let mut seen = 0;
    for k in (0..moving).filter(|k| measured.error[*k].is_some()) {
        let s = report.plan.trajectory.timing.arc_length[k];
        // Within a few millimetres of a corner, two walls are near.
        let corner = report
            .plan
            .path
            .corners()
            .map(|corner| (corner.s - s).abs())
            .fold(s.min(report.plan.path.length() - s), f64::min);
        if corner < 8.0 * MM {
            continue;
        }
        let error = measured.error[k].unwrap();
        let out = frame.inverse().direction(&error);
        assert!((error.norm() - 0.2 * MM).abs() < 0.01 * MM, "{k}: {}", error.norm() / MM);
        let inward = frame.inverse().point(&report.plan.path.point(s));
        assert!(out.dot(&inward) > 0.0, "the tip was too far out");
        seen += 1;
    }
    assert!(seen > moving / 2, "{seen} of {moving}");
}

/// Angles at the motors and behind the gears: how far the springs bend, whatever the encoders' zeros are.
#[test]
fn angles_behind_the_gears_say_how_far_joints_bend() {
    let report = placed(&[]);
    let shaped = report.shaped(&report.q);
    let robot = &report.plan.robot;
    let (mut motor, mut load, mut at) = (vec![], vec![], vec![]);
    for k in 0..report.samples() {
        let q = shaped.at(k);
        let frames = forward::frames(robot, &q);
        let tip = frames[5].compose(robot.tool()).position;
        let turn = |joint: usize| {
            let axis: Vector3<f64> = frames[joint].rotation.column(2).into();
            let lever = axis.cross(&(tip - frames[joint].position));
            1.4 * robot.compliance()[joint] * lever.dot(&report.force[k])
        };
        let zero = Joints::new(1e-4, -2e-4, 1e-4, 0.0, 3e-4, 0.0);
        motor.push(q);
        load.push(q + Joints::from_fn(|joint, _| turn(joint)) + zero);
        at.push(k as f64 * report.plan.trajectory.sample_time);
    }
    let log = Log { motor: Some(motor), load: Some(load), ..log_of(Clock::Time(at), None, None, None) };
    let measured = MeasuredPass::of(&report, &log, &options(DESIRED)).unwrap();
    assert!(measured.alignment.unwrap().shift.abs() < 1e-3);
    let middle = report.samples() / 2;
    let deflection = report.deflection[middle];
    // The run begins and ends without force, so the zeros are known.
    let bent = measured.error[middle].unwrap();
    assert!(
        (bent - deflection * 1.4).norm() < 0.05 * deflection.norm(),
        "{bent} {deflection} {:?}",
        measured.said
    );
    let factors = estimate(&report, &measured);
    let product = exp(factors.logarithm[2] + factors.logarithm[6]);
    assert!((product - 1.4).abs() < 0.1, "{product}");
}

/// Factors of 200 drawn plants: each interval covers the truth in 95 % of them, and so does the range that the model then
/// gives for where the tip is.
#[test]
fn intervals_cover_the_truth() {
    let report = placed(&[
        ("uncertainty.stiffness_percent", json!(40)),
        ("uncertainty.cutting_percent", json!(30)),
        ("motion.sample_time_s", json!(0.02)),
    ]);
    let spreads = &report.setup().spreads;
    let truths: Vec<Draw> = deviates(77, 200).iter().map(|z| Draw::at(spreads, z)).collect();
    let mut covered = [0usize; 9];
    let (mut tip_covered, mut narrower) = (0, 0.0);
    for (k, truth) in truths.iter().enumerate() {
        let log = position_log(&report, &report.q, truth, (1, 0.01 * MM, 0.0), k as u64);
        let measured = MeasuredPass::of(&report, &log, &options(DESIRED)).unwrap();
        let factors = estimate(&report, &measured);
        let [t, r, a] = truth.force;
        let true_logarithms: [f64; 9] = std::array::from_fn(|i| match i {
            0..6 => ln(truth.compliance[i]),
            6 => ln(t),
            7 => ln(r / t),
            _ => ln(a / t),
        });
        for i in 0..9 {
            let deviation = factors.covariance[i][i].sqrt();
            covered[i] += usize::from(
                (factors.logarithm[i] - true_logarithms[i]).abs() <= factors.reach * deviation + 1e-12,
            );
        }
        // What the deflection depends on: the product at the joint that bends most, by its own variance.
        let product = factors.logarithm[2] + factors.logarithm[6] - true_logarithms[2] - true_logarithms[6];
        let c = &factors.covariance;
        let deviation = (c[2][2] + 2.0 * c[2][6] + c[6][6]).max(0.0).sqrt();
        tip_covered += usize::from(product.abs() <= factors.reach * deviation);
        let before = (spreads.covariance()[(2, 2)] + spreads.covariance()[(6, 6)]).sqrt();
        narrower += deviation / before / 200.0;
    }
    for (i, covered) in covered.iter().enumerate() {
        // 95 % of 200 is 190 with a deviation of 3.1.
        assert!(*covered >= 181, "factor {i}: {covered} of 200");
    }
    assert!(tip_covered >= 181, "{tip_covered} of 200");
    assert!(narrower < 0.6, "the product is known {narrower} times as well as before");
}

/// The band of a job that has learned covers what its commands really leave, in 95 % of 200 plants, and is narrower.
#[test]
fn the_band_of_a_job_that_has_learned_covers_the_truth() {
    let text = |learned: Value| {
        job_text(&[
            ("motion.sample_time_s", json!(0.05)),
            ("workpiece_frame", json!({"xyz_mm": [700, 50, 300], "rpy_deg": [0, 0, 30]})),
            ("path", json!({"kind":"circle","center_mm":[0,0,0],"radius_mm":150,"normal":[0.2,0.3,0.9]})),
            ("uncertainty", json!({"stiffness_percent": 40, "cutting_percent": 30, "draws": 200})),
            ("shaper", json!("none")),
            ("learned", learned),
        ])
    };
    let plain = Job { learned: None, ..Job::from_json(&text(json!(null))).unwrap() };
    let report = armill::run(&plain, &mut Progress::none()).unwrap();
    let truths: Vec<Draw> = deviates(5, 200).iter().map(|z| Draw::at(&report.setup().spreads, z)).collect();
    let (mut below, mut bands) = (0, vec![]);
    for (k, truth) in truths.iter().enumerate() {
        let log = position_log(&report, &report.compensation.q, truth, (1, 0.005 * MM, 0.0), 1000 + k as u64);
        let measured = MeasuredPass::of(&report, &log, &options(NEVER)).unwrap();
        let summary = LearnSummary::of(&report, None, &measured, None);
        let wiser = armill::run(
            &Job { learned: Some(summary.factors.learned.clone()), ..plain.clone() },
            &mut Progress::none(),
        )
        .unwrap();
        // The same plant with the commands of the job that has learned.
        let left = tips(&report, &wiser.compensation.q, truth, 1).1;
        let s = &report.plan.trajectory.timing.arc_length;
        let off =
            |(k, tip): (usize, &Vector3<f64>)| (tip - report.plan.path.closest(tip, s[k], 0.02).point).norm();
        let largest = left.iter().enumerate().map(off).fold(0.0, f64::max);
        below += usize::from(largest <= wiser.band.after.p95);
        bands.push(wiser.band.after.p95);
    }
    assert!(below >= 181, "{below} of 200");
    let band = Quantiles::of(bands);
    assert!(band.p95 < 0.7 * report.band.after.p95, "{} and {}", band.p95 / MM, report.band.after.p95 / MM);
}

/// The section of a job says the same as the numbers that it stands for.
#[test]
fn learned_factors_are_numbers_of_the_job() {
    let (softer, harder) = ([1.1, 1.2, 0.9, 1.0, 1.3, 1.0], [1.2, 0.9, 1.1]);
    let covariance = json!(vec![vec![0.0; 9]; 9]);
    let learned = json!({"compliance_factors": softer, "force_factors": harder, "covariance": covariance});
    let own = run(&[("learned", learned.clone())]);
    let thesis = [9.03e-7, 1.117e-6, 1.474e-6, 2.765e-6, 9.758e-6, 0.0];
    let compliance: Vec<f64> = thesis.iter().zip(softer).map(|(c, f)| c * f).collect();
    let stated = run(&[
        ("robot.joint_compliance_rad_per_nm", json!(compliance)),
        ("material", json!({"ktc_n_mm2": 1800.0 * 1.2, "krc_n_mm2": 540.0 * 0.9, "kac_n_mm2": 800.0 * 1.1})),
    ]);
    for (a, b) in
        own.after.actual.iter().zip(&stated.after.actual).chain(own.force.iter().zip(&*stated.force))
    {
        assert!((a - b).norm() < 1e-9 * (1.0 + a.norm()));
    }
    assert!(own.summary().stiffness.ends_with("Corrected by factors that a measured pass taught."));
    // Nothing is left unknown, so the band is the nominal rest.
    assert!((own.band.after.p95 - own.after_max()).abs() < 1e-6 * MM + 0.02 * own.after_max());
    // A spring's table turns further as well.
    let springs = json!([[2, 100, 0.5], [2, 1000, 3.0]]);
    let further = json!([[2, 100, 0.6], [2, 1000, 3.6]]);
    let mut base = learned.clone();
    base["compliance_factors"] = json!([1, 1.2, 1, 1, 1, 1]);
    base["force_factors"] = json!([1, 1, 1]);
    let own = run(&[("learned", base), ("robot.joint_springs_nm_arcmin", springs)]);
    let stated = run(&[("robot.joint_springs_nm_arcmin", further)]);
    for (a, b) in own.before.actual.iter().zip(&stated.before.actual) {
        assert!((a - b).norm() < 1e-9);
    }
    // It comes back from its own JSON, and what is wrong is named.
    let job = Job::from_json(&job_text(&[("learned", learned.clone())])).unwrap();
    assert_eq!(Job::from_json(&job.to_json()), Ok(job));
    let wrong = |key: &str, value: Value| {
        let mut learned = learned.clone();
        learned[key] = value;
        refused(&[("learned", learned)])
    };
    assert_eq!(wrong("force_factors", json!([1, 0, 1])).field(), Some("learned.force_factors[1]"));
    assert_eq!(
        wrong("compliance_factors", json!([1, 1, 1, 1, 1, -1])).field(),
        Some("learned.compliance_factors[5]")
    );
    let mut table = vec![vec![0.0; 9]; 9];
    table[2][2] = -1.0;
    assert_eq!(wrong("covariance", json!(table)).field(), Some("learned.covariance"));
    (table[2][2], table[2][3]) = (0.0, 0.1);
    assert_eq!(wrong("covariance", json!(table)).field(), Some("learned.covariance[2][3]"));
}

/// Draws that are tied have the covariance that ties them.
#[test]
fn tied_factors_are_drawn_together() {
    let root =
        SMatrix::<f64, 9, 9>::from_fn(
            |i, j| if j <= i { 0.03 * (1.0 + ((3 * i + 5 * j) % 7) as f64) } else { 0.0 },
        );
    let wanted = root * root.transpose();
    let rows: Vec<Vec<f64>> =
        (0..9).map(|i| (0..9).map(|j| 0.5 * (wanted[(i, j)] + wanted[(j, i)])).collect()).collect();
    let learned = json!({"compliance_factors": [1,1,1,1,1,1], "force_factors": [1,1,1], "covariance": rows});
    let report = run(&[("learned", learned), ("motion.sample_time_s", json!(0.05))]);
    let spreads = &report.setup().spreads;
    let draws: Vec<[f64; 9]> = deviates(9, 20_000)
        .iter()
        .map(|z| {
            let Draw { compliance, force: [t, r, a], .. } = Draw::at(spreads, z);
            std::array::from_fn(|i| ln(*[&compliance[..], &[t, r / t, a / t]].concat().get(i).unwrap()))
        })
        .collect();
    for i in 0..9 {
        for j in 0..9 {
            let mean = draws.iter().map(|row| row[i] * row[j]).sum::<f64>() / draws.len() as f64;
            let scale = (wanted[(i, i)] * wanted[(j, j)]).sqrt();
            // The deviates end at 3.09: their variance is 1.5 % less.
            assert!((mean - wanted[(i, j)]).abs() < 0.04 * scale, "{i} {j}: {mean} and {}", wanted[(i, j)]);
        }
    }
    let shares: f64 = report.band.shares.iter().map(|share| share.share).sum();
    assert!((shares - 1.0).abs() < 1e-9);
}

/// From the log to the next pass: what it would leave is what the same plant leaves, and what was kept comes back.
#[test]
fn the_next_pass_leaves_what_it_says() {
    let report = placed(&[]);
    let truth = Draw { compliance: [1.4, 1.3, 0.8, 1.0, 1.2, 1.0], force: [1.1, 1.2, 0.9], frequency: 1.0 };
    let gain = LearningGain::USUAL;
    let mut commanded = NEVER;
    let mut q = report.compensation.q.clone();
    let s = &armill::deviation::Reference::along(&report.plan, Sources::ALL).arc_length.to_vec();
    let largest = |q: &[Joints]| {
        let off =
            |(k, tip): (usize, &Vector3<f64>)| (tip - report.plan.path.closest(tip, s[k], 0.02).point).norm();
        let tips = tips(&report, q, &truth, 1).1;
        // Where the cut begins and ends, the error is faster than a command may be.
        let inner = tips.iter().enumerate().skip(150).take(report.samples() - 300);
        inner.map(off).fold(0.0, f64::max)
    };
    let mut errors = vec![largest(&q)];
    for pass in 0..3 {
        let log = position_log(&report, &q, &truth, (1, 0.001 * MM, 0.0), pass);
        let measured = MeasuredPass::of(&report, &log, &options(commanded)).unwrap();
        let next = NextPass::of(&report, &measured, gain).unwrap();
        q = next.q.clone();
        let kept = Commanded { corrected: true, learned: next.learned };
        let file = LearnedCorrection::of(&report, &kept);
        let back = LearnedCorrection::from_json(&json!(file).to_string()).unwrap().commanded(&report);
        for (a, b) in back.learned.iter().zip(&kept.learned).take(report.plan.trajectory.moving) {
            assert!((a - b).norm() < 1e-9, "{a} {b}");
        }
        commanded = kept;
        errors.push(largest(&q));
        let left = errors[errors.len() - 1] / errors[errors.len() - 2];
        // 30 %, and what the low pass and noise of 0.001 mm add.
        let floor = 0.004 * MM / errors[errors.len() - 2];
        assert!(left < 0.36 + floor, "pass {}: {left}", pass + 1);
    }
    assert!(errors[0] > 0.2 * MM && errors[3] < 0.05 * errors[0] + 0.004 * MM, "{errors:?}");
    for text in [
        "{\"corrected\":true,\"s_dx_dy_dz_mm\":[[1,0,0,0],[0,0,0,0]]}",
        "{\"corrected\":true}",
        "{\"corrected\":1",
    ] {
        assert!(LearnedCorrection::from_json(text).is_err(), "{text}");
    }
    assert!(LearningGain::new(0.0).is_err() && LearningGain::new(1.1).is_err());
}

/// Words for what no factor explains: an offset, a drift, and what a deflection cannot tell apart.
#[test]
fn what_is_not_explained_is_said() {
    let report = placed(&[]);
    let log = position_log(&report, &report.q, &softer(1.2, 1.0), (1, 0.002 * MM, 0.0), 8);
    let with = |more: &dyn Fn(f64) -> Vector3<f64>| {
        let mut log = log.clone();
        let (rows, _) = log.position.as_mut().unwrap();
        let count = rows.len() as f64;
        for (k, row) in rows.iter_mut().enumerate() {
            *row = row.map(|tip| tip + more(k as f64 / count));
        }
        let measured = MeasuredPass::of(&report, &log, &options(DESIRED)).unwrap();
        LearnSummary::of(&report, None, &measured, None).unexplained.join("\n")
    };
    let plain = with(&|_| Vector3::zeros());
    assert!(plain.contains("explains 100 %") && plain.contains("not which of them"), "{plain}");
    assert!(!plain.contains("off by") && !plain.contains("drifts"), "{plain}");
    let drifting = with(&|share| Vector3::new(0.0, 0.0, 0.3 * MM * share * share));
    assert!(drifting.contains("drifts by") || drifting.contains("off by"), "{drifting}");
    let wavy =
        with(&|share| Vector3::new(sin(60.0 * share), cos(47.0 * share), sin(53.0 * share)) * (2.0 * MM));
    assert!(wavy.contains("another cause"), "{wavy}");
}

/// A log is read by its names; what cannot be read is placed.
#[test]
fn logs_are_read_by_name() {
    let log = Log::read("time_ms; x_mm; y_mm; z_mm\n0; 1; 2; 3\n10; ; ; \n20; 2; 3; 4\n").unwrap();
    assert_eq!(log.clock, Clock::Time(vec![0.0, 0.01, 0.02]));
    let (rows, unit) = log.position.unwrap();
    assert_eq!(rows, [Some(Vector3::new(1.0, 2.0, 3.0) * MM), None, Some(Vector3::new(2.0, 3.0, 4.0) * MM)]);
    assert_eq!(unit, Some(MM));
    let log = Log::read("s_mm,dx_um,dy_um,dz_um,Fx [N],Fy [N],Fz [N]\n0,1,2,3,10,20,30\n5,1,2,3,10,20,30\n")
        .unwrap();
    assert_eq!(log.clock, Clock::Length(vec![0.0, 5.0 * MM]));
    assert_eq!(log.deviation.unwrap().0[0], Some(Vector3::new(1.0, 2.0, 3.0) * (1e-3 * MM)));
    assert_eq!(log.force.unwrap()[1], Some(Vector3::new(10.0, 20.0, 30.0)));
    let log = Log::read("x,y,z,nx,ny,nz\n1,2,3,0,0,1\n2,2,3,0,1,0\n").unwrap();
    assert_eq!((log.clock, log.normal.unwrap()[1]), (Clock::None, Vector3::y()));
    let log = Log::read(
        "t,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,load3_deg\n0,0,0,1,0,0,0,57\n1,0,0,1,0,0,0,58\n",
    )
    .unwrap();
    assert_eq!(log.load.unwrap()[0], Joints::new(0.0, 0.0, 57.0 * DEG, 0.0, 0.0, 0.0));
    for (text, place, part) in [
        ("time_s,x_mm,y_mm,z_mm\n0,1,2,3\n0,1,2,3\n", (3, 1), "time rises"),
        ("time_s,x_mm,y_mm,z_mm\n0,1,2,3\n1,1,,3\n", (3, 5), "a number"),
        ("time_s,x_mm,y_mm\n0,1,2\n1,1,2\n", (1, 8), "all three"),
        ("time_s,x_mm,y_mm,z_mm,wind\n0,1,2,3,4\n1,1,2,3,4\n", (1, 23), "the columns are"),
        ("0,1,2,3\n1,1,2,3\n", (1, 1), "the columns are"),
        ("dx_mm,dy_mm,dz_mm\n0,1,2\n1,1,2\n", (1, 13), "where on the path"),
        ("time_s,x_mm,y_mm,z_mm\n0,1,2,3\n", (2, 1), "fewer than two rows"),
        ("x,y,z,nx,ny,nz\n1,2,3,0,0,1\n2,2,3,0,1,1\n", (3, 7), "length 1"),
        ("t,x,y,z,dx,dy,dz\n0,1,2,3,0,0,0\n1,1,2,3,0,0,0\n", (1, 15), "one of positions"),
        ("t,load1_deg\n0,1\n1,1\n", (1, 3), "those of the motors"),
    ] {
        let error = Log::read(text).expect_err(text);
        assert_eq!(error.field(), Some("log"));
        assert!(error.to_string().contains(part), "{text:?}: {error}");
        assert_eq!(error.place(), Some(place), "{text:?}: {error}");
    }
}

/// Courses that are shifted, and ones that do not lie over each other.
#[test]
fn shifts_are_found_by_likeness() {
    let at: Vec<f64> = (0..2000).map(|k| 0.01 * f64::from(k)).collect();
    let course = |t: f64| Vector3::new(sin(t), cos(1.7 * t), exp(-0.1 * t));
    let run: Vec<Vector3<f64>> = at.iter().map(|t| course(*t)).collect();
    for shift in [-3.0, 0.0, 0.737, 4.2] {
        for sign in [1.0, -0.4] {
            let log: Vec<Vector3<f64>> = at.iter().map(|t| course(t - shift) * sign + Vector3::x()).collect();
            let found = Alignment::of(
                Sampled { at: &at, values: &log },
                Sampled { at: &at, values: &run },
                ComparedBy::Likeness,
                None,
            )
            .unwrap();
            assert!((found.shift - shift).abs() < 2e-3, "{shift}: {}", found.shift);
            assert!(found.agreement * sign > 0.99 * sign.abs(), "{}", found.agreement);
        }
    }
    let short = [0.0, 1.0];
    let values = [Vector3::zeros(); 2];
    let nothing = Sampled { at: &short, values: &values };
    assert!(
        Alignment::of(nothing, Sampled { at: &at, values: &run }, ComparedBy::Likeness, Some(50.0)).is_none()
    );
}

/// The slot's means in closed form (Altintas, Manufacturing Automation, 2nd ed. 2012, eq. 2.52 for a full immersion, in {T}),
/// for the coefficients that a straight line through the means of a published feed series gave: two flutes, 3 mm deep, feeds
/// of 0.025 to 0.125 mm.
#[test]
fn a_feed_series_gives_its_coefficients() {
    let (flutes, depth) = (2.0, 3.0);
    let (ktc, kte, krc, kre, kac, kae) = (959.0, 15.8, 251.0, 19.4, 146.0, 18.2);
    let mean = |c: f64| {
        let (n, a) = (flutes, depth);
        let x = -n * a / 4.0 * krc * c - n * a / PI * kre;
        let y = n * a / 4.0 * ktc * c + n * a / PI * kte;
        let z = -(n * a / PI * kac * c + n * a / 2.0 * kae);
        [x, y, z]
    };
    let mut text = String::from("feed_per_tooth_mm,fx_n,fy_n,fz_n\n");
    for c in [0.025, 0.05, 0.075, 0.1, 0.125] {
        let [x, y, z] = mean(c);
        text += &format!("{c},{x},{y},{z}\n");
    }
    let cut = Cut {
        diameter: 16.0 * MM,
        flutes: 2,
        helix: 25.0 * DEG,
        hand: Hand::Right,
        corner_radius: 0.0,
        runout: 0.0,
        coefficients: Coefficients::default(),
        axial_depth: depth * MM,
        engagement: Engagement::Slot,
    };
    let cuts = dynamometer::read(&text).unwrap();
    let fit = dynamometer::fit(&cut, &cuts).unwrap();
    for (fitted, wanted) in fit.coefficients.iter().zip([ktc, krc, kac, kte, kre, kae]) {
        assert!((fitted.value / wanted - 1.0).abs() < 1e-9, "{}: {} and {wanted}", fitted.key, fitted.value);
        let [low, high] = fitted.interval.unwrap();
        assert!(high - low < 1e-6 * wanted);
    }
    assert!(fit.r_squared.iter().all(|share| *share > 1.0 - 1e-9) && fit.remarks.is_empty());
    // With noise, each interval covers the truth in 95 of 100 series.
    let mut random = fastrand::Rng::with_seed(4);
    let mut covered = [0; 6];
    for _ in 0..400 {
        let noisy: Vec<_> = cuts
            .iter()
            .map(|cut| dynamometer::MeasuredCut {
                force: cut.force + Vector3::from_fn(|_, _| 3.0 * normal(&mut random)),
                ..*cut
            })
            .collect();
        let fit = dynamometer::fit(&cut, &noisy).unwrap();
        for (k, wanted) in [ktc, krc, kac, kte, kre, kae].into_iter().enumerate() {
            let [low, high] = fit.coefficients[k].interval.unwrap();
            covered[k] += i32::from((low..=high).contains(&wanted));
        }
    }
    assert!(covered.iter().all(|covered| (366..=395).contains(covered)), "{covered:?}");
    // Peaks are checked with the coefficients that were found.
    let known = Coefficients {
        ktc: ktc * N_PER_MM2,
        krc: krc * N_PER_MM2,
        kac: kac * N_PER_MM2,
        kte: kte * N_PER_MM,
        kre: kre * N_PER_MM,
        kae: kae * N_PER_MM,
    };
    let with_peaks: Vec<_> = cuts
        .iter()
        .map(|measured| {
            // The largest of a fine revolution: a second way to the peak.
            let forces = Cut { coefficients: known, ..cut }.revolution(20_000, measured.chip).1;
            let peak = forces.iter().map(Vector3::norm).fold(0.0, f64::max);
            dynamometer::MeasuredCut { peak: Some(1.1 * peak), ..*measured }
        })
        .collect();
    let check = dynamometer::fit(&cut, &with_peaks).unwrap().peak_check.unwrap();
    assert!(
        (check.ratio - 1.0 / 1.1).abs() < 2e-3
            && (check.worst_percent - 100.0 * (1.0 - 1.0 / 1.1)).abs() < 0.3
    );
    for (text, part) in [
        ("feed_per_tooth_mm,fx_n,fy_n,fz_n\n0.1,1,2,3\n0.1,1,2,3\n", "two feeds"),
        ("feed_per_tooth_mm,fx_n,fy_n\n0.1,1,2\n", "feed_per_tooth_mm"),
        ("feed_per_tooth_mm,fx_n,fy_n,fz_n\n0,1,2,3\n0.1,1,2,3\n", "above 0 mm"),
        ("feed_per_tooth_mm,fx_n,fy_n,fz_n,rpm\n0.1,1,2,3,4\n0.2,1,2,3,4\n", "peak_n"),
    ] {
        let error = dynamometer::read(text).expect_err(text);
        assert!(error.to_string().contains(part), "{text:?}: {error}");
    }
    let turned: Vec<_> =
        cuts.iter().map(|cut| dynamometer::MeasuredCut { force: -cut.force, ..*cut }).collect();
    assert!(dynamometer::fit(&cut, &turned).unwrap().remarks[0].contains("on the workpiece"));
}

#[test]
fn a_log_without_a_run_is_refused() {
    let report = placed(&[]);
    let short = Log::read("time_s,dx_mm,dy_mm,dz_mm\n0,1,2,3\n0.1,1,2,3\n").unwrap();
    let Error::Invalid { field, .. } = MeasuredPass::of(&report, &short, &options(NEVER)).unwrap_err() else {
        panic!("another error");
    };
    assert_eq!(field, "log");
    let forces = Log::read("time_s,fx_n,fy_n,fz_n\n0,1,2,3\n5,1,2,4\n10,3,2,1\n").unwrap();
    if let Ok(measured) = MeasuredPass::of(&report, &forces, &options(NEVER)) {
        assert!(NextPass::of(&report, &measured, LearningGain::USUAL).is_err());
    }
}
