//! G0 to G3: from the words of a line to segments with their pace.

use super::arc::{Arc, Misfit, SAME};
use super::block::Block;
use super::code::Group;
use super::interpreter::{AXES, Interpreter};
use super::modal::{FeedMode, Motion};
use super::options::ARC_TOLERANCE_PART;
use super::word::{Word, WordFault, WordMode};
use crate::path::Segment;
use crate::path::builder;
use crate::path::program::{Move, MovePace};
use crate::units::MM;
use nalgebra::Vector3;

/// Most moves in a program; more would not fit a browser's memory.
const MOST_MOVES: usize = 2_000_000;
/// Most turns of a helix (P).
const MOST_TURNS: u32 = 1000;

impl Interpreter<'_> {
    /// Records the unit of the first coordinates, with remarks about a missing or changed unit.
    pub(super) fn note_unit(&mut self) {
        if self.noted_unit == Some(self.modal.unit) {
            return;
        }
        self.noted_unit = Some(self.modal.unit);
        let unit = self.modal.unit_name();
        if !self.modal.unit_said {
            self.remark("unit-assumed", || {
                format!("the program does not say its unit (G20 inch, G21 mm): {unit} is assumed (path.unit)")
            });
        }
        if self.program.unit.is_empty() {
            self.program.unit = unit;
        } else if self.program.unit != unit {
            self.remark("unit-change", || format!("the unit changes to {unit} here"));
        }
    }

    /// The point given by the axis words.
    ///
    /// An axis without a word keeps its position. The words are not consumed, because a repeated
    /// cycle reads them again.
    pub(super) fn target(&mut self, block: &Block) -> Result<Vector3<f64>, WordFault> {
        self.note_unit();
        let mut target = self.position;
        for (axis, letter) in AXES.into_iter().enumerate() {
            let Some(word) = block.peek(letter) else { continue };
            let value = word.value * self.modal.unit;
            let absolute = match word.mode {
                WordMode::Modal => !self.modal.incremental,
                mode => mode == WordMode::Absolute,
            };
            if absolute {
                target[axis] = value + self.origin()[axis];
            } else if self.is_certain(axis) {
                target[axis] += value;
            } else {
                let expected = format!(
                    "G91 counts from a position that is not known here: program {letter} under G90 first, or give path.start_mm"
                );
                return Err(word.fault(block.text, expected));
            }
        }
        Ok(target)
    }

    /// Executes the active motion if the line has words for one.
    pub(super) fn motion(&mut self, block: &mut Block) -> Result<(), WordFault> {
        if [530, 280, 300].into_iter().any(|code| block.has(Group::NonModal, code)) {
            return self.leave_out(block);
        }
        let axis_word = block.first_of(&AXES);
        match (self.modal.motion, axis_word) {
            (None, Some(_)) => {
                self.remark("motion-assumed", || {
                    "no motion is in force here (G0, G1, G2, G3): this is read as a rapid move, G0".into()
                });
                self.modal.motion = Some(Motion::Rapid);
                self.straight(block)
            }
            (None, None) => Ok(()),
            (Some(Motion::Rapid | Motion::Line), None) => Ok(()),
            (Some(Motion::Rapid | Motion::Line), Some(_)) => self.straight(block),
            (Some(Motion::Arc { counter_clockwise }), _) => {
                if block.first_of(&['X', 'Y', 'Z', 'I', 'J', 'K', 'R']).is_none() {
                    return Ok(());
                }
                self.all_known(block)?;
                self.all_back(3, block)?;
                self.arc(counter_clockwise, block)
            }
            (Some(Motion::Cycle(cycle)), _) => {
                if axis_word.is_none() && block.peek('R').is_none() {
                    return Ok(());
                }
                self.begin_over_hole(block)?;
                self.return_over_hole(block)?;
                self.all_known(block)?;
                self.drill(cycle, block)
            }
        }
    }

    /// The path may begin over the first hole of a cycle, whose line says where it is.
    fn begin_over_hole(&mut self, block: &Block) -> Result<(), WordFault> {
        let [a, b, n] = self.modal.plane.axes();
        let said = |axis: usize| self.known[axis] || block.peek(AXES[axis]).is_some();
        if self.known[n] && !(self.known[a] && self.known[b]) && said(a) && said(b) && !self.modal.incremental
        {
            let level = self.position[n];
            let mut over = self.target(block)?;
            over[n] = level;
            (self.position, self.tip) = (over, over);
            self.known = [true; 3];
        }
        Ok(())
    }

    /// Fails if the tool position is not fully known.
    fn all_known(&self, block: &Block) -> Result<(), WordFault> {
        self.all_back(2, block)?;
        match AXES.iter().zip(self.known).find(|(_, known)| !known) {
            None => Ok(()),
            Some((axis, _)) => Err(WordFault {
                at: block.start(),
                found: format!("a move that starts at an unknown {axis}"),
                expected: format!(
                    "program the start in a G0 line with {axis} before this one, or give path.start_mm"
                ),
            }),
        }
    }

    /// G0 and G1. The moves up to the first full position are not part of the path, because the
    /// machine's previous position is unknown.
    fn straight(&mut self, block: &mut Block) -> Result<(), WordFault> {
        let rapid = self.modal.motion == Some(Motion::Rapid);
        let to = self.target(block)?;
        let begins = self.known.contains(&false);
        self.given = AXES.map(|letter| block.take(letter).is_some());
        for (known, given) in self.known.iter_mut().zip(self.given) {
            *known |= given;
        }
        if begins {
            self.come_back();
        } else if self.stays_away(to, block)? {
            return Ok(());
        }
        match (begins, rapid) {
            (false, true) => self.rapid(to),
            (false, false) => self.feed(to, block.start()),
            (true, _) => {
                if !rapid {
                    self.remark("approach-left-out", || {
                        "this feed move starts wherever the machine is; the path begins where X, Y and Z are known"
                            .into()
                    });
                }
                (self.position, self.tip) = (to, to);
                if self.known[2] {
                    self.highest = self.highest.max(to.z);
                }
                Ok(())
            }
        }
    }

    /// A straight move without cutting.
    pub(super) fn rapid(&mut self, to: Vector3<f64>) -> Result<(), WordFault> {
        self.line_to(to, MovePace::Rapid)
    }

    /// A straight cut; `at` is the place of an error about the feed.
    pub(super) fn feed(&mut self, to: Vector3<f64>, at: usize) -> Result<(), WordFault> {
        let pace = self.pace((to - self.tip).norm(), at)?;
        self.line_to(to, pace)
    }

    fn line_to(&mut self, to: Vector3<f64>, pace: MovePace) -> Result<(), WordFault> {
        self.position = to;
        if (to - self.tip).norm() > SAME {
            self.push(Segment::Line { from: self.tip, to }, pace)?;
            self.tip = to;
        }
        Ok(())
    }

    fn push(&mut self, segment: Segment, pace: MovePace) -> Result<(), WordFault> {
        if self.program.moves.len() >= MOST_MOVES {
            let expected =
                "a longer program does not fit into a browser's memory: split it into parts".into();
            return Err(WordFault { at: 0, found: format!("more than {MOST_MOVES} moves"), expected });
        }
        self.highest = self.highest.max(segment.point(segment.length()).z);
        self.program.moves.push(Move {
            segment,
            axis_from: Vector3::z(),
            axis_to: Vector3::z(),
            pace,
            spindle: self.modal.spindle(),
            line: self.line,
        });
        Ok(())
    }

    /// The pace of a cutting move of this length [m].
    fn pace(&mut self, length: f64, at: usize) -> Result<MovePace, WordFault> {
        if self.modal.spindle_stopped() {
            self.remark("spindle-stopped", || "a feed move while the spindle is stopped".into());
        }
        match (self.modal.feed_mode, self.modal.feed) {
            // The move is too short to keep.
            (FeedMode::InverseTime, Some(_)) if length <= SAME => Ok(MovePace::JobFeed),
            (FeedMode::InverseTime, Some(rate)) => believed(length * rate, at),
            (FeedMode::InverseTime, None) => Err(WordFault {
                at,
                found: "a feed move without F under G93".into(),
                expected: "under G93 every line that cuts needs its own F, one over its minutes".into(),
            }),
            (_, None) => {
                self.remark("feed-missing", || {
                    "the program has given no feed F up to here: the job's feed is used".into()
                });
                Ok(MovePace::JobFeed)
            }
            (FeedMode::PerMinute, Some(feed)) => Ok(MovePace::Feed(feed)),
            (FeedMode::PerRevolution, Some(feed)) => match self.modal.spindle() {
                Some(speed) => believed(feed * speed, at),
                None => Err(WordFault {
                    at,
                    found: "a feed a revolution (G95) without spindle speed".into(),
                    expected: "give S above 0 before, or the feed a minute (G94)".into(),
                }),
            },
        }
    }

    /// G2 and G3.
    fn arc(&mut self, counter_clockwise: bool, block: &mut Block) -> Result<(), WordFault> {
        let plane = self.modal.plane;
        let [a, b, n] = plane.axes();
        let offsets = ['I', 'J', 'K'];
        let to = self.target(block)?;
        for letter in AXES {
            block.take(letter);
        }
        let extra_turns = match block.take('P') {
            Some(word) => f64::from(word.whole(block.text, 1, MOST_TURNS)? - 1),
            None => 0.0,
        };
        if let Some(word) = block.take(offsets[n]) {
            // Some posts write all three; that across the plane says nothing if it is 0.
            if word.value != 0.0 {
                let expected = format!("in this plane {} and {} give the centre", offsets[a], offsets[b]);
                return Err(word.fault(block.text, expected));
            }
        }
        let (first, second, radius) = (block.take(offsets[a]), block.take(offsets[b]), block.take('R'));
        let arc = Arc { plane, from: self.tip, to, counter_clockwise, extra_turns };
        let absolute = self.options.arc_tolerance;
        let tolerance = |radius: f64| absolute + ARC_TOLERANCE_PART * radius;
        let (center, word) = match (radius, first.or(second)) {
            (Some(radius), None) => (arc.center_for(radius.value * self.modal.unit, tolerance), radius),
            (None, Some(word)) => (Ok(self.center([(a, first), (b, second)], word, block)?), word),
            (Some(radius), Some(_)) => {
                return Err(radius.fault(block.text, "an arc has either a centre or a radius R, not both"));
            }
            (None, None) => {
                return Err(WordFault {
                    at: block.start(),
                    found: "an arc without centre and radius".into(),
                    expected: format!("give {} and {} (centre) or R (radius)", offsets[a], offsets[b]),
                });
            }
        };
        let segments = center.and_then(|center| arc.about(&center, tolerance));
        let segments = segments.map_err(|misfit| self.misfit(misfit, word, block))?;
        if arc.is_nearly_full(&segments, absolute) {
            self.remark("nearly-full-circle", || {
                "this arc is read as almost a full circle: its end lies just before its start; \
                 if a short arc is meant, its ends are rounded too coarsely"
                    .into()
            });
        }
        let pace = self.pace(segments.iter().map(Segment::length).sum(), block.start())?;
        for segment in segments {
            self.push(segment, pace)?;
        }
        (self.position, self.tip) = (to, arc.end());
        Ok(())
    }

    /// The centre given by I, J and K: relative to the start (G91.1) or absolute (G90.1).
    fn center(
        &self,
        words: [(usize, Option<Word>); 2],
        given: Word,
        block: &Block,
    ) -> Result<Vector3<f64>, WordFault> {
        let mut center = self.position;
        for (axis, word) in words {
            match word {
                Some(word) if self.modal.centers_absolute || word.mode == WordMode::Absolute => {
                    center[axis] = word.value * self.modal.unit + self.origin()[axis];
                }
                Some(word) => center[axis] += word.value * self.modal.unit,
                None if self.modal.centers_absolute => {
                    return Err(
                        given.fault(block.text, "under G90.1 both coordinates of the centre are needed")
                    );
                }
                None => {}
            }
        }
        Ok(center)
    }

    fn misfit(&self, misfit: Misfit, word: Word, block: &Block) -> WordFault {
        let (found, expected) = match misfit {
            Misfit::NoRadius => {
                ("a centre that is the start of the arc".into(), "the centre lies apart from the arc".into())
            }
            Misfit::NoChord => (
                "a radius for an arc that ends where it starts".into(),
                "there are many such circles: give the centre with I, J or K".into(),
            ),
            Misfit::TooShort(chord) => (
                format!(
                    "a radius of {:.4} mm for ends {:.4} mm apart",
                    word.value.abs() * self.modal.unit / MM,
                    chord / MM
                ),
                format!("R of at least {:.4} mm, half the distance", chord / 2.0 / MM),
            ),
            Misfit::Radii(at_start, at_end, allowed) => (
                format!(
                    "a centre {:.4} mm from the start and {:.4} mm from the end of the arc",
                    at_start / MM,
                    at_end / MM
                ),
                format!(
                    "both distances agree within {:.4} mm; check the centre, the plane (G17 to G19) \
                     and whether the centre counts from the start (G91.1) or is a point (G90.1)",
                    allowed / MM
                ),
            ),
        };
        WordFault { at: word.start, found: format!("\"{}\": {found}", word.text(block.text)), expected }
    }
}

/// A feed [m/s] computed from other values, if it is in range.
fn believed(feed: f64, at: usize) -> Result<MovePace, WordFault> {
    let fault = |fault: builder::Fault| WordFault { at, found: fault.found, expected: fault.expected };
    builder::feed(feed).map(MovePace::Feed).map_err(fault)
}
