//! The job: every field does what its table states, and every mistake is named.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]

use crate::common::{self, job_text, refused, run};
use armill::job::fields::{FieldKind, fields};
use armill::report::{Severity, VerdictState};
use armill::{Error, Job};
use serde_json::{Value, json};

/// A path of a kind made from the defaults in the table of fields.
fn path_of(kind: &str) -> Value {
    let mut path = json!({ "kind": kind });
    for field in fields() {
        if let (Some(key), Some(when)) = (field.path.strip_prefix("path."), &field.when)
            && when.is.contains(&kind)
        {
            let own = field.defaults.as_ref().and_then(|defaults| defaults.get(kind));
            path[key] = json!(own.unwrap_or(&field.default));
        }
    }
    path
}

#[test]
fn every_kind_of_path_computes_with_its_defaults() {
    let kinds = fields().into_iter().find(|field| field.path == "path.kind").unwrap().choices;
    assert_eq!(kinds.len(), 8);
    for kind in kinds {
        // The circle's centre is the thesis's; other shapes start in front of the arm.
        let report = run(&[("path", path_of(kind.value))]);
        assert!(report.summary().path_length_mm > 1.0, "{}", kind.value);
    }
}

#[test]
fn every_default_in_the_table_is_the_default_job_s() {
    let job = serde_json::to_value(Job::default()).unwrap();
    let mut compared = 0;
    for field in fields() {
        let value = field.path.split('.').try_fold(&job, |value, key| value.get(key));
        let Some(value) = value else { continue };
        let default = json!(field.default);
        let same = match (value, &default) {
            (Value::Number(a), Value::Number(b)) => a.as_f64() == b.as_f64(),
            (Value::Array(a), Value::Array(b)) if field.kind == FieldKind::Vector => {
                a.iter().map(Value::as_f64).eq(b.iter().map(Value::as_f64))
            }
            (a, b) => a == b,
        };
        assert!(same, "{}: the job has {value}, the table {default}", field.path);
        compared += 1;
    }
    assert!(compared > 30, "{compared} fields compared");
}

#[test]
fn every_number_is_checked_against_its_range() {
    let mut checked = 0;
    for field in fields() {
        let (Some(min), Some(max)) = (field.min, field.max) else { continue };
        if !matches!(field.kind, FieldKind::Number | FieldKind::Integer) {
            continue;
        }
        let (section, key) = field.path.split_once('.').unwrap();
        for value in [min - min.abs().max(1.0), max + max.abs().max(1.0)] {
            if field.kind == FieldKind::Integer && value < 0.0 {
                continue;
            }
            let number = if field.kind == FieldKind::Integer { json!(value as u64) } else { json!(value) };
            let mut given = match section {
                "path" => path_of(field.when.as_ref().unwrap().is[0]),
                "material" => json!({"ktc_n_mm2":1,"krc_n_mm2":1,"kac_n_mm2":1}),
                "shaper" => json!({"kind":"zvd","damping":0.1}),
                "stock" => json!({"kind": field.when.as_ref().unwrap().is[0]}),
                other => serde_json::to_value(Job::default()).unwrap()[other].clone(),
            };
            given[key] = number;
            if section == "shaper" && !key.starts_with("frequency") {
                given["frequency_hz"] = json!(3);
            }
            match refused(&[(section, given)]) {
                Error::OutOfRange { field: name, value: reported, .. } => {
                    assert_eq!(name, field.path);
                    assert_eq!(reported, value);
                }
                other => panic!("{} = {value}: {other:?}", field.path),
            }
            checked += 1;
        }
    }
    assert!(checked > 40, "{checked} limits checked");
}

#[test]
fn mistakes_are_named() {
    let cases: Vec<(&str, Value, &str, &str)> = vec![
        ("version", json!(2), "invalid", "version"),
        ("model", json!(3), "invalid", "model"),
        ("model", json!(0), "invalid", "model"),
        ("model", json!(1.5), "json", "model"),
        ("robot", json!({}), "missing", "robot.preset"),
        ("robot", json!({"preset":"rx91"}), "invalid", "robot.preset"),
        (
            "robot",
            json!({"preset":"staubli-rx90","joint_compliance_rad_per_nm":[0,0,0,0,0,-1e-9]}),
            "out-of-range",
            "robot.joint_compliance_rad_per_nm[5]",
        ),
        (
            "robot",
            json!({"preset":"staubli-rx90","joint_limits_deg":[[10,-10],[-1,1],[-1,1],[-1,1],[-1,1],[-1,1]]}),
            "invalid",
            "robot.joint_limits_deg[0]",
        ),
        ("path", json!({"kind":"circle","radius_mm":300}), "missing", "path.center_mm"),
        (
            "path",
            json!({"kind":"circle","center_mm":[0,0,0],"radius_mm":0,"normal":[0,0,1]}),
            "out-of-range",
            "path.radius_mm",
        ),
        (
            "path",
            json!({"kind":"circle","center_mm":[0,0,0],"radius_mm":300,"normal":[0,0,0]}),
            "invalid",
            "path.normal",
        ),
        (
            "path",
            json!({"kind":"circle","center_mm":[0,0,0],"radius_mm":300,"points_mm":[[0,0,0]]}),
            "invalid",
            "path.points_mm",
        ),
        ("path", json!({"kind":"polyline","points_mm":[[600,0,0]]}), "invalid", "path.points_mm"),
        ("path", json!({"kind":"polyline","points_mm":[[600,0,0],[600,0,0]]}), "invalid", "path.points_mm"),
        (
            "path",
            json!({"kind":"polyline","points_mm":[[600,0,0],[600,1e9,0]]}),
            "out-of-range",
            "path.points_mm[1][1]",
        ),
        ("path", json!({"kind":"csv","text":"1,2,3\n4,x,6"}), "text", "path.text"),
        ("path", json!({"kind":"csv","text":""}), "text", "path.text"),
        ("path", json!({"kind":"line","from_mm":[600,0,0],"to_mm":[600,0,0]}), "invalid", "path.to_mm"),
        (
            "path",
            json!({"kind":"rectangle","center_mm":[600,0,0],"width_mm":10,"height_mm":20,"corner_radius_mm":6}),
            "out-of-range",
            "path.corner_radius_mm",
        ),
        (
            "path",
            json!({"kind":"arc","center_mm":[600,0,0],"radius_mm":10,"sweep_deg":0}),
            "invalid",
            "path.sweep_deg",
        ),
        ("material", json!({"ktc_n_mm2":1}), "missing", "material.krc_n_mm2"),
        ("material", json!({"preset":"thesis","ktc_n_mm2":1}), "invalid", "material.preset"),
        ("material", json!({"preset":"cheese"}), "invalid", "material.preset"),
        ("cutting.exit_deg", json!(90), "invalid", "cutting.exit_deg"),
        ("shaper", json!({"kind":"zvd","damping":0.1}), "missing", "shaper.frequency_rad_s"),
        (
            "shaper",
            json!({"kind":"zvd","frequency_hz":3,"frequency_rad_s":18,"damping":0.1}),
            "invalid",
            "shaper.frequency_hz",
        ),
        ("shaper", json!({"kind":"ei","frequency_hz":3,"damping":0.4}), "out-of-range", "shaper.damping"),
        ("compensation.sources", json!(["shaping", "shaping"]), "invalid", "compensation.sources"),
        ("motion.feed_mm_s", json!(0.001), "invalid", "motion.sample_time_s"),
        ("start_branch.shoulder", json!("left"), "json", "start_branch.shoulder"),
    ];
    for (path, value, code, field) in cases {
        let result = armill::run_json(&job_text(&[(path, value.clone())]), &mut armill::Progress::none());
        let Err(error) = result else { panic!("{path} = {value} was computed") };
        assert_eq!((error.code(), error.field()), (code, Some(field)), "{path} = {value}: {error}");
        assert!(!error.to_string().is_empty());
    }
}

/// The error of too many samples holds the least sample time that is accepted: it is, and two digits
/// less are not. With a shaper, the waits in the many corners grow with it.
#[test]
fn too_many_samples_come_with_a_sample_time_that_is_enough() {
    let corners: Vec<[f64; 3]> =
        (0..3000).map(|k| [600.0 + f64::from(k % 2), f64::from(k / 2) * 0.1 - 80.0, 100.0]).collect();
    let zigzag = json!({"kind":"polyline","points_mm":corners});
    let line = json!({"kind":"line","from_mm":[500,0,100],"to_mm":[700,0,100]});
    for (path, shaper, feed) in [(zigzag, "zvd", 50.0), (line, "none", 0.002)] {
        let with = |sample_time: f64| {
            let shaper = if shaper == "none" {
                json!("none")
            } else {
                json!({"kind":"zvd","frequency_rad_s":18,"damping":0.1})
            };
            let job = job_text(&[
                ("path", path.clone()),
                ("shaper", shaper),
                ("motion.feed_mm_s", json!(feed)),
                ("motion.sample_time_s", json!(sample_time)),
            ]);
            let job = Job::from_json(&job).unwrap();
            armill::setup::Setup::of(&job, &mut armill::Progress::none()).map(|_| ())
        };
        let given = 1e-4;
        let error = with(given).unwrap_err();
        let data = serde_json::to_value(&error).unwrap();
        assert_eq!((data["code"].as_str(), data["unit"].as_str()), (Some("invalid"), Some("s")));
        assert_eq!(data["field"], "motion.sample_time_s");
        assert_eq!(data["value"], given);
        let least = data["min"].as_f64().unwrap();
        assert!(error.to_string().ends_with(&format!("use {least} s or more")), "{error}");
        assert_eq!(with(least), Ok(()), "{shaper}");
        assert!(with(0.9 * least).is_err(), "{shaper}: a tenth less would do too");
    }
}

#[test]
fn programs_are_paths_and_their_mistakes_are_placed() {
    let program = |kind: &str, text: &str| ("path", json!({"kind": kind, "text": text}));
    for (kind, text, place) in [
        ("gcode", "G21 G90\nG0 X600 Y0 Z100\nG41 X610", (3, 1)),
        ("gcode", "G0 X600 Y0 Z100\nG1 X#1", (2, 5)),
        ("apt", "UNITS/MM\nGOTO/600,0,100\nTRACUT/1", (3, 1)),
        ("csv", "x,y,z\n600,0,100\n600,a,100", (3, 5)),
    ] {
        let error = refused(&[program(kind, text)]);
        assert_eq!(
            (error.code(), error.field(), error.place()),
            ("text", Some("path.text"), Some(place)),
            "{kind}: {error}"
        );
    }
    // A missing F uses the job's feed and produces a remark; rapids move the arm and do not cut.
    let report = run(&[
        program("gcode", "G21 G90 S4000 M3\nG0 X600 Y0 Z120\nG0 Z100\nG1 X650"),
        ("motion.feed_mm_s", json!(40)),
        ("shaper", json!("none")),
    ]);
    assert!(
        report
            .warnings
            .iter()
            .any(|warning| warning.code == "feed-missing" && warning.message.starts_with("line 4"))
    );
    let (cuts, feed) = (common::column(&report, "cuts"), common::column(&report, "feed_mm_s"));
    let fastest = |cutting: f64| {
        cuts.iter()
            .zip(&feed)
            .filter(|(cuts, _)| **cuts == cutting)
            .map(|(_, feed)| *feed)
            .fold(0.0, f64::max)
    };
    assert!((fastest(1.0) - 40.0).abs() < 1e-9, "the job's feed");
    assert!(fastest(0.0) > 40.0, "rapids are faster");
    for ((force, cuts), feed) in report.force.iter().zip(&cuts).zip(&feed) {
        assert_eq!(force.norm() > 0.0, *cuts == 1.0 && *feed > 0.0);
    }
    // With a shaper, a cut ends gradually, and the column with it: the rapid follows without a stop.
    let shaped = run(&[program("gcode", "G21 G90 S4000 M3\nG0 X600 Y0 Z120\nG0 Z100\nG1 X650\nG0 X680")]);
    let cuts = common::column(&shaped, "cuts");
    assert!(cuts.iter().any(|cuts| (0.1..0.9).contains(cuts)));
    for (force, cuts) in shaped.force.iter().zip(&cuts) {
        assert!(force.norm() == 0.0 || *cuts > 0.0, "{} at {cuts}", force.norm());
    }
    // A tool of another diameter produces a remark; an equal one in inches does not.
    for (tool, unit, warned) in
        [("CUTTER/12,0", "MM", true), ("TLDATA/MILL,10.0,2", "MM", false), ("CUTTER/.3937", "INCHES", false)]
    {
        let size = if unit == "MM" { 1.0 } else { 25.4 };
        let text = format!(
            "{tool}\nUNITS/{unit}\nGOTO/{},0,{}\nGOTO/{},0,{}\nFINI",
            600.0 / size,
            100.0 / size,
            640.0 / size,
            100.0 / size
        );
        let warnings = run(&[program("apt", &text)]).warnings;
        let reported = warnings.iter().find(|warning| warning.code == "tool-differs");
        assert_eq!(reported.is_some(), warned, "{text}");
        assert!(reported.is_none_or(|reported| {
            reported.message.starts_with("line 1: the program's tool has a diameter of 12.000 mm")
        }));
    }
    let lines = common::column(&report, "program_line");
    assert_eq!((lines[0], *lines.last().unwrap()), (3.0, 4.0));
    // An inch program is read as inches.
    let inch = run(&[program("gcode", "G20 G90\nG0 X24 Y0 Z4\nG1 X25 F100")]).summary().program.unwrap();
    assert_eq!((inch.unit, inch.highest_mm[0]), ("inch", 635.0));
    // A changing tool axis is followed and corrected.
    let tilted = run(&[
        program("csv", "x,y,z,i,j,k\n600,-50,100,0,0,1\n600,50,100,0.2,0,0.98"),
        ("shaper", json!({"kind":"zvd","frequency_hz":10,"damping":0.03})),
    ]);
    let summary = tilted.summary();
    assert!(summary.program.unwrap().multi_axis);
    assert!(
        summary.after_axis_deg.max < 0.1 * summary.before_axis_deg.max,
        "{:?} {:?}",
        summary.before_axis_deg,
        summary.after_axis_deg
    );
    assert!(summary.after_mm.max < 0.02, "{:?}", summary.after_mm);
}

#[test]
fn a_place_out_of_reach_is_told_with_sample_distance_and_reach() {
    let line = json!({"kind":"line","from_mm":[600,0,100],"to_mm":[1600,0,100]});
    match refused(&[("path", line)]) {
        Error::Unreachable {
            sample: Some(sample),
            arc_length: Some(s),
            position,
            distance,
            reach_max,
            ..
        } => {
            // The wrist is 85 mm above the tip, the shoulder at 420 mm.
            let wrist = (position[0].powi(2) + (0.1 + 0.085 - 0.42_f64).powi(2)).sqrt();
            assert!(
                (distance - wrist).abs() < 1e-12 && distance > reach_max && (reach_max - 1.1).abs() < 1e-12
            );
            assert!(sample > 0 && (position[0] - 0.6 - s).abs() < 1e-9);
            // The sample before was in reach: one step is 0.1 mm.
            assert!(distance - reach_max < 1.1e-4);
        }
        other => panic!("{other:?}"),
    }
    // Inside the hole in the middle of the workspace, too.
    let inner = json!({"kind":"line","from_mm":[30,0,500],"to_mm":[40,0,500]});
    assert_eq!(refused(&[("path", inner)]).code(), "unreachable");
}

#[test]
fn a_start_branch_without_solution_is_refused_and_others_are_taken() {
    let path = json!({"kind":"line","from_mm":[600,-100,100],"to_mm":[600,100,100]});
    let q = |elbow: &str, wrist: &str| {
        let report = run(&[
            ("path", path.clone()),
            ("start_branch", json!({"shoulder":"front","elbow":elbow,"wrist":wrist})),
        ]);
        report.q[0].map(f64::to_degrees)
    };
    assert!(q("positive", "near")[2] > 0.0 && q("positive", "near")[3].abs() < 1e-6);
    assert!(q("negative", "near")[2] < 0.0);
    assert!((q("positive", "flipped")[3].abs() - 180.0).abs() < 1e-6);
    // An arm with a long a1 cannot reach over its back here.
    let rows = json!([
        {"alpha_deg":0,"a_mm":0,"d_mm":420}, {"alpha_deg":-90,"a_mm":400,"d_mm":0,"theta_offset_deg":-90},
        {"alpha_deg":0,"a_mm":450,"d_mm":0,"theta_offset_deg":90}, {"alpha_deg":90,"a_mm":0,"d_mm":650},
        {"alpha_deg":-90,"a_mm":0,"d_mm":0}, {"alpha_deg":90,"a_mm":0,"d_mm":85}
    ]);
    let robot =
        json!({"name":"long shoulder","modified_dh":rows,"joint_compliance_rad_per_nm":[0,0,0,0,0,0]});
    let far = json!({"kind":"line","from_mm":[1100,-100,100],"to_mm":[1100,100,100]});
    let back = json!({"shoulder":"back","elbow":"positive","wrist":"near"});
    let error = refused(&[("robot", robot), ("path", far), ("start_branch", back)]);
    assert_eq!((error.code(), error.field()), ("invalid", Some("start_branch")));
}

#[test]
fn what_a_job_leaves_out_is_remarked() {
    let report =
        armill::run_json("{\"version\":1,\"motion\":{\"feed_mm_s\":50}}", &mut armill::Progress::none())
            .unwrap();
    let remark = report.warnings.iter().find(|warning| warning.code == "default-used").unwrap();
    assert!(remark.message.contains("path") && remark.message.contains("motion.sample_time_s"));
    let full = armill::run_json(&Job::default().to_json(), &mut armill::Progress::none()).unwrap();
    assert!(!full.warnings.iter().any(|warning| warning.code == "default-used"));
}

#[test]
fn the_thesis_s_values_under_a_robot_or_path_of_ones_own_are_a_warning() {
    let line = json!({"kind":"line","from_mm":[600,-20,100],"to_mm":[600,20,100]});
    let robot = json!({"preset":"kuka-kr-210-2"});
    let ([shaper, material], feed) = (["shaper", "material"], "cutting.feed_per_tooth_mm");
    let own_shaper = json!({"kind":"zvd","frequency_hz":9,"damping":0.03});
    let own_material = json!({"preset":"al-7075-t6"});
    let far = json!({"xyz_mm":[1500,0,800],"rpy_deg":[0,0,0]});
    let cases = [
        (json!({"path": line}), vec![shaper, material, feed]),
        (json!({"path": line, "cutting": {"axial_depth_mm": 1}}), vec![shaper, material, feed]),
        (json!({"path": line, "shaper": "none"}), vec![material, feed]),
        (json!({"path": line, "shaper": own_shaper, "cutting": {"feed_per_tooth_mm": 0.1}}), vec![material]),
        (
            json!({"path": line, "material": own_material, "cutting": {"axial_depth_mm": 1}}),
            vec![shaper, feed],
        ),
        (json!({"robot": robot, "workpiece_frame": far}), vec![shaper, material, feed]),
        (
            json!({
                "path": line, "shaper": own_shaper, "material": own_material,
                "cutting": {"feed_per_tooth_mm": "from_feed"}
            }),
            vec![],
        ),
        (json!({"motion": {"feed_mm_s": 50}}), vec![]),
        (json!({}), vec![]),
    ];
    for (job, named) in cases {
        let report = armill::run_json(&job.to_string(), &mut armill::Progress::none()).unwrap();
        let warning = report.warnings.iter().find(|warning| warning.code == "thesis-default");
        assert_eq!(warning.is_some(), !named.is_empty(), "{job}");
        assert!(report.warnings.is_sorted_by_key(|warning| warning.severity), "{job}: {:?}", report.warnings);
        assert!(report.warnings.iter().any(|warning| warning.code == "default-used"), "{job}");
        let Some(warning) = warning else { continue };
        assert_eq!(warning.severity, Severity::Matters);
        for key in [shaper, material, feed] {
            assert_eq!(warning.message.contains(key), named.contains(&key), "{job}: {}", warning.message);
        }
    }
    assert!(run(&[("path", line)]).warnings.iter().all(|warning| warning.code != "thesis-default"));
}

#[test]
fn a_job_of_an_earlier_model_is_remarked_and_one_of_a_later_refused() {
    let earlier = |report: &armill::Report| {
        let found = report.warnings.iter().find(|warning| warning.code == "earlier-model");
        found.map(|warning| (warning.severity, warning.message.clone()))
    };
    let (severity, message) = earlier(&run(&[("model", json!(1))])).unwrap();
    assert_eq!(severity, Severity::Matters);
    assert!(message.contains("computed with an earlier model; figures differ"), "{message}");
    for job in [run(&[]), run(&[("model", json!(2))])] {
        assert_eq!(earlier(&job), None);
        assert_eq!(job.summary().model, 2);
    }
    let error = refused(&[("model", json!(3))]).to_string();
    assert!(error.contains("model") && error.contains("1 to 2"), "{error}");
    // The default job stays as it is written by hand.
    assert!(!Job::default().to_json().contains("model"));
}

#[test]
fn a_name_is_kept_and_changes_no_number() {
    let named = run(&[("name", json!("bracket, side 2"))]);
    assert_eq!(named.fingerprint(), run(&[]).fingerprint());
    let text = job_text(&[("name", json!("Träger 7"))]);
    let (job, not_given) = Job::read_json(&text).unwrap();
    assert_eq!(job.name.as_deref(), Some("Träger 7"));
    assert_eq!(Job::from_json(&job.to_json()), Ok(job));
    assert!(!not_given.contains(&"name".to_owned()), "no name is no default");
    assert!(!Job::default().to_json().contains("\"name\": null"));
    for name in ["", "  ", "two\nlines", &"x".repeat(101)] {
        let error = refused(&[("name", json!(name))]);
        assert_eq!(error.field(), Some("name"));
        assert!(error.to_string().contains("1 to 100 characters"), "{error}");
    }
}

#[test]
fn progress_ascends_and_ends() {
    let mut reported = Vec::new();
    armill::run_json(
        &Job::default().to_json(),
        &mut armill::Progress::new(&mut |stage: armill::Stage| reported.push(stage.fraction)),
    )
    .unwrap();
    assert!(reported.len() >= 5 && reported.windows(2).all(|pair| pair[0] < pair[1]));
    assert!(reported[0] == 0.0 && reported.iter().all(|fraction| *fraction <= 1.0));
    // With many samples, progress is reported within their stages too.
    let mut reported = Vec::new();
    let job = job_text(&[("motion.sample_time_s", json!(4e-4))]);
    armill::run_json(
        &job,
        &mut armill::Progress::new(&mut |stage: armill::Stage| reported.push((stage.name, stage.fraction))),
    )
    .unwrap();
    assert!(reported.windows(2).all(|pair| pair[0].1 < pair[1].1), "{reported:?}");
    for (stage, least) in [("joint commands", 2), ("deflection and shaping", 2), ("compensation", 4)] {
        assert!(reported.iter().filter(|(name, _)| *name == stage).count() >= least, "{stage}: {reported:?}");
    }
    // A long program reports progress while it is read, in any language.
    let way = |row: fn(f64) -> String| (0..20_000).map(|i| row(f64::from(i) * 1e-3)).collect::<String>();
    for (kind, text) in [
        ("gcode", way(|x| format!("G1 X{} Y600 Z100 F6000\n", 10.0 + x))),
        ("apt", way(|x| format!("GOTO/{},600,100\n", 10.0 + x))),
        ("csv", way(|x| format!("{};600.5;100\n", 10.0 + x))),
    ] {
        let mut reported = Vec::new();
        let job = job_text(&[("path", json!({"kind":kind,"text":text}))]);
        armill::run_json(
            &job,
            &mut armill::Progress::new(&mut |stage: armill::Stage| {
                reported.push((stage.name, stage.fraction))
            }),
        )
        .unwrap();
        assert!(reported.windows(2).all(|pair| pair[0].1 < pair[1].1), "{kind}: {reported:?}");
        let reading = reported.iter().take_while(|(name, _)| *name == "reading the program").count();
        assert!(reading >= 9 && reported[reading].0 == "joint commands", "{kind}: {reported:?}");
        assert!(reported.iter().all(|(_, fraction)| (0.0..=1.0).contains(fraction)), "{kind}");
    }
}

#[test]
fn columns_are_named_and_written_in_full() {
    let report = run(&[]);
    let keys: Vec<String> = report.columns().into_iter().map(|column| column.key).collect();
    let expected = "time_s,arc_length_mm,desired_x_mm,desired_y_mm,desired_z_mm,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,\
        shaped_q1_deg,shaped_q2_deg,shaped_q3_deg,shaped_q4_deg,shaped_q5_deg,shaped_q6_deg,force_x_n,force_y_n,force_z_n,\
        deflection_x_mm,deflection_y_mm,deflection_z_mm,actual_x_mm,actual_y_mm,actual_z_mm,contour_error_mm,\
        compensated_x_mm,compensated_y_mm,compensated_z_mm,after_contour_error_mm";
    assert!(keys.join(",").starts_with(expected), "{keys:?}");
    let text = armill::export::csv::columns(&report);
    let mut lines = text.lines();
    assert_eq!(lines.next().unwrap(), keys.join(","));
    let columns = report.columns();
    let mut rows = 0;
    for (k, line) in lines.enumerate() {
        for (cell, column) in line.split(',').zip(&columns) {
            assert_eq!(
                cell.parse::<f64>().unwrap().to_bits(),
                column.values[k].to_bits(),
                "{} of sample {k}",
                column.key
            );
        }
        rows += 1;
    }
    assert_eq!(rows, report.samples());
    let part = |from: usize| armill::export::csv::rows(&report, from..from + 7000);
    let parts: Vec<String> = (0..report.samples()).step_by(7000).map(part).collect();
    assert!(parts.concat() == text, "written in parts it is the same file");
    let path = armill::export::csv::compensated(&report);
    assert!(path.starts_with("time_s,compensated_x_mm,compensated_y_mm,compensated_z_mm,compensated_q1_deg"));
    assert_eq!(path.lines().count(), report.samples() + 1);
}

#[test]
fn every_chart_draws() {
    use armill::chart::{CATALOG, ChartOptions, chart, charts_of};
    let in_stock = json!({"kind":"extents","top_mm":5});
    let jobs = [
        vec![],
        vec![("shaper", json!("none")), ("cutting.axial_depth_mm", json!(0))],
        vec![("shaper", json!("none")), ("stock", in_stock)],
        vec![("online", json!({"measures": "position"}))],
    ];
    for changes in jobs {
        let report = run(&changes);
        let stock = report.setup().contacts.is_some();
        let charts = charts_of(&report);
        for name in ["engagement", "removal", "surface"] {
            assert_eq!(charts.iter().any(|entry| entry.name == name), stock, "{name}");
            let drawn = chart(&report, name, &ChartOptions::sized(700.0, 320.0));
            assert_eq!(drawn.is_ok(), stock, "{name}");
        }
        let looped = report.online.is_some();
        for name in ["loop-spectrum", "loop-delay"] {
            assert_eq!(charts.iter().any(|entry| entry.name == name), looped, "{name}");
            assert_eq!(chart(&report, name, &ChartOptions::sized(700.0, 320.0)).is_ok(), looped, "{name}");
        }
        let in_stock = ["engagement", "removal", "surface"];
        let applies =
            |name: &str| (stock || !in_stock.contains(&name)) && (looped || !name.starts_with("loop-"));
        for entry in CATALOG.into_iter().filter(|entry| applies(entry.name)) {
            let options = ChartOptions::sized(700.0, 320.0);
            let drawn = chart(&report, entry.name, &options).unwrap();
            assert!(drawn.svg.starts_with("<svg") && !drawn.svg.contains("NaN"), "{}", entry.name);
            assert!(
                drawn.series.len() == drawn.svg.matches("data-key=").count(),
                "{}: every series is drawn",
                entry.name
            );
            assert!(!drawn.description.is_empty());
        }
        assert_eq!(
            chart(&report, "no such", &ChartOptions::sized(700.0, 320.0)).unwrap_err().code(),
            "invalid"
        );
    }
}

/// A chart shows the values of the columns, in the requested unit; its axes name it.
#[test]
fn chart_data_are_the_columns_in_the_unit_asked_for() {
    use armill::chart::{ChartOptions, ForceUnit, Over, Units, chart, data};
    use armill::path::unit::LengthUnit;
    let report = run(&[]);
    let columns = report.columns();
    let column = |key: &str| &columns.iter().find(|column| column.key == key).unwrap().values;
    let pairs = [
        ("before-after", 1, "contour_error_mm"),
        ("before-after", 2, "after_contour_error_mm"),
        ("axis-error", 2, "after_axis_error_deg"),
        ("coordinates", 3, "desired_z_mm"),
        ("force", 1, "force_x_n"),
        ("joints", 6, "q6_deg"),
        ("joint-2", 2, "shaped_q2_deg"),
        ("path", 2, "desired_y_mm"),
    ];
    for (name, place, key) in pairs {
        let data = data(&report, name, Units::default(), Over::Time).unwrap();
        assert_eq!((&data[0].values, data[0].key.as_str()), (column("time_s"), "time_s"), "{name}");
        assert_eq!(&data[place].values, column(key), "{name}");
    }
    let units = Units { length: LengthUnit::Inch, force: ForceUnit::PoundForce };
    let imperial = |name: &str| data(&report, name, units, Over::Time).unwrap().swap_remove(1);
    // Published: 1 inch = 25.4 mm, 1 lbf = 4.448 221 615 260 5 N, both exact.
    for (name, key, of, size) in [
        ("error-shaping", "shaping_inch", "shaping_contour_error_mm", 25.4),
        ("force", "x_lbf", "force_x_n", 4.448_221_615_260_5),
    ] {
        let shown = imperial(name);
        assert_eq!(shown.key, key);
        for (shown, si) in shown.values.iter().zip(column(of)) {
            assert!((shown * size - si).abs() <= 1e-12 * si.abs(), "{name}: {shown} is not {si}");
        }
    }
    let drawn =
        |name| chart(&report, name, &ChartOptions { units, ..ChartOptions::sized(700.0, 320.0) }).unwrap();
    assert!(drawn("force").svg.contains(">Force, lbf<") && drawn("path").svg.contains(">z, inch<"));
    // The largest error before is 1.246 mm, 0.0490 inch: ticks are round in the unit.
    let errors = drawn("before-after");
    assert!(errors.y.unit == "inch" && errors.svg.contains(">0.04<") && errors.svg.contains(">0.02<"));
    assert!(errors.description.contains("max 0.049 inch"), "{}", errors.description);
}

#[test]
fn the_job_in_the_docs_is_the_default_job() {
    let page = include_str!("../docs/job.md");
    let job = page.split("```json").nth(1).unwrap().split("```").next().unwrap();
    let report = armill::run_json(job, &mut armill::Progress::none()).unwrap();
    assert_eq!(report.fingerprint(), run(&[]).fingerprint());
}

#[test]
fn a_shaper_faster_than_the_samples_is_remarked() {
    // Half the sampling rate of 4 ms is 125 Hz.
    let line = json!({"kind":"line","from_mm":[600,-20,100],"to_mm":[600,20,100]});
    for (hz, remarked) in [(2000.0, true), (126.0, true), (124.0, false), (9.0, false)] {
        let report = run(&[
            ("path", line.clone()),
            ("motion.sample_time_s", json!(0.004)),
            ("shaper", json!({"kind":"zvd","frequency_hz":hz,"damping":0.03})),
        ]);
        let found = report.warnings.iter().any(|warning| warning.code == "shaper-sampling");
        assert_eq!(found, remarked, "{hz} Hz");
    }
}

#[test]
fn fingerprints_are_pinned() {
    for (name, changes, fingerprint) in common::pinned() {
        assert_eq!(run(&changes).fingerprint(), fingerprint, "{name}: numbers have changed");
    }
}

#[test]
fn the_opening_job_can_run_and_is_whole() {
    let job = Job::opening().unwrap();
    // What a person meets first names every input, so that a later default changes nothing of it.
    assert_eq!(Job::from_json(&job.to_json()).unwrap(), job);
    let report = armill::run(&job, &mut armill::Progress::none()).unwrap();
    let summary = report.summary();
    let severe: Vec<_> = summary.warnings.iter().filter(|each| each.severity != Severity::Note).collect();
    assert!(severe.is_empty(), "{severe:?}");
    assert_ne!(summary.verdict_state, VerdictState::CannotRun);
    // The part: 120 x 80 x 12 mm, its pocket 60 x 40 x 6 mm with corners of 8 mm, all of it cut.
    let pocket = (60.0 * 40.0 - (4.0 - std::f64::consts::PI) * 64.0) * 6.0;
    let rim = (122.0 * 82.0 - (120.0 * 80.0 - (4.0 - std::f64::consts::PI) * 100.0)) * 12.0;
    let removed = summary.cut.removed_cm3.unwrap() * 1e3;
    assert!((removed - pocket - rim).abs() < 0.005 * (pocket + rim), "{removed} {pocket} {rim}");
    let program = summary.program.unwrap();
    assert_eq!(program.spindle_rpm, Some([12000.0, 12000.0]));
}

#[test]
fn a_program_proposes_its_own_spindle_speed() {
    let proposed = |text: &str| {
        let path = json!({"kind": "gcode", "text": text});
        armill::setup::proposed_cutting(&Job::from_json(&json!({"path": path}).to_string()).unwrap()).unwrap()
    };
    let text = "G21 G90\nS6000 M3\nG0 X600 Y-60 Z120\nG1 Z100 F1200\nS8000\nY20\nM30";
    assert_eq!(proposed(text).map(|cut| cut.spindle_rpm), Some(6000.0));
    assert_eq!(proposed("G21 G90\nG0 X600 Y-60 Z120\nG1 Z100 F1200\nY20"), None);
    assert_eq!(armill::setup::proposed_cutting(&Job::default()).unwrap(), None);
}
