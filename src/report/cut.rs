//! Cutting figures: coefficients, engagement, spindle load, and the error of the walls, by the mean
//! force and at the instants when the edge generates them.

use crate::cutting::material::Model;
use crate::cutting::surface::Wall;
use crate::cutting::{CutLoad, PlaceFigures, along};
use crate::deviation::Sources;
use crate::math;
use crate::plan::Plan;
use crate::report::{Budget, Report, budget};
use crate::robot::{compliance, forward};
use crate::units::{DEG, KILOWATT, MINUTE, MM, N_PER_MM, N_PER_MM2};
use nalgebra::Vector3;
use serde::Serialize;

/// Cutting figures at the programmed feed; of a program, at that of its move with the largest feed
/// per tooth; in a stock, where the mean force is largest.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct CutFigures {
    /// Tangential cutting coefficient [N/mm^2].
    pub ktc_n_mm2: f64,
    /// Radial cutting coefficient [N/mm^2].
    pub krc_n_mm2: f64,
    /// Axial cutting coefficient [N/mm^2].
    pub kac_n_mm2: f64,
    /// Tangential edge coefficient [N/mm].
    pub kte_n_mm: f64,
    /// Radial edge coefficient [N/mm].
    pub kre_n_mm: f64,
    /// Axial edge coefficient [N/mm].
    pub kae_n_mm: f64,
    /// Diameter of the tool [mm].
    pub diameter_mm: f64,
    /// Corner radius of the tool [mm].
    pub corner_radius_mm: f64,
    /// Axial depth of cut [mm].
    pub axial_depth_mm: f64,
    /// Feed per tooth [mm].
    pub feed_per_tooth_mm: f64,
    /// Mean chip thickness [mm].
    pub mean_chip_mm: f64,
    /// Thickest chip of a turn [mm].
    pub largest_chip_mm: f64,
    /// Cross-section of the material in the tool's way [mm^2].
    pub section_mm2: f64,
    /// Material removal rate [cm^3/min].
    pub removal_cm3_min: f64,
    /// Largest force within a revolution [N].
    pub peak_force_n: f64,
    /// Mean torque on the tool [N m].
    pub torque_nm: f64,
    /// Tooth passing frequency [Hz].
    pub tooth_passing_hz: f64,
    /// Mean cutting power [kW].
    pub power_kw: f64,
    /// Entry immersion angle on the tool's cylinder [deg].
    pub entry_deg: f64,
    /// Exit immersion angle on the tool's cylinder [deg].
    pub exit_deg: f64,
    /// Radial depth of cut [mm].
    pub radial_depth_mm: f64,
    /// The stock that the engagement follows, in words; if there is one, entry, exit, depths, chip, force
    /// and power are those of the place where the mean force is largest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stock: Option<String>,
    /// Volume that the program removes from the stock [cm^3], if one is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub removed_cm3: Option<f64>,
    /// Share of the length of the cutting moves on which the tool touches nothing, if a stock is
    /// given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub air_share: Option<f64>,
    /// Width of a cell [mm], if the stock is followed as a map of heights; else it is exact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stock_cell_mm: Option<f64>,
    /// Largest angle in material at the tip [deg], if a stock is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_engaged_deg: Option<f64>,
    /// Rated power of the spindle [kW], if given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spindle_power_kw: Option<f64>,
    /// Rated torque of the spindle [N m], if given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spindle_torque_nm: Option<f64>,
    /// Bending of the tool at its tip [um/N], unless it is rigid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tool_bending_um_n: Option<f64>,
    /// Chip thickness for which the coefficients were derived [mm], if they depend on it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub made_at_chip_mm: Option<f64>,
    /// Spread of the coefficients [%], if the material comes from the library.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spread_percent: Option<f64>,
    /// Specific cutting force of a 1 mm by 1 mm chip [N/mm^2], for a Kienzle material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kc11_n_mm2: Option<f64>,
    /// Exponent mc, for a Kienzle material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mc: Option<f64>,
}

/// The cut at a place, in SI.
struct LocalCut {
    axial: f64,
    radial: f64,
    /// Entry and exit [rad].
    angles: (f64, f64),
    chip: f64,
    /// Thickest chip of a turn for 1 m of feed per tooth.
    thickest: f64,
    section: f64,
    peak: f64,
    torque: f64,
}

/// A wall left by the cut: the forces across it, and the static deviation into the part (negative:
/// material is left standing), by the mean force and at the instants when the edge generates the
/// wall.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WallFigures {
    /// Side of the part along y of {T}: 1 is left of the feed, -1 right of it.
    pub side: f64,
    /// Mean force into the part [N].
    pub mean_force_n: f64,
    /// Mean force into the part at the instants when the edge generates the wall [N].
    pub instant_force_n: f64,
    /// The largest of these [N].
    pub instant_force_max_n: f64,
    /// Deviation by the mean force, averaged over all cutting samples [mm].
    pub by_mean_force_mm: f64,
    /// The largest of these [mm].
    pub by_mean_force_max_mm: f64,
    /// Deviation at those instants, averaged over all cutting samples and all heights [mm].
    pub at_instant_mm: f64,
    /// The largest of these [mm].
    pub at_instant_max_mm: f64,
}

impl Report {
    /// Feed per tooth at the programmed feed [m]; of a program, that of its move with the largest.
    pub fn feed_per_tooth(&self) -> f64 {
        let setup = self.setup();
        setup.heaviest.map_or_else(|| setup.loading.largest_chip(&setup.path), |place| place.chip)
    }

    /// Mean cutting power [W] at [`Report::feed_per_tooth`] and the job's spindle speed: torque
    /// times speed.
    pub fn spindle_power(&self) -> f64 {
        let turns = self.setup().teeth_per_second / f64::from(self.setup().cut.flutes);
        self.local_cut().torque * turns * math::TAU
    }

    /// Mean torque on the tool [N m] at [`Report::feed_per_tooth`].
    pub fn spindle_torque(&self) -> f64 {
        self.local_cut().torque
    }

    /// Largest force within a revolution [N] at [`Report::feed_per_tooth`].
    pub fn peak_force(&self) -> f64 {
        self.local_cut().peak
    }

    /// Force over one revolution in even steps of the immersion angle: angles [rad] and forces [N] in
    /// {T}; in a stock where the mean force is largest.
    pub fn revolution(&self, steps: usize) -> (Vec<f64>, Vec<Vector3<f64>>) {
        let (cut, c) = (&self.setup().cut, self.feed_per_tooth());
        self.heaviest_contact()
            .map_or_else(|| cut.revolution(steps, c), |contact| cut.revolution_in(&contact, steps, c))
    }

    /// The cut at [`Report::feed_per_tooth`]: the stated one, or where it is heaviest in the stock.
    fn local_cut(&self) -> LocalCut {
        let (setup, c) = (self.setup(), self.feed_per_tooth());
        let cut = &setup.cut;
        let radius = cut.radius();
        let Some(contact) = self.heaviest_contact() else {
            // On the cylinder: at the full radius, which the corner does not reach, it is exact. A stock
            // that is never touched takes no depth.
            let (entry, exit) = cut.engagement.at(radius);
            return LocalCut {
                axial: cut.axial_depth,
                radial: radius * (math::cos(entry) - math::cos(exit)),
                angles: (entry, exit),
                chip: cut.mean_chip(c),
                thickest: cut.largest_chip(),
                section: cut.section(),
                peak: cut.peak_force(c),
                torque: cut.torque(c),
            };
        };
        let PlaceFigures { section, chip, torque } = cut.figures_in(&contact);
        LocalCut {
            axial: contact.axial_depth(),
            radial: contact.radial_depth(|height| cut.radius_at(height)),
            angles: contact.bounds().unwrap_or_default(),
            chip: chip * c,
            thickest: cut.largest_chip_in(&contact),
            section,
            peak: cut.peak_force_in(&contact, c),
            torque: torque[0] * c + torque[1],
        }
    }

    /// The cutting figures of the job.
    pub fn cut_figures(&self) -> CutFigures {
        let setup = self.setup();
        let cut = &setup.cut;
        let k = &cut.coefficients;
        let c = self.feed_per_tooth();
        let feed = c * setup.teeth_per_second;
        let local = self.local_cut();
        let whole = self.whole_cut();
        let kienzle = match &setup.material.model {
            Model::Kienzle(kienzle) => Some(kienzle),
            _ => None,
        };
        CutFigures {
            ktc_n_mm2: k.ktc / N_PER_MM2,
            krc_n_mm2: k.krc / N_PER_MM2,
            kac_n_mm2: k.kac / N_PER_MM2,
            kte_n_mm: k.kte / N_PER_MM,
            kre_n_mm: k.kre / N_PER_MM,
            kae_n_mm: k.kae / N_PER_MM,
            diameter_mm: cut.diameter / MM,
            corner_radius_mm: cut.corner_radius / MM,
            axial_depth_mm: local.axial / MM,
            feed_per_tooth_mm: c / MM,
            mean_chip_mm: local.chip / MM,
            largest_chip_mm: local.thickest * c / MM,
            section_mm2: local.section / (MM * MM),
            removal_cm3_min: local.section * feed * MINUTE * 1e6,
            peak_force_n: local.peak,
            torque_nm: local.torque,
            tooth_passing_hz: setup.teeth_per_second,
            power_kw: self.spindle_power() / KILOWATT,
            entry_deg: local.angles.0 / DEG,
            exit_deg: local.angles.1 / DEG,
            radial_depth_mm: local.radial / MM,
            stock: setup.stock.clone(),
            removed_cm3: whole.map(|whole| whole.removed * 1e6),
            air_share: whole.map(|whole| whole.air),
            stock_cell_mm: setup.contacts.as_ref().and_then(|contacts| contacts.cell).map(|cell| cell / MM),
            largest_engaged_deg: whole.map(|whole| whole.engaged / DEG),
            spindle_power_kw: setup.spindle_power.map(|power| power / KILOWATT),
            spindle_torque_nm: setup.spindle_torque,
            tool_bending_um_n: setup.bending.map(|bending| bending.displacement / (1e-3 * MM)),
            made_at_chip_mm: setup.material.chip.map(|chip| chip / MM),
            spread_percent: setup.material.material.map(|material| material.spread),
            kc11_n_mm2: kienzle.map(|kienzle| kienzle.kc11 / N_PER_MM2),
            mc: kienzle.map(|kienzle| kienzle.mc),
        }
    }

    /// The walls left by the cut.
    pub fn walls(&self) -> Vec<WallFigures> {
        self.budget_and_walls().1
    }

    /// [`Report::budget`] and [`Report::walls`], both from one pass over the samples.
    pub(super) fn budget_and_walls(&self) -> (Budget, Vec<WallFigures>) {
        let Plan { path, robot, trajectory, .. } = &self.plan;
        let timing = self.plan.timing(Sources::ALL);
        let mut budget = budget::Sum::default();
        let loads = self.setup().loading.along(path);
        // In a stock the walls change along the path.
        let stated = self.setup().contacts.is_none().then(|| self.setup().cut.walls());
        let mut walls: Vec<_> = stated.unwrap_or_default().into_iter().map(Standing::new).collect();
        let shaped = self.shaped(&self.q);
        along::each(path, &timing, |k, x, axis| {
            let q = shaped.at(k);
            let frames = forward::frames(robot, &q);
            let tip = frames[5].compose(robot.tool());
            budget.take(k, self.parts(k, &q, &frames, &tip.position));
            let load = loads.at(&timing, k);
            // At rest nothing is cut.
            if timing.engaged[k] < 0.5 || load == CutLoad::default() || walls.is_empty() {
                return;
            }
            let y = axis.cross(&x);
            let mean_of_turn = along::mean_at(&self.setup().mean_force, path, &timing, k).under(&load);
            let base = x * mean_of_turn.x + y * mean_of_turn.y + axis * mean_of_turn.z;
            let by =
                |force: Vector3<f64>| compliance::deflection(robot, &q, &frames, &tip.position, &force).0;
            // The compliance is symmetric: a unit force across the wall moves the tip along F by as
            // much as F moves it across the wall. Nonlinear springs are linearised about the mean
            // force.
            let (constant, mut moved) = if robot.statics().is_some() {
                let weight = by(Vector3::zeros());
                let moved = by(base + y) - by(base);
                ((by(base) - weight).dot(&y) - moved.dot(&base), moved)
            } else {
                (0.0, by(y))
            };
            if let Some(bending) = &self.setup().bending {
                moved += bending.deflection(&-tip.rotation.column(2), &y).0;
            }
            let moved = Vector3::new(moved.dot(&x), moved.dot(&y), moved.dot(&axis));
            for wall in &mut walls {
                wall.take(load, mean_of_turn, |force| constant + moved.dot(force));
            }
        });
        (budget.budget(trajectory.sample_time), walls.iter().map(Standing::figures).collect())
    }
}

/// A wall with its running statistics.
struct Standing {
    wall: Wall,
    /// Load at the last sample, for which `instants` holds the wall's forces [N].
    load: CutLoad,
    instants: Vec<Vector3<f64>>,
    mean_force: Spread,
    instant_force: Spread,
    by_mean: Spread,
    at_instant: Spread,
}

impl Standing {
    fn new(wall: Wall) -> Self {
        let [mean_force, instant_force, by_mean, at_instant] = [Spread::default(); 4];
        let instants = vec![Vector3::zeros(); wall.instants.len()];
        Self { wall, load: CutLoad::default(), instants, mean_force, instant_force, by_mean, at_instant }
    }

    /// Adds a sample with its load and mean force `mean` [N] in {T}; `across` gives the displacement
    /// of the tip along y of {T} under a force [m].
    fn take(&mut self, load: CutLoad, mean: Vector3<f64>, across: impl Fn(&Vector3<f64>) -> f64) {
        if load != self.load {
            self.load = load;
            self.instants = self.wall.instants.iter().map(|force| force.under(&load)).collect();
        }
        let side = self.wall.side;
        self.mean_force.take(side * mean.y);
        self.by_mean.take(side * across(&mean));
        for force in &self.instants {
            self.instant_force.take(side * force.y);
            self.at_instant.take(side * across(force));
        }
    }

    fn figures(&self) -> WallFigures {
        WallFigures {
            side: self.wall.side,
            mean_force_n: self.mean_force.mean(),
            instant_force_n: self.instant_force.mean(),
            instant_force_max_n: self.instant_force.largest,
            by_mean_force_mm: self.by_mean.mean() / MM,
            by_mean_force_max_mm: self.by_mean.largest / MM,
            at_instant_mm: self.at_instant.mean() / MM,
            at_instant_max_mm: self.at_instant.largest / MM,
        }
    }
}

/// Mean of signed values, and the value of largest magnitude.
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
