//! Charts of measured beside predicted values.

use crate::chart::chart::{Axis, Chart, ChartOptions};
use crate::chart::content::{Content, Curve, Shape};
use crate::column::Column;
use crate::error::Error;
use crate::evidence::Evidence;

/// Classes of the curves, in their order.
const CLASSES: [&str; 4] = ["desired", "before", "s3", "shaping"];
/// Fewer values than this are marked.
const FEW: usize = 100;

/// Draws measured and predicted values.
///
/// # Errors
/// [`Error::Invalid`] for options that cannot be drawn.
pub fn chart(evidence: &Evidence, options: &ChartOptions) -> Result<Chart, Error> {
    content(evidence).draw(evidence.key, evidence.title, options)
}

/// The values drawn.
pub fn data(evidence: &Evidence) -> Vec<Column> {
    content(evidence).columns()
}

fn content(evidence: &Evidence) -> Content {
    let Evidence { over, shows, at, curves, .. } = evidence;
    let curves = curves.iter().zip(CLASSES).map(|(curve, class)| Curve {
        key: curve.key,
        label: curve.label,
        class,
        values: curve.values.clone(),
    });
    let few = at.len() < FEW;
    let x = Axis { label: over.0, unit: over.1, whole: few, ..Axis::default() };
    let y = Axis { label: shows.0, unit: shows.1, zero: few, ..Axis::default() };
    let shape = Shape::Curves { x, y, curves: curves.collect(), markers: few, bands: vec![] };
    Content { description: evidence.drawn.to_owned(), at: at.clone(), shape }
}
