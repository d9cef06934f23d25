//! The cut in figures: coefficients, engagement, spindle, and the wall that the mean force and the instant of its making leave.

use crate::cutting::along;
use crate::cutting::material::Model;
use crate::cutting::surface::Wall;
use crate::deviation::{Plan, Sources};
use crate::report::{Budget, Report, budget};
use crate::robot::{compliance, forward};
use crate::units::{DEG, KILOWATT, MINUTE, MM, N_PER_MM, N_PER_MM2};
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Figures by key, the unit in the key.
pub type Figures = BTreeMap<&'static str, f64>;

impl Report {
    /// Feed per tooth of the job [m]; of the full feed, if the chip follows it.
    pub fn feed_per_tooth(&self) -> f64 {
        self.plan.chip.at(self.setup.tempo.feed, None)
    }

    /// Mean power of the cut [W] at that feed per tooth and the job's spindle speed: torque times speed.
    pub fn spindle_power(&self) -> f64 {
        let turns = self.setup.teeth_per_second / f64::from(self.setup.cut.flutes);
        self.setup.cut.torque(self.feed_per_tooth()) * turns * crate::math::TAU
    }

    /// The cut in figures.
    pub fn cut_figures(&self) -> Figures {
        let cut = &self.setup.cut;
        let k = &cut.coefficients;
        let c = self.feed_per_tooth();
        let feed = c * self.setup.teeth_per_second;
        let mut figures = Figures::from([
            ("ktc_n_mm2", k.ktc / N_PER_MM2),
            ("krc_n_mm2", k.krc / N_PER_MM2),
            ("kac_n_mm2", k.kac / N_PER_MM2),
            ("kte_n_mm", k.kte / N_PER_MM),
            ("kre_n_mm", k.kre / N_PER_MM),
            ("kae_n_mm", k.kae / N_PER_MM),
            ("diameter_mm", cut.diameter / MM),
            ("corner_radius_mm", cut.corner_radius / MM),
            ("axial_depth_mm", cut.axial_depth / MM),
            ("feed_per_tooth_mm", c / MM),
            ("mean_chip_mm", cut.mean_chip(c) / MM),
            ("section_mm2", cut.section() / (MM * MM)),
            ("removal_cm3_min", cut.section() * feed * MINUTE * 1e6),
            ("peak_force_n", cut.peak_force(c)),
            ("torque_nm", cut.torque(c)),
            ("tooth_passing_hz", self.setup.teeth_per_second),
            ("power_kw", self.spindle_power() / KILOWATT),
        ]);
        // On the cylinder: exact at the full radius, which a corner does not reach.
        let radius = cut.radius();
        if let Some((entry, exit)) = cut.engagement.at(radius, radius) {
            let radial = radius * (crate::math::cos(entry) - crate::math::cos(exit));
            figures.extend([
                ("entry_deg", entry / DEG),
                ("exit_deg", exit / DEG),
                ("radial_depth_mm", radial / MM),
            ]);
        }
        if let Some(power) = self.setup.spindle_power {
            figures.insert("spindle_power_kw", power / KILOWATT);
        }
        if let Some(bending) = &self.setup.bending {
            figures.insert("tool_bending_um_n", bending.displacement / (1e-3 * MM));
        }
        if let Some(chip) = self.setup.stock.chip {
            figures.insert("made_at_chip_mm", chip / MM);
        }
        if let Some(material) = self.setup.stock.material {
            figures.insert("spread_percent", material.spread);
        }
        if let Model::Kienzle(kienzle) = &self.setup.stock.model {
            figures.extend([("kc11_n_mm2", kienzle.kc11 / N_PER_MM2), ("mc", kienzle.mc)]);
        }
        figures
    }

    /// The walls that the cut leaves, with the deviation into the part (negative: material is left standing) by the mean force and at the instants
    /// when the edge makes the wall, both taken as static: mean over all samples that cut and all heights, and the largest.
    pub fn walls(&self) -> Vec<Figures> {
        self.budget_and_walls().1
    }

    /// [`Report::budget`] and [`Report::walls`], both from one visit to the arm at each sample.
    pub(super) fn budget_and_walls(&self) -> (Budget, Vec<Figures>) {
        let Plan { path, robot, trajectory, .. } = &self.plan;
        let pace = self.plan.pace(Sources::ALL);
        let mut budget = budget::Sum::default();
        let mut walls: Vec<_> = self.setup.cut.walls().into_iter().map(Standing::new).collect();
        let shaped = self.shaped(&self.q);
        along::each(path, &pace, |k, x, axis| {
            let q = shaped.at(k);
            let frames = forward::frames(robot, &q);
            let tip = frames[5].compose(robot.tool());
            budget.take(k, self.parts(k, &q, &frames, &tip.position));
            if pace.engaged[k] < 0.5 || walls.is_empty() {
                return;
            }
            let y = axis.cross(&x);
            let (index, _) = path.locate(pace.arc_length[k]);
            let c = self.plan.chip.at(pace.speed[k], path.moves()[index].spindle);
            let mean_of_turn = self.plan.mean_force.at(c);
            let base = x * mean_of_turn.x + y * mean_of_turn.y + axis * mean_of_turn.z;
            let by =
                |force: Vector3<f64>| compliance::deflection(robot, &q, &frames, &tip.position, &force).0;
            // The compliance is symmetric: what a unit force across the wall moves along F is what F moves across the wall. Springs that are
            // no straight lines are taken as straight around the mean force.
            let (constant, mut moved) = if robot.statics().is_some() {
                let weight = by(Vector3::zeros());
                let moved = by(base + y) - by(base);
                ((by(base) - weight).dot(&y) - moved.dot(&base), moved)
            } else {
                (0.0, by(y))
            };
            if let Some(bending) = &self.plan.bending {
                moved += bending.deflection(&-tip.rotation.column(2), &y).0;
            }
            let moved = Vector3::new(moved.dot(&x), moved.dot(&y), moved.dot(&axis));
            for wall in &mut walls {
                wall.take(c, mean_of_turn, |force| constant + moved.dot(force));
            }
        });
        (budget.budget(trajectory.sample_time), walls.iter().map(Standing::figures).collect())
    }
}

/// A wall and what stands of it, while the samples are visited.
struct Standing {
    wall: Wall,
    /// Feed per tooth of the last sample [m], and the forces of the wall's instants at it [N].
    chip: f64,
    instants: Vec<Vector3<f64>>,
    mean_force: Spread,
    instant_force: Spread,
    by_mean: Spread,
    at_instant: Spread,
}

impl Standing {
    fn new(wall: Wall) -> Self {
        let [mean_force, instant_force, by_mean, at_instant] = [Spread::default(); 4];
        let instants = Vec::new();
        Self { wall, chip: f64::NAN, instants, mean_force, instant_force, by_mean, at_instant }
    }

    /// A sample with the feed per tooth `c` [m] and the mean force `mean` [N] in {T}; `across` is how far a force moves the tip along y of {T} [m].
    fn take(&mut self, c: f64, mean: Vector3<f64>, across: impl Fn(&Vector3<f64>) -> f64) {
        if c != self.chip {
            self.chip = c;
            self.instants = self.wall.instants.iter().map(|force| force.at(c)).collect();
        }
        let side = self.wall.side;
        self.mean_force.take(side * mean.y);
        self.by_mean.take(side * across(&mean));
        for force in &self.instants {
            self.instant_force.take(side * force.y);
            self.at_instant.take(side * across(force));
        }
    }

    fn figures(&self) -> Figures {
        Figures::from([
            ("side", self.wall.side),
            ("mean_force_n", self.mean_force.mean()),
            ("instant_force_n", self.instant_force.mean()),
            ("instant_force_max_n", self.instant_force.largest),
            ("by_mean_force_mm", self.by_mean.mean() / MM),
            ("by_mean_force_max_mm", self.by_mean.largest / MM),
            ("at_instant_mm", self.at_instant.mean() / MM),
            ("at_instant_max_mm", self.at_instant.largest / MM),
        ])
    }
}

/// Mean of signed values and the one of the largest size.
#[derive(Clone, Copy, Default)]
struct Spread {
    sum: f64,
    count: f64,
    largest: f64,
}

impl Spread {
    fn take(&mut self, value: f64) {
        self.sum += value;
        self.count += 1.0;
        if value.abs() > self.largest.abs() {
            self.largest = value;
        }
    }

    fn mean(&self) -> f64 {
        self.sum / self.count.max(1.0)
    }
}
