//! The cut along the path where a stock is given: columns and figures. They are those of the nominal
//! cut, with the tool where it should be.

use crate::cutting::{Loads, PlaceFigures};
use crate::deviation::Sources;
use crate::math::TAU;
use crate::motion::TimingLaw;
use crate::report::columns::Series;
use crate::report::span::{Span, spans};
use crate::report::{Report, Warning};
use crate::stock::{Collider, Collision, Contact, Contacts};
use crate::units::{DEG, KILOWATT, MINUTE, MM};
use std::borrow::Cow;
use std::sync::Arc;

/// Warnings about the cut in a stock: what meets material without cutting it.
pub(super) fn collisions(report: &Report) -> Vec<Warning> {
    let Some(contacts) = &report.setup().contacts else { return Vec::new() };
    let kinds = [Collider::Rapid, Collider::Shank, Collider::Holder].into_iter();
    let collisions = kinds.filter_map(|kind| collision(report, contacts, kind));
    untouched(contacts)
        .into_iter()
        .chain(collisions)
        .chain(coarse(report, contacts))
        .chain(pulls_in(report))
        .collect()
}

/// Code of the warning that nothing is cut.
pub(crate) const UNTOUCHED: &str = "stock-untouched";

/// A stock that the tool never meets: it belongs to another program, or lies elsewhere.
fn untouched(contacts: &Contacts) -> Option<Warning> {
    let message = "the tool never touches the stock: no force acts, and the errors of the part are unknown";
    let all_air = contacts.each().all(|(_, contact)| contact.is_air());
    all_air.then(|| Warning::new(UNTOUCHED, message))
}

/// A cut that pulls the tool in about as hard as the arm holds it back, or harder.
fn pulls_in(report: &Report) -> Option<Warning> {
    let first = *report.unsettled.first()?;
    let timing = &report.plan.trajectory.timing;
    let line = match report.plan.path.moves()[timing.index[first] as usize].line {
        0 => String::new(),
        line => format!("line {line}: "),
    };
    let spans = spans(report.samples(), |k| report.unsettled.binary_search(&k).is_ok());
    let message = format!(
        "{line}the cut pulls the tool into the material about as hard as the arm holds it back, or harder, so \
         force and deflection have no stable balance; the figures are those of the planned cut: reduce the \
         depth, or mill in the other direction"
    );
    Warning::new("cut-pulls-in", message).within(&spans, report.plan.trajectory.sample_time)
}

/// A map of heights whose cells are wide for the tool: the stock is large, the tool small.
fn coarse(report: &Report, contacts: &Contacts) -> Option<Warning> {
    let diameter = report.setup().cut.diameter;
    let cell = contacts.cell.filter(|cell| *cell > COARSE * diameter)?;
    let message = format!(
        "the stock is resolved in cells of {:.2} mm, which is coarse for a {:.2} mm tool: the engagement is approximate; \
         enter a smaller stock",
        cell / MM,
        diameter / MM
    );
    Some(Warning::new("stock-coarse", message))
}

/// The warning about one kind of collisions.
fn collision(report: &Report, contacts: &Contacts, kind: Collider) -> Option<Warning> {
    let path = &report.plan.path;
    let hits: Vec<&Collision> = contacts.collisions.iter().filter(|hit| hit.collider == kind).collect();
    let first = hits.first()?;
    let line = match path.moves()[first.index].line {
        0 => String::new(),
        line => format!("line {line}: "),
    };
    let others = match hits.len() - 1 {
        0 => String::new(),
        1 => ", and in another move".into(),
        more => format!(", and in {more} other moves"),
    };
    let (code, what) = match kind {
        Collider::Rapid => ("rapid-in-stock", "a rapid move goes through the stock"),
        Collider::Shank => {
            ("shank-in-stock", "the stock is higher than the flutes: the shank or holder runs into it")
        }
        Collider::Holder => ("holder-in-stock", "the holder runs into the stock"),
    };
    let timing = &report.plan.trajectory.timing;
    let struck = |k: usize| {
        let index = timing.index[k] as usize;
        let hit = hits.binary_search_by_key(&index, |hit| hit.index).ok().map(|place| hits[place]);
        hit.is_some_and(|hit| timing.arc_length[k] >= path.start(index) + hit.within)
    };
    let spans = spans(report.samples(), struck);
    let warning = Warning::new(code, format!("{line}{what}{others}; no force is computed for that"));
    // A short move may lie between two samples.
    warning.clone().within(&spans, report.plan.trajectory.sample_time).or(Some(warning))
}

/// Where a figure of the cut in the stock is above its `rated` value, with its largest value and the line
/// of that; `None` without a stock.
pub(super) fn above(
    report: &Report,
    rated: f64,
    figure: impl Fn(&SampleCut) -> f64,
) -> Option<(Vec<Span>, f64, usize)> {
    let contacts = report.setup().contacts.as_ref()?;
    let timing = report.plan.timing(Sources::ALL);
    let loads = report.setup().loading.along(&report.plan.path);
    let mut last = LastFigures::default();
    let at = |k: usize| figure(&report.sample_cut(contacts, &timing, &loads, k, &mut last));
    let values: Vec<f64> = (0..report.samples()).map(at).collect();
    let worst = (0..values.len()).max_by(|&a, &b| values[a].total_cmp(&values[b]))?;
    let line = report.plan.path.moves()[timing.index[worst] as usize].line;
    Some((spans(values.len(), |k| values[k] > rated), values[worst], line))
}

/// Width of a cell from which it is wide for the tool, as a part of the diameter.
const COARSE: f64 = 0.05;

/// Figures of all that a program cuts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WholeCut {
    /// Volume removed [m^3].
    pub(super) removed: f64,
    /// Share of the length of the moves that cut on which the tool touches nothing.
    pub(super) air: f64,
    /// Largest angle in material at the tip [rad].
    pub(super) engaged: f64,
}

/// The cut at a sample.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct SampleCut {
    entry: f64,
    exit: f64,
    engaged: f64,
    axial: f64,
    radial: f64,
    removal: f64,
    chip: f64,
    /// Power [W].
    pub(super) power: f64,
    /// Torque [N m].
    pub(super) torque: f64,
}

/// Figures at the last two stations, for samples are closer than stations.
#[derive(Default)]
struct LastFigures([Option<(usize, PlaceFigures)>; 2]);

impl LastFigures {
    fn at(&mut self, station: usize, figures: impl FnOnce() -> PlaceFigures) -> PlaceFigures {
        if let Some((_, known)) = self.0.iter().flatten().find(|(at, _)| *at == station) {
            return *known;
        }
        let found = figures();
        self.0 = [self.0[1], Some((station, found))];
        found
    }
}

/// A column: key, label, unit, and its value in that unit.
type CutColumn = (&'static str, &'static str, &'static str, fn(&SampleCut) -> f64);

const COLUMNS: [CutColumn; 9] = [
    ("entry_deg", "Entry angle", "deg", |cut| cut.entry / DEG),
    ("exit_deg", "Exit angle", "deg", |cut| cut.exit / DEG),
    ("engaged_deg", "Engaged angle", "deg", |cut| cut.engaged / DEG),
    ("axial_depth_mm", "Axial depth", "mm", |cut| cut.axial / MM),
    ("radial_depth_mm", "Radial depth", "mm", |cut| cut.radial / MM),
    ("removal_cm3_min", "Material removal rate", "cm³/min", |cut| cut.removal * MINUTE * 1e6),
    ("chip_mm", "Mean chip thickness", "mm", |cut| cut.chip / MM),
    ("power_kw", "Cutting power", "kW", |cut| cut.power / KILOWATT),
    ("torque_nm", "Torque on the tool", "N m", |cut| cut.torque),
];

impl Report {
    /// The columns of the cut in the stock; none without one.
    pub(super) fn in_stock(&self) -> Vec<Series<'_>> {
        let Some(contacts) = &self.setup().contacts else { return Vec::new() };
        let timing: Arc<Cow<TimingLaw>> = self.plan.timing(Sources::ALL).into();
        let loads = Arc::new(self.setup().loading.along(&self.plan.path));
        let column = |(key, label, unit, value): CutColumn| {
            let (timing, loads) = (timing.clone(), loads.clone());
            Series::new(key, label, unit, self.samples(), move |samples| {
                let mut last = LastFigures::default();
                let mut at = |k: usize| value(&self.sample_cut(contacts, &timing, &loads, k, &mut last));
                samples.map(&mut at).collect()
            })
        };
        COLUMNS.into_iter().map(column).chain(self.surface_series(timing.clone())).collect()
    }

    /// The cut where the tool is by `timing` at the sample `k`.
    fn sample_cut(
        &self,
        contacts: &Contacts,
        timing: &TimingLaw,
        loads: &Loads,
        k: usize,
        last: &mut LastFigures,
    ) -> SampleCut {
        let (setup, path) = (self.setup(), &self.plan.path);
        let index = timing.index[k] as usize;
        let Some((from, to, share)) = contacts.around(index, timing.arc_length[k] - path.start(index)) else {
            return SampleCut::default();
        };
        let load = loads.at(timing, k);
        let spindle =
            path.moves()[index].spindle.unwrap_or(setup.teeth_per_second / f64::from(setup.cut.flutes));
        let mut at = |station: usize| {
            let contact = contacts.at(station);
            let PlaceFigures { section, chip, torque } = last.at(station, || setup.cut.figures_in(&contact));
            let torque = torque[0] * load.chip + torque[1] * load.edge;
            let (entry, exit) = contact.bounds().unwrap_or_default();
            SampleCut {
                entry,
                exit,
                engaged: contact.engaged(),
                axial: contact.axial_depth(),
                radial: contact.radial_depth(|height| setup.cut.radius_at(height)),
                removal: section * timing.speed[k],
                chip: chip * load.chip,
                power: torque * spindle * TAU,
                torque,
            }
        };
        let first = at(from);
        if share == 0.0 { first } else { first.towards(&at(to), share) }
    }

    /// Figures of all that the program cuts; `None` without a stock.
    pub(super) fn whole_cut(&self) -> Option<WholeCut> {
        let setup = self.setup();
        let contacts = setup.contacts.as_ref()?;
        let mut whole = WholeCut { removed: 0.0, air: 0.0, engaged: 0.0 };
        let (mut all, mut air) = (0.0, 0.0);
        for ((index, station), contact) in contacts.each() {
            let length = contacts.share(index, station);
            all += length;
            air += if contact.is_air() { length } else { 0.0 };
            whole.removed += setup.cut.figures_in(&contact).section * length;
            whole.engaged = whole.engaged.max(contact.engaged());
        }
        // Without a move that cuts, all is air.
        whole.air = if all > 0.0 { air / all } else { 1.0 };
        Some(whole)
    }

    /// What the tool meets where the force is largest; `None` without a stock, or in the air.
    pub(super) fn heaviest_contact(&self) -> Option<Contact<'_>> {
        let setup = self.setup();
        Some(setup.heaviest?.contact(setup.contacts.as_ref()?))
    }
}

impl SampleCut {
    /// The cut at the share `share` of the way to another one. Where either is in the air, bounds have
    /// no line between them: those of the other hold.
    fn towards(&self, other: &Self, share: f64) -> Self {
        let line = |from: f64, to: f64| from + (to - from) * share;
        let both = self.engaged > 0.0 && other.engaged > 0.0;
        let bound = |from: f64, to: f64| if both { line(from, to) } else { from.max(to) };
        Self {
            entry: bound(self.entry, other.entry),
            exit: bound(self.exit, other.exit),
            engaged: line(self.engaged, other.engaged),
            axial: if both { line(self.axial, other.axial) } else { self.axial.max(other.axial) },
            radial: line(self.radial, other.radial),
            removal: line(self.removal, other.removal),
            chip: line(self.chip, other.chip),
            power: line(self.power, other.power),
            torque: line(self.torque, other.torque),
        }
    }
}
