//! The correction on its own, for an interface of the controller that adds it to the *desired* program while that runs: a table
//! at the interface's cycle, and what KUKA's RSI and ABB's EGM need beside it.
//!
//! Layouts follow public files for these options (see [`rsi`] and [`egm`]); nothing has been tried on a controller. The program
//! that sends the table in time is the user's own.

pub mod table;
pub mod rsi;
pub mod egm;

pub use table::{CorrectionRow, CorrectionTable};

use crate::error::Error;
use crate::export::header::{self, number};
use crate::export::post::robot::PackageFile;
use crate::report::Report;
use crate::setup::Controller;
use crate::units::MM;

/// An interface that adds a correction to a running program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interface {
    /// KUKA Robot Sensor Interface.
    Rsi,
    /// ABB Externally Guided Motion, path correction.
    Egm,
}

impl Interface {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Rsi, Self::Egm];

    /// Stable slug.
    pub fn id(self) -> &'static str {
        match self {
            Self::Rsi => "kuka-rsi",
            Self::Egm => "abb-egm",
        }
    }

    /// Refuses a cycle [s] at which the interface does not run.
    fn takes(self, cycle: f64) -> Result<(), Error> {
        let (takes, expected) = match self {
            Self::Rsi => (rsi::CYCLES.contains(&cycle), "0.004 or 0.012, at which RSI runs"),
            Self::Egm => (cycle <= egm::SLOWEST, "0.048 or less, at which EGM takes a path correction"),
        };
        if takes { Ok(()) } else { Err(Error::invalid("online.cycle_s", cycle, expected)) }
    }

    /// The one of this slug.
    ///
    /// # Errors
    /// [`Error::Invalid`] with all slugs.
    pub fn named(id: &str) -> Result<Self, Error> {
        let known = Self::ALL.into_iter().find(|interface| interface.id() == id);
        known.ok_or_else(|| Error::unknown_name("interface", id, "there are", Self::ALL.map(Self::id)))
    }
}

/// Table and skeletons of an interface.
///
/// # Errors
/// [`Error::Invalid`] if there is no correction to add.
pub fn package(report: &Report, interface: Interface) -> Result<Vec<PackageFile>, Error> {
    let table = CorrectionTable::of(report);
    if table.largest_shift == 0.0 && table.largest_turn == 0.0 {
        let expected = "a corrected path: lower compensation.tolerance_mm if it is within that as it is, and let max_passes be \
                        above 0";
        return Err(Error::invalid("compensation", "no correction", expected));
    }
    interface.takes(table.cycle)?;
    // Names get an ending as long as that of a part.
    let options = &report.setup().output;
    match interface {
        Interface::Rsi => Controller::Kuka.accepts(options, true)?,
        Interface::Egm => Controller::Abb.accepts(options, true)?,
    }
    Ok(match interface {
        Interface::Rsi => rsi::files(report, &table),
        Interface::Egm => egm::files(report, &table),
    })
}

/// The table as a file of its own, after lines that say what it is.
pub fn csv(report: &Report) -> String {
    let table = CorrectionTable::of(report);
    remarks(&header(report, &table)) + &table.csv()
}

/// Lines as comments of a table.
fn remarks(said: &[String]) -> String {
    said.iter().map(|line| format!("# {line}\n")).collect()
}

/// What every file of an interface says, plain ASCII without brackets.
fn header(report: &Report, table: &CorrectionTable) -> Vec<String> {
    let setup = report.setup();
    let mut lines = header::origin(report);
    lines.extend([
        "That is of the corrected program as Armill writes it. What an interface makes of it, with its delays, is not simulated.".into(),
        "UNTESTED on a controller. For a person who knows the option: try it in T1, without a part, with limits in place.".into(),
        "The correction is added to the program of the desired path. Added to a corrected program it would count twice.".into(),
        format!(
            "One row every {} s. Largest correction {} mm, {} deg.",
            number(table.cycle, 4),
            number(table.largest_shift / MM, 4),
            number(table.largest_turn, 4)
        ),
        "time_s is that of the run as simulated here. A controller times its path itself: find the row by s_mm, the arc length of \
         the desired path at the position that the controller commands."
            .into(),
        format!(
            "A correction begins to act {} s after it is sent, by online.dead_time_s of the job: send the row of that much later.",
            number(setup.correction_delay, 4)
        ),
    ]);
    if setup.mode.is_some() {
        lines.push(
            "The controller's input shaper acts on the desired program and not on the correction, which is shaped here already."
                .into(),
        );
    }
    if setup.feed_rule.is_some() {
        lines.push(
            "The desired program must have the feeds that keep the force, as Armill's own program has them."
                .into(),
        );
    }
    let ends = [&table.rows[0], &table.rows[table.rows.len() - 1]].map(|row| row.shift.norm() / MM);
    if ends.iter().any(|shift| *shift > NOTICED) {
        lines.push(format!(
            "The first row has {} mm already and the last one {} mm still: bring the correction in before the tool cuts, and take it \
             back after it has left.",
            number(ends[0], 4),
            number(ends[1], 4)
        ));
    }
    lines
}

/// A step of the correction up to this is not worth a word [mm].
const NOTICED: f64 = 0.001;
