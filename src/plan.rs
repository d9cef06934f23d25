//! The plan: everything known before the robot moves. It owns all inputs of a run.

use crate::error::Error;
use crate::job::Sources;
use crate::motion::joints::{JointTrajectory, Targets, joint_trajectory};
use crate::motion::{Shaper, TimingLaw, Trajectory};
use crate::path::Path;
use crate::progress::Progress;
use crate::robot::{Joints, Robot};
use crate::setup::Setup;
use std::borrow::Cow;
use std::sync::Arc;

/// Arm, path and motion, with the setup they come from. Clones share motion and setup.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The job in SI.
    pub setup: Arc<Setup>,
    /// The arm with its tool; its sag is measured from where the workpiece was touched off.
    pub robot: Robot,
    /// The desired path in the base frame, with the chosen roll about the tool axis.
    pub path: Path,
    /// The desired motion.
    pub trajectory: Arc<Trajectory>,
}

impl Plan {
    /// A plan for the whole path of a setup.
    pub fn new(setup: Arc<Setup>) -> Self {
        let trajectory = Arc::new(Trajectory::new(&setup.path, &setup.limits));
        Self { robot: setup.robot.clone(), path: setup.path.clone(), trajectory, setup }
    }

    /// This plan along `path`, at `count` stations instead of every sample.
    pub fn at_stations(&self, path: Path, count: usize) -> Self {
        let trajectory = Arc::new(Trajectory::stations(&path, &self.setup.limits, count));
        Self { path, trajectory, ..self.clone() }
    }

    /// The shaper of the joint commands.
    pub fn shaper(&self) -> &Shaper {
        &self.setup.shaper
    }

    /// The sources that act while the correction is computed: those to compensate, or all if there
    /// are none.
    pub fn sought(&self) -> Sources {
        if self.setup.sources == Sources::NONE { Sources::ALL } else { self.setup.sources }
    }

    /// Joint commands for the desired motion.
    ///
    /// # Errors
    /// See [`joint_trajectory`].
    pub fn joints(&self, progress: &mut Progress) -> Result<JointTrajectory, Error> {
        let targets = Targets::desired(&self.path, &self.trajectory);
        joint_trajectory(&self.robot, &targets, self.setup.start, progress)
    }

    /// Timing law of the tool along the path; it lags the command if shaping acts.
    pub fn timing(&self, acting: Sources) -> Cow<'_, TimingLaw> {
        let Trajectory { timing, sample_time, .. } = &*self.trajectory;
        if acting.shaping {
            Cow::Owned(timing.shaped(self.shaper(), &self.path, *sample_time))
        } else {
            Cow::Borrowed(timing)
        }
    }

    /// Whether joint values lie within the arm's ranges; true if these are unknown.
    pub fn is_within_limits(&self, q: &Joints) -> bool {
        let ranges = self.robot.limits().into_iter().flatten();
        ranges.zip(q.iter()).all(|((low, high), q)| (low..=high).contains(&q))
    }
}
