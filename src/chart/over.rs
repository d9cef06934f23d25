//! What a chart of the run is drawn over: the time, the path, or the lines of the program.

use serde::{Deserialize, Serialize};

use super::chart::Axis;
use super::unit::Units;
use crate::report::Report;

/// The first axis of a chart of kind `time`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Over {
    /// Time since the start of the run [s].
    #[default]
    Time,
    /// Length of the desired path up to the sample; while the tool stands still, many samples share it.
    Length,
    /// Line of the program, and as decimals the share of its time that is over. A program that
    /// repeats lines goes back here.
    Line,
}

impl Over {
    /// Those that a report has.
    pub(super) fn all(report: &Report) -> &'static [Over] {
        match report.setup().program {
            Some(_) => &[Over::Time, Over::Length, Over::Line],
            None => &[Over::Time, Over::Length],
        }
    }

    /// Its name as an option.
    pub(super) fn name(self) -> &'static str {
        match self {
            Over::Time => "time",
            Over::Length => "length",
            Over::Line => "line",
        }
    }

    pub(super) fn axis(self, units: Units) -> Axis<'static> {
        match self {
            Over::Time => Axis { label: "Time", unit: "s", ..Axis::default() },
            Over::Length => Axis { label: "Path length", unit: units.length.name(), ..Axis::default() },
            Over::Line => Axis { label: "Program line", whole: true, ..Axis::default() },
        }
    }

    /// A value for each sample.
    pub(super) fn values(self, report: &Report, units: Units) -> Vec<f64> {
        let trajectory = &report.plan.trajectory;
        match self {
            Over::Time => (0..trajectory.len()).map(|k| k as f64 * trajectory.sample_time).collect(),
            Over::Length => trajectory.timing.arc_length.iter().map(|s| s / units.length.in_m()).collect(),
            Over::Line => {
                let moves = report.plan.path.moves();
                let lines = trajectory.timing.index.iter().map(|&index| moves[index as usize].line);
                spread(&lines.collect::<Vec<_>>())
            }
        }
    }
}

/// Lines spread evenly over the samples that run them, so that what happens within a line can be seen.
fn spread(lines: &[usize]) -> Vec<f64> {
    lines
        .chunk_by(|a, b| a == b)
        .flat_map(|run| run.iter().enumerate().map(|(k, &line)| line as f64 + k as f64 / run.len() as f64))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_spread_over_its_samples() {
        assert_eq!(spread(&[3, 3, 3, 3, 7, 3, 3]), [3.0, 3.25, 3.5, 3.75, 7.0, 3.0, 3.5]);
        assert!(spread(&[]).is_empty());
    }
}
