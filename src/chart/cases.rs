//! What charts of an answer by cases have in common: [`Intervals`](super::intervals::Intervals) for a row of cases,
//! and an [`ErrorGrid`](super::error_grid::ErrorGrid) over two things that vary.

use crate::chart::chart::Axis;
use crate::chart::scale::{Scale, Tick};
use crate::chart::svg::{Canvas, text_width};
use crate::error::Error;
use serde::Serialize;

/// Share of the width that the names of cases may take.
pub(super) const NAMES: f64 = 0.42;

/// A drawing, and its text alternative.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CasesDrawing {
    /// What it shows.
    pub title: String,
    /// One sentence with the extremes.
    pub description: String,
    /// One `svg` element.
    pub svg: String,
    /// Width [SVG units].
    pub width: f64,
    /// Height [SVG units].
    pub height: f64,
}

impl CasesDrawing {
    /// What was drawn on a canvas of this size.
    pub(super) fn finished(
        canvas: Canvas,
        (width, height): (u32, u32),
        title: &str,
        description: String,
    ) -> Self {
        Self {
            svg: canvas.finish(title, &description),
            title: title.to_owned(),
            description,
            width: f64::from(width),
            height: f64::from(height),
        }
    }
}

pub(super) fn refused(expected: String) -> Error {
    Error::invalid("chart", "\"cases\"", expected)
}

/// An axis that only names itself.
pub(super) fn named(name: &str) -> Axis<'_> {
    Axis { label: name, ..Axis::default() }
}

/// A text that fits into a width, shortened if it must be.
fn shortened(text: &str, width: f64) -> String {
    if text_width(text) <= width {
        return text.to_owned();
    }
    let mut kept = text.to_owned();
    while !kept.is_empty() && text_width(&kept) + text_width("…") > width {
        kept.pop();
    }
    format!("{}…", kept.trim_end())
}

/// Ticks in the middle of whole steps.
pub(super) fn words(labels: &[String], width: f64) -> Scale {
    let tick = |(k, label): (usize, &String)| Tick { value: k as f64 + 0.5, label: shortened(label, width) };
    Scale {
        ticks: labels.iter().enumerate().map(tick).collect(),
        ..Scale::new((0.0, labels.len() as f64), false, None)
    }
}

/// The part of a drawing that has this class.
#[cfg(test)]
pub(super) fn group<'a>(svg: &'a str, class: &str) -> &'a str {
    let from = svg.find(&format!("class=\"{class}\"")).unwrap();
    svg[from..].split("</g>").next().unwrap()
}
