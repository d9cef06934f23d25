//! From the job's tool, material and cutting to the cut in SI.

use crate::cutting::material::{self, Material, Model};
use crate::cutting::{Bending, ChipLoad, Coefficients, Cut, Engagement, Hand, Kienzle, Loading};
use crate::error::Error;
use crate::job::{self, Choice, Coupling, Engaged, HelixHand, Job, Line, ToolBending};
use crate::setup::learned;
use crate::stock::{Contacts, Cutter, Holder};
use crate::units::{DEG, GPA, MM, RPM};
use std::f64::consts::PI;

/// The material, and how its coefficients were derived.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResolvedMaterial {
    /// The material in the library, if it is one.
    pub material: Option<&'static Material>,
    /// The cutting force model with its numbers.
    pub model: Model,
    /// The chip thickness for which the coefficients were derived [m], if they depend on it.
    pub chip: Option<f64>,
}

/// Young's modulus of carbide [GPa]: 550 to 650 by grade; high-speed steel has 210.
const CARBIDE: f64 = 600.0;
/// Chips thinner than this are below the range of any table [m].
const THINNEST: f64 = 0.001 * MM;

/// What the load of the cut depends on along the path.
pub(super) fn loading(job: &Job, cut: &Cut) -> Loading {
    let (flutes, spindle) = (f64::from(job.tool.flutes), job.cutting.spindle_rpm * RPM);
    let chip = match job.cutting.feed_per_tooth_mm {
        Choice::Value(c, _) => ChipLoad::Stated(c * MM),
        Choice::Word => ChipLoad::FromFeed { flutes, spindle },
    };
    Loading { chip, feed: job.motion.feed_mm_s * MM, run_in: cut.run_in() }
}

/// Corner radius of the tool [mm].
fn corner_radius(tool: &job::Tool) -> Result<f64, Error> {
    let corner_radius = match tool.corner_radius_mm {
        None => 0.0,
        Some(Choice::Word) => tool.diameter_mm / 2.0,
        Some(Choice::Value(radius, _)) => radius,
    };
    at_most("tool.corner_radius_mm", corner_radius, tool.diameter_mm / 2.0)?;
    Ok(corner_radius)
}

/// The tool as far as it clears material.
pub(super) fn cutter(tool: &job::Tool) -> Result<Cutter, Error> {
    let corner = corner_radius(tool)? * MM;
    let flutes = tool.flute_length_mm.or(tool.stickout_mm).map_or(f64::INFINITY, |length| length * MM);
    Ok(Cutter { radius: tool.diameter_mm / 2.0 * MM, corner, flutes })
}

/// The holder, if its diameter is known.
pub(super) fn holder(tool: &job::Tool) -> Result<Option<Holder>, Error> {
    let Some(diameter) = tool.holder_diameter_mm.and_then(|given| given.number()) else { return Ok(None) };
    let height = tool.stickout_mm.ok_or_else(|| {
        Error::missing(
            "tool.stickout_mm",
            "needed with a holder diameter: how far above the tip the holder begins",
        )
    })?;
    Ok(Some(Holder { radius: diameter / 2.0 * MM, height: height * MM }))
}

/// Least and largest chip thickness of the tool [m], as far as they are known.
pub(super) fn chip_limits(tool: &job::Tool) -> Result<[Option<f64>; 2], Error> {
    let [least, most] = [tool.min_chip_mm, tool.max_chip_mm].map(|given| given?.number());
    if let (Some(least), Some(most)) = (least, most)
        && least > most
    {
        return Err(Error::invalid("tool.min_chip_mm", least, format!("at most max_chip_mm = {most}")));
    }
    Ok([least, most].map(|limit| limit.map(|limit| limit * MM)))
}

/// The cut and its material. In a stock, its depth is the largest along the path.
pub(super) fn cut(job: &Job, contacts: Option<&Contacts>) -> Result<(Cut, ResolvedMaterial), Error> {
    let tool = &job.tool;
    let corner_radius = corner_radius(tool)?;
    let cut = Cut {
        diameter: tool.diameter_mm * MM,
        flutes: tool.flutes,
        helix: tool.helix_deg * DEG,
        hand: match tool.hand.unwrap_or_default() {
            HelixHand::Right => Hand::Right,
            HelixHand::Left => Hand::Left,
        },
        corner_radius: corner_radius * MM,
        runout: tool.runout_mm.unwrap_or(0.0) * MM,
        coefficients: Coefficients::default(),
        axial_depth: match contacts {
            None => job.cutting.axial_depth_mm * MM,
            Some(contacts) => contacts.deepest(),
        },
        engagement: match contacts {
            None => engagement(job)?,
            Some(_) => Engagement::Slot,
        },
    };
    let (material, model) = material_model(&job.material)?;
    let chip = model.needs_chip().then(|| chip_thickness(job, &cut, contacts)).transpose()?;
    let rake = tool.rake_deg.unwrap_or(0.0) * DEG;
    let h0 = chip.unwrap_or(0.0);
    let coefficients = match &model {
        Model::Linear(coefficients) => *coefficients,
        Model::Kienzle(kienzle) => kienzle.linear(h0, rake),
        Model::Orthogonal(orthogonal) => {
            let speed = PI * cut.diameter * job.cutting.spindle_rpm * RPM;
            orthogonal.linear(h0, speed, rake, cut.helix)
        }
    };
    let coefficients = match &job.learned {
        Some(learned) => learned::coefficients(&coefficients, &learned.force_factors),
        None => coefficients,
    };
    Ok((Cut { coefficients, ..cut }, ResolvedMaterial { material, model, chip }))
}

/// The engagement of the teeth.
fn engagement(job: &Job) -> Result<Engagement, Error> {
    let cutting = &job.cutting;
    let Some(engaged) = cutting.engagement else {
        return match cutting.radial_depth_mm {
            Some(_) => {
                Err(Error::missing("cutting.engagement", "climb or conventional, with a radial depth"))
            }
            None => angles(cutting),
        };
    };
    let depth = || {
        let depth = cutting.radial_depth_mm.ok_or_else(|| {
            Error::missing("cutting.radial_depth_mm", "how far the tool reaches into the part")
        })?;
        at_most("cutting.radial_depth_mm", depth, job.tool.diameter_mm)?;
        Ok(depth * MM)
    };
    match engaged {
        Engaged::Angles => angles(cutting),
        Engaged::Climb => depth().map(Engagement::Climb),
        Engaged::Conventional => depth().map(Engagement::Conventional),
        // A stock that the path does not allow to be followed: the stated engagement holds.
        Engaged::FromStock => angles(cutting),
        Engaged::Slot => Ok(Engagement::Slot),
    }
}

/// Engagement by entry and exit.
fn angles(cutting: &job::Cutting) -> Result<Engagement, Error> {
    let (entry, exit) = (cutting.entry_deg, cutting.exit_deg);
    if entry >= exit {
        let expected = format!("a tooth leaves after it enters: it must be more than entry_deg = {entry}");
        return Err(Error::invalid("cutting.exit_deg", exit, expected));
    }
    Ok(Engagement::Angles { entry: entry * DEG, exit: exit * DEG })
}

/// The material's model, and the material in the library if it is one.
fn material_model(given: &job::Material) -> Result<(Option<&'static Material>, Model), Error> {
    let numbers =
        [given.ktc_n_mm2, given.krc_n_mm2, given.kac_n_mm2, given.kte_n_mm, given.kre_n_mm, given.kae_n_mm];
    let kienzle = [given.kc11_n_mm2, given.mc];
    let (linear_given, kienzle_given) =
        (numbers.iter().any(Option::is_some), kienzle.iter().any(Option::is_some));
    let one_of =
        |field| Err(Error::invalid(field, "given together with other coefficients", "give one of the two"));
    let (material, model) = match &given.preset {
        Some(_) if linear_given || kienzle_given => return one_of("material.preset"),
        Some(id) => match material::library().iter().find(|material| material.id == id) {
            Some(preset) => (Some(preset), preset.model),
            None => {
                let known = material::library().iter().map(|material| material.id);
                return Err(Error::unknown_name("material.preset", id, "the library has", known));
            }
        },
        None if linear_given && kienzle_given => return one_of("material.kc11_n_mm2"),
        None if kienzle_given => {
            let [kc11, mc] = kienzle;
            let kc11 = kc11.ok_or_else(|| Error::missing("material.kc11_n_mm2", "to go with mc"))?;
            let mc = mc.ok_or_else(|| Error::missing("material.mc", "to go with kc11_n_mm2"))?;
            (None, Model::Kienzle(Kienzle::of_table(kc11, mc)))
        }
        None => {
            for (value, key) in numbers.iter().zip(["ktc_n_mm2", "krc_n_mm2", "kac_n_mm2"]) {
                value.ok_or_else(|| {
                    let other = "name a preset, or give ktc, krc and kac, or kc11_n_mm2 and mc";
                    Error::missing(format!("material.{key}"), other)
                })?;
            }
            let numbers = numbers.map(|value| value.unwrap_or(0.0));
            (None, Model::Linear(Coefficients::of_table(numbers)))
        }
    };
    let ratios = given.radial_ratio.or(given.axial_ratio).is_some() || given.line.is_some();
    match model {
        Model::Kienzle(kienzle) => {
            let radial = given.radial_ratio.unwrap_or(kienzle.radial);
            let axial = given.axial_ratio.unwrap_or(kienzle.axial);
            let secant = given.line == Some(Line::Secant);
            Ok((material, Model::Kienzle(Kienzle { radial, axial, secant, ..kienzle })))
        }
        _ if ratios => Err(Error::invalid(
            "material.radial_ratio",
            "given",
            "radial_ratio, axial_ratio and line belong to kc1.1 and mc",
        )),
        _ => Ok((material, model)),
    }
}

/// The chip thickness for which the coefficients are derived [m].
fn chip_thickness(job: &Job, cut: &Cut, contacts: Option<&Contacts>) -> Result<f64, Error> {
    if let Some(Choice::Value(given, _)) = job.material.chip_thickness_mm {
        return Ok(given * MM);
    }
    let feed = loading(job, cut).feed_per_tooth();
    let mean = match contacts {
        // Without axial depth, the lowest micrometre of the edge stands in for it.
        None => Cut { axial_depth: cut.axial_depth.max(THINNEST), ..*cut }.mean_chip(feed),
        // Where all is air, no force depends on it.
        Some(contacts) => feed * cut.mean_chip_along(contacts).unwrap_or(1.0),
    };
    if mean >= THINNEST {
        return Ok(mean);
    }
    let expected = format!(
        "the mean chip of {:.6} mm is thinner than the table's range: give a thickness of at least {} mm",
        mean / MM,
        THINNEST / MM
    );
    Err(Error::missing("material.chip_thickness_mm", expected))
}

/// Whether the force follows the deflection: by default where the engagement follows from a stock.
pub(super) fn follows_deflection(job: &Job, in_stock: bool) -> Result<bool, Error> {
    let why = "only a stock shows how the force changes as the tool is pushed away";
    match (job.cutting.coupling, job.cutting.engagement) {
        (Some(Coupling::Deflection), _) if job.stock.is_none() => {
            Err(Error::missing("stock.kind", format!("{why}: box, cylinder, extents, outline or stl")))
        }
        (Some(Coupling::Deflection), Some(engaged)) if engaged != Engaged::FromStock => {
            Err(Error::invalid("cutting.engagement", engaged.word(), format!("from-stock; {why}")))
        }
        (Some(Coupling::None), _) => Ok(false),
        // Along a tilted axis the stock is not followed, which has its own remark.
        _ => Ok(in_stock),
    }
}

/// The tool's bending model, if it bends.
pub(super) fn bending(tool: &job::Tool) -> Result<Option<Bending>, Error> {
    match (tool.bending, tool.stickout_mm) {
        (None, Some(_)) if tool.holder_diameter_mm.is_none() => {
            Err(Error::missing("tool.bending", "cantilever, with a stickout"))
        }
        (None | Some(ToolBending::Rigid), _) => Ok(None),
        (Some(ToolBending::Cantilever), None) => {
            Err(Error::missing("tool.stickout_mm", "the length out of the holder"))
        }
        (Some(ToolBending::Cantilever), Some(length)) => {
            let fluted = tool.flute_length_mm.unwrap_or(length);
            let shank = tool.shank_diameter_mm.unwrap_or(tool.diameter_mm);
            let modulus = tool.modulus_gpa.unwrap_or(CARBIDE) * GPA;
            Ok(Some(Bending::of(modulus, length * MM, fluted * MM, tool.diameter_mm * MM, shank * MM)))
        }
    }
}

fn at_most(field: &str, value: f64, max: f64) -> Result<(), Error> {
    if value <= max {
        return Ok(());
    }
    Err(Error::OutOfRange { field: field.into(), value, min: 0.0, max, unit: "mm" })
}
