//! A named series of numbers: the common currency of report, charts, files and page.

/// One quantity over all samples; the same index is the same instant in every column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Stable name with the unit in it, e.g. `contour_error_mm`: CSV header and lookup key.
    pub key: String,
    /// Display label, e.g. `Contour error`.
    pub label: String,
    /// Unit as printed, e.g. `mm`; empty for a pure number.
    pub unit: &'static str,
    /// One value per sample.
    pub values: Vec<f64>,
}

impl Column {
    /// A column from its parts.
    pub fn new(
        key: impl Into<String>,
        label: impl Into<String>,
        unit: &'static str,
        values: Vec<f64>,
    ) -> Self {
        Self { key: key.into(), label: label.into(), unit, values }
    }
}
