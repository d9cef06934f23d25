//! The samples of a run and the cycles of a loop beside them.

use crate::error::Error;
use crate::online::LoopTimes;
use crate::plan::Plan;
use nalgebra::Vector3;

/// Most cycles of a run: an hour at 4 ms.
const MOST: usize = 1_000_000;
/// A loop settles for so many times its delays before the run begins.
const SETTLES: f64 = 20.0;

/// The samples of a run at which errors are computed, no further apart than a cycle where the run's samples are not, and
/// the cycles.
pub(super) struct Cycles {
    /// The samples, rising.
    pub(super) at: Vec<usize>,
    /// Places among those samples in a cycle.
    each: f64,
    count: usize,
    /// Cycles until the loop has settled.
    settles: usize,
}

impl Cycles {
    /// Of a run, with a loop of these times.
    ///
    /// # Errors
    /// [`Error::Invalid`] if a time is out of its range, or there are too many cycles.
    pub(super) fn new(plan: &Plan, times: &LoopTimes) -> Result<Self, Error> {
        let LoopTimes { cycle, dead_time, arm_lag, filter } = *times;
        if !(1e-4..=1.0).contains(&cycle) {
            return Err(Error::invalid("online.cycle_s", cycle, "0.0001 to 1 s"));
        }
        for (field, time) in
            [("online.dead_time_s", dead_time), ("online.arm_lag_s", arm_lag), ("online.filter_s", filter)]
        {
            if !(0.0..=5.0).contains(&time) {
                return Err(Error::invalid(field, time, "0 to 5 s"));
            }
        }
        let samples = plan.trajectory.timing.arc_length.len();
        let step = plan.trajectory.sample_time;
        let stride = ((cycle / step + 1e-9).floor() as usize).max(1);
        let at: Vec<usize> = (0..samples).step_by(stride).collect();
        let each = cycle / (step * stride as f64);
        let count = ((at.len() - 1) as f64 / each + 1e-9).floor() as usize + 1;
        if count > MOST {
            return Err(Error::invalid("online.cycle_s", cycle, format!("at most {MOST} cycles in a run")));
        }
        let settles = (SETTLES * (cycle + dead_time + arm_lag + filter) / cycle).ceil() as usize;
        Ok(Self { at, each, count, settles })
    }

    /// Values at the samples as values at the cycles, straight in between.
    pub(super) fn of(&self, values: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        (0..self.count).map(|cycle| between(values, cycle as f64 * self.each)).collect()
    }

    /// The same after the first one has stayed until the loop has settled.
    pub(super) fn settled(&self, values: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        std::iter::repeat_n(values[0], self.settles).chain(self.of(values)).collect()
    }

    /// What a series at the cycles, the settling ones first, is at one of the samples.
    pub(super) fn at_sample(&self, series: &[Vector3<f64>], sample: usize) -> Vector3<f64> {
        between(&series[self.settles..], sample as f64 / self.each)
    }
}

/// A series at a place between its values; beyond the last one, that.
fn between(series: &[Vector3<f64>], place: f64) -> Vector3<f64> {
    let last = series.len() - 1;
    let place = place.min(last as f64);
    let below = (place.floor() as usize).min(last);
    series[below].lerp(&series[(below + 1).min(last)], place - below as f64)
}
