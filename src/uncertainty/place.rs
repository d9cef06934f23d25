//! A place on the path: where the tip goes there as a function of the drawn plant.
//!
//! Actual tip = shaped pose + C F (eqs. 3.47, 3.48), with C a sum over the joints and F a sum over
//! the parts of the force: bilinear in the factors on both. Springs that are not linear and weight
//! are kept, with the levers held as they are under the nominal force (they turn by less than 1e-3).

use crate::cutting::{MeanForces, along};
use crate::deviation::near::NearMove;
use crate::motion::TimingLaw;
use crate::plan::Plan;
use crate::robot::{Joints, equilibrium, forward, jacobian};
use crate::uncertainty::Draw;
use nalgebra::Vector3;

/// What a place needs to tell where the tip goes.
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
    /// Displacement of the tip per unit turn of each joint [m].
    moves: [Vector3<f64>; 6],
    /// Torque about each joint by each part of the nominal force [N m].
    torque: [[f64; 3]; 6],
    /// Torque of the weight [N m].
    weight: [f64; 6],
    /// Bending of the tool by each part of the nominal force [m], if it bends.
    bending: Option<[Vector3<f64>; 3]>,
    /// Sag by each joint where the workpiece was touched off [m], if joints sag.
    sag: Option<[Vector3<f64>; 6]>,
}

/// The places of joint commands `q` [rad] at the samples `at`, with the point of the tool at the
/// height `height` [m] above the tip; the tool is where `timing` says, under the `parts` of the
/// force.
pub fn places(
    plan: &Plan,
    (timing, parts): (&TimingLaw, &[MeanForces; 3]),
    (q, at): (&[Joints], &[usize]),
    height: f64,
) -> Vec<DrawnPlace> {
    let forces = along::parts(&plan.path, timing, parts, &plan.setup.loading, at);
    let shaped = plan.shaper().shaped(q, plan.trajectory.sample_time);
    let place = |(&sample, force): (&usize, [Vector3<f64>; 3])| {
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
        }
    };
    at.iter().zip(forces).map(place).collect()
}

impl DrawnPlace {
    /// Turn of each joint [rad] with a drawn force and nominal stiffness.
    fn turns(&self, plan: &Plan, [tangential, radial, axial]: &[f64; 3]) -> [f64; 6] {
        let torque = |joint: usize| {
            let [t, r, a] = self.torque[joint];
            t * tangential + r * radial + a * axial + self.weight[joint]
        };
        match plan.robot.statics() {
            Some(statics) => std::array::from_fn(|joint| statics.springs[joint].turn(torque(joint))),
            None => std::array::from_fn(|joint| plan.robot.compliance()[joint] * torque(joint)),
        }
    }

    /// Displacement of the tip by each joint's turn [m] with a drawn force and nominal stiffness.
    pub fn by_joint(&self, plan: &Plan, force: &[f64; 3]) -> [Vector3<f64>; 6] {
        let turns = self.turns(plan, force);
        let sag = self.sag.unwrap_or_default();
        std::array::from_fn(|joint| self.moves[joint] * turns[joint] - sag[joint])
    }

    /// The actual tip [m] with a drawn plant.
    pub fn tip(&self, plan: &Plan, draw: &Draw) -> Vector3<f64> {
        let mut tip = self.base;
        for ((moved, turn), factor) in
            self.moves.iter().zip(self.turns(plan, &draw.force)).zip(draw.compliance)
        {
            tip += moved * (turn * factor);
        }
        for (sagged, factor) in self.sag.iter().flatten().zip(draw.compliance) {
            tip -= sagged * factor;
        }
        for (bent, factor) in self.bending.iter().flatten().zip(draw.force) {
            tip += bent * factor;
        }
        tip
    }
}
