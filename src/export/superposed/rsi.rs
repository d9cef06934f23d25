//! KUKA Robot Sensor Interface: the context with the objects that correct the path, the Ethernet configuration that it names,
//! and a module that runs the desired program with it.
//!
//! Context of schema 2.0.0 as RSI 4.1 and later take it: object types, numbers of parameters and inputs follow a context that
//! KUKA's own editor wrote (github.com/ros-industrial/kuka_experimental, `KR_C4_RSI_4+`), Ethernet elements the same
//! source and github.com/erensezener/kuka-rsi3-communicator, limits and `RefCorrSys` the blueprints in that context. Corrections are
//! absolute, in the base of the workpiece.

use super::{CorrectionRow, CorrectionTable, header};
use crate::export::header::number;
use crate::export::post::robot::PackageFile;
use crate::report::Report;
use crate::units::MM;
use std::fmt::Write;

/// The cycles at which RSI runs [s].
pub const CYCLES: [f64; 2] = [0.004, 0.012];
/// Cycles without an answer until RSI stops.
const TIMEOUT: usize = 10;
/// Inputs of the correction, in the order of the object's ports.
const PORTS: [&str; 6] = ["X", "Y", "Z", "A", "B", "C"];
/// Number of `RefCorrSys` for the base.
const BASE: usize = 1;

/// Limits of the objects: they let the table pass, and not much more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RsiLimits {
    /// Largest shift along each axis [mm].
    pub shift: u32,
    /// Largest rotation [deg].
    pub turn: u32,
    /// Largest shift as a whole, where RSI stops [mm].
    pub stop: u32,
}

impl RsiLimits {
    /// A quarter more than the table needs, in whole millimetres and degrees, 1 at least.
    pub fn of(table: &CorrectionTable) -> Self {
        let above = |value: f64| ((1.25 * value).ceil() as u32).max(1);
        let shift = above(table.largest_component / MM);
        let stop = (f64::from(shift) * 3.0_f64.sqrt()).ceil() as u32 + 1;
        Self { shift, turn: above(2.0 * table.largest_turn), stop }
    }
}

/// The files, the module first.
pub(super) fn files(report: &Report, table: &CorrectionTable) -> Vec<PackageFile> {
    let name = &report.setup().output.name;
    let said = header(report, table);
    let limits = RsiLimits::of(table);
    let file = |ending: &str, text| PackageFile { path: format!("{name}{ending}"), text };
    vec![
        file("_RSI.src", module(report, table, &said)),
        file("_RSI.rsix", context(name, &limits, &said)),
        file("_RSI_ethernet.xml", ethernet(&said)),
        file("_correction.csv", super::remarks(&said) + &table.csv()),
    ]
}

/// The module that creates the context, runs the desired program, and switches RSI off.
fn module(report: &Report, table: &CorrectionTable, said: &[String]) -> String {
    let setup = report.setup();
    let (name, base) = (&setup.output.name, setup.output.base);
    let mut text = format!("DEF {name}_RSI( )\n");
    for line in said {
        let _ = writeln!(text, "; {line}");
    }
    let slow =
        "; RSI_ON as it stands runs at 4 ms. For this table at 12 ms see the manual of your version.\n";
    let _ = write!(
        text,
        "DECL INT RET\n\
         DECL INT CONTID\n\
         ;FOLD INI\n\
         GLOBAL INTERRUPT DECL 3 WHEN $STOPMESS==TRUE DO IR_STOPM ( )\n\
         INTERRUPT ON 3\n\
         BAS (#INITMOV,0 )\n\
         ;ENDFOLD (INI)\n\
         ; The correction is counted in BASE_DATA[{base}], the frame of the workpiece: activate it before RSI_ON.\n\
         BAS (#BASE,{base})\n\
         ; Move to the start of the desired path here.\n\
         RET=RSI_CREATE(\"{name}_RSI\",CONTID,TRUE)\n\
         IF (RET<>RSIOK) THEN\n\
         HALT\n\
         ENDIF\n\
         {}RET=RSI_ON(#ABSOLUTE)\n\
         IF (RET<>RSIOK) THEN\n\
         HALT\n\
         ENDIF\n\
         ; Call the program of the desired path here, as your post processor wrote it.\n\
         RET=RSI_OFF()\n\
         IF (RET<>RSIOK) THEN\n\
         HALT\n\
         ENDIF\n\
         END\n",
        if table.cycle == CYCLES[1] { slow } else { "" }
    );
    text
}

/// One parameter of an object.
fn parameter(name: &str, id: usize, value: &str) -> String {
    format!("            <Parameter Name=\"{name}\" ParamId=\"{id}\" ParamValue=\"{value}\" />\n")
}

/// One that cannot be changed while it runs.
fn fixed_parameter(name: &str, id: usize, value: &str) -> String {
    parameter(name, id, value).replace("<Parameter ", "<Parameter IsRuntime=\"false\" ")
}

/// One object of the context; `inputs` are names of other objects and numbers of their outputs.
fn object((number, kind, id): (usize, &str, &str), inputs: &[(&str, usize)], parameters: &str) -> String {
    let mut text = format!("      <RsiObject ObjTypeId=\"{number}\" ObjType=\"{kind}\" ObjId=\"{id}\">\n");
    if !inputs.is_empty() {
        text.push_str("         <Inputs>\n");
        for (port, (from, output)) in inputs.iter().enumerate() {
            let _ = writeln!(
                text,
                "            <Input InIdx=\"{port}\" OutObjId=\"{from}\" OutIdx=\"{output}\" />"
            );
        }
        text.push_str("         </Inputs>\n");
    }
    let _ = write!(text, "         <Parameters>\n{parameters}         </Parameters>\n      </RsiObject>\n");
    text
}

fn context(name: &str, limits: &RsiLimits, said: &[String]) -> String {
    let RsiLimits { shift, turn, stop } = limits;
    let (low, high) = (format!("-{shift}"), shift.to_string());
    let link = fixed_parameter("ConfigFile", 0, &format!("{name}_RSI_ethernet.xml"))
        + &parameter("Timeout", 0, &TIMEOUT.to_string())
        + &parameter("Flag", 3, "1")
        + &parameter("Precision", 7, "6");
    let mut correction = String::new();
    for (axis, port) in PORTS[..3].iter().enumerate() {
        correction += &parameter(&format!("LowerLim{port}"), axis, &low);
    }
    for (axis, port) in PORTS[..3].iter().enumerate() {
        correction += &parameter(&format!("UpperLim{port}"), 3 + axis, &high);
    }
    correction += &parameter("MaxRotAngle", 6, &turn.to_string());
    correction += &fixed_parameter("RefCorrSys", 0, &BASE.to_string());
    let watch =
        parameter("MaxTrans", 0, &stop.to_string()) + &parameter("MaxRotAngle", 1, &(2 * turn).to_string());
    let outputs = [0, 1, 2, 3, 4, 5].map(|output| ("Ethernet_1", output));
    let objects = [
        object((64, "Ethernet", "Ethernet_1"), &[], &link),
        object((27, "PosCorr", "PosCorr_1"), &outputs, &correction),
        object((81, "PosCorrMon", "PosCorrMon_1"), &[], &watch),
    ];
    let opening = "<RsiContext xsi:schemaLocation=\"RsiContext RsiContext.xsd\" SchemaVersion=\"2.0.0\" \
                   xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" xmlns=\"RsiContext\">";
    format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n{}{opening}\n   <RsiObjects xmlns=\"RsiDriver\">\n{}   </RsiObjects>\n\
         </RsiContext>\n",
        remarks(said),
        objects.concat()
    )
}

fn ethernet(said: &[String]) -> String {
    let element = |(index, port): (usize, &&str)| {
        format!(
            "         <ELEMENT TAG=\"RKorr.{port}\" TYPE=\"DOUBLE\" INDX=\"{}\" HOLDON=\"1\" />\n",
            index + 1
        )
    };
    let received: String = PORTS.iter().enumerate().map(element).collect();
    let sent = ["DEF_RIst", "DEF_RSol"]
        .map(|tag| format!("         <ELEMENT TAG=\"{tag}\" TYPE=\"DOUBLE\" INDX=\"INTERNAL\" />\n"));
    format!(
        "{}<ROOT>\n   <CONFIG>\n      <!-- Address of the computer that sends the rows -->\n      \
         <IP_NUMBER>192.168.1.10</IP_NUMBER>\n      \
         <PORT>49152</PORT>\n      <!-- The answer must begin with Sen Type=\"Armill\" -->\n      <SENTYPE>Armill</SENTYPE>\n      \
         <ONLYSEND>FALSE</ONLYSEND>\n   </CONFIG>\n   <!-- From the robot: actual and commanded position, late packets -->\n   \
         <SEND>\n      <ELEMENTS>\n{}         <ELEMENT TAG=\"DEF_Delay\" TYPE=\"LONG\" INDX=\"INTERNAL\" />\n      </ELEMENTS>\n   \
         </SEND>\n   <!-- To the robot: dx, dy, dz in mm, a, b, c in degrees; absolute, the last one held -->\n   <RECEIVE>\n      \
         <ELEMENTS>\n{received}      </ELEMENTS>\n   </RECEIVE>\n</ROOT>\n",
        remarks(said),
        sent.concat()
    )
}

/// Lines as comments of XML, where two hyphens would end one.
fn remarks(said: &[String]) -> String {
    said.iter().map(|line| format!("<!-- {} -->\n", line.replace("--", "- -"))).collect()
}

/// The answer to one packet of the robot: the row's correction with the packet's own number.
///
/// ```
/// use armill::export::superposed::{CorrectionRow, rsi::answer};
/// # use nalgebra::Vector3;
/// let row = CorrectionRow {
///     time: 0.0, arc_length: 0.0, shift: Vector3::new(1e-4, 0.0, -2e-4), turn: Vector3::zeros(), across: [0.0; 2],
/// };
/// assert!(answer(&row, 4208163634).starts_with(r#"<Sen Type="Armill"><RKorr X="0.1" Y="0.0" Z="-0.2""#));
/// ```
pub fn answer(row: &CorrectionRow, packet: u64) -> String {
    let values = row.shift.iter().map(|shift| shift / MM).chain(row.turn.iter().copied());
    let attributes: Vec<String> =
        PORTS.iter().zip(values).map(|(port, value)| format!("{port}=\"{}\"", number(value, 6))).collect();
    format!("<Sen Type=\"Armill\"><RKorr {} /><IPOC>{packet}</IPOC></Sen>", attributes.join(" "))
}
