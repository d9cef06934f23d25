//! Encoders behind a gear: one run predicted from another.

use crate::error::Error;
use crate::evidence::{Evidence, EvidenceCurve, EvidenceRow};
use crate::identify::gear::{self, GearLog};

/// Stiffness of the joint on the sheet that the authors quote [N m/rad].
pub const SHEET: f64 = 4.10e6;
/// Reach at which an angle of the joint is given as a displacement [m].
const REACH: f64 = 2.5;
/// Microradians.
const MICRO: f64 = 1e-6;

/// Finds the gear of the first joint in the run `fitted` and predicts the run `other` of the same joint.
///
/// # Errors
/// Those of [`gear::read`] and [`GearLog::fit`]; [`Error::Invalid`] if the runs have different joints.
pub fn encoders(fitted: &str, other: &str) -> Result<Evidence, Error> {
    let run = |text: &str, field| Ok::<GearLog, Error>(gear::read_as(text, field)?.remove(0));
    let (fitted, other) = (run(fitted, "gear")?, run(other, "other")?);
    if fitted.joint != other.joint {
        return Err(Error::invalid(
            "other",
            format!("joint {}", other.joint + 1),
            "the same joint in both runs",
        ));
    }
    let (found, again) = (fitted.fit()?, other.fit()?);
    let (explained, rest) = found.predicts(&other);
    let beside = found.beside(&other);
    let second = |k: usize| (other.time[k] - other.time[0]).floor() as usize;
    let rms = |of: fn(&[f64; 2]) -> f64, at: usize| {
        let values: Vec<f64> =
            (0..beside.len()).filter(|k| second(*k) == at).map(|k| of(&beside[k])).collect();
        (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt() / MICRO
    };
    let seconds = (other.time[other.time.len() - 1] - other.time[0]).floor() as usize;
    let rows = (0..seconds).map(|at| {
        let [measured, predicted] = [rms(|pair| pair[0], at), rms(|pair| pair[1], at)];
        let miss = rms(|pair| pair[0] - pair[1], at);
        EvidenceRow {
            name: format!("{at} to {} s", at + 1),
            values: vec![measured, predicted, miss, 100.0 * miss / measured],
        }
    });
    let stiffness = |gear: &gear::Gear| {
        let within = gear.stiffness().zip(gear.stiffness_interval());
        within.map_or("not seen".to_owned(), |(value, [low, high])| {
            format!("{:.2}e6 ({:.2} to {:.2})", value / 1e6, low / 1e6, high / 1e6)
        })
    };
    let sentence = format!(
        "Of the difference of the readings in the second run, {:.1} % are predicted from the first: {:.0} µrad (root mean square) are \
         left, {:.2} mm at {REACH} m. Delay and hysteresis alone leave {:.0} µrad; the spring explains the rest of it. Stiffness by the \
         first run: {} N m/rad, by the second: {}, on the sheet that the authors quote: {:.2}e6.",
        100.0 * explained,
        rest / MICRO,
        rest * REACH * 1e3,
        found.left_without(&other) / MICRO,
        stiffness(&found),
        stiffness(&again),
        SHEET / 1e6
    );
    let values = |of: fn(&[f64; 2]) -> f64| beside.iter().map(|pair| of(pair) / MICRO / 1e3).collect();
    Ok(Evidence {
        key: "evidence-encoders",
        title: "Encoders behind the gear of a KUKA KR300's joint 3",
        sentence,
        rests_on: "A spring, a delay between the two readings and a hysteresis, found in the first run alone. The torque on the joint \
                   is the authors' model of the arm, not a measurement; the encoders' offset is the second run's own.",
        source: "github.com/JonasWeigand/Robot_Identification, MIT License",
        heads: vec!["Time", "Measured, µrad rms", "Predicted, µrad rms", "Miss, µrad rms", "Miss, %"],
        rows: rows.collect(),
        drawn: "The second run, without the offset of its encoders.",
        over: ("Time", "s"),
        shows: ("Motor less load angle", "mrad"),
        at: other.time.clone(),
        curves: vec![
            EvidenceCurve { key: "measured", label: "Measured", values: values(|pair| pair[0]) },
            EvidenceCurve { key: "predicted", label: "Predicted", values: values(|pair| pair[1]) },
            EvidenceCurve { key: "miss", label: "Miss", values: values(|pair| pair[0] - pair[1]) },
        ],
    })
}
