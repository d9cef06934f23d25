//! Evidence: what is said of measured data, found a second way.

use armill::Job;
use armill::evidence::{self, Evidence, slots};
use armill::identify::{Convention, gear, measurement, stiffness};
use armill::units::MM;
use nalgebra::Vector3;

const LOADS: &str = include_str!("../web/examples/identify-fanuc-r2000ic.csv");
const ROBOT: &str = include_str!("../web/examples/identify-fanuc-r2000ic.json");
const A: &str = include_str!("../web/examples/gear-kuka-kr300-a.csv");
const B: &str = include_str!("../web/examples/gear-kuka-kr300-b.csv");

fn curve<'a>(evidence: &'a Evidence, key: &str) -> &'a [f64] {
    &evidence.curves.iter().find(|curve| curve.key == key).unwrap().values
}

/// Each row left out of the text, the others fitted, and the springs of that fit put under its load.
#[test]
fn a_loaded_posture_is_predicted_from_the_others_alone() {
    let job = Job::from_json(ROBOT).unwrap();
    let found = evidence::loads(&job, LOADS).unwrap();
    let robot = armill::setup::robot(&job).unwrap();
    let rows = measurement::read(LOADS, Convention::CoupledJ3).unwrap().rows;
    let mut expected = Vec::new();
    for (left_out, row) in rows.iter().enumerate() {
        let others: Vec<_> =
            rows.iter().enumerate().filter(|(k, _)| *k != left_out).map(|(_, row)| row.clone()).collect();
        let compliance = stiffness::fit(&robot, &others).unwrap().compliance();
        let moved = stiffness::equations(&robot, row).into_iter().map(|(a, measured)| {
            let predicted = (0..6).map(|joint| a[joint] * compliance[joint]).sum::<f64>();
            [measured * measured, predicted * predicted, (measured - predicted).powi(2)]
        });
        let sums = moved.fold([0.0; 3], |sum, own| [0, 1, 2].map(|k| sum[k] + own[k]));
        expected.push(sums.map(|sum| sum.sqrt() / MM));
    }
    expected.sort_by(|a, b| a[0].total_cmp(&b[0]));
    assert_eq!((found.rows.len(), found.at.len()), (43, 43));
    for (k, [measured, predicted, miss]) in expected.iter().enumerate() {
        for (key, value) in [("measured", measured), ("predicted", predicted), ("miss", miss)] {
            assert!((curve(&found, key)[k] - value).abs() < 1e-9, "{key} of row {k}");
        }
        assert!((found.rows[k].values[3] - 100.0 * miss / measured).abs() < 1e-6);
    }
    let mean = expected.iter().map(|[measured, _, miss]| miss / measured).sum::<f64>() / 43.0;
    assert!(
        found.sentence.contains(&format!("the miss is {:.0} % of the displacement", 100.0 * mean)),
        "{}",
        found.sentence
    );
}

/// The second run is predicted with the spring, delay and hysteresis of the first; the rests of all seconds together are the
/// rest that `identify --predict` prints.
#[test]
fn a_run_is_predicted_from_another() {
    let found = evidence::encoders(A, B).unwrap();
    let [a, b] = [A, B].map(|text| gear::read(text).unwrap().remove(0));
    let (explained, rest) = a.fit().unwrap().predicts(&b);
    let misses = curve(&found, "miss");
    let mean = misses.iter().sum::<f64>() / misses.len() as f64;
    let all = (misses.iter().map(|miss| miss * miss).sum::<f64>() / misses.len() as f64).sqrt();
    assert!(mean.abs() < 1e-9 && (all * 1e-3 / rest - 1.0).abs() < 1e-9, "{mean} {all} {rest}");
    let of_seconds =
        found.rows.iter().map(|row| row.values[2].powi(2)).sum::<f64>() / found.rows.len() as f64;
    assert!((of_seconds.sqrt() * 1e-6 / rest - 1.0).abs() < 1e-3, "the last sample has no second of its own");
    assert!(
        explained > 0.99 && found.sentence.contains(&format!("{:.1} % are predicted", 100.0 * explained))
    );
    let bare = a.fit().unwrap().left_without(&b) * 1e6;
    assert!(
        (bare - 151.0).abs() < 1.0 && found.sentence.contains(&format!("alone leave {bare:.0} µrad")),
        "{bare}"
    );
    // What is measured is the difference of the two angles.
    let differences: Vec<f64> = (0..b.time.len()).map(|k| 1e3 * (b.motor[k] - b.load[k])).collect();
    let measured = curve(&found, "measured");
    for k in 1..differences.len() {
        let steps = [differences[k] - differences[0], measured[k] - measured[0]];
        assert!((steps[0] - steps[1]).abs() < 1e-9);
    }
    let error =
        evidence::encoders(A, &B.replace("q3", "q2").replace("load_3", "load_2")).unwrap_err().to_string();
    assert!(error.contains("other") && error.contains("joint 2"), "{error}");
}

/// As computed from the same figures before this code was written: the mean force as a vector is missed by 31, 15, 11, 13 and
/// 13 % for the bull nose and by 30, 16, 4, 4 and 8 % for the ball nose; peaks are within 8 and 7 % of the 99th percentile.
#[test]
fn forces_are_missed_by_what_was_computed_elsewhere() {
    let found = evidence::slots();
    let misses = [31.0, 15.0, 11.0, 13.0, 13.0, 30.0, 16.0, 4.0, 4.0, 8.0];
    for (row, miss) in found.rows.iter().zip(misses) {
        assert!((row.values[2] - miss).abs() < 1.0, "{}: {} against {miss}", row.name, row.values[2]);
    }
    // The axes of the dynamometer: of all ways to turn and mirror them, the one taken agrees best, by far.
    let mut means = Vec::new();
    for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        for signs in 0..8 {
            let sign = |axis: i32| if signs >> axis & 1 == 0 { 1.0 } else { -1.0 };
            let miss = |(corner, slot): (f64, &slots::Slot)| {
                let ours = slots::cut(corner, slot[0]).mean_force().at(slots::FEED);
                let read = Vector3::new(
                    sign(0) * slot[1 + order[0]],
                    sign(1) * slot[1 + order[1]],
                    sign(2) * slot[1 + order[2]],
                );
                (ours - read).norm() / read.norm()
            };
            let all = slots::SLOTS.iter().flat_map(|(_, corner, rows)| rows.iter().map(|row| (*corner, row)));
            means.push((all.map(miss).sum::<f64>() / 10.0, order, signs));
        }
    }
    means.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!((means[0].1, means[0].2), ([1, 0, 2], 0b011), "the force on the tool is (-y, -x, z)");
    assert!((means[0].0 - 0.144).abs() < 0.002 && (means[1].0 - 0.399).abs() < 0.002, "{means:?}");
    for (rows, most) in [(&found.rows[..5], 8.0), (&found.rows[5..], 7.1)] {
        assert!(rows.iter().all(|row| row.values[5].abs() < most), "{rows:?}");
    }
    assert_eq!(found.rows.len(), misses.len());
    assert_eq!(curve(&found, "ball").len(), slots::BALL.len());
}
