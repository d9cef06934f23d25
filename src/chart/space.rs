//! Paths in space: an orthographic view, equally scaled in all directions, in a box with a floor
//! and axes.

use plotters::style::text_anchor::{HPos, VPos};

use super::chart::{Axis, AxisInfo, Caption, Chart, ChartOptions, Legend, PlotArea};
use super::frame::{TOP, equal_aspect, size, valid, window};
use super::scale::{Tick, extent, linear_ticks, widened};
use super::svg::{Canvas, FONT_SIZE, Layer, text_width};
use super::trace::{SheetPoint, lines};
use crate::math;
use crate::units::DEG;

/// One path in space.
#[derive(Clone, Copy, Debug)]
pub struct SpaceSeries<'a> {
    /// Stable name.
    pub key: &'a str,
    /// Text of the legend.
    pub label: &'a str,
    /// How it looks: a class of the page's style sheet.
    pub class: &'static str,
    /// x, y and z in the displayed unit; a point that is not finite leaves a gap.
    pub points: &'a [[f64; 3]],
}

/// Direction of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Direction towards the reader about z, from x to y [deg].
    pub azimuth_deg: f64,
    /// Height above the horizon [deg].
    pub elevation_deg: f64,
}

impl Default for View {
    /// From the front right and above: x runs to the right, y away, z up.
    fn default() -> Self {
        Self { azimuth_deg: -60.0, elevation_deg: 25.0 }
    }
}

/// Room at the sides for labels [SVG units].
const SIDE: f64 = 44.0;
/// Room below for labels [SVG units].
const BELOW: f64 = 40.0;
/// An axis that appears shorter than this is left out [SVG units].
const SHORT: f64 = 14.0;
/// Smallest size of the box in a direction, as a share of its largest.
const FLATTEST: f64 = 0.15;

/// Paths in a box; zoom ranges are lengths in the picture. The first path casts a shadow on the
/// floor.
///
/// # Errors
/// A sentence if the size, the view or a range cannot be drawn.
pub fn space_chart(
    caption: Caption,
    paths: &[SpaceSeries],
    view: View,
    options: &ChartOptions,
) -> Result<Chart, String> {
    let (width, height) = size(options)?;
    if !(view.azimuth_deg.is_finite() && view.elevation_deg.is_finite()) {
        return Err("The direction of view must be a number of degrees.".into());
    }
    let camera = Camera::new(view);
    let room = Room::around(paths);
    let plot = PlotArea {
        left: SIDE,
        top: TOP,
        width: f64::from(width) - 2.0 * SIDE,
        height: f64::from(height) - TOP - BELOW,
    };
    let unit = options.units.length.name();
    let axis = Axis { label: "", unit, ..Axis::default() };
    let shown: Vec<SheetPoint> = paths
        .iter()
        .flat_map(|path| path.points.iter().copied())
        .chain(room.frame(&camera))
        .map(|point| camera.project(point))
        .collect();
    let whole =
        |side: fn(&SheetPoint) -> f64| widened(extent(shown.iter().map(side), false).unwrap_or((0.0, 1.0)));
    let full = equal_aspect(whole(|p| p.0), whole(|p| p.1), &plot);
    let range = |zoom: Option<(f64, f64)>, full| zoom.map_or(Ok(full), |range| valid(&axis, range));
    let (across, up) = equal_aspect(range(options.x_range, full.0)?, range(options.y_range, full.1)?, &plot);
    let scene =
        Scene { camera, room, plot, origin: (across.0, up.1), scale: plot.width / (across.1 - across.0) };

    let canvas = Canvas::new(width, height);
    scene.draw(&canvas, paths, options)?;
    let info = |(min, max), full| AxisInfo {
        label: String::new(),
        unit: unit.into(),
        min,
        max,
        log: false,
        floor: None,
        full,
    };
    let legend = |s: &SpaceSeries| Legend { key: s.key.into(), label: s.label.into(), class: s.class.into() };
    Ok(Chart {
        name: caption.name.into(),
        title: caption.title.into(),
        description: caption.description.into(),
        svg: canvas.finish(caption.title, caption.description),
        width: f64::from(width),
        height: f64::from(height),
        plot,
        x: info(across, full.0),
        y: info(up, full.1),
        series: paths.iter().map(legend).collect(),
        camera: Some([scene.camera.right, scene.camera.up]),
    })
}

/// Unit vectors of the picture.
struct Camera {
    /// To the right of the picture.
    right: [f64; 3],
    /// Up in the picture.
    up: [f64; 3],
    /// Out of the picture, towards the reader.
    out: [f64; 3],
}

impl Camera {
    fn new(view: View) -> Self {
        let (sin_a, cos_a) = math::sin_cos(view.azimuth_deg * DEG);
        let (sin_e, cos_e) = math::sin_cos(view.elevation_deg * DEG);
        Self {
            right: [-sin_a, cos_a, 0.0],
            up: [-sin_e * cos_a, -sin_e * sin_a, cos_e],
            out: [cos_e * cos_a, cos_e * sin_a, sin_e],
        }
    }

    /// Right and up in the picture, in the unit of the point.
    fn project(&self, point: [f64; 3]) -> SheetPoint {
        let dot = |axis: [f64; 3]| axis[0] * point[0] + axis[1] * point[1] + axis[2] * point[2];
        (dot(self.right), dot(self.up))
    }
}

/// The box around all paths, with a small margin [mm].
struct Room {
    min: [f64; 3],
    max: [f64; 3],
}

impl Room {
    fn around(paths: &[SpaceSeries]) -> Self {
        let range = |axis: usize| {
            let values = paths.iter().flat_map(|path| path.points.iter().map(move |p| p[axis]));
            extent(values, false).unwrap_or((0.0, 0.0))
        };
        let ranges = [range(0), range(1), range(2)];
        let greatest = ranges.iter().map(|(min, max)| max - min).fold(1e-6, f64::max);
        let roomy = ranges.map(|(min, max)| {
            let air = (0.04 * greatest).max((FLATTEST * greatest - (max - min)) / 2.0);
            (min - air, max + air)
        });
        Self { min: roomy.map(|r| r.0), max: roomy.map(|r| r.1) }
    }

    /// Corners of the floor on the two sides next to the reader (x, y), and on the two others.
    fn sides(&self, camera: &Camera) -> ([f64; 2], [f64; 2]) {
        let near = [0, 1].map(|i| if camera.out[i] > 0.0 { self.max[i] } else { self.min[i] });
        (near, [0, 1].map(|i| self.min[i] + self.max[i] - near[i]))
    }

    /// Foot of the z axis: the leftmost corner of the floor in view.
    fn post(&self, camera: &Camera) -> [f64; 3] {
        let (near, far) = self.sides(camera);
        let (a, b) = ([near[0], far[1], self.min[2]], [far[0], near[1], self.min[2]]);
        if camera.project(a).0 < camera.project(b).0 { a } else { b }
    }

    /// The points that enclose the floor and the axes.
    fn frame(&self, camera: &Camera) -> [[f64; 3]; 5] {
        let (low, high, post) = (self.min, self.max, self.post(camera));
        let floor = |x: f64, y: f64| [x, y, low[2]];
        [
            floor(low[0], low[1]),
            floor(high[0], low[1]),
            floor(high[0], high[1]),
            floor(low[0], high[1]),
            [post[0], post[1], high[2]],
        ]
    }

    fn middle(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| (self.min[axis] + self.max[axis]) / 2.0)
    }
}

/// A room in view on a canvas.
struct Scene {
    camera: Camera,
    room: Room,
    plot: PlotArea,
    /// Upper left corner of the plot area in the picture [mm].
    origin: SheetPoint,
    /// SVG units in a millimetre.
    scale: f64,
}

impl Scene {
    /// Position of a point in space on the canvas.
    fn place(&self, point: [f64; 3]) -> SheetPoint {
        let (u, v) = self.camera.project(point);
        (self.plot.left + (u - self.origin.0) * self.scale, self.plot.top + (self.origin.1 - v) * self.scale)
    }

    /// Draws floor, shadow, axes and paths, in this order.
    fn draw(&self, canvas: &Canvas, paths: &[SpaceSeries], options: &ChartOptions) -> Result<(), String> {
        canvas.layer(Layer::Floor, || self.floor(canvas))?;
        if let Some(first) = paths.first() {
            let floor = self.room.min[2];
            let shadow = first
                .points
                .iter()
                .map(|&[x, y, z]| self.place([x, y, if z.is_finite() { floor } else { z }]));
            canvas.layer(Layer::Shadow, || self.lines(canvas, shadow))?;
        }
        canvas.layer(Layer::Axis, || self.axes(canvas, options.units.length.name()))?;
        for path in paths.iter().filter(|path| options.shows(path.key)) {
            let layer = Layer::Series { class: path.class, key: path.key };
            canvas.layer(layer, || self.lines(canvas, path.points.iter().map(|&p| self.place(p))))?;
        }
        Ok(())
    }

    fn lines(&self, canvas: &Canvas, points: impl Iterator<Item = SheetPoint>) -> Result<(), String> {
        lines(points, window(&self.plot)).iter().try_for_each(|line| canvas.line(line))
    }

    /// Ticks along an axis: about one every fifty units in view.
    fn ticks(&self, axis: usize) -> Vec<Tick> {
        let (min, max) = (self.room.min[axis], self.room.max[axis]);
        let greatest = (0..3).map(|i| self.room.max[i] - self.room.min[i]).fold(0.0, f64::max);
        let whole = self.plot.width.min(self.plot.height) / 45.0;
        linear_ticks(min, max, (whole * (max - min) / greatest).clamp(2.0, 7.0) as usize, false)
    }

    /// The floor's outline and its lines at the ticks of x and y.
    fn floor(&self, canvas: &Canvas) -> Result<(), String> {
        let Room { min, max } = self.room;
        let lines_at = |axis: usize| {
            let ticks = self.ticks(axis).into_iter().map(|tick| tick.value);
            ticks.chain([min[axis], max[axis]]).collect::<Vec<f64>>()
        };
        let along_y = lines_at(0).into_iter().map(|x| [[x, min[1], min[2]], [x, max[1], min[2]]]);
        let along_x = lines_at(1).into_iter().map(|y| [[min[0], y, min[2]], [max[0], y, min[2]]]);
        along_y
            .chain(along_x)
            .try_for_each(|ends| self.lines(canvas, ends.into_iter().map(|p| self.place(p))))
    }

    /// x and y along the floor's edges next to the reader, z at the floor's leftmost corner.
    fn axes(&self, canvas: &Canvas, unit: &str) -> Result<(), String> {
        let low = self.room.min;
        let (near, _) = self.room.sides(&self.camera);
        self.axis(canvas, 0, &format!("x, {unit}"), [low[0], near[1], low[2]])?;
        self.axis(canvas, 1, &format!("y, {unit}"), [near[0], low[1], low[2]])?;
        self.axis(canvas, 2, &format!("z, {unit}"), self.room.post(&self.camera))
    }

    /// One axis as an arrow from `start` to the end of the room, with ticks and name on its outer
    /// side.
    fn axis(&self, canvas: &Canvas, axis: usize, name: &str, start: [f64; 3]) -> Result<(), String> {
        let along = |value: f64| {
            let mut point = start;
            point[axis] = value;
            self.place(point)
        };
        let (foot, tip) = (along(start[axis]), along(self.room.max[axis]));
        let length = distance(foot, tip);
        if length < SHORT {
            return Ok(());
        }
        let (dx, dy) = ((tip.0 - foot.0) / length, (tip.1 - foot.1) / length);
        let middle = self.place(self.room.middle());
        let side = if (middle.0 - foot.0) * dy > (middle.1 - foot.1) * dx { 1.0 } else { -1.0 };
        // Square to the axis, away from the room.
        let (nx, ny) = (-dy * side, dx * side);
        // Ends on the border count as inside despite rounding.
        let window = window(&self.plot).grown(0.1);
        let label = |text: &str, at: SheetPoint, gap: f64| {
            let reach = gap + nx.abs() * text_width(text) / 2.0 + ny.abs() * FONT_SIZE / 2.0;
            canvas.text(text, (at.0 + nx * reach, at.1 + ny * reach), HPos::Center, VPos::Center)
        };
        let apart = |text: &str| text_width(text) * dx.abs() + FONT_SIZE * dy.abs();

        lines([foot, tip], window).iter().try_for_each(|line| canvas.line(line))?;
        if window.contains(tip) {
            let barb = |s: f64| (tip.0 - 9.0 * dx + 3.0 * s * dy, tip.1 - 9.0 * dy - 3.0 * s * dx);
            canvas.polygon(&[tip, barb(1.0), barb(-1.0)])?;
        }
        // The name stands short of the tip, where the tip of another axis may be.
        let back = (apart(name) / 2.0 + 6.0).min(length);
        let named = (tip.0 - dx * back, tip.1 - dy * back);
        if window.contains(named) {
            label(name, named, 8.0)?;
        }
        // The name keeps its place; ticks are labelled where there is room beside it and one
        // another.
        let mut last: Option<SheetPoint> = None;
        for tick in self.ticks(axis) {
            let at = along(tick.value);
            if !window.contains(at) {
                continue;
            }
            canvas.line(&[at, (at.0 + 4.0 * nx, at.1 + 4.0 * ny)])?;
            let room = apart(&tick.label) + 4.0;
            let crowded = distance(at, named) < (room + apart(name)) / 2.0
                || last.is_some_and(|last| distance(at, last) < room);
            if !crowded {
                label(&tick.label, at, 7.0)?;
                last = Some(at);
            }
        }
        Ok(())
    }
}

fn distance(a: SheetPoint, b: SheetPoint) -> f64 {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    (dx * dx + dy * dy).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAPTION: Caption = Caption { name: "n", title: "t", description: "d" };

    fn chart(points: &[[f64; 3]], view: View) -> Chart {
        let path = SpaceSeries { key: "p", label: "P", class: "desired", points };
        space_chart(CAPTION, &[path], view, &ChartOptions::sized(860.0, 420.0)).unwrap()
    }

    #[test]
    fn the_reader_sees_x_to_the_right_y_away_and_z_up() {
        let camera = Camera::new(View { azimuth_deg: -90.0, elevation_deg: 0.0 });
        let (x, y, z) = (
            camera.project([1.0, 0.0, 0.0]),
            camera.project([0.0, 1.0, 0.0]),
            camera.project([0.0, 0.0, 1.0]),
        );
        for (seen, meant) in [(x, (1.0, 0.0)), (y, (0.0, 0.0)), (z, (0.0, 1.0))] {
            assert!((seen.0 - meant.0).abs() < 1e-12 && (seen.1 - meant.1).abs() < 1e-12, "{seen:?}");
        }
        assert!(camera.out[1] < 0.0);
    }

    #[test]
    fn a_millimetre_is_as_long_upwards_as_sideways() {
        let Chart { plot, x, y, .. } = chart(&[[0.0, 0.0, 0.0], [600.0, 20.0, 90.0]], View::default());
        let units = ((x.max - x.min) / plot.width, (y.max - y.min) / plot.height);
        assert!((units.0 / units.1 - 1.0).abs() < 1e-12, "{units:?}");
    }

    #[test]
    fn size_and_orientation_are_written_out() {
        let points = [[0.0, 0.0, 0.0], [300.0, 300.0, 200.0]];
        let drawing = chart(&points, View::default()).svg;
        for text in ["x, mm", "y, mm", "z, mm", ">100<", ">200<"] {
            assert!(drawing.contains(text), "{text} is missing");
        }
        assert_eq!(drawing, chart(&points, View::default()).svg);
        assert!(!drawing.contains("style="));
    }

    #[test]
    fn any_view_of_any_path_can_be_drawn() {
        let gap = [[0.0, 0.0, 0.0], [1.0, f64::NAN, 0.0], [2.0, 2.0, 2.0]];
        for points in [&gap[..], &gap[..1], &[]] {
            for (azimuth_deg, elevation_deg) in [(0.0, 0.0), (35.0, 90.0), (-120.0, -30.0), (180.0, 10.0)] {
                let drawing = chart(points, View { azimuth_deg, elevation_deg }).svg;
                assert!(!drawing.contains("NaN") && !drawing.contains("inf"), "{drawing}");
            }
        }
        let blind = View { azimuth_deg: f64::NAN, elevation_deg: 0.0 };
        assert!(space_chart(CAPTION, &[], blind, &ChartOptions::sized(860.0, 420.0)).is_err());
    }
}
