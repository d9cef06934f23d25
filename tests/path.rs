//! Paths: geometry of segments, closest point, corners, the trajectory along them.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]

use crate::common::{any_vector, between};
use armill::math::Pose;
use armill::motion::trajectory::MotionLimits;
use armill::motion::{TimingLaw, Trajectory};
use armill::path::{Move, MovePace, Path, Program, Segment, shape};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn any_segment(random: &mut fastrand::Rng, from: Vector3<f64>) -> Segment {
    if random.bool() {
        return Segment::Line { from, to: from + any_vector(random, 0.2) };
    }
    let u = any_vector(random, 1.0).normalize();
    let v = u.cross(&any_vector(random, 1.0)).normalize();
    let radius = between(random, 0.02, 0.2);
    let rise = if random.bool() { 0.0 } else { between(random, -0.2, 0.2) };
    Segment::Arc { center: from - u * radius, u, v, radius, sweep: between(random, 0.2, 2.0 * TAU), rise }
}

fn any_path(random: &mut fastrand::Rng) -> Path {
    let mut segments: Vec<Segment> = Vec::new();
    let mut from = any_vector(random, 0.1);
    for _ in 0..4 {
        let segment = any_segment(random, from);
        from = segment.point(segment.length());
        segments.push(segment);
    }
    Path::new(segments).unwrap()
}

#[test]
fn the_parameter_is_the_arc_length_and_the_tangent_its_derivative() {
    let mut random = fastrand::Rng::with_seed(21);
    for _ in 0..300 {
        let path = any_path(&mut random);
        for _ in 0..20 {
            let s = between(&mut random, 1e-5, path.length() - 1e-5);
            if path.corners().any(|corner| (corner.s - s).abs() < 2e-6) {
                continue;
            }
            let h = 1e-6;
            let slope = (path.point(s + h) - path.point(s - h)) / (2.0 * h);
            // Chord of an arc of 20 mm over 2 um: 1e-9; rounding 1e-16/h.
            assert!((slope - path.tangent(s)).norm() < 1e-8);
            assert!((path.tangent(s).norm() - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn segments_follow_each_other_when_placed() {
    let mut random = fastrand::Rng::with_seed(22);
    for _ in 0..100 {
        let path = any_path(&mut random);
        let frame =
            Pose::from_xyz_rpy(any_vector(&mut random, 1.0), [0; 3].map(|_| between(&mut random, -3.0, 3.0)));
        let placed = path.placed(&frame);
        assert!((placed.length() - path.length()).abs() < 1e-12);
        for i in 0..=20 {
            let s = path.length() * f64::from(i) / 20.0;
            assert!((placed.point(s) - frame.point(&path.point(s))).norm() < 1e-12);
        }
        for pair in placed.moves().windows(2) {
            let [before, after] = [pair[0].segment, pair[1].segment];
            assert!((before.point(before.length()) - after.point(0.0)).norm() < 1e-12);
        }
    }
}

#[test]
fn closest_point_equals_a_search_of_every_place() {
    let mut random = fastrand::Rng::with_seed(23);
    for _ in 0..200 {
        let path = any_path(&mut random);
        let near = between(&mut random, 0.0, path.length());
        let p = path.point(near) + any_vector(&mut random, 0.01);
        let radius = 0.05_f64.min(path.length() / 2.0);
        let closest = path.closest(&p, near, radius);
        let steps = 200_000;
        let (low, high) = ((near - radius).max(0.0), (near + radius).min(path.length()));
        let brute = (0..=steps)
            .map(|i| (path.point(low + (high - low) * f64::from(i) / f64::from(steps)) - p).norm())
            .fold(f64::INFINITY, f64::min);
        let ours = (closest.point - p).norm();
        // The search steps by 0.5 um; near a distance of some mm that costs 1e-10 m, near zero up
        // to the step.
        assert!(ours <= brute + 1e-12, "closest {ours}, search {brute}");
        assert!(ours >= brute - 6e-7);
        assert!((path.point(closest.s) - closest.point).norm() < 1e-12);
    }
}

/// As a CAM system writes it: thousands of short lines, of which the search leaves most out.
#[test]
fn on_many_short_lines_it_is_the_best_of_all() {
    let mut random = fastrand::Rng::with_seed(29);
    let mut heading = Vector3::x();
    let mut points = vec![Vector3::zeros()];
    for _ in 0..5000 {
        heading = (heading + any_vector(&mut random, 0.1)).normalize();
        points.push(points[points.len() - 1] + heading * between(&mut random, 1e-5, 2e-4));
    }
    let lines = shape::polyline(&points);
    let path = Path::new(lines.clone()).unwrap();
    for _ in 0..300 {
        let near = between(&mut random, 0.0, path.length());
        let p = path.point(near) + any_vector(&mut random, 0.004);
        let radius = between(&mut random, 0.0, 0.05);
        let closest = path.closest(&p, near, radius);
        let (low, high) = ((near - radius).max(0.0), (near + radius).min(path.length()));
        let mut start = 0.0;
        let mut best = f64::INFINITY;
        for line in &lines {
            let (from, to) = ((low - start).max(0.0), (high - start).min(line.length()));
            if from <= to {
                best = best.min((p - line.point(line.closest(&p, from, to))).norm());
            }
            start += line.length();
        }
        assert_eq!((p - closest.point).norm().to_bits(), best.to_bits(), "within {radius} of {near}");
    }
}

#[test]
fn a_crossing_is_matched_to_the_own_branch() {
    // A figure that crosses itself at the origin: on the first leg the second one is nearer, but
    // must not be chosen.
    let points =
        [[-0.1, 0.0], [0.1, 0.0], [0.1, 0.1], [0.0, 0.1], [0.0, -0.1]].map(|[x, y]| Vector3::new(x, y, 0.0));
    let path = Path::new(shape::polyline(&points)).unwrap();
    let tip = Vector3::new(0.001, 0.002, 0.0);
    let closest = path.closest(&tip, 0.101, 0.01);
    assert!((closest.point - Vector3::new(0.001, 0.0, 0.0)).norm() < 1e-15);
}

#[test]
fn a_closed_path_is_searched_across_its_seam() {
    let path = Path::new(vec![shape::circle(Vector3::zeros(), 0.3, Vector3::z())]).unwrap();
    assert!(path.is_closed());
    let behind = Vector3::new(0.31 * (-0.01_f64).cos(), 0.31 * (-0.01_f64).sin(), 0.0);
    let closest = path.closest(&behind, 0.0, 0.02);
    assert!((closest.s + 0.003).abs() < 1e-12, "{}", closest.s);
    assert!(((closest.point - behind).norm() - 0.01).abs() < 1e-12);
    let ahead = path.closest(&-behind.map(|v| -v), path.length(), 0.02);
    assert!((ahead.s - (path.length() - 0.003)).abs() < 1e-12);
    // An open path is not.
    let line = Path::new(shape::polyline(&[Vector3::zeros(), Vector3::x()])).unwrap();
    assert_eq!(line.closest(&Vector3::new(-0.5, 0.1, 0.0), 0.0, 1.0).s, 0.0);
}

#[test]
fn circles_start_at_x_and_run_counter_clockwise() {
    let circle = |normal| Path::new(vec![shape::circle(Vector3::zeros(), 0.3, normal)]).unwrap();
    let flat = circle(Vector3::z());
    assert!((flat.point(0.0) - Vector3::x() * 0.3).norm() < 1e-15);
    assert!((flat.tangent(0.0) - Vector3::y()).norm() < 1e-15);
    // Normal along X: from the projection of +Y.
    assert!((circle(Vector3::x()).point(0.0) - Vector3::y() * 0.3).norm() < 1e-15);
    let tilted = circle(Vector3::new(0.2, 0.3, 0.5));
    assert!((tilted.length() - TAU * 0.3).abs() < 1e-12);
    for i in 0..12 {
        let p = tilted.point(tilted.length() * f64::from(i) / 12.0);
        assert!(p.dot(&Vector3::new(0.2, 0.3, 0.5)).abs() < 1e-15 && (p.norm() - 0.3).abs() < 1e-15);
    }
    let clockwise = shape::arc(Vector3::zeros(), 1.0, Vector3::z(), FRAC_PI_2, -FRAC_PI_2);
    assert!((clockwise.point(0.0) - Vector3::y()).norm() < 1e-15);
    assert!((clockwise.point(clockwise.length()) - Vector3::x()).norm() < 1e-15);
}

#[test]
fn rectangles_close_and_round() {
    for radius in [0.0, 0.01, 0.05] {
        let path = Path::new(shape::rectangle(Vector3::new(0.6, 0.0, 0.1), 0.2, 0.1, radius)).unwrap();
        assert!(path.is_closed());
        let expected = 0.6 - 8.0 * radius + TAU * radius;
        assert!((path.length() - expected).abs() < 1e-12, "radius {radius}: {}", path.length());
        let sharp = path.corners().filter(|corner| corner.angle > 0.1).count();
        assert_eq!(
            sharp,
            if radius == 0.0 { 3 } else { 0 },
            "corners between start and end, radius {radius}"
        );
    }
}

#[test]
fn a_sharp_corner_is_a_stop_and_a_blunt_one_is_not() {
    let turn = |degrees: f64| {
        let end = Vector3::new(0.1 + 0.1 * degrees.to_radians().cos(), 0.1 * degrees.to_radians().sin(), 0.0);
        let path = Path::new(shape::polyline(&[Vector3::zeros(), Vector3::x() * 0.1, end])).unwrap();
        let limits = MotionLimits {
            feed: 0.1,
            rapid: 1.0,
            acceleration: 0.5,
            sample_time: 1e-3,
            corner_angle: 5.0_f64.to_radians(),
            rounded: false,
            corner_dwell: 0.2,
            settle: 0.0,
        };
        Trajectory::new(&path, &limits)
    };
    let smooth = turn(4.0);
    assert!(smooth.stops.is_empty());
    let middle = smooth.len() / 2;
    assert!((smooth.timing.speed[middle] - 0.1).abs() < 1e-12, "no slowing down");
    let stop = turn(6.0);
    assert_eq!(stop.stops.len(), 1);
    // Two stretches of 0.1 m with 0.2 s ramps, and the dwell.
    let expected = 2.0 * (1.0 + 0.2) + 0.2;
    assert!((stop.moving as f64 * 1e-3 - expected).abs() < 3e-3, "{}", stop.moving);
    let resting = stop.timing.speed[5..stop.len() - 5].iter().filter(|speed| **speed == 0.0).count();
    assert!((195..=205).contains(&resting), "at rest for {resting} samples");
}

#[test]
fn speed_and_acceleration_stay_within_what_was_asked() {
    let mut random = fastrand::Rng::with_seed(24);
    for _ in 0..50 {
        let path = any_path(&mut random);
        let limits = MotionLimits {
            feed: between(&mut random, 0.01, 0.5),
            rapid: 1.0,
            acceleration: between(&mut random, 0.05, 2.0),
            sample_time: 2e-3,
            corner_angle: between(&mut random, 0.01, PI),
            rounded: false,
            corner_dwell: between(&mut random, 0.0, 0.1),
            settle: 0.05,
        };
        let trajectory = Trajectory::new(&path, &limits);
        let s = &trajectory.timing.arc_length;
        assert!((Trajectory::count(&path, &limits) - trajectory.len() as f64).abs() <= 2.0);
        for k in 1..s.len() {
            let step = s[k] - s[k - 1];
            assert!(step >= -1e-15 && step <= limits.feed * 2e-3 * (1.0 + 1e-9));
        }
        for k in 2..s.len() {
            let second = (s[k] - 2.0 * s[k - 1] + s[k - 2]) / 4e-6;
            // Across a stop with little or no dwell, two ramps meet within a step: twice the
            // acceleration.
            assert!(second.abs() <= 2.0 * limits.acceleration * (1.0 + 1e-6) + 1e-6, "{second}");
        }
        assert_eq!(*s.last().unwrap(), path.length());
    }
}

/// A smooth chain of lines along x, each with its own speed.
fn straight(paces: &[(f64, MovePace)]) -> Path {
    let mut from = 0.0;
    let moves = paces
        .iter()
        .map(|&(length, pace)| {
            let point = |x: f64| Vector3::new(x, 0.0, 0.0);
            let segment = Segment::Line { from: point(from), to: point(from + length) };
            from += length;
            Move { segment, axis_from: Vector3::z(), axis_to: Vector3::z(), pace, spindle: None, line: 1 }
        })
        .collect();
    Path::of_program(&Program { moves, ..Program::default() }).unwrap()
}

#[test]
fn feeds_change_without_a_stop_and_within_the_acceleration() {
    let mut random = fastrand::Rng::with_seed(25);
    let limits = MotionLimits {
        feed: 0.08,
        rapid: 0.5,
        acceleration: 0.4,
        sample_time: 1e-3,
        corner_angle: 0.1,
        rounded: false,
        corner_dwell: 0.1,
        settle: 0.0,
    };
    for _ in 0..50 {
        let paces: Vec<_> = (0..8)
            .map(|_| {
                let pace = match random.u8(0..3) {
                    0 => MovePace::Rapid,
                    1 => MovePace::JobFeed,
                    _ => MovePace::Feed(between(&mut random, 0.01, 0.3)),
                };
                (between(&mut random, 1e-4, 0.1), pace)
            })
            .collect();
        let path = straight(&paces);
        let trajectory = Trajectory::new(&path, &limits);
        assert!(trajectory.stops.is_empty());
        let limit = |s: f64| {
            let index = (0..8).rev().find(|&i| path.start(i) <= s).unwrap();
            match path.moves()[index].pace {
                MovePace::Rapid => limits.rapid,
                MovePace::Feed(feed) => feed,
                MovePace::JobFeed => limits.feed,
            }
        };
        let pace = &trajectory.timing;
        for k in 0..trajectory.len() {
            // A sample on a junction belongs to the next move.
            let allowed = limit(pace.arc_length[k]).max(limit((pace.arc_length[k] - 1e-9).max(0.0)));
            assert!(pace.speed[k] <= allowed * (1.0 + 1e-9), "{} > {allowed}", pace.speed[k]);
            if k > 0 {
                let change = (pace.speed[k] - pace.speed[k - 1]).abs();
                assert!(change <= limits.acceleration * 1e-3 * (1.0 + 1e-6), "{change}");
                let step = pace.arc_length[k] - pace.arc_length[k - 1];
                let mean = (pace.speed[k] + pace.speed[k - 1]) / 2.0;
                assert!(
                    (step - mean * 1e-3).abs() < 1e-3 * limits.acceleration * 1e-3,
                    "distance is the integral of speed"
                );
            }
            let slow = k > 5 && k + 6 < trajectory.len() && pace.speed[k] < 1e-3;
            assert!(!slow || (1..6).any(|i| pace.speed[k + i] > pace.speed[k]), "no stop in between");
        }
    }
}

#[test]
fn rapids_do_not_cut_and_waits_are_waited() {
    let mut program = Program {
        moves: straight(&[(0.05, MovePace::Rapid), (0.05, MovePace::JobFeed)]).moves().to_vec(),
        ..Program::default()
    };
    program.dwells.push(armill::path::program::Dwell { after: 1, time: 0.3, line: 2 });
    let path = Path::of_program(&program).unwrap();
    let limits = MotionLimits {
        feed: 0.1,
        rapid: 0.2,
        acceleration: 1.0,
        sample_time: 1e-3,
        corner_angle: 0.1,
        rounded: false,
        corner_dwell: 0.0,
        settle: 0.0,
    };
    let trajectory = Trajectory::new(&path, &limits);
    let resting = (0..trajectory.len()).filter(|&k| trajectory.timing.arc_length[k] == 0.05).count();
    assert!((299..=302).contains(&resting), "{resting} samples at rest");
    for (s, engaged) in trajectory.timing.arc_length.iter().zip(&trajectory.timing.engaged) {
        assert!(*s == 0.05 || *engaged == if *s < 0.05 { 0.0 } else { 1.0 });
    }
    // Rapid: 0.05 m at up to 0.2 m/s; then 0.05 m at 0.1 m/s; both from rest to rest with 1 m/s^2;
    // and the dwell.
    let expected = (0.05 / 0.2 + 0.2) + 0.3 + (0.05 / 0.1 + 0.1);
    assert!((trajectory.moving as f64 * 1e-3 - expected).abs() < 3e-3);
    // Stations are evenly spaced from start to end, at each move's full speed.
    let TimingLaw { arc_length, speed, engaged, .. } = Trajectory::stations(&path, &limits, 5).timing;
    assert!(arc_length.iter().zip([0.0, 0.025, 0.05, 0.075, 0.1]).all(|(s, even)| (s - even).abs() < 1e-15));
    assert_eq!([speed[1], speed[3], engaged[1], engaged[3]], [0.2, 0.1, 0.0, 1.0]);
}

#[test]
fn the_tool_axis_turns_evenly_along_a_move() {
    let (from, to) = (Vector3::z(), Vector3::new(0.6, 0.0, 0.8));
    let line = Segment::Line { from: Vector3::zeros(), to: Vector3::new(0.1, 0.0, 0.0) };
    let step =
        Move { segment: line, axis_from: from, axis_to: to, pace: MovePace::JobFeed, spindle: None, line: 1 };
    let path = Path::of_program(&Program { moves: vec![step], ..Program::default() }).unwrap();
    assert!(path.is_multi_axis());
    let whole = 0.6_f64.asin();
    for part in [0.0, 0.25, 0.5, 1.0] {
        let axis = path.axis(0.1 * part);
        assert!((axis.x - (whole * part).sin()).abs() < 1e-15 && axis.y == 0.0);
        let orientation = path.orientation(0.1 * part, &axis, 0.0);
        assert!((orientation.column(2) + axis).norm() < 1e-15, "TCP z is the approach");
        assert!((orientation.determinant() - 1.0).abs() < 1e-14);
    }
}
