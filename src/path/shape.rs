//! Shapes drawn without a program: circle, arc, line, rectangle, polyline. Lengths in m, angles in
//! rad.

use crate::math::{self, FRAC_PI_2, TAU};
use crate::path::Segment;
use nalgebra::Vector3;

/// An arc about `normal`, counter-clockwise for a positive `sweep`. Angles are measured from the
/// projection of +X into the plane (of +Y if the normal is X). A full circle has the sweep 2 pi.
pub fn arc(center: Vector3<f64>, radius: f64, normal: Vector3<f64>, start: f64, sweep: f64) -> Segment {
    let axis = normal.normalize();
    let zero = math::across(&axis, &Vector3::x(), &Vector3::y());
    let (sin, cos) = math::sin_cos(start);
    let side = axis.cross(&zero);
    let u = zero * cos + side * sin;
    let v = (side * cos - zero * sin) * if sweep < 0.0 { -1.0 } else { 1.0 };
    Segment::Arc { center, u, v, radius, sweep: sweep.abs(), rise: 0.0 }
}

/// A full circle, counter-clockwise about `normal`.
pub fn circle(center: Vector3<f64>, radius: f64, normal: Vector3<f64>) -> Segment {
    arc(center, radius, normal, 0.0, TAU)
}

/// Straight lines through the points in order.
pub fn polyline(points: &[Vector3<f64>]) -> Vec<Segment> {
    points.windows(2).map(|pair| Segment::Line { from: pair[0], to: pair[1] }).collect()
}

/// A rectangle in the XY plane, counter-clockwise seen from +Z, starting at the lower side. Corners
/// are rounded if `corner_radius` > 0.
pub fn rectangle(center: Vector3<f64>, width: f64, height: f64, corner_radius: f64) -> Vec<Segment> {
    let (half_x, half_y, r) = (width / 2.0, height / 2.0, corner_radius);
    let corner = |x: f64, y: f64| center + Vector3::new(x * (half_x - r), y * (half_y - r), 0.0);
    let corners = [corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0), corner(-1.0, -1.0)];
    let mut segments = Vec::with_capacity(8);
    let mut heading = Vector3::x();
    let mut from = corners[3] - Vector3::y() * r;
    for pivot in corners {
        let outward = heading.cross(&Vector3::z());
        let to = pivot + outward * r;
        segments.push(Segment::Line { from, to });
        segments.push(Segment::Arc {
            center: pivot,
            u: outward,
            v: heading,
            radius: r,
            sweep: FRAC_PI_2,
            rise: 0.0,
        });
        from = pivot + heading * r;
        heading = -outward;
    }
    segments
}
