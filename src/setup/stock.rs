//! From the job's stock to the solid in SI, and where the tool is in it along the path.

use crate::error::Error;
use crate::job::fields;
use crate::job::{self, Engaged, Job, StockKind};
use crate::path::{MovePace, Path};
use crate::progress::Progress;
use crate::stock::{Contacts, Cutter, Outline, Solid, contacts};
use crate::units::MM;
use nalgebra::{Vector2, Vector3};

/// Where the engagement comes from.
pub(super) enum StockEngagement {
    /// The job states it.
    Stated,
    /// The job states it, for a stock cannot be followed: the tool axis is not the workpiece's z axis.
    Tilted,
    /// What the tool meets in the stock.
    Followed(Contacts),
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
                "the engagement is to follow from the stock: box, cylinder, extents or outline",
            ));
        }
        engagement => !job.stock.is_none() && matches!(engagement, None | Some(Engaged::FromStock)),
    };
    // Invalid numbers are refused even if they are not used.
    let solid = solid(job, path)?;
    Ok(match solid.filter(|_| from_stock) {
        None => StockEngagement::Stated,
        Some(_) if !is_upright(path) => StockEngagement::Tilted,
        Some(solid) => StockEngagement::Followed(contacts(path, &solid, cutter, progress)),
    })
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
            Solid { outline, bottom: center[2] * MM, top: (center[2] + height) * MM }
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
            Solid { outline, bottom: bottom * MM, top: top * MM }
        }
        StockKind::Extents => extents(job, path)?,
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
    Ok(Solid { outline: Outline::rectangle(corner(from), corner(to)), bottom: from[2] * MM, top: to[2] * MM })
}

/// A box around the tool's axis on the moves that cut.
fn extents(job: &Job, path: &Path) -> Result<Solid, Error> {
    let allowance = job.stock.allowance_mm.unwrap_or(job.tool.diameter_mm) * MM;
    let points = path
        .moves()
        .iter()
        .filter(|step| step.pace != MovePace::Rapid)
        .flat_map(|step| step.segment.extremes().into_iter().map(|s| step.segment.point(s)));
    let bounds = points.fold(None, |bounds: Option<(Vector3<f64>, Vector3<f64>)>, point| {
        Some(bounds.map_or((point, point), |(low, high)| (low.inf(&point), high.sup(&point))))
    });
    let Some((low, high)) = bounds else {
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
    Ok(Solid { outline, bottom: low.z - allowance.max(0.0), top })
}

fn need<T>(value: Option<T>, key: &str) -> Result<T, Error> {
    value.ok_or_else(|| Error::missing(format!("stock.{key}"), "this kind of stock needs it"))
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
