//! Step and impact responses: closed forms, noise, and causes of a doubtful result.

use crate::common::between;
use armill::identify::Mode;
use armill::identify::response::{Signal, mode};
use armill::motion::shaper;
use std::f64::consts::TAU;

/// A free vibration of undamped frequency `w` and damping `z`, from 0.05 s on, with `noise` added.
fn ringing(w: f64, z: f64, rate: f64, span: f64, noise: f64, random: &mut fastrand::Rng) -> Signal {
    let damped = w * (1.0 - z * z).sqrt();
    let time: Vec<f64> = (0..(span * rate) as usize).map(|k| k as f64 / rate).collect();
    let value = time.iter().map(|&t| {
        let s = t - 0.05;
        let free = if s < 0.0 { 0.0 } else { 3.0 * (-z * w * s).exp() * (damped * s + 1.2).cos() };
        free + 0.2 + noise * ((0..12).map(|_| random.f64()).sum::<f64>() - 6.0)
    });
    let value = value.collect();
    Signal { time, value, states_unit: true }
}

fn plain(w: f64, z: f64, rate: f64, span: f64) -> Mode {
    mode(&ringing(w, z, rate, span, 0.0, &mut fastrand::Rng::with_seed(0)), Some(0.05)).unwrap()
}

fn codes(mode: &Mode) -> Vec<&'static str> {
    mode.remarks.iter().map(|(code, _)| *code).collect()
}

#[test]
fn a_damped_sinusoid_gives_its_own_frequency_and_damping() {
    for (w, z, rate, span) in [
        (18.0, 0.1, 500.0, 4.0),
        (TAU * 11.0, 0.03, 1000.0, 3.0),
        (200.0, 0.3, 5000.0, 0.4),
        (60.0, 0.005, 400.0, 5.0),
    ] {
        let found = plain(w, z, rate, span);
        assert!((found.frequency.value / w - 1.0).abs() < 1e-9, "{w} {z}: {found:?}");
        assert!((found.damping.value - z).abs() < 1e-9, "{w} {z}: {:?}", found.damping);
        // The independent estimate, from the extrema alone, is close.
        assert!(
            (found.decrement.0 / w - 1.0).abs() < 0.05 && (found.decrement.1 - z).abs() < 0.2 * z + 0.005,
            "{:?}",
            found.decrement
        );
        assert!(found.explained > 1.0 - 1e-12 && found.passes.1, "{found:?}");
    }
}

/// The frequency is the undamped one that the shaper takes: a ZVD shaper for it cancels the
/// measured vibration completely.
#[test]
fn a_shaper_of_the_result_silences_the_vibration() {
    let (w, z) = (30.0, 0.25);
    let found = plain(w, z, 2000.0, 2.0);
    let zv = shaper::kind("zv").unwrap();
    let made = armill::motion::Shaper::new(zv, found.frequency.value, found.damping.value);
    assert!(made.residual_vibration(w, z) < 1e-8);
    let damped = w * (1.0 - z * z).sqrt();
    assert!(
        armill::motion::Shaper::new(zv, damped, z).residual_vibration(w, z) > 0.005,
        "the two frequencies differ"
    );
}

#[test]
fn intervals_hold_the_truth_as_often_as_they_say() {
    let mut random = fastrand::Rng::with_seed(11);
    let (w, z) = (TAU * 9.0, 0.04);
    let (mut of_frequency, mut of_damping) = (0, 0);
    let runs = 400;
    for _ in 0..runs {
        let found = mode(&ringing(w, z, 400.0, 2.0, 0.15, &mut random), Some(0.05)).unwrap();
        of_frequency += usize::from((found.frequency.value - w).abs() <= found.frequency.half);
        of_damping += usize::from((found.damping.value - z).abs() <= found.damping.half);
        assert!(codes(&found).is_empty() || codes(&found) == ["poor-fit"], "{:?}", found.remarks);
    }
    // 95 % of 400 within four binomial standard deviations.
    for within in [of_frequency, of_damping] {
        assert!((363..=397).contains(&within), "{of_frequency} {of_damping}");
    }
}

#[test]
fn the_start_is_found() {
    let mut random = fastrand::Rng::with_seed(2);
    let signal = ringing(40.0, 0.05, 1000.0, 3.0, 0.02, &mut random);
    let found = mode(&signal, None).unwrap();
    assert!(found.window.0 >= 0.049 && found.window.0 < 0.25, "{:?}", found.window);
    assert!((found.frequency.value / 40.0 - 1.0).abs() < 1e-3 && (found.damping.value - 0.05).abs() < 1e-3);
    let inside = signal
        .time
        .iter()
        .zip(&found.fitted)
        .all(|(&t, fit)| fit.is_finite() == (found.window.0..=found.window.1).contains(&t));
    assert!(inside);
}

#[test]
fn a_second_mode_is_found_and_fitted_along() {
    let mut random = fastrand::Rng::with_seed(4);
    let mut signal = ringing(50.0, 0.04, 2000.0, 2.5, 0.01, &mut random);
    for (t, v) in signal.time.iter().zip(&mut signal.value) {
        let s = t - 0.05;
        if s >= 0.0 {
            *v += 0.8 * (-0.03 * 170.0 * s).exp() * (170.0 * s).cos();
        }
    }
    let found = mode(&signal, Some(0.05)).unwrap();
    assert!(codes(&found).contains(&"several-modes"), "{:?}", found.remarks);
    let other = found.other.unwrap();
    assert!((found.frequency.value / 50.0 - 1.0).abs() < 2e-3, "{found:?}");
    assert!(
        (other.frequency / 170.0 - 1.0).abs() < 5e-3 && (other.share - 0.8 / 3.0).abs() < 0.02,
        "{other:?}"
    );
}

#[test]
fn what_makes_a_result_doubtful_is_said() {
    assert!(codes(&plain(20.0, 0.05, 1000.0, 0.75)).contains(&"few-cycles"));
    assert!(codes(&plain(TAU * 10.0, 0.03, 65.0, 3.0)).contains(&"slow-sampling"));
    let mut random = fastrand::Rng::with_seed(7);
    let noisy = mode(&ringing(TAU * 8.0, 0.05, 500.0, 1.0, 0.5, &mut random), Some(0.05)).unwrap();
    assert!(codes(&noisy).contains(&"poor-fit"), "{noisy:?}");
}

#[test]
fn what_does_not_ring_is_refused() {
    let quiet = Signal { time: (0..500).map(f64::from).collect(), value: vec![1.0; 500], states_unit: true };
    assert!(mode(&quiet, None).unwrap_err().to_string().contains("nothing vibrates"));
    let signal = ringing(20.0, 0.05, 1000.0, 2.0, 0.0, &mut fastrand::Rng::with_seed(0));
    assert!(mode(&signal, Some(9.0)).unwrap_err().to_string().contains("0 samples"));
    let slow = ringing(TAU * 30.0, 0.02, 100.0, 2.0, 0.0, &mut fastrand::Rng::with_seed(0));
    assert!(mode(&slow, Some(0.05)).unwrap_err().to_string().contains("too slowly"));
    let grows = Signal {
        value: signal.time.iter().map(|t| (2.0 * t).exp() * (40.0 * t).sin()).collect(),
        time: signal.time.clone(),
        states_unit: true,
    };
    assert!(mode(&grows, Some(0.0)).unwrap_err().to_string().contains("grows"));
    let mut random = fastrand::Rng::with_seed(1);
    for length in [0, 1, 2, 3, 10, 40] {
        let time: Vec<f64> = (0..length).map(f64::from).collect();
        let value = time.iter().map(|_| between(&mut random, -1.0, 1.0)).collect();
        let _ = mode(&Signal { time, value, states_unit: true }, None)
            .map(|found| assert!(found.frequency.value.is_finite()));
    }
}

#[test]
fn texts_are_read_and_refused_in_place() {
    let signal = Signal::read("time [ms]; acceleration\n0;0,5\n1;-0,25\n2;0").unwrap();
    assert_eq!(signal.time, [0.0, 1e-3, 2e-3]);
    assert_eq!(signal.value, [0.5, -0.25, 0.0]);
    assert_eq!(Signal::read("0.0 1\n0.1 2").unwrap().time[1], 0.1);
    for (text, place, part) in [
        ("", (1, 1), "without numbers"),
        ("0,1,2", (1, 5), "two numbers"),
        ("0,1\n0.1,x", (2, 5), "a number"),
        ("0,1\n0.1,2\n0.1,3", (3, 1), "increase from row to row"),
        ("frequency,a\n0,1", (1, 1), "time"),
        ("0,1\n0.1,", (2, 5), "a number"),
    ] {
        let error = Signal::read(text).expect_err(text);
        assert_eq!((error.place(), error.field()), (Some(place), Some("response")), "{error}");
        assert!(error.to_string().contains(part), "{error}");
    }
}

/// A decay at 9.3 Hz with a damping of 0.03, 0.2 % of noise, and a baseline that drifts.
fn drifting(slope: f64) -> Signal {
    let mut signal = ringing(TAU * 9.3, 0.03, 500.0, 2.0, 0.006, &mut fastrand::Rng::with_seed(6));
    for (time, value) in signal.time.iter().zip(&mut signal.value) {
        *value += 3.0 * slope * time;
    }
    signal
}

#[test]
fn a_drifting_baseline_is_taken_out() {
    for slope in [0.0, 0.02, -0.1, 0.5, 2.0] {
        let found = mode(&drifting(slope), None).unwrap();
        assert!((found.frequency.value / TAU / 9.3 - 1.0).abs() < 2e-3, "{slope}: {:?}", found.frequency);
        assert!((found.damping.value - 0.03).abs() < 1e-3, "{slope}: {:?}", found.damping);
        assert!(found.other.is_none() && codes(&found).is_empty(), "{slope}: {:?}", found.remarks);
        let near = |k: usize| (found.fitted[k] - drifting(slope).value[k]).abs() < 0.05;
        assert!((100..900).all(near), "the fit lies on the signal, baseline and all");
    }
}

/// Peaks that are cut off make the damping too small: equal ones in a row are told from whole ones.
#[test]
fn a_clipped_signal_is_noticed() {
    let whole = ringing(TAU * 9.3, 0.03, 500.0, 2.0, 0.0, &mut fastrand::Rng::with_seed(0));
    assert!(!codes(&mode(&whole, None).unwrap()).contains(&"clipped"));
    let value = whole.value.iter().map(|v| v.clamp(-0.7, 1.1)).collect();
    let cut = mode(&Signal { value, ..whole }, Some(0.05)).unwrap();
    assert!(codes(&cut).contains(&"clipped"), "{:?}", cut.remarks);
    assert!((cut.damping.value - 0.03).abs() > 0.003, "as it is said: {:?}", cut.damping);
}

#[test]
fn times_without_a_unit_may_be_milliseconds() {
    let signal = ringing(TAU * 9.3, 0.03, 500.0, 2.0, 0.0, &mut fastrand::Rng::with_seed(0));
    let rows: String =
        signal.time.iter().zip(&signal.value).map(|(t, v)| format!("{},{v}\n", 1000.0 * t)).collect();
    let found = mode(&Signal::read(&rows).unwrap(), None).unwrap();
    assert!(codes(&found).contains(&"time-unit"), "{:?}", found.remarks);
    let named = mode(&Signal::read(&format!("time_ms,a\n{rows}")).unwrap(), None).unwrap();
    assert!(codes(&named).is_empty() && (named.frequency.value / TAU / 9.3 - 1.0).abs() < 1e-6);
}

#[test]
fn what_does_not_decay_does_not_grow() {
    let mut signal = ringing(40.0, 0.0, 1000.0, 2.0, 0.0, &mut fastrand::Rng::with_seed(0));
    signal.value = signal.time.iter().map(|t| (40.0 * t).sin()).collect();
    match mode(&signal, Some(0.0)) {
        Ok(found) => assert!(found.damping.value < 1e-6, "{:?}", found.damping),
        Err(error) => assert!(error.to_string().contains("does not decay"), "{error}"),
    }
}

/// Where the peaks say something else than the fit, only the fit is shown.
#[test]
fn peaks_that_disagree_are_left_out() {
    let summary = |mode: &Mode| serde_json::json!(armill::identify::summary::response(mode));
    assert!(summary(&plain(18.0, 0.1, 500.0, 4.0)).get("decrement").is_some());
    let mut random = fastrand::Rng::with_seed(12);
    let noisy = mode(&ringing(TAU * 8.0, 0.05, 500.0, 1.0, 0.3, &mut random), Some(0.05)).unwrap();
    let (frequency, damping) = noisy.decrement;
    let agrees = (frequency / noisy.frequency.value - 1.0).abs() < 0.05
        && (1.0 / 1.5..1.5).contains(&(damping / noisy.damping.value));
    assert_eq!(summary(&noisy).get("decrement").is_some(), agrees);
    assert!(!agrees, "{frequency} {damping} {:?} {:?}", noisy.frequency, noisy.damping);
}
