//! Force follows deflection: a tool that is pushed away cuts less, and the balance is the solution of
//! one linear equation where arm and cut are linear.
#![allow(clippy::disallowed_methods, reason = "independent values come from the standard library")]

use crate::common::{self, column, in_stock, refused, run};
use armill::Report;
use armill::cutting::CutStiffness;
use armill::deviation::coupling::{inverse_if_stable, settled};
use nalgebra::{Matrix2, Matrix3, Vector3};
use serde_json::{Value, json};

const SLOT: &str = "G21 G90\nG0 X-20 Y0 Z5\nG1 Z-3 F300\nG1 X20 F600\nG0 Z5\n";
/// A wall milled off the +Y side of the stock: 2 mm wide, tool of 10 mm.
const CLIMB: &str = "G21 G90\nG0 X-60 Y53 Z5\nG1 Z-3 F3000\nG1 X60 F600\nG0 Z5\n";
const CONVENTIONAL: &str = "G21 G90\nG0 X60 Y53 Z5\nG1 Z-3 F3000\nG1 X-60 F600\nG0 Z5\n";

/// A program in a plate, with or without coupling.
fn job(text: &str, coupling: &str, more: &[(&'static str, Value)]) -> Vec<(&'static str, Value)> {
    let coupling = ("cutting.coupling", json!(coupling));
    in_stock::job(text, in_stock::plate(), &[&[coupling], more].concat())
}

/// Samples where the tool is in the middle of its cut at full speed.
fn middle(report: &Report) -> Vec<usize> {
    let [x, z] = ["desired_x_mm", "desired_z_mm"].map(|key| column(report, key));
    let speed = column(report, "feed_mm_s");
    let is_middle =
        |&k: &usize| (x[k] - 1800.0).abs() < 10.0 && z[k] < 698.0 && (speed[k] - 10.0).abs() < 1e-9;
    (0..x.len()).filter(is_middle).collect()
}

/// One degree of freedom: a spring k along a direction, a cut whose force along it falls by Kc per
/// metre. The deflection with coupling over that without is k / (k + Kc).
#[test]
fn one_direction_yields_as_springs_in_parallel() {
    let direction = Vector3::new(0.3, -0.5, 0.8).normalize();
    let ways = [Vector3::y(), Vector3::z()];
    for (k, cut) in [(1e6, 3e5), (2e5, 4e6), (5e7, 1e3), (1e6, -4e5)] {
        // The shift along the direction is felt by its parts; their growths add up to -Kc along it.
        let felt = direction.y * direction.y + direction.z * direction.z;
        let growth = [direction.y, direction.z].map(|part| direction * (-cut * part / felt));
        let stiffness = CutStiffness { ways, growth };
        let planned = direction * 120.0 + Vector3::x() * 40.0;
        let deflect = |force: &Vector3<f64>| (direction * (direction.dot(force) / k), Vector3::zeros());
        let alone = deflect(&planned).0.norm();
        let balance = settled(&planned, &stiffness, &Vector3::zeros(), deflect);
        assert!(balance.converged);
        let expected = k / (k + cut);
        let ratio = balance.deflected.0.norm() / alone;
        assert!((ratio / expected - 1.0).abs() < 1e-9, "k {k}, Kc {cut}: {ratio} {expected}");
        // The force is the spring's.
        assert!((direction.dot(&balance.force) - k * balance.deflected.0.norm()).abs() < 1e-9 * 120.0);
    }
}

/// Where the cut pulls in by more than the arm holds back, there is no balance.
#[test]
fn a_cut_that_pulls_in_too_hard_finds_no_balance() {
    let stiffness =
        CutStiffness { ways: [Vector3::y(), Vector3::z()], growth: [Vector3::y() * 1.5e6, Vector3::zeros()] };
    let deflect = |force: &Vector3<f64>| (force / 1e6, Vector3::zeros());
    let planned = Vector3::y() * 100.0;
    let balance = settled(&planned, &stiffness, &Vector3::zeros(), deflect);
    assert!(!balance.converged && balance.force == planned && balance.deflected.0.y == 1e-4);
    // A saddle with one growing direction is none either; a turning pair of eigenvalues is.
    assert!(inverse_if_stable(&Matrix2::new(2.0, 0.0, 0.0, -3.0)).is_none());
    assert!(inverse_if_stable(&Matrix2::new(2.0, 0.0, 0.0, 3.0)).is_none());
    assert!(inverse_if_stable(&Matrix2::new(1.5, -2.0, 2.0, 1.5)).is_some());
}

/// Just before there is no balance, a cut that grows linearly would be pulled in without bounds. Such a balance is
/// none: what remains is at most twice the shift under the planned force.
#[test]
fn a_balance_next_to_none_is_none() {
    let planned = Vector3::y() * 100.0;
    let deflect = |force: &Vector3<f64>| (force / 1e6, Vector3::zeros());
    for part in 0..1000 {
        let growth = [Vector3::y() * (1e3 * f64::from(part)), Vector3::zeros()];
        let stiffness = CutStiffness { ways: [Vector3::y(), Vector3::z()], growth };
        let balance = settled(&planned, &stiffness, &Vector3::zeros(), deflect);
        let expected = 1.0 / (1.0 - 1e-3 * f64::from(part));
        // The other direction counts as well: its 1 is in the size of 5.
        let expected = if expected > 24_f64.sqrt() { 1.0 } else { expected.min(2.0) };
        assert!((balance.force.y / 100.0 - expected).abs() < 1e-9, "{part}: {balance:?}");
        assert!(balance.converged == (part < 500) || part == 500, "{part}");
    }
}

/// Where the border of the material just touches the tool, its angle changes like a square root, and so does the
/// force: its slope at that very place is without bounds. A tool that leaves a slot through a slanted side
/// keeps a force of the size of the planned one.
#[test]
fn a_border_that_grazes_the_tool_is_no_spring() {
    let stock = json!({"kind":"outline","points_mm":[[-40,-40],[40,-40],[0,50]],"bottom_mm":-20,"top_mm":0});
    let text = "G21 G90\nG0 X0 Y0 Z5\nG1 Z-12 F300\nX-60\nG0 Z5\n";
    let tool = json!({"diameter_mm":10,"flutes":4,"corner_radius_mm":0.9});
    let report = run(&job(text, "deflection", &[("stock", stock), ("tool", tool)]));
    assert!(report.unsettled.is_empty());
    for (k, (force, planned)) in report.force.iter().zip(&*report.planned_force).enumerate() {
        assert!(force.norm() <= 2.0 * planned.norm(), "{k}: {force:?} {planned:?}");
    }
}

/// Out of the material there is no force, and the arm stands where it was commanded.
#[test]
fn no_force_is_left_where_the_tool_leaves_the_material() {
    let stiffness =
        CutStiffness { ways: [Vector3::y(), Vector3::z()], growth: [Vector3::y() * -1e6, Vector3::zeros()] };
    let deflect = |force: &Vector3<f64>| (force / 1e6, Vector3::zeros());
    let balance = settled(&(Vector3::y() * 100.0), &stiffness, &(Vector3::y() * 5e-4), deflect);
    assert!(balance.converged && balance.force.norm() < 1e-9 && balance.deflected.0.norm() < 1e-15);
}

/// The growth is trusted to the size of the planned force: at most it doubles it, and then that is said.
#[test]
fn the_force_at_most_doubles() {
    let stiffness =
        CutStiffness { ways: [Vector3::y(), Vector3::z()], growth: [Vector3::y() * 1e5, Vector3::x() * 1e5] };
    let deflect = |force: &Vector3<f64>| (force / 1e6, Vector3::zeros());
    let planned = Vector3::y() * 100.0;
    let mut last = 100.0;
    for k in 0..100 {
        let commanded = Vector3::y() * (f64::from(k) * 1e-5);
        let balance = settled(&planned, &stiffness, &commanded, deflect);
        let force = balance.force.norm();
        assert!(force <= 200.0 + 1e-9 && force >= last - 1e-9, "it rises without a jump: {force} {last}");
        assert!(force - last < 12.0 && (balance.converged || force > 200.0 - 1e-9), "{balance:?}");
        last = force;
    }
    let far = settled(&planned, &stiffness, &(Vector3::y() * 5e-3), deflect);
    assert!((last - 200.0).abs() < 1e-9 && !far.converged);
}

/// In a slot the force is proportional to the depth: F = F0 (1 - u_z / a) and u = C F give
/// u = d / (1 + d_z / a) for the deflection d = C F0 without coupling, whatever the arm.
#[test]
fn a_slot_yields_by_its_closed_form() {
    let coupled = run(&job(SLOT, "deflection", &[]));
    let alone = run(&job(SLOT, "none", &[]));
    let depth = 3e-3;
    let samples = middle(&coupled);
    assert!(samples.len() > 100);
    for k in samples {
        let (d, u) = (alone.deflection[k], coupled.deflection[k]);
        let expected = d / (1.0 + d.z / depth);
        assert!((u - expected).norm() < 1e-9 * d.norm(), "{k}: {u:?} {expected:?}");
        let force = alone.force[k] * (1.0 - expected.z / depth);
        assert!((coupled.force[k] - force).norm() < 1e-8 * force.norm());
        assert!(coupled.planned_force[k] == alone.force[k]);
    }
}

/// Mean force of a flat tool per metre of height in {T} between two immersion angles by Simpson's rule,
/// with the coefficients of the job.
fn by_quadrature(report: &Report, (entry, exit): (f64, f64), chip: f64) -> Vector3<f64> {
    let cut = &report.setup().cut;
    let k = cut.coefficients;
    let force = |phi: f64| {
        let h = chip * phi.sin();
        let (t, r, a) = (k.ktc * h + k.kte, k.krc * h + k.kre, k.kac * h + k.kae);
        let (sin, cos) = phi.sin_cos();
        Vector3::new(-t * cos - r * sin, t * sin - r * cos, -a)
    };
    let count = 2000;
    let step = (exit - entry) / f64::from(count);
    let weight = |i: i32| {
        if i == 0 || i == count {
            1.0
        } else if i % 2 == 1 {
            4.0
        } else {
            2.0
        }
    };
    let sum =
        (0..=count).fold(Vector3::zeros(), |sum, i| sum + force(entry + step * f64::from(i)) * weight(i));
    sum * (step / 3.0) * f64::from(cut.flutes) / std::f64::consts::TAU
}

/// A wall along the feed: the deflection solves u = C F(u) with the width and depth of cut that the
/// shifted tool meets, by an independent model and an iteration of its own. To first order they agree;
/// the second order of a shift of a tenth of a millimetre in 2 mm is left out.
#[test]
fn a_wall_yields_as_an_independent_model_does() {
    for (text, side) in [(CLIMB, 1.0), (CONVENTIONAL, -1.0)] {
        let coupled = run(&job(text, "deflection", &[]));
        let alone = run(&job(text, "none", &[]));
        let (radius, width, depth) = (5e-3, 2e-3, 3e-3);
        let k = middle(&coupled)[50];
        let chip = 10e-3 / (3.0 * 8000.0 / 60.0);
        // The feed runs along x times the side; y = z x x.
        let frame = Matrix3::from_columns(&[Vector3::x() * side, Vector3::y() * side, Vector3::z()]);
        // The wall is on the side of -y of the workpiece: right of a feed along +x, left of one along -x.
        let mean = |shift: &Vector3<f64>| {
            let width = width - shift.y;
            let angle = (1.0 - width / radius).acos();
            let arc =
                if side > 0.0 { (std::f64::consts::PI - angle, std::f64::consts::PI) } else { (0.0, angle) };
            frame * by_quadrature(&coupled, arc, chip) * (depth - shift.z)
        };
        let planned = mean(&Vector3::zeros());
        assert!(
            (alone.force[k] - planned).norm() < 1e-8 * planned.norm(),
            "{:?} {planned:?}",
            alone.force[k]
        );
        // The compliance along the three axes, from the arm.
        let compliance = armill::robot::compliance::cartesian_compliance(&coupled.plan.robot, &coupled.q[k]);
        let compliance = compliance.fixed_view::<3, 3>(0, 0).into_owned();
        let mut shift = Vector3::zeros();
        for _ in 0..200 {
            shift = (shift + compliance * mean(&shift)) / 2.0;
        }
        let (ours, first) = (coupled.deflection[k], alone.deflection[k]);
        let change = (shift - first).norm();
        assert!(change > 0.01 * first.norm(), "side {side}: the coupling is seen: {change:e} {first:?}");
        assert!((ours - shift).norm() < 0.06 * change, "side {side}: {ours:?} {shift:?} {first:?}");
    }
}

/// After compensation the tool is where it should be, so the cut is the planned one: its force leaves
/// the same commands as without coupling.
#[test]
fn the_compensated_cut_is_the_planned_one() {
    let exact = json!({"tolerance_mm":1e-5,"max_passes":20});
    let coupled = run(&job(CLIMB, "deflection", &[("compensation", exact.clone())]));
    let alone = run(&job(CLIMB, "none", &[("compensation", exact)]));
    let apart = coupled.commanded().into_iter().zip(alone.commanded()).map(|(a, b)| (a - b).norm());
    let largest = apart.fold(0.0, f64::max);
    assert!(largest < 5e-8, "{largest:e}");
    assert!(coupled.after_max() < 2e-8 && alone.after_max() < 2e-8);
}

/// With the force the deflection grows less, in the figures too: budget and band use the same force.
#[test]
fn budget_and_band_follow() {
    let coupled = run(&job(CLIMB, "deflection", &[]));
    let budget = coupled.budget();
    let parts = budget.worst_mm;
    let sum = parts.joints.iter().sum::<f64>() + parts.tool + parts.shaping;
    assert!((sum - parts.total).abs() < 1e-9, "{parts:?}");
    let largest = coupled.before.statistics.max;
    assert!((parts.total / (largest / 1e-3) - 1.0).abs() < 1e-9);
    // The band of exact numbers is the nominal result.
    let exact = json!({"stiffness_percent":0,"cutting_percent":0});
    let report = run(&job(CLIMB, "deflection", &[("uncertainty", exact)]));
    assert!((report.band.before.p50 - report.before.statistics.max).abs() < 1e-9, "{:?}", report.band.before);
    assert!((report.band.after.p95 - report.after_max()).abs() < 1e-9);
}

/// Coupling needs a stock that is followed.
#[test]
fn coupling_without_a_stock_is_refused() {
    let none = ("stock", json!({"kind":"none"}));
    let error = refused(&job(SLOT, "deflection", std::slice::from_ref(&none)));
    assert_eq!(error.field(), Some("stock.kind"), "{error}");
    let climb = json!({"engagement":"climb","radial_depth_mm":2,"coupling":"deflection"});
    let error = refused(&job(SLOT, "none", &[("cutting", climb)]));
    assert_eq!(error.field(), Some("cutting.engagement"), "{error}");
    let without = run(&job(SLOT, "none", &[none]));
    assert!(without.setup().stiffness.is_none());
}

/// The stiffness of the cut is the change of the force that a shifted pass meets: passes along, across
/// and around what an earlier pass has left, shifted to their left and up by a few micrometres. Where a
/// bull nose crosses the fillets of an earlier slot at an angle, its growth up the axis is a third off;
/// that is not compared.
#[test]
fn the_stiffness_is_that_of_a_shifted_pass() {
    let passes: [(&str, [f64; 2]); 5] = [
        ("G0 X-30 Y3\nG1 Z-3 F300\nG1 X-10 F600\nG1 X-9.99\nG1 X30.0\n", [0.0, 1.0]),
        ("G0 X-30 Y-20\nG1 Z-3 F300\nG1 X10 Y20 F600\n", [-(0.5_f64.sqrt()), 0.5_f64.sqrt()]),
        ("G0 X30 Y4\nG1 Z-3 F300\nG1 X-30 Y4.5 F600\n", [-0.5 / 60.002_083, -60.0 / 60.002_083]),
        ("G0 X-49 Y47\nG1 Z-2 F300\nG1 X30 F600\n", [0.0, 1.0]),
        ("G0 X-60 Y52\nG1 Z-4 F3000\nG1 X30 F600\n", [0.0, 1.0]),
    ];
    let first = "G21 G90\nG0 X-30 Y0 Z5\nG1 Z-3 F300\nG1 X30 F600\nG0 Z5\n";
    let round = json!({"diameter_mm":10,"flutes":3,"corner_radius_mm":1.5});
    for (tool, tolerance) in [(json!({"diameter_mm":10,"flutes":3}), 2e-4), (round, 0.05)] {
        for (pass, left) in passes.iter().filter(|(pass, _)| tolerance < 1e-3 || !pass.contains("Y-20")) {
            let setup = |shift: [f64; 3]| {
                // G52 would need a controller; the shift is written into the words.
                let moved: Vec<String> = pass
                    .split_whitespace()
                    .map(|word| {
                        let by = match &word[..1] {
                            "X" => shift[0],
                            "Y" => shift[1],
                            "Z" => shift[2],
                            _ => return word.to_owned(),
                        };
                        let value: f64 = word[1..].parse().unwrap();
                        format!("{}{:.6}", &word[..1], value + by)
                    })
                    .collect();
                let mut text = first.to_owned();
                moved.iter().for_each(|word| {
                    text.push_str(if word.starts_with('G') { "\n" } else { " " });
                    text.push_str(word);
                });
                text.push_str("\nG0 Z5\n");
                let changes = job(&text, "deflection", &[("tool", tool.clone())]);
                let job = armill::Job::from_json(&common::job_text(&changes)).unwrap();
                armill::setup::Setup::of(&job, &mut armill::Progress::none()).unwrap()
            };
            let nominal = setup([0.0; 3]);
            let index = (0..nominal.path.moves().len())
                .rfind(|&index| nominal.path.moves()[index].segment.length() > 0.038)
                .unwrap();
            let by = 5e-3;
            for (way, shift) in [[left[0] * by, left[1] * by, 0.0], [0.0, 0.0, by]].into_iter().enumerate() {
                let back = shift.map(|by| -by);
                let (there, behind) = (setup(shift), setup(back));
                for share in [1e-6, 0.15, 0.3, 0.62] {
                    let within = share * nominal.path.moves()[index].segment.length();
                    let force = |setup: &armill::setup::Setup| setup.mean_force.at(index, within).at(1e-4);
                    // Pressed down, the tool would also meet the floor that the first pass has left at
                    // its height. That floor has yielded as well, so only the way up is compared.
                    let measured = match way {
                        0 => (force(&there) - force(&behind)) / (2e-3 * by),
                        _ => (force(&there) - force(&nominal)) / (1e-3 * by),
                    };
                    let ours = nominal.stiffness.as_ref().unwrap().at(index, within)[way].at(1e-4);
                    let size = force(&nominal).norm() / 3e-3;
                    assert!(
                        (ours - measured).norm() <= tolerance * (measured.norm() + size),
                        "{pass:?} way {way} at {share}: {ours:?} {measured:?} {size}"
                    );
                }
            }
        }
    }
}

/// Milling up into a wall, a wider cut pulls the tool in; an arm that is too soft cannot hold it, and the
/// report says so where it happens. Milling down, the same arm is pushed away.
#[test]
fn a_cut_that_pulls_the_tool_in_is_warned_of() {
    let soft =
        json!({"preset":"kuka-kr-300-r2700-2","joint_compliance_rad_per_nm":[3e-5,3e-5,3e-5,3e-5,3e-5,3e-5]});
    let warned = |text: &str| {
        let text = text.replace("Z-3", "Z-12");
        let report = run(&job(
            &text,
            "deflection",
            &[("robot", soft.clone()), ("compensation", json!({"max_passes":0}))],
        ));
        let warning = report.warnings.iter().find(|warning| warning.code == "cut-pulls-in").cloned();
        (report, warning)
    };
    let (report, warning) = warned(CONVENTIONAL);
    let warning = warning.unwrap();
    assert!(warning.message.starts_with("line 4: ") && warning.from_s.is_some(), "{warning:?}");
    // There, force and deflection are the planned ones.
    let k = report.unsettled[0];
    assert_eq!(report.force[k], report.planned_force[k]);
    assert_eq!(warned(CLIMB).1, None);
}

/// The correction aims at the planned cut at once: it takes no more passes than without coupling, and
/// where the cut yields most as well.
#[test]
fn coupling_takes_no_more_passes() {
    for text in [SLOT, CLIMB, CONVENTIONAL] {
        let passes =
            ["deflection", "none"].map(|coupling| run(&job(text, coupling, &[])).compensation.passes);
        assert!(passes[0] <= passes[1], "{text:?}: {passes:?}");
    }
}

/// The case of a published simulation of a Stäubli TX200 (github.com/rafisondi/sensitivity_milling_analysis):
/// 154.1 N and 132.3 um before, with its compliance at standstill as printed, in um/N along x, y and z. The
/// direction of its feed is not given, so ours is printed for both senses of milling along x and y, and
/// not asserted beyond the force being of that size.
#[test]
fn a_published_case_is_near() {
    use armill::cutting::{Coefficients, Cut, Engagement, Hand};
    let compliance = Matrix3::from_diagonal(&Vector3::new(0.795e-6, 2.289e-6, 1.204e-6));
    for (sense, engagement) in [("down", Engagement::Climb(5e-3)), ("up", Engagement::Conventional(5e-3))] {
        let cut = Cut {
            diameter: 16e-3,
            flutes: 4,
            helix: 45_f64.to_radians(),
            hand: Hand::Right,
            corner_radius: 0.0,
            runout: 0.0,
            coefficients: Coefficients {
                ktc: 1930.4e6,
                krc: 1159.6e6,
                kac: 200.6e6,
                ..Coefficients::default()
            },
            axial_depth: 1e-3,
            engagement,
        };
        let chip = 40e-3 / (4.0 * 3333.0 / 60.0);
        let force = |width: f64, depth: f64| {
            let engagement = match engagement {
                Engagement::Climb(_) => Engagement::Climb(width),
                _ => Engagement::Conventional(width),
            };
            Cut { engagement, axial_depth: depth, ..cut }.mean_force().at(chip)
        };
        let planned = force(5e-3, 1e-3);
        // The wall is right of the feed in down milling, left of it in up milling.
        let wider = if sense == "down" { -1.0 } else { 1.0 };
        let by = 1e-6;
        let left = (force(5e-3 + wider * by, 1e-3) - force(5e-3 - wider * by, 1e-3)) / (2.0 * by);
        let up = -planned / 1e-3;
        for (along, turn) in
            [("x", Matrix3::identity()), ("y", Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0))]
        {
            let stiffness =
                CutStiffness { ways: [turn * Vector3::y(), Vector3::z()], growth: [turn * left, turn * up] };
            let planned = turn * planned;
            let deflect = |force: &Vector3<f64>| (compliance * force, Vector3::zeros());
            let balance = settled(&planned, &stiffness, &Vector3::zeros(), deflect);
            println!(
                "{sense} milling along {along}: {:.1} N planned (published 154.1), {:.1} um alone, {:.1} um coupled (132.3)",
                planned.norm(),
                deflect(&planned).0.norm() * 1e6,
                balance.deflected.0.norm() * 1e6
            );
            assert!(balance.converged && (planned.norm() / 154.1 - 1.0).abs() < 0.05);
        }
    }
}
