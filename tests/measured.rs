//! The examples of measurements give the same bits as in the browser (tests/web.rs).

use crate::common::measured::{CUTS, CUTS_JOB, LOADS, LOOP, PASS, PASS_JOB, RESPONSE, ROBOT, RUNS, same};
use armill::identify::gear::{self, GearLog};
use armill::identify::{Convention, measurement, response, stiffness, summary};
use armill::learn::{
    Commanded, LearnSummary, LearningGain, Log, MeasuredPass, NextPass, PassOptions, dynamometer,
};
use armill::setup::Setup;
use armill::{Job, Progress, evidence};
use serde_json::json;

#[test]
fn a_measured_pass_teaches_the_same_bits() {
    let job = Job::from_json(PASS_JOB).unwrap();
    let report = armill::run(&job, &mut Progress::none()).unwrap();
    let commanded = Commanded { corrected: true, learned: vec![] };
    let options = PassOptions { commanded, frame: None, shift: None, corner: None };
    let measured = MeasuredPass::of(&report, &Log::read(PASS).unwrap(), &options).unwrap();
    let next = NextPass::of(&report, &measured, LearningGain::USUAL).unwrap();
    let summary = LearnSummary::of(&report, None, &measured, Some((&next, LearningGain::USUAL)));
    same("pass", &json!(summary));
    same("commands", &json!(next.table(&report)));
}

#[test]
fn measurements_identify_the_same_bits() {
    let setup = Setup::of(&Job::from_json(CUTS_JOB).unwrap(), &mut Progress::none()).unwrap();
    same("cuts", &json!(dynamometer::fit(&setup.cut, &dynamometer::read(CUTS).unwrap()).unwrap()));
    let robot = armill::setup::robot(&Job::from_json(ROBOT).unwrap()).unwrap();
    let measured = measurement::read(LOADS, Convention::CoupledJ3).unwrap();
    let fit = stiffness::fit(&robot, &measured.rows).unwrap();
    same("stiffness", &json!(summary::stiffness(&robot, &measured, &fit)));
    let mode = response::mode(&response::Signal::read(RESPONSE).unwrap(), None).unwrap();
    same("response", &json!(summary::response(&mode)));
    let [a, b]: [GearLog; 2] = RUNS.map(|text| gear::read(text).unwrap().remove(0));
    same("gear", &json!(a.fit().unwrap().summary(Some(&b))));
}

#[test]
fn evidence_and_loop_give_the_same_bits() {
    same("loads", &json!(evidence::loads(&Job::from_json(ROBOT).unwrap(), LOADS).unwrap()));
    same("encoders", &json!(evidence::encoders(RUNS[0], RUNS[1]).unwrap()));
    let report = armill::run_json(LOOP, &mut Progress::none()).unwrap();
    same("loop", &json!(report.summary().online));
}
