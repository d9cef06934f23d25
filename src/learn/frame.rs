//! In which frame, unit and sense a log was measured: what its names do not say is found by what fits the run.

use crate::error::Error;
use crate::learn::alignment::{Alignment, ComparedBy, Sampled};
use crate::learn::log::{Clock, FIELD, Log};
use crate::learn::measured::{LoggedRows, PassOptions, RanPass, Said, millimetres};
use crate::math::Pose;
use crate::report::Report;
use crate::robot::Joints;
use crate::units::{DEG, INCH, MM};
use nalgebra::{Matrix3, Vector3};

/// The frames in which a log may be measured: that of the workpiece, the arm's base, and the controller's world.
pub const FRAMES: [&str; 3] = ["workpiece", "base", "world"];

/// Units of a position that states none [m].
const UNITS: [(f64, &str); 3] = [(MM, "mm"), (1.0, "m"), (INCH, "in")];
/// LoggedRows and places of the run by which a frame is chosen.
const CHOSEN_BY: [usize; 2] = [150, 1500];
/// Positions lie at most this share of the path's extent off it, or so far [m].
const OFF: (f64, f64) = (0.05, 0.02);
/// Two courses whose likeness differs by less are told apart by nothing.
const SAME: f64 = 0.02;
/// A force is none if it is at most this share of the largest.
const FREE: f64 = 0.01;
/// Motor angles that are as far from the commands as this are another run's [rad].
const OTHER_RUN: f64 = 1.0 * DEG;

/// A log in the base frame and SI, row by row.
pub(super) struct ReadLog {
    /// Actual less desired tip; empty of a log of forces.
    pub(super) errors: LoggedRows,
    /// Normals of probed points.
    pub(super) normals: Option<LoggedRows>,
    /// Forces on the tool.
    pub(super) forces: Option<LoggedRows>,
    pub(super) alignment: Option<Alignment>,
    pub(super) frame: &'static str,
    /// Whether errors were measured across the path only.
    pub(super) across: bool,
}

/// The frame that a name in [`FRAMES`] stands for, in the base frame.
fn frame(report: &Report, name: &str) -> Pose {
    let setup = report.setup();
    match name {
        "workpiece" => setup.workpiece,
        "world" => setup.world.of_base(&Pose::identity()).inverse(),
        _ => Pose::identity(),
    }
}

/// Reads a log.
///
/// # Errors
/// [`Error::Invalid`] if it does not lie over the run.
pub(super) fn read(
    pass: &RanPass,
    log: &Log,
    options: &PassOptions,
    said: &mut Said,
) -> Result<ReadLog, Error> {
    // Arc lengths count from the beginning of the path, unless another shift is asked for.
    let shift = options.shift.or(match &log.clock {
        Clock::Length(at) => at.first().map(|first| -first),
        _ => None,
    });
    let options = &PassOptions { shift, ..options.clone() };
    let candidates: Vec<&'static str> = options.frame.map_or(FRAMES.to_vec(), |name| vec![name]);
    let mut read = if let Some(position) = &log.position {
        positions(pass, log, (&position.0, position.1), &candidates, options, said)?
    } else if let Some((deviation, stated)) = &log.deviation {
        if !stated {
            said.recognised.push("the unit of dx, dy, dz is not stated and taken to be mm".into());
        }
        deviations(pass, log, deviation, &candidates, options, said)?
    } else if let (Some(motor), Some(load)) = (&log.motor, &log.load) {
        joints(pass, log, (motor, load), options, said)?
    } else {
        ReadLog {
            errors: LoggedRows::default(),
            normals: None,
            forces: None,
            alignment: None,
            frame: candidates[0],
            across: false,
        }
    };
    if let Some(force) = &log.force {
        forces(pass, log, force, &candidates, options, (&mut read, said))?;
    }
    if let Some(alignment) = &read.alignment {
        doubts(alignment, log, said);
    }
    Ok(read)
}

/// What is odd about where a log lies.
fn doubts(alignment: &Alignment, log: &Log, said: &mut Said) {
    let clock = &log.clock;
    let shift = |shift: f64| match clock {
        Clock::Time(_) => format!("{shift:.3} s"),
        _ => millimetres(shift),
    };
    if alignment.is_doubtful() {
        said.odd.push(format!(
            "the alignment looks wrong: the run is taken to begin {} after the first row, but {} fits better",
            shift(alignment.shift),
            shift(alignment.best)
        ));
    }
    // Angles were compared as angles.
    if alignment.is_unlike() && log.load.is_none() {
        said.odd.push(match (alignment.by, clock) {
            (ComparedBy::Distance, _) => format!(
                "positions lie {} from where they should be at their times, root mean square: is it another run's log?",
                millimetres(-alignment.agreement)
            ),
            (ComparedBy::Likeness, Clock::Time(_)) => format!(
                "the log hardly follows what the model expects (correlation {:.2}), so where it lies on the run is unsure",
                alignment.agreement
            ),
            (ComparedBy::Likeness, _) => format!(
                "the log hardly follows what the model expects (correlation {:.2})",
                alignment.agreement
            ),
        });
    }
}

/// The rows that hold a value, for an alignment: places from the first row on, and values.
fn known(clock: &Clock, values: &[Option<Vector3<f64>>]) -> (Vec<f64>, Vec<Vector3<f64>>) {
    let (Clock::Time(at) | Clock::Length(at)) = clock else { return Default::default() };
    at.iter().zip(values).filter_map(|(own, value)| Some((own - at[0], (*value)?))).unzip()
}

fn not_over() -> Error {
    Error::invalid(
        FIELD,
        "a log that does not lie over the run",
        "rows of at least half the run, or half of whose rows are of it",
    )
}

fn positions(
    pass: &RanPass,
    log: &Log,
    (values, unit): (&[Option<Vector3<f64>>], Option<f64>),
    frames: &[&'static str],
    options: &PassOptions,
    said: &mut Said,
) -> Result<ReadLog, Error> {
    let units: Vec<(f64, &str)> = match unit {
        Some(_) => vec![(1.0, "the stated unit")],
        None => UNITS.to_vec(),
    };
    let target = &*pass.reference.target;
    let thin = |count: usize, of: usize| of.div_ceil(count).max(1);
    let rows: Vec<(usize, Vector3<f64>)> = values
        .iter()
        .enumerate()
        .filter_map(|(row, value)| Some((row, (*value)?)))
        .step_by(thin(CHOSEN_BY[0], values.len()))
        .collect();
    let tips: Vec<Vector3<f64>> = target.iter().step_by(thin(CHOSEN_BY[1], target.len())).copied().collect();
    let mut best = (f64::INFINITY, frames[0], units[0]);
    for name in frames {
        let frame = frame(pass.report, name);
        for unit in &units {
            let tip = |(row, value): &(usize, Vector3<f64>)| {
                let point = frame.point(&(value * unit.0));
                log.normal.as_ref().map_or(point, |normal| {
                    contact(pass.report, &point, &frame.direction(&normal[*row]), &Vector3::z())
                })
            };
            let off = |row| {
                let tip = tip(row);
                tips.iter().map(|other| (tip - other).norm_squared()).fold(f64::INFINITY, f64::min).sqrt()
            };
            let distances = crate::math::rising(rows.iter().map(off), |distance| *distance);
            let median = distances.get(distances.len() / 2).copied().unwrap_or(f64::INFINITY);
            if median < best.0 * (1.0 - 1e-9) {
                best = (median, name, *unit);
            }
        }
    }
    let (median, name, unit) = best;
    let extent = tips.iter().map(|tip| (tip - tips[0]).norm()).fold(0.0, f64::max);
    if median > (OFF.0 * extent).max(OFF.1) {
        let expected = format!(
            "positions along the path, in the frame of the workpiece, the base or the controller's world: \
             they lie {} off it at best, in that of the {name}",
            millimetres(median)
        );
        return Err(Error::invalid(FIELD, "positions away from the path", expected));
    }
    if options.frame.is_none() {
        said.recognised.push(format!("positions fit the path in the frame of the {name}"));
    }
    if values.iter().flatten().count() > 0 && units.len() > 1 {
        said.recognised.push(format!("the unit of positions is not stated; {} fits", unit.1));
    }
    let frame = frame(pass.report, name);
    let tips: Vec<Option<Vector3<f64>>> =
        values.iter().map(|value| value.map(|value| frame.point(&(value * unit.0)))).collect();
    if let Some(normal) = &log.normal {
        let normals: Vec<Vector3<f64>> = normal.iter().map(|normal| frame.direction(normal)).collect();
        return Ok(probed(pass, &tips, &normals, name));
    }
    if log.clock == Clock::None {
        return Ok(unordered(pass, &tips, name));
    }
    let (at, values) = known(&log.clock, &tips);
    let run = pass.sampled(&log.clock, &pass.result.actual);
    let alignment =
        Alignment::of(Sampled { at: &at, values: &values }, run, ComparedBy::Distance, options.shift);
    let alignment = alignment.ok_or_else(not_over)?;
    let (Clock::Time(at) | Clock::Length(at)) = &log.clock else { return Err(not_over()) };
    let on = pass.clock(&log.clock);
    let error = |(own, tip): (&f64, &Option<Vector3<f64>>)| {
        let (below, share) = super::alignment::place(on, own - at[0] - alignment.shift)?;
        Some(pass.off_path(below as f64 + share, &(*tip)?))
    };
    let errors = LoggedRows { values: at.iter().zip(&tips).map(error).collect(), s: vec![] };
    Ok(ReadLog { errors, normals: None, forces: None, alignment: Some(alignment), frame: name, across: true })
}

/// Where the tip was when the tool touched a surface at `point` with this `normal`, out of the material.
fn contact(
    report: &Report,
    point: &Vector3<f64>,
    normal: &Vector3<f64>,
    axis: &Vector3<f64>,
) -> Vector3<f64> {
    let cut = &report.setup().cut;
    let (radius, corner) = (cut.diameter / 2.0, cut.corner_radius);
    let sideways = (normal - axis * normal.dot(axis)).try_normalize(1e-6).unwrap_or_default();
    point
        + sideways * (radius - corner)
        + (normal - axis) * corner * if sideways == Vector3::zeros() { 0.0 } else { 1.0 }
}

/// Points of a surface, in any order: the error is that along the normal, where the tool cut it.
fn probed(
    pass: &RanPass,
    points: &[Option<Vector3<f64>>],
    normals: &[Vector3<f64>],
    frame: &'static str,
) -> ReadLog {
    let path = &pass.report.plan.path;
    let (mut errors, mut along) = (LoggedRows::default(), LoggedRows::default());
    for (point, normal) in points.iter().zip(normals) {
        let Some(point) = point else { continue };
        let near = path.closest(point, 0.5 * path.length(), path.length());
        let axis = path.axis(near.s_on(path));
        let tip = contact(pass.report, point, normal, &axis);
        let closest = path.closest(&tip, 0.5 * path.length(), path.length());
        errors.values.push(Some(normal * (tip - closest.point).dot(normal)));
        errors.s.push(closest.s_on(path));
        along.values.push(Some(*normal));
    }
    along.s.clone_from(&errors.s);
    ReadLog { errors, normals: Some(along), forces: None, alignment: None, frame, across: false }
}

/// Tips in any order.
fn unordered(pass: &RanPass, tips: &[Option<Vector3<f64>>], frame: &'static str) -> ReadLog {
    let path = &pass.report.plan.path;
    let mut errors = LoggedRows::default();
    for tip in tips.iter().flatten() {
        let closest = path.closest(tip, 0.5 * path.length(), path.length());
        errors.values.push(Some(tip - closest.point));
        errors.s.push(closest.s_on(path));
    }
    ReadLog { errors, normals: None, forces: None, alignment: None, frame, across: true }
}

/// The frame in which vectors are most like a course of the run, and where they lie on it then. Frames that are turned
/// alike are one.
fn likest(
    pass: &RanPass,
    clock: &Clock,
    values: &[Option<Vector3<f64>>],
    run: &[Vector3<f64>],
    frames: &[&'static str],
    shift: Option<f64>,
) -> Option<(&'static str, Matrix3<f64>, Alignment)> {
    let (at, values) = known(clock, values);
    let mut best: Option<(&'static str, Matrix3<f64>, Alignment)> = None;
    for name in frames {
        let turn = frame(pass.report, name).rotation;
        let turned: Vec<_> = values.iter().map(|value| turn * value).collect();
        let log = Sampled { at: &at, values: &turned };
        let Some(found) = Alignment::of(log, pass.sampled(clock, run), ComparedBy::Likeness, shift) else {
            continue;
        };
        if best.as_ref().is_none_or(|(_, _, best)| found.agreement.abs() > best.agreement.abs() + SAME) {
            best = Some((name, turn, found));
        }
    }
    best
}

fn deviations(
    pass: &RanPass,
    log: &Log,
    values: &[Option<Vector3<f64>>],
    frames: &[&'static str],
    options: &PassOptions,
    said: &mut Said,
) -> Result<ReadLog, Error> {
    let pattern = pass.pattern();
    let found = likest(pass, &log.clock, values, &pattern, frames, options.shift).ok_or_else(not_over)?;
    let (name, turn, alignment) = found;
    // The model says which way an arm gives way; what a correction leaves may lie either way.
    let is_opposite =
        !options.commanded.corrected && options.commanded.learned.is_empty() && alignment.agreement < -0.5;
    if is_opposite {
        said.odd.push(
            "the deviations are opposite to what a force does, so they are read as desired less actual"
                .into(),
        );
    }
    if options.frame.is_none() {
        said.recognised.push(format!("deviations are taken to be in the frame of the {name}"));
    }
    let sign = if is_opposite { -1.0 } else { 1.0 };
    let errors = values.iter().map(|value| value.map(|value| turn * value * sign)).collect();
    let errors = LoggedRows { values: errors, s: vec![] };
    Ok(ReadLog {
        errors,
        normals: None,
        forces: None,
        alignment: Some(alignment),
        frame: name,
        across: false,
    })
}

fn joints(
    pass: &RanPass,
    log: &Log,
    (motor, load): (&[Joints], &[Joints]),
    options: &PassOptions,
    said: &mut Said,
) -> Result<ReadLog, Error> {
    let shaped = pass.report.shaped(&pass.q);
    let first = |q: &Joints| Vector3::new(q[0], q[1], q[2]);
    let commands: Vec<Vector3<f64>> = (0..pass.q.len()).map(|k| first(&shaped.at(k))).collect();
    let motors: Vec<_> = motor.iter().map(|q| Some(first(q))).collect();
    let (at, values) = known(&log.clock, &motors);
    let log_of_motors = Sampled { at: &at, values: &values };
    let run = pass.sampled(&log.clock, &commands);
    let alignment =
        Alignment::of(log_of_motors, run, ComparedBy::Distance, options.shift).ok_or_else(not_over)?;
    if -alignment.agreement > OTHER_RUN {
        said.odd.push(format!(
            "the motors' angles are {:.1} deg off the commands of this run, on average: is it another run's log?",
            -alignment.agreement / DEG
        ));
    }
    let (Clock::Time(at) | Clock::Length(at)) = &log.clock else { return Err(not_over()) };
    let on = pass.clock(&log.clock);
    let forces = &pass.report.planned_force;
    let most = forces.iter().map(|force| force.norm()).fold(0.0, f64::max);
    let is_free = |own: f64| {
        let place = super::alignment::place(on, own - at[0] - alignment.shift);
        place.is_none_or(|(sample, _)| forces[sample].norm() <= FREE * most)
    };
    let turned: Vec<Joints> = motor.iter().zip(load).map(|(motor, load)| load - motor).collect();
    let free: Vec<Joints> =
        at.iter().zip(&turned).filter(|(own, _)| is_free(**own)).map(|(_, turned)| *turned).collect();
    let zero = if free.len() >= 3 {
        said.recognised.push("the encoders' zeros are set where the tool does not cut".into());
        free.iter().sum::<Joints>() / free.len() as f64
    } else {
        said.odd.push(
            "the tool cuts all along, so an offset between the encoders of a joint counts as deflection"
                .into(),
        );
        Joints::zeros()
    };
    let bent = motor.iter().zip(&turned).map(|(motor, turned)| pass.bent(motor, &(turned - zero)));
    let errors = LoggedRows { values: bent.map(Some).collect(), s: vec![] };
    Ok(ReadLog {
        errors,
        normals: None,
        forces: None,
        alignment: Some(alignment),
        frame: "base",
        across: false,
    })
}

fn forces(
    pass: &RanPass,
    log: &Log,
    values: &[Option<Vector3<f64>>],
    frames: &[&'static str],
    options: &PassOptions,
    (read, said): (&mut ReadLog, &mut Said),
) -> Result<(), Error> {
    let shift = read.alignment.map(|alignment| alignment.shift).or(options.shift);
    let found = likest(pass, &log.clock, values, &pass.report.force, frames, shift).ok_or_else(not_over)?;
    let (name, turn, alignment) = found;
    let is_opposite = alignment.agreement < 0.0;
    if is_opposite {
        said.odd.push(
            "the forces are opposite to those on the tool, so they are read as those on the workpiece".into(),
        );
    }
    if read.alignment.is_none() {
        read.alignment = Some(alignment);
        read.frame = name;
    } else if alignment.is_unlike() {
        said.odd
            .push(format!("the forces hardly follow the model's (correlation {:.2})", alignment.agreement));
    }
    let sign = if is_opposite { -1.0 } else { 1.0 };
    let values = values.iter().map(|value| value.map(|value| turn * value * sign)).collect();
    read.forces = Some(LoggedRows { values, s: vec![] });
    Ok(())
}
