//! Packages for robots' controllers, read back by readers that know nothing of Armill.
#![allow(clippy::disallowed_methods, reason = "compared within a tolerance, not bit by bit")]

use crate::common::run;
use crate::controllers::{self, Blend, ControllerProgram, Motion, Target};
use armill::Report;
use armill::robot::forward;
use armill::setup::Controller;
use armill::verification::{Package, Programs};
use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

const ROBOTS: [(Controller, &str, [f64; 3]); 4] = [
    (Controller::Kuka, "kuka-kr-210-2", [1500.0, 100.0, 700.0]),
    (Controller::Abb, "abb-irb-6700-155-285", [1500.0, 100.0, 900.0]),
    (Controller::Staubli, "staubli-tx2-90", [550.0, 60.0, 300.0]),
    (Controller::Fanuc, "fanuc-r-2000ic-165f", [1500.0, 100.0, 700.0]),
];

/// A pocket's outline with arcs, and the ways in and out.
const POCKET: &str = "G21 G90 G17 S4000 M3\nG0 X0 Y0 Z20\nG0 X10 Y10\nG1 Z-2 F600\nG1 X80 F1800\nG3 X90 Y20 I0 J10\n\
                      G1 Y60\nG3 X80 Y70 I-10 J0\nG1 X10\nG3 X0 Y60 I0 J-10\nG1 Y20\nG3 X10 Y10 I10 J0\nG4 P0.5\nG0 Z20\nM30";

/// A job for a robot: its path in a workpiece frame that is turned.
fn job(robot: &str, place: [f64; 3], path: &Value, more: &[(&'static str, Value)]) -> Report {
    let mut changes = vec![
        ("robot", json!({"preset":robot})),
        ("workpiece_frame", json!({"xyz_mm":place,"rpy_deg":[2,-3,25]})),
        ("tool_frame", json!({"xyz_mm":[10,-20,150],"rpy_deg":[0,20,10]})),
        ("path", path.clone()),
        ("shaper", json!("none")),
        ("cutting.axial_depth_mm", json!(1)),
        ("motion.sample_time_s", json!(0.004)),
        ("compensation.tolerance_mm", json!(0.1)),
    ];
    changes.extend(more.iter().cloned());
    run(&changes)
}

fn paths() -> Vec<(&'static str, Value)> {
    let dome: String = (0..=40)
        .map(|k| {
            let t = (f64::from(k) - 20.0) * 1.5_f64.to_radians();
            format!("{},{},{},{},0,{}\n", 80.0 * t.sin(), f64::from(k), 80.0 * t.cos(), t.sin(), t.cos())
        })
        .collect();
    vec![
        ("pocket", json!({"kind":"gcode","text":POCKET})),
        ("tilted", json!({"kind":"csv","text":format!("x,y,z,i,j,k\n{dome}")})),
        ("circle", json!({"kind":"circle","center_mm":[0,0,0],"radius_mm":60,"normal":[0,0,1]})),
    ]
}

fn package(report: &Report, controller: Controller) -> (Package, ControllerProgram) {
    let package = Programs::default().package(report, Some(controller)).unwrap();
    let program = read(&package);
    (package, program)
}

fn read(package: &Package) -> ControllerProgram {
    let files = package.files.iter().map(|file| (file.path.as_str(), file.text.as_str()));
    controllers::read(package.controller, files)
        .unwrap_or_else(|error| panic!("{error}\n{}", package.files[0].text))
}

/// The base of a program in the robot's own base, at the foot of the arm [mm].
fn base(report: &Report, program: &ControllerProgram) -> (Vector3<f64>, Matrix3<f64>) {
    let height = report.setup().world.height() * 1e3;
    (program.base.0 + Vector3::z() * height, program.base.1)
}

/// Points along a target from the one before, in the base frame [mm], and the share of the way.
fn along(from: &Vector3<f64>, target: &Target, count: usize) -> Vec<Vector3<f64>> {
    let share = |k: usize| k as f64 / count as f64;
    match target.motion {
        Motion::Arc { via } => {
            // The circle through three points, by its centre in their plane.
            let (a, b) = (via - from, target.position - from);
            let normal = a.cross(&b);
            let centre = (normal.cross(&a) * b.norm_squared() + b.cross(&normal) * a.norm_squared())
                / (2.0 * normal.norm_squared());
            let (x, n) = (-centre, normal.normalize());
            let y = n.cross(&x);
            let angle = |p: Vector3<f64>| {
                let v = p - centre;
                v.dot(&y).atan2(v.dot(&x)).rem_euclid(std::f64::consts::TAU)
            };
            let end = angle(b);
            (0..=count)
                .map(|k| from + centre + x * (end * share(k)).cos() + y * (end * share(k)).sin())
                .collect()
        }
        _ => (0..=count).map(|k| from + (target.position - from) * share(k)).collect(),
    }
}

/// The polyline that a program describes, from its start on, in the base frame [mm].
fn course(program: &ControllerProgram, start: Vector3<f64>) -> Vec<Vector3<f64>> {
    let mut at = start;
    let mut points = vec![at];
    for target in &program.targets[1..] {
        points.extend(along(&at, target, 24).into_iter().skip(1));
        at = target.position;
    }
    points
}

fn distance(p: &Vector3<f64>, course: &[Vector3<f64>]) -> f64 {
    let to_chord = |pair: &[Vector3<f64>]| {
        let along = pair[1] - pair[0];
        let t = ((p - pair[0]).dot(&along) / along.norm_squared().max(1e-18)).clamp(0.0, 1.0);
        (p - pair[0] - along * t).norm()
    };
    course.windows(2).map(to_chord).fold(f64::INFINITY, f64::min)
}

#[test]
fn a_package_is_the_compensated_path_in_the_controllers_world() {
    for (controller, robot, place) in ROBOTS {
        for (name, path) in paths() {
            let name = format!("{name} on {robot}");
            let report = job(robot, place, &path, &[]);
            let programs = Programs::default();
            let id =
                ["krl", "rapid", "val3", "fanuc"][ROBOTS.iter().position(|r| r.0 == controller).unwrap()];
            let export = programs.export(&report, id, &Default::default()).unwrap();
            let (package, program) = package(&report, controller);
            assert_eq!(
                program.targets.len(),
                package.points,
                "{name}: one motion for each point, the first by axes"
            );
            let (origin, turned) = base(&report, &program);
            let in_base = |p: Vector3<f64>| turned.transpose() * (p * 1e3 - origin);
            // FANUC lists three decimals.
            let rounding = if controller == Controller::Fanuc { 1e-3 } else { 2e-5 };
            // Where the tool starts, it arrives by axes.
            let Motion::Joints(axes) = program.targets[0].motion else { panic!("{name}: starts by axes") };
            let q = axes.map(f64::to_radians).into();
            let tcp = forward::forward(&report.plan.robot, &q);
            let start = in_base(tcp.position);
            assert_eq!(program.targets[0].blend, Blend::Stop, "{name}");
            // The tool of the program is that of the job.
            let tool = report.plan.robot.tool();
            assert!((program.tool.0 - tool.position * 1e3).norm() < 2.0 * rounding, "{name}");
            assert!((program.tool.1 - tool.rotation).norm() < 1e-4, "{name}");
            // Every commanded sample lies beside the program by no more than what was measured.
            let course = course(&program, start);
            // Its first move is by axes: a thousandth of a degree is 0.03 mm at 1.7 m.
            let by_axes = if controller == Controller::Fanuc { 0.02 } else { 0.0 };
            let allowed = export.deviation * 1e3 + 2.0 * rounding + 2e-3 + by_axes;
            let commanded = export.commanded_path.positions(&report);
            for (k, p) in commanded.iter().enumerate().step_by(3) {
                let off = distance(&in_base(*p), &course);
                assert!(off <= allowed, "{name}, sample {k}: {off} mm, allowed {allowed}");
            }
            // And the tool's axis, at each point of the program, is that of the nearest sample.
            for target in &program.targets[1..] {
                let nearest = (0..commanded.len())
                    .min_by(|&a, &b| {
                        let off = |k: usize| (in_base(commanded[k]) - target.position).norm();
                        off(a).total_cmp(&off(b))
                    })
                    .unwrap();
                let axis = turned * -target.rotation.column(2);
                let off = (axis - export.commanded_path.axis.at(nearest)).norm();
                // Samples are up to 1 mm apart, over which the tilted axis turns by 0.7 deg.
                assert!(off < 0.02, "{name}: {off}");
            }
        }
    }
}

#[test]
fn a_package_stops_waits_and_blends_as_it_says() {
    for (controller, robot, place) in ROBOTS {
        let blending = [("program.blending_mm", json!(0.5))];
        let report = job(robot, place, &json!({"kind":"gcode","text":POCKET}), &blending);
        let (package, program) = package(&report, controller);
        let stops = program.targets[1..].iter().filter(|target| target.blend == Blend::Stop).count();
        assert_eq!(stops, package.stops + 1, "{robot}: stops on the way, and the end");
        for target in &program.targets[1..] {
            match target.blend {
                Blend::Stop => {}
                Blend::Distance(mm) => assert!((mm - 0.5).abs() < 1e-9, "{robot}: {mm}"),
                // d = share v^2 / (2 a) at the job's feed of 100 mm/s and 200 mm/s^2: 25 mm at 100 %.
                Blend::Percent(share) => assert_eq!(share, 2.0, "{robot}"),
            }
        }
        let waits: Vec<f64> =
            program.targets.iter().map(|target| target.wait_before_s).filter(|wait| *wait > 0.0).collect();
        assert!(waits.len() == 1 && (waits[0] - 0.5).abs() < 0.01, "{robot}: {waits:?}");
        let speeds: Vec<f64> = program.targets[1..].iter().map(|target| target.speed.unwrap()).collect();
        // Rapids at 250 mm/s, the way down at 10, the cut at 30 mm/s, as F says, but for what the
        // correction adds.
        for (speed, target) in speeds.iter().zip(&program.targets[1..]) {
            let known = [250.0, 10.0, 30.0].iter().any(|known| (speed / known - 1.0).abs() < 0.05);
            assert!(known, "{robot}: {speed} to {}", target.position);
        }
        assert!(speeds.iter().filter(|speed| (*speed / 30.0 - 1.0).abs() < 0.05).count() > 10, "{robot}");
        // Exact stops, on demand.
        let exact =
            job(robot, place, &json!({"kind":"gcode","text":POCKET}), &[("program.blending_mm", json!(0))]);
        let (package, program) = self::package(&exact, controller);
        assert!(program.targets.iter().all(|target| target.blend == Blend::Stop), "{robot}");
        assert_eq!(package.stops + 1, package.points - 1, "{robot}");
    }
}

#[test]
fn a_long_package_comes_in_parts_that_say_the_same() {
    for (controller, robot, place) in ROBOTS {
        // Points too far apart to be thinned: 460 corners of a fine saw.
        let saw: String =
            (0..460).map(|k| format!("{},{},0\n", f64::from(k) * 0.2, f64::from(k % 2) * 0.3)).collect();
        let path = json!({"kind":"csv","text":format!("x,y,z\n{saw}")});
        let lines = [
            ("program.lines_per_file", json!(100)),
            ("motion.corner_angle_deg", json!(170)),
            // Without a cut nothing is corrected, which a part's stop would change.
            ("cutting.axial_depth_mm", json!(0)),
        ];
        let report = job(robot, place, &path, &lines);
        let (package, program) = package(&report, controller);
        assert_eq!(program.targets.len(), package.points, "{robot}");
        let parts = package.files.iter().filter(|file| file.path.contains("00")).count();
        assert!(parts >= 5, "{robot}: {parts} parts");
        let longest =
            package.files.iter().filter(|file| !file.path.ends_with(".dtx") && !file.path.ends_with(".LS"));
        assert!(longest.map(|file| file.text.lines().count()).max().unwrap_or(0) <= 100, "{robot}");
        let whole = job(robot, place, &path, &lines[1..]);
        let (_, whole) = self::package(&whole, controller);
        let [parted, whole] = [&program, &whole].map(|program| course(program, program.targets[1].position));
        for (points, other) in [(&parted, &whole), (&whole, &parted)] {
            let worst = points.iter().map(|p| distance(p, other)).fold(0.0, f64::max);
            assert!(worst < 0.03, "{robot}: {worst}");
        }
    }
}

#[test]
fn the_job_names_numbers_loads_and_procedures() {
    for (controller, robot, place) in ROBOTS {
        let more = [(
            "program",
            json!({
                "name":"WING_7","tool_number":3,"base_number":5,"load_kg":18.5,"load_centre_mm":[1,2,120],
                "spindle_on":"SPIN_UP","spindle_off":"SPIN_OFF","coolant_on":"MIST"
            }),
        )];
        let report = job(robot, place, &json!({"kind":"gcode","text":POCKET}), &more);
        let (package, program) = package(&report, controller);
        assert!(program.name.eq_ignore_ascii_case("WING_7"), "{robot}: {}", program.name);
        assert_eq!(package.name, "WING_7");
        // In VAL3 a call leads to a program of the application, which is there to be filled.
        let called = |hook: &str| match controller {
            Controller::Staubli => package.files.iter().any(|file| file.path == format!("{hook}.pgx")),
            _ => program.hooks.iter().any(|call| call.contains(hook)),
        };
        assert!(["SPIN_UP", "MIST", "SPIN_OFF"].into_iter().all(called), "{robot}: {:?}", program.hooks);
        let all: String = package.files.iter().map(|file| file.text.as_str()).collect();
        assert!(all.contains("18.5"), "{robot}");
        if let Some(load) = program.load_kg {
            assert_eq!(load, 18.5, "{robot}");
        }
        let numbers: &[&str] = match controller {
            Controller::Kuka => &["BAS (#TOOL,3)", "BAS (#BASE,5)"],
            Controller::Fanuc => &["UFRAME_NUM=5 ;", "UTOOL_NUM=3 ;", "PAYLOAD[1] ;"],
            _ => &[],
        };
        assert!(numbers.iter().all(|text| all.contains(text)), "{robot}");
        assert!(
            package.remarks.iter().all(|remark| !remark.contains("load on the flange")),
            "{:?}",
            package.remarks
        );
    }
}

#[test]
fn names_that_a_controller_does_not_take_are_refused() {
    let [(_, robot, place), ..] = ROBOTS;
    for (controller, name) in
        [("kuka", "1ST"), ("kuka", "A-B"), ("staubli", "A_NAME_OF_16_CHR"), ("kuka", "")]
    {
        let job = json!({"version":1,"robot":{"preset":robot},"path":{"kind":"line","from_mm":place,"to_mm":[1500,200,700]},
                         "program":{"controller":controller,"name":name}});
        let error = armill::run_json(&job.to_string(), &mut armill::Progress::none()).unwrap_err();
        assert_eq!((error.code(), error.field()), ("invalid", Some("program.name")), "{name}");
    }
}

#[test]
fn an_archive_holds_the_files_as_they_are() {
    let (controller, robot, place) = ROBOTS[0];
    let report = job(robot, place, &json!({"kind":"line","from_mm":[0,0,0],"to_mm":[50,0,0]}), &[]);
    let (package, _) = package(&report, controller);
    let bytes = armill::export::archive::zip(&package.name, &package.files).unwrap();
    assert_eq!(bytes, armill::export::archive::zip(&package.name, &package.files).unwrap(), "no date in it");
    let archive = rawzip::ZipArchive::from_slice(&bytes).unwrap();
    let mut entries = archive.entries();
    let mut found = Vec::new();
    while let Some(entry) = entries.next_entry().unwrap() {
        let path = String::from_utf8(entry.file_path().as_ref().to_vec()).unwrap();
        let content = archive.get_entry(entry.wayfinder()).unwrap();
        found.push((path, content.data().to_vec()));
    }
    let files =
        package.files.iter().map(|file| (format!("ARMILL/{}", file.path), file.text.clone().into_bytes()));
    assert_eq!(found, files.collect::<Vec<_>>());
}

/// The last tool axis and position before each target that is further along x than `x` [mm].
fn before_x(program: &ControllerProgram, x: f64) -> &Target {
    let after = program.targets.iter().skip(1).position(|target| target.position.x > x).unwrap();
    &program.targets[after]
}

#[test]
fn a_tilt_on_the_spot_stays_on_the_spot() {
    // 20 deg within 0.09 mm between two straight moves: points nearer than the least step, but not alike.
    let tilt: String = (0..=40)
        .map(|k| {
            let t = (f64::from(k) * 0.5_f64).to_radians();
            format!("{},0,0,{},0,{}\n", 10.0 + 0.09 * f64::from(k) / 40.0, t.sin(), t.cos())
        })
        .collect();
    let (sin, cos) = 20_f64.to_radians().sin_cos();
    let text = format!("x,y,z,i,j,k\n0,0,0,0,0,1\n{tilt}20,0,0,{sin},0,{cos}\n");
    for (controller, robot, place) in ROBOTS {
        let more = [("motion.feed_mm_s", json!(0.5)), ("compensation.max_passes", json!(0))];
        let report = job(robot, place, &json!({"kind":"csv","text":text}), &more);
        let (_, program) = package(&report, controller);
        let axis = -before_x(&program, 10.5).rotation.column(2);
        let off = (axis - Vector3::new(sin, 0.0, cos)).norm();
        assert!(off < 0.02, "{robot}: tilted by {axis} where the straight move begins");
    }
}

#[test]
fn a_stop_is_kept_where_its_move_is_too_short_to_be_written() {
    let head = "G21 G90 G17 S4000 M3\nG0 X0 Y0 Z0\n";
    for (controller, robot, place) in ROBOTS {
        for (text, stops_at) in [
            // The end, a sharp corner, and a wait, each after 0.05 or 0.08 mm at another feed.
            ("G1 X40 F1200\nG1 X40.05 F600\nM30", None),
            ("G1 X40 F1200\nG1 X40.08 F600\nG1 Y40 F1200\nM30", Some(40.0)),
            ("G1 X40 F1200\nG1 X40.05 F600\nG4 P2\nG1 X80 F1200\nM30", Some(40.0)),
        ] {
            let path = json!({"kind":"gcode","text":format!("{head}{text}"),"dialect":"linuxcnc"});
            let report = job(robot, place, &path, &[("compensation.max_passes", json!(0))]);
            let (_, program) = package(&report, controller);
            assert_eq!(program.targets.last().unwrap().blend, Blend::Stop, "{robot}: {text}");
            let Some(x) = stops_at else { continue };
            let at_corner: Vec<_> = program.targets[1..]
                .iter()
                .filter(|target| (target.position.x - x).abs() < 0.2 && target.position.y.abs() < 0.2)
                .collect();
            assert!(at_corner.iter().any(|target| target.blend == Blend::Stop), "{robot}: {text}");
        }
    }
}

#[test]
fn names_that_clash_are_refused_for_the_controller_asked() {
    let programs = |name: &str, hook: &str| {
        job(
            "kuka-kr-210-2",
            [1500.0, 100.0, 700.0],
            &json!({"kind":"line","from_mm":[0,0,0],"to_mm":[50,0,0]}),
            &[("program", json!({"controller":"gcode","name":name,"spindle_on":hook}))],
        )
    };
    for (controller, name, hook, field) in [
        (Controller::Staubli, "WING", "start", "program.spindle_on"),
        (Controller::Staubli, "WING", "mill_001", "program.spindle_on"),
        (Controller::Staubli, "WING", "A_NAME_OF_16_CHR", "program.spindle_on"),
        (Controller::Kuka, "WING", "wing", "program.spindle_on"),
        (Controller::Kuka, "WING", "WING_002", "program.spindle_on"),
        (Controller::Kuka, "WING", "HALT", "program.spindle_on"),
        (Controller::Kuka, "BAS", "SPIN", "program.name"),
        (Controller::Abb, "tMill", "SPIN", "program.name"),
        (Controller::Abb, "WING", "main", "program.spindle_on"),
        (Controller::Fanuc, "WING", "wing", "program.spindle_on"),
    ] {
        let report = programs(name, hook);
        let error = Programs::default().package(&report, Some(controller)).unwrap_err();
        assert_eq!((error.code(), error.field()), ("invalid", Some(field)), "{controller:?} {name} {hook}");
    }
}

#[test]
fn what_a_package_leaves_to_be_done_is_said() {
    let says = |report: &Report, controller: Controller, part: &str| {
        let package = Programs::default().package(report, Some(controller)).unwrap();
        package.remarks.iter().any(|remark| remark.contains(part))
    };
    let (_, kuka, place) = ROBOTS[0];
    let text = POCKET
        .replace("G4 P0.5", "M0")
        .replace("G1 Y60", "S8000\nG1 Y60")
        .replace("G0 X10 Y10", "T2 M6\nG0 X10 Y10");
    let report = job(kuka, place, &json!({"kind":"gcode","text":text}), &[]);
    for part in ["M0 in line", "M6 in line", "spindle's speed changes", "load on the flange", "Not tried"] {
        assert!(says(&report, Controller::Kuka, part), "{part}");
    }
    assert!(!says(&report, Controller::Kuka, "not known to have this controller"));
    assert!(says(&report, Controller::Abb, "not known to have this controller"));
    assert!(says(&report, Controller::Fanuc, "controller's own acceleration"));
    let fast =
        job(kuka, place, &json!({"kind":"gcode","text":POCKET}), &[("motion.rapid_mm_s", json!(5000))]);
    let error = Programs::default().package(&fast, None).unwrap_err();
    assert_eq!(error.field(), Some("motion.rapid_mm_s"));
}
