//! Random paths, as a job's JSON and as plain curves.

use super::random::Dice;
use super::way::{Curve, Piece};
use nalgebra::Vector3;
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

/// The path of a job: its JSON, its pieces in the workpiece frame, whether it passes near itself.
pub(crate) struct Track {
    pub(crate) json: Value,
    pub(crate) pieces: Vec<Piece>,
    pub(crate) local: bool,
}

fn metres([x, y, z]: [f64; 3]) -> Vector3<f64> {
    Vector3::new(x, y, z) * 1e-3
}

/// An arc about `normal`, angles counted from the projection of X.
fn arc(center: [f64; 3], radius_mm: f64, normal: [f64; 3], start: f64, sweep: f64) -> Curve {
    let n = Vector3::from(normal).normalize();
    let x = (Vector3::x() - n * n.x).normalize();
    let at = |angle: f64| x * angle.cos() + n.cross(&x) * angle.sin();
    let (e1, e2) = (at(start), at(start + PI / 2.0) * sweep.signum());
    Curve::Arc { center: metres(center), e1, e2, radius: radius_mm * 1e-3, sweep: sweep.abs(), rise: 0.0 }
}

/// A line, circle, arc, rectangle or chain of lines.
pub(crate) fn shape(dice: &mut Dice, feed: f64) -> Track {
    let cut = |curve| Piece { curve, limit: feed, cuts: true, spindle: None, wait: 0.0 };
    let center = dice.vector(20.0);
    let radius = dice.scale(5.0, 100.0);
    let normal = [dice.between(-0.8, 0.8), dice.between(-0.8, 0.8), dice.between(0.3, 1.0)];
    let (json, curves, local): (Value, Vec<Curve>, bool) = match dice.0.usize(0..5) {
        0 => {
            let (from, to) = (dice.vector(60.0), dice.vector(60.0));
            let line = Curve::Line { from: metres(from), to: metres(to) };
            (json!({"kind":"line","from_mm":from,"to_mm":to}), vec![line], false)
        }
        1 => {
            let json = json!({"kind":"circle","center_mm":center,"radius_mm":radius,"normal":normal});
            (json, vec![arc(center, radius, normal, 0.0, TAU)], false)
        }
        2 => {
            let (start, sweep) = (dice.between(-360.0, 360.0), dice.between(20.0, 300.0));
            let sweep = if dice.0.bool() { sweep } else { -sweep };
            let json = json!({"kind":"arc","center_mm":center,"radius_mm":radius,"normal":normal,"start_deg":start,"sweep_deg":sweep});
            (json, vec![arc(center, radius, normal, start.to_radians(), sweep.to_radians())], false)
        }
        3 => {
            let (width, height) = (dice.between(15.0, 120.0), dice.between(15.0, 120.0));
            let round = if dice.0.bool() { 0.0 } else { dice.between(0.5, 0.49 * width.min(height)) };
            let json = json!({"kind":"rectangle","center_mm":center,"width_mm":width,"height_mm":height,"corner_radius_mm":round});
            (json, rectangle(center, width, height, round), false)
        }
        _ => {
            let mut points = vec![dice.vector(40.0)];
            for _ in 0..dice.0.usize(1..5) {
                points.push(dice.vector(40.0));
            }
            let lines = points.windows(2).map(|p| Curve::Line { from: metres(p[0]), to: metres(p[1]) });
            (json!({"kind":"polyline","points_mm":points}), lines.collect(), true)
        }
    };
    Track { json, pieces: curves.into_iter().map(cut).collect(), local }
}

/// Counter-clockwise from the start of the lower side.
fn rectangle([cx, cy, cz]: [f64; 3], width: f64, height: f64, r: f64) -> Vec<Curve> {
    let (x, y) = (width / 2.0, height / 2.0);
    let sides =
        [[-x + r, -y, x - r, -y], [x, -y + r, x, y - r], [x - r, y, -x + r, y], [-x, y - r, -x, -y + r]];
    let centers = [[x - r, -y + r], [x - r, y - r], [-x + r, y - r], [-x + r, -y + r]];
    let mut curves = Vec::new();
    for k in 0..4 {
        let [ax, ay, bx, by] = sides[k];
        let (from, to) = (metres([cx + ax, cy + ay, cz]), metres([cx + bx, cy + by, cz]));
        curves.push(Curve::Line { from, to });
        if r > 0.0 {
            let center = [cx + centers[k][0], cy + centers[k][1], cz];
            curves.push(arc(center, r, [0.0, 0.0, 1.0], PI / 2.0 * (k as f64 - 1.0), PI / 2.0));
        }
    }
    curves
}

/// A small G-code program: lines, arcs and helices, rapids, feeds, spindle speeds, waits.
pub(crate) fn program(dice: &mut Dice, job_feed: f64, rapid: f64) -> Track {
    let mut at = dice.vector(30.0);
    let mut text = format!("G21 G90 G17 G94\nM3\nG0 X{} Y{} Z{}\n", at[0], at[1], at[2]);
    let (mut feed, mut spindle) = (job_feed, None);
    let mut pieces: Vec<Piece> = Vec::new();
    for _ in 0..dice.0.usize(2..7) {
        if dice.once_in(3) {
            let minute = dice.scale(60.0, 12_000.0);
            feed = minute / 60.0 * 1e-3;
            text += &format!("F{minute}\n");
        }
        if dice.once_in(4) {
            let rpm = dice.scale(1000.0, 20_000.0);
            spindle = Some(rpm / 60.0);
            text += &format!("S{rpm}\n");
        }
        if dice.once_in(4) && !pieces.is_empty() {
            let seconds = dice.between(0.01, 0.2);
            pieces.last_mut().unwrap().wait += seconds;
            text += &format!("G4 P{seconds}\n");
        }
        let kind = dice.0.usize(0..5);
        let curve = if kind < 3 {
            let step = dice.vector(25.0);
            let to: [f64; 3] = if dice.once_in(5) {
                [at[0], at[1], at[2] + step[2]]
            } else {
                std::array::from_fn(|i| at[i] + step[i])
            };
            text += &format!("G{} X{} Y{} Z{}\n", usize::from(kind > 0), to[0], to[1], to[2]);
            let line = Curve::Line { from: metres(at), to: metres(to) };
            at = to;
            line
        } else {
            let counter = dice.0.bool();
            let (radius, bearing) = (dice.scale(3.0, 30.0), dice.between(-PI, PI));
            let sweep = dice.between(0.2, 6.0);
            let rise = if dice.0.bool() { 0.0 } else { dice.between(-10.0, 10.0) };
            let side = if counter { 1.0 } else { -1.0 };
            // I and J lead from the start to the centre.
            let (i, j) = (-radius * bearing.cos(), -radius * bearing.sin());
            let center = [at[0] + i, at[1] + j, at[2]];
            let end = bearing + side * sweep;
            let to = [center[0] + radius * end.cos(), center[1] + radius * end.sin(), at[2] + rise];
            text += &format!("G{} X{} Y{} Z{} I{i} J{j}\n", if counter { 3 } else { 2 }, to[0], to[1], to[2]);
            let e1 = Vector3::new(bearing.cos(), bearing.sin(), 0.0);
            let e2 = Vector3::new(-bearing.sin(), bearing.cos(), 0.0) * side;
            at = to;
            Curve::Arc {
                center: metres(center),
                e1,
                e2,
                radius: radius * 1e-3,
                sweep,
                rise: rise * side * 1e-3,
            }
        };
        let rapids = kind == 0;
        pieces.push(Piece {
            curve,
            limit: if rapids { rapid } else { feed },
            cuts: !rapids,
            spindle,
            wait: 0.0,
        });
    }
    text += "M30\n";
    Track { json: json!({"kind":"gcode","text":text}), pieces, local: true }
}
