//! From the job's stock to the solid in SI, and where the tool is in it along the path.

use crate::error::Error;
use crate::job::fields;
use crate::job::{self, EarlierProgram, Engaged, Job, StockKind};
use crate::path::{MovePace, Path};
use crate::progress::Progress;
use crate::setup::{cutting, path};
use crate::stock::{Blank, Contacts, Cutter, Earlier, Outline, Solid, contacts, with_holder};
use crate::units::MM;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use nalgebra::{Vector2, Vector3};
use std::io::Cursor;
use std::sync::Arc;

/// Most triangles of a mesh.
const MOST_TRIANGLES: usize = 2_000_000;
/// Most moves of a path that is given a stock unasked: following more of them takes minutes where they
/// are dense.
const MOST_MOVES: usize = 200_000;
/// Farthest corner of a mesh along an axis [m].
const FARTHEST: f64 = 20.0;

/// Where the engagement comes from.
pub(super) enum StockEngagement {
    /// The job states it.
    Stated,
    /// The job states it, for a stock cannot be followed: the tool axis is not the workpiece's z axis.
    Tilted,
    /// What the tool meets in the stock, the stock, and the same in words.
    Followed(Contacts, Arc<Blank>, String),
}

/// The engagement along a path in the workpiece frame.
pub(super) fn engagement(
    job: &Job,
    path: &Path,
    cutter: &Cutter,
    progress: &mut Progress,
) -> Result<StockEngagement, Error> {
    fields::check_stock_keys(job)?;
    let from_stock = match job.cutting.engagement {
        Some(Engaged::FromStock) if job.stock.is_none() => {
            return Err(Error::missing(
                "stock.kind",
                "the engagement is to come from the stock: give a box, cylinder, extents, outline or stl",
            ));
        }
        engagement => !job.stock.is_none() && matches!(engagement, None | Some(Engaged::FromStock)),
    };
    // Invalid numbers are refused even if they are not used.
    let holder = cutting::holder(&job.tool)?;
    let solid = solid(job, path)?;
    let earlier = earlier(job)?;
    if job.stock.is_none() && !earlier.is_empty() {
        let expected = "what the earlier programs cut: give a box, cylinder, extents, outline or stl";
        return Err(Error::missing("stock.kind", expected));
    }
    Ok(match solid.filter(|_| from_stock) {
        None => StockEngagement::Stated,
        Some(_) if !is_upright(path) => StockEngagement::Tilted,
        Some(solid) => {
            let words = in_words(&job.stock, &solid);
            let contacts = contacts(path, (&solid, &earlier), cutter, progress);
            let contacts = match holder {
                Some(holder) => with_holder(contacts, path, (&solid, &earlier), (cutter, &holder)),
                None => contacts,
            };
            StockEngagement::Followed(contacts, Arc::new(Blank { solid, earlier }), words)
        }
    })
}

/// The programs that cut the stock before.
fn earlier(job: &Job) -> Result<Vec<Earlier>, Error> {
    let read = |(number, given): (usize, &EarlierProgram)| {
        let field = format!("stock.earlier[{number}]");
        let path = path::earlier(job, &given.text, &format!("{field}.text"))?;
        if !is_upright(&path) {
            return Err(Error::invalid(
                format!("{field}.text"),
                "a tool axis that is not z",
                "a program with three axes",
            ));
        }
        let (diameter, corner) = (given.diameter_mm, given.corner_radius_mm.unwrap_or(0.0));
        in_range(&format!("{field}.diameter_mm"), diameter, (0.1, 500.0))?;
        in_range(&format!("{field}.corner_radius_mm"), corner, (0.0, diameter / 2.0))?;
        let cutter = Cutter { radius: diameter / 2.0 * MM, corner: corner * MM, flutes: f64::INFINITY };
        Ok(Earlier { path, cutter })
    };
    job.stock.earlier.iter().flatten().enumerate().map(read).collect()
}

/// The solid under an STL mesh.
fn mesh(text: &str) -> Result<Solid, Error> {
    let invalid = |found: String| {
        Error::invalid(
            "stock.stl",
            found,
            "the text of an STL file in millimetres, or a binary one in base64",
        )
    };
    let bytes = match text.trim_start() {
        ascii if ascii.starts_with("solid") => ascii.as_bytes().to_vec(),
        base64 => {
            let plain: String = base64.split_whitespace().collect();
            STANDARD.decode(plain).map_err(|error| invalid(format!("neither text nor base64 ({error})")))?
        }
    };
    let mut bytes = Cursor::new(bytes);
    let triangles = stl_io::create_stl_reader(&mut bytes).map_err(|error| invalid(error.to_string()))?;
    let corner = |corner: stl_io::Vertex| Vector3::new(corner[0], corner[1], corner[2]).map(f64::from) * MM;
    let mut relief = Vec::new();
    for triangle in triangles {
        let triangle = triangle.map_err(|error| invalid(error.to_string()))?;
        relief.push(triangle.vertices.map(corner));
        if relief.len() > MOST_TRIANGLES {
            let most = crate::error::grouped(MOST_TRIANGLES as f64);
            return Err(invalid(format!("more than {most} triangles")));
        }
    }
    let count = relief.len();
    if relief.iter().flatten().any(|corner| corner.iter().any(|x| x.is_nan() || x.abs() > FARTHEST)) {
        return Err(invalid("a corner that is not within 20 m".into()));
    }
    Solid::under(relief).ok_or_else(|| invalid(format!("{count} triangles without a volume")))
}

/// Whether the tool axis is z all along a path.
fn is_upright(path: &Path) -> bool {
    let upright = |axis: &Vector3<f64>| (axis - Vector3::z()).norm() < 1e-9;
    path.moves().iter().all(|step| upright(&step.axis_from) && upright(&step.axis_to))
}

/// The solid, if the job has one.
fn solid(job: &Job, path: &Path) -> Result<Option<Solid>, Error> {
    let given = &job.stock;
    let solid = match given.kind {
        StockKind::None => return Ok(None),
        StockKind::Box => block(given)?,
        StockKind::Cylinder => {
            let center = need(given.center_mm, "center_mm")?;
            let radius = positive(need(given.radius_mm, "radius_mm")?, "radius_mm")?;
            let height = positive(need(given.height_mm, "height_mm")?, "height_mm")?;
            let outline =
                Outline::Circle { center: Vector2::new(center[0], center[1]) * MM, radius: radius * MM };
            Solid::prism(outline, center[2] * MM, (center[2] + height) * MM)
        }
        StockKind::Outline => {
            let points = need(given.points_mm.as_ref(), "points_mm")?;
            let (bottom, top) = (need(given.bottom_mm, "bottom_mm")?, need(given.top_mm, "top_mm")?);
            above(bottom, top, "top_mm")?;
            let outline = Outline::Polygon(points.iter().map(|&point| Vector2::from(point) * MM).collect());
            if outline.area() < 1e-12 {
                let expected = "three corners or more around an area";
                return Err(Error::invalid(
                    "stock.points_mm",
                    format!("{} corners without area", points.len()),
                    expected,
                ));
            }
            Solid::prism(outline, bottom * MM, top * MM)
        }
        StockKind::Extents => extents(job, path)?,
        StockKind::Stl => mesh(need(given.stl.as_ref(), "stl")?)?,
    };
    Ok(Some(solid))
}

/// A box.
fn block(given: &job::Stock) -> Result<Solid, Error> {
    let (from, to) = (need(given.from_mm, "from_mm")?, need(given.to_mm, "to_mm")?);
    for axis in 0..3 {
        if to[axis] <= from[axis] {
            let expected = format!("more than from_mm's {}, along each axis", from[axis]);
            return Err(Error::invalid(format!("stock.to_mm[{axis}]"), to[axis], expected));
        }
    }
    let corner = |point: [f64; 3]| Vector2::new(point[0], point[1]) * MM;
    Ok(Solid::prism(Outline::rectangle(corner(from), corner(to)), from[2] * MM, to[2] * MM))
}

/// The stock that a job may give its path if it knows none: the extents of the program, up to the
/// highest place that it cuts at if none of it is below zero. Of a path at one height, the job's axial
/// depth is taken. `None` where a stock cannot be followed, nothing cuts, or the path has more than
/// 200,000 moves.
///
/// # Errors
/// If the path cannot be read.
pub fn proposed(job: &Job) -> Result<Option<job::Stock>, Error> {
    let (path, _) = path::desired(job, &mut Progress::none())?;
    let follows = is_upright(&path) && path.moves().len() <= MOST_MOVES;
    let Some((low, high)) = bounds_of_cuts(&path).filter(|_| follows) else { return Ok(None) };
    let level = high.z - low.z < 1e-9;
    let top = if level { low.z + job.cutting.axial_depth_mm * MM } else { high.z };
    if top <= low.z {
        return Ok(None);
    }
    // To a nanometre, as a person would type it.
    let top_mm = (low.z >= 0.0).then(|| (top / MM * 1e6).round() / 1e6);
    Ok(Some(job::Stock { kind: StockKind::Extents, top_mm, ..job::Stock::default() }))
}

/// The smallest and largest coordinates of the moves that cut [m]; `None` if none does.
pub(crate) fn bounds_of_cuts(path: &Path) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let points = path
        .moves()
        .iter()
        .filter(|step| step.pace != MovePace::Rapid)
        .flat_map(|step| step.segment.extremes().into_iter().map(|s| step.segment.point(s)));
    points.fold(None, |bounds: Option<(Vector3<f64>, Vector3<f64>)>, point| {
        Some(bounds.map_or((point, point), |(low, high)| (low.inf(&point), high.sup(&point))))
    })
}

/// A box around the tool's axis on the moves that cut.
fn extents(job: &Job, path: &Path) -> Result<Solid, Error> {
    let allowance = job.stock.allowance_mm.unwrap_or(job.tool.diameter_mm) * MM;
    let Some((low, high)) = bounds_of_cuts(path) else {
        return Err(Error::invalid("stock.kind", "extents", "a program with a move that cuts"));
    };
    let top = match job.stock.top_mm {
        Some(top) => above(low.z / MM, top, "top_mm").map(|()| top * MM)?,
        None if low.z < 0.0 => 0.0,
        None => {
            let expected =
                format!("the program's lowest cut is at {} mm: the height of the stock's top", low.z / MM);
            return Err(Error::missing("stock.top_mm", expected));
        }
    };
    let beyond = Vector2::repeat(allowance);
    let outline = Outline::rectangle(low.xy() - beyond, high.xy() + beyond);
    if high.x - low.x + 2.0 * allowance <= 0.0 || high.y - low.y + 2.0 * allowance <= 0.0 {
        return Err(Error::invalid("stock.allowance_mm", allowance / MM, "a box that is not empty"));
    }
    Ok(Solid::prism(outline, low.z - allowance.max(0.0), top))
}

/// A stock in words: kind, size across and heights.
fn in_words(given: &job::Stock, solid: &Solid) -> String {
    // To a thousandth of a millimetre, without a sign of zero.
    let mm = |length: f64| (length / MM * 1e3).round() / 1e3 + 0.0;
    let across = match &solid.outline {
        Outline::Circle { radius, .. } => format!("diameter {}", mm(2.0 * radius)),
        Outline::Polygon(corners) if given.kind == StockKind::Outline => format!("{} corners", corners.len()),
        Outline::Polygon(corners) => {
            let size = corners[2] - corners[0];
            format!("{} × {}", mm(size.x), mm(size.y))
        }
    };
    let kind = match given.kind {
        StockKind::None => "none",
        StockKind::Box => "box",
        StockKind::Cylinder => "cylinder",
        StockKind::Extents => "box around the program",
        StockKind::Outline => "outline",
        StockKind::Stl => "mesh",
    };
    let earlier = match given.earlier.as_ref().map_or(0, Vec::len) {
        0 => "",
        1 => ", cut by an earlier program",
        _ => ", cut by earlier programs",
    };
    format!("{kind}, {across}, Z {} to {} mm{earlier}", mm(solid.bottom), mm(solid.top))
}

fn need<T>(value: Option<T>, key: &str) -> Result<T, Error> {
    value.ok_or_else(|| Error::missing(format!("stock.{key}"), "this kind of stock needs it"))
}

fn in_range(field: &str, value: f64, (min, max): (f64, f64)) -> Result<(), Error> {
    if (min..=max).contains(&value) {
        return Ok(());
    }
    Err(Error::OutOfRange { field: field.into(), value, min, max, unit: "mm" })
}

fn positive(value: f64, key: &str) -> Result<f64, Error> {
    above(0.0, value, key).map(|()| value)
}

fn above(low: f64, value: f64, key: &str) -> Result<(), Error> {
    if value > low {
        return Ok(());
    }
    Err(Error::invalid(format!("stock.{key}"), value, format!("more than {low} mm")))
}
