//! Export formats; the module `export` writes them.

/// An export format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct Format {
    /// Stable slug.
    pub id: &'static str,
    /// Displayed name.
    pub name: &'static str,
    /// Extension of the file name.
    pub extension: &'static str,
    /// Its contents, and what to look out for.
    pub note: &'static str,
}

/// Every export format.
pub const FORMATS: [Format; 11] = [
    Format {
        id: "columns-csv",
        name: "All columns",
        extension: "csv",
        note: "Every column of the report, one row per sample.",
    },
    Format {
        id: "compensated-csv",
        name: "Compensated samples",
        extension: "csv",
        note: "Time, position in the base frame and joint commands, one row per sample.",
    },
    Format {
        id: "path-csv",
        name: "Compensated points",
        extension: "csv",
        note: "Thinned points in the workpiece frame with tool axis and feed.",
    },
    Format {
        id: "joints-csv",
        name: "Joint commands",
        extension: "csv",
        note: "Time and six joint values at the sample time.",
    },
    Format {
        id: "correction-csv",
        name: "Correction at the cycle",
        extension: "csv",
        note: "Time, arc length, shift and turn in the workpiece frame, one row per cycle of the job's loop.",
    },
    Format {
        id: "gcode",
        name: "G-code",
        extension: "nc",
        note: "Three axes, with arcs; a program read from G-code keeps its block numbers and auxiliary words.",
    },
    Format {
        id: "apt",
        name: "APT",
        extension: "apt",
        note: "Cutter location text, with the tool axis where it turns.",
    },
    Format {
        id: "krl",
        name: "KUKA KRL",
        extension: "src",
        note: "The main program of the package with all moves, blended by C_DIS. Not tried on a controller.",
    },
    Format {
        id: "rapid",
        name: "ABB RAPID",
        extension: "mod",
        note: "The main module of the package with all moves, blended by a zone. Not tried on a controller.",
    },
    Format {
        id: "val3",
        name: "Staubli VAL3",
        extension: "pgx",
        note: "The program start with all moves; its points are in the package's data. Not tried on a controller.",
    },
    Format {
        id: "fanuc",
        name: "FANUC LS",
        extension: "ls",
        note: "The main program of the package with all moves, passed by CNT. Not tried on a controller.",
    },
];
