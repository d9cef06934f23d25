//! From the job's feed rule to the path with the feeds that it gives.

use crate::cutting::{ConstantForceFeed, CutAlong, Loading, MeanForces};
use crate::error::Error;
use crate::job::{self, Choice, FeedRule, Job};
use crate::path::Path;
use crate::stock::Contacts;
use crate::units::MM;
use std::sync::Arc;

/// Lowest and highest feed, unless the job sets others [%].
const LIMITS: (f64, f64) = (25.0, 100.0);

/// A path, what the tool meets along it, and the mean force that makes.
#[derive(Debug, Clone)]
pub struct PathInStock {
    /// The path in the base frame.
    pub path: Path,
    /// The contacts.
    pub contacts: Arc<Contacts>,
    /// Mean force in {T}.
    pub mean_force: MeanForces,
}

/// A feed that holds the force.
#[derive(Debug, Clone)]
pub struct FeedByForce {
    /// The rule.
    pub rule: ConstantForceFeed,
    /// Shares of the way at feed on which the feed is at its lower and at its upper limit.
    pub at_limits: [f64; 2],
    /// The path as programmed.
    pub programmed: PathInStock,
}

/// The path with the feeds of the job's rule, and the rule; `None` if the feed is as programmed.
///
/// # Errors
/// If the rule has no stock to go by, or its numbers contradict each other.
pub(super) fn held(
    job: &Job,
    path: &Path,
    mean_force: &MeanForces,
    loading: &Loading,
) -> Result<Option<(PathInStock, FeedByForce)>, Error> {
    let motion = &job.motion;
    if motion.feed_rule.unwrap_or_default() == FeedRule::Programmed {
        return alone(motion).map(|()| None);
    }
    let MeanForces::InStock { contacts, forces } = mean_force else {
        let expected =
            "programmed, or give a stock that is cut along its z axis and that sets the engagement";
        return Err(Error::invalid("motion.feed_rule", "\"constant-force\"", expected));
    };
    let along = CutAlong { path, contacts, forces, loading };
    let rule = rule(motion, &along)?;
    let Some(pieces) = rule.pieces(&along) else {
        let expected = "\"from_feed\", for motion.feed_rule makes thinner chips by a lower feed";
        return Err(Error::invalid("cutting.feed_per_tooth_mm", loading.feed_per_tooth() / MM, expected));
    };
    let (parted, origins) = contacts.in_pieces(&pieces);
    let parted = Arc::new(parted);
    let forces = origins.iter().map(|&station| forces[station]).collect();
    let held = PathInStock {
        path: path.in_pieces(&pieces),
        contacts: parted.clone(),
        mean_force: MeanForces::InStock { contacts: parted, forces },
    };
    let programmed =
        PathInStock { path: path.clone(), contacts: contacts.clone(), mean_force: mean_force.clone() };
    let at_limits = rule.shares_at_limits(&pieces, path, loading);
    Ok(Some((held, FeedByForce { rule, at_limits, programmed })))
}

/// Refuses numbers of a rule that the job does not name.
fn alone(motion: &job::Motion) -> Result<(), Error> {
    let given =
        [motion.force_n.is_some(), motion.feed_least_percent.is_some(), motion.feed_most_percent.is_some()];
    if motion.feed_rule.is_none() && given.contains(&true) {
        let expected = "constant-force, with force_n, feed_least_percent or feed_most_percent";
        return Err(Error::missing("motion.feed_rule", expected));
    }
    Ok(())
}

/// The rule in SI.
fn rule(motion: &job::Motion, along: &CutAlong) -> Result<ConstantForceFeed, Error> {
    let least = motion.feed_least_percent.unwrap_or(LIMITS.0);
    let most = motion.feed_most_percent.unwrap_or(LIMITS.1.max(least));
    if most < least {
        let expected = format!("at least feed_least_percent = {least}");
        return Err(Error::invalid("motion.feed_most_percent", most, expected));
    }
    let force = match motion.force_n {
        Some(Choice::Value(force, _)) => force,
        None | Some(Choice::Word) => along.median_force().ok_or_else(|| {
            Error::missing(
                "motion.force_n",
                "a number: the program meets no material, so there is no median force",
            )
        })?,
    };
    Ok(ConstantForceFeed { force, least: least / 100.0, most: most / 100.0 })
}
