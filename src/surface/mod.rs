//! The surface that is left: by how much walls and floors err, by the place of the arm at the instant the
//! edge passes.
//!
//! A piece of surface is left if the tool cuts it on its way and nothing cuts it later: there is
//! material behind it when the whole program is done ([`Remaining`]). Its excess is how far the tool is
//! from its place on the path, against the surface's normal into the material: above 0, too much material
//! stands there, below 0 too little. The tool is where the static deflection by the mean force takes it, for an
//! arm is too slow to follow single teeth; its own bending counts likewise, what of that changes within a
//! revolution does not.
//!
//! Only where the engagement follows a stock is it known what is cut where. A second pass in the air by the
//! program counts for nothing, though it would take what the first has left too much.

mod facet;
mod left;
mod excess;
pub mod part;
pub mod deviation_map;
pub mod section;
pub mod mesh;

pub use excess::Excesses;
pub use facet::SurfaceKind;
pub(crate) use left::LeftFacets;

use crate::deviation::{Deviation, Sources};
use crate::motion::TimingLaw;
use crate::plan::Plan;
use crate::robot::Joints;
use crate::stock::{Cutter, Remaining};
use crate::uncertainty::{self, Quantiles};
use facet::members;
use nalgebra::Vector3;

/// Places of the list.
const LISTED: usize = 5;
/// Stretches of the run whose worst places are sent through the drawn plants.
const STRETCHES: usize = 248;
/// What a drawn plant may add to an excess after compensation, as a share of that before, for choosing these
/// places.
const ADDS: f64 = 0.3;

/// The surface that a run leaves.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// Where the error is largest with the desired path commanded; `None` if nothing is cut.
    pub before: Option<SurfacePlace>,
    /// Where the error is largest with the compensated path commanded.
    pub after: Option<SurfacePlace>,
    /// The worst places, one for each line of the program, the largest excess before first.
    pub worst: Vec<SurfacePlace>,
    /// The largest excess with the desired path commanded, over the drawn plants [m].
    pub band_before: Quantiles,
    /// The same with the compensated path commanded.
    pub band: Quantiles,
    pub(crate) left: LeftFacets,
}

/// A place of the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePlace {
    /// What it is.
    pub kind: SurfaceKind,
    /// The sample at which it is cut.
    pub sample: usize,
    /// The line of the program; 0 if the path has none.
    pub line: usize,
    /// Arc length of the tool [m].
    pub arc_length: f64,
    /// The point of the nominal surface in the workpiece frame [m].
    pub point: Vector3<f64>,
    /// Its height above the tip [m].
    pub height: f64,
    /// Excess with the desired path commanded [m].
    pub before: f64,
    /// Excess with the compensated path commanded [m].
    pub after: f64,
}

/// The tool of a plan as far as it clears material.
pub(crate) fn cutter(plan: &Plan) -> Cutter {
    let cut = &plan.setup.cut;
    Cutter { radius: cut.radius(), corner: cut.corner_radius, flutes: f64::INFINITY }
}

/// The surface left by the joint commands `desired` [rad] of the desired path, with the deviation `before`, and by
/// those `kept` after compensation, with `after`; `None` where the engagement does not follow a stock.
pub fn surface(
    plan: &Plan,
    (before, after): (&Deviation, &Deviation),
    (desired, kept): (&[Joints], &[Joints]),
) -> Option<Surface> {
    let (contacts, blank) = (plan.setup.contacts.as_ref()?, plan.setup.blank.as_ref()?);
    let cutter = cutter(plan);
    let left = {
        let path = plan.path.placed(&plan.setup.workpiece.inverse());
        let remaining = Remaining::of(&path, blank, &cutter, contacts.cell.is_some());
        LeftFacets::of(&path, contacts, &cutter, &remaining)
    };
    let timing = plan.timing(Sources::ALL);
    let excesses = Excesses::new(plan, &left, contacts);
    let WorstFound { before: worst_before, after: worst_after, lines, stretches } =
        WorstFound::of(&excesses, &timing, (before, after));
    let describe = |found: &Worst| excesses.describe(&timing, (found.sample, found.facet), (before, after));
    let places = |found: Option<Worst>| found.as_ref().map(describe);
    let mut worst: Vec<SurfacePlace> = lines.worst.iter().map(|(_, found)| describe(found)).collect();
    let after = places(worst_after);
    // The worst after compensation belongs in the list as well.
    if let Some(after) = after.filter(|after| !worst.iter().any(|place| place.is_same_line(after))) {
        worst.truncate(LISTED - 1);
        worst.push(after);
    }
    let mut at: Vec<usize> = stretches.iter().flatten().map(|found| found.sample).collect();
    at.extend(worst.iter().map(|place| place.sample));
    at.sort_unstable();
    at.dedup();
    let size = |place: usize, tip: &Vector3<f64>| excesses.largest(&timing, at[place], tip);
    let drawn = |q: &[Joints]| uncertainty::largest(plan, (q, &at), size);
    let band = drawn(kept);
    // The same commands leave the same.
    let band_before = if std::ptr::eq(desired, kept) { band } else { drawn(desired) };
    Some(Surface { before: places(worst_before), after, worst, band_before, band, left })
}

impl SurfacePlace {
    /// Whether both are cut by the same line, or the same way if there are no lines.
    fn is_same_line(&self, other: &Self) -> bool {
        self.line == other.line && (self.line > 0 || self.sample == other.sample)
    }
}

/// The worst facet found so far.
#[derive(Debug, Clone, Copy)]
struct Worst {
    size: f64,
    sample: usize,
    facet: usize,
}

/// What a walk over the samples finds.
struct WorstFound {
    before: Option<Worst>,
    after: Option<Worst>,
    lines: WorstLines,
    stretches: Vec<Option<Worst>>,
}

/// Keeps the larger one.
fn raise(worst: &mut Option<Worst>, found: Worst) {
    if worst.is_none_or(|known| found.size > known.size) {
        *worst = Some(found);
    }
}

impl WorstFound {
    fn of(excesses: &Excesses, timing: &TimingLaw, (before, after): (&Deviation, &Deviation)) -> Self {
        let samples = timing.arc_length.len();
        let stretches = vec![None; STRETCHES.min(samples)];
        let mut survey = Self { before: None, after: None, lines: WorstLines::default(), stretches };
        let moves = excesses.plan.path.moves();
        for sample in 0..samples {
            let set = excesses.set(timing, sample);
            if set == 0 {
                continue;
            }
            let [was, is] = [before, after].map(|run| excesses.at(timing, sample, run));
            let index = timing.index[sample] as usize;
            let line = moves[index].line;
            let key = if line > 0 { (line, 0) } else { (0, index) };
            let stretch = sample * survey.stretches.len() / samples;
            for facet in members(set) {
                let [was, is] = [&was, &is].map(|run| run.of(facet).abs());
                raise(&mut survey.before, Worst { size: was, sample, facet });
                raise(&mut survey.after, Worst { size: is, sample, facet });
                raise(&mut survey.stretches[stretch], Worst { size: is + ADDS * was, sample, facet });
                survey.lines.raise(key, Worst { size: was, sample, facet });
            }
        }
        survey.lines.finish();
        survey
    }
}

/// Line and, without lines, move.
type LineKey = (usize, usize);

/// The worst facets of different lines, the largest first.
#[derive(Default)]
struct WorstLines {
    worst: Vec<(LineKey, Worst)>,
    now: Option<(LineKey, Worst)>,
}

impl WorstLines {
    /// Takes a facet of a line.
    fn raise(&mut self, key: LineKey, found: Worst) {
        match &mut self.now {
            Some((now, worst)) if *now == key => {
                if found.size > worst.size {
                    *worst = found;
                }
            }
            _ => {
                self.finish();
                self.now = Some((key, found));
            }
        }
    }

    /// Sorts in what the last line has left.
    fn finish(&mut self) {
        let Some((key, found)) = self.now.take() else { return };
        match self.worst.iter_mut().find(|(known, _)| *known == key) {
            Some((_, known)) if found.size > known.size => *known = found,
            Some(_) => {}
            None => self.worst.push((key, found)),
        }
        self.worst.sort_by(|a, b| b.1.size.total_cmp(&a.1.size).then(a.1.sample.cmp(&b.1.sample)));
        self.worst.truncate(LISTED);
    }
}
