//! The engagement from the stock: closed forms of slots, walls, circles and corners; volumes; what a
//! program meets at several heights; plunges.
#![allow(clippy::disallowed_methods, reason = "independent values come from the standard library")]

use armill::Progress;
use armill::path::Path;
use armill::path::gcode;
use armill::stock::{Contacts, Cutter, Earlier, Outline, Solid, contacts};
use nalgebra::Vector2;
use std::f64::consts::PI;

const R: f64 = 5e-3;

fn flat() -> Cutter {
    Cutter { radius: R, corner: 0.0, flutes: f64::INFINITY }
}

/// A box from `from` to `to` [mm], x, y, z.
fn block(from: [f64; 3], to: [f64; 3]) -> Solid {
    let corner = |p: [f64; 3]| Vector2::new(p[0], p[1]) / 1e3;
    Solid::prism(Outline::rectangle(corner(from), corner(to)), from[2] / 1e3, to[2] / 1e3)
}

#[test]
fn the_corners_of_an_outline_are_its_own_or_evenly_on_its_circle() {
    let block = block([0.0, 0.0, 0.0], [30.0, 20.0, 10.0]);
    let corners = block.outline.corners(72);
    assert_eq!(Outline::Polygon(corners).area(), block.outline.area());
    let (center, radius) = (Vector2::new(0.1, -0.2), 0.05);
    let round = Outline::Circle { center, radius };
    let corners = round.corners(72);
    assert!(corners.iter().all(|corner| ((corner - center).norm() - radius).abs() < 1e-12));
    // A regular polygon of n corners has n / 2 sin(2 pi / n) of the squared radius.
    let area = 36.0 * (PI / 36.0).sin() * radius * radius;
    assert!((Outline::Polygon(corners).area() - area).abs() < 1e-12);
}

fn program(text: &str) -> Path {
    let options = gcode::Options { field: "text".into(), ..Default::default() };
    Path::of_program(&gcode::program(text, &options, |_| ()).unwrap()).unwrap()
}

struct Run {
    path: Path,
    contacts: Contacts,
    cutter: Cutter,
}

fn walk(text: &str, solid: &Solid, cutter: Cutter) -> Run {
    let path = program(text);
    let contacts = contacts(&path, (solid, &[]), &cutter, &mut Progress::none());
    Run { path, contacts, cutter }
}

impl Run {
    /// Number of the first move that ends at a point [mm], and its length [m].
    fn to(&self, x: f64, y: f64) -> (usize, f64) {
        let ends = |step: &armill::path::Move| {
            let length = step.segment.length();
            let end = step.segment.point(length) * 1e3;
            ((end.x - x).hypot(end.y - y) < 1e-6).then_some(length)
        };
        self.path.moves().iter().enumerate().find_map(|(index, step)| Some((index, ends(step)?))).unwrap()
    }

    /// Engaged angle at the tip [rad] at each station of a move, with the arc length there [m].
    fn engaged(&self, index: usize) -> Vec<(f64, f64)> {
        let stations = self.contacts.of_move(index);
        stations.map(|k| (self.contacts.within(k), self.contacts.at(k).engaged())).collect()
    }

    /// Volume removed [m^3]: the section of what is met, along the path.
    fn removed(&self) -> f64 {
        let corner = self.cutter.corner;
        let radius = |height: f64| {
            let below = (corner - height).max(0.0);
            self.cutter.radius - corner + (corner * corner - below * below).sqrt()
        };
        let section = |station: usize| {
            let contact = self.contacts.at(station);
            let side = |arc: &armill::stock::SideArc| {
                let wide = (arc.entry.cos() - arc.exit.cos()) * (arc.to - arc.from);
                let deep = (arc.exit - arc.entry) * (radius(arc.to) - radius(arc.from));
                radius((arc.from + arc.to) / 2.0) * (wide * contact.across + deep * contact.down)
            };
            let floor = |arc: &armill::stock::FloorArc| arc.radius * arc.width * (arc.exit - arc.entry);
            contact.sides.iter().map(side).sum::<f64>()
                + contact.floors.iter().map(floor).sum::<f64>() * contact.down.max(0.0)
        };
        let parts = self
            .contacts
            .each()
            .map(|((index, station), _)| section(station) * self.contacts.share(index, station));
        parts.sum()
    }
}

/// A plate of 200 x 200 x 10 mm around the origin, its top at 0.
fn plate() -> Solid {
    block([-100.0, -100.0, -10.0], [100.0, 100.0, 0.0])
}

/// The same plate as a mesh, which is followed on a map of heights.
fn meshed() -> Solid {
    let at = |x: f64, y: f64, z: f64| nalgebra::Vector3::new(x, y, z) / 1e3;
    let [a, b, c, d] = [(-100.0, -100.0), (100.0, -100.0), (100.0, 100.0), (-100.0, 100.0)];
    let face = |z: f64| [[a, b, c], [a, c, d]].map(|corners| corners.map(|(x, y)| at(x, y, z)));
    Solid::under([face(0.0), face(-10.0)].concat()).unwrap()
}

#[test]
fn a_slot_takes_half_a_turn() {
    let run = walk("G90 F1000\nG0 X0 Y0 Z-2\nG1 X40\n", &plate(), flat());
    for (_, angle) in run.engaged(run.to(40.0, 0.0).0) {
        assert!((angle - PI).abs() < 1e-9, "{angle}");
    }
    let (index, _) = run.to(40.0, 0.0);
    let contact = run.contacts.at(run.contacts.of_move(index).start);
    assert!((contact.axial_depth() - 2e-3).abs() < 1e-12);
    assert!((contact.radial_depth(|_| R) - 2.0 * R).abs() < 1e-12);
}

/// phi = acos(1 - a_e / r), left of the feed in up milling, right of it in down milling.
#[test]
fn a_wall_takes_its_radial_depth() {
    for depth in [0.05, 0.5, 2.0, 5.0, 9.0] {
        for side in [1.0, -1.0] {
            // The first cut leaves a wall; the second goes along it, `depth` further in.
            let text = format!(
                "G90 F1000\nG0 X-120 Y0 Z-2\nG1 X120\nG0 Z5\nX-120 Y{}\nZ-2\nG1 X121\n",
                side * depth
            );
            let run = walk(&text, &plate(), flat());
            let (index, _) = run.to(121.0, side * depth);
            let middle = run.contacts.of_move(index).find(|&k| run.contacts.within(k) > 0.12).unwrap();
            let contact = run.contacts.at(middle);
            let angle = (1.0 - depth / 5.0_f64).acos();
            let expected = if side > 0.0 { (0.0, angle) } else { (PI - angle, PI) };
            let (entry, exit) = contact.bounds().unwrap();
            assert!(
                (entry - expected.0).abs() < 1e-7 && (exit - expected.1).abs() < 1e-7,
                "{depth} {side}: {entry} {exit}"
            );
            assert!((contact.radial_depth(|_| R) - depth / 1e3).abs() < 1e-12);
        }
    }
}

/// A circle of the radius c takes the radial depth a from a hole of the radius h, or a shaft: the
/// border of the rim is where circles of r about the tool and of h about the centre meet (law of
/// cosines).
#[test]
fn circles_inside_and_outside_follow_the_law_of_cosines() {
    let (c, depth) = (20.0_f64, 1.5);
    for outside in [false, true] {
        // The pass before: 1.5 mm nearer to the free side.
        let before = if outside { c + depth } else { c - depth };
        let text = format!(
            "G90 F1000\nG0 X{before} Y0 Z-2\nG3 X{before} Y0 I-{before} J0\nG0 Z5\nX{c} Y0\nZ-2\nG3 X{c} Y0 I-{c} J0\n"
        );
        let run = walk(&text, &plate(), flat());
        let index = run.path.moves().len() - 1;
        // The swept ring of the pass before: inside it reaches before + r, outside from before - r.
        let border = if outside { before - 5.0 } else { before + 5.0 };
        // Angle at the tool between the way to the centre and the border's point.
        let at_tool = ((25.0 + c * c - border * border) / (2.0 * 5.0 * c)).acos();
        // Counter-clockwise, the centre is at the left: the angle counts from there.
        let expected = if outside { at_tool } else { PI - at_tool };
        let middle = run.contacts.of_move(index).find(|&k| run.contacts.within(k) > 0.04).unwrap();
        let engaged = run.contacts.at(middle).engaged();
        assert!((engaged - expected).abs() < 1e-9, "outside {outside}: {engaged} {expected}");
    }
}

/// Into a sharp inside corner the engagement rises by a right angle over the length a_e + sqrt(a_e (2
/// r - a_e)) before it (from the tool's rim meeting the next wall to the corner's end).
#[test]
fn into_a_corner_the_engagement_rises_by_a_right_angle() {
    let (depth, half) = (1.0_f64, 30.0);
    // A square pocket cleared to `half - depth`, then its outline; the corner is at (half, half).
    let inner = half - depth;
    let mut text = format!("G90 F1000\nG0 X-{inner} Y-{inner} Z-2\n");
    let mut y = -inner;
    while y < inner {
        text += &format!("G1 X{inner} Y{y}\nG1 X-{inner} Y{y}\n");
        y += 4.0;
    }
    text += &format!(
        "G1 X{inner} Y{inner}\nX-{inner}\nY-{inner}\nX{inner}\nY{inner}\nG1 X0 Y0\nG1 X{half} Y0\nX{half} Y{half}\n"
    );
    let run = walk(&text, &plate(), flat());
    let index = run.path.moves().len() - 1;
    let length = run.path.moves()[index].segment.length();
    let wall = (1.0 - depth / 5.0).acos();
    let rise = depth + (depth * (10.0 - depth)).sqrt();
    let engaged = run.engaged(index);
    for (s, angle) in &engaged {
        let left = (length - s) * 1e3;
        if left > rise + 0.05 && *s > 0.012 {
            assert!((angle - wall).abs() < 1e-9, "{left} {angle} {wall}");
        }
        if left < rise - 0.05 {
            assert!(*angle > wall + 1e-3, "{left} {angle}");
        }
    }
    let (_, last) = engaged.last().unwrap();
    // An end is looked at from half a micrometre before it.
    assert!((last - wall - PI / 2.0).abs() < 3e-4, "{last} {wall}");
}

/// A trochoidal loop of the radius c, moved on by `step`: the largest engagement is where the circles
/// of the tool's reach of this loop and the one before meet.
#[test]
fn trochoidal_loops_take_what_circle_and_circle_leave() {
    let (c, step) = (8.0_f64, 1.0);
    let mut text = String::from("G90 F1000\nG0 X-20 Y0 Z-2\n");
    for k in 0..3 {
        let x = k as f64 * step;
        text += &format!("G1 X{} Y0\nG2 X{} Y0 I{c} J0\n", x - c, x - c);
    }
    let run = walk(&text, &plate(), flat());
    let index = run.path.moves().len() - 1;
    let largest = run.engaged(index).iter().map(|(_, angle)| *angle).fold(0.0, f64::max);
    // Second way: for each place of the tool on the loop, the rim's outermost point against the circle
    // of the radius c + r about the loop before.
    let reach = c + 5.0;
    let at = |theta: f64| {
        let (x, y) = (c * theta.cos() + step, c * theta.sin());
        let far = x.hypot(y);
        if far + 5.0 <= reach {
            return 0.0;
        }
        // Rim points beyond `reach` from the old centre lie within alpha of the ray from there.
        let alpha = ((reach * reach - far * far - 25.0) / (2.0 * 5.0 * far)).acos();
        let ray = y.atan2(x);
        // Clockwise: the feed is a right angle before the radius.
        let feed = theta - PI / 2.0;
        let from = ((ray - alpha - feed + PI).rem_euclid(2.0 * PI) - PI).max(-PI / 2.0);
        let to = ((ray + alpha - feed + PI).rem_euclid(2.0 * PI) - PI).min(PI / 2.0);
        (to - from).max(0.0)
    };
    let expected = (0..100_000).map(|k| at(2.0 * PI * k as f64 / 1e5)).fold(0.0, f64::max);
    assert!(expected > 0.3, "{expected}");
    // Stations are where the engagement bends, not at its very largest.
    assert!((largest - expected).abs() < 5e-3, "{largest} {expected}");
}

/// What is swept adds up to what is gone, for a pocket in two depths with a helical entry.
#[test]
fn volumes_add_up() {
    // A pocket of 60 x 40 mm with corners of the tool's radius: 60 * 40 - (4 - pi) 25 mm².
    let mut text = String::from("G90 F1000\nG0 X0 Y0 Z5\n");
    for z in [-2, -4] {
        text += &format!("G0 X3 Y0\nG1 Z{}\nG3 X3 Y0 Z{z} I-3 J0\nG3 X3 Y0 I-3 J0\n", z + 2);
        for k in 0..=10 {
            let y = -15.0 + 3.0 * k as f64;
            text += &format!("G1 X-25 Y{y}\nX25\n");
        }
        text += "X25 Y15\nX-25\nY-15\nX25\nY15\n";
    }
    let run = walk(&text, &plate(), flat());
    let area = 60.0 * 40.0 - (4.0 - PI) * 25.0;
    let removed = run.removed() * 1e9;
    assert!((removed / (4.0 * area) - 1.0).abs() < 2e-3, "{removed} {}", 4.0 * area);
}

/// Left in the stock or not: an island, a thin wall, half-open shapes, a second pass in the air.
#[test]
fn islands_walls_and_second_passes() {
    // Around an island of 10 x 10 mm twice: nothing is left for the second round.
    let round = "G1 X10 Y-10\nY10\nX-10\nY-10\nX10\n";
    let run = walk(&format!("G90 F1000\nG0 X-10 Y-10 Z-3\n{round}{round}"), &plate(), flat());
    let last = run.path.moves().len() - 1;
    for index in last - 3..=last {
        assert!(
            run.engaged(index).iter().all(|(_, angle)| *angle == 0.0),
            "move {index}: {:?}",
            run.engaged(index)
        );
    }
    // Two slots leave a wall of 2 mm; across it, the tool cuts only that.
    let run = walk(
        "G90 F1000\nG0 X-20 Y0 Z-3\nG1 X20\nG0 Z5\nX-20 Y12\nZ-3\nG1 X20\nG0 Z5\nX0 Y0\nZ-3\nG1 Y12\n",
        &plate(),
        flat(),
    );
    let index = run.path.moves().len() - 1;
    let removed: f64 = {
        let stations: Vec<_> = run.contacts.of_move(index).collect();
        stations
            .windows(2)
            .map(|pair| {
                let depth = |k: usize| run.contacts.at(k).radial_depth(|_| R);
                (depth(pair[0]) + depth(pair[1])) / 2.0
                    * (run.contacts.within(pair[1]) - run.contacts.within(pair[0]))
            })
            .sum()
    };
    assert!((removed * 1e6 - 20.0).abs() < 0.1, "2 mm by 10 mm: {removed}");
}

/// A plunge meets the whole disc; half of it over an edge; none in a hole made before.
#[test]
fn plunges_meet_what_lies_below() {
    let disc = |text: &str| {
        let run = walk(text, &plate(), flat());
        let index = run.path.moves().iter().rposition(|step| step.segment.tangent(0.0).z < -0.9).unwrap();
        let station = run.contacts.of_move(index).find(|&k| run.contacts.within(k) > 1e-3).unwrap();
        let floors = run.contacts.at(station).floors;
        floors.iter().map(|arc| arc.radius * arc.width * (arc.exit - arc.entry)).sum::<f64>() * 1e6
    };
    assert!((disc("G90 F100\nG0 X0 Y0 Z0\nG1 Z-3\n") - 25.0 * PI).abs() < 1e-3);
    assert!((disc("G90 F100\nG0 X100 Y0 Z0\nG1 Z-3\n") - 12.5 * PI).abs() < 1e-3);
    assert!(disc("G90 F100\nG0 X0 Y0 Z0\nG1 Z-5\nG0 Z1\nG1 Z-3\n").abs() < 1e-9);
}

/// Beside a hole or over an edge a plunge meets a lune or a segment of its disc: in rings, to 1 % of the
/// disc even where only a little is missing or left.
#[test]
fn plunges_meet_part_of_their_disc() {
    let area = |text: &str| {
        let run = walk(text, &plate(), flat());
        let last = run.path.moves().len() - 1;
        let station = run.contacts.of_move(last).find(|&k| run.contacts.within(k) > 1e-3).unwrap();
        let floors = run.contacts.at(station).floors;
        floors.iter().map(|arc| arc.radius * arc.width * (arc.exit - arc.entry)).sum::<f64>() * 1e6
    };
    // Part of a disc of 5 mm beyond a chord at a distance [mm²].
    let segment = |d: f64| 25.0 * (d / 5.0).acos() - d * (25.0 - d * d).sqrt();
    for k in 1..50 {
        let d = 0.2 * f64::from(k);
        let lune = 25.0 * PI - 2.0 * segment(d / 2.0);
        let beside = area(&format!("G90 F100\nG0 X0 Y0 Z0\nG1 Z-3\nG0 Z1\nX{d}\nZ0\nG1 Z-3\n"));
        assert!((beside - lune).abs() < 0.01 * 25.0 * PI, "hole at {d}: {beside} {lune}");
        if d < 5.0 {
            let over = area(&format!("G90 F100\nG0 X{} Y0 Z0\nG1 Z-3\n", 100.0 + d));
            assert!((over - segment(d)).abs() < 0.01 * 25.0 * PI, "edge at {d}: {over} {}", segment(d));
        }
    }
}

/// A step: the lower half of the edge in a slot, the upper in a wall.
#[test]
fn heights_are_told_apart() {
    let run = walk("G90 F1000\nG0 X-120 Y0 Z-2\nG1 X120\nG0 Z5\nX-120 Y4\nZ-5\nG1 X121\n", &plate(), flat());
    let index = run.path.moves().len() - 1;
    let station = run.contacts.of_move(index).find(|&k| run.contacts.within(k) > 0.12).unwrap();
    let contact = run.contacts.at(station);
    let [low, high] = contact.sides else { panic!("{:?}", contact.sides) };
    assert!((low.exit - low.entry - PI).abs() < 1e-9 && low.from == 0.0 && (low.to - 3e-3).abs() < 1e-12);
    assert!((high.exit - (1.0 - 4.0_f64 / 5.0).acos()).abs() < 1e-7 && (high.to - 5e-3).abs() < 1e-12);
}

/// Volume that is removed on a map of heights against the exact way.
#[test]
fn the_map_of_heights_removes_what_the_exact_way_removes() {
    for (corner, step) in [(0.0, 0.5), (0.0, 4.0), (R, 0.5), (R, 2.0), (R, 10.0), (2e-3, 2.0)] {
        let tool = Cutter { corner, ..flat() };
        let mut cut = String::from("G90 F1000\nG0 X-20 Y0 Z-3\nG1 X20\n");
        for k in 1..5 {
            cut += &format!("Y{}\nX{}\n", k as f64 * step, if k % 2 == 0 { 20 } else { -20 });
        }
        let exact = walk(&cut, &plate(), tool);
        let mapped = walk(&cut, &meshed(), tool);
        assert!(exact.contacts.cell.is_none() && mapped.contacts.cell.is_some());
        let ratio = mapped.removed() / exact.removed();
        assert!((ratio - 1.0).abs() < 0.01, "corner {corner}, step {step}: {ratio}");
    }
}

/// A ball on a level way through a flat, its section in closed form: a segment of the circle.
#[test]
fn a_ball_digs_its_own_section() {
    let ball = Cutter { radius: R, corner: R, flutes: 1.0 };
    for depth in [1.0_f64, 3.0, 5.0] {
        let half = (1.0 - depth / 5.0).acos();
        let segment = 25.0 * (half - half.sin() * half.cos());
        let text = format!("G90 F1000\nG0 X-40 Y0 Z-{depth}\nG1 X40\n");
        for solid in [plate(), meshed()] {
            let run = walk(&text, &solid, ball);
            let section = run.removed() * 1e9 / 80.0;
            assert!((section / segment - 1.0).abs() < 0.02, "{depth}: {section} {segment}");
        }
    }
}

/// A dome of the radius 60 mm by a ball: rows over it, half a millimetre of stock left everywhere. What
/// is removed is the layer between both domes.
#[test]
fn a_ball_takes_the_layer_over_a_dome() {
    let ball = Cutter { radius: R, corner: R, flutes: 1.0 };
    let rows = |radius: f64, step: f64| {
        let mut text = String::from("G90 F1000\n");
        let mut y = -15.0;
        while y <= 15.0 {
            for k in 0..=30 {
                let x = -15.0 + k as f64;
                // The ball's centre keeps its radius from the dome.
                let z = ((radius + 5.0).powi(2) - x * x - y * y).sqrt() - 5.0 - 60.0;
                text += &format!("{} X{x} Y{y:.3} Z{z:.5}\n", if k == 0 { "G0" } else { "G1" });
            }
            text += "G0 Z30\n";
            y += step;
        }
        text
    };
    let block = block([-10.0, -10.0, -20.0], [10.0, 10.0, 3.0]);
    let rough = walk(&rows(60.5, 0.5), &block, ball).removed();
    let both = walk(&(rows(60.5, 0.5) + &rows(60.0, 0.5)), &block, ball).removed();
    // 20 x 20 mm, half a millimetre along the normal: by dz = dr R / sqrt(R² - x² - y²).
    let n = 200;
    let at = |k: usize| -10.0 + 20.0 * (k as f64 + 0.5) / n as f64;
    let height = |radius: f64, x: f64, y: f64| (radius * radius - x * x - y * y).sqrt();
    let layer: f64 = (0..n * n)
        .map(|k| (at(k % n), at(k / n)))
        .map(|(x, y)| height(60.5, x, y) - height(60.0, x, y))
        .sum::<f64>()
        * (20.0 / n as f64).powi(2);
    let ratio = (both - rough) * 1e9 / layer;
    assert!((ratio - 1.0).abs() < 0.05, "{ratio}: {both} {rough} {layer}");
}

/// What one program leaves is what the next one finds: two halves of a program, the first as an earlier
/// one, meet what the whole meets.
#[test]
fn an_earlier_program_leaves_what_it_cut() {
    let first = "G90 F1000\nG0 X-30 Y0 Z-3\nG1 X30\nY5\nX-30\nG0 Z5\n";
    let second = "G0 X-40 Y9 Z-3\nG1 X40\nG2 X40 Y-7 I0 J-8\nG1 X-40\n";
    let whole = walk(&format!("{first}{second}"), &plate(), flat());
    let path = program(&format!("G90 F1000\n{second}"));
    let earlier = [Earlier { path: program(first), cutter: flat() }];
    let after = contacts(&path, (&plate(), &earlier), &flat(), &mut Progress::none());
    let ends: Vec<_> = path.moves().iter().map(|step| step.segment.point(step.segment.length())).collect();
    let moves = whole.path.moves();
    for (index, end) in ends.iter().enumerate().skip(1) {
        let same =
            moves.iter().rposition(|step| (step.segment.point(step.segment.length()) - end).norm() < 1e-12);
        let (a, b) = (after.of_move(index), whole.contacts.of_move(same.unwrap()));
        assert_eq!(a.len(), b.len(), "move {index}");
        for (a, b) in a.zip(b) {
            assert_eq!(after.at(a).sides, whole.contacts.at(b).sides, "move {index}");
        }
    }
    // A larger tool before: only the corners are left for the smaller one.
    let square = |half: f64| format!("X{half} Y-{half}\nX{half} Y{half}\nX-{half}\nY-{half}\nX{half}\n");
    let rough = format!("G90 F1000\nG0 X0 Y0 Z-3\nG1 {}G1 X0 Y0\n", square(20.0));
    let large = Cutter { radius: 10e-3, ..flat() };
    let small = Cutter { radius: 3e-3, ..flat() };
    let path = program(&format!("G90 F1000\nG0 X27 Y0 Z-3\nG1 {}", square(27.0)));
    let earlier = [Earlier { path: program(&rough), cutter: large }];
    let met = contacts(&path, (&plate(), &earlier), &small, &mut Progress::none());
    let last = path.moves().len() - 2;
    let engaged: Vec<_> = met.of_move(last).map(|k| (met.within(k), met.at(k).engaged())).collect();
    // A side of 54 mm: within 7 mm of its ends lies the corner of the radius 10, in its middle nothing.
    assert!(
        engaged.iter().filter(|(s, _)| (0.01..0.044).contains(s)).all(|(_, angle)| *angle == 0.0),
        "{engaged:?}"
    );
    assert!(engaged.iter().any(|(s, angle)| *s > 0.048 && *angle > 0.5), "{engaged:?}");
}

/// An arc in a vertical plane is met on its chords: a slot over a crest and down a fillet takes half a
/// turn all the way.
#[test]
fn arcs_that_dive_are_in_full_material() {
    let text = "G90 F1000\nG0 X-120 Y0 Z-2\nG1 X-20\nG18\nG3 X-9.739396 Z-3.809221 I0 K-30\n\
                G2 X-2.898993 Z-5.015369 R20\nG1 X120\n";
    for corner in [0.0, R] {
        let run = walk(text, &plate(), Cutter { corner, ..flat() });
        for (index, step) in run.path.moves().iter().enumerate() {
            let length = step.segment.length();
            for (s, angle) in run.engaged(index) {
                let dives = step.segment.tangent(s).z < -1e-3 && s > 1e-4 && s < length - 1e-4;
                assert!(!dives || (angle - PI).abs() < 1e-9, "move {index}, {s} m: {angle}");
            }
        }
    }
}

/// A ball nose that rises on an arc meets the same from chord to chord: the section in its way changes
/// as evenly as the arc's slope does.
#[test]
fn rising_arcs_of_a_ball_nose_are_even() {
    let text = "G90 F1000\nG0 X-120 Y0 Z-8\nG1 X-30\nG18\nG2 X-10 Z-3 K42.5 I0\nG1 X-5 Z-1\n";
    let run = walk(text, &plate(), Cutter { corner: R, ..flat() });
    let (index, step) =
        run.path.moves().iter().enumerate().find(|(_, step)| step.segment.curvature() > 0.0).unwrap();
    let length = step.segment.length();
    let section = |station: usize| {
        let sides = run.contacts.at(station).sides;
        sides.iter().map(|arc| (arc.entry.cos() - arc.exit.cos()) * (arc.to - arc.from)).sum::<f64>()
    };
    let inside = |&station: &usize| {
        let s = run.contacts.within(station);
        s > 1e-3 && s < length - 1e-3
    };
    let sections: Vec<f64> = run.contacts.of_move(index).filter(inside).map(section).collect();
    let varies: f64 = sections.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
    let falls = sections[0] - sections[sections.len() - 1];
    assert!(sections.len() > 20 && falls > 0.0 && varies < 2.0 * falls, "{varies} {falls}");
}

/// A path in dense points, whose legs clear together, meets what its arcs and lines meet: a slot along a
/// circle, a second circle beside it, a line across both, and back along that line.
#[test]
fn dense_points_meet_what_arcs_meet() {
    let arcs = "G21 G90\nG0 X10 Y0 Z5\nG1 Z-3 F300\nG3 X-10 Y0 I-10 J0 F600\nG1 X-13\nG2 X13 Y0 I13 J0\n\
        G1 X17 Y4\nX-17 Y4\nY4.8\nX17\nG0 Z5\n";
    let mut points = vec![];
    let mut line = |from: [f64; 2], to: [f64; 2]| {
        let count = ((to[0] - from[0]).hypot(to[1] - from[1]) / 0.01).ceil();
        (1..=count as usize).for_each(|k| {
            let share = k as f64 / count;
            points.push([from[0] + (to[0] - from[0]) * share, from[1] + (to[1] - from[1]) * share]);
        });
    };
    let turn = |radius: f64, k: usize| {
        let angle = PI * k as f64 / 4000.0;
        [radius * angle.cos(), radius * angle.sin()]
    };
    (1..=4000).for_each(|k| line(turn(10.0, k - 1), turn(10.0, k)));
    line([-10.0, 0.0], [-13.0, 0.0]);
    (1..=4000).for_each(|k| line(turn(13.0, 4001 - k), turn(13.0, 4000 - k)));
    for pair in [[13.0, 0.0], [17.0, 4.0], [-17.0, 4.0], [-17.0, 4.8], [17.0, 4.8]].windows(2) {
        line(pair[0], pair[1]);
    }
    let words = points.iter().map(|p| format!("X{:.4} Y{:.4}\n", p[0], p[1])).collect::<String>();
    let dense = format!("G21 G90\nG0 X10 Y0 Z5\nG1 Z-3 F300\nF600\n{words}G0 Z5\n");
    let (exact, close) = (walk(arcs, &plate(), flat()), walk(&dense, &plate(), flat()));
    assert!(
        (close.removed() / exact.removed() - 1.0).abs() < 1e-3,
        "{} {}",
        close.removed(),
        exact.removed()
    );
    let at = |run: &Run, s: f64| {
        let index = (0..run.path.moves().len()).rfind(|&index| run.path.start(index) <= s).unwrap();
        let within = s - run.path.start(index);
        let (from, to, share) = run.contacts.around(index, within).unwrap();
        let [from, to] = [from, to].map(|station| run.contacts.at(station).radial_depth(|_| R));
        from + (to - from) * share
    };
    let start = 0.0081;
    let mut apart: Vec<f64> = (0..4000)
        .map(|k| start + (exact.path.length() - 2.0 * start) * k as f64 / 4000.0)
        .map(|s| (at(&exact, s) - at(&close, s * close.path.length() / exact.path.length())).abs())
        .collect();
    apart.sort_by(f64::total_cmp);
    // Between its stations the exact way is linear, to a hundredth of the tool's diameter.
    assert!(apart[2000] < 1e-6 && apart[3990] < 1e-4, "{:?}", [2000, 3800, 3990].map(|k| apart[k]));
}
