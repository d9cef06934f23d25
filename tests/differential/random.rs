//! Random jobs over the valid ranges, each as the JSON that Armill reads and as numbers in SI for
//! the plain model.

use super::arm::{Arm, about_z, frame, placed, shift};
use super::cut::{Beam, Cut, Part, Stock};
use super::model::{Question, Sources, impulses, place};
use super::track::{program, shape};
use super::way::{Tempo, Way};
use crate::common::peer::peer;
use armill::robot::library::Preset;
use nalgebra::Vector3;
use serde_json::{Value, json};
use std::f64::consts::TAU;

pub(crate) struct Case {
    pub(crate) job: Value,
    pub(crate) question: Question,
    /// Field made invalid on purpose.
    pub(crate) illegal: Option<&'static str>,
}

/// A source of random numbers.
pub(crate) struct Dice(pub(crate) fastrand::Rng);

impl Dice {
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.f64()
    }

    /// Uniform in the logarithm.
    pub(crate) fn scale(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// True once in `count` times.
    pub(crate) fn once_in(&mut self, count: usize) -> bool {
        self.0.usize(0..count) == 0
    }

    pub(crate) fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.0.usize(0..all.len())]
    }

    pub(crate) fn vector(&mut self, size: f64) -> [f64; 3] {
        [0; 3].map(|_| self.between(-size, size))
    }
}

/// Tool, material and engagement: the JSON of each, and their values in SI.
fn cut(dice: &mut Dice, feed: f64) -> (Value, Value, Value, Cut, Option<Beam>) {
    let diameter = dice.scale(2.0, 40.0);
    let flutes = dice.0.usize(1..7);
    let mut tool = json!({"diameter_mm":diameter,"flutes":flutes,"helix_deg":dice.between(0.0, 60.0)});
    let left = dice.once_in(5);
    if left {
        tool["hand"] = json!("left");
    }
    let corner = match dice.0.usize(0..10) {
        0 => {
            tool["corner_radius_mm"] = json!("ball");
            diameter / 2.0
        }
        1 => {
            let corner = dice.between(0.1, 0.5) * diameter;
            tool["corner_radius_mm"] = json!(corner);
            corner
        }
        _ => 0.0,
    };
    let rake = if dice.0.bool() { 0.0 } else { dice.between(-10.0, 20.0) };
    if rake != 0.0 {
        tool["rake_deg"] = json!(rake);
    }
    let beam = dice.once_in(4).then(|| {
        let (length, fluted) = (dice.between(2.0, 5.0) * diameter, dice.between(0.5, 5.0) * diameter);
        let (shank, modulus) = (dice.between(0.8, 1.2) * diameter, dice.between(200.0, 650.0));
        for (key, value) in [
            ("stickout_mm", length),
            ("flute_length_mm", fluted),
            ("shank_diameter_mm", shank),
            ("modulus_gpa", modulus),
        ] {
            tool[key] = json!(value);
        }
        tool["bending"] = json!("cantilever");
        Beam { modulus: modulus * 1e9, lengths: [length, fluted, diameter, shank].map(|l| l * 1e-3) }
    });
    let (material, stock) = if dice.once_in(3) {
        let (kc11, mc) = (dice.scale(400.0, 3000.0), dice.between(0.1, 0.4));
        let (radial, axial, secant) = (dice.between(0.1, 0.6), dice.between(0.0, 0.5), dice.0.bool());
        let chip = dice.0.bool().then(|| dice.scale(0.01, 0.3));
        let mut material = json!({
            "kc11_n_mm2":kc11,"mc":mc,"radial_ratio":radial,"axial_ratio":axial,
            "line":if secant {"secant"} else {"tangent"}
        });
        if let Some(chip) = chip {
            material["chip_thickness_mm"] = json!(chip);
        }
        (material, Stock::Kienzle { kc11, mc, radial, axial, secant, chip: chip.map(|h| h * 1e-3) })
    } else {
        let k = [dice.scale(200.0, 4000.0), dice.between(-200.0, 1500.0), dice.between(-200.0, 1000.0)];
        let e = if dice.0.bool() {
            [0.0; 3]
        } else {
            [dice.between(0.0, 60.0), dice.between(-20.0, 60.0), dice.between(-5.0, 10.0)]
        };
        let material = json!({"ktc_n_mm2":k[0],"krc_n_mm2":k[1],"kac_n_mm2":k[2],"kte_n_mm":e[0],"kre_n_mm":e[1],"kae_n_mm":e[2]});
        (material, Stock::Linear(k.map(|k| k * 1e6), e.map(|e| e * 1e3)))
    };
    let (depth, rpm) = (dice.scale(0.05, 4.0), dice.scale(1000.0, 20_000.0));
    let mut cutting = json!({"axial_depth_mm":depth,"spindle_rpm":rpm});
    let radial_depth = dice.between(0.02, 1.0) * diameter;
    let part = match dice.0.usize(0..4) {
        0 => {
            let (entry, exit) = (dice.between(0.0, 120.0), dice.between(121.0, 180.0));
            (cutting["entry_deg"], cutting["exit_deg"]) = (json!(entry), json!(exit));
            Part::Angles(entry.to_radians(), exit.to_radians())
        }
        1 => {
            (cutting["engagement"], cutting["radial_depth_mm"]) = (json!("climb"), json!(radial_depth));
            Part::Right(radial_depth * 1e-3)
        }
        2 => {
            (cutting["engagement"], cutting["radial_depth_mm"]) =
                (json!("conventional"), json!(radial_depth));
            Part::Left(radial_depth * 1e-3)
        }
        _ => {
            cutting["engagement"] = json!("slot");
            Part::Both
        }
    };
    let chip = (!dice.once_in(3)).then(|| dice.scale(0.01, 0.2));
    cutting["feed_per_tooth_mm"] = chip.map_or(json!("from_feed"), |c| json!(c));
    let cut = Cut {
        diameter: diameter * 1e-3,
        flutes: flutes as f64,
        hand: if left { -1.0 } else { 1.0 },
        corner: corner * 1e-3,
        depth: depth * 1e-3,
        part,
        stock,
        rake,
        chip: chip.map(|c| c * 1e-3),
        spindle: rpm / 60.0,
        feed,
    };
    (tool, material, cutting, cut, beam)
}

/// Position [mm], and roll, pitch, yaw [deg].
type Frame = ([f64; 3], [f64; 3]);

/// Tool, base and workpiece frames that keep most paths within the arm's reach.
fn frames(dice: &mut Dice, preset: &Preset) -> [Frame; 3] {
    let [a1, a2, _, c1, c2, c3, _] = preset.opw.lengths_mm;
    let reach = c2 + a2.hypot(c3);
    let tool = match dice.0.usize(0..3) {
        0 => ([0.0; 3], [0.0; 3]),
        1 => (
            [dice.between(-80.0, 80.0), dice.between(-80.0, 80.0), dice.between(50.0, 250.0)],
            [0.0, dice.between(20.0, 90.0), 0.0],
        ),
        _ => (dice.vector(150.0), dice.vector(60.0)),
    };
    let far = if dice.once_in(12) { dice.between(0.0, 1.3) } else { dice.between(0.45, 0.8) };
    let (bearing, ahead) = (dice.between(-70.0_f64, 70.0).to_radians(), a1 + far * reach);
    let at = [ahead * bearing.cos(), ahead * bearing.sin(), c1 + dice.between(-0.45, 0.25) * reach];
    let tilt = if dice.once_in(4) { 90.0 } else { 15.0 };
    let [roll, pitch, yaw] = [
        dice.between(-tilt, tilt),
        dice.between(-tilt, tilt),
        dice.between(-40.0, 40.0) + bearing.to_degrees(),
    ];
    if dice.0.bool() {
        return [tool, ([0.0; 3], [0.0; 3]), (at, [roll, pitch, yaw])];
    }
    // Base and workpiece moved together in the cell, turned about its vertical.
    let (base, turn) = (dice.vector(2000.0), dice.between(-180.0, 180.0));
    let moved = placed(&(shift(base[0], base[1], base[2]) * about_z(turn.to_radians())), &Vector3::from(at));
    [tool, (base, [0.0, 0.0, turn]), (moved.into(), [roll, pitch, yaw + turn])]
}

/// A key, an invalid value for it, and the field that the error has to name.
const ILLEGAL: [(&str, f64, &str); 6] = [
    ("/tool/diameter_mm", 0.0, "tool.diameter_mm"),
    ("/motion/acceleration_mm_s2", -1.0, "motion.acceleration_mm_s2"),
    ("/motion/sample_time_s", 0.0, "motion.sample_time_s"),
    ("/cutting/axial_depth_mm", -0.1, "cutting.axial_depth_mm"),
    ("/compensation/tolerance_mm", 0.0, "compensation.tolerance_mm"),
    ("/motion/feed_mm_s", 20_000.0, "motion.feed_mm_s"),
];

/// The `seed`-th random job.
pub(crate) fn case(seed: u64, robots: &[Preset]) -> Case {
    let dice = &mut Dice(fastrand::Rng::with_seed(seed));
    let preset = &robots[dice.0.usize(0..robots.len())];
    let feed = dice.scale(2.0, 400.0) * 1e-3;
    let (rapid, acceleration) = (dice.scale(50.0, 1000.0) * 1e-3, dice.scale(50.0, 5000.0) * 1e-3);
    let track = if dice.once_in(3) { program(dice, feed, rapid) } else { shape(dice, feed) };
    let [tool_frame, base, workpiece] = frames(dice, preset);
    let compliance = if dice.once_in(3) { Some([0; 6].map(|_| dice.scale(1e-8, 5e-6))) } else { None };
    let mut robot = json!({"preset": preset.id});
    if let Some(compliance) = compliance {
        robot["joint_compliance_rad_per_nm"] = json!(compliance);
    }
    let kind = dice.one_of(&["none", "zv", "zvd", "zvdd", "ei"]);
    let (frequency, damping) =
        (dice.scale(12.0, 200.0), dice.between(0.0, if kind == "ei" { 0.3 } else { 0.5 }));
    let shaper = match (kind, dice.0.bool()) {
        ("none", _) => json!("none"),
        (_, true) => json!({"kind":kind,"frequency_rad_s":frequency,"damping":damping}),
        (_, false) => json!({"kind":kind,"frequency_hz":frequency / TAU,"damping":damping}),
    };
    let impulses = impulses(kind, frequency, damping);
    let settle = impulses.last().unwrap().1;
    let (tool, material, cutting, cut, beam) = cut(dice, feed);

    let way = Way::new(track.pieces, &place(base, workpiece), track.local);
    // About a hundred samples.
    let travel: f64 =
        way.pieces.iter().map(|p| p.curve.length() / p.limit + p.limit / acceleration + p.wait).sum();
    let dt = ((travel + settle) / dice.between(60.0, 120.0)).clamp(1e-5, 1.0);
    let dwell = (!dice.once_in(3)).then(|| if dice.0.bool() { 0.0 } else { dice.between(0.0, 0.3) });
    let corner_angle = dice.scale(1.0, 60.0);
    let spin = if dice.0.bool() { 0.0 } else { dice.between(-180.0, 180.0) };
    let branch = [!dice.once_in(8), !dice.once_in(4), !dice.once_in(4)];
    let sources = dice.one_of(&[(true, true), (true, true), (true, false), (false, true), (false, false)]);
    let sources = Sources { deflection: sources.0, shaping: sources.1 };
    let (tolerance, max_passes) = (dice.scale(1e-4, 0.3), dice.0.usize(0..4));
    let word = |yes: bool, a: &'static str, b: &'static str| if yes { a } else { b };
    let mut named: Vec<&str> = Vec::new();
    named.extend(sources.deflection.then_some("deflection"));
    named.extend(sources.shaping.then_some("shaping"));
    let frame_of = |(xyz, rpy): Frame| json!({"xyz_mm":xyz,"rpy_deg":rpy});
    let mut job = json!({
        "version": 1,
        "robot": robot,
        "tool_frame": frame_of(tool_frame),
        "base_frame": frame_of(base),
        "workpiece_frame": frame_of(workpiece),
        "spin": {"angle_deg": spin},
        "start_branch": {
            "shoulder":word(branch[0],"front","back"),
            "elbow":word(branch[1],"positive","negative"),
            "wrist":word(branch[2],"near","flipped")
        },
        "path": track.json,
        "motion": {"feed_mm_s":feed * 1e3,"rapid_mm_s":rapid * 1e3,"acceleration_mm_s2":acceleration * 1e3,"sample_time_s":dt,
            "corner_angle_deg":corner_angle,"corner_dwell":dwell.map_or(json!("settle"), |t| json!(t))},
        "tool": tool, "material": material, "cutting": cutting, "shaper": shaper,
        "compensation": {"tolerance_mm":tolerance,"max_passes":max_passes,"sources":named},
        // The plain model judges the nominal error alone.
        "uncertainty": {"stiffness_percent":0,"cutting_percent":0},
    });
    let illegal = dice.once_in(40).then(|| {
        let (key, value, field) = dice.one_of(&ILLEGAL);
        *job.pointer_mut(key).unwrap() = json!(value);
        field
    });
    let tempo = Tempo {
        acceleration,
        dt,
        corner_angle: corner_angle.to_radians(),
        corner_dwell: dwell.unwrap_or(if settle > 0.0 { settle + 2.0 * dt } else { 0.0 }),
        settle,
    };
    let arm = Arm::new(
        preset,
        compliance.unwrap_or(preset.joint_compliance),
        frame(tool_frame.0, tool_frame.1),
        peer(preset),
    );
    let question = Question {
        arm,
        way,
        place: place(base, workpiece),
        spin: spin.to_radians(),
        branch,
        tempo,
        impulses,
        cut,
        beam,
        tolerance: tolerance * 1e-3,
        max_passes,
        sources,
        limits: preset.joint_limits_deg.map(|ranges| ranges.map(|range| range.map(f64::to_radians))),
    };
    Case { job, question, illegal }
}
