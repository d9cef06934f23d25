//! The band against full reruns of the kept commands: jobs of many kinds, each sent through the
//! whole model at every sample, once for each drawn plant.

use crate::common::job_text;
use crate::plant::drawn_cut;
use armill::cutting::{MeanForces, StiffnessAlong};
use armill::deviation::{Reference, Sources, simulate};
use armill::plan::Plan;
use armill::setup::Setup;
use armill::uncertainty::Draw;
use armill::uncertainty::draw::deviates;
use armill::{Job, Progress, Report};
use serde_json::{Value, json};
use std::sync::Arc;

/// The changes of a job that make its arm a drawn one: compliances, and turns of springs that are
/// not linear, times their factors.
fn softened(report: &Report, changes: &[(&'static str, Value)], draw: &Draw) -> Vec<(&'static str, Value)> {
    let mut all = changes.to_vec();
    let (_, robot) = all.iter_mut().find(|(key, _)| *key == "robot").unwrap();
    let nominal = *report.setup().robot.compliance();
    let compliance: [f64; 6] = std::array::from_fn(|i| nominal[i] * draw.compliance[i]);
    robot["joint_compliance_rad_per_nm"] = json!(compliance);
    if let Some(rows) = robot.get_mut("joint_springs_nm_arcmin").and_then(Value::as_array_mut) {
        for row in rows {
            let joint = row[0].as_f64().unwrap() as usize;
            row[2] = json!(row[2].as_f64().unwrap() * draw.compliance[joint - 1]);
        }
    }
    all
}

/// Contour errors of the kept commands [m] at every sample with a drawn plant.
fn rerun(report: &Report, changes: &[(&'static str, Value)], draw: &Draw) -> Vec<f64> {
    let text = job_text(&softened(report, changes, draw));
    let setup = Setup::of(&Job::from_json(&text).unwrap(), &mut Progress::none()).unwrap();
    let cut = drawn_cut(&setup.cut, draw);
    let shaper = setup.shaper.tuned(draw.frequency);
    let robot = setup.robot.clone().touched_off_at(&report.q[0]);
    let contacts = setup.contacts.as_ref();
    let drawn = Setup {
        mean_force: MeanForces::of(&cut, contacts),
        stiffness: setup.stiffness.as_ref().and(contacts).map(|contacts| StiffnessAlong::of(&cut, contacts)),
        cut,
        shaper,
        ..setup
    };
    let plan = Plan { setup: Arc::new(drawn), robot, ..report.plan.clone() };
    let reference = Reference::along(&plan, Sources::ALL);
    let errors = simulate(&plan, &reference, &report.compensation.q, &mut Progress::none()).contour_error;
    errors.iter().map(|error| error.norm()).collect()
}

const DRAWS: usize = 200;

/// A slot, then steps to the side, and a corner.
const POCKET: &str =
    "G21 G90\nG0 X0 Y0 Z5\nG1 Z-2 F600\nX40 F1800\nY3\nX0\nY6\nX40\nG2 X44 Y2 I0 J-4\nG1 Y-6\nG0 Z5\n";

/// A job by an RX-90 in front of it, sampled coarsely, with its 95 % ranges.
fn job(path: Value, more: &[(&'static str, Value)]) -> Vec<(&'static str, Value)> {
    let mut all = vec![
        ("robot", json!({"preset":"staubli-rx90"})),
        ("workpiece_frame", json!({"xyz_mm":[560,-40,320]})),
        ("path", path),
        ("motion", json!({"feed_mm_s":40,"acceleration_mm_s2":400,"sample_time_s":0.008})),
        ("material", json!({"preset":"al-7075-t6"})),
        ("cutting.axial_depth_mm", json!(3)),
        ("uncertainty", json!({"stiffness_percent":20,"cutting_percent":30,"draws":DRAWS})),
    ];
    for (key, value) in more {
        all.retain(|(known, _)| known != key);
        all.push((key, value.clone()));
    }
    all
}

fn jobs() -> Vec<(&'static str, Vec<(&'static str, Value)>)> {
    let corners = json!({"kind":"polyline","points_mm":[[0,0,0],[70,0,0],[70,40,0],[20,60,10],[0,10,0]]});
    let circle = json!({"kind":"circle","center_mm":[0,0,0],"radius_mm":50,"normal":[0,0,1]});
    let rounded =
        json!({"kind":"rectangle","center_mm":[0,0,0],"width_mm":100,"height_mm":60,"corner_radius_mm":10});
    let five_axes = json!({"kind":"csv","text":
        "x,y,z,i,j,k\n0,0,0,0,0,1\n40,10,0,0.1,0,0.995\n80,0,5,0.2,0.1,0.97\n80,40,5,0,0.2,0.98\n"});
    let unshaped = ("shaper", json!("none"));
    let ranges = |uncertainty: Value| ("uncertainty", uncertainty);
    vec![
        ("corners, shaped", job(corners.clone(), &[])),
        ("corners without a wait", job(corners.clone(), &[("motion.corner_dwell", json!(0))])),
        ("not compensated", job(corners, &[("compensation.max_passes", json!(0)), unshaped.clone()])),
        ("five axes", job(five_axes, std::slice::from_ref(&unshaped))),
        (
            "stiffness unknown",
            job(
                rounded.clone(),
                &[
                    ("robot", json!({"preset":"kuka-kr-210-2"})),
                    ("workpiece_frame", json!({"xyz_mm":[1700,0,700]})),
                    unshaped.clone(),
                    ranges(json!({"draws":DRAWS})),
                ],
            ),
        ),
        (
            "filter's frequency alone",
            job(
                json!({"kind":"polyline","points_mm":[[0,0,0],[70,0,0],[0,45,0]]}),
                &[
                    ("cutting.axial_depth_mm", json!(0)),
                    ("motion.corner_dwell", json!(0)),
                    ("compensation.max_passes", json!(0)),
                    ranges(json!({"frequency_percent":30,"draws":DRAWS})),
                ],
            ),
        ),
        (
            "filter's frequency",
            job(
                rounded.clone(),
                &[ranges(
                    json!({"stiffness_percent":5,"cutting_percent":5,"frequency_percent":10,"draws":DRAWS}),
                )],
            ),
        ),
        (
            "a bending tool",
            job(
                circle.clone(),
                &[("tool.bending", json!("cantilever")), ("tool.stickout_mm", json!(60)), unshaped.clone()],
            ),
        ),
        (
            "weight and worn joints",
            job(
                circle.clone(),
                &[
                    (
                        "robot",
                        json!({
                            "preset":"staubli-rx90",
                            "joint_springs_nm_arcmin":[[2,30,0.5],[2,300,3.5],[3,20,0.6],[3,200,4.0]],
                            "loads_kg_mm":[[2,20.0,250,0,0],[6,9.0,20,0,120]]
                        }),
                    ),
                    unshaped.clone(),
                ],
            ),
        ),
        (
            "in a stock",
            job(
                json!({"kind":"gcode","text":POCKET}),
                &[
                    ("stock", json!({"kind":"box","from_mm":[-20,-20,-20],"to_mm":[60,40,0]})),
                    ("cutting", json!({"spindle_rpm":8000,"feed_per_tooth_mm":0.05})),
                    ("tool", json!({"diameter_mm":10,"flutes":3,"bending":"cantilever","stickout_mm":40})),
                    ("compensation.max_passes", json!(6)),
                    unshaped.clone(),
                ],
            ),
        ),
        (
            "in a stock with weight and worn joints",
            job(
                json!({"kind":"gcode","text":POCKET}),
                &[
                    ("stock", json!({"kind":"box","from_mm":[-20,-20,-20],"to_mm":[60,40,0]})),
                    (
                        "robot",
                        json!({
                            "preset":"staubli-rx90",
                            "joint_springs_nm_arcmin":[[2,30,0.5],[2,300,3.5],[3,20,0.6],[3,200,4.0]],
                            "loads_kg_mm":[[2,20.0,250,0,0],[6,9.0,20,0,120]]
                        }),
                    ),
                    ("cutting", json!({"spindle_rpm":8000,"feed_per_tooth_mm":0.05})),
                    ("tool", json!({"diameter_mm":10,"flutes":3})),
                    unshaped.clone(),
                ],
            ),
        ),
        ("middle of the cut", job(circle, &[("compensation.at", json!("middle")), unshaped])),
        (
            "sure of both",
            job(rounded, &[ranges(json!({"stiffness_percent":2,"cutting_percent":3,"draws":DRAWS}))]),
        ),
    ]
}

#[test]
fn full_reruns_agree_on_jobs_of_every_kind() {
    for (name, changes) in jobs() {
        let report = armill::run_json(&job_text(&changes), &mut Progress::none()).unwrap();
        let spreads = &report.setup().spreads;
        let mut largest = Vec::new();
        let mut at: Vec<Vec<f64>> = vec![Vec::new(); report.samples()];
        for z in deviates(spreads.seed, DRAWS) {
            let errors = rerun(&report, &changes, &Draw::at(spreads, &z));
            largest.push(errors.iter().copied().fold(0.0, f64::max));
            at.iter_mut().zip(errors).for_each(|(all, error)| all.push(error));
        }
        let quantile = |all: &mut Vec<f64>, share: f64| {
            all.sort_by(f64::total_cmp);
            let place = share * DRAWS as f64;
            0.5 * (all[place as usize - 1] + all[place as usize])
        };
        let (p50, p95) = (quantile(&mut largest, 0.5), quantile(&mut largest, 0.95));
        let band = report.band.after;
        assert!((band.p50 / p50 - 1.0).abs() < 0.02, "{name}: P50 {} instead of {p50}", band.p50);
        assert!((band.p95 / p95 - 1.0).abs() < 0.02, "{name}: P95 {} instead of {p95}", band.p95);
        // The column between the places.
        for (k, all) in at.iter_mut().enumerate() {
            let (ours, theirs) = (report.band.p95_at(k), quantile(all, 0.95));
            assert!((ours - theirs).abs() < 0.06 * p95, "{name}: sample {k}: {ours} instead of {theirs}");
        }
        let places = &report.band.samples;
        assert!(places.len() <= 256 && places.is_sorted(), "{name}: {} places", places.len());
    }
}
