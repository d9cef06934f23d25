//! Charts of the cut along a program, for jobs with a stock.

use crate::chart::chart::Axis;
use crate::chart::content::{Content, Curve};
use crate::chart::figures::{Figures, digits, max};
use crate::error::Error;
use crate::units::MM;

/// Shown only if the job has a stock.
pub(super) const ENGAGEMENT: &str = "engagement";
/// Shown only if the job has a stock.
pub(super) const REMOVAL: &str = "removal";
/// Shown only if the job has a stock.
pub(super) const SURFACE: &str = "surface";

impl Figures<'_> {
    /// How far around the tool is in material, and the bounds of that.
    pub(super) fn engagement(&self) -> Result<Content, Error> {
        let curves = [
            ("engaged_deg", "engaged", "Engaged", "s1"),
            ("entry_deg", "entry", "Entry", "s2"),
            ("exit_deg", "exit", "Exit", "s3"),
        ];
        let curves = curves.map(|(column, key, label, class)| {
            self.cut_column(ENGAGEMENT, column).map(|values| Curve { key, label, class, values })
        });
        let curves = curves.into_iter().collect::<Result<Vec<_>, _>>()?;
        let description = format!(
            "Immersion angles at the tip, from the stock: at most {} deg in material.",
            digits(max(&curves[0].values))
        );
        let y = Axis { label: "Angle", unit: "deg", zero: true, ..Axis::default() };
        Ok(self.over_run(description, y, curves))
    }

    /// The material removal rate.
    pub(super) fn removal(&self) -> Result<Content, Error> {
        let values = self.cut_column(REMOVAL, "removal_cm3_min")?;
        let description = format!("At most {} cm³/min.", digits(max(&values)));
        let curves = vec![Curve { key: "removal", label: "Removal rate", class: "s1", values }];
        let y = Axis { label: "Removal rate", unit: "cm³/min", zero: true, ..Axis::default() };
        Ok(self.over_run(description, y, curves))
    }

    /// Excess of the surface that is left: material that should not stand, or below 0 is missing.
    pub(super) fn surface(&self) -> Result<Content, Error> {
        let (size, unit) = (self.units.length.in_m(), self.units.length.name());
        let curve = |key, label, column| {
            let values = self.cut_column(SURFACE, column)?;
            let values = values.iter().map(|excess| excess * MM / size).collect();
            Ok(Curve { key, label, class: key, values })
        };
        let curves =
            [curve("before", "Before", "surface_before_mm"), curve("after", "After", "surface_after_mm")];
        let curves = curves.into_iter().collect::<Result<Vec<_>, Error>>()?;
        let largest =
            |curve: &Curve| curve.values.iter().fold(0.0, |most, excess| f64::max(most, excess.abs()));
        let [before, after] = [0, 1].map(|k| self.read(largest(&curves[k]) * size));
        let description = format!(
            "Too much material above zero, too little below: before up to {before} {unit}, after up to {after} {unit}."
        );
        let y = Axis { label: "Excess", unit, zero: true, ..Axis::default() };
        Ok(self.over_run(description, y, curves))
    }

    /// A column of the cut for the chart `name`.
    fn cut_column(&self, name: &str, key: &str) -> Result<Vec<f64>, Error> {
        let series = self.report.series().into_iter().find(|series| series.key == key);
        let refused =
            || Error::invalid("chart", format!("\"{name}\""), "a job whose engagement follows a stock");
        series.map(|series| series.column().values).ok_or_else(refused)
    }
}
