//! Free roll: the angle about the tool axis, which the cut leaves free, chosen along the path for
//! the joints or for the contour.
//!
//! The inverse model is solved for a grid of angles at stations along the path. Dynamic programming
//! (A. Viterbi, IEEE Trans. Inf. Theory 13(2), 1967, on trellises of joint values) finds the
//! cheapest way through the grid; finer grids around it refine it. Between stations the angle
//! follows a smooth curve, [`Roll::through`].

use crate::error::Error;
use crate::math::{self, PI, Pose};
use crate::motion::Trajectory;
use crate::motion::joints::{StartBranch, Targets, first_solution, joint_trajectory};
use crate::path::{Path, Roll};
use crate::progress::Progress;
use crate::robot::inverse::{self, Margin, Solution};
use crate::robot::{Joints, Robot};
use crate::units::{DEG, MM};

/// The goal of a free roll.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RollGoal {
    /// The joints turn as little and as evenly as possible.
    SmoothJoints,
    /// The cutting force moves the tip off the path as little as possible.
    LeastError,
}

/// Range and goal of a free roll.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollRange {
    /// Smallest angle [rad].
    pub low: f64,
    /// Largest angle [rad].
    pub high: f64,
    /// Its goal.
    pub goal: RollGoal,
}

/// Squared errors [m^2] by the cutting force, from indices of stations and joint values there.
pub type Errors<'a> = &'a dyn Fn(&[usize], &[Joints]) -> Vec<f64>;

/// Number of stations that suffices for a roll.
pub const STATIONS: usize = 121;
/// Step of the first grid [rad].
const STEP: f64 = 10.0 * DEG;
/// Each finer grid divides the step by this.
const FINER: i32 = 4;
/// Number of finer grids: the last step is 0.16 deg.
const PASSES: usize = 3;
/// Largest change of the roll from one station to the next [rad].
const WINDOW: f64 = 30.0 * DEG;
/// A joint that turns further than this from one station to the next has changed its branch [rad].
const JUMP: f64 = 90.0 * DEG;
/// Weights of joint motion to try for the least error: a fast roll bends the path through the
/// shaper.
pub const SMOOTHNESS: [f64; 4] = [0.03, 0.3, 3.0, 30.0];
/// Distance from a joint's limit below which the cost rises [rad].
const LIMIT_MARGIN: f64 = 5.0 * DEG;
/// Sine of the elbow and wrist angles below which the cost rises: 5 deg.
const ANGLE_MARGIN: f64 = 0.087;
/// Distance of the wrist centre from axis 1 below which the cost rises [m].
const SHOULDER_MARGIN: f64 = 10.0 * MM;
/// Cost of a station beyond a joint's limit: more than any motion costs.
const BEYOND: f64 = 1e4;

/// The constant inputs of one search.
pub struct Search<'a> {
    /// The arm with its tool.
    pub robot: &'a Robot,
    /// The desired path in the base frame.
    pub path: &'a Path,
    /// Its [`Trajectory::stations`].
    pub stations: &'a Trajectory,
    /// Branch at the start.
    pub start: StartBranch,
    /// Range and goal.
    pub range: RollRange,
    /// Weight of joint motion; 1 if that alone is the goal.
    pub smoothness: f64,
    /// Errors by the force; not evaluated for smooth joints.
    pub errors: Errors<'a>,
}

/// Solutions at one station for one angle, each with its own cost.
type Cell = Vec<(Solution, f64)>;

/// The cheapest way to a solution of a cell.
#[derive(Clone, Copy)]
struct Label {
    cost: f64,
    /// Joint values, continuous from the start.
    q: Joints,
    /// Angle and label at the previous station.
    from: (usize, usize),
}

impl Search<'_> {
    /// The best roll, never worse than `fixed` [rad] if that is in the range; `None` if none leads
    /// along the whole path.
    pub fn best(&self, fixed: f64) -> Option<Roll> {
        let RollRange { low, high, .. } = self.range;
        let count = self.stations.len();
        if high <= low {
            return Some(Roll::fixed(low));
        }
        let steps = ((high - low) / STEP).ceil();
        let mut grid: Vec<f64> =
            (0..=steps as usize).map(|i| low + (high - low) * i as f64 / steps).collect();
        let within = (low..=high).contains(&fixed);
        if within {
            grid.push(fixed);
        }
        let mut scale = None;
        let mut found = self.through(&vec![grid; count], &mut scale);
        let mut step = (high - low) / steps;
        for _ in 0..PASSES {
            let Some(angles) = &found else { break };
            step /= f64::from(FINER);
            let around = |angle: &f64| {
                (-FINER..=FINER).map(|i| (angle + f64::from(i) * step).clamp(low, high)).collect()
            };
            let grids: Vec<Vec<f64>> = angles.iter().map(around).collect();
            // The finer grid contains the current way; only rounding can open a gap in it.
            let Some(finer) = self.through(&grids, &mut scale) else { break };
            found = Some(finer);
        }
        let scale = scale.unwrap_or(1.0);
        let free = found.map(|angles| {
            let points: Vec<_> = self.stations.timing.arc_length.iter().copied().zip(angles).collect();
            Roll::through(&points)
        });
        let constant = within.then(|| Roll::fixed(fixed));
        let cost = |roll: &Roll| self.cost_of(roll, scale).unwrap_or(f64::INFINITY);
        [constant, free].into_iter().flatten().min_by(|a, b| cost(a).total_cmp(&cost(b)))
    }

    /// The cost of a roll; `scale` is the squared error that counts as one [m^2].
    ///
    /// # Errors
    /// See [`joint_trajectory`].
    pub fn cost_of(&self, roll: &Roll, scale: f64) -> Result<f64, Error> {
        let path = self.path.clone().with_roll(roll.clone());
        let targets = Targets::desired(&path, self.stations);
        let joints = joint_trajectory(self.robot, &targets, self.start, &mut Progress::none())?;
        let all: Vec<usize> = (0..joints.q.len()).collect();
        let errors = self.errors_of(&all, &joints.q);
        let own = joints.q.iter().zip(&joints.margin).zip(&errors);
        let standing: f64 =
            own.map(|((q, margin), error)| self.own(margin, error / scale) + self.limits(q)).sum();
        Ok(standing + joints.q.windows(2).map(|pair| self.turning(&(pair[1] - pair[0]))).sum::<f64>())
    }

    fn errors_of(&self, stations: &[usize], q: &[Joints]) -> Vec<f64> {
        match self.range.goal {
            RollGoal::SmoothJoints => vec![0.0; q.len()],
            RollGoal::LeastError => (self.errors)(stations, q),
        }
    }

    /// Own cost of a pose: its share of the mean over all stations. The error counts by its fourth
    /// power, so that the largest errors dominate.
    fn own(&self, margin: &Margin, error: f64) -> f64 {
        let near = |value: f64, limit: f64| ((limit - value) / limit).max(0.0);
        let singular = [
            near(margin.wrist, ANGLE_MARGIN),
            near(margin.elbow, ANGLE_MARGIN),
            near(margin.shoulder, SHOULDER_MARGIN),
        ];
        (error * error + singular.iter().map(|x| x * x).sum::<f64>()) / self.stations.len() as f64
    }

    fn limits(&self, q: &Joints) -> f64 {
        let ranges = self.robot.limits().into_iter().flatten();
        let cost = ranges.zip(q.iter()).map(|((low, high), q)| {
            let room = (q - low).min(high - q);
            let near = ((LIMIT_MARGIN - room) / LIMIT_MARGIN).max(0.0);
            near * near + if room < 0.0 { BEYOND } else { 0.0 }
        });
        cost.sum::<f64>() / self.stations.len() as f64
    }

    /// Cost of a turn of the joints from one station to the next. The sum over the path is the mean
    /// square joint speed, in half turns per path.
    fn turning(&self, turn: &Joints) -> f64 {
        self.smoothness * turn.norm_squared() * (self.stations.len() - 1) as f64 / (PI * PI)
    }

    /// The TCP at a station with a roll.
    fn tcp(&self, station: usize, angle: f64) -> Pose {
        let s = self.stations.timing.arc_length[station];
        let rotation = self.path.orientation(s, self.stations.axis.at(station), angle);
        Pose { rotation, position: self.stations.position[station] }
    }

    /// All cells; the first grid sets the scale of the error.
    fn cells(&self, grids: &[Vec<f64>], scale: &mut Option<f64>) -> Vec<Vec<Cell>> {
        let solutions = |station: usize, angle: f64| -> Vec<Solution> {
            let all = inverse::inverse(self.robot, &self.tcp(station, angle), &Joints::zeros());
            all.map(|all| all.iter().copied().collect()).unwrap_or_default()
        };
        let mut cells: Vec<Vec<Cell>> = Vec::with_capacity(grids.len());
        let (mut stations, mut q) = (Vec::new(), Vec::new());
        for (station, grid) in grids.iter().enumerate() {
            let column = grid.iter().map(|&angle| {
                let found = solutions(station, angle);
                stations.extend(found.iter().map(|_| station));
                q.extend(found.iter().map(|solution| solution.q));
                found.into_iter().map(|solution| (solution, 0.0)).collect()
            });
            cells.push(column.collect());
        }
        let errors = self.errors_of(&stations, &q);
        let mean = errors.iter().sum::<f64>() / errors.len().max(1) as f64;
        let scale = *scale.get_or_insert(if mean > 0.0 { mean } else { 1.0 });
        for ((solution, cost), error) in cells.iter_mut().flatten().flatten().zip(errors) {
            *cost = self.own(&solution.margin, error / scale);
        }
        cells
    }

    /// The cheapest way through the grids, one angle per station.
    fn through(&self, grids: &[Vec<f64>], scale: &mut Option<f64>) -> Option<Vec<f64>> {
        let cells = self.cells(grids, scale);
        let first = |(&angle, cell): (&f64, &Cell)| {
            let start = first_solution(self.robot, &self.tcp(0, angle), self.start).ok();
            let label = start.and_then(|start| {
                let (_, own) = cell.iter().find(|(solution, _)| solution.branch == start.branch)?;
                Some(Label { cost: own + self.limits(&start.q), q: start.q, from: (0, 0) })
            });
            label.into_iter().map(Some).collect()
        };
        let mut table: Vec<Vec<Vec<Option<Label>>>> =
            vec![grids[0].iter().zip(&cells[0]).map(first).collect()];
        for (k, column) in cells.iter().enumerate().skip(1) {
            let mut labels: Vec<Vec<Option<Label>>> =
                column.iter().map(|cell| vec![None; cell.len()]).collect();
            for (i, before) in table[k - 1].iter().enumerate() {
                for (way, label) in before.iter().enumerate() {
                    let Some(label) = label else { continue };
                    for (j, cell) in column.iter().enumerate() {
                        if (grids[k][j] - grids[k - 1][i]).abs() > WINDOW {
                            continue;
                        }
                        let Some((b, next)) = self.step(label, cell, (i, way)) else { continue };
                        let place = &mut labels[j][b];
                        if place.is_none_or(|known| next.cost < known.cost) {
                            *place = Some(next);
                        }
                    }
                }
            }
            table.push(labels);
        }
        let ends = table.last()?.iter().enumerate().flat_map(|(i, labels)| {
            labels.iter().enumerate().filter_map(move |(way, label)| label.map(|label| (label.cost, i, way)))
        });
        let (_, mut i, mut way) = ends.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let mut angles = vec![0.0; grids.len()];
        for k in (0..grids.len()).rev() {
            angles[k] = grids[k][i];
            (i, way) = table[k][i][way]?.from;
        }
        Some(angles)
    }

    /// Steps from a label to the nearest solution of a cell, as the motion in [`joint_trajectory`]
    /// does.
    fn step(&self, label: &Label, cell: &Cell, from: (usize, usize)) -> Option<(usize, Label)> {
        let turns = cell.iter().enumerate().map(|(b, (solution, own))| {
            let turn = Joints::from_fn(|i, _| math::nearest_turn(solution.q[i], label.q[i]) - label.q[i]);
            (b, turn, own)
        });
        let (b, turn, own) = turns.min_by(|a, b| a.1.norm_squared().total_cmp(&b.1.norm_squared()))?;
        let q = label.q + turn;
        let cost = label.cost + own + self.limits(&q) + self.turning(&turn);
        (turn.amax() <= JUMP).then_some((b, Label { cost, q, from }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::trajectory::MotionLimits;
    use crate::path::Segment;
    use crate::robot::library;
    use nalgebra::Vector3;
    /// A line under an RX-90 with its tool at an angle, so that the roll moves all joints.
    fn case() -> (Robot, Path, MotionLimits) {
        let preset = library::robot("staubli-rx90").unwrap();
        let robot = Robot::new("", preset.links(), preset.limits(), preset.joint_compliance);
        let tool = Pose::from_xyz_rpy(Vector3::new(0.0, 0.0, 0.1), [0.0, 50.0 * DEG, 0.0]);
        let line = Segment::Line { from: Vector3::new(0.5, -0.2, 0.1), to: Vector3::new(0.6, 0.3, 0.1) };
        let limits = MotionLimits {
            feed: 0.1,
            rapid: 0.2,
            acceleration: 0.2,
            sample_time: 0.01,
            rounded: false,
            corner_angle: 0.1,
            corner_dwell: 0.0,
            settle: 0.0,
        };
        (robot.unwrap().with_tool(tool), Path::new(vec![line]).unwrap(), limits)
    }

    const START: StartBranch = StartBranch { front: true, elbow_positive: true, wrist_near: true };

    #[test]
    fn the_way_through_the_grid_is_the_best_of_all_ways() {
        let (robot, path, limits) = case();
        let stations = Trajectory::stations(&path, &limits, 6);
        // An error that favours different angles at different stations.
        let errors = |at: &[usize], q: &[Joints]| {
            at.iter().zip(q).map(|(&k, q)| (q[3] - 0.3 * k as f64).powi(2)).collect()
        };
        for goal in [RollGoal::SmoothJoints, RollGoal::LeastError] {
            let range = RollRange { low: -40.0 * DEG, high: 40.0 * DEG, goal };
            let search = Search {
                robot: &robot,
                path: &path,
                stations: &stations,
                start: START,
                range,
                smoothness: 1.0,
                errors: &errors,
            };
            let grid: Vec<f64> = [-40.0, -20.0, 0.0, 20.0, 40.0].map(|a| a * DEG).into();
            let mut scale = None;
            let found = search.through(&vec![grid.clone(); 6], &mut scale).unwrap();
            // The window limits angles, not their indices in the grids.
            let turned = |by: f64| [0.0, 0.0, 0.0, by, by, by].map(|angle| vec![angle * DEG]);
            assert!(search.through(&turned(29.0), &mut scale).is_some());
            assert!(search.through(&turned(31.0), &mut scale).is_none());
            let scale = scale.unwrap();
            let roll = |angles: &[f64]| {
                let points: Vec<_> =
                    stations.timing.arc_length.iter().copied().zip(angles.iter().copied()).collect();
                Roll::through(&points)
            };
            let ours = search.cost_of(&roll(&found), scale).unwrap();
            // All 5^6 ways, each costed by its joint trajectory.
            let mut least = f64::INFINITY;
            for way in 0..5_usize.pow(6) {
                let angles: Vec<f64> = (0..6).map(|k| grid[way / 5_usize.pow(k) % 5]).collect();
                if angles.windows(2).all(|pair| (pair[1] - pair[0]).abs() <= WINDOW) {
                    least = least.min(search.cost_of(&roll(&angles), scale).unwrap_or(f64::INFINITY));
                }
            }
            assert!((ours - least).abs() < 1e-9 * least, "{goal:?}: {ours} against {least}");
            let free = search.best(0.0).unwrap();
            assert!(search.cost_of(&free, scale).unwrap() < least, "finer grids do better still");
            for s in 0..=600 {
                assert!(free.at(f64::from(s) * 1e-3).abs() <= 40.0 * DEG, "the range holds between stations");
            }
        }
    }

    #[test]
    fn the_angle_that_makes_no_error_is_found() {
        let (robot, path, limits) = case();
        let (stations, start) = (&Trajectory::stations(&path, &limits, 6), START);
        for angle in [-33.3 * DEG, 28.4 * DEG] {
            let held = path.clone().with_roll(Roll::fixed(angle));
            let targets = Targets::desired(&held, stations);
            let wanted = joint_trajectory(&robot, &targets, START, &mut Progress::none()).unwrap().q;
            let errors = |at: &[usize], q: &[Joints]| {
                at.iter().zip(q).map(|(&k, q)| (q - wanted[k]).norm_squared()).collect()
            };
            let range = RollRange { low: -40.0 * DEG, high: 40.0 * DEG, goal: RollGoal::LeastError };
            let (robot, path, errors) = (&robot, &path, &errors);
            let found =
                Search { robot, path, stations, start, range, smoothness: 1e-9, errors }.best(0.0).unwrap();
            // The error counts by its fourth power, which is flat near the minimum.
            assert!(stations.timing.arc_length.iter().all(|&s| (found.at(s) - angle).abs() < 0.7 * DEG));
        }
    }

    #[test]
    fn cost_of_a_pose_and_of_a_turn() {
        let (robot, path, limits) = case();
        let stations = Trajectory::stations(&path, &limits, 5);
        let none = |at: &[usize], _: &[Joints]| vec![0.0; at.len()];
        let range = RollRange { low: 0.0, high: 0.0, goal: RollGoal::SmoothJoints };
        let (path, stations, start) = (&path, &stations, START);
        let search = |robot| Search { robot, path, stations, start, range, smoothness: 2.0, errors: &none };
        let ours = search(&robot);
        let close =
            |ours: f64, expected: f64| assert!((ours - expected).abs() < 1e-9, "{ours} for {expected}");
        // The scale is the mean squared error over all poses, or 1 without errors.
        let scale = |of: f64| {
            let errors = |at: &[usize], _: &[Joints]| (0..at.len()).map(|k| of * (k % 2) as f64).collect();
            let mut scale = None;
            let range = RollRange { goal: RollGoal::LeastError, ..range };
            let search = Search { range, errors: &errors, ..search(&robot) };
            let cells = search.cells(&[vec![0.0]], &mut scale).into_iter().flatten().flatten();
            for (k, (pose, cost)) in cells.enumerate() {
                close(cost, search.own(&pose.margin, of * (k % 2) as f64 / scale.unwrap()));
            }
            scale.unwrap()
        };
        assert_eq!([0.0, 8.0].map(scale), [1.0, 4.0]);
        // A fifth for each of five stations: the squared error, then the squared shortfalls of each
        // margin.
        let margin = |shoulder, elbow, wrist| Margin { shoulder, elbow, wrist };
        close(ours.own(&margin(1.0, 1.0, 1.0), 3.0), 9.0 / 5.0);
        close(ours.own(&margin(5.0 * MM, 0.75 * 0.087, 0.0), 0.0), (0.25 + 0.0625 + 1.0) / 5.0);
        // The shortfall of 5 deg before a limit; beyond the limit, BEYOND is added.
        let (low, high) = robot.limits().unwrap()[0];
        for (q, cost) in
            [(0.0, 0.0), (high - 2.0 * DEG, 0.36), (low + 4.0 * DEG, 0.04), (low - DEG, 1.44 + BEYOND)]
        {
            close(ours.limits(&Joints::new(q, 0.0, 0.0, 0.0, 0.0, 0.0)), cost / 5.0);
        }
        // In half turns per path: the same turn in each of four steps adds up to four of them.
        close(4.0 * ours.turning(&Joints::new(0.0, PI, 0.0, 0.0, 0.5 * PI, 0.0)), 2.0 * 1.25 * 16.0);
        // A roll that keeps joint 1 out of its range at every station costs more than BEYOND.
        let mut limits = *robot.limits().unwrap();
        limits[0] = (3.0, 3.1);
        let narrow = Robot::new("", *robot.links(), Some(limits), [0.0; 6]).unwrap().with_tool(*robot.tool());
        assert!(search(&narrow).cost_of(&Roll::fixed(0.0), 1.0).unwrap() > BEYOND);
    }

    #[test]
    fn the_fixed_angle_is_only_left_for_something_better() {
        let (robot, path, limits) = case();
        let stations = Trajectory::stations(&path, &limits, 41);
        let none = |at: &[usize], _: &[Joints]| vec![0.0; at.len()];
        let search = |low: f64, high: f64| Search {
            robot: &robot,
            path: &path,
            stations: &stations,
            start: START,
            range: RollRange { low: low * DEG, high: high * DEG, goal: RollGoal::SmoothJoints },
            smoothness: 1.0,
            errors: &none,
        };
        let cost = |roll: &Roll| search(0.0, 0.0).cost_of(roll, 1.0).unwrap();
        let fixed = cost(&Roll::fixed(10.0 * DEG));
        // A wider range is never worse.
        let mut last = fixed;
        for width in [1.0, 5.0, 30.0, 90.0] {
            let free = cost(&search(10.0 - width, 10.0 + width).best(10.0 * DEG).unwrap());
            // The grids of two ranges differ in their angles; their last step is 0.16 deg.
            assert!(free <= last * 1.001, "+-{width} deg: {free} after {last}");
            last = free;
        }
        assert!(last < 0.9 * fixed, "{last} of {fixed}");
        assert_eq!(search(7.0, 7.0).best(0.0), Some(Roll::fixed(7.0 * DEG)));
    }
}
