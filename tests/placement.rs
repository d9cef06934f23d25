//! The placement map against whole runs: equal errors, equal limits, equal reach.

use crate::common::job_text;
use armill::Job;
use armill::math::Pose;
use armill::placement::{PartBox, PlacementMap, PlacementStatus, RobotBase};
use armill::units::DEG;
use nalgebra::Vector3;
use serde_json::{Value, json};

fn job(place: [f64; 3], changes: &[(&str, Value)]) -> Job {
    let mut all = vec![
        (
            "path",
            json!({"kind":"rectangle","center_mm":[100,0,0],"width_mm":200,"height_mm":150,"corner_radius_mm":30}),
        ),
        ("base_frame", json!({"xyz_mm":[100,-50,300],"rpy_deg":[0,0,90]})),
        ("workpiece_frame", json!({"xyz_mm":place,"rpy_deg":[5,0,80]})),
        ("tool_frame", json!({"xyz_mm":[0,0,120],"rpy_deg":[0,30,0]})),
        ("shaper", json!("none")),
        ("motion.sample_time_s", json!(0.002)),
    ];
    all.extend(changes.iter().cloned());
    Job::from_json(&job_text(&all)).unwrap()
}

#[test]
fn every_place_is_what_a_whole_run_there_says() {
    let survey = PlacementMap::new(&job([0.0, 500.0, 400.0], &[])).unwrap();
    let mut seen = [0; 5];
    for x in [-900.0, -300.0, 100.0, 500.0] {
        for y in [-400.0, 300.0, 600.0, 1000.0] {
            for z in [250.0, 500.0] {
                let place = survey.at(Vector3::new(x, y, z) * 1e-3);
                seen[place.status as usize] += 1;
                let run = match armill::run(&job([x, y, z], &[]), &mut armill::Progress::none()) {
                    Ok(run) => run,
                    Err(error) => {
                        assert_eq!(place.status, PlacementStatus::Unreachable, "{x}, {y}, {z}: {error}");
                        assert!(place.max.is_nan());
                        continue;
                    }
                };
                let has = |codes: &[&str]| run.warnings.iter().any(|warning| codes.contains(&warning.code));
                let summary = run.summary().before_mm.deflection;
                let apart = (place.max / 1e-3 - summary.max).abs();
                match place.status {
                    PlacementStatus::Good | PlacementStatus::Limit => {
                        assert!(apart < 0.02 * summary.max, "{x}, {y}, {z}: {place:?} and {summary:?}");
                        // Ramps and corners take longer in time than along the path.
                        assert!((place.mean / 1e-3 - summary.mean).abs() < 0.1 * summary.mean);
                        // The stations and draws that are left out make it up to 3.5 % low, what the
                        // compensation leaves of the nominal error up to 1.3 % high.
                        let p95 = run.band.after.p95;
                        assert!((place.p95 / p95 - 1.0).abs() < 0.05, "{x}, {y}, {z}: {place:?}, {p95}");
                    }
                    PlacementStatus::Singular => {
                        assert!(has(&[
                            "singularity-wrist",
                            "singularity-elbow",
                            "singularity-shoulder",
                            "joint-jump"
                        ]));
                    }
                    PlacementStatus::InBase => {}
                    PlacementStatus::Unreachable => panic!("{x}, {y}, {z} can be run"),
                }
                // Compensation may push a command out of a range that the desired path just keeps,
                // never the other way round.
                assert!(place.status != PlacementStatus::Limit || has(&["joint-limit"]), "{x}, {y}, {z}");
            }
        }
    }
    assert!(seen[0] > 3 && seen[2] > 0 && seen[3] > 3, "the map has every kind of place: {seen:?}");
}

/// A bracket with drilled holes: the largest force acts in plunges that are shorter than the distance of
/// even stations.
#[test]
fn short_stretches_of_large_force_count() {
    let opening = Job::opening().unwrap();
    let survey = PlacementMap::new(&opening).unwrap();
    for [x, y] in [[1900.0, -40.0], [1125.0, -520.0], [1600.0, 600.0]] {
        let place = survey.at(Vector3::new(x, y, 700.0) * 1e-3);
        let mut there = opening.clone();
        there.workpiece_frame.xyz_mm = [x, y, 700.0];
        let run = armill::run(&there, &mut armill::Progress::none()).unwrap();
        let whole = run.summary().before_mm.deflection.max;
        // Even stations alone are 55 % off.
        assert!(
            (place.max / 1e-3 / whole - 1.0).abs() < 0.05,
            "{x}, {y}: {} of {whole} mm",
            place.max / 1e-3
        );
        // Of 121 stations few are in a cut, and plants that are screened out count: up to 10 % low.
        let p95 = run.band.after.p95;
        assert!((place.p95 / p95 - 1.0).abs() < 0.12, "{x}, {y}: {} of {p95} m", place.p95);
    }
}

#[test]
fn the_present_place_is_on_the_map_and_the_extent_holds_all_that_can_be_reached() {
    let survey = PlacementMap::new(&job([0.0, 500.0, 400.0], &[])).unwrap();
    let [x, y, z] = survey.extent();
    let inside =
        |p: Vector3<f64>| [x, y, z].iter().zip(p.iter()).all(|([low, high], p)| (low..=high).contains(&p));
    assert!(inside(Vector3::new(0.0, 0.5, 0.4)));
    let mut reached = 0;
    for i in -8..=8 {
        for k in -8..=8 {
            let place = Vector3::new(f64::from(i) * 0.25, f64::from(k) * 0.25, 0.4);
            if survey.at(place).status != PlacementStatus::Unreachable {
                reached += 1;
                assert!(inside(place), "{place}");
            }
        }
    }
    assert!(reached > 5);
}

/// Bodies at random against their points: one is in the cylinder if a point of it is, and only if one is
/// in a slightly wider cylinder.
#[test]
fn a_part_is_in_the_base_where_its_points_are() {
    let mut random = fastrand::Rng::with_seed(11);
    let mut number = |size: f64| (random.f64() * 2.0 - 1.0) * size;
    let mut seen = [0; 3];
    for _ in 0..600 {
        let mut place = |size: f64, tilt: f64| {
            let at = Vector3::from_fn(|_, _| number(size));
            Pose::from_xyz_rpy(at, [number(tilt), number(tilt), number(3.0)])
        };
        let (frame, part) = (place(0.3, 0.2), place(1.0, 1.0));
        let base = RobotBase { frame, radius: 0.4, height: 0.6, floor: None };
        let high = Vector3::new(0.1 + number(0.1), 0.3 + number(0.2), 0.2);
        let body = PartBox { low: -high, high };
        let corners = body.corners().map(|corner| part.point(&corner));
        let points = (0..8000).map(|n| {
            let share = Vector3::new(n % 20, n / 20 % 20, n / 400).map(|k| f64::from(k) / 9.5 - 1.0);
            frame.inverse().point(&part.point(&share.component_mul(&high)))
        });
        let held = |wider: f64| {
            points.clone().any(|p| p.xy().norm() < base.radius + wider && p.z < base.height + wider)
        };
        let found = base.is_in(&corners);
        assert!(found || !held(-0.001), "{base:?} {corners:?}");
        // A body beside the upper edge counts as in it: the tests of the sides and the top are apart.
        seen[usize::from(found)] += 1;
        if found && !held(0.04) {
            seen[2] += 1;
        }
    }
    assert!(seen[0] > 50 && seen[1] > 50 && seen[2] * 10 < seen[1], "{seen:?}");
}

#[test]
fn the_part_is_its_stock_or_the_moves_that_cut() {
    let near = |a: &[Vector3<f64>; 8], low: [f64; 3], high: [f64; 3]| {
        let wanted = PartBox { low: Vector3::from(low), high: Vector3::from(high) }.corners();
        for (a, b) in a.iter().zip(wanted) {
            assert!((a - b).norm() < 1e-9, "{a} is not {b}");
        }
    };
    let (square, place) = (json!({"xyz_mm":[0,500,400],"rpy_deg":[0,0,0]}), [0.0, 500.0, 400.0]);
    let flat = job(place, &[("workpiece_frame", square.clone())]);
    near(PlacementMap::new(&flat).unwrap().part(), [0.0, -0.075, 0.0], [0.2, 0.075, 0.0]);
    // A quarter turn about z: x of the part along the cell's y.
    let turned = job(place, &[("workpiece_frame", json!({"xyz_mm":[0,500,400],"rpy_deg":[0,0,90]}))]);
    for (corner, flat) in
        PlacementMap::new(&turned).unwrap().part().iter().zip(PlacementMap::new(&flat).unwrap().part())
    {
        assert!((corner - Vector3::new(-flat.y, flat.x, flat.z)).norm() < 1e-9);
    }
    // A program's rapid moves are not the part; its stock is.
    let program =
        json!({"kind":"gcode","text":"G21 G90\nG0 X300 Y0 Z150\nG1 Z5 F600\nX100 Y50\nG0 Z150\nM30"});
    let cut = job(place, &[("path", program.clone()), ("workpiece_frame", square.clone())]);
    near(PlacementMap::new(&cut).unwrap().part(), [0.1, 0.0, 0.005], [0.3, 0.05, 0.15]);
    let stock = json!({"kind":"box","from_mm":[90,-20,0],"to_mm":[320,80,10]});
    let stocked = job(place, &[("path", program), ("workpiece_frame", square), ("stock", stock)]);
    near(PlacementMap::new(&stocked).unwrap().part(), [0.09, -0.02, 0.0], [0.32, 0.08, 0.01]);
}

/// A turn of the tool on the map is the job with that spin.
#[test]
fn a_turned_tool_is_the_job_with_that_spin() {
    let at = Vector3::new(0.1, 0.6, 0.5);
    let survey = PlacementMap::new(&job([0.0, 500.0, 400.0], &[])).unwrap();
    for degrees in [-170.0, -40.0, 0.0, 25.0, 180.0] {
        let spun = job([0.0, 500.0, 400.0], &[("spin.angle_deg", json!(degrees))]);
        let (here, there) = (survey.turned(degrees * DEG).at(at), PlacementMap::new(&spun).unwrap().at(at));
        assert_eq!(format!("{here:?}"), format!("{there:?}"), "{degrees}");
    }
}
