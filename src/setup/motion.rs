//! The job's motion, shaper, start and roll about the tool axis.

use crate::error::Error;
use crate::job::{self, Choice, Elbow, ShaperSpec, Shoulder, SpinGoal, SpinMode, SpinReference, Wrist};
use crate::motion::joints::StartBranch;
use crate::motion::roll::{RollGoal, RollRange};
use crate::motion::trajectory::MotionLimits;
use crate::motion::{Shaper, shaper};
use crate::path::{Path, reference};
use crate::units::{DEG, HZ, MM};
use nalgebra::Vector3;

/// Limits of the motion. A shaped motion waits in corners until the shaper has settled, unless the
/// job sets another time.
pub(super) fn limits(motion: &job::Motion, shaper: &Shaper) -> MotionLimits {
    MotionLimits {
        feed: motion.feed_mm_s * MM,
        rapid: motion.rapid_mm_s * MM,
        acceleration: motion.acceleration_mm_s2 * MM,
        sample_time: motion.sample_time_s,
        corner_angle: motion.corner_angle_deg * DEG,
        rounded: true,
        corner_dwell: match motion.corner_dwell {
            Choice::Value(dwell, _) => dwell,
            Choice::Word if shaper.duration() > 0.0 => shaper.duration() + 2.0 * motion.sample_time_s,
            Choice::Word => 0.0,
        },
        settle: shaper.duration(),
    }
}

/// The branch at the start of the motion.
pub(super) fn start(branch: job::Branch) -> StartBranch {
    StartBranch {
        front: branch.shoulder == Shoulder::Front,
        elbow_positive: branch.elbow == Elbow::Positive,
        wrist_near: branch.wrist == Wrist::Near,
    }
}

/// Range and goal of the roll, if it is free.
pub(super) fn roll_range(spin: &job::Spin) -> Result<Option<RollRange>, Error> {
    let job::Spin { mode, range_deg: [low, high], goal, .. } = *spin;
    if mode == SpinMode::Fixed {
        return Ok(None);
    }
    if low > high {
        return Err(Error::invalid(
            "spin.range_deg",
            format!("[{low}, {high}]"),
            "put the smallest angle first",
        ));
    }
    let goal = match goal {
        SpinGoal::SmoothJoints => RollGoal::SmoothJoints,
        SpinGoal::LeastError => RollGoal::LeastError,
    };
    Ok(Some(RollRange { low: low * DEG, high: high * DEG, goal }))
}

/// Least angle between the tool axis and either way along a reference that the job sets [rad].
const LEGAL: f64 = DEG;

/// A path in the workpiece frame with its roll counted from what the job sets, if it does.
pub(super) fn with_reference(path: Path, spin: &job::Spin) -> Result<Path, Error> {
    let field = "spin.reference";
    let Some(given) = spin.reference.direction() else { return Ok(path) };
    let value = serde_json::to_string(&spin.reference).unwrap_or_default();
    let direction = Vector3::from(given);
    if direction.norm() < 1e-9 {
        return Err(Error::invalid(field, value, "a direction other than zero, of any length"));
    }
    let (clear, index) = path.clearance(&direction);
    if clear >= LEGAL {
        return Ok(path.with_reference(&direction));
    }
    let keeps_clear = |i: &usize| path.clearance(&Vector3::ith(*i, 1.0)).0 >= reference::CLEAR;
    let legal: Vec<_> =
        (0..3).filter(keeps_clear).map(|i| format!("\"{}\"", SpinReference::WORDS[i + 1])).collect();
    let others = if legal.is_empty() { "\"auto\"".to_owned() } else { legal.join(" or ") };
    let step = &path.moves()[index];
    let line = if step.line > 0 { format!(", line {}", step.line) } else { String::new() };
    let expected = format!(
        "the tool axis comes within {:.1} deg of it ({:.1} mm along the path{line}); \
         choose a direction at least {:.0} deg away from it, such as {others}",
        clear / DEG,
        path.start(index) / MM,
        LEGAL / DEG
    );
    Err(Error::invalid(field, value, expected))
}

/// The shaper, with frequency [rad/s] and damping ratio of its mode.
pub(super) fn shaper(given: &job::Shaper) -> Result<(Shaper, Option<(f64, f64)>), Error> {
    let job::Shaper::Spec(ShaperSpec { kind, frequency_rad_s, frequency_hz, damping }) = *given else {
        return Ok((Shaper::none(), None));
    };
    let frequency = match (frequency_rad_s, frequency_hz) {
        (Some(rad_s), None) => rad_s,
        (None, Some(hz)) => hz * HZ,
        (None, None) => {
            return Err(Error::missing("shaper.frequency_rad_s", "or frequency_hz: one of the two"));
        }
        (Some(_), Some(_)) => {
            return Err(Error::invalid(
                "shaper.frequency_hz",
                "given together with frequency_rad_s",
                "give one of the two",
            ));
        }
    };
    let kind = shaper::kind(kind.word()).ok_or_else(|| Error::missing("shaper.kind", "a kind of shaper"))?;
    if damping > kind.damping_max {
        let field = "shaper.damping".into();
        return Err(Error::OutOfRange { field, value: damping, min: 0.0, max: kind.damping_max, unit: "" });
    }
    Ok((Shaper::new(kind, frequency, damping), Some((frequency, damping))))
}
