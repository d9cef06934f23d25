//! The whole pipeline against a plain one, written here from the thesis's equations without using
//! Armill's stages, on random jobs.
//!
//! To run any number of them, at tens of jobs per second and core:
//!
//! ```sh
//! ARMILL_DIFFERENTIAL_JOBS=50000 cargo test --test native differential -- --nocapture
//! ```
//!
//! To repeat one that failed: `ARMILL_DIFFERENTIAL_JOBS=1 ARMILL_DIFFERENTIAL_FIRST=its number`.
#![allow(clippy::disallowed_methods, reason = "the language's own functions are the second way")]
#![allow(clippy::disallowed_types, reason = "quaternions for another library, compared within tolerances")]
#![allow(clippy::print_stdout, reason = "quantiles are worth seeing: cargo test -- --nocapture")]

mod arm;
mod compare;
mod cut;
mod model;
mod random;
mod track;
mod way;

use arm::Refusal;
use armill::robot::library::{self, Preset};
use armill::{Error, Job};
use compare::{BOUNDS, differences};
use model::Refused;
use random::Case;
use std::collections::BTreeMap;
use std::thread;

/// The outcome of one job.
enum Verdict {
    /// Row of [`BOUNDS`] and difference, for every column; whether the tool has a corner radius.
    Compared(Vec<(usize, f64)>, bool),
    /// Both reject it, or leave it open, for this reason.
    Agreed(&'static str),
    Disagreed(String),
}

fn judge(number: u64, robots: &[Preset]) -> Verdict {
    let Case { job, question, illegal } = random::case(number, robots);
    let ours =
        Job::from_json(&job.to_string()).and_then(|job| armill::run(&job, &mut armill::Progress::none()));
    if let Some(field) = illegal {
        return match ours {
            Err(error) if error.field() == Some(field) => Verdict::Agreed("a value is not legal"),
            Err(error) => Verdict::Disagreed(format!("{field} is not legal, but the error is: {error}")),
            Ok(_) => Verdict::Disagreed(format!("{field} is not legal, and was computed")),
        };
    }
    if question.cut.too_thin() {
        let field = ours.as_ref().err().and_then(Error::field);
        return match field {
            Some("material.chip_thickness_mm") => Verdict::Agreed("the chip is too thin for a table"),
            _ => Verdict::Disagreed(format!("the chip is too thin for a table: {field:?}")),
        };
    }
    match (ours, question.answer()) {
        (Ok(_), Ok(answer)) if answer.regular < 0.02 => {
            Verdict::Agreed("near a singularity, where joint values are not compared")
        }
        (Ok(report), Ok(answer)) => match differences(&report, &question, &answer) {
            Ok(all) => Verdict::Compared(all, question.cut.corner > 0.0),
            Err(_) if answer.close_call(&question) => Verdict::Agreed("two passes are as good as each other"),
            Err(_) if question.way.doubtful(&question.tempo) => {
                Verdict::Agreed("a corner at a move of less than 1.25 mm, see tests/stops.rs")
            }
            Err(why) => Verdict::Disagreed(why),
        },
        (
            Err(Error::Unreachable { sample: Some(ours), .. }),
            Err(Refused { sample, why: Refusal::Reach }),
        ) if ours == sample => Verdict::Agreed("out of reach, at the same sample"),
        (Err(error), Err(Refused { sample: 0, why: Refusal::Branch }))
            if error.field() == Some("start_branch") =>
        {
            Verdict::Agreed("no such branch at the start")
        }
        // The plain arm stays on its branch; another that is near may go on.
        (Err(Error::BranchEnds { sample: ours, .. }), Err(Refused { sample, why: Refusal::Branch }))
            if ours == sample =>
        {
            Verdict::Agreed("the branch ends, at the same sample")
        }
        (Ok(report), Err(Refused { sample: 1.., why: Refusal::Branch }))
            if report.warnings.iter().any(|warning| warning.code == "joint-jump") =>
        {
            Verdict::Agreed("the branch ends, and the report warns of the jump to another")
        }
        (ours, theirs) => Verdict::Disagreed(format!(
            "{}, plain {:?}",
            ours.err().map_or("computed".into(), |error| error.to_string()),
            theirs.err()
        )),
    }
}

fn number(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).map_or(otherwise, |text| text.parse().unwrap())
}

#[test]
fn the_pipeline_equals_a_plain_one() {
    let (first, count) = (number("ARMILL_DIFFERENTIAL_FIRST", 0), number("ARMILL_DIFFERENTIAL_JOBS", 1000));
    let robots: Vec<_> = library::robots().collect();
    let threads = thread::available_parallelism().map_or(1, |n| n.get() as u64);
    let verdicts: Vec<(u64, Verdict)> = thread::scope(|scope| {
        let part = |thread: u64| {
            let robots = &robots;
            scope.spawn(move || {
                (first + thread..first + count)
                    .step_by(threads as usize)
                    .map(|n| (n, judge(n, robots)))
                    .collect::<Vec<_>>()
            })
        };
        let parts: Vec<_> = (0..threads).map(part).collect();
        parts.into_iter().flat_map(|part| part.join().unwrap()).collect()
    });

    let mut differences: BTreeMap<(usize, bool), Vec<(f64, u64)>> = BTreeMap::new();
    let mut agreed: BTreeMap<&str, usize> = BTreeMap::new();
    let mut wrong = Vec::new();
    let mut compared = 0;
    for (job, verdict) in verdicts {
        match verdict {
            Verdict::Compared(all, round) => {
                compared += 1;
                let mut worst = BTreeMap::new();
                for (row, difference) in all {
                    let most = worst.entry(row).or_insert(0.0_f64);
                    *most = if difference <= *most { *most } else { difference };
                }
                for (row, difference) in worst {
                    differences.entry((row, round)).or_default().push((difference, job));
                }
            }
            Verdict::Agreed(why) => *agreed.entry(why).or_default() += 1,
            Verdict::Disagreed(why) => wrong.push(format!("job {job}: {why}")),
        }
    }
    println!("{compared} jobs compared, others: {agreed:#?}");
    println!("largest difference of a job: q75, q99, max (and its job)");
    for ((row, round), mut values) in differences {
        values.sort_by(|a, b| a.0.total_cmp(&b.0));
        let at = |share: f64| values[((values.len() - 1) as f64 * share) as usize];
        let is = [at(0.75).0, at(0.99).0, at(1.0).0];
        let bound = &BOUNDS[row];
        let allowed = if round { bound.round } else { bound.flat };
        let (keys, tool) = (bound.keys.join(" "), if round { "corner radius" } else { "flat" });
        let numbers = |numbers: [f64; 3]| numbers.map(|n| format!("{n:.1e}")).join(", ");
        println!(
            "{keys} [{}], {tool}: {} (job {}), allowed {}: {}",
            bound.unit,
            numbers(is),
            at(1.0).1,
            numbers(allowed),
            bound.because
        );
        if !is.iter().zip(allowed).all(|(is, allowed)| *is <= allowed) {
            wrong.push(format!("{keys}, {tool}: {is:?} above {allowed:?}, worst in job {}", at(1.0).1));
        }
    }
    assert!(wrong.is_empty(), "{} disagreements:\n{}", wrong.len(), wrong.join("\n"));
    assert!(count < 1000 || compared * 10 > count as usize * 8, "only {compared} jobs were compared");
}
