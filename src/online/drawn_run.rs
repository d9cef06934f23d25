//! Where joint commands take a drawn plant, and what a sensor sees of it.

use crate::cutting::PartForces;
use crate::deviation::contour;
use crate::job::Sources;
use crate::plan::Plan;
use crate::robot::Joints;
use crate::uncertainty::Draw;
use crate::uncertainty::place::{DrawnPlace, places};
use nalgebra::Vector3;

/// Joint commands at some samples of a run.
pub(super) struct DrawnRun<'a> {
    plan: &'a Plan,
    places: Vec<DrawnPlace>,
    /// The plant that the controller expects: what it does is none of the loop's business.
    expected: Draw,
}

impl<'a> DrawnRun<'a> {
    /// Of joint commands [rad] at the samples `at`, with the plant that is expected.
    pub(super) fn new(plan: &'a Plan, (q, at): (&[Joints], &[usize]), expected: Draw) -> Self {
        let timing = plan.timing(Sources::ALL);
        let parts = PartForces::of(&plan.setup.cut, plan.setup.contacts.as_ref());
        Self { plan, places: places(plan, (&timing, &parts), (q, at), 0.0), expected }
    }

    /// The tips with a plant [m].
    pub(super) fn tips(&self, draw: &Draw) -> Vec<Vector3<f64>> {
        self.places.iter().map(|place| place.tip(self.plan, draw)).collect()
    }

    /// Tips from the closest point of the path [m].
    pub(super) fn errors(&self, tips: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let error = |(place, tip): (&DrawnPlace, &Vector3<f64>)| {
            tip - contour::closest(&self.plan.path, (place.arc_length, &place.target), tip).point
        };
        self.places.iter().zip(tips).map(error).collect()
    }

    /// The largest contour error of tips that are corrected at each place [m].
    pub(super) fn largest(&self, tips: &[Vector3<f64>], correction: impl Fn(usize) -> Vector3<f64>) -> f64 {
        let path = &self.plan.path;
        let tips = self.places.iter().zip(tips).enumerate();
        tips.map(|(k, (place, tip))| place.near.error(path, &(tip + correction(k)))).fold(0.0, f64::max)
    }

    /// What the drawn force bends the assumed arm by, beyond what is expected [m].
    pub(super) fn assumed(&self, draw: &Draw) -> Vec<Vector3<f64>> {
        let measured = Draw { force: draw.force, ..Draw::NOMINAL };
        let beyond =
            |place: &DrawnPlace| place.tip(self.plan, &measured) - place.tip(self.plan, &self.expected);
        self.places.iter().map(beyond).collect()
    }

    /// Where bent joints take the tip, from where they are expected to [m]: the tip less what the tool bends on a rigid arm.
    pub(super) fn bent_joints(&self, draw: &Draw) -> Vec<Vector3<f64>> {
        let joints = |place: &DrawnPlace, draw: &Draw| {
            let rigid = Draw { compliance: [0.0; 6], ..*draw };
            place.tip(self.plan, draw) - place.tip(self.plan, &rigid)
        };
        self.places.iter().map(|place| joints(place, draw) - joints(place, &self.expected)).collect()
    }
}
