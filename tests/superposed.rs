//! The correction on its own: the table against the report's columns, and the files of RSI and EGM as their readers take them.

use super::common::run;
use armill::Report;
use armill::export::superposed::rsi::answer;
use armill::export::superposed::{CorrectionTable, Interface, package};
use armill::export::{ExportOptions, post::robot::PackageFile};
use armill::math::Pose;
use armill::units::{DEG, MM};
use armill::verification::export;
use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

/// A line along the workpiece's x, which is turned and shifted in the base, without a shaper.
fn line(changes: &[(&str, Value)]) -> Report {
    let mut all = vec![
        ("path", json!({ "kind": "line", "from_mm": [0, 0, 0], "to_mm": [60, 0, 0] })),
        ("workpiece_frame", json!({ "xyz_mm": [600, 40, -50], "rpy_deg": [0, 0, 30] })),
        ("motion.sample_time_s", json!(0.001)),
        ("program.name", json!("PART")),
        ("shaper", json!("none")),
    ];
    all.extend(changes.iter().cloned());
    run(&all)
}

fn column(report: &Report, key: &str) -> Vec<f64> {
    report
        .series()
        .iter()
        .find(|series| series.key == key)
        .unwrap_or_else(|| panic!("{key}"))
        .values(0..report.samples())
}

fn vectors(report: &Report, key: &str) -> Vec<Vector3<f64>> {
    let [x, y, z] = ["x", "y", "z"].map(|axis| column(report, &key.replace('*', axis)));
    (0..x.len()).map(|k| Vector3::new(x[k], y[k], z[k])).collect()
}

fn text<'a>(files: &'a [PackageFile], ending: &str) -> &'a str {
    &files.iter().find(|file| file.path.ends_with(ending)).unwrap_or_else(|| panic!("{ending}")).text
}

fn rows(csv: &str) -> Vec<Vec<f64>> {
    let lines = csv.lines().filter(|line| !line.starts_with('#')).skip(1);
    lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
}

/// Every fourth sample, in the frame of the workpiece.
#[test]
fn the_table_is_what_is_commanded_less_what_is_desired() {
    let report = line(&[]);
    let csv = export(&report, "correction-csv", &ExportOptions::default()).unwrap().text;
    assert!(csv.contains("\ntime_s,s_mm,dx_mm,dy_mm,dz_mm,a_deg,b_deg,c_deg\n"), "{}", &csv[..2000]);
    let (desired, commanded) = (vectors(&report, "desired_*_mm"), vectors(&report, "compensated_*_mm"));
    let along = column(&report, "arc_length_mm");
    let (sin, cos) = (0.5, 0.75_f64.sqrt());
    let rows = rows(&csv);
    assert_eq!(rows.len(), (report.samples() - 1).div_ceil(4) + 1);
    for (row, cells) in rows.iter().enumerate() {
        let k = (4 * row).min(report.samples() - 1);
        let shift = commanded[k] - desired[k];
        let own = [cos * shift.x + sin * shift.y, cos * shift.y - sin * shift.x, shift.z];
        assert!(
            (cells[0] - 0.004 * row as f64).abs() < 1e-9 && (cells[1] - along[k]).abs() < 1e-4,
            "{cells:?}"
        );
        for axis in 0..3 {
            assert!((cells[2 + axis] - own[axis]).abs() < 1e-5, "row {row}: {cells:?} against {own:?}");
        }
        assert_eq!(cells[5..], [0.0; 3]);
    }
    assert!(rows.iter().any(|cells| cells[3].abs() > 0.01), "there is something to correct");
}

/// At a cycle that is no multiple of the sample time a row lies between two samples; the last one is at the end or after it.
#[test]
fn a_row_between_two_samples_is_between_their_corrections() {
    let report = line(&[("online.cycle_s", json!(0.0025))]);
    let table = CorrectionTable::of(&report);
    let into = report.setup().workpiece.inverse();
    let shift = |k: usize| into.direction(&report.compensation.correction[k.min(report.samples() - 1)]);
    let end = (report.samples() - 1) as f64 * 0.001;
    for (row, found) in table.rows.iter().enumerate() {
        let half = row % 2 == 1;
        let k = (5 * row) / 2;
        let expected = if half { (shift(k) + shift(k + 1)) / 2.0 } else { shift(k) };
        assert!((found.shift - expected).norm() < 1e-12, "row {row}");
    }
    let last = table.rows[table.rows.len() - 1].time;
    assert!(last >= end - 1e-9 && last < end + 0.0025, "{last} {end}");
}

/// With the tool axis brought onto its place, A, B and C turn the desired axis onto the commanded one.
#[test]
fn a_b_c_turn_the_desired_axis_onto_the_commanded_one() {
    let report = line(&[("compensation.at", json!("axis"))]);
    let table = CorrectionTable::of(&report);
    let back = report.setup().workpiece.inverse().rotation;
    let mut largest = 0.0_f64;
    for (row, found) in table.rows.iter().enumerate() {
        let k = (4 * row).min(report.samples() - 1);
        let desired = back * report.plan.trajectory.axis.at(k);
        let commanded = back * report.compensation.axis.at(k);
        let [a, b, c] = [0, 1, 2].map(|axis| found.turn[axis] * DEG);
        let turned = Pose::from_xyz_rpy(Vector3::zeros(), [c, b, a]).rotation * desired;
        assert!((turned - commanded).norm() < 1e-12, "row {row}: {turned} against {commanded}");
        largest = largest.max((commanded - desired).norm());
    }
    assert!(largest > 1e-5, "{largest}: there is something to turn");
}

/// What is added behind the shaper takes the tip where the corrected commands take it through the shaper, as the two simulated
/// runs have it; the place is where the shaped program has the tool.
#[test]
fn behind_a_shaper_the_shaped_correction_is_added() {
    let zvd = json!({ "kind": "zvd", "frequency_rad_s": 18, "damping": 0.1 });
    let report = line(&[("shaper", zvd), ("online.cycle_s", json!(0.001))]);
    let into = report.setup().workpiece.inverse();
    let shaped = report.plan.shaper().apply(&report.plan.trajectory.position, 0.001);
    let rows = CorrectionTable::of(&report).rows;
    let largest = rows.iter().map(|row| row.shift.norm()).fold(0.0, f64::max);
    let mut unshaped = 0.0_f64;
    for (k, row) in rows.iter().enumerate() {
        let moved = into.direction(&(report.after.actual[k] - report.before.actual[k]));
        assert!((moved - row.shift).norm() < 0.02 * largest, "sample {k}: {moved} against {}", row.shift);
        unshaped = unshaped.max((moved - into.direction(&report.compensation.correction[k])).norm());
        assert!((row.arc_length - into.point(&shaped[k]).x).abs() < 1e-9, "sample {k}");
    }
    assert!(unshaped > 0.5 * largest, "{unshaped} of {largest}: as it is commanded it would not do");
    let files = package(
        &line(&[("shaper", json!({ "kind": "zvd", "frequency_rad_s": 18, "damping": 0.1 }))]),
        Interface::Rsi,
    );
    assert!(text(&files.unwrap(), ".src").contains("which is shaped here already"));
}

/// Along x with the tool upright, tool z points down: y is across to the right and z is down.
#[test]
fn path_coordinates_are_a_right_handed_frame_along_the_feed() {
    let table = CorrectionTable::of(&line(&[]));
    for row in &table.rows {
        assert!(
            (row.across[0] + row.shift.y).abs() < 1e-12 && (row.across[1] + row.shift.z).abs() < 1e-12,
            "{row:?}"
        );
        assert!((row.along() - row.shift.x.abs()).abs() < 1e-9 && row.along() <= table.largest_along + 1e-12);
    }
    // Around a circle the frame turns with the feed.
    let circle = json!({ "kind": "circle", "center_mm": [0, 0, 0], "radius_mm": 20 });
    let report = line(&[("path", circle)]);
    let into = report.setup().workpiece.inverse();
    for (k, row) in CorrectionTable::of(&report).rows.iter().enumerate() {
        let k = (4 * k).min(report.samples() - 1);
        let heading = into.direction(&report.plan.trajectory.timing.heading[k]);
        let right = heading.cross(&Vector3::z());
        assert!((row.across[0] - row.shift.dot(&right)).abs() < 1e-12, "{row:?}");
        assert!((row.across[1] + row.shift.z).abs() < 1e-12);
    }
}

/// A move along the tool has no direction across: EGM cannot correct it, and says how much that is.
#[test]
fn a_plunge_is_left_out_by_egm() {
    let plunge = json!({ "kind": "polyline", "points_mm": [[0, 0, 30], [0, 0, 0], [40, 0, 0]] });
    let report = line(&[("path", plunge)]);
    let table = CorrectionTable::of(&report);
    let lost = table
        .rows
        .iter()
        .filter(|row| row.across == [0.0; 2])
        .map(|row| row.shift.norm())
        .fold(0.0, f64::max);
    assert!(lost > 0.0 && table.largest_along >= lost, "{lost} {}", table.largest_along);
    let files = package(&report, Interface::Egm).unwrap();
    let said =
        format!("Up to {} mm of the shift", armill::export::header::number(table.largest_along / MM, 4));
    assert!(text(&files, ".mod").contains(&said) && text(&files, ".mod").contains("as in a plunge"));
}

#[test]
fn rsi_files_fit_together_and_let_the_table_pass() {
    let report = line(&[("compensation.at", json!("axis"))]);
    let files = package(&report, Interface::Rsi).unwrap();
    let names: Vec<_> = files.iter().map(|file| file.path.as_str()).collect();
    assert_eq!(names, ["PART_RSI.src", "PART_RSI.rsix", "PART_RSI_ethernet.xml", "PART_correction.csv"]);
    for file in &files {
        assert!(file.text.is_ascii() && file.text.contains("UNTESTED on a controller"), "{}", file.path);
        assert!(file.text.contains(&report.fingerprint()), "{}", file.path);
        assert!(file.text.contains("begins to act 0.008 s after it is sent"), "{}", file.path);
    }
    let context = roxmltree::Document::parse(text(&files, ".rsix")).unwrap();
    let objects: Vec<_> =
        context.descendants().filter(|node| node.has_tag_name(("RsiDriver", "RsiObject"))).collect();
    let named =
        |kind: &str| *objects.iter().find(|object| object.attribute("ObjType") == Some(kind)).unwrap();
    let value = |kind: &str, name: &str| {
        let parameters = named(kind).descendants().filter(|node| node.attribute("Name") == Some(name));
        parameters.map(|node| node.attribute("ParamValue").unwrap().to_owned()).next().unwrap()
    };
    // Inputs come from objects that are there, the six channels in their order.
    let inputs: Vec<_> =
        named("PosCorr").descendants().filter(|node| node.attribute("InIdx").is_some()).collect();
    for (index, input) in inputs.iter().enumerate() {
        assert_eq!(input.attribute("InIdx"), Some(index.to_string().as_str()));
        assert_eq!(input.attribute("OutIdx"), Some(index.to_string().as_str()));
        assert_eq!(input.attribute("OutObjId"), named("Ethernet").attribute("ObjId"));
    }
    assert_eq!((inputs.len(), value("PosCorr", "RefCorrSys").as_str()), (6, "1"));
    // Names across the files.
    assert!(names.contains(&value("Ethernet", "ConfigFile").as_str()));
    let module = text(&files, ".src");
    assert!(
        module.starts_with("DEF PART_RSI( )") && module.contains("RSI_CREATE(\"PART_RSI\",CONTID,TRUE)"),
        "{module}"
    );
    assert!(module.contains("RSI_ON(#ABSOLUTE)") && module.contains("BAS (#BASE,1)"), "{module}");
    // The table passes the limits, which are not far above it.
    let table = CorrectionTable::of(&report);
    let limit = |kind: &str, name: &str| value(kind, name).parse::<f64>().unwrap();
    for row in &table.rows {
        for (axis, port) in ["X", "Y", "Z"].into_iter().enumerate() {
            let shift = row.shift[axis] / MM;
            assert!(shift > limit("PosCorr", &format!("LowerLim{port}")), "{row:?}");
            assert!(shift < limit("PosCorr", &format!("UpperLim{port}")), "{row:?}");
        }
        let [a, b, c] = [0, 1, 2].map(|axis| row.turn[axis] * DEG);
        let turned = Pose::from_xyz_rpy(Vector3::zeros(), [c, b, a]).rotation;
        assert!(angle(&turned) / DEG < limit("PosCorr", "MaxRotAngle"));
        assert!(row.shift.norm() / MM < limit("PosCorrMon", "MaxTrans"));
    }
    assert!(limit("PosCorr", "UpperLimX") < 1.25 * table.largest_component / MM + 1.0);
    // What the robot takes: RKorr.X to RKorr.C in channels 1 to 6.
    let ethernet = roxmltree::Document::parse(text(&files, "_ethernet.xml")).unwrap();
    let received = ethernet.descendants().find(|node| node.has_tag_name("RECEIVE")).unwrap();
    let elements = received.descendants().filter(|node| node.has_tag_name("ELEMENT"));
    let tags: Vec<_> =
        elements.map(|node| (node.attribute("TAG").unwrap(), node.attribute("INDX").unwrap())).collect();
    let expected = ["X", "Y", "Z", "A", "B", "C"].map(|port| format!("RKorr.{port}"));
    for (index, (tag, channel)) in tags.iter().enumerate() {
        assert_eq!((*tag, *channel), (expected[index].as_str(), (index + 1).to_string().as_str()));
    }
    assert_eq!(tags.len(), 6);
    // An answer is one element with the sender's name, the values of the row and the packet's number.
    let row = &table.rows[table.rows.len() / 2];
    let sent = answer(row, 77);
    let sent = roxmltree::Document::parse(&sent).unwrap();
    let korr = sent.descendants().find(|node| node.has_tag_name("RKorr")).unwrap();
    let sender = ethernet.descendants().find(|node| node.has_tag_name("SENTYPE")).unwrap();
    assert_eq!(sent.root_element().attribute("Type"), sender.text());
    assert!((korr.attribute("Y").unwrap().parse::<f64>().unwrap() - row.shift.y / MM).abs() < 1e-6);
    assert!((korr.attribute("B").unwrap().parse::<f64>().unwrap() - row.turn[1]).abs() < 1e-6);
    assert_eq!(sent.descendants().find(|node| node.has_tag_name("IPOC")).unwrap().text(), Some("77"));
}

/// Angle of a rotation [rad].
fn angle(rotation: &Matrix3<f64>) -> f64 {
    let twice = Vector3::new(
        rotation[(2, 1)] - rotation[(1, 2)],
        rotation[(0, 2)] - rotation[(2, 0)],
        rotation[(1, 0)] - rotation[(0, 1)],
    );
    armill::math::atan2(twice.norm(), rotation.trace() - 1.0)
}

#[test]
fn egm_files_shift_across_the_path() {
    let report = line(&[]);
    let files = package(&report, Interface::Egm).unwrap();
    let names: Vec<_> = files.iter().map(|file| file.path.as_str()).collect();
    assert_eq!(names, ["PART_EGM.mod", "PART_EGM_correction.csv", "PART_correction.csv"]);
    let module = text(&files, ".mod");
    for piece in [
        "MODULE PART_EGM\n",
        "\\PathCorr \\APTR;",
        "EGMActMove egmId1, tMill.tframe \\SampleRate:=48;",
        "ENDMODULE",
    ] {
        assert!(module.contains(piece), "{piece}\n{module}");
    }
    let table = CorrectionTable::of(&report);
    for (cells, row) in rows(text(&files, "_EGM_correction.csv")).iter().zip(&table.rows) {
        assert!((cells[2] - row.across[0] / MM).abs() < 1e-5 && (cells[3] - row.across[1] / MM).abs() < 1e-5);
    }
}

#[test]
fn what_cannot_be_added_is_refused() {
    let error = Interface::named("fanuc-dpm").unwrap_err().to_string();
    assert!(
        error.contains("interface") && error.contains("kuka-rsi") && error.contains("abb-egm"),
        "{error}"
    );
    let error =
        package(&line(&[("compensation.max_passes", json!(0))]), Interface::Rsi).unwrap_err().to_string();
    assert!(error.contains("no correction"), "{error}");
    for (interface, cycle, legal) in
        [(Interface::Rsi, 0.008, "0.004 or 0.012"), (Interface::Egm, 0.05, "0.048 or less")]
    {
        let error = package(&line(&[("online.cycle_s", json!(cycle))]), interface).unwrap_err();
        assert_eq!(error.field(), Some("online.cycle_s"));
        assert!(error.to_string().contains(legal), "{error}");
    }
    // The module's name is the program's with an ending.
    let long =
        line(&[("program.name", json!("A_NAME_OF_24_CHARACTERS_")), ("program.controller", json!("kuka"))]);
    let error = package(&long, Interface::Rsi).unwrap_err();
    assert_eq!(error.field(), Some("program.name"), "{error}");
}
