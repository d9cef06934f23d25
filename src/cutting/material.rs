//! Cutting coefficients: how much force a chip of a given size costs.
//!
//! dF_t = (k_tc h + k_te) dz, likewise radial and axial (eq. 4.1 with the edge terms of
//! Y. Altintas, Manufacturing Automation, 2nd ed. 2012, section 2.8).

/// Coefficients of the linear edge-force model.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Coefficients {
    /// Tangential cutting coefficient k_tc [N/m^2].
    pub ktc: f64,
    /// Radial cutting coefficient k_rc [N/m^2].
    pub krc: f64,
    /// Axial cutting coefficient k_ac [N/m^2].
    pub kac: f64,
    /// Tangential edge coefficient k_te [N/m].
    pub kte: f64,
    /// Radial edge coefficient k_re [N/m].
    pub kre: f64,
    /// Axial edge coefficient k_ae [N/m].
    pub kae: f64,
}

/// A material of the library, in the units of its source: N/mm^2 and N/mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Preset {
    /// Key used in jobs.
    pub id: &'static str,
    /// Name as read.
    pub name: &'static str,
    /// Where the numbers come from and how far to trust them.
    pub note: &'static str,
    /// ktc, krc, kac [N/mm^2], kte, kre, kae [N/mm].
    pub coefficients: [f64; 6],
}

/// Review table of identified coefficients that several presets come from.
macro_rules! review {
    ($row:literal) => {
        concat!(
            "Chinese Journal of Mechanical Engineering 2021, doi 10.1186/s10033-021-00536-9, table 5 (its ref. ",
            $row,
            "). Published values of one alloy differ by a factor of two: take any as +-30 %."
        )
    };
}

/// All materials of the library.
pub const MATERIALS: [Preset; 5] = [
    Preset {
        id: "thesis",
        name: "Thesis example (material not named)",
        note: "Thesis section 4.2, below Fig. 4.1; without edge terms. Close to a steel's.",
        coefficients: [1800.0, 540.0, 800.0, 0.0, 0.0, 0.0],
    },
    Preset {
        id: "al-6082-t6",
        name: "Aluminium 6082-T6, carbide, dry",
        note: review!("189"),
        coefficients: [631.0, 99.0, 273.0, 13.0, 10.0, 2.8],
    },
    Preset {
        id: "al-7075-t6",
        name: "Aluminium 7075-T6, carbide, dry",
        note: review!("190"),
        coefficients: [767.01, 168.8, 222.0, 27.7, 26.6, 0.7],
    },
    Preset {
        id: "al-7075-hss",
        name: "Aluminium 7075, HSS end mill",
        note: review!("156"),
        coefficients: [951.365, 262.597, 323.33, 11.115, 11.314, 1.105],
    },
    Preset {
        id: "steel-unnamed",
        name: "Steel (grade not stated; no axial values)",
        note: "After T. Schmitz, K. S. Smith, Machining Dynamics; medium confidence. \
               The source has no axial coefficients: the axial force is taken as zero and will in truth not be.",
        coefficients: [1738.0, 584.0, 0.0, 62.0, 87.0, 0.0],
    },
];
