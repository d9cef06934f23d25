//! The modal state of APT statements, and their dispatch.

use super::cycle::DrillCycle;
use super::drive::{Ahead, DriveSide};
use super::statement::{AptToken, Statement, Statements, TextPlace};
use super::{Options, language, words};
use crate::error::Error;
use crate::path::builder::{Circle, Fault, ProgramBuilder};
use crate::path::program::{Ignored, Program};
use crate::path::unit::LengthUnit;
use nalgebra::Vector3;

/// A feed as written.
#[derive(Debug, Clone, Copy)]
pub(super) enum Feed {
    /// [m/s]
    PerTime(f64),
    /// [m] per revolution
    PerTurn(f64),
}

pub(super) struct Reader<'a> {
    text: &'a str,
    pub(super) field: &'a str,
    pub(super) builder: ProgramBuilder,
    pub(super) unit: LengthUnit,
    pub(super) unit_said: bool,
    /// Line of the first length.
    pub(super) first_length: Option<usize>,
    pub(super) feed: Option<Feed>,
    /// Spindle speed [1/s].
    pub(super) speed: Option<f64>,
    /// Whether the spindle is on.
    pub(super) spinning: bool,
    pub(super) rapid: bool,
    pub(super) multax: Option<bool>,
    /// Axis of points that have none of their own.
    pub(super) fixed_axis: Option<Vector3<f64>>,
    /// The circle of an arc whose end is still to come, and its place.
    pub(super) circle: Option<(Circle, TextPlace<'a>)>,
    /// The circle of the arc completed by the previous statement.
    pub(super) made: Option<Circle>,
    /// The direction in which the next arc starts.
    pub(super) ahead: Option<Ahead<'a>>,
    pub(super) side: Option<DriveSide<'a>>,
    pub(super) cycle: Option<DrillCycle>,
    /// Line of a `GOHOME` without a point.
    pub(super) home: Option<usize>,
    /// The coordinates' frame: its origin, x axis and y axis, as written.
    pub(super) frame: Option<Vec<f64>>,
    /// Line of `FINI`.
    pub(super) ended: Option<usize>,
}

pub(super) fn read(
    text: &str,
    options: &Options<'_>,
    mut on_line: impl FnMut(usize),
) -> Result<Program, Error> {
    let mut reader = Reader {
        text,
        field: options.field,
        builder: ProgramBuilder::default(),
        unit: options.unit,
        unit_said: false,
        first_length: None,
        feed: None,
        speed: None,
        spinning: true,
        rapid: false,
        multax: None,
        fixed_axis: None,
        circle: None,
        made: None,
        ahead: None,
        side: None,
        cycle: None,
        home: None,
        frame: None,
        ended: None,
    };
    let mut statements = Statements::new(text, options.field);
    while let Some(statement) = statements.next() {
        reader.follow(&statement?)?;
        on_line(statements.count);
    }
    reader.finish(statements.count)
}

impl<'a> Reader<'a> {
    fn finish(mut self, lines: usize) -> Result<Program, Error> {
        self.no_circle_waits()?;
        if self.builder.program.moves.is_empty() {
            let expected = "a path needs at least two different GOTO points";
            return Err(
                Fault::new("the end of a text without a move", expected).at(self.field, (lines.max(1), 1))
            );
        }
        let unit = self.unit.name();
        if let (false, Some(line)) = (self.unit_said, self.first_length) {
            self.builder.remark("unit-assumed", line, || {
                format!("the text has no UNITS statement: lengths are read in {unit}")
            });
        }
        for tool in &mut self.builder.program.tools {
            tool.diameter *= self.unit.in_m();
        }
        Ok(self.builder.finish(unit, lines))
    }

    /// Executes a statement.
    fn follow(&mut self, statement: &Statement<'a>) -> Result<(), Error> {
        let place = &statement.place;
        if let Some(word) = statement.note() {
            return self.note(word, statement);
        }
        if let Some(line) = self.ended {
            let expected = format!("nothing follows FINI (line {line})");
            return Err(self.error(place, statement.written(), expected));
        }
        let made = self.made.take();
        if let (Some(ahead), "GOTO" | "FROM" | "CIRCLE" | "MOVARC" | "CYCLE" | "GOHOME" | "FINI") =
            (&self.ahead, statement.word.as_str())
        {
            let expected = "TLON,GOFWD/(CIRCLE/...),ON,(LINE/...) follows it";
            return Err(self.error(&ahead.place, "a start direction without its arc", expected));
        }
        if let (Some(cycle), "FROM" | "CIRCLE" | "MOVARC" | "INDIRV" | "INDIRP" | "GOHOME") =
            (&self.cycle, statement.word.as_str())
        {
            let expected = format!("GOTO to a hole, or CYCLE/OFF to end the cycle of line {}", cycle.line);
            return Err(self.error(place, statement.written(), expected));
        }
        match statement.word.as_str() {
            "GOTO" => self.go(statement, made)?,
            "FROM" => self.start(statement)?,
            "CIRCLE" | "MOVARC" => self.arc(statement)?,
            "INDIRV" | "INDIRP" => self.direct(statement)?,
            "TLON" | "TLLFT" | "TLRGT" => self.side(statement)?,
            "GOFWD" | "TLON,GOFWD" | "TLLFT,GOFWD" | "TLRGT,GOFWD" => self.arc_on_circle(statement)?,
            "CYCLE" => self.cycle(statement)?,
            "RAPID" => {
                self.words(statement, &[])?;
                self.rapid = true;
            }
            "FEDRAT" => self.feed(statement)?,
            "SPINDL" => self.spindle(statement)?,
            "UNITS" | "UNIT" => self.units(statement)?,
            "MULTAX" => self.multax = Some(self.words(statement, &["ON", "OFF"])? != Some("OFF")),
            "TLAXIS" => {
                let (numbers, _) = self.numbers(statement, &[3])?;
                let axis = self.builder.direction(Vector3::from_column_slice(&numbers), place.line);
                self.fixed_axis = Some(axis.map_err(|fault| fault.at(self.field, place.position()))?);
            }
            "DELAY" | "DWELL" => self.dwell(statement)?,
            "GOHOME" => self.go_home(statement)?,
            "FINI" => self.ended = Some(place.line),
            "MSYS" | "ORIGIN" | "CSYS" => self.frame(statement)?,
            word if words::is_harmless(word) => self.harmless(word, statement),
            word if words::CONTROLLER.contains(&word) => self.controller_text(statement),
            word => self.other(word, statement)?,
        }
        Ok(())
    }

    /// A comment that Creo writes for programs: only the tool and the frame matter.
    fn note(&mut self, word: &str, statement: &Statement<'a>) -> Result<(), Error> {
        match word {
            "CUTTER" => self.tool(statement),
            "CSYS" => self.frame(statement)?,
            _ => {}
        }
        Ok(())
    }

    /// A word without effect on the path; tools are recorded, and a tool change gets a remark.
    fn harmless(&mut self, word: &str, statement: &Statement<'a>) {
        if matches!(word, "LOADTL" | "LOAD") && !self.builder.program.moves.is_empty() {
            self.builder.remark("tool-change", statement.place.line, || {
                "the tool changes here; the job's tool is used for all moves".into()
            });
        }
        if matches!(word, "CUTTER" | "TLDATA") {
            self.tool(statement);
        }
        self.ignore(statement);
    }

    fn controller_text(&mut self, statement: &Statement<'a>) {
        self.builder.remark("controller-text", statement.place.line, || {
            format!("{}: text for the controller is ignored; it must not move the tool", statement.written())
        });
        self.ignore(statement);
    }

    /// Words that are refused, unless they only switch off what was never on.
    fn other(&mut self, word: &str, statement: &Statement<'a>) -> Result<(), Error> {
        let place = &statement.place;
        if let Some(advice) = words::refused(word) {
            if self.is_off(word, statement) {
                self.ignore(statement);
                return Ok(());
            }
            return Err(self.error(place, statement.written(), advice));
        }
        if let (None, Some((name, advice))) = (self.builder.pose, language::other_than_apt(self.text)) {
            return Err(self.error(place, format!("{name} (\"{}\")", statement.written()), advice));
        }
        if word.contains('=') {
            let expected = "definitions are not supported, as they belong to part programs: have the CAM system write CLDATA (GOTO points)";
            return Err(self.error(place, statement.written(), expected));
        }
        let expected = match words::nearest(word) {
            Some(known) => format!("did you mean {known}?"),
            None => "a word of APT, such as GOTO, RAPID or FEDRAT".into(),
        };
        Err(self.error(place, format!("the unknown word \"{word}\""), expected))
    }

    /// Whether a word that is refused otherwise asks for nothing: it is switched off, or turns by 0.
    fn is_off(&self, word: &str, statement: &Statement<'a>) -> bool {
        let Ok(tokens) = statement.tokens() else { return false };
        match (word, tokens.as_slice()) {
            ("CUTCOM" | "TRACUT" | "COPY", [token]) => token.is("OFF") || token.is("NOMORE"),
            ("ROTABL" | "ROTHED", tokens) => {
                let mut angles = tokens.iter().filter_map(AptToken::number).peekable();
                angles.peek().is_some() && angles.all(|angle| angle == 0.0)
            }
            _ => false,
        }
    }

    /// Lists a statement without effect on the path.
    pub(super) fn ignore(&mut self, statement: &Statement<'_>) {
        self.builder.program.ignored.push(Ignored { word: statement.written(), line: statement.place.line });
    }
}
