//! The job's path: its keys, and the way from there to a path in SI.

use crate::error::Error;
use crate::job::choice::choice;
use crate::job::json::keys;
use crate::job::setup::{invalid, missing};
use crate::job::{Job, fields};
use crate::path::{self, Listing, shape};
use crate::units::{DEG, MM};
use nalgebra::Vector3;
use serde::Serialize;

choice! {
    /// What the path is made from.
    PathKind {
        #[default]
        /** Full circle. */ Circle = "circle",
        /** Part of a circle. */ Arc = "arc",
        /** One straight line. */ Line = "line",
        /** Rectangle with sharp or rounded corners. */ Rectangle = "rectangle",
        /** Straight lines through points. */ Polyline = "polyline",
        /** Straight lines through pasted rows of x, y, z, with tool axis and feed where they are given. */ Csv = "csv",
        /** A G-code program. */ Gcode = "gcode",
        /** An APT or CLDATA program. */ Apt = "apt",
    }
}
choice! {
    /// Unit of length of a text that does not say its own.
    Unit { #[default] /** Millimetres. */ Mm = "mm", /** Inches. */ Inch = "inch" }
}

choice! {
    /// Unit of the feeds in a text that does not say its own.
    FeedUnit {
        #[default]
        /** Millimetres a second. */ MmPerS = "mm/s",
        /** Millimetres a minute. */ MmPerMin = "mm/min",
        /** Inches a minute. */ InchPerMin = "inch/min",
    }
}

/// The desired path in the workpiece frame; which keys belong to it depends on `kind`.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Path {
    /// What it is made from.
    pub kind: PathKind,
    /// Centre of a circle, an arc or a rectangle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center_mm: Option<[f64; 3]>,
    /// Radius of a circle or an arc.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_mm: Option<f64>,
    /// Normal of a circle or an arc, of any length; default +Z.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal: Option<[f64; 3]>,
    /// Start of an arc, from the projection of +X.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_deg: Option<f64>,
    /// Sweep of an arc, counter-clockwise about the normal if positive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sweep_deg: Option<f64>,
    /// Start of a line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from_mm: Option<[f64; 3]>,
    /// End of a line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_mm: Option<[f64; 3]>,
    /// Size of a rectangle along X.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width_mm: Option<f64>,
    /// Size of a rectangle along Y.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_mm: Option<f64>,
    /// Radius of a rectangle's corners; default 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner_radius_mm: Option<f64>,
    /// Points of a polyline.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points_mm: Option<Vec<[f64; 3]>>,
    /// Text of a program, or pasted rows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub text: Option<String>,
    /// Unit of length of rows, or of an APT text, that do not say their own; default mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// Unit of the feeds of rows that do not say their own; default mm/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub feed_unit: Option<FeedUnit>,
    /// Tool length offsets of a G-code program: rows of the number H and the offset.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tool_length_offsets_mm: Option<Vec<(u32, f64)>>,
    /// Work offsets of a G-code program: G54, G55 and so on, in this order.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub work_offsets_mm: Option<Vec<[f64; 3]>>,
    /// Whether lines of a G-code program that start with a slash are left out; default true.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub block_delete: Option<bool>,
}

keys!(new Path { kind, center_mm, radius_mm, normal, start_deg, sweep_deg, from_mm, to_mm, width_mm, height_mm, corner_radius_mm, points_mm, text, unit, feed_unit, tool_length_offsets_mm, work_offsets_mm, block_delete } required kind);

impl Path {
    /// A path of a kind, with none of its keys.
    pub fn of(kind: PathKind) -> Self {
        Self { kind, ..Self::default() }
    }
}

/// JSON path of the text of a program.
pub(super) const TEXT: &str = "path.text";

impl Job {
    /// The desired path in the workpiece frame, with the program it was read from, if it was.
    /// `on_read` hears which share of the program is read.
    pub(super) fn desired_path(
        &self,
        on_read: impl FnMut(f64),
    ) -> Result<(path::Path, Option<Listing>), Error> {
        fields::check_path_keys(self)?;
        let kind = self.path.kind;
        let language = match kind {
            PathKind::Csv => "csv",
            PathKind::Gcode => "gcode",
            PathKind::Apt => "apt",
            _ => return self.shape().map(|path| (path, None)),
        };
        let text = self.path.text.as_ref().ok_or_else(|| need("text"))?;
        let program = self.program(kind, text, on_read)?;
        let path = path::Path::of_program(&program).ok_or_else(|| {
            invalid(TEXT, "a text without a move", "two positions or more that are not all the same")
        })?;
        Ok((path, Some(Listing { language, text: text.clone(), program })))
    }

    /// A path drawn from a shape.
    fn shape(&self) -> Result<path::Path, Error> {
        let given = &self.path;
        let vector = |value: Option<[f64; 3]>, key: &str| {
            value.ok_or_else(|| need(key)).map(|v| Vector3::from(v) * MM)
        };
        let length = |value: Option<f64>, key: &str| value.ok_or_else(|| need(key)).map(|v| v * MM);
        let normal = Vector3::from(given.normal.unwrap_or([0.0, 0.0, 1.0]));
        if normal.norm() < 1e-9 {
            return Err(invalid("path.normal", "(0, 0, 0)", "a direction; its length does not matter"));
        }
        let segments = match given.kind {
            PathKind::Circle => {
                let center = vector(given.center_mm, "center_mm")?;
                vec![shape::circle(center, length(given.radius_mm, "radius_mm")?, normal)]
            }
            PathKind::Arc => {
                let center = vector(given.center_mm, "center_mm")?;
                let sweep = given.sweep_deg.ok_or_else(|| need("sweep_deg"))? * DEG;
                let start = given.start_deg.unwrap_or(0.0) * DEG;
                vec![shape::arc(center, length(given.radius_mm, "radius_mm")?, normal, start, sweep)]
            }
            PathKind::Line => {
                shape::polyline(&[vector(given.from_mm, "from_mm")?, vector(given.to_mm, "to_mm")?])
            }
            PathKind::Rectangle => {
                let (width, height) =
                    (length(given.width_mm, "width_mm")?, length(given.height_mm, "height_mm")?);
                let radius = given.corner_radius_mm.unwrap_or(0.0) * MM;
                let largest = width.min(height) / 2.0;
                if radius > largest {
                    let (value, max) = (radius / MM, largest / MM);
                    let field = "path.corner_radius_mm".into();
                    return Err(Error::OutOfRange { field, value, min: 0.0, max, unit: "mm" });
                }
                shape::rectangle(vector(given.center_mm, "center_mm")?, width, height, radius)
            }
            _ => {
                let points = given.points_mm.as_ref().ok_or_else(|| need("points_mm"))?;
                let points: Vec<_> = points.iter().map(|point| Vector3::from(*point) * MM).collect();
                shape::polyline(&points)
            }
        };
        path::Path::new(segments).ok_or_else(|| {
            let (field, expected) = match given.kind {
                PathKind::Polyline => ("path.points_mm", "two points or more that are not all the same"),
                PathKind::Line => ("path.to_mm", "another point than from_mm"),
                _ => ("path.sweep_deg", "a sweep that is not zero"),
            };
            invalid(field, "a path without length", expected)
        })
    }
}

fn need(key: &str) -> Error {
    missing(&format!("path.{key}"), "this kind of path needs it")
}
