//! The band: against full reruns of the kept commands, closed forms and laws.

use crate::plant::drawn_cut;
use armill::cutting::MeanForces;
use armill::deviation::{Reference, Sources, simulate};
use armill::job::Job;
use armill::plan::Plan;
use armill::report::Report;
use armill::setup::Setup;
use armill::spread::{InputSpread, Stiffness};
use armill::uncertainty::draw::deviates;
use armill::uncertainty::{BreakEven, Draw};
use armill::{Progress, run, run_json};
use serde_json::{Value, json};
use std::sync::Arc;

fn job(sections: Value) -> Report {
    run_json(&sections.to_string(), &mut Progress::none()).unwrap()
}

fn default_with(uncertainty: Value) -> Report {
    job(json!({"uncertainty": uncertainty}))
}

/// Largest contour error of the kept commands [m] when the whole model runs with a drawn plant.
fn rerun(report: &Report, draw: &Draw) -> Vec<f64> {
    let setup = report.setup();
    let stiffness = *setup.robot.compliance();
    let limits = setup.robot.limits().copied();
    let compliance = std::array::from_fn(|i| stiffness[i] * draw.compliance[i]);
    let robot =
        armill::robot::Robot::new(setup.robot.name(), *setup.robot.links(), limits, compliance).unwrap();
    let robot = robot.with_tool(*setup.robot.tool());
    let cut = drawn_cut(&setup.cut, draw);
    let drawn = Setup {
        robot: robot.clone(),
        mean_force: MeanForces::of(&cut, setup.contacts.as_ref()),
        cut,
        ..setup.clone()
    };
    let plan = Plan { setup: Arc::new(drawn), robot, ..report.plan.clone() };
    let reference = Reference::along(&plan, Sources::ALL);
    let errors = simulate(&plan, &reference, &report.compensation.q, &mut Progress::none()).contour_error;
    errors.iter().map(|error| error.norm()).collect()
}

#[test]
fn the_default_job_has_the_band_of_what_is_known() {
    let band = default_with(json!({"stiffness_percent": 20, "cutting_percent": 30})).band.after;
    assert!((0.10e-3..0.22e-3).contains(&band.p50), "{band:?}");
    assert!((0.33e-3..0.60e-3).contains(&band.p95), "{band:?}");
    let known = default_with(json!({"stiffness_percent": 5, "cutting_percent": 10})).band.after;
    assert!((0.10e-3..0.20e-3).contains(&known.p95), "{known:?}");
}

#[test]
fn exact_numbers_leave_the_nominal_residual() {
    let report = default_with(json!({"stiffness_percent": 0, "cutting_percent": 0}));
    let nominal = report.after_max();
    for left in [report.band.after.p50, report.band.after.p95] {
        assert!((left - nominal).abs() < 1e-9, "{left} {nominal}");
    }
}

/// Two hundred plants through the whole model, every sample: the band's largest error of each plant
/// is that of the rerun, so the quantiles are too.
#[test]
fn full_reruns_agree() {
    let report = default_with(json!({"stiffness_percent": 20, "cutting_percent": 30, "draws": 200}));
    let spreads = &report.setup().spreads;
    let mut largest: Vec<f64> = deviates(spreads.seed, 200)
        .iter()
        .map(|z| rerun(&report, &Draw::at(spreads, z)).into_iter().fold(0.0, f64::max))
        .collect();
    largest.sort_by(f64::total_cmp);
    let band = report.band.after;
    let [low, high] = band.p95_interval;
    let (p50, p95) = (0.5 * (largest[99] + largest[100]), 0.5 * (largest[189] + largest[190]));
    assert!((low..=high).contains(&p95), "{p95} {band:?}");
    // The places miss the largest over all samples by less than 2 %.
    assert!(
        (band.p50 / p50 - 1.0).abs() < 0.02 && (band.p95 / p95 - 1.0).abs() < 0.02,
        "{p50} {p95} {band:?}"
    );
}

/// One stiffness alone: the residual across a straight path is |1 / s - 1| times the deflection by
/// that joint, whose quantile is known without drawing.
#[test]
fn one_spread_has_a_closed_form() {
    let report = default_with(json!({"stiffness_percent": 0, "cutting_percent": 20, "draws": 20000}));
    // |x - 1| of a normal x is half-normal: its 95 % quantile is the range itself.
    let reached = rerun(&report, &Draw { force: [1.2; 3], ..Draw::NOMINAL }).into_iter().fold(0.0, f64::max);
    let p95 = report.band.after.p95;
    // The ratios add their own spread, a few percent of the error.
    assert!((0.97..1.08).contains(&(p95 / reached)), "{p95} {reached}");
}

/// The product of two normal factors, x k: E (x k - 1)^2 = s^2 + t^2 + s^2 t^2.
#[test]
fn a_product_of_normals_has_its_variance() {
    let (s, t) = (InputSpread::percent(20.0), InputSpread::percent(30.0));
    let draws = deviates(7, 20_000);
    let mean = draws.iter().map(|z| (s.at(z[0]) * t.at(z[6]) - 1.0).powi(2)).sum::<f64>() / 2e4;
    let (s, t) = (s.deviation().powi(2), t.deviation().powi(2));
    let wanted = s + t + s * t;
    // Two in a thousand deviates are drawn again: the variance is 2 % smaller.
    assert!((mean / wanted - 0.98).abs() < 0.03, "{mean} {wanted}");
}

#[test]
fn a_covariance_is_met_by_the_draws() {
    let c = [1e-7, 2e-7, 3e-7, 4e-7, 5e-7, 0.0];
    let mut covariance = [[0.0; 6]; 6];
    for i in 0..5 {
        for j in 0..5 {
            let share = if i == j { 0.04 } else { 0.02 };
            covariance[i][j] = share * c[i] * c[j];
        }
    }
    let stiffness = Stiffness::together(&c, &covariance).unwrap();
    let draws = deviates(3, 20_000);
    let factors: Vec<[f64; 6]> =
        draws.iter().map(|z| stiffness.at(&[z[0], z[1], z[2], z[3], z[4], z[5]])).collect();
    let mean = |of: &dyn Fn(&[f64; 6]) -> f64| factors.iter().map(of).sum::<f64>() / 2e4;
    assert!((mean(&|f| f[0]) - 1.0).abs() < 0.01);
    assert!((mean(&|f| (f[0] - 1.0) * (f[1] - 1.0)) - 0.02).abs() < 0.002);
    assert!((mean(&|f| (f[2] - 1.0).powi(2)) - 0.04).abs() < 0.003);
    assert!(factors.iter().all(|f| f[5] == 1.0));
}

/// Compliances that one fit can hardly tell apart: no lognormal deviates have this covariance
/// exactly, the band takes it to first order.
#[test]
fn closely_tied_compliances_are_drawn() {
    let c = [1e-7, 2e-7, 3e-7, 4e-7, 5e-7, 6e-7];
    let mut covariance = [[0.0; 6]; 6];
    for i in 0..6 {
        covariance[i][i] = 0.09 * c[i] * c[i];
    }
    covariance[1][2] = -0.95 * 0.09 * c[1] * c[2];
    covariance[2][1] = covariance[1][2];
    let stiffness = Stiffness::together(&c, &covariance).unwrap();
    let found = stiffness.covariance();
    assert!((found[(1, 2)] + 0.95 * 0.09).abs() < 1e-12 && (found[(1, 1)] - 0.09).abs() < 1e-12);
    // One that is no covariance at all is refused.
    covariance[1][2] = -1.05 * 0.09 * c[1] * c[2];
    covariance[2][1] = covariance[1][2];
    assert!(Stiffness::together(&c, &covariance).is_none());
}

#[test]
fn a_compliance_that_is_not_known_at_all_is_refused() {
    let mut covariance = [[0.0; 6]; 6];
    covariance[2][2] = 1.0;
    let mut job = Job::default();
    job.uncertainty.compliance_covariance = Some(covariance);
    let error = run(&job, &mut Progress::none()).unwrap_err();
    assert_eq!(error.field(), Some("uncertainty.compliance_covariance[2][2]"));
}

#[test]
fn the_same_seed_gives_the_same_bits_and_another_one_does_not() {
    let [a, b, c] = [1, 1, 2].map(|seed| default_with(json!({"seed": seed, "draws": 100})).band);
    assert_eq!(a, b);
    assert_ne!(a.after, c.after);
}

#[test]
fn shares_add_up_and_the_measurement_narrows() {
    let report = default_with(json!({"stiffness_percent": 20, "cutting_percent": 30}));
    let sum: f64 = report.band.shares.iter().map(|share| share.share).sum();
    assert!((sum - 1.0).abs() < 1e-12);
    let measure = report.band.measure_first().unwrap();
    assert_eq!(measure.input, "cutting");
    let after = default_with(json!({"stiffness_percent": 20, "cutting_percent": 10}));
    // It is estimated at the places that decide: within the 2 % that places may miss.
    assert!((after.band.after.p95 / measure.p95 - 1.0).abs() < 0.02, "{measure:?} {:?}", after.band.after);
    // Half the deflection: the correction is as large as the uncorrected error.
    let BreakEven::Above(share) = report.band.break_even else { panic!("{:?}", report.band.break_even) };
    assert!((share - 0.5).abs() < 0.03);
}

/// A range wide enough to turn the force round is no range of a force: the widest allowed keeps its
/// sign in every draw.
#[test]
fn no_draw_turns_the_force_or_a_stiffness_round() {
    let widest =
        json!({"stiffness_percent": 60, "cutting_percent": 60, "frequency_percent": 60, "draws": 20000});
    let report = default_with(widest);
    let spreads = &report.setup().spreads;
    for z in deviates(spreads.seed, spreads.draws) {
        let Draw { compliance, force, frequency } = Draw::at(spreads, &z);
        assert!(compliance.iter().chain(&force).chain([&frequency]).all(|factor| *factor > 0.0), "{z:?}");
    }
    let mut job = Job::default();
    job.uncertainty.cutting_percent = armill::job::Choice::value(100.0);
    assert!(run(&job, &mut Progress::none()).is_err());
}

#[test]
fn the_filter_s_frequency_widens_the_band() {
    let without = default_with(json!({"stiffness_percent": 0, "cutting_percent": 0}));
    let with = default_with(
        json!({"stiffness_percent": 0, "cutting_percent": 0, "frequency_percent": 10, "draws": 100}),
    );
    assert!(with.band.after.p95 > without.band.after.p95);
    assert!((with.band.shares.last().unwrap().share - 1.0).abs() < 1e-12);
}

#[test]
fn two_spreads_of_the_stiffness_are_refused() {
    let mut job = Job::default();
    job.uncertainty.stiffness_percent = armill::job::Choice::value(20.0);
    job.uncertainty.stiffness_factor = Some(2.0);
    let error = run(&job, &mut Progress::none()).unwrap_err();
    assert!(error.to_string().contains("uncertainty.stiffness_factor"), "{error}");
}

#[test]
fn the_default_job_cannot_run() {
    let summary = serde_json::to_value(default_with(json!({})).summary()).unwrap();
    assert_eq!(summary["verdict_state"], "cannot-run");
    assert!(summary["expected_mm"]["p95"].as_f64().unwrap() > summary["after_mm"]["max"].as_f64().unwrap());
    assert_eq!(summary["how_sure"]["draws"], 1000);
}
