//! The libraries as the page's form offers them, with the source of their numbers.

use crate::cutting::material::{self, Model};
use crate::job::fields;
use crate::robot::Elbow;
use crate::robot::library;
use crate::units::{N_PER_MM, N_PER_MM2};
use serde_json::{Value, json};

/// Robots and materials, each with its values under the keys of a job.
pub fn presets() -> Value {
    let robots = library::robots().map(|robot| {
        json!({
            "id": robot.id, "name": robot.name(), "maker": robot.maker,
            "note": format!("{} {}", robot.geometry_note, robot.mode_note),
            "stiffness_note": robot.stiffness_note, "stiffness_assumed": robot.stiffness_assumed,
            "modified_dh": fields::dh_rows(&robot), "opw": fields::opw(&robot),
            "joint_3": if robot.elbow == Elbow::Serial { "serial" } else { "pendant" },
            "joint_limits_deg": robot.joint_limits_deg,
            "joint_compliance_rad_per_nm": robot.joint_compliance,
        })
    });
    let materials = material::library().iter().map(|material| {
        let mut preset = json!({ "id": material.id, "name": material.name, "note": material.note() });
        // Back from SI: without the last bits, which the table does not have.
        let mut put = |key: &str, value: f64| preset[key] = ((value * 1e9).round() / 1e9).into();
        match &material.model {
            Model::Linear(k) => {
                for (key, value) in [("ktc_n_mm2", k.ktc), ("krc_n_mm2", k.krc), ("kac_n_mm2", k.kac)] {
                    put(key, value / N_PER_MM2);
                }
                for (key, value) in [("kte_n_mm", k.kte), ("kre_n_mm", k.kre), ("kae_n_mm", k.kae)] {
                    put(key, value / N_PER_MM);
                }
            }
            Model::Kienzle(kienzle) => {
                put("kc11_n_mm2", kienzle.kc11 / N_PER_MM2);
                put("mc", kienzle.mc);
            }
            Model::Orthogonal(_) => preset["orthogonal"] = true.into(),
        }
        preset
    });
    json!({ "robots": robots.collect::<Vec<_>>(), "materials": materials.collect::<Vec<_>>() })
}
