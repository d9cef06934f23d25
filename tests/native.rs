//! Every test that needs neither a browser nor Node, as one program: it compiles and links once, and all
//! tests share the processor's cores.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod common;
mod controllers;
#[path = "gallery/cards.rs"]
mod cards;
#[path = "common/plant.rs"]
mod plant;

mod apt;
mod arcs;
mod band;
mod blending;
mod branch;
mod budget;
mod cell;
mod charts;
mod cldata;
mod controller_fragments;
mod coupling;
mod csv;
mod cutting;
mod deviation_map;
mod differential;
mod docs;
mod drives;
mod elbow;
mod equilibrium;
mod evidence;
mod examples;
mod export;
mod feed_rule;
mod fuzz;
mod gallery;
mod gcode;
mod gcode_controls;
mod gcode_laws;
mod gcode_linuxcnc;
mod identify;
mod job;
mod judged;
mod kinematics;
mod laws;
mod learn;
mod layers;
mod library;
mod measured;
mod numerical;
mod online;
mod overload;
mod packages;
mod path;
mod placement;
mod posts;
mod programs;
mod puma;
mod reference;
mod remedies;
mod replay;
mod reruns;
mod round_trip;
mod script;
mod shop;
mod sources;
mod spans;
mod spin;
mod stock;
mod stock_job;
mod stock_raster;
mod stops;
mod study;
mod superposed;
mod surface;
mod thesis;
mod verdict;
mod warnings;
