//! Warnings about a cut that is more than spindle or tool take.

use crate::deviation::Sources;
use crate::path::Move;
use crate::report::in_stock::{SampleCut, above};
use crate::report::span::spans;
use crate::report::{Report, Warning, millimetres};
use crate::stock::Contacts;
use crate::units::KILOWATT;

/// The warnings.
pub(super) fn warnings(report: &Report) -> Vec<Warning> {
    let [least, most] = report.setup().chip_limits;
    [power(report), torque(report), chip(report, most, true), chip(report, least, false)]
        .into_iter()
        .flatten()
        .collect()
}

/// A cut that needs more power than the spindle has.
fn power(report: &Report) -> Option<Warning> {
    let rated = report.setup().spindle_power?;
    let text = |what: &str, power: f64| {
        format!(
            "{what} {:.2} kW on average, more than the spindle's {:.2} kW; coefficients are known to ±30 %",
            power / KILOWATT,
            rated / KILOWATT
        )
    };
    of_spindle(report, "spindle-power", (rated, report.spindle_power()), |cut| cut.power, text)
}

/// A cut that needs more torque than the spindle has.
fn torque(report: &Report) -> Option<Warning> {
    let rated = report.setup().spindle_torque?;
    let text = |what: &str, torque: f64| {
        format!(
            "{what} {torque:.2} N m on average, more than the spindle's {rated:.2} N m; coefficients are known to \
             ±30 %"
        )
    };
    of_spindle(report, "spindle-torque", (rated, report.spindle_torque()), |cut| cut.torque, text)
}

/// A figure above the `rated` one: where it is along a stock, or all along where it is `stated`.
fn of_spindle(
    report: &Report,
    code: &'static str,
    (rated, stated): (f64, f64),
    figure: fn(&SampleCut) -> f64,
    text: impl Fn(&str, f64) -> String,
) -> Option<Warning> {
    if let Some((spans, largest, line)) = above(report, rated, figure) {
        let warning = Warning::new(code, text(&format!("{}the cut takes up to", at_line(line)), largest));
        return warning.within(&spans, report.plan.trajectory.sample_time);
    }
    (stated > rated).then(|| Warning::new(code, text("the cut takes", stated)))
}

/// Where the thickest chip of a turn is thicker, or thinner, than a `limit` [m] at the programmed feed.
fn chip(report: &Report, limit: Option<f64>, thicker: bool) -> Option<Warning> {
    let (limit, setup, path) = (limit?, report.setup(), &report.plan.path);
    let of_station = |contacts: &Contacts| -> Vec<f64> {
        contacts.each().map(|(_, contact)| setup.cut.largest_chip_in(&contact)).collect()
    };
    let stations = setup.contacts.as_deref().map(of_station);
    let stated = setup.cut.largest_chip();
    // For 1 m of feed per tooth: in a stock the thicker one of the two stations around.
    let thickest = |index: usize, within: f64| match setup.contacts.as_deref().zip(stations.as_ref()) {
        None => stated,
        Some((contacts, chips)) => {
            contacts.around(index, within).map_or(0.0, |(from, to, _)| chips[from].max(chips[to]))
        }
    };
    let timing = report.plan.timing(Sources::ALL);
    let programmed = |step: &Move| Some(setup.loading.chip.at(setup.loading.programmed(step)?, step.spindle));
    // Not a number where nothing is cut.
    let chip = |k: usize| {
        let index = timing.index[k] as usize;
        let chip = programmed(&path.moves()[index]).filter(|_| timing.speed[k] > 0.0);
        let chip = chip.map(|chip| chip * thickest(index, timing.arc_length[k] - path.start(index)));
        chip.filter(|chip| *chip > 0.0).unwrap_or(f64::NAN)
    };
    let chips: Vec<f64> = (0..report.samples()).map(chip).collect();
    let is_off = |k: usize| if thicker { chips[k] > limit } else { chips[k] < limit };
    let order = |a: &usize, b: &usize| chips[*a].total_cmp(&chips[*b]);
    let off = (0..chips.len()).filter(|&k| is_off(k));
    let worst = if thicker { off.max_by(order) } else { off.min_by(order) }?;
    let line = at_line(path.moves()[timing.index[worst] as usize].line);
    let (own, limit) = (millimetres(chips[worst]), millimetres(limit));
    let (code, message) = if thicker {
        (
            "chip-too-thick",
            format!(
                "{line}chips are up to {own} mm thick at the programmed feed, more than the tool's largest, {limit} mm"
            ),
        )
    } else {
        (
            "chip-too-thin",
            format!(
                "{line}chips are at most {own} mm thick at the programmed feed, less than the tool's least, \
                 {limit} mm: edges rub"
            ),
        )
    };
    Warning::new(code, message).within(&spans(chips.len(), is_off), report.plan.trajectory.sample_time)
}

/// A line of the program in words; none of a path that has no lines.
fn at_line(line: usize) -> String {
    if line > 0 { format!("line {line}: ") } else { String::new() }
}
