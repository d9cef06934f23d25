//! Native times: stages and whole jobs of the sizes in `ARMILL_BENCH_SAMPLES`, and kinematics
//! compared with other authors'.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "what cannot be prepared cannot be timed")]

use std::env;
use std::hint::black_box;
use std::time::Duration;

use armill::robot::library;
use armill_bench::adaptive;
use armill_bench::poses::{self, Poses};
use armill_bench::program;
use armill_bench::questions::{QUESTIONS, Questions};
use armill_bench::stages::{STAGES, Stages, whole};
use criterion::{Criterion, SamplingMode};
use k::{InverseKinematicsSolver, Isometry3, JacobianIkSolver, JointType, NodeBuilder, SerialChain, Vector3};
use rs_opw_kinematics::jacobian::Jacobian;
use rs_opw_kinematics::kinematic_traits::Kinematics;

#[path = "../../tests/common/peer.rs"]
mod peer;

fn main() {
    let mut criterion = Criterion::default().configure_from_args().without_plots();
    kinematics(&mut criterion);
    reading(&mut criterion);
    questions(&mut criterion);
    for samples in sizes() {
        jobs(&mut criterion, samples);
        pocket(&mut criterion, samples);
    }
    criterion.final_summary();
}

/// The sizes requested.
fn sizes() -> Vec<usize> {
    let text = env::var("ARMILL_BENCH_SAMPLES").unwrap_or_else(|_| "20000".to_owned());
    text.split(',').map(|size| size.parse().expect("ARMILL_BENCH_SAMPLES is a list of numbers")).collect()
}

fn jobs(criterion: &mut Criterion, samples: usize) {
    let stages = Stages::new(samples).expect("the default job runs");
    let mut group = criterion.benchmark_group(format!("samples {samples}"));
    // Few rounds for slow jobs.
    group.sampling_mode(SamplingMode::Flat).sample_size(if samples > 50_000 { 10 } else { 30 });
    group.warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1));
    for (name, work) in STAGES {
        group.bench_function(name, |bencher| bencher.iter(|| work(&stages)));
    }
    let text = stages.text().to_owned();
    drop(stages);
    group.bench_function("whole job", |bencher| bencher.iter(|| whole(&text)));
    group.finish();
}

/// On all cores, as the script computes them.
fn questions(criterion: &mut Criterion) {
    let questions = Questions::new().expect("the default job can be asked about");
    let mut group = criterion.benchmark_group("questions");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    group.warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1));
    for (name, work) in QUESTIONS {
        group.bench_function(name, |bencher| bencher.iter(|| work(&questions)));
    }
    group.finish();
}

fn pocket(criterion: &mut Criterion, samples: usize) {
    let text = adaptive::job(samples);
    let mut group = criterion.benchmark_group(format!("pocket {samples}"));
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    group.warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1));
    group.bench_function("reading and engagement", |bencher| bencher.iter(|| adaptive::engagement(&text)));
    group.bench_function("whole job", |bencher| bencher.iter(|| whole(&text)));
    group.finish();
}

fn reading(criterion: &mut Criterion) {
    let text = program::plain(program::LINES);
    let mut group = criterion.benchmark_group("reading");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    group.warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    group.bench_function("G-code, plain lines", |bencher| bencher.iter(|| program::read(&text)));
    group.finish();
}

fn kinematics(criterion: &mut Criterion) {
    let poses = Poses::new().expect("the default robot is known");
    let mut group = criterion.benchmark_group("kinematics");
    group.sample_size(50).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1));
    for (name, work) in poses::WORK {
        group.bench_function(name, |bencher| bencher.iter(|| work(&poses)));
    }

    let peer = peer::peer(&library::robot("staubli-rx90").expect("the default robot is in the library"));
    let joints: Vec<[f64; 6]> = poses.joints.iter().map(|q| (*q).into()).collect();
    let flanges: Vec<_> = joints.iter().map(|q| peer.forward(q)).collect();
    for (flange, ours) in flanges.iter().zip(&poses.flanges) {
        let apart =
            (flange.translation.to_array().into_iter().zip(&ours.position)).map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f64::max) < 1e-12, "another robot");
    }
    group.bench_function("rs-opw-kinematics: forward", |bencher| {
        bencher.iter(|| joints.iter().map(|q| peer.forward(q)).for_each(|pose| _ = black_box(pose)));
    });
    group.bench_function("rs-opw-kinematics: inverse, every solution", |bencher| {
        bencher.iter(|| flanges.iter().map(|flange| peer.inverse(flange)).for_each(|all| _ = black_box(all)));
    });
    group.bench_function("rs-opw-kinematics: Jacobian", |bencher| {
        bencher.iter(|| joints.iter().map(|q| Jacobian::new(&peer, q, 1e-6)).for_each(|j| _ = black_box(j)));
    });

    let chain = chain(&poses);
    let move_to = |q: &[f64; 6]| chain.set_joint_positions_unchecked(q);
    for (q, ours) in joints.iter().zip(&poses.flanges) {
        move_to(q);
        assert!((chain.end_transform().translation.vector - vector(ours.position.into())).norm() < 1e-12);
    }
    group.bench_function("k: forward", |bencher| {
        bencher.iter(|| {
            for q in &joints {
                move_to(q);
                black_box(chain.end_transform());
            }
        });
    });
    // An iterative solver: it starts one degree away in each joint and converges to a micrometre.
    let solver = JacobianIkSolver::new(1e-6, 1e-6, 0.5, 100);
    let targets: Vec<Isometry3<f64>> = joints
        .iter()
        .map(|q| {
            move_to(q);
            chain.end_transform()
        })
        .collect();
    group.bench_function("k: inverse, nearest", |bencher| {
        bencher.iter(|| {
            for (q, target) in joints.iter().zip(&targets) {
                move_to(&q.map(|q| q + 0.0175));
                // It does not always converge near a singularity; the time counts all the same.
                let _ = black_box(solver.solve(&chain, target));
            }
        });
    });
    group.bench_function("k: Jacobian", |bencher| {
        bencher.iter(|| {
            for q in &joints {
                move_to(q);
                black_box(k::jacobian(&chain));
            }
        });
    });
    group.finish();
}

/// The default robot as a chain of `k`: each joint turns about z after the fixed part of its
/// modified Denavit-Hartenberg row.
fn chain(poses: &Poses) -> SerialChain<f64> {
    let nodes: Vec<_> = poses
        .robot
        .links()
        .iter()
        .enumerate()
        .map(|(i, link)| {
            let tilt = k::UnitQuaternion::from_axis_angle(&Vector3::x_axis(), link.alpha);
            let place = tilt * Vector3::new(link.a, 0.0, link.d);
            let zero = k::UnitQuaternion::from_axis_angle(&Vector3::z_axis(), link.theta_offset);
            let axis = if link.sign > 0.0 { Vector3::z_axis() } else { -Vector3::z_axis() };
            NodeBuilder::new()
                .name(&format!("joint {}", i + 1))
                .joint_type(JointType::Rotational { axis })
                .translation(place.into())
                .rotation(tilt * zero)
                .into_node()
        })
        .collect();
    for pair in nodes.windows(2) {
        pair[1].set_parent(&pair[0]);
    }
    SerialChain::from_end(&nodes[5])
}

fn vector([x, y, z]: [f64; 3]) -> Vector3<f64> {
    Vector3::new(x, y, z)
}
