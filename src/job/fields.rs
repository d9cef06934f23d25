//! Every input of a job as a person meets it: label, unit, legal range, default, a line of help.
//!
//! The page builds its form from this table and the job is checked against it: one range, written once.

use crate::cutting::kienzle::{AXIAL, RADIAL};
use crate::cutting::material::{self, Material};
use crate::error::Error;
use crate::job::Job;
use crate::robot::library;
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// What a fresh field for pasted points shows.
const EXAMPLE_ROWS: &str = "x, y, z\n600, -200, 100\n700, 0, 100\n600, 200, 100\n";
/// What a fresh field for a G-code program shows.
const EXAMPLE_GCODE: &str = "G21 G90 G17\nS4000 M3\nG0 X600 Y-100 Z120\nG1 Z100 F3000\nG1 Y40\nG2 X640 Y80 I40 J0\nG1 X700\nG0 Z120\nM30\n";
/// What a fresh field for an APT program shows.
const EXAMPLE_APT: &str = "UNITS/MM\nSPINDL/RPM,4000,CLW\nFROM/600,-100,120\nFEDRAT/3000,MMPM\nGOTO/600,-100,100\nGOTO/650,0,100,0.1,0,0.99498743710662\nGOTO/700,100,100\nFINI\n";

/// How a value is entered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A number.
    Number,
    /// A whole number.
    Integer,
    /// One of a few words.
    Choice,
    /// Three numbers.
    Vector,
    /// A table of numbers.
    Table,
    /// Free text.
    Text,
    /// Any of a few words.
    Set,
}

/// One input.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Field {
    /// JSON path in the job.
    pub path: &'static str,
    /// Stage it belongs to.
    pub group: &'static str,
    /// Name as read.
    pub label: &'static str,
    /// Unit as printed.
    pub unit: &'static str,
    /// How it is entered.
    pub kind: Kind,
    /// Legal words, with what is read for each; a number field with choices takes these words too.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub choices: Vec<Word>,
    /// Smallest legal number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min: Option<f64>,
    /// Largest legal number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<f64>,
    /// Value that a fresh field shows.
    pub default: Value,
    /// Values that a fresh field shows instead where the field in `when` has one of these words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub defaults: Option<BTreeMap<&'static str, Value>>,
    /// What it is and where to find it.
    pub help: &'static str,
    /// Shown only if another field has one of some values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub when: Option<When>,
}

/// A legal word.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Word {
    /// As in the JSON.
    pub value: &'static str,
    /// As read.
    pub label: String,
    /// Heading that it stands under, where there are many.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub heading: Option<&'static str>,
}

/// The condition under which a field belongs to the job.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct When {
    /// The other field.
    pub path: &'static str,
    /// Its values.
    pub is: Vec<&'static str>,
}

/// A row of the table: a [`Field`] that is there before the program runs.
#[derive(Clone, Copy)]
struct Row {
    path: &'static str,
    label: &'static str,
    unit: &'static str,
    kind: Kind,
    default: fn() -> Value,
    help: &'static str,
    words: &'static [(&'static str, &'static str)],
    range: Option<(f64, f64)>,
    defaults: &'static [(&'static str, &'static str)],
    when: Option<(&'static str, &'static [&'static str])>,
}

const fn field(
    path: &'static str,
    label: &'static str,
    unit: &'static str,
    kind: Kind,
    default: fn() -> Value,
    help: &'static str,
) -> Row {
    Row { path, label, unit, kind, default, help, words: &[], range: None, defaults: &[], when: None }
}

impl Row {
    const fn range(self, min: f64, max: f64) -> Self {
        Self { range: Some((min, max)), ..self }
    }

    const fn words(self, words: &'static [(&'static str, &'static str)]) -> Self {
        Self { words, ..self }
    }

    const fn defaults(self, defaults: &'static [(&'static str, &'static str)]) -> Self {
        Self { defaults, ..self }
    }

    const fn when(self, path: &'static str, is: &'static [&'static str]) -> Self {
        Self { when: Some((path, is)), ..self }
    }

    fn field(&self) -> Field {
        let group = self.path.split('.').next().unwrap_or(self.path);
        let group = match group {
            "tool_frame" | "base_frame" | "workpiece_frame" | "spin" | "start_branch" => "frames",
            other => other,
        };
        let word = |&(value, label): &(&'static str, &'static str)| Word {
            value,
            label: label.into(),
            heading: None,
        };
        let choices = if self.path == "material.preset" {
            let word = |material: &Material| Word {
                value: material.id,
                label: material.name.into(),
                heading: Some(material.model.heading()),
            };
            material::library().iter().map(word).collect()
        } else if self.path == "robot.preset" {
            library::names()
                .map(|[value, maker, model]| Word {
                    value,
                    label: format!("{maker} {model}"),
                    heading: Some(maker),
                })
                .collect()
        } else {
            self.words.iter().map(word).collect()
        };
        let defaults = self.defaults.iter().map(|&(word, text)| (word, json!(text)));
        Field {
            path: self.path,
            group,
            label: self.label,
            unit: self.unit,
            kind: self.kind,
            choices,
            min: self.range.map(|(min, _)| min),
            max: self.range.map(|(_, max)| max),
            default: (self.default)(),
            defaults: (!self.defaults.is_empty()).then(|| defaults.collect()),
            help: self.help,
            when: self.when.map(|(path, is)| When { path, is: is.to_vec() }),
        }
    }
}

/// The thesis's robot, for what fresh fields show.
fn rx90(value: fn(&library::Preset) -> Value) -> Value {
    library::robot("staubli-rx90").map_or(Value::Null, |preset| value(&preset))
}

/// A robot's modified DH table as in the JSON.
pub(crate) fn dh_rows(preset: &library::Preset) -> Value {
    let mut signs = preset.opw.joint_sign.into_iter();
    let row = |[alpha, a, d, theta]: [f64; 4]| json!({"alpha_deg": alpha, "a_mm": a, "d_mm": d, "theta_offset_deg": theta, "joint_sign": signs.next()});
    preset.opw.modified_dh().map(row).to_vec().into()
}

/// A robot's ortho-parallel parameters as in the JSON.
pub(crate) fn opw(preset: &library::Preset) -> Value {
    let [a1, a2, b, c1, c2, c3, c4] = preset.opw.lengths_mm;
    json!({"a1_mm": a1, "a2_mm": a2, "b_mm": b, "c1_mm": c1, "c2_mm": c2, "c3_mm": c3, "c4_mm": c4,
        "joint_sign": preset.opw.joint_sign, "joint_offset_deg": preset.opw.joint_offset_deg})
}

/// The table, in the order of the pipeline.
static TABLE: &[Row] = {
    use Kind::{Choice, Integer, Number, Set, Table, Text, Vector};
    &[
        field("robot.preset", "Robot", "", Choice, || json!("staubli-rx90"), "An arm of the library, or your own by ortho-parallel lengths or a modified Denavit-Hartenberg table."),
        field("robot.name", "Name", "", Text, || json!("My robot"), "For the report.").when("robot", &["table", "opw"]),
        field("robot.modified_dh", "Modified DH table", "deg, mm", Table, || rx90(dh_rows), "One row a joint: twist and length to the joint before, offset along the axis, constant part of the angle, and 1 or -1 for the way it is counted.").when("robot", &["table"]),
        field("robot.opw", "Ortho-parallel parameters", "mm, deg", Table, || rx90(opw), "Lengths a1 to c4 as robot packages list them (Brandstoetter 2014), and for each joint its sign and zero offset: the parameters' own angle is sign times joint value less the offset. KUKA: signs -1 1 1 -1 1 -1, offset of joint 2 -90; ABB: all 1, joint 3 -90.").range(-20000.0, 20000.0).when("robot", &["opw"]),
        field("robot.joint_3", "Joint 3 counts from", "", Choice, || json!("serial"), "The upper arm, as most robots do; the base, as FANUC's pendants show it (joint 3 is the forearm's own inclination); or the base through a parallelogram that drives the forearm (ABB IRB 2400, 4400, 6660 and the like), where the arm also gives way differently.").words(&[("serial", "the upper arm"), ("pendant", "the base (pendant)"), ("parallelogram", "the base (parallelogram)")]).when("robot", &["table", "opw"]),
        field("robot.joint_limits_deg", "Joint ranges", "deg", Table, || rx90(|preset| json!(preset.joint_limits_deg)), "Lowest and highest angle of each joint in the robot's own zero; from the data sheet.").when("robot", &["table", "opw"]),
        field("robot.joint_compliance_rad_per_nm", "Joint compliance", "rad/(N m)", Table, || rx90(|preset| json!(preset.joint_compliance)), "How far each joint turns under 1 N m; 1 divided by its stiffness, from a load test or a paper. Measured values of one robot family scatter by a factor of two and more.").range(0.0, 1e-2),
        field("robot.joint_springs_nm_arcmin", "Springs that are no straight lines", "N m, arcmin", Table, || json!([]), "For joints with lost motion or hardening: one row a point, the joint, a torque and the turn under it, torques rising. Lost motion is a first point at the small torque that takes it up. From the gearbox's hysteresis curve, or a load test. Empty: compliances alone.").range(-1e7, 1e7),
        field("robot.loads_kg_mm", "Weight carried", "kg, mm", Table, || json!([]), "For sag: one row a mass, the link (6 is the flange: the spindle), kilograms, and the centre of mass x, y, z in the link's modified Denavit-Hartenberg frame. Empty: the controller has the weight corrected.").range(-1e5, 1e5),
        field("robot.sag_zero", "Sag counts from", "", Choice, || json!("start"), "A workpiece touched off with the loaded robot has the sag there in its frame: only the change along the path errs.").words(&[("start", "the start of the path"), ("model", "the arm without weight")]),
        field("tool_frame.xyz_mm", "Tool tip on the flange", "mm", Vector, || json!([0, 0, 0]), "Position of the tip (TCP) in the flange frame, as in the controller's tool data.").range(-5000.0, 5000.0),
        field("tool_frame.rpy_deg", "Tool orientation", "deg", Vector, || json!([0, 0, 0]), "Roll, pitch and yaw of the TCP; its z axis points out of the tool towards the part.").range(-360.0, 360.0),
        field("workpiece_frame.xyz_mm", "Workpiece position", "mm", Vector, || json!([0, 0, 0]), "Origin of the workpiece frame in the cell; with the robot's base at zero, in the base frame, as in the controller's base or work object data.").range(-20000.0, 20000.0),
        field("workpiece_frame.rpy_deg", "Workpiece orientation", "deg", Vector, || json!([0, 0, 0]), "Roll, pitch and yaw of the workpiece frame about the cell's x, y and z axes, in this order.").range(-360.0, 360.0),
        field("base_frame.xyz_mm", "Robot base position", "mm", Vector, || json!([0, 0, 0]), "Where the robot's base stands in the cell: on a plinth, or along a track. Columns, charts and programs stay in the base frame; only the workpiece is given in the cell.").range(-20000.0, 20000.0),
        field("base_frame.rpy_deg", "Robot base orientation", "deg", Vector, || json!([0, 0, 0]), "Roll, pitch and yaw of the base in the cell, whose z axis points up; roll 180 hangs it from the ceiling.").range(-360.0, 360.0),
        field("spin.mode", "Spin about the tool axis", "", Choice, || json!("fixed"), "Milling leaves the angle about the tool axis open: keep it fixed to the part, or let it be chosen along the path.").words(&[("fixed", "fixed"), ("free", "free within a range")]),
        field("spin.angle_deg", "Spin angle", "deg", Number, || json!(0), "Turn of the TCP about the tool axis, counter-clockwise seen from the spindle; at 0 its x axis is workpiece +X projected across the tool axis. A free spin is compared with it.").range(-360.0, 360.0),
        field("spin.range_deg", "Spin range", "deg", Vector, || json!([-180, 180]), "Smallest and largest angle that cables and collisions allow.").range(-360.0, 360.0).when("spin.mode", &["free"]),
        field("spin.goal", "Spin is chosen for", "", Choice, || json!("smooth-joints"), "Joints that turn little and evenly, away from limits and singularities; or the least error by the cutting force.").words(&[("smooth-joints", "smooth joints"), ("least-error", "least error")]).when("spin.mode", &["free"]),
        field("start_branch.shoulder", "Shoulder", "", Choice, || json!("front"), "The arm faces the first point, or reaches over its back.").words(&[("front", "facing the point"), ("back", "over its back")]),
        field("start_branch.elbow", "Elbow", "", Choice, || json!("positive"), "Sign of the elbow angle from the stretched arm (RX-90: of q3).").words(&[("positive", "positive"), ("negative", "negative")]),
        field("start_branch.wrist", "Wrist", "", Choice, || json!("near"), "The wrist with the smaller turn of joint 4, or the one turned by 180 degrees.").words(&[("near", "smaller q4"), ("flipped", "flipped")]),
        field("path.kind", "Shape", "", Choice, || json!("circle"), "What the tool tip is to follow, in the workpiece frame, tool upright.").words(&[("circle", "Circle"), ("arc", "Arc"), ("rectangle", "Rectangle"), ("line", "Straight line"), ("gcode", "G-code program"),
                ("apt", "APT / CLDATA program"),
                ("csv", "Points, pasted"), ("polyline", "Points, listed (JSON)")]),
        field("path.center_mm", "Centre", "mm", Vector, || json!([0, 0, 0]), "Centre of the shape.").range(-20000.0, 20000.0).when("path.kind", &["circle", "arc", "rectangle"]),
        field("path.radius_mm", "Radius", "mm", Number, || json!(300), "Radius of the circle or arc.").range(0.001, 10000.0).when("path.kind", &["circle", "arc"]),
        field("path.normal", "Normal", "", Vector, || json!([0.2, 0.3, 0.5]), "Direction the circle runs counter-clockwise about; its length does not matter.").range(-1e6, 1e6).when("path.kind", &["circle", "arc"]),
        field("path.start_deg", "Start angle", "deg", Number, || json!(0), "From the projection of +X into the circle's plane.").range(-360.0, 360.0).when("path.kind", &["arc"]),
        field("path.sweep_deg", "Sweep", "deg", Number, || json!(180), "Counter-clockwise about the normal if positive.").range(-3600.0, 3600.0).when("path.kind", &["arc"]),
        field("path.width_mm", "Width (X)", "mm", Number, || json!(300), "Size along X.").range(0.001, 20000.0).when("path.kind", &["rectangle"]),
        field("path.height_mm", "Height (Y)", "mm", Number, || json!(200), "Size along Y.").range(0.001, 20000.0).when("path.kind", &["rectangle"]),
        field("path.corner_radius_mm", "Corner radius", "mm", Number, || json!(0), "0 gives sharp corners, at which the path stops.").range(0.0, 10000.0).when("path.kind", &["rectangle"]),
        field("path.from_mm", "From", "mm", Vector, || json!([600, -200, 100]), "Start of the line.").range(-20000.0, 20000.0).when("path.kind", &["line"]),
        field("path.to_mm", "To", "mm", Vector, || json!([600, 200, 100]), "End of the line.").range(-20000.0, 20000.0).when("path.kind", &["line"]),
        field("path.points_mm", "Points", "mm", Table, || json!([[600, -200, 100], [700, 0, 100], [600, 200, 100]]), "Straight lines through these points.").range(-20000.0, 20000.0).when("path.kind", &["polyline"]),
        field("path.text", "Program", "", Text, || json!(EXAMPLE_ROWS), "As it comes from CAM; drop a file here. Points: one a line, x, y, z, with tool axis i, j, k and feed where they are needed, separated by comma, semicolon, tab or blank.").when("path.kind", &["csv", "gcode", "apt"]).defaults(&[("csv", EXAMPLE_ROWS), ("gcode", EXAMPLE_GCODE), ("apt", EXAMPLE_APT)]),
        field("path.unit", "Unit of lengths", "", Choice, || json!("mm"), "Of a text that does not say its own.").words(&[("mm", "mm"), ("inch", "inch")]).when("path.kind", &["csv", "apt"]),
        field("path.feed_unit", "Unit of feeds", "", Choice, || json!("mm/s"), "Of rows that do not say their own.").words(&[("mm/s", "mm/s"), ("mm/min", "mm/min"), ("inch/min", "inch/min")]).when("path.kind", &["csv"]),
        field("path.tool_length_offsets_mm", "Tool length offsets", "mm", Table, || json!([]), "For G43 H: one row an offset, the number H and the length that is added to Z. Leave it empty if the tool frame holds the whole tool.").range(-5000.0, 5000.0).when("path.kind", &["gcode"]),
        field("path.work_offsets_mm", "Work offsets", "mm", Table, || json!([]), "G54, G55 and so on, one row each: x, y, z from the workpiece frame. Leave it empty if the program's zero is the workpiece frame.").range(-20000.0, 20000.0).when("path.kind", &["gcode"]),
        field("motion.feed_mm_s", "Feed", "mm/s", Number, || json!(100), "Highest speed along the path: the F word of a program, divided by 60.").range(0.001, 10000.0),
        field("motion.rapid_mm_s", "Rapid speed", "mm/s", Number, || json!(250), "Speed of a program's positioning moves, which do not cut.").range(0.001, 20000.0).when("path.kind", &["gcode", "apt"]),
        field("motion.acceleration_mm_s2", "Acceleration", "mm/s²", Number, || json!(200), "Along the path, at starts and stops; from the controller's data, or from the slope of a logged speed.").range(0.01, 1e6),
        field("motion.sample_time_s", "Sample time", "s", Number, || json!(0.001), "Interpolation interval of the controller; in its manual, often 1 to 16 ms.").range(1e-5, 1.0),
        field("motion.corner_angle_deg", "Corners stop above", "deg", Number, || json!(5), "A corner sharper than this is a full stop: that keeps the contour.").range(0.1, 180.0),
        field("motion.corner_dwell", "Wait in corners", "s", Number, || json!("settle"), "Time at rest in such a corner; until settled is the only exact cure for a corner that shaping rounds.").range(0.0, 60.0).words(&[("settle", "until settled")]),
        field("tool.diameter_mm", "Diameter", "mm", Number, || json!(10), "Of the end mill; in its catalogue or on its shank.").range(0.01, 500.0),
        field("tool.flutes", "Flutes", "", Integer, || json!(4), "Number of cutting edges; count them.").range(1.0, 100.0),
        field("tool.helix_deg", "Helix angle", "deg", Number, || json!(30), "Angle between edge and tool axis; it smooths the force but does not change its mean. In the tool's catalogue.").range(0.0, 80.0),
        field("tool.corner_radius_mm", "Corner radius", "mm", Number, || json!(0), "Of the bottom corner: 0 is a flat end mill, half the diameter a ball nose, between them a bull nose.").range(0.0, 250.0).words(&[("ball", "ball nose")]),
        field("tool.rake_deg", "Rake angle", "deg", Number, || json!(0), "Normal rake. It enters with k_c1.1 (1 % less force a degree) and with orthogonal data (oblique cutting); identified coefficients hold for the rake they were measured with.").range(-30.0, 40.0),
        field("tool.runout_mm", "Runout", "mm", Number, || json!(0), "How far the tool's axis is off the spindle's: half of what a dial gauge swings. Teeth then cut unevenly; the mean force stays.").range(0.0, 5.0),
        field("tool.bending", "Tool in its holder", "", Choice, || json!("rigid"), "A long tool bends too, in addition to the arm.").words(&[("rigid", "rigid"), ("cantilever", "cantilever")]),
        field("tool.stickout_mm", "Stickout", "mm", Number, || json!(40), "Length out of the holder.").range(0.1, 1000.0).when("tool.bending", &["cantilever"]),
        field("tool.flute_length_mm", "Flute length", "mm", Number, || json!(20), "From the tip; there the tool bends like a bar of 0.8 of its diameter (Kops and Vo 1990).").range(0.0, 1000.0).when("tool.bending", &["cantilever"]),
        field("tool.shank_diameter_mm", "Shank diameter", "mm", Number, || json!(10), "Behind the flutes.").range(0.01, 500.0).when("tool.bending", &["cantilever"]),
        field("tool.modulus_gpa", "Young's modulus", "GPa", Number, || json!(600), "Carbide 550 to 650, high-speed steel 210.").range(1.0, 2000.0).when("tool.bending", &["cantilever"]),
        field("material.preset", "Material", "", Choice, || json!("thesis"), "Cutting coefficients of the library, or your own. Take any table value as ±30 %."),
        field("material.ktc_n_mm2", "k_tc, tangential", "N/mm²", Number, || json!(1800), "Tangential force for each mm² of chip section; from a table of the alloy, or fitted to measured forces.").range(0.0, 1e5).when("material", &["table"]),
        field("material.krc_n_mm2", "k_rc, radial", "N/mm²", Number, || json!(540), "Radial force for each mm² of chip section.").range(-1e5, 1e5).when("material", &["table"]),
        field("material.kac_n_mm2", "k_ac, axial", "N/mm²", Number, || json!(800), "Axial force for each mm² of chip section.").range(-1e5, 1e5).when("material", &["table"]),
        field("material.kte_n_mm", "k_te, tangential edge", "N/mm", Number, || json!(0), "Tangential force for each mm of edge, whatever the chip.").range(-1e4, 1e4).when("material", &["table"]),
        field("material.kre_n_mm", "k_re, radial edge", "N/mm", Number, || json!(0), "Radial force for each mm of edge.").range(-1e4, 1e4).when("material", &["table"]),
        field("material.kae_n_mm", "k_ae, axial edge", "N/mm", Number, || json!(0), "Axial force for each mm of edge.").range(-1e4, 1e4).when("material", &["table"]),
        field("material.kc11_n_mm2", "k_c1.1, specific force", "N/mm²", Number, || json!(1500), "Cutting force of a chip of 1 mm by 1 mm, from the tool maker's catalogue.").range(1.0, 1e5).when("material", &["kienzle"]),
        field("material.mc", "m_c, exponent", "", Number, || json!(0.25), "How fast thin chips become dear; in the same table, mostly 0.17 to 0.3.").range(0.0, 0.95).when("material", &["kienzle"]),
        field("material.radial_ratio", "Radial to tangential force", "", Number, || json!(RADIAL), "No catalogue gives it: 0.2 to 0.4 is typical, 0.16 to 0.6 was measured; worn edges have more.").range(-5.0, 5.0).when("material", &["kienzle", "kienzle-preset"]),
        field("material.axial_ratio", "Axial to tangential force", "", Number, || json!(AXIAL), "No catalogue gives it; it grows with the helix: 0.1 to 0.45 at 30 deg.").range(-5.0, 5.0).when("material", &["kienzle", "kienzle-preset"]),
        field("material.line", "Straight line", "", Choice, || json!("tangent"), "The force model is linear in the chip. Tangent: force and its slope are right at the chip thickness below; secant: the force is, and it is zero without a chip.").words(&[("tangent", "tangent"), ("secant", "secant")]).when("material", &["kienzle", "kienzle-preset"]),
        field("material.chip_thickness_mm", "Made at chip thickness", "mm", Number, || json!("mean"), "Where the line touches the curve; the mean is that of this cut.").range(0.001, 10.0).words(&[("mean", "mean of the cut")]).when("material", &["kienzle", "kienzle-preset", "orthogonal-preset"]),
        field("cutting.axial_depth_mm", "Axial depth", "mm", Number, || json!(10), "Depth of cut along the tool axis, as in the CAM operation; 0 is air.").range(0.0, 1000.0),
        field("cutting.engagement", "Engagement", "", Choice, || json!("angles"), "Climb (down) milling has the part right of the feed, conventional (up) milling left of it; the spindle turns clockwise.").words(&[("angles", "by angles"), ("climb", "climb (down)"), ("conventional", "conventional (up)"), ("slot", "slot")]),
        field("cutting.radial_depth_mm", "Radial depth", "mm", Number, || json!(5), "How far the tool reaches into the part across the feed, at most its diameter; the width of cut or stepover of the CAM operation.").range(0.0001, 500.0).when("cutting.engagement", &["climb", "conventional"]),
        field("cutting.entry_deg", "Entry angle", "deg", Number, || json!(90), "Immersion angle at which a tooth enters, clockwise from the side the feed's left hand points to. Down milling at half immersion: 90 to 180; slot: 0 to 180.").range(0.0, 180.0).when("cutting.engagement", &["angles"]),
        field("cutting.exit_deg", "Exit angle", "deg", Number, || json!(180), "Immersion angle at which a tooth leaves.").range(0.0, 180.0).when("cutting.engagement", &["angles"]),
        field("cutting.spindle_rpm", "Spindle speed", "1/min", Number, || json!(4000), "The S word of the program; clockwise, seen from the spindle.").range(1.0, 1e6),
        field("cutting.spindle_power_kw", "Spindle power", "kW", Number, || json!("unknown"), "What the spindle can give, from its data sheet; above it the report warns.").range(0.001, 1000.0).words(&[("unknown", "not known")]),
        field("cutting.feed_per_tooth_mm", "Feed per tooth", "mm", Number, || json!(0.1), "Chip load; from feed means the local speed divided by flutes and spindle speed.").range(0.0, 10.0).words(&[("from_feed", "from feed")]),
        field("shaper.kind", "Input shaper", "", Choice, || json!("zvd"), "Filter that keeps the arm from shaking; the more robust, the longer its delay.").words(&[("none", "none"), ("zv", "ZV"), ("zvd", "ZVD"), ("zvdd", "ZVDD"), ("ei", "EI")]),
        field("shaper.frequency_rad_s", "Natural frequency", "rad/s", Number, || json!(18), "Of the mode to be left at rest, from a tap test at the tool. 1 Hz is 6.283 rad/s; heavy milling robots have 45 to 125 rad/s (7 to 20 Hz).").range(0.1, 10000.0).when("shaper.kind", &["zv", "zvd", "zvdd", "ei"]),
        field("shaper.frequency_hz", "Natural frequency", "Hz", Number, || json!(2.865), "The same in Hz: a job gives one of the two.").range(0.01, 2000.0).when("shaper", &["hz"]),
        field("shaper.damping", "Damping ratio", "", Number, || json!(0.1), "Of that mode, from the decay after a tap; heavy milling robots have 0.02 to 0.04.").range(0.0, 0.9).when("shaper.kind", &["zv", "zvd", "zvdd", "ei"]),
        field("compensation.sources", "Compensate", "", Set, || json!(["deflection", "shaping"]), "Which errors the commanded path corrects; all act in the result.").words(&[("deflection", "deflection by cutting forces"), ("shaping", "distortion by the shaper")]),
        field("compensation.tolerance_mm", "Tolerance", "mm", Number, || json!(0.01), "Largest contour error to reach, from the part's drawing.").range(1e-6, 100.0),
        field("compensation.max_passes", "Passes at most", "", Integer, || json!(5), "Each pass sends the whole path through the model again.").range(0.0, 100.0),
    ]
};

/// The table, in the order of the pipeline.
pub fn fields() -> Vec<Field> {
    TABLE.iter().map(Row::field).collect()
}

/// Checks every number of the job against the table.
pub(crate) fn check_ranges(job: &Job) -> Result<(), Error> {
    let Ok(values) = serde_json::to_value(job) else { return Ok(()) };
    for field in TABLE {
        let Some((min, max)) = field.range else { continue };
        let value = field.path.split('.').try_fold(&values, |value, key| value.get(key));
        if let Some(value) = value {
            check(field.path.to_owned(), value, min, max, field.unit)?;
        }
    }
    Ok(())
}

fn check(field: String, value: &Value, min: f64, max: f64, unit: &'static str) -> Result<(), Error> {
    match value {
        Value::Array(items) => items
            .iter()
            .enumerate()
            .try_for_each(|(index, item)| check(format!("{field}[{index}]"), item, min, max, unit)),
        Value::Object(parts) => {
            parts.iter().try_for_each(|(key, part)| check(format!("{field}.{key}"), part, min, max, unit))
        }
        // serde_json writes a number that is not finite as null.
        Value::Null => Err(Error::Invalid {
            field,
            value: "not a finite number".into(),
            expected: format!("{min} to {max} {unit}"),
        }),
        Value::Number(number) => match number.as_f64() {
            Some(value) if value >= min && value <= max => Ok(()),
            number => Err(Error::OutOfRange { field, value: number.unwrap_or(f64::NAN), min, max, unit }),
        },
        _ => Ok(()),
    }
}

/// Refuses keys of the path that its kind does not use: a forgotten key would be lost in silence.
pub(crate) fn check_path_keys(job: &Job) -> Result<(), Error> {
    let Ok(Value::Object(given)) = serde_json::to_value(&job.path) else { return Ok(()) };
    let kind = given.get("kind").and_then(Value::as_str).unwrap_or_default();
    for field in TABLE {
        let Some((key, (_, kinds))) = field.path.strip_prefix("path.").zip(field.when) else { continue };
        if given.contains_key(key) && !kinds.contains(&kind) {
            return Err(Error::Invalid {
                field: field.path.into(),
                value: "given".into(),
                expected: format!("a path of kind {kind} has no {key}; it belongs to {}", kinds.join(", ")),
            });
        }
    }
    Ok(())
}
