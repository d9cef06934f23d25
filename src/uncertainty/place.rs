//! A place on the path: where the tip goes there as a function of the drawn plant.
//!
//! Actual tip = shaped pose + C F (eqs. 3.47, 3.48), with C a sum over the joints and F a sum over
//! the parts of the force: bilinear in the factors on both. Where the force follows the deflection, so
//! do its parts, and the balance is that of the drawn plant. Springs that are not linear and weight
//! are kept, with the levers held as they are under the nominal force (they turn by less than 1e-3).

use crate::cutting::{CutStiffness, PartForces, along};
use crate::deviation::coupling::settled;
use crate::deviation::near::NearMove;
use crate::motion::TimingLaw;
use crate::plan::Plan;
use crate::robot::{Joints, equilibrium, forward, jacobian};
use crate::uncertainty::Draw;
use nalgebra::Vector3;

/// What a place needs to find where the tip goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawnPlace {
    /// Arc length of the tool [m].
    pub arc_length: f64,
    /// Where the tool should be [m].
    pub target: Vector3<f64>,
    /// The move there.
    pub near: NearMove,
    /// Shaped pose without deflection [m].
    base: Vector3<f64>,
    /// Displacement of the point per unit turn of each joint [m].
    moves: [Vector3<f64>; 6],
    /// Torque about each joint by each part of the nominal force [N m].
    torque: [[f64; 3]; 6],
    /// Torque of the weight [N m].
    weight: [f64; 6],
    /// Bending of the tool by each part of the nominal force [m], if it bends.
    bending: Option<[Vector3<f64>; 3]>,
    /// Sag by each joint where the workpiece was touched off [m], if joints sag.
    sag: Option<[Vector3<f64>; 6]>,
    /// What the force follows, if it does.
    follows: Option<FollowedTip>,
}

/// The tip, whose shift the force follows, where a point above it is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
struct FollowedTip {
    /// Parts of the planned force [N].
    force: [Vector3<f64>; 3],
    /// Parts of the stiffness of the cut.
    stiffness: [CutStiffness; 3],
    /// The undeflected tip from where it should be [m].
    shift: Vector3<f64>,
    /// Lever of a force on the tip about each joint [m].
    levers: [Vector3<f64>; 6],
    /// Displacement of the tip per unit turn of each joint [m].
    moves: [Vector3<f64>; 6],
    /// Sag of the tip by each joint where the workpiece was touched off [m], if joints sag.
    sag: Option<[Vector3<f64>; 6]>,
    /// Tool axis.
    axis: Vector3<f64>,
    /// Height of the point above the tip [m].
    height: f64,
}

/// The places of joint commands `q` [rad] at the samples `at`, with the point of the tool at the
/// height `height` [m] above the tip; the tool is where `timing` says, under the `parts` of the
/// force.
pub fn places(
    plan: &Plan,
    (timing, parts): (&TimingLaw, &PartForces),
    (q, at): (&[Joints], &[usize]),
    height: f64,
) -> Vec<DrawnPlace> {
    let cuts = along::parts(&plan.path, timing, parts, &plan.setup.loading, at);
    let shaped = plan.shaper().shaped(q, plan.trajectory.sample_time);
    let place = |(&sample, (force, stiffness)): (&usize, ([Vector3<f64>; 3], [CutStiffness; 3]))| {
        let q = shaped.at(sample);
        let robot = &plan.robot;
        let frames = forward::frames(robot, &q);
        let tcp = frames[5].compose(robot.tool());
        let axis: Vector3<f64> = -tcp.rotation.column(2);
        let (index, s) = (timing.index[sample] as usize, timing.arc_length[sample]);
        let wanted = timing.axis(&plan.path, sample);
        // The point at that height, moved down by the axis that is wanted: its desired place is the
        // tip's.
        let up = |(k, v): (Vector3<f64>, Vector3<f64>)| v + k.cross(&axis) * height;
        let (levers, weight, moves) = match robot.statics() {
            Some(statics) => {
                let held = equilibrium::held(robot, statics, &q, &force.iter().sum());
                (held.levers, held.weight, held.moves)
            }
            None => {
                let springs = jacobian::springs(robot, &frames, &tcp.position);
                (springs.map(|(_, v)| v), [0.0; 6], springs)
            }
        };
        let bending = plan.setup.bending.map(|bending| {
            force.map(|force| {
                let (moved, turned) = bending.deflection(&axis, &force);
                moved + turned.cross(&axis) * height
            })
        });
        let sag = robot.sag().map(|(moved, turned)| moved + turned.cross(&axis) * height);
        let (index, within) = plan.path.within(index, s);
        let target = plan.path.point_at((index, within));
        DrawnPlace {
            arc_length: s,
            target,
            near: NearMove::new(&plan.path.moves()[index].segment, within, (s, target)),
            base: tcp.position + (axis - wanted) * height,
            moves: moves.map(up),
            torque: levers.map(|v| force.map(|force| v.dot(&force))),
            weight,
            bending,
            sag: robot.statics().map(|_| sag),
            follows: plan.setup.stiffness.as_ref().map(|_| FollowedTip {
                force,
                stiffness,
                shift: tcp.position - target,
                levers,
                moves: moves.map(|(_, v)| v),
                sag: robot.statics().map(|_| robot.sag().map(|(moved, _)| moved)),
                axis,
                height,
            }),
        }
    };
    at.iter().zip(cuts).map(place).collect()
}

/// Turn of each joint [rad] under its torque [N m], with nominal stiffness. Which springs the arm has is asked once,
/// not for each joint: this is done for every plant at every place.
#[inline(always)]
fn turns(plan: &Plan, torque: impl Fn(usize) -> f64) -> [f64; 6] {
    match plan.robot.statics() {
        Some(statics) => std::array::from_fn(|joint| statics.springs[joint].turn(torque(joint))),
        None => {
            let compliance = plan.robot.compliance();
            std::array::from_fn(|joint| compliance[joint] * torque(joint))
        }
    }
}

/// Rounds in which a command is shifted, where the force follows the tip: each leaves a share of the
/// rest that is the cut's stiffness beside the arm's.
const SHIFTS: usize = 4;
/// Step of a factor that makes a derivative, even with springs that are not linear.
const STEP: f64 = 1e-3;

impl DrawnPlace {
    /// Growth of the tip's displacement with the factor on each joint's compliance [m].
    pub fn by_joint(&self, plan: &Plan) -> [Vector3<f64>; 6] {
        if self.follows.is_some() {
            return std::array::from_fn(|joint| {
                let tip = |factor: f64| {
                    let mut draw = Draw::NOMINAL;
                    draw.compliance[joint] = factor;
                    self.tip(plan, &draw)
                };
                (tip(1.0 + STEP) - tip(1.0 - STEP)) / (2.0 * STEP)
            });
        }
        let sag = self.sag.unwrap_or_default();
        let turns = turns(plan, |joint| {
            let [t, r, a] = self.torque[joint];
            t + r + a + self.weight[joint]
        });
        std::array::from_fn(|joint| self.moves[joint] * turns[joint] - sag[joint])
    }

    /// The place with commands that take the nominal deflection back: shifted until the nominal tip is
    /// where it should be. The posture stays, which so small a shift hardly changes.
    pub fn compensated(mut self, plan: &Plan) -> Self {
        let rounds = if self.follows.is_some() { SHIFTS } else { 1 };
        for _ in 0..rounds {
            let off = self.tip(plan, &Draw::NOMINAL) - self.target;
            self.base -= off;
            if let Some(follows) = &mut self.follows {
                follows.shift -= off;
            }
        }
        self
    }

    /// The actual tip [m] with a drawn plant.
    pub fn tip(&self, plan: &Plan, draw: &Draw) -> Vector3<f64> {
        if let Some(follows) = &self.follows {
            return self.followed(plan, draw, follows);
        }
        let mut tip = self.base;
        let [tangential, radial, axial] = draw.force;
        let torque = |joint: usize| {
            let [t, r, a] = self.torque[joint];
            t * tangential + r * radial + a * axial + self.weight[joint]
        };
        for (joint, turn) in turns(plan, torque).into_iter().enumerate() {
            tip += self.moves[joint] * (turn * draw.compliance[joint]);
        }
        for (sagged, factor) in self.sag.iter().flatten().zip(draw.compliance) {
            tip -= sagged * factor;
        }
        for (bent, factor) in self.bending.iter().flatten().zip(draw.force) {
            tip += bent * factor;
        }
        tip
    }

    /// The actual tip [m] with a drawn plant where the force follows the deflection.
    fn followed(&self, plan: &Plan, draw: &Draw, follows: &FollowedTip) -> Vector3<f64> {
        let drawn = |parts: &[Vector3<f64>; 3]| {
            parts.iter().zip(draw.force).fold(Vector3::zeros(), |sum, (part, factor)| sum + part * factor)
        };
        let growth = [0, 1].map(|way| drawn(&follows.stiffness.each_ref().map(|part| part.growth[way])));
        let stiffness = CutStiffness { growth, ..follows.stiffness[0] };
        let turned = |force: &Vector3<f64>| -> [f64; 6] {
            let turns = turns(plan, |joint| follows.levers[joint].dot(force) + self.weight[joint]);
            std::array::from_fn(|joint| turns[joint] * draw.compliance[joint])
        };
        let sum = |moves: &[Vector3<f64>; 6], turns: [f64; 6], sag: &Option<[Vector3<f64>; 6]>| {
            let mut sum = Vector3::zeros();
            for (moved, turn) in moves.iter().zip(turns) {
                sum += moved * turn;
            }
            for (sagged, factor) in sag.iter().flatten().zip(draw.compliance) {
                sum -= sagged * factor;
            }
            sum
        };
        let bent = |force: &Vector3<f64>| {
            plan.setup.bending.map(|bending| bending.deflection(&follows.axis, force)).unwrap_or_default()
        };
        let deflect = |force: &Vector3<f64>| {
            (sum(&follows.moves, turned(force), &follows.sag) + bent(force).0, Vector3::zeros())
        };
        let cut = settled(&drawn(&follows.force), &stiffness, &follows.shift, deflect);
        let (moved, leant) = bent(&cut.force);
        self.base
            + sum(&self.moves, turned(&cut.force), &self.sag)
            + moved
            + leant.cross(&follows.axis) * follows.height
    }
}
