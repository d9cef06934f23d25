//! Charts of measurements and the model fitted to them.

use crate::chart::chart::{Axis, Chart, ChartOptions};
use crate::chart::content::{Content, Curve, Shape, TIME};
use crate::chart::unit::Units;
use crate::column::Column;
use crate::error::Error;
use crate::identify::gear::{Gear, GearLog};
use crate::identify::response::{Mode, Signal};
use crate::identify::stiffness::{Fit, Residual};

/// A fit to draw.
#[derive(Debug, Clone, Copy)]
pub enum Fitted<'a> {
    /// Displacement and residual, row by row.
    Stiffness(&'a Fit),
    /// Signal and fitted vibration over time.
    Response(&'a Signal, &'a Mode),
    /// The difference of a joint's angles over time, in the run that it was found in or in another.
    Gear(&'a Gear, &'a GearLog, GearRun),
}

/// Which run of a joint is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GearRun {
    /// The one that the gear was found in.
    Fitted,
    /// Another.
    Predicted,
}

impl Fitted<'_> {
    /// Draws the fit.
    ///
    /// # Errors
    /// [`Error::Invalid`] for options that cannot be drawn.
    pub fn chart(&self, options: &ChartOptions) -> Result<Chart, Error> {
        let (name, title) = match self {
            Fitted::Stiffness(_) => ("stiffness", "Displacement of each row, and its residual"),
            Fitted::Response(..) => ("response", "Measured response and fitted vibration"),
            Fitted::Gear(_, _, GearRun::Fitted) => {
                ("gear", "Difference of motor and load angle, measured and fitted")
            }
            Fitted::Gear(_, _, GearRun::Predicted) => {
                ("gear", "Difference of motor and load angle in the other run, measured and predicted")
            }
        };
        self.content(options.units).draw(name, title, options)
    }

    /// The values drawn.
    pub fn data(&self, units: Units) -> Vec<Column> {
        self.content(units).columns()
    }

    fn content(&self, units: Units) -> Content {
        match self {
            Fitted::Stiffness(fit) => stiffness(fit, units),
            Fitted::Response(signal, mode) => response(signal, mode),
            Fitted::Gear(gear, log, run) => gives_way(gear, log, *run),
        }
    }
}

fn stiffness(fit: &Fit, units: Units) -> Content {
    let (size, unit) = (units.length.in_m(), units.length.name());
    let values = |of: fn(&Residual) -> f64| fit.rows.iter().map(|row| of(row) / size).collect();
    let curves = vec![
        Curve { key: "measured", label: "Measured", class: "desired", values: values(|row| row.measured) },
        Curve {
            key: "residual",
            label: "Residual of the fit",
            class: "before",
            values: values(|row| row.residual),
        },
        Curve {
            key: "left-out",
            label: "Residual of a fit to the other rows",
            class: "shaping",
            values: values(|row| row.left_out),
        },
    ];
    let worst = fit.worst().first().map_or(String::new(), |row| {
        format!(
            " Line {} fits worst: {:.4} {unit} of {:.4} {unit}.",
            row.line,
            row.residual / size,
            row.measured / size
        )
    });
    let at: Vec<f64> = (1..=fit.rows.len()).map(|row| row as f64).collect();
    let x = Axis { label: "Row", whole: true, range: Some((1.0, at.len().max(2) as f64)), ..Axis::default() };
    let y = Axis { label: "Displacement", unit, zero: true, ..Axis::default() };
    let description = format!("Vector lengths, in the order of the text.{worst}");
    Content { description, at, shape: Shape::Curves { x, y, curves, markers: true, bands: vec![] } }
}

fn response(signal: &Signal, mode: &Mode) -> Content {
    let curves = vec![
        Curve { key: "signal", label: "Measured", class: "desired", values: signal.value.clone() },
        Curve { key: "fit", label: "Fitted", class: "before", values: mode.fitted.clone() },
    ];
    let y = Axis { label: "Signal", ..Axis::default() };
    let description = format!("The fit runs from {:.3} s to {:.3} s.", mode.window.0, mode.window.1);
    let shape = Shape::Curves { x: TIME, y, curves, markers: false, bands: vec![] };
    Content { description, at: signal.time.clone(), shape }
}

/// Milliradians.
const MILLI: f64 = 1e-3;

fn gives_way(gear: &Gear, log: &GearLog, run: GearRun) -> Content {
    let beside = gear.beside(log);
    let values = |of: fn(&[f64; 2]) -> f64| beside.iter().map(|pair| of(pair) / MILLI).collect();
    let label = if run == GearRun::Fitted { "Fitted" } else { "Predicted" };
    let curves = vec![
        Curve { key: "measured", label: "Measured", class: "desired", values: values(|pair| pair[0]) },
        Curve { key: "gear", label, class: "before", values: values(|pair| pair[1]) },
        Curve { key: "rest", label: "Rest", class: "shaping", values: values(|pair| pair[0] - pair[1]) },
    ];
    let y = Axis { label: "Motor less load angle", unit: "mrad", ..Axis::default() };
    let description = format!("Joint {}, without the offset of its encoders.", gear.joint + 1);
    let shape = Shape::Curves { x: TIME, y, curves, markers: false, bands: vec![] };
    Content { description, at: log.time.clone(), shape }
}
