//! The verdict, as a state and in words: what the arm cannot run is said before what it would
//! achieve, and what is promised holds with what is known of robot and material.

use crate::report::{Report, Severity, UNTOUCHED, Warning, length_text, millimetres};
use crate::uncertainty::Quantiles;
use crate::units::MM;
use serde::Serialize;

/// What can be promised.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum VerdictState {
    /// The arm cannot run the commands; the first warning says where.
    CannotRun,
    /// The tolerance is met with 95 % probability by what is known of robot and material.
    Met,
    /// The tolerance is met if the numbers are exact, but not with 95 % probability.
    MetIfNominal,
    /// The tolerance is not met, or nothing is cut that it could apply to.
    NotMet,
}

/// An error that the tolerance applies to [m].
#[derive(Debug, Clone, Copy)]
struct JudgedError {
    /// If every number were exact.
    nominal: f64,
    /// 95 % quantile with what is known of robot and material.
    p95: f64,
    /// What is off by it with exact numbers, and what may be; empty for the tip, whose figures
    /// are anyway.
    what: [&'static str; 2],
}

impl Report {
    /// The errors that the tolerance applies to, if the tip's largest contour error is `reached`
    /// [m] with exact numbers: that of the tip, of the top of the cut, and what of the path is
    /// missed.
    ///
    /// The band is that of the joint commands; a program's own error is added to it.
    fn judged(&self, reached: f64) -> [JudgedError; 3] {
        let own = self.after_max();
        let more = (reached - own).max(0.0);
        let (wall, missed) = (self.wall().max, self.missed().max);
        let error = |nominal: f64, p95: f64, what| JudgedError { nominal, p95: p95 + more, what };
        [
            error(reached, self.band.after.p95, ["", ""]),
            error(
                wall + more,
                self.band.wall.p95,
                ["the top of the cut is off", "the top of the cut may be off"],
            ),
            error(missed + more, self.band.missed_p95, ["the path is missed", "the path may be missed"]),
        ]
    }

    /// The first warning about what the arm cannot run.
    pub fn impossible(&self) -> Option<&Warning> {
        self.warnings.first().filter(|warning| warning.severity == Severity::CannotRun)
    }

    /// Whether the tool never touches the stock, so that there is no part to judge.
    fn cuts_nothing(&self) -> bool {
        self.warnings.iter().any(|warning| warning.code == UNTOUCHED)
    }

    /// The verdict as a state: on the worst of the tip, the top of the cut and what of the path is
    /// missed.
    pub fn verdict_state(&self) -> VerdictState {
        self.verdict_state_at(self.after_max())
    }

    /// The verdict if the tip's largest contour error is `reached` [m] with exact numbers, as a
    /// program with its own timing reaches it.
    pub fn verdict_state_at(&self, reached: f64) -> VerdictState {
        let tolerance = self.setup().goal.tolerance;
        let judged = self.judged(reached);
        if self.impossible().is_some() {
            VerdictState::CannotRun
        } else if self.cuts_nothing() || judged.iter().any(|error| error.nominal > tolerance) {
            VerdictState::NotMet
        } else if judged.iter().all(|error| error.p95 <= tolerance) {
            VerdictState::Met
        } else {
            VerdictState::MetIfNominal
        }
    }

    /// 95 % quantile of the largest contour error [m] if it is `reached` [m] with exact numbers.
    pub fn p95_at(&self, reached: f64) -> f64 {
        self.judged(reached)[0].p95
    }

    /// The verdict in words.
    pub fn verdict(&self) -> String {
        if let Some(warning) = self.impossible() {
            return impossible_text(warning);
        }
        if self.cuts_nothing() {
            return "Nothing is cut: the tool never touches the stock.".into();
        }
        let state = self.verdict_state();
        let expect = if self.compensation.passes == 0 { "Not compensated: expect" } else { "Expect" };
        format!(
            "{expect} {}; the tolerance of {} mm {}{}.",
            self.expected_text(),
            millimetres(self.setup().goal.tolerance),
            match state {
                VerdictState::Met => "is met",
                VerdictState::MetIfNominal => "is met if the numbers are exact, but not in 95 of 100 cases",
                VerdictState::NotMet | VerdictState::CannotRun => "is not met",
            },
            self.decisive(state, self.after_max()).map(|clause| format!(": {clause}")).unwrap_or_default()
        )
    }

    /// What to expect on the part: the median, and the 95 % quantile if it differs.
    pub(super) fn expected_text(&self) -> String {
        let text = |length: f64| length_text(length, MM, 2);
        let Quantiles { p50, p95, .. } = self.band.after;
        let (p50, p95) = (text(p50), text(p95));
        if p50 == p95 {
            return format!("{p50} mm on the part");
        }
        format!("{p50} mm on the part, up to {p95} mm in 95 of 100 cases")
    }

    /// What else than the tip, whose largest contour error is `reached` [m] with exact numbers,
    /// decides against the tolerance, if something does.
    pub(crate) fn decisive(&self, state: VerdictState, reached: f64) -> Option<String> {
        let of = |error: &JudgedError| match state {
            VerdictState::MetIfNominal => error.p95,
            _ => error.nominal,
        };
        let tolerance = self.setup().goal.tolerance;
        let [tip, others @ ..] = self.judged(reached);
        let worst = others.iter().max_by(|a, b| of(a).total_cmp(&of(b)));
        match worst {
            Some(worst) if of(worst) > tolerance && of(&tip) <= tolerance => {
                let what = worst.what[usize::from(state == VerdictState::MetIfNominal)];
                Some(format!("{what} by {} mm", millimetres(of(worst))))
            }
            _ => None,
        }
    }
}

/// The verdict on what the arm cannot run: what, where, and the remedy if one is known.
fn impossible_text(warning: &Warning) -> String {
    let remedy = warning.remedy.as_ref().map(|remedy| format!(" Remedy: {}.", decapitalised(remedy.brief())));
    let place = warning.place().map(|place| format!(", {place}")).unwrap_or_default();
    format!("The arm cannot run this: {}{place}.{}", warning.brief(), remedy.unwrap_or_default())
}

/// A text within a sentence: its first letter small.
pub(crate) fn decapitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_lowercase().chain(letters).collect()).unwrap_or_default()
}
