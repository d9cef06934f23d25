//! A stock in the job: what it changes and what not, what is refused, how it is followed.
#![allow(clippy::disallowed_methods, reason = "independent values come from the standard library")]

use crate::common;
use crate::common::in_stock::{job, plate};
use crate::common::{column, refused, run};
use armill::Report;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

const SLOT: &str = "G21 G90\nG0 X-20 Y0 Z5\nG1 Z-3 F300\nG1 X20 F600\nG0 Z5\n";

fn summary(report: &Report) -> Value {
    serde_json::to_value(report.summary()).unwrap()
}

/// The largest value of a column.
fn most(report: &Report, key: &str) -> f64 {
    column(report, key).into_iter().fold(f64::MIN, f64::max)
}

/// A slot in the stock is the stated slot: the same force where the tool is at speed in full material.
#[test]
fn a_slot_in_a_stock_has_the_force_of_a_stated_slot() {
    let stated = json!({
        "engagement":"slot","axial_depth_mm":3,"spindle_rpm":8000,"feed_per_tooth_mm":"from_feed"
    });
    let uncoupled = json!({"spindle_rpm":8000,"feed_per_tooth_mm":"from_feed","coupling":"none"});
    let report = run(&job(SLOT, plate(), &[("cutting", uncoupled)]));
    let other = run(&job(SLOT, plate(), &[("cutting", stated)]));
    assert!(other.setup().contacts.is_none());
    let place = |report: &Report| {
        let x = column(report, "desired_x_mm");
        let z = column(report, "desired_z_mm");
        let speed = column(report, "feed_mm_s");
        (0..x.len())
            .find(|&k| (x[k] - 1800.0).abs() < 5.0 && z[k] < 698.0 && (speed[k] - 10.0).abs() < 1e-9)
            .unwrap()
    };
    let (a, b) = (place(&report), place(&other));
    for axis in ["x", "y", "z"] {
        let key = format!("force_{axis}_n");
        let (in_stock, slot) = (column(&report, &key)[a], column(&other, &key)[b]);
        assert!((in_stock - slot).abs() < 1e-9 * slot.abs().max(1.0), "{key}: {in_stock} {slot}");
    }
    assert_eq!(column(&report, "engaged_deg")[a], 180.0);
    assert!((column(&report, "radial_depth_mm")[a] - 10.0).abs() < 1e-9);
    assert!((column(&report, "axial_depth_mm")[a] - 3.0).abs() < 1e-9);
    // 10 mm by 3 mm at 600 mm/min.
    assert!((column(&report, "removal_cm3_min")[a] - 18.0).abs() < 1e-9);
    let cut = &summary(&report)["cut"];
    // The slot with its two round ends.
    let volume = 3.0 * (10.0 * 40.0 + std::f64::consts::PI * 25.0) / 1e3;
    assert!((cut["removed_cm3"].as_f64().unwrap() / volume - 1.0).abs() < 5e-3, "{cut}");
    assert_eq!(cut["largest_engaged_deg"], 180.0);
}

/// With the engagement stated, a stock changes no bit.
#[test]
fn a_stated_engagement_does_not_ask_the_stock() {
    let stated = (
        "cutting",
        json!({"engagement":"slot","axial_depth_mm":3,"spindle_rpm":8000,"feed_per_tooth_mm":0.025}),
    );
    let with = run(&job(SLOT, plate(), std::slice::from_ref(&stated)));
    let without = run(&job(SLOT, json!({"kind":"none"}), &[stated]));
    assert_eq!(with.fingerprint(), without.fingerprint());
    assert!(summary(&with)["cut"].get("removed_cm3").is_none());
}

/// A plunge pushes the tool up by N R (K_rc c + K_re), by hand from the table's numbers.
#[test]
fn a_plunge_pushes_the_tool_up() {
    let report = run(&job(SLOT, plate(), &[]));
    let z = column(&report, "desired_z_mm");
    let speed = column(&report, "feed_mm_s");
    let place = (0..z.len()).find(|&k| (z[k] - 698.5).abs() < 0.3 && (speed[k] - 5.0).abs() < 1e-9).unwrap();
    let chip = 5.0 / (3.0 * 8000.0 / 60.0);
    let expected = 3.0 * 5.0 * (168.8 * chip + 26.6);
    let force = column(&report, "force_z_n")[place];
    assert!((force / expected - 1.0).abs() < 1e-9, "{force} {expected}");
}

/// A round tool that plunges cuts with its corner: as much as it sweeps, and as on the map of heights, which finds
/// the corner in its own way. The map is taken by a program that also ramps, in the air.
#[test]
fn a_round_tool_plunges_with_its_corner() {
    let plunge = "G0 X0 Y0 Z5\nG1 Z-9 F600\nG0 Z5\n";
    let texts = ["", "G0 X-40 Y-40 Z5\nG1 Z2 F600\nX40 Z1\nX-40 Z2\nG0 Z5\n"];
    for corner in [json!("ball"), json!(1.5)] {
        let tool = json!({"diameter_mm":10,"flutes":3,"helix_deg":30,"corner_radius_mm":corner});
        let [exact, mapped] = texts.map(|before| {
            let text = format!("G21 G90\n{before}{plunge}");
            let report = run(&job(&text, plate(), &[("tool", tool.clone())]));
            let (z, speed) = (column(&report, "desired_z_mm"), column(&report, "feed_mm_s"));
            let cuts = column(&report, "removal_cm3_min");
            let k = (0..z.len()).rfind(|&k| cuts[k] > 0.0 && z[k] > 692.0 && speed[k] == 10.0).unwrap();
            (report.setup().contacts.as_ref().unwrap().cell, report.force[k], cuts[k])
        });
        assert!(exact.0.is_none() && mapped.0.is_some());
        // pi 5^2 mm^2 at 10 mm/s; the corner is seen in slices.
        let swept = std::f64::consts::PI * 25.0 * 10.0 * 60e-3;
        assert!((exact.2 / swept - 1.0).abs() < 1e-3, "{corner}: {} {swept}", exact.2);
        assert!(
            (exact.1 - mapped.1).norm() < 0.01 * mapped.1.norm(),
            "{corner}: {:?} {:?}",
            exact.1,
            mapped.1
        );
        assert!(exact.1.z > 100.0 && exact.1.xy().norm() < 1e-6 * exact.1.z);
    }
}

#[test]
fn kinds_of_stock_that_are_the_same_give_the_same() {
    let outline = json!({"kind":"outline","points_mm":[[-50,-50],[50,-50],[50,50],[-50,50]],"bottom_mm":-20,"top_mm":0});
    let first = run(&job(SLOT, plate(), &[])).fingerprint();
    assert_eq!(run(&job(SLOT, outline, &[])).fingerprint(), first);
    // Around the tool's axis with its diameter: the slot is in full material.
    let extents = run(&job(SLOT, json!({"kind":"extents"}), &[]));
    assert_eq!(most(&extents, "engaged_deg"), 180.0);
    assert!((most(&extents, "radial_depth_mm") - 10.0).abs() < 1e-9);
    let bar =
        run(&job(SLOT, json!({"kind":"cylinder","center_mm":[0,0,-20],"radius_mm":50,"height_mm":20}), &[]));
    assert_eq!(most(&bar, "engaged_deg"), 180.0);
}

/// A box of twelve triangles [mm], as text and as bytes.
fn stl() -> (String, String) {
    let (low, high) = ([-50.0_f32, -50.0, -20.0], [50.0_f32, 50.0, 0.0]);
    let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { low[axis] } else { high[axis] });
    let faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let triangles = faces.iter().flat_map(|face| [[face[0], face[1], face[2]], [face[0], face[2], face[3]]]);
    let (mut text, mut bytes) = (String::from("solid box\n"), vec![0_u8; 80]);
    bytes.extend(12_u32.to_le_bytes());
    for triangle in triangles {
        text += "facet normal 0 0 1\nouter loop\n";
        bytes.extend([0.0_f32, 0.0, 1.0].iter().flat_map(|x| x.to_le_bytes()));
        for [x, y, z] in triangle.map(corner) {
            text += &format!("vertex {x} {y} {z}\n");
            bytes.extend([x, y, z].iter().flat_map(|x| x.to_le_bytes()));
        }
        text += "endloop\nendfacet\n";
        bytes.extend([0, 0]);
    }
    (text + "endsolid box\n", STANDARD.encode(bytes))
}

#[test]
fn a_mesh_is_followed_on_a_map() {
    let (text, binary) = stl();
    let exact = run(&job(SLOT, plate(), &[]));
    let from_text = run(&job(SLOT, json!({"kind":"stl","stl":text}), &[]));
    let from_bytes = run(&job(SLOT, json!({"kind":"stl","stl":binary}), &[]));
    assert_eq!(from_text.fingerprint(), from_bytes.fingerprint());
    let removed = |report: &Report| summary(report)["cut"]["removed_cm3"].as_f64().unwrap();
    assert!((removed(&from_text) / removed(&exact) - 1.0).abs() < 0.02);
    assert!(summary(&from_text)["cut"]["stock_cell_mm"].as_f64().unwrap() > 0.0);
    assert!(summary(&exact)["cut"].get("stock_cell_mm").is_none());
}

#[test]
fn an_earlier_program_comes_from_the_job() {
    let earlier = json!([{"text": SLOT, "diameter_mm": 10}]);
    let mut stock = plate();
    stock["earlier"] = earlier;
    let report = run(&job(SLOT, stock, &[]));
    assert_eq!(most(&report, "engaged_deg"), 0.0);
    assert_eq!(summary(&report)["cut"]["air_share"], 1.0);
    assert_eq!(summary(&report)["cut"]["removed_cm3"], 0.0);
}

/// A tilted tool is not followed: the stated engagement holds, and a warning says so.
#[test]
fn a_tilted_tool_keeps_the_stated_engagement() {
    let path = json!({"kind":"csv","text":"x,y,z,i,j,k\n-20,0,-3,0.1,0,1\n20,0,-3,0.1,0,1\n"});
    let report = run(&job(SLOT, plate(), &[("path", path)]));
    assert!(report.setup().contacts.is_none());
    assert!(report.warnings.iter().any(|warning| warning.code == "stock-unused"));
}

#[test]
fn mistakes_are_named() {
    let field = |stock: Value| refused(&job(SLOT, stock, &[])).field().unwrap().to_owned();
    assert_eq!(field(json!({"kind":"box","from_mm":[0,0,0]})), "stock.to_mm");
    assert_eq!(field(json!({"kind":"box","from_mm":[0,0,0],"to_mm":[1,1,-1]})), "stock.to_mm[2]");
    assert_eq!(
        field(json!({"kind":"box","from_mm":[0,0,0],"to_mm":[1,1,1],"radius_mm":3})),
        "stock.radius_mm"
    );
    assert_eq!(
        field(json!({"kind":"cylinder","center_mm":[0,0,0],"radius_mm":0,"height_mm":3})),
        "stock.radius_mm"
    );
    assert_eq!(
        field(json!({"kind":"outline","points_mm":[[0,0],[1,1]],"bottom_mm":0,"top_mm":1})),
        "stock.points_mm"
    );
    assert_eq!(
        field(json!({"kind":"outline","points_mm":[[0,0],[1,0],[1,1]],"bottom_mm":0,"top_mm":0})),
        "stock.top_mm"
    );
    assert_eq!(field(json!({"kind":"stl","stl":"solid nothing\nendsolid"})), "stock.stl");
    assert_eq!(field(json!({"kind":"stl","stl":"*"})), "stock.stl");
    assert_eq!(field(json!({"kind":"ball"})), "stock.kind");
    assert_eq!(
        field(
            json!({"kind":"box","from_mm":[0,0,0],"to_mm":[1,1,1],"earlier":[{"text":"G1 X","diameter_mm":3}]})
        ),
        "stock.earlier[0].text"
    );
    // What earlier programs have cut is read even where the engagement is stated, and needs a stock.
    assert_eq!(field(json!({"kind":"none","earlier":[{"text":SLOT,"diameter_mm":3}]})), "stock.kind");
    let mut unused = plate();
    unused["earlier"] = json!([{"text":SLOT,"diameter_mm":0}]);
    let slot = ("cutting", json!({"engagement":"slot","axial_depth_mm":3}));
    assert_eq!(refused(&job(SLOT, unused, &[slot])).field(), Some("stock.earlier[0].diameter_mm"));
    let asked = ("cutting", json!({"engagement":"from-stock"}));
    assert_eq!(refused(&job(SLOT, json!({"kind":"none"}), &[asked])).field(), Some("stock.kind"));
    // A program above zero: where is the top?
    let above = ("path", json!({"kind":"gcode","text":SLOT.replace("Z-3", "Z3")}));
    assert_eq!(refused(&job(SLOT, json!({"kind":"extents"}), &[above])).field(), Some("stock.top_mm"));
}

/// Rapid moves through material, a stock higher than the flutes, a spindle too weak: by line.
#[test]
fn what_must_not_be_met_is_said_with_its_line() {
    let warnings = |text: &str, more: &[(&'static str, Value)]| {
        let report = run(&job(text, plate(), more));
        let found: Vec<_> =
            report.warnings.iter().map(|w| (w.code, w.message.clone(), w.spans_s.len())).collect();
        move |code: &str| {
            found
                .iter()
                .find(|(known, ..)| *known == code)
                .map(|(_, message, spans)| (message.clone(), *spans))
        }
    };
    // Down, along and up again: all is in the air or cut before.
    let fine = "G21 G90\nG0 X-20 Y0 Z5\nG1 Z-3 F300\nG1 X20 F600\nG0 Z5\nG0 X-20\nZ-3\nG0 X20\nZ5\n";
    assert_eq!(warnings(fine, &[])("rapid-in-stock"), None);
    // Across what was not cut, and down into it.
    let crash = "G21 G90\nG0 X-20 Y0 Z5\nG1 Z-3 F300\nG1 X20 F600\nG0 Y10\nG0 Z5\nX-20\nZ-1\n";
    let (message, spans) = warnings(crash, &[])("rapid-in-stock").unwrap();
    assert!(message.starts_with("line 5: ") && message.contains("in 2 other moves"), "{message}");
    // The way up lies in what the rapid move did not clear, and follows it.
    assert_eq!(spans, 2);
    let short = json!({"diameter_mm":10,"flutes":3,"helix_deg":30,"flute_length_mm":2});
    let (message, _) = warnings(SLOT, &[("tool", short)])("shank-in-stock").unwrap();
    assert!(message.starts_with("line 4: "), "{message}");
    let enough = json!({"diameter_mm":10,"flutes":3,"helix_deg":30,"flute_length_mm":3});
    assert_eq!(warnings(SLOT, &[("tool", enough)])("shank-in-stock"), None);
    let weak = json!({"spindle_rpm":8000,"feed_per_tooth_mm":"from_feed","spindle_power_kw":0.1});
    let (message, spans) = warnings(SLOT, &[("cutting", weak)])("spindle-power").unwrap();
    assert!(message.contains("up to") && spans > 0, "{message}");
    // The same on a map of heights.
    let on_map = |text: &str| {
        let report = run(&job(text, json!({"kind":"stl","stl":stl().0}), &[]));
        report.warnings.iter().any(|warning| warning.code == "rapid-in-stock")
    };
    assert!(!on_map(fine) && on_map(crash));
}

/// A stock beside the program, as one from another job: nothing is cut, so no tolerance is met. With the
/// program's own extents instead there is a cut.
#[test]
fn a_stock_that_is_never_touched_is_said_first() {
    let beside = json!({"kind":"box","from_mm":[400,0,-20],"to_mm":[500,100,0]});
    let text = job(SLOT, beside, &[]);
    let report = run(&text);
    assert_eq!(report.mean_force().norm(), 0.0);
    let warning = report.warnings.iter().find(|warning| warning.code == "stock-untouched").unwrap();
    assert_eq!(report.verdict_state(), armill::report::VerdictState::NotMet);
    assert!(report.verdict().starts_with("Nothing is cut"), "{}", report.verdict());
    let remedy = warning.remedy.as_ref().unwrap();
    assert_eq!(remedy.patch["stock"]["from_mm"], Value::Null);
    let cured = remedy.applied(&armill::Job::from_json(&common::job_text(&text)).unwrap()).unwrap();
    let mut bare = cured.clone();
    bare.stock = armill::job::Stock::default();
    assert_eq!(Some(&cured.stock), armill::setup::proposed_stock(&bare).unwrap().as_ref(), "no key is left");
    let report = armill::run(&cured, &mut armill::Progress::none()).unwrap();
    assert!(report.mean_force().norm() > 0.0);
    assert!(report.warnings.iter().all(|warning| warning.code != "stock-untouched"));
    // A corner of the stock in the tool's way is enough for a cut.
    let corner = json!({"kind":"box","from_mm":[18,0,-20],"to_mm":[500,100,0]});
    assert!(run(&job(SLOT, corner, &[])).warnings.iter().all(|warning| warning.code != "stock-untouched"));
}

/// A tool of 0.2 mm on a block of half a metre: four million cells are wide for it, and it is said.
#[test]
fn a_map_too_coarse_for_the_tool_says_so() {
    let ramps = "G21 G90\nG0 X0 Y0 Z0\nG1 X3 Z-0.1 F300\nX0 Z-0.2\n";
    let wide = json!({"kind":"box","from_mm":[-250,-250,-5],"to_mm":[250,250,0]});
    let tool = ("tool", json!({"diameter_mm":0.2,"flutes":2,"helix_deg":30,"corner_radius_mm":0.05}));
    let coarse = |stock: Value| {
        let report = run(&job(ramps, stock, std::slice::from_ref(&tool)));
        report.warnings.iter().any(|warning| warning.code == "stock-coarse")
    };
    assert!(coarse(wide));
    assert!(!coarse(json!({"kind":"box","from_mm":[-1,-1,-5],"to_mm":[4,1,0]})));
}

/// The top of the cut is where the material ends at that place, not where it does elsewhere: past a
/// step of the stock, the tilt counts over the lower height only.
#[test]
fn the_wall_is_as_high_as_the_material_there() {
    let low = json!({"kind":"box","from_mm":[-50,-50,-20],"to_mm":[50,50,-2]});
    let report = run(&job(SLOT, low, &[]));
    let setup = report.setup();
    let index = setup.path.moves().iter().position(|step| step.segment.length() > 0.039).unwrap();
    assert!((setup.axial_depth_at((index, 0.02)) - 1e-3).abs() < 1e-12);
    assert_eq!(setup.axial_depth_at((0, 1e-3)), 0.0);
    // Half a slot, then air: no wall there.
    let half = json!({"kind":"box","from_mm":[-50,-50,-20],"to_mm":[0,50,0]});
    let report = run(&job(SLOT, half, &[]));
    assert_eq!(report.setup().axial_depth_at((index, 0.035)), 0.0);
}

/// The drawn revolution is that of the heaviest place: its mean is the mean force, its largest the peak.
#[test]
fn the_revolution_is_that_of_the_heaviest_place() {
    let text = "G21 G90\nG0 X-20 Y0 Z5\nG1 Z-3 F300\nG1 X20 F600\nY3\nX-20\nG0 Z5\n";
    for tool in [
        json!({"diameter_mm":10,"flutes":3,"helix_deg":30}),
        json!({"diameter_mm":10,"flutes":2,"corner_radius_mm":2}),
    ] {
        let report = run(&job(text, plate(), &[("tool", tool)]));
        let (_, forces) = report.revolution(7200);
        let mean = forces[1..].iter().sum::<nalgebra::Vector3<f64>>() / 7200.0;
        let expected = report.mean_force();
        assert!((mean - expected).norm() < 2e-3 * expected.norm(), "{mean:?} {expected:?}");
        let largest = forces.iter().map(|force| force.norm()).fold(0.0, f64::max);
        assert!((report.peak_force() / largest - 1.0).abs() < 5e-3, "{} {largest}", report.peak_force());
    }
}

/// A path of more moves than are followed at once is given no stock unasked.
#[test]
fn a_stock_is_proposed_for_what_can_be_followed() {
    let points = |count: usize| {
        let rows = (0..=count).map(|k| format!("{},{},-1\n", k / 1000, k % 1000)).collect::<String>();
        let changes = job(
            "",
            json!({"kind":"none"}),
            &[("path", json!({"kind":"csv","text":format!("x,y,z\n{rows}")}))],
        );
        armill::Job::from_json(&common::job_text(&changes)).unwrap()
    };
    assert!(armill::setup::proposed_stock(&points(1000)).unwrap().is_some());
    assert!(armill::setup::proposed_stock(&points(300_000)).unwrap().is_none());
}
