//! The placement map against whole runs: equal errors, equal limits, equal reach.

use crate::common::job_text;
use armill::Job;
use armill::placement::{PlacementMap, PlacementStatus};
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
    let mut seen = [0; 4];
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
                    }
                    PlacementStatus::Singular => {
                        assert!(has(&[
                            "singularity-wrist",
                            "singularity-elbow",
                            "singularity-shoulder",
                            "joint-jump"
                        ]));
                    }
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
