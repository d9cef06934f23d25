//! Names and units of the columns of a log.

use crate::units::{DEG, INCH, MM};

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Logged {
    /// Time.
    Time,
    /// Arc length along the path.
    Length,
    /// Position of the tip, or of a probed point.
    Position,
    /// Actual less desired tip.
    Deviation,
    /// Normal of a probed surface, out of the material.
    Normal,
    /// Force on the tool.
    Force,
    /// Joint angle at the motor, as the controller counts.
    Motor,
    /// Joint angle behind the gear.
    Load,
}

/// A column: what it holds, which component, and the size of its unit in SI, if its name states one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LoggedColumn {
    pub(super) logged: Logged,
    pub(super) component: usize,
    pub(super) unit: Option<f64>,
}

/// What is read, for errors.
pub(super) const KNOWN: &str = "the columns are time_s or s_mm, x_mm y_mm z_mm (tip or probed point), nx ny nz (its normal), \
                                dx_mm dy_mm dz_mm (actual less desired), fx_n fy_n fz_n, q1_deg to q6_deg (motor), \
                                load1_deg to load6_deg (behind the gear)";

/// Names before the component.
const STEMS: [(Logged, &[&str], &str); 6] = [
    (Logged::Deviation, &["d", "deviation", "error", "delta"], "xyz"),
    (Logged::Force, &["f", "force"], "xyz"),
    (Logged::Normal, &["n", "normal"], "xyz"),
    (Logged::Load, &["load", "loadq", "loadsideq", "qload"], "123456"),
    (Logged::Motor, &["q", "j", "joint", "motor", "motorq", "motorsideq"], "123456"),
    (Logged::Position, &["", "tip", "tcp", "position", "p", "point"], "xyz"),
];

/// Reads what a name says: words in lower case.
pub(super) fn named(words: &[String]) -> Result<LoggedColumn, &'static str> {
    let (unit_words, unit) = match words.last().map(String::as_str) {
        Some("s" | "sec" | "seconds") if words.len() > 1 => (1, Some(1.0)),
        Some("ms") => (1, Some(1e-3)),
        Some("us" | "µs" | "μs") => (1, Some(1e-6)),
        Some("mm") => (1, Some(MM)),
        Some("um" | "µm" | "μm") => (1, Some(1e-3 * MM)),
        Some("m") if words.len() > 1 => (1, Some(1.0)),
        Some("in" | "inch") => (1, Some(INCH)),
        Some("n") if words.len() > 1 => (1, Some(1.0)),
        Some("kn") => (1, Some(1e3)),
        Some("deg" | "degree" | "degrees") => (1, Some(DEG)),
        Some("rad" | "radian" | "radians") => (1, Some(1.0)),
        _ => (0, None),
    };
    let name = words[..words.len() - unit_words].concat();
    if ["t", "time", "zeit", "timestamp"].contains(&name.as_str()) {
        return Ok(LoggedColumn { logged: Logged::Time, component: 0, unit });
    }
    if ["s", "arc", "arclength", "length", "distance", "pathlength"].contains(&name.as_str()) {
        return Ok(LoggedColumn { logged: Logged::Length, component: 0, unit });
    }
    let last = name.chars().last().ok_or(KNOWN)?;
    let stem = &name[..name.len() - last.len_utf8()];
    let found = STEMS.iter().find_map(|(logged, stems, components)| {
        stems.contains(&stem).then(|| components.find(last)).flatten().map(|component| (*logged, component))
    });
    let (logged, component) = found.ok_or(KNOWN)?;
    Ok(LoggedColumn { logged, component, unit })
}
