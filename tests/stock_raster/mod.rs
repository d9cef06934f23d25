//! The engagement from the stock, a second way: a height field in cells of 0.01 mm, cleared by moving
//! a flat end mill of 4 mm along random programs in steps of 0.04 mm, without any geometry of curves.
//!
//! Engagement: at some sixty of Armill's stations of each program, the leading half of the tool's rim
//! is looked up in the cells, direction by direction and between all levels of the program, and
//! held to the arcs of Armill's contact; where the tool dives across, so are the rings of its bottom.
//! Where a border runs along the rim, one cell is worth many degrees. Hence the cells are asked a cell
//! further in, on the rim and a cell further out, with the tool still ten cells short of the station,
//! and what they do not agree on stays open. A range of directions that contradicts Armill must be
//! narrower across the feed than two cells (each border is known to one, and to one more where it is
//! rasterized), or than half a degree. Ramps stand in 16 layers at their side, so the cells are also
//! asked a layer further up and down. Material thinner than a cell does not show: of 12,000 stations of
//! other programs (from 2000 on), one was in such a sliver, and Armill saw it. Of the bottom, 1 % may
//! differ: a ring's cells along a border.
//!
//! Volumes: the cells cleared against the integral of Armill's sections along the path, of which cells
//! are right to 0.01 %. The whole program may differ by 0.5 % (1 % with ramps, which stand in layers).
//! A move alone may differ by 0.5 % (2 % with ramps) and by what Armill's stations promise: 0.2 %
//! of a slot from the middle of their neighbours; a diving tool by the rings of its bottom, which miss
//! 1 % of the disc at worst, where the edge of what is left just touches it (twelve nodes of Gauss and
//! Legendre against the area outside a circle or a line, at all distances).
//!
//! `ARMILL_RASTER_PROGRAMS` sets the number of programs, `ARMILL_RASTER_SEED` the first, and
//! `ARMILL_RASTER_TEXT` prints those that fail:
//!
//! ```sh
//! ARMILL_RASTER_PROGRAMS=200 cargo test --test native stock_raster -- --nocapture
//! ```
#![allow(clippy::disallowed_methods, reason = "independent values come from the standard library")]
#![allow(clippy::print_stdout, reason = "the counts are worth seeing: cargo test -- --nocapture")]

mod cells;
mod programs;

use armill::Progress;
use armill::path::gcode;
use armill::path::{Move, MovePace, Path};
use armill::stock::{Contact, Cutter, Solid, contacts};
use cells::{BEFORE, CELL, Look, R, Raster, STEP, difference, difference_below};
use nalgebra::Vector2;
use programs::{Writer, stock};
use std::f64::consts::{PI, TAU};

/// Volume per length of path [mm^2] that a contact takes.
fn section(contact: &Contact<'_>) -> f64 {
    let sides =
        contact.sides.iter().map(|arc| R * 1e-3 * (arc.entry.cos() - arc.exit.cos()) * (arc.to - arc.from));
    let floors = contact.floors.iter().map(|arc| arc.radius * arc.width * (arc.exit - arc.entry));
    (sides.sum::<f64>() * contact.across + floors.sum::<f64>() * contact.down) * 1e6
}

fn program(text: &str) -> Path {
    let options = gcode::Options { field: "text".into(), ..Default::default() };
    Path::of_program(&gcode::program(text, &options, |_| ()).unwrap()).unwrap()
}

fn is_rapid(step: &Move) -> bool {
    matches!(step.pace, MovePace::Rapid)
}

/// Heights of both ends of a move [mm] if it is a ramp or a helix.
fn ramp(step: &Move) -> Option<[f64; 2]> {
    let (length, start) = (step.segment.length(), step.segment.point(0.0));
    let across = (1..4).any(|k| (step.segment.point(length * f64::from(k) / 4.0) - start).xy().norm() > 1e-9);
    let ends = [start.z * 1e3, step.segment.point(length).z * 1e3];
    (across && ends[0] != ends[1] && !is_rapid(step)).then_some(ends)
}

/// Stations to look at: some `count` of them, each clear of the corners of the path.
fn chosen(path: &Path, stations: &[(usize, f64)], count: usize) -> Vec<usize> {
    let margin = (BEFORE + 2.0 * CELL) / 1e3;
    let moves = path.moves();
    let mut corners = vec![0.0, path.length()];
    let bends = path.corners().zip(moves.windows(2));
    corners.extend(bends.filter(|(c, pair)| c.angle > 0.03 || is_rapid(&pair[0])).map(|(c, _)| c.s));
    corners.sort_by(f64::total_cmp);
    let fits = |&k: &usize| {
        let (index, within) = stations[k];
        let s = path.start(index) + within;
        let next = corners.partition_point(|corner| *corner < s).clamp(1, corners.len() - 1);
        let level = path.tangent(s).xy().norm() > 1e-6;
        level && !is_rapid(&moves[index]) && s - corners[next - 1] > margin && corners[next] - s > margin
    };
    let all: Vec<usize> = (0..stations.len()).filter(fits).collect();
    (0..count.min(all.len())).map(|k| all[k * all.len() / count.min(all.len())]).collect()
}

/// What a program has shown: stations looked at, directions left open and engaged, volume [mm^3].
#[derive(Default)]
struct Seen {
    stations: usize,
    counts: [usize; 2],
    volume: f64,
}

/// Holds Armill's contacts along a program to the cells; complaints, if any.
fn hold(name: &str, text: &str, solid: &Solid, origin: Vector2<f64>) -> (Seen, Vec<String>) {
    let path = program(text);
    let cutter = Cutter { radius: R / 1e3, corner: 0.0, flutes: f64::INFINITY };
    let contacts = contacts(&path, (solid, &[]), &cutter, &mut Progress::none());
    let stations: Vec<(usize, f64)> =
        contacts.each().map(|((index, k), _)| (index, contacts.within(k))).collect();
    // All ramps nearby share the layers.
    let ends: Vec<f64> = path.moves().iter().filter_map(ramp).flatten().collect();
    let ramps = ends.iter().fold(0.0, |lowest: f64, z| lowest.min(z.max(solid.bottom * 1e3))).abs();
    let layer = ramps / 16.0 + 1e-5;
    let mut levels = vec![solid.bottom * 1e3, solid.top * 1e3];
    let ends = path.moves().iter().map(|step| step.segment.point(step.segment.length()).z * 1e3);
    levels.extend(ends.filter(|z| *z > solid.bottom * 1e3 && *z < solid.top * 1e3));
    levels.sort_by(f64::total_cmp);
    levels.dedup_by(|a, b| (*a - *b).abs() < 1e-6);

    let mut raster = Raster::new(solid, origin);
    let (mut seen, mut complaints) = (Seen::default(), Vec::new());
    let looks: Vec<(f64, usize)> = chosen(&path, &stations, 60)
        .into_iter()
        .map(|k| (path.start(stations[k].0) + stations[k].1 - BEFORE / 1e3, k))
        .collect();
    let (mut ours, mut theirs, mut next) = (0.0, 0.0, 0);
    for (index, step) in path.moves().iter().enumerate() {
        let length = step.segment.length();
        let at = |s: f64| step.segment.point(s) * 1e3;
        if is_rapid(step) {
            continue;
        }
        // Where the tool came to by a rapid it stands in material that nothing has cut.
        if index == 0 || is_rapid(&path.moves()[index - 1]) {
            raster.step(None, at(0.0));
        }
        let mut volume = 0.0;
        let (mut s, mut place) = (0.0, at(0.0));
        loop {
            let stop = looks.get(next).map(|(at, _)| at - path.start(index)).filter(|stop| *stop < length);
            let to = stop.unwrap_or(length).max(s);
            let steps = ((to - s) * 1e3 / STEP).ceil().max(1.0);
            for k in 1..=steps as usize {
                let new = at(s + (to - s) * k as f64 / steps);
                volume += raster.step(Some(place), new);
                place = new;
            }
            s = to;
            if stop.is_none() {
                break;
            }
            let station = looks[next].1;
            next += 1;
            let (of, within) = stations[station];
            let along = |s: f64| path.moves()[of].segment.point(s) * 1e3;
            let feed = (along(within + 1e-7) - along(within - 1e-7)).xy().normalize();
            let look = Look { before: place, tip: along(within), feed };
            let contact = contacts.at(station);
            let found = difference(&raster, &look, &contact, &levels, layer, &mut seen.counts);
            seen.stations += 1;
            let below = difference_below(&raster, &look, &contact);
            if below > 0.01 {
                complaints.push(format!(
                    "{name}: line {} at {:.4} mm: {:.3} of the bottom: {:?}",
                    path.moves()[of].line,
                    within * 1e3,
                    below,
                    contact.floors
                ));
            }
            if found.across > 2.0 * CELL && found.angle > 0.5_f64.to_radians() {
                complaints.push(format!(
                    "{name}: line {} at {:.4} of {:.4} mm, ({:.4}, {:.4}, {:.4}): {:.3} mm, {:.1} deg: {:?}",
                    path.moves()[of].line,
                    within * 1e3,
                    path.moves()[of].segment.length() * 1e3,
                    look.tip.x,
                    look.tip.y,
                    look.tip.z,
                    found.across,
                    found.angle.to_degrees(),
                    contact.sides,
                ));
            }
        }
        let parts =
            contacts.of_move(index).map(|k| section(&contacts.at(k)) * contacts.share(index, k) * 1e3);
        let integral: f64 = parts.sum();
        // A station may differ by 0.2 % of a slot from the middle of its neighbours.
        let [from, to] = [at(0.0), at(length)];
        let bent = 0.002 * 2.0 * R * (solid.top * 1e3 - from.z.min(to.z)) * length * 1e3;
        // Rings of the bottom stand for what lies between them.
        let rings = 0.01 * PI * R * R * (from.z - to.z).max(0.0);
        let share = if ramps > 0.0 { 0.02 } else { 0.005 };
        if (integral - volume).abs() > share * volume + bent + rings + 0.02 {
            complaints.push(format!(
                "{name}: line {}, {length:.5} m: {integral:.4}, cells {volume:.4} mm^3",
                step.line
            ));
        }
        (ours, theirs) = (ours + integral, theirs + volume);
    }
    let share = if ramps > 0.0 { 0.01 } else { 0.005 };
    if (ours - theirs).abs() > share * theirs {
        complaints.push(format!("{name}: {ours:.3} mm^3, cells {theirs:.3} mm^3"));
    }
    seen.volume = theirs;
    (seen, complaints)
}

fn setting(key: &str, default: u64) -> u64 {
    std::env::var(key).map_or(default, |text| text.parse().unwrap())
}

#[test]
fn random_programs_meet_what_the_cells_hold() {
    let mut complaints = Vec::new();
    let mut all = Seen::default();
    let first = setting("ARMILL_RASTER_SEED", 0);
    for seed in first..first + setting("ARMILL_RASTER_PROGRAMS", 20) {
        let origin = if seed % 5 == 4 { Vector2::new(5000.0, -3000.0) } else { Vector2::zeros() };
        let mut writer = Writer::new(seed, origin);
        let levels = [-1.0, -2.5, -4.0, -6.0];
        let deepest = 1 + seed / 2 % 4;
        for _ in 0..4 + writer.random.below(4) {
            let level = levels[writer.random.below(deepest) as usize];
            writer.feature(level);
        }
        let name = format!("program {seed}");
        let (seen, found) = hold(&name, &writer.text, &stock(seed % 3, origin), origin);
        if !found.is_empty() && std::env::var("ARMILL_RASTER_TEXT").is_ok() {
            println!("{name}\n{}", writer.text);
        }
        complaints.extend(found);
        all.stations += seen.stations;
        all.volume += seen.volume;
        all.counts = [all.counts[0] + seen.counts[0], all.counts[1] + seen.counts[1]];
    }
    println!(
        "{} stations, directions open and engaged {:?}, {:.0} mm^3",
        all.stations, all.counts, all.volume
    );
    assert!(complaints.is_empty(), "{} complaints\n{}", complaints.len(), complaints.join("\n"));
}

/// Shapes that programs seldom have and that a geometry of curves may stumble on, near and far from the
/// origin.
#[test]
fn awkward_programs_meet_what_the_cells_hold() {
    let mut complaints = Vec::new();
    for origin in [Vector2::zeros(), Vector2::new(5000.0, -5000.0)] {
        let mut hold = |name: &str, write: &dyn Fn(&mut Writer)| {
            let mut writer = Writer::new(0, origin);
            writer.go("G0", -3.0, 7.0, "Z-2");
            write(&mut writer);
            let (seen, found) =
                hold(&format!("{name} at {origin:?}"), &writer.text, &stock(0, origin), origin);
            assert!(seen.stations > 0 && seen.volume > 0.0, "{name}");
            complaints.extend(found);
        };
        hold("the same again", &|program| {
            for _ in 0..3 {
                program.polygon(&[[6.0, 7.0], [9.0, 12.0], [6.0, 7.0], [-3.0, 7.0], [8.0, 7.0]]);
                program.arc([6.0, 7.0], 2.0, 0.0, TAU, "");
                program.arc([6.0, 7.0], 2.0, 0.0, -4.0, "");
                program.polygon(&[[-3.0, 7.0]]);
            }
        });
        hold("arcs that touch", &|program| {
            program.polygon(&[[4.0, 7.0]]);
            program.arc([4.0, 9.0], 2.0, -PI / 2.0, PI, "");
            program.arc([4.0, 12.0], 1.0, -PI / 2.0, -PI, "");
            program.arc([4.0, 9.0], 4.0, PI / 2.0, -PI, "");
            program.arc([4.0, 8.0], 3.0, -PI / 2.0, TAU, "");
            program.polygon(&[[12.0, 5.0]]);
        });
        hold("arcs of the tool's radius", &|program| {
            program.polygon(&[[5.0, 7.0], [9.0, 7.0]]);
            for radius in [R, R, R + 1e-3, R - 1e-3, 2.0 * R] {
                program.polygon(&[[7.0 + radius, 7.0]]);
                program.arc([7.0, 7.0], radius, 0.0, -TAU, "");
            }
            program.polygon(&[[7.0, 7.0], [7.0, 18.0]]);
        });
        hold("moves of a micrometre", &|program| {
            program.polygon(&[[3.0, 7.0]]);
            for k in 1..=600 {
                program.go("G1", 3.0 + 1e-3 * f64::from(k), 7.0 + 1e-3 * f64::from(k % 2), "");
            }
            program.polygon(&[[3.0, 6.0]]);
            for k in 1..=600 {
                program.go("G1", 3.0 + 1e-3 * f64::from(k), 6.0, "");
            }
            program.arc([3.599, 6.0], 1e-3, 0.0, TAU, "");
            program.polygon(&[[12.0, 5.5]]);
        });
        hold("turns of a helix in one move", &|program| {
            for (radius, turn) in [(1.5, TAU), (3.0, -TAU), (2.2, TAU)] {
                program.go("G0", 7.0 + radius, 7.0, "Z0");
                program.arc([7.0, 7.0], radius, 0.0, turn, "Z-3 P3");
                program.arc([7.0, 7.0], radius, 0.0, turn, "Z-1 P2");
                program.arc([7.0, 7.0], radius, 0.0, turn, "");
            }
        });
        hold("a thousand chords", &|program| {
            for radius in [5.0, 3.5, 5.8] {
                program.polygon(&[[7.0 + radius, 7.0]]);
                for k in 1..=1000 {
                    let at = TAU * f64::from(k) / 1e3;
                    program.go("G1", 7.0 + radius * at.cos(), 7.0 + radius * at.sin(), "");
                }
            }
            program.polygon(&[[7.0, 7.0], [7.0, -3.0]]);
        });
    }
    assert!(complaints.is_empty(), "{} complaints\n{}", complaints.len(), complaints.join("\n"));
}
