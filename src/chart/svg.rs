//! plotters' drawing surface as SVG text: layers with class names, one decimal, no fonts and no
//! DOM.
//!
//! plotters counts whole pixels; here one of its pixels is a tenth of an SVG unit, which keeps
//! curves smooth. Colours, pens and fonts of plotters' styles are not used: a layer's class says
//! what a thing is, and the page's style sheet how it looks, in light, in dark and on paper.

use std::cell::RefCell;
use std::convert::Infallible;
use std::fmt::Write;
use std::rc::Rc;

use plotters::coord::Shift;
use plotters::element::{Circle, EmptyElement, PathElement, Polygon, Rectangle};
use plotters::prelude::{DrawingArea, IntoDrawingArea};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{BLACK, IntoTextStyle, TextStyle};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
};

/// Backend pixels in one SVG unit.
pub(super) const TENTHS: f64 = 10.0;

/// Height of all text in a chart [SVG units].
pub(super) const FONT_SIZE: f64 = 12.0;

/// A group of shapes, in the order of drawing.
#[derive(Clone, Copy)]
pub(super) enum Layer<'a> {
    /// A range of values worth comparing with, such as a tolerance.
    Band,
    /// The area below a curve that bounds what can be.
    Bound { class: &'a str },
    /// Fine lines that lead the eye to the scale.
    Grid,
    /// Grid lines in space, where they run at an angle.
    Floor,
    /// Shadow of a path in space on the floor.
    Shadow,
    /// The data: `class` says how it looks, `key` names it to the page.
    Series { class: &'a str, key: &'a str },
    /// Cells of a grid, from light to dark on either side of the tolerance.
    Cell { shade: usize },
    /// Text on the data.
    Label,
    /// Axes, ticks and their text.
    Axis,
}

impl Layer<'_> {
    /// The group's opening tag. `currentColor` keeps a chart readable where no style sheet is at
    /// hand.
    fn tag(self) -> String {
        const INK: &str = r#"fill="none" stroke="currentColor""#;
        match self {
            Self::Band => r#"<g class="band" fill="currentColor" fill-opacity="0.12">"#.into(),
            Self::Bound { class } => format!(r#"<g class="bound {}" fill-opacity="0.1">"#, escaped(class)),
            Self::Grid => {
                format!(r#"<g class="grid" {INK} stroke-opacity="0.15" shape-rendering="crispEdges">"#)
            }
            Self::Floor => format!(r#"<g class="grid" {INK} stroke-opacity="0.2">"#),
            Self::Shadow => format!(r#"<g class="shadow" {INK} stroke-opacity="0.25">"#),
            Self::Series { class, key } => {
                let (class, key) = (escaped(class), escaped(key));
                let pen = r#"stroke-width="1.6" stroke-linejoin="round""#;
                format!(r#"<g class="series {class}" data-key="{key}" {INK} {pen}>"#)
            }
            Self::Cell { shade } => {
                let opacity = ["0.25", "0.12", "0.08", "0.18", "0.28", "0.38"][shade.min(5)];
                format!(r#"<g class="cell shade-{shade}" fill="currentColor" fill-opacity="{opacity}">"#)
            }
            Self::Label => r#"<g class="label">"#.into(),
            Self::Axis => format!(r#"<g class="axis" {INK}>"#),
        }
    }
}

/// A canvas, in SVG units with y down; everything goes through plotters to [`SvgBackend`].
pub(super) struct Canvas {
    backend: SvgBackend,
    /// plotters' view of the whole canvas, for charts built by plotters itself.
    pub(super) area: DrawingArea<SvgBackend, Shift>,
    /// The one text style.
    pub(super) text: TextStyle<'static>,
}

impl Canvas {
    /// An empty canvas of this many SVG units.
    pub(super) fn new(width: u32, height: u32) -> Self {
        let backend = SvgBackend { body: Rc::default(), width, height };
        let area = backend.clone().into_drawing_area();
        let text = ("sans-serif", FONT_SIZE * TENTHS).into_text_style(&area);
        Self { backend, area, text }
    }

    /// Puts everything that `draw` draws into one group.
    pub(super) fn layer<E: ToString>(
        &self,
        layer: Layer,
        draw: impl FnOnce() -> Result<(), E>,
    ) -> Result<(), String> {
        self.backend.body.borrow_mut().push_str(&layer.tag());
        let drawn = draw().map_err(|e| e.to_string());
        self.backend.body.borrow_mut().push_str("</g>\n");
        drawn
    }

    /// A line through the points; a dot if there is only one.
    pub(super) fn line(&self, points: &[(f64, f64)]) -> Result<(), String> {
        if let [(x, y)] = points {
            return self.dot((*x, *y), 1.5);
        }
        let points: Vec<_> = points.iter().map(|&p| tenths(p)).collect();
        self.area.draw(&PathElement::new(points, BLACK)).map_err(|e| e.to_string())
    }

    /// A filled disc.
    pub(super) fn dot(&self, at: (f64, f64), radius: f64) -> Result<(), String> {
        let disc = EmptyElement::at(tenths(at)) + Circle::new((0, 0), radius * TENTHS, BLACK);
        self.area.draw(&disc).map_err(|e| e.to_string())
    }

    /// A filled rectangle between two opposite corners.
    pub(super) fn rectangle(&self, a: (f64, f64), b: (f64, f64)) -> Result<(), String> {
        self.area.draw(&Rectangle::new([tenths(a), tenths(b)], BLACK)).map_err(|e| e.to_string())
    }

    /// A filled polygon.
    pub(super) fn polygon(&self, corners: &[(f64, f64)]) -> Result<(), String> {
        let corners: Vec<_> = corners.iter().map(|&p| tenths(p)).collect();
        self.area.draw(&Polygon::new(corners, BLACK)).map_err(|e| e.to_string())
    }

    /// Text anchored at the point.
    pub(super) fn text(&self, text: &str, at: (f64, f64), h: HPos, v: VPos) -> Result<(), String> {
        let style = self.text.pos(Pos::new(h, v));
        self.area.draw_text(text, &style, tenths(at)).map_err(|e| e.to_string())
    }

    /// The whole drawing; `title` and `description` are its text alternative.
    pub(super) fn finish(self, title: &str, description: &str) -> String {
        let SvgBackend { body, width, height } = self.backend;
        format!(
            concat!(
                r#"<svg xmlns="http://www.w3.org/2000/svg" class="plot" viewBox="0 0 {w} {h}" width="{w}" height="{h}" "#,
                r#"role="img" font-family="system-ui, sans-serif" font-size="{font}">"#,
                "\n<title>{title}</title>\n<desc>{description}</desc>\n{body}</svg>\n"
            ),
            w = width,
            h = height,
            font = FONT_SIZE,
            title = escaped(title),
            description = escaped(description),
            body = body.borrow()
        )
    }
}

/// Writes plotters' shapes as SVG elements.
#[derive(Clone)]
pub(super) struct SvgBackend {
    body: Rc<RefCell<String>>,
    width: u32,
    height: u32,
}

/// Drawing into text cannot fail.
type Drawn = Result<(), DrawingErrorKind<Infallible>>;

impl SvgBackend {
    fn element(&self, name: &str, attributes: &[(&str, &str)]) -> Drawn {
        let mut body = self.body.borrow_mut();
        body.push('<');
        body.push_str(name);
        for (key, value) in attributes {
            // Writing to a string cannot fail.
            let _ = write!(body, r#" {key}="{value}""#);
        }
        body.push_str("/>");
        Ok(())
    }
}

impl DrawingBackend for SvgBackend {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        (self.width * TENTHS as u32, self.height * TENTHS as u32)
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, _: BackendColor) -> Drawn {
        self.element(
            "rect",
            &[
                ("x", &number(x)),
                ("y", &number(y)),
                ("width", "0.1"),
                ("height", "0.1"),
                ("fill", "currentColor"),
            ],
        )
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Drawn {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        (x0, y0): BackendCoord,
        (x1, y1): BackendCoord,
        _: &S,
        _fill: bool,
    ) -> Drawn {
        let (width, height) = (number((x1 - x0).abs()), number((y1 - y0).abs()));
        self.element(
            "rect",
            &[("x", &number(x0.min(x1))), ("y", &number(y0.min(y1))), ("width", &width), ("height", &height)],
        )
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, _: &S) -> Drawn {
        self.element("polyline", &[("points", &points(path))])
    }

    /// A stroke as wide as the disc's radius fills the disc with the layer's line colour.
    fn draw_circle<S: BackendStyle>(
        &mut self,
        (x, y): BackendCoord,
        radius: u32,
        _: &S,
        _fill: bool,
    ) -> Drawn {
        let radius = f64::from(radius) / TENTHS;
        self.element(
            "circle",
            &[
                ("cx", &number(x)),
                ("cy", &number(y)),
                ("r", &(radius / 2.0).to_string()),
                ("stroke-width", &radius.to_string()),
                ("stroke-dasharray", "none"),
            ],
        )
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        vert: I,
        _: &S,
    ) -> Drawn {
        self.element("polygon", &[("points", &points(vert)), ("fill", "currentColor"), ("stroke", "none")])
    }

    fn draw_text<T: BackendTextStyle>(&mut self, text: &str, style: &T, (x, y): BackendCoord) -> Drawn {
        let anchor = style.anchor();
        let h = match anchor.h_pos {
            HPos::Left => "start",
            HPos::Center => "middle",
            HPos::Right => "end",
        };
        // From the anchor down to the baseline, by the height of digits and capitals.
        let drop = match anchor.v_pos {
            VPos::Top => 0.76,
            VPos::Center => 0.36,
            VPos::Bottom => -0.24,
        };
        let y = y + (drop * FONT_SIZE * TENTHS) as i32;
        let _ = write!(
            self.body.borrow_mut(),
            r#"<text x="{}" y="{}" text-anchor="{h}" fill="currentColor" stroke="none">{}</text>"#,
            number(x),
            number(y),
            escaped(text)
        );
        Ok(())
    }

    /// From a table of widths: plotters would ask the page's DOM, which a Worker does not have.
    fn estimate_text_size<T: BackendTextStyle>(
        &self,
        text: &str,
        _: &T,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        Ok(((text_width(text) * TENTHS) as u32, (FONT_SIZE * TENTHS) as u32))
    }
}

/// Width of a text as it will be drawn [SVG units]; it is rather too wide for the common system
/// fonts.
pub(super) fn text_width(text: &str) -> f64 {
    let ems: f64 = text
        .chars()
        .map(|c| match c {
            'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' | ' ' => 0.29,
            'f' | 't' | 'r' | 'I' | '(' | ')' | '[' | ']' | '/' | '-' | '\u{2009}' => 0.36,
            '⁰' | '¹' | '²' | '³' | '⁴'..='⁹' | '⁻' => 0.42,
            'm' | 'w' | 'M' | 'W' | '%' => 0.88,
            'A'..='Z' => 0.70,
            _ => 0.60,
        })
        .sum();
    ems * FONT_SIZE
}

/// The nearest point of plotters' raster.
fn tenths((x, y): (f64, f64)) -> BackendCoord {
    ((x * TENTHS).round() as i32, (y * TENTHS).round() as i32)
}

/// Tenths as a decimal number of SVG units, without a trailing `.0`.
fn number(tenths: i32) -> String {
    let sign = if tenths < 0 { "-" } else { "" };
    let (units, rest) = (tenths.unsigned_abs() / 10, tenths.unsigned_abs() % 10);
    if rest == 0 { format!("{sign}{units}") } else { format!("{sign}{units}.{rest}") }
}

/// Coordinates as a `points` attribute.
fn points(path: impl IntoIterator<Item = BackendCoord>) -> String {
    let mut text = String::new();
    for (x, y) in path {
        let gap = if text.is_empty() { "" } else { " " };
        let _ = write!(text, "{gap}{},{}", number(x), number(y));
    }
    text
}

/// Text escaped so that it is not taken for markup, inside an element or a quoted attribute.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_at_most_one_decimal() {
        assert_eq!([number(0), number(-3), number(120), number(1234)], ["0", "-0.3", "12", "123.4"]);
    }

    #[test]
    fn text_is_escaped() {
        let canvas = Canvas::new(100, 100);
        let layer = Layer::Series { class: "s1", key: r#""><script>"# };
        canvas.layer(layer, || canvas.text("<script>&", (1.0, 2.0), HPos::Left, VPos::Top)).unwrap();
        let svg = canvas.finish("a<b", "c>d");
        assert!(svg.contains("&lt;script&gt;&amp;</text>"), "{svg}");
        assert!(svg.contains(r#"data-key="&quot;&gt;&lt;script&gt;""#), "{svg}");
        assert!(svg.contains("<title>a&lt;b</title>") && !svg.contains("<script"), "{svg}");
    }

    #[test]
    fn a_lone_point_is_a_dot_in_the_line_colour() {
        let canvas = Canvas::new(100, 100);
        canvas.line(&[(5.04, 6.0)]).unwrap();
        let svg = canvas.finish("", "");
        assert!(svg.contains(r#"<circle cx="5" cy="6" r="0.75" stroke-width="1.5""#), "{svg}");
    }
}
